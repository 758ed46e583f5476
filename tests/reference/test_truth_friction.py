"""Closed forms of dry friction with a circle, a diamond or a square for a cone, against small steps."""

from __future__ import annotations

import math

import numpy as np
import pytest
from oracles import oracle

from reference import friction_truth
from reference.friction_truth import CIRCLE, DIAMOND, SQUARE

G = 9.81
FINE = 1e-4
"""Step of the small steps, s."""


def nearest_in(cone, force, limit):
    """The force of a cone that is nearest to another one: of all it makes, it leaves the least slip."""
    if cone == CIRCLE:
        return force * min(1.0, limit / max(float(np.linalg.norm(force)), 1e-300))
    if cone == SQUARE:
        return np.clip(force, -limit, limit)
    sizes = np.sort(np.abs(force))
    if sizes.sum() <= limit:
        return force
    least = max((sizes.sum() - limit) / 2, sizes[1] - limit)  # both parts lose as much, and none changes its sign
    return np.sign(force) * np.maximum(np.abs(force) - least, 0.0)


def stepped(cone, friction, mass, velocity, push, duration):
    """Velocity and way after small steps, in each of which friction leaves as little slip as its cone allows."""
    velocity, way = np.array(velocity, dtype=float), np.zeros(2)
    for number in range(round(duration / FINE)):
        force = np.array(push((number + 0.5) * FINE, way + velocity * FINE / 2))
        rubs = nearest_in(cone, mass * velocity / FINE + force, friction * mass * G)
        before = velocity
        velocity = velocity + (force - rubs) / mass * FINE
        way = way + (before + velocity) / 2 * FINE
    return velocity, way


@pytest.mark.parametrize("cone", [CIRCLE, DIAMOND, SQUARE])
def test_a_pushed_body_goes_where_small_steps_take_it(cone):
    friction, mass, rate, heading, end = 0.35, 1.3, 25.0, math.radians(35.0), 0.4
    direction = np.array([math.cos(heading), math.sin(heading)])
    _, way = stepped(cone, friction, mass, (0.0, 0.0), lambda time, way: rate * time * direction, end)
    found = friction_truth.end_of_pushed_way(cone, friction, mass, G, rate, heading, end)
    assert found == pytest.approx(way, abs=2e-5)  # a step late at the break-away: R dt τ²/(2 m) of 40 mm


def test_beyond_the_diagonal_of_a_diamond_nothing_is_claimed():
    with pytest.raises(ValueError, match=r"^by 2\.0 s the push is so large that the body has left the diagonal$"):
        friction_truth.end_of_pushed_way(DIAMOND, 0.3, 1.0, G, 25.0, math.radians(35.0), 2.0)


@pytest.mark.parametrize(("static", "kinetic"), [(0.5, 0.5), (0.6, 0.35)])
def test_the_way_after_break_away_agrees_with_small_steps(static, kinetic):
    mass, rate, duration = 2.3, 14.0, 0.5
    limit = static * mass * G
    _, way = stepped(CIRCLE, kinetic, mass, (0.0, 0.0), lambda time, way: (limit + rate * time, 0.0), duration)
    found = friction_truth.way_after_break_away(static, kinetic, mass, G, rate, duration)
    assert found == pytest.approx(way[0], rel=1e-6)


@pytest.mark.parametrize("cone", [CIRCLE, DIAMOND, SQUARE])
def test_a_slip_gains_the_share_of_the_push_that_its_cone_leaves_it(cone):
    friction, mass, rate, heading = 0.35, 1.3, 25.0, math.radians(35.0)
    direction = np.array([math.cos(heading), math.sin(heading)])
    leaves, later = friction_truth.least_push(cone, heading) * friction * mass * G / rate, 0.08
    velocity, _ = stepped(cone, friction, mass, (0.0, 0.0), lambda time, way: rate * time * direction, leaves + later)
    gained = friction_truth.moving_share(cone, heading) * rate * later**2 / (2 * mass)
    assert np.linalg.norm(velocity) == pytest.approx(gained, rel=5e-3)  # two fine steps of 0.1 ms


