"""The recordings that the lab comes with: whole, of what is asked today, and what a live engine measures again."""

from __future__ import annotations

import functools
import hashlib
import random
import warnings
from dataclasses import replace

import live
import numpy as np
import pytest
from agreeing import same, same_curve

from reference.catalogue.scenarios import catalogue
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Verdict
from reference.engines import engine_names, load_engine
from reference.published import recorded
from reference.published.jobs import plan
from reference.recording import checksums
from reference.recording.entries import Entry, case_of
from reference.recording.files import FOLDER, content_of, never_recorded, tracks_of
from reference.recording.making import OTHER_VERSION, jobs_of, why_stale
from reference.recording.reading import recall, replay
from reference.report import sensitivity
from reference.running.study import run_job
from reference.viewer.tracks import LENGTH, TURN, unpack

ENGINES = tuple(name for name in engine_names() if load_engine(name).package is not None)
JOBS = [
    Job(family.name, name, profile, with_studies=True)
    for name in ENGINES
    for family in catalogue().values()
    for profile in family.profiles(load_engine(name))
]
PUBLISHED = {f"{name}/{recorded.FILE}" for name in ENGINES}
NOT_EXPRESSED = [*((name, "two-frictions") for name in ENGINES), ("mujoco", "struck-cube")]
"""Engines, and families of which they can express no case, so that there are no poses."""
MOST_BYTES = 10_000_000
CHECKSUM = "f44ead441f055c2ea9d359e176a390892c11eee28b78c34eaa5d0e40bcf2d772"
"""Over all recordings, as `collisions record` prints it at its end. Only a person changes it here, in the same commit
as the recordings, and says why: so no number of a recording changes unnoticed, not even together with its checksum."""
SENSITIVITY = "2d29982883022b923727fea6f8bf45a1ac863eed9c5da37c30c84cfb22a8fa66"
"""Of the file of the smallest faults, which `python -m reference.report.sensitivity --keep` writes."""
POINTS = 40
"""Points of the grids that `make weekly` runs again, of each engine; `make verify` the first few of them."""
STRAIGHT = (
    "ball-to-rest",
    "corner",
    "dropped-ball",
    "incline",
    "projectile",
    "rolling-ball",
    "sliding-ball",
    "sliding-slab",
    "spinning-ball",
    "thin-wall",
    "two-balls",
    "two-walls",
)
"""Families whose motion does not magnify what rounding does: one moving body, or one impact of two smooth balls.

A cradle that touches or a rod whose end is met at a step's edge may go the other way for the last bit of a number.
"""


def is_recorded(family: str, engine: str) -> bool:
    """Whether an engine has recorded a family; a new one that nobody has recorded yet fails no test."""
    return not never_recorded(family, (engine,))


TURNS = {family: ENGINES[number % len(ENGINES)] for number, family in enumerate(catalogue())}
"""Of each family the engine in which `make test` may judge its recording again. It does so for every fourth family. For
all of them it looks up, without judging, that a recording is there and of today's scenarios. `make verify` compares
them with live runs, verdicts included."""
JUDGED = [job for job in JOBS if job.profile == "tuned" and job.engine == TURNS[job.family]][::4]


@functools.cache
def recalled(job: Job) -> JobResult | None:
    return recall(job)


@pytest.mark.parametrize("job", JUDGED, ids=str)
def test_recorded_tuned_numbers_agree_with_theory(job):
    if not is_recorded(job.family, job.engine):
        return
    found = recalled(job)
    assert not [row for row in found.rows if row.verdict in (Verdict.FAIL, Verdict.CRASHED, Verdict.NOT_AVAILABLE)]
    assert {row.case for row in found.rows} == {case.name for case in catalogue()[job.family].cases}
    assert found.series is not None or Verdict.CANNOT_EXPRESS in {row.verdict for row in found.rows}


