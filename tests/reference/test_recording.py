"""Recordings: what was measured comes back as it was, judged anew, or not at all where it is stale."""

from __future__ import annotations

import datetime
import json
from dataclasses import replace

import pytest

from reference import recording, running
from reference.cache import Cache
from reference.compare import Verdict
from reference.engines import load_engine
from reference.errors import EngineNotInstalled, InvalidInput
from reference.recording import fingerprint, recall, write
from reference.results import Job
from reference.scenarios import catalogue
from reference.study import run_job, run_safely

DAY = datetime.date(2026, 11, 21)
JOBS = [Job("incline", "handwritten", profile, with_studies=True) for profile in ("tuned", "stock")]


@pytest.fixture(scope="module")
def results():
    return [run_job(job) for job in JOBS]


@pytest.fixture
def folder(tmp_path, results):
    assert write(results, tmp_path, DAY) == [tmp_path / "handwritten" / "incline.json"]
    return tmp_path


def edited(folder, change) -> None:
    """Change what the file holds."""
    path = folder / "handwritten" / "incline.json"
    content = json.loads(path.read_text(encoding="utf-8"))
    change(content)
    path.write_text(json.dumps(content), encoding="utf-8")
    recording._content.cache_clear()


def test_what_was_measured_comes_back_with_the_same_rows_and_studies(folder, results):
    for job, result in zip(JOBS, results, strict=True):
        found = recall(job, folder)
        assert found.rows == result.rows
        assert (found.series, found.convergence, found.split) == (result.series, result.convergence, result.split)
        assert (found.settings, found.description, found.version) == (
            result.settings,
            result.description,
            result.version,
        )


def test_it_says_that_it_is_a_recording_when_and_where_it_was_made(folder):
    found = recall(JOBS[0], folder)
    assert found.title == "hand-written*"
    assert found.recording.startswith("* hand-written ")
    assert "was recorded on 2026-11-21 (Python" in found.recording
    assert found.recording.endswith("; it is not run here")


def test_some_cases_of_a_recording_are_those_cases(folder, results):
    some = replace(JOBS[0], cases=("μ=0.1,θ=10°",))
    rows = recall(some, folder).rows
    assert rows == tuple(row for row in results[0].rows if row.case == "μ=0.1,θ=10°")
    assert rows


def test_without_studies_none_are_given(folder):
    found = recall(replace(JOBS[0], with_studies=False), folder)
    assert found.convergence is found.split is None
    assert found.series is not None


def test_what_was_never_recorded_has_no_recording(folder):
    assert recall(replace(JOBS[0], profile="slide"), folder) is None
    assert recall(Job("stack", "handwritten", "tuned"), folder) is None


def test_a_stale_case_says_so_and_gives_no_number_while_the_others_answer(folder):
    def other_scenario(content):
        content["profiles"]["tuned"]["cases"]["μ=0.1,θ=10°"]["fingerprint"] = "0" * 16

    edited(folder, other_scenario)
    stale = [row for row in recall(JOBS[0], folder).rows if row.verdict is Verdict.NOT_AVAILABLE]
    assert [row.case for row in stale] == ["μ=0.1,θ=10°"]
    assert stale[0].measured is None
    assert "its recording is stale: scenario or settings have changed" in stale[0].note
    assert "collisions record" in stale[0].note


def test_a_quantity_that_is_measured_only_since_makes_a_case_stale(folder):
    def without_the_way(content):
        del content["profiles"]["tuned"]["cases"]["μ=0.1,θ=10°"]["numbers"]["way"]

    edited(folder, without_the_way)
    (stale,) = [row for row in recall(JOBS[0], folder).rows if row.verdict is Verdict.NOT_AVAILABLE]
    assert "stale: it has no way" in stale.note


def test_a_case_that_was_never_recorded_says_so(folder):
    edited(folder, lambda content: content["profiles"]["tuned"]["cases"].pop("μ=0.1,θ=10°"))
    (missing,) = [row for row in recall(JOBS[0], folder).rows if row.verdict is Verdict.NOT_AVAILABLE]
    assert missing.note == "hand-written is not installed here, and this case was never recorded"


