"""A spinning rod that strikes a ball: the angle of a step against the angle that the two cover (slides 9 and 10)."""

from __future__ import annotations

import math

import numpy as np

from reference import sweeping_truth, truth
from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.engines.base import AT_STEP, COMPLIANT, EXACT, Method
from reference.prediction import striking
from reference.scene import geometry
from reference.scene.scenario import Body, Box, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

HALF_LENGTH, HALF_THICKNESS, HALF_BREADTH = 0.375, 0.001, 0.02
"""Of the rod, m: along it, along its way, and along the axis about which it spins."""
RADIUS, DISTANCE = 0.002, 0.3
"""Radius of the ball, and its distance from the rod's axis, m."""
REACH = HALF_THICKNESS + RADIUS
ROD, BALL = 0.2, 0.01
"""Masses, kg."""
RESTITUTION = 0.5
TURN = np.array([0.4, -0.2, 0.8, 0.4])
"""How the scene is turned, a unit quaternion: 0.16 + 0.04 + 0.64 + 0.16 = 1."""
DRIFT = (0.3, -0.2, 0.5)
"""Velocity that the rod and the ball have in common, m/s."""
PASSES = 29
"""Scenarios in an ensemble, a prime: their phases within a step are evenly spread for any timestep."""
FLIGHT, SPREAD, AFTER = 0.004953, 0.004, 0.005
"""Mean time until the rod touches the ball, what the times span, and how long is watched afterwards, s. The span is a
whole number of 0.1, 0.2, 0.5, 1 and 2 ms. No time is: rounding would decide in which step the touch is noticed. In the
first pass a step of 1 ms ends 47 µs after the touch, and finds it. The other end of the rod comes 10 ms after this one
at 300 rad/s.
"""
SHARE, TOUCH = 1e-3, 1e-6
"""Accepted share of a momentum: 0.1 %, and what the tolerance of conservative advancement leaves of it. That is 4 nm,
a millionth of the ball's diameter, by which the arm of 0.3 m and the normal are off."""


def _world(vector: tuple[float, float, float]) -> Array:
    return geometry.rotate(TURN, np.array(vector))


def _pass(name: str, spin: float, time: float) -> Scenario:
    """A rod that touches the ball after so many seconds. Before it is turned, the scene has the ball on the x axis."""
    angle = math.asin(REACH / DISTANCE) + spin * time
    orientation = geometry.turned(TURN, _world((0.0, 0.0, -angle)))
    drift = _world(DRIFT)
    rod = Body(
        "rod",
        Box((HALF_LENGTH, HALF_THICKNESS, HALF_BREADTH)),
        ROD,
        orientation=tuple(orientation.tolist()),
        velocity=tuple(drift.tolist()),
        angular_velocity=tuple(_world((0.0, 0.0, spin)).tolist()),
    )
    place = _world((DISTANCE, 0.0, 0.0))
    ball = Body("ball", Sphere(RADIUS), BALL, tuple(place.tolist()), velocity=tuple(drift.tolist()))
    pair = Pair("rod", "ball", RESTITUTION)
    return Scenario(f"spinning-rod/{name}", (rod, ball), (pair,), time + AFTER, gravity=(0.0, 0.0, 0.0))


