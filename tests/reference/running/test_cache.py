"""The cache: what ran with the very same code, engine and settings is found again, and nothing else is."""

from __future__ import annotations

import dataclasses
import os
import pickle
import shutil
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Row, Verdict
from reference.recording import files as recordings
from reference.running import cache, sources
from reference.running.cache import Cache, key_of, key_of_recorded
from reference.running.jobs import recall, run_all, run_one
from reference.running.shelf import default_folder
from reference.running.study import SCENARIOS, run_job

JOB = Job("sliding-slab", "handwritten", "exact", ("μ=0.7,v=1",))
OF_SLABS = {"sliding-slab.json"}
OWN_CODE = """
import numpy as np
from solutions import *
from solutions.detection import time_of_impact_exact as exact
"""


@pytest.fixture(scope="module")
def result() -> JobResult:
    return run_job(JOB)


@pytest.fixture
def kept(result) -> Cache:
    found = Cache()
    found.put(JOB, key_of(JOB), result)
    return found


def files(folder: Path) -> list[Path]:
    return sorted(folder.iterdir()) if folder.exists() else []


def a_row(verdict: Verdict) -> Row:
    return Row("sliding-slab", "μ=0.7,v=1", "handwritten", "exact", "creep", "m", verdict)


# What is found again


def test_a_cached_result_is_unchanged_and_says_that_it_was_cached(kept, result):
    found = kept.get(JOB)
    assert found == result
    assert [row.settings for row in found.rows] == [row.settings for row in result.rows]  # which equality leaves out
    assert (found.seconds, found.cached, result.cached) == (result.seconds, True, False)


def test_the_cache_folder_is_that_of_the_variable_or_of_the_user(cache_folder, monkeypatch):
    assert default_folder() == cache_folder
    monkeypatch.delenv("COLLISIONS_CACHE")
    assert default_folder().name == "collisions-lab"
    assert default_folder().is_absolute()


def test_an_empty_or_missing_cache_has_no_result(cache_folder):
    assert Cache().get(JOB) is None
    assert Cache(cache_folder / "nowhere").get(JOB) is None


@pytest.mark.parametrize(
    "change",
    [
        {"family": "dropped-ball"},
        {"engine": "mujoco"},
        {"profile": "step"},
        {"cases": ()},
        {"changes": (("timestep", 2e-3),)},
        {"with_studies": True},
        {"at": (("friction", 0.5),)},
        {"grid": True},
        {"with_poses": True},
    ],
    ids=lambda change: next(iter(change)),
)
def test_a_different_job_has_a_different_key(change, kept, installed):
    installed(change.get("engine", "handwritten"))
    assert kept.get(dataclasses.replace(JOB, **change)) is None


def test_a_note_on_a_moved_job_does_not_change_its_key(kept):
    moved = dataclasses.replace(JOB, snapped="restitution 0.49 → 0.5")
    assert kept.get(moved).job == moved


@pytest.mark.parametrize("name", ["SCHEMA", "sources.digest", "platform.platform", "platform.python_version", "numpy"])
def test_other_code_versions_or_machines_have_different_keys(name, kept, monkeypatch):
    if name == "numpy":
        monkeypatch.setattr(np, "__version__", "0")
    elif name == "SCHEMA":
        monkeypatch.setattr(cache, "SCHEMA", "another\n")
    else:
        module, function = name.split(".")
        monkeypatch.setattr(getattr(cache, module), function, lambda *_: "another")
    assert kept.get(JOB) is None


def test_another_version_of_an_engine_has_a_different_key(installed, monkeypatch):
    engine = installed("mujoco")
    job = dataclasses.replace(JOB, engine="mujoco")
    before = key_of(job)
    monkeypatch.setattr(type(engine), "version", lambda self: "0.0")
    assert key_of(job) != before


def test_a_students_code_changes_the_keys_of_hand_written_jobs_alone(tmp_path, installed):
    installed("pybullet")
    paths = [tmp_path / name for name in ("mine.py", "other.py")]
    for number, path in enumerate(paths):
        path.write_text(f"{OWN_CODE}\nNUMBER = {number}\n", encoding="utf-8")
    for engine, keys in (("handwritten", 2), ("pybullet", 1)):
        jobs = [dataclasses.replace(JOB, engine=engine, implementation=str(path)) for path in paths]
        assert len({key_of(job) for job in jobs}) == keys


