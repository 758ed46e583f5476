"""Jobs of hand-written code that is unfinished, complete or wrong."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from odd_engines import ENOUGH, GOOD, results_of

from reference.comparison.results import Job
from reference.comparison.verdicts import Verdict
from reference.errors import InvalidInput
from reference.running.jobs import run_one
from reference.running.study import SCENARIOS, run_job

EVERYTHING = "".join(f"from solutions.{topic} import *\n" for topic in ("detection", "response", "forces", "friction"))


@pytest.mark.parametrize(
    "missing", ["del respond_at_impact\n", "def respond_at_impact(*arguments):\n    raise NotImplementedError\n"]
)
def test_an_unwritten_function_is_named_in_one_row_and_others_finish(missing, tmp_path):
    path = tmp_path / "homework.py"
    path.write_text(EVERYTHING + missing)
    unfinished = Job("dropped-ball", "handwritten", "exact", ("e=0.5",), str(path))
    not_needed = replace(GOOD, implementation=str(path))
    results = results_of([unfinished, not_needed, GOOD])
    (row,) = results[unfinished].rows
    assert (row.verdict, row.note) == (Verdict.NEEDS, "needs respond_at_impact (response, step 4)")
    for job in (not_needed, GOOD):
        assert {row.verdict for row in results[job].rows} == {Verdict.PASS}


def test_a_complete_file_of_functions_gives_the_rows_of_the_solutions(tmp_path):
    path = tmp_path / "homework.py"
    path.write_text(EVERYTHING)
    assert run_one(replace(GOOD, implementation=str(path)), SCENARIOS, ENOUGH).rows == run_job(GOOD).rows


def test_hand_written_bugs_crash_and_wrong_signs_fail(tmp_path):
    broken, wrong = tmp_path / "broken.py", tmp_path / "wrong.py"
    broken.write_text(EVERYTHING + "def respond_at_impact(p, *others):\n    return p[1000000], p\n")
    perfect = "right = respond_at_impact\ndef respond_at_impact(p, v, a, n, e, *times):\n"
    wrong.write_text(EVERYTHING + perfect + "    return right(p, v, a, n, 1.0 + 0.0 * e, *times)\n")
    jobs = [Job("dropped-ball", "handwritten", "exact", ("e=0.5",), str(path)) for path in (broken, wrong)]
    results = results_of(jobs)
    (row,) = results[jobs[0]].rows
    assert row.verdict is Verdict.CRASHED
    assert "IndexError" in row.note
    rebound = next(row for row in results[jobs[1]].rows if row.quantity == "rebound")
    assert rebound.verdict is Verdict.FAIL
    assert rebound.measured == pytest.approx(1.0, abs=1e-9)  # the slide's formula is the case e = 1
    assert np.isfinite(rebound.error)


def test_a_missing_implementation_is_the_callers_mistake():
    with pytest.raises(InvalidInput, match="no such file"):
        run_one(replace(GOOD, implementation="no/such/homework.py"), SCENARIOS, ENOUGH)
