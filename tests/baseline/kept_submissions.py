"""The submissions that the project keeps, laid out as classes that `collisions grade` takes: FOLDER/CLASS/NAME/FILE.

A class has the name of its lab; the hostile files are a class of their own, in the lab on detection.

- Every wrong answer of `tests/autograder/students` is put into a file with the solutions of its lab, in place of the
  right function. So a student hands it in, and so the grade also says which other functions suffer from it.
- The right answers are the solutions, as a file and as a notebook, and all of `tests/autograder/alternatives`.
- The untouched files are the stubs and the notebook that a student starts from.
- The attacks of `tests/labs/grading/hostile` look for `rebound_velocity`, which no student writes. Here they have the
  name of `side_of_plane`, which takes two numbers as well. What they are after is replaced by places that do not exist.
"""

from __future__ import annotations

import ast
import importlib
import re
import runpy
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

HOSTILE, HOSTILE_LAB = "hostile", "detection"
ATTACKED, TARGET = "rebound_velocity", "side_of_plane"
AIMS = {"SECRET": "/nowhere/secret.py", "RESULTS": "/nowhere/results.json", "FOLDER": "/nowhere", "ROOT": "/nowhere",
        "GRADER": str(2**22 + 1), "PORT": "9"}  # fmt: skip
"""In place of the tests' own folders, process and port: no process has so large a number."""
BY_CHANCE = ("attack random_answers",)
"""Submissions whose answers are other ones in every run."""


class Kept(NamedTuple):
    """One submission. group: its class. name: of the student who hands it in. file: its name."""

    group: str
    name: str
    file: str
    content: str | bytes


def write(root: Path, folder: Path) -> None:
    """Write all submissions of a checkout; its packages and the folder `tests/labs` can be imported."""
    for kept in (*right_and_untouched(), *alternatives(root), *wrong(root), *hostile(root)):
        path = folder / kept.group / kept.name / kept.file
        path.parent.mkdir(parents=True)  # an error if two submissions have one name
        content = kept.content if isinstance(kept.content, bytes) else kept.content.encode("utf-8", "surrogatepass")
        path.write_bytes(content)


def right_and_untouched() -> Iterator[Kept]:
    """Return the solutions and what a student starts from, of each lab."""
    from reference import lecture  # noqa: PLC0415 - from the checkout, which is known when this runs

    notebooks, made = importlib.import_module("labs.building.notebooks"), importlib.import_module("submissions")
    with TemporaryDirectory() as folder:
        for topic in (topic.name for topic in lecture.TOPICS):
            yield Kept(topic, "right solutions", f"{topic}.py", made.solved(Path(folder), topic).read_bytes())
            yield Kept(topic, "right notebook", f"{topic}.ipynb", notebooks.text(notebooks.solved(topic)))
            yield Kept(topic, "untouched stubs", f"{topic}.py", made.stubs(Path(folder), topic).read_bytes())
            yield Kept(topic, "untouched notebook", f"{topic}.ipynb", notebooks.text(notebooks.student(topic)))


def alternatives(root: Path) -> Iterator[Kept]:
    """Return the right answers in other words: whole files, one of them in all formats, and some functions alone."""
    whole = runpy.run_path(str(root / "tests/labs/grading/test_right_alternatives.py"))
    with TemporaryDirectory() as folder:
        for name in whole["FILES"]:
            for written in whole["FORMATS"]:
                if written.__name__ == "unchanged" or name in whole["OFTEN"]:
                    path, topic = whole["stored"](name, written, Path(folder)), whole["topic_of"](name)
                    content = path.read_bytes()
                    yield Kept(topic, f"right {name} {written.__name__}", f"{topic}{path.suffix}", content)
    for path in sorted((root / "tests/autograder/alternatives").glob("*.py")):
        text, by_topic = path.read_text(encoding="utf-8"), dict[str, dict[str, str]]()
        for node in ast.parse(text).body:
            if isinstance(node, ast.FunctionDef) and (topic := topic_of(node.name)):
                by_topic.setdefault(topic, {})[node.name] = text
        for topic, own in by_topic.items():
            yield Kept(topic, f"right {path.stem}", f"{topic}.py", in_solutions(topic, own))


