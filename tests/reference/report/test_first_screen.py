"""The first screen: every number on it is one of the rows', and words replace a number that would mislead."""

from __future__ import annotations

import re
from dataclasses import replace

import live
import pytest
from readme_picture import AGAIN, in_the_picture

from reference.catalogue.scenarios import catalogue
from reference.comparison.curves import Series
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Row, Verdict
from reference.engines import engine_names, load_engine
from reference.engines.profiles import counts, is_plain
from reference.recording.reading import recall
from reference.report.first_screen import findings
from reference.report.sections import sections
from reference.running.study import run_job

TITLES = {"handwritten": "hand-written", "pybullet": "PyBullet", "mujoco": "MuJoCo", "dart": "DART"}
FINE, FAR, WRONG = Verdict.PASS, Verdict.KNOWN_DEVIATION, Verdict.FAIL
BOUNCE = {"case": "e=0.5", "quantity": "rebound", "unit": "", "expected": 0.25, "values": (0.25,) * 13}
STOP = {"quantity": "stopping_distance", "unit": "m", "expected": 0.5}


def result(family: str, engine: str, profile: str, verdict: Verdict, measured: float | None, **more) -> JobResult:
    given = {"case": "μ=0.4,v=2", "settings": "timestep 0.002 s, cone pyramidal"} | more
    row = Row(family, engine=engine, profile=profile, verdict=verdict, measured=measured, **given)
    return JobResult(Job(family, engine, profile), TITLES[engine], "", (row,))


def said(*results: JobResult) -> list[tuple[str, list[tuple[str, str, str]]]]:
    """What the only finding says: the opening of each group, and its figures."""
    (finding,) = findings(sections(results))
    return [(group.opening, [(it.who, it.said, it.timestep) for it in group.figures]) for group in finding.groups]


def test_a_finding_tells_who_agrees_who_differs_and_by_how_much():
    found = said(
        result("dropped-ball", "handwritten", "exact", FINE, 0.25, **BOUNCE),
        result("dropped-ball", "handwritten", "step", FAR, 0.2489, spread=0.00094, **BOUNCE),
        result("dropped-ball", "pybullet", "stock", WRONG, 0.2872, spread=0.037, **BOUNCE),
        result("dropped-ball", "mujoco", "stock", WRONG, 0.0, **BOUNCE),
    )
    assert found == [
        (
            "Agree with theory within 1 %",
            [("by hand, exact", "0 mm", ""), ("by hand, at the step", "−1.1 ± 0.94 mm", "2 ms")],
        ),
        (
            "Miss theory",
            [("PyBullet as installed", "+37 ± 37 mm", "2 ms"), ("MuJoCo as installed", "does not bounce", "2 ms")],
        ),
    ]


def test_what_is_plain_is_told_of_the_slab_that_heads_off_at_an_angle():
    tuned = result("sliding-slab", "dart", "tuned", FAR, 0.499, **STOP)
    along = result("sliding-slab", "dart", "stock", FINE, 0.5, **STOP)
    turned = result("sliding-slab", "dart", "stock", WRONG, None, **STOP | {"case": "μ=0.4,v=2,heading=30°"})
    both = replace(along, rows=(*along.rows, *turned.rows))
    assert said(tuned, both) == [
        ("Agree with theory within 1 %", [("DART", "−1.0 mm", "2 ms")]),
        ("Miss theory", [("DART as installed", "never stops", "2 ms")]),
    ]


def test_where_darts_rocking_slab_is_at_the_end_is_told_of_its_curve():
    never = result("sliding-slab", "dart", "stock", WRONG, None, **STOP | {"case": "μ=0.4,v=2,heading=30°"})
    both = result("sliding-slab", "dart", "tuned", FAR, 0.499, **STOP), never
    (finding,) = findings(sections(both))
    assert finding.why.endswith("DART brakes each axis by itself.")
    at_the_end = replace(never, series=Series((0.0, 3.0), (0.0, 0.4)))
    (finding,) = findings(sections([both[0], at_the_end]))
    assert "stands 110 mm short" in finding.why  # of v²/(2 μ g) = 509.7 mm


def test_numbers_that_differ_alike_are_said_to_be_alike():
    by_hand = result("sliding-slab", "handwritten", "exact", FAR, 0.499, **STOP)
    (finding,) = findings(sections([by_hand, result("sliding-slab", "dart", "tuned", FAR, 0.49900004, **STOP)]))
    assert finding.groups[0].closing == "the last two agree to 100 nm"
    (finding,) = findings(sections([by_hand, result("sliding-slab", "dart", "tuned", FAR, 0.4991, **STOP)]))
    assert finding.groups[0].closing == ""


