"""Points, rays, segments, balls and other solids at a convex polyhedron (slide 9)."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.catalogue.scenarios import solids
from reference.catalogue.scenarios.solids import HAIR, TURNED, UPRIGHT, Placed, Touching, corners, edges, faces
from reference.checks import Quaternion, Vector
from reference.engines import facts
from reference.engines.surveying import TIMESTEP
from reference.prediction import answering
from reference.scene.polyhedron import Polyhedron
from reference.scene.query import Distance, Inside, Query, Segment
from reference.scene.survey import Survey, survey
from reference.solid_truth import chord

_FAR, _NEAR = (0, 2, 4), (1, 3, 5)
SOLID = Polyhedron(
    # Multiples of 1/64, which floats of both precisions have: two ends each of three bent axes, and off the origin.
    (
        (0.75, -0.03125, 0.125),
        (-0.15625, -0.078125, 0.28125),
        (0.34375, 0.46875, 0.1875),
        (0.203125, -0.578125, 0.234375),
        (0.34375, -0.21875, 0.890625),
        (0.25, -0.046875, -0.171875),
    ),
    tuple(
        (x, y, z) if (x in _FAR) ^ (y in _FAR) ^ (z in _FAR) else (x, z, y)
        for x in (0, 1)
        for y in (2, 3)
        for z in (4, 5)
    ),
)
"""An octahedron that is regular in nothing, about 1 m in size."""
AROUND = 0.02
"""Distance of points from the faces, as a share of the size."""
GAP, RADIUS = 0.05, 0.1
"""Of a ball from the solid, and its radius, as shares of the size."""
DEPTH, SMALL = 0.1, 0.02
"""Of a small ball's centre below a face, and its radius, as shares of the size."""
UNTURNED, ASIDE = (0.5, -0.25, 1.0), (1.3, -0.7, 0.4)
"""Where the solid is, as it was drawn and turned, m."""
WEIGHTS = np.array([0.5, 0.3, 0.2])
"""Of the corners of a face, at a place on it that is in no middle."""
PASSING = (-0.4, 0.35, 1.0)
"""Where the ball sets out that flies past, in the solid's own axes, as a share of the size."""


Questions = Callable[[Placed, float], Iterator[tuple[str, Query]]]


def _case(family: str, ask: Questions, name: str, size: float, position: Vector, orientation: Quaternion) -> Case:
    solid = solids.placed(solids.scaled(SOLID, size), position, orientation)
    passing = solids.ball(solid, "passing", size * np.array(PASSING), RADIUS * size, size * np.array([1.0, -0.3, -0.1]))
    scenario = survey(f"{family}/{name}", tuple(ask(solid, size)), (Distance(passing, solid.body),))
    return Case(name, (scenario,), {"size": size, "distance": float(np.linalg.norm(position))})


def _cases(family: str, ask: Questions) -> tuple[Case, ...]:
    return (
        _case(family, ask, "unturned", 1.0, UNTURNED, UPRIGHT),
        _case(family, ask, "turned", 1.0, ASIDE, TURNED),
        _case(family, ask, "size=0.05", 0.05, ASIDE, TURNED),
        _case(family, ask, "1 km away", 1.0, (600.0, -800.0, 3.0), TURNED),
    )


def _grid(family: str, ask: Questions) -> Grid:
    sizes = Parameter("size", "m", (0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0), 1.0, in_ratio=True)
    return Grid(
        (sizes,),
        (TIMESTEP / 2, TIMESTEP),
        lambda size: _case(family, ask, f"size={size:g}", size, ASIDE, TURNED),
    )


def _about_the_solid(solid: Placed, size: float) -> Iterator[tuple[str, Query]]:
    """Points, rays and balls well beside or within it."""

    def beside(name: str, place: Array, out: Array) -> tuple[str, Query]:
        ball = solids.ball(solid, f"ball {name}", place + (GAP + RADIUS) * size * out, RADIUS * size)
        return f"gap {name}", Distance(solid.body, ball)

    for number, (triangle, normal) in enumerate(faces(solid.shape)):
        place = WEIGHTS @ triangle
        yield f"inside {number}", Inside(solid.body, solid.at(place - AROUND * size * normal))
        yield f"outside {number}", Inside(solid.body, solid.at(place + AROUND * size * normal))
        slant = size * solids.unit(normal + 0.5 * solids.unit(triangle[1] - triangle[0]))
        yield f"face {number}", solid.ray(place + slant, place - slant)
        yield f"segment {number}", solid.segment(place + slant, place - 2 * slant)
        yield beside(f"f{number}", place, normal)
        small = solids.ball(solid, f"ball below {number}", place - DEPTH * size * normal, SMALL * size)
        yield f"depth {number}", Distance(solid.body, small)
    for number, (start, end, out) in enumerate(edges(solid.shape)):
        yield beside(f"e{number}", 0.6 * start + 0.4 * end, out)
    for number, (vertex, out) in enumerate(corners(solid.shape)):
        yield beside(f"v{number}", vertex, out)
    for name, touching, place, out in _other_solids(solid.shape, size):
        body = solids.before(solid, f"solid {name}", touching, place, out, GAP * size)
        yield f"apart {name}", Distance(solid.body, body)


