"""Whose mistake it is: a function that calls a wrong one is not accused of it, and lost time accuses nobody."""

from __future__ import annotations

import contextlib
from dataclasses import replace
from types import SimpleNamespace

import pytest
from submissions import solved

from labs.grading.diagnosis.deviations import Answer
from labs.grading.diagnosis.findings import Diagnosis
from labs.grading.diagnosis.fingerprints import known
from labs.grading.diagnosis.probes import probes
from labs.grading.diagnosis.recognition import judge
from labs.grading.diagnosis.words import told
from labs.grading.errors import FunctionMissing, NotTried
from labs.grading.feedback.error_advice import Advice
from labs.grading.feedback.faults import suspect
from labs.grading.judging import plugin
from labs.grading.judging.grade import Grade
from labs.grading.judging.outcomes import cause_of, explain
from labs.grading.judging.pytest_run import run
from labs.grading.judging.score_sheet import Outcome, Part, Sheet
from labs.grading.phrases import gives_beside_physics

NUMBER = f"collide(a=2)\n{gives_beside_physics('1', '2')}"
BELOW = known("collide").mistakes[0]
MISTAKEN = Diagnosis("collide", "named", (BELOW,))
WRONG = Diagnosis("apply_impulse", "unknown")
SLOW = Diagnosis("apply_impulse", "too slow")
WRONG_AT_TIMES = """

_right = world_inverse_inertia


def world_inverse_inertia(inertia, orientation):
    found = _right(inertia, orientation)
    return 2 * found if 0 < np.asarray(orientation)[0] < 0.35 else found
"""
"""No probe of a single body has such an orientation."""
NEEDS = "Two balls: needs world_inverse_inertia (impulse, step 4): it is not written yet"
NEVER_STARTS = """
import numpy as np


def sliding_motion(x, v, p, N, ms, mk, m, dt):
    x, v, p, N, mk, m, h = (np.asarray(each, float) for each in (x, v, p, N, mk, m, dt))
    s = np.linalg.norm(v, axis=-1, keepdims=True)
    d = v / np.where(s > 0, s, 1)
    a = np.where(s > 0, p - (mk * N)[..., None] * d, 0) / m[..., None]
    along = np.sum(a * d, axis=-1)
    with np.errstate(all="ignore"):
        t = np.where((along < 0) & (s[..., 0] <= -along * h), -s[..., 0] / along, np.inf)
    t1 = np.minimum(t, h)[..., None]
    return x + v * t1 + a * t1**2 / 2, np.where(np.isfinite(t)[..., None], 0, v + a * h[..., None]), t
"""
"""A body at rest stays at rest, whatever the push."""


def lost(function: str, said: str = "", **more) -> Outcome:
    return Outcome("test_x", 1, False, parts=(Part(1, "any", said, **more),), function=function)


def entry(found: Diagnosis, other: Diagnosis, said: str = NUMBER, **more):
    """What the grade says of `collide`, which calls `apply_impulse`; and of that function."""
    sheet = Sheet(
        outcomes=[lost("apply_impulse", "gives 3"), lost("collide", said)],
        diagnoses={"collide": found, "apply_impulse": other},
        uses={"collide": ["apply_impulse"]},
    )
    functions = Grade(("impulse",), replace(sheet, **more)).content()["functions"]
    return next(each for each in functions if each["name"] == "collide")


def test_a_grade_accuses_no_function_of_the_mistake_of_one_that_it_calls():
    found = entry(MISTAKEN, WRONG)
    assert (found["verdict"], found["mistakes"]) == ("calls a wrong function", [])
    assert found["mend_first"] == ["apply_impulse"]
    assert found["message"].startswith("collide calls apply_impulse: mend that first;")


def test_several_functions_to_mend_first_are_named_in_a_sentence():
    others = ("normal_velocity", "impulse_magnitude", "apply_impulse")
    sheet = Sheet(
        outcomes=[lost("collide", NUMBER), *(lost(name, "gives 3") for name in others)],
        diagnoses={"collide": MISTAKEN, **{name: Diagnosis(name, "unknown") for name in others}},
        uses={"collide": list(others)},
    )
    found = Grade(("impulse",), sheet).content()["functions"][0]
    words = "collide calls normal_velocity, impulse_magnitude and apply_impulse: mend them first; until then the"
    assert found["message"].startswith(words)


