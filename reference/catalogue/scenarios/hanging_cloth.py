"""A small cloth of unequal masses that hangs by two corners and settles in a viscous fluid (slide 28)."""

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
from reference.scene.forces import Fluid, Spring
from reference.scene.scenario import Body, Scenario, Sphere
from reference.scene.trajectory import Trajectory

ROWS, COLUMNS, SPACING = 4, 4, 0.025
"""Nodes, and the distance of neighbours, m."""
MASSES = (0.03, 0.05, 0.02, 0.06, 0.04, 0.025, 0.045)
"""Of the nodes in turn, kg."""
SPRINGS = {
    "structural": (200.0, ((0, 1), (1, 0))),
    "shear": (200.0, ((1, 1), (1, -1))),
    "bend": (40.0, ((0, 2), (2, 0))),
}
"""Stiffness, N/m, and which nodes each kind of spring joins: rows and columns from the first end to the second."""
DAMPING = 0.02
"""Of every spring, N s/m."""
TOWARDS, ASIDE = np.array([0.8, 0.6, 0.0]), np.array([-0.6, 0.8, 0.0])
"""Horizontal directions from the first pin to the second, and across."""
TILT = 1.1
"""Angle by which the cloth hangs down at the start, rad."""
RISE = 0.6
"""How much higher the second pin is, in spacings."""
HONEY = Fluid(viscosity=7.0)
"""As viscous as honey, and without weight. Each ball is drawn 0.1 m/kg large, and so has the drag 13.2 1/s per mass."""
DURATION = 1.4
"""s."""
LEFT = "less than 0.1 mm of the swings is left"
PINS = (0, 0), (0, COLUMNS - 1)


def _hung(kinds: float = 3.0, spread: float = 0.9) -> Case:
    """A cloth with so many kinds of spring; its pins are `spread` of their distance in the flat cloth apart."""
    name = f"{list(SPRINGS)[int(kinds) - 1]},spread={spread:g}"
    grid = list(product(range(ROWS), range(COLUMNS)))
    down = math.cos(TILT) * ASIDE - (0.0, 0.0, math.sin(TILT))
    nodes = []
    for number, (row, column) in enumerate(grid):
        mass, place = MASSES[number % len(MASSES)], SPACING * (column * TOWARDS + row * down)
        if (row, column) == PINS[1]:
            place = SPACING * (column * spread * TOWARDS + (0.0, 0.0, RISE))
        if (row, column) in PINS:
            nodes.append(Body(f"pin {row},{column}", Sphere(0.004), position=tuple(place.tolist())))
        else:
            nodes.append(Body(f"node {row},{column}", Sphere(0.1 * mass), mass, tuple(place.tolist())))
    springs = tuple(
        Spring(nodes[first].name, nodes[grid.index(other)].name, stiffness, SPACING * math.hypot(*offset), DAMPING)
        for stiffness, offsets in list(SPRINGS.values())[: int(kinds)]
        for offset in offsets
        for first, (row, column) in enumerate(grid)
        if (other := (row + offset[0], column + offset[1])) in grid
    )
    scenario = Scenario(f"hanging-cloth/{name}", tuple(nodes), (), DURATION, springs=springs, fluid=HONEY)
    return Case(name, (scenario,), {"kinds": kinds, "spread": spread})


def _depth(scenario: Scenario, place: Array) -> float:
    """How far the lowest node hangs below the first pin, m."""
    return float(-np.min(place[:, 2]))


def _pull(scenario: Scenario, place: Array) -> float:
    """Size of the force of all springs on the second pin, N."""
    pin, force = COLUMNS - 1, np.zeros(3)
    for spring in scenario.springs:
        ends = scenario.index(spring.body_a), scenario.index(spring.body_b)
        if pin in ends:
            along = place[sum(ends) - pin] - place[pin]
            length = float(np.linalg.norm(along))
            force += spring.stiffness * (length - spring.rest_length) / length * along
    return float(np.linalg.norm(force))


def _depth_at_rest(case: Case) -> float:
    return _depth(case.scenarios[0], settled.at_rest(case.scenarios[0]))


def _lowest(trajectory: Trajectory) -> Array:
    return np.asarray(np.min(trajectory.positions[..., 2], axis=1))


HANGING_CLOTH = Family(
    name="hanging-cloth",
    title="A cloth that hangs by two corners",
    topic="meshes",
    statements=(28, 29),
    about="A cloth of 4 × 4 unequal masses, 2.5 cm apart, hangs by two corners. The second corner is higher, and so"
    " near that the cloth cannot be straight between them. One case has structural springs alone, the other shear and"
    " bend springs as well. The cloth swings down in a fluid as viscous as honey. The early depth is the depth after"
    " 0.05 s.",
    expected="At rest, springs and weights balance at every node. Newton's method finds this minimum of the energy"
    " without stepping through time, and finds the same minimum from the cloth's first shape and from its last. With"
    " structural springs alone the cloth narrows and hangs deepest. Shear and bend springs keep its width, and the"
    " slack between the pins becomes a fold.",
    why=(
        "The hand-written function `static_shape` finds the shape without any motion, and `mesh_step` steps until the"
        " mesh has settled into it. The lab tells the engines the forces at the start of each step, and the engines"
        " follow the same recurrence as `mesh_step`.",
        "The shape is soft: the stiffness against the swing of a fold is 4 N/m, and along a spring 200 N/m. Without"
        " bend springs a fold may need seconds to find its place.",
    ),
    cases=(_hung(1.0), _hung(3.0)),
    quantities=(
        Quantity("depth", "depth", "m", settled.at_end(_depth), settled.expect(_depth, "depth", LEFT), _depth_at_rest),
        Quantity("pull", "pin force", "N", settled.at_end(_pull), settled.expect(_pull, "force", LEFT)),
        Quantity("off", "off shape", "m", settled.off, tolerances.within_a_millimetre),
        Quantity("early", "early depth", "m", settled.early(_depth, 0.05), None, absent="takes no steps"),
    ),
    curve=Curve("bend,spread=0.9", "The lowest node", "height above the first pin, m", _lowest),
    convergence=Convergence("bend,spread=0.9", "depth", (2.0, 1.0)),
    grid=Grid((Parameter("spread", "", (0.7, 0.8, 0.9), 0.9),), (2e-3,), _hung),
    predict=loaded.predict,
)

FAMILIES = (HANGING_CLOTH,)
