"""A ball between several planes by hand, against straight flights and reflections that are written out here."""

from __future__ import annotations

import math

import numpy as np
import pytest

from reference.engines import load_engine
from reference.engines.handwritten import balls_between_planes
from reference.errors import RunFailed
from reference.scene import geometry
from reference.scene.scenario import Body, HalfSpace, Pair, Scenario, Sphere

HANDWRITTEN = load_engine("handwritten")
PROFILES = ("exact", "slide", "step")
RADIUS = 0.1
TURN = np.array([0.4, -0.2, 0.8, 0.4])  # a unit quaternion: no normal below lies along an axis


def wedge(degrees, position, velocity, restitution=(0.9, 0.6), duration=0.8, turn=TURN, **changes):
    """A ball in a wedge whose faces make an angle, given in a frame of the wedge that is then turned.

    The first face is z = 0. The second one rises from the y axis.
    """
    angle = math.radians(degrees)
    normals = [geometry.rotate(turn, np.array(each)) for each in ((0, 0, 1), (math.sin(angle), 0, -math.cos(angle)))]
    faces = [Body(name, HalfSpace(tuple(n)), position=(0.3, -1.0, 2.0)) for name, n in zip("ab", normals, strict=True)]
    place = np.array([0.3, -1.0, 2.0]) + geometry.rotate(turn, np.array(position))
    ball = Body("ball", Sphere(RADIUS), 2.0, tuple(place), velocity=tuple(geometry.rotate(turn, np.array(velocity))))
    pairs = (Pair("ball", "a", restitution[0]), Pair("b", "ball", restitution[1]))
    return Scenario("wedge", (faces[0], ball, faces[1]), pairs, duration, **{"gravity": (0.0, 0.0, 0.0)} | changes)


def reflected(scenario, until):
    """Position, velocity and the faces met: straight flights to the nearest face, and a reflection at each."""
    ball = scenario.body("ball")
    p, v, met = np.array(ball.position), np.array(ball.velocity), []
    faces = [(np.array(scenario.body(name).shape.normal), e) for name, e in zip("ab", (0.9, 0.6), strict=True)]
    while True:
        gaps = [n @ (p - np.array(scenario.body("a").position)) - RADIUS for n, _ in faces]
        times = [gap / -(n @ v) if n @ v < 0 else math.inf for gap, (n, _) in zip(gaps, faces, strict=True)]
        first = int(np.argmin(times))
        if times[first] > until:
            return p + until * v, v, met
        n, e = faces[first]
        p, until, met = p + times[first] * v, until - times[first], [*met, "ab"[first]]
        v = v - (1 + e) * (n @ v) * n


def run(scenario, profile="exact", **changes):
    return HANDWRITTEN.run(scenario, HANDWRITTEN.settings(scenario, profile).change(**changes))


OFF_AXIS = {50: 3, 95: 2}
"""Angle of the wedge, and how often the ball meets its faces."""


@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("degrees", OFF_AXIS)
def test_a_ball_in_a_turned_wedge_flies_straight_between_reflections(degrees, profile):
    middle = math.radians(degrees / 2)
    away = np.array([math.cos(middle), 0.0, math.sin(middle)])
    scenario = wedge(degrees, tuple(1.3 * away), tuple(-4.0 * away + np.array([1.0, 0.5, -1.2])))
    p, v, met = reflected(scenario, scenario.duration)
    assert len(met) == OFF_AXIS[degrees]
    made = run(scenario, profile)
    assert made.times[-1] == pytest.approx(scenario.duration, abs=1e-12)
    assert len(made.events) == len(met)
    np.testing.assert_allclose(made.velocity("ball")[-1], v, atol=1e-12)
    # At the step each impact is up to a step late, at some 4 m/s and twice that in the change.
    near = 1e-12 if profile != "step" else len(met) * 8 * 1e-3
    np.testing.assert_allclose(made.position("ball")[-1], p, atol=near)


