"""Meshes of springs by hand: a hanging cable, and how many motions of a frame cost no energy."""

from __future__ import annotations

import itertools
import math

import numpy as np

from reference.arrays import Array
from reference.engines.implementation import Implementation
from reference.published.answers import Answers, answer_within, as_answers
from reference.published.by_hand.axes import UP
from reference.published.case import Published

NAMES = ("horizontal", "at_lower_end", "at_upper_end")
"""The three pulls of P35."""
SPRINGS = (16, 32, 64)
"""Into how many springs its cable is cut."""
SAG = 0.5
"""Depth of the parabola with which the cable's shape starts, as a share of its length."""
AT_REST = 1e-10
"""Net force at which a cable counts as at rest, as a share of its weight."""
MOST_STEPS = 200
"""Newton steps at most; some thirty are enough."""
SHORTEST = 1e-9
"""Share of a Newton step below which rounding alone keeps the energy from falling."""
RIGID = 6
"""Motions of a body that keeps its shape."""
SIDE = 1e-6
"""How much the length of a bar may differ from the one that is looked for, as a share."""


def cable(case: Published, code: Implementation) -> Answers:
    """P35: a chain of springs with their masses at the nodes, extrapolated from three lengths of spring.

    The weight that is gathered at the nodes makes an error of second order in a spring's length, and one of fourth
    order behind it. The first extrapolation, (4 b − a)/3, removes the second order, and another one the fourth,
    (16 d − c)/15. What the last one changes is far more than what it leaves.
    """
    a, b, c = (_pulls(case, code, count) for count in SPRINGS)
    once, again = (4 * b - a) / 3, (4 * c - b) / 3
    change = (again - once) / 15
    reason = "springs with their mass at the nodes, extrapolated twice; this is what the second time changed"
    return {
        name: answer_within(case, name, float(value), float(off), reason)
        for name, value, off in zip(NAMES, again + change, np.abs(change), strict=True)
    }


def _pulls(case: Published, code: Implementation, count: int) -> Array:
    """Horizontal pull and vertical pulls at the lower and at the upper end, N, (3,), of so many springs in a row."""
    along, up, length, stiffness, weight = case.values("along", "up", "length", "axial_stiffness", "weight")
    share = np.linspace(0, 1, count + 1)
    straight = length * np.stack([share, 0 * share, 0 * share], axis=-1)
    edges = np.stack([np.arange(count), np.arange(1, count + 1)], axis=-1)
    lump = weight * length / count  # an acceleration of 1 m/s² gives it its weight
    mesh = code.function("spring_mesh")(straight, edges, stiffness * count / length, 0.0, lump, (0, count))
    hanging = straight * along / length + np.outer(share * up - 4 * SAG * length * share * (1 - share), UP)
    shape = _at_rest(code, mesh, hanging, lump)
    force = code.function("mesh_forces")(mesh, shape, 0 * shape)
    # each end carries half of the spring beside it
    return np.array([force[0, 0], -force[0, 2] + lump / 2, -force[-1, 2] + lump / 2])


def _at_rest(code: Implementation, mesh: object, start: Array, lump: float) -> Array:
    """The shape in which the springs carry the nodes between the two ends, by Newton's method with shorter steps."""
    forces, stiffness = code.function("mesh_forces"), code.function("edge_stiffness")
    matrix_of, energy_of = code.function("mesh_matrix"), code.function("mesh_energy")

    def energy(shape: Array) -> float:
        return float(np.sum(energy_of(mesh, shape))) + lump * float(np.sum(shape[1:-1, 2]))

    shape, inner = start, np.s_[3:-3]
    for _ in range(MOST_STEPS):
        net = (forces(mesh, shape, 0 * shape) - lump * UP)[1:-1].ravel()
        left = np.max(np.abs(net))
        if left < AT_REST * lump * len(shape):
            break
        matrix = matrix_of(mesh, stiffness(mesh, shape))[inner, inner]
        # a slack spring has no stiffness across; this much more gives every node some, and vanishes with the net force
        matrix = matrix + left / np.linalg.norm(start[1] - start[0]) * np.eye(len(matrix))
        way, step, before = np.linalg.solve(matrix, net).reshape(-1, 3), 1.0, energy(shape)
        while energy(_moved(shape, step * way)) > before and step > SHORTEST:
            step /= 2
        shape = _moved(shape, step * way)
    return shape


def _moved(shape: Array, way: Array) -> Array:
    """The shape with the nodes between its ends moved."""
    return np.asarray(shape + np.pad(way, ((1, 1), (0, 0))))


def shaky_frames(case: Published, code: Implementation) -> Answers:
    """P36: motions without energy, less the six of a rigid body."""
    golden = (1 + math.sqrt(5)) / 2
    expanded = _cyclic(case.numbers("stretched_vertex"))
    icosahedron = _cyclic((golden, 1.0, 0.0))
    x, y, _ = case.numbers("stretched_vertex")
    tendon = math.hypot(x - y, x, y)  # from (x, y, 0) to (y, 0, x) and its like
    return as_answers(
        expanded_octahedron=_shaky(code, expanded, _bars(expanded, 2 * x, tendon)),
        icosahedron=_shaky(code, icosahedron, _bars(icosahedron, 2.0)),
        prism=tuple(_shaky(code, *_prism(case, twist)) for twist in case.numbers("twists")),
    )


def _shaky(code: Implementation, places: Array, bars: Array) -> float:
    mesh = code.function("spring_mesh")(places, bars, 1.0)
    return float(code.function("zero_energy_modes")(mesh, places)) - RIGID


def _cyclic(vertex: tuple[float, ...]) -> Array:
    """The twelve cyclic permutations of (±x, ±y, 0)."""
    x, y, _ = vertex
    signs = itertools.product((x, -x), (y, -y))
    return np.array([np.roll((a, b, 0.0), shift) for a, b in signs for shift in range(3)])


def _bars(places: Array, *lengths: float) -> Array:
    """All pairs of joints that are as far apart as one of the lengths."""
    pairs = np.array(list(itertools.combinations(range(len(places)), 2)))
    apart = np.linalg.norm(places[pairs[:, 0]] - places[pairs[:, 1]], axis=-1)
    return pairs[np.any(np.abs(apart[:, None] / lengths - 1) < SIDE, axis=-1)]


def _prism(case: Published, twist: float) -> tuple[Array, Array]:
    """Joints and bars of two triangles, the upper one turned by `twist`, degrees, with six bars between them."""
    below = np.radians([0.0, 120.0, 240.0])
    above = below + math.radians(twist)
    height = case.value("prism_height")
    rings = [(angles, z) for angles, z in ((below, 0.0), (above, height))]
    places = np.concatenate([np.stack([np.cos(at), np.sin(at), np.full(3, z)], axis=-1) for at, z in rings])
    bars = [(k, (k + 1) % 3) for k in range(3)] + [(3 + k, 3 + (k + 1) % 3) for k in range(3)]
    bars += [(k, 3 + k) for k in range(3)] + [(k, 3 + (k + 1) % 3) for k in range(3)]
    return places, np.array(bars)
