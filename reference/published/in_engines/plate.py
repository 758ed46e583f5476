"""P2 in the engines: a plate is pushed from under balls, and the balls roll on it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from reference.arrays import Array
from reference.engines.base import Engine
from reference.published.answers import Answer, Answers, answer_within
from reference.published.case import Published
from reference.published.in_engines.scenes import gravity_of
from reference.scene.forces import Force
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere
from reference.scene.settings import Option, Settings

APART = 3.0
"""Between the centres of neighbouring balls, m."""
ROUND_CONES: Mapping[str, Mapping[str, Option]] = {
    "mujoco": {"impratio": 1e-10, "noslip_iterations": 5},
    "dart": {"solver": "nsgs", "solver_tolerance": 1e-7, "solver_iterations": 200},
}
"""Settings for bodies that slide on a friction cone, by engine. In MuJoCo the convex solver is left almost no friction,
so that the noslip passes find all of it; DART has a cone only in its iterative solver."""
SQUARE_CONES: Mapping[str, Mapping[str, Option]] = {
    "pybullet": {"cone_friction": False},
    "dart": {"solver": "dantzig"},
}
"""Settings for a friction cone whose base is a square along x and y, of the engines that have one."""
NOSLIP_ERROR = 1e-3
"""What MuJoCo's noslip passes may leave of a speed, as a share; it comes to 0.01 %."""


def plate_under_balls(case: Published) -> Scenario:
    """A plate on the ground, a square of balls on it, and the push."""
    length, width, height = case.numbers("box_size")
    radius, side = case.value("ball_radius"), math.isqrt(int(case.value("balls")))
    plate = Body("plate", Box((length / 2, width / 2, height / 2)), case.value("box_mass"), (0.0, 0.0, height / 2))
    places = [APART * (place - (side - 1) / 2) for place in range(side)]
    balls = [
        Body(f"ball {x:g} {y:g}", Sphere(radius), case.value("ball_mass"), (x, y, height + radius))
        for x in places
        for y in places
    ]
    pairs = [Pair("plate", "ground", kinetic_friction=case.value("ground_friction"))]
    pairs += [Pair(ball.name, "plate", kinetic_friction=case.value("ball_friction")) for ball in balls]
    angle, push = math.radians(case.value("push_angle")), case.value("push")
    force = Force("plate", (push * math.cos(angle), push * math.sin(angle), 0.0))
    return Scenario(
        case.name,
        (Body("ground", HalfSpace()), plate, *balls),
        tuple(pairs),
        case.value("duration"),
        (0.0, 0.0, -gravity_of(case)),
        (force,),
    )


def plate(case: Published, engine: Engine) -> Answers:
    """P2: speeds at the end, and the error of a friction cone with a square base in an engine that has one.

    A plate that is pushed from under its load slides. So the settings for stacks, where nothing slides, are replaced by
    those for sliding.
    """
    scenario = plate_under_balls(case)
    settings = engine.settings(scenario, "tuned").change(timestep=case.value("timestep"))
    settings = replace(settings, sample_every=1, options={**settings.options, **ROUND_CONES.get(engine.name, {})})
    box, ball = _speeds(engine, scenario, settings)
    duration = case.value("duration")
    square = Answer(None, reason="its pyramid is a square on its edge, |x| + |y| ≤ μN, and does not hold the plate")
    if engine.name in SQUARE_CONES:
        squared = replace(settings, options={**settings.options, **SQUARE_CONES[engine.name]})
        square = Answer(_error(case, *_speeds(engine, scenario, squared)))
    found = {
        "box_speed": float(box[-1]),
        "ball_speed": float(ball[-1]),
        "box_acceleration": float(box[-1]) / duration,
        "ball_acceleration": float(ball[-1]) / duration,
    }
    share = NOSLIP_ERROR if "noslip_iterations" in settings.options else 0.0
    reason = "0.1 %, as for all that slides here: a few passes over the contacts find the friction, one after another"
    return {name: answer_within(case, name, value, share * value, reason) for name, value in found.items()} | {
        "square_cone_error": square
    }


def _speeds(engine: Engine, scenario: Scenario, settings: Settings) -> tuple[Array, Array]:
    """Speed of the plate and mean speed of the balls at each sample, (n,) each, m/s."""
    speeds = np.linalg.norm(engine.run(scenario, settings).velocities, axis=-1)
    return speeds[:, 1], np.mean(speeds[:, 2:], axis=1)


def _error(case: Published, box: Array, ball: Array) -> float:
    """Mean of the squared errors of both speeds, before each step."""
    times = case.value("timestep") * np.arange(len(box) - 1)
    errors = [
        speed[:-1] - case.expected[name] * times
        for speed, name in ((box, "box_acceleration"), (ball, "ball_acceleration"))
    ]
    return float(np.mean(errors[0] ** 2 + errors[1] ** 2))
