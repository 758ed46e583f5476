"""The recurrence of a contact, step by step, against the engines: off-centre, turned, with unequal masses."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.tunnelling import SHOTS
from reference.comparison.compare import Number, judged, measured
from reference.comparison.verdicts import Verdict
from reference.engines import load_engine
from reference.engines.base import AT_STEP, Method
from reference.prediction import both, impulses, striking
from reference.prediction.impulses import least_in_cone
from reference.scene import geometry
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere

TURN = np.array([0.4, -0.2, 0.8, 0.4])  # a unit quaternion: 0.16 + 0.04 + 0.64 + 0.16 = 1
BY_HAND = ("handwritten", "step"), ("handwritten", "world")
ENGINES = ("pybullet", "tuned"), ("mujoco", "tuned"), ("mujoco", "spring"), ("dart", "tuned"), ("dart", "stock")
EVERY = [(name, *each) for name in ("box", "plane") for each in (*BY_HAND, *ENGINES)]
EVERY = [each for each in EVERY if each[1:] != ("dart", "stock")]
EVERY = [("smooth " * (each[0] == "box" and each[1] in ("pybullet", "mujoco")) + each[0], *each[1:]) for each in EVERY]
"""Scene, engine and profile. The friction of DART's stock solver is limited along two axes of its own. Off the centre
of a box, with friction, MuJoCo refuses to run and PyBullet follows another rule."""


def turned(vector) -> tuple[float, ...]:
    return tuple(geometry.rotate(TURN, np.array(vector, dtype=float)).tolist())


def scene(name: str, other: Body, ball: Body, restitution: float, friction: float, gravity) -> Scenario:
    """A ball and what it strikes, both turned."""
    bodies = []
    for body in (other, ball):
        shape = HalfSpace(turned(body.shape.normal)) if isinstance(body.shape, HalfSpace) else body.shape
        vectors = {each: turned(getattr(body, each)) for each in ("position", "velocity", "angular_velocity")}
        orientation = (1.0, 0.0, 0.0, 0.0) if isinstance(shape, HalfSpace) else tuple(TURN)
        bodies.append(replace(body, shape=shape, orientation=orientation, **vectors))
    pair = Pair(other.name, ball.name, restitution, friction)
    return Scenario(name, tuple(bodies), (pair,), 0.13, turned(gravity))


def on_a_box() -> Scenario:
    ball = Body("ball", Sphere(0.05), 0.7, (0.04, 0, 0.33034), velocity=(0, 0, -2), angular_velocity=(0, 30, 0))
    return scene("box", Body("box", Box((0.1, 0.06, 0.08)), 1.9), ball, 0.6, 0.2, (0, 0, -2))


def on_a_ball() -> Scenario:
    ball = Body("ball", Sphere(0.1), 0.4, (-0.35034, 0.05, 0), velocity=(2, 0, 0), angular_velocity=(0, 0, 20))
    return scene("ball", Body("target", Sphere(0.07), 1.7), ball, 0.7, 0.0, (0, 0, 0))


def on_a_plane() -> Scenario:
    ball = Body("ball", Sphere(0.05), 0.7, (0, 0, 0.25034), velocity=(0.4, 0, -2), angular_velocity=(0, 30, 0))
    return scene("plane", Body("plane", HalfSpace()), ball, 0.6, 0.2, (1.5, 0, -9.81))  # weight acts along it as well


SCENES = {each.name: each for each in (on_a_box(), on_a_ball(), on_a_plane())}
SCENES["smooth box"] = replace(on_a_box(), pairs=(Pair("box", "ball", 0.6),))


def farthest_off(name: str, engine: str, profile: str, installed) -> float:
    """The largest difference of any velocity, spin or pose at the end from the predicted one, in bands."""
    scenario, found = SCENES[name], installed(engine)
    settings = found.settings(scenario, profile)
    prediction = striking.predict(scenario, settings, found.method(scenario, settings))
    assert prediction is not None
    ran = found.run(scenario, settings)
    assert np.max(np.abs(ran.velocities[-1] - ran.velocities[0])) > 0.5  # there was an impact
    pairs = ((ran.velocities, prediction.trajectory.velocities), (ran.positions, prediction.trajectory.positions))
    spins = ran.angular_velocities, prediction.trajectory.angular_velocities
    same = np.sign(np.sum(ran.orientations * prediction.trajectory.orientations, axis=-1, keepdims=True))
    turns = ran.orientations, same * prediction.trajectory.orientations  # q and −q are one orientation
    compared = (*pairs, spins, turns)
    return max(float(np.max(np.abs(one[-1] - other[-1]))) for one, other in compared) / (30 * prediction.near)


@pytest.mark.parametrize(("name", "engine", "profile"), EVERY)
def test_an_engine_does_what_is_predicted_of_it_step_by_step(name, engine, profile, installed):
    # DART's softness, 10⁻⁵, belongs to two tangents of its own: a box, which gives differently along and across, shows
    # that. 2100 bands are 9·10⁻⁶.
    assert farthest_off(name, engine, profile, installed) < (2100 if (engine, name) == ("dart", "box") else 1)


def without_weight(self, weight, others):
    return met(self, 0 * weight, others)


met = both.Both.met
MUTATIONS = {
    "friction with the slip": (impulses, "held", lambda *args: (-held(*args)[0], held(*args)[1])),
    "another arm": (striking, "points_of", lambda settings, method: both.DEEPEST),
    "flights half a step apart": (striking.Striking, "in_parabolas", property(lambda self: True, lambda *_: None)),
    "an impact without its weight": (both.Both, "met", without_weight),
}
held = impulses.held
NOTICED = [
    ("friction with the slip", "plane", "pybullet", "tuned"),
    ("friction with the slip", "box", "dart", "tuned"),
    ("another arm", "plane", "mujoco", "tuned"),
    ("another arm", "plane", "mujoco", "spring"),
    ("another arm", "plane", "dart", "tuned"),
    ("flights half a step apart", "plane", "pybullet", "tuned"),
    ("an impact without its weight", "plane", "dart", "tuned"),
]


@pytest.mark.parametrize(("mutation", "name", "engine", "profile"), NOTICED)
def test_a_mutated_recurrence_no_longer_agrees(mutation, name, engine, profile, installed, monkeypatch):
    monkeypatch.setattr(*MUTATIONS[mutation], raising=False)
    assert farthest_off(name, engine, profile, installed) > 1000


def test_two_contacts_of_one_step_are_solved_together(installed):
    """MuJoCo's least friction at either wall is little, but it brakes the ball along the other one's normal."""
    engine, scenario = installed("mujoco"), catalogue()["corner"].case("e=0.5,later=0.0005").scenarios[0]
    settings = engine.settings(scenario, "spring")
    prediction = striking.predict(scenario, settings, engine.method(scenario, settings))
    assert prediction is not None
    found = engine.run(scenario, settings).velocities[-1]
    np.testing.assert_allclose(found, prediction.trajectory.velocities[-1], atol=1e-9)


def test_a_pyramid_is_predicted_where_the_slip_is_along_its_base_alone(installed):
    engine, scenario = installed("dart"), catalogue()["struck-cube"].case("x=0.08,ω=-20,μ=0.1").scenarios[0]
    settings = engine.settings(scenario, "stock")
    prediction = striking.predict(scenario, settings, engine.method(scenario, settings))
    assert prediction is not None
    found = engine.run(scenario, settings).angular_velocities[-1]
    np.testing.assert_allclose(found, prediction.trajectory.angular_velocities[-1], atol=1e-11)
    askew = SCENES["plane"]
    assert striking.predict(askew, settings, engine.method(askew, settings)) is None


def test_no_prediction_is_made_of_a_contact_that_leaves_its_plane():
    box, ball = SCENES["box"].bodies
    aside = replace(ball, position=tuple(np.add(ball.position, turned((0, 0.02, 0)))))
    engine, scenario = load_engine("handwritten"), replace(SCENES["box"], bodies=(box, aside))
    settings = engine.settings(SCENES["box"], "step")
    assert striking.predict(scenario, settings, engine.method(SCENES["box"], settings)) is None


@pytest.mark.parametrize("pull", [(-3.0, -1.0), (0.3, -1.0), (0.05, -1.0), (-0.2, -1.0), (0.5, 1.0)])
def test_the_force_in_the_cone_is_the_one_with_the_least_cost(pull):
    h_tt, h_tn, h_nn, friction = 3.5, -0.8, 1.3, 0.3
    along, pressed = least_in_cone(h_tt, h_tn, h_nn, *pull, friction)

    def cost(f_t, f_n):
        return (h_tt * f_t**2 + 2 * h_tn * f_t * f_n + h_nn * f_n**2) / 2 + pull[0] * f_t + pull[1] * f_n

    assert abs(along) <= friction * pressed
    f_n, share = np.meshgrid(np.linspace(0, 2, 401), np.linspace(-1, 1, 201))
    assert cost(along, pressed) <= np.min(cost(friction * share * f_n, f_n)) + 1e-15


# Verdicts, from numbers that are predicted or made up, without any engine


def verdicts_of(family_name: str, case_name: str, engine: str, profile: str, change=None) -> dict[str, Verdict]:
    """The verdicts on what is predicted of an implementation; `change` makes other numbers of the predicted ones."""
    family, found = catalogue()[family_name], load_engine(engine)
    case = family.case(case_name)
    settings = found.settings(case.scenarios[0], profile)
    method = found.method(case.scenarios[0], settings)
    trajectories = [striking.predict(each, settings, method).trajectory for each in case.scenarios]
    numbers = {quantity.name: measured(quantity, trajectories) for quantity in family.quantities}
    numbers = {name: change(name, number) for name, number in numbers.items()} if change else numbers
    rows = judged(family, case, engine, profile, settings, method, numbers)
    return {row.quantity: row.verdict for row in rows}


def test_a_ball_that_stays_at_a_wall_disagrees_with_theory():
    found = verdicts_of("two-walls", "e=0.5", "dart", "tuned")
    assert found == {"speed_left": Verdict.DISAGREES, "last_impact": Verdict.PASS}


def test_a_share_of_balls_that_pass_a_wall_disagrees_with_theory():
    family, found = catalogue()["thin-wall"], load_engine("pybullet")
    case = family.case("v=20")
    settings = found.settings(case.scenarios[0], "stock")
    for passed, verdict in ((0, Verdict.PASS), (37, Verdict.DISAGREES)):  # 70 % is the share of a method at the step
        method = Method(AT_STEP) if passed else found.method(case.scenarios[0], settings)
        ended = Number((1.0,) * passed + (0.0,) * (SHOTS - passed))
        kept = Number((1.0,) * passed + (-0.5,) * (SHOTS - passed))
        numbers = {"passed": ended, "velocity_kept": kept}
        rows = judged(family, case, "pybullet", "stock", settings, method, numbers)
        assert {row.verdict for row in rows} == {verdict}


@pytest.mark.parametrize("fault", [1e-3, 1e-6])
def test_a_heavy_target_is_judged_by_its_own_small_speed(fault):
    def faster(name: str, number: Number) -> Number:
        return Number(tuple(value * (1 + fault) for value in number.values)) if name == "target" else number

    found = verdicts_of("two-balls", "e=1,m=1e+06,b=0.5", "pybullet", "tuned", faster)
    assert found.pop("target") is Verdict.FAIL
    assert Verdict.FAIL not in found.values()
