"""Balls that strike balls, planes and boxes: each step of a contact, with friction and spin, and flights between."""

from __future__ import annotations

import numpy as np

from reference.arrays import Array
from reference.engines.base import BULLET, BULLET_SPRING, DART, MUJOCO_SPRING, RESPOND_THEN_STEP, Method
from reference.impact_truth import Contact
from reference.prediction.bodies import Bodies, State
from reference.prediction.impulses import Given, Met, Rule, rule_of
from reference.prediction.predicted import ROUNDING, Path, Prediction, trajectory_of
from reference.prediction.touching import Meeting, Touch, gaps, meetings, touch
from reference.scene import geometry
from reference.scene.scenario import Box, Scenario, Sphere
from reference.scene.settings import Settings

SOLVED = 1e-7
"""How near MuJoCo's solver comes in a spring's contact, as a share: 2·10⁻⁸ at most was measured, of a rod's spin."""
HEAVIER, SOLVED_WITH_A_HEAVY_BODY = 1e3, 1.5e-4
"""The same where one body is more than so many times heavier than another: 9.3·10⁻⁵ was measured at 10⁶ times."""
UNRESOLVED = 1.0
"""√k dt from which Bullet's spring is not resolved: at 1 a step may end exactly at the surface, and rounding decides
whether the contact continues. Up to 0.9 the rule was measured to hold."""
LONGEST_FLIGHT = 2000
"""So many steps of flight are looked at together."""
MOST_SWEEPS = 100
"""Several contacts of one step are gone through in turn until none changes; so often at most."""
BULLETS_PUSHED_TURN = 0.1
"""Share of the turn of a push that Bullet carries out; the others carry out all of it."""
OWN, DEEPEST, FLAT, MIDWAY = "each on its own surface", "deepest of the ball", "on what is flat", "midway"
"""Where a method lets the impulse of an overlap act."""
LEAST_ACROSS = 1e-6
"""Sine of the angle between two directions that DART takes for parallel."""
ASIDE = 1e-9
"""A contact is in a plane if an impulse in that plane moves the bodies aside of it by no larger share than this."""