def _other_solids(shape: Polyhedron, size: float) -> Iterator[tuple[str, Touching, Array, Array]]:
    """A corner before each face, an edge across each edge, and before each vertex a face of another octahedron."""
    for number, (triangle, normal) in enumerate(faces(shape)):
        yield f"f{number}", solids.corner_of_a_box(size), WEIGHTS @ triangle, normal
    for number, (start, end, out) in enumerate(edges(shape)):
        yield f"e{number}", solids.edge_of_a_box(size), 0.6 * start + 0.4 * end, out
    for number, (vertex, out) in enumerate(corners(shape)):
        triangle, normal = list(faces(shape))[number]
        yield f"v{number}", Touching(shape, WEIGHTS @ triangle, normal), vertex, out


def _about_its_edges(solid: Placed, size: float) -> Iterator[tuple[str, Query]]:
    """Rays to edges and vertices and along edges, and points and rays a hair beside the solid."""
    for number, (triangle, normal) in enumerate(faces(solid.shape)):
        yield f"hair {number}", Inside(solid.body, solid.at(WEIGHTS @ triangle + HAIR * normal))
    for number, (start, end, out) in enumerate(edges(solid.shape)):
        place = 0.6 * start + 0.4 * end
        yield f"border e{number}", solid.ray(place + size * out, place - size * out)
        beside, across = place + HAIR * out, size * solids.unit(np.cross(end - start, out))
        yield f"beside {number}", solid.ray(beside - across, beside + across)
        yield f"along {number}", solid.ray(2 * start - end, 2 * end - start)
    for number, (vertex, out) in enumerate(corners(solid.shape)):
        yield f"border v{number}", solid.ray(vertex + size * out, vertex - size * out)


def _mean_chord(case: Case) -> float:
    """Of the segments, from the planes of the solid as it stands in the case."""
    survey_of_case = case.scenarios[0]
    assert isinstance(survey_of_case, Survey)
    solid = Placed(survey_of_case.body("solid"))
    planes = [(np.array(solid.along(normal)), solid.at(triangle[0])) for triangle, normal in faces(solid.shape)]
    normals = np.array([normal for normal, _ in planes])
    offsets = np.array([normal @ np.array(place) for normal, place in planes])
    found = [
        chord(np.array(query.start), np.subtract(query.end, query.start), normals, offsets)
        for _, query in survey_of_case.questions
        if isinstance(query, Segment)
    ]
    return float(np.mean(found))


FACES, EDGES, VERTICES = len(SOLID.faces), len(tuple(edges(SOLID))), len(SOLID.vertices)

