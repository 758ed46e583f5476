"""Hand-written drivers and queries far from the origin, turned, in motion and with unequal bodies.

A scene that is moved as a whole must do the same, moved as a whole: a sign or a place that happens to vanish where a
scene lies at the origin, upright and symmetric shows here.
"""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from reference import truth
from reference.engines import load_engine
from reference.engines.handwritten.scenario_kind import kind
from reference.scene import geometry
from reference.scene.query import Distance, Ray
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere

G = 9.81
WEIGHTLESS = (0.0, 0.0, 0.0)
DOWN = (0.0, 0.0, -G)
TURN = np.array([0.4, -0.2, 0.8, 0.4])  # a unit quaternion: 0.16 + 0.04 + 0.64 + 0.16 = 1
SHIFT = np.array([3.0, -5.0, 2.0])
DRIFT = np.array([0.3, 0.7, -0.4])
NEAR = 1e-12
"""Rounding of some hundred steps, with numbers up to 10."""
HANDWRITTEN = load_engine("handwritten")


def turned(vector) -> tuple[float, ...]:
    return tuple(geometry.rotate(TURN, np.array(vector, dtype=float)).tolist())


def product(left, right) -> np.ndarray:
    """Hamilton product: the turn `right`, then the turn `left`."""
    w, q, v, r = left[0], left[1:], right[0], right[1:]
    return np.array([w * v - q @ r, *(w * r + v * q + np.cross(q, r))])


def moved_body(body: Body, drift=(0.0, 0.0, 0.0)) -> Body:
    return replace(
        body,
        shape=HalfSpace(turned(body.shape.normal)) if isinstance(body.shape, HalfSpace) else body.shape,
        position=tuple(turned(body.position) + SHIFT),
        orientation=tuple(product(TURN, np.array(body.orientation))),
        velocity=tuple(np.add(turned(body.velocity), drift)),
        angular_velocity=turned(body.angular_velocity),
    )


def drift_of(scenario: Scenario) -> np.ndarray:
    """What every velocity gains: nothing where a body cannot move, and along the row in a row, which stays one."""
    if any(body.immovable for body in scenario.bodies):
        return 0 * DRIFT
    return np.array(turned((0.3, 0.0, 0.0))) if scenario.name == "row" else DRIFT


def moved(scenario: Scenario) -> Scenario:
    bodies = tuple(moved_body(body, drift_of(scenario)) for body in scenario.bodies)
    return replace(scenario, bodies=bodies, gravity=turned(scenario.gravity))


def run(scenario, profile, timestep=5e-3):
    return HANDWRITTEN.run(scenario, HANDWRITTEN.settings(scenario, profile).change(timestep=timestep))


# Scenes, as simple as they come; `moved` makes them general


def two_balls(friction: float) -> Scenario:
    a = Body("a", Sphere(0.1), 1.5, (-0.6, 0.1, 0.05), velocity=(3.0, 0.0, 0.0), angular_velocity=(4.0, -9.0, 20.0))
    b = Body("b", Sphere(0.15), 0.7, (0.0, 0.0, 0.0), velocity=(-1.0, 0.1, 0.2), angular_velocity=(0.0, 7.0, -3.0))
    return Scenario("balls", (b, a), (Pair("a", "b", 0.6, friction),), 0.15, WEIGHTLESS)


def falling_balls() -> Scenario:
    return replace(two_balls(0.2), gravity=DOWN)


def rod(arm: float, below: bool = False, mass: float = 0.4) -> Scenario:
    """A ball that flies straight at a face of a box, an arm from its middle along y."""
    side = -1.0 if below else 1.0
    start = (0.0, arm, side * (0.05 + 0.1 + 0.1003))
    ball = Body("ball", Sphere(0.1), mass, start, velocity=(0.0, 0.0, -side))
    box = Body("box", Box((0.04, 0.5, 0.05)), 1.3)
    return Scenario("rod", (box, ball), (Pair("ball", "box", 0.7),), 0.15, WEIGHTLESS)


def ball_over_floor(friction: float, spin=(0.0, 0.0, 0.0)) -> Scenario:
    ball = Body("ball", Sphere(0.1), 2.0, (0.2, 0.0, 0.4), velocity=(0.5, -0.8, -1.0), angular_velocity=spin)
    return Scenario("bounce", (Body("floor", HalfSpace()), ball), (Pair("ball", "floor", 0.6, friction),), 0.35)


