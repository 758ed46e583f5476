"""The code of a submission is compiled once, before any of it is run, and each process runs the same."""

from __future__ import annotations

import contextlib

import numpy as np
import pytest
from stand_ins import LOADED, PATIENT, SEALED, Scripted

from labs.grading.budget import Budget
from labs.grading.calling.calls import Call
from labs.grading.calling.compiling import Beginning
from labs.grading.calling.patience import Patience
from labs.grading.calling.remote import Grader, Remote
from labs.grading.errors import FunctionRaised, NoAnswer
from labs.grading.submission.reading import Submission
from labs.grading.worker import messages
from labs.grading.worker.tier import Tier

CODE = np.arange(4, dtype=np.uint8)


def begun(beginning, *said):
    process = Scripted(SEALED, *said)
    call = Call(Submission("lab.py", ""), PATIENT, Patience(Budget(10.0)), contextlib.nullcontext, beginning)
    return call.begin(process, Tier.NETWORK), messages.unpack(process.sent[0][messages.HEADER :])


@pytest.fixture(scope="module")
def grader():
    with Grader() as found:
        yield found


def twice(text, grader):
    """What f answers in two processes, and what it prints there."""
    with Remote(Submission("lab.py", text), grader) as remote:
        found = []
        for _ in range(2):
            with remote.fresh() as call:
                found.append((call("f"), call.printed))
        return found


def test_one_process_is_asked_for_the_code_and_the_others_get_it():
    beginning = Beginning("x = 1\n", 50, code=True)
    for given in (True, CODE):
        lost, (text, printed, code) = begun(beginning, *[("compiled", CODE)] * (given is True), LOADED)
        assert (lost, text.tobytes(), printed, code is True) == (None, b"x = 1\n", 50, given is True)
    assert code.tolist() == CODE.tolist()


@pytest.mark.parametrize("forged", [("compiled", CODE), ("compiled", [], CODE)])
def test_code_that_nobody_asked_for_is_not_kept(forged):
    beginning = Beginning("", 50)
    lost, _ = begun(beginning, forged)
    assert isinstance(lost, NoAnswer)
    assert beginning.code is None


@pytest.mark.parametrize("sent", [None, 1.0, "code", [CODE]])
def test_where_there_is_no_code_each_process_compiles_the_text(sent):
    beginning = Beginning("", 50, code=True)
    assert begun(beginning, ("compiled", sent), LOADED)[0] is None
    assert (beginning.code, beginning.asks) == (None, False)


def test_a_function_is_the_same_in_the_process_that_compiled_it_and_in_the_next(grader):
    assert twice("def f(x=-0.0, y=10**40, z='½'):\n    return x, y, z\n", grader) == [((-0.0, 10**40, "½"), "")] * 2


def test_what_python_warns_of_is_printed_in_every_process(grader):
    (_, first), (_, second) = twice("def f():\n    return 1 is 1\n", grader)
    assert first == second
    assert "SyntaxWarning" in first


def test_a_statement_that_fails_costs_its_own_names_in_every_process(grader):
    text = "import os\nr = 1 / (os.getpid() * 0)\ndef f():\n    return 2\ndef g():\n    return r\n"
    assert twice(text, grader) == [(2, "")] * 2
    with Remote(Submission("lab.py", text), grader) as remote:
        for _ in range(2):
            with remote.fresh() as call, pytest.raises(FunctionRaised, match=r"line 6.*On loading: ZeroDiv.*line 2"):
                call("g")


def test_nothing_that_a_submission_does_to_marshal_reaches_its_next_process(grader):
    text = "import marshal\nn = [0]\nmarshal.loads = marshal.dumps = None\ndef f():\n    n[0] += 1\n    return n[0]\n"
    assert twice(text, grader) == [(1, "")] * 2
