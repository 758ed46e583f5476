"""Bodies that slide in a straight line on one plane, roll or hold.

Along the normal a body does what its method's law of contacts says. Along the plane friction may be as large as μ times
the normal impulse of the same step.
"""

from __future__ import annotations

import math

import numpy as np

from reference.arrays import Array
from reference.engines.base import (
    BULLET,
    CIRCLE,
    DART,
    MUJOCO_ONE_STEP,
    RESPOND_THEN_STEP,
    SQUARE,
    WORLD,
    Method,
)
from reference.engines.dart_settings import SOFTNESS
from reference.prediction import bands, friction
from reference.prediction.axes import bullets_axes
from reference.prediction.both import FLAT, MIDWAY, points_of
from reference.prediction.bouncing import BULLETS_REACH, CORNERS, by_steps
from reference.prediction.drives import Drive, drive_of
from reference.prediction.forces import pushed
from reference.prediction.impulses import LEAST_FRICTION, noslip_gives_up
from reference.prediction.laws import law_of
from reference.prediction.predicted import Path, Prediction, trajectory_of
from reference.scene import geometry
from reference.scene.scenario import Body, Box, Pair, Scenario, Sphere
from reference.scene.settings import Settings

STRAIGHT = 1e-9
"""Sine of the angle between two directions that count as one."""
WEAK_IN_DART = 0.01
"""A coefficient of friction that is less, but not zero."""
WEAK_FRICTION = 1e-6
"""MuJoCo's main solver makes no friction with an impratio up to this."""


