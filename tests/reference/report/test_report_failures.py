"""A report of runs that die, hang or give nothing: each is one row, and the report is finished."""

from __future__ import annotations

import os
import re
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import pytest
from odd_engines import ENOUGH, engine_file

from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import ALL_CASES, Row, Verdict
from reference.report.files import write
from reference.report.row_files import read_rows, rows_json
from reference.running.jobs import run_all, run_one
from reference.running.study import SCENARIOS, run_job

pytestmark = pytest.mark.slow

GOOD = Job("ball-to-rest", "handwritten", "exact", ("e=0.5",))
"""Of the same family as the odd ones, so that its line is the first of their section."""
MESSAGE = "<script>alert('moon')</script> & co"


def odd_job(folder: Path, title: str, body: str = "pass", package: str | None = None) -> Job:
    """A job of an engine in a file of its own; `body` is what its run does after its first sample."""
    path = engine_file(folder, title.replace(" ", "_"), f"recorder.sample(state)\n{body}", package, title)
    return Job("ball-to-rest", path, "tuned", ("e=0.5",))


@pytest.fixture(scope="module")
def results() -> list[JobResult]:
    return [run_job(GOOD), run_job(replace(GOOD, profile="step"))]


@pytest.fixture(scope="module")
def with_odd_ones(results, tmp_path_factory) -> tuple[Path, list[JobResult]]:
    """A report of good results beside engines that crash, raise, hang, give NaN or are not installed."""
    folder, out = tmp_path_factory.mktemp("engines"), tmp_path_factory.mktemp("report")
    jobs = [
        odd_job(folder, "crashing", "os._exit(3)"),
        odd_job(folder, "raising", f"raise RuntimeError({MESSAGE!r})"),
        odd_job(folder, "not a number", "recorder.sample([float('nan')] * len(state))"),
        odd_job(folder, "missing", package="no_such_package"),
    ]
    with ThreadPoolExecutor(2) as executor:
        found = list(run_all(jobs, SCENARIOS, executor, ENOUGH))
    # 1 s: whatever the limit, it hangs for longer; what it is here only makes the test quick.
    found.append(run_one(odd_job(folder, "hanging", "time.sleep(600)"), SCENARIOS, 1.0))
    write([*found, *results], out)
    return out, found


SAID = {
    "crashing": (Verdict.CRASHED, "its process died (exit code 3)"),
    "raising": (Verdict.CRASHED, f"RuntimeError: {MESSAGE}"),
    "not a number": (Verdict.CRASHED, "are not finite from t = 0.01 s on"),
    "missing": (Verdict.NOT_AVAILABLE, "pip install no_such_package"),
    "hanging": (Verdict.LOST, "it took longer than 1 s"),
}


@pytest.mark.parametrize("title", SAID)
def test_a_run_without_an_answer_is_one_row_of_a_finished_report(title, with_odd_ones, results):
    out, found = with_odd_ones
    (result,) = (result for result in found if result.title == title)
    verdict, message = SAID[title]
    (row,) = result.rows
    assert (row.verdict, row.case in (ALL_CASES, "e=0.5")) == (verdict, True)
    assert message in row.note
    rows = read_rows(out / "rows.json")
    assert row in rows
    assert len(rows) == len(found) + sum(len(result.rows) for result in results)


@pytest.mark.parametrize("title", SAID)
def test_the_page_shows_why_a_run_gave_no_answer_as_plain_text(title, with_odd_ones):
    page = (with_odd_ones[0] / "index.html").read_text(encoding="utf-8")
    verdict, message = SAID[title]
    escaped = message.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace("'", "&#39;")
    assert f"{title}, tuned" in page
    assert re.search(rf"{verdict}: [^<]*{re.escape(escaped)}", page)
    assert "<script>alert" not in page


def test_the_page_lists_as_compared_only_engines_that_ran(with_odd_ones):
    page = (with_odd_ones[0] / "index.html").read_text(encoding="utf-8")
    (opening,) = re.findall(r"The same scenarios in (.*?)\. By hand", page)
    assert opening.startswith("hand-written code")
    assert not [title for title in ("crashing", "missing", "hanging") if title in opening]


def test_a_report_of_crashes_alone_is_written(with_odd_ones, tmp_path):
    _, found = with_odd_ones
    write(found, tmp_path)
    assert len(read_rows(tmp_path / "rows.json")) == len(found)
    assert os.listdir(tmp_path / "figures") == []
    page = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert "Of 4 checks" in page
    assert "Besides, 1 run was lost and not judged." in page
    assert "lost: ball-to-rest, hanging, tuned: it took longer than 1 s and was stopped" in page


def test_nan_is_never_written_into_the_rows():
    bad = Row("f", "c", "e", "tuned", "q", "m", Verdict.PASS)
    object.__setattr__(bad, "measured", float("nan"))  # which a row refuses when it is made
    with pytest.raises(ValueError, match="not JSON compliant"):
        rows_json([JobResult(GOOD, "", "", (bad,))])
