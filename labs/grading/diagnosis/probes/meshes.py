"""Probes of the functions about spring meshes: forces, steps, bracing, limits of the step, contact and strain."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from labs.grading.diagnosis.probes.probe import Arguments, Draw, Probe, edge, made, refused, usual
from reference.arrays import Array

REST = [0.0, 0.0, 0.0]
DOWN = [0.0, 0.0, -9.81]
INFINITY = float("inf")
TURN = np.array([[2.0, 3, 6], [3, -6, 2], [6, 2, -3]]) / 7
"""A rotation with a mirror: its columns are unit vectors at right angles to each other, and along no axis."""


def probes(function: str) -> tuple[Probe, ...]:
    """The probes of one of this topic's functions."""
    return tuple(_TABLE[function]())


def net(edges: Any, rest: Any, stiffness: Any, damping: Any, mass: Any, pins: Any = ()) -> Arguments:
    """A mesh as a tuple of its six arrays; one number stands for all springs."""
    ends = np.array(edges, dtype=np.int64).reshape(-1, 2)
    springs = [
        np.array(np.broadcast_to(np.asarray(each, dtype=float), len(ends))) for each in (rest, stiffness, damping)
    ]
    return ends, *springs, np.array(mass, dtype=float), np.isin(np.arange(len(mass)), pins)


SPRING = [[0, 1]]
CHAIN = [[0, 1], [1, 2]]
STAR = [[1, 0], [0, 2], [3, 0]]
"""Three springs at node 0; not all of them begin there."""
LOOP = [[0, 1], [1, 2], [3, 1], [0, 3], [2, 3]]
"""Five springs between four nodes."""
TWO = [[1, 0, 0], [3, 0, 0]]
SLANTED = [[1, -2, 3], [3, 4, 6]]
"""7 m apart."""
FOUR = [[1, -2, 3], [2, 0, 5], [4, 1, 2], [-1, 2, 4]]
STILL = [REST, REST]


def drawn_mesh(draw: Draw, pins: Any = (), undamped: bool = False) -> Arguments:
    """A mesh of four nodes and five springs, all unequal."""
    damping = [0.0 if undamped else draw.number(0.1, 3) for _ in LOOP]
    stiffness, rest = [draw.number(1, 20) for _ in LOOP], [draw.number(0.5, 4) for _ in LOOP]
    return net(LOOP, rest, stiffness, damping, [draw.number(0.2, 3) for _ in FOUR], pins)


def drawn_places(draw: Draw, size: float = 3.0) -> Array:
    """Places or velocities of its nodes."""
    return np.array([draw.vector(size) for _ in FOUR])


def _forces() -> list[Probe]:
    moving = [[1, 2, 0], [-1, 0, 1], [0, 3, 0], [2, 1, 1]]
    by_hand = [
        usual("one stretched spring at rest", net(SPRING, 1, 10, 2, [1, 1]), TWO, STILL),
        usual("one shortened spring at rest", net(SPRING, 4, 10, 2, [1, 1]), TWO, STILL),
        usual("a slanted spring, stretched", net(SPRING, 5, 7, 2, [1, 3]), SLANTED, STILL),
        usual("a damper alone, its ends part", net(SPRING, 7, 0, 2, [1, 3]), SLANTED, [[0, 0, 0], [2, 1, 1]]),
        usual("a damper alone, its first end moves", net(SPRING, 7, 0, 2, [1, 3]), SLANTED, [[1, 2, -1], REST]),
        usual("a damper alone, its end moves across", net(SPRING, 2, 0, 5, [1, 1]), TWO, [[0, 1, 2], REST]),
        usual("both ends fly alike", net(SPRING, 2, 10, 5, [1, 1]), TWO, [[3, 1, 2], [3, 1, 2]]),
        usual("at its rest length, and shortening", net(SPRING, 2, 10, 5, [1, 1]), TWO, [[1, 0, 0], [-1, 0, 0]]),
        usual("three springs at one node", net(STAR, 1, [5, 8, 2], 0, [1, 2, 3, 4]), FOUR, [REST] * 4),
        usual("three springs and dampers at one node", net(STAR, 1, [5, 8, 2], [1, 2, 3], [1, 2, 3, 4]), FOUR, moving),
        usual("a chain of two springs", net(CHAIN, [1, 2], [5, 3], 0, [1, 2, 3]), [REST, [2, 0, 0], [3, 0, 0]],
              [REST] * 3),
        usual("one node is pinned", net(LOOP, 2, 4, 1, [1, 2, 3, 4], [1]), FOUR, moving),
        edge("all springs are at rest and nothing moves", net(SPRING, 7, 7, 2, [1, 3]), SLANTED, STILL),
        edge("both ends at one place", net(SPRING, 1, 10, 2, [1, 1]), [[1, 2, 3]] * 2, [[1, 0, 0], REST]),
        edge("both ends almost at one place", net(SPRING, 1, 10, 2, [1, 1]), [[1, 2, 3], [1, 2, 3.001]],
             [[1, 0, 2], REST]),
        edge("one spring of three has no length", net(STAR, 1, 5, 1, [1] * 4), [FOUR[1], *FOUR[1:]], moving),
        edge("a rest length of zero", net(SPRING, 0, 10, 2, [1, 1]), TWO, [[1, 0, 0], REST]),
        edge("no springs", net([], 1, 1, 1, [1, 2]), TWO, STILL),
        edge("two springs between the same two nodes", net([[0, 1], [1, 0]], [1, 3], [4, 6], 1, [1, 1]), TWO,
             [[1, 1, 0], REST]),
        edge("an immovable node", net(SPRING, 1, 10, 2, [INFINITY, 1], [0]), TWO, STILL),
        refused("an edge from a node to itself", net([[1, 1]], 1, 1, 1, [1, 1]), TWO, STILL),
        refused("positions of too few nodes", net(LOOP, 2, 4, 1, [1, 2, 3, 4]), TWO, STILL),
    ]  # fmt: skip

    def maker(draw: Draw) -> Arguments:
        return drawn_mesh(draw), drawn_places(draw), drawn_places(draw)

    return made("mesh_forces", by_hand, maker, single=(0, 1, 2))


