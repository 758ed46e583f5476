"""Bodies that fall straight on a plane, bounce and come to rest: one number, the gap, and how it changes."""

from __future__ import annotations

import math

import numpy as np

from reference.arrays import Array
from reference.engines.base import BULLET, BULLET_SPRING, CHORD, DART, MUJOCO_ONE_STEP, MUJOCO_SPRING, WORLD, Method
from reference.prediction import bands
from reference.prediction.bands import Term
from reference.prediction.laws import Law, MuJoCoOneStep, law_of
from reference.prediction.predicted import Path, Prediction, trajectory_of
from reference.scene import geometry
from reference.scene.scenario import Body, Box, Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Event

STRAIGHT = 1e-9
"""Sine of an angle, or m, that counts as none."""
BULLETS_REACH = 0.02
"""Bullet drops a contact that parts, or that a step moves, by more than this share of the radius around a body."""
BESIDE = 1e-9
"""How far beside the start a second motion begins, m, that tells how much the first magnifies what is off. A spring of
few steps a contact magnifies it the most where a step ends next to the surface."""
CORNERS = 4
"""Corners of a box that lies on a face: so many contacts share what it carries."""
ASLEEP_AFTER, ASLEEP_BELOW, AWAKE_ABOVE = 0.5, 0.01, 0.02
"""DART lets a body sleep that was slower than so many m/s for so long, s (`DeactivationOptions`), or some steps later.
It then stays where it is, with what is left of its overlap. It wakes when it is faster than the last number."""


