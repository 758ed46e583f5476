"""A lesson: the text of one lab in Markdown (jupytext), with places for what is made from the solutions.

A cell's metadata says what it becomes.

Code: `lab="setup"` is the first cell, which finds the lab; its `lends="f g"` names functions of later labs that its
runs need. `given="finite Body"` is code to use. `write="signed_distance"` names functions to write, each in a cell with
a check. `broken="key"` is code that a student mends; the cell with `model="key"` shows how. `draft="collide"` is the
header and description of a first version of a function, for simpler cases; the cell with `model="draft-collide"` is it.

Text: `answer="key" points=3` is a question; the cell with `model="key"` has what a good answer says, and its last
paragraph is the rubric, which begins with points: `*1 point* for …`. `instructor=true` is for the instructor only.

Everything else is the same in both notebooks, except that in the solved one the dots of a code cell's predictions, of
its lines to derive, and of inputs to find are replaced by its guesses in turn: `guess="0.25 | 'up'"`.
"""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass, field
from functools import cache

from labs.grading.submission.reading import DRAFT
from labs.project_folders import LESSONS
from reference import lecture
from reference.errors import InvalidInput

OPEN = "=..."
"""Where a student puts a prediction, or a line that is to be derived."""
_DOTS = re.compile(r"(?<==)\.\.\.|(?<=, )\.\.\.(?=[,)])")
"""These dots, and those in place of a whole argument of a call."""
_NAMING, _KEYED = ("given", "write", "draft"), ("broken", "answer", "model")
"""Kinds of cells whose metadata names functions, and kinds whose metadata is a key."""
_POINTS = re.compile(r"\*\d+ points?\*")
"""How a rubric begins."""
_KINDS = ("lab", *_NAMING, *_KEYED, "instructor")


@dataclass(frozen=True)
class Cell:
    """A cell of a lesson.

    kind: one of those above, empty for a cell that is the same in both notebooks. names: the functions that it gives,
    or has the student write. key: joins a question or a broken cell with its model. points: of a question. lends: the
    functions of later labs that its runs need. guesses: good guesses for its predictions, right lines for its
    derivations, and inputs that expose a wrong function.
    """

    code: bool
    text: str
    kind: str = ""
    names: tuple[str, ...] = ()
    key: str = ""
    points: int = 0
    lends: tuple[str, ...] = ()
    guesses: tuple[str, ...] = ()

    @property
    def guessed(self) -> str:
        """Its text with a good guess in place of the dots that a student replaces."""
        guesses = iter(self.guesses)
        return _DOTS.sub(lambda _: next(guesses), self.text)


@dataclass(frozen=True)
class Lesson:
    """The lesson of a topic."""

    topic: str
    cells: tuple[Cell, ...] = field(repr=False)

    @property
    def written(self) -> tuple[str, ...]:
        """The functions that it has the student write, in its order."""
        return tuple(name for cell in self.cells if cell.kind == "write" for name in cell.names)

    @property
    def given(self) -> tuple[str, ...]:
        """What it gives, in its order."""
        return tuple(name for cell in self.cells if cell.kind == "given" for name in cell.names)

    @property
    def drafts(self) -> tuple[str, ...]:
        """The functions of which it has the student write a first version."""
        return tuple(name for cell in self.cells if cell.kind == "draft" for name in cell.names)

    @property
    def lent(self) -> tuple[str, ...]:
        """The functions of other labs that its runs need before these are taught."""
        return tuple(name for cell in self.cells for name in cell.lends)

    def models(self, key: str) -> tuple[Cell, ...]:
        """The models of a question, a broken cell or a draft."""
        return tuple(cell for cell in self.cells if cell.kind == "model" and cell.key == key)

    def rubric(self, key: str) -> str:
        """How a question is marked: the last paragraph of its model answer, or nothing if that gives no points."""
        *_, model = self.models(key)
        last = model.text.rpartition("\n\n")[2]
        return last if _POINTS.match(last) else ""


def lessons() -> tuple[str, ...]:
    """The topics that have a lesson, in the order of teaching."""
    return tuple(topic.name for topic in lecture.TOPICS if (LESSONS / f"{topic.name}.md").is_file())


