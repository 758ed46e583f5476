"""Closed forms of motions under forces without contact, each with its derivation, and the error of a step method.

Symbols: v velocity, a acceleration, g gravity, m mass, k stiffness, c damping, dt timestep; SI throughout.
"""

from __future__ import annotations

import cmath
import functools
import math

import numpy as np

from reference.arrays import Array

# Throws: a is constant, and "up" is along z


def flight_time(velocity: Array, acceleration: Array) -> float:
    """Time after which a thrown body is back at the height of its launch, s: v_z T + a_z T²/2 = 0."""
    return float(-2 * velocity[2] / acceleration[2])


def landing(velocity: Array, acceleration: Array) -> Array:
    """Way from the launch to where the body is back at its height, (3,), m: v T + a T²/2."""
    time = flight_time(velocity, acceleration)
    return np.asarray(velocity * time + acceleration * time**2 / 2)


def apex_time(velocity: Array, acceleration: Array) -> float:
    """When a thrown body is highest, s: half of the flight, v_z + a_z t = 0."""
    return flight_time(velocity, acceleration) / 2


def apex_height(velocity: Array, acceleration: Array) -> float:
    """How high it comes above its launch, m: v_z²/(2 ‖a_z‖)."""
    return float(-(velocity[2] ** 2) / (2 * acceleration[2]))


# Oscillators: m x″ + c x′ + k x = 0, x0 and v0 at the start


def swing(
    place: float, speed: float, stiffness: float, damping: float, mass: float, time: float
) -> tuple[float, float]:
    """Place, m, and speed, m/s, of a damped oscillator at a time, in all three regimes.

    With β = c/(2m), ω² = k/m and the root s of ω² − β², which is imaginary where the damper is strong, e^(−βt) times
    cos s t and sin(s t)/s solve the equation. The second tends to t as s → 0. Together, with C and S for them,
    x = x0 C + (v0 + β x0) S and v = v0 C − (ω² x0 + β v0) S.
    """
    beta, squared = damping / (2 * mass), stiffness / mass
    root = cmath.sqrt(squared - beta**2)
    decay = math.exp(-beta * time)
    cosine = decay * cmath.cos(root * time).real
    sine = decay * (cmath.sin(root * time) / root).real if root else decay * time
    return (
        place * cosine + (speed + beta * place) * sine,
        speed * cosine - (squared * place + beta * speed) * sine,
    )


def turning(place: float, speed: float, stiffness: float, damping: float, mass: float) -> float:
    """When an oscillator that moves outwards first turns back, s: v = 0 where S/C = v0/(ω² x0 + β v0) = r.

    So tan s t = s r, and t = r as s → 0. With an imaginary s this is the hyperbolic tangent.
    """
    beta, squared = damping / (2 * mass), stiffness / mass
    root, ratio = cmath.sqrt(squared - beta**2), speed / (squared * place + beta * speed)
    return (cmath.atan(root * ratio) / root).real if root else ratio


@functools.cache
def settling(
    place: float, speed: float, stiffness: float, damping: float, mass: float, within: float, longest: float
) -> float:
    """When an oscillator is last as far off as `within`, m, before the time `longest`, s; found by halving."""

    def outside(time: float) -> bool:
        return abs(swing(place, speed, stiffness, damping, mass, time)[0]) > within

    beyond = next((step for step in range(_GRID, -1, -1) if outside(longest * step / _GRID)), 0)
    low, high = longest * beyond / _GRID, longest * (beyond + 1) / _GRID
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if outside(middle) else (low, middle)
    return high


_GRID = 4096
"""Points at which an oscillator is looked at before the last crossing is halved."""


# Balls in a thick fluid: m dv/dt = (m − ρ_f V) g − 6πηr (v − u)


def relaxation(mass: float, radius: float, viscosity: float) -> float:
    """Time in which all but 1/e of the missing velocity is gathered, s: τ = m/(6πηr)."""
    return mass / (6 * math.pi * viscosity * radius)


def stokes_fall(mass: float, displaced: float, radius: float, viscosity: float, gravity: float) -> float:
    """Speed at which weight less buoyancy is what drag takes, m/s, down: (m − m_f) g = 6πηr v."""
    return (mass - displaced) * gravity / (6 * math.pi * viscosity * radius)


# Orbits: r″ = −μ r/r³ with μ = G (m_A + m_B), r from one body to the other


def orbit_period(half_axis: float, parameter: float) -> float:
    """Kepler's third law, s: T = 2π √(a³/μ)."""
    return 2 * math.pi * math.sqrt(half_axis**3 / parameter)


def on_the_orbit(
    half_axis: float, eccentricity: float, parameter: float, anomaly: float
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Place, m, and velocity, m/s, where the direction to the body is `anomaly`, rad, past that of the near point.

    The first number of each is towards the near point, the second along the motion there. With the half parameter
    p = a (1 − e²) the ellipse is r = p/(1 + e cos f), and the angular momentum is h = √(μ p). From r² df/dt = h the
    velocity is (−sin f, e + cos f) μ/h.
    """
    half_parameter = half_axis * (1 - eccentricity**2)
    away = half_parameter / (1 + eccentricity * math.cos(anomaly))
    scale = math.sqrt(parameter / half_parameter)
    return (
        (away * math.cos(anomaly), away * math.sin(anomaly)),
        (-scale * math.sin(anomaly), scale * (eccentricity + math.cos(anomaly))),
    )


# Driven oscillators: m x″ + c x′ + k x = F cos Ωt, after long


def steady_swing(stiffness: float, damping: float, mass: float, force: float, frequency: float) -> tuple[float, float]:
    """Amplitude, m, and lag behind the force, rad.

    With x = Re(Z e^(iΩt)) the equation says (k − m Ω² + i c Ω) Z = F. The amplitude is |Z|, and the lag −arg Z.
    """
    response = force / complex(stiffness - mass * frequency**2, damping * frequency)
    return abs(response), -cmath.phase(response)


def stepped_steady_swing(
    stiffness: float, damping: float, mass: float, force: float, frequency: float, timestep: float
) -> tuple[float, float]:
    """The same of semi-implicit Euler.

    A step gives v⁺ = (1 − γ) v + dt (F/m − ω² x) and x⁺ = x + dt v⁺, with γ = c dt/m. Three places in a row therefore
    obey x⁺⁺ − (2 − γ − ω² dt²) x⁺ + (1 − γ) x = F⁺ dt²/m, with F⁺ of the middle one. With x_n = Re(Z zⁿ) and z =
    e^(iΩdt) this gives Z = (F dt²/m)/(z − (2 − γ − ω² dt²) + (1 − γ)/z). In short steps z + 1/z − 2 = −4 sin²(Ωdt/2)
    and 1 − 1/z = 2i sin(Ωdt/2) e^(−iΩdt/2) keep their digits.
    """
    lost, squared = damping * timestep / mass, stiffness / mass * timestep**2
    half = frequency * timestep / 2
    sine = math.sin(half)
    resistance = squared - 4 * sine**2 + 2j * lost * sine * cmath.exp(-1j * half)
    response = force * timestep**2 / mass / resistance
    return abs(response), -cmath.phase(response)
