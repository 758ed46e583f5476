"""What becomes of a process's answers, forged ones too, and how long it is waited for."""

from __future__ import annotations

import contextlib
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from stand_ins import LOADED, PATIENT, SEALED, Scripted, begun, value

from labs.grading import budget
from labs.grading.budget import ON_THE_CLOCK, Budget
from labs.grading.calling.calls import Call
from labs.grading.calling.patience import Patience
from labs.grading.calling.processes import Limits
from labs.grading.calling.remote import Remote
from labs.grading.errors import (
    FunctionMissing,
    FunctionRaised,
    GraderFailed,
    MachineBusy,
    NoAnswer,
    NotSteady,
    NotTried,
    OutOfTime,
    ProcessDied,
    WrongType,
)
from labs.grading.submission.cells import CODE_LIMIT
from labs.grading.submission.reading import Submission
from labs.grading.worker import messages
from labs.grading.worker.tier import Tier
from reference.errors import InvalidInput, NeedsFunction

PAIR = np.zeros(2)  # compared with anything, it is neither true nor false


@pytest.mark.parametrize(
    "forged",
    [
        PAIR, [], (), None, 1.0, "answer", ("answer",), (PAIR,) * 7, (PAIR, 1, "value", 0.0, [], 1.0, ""),
        ("answer", PAIR, "value", 0.0, [], 1.0, ""), ("answer", 1, PAIR, 0.0, [], 1.0, ""),
        ("answer", 1, "value", PAIR, [], 1.0, ""), ("answer", 1, "value", 0.0, PAIR, 1.0, ""),
        ("answer", 1, "value", 0.0, [], 1.0, PAIR), ("answer", 2, "value", 0.0, [], 1.0, ""),
        ("answer", 1, "raised", PAIR, "", 1, [], ""), ("answer", 1, "raised", "E", PAIR, 1, [], ""),
        ("answer", 1, "raised", "E", "m", 1, PAIR, ""),
        ("answer", 1, "refused", PAIR, ""), ("answer", 1, "missing", PAIR, ""), ("answer", 1, "else", ""),
    ],
    ids=str,
)  # fmt: skip
def test_a_forged_answer_is_no_answer(forged):
    process = Scripted(SEALED, LOADED, forged)
    call = Call(Submission("lab.py", ""), PATIENT, Patience(Budget(10.0)), contextlib.nullcontext)
    call.begin(process, Tier.NETWORK)
    with pytest.raises(NoAnswer, match="wrote into the grader's pipe"):
        call("f", 1.0)


def test_malformed_parts_of_an_answer_are_ignored():
    process = Scripted(
        SEALED,
        (
            "loaded",
            ["f", PAIR, 1],
            [PAIR, (PAIR, "E", "m", 1), (["g"], "E", "m", -1), (["h"], "E", "m", 10**30)],
            [PAIR],
        ),
        ("answer", 1, "value", 0.0, [PAIR, 7, -1, 10**30, 0], 5.0, "said"),
        ("answer", 2, "raised", "E", "m", 10**1000, [PAIR, 7, "g"], ""),
        ("answer", 3, "raised", "E", "m", PAIR, [], ""),
    )
    call = Call(Submission("lab.py", ""), PATIENT, Patience(Budget(10.0)), contextlib.nullcontext)
    call.begin(process, Tier.NETWORK)
    assert (call("f", 1.0), call.changed, call.printed) == (5.0, (0,), "said")
    for _ in range(2):
        with pytest.raises(FunctionRaised, match=r"^f raised E: m$") as raised:
            call("f", 1.0)
        assert set(raised.value.through) <= {"g"}