def predict(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    """The bounces of one body above one plane, without friction or spin; None where the method has no recurrence.

    MuJoCo always has some friction, and a box that moves along Bullet's ground loses the corners that Bullet has kept.
    So in these two nothing may move along the plane.
    """
    body = next(body for body in scenario.bodies if not body.immovable)
    plane = next(body for body in scenario.bodies if body.immovable)
    normal, steps = np.array(plane.shape.normal), settings.steps_for(scenario.duration)  # type: ignore[union-attr]
    gap, rate = geometry.gap(plane, body), float(np.array(body.velocity) @ normal)
    fall = float(np.array(scenario.gravity) @ normal) * settings.timestep
    along_velocity, along = _along_the_plane(scenario, settings, method, np.array(body.velocity), normal, steps)
    if not _falls_straight(scenario, body, normal, method, float(np.max(np.abs(along)))):
        return None
    restitution, kept = scenario.pairs[0].restitution, 0.0
    law: Law | None = None
    if method.rule == CHORD:
        gaps, rates, rest = by_chords(gap, rate, fall, settings.timestep, restitution, method.rest_speed, steps)
    else:
        if isinstance(body.shape, Box) and settings.options.get("ground") == "box":
            kept = BULLETS_REACH * math.hypot(*body.shape.half_extents)
        law = law_of(settings, method, restitution, CORNERS if isinstance(body.shape, Box) else 1.0)
        if law is None:
            return None
        gaps, rates, rest = by_steps(gap, rate, fall, law, steps, kept)
    position = np.array(body.position) + (gaps - gap)[:, None] * normal + along
    velocity = rates[:, None] * normal + along_velocity
    terms = _terms(scenario, body, settings, method)
    if method.rule in (BULLET_SPRING, MUJOCO_SPRING) and law is not None:
        beside, _, _ = by_steps(gap + BESIDE, rate, fall, law, steps)
        terms.append(bands.magnified(float(np.max(np.abs(beside - gaps))) / BESIDE))
    is_tilted, rests = np.max(np.abs(normal)) < 1 - STRAIGHT, np.any((gaps <= 0) & (rates == 0))
    if method.rule == BULLET and law is not None and not law.reach and is_tilted and rests:
        terms.append(bands.dropped_at_rest(fall, settings.timestep))
    if method.rule == MUJOCO_ONE_STEP and law is not None:
        terms += _of_mujoco(body, settings, law, np.diff(rates) - fall)
    if method.rule == DART and settings.options.get("sleep") is not False and _may_sleep(scenario, settings.timestep):
        asleep = _falls_asleep(velocity, settings.timestep)
        if asleep < steps:
            position[asleep:], velocity[asleep:] = position[asleep], 0.0
            terms.append(bands.asleep(-float(gaps[asleep])))
    path = Path(position, velocity)
    events = (Event(rest, "rest", body.name),) if rest < math.inf and settings.options.get("policy") else ()
    return Prediction(trajectory_of(scenario, settings, {body.name: path}, events), tuple(terms))


def _terms(scenario: Scenario, body: Body, settings: Settings, method: Method) -> list[Term]:
    """What keeps an implementation from the recurrence, besides the rounding of its steps."""
    found = [bands.contact(settings.timestep)]
    if isinstance(body.shape, Box):
        if settings.options.get("solver") == "nsgs":
            found.append(bands.DARTS_FOUR_CORNERS)
        if method.rule == WORLD:
            found.append(bands.sweeps(settings.number("tolerance"), scenario))
    return found


def _of_mujoco(body: Body, settings: Settings, law: Law, pressed: Array) -> list[Term]:
    """What MuJoCo's solver leaves. pressed: what the contact changes of the rate in each step, (steps,), m/s."""
    found, touches = [], np.abs(pressed) > STRAIGHT * settings.timestep
    if isinstance(law, MuJoCoOneStep) and settings.options.get("noslip_iterations"):
        share = law.ease * law.impedance / (1 - law.impedance)
        found.append(bands.in_noslip(share * float(np.sum(np.abs(pressed[touches]))), 0.0))
    if np.any(touches[1:] & touches[:-1]):
        found.append(bands.mujocos_warm_start([body], settings.timestep))
    return found


def _may_sleep(scenario: Scenario, timestep: float) -> bool:
    """Whether DART's bodies stay asleep: not where what weight adds to a speed in one step already wakes them.

    With the earth's weight that is so above 2.04 ms; tried at 0.5 to 6 ms with 4, 9.81 and 20 m/s².
    """
    return math.hypot(*scenario.gravity) * timestep < AWAKE_ABOVE


def _falls_asleep(velocity: Array, dt: float) -> int:
    """After which step DART lets the body sleep, or the last one. velocity: after each step, (steps + 1, 3), m/s."""
    is_fast = np.linalg.norm(velocity, axis=-1) >= ASLEEP_BELOW
    last_fast = np.maximum.accumulate(np.where(is_fast, np.arange(len(velocity)), -1))
    for_long = np.arange(len(velocity)) - last_fast > ASLEEP_AFTER / dt
    return int(np.argmax(for_long)) if for_long.any() else len(velocity) - 1


def _falls_straight(scenario: Scenario, body: Body, normal: Array, method: Method, way: float) -> bool:
    """Whether nothing but the contact's normal impulse acts, and that not beside the centre. way: along the plane."""
    if any(body.angular_velocity) or (isinstance(body.shape, Box) and not _lies_flat(body, normal)):
        return False
    rubs = scenario.pairs[0].kinetic_friction > 0 or method.rule in (MUJOCO_ONE_STEP, MUJOCO_SPRING)
    loses_corners = isinstance(body.shape, Box) and method.rule == BULLET
    return way < STRAIGHT or not (rubs or loses_corners)


def _lies_flat(box: Body, normal: Array) -> bool:
    own = geometry.rotate(geometry.opposite(np.array(box.orientation)), normal)
    return bool(np.max(np.abs(own)) > 1 - STRAIGHT)


def _along_the_plane(
    scenario: Scenario, settings: Settings, method: Method, velocity: Array, normal: Array, steps: int
) -> tuple[Array, Array]:
    """Velocity along the plane and way along it after each step, (steps + 1, 3): nothing but weight acts there."""
    pull = np.array(scenario.gravity)
    velocity, pull = (each - (each @ normal) * normal for each in (velocity, pull))
    count, dt = np.arange(steps + 1)[:, None], settings.timestep
    in_parabolas = method.rule in (CHORD, MUJOCO_SPRING)
    fallen = count**2 / 2 if in_parabolas else count * (count + 1) / 2
    return velocity + count * dt * pull, dt * (count * velocity + dt * fallen * pull)


def predict_to_rest(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    """The same down to rest. A spring of some steps a contact makes rounding ten times larger in each: none for it."""
    return None if method.rule in (MUJOCO_SPRING, BULLET_SPRING) else predict(scenario, settings, method)


def by_steps(
    gap: float, rate: float, fall: float, law: Law, steps: int, kept: float = 0.0
) -> tuple[Array, Array, float]:
    """Gap and rate after each step, (steps + 1,), start included, and when the body rests for good, s.

    Flights are jumped over: in a step the rate gains `fall`, and the gap then changes by the new rate, so that after n
    steps it has changed by dt (n rate + fall n (n + 1)/2), or in parabolas by dt (n rate + fall n²/2).

    kept: of two boxes Bullet finds a contact only where they overlap. It keeps the contact as long as the gap is no
    larger than this, m, and as long as it does, the contact has its reach. 0 where contacts are not kept.
    """
    reach, held = law.reach, not kept
    gaps, rates, done, rest = np.empty(steps + 1), np.empty(steps + 1), 0, math.inf
    gaps[0], rates[0] = gap, rate
    while done < steps:
        flight = min(_steps_above(gap, rate, fall, law, reach if held else 0.0), steps - done)
        if flight > 0:
            count, now = np.arange(1, flight + 1), slice(done + 1, done + flight + 1)
            weight = count**2 / 2 if law.in_parabolas else count * (count + 1) / 2
            gaps[now], rates[now] = gap + law.dt * (count * rate + fall * weight), rate + fall * count
            held = not kept or (held and float(np.max(gaps[now])) <= kept)
            done, gap, rate = done + flight, float(gaps[done + flight]), float(rates[done + flight])
            continue
        before, held = (gap, rate), True
        gap, rate = law.step(gap, rate, fall)
        done += 1
        gaps[done], rates[done] = gap, rate
        if (gap, rate) == before:  # and so it stays
            gaps[done:], rates[done:], rest = gap, rate, (done - 2) * law.dt
            break
    return gaps, rates, rest


def _steps_above(gap: float, rate: float, fall: float, law: Law, reach: float) -> int:
    """How many steps of free flight end out of the contact's reach, m; none from within it."""
    gap -= reach
    if gap <= 0:
        return 0
    # gap + dt (n rate + fall n (n + b)/2) > 0, with b = 1 for Euler's steps, 0 for parabolas
    squared, linear = law.dt * fall / 2, law.dt * (rate + (0.0 if law.in_parabolas else fall / 2))
    if squared == 0:
        return math.ceil(gap / -linear) - 1 if linear < 0 else 2**53
    root = math.sqrt(linear**2 - 4 * squared * gap) if linear**2 > 4 * squared * gap else 0.0
    return max(0, math.ceil((-linear - root) / (2 * squared)) - 1)


def by_chords(
    gap: float, rate: float, fall: float, dt: float, restitution: float, rest_speed: float, steps: int
) -> tuple[Array, Array, float]:
    """The same with the slide's T: a ball flies to where the chord of its gap over what is left of a step is zero.

    One that leaves the plane and is back within the step starts and ends on it; a chord cannot see that flight.
    """
    gaps, rates, rest = np.empty(steps + 1), np.empty(steps + 1), math.inf
    gaps[0], rates[0] = gap, rate
    for done in range(steps):
        remaining = dt
        while remaining > 0 and rest == math.inf:
            after = gap + remaining * rate + fall / dt * remaining**2 / 2
            before = max(gap, 0.0)
            passed = remaining
            strikes = after <= 0 and not (before == 0 and rate > 0)
            if strikes:
                passed = remaining * before / (before - after)
            gap, rate = gap + passed * rate + fall / dt * passed**2 / 2, rate + fall / dt * passed
            remaining -= passed
            if not strikes:
                break
            rate = -restitution * rate
            if rate <= rest_speed:
                rate, rest = 0.0, done * dt + dt - remaining
        gaps[done + 1], rates[done + 1] = gap, rate
    return gaps, rates, rest
