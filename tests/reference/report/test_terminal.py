"""The comparison in a terminal of 80 columns: nothing is cut off, and everything is said."""

from __future__ import annotations

import functools
import io
import itertools
from collections.abc import Iterable
from dataclasses import replace

import pytest
from catalogue_rows import counted
from rich.cells import cell_len
from rich.console import Console

from reference import lecture
from reference.catalogue.scenarios import catalogue
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import ALL_CASES, Row, Verdict
from reference.engines import engine_names, load_engine
from reference.report.formulas import plain
from reference.report.marks import LEGEND, MARKS
from reference.report.sections import sections
from reference.report.terminal import print_comparison
from reference.running.study import run_job

WIDTH = 80
CUT = "…"  # what the table printer puts where it cuts something off, and our mark for a function that is not written
NUMBERS = (0.0, -0.12345, 1.35457, -5.5e-6, 5.5e-4)
"""Measured values that print as short and as long as values near the expected ones do."""
WILD = (*NUMBERS, -12345.6, -1.23456e7)
"""What a failure may come to."""
WITHOUT_QUANTITIES = (Verdict.NEEDS, Verdict.CANNOT_EXPRESS, Verdict.NO_WORDS, Verdict.NOT_AVAILABLE)
MEASURED = {
    Verdict.PASS: NUMBERS,
    Verdict.KNOWN_DEVIATION: NUMBERS,
    Verdict.FAIL: WILD,
    Verdict.SHOWN: WILD,
}
ALL = tuple(catalogue())
WORDIEST = (
    max(ALL, key=lambda name: max(len(case.name) for case in catalogue()[name].cases)),
    max(ALL, key=lambda name: max(len(quantity.title) for quantity in catalogue()[name].quantities)),
)
"""The longest name of a case, and the longest title of a quantity."""
SOME = tuple(dict.fromkeys((*WORDIEST, *ALL[::5])))
"""These and every fifth family: what the fast run prints with a verdict whose numbers are long, or that is words."""
slow = pytest.mark.slow
with_and_without_cases = pytest.mark.parametrize("with_cases", [False, True])


def printed(results: Iterable[JobResult], with_cases: bool = False) -> str:
    text = io.StringIO()
    print_comparison(Console(file=text, width=WIDTH, highlight=False), sections(results), with_cases)
    return text.getvalue()


def words(text: str) -> str:
    return " ".join(text.split())


def grid(verdict: Verdict, families: tuple[str, ...] = ALL) -> tuple[JobResult, ...]:
    """Every engine, profile, case and quantity with one verdict, and in turn the numbers that it may have."""
    values, found = itertools.cycle(MEASURED.get(verdict, (None,))), []
    for family in (catalogue()[name] for name in families):
        for name in engine_names():
            engine = load_engine(name)
            for profile, described in engine.profiles(family.cases[0].scenarios[0]).items():
                rows = []
                if verdict in WITHOUT_QUANTITIES:
                    rows = [Row(family.name, case.name, name, profile, "", "", verdict) for case in family.cases]
                for case, quantity in itertools.product(family.cases, () if rows else family.quantities):
                    row = Row(family.name, case.name, name, profile, quantity.name, quantity.unit, verdict)
                    row = replace(row, measured=next(values), scale=12.345 if quantity.scale else None)
                    if quantity.expect:
                        row = replace(row, expected=-1.23456, tolerance=1.0, shift=0.001)
                    rows.append(row)
                found.append(JobResult(Job(family.name, name, profile), engine.title, described, tuple(rows)))
    return tuple(found)


@functools.cache
def of_catalogue(verdict: Verdict, families: tuple[str, ...] = ALL, with_cases: bool = False) -> str:
    """What is printed of a grid."""
    return printed(grid(verdict, families), with_cases)


def without_answer(verdict: Verdict, note: str, engine: str = "mujoco", title: str = "MuJoCo") -> JobResult:
    row = Row("ball-to-rest", ALL_CASES, engine, "tuned", "", "", verdict, note=note)
    return JobResult(Job("ball-to-rest", engine, "tuned"), title, "", (row,))


@pytest.fixture(scope="module")
def real() -> list[JobResult]:
    """Real results of the hand-written code, quick ones."""
    return [run_job(Job("ball-to-rest", "handwritten", profile, ("e=0.5",))) for profile in ("exact", "slide", "step")]


# Width


def page(verdict: Verdict, families: tuple[str, ...], with_cases: bool, *marks: pytest.MarkDecorator):
    named = f"{len(families)} families{' with cases' if with_cases else ''}"
    return pytest.param(verdict, families, with_cases, id=f"{verdict.name.lower()}-{named}", marks=marks)


OFTEN = (Verdict.PASS, Verdict.FAIL, Verdict.NEEDS)
"""Numbers, long numbers, and words."""
PAGES = [
    # A family brings its names, and a verdict numbers or words that are alike in all families: so every verdict meets
    # the longest names, and all families one verdict with numbers and one with long numbers.
    *(page(verdict, WORDIEST, True) for verdict in Verdict),
    *(page(verdict, SOME, False, *(() if verdict in OFTEN else (slow,))) for verdict in Verdict),
    page(Verdict.PASS, ALL, False, slow),
    page(Verdict.PASS, ALL, True, slow),
    page(Verdict.FAIL, ALL, True, pytest.mark.weekly),
]


