"""A lesson: the text of one lab in Markdown (jupytext), with places for what is made of the solutions.

A cell's metadata says what it becomes. Code: `lab="setup"`, the first cell, which finds the lab, with `lends="f g"` for
functions of later labs that its runs need; `given="finite Body"`, code to use; `write="signed_distance"`, functions to
write, each in a cell with a check; `broken="key"`, code that a student mends, with `model="key"` for how. Text:
`answer="key" points=3`, a question; `model="key"`, what a good answer says and how it is marked; `instructor=true`, for
the instructor alone. Everything else stands as it is in both notebooks, but that `guess="0.25 | 'up'"` of a code cell
takes the place of the dots of its predictions, one after the other, in the solved one.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from labs.project_folders import LESSONS
from reference import lecture
from reference.errors import InvalidInput

OPEN = "answer=..."
"""Where a student puts a prediction."""
_KINDS = ("lab", "given", "write", "broken", "answer", "model", "instructor")


@dataclass(frozen=True)
class Cell:
    """A cell of a lesson. kind: one of those above, empty for one that stands as it is. value: what it says of it."""

    code: bool
    text: str
    kind: str = ""
    value: str = ""
    points: int = 0
    lends: str = ""
    guess: str = ""

    @property
    def guessed(self) -> str:
        """Its text with a good guess in place of the dots of each prediction."""
        first, *others = self.text.split(OPEN)
        guesses = [each.strip() for each in self.guess.split("|")] if others else []
        return first + "".join(f"answer={guess}{rest}" for guess, rest in zip(guesses, others, strict=True))

    @property
    def names(self) -> tuple[str, ...]:
        """The functions that it gives, or has written."""
        return tuple(self.value.split())


@dataclass(frozen=True)
class Lesson:
    """The lesson of a topic."""

    topic: str
    cells: tuple[Cell, ...] = field(repr=False)

    @property
    def written(self) -> tuple[str, ...]:
        """The functions that it has written, in its order."""
        return tuple(name for cell in self.cells if cell.kind == "write" for name in cell.names)

    @property
    def given(self) -> tuple[str, ...]:
        """What it gives, in its order."""
        return tuple(name for cell in self.cells if cell.kind == "given" for name in cell.names)

    @property
    def lent(self) -> tuple[str, ...]:
        """The functions of other labs that its runs need before these are taught."""
        return tuple(name for cell in self.cells for name in cell.lends.split())

    def models(self, key: str) -> tuple[Cell, ...]:
        """What belongs to a question or a broken cell."""
        return tuple(cell for cell in self.cells if cell.kind == "model" and cell.value == key)


def lessons() -> tuple[str, ...]:
    """The topics that have a lesson, in the order of teaching."""
    return tuple(topic.name for topic in lecture.TOPICS if (LESSONS / f"{topic.name}.md").is_file())


def read(topic: str) -> Lesson:
    """Read a lesson.

    Raises
    ------
    UnknownName, InvalidInput
        If there is no such topic, it has no lesson yet, or the lesson does not fit the lecture: a function that the
        lecture has students write and the lesson does not, or out of order, or a question without a model answer.
    """
    try:
        import jupytext  # noqa: PLC0415 - who only opens notebooks needs it not
    except ImportError:
        raise InvalidInput('lessons are read with jupytext: pip install -e ".[dev]"') from None

    name = lecture.topic(topic).name
    path = LESSONS / f"{name}.md"
    if not path.is_file():
        raise InvalidInput(f"{name} has no lesson yet; there are lessons of {', '.join(lessons())}")
    lesson = Lesson(name, tuple(_cell(cell) for cell in jupytext.read(path).cells))
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
    if not kinds:
        return Cell(code, text, guess=str(metadata.get("guess", "")))
    points, lends = int(metadata.get("points", 0)), str(metadata.get("lends", ""))
    return Cell(code, text, kinds[0], str(metadata[kinds[0]]), points, lends)


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
        guesses = len(cell.guess.split("|")) if cell.guess else 0
        if guesses != (asked := cell.text.count(OPEN)):
            raise InvalidInput(
                f"the lesson of {lesson.topic} has guess={cell.guess!r} for {asked} predictions: {cell.text}"
            )
    for cell in lesson.cells:
        if cell.kind in ("answer", "broken") and not lesson.models(cell.value):
            raise InvalidInput(f"the lesson of {lesson.topic} has no model for {cell.kind}={cell.value!r}")
