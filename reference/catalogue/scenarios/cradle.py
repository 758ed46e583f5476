"""Newton's cradle: impacts that come together, which theory leaves open (slide 22)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from reference import truth
from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.engines.base import EXACT, Method
from reference.prediction import striking
from reference.scene.scenario import Body, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

RADIUS = 0.125
"""Radius of every ball, m: a sum of such numbers has no rounding, so that balls touch which are meant to."""
LEAD = 513 / 2048
"""How far the first ball is drawn back, m. At every timestep that we use it strikes within a step, not at its edge."""
SHARE = 1e-3
"""Accepted share of the first speed: 0.1 %."""
ROUNDING = 1e-9


def _row(family: str, name: str, velocities: tuple[float, ...], gap: float = 0.0, lead: float = 0.0) -> Case:
    """Equal elastic balls in a row, `gap` apart, those that move at 1 m/s drawn back by `lead`, m."""
    places = [number * (2 * RADIUS + gap) - (lead if speed == 1 else 0.0) for number, speed in enumerate(velocities)]
    balls = tuple(
        Body(f"ball {number}", Sphere(RADIUS), 1.0, (place, 0.0, 0.0), velocity=(velocity, 0.0, 0.0))
        for number, (place, velocity) in enumerate(zip(places, velocities, strict=True), 1)
    )
    pairs = tuple(Pair(f"ball {number}", f"ball {number + 1}", 1.0) for number in range(1, len(balls)))
    scenario = Scenario(f"{family}/{name}", balls, pairs, lead + len(balls) * gap + 0.1, (0.0, 0.0, 0.0))
    return Case(name, (scenario,), {"gap": gap})


def _one_struck(balls: float, gap: float) -> Case:
    """The first of so many balls strikes the rest."""
    apart = f"{1e6 * gap:g} µm" if gap < 1e-3 else f"{1e3 * gap:g} mm"
    name = f"{balls:g}, {apart} apart" if gap else f"{balls:g} touching"
    return _row("cradle", name, (1.0, *(0.0,) * (int(balls) - 1)), gap, LEAD)


def _first_velocities(case: Case) -> Array:
    return np.array([body.velocity[0] for body in case.scenarios[0].bodies])


def _last_velocities(trajectory: Trajectory) -> Array:
    return np.asarray(trajectory.velocities[-1, :, 0])


def _touching(case: Case) -> bool:
    """Whether the balls touch, so that Newton's rule allows more than one result."""
    return case.parameters["gap"] == 0


def _expect_ball(number: int) -> Callable[[Case, Settings, Method], Expectation | None]:
    def expect(case: Case, settings: Settings, method: Method) -> Expectation | None:
        if _touching(case):
            return None
        exact = float(truth.cradle_in_turn(_first_velocities(case))[number])
        return Expectation(exact, SHARE, "0.1 % of the first speed: one impact after another, each of two equal balls")

    return expect


def _readings(first: Array, apart: bool) -> list[Array]:
    """Results that a rule allows: impacts in turn; for balls that touch also all at once, and with all turned back."""
    in_turn = truth.cradle_in_turn(first)
    if apart:
        return [in_turn]
    struck = int(np.flatnonzero(np.diff(first) < 0)[-1])
    found = [in_turn, truth.cradle_at_once(first, struck)]
    return [*found, truth.cradle_turned_back(first)] if len(first) == 3 else found


def _off_readings(trajectory: Trajectory) -> float:
    """Largest difference of any ball's velocity from the nearest reading, ÷ 1 m/s."""
    balls = trajectory.scenario.bodies
    apart = balls[2].position[0] - balls[1].position[0] > 2 * RADIUS
    readings = _readings(trajectory.velocities[0, :, 0], apart)
    return min(float(np.max(np.abs(_last_velocities(trajectory) - reading))) for reading in readings)


def _expect_a_reading(case: Case, settings: Settings, method: Method) -> Expectation:
    return Expectation(0.0, SHARE, "0.1 % of the first speed")


def _expect_momentum(case: Case, settings: Settings, method: Method) -> Expectation:
    return Expectation(1.0, ROUNDING, "what one ball gains another loses, in every step: rounding only")


def _expect_energy(case: Case, settings: Settings, method: Method) -> Expectation:
    if method.kind == EXACT:
        return Expectation(1.0, ROUNDING, "rounding only: two equal elastic balls swap their velocities")
    # E = Σ v²/2 changes by Σ v δv. Momentum stays, Σ δv = 0, so that is also Σ (v − c) δv for any c: at most the share
    # of 0.1 % that each δv may have, times Σ |v − c|. With c the velocity that most balls share, 0 in turn and 2/5 of
    # five at once, Σ |v − c| is 1 for each ball that strikes, and E is 1/2 for each.
    reason = "0.2 %: what 0.1 % of the first speed in each velocity makes where momentum stays"
    return Expectation(1.0, 2 * SHARE, reason)


