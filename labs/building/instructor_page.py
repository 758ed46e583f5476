"""A page for the instructor of a lab, made of its lesson, its hints and the bank of known mistakes.

It says how long each part takes and what students write in it, where they lose time and what to discuss, what is right
of each prediction, what the broken programs and the wrong functions are about, how each question is marked, and how
many mistakes the grader knows. Questions with their model answers are in the solved notebook, and the texts of the
mistakes in the bank. The pages are Markdown files in `docs/instructors/`; `collisions lab build` writes them beside the
notebooks.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass

from labs.assessment.shares import SHARES
from labs.building.lessons import Cell, Lesson, read
from labs.building.points import points_of
from labs.grading.diagnosis.misconceptions import read_bank
from labs.guidance.hint_files import Hints, hints
from reference import lecture

_PART = re.compile(r"^## (.+?)(?: \((\d+) minutes\))?$", re.MULTILINE)
_SECTION = re.compile(r"^### (?:\d+\. )?(.+)$", re.MULTILINE)


EXAMPLES = 4
"""So many known mistakes of a function are named, the first ones of the bank. No class has been counted."""


@dataclass(frozen=True)
class Part:
    """A part of a lesson: its heading, the minutes planned for it, 0 if none are, and its cells."""

    title: str
    minutes: int
    cells: tuple[Cell, ...]

    @property
    def written(self) -> str:
        """What students write in it."""
        kinds = {"write": "`{}`", "draft": "`{}`, a first version"}
        names = [kinds[cell.kind].format(name) for cell in self.cells if cell.kind in kinds for name in cell.names]
        return "; ".join(names)


def parts(lesson: Lesson) -> tuple[Part, ...]:
    """The parts of a lesson from its first heading on."""
    found: list[tuple[str, int, list[Cell]]] = []
    for cell in lesson.cells:
        heading = None if cell.code or cell.kind else _PART.search(cell.text)
        if heading:
            found.append((heading[1], int(heading[2] or 0), []))
        if found:
            found[-1][2].append(cell)
    return tuple(Part(title, minutes, tuple(cells)) for title, minutes, cells in found)


def page(topic: str) -> str:
    """The page of a lab.

    Raises
    ------
    InvalidInput
        If the lab has no lesson, or the lesson does not fit the lecture.
    """
    lesson, found = read(topic), hints(topic)
    sections = (
        _hours(lesson), _notes(lesson), _predictions(lesson, found), _broken(lesson), _exposed(lesson),
        _questions(lesson), _mistakes(lesson),
    )  # fmt: skip
    return "\n\n".join(text for section in sections for text in section) + "\n"


def _hours(lesson: Lesson) -> Iterator[str]:
    title = lecture.topic(lesson.topic).title
    planned = sum(part.minutes for part in parts(lesson))
    yield f"# {title}: for the instructor"
    yield (
        f"`collisions lab build` writes this page from the lesson, the hints and the known mistakes of the lab"
        f" `{lesson.topic}`. It has answers: a student's release does not contain it."
    )
    kinds = ", ".join(f"{points} for {kind}" for kind, points in SHARES.items())
    yield (
        f"The lab is planned for {planned / 60:.2g} hours, and no class has been timed yet ([how the minutes were"
        f" found](../notebooks.md#how-long-a-lab-takes)). Of a hundred points there are {kinds}"
        " ([marking](../grading.md#what-a-mark-is-made-of))."
    )
    rows = [f"| {part.title} | {part.minutes} | {part.written} |" for part in parts(lesson) if part.minutes]
    yield "\n".join(["| part | minutes | students write |", "|---|---|---|", *rows])


def _notes(lesson: Lesson) -> Iterator[str]:
    yield "## Where students lose time, and what to discuss"
    place = "Before the lab"
    for cell in lesson.cells:
        if cell.kind == "instructor":
            yield f"**{place}.** {cell.text}"
        elif not cell.code and not cell.kind and (headings := _PART.findall(cell.text)):
            place = headings[-1][0]


def _predictions(lesson: Lesson, found: Hints) -> Iterator[str]:
    yield "## Predictions"
    yield "Ask for a show of hands before each run. A wrong prediction costs nothing."
    rows = []
    for call in _calls(lesson, "predict"):
        key, question = (str(ast.literal_eval(argument)) for argument in call.args[:2])
        said = {each.arg: each.value for each in call.keywords}
        right = found.answers.get(key)
        answer = (right.said if right else "") or str(ast.literal_eval(said["answer"]))
        unit = f" {ast.literal_eval(said['unit'])}" if "unit" in said else ""
        answer = re.sub(r"^-(?=\d)", "−", answer)
        rows.append(f"| {question} | {answer}{unit} | {right.reason if right else ''} |")
    yield "\n".join(["| question | right | why |", "|---|---|---|", *rows])


def _broken(lesson: Lesson) -> Iterator[str]:
    keys = [cell.key for cell in lesson.cells if cell.kind == "broken"]
    if keys:
        yield "## Programs to mend"
        for key in keys:
            yield from (f"`{key}`. {cell.text}" for cell in lesson.models(key) if not cell.code)


def _exposed(lesson: Lesson) -> Iterator[str]:
    rows = []
    for call in _calls(lesson, "expose"):
        key, *arguments = call.args
        rows.append(f"| `{ast.literal_eval(key)}` | `{', '.join(map(ast.unparse, arguments))}` |")
    if rows:
        yield "## Wrong functions to expose"
        yield "Each is wrong in one place. An input at which it shows, of many:"
        yield "\n".join(["| function | input |", "|---|---|", *rows])


def _questions(lesson: Lesson) -> Iterator[str]:
    yield "## Questions and their rubrics"
    yield (
        "The notebook has the text of each question, and the solved notebook"
        f" `solutions/notebooks/{lesson.topic}.ipynb` has a model answer below it. `collisions grade` writes a page for"
        " each question, with both of them beside the answers of the class."
    )
    if any(cell.code and "lab.numbers(" in cell.text for cell in lesson.cells):
        yield (
            "In some questions each student has numbers of their own."
            f" `collisions lab numbers {lesson.topic} --student NAME` prints them, and the results that follow."
        )
    heading = ""
    for cell in lesson.cells:
        if not cell.code and not cell.kind and (found := _SECTION.search(cell.text)):
            heading = found[1]
        elif cell.kind == "answer":
            yield f"### {heading} ({cell.points} points)"
            yield lesson.rubric(cell.key)


def _mistakes(lesson: Lesson) -> Iterator[str]:
    """How many mistakes of each function have a name, and where their texts are."""
    yield "## Mistakes that the grader knows by name"
    yield (
        "If a student's function makes a known mistake, the feedback says what it is. After grading, `class.html` shows"
        " which mistakes several students share. The texts of all of them are in `tests/autograder/misconceptions/`."
    )
    bank, rows = read_bank(), []
    for name in lesson.written:
        known = [entry.name for entry in bank if entry.function == name]
        rows.append(f"| `{name}` | {points_of(name)} | {len(known)} | {', '.join(known[:EXAMPLES])} |")
    yield "\n".join(["| function | points | known mistakes | such as |", "|---|---|---|---|", *rows])


def _calls(lesson: Lesson, method: str) -> Iterator[ast.Call]:
    """The calls of one of the desk's methods, with good guesses in place of a student's."""
    for cell in lesson.cells:
        if cell.code and cell.guesses and f"lab.{method}(" in cell.text:
            for node in ast.walk(ast.parse(cell.guessed)):
                if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == method:
                    yield node
