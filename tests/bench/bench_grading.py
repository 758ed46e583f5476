"""Grading one submission of the impulse lab: ours beside otter-grader and nbgrader, with the same tests.

The submission is a notebook with the solutions. The rivals get every call that our tests make of it, test by test, with
the answer as an assert: the inputs that ours has to draw and the answers that it has to work out are given to them.
"""

from __future__ import annotations

import atexit
import contextlib
import json
import re
import shutil
import sqlite3
import sys
import tempfile
import zipfile
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from labs.benching.programs import Environment, Run, run
from labs.benching.timing import Bench
from labs.grading.calling.calls import Call
from labs.grading.judging.grade import read_grade
from reference.errors import RunFailed

ROOT = Path(__file__).resolve().parents[2]
TESTS = [ROOT / "tests" / "autograder" / folder / "test_impulse.py" for folder in ("visible", "hidden")]
TOPIC = ("body", "points", "normals", "inertia", "momentum", "impact", "auditing")
SOLUTIONS = ("arrays", "checks", "domain", "vectors", *(f"impulse/{name}" for name in TOPIC))
NUMPY = f"numpy=={np.__version__}"
OTTER = Environment("otter", ("otter-grader==7.0.0", "ipykernel", NUMPY))
NBGRADER = Environment("nbgrader", ("nbgrader==0.9.6", NUMPY))
HEADER = "import numpy as np\nfrom numpy import inf, nan\n"
IMPORTS = re.compile(r"^from (solutions|__future__)[\w.]* import (?:\([^)]*\)|.*)\n", re.MULTILINE)

CLASS = 20
GRADE = """
import sys
from pathlib import Path
from labs.grading.judging.grade import grade
from labs.grading.calling.remote import Grader

with Grader() as grader:
    for submission in map(Path, sys.argv[1:]):
        grade(submission, ["impulse"], grader=grader).write(submission.with_suffix(".json"))
"""

Asserts = dict[str, list[str]]
"""Our tests by name with their calls, each as an assert."""


def notebook(cells: list[tuple[str, dict[str, Any]]]) -> str:
    """Code cells with their metadata as a notebook."""
    return json.dumps(
        {
            "nbformat": 4,
            "nbformat_minor": 5,
            "metadata": {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}},
            "cells": [
                {"cell_type": "code", "id": f"cell-{place}", "source": source, "metadata": metadata, "outputs": [],
                 "execution_count": None}
                for place, (source, metadata) in enumerate(cells)
            ],
        }
    )  # fmt: skip


def solution_cells() -> list[str]:
    """The solutions of the topic as the cells of a student, who imports nothing of ours."""
    return [IMPORTS.sub("", (ROOT / "solutions" / f"{name}.py").read_text(encoding="utf-8")) for name in SOLUTIONS]


def written(folder: Path) -> Path:
    """The submission, written to a folder."""
    path = folder / "impulse.ipynb"
    path.write_text(notebook([(cell, {}) for cell in solution_cells()]), encoding="utf-8")
    return path


# Ours


def graded(*submissions: Path) -> Run:
    """Grade them by our tests, one after another; raises `RunFailed` unless each has all points."""
    found = run([sys.executable, "-c", GRADE, *submissions], ROOT, {"PYTHONDONTWRITEBYTECODE": ""})  # as installed
    for submission in submissions:
        grade = read_grade(submission.with_suffix(".json"))
        _full(found, grade["got"], grade["possible"])
    return found


def ours() -> Callable[[], Run]:
    submission = written(a_folder())
    return lambda: graded(submission)


def one_by_one() -> Callable[[], Run]:
    submissions = [written(a_folder()) for _ in range(CLASS)]
    return lambda: graded(*submissions)


def two_at_a_time() -> Callable[[], list[Run]]:
    submissions = [written(a_folder()) for _ in range(CLASS)]

    def grade() -> list[Run]:
        with ThreadPoolExecutor(2) as pool:
            return list(pool.map(lambda half: graded(*half), (submissions[::2], submissions[1::2])))

    return grade


def a_folder() -> Path:
    """An empty folder that is there as long as the process."""
    made = tempfile.mkdtemp(prefix="bench-grading-")
    atexit.register(shutil.rmtree, made, ignore_errors=True)
    return Path(made)


# The same tests, as others write them


class Recorder:
    """A plugin for pytest that writes down what the tests call, and what they are given."""

    def __init__(self) -> None:
        self.asserts: Asserts = {}
        self._test = ""

    def pytest_runtest_setup(self, item: pytest.Item) -> None:
        self._test = item.name.removeprefix("test_")

    def note(self, name: str, arguments: tuple[Any, ...], answer: Any) -> None:
        call = f"{name}({', '.join(map(literal, arguments))})"
        parts = {f"[{place}]": part for place, part in enumerate(answer)} if isinstance(answer, tuple) else {"": answer}
        found = self.asserts.setdefault(self._test, [])
        found.append(f"answer = {call}")
        found += [
            f"assert np.allclose(answer{place}, {literal(part)}, equal_nan=True)" for place, part in parts.items()
        ]


def literal(value: Any) -> str:
    """A value as a person writes it."""
    if isinstance(value, tuple):
        return f"({''.join(f'{literal(part)}, ' for part in value)})"
    if isinstance(value, np.ndarray | np.generic):
        return f"np.array({value.tolist()!r})" if value.ndim else repr(value.tolist())
    return repr(value)


def recorded(submission: Path) -> Asserts:
    """What our tests ask of the submission, found in a process of its own."""
    notes = submission.with_name("asserts.json")
    run([sys.executable, __file__, submission, notes], ROOT, {"PYTHONPATH": str(ROOT)})
    found: Asserts = json.loads(notes.read_text(encoding="utf-8"))
    return found


