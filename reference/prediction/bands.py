"""The terms of a band: each thing that keeps a right implementation from its recurrence, and by how much at most.

A band is the sum of its terms. Each is a share of the number, or of its size where the number is smaller; the size is
one unit unless the quantity says otherwise. Most terms are derived, and say from what. A few follow no rule that we
know. They were measured on random scenes, which `tests/reference/prediction/test_bands.py` draws and measures again.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from reference.scene.polyhedron import Polyhedron
from reference.scene.pressed import SWEEPS_PER_RATIO, sweeps_needed
from reference.scene.scenario import Body, Scenario


class Term(NamedTuple):
    """One term of a band: what it is, and how large it may be."""

    name: str
    share: float


# Rounding

ULP = 2.0**-52
"""Distance from 1 to the next number in double precision. A result is rounded by half of it at most."""
IN_SINGLE = 2.0**-24
"""Largest share by which single precision changes a number that is stored in it."""
IN_A_STEP = 10
"""Roundings of a step, in ulps: both runs make as many halves of an ulp."""
IN_A_NUMBER = 64
"""Roundings, in ulps, of a number that is read from states: a sum or a quotient of a handful of coordinates, some of
which are ten times as large as the number."""
IN_A_CONTACT = 64
"""Roundings, in half ulps, between the poses of two bodies and their impulse: a normal, two arms, K and a quotient."""


def steps(count: int) -> Term:
    """Rounding of so many steps, which both runs make in an order of their own.

    A step rounds a velocity and a position by half an ulp each. A quaternion takes some ten roundings: its turn's sine
    and cosine, four products added up, and its length.
    """
    return Term("rounding of the steps", (IN_A_STEP * count + IN_A_NUMBER) * ULP)


def contact(timestep: float) -> Term:
    """Rounding of a contact. In one step it may turn a gap into a speed: an ulp of 1 m into 1/dt ulps of 1 m/s."""
    return Term("rounding in a contact", IN_A_CONTACT * ULP * (1 + 1 / timestep))


def magnified(growth: float) -> Term:
    """The rounding of the first steps, as the motion magnifies it. growth: how many times, by the recurrence itself."""
    return Term("rounding that the motion magnifies", IN_A_STEP * ULP * growth)


IN_A_FORCE, IN_A_GRIP = 4, 3
"""Roundings, in half ulps, of the accelerations of which MuJoCo's noslip passes make a normal force, and of what they
take off again where friction ends a slip."""


def in_noslip(pressed: float, gripped: float) -> Term:
    """Rounding in MuJoCo's noslip passes, which take velocities from the forces and not from the main solver.

    A normal force is (a_ref − a)/R. The two accelerations differ only by a share 1 − d of themselves, so that their
    roundings are a share of the force 1/(1 − d) times as large, 10⁴ at d = 0.9999: a_ref from two terms, a, and their
    difference. For friction the passes take R, which a small impratio makes large, off A + R, and R f off (A + R) f.
    That leaves the roundings of R f, with R/A = 3·10⁵ times the friction's own.

    pressed: what normal forces change of rates, times d/(1 − d) and A's share, m/s, all added up. gripped: R f dt of
    the frictions that end a slip, m/s. In a second an error of a speed is as large an error of a way, m.
    """
    return Term("rounding in MuJoCo's noslip passes", (IN_A_FORCE * pressed + IN_A_GRIP * gripped) * ULP / 2)


def darts_matrix(turn: float, count: int) -> Term:
    """What is off in a quaternion that DART takes from I + [φ] + [φ]²/2, for so many turns by a small angle φ, rad.

    Across the axis the matrix does not only turn, but stretches by √(1 + φ⁴/4), φ⁴/8 more than one.
    """
    return Term("the matrix by which DART turns", count * turn**4 / 8)


# What a solver leaves

UNCONVERGED = 10.0
"""Sweeps that end when a sweep changes no impulse by more than a share leave ρ/(1 − ρ) of that share, where each sweep
leaves ρ of the error. This is enough up to ρ = 0.9; a row of five equal balls has 0.65 (Gauss–Seidel: cos² π/5)."""


def sweeps(tolerance: float, scenario: Scenario) -> Term:
    """What sweeps leave that end at a tolerance, a share of the largest impulse.

    Through a body of mass m between two of M a sweep leaves 1 − 2 m/M of the error (`reference.scene.pressed`).
    """
    unconverged = max(UNCONVERGED, sweeps_needed(scenario) / (2 * SWEEPS_PER_RATIO))
    return Term("sweeps that end at a tolerance", unconverged * tolerance)


MUJOCO_TOLERANCE = 1e-8
"""`tolerance`, which no profile sets."""


def mujocos_warm_start(bodies: Sequence[Body], timestep: float) -> Term:
    """What MuJoCo's solver leaves in a contact that lasts, m/s.

    It begins with the accelerations of the step before, and does nothing where the gradient of the cost, a force, is
    less than `tolerance` times the trace of the mass matrix. So much force is then missing for a step.
    """
    left = MUJOCO_TOLERANCE * _trace(bodies) / min(body.mass for body in bodies)
    return Term("the tolerance of MuJoCo's solver where a contact lasts", left * timestep)


def _trace(bodies: Sequence[Body]) -> float:
    """Of the mass matrix of free bodies, kg, where kg m² count as kg."""
    return float(sum(3 * body.mass + sum(body.moments_of_inertia()) for body in bodies))


SPRUNG_CONTACT = 3.2e-3
"""How long MuJoCo's contact of a spring lasts at most, s: sixteen steps of 0.2 ms."""