def predict(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    """The way of one body along one plane; None where it turns aside or may tip, or no recurrence is known."""
    body = next(body for body in scenario.bodies if not body.immovable)
    plane = next(body for body in scenario.bodies if body.immovable)
    normal = np.array(plane.shape.normal)  # type: ignore[union-attr]
    gravity, pair, dt = _acceleration(scenario, body), scenario.pairs[0], settings.timestep
    drive = drive_of(scenario, body, normal, dt) if scenario.pushes_change else None
    if scenario.pushes_change and drive is None:
        return None
    ahead = drive.ahead if drive else _direction(body, gravity, normal)
    if ahead is None or not _is_known(body, settings, method) or _may_tip(scenario, body, normal, ahead):
        return None
    axes = _axes_of_friction(method, normal, ahead)
    if not axes or (drive and len(axes) > 1):
        return None
    fall = float(gravity @ normal) * dt
    speed, pull = float(np.array(body.velocity) @ ahead), float(gravity @ ahead) * dt
    steps, least = settings.steps_for(scenario.duration), LEAST_FRICTION if method.rule == MUJOCO_ONE_STEP else 0.0
    kinetic = max(pair.kinetic_friction, least)
    static = float(pair.static_friction)  # type: ignore[arg-type]
    holds = speed == 0 and pull <= -static * fall and drive is None
    if _too_weak(body, normal, ahead, kinetic, method):
        return None
    if method.rule == BULLET and not holds and not all(_on_bullets_axes(body, normal, axis) for axis in axes):
        return None
    courses: list[tuple[Array, Array]]  # speed of the body and slip, along each axis
    arms = np.ones(steps + 1)  # of friction on a ball, m
    if method.rule == RESPOND_THEN_STEP:
        limits_by_hand = -static * fall, -kinetic * fall
        speeds = (
            friction.step_by_step_by_hand(drive.pull, *limits_by_hand, steps, dt, speed)
            if drive
            else friction.by_hand(speed, pull, *limits_by_hand, steps)
        )
        courses, gaps, rates = [(speeds, speeds)], np.zeros(steps + 1), np.zeros(steps + 1)
    else:
        law = law_of(settings, method, pair.restitution, CORNERS if isinstance(body.shape, Box) else 1.0)
        if law is None:
            return None
        gaps, rates, _ = by_steps(_overlap(settings, method), 0.0, fall, law, steps)
        limits = kinetic * np.maximum(np.diff(rates) - fall, 0.0)  # the normal impulse is all of the rate but the fall
        more = static / kinetic if method.rule == WORLD and kinetic > 0 else 1.0  # the engines have one coefficient
        if isinstance(body.shape, Sphere):
            # DART's ground is a margin higher; MuJoCo's contact begins a margin ahead.
            ahead_by = (
                settings.number("margin") if method.rule == MUJOCO_ONE_STEP and "margin" in settings.options else 0.0
            )
            arms = body.shape.radius + _share_of_overlap(settings, method) * (gaps + ahead_by)
        turning = _turning(body, normal, ahead, method, holds, float(arms[-1]))
        shares = [float(axis @ ahead) for axis in axes]
        if drive:
            courses = [friction.step_by_step(drive.pull, limits, dt, speed, *turning, static=more)]
        elif np.ptp(arms) > 0:
            gyration = body.moments_of_inertia()[0] / body.mass
            courses = [
                friction.by_arms(speed * share, pull * share, limits, arms, gyration, turning[1], more)
                for share in shares
            ]
        else:
            courses = [
                friction.by_limits(speed * share, pull * share, limits, *turning, static=more) for share in shares
            ]
    position = np.array(body.position) + (gaps - gaps[0])[:, None] * normal
    velocity, spin = rates[:, None] * normal, np.zeros((steps + 1, 3))
    for axis, (speeds, slips) in zip(axes, courses, strict=True):
        position = position + dt * np.concatenate([[0.0], np.cumsum(speeds[1:])])[:, None] * axis
        velocity = velocity + speeds[:, None] * axis
        if isinstance(body.shape, Sphere):
            spin += ((speeds - slips) / arms)[:, None] * np.cross(normal, axis)
    trajectory = trajectory_of(scenario, settings, {body.name: Path(position, velocity, spin)})
    fastest = float(np.max(np.linalg.norm(velocity, axis=1)))
    terms = _terms(scenario, body, settings, method, fastest=fastest, deepest=-float(np.min(gaps)), fall=fall)
    friction_in_a_step = kinetic * abs(fall)
    if method.rule == MUJOCO_ONE_STEP and isinstance(body.shape, Box):
        height = _height_over_width(body, normal, ahead)
        terms.append(bands.corner_off(fall, dt))
        if turned := _turned_back(courses):
            terms.append(bands.Term("friction that finds another slip where a box turns back", turned * turning[1]))
        if drive:
            terms.append(bands.rocking_driven(dt))
        else:
            if not holds:
                askew = float(np.max(np.abs(_in_own_axes(body, ahead)))) < 1 - STRAIGHT
                beyond = abs(pull) - friction_in_a_step if speed == 0 else math.inf
                terms.append(bands.rocking(height, friction_in_a_step, fall, scenario.duration, beyond, askew))
            if max(abs(speeds[-1]) for speeds, _ in courses) < friction_in_a_step:  # it holds, or has come to rest
                terms.append(bands.creeping(height, abs(pull), scenario.duration))
    if method.rule == BULLET and isinstance(body.shape, Box) and friction_in_a_step and not drive:
        left, count = abs(abs(pull) / friction_in_a_step - 1), settings.number("solver_iterations")
        terms.append(bands.bullets_corners(friction_in_a_step, left, count, scenario.duration))
    if method.rule == WORLD and isinstance(body.shape, Box):
        terms.append(bands.turning_sweeps(settings.number("tolerance"), friction_in_a_step, _turns(courses)))
    if drive and method.rule != RESPOND_THEN_STEP:
        terms.append(bands.late(_late(drive, pair, fall)))
        if method.rule == BULLET:
            terms.append(bands.bullets_limit(friction_in_a_step, settings.number("solver_iterations")))
    return Prediction(trajectory, tuple(terms))


def _turned_back(courses: list[tuple[Array, Array]]) -> float:
    """What steps change of the speed where a body turns back, m/s, added up.

    Friction turns a box about its centre, and in the next step normal forces turn it back: a share of what friction
    took from the slip is there again. Before and after a turn these are of opposite sign, and how the box rocks in
    between decides what is left: up to this share of a step's change of speed.
    """
    return _turns(courses) * max(float(np.max(np.abs(np.diff(speeds)))) for speeds, _ in courses)


def _turns(courses: list[tuple[Array, Array]]) -> int:
    moves = [speeds[np.abs(speeds) > STRAIGHT] for speeds, _ in courses]
    return sum(int(np.count_nonzero(speeds[:-1] * speeds[1:] < 0)) for speeds in moves)


def _late(drive: Drive, pair: Pair, fall: float) -> float:
    """What a step of delay at break-away makes of the speed, m/s, and in a second of the way, m.

    Near the limit of friction sweeps over four corners converge slowly. A corner that lets go a step early or late
    leaves the body with what the pull grows in a step, and with the difference of static and kinetic friction.
    """
    pulls = np.array([drive.pull(number, 0.0) for number in (0, 1)])
    return abs(float(np.diff(pulls)[0])) + (float(pair.static_friction) - pair.kinetic_friction) * abs(fall)  # type: ignore[arg-type]


def _acceleration(scenario: Scenario, body: Body) -> Array:
    """What weight and the forces on a body make of its velocity without a contact, (3,), m/s²."""
    forces = [pushed(each, 0.0) for each in scenario.forces if each.body == body.name]
    return np.asarray(np.array(scenario.gravity) + sum(forces, np.zeros(3)) / body.mass)


def _direction(body: Body, gravity: Array, normal: Array) -> Array | None:
    """Where the body goes, a unit vector (3,); None if its weight pulls it aside, if it spins, or leaves the plane."""
    velocity, pull = np.array(body.velocity), gravity - (gravity @ normal) * normal
    if any(body.angular_velocity) or abs(float(velocity @ normal)) > STRAIGHT:
        return None
    sizes = [(float(np.linalg.norm(vector)), vector) for vector in (velocity, pull)]
    ways = [vector / size for size, vector in sizes if size > STRAIGHT]
    if not ways:
        return np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])  # it rests, and any direction will do
    return ways[0] if float(np.linalg.norm(np.cross(ways[0], ways[-1]))) < STRAIGHT else None


