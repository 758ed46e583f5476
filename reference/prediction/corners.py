"""A box that strikes a plane with a corner, or with two along an edge: an impact in space, between weightless flights.

Each step that begins with a corner in the plane has an impact there. Along the normal the method's law says the rate
after it, and with that rate the method's law of friction gives the impulse.
"""

from __future__ import annotations

import itertools
import math

import numpy as np

from reference.arrays import Array
from reference.engines.base import BULLET, DART, RESPOND_THEN_STEP, WORLD, Method
from reference.engines.dart_settings import SOFTNESS
from reference.impact_truth import NEWTON, POISSON, STRONGE
from reference.prediction import bands
from reference.prediction.axes import bullets_axes, darts_axes
from reference.prediction.bodies import Bodies, State, darts_stretch
from reference.prediction.both import NoRule
from reference.prediction.laws import BULLETS_PUSHED_TURN, Law, law_of
from reference.prediction.predicted import Path, Prediction, trajectory_of
from reference.scene import geometry
from reference.scene.scenario import Box, HalfSpace, Pair, Scenario
from reference.scene.settings import Settings
from reference.spatial_impact import SpatialContact, root_angle, spatial_impact

ALIKE = 1e-9
"""Two corners strike together if their gaps (m) and their velocities (m/s) differ by no more than this."""


