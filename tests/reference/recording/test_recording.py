"""Recordings: what was measured comes back as it was, judged anew, or not at all where it is stale."""

from __future__ import annotations

import datetime
import json
import shutil
from dataclasses import replace

import pytest

from reference.catalogue.family import Family
from reference.catalogue.grid import Parameter
from reference.catalogue.scenarios import catalogue
from reference.comparison.compare import Number
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Row, Verdict
from reference.engines import load_engine
from reference.errors import EngineNotInstalled, InvalidInput, NotRecorded
from reference.recording import checksums, files, reading
from reference.recording.entries import Entry, case_of, names_of, timestep_of
from reference.recording.fingerprint import fingerprint
from reference.recording.making import jobs_of, why_stale, write
from reference.recording.reading import recall, replay
from reference.running import jobs
from reference.running.cache import Cache
from reference.running.jobs import run_one
from reference.running.study import SCENARIOS, run_job
from reference.scene.settings import Settings
from reference.viewer.poses import poses_of

DAY = datetime.date(2026, 11, 21)
JOBS = [Job("incline", "handwritten", profile, with_studies=True, with_poses=True) for profile in ("exact", "step")]
CASE = "μ=0.1,θ=10°"


def small_incline() -> Family:
    """Three of its cases: one that holds, one that slides, and the plotted and studied one, half a second long."""
    whole = catalogue()["incline"]
    cases = [whole.case(name) for name in ("μ=0.1,θ=3°", CASE, whole.curve.case)]
    assert whole.convergence.case == whole.curve.case
    short = [replace(case, scenarios=(replace(case.scenarios[0], duration=0.5),)) for case in cases]
    return replace(whole, cases=tuple(short), convergence=replace(whole.convergence, factors=(2.0, 1.0)))


def small_cradle() -> Family:
    """Its first case and its last two, the first and last of which are no points of its grid, and a small grid."""
    whole = catalogue()["cradle"]
    moved = Parameter("balls", "", (4.0, 5.0), 5.0), Parameter("gap", "m", (0.0, 1e-4, 1e-3), 0.0)
    grid = replace(whole.grid, parameters=moved, timesteps=(1e-3, 2e-3))
    return replace(whole, cases=whole.cases[:1] + whole.cases[-2:], grid=grid)


SMALL = {"incline": small_incline(), "cradle": small_cradle()}


@pytest.fixture(autouse=True)
def _small_families(monkeypatch):
    for name, family in SMALL.items():
        monkeypatch.setitem(catalogue(), name, family)


def run_small(jobs: list[Job]) -> list[JobResult]:
    with pytest.MonkeyPatch.context() as patched:
        for name, family in SMALL.items():
            patched.setitem(catalogue(), name, family)
        return [run_job(job) for job in jobs]


@pytest.fixture(scope="module")
def results():
    return run_small(JOBS)


@pytest.fixture(scope="module")
def written(results, tmp_path_factory):
    folder = tmp_path_factory.mktemp("incline")
    files = [folder / "handwritten" / f"incline.{kind}" for kind in ("json", "npz")]
    with pytest.MonkeyPatch.context() as patched:
        patched.setitem(catalogue(), "incline", SMALL["incline"])
        assert write(results, folder, DAY) == files
    return folder


@pytest.fixture
def folder(written, tmp_path):
    """A copy that a test may change."""
    return shutil.copytree(written, tmp_path, dirs_exist_ok=True)


def edited(folder, change) -> None:
    """Change what the file holds, as another version of the lab might have written it."""
    path = folder / "handwritten" / "incline.json"
    content = json.loads(path.read_text(encoding="utf-8"))
    change(content)
    path.write_text(json.dumps(content), encoding="utf-8")
    checksums.renew(folder, [path])
    files.forget()


def test_a_recording_returns_the_same_rows_studies_and_curve(folder, results):
    for job, result in zip(JOBS, results, strict=True):
        found = recall(job, folder)
        assert found.rows == result.rows
        assert (found.convergence, found.split) == (result.convergence, result.split)
        assert found.series.times == result.series.times
        assert found.series.values == pytest.approx(result.series.values, rel=1e-6)  # seven digits are kept
        assert (found.settings, found.description, found.version) == (
            result.settings,
            result.description,
            result.version,
        )


