"""A submission's functions called from here and run over there: answers, errors and time limits."""

from __future__ import annotations

import re
import time

import numpy as np
import pytest
from stand_ins import PATIENT, calls_until_it_fails

from labs.grading.budget import Budget
from labs.grading.calling.processes import Limits
from labs.grading.calling.remote import Grader, Remote
from labs.grading.errors import (
    FunctionMissing,
    FunctionRaised,
    NotSteady,
    OutOfTime,
    ProcessDied,
    StudentError,
    WrongType,
)
from labs.grading.submission.reading import Submission, read
from reference.engines import load_engine
from reference.engines.implementation import Implementation
from reference.errors import NeedsFunction
from reference.scene.scenario import Body, HalfSpace, Pair, Scenario, Sphere


def test_a_call_looks_like_a_call(of):
    text = """
    import numpy as np
    def mixed(array, scale=1.0, *, name):
        return array * scale, name + "!", [True, None, np.float32(2)]
    """
    with of(text).fresh() as call:
        array, name, rest = call("mixed", np.arange(3.0), 2.0, name="n")
    np.testing.assert_array_equal(array, [0.0, 2.0, 4.0], strict=True)
    assert name == "n!"
    assert rest == [True, None, 2.0]
    assert type(rest[2]) is np.float32


def test_output_is_kept_up_to_a_limit_and_changed_arguments_are_named(of):
    text = """
    import sys
    def f(a, b, c):
        print("one\\x1b[2J"); print("two", file=sys.stderr); print("x" * 10**6)
        b[0] = 7
        c.append(1)
        return a
    """
    with of(text).fresh() as call:
        call("f", np.zeros(3), np.zeros(3), [])
        assert call.changed == (1, 2)
        assert call.printed.startswith("one␛[2J\ntwo\nxxx")
        assert len(call.printed) == 50


@pytest.mark.parametrize(
    ("body", "error", "words"),
    [
        ("return 1 / v", FunctionRaised, "f raised ZeroDivisionError: division by zero (line 2)"),
        ("return (lambda: [][0])()", FunctionRaised, "IndexError: list index out of range (line 2)"),
        ("raise NotImplementedError", FunctionMissing, "needs f: it is not written yet"),
        ("return plt", FunctionRaised, "ModuleNotFoundError: No module named 'matplotlib' (line 1)"),
        ("return f", WrongType, "f gave an object of type function"),
        ("return f(v)", FunctionRaised, "RecursionError"),
        ("return input()", FunctionRaised, "EOFError"),
        ("return np.linalg.inv(np.zeros((2, 2)))", FunctionRaised, "LinAlgError: Singular matrix (line 2)"),
    ],
)
def test_an_exception_is_reported_with_its_line(body, error, words, of):
    text = f"import numpy as np; import matplotlib.pyplot as plt\ndef f(v): {body}"
    with of(text).fresh() as call, pytest.raises(error) as raised:
        call("f", 0)
    assert words in str(raised.value)


def test_a_missing_function_is_named_with_its_topic_and_step(of):
    with of("").fresh() as call, pytest.raises(NeedsFunction, match=r"needs rebound_velocity \(impulse, step 1\)"):
        call("rebound_velocity", -1.0, 0.5)


def test_a_statement_that_fails_on_loading_costs_only_its_users(of):
    text = """
    ZERO = 0
    RATE = 1 / ZERO
    def good(): return 1
    def bad(): return RATE
    def worse(x=UNKNOWN): return x
    """
    with of(text).fresh() as call:
        assert call("good") == 1
        with pytest.raises(FunctionRaised, match=r"'RATE'.*On loading: ZeroDivisionError: division by zero \(line 3\)"):
            call("bad")
        with pytest.raises(FunctionRaised, match=r"worse could not be defined: NameError.*\(line 6\)"):
            call("worse")


@pytest.mark.parametrize(
    "ends",
    [
        "while True:\n    TABLE[1] = 1", "import os\nos._exit(3)", "import time\ntime.sleep(99)",
        "import ctypes\nctypes.string_at(0)", "import os\nos.abort()",
    ],
)  # fmt: skip
def test_a_statement_that_never_ends_or_ends_the_process_is_left_out(ends, of, hasty):
    with of(f"TABLE = {{1: -1}}\n{ends}\ndef f(v): return TABLE[1] * v\n") as remote:
        for _ in range(2):
            with remote.fresh() as call:
                assert call("f", 2.0) == -2.0
    (said,) = map(str, remote.complaints)
    assert said.startswith(
        f"line {2 if ends.startswith('while') else 3}: this statement was left out, because it gave no"
    )


def test_a_slow_statement_is_named_and_left_out_once_its_processes_have_used_their_share(of, grader):
    submission = of("import time\ntime.sleep(0.2)\ndef f(v): return v\n").submission
    with Remote(submission, grader, Budget(1.5)) as remote:
        for _ in range(6):
            with remote.fresh() as call:
                assert call("f", 2.0) == 2.0
    (said,) = map(str, remote.complaints)
    assert said.startswith("line 2: this statement was left out, because it gave no answer: it has taken 0.5 s in all")


