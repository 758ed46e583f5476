"""Pages of a class: one for each student, one for the instructor that can be shown to the class, and one that cannot.

Threat: names, file names and messages are hostile text; templates escape everything. A student's page has nothing of a
hidden test but what the grade has, which says neither inputs nor expected values. The page of the class has no names.
Students' code, solutions and probes are on the page of the clusters alone.
"""

from __future__ import annotations

import statistics
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import jinja2

from labs.assessment.shares import CODE, SHARES
from labs.gradebook import protection
from labs.gradebook.deadlines import Deadlines
from labs.gradebook.in_common import items, mistakes, weakest
from labs.gradebook.marking import Given
from labs.gradebook.mistakes import naming
from labs.gradebook.mistakes.clusters import Cluster
from labs.gradebook.runs_compared import Compared, Spread
from labs.gradebook.similarity import right_code
from labs.gradebook.tables import Mark
from labs.gradebook.written import Question, is_code_alone
from labs.grading.diagnosis.deviations import Answer
from labs.grading.diagnosis.fingerprints.reading import known
from labs.grading.diagnosis.output_names import output_names
from labs.grading.diagnosis.unnamed import single_cases
from labs.grading.diagnosis.words import answered, called
from reference import lecture

WAITS = "waits for another function"
LOOK = {
    "right": "right", "one at a time": "right for one case at a time", "unwritten": "not written yet",
    "calls a wrong function": WAITS, "tested with a wrong function": WAITS,
    "not tried": "not tried: the time was used up", "too slow": "too slow",
}  # fmt: skip
"""Verdicts in words for a student; every other one is `not right yet`."""
NOT_YET = "not right yet"
_NO_RULES = Deadlines()
BINS = 10
"""Of the distribution of points."""


def student_page(
    mark: Mark,
    asked: Sequence[Question],
    given: Mapping[str, Given],
    runs: Sequence[Compared] = (),
    rules: Deadlines = _NO_RULES,
) -> str:
    """What a student reads. given: by question, the points and comments that a person gave. runs: in scenarios.

    rules: of the course, which say whom to ask about a mark.
    """
    content = mark.content or {}
    kinds = {
        kind: (found["reached"], found["possible"], SHARES[kind]) for kind, found in content.get("marks", {}).items()
    }
    tests = content.get("tests", [])
    functions = [
        (each, LOOK.get(each["verdict"], NOT_YET), [test for test in tests if test["function"] == each["name"]])
        for each in content.get("functions", [])
    ]
    return _environment().get_template("student.html.j2").render(
        mark=mark, title=lecture.topic(mark.lab).title, kinds=kinds, functions=functions, asked=asked, given=given,
        content=content, rules=rules, runs=runs, code_alone=is_code_alone(content), shares=SHARES,
    )  # fmt: skip


def class_page(
    lab: str,
    marks: Sequence[Mark],
    measured: Mapping[str, float],
    runs: Sequence[Spread] = (),
    shared: Sequence[Cluster] = (),
) -> str:
    """What an instructor reads, and may show: no names.

    measured: by code of a student, seconds that grading took. runs: what the class measured in scenarios. shared:
    mistakes without a name, of which this page says no more than how many students make them.
    """
    graded = [mark for mark in marks if mark.content and "unreadable" not in mark.content]
    scores = [mark.raw for mark in graded if mark.raw is not None]
    bins = Counter(min(BINS - 1, int(score / 100 * BINS)) for score in scores)
    contents = [mark.content for mark in graded if mark.content]
    found, known = items(lab, contents), mistakes(contents)
    return _environment().get_template("class.html.j2").render(
        title=lecture.topic(lab).title, students=len(marks), graded=len(graded), bins=[bins[at] for at in range(BINS)],
        median=statistics.median(scores) if scores else None, items=found, weakest=weakest(found),
        mistakes=[each for each in known if each.students > 1], alone=sum(each.students == 1 for each in known),
        code_alone=sum(map(is_code_alone, contents)), most=SHARES[CODE],
        unnamed=[(len(each.students), each.function) for each in shared], runs=runs,
        protection=protection.in_words(contents), slowest=sorted(measured.items(), key=lambda each: -each[1])[:5],
    )  # fmt: skip


def clusters_page(lab: str, shared: Sequence[Cluster]) -> str:
    """What an instructor reads about the mistakes without a name: students' code, solutions and probes are on it."""
    return (
        _environment()
        .get_template("clusters.html.j2")
        .render(
            title=lecture.topic(lab).title, table=naming.FILE, clusters=[_beside_the_right_one(each) for each in shared]
        )
    )


def _beside_the_right_one(found: Cluster) -> dict[str, Any]:
    """A shared mistake, the solution, and the simplest case in which they differ."""
    probe, right = single_cases(found.function)[found.place]
    return {
        "id": found.id, "function": found.function, "students": len(found.students), "code": found.code,
        "right": right_code(found.function), "note": probe.note, "gives": found.gives,
        "tried": called(known(found.function).parameters, probe.arguments, found.function),
        "physics": answered(Answer(), right, output_names(found.function))[1],
    }  # fmt: skip


def _environment() -> jinja2.Environment:
    return jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent / "templates"), autoescape=True,
        undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True,
    )  # fmt: skip
