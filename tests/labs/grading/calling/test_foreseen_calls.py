"""Calls that were foreseen go out together, and none of them gets the answer to another call."""

from __future__ import annotations

import numpy as np
import pytest
from stand_ins import begun, value

from labs.grading.calling import calls
from labs.grading.errors import (
    NoAnswer,
)
from labs.grading.worker import messages


def numbers_sent(process):
    return [messages.unpack(each)[1:3] for each in split(process.sent[-1])]


def split(requests):
    found = []
    while requests:
        end = messages.HEADER + messages.length(requests[: messages.HEADER])
        found.append(requests[messages.HEADER : end])
        requests = requests[end:]
    return found


# Foreseen


def test_foreseen_calls_are_sent_together_and_answered_in_order():
    several = [(1.0,), (2.0,), (3.0,)]
    call, process = begun(*(value(number, 10.0 * number) for number in range(1, 5)))
    call.foresee("f", several)
    assert numbers_sent(process) == [(1, "f"), (2, "f"), (3, "f")]
    assert [call("f", *each) for each in several] == [10.0, 20.0, 30.0]
    assert process.asked[2:] == [None] * 3
    assert call("f", 4.0) == 40.0
    assert process.asked[-1] == ("call", 4, "f", (4.0,), [])


@pytest.mark.parametrize(
    "other",
    [lambda call, x: call("g", x), lambda call, x: call("f", float("1.0")), lambda call, x: call("f", x, e=1.0),
     lambda call, x: call("f", x, x), lambda call, x: call("f")],
)  # fmt: skip
def test_an_unforeseen_call_never_gets_the_answer_of_a_foreseen_one(other):
    """Not even where the arguments are equal: they could have been written to meanwhile."""
    x = float("1.0")
    call, process = begun(value(1, 10.0), value(2, 20.0), value(3, 30.0))
    call.foresee("f", [(x,), (x,)])
    assert other(call, x) == 30.0
    assert process.asked[2:4] == [None, None]
    assert process.asked[4] is not None


def test_a_forged_number_is_detected_among_foreseen_answers():
    call, _ = begun(value(2, 10.0))
    several = [(1.0,), (2.0,)]
    call.foresee("f", several)
    with pytest.raises(NoAnswer):
        call("f", *several[0])


def test_no_more_is_sent_ahead_than_a_pipe_holds():
    call, process = begun(*(value(number, 0.0) for number in (1, 2, 3, 5, 6, 7)))  # 4 was too long
    several = [(np.zeros(1000),) for _ in range(6)]  # some 10 700 bytes each
    call.foresee("f", several)
    assert len(split(process.sent[-1])) == 3
    assert len(process.sent[-1]) <= calls._AHEAD < len(process.sent[-1]) * 4 / 3
    assert [call("f", *each) for each in several] == [0.0] * 6
    assert [each is None for each in process.asked[2:]] == [True] * 3 + [False] * 3


def test_no_calls_are_foreseen_twice_or_after_the_process_is_lost():
    call, process = begun(value(1, 0.0), value(9, 0.0))
    call.foresee("f", several := [(1.0,)])
    call.foresee("f", [(2.0,)])
    assert len(process.sent) == 2
    assert call("f", *several[0]) == 0.0
    with pytest.raises(NoAnswer):
        call("f", 3.0)
    assert process.over
    call.foresee("f", [(4.0,)])
    assert len(process.sent) == 2
