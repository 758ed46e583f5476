"""Injected faults: the engine runs another world, and nobody but the numbers can tell."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.catalogue.scenarios import find
from reference.comparison.faults import FAULTS, run_with_fault
from reference.comparison.verdicts import Verdict
from reference.engines import load_engine
from reference.engines.base import EXACT, Method
from reference.report.sensitivity import Subject
from reference.scene.forces import Attraction, Fluid, Force, OscillatingForce, Spring
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere
from reference.scene.settings import Settings

HAND = load_engine("handwritten")
FAULT = {fault.name: fault for fault in FAULTS}
BALL = Body("ball", Sphere(0.1), mass=2.0, position=(0.0, 0.0, 1.0))
PAIR = Pair("ball", "floor", restitution=0.5, kinetic_friction=0.2, static_friction=0.3)
SCENE = Scenario("a ball", (Body("floor", HalfSpace()), BALL), (PAIR,), 1.0)
SETTINGS = Settings(1e-3)


def spoiled(name, size, scene=SCENE):
    return FAULT[name].world(scene, SETTINGS, size)


def coefficients(scene):
    pair = scene.pairs[0]
    return pair.restitution, pair.kinetic_friction, pair.static_friction


def test_each_fault_changes_its_own_quantity_and_nothing_else():
    assert coefficients(spoiled("restitution", 0.1)[0]) == pytest.approx((0.55, 0.2, 0.3))
    assert coefficients(spoiled("friction", 0.1)[0]) == pytest.approx((0.5, 0.22, 0.33))
    assert coefficients(spoiled("static", 0.0)[0]) == (0.5, 0.3, 0.3)
    assert spoiled("gravity", 0.1)[0].gravity == pytest.approx((0.0, 0.0, -1.1 * 9.81))
    assert spoiled("timestep", 0.1) == (SCENE, Settings(1.1e-3))
    heavier, turning = (spoiled(name, 0.1)[0].body("ball") for name in ("mass", "inertia"))
    assert (heavier.mass, heavier.moments_of_inertia()) == (2.2, BALL.moments_of_inertia())
    assert turning.mass == 2.0
    assert turning.moments_of_inertia() == pytest.approx(np.multiply(1.1, BALL.moments_of_inertia()))


def test_a_normal_or_else_the_box_that_is_struck_is_turned_by_the_angle():
    turned = spoiled("normal", 1.0)[0].body("floor").shape.normal
    assert turned == pytest.approx((np.sin(np.radians(1.0)), 0.0, np.cos(np.radians(1.0))))
    wall = Body("floor", Box((0.1, 0.1, 0.1)))
    orientation = spoiled("normal", 1.0, replace(SCENE, bodies=(wall, BALL)))[0].body("floor").orientation
    assert orientation == pytest.approx((np.cos(np.radians(0.5)), 0.0, np.sin(np.radians(0.5)), 0.0))
    other = replace(BALL, name="floor", position=(0.0, 0.0, 0.0))
    assert not FAULT["normal"].named(replace(SCENE, bodies=(other, BALL)), Method("at step"))


def test_faults_are_named_where_a_scenario_has_the_quantity():
    bare = replace(SCENE, pairs=(Pair("ball", "floor"),), gravity=(0.0, 0.0, 0.0))
    named = {fault.name for fault in FAULTS if fault.named(bare, Method(EXACT))}
    of_pairs_and_time = {"restitution", "friction", "static", "gravity", "timestep"}
    of_forces = {"stiffness", "damping", "drive", "viscosity", "density", "attraction"}
    assert {name for name in FAULT if name not in named} == of_pairs_and_time | of_forces | {"vertex", "quaternion"}


def test_faults_of_forces_change_their_own_number_alone():
    moon = Body("moon", Sphere(0.1), mass=1.0, position=(3.0, 0.0, 0.0))
    scene = Scenario(
        "forces",
        (BALL, moon),
        (),
        1.0,
        forces=(Force("ball", (1.0, 2.0, 3.0)), OscillatingForce("moon", (1.0, 0.0, 2.0), 5.0)),
        springs=(Spring("ball", "moon", 10.0, 1.0, 2.0),),
        attractions=(Attraction("ball", "moon", 4.0),),
        fluid=Fluid(3.0, 5.0),
    )
    (spring,) = scene.springs
    changed = {name: spoiled(name, 0.1, scene)[0] for name in FAULT if FAULT[name].named(scene, Method("at step"))}
    assert changed["stiffness"] == replace(scene, springs=(replace(spring, stiffness=11.0),))
    assert changed["damping"] == replace(scene, springs=(replace(spring, damping=2.2),))
    assert changed["viscosity"].fluid == Fluid(3.0, 5.5)
    assert changed["density"].fluid == Fluid(3.3000000000000003, 5.0)
    assert changed["attraction"].attractions == (Attraction("ball", "moon", 4.4),)
    steady, swinging = changed["drive"].forces
    assert steady == scene.forces[0]
    assert swinging.amplitude == pytest.approx((1.1, 0.0, 2.2))


def test_a_faulted_run_passes_for_one_of_the_true_world():
    scenario = find("dropped-ball/e=0.5")[1].scenarios[0]
    settings = HAND.settings(scenario, "step")
    true = HAND.run(scenario, settings)
    for name in ("gravity", "timestep", "normal"):
        found = run_with_fault(HAND, FAULT[name], 0.01, [scenario], settings)[0]
        assert (found.scenario, found.settings) == (scenario, settings)
        assert np.max(np.abs(found.positions[:500] - true.positions[:500])) > 1e-5
    longer = run_with_fault(HAND, FAULT["timestep"], 0.01, [scenario], settings)[0]
    assert longer.times[100] == pytest.approx(1.01 * true.times[100])
    assert longer.times[-1] == pytest.approx(true.times[-1], abs=2e-3)


def test_a_sample_early_moves_states_and_instants_to_the_time_before():
    scenario = find("ball-to-rest/e=0.5")[1].scenarios[0]
    settings = HAND.settings(scenario, "slide")
    true, early = HAND.run(scenario, settings), run_with_fault(HAND, FAULT["sample"], 0, [scenario], settings)[0]
    assert np.array_equal(early.positions, true.positions[1:])
    assert np.array_equal(early.times, true.times[:-1])
    assert early.events[-1].time == pytest.approx(true.events[-1].time - 1e-3)


@pytest.mark.parametrize(
    ("engine", "profile"),
    [
        ("handwritten", "world"),
        *(pytest.param(name, "tuned", marks=pytest.mark.slow) for name in ("pybullet", "mujoco", "dart")),
    ],
)
def test_what_is_told_of_a_contact_and_of_a_turn_is_judged(engine, profile, installed):
    """Of two unequal boxes that meet edge on edge, turned so that no normal, edge or axis of theirs is one of ours."""
    family = find("crossed-edges")[0]
    told = Subject(family, family.cases[0], installed(engine), profile)
    red = {name: told.red(told.with_fault(FAULT[name], 0.0)) for name in ("quaternion", "bodies", "overlap")}
    assert red == {"quaternion": ["askew", "beside"], "bodies": ["askew", "beside"], "overlap": ["beside"]}
    assert told.names(FAULT["bodies"])
    assert {row.verdict for row in told.rows} == {Verdict.PASS}
    told.family = find("two-balls")[0]
    assert not told.names(FAULT["bodies"]), "no number there is read from contacts"
