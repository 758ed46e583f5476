"""The written questions of a class: collected into one page for each, marked in a table, and read back.

    grades/questions/third-law.html   the question, its rubric, and all answers in a row, names hidden
    grades/questions/points.csv       a line for each answer, to be filled in with points and a comment
    grades/questions/second.csv       every tenth answer again, for a second marker; agreement is reported

Names are replaced by short codes, which belong to this folder of grades and stay the same in every run. The order of
the answers differs from question to question, so that nobody is always read last. `marking` reads the tables.
"""

from __future__ import annotations

import hashlib
import hmac
import secrets
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import jinja2

from labs.building import lessons
from labs.building.instructor_page import parts
from labs.gradebook.marking import Given, Key, Table, read_table
from labs.gradebook.typeset import typeset
from labs.grading.judging.grade import write_private
from labs.grading.submission.cells import read_cells
from labs.grading.submission.opening import is_called_python

FOLDER, POINTS, SECOND = "questions", "points.csv", "second.csv"
SAMPLE = 10
"""Every so many answers, one goes to a second marker."""
_SECRET = ".codes"
_OPEN = "*Your answer:*"
"""What a student's notebook says where the answer goes."""
_LETTERS = ("BCDFGHJKLMNPQRSTVWXZ", 6)
"""Of a code, and how many of them: a spreadsheet takes 23E45 for a number, MAR22 for a date and FALSE for a verdict."""
_LETTERS_BEFORE = ("ABCDEFGHJKLMNPQRSTUVWXYZ23456789", 5)
"""Of a code in a folder whose secret an earlier release has made: it keeps its codes."""
_MADE = "letters "
"""With this a secret begins whose codes have letters alone."""


@dataclass(frozen=True)
class Question:
    """A question of a lab. title: its heading. text, model: Markdown, the second with the rubric."""

    key: str
    title: str
    text: str
    model: str
    points: int


def questions(lab: str) -> tuple[Question, ...]:
    """The questions of a lab in its order."""
    lesson, found, title = lessons.read(lab), [], ""
    for cell in (cell for part in parts(lesson) for cell in part.cells):
        if not cell.code and not cell.kind and cell.text.startswith("### "):
            title = cell.text.partition("\n")[0].removeprefix("### ")
        elif cell.kind == "answer":
            model = "\n\n".join(each.text for each in lesson.models(cell.key))
            found.append(Question(cell.key, title, cell.text, model, cell.points))
    return tuple(found)


def answers_in(path: Path, keys: Iterable[str]) -> dict[str, str]:
    """What a notebook says to each question; empty where it says nothing."""
    tags = {f"answer-{key}": key for key in keys}
    found = dict.fromkeys(tags.values(), "")
    for cell in read_cells(path)[0]:
        for tag in cell.tags & tags.keys():
            if not cell.code:
                found[tags[tag]] = cell.source.removeprefix(_OPEN).strip()
    return found


def is_code_alone(content: Mapping[str, Any] | None) -> bool:
    """Whether a graded file is a Python file, which has no cells of text and so no written answers."""
    if content is None or "unreadable" in content:
        return False
    file = str(content.get("identity", {}).get("file", ""))
    return is_called_python(file) and not any(content.get("answers", {}).values())


class Codes:
    """Short codes in place of names, from a secret that is kept with the grades."""

    def __init__(self, folder: Path) -> None:
        path = folder / _SECRET
        if not path.is_file():
            write_private(path, _MADE + secrets.token_hex(32))
        secret = path.read_text(encoding="utf-8").strip()
        self._letters, self._length = _LETTERS if secret.startswith(_MADE) else _LETTERS_BEFORE
        self._secret = secret.encode()

    def __call__(self, student: str) -> str:
        """The code of a student."""
        found = self._digest(student)
        return "".join(self._letters[byte % len(self._letters)] for byte in found[: self._length])

    def order(self, students: Iterable[str], question: str) -> list[str]:
        """Students in the order in which their answers to a question are read."""
        return sorted(students, key=lambda student: self._digest(f"{question} {student}"))

    def _digest(self, text: str) -> bytes:
        return hmac.new(self._secret, text.encode("utf-8", "surrogatepass"), hashlib.sha256).digest()


