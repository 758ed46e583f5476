"""A ball on a spring with a damper, in three regimes, and two balls on one, thrown (slides 27 and 29)."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from reference import forces_truth
from reference.arrays import Array
from reference.catalogue import swings
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.engines import facts
from reference.engines.base import BULLET_DAMPED, DART_JOINT, EXACT, MUJOCO_JOINT, Method
from reference.prediction import loaded
from reference.scene.forces import NOWHERE, Spring
from reference.scene.scenario import GRAVITY, Body, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

MASS, PARTNER = 0.64, 1.5
"""Mass of the ball, and of the one at the other end in the case of two, kg."""
STIFFNESS, REST_LENGTH = 64.0, 0.5
"""Of the spring, N/m and m. The ball on the fixed spring swings with 10 rad/s."""
STRETCH, SPEED = 0.12, 1.0
"""How far the ball is beyond the place where all forces are in balance, m, and how fast it moves on, m/s."""
DOWN = np.array([0.36, 0.48, -0.8])
"""Direction of the weight and of the spring: the whole scene is tilted, so that nothing lies along an axis."""
ANCHOR = (0.3, -0.2, 2.5)
"""Where the fixed spring ends, m."""
THROWN = (1.5, -1.0, 3.0)
"""Velocity of the centre of the two balls, m/s."""
MOMENT, SETTLED, DURATION = 0.4, 0.05, 1.4
"""When the place and the energy are read, s; the share of the stretch that counts as settled; and the end, s."""
SHARE, ROUNDING = 1e-3, 1e-9
"""Accepted share of a number, 0.1 %, and what rounding leaves of an exact one."""


def _swinging(ratio: float, two: bool = False) -> Case:
    """The case with a damping ratio, c over the least damping that keeps the spring from swinging."""
    name = f"ζ={ratio:g}" + (",two balls" if two else "")
    mass = 1 / (1 / MASS + 1 / PARTNER) if two else MASS
    damping = 2 * ratio * math.sqrt(STIFFNESS * mass)
    weight = np.zeros(3) if two else GRAVITY * DOWN
    length = REST_LENGTH + float(np.linalg.norm(weight)) * mass / STIFFNESS + STRETCH
    if two:
        parts = {"ball": PARTNER / (MASS + PARTNER), "partner": -MASS / (MASS + PARTNER)}
        places = {each: np.array(ANCHOR) + share * length * DOWN for each, share in parts.items()}
        speeds = {each: np.array(THROWN) + share * SPEED * DOWN for each, share in parts.items()}
        other, end, gravity = "partner", NOWHERE, (0.0, 0.0, -GRAVITY)
    else:
        places, speeds = {"ball": np.array(ANCHOR) + length * DOWN}, {"ball": SPEED * DOWN}
        other, end, gravity = "", ANCHOR, tuple(weight)
    masses = {"ball": MASS, "partner": PARTNER}
    bodies = tuple(
        Body(each, Sphere(0.05), masses[each], tuple(place), velocity=tuple(speeds[each]))
        for each, place in places.items()
    )
    spring = Spring("ball", other, STIFFNESS, REST_LENGTH, damping, point_b=end)
    scenario = Scenario(f"oscillator/{name}", bodies, (), DURATION, gravity, springs=(spring,))
    return Case(name, (scenario,), {"ratio": ratio, "mass": mass, "damping": damping})


def _rest(scenario: Scenario) -> float:
    """Length at which all forces are in balance, m; two balls fall alike, so that their weight stretches nothing."""
    hung = len(scenario.bodies) == 1
    return REST_LENGTH + (GRAVITY * MASS / STIFFNESS if hung else 0.0)


def _reduced(scenario: Scenario) -> float:
    return 1 / sum(body.inverse_mass for body in scenario.bodies)


def _quickest(case: Case) -> float:
    """How long the stretch f takes to change, s: 1/ω, or less, (f″/f⁽⁶⁾)^¼ at a turn, where f′ is 0."""
    square = STIFFNESS / case.parameters["mass"]
    derivative = np.array([[0.0, 1.0], [-square, -case.parameters["damping"] / case.parameters["mass"]]])
    sixth = np.linalg.matrix_power(derivative, 6)[0, 0]
    return float(min(square**-0.5, abs(-square / sixth) ** 0.25))


def _energy(place: float, speed: float, mass: float) -> float:
    """Of the swing, as a share of that at the start."""
    return (mass * speed**2 + STIFFNESS * place**2) / (mass * SPEED**2 + STIFFNESS * STRETCH**2)


@dataclass(frozen=True)
class _Number:
    """theory: motion of the oscillator → number. seen: times, stretch and its rate, and the mass → number."""

    theory: Callable[[Case], float]
    seen: Callable[[Array, Array, Array, float], float]


def _motion(case: Case) -> tuple[float, float, float, float, float]:
    return STRETCH, SPEED, STIFFNESS, case.parameters["damping"], case.parameters["mass"]


_NUMBERS = {
    "turn": _Number(
        lambda case: forces_truth.turning(*_motion(case)),
        lambda times, stretch, rate, mass: swings.first_turn(times, stretch)[0],
    ),
    "reach": _Number(
        lambda case: forces_truth.swing(*_motion(case), forces_truth.turning(*_motion(case)))[0],
        lambda times, stretch, rate, mass: swings.first_turn(times, stretch)[1],
    ),
    "settling": _Number(
        lambda case: forces_truth.settling(*_motion(case), SETTLED * STRETCH, DURATION),
        lambda times, stretch, rate, mass: swings.last_beyond(times, stretch, SETTLED * STRETCH),
    ),
    "place": _Number(
        lambda case: forces_truth.swing(*_motion(case), MOMENT)[0],
        lambda times, stretch, rate, mass: swings.at(times, stretch, MOMENT),
    ),
    "energy": _Number(
        lambda case: _energy(*forces_truth.swing(*_motion(case), MOMENT), case.parameters["mass"]),
        lambda times, stretch, rate, mass: _energy(
            swings.at(times, stretch, MOMENT), swings.at(times, rate, MOMENT), mass
        ),
    ),
}


def _quantity(name: str, title: str, unit: str, size: float | None = None, share_of: str = "") -> Quantity:
    """size: what 0.1 % is taken of, in the unit; None for the number itself."""
    number = _NUMBERS[name]

    def measure(trajectory: Trajectory) -> float:
        scenario = trajectory.scenario
        lengths, rates = swings.length(trajectory)
        return number.seen(trajectory.times, lengths - _rest(scenario), rates, _reduced(scenario))

    def large(case: Case) -> float:
        return size or abs(number.theory(case))

    def expect(case: Case, settings: Settings, method: Method) -> Expectation:
        exact = number.theory(case)
        if method.kind == EXACT:
            reason = "rounding, and what a curve through six samples leaves"
            share = ROUNDING + swings.left_by_curve(settings, _quickest(case))
            return Expectation(exact, share * large(case), reason, size=large(case))
        why = _SHIFTS.get(method.rule, _LATE)
        return Expectation(exact, SHARE * large(case), "0.1 %", shift_reason=why, size=large(case))

    return Quantity(name, title, unit, measure, expect, large if size is None else None, share_of=share_of)


_LATE = "semi-implicit Euler takes spring and damper as they were at the start of the step"
_SHIFTS = {
    BULLET_DAMPED: facts.PYBULLET_DAMPED,
    MUJOCO_JOINT: "MuJoCo takes the damper of a joint as it will be at the end of the step, and its spring as it was",
    DART_JOINT: "DART takes spring and damper of a joint as they will be at the end of the step, which slows the swing",
}


def _stretch(trajectory: Trajectory) -> Array:
    return np.asarray(swings.length(trajectory)[0] - _rest(trajectory.scenario))


OSCILLATOR = Family(
    name="oscillator",
    title="Oscillator: a spring with a damper",
    topic="forces",
    statements=(23, 27, 29, 30),
    about=f"A ball of {MASS:g} kg hangs on a spring of {STIFFNESS:g} N/m with a damper, and its weight stretches the"
    f" spring. It starts {STRETCH:g} m beyond the place where all forces balance and moves away from it at {SPEED:g}"
    " m/s. The damping ratio ζ is below 1, equal to 1 (critical damping) or above 1. The whole scene is tilted against"
    f" the axes. In one case a second ball of {PARTNER:g} kg is at the other end of the spring, and both balls are"
    " thrown.",
    expected="With `β = c/(2 m)` and `ω² = k/m` the stretch is `e^(−β t)` times a cosine and a sine of `t √(ω² − β²)`."
    " Where `β > ω` the root is imaginary, and the ball returns slowly without swinging. The weight only moves the"
    " place of balance by `m g/k`. Two balls swing with the reduced mass `1/(1/m_A + 1/m_B)`, no matter how they fly"
    " and fall.",
    why=(
        "Semi-implicit Euler takes the force of the start of a step for the whole step. Its positions are still a"
        " damped oscillation, whose angle θ per step obeys `2 ρ cos θ = 2 − c dt/m − ω² dt²`, with the factor `ρ = √(1"
        " − c dt/m)` per step. Without a damper `cos θ = 1 − ω² dt²/2` and `ρ = 1`: the swing neither grows nor"
        " decays, and is 4 millionths too fast at `ω dt = 0.01`. With a damper the decay is too fast by the share `β"
        " dt`.",
        "The first turn comes half a step early, and with a strong damper about a step early. The energy is computed"
        " from the position and the velocity of one sample, which belong to instants half a step apart. The computed"
        " energy therefore oscillates about the true energy by a share of up to `ω dt/2`, and no energy is lost.",
        "All engines and the hand-written world follow this recurrence to rounding. The lab tells the engines the"
        " force of the spring in every step. In the profile `tendons` the spring is a tendon of MuJoCo's own, and the"
        " numbers are the same: its integrator Euler treats the damping of a joint implicitly, but not that of a"
        " tendon. With the integrator RK4 its tendons come within 3 parts in 10¹⁰ of theory. Neither PyBullet nor DART"
        " has a spring of this kind.",
        "A ball that moves along its spring alone can also sit in a sliding joint that has the spring: the profile"
        " `joint` of MuJoCo and DART. An engine knows how the forces of its own joints change, and uses that. MuJoCo"
        " takes the damper as it will be at the end of the step, which halves the error at `ζ = 1`. DART takes the"
        " spring so as well. That is backward Euler, which no timestep makes explode; the price is that every step"
        " multiplies an undamped swing by `1/√(1 + ω² dt²)`. At `ω dt = 0.1` a quarter of it is lost in one swing.",
        f"{facts.PYBULLET_DAMPS} Beside the strong damper this is hardly noticeable.",
    ),
    cases=(*(_swinging(ratio) for ratio in (0.3, 1.0, 2.0)), _swinging(0.3, True)),
    quantities=(
        _quantity("turn", "first turn", "s"),
        _quantity("reach", "farthest", "m"),
        _quantity("settling", "settled", "s"),
        _quantity("place", f"after {MOMENT:g} s", "m", STRETCH),
        _quantity("energy", "energy", "", 1.0, "the energy of the swing at the start"),
    ),
    curve=Curve("ζ=0.3", "A swing at ζ = 0.3", "stretch, m", _stretch),
    convergence=Convergence("ζ=0.3", "place"),
    grid=Grid(
        (Parameter("ratio", "", (0.3, 0.5, 0.7, 1.0, 1.5, 2.0), 0.3),),
        (1e-3, 5e-3, 1e-2),
        _swinging,
    ),
    predict=loaded.predict,
)

FAMILIES = (OSCILLATOR,)