def _step() -> list[Probe]:
    held, springs = net(LOOP, 2, 4, 1, [1, 2, 3, 4], [1]), net(SPRING, 1, 10, 0, [1, 3])
    moving = [[1, 2, 0], [-1, 0, 1], [0, 3, 0], [2, 1, 1]]
    by_hand = [
        usual("one spring, from rest, without gravity", springs, TWO, STILL, REST, 0.1),
        usual("one spring with a damper", net(SPRING, 1, 10, 2, [1, 3]), TWO, [[1, 2, 0], [0, 1, 0]], REST, 0.1),
        usual("a free fall", net(SPRING, 2, 10, 2, [1, 3]), TWO, [[1, 0, 2], [1, 0, 2]], DOWN, 0.5),
        usual("a stretched spring falls", springs, TWO, STILL, DOWN, 0.25),
        usual("the first node is pinned", net(SPRING, 1, 10, 2, [1, 3], [0]), TWO, [REST, [1, 1, 0]], DOWN, 0.1),
        usual("four nodes, one of them pinned", held, FOUR, [moving[0], REST, *moving[2:]], DOWN, 0.05),
        usual("four free nodes", net(LOOP, 2, 4, 1, [1, 2, 3, 4]), FOUR, moving, DOWN, 0.05),
        usual("its own acceleration for each node", net(LOOP, 2, 4, 1, [1, 2, 3, 4]), FOUR, moving,
              [DOWN, REST, [1, 2, 3], [0, -5, 0]], 0.05),
        usual("a long step", springs, TWO, STILL, DOWN, 2.0),
        edge("a pinned node that is given a velocity", held, FOUR, moving, DOWN, 0.05),
        edge("all nodes are pinned", net(SPRING, 1, 10, 2, [1, 3], [0, 1]), TWO, [[1, 0, 0], [0, 2, 0]], DOWN, 0.1),
        edge("no springs", net([], 1, 1, 1, [1, 2]), TWO, [[1, 0, 0], [0, 2, 0]], DOWN, 0.1),
        edge("an immovable node", net(SPRING, 1, 10, 2, [INFINITY, 1], [0]), TWO, STILL, DOWN, 0.1),
        edge("nothing acts and nothing moves", net(SPRING, 2, 10, 2, [1, 3]), TWO, STILL, REST, 0.1),
        refused("a step of no length", springs, TWO, STILL, DOWN, 0.0),
        refused("a negative step", springs, TWO, STILL, DOWN, -0.1),
    ]  # fmt: skip

    def maker(draw: Draw) -> Arguments:
        pins, pulled = draw.rng.choice(4, draw.rng.integers(2), replace=False), draw.vector(10)
        velocity = drawn_places(draw)
        velocity[pins] = 0.0
        return drawn_mesh(draw, pins), drawn_places(draw), velocity, pulled, draw.number(0.02, 0.3)

    return made("mesh_step", by_hand, maker, single=range(5))


