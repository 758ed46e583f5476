"""One step of a cloth of 100 × 100 nodes and 59 002 springs: ours beside engines that take the very same springs."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from labs.benching.timing import Bench
from solutions.meshes import (
    SpringMesh,
    cloth,
    conjugate_gradient,
    edge_damping,
    edge_stiffness,
    mesh_step,
    spring_mesh,
)

SIDE, SPACING = 100, 0.01
STIFFNESS, DAMPING, MASS = 50.0, 0.01, 0.001
GRAVITY = (0.0, 0.0, -9.81)
SHORT, LONG = 1e-3, 1e-2
"""Timesteps, s: below the limit of 2.6 ms of the cloth, and above it."""


def scene() -> tuple[SpringMesh, np.ndarray, np.ndarray]:
    """The cloth, flat, with velocities of a tenth of a metre a second in all directions."""
    position, edges = cloth(SIDE, SIDE, SPACING)
    mesh = spring_mesh(position, edges, STIFFNESS, DAMPING, MASS)
    return mesh, position, 0.1 * np.random.default_rng(1).normal(size=position.shape)


def ours() -> Callable[[], object]:
    mesh, position, velocity = scene()
    return lambda: mesh_step(mesh, position, velocity, GRAVITY, SHORT)


def mujoco_flex() -> Callable[[], object]:
    """A flex of dimension 1: the same edges, each with stiffness and damping. A test finds the same motion."""
    import mujoco

    mesh, position, velocity = scene()
    points, edges = (" ".join(map(repr, array.ravel().tolist())) for array in (position, mesh.edges))
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><size memory="2G"/><option timestep="{SHORT}" gravity="0 0 -9.81"><flag contact="disable"/></option>'
        f'<worldbody><flexcomp name="cloth" type="direct" dim="1" mass="{MASS * SIDE**2}" radius="0.001" '
        f'point="{points}" element="{edges}"><edge stiffness="{STIFFNESS}" damping="{DAMPING}"/>'
        '<contact selfcollide="none" contype="0" conaffinity="0"/></flexcomp></worldbody></mujoco>'
    )
    state = mujoco.MjData(model)
    state.qvel[:] = velocity.ravel()
    return lambda: mujoco.mj_step(model, state)


def pymunk_springs() -> Callable[[], object]:
    """In two dimensions: two thirds of the numbers."""
    import pymunk  # noqa: PLC0415

    mesh, position, velocity = scene()
    space = pymunk.Space()
    space.gravity, space.iterations = (0.0, -9.81), 1
    bodies = [pymunk.Body(MASS, float("inf")) for _ in position]
    for body, place, speed in zip(bodies, position[:, :2].tolist(), velocity[:, :2].tolist(), strict=True):
        body.position, body.velocity = tuple(place), tuple(speed)
    space.add(*bodies)
    for (i, j), rest in zip(mesh.edges.tolist(), mesh.rest_length.tolist(), strict=True):
        space.add(pymunk.DampedSpring(bodies[i], bodies[j], (0, 0), (0, 0), rest, STIFFNESS, DAMPING))
    return lambda: space.step(SHORT)


def implicit_system() -> tuple[SpringMesh, np.ndarray, np.ndarray]:
    """The blocks dt C + dt² K of every edge in a crumpled cloth, and a right side."""
    mesh, position, velocity = scene()
    crumpled = position + 0.1 * SPACING * np.random.default_rng(2).normal(size=position.shape)
    return mesh, LONG * edge_damping(mesh, crumpled) + LONG**2 * edge_stiffness(mesh, crumpled), MASS * velocity


def ours_implicit() -> Callable[[], object]:
    mesh, blocks, right = implicit_system()
    return lambda: conjugate_gradient(mesh, blocks, right)


def scipy_matrix(mesh: SpringMesh, blocks: np.ndarray) -> object:
    from scipy import sparse  # noqa: PLC0415

    nodes, (first, second) = len(mesh.mass), mesh.edges.T
    rows, columns = np.concatenate([first, second, first, second]), np.concatenate([first, second, second, first])
    row, column = (3 * each[:, None, None] + np.arange(3) for each in (rows, columns))
    entries = np.concatenate([blocks, blocks, -blocks, -blocks])
    places = (
        np.broadcast_to(np.swapaxes(row, 1, 2), entries.shape).ravel(),
        np.broadcast_to(column, entries.shape).ravel(),
    )
    stiff = sparse.coo_matrix((entries.ravel(), places), shape=(3 * nodes, 3 * nodes))
    return (stiff + sparse.diags(np.repeat(mesh.mass, 3))).tocsr()


def scipy_cg() -> Callable[[], object]:
    from scipy.sparse.linalg import cg  # noqa: PLC0415

    mesh, blocks, right = implicit_system()
    return lambda: cg(scipy_matrix(mesh, blocks), right.ravel(), rtol=1e-8, atol=0.0)


def scipy_elimination() -> Callable[[], object]:
    from scipy.sparse.linalg import spsolve  # noqa: PLC0415

    mesh, blocks, right = implicit_system()
    return lambda: spsolve(scipy_matrix(mesh, blocks).tocsc(), right.ravel())


BENCHES = (
    Bench(
        "cloth-step",
        "one explicit step of a cloth of 100 × 100 nodes, 59 002 springs",
        ours,
        {"MuJoCo, flex of edges": mujoco_flex, "pymunk, in the plane": pymunk_springs},
        goal=0.01,
    ),
    Bench(
        "cloth-implicit",
        "the linear system of one implicit step of that cloth, 30 000 unknowns, to 1e-8",
        ours_implicit,
        {"scipy, matrix made and cg": scipy_cg, "scipy, matrix made and eliminated": scipy_elimination},
        goal=1.0,
    ),
)
