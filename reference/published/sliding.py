"""Published cases of boxes that slide or hold: on the flat, on a ramp, and under a load of balls."""

from __future__ import annotations

import math

import numpy as np

from reference.arrays import Array
from reference.engines.implementation import Implementation
from reference.published import Answers, Published, said
from reference.published.in_engines import plate, sliding

X, Y, UP = np.eye(3)
LONG = 100.0
"""s; whatever slides here has stopped by then."""
STEP = 1.0
"""s. All forces are constant, so that a step may be as long as one likes."""


def box_under_balls(case: Published, code: Implementation) -> Answers:
    """P2: a plate and its balls as bodies with one contact each, by sequential impulses; then with a square cone."""
    balls, duration = int(case.value("balls")), case.value("duration")
    masses = np.array([case.value("box_mass")] + balls * [case.value("ball_mass")])
    push = _push(case)
    gained = np.full((balls + 1, 6), 0.0)
    gained[:, 2] = -case.value("gravity")
    gained[0, :3] += push / masses[0]
    rows, weights = _contacts(case, code, masses)
    friction = np.array([case.value("ground_friction")] + balls * [case.value("ball_friction")])
    solve, velocity = code.function("sequential_impulses"), np.zeros(6 * (balls + 1))
    for _ in range(round(duration / STEP)):
        velocity, _ = solve(velocity + STEP * gained.ravel(), rows, weights, friction)
    box, ball = (float(np.linalg.norm(body[:3])) for body in velocity.reshape(-1, 6)[:2])
    return said(
        box_speed=box,
        ball_speed=ball,
        box_acceleration=box / duration,
        ball_acceleration=ball / duration,
        square_cone_error=_square_cone(case, code, push, float(np.sum(masses))),
    )


def _push(case: Published) -> Array:
    angle = math.radians(case.value("push_angle"))
    return case.value("push") * (math.cos(angle) * X + math.sin(angle) * Y)


def _contacts(case: Published, code: Implementation, masses: Array) -> tuple[object, object]:
    """The plate on the ground, each ball on the plate, which is pushed and loaded evenly: it is kept from turning."""
    bodies, radius = len(masses), case.value("ball_radius")
    below = np.array([-1] + (bodies - 1) * [0])
    arms = np.outer(below + 1, -radius * UP)
    jacobian = code.function("contact_jacobian")
    directions = [np.broadcast_to(direction, (bodies, 3)) for direction in (UP, X, Y)]
    rows = [jacobian(np.arange(bodies), below, direction, arms, 0 * arms, bodies) for direction in directions]
    inertia = np.where(below >= 0, 0.4 * masses * radius**2, math.inf)
    weights = code.function("inverse_mass_matrix")(1 / masses, np.eye(3) / inertia[:, None, None])
    return np.stack(rows, axis=1), weights


def _square_cone(case: Published, code: Implementation, push: Array, mass: float) -> float:
    """Mean of the squared errors of both speeds, before each step, if friction is clamped to a square along x and y."""
    press = code.function("normal_force")(-mass * case.value("gravity") * UP, UP)
    friction = code.function("clamp_to_square")(-push, case.value("ground_friction") * press, X, Y)
    assert np.array_equal(friction, -push), "the square holds the plate"
    times = case.value("timestep") * np.arange(round(case.value("duration") / case.value("timestep")))
    errors = sum((case.expected_value(name) * times) ** 2 for name in ("box_acceleration", "ball_acceleration"))
    return float(np.mean(errors))


def stopping(case: Published, code: Implementation) -> Answers:
    """P7, P8: how far a box slides, in one step of the lecture's motion with friction, exact to the stop."""
    press = code.function("normal_force")(-case.value("gravity") * UP, UP)  # of a mass of 1 kg, as any
    friction = np.array(case.values("friction"))
    still = np.zeros(3)
    end, *_ = code.function("sliding_motion")(
        still, case.value("speed") * X, still, press, friction, friction, 1.0, LONG
    )
    found = np.ravel(end[..., 0])
    return said(distance=tuple(found.tolist()) if len(found) > 1 else float(found[0]))