CUBE = [[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)]
CUBE_EDGES = [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]]
FACES = [[0, 3], [1, 2], [4, 7], [5, 6], [0, 5], [1, 4], [2, 7], [3, 6], [0, 6], [2, 4], [1, 7], [3, 5]]
"""Both diagonals of each face, two by two."""
SPACE = [[0, 7], [1, 6], [2, 5], [3, 4]]


def ends(pairs: Any) -> NDArray[np.int64]:
    """Pairs of nodes as (m, 2) whole numbers."""
    return np.array(pairs, dtype=np.int64).reshape(-1, 2)


def _bracing() -> list[Probe]:
    square, sides = [[1, 0, 0], [3, 0, 0], [3, 2, 0], [1, 2, 0]], ends([[0, 1], [1, 2], [3, 2], [0, 3]])
    both = ends([[0, 2], [1, 3]])
    turned, cube = (np.array(CUBE) @ TURN.T + [1, -2, 3]), ends(CUBE_EDGES)
    ladder = [[x, y, 0] for x in (0.0, 1, 2) for y in (0.0, 1)]
    rungs = ends([[0, 1], [2, 3], [4, 5], [0, 2], [2, 4], [1, 3], [3, 5]])
    crosses = ends([[0, 3], [1, 2], [2, 5], [3, 4]])
    tetrahedron, six = [[1, 1, 1], [3, 1, 1], [1, 4, 1], [1, 1, 2]], [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]]
    by_hand = [
        usual("both diagonals of a square", square, sides, both),
        usual("both diagonals of a square, the other one first", square, sides, both[::-1]),
        usual("a cube, with the diagonals of its faces", CUBE, cube, ends(FACES)),
        usual("a cube, with all its diagonals", turned, cube, ends(FACES + SPACE)),
        usual("a cube, with the diagonals of space first", turned, cube, ends(SPACE + FACES)),
        usual("a ladder of two squares", ladder, rungs, crosses),
        usual("a ladder of two squares, backwards", ladder, rungs, crosses[::-1, ::-1]),
        usual("two edges of a tetrahedron are missing", tetrahedron, ends(six[:4]), ends(six[4:])),
        usual("an edge once more", tetrahedron, ends(six[:5]), ends([[1, 0], six[5]])),
        usual("a diagonal twice", square, sides, ends([[0, 2], [2, 0]])),
        edge("no edges yet", tetrahedron, ends([]), ends(six)),
        edge("no candidates", square, sides, ends([])),
        edge("nothing is missing", tetrahedron, ends(six), ends(six[::-1])),
        edge("three nodes on a line", [[0, 0, 0], [1, 2, 3], [2, 4, 6]], ends([[0, 1], [1, 2]]), ends([[0, 2]])),
        edge("two nodes at one place", [[1, 2, 3], [1, 2, 3], [4, 5, 6]], ends([[0, 2]]), ends([[0, 1], [1, 2]])),
        edge("a hinge of two triangles", [[0, 0, 0], [2, 0, 0], [0, 2, 1], [0, -2, 1]],
             ends([[0, 1], [0, 2], [1, 2], [0, 3], [1, 3]]), ends([[2, 3], [3, 2]])),
        refused("an edge from a node to itself", square, ends([[1, 1]]), both),
        refused("a candidate to a node that does not exist", square, sides, ends([[0, 4]])),
    ]  # fmt: skip

    def maker(draw: Draw) -> Arguments:
        """Some corners of a turned cube, with all springs between them in any order, of which some are there."""
        corners = draw.rng.choice(8, 6, replace=False)
        pairs = [[a, b] for a in range(6) for b in range(a + 1, 6)]
        order = draw.rng.permutation(len(pairs))
        pairs = [pairs[each][:: draw.sign()] for each in order]
        places = (np.array(CUBE)[corners] * draw.number(0.5, 2)) @ draw.turn().T + draw.vector()
        return places, ends(pairs[:8]), ends(pairs[8:])

    return made("diagonals", by_hand, maker, single=range(3))