def _share_of_first(power: int) -> Callable[[Trajectory], float]:
    def share(trajectory: Trajectory) -> float:
        before, after = trajectory.velocities[0, :, 0], _last_velocities(trajectory)
        return float(np.sum(after**power) / np.sum(before**power))

    return share


def _ball(name: str, number: int) -> Quantity:
    title = f"{name} ball"
    return Quantity(
        name,
        title,
        "",
        lambda trajectory: float(_last_velocities(trajectory)[number]),
        _expect_ball(number),
        share_of="the first speed",
    )


FIRST, LAST = _ball("first", 0), _ball("last", -1)
OFF = Quantity("off", "off a reading", "", _off_readings, _expect_a_reading, share_of="the first speed")
MOMENTUM = Quantity("momentum", "momentum", "", _share_of_first(1), _expect_momentum, share_of="the momentum before")
ENERGY = Quantity("energy", "energy", "", _share_of_first(2), _expect_energy, share_of="the energy before")
TWO_OF_FIVE = (1.0, 1.0, 0.0, 0.0, 0.0)

CRADLE = Family(
    name="cradle",
    title="Newton's cradle",
    topic="impulse",
    statements=(12, 16, 20, 22),
    about="Equal elastic balls in a row, without weight. The first one, or two, strike the rest at 1 m/s,"
    " of which every velocity here is a share.",
    expected="Balls that are apart collide two at a time, and two equal elastic balls swap their velocities: as many"
    " fly off at the far end as came. For balls that touch, Newton's rule has a second reading, all impacts"
    " at once: the first of five comes back with `−3/5` of its speed and the others move on together with"
    " `2/5`. Both keep momentum and energy; the rule does not say which.",
    why=(
        "What decides is what an implementation takes for touching. The tuned engines solve the contacts of a step"
        " together, so balls that touch exactly get the second reading, and a micrometre between them gives the"
        " first. PyBullet leaves out a contact whose gap is 10⁻¹² m, MuJoCo one beyond its margin of 10⁻⁹ m, DART"
        " one that is open at all. Hand-written code has a reading for each method: exact, two balls at a time; at"
        " the step, all that touch.",
        "A real contact lasts. In MuJoCo's spring profile it is 1 mm deep: balls that touch are solved together, and"
        " balls 1 mm apart almost one after the other. In PyBullet's spring profile each contact is a spring by"
        " itself, and the result is that of a chain of springs, between the two readings.",
    ),
    cases=(
        _one_struck(3, 0.0),
        *(_one_struck(5, gap) for gap in (0.0, 1e-6, 1e-3)),
        _row("cradle", "5, 1 mm apart, two struck", TWO_OF_FIVE, gap=1e-3, lead=LEAD),
    ),
    quantities=(FIRST, LAST, OFF, MOMENTUM, ENERGY),
    curve=Curve(
        "5 touching",
        "Last of five that touch",
        "velocity of the last ball, m/s",
        lambda trajectory: trajectory.velocities[:, -1, 0],
    ),
    convergence=Convergence("5, 1 mm apart", "last"),
    grid=Grid(
        (
            Parameter("balls", "", (3.0, 4.0, 5.0), 5.0, whole=True),
            Parameter("gap", "m", (0.0, 1e-6, 1e-5, 1e-4, 1e-3), 0.0),
        ),
        (5e-4, 1e-3, 2e-3, 5e-3),
        _one_struck,
    ),
    predict=striking.predict,
)

PARTING_BALL = Family(
    name="parting-ball",
    title="Three balls, the last one parting",
    topic="impulse",
    statements=(12, 16, 20, 22),
    about="Three equal elastic balls touch, without weight. The first one moves into the second at 1 m/s, of"
    " which every velocity here is a share; the last one is about to part from it.",
    expected="One impact after another, the balls swap velocities until they are in order, and energy stays. All at"
    " once, Newton's rule makes energy: from (1, 0, 0.1) it makes (−0.3, 0.7, 0.7), and 0.505 J per kg"
    " become 0.535. The contact of the parting pair pushes while the pair opens, and this work is the"
    " energy that is made.",
    why=(
        "Each implementation follows a rule that sounds right, and they give three results. Hand-written, exact: in"
        " turn, (0, 0.1, 1). By hand at the step, in PyBullet and in DART: all at once, with 6 to 13 % more energy"
        " than before. MuJoCo's contact reverses every relative velocity, also that of the two that part: (−0.267,"
        " 0.733, 0.633). These two then approach, and collide in the next step: (−0.267, 0.633, 0.733).",
    ),
    cases=tuple(_row("parting-ball", f"v={parting:g}", (1.0, 0.0, parting)) for parting in (0.1, 0.3, 0.5)),
    quantities=(FIRST, LAST, OFF, MOMENTUM, replace(ENERGY, expect=None)),
    curve=Curve(
        "v=0.1",
        "The middle ball, the last one parting at 0.1 m/s",
        "velocity of the middle ball, m/s",
        lambda trajectory: trajectory.velocities[:, 1, 0],
    ),
    convergence=Convergence("v=0.1", "off"),
    predict=striking.predict,
)

FAMILIES = (CRADLE, PARTING_BALL)
