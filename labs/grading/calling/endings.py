"""Why a process ended before it answered, in words for a student."""

from __future__ import annotations

import os
import signal
from collections.abc import Sequence

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


def cannot_open(modules: Sequence[str]) -> str:
    """That a submission imports modules which are installed, and which the machine keeps from its process."""
    return (
        f"the processes that run submissions cannot open Python's own files in {os.path.dirname(os.__file__)}, and this"
        f" submission imports {', '.join(modules)}, which cannot be loaded beforehand. Grade with an interpreter that"
        " every user can read, or as the user that it belongs to"
    )


def reason(ended: Ended) -> str:
    """The exit code or signal, and what usually causes it."""
    if ended.code == FAILED:
        return (
            "the code that answers calls in its process failed, which happens where memory runs out or Python's own"
            " functions are replaced"
        )
    if ended.code >= 0:
        return f"it ended itself (exit code {ended.code}), as os._exit does"
    try:
        name = signal.Signals(-ended.code).name
    except ValueError:
        name = f"signal {-ended.code}"
    return _SIGNALS.get(name, f"it was ended by {name}")