def test_an_error_of_its_own_is_held_against_a_caller_of_a_wrong_function():
    raised = "collide raised TypeError: no (line 3)"
    found = entry(Diagnosis("collide", "crashes"), WRONG, raised)
    assert (found["verdict"], found["mend_first"]) == ("crashes", ["apply_impulse"])
    assert found["message"].endswith("\nraised TypeError: no (line 3)")
    assert entry(MISTAKEN, WRONG, raised)["verdict"] == "wrong"


RAISES_AT_TIMES = """

class Odd(Exception):
    pass


def helper(normal):
    raise ValueError(f"{{np.shape(normal)}}")


_right = normal_velocity


def normal_velocity(body_a, body_b, normal):
    if {when}:
        {error}
    return _right(body_a, body_b, normal)
"""
"""Raised for some inputs; the words depend on the inputs, and so differ between this function and its callers."""
WHEN = {"always": "True", "at times": "np.any(np.asarray(body_a[0])[..., 0] > 0)"}
ERRORS = {
    "ValueError": "raise ValueError(f'shape {np.shape(normal)}')",
    "TypeError": "raise TypeError(f'shape {np.shape(normal)}')",
    "IndexError": "return np.zeros(np.size(normal))[99]",
    "KeyError": "return {}[np.shape(normal)]",
    "ZeroDivisionError": "return 1 / 0",
    "AttributeError": "return normal.nothing",
    "NameError": "return undefined_name",
    "AssertionError": "assert False, np.shape(normal)",
    "AxisError": "return np.sum(normal, axis=9)",
    "LinAlgError": "return np.linalg.inv(np.zeros((3, 3)))",
    "shapes": "return np.zeros(np.ndim(normal) + 4) + np.zeros(7)",
    "a class of its own": "raise Odd(normal)",
    "in a helper": "helper(normal)",
}


@pytest.mark.usefixtures("one_grader")
@pytest.mark.parametrize(
    ("error", "when"),
    [
        *(pytest.param(error, "at times", marks=() if error == "ValueError" else pytest.mark.slow) for error in ERRORS),
        *(pytest.param(error, "always", marks=pytest.mark.weekly) for error in ("ValueError", "in a helper", "shapes")),
    ],
)
def test_an_error_out_of_a_wrong_function_accuses_none_of_its_callers(error, when, tmp_path):
    path = solved(tmp_path, "impulse")
    path.write_text(path.read_text() + RAISES_AT_TIMES.format(when=WHEN[when], error=ERRORS[error]))
    sheet = run(path, ("impulse",), ("visible",), functions=("normal_velocity", "impulse_magnitude", "collide"))
    found = {each["name"]: each for each in Grade(("impulse",), sheet).content()["functions"]}
    assert found["normal_velocity"]["verdict"] == "crashes"
    for name in ("impulse_magnitude", "collide"):
        assert found[name]["verdict"] == "calls a wrong function", found[name]["message"]
        assert "normal_velocity" in found[name]["mend_first"]
        assert "raised" not in found[name]["message"]


def test_an_error_of_a_caller_is_its_own_though_another_one_passed_through_the_callee():
    theirs = lost("collide", "collide raised ValueError: b (line 9)", through=("collide", "apply_impulse"))
    own = lost("collide", "collide raised TypeError: no (line 3)", through=("collide",))
    sheet = Sheet(
        outcomes=[lost("apply_impulse", "apply_impulse raised ValueError: a (line 9)"), theirs, own],
        diagnoses={"collide": Diagnosis("collide", "crashes"), "apply_impulse": WRONG},
        uses={"collide": ["apply_impulse"]},
    )
    found = Grade(("impulse",), sheet).content()["functions"][1]
    assert found["verdict"] == "crashes"
    assert "TypeError: no" in found["message"]
    assert "ValueError" not in found["message"]


def test_a_function_that_is_wrong_for_many_alone_excuses_no_number():
    found = entry(MISTAKEN, Diagnosis("apply_impulse", "one at a time"))
    assert (found["verdict"], found["mistakes"]) == ("named", [BELOW.id])
    assert found["mend_first"] == ["apply_impulse"]


