"""A cloth that falls over a fixed ball and drapes: some masses come to rest on it, the others hang (slide 28)."""

from __future__ import annotations

import math
from itertools import product

import numpy as np

from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.catalogue.scenarios import settled, tolerances
from reference.engines.base import Method
from reference.mesh_truth import net_force
from reference.prediction import draped
from reference.scene.forces import Fluid, Spring
from reference.scene.scenario import Body, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.spring_network import network
from reference.scene.trajectory import Trajectory

ROWS, COLUMNS, SPACING = 4, 5, 0.025
"""Nodes, and the distance of neighbours, m."""
MASSES = (0.03, 0.05, 0.02, 0.06, 0.04, 0.025, 0.045)
"""Of the nodes in turn, kg."""
SMALL = 0.004
"""Radius of all nodes, m: with one radius the functions of the mesh topic know one distance from the ball."""
SPRINGS = {
    "structural": (200.0, ((0, 1), (1, 0))),
    "shear": (50.0, ((1, 1), (1, -1))),
}
"""Stiffness, N/m, and which nodes each kind of spring joins: rows and columns from the first end to the second."""
DAMPING = 0.02
"""Of every spring, N s/m."""
TOWARDS, ASIDE = np.array([0.8, 0.6, 0.0]), np.array([-0.6, 0.8, 0.0])
"""Horizontal directions along a row and along a column of the flat cloth."""
UP = np.array([0.0, 0.0, 1.0])
SEEN = 1e-4
"""Depth in the ball that somebody might see, m."""
PINS = (1, 2), (2, 2)
"""Two nodes that are fixed to the ball on both sides of its top. With one the cloth could turn about it."""
HONEY = Fluid(viscosity=9.0)
"""As viscous as cold honey, and without weight. Its drag on the masses is 11 1/s to 34 1/s."""
DURATION = 1.2
"""s."""
LEFT = "less than 0.05 mm of the swings is left"


def _laid(kinds: float = 2.0, radius: float = 0.03) -> Case:
    """A cloth with so many kinds of spring, flat over a ball of this radius, m."""
    name = f"{list(SPRINGS)[int(kinds) - 1]},radius={radius:g}"
    grid = list(product(range(ROWS), range(COLUMNS)))
    middle, half = np.mean(PINS, axis=0), SPACING * math.dist(*PINS) / 2
    height = math.sqrt((radius + SMALL) ** 2 - half**2)
    nodes, ball = [], Body("ball", Sphere(radius))
    for number, (row, column) in enumerate(grid):
        aside = SPACING * ((column - middle[1]) * TOWARDS + (row - middle[0]) * ASIDE)
        x, y, z = (aside + height * UP).tolist()
        if (row, column) in PINS:
            nodes.append(Body(f"pin {row},{column}", Sphere(SMALL), position=(x, y, z)))
        else:
            mass = MASSES[number % len(MASSES)]
            nodes.append(Body(f"node {row},{column}", Sphere(SMALL), mass, (x, y, z)))
    springs = tuple(
        Spring(nodes[first].name, nodes[grid.index(other)].name, stiffness, SPACING * math.hypot(*offset), DAMPING)
        for stiffness, offsets in list(SPRINGS.values())[: int(kinds)]
        for offset in offsets
        for first, (row, column) in enumerate(grid)
        if (other := (row + offset[0], column + offset[1])) in grid and not {(row, column), other} <= set(PINS)
    )
    pairs = tuple(Pair(ball.name, node.name) for node in nodes if not node.immovable)
    bodies = (ball, *nodes)
    scenario = Scenario(f"cloth-over-a-ball/{name}", bodies, pairs, DURATION, springs=springs, fluid=HONEY)
    return Case(name, (scenario,), {"kinds": kinds, "radius": radius})


FREE = [number for number, node in enumerate(product(range(ROWS), range(COLUMNS)), 1) if node not in PINS]
"""Places of the nodes that move among the bodies, after the ball."""


def _mean(scenario: Scenario, place: Array) -> float:
    """How far the free nodes are below the pins on average, m."""
    return float(place[1 + COLUMNS * PINS[0][0] + PINS[0][1], 2] - np.mean(place[FREE, 2]))


