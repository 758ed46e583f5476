"""A slab at rest under a push that grows until friction can no longer hold it (slides 23 and 24)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from reference import friction_truth
from reference.catalogue import measure
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.catalogue.scenarios.friction import slab_on_plane, way_of
from reference.catalogue.scenarios.tolerances import ROUNDING, within_a_millimetre
from reference.engines.base import CIRCLE, EXACT, MUJOCO_ONE_STEP, WORLD, Method
from reference.errors import RunFailed
from reference.prediction import sliding
from reference.scene.forces import GrowingForce
from reference.scene.scenario import GRAVITY, Pair, Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

MASS = 1.5
"""kg."""
LATER, TACT = 0.25, 0.05
"""A run ends at least so long after the break-away, s, and at a multiple of this: a whole number of all timesteps."""
READ_AT = 0.1
"""The speed from which the instant of break-away is read, m/s: far above what a slab that holds creeps with."""
BEFORE = 0.9
"""Share of the time to the break-away at which a slab that creeps is looked at."""
SHARE = 0.01
RADIAN = math.degrees(1.0)


@dataclass(frozen=True)
class _Push:
    """What decides: coefficients of friction, rate, N/s, of the push, heading, rad, instant of break-away, s."""

    static: float
    kinetic: float
    rate: float
    heading: float

    @property
    def leaves(self) -> float:
        """When static friction has to be μ_s m g, s."""
        return self.static * MASS * GRAVITY / self.rate

    @property
    def end(self) -> float:
        """When the run ends, s."""
        return TACT * math.ceil((self.leaves + LATER) / TACT - 1e-9)


def _push_of(scenario: Scenario) -> _Push:
    (pair,), (force,) = scenario.pairs, scenario.forces
    x, y, _ = force.at(1.0)
    return _Push(pair.static_friction or 0.0, pair.kinetic_friction, math.hypot(x, y), math.atan2(y, x))


def _case(friction: float, rate: float, degrees: float = 0.0, static: float = 0.0) -> Case:
    push = _Push(static or friction, friction, rate, math.radians(degrees))
    two, turned = f"μs={static:g},μk=" if static else "μ=", f",heading={degrees:g}°" if degrees else ""
    name = f"{two}{friction:g},rate={rate:g}{turned}"
    scenario = slab_on_plane(f"break-away/{name}", friction, 0.0, 0.0, push.end)
    bodies = tuple(body if body.immovable else replace(body, mass=MASS) for body in scenario.bodies)
    force = GrowingForce("slab", (rate * math.cos(push.heading), rate * math.sin(push.heading), 0.0))
    pairs = (Pair("slab", "plane", kinetic_friction=friction, static_friction=push.static),)
    scenario = replace(scenario, bodies=bodies, pairs=pairs, forces=(force,))
    return Case(name, (scenario,), {"friction": friction, "static": push.static, "rate": rate, "angle": degrees})


def _of(case: Case) -> _Push:
    return _push_of(case.scenarios[0])


# What is measured


def _reading(trajectory: Trajectory) -> int:
    """The first sample at which the slab is fast enough."""
    speed = np.linalg.norm(trajectory.velocity("slab"), axis=1)
    if not np.any(speed >= READ_AT):
        raise RunFailed("the slab has not broken away by the end")
    return int(np.argmax(speed >= READ_AT))


def _left(trajectory: Trajectory) -> float:
    """The instant of break-away, s: from the speed a little later, back to where the law of the slide has it at zero.

    With τ from the break-away on the speed is (μ_s − μ_k) g τ + R τ²/(2 m).
    """
    at, push = _reading(trajectory), _push_of(trajectory.scenario)
    return float(trajectory.times[at]) - _later(push, float(np.linalg.norm(trajectory.velocity("slab")[at])))


def _held(trajectory: Trajectory) -> float:
    """The push at that instant, N."""
    return _push_of(trajectory.scenario).rate * _left(trajectory)


def _rubs(trajectory: Trajectory) -> float:
    """Mean friction from a little after the break-away to the end, N: what the push has that the slab does not get."""
    at, push = _reading(trajectory), _push_of(trajectory.scenario)
    along = trajectory.velocity("slab") @ np.array([math.cos(push.heading), math.sin(push.heading), 0.0])
    times = trajectory.times
    if at == len(times) - 1:
        raise RunFailed("the slab has broken away only at the end")
    acceleration = (along[-1] - along[at]) / (times[-1] - times[at])
    return float(push.rate * (times[at] + times[-1]) / 2 - MASS * acceleration)


def _heading(trajectory: Trajectory) -> float:
    """Direction of the way, from the x axis, degrees."""
    way = trajectory.position("slab")[-1] - trajectory.position("slab")[0]
    return math.degrees(math.atan2(way[1], way[0]))


def _creep(trajectory: Trajectory) -> float:
    early = trajectory.times <= BEFORE * _push_of(trajectory.scenario).leaves
    return float(np.max(way_of(trajectory)[early]))


# What is expected


def _by_cone(case: Case, cone: str) -> tuple[float, tuple[float, float]]:
    """Instant of break-away as it is read, s, and place at the end, m, with one of the cones; for one coefficient.

    The reading takes a push to move the slab with all its growth. What moves it with a share is faster later.
    """
    push = _of(case)
    share = friction_truth.moving_share(cone, push.heading)
    late = (1 / math.sqrt(share) - 1) * math.sqrt(2 * MASS * READ_AT / push.rate)
    earlier = friction_truth.least_push(cone, push.heading) * push.leaves + late
    place = friction_truth.end_of_pushed_way(cone, push.kinetic, MASS, GRAVITY, push.rate, push.heading, push.end)
    return earlier, place


def _way(case: Case) -> float:
    push = _of(case)
    return friction_truth.way_after_break_away(
        push.static, push.kinetic, MASS, GRAVITY, push.rate, push.end - push.leaves
    )


def _near(exact: float, method: Method, why: str, by_cone: float, scale: float = 1.0) -> Expectation:
    """Expect a number; where the cone is none of Coulomb's, with what that is known to make of it."""
    if method.kind == EXACT:
        return Expectation(exact, ROUNDING * abs(exact), "rounding only: the instant is solved for")
    other = by_cone - exact if method.cone != CIRCLE else 0.0
    return Expectation(
        exact,
        SHARE * abs(exact),
        why,
        other,
        f"its friction cone is a {method.cone}" if other else "",
        SHARE * abs(by_cone) * scale,
    )


