"""How every command ends: exit codes, last lines, and streams that cannot be written."""

from __future__ import annotations

import errno
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from made_results import made

from labs.cli import ending, jobs
from labs.cli.console import Stream
from reference.comparison.results import Job
from reference.comparison.verdicts import ALL_CASES, Verdict
from reference.errors import CannotWrite, InvalidInput, RunFailed
from reference.published.results import PublishedJob, PublishedResult, PublishedRow
from reference.running.cache import Cache

FULL = OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), "rows.json")


def ended(error: BaseException, capsys, told=ending.told) -> tuple[int, str]:
    """The exit code and the lines with which an error ends the program."""
    with pytest.raises(SystemExit) as caught, told():
        raise error
    return caught.value.code, " ".join(capsys.readouterr().err.split())


@pytest.mark.parametrize(
    ("error", "code", "line"),
    [
        (InvalidInput("no such [b]moon[/b]"), 2, "Error: no such [b]moon[/b]"),
        (RunFailed("it broke"), 3, "Error: it broke"),
        (CannotWrite("cannot write it"), 3, "Error: cannot write it"),
        (FULL, 3, "Error: the system refuses a file 'rows.json': No space left on device"),
        (OSError("odd"), 3, "Error: the system refuses a file: odd"),
        (KeyboardInterrupt(), 130, "Interrupted."),
        (KeyboardInterrupt("SIGTERM"), 130, "Interrupted by SIGTERM."),
    ],
    ids=repr,
)
def test_an_error_ends_with_its_code_and_one_line(error, code, line, capsys):
    assert ended(error, capsys) == (code, line)


def test_a_fault_of_the_lab_shows_where_and_does_not_end_like_a_failed_verdict(capsys, monkeypatch):
    monkeypatch.setattr(ending.signal, "signal", lambda *_: None)
    code, said = ended(ZeroDivisionError("by the moon"), capsys, ending.told_whatever_happens)
    assert code == 3
    assert "Traceback" in said
    assert said.endswith("A fault of the lab: ZeroDivisionError: by the moon")


@pytest.mark.parametrize("error", [KeyboardInterrupt(), FULL, CannotWrite("full")], ids=repr)
def test_a_command_that_ends_early_says_whether_its_runs_are_kept(error, tmp_path, capsys):
    def last_line(cache: Cache) -> str:
        with pytest.raises(SystemExit), ending.told(), jobs.continuing(cache):
            raise type(error)(*error.args)
        return " ".join(capsys.readouterr().err.split())

    kept = "The runs that have ended are kept. The same command{} makes those that are missing."
    assert last_line(Cache(tmp_path)).endswith(kept.format(""))
    assert last_line(Cache(tmp_path, fresh=True)).endswith(kept.format(" without --fresh"))
    (tmp_path / "file").touch()
    nowhere = Cache(tmp_path / "file" / "below")
    nowhere.keep("a", b"b")
    assert "are not kept, as the cache in " in last_line(nowhere)


# After runs


def result(verdict: Verdict, profile: str = "tuned", note: str = "", case: str = ALL_CASES):
    found = made(Job("ball-to-rest", "mujoco", profile, ("e=0.5",)), 1.0)
    return replace(found, rows=(replace(found.rows[0], verdict=verdict, note=note, case=case, measured=None),))


def published(verdict: Verdict) -> PublishedResult:
    row = PublishedRow("P15", "mujoco", "", 0, verdict, note="SIGKILL")
    return PublishedResult(PublishedJob("P15", "mujoco"), "MuJoCo", (row,))


PASS, FAIL, LOST, CRASHED = Verdict.PASS, Verdict.FAIL, Verdict.LOST, Verdict.CRASHED


@pytest.mark.parametrize(
    ("results", "code"),
    [
        ([result(PASS)], 0),
        ([result(PASS), result(FAIL, "stock")], 0),
        ([result(PASS), result(LOST, "stock"), result(CRASHED, "stock")], 0),
        ([result(PASS), result(LOST)], 3),
        ([result(PASS), result(CRASHED)], 3),
        ([result(PASS), published(LOST)], 3),
        ([result(FAIL), result(LOST), result(CRASHED)], 1),
        ([result(PASS), published(FAIL)], 1),
        ([result(LOST, "stock")], 3),
        ([result(Verdict.NEEDS), result(Verdict.NOT_AVAILABLE, "stock"), published(Verdict.NO_WORDS)], 3),
    ],
)
def test_the_exit_code_is_that_of_the_runs_that_count(results, code):
    assert jobs.exit_code(results) == code


def test_the_last_lines_name_each_lost_run_and_its_reason_once(capsys):
    slow, gone = "it took longer than 300 s and was stopped", "its process was killed from outside (SIGKILL)"
    found = [
        result(LOST, note=slow),
        result(PASS),
        result(LOST, "stock", slow, "e=0.8"),
        published(LOST),
        result(CRASHED, note="SIGSEGV"),
        result(LOST, note=gone),
    ]
    assert jobs.end(found) == 3
    said = capsys.readouterr().out.replace("\n", " ")
    assert f"lost: ball-to-rest, MuJoCo, tuned; ball-to-rest, MuJoCo, stock (e=0.8): {slow}" in said
    assert "lost: P15, MuJoCo: SIGKILL" in said
    assert "crashed: ball-to-rest, MuJoCo, tuned: SIGSEGV" in said
    assert f"lost: ball-to-rest, MuJoCo, tuned: {gone}" in said
    assert said.count("Give each run more time with --seconds") == 1
    jobs.end([result(CRASHED, note="SIGSEGV"), result(PASS)])
    assert "lost" not in capsys.readouterr().out


# Streams


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="where the system has a device that is always full")
def test_an_output_that_is_full_is_said_once_and_errors_never():
    with open("/dev/full", "w") as file:
        stream = Stream(file, "the output")
        with pytest.raises(CannotWrite, match="cannot write the output: No space left"):
            stream.write("a" * 100_000)
        stream.flush()
    with open("/dev/full", "w") as file:
        for _ in range(2):
            Stream(file).write("a" * 100_000)
            Stream(file).flush()


@pytest.mark.skipif(not hasattr(os, "fork"), reason="where a shell can close a stream")
def test_a_stream_that_the_caller_has_closed_takes_what_is_written():
    for closed in (">&-", "2>&-", ">&- 2>&-"):
        ended = subprocess.run(["sh", "-c", f'"$0" -m labs --version {closed}', sys.executable], capture_output=True)
        assert (ended.returncode, ended.stderr) == (0, b""), closed


def test_a_reader_that_wants_no_more_is_no_error():
    reading, writing = os.pipe()
    os.close(reading)
    with open(writing, "w") as file:
        stream = Stream(file, "the output")
        for _ in range(2):
            assert stream.write("a" * 100_000) == 100_000
            stream.flush()
