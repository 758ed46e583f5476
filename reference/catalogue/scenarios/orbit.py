"""Two unequal bodies that attract each other, on a Kepler orbit: an audit of integrators (slides 25 and 30)."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from reference import forces_truth
from reference.catalogue import orbits
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.engines import facts
from reference.engines.base import BULLET_DAMPED, EXPLICIT, RUNGE_KUTTA, VERLET, Method
from reference.prediction import loaded
from reference.scene.forces import Attraction
from reference.scene.scenario import Body, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

HALF_AXIS, PARAMETER = 1.0, 4 * math.pi**2
"""Half the long axis of the relative orbit, m, and G (m_A + m_B), m³/s²: a revolution takes 1 s."""
MASS = 1.0
"""Of the lighter body, kg."""
DRIFT = np.array([0.2, -0.1, 0.05])
"""Velocity of the centre of mass, m/s."""
AXES = np.array([[2.0, 3.0, 6.0], [3.0, -6.0, 2.0]]) / 7
"""Unit vectors towards the near point and along the motion there: no number lies along an axis of the world."""
START = math.radians(120)
"""Where the bodies start, past the near point: a start at one would make it hard to say which is the first."""
DURATION = 2.2
"""s, in which the bodies are nearest twice and farthest twice or more."""
SHARE = 1e-3
"""Accepted share of a number, 0.1 %; of the energy, of the angular momentum and of a turn in rad the same."""


def _orbiting(eccentricity: float, ratio: float) -> Case:
    """ratio: of the heavier mass to the lighter one."""
    name = f"e={eccentricity:g},m={ratio:g}"
    total = (1 + ratio) * MASS
    apart, speed = (
        np.array(each) @ AXES for each in forces_truth.on_the_orbit(HALF_AXIS, eccentricity, PARAMETER, START)
    )
    bodies = tuple(
        Body(each, Sphere(0.05), mass, tuple(share * apart), velocity=tuple(DRIFT + share * speed))
        for each, mass, share in (("moon", MASS, ratio / (1 + ratio)), ("planet", ratio * MASS, -1 / (1 + ratio)))
    )
    pull = Attraction("moon", "planet", PARAMETER / total)
    scenario = Scenario(f"orbit/{name}", bodies, (), DURATION, (0.0, 0.0, 0.0), attractions=(pull,))
    return Case(name, (scenario,), {"eccentricity": eccentricity, "ratio": ratio})


def _period(case: Case) -> float:
    return forces_truth.orbit_period(HALF_AXIS, PARAMETER)


def _near(case: Case) -> float:
    return HALF_AXIS * (1 - case.parameters["eccentricity"])


def _far(case: Case) -> float:
    return HALF_AXIS * (1 + case.parameters["eccentricity"])


def _nothing(case: Case) -> float:
    return 0.0


def _quantity(
    name: str, title: str, unit: str, read: Callable[[Trajectory], float], theory: Callable[[Case], float],
    share_of: str = "",
) -> Quantity:  # fmt: skip
    kept = theory is _nothing

    def expect(case: Case, settings: Settings, method: Method) -> Expectation:
        exact = theory(case)
        large = 1.0 if kept else exact
        reason = "0.1 %" if not kept else "a thousandth: nobody sees it in a revolution"
        why = _WHY.get(method.rule, _SWINGS)
        return Expectation(exact, SHARE * large, reason, shift_reason=why, size=large)

    return Quantity(name, title, unit, read, expect, None if kept else theory, share_of=share_of)


def _distance_at(place: str) -> Callable[[Trajectory], float]:
    def read(trajectory: Trajectory) -> float:
        time = getattr(orbits.apsides(trajectory), place)[0]
        return orbits.distance_at(trajectory, time)

    return read


def _revolution(trajectory: Trajectory) -> float:
    first, second = orbits.apsides(trajectory).near
    return second - first


_SWINGS = "semi-implicit Euler moves the bodies as if they had set out with v + a dt/2, on another ellipse"
_WHY = {
    EXPLICIT: "explicit Euler adds energy in every step",
    VERLET: "velocity Verlet is of second order",
    RUNGE_KUTTA: "the Runge–Kutta method loses energy, though little",
    BULLET_DAMPED: facts.PYBULLET_DAMPED,
}

ORBIT = Family(
    name="orbit",
    title="Orbit of two unequal bodies",
    topic="forces",
    statements=(23, 25, 30),
    about="Two bodies attract each other with a force that falls with the square of their distance. They move around"
    f" each other on an ellipse of the eccentricity e whose semi-major axis is {HALF_AXIS:g} m. The lighter body has a"
    " mass of 1 kg, the heavier one m times that mass. Their centre of mass drifts, and no vector lies along an axis"
    " of the world.",
    expected="Each revolution takes `T = 2π √(a³/(G (m_A + m_B)))`, 1 s here. The distance varies between `a (1 − e)`"
    " and `a (1 + e)`, and the near point stays where it is. Energy and angular momentum are conserved.",
    why=(
        "Semi-implicit Euler conserves the angular momentum to rounding: the pull points at the other body, so that"
        " `r⁺ × v⁺ = r × v` in each step. The energy oscillates within each revolution and returns to its value, so"
        " that the orbit neither widens nor shrinks, however long the run is.",
        "Its positions are those of velocity Verlet for bodies that set out with `v + a dt/2`. They lie on another"
        " ellipse, which is a little smaller here: a revolution is 0.47 % too short at e = 0.5 and 1 ms. From the"
        " right initial velocity, velocity Verlet is of second order, and its error is 5 millionths. Both methods turn"
        " the near point by −0.16 mrad in a revolution.",
        "Explicit Euler adds energy in every step, 16 % in the revolution after the first far point at e = 0.5. The"
        " bodies drift apart, and the next revolution is up to 30 % longer. The Runge–Kutta method is nearest to"
        " theory, but it never regains the energy that it loses.",
        "PyBullet, MuJoCo and DART have no attraction between two bodies. The lab tells each of them the force in"
        " every step, and all follow the recurrence of semi-implicit Euler to 12 digits.",
        f"{facts.PYBULLET_DAMPS} The orbit shrinks, and the revolutions become shorter.",
    ),
    cases=(_orbiting(0.2, 3.0), _orbiting(0.5, 3.0), _orbiting(0.5, 1.0)),
    quantities=(
        _quantity("period", "revolution", "s", _revolution, _period),
        _quantity("near", "near point", "m", _distance_at("near"), _near),
        _quantity("far", "far point", "m", _distance_at("far"), _far),
        _quantity("turned", "turn of it", "rad", orbits.turned, _nothing),
        _quantity("energy", "energy", "", orbits.energy_gained, _nothing, "the energy, gained in a revolution"),
        _quantity(
            "momentum", "angular momentum", "", orbits.angular_momentum_gained, _nothing, "the angular momentum, gained"
        ),
    ),
    curve=Curve("e=0.5,m=3", "Distance at e = 0.5", "distance, m", orbits.distance),
    convergence=Convergence("e=0.5,m=3", "near", every_step=True),
    grid=Grid(
        (
            Parameter("eccentricity", "", (0.1, 0.2, 0.3, 0.5), 0.5),
            Parameter("ratio", "", (1.0, 3.0), 3.0, in_ratio=True),
        ),
        (1e-3, 4e-3),
        _orbiting,
    ),
    predict=loaded.predict,
)

FAMILIES = (ORBIT,)