def test_other_settings_than_the_recorded_ones_have_no_number(folder):
    found = recall(replace(JOBS[0], changes=(("timestep", 2e-3),)), folder)
    assert {row.verdict for row in found.rows} == {Verdict.NOT_AVAILABLE}
    assert "with timestep=0.002 nothing was recorded" in found.rows[0].note
    assert found.series is found.convergence is found.split is None


def test_a_tolerance_that_has_changed_since_judges_the_old_number_anew(folder, monkeypatch):
    family = catalogue()["incline"]

    def far(case, settings, method):
        return replace(way.expect(case, settings, method), value=1e3)

    way = family.quantity("way")
    other = replace(family, quantities=tuple(replace(q, expect=far) if q is way else q for q in family.quantities))
    monkeypatch.setattr(recording, "catalogue", lambda: {"incline": other})
    verdicts = {row.verdict for row in recall(JOBS[0], folder).rows if row.quantity == "way"}
    assert verdicts == {Verdict.FAIL}


def test_only_a_whole_run_of_its_own_is_recorded(results, tmp_path):
    whole = results[0]
    for part in (
        replace(whole, job=replace(whole.job, cases=("μ=0.1,θ=10°",))),
        replace(whole, job=replace(whole.job, changes=(("timestep", 2e-3),))),
        replace(whole, version=""),
        replace(whole, recording="* elsewhere"),
    ):
        with pytest.raises(InvalidInput, match="only what an engine measured here is recorded"):
            write([part], tmp_path)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "content", ["{", "[]", '{"schema": "other", "version": 1}', '{"schema": "collisions-lab/recording", "version": 99}']
)
def test_a_file_that_is_no_recording_is_refused_by_name(content, tmp_path):
    path = tmp_path / "handwritten" / "incline.json"
    path.parent.mkdir()
    path.write_text(content, encoding="utf-8")
    recording._content.cache_clear()
    with pytest.raises(InvalidInput, match=r"incline\.json' is no recording"):
        recall(JOBS[0], tmp_path)


def test_a_fingerprint_changes_with_all_that_a_number_hangs_on_and_with_nothing_else():
    engine, case = load_engine("handwritten"), catalogue()["incline"].case("μ=0.1,θ=10°")
    scenario = case.scenarios[0]
    settings = engine.settings(scenario, "tuned")
    body = next(body for body in scenario.bodies if not body.immovable)
    others = [
        replace(scenario, duration=scenario.duration + 1e-9),
        replace(scenario, gravity=(0.0, 0.0, -9.8)),
        replace(scenario, bodies=tuple(replace(b, mass=2.0) if b is body else b for b in scenario.bodies)),
        replace(scenario, pairs=tuple(replace(pair, restitution=0.1) for pair in scenario.pairs)),
    ]
    prints = [fingerprint(replace(case, scenarios=(other,)), settings) for other in (scenario, *others)]
    prints += [fingerprint(case, settings.change(timestep=2e-3)), fingerprint(case, settings.change(policy="at_step"))]
    assert len(set(prints)) == len(prints)
    assert fingerprint(replace(case, name="other"), settings) == prints[0]


def test_an_engine_that_is_missing_answers_from_its_recording_and_is_not_cached(folder, monkeypatch, tmp_path):
    def missing(*_):
        raise EngineNotInstalled("it is not here")

    monkeypatch.setattr(running, "run_isolated", missing)
    monkeypatch.setattr(recording, "FOLDER", folder)
    cache = Cache(tmp_path / "cache")
    found = run_safely(JOBS[0], cache=cache)
    assert found.recording
    assert found.rows[0].measured is not None
    assert cache.get(JOBS[0]) is None
    without = run_safely(Job("stack", "handwritten", "tuned"))
    assert [row.verdict for row in without.rows] == [Verdict.NOT_AVAILABLE]