def predict(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    """What the method makes of a box and a plane; None with weight, where corners strike apart, or without a rule."""
    pair = scenario.pairs[0]
    law = law_of(settings, method, pair.restitution)
    shapes = {type(body.shape) for body in scenario.bodies}
    a_box_and_a_plane = len(scenario.bodies) == 2 and shapes == {Box, HalfSpace} and not any(scenario.gravity)
    if law is None or not a_box_and_a_plane or not _has_a_cone(settings, method, pair):
        return None
    striking = _Corners(scenario, law, method)
    try:
        states = striking.run(settings.steps_for(scenario.duration))
    except NoRule:
        return None
    if states is None:
        return None
    position, orientation, velocity, spin = (
        np.array([part[striking.place] for part in parts]) for parts in zip(*states, strict=True)
    )
    path = Path(position, velocity, spin, orientation)
    trajectory = trajectory_of(scenario, settings, {scenario.bodies[striking.place].name: path})
    terms = [bands.contact(settings.timestep)]
    if method.law in (POISSON, STRONGE):
        terms.append(bands.FOLLOWED_IMPACT)
    if method.rule == DART:
        terms.append(darts_stretch(trajectory))
        if striking.along_an_edge:
            terms.append(bands.DARTS_TWO_CORNERS)
    if method.rule == WORLD and striking.along_an_edge:
        terms.append(bands.sweeps(settings.number("tolerance"), scenario))
    return Prediction(trajectory, tuple(terms))


def _has_a_cone(settings: Settings, method: Method, pair: Pair) -> bool:
    """Whether the rule is one of those below: DART also needs the detector that finds corners, Bullet multibodies."""
    options = settings.options
    if method.rule == DART:
        return options.get("detector") == "ode" and options.get("solver", "dantzig") != "dantzig"
    if method.rule == BULLET:
        return options["coordinates"] == "multibody" or pair.kinetic_friction == 0
    return method.rule in (RESPOND_THEN_STEP, WORLD)


class _Corners:
    """A box and a plane, stepped by one method."""

    def __init__(self, scenario: Scenario, law: Law, method: Method) -> None:
        self.bodies, self.law, self.method, self.pair = Bodies(scenario, method.rule), law, method, scenario.pairs[0]
        self.place = next(place for place, body in enumerate(scenario.bodies) if isinstance(body.shape, Box))
        box, plane = scenario.bodies[self.place], scenario.bodies[1 - self.place]
        self.foot = np.array(plane.position)
        axes_of = darts_axes if method.rule == DART else bullets_axes
        self.axes = axes_of(np.array(plane.shape.normal))  # type: ignore[union-attr]
        signs: Array = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
        self.corners = signs * np.array(box.shape.half_extents)  # type: ignore[union-attr]
        self.along_an_edge = False
        """Whether two corners have struck together."""

    def run(self, steps: int) -> list[State] | None:
        """The states after each step, start included; None where corners strike apart or the box begins to tumble."""
        states = [self.bodies.start()]
        while len(states) <= steps:
            after = self.step(states[-1])
            if after is None or not self.bodies.spins_steadily(after):
                return None
            states.append(after)
        return states

    def step(self, state: State) -> State | None:
        """The state after a step; None where the corners in the plane do not strike as one."""
        arms = geometry.rotate(state.orientation[self.place], self.corners)
        gaps = (state.position[self.place] + arms - self.foot) @ self.axes[2]
        inside = gaps <= self.law.reach
        if not inside.any():
            return self._moved(state)
        if self.method.rule == WORLD:  # whose contacts lie halfway between the two surfaces
            arms = arms - gaps[:, None] / 2 * self.axes[2]
        struck, lift = self._struck(state, arms[inside], float(np.mean(gaps[inside])))
        if np.sum(inside) > 2 or np.ptp(gaps[inside]) > ALIKE:
            return None
        if not all(self._alike(each, arms[inside]) for each in (state, struck)):
            return None
        self.along_an_edge |= bool(np.sum(inside) == 2)
        after = self._moved(struck)
        if lift == 0:
            return after
        found_in = state if self.method.rule == WORLD else after
        return self._lifted(after, found_in, np.mean(arms[inside], axis=0), lift)

    def _struck(self, state: State, ends: Array, gap: float) -> tuple[State, float]:
        """The state with the velocities after an impact at the middle of the corners, and a lift without speed, m."""
        arm = np.mean(ends, axis=0)
        k, before = self._k(state, arm), self.axes @ self._velocity(state, arm)
        rate = float(before[2])
        next_gap, wanted = self.law.step(gap, rate, 0.0)
        lift = next_gap - gap - wanted * self.law.dt
        if wanted <= rate:
            return state, lift
        if self.method.rule == DART:  # its law is softer along the normal alone; each corner is so by its own diagonal
            k = k + SOFTNESS / len(ends) * np.diag(np.diagonal(self._k(state, ends[0])))
            wanted = rate + (1 + SOFTNESS) * (wanted - rate)
        contact = SpatialContact(k, before, self.pair.kinetic_friction)
        if self.method.rule == WORLD and len(ends) == 2 and wanted > 0 and contact.friction > 0:
            return self._given(state, arm, self._of_two(contact, self._k(state, ends[0]), ends, wanted)), lift
        without_rebound = self.method.rule == WORLD and wanted <= 0  # then friction opposes the slip
        law = NEWTON if without_rebound else self.method.law
        return self._given(state, arm, spatial_impact(contact, -wanted / rate, law)), lift

    def _of_two(self, contact: SpatialContact, own: Array, ends: Array, wanted: float) -> Array:
        """The impulse of the world at both ends of an edge together, (3,), along the axes, with a rebound.

        Each end takes the friction that leaves the least energy of its own impact: as if it could give the velocity a
        u_n along the surface, with a = K_nt/K_nn of this end alone, own. Along the edge the two pull against each other
        and move nothing, and so both slip, on the edges of their cones. There friction opposes w + c μ a, where w is
        the slip less a u_n, and c how strongly the cone holds; `solutions.world.sequential` says why.
        """
        along = self.axes @ (ends[0] - ends[1])
        along /= np.linalg.norm(along)
        ahead, a = np.cross(along, [0.0, 0.0, 1.0]), own[:, 2] / own[2, 2]

        def given(angle: float) -> Array:
            push = np.array([0.0, 0.0, 1.0]) + contact.friction * math.cos(angle) * ahead
            return np.asarray((wanted - contact.before[2]) / (contact.k[2] @ push) * push)

        def opposed(angle: float) -> Array:
            """What friction in this direction has to oppose: across friction, and against it."""
            way = math.cos(angle) * ahead + math.sin(angle) * along
            rest = contact.after(given(angle)) - a * wanted
            held = max(-float(rest @ way), 0.0) / (1 + contact.friction * float(a @ way))
            rest = rest + held * contact.friction * a
            return np.array([rest @ (math.cos(angle) * along - math.sin(angle) * ahead), -rest @ way])

        impulse = given(root_angle(opposed))
        if abs(float(contact.after(impulse) @ along)) > ALIKE:
            raise NoRule  # the two no longer pull against each other alone
        return impulse

    def _k(self, state: State, arm: Array) -> Array:
        """What a unit impulse at the end of an arm changes of the velocity there, along the axes, (3, 3), 1/kg."""
        turning = np.cross(self.axes, arm)  # one row an axis: −arm × axis
        inverse_mass = float(self.bodies.inverse_mass[self.place])
        return inverse_mass * np.eye(3) + turning @ self.bodies.inverse_inertia(state, self.place) @ turning.T

    def _given(self, state: State, arm: Array, impulse: Array) -> State:
        """The state with what an impulse (3,), along the axes, makes of the velocities."""
        in_world, velocity, spin = self.axes.T @ impulse, state.velocity.copy(), state.spin.copy()
        velocity[self.place] += in_world * self.bodies.inverse_mass[self.place]
        spin[self.place] += self.bodies.inverse_inertia(state, self.place) @ np.cross(arm, in_world)
        return state._replace(velocity=velocity, spin=spin)

    def _velocity(self, state: State, arm: Array) -> Array:
        return np.asarray(state.velocity[self.place] + np.cross(state.spin[self.place], arm))

    def _alike(self, state: State, ends: Array) -> bool:
        """Whether the corners have one velocity."""
        return float(np.ptp(self._velocity(state, ends), axis=0).max()) <= ALIKE

    def _moved(self, state: State) -> State:
        """The state after a step with the velocities that it has."""
        turn = self.bodies.turned_by(state.spin * self.law.dt)
        orientation = geometry.turned(state.orientation, turn)
        return state._replace(position=state.position + state.velocity * self.law.dt, orientation=orientation)

    def _lifted(self, state: State, found_in: State, arm: Array, lift: float) -> State:
        """The state after an impulse that moves the end of an arm along the normal, and leaves no speed.

        found_in: the state whose inertia the impulse meets.
        """
        still = found_in._replace(velocity=np.zeros_like(state.velocity), spin=np.zeros_like(state.spin))
        pushed = self._given(still, arm, np.array([0.0, 0.0, lift / self._k(found_in, arm)[2, 2]]))
        share = BULLETS_PUSHED_TURN if self.method.rule == BULLET else 1.0
        orientation = geometry.turned(state.orientation, share * pushed.spin)
        return state._replace(position=state.position + pushed.velocity, orientation=orientation)