def _is_known(body: Body, settings: Settings, method: Method) -> bool:
    """Whether the engine's friction follows a rule, with all corners of a box in every step."""
    options = settings.options
    if method.rule == MUJOCO_ONE_STEP:
        separate = settings.number("noslip_iterations") > 0 and settings.number("impratio") <= WEAK_FRICTION
        return separate and method.cone == CIRCLE
    corners = isinstance(body.shape, Sphere) or options.get("ground") == "box"
    if method.rule == BULLET:
        return corners and options["coordinates"] == "multibody"
    return corners or method.rule != DART


def _too_weak(body: Body, normal: Array, ahead: Array, friction: float, method: Method) -> bool:
    """Whether a solver has no rule for so little friction.

    MuJoCo's noslip passes give up; and with μ = 0.0024 one step in four hundred of DART's turned friction aside.
    """
    if method.rule == DART:
        return 0 < friction < WEAK_IN_DART
    if method.rule != MUJOCO_ONE_STEP or friction == LEAST_FRICTION:
        return False
    moments = np.array(body.moments_of_inertia())
    if isinstance(body.shape, Sphere):
        k = 1 / body.mass + body.shape.radius**2 / float(moments[0])
        return noslip_gives_up(k, k, friction)
    arm = np.array(body.shape.half_extents)  # type: ignore[union-attr]
    ways = [_in_own_axes(body, way) for way in (ahead, np.cross(normal, ahead))]
    turns = [np.cross(arm, way) for way in ways]
    (a, c), (_, b) = np.eye(2) / body.mass + [[float(one / moments @ other) for other in turns] for one in turns]
    return noslip_gives_up(a, b - c**2 / a, friction)


def _axes_of_friction(method: Method, normal: Array, ahead: Array) -> list[Array]:
    """The directions that friction is limited along, each by itself; none if they are not known.

    A circle has the direction of the slip alone. A square has two, those of the ground, of which a slip along one
    needs no other.
    """
    if method.cone == CIRCLE:
        return [ahead]
    axes = list(np.eye(3)[:2])
    if abs(float(normal[2])) < 1 - STRAIGHT or method.cone != SQUARE:
        return []
    return [ahead] if max(abs(float(axis @ ahead)) for axis in axes) > 1 - STRAIGHT else axes


def _on_bullets_axes(body: Body, normal: Array, ahead: Array) -> bool:
    """Whether Bullet's friction points against the slip.

    Bullet has two directions of friction, those of btPlaneSpace1, each with its own effective mass, and limits the
    length of both impulses together. They point against a slip along one of them, or where the masses are alike: for a
    ball, and at all corners of a square that lies along both.
    """
    if isinstance(body.shape, Sphere):
        return True
    first, second, _ = bullets_axes(normal)
    if min(abs(float(ahead @ first)), abs(float(ahead @ second))) < STRAIGHT:
        return True
    own = [np.abs(_in_own_axes(body, direction)) for direction in (first, second)]
    sides = [float(along @ np.array(body.shape.half_extents)) for along in own]  # type: ignore[union-attr]
    return bool(np.min(np.max(own, axis=1)) > 1 - STRAIGHT and abs(sides[0] - sides[1]) < STRAIGHT)


