"""Published springs, attractions and fluids in the engines: steps of first order, whose shift is known step by step."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from reference.arrays import Array
from reference.catalogue import measure
from reference.catalogue.scenarios.friction import slab_on_plane
from reference.engines.base import Engine
from reference.prediction import loaded
from reference.published.answers import Answer, Answers
from reference.published.case import Figure, Published, numbers_of
from reference.published.in_engines.scenes import gravity_of
from reference.published.solid_sphere import inertia_of, mass_of
from reference.scene.forces import Attraction, Fluid, Spring
from reference.scene.scenario import Body, Scenario, Sphere
from reference.scene.trajectory import Trajectory

SMALL = 0.01
"""Radius of what is a point in the case, m."""
STEPS = 900
"""How many steps of an engine make one period of the three bodies."""
COARSE = 2e-3
"""Timestep of the block on a spring, s: (ω dt)² is 6·10⁻⁵, and its figures have three digits."""
STEPPED = "steps of semi-implicit Euler, which are of first order; predicted step by step"
ROUNDING = 1e-9
"""What rounding makes of some thousands of steps, as a share of the largest number."""
SWINGS = 25.0
"""How long the oscillator with dry friction is watched, s; it stops after seven half swings, 22 s."""
SWING_STEP = 1e-2
"""Its timestep, s."""
SLAB = (5.0, 1.0, 0.001)
"""Half extents of the oscillator's slab, m: a sheet, so that friction acts near its centre and does not tip it."""
SOLVER = 1e-5
"""How far a slab may be off the three lines, m: an engine's friction stops it to its solver's residual."""
FALLS = 7
"""How many half swings the oscillator makes. Each takes 2 μN/k, and MuJoCo's contact lacks 1 − d of N, impedance d."""
RELAXED = 20
"""For how many relaxation times a grain or a sphere sinks until its speed is read."""
LEAST_INERTIA = 1e-12
"""Moment of inertia of what sinks, at least, kg m²."""
DECAY_STEPS = 50
"""Steps of an engine in each of them."""


