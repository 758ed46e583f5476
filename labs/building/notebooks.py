"""From a lesson to two notebooks: the student's, with stubs, and the solved one, with the solutions' own text.

Both carry nbgrader's metadata, so that a JupyterHub can collect and grade them; a function's cell is known by the
function's name, which is what our own grader looks for. The same lesson and solutions make the same bytes.
"""

from __future__ import annotations

import ast
import json
import textwrap
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from typing import Any

from labs.building.excerpts import Piece, Pieces, imports_of, text_of
from labs.building.lessons import Cell, Lesson, read
from labs.building.points import points_of
from reference import lecture
from reference.errors import InvalidInput

WIDTH = 88
"""Characters of a line of a stub, as in most notebooks' own style; the linter holds the solutions' docstrings to it."""
_LEAST = 24
"""Characters from which a line of a solution gives something away; shorter ones are found in any text."""
_SETUP = """\
# Run this cell first, and after every restart: it finds the lab, and says which engines answer.
from __future__ import annotations

import sys
from pathlib import Path

here = Path.cwd()
course = here / "collisions-lab"

if "google.colab" in sys.modules:  # asks for the course's files, once for every machine that Colab lends you
    import io, zipfile
    from google.colab import files

    if not course.exists():
        print("Choose collisions-lab.zip, and with it your notebooks of earlier labs, if you have any.")
        for content in files.upload().values():
            if zipfile.is_zipfile(io.BytesIO(content)):
                zipfile.ZipFile(io.BytesIO(content)).extractall()
    if not course.exists():
        raise FileNotFoundError("That was not collisions-lab.zip: run this cell again and choose it.")
    !pip install --quiet mujoco hypothesis "pytest>=8.4"

for folder in [course, here, *here.parents]:  # the lab is above this notebook, or beside it
    if (folder / "labs" / "notebook.py").is_file():
        sys.path.insert(0, str(folder))
        break

from labs import lab  # if there is no such module: put this notebook back where it came from

lab.begin("{topic}")"""
_ANSWER = "*Your answer:* "
_KERNEL = {
    "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}


@dataclass
class _Desk:
    """What has been put into a notebook so far. had: the pieces of solutions. cells: as nbformat has them."""

    lesson: Lesson
    pieces: Pieces
    had: list[Piece] = field(default_factory=list)
    cells: list[dict[str, Any]] = field(default_factory=list)

    def add(self, kind: str, source: str, **metadata: Any) -> None:
        """Add a cell, with an id that says where it stands."""
        cell: dict[str, Any] = {
            "cell_type": kind,
            "id": f"{self.lesson.topic}-{len(self.cells):02}",
            "metadata": metadata,
            "source": source.splitlines(keepends=True),
        }
        self.cells.append(cell | ({"execution_count": None, "outputs": []} if kind == "code" else {}))

    def take(self, names: Iterable[str]) -> list[Piece]:
        """The pieces that names need and that are not there yet; they are from now on."""
        found = self.pieces.needed(tuple(names), self.had)
        self.had += found
        return found


def student(topic: str) -> dict[str, Any]:
    """The notebook that a student opens.

    Raises
    ------
    InvalidInput
        If what it gives would need, or show, the solution of what it has written.
    """
    lesson = read(topic)
    desk = _Desk(lesson, Pieces.of(topic))
    for cell in lesson.cells:
        if cell.kind == "write":
            for name in cell.names:
                _function(desk, name, stub(desk.pieces, name))
        elif cell.kind not in ("model", "instructor"):
            _common(desk, cell)
            if cell.kind == "answer":
                desk.add("markdown", _ANSWER, **_answer(cell))
    made = _notebook(desk)
    _refuse_solutions(desk, made)
    return made


def solved(topic: str) -> dict[str, Any]:
    """The instructor's: with solutions, model answers and what is for the instructor alone."""
    lesson = read(topic)
    desk = _Desk(lesson, Pieces.of(topic))
    for cell in lesson.cells:
        if cell.kind == "write":
            for name in cell.names:
                _function(desk, name, _silent(text_of(desk.take([name]))))
        elif cell.kind == "broken":
            for model in lesson.models(cell.value):
                desk.add("code" if model.code else "markdown", model.text)
        elif cell.kind == "instructor":
            desk.add("markdown", _framed("For the instructor", cell.text))
        elif cell.kind != "model":
            _common(desk, replace(cell, text=cell.guessed))
            for model in lesson.models(cell.value) if cell.kind == "answer" else ():
                desk.add("markdown", _framed("A good answer, and how it is marked", model.text), **_answer(cell))
    return _notebook(desk)


def text(notebook: dict[str, Any]) -> str:
    """A notebook as its file holds it."""
    return json.dumps(notebook, indent=1, ensure_ascii=False) + "\n"


def stub(pieces: Pieces, name: str) -> str:
    """A function as a student finds it: its own header and docstring, and an error that says whose turn it is."""
    (piece,) = (each for each in pieces.every if name in each.defines)
    function = next(node for node in ast.parse(piece.text).body if isinstance(node, ast.FunctionDef))
    end = function.body[0].end_lineno
    entry = lecture.function(name)
    said = f'"{entry.topic}, step {entry.step}: {name} is yours to write"'
    unwritten = f"    raise NotImplementedError({said})"
    if len(unwritten) > WIDTH:
        unwritten = f"    raise NotImplementedError(\n        {said}\n    )"
    return "\n".join([*piece.text.split("\n")[:end], unwritten])


def _common(desk: _Desk, cell: Cell) -> None:
    """A cell that both notebooks have alike."""
    if cell.kind == "lab":
        desk.add("code", _SETUP.replace("{topic}", desk.lesson.topic), tags=["setup"])
    elif cell.kind == "given":
        desk.add("code", _given(desk, cell), tags=["given"], jupyter={"source_hidden": True})
    else:
        desk.add("code" if cell.code else "markdown", cell.text)


def _given(desk: _Desk, cell: Cell) -> str:
    first = "" if desk.had else "from __future__ import annotations\n\n" + imports_of(desk.pieces.every) + "\n\n"
    found = desk.take(cell.names)
    shown = {name for piece in found for name in piece.defines} & set(desk.lesson.written)
    if shown:
        raise InvalidInput(f"the lesson of {desk.lesson.topic} gives {cell.value}, which needs {', '.join(shown)}")
    title = cell.text.lstrip("# ") or "Given: run it, and read what you like."
    return f"# {title}\n{first}{_silent(text_of(found))}"


def _silent(text: str) -> str:
    """A cell whose last line is the description of a value would print it."""
    return f"{text};" if text.endswith('"""') else text


def _function(desk: _Desk, name: str, text: str) -> None:
    """A function's cell and the one that checks it."""
    desk.add("code", text, tags=[name], nbgrader=_nbgrader(name, solution=True))
    check = _nbgrader(f"check-{name}", grade=True, locked=True, points=points_of(name))
    text = f"lab.check({name!r})".replace("'", '"')
    desk.add("code", text, tags=["check"], editable=False, deletable=False, nbgrader=check)


def _answer(cell: Cell) -> dict[str, Any]:
    return {"nbgrader": _nbgrader(f"answer-{cell.value}", grade=True, solution=True, points=cell.points)}


def _nbgrader(name: str, **kind: Any) -> dict[str, Any]:
    plain = {"schema_version": 3, "grade_id": name, "grade": False, "solution": False, "locked": False, "task": False}
    return {**plain, **kind}


def _framed(title: str, text: str) -> str:
    return f"**{title}**\n\n{text}"


def _notebook(desk: _Desk) -> dict[str, Any]:
    return {"cells": desk.cells, "metadata": _KERNEL, "nbformat": 4, "nbformat_minor": 5}


def _refuse_solutions(desk: _Desk, made: dict[str, Any]) -> None:
    """Raise where the student's notebook holds a line of what is for the student to write."""
    text = "\n".join("".join(cell["source"]) for cell in made["cells"])
    for piece in desk.pieces.needed(desk.lesson.written, desk.had):
        for line in _telling(piece):
            if line in text:
                raise InvalidInput(f"the student's notebook of {desk.lesson.topic} holds a solution's line: {line}")


def _telling(piece: Piece) -> Iterator[str]:
    """The lines of a piece's functions that say how it is done: neither signature nor description."""
    for function in ast.walk(ast.parse(piece.text)):
        if isinstance(function, ast.FunctionDef):
            body = function.body[bool(ast.get_docstring(function)) :]
            for line in piece.text.split("\n")[body[0].lineno - 1 : function.end_lineno]:
                if len(line.strip()) >= _LEAST:
                    yield textwrap.dedent(line).strip()