@pytest.mark.parametrize("values", [(2.0, 1.0, 3.0), (1.0,), (0.5, 0.5, -1.0)])
def test_the_members_of_an_ensemble_keep_their_places(values):
    row = Row("incline", CASE, "handwritten", "exact", "way", "m", Verdict.PASS, sum(values), values=values)
    kept = json.loads(json.dumps(Entry.of("0", [row]).as_json()))
    assert Entry.read(kept).numbers == (Number(values),)


def test_an_entry_is_named_after_its_timestep_in_seconds():
    own, other = Settings(1e-3), Settings(2e-3)
    assert names_of("e=0.5", own, other) == ("e=0.5 @ 0.002 s",) * 2
    assert [(case_of(name), timestep_of(name)) for name in names_of("e=0.5", own, other)] == [("e=0.5", 2e-3)] * 2
    assert [timestep_of(name) for name in names_of("e=0.5", own, own)] == [None, None]


def test_eleven_digits_are_kept_at_points_of_a_grid(results, tmp_path):
    family, third = SMALL["incline"], Row("incline", "", "handwritten", "exact", "", "", Verdict.PASS, 1 / 3)
    grid = next(job for job in jobs_of(family, "handwritten") if job.grid and job.profile == "exact")
    cases = [case.name for case in grid.cases_in(family, load_engine("handwritten"))]
    rows = [
        replace(third, case=case, quantity=each.name, values=(1 / 3,)) for case in cases for each in family.quantities
    ]
    numbers, _ = write([results[0], replace(results[0], job=grid, rows=tuple(rows), poses=())], tmp_path, DAY)
    kept = json.loads(numbers.read_text(encoding="utf-8"))["profiles"]["exact"]["entries"]
    assert [0.33333333333] * len(family.quantities) in [values for _, values in kept.values()]


def test_a_recording_says_when_and_where_it_was_made(folder):
    found = recall(JOBS[0], folder)
    assert found.title == "hand-written*"
    assert found.recording.startswith("* hand-written ")
    assert "was recorded on 2026-11-21 (Python" in found.recording
    assert found.recording.endswith("; it is not run here")


def test_some_cases_of_a_recording_can_be_recalled_alone(folder, results):
    some = replace(JOBS[0], cases=(CASE,))
    rows = recall(some, folder).rows
    assert rows == tuple(row for row in results[0].rows if row.case == CASE)
    assert rows


def test_studies_are_recalled_only_on_request(folder):
    found = recall(replace(JOBS[0], with_studies=False), folder)
    assert found.convergence is found.split is None
    assert found.series is not None


def test_a_job_that_was_never_recorded_has_no_recording(folder):
    assert recall(replace(JOBS[0], profile="slide"), folder) is None
    assert recall(Job("stack", "handwritten", "exact"), folder) is None


def test_a_stale_case_has_no_number_while_the_others_answer(folder):
    def other_scenario(content):
        content["profiles"]["exact"]["entries"][CASE][0] = "0" * 16

    edited(folder, other_scenario)
    stale = [row for row in recall(JOBS[0], folder).rows if row.verdict is Verdict.NOT_AVAILABLE]
    assert [row.case for row in stale] == [CASE]
    assert stale[0].measured is None
    assert "its recording is stale: scenario or settings have changed" in stale[0].note
    assert "collisions record" in stale[0].note


def test_the_curve_and_studies_of_a_stale_case_are_not_shown(folder, monkeypatch):
    family = catalogue()["incline"]

    def other_scenario(name):
        cases = [replace(case, scenarios=other(case.scenarios)) if case.name == name else case for case in family.cases]
        monkeypatch.setattr(reading, "catalogue", lambda: {"incline": replace(family, cases=tuple(cases))})
        return recall(JOBS[0], folder)

    def other(scenarios):
        return tuple(replace(scenario, duration=9.0) for scenario in scenarios)

    found = other_scenario(family.convergence.case)
    assert found.convergence is found.split is None
    assert other_scenario(family.curve.case).series is None


