"""Scenes that nobody chose, one strategy for each kind of recurrence: tilted, unequal, turned, spinning, nothing round.

Numbers are drawn on a grid whose points are no round numbers, and become small when an example is shrunk.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
from hypothesis import strategies as st

from reference.scene import geometry
from reference.scene.forces import Attraction, Fluid, Force, GrowingForce, OscillatingForce, Spring
from reference.scene.polyhedron import Polyhedron
from reference.scene.query import Distance, Inside, Ray, Segment
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere
from reference.scene.steering import Steering
from reference.scene.survey import survey

ODD = 0.6180339887
"""Of a step of the grid, by which its points are not round."""
WEIGHTLESS = (0.0, 0.0, 0.0)


def between(low: float, high: float) -> st.SearchStrategy[float]:
    return st.integers(0, 999).map(lambda number: round(low + (high - low) * (number + ODD) / 1000, 9))


def told(vector) -> tuple[float, ...]:
    return tuple(float(each) for each in vector)


@st.composite
def ways(draw) -> np.ndarray:
    """A unit vector."""
    height, angle = draw(between(-1, 1)), draw(between(-math.pi, math.pi))
    level = math.sqrt(1 - height**2)
    return np.array([level * math.cos(angle), level * math.sin(angle), height])


@st.composite
def turns(draw) -> tuple[float, ...]:
    """A unit quaternion."""
    return told(geometry.turned(np.array([1.0, 0.0, 0.0, 0.0]), draw(between(0, math.pi)) * draw(ways())))


@st.composite
def vectors(draw, most: float) -> np.ndarray:
    return draw(between(0, most)) * draw(ways())


def pair_of(draw, one: str, other: str, rubs: bool = True, rebounds: bool = True) -> Pair:
    return Pair(one, other, draw(between(0.2, 1)) if rebounds else 0.0, draw(between(0, 0.9)) if rubs else 0.0)


@st.composite
def places(draw) -> np.ndarray:
    return draw(vectors(1.0))


@st.composite
def falls(draw, normal: np.ndarray) -> np.ndarray:
    """Gravity towards a plane, at up to some 50° from its normal, and not of 9.81 m/s²."""
    aside = draw(vectors(1.0))
    pull = -normal + aside - (aside @ normal) * normal
    return draw(between(3, 12)) * pull / np.linalg.norm(pull)


@st.composite
def tangents(draw, normal: np.ndarray) -> np.ndarray:
    """A unit vector along a plane."""
    first = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    first /= np.linalg.norm(first)
    angle = draw(between(-math.pi, math.pi))
    return math.cos(angle) * first + math.sin(angle) * np.cross(normal, first)


# Contacts


@st.composite
def bounces(draw) -> Scenario:
    """A smooth body above a plane that never rests: a ball, or a box that lies flat and is turned about the normal.

    At rest PyBullet's ball has a gap of zero, and rounding decides in which steps that is a contact.
    """
    normal, foot = draw(ways()), draw(places())
    if draw(st.booleans()):
        shape, height, orientation = Sphere(draw(between(0.02, 0.3))), 0.0, draw(turns())
        height = shape.radius
    else:
        shape = Box(told(draw(between(0.02, 0.3)) for _ in range(3)))
        upright = geometry.upright_on(normal)
        height = shape.half_extents[2]
        orientation = told(geometry.turned(upright, draw(between(-3, 3)) * normal))
    gap, velocity = draw(between(0.004, 0.03)), draw(vectors(1.5)) if draw(st.booleans()) else np.zeros(3)
    body = Body("body", shape, draw(between(0.1, 9)), told(foot + (height + gap) * normal), orientation, told(velocity))
    aside = draw(tangents(normal))
    plane = Body("plane", HalfSpace(told(normal)), position=told(foot + aside))
    gravity = draw(falls(normal)) if velocity.any() else -draw(between(3, 12)) * normal
    pair = Pair("body", "plane", draw(between(0.7, 1)))
    return Scenario("bounce", (plane, body), (pair,), 0.12, told(gravity))


@st.composite
def balls_at(draw, other: Body, surface: np.ndarray, way: np.ndarray, name: str = "ball") -> Body:
    """A spinning ball that is about to strike a body near a point of its surface, from a direction."""
    radius, gap = draw(between(0.03, 0.12)), draw(between(0.003, 0.03))
    velocity = -draw(between(0.5, 3)) * way + draw(vectors(1.5)) + np.array(other.velocity)
    return Body(
        name, Sphere(radius), draw(between(0.1, 9)), told(surface + (radius + gap) * way), draw(turns()),
        told(velocity), told(draw(vectors(25))),
    )  # fmt: skip


@st.composite
def strikes(draw) -> Scenario:
    """A spinning ball that strikes a plane, another ball or a box, with weight and friction in any direction."""
    way, centre, mass = draw(ways()), draw(places()), draw(between(0.1, 9))
    kind = draw(st.sampled_from(("plane", "ball", "box", "middle of a box", "two planes")))
    moves = {"velocity": told(draw(vectors(1.0))), "angular_velocity": told(draw(vectors(9)))}
    surface, others = centre, ()
    gravity = draw(vectors(12)) if draw(st.booleans()) else np.zeros(3)
    if kind == "plane":
        others = (Body("plane", HalfSpace(told(way)), position=told(centre)),)
    elif kind == "two planes":
        lean = draw(between(0.3, 2.6))
        second = math.cos(lean) * way + math.sin(lean) * draw(tangents(way))
        others = (
            Body("plane", HalfSpace(told(way)), position=told(centre)),
            Body("wall", HalfSpace(told(second)), position=told(centre)),
        )
    elif kind == "ball":
        other = Body("other", Sphere(draw(between(0.03, 0.2))), mass, told(centre), draw(turns()), **moves)
        others, surface = (other,), centre + other.shape.radius * way
    else:
        box = Box(told(draw(between(0.03, 0.2)) for _ in range(3)))
        still = draw(st.booleans())
        other = Body("other", box, math.inf, told(centre), draw(turns()))
        if not still:
            other = Body("other", box, mass, told(centre), draw(turns()), moves["velocity"])
        axis = draw(st.integers(0, 2))
        place = np.array(box.half_extents) * [0.0 if kind != "box" else draw(between(-0.8, 0.8)) for _ in range(3)]
        place[axis] = box.half_extents[axis]
        way = geometry.rotate(np.array(other.orientation), np.eye(3)[axis])
        others, surface = (other,), centre + geometry.rotate(np.array(other.orientation), place)
    ball = draw(balls_at(others[0], surface, way))
    if kind == "two planes":
        normals = np.array([others[0].shape.normal, others[1].shape.normal])
        gaps = ball.shape.radius + np.array([draw(between(0.003, 0.03)), draw(between(0.003, 0.03))])
        out = np.linalg.lstsq(normals, gaps, rcond=None)[0]
        ball = replace(
            ball,
            position=told(centre + out),
            velocity=told(-draw(between(0.5, 3)) * out / np.linalg.norm(out) + draw(vectors(1.0))),
        )
    rubs = draw(st.booleans())
    pairs = tuple(pair_of(draw, "ball", other.name, rubs) for other in others)
    return Scenario(kind, (*others, ball), pairs, 0.06, told(gravity))


@st.composite
def slides(draw) -> Scenario:
    """A box that lies on a plane, or a ball, sent up or down a slope of any direction, or let go."""
    normal, foot = draw(ways()), draw(places())
    heading = draw(tangents(normal))
    gravity = draw(between(2, 20)) * (-math.cos(slope := draw(between(0, 0.8))) * normal + math.sin(slope) * heading)
    speed = draw(st.sampled_from((-1.0, 0.0, 1.0))) * draw(between(0.05, 1.0))
    mass = draw(between(0.1, 9))
    if draw(st.booleans()):
        shape, orientation = Sphere(draw(between(0.03, 0.2))), draw(turns())
        height = shape.radius
    else:
        height = draw(between(0.01, 0.05))
        shape = Box((draw(between(0.1, 0.3)), draw(between(0.1, 0.3)), height))
        upright = geometry.upright_on(normal)
        turn = draw(between(-3, 3))
        if draw(st.booleans()):  # along its own axis
            own = geometry.rotate(geometry.opposite(upright), heading)
            turn = math.atan2(own[1], own[0]) + draw(st.integers(0, 3)) * math.pi / 2
        orientation = told(geometry.turned(upright, turn * normal))
    body = Body("body", shape, mass, told(foot + height * normal), orientation, told(speed * heading))
    plane = Body("plane", HalfSpace(told(normal)), position=told(foot))
    pair = Pair("body", "plane", kinetic_friction=draw(between(0.01, 0.9)))
    return Scenario("slide", (plane, body), (pair,), 0.15, told(gravity))


@st.composite
def drives(draw) -> Scenario:
    """A slab on a level plane of any direction, which a growing push or a spring moves along a line."""
    normal, foot = draw(ways()), draw(places())
    heading, mass, weight = draw(tangents(normal)), draw(between(0.2, 5)), draw(between(2, 20))
    height = draw(between(0.01, 0.03))
    shape = Box((draw(between(0.1, 0.3)), draw(between(0.1, 0.3)), height))
    upright = geometry.upright_on(normal)
    own = geometry.rotate(geometry.opposite(upright), heading)
    turn = math.atan2(own[1], own[0]) + draw(st.integers(0, 3)) * math.pi / 2
    place = foot + height * normal
    forces, springs, velocity = (), (), np.zeros(3)
    friction = draw(between(0.1, 0.6))
    if draw(st.booleans()):
        rate = friction * mass * weight / draw(between(0.05, 0.15))
        forces = (GrowingForce("body", told(rate * heading)),)
    else:
        stretch, length = draw(between(0.05, 0.2)), draw(between(0.5, 1))
        stiffness = friction * mass * weight / stretch * draw(between(1.5, 5))
        springs = (Spring("body", "", stiffness, length, point_b=told(place + (length + stretch) * heading)),)
        velocity = draw(between(-0.5, 0.5)) * heading
    body = Body("body", shape, mass, told(place), told(geometry.turned(upright, turn * normal)), told(velocity))
    plane = Body("plane", HalfSpace(told(normal)), position=told(foot))
    pair = Pair("body", "plane", kinetic_friction=friction)
    gravity = told(-weight * normal)
    return Scenario("driven", (plane, body), (pair,), 0.2, gravity, forces=forces, springs=springs)


@st.composite
def corners(draw) -> Scenario:
    """A box without weight that flies at a plane with a corner or an edge ahead, and may spin about its own axis."""
    normal, foot, turn = draw(ways()), draw(places()), draw(turns())
    half = np.array([draw(between(0.05, 0.25)) for _ in range(3)])
    if draw(st.integers(0, 2)) == 0:  # an edge
        axis = draw(st.integers(0, 2))
        own = geometry.rotate(np.array(turn), np.eye(3)[axis])
        level = draw(tangents(normal))
        turn = told(product(geometry.quaternion_between(own, level), turn))
    signs = np.array(np.meshgrid(*[(-1.0, 1.0)] * 3)).reshape(3, -1).T
    lowest = float(np.min(geometry.rotate(np.array(turn), signs * half) @ normal))
    velocity = -draw(between(0.5, 3)) * normal + draw(vectors(1.5))
    velocity -= max(0.0, float(velocity @ normal) + 0.3) * normal
    spin = draw(st.sampled_from((0.0, 1.0))) * draw(between(-6, 6))
    spin = spin * geometry.rotate(np.array(turn), np.eye(3)[draw(st.integers(0, 2))])
    place = foot + (draw(between(0.005, 0.05)) - lowest) * normal
    box = Body("box", Box(told(half)), draw(between(0.1, 9)), told(place), turn, told(velocity), told(spin))
    plane = Body("plane", HalfSpace(told(normal)), position=told(foot))
    pair = pair_of(draw, "box", "plane", rubs=draw(st.booleans()))
    return Scenario("corner", (plane, box), (pair,), 0.08, WEIGHTLESS)


def product(left, right) -> tuple[float, ...]:
    """The turn `right`, then the turn `left`."""
    (a, *first), (e, *second) = left, right
    first, second = np.array(first), np.array(second)
    return told([a * e - first @ second, *(a * second + e * first + np.cross(first, second))])


@st.composite
def crossed_edges(draw) -> Scenario:
    """Two boxes of which an edge of each meets the other, between its ends, and which do not turn before."""
    time = draw(between(0.01, 0.03))
    normal = draw(ways())
    first = draw(tangents(normal))
    second = math.cos(angle := draw(between(0.4, 2.7))) * first + math.sin(angle) * np.cross(normal, first)
    touch = draw(places())
    bodies = []
    for name, way, side in (("a", first, 1.0), ("b", second, -1.0)):
        half = np.array([draw(between(0.05, 0.25)) for _ in range(3)])
        # Own x along the edge; the body lies behind it, between two faces that lean by `lean` and 90° − lean
        lean = draw(between(0.4, 1.1))
        z = side * normal
        y = np.cross(z, way)
        axes = np.column_stack([way, math.cos(lean) * y + math.sin(lean) * z, -math.sin(lean) * y + math.cos(lean) * z])
        from_edge = axes @ np.array([draw(between(-0.7, 0.7)) * half[0], half[1], half[2]])
        velocity = draw(vectors(0.5)) - side * draw(between(0.5, 1.5)) * normal
        centre = touch + from_edge - time * velocity
        bodies.append(
            Body(name, Box(told(half)), draw(between(0.2, 5)), told(centre), quaternion(axes), told(velocity))
        )
    pair = pair_of(draw, "a", "b", rubs=False)
    return Scenario("edges", tuple(bodies), (pair,), time + 0.015, WEIGHTLESS)


def quaternion(axes: np.ndarray) -> tuple[float, ...]:
    """Of a rotation matrix."""
    values, columns = np.linalg.eigh(
        np.array(
            [
                [axes.trace(), axes[2, 1] - axes[1, 2], axes[0, 2] - axes[2, 0], axes[1, 0] - axes[0, 1]],
                [0, 2 * axes[0, 0] - axes.trace(), axes[1, 0] + axes[0, 1], axes[0, 2] + axes[2, 0]],
                [0, 0, 2 * axes[1, 1] - axes.trace(), axes[1, 2] + axes[2, 1]],
                [0, 0, 0, 2 * axes[2, 2] - axes.trace()],
            ]
        ),
        UPLO="U",
    )
    return told(columns[:, np.argmax(values)])


@st.composite
def shots(draw) -> Scenario:
    """A smooth fast ball without weight that flies straight at a fixed turned wall."""
    turn, half = draw(turns()), np.array([draw(between(0.004, 0.02)), 0.5, 0.4])
    way, radius = geometry.rotate(np.array(turn), np.array([1.0, 0.0, 0.0])), draw(between(0.01, 0.03))
    aside = geometry.rotate(np.array(turn), np.array([0.0, draw(between(-0.3, 0.3)), draw(between(-0.2, 0.2))]))
    speed, middle, time = draw(between(2, 60)), draw(places()), draw(between(0.01, 0.04))
    start = middle + aside - (speed * time + radius + half[0]) * way
    wall = Body("wall", Box(told(half)), math.inf, told(middle), turn)
    ball = Body("ball", Sphere(radius), draw(between(0.01, 1)), told(start), draw(turns()), told(speed * way))
    return Scenario("shot", (wall, ball), (pair_of(draw, "ball", "wall", rubs=False),), time + 0.02, WEIGHTLESS)


# Forces


@st.composite
def loaded_balls(draw) -> Scenario:
    """Two or three balls under pushes of each kind, springs, attractions and a fluid, some of which turn them."""
    count, turned = draw(st.integers(1, 3)), draw(st.booleans())
    bodies = []
    for number in range(count):
        spin = told(draw(vectors(4))) if turned else WEIGHTLESS
        place = told(0.6 * number * np.eye(3)[0] + draw(vectors(0.25)))
        bodies.append(
            Body(f"ball {number}", Sphere(draw(between(0.03, 0.1))), draw(between(0.2, 5)), place, draw(turns()),
                 told(draw(vectors(1.0))), spin)
        )  # fmt: skip
    kinds = draw(st.sets(st.sampled_from(("push", "spring", "attraction", "fluid")), min_size=1))
    forces, springs, attractions, fluid = [], [], [], ()
    if "push" in kinds:
        forces = [
            Force("ball 0", told(draw(vectors(5)))),
            GrowingForce("ball 0", told(draw(vectors(20)))),
            OscillatingForce(bodies[-1].name, told(draw(vectors(5))), draw(between(1, 30)), draw(between(0, 6))),
        ]
    if "spring" in kinds:
        for number in range(count):
            other = f"ball {number + 1}" if number + 1 < count else ""
            ends = [draw(vectors(0.03)) if turned else np.zeros(3) for _ in range(2)]
            end = ends[1] if other else np.array(bodies[number].position) + 0.7 * draw(ways())
            springs.append(
                Spring(f"ball {number}", other, draw(between(5, 80)), draw(between(0.1, 0.5)), draw(between(0, 2)),
                       told(ends[0]), told(end))
            )  # fmt: skip
    if "attraction" in kinds and count > 1:
        attractions = [Attraction("ball 0", f"ball {other}", draw(between(0.01, 0.3))) for other in range(1, count)]
    if "fluid" in kinds:
        fluid = Fluid(draw(between(0, 900)), draw(between(0, 2)), told(draw(vectors(1))))
    gravity = told(draw(vectors(12)))
    return Scenario("loaded", tuple(bodies), (), 0.1, gravity, tuple(forces), tuple(springs), tuple(attractions), fluid)


@st.composite
def springs(draw) -> Scenario:
    """One ball on one damped spring along any direction, with weight along it."""
    way, held, length = draw(ways()), draw(places()), draw(between(0.6, 1.2))
    rest = length - draw(between(-0.15, 0.15))
    ball = Body(
        "ball", Sphere(draw(between(0.03, 0.1))), draw(between(0.2, 5)), told(held + length * way), draw(turns()),
        told(draw(between(-0.3, 0.3)) * way),
    )  # fmt: skip
    stiffness = ball.mass * draw(between(30, 300))
    spring = Spring("ball", "", stiffness, rest, draw(between(0, 0.4)) * stiffness**0.5, point_b=told(held))
    gravity = told(draw(between(-3, 3)) * way)
    return Scenario("spring", (ball,), (), 0.15, gravity, springs=(spring,))


@st.composite
def drapes(draw) -> Scenario:
    """A chain of small balls on springs in a fluid that falls onto a fixed ball, with a push."""
    centre, up = draw(places()), draw(ways())
    along = draw(tangents(up))
    ball = Body("under", Sphere(draw(between(0.15, 0.3))), math.inf, told(centre))
    count, apart = draw(st.integers(2, 5)), draw(between(0.06, 0.12))
    masses = [
        Body(
            f"mass {number}", Sphere(draw(between(0.005, 0.02))), draw(between(0.02, 0.2)),
            told(centre + (ball.shape.radius + draw(between(0.02, 0.03))) * up
                 + (number - draw(between(0, 2))) * apart * along + draw(vectors(0.01)) + 0.01 * number * up),
            velocity=told(-draw(between(0, 1)) * up),
        )
        for number in range(count)
    ]  # fmt: skip
    tied = tuple(
        Spring(one.name, other.name, draw(between(20, 200)), apart * draw(between(0.8, 1.1)), draw(between(0, 0.5)))
        for one, other in itertools.pairwise(masses)
    )
    pairs = tuple(Pair("under", mass.name) for mass in masses)
    fluid = Fluid(0.0, draw(between(0, 1)), told(draw(vectors(0.5)))) if draw(st.booleans()) else ()
    forces = (Force("mass 0", told(draw(vectors(0.3)))),) if draw(st.booleans()) else ()
    gravity = told(-draw(between(2, 15)) * up + draw(vectors(1.5)))
    return Scenario("drape", (ball, *masses), pairs, 0.12, gravity, forces, tied, fluid=fluid)


@st.composite
def fliers(draw) -> Scenario:
    """Some bodies of unequal mass that a rule steers, past a pillar or not, and that are too far apart to meet."""
    rule = draw(st.sampled_from(("seek", "flee", "arrive", "steer_around", "repelling_force", "flock_step")))
    count, names = draw(st.integers(1, 3)), []
    bodies = []
    for number in range(count):
        names.append(f"flier {number}")
        place = told(3.0 * number * np.eye(3)[1] + draw(vectors(0.8)))
        bodies.append(Body(names[-1], Sphere(draw(between(0.05, 0.2))), draw(between(0.2, 5)), place,
                           velocity=told(draw(vectors(1.0)))))  # fmt: skip
    pillar = Body("pillar", Sphere(draw(between(0.2, 0.5))), position=told((4.0, draw(between(-1, 4)), 0.2)))
    goals = tuple(told(np.array([8.0, 3.0 * number, 0.0]) + draw(vectors(1.0))) for number in range(count))
    needs = {
        "arrive": (("slowing_radius", draw(between(0.5, 9))),),
        "repelling_force": tuple((name, draw(between(0.5, 5))) for name in ("strength", "reach", "response_time")),
        "flock_step": tuple((name, draw(between(0.2, 2))) for name in (
            "radius", "separation", "alignment", "cohesion", "max_acceleration", "response_time")),
    }  # fmt: skip
    around = rule in ("steer_around", "repelling_force", "flock_step")
    steering = Steering(
        rule, tuple(names), goals, draw(between(0.5, 2)), draw(between(0.03, 0.08)), draw(between(1, 20)),
        ("pillar",) if around else (), draw(between(0, 0.1)), needs.get(rule, ()),
    )  # fmt: skip
    pairs = tuple(Pair("pillar", name) for name in names)
    gravity = told(draw(vectors(2.0))) if draw(st.booleans()) else WEIGHTLESS
    return Scenario("fliers", (pillar, *bodies), pairs, 1.0, gravity, steering=(steering,))


# Surveys


@st.composite
def surveys(draw):
    """A convex solid of seven unequal vertices, turned, and questions about places near it."""
    points = np.array([draw(between(0.4, 1)) * draw(ways()) for _ in range(4)])
    tetrahedron = [np.array(each, dtype=float) for each in ((1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1))]
    vertices = 0.2 * (np.array(tetrahedron) + 0.4 * points) + draw(vectors(0.3))
    faces = ((0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2))
    solid = Body(
        "solid", Polyhedron(told_all(vertices), faces), position=told(draw(vectors(5))), orientation=draw(turns())
    )
    middle = np.array(solid.position) + geometry.rotate(np.array(solid.orientation), vertices.mean(axis=0))
    out, aim = draw(ways()), draw(vectors(0.2))
    start, way = middle + 1.2 * out, -1.5 * out + aim
    ball = Body("ball", Sphere(draw(between(0.02, 0.2))), 1.0, told(middle + draw(between(0.05, 0.8)) * draw(ways())),
                velocity=told(draw(vectors(0.5))))  # fmt: skip
    box = Body("box", Box(told(draw(between(0.05, 0.2)) for _ in range(3))), math.inf,
               told(middle + draw(between(0.7, 1.2)) * draw(ways())), draw(turns()))  # fmt: skip
    questions = (
        ("ray", Ray(solid, told(start), told(way))),
        ("segment", Segment(solid, told(start), told(start + way * draw(between(1.2, 2))))),
        ("inside", Inside(solid, told(middle + draw(vectors(0.3))))),
        ("ball", Distance(solid, ball)),
        ("box", Distance(box, solid)),
    )
    return survey("survey", questions, (Distance(ball, solid),))


def told_all(points) -> tuple[tuple[float, ...], ...]:
    return tuple(told(point) for point in points)
