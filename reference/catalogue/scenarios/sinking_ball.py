"""Balls that sink, rise and are carried along in a thick fluid (slide 26)."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from reference import forces_truth
from reference.arrays import Array
from reference.catalogue import measure, swings
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.engines import facts
from reference.engines.base import BULLET_DAMPED, EXACT, Method
from reference.prediction import loaded
from reference.scene.forces import NOWHERE, Fluid
from reference.scene.scenario import GRAVITY, Body, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

RADIUS, HEAVY, LIGHT = 0.08, 4.3, 2.0
"""Of the balls, m, and masses of one that sinks and of one that rises, kg."""
DENSITY, VISCOSITY = 1400.0, 200.0
"""Of the fluid, kg/m³ and Pa s: syrup's density, and as thick as peanut butter. Re is 0.08 at most, as Stokes asks."""
STREAM = (0.06, -0.03, 0.02)
"""Velocity of the fluid where it streams, m/s."""
TIME, DURATION = 0.1, 0.16
"""When the ways are read, and the end, s: some 7 and 11 times as long as a heavy ball takes to gather speed."""
SHARE, ROUNDING = 1e-3, 1e-9
"""Accepted share of a number, 0.1 %, and what rounding leaves of an exact one."""
LIFTED = DENSITY * 4 / 3 * math.pi * RADIUS**3
"""Mass of the fluid that a ball displaces, kg."""


def _sinking(mass: float, viscosity: float = VISCOSITY, streams: bool = False) -> Case:
    name = f"m={mass:g},η={viscosity:g}" + (",stream" if streams else "")
    fluid = Fluid(DENSITY, viscosity, STREAM if streams else NOWHERE)
    ball = Body("ball", Sphere(RADIUS), mass, (0.3, -0.2, 1.0))
    scenario = Scenario(f"sinking-ball/{name}", (ball,), (), DURATION, fluid=fluid)
    return Case(name, (scenario,), {"mass": mass, "viscosity": viscosity, "streams": float(streams)})


def _relaxation(case: Case) -> float:
    return forces_truth.relaxation(case.parameters["mass"], RADIUS, case.parameters["viscosity"])


def _terminal(case: Case) -> Array:
    """The velocity that the ball tends to, seen from the ground, (3,), m/s."""
    falls = forces_truth.stokes_fall(case.parameters["mass"], LIFTED, RADIUS, case.parameters["viscosity"], GRAVITY)
    return np.array([0.0, 0.0, -falls]) + case.parameters["streams"] * np.array(STREAM)


Read = Callable[[Trajectory], float]
Theory = Callable[[Case], float]


def _gathering(trajectory: Trajectory) -> float:
    """When the ball has all but 1/e of its last velocity, s."""
    velocity, last = trajectory.velocity("ball"), measure.at_end(trajectory, "ball")[1]
    left = 1 - velocity @ last / (last @ last)
    return swings.last_beyond(trajectory.times, left, math.exp(-1))


def _gathering_in_theory(case: Case) -> float:
    """1 − e^(−t/τ) is 1 − 1/e of its value at the end, which is not quite 1."""
    tau = _relaxation(case)
    return -tau * math.log(1 - (1 - math.exp(-1)) * (1 - math.exp(-_end(case) / tau)))


def _end(case: Case) -> float:
    return case.scenarios[0].duration


def _way(axis: int) -> tuple[Read, Theory]:
    def read(trajectory: Trajectory) -> float:
        way = trajectory.position("ball")[:, axis] - trajectory.position("ball")[0, axis]
        return swings.at(trajectory.times, way, TIME)

    def theory(case: Case) -> float:
        tau = _relaxation(case)
        return float(_terminal(case)[axis]) * (TIME - tau * (1 - math.exp(-TIME / tau)))

    return read, theory


def _speed(trajectory: Trajectory) -> float:
    """Down, at the time at which the ways are read."""
    return -swings.at(trajectory.times, trajectory.velocity("ball")[:, 2], TIME)


def _speed_in_theory(case: Case) -> float:
    return -float(_terminal(case)[2]) * (1 - math.exp(-TIME / _relaxation(case)))


def _quantity(name: str, title: str, unit: str, both: tuple[Read, Theory], size: Theory) -> Quantity:
    """size: what 0.1 % is taken of."""
    read, theory = both

    def expect(case: Case, settings: Settings, method: Method) -> Expectation:
        exact, large = theory(case), size(case)
        if method.kind == EXACT:
            near = (ROUNDING + swings.left_by_curve(settings, _relaxation(case))) * large
            return Expectation(exact, near, "rounding, and what a curve through six samples leaves", size=large)
        why = _LATE
        if method.rule == BULLET_DAMPED:
            why = facts.PYBULLET_DAMPED
        elif method.drag != 1:
            why = _BOX
        return Expectation(exact, SHARE * large, "0.1 %", shift_reason=why, size=large)

    return Quantity(name, title, unit, read, expect, size)


