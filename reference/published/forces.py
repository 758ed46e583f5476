"""Published cases of motion under forces: free flight, dry friction, viscosity, drag beyond Stokes."""

from __future__ import annotations

import math
import warnings

import numpy as np

from reference.engines.implementation import Implementation
from reference.published import Answers, Published, said
from reference.published.in_engines import sliding

UP = np.array([0.0, 0.0, 1.0])
STILL = np.zeros(3)


def free_flight(case: Published, code: Implementation) -> Answers:
    """P14: how far steps of semi-implicit Euler end from the parabola."""
    velocity, gravity = np.array(case.values("velocity")), np.array(case.values("gravity"))
    dt, duration = case.values("timestep", "duration")
    step, place, moving = code.function("semi_implicit_euler"), STILL, velocity
    for _ in range(round(duration / dt)):
        place, moving = step(place, moving, gravity, dt)
    true, _ = code.function("ballistic_motion")(STILL, velocity, gravity, duration)
    return said(position_error=float(np.linalg.norm(place - true)))


def dry_oscillator(case: Published, code: Implementation) -> Answers:
    """P16: the first two turning points, and where it is when it has stopped."""
    start, velocity = case.values("displacement", "velocity")
    stiffness, friction, mass = case.values("stiffness", "friction", "mass")
    frequency = math.sqrt(stiffness / mass)
    # Moving up, it swings about −F/k: from there it is at this angle of the half swing
    first = math.atan2(velocity / frequency, start + friction / stiffness) / frequency
    instants = (first, first + math.pi / frequency, 100 / frequency)
    places, _ = code.function("friction_oscillator")(start, velocity, stiffness, friction, mass, instants)
    one, two, end = map(float, places)
    return said(turning_point=one, fall=abs(one) - abs(two), sticks_at=end)


def glycerol(case: Published, code: Implementation) -> Answers:
    """P20: the viscosity for which drag balances weight, with buoyancy and as on the slide without."""
    mass, radius, fluid, speed = case.values("mass", "radius", "fluid_density", "speed")
    gravity = -case.value("gravity") * UP
    weight = code.function("uniform_gravity")(mass, gravity)
    lift = code.function("buoyancy")(4 / 3 * math.pi * radius**3, fluid, gravity)
    shape = code.function("sphere_shape_factor")(radius)
    drag_at_one = code.function("stokes_drag")(-speed * UP, STILL, 1.0, shape)
    with_lift, without = (-float(force[2] / drag_at_one[2]) for force in (weight + lift, weight))
    return said(viscosity=with_lift, viscosity_without_buoyancy=without)


def sand_grain(case: Published, code: Implementation) -> Answers:
    """P25: terminal speeds, by Stokes and with more drag."""
    arguments = (*case.values("radius", "density", "fluid_density", "viscosity"), -case.value("gravity") * UP)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that it is outside Stokes' regime is what the case is about
        stokes = code.function("terminal_velocity")(*arguments)
    more = code.function("terminal_velocity_corrected")(*arguments)
    return said(speed=float(-more[2]), speed_by_stokes=float(-stokes[2]))


CASES = (
    Published(
        number=14,
        title="Free flight, position error of a first-order step",
        statement=30,
        kind="verification",
        source="Gazebo physics benchmark, boxes: a free box under gravity",
        setup={
            "velocity": (-2.0, 2.0, 8.0),
            "gravity": (0.0, 0.0, -9.8),
            "duration": 10.0,
            "timestep": 1e-3,
        },
        expected={"position_error": 0.049},
        tolerance={"position_error": 1e-9},
        reason="g·dt·T/2 exactly; ten thousand roundings of positions up to 400 m",
        note="The benchmark's box turns with ω = (.1, 5, .1); free of torque, its centre flies like a point.",
        units={"position_error": "m"},
        by_hand=free_flight,
        in_engine=sliding.free_flight,
    ),
    Published(
        number=16,
        title="Oscillator with dry friction",
        statement=23,
        kind="verification",
        source="Siconos, example FrictionOscillator",
        setup={"mass": 1.0, "stiffness": 1.0, "friction": 1.0, "displacement": 12.0, "velocity": 6.0},
        expected={"turning_point": 13.3178, "fall": 2.0, "sticks_at": 0.68218},
        tolerance={"turning_point": 5e-5, "fall": 1e-12, "sticks_at": 5e-6},
        reason="half of the last digit printed; the fall 2 μN/k of the turning points is exact",
        units={"turning_point": "m", "fall": "m", "sticks_at": "m"},
        by_hand=dry_oscillator,
        why_not={"engines": "no scenario has a spring that ties a body to a place"},
    ),
    Published(
        number=20,
        title="Viscosity of glycerol from a falling sphere",
        statement=26,
        kind="verification",
        source="Worked problem: a sphere of 205 mg and radius 1.85 mm sinks through glycerol at 39 mm/s",
        setup={
            "mass": 205e-6,
            "radius": 1.85e-3,
            "fluid_density": 1260.0,
            "speed": 0.039,
            "gravity": 9.80665,
        },
        expected={"viscosity": 1.237246, "viscosity_without_buoyancy": 1.4782},
        tolerance={"viscosity": 5e-7, "viscosity_without_buoyancy": 5e-5},
        reason="half of the last digit printed",
        note="Without buoyancy, as on slide 26, it comes out 19 % too large. Its Reynolds number is 0.147: with "
        "2.5 % more drag than Stokes' the last five of the seven digits mean nothing.",
        units={"viscosity": "Pa s", "viscosity_without_buoyancy": "Pa s"},
        by_hand=glycerol,
        why_not={"engines": "no scenario has a fluid"},
    ),
    Published(
        number=25,
        title="Terminal speed of a sand grain in water",
        statement=26,
        kind="cross-engine",
        source="Documentation of the package fluids, v_terminal",
        setup={
            "radius": 35e-6,
            "density": 2600.0,
            "fluid_density": 1000.0,
            "viscosity": 1e-3,
            "gravity": 9.80665,
        },
        expected={"speed": 0.0041425, "speed_by_stokes": 0.0042713},
        tolerance={"speed": 6e-5, "speed_by_stokes": 5e-8},
        reason="Stokes: half of the last digit printed. With a drag correlation: at Re = 0.29 that of Barati (the "
        "package's choice) has 3.1 % more drag than Stokes and that of Clift, Grace and Weber 4.6 %: 1.4 % apart.",
        note="Theory, 1 + 3/16 Re + 9/160 Re² ln(Re/2), has 4.4 % more, so that Clift, Grace and Weber are nearer.",
        units={"speed": "m/s", "speed_by_stokes": "m/s"},
        by_hand=sand_grain,
        why_not={"engines": "no scenario has a fluid"},
    ),
)
