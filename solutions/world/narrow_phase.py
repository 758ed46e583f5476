"""Where pieces touch: a function for each two kinds (slides 9 and 17)."""

from __future__ import annotations

from collections.abc import Callable

from solutions.world.capsule_hull import capsule_hull
from solutions.world.hull_pairs import hull_half_space, hull_hull
from solutions.world.round_pairs import (
    capsule_capsule,
    capsule_half_space,
    sphere_box,
    sphere_capsule,
    sphere_half_space,
    sphere_sphere,
)
from solutions.world.shapes import (
    BOX,
    CAPSULE,
    HALF_SPACE,
    POLYHEDRON,
    SPHERE,
    Placed,
    Touching,
)

PAIRS: dict[tuple[int, int], Callable[[Placed, Placed, float], Touching]] = {
    (SPHERE, SPHERE): sphere_sphere,
    (SPHERE, CAPSULE): sphere_capsule,
    (SPHERE, BOX): sphere_box,
    (SPHERE, POLYHEDRON): capsule_hull,
    (SPHERE, HALF_SPACE): sphere_half_space,
    (CAPSULE, CAPSULE): capsule_capsule,
    (CAPSULE, BOX): capsule_hull,
    (CAPSULE, POLYHEDRON): capsule_hull,
    (CAPSULE, HALF_SPACE): capsule_half_space,
    (BOX, BOX): hull_hull,
    (BOX, POLYHEDRON): hull_hull,
    (BOX, HALF_SPACE): hull_half_space,
    (POLYHEDRON, POLYHEDRON): hull_hull,
    (POLYHEDRON, HALF_SPACE): hull_half_space,
}
"""For each two kinds, a function of pieces A, pieces B and a margin.

Row i of A is paired with row i of B. The function returns all places at which
the separation of the two is at most the margin: the pairs in ascending order,
and the places of a pair in the order of their features. Two half-spaces,
neither of which can move, have no function.
"""
