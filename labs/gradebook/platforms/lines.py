"""A grade as platforms show it: a line for each test, with its points and words, before it becomes any one format.

Threat: messages, complaints and file names hold whatever a student likes. Such text is marked as verbatim, and every
format shows it as plain text and nothing else. A hidden test has no inputs in the grade, so none can come from here.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from labs.assessment.shares import CODE, INPUTS, PREDICTIONS, QUESTIONS, SHARES
from labs.grading.safe_text import one_line

Content = Mapping[str, Any]
"""Of a `grade.json`."""
COUNTED = 100 - SHARES[QUESTIONS]
"""Points of a hundred that need no person."""


@dataclass(frozen=True)
class Paragraph:
    """Some words. verbatim: they may hold a student's own text, and their lines are kept."""

    text: str
    verbatim: bool = False


@dataclass(frozen=True)
class Line:
    """One line that a platform shows.

    kind: of work, as the marks count it. number: such as 2.1, of the function and its test. got, possible: whole points
    of the tests, or how many inputs and predictions. share: points of a hundred that the whole kind gives, of which
    this line has its part.
    """

    kind: str
    number: str
    function: str
    title: str
    got: int
    possible: int
    passed: bool
    hidden: bool
    share: float
    words: tuple[Paragraph, ...] = ()

    @property
    def name(self) -> str:
        """The function and what is tested of it, or the kind of work."""
        return f"{self.function}: {self.title}" if self.function else self.title


def lines(content: Content) -> list[Line]:
    """The lines of a grade in the order of the lab; none if the file could not be read."""
    return [*_tests(content), *_counts(content)]


def of_hundred(line: Line, amount: float) -> float:
    """So many of a line's points as points of a hundred; all of them if the lab has nothing of this kind."""
    return line.share * amount / line.possible if line.possible else line.share


def about(content: Content) -> list[Paragraph]:
    """What a student is told of the file as a whole. It says nothing of hidden tests."""
    identity = content.get("identity", {})
    file = one_line(str(identity.get("file") or content.get("submission") or ""))
    found = [Paragraph("This file was graded:"), Paragraph(file, verbatim=True)] if file else []
    if "unreadable" in content:
        why = one_line(str(content["unreadable"]))
        return [*found, Paragraph("It could not be graded:"), Paragraph(why, verbatim=True)]
    told = [*map(str, content.get("notes", ())), *map(str, content.get("complaints", ()))]
    if told:
        found += [Paragraph("About the file:"), Paragraph("\n".join(told), verbatim=True)]
    return found


def mistakes(content: Content) -> dict[str, list[str]]:
    """The ids of known mistakes, by function."""
    return {each["name"]: list(each["mistakes"]) for each in content.get("functions", ()) if each["mistakes"]}


def _tests(content: Content) -> Iterator[Line]:
    functions = {each["name"]: each for each in content.get("functions", ())}
    places, counts, told = {name: place for place, name in enumerate(functions, 1)}, dict[str, int](), set[str]()
    possible = int(content.get("possible", 0))
    for test in content.get("tests", ()):
        name = test["function"]
        counts[name] = counts.get(name, 0) + 1
        says = not test["passed"] or functions.get(name, {}).get("verdict") == "right"
        verdict = functions.get(name, {}).get("message", "") if says and name not in told else ""
        told |= {name} if says else set()
        yield Line(
            CODE, f"{places.get(name, 0)}.{counts[name]}", name, test["title"], test["got"], test["possible"],
            test["passed"], test["hidden"], SHARES[CODE] * test["possible"] / possible if possible else 0.0,
            tuple(_words(test, verdict)),
        )  # fmt: skip


def _words(test: Mapping[str, Any], verdict: str) -> Iterator[Paragraph]:
    """Why a test failed. verdict: on the function, in the first of its tests that failed.

    Of a right function it says whose mistake would have cost it points, in the first of its tests.
    """
    failed = [part for part in test["parts"] if part["got"] < part["possible"]]
    if verdict:
        yield Paragraph(verdict, verbatim=True)
    if test["passed"]:
        return
    if failed:
        yield Paragraph(f"Not yet: {'; '.join(part['reason'] for part in failed)}.")
    if not verdict and (said := test["message"] or next((part["message"] for part in failed), "")):
        yield Paragraph(said, verbatim=True)
    if test["rationale"]:
        yield Paragraph(test["rationale"])
    if test["help"]:
        yield Paragraph(f"Read on: {test['help']}")


def _counts(content: Content) -> Iterator[Line]:
    """The inputs that a student found, and the predictions that they made."""
    after = len(content.get("functions", ()))
    kinds = [kind for kind in (INPUTS, PREDICTIONS) if kind in content.get("marks", {})]
    for place, kind in enumerate(kinds, after + 1):
        found = content["marks"][kind]
        got, possible = int(found["reached"]), int(found["possible"])
        said = f"{got} of {possible}." if possible else "This lab asks for none, so everybody has these points."
        yield Line(kind, str(place), "", kind, got, possible, got == possible, False, SHARES[kind], (Paragraph(said),))