def mujocos_tolerance(bodies: Sequence[Body]) -> Term:
    """What MuJoCo's Newton solver leaves in the contact of a spring, m/s.

    It stops when a step improves the cost by less than `tolerance` times the trace of the mass matrix. A cost is
    m a²/2, so that of the lightest body so much acceleration is off, at most the same way all the time. Against a spin
    the surface of a ball has 2/5 of its mass, I/r².
    """
    lightest = 0.4 * min(body.mass for body in bodies)
    left = (2 * MUJOCO_TOLERANCE * _trace(bodies) / lightest) ** 0.5
    return Term("the tolerance of MuJoCo's solver", left * SPRUNG_CONTACT)


BULLETS_ACCURACY = 1e-12
"""Length at which Bullet's search for the nearest points of two shapes ends, m (`EPA_ACCURACY`)."""


def bullets_search(radius: float) -> Term:
    """The search leaves the nearest point of a box off, and so tilts the normal of a ball by that over its radius.

    It ends when it gains less than its accuracy, and is then off by more than that: up to 1.4 times was measured.
    """
    return Term("Bullet's search for nearest points", 2 * BULLETS_ACCURACY / radius)


FALLBACK, FALLBACK_SWEEPS = 1e-3, 30
"""DART's default solver gives up, in about every other case, where a contact of two at once needs no impulse by itself.
Then DART sweeps, until a sweep changes no impulse by more than this share, or so often."""


def darts_fallback(coupling: float, speed: float) -> Term:
    """What DART's fallback leaves, m/s. A sweep leaves ρ of an error, k₁₂²/(k₁₁ k₂₂) for two contacts: the coupling.

    speed: what the largest impulse changes of the lightest body's, m/s.
    """
    left = FALLBACK * coupling / (1 - coupling) if coupling < 1 else 1.0
    return Term("sweeps where DART's solver gives up", max(left, coupling**FALLBACK_SWEEPS) * speed)


DARTS_FOUR_CORNERS = Term("DART's sweeps over four corners that strike", 1e-4)
"""Three would carry the box, and sweeps over a fourth converge slowly; in rad, m and shares."""
DARTS_TWO_CORNERS = Term("DART's sweeps over two corners that strike", 3e-5)
"""Where both grip: 5000 sweeps leave nearly as much as 200."""
FOLLOWED_IMPACT = Term("the law's own integral", 2e-8)
"""The laws of Poisson and Stronge follow an impact through its changes of slip, each found to half the digits."""
STEERED = Term("rounding that a rule of avoidance magnifies", 1e-9)
"""A rule cuts half-planes of velocities with each other. Where two borders meet at an angle of 10⁻³ rad, that magnifies
the rounding of some thousand steps, 10⁻¹², a thousand times."""


# What an implementation leaves of a scene


def mesh_in_single(shape: Polyhedron) -> Term:
    """MuJoCo and DART keep the vertices of a mesh in single precision, MuJoCo moved and turned to principal axes.

    A face is tilted by what its vertices are off, over the shortest edge. An impact turns with its normal, twice.
    """
    corners = shape.points[np.array(shape.faces)]
    shortest = float(np.min(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=-1)))
    off = IN_SINGLE * float(np.max(np.linalg.norm(shape.points, axis=-1)))
    return Term("vertices in single precision", off + 2 * off / shortest)


def sinking(overlap: float, count: int) -> Term:
    """Friction acts within the overlap, so that the arm of a ball changes while it sinks in.

    overlap: as a share of the radius. count: of steps. DART takes back 1 % of an overlap in a step.
    """
    return Term("the arm of a ball that sinks in", overlap * min(1.0, 100 / count))


LATE_ASLEEP = 0.2
"""Share of an overlap that DART takes back in 20 steps, 1 % in each. A body fell asleep up to 16 steps late."""


def asleep(overlap: float) -> Term:
    """What a step of sleep that comes late leaves of the overlap that DART still takes back, m."""
    return Term("a sleep that begins some steps late", LATE_ASLEEP * overlap)


def first_step(fall: float, timestep: float) -> Term:
    """Where bodies touch with a gap of zero rounding decides whether the first step has a contact: a fall more or less.

    fall: what weight adds to the speed in a step, m/s. In that step there is no friction either.
    """
    return Term("a first step without contact", 2 * abs(fall) * timestep)


def dropped_at_rest(fall: float, timestep: float) -> Term:
    """A body that rests on a tilted plane has a gap of zero, which rounding makes positive in some steps, m.

    Without a reach there is then no contact: the body falls for a step, and Bullet takes the overlap back.
    """
    return Term("a rest without contact for a step", abs(fall) * timestep)


