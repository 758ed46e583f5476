"""What a submission cannot make the grader do: work without end, pay what is wrong, follow links, leave traces."""

from __future__ import annotations

import contextlib
import time
from pathlib import Path

import numpy as np
import pytest

from labs.grading.budget import Budget
from labs.grading.calling import scenario_runs
from labs.grading.calling.calls import Call
from labs.grading.calling.load_failures import Failures
from labs.grading.calling.patience import Patience
from labs.grading.calling.processes import Ended, Limits
from labs.grading.calling.remote import Remote
from labs.grading.diagnosis.deviations import AGAINST_INFINITY, Answer, Right, deviation_of, outputs
from labs.grading.errors import FunctionRaised, UnreadableSubmission
from labs.grading.judging.grade import grade
from labs.grading.judging.plugin import _seed
from labs.grading.submission.reading import Submission, read
from labs.grading.worker import messages
from labs.grading.worker.tier import Tier
from reference.errors import RunFailed

LONG = 2.0  # s: what follows takes milliseconds, and took from half a minute to hours


def within(seconds: float) -> contextlib.AbstractContextManager[None]:
    """Fail where the block takes longer."""

    @contextlib.contextmanager
    def timed():
        began = time.process_time()
        yield
        assert time.process_time() - began < seconds

    return timed()


class Said:
    """In place of a test's process: says what it is told to, and notes what was sent to it."""

    number, ended, gone, spent, most = 0, Ended(0), False, 0.0, max(Tier)

    def __init__(self, *said: object) -> None:
        self._said = [messages.pack(each)[messages.HEADER :] for each in (("sealed", 3, [], [], 0, 0.0), *said)]

    def start(self, limits: Limits) -> Said:
        return self

    def measure(self, process: int, before: float) -> None:
        pass

    def send(self, message: bytes, seconds: float, until: float = 0.0) -> None:
        pass

    def exchange(self, message: bytes, seconds: float, until: float = 0.0) -> bytes:
        return self._said.pop(0)

    def end(self, process: object = None) -> None:
        pass


def begun(process: Said, patience: float = 10.0) -> Call:
    call = Call(Submission("lab.py", ""), Limits(), Patience(Budget(patience)), contextlib.nullcontext)
    assert call.begin(process, Tier.NETWORK) is None
    return call


@pytest.mark.parametrize("rows", [np.zeros((2**40, 0)), np.zeros(6_000_000, np.int8), [0] * 150_000])
def test_a_huge_answer_is_refused_before_it_is_unpacked(rows):
    with within(LONG):
        assert outputs(rows, 2) is None


def test_numbers_with_one_hash_take_no_time():
    places = [place * (2**61 - 1) for place in range(60_000)]
    call = begun(Said(("loaded", ["f"], [], []), ("answer", 1, "value", 0.0, [*places, 0], 5.0, "")))
    with within(LONG):
        assert call("f", 1.0, 2.0) == 5.0
    assert call.changed == (0,)  # the first is 0 times the prime


def test_thousands_of_failed_statements_take_no_time_at_an_error():
    failed = [([f"a{number}"], "E", "m" * 50, 1) for number in range(10_000)]
    same = [(["x"], "E", f"{number}", 1) for number in range(10_000)]
    text = "name 'x' is not defined" + "'a'" * 500_000
    raised = [("answer", number, "raised", "NameError", text, 1, [], "") for number in (1, 2)]
    call = begun(Said(("loaded", ["f"], failed[:8000], []), *raised))
    with within(LONG):
        for _ in range(2):
            with pytest.raises(FunctionRaised):
                call("f")
        failures = Failures([*failed, *same])
        assert failures.behind(text) == (["x"], "E", "0", 1)
        assert failures.of("a9999") is not None
        assert failures.of("unknown") is None


@pytest.mark.parametrize("off", [0.0, 1e-5, -2e-5])
def test_no_number_stands_for_infinity(off):
    never = Right((np.array([1.0, np.inf]),), (1.0,))
    assert not deviation_of(Answer(np.array([1.0, off - AGAINST_INFINITY])), never).right
    assert deviation_of(Answer([1.0, np.inf]), never).right


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("value", [1e308, -1e308, np.longdouble("1e4000"), np.float16(6e4), 5e-324])
def test_the_largest_numbers_are_wrong_like_any_other_number(value):
    found = deviation_of(Answer(np.array([value, 1.0])), Right((np.array([2.0, 1.0]),), (1e-3,)))
    assert not found.right
    assert np.isfinite(found.total)


@pytest.mark.parametrize("value", [np.zeros((20_000, 1)), (np.zeros(3), [[0.0]] * 100), np.zeros((1, 1, 1, 3))])
def test_an_answer_that_would_fill_the_memory_ends_the_run(value):
    with pytest.raises(RunFailed, match="where there is one contact"):
        scenario_runs._arrays(value)
    assert scenario_runs._arrays(([1.0, 2.0, 3.0], np.zeros((1, 3, 3))))[1].shape == (1, 3, 3)