def _bound() -> list[Probe]:
    by_hand = [
        usual("one spring, equal masses", net(SPRING, 1, 100, 0, [1, 1])),
        usual("one spring, unequal masses", net(SPRING, 1, 100, 0, [1, 4])),
        usual("one spring to the wall", net(SPRING, 1, 100, 0, [1, 4], [0])),
        usual("one spring with a damper", net(SPRING, 1, 100, 5, [1, 1])),
        usual("a damper alone", net(SPRING, 1, 0, 5, [1, 2])),
        usual("a chain of two springs", net(CHAIN, 1, 100, 0, [1, 1, 1])),
        usual("three springs at a heavy node", net(STAR, 1, [50, 80, 20], 0, [9, 1, 2, 1])),
        usual("three springs at a light node", net(STAR, 1, [50, 80, 20], 0, [0.5, 1, 2, 1])),
        usual("a stiff spring and a soft one", net(CHAIN, 1, [400, 4], 0, [1, 1, 0.01])),
        usual("dampers in some springs alone", net(LOOP, 1, [50, 80, 20, 10, 40], [0, 3, 0, 9, 0], [1, 2, 0.5, 1])),
        usual("the node with most springs is pinned", net(STAR, 1, 50, 1, [0.5, 1, 2, 1], [0])),
        edge("no springs", net([], 1, 1, 1, [1, 2])),
        edge("springs between pinned nodes alone", net(CHAIN, 1, 50, 1, [1, 2, 1], [0, 1, 2])),
        edge("springs and dampers without stiffness", net(CHAIN, 1, 0, 0, [1, 2, 1])),
        edge("an immovable node", net(CHAIN, 1, 50, 1, [INFINITY, 2, 1], [0])),
        edge("a node without springs", net(SPRING, 1, 50, 1, [1, 2, 0.1])),
    ]

    def maker(draw: Draw) -> Arguments:
        return (drawn_mesh(draw, draw.rng.choice(4, draw.rng.integers(2), replace=False), draw.rng.random() < 0.4),)

    return made("timestep_bound", by_hand, maker, single=(0,))


def _contact() -> list[Probe]:
    free, mid = net(CHAIN, 1, 10, 1, [1, 2, 3]), [1.0, -2.0, 3.0]
    above, beside, apart = [[1, -2, 4], [2, -2, 3], [4, 5, 6]], [[1, -2, 4], [1, 0, 3], [3, -1, 5]], [[5, 5, 5]] * 3
    falling, slanted = [[0, 0, -2], [1, 0, -3], [1, 1, 1]], [[3, 4, -2], [1, -1, 2], [-1, 2, 0]]
    steep = [[1, 2, -4], [1, -3, 2], [-1, 0, -2]]
    by_hand = [
        usual("straight down, no bounce", free, above, falling, mid, 2.0),
        usual("straight down, half of the speed comes back", free, above, falling, mid, 2.0, 0.5, 0.0),
        usual("slanted, without friction", free, beside, slanted, mid, 2.5, 0.25, 0.0),
        usual("slanted, with a little friction", free, beside, slanted, mid, 2.5, 0.0, 0.2),
        usual("slanted, with friction that stops it", free, beside, steep, mid, 2.5, 0.5, 2.0),
        usual("inside, on its way out", free, above, [[1, 0, 2], [3, 1, 0], REST], mid, 2.0, 0.5, 0.3),
        usual("inside, sliding", free, above, [[3, 1, 0], [0, 3, -1], REST], mid, 2.0, 0.5, 0.3),
        usual("outside, on their way in", free, apart, [[-3, -5, -2]] * 3, mid, 2.0, 0.5, 0.3),
        usual("a pinned node inside", net(CHAIN, 1, 10, 1, [1, 2, 3], [0]), above, falling, mid, 2.0, 0.5, 0.3),
        usual("a large sphere", free, above, falling, [1.0, -2.0, -9.0], 13.5, 0.5, 0.3),
        edge("exactly on the surface, on its way in", free, [[1, -2, 5], [3, -2, 3], [1, 0, 3]],
             [[0, 1, -2], [-3, 1, 0], [1, -1, 0]], mid, 2.0, 0.5, 0.3),
        edge("at the centre, falling", free, [mid, *above[1:]], [[1, 2, -3], *falling[1:]], mid, 2.0, 0.5, 0.3),
        edge("at rest inside", free, above, [REST] * 3, mid, 2.0, 0.5, 0.3),
        edge("a perfect bounce", free, beside, falling, mid, 2.5, 1.0, 0.0),
        edge("all nodes are pinned", net(CHAIN, 1, 10, 1, [1, 2, 3], [0, 1, 2]), above, falling, mid, 2.0, 0.5, 0.3),
        refused("a radius of zero", free, above, falling, mid, 0.0),
        refused("a restitution above 1", free, above, falling, mid, 2.0, 1.5, 0.0),
        refused("a negative friction", free, above, falling, mid, 2.0, 0.5, -0.1),
    ]  # fmt: skip

    def maker(draw: Draw) -> Arguments:
        centre, radius = draw.vector(), draw.number(1, 3)
        depths = (draw.number(0.2, 0.95), draw.number(0.2, 0.95), draw.number(0.2, 0.95), draw.number(1.05, 1.5))
        places = np.array([centre + depth * radius * draw.unit() for depth in depths])
        pins = draw.rng.choice(4, draw.rng.integers(2), replace=False)
        e, mu = draw.number(0, 1), draw.number(0, 0.8)
        return drawn_mesh(draw, pins), places, drawn_places(draw), centre, radius, e, mu

    return made("mesh_sphere_contact", by_hand, maker, single=range(7))


