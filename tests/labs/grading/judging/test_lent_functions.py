"""A mistake costs points in its own function alone: those that call it are tested with the lab's function as well."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from submissions import solved

from labs.grading.judging import lent_functions
from labs.grading.judging.grade import Grade
from labs.grading.judging.lent_functions import LostTest, lend
from labs.grading.judging.pytest_run import run
from labs.grading.judging.score_sheet import Outcome, Part, Sheet
from labs.grading.submission.reading import Submission

WRONG = {
    "impulse": ("inverse_effective_mass", "return 3 * right_inverse_effective_mass(*given)"),
    "friction": ("clamp_to_circle", "return np.asarray(right_clamp_to_circle(*given))[..., :2]"),
    "world": ("candidate_pairs", "return [pair for pair in right_candidate_pairs(*given)] or np.array([])"),
    "response": ("kinematic_response", "raise KeyError('restitution')"),
    "sweeping": ("ray_sphere", "return -right_ray_sphere(*given)"),
    "forces": ("stokes_drag", "return None"),
    "polyhedra": ("face_planes", "return right_face_planes(*given)[::-1]"),
}
"""By lab: a function, and what a wrong version of it does."""


def with_mistake(folder, topic):
    """The solutions of a lab with one mistake."""
    name, does = WRONG[topic]
    path = solved(folder, topic)
    text = f"\n\nright_{name} = {name}\n\n\ndef {name}(*given):\n    {does}\n"
    path.write_text(path.read_text(encoding="utf-8") + text, encoding="utf-8")
    return path, name


def lost_points(sheet):
    return {each.function: each.points - each.earned for each in sheet.outcomes if each.earned < each.points}


@pytest.mark.usefixtures("one_grader")
def test_callers_of_a_wrong_function_lose_nothing_and_hear_whose_mistake_it_is(tmp_path):
    path, name = with_mistake(tmp_path, "impulse")
    sheet = run(path, ("impulse",), functions=(name, "impulse_magnitude"))
    assert lost_points(sheet).keys() == {name}
    found = {each["name"]: each for each in Grade(("impulse",), sheet).content()["functions"]}
    assert found["impulse_magnitude"]["verdict"] == "right"
    assert found["impulse_magnitude"]["message"].startswith(f"impulse_magnitude calls your {name}, and that one is not")


@pytest.mark.slow
@pytest.mark.usefixtures("one_grader")
@pytest.mark.parametrize("topic", WRONG)
def test_one_mistake_costs_points_in_one_function_alone(topic, tmp_path):
    path, name = with_mistake(tmp_path, topic)
    assert lost_points(run(path, (topic,))).keys() == {name}


BACKWARDS = """
import numpy as np


def ray_sphere(origin, direction, radius):
    return sweep_sphere_sphere(origin, direction, radius, 0 * origin, 0 * direction, 0.0, np.inf)


def sweep_sphere_sphere(xa, va, ra, xb, vb, rb, dt):
    time = ray_sphere(xa - xb, va - vb, ra + rb)
    return np.where(time <= dt, time, np.inf)
"""
"""Each of the two is right if the other one is."""


@pytest.mark.usefixtures("one_grader")
@pytest.mark.slow
def test_a_function_that_is_found_from_a_later_one_earns_nothing(tmp_path):
    path = tmp_path / "lab.py"
    path.write_text(BACKWARDS, encoding="utf-8")
    sheet = run(path, ("sweeping",), functions=("ray_sphere", "sweep_sphere_sphere"))
    earned = {name: sum(each.earned for each in sheet.about(name)) for name in ("ray_sphere", "sweep_sphere_sphere")}
    assert earned["ray_sphere"] == 0
    assert earned["sweep_sphere_sphere"] > 0


TELLS = """

def normal_velocity(body_a, body_b, normal):
    return 7.0 + right_normal_velocity(body_a, body_b, normal)


def impulse_magnitude(body_a, body_b, normal, restitution):
    found = "the text that was lent" if "_lent" in globals() else "nothing"
    {tells}
