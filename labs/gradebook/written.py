"""The written questions of a class: collected into one page for each, marked in a table, and read back.

    grades/questions/third-law.html   the question, its rubric, and all answers in a row, names hidden
    grades/questions/points.csv       a line for each answer, to be filled in with points and a comment
    grades/questions/second.csv       every tenth answer again, for a second marker; agreement is reported

Names are replaced by short codes, which belong to this folder of grades and stay the same in every run. The order of
the answers differs from question to question, so that nobody is always read last. A line that somebody has filled in is
never overwritten.
"""

from __future__ import annotations

import csv
import hashlib
import hmac
import io
import secrets
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import jinja2

from labs.building import lessons
from labs.building.instructor_page import parts
from labs.gradebook.tables import defused
from labs.gradebook.typeset import typeset
from labs.grading.judging.grade import write_private
from labs.grading.submission.cells import read_cells
from reference.errors import InvalidInput

FOLDER, POINTS, SECOND = "questions", "points.csv", "second.csv"
COLUMNS = ("question", "code", "possible", "points", "comment")
SAMPLE = 10
"""Every so many answers, one goes to a second marker."""
_SECRET = ".codes"
_OPEN = "*Your answer:*"
"""What a student's notebook says where the answer goes."""
_LETTERS = "ABCDEFGHJKLMNPQRSTUVWXYZ23456789"
"""Without those that are easily taken for each other."""


@dataclass(frozen=True)
class Question:
    """A question of a lab. title: its heading. text, model: Markdown, the second with the rubric."""

    key: str
    title: str
    text: str
    model: str
    points: int


@dataclass(frozen=True)
class Given:
    """Points that a marker gave for an answer, None if it is not marked yet."""

    points: float | None
    comment: str = ""


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
    return file.lower().endswith(".py") and not any(content.get("answers", {}).values())


class Codes:
    """Short codes in place of names, from a secret that is kept with the grades."""

    def __init__(self, folder: Path) -> None:
        path = folder / _SECRET
        if not path.is_file():
            write_private(path, secrets.token_hex(32))
        self._secret = path.read_text(encoding="utf-8").strip().encode()

    def __call__(self, student: str) -> str:
        """The code of a student."""
        found = self._digest(student)
        return "".join(_LETTERS[byte % len(_LETTERS)] for byte in found[:5])

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
        before = read_points(place / name, asked)
        write_private(place / name, _table([*each, *_kept(before, each, asked)], before))


def _kept(
    before: Mapping[tuple[str, str], Given], lines: Sequence[tuple[str, str, int]], asked: Sequence[Question]
) -> list[tuple[str, str, int]]:
    """Lines that somebody has filled in for answers that are not there this time, as in a run on another folder."""
    there, possible = {line[:2] for line in lines}, {question.key: question.points for question in asked}
    filled = [key for key, given in before.items() if given.points is not None or given.comment]
    return [(question, code, possible[question]) for question, code in filled if (question, code) not in there]


def _table(lines: Sequence[tuple[str, str, int]], before: Mapping[tuple[str, str], Given]) -> str:
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS)
    for question, code, possible in lines:
        given = before.get((question, code), Given(None))
        points = "" if given.points is None else f"{given.points:g}"
        writer.writerow([question, code, possible, points, defused(given.comment)])
    return text.getvalue()


def read_points(path: Path, asked: Sequence[Question]) -> dict[tuple[str, str], Given]:
    """What a marker has filled in, by question and code; empty if there is no file yet.

    Raises
    ------
    InvalidInput
        If a line has another question, or points that its question does not have: the message names the line.
    """
    if not path.is_file():
        return {}
    possible = {question.key: question.points for question in asked}
    found = {}
    with open(path, encoding="utf-8-sig", newline="") as file:
        for number, row in enumerate(csv.DictReader(file), 2):
            key, said = row.get("question") or "", (row.get("points") or "").strip().replace(",", ".")
            where = f"line {number} of {path.name}"
            if key not in possible:
                raise InvalidInput(f"{where} has the question {key!r}; there are {', '.join(possible)}")
            try:
                points = float(said) if said else None
            except ValueError:
                raise InvalidInput(f"{where} has {said!r} points: write a number") from None
            if points is not None and not 0 <= points <= possible[key]:
                raise InvalidInput(f"{where} gives {points:g} points; the question {key} has {possible[key]}")
            comment = (row.get("comment") or "").removeprefix("'")
            found[key, row.get("code") or ""] = Given(points, comment)
    return found


def given_to(
    student: str, codes: Codes, asked: Sequence[Question], found: Mapping[tuple[str, str], Given],
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


def agreement(first: Mapping[tuple[str, str], Given], second: Mapping[tuple[str, str], Given]) -> str:
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