def test_a_statement_that_fails_for_its_effect_is_named(of):
    with of("T = {}\nT.pop(1)\nfor n in T[0]:\n    T[n] = 1\ndef f(v): return v\n") as remote, remote.fresh() as call:
        assert call("f", 2.0) == 2.0
        with pytest.raises(FunctionMissing):
            call("g")
    assert [str(each).partition(":")[0] for each in remote.complaints] == ["line 2", "line 3"]


def test_of_many_statements_that_never_end_three_are_left_out(of, hasty):
    ends = "import os\n" + "os._exit(3)\n" * 4 + "def f(v): return v\n"
    with of(ends) as remote, remote.fresh() as call, pytest.raises(ProcessDied, match="on loading"):
        call("f", 2.0)
    assert len(remote.complaints) == 3


def test_code_that_cannot_be_compiled_is_described_with_one_line_number(of):
    with of("def good(): return 1\ndef f():\n    break\n").fresh() as call:
        assert call("good") == 1
        with pytest.raises(FunctionRaised) as raised:
            call("f")
    assert str(raised.value) == "f could not be defined: SyntaxError: 'break' outside loop (line 3)"


def test_an_exception_in_a_notebook_names_its_cell(tmp_path, grader):
    path = tmp_path / "lab.ipynb"
    path.write_text(
        '{"cells": [{"cell_type": "code", "source": "import math"},'
        ' {"cell_type": "code", "source": "\\ndef f(v):\\n    return math.sqrt(v)"}]}'
    )
    with Remote(read(path, ["f"]), grader).fresh() as call, pytest.raises(FunctionRaised) as raised:
        call("f", -1.0)
    assert str(raised.value).endswith("(code cell 2, line 3)")
    assert raised.value.kind == "ValueError"


def test_a_call_that_takes_too_long_ends_only_its_test(of, hasty):
    remote = of("def f(forever):\n    while forever: pass\n    return 1")
    with remote.fresh() as call:
        began = time.monotonic()
        with pytest.raises(OutOfTime, match=r"within 0\.5 s"):
            call("f", True)
        assert time.monotonic() - began < PATIENT.call
        with pytest.raises(OutOfTime):  # its process is gone, so the same is said again
            call("f", False)
    with remote.fresh() as call:
        assert call("f", False) == 1


@pytest.mark.slow
def test_a_function_that_was_too_slow_gets_less_time_afterwards(of, hasty):
    # Loops that sleep: they are stopped like busy ones, and cost the machine nothing while they are waited for.
    loops = """
    import time
    def f(forever):
        while forever: time.sleep(0.01)
        return 1
    def g():
        while True: time.sleep(0.01)
    """
    remote = of(loops)
    waited = []
    for name, *given in (("f", True), ("f", True), ("f", True), ("f", True), ("g",)):
        with remote.fresh() as call, pytest.raises(OutOfTime) as told:
            call(name, *given)
        waited.append(float(re.search(r"within ([\d.]+) s", str(told.value))[1]))
    assert waited == [0.5, 0.2, 0.2, 0.2, 0.5]
    assert remote.slow == {"f", "g"}
    with remote.fresh() as call:
        assert call("f", False) == 1


@pytest.mark.slow
def test_a_test_that_runs_out_of_time_blames_no_function(of, hasty):
    remote = of("import time\ndef f(): time.sleep(0.3)")
    with remote.fresh() as call, pytest.raises(OutOfTime, match=r"time is up|used up"):
        calls_until_it_fails(call, "f")
    assert not remote.slow


@pytest.mark.slow
def test_many_calls_in_time_cannot_exceed_the_limit_of_their_test(of, hasty):
    with (
        of("import time\ndef f(): time.sleep(0.3)").fresh() as call,
        pytest.raises(OutOfTime, match=r"time is up|used up"),
    ):
        calls_until_it_fails(call, "f")


@pytest.mark.slow
def test_a_submission_that_always_hangs_has_a_limit_in_all():
    loops = "".join(f"def {name}():\n    while True: time.sleep(0.01)\n" for name in "fgh")
    text = f"import time\n{loops}def k(): return 1"
    with Grader(Limits(call=0.2)) as own:
        with Remote(Submission("lab.py", ""), own) as first, first.fresh():
            pass  # the grader is ready
        remote, told = Remote(Submission("lab.py", text), own, Budget(1.5)), list[str]()
        for name in "ffffgggghhhh":
            with remote.fresh() as call, pytest.raises(OutOfTime) as error:
                call(name)
            told.append(str(error.value))
        assert "gave no answer within 0.2 s" in told[0]
        assert "it has taken 0.5 s in all, which is its share" in told[3]
        assert told[-1] == "it was not tried to the end: the 1.5 s that the whole file has are used up"
        with Remote(Submission("lab.py", text), own).fresh() as call:  # the next student has time again
            assert call("k") == 1


