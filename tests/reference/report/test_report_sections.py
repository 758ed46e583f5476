"""What stands for many rows in a table: the worst verdict, how many agree, and in which order all of it is told."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import pytest
from catalogue_rows import counted

from reference.catalogue.scenarios import catalogue
from reference.comparison.convergence import Errors
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import ALL_CASES, Row, Verdict
from reference.report import row_text
from reference.report.cells import Cell
from reference.report.marks import LEGEND, MARKS
from reference.report.overview import columns, verdict_line
from reference.report.sections import Line, Section, sections

REST = catalogue()["ball-to-rest"]
WORST_FIRST = (
    Verdict.CRASHED,
    Verdict.LOST,
    Verdict.FAIL,
    Verdict.DISAGREES,
    Verdict.NEEDS,
    Verdict.CANNOT_EXPRESS,
    Verdict.NO_WORDS,
    Verdict.NOT_AVAILABLE,
    Verdict.RUNNING,
    Verdict.KNOWN_DEVIATION,
    Verdict.PASS,
    Verdict.SHOWN,
)


def row(verdict: Verdict = Verdict.PASS, measured: float | None = 1.1, case: str = "e=0.5", **more) -> Row:
    """A row of ball-to-rest; expects 1 s unless it is only shown or has no number."""
    given = {"quantity": "rest_time", "unit": "s", "profile": "exact", "engine": "handwritten"} | more
    if verdict is not Verdict.SHOWN and measured is not None:
        given = {"expected": 1.0, "tolerance": 0.2, "scale": 1.0} | given
    return Row("ball-to-rest", case, verdict=verdict, measured=measured, **given)


def without_number(verdict: Verdict, note: str = "why", case: str = ALL_CASES) -> Row:
    return row(verdict, None, case, quantity="", unit="", note=note)


def result(*rows: Row, engine: str = "handwritten", profile: str = "", title: str = "", **more) -> JobResult:
    titles = {"handwritten": "hand-written", "pybullet": "PyBullet", "mujoco": "MuJoCo"}
    job = Job(more.pop("family", "ball-to-rest"), engine, profile or counted(engine))
    return JobResult(job, title or titles.get(engine, engine), "what it is", rows or (row(),), **more)


def line(*rows: Row, **more) -> Line:
    return Line(result(*rows, **more), REST)


def section(*results: JobResult) -> Section:
    (found,) = sections(results)
    return found


# Verdicts


@pytest.mark.parametrize(("worse", "better"), list(itertools.pairwise(WORST_FIRST)))
def test_the_worst_verdict_stands_for_a_cell(worse, better):
    for rows in ((row(worse), row(better)), (row(better), row(worse), row(better))):
        assert Cell(rows).verdict is worse
        assert Cell(rows).mark == MARKS[worse]


def test_every_verdict_has_its_own_mark_and_a_legend():
    assert set(MARKS) == set(LEGEND) == set(Verdict) == set(WORST_FIRST)
    assert len(set(MARKS.values())) == len(Verdict)
    assert all(len(mark) == 1 for mark in MARKS.values())
    assert all(LEGEND.values())


def test_a_cell_counts_agreeing_rows_and_known_deviations():
    verdicts = (Verdict.PASS, Verdict.PASS, Verdict.KNOWN_DEVIATION, Verdict.FAIL, Verdict.SHOWN, Verdict.RUNNING)
    assert Cell(tuple(map(row, verdicts))).count == "3/4"


def test_a_row_as_far_off_as_its_quantity_is_large_does_not_agree():
    found = (row(), row(Verdict.DISAGREES, 0.0))
    assert Cell(found).count == "1/2"
    assert verdict_line(found) == (
        "Of 2 checks that count, 1 came out as predicted and near theory, 1 as predicted and away from theory and"
        " none failed."
    )


@pytest.mark.parametrize(
    "verdict", [Verdict.NOT_AVAILABLE, Verdict.NEEDS, Verdict.CANNOT_EXPRESS, Verdict.CRASHED, Verdict.SHOWN]
)
def test_a_cell_without_any_number_gives_the_reason(verdict):
    cell = Cell((row(verdict, None), row(verdict, None)))
    assert (cell.count, cell.worst) == (str(verdict), "")


def test_a_failure_without_a_number_counts_as_judged():
    cell = Cell((row(Verdict.FAIL, None, expected=1.0),))
    assert (cell.count, cell.worst) == ("0/1", "no number: 1 of 1")


def test_one_number_of_fifteen_is_not_the_result_of_all():
    slab = catalogue()["sliding-slab"]
    given = [row(Verdict.FAIL, None, case.name, quantity="stopping_distance") for case in slab.cases]
    given[3] = row(Verdict.FAIL, 0.9, slab.cases[3].name, quantity="stopping_distance")
    for cell in (Cell(tuple(given), slab), Cell((*given, row(quantity="creep")), slab)):
        assert (cell.worst, cell.in_words) == ("never stops: 14 of 15", "never stops: 14 of 15")


def test_the_worst_row_of_several_quantities_is_named():
    far, near = row(measured=1.1), row(quantity="drift", measured=1.19, unit="m", scale=None)
    assert Cell((far, near), REST).in_words == "time of rest +10 %"  # the first quantity, as all are near theory
    failed = row(Verdict.FAIL, 1.3), row(Verdict.FAIL, 1.8, quantity="drift", unit="m", scale=None)
    assert Cell(failed, REST).in_words == "drift in the last 5 s +0.8 m"  # it is farther off for what is accepted
    known = row(Verdict.KNOWN_DEVIATION, 1.5)
    assert Cell((known, near), REST).in_words == "time of rest +50 %"
    waits = without_number(Verdict.NEEDS, case="e=0.8")
    assert Cell((waits, near), REST).in_words == "needs: 1 of 2 cases"
    assert Cell((row(Verdict.SHOWN),), REST).in_words == ""


def test_a_cell_that_is_only_shown_has_its_largest_value():
    cell = Cell(tuple(row(Verdict.SHOWN, measured, unit="m") for measured in (0.002, -0.0031, 0.001)))
    assert (cell.count, cell.worst) == ("", "3.1 mm")


# The worst error


def test_a_cell_has_the_largest_error_of_either_sign():
    assert Cell((row(measured=1.1), row(measured=0.85), row(measured=1.12))).worst == "−15 %"


def test_the_worst_error_is_that_of_the_worst_verdict():
    known = row(Verdict.KNOWN_DEVIATION, 1.5, shift=0.45)
    assert Cell((row(Verdict.FAIL, 1.3), known, row(measured=1.1))).worst == "+30 %"


def test_a_yes_or_no_quantity_has_no_error():
    right, wrong = row(measured=1.0, tolerance=0.0), row(Verdict.FAIL, 0.0, tolerance=0.0)
    cell = Cell((right, wrong))
    assert (cell.count, cell.worst) == ("1/2", "")


def test_an_error_is_in_percent_if_its_scale_is_not_zero():
    assert row_text.error_of(row(measured=1.02)) == "+2 %"
    assert row_text.error_of(row(measured=1.02, scale=4.0)) == "+0.5 %"
    assert row_text.error_of(row(measured=1.02, scale=None)) == "+20 ms"
    assert row_text.error_of(row(measured=1e-3, expected=0.0, scale=0.0)) == "+1 ms"
    assert row_text.error_of(row(Verdict.SHOWN, -0.02)) == "20 ms"
    assert row_text.error_of(row(Verdict.FAIL, None)) == ""


def test_the_remainder_of_a_known_deviation_is_the_error_less_the_shift():
    known = row(Verdict.KNOWN_DEVIATION, 1.29, shift=0.3)
    assert row_text.left_of(known) == "1 %"
    assert Cell((row(), known)).left == "left 1 %"
    in_its_unit = row(Verdict.KNOWN_DEVIATION, 1.31, shift=0.3, scale=None)
    assert Cell((in_its_unit,)).left == "left 10 ms"
    predicted = row(Verdict.KNOWN_DEVIATION, 1.29, off=-0.002)
    assert row_text.left_of(predicted) == "0.2 %"
    assert row_text.left_of(row(Verdict.CRASHED, None)) == ""


def test_the_remainder_shown_is_that_of_the_largest_known_deviation():
    small, large = (row(Verdict.KNOWN_DEVIATION, 1 + 1.1 * shift, shift=shift) for shift in (0.3, 0.6))
    assert Cell((large, small, row(Verdict.FAIL, 3.0))).left == "left 6 %"


def test_without_a_known_deviation_there_is_no_remainder():
    assert Cell((row(), row(Verdict.FAIL))).left == ""


# Lines


def test_a_crashed_run_counts_in_every_quantity_with_its_reason():
    found = line(without_number(Verdict.CRASHED, "SIGSEGV"))
    assert len(found.cells) == len(REST.quantities)
    assert all(cell.verdict is Verdict.CRASHED and cell.count == "crashed" for cell in found.cells)
    assert found.note == "crashed: SIGSEGV"
    assert found.whole.verdict is Verdict.CRASHED


def test_a_crashed_case_counts_in_every_quantity_beside_the_others():
    fine = [row(quantity=quantity.name, case="e=0.8") for quantity in REST.quantities]
    found = line(without_number(Verdict.CRASHED, case="e=0.5"), *fine)
    assert [(cell.verdict, cell.count) for cell in found.cells] == [(Verdict.CRASHED, "1/2")] * 4
    assert (found.whole.verdict, found.whole.count) == (Verdict.CRASHED, "4/5")
    assert found.note == ""


def test_a_line_whose_cases_share_a_problem_states_it_once():
    same = [without_number(Verdict.NEEDS, "needs a", case.name) for case in REST.cases]
    assert line(*same).note == "needs a"
    assert line(*same, without_number(Verdict.CRASHED, "hung")).note == "needs a; crashed: hung"


def test_a_quantity_has_the_rows_of_its_own_name():
    time, drift = row(), row(Verdict.FAIL, quantity="drift")
    cells = dict(zip((quantity.name for quantity in REST.quantities), line(time, drift).cells, strict=True))
    assert (cells["rest_time"].rows, cells["drift"].rows) == ((time,), (drift,))


def test_a_line_finds_the_row_of_a_case_or_the_reason_for_its_absence():
    own, crashed = row(), without_number(Verdict.CRASHED, case="e=0.8")
    found = line(own, crashed)
    assert found.row("e=0.5", "rest_time") is own
    assert found.row("e=0.5", "drift") is None
    assert found.row("e=0.8", "drift") is crashed
    assert found.row("e=0.9", "rest_time") is None
    whole = without_number(Verdict.NOT_AVAILABLE)
    assert line(whole).row("e=0.9", "drift") is whole


def test_only_tuned_lines_count():
    assert line().counts
    assert not line(profile="stock").counts
    assert not line(profile="spring").counts


@pytest.mark.parametrize(
    ("study", "text"),
    [
        (None, "too few timesteps"),
        (Errors((1e-3,), (0.1,), None), "too few timesteps"),
        (Errors((2e-3, 1e-3), (0.2, 0.1), 1.0), "order 1.00"),
        (Errors((2e-3, 1e-3), (0.1, 0.2), -1.0), "order −1.00"),
        (Errors((2e-3, 1e-3), (0.1, 0.1), -0.001), "order 0.00"),
        (Errors((2e-3, 1e-3), (2e-15, 3e-15), None), "rounding, <1 ns"),
        (Errors((2e-3, 1e-3, 5e-4), (0.43, 0.0, 1e-16), None), "one timestep alone, 0.43 s"),
    ],
)
def test_the_order_or_the_reason_for_its_absence_is_shown(study, text):
    assert line(convergence=study).order == text


def test_the_studied_errors_are_listed_with_their_timesteps():
    study = Errors((4e-3, 5e-4), (0.25, 3.1e-5), 1.0)
    assert line(convergence=study).errors == [("4 ms", "0.25 s"), ("500 µs", "31 µs")]
    assert line().errors == []


# Sections and their order


def test_families_that_ran_are_listed_in_the_order_of_teaching():
    ran = [result(family=name) for name in ("incline", "dropped-ball", "ball-to-rest")]
    assert [found.family.name for found in sections(ran)] == ["dropped-ball", "ball-to-rest", "incline"]
    assert sections([]) == []


def test_lines_are_ordered_by_engine_with_tuned_first_and_stock_last():
    asked = [
        ("z.py", "tuned"),
        ("mujoco", "stock"),
        ("a.py", "tuned"),
        ("mujoco", "spring"),
        ("pybullet", "stock"),
        ("mujoco", "tuned"),
        ("handwritten", "step"),
        ("pybullet", "tuned"),
        ("handwritten", "exact"),
    ]
    found = section(*(result(engine=engine, profile=profile) for engine, profile in asked))
    assert [line.title for line in found.lines] == [
        "hand-written, exact",
        "hand-written, step",
        "PyBullet, tuned",
        "PyBullet, stock",
        "MuJoCo, tuned",
        "MuJoCo, spring",
        "MuJoCo, stock",
        "a.py, tuned",
        "z.py, tuned",
    ]


def test_columns_are_all_lines_once_in_the_fullest_sections_order():
    two = [result(engine=engine) for engine in ("handwritten", "mujoco")]
    three = [result(engine=engine, family="incline") for engine in ("pybullet", "mujoco", "toy.py")]
    assert columns(sections(two + three)) == [
        "PyBullet, tuned",
        "MuJoCo, tuned",
        "toy.py, tuned",
        "hand-written, exact",
    ]
    assert columns([]) == []


def test_a_section_finds_a_line_by_its_title():
    found = section(result(), result(profile="step"))
    assert found.line("hand-written, step") is found.lines[1]
    assert found.line("PyBullet, tuned") is None


def test_a_section_shows_the_cases_that_ran_or_else_all_cases():
    assert section(result(row(case="e=0.9"), row(case="e=0.5"))).cases == ("e=0.5", "e=0.9")
    assert section(result(without_number(Verdict.CRASHED))).cases == tuple(case.name for case in REST.cases)
    mixed = section(result(row(case="e=0.8")), result(without_number(Verdict.CRASHED), engine="mujoco"))
    assert mixed.cases == ("e=0.8",)


def test_the_expected_value_is_that_of_a_line_or_else_of_theory():
    time = REST.quantity("rest_time")
    crashed, fine = result(without_number(Verdict.CRASHED)), result(row(), engine="mujoco")
    assert section(crashed, fine).expected("e=0.5", time) == "1 s"
    rests = math.sqrt(2 / 9.81) * (1 + 0.5) / (1 - 0.5)  # fallen 1 m, e = 0.5
    assert section(crashed).expected("e=0.5", time) == f"{rests:.5g} s"
    assert section(crashed).expected("e=0.5", REST.quantity("drift")) == "0 m"


# The one sentence


@pytest.mark.parametrize(
    ("verdicts", "sentence"),
    [
        ([], "Of 0 checks that count, 0 came out as predicted and near theory and none failed."),
        ([Verdict.PASS] * 3, "Of 3 checks that count, 3 came out as predicted and near theory and none failed."),
        ([Verdict.PASS, Verdict.FAIL], "Of 2 checks that count, 1 came out as predicted and near theory and 1 failed."),
        (
            [Verdict.PASS, Verdict.KNOWN_DEVIATION, Verdict.FAIL, Verdict.FAIL],
            "Of 4 checks that count, 1 came out as predicted and near theory, 1 as predicted and away from theory"
            " and 2 failed.",
        ),
        (
            [Verdict.PASS, Verdict.CRASHED, Verdict.NEEDS, Verdict.CANNOT_EXPRESS, Verdict.NOT_AVAILABLE, Verdict.LOST],
            "Of 3 checks that count, 1 came out as predicted and near theory, none failed and 2 gave no answer."
            " Besides, 1 case cannot be expressed in the engine, 1 case waits for hand-written code and 1 run was lost"
            " and not judged.",
        ),
        (
            [Verdict.PASS, Verdict.SHOWN],
            "Of 1 check that counts, 1 came out as predicted and near theory and none failed.",
        ),
    ],
)
def test_one_sentence_summarises_the_tuned_settings(verdicts, sentence):
    stock = [row(verdict, profile="stock") for verdict in Verdict]
    assert verdict_line([*map(row, verdicts), *stock]) == sentence


def test_what_theory_is_silent_about_and_what_bodies_at_rest_would_pass_is_counted_apart():
    silent, idle = row(expected=None), replace(row(), evidence=False)
    assert verdict_line([row(), row(), silent, idle, row(Verdict.NEEDS)]) == (
        "Of 3 checks that count, 2 came out as predicted and near theory, 1 as predicted where theory is silent and"
        " none failed. Besides, 1 check would pass even if no body moved and 1 case waits for hand-written code."
    )
    assert "2 checks would pass even if no body moved." in verdict_line([idle, idle])


def test_engines_of_two_files_that_share_a_title_have_a_column_each():
    def titles(*engines: str) -> list[str]:
        found = [result(row(), engine=engine, title="an odd one") for engine in engines]
        return columns(sections([*found, result(row(), title="hand-written")]))

    assert titles("a/one.py") == ["hand-written, exact", "an odd one, tuned"]
    assert titles("a/one.py", "a/two.py")[1:] == ["an odd one (one.py), tuned", "an odd one (two.py), tuned"]
    assert titles("a/one.py", "b/one.py")[1:] == ["an odd one (a/one.py), tuned", "an odd one (b/one.py), tuned"]
