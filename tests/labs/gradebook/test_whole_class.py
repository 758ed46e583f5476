"""A synthetic class, graded and killed again and again: everybody gets what they earned, exactly once."""

from __future__ import annotations

import ast
import builtins
import dis
import json
import random
import re
import runpy
import signal
import subprocess
import sys
import time
import types
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import pytest
from submissions import solved, stubs

from labs.gradebook.similarity import function_in
from labs.project_folders import AUTOGRADER
from reference import lecture

HOSTILE = Path(__file__).parents[1] / "grading" / "hostile"
NAMES = (
    "Zoë Müller",
    "=HYPERLINK(1)",
    "../../etc",
    "名前",
    "a" * 120,
    "o'brien; rm -rf",
    "<script>",
    "-1",
    "ada\u202egnp",
)
FULL = 66
"""Points of the functions of the impulse lab."""
RECALL = Path(__file__).parents[1] / "grading" / "diagnosis" / "test_recognition_recall.py"
KNOWN = runpy.run_path(str(RECALL))["FOUND"]
"""Of each wrong function, the verdict and the names of its mistakes when it is called on its own."""
FROM_OTHERS = {"impulse_magnitude_4", "collide_14"}
"""Alone, these may have a mistake of a function that they call. In a whole file they are seen to call none."""
CALLERS = defaultdict(set, {
    "normal_velocity": {"impulse_magnitude", "collide"},
    "inverse_effective_mass": {"impulse_magnitude", "collide"},
    "impulse_magnitude": {"collide"},
    "apply_impulse": {"collide"},
})  # fmt: skip
"""The functions of the solved lab that call another one, directly or through others."""