def test_each_test_has_a_process_that_knows_nothing_of_other_tests(of):
    remote = of("calls = []\ndef f(x):\n    calls.append(x)\n    return len(calls)")
    for _ in range(2):
        with remote.fresh() as call:
            assert [call("f", 0.0), call("f", 0.0)] == [1, 2]


def test_an_answer_that_depends_on_earlier_calls_is_not_steady(of):
    remote = of(
        "calls = []\ndef f(x):\n    calls.append(x)\n    return x if len(calls) < 3 else -x\ndef g(x): return x"
    )
    with remote.fresh() as call:
        assert [call.steady("f", 1.0), call.steady("f", 1.0), call.steady("g", np.nan)][:2] == [1.0, 1.0]
        with pytest.raises(NotSteady, match="only the arguments may count"):
            call.steady("f", 1.0)


def test_a_random_answer_is_not_steady(of):
    remote = of("import numpy as np, random\ndef f(): return np.random.random()\ndef g(): return random.random()")
    for name in ("f", "g"):
        with remote.fresh() as call, pytest.raises(NotSteady):
            call.steady(name)


def test_foreseen_calls_are_answered_like_any_other(of):
    text = """
    import numpy as np
    count = 0
    def double(x):
        global count
        count += 1
        print(count)
        if np.ndim(x) == 0 and x == 3.0:
            raise ValueError("three")
        return 2 * x
    def counted(): return count
    """
    with of(text).fresh() as call:
        several = [(float(x),) for x in range(6)]
        call.foresee("double", several)
        call.foresee("double", several)  # of no use while others are under way, and does no harm
        assert [call("double", *arguments) for arguments in several[:3]] == [0.0, 2.0, 4.0]
        assert call.printed == "3\n"
        with pytest.raises(StudentError, match="three"):
            call("double", *several[3])
        assert call("counted") == 6  # another call: what was foreseen and not asked for is passed over
        assert call("double", 5.0) == 10.0
        assert call("double", x=1.0) == 2.0
        call.foresee("double", [(np.zeros(4000),)])  # too long to send ahead
        assert call("double", np.ones(4000)).sum() == 8000


STUDENT = """
import numpy as np
def signed_distance(point, normal, offset): return np.sum(point * normal, axis=-1) + offset
def side_of_plane(distance): return np.sign(distance)
def time_of_impact_interpolated(before, after, start, end): return start + (end - start) * before / (before - after)
def time_of_impact_exact(distance, velocity, acceleration): return np.full(np.shape(distance), np.inf)
def kinematic_response(velocity, normal, restitution):
    along = np.sum(velocity * normal, axis=-1, keepdims=True)
    return velocity - (1 + np.asarray(restitution)[..., None]) * along * normal
def uniform_gravity(mass, gravity): return np.asarray(mass)[..., None] * gravity
def ballistic_motion(x, v, a, t): t = np.asarray(t)[..., None]; return x + v * t + a * t * t / 2, v + a * t
def semi_implicit_euler(x, v, a, t): v = v + a * np.asarray(t)[..., None]; return x + v * np.asarray(t)[..., None], v
def respond_at_step(x, v, a, normal, behind, restitution, t):
    return semi_implicit_euler(x, np.where(behind[..., None], kinematic_response(v, normal, restitution), v), a, t)
"""

FLOOR = Body("floor", HalfSpace())

BALL = Body("ball", Sphere(0.1), mass=1.0, position=(0.0, 0.0, 0.15), velocity=(1.0, 0.0, 0.0))

BOUNCE = Scenario("bounce", (FLOOR, BALL), (Pair("ball", "floor", restitution=0.5),), 0.2)


def test_a_driver_runs_alike_with_remote_and_local_functions(tmp_path, grader):
    path = tmp_path / "lab.py"
    path.write_text(STUDENT)
    here = load_engine("handwritten", Implementation(str(path)))
    settings = here.settings(BOUNCE, "step")
    with Remote(Submission("lab.py", STUDENT)) as remote, remote.fresh() as call:
        there = load_engine("handwritten", call.implementation())
        one, other = here.run(BOUNCE, settings), there.run(BOUNCE, settings)
    assert len(one.events) > 0
    np.testing.assert_array_equal(one.positions, other.positions, strict=True)
    assert one.events == other.events


def test_a_driver_says_which_function_it_needs(grader):
    with Remote(Submission("lab.py", STUDENT.replace("side_of_plane", "side")), grader).fresh() as call:
        engine = load_engine("handwritten", call.implementation())
        with pytest.raises(NeedsFunction, match=r"needs side_of_plane \(detection, step 2\)"):
            engine.run(BOUNCE, engine.settings(BOUNCE, "step"))