_LATE = "semi-implicit Euler takes the drag of the start of a step, and moves with the velocity of its end"
_BOX = "the box with the ball's inertia has √(3/5) of its drag"


def _size_of_way(case: Case) -> float:
    """How far the ball comes, m."""
    return float(np.linalg.norm([_way(axis)[1](case) for axis in range(3)]))


def _size_of_speed(case: Case) -> float:
    return abs(_speed_in_theory(case))


SINKING_BALL = Family(
    name="sinking-ball",
    title="Ball that sinks or rises in a thick fluid",
    topic="forces",
    statements=(23, 26, 30),
    about=f"A ball with a radius of {100 * RADIUS:g} cm is let go in a fluid of {DENSITY:g} kg/m³ and {VISCOSITY:g} Pa"
    f" s, thick enough for Stokes' law. One ball, of {HEAVY:g} kg, sinks; one of {LIGHT:g} kg rises. In a third case"
    " the fluid streams and carries the ball along.",
    expected="The velocity tends to `u + 2 (ρ_s − ρ_f) g r²/(9 η)`, where `u` is the velocity of the fluid. The"
    " difference from it falls by the factor e in each `τ = m/(6π η r)`. The slide's formula leaves out the fluid's"
    " density, and so it makes the light ball sink.",
    why=(
        "A step of semi-implicit Euler multiplies the difference from the final velocity by `1 − dt/τ` instead of"
        " `e^(−dt/τ)`. So the ball gathers speed about dt/2 too early, and gets too far by about dt times its final"
        " speed. The final speed itself is right, because there the difference is zero.",
        "Above `dt = 2 τ` the factor `1 − dt/τ` is below −1, and the speed explodes. A drag that is computed outside"
        " the engine therefore limits the timestep, here to 13 ms for the light ball.",
        "Stokes' law holds for a steady motion. A ball that gathers speed also sets fluid in motion, as much as half of"
        " the fluid that it displaces; this is its added mass. In a real fluid τ would be 35 % longer for the heavy"
        " ball and 75 % longer for the light one. The lecture leaves the added mass out, and so do theory and all"
        " implementations here.",
        "MuJoCo has two models of a fluid. The newer one, in the profile `ellipsoid`, gives exactly Stokes' drag if it"
        " is told the viscosity and not the density (`viscosity`, `wind`, `fluid_ellipsoid`), and `gravcomp` adds the"
        " lift. It gives the same numbers as the drag that the lab computes. Its older model, the profile `inertia"
        " box`, replaces a body by the box of the same inertia. A ball becomes a cube of 1.55 r, whose drag is"
        " `√(3/5)` of the right one: it sinks 29 % too fast through the fluid.",
        "The inertia box depends on how the mass is spread inside. A ball with other moments of inertia sinks at"
        " another speed, although nothing about its surface has changed.",
        "PyBullet's own `linearDamping` grows faster than the speed, so it is no drag of Stokes', and DART has no"
        " fluid. Neither has buoyancy. The lab tells both of them the force of the fluid in every step.",
    ),
    cases=(_sinking(HEAVY), _sinking(LIGHT), _sinking(HEAVY, streams=True)),
    quantities=(
        _quantity("speed", "speed of sinking", "m/s", (_speed, _speed_in_theory), _size_of_speed),
        _quantity("gathering", "gathered in", "s", (_gathering, _gathering_in_theory), _gathering_in_theory),
        _quantity("height", "height", "m", _way(2), _size_of_way),
        _quantity("along", "along x", "m", _way(0), _size_of_way),
        _quantity("aside", "along y", "m", _way(1), _size_of_way),
    ),
    curve=Curve(
        f"m={HEAVY:g},η={VISCOSITY:g}",
        "A ball of 4.3 kg sinks",
        "speed, m/s",
        lambda trajectory: -trajectory.velocity("ball")[:, 2],
    ),
    convergence=Convergence(f"m={HEAVY:g},η={VISCOSITY:g}", "height", every_step=True),
    grid=Grid(
        (
            Parameter("mass", "kg", (2.0, 3.5, 4.3), 4.3),
            Parameter("viscosity", "Pa s", (200.0, 300.0, 400.0), 200.0),
        ),
        (1e-3, 5e-3),
        _sinking,
    ),
    predict=loaded.predict,
)

FAMILIES = (SINKING_BALL,)
