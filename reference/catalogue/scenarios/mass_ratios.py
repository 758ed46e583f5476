"""A light ball between balls up to 10⁴ times as heavy: an impact that a solver has to carry through (slides 20, 22)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.engines.base import COMPLIANT, DART, Method
from reference.prediction import striking
from reference.prediction.predicted import Prediction
from reference.scene.scenario import Body, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

LINE = np.array([6, 2, -3]) / 7
"""Along which the balls lie, and the first one flies; no axis."""
WIND = np.array([0.4, -1.1, 0.3])
"""Velocity, m/s, that all balls have besides: nothing may depend on it."""
RADIUS, GAP, LEAD = 0.125, 0.003, 0.0513
"""Of every ball; between the second and the third ball; and between the first and the second at the start, m."""
SPEED = 10.0
"""Of the first ball, m/s."""
DURATION = 0.03
"""s: some twenty-five steps of 1 ms after the impact."""
LAST = 0.3
"""Mass of the last ball in units of that of the first: the two are not alike."""
SHARE = 1e-3
"""Accepted share of the speed of the first ball, 0.1 %."""


def _row(name: str, masses: tuple[float, float, float]) -> Case:
    places = (-RADIUS * 2 - LEAD, 0.0, 2 * RADIUS + GAP)
    balls = tuple(
        Body(f"ball {number}", Sphere(RADIUS), mass, _numbers(place * LINE), velocity=_numbers(speed * LINE + WIND))
        for number, (mass, place, speed) in enumerate(zip(masses, places, (SPEED, 0.0, 0.0), strict=True), 1)
    )
    pairs = Pair("ball 1", "ball 2"), Pair("ball 2", "ball 3")
    scenario = Scenario(f"mass-ratios/{name}", balls, pairs, DURATION, (0.0, 0.0, 0.0))
    return Case(name, (scenario,), dict(zip(("first", "middle", "last"), masses, strict=True)))


def _between(ratio: float) -> Case:
    """A ball of 1 kg between one that is so many times heavier and one of 0.3 times that."""
    return _row(f"{ratio:g} : 1 : {LAST * ratio:g}", (ratio, 1.0, LAST * ratio))


def _numbers(vector: Array) -> tuple[float, float, float]:
    x, y, z = (float(each) for each in vector)
    return x, y, z


def _together(case: Case) -> float:
    """Velocity along the line of all three, moving on together, m/s: p = m₁ v."""
    masses = case.parameters
    return SPEED * masses["first"] / (masses["first"] + masses["middle"] + masses["last"])


def _along(trajectory: Trajectory) -> Array:
    """Velocities of the balls along the line at the end, (3,), m/s."""
    return np.asarray((trajectory.velocities[-1] - WIND) @ LINE)


LONGEST_FOR_THE_DASHPOT = 2.785 / 1e4
"""Longest timestep, s, at which the Runge–Kutta method follows a dashpot that takes 10⁴ of the speed in a second.