@pytest.mark.parametrize("forged", [PAIR, (PAIR, PAIR, PAIR), ("loaded", PAIR, [], []), ("answer", 1), None])
def test_a_submission_that_forges_its_own_loading_cannot_be_called(forged):
    call = Call(Submission("lab.py", ""), PATIENT, Patience(Budget(10.0)), contextlib.nullcontext)
    assert isinstance(call.begin(Scripted(SEALED, forged), Tier.NETWORK), NoAnswer)
    with pytest.raises(NoAnswer, match="on loading"):
        call("f", 1.0)


# In the order of a call's life


def test_the_text_is_sent_once_and_each_call_with_number_and_arguments():
    call, process = begun(value(1, 5.0), value(2, 6.0), text="x = 1\n")
    assert (call("f", 1.0, [2]), call("g", b=3.0)) == (5.0, 6.0)
    text, printed, code = messages.unpack(process.sent[0][messages.HEADER :])
    assert (text.tobytes(), printed, code, len(process.sent)) == (b"x = 1\n", 50, None, 1)
    assert process.asked == [None, None, ("call", 1, "f", (1.0, [2]), []), ("call", 2, "g", (), [("b", 3.0)])]
    assert (call.defines("f"), call.defines("g"), call.gone) == (True, False, False)


def test_output_and_changed_arguments_belong_to_one_call_alone():
    call, _ = begun(value(1, 5.0, [1, 0, 2], "one\x1b"), value(2, 6.0), ("answer", 3, "missing", ""))
    call("f", 1.0, named=2.0)
    assert (call.changed, call.printed) == ((0, 1), "one␛")
    call("f", 1.0)
    assert (call.changed, call.printed) == ((), "")


def test_a_failure_to_start_is_a_fault_of_the_grader():
    class Broken(Scripted):
        def send(self, message: bytes, seconds: float, until: float = 0.0) -> None:
            raise OSError("full")

    def call():
        return Call(Submission("lab.py", ""), PATIENT, Patience(Budget(10.0)), contextlib.nullcontext)

    with pytest.raises(GraderFailed, match="a test's process did not start: full"):
        call().start(Broken())
    for error, why in ((EOFError(), "it ended itself .exit code 3."), (messages.Refused("no"), "no$")):
        with pytest.raises(GraderFailed, match=rf"did not start: {why}"):
            call().begin(Scripted(error), Tier.PROCESS)


@pytest.mark.parametrize("tier", [Tier.PROCESS, Tier.LIMITS, Tier.FILES, Tier.NETWORK])
def test_nothing_is_run_below_the_least_tier(tier):
    for least in Tier:
        call = Call(Submission("lab.py", ""), PATIENT, Patience(Budget(10.0)), contextlib.nullcontext)
        process = Scripted(("sealed", int(tier), ["no Landlock", "no seccomp"], [], 0, 0.0), LOADED)
        if tier >= least:
            assert call.begin(process, least) is None
            assert (call.sealing.tier, call.sealing.missing) == (tier, ("no Landlock", "no seccomp"))
        else:
            with pytest.raises(GraderFailed, match=f"offers '{tier.title}', below '{least.title}': no Landlock; no se"):
                call.begin(process, least)
            assert len(process.asked) == 1, "it was not told to run the text"


def test_a_process_below_the_least_tier_is_ended_at_once():
    process = Scripted(("sealed", int(Tier.LIMITS), [], [], 0, 0.0))
    grader = SimpleNamespace(limits=PATIENT, least=Tier.NETWORK, host=process)
    with pytest.raises(GraderFailed), Remote(Submission("lab.py", ""), grader).fresh():
        pass
    assert process.over


def test_a_process_that_names_no_tier_is_not_trusted():
    call = Call(Submission("lab.py", ""), PATIENT, Patience(Budget(10.0)), contextlib.nullcontext)
    with pytest.raises(GraderFailed):
        call.begin(Scripted(("sealed", 3), LOADED), Tier.LIMITS)