def three_bodies(case: Published, engine: Engine) -> Answers:
    """P39: where the bodies are after a third of the period, and after all of it."""
    places, velocities = (np.reshape(case.numbers(name), (3, 2)).tolist() for name in ("places", "velocities"))
    bodies = tuple(
        Body(name, Sphere(SMALL), 1.0, (x, y, 0.0), velocity=(u, v, 0.0))
        for name, (x, y), (u, v) in zip("abc", places, velocities, strict=True)
    )
    pulls = tuple(Attraction(one, two, 1.0) for one, two in ("ab", "bc", "ca"))
    scenario = Scenario(case.name, bodies, (), case.value("period"), (0.0, 0.0, 0.0), attractions=pulls)
    run, predicted = _both(engine, scenario, case.value("period") / STEPS)
    at = {"after_a_third": STEPS // 3, "after_a_period": STEPS}
    return {
        name: _shifted(case, name, *(trajectory.positions[step, :, :2].ravel() for trajectory in (run, predicted)))
        for name, step in at.items()
    }


def block_on_spring(case: Published, engine: Engine) -> Answers:
    """P40: a ball instead of the block, which nothing touches."""
    start, duration = case.value("displacement"), 2 * case.expected_value("period")
    block = Body("block", Sphere(SMALL), case.value("mass"), (start, 0.0, 0.0))
    spring = Spring("block", "", case.value("stiffness"), 1.0, point_b=(-1.0, 0.0, 0.0))
    scenario = Scenario(case.name, (block,), (), duration, (0.0, 0.0, 0.0), springs=(spring,))
    settings = engine.settings(scenario, "tuned").change(timestep=COARSE, sample_every=1)
    run = engine.run(scenario, settings)
    place, speed = run.position("block")[:, 0], run.velocity("block")[:, 0]
    passes = np.flatnonzero(place[1:] * place[:-1] < 0)
    instants = run.times[passes] + place[passes] / (place[passes] - place[passes + 1]) * COARSE
    period = 2 * float(np.mean(np.diff(instants)))
    return {
        "angular_frequency": Answer(2 * math.pi / period),
        "period": Answer(period),
        "fastest": Answer(float(np.max(np.abs(speed)))),
        "acceleration": Answer(float(np.max(np.abs(np.diff(speed)))) / COARSE),
    }


def dry_oscillator(case: Published, engine: Engine) -> Answers:
    """P16: a slab on a floor whose friction is that of the case, tied to a place by a spring."""
    mass, stiffness, grip = case.values("mass", "stiffness", "friction")
    start, velocity = case.values("displacement", "velocity")
    friction = grip / (mass * gravity_of(case))
    scenario = slab_on_plane(case.name, friction, 0.0, velocity, SWINGS, 0.0, SLAB)
    plane, slab = scenario.bodies
    slab = replace(slab, mass=mass, position=(start, 0.0, slab.position[2]))
    spring = Spring(slab.name, "", stiffness, point_b=(0.0, 0.0, slab.position[2]))
    scenario = replace(scenario, bodies=(plane, slab), springs=(spring,))
    settings = engine.settings(scenario, "tuned").change(timestep=SWING_STEP, sample_every=1)
    run = engine.run(scenario, settings)
    soft = 1 - settings.number("impedance") if "impedance" in settings.options else 0.0
    found, predicted = (_turning_points(place) for place in (run.position(slab.name)[:, 0], _by_three_lines(case)))
    return {
        name: Answer(
            value,
            shift=expected - case.expected_value(name),
            shift_reason=STEPPED,
            shift_tolerance=SOLVER + FALLS * 2 * grip / stiffness * soft,
        )
        for (name, value), expected in zip(found.items(), predicted.values(), strict=True)
    }


def _turning_points(place: Array) -> dict[str, float]:
    """The figures of P16, from the place at each step, m."""
    moved = np.diff(place)
    moves = np.flatnonzero(moved)  # friction may stop it for a step where it turns
    turns = moves[1:][moved[moves[1:]] * moved[moves[:-1]] < 0]
    one, two = (float(place[turn]) for turn in turns[:2])
    stops = int(np.flatnonzero(np.abs(moved) > measure.REST_SPEED * SWING_STEP)[-1]) + 1
    return {"turning_point": one, "fall": abs(one) - abs(two), "sticks_at": float(place[stops])}


def _by_three_lines(case: Published) -> Array:
    """Place of the oscillator at each step, m: the spring, then friction, which stops what it can, then the motion."""
    mass, stiffness, grip = case.values("mass", "stiffness", "friction")
    place, velocity = case.values("displacement", "velocity")
    places = [place]
    for _ in range(round(SWINGS / SWING_STEP)):
        velocity -= stiffness / mass * place * SWING_STEP
        velocity -= math.copysign(min(abs(velocity), grip / mass * SWING_STEP), velocity)
        place += velocity * SWING_STEP
        places.append(place)
    return np.array(places)


def glycerol(case: Published, engine: Engine) -> Answers:
    """P20: with 1 Pa s a sphere sinks at some speed, and its drag is in proportion to the viscosity."""
    mass, radius, speed, density = case.values("mass", "radius", "speed", "fluid_density")
    found = {
        name: _sinks(case, engine, mass, radius, Fluid(fluid, 1.0)) / speed
        for name, fluid in (("viscosity", density), ("viscosity_without_buoyancy", 0.0))
    }
    return {name: Answer(value) for name, value in found.items()}


def sand_grain(case: Published, engine: Engine) -> Answers:
    """P25: the terminal speed by Stokes' law, which is the only drag of a fluid in a scenario."""
    radius, density, fluid, viscosity = case.values("radius", "density", "fluid_density", "viscosity")
    speed = _sinks(case, engine, mass_of(radius, density), radius, Fluid(fluid, viscosity))
    no_more = "the fluid of a scenario obeys Stokes' law and no other"
    return {"speed_by_stokes": Answer(speed), "speed": Answer(None, reason=no_more)}


def _sinks(case: Published, engine: Engine, mass: float, radius: float, fluid: Fluid) -> float:
    """Terminal speed of a ball that is let go, m/s."""
    relaxes = mass / (6 * math.pi * fluid.viscosity * radius)
    # nothing turns it, and MuJoCo takes no moment of inertia below 1e-15 kg m², such as that of a grain of sand
    ball = Body("ball", Sphere(radius), mass, inertia=3 * (max(inertia_of(mass, radius), LEAST_INERTIA),))
    pull = (0.0, 0.0, -gravity_of(case))
    scenario = Scenario(case.name, (ball,), (), RELAXED * relaxes, pull, fluid=fluid)
    settings = engine.settings(scenario, "tuned").change(timestep=relaxes / DECAY_STEPS)
    run = engine.run(scenario, replace(settings, sample_every=DECAY_STEPS))
    return -float(run.velocity("ball")[-1, 2])


def _both(engine: Engine, scenario: Scenario, timestep: float) -> tuple[Trajectory, Trajectory]:
    """What an engine makes of a scenario, sampled at each step, and what its steps must give."""
    settings = engine.settings(scenario, "tuned").change(timestep=timestep, sample_every=1)
    prediction = loaded.predict(scenario, settings, engine.method(scenario, settings))
    assert prediction
    return engine.run(scenario, settings), prediction.trajectory


def _shifted(case: Published, name: str, found: Array, predicted: Array) -> Answer:
    """Answer with the shift that the engine's steps make."""
    shift: Figure = tuple((predicted - numbers_of(case.expected[name])).tolist())
    near = ROUNDING * float(np.max(np.abs(predicted)))
    return Answer(tuple(found.tolist()), shift=shift, shift_reason=STEPPED, shift_tolerance=(near,) * len(found))