@pytest.mark.parametrize(("verdict", "families", "with_cases"), PAGES)
def test_nothing_is_wider_than_80_columns_or_cut_off(verdict, families, with_cases):
    text = of_catalogue(verdict, families, with_cases)
    assert max(map(cell_len, text.splitlines())) <= WIDTH
    assert text.count(CUT) == text.count(f"{CUT} needs")
    assert (CUT in text) == (verdict is Verdict.NEEDS)


@pytest.mark.parametrize(
    ("families", "with_cases"), [(ALL, False), (WORDIEST, True), pytest.param(ALL, True, marks=slow)]
)
@pytest.mark.slow
def test_every_name_of_the_catalogue_is_printed_in_full(families, with_cases):
    text = of_catalogue(Verdict.PASS, families, with_cases)
    for family in (catalogue()[name] for name in families):
        assert family.title in text
        assert words(plain(family.expected)) in words(text)
        for number in family.statements:
            assert words(f"{number} {lecture.statement(number).title}") in words(text)
        for case in family.cases:
            assert not with_cases or f"\n{case.name} " in text
        for word in words(" ".join(quantity.title for quantity in family.quantities)).split():
            assert word in text
    for name in engine_names():
        assert f"{load_engine(name).title}, {counted(name)}" in text


@with_and_without_cases
def test_long_notes_are_broken_into_lines(with_cases):
    note = "it has one coefficient of friction, not static 0.5 and kinetic 0.4 " * 5
    text = printed([without_answer(Verdict.CANNOT_EXPRESS, note.strip())], with_cases)
    assert max(map(cell_len, text.splitlines())) <= WIDTH
    assert words(f"MuJoCo (tuned) cannot express this: {note.strip()}.") in words(text)


# What is said


def test_the_overview_has_counts_and_worst_errors_of_each_implementation(real):
    text = printed(real)
    for title in ("hand-written, exact", "hand-written, slide", "hand-written, step"):
        (line,) = (line for line in text.splitlines() if line.startswith(title))
        assert line.count("✓ 1/1") == 4
    assert "Ball coming to rest" in text
    assert "−0.13 %" in text  # of the slide's T, which cannot see the last bounces
    assert "came out as predicted and near theory and none failed." in text.splitlines()[-2]


def test_with_cases_every_quantity_has_a_table_of_measured_values(real):
    lines = printed(real, with_cases=True).splitlines()
    headings = [line.partition("  ")[0] for line in lines if line.rstrip().endswith("verdict")]
    assert headings == [quantity.title for quantity in catalogue()["ball-to-rest"].quantities]
    assert next(line.split() for line in lines if line.startswith("e=0.5")) == ["e=0.5", "1.3546", "s", "expected"]
    (first, *_) = (line.split() for line in lines if line.startswith("  hand-written, exact"))
    assert first == ["hand-written,", "exact", "1.3546", "s", *first[4:-2], "✓", "pass"]
    assert sum(line.startswith("  hand-written, ") for line in lines) == 3 * 4


def test_a_printed_known_deviation_shows_its_remainder(real):
    tuned, *others = real
    first, *rest = tuned.rows
    known = replace(first, verdict=Verdict.KNOWN_DEVIATION, measured=1.5, shift=0.14, note="half a step late")
    changed = [replace(tuned, rows=(known, *rest)), *others]
    assert "left 0.4 %" in printed(changed)
    assert "half a step late" not in printed(changed)
    detailed = printed(changed, with_cases=True)
    (line,) = (line for line in detailed.splitlines() if "≈" in line and "hand-written, exact" in line)
    assert words(line) == "hand-written, exact 1.5 s +11 % 0.4 % ≈ known deviation"
    assert "Hand-written code (exact) differs as the method must: half a step late." in detailed


@with_and_without_cases
@pytest.mark.parametrize(
    ("verdict", "note", "said"),
    [
        (Verdict.NOT_AVAILABLE, "get it by pip", "has no number: get it by pip"),
        (Verdict.CRASHED, "its process died (SIGSEGV)", "crashed: its process died (SIGSEGV)"),
        (Verdict.CRASHED, "[bold]IndexError: [/red] of [0]", "crashed: [bold]IndexError: [/red] of [0]"),
        (Verdict.NEEDS, "needs kinematic_response (step 1)", "needs kinematic_response (step 1)"),
    ],
)
def test_an_engine_without_an_answer_says_why_in_its_own_words(verdict, note, said, with_cases, real):
    text = printed([*real, without_answer(verdict, note)], with_cases)
    assert words(f"MuJoCo (tuned) {said}.") in words(text)
    assert f"{MARKS[verdict]} {verdict}: {LEGEND[verdict]}" in words(text)


