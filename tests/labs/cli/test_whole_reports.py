"""The whole report: what every engine gave live, what its recordings give without it, and the page that shows it."""

from __future__ import annotations

import json
import os
from collections import Counter
from pathlib import Path

import live
import pytest
from program import collisions
from readme_picture import AGAIN, in_the_picture
from run_allowances import too_long
from whole_report import check_whole

from reference.catalogue.scenarios import catalogue
from reference.comparison.verdicts import Verdict
from reference.engines import engine_names, load_engine
from reference.engines.handwritten.scenario_kind import kind
from reference.engines.profiles import counts
from reference.published import jobs as published_jobs
from reference.report.overview import verdict_line
from reference.report.row_files import read_published, read_rows
from reference.scene.survey import Survey

ENGINES = [name for name in engine_names() if load_engine(name).package]
PER_FAMILY, PER_ROW = 71_000, 300
"""Bytes that the page may take. Of a family: 54 kB for two figures and a small one, 10 kB for the replay and 7 kB for
its text. Of a row: its cell in a table, with the heading that a narrow screen shows, and its part of the other tables.
A page with every cell filled had 9.8 and 7.1 kB, and 297 bytes. The figures of `dropped-ball`, `two-balls` and
`sliding-slab` take 55 kB each, those of most families less."""
PUBLISHED_VERDICTS = {"pass", "known deviation", "disagrees", "cannot express", "no words"}
KEPT_VERDICTS = Path(__file__).parents[3] / "docs" / "statement_verdicts.json"


@pytest.fixture
def live_runs(installed, monkeypatch):
    """The results of the live runs of every engine, and a cache that has them."""
    for name in engine_names():
        installed(name)
    monkeypatch.setenv("COLLISIONS_CACHE", str(live.FOLDER))
    return [live.result(*run) for run in live.planned()]


def verdict_counts(rows):
    """By family and implementation, how many numbers of its first profile that counts got each verdict."""
    found = {
        family: {name: Counter() for name in ("handwritten", "pybullet", "mujoco", "dart")} for family in catalogue()
    }
    for row in rows:
        if row.profile == next(filter(counts, catalogue()[row.family].profiles(load_engine(row.engine)))):
            found[row.family][row.engine][str(row.verdict)] += 1
    return {family: {name: dict(own) for name, own in engines.items()} for family, engines in found.items()}


@pytest.mark.slow
def test_in_live_runs_every_counted_verdict_agrees(live_runs):
    rows = [row for result in live_runs for row in result.rows]
    judged = [row for row in rows if counts(row.profile) and row.expected is not None]
    families = set(catalogue())
    assert {(row.family, row.engine) for row in judged} == {
        (family, name)
        for name in engine_names()
        for family in (families if name == "handwritten" else families - {"two-frictions"})
        if (family, name) != ("struck-cube", "mujoco")
    }
    away = [row for row in judged if row.verdict not in (Verdict.PASS, Verdict.KNOWN_DEVIATION)]
    assert {row.verdict for row in away} == {Verdict.DISAGREES}
    check_whole(rows)
    assert verdict_counts(rows) == json.loads(KEPT_VERDICTS.read_text(encoding="utf-8")), "run make verdicts"
    without = [row for row in rows if counts(row.profile) and row.verdict is Verdict.CANNOT_EXPRESS]
    idle = sum(counts(row.profile) and not row.evidence for row in rows)
    judged = [row for row in judged if row.evidence]
    near = sum(row.verdict is Verdict.PASS for row in judged)
    silent = [row for row in rows if counts(row.profile) and row.expected is None and row.verdict is Verdict.PASS]
    silent = sum(row.evidence for row in silent)
    assert verdict_line(rows).startswith(
        f"Of {len(judged) + silent:,} checks that count, {near:,} came out as predicted and"
        f" near theory, {silent} as predicted where theory is silent, {len(judged) - near} as predicted and away from"
        f" theory and none failed. Besides, {idle:,} checks would pass even if no body moved and {len(without)} cases"
        " cannot be expressed in the engine."
    )
    assert verdict_line(rows) in in_the_picture(), AGAIN
    assert not [row for row in rows if row.verdict in (Verdict.CRASHED, Verdict.NOT_AVAILABLE, Verdict.NEEDS)]
    unsaid = {(row.family, row.engine) for row in rows if row.verdict is Verdict.CANNOT_EXPRESS}
    off_centre = {("struck-cube", "mujoco"), ("off-centre-impact", "mujoco")}
    two = {(family, name) for family in ("two-frictions", "break-away") for name in engine_names()}
    assert unsaid == off_centre | {each for each in two if each[1] != "handwritten"}