@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize(("degrees", "impacts"), [(100, 2), (120, 1)])
@pytest.mark.parametrize(("v_a", "v_b"), [(-3.0, -2.0), (-2.0, -3.0)])
def test_two_walls_met_at_once_respond_in_the_order_of_approach(profile, degrees, impacts, v_a, v_b):
    # An impact on one face at u takes (1 + e) u n_a·n_b away from the approach to the other: at 100° not all of it, and
    # both respond; at 120° more than all, and the ball leaves both after the first.
    scenario = wedge(degrees, (0, 0, 0), (0, 0, 0))
    n_a, n_b = (np.array(scenario.body(name).shape.normal) for name in "ab")
    across = np.cross(n_a, n_b) / np.linalg.norm(np.cross(n_a, n_b))
    velocity = np.linalg.solve([n_a, n_b, across], [v_a, v_b, 0.7])
    gaps = np.linalg.solve([n_a, n_b, across], [RADIUS - 0.2505 * v_a, RADIUS - 0.2505 * v_b, 0.0])  # in mid-step
    ball = Body("ball", Sphere(RADIUS), 2.0, tuple(np.array([0.3, -1.0, 2.0]) + gaps), velocity=tuple(velocity))
    together = Scenario("wedge", (scenario.body("a"), ball, scenario.body("b")), scenario.pairs, 0.4, (0.0, 0.0, 0.0))
    order = [(n_a, 0.9), (n_b, 0.6)] if v_a < v_b else [(n_b, 0.6), (n_a, 0.9)]
    for n, e in order:
        velocity = velocity - (1 + e) * min(n @ velocity, 0.0) * n
    made = run(together, profile)
    np.testing.assert_allclose(made.velocity("ball")[-1], velocity, atol=1e-12)
    times = [event.time for event in made.events]
    assert len(times) == impacts
    assert np.ptp(times) < 1e-12


@pytest.mark.parametrize("profile", PROFILES)
def test_a_ball_that_sticks_to_two_walls_stays_outside_both(profile):
    scenario = wedge(60, (1.0, 0.0, 0.3), (-4.0, 0.3, -1.0), restitution=(0.0, 0.0), duration=0.6)
    made = run(scenario, profile)
    v = made.velocity("ball")[-1]
    assert np.linalg.norm(v) == pytest.approx(0.3, abs=1e-9)  # what it has along the edge
    for name in "ab":
        n = np.array(scenario.body(name).shape.normal)
        gap = (made.position("ball") - np.array(scenario.body(name).position)) @ n - RADIUS
        assert gap.min() > (-1e-12 if profile != "step" else -5e-3)  # at the step it enters by v dt at most


def test_planes_that_leave_no_way_out_end_the_run(monkeypatch):
    monkeypatch.setattr(balls_between_planes, "_MOST_IMPACTS", 100)
    scenario = wedge(1, (20.0, 0.0, 0.17), (-40.0, 0.0, 0.0), restitution=(1.0, 1.0))  # 180 impacts
    with pytest.raises(RunFailed, match="more than 100 impacts in one step: the planes leave the ball no way out"):
        run(scenario, timestep=0.8)


def test_a_batch_between_walls_is_run_as_each_member_alone():
    starts = [wedge(50, (0.9, 0.0, 0.4), (-4.0, 0.5, 0.1 * number)) for number in range(3)]
    settings = HANDWRITTEN.settings(starts[0], "exact")
    for scenario, found in zip(starts, HANDWRITTEN.run_many(starts, settings), strict=True):
        alone = HANDWRITTEN.run(scenario, settings)
        assert np.array_equal(found.positions, alone.positions)
        assert found.events == alone.events


FLYING = ((0.9, 0.0, 0.4), (-4.0, 0.0, -1.0))
PLAIN = wedge(60, *FLYING)
NEEDS_A_WORLD = {
    "with weight it may come to rest on both": wedge(60, *FLYING, gravity=(0.0, 0.0, -9.81)),
    "a wall that it passes through": Scenario("one", PLAIN.bodies, PLAIN.pairs[:1], 0.8, (0.0, 0.0, 0.0)),
    "friction makes it spin": Scenario(
        "rough", PLAIN.bodies, (PLAIN.pairs[0], Pair("ball", "b", 0.5, 0.1)), 0.8, (0.0, 0.0, 0.0)
    ),
}


@pytest.mark.parametrize("what", NEEDS_A_WORLD)
def test_a_ball_with_more_than_walls_around_it_runs_in_the_world_alone(what):
    assert list(HANDWRITTEN.profiles(NEEDS_A_WORLD[what])) == ["world"]
