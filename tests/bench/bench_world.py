"""A pile of balls in an open box: a step of the engines, and how deep the balls lie in one another.

A step can be fast because little of the overlap is taken back. So the deepest overlap is shown beside the time. It is
computed here from the places of the balls; no engine is asked for it.
"""

from __future__ import annotations

import functools
import importlib
import math
from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

import numpy as np

from labs.benching.timing import Bench, Prepare, Watched
from solutions.avoidance import neighbour_pairs
from solutions.impulse import sphere_inertia
from solutions.world.bodies import State, make_bodies, make_state
from solutions.world.memory import NOTHING, Memory
from solutions.world.rules import Rules
from solutions.world.step import advance_world

BALLS, RADIUS, MASS = 666, 0.1, 1.0
SIDE = 2.5
WALLS = ((0, 0, 1), (1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0))
"""Normals into the box: of the floor, whose middle is the origin, and of four walls."""
FRICTION = 0.5
GRAVITY = 9.81
DT = 1 / 240
BY_HAND = Rules(sweeps=3, push_sweeps=1, tolerance=0.0)
FALLING, SETTLING, STEPS = 1440, 960, 200
"""Steps: in which the balls fall, in which each implementation settles its own pile, and which are timed."""


class Pile(NamedTuple):
    """Balls: position (n, 3) in m, orientation (n, 4) as w x y z, velocity (n, 3), angular velocity (n, 3)."""

    position: np.ndarray
    orientation: np.ndarray
    velocity: np.ndarray
    angular_velocity: np.ndarray


class World(NamedTuple):
    """An implementation with the balls in it.

    step: from one state to the next. pile: the balls of a state. An engine keeps its state to itself: it is None here.
    """

    state: Any
    step: Callable[[Any], Any]
    pile: Callable[[Any], Pile]


def deepest_overlap(position: np.ndarray) -> float:
    """How deep two balls, or a ball and a wall, overlap at most, m; 0 if none do. position: (n, 3), of the centres."""
    one, other = neighbour_pairs(position, 2 * RADIUS)
    between = 2 * RADIUS - np.linalg.norm(position[one] - position[other], axis=1)
    from_walls = position @ np.transpose(WALLS) - [wall_offset(normal) for normal in WALLS]
    return max(0.0, float(between.max(initial=0.0)), float(RADIUS - from_walls.min()))


def wall_offset(normal: tuple[int, int, int]) -> float:
    """Where a wall is along its normal, m."""
    return 0.0 if normal[2] else -SIDE / 2


def above_the_box() -> Pile:
    """Balls at rest in a lattice with random offsets, layer above layer, none of which touch."""
    rng = np.random.default_rng(666)
    across = 10
    layer, row, column = np.unravel_index(np.arange(BALLS), (math.ceil(BALLS / across**2), across, across))
    pitch = 2.4 * RADIUS
    lattice = np.stack([column - (across - 1) / 2, row - (across - 1) / 2, layer + 0.6], axis=1) * pitch
    at_rest = np.zeros((BALLS, 3))
    upright = np.tile([1.0, 0, 0, 0], (BALLS, 1))
    return Pile(lattice + rng.uniform(-0.19, 0.19, (BALLS, 3)) * RADIUS, upright, at_rest, at_rest)


@functools.cache
def settled() -> Pile:
    """The pile from which all start, dropped once a run in the first of the engines that is installed."""
    try:
        world = bullet(50, above_the_box())
    except ImportError:
        world = mujoco_cg("pyramidal", above_the_box())
    return world.pile(_after(world, FALLING))


def _after(world: World, steps: int) -> Any:
    state = world.state
    for _ in range(steps):
        state = world.step(state)
    return state


def stepping(world_of: Callable[[Pile], World]) -> Prepare:
    """One step a call, in a pile that has settled; the call returns what reads the centres after it."""

    def prepare() -> Callable[[], object]:
        world = world_of(settled())
        state = _after(world, SETTLING)

        def call() -> Callable[[], np.ndarray]:
            nonlocal state
            state = world.step(state)
            return lambda: world.pile(state).position

        return call

    return prepare


# Implementations


def by_hand(pile: Pile) -> World:
    """The hand-written world, with sweeps enough for less overlap than any of the engines leaves."""
    count, immovable = len(pile.position), [math.inf] * len(WALLS)
    moments = sphere_inertia(MASS, RADIUS)
    bodies = make_bodies(
        [*(("half-space", normal) for normal in WALLS), *[("sphere", RADIUS)] * count],
        [*immovable, *[MASS] * count],
        [*[[math.inf] * 3 for _ in WALLS], *[moments] * count],
        friction=FRICTION,
    )
    walls = np.array([wall_offset(normal) * np.array(normal, dtype=float) for normal in WALLS])
    none, upright = np.zeros_like(walls), np.tile([1.0, 0, 0, 0], (len(WALLS), 1))
    start = make_state(*(np.concatenate(both) for both in zip((walls, upright, none, none), pile, strict=True)))

    def step(state: tuple[State, Memory]) -> tuple[State, Memory]:
        after, memory, _ = advance_world(bodies, state[0], (0, 0, -GRAVITY), DT, BY_HAND, state[1])
        return after, memory

    def read(state: tuple[State, Memory]) -> Pile:
        return Pile(*(each[len(WALLS) :] for each in state[0]))

    return World((start, NOTHING), step, read)


