"""Decides which motions of balls that meet nothing have a closed form among the lecture's functions."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from enum import Enum

import numpy as np

from reference.arrays import Array
from reference.scene import geometry
from reference.scene.forces import Force, OscillatingForce
from reference.scene.scenario import Scenario

_ROUNDING = 1e-9  # a length (m), speed (m/s) or acceleration (m/s²) below this is zero


class Form(Enum):
    """The closed forms.

    THROW: forces are constant. DRAG: constant forces, and a fluid that slows each ball by Stokes' law. SPRING: constant
    forces, and one spring with a damper, along which alone its two ends move as seen from each other. If one end is
    fixed, a force that oscillates along the spring may drive it.
    """

    THROW = "throw"
    DRAG = "drag"
    SPRING = "spring"


@dataclass(frozen=True)
class Ends:
    """The two ends of a spring in a straight line.

    first: place of a ball among the bodies. second: the same, None where that end does not move. direction: (3,), from
    the second end to the first. length, rate: at the start, m and m/s. fixed: (3,), where the second end is.
    """

    first: int
    second: int | None
    direction: Array
    length: float
    rate: float
    fixed: Array


def form_of(scenario: Scenario) -> Form | None:
    """The closed form of a scenario; None where the lecture has none for it."""
    if not scenario.in_flight or scenario.attractions:
        return None
    if not all(isinstance(push, Force) for push in scenario.forces) and drive_of(scenario) is None:
        return None
    slowed = bool(scenario.fluid and scenario.fluid.viscosity)
    if scenario.springs:
        return None if slowed or ends_of(scenario) is None else Form.SPRING
    if slowed:
        return None if any(any(body.angular_velocity) for body in scenario.bodies) else Form.DRAG
    return Form.THROW


def ends_of(scenario: Scenario) -> Ends | None:
    """The ends of the only spring, None where it turns anything, or may become so short that it turns around."""
    if len(scenario.springs) != 1:
        return None
    spring = scenario.springs[0]
    names, points = (spring.body_a, spring.body_b), (spring.point_a, spring.point_b)
    order = (0, 1) if names[0] and not scenario.body(names[0]).immovable else (1, 0)
    places, velocities, pulls, movable = [], [], [], []
    for end in order:
        body = scenario.body(names[end]) if names[end] else None
        moves = body is not None and not body.immovable
        if moves and any(points[end]):
            return None
        turn, centre = (body.orientation, body.position) if body else ((1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
        places.append(np.array(centre) + geometry.rotate(np.array(turn), np.array(points[end])))
        velocities.append(np.array(body.velocity if body else (0.0, 0.0, 0.0)))
        pulls.append(acceleration(scenario, names[end]) if moves else np.zeros(3))
        movable.append(scenario.index(names[end]) if moves else None)
    along, moving, pull = (each[0] - each[1] for each in (places, velocities, pulls))
    length = float(np.linalg.norm(along))
    if not length or movable[0] is None:
        return None
    direction = along / length
    if max(np.linalg.norm(np.cross(each, direction)) for each in (moving, pull)) > _ROUNDING:
        return None
    ends = Ends(movable[0], movable[1], direction, length, float(moving @ direction), places[1])
    return ends if not spring.rest_length or _stays_long(scenario, ends, float(pull @ direction)) else None


def acceleration(scenario: Scenario, body: str) -> Array:
    """What weight and constant forces do to a body, (3,), m/s²."""
    pushes = [push.at(0.0) for push in scenario.forces if push.body == body and isinstance(push, Force)]
    push = np.sum([*pushes, (0.0, 0.0, 0.0)], axis=0)
    return np.asarray(np.array(scenario.gravity) + push / scenario.body(body).mass)


def reduced_mass(scenario: Scenario, ends: Ends) -> float:
    """The mass that the spring feels, kg: 1/(1/m_A + 1/m_B)."""
    both = [scenario.bodies[place].inverse_mass for place in (ends.first, ends.second) if place is not None]
    return 1 / sum(both)


def _stays_long(scenario: Scenario, ends: Ends, pull: float) -> bool:
    """Whether the energy at the start is too small to press the spring together to nothing."""
    spring, mass, drive = scenario.springs[0], reduced_mass(scenario, ends), drive_of(scenario)
    rest, driven = spring.rest_length + mass * pull / spring.stiffness, 0.0
    if drive:
        omega = drive.angular_frequency
        resistance = math.hypot(spring.stiffness - mass * omega**2, spring.damping * omega)
        if not resistance:
            return False  # driven at resonance, and nothing takes the energy away
        driven = float(np.linalg.norm(drive.amplitude)) / resistance
        driven *= 2 + omega * math.sqrt(mass / spring.stiffness)  # itself, and what the start differs from it
    swing = math.hypot(ends.length - rest, ends.rate * math.sqrt(mass / spring.stiffness))
    return swing + driven < rest


def drive_of(scenario: Scenario) -> OscillatingForce | None:
    """The only force that oscillates, if the only spring has a fixed end and the force acts along it on the other."""
    swinging = [push for push in scenario.forces if isinstance(push, OscillatingForce)]
    others = [push for push in scenario.forces if not isinstance(push, (Force, OscillatingForce))]
    if len(swinging) != 1 or others or len(scenario.springs) != 1:
        return None
    ends = ends_of(replace(scenario, forces=tuple(push for push in scenario.forces if isinstance(push, Force))))
    if ends is None or ends.second is not None or scenario.bodies[ends.first].name != swinging[0].body:
        return None
    along = np.linalg.norm(np.cross(swinging[0].amplitude, ends.direction)) < _ROUNDING
    return swinging[0] if along else None


def with_constant_forces(scenario: Scenario) -> Scenario:
    """The scenario with its constant forces alone."""
    return replace(scenario, springs=(), forces=tuple(push for push in scenario.forces if isinstance(push, Force)))