def test_a_quantity_added_after_the_recording_makes_a_case_stale(folder):
    def without_the_way(content):
        content["profiles"]["exact"]["quantities"].remove("way")
        for entry in content["profiles"]["exact"]["entries"].values():
            entry[1].pop()

    edited(folder, without_the_way)
    rows = recall(JOBS[0], folder).rows
    assert {row.verdict for row in rows} == {Verdict.NOT_AVAILABLE}
    assert "stale: it has no way" in rows[0].note


def test_a_case_that_was_never_recorded_says_so(folder):
    edited(folder, lambda content: content["profiles"]["exact"]["entries"].pop(CASE))
    (missing,) = [row for row in recall(JOBS[0], folder).rows if row.verdict is Verdict.NOT_AVAILABLE]
    assert missing.note == "hand-written is not installed here, and this case was never recorded"


def test_other_settings_than_the_recorded_ones_have_no_number(folder):
    found = recall(replace(JOBS[0], changes=(("policy", "at_step"),)), folder)
    assert {row.verdict for row in found.rows} == {Verdict.NOT_AVAILABLE}
    assert found.rows[0].note == "hand-written is not installed here, and with policy=at_step nothing was recorded"
    assert found.series is found.convergence is found.split is None


def test_a_changed_tolerance_judges_the_recorded_number_again(folder, monkeypatch):
    family = catalogue()["incline"]

    def far(case, settings, method):
        return replace(way.expect(case, settings, method), value=1e3)

    way = family.quantity("way")
    other = replace(family, quantities=tuple(replace(q, expect=far) if q is way else q for q in family.quantities))
    monkeypatch.setattr(reading, "catalogue", lambda: {"incline": other})
    verdicts = {row.verdict for row in recall(JOBS[0], folder).rows if row.quantity == "way"}
    assert verdicts == {Verdict.FAIL}