def test_only_a_slow_function_excuses_one_that_calls_it_for_its_time():
    slow = Diagnosis("collide", "too slow")
    assert entry(slow, SLOW)["verdict"] == "calls a wrong function"
    assert "loop" not in entry(slow, SLOW)["message"]
    assert entry(slow, WRONG)["verdict"] == "too slow"


def asked_of_all_balls(found, drag, said="total_force(...)\ngives 1\nphysics 2"):
    """The entry of `total_force`, which hands all balls at once to `stokes_drag`, which has lost points as well."""
    sheet = Sheet(
        outcomes=[lost("stokes_drag"), lost("total_force", said)],
        diagnoses={"total_force": found, "stokes_drag": drag},
        uses={"total_force": ["stokes_drag"]},
    )
    return Grade(("forces",), sheet).content()["functions"][1]


@pytest.mark.parametrize(
    "drag",
    [
        Diagnosis("stokes_drag", "one at a time"),
        Diagnosis("stokes_drag", "right", changes_input=True),
        Diagnosis("stokes_drag", "one at a time", changes_input=True),
    ],
    ids=lambda found: f"{found.verdict}{' in place' * found.changes_input}",
)
def test_numbers_of_a_function_without_a_single_case_accuse_nobody_while_it_calls_one_for_single_cases(drag):
    for verdict in ("unknown", "right"):
        found = asked_of_all_balls(Diagnosis("total_force", verdict), drag)
        assert (found["verdict"], found["mend_first"]) == ("calls a wrong function", ["stokes_drag"])
    known_mistake = Diagnosis("total_force", "named", (known("total_force").mistakes[0],))
    assert asked_of_all_balls(known_mistake, drag)["verdict"] == "named"


def test_a_function_that_tests_alone_find_wrong_excuses_callers_that_are_right_on_their_probes():
    drag = Diagnosis("stokes_drag", "right")
    assert asked_of_all_balls(Diagnosis("total_force", "right"), drag)["verdict"] == "calls a wrong function"
    assert asked_of_all_balls(Diagnosis("total_force", "unknown"), drag)["verdict"] == "unknown"


def test_an_array_of_another_shape_excuses_errors_about_shapes_and_no_others():
    drag = Diagnosis("stokes_drag", "shape")
    said = "total_force raised ValueError: operands could not be broadcast together with shapes (0,3) (2,1) (line 9)"
    assert asked_of_all_balls(Diagnosis("total_force", "crashes"), drag, said)["verdict"] == "calls a wrong function"
    said = "total_force raised NameError: name 'vizcosity' is not defined (line 9)"
    assert asked_of_all_balls(Diagnosis("total_force", "crashes"), drag, said)["verdict"] == "crashes"


@pytest.mark.parametrize("verdict", ["unwritten", "not tried"])
def test_what_was_not_written_or_not_tried_is_said_whatever_it_calls(verdict):
    assert entry(Diagnosis("collide", verdict), WRONG)["verdict"] == verdict


@pytest.mark.parametrize(
    ("accepted", "verdict"), [((), "tested with a wrong function"), (("a negative mass",), "wrong")]
)
def test_a_run_that_calls_a_wrong_function_is_no_mistake_of_the_tested_one(accepted, verdict):
    sheet = Sheet(
        outcomes=[lost("apply_impulse"), lost("collide", "gives 3", others=("apply_impulse",))],
        diagnoses={"apply_impulse": WRONG, "collide": Diagnosis("collide", "right", accepted=accepted)},
    )
    found = Grade(("impulse",), sheet).content()["functions"][1]
    assert (found["verdict"], found["mend_first"]) == (verdict, ["apply_impulse"])
    assert "collide: right on every probe" not in found["message"]


