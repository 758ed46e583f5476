"""Published cases of contacts that give way: springs, dashpots, and how deep a body rests in them."""

from __future__ import annotations

import math

import numpy as np

from reference.arrays import Array
from reference.engines.implementation import Implementation
from reference.published import Answers, Published, said
from reference.published.in_engines import springs

UP = np.array([0.0, 0.0, 1.0])
_GRAVITY = 9.81
_SOLREFS = ((-100.0, -10.0), (-10.0, -10.0), (0.1, 0.8), (0.01, 0.8))
_CONTACTS = tuple((solref, impedance) for solref in _SOLREFS for impedance in (0.3, 0.9, 0.99))
"""MuJoCo's words for a spring, and how much of it is felt."""


def spring_and_dashpot(case: Published, code: Implementation) -> Answers:
    """P3: positions at the published steps, and velocities at the last two, by velocity Verlet."""
    found = granular(case, code, adhesive=True)
    return said(position=tuple(found[:, 0].tolist()), velocity=tuple(found[1:, 1].tolist()))


def granular(case: Published, code: Implementation, adhesive: bool) -> Array:
    """Position and velocity at each of the published steps; adhesive: the dashpot may pull."""
    stiffness, dt, gravity = case.values("stiffness", "timestep", "gravity")
    radius = case.value("diameter") / 2
    mass = case.value("density") * 4 / 3 * math.pi * radius**3
    damping = code.function("penalty_damping")(case.value("restitution"), mass, stiffness, adhesive=True)
    penalty = code.function("penalty_force")

    def acceleration(z: float, v: float) -> float:
        return float(penalty(z - radius, v, UP, stiffness, damping, adhesive)[2]) / mass - gravity

    z, v, found = case.value("height"), 0.0, []
    a = acceleration(z, v)
    for step in range(1, int(max(case.values("steps"))) + 1):
        middle = v + a * dt / 2
        z += middle * dt
        a = acceleration(z, middle)
        v = middle + a * dt / 2
        if step in case.values("steps"):
            found.append((z, v))
    return np.array(found)


def rest_depths(case: Published, code: Implementation) -> Answers:
    """P9: how deep a body of 1 kg rests in a spring that is 1/(1 − d) as stiff."""
    stiffness, impedance = np.array(case.values("stiffness")), np.array(case.values("impedance"))
    depths = code.function("penalty_rest_depth")(1.0, case.value("gravity"), stiffness / (1 - impedance))
    return said(depth=tuple(depths.tolist()))


def undamped_spring(case: Published, code: Implementation) -> Answers:
    """P18: the lowest position and the largest speed of a drop on a spring, by velocity Verlet."""
    mass, stiffness, contact, gravity = case.values("mass", "stiffness", "contact", "gravity")
    penalty, verlet = code.function("penalty_force"), code.function("velocity_verlet")

    def acceleration(position: Array, velocity: Array) -> Array:
        force: Array = penalty(position[2] - contact, velocity[2], UP, stiffness)
        return force / mass - gravity * UP

    dt, position, velocity, lowest, fastest = 2e-4, case.value("height") * UP, 0 * UP, math.inf, 0.0
    for _ in range(round(0.7 / dt)):  # 0.43 s of fall and a good quarter of a swing
        position, velocity = verlet(position, velocity, acceleration, dt)
        lowest, fastest = min(lowest, float(position[2])), max(fastest, abs(float(velocity[2])))
    return said(lowest=lowest, fastest=fastest)


def _stiffness(first: float, second: float) -> float:
    """Of MuJoCo's solref, per unit mass, 1/s²: −k and −b, or a time constant and a damping ratio."""
    return -first if first < 0 else 1 / (first * second) ** 2


NO_SPRINGS = "its contacts have no spring and no dashpot that one could set"


CASES = (
    Published(
        3,
        "A ball drops on a spring with a dashpot that may pull",
        8,
        "cross-engine",
        "LAMMPS, unit tests of the granular package, dem02",
        {"diameter": 0.2, "density": 2600.0, "stiffness": 1e6, "restitution": 0.9, "height": 0.5, "gravity": 9.81,
         "timestep": 2e-4, "steps": (1300, 1650, 2450)},
        {"position": (0.168422, 0.1795930071, 0.4020226518), "velocity": (2.1749852792, 0.6053852792)},
        {"position": (5e-7, 1.795930071e-9, 4.020226518e-9), "velocity": (2.1749852792e-8, 6.053852792e-9)},
        "half of the last of six printed digits for the first position; a share of 1e-8 of all else, printed with ten",
        "Velocity Verlet; F = k d − 2β√(k m) v with β = −ln e/√(π² + ln² e), without a clamp. The velocities belong to "
        "the last two steps. With the clamp the ball is at 0.17994 m at step 1650, and the same β gives e = 0.902.",
        units={"position": "m", "velocity": "m/s"},
        labels={"position": ("step 1300", "step 1650", "step 2450"), "velocity": ("step 1650", "step 2450")},
        by_hand=spring_and_dashpot,
        in_engine=springs.spring_and_dashpot,
        why_not=dict.fromkeys(("pybullet", "dart"), NO_SPRINGS),
    ),
    Published(
        9,
        "How deep a body rests in a soft contact",
        8,
        "cross-engine",
        "MuJoCo, tests of the engine's constraints: four settings of solref, three impedances",
        {"gravity": _GRAVITY, "solref_first": tuple(solref[0] for solref, _ in _CONTACTS),
         "solref_second": tuple(solref[1] for solref, _ in _CONTACTS),
         "stiffness": tuple(_stiffness(*solref) for solref, _ in _CONTACTS),
         "impedance": tuple(impedance for _, impedance in _CONTACTS)},
        {"depth": tuple(_GRAVITY * (1 - d) / _stiffness(*solref) for solref, d in _CONTACTS)},
        {"depth": 1e-9},
        "a closed form, and a state that is at rest",
        "g (1 − d)/k for solref (−k, −b), g (1 − d) (t ζ)² for solref (t, ζ), with d the impedance. It is the depth "
        "m g/k of a spring that is 1/(1 − d) as stiff.",
        origin="mujoco",
        units={"depth": "m"},
        labels={"depth": tuple(f"({one:g}, {two:g}), d = {d:g}".replace("-", "−") for (one, two), d in _CONTACTS)},
        by_hand=rest_depths,
        in_engine=springs.rest_depths,
        why_not=dict.fromkeys(("pybullet", "dart"), NO_SPRINGS),
    ),
    Published(
        18,
        "A ball drops on an undamped spring",
        8,
        "verification",
        "Siconos, example CompliantContact",
        {"stiffness": 100.0, "mass": 1.0, "contact": 0.1, "height": 1.0, "gravity": 9.81},
        {"lowest": -0.4296, "fastest": 4.3151},
        {"lowest": 5e-5, "fastest": 5e-5},
        "four printed decimals",
        "The spring begins at the contact height and pushes below it.",
        units={"lowest": "m", "fastest": "m/s"},
        by_hand=undamped_spring,
        in_engine=springs.undamped_spring,
        why_not=dict.fromkeys(("pybullet", "dart"), NO_SPRINGS),
    ),
)  # fmt: skip
