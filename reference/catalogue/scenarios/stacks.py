"""Boxes that stand on each other (slides 21 and 22)."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Family, Quantity
from reference.catalogue.scenarios.bouncing_ball import FLOOR
from reference.catalogue.scenarios.tolerances import at_rest, within_a_millimetre
from reference.scene.scenario import Body, Box, Pair, Scenario
from reference.scene.trajectory import Trajectory

HALF = 0.1
"""Half the edge of every cube, m."""
CUBE = Box((HALF, HALF, HALF))
FRICTION = 0.5
STANDING = 10.0
"""How long a stack is watched, s."""
LATE = 1.0
"""How long before the end a stack has to have come to rest, s."""


def _stack(count: int) -> Case:
    cubes = tuple(Body(f"cube {place + 1}", CUBE, 1.0, (0.0, 0.0, HALF * (2 * place + 1))) for place in range(count))
    names = ["floor", *(cube.name for cube in cubes)]
    pairs = tuple(Pair(upper, lower, kinetic_friction=FRICTION) for lower, upper in pairwise(names))
    name = f"boxes={count}"
    scenario = Scenario(f"stack/{name}", (FLOOR, *cubes), pairs, STANDING)
    return Case(name, (scenario,), {"count": float(count)})


def _top(trajectory: Trajectory) -> str:
    """Name of the topmost cube: a stack lists its bodies from the floor up."""
    return trajectory.scenario.bodies[-1].name


def _height_error(trajectory: Trajectory) -> float:
    """Largest distance of the top's height from where it was set down, m, with its sign."""
    height = trajectory.position(_top(trajectory))[:, 2]
    off = height - height[0]
    return float(off[np.argmax(np.abs(off))])


def _sideways(trajectory: Trajectory) -> float:
    """Largest distance that any box has moved along the floor, m."""
    moved = trajectory.positions - trajectory.positions[0]
    return float(np.max(np.hypot(moved[..., 0], moved[..., 1])))


def _fastest(trajectory: Trajectory) -> float:
    """Largest speed of any box in the last second, m/s."""
    late = trajectory.times >= trajectory.times[-1] - LATE
    return float(np.max(np.linalg.norm(trajectory.velocities[late], axis=-1)))


def _top_height(trajectory: Trajectory) -> Array:
    height = trajectory.position(_top(trajectory))[:, 2]
    return np.asarray(1000 * (height - height[0]))


STACK = Family(
    name="stack",
    title="Stack of boxes",
    topic="world",
    statements=(21, 22),
    about=f"Cubes of {2 * HALF:g} m stand on each other, five or ten of them, and are watched for {STANDING:g} s.",
    expected="Nothing moves: each contact carries the weight of all the boxes above it.",
    why=(
        "A stack shows what a solver can do: the force below must become the weight of all boxes above. PyBullet's"
        " sequential impulses need 100 passes and boxes for ground; with 10 the top of five is a tenth of a millimetre"
        " low. Boxes whose gap of zero is rounded to an opening first fall `g dt²` a step, three steps for five and"
        " six for ten; what is left is micro-slip.",
        "MuJoCo's Newton solver finds the forces in one or two iterations. Its contacts are soft, and the top of n"
        " boxes sinks by `n² (1 − d) g dt²/(4 r)`, a quarter of a micrometre for ten. It has a margin of a"
        " nanometre, without which the stack would drop by 0.2 mm first.",
        "DART's default solver goes through the contacts by pivots and solves the whole stack at once; where it breaks"
        " off, 30 sweeps stand in for it, and a little drift is left. The stack stands as well in stock DART as in"
        " tuned DART.",
    ),
    cases=(_stack(5), _stack(10)),
    quantities=(
        Quantity("height", "height of the top: error", "m", _height_error, within_a_millimetre),
        Quantity("drift", "drift of any box", "m", _sideways, within_a_millimetre),
        Quantity("speed", "speed in the last second", "m/s", _fastest, at_rest),
    ),
    curve=Curve("boxes=10", "Ten boxes: height of the top", "change of height, mm", _top_height),
    convergence=Convergence("boxes=5", "height"),
)

FAMILIES = (STACK,)