def slab(slope: float, speed: float) -> Scenario:
    """A slab on a floor; gravity is tilted instead of the floor."""
    box = Body("slab", Box((0.4, 0.3, 0.1)), 2.0, (0.0, 0.0, 0.1), velocity=(speed, 0.0, 0.0))
    pull = (G * math.sin(slope), 0.0, -G * math.cos(slope))
    pair = Pair("slab", "floor", kinetic_friction=0.3, static_friction=0.4)
    return Scenario("slab", (Body("floor", HalfSpace()), box), (pair,), 0.3, pull)


def row(velocities, radii, gaps, masses, restitution) -> Scenario:
    ends = np.cumsum([2 * radius for radius in radii]) + np.concatenate([[0.0], np.cumsum(gaps)])
    bodies = tuple(
        Body(f"ball {number}", Sphere(radius), mass, (end - radius, 0.0, 0.0), velocity=(velocity, 0.0, 0.0))
        for number, (end, radius, mass, velocity) in enumerate(zip(ends, radii, masses, velocities, strict=True))
    )
    pairs = tuple(Pair(a.name, b.name, e) for (a, b), e in zip(pairwise(bodies), restitution, strict=True))
    return Scenario("row", bodies, pairs, 0.4, WEIGHTLESS)


SCENES = {
    "smooth balls": two_balls(0.0),
    "rough balls": two_balls(0.3),
    "falling balls": falling_balls(),
    "a rod struck at its centre": rod(0.0),
    "a rod struck from above": rod(0.3),
    "a rod struck from below": rod(-0.4, below=True),
    "a smooth ball over a floor": ball_over_floor(0.0),
    "a rough ball over a floor": ball_over_floor(0.25),
    "a rough ball that spins": ball_over_floor(0.25, (9.0, 4.0, -6.0)),
    "a slab that stops": slab(0.0, 0.5),
    "a slab that slides down": slab(0.5, 0.2),
    "a slab that holds": slab(0.2, 0.0),
    "unequal balls in a row": row((1.0, 0.0, 0.0), (0.1, 0.05, 0.2), (0.1003, 0.003), (2.0, 1.0, 0.5), (0.9, 0.6)),
}


RUNS = [(what, profile) for what, scenario in SCENES.items() for profile in HANDWRITTEN.profiles(scenario)]


SOME = [pytest.param(*run, marks=() if place % 3 == 0 else pytest.mark.slow) for place, run in enumerate(RUNS)]


@pytest.mark.parametrize(("what", "profile"), SOME)
def test_a_scene_that_is_moved_as_a_whole_does_the_same(what, profile):
    scenario = SCENES[what]
    here, there, drift = run(scenario, profile), run(moved(scenario), profile), drift_of(scenario)
    assert [(event.kind, event.body) for event in there.events] == [(event.kind, event.body) for event in here.events]
    times = [[event.time for event in made.events] for made in (here, there)]
    np.testing.assert_allclose(*times, atol=NEAR)
    place = geometry.rotate(TURN, here.positions) + SHIFT + here.times[:, None, None] * drift
    np.testing.assert_allclose(there.positions, place, atol=NEAR)
    np.testing.assert_allclose(there.velocities, geometry.rotate(TURN, here.velocities) + drift, atol=NEAR)
    np.testing.assert_allclose(there.angular_velocities, geometry.rotate(TURN, here.angular_velocities), atol=10 * NEAR)
    for axis in np.eye(3):
        own = geometry.rotate(here.orientations, axis)
        np.testing.assert_allclose(geometry.rotate(there.orientations, axis), geometry.rotate(TURN, own), atol=NEAR)


# Closed forms with unequal bodies


def axis_speeds(made, body) -> float:
    """Velocity of a body at the end along the x axis of the scene before it was moved, less the drift, m/s."""
    return float((made.velocity(body)[-1] - drift_of(made.scenario)) @ np.array(turned((1.0, 0.0, 0.0))))


