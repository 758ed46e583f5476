"""A ball on a spring with a damper that an oscillating force drives: below, at and above resonance (slides 27, 29)."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from reference import forces_truth
from reference.arrays import Array
from reference.catalogue import swings
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.catalogue.scenarios.oscillator import ANCHOR, DOWN, MASS, REST_LENGTH, STIFFNESS
from reference.engines import facts
from reference.engines.base import BULLET_DAMPED, EXACT, Method
from reference.prediction import loaded
from reference.scene.forces import OscillatingForce, Spring
from reference.scene.scenario import GRAVITY, Body, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

OWN = math.sqrt(STIFFNESS / MASS)
"""Angular frequency of the spring and the ball alone, rad/s."""
DAMPING = 3.2
"""N s/m, a quarter of the critical one."""
FORCE, PHASE = 1.2, 0.6
"""Amplitude of the force along the spring, N, and its phase at the start, rad."""
LONG = REST_LENGTH + GRAVITY * MASS / STIFFNESS
"""Length of the spring where all steady forces are in balance, m."""
DURATION = 2.0
"""s, more than one swing of each force."""
SHARE, ROUNDING = 1e-3, 1e-9
"""Accepted share of a number, 0.1 %, and of one that nothing but rounding changes."""


def _driven(ratio: float) -> Case:
    """ratio: of the force's frequency to the spring's own. The ball starts in the steady oscillation of theory."""
    name, omega = f"Ω={ratio:g}ω", ratio * OWN
    amplitude, lag = forces_truth.steady_swing(STIFFNESS, DAMPING, MASS, FORCE, omega)
    place = np.array(ANCHOR) + (LONG + amplitude * math.cos(PHASE - lag)) * DOWN
    velocity = -amplitude * omega * math.sin(PHASE - lag) * DOWN
    ball = Body("ball", Sphere(0.05), MASS, tuple(place), velocity=tuple(velocity))
    spring = Spring("ball", "", STIFFNESS, REST_LENGTH, DAMPING, point_b=ANCHOR)
    force = OscillatingForce("ball", tuple(FORCE * DOWN), omega, PHASE)
    gravity = tuple(GRAVITY * DOWN)
    scenario = Scenario(f"driven-oscillator/{name}", (ball,), (), DURATION, gravity, forces=(force,), springs=(spring,))
    return Case(name, (scenario,), {"ratio": ratio, "frequency": omega})


def _wave(times: Array, values: Array, scenario: Scenario) -> complex:
    """What the last whole swing of the force makes of a value: Z of Re(Z e^(i (Ωt + φ))), by least squares."""
    force = scenario.forces[0]
    assert isinstance(force, OscillatingForce)
    late = times > times[-1] - 2 * math.pi / force.angular_frequency
    angle = force.angular_frequency * times[late] + force.phase
    waves = np.stack([np.cos(angle), -np.sin(angle), np.ones(len(angle))], axis=1)
    cosine, sine, _ = np.linalg.lstsq(waves, values[late], rcond=None)[0]
    return complex(cosine, sine)


def _stretch(trajectory: Trajectory) -> Array:
    return np.asarray(swings.length(trajectory)[0] - LONG)


def _place(trajectory: Trajectory) -> complex:
    return _wave(trajectory.times, _stretch(trajectory), trajectory.scenario)


def _speed(trajectory: Trajectory) -> complex:
    return _wave(trajectory.times, swings.length(trajectory)[1], trajectory.scenario)


def _steady(case: Case) -> tuple[float, float]:
    return forces_truth.steady_swing(STIFFNESS, DAMPING, MASS, FORCE, case.parameters["frequency"])


def _work(trajectory: Trajectory) -> float:
    """Of the force in one swing, J: its mean power is half of F times the part of the velocity in phase with it."""
    force = trajectory.scenario.forces[0]
    assert isinstance(force, OscillatingForce)
    return math.pi * FORCE * _speed(trajectory).real / force.angular_frequency


def _balance(trajectory: Trajectory) -> float:
    """What the damper takes, as a share of what the force gives: c v² on average over F v on average."""
    speed = _speed(trajectory)
    return DAMPING * abs(speed) ** 2 / (FORCE * speed.real)


Theory = Callable[[Case], float]


def _amplitude_in_theory(case: Case) -> float:
    return _steady(case)[0]


def _lag_in_theory(case: Case) -> float:
    return _steady(case)[1]


def _work_in_theory(case: Case) -> float:
    """π F A sin δ."""
    amplitude, lag = _steady(case)
    return math.pi * FORCE * amplitude * math.sin(lag)


def _one(case: Case) -> float:
    return 1.0


def _quantity(
    name: str, title: str, unit: str, read: Callable[[Trajectory], float], theory: Theory, share_of: str = ""
) -> Quantity:
    def expect(case: Case, settings: Settings, method: Method) -> Expectation:
        exact = theory(case)
        if method.kind == EXACT:
            return Expectation(exact, ROUNDING * exact, "rounding only: the motion is solved", size=exact)
        why = facts.PYBULLET_DAMPED if method.rule == BULLET_DAMPED else _LATE
        return Expectation(exact, SHARE * exact, "0.1 %", shift_reason=why, size=exact)

    return Quantity(name, title, unit, read, expect, None if theory is _one else theory, share_of=share_of)


_LATE = "semi-implicit Euler takes force, spring and damper as they were at the start of the step"

DRIVEN_OSCILLATOR = Family(
    name="driven-oscillator",
    title="Driven oscillator: resonance",
    topic="forces",
    statements=(23, 27, 29, 30),
    about="The ball of `oscillator` on its spring, with a quarter of the critical damping, is driven by a force of"
    f" {FORCE:g} N that oscillates along the spring: at half its natural frequency, at that frequency and at twice"
    " that frequency. The ball starts in the steady oscillation, so that nothing has to die away. Amplitude and lag"
    " are measured over the last period of the force.",
    expected="The steady oscillation `A cos(Ω t − δ)` has the amplitude `A = F/√((k − m Ω²)² + (c Ω)²)` and lags"
    " behind the force by δ, with `tan δ = c Ω/(k − m Ω²)`: δ is small below resonance, `π/2` at resonance, and nearly"
    " π above it. In each period the force does the work `π F A sin δ`, and the damper takes up all of it.",
    why=(
        "Semi-implicit Euler also reaches a steady oscillation, with a different amplitude and a different lag. With"
        " `z = e^(i Ω dt)` and `γ = c dt/m` its complex amplitude is `F dt²/m` over `z − 2 + γ + ω² dt² + (1 − γ)/z`."
        " At 1 ms the amplitude is 0.3 % too large at twice the natural frequency, and the lag is 0.3 % too small at"
        " resonance. The error is of first order in dt.",
        "The audit of the energy takes the force and the velocity of one sample. In a step method the velocity belongs"
        " to an instant half a step earlier. At resonance the two are in phase, and half a step hardly matters. At"
        " twice that frequency they are not: the force seems to do 2.4 % less work, and the damper seems to take 3 %"
        " more than it gets. No energy is created. The audit would have to take force and velocity at the same"
        " instant.",
        "All engines follow the recurrence to rounding. In all of them the lab applies the force at the start of each"
        " step. In MuJoCo's profile `tendons` the spring is a tendon of MuJoCo's own.",
        f"{facts.PYBULLET_DAMPS} This lowers the amplitude at resonance.",
    ),
    cases=tuple(_driven(ratio) for ratio in (0.5, 1.0, 2.0)),
    quantities=(
        _quantity("amplitude", "amplitude", "m", lambda trajectory: abs(_place(trajectory)), _amplitude_in_theory),
        _quantity("lag", "lag", "rad", lambda trajectory: -float(np.angle(_place(trajectory))), _lag_in_theory),
        _quantity("work", "work per swing", "J", _work, _work_in_theory),
        _quantity("balance", "damper", "", _balance, _one, "the work of the force"),
    ),
    curve=Curve("Ω=1ω", "Driven at resonance", "stretch, m", _stretch),
    convergence=Convergence("Ω=1ω", "amplitude", every_step=True),
    grid=Grid(
        (Parameter("ratio", "", (0.5, 0.7, 0.9, 1.0, 1.1, 1.5, 2.0), 1.0),),
        (1e-3, 5e-3),
        _driven,
    ),
    predict=loaded.predict,
)

FAMILIES = (DRIVEN_OSCILLATOR,)