def ramp(case: Published, code: Implementation) -> Answers:
    """P10: whether a box rests, for every pair of coefficient and slope."""
    angles = np.radians(np.array(case.values("slope")))
    normal = np.stack([-np.sin(angles), 0 * angles, np.cos(angles)], axis=-1)
    weight = code.function("apparent_force")(1.0, -case.value("gravity") * UP, np.zeros(3), np.zeros(3))
    press = code.function("normal_force")(weight, normal)
    push = code.function("along_surface")(weight, normal)
    rests = code.function("holds")(push, press, np.array(case.values("friction"))[:, None])
    return said(rests=tuple(np.ravel(rests).astype(float).tolist()))


_FRICTIONS, _SLOPES = (0.1, 0.3, 0.5, 0.7, 1.0), (3.0, 10.0, 20.0, 30.0, 40.0)

CASES = (
    Published(
        number=2,
        title="A plate is pushed from under twenty-five balls",
        statement=24,
        kind="verification",
        source="SimBenchmark (leggedrobotics), test rolling: its closed form, and the score of a friction pyramid",
        setup={"box_mass": 10.0, "box_size": (20.0, 20.0, 1.0), "push": 150.0, "push_angle": 60.0, "balls": 25.0,
               "ball_mass": 1.0, "ball_radius": 0.5, "ground_friction": 0.4, "ball_friction": 0.8, "gravity": 9.81,
               "duration": 4.0, "timestep": 1e-3},
        expected={"box_acceleration": 0.7385, "ball_acceleration": 0.2110, "box_speed": 2.954, "ball_speed": 0.844,
                  "square_cone_error": 3.14497},
        tolerance={"box_acceleration": 5e-5, "ball_acceleration": 5e-5, "box_speed": 5e-4, "ball_speed": 5e-4,
                   "square_cone_error": 5e-6},
        reason="half of the last digit printed",
        note="The balls roll: 2/7 of the plate's acceleration. A friction cone that is a square along the axes holds "
        "the plate, 129.9 N against 137.3 N along y, although 150 N are more than that; its error, the mean of both "
        "squared errors of speed before each of 4000 steps, is that of an engine which does nothing.",
        units={"box_acceleration": "m/s²", "ball_acceleration": "m/s²", "box_speed": "m/s", "ball_speed": "m/s",
               "square_cone_error": "m²/s²"},
        by_hand=box_under_balls,
        in_engine=plate.plate,
    ),
    Published(
        number=7,
        title="A sliding box stops",
        statement=24,
        kind="verification",
        source="Newton (physics engine), verification and validation of friction",
        setup={"half_edge": 0.25, "speed": 2.0, "friction": (0.2, 0.4, 0.7), "gravity": 9.81, "timestep": 1 / 1800},
        expected={"distance": (1.01937, 0.50968, 0.29125)},
        tolerance={"distance": (0.0101937, 0.0050968, 0.0029125)},
        reason="their own 1 %; ours is exact",
        note="v²/(2μg). A method that answers at the step stops v dt/2 = 0.56 mm short.",
        units={"distance": "m"},
        labels={"distance": ("μ = 0.2", "μ = 0.4", "μ = 0.7")},
        by_hand=stopping,
        in_engine=sliding.stopping_box,
    ),
    Published(
        number=8,
        title="A fast sliding cube stops",
        statement=24,
        kind="verification",
        source="Project Chrono, tests of smooth contact: sliding friction",
        setup={"edge": 0.5, "speed": 5.0, "friction": 0.5, "gravity": 9.81},
        expected={"distance": 2.54842},
        tolerance={"distance": 0.0127421},
        reason="their own 0.5 %; ours is exact",
        note="v²/(2μg) for a body that does not tip; a cube does not while μ is below 1.",
        units={"distance": "m"},
        by_hand=stopping,
        in_engine=sliding.stopping_box,
    ),
    Published(
        number=10,
        title="A box on a ramp holds or slides",
        statement=24,
        kind="verification",
        source="Newton (physics engine), verification and validation of static friction",
        setup={"friction": _FRICTIONS, "slope": _SLOPES, "gravity": 9.81, "dead_band": 2.0},
        expected={
            "rests": tuple(float(angle < math.degrees(math.atan(mu))) for mu in _FRICTIONS for angle in _SLOPES)
        },
        tolerance={"rests": 0.0},
        reason="yes or no: it rests if and only if θ < atan μ; no slope lies in their dead band of 2° about that",
        note="1 for a box that rests, 0 for one that slides.",
        labels={"rests": tuple(f"μ = {mu:g}, {angle:g}°" for mu in _FRICTIONS for angle in _SLOPES)},
        by_hand=ramp,
        in_engine=sliding.ramp,
    ),
)  # fmt: skip