def test_a_students_rule_that_steers_changes_the_keys_of_every_engine(tmp_path, installed):
    installed("mujoco")
    paths = [tmp_path / name for name in ("mine.py", "other.py")]
    for number, path in enumerate(paths):
        path.write_text(f"{OWN_CODE}\nNUMBER = {number}\n", encoding="utf-8")
    found = set()
    for source in ("solutions", *map(str, paths)):
        job = Job("antipodal-circle", "mujoco", "tuned", ("τ=1",), source)
        found |= {key_of(job), key_of_recorded(job)}
        assert key_of(job) == key_of(job, once=True)
    assert len(found) == 6
    assert cache._identity(job).implementation == source  # so a kept result is only found for the same code


def test_a_shared_result_of_an_engine_names_the_job_that_asked(result, installed):
    installed("pybullet")
    first, second = (
        dataclasses.replace(JOB, engine="pybullet", implementation=name) for name in ("solutions", "mine.py")
    )
    keeps = Cache()
    keeps.put(first, key_of(first), dataclasses.replace(result, job=first))
    assert keeps.get(second).job == second


def test_a_changed_line_of_a_students_code_changes_the_key(tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(OWN_CODE, encoding="utf-8")
    job = dataclasses.replace(JOB, implementation=str(path))
    before = key_of(job)
    assert key_of(job) == before
    path.write_text(OWN_CODE + "# a change\n", encoding="utf-8")
    assert key_of(job) != before
    assert key_of(job, once=True) == key_of(job)


def test_a_changed_engine_file_changes_the_key(tmp_path):
    path = tmp_path / "my_engine.py"
    toy = (Path(__file__).parents[1] / "toy_engine.py").read_text(encoding="utf-8")
    path.write_text(toy, encoding="utf-8")
    job = dataclasses.replace(JOB, engine=str(path))
    before = key_of(job)
    path.write_text(toy + "# a change\n", encoding="utf-8")
    assert before is not None
    assert key_of(job) != before


def test_an_engine_that_cannot_be_loaded_has_no_key(tmp_path, result):
    job = dataclasses.replace(JOB, engine=str(tmp_path / "none_such.py"))
    assert key_of(job) is None
    assert Cache().get(job) is None
    Cache().put(job, None, result)
    assert files(default_folder()) == []


# What is kept


@pytest.mark.parametrize("verdict", [Verdict.CRASHED, Verdict.NOT_AVAILABLE])
def test_a_job_without_an_answer_is_not_cached(verdict, result, cache_folder):
    Cache().put(JOB, key_of(JOB), dataclasses.replace(result, rows=(*result.rows, a_row(verdict))))
    assert files(cache_folder) == []


@pytest.mark.parametrize("verdict", [Verdict.FAIL, Verdict.NEEDS, Verdict.CANNOT_EXPRESS])
def test_a_bad_answer_is_cached_too(verdict, result):
    answer = dataclasses.replace(result, rows=(*result.rows, a_row(verdict)))
    Cache().put(JOB, key_of(JOB), answer)
    assert Cache().get(JOB) == answer


def test_a_result_whose_code_changed_while_it_ran_is_not_kept(result, cache_folder):
    Cache().put(JOB, "of another text", result)
    assert files(cache_folder) == []


def test_a_fresh_cache_reads_nothing_and_writes_new_results(kept, result):
    anew = Cache(fresh=True)
    assert anew.get(JOB) is None
    anew.put(JOB, key_of(JOB), dataclasses.replace(result, seconds=123.0))
    assert kept.get(JOB).seconds == 123.0


def test_a_full_cache_drops_the_result_used_longest_ago(result, cache_folder):
    jobs = [dataclasses.replace(JOB, changes=(("timestep", dt),)) for dt in (1e-3, 2e-3, 3e-3)]
    size = len(cache._packed(result))
    keeps = Cache(most_bytes=int(2.5 * size))
    long_ago = time.time() - 1000
    for age, job in enumerate(jobs[:2]):
        keeps.put(job, key_of(job), dataclasses.replace(result, job=job))
        os.utime(cache_folder / f"{key_of(job)}.result", (long_ago + age, long_ago + age))
    assert keeps.get(jobs[0]) is not None  # used just now, so the other is the oldest
    keeps.put(jobs[2], key_of(jobs[2]), dataclasses.replace(result, job=jobs[2]))
    assert [keeps.get(job) is not None for job in jobs] == [True, False, True]
    assert sum(path.stat().st_size for path in files(cache_folder)) <= keeps.most_bytes


def test_remains_of_an_interrupted_write_are_removed_once_old(kept, result, cache_folder):
    old, new = (cache_folder / f"{name}.unfinished" for name in ("old", "new"))
    for path in (old, new):
        path.write_bytes(b"half a resu")
    os.utime(old, (time.time() - 7200,) * 2)
    kept.put(JOB, key_of(JOB), result)
    assert (old.exists(), new.exists()) == (False, True)


def test_other_files_in_the_cache_folder_are_not_touched(result, cache_folder):
    cache_folder.mkdir()
    stranger = cache_folder / "thesis.tex"
    stranger.write_text("precious", encoding="utf-8")
    os.utime(stranger, (0, 0))
    Cache(most_bytes=1).put(JOB, key_of(JOB), result)
    assert stranger.read_text(encoding="utf-8") == "precious"


def test_what_a_recording_gave_is_found_until_the_recording_changes(tmp_path, monkeypatch):
    shutil.copytree(recordings.FOLDER / "mujoco", tmp_path / "mujoco", ignore=lambda _, names: set(names) - OF_SLABS)
    monkeypatch.setattr(recordings, "FOLDER", tmp_path)
    job, keeps = dataclasses.replace(JOB, engine="mujoco"), Cache()
    found = dataclasses.replace(run_job(JOB), job=job, recording="* MuJoCo was recorded")
    keeps.put(job, key_of_recorded(job), found)
    assert keeps.get_recorded(job) == found
    assert keeps.get(job) is None, "a recorded number is never taken for one that was measured here"
    with (tmp_path / "mujoco" / "sliding-slab.json").open("a") as file:
        file.write(" ")
    assert keeps.get_recorded(job) is None


# What goes wrong on a disk


@pytest.mark.parametrize("damage", ["empty", "short", "turned", "other header", "no result"])
def test_a_damaged_file_is_a_miss_and_is_replaced(damage, kept, result, cache_folder):
    (path,) = files(cache_folder)
    content = path.read_bytes()
    path.write_bytes(
        {
            "empty": b"",
            "short": content[:-10],
            "turned": content[:-10] + bytes([content[-10] ^ 1]) + content[-9:],
            "other header": content.replace(b"result 1", b"result 0", 1),
            "no result": cache._packed(JOB),
        }[damage]
    )
    assert kept.get(JOB) is None
    kept.put(JOB, key_of(JOB), result)
    assert kept.get(JOB) == result


def test_a_result_under_the_key_of_another_job_is_a_miss(kept, cache_folder):
    (path,) = files(cache_folder)
    other = dataclasses.replace(JOB, cases=())
    path.rename(cache_folder / f"{key_of(other)}.result")
    assert kept.get(other) is None


class _Trap:
    def __reduce__(self):
        return os.mkdir, (os.environ["COLLISIONS_CACHE"] + "/sprung",)


@pytest.mark.parametrize("evil", [_Trap(), Path("x"), np.float64(1.0), len])
def test_no_foreign_code_is_run_from_a_file_of_the_cache(evil, kept, cache_folder):
    (path,) = files(cache_folder)
    path.write_bytes(cache._packed(evil))
    assert kept.get(JOB) is None
    assert not (cache_folder / "sprung").exists()
    assert pickle.loads(pickle.dumps(len)) is len  # the files would have done as they say


def test_a_job_runs_though_the_cache_folder_cannot_be_written(tmp_path, result):
    taken = tmp_path / "a file"
    taken.write_text("in the way", encoding="utf-8")
    nowhere = Cache(taken / "cache")
    nowhere.put(JOB, key_of(JOB), result)
    assert nowhere.get(JOB) is None
    assert run_one(JOB, SCENARIOS, cache=nowhere) == result


# Runs with a cache


def test_a_second_run_reads_the_results_of_the_first_from_the_cache():
    jobs = [JOB, dataclasses.replace(JOB, profile="step")]
    keeps = Cache()
    assert recall(jobs, keeps) == []
    with ThreadPoolExecutor(2) as executor:
        first = list(run_all(jobs, SCENARIOS, executor, cache=keeps))
        second = list(run_all(jobs, SCENARIOS, executor, cache=keeps))
    assert [result.cached for result in first + second] == [False, False, True, True]
    by_profile = {result.job.profile: result for result in first}
    assert {result.job.profile: result for result in second} == by_profile
    assert {result.job.profile: result for result in recall(jobs, keeps)} == by_profile


def test_a_worker_reports_the_key_of_the_code_it_has_imported(monkeypatch):
    before = key_of(JOB, once=True)
    monkeypatch.setattr(sources, "_part", lambda name: ("changed since", frozenset()))
    assert key_of(JOB) != before
    assert key_of(JOB, once=True) == before