def record(submission: str, notes: str) -> int:
    """Run our tests and write what they call to a file."""
    recorder, called = Recorder(), Call.__call__

    def call(self: Call, name: str, /, *arguments: Any, **named: Any) -> Any:
        answer = called(self, name, *arguments, **named)
        recorder.note(name, (*arguments, *named.values()), answer)
        return answer

    Call.__call__ = call  # type: ignore[method-assign]
    options = ["-q", "-p", "no:cacheprovider", *map(str, TESTS), "--submission", submission]
    code = pytest.main(options, plugins=[recorder])
    Path(notes).write_text(json.dumps(recorder.asserts), encoding="utf-8")
    return int(code)


# Others


def plain_python() -> Callable[[], Run]:
    """What no grader can do without: the interpreter, NumPy, and the submission's own time for these calls."""
    folder = a_folder()
    script = folder / "calls.py"
    asserts = [line for lines in recorded(written(folder)).values() for line in lines]
    cells = "\n".join(solution_cells())
    script.write_text("\n".join(["from __future__ import annotations", HEADER, cells, *asserts]), encoding="utf-8")
    return lambda: run([sys.executable, script], folder)


def bare_pytest() -> Callable[[], Run]:
    folder = a_folder()
    (folder / "test_nothing.py").write_text("import numpy\n\n\ndef test_nothing():\n    pass\n", encoding="utf-8")
    return lambda: run([sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider"], folder)


def otter() -> Callable[[], Run]:
    program, folder = OTTER.program("otter"), a_folder()
    submission = written(folder)
    archive = folder / "autograder.zip"
    with zipfile.ZipFile(archive, "w") as made:
        made.writestr("otter_config.json", json.dumps({"show_stdout": True}))
        made.writestr("requirements.txt", "")
        for name, asserts in recorded(submission).items():
            made.writestr(f"tests/{name}.py", otter_test(name, asserts))

    def grade() -> Run:
        found = run(
            [program, "run", "--no-logo", "-a", archive, "-o", folder, submission], folder, _at(folder, program)
        )
        results = json.loads((folder / "results.json").read_text(encoding="utf-8"))["tests"]
        return _full(
            found, sum(test.get("score", 0) for test in results), sum(test.get("max_score", 0) for test in results)
        )

    return grade


def otter_test(name: str, asserts: list[str]) -> str:
    """One test of ours as a file of otter's."""
    arguments = sorted({found for line in asserts for found in re.findall(r"^answer = (\w+)\(", line)})
    body = "\n".join(f"    {line}" for line in asserts)
    head = f"from otter.test_files import test_case\n{HEADER}OK_FORMAT, name, points = False, {name!r}, 1\n"
    return f"{head}@test_case()\ndef test_it({', '.join(arguments)}):\n{body}\n"


def nbgrader() -> Callable[[], Run]:
    program, folder = NBGRADER.program("nbgrader"), a_folder()
    asserts = recorded(written(folder))
    course = folder / "course"
    for place in ("source/lab", "submitted/student/lab"):
        (course / place).mkdir(parents=True)
        (course / place / "impulse.ipynb").write_text(notebook(nbgrader_cells(asserts)), encoding="utf-8")
    environment = _at(folder, program)
    run([program, "generate_assignment", "lab", "--create"], course, environment)

    def grade() -> Run:
        found = run([program, "autograde", "lab", "--force"], course, environment)
        with contextlib.closing(sqlite3.connect(course / "gradebook.db")) as book:
            (points,) = book.execute("SELECT SUM(auto_score) FROM grade").fetchone()
        return _full(found, points, len(asserts))

    return grade


def nbgrader_cells(asserts: Asserts) -> list[tuple[str, dict[str, Any]]]:
    """The submission's cells and one for each test of ours."""

    def marked(name: str, **kind: Any) -> dict[str, Any]:
        return {"nbgrader": {"schema_version": 3, "grade_id": name, "task": False, **kind}}

    def cells() -> Iterator[tuple[str, dict[str, Any]]]:
        for place, source in enumerate(solution_cells()):
            yield source, marked(f"answer-{place}", grade=False, solution=True, locked=False)
        for name, lines in asserts.items():
            test = marked(name, grade=True, solution=False, locked=True, points=1)
            yield HEADER + "\n".join(lines), test

    return list(cells())


def _at(folder: Path, program: Path) -> dict[str, str]:
    """Where Jupyter keeps its own things: not in the user's folder; and the environment's programs come first."""
    places = {name: str(folder / name) for name in ("JUPYTER_CONFIG_DIR", "JUPYTER_RUNTIME_DIR", "IPYTHONDIR", "HOME")}
    return {**places, "PATH": str(program.parent), "PYTHONPATH": ""}


def _full(found: Run, points: float, most: float) -> Run:
    if points != most or not most:
        raise RunFailed(f"the solutions have {points} of {most} points: {found.said[-400:]}")
    return found


BENCHES = (
    Bench(
        "grading",
        "one submission of the impulse lab, from start to marks, all processes counted; the others get our inputs and "
        "answers ready made",
        ours,
        {
            "otter-grader 7.0.0": otter,
            "nbgrader 0.9.6": nbgrader,
            "pytest with NumPy, one empty test": bare_pytest,
            "plain Python, the same calls": plain_python,
        },
        goal=1.0,
        beyond="plain Python, the same calls",
        who="collisions-lab",
        environments=(OTTER, NBGRADER),
    ),
    Bench(
        "grading-class",
        f"{CLASS} such submissions one after another in one process, and in two processes at once",
        one_by_one,
        {"two at a time": two_at_a_time},
        who="one by one",
    ),
)

if __name__ == "__main__":
    sys.exit(record(*sys.argv[1:]))
