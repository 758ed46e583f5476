"""The hand-written world beside others: pymunk in the plane, scipy's integrals, and three engines in space."""

from __future__ import annotations

import numpy as np
import pytest
from oracles import oracle
from scipy.integrate import solve_ivp
from world_scenes import DOWN, FLOOR, GRAVITY, Thing, moments, scene, turn

from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere
from solutions.impulse import rotation_matrix
from solutions.world.rotation import quaternion_product
from solutions.world.rules import Rules
from solutions.world.run import run_world
from solutions.world.step import advance_world

# In the plane: pymunk's x and y are our x and z, and its angle is counted from x to z, against our turn about y.


def pymunk_space(pymunk, gravity):
    space = pymunk.Space()
    space.gravity, space.iterations, space.collision_slop = (0.0, -gravity), 100, 1e-4
    return space


def in_pymunk(pymunk, space, thing, friction, restitution=0.0, angle=0.0):
    """Add a ball or a box as pymunk has it, with the moment of our solid one."""
    body = pymunk.Body(thing.mass, moments(thing.shape, thing.mass)[1])
    body.position, body.angle = (thing.position[0], thing.position[2]), angle
    body.velocity, body.angular_velocity = (thing.velocity[0], thing.velocity[2]), -thing.spin[1]
    if thing.shape[0] == "sphere":
        shape = pymunk.Circle(body, thing.shape[1])
    else:
        x, _, z = thing.shape[1]
        shape = pymunk.Poly(body, [(-x, -z), (x, -z), (x, z), (-x, z)])
    shape.friction, shape.elasticity = friction, restitution
    space.add(body, shape)
    return body


def standing_in_pymunk(pymunk, space, start, end, friction, restitution=0.0):
    line = pymunk.Segment(space.static_body, start, end, 0.0)
    line.friction, line.elasticity = friction, restitution
    space.add(line)


@pytest.mark.parametrize("friction", [0.0, 0.25])
def test_a_box_leaves_a_corners_impact_as_in_pymunk(friction):
    pymunk = oracle("pymunk")
    half, lean, e = np.array([0.3, 0.2, 0.15]), 0.5, 0.6
    lowest = half[0] * np.sin(lean) + half[2] * np.cos(lean)
    box = Thing(("box", half), 1.7, (0.4, 0, lowest - 1e-9), turn((0, 1, 0), -lean), (1.5, 0, -2.0), (0, 0.7, 0))
    space = pymunk_space(pymunk, 0.0)
    # pymunk multiplies the coefficients of the two.
    theirs = in_pymunk(pymunk, space, box, friction, e, lean)
    standing_in_pymunk(pymunk, space, (-5, 0), (5, 0), 1.0, 1.0)
    space.step(1e-7)
    space.step(1e-7)  # it takes the first step to notice the contact
    bodies, start = scene([FLOOR, box], friction=friction, restitution=e)
    rules = Rules(rest_speed=0.0, recovery=0.0, sweeps=500, tolerance=1e-14, law="newton")
    end, _, _ = advance_world(bodies, start, (0, 0, 0), 1e-7, rules)
    found = (end.velocity[1, 0], end.velocity[1, 2], -end.angular_velocity[1, 1])
    # Both move for a step of 1e-7 s; pymunk makes speeds of the overlap, too.
    assert found == pytest.approx((*theirs.velocity, theirs.angular_velocity), abs=1e-5)
    assert np.abs(end.velocity[1, 2] + 2) > 1


def test_box_and_ball_come_to_rest_at_the_foot_of_a_slope_as_in_pymunk():
    """The box slides against a stop, and the ball rolls against the box; where they rest does not depend on the way."""
    pymunk = oracle("pymunk")
    slope, friction = 0.35, 0.2
    down, out = np.array([np.cos(slope), 0, -np.sin(slope)]), np.array([np.sin(slope), 0, np.cos(slope)])
    half, radius = np.array([0.2, 0.3, 0.15]), 0.12
    pose = turn((0, 1, 0), slope)
    box = Thing(("box", half), 2.0, tuple(-0.9 * down + 0.2 * out), pose)
    ball = Thing(("sphere", radius), 0.6, tuple(-1.5 * down + 0.3 * out), velocity=(0.5, 0, 0))
    ground = [Thing(("half-space", tuple(out))), Thing(("half-space", tuple(-down)))]
    bodies, start = scene([*ground, box, ball], friction=friction)
    end = run_world(bodies, start, DOWN, 1 / 60, 150, every=150).position[-1, 2:]
    space = pymunk_space(pymunk, GRAVITY)
    theirs = [in_pymunk(pymunk, space, each, friction, angle=angle) for each, angle in ((box, -slope), (ball, 0.0))]
    standing_in_pymunk(pymunk, space, tuple(-5 * down[[0, 2]]), tuple(5 * down[[0, 2]]), 1.0)
    standing_in_pymunk(pymunk, space, (0, 0), tuple(2 * out[[0, 2]]), 1.0)
    for _ in range(600):
        space.step(1 / 240)
    # Either leaves overlaps of 0.1 mm alone.
    np.testing.assert_allclose(end[:, [0, 2]], [each.position for each in theirs], atol=5e-4)
    np.testing.assert_allclose(end[:, 1], 0, atol=2e-3)  # nothing holds the ball sideways
    np.testing.assert_allclose(end @ down, (-half[0], -2 * half[0] - radius), atol=5e-4)
    np.testing.assert_allclose(end @ out, (half[2], radius), atol=5e-4)


