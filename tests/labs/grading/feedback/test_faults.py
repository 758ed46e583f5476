"""What is said of a wrong function: what to mend first, an example that shows the mistake, and no hint on another."""

from __future__ import annotations

import json

import numpy as np
import pytest
from submissions import checked, joined, sheet_of

from labs.grading.calling.processes import Limits
from labs.grading.calling.remote import Grader
from labs.grading.diagnosis.deviations import Answer, Right
from labs.grading.diagnosis.findings import Counterexample, Diagnosis
from labs.grading.diagnosis.probes.probe import Draw, usual
from labs.grading.diagnosis.recognition import diagnose
from labs.grading.diagnosis.words import told
from labs.grading.feedback import report
from labs.grading.feedback.error_advice import Advice, advice
from labs.grading.feedback.faults import suspect
from labs.grading.judging import pytest_run
from labs.grading.judging.examples import Examples
from labs.grading.judging.score_sheet import Outcome, Sheet

CLOSING = """
import numpy as np

def normal_velocity(a, b, n):
    p, q = (body[0] + np.cross(body[1], body[2]) for body in (a, b))
    return np.sum((p - q) * n, axis=-1)
"""
TURNED = CLOSING.replace("p - q", "q - p")
IMPULSE = """
def impulse_magnitude(a, b, n, e):
    k = 0.0
    for _, _, r, share, turning in (a, b):
        turned = (turning @ np.cross(r, n)[..., None])[..., 0]
        k = k + share + np.sum(n * np.cross(turned, r), axis=-1)
    return np.where(k > 0, -(1 + np.asarray(e)) * normal_velocity(a, b, n) / np.where(k > 0, k, 1), 0)
"""


@pytest.fixture(scope="module")
def grader():
    with Grader(Limits(call=0.4, test=1.0)) as found:
        yield found


# Functions that others call


def test_a_function_is_not_blamed_for_a_wrong_one_that_it_calls(tmp_path, grader):
    text = checked(tmp_path, grader, TURNED + IMPULSE, "impulse_magnitude")
    assert "✗ impulse_magnitude 1 of 4 parts right It calls your normal_velocity, which is not right yet: mend" in text
    assert "✗ normal_velocity Not yet: one body flies" in text
    assert "The minus is missing" not in text  # of impulse_magnitude
    assert text.endswith("Next: normal_velocity, marked ✗ above.")


def test_a_suspect_that_is_slow_is_not_said_to_be_wrong():
    words = " ".join(suspect("collide", Diagnosis("collide", "too slow"), Advice()))
    assert "It passes these tests, and is too slow on other input all the same." in joined(words)
    assert "wrong" not in words


def test_a_function_that_was_tried_before_the_time_was_used_up_is_not_said_to_be_untried():
    words = joined(told(Diagnosis("collide", "not tried")))
    assert words == "collide: its mistake was not looked for: the time for the whole file was used up before."


def test_the_names_of_a_body_are_told_where_another_one_is_used():
    assert "angular_velocity, arm" in advice("raised AttributeError: 'Body' object has no attribute 'omega' (line 3)")


@pytest.mark.slow
def test_called_functions_are_listed_only_if_they_are_wrong(tmp_path, grader):
    driving = IMPULSE.replace("-(1 +", "(1 +")
    text = checked(tmp_path, grader, CLOSING + driving, "impulse_magnitude")
    assert "The minus is missing" in text
    assert "normal_velocity" not in text
    assert sheet_of(tmp_path, grader, CLOSING + IMPULSE, "impulse_magnitude").beneath == []


@pytest.mark.slow
def test_called_functions_cost_no_points(tmp_path, grader):
    wrong = TURNED + IMPULSE
    sheet = sheet_of(tmp_path, grader, wrong, "impulse_magnitude")
    assert {outcome.function for outcome in sheet.beneath} == {"normal_velocity"}
    assert sheet.points == sum(outcome.points for outcome in sheet.about("impulse_magnitude"))


@pytest.mark.slow
def test_the_function_that_hangs_is_named_not_its_caller(tmp_path, grader):
    endless = "import numpy as np, time\ndef normal_velocity(a, b, n):\n    while True: time.sleep(0.01)\n" + IMPULSE
    text = checked(tmp_path, grader, endless, "impulse_magnitude")
    assert "✗ impulse_magnitude It calls your normal_velocity, which gave no answer in time: mend that first." in text
    assert text.count("gave no answer within") == 1
    assert text.count("Does every loop in it come to an end") == 1


