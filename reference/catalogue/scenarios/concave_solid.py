"""Points, rays, segments, balls and solids at a concave polyhedron, and what a convex hull makes of it (slide 9)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.catalogue.scenarios import solids
from reference.catalogue.scenarios.solids import TURNED, UPRIGHT, Placed, faces
from reference.checks import Quaternion, Vector
from reference.engines import facts
from reference.engines.surveying import TIMESTEP
from reference.prediction import answering
from reference.scene import geometry
from reference.scene.polyhedron import Polyhedron
from reference.scene.query import Distance, Inside, Query
from reference.scene.scenario import Body
from reference.scene.survey import survey
from reference.solid_truth import lid

LEFT, INNER_LEFT, INNER_RIGHT, RIGHT = -0.375, -0.1875, 0.375, 0.625
"""Across the channel, m: the outer and the inner side of each wall."""
HIGH, LOW = 0.75, 0.5
"""Heights of the left and the right wall, m."""
FRONT, BACK = -0.3125, 0.4375
"""Ends of the channel, m."""
SIZE = 1.0
"""Of the channel, from side to side, m."""
AROUND = 0.02
"""Distance of points from the faces, m."""
GAP, RADIUS = 0.03, 0.03
"""Of a ball in the pocket from a wall, and its radius, m."""
DEPTH, SMALL = 0.05, 0.02
"""Of a small ball's centre above the underside, and its radius, m."""
SMALL_BOX = 0.1
"""Size of a box in the pocket, m; it fits where the pocket is shallow."""
CLEARANCE = 0.06
"""Between the end of a hooked-in wall and the floor, m."""
HEIGHTS = (0.25, 0.5, 0.75)
"""Of points and segments in the pocket, as shares of its depth."""
SLANT, ACROSS = np.array([0.1, -0.15, 1.0]), np.array([1.0, -0.1, 0.0])
"""From a place on the floor up, and from one in the pocket to the right: half of a ray and of a segment, m."""
_QUADS = ((0, 5, 6, 7), (0, 1, 4, 5), (1, 2, 3, 4))
"""The left wall, the floor and the right wall, as corners of the profile, anticlockwise as seen from the front."""
_CORNERS = 8


def channel(depth: float) -> Polyhedron:
    """A channel with walls of unequal height and width, whose floor is so far below the lower rim, m.

    Its convex pieces are the two walls and the floor between them, cut along slanting planes through its edges.
    """
    floor = LOW - depth
    profile = (
        (LEFT, 0.0), (RIGHT, 0.0), (RIGHT, LOW), (INNER_RIGHT, LOW),
        (INNER_RIGHT, floor), (INNER_LEFT, floor), (INNER_LEFT, HIGH), (LEFT, HIGH),
    )  # fmt: skip
    vertices = tuple((x, y, z) for y in (FRONT, BACK) for x, z in profile)
    front = [triangle for a, b, c, d in _QUADS for triangle in ((a, b, c), (a, c, d))]
    back = [(a + _CORNERS, c + _CORNERS, b + _CORNERS) for a, b, c in front]
    sides = [
        triangle
        for a, b in ((corner, (corner + 1) % _CORNERS) for corner in range(_CORNERS))
        for triangle in ((a, a + _CORNERS, b + _CORNERS), (a, b + _CORNERS, b))
    ]
    pieces = tuple((*quad, *(corner + _CORNERS for corner in quad)) for quad in _QUADS)
    return Polyhedron(vertices, (*front, *back, *sides), pieces)


def _case(name: str, depth: float, position: Vector, orientation: Quaternion) -> Case:
    solid = solids.placed(channel(depth), position, orientation)
    start, way = np.array([0.1, FRONT - 0.4, LOW - depth / 2]), np.array([0.0, BACK - FRONT + 0.8, 0.0])
    passing = solids.ball(solid, "passing", start, RADIUS, way)
    questions = tuple(_questions(solid, depth))
    scenario = survey(f"concave-solid/{name}", questions, (Distance(passing, solid.body),))
    return Case(name, (scenario,), {"depth": depth, "size": SIZE})


def _questions(solid: Placed, depth: float) -> Iterator[tuple[str, Query]]:
    floor, middle = LOW - depth, (FRONT + BACK) / 2
    for number, (triangle, normal) in enumerate(faces(solid.shape)):
        place = np.array([0.5, 0.3, 0.2]) @ triangle
        yield f"inside {number}", Inside(solid.body, solid.at(place - AROUND * normal))
        if not under_the_lid(place + AROUND * normal):
            yield f"outside {number}", Inside(solid.body, solid.at(place + AROUND * normal))
    for number, (share, x) in enumerate((share, x) for share in HEIGHTS for x in (-0.1, 0.1, 0.3)):
        yield f"pocket {number}", Inside(solid.body, solid.at(np.array([x, middle + 0.1 * x, floor + share * depth])))
        target = np.array([x, middle - 0.1 * x, floor])
        yield f"floor {number}", solid.ray(target + SLANT, target - SLANT)
    for number, share in enumerate(HEIGHTS):
        place = np.array([0.0, 0.05, floor + share * depth])
        yield f"segment {number}", solid.segment(place - ACROSS, place + ACROSS)
    for number, x in enumerate((INNER_LEFT + GAP + RADIUS, INNER_RIGHT - GAP - RADIUS)):
        beside = solids.ball(solid, f"ball at wall {number}", np.array([x, middle, LOW - depth / 4]), RADIUS)
        yield f"gap {number}", Distance(solid.body, beside)
    for number, (x, out) in enumerate(((INNER_LEFT, 1.0), (INNER_RIGHT, -1.0))):
        wall, box = np.array([x, middle, LOW - depth / 4]), solids.corner_of_a_box(SMALL_BOX)
        beside = solids.before(solid, f"box at wall {number}", box, wall, np.array([out, 0.0, 0.0]), GAP)
        yield f"apart {number}", Distance(solid.body, beside)
    yield "apart hook", Distance(solid.body, _hooked_in(solid, depth))
    low = solids.ball(solid, "ball in the floor", np.array([0.15, 0.1, DEPTH]), SMALL)
    yield "depth 0", Distance(solid.body, low)