def test_a_submission_that_could_not_be_loaded_says_so_at_every_call():
    call = Call(Submission("lab.py", ""), PATIENT, Patience(Budget(10.0)), contextlib.nullcontext)
    unloadable, process = NoAnswer("as before"), Scripted()
    assert call.begin(process, Tier.NETWORK, unloadable) is unloadable
    call.foresee("f", [(1.0,)])
    with pytest.raises(NoAnswer, match="as before"):
        call("f", 1.0)
    assert (process.sent, call.ended, call.gone) == ([], None, True)
    call.end()


# Foreseen


def test_a_call_that_cannot_be_sent_is_the_callers_mistake():
    call, _ = begun()
    with pytest.raises(InvalidInput, match="f cannot be called with an object of type"):
        call("f", object())


@pytest.fixture
def clock(monkeypatch):
    """What passes when it is told to: s on the clock, and s that this process computes."""
    now = SimpleNamespace(time=100.0, ran=7.0)
    fake = SimpleNamespace(monotonic=lambda: now.time, thread_time=lambda: now.ran)
    monkeypatch.setattr(budget, "time", fake)
    return now


def slow(process, seconds, clock=None, in_line=0.0):
    """Let each answer cost the process so much of its own time, and so much more on the clock that it is in line."""
    exchange = process.exchange

    def later(message, allowed, until):
        process.spent += seconds
        if clock:
            clock.time += seconds + in_line
        return exchange(message, allowed, until)

    process.exchange = later


# Time


def test_the_limits_are_those_in_the_documentation():
    limits, page = Limits(), (Path(__file__).parents[4] / "docs" / "grading.md").read_text(encoding="utf-8")
    times = f"each call {limits.call:g} s, a test {limits.test:g} s and a submission {limits.submission:g} s in all"
    assert times in page
    assert f"take more than {limits.memory / 2**30:g} GiB" in page


def test_a_call_may_take_what_call_test_and_submission_have_left(clock):
    call, process = begun(*(value(n, 0.0) for n in range(1, 6)), limits=Limits(call=5.0, test=8.0), patience=90.0)
    slow(process, 3.0)
    for _ in range(3):
        call("f")
    assert process.waits[1:] == [5.0, 5.0, 5.0, 2.0]
    call, process = begun(*(value(n, 0.0) for n in range(1, 6)), limits=Limits(call=5.0, test=80.0), patience=9.0)
    slow(process, 2.0)
    clock.ran += 3.0  # spent by the grader, on what the submission made it do
    for name in ("f", "g", "h"):
        call(name)
    assert process.waits[1:] == [3.0, 3.0, 3.0, 2.0]
    with pytest.raises(NotTried, match="it was not tried to the end: the 9 s that the whole file has are used up"):
        call("f")


def test_a_function_may_use_a_third_of_the_time_and_others_have_the_rest(clock):
    call, process = begun(*(value(n, 0.0) for n in range(1, 9)), limits=Limits(call=5.0, test=80.0), patience=30.0)
    slow(process, 4.0)
    for _ in range(3):
        call("f")
    assert process.waits[2:] == [5.0, 5.0, 2.0]
    call("g")
    with pytest.raises(OutOfTime, match="it has taken 10 s in all, which is its share of the 30 s that the whole file"):
        call("f")
    assert call._patience.slow == {"f"}


USES = {"g": ["f"], "h": ["g"]}
"""Which functions a function calls itself: h calls g, which calls f; k calls none."""


def test_functions_that_call_a_slow_one_share_its_time_and_name_it(clock):
    call, process = begun(*(value(n, 0.0) for n in range(1, 9)), limits=Limits(call=5.0, test=80.0), patience=30.0)
    call._patience.uses = lambda name: USES.get(name, ())
    slow(process, 2.0)
    for name in ("f", "g", "h", "h"):
        call(name)
    assert process.waits[2:] == [5.0, 5.0, 5.0, 4.0]
    call("f")  # what its callers took is not its own
    call("k")
    assert process.waits[6:] == [5.0, 5.0]
    assert call._patience.slow == {"g", "h"}
    with pytest.raises(OutOfTime, match=r"^h gave no answer: it calls your f, which is too slow$"):
        call("h")