def wrong_functions() -> Iterator[tuple[str, str]]:
    """Functions of the lab with a mistake, as people write them: name and number, and the source with its helpers."""
    written = {entry.name for entry in lecture.functions_of("impulse") if entry.role == "written"}
    for path in sorted((AUTOGRADER / "students").rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        for node in ast.parse(text).body:
            if isinstance(node, ast.FunctionDef) and (name := plain_name(node.name)) in written:
                yield node.name, function_in(re.sub(rf"\b{node.name}\b", name, text), name)


def plain_name(numbered: str) -> str:
    """`collide` of `collide_7`."""
    return re.sub(r"_\d+$", "", numbered)


def with_wrong(solution: str, numbered: str, source: str) -> str:
    """The whole solved file with one function replaced."""
    name, lines = plain_name(numbered), solution.splitlines()
    (right,) = (node for node in ast.parse(solution).body if isinstance(node, ast.FunctionDef) and node.name == name)
    first = min([right.lineno, *(each.lineno for each in right.decorator_list)])
    lines[first - 1 : right.end_lineno] = ["import math", "import numpy as np", "", "", source]
    return "\n".join(lines)


def make_class(folder: Path, right: int, unwritten: int, wrong: int, hostile: int) -> dict[str, str]:
    """Write submissions, and say of each student what kind it is."""
    (folder / "texts").mkdir(parents=True)
    solution, stub = solved(folder / "texts", "impulse").read_text(), stubs(folder / "texts", "impulse").read_text()
    place, kinds, rng = folder / "submissions", dict[str, str](), random.Random(7)
    place.mkdir()

    def put(student: str, kind: str, text: str | bytes) -> None:
        kinds[student] = kind
        file = place / student.replace("/", "∕") / "impulse.py"
        file.parent.mkdir()
        file.write_bytes(text if isinstance(text, bytes) else f"{text}\n# {student!r}\n".encode())

    for number in range(right + unwritten):  # the first have odd names
        kind, text = ("right", solution) if number < right else ("stub", stub)
        put(NAMES[number].replace("/", "∕") if number < len(NAMES) else f"{kind} {number}", kind, text)
    mistakes = list(wrong_functions())
    rng.shuffle(mistakes)
    for number in range(wrong):
        numbered, source = mistakes[number % len(mistakes)]
        put(f"wrong {number} {numbered}", "wrong", with_wrong(solution, numbered, source))
    for number, path in enumerate(sorted(HOSTILE.glob("*.py"))[:hostile]):
        put(f"hostile {number} {path.stem}", "hostile", path.read_text().replace("rebound_velocity", "normal_velocity"))
    for number, text in enumerate((b"", b"\x89PNG\r\n", b"def collide(:", b"\xff\xfe\x00", b"{" * 30_000)):
        put(f"broken {number}", "broken", text)
    return kinds


def command(folder: Path, out: str) -> list[str]:
    arguments = [
        "grade",
        str(folder / "submissions"),
        "--lab",
        "impulse",
        "--out",
        str(folder / out),
        "--seconds",
        "30",
        "--no-runs",
    ]
    return [sys.executable, "-m", "labs", *arguments]


def grades(folder: Path) -> dict[str, bytes]:
    return {path.parent.name: path.read_bytes() for path in folder.glob("students/*/grade.json")}


def killed_again_and_again(folder: Path, out: str, kills: int) -> int:
    """Grade a class whose command is killed at random moments; how often it was."""
    rng, count = random.Random(11), 0
    while count < kills:
        running = subprocess.Popen(command(folder, out), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(rng.uniform(0.2, 4.0))
        if running.poll() is not None:
            break
        running.send_signal(rng.choice((signal.SIGKILL, signal.SIGINT, signal.SIGTERM)))
        running.wait()
        count += 1
        for text in grades(folder / out).values():
            json.loads(text)  # whole, whenever somebody looks
    return count


def check_wrong(content: dict, numbered: str) -> None:
    """One function is wrong and its mistake named, if it is known; whatever does not call it has all its points."""
    name, (verdict, mistakes) = plain_name(numbered), KNOWN[numbered]
    functions = {each["name"]: each for each in content["functions"]}
    assert functions[name]["got"] < functions[name]["possible"], numbered
    if verdict == "named" and numbered not in FROM_OTHERS:
        assert functions[name]["mistakes"] == [f"{name}/{each}" for each in mistakes], numbered
    for other in functions.keys() - {name} - CALLERS[name]:
        assert functions[other]["got"] == functions[other]["possible"], (numbered, other)


def check_marks(folder: Path, out: str, kinds: dict[str, str]) -> None:
    """Everybody has a grade, and the one that they earned."""
    found = {json.loads(text)["identity"]["student"]: json.loads(text) for text in grades(folder / out).values()}
    assert found.keys() == kinds.keys()
    for student, kind in kinds.items():
        got = found[student].get("got", 0)
        if kind == "right":
            assert got == FULL, student
        elif kind == "wrong":
            check_wrong(found[student], student.rpartition(" ")[2])
        else:
            assert got == 0, student


@pytest.mark.slow
def test_everybody_in_a_class_gets_what_they_earned(tmp_path):
    kinds = make_class(tmp_path, right=2, unwritten=7, wrong=4, hostile=2)
    done = subprocess.run(command(tmp_path, "whole"), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    check_marks(tmp_path, "whole", kinds)


@pytest.mark.weekly
def test_a_class_that_is_killed_again_and_again_gets_what_it_earned(tmp_path):
    kinds = make_class(tmp_path, right=2, unwritten=7, wrong=6, hostile=4)
    done = subprocess.run(command(tmp_path, "whole"), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    check_marks(tmp_path, "whole", kinds)
    assert killed_again_and_again(tmp_path, "killed", 3)
    done = subprocess.run(command(tmp_path, "killed"), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert grades(tmp_path / "killed") == grades(tmp_path / "whole")


def global_names(code: types.CodeType) -> set[str]:
    """The names that a function looks up outside itself, those of functions in it included."""
    own = {each.argval for each in dis.get_instructions(code) if each.opname == "LOAD_GLOBAL"}
    return own.union(*(global_names(each) for each in code.co_consts if isinstance(each, types.CodeType)))


@pytest.mark.slow
def test_no_wrong_function_of_this_class_lacks_a_helper(tmp_path):
    solution = solved(tmp_path, "impulse").read_text()
    for numbered, source in wrong_functions():
        space: dict = {}
        exec(with_wrong(solution, numbered, source), space)
        functions = [each for each in space.values() if getattr(each, "__globals__", None) is space]
        used = set().union(*(global_names(each.__code__) for each in functions))
        assert used <= space.keys() | vars(builtins).keys(), numbered


@pytest.mark.slow
def test_the_wrong_functions_of_this_class_are_all_of_the_lab():
    assert len({name for name, _ in wrong_functions()}) >= 6
