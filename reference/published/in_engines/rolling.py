"""Published cases of balls that roll, in the engines: set sliding, let go on a slope, dropped with a spin."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from reference import truth
from reference.catalogue import turning
from reference.catalogue.scenarios.rolling import ball_on_plane
from reference.engines.base import EXACT, Engine
from reference.published.answers import Answer, Answers, answer_within
from reference.published.case import Published
from reference.published.in_engines.scenes import ball_over_floor, gravity_of, tuned, with_gravity_of
from reference.scene.scenario import Pair
from reference.scene.trajectory import Trajectory

TWO_IMPACTS = 1.2
"""How long the spinning ball is watched, s: impacts are at 0.32 and 0.89 s, and at the second it rolls already."""
SLIPS = 0.01
"""A contact point faster than this slides for sure, m/s."""
AFTER_ROLLING = 0.2
"""How long a ball is watched after it has begun to roll, s."""


def set_sliding(case: Published, engine: Engine) -> Answers:
    """P4: the state at the published step, and when and with what the ball begins to roll."""
    friction, speed, dt = case.value("friction"), case.value("speed"), case.value("timestep")
    end, gravity = case.value("steps") * dt, gravity_of(case)
    duration = truth.rolling_start(speed, friction, gravity) + AFTER_ROLLING
    scenario = with_gravity_of(case, ball_on_plane(case.name, friction, 0.0, speed, duration, case.value("radius")))
    trajectory = engine.run(scenario, replace(tuned(engine, scenario, dt), sample_every=1))
    at = int(np.searchsorted(trajectory.times, end - dt / 2))
    lost = friction * gravity * dt / 2  # m/s: what friction takes in half a step
    gained = 2.5 * lost / case.value("radius")  # rad/s: a force F changes ω by F r/(2/5 m r²)
    early = "friction acts from the first step on, while theirs begins half a step late"
    moved = early + "; and a step moves with the velocity that it has already reduced"

    def shifted(figure: str, value: float, shift: float, reason: str) -> Answer:
        return Answer(value, shift=shift, shift_reason=reason, shift_tolerance=case.tolerance[figure])

    return {
        "position": shifted("position", float(trajectory.position("ball")[at, 0]), -2 * lost * end, moved),
        "velocity": shifted("velocity", float(trajectory.velocity("ball")[at, 0]), -lost, early),
        "spin": shifted("spin", float(trajectory.angular_velocity("ball")[at, 1]), gained, early),
        "rolls_at": Answer(_slip_ends(trajectory)),
        "rolls_with": Answer(turning.speed_along(trajectory, "ball", "plane") / speed),
    }


def _slip_ends(trajectory: Trajectory) -> float:
    """When the straight line of the slip, through its first sample and the last that slides for sure, reaches 0, s."""
    slip = turning.slip(trajectory, "ball", "plane")
    last = int(np.flatnonzero(slip > SLIPS)[-1])
    return float(trajectory.times[last] * slip[0] / (slip[0] - slip[last]))


def down_a_slope(case: Published, engine: Engine) -> Answers:
    """P13: the speed at the end, and friction from the balance of momentum, m g sin θ − m a with a = v/t."""
    friction, duration, radius, mass = case.values("friction", "duration", "radius", "mass")
    slope = math.radians(case.value("slope"))
    scenario = with_gravity_of(case, ball_on_plane(case.name, friction, slope, 0.0, duration, radius, mass))
    trajectory = engine.run(scenario, tuned(engine, scenario))
    speed = turning.speed_along(trajectory, "ball", "plane")
    pull = mass * gravity_of(case) * math.sin(slope)
    return {"speed": Answer(speed), "friction": Answer(pull - mass * speed / float(trajectory.times[-1]))}


def spinning_ball(case: Published, engine: Engine) -> Answers:
    """P17: spin and speed after two impacts. Friction acts inside the ball where an engine's contact point lies."""
    radius, e, gravity, spin = case.value("radius"), case.value("restitution"), gravity_of(case), case.value("spin")
    drop = case.value("height") - radius
    dropped = ball_over_floor(case, drop, TWO_IMPACTS, e, radius, case.value("mass"))
    floor, ball = dropped.bodies
    ball, pair = replace(ball, angular_velocity=(0.0, spin, 0.0)), Pair("ball", "floor", e, case.value("friction"))
    scenario = replace(dropped, bodies=(floor, ball), pairs=(pair,))
    settings = tuned(engine, scenario)
    method, trajectory = engine.method(scenario, settings), engine.run(scenario, settings)
    impact = truth.impact_speed(drop, gravity)
    arm = 1 - (0.0 if method.kind == EXACT else method.inset * impact * settings.timestep / radius)
    rigid, inside = (
        truth.spinning_impact(impact, radius * spin, e, case.value("friction"), share) for share in (1.0, arm)
    )
    off = 2 * np.abs(np.subtract(rigid, inside))  # the second impact, with another arm, changes less than the first
    reason = "the lever arm of friction is shorter by the overlap, or half of it, where the contact point lies inside"
    return {
        "speed": answer_within(case, "speed", turning.speed_along(trajectory, "ball", "floor"), float(off[0]), reason),
        "spin": answer_within(
            case, "spin", turning.surface_speed(trajectory, "ball") / radius, float(off[1]) / radius, reason
        ),
    }