@pytest.mark.parametrize(("with_cases", "lines"), [(False, 1), (True, 3 * 4)])  # a line a case and quantity
def test_a_title_in_brackets_is_printed_unchanged(with_cases, lines):
    text = printed([without_answer(Verdict.CRASHED, "hung", "toy.py", "toy [b] [/]")], with_cases)
    assert text.count("toy [b] [/], tuned") == lines
    assert "Toy [b] [/] (tuned) crashed: hung." in text


def test_the_legend_explains_the_verdicts_that_occur_and_no_other(real):
    text = words(printed([*real, without_answer(Verdict.CRASHED, "hung")]))
    for verdict in Verdict:
        explained = f"{MARKS[verdict]} {verdict}: {LEGEND[verdict]}" in text
        assert explained == (verdict in (Verdict.PASS, Verdict.CRASHED)), verdict


def test_no_results_are_printed_as_one_sentence():
    assert printed([]).strip() == "Of 0 checks that count, 0 came out as predicted and near theory and none failed."


def test_families_come_in_the_order_of_teaching():
    text = printed(reversed(grid(Verdict.PASS, SOME)))
    places = [text.index(family.title) for family in catalogue().values() if family.name in SOME]
    assert places == sorted(places)


# All families in one screen


def test_several_families_end_with_a_table_of_marks(real):
    other = JobResult(Job("stack", "handwritten", "exact"), "hand-written", "", (Row("stack", ALL_CASES, "handwritten",
        "exact", "", "", Verdict.NEEDS, note="needs a world"),))  # fmt: skip
    lines = printed([*real, other]).splitlines()
    start = next(place for place, text in enumerate(lines) if text.startswith("at a glance"))
    assert words(lines[start - 1]) == "by hand by hand by hand"
    assert words(lines[start]) == "at a glance exact slide step"
    assert words(lines[start + 1]) == "ball-to-rest ✓ 4/4 ✓ 4/4 ✓ 4/4"
    assert words(lines[start + 2]) == "stack … needs"


@pytest.mark.slow
def test_the_catalogue_fits_one_screen_of_marks():
    lines = of_catalogue(Verdict.PASS).splitlines()
    start = next(place for place, text in enumerate(lines) if text.startswith("at a glance"))
    for place, name in enumerate(catalogue(), start + 1):
        assert lines[place].startswith(name)


@pytest.mark.slow
def test_a_narrow_screen_has_what_counts_in_a_table_of_its_own():
    lines = of_catalogue(Verdict.PASS).splitlines()
    starts = [place for place, text in enumerate(lines) if text.startswith("at a glance")]
    counted, *others = (words(lines[start]).split()[3:] for start in starts)
    assert counted == ["exact", "world", *["tuned"] * (len(engine_names()) - 1)]
    # What is plain, then other methods by hand and other settings of engines, as many as fit in each.
    assert [" ".join(names) for names in others] == [
        "step stock stock stock",
        "slide spring dissipative poisson",
        "stronge runge-kutta verlet explicit",
        "spring spring tendons joint joint",
        "swept swept ellipsoid inertia box",
    ]
    for start in starts:
        assert not any("…" in line for line in lines[start - 1 : start + 1 + len(catalogue())])  # nothing is cut
        assert max(map(len, lines[start - 1 : start + 1 + len(catalogue())])) <= WIDTH


def test_one_family_needs_no_summary(real):
    assert "at a glance" not in printed(real)


def test_tuned_rows_nearest_to_their_limits_are_listed_worst_first():
    one = run_job(Job("ball-to-rest", "handwritten", "exact", ("e=0.5",)))
    half = replace(one.rows[0], measured=2.0, expected=1.0, tolerance=2.0, scale=None)
    stack = [replace(half, family="stack", quantity=name, measured=1.0) for name in ("drift", "speed")]
    three_quarters = replace(half, family="stack", quantity="height", measured=2.5)
    other = JobResult(Job("stack", "handwritten", "exact"), "hand-written", "", (three_quarters, *stack))
    text = printed([replace(one, rows=(half, *one.rows[1:])), other])
    listed = text[text.index("worst first") :].splitlines()[1:3]
    assert [line.split()[0] for line in listed] == ["75", "50"]
    assert "stack, e=0.5: height of the top: error" in listed[0]


# What waits for a rigid-body world


def test_the_terminal_shows_which_scenarios_wait_for_the_world_of_an_implementation(tmp_path):
    mine = tmp_path / "mine.py"
    mine.write_text("from solutions.forces import uniform_gravity\nfrom solutions.friction import *\n")
    both = ("h=0.1,μ=0.5,θ=20°", "h=0.1,μ=1.5,θ=50°")  # a cube that holds, as a point would, and one that tips
    jobs = [
        Job("tipping-box", "handwritten", "exact", both, str(mine)),
        Job("tipping-box", "handwritten", "world", both[1:], str(mine)),
        Job("stack", "handwritten", "world", (), str(mine)),
    ]
    text = printed([run_job(job) for job in jobs])
    lines = [words(line) for line in text.splitlines()]
    assert "hand-written, world needs" in lines
    assert "Hand-written code (world) needs step_world (world, step 1)." in lines
    assert "Hand-written code (world 2×) needs step_world (world, step 1)." in lines
    assert "stack … needs" in lines
    assert "3 cases wait for hand-written code" in words(text)
