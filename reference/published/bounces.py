"""Published bounces: balls that fall on a floor, answered at once or at the step."""

from __future__ import annotations

import numpy as np

from reference.arrays import Array, Mask
from reference.engines.implementation import Implementation
from reference.published import Answers, Published, said
from reference.published.in_engines import bouncing

UP = np.array([0.0, 0.0, 1.0])


def elastic_balls(case: Published, code: Implementation) -> Answers:
    """P1: the mean squared error of the energy of balls that are answered at the step, as ODE and as Bullet do it."""
    ode = [_energy_error(case, code, dt, weighed=False) for dt in case.values("timesteps")]
    bullet = [_energy_error(case, code, dt, weighed=True) for dt in case.values("timesteps")]
    return said(ode=tuple(ode), bullet=tuple(bullet))


def _energy_error(case: Published, code: Implementation, dt: float, weighed: bool) -> float:
    """Mean of (E − E0)², E before each step. weighed: the impact turns back what gravity adds in its step as well."""
    pull, left = -case.value("gravity") * UP, round(case.value("duration") / dt)
    respond = code.function("kinematic_response")
    z, v, energies = case.value("height") * UP, 0 * UP, []
    while left:
        places, speeds = _flight(code, z, v, pull, dt, left)
        struck = _touches(case, code, places) & (speeds[:, 2] < 0)
        steps = int(np.argmax(struck)) if struck.any() else left - 1
        energies.append(case.value("gravity") * places[: steps + 1, 2] + speeds[: steps + 1, 2] ** 2 / 2)
        v = respond(speeds[steps] + (pull * dt if weighed else 0.0), UP, 1.0)
        z, left = places[steps] + v * dt, left - steps - 1
    energy = case.value("balls") * case.value("mass") * np.concatenate(energies)
    return float(np.mean((energy - energy[0]) ** 2))


def _flight(
    code: Implementation,
    z: Array,
    v: Array,
    pull: Array,
    dt: float,
    steps: int,
) -> tuple[Array, Array]:
    """Position and velocity before each of so many steps v' = v + g dt, z' = z + v' dt, without a floor.

    The positions lie on the parabola that starts g dt/2 faster: all of them at once, and exactly.
    """
    times = dt * np.arange(steps)
    places, speeds = code.function("ballistic_motion")(z, v + pull * dt / 2, pull, times)
    return places, speeds - pull * dt / 2


def _touches(case: Published, code: Implementation, places: Array, slop: float = 0.0) -> Mask:
    """Whether a ball reaches the floor, for positions of its centre."""
    gaps = code.function("signed_distance")(places, UP, -case.value("radius"))
    found: Mask = code.function("side_of_plane")(gaps, slop) <= 0
    return found


def answered_at_the_step(case: Published, code: Implementation) -> Answers:
    """P12: a thousand steps, each with an impact or with gravity."""
    respond, step = code.function("kinematic_response"), code.function("semi_implicit_euler")
    dt, pull = case.value("timestep"), -case.value("gravity") * UP
    z, v = case.value("height") * UP, 0 * UP
    for _ in range(int(case.value("steps"))):
        if v[2] < 0 and _touches(case, code, z, case.value("slop")):
            v = respond(v, UP, case.value("restitution"))
            z = z + v * dt
        else:
            z, v = step(z, v, pull, dt)
    return said(height=float(z[2]), velocity=float(v[2]))


def apexes(case: Published, code: Implementation) -> Answers:
    """P5: heights above the contact, from impact to impact."""
    height, radius = case.values("height", "radius")
    return said(apexes=_bounces(code, height - radius, case.value("restitution"), case.value("gravity"), 3)[1])


def impacts_and_rest(case: Published, code: Implementation) -> Answers:
    """P15: from impact to impact, and the end of infinitely many."""
    height, e, gravity = case.values("height", "restitution", "gravity")
    impacts, heights = _bounces(code, height, e, gravity, 6)
    rest = float(code.function("time_until_rest")(height, 0.0, -gravity, e))
    return said(impacts=impacts, apexes=heights[:4], rest=rest)


def rebounds(case: Published, code: Implementation) -> Answers:
    """P26: the first rebound of each ball."""
    drops = zip(case.values("drop"), case.values("restitution"), strict=True)
    return said(rebound=tuple(_bounces(code, drop, e, case.value("gravity"), 1)[1][0] for drop, e in drops))


