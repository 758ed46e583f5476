"""A process's own time: what it computes and sleeps counts, and what it waits in line for a processor does not."""

from __future__ import annotations

import subprocess
import sys
import time
from types import SimpleNamespace

import pytest

from labs.grading.calling import own_time
from labs.grading.calling.own_time import Deadline, LinuxMeter, OwnTime
from labs.grading.errors import MachineBusy


class Machine:
    """A clock, and one process: what it does is told by the test."""

    def __init__(self) -> None:
        self.clock, self.computed, self.in_line, self.state = 100.0, 0.0, 0.0, "S"

    def ran(self) -> float:
        return self.computed

    def waited(self) -> float:
        return self.in_line

    def is_runnable(self) -> bool:
        return self.state == "R"

    def passes(self, computes: float = 0.0, sleeps: float = 0.0, waits: float = 0.0) -> None:
        self.clock += computes + sleeps + waits
        self.computed += computes
        self.in_line += waits


@pytest.fixture
def machine(monkeypatch) -> Machine:
    found = Machine()
    monkeypatch.setattr(own_time, "time", SimpleNamespace(monotonic=lambda: found.clock))
    return found


def test_computing_and_sleeping_count_and_waiting_in_line_does_not(machine):
    own = OwnTime(machine)
    own.begin()
    machine.passes(computes=0.5, sleeps=2.0, waits=30.0)
    assert own.seconds == pytest.approx(2.5)
    own.end()
    assert own.seconds == pytest.approx(2.5)


def test_without_a_meter_every_second_on_the_clock_counts(machine):
    own = OwnTime()
    own.begin()
    machine.passes(computes=0.5, sleeps=2.0, waits=30.0)
    own.end()
    assert own.seconds == pytest.approx(32.5)


def test_all_threads_of_a_process_count_though_others_wait_in_line(machine):
    own = OwnTime(machine)
    own.begin()
    machine.passes(waits=1.0)
    machine.computed += 4.0
    own.end()
    assert own.seconds == pytest.approx(4.0)


def test_between_exchanges_a_process_may_sleep_and_pays_for_computing(machine):
    own = OwnTime(machine)
    machine.passes(computes=0.5, sleeps=60.0)
    own.begin()
    machine.passes(computes=0.25)
    own.end()
    assert own.seconds == pytest.approx(0.75)


def test_a_thousand_short_sleeps_are_as_long_as_one_long_sleep(machine):
    own = OwnTime(machine)
    for _ in range(1000):
        own.begin()
        machine.passes(computes=0.001, sleeps=0.005)
        own.end()
        machine.passes(sleeps=0.002)  # nobody waits for it
    assert own.seconds == pytest.approx(6.0)


def test_short_answers_on_a_busy_machine_cost_what_they_compute(machine):
    own = OwnTime(machine)
    for _ in range(1000):
        own.begin()
        machine.passes(computes=0.001, waits=0.025)
        own.end()
    assert own.seconds == pytest.approx(1.0)


def test_what_waited_in_line_between_two_exchanges_hides_no_sleep(machine):
    own = OwnTime(machine)
    for _ in range(100):
        machine.passes(waits=0.1)  # we do, or it works ahead
        own.begin()
        machine.passes(sleeps=0.05)
        own.end()
    assert own.seconds == pytest.approx(5.0)


@pytest.mark.parametrize("does", ["computes", "sleeps"])
def test_a_process_that_has_used_its_own_time_is_stopped(machine, does):
    own = OwnTime(machine)
    own.begin()
    deadline = Deadline(own, 5.0, 1e9)
    machine.state = "R" if does == "computes" else "S"
    machine.passes(waits=60.0, **{does: 4.9})
    deadline.check()
    assert deadline.pause() == pytest.approx(0.1)
    machine.passes(**{does: 0.2})
    with pytest.raises(TimeoutError):
        deadline.check()


def test_a_process_in_line_is_judged_after_its_turn(machine):
    own = OwnTime(machine)
    own.begin()
    deadline = Deadline(own, 5.0, 1e9)
    machine.clock += 7.0  # in line all the while, which the system has not reported yet
    machine.state = "R"
    deadline.check()
    machine.in_line += 7.0
    machine.passes(computes=0.1)
    deadline.check()
    machine.passes(sleeps=6.0)
    machine.state = "S"
    with pytest.raises(TimeoutError):
        deadline.check()


def test_the_clock_ends_what_no_processor_was_left_for(machine):
    own = OwnTime(machine)
    own.begin()
    deadline = Deadline(own, 5.0, machine.clock + 100.0)
    machine.passes(computes=0.1, waits=99.0)
    deadline.check()
    machine.passes(waits=1.0)
    with pytest.raises(MachineBusy, match="not graded for lack of time"):
        deadline.check()


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere the system reports nothing")
def test_the_system_tells_a_process_that_computes_from_one_that_sleeps():
    loops, sleeps = "while True: pass", "import time; time.sleep(60)"
    with (
        subprocess.Popen([sys.executable, "-c", loops]) as busy,
        subprocess.Popen([sys.executable, "-c", sleeps]) as idle,
    ):
        try:
            meters = [LinuxMeter(process.pid, 0.0) for process in (busy, idle)]
            until = time.monotonic() + 60.0  # a busy machine may take so long to give it half a second
            while meters[0].ran() < 0.5 and time.monotonic() < until:
                time.sleep(0.05)
            assert meters[0].ran() >= 0.5
            assert meters[1].ran() < 0.5
            assert meters[0].is_runnable()
            assert not meters[1].is_runnable()
        finally:
            busy.kill(), idle.kill()
    assert meters[0].ran() >= 0.5, "of a process that has ended it is what was read last"
