"""Bouncing: a dropped ball, and a ball that comes to rest (slides 3 to 7)."""

from __future__ import annotations

import math
from collections.abc import Callable

from reference import truth
from reference.arrays import Array
from reference.catalogue import measure
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import TENTHS, Grid, Parameter
from reference.catalogue.scenarios.tolerances import MILLIMETRE, at_rest, within_a_millimetre
from reference.engines import facts
from reference.engines.base import AT_STEP, COMPLIANT, EXACT, INTERPOLATED, Method
from reference.engines.pybullet_settings import STOCK_REST_SPEED
from reference.prediction import bouncing
from reference.scene import geometry
from reference.scene.scenario import GRAVITY, Body, HalfSpace, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

RADIUS = 0.1
"""Radius of the ball, m."""
DROP_HEIGHT = 1.0
"""Gap below the ball at the start, m; the mean one where drops are jittered."""
DROPS = 13
"""Drops in an ensemble, a prime: their phases within a step are evenly spread for any timestep. Each is judged by
itself; the mean is shown."""
GRID_DROPS = 7
"""The same for a point of the grid. There are many points, so each has fewer drops."""
SPREAD = 0.1
"""The fall times of an ensemble span this, s: whole steps of 1/60 s, of 4 ms and of timesteps that divide these."""
WINDOW = 5.0
"""How long a ball at rest is watched, s."""
LATEST = 0.25
"""How long after the end of the bounces, in theory, that watch begins, s."""
PAST_APEX = 0.05
"""How long after its first apex a drop ends, s."""
ROUNDING = 1e-9
READ_OFF, READ_OFF_REASON = 0.01, "1 %: what can be read off a plot"
FLOOR = Body("floor", HalfSpace())
Falling = Callable[[str, float, float, float], Scenario]
"""Name, restitution, drop height in m, duration in s → the scenario of one drop."""


def falling_ball(
    name: str, restitution: float, drop_height: float, duration: float, radius: float = RADIUS, mass: float = 1.0
) -> Scenario:
    """A ball let go above the floor; drop_height is the gap, m."""
    ball = Body("ball", Sphere(radius), mass, position=(0.0, 0.0, radius + drop_height))
    return Scenario(name, (FLOOR, ball), (Pair("ball", "floor", restitution=restitution),), duration)


def falling_body(scenario: Scenario) -> Body:
    """The one body that can move."""
    return next(body for body in scenario.bodies if not body.immovable)


def drop_height(scenario: Scenario) -> float:
    """Gap below the falling body at the start, m."""
    return geometry.gap(scenario.body("floor"), falling_body(scenario))