def test_without_its_scenarios_the_first_screen_is_empty():
    assert findings(sections([])) == []
    needs = result("sliding-slab", "handwritten", "exact", Verdict.NEEDS, None, quantity="", unit="")
    assert findings(sections([needs])) == []


METHODS = {"by hand, exact": "exact", "by hand, in the world": "world", "by hand, at the step": "step"}


def run_by_hand(family: str, profile: str) -> JobResult:
    """The cases that a whole report has: from the live runs of `make verify`, or else run here."""
    planned = live.planned()[family, "handwritten", profile]
    return live.kept(planned) or run_job(Job(family, "handwritten", profile, planned.cases))


@pytest.fixture(scope="module")
def results() -> list[JobResult]:
    """What the first screen tells of: hand-written code as it runs here, and the engines from recordings."""
    results = []
    for family in ("dropped-ball", "ball-to-rest", "sliding-slab", "stack"):
        for name in engine_names():
            for profile in catalogue()[family].profiles(load_engine(name)):
                if counts(profile) or is_plain(profile):
                    ours, job = name == "handwritten", Job(family, name, profile)
                    results.append(run_by_hand(family, profile) if ours else recall(job))
    return [it for it in results if it is not None]


@pytest.mark.slow
def test_the_readmes_picture_says_what_the_first_screen_says(results):
    picture = in_the_picture()
    for finding in findings(sections(results)):
        said = [finding.question, finding.why, finding.more]
        for group in finding.groups:
            said += [group.opening, *(f"{it.who} {it.said} Δt {it.timestep}" for it in group.figures)]
        told = [words.replace("*", "").removesuffix(" Δt ") for words in said]
        assert [words for words in told if words not in picture] == [], AGAIN


@pytest.mark.slow
def test_every_number_of_the_first_screen_is_that_of_a_row(results):
    found = findings(sections(results))
    rows = {(row.family, row.quantity, row.case, row.engine, row.profile): row for it in results for row in it.rows}
    engines = {title: name for name, title in TITLES.items()}
    asked = {
        "dropped-ball": ("rebound", "e=0.5", "e=0.5"),
        "ball-to-rest": ("rest_time", "e=0.8", "e=0.8"),
        "sliding-slab": ("stopping_distance", "μ=0.4,v=2", "μ=0.4,v=2,heading=30°"),
    }
    seen = 0
    for finding in found:
        quantity, counted, plain = asked[finding.family]
        for figure in (it for group in finding.groups for it in group.figures):
            by_hand, installed = figure.who.startswith("by hand"), figure.who.endswith("as installed")
            engine = "handwritten" if by_hand else engines[figure.who.replace("*", "").removesuffix(" as installed")]
            step = figure.who == "by hand, at the step"
            profile = METHODS[figure.who] if by_hand else "stock" if installed else "tuned"
            row = rows[finding.family, quantity, plain if step or installed else counted, engine, profile]
            numbers = [
                float(it.replace("−", "-").replace(",", "")) for it in re.findall(r"[+−]?[\d,.]*\d", figure.said)
            ]
            if figure.said in ("never stops", "does not bounce"):
                assert row.measured is None or row.measured < 0.0025
            elif figure.said.startswith("rests after"):
                assert numbers == [pytest.approx(row.measured, abs=5e-4)]
            else:
                error = 1e3 * (row.measured - row.expected)
                assert numbers[0] == pytest.approx(error, abs=max(0.005, 0.05 * abs(error)))
                assert numbers[1:] == [] or numbers[1] == pytest.approx(1e3 * row.spread, rel=0.05)
            if figure.timestep:
                timestep = float(row.settings.split()[1])
                assert figure.timestep == f"{1e3 * timestep:.2g} ms"
            seen += 1
        theory = re.search(r"Theory: [a-z ]*([\d.]+)", finding.question)[1]
        expected = rows[finding.family, quantity, counted, "handwritten", "exact"].expected
        assert float(theory) == pytest.approx(expected * (1 if finding.family == "ball-to-rest" else 1e3), rel=1e-4)
        if short := re.search(r"stands (\d+) mm short", finding.why):  # of a slab that has no stopping distance
            (rocking,) = [it for it in results if it.job == Job("sliding-slab", "dart", "stock")]
            assert 1e3 * (expected - rocking.series.values[-1]) == pytest.approx(float(short[1]), abs=0.5)
    assert seen == 26  # nine implementations in three findings; the world slides another slab
