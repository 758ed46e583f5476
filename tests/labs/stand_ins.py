"""What stands in for a submission: a process that says what a test wants, and a function that is called here."""

from __future__ import annotations

import contextlib
import time
from types import SimpleNamespace

from labs.grading.budget import Budget
from labs.grading.calling.calls import Call
from labs.grading.calling.patience import Patience
from labs.grading.calling.processes import Ended, Limits
from labs.grading.submission.reading import Submission
from labs.grading.worker import messages
from labs.grading.worker.tier import Tier

PATIENT = Limits(printed=50)
"""Limits that no test reaches in time; of what is printed little is kept."""


class Scripted:
    """In place of a test's process: says what it is told to, whatever it is asked."""

    number = 0
    most = max(Tier)

    def __init__(self, *said: object) -> None:
        self._said = list(said)
        self.asked: list[object] = []
        self.sent: list[bytes] = []
        self.waits: list[float] = []
        self.spent, self.until = 0.0, 0.0
        self.over = False

    def start(self, limits: Limits) -> Scripted:
        return self

    def measure(self, process: int, before: float) -> None:
        pass

    def send(self, message: bytes, seconds: float, until: float = 0.0) -> None:
        self.sent.append(message)

    def exchange(self, message: bytes, seconds: float, until: float = 0.0) -> bytes:
        self.until = until
        self.asked.append(messages.unpack(message[messages.HEADER :]) if message else None)
        self.waits.append(seconds)
        said = self._said.pop(0)
        if isinstance(said, Exception):
            raise said
        return messages.pack(said)[messages.HEADER :]

    gone, ended = False, Ended(3)

    def end(self, process: object = None) -> None:
        self.over = True


SEALED, LOADED = ("sealed", 3, [], [], 0, 0.0), ("loaded", ["f"], [], [])


def begun(*said, limits=PATIENT, patience=10.0, loaded=LOADED, text=""):
    """A call whose process has loaded, and then says this."""
    process = Scripted(SEALED, loaded, *said)
    call = Call(Submission("lab.py", text), limits, Patience(Budget(patience)), contextlib.nullcontext)
    assert call.begin(process, Tier.NETWORK) is None
    return call, process


def value(number, found, changed=(), printed=""):
    """The message that answers a call."""
    return "answer", number, "value", 0.0, list(changed), found, printed


def calls_until_it_fails(call: Call, name: str) -> None:
    """Call a function again and again, a second at most."""
    for _ in range(1000):
        call(name)
        time.sleep(0.001)


class Function:
    """A function of a submission, called here; asked and foreseen are kept. changed, printed: by its last call."""

    def __init__(self, formula, name="signed_distance", changed=(), printed=""):
        self.formula, self.name, self.asked, self.foreseen = formula, name, [], []
        self.functions = SimpleNamespace(process=lambda: SimpleNamespace(changed=changed, printed=printed))

    def __call__(self, *arguments):
        self.asked.append(arguments)
        return self.formula(*arguments)

    def foresee(self, several):
        self.foreseen += several
