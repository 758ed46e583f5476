"""A page of less than everything: one engine, runs without an answer, the worst rows, and hostile messages."""

from __future__ import annotations

from dataclasses import replace

import pytest
from pages import OURS, PICTURE, REST, came_out, read, result, with_id, without_answer, written

from reference.comparison.error_split import Share, Split
from reference.comparison.results import Job
from reference.comparison.verdicts import Verdict
from reference.report import page
from reference.report.marks import LEGEND, MARKS
from reference.report.sections import sections
from reference.running.study import run_job

EVIL = "<script>alert('moon')</script> & \"quotes\""


# Less than everything


def test_the_page_can_be_made_of_one_engine_alone():
    section = with_id(read(written(OURS)), "ball-to-rest")
    assert len(came_out(section).all("tbody")[0].all("tr")) == 3
    assert "PyBullet, tuned" not in section.text


def test_a_page_without_results_is_well_formed():
    tree = read(page.render([], {}, [], "Collisions Lab"))
    assert "in nothing: no engine answered." in tree.text
    assert "Of 0 checks that count" in tree.text


@pytest.mark.parametrize(
    ("verdict", "note", "said"),
    [
        (Verdict.NOT_AVAILABLE, "get it by pip", "not available: get it by pip"),
        (Verdict.CRASHED, "its process died (SIGSEGV)", "crashed: its process died (SIGSEGV)"),
        (Verdict.NEEDS, "needs kinematic_response (step 1)", "needs kinematic_response (step 1)"),
        (Verdict.CANNOT_EXPRESS, "it has no words", "cannot express: it has no words"),
        (Verdict.CANNOT_EXPRESS, "DART cannot express rods/a b: it has: none", "cannot express: it has: none"),
    ],
)
def test_an_engine_without_an_answer_has_a_line_that_says_why(verdict, note, said):
    missing = without_answer(result(REST, "mujoco", "tuned"), verdict, note)
    tree = read(written([*OURS, missing]))
    line = came_out(with_id(tree, "ball-to-rest")).all("tbody")[0].all("tr")[-1]
    assert line.all("th")[0].text.startswith("MuJoCo, tuned")
    assert line.all("td")[0].text == f"{MARKS[verdict]} {said}"
    assert line.all("td")[0].attributes["colspan"] == str(len(REST.quantities))
    glance = with_id(tree, "overview").all("tbody")[0].all("td")[-1]
    assert glance.text == f"{MARKS[verdict]} {verdict}"
    assert f"{verdict} {LEGEND[verdict]}" in tree.all("ul", "legend")[0].text


def test_a_page_of_crashed_runs_alone_lists_all_cases_as_crashed():
    crashed = without_answer(OURS[0], Verdict.CRASHED, "hung")
    section = with_id(read(written([crashed], with_figures=False)), "ball-to-rest")
    cases = section.all("table", "cases")[0].all("tbody")[0].all("tr")
    times = [f"{REST.quantity('rest_time').theory(case):.5g} s" for case in REST.cases]  # theory needs no run
    assert [line.text for line in cases] == [
        f"{case.name}{time}{MARKS[Verdict.CRASHED]}" for case, time in zip(REST.cases, times, strict=True)
    ]
    assert section.all("figure") == []


def test_without_studies_there_is_no_table_of_errors():
    plain = [replace(it, convergence=None) for it in OURS]
    section = with_id(read(written(plain)), "ball-to-rest")
    assert "measured order" not in section.text


def test_a_case_run_in_one_engine_is_an_empty_cell_in_the_other():
    one = replace(OURS[0], rows=tuple(it for it in OURS[0].rows if it.case == "e=0.5"))
    table = with_id(read(written([one, OURS[2]])), "ball-to-rest").all("table", "cases")[0]
    empty = [[it.classes == ["empty"] for it in line.all("td")[1:]] for line in table.all("tbody")[0].all("tr")]
    assert empty == [[False, False], [True, False], [True, False]]


# Worst first, and where errors come from


def test_the_worst_row_that_counts_is_first_with_the_share_of_its_limit():
    bad = replace(OURS[0].rows[0], measured=0.33)  # 0.08 of a tolerance of 0.1; all others use 0.01 of it
    worst = with_id(read(written([replace(OURS[0], rows=(bad, *OURS[0].rows[1:]))])), "worst")
    first = worst.all("tbody")[0].all("tr")[0]
    assert first.text.strip().startswith("ball-to-rest")
    assert "80 %" in first.text


def test_rows_at_the_step_that_fail_are_listed_separately():
    at_step = next(it for it in OURS if it.job.profile == "step")
    failed = replace(at_step.rows[0], verdict=Verdict.FAIL, measured=1.25)
    worst = with_id(read(written([OURS[0], replace(at_step, rows=(failed, *at_step.rows[1:]))])), "worst")
    counted, others = worst.all("tbody")
    assert "step" not in counted.text
    assert [line.all("td")[0].text.strip() for line in others.all("tr")] == ["hand-written, step"]