def _expect_left(case: Case, settings: Settings, method: Method) -> Expectation:
    why = "1 %: a step method notices the break-away up to a step late"
    return _near(_of(case).leaves, method, why, _by_cone(case, method.cone)[0])


def _expect_held(case: Case, settings: Settings, method: Method) -> Expectation:
    why = "1 %: a step method notices the break-away up to a step late"
    rate = _of(case).rate
    found = _near(rate * _of(case).leaves, method, why, rate * _by_cone(case, method.cone)[0])
    return replace(found, size=rate)  # it is read as an instant: what is off in seconds is off the rate's times in N


def _expect_rubs(case: Case, settings: Settings, method: Method) -> Expectation | None:
    """None where the friction of another cone changes with the push."""
    if method.cone != CIRCLE and case.parameters["angle"]:
        return None
    exact = _of(case).kinetic * MASS * GRAVITY
    return _near(exact, method, "1 %: the push of a step is that of its start, R dt/2 less than its mean", exact)


def _expect_way(case: Case, settings: Settings, method: Method) -> Expectation:
    exact, by_cone = _way(case), math.hypot(*_by_cone(case, method.cone)[1])
    return _near(exact, method, "1 %: a step late at the break-away", by_cone)


def _expect_heading(case: Case, settings: Settings, method: Method) -> Expectation:
    exact = math.degrees(_of(case).heading)
    if method.kind == EXACT:
        return Expectation(exact, ROUNDING * RADIAN, "rounding only", size=RADIAN)
    x, y = _by_cone(case, method.cone)[1]
    other = math.degrees(math.atan2(y, x)) - exact if method.cone != CIRCLE else 0.0
    why = f"its friction cone is a {method.cone}" if other else ""
    return Expectation(exact, 1.0, "1°: nobody sees it", other, why, 1.0, RADIAN)


def _slack_of_friction(case: Case, settings: Settings, method: Method) -> float:
    """In MuJoCo a corner that is off the ground for a step takes up to g dt from the friction on the slab, at each end.

    0.15 s: what is left at least from the reading to the end.
    """
    return 2 * MASS * GRAVITY * settings.timestep / 0.15 if method.rule == MUJOCO_ONE_STEP else 0.0


def _later(push: _Push, speed: float) -> float:
    """How long after the break-away the slide's law has a speed, s."""
    start, growth = (push.static - push.kinetic) * GRAVITY, push.rate / MASS
    return (math.sqrt(start**2 + 2 * growth * speed) - start) / growth


