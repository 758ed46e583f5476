"""A cube and a rod that strike the floor with a corner or an edge, off their centres (slides 12, 16 and 18)."""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from reference.arrays import Array
from reference.catalogue import measure
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.checks import Vector
from reference.engines import facts
from reference.engines.base import EXACT, Method
from reference.impact_truth import NEWTON
from reference.prediction import corners
from reference.scene import geometry
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory
from reference.spatial_impact import BY_AXES, LAWS_IN_WORDS, SpatialContact, spatial_impact

FLIGHT = 0.02034
"""Time until the box strikes, s: no whole number of steps."""
AFTER = 0.005
"""How long is watched after the impact, s: no other corner reaches the floor in that time."""
SHARE = 1e-4
"""Accepted share of the speed of approach, of the change of spin or of the energy: 0.01 %."""
BY_AXES_WHY = "the solver settles friction one axis after the other, which weights the slip that is left"
CUBE, ROD = Box((0.1, 0.1, 0.1)), Box((0.5, 0.02, 0.02))
"""Both have a mass of 1 kg."""


@dataclass(frozen=True)
class Start:
    """How a box starts: its shape, and what it has when it strikes.

    turns: about the world's x, y and z axes, one after the other, °. velocity: m/s. spin: rad/s.
    """

    shape: Box
    turns: Vector
    velocity: Vector
    spin: Vector = (0.0, 0.0, 0.0)


STARTS = {
    "edge": Start(CUBE, (0, 30, 0), (1, 0, -1)),
    "tilted edge": Start(CUBE, (8, 30, 20), (1, 0.4, -1)),
    "corner": Start(CUBE, (35, 25, 15), (1, -0.5, -1.5)),
    "spinning": Start(CUBE, (35, 25, 15), (-0.5, 0.5, -1.5), (3, -5, 4)),
    "rod": Start(ROD, (45, 25, 0), (0.5, 0, -1)),
    "rod ahead": Start(ROD, (45, 25, 0), (-0.5, 0, -1), (0, 2, 0)),
}
"""The rods are turned by 45° about their own axes first, so that one corner strikes, in a plane of symmetry."""


def _strikes(start: str, restitution: float, friction: float) -> Case:
    name = f"{start},e={restitution:g},μ={friction:g}"
    given = STARTS[start]
    then, spin = _orientation(given), np.array(given.spin)
    arm = _lowest_point(given.shape, then)
    before = geometry.turned(then, -FLIGHT * spin)
    place = (-FLIGHT * given.velocity[0], -FLIGHT * given.velocity[1], -arm[2] - FLIGHT * given.velocity[2])
    box = Body("box", given.shape, 1.0, place, tuple(before), given.velocity, given.spin)
    pair = Pair("box", "floor", restitution, friction)
    scenario = Scenario(
        f"off-centre-impact/{name}", (Body("floor", HalfSpace()), box), (pair,), FLIGHT + AFTER, (0.0, 0.0, 0.0)
    )
    return Case(name, (scenario,), {"restitution": restitution, "friction": friction})


def _orientation(start: Start) -> Array:
    """Orientation at the impact, w x y z."""
    orientation = np.array([1.0, 0.0, 0.0, 0.0])
    for axis, angle in zip(np.eye(3), start.turns, strict=True):
        orientation = geometry.turned(orientation, math.radians(angle) * axis)
    return orientation


def _lowest_point(box: Box, orientation: Array) -> Array:
    """From the centre to the lowest corner, or to the middle of the lowest edge, (3,), m."""
    signs = np.array(list(itertools.product((-1, 1), repeat=3)))
    corners = geometry.rotate(orientation, signs * np.array(box.half_extents))
    return np.asarray(np.mean(corners[corners[:, 2] < corners[:, 2].min() + 1e-9], axis=0))


@dataclass(frozen=True)
class Impact:
    """The impact as theory has it.

    arm: from the centre to the point that strikes, (3,), m. velocity, spin: of the box before, (3,), m/s and rad/s.
    inverse_inertia: (3, 3), world frame, 1/(kg m²). restitution, friction: e and μ.
    """

    arm: Array
    velocity: Array
    spin: Array
    inverse_inertia: Array
    restitution: float
    friction: float

    @classmethod
    def of(cls, scenario: Scenario, late: float = 0.0, inset: float = 0.0) -> Impact:
        """The impact of a scenario. late: by how long it is noticed too late, s. inset: how high the point lies, m."""
        box, pair = scenario.body("box"), scenario.pairs[0]
        spin = np.array(box.angular_velocity)
        at_first, then = (geometry.turned(np.array(box.orientation), time * spin) for time in (FLIGHT, FLIGHT + late))
        arm = _lowest_point(box.shape, at_first)  # type: ignore[arg-type]
        own_arm = geometry.rotate(geometry.opposite(at_first), arm)
        axes = geometry.rotate(then, np.eye(3))  # one a row
        moments: Array = np.array(box.shape.inertia_per_mass())  # type: ignore[union-attr]
        inverse: Array = axes.T @ (axes / moments[:, np.newaxis])
        where = geometry.rotate(then, own_arm) + np.array([0.0, 0.0, inset])
        return cls(where, np.array(box.velocity), spin, inverse, pair.restitution, pair.kinetic_friction)

    def result(self, law: str) -> tuple[Array, Array]:
        """Velocity and spin after the impact under a law, (3,) each, m/s and rad/s."""
        turning = np.cross(np.eye(3), self.arm)  # times an impulse: −arm × impulse
        contact = SpatialContact(
            np.eye(3) + turning @ self.inverse_inertia @ turning.T,
            self.velocity + np.cross(self.spin, self.arm),
            self.friction,
        )
        impulse = spatial_impact(contact, self.restitution, law)
        return self.velocity + impulse, self.spin + self.inverse_inertia @ np.cross(self.arm, impulse)