def test_a_fast_function_has_its_time_whatever_it_might_call(clock):
    call, process = begun(*(value(n, 0.0) for n in range(1, 9)), limits=Limits(call=5.0, test=80.0), patience=30.0)
    call._patience.uses = lambda name: USES.get(name, ())
    call("g")
    fast = process.exchange
    slow(process, 4.0)
    for _ in range(3):
        call("f")
    process.exchange = fast
    call("g")
    assert process.waits[-1] == 5.0
    assert call._patience.slow == {"f"}


def test_a_call_of_one_that_ran_out_of_time_is_waited_for_less(clock):
    patience = Patience(Budget(30.0), lambda name: USES.get(name, ()))
    patience.calls["f"], patience.spent["f"], patience.timeouts["f"] = 1, 5.0, 1
    assert [patience.for_call(name, 5.0) for name in ("f", "g", "h", "k")] == [1.0, 1.0, 1.0, 5.0]
    patience.calls["h"], patience.spent["h"] = 1, 1.0
    assert patience.slow == {"f", "h"}


def test_waiting_in_line_costs_no_time_of_a_call_a_test_or_a_file(clock):
    call, process = begun(*(value(n, 0.0) for n in range(1, 9)), limits=Limits(call=5.0, test=8.0), patience=9.0)
    slow(process, 0.1, clock, in_line=20.0)
    for _ in range(8):
        assert call("f") == 0.0
    assert process.waits[2:] == pytest.approx([3.0 - 0.1 * n for n in range(8)])  # a third of nine seconds, less these
    assert process.until == 100.0 + 9.0 * ON_THE_CLOCK


def test_a_file_that_the_clock_ends_is_not_graded_and_loses_nothing(clock):
    call, process = begun(value(1, 0.0), MachineBusy(), limits=Limits(), patience=9.0)
    slow(process, 0.1, clock, in_line=100.0)
    call("f")
    budget = call._patience.budget
    budget.refuse_if_cut()
    for _ in range(2):
        with pytest.raises(MachineBusy, match="not graded for lack of time: the machine was too busy"):
            call("f")
    assert process.over
    with pytest.raises(MachineBusy):
        budget.refuse_if_cut()


@pytest.mark.parametrize(
    ("limits", "patience", "words"),
    [
        (Limits(call=5.0, test=8.0), 50.0, "f gave no answer within 5 s and was stopped"),
        (Limits(call=5.0, test=4.0), 50.0, "^f gave no answer: the 4 s of this test are used up$"),
        (
            Limits(call=5.0, test=4.0),
            6.0,
            "^f gave no answer: it has taken 2 s in all, which is its share of the 6 s that the whole file has$",
        ),
    ],
)
def test_a_timeout_names_the_limit_that_was_reached(limits, patience, words, clock):
    call, process = begun(TimeoutError(), limits=limits, patience=patience)
    with pytest.raises(OutOfTime, match=words):
        call("f")
    assert process.over
    with pytest.raises(OutOfTime, match=words):
        call("g")


# In words


