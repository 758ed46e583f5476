"""A mesh of small balls on springs that falls onto a fixed ball: forces first, then each contact by itself.

No ball touches another one that moves, and nothing rubs. So the law of a contact along its normal, which `laws` has, is
all that a contact adds to the step of `loaded`.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from reference.arrays import Array
from reference.engines.base import STEP_THEN_PUT_OUT, WORLD, Method
from reference.prediction import bands
from reference.prediction.forces import Forces
from reference.prediction.laws import TOUCHING, ByContact, MuJoCoOneStep, law_of
from reference.prediction.predicted import Path, Prediction, trajectory_of
from reference.scene.draping import ball_under, reach
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings

Contact = Callable[[float, float, float], tuple[float, float]]
"""Gap, m, rate, m/s, and what forces add to the rate in the step → the rate after it, and the way moved besides, m."""


def predict(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    """The ways of all masses; None where the method has no rule of this kind."""
    ball = ball_under(scenario)
    contact, least = _contact_of(settings, method)
    if ball is None or contact is None:
        return None
    places = [place for place, body in enumerate(scenario.bodies) if not body.immovable]
    bodies = [scenario.bodies[place] for place in places]
    centre, dt, forces = np.array(ball.position), settings.timestep, Forces(scenario)
    met = {name for pair in scenario.pairs for name in (pair.body_a, pair.body_b)}
    near = np.array([reach(ball, body) if body.name in met else -math.inf for body in bodies])
    mass, gravity = np.array([body.mass for body in bodies])[:, None], np.array(scenario.gravity)
    state = np.array([body.state() for body in scenario.bodies])
    place, orientation, velocity, spin = np.split(state, (3, 7, 10), axis=-1)
    ways, speeds, carried = [place], [velocity], set[int]()
    for number in range(settings.steps_for(scenario.duration)):
        force, _ = forces.on_bodies(number * dt, place, orientation, velocity, spin)
        gained = dt * (gravity + force[places] / mass)
        at, moves = place[places], velocity[places]
        after, moved = moves + gained, np.zeros_like(at)
        if method.rule != STEP_THEN_PUT_OUT:
            before, carried = carried, set()
            for mass_at, normal, gap in _near(at - centre, near, least):
                away, fresh = at[mass_at] - centre, method.rule == WORLD and mass_at not in before
                if fresh and _flies_by(away, after[mass_at], float(near[mass_at]), dt):
                    continue
                rate, added = float(moves[mass_at] @ normal), float(gained[mass_at] @ normal)
                rebound, push = contact(gap, rate, added)
                after[mass_at] += (rebound - rate - added) * normal
                moved[mass_at] = push * normal
                if rebound > rate + added:
                    carried.add(mass_at)
        place, velocity = place.copy(), velocity.copy()
        at = at + dt * after + moved
        if method.rule == STEP_THEN_PUT_OUT:
            for mass_at, normal, gap in _near(at - centre, near, 0.0):
                at[mass_at] -= gap * normal
                after[mass_at] -= min(float(after[mass_at] @ normal), 0.0) * normal
        place[places], velocity[places] = at, after
        ways.append(place)
        speeds.append(velocity)
    found = np.array(ways), np.array(speeds)
    paths = {body.name: Path(*(each[:, place] for each in found)) for place, body in zip(places, bodies, strict=True)}
    return Prediction(trajectory_of(scenario, settings, paths), (bands.contact(dt),))


def _flies_by(away: Array, velocity: Array, near: float, dt: float) -> bool:
    """Whether a mass beside the ball would close its gap along the normal in a step, but passes it on a straight way.

    The hand-written world makes no contact of this, unless the contact carried the mass in the last step.
    """
    distance = float(np.linalg.norm(away))
    closes = distance - near + float(away @ velocity) / distance * dt <= TOUCHING < distance - near
    time = min(max(-float(away @ velocity) / float(velocity @ velocity), 0.0), dt) if closes else 0.0
    return closes and float(np.linalg.norm(away + time * velocity)) > near + TOUCHING


def _contact_of(settings: Settings, method: Method) -> tuple[Contact | None, float]:
    """What a method's contact does in a step, and the gap up to which there is one, m."""
    if method.rule == STEP_THEN_PUT_OUT:
        return (lambda gap, rate, added: (rate + added, 0.0)), 0.0
    law = law_of(settings, method, 0.0)
    if isinstance(law, ByContact):
        return law.contact, law.reach
    if type(law) is MuJoCoOneStep:
        known = law
        return (lambda gap, rate, added: (known.step(gap, rate, added)[1], 0.0)), law.reach
    return None, 0.0


def _near(away: Array, near: Array, least: float) -> list[tuple[int, Array, float]]:
    """The masses whose gap is at most `least`: their numbers, the normals out of the ball and the gaps, m."""
    distance = np.sqrt(np.sum(away**2, axis=-1))
    gaps = distance - near
    return [
        (place, away[place] / distance[place], float(gaps[place])) for place in np.flatnonzero(gaps <= least).tolist()
    ]