That of a spring of 10⁶ N/m for each kilogram with five times the critical damping, which stands for e = 0."""


def _expect_ball(case: Case, settings: Settings, method: Method) -> Expectation:
    why = "contacts that let go of each other early, or a weak spring that gives back what it has stored"
    if method.kind == COMPLIANT and settings.timestep > LONGEST_FOR_THE_DASHPOT:
        why = "a step is too long for the dashpot of a contact, whose force then throws the balls apart"
    return Expectation(
        _together(case), SHARE * SPEED, "0.1 % of the speed of the first ball", shift_reason=why, size=SPEED
    )


def _momentum(trajectory: Trajectory) -> float:
    masses = np.array([body.mass for body in trajectory.scenario.bodies])
    return float(masses @ _along(trajectory) / (masses[0] * SPEED))


def _expect_momentum(case: Case, settings: Settings, method: Method) -> Expectation:
    return Expectation(1.0, 1e-9, "what one ball gains another loses, in every step: rounding only")


def _ball(name: str, place: int) -> Quantity:
    measure: Callable[[Trajectory], float] = lambda trajectory: float(_along(trajectory)[place])  # noqa: E731
    return Quantity(name, f"{name} ball", "m/s", measure, _expect_ball, lambda case: SPEED)


def predict(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    """The recurrence of the method. DART's stock settings follow none here.

    With two contacts in overlap they part the balls by a hundredth of the overlap in each step, and not at 1 mm/s.
    """
    if method.rule == DART and not settings.options.get("split_impulse"):
        return None
    return striking.predict(scenario, settings, method)


MASS_RATIOS = Family(
    name="mass-ratios",
    title="Light ball between heavy ones",
    topic="impulse",
    statements=(20, 22),
    about=f"A smooth ball flies at {SPEED:g} m/s against a ball of 1 kg, which meets a third one {1e3 * GAP:g} mm"
    " behind it. The case names the three masses. No impact rebounds, e = 0, and nothing has weight. All balls also"
    " drift with one velocity, which must not matter. The figures are the velocities along the line of the balls.",
    expected="Balls that do not rebound push each other until none approaches another. Then all move on together, and"
    " momentum gives their velocity, `v = m_1 v_0/(m_1 + m_2 + m_3)`: 7.69 m/s at 10⁴ : 1 : 3000. Taken one after"
    " another these impacts never end. Of the hand-written methods only the world therefore runs this scenario.",
    why=(
        "A solver that goes from contact to contact has to carry the impulse through the light ball. In one sweep the"
        " ball passes on no more than its own share, `m_2/m_1`, of the impulse that is missing. So the number of"
        " sweeps has to grow with the ratio of masses. The tuned settings of PyBullet and DART allow 20 sweeps for"
        " each unit of that ratio, 200,000 at 10⁴; the hand-written world then solves all contacts at once, and MuJoCo"
        " always does.",
        "With too few sweeps each solver fails in its own way. At 10⁴ : 1 : 3000, 100 sweeps of PyBullet leave the"
        " first ball at 9.32 m/s and the last at 2.27 m/s: later steps find slowly what one step has not found. 1000"
        " sweeps of DART throw the last two balls ahead at 10.20 m/s and leave the first at 6.94 m/s, because DART"
        " begins a step with the impulses of the step before and so applies the impulse of the impact again. The"
        " hand-written world remembers impulses as well, and with sequential sweeps it leaves 9.48 and 7.15 m/s.",
        "MuJoCo's numbers hardly depend on the ratio: its solver is a Newton method for all contacts together. The"
        " small error that remains comes from the weak spring that takes overlap back. In the spring profile the"
        " contacts are 10 mm deep, and the outer balls separate slowly.",
        "Stock DART has a solver by pivots, which solves all contacts at once, whatever the ratio.",
    ),
    cases=(
        *(_between(ratio) for ratio in (10.0, 100.0, 1e3, 1e4)),
        _row("300 : 1 : 1000", (300.0, 1.0, 1e3)),
    ),
    quantities=(
        _ball("first", 0),
        _ball("middle", 1),
        _ball("last", 2),
        Quantity("momentum", "momentum", "", _momentum, _expect_momentum, share_of="the momentum before"),
    ),
    curve=Curve(
        "1000 : 1 : 300",
        "Last ball of 1000 : 1 : 300",
        "velocity of the last ball, m/s",
        lambda trajectory: (trajectory.velocity("ball 3") - WIND) @ LINE,
    ),
    convergence=Convergence("1000 : 1 : 300", "last", (4.0, 2.0, 1.0)),
    grid=Grid((Parameter("ratio", "", (1.0, 10.0, 100.0, 1e3, 1e4), 1e3, in_ratio=True),), (1e-3, 2e-3), _between),
    predict=predict,
)

FAMILIES = (MASS_RATIOS,)