@pytest.mark.slow
def test_no_live_run_took_twice_its_allowance(live_runs):
    assert too_long(live_runs, float(live.SLOWNESS.read_text(encoding="utf-8"))) == {}


@pytest.mark.slow
def test_every_verdict_on_a_published_case_is_one_of_five(live_runs):
    found = [live.published(job) for job in published_jobs.plan((), engine_names())]
    assert {str(row.verdict) for result in found for row in result.rows} == PUBLISHED_VERDICTS


@pytest.mark.weekly
def test_the_whole_page_shows_every_family_in_a_bounded_size(live_runs, tmp_path):
    said = collisions("report", "--out", tmp_path / "report")
    assert said.code == 0
    rows = read_rows(tmp_path / "report" / "rows.json")
    assert Counter(map(repr, rows)) == Counter(repr(row) for result in live_runs for row in result.rows)
    assert said.text.startswith(" ".join(verdict_line(rows).split()))
    surveys = [family for family in catalogue().values() if isinstance(family.cases[0].scenarios[0], Survey)]
    assert len(os.listdir(tmp_path / "report" / "figures")) == 2 * len(catalogue()) - len(surveys) + 2
    others = {str(row.verdict) for row in read_published(tmp_path / "report" / "published.json")}
    assert others == PUBLISHED_VERDICTS
    size = (tmp_path / "report" / "index.html").stat().st_size
    assert size < PER_FAMILY * len(catalogue()) + PER_ROW * len(rows)


def one_family_for_each_driver() -> list[str]:
    """The families whose plotted cases are the first for their hand-written step loop."""
    scenarios = {name: family.case(family.curve.case).scenarios[0] for name, family in catalogue().items()}
    first = {(kind(scenario), type(scenario)): name for name, scenario in reversed(scenarios.items())}
    return list(first.values())


@pytest.mark.slow
def test_without_engines_a_report_has_every_number_from_recordings(tmp_path, monkeypatch, no_engine, one_worker):
    monkeypatch.setenv("COLLISIONS_CACHE", str(live.FOLDER))  # hand-written code runs alike without engines
    families = one_family_for_each_driver()
    said = collisions("report", *(word for name in families for word in ("--only", name)), "--out", tmp_path / "report")
    assert said.code == 0, said.errors
    rows = read_rows(tmp_path / "report" / "rows.json")
    assert {row.engine for row in rows if row.measured is not None} == set(engine_names())
    assert {bool(row.recorded_on) for row in rows if row.engine in ENGINES and row.measured is not None} == {True}
    assert "not available" not in {str(row.verdict) for row in rows}
    told = {(row.family, row.engine, row.profile, row.case) for row in rows if row.engine in ENGINES}
    assert told == {
        (name, engine, profile, case.name)
        for name in families
        for engine in ENGINES
        for case in catalogue()[name].cases
        for profile in load_engine(engine).profiles(case.scenarios[0])
    }
    judged = {str(row.verdict) for row in rows if counts(row.profile) and row.expected is not None}
    assert judged <= {"pass", "known deviation", "disagrees"}
    page = (tmp_path / "report" / "index.html").read_text(encoding="utf-8")
    assert all(f"{load_engine(name).title}*" in page for name in ENGINES)