def write_questions(folder: Path, lab: str, answers: Mapping[str, Mapping[str, str]], code_alone: int = 0) -> None:
    """Write the pages and the tables. answers: by student, what each question got.

    code_alone: how many of the students handed in a Python file, which holds no answers.

    Raises
    ------
    InvalidInput
        If a table that is there already cannot be read.
    """
    place, codes = folder / FOLDER, Codes(folder)
    place.mkdir(exist_ok=True, mode=0o700)
    asked = questions(lab)
    template = _environment().get_template("question.html.j2")
    lines: list[tuple[str, str, int]] = []
    for question in asked:
        students = [each for each in codes.order(answers, question.key) if answers[each].get(question.key)]
        shown = [(codes(student), answers[student][question.key]) for student in students]
        page = template.render(question=question, answers=shown, students=len(answers), code_alone=code_alone)
        write_private(place / f"{question.key}.html", page)
        lines += [(question.key, code, question.points) for code, _ in shown]
    sample = [line for number, line in enumerate(lines) if number % SAMPLE == 0]
    for name, each in ((POINTS, lines), (SECOND, sample)):
        read_table(place / name, _possible(asked)).write(each)


def read_tables(folder: Path, lab: str, students: Iterable[str]) -> tuple[Table, Table]:
    """What two markers have filled in, the first and the second. students: everybody who was ever graded here.

    Raises
    ------
    InvalidInput
        If a table cannot be read, or a line is not as it has to be or has a code that none of these students has.
    """
    place, possible = folder / FOLDER, _possible(questions(lab))
    first, second = (read_table(place / name, possible) for name in (POINTS, SECOND))
    if first.given or second.given:
        codes = Codes(folder)
        known = {codes(student) for student in students}
        first.refuse_codes_of_nobody(known)
        second.refuse_codes_of_nobody(known)
    return first, second


def _possible(asked: Iterable[Question]) -> dict[str, int]:
    return {question.key: question.points for question in asked}


def given_to(
    student: str, codes: Codes, asked: Sequence[Question], found: Mapping[Key, Given],
    answers: Mapping[str, str],
) -> float | None:  # fmt: skip
    """The points of a student's questions; None as long as an answer is not marked. No answer earns nothing."""
    total = 0.0
    for question in asked:
        if answers.get(question.key):
            points = found.get((question.key, codes(student)), Given(None)).points
            if points is None:
                return None
            total += points
    return total


def marked_for_nobody(found: Mapping[Key, Given], codes: Codes, students: Iterable[str]) -> str:
    """That points count for nobody, as after a roster has given everybody another number; empty if they all count."""
    there = {codes(student) for student in students}
    lines = sum(given.filled and code not in there for (_, code), given in found.items())
    return (
        f"{lines} of the filled lines in {POINTS} count for nobody, because nothing of their students is handed in now."
        " The lines stay there. If you have named another folder or another roster, go back to the one before."
    ) * bool(lines)


def agreement(first: Mapping[Key, Given], second: Mapping[Key, Given]) -> str:
    """How far two markers agree about the answers that both have marked, in words; empty if there is none."""
    pairs = [
        (first[key].points, given.points)
        for key, given in second.items()
        if given.points is not None and key in first and first[key].points is not None
    ]
    if not pairs:
        return ""
    apart = [float(other or 0) - float(one or 0) for one, other in pairs]
    same = sum(each == 0 for each in apart)
    mean = sum(apart) / len(apart)
    return (
        f"Two markers agree about {same} of {len(apart)} answers; the second gives {abs(mean):.2g} points"
        f" {'more' if mean > 0 else 'less'} on average, and they are at most {max(map(abs, apart)):g} apart."
    )


def _environment() -> jinja2.Environment:
    """Templates that escape everything, except for our own text where it is typeset."""
    found = jinja2.Environment(
        loader=jinja2.PackageLoader("labs.gradebook"), autoescape=True, undefined=jinja2.StrictUndefined,
        trim_blocks=True, lstrip_blocks=True,
    )  # fmt: skip
    found.filters["typeset"] = typeset
    return found