@pytest.mark.slow
def test_a_smooth_ladder_falls_as_its_integral_and_leaves_the_wall_at_two_thirds():
    """A rod of length 2 l slides between a smooth wall and floor, at the angle θ from the floor.

    Energy gives θ′² = 2 g (sin θ₀ − sin θ)/(l + I/(m l)). The wall pushes while the centre gains speed away from it,
    with l sin θ |θ′|. That is greatest where sin θ = 2/3 sin θ₀. From there on the centre keeps this speed.
    """
    shape, mass, heading, begin, dt = ("capsule", 0.02, 0.5), 1.6, 0.4, np.radians(75), 1 / 500
    half = shape[2]
    away = np.array([np.cos(heading), np.sin(heading), 0.0])
    up = np.array([0.0, 0.0, 1.0])
    pose = quaternion_product(turn((0, 0, 1), heading), turn((0, 1, 0), np.pi / 2 + begin))
    centre = half * (np.cos(begin) * away + np.sin(begin) * up) + shape[1] * (away + up)
    ladder = Thing(shape, mass, tuple(centre), pose)
    bodies, start = scene([FLOOR, Thing(("half-space", tuple(away))), ladder])
    inertia = moments(shape, mass)[0] / (mass * half**2)
    faster = 2 * GRAVITY / (half * (1 + inertia))
    leaves = np.arcsin(2 / 3 * np.sin(begin))

    def fall(_, state):
        return [state[1], -faster / 2 * np.cos(state[0])]

    def left(_, state):
        return state[0] - leaves

    left.terminal = True
    exact = solve_ivp(fall, (0, 3), [begin, 0.0], events=left, rtol=1e-10, atol=1e-12, dense_output=True)
    duration = exact.t[-1]
    steps = int(duration / dt)
    run = run_world(bodies, start, DOWN, dt, steps + 30, Rules(sweeps=200, tolerance=1e-10))
    lean = np.arcsin(-rotation_matrix(run.orientation[:, 2])[:, 2, 2])
    times = dt * np.arange(steps + 1)
    # Semi-implicit steps run ahead by half a step, in which the ladder turns by 3 mrad at the end.
    np.testing.assert_allclose(lean[: steps + 1], exact.sol(times)[0], atol=4e-3)
    speed = run.velocity[:, 2] @ away
    expected = half * np.sin(leaves) * np.sqrt(faster * (np.sin(begin) - np.sin(leaves)))
    assert speed[-1] == pytest.approx(expected, rel=4 * dt / duration)  # a step's head start, twice
    np.testing.assert_allclose(speed[steps + 10 :], speed[-1], rtol=1e-9)  # it has left the wall
    assert speed[steps - 30] < 0.99 * speed[-1]  # and had not long before
    np.testing.assert_allclose(run.velocity[:, 2] @ np.cross(up, away), 0, atol=1e-9)


@pytest.mark.weekly
def test_bodies_come_to_rest_at_the_foot_of_a_slope_as_in_the_engines(installed):
    """Two boxes and a ball on a slope, which a fixed box ends; each settles against the one before it."""
    slope, heading, friction, duration = 0.35, 0.6, 0.2, 4.0
    ground = quaternion_product(turn((0, 0, 1), heading), turn((0, 1, 0), slope))
    down, across, out = rotation_matrix(ground).T
    first, second, stop, radius = (0.2, 0.3, 0.15), (0.15, 0.2, 0.1), (0.1, 1.0, 0.3), 0.12

    def at(along, aside, above):
        return tuple((along * down + aside * across + above * out).tolist())

    pose = tuple(ground.tolist())
    bodies = (
        Body("slope", HalfSpace(tuple(out.tolist()))),
        Body("stop", Box(stop), position=at(0.1, 0, 0.3), orientation=pose),
        Body("first", Box(first), 2.0, at(-0.7, 0.03, 0.2), pose),
        Body("second", Box(second), 0.7, at(-1.3, -0.02, 0.12), pose),
        Body("ball", Sphere(radius), 0.5, at(-1.8, 0.01, 0.2)),
    )
    names = [body.name for body in bodies]
    touching = [("first", "slope"), ("first", "stop"), ("second", "slope"), ("second", "first"), ("ball", "slope")]
    pairs = tuple(Pair(a, b, 0.0, friction) for a, b in [*touching, ("ball", "second"), ("ball", "first")])
    scenario = Scenario("foot of a slope", bodies, pairs, duration)
    shapes = [("half-space", tuple(out)), ("box", stop), ("box", first), ("box", second), ("sphere", radius)]
    things = [
        Thing(shape, body.mass, body.position, body.orientation) for shape, body in zip(shapes, bodies, strict=True)
    ]
    of_world, start = scene(things, friction=friction)
    end = run_world(of_world, start, DOWN, 1 / 240, 960, every=960).position[-1]
    for engine in map(installed, ("mujoco", "pybullet", "dart")):
        run = engine.run(scenario, engine.settings(scenario, "tuned"))
        theirs = np.array([run.position(name)[-1] for name in names])
        apart = (theirs - end)[2:] @ np.array([down, out]).T
        # Each leaves overlaps of up to 0.1 mm alone, or a soft contact's depth. Across the slope nothing fixes a place:
        # there the second box differs by up to 5 mm, and the ball by 22 mm.
        np.testing.assert_allclose(apart, 0, atol=5e-4)
    np.testing.assert_allclose(end[2:] @ down, (-0.2, -0.55, -0.82), atol=5e-4)
    np.testing.assert_allclose(end[2:] @ out, (0.15, 0.1, 0.12), atol=5e-4)