def predict(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    """What the method makes of a ball and all that it strikes; None where a pair has no ball, or no rule is written."""
    bodies = Bodies(scenario)
    found = meetings(bodies)
    rules = [rule_of(settings, method, meeting.pair) for meeting in found or ()]
    if found is None or not all(rules):
        return None
    if method.rule in (BULLET, BULLET_SPRING) and _leaps(bodies, found, settings.timestep):
        return None
    if method.rule == BULLET_SPRING and method.stiffness**0.5 * settings.timestep >= UNRESOLVED:
        return None
    striking = Striking(bodies, found, [rule for rule in rules if rule], settings, method)
    states = striking.run(settings.steps_for(scenario.duration))
    if states is None:
        return None
    parts = states.position, states.velocity, states.spin, states.orientation
    paths = {
        body.name: Path(*(each[:, place] for each in parts))
        for place, body in enumerate(scenario.bodies)
        if not body.immovable
    }
    return Prediction(trajectory_of(scenario, settings, paths), *_nearness(scenario, method))


def _leaps(bodies: Bodies, meetings: list[Meeting], dt: float) -> bool:
    """Whether a step may carry a ball past the middle of a box.

    Bullet keeps a contact that it has seen a fiftieth of the ball ahead, and may turn such a ball back behind the box.
    """
    for meeting in meetings:
        ball, box = bodies.scenario.bodies[meeting.ball], bodies.scenario.bodies[meeting.other]
        if isinstance(box.shape, Box):
            way = np.linalg.norm(np.subtract(ball.velocity, box.velocity)) * dt
            if way > min(box.shape.half_extents) + ball.shape.radius:  # type: ignore[union-attr]
                return True
    return False


def _nearness(scenario: Scenario, method: Method) -> tuple[float, str]:
    """How near an implementation must come to the recurrence, and why."""
    if method.rule != MUJOCO_SPRING:
        return ROUNDING, "the recurrence of the method, to rounding"
    masses = [body.mass for body in scenario.bodies if not body.immovable]
    if max(masses) > HEAVIER * min(masses):
        return SOLVED_WITH_A_HEAVY_BODY, "the recurrence, and MuJoCo's solver, whose tolerance grows with the mass"
    return SOLVED, "the recurrence, and the tolerance of MuJoCo's solver"


class NotInAPlane(Exception):
    """A contact with an impulse aside of the plane of its normal and its slip."""


class Striking:
    """The bodies of one scenario, stepped by one method."""

    def __init__(
        self, bodies: Bodies, meetings: list[Meeting], rules: list[Rule], settings: Settings, method: Method
    ) -> None:
        self.bodies, self.meetings, self.rules, self.dt = bodies, meetings, rules, settings.timestep
        self.in_parabolas = method.rule == MUJOCO_SPRING
        self.points = _points_of(settings, method)
        self.in_a_pyramid = method.rule == DART and settings.options.get("solver", "dantzig") == "dantzig"
        self.pushed_turn = BULLETS_PUSHED_TURN if method.rule == BULLET else 1.0

    def run(self, steps: int) -> State | None:
        """The states after each step, start included; None where a contact leaves its plane, or a box tumbles."""
        state, done = self.bodies.start(), 0
        blocks = [_one(state)]
        try:
            while done < steps:
                flown = self.flight(state, min(steps - done, LONGEST_FLIGHT))
                if not len(flown.position):
                    flown = _one(self.step_with_contact(state))
                if not self.bodies.spins_steadily(state):
                    return None
                blocks.append(flown)
                done += len(flown.position)
                state = State(*(part[-1] for part in flown))
        except NotInAPlane:
            return None
        return State(*(np.concatenate(parts) for parts in zip(*blocks, strict=True)))

    def flight(self, state: State, steps: int) -> State:
        """The steps in which no stage of the method sees an overlap, at most so many; RK4 looks half-way as well."""
        stages = 2 if self.in_parabolas else 1
        flown = self.bodies.flight(state, self.dt / stages, self.in_parabolas, stages * steps)
        begun = bool(self._overlaps(_one(state))[0])
        overlap = np.flatnonzero(self._overlaps(flown))
        count = 0 if begun else int(overlap[0]) // stages if len(overlap) else steps
        return State(*(part[stages - 1 : stages * count : stages] for part in flown))

    def _overlaps(self, states: State) -> Array:
        found = [gaps(self.bodies, states.position, states.orientation, meeting) <= 0 for meeting in self.meetings]
        return np.asarray(np.any(found, axis=0))

    def step_with_contact(self, state: State) -> State:
        """The state after one step that begins with an overlap."""
        if self.in_parabolas:
            return self._runge_kutta(state)
        change, turn, push, pushed_turn = self.changes(state)
        velocity, spin = state.velocity + change, state.spin + turn
        return _moved(state, velocity * self.dt + push, spin * self.dt + pushed_turn, velocity, spin)

    def _runge_kutta(self, state: State) -> State:
        dt, slopes, at = self.dt, [], state
        for ahead in (dt / 2, dt / 2, dt, 0.0):
            change, turn, _, _ = self.changes(at)
            slopes.append((at.velocity, at.spin, change / dt, turn / dt))
            velocity, spin, pull, twist = slopes[-1]
            then = state.velocity + ahead * pull, state.spin + ahead * twist
            at = _moved(state, velocity * ahead, spin * ahead, *then)
        velocity, spin, pull, twist = (
            (first + 2 * (second + third) + last) / 6 for first, second, third, last in zip(*slopes, strict=True)
        )
        return _moved(state, velocity * dt, spin * dt, state.velocity + dt * pull, state.spin + dt * twist)

    def changes(self, state: State) -> tuple[Array, Array, Array, Array]:
        """What a step changes of each body: velocity, spin, and, without speed, position and orientation."""
        change = self.bodies.weight * self.dt
        turn, push, pushed_turn = (np.zeros_like(change) for _ in range(3))
        contacts = []
        for meeting, rule in zip(self.meetings, self.rules, strict=True):
            touched = touch(self.bodies, state, meeting)
            if touched.gap <= 0:
                both = _Both(self.bodies, state, meeting, touched, self.points)
                if self.in_a_pyramid and meeting.pair.kinetic_friction > 0 and not _along_its_base(both):
                    raise NotInAPlane
                contacts.append((both, rule))
        given = [Given() for _ in contacts]
        for _ in range(MOST_SWEEPS):
            before = list(given)
            for number, (both, rule) in enumerate(contacts):
                both.give(-given[number].along, -given[number].pressed, change, turn)
                given[number] = rule.given(both.met(change, turn))
                both.give(given[number].along, given[number].pressed, change, turn)
            if len(contacts) < 2 or _alike(given, before):
                break
        for (both, _), each in zip(contacts, given, strict=True):
            if each.push:
                both.give(0.0, each.push / both.k(both.touched.normal, both.touched.normal), push, pushed_turn)
        return change, turn, push, pushed_turn * self.pushed_turn


class _Both:
    """The two bodies of a contact: the arms to it, and what impulses do there."""

    def __init__(self, bodies: Bodies, state: State, meeting: Meeting, touched: Touch, points: str) -> None:
        self.bodies, self.meeting, self.touched = bodies, meeting, touched
        at_ball, at_other = _points(touched, isinstance(bodies.shapes[meeting.other], Sphere), points)
        self.sides = [
            (place, point - state.position[place], bodies.inverse_inertia(state, place), sign)
            for place, point, sign in ((meeting.ball, at_ball, 1.0), (meeting.other, at_other, -1.0))
        ]
        self.velocity = sum(
            sign * (state.velocity[place] + cross(state.spin[place], arm)) for place, arm, _, sign in self.sides
        )
        self.along = self._along()

    def k(self, one: Array, other: Array) -> float:
        """What a unit impulse along a direction changes of the velocity along another one, 1/kg."""
        found = float(one @ other) * self.inverse_mass
        return found + sum(float(cross(arm, other) @ inertia @ cross(arm, one)) for _, arm, inertia, _ in self.sides)

    @property
    def inverse_mass(self) -> float:
        """Sum of the inverse masses, 1/kg."""
        return float(sum(self.bodies.inverse_mass[place] for place, *_ in self.sides))

    def _along(self) -> Array:
        """Unit vector along the slip, or where the normal impulse starts one, (3,)."""
        normal = self.touched.normal
        starts = sum(cross(inertia @ cross(arm, normal), arm) for _, arm, inertia, _ in self.sides)
        for way in (self.velocity, starts, np.eye(3)[np.argmin(np.abs(normal))]):
            slip = way - (way @ normal) * normal
            size = float(np.sqrt(slip @ slip))
            if size > ASIDE:
                along = slip / size
                break
        aside = cross(normal, along)
        if max(abs(self.k(along, aside)), abs(self.k(normal, aside))) > ASIDE * self.k(normal, normal):
            raise NotInAPlane
        return np.asarray(along)

    def give(self, along: float, pressed: float, change: Array, turn: Array) -> None:
        """Add to velocities and spins (bodies, 3) what an impulse along and across the surface makes of them."""
        impulse = along * self.along + pressed * self.touched.normal
        for place, arm, inertia, sign in self.sides:
            change[place] += sign * self.bodies.inverse_mass[place] * impulse
            turn[place] += sign * inertia @ cross(arm, impulse)

    def met(self, change: Array, turn: Array) -> Met:
        """The contact at the start of a step in which all else changes velocities and spins by so much."""
        normal, along, pair = self.touched.normal, self.along, self.meeting.pair
        contact = Contact(
            self.k(along, along),
            self.k(along, normal),
            self.k(normal, normal),
            float(self.velocity @ along),
            float(self.velocity @ normal),
            pair.kinetic_friction,
        )
        rest = sum(sign * (change[place] + cross(turn[place], arm)) for place, arm, _, sign in self.sides)
        return Met(contact, self.touched.gap, (float(rest @ along), float(rest @ normal)), self.inverse_mass)


def _points_of(settings: Settings, method: Method) -> str:
    """Where a method lets impulses act; DART leaves it to its detector, which by default is FCL."""
    if method.rule == DART and settings.options.get("detector") == "dart":
        return FLAT
    return {BULLET: OWN, BULLET_SPRING: OWN, RESPOND_THEN_STEP: DEEPEST}.get(method.rule, MIDWAY)


def _points(touched: Touch, balls: bool, points: str) -> tuple[Array, Array]:
    """The points of the ball and of the other body on which an impulse acts, (3,) each. Two balls have nothing flat."""
    if points == OWN:
        return touched.on_ball, touched.on_other
    if points == DEEPEST:
        return touched.on_ball, touched.on_ball
    if points == FLAT and not balls:
        return touched.on_other, touched.on_other
    middle = (touched.on_ball + touched.on_other) / 2
    return middle, middle


def _along_its_base(both: _Both) -> bool:
    """Whether a slip is along an axis of DART's stock pyramid; one is across the world's z, or x where z is normal."""
    first = cross(both.touched.normal, np.array([0.0, 0.0, 1.0]))
    if np.linalg.norm(first) < LEAST_ACROSS:
        first = cross(both.touched.normal, np.array([1.0, 0.0, 0.0]))
    share = abs(float(first @ both.along)) / float(np.linalg.norm(first))
    return min(share, abs(1 - share)) < ASIDE


def _moved(state: State, way: Array, turn: Array, velocity: Array, spin: Array) -> State:
    orientation = geometry.turned(state.orientation, turn) if turn.any() else state.orientation
    return State(state.position + way, orientation, velocity, spin)


def _alike(given: list[Given], before: list[Given]) -> bool:
    """Whether the impulses of all contacts are as they were, to rounding."""
    pairs = zip(given, before, strict=True)
    return all(max(abs(a.along - b.along), abs(a.pressed - b.pressed)) <= 1e-15 * abs(a.pressed) for a, b in pairs)


def _one(state: State) -> State:
    """The state as a block of one."""
    return State(*(part[None] for part in state))


def cross(a: Array, b: Array) -> Array:
    """Product a × b of two vectors (3,); NumPy's own takes ten times as long."""
    (ax, ay, az), (bx, by, bz) = a.tolist(), b.tolist()
    return np.array([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx])