@pytest.mark.slow
def test_a_function_is_blamed_if_the_one_it_calls_fails_for_batches_only(tmp_path, grader):
    one = CLOSING.replace("np.sum((p - q) * n, axis=-1)", "sum((p[i] - q[i]) * n[i] for i in range(3))")
    text = checked(tmp_path, grader, one + IMPULSE.replace("-(1 +", "(1 +"), "impulse_magnitude")
    assert "Right for one case, not yet for several in one call." in text
    assert "It calls your normal_velocity" in text
    assert "The minus is missing" in text


# Hints


def test_a_missing_return_is_reported_once_without_a_hint(tmp_path, grader):
    text = checked(tmp_path, grader, "def normal_velocity(a, b, n):\n    a[0] + b[0]\n", "normal_velocity")
    assert text.count("gives nothing (None): is a return missing?") == 1
    assert "Hint" not in text


@pytest.mark.slow
def test_too_few_outputs_get_no_hint(tmp_path, grader):
    text = checked(tmp_path, grader, "def apply_impulse(a, b, j):\n    return a[0], b[0]\n", "apply_impulse")
    assert text.count("2 things instead of 4") == 1
    assert "Hint" not in text


def test_a_hint_is_given_if_a_number_is_wrong_in_an_unknown_way():
    outcome = Outcome("test_x", 1, False, said="f(1)\ngives   2\nphysics 3", help="Look.", function="collide")
    for verdict, hinted in (("unknown", True), ("shape", False), ("too slow", False), ("crashes", False)):
        sheet = Sheet(outcomes=[outcome], diagnoses={"collide": Diagnosis("collide", verdict)})
        assert ("Hint: Look." in joined("\n".join(report.report(sheet, ["impulse"])))) == hinted
    limits = Diagnosis("collide", "unknown", limits_alone=True)
    text = joined("\n".join(report.report(Sheet(outcomes=[outcome], diagnoses={"collide": limits}), ["impulse"])))
    assert "Right in the usual cases, not yet in limiting ones." in text
    assert "Hint" not in text


def test_an_error_on_other_input_is_shown_with_the_call_that_ends_in_it():
    right = Right((np.array(1.0),), (1.0,))
    example = Counterexample("collide", usual("", 2.0), ("speed",), Answer(error="ZeroDivisionError"), right)
    found = Diagnosis("collide", "crashes", counterexample=example, crashes=("ZeroDivisionError",), limits_alone=True)
    for said, shown in (("f(1)\ngives   2\nphysics 3", 1), ("raised ZeroDivisionError", 0)):
        outcome = Outcome("test_x", 1, False, said=said, function="collide")
        text = "\n".join(report.report(Sheet(outcomes=[outcome], diagnoses={"collide": found}), ["impulse"]))
        assert text.count("collide(speed=2)") == shown