@pytest.mark.parametrize(
    ("found", "lost_too", "verdict"),
    [
        (Diagnosis("collide", "right"), [], "unwritten"),
        (None, [], "unwritten"),
        (MISTAKEN, [], "named"),
        (Diagnosis("collide", "right"), [AssertionError(NUMBER)], "wrong"),
    ],
)
def test_a_function_that_waits_for_another_one_is_not_called_wrong(found, lost_too, verdict):
    errors = [AssertionError(NEEDS), FunctionMissing(NEEDS), *lost_too]
    sheet = Sheet(
        outcomes=[lost("collide", str(error), cause=cause_of(error)) for error in errors],
        diagnoses={"collide": found} if found else {},
    )
    said = Grade(("impulse",), sheet).content()["functions"][0]
    assert said["verdict"] == verdict
    assert (said["message"] == "collide waits for world_inverse_inertia.") == (verdict == "unwritten")


@pytest.mark.usefixtures("one_grader")
def test_a_mistake_of_a_function_that_is_not_there_is_not_offered(tmp_path):
    path = tmp_path / "lab.py"
    path.write_text(NEVER_STARTS)
    sheet = run(path, ("friction",), functions=("sliding_motion",))
    assert (sheet.diagnoses["sliding_motion"].verdict, sheet.diagnoses["sliding_motion"].mistakes) == ("unknown", ())


def test_a_wrong_number_stays_wrong_when_the_time_is_used_up():
    late, early = cause_of(NotTried("it was not tried")), cause_of(AssertionError("gives 3"))
    sheet = Sheet(
        outcomes=[
            lost("collide", NUMBER, cause=early),
            lost("collide", "it was not tried", cause=late),
            lost("apply_impulse", "it was not tried", cause=late),
            lost("energy_lost", NUMBER, cause=early),
            lost("edge_edge_normal", "it was not tried", cause=late),
            lost("impulse_magnitude", NEEDS, cause=cause_of(AssertionError(NEEDS))),
            lost("impulse_magnitude", "it was not tried", cause=late),
            lost("world_inverse_inertia", NEEDS, cause=cause_of(FunctionMissing(NEEDS))),
            lost("world_inverse_inertia", "it was not tried", cause=late),
        ]
    )
    uses = {"energy_lost": ["collide"], "collide": ["apply_impulse"]}
    defined = ("collide", "apply_impulse", "energy_lost", "impulse_magnitude", "world_inverse_inertia")
    submission = SimpleNamespace(functions=defined, borrows=lambda name: {}, uses=lambda name: uses.get(name, []))
    over = SimpleNamespace(
        slow=frozenset(), budget=SimpleNamespace(left=0.0), fresh=lambda: contextlib.nullcontext(not_tried)
    )
    explain(sheet, submission, over)
    verdicts = {each["name"]: each["verdict"] for each in Grade(("impulse",), sheet).content()["functions"]}
    assert verdicts == {
        "collide": "wrong", "apply_impulse": "not tried", "energy_lost": "calls a wrong function",
        "edge_edge_normal": "unwritten", "impulse_magnitude": "not tried", "world_inverse_inertia": "unwritten",
    }  # fmt: skip


def not_tried(*given):
    raise NotTried("it was not tried")


@pytest.mark.usefixtures("one_grader")
def test_a_wrong_single_case_is_not_called_right_for_one_case(tmp_path, monkeypatch):
    monkeypatch.setattr(plugin, "_seed", lambda item: 1)  # such an orientation is drawn, however the file reads
    path = solved(tmp_path, "impulse")
    path.write_text(path.read_text() + WRONG_AT_TIMES)
    sheet = run(path, ("impulse",), functions=("world_inverse_inertia",))
    found = Grade(("impulse",), sheet).content()["functions"][0]
    assert sheet.causes("world_inverse_inertia") == {"", "several cases"}
    assert found["verdict"] == "wrong"
    assert "right for one case" not in found["message"]


def test_the_error_of_an_example_is_said_once():
    error = "normal_velocity raised ValueError: only one (line 3)"
    cases = zip(probes("normal_velocity"), known("normal_velocity").right, strict=True)
    answers = [
        Answer(right.outputs[0]) if right and probe.group != "many" else Answer(error=error) for probe, right in cases
    ]
    found = judge("normal_velocity", answers)
    assert found.verdict == "one at a time"
    for words in (told(found), " ".join(suspect("normal_velocity", found, Advice()))):
        assert words.count("raised ValueError") == 1
        assert "ends in an error: " not in words