def _depth(scenario: Scenario, place: Array) -> float:
    """How far the lowest node is below the pins, m."""
    return float(place[1 + COLUMNS * PINS[0][0] + PINS[0][1], 2] - np.min(place[FREE, 2]))


def _sunk(scenario: Scenario, place: Array) -> float:
    """How deep the deepest free node is in the ball, m; zero where none is."""
    radius = scenario.bodies[0].shape.radius  # type: ignore[union-attr]
    return float(max(0.0, np.max(radius + SMALL - np.linalg.norm(place[FREE], axis=-1))))


def _heights(trajectory: Trajectory) -> Array:
    return np.asarray(np.mean(trajectory.positions[:, FREE, 2], axis=1))


def _carried(scenario: Scenario, place: Array) -> float:
    """What springs and weights leave for the ball to carry on all free nodes together, N, upwards."""
    net = network(scenario)
    force = net_force(place, net.edges, net.stiffness, net.rest_length, net.load)
    return float(-np.sum(force[FREE, 2]))


def _balanced(case: Case, settings: Settings, method: Method) -> Expectation:
    """Expect the force of the shape at rest, within 0.1 % of what all free masses weigh."""
    scenario = case.scenarios[0]
    weight = -float(np.sum(network(scenario).load[FREE, 2]))
    value = _carried(scenario, settled.at_rest(scenario))
    return Expectation(value, settled.SHARE * weight, f"0.1 % of the weight; {LEFT}")


def _none_inside(case: Case, settings: Settings, method: Method) -> Expectation:
    """Expect no node inside the ball, as nearly as one can see."""
    return Expectation(0.0, SEEN, "0.1 mm: nobody sees it in a cloth of 10 cm")


CLOTH_OVER_A_BALL = Family(
    name="cloth-over-a-ball",
    title="A cloth that drapes over a ball",
    topic="meshes",
    statements=(28, 29),
    about="A cloth of 4 × 5 unequal masses, small balls 2.5 cm apart, lies flat over a smooth, fixed ball with a radius"
    " of 3 cm. Two of the masses are fixed beside the top of the ball. The others fall, and the cloth drapes over the"
    " ball in a fluid as viscous as honey. One case has structural springs alone, the other has shear springs as well."
    " The early drop is that after 0.05 s.",
    expected="At rest, springs and weight balance at every mass that hangs free, and press every other mass against the"
    " ball. Newton's method finds the shape of least energy among all shapes that do not enter the ball, without any"
    " steps through time. It is not told which masses rest on the ball, nor how hard they press. With shear springs 9"
    " of the 18 free masses rest on the ball, with structural springs alone 14.",
    why=(
        "Each mass may touch the ball, but no other mass. So every contact obeys the engine's law of a single contact,"
        " and the recurrence adds that law to the forces at the start of each step.",
        "By hand, `mesh_step` moves the masses, and `mesh_sphere_contact` moves those that have entered the ball back"
        " onto its surface. The lecture has no function for a shape at rest with contacts, so no method is exact.",
        "In an engine the resting masses are a little way inside the ball. PyBullet leaves the overlap that it is told"
        " to leave. MuJoCo's contacts give way under the weight, as installed much farther than tuned. What DART"
        " leaves comes from the landing.",
    ),
    cases=(_laid(1.0), _laid(2.0)),
    quantities=(
        Quantity("height", "mean drop", "m", settled.at_end(_mean), settled.expect(_mean, "height", LEFT)),
        Quantity("depth", "lowest corner", "m", settled.at_end(_depth), settled.expect(_depth, "depth", LEFT)),
        Quantity("carried", "ball's force", "N", settled.at_end(_carried), _balanced),
        Quantity("sunk", "deepest in the ball", "m", settled.at_end(_sunk), _none_inside),
        Quantity("off", "off shape", "m", settled.off, tolerances.within_a_millimetre),
        Quantity("early", "early drop", "m", settled.early(_mean, 0.05), None, absent="has no way there"),
    ),
    curve=Curve("shear,radius=0.03", "The free masses", "mean height above the middle of the ball, m", _heights),
    convergence=Convergence("shear,radius=0.03", "height", (2.0, 1.0)),
    grid=Grid((Parameter("radius", "m", (0.025, 0.0275, 0.03), 0.03),), (2e-3,), _laid),
    predict=draped.predict,
)

FAMILIES = (CLOTH_OVER_A_BALL,)