def _case(spin: float) -> Case:
    name = f"ω={spin:g}"
    times = (FLIGHT + SPREAD * (number - PASSES // 2) / PASSES for number in range(PASSES))
    ordered = sorted(times, key=lambda time: abs(time - FLIGHT))
    return Case(name, tuple(_pass(name, spin, time) for time in ordered), {"spin": spin})


def impulse(spin: float) -> float:
    """Impulse of the rod on the ball, N s."""
    arm = sweeping_truth.struck_arm(REACH, DISTANCE)
    softness = 1 / BALL + truth.rod_softness(ROD, arm, HALF_LENGTH, HALF_THICKNESS)
    return truth.impact_impulse(spin * arm, RESTITUTION, softness)


def _gained(trajectory: Trajectory) -> float:
    """Momentum that the ball has gained, as a share of what theory says."""
    spin = float(np.linalg.norm(trajectory.scenario.body("rod").angular_velocity))
    velocity = trajectory.velocity("ball")
    return BALL * float(np.linalg.norm(velocity[-1] - velocity[0])) / impulse(spin)


def _expect_gained(case: Case, settings: Settings, method: Method) -> Expectation:
    if method.kind == EXACT:
        return Expectation(1.0, TOUCH, "what advancing up to 4 nm before the touch leaves")
    reason = "0.1 %: without weight or air an impact is all that changes a momentum"
    return Expectation(1.0, SHARE, reason, shift_reason="a ball that the rod passes gains nothing")


def _passed(trajectory: Trajectory) -> float:
    """1 for a ball that the rod passes as if it were not there, 0 for one that it strikes."""
    return float(_gained(trajectory) < SHARE)


def _expect_passed(case: Case, settings: Settings, method: Method) -> Expectation:
    # Evenly spread phases: less than one ball off, and one more for rounding where a phase is an edge.
    one, shift = 1 / PASSES, 0.0
    if method.kind == AT_STEP:
        shift = sweeping_truth.unturned_hands(case.parameters["spin"] * settings.timestep, REACH, DISTANCE)
    why = "1 − asin(c/d)/(ω Δt): no step ends while the rod overlaps the ball and still approaches"
    if method.kind == COMPLIANT:
        why = "the spring gives way so far that the rod gets past the ball"
    return Expectation(0.0, one / 2, "not one ball of them all", shift, why, min(2 * one, shift / 2), one)


def _angle(trajectory: Trajectory) -> Array:
    """Angle from the rod to the ball, about the rod's own axis, rad; negative once the rod has passed."""
    between = trajectory.position("ball") - trajectory.position("rod")
    own = geometry.rotate(geometry.opposite(trajectory.orientation("rod")), between)
    return np.asarray(np.arctan2(own[:, 1], own[:, 0]))


SPINNING_ROD = Family(
    name="spinning-rod",
    title="A spinning rod that strikes a ball",
    topic="sweeping",
    statements=(2, 9, 10),
    about=f"A thin rod spins about its middle without weight and drifts through space. It strikes a ball of"
    f" {1000 * RADIUS:g} mm radius that drifts with it, {1000 * DISTANCE:g} mm from the axis. Every figure is the mean"
    f" over {PASSES} passes that touch the ball at evenly spread instants of a step.",
    expected="The rod strikes every ball. The ball then has the momentum `j = (1 + e) ω a/(1/m + 1/M + a²/I)`, with"
    " the arm `a = √(d² − c²)`: `c` is half the thickness of the rod and the radius of the ball, and `d` is the"
    " distance of the ball from the axis.",
    why=(
        "In a step the rod turns by `ω Δt`. It overlaps the ball over an angle of `asin(c/d)` before its middle line"
        " reaches the ball, and over the same angle behind it. Behind it the two are already moving apart, and no"
        " engine pushes them. So the rod passes the share `1 − asin(c/d)/(ω Δt)` of the balls. Here the angle is"
        " 0.57°. At 100 rad/s and 1 ms a step turns by 5.7°, and the rod passes 90 % of them.",
        "The centres of the two bodies do not approach each other. PyBullet's continuous detection sweeps bodies along"
        " the way of their centres, and so finds nothing here. Only a smaller timestep helps an engine.",
        "Hand-written code uses conservative advancement, `sweep_convex`. It bounds how fast any point of the rod can"
        " move towards the ball, and advances the time only as far as the two surely stay apart. It needs no formula"
        " for the swept volume, and it misses no ball at any timestep.",
    ),
    cases=tuple(_case(spin) for spin in (20.0, 100.0, 300.0)),
    quantities=(
        Quantity("passed", "share that is passed", "", _passed, _expect_passed),
        Quantity("gained", "momentum gained", "", _gained, _expect_gained, share_of="the momentum in theory"),
    ),
    curve=Curve("ω=100", "The first of the passes at 100 rad/s", "angle from the rod to the ball, rad", _angle),
    convergence=Convergence("ω=100", "passed", (4.0, 2.0, 1.0, 0.5)),
    grid=Grid((Parameter("spin", "rad/s", (20.0, 100.0, 300.0), 100.0),), (1e-4, 2e-4, 5e-4, 1e-3), _case),
    predict=striking.predict,
)

FAMILIES = (SPINNING_ROD,)
