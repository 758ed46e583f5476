"""A rod that is struck, or dropped on a peg, at its centre and at its end (slides 14 to 21)."""

from __future__ import annotations

from collections.abc import Callable

from reference import truth
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import TENTHS, Grid, Parameter
from reference.engines import pybullet_settings
from reference.engines.base import AT_STEP, EXACT, Method
from reference.prediction import striking
from reference.scene.scenario import GRAVITY, Body, Box, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

HALF_LENGTH, HALF_WIDTH, HALF_THICKNESS = 0.5, 0.03, 0.02
"""Half lengths of the rod along x, y and z, m."""
ROD_MASS = BALL_MASS = 1.0
"""kg."""
RADIUS = 0.05
"""Radius of the ball that strikes, and of the peg, m."""
END = HALF_LENGTH - 1e-3
"""Arm of an impact at the end, m: PyBullet's boxes are round within a millimetre of their edges."""
SPEED = 2.0
"""Speed of the ball that strikes, m/s."""
FLIGHT = 0.25034
"""Time until the ball strikes, s. A quarter of a second would be a whole number of 0.1, 1, 2 and 5 ms and of 1/240 s,
and rounding would decide in which step the impact is noticed."""
DROP_HEIGHT = 0.5
"""Gap between the rod and the peg at the start, m."""
AFTER = 0.05
"""How long is watched after the impact, s."""
SHARE, ROUNDING = 1e-3, 1e-9
"""Accepted share of a value, 0.1 %, and what rounding leaves, in its unit."""
ARMS = (0.0, 0.25, END)
ARM = Parameter("arm", "m", (0.0, 0.125, 0.25, 0.375, END), END)
Measure = Callable[[Trajectory], float]


def _rod(height: float = 0.0) -> Body:
    return Body("rod", Box((HALF_LENGTH, HALF_WIDTH, HALF_THICKNESS)), ROD_MASS, (0.0, 0.0, height))


def _struck(restitution: float, arm: float) -> Case:
    name, height = f"e={restitution:g},x={arm:g}", HALF_THICKNESS + RADIUS + SPEED * FLIGHT
    ball = Body("ball", Sphere(RADIUS), BALL_MASS, (arm, 0.0, height), velocity=(0.0, 0.0, -SPEED))
    pair = Pair("ball", "rod", restitution)
    scenario = Scenario(f"struck-rod/{name}", (_rod(), ball), (pair,), FLIGHT + AFTER, (0.0, 0.0, 0.0))
    return Case(name, (scenario,), {"restitution": restitution, "arm": arm, "speed": SPEED})


def _dropped(restitution: float, arm: float) -> Case:
    name = f"e={restitution:g},x={arm:g}"
    peg = Body("peg", Sphere(RADIUS), position=(arm, 0.0, 0.0))
    rod = _rod(RADIUS + HALF_THICKNESS + DROP_HEIGHT)
    duration = truth.fall_time(DROP_HEIGHT, GRAVITY) + AFTER
    scenario = Scenario(f"rod-on-peg/{name}", (peg, rod), (Pair("peg", "rod", restitution),), duration)
    speed = truth.impact_speed(DROP_HEIGHT, GRAVITY)
    return Case(name, (scenario,), {"restitution": restitution, "arm": arm, "speed": speed})


def _falls(case: Case) -> bool:
    """Whether the rod falls on the peg; else it floats, and the ball strikes it."""
    return any(case.scenarios[0].gravity)


def _impulse_of(case: Case) -> float:
    """Impulse ÷ (m v), of a rod of 1 kg and what it meets: the ball, or the peg, which nothing moves."""
    softness = truth.rod_softness(ROD_MASS, case.parameters["arm"], HALF_LENGTH, HALF_THICKNESS)
    softness += 0.0 if _falls(case) else 1 / BALL_MASS
    return truth.impact_impulse(1.0, case.parameters["restitution"], softness)


def _spin_of(case: Case) -> float:
    """Spin that the impulse gives the rod, ω = j x/I, rad/s."""
    per_mass = (HALF_LENGTH**2 + HALF_THICKNESS**2) / 3
    return _impulse_of(case) * case.parameters["speed"] * case.parameters["arm"] / per_mass