LOST_CORNERS = 4.0
"""How many falls of a step a fast box that loses its corners again and again is off, as measured on random boxes."""
SLOWED = 2.8
"""By how many times the share that is left to the limit of friction one sweep of Bullet's makes the error of four
corners smaller. It was measured on random boxes near their critical slope, as 2.9 and more: 4.0 next to the limit."""


def bullets_corners(friction: float, left: float, count: float, duration: float) -> Term:
    """What sweeps over four corners leave near the critical slope, where they are slow, m.

    Each takes a share SLOWED · left of the error, so that count of them leave exp(−count SLOWED left) of the friction.
    That is missing in the first step; later ones begin with the impulses of the last.

    friction: what it changes of a speed in a step, m/s. left: by which share it is more or less than the pull.
    """
    share = math.exp(-count * SLOWED * left)
    return Term("Bullet's sweeps over four corners", friction * share * duration)


def bullets_limit(friction: float, count: float) -> Term:
    """A push that grows slowly is near the limit of friction for some steps, and the sweeps are slow in all of them.

    The nearer to the limit, the less a sweep takes of an error: where the pull is below it by a share f, a sweep leaves
    1 − s f with s = SLOWED, and n sweeps exp(−s n f). The pull comes nearer by its growth in each step, and what is
    left falls to nothing within as many steps as make f = 1/(s n). Each of them lets a speed of that growth pass.

    friction: the limit, as what it changes of a speed in a step, m/s. count: of the sweeps.
    """
    return Term("Bullet's sweeps near the limit of friction", friction / (SLOWED * count))


def lost_corners(fall: float, timestep: float) -> Term:
    """A step in which Bullet has lost the corners of a fast box lets it fall, with as little friction."""
    return Term("a step in which Bullet loses corners", LOST_CORNERS * abs(fall) * timestep)


def first_sweeps(tolerance: float, fall: float) -> Term:
    """What sweeps leave in the first step of a slide, m/s; later ones begin with impulses that are right already."""
    return Term("sweeps of the first step", UNCONVERGED * tolerance * abs(fall))


def turning_sweeps(tolerance: float, friction: float, turns: int) -> Term:
    """What sweeps over four corners leave in a step in which a box turns back, m/s.

    If the friction that ends the slip is a share f below its limit, a sweep takes s f of the error, with s = SLOWED. So
    sweeps that end at a tolerance leave tolerance/(s f) of the friction, and at most f: √(tolerance/s) at the worst f.

    friction: what it changes of a speed in a step, m/s.
    """
    return Term("sweeps where a box turns back", turns * math.sqrt(tolerance / SLOWED) * friction)


def late(change: float) -> Term:
    """What a step of delay at a break-away changes of a speed, m/s, and in a second of a way, m."""
    return Term("a break-away a step early or late", change)


CREEPING, ROCKING, NEARLY_HELD, SETTING_OUT, ROCKING_DRIVEN, CHATTER = 3.0, 1.0, 2.0, 0.25, 2.0, 0.01
"""A box in MuJoCo stands on four corners and on two in turns, because the main solver does not know of friction. That
follows no rule that we know. In each step friction takes some speed and turns the box by it, in proportion to height
over width; what comes back drives the box on. These are the largest shares of it that random boxes need."""
NEAR_CRITICAL = 0.05
"""Share of its weight along the plane by which friction is weaker, up to which a box is nearly held."""


def creeping(height: float, pull: float, duration: float) -> Term:
    """A box that friction holds creeps, in m. height: in widths. pull: what friction takes in a step, m/s."""
    return Term("a box that MuJoCo lets creep", CREEPING * height * pull * duration)


def rocking(height: float, friction: float, fall: float, duration: float, beyond: float, askew: bool) -> Term:
    """A box that slides rocks, in m. Without friction it chatters.

    One that sets out from rest rocks more where its pull is hardly beyond the limit of friction, and the longer so if
    it lies askew to its way.

    height: in widths. friction, fall: what they change of a speed in a step, m/s. beyond: how much more its pull
    changes, for a box that is at rest at first. askew: whether the way is along none of its axes.
    """
    share = ROCKING * height * min(height, 1.0)
    if beyond < NEAR_CRITICAL * (friction + beyond):
        share = NEARLY_HELD * height
    if askew:
        share += SETTING_OUT * height * friction / max(abs(beyond), ULP)
    speed = share * friction + CHATTER * height * abs(fall)
    return Term("a box that rocks in MuJoCo", speed * duration)


def corner_off(fall: float, timestep: float) -> Term:
    """A corner of such a box that is off the ground for a step falls so far, and the next step takes that back.

    fall: what weight adds to the speed in a step, m/s.
    """
    return Term("a corner that MuJoCo lets off the ground for a step", 2 * abs(fall) * timestep)


def rocking_driven(timestep: float) -> Term:
    """A box under a push that changes passes the limit of friction, and is near it for a while; in m and s."""
    return Term("a driven box that rocks in MuJoCo", ROCKING_DRIVEN * timestep)
