"""Hostile files: made to be read for ever, to be misread, or to be taken for something else. None is paid.

Each is read, and its function is called, as it is when a student's file is graded. What is read and said has to fit
into a few seconds of processor time, whatever the machine does besides.
"""

from __future__ import annotations

import contextlib
import itertools
import json
import os
import string
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from submissions import solved

from labs.grading.budget import Budget
from labs.grading.calling.remote import Grader, Remote
from labs.grading.errors import NotTried, StudentError, UnreadableSubmission
from labs.grading.feedback.report import report
from labs.grading.judging.grade import grade, read_grade
from labs.grading.submission.cells import BRACE_LIMIT, CODE_LIMIT
from labs.grading.submission.reading import read

WRONG = "def rebound_velocity(velocity, restitution): return 0.0\n"
DEF = "def rebound_velocity(u, e):\n"
LONG = 8.0  # s of processor time for the longest file; some took from one to many minutes
ROOM = CODE_LIMIT - 1000
A_SIXTH = ROOM // 6
"""Enough to tell a time that grows as the square of a file's length: it would still be seconds."""


def names() -> Iterator[str]:
    """Short names, no two alike."""
    for length in itertools.count(2):
        for letters in itertools.product(string.ascii_lowercase, repeat=length):
            yield "".join(letters) + "_"


def as_many(pattern: str, room: int) -> str:
    """The pattern with one name after another, until there is no more room."""
    parts = []
    for name in names():
        part = pattern.replace("NAME", name)
        room -= len(part)
        if room < 0:
            return "".join(parts)
        parts.append(part)
    raise AssertionError


def notebook(*sources: object, **more: object) -> str:
    cells = [{"cell_type": "code", "source": source, "metadata": {}, "outputs": []} for source in sources]
    return json.dumps({"cells": cells, "nbformat": 4, "metadata": {}, **more})