def _restitution(case: Case) -> float:
    return case.parameters["restitution"]


def _turned(case: Case) -> float:
    """Change of the closing speed ÷ that speed."""
    return 1 + _restitution(case)


def _fastest_spin(case: Case) -> float:
    """A spin at which the rod's ends move as fast as what strikes, rad/s."""
    return case.parameters["speed"] / HALF_LENGTH


def _expect(
    exact_of: Callable[[Case], float], scale_of: Callable[[Case], float], moved_by: Callable[[Case], float]
) -> Callable[[Case, Settings, Method], Expectation]:
    """Expect what theory says, within 0.1 % of half a scale. Where the rod falls, a step adds its weight to the impact.

    The impulse carries the weight of the step; a step that turns back what it has just added carries 1 + e times as
    much. The speed differs by up to g dt/2. All three figures differ by the share of the impulse, the restitution by
    that of 1 + e.
    """

    def expect(case: Case, settings: Settings, method: Method) -> Expectation:
        exact, restitution, near = exact_of(case), case.parameters["restitution"], SHARE * scale_of(case) / 2
        if method.kind == EXACT:
            return Expectation(exact, ROUNDING, "rounding only")
        if not _falls(case) or method.kind != AT_STEP:
            return Expectation(exact, near, "0.1 %: nothing but the impact changes a velocity", shift_reason=_WHY)
        step = GRAVITY * settings.timestep / case.parameters["speed"] * moved_by(case)
        carried = step * (1 + method.weighed * restitution) / (1 + restitution)
        why = "the impulse carries the weight of the step, and the speed differs by up to g dt/2"
        return Expectation(exact, near, "0.1 %", carried, why, near + step / 2)

    return expect


_WHY = "a contact of some steps notices its dashpot up to a step late"
"""Why a number is away from theory where no step's weight tells."""


def _impulse_on_the_ball(trajectory: Trajectory) -> float:
    velocity = trajectory.velocity("ball")[:, 2]
    return float(velocity[-1] - velocity[0]) / SPEED


def _impulse_of_the_peg(trajectory: Trajectory) -> float:
    """Change of the rod's momentum ÷ (m v), less the part that its weight has made."""
    velocity, time = trajectory.velocity("rod")[:, 2], trajectory.times[-1]
    return float(velocity[-1] - velocity[0] + GRAVITY * time) / truth.impact_speed(DROP_HEIGHT, GRAVITY)


def _spin_from_above(trajectory: Trajectory) -> float:
    """About y, the way that a ball from above turns the rod."""
    return float(trajectory.angular_velocity("rod")[-1, 1])


def _spin_from_below(trajectory: Trajectory) -> float:
    """About −y, the way that a peg turns it."""
    return -float(trajectory.angular_velocity("rod")[-1, 1])


def _point_of_the_rod(trajectory: Trajectory, arm: float) -> float:
    """Velocity that its spin gave the point of the rod that was struck, along z, m/s: that of ω × r."""
    return -float(trajectory.angular_velocity("rod")[-1, 1]) * arm


def _kept_by_the_ball(trajectory: Trajectory) -> float:
    rod = trajectory.velocity("rod")[-1, 2] + _point_of_the_rod(
        trajectory, trajectory.scenario.body("ball").position[0]
    )
    return float(trajectory.velocity("ball")[-1, 2] - rod) / SPEED


def _kept_by_the_peg(trajectory: Trajectory) -> float:
    spun = _point_of_the_rod(trajectory, trajectory.scenario.body("peg").position[0])
    return _impulse_of_the_peg(trajectory) - 1 + spun / truth.impact_speed(DROP_HEIGHT, GRAVITY)


def _quantities(impulse: Measure, spin: Measure, kept: Measure) -> tuple[Quantity, ...]:
    return (
        Quantity(
            "impulse", "impulse ÷ (m v)", "", impulse, _expect(_impulse_of, lambda case: 2.0, _impulse_of), _impulse_of
        ),
        Quantity("spin", "spin of the rod", "rad/s", spin, _expect(_spin_of, _fastest_spin, _spin_of), _fastest_spin),
        Quantity(
            "kept",
            "kept of the closing speed",
            "",
            kept,
            _expect(_restitution, lambda case: 2.0, _turned),
            _restitution,
        ),
    )