@pytest.mark.parametrize("cone", [CIRCLE, DIAMOND, SQUARE])
@pytest.mark.parametrize("degrees", [20.0, 62.0])
def test_a_slide_ends_where_small_steps_end(cone, degrees):
    speed, friction, mass, heading = 1.4, 0.35, 1.3, math.radians(degrees)
    start = speed * np.array([math.cos(heading), math.sin(heading)])
    longest = 1.5 * speed / (friction * G)
    velocity, way = stepped(cone, friction, mass, start, lambda time, way: (0.0, 0.0), longest)
    assert friction_truth.end_of_slide(cone, speed, friction, G, heading) == pytest.approx(way, abs=1e-6)
    assert np.linalg.norm(velocity) < 1e-12


@pytest.mark.parametrize(
    ("friction", "pull", "pressed"),
    [(0.5, (1.5, 0.6), 9.0), (1.0, (6.3, 0.0), 7.5), (0.4, (2.9, 0.3), 9.81)],  # all push, one edge off, one edge off
)
def test_the_creep_of_a_soft_pyramid_balances_all_edges(friction, pull, pressed):
    optimize = oracle("scipy.optimize")
    edges = np.array([(friction, 0, 1), (-friction, 0, 1), (0, friction, 1), (0, -friction, 1)])
    damping, stiffness = 2 / 0.019, 1 / 0.019**2

    def left_over(unknown):
        """What the forces of a corner's edges leave of a quarter of the load: each in N for a body of 1 kg."""
        velocity, depth = np.array([*unknown[:2], 0.0]), unknown[2] * 1e-4
        impedance = 0.9 + 0.05 * 2 * (depth / 1e-3) ** 2
        softness = 2 * friction**2 * (1 - impedance) / impedance * (1 + friction**2)
        forces = np.maximum(0.0, (stiffness * impedance * depth - damping * edges @ velocity) / softness)
        return forces @ edges + np.array([*pull, -pressed]) / 4

    found = optimize.root(left_over, [1e-4, 1e-4, 1.0], tol=1e-13)
    assert found.success
    assert friction_truth.creep_of_a_soft_pyramid(friction, pull, pressed) == pytest.approx(found.x[:2], rel=1e-9)


def test_a_pull_beyond_the_pyramid_has_no_steady_creep():
    with pytest.raises(ValueError, match="is more than the corners of the pyramid hold"):
        friction_truth.creep_of_a_soft_pyramid(0.5, (4.0, 1.0), 9.81)


@pytest.mark.parametrize(("start", "velocity"), [(-0.17, 0.0), (0.05, 0.9), (0.1, -1.1)])
def test_a_slab_on_a_spring_turns_where_and_when_small_steps_turn(start, velocity):
    friction, mass, stiffness = 0.3, 1.3, 160.0
    dead_band, frequency = friction * mass * G / stiffness, math.sqrt(stiffness / mass)
    times, places = friction_truth.turning_points(start, velocity, frequency, dead_band)
    assert np.all(np.diff(times) > 0)
    for time, place in list(zip(times, places, strict=True))[-2:]:
        at, way = stepped(
            CIRCLE, friction, mass, (velocity, 0.0), lambda _, way: (-stiffness * (start + way[0]), 0.0), time
        )
        assert start + way[0] == pytest.approx(place, abs=1e-4)  # a fine step at some mm/s, at each turning point
        assert abs(at[0]) < 0.02  # and the speed changes by up to 3 mm/s in one
    assert abs(places[-1]) <= dead_band
    assert all(abs(place) > dead_band for place in places[:-1])


def test_a_slab_at_rest_in_the_dead_band_has_no_turning_point():
    times, _ = friction_truth.turning_points(0.04, 0.0, 10.0, 0.05)
    assert len(times) == 0