def turned_back(inertia, orientation):
    """Rᵀ I⁻¹ R, with 1/0 for a rod."""
    w, x, y, z = np.moveaxis(np.asarray(orientation, float), -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    turn = np.moveaxis(np.array(rows), (0, 1), (-2, -1))
    with np.errstate(all="ignore"):
        return np.swapaxes(turn, -1, -2) @ ((1 / np.asarray(inertia, float))[..., None] * np.eye(3)) @ turn


def test_a_likely_mistake_and_what_else_is_wrong_have_own_examples():
    found = diagnose("world_inverse_inertia", lambda _, *given: turned_back(*given))
    assert found.verdict == "likely"
    assert found.counterexample.probe.note == "a third of a turn about the diagonal"
    assert found.odd.probe.note == "a thin rod: no inertia about its axis"
    text = told(found)
    assert text.index("It is Rᵀ I⁻¹ R") < text.index("This mistake alone does not explain:") < text.index("thin rod")


def test_nan_is_explained_and_the_mistake_shown_at_another_input():
    said = "world_inverse_inertia(inertia=(2, 2, 0))\ngives   nan\nphysics 0.5"
    outcome = Outcome("test_x", 1, False, said=said, function="world_inverse_inertia")
    diagnosis = diagnose("world_inverse_inertia", lambda _, *given: turned_back(*given))
    sheet = Sheet(outcomes=[outcome], diagnoses={"world_inverse_inertia": diagnosis})
    text = joined("\n".join(report.report(sheet, ["impulse"])))
    assert text.index("→ inf comes from a division by zero") < text.index("It is Rᵀ I⁻¹ R")
    assert "For example world_inverse_inertia(inertia=(1, 2, 4), orientation=(0.5, 0.5, 0.5, 0.5))" in text
    assert text.count("→ inf") == 1


# Errors


@pytest.mark.parametrize(
    ("given", "points_to"),
    [
        (lambda m: np.ones((2, 3, 3)) @ m.T, "np.swapaxes(R, -1, -2)"),
        (lambda m: m.T @ np.ones((2, 3, 3)), "np.swapaxes(matrix, -1, -2)"),
        (lambda m: list(np.float64(1.0)), "np.where"),
        (lambda m: len(np.float64(1.0)), "np.where"),
        (lambda m: np.array(1.0)[0], "np.where"),
        (lambda m: np.ones((2, 3))[2], "a[..., 0]"),
        (lambda m: max(m[0, 0, 0], m[0, 0]), "np.maximum"),
        (lambda m: m[0] @ np.ones((4, 3)), "(matrix @ a[..., None])[..., 0]"),
        (lambda m: 2.0 @ m, "a number times something is a * b"),
        (lambda m: np.where(np.ones(4) > 0, np.ones((4, 3)), m[0, 0]), "np.where(condition[..., None], b, c)"),
        (lambda m: np.where(np.ones(4) > 0, m[0, 0], m[0, 0]), "np.where(condition[..., None], b, c)"),
        (lambda m: np.ones(2) * np.ones((2, 1, 3)), "number[..., None] * vector"),
        (lambda m: np.sum(m[0, 0], axis=1), "axis=-1 is the last axis"),
        (lambda m: np.einsum("ij,ij->i", m[0, 0], m[0, 0]), "'...i,...i->...'"),
        (lambda m: np.array([m, m[0]]), "np.broadcast_arrays"),
        (lambda m: m ^ 2, "A power is a ** b"),
        (lambda m: 1.5 ^ 2, "A power is a ** b"),
    ],
)
def test_messages_of_numpy_get_advice_on_what_to_do(given, points_to):
    with pytest.raises((ValueError, TypeError, IndexError)) as caught:
        given(np.ones((2, 3, 3)))
    assert points_to in advice(f"raised {type(caught.value).__name__}: {caught.value}")


@pytest.mark.parametrize(
    ("came", "points_to"),
    [
        ("(0, 0, 1) of shape (3,) instead of (2,)", "A sum over the wrong axis"),
        ("1 of shape () instead of (2,)", "A sum over the wrong axis"),
        ("((1, 2), (3, 4)) of shape (2, 2) instead of (2,)", "the dot product of each pair"),
        ("complex numbers instead of real ones", "is complex in"),
    ],
)
def test_an_answer_of_another_kind_gets_advice_on_its_cause(came, points_to):
    assert points_to in advice(f"f(1)\ngives   {came}\nphysics (1, 2)")
    assert "wrong axis" not in advice("f(1)\ngives   (1) of shape (1,) instead of ()\nphysics 1")


@pytest.mark.parametrize("answer", ["np.sqrt(np.asarray(u) + 0j)", "(-1.0) ** 0.5", "np.complex64(u)"])
def test_complex_numbers_are_called_so(tmp_path, grader, answer):
    text = checked(
        tmp_path,
        grader,
        f"import numpy as np\ndef impulse_magnitude(a, b, n, u): return {answer}\n",
        "impulse_magnitude",
    )
    assert "complex numbers instead of real ones" in text or "an object of type " in text
    assert text.count("is complex in (-1) ** 0.5") == 1
    assert "one array instead of" not in text


def test_a_package_that_is_not_there_is_named_with_those_that_are(tmp_path, grader):
    text = "import scipy.linalg\ndef edge_edge_normal(e, f, a, b): return scipy.linalg.norm(a - b)\n"
    found = checked(tmp_path, grader, text, "edge_edge_normal")
    assert "NumPy and Python's standard library: no other package, such as SciPy" in found


@pytest.mark.slow
def test_results_in_another_order_are_labelled_and_called_so(tmp_path, grader):
    text = (
        "import numpy as np\ndef apply_impulse(a, b, j):\n"
        "    turned = [body[4] @ np.cross(body[2], j) for body in (a, b)]\n"
        "    return a[0] + a[3] * j, b[0] - b[3] * j, a[1] + turned[0], b[1] - turned[1]\n"
    )
    found = checked(tmp_path, grader, text, "apply_impulse")
    assert "physics v_A=(0, 0, 1), ω_A=(0, 0, 0), v_B=(0, 0, -3), ω_B=(0, 0, 0)" in found
    assert "it returns v_A, v_B, ω_A, ω_B, and should return v_A, ω_A, v_B, ω_B" in found
    assert "plus for both" not in found


def test_advice_is_given_once():
    words = Advice()
    assert words.new("gave no answer within 5 s") != ""
    assert words.new("gave no answer within 5 s") == ""
    assert words.known("gave no answer within 5 s")


def in_notebook(tmp_path, grader, *sources):
    cell = {"cell_type": "code", "metadata": {}, "outputs": [], "execution_count": None}
    cells = [cell | {"source": source} for source in sources]
    (tmp_path / "lab.ipynb").write_text(
        json.dumps({"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": cells})
    )
    sheet = pytest_run.run(tmp_path / "lab.ipynb", ("impulse",), (pytest_run.VISIBLE,), grader, ("edge_edge_normal",))
    return joined("\n".join(report.report(sheet, ("impulse",))))


@pytest.mark.parametrize("name", ["np", "vector", "checked"])
def test_a_name_of_a_given_cell_is_said_to_need_that_cell_run(name, tmp_path, grader):
    text = in_notebook(tmp_path, grader, f"def edge_edge_normal(e, f, a, b):\n    return {name}.cross(e, f)")
    assert f"→ {name} comes from a cell of the lab that was not run, or is gone: Run ▸ Run All Above." in text
    assert "import" not in text


def test_a_misspelt_name_gets_the_suggestion_of_python(tmp_path, grader):
    text = in_notebook(tmp_path, grader, CLOSING, "def edge_edge_normal(*given):\n    return normal_velocty(*given)")
    assert "name 'normal_velocty' is not defined. Did you mean: 'normal_velocity'?" in text
    assert "Did you mean: 'cross'?" in in_notebook(
        tmp_path, grader, "import numpy as np", "def edge_edge_normal(e, f, a, b):\n    return np.croos(e, f)"
    )
    assert "Did you mean" not in in_notebook(tmp_path, grader, "def edge_edge_normal(e, f, a, b):\n    return qqqqqq")


def test_a_variable_from_another_cell_is_named_but_no_constant(tmp_path, grader):
    others = "import numpy as np\nspin = np.ones(3)\nHALF = 0.5"
    text = in_notebook(
        tmp_path, grader, others, "two = 2\ndef edge_edge_normal(e, f, a, b):\n    return e + HALF * two * spin"
    )
    assert "It takes spin from code cell 1, not from its arguments: is that meant?" in text
    assert text.count("It takes") == 1


# Examples


def test_the_smallest_example_is_shown_once_and_without_rounding():
    def holds(vector):
        raise AssertionError(f"f(vector=({', '.join(f'{x:g}' for x in vector)}))\ngives   nothing")

    with pytest.raises(AssertionError) as caught:
        Examples(1).every(lambda draw: (draw.unit() + 1e-15,), holds)
    assert str(caught.value).count("vector=") == 1
    assert "e-1" not in str(caught.value)


def test_a_drawn_inertia_has_few_digits_and_is_symmetric():
    draw = Draw(np.random.default_rng(3))
    for _ in range(50):
        matrix = draw.inverse_inertia()
        assert np.array_equal(matrix, matrix.T)
        assert np.allclose(matrix, matrix.round(3), atol=1e-12)
        assert np.linalg.eigvalsh(matrix)[0] > 0.4


def test_an_example_made_by_hand_comes_before_a_drawn_one():
    def rod_alone(inertia, orientation):
        """Wrong where all moments differ, at drawn inputs as well as at those made by hand."""
        inertia = np.asarray(inertia, float)
        return np.full((*inertia.shape, 3), np.nan) if np.ndim(inertia) > 1 else np.full((3, 3), inertia.sum())

    found = diagnose("world_inverse_inertia", lambda _, *given: rod_alone(*given))
    assert found.counterexample.probe.note == "along the axes"