def test_only_a_whole_unchanged_run_is_recorded(results, tmp_path):
    whole = results[0]
    for part in (
        replace(whole, job=replace(whole.job, cases=(CASE,))),
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
def test_a_file_without_a_recording_is_refused_by_name(content, tmp_path):
    path = tmp_path / "handwritten" / "incline.json"
    path.parent.mkdir()
    path.write_text(content, encoding="utf-8")
    checksums.renew(tmp_path, [path])
    files.forget()
    with pytest.raises(InvalidInput, match=r"incline\.json' is no recording"):
        recall(JOBS[0], tmp_path)


def test_a_fingerprint_changes_with_everything_a_number_depends_on():
    engine, case = load_engine("handwritten"), catalogue()["incline"].case(CASE)
    scenario = case.scenarios[0]
    settings = engine.settings(scenario, "exact")
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
    rounded = replace(scenario, duration=scenario.duration * (1 + 1e-15), gravity=(1e-17, -0.0, scenario.gravity[2]))
    assert fingerprint(replace(case, scenarios=(rounded,)), settings) == prints[0]  # on another machine, say
    assert fingerprint(replace(case, name="other"), settings) == prints[0]


@pytest.mark.slow
def test_a_recording_answers_for_the_labs_own_steering_and_for_no_other():
    job = Job("antipodal-circle", "mujoco", "tuned")
    assert {row.verdict for row in recall(job).rows} == {Verdict.PASS, Verdict.SHOWN}
    other = replace(job, implementation="mine.py | solutions")
    rows = recall(other).rows
    assert [(row.case, row.verdict, row.note) for row in rows] == [
        (case.name, Verdict.NOT_AVAILABLE, reading.OWN_STEERING) for case in catalogue()["antipodal-circle"].cases
    ]
    with pytest.raises(NotRecorded, match="the lab's own steering"):
        replay(other, "τ=1")
    without_steering = Job("two-balls", "mujoco", "tuned", implementation="mine.py | solutions")
    assert all(row.measured is not None for row in recall(without_steering).rows)


@pytest.mark.parametrize(
    ("text", "chain", "answered"),
    [
        ("def signed_distance(point, plane):\n    return 0.0\n", "mine.py | labs.given", True),
        ("def signed_distance(point, plane):\n    return 0.0\n", "mine.py | solutions", True),
        ("", "labs.given", True),
        ("def seek(position, target, max_speed):\n    return position\n", "labs.given | mine.py", False),
        ("def seek(position, target, max_speed):\n    return position\n", "solutions | mine.py", True),
        ("def seek(position, target, max_speed):\n    return position\n", "mine.py | labs.given", False),
        ("steering_force = max\n", "mine.py | solutions", False),
        ("from elsewhere import *\n", "mine.py | solutions", False),
        ("", "mine.py", False),
        ("", "theirs | solutions", False),
    ],
)
def test_code_that_writes_no_rule_is_answered_with_the_labs_steering(text, chain, answered, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.py").write_text(text, encoding="utf-8")
    rows = recall(Job("lone-flier", "mujoco", "tuned", implementation=chain)).rows
    assert {row.verdict is not Verdict.NOT_AVAILABLE for row in rows} == {answered}


def test_a_missing_engine_answers_from_its_recording_and_is_not_cached(folder, monkeypatch, tmp_path):
    def missing(*_):
        raise EngineNotInstalled("it is not here")

    monkeypatch.setattr(jobs, "run_isolated", missing)
    monkeypatch.setattr(files, "FOLDER", folder)
    cache = Cache(tmp_path / "cache")
    found = run_one(JOBS[0], SCENARIOS, cache=cache)
    assert found.recording
    assert found.rows[0].measured is not None
    assert cache.get(JOBS[0]) is None
    without = run_one(Job("stack", "handwritten", "exact"), SCENARIOS)
    assert [row.verdict for row in without.rows] == [Verdict.NOT_AVAILABLE]


# Points of a grid


@pytest.fixture(scope="module")
def cradle(tmp_path_factory):
    """The whole recording of a small family: cases, grid and poses."""
    folder = tmp_path_factory.mktemp("cradle")
    results = run_small([replace(job, with_studies=False) for job in jobs_of(SMALL["cradle"], "handwritten")])
    with pytest.MonkeyPatch.context() as patched:
        patched.setitem(catalogue(), "cradle", SMALL["cradle"])
        write(results, folder, DAY)
    return folder, results


@pytest.mark.slow
def test_every_point_of_a_recorded_grid_returns_the_same_rows(cradle):
    folder, results = cradle
    for result in results:
        found = recall(result.job, folder)
        for then, now in zip(result.rows, found.rows, strict=True):
            assert (then.case, then.quantity, then.verdict) == (now.case, now.quantity, now.verdict)
            assert now.measured == pytest.approx(then.measured, rel=1e-10, abs=0)  # eleven digits are kept of a grid
    for grid in (True, False):
        steps = {dict(result.job.changes).get("timestep") for result in results if result.job.grid == grid}
        assert steps >= {None, 2e-3}


@pytest.mark.slow
def test_parameters_are_found_at_grid_points_and_not_between_them(cradle):
    folder, _ = cradle
    job = Job("cradle", "handwritten", "step", changes=(("timestep", 2e-3),), at=(("balls", 4.0), ("gap", 1e-4)))
    live, found = run_job(job), recall(job, folder)
    assert [row.measured for row in found.rows] == pytest.approx([row.measured for row in live.rows], rel=1e-10)
    assert {row.case for row in found.rows} == {"4, 100 µm apart"}
    assert found.series.times == live.series.times
    assert found.series.values == pytest.approx(live.series.values, rel=1e-6)  # seven digits are kept
    (row,) = recall(replace(job, at=(("balls", 4.0), ("gap", 2e-4))), folder).rows
    assert "with balls=4.0, gap=0.0002, timestep=0.002 nothing was recorded" in row.note


@pytest.mark.slow
def test_a_recorded_case_is_found_at_its_grid_timestep(cradle):
    folder, _ = cradle
    rows = recall(Job("cradle", "handwritten", "exact", changes=(("timestep", 2e-3),)), folder).rows
    assert {row.case for row in rows} == {"3 touching", "5, 1 mm apart", "5, 1 mm apart, two struck"}
    assert {row.verdict for row in rows} & {Verdict.NOT_AVAILABLE, Verdict.CRASHED} == set()
    job = Job("cradle", "handwritten", "step", ("3 touching",), changes=(("timestep", 2e-3),), with_poses=True)
    job = replace(job, with_curve=True)
    live, found = run_job(job), recall(job, folder)
    assert found.series.times == live.series.times
    assert [track.packed for track in found.poses] == [track.packed for track in live.poses]


@pytest.mark.slow
def test_a_timestep_without_recording_is_refused_with_the_recorded_ones(cradle):
    folder, _ = cradle
    job = Job("cradle", "handwritten", "exact", ("3 touching",), changes=(("timestep", 3e-3),))
    (row,) = {row.note for row in recall(job, folder).rows}
    absent = "hand-written is not installed here"
    assert row == f"{absent}; it was recorded with timesteps of 1 and 2 ms, not of 3 ms"
    (row,) = {row.note for row in recall(replace(job, at=(("gap", 1e-4),), cases=()), folder).rows}
    assert row == f"{absent}; it was recorded with timesteps of 1 and 2 ms, not of 3 ms"
    (row,) = {row.note for row in recall(replace(job, changes=(("policy", "x"), *job.changes)), folder).rows}
    assert row == f"{absent}, and with policy=x, timestep=0.003 nothing was recorded"


@pytest.mark.slow
def test_a_recording_of_changed_scenarios_is_stale_and_says_why(cradle, monkeypatch):
    folder, _ = cradle
    family = catalogue()["cradle"]
    assert why_stale(family, "handwritten", folder) == ""
    first, *others = family.cases
    other = replace(first, scenarios=(replace(first.scenarios[0], duration=9.0),))
    changed = replace(family, cases=(other, *others))
    assert why_stale(changed, "handwritten", folder) == "exact, 3 touching has changed since it was recorded"
    assert why_stale(replace(family, quantities=family.quantities[1:]), "handwritten", folder)
    assert why_stale(family, "mujoco", folder) == "never recorded"
    monkeypatch.setattr(type(load_engine("handwritten")), "version", lambda self: "0.0")
    assert why_stale(family, "handwritten", folder).endswith("here is 0.0")


@pytest.mark.slow
def test_the_same_results_make_the_same_files(cradle, tmp_path):
    folder, results = cradle
    write(results, tmp_path, DAY)
    for name in ("cradle.json", "cradle.npz"):
        assert (tmp_path / "handwritten" / name).read_bytes() == (folder / "handwritten" / name).read_bytes()


# Poses


@pytest.mark.slow
def test_a_recorded_replay_agrees_with_the_run_itself(cradle):
    folder, _ = cradle
    engine, case = load_engine("handwritten"), catalogue()["cradle"].case("5, 1 mm apart")
    for changes in ((), (("timestep", 1e-3),)):
        found = replay(Job("cradle", "handwritten", "step", changes=changes), case.name, folder)
        settings = engine.settings(case.scenarios[0], "step").change(**dict(changes))
        live = poses_of(engine.run(case.scenarios[0], settings))
        assert found.bodies == live.bodies == tuple(f"ball {number}" for number in range(1, 6))
        assert abs(found.positions - live.positions).max() <= 0.5e-5 + 1e-12  # half of 0.01 mm
        assert (found.title, found.recording[:15]) == ("hand-written*", "* hand-written ")


@pytest.mark.slow
def test_a_recorded_result_has_the_same_poses_as_a_live_one(cradle):
    folder, results = cradle
    for result in results[:2]:  # the cases, then the grid
        assert [track.packed for track in recall(result.job, folder).poses] == [track.packed for track in result.poses]
        assert result.poses
        assert recall(replace(result.job, with_poses=False), folder).poses == ()


@pytest.mark.slow
def test_a_replay_that_is_missing_or_stale_is_refused(cradle, monkeypatch):
    folder, _ = cradle
    job = Job("cradle", "handwritten", "exact")
    with pytest.raises(NotRecorded, match="no poses of 3 touching were recorded with these settings"):
        replay(replace(job, changes=(("timestep", 3e-3),)), "3 touching", folder)
    first, *others = catalogue()["cradle"].cases
    other = replace(first, scenarios=(replace(first.scenarios[0], duration=9.0),))
    changed = replace(catalogue()["cradle"], cases=(other, *others))
    monkeypatch.setattr(reading, "catalogue", lambda: {"cradle": changed})
    with pytest.raises(NotRecorded, match="poses of 3 touching are stale; collisions record makes new ones"):
        replay(job, "3 touching", folder)