@pytest.mark.slow
@pytest.mark.parametrize("engine", ENGINES)
def test_every_case_grid_point_and_replay_is_recorded_and_up_to_date(engine):
    for family in catalogue():
        if words := never_recorded(family, (engine,)):
            warnings.warn(words, stacklevel=1)
    kept = [family for family in catalogue().values() if is_recorded(family.name, engine)]
    stale = {family.name: why_stale(family, engine) for family in kept}
    # An engine may be newer here than the one that was recorded.
    assert {name: why for name, why in stale.items() if why and not why.startswith(OTHER_VERSION)} == {}


@pytest.mark.parametrize("family", ["sliding-slab", "incline"])
def test_mujocos_slabs_are_as_predicted_at_ten_times_their_timestep(family):
    found = recall(Job(family, "mujoco", "tuned", changes=(("timestep", 1e-3),), grid=True))
    assert {row.verdict for row in found.rows} <= {Verdict.PASS, Verdict.KNOWN_DEVIATION}


@pytest.mark.parametrize("engine", ENGINES)
def test_every_profile_has_the_curve_that_a_report_plots(engine):
    for family in catalogue().values():
        if not is_recorded(family.name, engine) or (engine, family.name) in NOT_EXPRESSED:
            continue
        tracks, _ = tracks_of(engine, family.name)
        drawn = {(profile, case_of(key)) for (profile, key), track in tracks.items() if track.curve}
        entries = content_of(engine, family.name)["profiles"]
        for profile in family.profiles(load_engine(engine)):
            expressed = Entry.read(entries[profile]["entries"][family.curve.case]).verdict is None
            assert not expressed or (profile, family.curve.case) in drawn, (family.name, profile)


def test_the_smallest_faults_are_those_that_were_kept():
    assert hashlib.sha256(sensitivity.FILE.read_bytes()).hexdigest() == SENSITIVITY


def test_the_recordings_are_small_and_hold_no_unknown_run():
    files = {path.relative_to(FOLDER) for path in FOLDER.rglob("*") if path.is_file()}
    jobs = [job for job in JOBS if is_recorded(job.family, job.engine)]
    kept = {f"{job.engine}/{job.family}.json" for job in jobs}
    kept |= {f"{job.engine}/{job.family}.npz" for job in jobs if (job.engine, job.family) not in NOT_EXPRESSED}
    assert {path.as_posix() for path in files} == kept | PUBLISHED | {checksums.CHECKSUMS}
    assert sum((FOLDER / path).stat().st_size for path in files) < MOST_BYTES


def test_no_recording_was_changed_since_it_was_made():
    assert checksums.changed(FOLDER) == {}
    assert checksums.over_all(FOLDER) == CHECKSUM, "if they were recorded again, put their checksum here"


def test_a_family_without_recordings_is_named_with_the_command_to_run():
    words = "tossed-ball was never recorded in MuJoCo and DART; collisions record tossed-ball does it"
    assert never_recorded("tossed-ball", ("handwritten", "mujoco", "dart", "mine.py")) == words
    assert never_recorded("corner", ENGINES) == ""


@pytest.mark.parametrize("name", ENGINES)
def test_every_published_case_is_recorded_and_none_fails(name):
    results = [recorded.recall(job) for job in plan((), (name,))]
    verdicts = {row.case: (row.verdict, row.note) for result in results for row in result.rows}
    wrong = (Verdict.NOT_AVAILABLE, Verdict.FAIL, Verdict.CRASHED)
    assert not {case: note for case, (verdict, note) in verdicts.items() if verdict in wrong}


def test_a_replay_starts_and_ends_with_its_scenario():
    """One of each family: first positions are the scenario's, to rounding; the last sample is in its last 1/60 s."""
    for family in catalogue().values():
        if (ENGINES[0], family.name) in NOT_EXPRESSED or not is_recorded(family.name, ENGINES[0]):
            continue
        case = family.cases[0]
        scenario = case.scenarios[0]
        poses = replay(Job(family.name, ENGINES[0], "tuned"), case.name)
        starts = [scenario.body(name).position for name in poses.bodies]
        np.testing.assert_allclose(poses.positions[0], starts, atol=LENGTH, rtol=0)
        assert 0 <= scenario.duration - poses.times[-1] < 1 / 60 + 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("job", [job for job in JOBS if job.profile == "tuned"], ids=str)
