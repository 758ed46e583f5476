"""The whole report twice: with every engine installed, and on a machine without any, from their recordings."""

from __future__ import annotations

import json
import os
import time
from collections import Counter
from pathlib import Path

import pytest
from program import collisions
from run_allowances import spent, too_long
from whole_report import check_whole

from reference.catalogue.scenarios import catalogue
from reference.engines import engine_names, load_engine
from reference.engines.profiles import counts
from reference.pace import slowness
from reference.report.row_files import read_published, read_rows
from reference.scene.survey import Survey

ENGINES = [name for name in engine_names() if load_engine(name).package]


@pytest.fixture(autouse=True)
def cache_folder(tmp_path_factory, monkeypatch):
    """One for both: hand-written code runs alike without engines, so the second report takes the first one's runs."""
    monkeypatch.setenv("COLLISIONS_CACHE", str(tmp_path_factory.getbasetemp() / "runs of whole reports"))


PER_FAMILY, PER_ROW = 53_000, 300
"""Bytes that the page may take. Of a family: 36 kB for two figures and a small one, 10 kB for the replay and 7 kB for
its text. Of a row: its cell in a table, with the heading that a narrow screen shows, and its part of the other tables.
A page with every cell filled had 35, 9.8 and 7.1 kB, and 297 bytes."""

KEPT_VERDICTS = Path(__file__).parents[3] / "docs" / "statement_verdicts.json"


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
@pytest.mark.timeout(2400)  # took 1320 s on a machine three times slower, beside other programs
def test_in_the_whole_report_every_counted_verdict_agrees(tmp_path, installed, capsys):
    for name in engine_names():
        installed(name)
    start, here = time.monotonic(), slowness()
    said = collisions("report", "--out", tmp_path / "report")
    here = max(here, slowness())
    timings = json.loads((tmp_path / "report" / "timings.json").read_text(encoding="utf-8"))["seconds"]
    with capsys.disabled():
        print(f"\nthe whole report took {time.monotonic() - start:.0f} s")
        print(f"its runs took {sum(spent(timings, here).values()):.0f} s of the machine of the allowances")
    assert said.code == 0
    assert too_long(timings, here) == {}
    rows = read_rows(tmp_path / "report" / "rows.json")
    judged = [row for row in rows if counts(row.profile) and row.expected is not None]
    families = set(catalogue())
    assert {(row.family, row.engine) for row in judged} == {
        (family, name)
        for name in engine_names()
        for family in (families if name == "handwritten" else families - {"two-frictions"})
        if (family, name) != ("struck-cube", "mujoco")
    }
    away = [row for row in judged if str(row.verdict) not in ("pass", "known deviation")]
    assert {str(row.verdict) for row in away} == {"disagrees"}
    check_whole(rows)
    assert verdict_counts(rows) == json.loads(KEPT_VERDICTS.read_text(encoding="utf-8")), "run make docs"
    without = [row for row in rows if counts(row.profile) and str(row.verdict) == "cannot express"]
    near = sum(str(row.verdict) == "pass" for row in judged)
    silent = sum(counts(row.profile) and row.expected is None and str(row.verdict) == "pass" for row in rows)
    assert " ".join(said.text.split()).startswith(
        f"Of {len(judged) + silent:,} checks that count, {near:,} came out as predicted and"
        f" near theory, {silent} as predicted where theory is silent, {len(judged) - near} as predicted and away from"
        f" theory and none failed. Besides, {len(without)} cases cannot be expressed in the engine."
    )
    assert not [row for row in rows if str(row.verdict) in ("crashed", "not available", "needs")]
    unsaid = {(row.family, row.engine) for row in rows if str(row.verdict) == "cannot express"}
    off_centre = {("struck-cube", "mujoco"), ("off-centre-impact", "mujoco")}
    two = {(family, name) for family in ("two-frictions", "break-away") for name in engine_names()}
    assert unsaid == off_centre | {each for each in two if each[1] != "handwritten"}
    surveys = [family for family in catalogue().values() if isinstance(family.cases[0].scenarios[0], Survey)]
    assert len(os.listdir(tmp_path / "report" / "figures")) == 2 * len(catalogue()) - len(surveys) + 2
    others = {str(row.verdict) for row in read_published(tmp_path / "report" / "published.json")}
    assert others == {"pass", "known deviation", "disagrees", "cannot express", "no words"}
    size = (tmp_path / "report" / "index.html").stat().st_size
    assert size < PER_FAMILY * len(catalogue()) + PER_ROW * len(rows)


@pytest.mark.slow
@pytest.mark.timeout(2400)  # by itself it runs all hand-written code: some ten minutes on a machine three times slower
def test_in_the_whole_report_every_recorded_number_agrees(tmp_path, no_engine, one_worker):
    said = collisions("report", "--out", tmp_path / "report")
    assert said.code == 0, said.errors
    rows = read_rows(tmp_path / "report" / "rows.json")
    assert {row.engine for row in rows if row.measured is not None} == set(engine_names())
    assert {bool(row.recorded_on) for row in rows if row.engine in ENGINES and row.measured is not None} == {True}
    assert "not available" not in {str(row.verdict) for row in rows}
    told = {(row.family, row.engine, row.profile, row.case) for row in rows if row.engine in ENGINES}
    assert told == {
        (family.name, name, profile, case.name)
        for family in catalogue().values()
        for name in ENGINES
        for case in family.cases
        for profile in load_engine(name).profiles(case.scenarios[0])
    }
    judged = {str(row.verdict) for row in rows if counts(row.profile) and row.expected is not None}
    assert judged == {"pass", "known deviation", "disagrees"}
    check_whole(rows)
    page = (tmp_path / "report" / "index.html").read_text(encoding="utf-8")
    assert all(f"{load_engine(name).title}*" in page for name in ENGINES)
    others = {str(row.verdict) for row in read_published(tmp_path / "report" / "published.json")}
    assert others == {"pass", "known deviation", "disagrees", "cannot express", "no words"}