def test_balls_of_unequal_size_and_mass_strike_where_their_surfaces_touch():
    made = run(moved(two_balls(0.0)), "exact")
    a, b = (two_balls(0.0).body(name) for name in "ab")
    between, closing = np.subtract(a.position, b.position), np.subtract(a.velocity, b.velocity)
    p, q = closing @ between / (closing @ closing), (between @ between - 0.25**2) / (closing @ closing)
    time = -p - math.sqrt(p * p - q)
    assert made.events[0].time == pytest.approx(time, abs=1e-13)
    normal = (between + time * closing) / 0.25
    impulse = truth.impact_impulse(-closing @ normal, 0.6, 1 / 1.5 + 1 / 0.7)
    for body, sign in ((a, 1), (b, -1)):
        after = body.velocity + sign * impulse / body.mass * normal
        np.testing.assert_allclose(made.velocity(body.name)[-1], turned(after) + DRIFT, atol=1e-13)


@pytest.mark.parametrize(("arm", "below"), [(0.3, False), (-0.4, True)])
def test_a_rod_that_leans_turns_as_its_arm_and_its_moment_of_inertia_say(arm, below):
    made = run(moved(rod(arm, below)), "exact")
    impulse = truth.impact_impulse(1.0, 0.7, 1 / 0.4 + truth.rod_softness(1.3, arm, 0.5, 0.05))
    up, inertia = (-1.0 if below else 1.0), 1.3 * (0.5**2 + 0.05**2) / 3
    assert made.events[0].time == pytest.approx(0.1003, abs=NEAR)
    spin, away = turned((-up * impulse * arm / inertia, 0.0, 0.0)), np.array(turned((0.0, 0.0, up)))
    np.testing.assert_allclose(made.angular_velocity("box")[-1], spin, atol=NEAR)
    np.testing.assert_allclose(made.velocity("box")[-1], DRIFT - impulse / 1.3 * away, atol=NEAR)
    np.testing.assert_allclose(made.velocity("ball")[-1], DRIFT + (impulse / 0.4 - 1) * away, atol=NEAR)


def test_unequal_balls_in_a_row_strike_where_their_surfaces_touch():
    made = run(moved(SCENES["unequal balls in a row"]), "exact")
    second = 1.9 * 2.0 / (2.0 + 1.0)  # (1 + e) m_A v/(m_A + m_B), what the second ball gets of the first one's 1 m/s
    third = 1.6 * 1.0 * second / (1.0 + 0.5)
    left = [1 - second / 2.0, second - 0.5 * third, third]
    found = [axis_speeds(made, f"ball {number}") for number in range(3)]
    np.testing.assert_allclose(found, left, atol=NEAR)
    instants = sorted({round(event.time, 9) for event in made.events})
    assert instants == pytest.approx([0.1003, 0.1003 + 0.003 / second], abs=1e-9)


def test_in_a_row_that_touches_each_pair_has_its_own_restitution():
    touching = row((1.0, 0.0, 0.0), (0.125, 0.0625, 0.25), (0.25, 0.0), (1.0, 1.0, 1.0), (1.0, 0.5))
    np.testing.assert_allclose(run(touching, "exact").velocities[-1, :, 0], [0.0, 0.25, 0.75], atol=1e-15)


@pytest.mark.parametrize("profile", ["exact", "step"])
def test_a_ball_strikes_a_leaning_plane_when_its_gap_is_gone(profile):
    made = run(moved(ball_over_floor(0.0)), profile)
    speed = math.sqrt(1.0 + 2 * G * 0.3)
    late = made.events[0].time - (speed - 1.0) / G
    # Semi-implicit Euler is half a step of 5 ms ahead of the fall, and notices the impact up to a step late
    first, last = (-1e-13, 1e-13) if profile == "exact" else (-2.5e-3, 5e-3)
    assert first <= late <= last


@pytest.mark.parametrize("scenario", [two_balls(0.3), rod(0.3)], ids=["balls", "a rod"])
def test_bodies_that_fall_together_meet_as_if_nothing_pulled(scenario):
    still, falling = run(scenario, "exact"), run(replace(scenario, gravity=DOWN), "exact")
    assert [event.time for event in falling.events] == pytest.approx([event.time for event in still.events], abs=NEAR)
    np.testing.assert_allclose(np.diff(falling.velocities, axis=1), np.diff(still.velocities, axis=1), atol=NEAR)
    np.testing.assert_allclose(falling.angular_velocities, still.angular_velocities, atol=NEAR)


