"""Timers that go off when the next test runs."""
# says: gave 0.0|PermissionError

import contextlib
import signal

signal.signal(signal.SIGALRM, signal.SIG_DFL)
for timer in (signal.ITIMER_REAL, signal.ITIMER_VIRTUAL, signal.ITIMER_PROF):
    with contextlib.suppress(OSError):
        signal.setitimer(timer, 0.01, 0.01)
signal.alarm(1)


def rebound_velocity(velocity, restitution):
    return 0.0