def read(topic: str) -> Lesson:
    """Read a lesson.

    Raises
    ------
    UnknownName, InvalidInput
        If there is no such topic, it has no lesson yet, or the lesson does not fit the lecture: it leaves out a
        function that students write, has them in another order, or has a question without a model answer or rubric.
    """
    name = lecture.topic(topic).name
    path = LESSONS / f"{name}.md"
    if not path.is_file():
        raise InvalidInput(f"{name} has no lesson yet; there are lessons of {', '.join(lessons())}")
    return _parsed(name, path.read_text(encoding="utf-8"))


@cache
def _parsed(name: str, text: str) -> Lesson:
    """The lesson with that text. Parsing takes longer than a test does, and each submission of a class asks for it."""
    try:
        import jupytext  # noqa: PLC0415 - only building notebooks needs it
    except ImportError:
        raise InvalidInput('lessons are read with jupytext: pip install -e ".[dev]"') from None
    lesson = Lesson(name, tuple(_cell(cell) for cell in jupytext.reads(text, fmt="md").cells))
    _refuse(lesson)
    return lesson


def _cell(cell: object) -> Cell:
    metadata, text = dict(cell.metadata), cell.source  # type: ignore[attr-defined]
    code = cell.cell_type == "code"  # type: ignore[attr-defined]
    kinds = [kind for kind in _KINDS if kind in metadata]
    unknown = set(metadata) - {*_KINDS, "points", "lends", "guess"}
    if unknown or len(kinds) > 1:
        said = ", ".join(sorted(unknown) or kinds)
        raise InvalidInput(f"a cell of the lesson says {said!r}: it may say one of {', '.join(_KINDS)}")
    kind = kinds[0] if kinds else ""
    said = str(metadata.get(kind, ""))
    guess = "" if kind else str(metadata.get("guess", ""))
    return Cell(
        code,
        text,
        kind,
        names=tuple(said.split()) if kind in _NAMING else (),
        key=said if kind in _KEYED else "",
        points=int(metadata.get("points", 0)),
        lends=tuple(str(metadata.get("lends", "")).split()),
        guesses=tuple(each.strip() for each in guess.split("|")) if guess else (),
    )


def _refuse(lesson: Lesson) -> None:
    entries = [entry for entry in lecture.functions_of(lesson.topic) if entry.role == "written"]
    expected = [entry.name for entry in entries]
    if list(lesson.written) != expected:
        odd = [name for name in (*expected, *lesson.written) if (name in expected) != (name in lesson.written)]
        raise InvalidInput(
            f"the lesson of {lesson.topic} writes {', '.join(lesson.written)}; the lecture has {', '.join(expected)}"
            + (f": look at {', '.join(odd)}" if odd else ", in this order")
        )
    for name in lesson.lent:
        lecture.function(name)
    for cell in lesson.cells:
        if len(cell.guesses) != (asked := len(_DOTS.findall(cell.text)) if cell.code else 0):
            guess = " | ".join(cell.guesses)
            raise InvalidInput(f"the lesson of {lesson.topic} has guess={guess!r} for {asked} predictions: {cell.text}")
    for cell in lesson.cells:
        if cell.kind in ("answer", "broken") and not lesson.models(cell.key):
            raise InvalidInput(f"the lesson of {lesson.topic} has no model for {cell.kind}={cell.key!r}")
        if cell.kind == "answer" and not lesson.rubric(cell.key):
            raise InvalidInput(
                f"the lesson of {lesson.topic} has no rubric for answer={cell.key!r}: the last paragraph of its model"
                " is to begin with points, such as *1 point* for the sign"
            )
    for name in lesson.drafts:
        if name not in expected:
            raise InvalidInput(f"the lesson of {lesson.topic} has a draft of {name}, which it does not write")
        if len(lesson.models(f"{DRAFT}{name}")) != lesson.drafts.count(name):
            raise InvalidInput(f"the lesson of {lesson.topic} has no model={DRAFT + name!r} for each draft={name!r}")
    for cell in lesson.cells:
        if cell.kind == "draft" and not _is_header(cell):
            raise InvalidInput(f"the draft of {' '.join(cell.names)} is to be one function with a docstring")


def _is_header(cell: Cell) -> bool:
    """Whether a cell holds the one function that it names, with a docstring and perhaps lines to begin with."""
    try:
        statements = ast.parse(cell.text).body
    except SyntaxError:
        return False
    match statements:
        case [ast.FunctionDef(name=name, body=[ast.Expr(value=ast.Constant(value=str())), *_])]:
            return cell.names == (name,)
    return False