"""
WAYS = {
    "in an exception": "raise ValueError(found)",
    "as its answer": "return found",
    "by printing": "print(found)",
    "in an exception for several cases": "if np.ndim(normal) > 1:\n        raise ValueError(found)\n"
    "    return right_impulse_magnitude(body_a, body_b, normal, restitution)",
    "by ending": "raise SystemExit(found)",
}


@pytest.mark.usefixtures("one_grader")
@pytest.mark.slow
@pytest.mark.parametrize("way", WAYS)
def test_a_submission_cannot_tell_what_was_lent_to_it(way, tmp_path):
    path = solved(tmp_path, "impulse")
    names = "".join(f"\n\nright_{name} = {name}" for name in ("normal_velocity", "impulse_magnitude"))
    path.write_text(path.read_text(encoding="utf-8") + names + TELLS.format(tells=WAYS[way]), encoding="utf-8")
    sheet = run(path, ("impulse",), functions=("normal_velocity", "impulse_magnitude"))
    said = f"{Grade(('impulse',), sheet).content()} {sheet}"
    assert "the text that was lent" not in said


# Which functions are lent, and what is given back


def outcome(function, *said, others=()):
    parts = tuple(Part(1, f"part {at}", words, others) for at, words in enumerate(said))
    return Outcome("test", len(said), not any(said), parts=parts, function=function)


USES = {
    "collide": {"apply_impulse", "impulse_magnitude"},
    "impulse_magnitude": {"normal_velocity"},
    "normal_velocity": {"collide"},
}


@pytest.fixture
def asked(monkeypatch):
    """Has each test pass in all parts once any function is lent; notes what was lent to which function."""
    lent = []
    monkeypatch.setattr(lent_functions, "_with_lent", lambda submission, topic, names: names)
    monkeypatch.setattr(lent_functions, "_again", lambda test, names, *_: lent.append(names) or test.again(None))
    return lent


def lend_to(sheet, *passing):
    """Lend for all outcomes that are lost; passing: what each test says of its parts when it runs again."""
    lost = [place for place, each in enumerate(sheet.outcomes) if not each.passed]
    tests = [LostTest(place, lambda _, said=said: list(said)) for place, said in zip(lost, passing, strict=True)]
    uses = SimpleNamespace(reached=lambda name: USES.get(name, set()))
    lend(sheet, tests, uses, SimpleNamespace(budget=SimpleNamespace(left=9.0)))


def test_only_wrong_functions_that_come_before_are_lent(asked):
    sheet = Sheet(outcomes=[outcome(name, "gives 1") for name in ("normal_velocity", "impulse_magnitude", "collide")])
    sheet.suspects["apply_impulse"] = None
    lend_to(sheet, *[[Part(1, "part 0")]] * 3)
    assert asked == [("normal_velocity",), ("apply_impulse",)]  # by then, impulse_magnitude is right
    assert lost_points(sheet) == {"normal_velocity": 1}
    assert (sheet.lent("impulse_magnitude"), sheet.lent("collide")) == (["normal_velocity"], ["apply_impulse"])


def test_functions_that_a_scenario_calls_are_lent_as_well(asked):
    lost = outcome("audit", "gives 1", others=("edge_edge_normal", "impulse_magnitude"))
    sheet = Sheet(outcomes=[outcome("edge_edge_normal", "gives 1"), outcome("normal_velocity", "gives 1"), lost])
    lend_to(sheet, [], [], [Part(1, "part 0")])
    assert {*asked[-1]} == {"edge_edge_normal", "normal_velocity"}  # which impulse_magnitude calls
    assert lost_points(sheet) == {"edge_edge_normal": 1, "normal_velocity": 1}


def test_a_part_that_fails_again_keeps_its_words_and_one_that_passed_stays(asked):
    sheet = Sheet(outcomes=[outcome("normal_velocity", "a"), outcome("impulse_magnitude", None, "b", "c")])
    again = [Part(1, "part 0", "worse"), Part(1, "part 1"), Part(1, "part 2", "other numbers")]
    lend_to(sheet, [Part(1, "part 0", "a")], again)
    assert [part.said for part in sheet.outcomes[1].parts] == [None, None, "c"]
    assert sheet.outcomes[1].earned == 2
    assert not sheet.outcomes[1].passed


@pytest.mark.parametrize("found", [[], [Part(1, "part 0")]])
def test_a_test_that_breaks_off_gives_back_what_it_reached(found, asked):
    sheet = Sheet(outcomes=[outcome("normal_velocity", "a"), outcome("impulse_magnitude", "b", "c")])
    lend_to(sheet, [], found)
    assert sheet.outcomes[1].earned == len(found)


HELPERS = """
def _unit(n):
    return "of mine"


def _softness(body, n):
    return "of mine"


def inverse_effective_mass(body_a, body_b, normal):
    return _unit(normal)
"""


@pytest.mark.parametrize("name", ["inverse_effective_mass", "normal_velocity", "apply_impulse"])
def test_lent_functions_work_and_take_no_name_of_the_students(name):
    text = lent_functions._with_lent(Submission("lab.py", HELPERS), "impulse", (name,)).text
    space = {"__name__": "submission"}
    exec(text, space)
    body = (np.array([0, 0, -2.0]), np.zeros(3), np.zeros(3), 1.0, np.eye(3))
    assert np.all(np.isfinite(np.concatenate(np.atleast_2d(space[name](body, body, np.array([0, 0, 1.0]))))))
    assert (space["_unit"](1), space["_softness"](1, 2)) == ("of mine", "of mine")
