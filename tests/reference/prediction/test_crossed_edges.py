"""Boxes edge on edge: when edges meet, the impulse that they get, and which of DART's detectors finds them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.crossed_edges import CLOSING, FLIGHT
from reference.engines import load_engine
from reference.prediction import edges
from reference.prediction.edge_impact import meeting
from reference.scene import geometry
from reference.scene.trajectory import held

FAMILY = catalogue()["crossed-edges"]
SCENARIO = FAMILY.case("e=0.6,m=3.1,angle=111°").scenarios[0]
IMPULSE = FAMILY.quantity("upper")


def test_the_edges_meet_where_and_when_the_scene_was_made_to():
    met = meeting(SCENARIO.body("upper"), SCENARIO.body("lower"))
    assert met.time == pytest.approx(FLIGHT, rel=1e-12)
    assert met.rate == pytest.approx(-CLOSING, rel=1e-12)
    points = [
        np.add(body.position, met.time * np.array(body.velocity)) + arm
        for body, arm in zip((met.body_a, met.body_b), met.arms(met.time), strict=True)
    ]
    np.testing.assert_allclose(*points, atol=1e-14)
    assert met.normal @ (np.array(met.body_a.position) - met.body_b.position) > 0  # from B to A


def test_the_impulse_keeps_both_momenta_and_turns_the_approach_back():
    """Statement 20 from its conditions: Newton's law at the point, and what both boxes get of j n there."""
    met = meeting(SCENARIO.body("upper"), SCENARIO.body("lower"))
    j = IMPULSE.expected_value(FAMILY.case("e=0.6,m=3.1,angle=111°"))
    points = []
    for body, side, arm in zip((met.body_a, met.body_b), (1, -1), met.arms(met.time), strict=True):
        axes = np.column_stack([geometry.rotate(np.array(body.orientation), axis) for axis in np.eye(3)])
        inertia = axes * np.array(body.moments_of_inertia()) @ axes.T
        spin = np.linalg.solve(inertia, np.cross(arm, side * j * met.normal))
        points.append(np.array(body.velocity) + side * j / body.mass * met.normal + np.cross(spin, arm))
    assert (points[0] - points[1]) @ met.normal == pytest.approx(0.6 * CLOSING, rel=1e-12)


def test_boxes_that_pull_at_each_other_have_negative_impulses():
    normal = meeting(SCENARIO.body("upper"), SCENARIO.body("lower")).normal  # from the lower box to the upper one
    still = held(SCENARIO, load_engine("handwritten").settings(SCENARIO, "world"))
    velocities = still.velocities.copy()
    for name, impulse in (("upper", -0.7), ("lower", 0.4)):
        velocities[-1, SCENARIO.index(name)] += impulse / SCENARIO.body(name).mass * normal
    made = replace(still, velocities=velocities)
    measured = [FAMILY.quantity(name).measure(made) for name in ("upper", "lower")]
    assert measured == pytest.approx([-0.7, -0.4], rel=1e-12)


@pytest.mark.parametrize("engine", ["handwritten", "pybullet", "mujoco", "dart"])
def test_edges_that_meet_follow_the_recurrence(engine, installed):
    found, mujoco = installed(engine), engine == "mujoco"
    settings = found.settings(SCENARIO, "world" if engine == "handwritten" else "tuned")
    predicted = edges.predict(SCENARIO, settings, found.method(SCENARIO, settings)).trajectory
    ran = found.run(SCENARIO, settings)
    # Rounding; and what MuJoCo's least friction, 10⁻⁵, may take. How overlap is taken back is not in the rule.
    np.testing.assert_allclose(ran.velocities[-1], predicted.velocities[-1], atol=2e-5 if mujoco else 1e-12)


def test_darts_own_detector_finds_other_points_than_where_edges_cross(installed):
    found, right = installed("dart"), IMPULSE.expected_value(FAMILY.case("e=0.6,m=3.1,angle=111°"))
    settings = found.settings(SCENARIO, "tuned")
    shares = [
        IMPULSE.measure(found.run(SCENARIO, settings.change(detector=detector))) / right
        for detector in ("dart", "fcl", "ode", "bullet")
    ]
    assert shares[0] == pytest.approx(1.042, abs=0.002)
    assert shares[1:] == pytest.approx([1.0] * 3, abs=1e-4)


def test_a_lower_box_that_is_slightly_turned_gets_another_impulse():
    engine, lower = load_engine("handwritten"), SCENARIO.body("lower")
    turned = geometry.turned(np.array(lower.orientation), 1e-6 * np.array([0.0, 1.0, 0.0]))
    other = replace(lower, orientation=tuple(turned.tolist()))
    settings = engine.settings(SCENARIO, "world")
    predicted = edges.predict(SCENARIO, settings, engine.method(SCENARIO, settings))
    wrong = replace(SCENARIO, bodies=(other, SCENARIO.body("upper")))
    told = replace(engine.run(wrong, settings), scenario=SCENARIO)
    assert abs(IMPULSE.measure(told) - IMPULSE.measure(predicted.trajectory)) > 5 * predicted.near
