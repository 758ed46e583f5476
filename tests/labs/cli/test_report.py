"""`collisions report`: what it writes, where, what it refuses, and what it ends with."""

from __future__ import annotations

import errno
import json
import os
import shutil
from pathlib import Path
from typing import NamedTuple

import pytest
from program import QUICK, SLIDE, Said, collisions, files_in

from labs.cli import jobs
from reference.comparison.results import JobResult
from reference.report.row_files import read_rows

WRONG = """
right = sliding_motion

def sliding_motion(position, velocity, *rest):
    return right(position, 0.9 * velocity, *rest)
"""


class Written(NamedTuple):
    """A report. said: what the program printed. cache: where its runs are kept."""

    folder: Path
    said: Said
    cache: Path


def report(out: Path, *more: str) -> Said:
    return collisions("report", "--only", SLIDE, "--engine", "handwritten", "--jobs", "1", "--out", out, *more)


@pytest.fixture(scope="module")
def written(tmp_path_factory) -> Written:
    """A report that several tests look at."""
    folder, cache = tmp_path_factory.mktemp("written") / "new [draft]" / "report", tmp_path_factory.mktemp("kept")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("COLLISIONS_CACHE", str(cache))
        return Written(folder, report(folder), cache)


def test_a_report_is_written_to_its_folder_and_names_the_page(written):
    said, out = written.said, written.folder
    assert said.code == 0
    near = "Of 4 checks that count, 3 came out as predicted and near theory, 1 as predicted and away from theory"
    assert f"{near} and none failed. Besides, 4 checks would pass even if no body moved." in said.text
    assert f"Open {out / 'index.html'} in a browser." in said.output
    names = {"index.html", "rows.json", "rows.csv", "pairs.csv", "timings.json", "provenance.json", "figures"}
    assert set(os.listdir(out)) == names
    assert len(read_rows(out / "rows.json")) == 3 * 4
    studied = {it["profile"] for it in json.loads((out / "rows.json").read_text(encoding="utf-8"))["convergence"]}
    assert studied == {"exact", "step"}, "a report always shows error against timestep"


def test_a_report_from_the_cache_is_the_same_report(written, tmp_path, monkeypatch):
    monkeypatch.setenv("COLLISIONS_CACHE", str(written.cache))
    said = report(tmp_path)
    assert said.code == 0
    first, second = files_in(written.folder), files_in(tmp_path)
    assert first.keys() == second.keys()
    for name in first.keys() - {"timings.json", "provenance.json"}:
        assert second[name] == first[name], name
    assert "first page" not in said.error, "nothing is running"
    cached = [[it["cached"] for it in json.loads(files["timings.json"])["seconds"]] for files in (first, second)]
    assert [set(found) for found in cached] == [{False}, {True}]


@pytest.mark.slow
def test_a_report_replaces_an_earlier_one_unless_it_is_refused(tmp_path, homework):
    out = tmp_path / "out"
    out.mkdir()
    for name in ("index.html", "notes.txt"):
        (out / name).write_text("earlier")
    before = files_in(out)
    assert report(out, "--implementation", "nobody").code == 2
    assert files_in(out) == before
    assert report(out, "--implementation", homework(WRONG)).code == 1
    after = files_in(out)
    assert after["notes.txt"] == b"earlier"
    assert b" and 2 failed." in after["index.html"]


def test_a_report_with_a_crashed_engine_is_finished_and_ends_with_3(written, tmp_path, odd, monkeypatch):
    monkeypatch.setenv("COLLISIONS_CACHE", str(written.cache))
    said = report(tmp_path / "out", "--engine", odd("raise RuntimeError('<script>x</script>')"))
    assert said.code == 3
    page = (tmp_path / "out" / "index.html").read_text(encoding="utf-8")
    assert "crashed: RuntimeError: &lt;script&gt;x&lt;/script&gt;" in page


# The first page


