"""A superball between a rough floor and a rough ceiling: friction in one impact after another (slides 12 to 18, 24)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise

import numpy as np

from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.engines.base import BULLET, MUJOCO_SPRING, Method
from reference.errors import RunFailed
from reference.prediction import striking
from reference.prediction.bands import Term
from reference.prediction.predicted import Prediction
from reference.scene.scenario import Body, HalfSpace, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory
from reference.superball_truth import between_walls

NORMAL = np.array([2, 3, 6]) / 7
"""Of the floor; that of the ceiling is its opposite. None of the directions here is an axis."""
ALONG = np.array([6, 2, -3]) / 7
"""In which direction along the floor the ball is thrown."""
ASIDE = np.array([-3, 6, -2]) / 7
"""The other direction along the floor: n × t."""
RADIUS, MASS = 0.1, 1.3
"""Of the ball, m and kg."""
ROOM, HEIGHT = 0.25, 0.1
"""Way of the ball from the floor to the ceiling, and its gap above the floor at the start, m."""
DOWN, FORWARD = 3.0, 2.0
"""Velocity at the start towards the floor, and along it, m/s."""
AFTER = 0.03
"""How long is watched after the third impact, s."""
CEILING = 0.8
"""Restitution of the ceiling as a share of that of the floor: the two are not alike."""
IMPACTS = 3
SHARE = 1e-3
"""Accepted share of the speed along the floor at the start, 0.1 %."""
TWO_CONTACTS = (0.03, 0.05)
"""By which way of its surface in a step, as a share of its radius, a ball keeps the contact of the last step in Bullet
beside the new one. With less Bullet takes the two for one, and with more it forgets the old one. Measured: with spins
from 33 to 48 rad/s at 1 ms, and with none from 5 to 60 rad/s at 0.5 or 2 ms."""
UNTURNED = 1e-9
"""A difference of less than this between the turns of two steps, rad, is none."""
TURNED_BY_TWO = Term("a contact that Bullet keeps beside the new one, and which has turned with the ball", 1e-4)
"""A share of the speed along the floor. 2.5·10⁻⁵ was measured at most, beside a spin of 0.04 rad/s about the normal,
which no number here has."""
WHY = "the contact lies inside the ball, which shortens the arm of friction; or friction acts too gently in a spring"


def _restitutions(case: Case) -> tuple[float, ...]:
    """Of the floor, the ceiling and the floor."""
    e = case.parameters["restitution"]
    return e, CEILING * e, e


def _thrown(restitution: float, friction: float, spin: float) -> Case:
    """spin: about an axis of the floor that is neither along the throw nor across it, rad/s."""
    name = f"e={restitution:g},μ={friction:g},ω={spin:g}"
    start, velocity = (RADIUS + HEIGHT) * NORMAL, FORWARD * ALONG - DOWN * NORMAL
    axis = (0.6 * ALONG + 0.8 * ASIDE) * spin
    ball = Body(
        "ball", Sphere(RADIUS), MASS, _numbers(start), velocity=_numbers(velocity), angular_velocity=_numbers(axis)
    )
    floor = Body("floor", HalfSpace(_numbers(NORMAL)))
    up = (ROOM + 2 * RADIUS) * NORMAL
    ceiling = Body("ceiling", HalfSpace(_numbers(-NORMAL)), position=_numbers(up))
    first, second = restitution * DOWN, CEILING * restitution**2 * DOWN
    duration = HEIGHT / DOWN + ROOM / first + ROOM / second + AFTER
    pairs = (Pair("ball", "floor", restitution, friction), Pair("ball", "ceiling", CEILING * restitution, friction))
    scenario = Scenario(f"superball/{name}", (floor, ceiling, ball), pairs, duration, (0.0, 0.0, 0.0))
    return Case(name, (scenario,), {"restitution": restitution, "friction": friction, "spin": spin})


def _numbers(vector: Array) -> tuple[float, float, float]:
    x, y, z = (float(each) for each in vector)
    return x, y, z


def _flights(trajectory: Trajectory) -> list[tuple[Array, Array]]:
    """Velocity and r ω half-way through each flight: the flights change their sense along the normal."""
    velocity, spin = trajectory.velocity("ball"), trajectory.angular_velocity("ball")
    rising = velocity @ NORMAL > 0
    turns = [0, *(np.flatnonzero(np.diff(rising)) + 1).tolist(), len(rising)]
    middles = [(first + end) // 2 for first, end in pairwise(turns)]
    return [(velocity[at], RADIUS * spin[at]) for at in middles]


def _theory(case: Case) -> list[tuple[Array, Array]]:
    ball = case.scenarios[0].body("ball")
    walls = (NORMAL, -NORMAL, NORMAL)
    start = np.array(ball.velocity), RADIUS * np.array(ball.angular_velocity)
    return between_walls(*start, walls, _restitutions(case), case.parameters["friction"])


Number = Callable[[Array, Array], float]
"""Velocity and r ω → a number, m/s."""


def _quantity(name: str, title: str, impact: int, number: Number) -> Quantity:
    """A number after one of the impacts."""

    def measured(trajectory: Trajectory) -> float:
        found = _flights(trajectory)
        if len(found) <= impact:
            raise RunFailed(f"strikes the walls {len(found) - 1} times")
        return number(*found[impact])

    def expect(case: Case, settings: Settings, method: Method) -> Expectation:
        exact = number(*_theory(case)[impact - 1])
        reason = f"0.1 % of the {FORWARD:g} m/s along the floor at the start"
        return Expectation(exact, SHARE * FORWARD, reason, shift_reason=WHY, size=FORWARD)

    return Quantity(name, title, "m/s", measured, expect, lambda case: FORWARD, absent="has no third flight")


def _along(velocity: Array, surface: Array) -> float:
    return float(velocity @ ALONG)


def _aside(velocity: Array, surface: Array) -> float:
    return float(velocity @ ASIDE)


def _rolling(velocity: Array, surface: Array) -> float:
    """What r ω is about the axis along the floor and across the throw: that of a ball that rolls ahead."""
    return float(surface @ ASIDE)


def _way(trajectory: Trajectory) -> Array:
    return np.asarray((trajectory.position("ball") - trajectory.position("ball")[0]) @ ALONG)


def predict(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    """The recurrence of the method, and what it cannot know of MuJoCo's spring and of Bullet's contacts."""
    found = striking.predict(scenario, settings, method)
    if found is None:
        return None
    if method.rule == MUJOCO_SPRING:
        left = sum(term.share for term in found.terms) * (10.0 ** (IMPACTS - 1) - 1)
        return replace(
            found, terms=(*found.terms, Term("each impact but the first makes an error ten times larger", left))
        )
    turns = np.linalg.norm(found.trajectory.angular_velocity("ball"), axis=1) * settings.timestep
    before = turns[np.abs(turns - turns[-1]) > UNTURNED]  # an impact: after the last one none takes two contacts
    if method.rule == BULLET and np.any((before > TWO_CONTACTS[0]) & (before < TWO_CONTACTS[1])):
        return replace(found, terms=(*found.terms, TURNED_BY_TWO))
    return found


SUPERBALL = Family(
    name="superball",
    title="Superball between floor and ceiling",
    topic="impulse",
    statements=(12, 14, 16, 18, 24),
    about=f"A solid ball of {MASS:g} kg is thrown at a rough floor at {DOWN:g} m/s, and at {FORWARD:g} m/s along it."
    " It rebounds to a ceiling parallel to the floor, and from there to the floor again. Nothing has weight, the"
    f" ceiling's restitution is {CEILING:g} e, and the spin ω is about an axis in the plane of the floor, at 53° to"
    " the throw. The figures are the speeds along the floor after each impact, the speed to the side after the third,"
    " and r ω after the third.",
    expected="Friction acts against the slip `w` of the ball's surface, with an impulse of at most `μ (1 + e) m v`. To"
    " end the slip it needs `2/7 m w`, no matter in which direction. A ball that starts without spin and grips keeps"
    " 5/7, 15/49 and 45/343 of its speed after the three impacts. A real superball is made of rubber, which also"
    " reverses the slip: with an impulse of `4/7 m w` in each impact it would leave with 3/7, −31/49 and −333/343 of"
    " its speed, and so come back to the hand (Garwin, American Journal of Physics 37, 1969).",
    why=(
        "No implementation brings the ball back. Each has one coefficient of restitution, along the normal, and"
        " Coulomb's friction ends a slip but never reverses it. So none of the four can simulate a superball, and they"
        " are judged by an ordinary ball, which grips or slips.",
        "Tuned PyBullet gives every number to rounding, because it lets the impulses act where the surfaces lie. If"
        " the ball spins with 30 to 50 rad/s, Bullet keeps the contact of the last step beside the new one, and the"
        " numbers differ by some `10⁻⁵`. MuJoCo and the hand-written world let them act half-way into the overlap, and"
        " DART on the wall. The arm of friction is then shorter than r, and the ball keeps some spin. At the next wall"
        " that spin increases the slip, so that the error grows from impact to impact.",
        "In MuJoCo's spring profile the dashpot of the pair brakes the slip as gently as it brakes the fall, so that a"
        " ball which should grip slips, and keeps far too much of its speed.",
    ),
    cases=(
        _thrown(0.9, 0.6, 0.0),
        _thrown(0.9, 0.6, 20.0),
        _thrown(0.9, 0.15, -20.0),
        _thrown(0.6, 0.3, 60.0),
    ),
    quantities=(
        _quantity("first", "1st along", 1, _along),
        _quantity("second", "2nd along", 2, _along),
        _quantity("third", "3rd along", 3, _along),
        _quantity("aside", "3rd aside", 3, _aside),
        _quantity("turning", "3rd r ω", 3, _rolling),
    ),
    curve=Curve("e=0.9,μ=0.6,ω=0", "Way along the floor, thrown without spin", "way, m", _way),
    convergence=Convergence("e=0.9,μ=0.15,ω=-20", "third"),
    grid=Grid(
        (
            Parameter("restitution", "", (0.6, 0.9), 0.9),
            Parameter("friction", "", (0.15, 0.3, 0.6), 0.6),
            Parameter("spin", "rad/s", (-20.0, 0.0, 20.0, 60.0), 0.0),
        ),
        (1e-3, 2e-3),
        _thrown,
    ),
    predict=predict,
)

FAMILIES = (SUPERBALL,)
