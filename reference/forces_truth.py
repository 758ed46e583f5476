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


def stepped_throw(velocity: Array, acceleration: Array, timestep: float) -> Array:
    """Velocity, (3,), m/s, of the exact throw on which all positions of semi-implicit Euler lie.

    After n steps the velocity is v + n a dt, and the position is the sum of the velocities after each step,
    n v dt + n (n + 1) a dt²/2. With t = n dt this is (v + a dt/2) t + a t²/2. So every closed form of a throw holds,
    with v + a dt/2 for v. For the flight it gives T − dt, and for the way to the landing (1 − dt/T) times the true one:
    (v + a dt/2)(T − dt) + a (T − dt)²/2 = (T − dt)(v + a T/2).
    """
    return np.asarray(velocity + acceleration * timestep / 2)


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
    sine = decay * (cmath.sin(root * time) / root).real if abs(root) > _NO_ROOT else decay * time
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
    return (cmath.atan(root * ratio) / root).real if abs(root) > _NO_ROOT else ratio


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


def stepped_swing(stiffness: float, damping: float, mass: float, timestep: float) -> tuple[float, float]:
    """Angular frequency, rad/s, and rate of decay, 1/s, of an underdamped oscillator in steps of semi-implicit Euler.

    A step gives v⁺ = (1 − γ) v − ω² dt x and x⁺ = x + dt v⁺, with γ = c dt/m. Three places in a row therefore obey
    x⁺⁺ − (2 − γ − ω² dt²) x⁺ + (1 − γ) x = 0. With x_n = ρⁿ e^(iθn) this says ρ² = 1 − γ and
    2 ρ cos θ = 2 − γ − ω² dt². Without a damper cos θ = 1 − ω² dt²/2 and nothing decays.
    """
    lost, squared = damping * timestep / mass, stiffness / mass * timestep**2
    kept = math.sqrt(1 - lost)
    return math.acos((2 - lost - squared) / (2 * kept)) / timestep, -math.log(kept) / timestep


_NO_ROOT = 1e-6
"""Root of ω² − β², rad/s, below which sin(s t)/s is t to rounding."""
_GRID = 4096
"""Points at which an oscillator is looked at before the last crossing is halved."""


# Balls in a thick fluid: m dv/dt = (m − ρ_f V) g − 6πηr (v − u)


def relaxation(mass: float, radius: float, viscosity: float) -> float:
    """Time in which all but 1/e of the missing velocity is gathered, s: τ = m/(6πηr)."""
    return mass / (6 * math.pi * viscosity * radius)


def stokes_fall(mass: float, displaced: float, radius: float, viscosity: float, gravity: float) -> float:
    """Speed at which weight less buoyancy is what drag takes, m/s, down: (m − m_f) g = 6πηr v."""
    return (mass - displaced) * gravity / (6 * math.pi * viscosity * radius)


def stepped_drag(relaxation_time: float, timestep: float, steps: int) -> tuple[float, float]:
    """What semi-implicit Euler makes of the last speed after so many steps, and of the way, per unit of the last speed.

    Each step keeps the share q = 1 − dt/τ of what is missing, so that the speed is 1 − qⁿ. The way is dt times the sum
    of the speeds after each step, n dt − dt q (1 − qⁿ)/(1 − q) = t − τ q (1 − qⁿ).
    """
    kept = 1 - timestep / relaxation_time
    gathered = 1 - kept**steps
    return gathered, steps * timestep - relaxation_time * kept * gathered


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

    Three places in a row obey x⁺⁺ − (2 − γ − ω² dt²) x⁺ + (1 − γ) x = F⁺ dt²/m, as in `stepped_swing`, with F⁺ of the
    middle one. With x_n = Re(Z zⁿ) and z = e^(iΩdt) this gives Z = (F dt²/m)/(z − (2 − γ − ω² dt²) + (1 − γ)/z).
    """
    lost, squared = damping * timestep / mass, stiffness / mass * timestep**2
    turn = cmath.exp(1j * frequency * timestep)
    response = force * timestep**2 / mass / (turn - (2 - lost - squared) + (1 - lost) / turn)
    return abs(response), -cmath.phase(response)