def _may_tip(scenario: Scenario, body: Body, normal: Array, ahead: Array) -> bool:
    """Whether the moment of friction moves the normal force out of the face that a box stands on."""
    if not isinstance(body.shape, Box):
        return False
    gravity, extents = _acceleration(scenario, body), np.array(body.shape.half_extents)
    share = scenario.pairs[0].kinetic_friction
    if not any(body.velocity) and not scenario.pushes_change:
        share = min(share, abs(float(gravity @ ahead) / float(gravity @ normal)))
    moved = share * _height(body, normal) * _in_own_axes(body, ahead)
    return bool(np.any(np.abs(moved) > extents))


def _overlap(settings: Settings, method: Method) -> float:
    """The gap at the start as the engine has it, m: some start deeper by a margin; Bullet allows for that much."""
    margin = settings.number("margin") if "margin" in settings.options else 0.0
    return 0.0 if method.rule == BULLET else -margin


def _share_of_overlap(settings: Settings, method: Method) -> float:
    """How far into a ball, as a share of the overlap, its friction acts."""
    return {FLAT: 1.0, MIDWAY: 0.5}.get(points_of(settings, method), 0.0)


def _turning(body: Body, normal: Array, ahead: Array, method: Method, holds: bool, arm: float) -> tuple[float, float]:
    """Ease and softness of a body's friction, as `friction.by_limits` has them.

    An impulse on a ball changes the slip 1 + m r²/I times as much as the speed; r is its arm.

    MuJoCo's noslip passes end the slip of a box's lower face with the normal forces as they were without friction, so
    that friction turns the box about its centre: an impulse changes the slip by 1 + m h²/I times as much as the speed.
    In the next step normal forces end the turn. Of the slip, m h²/I times what friction took is there again. A box that
    is let go and holds rocks between two corners and four, which follows no such rule.
    """
    softness = SOFTNESS if method.rule == DART else 0.0
    if isinstance(body.shape, Sphere):
        return 1 + body.mass * arm**2 / body.moments_of_inertia()[0], softness
    if method.rule == MUJOCO_ONE_STEP and not holds:
        across = _in_own_axes(body, np.cross(normal, ahead))
        softness = body.mass * _height(body, normal) ** 2 / float(across**2 @ np.array(body.moments_of_inertia()))
    return 1.0, softness


def _terms(
    scenario: Scenario, body: Body, settings: Settings, method: Method, *, fastest: float, deepest: float, fall: float
) -> list[bands.Term]:
    """What keeps an engine from the recurrence, besides the rounding of its steps; lengths in m and times in s.

    fastest: speed along the plane, m/s. deepest: overlap, m.
    """
    found, options, a_box = [bands.contact(settings.timestep)], settings.options, isinstance(body.shape, Box)
    if method.rule in (MUJOCO_ONE_STEP, DART):
        if isinstance(body.shape, Sphere) and method.rule == MUJOCO_ONE_STEP:
            found.append(bands.sinking(deepest / body.shape.radius, settings.steps_for(scenario.duration)))
        if "margin" not in options:
            found.append(bands.first_step(fall, settings.timestep))
        if "solver_tolerance" in options:
            found.append(bands.sweeps(settings.number("solver_tolerance"), scenario))
    if method.rule == WORLD and a_box:
        found.append(bands.first_sweeps(settings.number("tolerance"), fall))
    if method.rule == BULLET and isinstance(body.shape, Box):
        lost = loses_corners(body, fastest, settings.timestep)
        found += [bands.lost_corners(fall, settings.timestep)] * lost
    return found


def loses_corners(box: Body, speed: float, timestep: float) -> bool:
    """Whether a step moves a box so far that Bullet loses its corners: by 2 % of half the diagonal."""
    return speed * timestep > BULLETS_REACH * float(np.linalg.norm(box.shape.half_extents))  # type: ignore[union-attr]


def _height(body: Body, normal: Array) -> float:
    """Height of a box's centre above the plane that it stands on, m."""
    return float(np.abs(_in_own_axes(body, normal)) @ np.array(body.shape.half_extents))  # type: ignore[union-attr]


def _height_over_width(body: Body, normal: Array, ahead: Array) -> float:
    """Height of a box over its length along the way that it slides; 1 for a ball."""
    if not isinstance(body.shape, Box):
        return 1.0
    extents = np.array(body.shape.half_extents)
    return float(np.abs(_in_own_axes(body, normal)) @ extents / (np.abs(_in_own_axes(body, ahead)) @ extents))


def _in_own_axes(body: Body, direction: Array) -> Array:
    return geometry.rotate(geometry.opposite(np.array(body.orientation)), direction)