def wrong(root: Path) -> Iterator[Kept]:
    """Return the wrong answers that others wrote, each in the solutions of its lab, and a file with three of them."""
    short = (root / "tests/labs/abbreviations.py").read_text(encoding="utf-8")
    for path in sorted((root / "tests/autograder/students").rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        for node in ast.parse(text).body:
            if isinstance(node, ast.FunctionDef) and re.search(r"_\d+$", node.name):
                name = re.sub(r"_\d+$", "", node.name)
                own = re.sub(rf"\b{node.name}\b", name, f"{short}\n\n{text}" if "abbreviations" in text else text)
                yield Kept(topic_of(name), node.name, f"{topic_of(name)}.py", in_solutions(topic_of(name), {name: own}))
    whole = runpy.run_path(str(root / "tests/labs/grading/test_whole_files.py"))
    yield Kept("impulse", "three mistakes", "impulse.py", whole["THREE_MISTAKES"])
    yield Kept(HOSTILE, "endless loop", f"{HOSTILE_LAB}.py", whole["ENDLESS"])


def topic_of(name: str) -> str:
    """Return the lab in which a student writes a function; empty if there is none."""
    from reference import lecture  # noqa: PLC0415

    entry = lecture.FUNCTIONS.get(name)
    return entry.topic if entry is not None and entry.role == "written" else ""


def in_solutions(topic: str, own: Mapping[str, str]) -> str:
    """Return the solutions of a lab as one file, with some functions from the texts in which others wrote them."""
    from labs.gradebook.similarity import function_in  # noqa: PLC0415
    from labs.grading.submission.excerpts import text_of  # noqa: PLC0415
    from reference import lecture  # noqa: PLC0415

    found = {name: function_in(text, name) for name, text in own.items()}
    used = {node.id for text in found.values() for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Name)}
    imported = {
        alias.name
        for text in dict.fromkeys(own.values())
        for node in ast.parse(text).body
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("solutions")
        for alias in node.names
    }
    wanted = [entry.name for entry in lecture.functions_of(topic) if entry.role != "read"]
    wanted += sorted(imported & used - {*wanted})
    excerpts, imports = _excerpts(topic)
    right = [each for each in excerpts.needed(wanted) if each.defines.isdisjoint(own)]
    taken = {name for each in right for name in each.defines}
    for helper in sorted(taken & {name for text in found.values() for name in _defined_in(text)}):
        found = {name: re.sub(rf"\b{helper}\b", f"{helper}_of_mine", text) for name, text in found.items()}
    head = f"from __future__ import annotations\n\n{imports}"
    texts = dict.fromkeys(part for text in found.values() for part in text.split("\n\n\n"))  # each helper once
    return "\n\n\n".join([head, text_of(right), *texts]) + "\n"


@cache
def _excerpts(topic: str) -> tuple[Any, str]:
    """Return the solutions of a lab and the imports that they need, which take a while to read."""
    from labs.grading.submission.excerpts import TopicExcerpts, imports_of  # noqa: PLC0415

    found = TopicExcerpts.of(topic)
    return found, imports_of(found.every)


def _defined_in(text: str) -> Iterator[str]:
    """Return the names that the statements of a text define."""
    for node in ast.parse(text).body:
        if isinstance(node, ast.FunctionDef):
            yield node.name
        elif isinstance(node, ast.Assign):
            yield from (target.id for target in node.targets if isinstance(target, ast.Name))


def hostile(root: Path) -> Iterator[Kept]:
    """Return the attacks on the grader, and the files that attack their reader."""
    tests = root / "tests/labs/grading"
    for path in sorted((tests / "hostile").glob("*.py")):
        text = path.read_text(encoding="utf-8")
        for name, value in AIMS.items():
            text = text.replace("{" + name + "}", value)
        yield Kept(HOSTILE, f"attack {path.stem}", f"{HOSTILE_LAB}.py", text.replace(ATTACKED, TARGET))
    files = runpy.run_path(str(tests / "test_hostile_files.py"))
    for name, made in files["PYTHON"].items():
        text = made(files["A_SIXTH"]).replace(ATTACKED, TARGET)
        yield Kept(HOSTILE, f"source {name}", f"{HOSTILE_LAB}.py", text)
    for name, (ending, made) in files["OTHERS"].items():
        content = made()
        content = content.encode("utf-8", "surrogatepass") if isinstance(content, str) else content
        content = content.replace(ATTACKED.encode(), TARGET.encode())
        yield Kept(HOSTILE, f"file {name}", f"{HOSTILE_LAB}{ending.replace('/', '')}", content)
