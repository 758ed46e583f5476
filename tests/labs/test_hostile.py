"""Hostile submissions, one attack a file in `hostile/`: none is paid, none harms the grader, each is told why.

A file's second line says what its author reads, as a regular expression. `{SECRET}` and the like are filled in, so
every attack knows what it would have to find out: where the expected values lie, which process grades, where results
are kept. Right is −e v; what an attack falls back on is 0.
"""

from __future__ import annotations

import contextlib
import os
import re
import socket
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from labs.grading.errors import StudentError
from labs.grading.processes import Limits
from labs.grading.remote import Grader, Remote
from labs.grading.submission import Submission
from labs.grading.worker.tier import Tier

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="elsewhere there is a time limit alone, and it says so")

ROOT = Path(__file__).parents[2]
ATTACKS = sorted((Path(__file__).parent / "hostile").glob("*.py"))
CALLS = ((-2.0, 0.5), (-3.0, 0.25))  # what the hidden test asks
SECRET = "def expected(velocity, restitution):\n    return -restitution * velocity\n"
LIMITS = Limits(call=0.4, test=1.0)
"""Shorter than usual: an attack that waits, waits for as long. Everything honest here takes a hundredth of it."""


class Lair:
    """What attacks are after: a folder with the expected values and the results, an open port, this process."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.secret, self.results = folder / "secret.py", folder / "results.json"
        self.secret.write_text(SECRET)
        self.results.write_text("no points")
        self.sockets = [socket.socket(), socket.socket(type=socket.SOCK_DGRAM), socket.socket(socket.AF_UNIX)]
        self.sockets[0].bind(("127.0.0.1", 0))
        self.port = self.sockets[0].getsockname()[1]
        self.sockets[1].bind(("127.0.0.1", self.port))
        self.sockets[2].bind(str(folder / "socket"))
        for each in (self.sockets[0], self.sockets[2]):
            each.listen()
        for each in self.sockets:
            each.setblocking(False)
        folder.chmod(0o777)  # nothing but the sandbox keeps an attack out
        for file in (self.secret, self.results, folder / "socket"):
            file.chmod(0o666)
        self.before = self.listing()

    def filled(self, attack: Path) -> str:
        """The attack's text with the places it is after."""
        names = {"SECRET": self.secret, "RESULTS": self.results, "FOLDER": self.folder, "ROOT": ROOT}
        text = attack.read_text(encoding="utf-8")
        for name, value in {**names, "GRADER": os.getpid(), "PORT": self.port}.items():
            text = text.replace("{" + name + "}", str(value))
        return text

    def listing(self) -> dict[str, bytes]:
        return {each.name: each.read_bytes() for each in self.folder.iterdir() if each.is_file()}

    def heard(self) -> bool:
        """Whether anything came in on the sockets."""
        for each in self.sockets:
            with contextlib.suppress(BlockingIOError):
                if each.type == socket.SOCK_DGRAM:
                    each.recv(10)
                else:
                    each.accept()
                return True
        return False


@pytest.fixture(scope="module")
def lair() -> Iterator[Lair]:
    with tempfile.TemporaryDirectory(prefix="lair-") as folder:  # where pytest keeps its own, others cannot go
        found = Lair(Path(folder))
        os.environ["GRADER_SECRET"] = SECRET
        yield found
        del os.environ["GRADER_SECRET"]
        for each in found.sockets:
            each.close()


@pytest.fixture(scope="module")
def grader() -> Iterator[Grader]:
    with Grader(LIMITS) as found:
        yield found


def hidden_test(text: str, grader: Grader) -> str:
    """What a test says to a submission of that text; empty where every answer is right."""
    expected = {call: -call[1] * call[0] for call in CALLS}  # in a frame of the grader, where attacks look for it
    with Remote(Submission("hostile.py", text), grader).fresh() as call:
        try:
            for velocity, restitution in CALLS:
                answer = call("rebound_velocity", velocity, restitution)
                if not (type(answer) is float and answer == expected[velocity, restitution]):
                    return f"gave {answer!r}; {call.printed}"
        except StudentError as error:
            return f"{error} {call.printed}"
    return ""


def says(attack: Path) -> str:
    return attack.read_text(encoding="utf-8").splitlines()[1].removeprefix("# says: ")


@pytest.mark.parametrize("attack", ATTACKS, ids=lambda attack: attack.stem)
def test_an_attack_is_not_paid_harms_nothing_and_is_told_why(attack, lair, grader):
    if grader_tier(grader) < Tier.NETWORK:
        pytest.skip("this kernel cannot seal a process in")
    told = hidden_test(lair.filled(attack), grader)
    assert re.search(says(attack), told), told
    assert all(character.isprintable() or character in "\n\t" for character in told)
    assert lair.listing() == lair.before
    assert not lair.heard()
    assert hidden_test(SECRET.replace("expected", "rebound_velocity"), grader) == ""  # the next student is graded


def grader_tier(grader: Grader) -> Tier:
    with Remote(Submission("empty.py", ""), grader).fresh() as call:
        return call.sealing.tier