def _slack_of_instant(case: Case, settings: Settings, method: Method) -> float:
    """How much earlier the instant seems, s, where a speed is read too large.

    In MuJoCo the slab rocks under friction, and now and then stands on two corners alone. In such a step it gets none
    of the friction, and its speed is μ g dt larger for as long. So a sample may have the speed that is read, which was
    to come later. By hand the corners share the friction as the sweeps find it: where it falls once a corner slips, the
    slab may leave a step early.
    """
    push = _of(case)
    if method.rule == WORLD and push.static > push.kinetic:
        return settings.timestep
    if method.rule != MUJOCO_ONE_STEP:
        return 0.0
    most = push.kinetic * GRAVITY * settings.timestep
    return _later(push, READ_AT) - _later(push, max(READ_AT - most, 0.0))


def _slack_of_push(case: Case, settings: Settings, method: Method) -> float:
    """The same in what the push grows by in that time, N."""
    return _of(case).rate * _slack_of_instant(case, settings, method)


def _limit(case: Case) -> float:
    return _of(case).static * MASS * GRAVITY


BREAK_AWAY = Family(
    name="break-away",
    title="Break-away under a growing push",
    topic="friction",
    statements=(24, 23),
    about=f"A slab of {MASS:g} kg rests on a level floor. A push grows evenly from nothing, along an axis or at 30° to"
    " the axes, until friction can no longer hold the slab. In one case static friction is larger than kinetic"
    " friction.",
    expected="Static friction is as large as the push, up to `μ_s m g`. With a push of `R t` the slab breaks away at"
    " `t = μ_s m g/R`. From then on `μ_k m g` opposes the push, and with the time `τ` since the break-away"
    " the way is `(μ_s − μ_k) g τ²/2 + R τ³/(6 m)`.",
    why=(
        "Tuned engines and stepped code notice the break-away at a step, half a step late on average, and then follow"
        " the law. Exact code solves for the instant.",
        "PyBullet and DART distribute friction over the four corners by sweeps. In the step of the break-away the"
        " sweeps stop before they have converged. The error of the speed is then at most what the growth of the push"
        " in one step adds to it. In the hand-written world a corner may even let go one step early. Where static"
        " friction is larger than kinetic friction, the whole slab then breaks away with that corner.",
        "Below the limit tuned MuJoCo creeps by micrometres: friction turns the slab about its centre, and the normal"
        " forces of the next step turn it back. A harder push turns it farther.",
        "The friction cones of two stock engines are no circles, and a push at 30° shows it. MuJoCo's diamond lets the"
        " slab go at 73 % of the push that Coulomb's law allows, `1/(cos φ + sin φ)`, and the slab slides off towards"
        " 45°. DART's square holds the slab up to 115 %, `1/cos φ`, and the slab slides off along the axis.",
    ),
    cases=(
        _case(0.3, 20.0),
        _case(0.5, 30.0),
        _case(0.4, 20.0, degrees=30.0),
        _case(0.3, 30.0, static=0.5),
    ),
    quantities=(
        Quantity(
            "break_away",
            "instant of break-away",
            "s",
            _left,
            _expect_left,
            lambda case: _of(case).leaves,
            _slack_of_instant,
            absent="never breaks away",
        ),
        Quantity(
            "push",
            "push at the break-away",
            "N",
            _held,
            _expect_held,
            _limit,
            _slack_of_push,
            absent="never breaks away",
        ),
        Quantity(
            "friction",
            "friction while it slides",
            "N",
            _rubs,
            _expect_rubs,
            lambda case: _of(case).kinetic * MASS * GRAVITY,
            _slack_of_friction,
            absent="never breaks away",
        ),
        Quantity(
            "way",
            "way by the end of the run",
            "m",
            lambda trajectory: measure.displacement(trajectory, "slab"),
            _expect_way,
            _way,
        ),
        Quantity("heading", "heading of the path", "°", _heading, _expect_heading),
        Quantity("creep", f"creep by {BEFORE:.0%} of that instant", "m", _creep, within_a_millimetre),
    ),
    curve=Curve("μ=0.3,rate=20", "Break-away at μ = 0.3, push 20 N/s", "distance, m", way_of),
    convergence=Convergence("μ=0.5,rate=30", "break_away"),
    grid=Grid(
        (Parameter("friction", "", (0.2, 0.3, 0.4, 0.6), 0.3), Parameter("rate", "N/s", (10.0, 20.0, 40.0), 20.0)),
        (1e-3, 5e-3),
        lambda friction, rate: _case(friction, rate),
    ),
    predict=sliding.predict,
)

FAMILIES = (BREAK_AWAY,)