@pytest.mark.parametrize(
    ("said", "error", "words"),
    [
        (("raised", "ValueError", "so", 3, []), FunctionRaised, "f raised ValueError: so (line 3)"),
        (("raised", "ValueError", "", None, []), FunctionRaised, "f raised ValueError"),
        (("raised", "V\x1b" * 200, "s\n\x1bo", None, []), FunctionRaised,
         "f raised " + "V␛" * 50 + " … (400 characters in all): s ␛o"),
        (("raised", "ValueError", "so", 0, []), FunctionRaised, "f raised ValueError: so"),
        (("raised", "ValueError", "so", CODE_LIMIT, []), FunctionRaised,
         f"f raised ValueError: so (line {CODE_LIMIT})"),
        (("raised", "ValueError", "so", CODE_LIMIT + 1, []), FunctionRaised, "f raised ValueError: so"),
        (("raised", "NameError", "name 'rate' is not", 3, []), FunctionRaised,
         "f raised NameError: name 'rate' is not (line 3). On loading: KeyError: 'k' (line 2)"),
        (("raised", "KeyError", "name 'rate' is not", None, []), FunctionRaised,
         "f raised KeyError: name 'rate' is not"),
        (("raised", "NameError", "name 'other' is not", None, []), FunctionRaised,
         "f raised NameError: name 'other' is not"),
        (("raised", "NotImplementedError", "", 3, []), FunctionMissing, "needs f: it is not written yet"),
        (("refused", "an object\nof type X"), WrongType,
         "f gave an object of type X; an answer is a number, text, an array or a tuple of these"),
        (("missing",), FunctionMissing, "needs f: it is not in the submission"),
        (EOFError(), ProcessDied, "f gave no answer: it ended itself (exit code 3), as os._exit does"),
        (OSError("gone"), ProcessDied, "f gave no answer: it ended itself (exit code 3), as os._exit does"),
        (messages.Refused("a message\nof 9 bytes"), NoAnswer, "f gave no answer: a message of 9 bytes"),
    ],
)  # fmt: skip
def test_each_failure_of_a_call_is_described_in_one_line(said, error, words):
    answer = ("answer", 1, *said, "") if isinstance(said, tuple) else said
    call, _ = begun(answer, loaded=("loaded", ["f"], [(["rate", "f_2"], "KeyError", "'k'", 2)], []))
    with pytest.raises(error) as raised:
        call("f", 1.0)
    assert str(raised.value) == words


def test_a_function_whose_definition_failed_says_how_and_where():
    missing = [("answer", number, "missing", "") for number in (1, 2)]
    call, _ = begun(
        *missing,
        loaded=("loaded", [], [(["g"], "KeyError", "'k'", 2), ([""], "OSError", "no", 7), ([], "E", "", 9)], []),
    )
    with pytest.raises(FunctionRaised) as raised:
        call("g")
    assert (str(raised.value), raised.value.kind, raised.value.line) == (
        "g could not be defined: KeyError: 'k' (line 2)", "KeyError", 2,
    )  # fmt: skip
    with pytest.raises(FunctionRaised, match=r"^f could not be defined: OSError: no \(line 7\)$"):
        call("f")


def test_an_exception_costs_the_call_and_a_forged_answer_the_process():
    call, process = begun(("answer", 1, "raised", "E", "m", None, [], ""), value(2, 5.0), ("answer", 3, "value", ""))
    with pytest.raises(FunctionRaised):
        call("f")
    assert (call("f"), process.over) == (5.0, False)
    with pytest.raises(NoAnswer):
        call("f")
    assert process.over


def test_an_answer_is_steady_if_two_processes_agree_bit_by_bit():
    for other, steady in ((0.0, True), (-0.0, False), (np.float64(0.0), False)):
        call, process = begun(value(1, 0.0))
        again, beside = begun(value(1, other))
        call._fresh = lambda again=again: contextlib.nullcontext(again)
        if steady:
            assert call.steady("f", 1.0, e=2.0) == 0.0
        else:
            with pytest.raises(NotSteady, match="f answered the same call otherwise"):
                call.steady("f", 1.0, e=2.0)
        assert process.asked[-1] == beside.asked[-1] == ("call", 1, "f", (1.0,), [("e", 2.0)])


def test_a_driver_gets_defined_functions_and_hears_which_are_missing():
    call, _ = begun(value(1, 5.0))
    code = call.implementation()
    assert code.function("f")(1.0, e=2.0) == 5.0
    with pytest.raises(NeedsFunction, match=r"^needs side_of_plane \(detection, step 2\)$"):
        code.function("side_of_plane")