def _strain() -> list[Probe]:
    free, pins = net(CHAIN, 1, 10, 1, [1, 2, 4]), net(CHAIN, 1, 10, 1, [1, 2, 4], [0, 2])
    along = [[1, 0, 0], [3, 0, 0], [4, 0, 0]]
    by_hand = [
        usual("one spring, equal masses", net(SPRING, 1, 10, 1, [1, 1]), TWO, 0.2, 1),
        usual("one spring, unequal masses", net(SPRING, 1, 10, 1, [1, 3]), TWO, 0.2, 1),
        usual("one slanted spring", net(SPRING, 2, 10, 1, [3, 1]), SLANTED, 0.1, 1),
        usual("one end is pinned", net(SPRING, 1, 10, 1, [1, 3], [0]), TWO, 0.1, 1),
        usual("within the limit", net(SPRING, 1.95, 10, 1, [1, 3]), TWO, 0.1, 5),
        usual("shortened", net(SPRING, 3, 10, 1, [1, 3]), TWO, 0.1, 5),
        usual("two springs, the first is too long, one round", free, along, 0.1, 1),
        usual("two springs, the first is too long, two rounds", free, along, 0.1, 2),
        usual("two springs, the other one comes first", net(CHAIN[::-1], 1, 10, 1, [1, 2, 4]), along, 0.1, 1),
        usual("two springs between pins", pins, [[1, 0, 0], [2, 0, 0], [4, 0, 0]], 0.1, 3),
        usual("three springs at one node", net(STAR, 1, 10, 1, [1, 2, 3, 4]), FOUR, 0.1, 1),
        usual("five springs, one node pinned, four rounds", net(LOOP, [1, 2, 1, 2, 3], 10, 1, [1, 2, 3, 4], [2]), FOUR,
              0.1, 4),
        edge("both ends are pinned", net(SPRING, 1, 10, 1, [1, 3], [0, 1]), TWO, 0.1, 5),
        edge("a rest length of zero", net(SPRING, 0, 10, 1, [1, 3]), TWO, 0.1, 5),
        edge("no stretching at all is allowed", net(SPRING, 1.5, 10, 1, [1, 3]), TWO, 0.0, 1),
        edge("no rounds", net(SPRING, 1, 10, 1, [1, 3]), TWO, 0.1, 0),
        edge("no springs", net([], 1, 1, 1, [1, 2]), TWO, 0.1, 5),
        edge("an immovable node", net(SPRING, 1, 10, 1, [INFINITY, 3], [0]), TWO, 0.1, 1),
        edge("both ends at one place", net(SPRING, 1, 10, 1, [1, 3]), [[1, 2, 3]] * 2, 0.1, 2),
        refused("a negative limit", net(SPRING, 1, 10, 1, [1, 3]), TWO, -0.1, 1),
    ]  # fmt: skip

    def maker(draw: Draw) -> Arguments:
        pins = draw.rng.choice(4, draw.rng.integers(2), replace=False)
        return drawn_mesh(draw, pins), drawn_places(draw), draw.number(0, 0.3), int(draw.rng.integers(1, 5))

    return made("limit_strain", by_hand, maker, single=range(4))


_TABLE = {
    "mesh_forces": _forces,
    "mesh_step": _step,
    "diagonals": _bracing,
    "timestep_bound": _bound,
    "mesh_sphere_contact": _contact,
    "limit_strain": _strain,
}