@pytest.mark.parametrize(
    "body",
    [
        b'["array","<U0",[1000000000],""]',
        b'["array","|S0",[3],""]',
        b'["array","<f8",[1099511627776,0],""]',
        b'["array","<f8",[0,3000000,3000000],""]',
        b'["list",[' * 30 + b"]]" * 30,
        b"9" * 2000,
    ],
)
def test_a_message_that_would_fill_the_memory_is_refused(body):
    with pytest.raises(messages.Refused):
        messages.unpack(body)


def test_the_submission_pays_for_the_time_of_foreseen_calls():
    class Deaf(Said):
        def send(self, message: bytes, seconds: float, until: float = 0.0) -> None:
            self.spent += 0.2

    process = Said(("loaded", ["f"], [], []), ("answer", 1, "value", 0.0, [], 5.0, ""))
    patience = Patience(Budget(10.0))
    call = Call(Submission("lab.py", ""), Limits(), patience, contextlib.nullcontext)
    call.begin(process, Tier.NETWORK)
    process.send = Deaf.send.__get__(process)  # type: ignore[method-assign]
    argument = (1.0,)
    call.foresee("f", [argument])
    assert call("f", *argument) == 5.0
    assert patience.spent["f"] > 0.15


def test_words_that_are_left_out_of_feedback_earn_nothing(grader, tmp_path):
    silent = """
def made(text):
    found = {"text": text}
    exec(compile("def f(*arguments): raise Exception(text)", "elsewhere", "exec"), found)
    return found["f"]
side_of_plane = made("side_of_plane = submission.side_of_plane")
signed_distance = made("signed_distance = submission.signed_distance")
"""
    (tmp_path / "lab.py").write_text(silent)
    found = grade(tmp_path / "lab.py", ["detection"], ["visible"], grader)
    assert found.sheet.earned == 0
    assert all(outcome.said or all(part.said for part in outcome.parts) for outcome in found.sheet.outcomes)


def test_no_link_is_followed_with_topics_or_without(grader, tmp_path):
    (tmp_path / "right.py").write_text("def side_of_plane(separation, tolerance=0.0): return separation < -tolerance")
    (tmp_path / "lab.py").symlink_to(tmp_path / "right.py")
    for topics in (None, ["detection"]):
        with pytest.raises(UnreadableSubmission, match=r"lab\.py: it is a symbolic link"):
            grade(tmp_path / "lab.py", topics, ["visible"], grader)


@pytest.mark.parametrize("content", [None, b"", b"def f(:"])
def test_a_file_without_code_is_an_error_and_never_a_grade(content, grader, tmp_path):
    path = tmp_path / "lab.py"
    if content is not None:
        path.write_bytes(content)
    if content:  # it is read, though no function of it can be
        found = grade(path, ["detection"], ["visible"], grader).content()
        assert found["got"] == 0
        assert "right" not in {function["verdict"] for function in found["functions"]}
    else:
        with pytest.raises(UnreadableSubmission, match=r"lab\.py: (it|there) is "):
            grade(path, ["detection"], ["visible"], grader)


@pytest.mark.slow
def test_many_statements_in_many_cells_are_read_in_seconds(tmp_path):
    cell = '{"cell_type": "code", "source": "' + "f=1\\n" * 10 + '"},'
    (tmp_path / "lab.ipynb").write_text('{"cells": [' + (cell * 1900).rstrip(",") + "]}")
    with within(10):  # 2 s of Python's own reading; each cell used to look through the statements of all others
        assert read(tmp_path / "lab.ipynb", ["f"]).text.count("f=1") == 19_000


def test_examples_also_depend_on_the_file_of_the_test(tmp_path):
    class Item:
        def __init__(self, path: Path, submission: Path) -> None:
            self.path, self.config = path, self
            self.getoption = {"--submission": submission}.get

    for name in ("visible", "hidden", "lab", "other"):
        (tmp_path / name).write_text(name)
    seeds = {
        _seed(Item(tmp_path / test, tmp_path / lab))  # type: ignore[arg-type]
        for test in ("visible", "hidden")
        for lab in ("lab", "other", "lab")
    }
    assert len(seeds) == 4


def test_a_grade_has_its_tier_though_the_submission_does_not_load(grader, tmp_path, monkeypatch):
    monkeypatch.setattr(grader, "limits", Limits(call=0.3))
    loops = "import time\ndef wait():\n    while True: time.sleep(0.01)\nside_of_plane = wait()\n"
    (tmp_path / "lab.py").write_text(loops)
    found = grade(tmp_path / "lab.py", ["detection"], ["visible"], grader)
    with Remote(Submission("lab.py", ""), grader).fresh() as call:
        assert call.sealing is not None
        assert found.sheet.tier == call.sealing.tier.title
    assert found.sheet.earned == 0