def test_a_first_page_from_recordings_is_there_until_the_runs_are_through(written, tmp_path, monkeypatch, one_worker):
    out = tmp_path / "out"
    shutil.copytree(written.folder, out)
    earlier, at_the_start = files_in(out), {}
    run = jobs.run_work

    def run_later(*arguments) -> list[JobResult]:
        at_the_start.update(files_in(out))
        return run(*arguments) if "finish" in os.environ else interrupted()

    def interrupted() -> list[JobResult]:
        raise KeyboardInterrupt

    monkeypatch.setattr(jobs, "run_work", run_later)
    said = report(out, "--engine", "mujoco")
    assert said.code == 130
    assert "first page, written from recordings at" in said.error
    assert (
        f"The report is not finished. {out / 'index.html'} is still the first page, written from recordings"
        in said.error
    )
    assert files_in(out) == at_the_start, "it is left as it was written"
    page = at_the_start["index.html"].decode()
    rows = json.loads(at_the_start["rows.json"])
    assert rows["unfinished"] in page
    assert rows["unfinished"].startswith("This is a first page, written from recordings at")
    assert "running: the numbers come with the finished page" in page
    marks = {(row.engine, str(row.verdict) == "running", bool(row.recorded_on)) for row in read_rows(out / "rows.json")}
    assert marks == {("handwritten", True, False), ("mujoco", False, True)}
    assert b",running," in at_the_start["rows.csv"]
    assert "none failed" in page
    monkeypatch.setenv("finish", "yes")
    monkeypatch.setenv("COLLISIONS_CACHE", str(written.cache))
    assert report(out).code == 0
    finished = files_in(out)
    timeless = earlier.keys() - {"timings.json", "provenance.json"}
    assert {name: finished[name] for name in timeless} == {name: earlier[name] for name in timeless}


def test_a_report_on_a_full_disk_ends_with_3_and_the_next_one_continues(written, tmp_path, monkeypatch):
    out = tmp_path / "out"
    shutil.copytree(written.folder, out)
    earlier = files_in(out)
    monkeypatch.setenv("COLLISIONS_CACHE", str(written.cache))

    def full(path: Path, text: str) -> None:
        if path.name == "rows.csv":
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))  # as `write` raises it: it knows no name
        path.write_text(text, encoding="utf-8")

    with monkeypatch.context() as patched:
        patched.setattr("reference.report.files._write", full)
        said = report(out)
    assert said.code == 3
    assert f"Error: cannot write the report to {str(out)!r}: No space left on device" in said.error
    assert "The runs that have ended are kept. The same command makes those that are missing." in said.error
    assert (files_in(out), [name for name in os.listdir(out) if name.startswith(".")]) == (earlier, [])
    again = report(out)
    assert (again.code, "3 of them from the cache" in again.error) == (0, True)


# What is refused


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--only", "balltorest"], "unknown scenario 'balltorest'. Did you mean 'ball-to-rest'?"),
        (["--engine", "mojoco"], "unknown engine 'mojoco'. Did you mean 'mujoco'?"),
        (["--only", QUICK[0], "--engine", "handwritten", "--implementation", "nobody"], "no implementation 'nobody'"),
        (["--jobs", "0"], "Invalid value for '--jobs' / '-j'"),
    ],
    ids=lambda value: value[-1] if isinstance(value, list) else "",
)
def test_a_refused_report_leaves_no_folder(arguments, said, tmp_path):
    refused = collisions("report", "--out", tmp_path / "new" / "report", *arguments)
    assert (refused.code, said in refused.error) == (2, True)
    assert os.listdir(tmp_path) == []


def test_a_report_that_cannot_be_written_is_refused_before_any_run(tmp_path):
    occupied = tmp_path / "occupied"
    occupied.write_text("mine")
    for out in (occupied, occupied / "below", tmp_path / ("long" * 100)):
        refused = collisions("report", "--only", QUICK[0], "--engine", "handwritten", "--out", out)
        assert refused.code == 2
        assert "cannot write the report to" in refused.error
        assert "choose another --out" in refused.error
        assert "run" not in refused.error.partition("Error:")[0]
    assert occupied.read_text() == "mine"
    assert os.listdir(tmp_path) == ["occupied"]