CONVEX_SOLID = Family(
    name="convex-solid",
    title="Questions to a convex solid",
    topic="polyhedra",
    statements=(9, 4),
    about="An irregular octahedron of about 1 m is asked about points, rays, segments, balls and other solids, in four"
    " poses: as it was drawn, turned, 20 times smaller, and 1 km from the origin.",
    expected="A point is inside if it is behind all faces. Each ray and each ball is set up from a place on the solid,"
    " so that its length or its gap is known. So is each other solid: a box with a corner before a face, or with an"
    " edge across an edge, and a second octahedron with a face before a vertex. A segment is in the solid from the"
    " last plane of a face that it enters to the first that it leaves.",
    why=(
        f"{facts.PYBULLET_WIDENS_HULLS} As installed it therefore gives every gap that much too small and stops a ray"
        " too early. Its search along a ray ends as soon as it is within 1 mm of that margin, which only shows near"
        " edges. Two hulls have two margins, and are too near to each other by both. A box keeps its size: there the"
        " margin rounds off edges and corners, so that a corner is up to 0.7 mm farther away than it should be. In the"
        " tuned settings rays meet the triangles, which have no margin, and gaps are measured to a hull without a"
        " margin.",
        f"Bullet also puts the vertices of a hull on a grid of {answering.BULLETS_STEPS} steps between the least and"
        " the largest coordinate along each axis, so that the error of a gap is up to `10⁻⁴` of the size of the solid.",
        "MuJoCo and DART keep the vertices of a mesh in single precision, so that lengths are right to `10⁻⁷` of the"
        " solid's size. MuJoCo ends its search for nearest points when it is within 1 µm.",
        f"{facts.DART_SEES_NO_INSIDE} Of two solids that overlap, it says that they are 0 m apart. None of the"
        " hand-written functions tells how deep two solids overlap either, so the lab only asks about solids that are"
        " apart.",
        f"{facts.NO_ENGINE_KNOWS_INSIDE} With stock PyBullet and MuJoCo it asks for the gap of a ball with a radius of"
        " 1 µm.",
    ),
    cases=_cases("convex-solid", _about_the_solid),
    quantities=(
        Quantity("points", "points", "", solids.misjudged, solids.none(2 * FACES), share_of="points misjudged"),
        Quantity("face", "ray", "m", solids.mean_way("face"), solids.length(solids.size_of), solids.size_of),
        Quantity("segment", "segment", "m", solids.mean_of("segment"), solids.length(_mean_chord),
                 solids.size_of),
        Quantity("gap", "gap", "m", solids.mean_of("gap"), solids.length(lambda case: GAP * solids.size_of(case)),
                 solids.size_of, solids.left_by_iteration),
        Quantity("apart", "between solids", "m", solids.mean_of("apart"),
                 solids.length(lambda case: GAP * solids.size_of(case)), solids.size_of, solids.left_by_iteration),
        Quantity("depth", "depth", "m", solids.mean_of("depth"),
                 solids.length(lambda case: -(DEPTH + SMALL) * solids.size_of(case)), solids.size_of,
                 solids.left_by_iteration),
    ),
    curve=Curve("turned", "A ball flies past at 1 m/s", "gap, m", solids.watched),
    convergence=Convergence("turned", "gap", (1.0,)),
    grid=_grid("convex-solid", _about_the_solid),
    predict=answering.predict,
)  # fmt: skip

SOLID_EDGES = Family(
    name="solid-edges",
    title="Rays at the edges of a solid",
    topic="polyhedra",
    statements=(9,),
    about="The same octahedron is asked about points and rays that are"
    f" {1e3 * HAIR:g} mm beside it, and about rays that go to the middle of an edge, to a vertex, or along an edge.",
    expected="Everything beside the solid is outside, however near it is. A ray to an edge or a vertex meets the solid"
    " there: no ray slips through between two faces.",
    why=(
        f"{facts.PYBULLET_WIDENS_HULLS} As installed it therefore reports a hit for points and rays that are half a"
        " millimetre beside the solid. A margin of zero does not help: without a margin many of its rays miss a hull"
        " altogether. Triangles have no margin.",
        "A ray that aims at an edge may slip through in MuJoCo and DART: they test each triangle by itself, and"
        " rounding may put the ray beside both triangles. No ray slipped through in Bullet. The hand-written code"
        " computes all signs exactly, and the border belongs to both triangles.",
        "In exact arithmetic a ray along an edge touches the solid. In floating point the edge itself is rounded, and"
        " so rounding decides. Because of its margin, Bullet reports a hit for all such rays.",
    ),
    cases=_cases("solid-edges", _about_its_edges),
    quantities=(
        Quantity("hair", "points beside", "", solids.share_of("hair"), solids.none(FACES),
                 share_of="points said to be inside"),
        Quantity("beside", "rays beside", "", solids.share_met("beside"), solids.none(EDGES), share_of="rays that hit"),
        Quantity("slipped", "slipped through", "", solids.slipped, solids.none(EDGES + VERTICES, solids.BY_ITSELF),
                 slack=solids.left_to_rounding, share_of="rays to an edge or a vertex"),
        Quantity("along", "along an edge", "", solids.share_met("along"), None, share_of="rays that hit"),
    ),
    curve=Curve("turned", "A ball flies past at 1 m/s", "gap, m", solids.watched),
    convergence=Convergence("turned", "slipped", (1.0,)),
    grid=_grid("solid-edges", _about_its_edges),
    predict=answering.predict,
)  # fmt: skip

FAMILIES = (CONVEX_SOLID, SOLID_EDGES)
