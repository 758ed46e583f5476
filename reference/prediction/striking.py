"""Balls that strike balls, planes and boxes: each step of a contact, with friction and spin, and flights between."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from reference.arrays import Array
from reference.engines.base import (
    BULLET,
    BULLET_SPRING,
    DART,
    MUJOCO_ONE_STEP,
    MUJOCO_SPRING,
    RESPOND_THEN_STEP,
    WORLD,
    Method,
)
from reference.prediction import bands
from reference.prediction.bodies import Bodies, State, darts_stretch
from reference.prediction.both import ASIDE, Both, NoRule, along_its_base, points_of
from reference.prediction.impulses import InTheWorld, MuJoCos, Rule, rule_of
from reference.prediction.laws import BULLETS_PUSHED_TURN
from reference.prediction.predicted import Path, Prediction, trajectory_of
from reference.prediction.reached import is_reached
from reference.prediction.sweeps import swept
from reference.prediction.touching import Meeting, gaps, meetings, touch
from reference.scene import geometry
from reference.scene.scenario import Box, Scenario, Sphere
from reference.scene.settings import Settings

UNRESOLVED = 1.0
"""√k dt from which Bullet's spring is not resolved: at 1 a step may end exactly at the surface, and rounding decides
whether the contact continues. Up to 0.9 the rule was measured to hold."""
UNSTABLE = 2.785
"""√k dt from which the Runge-Kutta method does not follow a spring, which then throws bodies apart with any energy. In
a row each throw magnifies what is off, by up to 10¹¹ in a cradle at 5 ms."""
BESIDE = 1e-12
"""How much faster a ball begins in a second motion, m/s, that tells how much the first magnifies what is off."""
SEEN_AHEAD = 0.0347
"""Gap at which Bullet keeps a contact of a ball with a box, as a share of the radius: 0.02 √3, rounded up."""
LONGEST_FLIGHT = 2000
"""So many steps of flight are looked at together."""
UNDECIDED, TIED = 1e-12, 1e-15
"""A gap of less than this, m: rounding decides whether a step that ends there has a contact. The first holds for MuJoCo
without a margin."""
MOST_PIVOTED = 2
"""So many contacts at once DART's stock solver solves to rounding; of four, velocities were off by 7·10⁻⁴."""


