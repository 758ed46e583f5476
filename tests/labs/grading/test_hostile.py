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
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from labs.grading.budget import ON_THE_CLOCK
from labs.grading.calling.processes import Limits
from labs.grading.calling.remote import Grader, Remote
from labs.grading.errors import StudentError
from labs.grading.submission.reading import Submission
from labs.grading.worker.tier import Tier

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="elsewhere there is a time limit alone, and it says so")

ROOT = Path(__file__).parents[3]
ATTACKS = sorted((Path(__file__).parent / "hostile").glob("*.py"))
CALLS = ((-2.0, 0.5), (-3.0, 0.25))  # what the hidden test asks
SECRET = "def expected(velocity, restitution):\n    return -restitution * velocity\n"
SYSTEM_PYTHONS = (f"/usr/bin/python3.{sys.version_info[1]}", f"/usr/local/bin/python3.{sys.version_info[1]}")
HASTY, PATIENT = Limits(call=0.4, test=1.0), Limits()
"""For attacks that only wait, and for all others: on a busy machine they take their time as well."""


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
                    each.accept()[0].close()
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
def sealed(grader) -> Grader:
    """A grader whose processes this kernel seals in."""
    if grader_tier(grader) < Tier.NETWORK:
        pytest.skip("this kernel cannot seal a process in")
    return grader


def hidden_test(text: str, grader: Grader, limits: Limits = PATIENT) -> str:
    """What a test says to a submission of that text; empty where every answer is right."""
    began = time.monotonic()
    told = _hidden_test(text, grader, limits)
    assert time.monotonic() - began < limits.submission * ON_THE_CLOCK
    return told


def _hidden_test(text: str, grader: Grader, limits: Limits) -> str:
    expected = {call: -call[1] * call[0] for call in CALLS}  # in a frame of the grader, where attacks look for it
    grader.limits = limits
    # Closed, so that the process which is ready for another test does not go on attacking.
    with Remote(Submission("hostile.py", text), grader) as remote, remote.fresh() as call:
        try:
            for velocity, restitution in CALLS:
                answer = call("rebound_velocity", velocity, restitution)
                if not (type(answer) is float and answer == expected[velocity, restitution]):
                    return f"gave {answer!r}; {call.printed}"
        except StudentError as error:
            return f"{error} {call.printed}"
    return ""


def limits_for(attack: Path) -> Limits:
    return HASTY if "no answer within" in says(attack) else PATIENT


def says(attack: Path) -> str:
    return attack.read_text(encoding="utf-8").splitlines()[1].removeprefix("# says: ")


@pytest.mark.parametrize(
    "attack",
    [pytest.param(file, id=file.stem, marks=pytest.mark.slow if at % 8 else ()) for at, file in enumerate(ATTACKS)],
)
def test_an_attack_earns_nothing_harms_nothing_and_hears_why(attack, lair, sealed):
    told = hidden_test(lair.filled(attack), sealed, limits_for(attack))
    assert re.search(says(attack), told), told
    assert all(character.isprintable() or character in "\n\t" for character in told)
    assert lair.listing() == lair.before
    assert not lair.heard()
    assert hidden_test(SECRET.replace("expected", "rebound_velocity"), sealed) == ""  # the next student is graded


@pytest.mark.parametrize(
    ("name", "without"),
    [("reads_tests", ("landlock", "seccomp")), ("takes_rights_back", ("landlock", "seccomp"))],
)
def test_an_attack_on_files_pays_where_files_are_not_sealed(name, without, lair):
    attack = Path(__file__).parent / "hostile" / f"{name}.py"
    with Grader(without=without) as open_grader:
        assert grader_tier(open_grader) == Tier.LIMITS
        assert hidden_test(lair.filled(attack), open_grader) == ""


def test_an_attack_by_socket_is_heard_where_the_network_is_open(lair):
    attack = Path(__file__).parent / "hostile" / "sockets.py"
    with Grader(without=("landlock", "seccomp", "namespace")) as open_grader:
        hidden_test(lair.filled(attack), open_grader)
    assert lair.heard()
    while lair.heard():
        pass  # the other kinds of sockets: the next test listens anew


FILES_OF_OTHERS = ("reads_tests", "takes_rights_back", "empties_files", "links", "sockets", "other_processes")
"""Attacks on what the measures are there for: in verify, those without a measure are tried with these alone."""


@pytest.mark.parametrize("measure", ["landlock", "user"])
@pytest.mark.parametrize(
    "attacks",
    [
        pytest.param([file for file in ATTACKS if file.stem in FILES_OF_OTHERS], marks=pytest.mark.slow, id="some"),
        pytest.param(ATTACKS, marks=pytest.mark.weekly, id="all"),
    ],
)
def test_no_attack_pays_without_a_measure_that_another_covers(measure, attacks, lair):
    with Grader(without=(measure,)) as lesser:
        assert grader_tier(lesser) == Tier.NETWORK
        for attack in attacks:
            told = hidden_test(lair.filled(attack), lesser, limits_for(attack))
            assert re.search(says(attack), told), f"{attack.stem}: {told}"
    assert lair.listing() == lair.before
    assert not lair.heard()


@pytest.mark.skipif(os.geteuid() != 0, reason="the tests above ran as an ordinary user already")
@pytest.mark.parametrize(
    "attacks",
    [
        pytest.param(FILES_OF_OTHERS, marks=pytest.mark.slow, id="some"),
        pytest.param([file.stem for file in ATTACKS], marks=pytest.mark.weekly, id="all"),
    ],
)
def test_attacks_gain_nothing_if_the_grader_is_an_ordinary_user(attacks):
    nobody = {"user": 65534, "group": 65534, "extra_groups": []}
    packages = os.pathsep.join(path for path in sys.path if path)
    environment = {"PATH": os.environ["PATH"], "PYTHONPATH": packages, "PYTHONDONTWRITEBYTECODE": "1"}
    usable = [each for each in (sys.executable, *SYSTEM_PYTHONS) if can_run(each, nobody, environment)]
    if not usable:
        pytest.skip("no interpreter that an ordinary user may run")
    command = [
        usable[0],
        "-m",
        "pytest",
        "-q",
        "-p",
        "no:cacheprovider",
        "-k",
        f"harms_nothing and ({' or '.join(attacks)})",
        "-m",
        "",
    ]
    command += [str(Path(__file__))]
    ran = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False, **nobody)
    assert ran.returncode == 0, ran.stdout[-2000:]
    assert f"{len(attacks)} passed" in ran.stdout


def can_run(interpreter: str, user: dict, environment: dict) -> bool:
    command = [interpreter, "-c", "import numpy, pytest, hypothesis, pytest_timeout"]
    try:
        return subprocess.run(command, env=environment, capture_output=True, check=False, **user).returncode == 0
    except OSError:
        return False


def grader_tier(grader: Grader) -> Tier:
    with Remote(Submission("empty.py", ""), grader).fresh() as call:
        return call.sealing.tier