def test_a_split_error_lists_each_moved_setting_and_both_errors():
    shares = (
        Share("discretisation", "timestep 0.001 → 0.0005", 0.01, 0.005, 0.01),
        Share("solver", "iterations 50 → 100", 0.01, 0.01, 0.0),
        Share("remainder", "what no move explains", 0.01, 0.0, 0.0),
    )
    given = replace(OURS[0], split=Split("e=0.5", "rest_time", shares))
    section = with_id(read(written([given])), "ball-to-rest")
    whole, table = (it for it in section.all("table") if "discretisation" in it.text)
    assert [cell.text for cell in whole.all("tbody")[0].all("td")] == ["", "+0.74 %", "+0.74 %", "", "0 %", "0 %"]
    (line,) = table.all("tbody")[0].all("tr")
    assert [cell.text.strip() for cell in (*line.all("th"), *line.all("td"))] == [
        "hand-written",
        "discretisation",
        "timestep 0.001 → 0.0005",
        "+0.74 %",  # 0.01 s of the 1.3546 s that the ball takes at e = 0.5
        "+0.37 %",
        "+0.74 %",
    ]


def test_without_a_split_the_page_has_no_table_of_shares():
    assert "Where the error comes from" not in with_id(read(written(OURS)), "ball-to-rest").text


# Whatever a message holds


def test_messages_of_engines_are_shown_as_text_and_never_run():
    crashed = without_answer(result(REST, "mujoco", "tuned"), Verdict.CRASHED, EVIL)
    rows = tuple(replace(row, settings=EVIL) for row in OURS[0].rows)
    odd = replace(OURS[0], title=EVIL, description=EVIL, rows=rows)
    text = page.render(sections([odd, crashed]), {"ball-to-rest": [(PICTURE, EVIL)]}, [EVIL], EVIL)
    tree = read(text)
    assert "<script>alert" not in text
    assert len(tree.all("script")) == 1  # our own, for printing
    section, shown = with_id(tree, "ball-to-rest"), " ".join(EVIL.split())
    ours, theirs = came_out(section).all("tbody")[0].all("tr")
    assert ours.all("th")[0].text == f"{shown}, exact"
    (settings,) = section.all("table", "settings")
    assert [cell.text for cell in settings.all("td")] == [shown]
    assert theirs.all("td")[0].text == f"{MARKS[Verdict.CRASHED]} crashed: {shown}"
    assert section.all("figure")[0].all("div")[0].attributes["aria-label"] == EVIL
    assert shown in tree.all("header")[0].text
    assert shown in tree.all("footer")[0].text


def test_a_known_deviation_shows_its_remainder_and_its_reason():
    first, *others = (it for it in OURS[0].rows if it.case == "e=0.5")
    known = replace(first, verdict=Verdict.KNOWN_DEVIATION, measured=0.55, shift=0.29, note="half a step")
    tree = read(written([replace(OURS[0], rows=(known, *others))]))
    section = with_id(tree, "ball-to-rest")
    cell = came_out(section).all("td")[0]
    assert "known_deviation" in cell.classes
    assert (cell.all("b")[0].text, cell.all("span")[0].text, cell.all("small")[0].text) == (
        "≈ 1/1",
        "+30 %",
        "left 1 %",
    )
    assert "Hand-written code (exact) differs as the method must: half a step." in [
        it.text for it in section.all("p", "note")
    ]


# What waits for a rigid-body world


def test_the_page_shows_which_scenarios_wait_for_the_world_of_an_implementation(tmp_path):
    mine = tmp_path / "mine.py"
    mine.write_text("from solutions.forces import uniform_gravity\nfrom solutions.friction import *\n")
    methods = ("tipping-box", "exact"), ("tipping-box", "world"), ("stack", "world")
    both = ("h=0.1,μ=0.5,θ=20°", "h=0.1,μ=1.5,θ=50°")  # a cube that holds, as a point would, and one that tips
    cases = {"exact": both, "world": both[1:]}
    jobs = [
        Job(family, "handwritten", how, cases[how] if family != "stack" else (), str(mine)) for family, how in methods
    ]
    tree = read(written([run_job(job) for job in jobs]))
    overview = [[cell.text for cell in line.inside] for line in tree.all("table", "overview")[0].all("tr")]
    assert ["Stack of boxes", "", "… needs"] in overview
    assert ["Box on a slope: holds, slides or tips", "✓ 2/2 way in 1 s 0 m", "… needs"] in overview
    for name, times in (("tipping-box", ""), ("stack", " 2×")):
        notes = [note.text for note in with_id(tree, name).all("p", "note")]
        assert f"Hand-written code (world{times}) needs step_world (world, step 1)." in notes
        whole, *_ = (cell.text for cell in came_out(with_id(tree, name)).all("td", "needs"))
        assert whole == "… needs step_world (world, step 1)"
