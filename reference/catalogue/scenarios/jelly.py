"""A block of jelly: a lattice of springs that internal springs keep in shape, and that collapses without (slide 28)."""

from __future__ import annotations

import math
from itertools import product

import numpy as np

from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.catalogue.scenarios import settled, tolerances
from reference.prediction import loaded
from reference.scene.forces import Fluid, Force, Spring
from reference.scene.scenario import Body, Scenario, Sphere
from reference.scene.trajectory import Trajectory

SIZE, SPACING = (2, 2, 3), 0.03
"""Nodes along x, y and z, and the distance of neighbours, m."""
MASSES = (0.03, 0.05, 0.02, 0.06, 0.04, 0.025, 0.045)
"""Of the nodes in turn, kg."""
STIFFNESS, DAMPING = 200.0, 0.02
"""Of every spring, N/m and N s/m."""
SPRINGS = {
    "edges": ((0, 0, 1), (0, 1, 0), (1, 0, 0)),
    "faces": ((0, 1, 1), (0, 1, -1), (1, 0, 1), (1, 0, -1), (1, 1, 0), (1, -1, 0)),
    "space": ((1, 1, 1), (1, 1, -1), (1, -1, 1), (1, -1, -1)),
}
"""Which nodes each kind of spring joins: the edges of the cubes, and the diagonals of their faces and of space."""
PUSH = np.array([0.8, 0.6, 0.0])
"""Direction of the push on the upper nodes: along no face and no diagonal."""
HONEY = Fluid(viscosity=7.0)
"""As viscous as honey, and without weight. Each ball is drawn 0.1 m/kg large, and so has the drag 13.2 1/s per mass."""
DURATION = 1.4
"""s."""
LEFT = "less than 0.1 mm of the swings is left"


def _pushed(kinds: float = 2.0, push: float = 0.15) -> Case:
    """A block on a fixed base with so many kinds of spring, each upper node pushed aside with so many N."""
    name = f"{list(SPRINGS)[int(kinds) - 1]},push={push:g}"
    grid = list(product(*map(range, SIZE)))
    nodes = []
    for number, place in enumerate(grid):
        mass = math.inf if place[2] == 0 else MASSES[number % len(MASSES)]
        radius = 0.004 if mass == math.inf else 0.1 * mass
        x, y, z = (SPACING * part for part in place)
        nodes.append(Body("node {},{},{}".format(*place), Sphere(radius), mass, (x, y, z)))
    springs = tuple(
        Spring(nodes[first].name, nodes[grid.index(other)].name, STIFFNESS, SPACING * math.hypot(*offset), DAMPING)
        for offsets in list(SPRINGS.values())[: int(kinds)]
        for offset in offsets
        for first, (x, y, z) in enumerate(grid)
        if (other := (x + offset[0], y + offset[1], z + offset[2])) in grid and max(z, other[2]) > 0
    )
    x, y, z = (push * PUSH).tolist()
    forces = tuple(Force(node.name, (x, y, z)) for node, place in zip(nodes, grid, strict=True) if _on_top(place))
    scenario = Scenario(f"jelly/{name}", tuple(nodes), (), DURATION, forces=forces, springs=springs, fluid=HONEY)
    return Case(name, (scenario,), {"kinds": kinds, "push": push})


def _on_top(place: tuple[int, ...]) -> bool:
    return place[2] == SIZE[2] - 1


TOP = [number for number, place in enumerate(product(*map(range, SIZE))) if _on_top(place)]


def _lean(scenario: Scenario, place: Array) -> float:
    """How far the upper nodes have moved along the push on average, m."""
    start = np.array([scenario.bodies[number].position for number in TOP])
    return float(np.mean((place[TOP] - start) @ PUSH))


def _height(scenario: Scenario, place: Array) -> float:
    """Mean height of the upper nodes above the base, m."""
    return float(np.mean(place[TOP, 2]))


def _heights(trajectory: Trajectory) -> Array:
    return np.asarray(np.mean(trajectory.positions[:, TOP, 2], axis=1))


JELLY = Family(
    name="jelly",
    title="Jelly with and without internal springs",
    topic="meshes",
    statements=(28, 29),
    about="A block of 2 × 2 × 3 unequal masses on a fixed base, 6 cm high, in a fluid as viscous as honey. Its upper"
    " masses are pushed aside. In one case the springs are the edges of the cubes alone, in the other the edges and"
    " the diagonals of the faces. The lean is how far the upper masses have moved along the push, and the early lean"
    " is the lean after 0.05 s.",
    expected="The edges alone leave eight motions of the free masses that stretch no spring: nothing resists the push,"
    " and the block falls over until it hangs below its base. With the diagonals of the faces every motion stretches"
    " some spring, and the block stands and leans. Newton's method on the energy finds both shapes.",
    why=(
        "The hand-written function `static_shape` finds the shape without any motion, and `mesh_step` steps until the"
        " mesh has settled into it. The lab tells the engines the forces at the start of each step, and the engines"
        " follow the same recurrence as `mesh_step`.",
        "The lean is larger than the stiffness matrix of the upright block says, because weight tips a leaning block"
        " farther: with the diagonals of the faces the lean is 16.7 mm instead of 10.0 mm.",
    ),
    cases=(_pushed(1.0), _pushed(2.0)),
    quantities=(
        Quantity("lean", "lean", "m", settled.at_end(_lean), settled.expect(_lean, "lean", LEFT)),
        Quantity("height", "height", "m", settled.at_end(_height), settled.expect(_height, "height", LEFT)),
        Quantity("off", "off shape", "m", settled.off, tolerances.within_a_millimetre),
        Quantity("early", "early lean", "m", settled.early(_lean, 0.05), None, absent="takes no steps"),
    ),
    curve=Curve("edges,push=0.15", "Without internal springs", "height of the upper masses, m", _heights),
    convergence=Convergence("faces,push=0.15", "lean", (2.0, 1.0)),
    grid=Grid(
        (
            Parameter("kinds", "", (1.0, 2.0, 3.0), 2.0, whole=True),
            Parameter("push", "N", (0.15, 0.3), 0.15),
        ),
        (2e-3,),
        _pushed,
    ),
    predict=loaded.predict,
)

FAMILIES = (JELLY,)
