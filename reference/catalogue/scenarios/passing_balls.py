"""Two balls that fly at each other, at random offsets: how many pass through each other unnoticed (slides 9 and 10)."""

from __future__ import annotations

import math

import numpy as np

from reference import sweeping_truth
from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.engines.base import AT_STEP, COMPLIANT, EXACT, Method
from reference.prediction import striking
from reference.scene.scenario import Body, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

RADIUS = 0.01
"""Radius of every ball, m: that of a marble."""
REACH = 2 * RADIUS
"""Distance of two centres that touch, m."""
RESTITUTION = 0.5
HEAVY, LIGHT = 0.03, 0.012
"""Masses, kg."""
AHEAD = np.array([2.0, -1.0, 2.0]) / 3
"""Direction in which the heavy ball moves as seen from the light one: along no axis of the world."""
ACROSS = np.array([[1.0, 2.0, 0.0] / np.sqrt(5.0), np.cross(AHEAD, [1.0, 2.0, 0.0]) / np.sqrt(5.0)])
"""Two unit vectors across it."""
HEAVYS_PART, DRIFT = 0.35, 0.1
"""The heavy ball's part of the relative speed, and a speed that both have across it, as a share of it too."""
MEETINGS, STRIDE, FIRST = 61, 46, 43
"""Meetings in an ensemble, a prime, and the lattice of phases and offsets: meeting i comes at phase i/61 of the span of
times, at the (46 i + 43)-th of 61 rings of equal area. With these numbers the share that passes differs from the mean
over all phases and offsets by 1.4 meetings at most, for any whole number of steps in the span that was tried."""
NEAR_THE_MEAN = 1.4
GOLDEN_ANGLE = math.pi * (3 - math.sqrt(5))
"""By which the direction of the offset turns from one meeting to the next, rad."""
FLIGHT, SPREAD = 0.03003, 0.05
"""Mean time until the balls touch, and what the times span, s. The span is a whole number of 1/240 s, of 0.1, 0.2, 0.5,
1 and 2 ms. No flight is: rounding would decide in which step the balls are noticed."""
AFTER = 0.01
"""How long is watched after the touch, s."""
TURNED = math.radians(1)
"""A relative velocity that has turned by less than this has not been turned back, rad."""
MOST_LOST = 0.5
"""A method that loses half of the meetings does not agree with theory at all: a coin would be as good."""
UNTURNED = "no step ends while the balls overlap and still approach"
TOO_SOFT = "the spring gives way so far that the balls get past each other before it has turned them"
SHARE, ROUNDING = 1e-3, 1e-9
"""Accepted share of a momentum, 0.1 %, and of one that nothing but rounding changes."""


