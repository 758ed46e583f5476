"""Why a process ended before it answered, in words for a student."""

from __future__ import annotations

import signal

from labs.grading.calling.processes import Ended
from labs.grading.worker.serving import FAILED

_SIGNALS = {
    "SIGSEGV": "it crashed (segmentation fault): a recursion without end, or memory written past NumPy",
    "SIGBUS": "it crashed (bus error)",
    "SIGILL": "it crashed (illegal instruction)",
    "SIGABRT": "it aborted",
    "SIGXCPU": "it used more processor time than a test may",
    "SIGKILL": "it closed its way back to the grader, or was stopped by the system",
}


def reason(ended: Ended) -> str:
    """The exit code or signal, and what usually causes it."""
    if ended.code == FAILED:
        return "what answers for it in its process was patched or broken"
    if ended.code >= 0:
        return f"it ended itself (exit code {ended.code}), as os._exit does"
    try:
        name = signal.Signals(-ended.code).name
    except ValueError:
        name = f"signal {-ended.code}"
    return _SIGNALS.get(name, f"it was ended by {name}")
