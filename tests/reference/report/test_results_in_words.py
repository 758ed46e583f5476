"""The result of a scenario in words, by what its implementations have in common."""

from __future__ import annotations

from dataclasses import replace

import pytest
from pages import REST, result, without_answer

from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Verdict
from reference.recording.reading import recall
from reference.report.results_in_words import Remark, accepted, counted, plain, remarks, tolerances
from reference.report.sections import Section, sections


def section(*results: JobResult) -> Section:
    (found,) = sections(results)
    return found


def changed(given: JobResult, **first) -> JobResult:
    """The result with another first row, that of the time of rest at e = 0.5."""
    return replace(given, rows=(replace(given.rows[0], **first), *given.rows[1:]))


def test_what_counts_is_told_verdict_by_verdict_with_the_worst_number():
    far = changed(result(REST, "dart", "tuned"), verdict=Verdict.KNOWN_DEVIATION, measured=0.5)
    missing = without_answer(result(REST, "mujoco", "tuned"), Verdict.CRASHED, "hung")
    found = section(result(REST, "handwritten", "exact"), result(REST, "pybullet", "tuned"), far, missing)
    by_hand, bullet, mujoco, dart = (line.result.title for line in found.lines)
    assert by_hand == "hand-written"
    assert counted(found) == (
        f"Hand-written code and {bullet} agree with theory in every check; {dart} (time of rest +25 %) differs as the"
        f" method must; {mujoco} crashed."
    )
    assert plain(found) == ""


def test_methods_of_hand_written_code_are_named_where_their_results_differ():
    exact, world = result(REST, "handwritten", "exact"), result(REST, "handwritten", "world")
    assert counted(section(exact, world)) == "Hand-written code agrees with theory in every check."
    away = changed(world, verdict=Verdict.KNOWN_DEVIATION, measured=0.5)
    assert counted(section(exact, away)) == (
        "Hand-written code by the method exact agrees with theory in every check;"
        " hand-written code by the method world (time of rest +25 %) differs as the method must."
    )


@pytest.mark.parametrize(
    ("code", "said"), [("solutions", []), ("mine.py | solutions", ["The code that is tried here steers"])]
)
def test_a_failure_under_somebody_elses_rule_is_said_to_be_the_rules(code, said):
    recorded = recall(Job("lone-flier", "mujoco", "tuned"))
    failed = changed(recorded, verdict=Verdict.FAIL)
    found = remarks(section(replace(failed, job=replace(failed.job, implementation=code))))
    assert [each.said[:34] for each in found if each.verdict is Verdict.FAIL and "steers" in each.said] == said


def test_engines_that_lack_the_same_cases_are_told_together():
    first, *others = (result(REST, name, "tuned") for name in ("pybullet", "mujoco", "dart"))
    lacking = {"verdict": Verdict.CANNOT_EXPRESS, "quantity": "", "measured": None}
    gone = first.rows[0].case
    some = [
        replace(each, rows=(replace(each.rows[0], **lacking), *(row for row in each.rows if row.case != gone)))
        for each in (first, *others)
    ]
    assert counted(section(*some)) == (
        "PyBullet, MuJoCo and DART cannot express 1 of 3 cases and agree with theory in the others."
    )
    late = replace(some[0], rows=(*some[0].rows[:-1], replace(some[0].rows[-1], verdict=Verdict.KNOWN_DEVIATION)))
    assert counted(section(late)) == "PyBullet cannot express 1 of 3 cases."


def test_what_is_plain_is_told_apart_for_engines_and_by_hand():
    wrong = changed(result(REST, "dart", "stock"), verdict=Verdict.FAIL, measured=None)
    found = section(result(REST, "handwritten", "step"), wrong)
    assert plain(found) == (
        f"As installed, {found.lines[1].result.title} (never rests: 1 of 3) differs by more than the method explains."
        " At the step, hand-written code agrees with theory in every check."
    )


def test_a_reason_that_holds_for_most_is_told_of_all_others():
    ours = [result(REST, *job) for job in (("handwritten", "exact"), ("pybullet", "tuned"), ("pybullet", "stock"))]
    ours += [result(REST, "dart", "tuned")]
    exact = replace(ours[0], rows=tuple(replace(row, reason="rounding") for row in ours[0].rows))
    found = accepted(section(exact, *ours[1:]))
    assert [(it.whose, it.reason) for it in found] == [
        ("hand-written, exact", "rounding"),
        ("all others", "a step late"),
    ]
    assert {it.quantities for it in found} == {", ".join(quantity.title for quantity in REST.quantities)}


def test_a_remark_is_one_sentence_for_all_that_it_belongs_to():
    late = {"verdict": Verdict.KNOWN_DEVIATION, "note": "−g t dt/2: half a step late"}
    exact = changed(result(REST, "handwritten", "exact"), **late)
    exact = replace(exact, rows=(exact.rows[0], replace(exact.rows[1], **late), *exact.rows[2:]))
    missing = {"verdict": Verdict.FAIL, "measured": None, "note": "no finite number: it never rests"}
    found = section(
        exact,
        changed(result(REST, "handwritten", "step"), **late),
        changed(result(REST, "pybullet", "stock"), **missing),
        without_answer(result(REST, "mujoco", "tuned"), Verdict.CRASHED, "SIGSEGV: died"),
    )
    assert remarks(found) == [
        Remark(
            Verdict.KNOWN_DEVIATION,
            "Hand-written code (exact 2×, step) differs as the method must: −g t dt/2; half a step late.",
        ),
        Remark(Verdict.FAIL, "PyBullet (stock) has no number: it never rests."),
        Remark(Verdict.CRASHED, "MuJoCo (tuned) crashed: SIGSEGV: died."),
    ]


def test_a_reason_for_a_tolerance_is_given_once_with_its_lines():
    names = ("handwritten", "exact"), ("handwritten", "step"), ("mujoco", "tuned")
    exact, step, mujoco = (result(REST, *name) for name in names)
    found = section(changed(exact, reason="rounding only"), step, mujoco)
    found = section(replace(found.lines[0].result, rows=found.lines[0].result.rows[:1]), step, mujoco)
    assert tolerances(found, "rest_time") == [
        ("rounding only", ["hand-written, exact"]),
        ("a step late", ["hand-written, step", "MuJoCo, tuned"]),
    ]
    assert tolerances(found, "nothing") == []