def numbers(scenario: Scenario, velocity: Array, spin: Array) -> dict[str, float]:
    """What is measured of the motion after the impact: parting and slip ÷ approach, change of spin, energy lost."""
    impact = Impact.of(scenario)
    approach = -(impact.velocity + np.cross(impact.spin, impact.arm))[2]
    after = (velocity + np.cross(spin, impact.arm)) / approach
    inertia = np.linalg.inv(impact.inverse_inertia)
    before, left = (v @ v + w @ inertia @ w for v, w in ((impact.velocity, impact.spin), (velocity, spin)))
    return {
        "restitution": float(after[2]),
        "slip_x": float(after[0]),
        "slip_y": float(after[1]),
        "spin": float(np.linalg.norm(spin - impact.spin)),
        "lost": float(1 - left / before),
    }


@functools.cache
def predicted(scenario: Scenario, law: str, late: float = 0.0, inset: float = 0.0) -> dict[str, float]:
    """What a law says of a scenario, measured as in a trajectory."""
    return numbers(scenario, *Impact.of(scenario, late, inset).result(law))


def _expect(name: str) -> Callable[[Case, Settings, Method], Expectation]:
    """Expect what the implementation's own law gives. Friction by axes is a known deviation from Newton's law."""

    def expect(case: Case, settings: Settings, method: Method) -> Expectation:
        law = NEWTON if method.law == BY_AXES else method.law
        exact = predicted(case.scenarios[0], law)[name]
        size = predicted(case.scenarios[0], law)["spin"] if name == "spin" else 1.0
        said = LAWS_IN_WORDS[law]
        if method.kind == EXACT:
            return Expectation(exact, 2e-8 * size, f"the digits that are sure of the integral, by {said}")
        dt, own = settings.timestep, predicted(case.scenarios[0], method.law)[name]
        deep = method.inset * dt * _approach(case)
        near = SHARE * size + max(
            abs(predicted(case.scenarios[0], method.law, *at)[name] - own) for at in ((dt, 0.0), (dt, deep))
        )
        reason = f"0.01 %, and what a step late or an overlap does to the point that strikes, by {said}"
        if method.law != BY_AXES:
            return Expectation(exact, near, reason)
        return Expectation(exact, near, reason, own - exact, BY_AXES_WHY, near)

    return expect


def _approach(case: Case) -> float:
    """Speed at which the point that strikes approaches the floor, m/s."""
    impact = Impact.of(case.scenarios[0])
    return -float((impact.velocity + np.cross(impact.spin, impact.arm))[2])


def _measured(name: str) -> Callable[[Trajectory], float]:
    def measured(trajectory: Trajectory) -> float:
        last = trajectory.velocity("box")[-1], trajectory.angular_velocity("box")[-1]
        return numbers(trajectory.scenario, *last)[name]

    return measured


def _quantity(name: str, title: str, unit: str = "") -> Quantity:
    scale = (lambda case: predicted(case.scenarios[0], NEWTON)["spin"]) if name == "spin" else None
    share_of = {"spin": "", "lost": "the energy before"}.get(name, "the speed of approach")
    return Quantity(name, title, unit, _measured(name), _expect(name), scale, share_of=share_of)


CASES = (
    *(("corner", e, mu) for e in (0.5, 1.0) for mu in (0.2, 0.5)),
    ("corner", 0.5, 0.0),
    *(("spinning", e, 0.2) for e in (0.5, 1.0)),
    *(("tilted edge", 0.5, mu) for mu in (0.2, 0.5)),
    *(("edge", 0.5, mu) for mu in (0.2, 0.5)),
    ("rod", 0.5, 0.2),
    ("rod", 1.0, 0.5),
    ("rod ahead", 0.5, 0.2),
)

OFF_CENTRE_IMPACT = Family(
    name="off-centre-impact",
    title="Cube and rod that strike the floor off their centres",
    topic="friction",
    statements=(12, 16, 18),
    about="A cube strikes the floor with a corner or an edge, or a thin rod strikes it with its lower end. The"
    " bodies also fly along the floor, and some of them spin, so that the slip may turn. There is no weight.",
    expected="The floor pushes beside the centre. So the impulse along the normal also moves the striking point"
    " along the floor, and friction also moves it along the normal. Newton's law leaves `e` times the speed"
    " of approach; for Poisson's and Stronge's, `e` is a ratio of impulses or of works. Each law says what"
    " is left of the slip.",
    why=(
        "Each implementation is judged by the law that it follows. DART keeps Newton's `e`, and its friction opposes"
        " the slip that is left. PyBullet keeps `e` too, but its friction has a slightly different direction: Bullet"
        " first divides each component of the slip by what a unit impulse along that axis changes of it. The"
        " hand-written function takes the direction of the impulse that would stop the slip. Where the impact stays"
        " in a plane, all three agree.",
        facts.MUJOCO_CANNOT_RUB_OFF_CENTRE,
    ),
    cases=tuple(_strikes(*case) for case in CASES),
    quantities=(
        _quantity("restitution", "parting"),
        _quantity("slip_x", "slip x"),
        _quantity("slip_y", "slip y"),
        _quantity("spin", "spin", "rad/s"),
        _quantity("lost", "lost"),
    ),
    curve=Curve(
        "corner,e=0.5,μ=0.2",
        "A cube on its corner, e = 0.5, μ = 0.2",
        "gap below the cube, m",
        lambda trajectory: measure.separation(trajectory, "box", "floor"),
    ),
    convergence=Convergence("spinning,e=0.5,μ=0.2", "restitution"),
    predict=corners.predict,
)

FAMILIES = (OFF_CENTRE_IMPACT,)
