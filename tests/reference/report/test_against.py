"""What is said of the rows of two comparisons that differ."""

from __future__ import annotations

from dataclasses import replace

from reference.comparison.verdicts import Row, Verdict
from reference.report.against import NEAR, differences

OLD = Row(
    "ball-to-rest", "e=0.5", "mujoco", "tuned", "rest_time", "s", Verdict.PASS, 1.25, engine_version="3.3.0",
    adapter_version="0.1.0",
)  # fmt: skip
COUNTED = "{} of {} rows are as they were; {} are new, and {} have no counterpart here."


def test_equal_rows_are_counted_and_nothing_else_is_said():
    near = replace(OLD, measured=1.25 * (1 + NEAR / 2))
    assert differences([near], [OLD]) == [COUNTED.format(1, 1, 0, 0)]
    zero, gone = replace(OLD, measured=0.0), replace(OLD, measured=None)
    assert [differences([row], [row]) for row in (zero, gone)] == [[COUNTED.format(1, 1, 0, 0)]] * 2


def test_rows_of_another_version_say_so_before_what_changed():
    new = replace(OLD, measured=1.5, verdict=Verdict.FAIL, engine_version="4.0.0", adapter_version="0.2.0")
    other = replace(new, case="e=0.8", engine="away.py")
    assert differences([new, other], [OLD, replace(OLD, case="e=0.9")]) == [
        "The rows of MuJoCo are of different versions: 3.3.0 then, 4.0.0 now.",
        "The lab told MuJoCo its scenarios in version 0.1.0 then, 0.2.0 now.",
        "ball-to-rest/e=0.5, MuJoCo (tuned), rest_time: pass → fail, 1.25 → 1.5 s",
        COUNTED.format(0, 1, 1, 1),
    ]


def test_a_number_that_is_gone_or_new_is_a_difference():
    gone = replace(OLD, measured=None)
    assert differences([gone], [OLD])[0].endswith("rest_time: 1.25 → no number s")
    assert differences([OLD], [gone])[0].endswith("rest_time: no number → 1.25 s")
    assert differences([replace(OLD, engine_version="")], [OLD]) == [COUNTED.format(1, 1, 0, 0)], "unknown is no other"