def _hooked_in(solid: Placed, depth: float) -> Body:
    """A second channel, upside down, whose higher wall hangs beside the first one's in each other's pocket."""
    over = np.array([2 * INNER_LEFT + GAP, 0.0, HIGH + LOW - depth + CLEARANCE])
    half_a_turn = np.pi * np.array(solid.along(np.array([0.0, 1.0, 0.0])))
    orientation = geometry.turned(np.array(solid.body.orientation), half_a_turn)
    return Body("hook", channel(depth), position=solid.at(over), orientation=tuple(orientation.tolist()))


def under_the_lid(place: np.ndarray) -> bool:
    """Whether a place between the walls, in the solid's own axes, is below the line from rim to rim."""
    x, y, z = place
    between = INNER_LEFT < x < RIGHT and FRONT < y < BACK
    return bool(between and 0 < z < lid((INNER_LEFT, HIGH), (RIGHT, LOW), x))


def _within(case: Case) -> float:
    """Both walls, along the slanting way."""
    return (INNER_LEFT - LEFT + RIGHT - INNER_RIGHT) * float(np.linalg.norm(ACROSS)) / float(ACROSS[0])


ASIDE = (1.3, -0.7, 0.4)
DEEP, FLAT = 0.375, 0.125
CASES = (
    _case("upright", DEEP, (0.0, 0.0, 0.0), UPRIGHT),
    _case(f"depth={DEEP:g}", DEEP, ASIDE, TURNED),
    _case(f"depth={FLAT:g}", FLAT, ASIDE, TURNED),
)
POINTS = 49
"""So many points are on either side of a face, and not under the lid."""

CONCAVE_SOLID = Family(
    name="concave-solid",
    title="Questions to a concave solid",
    topic="polyhedra",
    statements=(9,),
    about="A channel 1 m wide, with walls of unequal height, is asked about points, rays, segments, balls and small"
    " boxes in its pocket, in its walls and around it, and about a second channel that is hooked into it.",
    expected="A point in the pocket is outside. A ray from above goes down to the floor. A segment across the channel"
    " lies in the solid only where it passes through the two walls. A ball or a box in the pocket has a gap to the"
    " nearest wall. Of two channels that are hooked into each other, a wall of each hangs in the pocket of the other.",
    why=(
        "A convex hull that contains two points also contains all points between them. The hull of the channel"
        " therefore has an invisible lid from rim to rim, and the pocket below the lid is solid."
        f" {facts.PYBULLET_MAKES_HULLS} {facts.MUJOCO_TAKES_HULLS} Both then answer that a point in the pocket is"
        " inside, and that a ball, a box or another channel in the pocket overlaps the channel.",
        "In the same model MuJoCo's rays see the triangles, and go down to the floor. A ray and a contact therefore"
        " disagree on where the solid is.",
        "The remedy is to describe the solid as convex pieces, here two walls and a floor. Tuned PyBullet and MuJoCo"
        f" find gaps from these pieces. {facts.NO_ENGINE_KNOWS_INSIDE}",
        "DART uses the triangles for everything, so it is right about the pocket and about every gap outside."
        f" {facts.DART_SEES_NO_INSIDE}",
    ),
    cases=CASES,
    quantities=(
        Quantity("points", "points", "", solids.misjudged, solids.none(POINTS), share_of="points misjudged"),
        Quantity("pocket", "pocket", "", solids.share_of("pocket"), solids.none(9),
                 share_of="points said to be inside"),
        Quantity("floor", "ray", "m", solids.mean_way("floor"),
                 solids.length(lambda case: float(np.linalg.norm(SLANT))), solids.size_of),
        Quantity("segment", "segment", "m", solids.mean_of("segment"), solids.length(_within), solids.size_of),
        Quantity("gap", "gap", "m", solids.mean_of("gap"), solids.length(lambda case: GAP),
                 solids.size_of, solids.left_by_iteration),
        Quantity("apart", "between solids", "m", solids.mean_of("apart"), solids.length(lambda case: GAP),
                 solids.size_of, solids.left_by_iteration),
        Quantity("depth", "depth", "m", solids.mean_of("depth"), solids.length(lambda case: -(DEPTH + SMALL)),
                 solids.size_of, solids.left_by_iteration),
    ),
    curve=Curve(f"depth={DEEP:g}", "A ball flies through the pocket", "gap, m", solids.watched),
    convergence=Convergence(f"depth={DEEP:g}", "gap", (1.0,)),
    grid=Grid(
        (Parameter("depth", "m", (0.1, 0.125, 0.2, 0.25, 0.3, 0.375), DEEP),),
        (TIMESTEP / 2, TIMESTEP),
        lambda depth: _case(f"depth={depth:g}", depth, ASIDE, TURNED),
    ),
    predict=answering.predict,
)  # fmt: skip

FAMILIES = (CONCAVE_SOLID,)
