"""A synthetic class, graded and killed again and again: everybody gets what they earned, exactly once."""

from __future__ import annotations

import ast
import json
import random
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from submissions import solved, stubs

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


def wrong_functions() -> Iterator[tuple[str, str]]:
    """Functions of the lab with a mistake, as people write them: name and source."""
    written = {entry.name for entry in lecture.functions_of("impulse") if entry.role == "written"}
    for path in sorted((AUTOGRADER / "students").rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        for node in ast.parse(text).body:
            if isinstance(node, ast.FunctionDef) and (name := re.sub(r"_\d+$", "", node.name)) in written:
                node.name = name
                yield name, ast.unparse(node)


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

    for number in range(right):
        put(NAMES[number].replace("/", "∕") if number < len(NAMES) else f"right {number}", "right", solution)
    for number in range(unwritten):
        put(f"stub {number}", "stub", stub)
    mistakes = list(wrong_functions())
    rng.shuffle(mistakes)
    for number in range(wrong):
        name, source = mistakes[number % len(mistakes)]
        put(f"wrong {number} {name}", "wrong", f"{solution}\nimport math\nimport numpy as np\n\n\n{source}\n")
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


def check_marks(folder: Path, out: str, kinds: dict[str, str]) -> None:
    """Everybody has a grade, and the one that they earned."""
    found = {json.loads(text)["identity"]["student"]: json.loads(text) for text in grades(folder / out).values()}
    assert found.keys() == kinds.keys()
    for student, kind in kinds.items():
        got = found[student].get("got", 0)
        if kind == "right":
            assert got == FULL, student
        elif kind == "wrong":
            assert 0 < got < FULL, student
        else:
            assert got == 0, student


@pytest.mark.slow
def test_a_class_that_is_killed_again_and_again_gets_what_it_earned(tmp_path):
    kinds = make_class(tmp_path, right=10, unwritten=3, wrong=12, hostile=6)
    done = subprocess.run(command(tmp_path, "whole"), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    check_marks(tmp_path, "whole", kinds)
    assert killed_again_and_again(tmp_path, "killed", 4)
    done = subprocess.run(command(tmp_path, "killed"), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert grades(tmp_path / "killed") == grades(tmp_path / "whole")


def test_the_wrong_functions_of_this_class_are_all_of_the_lab():
    assert len({name for name, _ in wrong_functions()}) >= 6