def predict(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    """What the method makes of a ball and all that it strikes; None where a pair has no ball, or no rule is written."""
    bodies = Bodies(scenario, method.rule)
    found = meetings(bodies)
    rules = [rule_of(settings, method, meeting.pair) for meeting in found or ()]
    if found is None or not all(rules):
        return None
    if "margin" in settings.options and method.rule not in (MUJOCO_ONE_STEP, MUJOCO_SPRING):
        return None
    if (method.rule == RESPOND_THEN_STEP or method.in_turn) and _in_a_row(bodies, found):
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
    trajectory = trajectory_of(scenario, settings, paths)
    terms = _terms(scenario, settings, method)
    if method.rule == DART:
        terms += (darts_stretch(trajectory),)
    if method.rule == MUJOCO_ONE_STEP:
        terms += striking.of_mujoco()
    if striking.fallback:
        terms += (striking.fallback,)
    too_stiff = method.rule == MUJOCO_SPRING and method.stiffness**0.5 * settings.timestep >= UNSTABLE
    if too_stiff and _in_a_row(bodies, found):
        beside = Striking(bodies, found, striking.rules, settings, method)
        then = beside.run(settings.steps_for(scenario.duration), _beside(bodies.start(), found[0].ball))
        if then is None:
            return None
        terms += (bands.magnified(float(np.max(np.abs(then.velocity - states.velocity))) / BESIDE),)
    return Prediction(trajectory, terms)


def _in_a_row(bodies: Bodies, meetings: list[Meeting]) -> bool:
    """Whether a ball may meet two others that move, so that the impacts of a step depend on each other."""
    moving = [each for each in meetings if bodies.inverse_mass[each.ball] > 0 and bodies.inverse_mass[each.other] > 0]
    return len(moving) > 1


def _leaps(bodies: Bodies, meetings: list[Meeting], dt: float) -> bool:
    """Whether a step may carry a ball past the middle of a box, with a contact that Bullet has kept.

    Bullet keeps a contact that it has seen a little ahead, and may turn such a ball back behind the box. Without weight
    the ball flies straight, and the steps in which Bullet sees it so are known.
    """
    for meeting in meetings:
        ball, box = bodies.scenario.bodies[meeting.ball], bodies.scenario.bodies[meeting.other]
        if isinstance(box.shape, Box):
            way = np.linalg.norm(np.subtract(ball.velocity, box.velocity)) * dt
            past = way > min(box.shape.half_extents) + ball.shape.radius  # type: ignore[union-attr]
            if past and (bodies.weight.any() or _is_seen_ahead(bodies, meeting, dt)):
                return True
    return False


def _is_seen_ahead(bodies: Bodies, meeting: Meeting, dt: float) -> bool:
    """Whether a step ends where Bullet already keeps a contact, and the ball does not overlap the box yet."""
    flown = bodies.flight(bodies.start(), dt, False, round(bodies.scenario.duration / dt))
    found = gaps(bodies, flown.position, flown.orientation, meeting)
    ahead = found[: int(np.argmin(found)) + 1]
    return bool(np.any((ahead > 0) & (ahead < SEEN_AHEAD * bodies.shapes[meeting.ball].radius)))  # type: ignore[union-attr]


def _terms(scenario: Scenario, settings: Settings, method: Method) -> tuple[bands.Term, ...]:
    """What keeps an implementation from the recurrence, besides the rounding of its steps."""
    found = [bands.contact(settings.timestep)]
    if method.rule in (BULLET, BULLET_SPRING) and any(isinstance(body.shape, Box) for body in scenario.bodies):
        found.append(bands.bullets_search(min(_radii(scenario))))
    if method.rule == MUJOCO_SPRING:
        found.append(bands.mujocos_tolerance([body for body in scenario.bodies if not body.immovable]))
    if len(scenario.pairs) > 1 and method.rule == WORLD and "response" not in settings.options:
        found.append(bands.sweeps(settings.number("tolerance"), scenario))
    if len(scenario.pairs) > 1 and "solver_tolerance" in settings.options:
        found.append(bands.sweeps(settings.number("solver_tolerance"), scenario))
    return tuple(found)


def _beside(start: State, ball: int) -> State:
    """The start with one ball that is a little faster."""
    velocity = start.velocity.copy()
    velocity[ball] += BESIDE * velocity[ball] / max(float(np.linalg.norm(velocity[ball])), BESIDE)
    return start._replace(velocity=velocity)


def _radii(scenario: Scenario) -> list[float]:
    return [body.shape.radius for body in scenario.bodies if isinstance(body.shape, Sphere)]


class Striking:
    """The bodies of one scenario, stepped by one method."""

    def __init__(
        self, bodies: Bodies, meetings: list[Meeting], rules: list[Rule], settings: Settings, method: Method
    ) -> None:
        self.bodies, self.meetings, self.rules, self.dt = bodies, meetings, rules, settings.timestep
        self.in_parabolas = method.rule == MUJOCO_SPRING
        self.points = points_of(settings, method)
        self.in_a_pyramid = method.rule == DART and settings.options.get("solver", "dantzig") == "dantzig"
        self.margin = settings.number("margin") if "margin" in settings.options else 0.0
        self.reach = method.reach if method.rule == WORLD else 0.0
        self.to_rounding = method.rule in (MUJOCO_ONE_STEP, MUJOCO_SPRING) and not self.margin
        self.keeps_contacts = method.rule in (BULLET, BULLET_SPRING)
        self.carried: list[Meeting] = []
        self.pushed_turn = BULLETS_PUSHED_TURN if method.rule == BULLET else 1.0
        self.pressed = self.gripped = 0.0
        self.lasts = False
        self.fallback: bands.Term | None = None

    def run(self, steps: int, start: State | None = None) -> State | None:
        """The states after each step, start included; None where a contact leaves its plane, or a box tumbles."""
        state, done = start or self.bodies.start(), 0
        blocks = [_one(state)]
        try:
            while done < steps:
                flown = self.flight(state, min(steps - done, LONGEST_FLIGHT))
                if len(flown.position):
                    self.carried = []
                else:
                    flown = _one(self.step_with_contact(state))
                if not self.bodies.spins_steadily(state):
                    return None
                blocks.append(flown)
                done += len(flown.position)
                state = State(*(part[-1] for part in flown))
        except NoRule:
            return None
        return State(*(np.concatenate(parts) for parts in zip(*blocks, strict=True)))

    def flight(self, state: State, steps: int) -> State:
        """The steps in which no stage of the method sees an overlap, at most so many; RK4 looks half-way as well."""
        stages = 2 if self.in_parabolas else 1
        begun = self._gaps(_one(state))
        idle = (begun[:, 0] == 0) & self._together(state)
        if np.any((begun[:, 0] <= 0) & ~idle):
            return State(*(part[:0] for part in _one(state)))
        flown = self.bodies.flight(state, self.dt / stages, self.in_parabolas, stages * steps)
        found = self._gaps(flown)
        found[idle] = np.inf
        overlap = np.flatnonzero(np.any(found <= 0, axis=0))
        count = int(overlap[0]) // stages if len(overlap) else steps
        seen = found[:, : stages * count + stages]
        tied = UNDECIDED if self.to_rounding else TIED
        if np.any((np.abs(seen) < tied) & (np.abs(seen - begun) > UNDECIDED)):
            raise NoRule
        return State(*(part[stages - 1 : stages * count : stages] for part in flown))

    def _together(self, state: State) -> Array:
        """Whether the two of each pair move alike, without weight or spin, (pairs,): then those that touch stay so."""
        ways = [state.velocity[each.ball] - state.velocity[each.other] for each in self.meetings]
        return np.array([not (way.any() or self.bodies.weight.any() or state.spin.any()) for way in ways])

    def _gaps(self, states: State) -> Array:
        """The gaps of all pairs at some instants, beyond the reach of a contact, (pairs, n), m."""
        found = [gaps(self.bodies, states.position, states.orientation, each) for each in self.meetings]
        return np.asarray(np.array(found) - self.margin - self.reach)

    def step_with_contact(self, state: State) -> State:
        """The state after one step that begins with an overlap."""
        if self.in_parabolas:
            return self._runge_kutta(state)
        change, push = self.changes(state)
        velocity, spin = state.velocity + change[:, 0], state.spin + change[:, 1]
        turn = self.bodies.turned_by(spin * self.dt + push[:, 1])
        after = _moved(state, velocity * self.dt + push[:, 0], turn, velocity, spin)
        if self.keeps_contacts:
            self._check_sides(state, after)
        return after

    def _check_sides(self, before: State, after: State) -> None:
        """Refuse a step that carries a ball which has touched a box past its middle: Bullet keeps the first contact."""
        for meeting in self.meetings:
            if isinstance(self.bodies.shapes[meeting.other], Box):
                touched, then = (touch(self.bodies, state, meeting) for state in (before, after))
                if touched.gap <= 0 and touched.normal @ then.normal < 0:
                    raise NoRule

    def _runge_kutta(self, state: State) -> State:
        """MuJoCo 4.0's classical fourth order, for turns that of Munthe-Kaas, with spins in the bodies' own frames.

        A stage adds up rates of the turn θ since the start of the step. With the spin ω in the turned body's frame that
        rate is ω + θ × ω/2 + θ × (θ × ω)/12. The spins themselves MuJoCo adds up as they are in these frames.
        """
        dt, slopes, at = self.dt, [], state
        own = _into_own(state.orientation, state.spin)
        turned = np.zeros_like(own)
        for ahead in (dt / 2, dt / 2, dt, 0.0):
            change, _ = self.changes(at)
            spin, twist = _into_own(at.orientation, at.spin), _into_own(at.orientation, change[:, 1]) / dt
            aside = np.cross(turned, spin)
            slopes.append((at.velocity, spin + aside / 2 + np.cross(turned, aside) / 12, change[:, 0] / dt, twist))
            velocity, turning, pull, twist = slopes[-1]
            turned = turning * ahead
            at = _moved_in_own(state, velocity * ahead, turned, state.velocity + ahead * pull, own + ahead * twist)
        velocity, turning, pull, twist = (
            (first + 2 * (second + third) + last) / 6 for first, second, third, last in zip(*slopes, strict=True)
        )
        return _moved_in_own(state, velocity * dt, turning * dt, state.velocity + dt * pull, own + dt * twist)

    def changes(self, state: State) -> tuple[Array, Array]:
        """What a step changes of velocity and spin of each body, (bodies, 2, 3), and beside that of its pose."""
        change = np.stack([self.bodies.weight * self.dt, np.zeros_like(self.bodies.weight)], axis=1)
        touches = [(each, touch(self.bodies, state, each)) for each in self.meetings]
        near = [each for each in touches if each[1].gap <= self.reach]
        contacts = []
        for (meeting, touched), rule in zip(touches, self.rules, strict=True):
            touched = replace(touched, gap=touched.gap - self.margin)
            if touched.gap <= self.reach:
                own = meeting, touched
                if isinstance(rule, InTheWorld) and not is_reached(
                    self.bodies, state, own, near, rule.law, meeting in self.carried
                ):
                    continue
                both = Both(self.bodies, state, meeting, touched, self.points, rule.felt)
                if self.in_a_pyramid and meeting.pair.kinetic_friction > 0 and not along_its_base(both):
                    raise NoRule
                if isinstance(rule, MuJoCos) and rule.noslip and both.noslip_gives_up():
                    raise NoRule
                contacts.append((both, rule))
        before, self.carried = self.carried, []
        if not contacts:
            return change, np.zeros_like(change)
        if self.in_a_pyramid and len(contacts) > MOST_PIVOTED:
            raise NoRule
        rows, effects = (
            np.concatenate(each).reshape(2 * len(contacts), -1)
            for each in zip(*((both.rows(), both.effects()) for both, _ in contacts), strict=True)
        )
        impulses, pushes = swept(contacts, rows @ effects.T, rows @ change.ravel())
        carried = [both.meeting for (both, _), pressed in zip(contacts, impulses[1::2], strict=True) if pressed]
        self.lasts = self.lasts or any(meeting in before for meeting in carried)
        self.carried = carried
        self._count_roundings(contacts, impulses)
        if self.in_a_pyramid and len(contacts) > 1:
            self._see_fallback(contacts, rows @ effects.T, impulses)
        by_contacts = (impulses @ effects).reshape(change.shape)
        if any(_leads_aside(both, rule, by_contacts) for both, rule in contacts):
            raise NoRule
        change += by_contacts
        push = (pushes @ effects[1::2]).reshape(change.shape)
        push[:, 1] *= self.pushed_turn
        return change, push

    def _count_roundings(self, contacts: list[tuple[Both, Rule]], impulses: Array) -> None:
        """Add up what MuJoCo's noslip passes round in a step, as `bands.in_noslip` has it."""
        for (both, rule), (along, pressed) in zip(contacts, impulses.reshape(-1, 2).tolist(), strict=True):
            if isinstance(rule, MuJoCos) and rule.noslip:
                share = rule.law.impedance / (1 - rule.law.impedance)
                k_nn = both.inverse_masses[2]
                self.pressed += share * k_nn / both.inverse_mass * k_nn * pressed
                if abs(along) < both.meeting.pair.kinetic_friction * pressed:
                    self.gripped += both.inverse_mass / share / rule.impratio * abs(along)

    def _see_fallback(self, contacts: list[tuple[Both, Rule]], k: Array, impulses: Array) -> None:
        """Note where DART's solver may give up: one of two contacts touches and does not move by itself."""
        if any(abs(both.touched.gap) < UNDECIDED and abs(both.before[1]) < UNDECIDED for both, _ in contacts):
            across = k[1::2, 1::2]
            coupling = float(across[0, 1] * across[1, 0] / (across[0, 0] * across[1, 1]))
            speed = float(np.max(np.abs(impulses))) * float(np.max(self.bodies.inverse_mass))
            found = bands.darts_fallback(coupling, speed)
            self.fallback = max(self.fallback or found, found, key=lambda term: term.share)

    def of_mujoco(self) -> tuple[bands.Term, ...]:
        """What MuJoCo's solver leaves in the impacts of a run."""
        found = [bands.in_noslip(self.pressed, self.gripped)] if self.pressed else []
        if self.lasts:
            movable = [body for body in self.bodies.scenario.bodies if not body.immovable]
            found.append(bands.mujocos_warm_start(movable, self.dt))
        return tuple(found)


def _leads_aside(both: Both, rule: Rule, by_contacts: Array) -> bool:
    """Whether other contacts of a step change the slip of one across its direction, so that friction turns."""
    rough = max(both.meeting.pair.kinetic_friction, rule.least_friction) > 0
    return rough and abs(both.aside(by_contacts)) > ASIDE * float(np.max(np.abs(by_contacts)))


def _moved(state: State, way: Array, turn: Array, velocity: Array, spin: Array) -> State:
    orientation = geometry.turned(state.orientation, turn) if turn.any() else state.orientation
    return State(state.position + way, orientation, velocity, spin)


def _moved_in_own(state: State, way: Array, turn: Array, velocity: Array, spin: Array) -> State:
    """The same with turns in the frames at the start, and spins in those at the end."""
    moved = _moved(state, way, geometry.rotate(state.orientation, turn), velocity, spin)
    return moved._replace(spin=geometry.rotate(moved.orientation, spin))


def _into_own(orientation: Array, vectors: Array) -> Array:
    return geometry.rotate(geometry.opposite(orientation), vectors)


def _one(state: State) -> State:
    """The state as a block of one."""
    return State(*(part[None] for part in state))