def dropped(family: str, restitution: float, falling: Falling, count: int = DROPS) -> Case:
    """Drops with fall times spread evenly over `SPREAD`, so that no result depends on the phase within a step.

    Their number, a prime, spreads these phases evenly as well. A point of a grid has its number of drops in its name.
    """
    fall = truth.fall_time(DROP_HEIGHT, GRAVITY)
    name = f"e={restitution:g}" + (f",drops={count}" if count == GRID_DROPS else "")
    falls = [fall + SPREAD * (drop - count // 2) / count for drop in range(count)]
    scenarios = tuple(
        falling(
            f"{family}/{name}",
            restitution,
            GRAVITY * time**2 / 2,
            time * (1 + restitution) + PAST_APEX,
        )
        for time in sorted(falls, key=lambda time: abs(time - fall))
    )
    return Case(name, scenarios, {"restitution": restitution})


def _rebound(trajectory: Trajectory) -> float:
    """First apex over drop height."""
    scenario = trajectory.scenario
    return measure.first_apex(trajectory, falling_body(scenario).name, "floor") / drop_height(scenario)


def _expect_rebound(case: Case, settings: Settings, method: Method) -> Expectation:
    """The mean first rebound over an ensemble of drops, as a share of the drop height: e²."""
    exact = truth.rebound_ratio(case.parameters["restitution"])
    if method.kind == EXACT:
        return Expectation(exact, ROUNDING, "rounding only: the parabola is solved, not stepped")
    if exact == 0:
        return Expectation(0.0, MILLIMETRE / DROP_HEIGHT, "1 mm in 1 m: nobody sees it")
    near = READ_OFF * exact
    if method.kind == AT_STEP:
        shift = _mean_share(
            case,
            lambda height: truth.rebound_shift_at_step(
                height, case.parameters["restitution"], GRAVITY, settings.timestep, method.recovery
            ),
        )
        return Expectation(exact, near, READ_OFF_REASON, shift, _WHY[AT_STEP], _next_order(case, settings.timestep))
    return Expectation(exact, near, READ_OFF_REASON, shift_reason=_WHY.get(method.kind, ""))


_WHY = {
    AT_STEP: "half a step late: the right speed from the wrong place",
    INTERPOLATED: "the slide's T is early by g dt²/(8v)",
    COMPLIANT: "a contact that cannot pull lets go before the spring is back at its rest length",
}
"""Why a rebound is away from theory, by the kind of the method."""


def _next_order(case: Case, dt: float) -> float:
    """How far the mean of a sawtooth over N even phases may be from that of all, 1/N of the overlap; and g dt²."""
    overlap = truth.impact_speed(DROP_HEIGHT, GRAVITY) * dt
    return (overlap / len(case.scenarios) + 2 * GRAVITY * dt**2) / DROP_HEIGHT


def _mean_share(case: Case, length: Callable[[float], float]) -> float:
    """The mean, over the drops, of a length that depends on the drop height, divided by that height."""
    heights = [drop_height(scenario) for scenario in case.scenarios]
    return sum(length(height) / height for height in heights) / len(heights)


def _sink(trajectory: Trajectory) -> float:
    return measure.deepest_penetration(trajectory, "ball", "floor")


def _expect_sink(case: Case, settings: Settings, method: Method) -> Expectation:
    """No overlap, or at most what a body that is noticed late, or that a spring has to stop, makes of it."""
    speed = max(truth.impact_speed(drop_height(scenario), GRAVITY) for scenario in case.scenarios)
    if method.kind in (EXACT, INTERPOLATED):
        return Expectation(0.0, ROUNDING, "rounding only: no step ends below the floor")
    if method.kind == COMPLIANT:
        return Expectation(0.0, speed / math.sqrt(method.stiffness), "v/√k: as deep as the spring needs to stop it")
    return Expectation(0.0, speed * settings.timestep, "v dt: the floor is noticed up to a step late")


def _gap(trajectory: Trajectory) -> Array:
    return measure.separation(trajectory, "ball", "floor")


REBOUND = Quantity(
    "rebound",
    "first rebound ÷ drop height",
    "",
    _rebound,
    _expect_rebound,
    lambda case: case.parameters["restitution"] ** 2,
)
"""The mean rebound over an ensemble of `dropped`, for any falling body."""


DROPPED_BALL = Family(
    name="dropped-ball",
    title="Dropped ball: bounce heights",
    topic="response",
    statements=(3, 5, 6, 7, 12),
    about=f"A ball falls about {DROP_HEIGHT:g} m onto the floor and rebounds. Every figure is the mean over {DROPS}"
    f" drops whose fall times spread evenly over {SPREAD:g} s, because a single drop's error depends on where"
    " in a step the ball meets the floor.",
    expected="The first rebound reaches `e²` of the drop height: the impact scales the speed by `e`, and the height"
    " is proportional to the speed squared.",
    why=(
        "A step method notices the floor only when the ball is already inside it, half of `v dt` deep on average. It"
        " sends the ball back with the right speed from the wrong place, and the mean apex is shifted by `−(1 − e) v"
        " dt/2`. Hand-written code at the step shows exactly this.",
        "PyBullet, tuned, takes the share `1 − e` of the overlap back by moving the ball without adding speed. Its"
        " mean error vanishes, and a single drop still scatters by `e (1 − e) v dt/√12`."
        f" {facts.PYBULLET_STARTS_EARLY} The smaller the step, the larger that loss, until nothing bounces at all.",
        f"{facts.MUJOCO_HAS_NO_RESTITUTION} Tuned, a damping of `(1 + e)/dt` turns `v` into `−e v` in one step. The"
        " textbook's spring and dashpot lets go of the ball at a depth of order `v/√k`, since a contact cannot pull; a"
        " smaller timestep does not remove that part of the error, only a stiffer spring does.",
        "DART's step has already added `g dt` to the speed, so its mean apex is shifted by `−(1 − e) v dt/2 + e² v"
        " dt`, which happens to vanish at e = 0.5. Stock, at 1 ms, that is 4 % of the rebound at e = 0.2; tuned, at"
        " a tenth of the timestep, it is a tenth of that.",
    ),
    cases=tuple(dropped("dropped-ball", restitution, falling_ball) for restitution in (0.0, 0.2, 0.5, 0.8, 0.95, 1.0)),
    quantities=(
        REBOUND,
        Quantity("sink", "deepest penetration", "m", _sink, _expect_sink),
    ),
    curve=Curve("e=0.5", "One drop at e = 0.5", "gap below the ball, m", _gap),
    convergence=Convergence("e=0.5", "rebound"),
    grid=Grid(
        (Parameter("restitution", "", (*TENTHS[:10], 0.95, 1.0), 0.5),),
        (2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-2),
        lambda restitution: dropped("dropped-ball", restitution, falling_ball, GRID_DROPS),
    ),
    predict=bouncing.predict,
)


def _to_rest(restitution: float) -> Case:
    name = f"e={restitution:g}"
    end = truth.bounce_end(DROP_HEIGHT, restitution, GRAVITY)
    scenario = falling_ball(f"ball-to-rest/{name}", restitution, DROP_HEIGHT, end + LATEST + WINDOW)
    return Case(name, (scenario,), {"restitution": restitution})


def _expect_rest_time(case: Case, settings: Settings, method: Method) -> Expectation:
    end = truth.bounce_end(DROP_HEIGHT, case.parameters["restitution"], GRAVITY)
    if method.kind == EXACT:
        return Expectation(end, ROUNDING, "rounding only: the bounces are followed down to nothing")
    why = "bounces slower than the rest threshold are cut off, and each impact is noticed late"
    return Expectation(end, READ_OFF * end, READ_OFF_REASON, shift_reason=why)


def _expect_rest(case: Case, settings: Settings, method: Method) -> Expectation:
    if method.kind == EXACT:
        return Expectation(0.0, ROUNDING, "rounding only")
    return within_a_millimetre(case, settings, method)


BALL_TO_REST = Family(
    name="ball-to-rest",
    title="Ball coming to rest",
    topic="response",
    statements=(3, 5, 6, 7, 22),
    about=f"The same ball bounces until it rests, and is watched for {WINDOW:g} s more.",
    expected="The flights between the impacts last `2 eⁿ t₁` with `t₁ = √(2 h/g)`. Infinitely many of them take the"
    " finite time `t₁ (1 + e)/(1 − e)`: 8.579 s for h = 1 m, e = 0.9. Then the ball lies still.",
    why=(
        "No step method can follow infinitely many bounces. Each engine lets a contact rest below some speed `v`, and"
        " the bounces that it leaves out would have taken `2 e v/(g (1 − e))` more. That speed is `3 g dt` in tuned"
        f" PyBullet, and {STOCK_REST_SPEED:g} m/s in stock PyBullet, which ends the bounces early. {facts.DART_RESTS}",
        "What a step adds to each rebound, `e g dt`, delays a lively ball in stock DART. At e = 0.95 it would never"
        " stop.",
        "A resolved spring and dashpot lasts some `π/√k`, where the rigid contact takes no time, so the spring"
        " profiles come to rest late. PyBullet's ball then lies still, `g/k` deep. MuJoCo's chatters with about `g"
        " dt/2`.",
        "Hand-written code with the slide's T cannot see a flight that starts and ends within one step, and takes it"
        " for rest.",
    ),
    cases=tuple(_to_rest(restitution) for restitution in (0.5, 0.8, 0.9)),
    quantities=(
        Quantity(
            "rest_time",
            "time of rest",
            "s",
            lambda trajectory: measure.rest_time(trajectory, "ball"),
            _expect_rest_time,
            lambda case: truth.bounce_end(DROP_HEIGHT, case.parameters["restitution"], GRAVITY),
            absent="never rests",
        ),
        Quantity(
            "rest_height",
            "gap at rest",
            "m",
            lambda trajectory: measure.rest_height(trajectory, "ball", "floor"),
            _expect_rest,
        ),
        Quantity(
            "residual_speed",
            f"speed in the last {WINDOW:g} s",
            "m/s",
            lambda trajectory: measure.residual_speed(trajectory, "ball", WINDOW),
            at_rest,
        ),
        Quantity(
            "drift",
            f"drift in the last {WINDOW:g} s",
            "m",
            lambda trajectory: measure.drift(trajectory, "ball", WINDOW),
            _expect_rest,
        ),
    ),
    curve=Curve("e=0.8", "The bounces at e = 0.8", "gap below the ball, m", _gap, until=5.0),
    convergence=Convergence("e=0.5", "rest_time", (2.0, 1.0, 0.5, 0.25), every_step=True),
    grid=Grid((Parameter("restitution", "", TENTHS[1:10], 0.5),), (1e-3, 2e-3, 5e-3), _to_rest),
    predict=bouncing.predict_to_rest,
)

FAMILIES = (DROPPED_BALL, BALL_TO_REST)