def _meeting(name: str, speed: float, number: int) -> Scenario:
    """Two balls that come from either side and touch after a time, at an offset of their lines of flight."""
    time = FLIGHT + SPREAD * (number - MEETINGS // 2) / MEETINGS
    offset = math.sqrt(((STRIDE * number + FIRST) % MEETINGS + 0.5) / MEETINGS)
    angle = GOLDEN_ANGLE * number
    aside = offset * REACH * (math.cos(angle) * ACROSS[0] + math.sin(angle) * ACROSS[1])
    between = aside - math.sqrt(1 - offset**2) * REACH * AHEAD  # of the centres when the balls touch
    bodies = []
    for title, mass, part, side in (("heavy", HEAVY, HEAVYS_PART, 0.5), ("light", LIGHT, HEAVYS_PART - 1, -0.5)):
        velocity = speed * (part * AHEAD + DRIFT * ACROSS[0])
        place = side * between - time * velocity
        bodies.append(Body(title, Sphere(RADIUS), mass, tuple(place.tolist()), velocity=tuple(velocity.tolist())))
    pair = Pair("heavy", "light", RESTITUTION)
    return Scenario(f"passing-balls/{name}", tuple(bodies), (pair,), time + AFTER, gravity=(0.0, 0.0, 0.0))


def _case(speed: float) -> Case:
    name = f"v={speed:g}"
    numbers = sorted(range(MEETINGS), key=lambda number: abs(number - MEETINGS // 2))
    return Case(name, tuple(_meeting(name, speed, number) for number in numbers), {"speed": speed})


def _relative(trajectory: Trajectory) -> tuple[Array, Array]:
    """Velocity of the heavy ball relative to the light one, at the start and at the end, (3,), m/s."""
    velocity = trajectory.velocity("heavy") - trajectory.velocity("light")
    return velocity[0], velocity[-1]


def _passed(trajectory: Trajectory) -> float:
    """1 for two balls that fly on as if the other one were not there, 0 for two that turn each other aside."""
    before, after = _relative(trajectory)
    aside = np.linalg.norm(np.cross(before, after))
    return float(abs(math.atan2(aside, before @ after)) < TURNED)


def _expect_passed(case: Case, settings: Settings, method: Method) -> Expectation:
    one, shift = 1 / MEETINGS, 0.0
    if method.kind == AT_STEP:
        shift = sweeping_truth.unturned_balls(case.parameters["speed"] * settings.timestep, REACH)
    why = TOO_SOFT if method.kind == COMPLIANT else UNTURNED
    bound = min(NEAR_THE_MEAN * one, shift / 2)
    return Expectation(0.0, one / 2, "not one meeting of them all", shift, why, bound, MOST_LOST)


def _exchanged(trajectory: Trajectory) -> float:
    """Momentum that one ball gives to the other, as a share of what theory says for this offset."""
    before, _ = _relative(trajectory)
    heavy, light = (trajectory.scenario.body(name) for name in ("heavy", "light"))
    between = np.subtract(heavy.position, light.position)
    speed = float(np.linalg.norm(before))
    aside = float(np.linalg.norm(np.cross(between, before))) / speed / REACH
    full = sweeping_truth.impulse_of_a_meeting(speed, aside, RESTITUTION, heavy.mass, light.mass)
    gained = trajectory.velocity("heavy")[-1] - trajectory.velocity("heavy")[0]
    return float(heavy.mass * np.linalg.norm(gained)) / full


def _expect_exchanged(case: Case, settings: Settings, method: Method) -> Expectation:
    if method.kind == EXACT:
        return Expectation(1.0, ROUNDING, "rounding only: every two balls meet where they touch")
    why = "meetings that pass exchange nothing; in the others the line of centres has turned before they are noticed"
    if method.kind == COMPLIANT:
        why = "the line of centres turns while the spring gives way, and fast balls get past each other"
    reason = "0.1 %: without weight or air an impact is all that changes a momentum"
    return Expectation(1.0, SHARE, reason, shift_reason=why)


def _gap(trajectory: Trajectory) -> Array:
    between = trajectory.position("heavy") - trajectory.position("light")
    return np.asarray(np.linalg.norm(between, axis=1) - REACH)


PASSING_BALLS = Family(
    name="passing-balls",
    title="Two fast balls that meet at random offsets",
    topic="sweeping",
    statements=(2, 9, 10),
    about=f"Two smooth balls of {1000 * RADIUS:g} mm radius, {1000 * HEAVY:g} g and {1000 * LIGHT:g} g, fly at each"
    f" other without weight, with e = {RESTITUTION:g}. Each figure is the mean over {MEETINGS} meetings. They come at"
    " evenly spread phases of a step, and at offsets that are spread evenly over the area in which the balls touch.",
    expected="As seen from one ball, the other one flies along a straight line. The balls touch wherever this line"
    " comes nearer to the centre than `R`, the sum of the radii. So no two balls pass through each other, and each"
    " pair exchanges the momentum `(1 + e) v cos α/(1/m_A + 1/m_B)`, where `R sin α` is the offset.",
    why=(
        "In a step the balls move by `D = v Δt` relative to each other. A test of overlap at the end of each step"
        " misses the share `D²/12R²` of all meetings as long as `D` is at most `2R`, and `1 − 4R/3D` if it is longer."
        " It misses meetings at a large offset first, because such balls overlap for a short time only.",
        "A meeting that is noticed too late is lost as well: two balls that are already moving apart are not pushed. A"
        " step must end while the balls still approach, on the first half of the way on which they overlap. So a"
        " response at the ends of steps loses as many meetings as a test of overlap with steps twice as long, `D²/3R²`"
        " up to `D = R` and then `1 − 2R/3D`. At 40 m/s that is a third of them at 0.5 ms, and two thirds at 1 ms.",
        "Two balls that are noticed in time are still noticed late. Their line of centres has turned, and the impulse"
        " along it is too small. Hand-written code that sweeps one ball past the other, `sweep_sphere_sphere`, finds"
        " every meeting at its instant.",
        "The spring profiles lose meetings for another reason. Their contact gives way by up to `v/ω`, with `ω² = 10⁶`"
        " 1/s²: that is 10 mm at 10 m/s, and 40 mm at 40 m/s, twice `R`. Fast balls get past each other before the"
        " spring has turned them.",
    ),
    cases=tuple(_case(speed) for speed in (10.0, 40.0, 120.0)),
    quantities=(
        Quantity("passed", "share that passes", "", _passed, _expect_passed),
        Quantity(
            "exchanged", "momentum exchanged", "", _exchanged, _expect_exchanged, share_of="the momentum in theory"
        ),
    ),
    curve=Curve("v=40", "The first of the meetings at 40 m/s", "gap between the balls, m", _gap),
    convergence=Convergence("v=40", "passed", (8.0, 4.0, 2.0, 1.0)),
    grid=Grid((Parameter("speed", "m/s", (10.0, 40.0, 120.0), 40.0),), (2e-4, 5e-4, 1e-3, 2e-3), _case),
    predict=striking.predict,
)

FAMILIES = (PASSING_BALLS,)