def bullet(iterations: int, pile: Pile) -> World:
    """PyBullet in maximal coordinates and without sleeping; everything else is as Bullet has it."""
    b: Any = importlib.import_module("pybullet")
    here = {"physicsClientId": b.connect(b.DIRECT)}
    b.setGravity(0, 0, -GRAVITY, **here)
    b.setTimeStep(DT, **here)
    b.setPhysicsEngineParameter(numSolverIterations=iterations, deterministicOverlappingPairs=1, **here)
    surface = {"restitution": 0.0, "lateralFriction": math.sqrt(FRICTION)}  # of two bodies, Bullet multiplies them

    def add(mass: float, shape: int, position: np.ndarray, orientation: tuple[float, ...] = (0, 0, 0, 1)) -> int:
        number = b.createMultiBody(mass, shape, -1, position, orientation, useMaximalCoordinates=True, **here)
        b.changeDynamics(number, -1, activationState=b.ACTIVATION_STATE_DISABLE_SLEEPING, **surface, **here)
        return int(number)

    for normal in WALLS:
        plane = b.createCollisionShape(b.GEOM_PLANE, planeNormal=normal, **here)
        add(0, plane, wall_offset(normal) * np.array(normal))
    ball = b.createCollisionShape(b.GEOM_SPHERE, radius=RADIUS, **here)
    numbers = []
    for position, (w, x, y, z), velocity, spin in zip(*pile, strict=True):
        numbers.append(add(MASS, ball, position, (x, y, z, w)))
        b.resetBaseVelocity(numbers[-1], velocity.tolist(), spin.tolist(), **here)

    def step(state: None) -> None:
        b.stepSimulation(**here)

    def read(state: None) -> Pile:
        places = [b.getBasePositionAndOrientation(number, **here) for number in numbers]
        speeds = [b.getBaseVelocity(number, **here) for number in numbers]
        position, orientation, velocity, spin = map(np.array, (*zip(*places, strict=True), *zip(*speeds, strict=True)))
        return Pile(position, orientation[:, [3, 0, 1, 2]], velocity, spin)

    return World(None, step, read)


def mujoco_cg(cone: str, pile: Pile) -> World:
    """MuJoCo with the solver of conjugate gradients; everything else, its soft contact too, is as MuJoCo has it."""
    mujoco: Any = importlib.import_module("mujoco")
    places = [(_words(wall_offset(normal) * np.array(normal)), _words(normal)) for normal in WALLS]
    walls = "".join(f'<geom type="plane" size="0 0 1" pos="{place}" zaxis="{normal}"/>' for place, normal in places)
    ball = f'<body><freejoint/><geom size="{RADIUS}" mass="{MASS}"/></body>'
    model = mujoco.MjModel.from_xml_string(f"""
        <mujoco>
          <option timestep="{DT!r}" gravity="0 0 {-GRAVITY}" solver="CG" cone="{cone}"/>
          <default><geom type="sphere" friction="{FRICTION} 0 0"/></default>
          <worldbody>{walls}{ball * len(pile.position)}</worldbody>
        </mujoco>""")
    data = mujoco.MjData(model)
    data.qpos[:] = np.hstack([pile.position, pile.orientation]).ravel()
    mujoco.mj_kinematics(model, data)
    turned = data.xmat[1:].reshape(-1, 3, 3)  # MuJoCo has the spin along the axes of the ball; number 0 is the world
    data.qvel[:] = np.hstack([pile.velocity, np.vecmat(pile.angular_velocity, turned)]).ravel()

    def step(state: None) -> None:
        mujoco.mj_step(model, data)

    def read(state: None) -> Pile:
        place, speed = data.qpos.reshape(-1, 7), data.qvel.reshape(-1, 6)
        turn = np.empty((len(place), 9))
        for matrix, orientation in zip(turn, place[:, 3:], strict=True):
            mujoco.mju_quat2Mat(matrix, orientation)
        spin = np.matvec(turn.reshape(-1, 3, 3), speed[:, 3:])
        return Pile(place[:, :3].copy(), place[:, 3:].copy(), speed[:, :3].copy(), spin)

    return World(None, step, read)


def _words(vector: Iterable[float]) -> str:
    return " ".join(f"{float(each)!r}" for each in vector)


BENCHES = (
    Bench(
        "pile",
        f"a step of {DT * 1000:.2f} ms for a settled pile of {BALLS} balls with friction in an open box",
        stepping(by_hand),
        {
            "PyBullet, 10 iterations": stepping(functools.partial(bullet, 10)),
            "PyBullet, 50 iterations": stepping(functools.partial(bullet, 50)),
            "MuJoCo, CG, pyramidal cone": stepping(functools.partial(mujoco_cg, "pyramidal")),
            "MuJoCo, CG, elliptic cone": stepping(functools.partial(mujoco_cg, "elliptic")),
        },
        who="hand-written, 3 sweeps",
        repeats=STEPS,
        watched=Watched("deepest, mm", lambda read: 1000 * deepest_overlap(read())),
    ),
)
