"""Published cases as jobs, in the cache and in recordings: what was said comes back as it was, judged anew."""

from __future__ import annotations

import datetime
import json
from dataclasses import replace

import pytest

from reference.comparison.verdicts import Verdict
from reference.engines.handwritten_engine import Handwritten
from reference.errors import EngineNotInstalled, InvalidInput, RunFailed, UnknownName
from reference.published import recorded
from reference.published.jobs import PUBLISHED, plan, run_job
from reference.published.recorded import FILE, fingerprint, recall, write
from reference.published.results import PublishedJob
from reference.published.theirs import published
from reference.recording import checksums
from reference.running import jobs
from reference.running.cache import Cache
from reference.running.jobs import run_one

DAY = datetime.date(2026, 11, 21)
NAMES = ("P5", "P11", "P19", "P22")
JOBS = [PublishedJob(name, "handwritten") for name in NAMES]


@pytest.fixture(scope="module")
def results():
    return [run_job(job) for job in JOBS]


@pytest.fixture
def folder(tmp_path, results):
    assert write(results, tmp_path, DAY) == [tmp_path / "handwritten" / FILE]
    return tmp_path


def edited(folder, change) -> None:
    path = folder / "handwritten" / FILE
    content = json.loads(path.read_text(encoding="utf-8"))
    change(content)
    path.write_text(json.dumps(content), encoding="utf-8")
    checksums.renew(folder, [path])


def test_a_plan_has_every_published_case_in_every_engine_once():
    assert len(plan((), ("handwritten", "mujoco"))) == 2 * 41
    assert plan(("p15", "P15"), ("dart",)) == [PublishedJob("P15", "dart")]
    with pytest.raises(UnknownName, match="unknown published case 'P99'"):
        plan(("P99",), ("dart",))
    with pytest.raises(UnknownName, match="unknown engine 'havok'"):
        plan((), ("havok",))


def test_a_published_job_gives_the_same_in_a_worker_and_from_the_cache(tmp_path, results):
    cache = Cache(tmp_path)
    first = run_one(JOBS[0], PUBLISHED, cache=cache)
    again = run_one(JOBS[0], PUBLISHED, cache=cache)
    assert first == results[0]
    assert [first.cached, again.cached] == [False, True]
    assert replace(again, cached=False) == first
    assert cache.get(replace(JOBS[0], case="P15")) is None


def test_a_recorded_published_case_has_the_same_rows_and_says_so(folder, results):
    for job, result in zip(JOBS, results, strict=True):
        found = recall(job, folder)
        assert found.rows == result.rows
        assert found.answers == result.answers
        assert found.title == "hand-written*"
        assert "was recorded on 2026-11-21 (Python" in found.recording


def test_a_recording_holds_numbers_which_are_judged_again(folder, monkeypatch):
    assert "pass" not in (folder / "handwritten" / FILE).read_text(encoding="utf-8")
    stricter = replace(published("P22"), expected={"impulse": 2.8})
    monkeypatch.setattr(recorded, "published", lambda name: stricter)
    assert [row.verdict for row in recall(JOBS[3], folder).rows] == [Verdict.FAIL]


def test_a_recording_of_another_set_up_is_stale(folder, monkeypatch):
    case = published("P22")
    other = replace(case, setup={**case.setup, "mass": 0.3})
    assert fingerprint(other) != fingerprint(case)
    assert fingerprint(replace(case, expected={"impulse": 2.8}, note="another")) == fingerprint(case)
    monkeypatch.setattr(recorded, "published", lambda name: other)
    (row,) = recall(JOBS[3], folder).rows
    assert (row.verdict, row.measured) == (Verdict.NOT_AVAILABLE, None)
    assert "its recording is stale" in row.note


@pytest.mark.parametrize("expected", [{"impulse": 2.71, "speed": 5.4}, {"impulse": (2.71, 2.71)}, {"change": 2.71}])
def test_a_recording_of_other_figures_is_stale(folder, monkeypatch, expected):
    other = replace(published("P22"), expected=expected, tolerance=dict.fromkeys(expected, 5e-3))
    monkeypatch.setattr(recorded, "published", lambda name: other)
    (row,) = recall(JOBS[3], folder).rows
    assert (row.verdict, row.measured) == (Verdict.NOT_AVAILABLE, None)
    assert "its recording is stale: other figures" in row.note


def test_an_engine_is_stale_while_a_case_is_missing_or_has_changed(folder, monkeypatch):
    assert recorded.is_stale("dart", folder)
    assert recorded.is_stale("handwritten", folder)
    monkeypatch.setattr(recorded, "published_cases", lambda: dict.fromkeys(NAMES))
    assert not recorded.is_stale("handwritten", folder)
    other = replace(published("P22"), setup={"mass": 0.3})
    with monkeypatch.context() as changed:
        changed.setattr(recorded, "published", lambda name: other if name == "P22" else published(name))
        assert recorded.is_stale("handwritten", folder)
    with monkeypatch.context() as changed:
        changed.setattr(Handwritten, "version", lambda engine: "99.0")
        assert recorded.is_stale("handwritten", folder)
    edited(folder, lambda content: content.update(version=99))
    assert recorded.is_stale("handwritten", folder)


def test_a_refused_case_is_recorded_with_its_reason(tmp_path):
    job = PublishedJob("P24", "pybullet")
    refused = run_job(job)
    write([refused], tmp_path, DAY)
    (row,) = recall(job, tmp_path).rows
    assert (row.verdict, row.note) == (Verdict.CANNOT_EXPRESS, refused.rows[0].note)


def test_a_published_case_that_was_never_recorded_has_no_number(folder, tmp_path):
    (row,) = recall(PublishedJob("P15", "handwritten"), folder).rows
    assert "this case was never recorded" in row.note
    assert recall(JOBS[0], tmp_path / "elsewhere") is None
    assert recall(PublishedJob("P5", "mine.py"), folder) is None


def test_only_published_cases_that_ran_here_are_recorded(folder, results, tmp_path):
    with pytest.raises(InvalidInput, match="did not run"):
        write([recall(JOBS[0], folder)], tmp_path)
    crashed = replace(results[0].rows[0], figure="", verdict=Verdict.CRASHED, note="it died")
    with pytest.raises(RunFailed, match=r"P5 in handwritten: crashed: it died; nothing is recorded"):
        write([replace(results[0], rows=(crashed,))], tmp_path)


@pytest.mark.parametrize("change", [{"schema": "another"}, {"version": 2}])
def test_a_recording_of_another_version_is_refused(folder, change):
    edited(folder, lambda content: content.update(change))
    with pytest.raises(InvalidInput, match=r"of version 1; collisions record makes a new one"):
        recall(JOBS[0], folder)


def test_a_missing_engine_answers_from_its_recording_and_is_not_cached(folder, monkeypatch, tmp_path):
    def missing(*_):
        raise EngineNotInstalled("it is not here")

    monkeypatch.setattr(jobs, "run_isolated", missing)
    monkeypatch.setattr(recorded, "FOLDER", folder)
    cache = Cache(tmp_path / "cache")
    found = run_one(JOBS[0], PUBLISHED, cache=cache)
    assert {row.verdict for row in found.rows} == {Verdict.PASS}
    assert cache.get(JOBS[0]) is None
    (row,) = run_one(PublishedJob("P5", "dart"), PUBLISHED).rows
    assert (row.verdict, row.note) == (Verdict.NOT_AVAILABLE, "it is not here")