def _bounces(
    code: Implementation, height: float, restitution: float, gravity: float, count: int
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Instants of the first impacts, and the apexes after them."""
    fall, fly = code.function("time_of_impact_exact"), code.function("ballistic_motion")
    respond = code.function("kinematic_response")
    z, v, pull, time, impacts, heights = height * UP, 0 * UP, -gravity * UP, 0.0, [], []
    for _ in range(count):
        until = float(fall(z[2], v[2], -gravity))
        z, v = fly(z, v, pull, until)
        v, time = respond(v, UP, restitution), time + until
        impacts.append(time)
        heights.append(float(fly(z, v, pull, v[2] / gravity)[0][2]))
    return tuple(impacts), tuple(heights)


def first_rebound(case: Published, code: Implementation) -> Answers:
    """P6: drops of that timestep, with the impacts met within the step; the highest sample of the rebound."""
    dt, radius, e = case.value("timestep"), case.value("radius"), np.array(case.values("restitution"))
    step, pull = code.function("bounce_through_step"), -case.value("gravity") * UP
    z, v, bounced, highest = np.outer(np.ones_like(e), case.value("height") * UP), np.zeros((len(e), 3)), e < 0, 0 * e
    for _ in range(round(0.9 / dt)):  # s: 0.44 of fall, and at most 0.35 up again
        z, v, impacts, _ = step(z, v, pull, UP, -radius, e, dt)
        bounced |= impacts > 0
        highest = np.where(bounced, np.maximum(highest, z[:, 2] - radius), 0.0)
    return said(ratio=tuple((highest / (case.value("height") - radius)).tolist()))


CASES = (
    Published(
        1,
        "Elastic balls bounce on the floor for 20 s",
        6,
        "cross-engine",
        "SimBenchmark (leggedrobotics), test bouncing: columns of ODE and of Bullet's multibodies",
        {"balls": 49, "mass": 10.0, "radius": 0.1, "height": 5.0, "gravity": 9.81, "duration": 20.0,
         "timesteps": (1e-2, 4e-3, 1e-3, 4e-4, 1e-4)},
        {"ode": (18808.3, 2982.68, 185.027, 29.631, 1.85055),
         "bullet": (7.40664e6, 1.20178e6, 75245.4, 12038.5, 752.345)},
        {"ode": (5e-2, 5e-3, 5e-4, 5e-4, 5e-6), "bullet": (5.0, 5.0, 5e-2, 5e-2, 5e-4)},
        "half of the last digit printed",
        "Mean of (E − E0)², J², with E the energy of all balls before each step. Both answer at the step: where it "
        "starts with z ≤ R and v < 0, ODE sets v' = −v and Bullet v' = −(v − g dt). The height is that of the centre.",
        origin="pybullet",
        units={"ode": "J²", "bullet": "J²"},
        labels=dict.fromkeys(("ode", "bullet"), ("10 ms", "4 ms", "1 ms", "0.4 ms", "0.1 ms")),
        by_hand=elastic_balls,
        in_engine=bouncing.elastic_balls,
    ),
    Published(
        5,
        "Apexes of a bouncing ball",
        7,
        "verification",
        "MFiX, verification and validation, DEM02",
        {"radius": 0.1, "height": 0.5, "restitution": 0.9, "gravity": 9.81},
        {"apexes": (0.3240, 0.26244, 0.21258)},
        {"apexes": 5e-6},
        "five printed decimals of e²ⁿ (h − r)",
        "The height is that of the centre; apexes are counted from the height of the centre at contact.",
        units={"apexes": "m"},
        by_hand=apexes,
        in_engine=bouncing.apexes,
    ),
    Published(
        6,
        "Height of the first rebound",
        3,
        "verification",
        "Newton (physics engine), verification and validation of restitution",
        {"gravity": 10.0, "height": 1.0, "radius": 0.05, "restitution": (0.5, 0.8), "timestep": 1e-3},
        {"ratio": (0.25, 0.64)},
        {"ratio": (0.0025, 0.0064)},
        "their own 1 %; a sample of ours is at most g (dt/2)²/2 = 1.3 µm below the top",
        "Rebound over drop, both measured from the contact: e².",
        labels={"ratio": ("e = 0.5", "e = 0.8")},
        by_hand=first_rebound,
        in_engine=bouncing.first_rebounds,
    ),
    Published(
        12,
        "A thousand steps of a ball that bounces",
        6,
        "verification",
        "Jolt Physics, unit tests",
        {"radius": 2.0, "height": 10.0, "restitution": 0.9, "gravity": 9.81, "timestep": 1 / 60, "steps": 1000,
         "slop": 0.02},
        {"height": 2.770886, "velocity": 0.588448},
        {"height": 1e-5, "velocity": 1e-5},
        "the tolerance of the test itself",
        "In each step: if y − R < slop and v < 0, v' = −e v, else v' = v − g dt; then y' = y + v' dt.",
        units={"height": "m", "velocity": "m/s"},
        by_hand=answered_at_the_step,
        in_engine=bouncing.thousand_steps,
    ),
    Published(
        15,
        "Impacts, apexes and the end of a bouncing ball",
        3,
        "verification",
        "Siconos, example BouncingBallED (event-driven)",
        {"height": 1.0, "restitution": 0.9, "gravity": 9.81},
        {"impacts": (0.45152, 1.26427, 1.99573, 2.65406, 3.24655, 3.77979),
         "apexes": (0.81, 0.6561, 0.53144, 0.43047), "rest": 8.57895},
        {"impacts": 5e-6, "apexes": 5e-6, "rest": 5e-6},
        "half of the last of five printed decimals",
        "The height is that of the gap.",
        units={"impacts": "s", "apexes": "m", "rest": "s"},
        by_hand=impacts_and_rest,
        in_engine=bouncing.impacts_and_rest,
    ),
    Published(
        26,
        "Rebounds that the rules of two sports ask for",
        7,
        "validation",
        "ITF rules of tennis and ITTF technical leaflet on balls: measured rebounds",
        {"drop": (2.54, 2.54, 0.305, 0.305), "restitution": (0.729, 0.761, 0.887, 0.923), "gravity": 9.81},
        {"rebound": (1.35, 1.47, 0.240, 0.260)},
        {"rebound": (2e-3, 2e-3, 3e-4, 3e-4)},
        "e is given to ±0.0005: 2 e h times that is 1.9 mm for tennis, 0.3 mm for table tennis",
        "The coefficients are apparent ones: drag of the air is in them.",
        units={"rebound": "m"},
        labels={"rebound": ("tennis, least", "tennis, most", "table tennis, least", "table tennis, most")},
        by_hand=rebounds,
        in_engine=bouncing.measured_rebounds,
    ),
)  # fmt: skip