def test_a_live_engine_repeats_the_recorded_numbers(job):
    now = live.result(job.family, job.engine, job.profile)
    if not is_recorded(job.family, job.engine):
        return
    then = recalled(job)
    for row, kept in zip(now.rows, then.rows, strict=True):
        same(row, kept)
    assert then.series is not None or Verdict.CANNOT_EXPRESS in {row.verdict for row in then.rows}
    if job.family in STUDIED:
        same_studies(now, then)


STUDIED = ("rolling-ball", "struck-rod")
"""Of these the error against timestep is compared as well, with the shares of each setting in it."""


def same_studies(now: JobResult, then: JobResult) -> None:
    assert now.convergence.timesteps == then.convergence.timesteps
    near = 1e-6 * max(then.convergence.errors)  # as above, rounding that adds up
    assert now.convergence.errors == pytest.approx(then.convergence.errors, abs=near)
    assert [(share.kind, share.moved) for share in now.split.shares] == [
        (share.kind, share.moved) for share in then.split.shares
    ]
    found, wanted = ([share.size for share in result.split.shares] for result in (now, then))
    assert found == pytest.approx(wanted, abs=near)


@pytest.mark.slow
@pytest.mark.parametrize("engine", ENGINES)
def test_a_live_engine_repeats_the_recorded_published_cases(engine):
    for job in plan((), (engine,)):
        now, kept = live.published(job), recorded.recall(job)
        assert [row.verdict for row in now.rows] == [row.verdict for row in kept.rows], job.case
        for row, then in zip(now.rows, kept.rows, strict=True):
            # As above, rounding that adds up: 1e-6 of a number, or a hundredth of what is judged by.
            if then.measured is not None:
                found, wanted = ((each.measured, each.tolerance, each.shift) for each in (row, then))
                near = pytest.approx(wanted, rel=1e-6, abs=0.01 * then.tolerance)
                assert found == near, (job.case, row.figure, row.place)


def points(engine: str, count: int) -> list[Job]:
    """Points of the grids of an engine, and cases at their timesteps, drawn by lot, the same in every run."""
    drawn = random.Random(engine)
    jobs = [job for name in STRAIGHT for job in jobs_of(catalogue()[name], engine) if job.grid or job.changes]
    return [_point(job, drawn) for job in drawn.choices(jobs, k=count)]


def _point(job: Job, drawn: random.Random) -> Job:
    """One point of a grid, or one case, of a job that runs all of them."""
    if not job.grid:
        return replace(job, cases=(drawn.choice(job.cases),), with_curve=True)
    parameters = catalogue()[job.family].grid.parameters
    return replace(job, grid=False, at=tuple((each.name, drawn.choice(each.values)) for each in parameters))


@pytest.mark.parametrize(
    "count", [pytest.param(5, marks=pytest.mark.slow), pytest.param(POINTS, marks=pytest.mark.weekly)]
)
@pytest.mark.parametrize("engine", ENGINES)
def test_a_live_engine_repeats_recorded_points_of_the_grids(engine, count, installed):
    installed(engine)
    for job in points(engine, count):
        ran, kept = run_job(job), recall(job)
        for row, recorded_row in zip(ran.rows, kept.rows, strict=True):
            same(row, recorded_row)
        if ran.series is not None:
            same_curve(ran.series, kept.series)
        for track in ran.poses:
            now, then = unpack(track, ""), replay(job, ran.rows[0].case)
            # Both are rounded to whole steps: where the two runs differ by a rounding error, by one step at most.
            np.testing.assert_allclose(now.positions, then.positions, atol=1.01 * LENGTH, rtol=0, err_msg=str(job))
            np.testing.assert_allclose(now.orientations, then.orientations, atol=2.5 * TURN, rtol=0, err_msg=str(job))