STRUCK_ROD = Family(
    name="struck-rod",
    title="Rod struck by a ball",
    topic="impulse",
    statements=(11, 12, 13, 14, 15, 18, 19, 20, 21),
    about=f"A ball of 1 kg flies at {SPEED:g} m/s straight at a rod of 1 kg and {2 * HALF_LENGTH:g} m that floats"
    " at rest, and strikes it at its centre, half-way out, or a millimetre from its end.",
    expected="A unit impulse moves the point of the rod that it meets by `k = 1/M + x²/I`, an arm `x` from the"
    " centre: at the end four times as easily as at the centre. So `j = (1 + e) v/(1/m + k)`, and for every"
    " arm the two points separate with `e` of the speed at which they met.",
    why=(
        "The ball meets a flat face, straight on, and there is no weight, so an engine's only error is what its"
        " contact does to any speed: rounding in PyBullet, and a small share of the speed in DART and MuJoCo. At the"
        " very end it would be otherwise, because PyBullet's boxes are round within"
        f" {1e3 * pybullet_settings.MARGIN:g} mm of their edges: hence the millimetre.",
        "MuJoCo's spring profile keeps a little too little or too much of the closing speed, since some sixteen steps"
        " a contact notice its dashpot late.",
    ),
    cases=tuple(_struck(restitution, arm) for restitution in (0.5, 1.0) for arm in ARMS),
    quantities=_quantities(_impulse_on_the_ball, _spin_from_above, _kept_by_the_ball),
    curve=Curve(
        "e=1,x=0.499",
        "Struck at its end, e = 1",
        "spin, rad/s",
        lambda trajectory: trajectory.angular_velocity("rod")[:, 1],
    ),
    convergence=Convergence("e=0.5,x=0.499", "spin"),
    # Not at e = 0: the two stay together, and the ball keeps pushing the rod as it turns.
    grid=Grid((Parameter("restitution", "", TENTHS[1:], 0.5), ARM), (1e-3, 2e-3, 5e-3), _struck),
    predict=striking.predict,
)

ROD_ON_PEG = Family(
    name="rod-on-peg",
    title="Rod dropped on a peg",
    topic="impulse",
    statements=(11, 12, 13, 14, 15, 18, 19, 20, 21),
    about=f"A level rod of 1 kg and {2 * HALF_LENGTH:g} m falls {DROP_HEIGHT:g} m onto a peg under its centre,"
    " half-way out, or a millimetre from its end.",
    expected="The peg stands for a body of infinite mass: `j = (1 + e) v/(1/M + x²/I)`. Under the centre that is `(1"
    " + e) M v`, and the rod rebounds level. Under the end of a thin rod it is a quarter of that: the rod's"
    " centre keeps falling, and the rod turns. This rod, 4 cm thick and met 1 mm from its end, gets 0.251"
    " of it.",
    why=(
        "The impulse of a step carries the weight of that step, and the speed of an impact differs by up to `g"
        " dt/2`: 0.1 to 0.4 % at 1 ms, and nothing else.",
    ),
    cases=tuple(_dropped(restitution, arm) for restitution in (0.5, 1.0) for arm in ARMS),
    quantities=_quantities(_impulse_of_the_peg, _spin_from_below, _kept_by_the_peg),
    curve=Curve(
        "e=0.5,x=0.499",
        "On a peg at its end, e = 0.5",
        "height of the centre, m",
        lambda trajectory: trajectory.position("rod")[:, 2],
    ),
    convergence=Convergence("e=0.5,x=0.499", "spin"),
    # Not below: the rod would be back on the peg before it has been watched, and the peg would carry its weight.
    grid=Grid((Parameter("restitution", "", TENTHS[2:], 0.5), ARM), (1e-3, 2e-3, 5e-3), _dropped),
    predict=striking.predict,
)

FAMILIES = (STRUCK_ROD, ROD_ON_PEG)
