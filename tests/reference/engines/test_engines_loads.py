"""Springs, attractions, fluids and changing pushes: what they do in every engine, and what a scenario refuses."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from engine_grid import ENGINES

from reference.errors import InvalidInput
from reference.prediction import loaded
from reference.scene import geometry
from reference.scene.forces import Attraction, Fluid, GrowingForce, OscillatingForce, Spring
from reference.scene.scenario import Body, Box, HalfSpace, Scenario, Sphere

TURNED = (math.sqrt(0.5), 0.0, 0.5, 0.5)
HEAVY = Body("heavy", Sphere(0.2), 3.0, (0.4, -0.2, 1.0), velocity=(0.3, -0.5, 0.2), angular_velocity=(2.0, 1.0, -3.0))
LIGHT = Body("light", Sphere(0.1), 0.5, (-0.7, 0.5, 1.6), TURNED, velocity=(-1.0, 0.4, 0.0))
PUSHED = Scenario(
    "loads",
    (HEAVY, Body("post", Box((0.1, 0.1, 0.1)), position=(0.0, 0.0, 3.0)), LIGHT),
    (),
    0.3,
    forces=(GrowingForce("light", (1.0, 2.0, -0.5)), OscillatingForce("heavy", (0.0, 4.0, 1.0), 20.0, 0.7)),
    springs=(
        Spring("heavy", "light", 40.0, 0.9, 0.6, (0.1, 0.05, -0.1), (0.0, 0.08, 0.02)),
        Spring("light", "", 15.0, 0.3, 0.2, (0.05, 0.0, 0.0), (0.2, 0.9, 1.1)),
        Spring("post", "heavy", 25.0, 1.2, 0.0, (0.1, 0.0, -0.1), (0.0, 0.0, 0.2)),
    ),
    attractions=(Attraction("light", "heavy", 1.3),),
    fluid=Fluid(2.0, 0.4, (0.5, 0.0, -1.0)),
)
"""Two unequal balls under everything at once, each point off its centre and each body turned or spinning."""


each_engine = pytest.mark.parametrize("name", [name for name in ENGINES if "/" not in name])
"""Not the toy engine, which knows one ball and one plane."""


@pytest.mark.parametrize(
    ("name", "profile"),
    [("handwritten", "world"), *itertools.product(("pybullet", "mujoco", "dart"), ("tuned", "stock"))],
)
def test_every_force_at_once_moves_two_balls_as_the_recurrence_says(name, profile, installed):
    engine = installed(name)
    settings = replace(engine.settings(PUSHED, profile), timestep=1e-3)
    run = engine.run(PUSHED, settings)
    expected = loaded.predict(PUSHED, settings, engine.method(PUSHED, settings)).trajectory
    np.testing.assert_allclose(run.positions, expected.positions, atol=1e-9)
    np.testing.assert_allclose(run.velocities, expected.velocities, atol=1e-8)
    # Spins too, but engines that turn a ball by a quotient of quaternions have its orientation to second order.
    np.testing.assert_allclose(run.angular_velocities, expected.angular_velocities, atol=1e-6)


@each_engine
def test_a_spring_at_a_corner_turns_a_box_by_its_lever_arm(name, installed):
    engine = installed(name)
    extents, corner = (0.3, 0.2, 0.1), (0.3, -0.2, 0.1)
    box = Body("box", Box(extents), 2.0, (0.5, -1.0, 2.0), TURNED)
    scene = Scenario("corner spring", (box,), (), 1e-3, springs=(Spring("box", "", 50.0, 0.1, 0.0, corner, (0, 1, 4)),))
    settings = replace(engine.settings(scene, "world" if name == "handwritten" else "tuned"), timestep=1e-3)
    settings = replace(settings, sample_every=1)
    run = engine.run(scene, settings)
    arm = geometry.rotate(np.array(TURNED), np.array(corner))
    along = np.array(box.position) + arm - (0, 1, 4)
    force = -50.0 * (np.linalg.norm(along) - 0.1) * along / np.linalg.norm(along)
    np.testing.assert_allclose(run.velocity("box")[-1], 1e-3 * (np.array([0, 0, -9.81]) + force / 2.0), rtol=1e-9)
    own_torque = geometry.rotate(geometry.opposite(np.array(TURNED)), np.cross(arm, force))
    spin = geometry.rotate(np.array(TURNED), 1e-3 * own_torque / np.array(box.moments_of_inertia()))
    # The gyroscopic term and the turn within the step are of the next order, ω² dt.
    np.testing.assert_allclose(run.angular_velocities[-1, 0], spin, atol=2e-3 * np.linalg.norm(spin) ** 2 + 1e-12)


BALL, GROUND, BOX = Body("ball", Sphere(0.1), 1.0), Body("ground", HalfSpace()), Body("box", Box((1, 1, 1)), 1.0)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ({"springs": (Spring("ground", "", 1.0),)}, "ground–world can move nothing"),
        ({"springs": (Spring("ball", "bal", 1.0),)}, "bal"),
        ({"attractions": (Attraction("ball", "ground", 1.0),)}, "ground attracts, and needs a finite mass"),
        ({"fluid": Fluid(1.0, 1.0)}, "box is no ball"),
        ({"forces": (GrowingForce("ground", (1.0, 0.0, 0.0)),)}, "ground, which is immovable"),
    ],
)
def test_a_force_that_makes_no_sense_is_refused_by_name(words, message):
    with pytest.raises(InvalidInput, match=message):
        Scenario("scene", (BALL, GROUND, BOX), (), 1.0, **words)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Spring("a", "a", 1.0), "two points of one body"),
        (lambda: Spring("a", "", -1.0), "spring a–world: stiffness"),
        (lambda: Attraction("a", "b", 0.0), "attraction a–b: constant"),
        (lambda: Fluid(viscosity=-1.0), "fluid: viscosity"),
        (lambda: OscillatingForce("a", (1, 0, 0), 0.0), "angular_frequency"),
    ],
)
def test_a_force_with_a_number_out_of_range_is_refused(make, message):
    with pytest.raises(InvalidInput, match=message):
        make()