@pytest.mark.parametrize(("spin", "grips"), [(9.0, True), (60.0, False)])
def test_a_spinning_ball_grips_or_slips_as_its_friction_says(spin, grips):
    ball = Body("ball", Sphere(0.1), 2.0, (0.0, 0.0, 0.4), velocity=(0.0, 0.0, -1.0), angular_velocity=(0.0, spin, 0.0))
    scenario = replace(ball_over_floor(0.25), bodies=(Body("floor", HalfSpace()), ball))
    made, speed = run(moved(scenario), "exact"), math.sqrt(1.0 + 2 * G * 0.3)
    along, surface = truth.spinning_impact(speed, 0.1 * spin, 0.6, 0.25)
    assert (along == pytest.approx(2 / 7 * 0.1 * spin)) is grips
    assert made.velocity("ball")[-1] @ turned((1.0, 0.0, 0.0)) == pytest.approx(along, abs=NEAR)
    np.testing.assert_allclose(made.angular_velocity("ball")[-1], turned((0.0, surface / 0.1, 0.0)), atol=10 * NEAR)


# Questions of geometry

BODIES = {
    "ball": Body("ball", Sphere(0.5), position=(0.2, -0.1, 0.4)),
    "box": Body("box", Box((0.3, 0.5, 0.8)), position=(0.1, 0.2, -0.3), orientation=(0.8, 0.6, 0.0, 0.0)),
    "floor": Body("floor", HalfSpace(), position=(1.0, 2.0, -0.7)),
}
START = (3.0, 2.5, 4.0)
OFFSET = (1.0, 1.5, 2.4)
"""In the box's own axes, m: two such boxes are apart along all three, by (0.4, 0.5, 0.8) m."""


@pytest.mark.parametrize("what", BODIES)
def test_a_ray_ends_on_the_surface_of_a_body_at_any_place(what):
    body = moved_body(BODIES[what])
    start = turned(START) + SHIFT
    way = 2 * (np.add(body.position, (0.1, -0.05, 0.07)) - start)
    end = start + HANDWRITTEN.query(Ray(body, tuple(start), tuple(way))) * way
    point = Body("point", Sphere(1e-9), position=tuple(end))
    assert geometry.gap(point, body) == pytest.approx(-1e-9, abs=NEAR)
    assert (way @ (np.array(body.position) - end)) > 0 or what == "floor", "the near side"


@pytest.mark.parametrize(("first", "second"), [("ball", "box"), ("ball", "floor"), ("box", "floor"), ("box", "box")])
def test_the_distance_of_two_bodies_agrees_with_the_ruler_at_any_place(first, second):
    b = replace(BODIES[second], name="other")
    a = replace(BODIES[first], position=tuple(b.position + geometry.rotate(np.array(b.orientation), np.array(OFFSET))))
    expected = math.hypot(0.4, 0.5, 0.8) if first == second else geometry.gap(a, b)  # two corners: no exact ruler
    assert HANDWRITTEN.query(Distance(moved_body(a), moved_body(b))) == pytest.approx(expected, abs=NEAR)


# What needs a rigid-body world, wherever it lies

NEEDS_A_WORLD = {
    "a slab that slides across a slope": replace(
        slab(0.3, 0.0), bodies=(slab(0.3, 0.0).bodies[0], replace(slab(0.3, 0.0).bodies[1], velocity=(0.0, 0.2, 0.0)))
    ),
    "a slab above the floor": replace(
        slab(0.0, 0.0), bodies=(slab(0.0, 0.0).bodies[0], replace(slab(0.0, 0.0).bodies[1], position=(0.0, 0.0, 0.2)))
    ),
    "a ball that flies at a rod aslant": replace(
        rod(0.2), bodies=(rod(0.2).bodies[0], replace(rod(0.2).bodies[1], velocity=(0.0, 0.1, -1.0)))
    ),
    "a ball that flies at a rod beside its middle line": replace(
        rod(0.2),
        bodies=(rod(0.2).bodies[0], replace(rod(0.2).bodies[1], position=(0.01, 0.2, 0.25))),
    ),
}


@pytest.mark.parametrize("what", NEEDS_A_WORLD)
def test_a_scene_that_only_the_world_runs_is_one_at_any_place(what):
    for scenario in (NEEDS_A_WORLD[what], moved(NEEDS_A_WORLD[what])):
        assert kind(scenario) is None
        assert list(HANDWRITTEN.profiles(scenario)) == ["world"]