PYTHON: dict[str, Callable[[int], str]] = {
    "a chain of functions": lambda room: WRONG + as_many("def NAME(): NAME\n", room),
    "a chain of thousands": lambda room: WRONG + "".join(f"def a{n}(): a{n + 1}\n" for n in range(room // 21)),
    "names of one line": lambda room: (
        f"{as_many('NAME=1;', room // 2)}\ndef rebound_velocity(u, e):\n {as_many('NAME;', room // 2)}\n"
    ),
    "scopes in a function": lambda room: f"{DEF} {'lambda:0;' * (room // 18)}{as_many('NAME;', room // 2)}\n",
    "scopes in a class": lambda room: f"{WRONG}class A:\n {'lambda:0;' * (room // 18)}{as_many('NAME;', room // 2)}\n",
    "functions in a function": lambda room: (
        f"{DEF}{as_many(' def NAME():0' + chr(10), room // 2)} {as_many('NAME;', room // 2)}\n"
    ),
    "its own name on every line": lambda room: WRONG * (room // len(WRONG)),
    "one name on every line": lambda room: "f=1\n" * (room // 4 - 100) + WRONG,
    "changes of one object": lambda room: "a={}\n" + "a[0]=1\n" * (room // 7 - 100) + WRONG.replace("0.0", "a"),
    "names for one object": lambda room: (
        "a=[]\n" + "".join(f"a{n}=a{max(n - 1, 0)}\n" for n in range(room // 17)) + WRONG.replace("0.0", "a0")
    ),
    "a value that is made of many names": lambda room: (
        f"a=[{as_many('NAME,', room // 2)}]\n" + "b=a\n" * (room // 9) + WRONG.replace("0.0", "a")
    ),
    "functions of one name and their calls": lambda room: (
        "a=[]\n" + "def f(a):a[0]=a\n" * (room // 32) + "f(a)\n" * (room // 10) + WRONG.replace("0.0", "a")
    ),
    "parameters for a star": lambda room: (
        f"a=[]\ndef f({as_many('NAME,', room // 2)[:-1]}):aa_[0]=1\n"
        + "f(*a)\n" * (room // 12)
        + WRONG.replace("0.0", "a")
    ),
    "functions that are given to one": lambda room: (
        f"{as_many('def NAME(a):a[0]=1' + chr(10), room // 2)}list(map({as_many('NAME,', room // 4)}))\n" + WRONG
    ),
    "methods of a value of methods": lambda room: (
        ("a" + ".pop()" * 800 + "\n") * (room // 4802) + WRONG.replace("0.0", "a")
    ),
    "methods that change one object": lambda room: (
        f"class A:\n{as_many(' def NAME(s):s.x.append(1)' + chr(10), room)}a=A()\n" + WRONG.replace("0.0", "a.x")
    ),
    "decorators": lambda room: "@rebound_velocity\n" * (room // 20) + WRONG,
    "stars": lambda room: "from math import *\n" * (room // 20) + WRONG,
    "lines joined by backslashes": lambda room: WRONG.replace("0.0", "0.0" + "\\\n" * 50_000),
    "magics": lambda room: "%a\n" * (room // 3 - 100) + WRONG,
    "what could become a magic": lambda room: ("a," * 20 + "\n") * (room // 42 - 10) + "%x\n" + WRONG,
    "texts that never end": lambda room: "%x\n" + "'''a\n" * (room // 5 - 100) + WRONG,
    "brackets": lambda room: WRONG.replace("0.0", "(" * 90_000 + "0.0"),
    "braces": lambda room: WRONG + "{" * (BRACE_LIMIT + 1),
    "braces in a text": lambda room: WRONG.replace("0.0", "f'" + "{u" * 4000 + "'"),
    "a sum of thousands": lambda room: WRONG.replace("0.0", "+".join(["0.0"] * 20_000)),
    "blocks in blocks": lambda room: (
        "".join(" " * depth + "if 1:\n" for depth in range(99)) + " " * 99 + "x = 1\n" + WRONG
    ),
    "a number of a megabit": lambda room: WRONG.replace("0.0", "0x" + "f" * 200_000),
    "a number of too many digits": lambda room: WRONG.replace("0.0", "9" * 5000),
    "a name of a hundred thousand letters": lambda room: WRONG + "ε" * 100_000 + " = 1\n",
    "a merge": lambda room: "<<<<<<< HEAD\n" + WRONG + "=======\n" + WRONG + ">>>>>>> other\n",
    "a page": lambda room: WRONG.replace("return", "\f return") + "\f" * 10_000,
    "carriage returns alone": lambda room: WRONG.replace("\n", "\r") * 100,
    "marks of direction": lambda room: "\u202e\u2066" * 100 + WRONG,
    "misspelt thousands of times": lambda room: as_many("def rebound_velocity_NAME(): 0\n", room),
}
LONG_ONES = {
    "a chain of functions", "scopes in a class", "functions in a function", "its own name on every line",
    "one name on every line", "changes of one object", "decorators", "stars", "magics", "what could become a magic",
    "brackets", "a sum of thousands", "parameters for a star", "functions of one name and their calls",
    "methods of a value of methods", "a value that is made of many names", "names for one object",
    "misspelt thousands of times", "methods that change one object",
}  # fmt: skip
"""Sources whose length alone takes a second of Python's own reading."""
OTHERS: dict[str, tuple[str, Callable[[], str | bytes]]] = {
    "NUL": (".py", lambda: WRONG + "\0"),
    "UTF-16": (".py", lambda: WRONG.encode("utf-16")),
    "UTF-7 by its own word": (".py", lambda: b"# coding: utf-7\n" + WRONG.encode() + b"+AGEA"),
    "code in an encoding that decodes escapes": (".py", lambda: b"# coding: unicode_escape\n" + WRONG.encode()),
    "no text at all": (".py", lambda: bytes(range(1, 256)) * 1000),
    "a zip archive": (".py", lambda: b"PK\3\4" + WRONG.encode()),
    "11 MB": (".py", lambda: b"#" * 11 * 2**20),
    "a notebook by another name": (".py", lambda: notebook(WRONG)),
    "brackets in JSON": (".ipynb", lambda: '{"cells": ' + "[" * 10**6),
    "a number in JSON": (".ipynb", lambda: notebook(WRONG)[:-1] + ', "n": ' + "9" * 10**6 + "}"),
    "lists in JSON": (".ipynb", lambda: notebook(WRONG)[:-1] + ', "n": [' + "[]," * 10**5 + "0]}"),
    "thousands of cells": (".ipynb", lambda: notebook(*[WRONG] * 2001)),
    "thousands of broken cells": (".ipynb", lambda: notebook(*["def rebound_velocity(u, e:\n"] * 1999, WRONG)),
    "a cell of lists": (".ipynb", lambda: notebook([[WRONG], {"a": 1}, None, WRONG])),
    "a cell of half a character": (".ipynb", lambda: notebook(WRONG + "# \ud800")),
    "a cell with escapes": (".ipynb", lambda: notebook(WRONG, "\x1b[2J\u202e(\n")),
    "a cell with NUL": (".ipynb", lambda: notebook(WRONG, "x = '\0'")),
    "lines of a million pieces": (".ipynb", lambda: notebook(["#"] * 200_000, WRONG)),
    "tags that are none": (".ipynb", lambda: notebook(WRONG).replace("{}", '{"tags": [[], 1e999]}')),
    "a file's name for markup": ("\x1b[2J\n✓ <b>.py", lambda: WRONG),
}  # fmt: skip


def said(path: Path, grader: Grader) -> str:
    """Everything that is said of a file and of its function; the function must not be right."""
    try:
        submission = read(path, ["rebound_velocity", "collide"])
    except UnreadableSubmission as error:
        return str(error)
    told = [submission.name, *map(str, submission.complaints), *submission.uses("rebound_velocity")]
    told += submission.borrows("rebound_velocity")
    with Remote(submission, grader) as remote, remote.fresh() as call:
        try:
            answer = call("rebound_velocity", -2.0, 0.5)
            assert answer != 1.0
        except StudentError as error:
            told.append(str(error))
    return "\n".join(told)


def check(path: Path, content: str | bytes, grader: Grader, longest: float) -> None:
    """Read the file, in so many seconds of processor time, and look at what is said of it."""
    path.write_bytes(content.encode("utf-8", "surrogatepass") if isinstance(content, str) else content)
    began = time.process_time()
    told = said(path, grader)
    assert time.process_time() - began < longest
    assert all(character.isprintable() or character == "\n" for character in told)


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.slow if name in LONG_ONES else ()) for name in PYTHON]
)
def test_a_hostile_source_is_read_soon_and_earns_nothing(name, grader, tmp_path):
    check(tmp_path / "lab.py", PYTHON[name](A_SIXTH), grader, LONG / 4)


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.slow if name == "a chain of functions" else pytest.mark.weekly)
        for name in PYTHON
    ],
)
def test_the_longest_hostile_source_is_read_in_seconds(name, grader, tmp_path):
    check(tmp_path / "lab.py", PYTHON[name](ROOM), grader, LONG)


@pytest.mark.parametrize("name", OTHERS)
def test_a_hostile_file_of_another_kind_earns_nothing(name, grader, tmp_path):
    ending, made = OTHERS[name]
    check(tmp_path / f"lab{ending.replace('/', '')}", made(), grader, LONG)


@pytest.mark.parametrize("kind", ["folder", "pipe", "link to a device", "nothing", "not allowed"])
def test_what_is_no_file_is_an_error_that_names_it(kind, grader, tmp_path):
    path = tmp_path / "lab.py"
    with contextlib.ExitStack() as after:
        if kind == "folder":
            path.mkdir()
        elif kind == "pipe":
            os.mkfifo(path)
        elif kind == "link to a device":
            path.symlink_to("/dev/zero")
        elif kind == "not allowed":
            if os.geteuid() == 0:
                pytest.skip("root may read everything")
            path.write_text(WRONG)
            path.chmod(0)
            after.callback(path.chmod, 0o600)
        for topics in (None, ["impulse"]):
            with pytest.raises(UnreadableSubmission, match=r"^lab\.py: (it|there) "):
                grade(path, topics, ["visible"], grader)


@pytest.mark.slow
def test_when_the_time_is_up_the_rest_says_so_and_a_grade_is_written(grader, tmp_path):
    names = ["signed_distance", "side_of_plane", "overlap_interval", "missing_probability", "time_of_impact_exact"]
    text = "import time\n" + "".join(f"def {name}(*given): time.sleep(0.3)\n" for name in names)
    (tmp_path / "lab.py").write_text(text)
    began = time.monotonic()
    found = grade(tmp_path / "lab.py", ["detection"], ["visible"], grader, seconds=1.5)
    assert time.monotonic() - began < 30
    found.write(tmp_path / "grade.json")
    content = read_grade(tmp_path / "grade.json")
    assert content["got"] == 0
    assert "not tried" in {function["verdict"] for function in content["functions"]}
    assert "the 1.5 s that the whole file has are used up" in json.dumps(content)
    assert all(test["message"] or all(part["message"] for part in test["parts"]) for test in content["tests"])


@pytest.mark.slow
def test_a_slow_helper_is_suspect_and_costs_its_callers_nothing(grader, tmp_path):
    path = solved(tmp_path, "impulse")
    path.write_text(
        path.read_text().replace("def normal_velocity(", "def quick(")
        + "import time\ndef normal_velocity(*given):\n    time.sleep(0.05)\n    return quick(*given)\n"
    )
    sheet = grade(path, ["impulse"], grader=grader, seconds=9.0).sheet
    assert (sheet.lost, [*sheet.suspects]) == ([], ["normal_velocity"])
    assert "is too slow on other input" in "\n".join(report(sheet, ["impulse"]))


def test_a_budget_that_is_used_up_tries_nothing(grader, tmp_path):
    (tmp_path / "lab.py").write_text(WRONG)
    with (
        Remote(read(tmp_path / "lab.py", ["rebound_velocity"]), grader, Budget(1e-9)) as remote,
        remote.fresh() as call,
        pytest.raises(NotTried, match="used up"),
    ):
        call("rebound_velocity", -2.0, 0.5)
