"""What a lesson still lacks of hints, figures and verdicts on predictions, and which answers it tells too early."""

from __future__ import annotations

import ast
import contextlib
from collections.abc import Iterator
from typing import Any

from labs.building.lessons import OPEN, Cell, Lesson, read
from labs.building.notebooks import student
from labs.building.revealed_answers import answers_of, compact
from labs.guidance import drawings
from labs.guidance.hint_files import LEVELS, Hints, hints
from reference.errors import InvalidInput


def gaps(topic: str) -> list[str]:
    """Everything that is missing or told too early in the lab of a topic, one line each; empty if it is complete."""
    lesson = read(topic)
    try:
        found = hints(topic)
    except InvalidInput as error:
        return [str(error)]
    return [*_hints(lesson, found), *_figures(lesson, found), *_calls(lesson, found), *_predictions(lesson, found),
            *_told(lesson)]  # fmt: skip


def _hints(lesson: Lesson, found: Hints) -> Iterator[str]:
    for name in lesson.written:
        if missing := [level for level in LEVELS if level not in dict(found.of(name).titled)]:
            yield f"hints/{lesson.topic}.md: {name} lacks {', '.join(missing)}"
    for name in found.guides:
        if name not in lesson.written:
            yield f"hints/{lesson.topic}.md: {name} is not written in the lesson"


def figures_named(lesson: Lesson, found: Hints) -> list[str]:
    """The figures that a lesson and its hints show, each once."""
    named = [name for guide in found.guides.values() for text in guide.levels for name in drawings.named_in(text)]
    named += [argument for cell in lesson.cells for argument, _ in _arguments(cell, "figure")]
    return list(dict.fromkeys(named))


def _figures(lesson: Lesson, found: Hints) -> Iterator[str]:
    """Figures that are named and cannot be shown, or lack a description."""
    for name in figures_named(lesson, found):
        try:
            drawings.drawing(name)
        except InvalidInput as error:
            yield f"figure {name}: {error}"


def _calls(lesson: Lesson, found: Hints) -> Iterator[str]:
    """Derivations that the lesson asks for and the hints do not have, and the other way round."""
    asked = [argument for cell in lesson.cells for argument, _ in _arguments(cell, "derive")]
    for cell in lesson.cells:
        for name, call in _arguments(cell, "derive"):
            lefts = [each.arg for each in call.keywords]
            for each in (each for each in found.of(name).derivations if each.left in lefts):
                if (listed := f"# Write {each.left} with {', '.join(each.names)}.") not in cell.text:
                    yield f"the lesson asks for {each.left} of {name} without a line {listed}"
    for name in dict.fromkeys(asked):
        if not found.of(name).derivations:
            yield f"the lesson calls lab.derive({name!r}), and hints/{lesson.topic}.md has no derivation of it"
    for name, guide in found.guides.items():
        if guide.derivations and name not in asked:
            yield f"the lesson never calls lab.derive({name!r})"


def _predictions(lesson: Lesson, found: Hints) -> Iterator[str]:
    """Predictions that a run is compared with and that have no reason, or no right answer among their choices."""
    asked = {key: call for cell in lesson.cells if OPEN in cell.text for key, call in _arguments(cell, "predict")}
    compared = {key for cell in lesson.cells for method in ("run", "sweep", "show") for call in _calls_of(cell, method)
                for key in _texts(_named(call, "predicted"))}  # fmt: skip
    for key, call in asked.items():
        choices = _texts(_named(call, "choices"))
        if key not in compared:
            yield f"the lesson never compares the prediction {key} with anything: predicted={key!r}"
        if key not in found.answers:
            yield f"hints/{lesson.topic}.md: no line for the prediction {key}"
        elif choices and found.answers[key].said not in choices:
            yield f"hints/{lesson.topic}.md: the answer to {key} is none of {', '.join(choices)}"
    yield from (f"hints/{lesson.topic}.md: nobody predicts {key}" for key in found.answers if key not in asked)


def _told(lesson: Lesson) -> Iterator[str]:
    """Lines that are to be derived and that the student's notebook prints."""
    cells = [compact("".join(cell["source"])) for cell in student(lesson.topic)["cells"]]
    for name in lesson.written:
        for answer in answers_of(lesson.topic, name):
            if any(answer in text for text in cells):
                yield f"the lesson of {lesson.topic} prints what is to be derived for {name}: {answer}"


def _named(call: ast.Call, name: str) -> Any:
    """The value of a named argument; nothing if it is not given."""
    return next((ast.literal_eval(each.value) for each in call.keywords if each.arg == name), ())


def _texts(value: Any) -> tuple[str, ...]:
    return (value,) if isinstance(value, str) else tuple(value)


def _arguments(cell: Cell, method: str) -> Iterator[tuple[str, ast.Call]]:
    """The first argument of each call of a method of the lab in a code cell, where it is a text, with the call."""
    for call in _calls_of(cell, method):
        yield from ((str(each.value), call) for each in call.args[:1] if isinstance(each, ast.Constant))


def _calls_of(cell: Cell, method: str) -> Iterator[ast.Call]:
    """Each call of a method of the lab in a code cell."""
    if not cell.code:
        return
    with contextlib.suppress(SyntaxError):
        for node in ast.walk(ast.parse(cell.text)):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == method:
                yield node
