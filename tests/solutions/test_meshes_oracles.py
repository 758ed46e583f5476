"""Spring meshes against what others compute: scipy, MuJoCo and pymunk."""

from __future__ import annotations

import numpy as np
import pytest
from oracles import oracle

from reference.engines import load_engine
from solutions.meshes import (
    cloth,
    edge_stiffness,
    implicit_mesh_step,
    largest_eigenvalue,
    lattice,
    mesh_energy,
    mesh_step,
    spring_mesh,
    static_shape,
)

GRAVITY = (0.0, 0.0, -9.81)


def pulls(mesh, position, velocity):
    """Forces in other words than ours: end by end, with whole matrices of incidence."""
    incidence = np.zeros((len(mesh.edges), len(mesh.mass)))
    incidence[np.arange(len(mesh.edges)), mesh.edges[:, 0]] = 1
    incidence[np.arange(len(mesh.edges)), mesh.edges[:, 1]] = -1
    between, rate = incidence @ position, incidence @ velocity
    length = np.linalg.norm(between, axis=1, keepdims=True)
    tension = mesh.stiffness[:, None] * (length - mesh.rest_length[:, None])
    tension = tension + mesh.damping[:, None] * np.sum(rate * between, axis=1, keepdims=True) / length
    return -incidence.T @ (tension * between / length)


def small_cloth(damping, mass=0.1):
    """A cloth of four by four on two pins, with a push that takes it out of its plane and symmetry."""
    position, edges = cloth(4, 4, 0.1)
    mesh = spring_mesh(position, edges, 40.0, damping, mass, [0, 3])
    velocity = np.where(mesh.pinned[:, None], 0, 0.5 * np.random.default_rng(21).normal(size=position.shape))
    return mesh, position, velocity


def run(move, mesh, position, velocity, dt, count):
    for _ in range(count):
        position, velocity = move(mesh, position, velocity, GRAVITY, dt)
    return position, velocity


@pytest.mark.statement(28, oracle="scipy's solve_ivp")
@pytest.mark.statement(29, oracle="scipy's solve_ivp")
@pytest.mark.parametrize("move", [mesh_step, implicit_mesh_step])
def test_both_steps_converge_on_the_differential_equation_in_first_order(move):
    integrate = oracle("scipy.integrate")
    mesh, position, velocity = small_cloth(0.05)
    free = ~mesh.pinned[:, None]

    def rates(_, state):
        p, v = state.reshape(2, 16, 3)
        return np.concatenate([v, np.where(free, pulls(mesh, p, v) / mesh.mass[:, None] + GRAVITY, 0)]).ravel()

    start, time = np.concatenate([position, velocity]).ravel(), 0.25
    true = integrate.solve_ivp(rates, (0, time), start, method="DOP853", rtol=1e-11, atol=1e-12).y[:, -1]
    found = [run(move, mesh, position, velocity, time / count, count)[0] for count in (250, 500)]
    error = [np.abs(p - true[:48].reshape(16, 3)).max() for p in found]
    assert error[0] < 5e-3  # half a millisecond at some 5 m/s²·s, more where the implicit step damps
    assert error[1] / error[0] == pytest.approx(0.5, abs=0.05)  # first order, and a twentieth of the second
    # Extrapolated to no timestep at all: the second order is left, some (ω dt)² with ω² up to 24 k/m = 1e4
    assert 2 * found[1] - found[0] == pytest.approx(true[:48].reshape(16, 3), abs=2e-4)


@pytest.mark.statement(28, oracle="scipy's sparse eigensolver")
@pytest.mark.parametrize("make", [lambda: cloth(10, 10, 1.0), lambda: lattice(4, 4, 4, 1.0)])
def test_the_largest_eigenvalue_is_the_one_that_arpack_finds(make):
    sparse = oracle("scipy.sparse")
    linalg = oracle("scipy.sparse.linalg")
    position, edges = make()
    rng = np.random.default_rng(22)
    mesh = spring_mesh(
        position, edges, rng.uniform(1, 10, len(edges)), mass=rng.uniform(1, 2, len(position)), pinned=[1]
    )
    free = np.repeat(~mesh.pinned, 3)
    rows = sparse.lil_matrix((len(edges), 3 * len(position)))  # how a motion of the nodes changes every length
    for row, (i, j) in enumerate(edges):
        u = (position[i] - position[j]) / np.linalg.norm(position[i] - position[j])
        rows[row, 3 * i : 3 * i + 3], rows[row, 3 * j : 3 * j + 3] = u, -u
    rows = rows.tocsr()[:, free]
    weights = sparse.diags(np.repeat(mesh.mass, 3)[free] ** -0.5)
    matrix = weights @ rows.T @ sparse.diags(mesh.stiffness) @ rows @ weights
    exact = linalg.eigsh(matrix, k=1, which="LA", return_eigenvectors=False)[0]
    assert largest_eigenvalue(mesh, position) == pytest.approx(exact, rel=1e-4)  # the power iteration's tolerance


@pytest.mark.statement(28, oracle="scipy's root finder on backward Euler itself")
def test_the_linearised_implicit_step_is_backward_euler_to_third_order():
    optimize = oracle("scipy.optimize")
    mesh, position, velocity = small_cloth(0.0)
    position = 1.2 * position  # taut, so that nothing is clamped
    free = ~mesh.pinned
    error = []
    for dt in (0.004, 0.002):

        def left(change, dt=dt):
            v = velocity.copy()
            v[free] += change.reshape(-1, 3)
            force = pulls(mesh, position + dt * v, v) + mesh.mass[:, None] * GRAVITY
            return (mesh.mass[:, None] * (v - velocity) - dt * force)[free].ravel()

        exact = optimize.root(left, np.zeros(3 * free.sum()), tol=1e-13).x.reshape(-1, 3)
        found = implicit_mesh_step(mesh, position, velocity, GRAVITY, dt, tolerance=1e-12)[1] - velocity
        error.append(np.abs(found[free] - exact).max())
    assert edge_stiffness(mesh, position) == pytest.approx(edge_stiffness(mesh, position, clamped=False))
    assert error[0] < 1e-3
    assert error[0] / error[1] == pytest.approx(8, rel=0.25)  # dt (dt v)² times the force's second derivative


@pytest.mark.statement(28, oracle="scipy's minimiser of the energy")
def test_the_shape_at_rest_has_the_least_energy_that_scipy_finds():
    optimize = oracle("scipy.optimize")
    mesh, position, _ = small_cloth(0.0)
    free = ~mesh.pinned
    shape = static_shape(mesh, position, GRAVITY, 1e-10)

    def energy(places):
        p = shape.copy()
        p[free] = places.reshape(-1, 3)
        weight = 9.81 * np.sum(mesh.mass[free] * p[free, 2])
        slope = -pulls(mesh, p, np.zeros_like(p)) - mesh.mass[:, None] * GRAVITY
        length = np.linalg.norm(p[mesh.edges[:, 0]] - p[mesh.edges[:, 1]], axis=1)
        stored = np.sum(mesh.stiffness * (length - mesh.rest_length) ** 2) / 2
        return stored + weight, slope[free].ravel()

    start = position[free] - (0, 0, 0.05)
    found = optimize.minimize(energy, start.ravel(), jac=True, method="BFGS", options={"gtol": 1e-9, "maxiter": 5000})
    # BFGS ends where rounding of the energy, 1e-16 J, hides a gain: √(2e-16/40) m or so, many times over in soft ways
    assert found.x.reshape(-1, 3) == pytest.approx(shape[free], abs=1e-5)
    assert energy(shape[free].ravel())[0] == pytest.approx(found.fun, abs=1e-10)
    assert mesh_energy(mesh, shape) - 9.81 * -np.sum(mesh.mass[free] * shape[free, 2]) == pytest.approx(
        found.fun, abs=1e-10
    )


def mujoco_model(module, mesh, position, dt):
    """The mesh in MuJoCo: point masses on three sliders each, and a spatial tendon for every spring."""
    bodies, tendons = [], []
    for node, place in enumerate(position):
        axes = ("1 0 0", "0 1 0", "0 0 1")
        joints = "" if mesh.pinned[node] else "".join(f'<joint type="slide" axis="{axis}"/>' for axis in axes)
        bodies.append(
            f'<body pos="{" ".join(map(repr, map(float, place)))}">{joints}<site name="s{node}"/>'
            f'<inertial pos="0 0 0" mass="{mesh.mass[node]!r}" diaginertia="1e-3 1e-3 1e-3"/></body>'
        )
    for (i, j), rest, k, c in zip(mesh.edges, mesh.rest_length, mesh.stiffness, mesh.damping, strict=True):
        tendons.append(
            f'<spatial springlength="{float(rest)!r}" stiffness="{float(k)!r}" damping="{float(c)!r}">'
            f'<site site="s{i}"/><site site="s{j}"/></spatial>'
        )
    text = (
        f'<mujoco><option timestep="{dt}" integrator="Euler" gravity="0 0 -9.81"/>'
        f"<worldbody>{''.join(bodies)}</worldbody><tendon>{''.join(tendons)}</tendon></mujoco>"
    )
    return module.MjModel.from_xml_string(text.replace("np.float64(", "").replace(')"', '"'))


@pytest.mark.statement(28, oracle="MuJoCo, point masses and tendons")
@pytest.mark.statement(29, oracle="MuJoCo, point masses and tendons")
@pytest.mark.parametrize("damping", [0.0, 0.05])
def test_a_cloth_moves_for_a_second_as_mujocos_tendons_move_it(damping, installed):
    installed("mujoco")
    mujoco = load_engine("mujoco").module()
    mesh, position, velocity = small_cloth(damping)
    dt, count = 1e-3, 1000
    model = mujoco_model(mujoco, mesh, position, dt)
    scene = mujoco.MjData(model)
    scene.qvel[:] = velocity[~mesh.pinned].ravel()
    for _ in range(count):
        mujoco.mj_step(model, scene)
    p, v = run(mesh_step, mesh, position, velocity, dt, count)
    theirs = position[~mesh.pinned] + scene.qpos.reshape(-1, 3)
    # The same step in other words: a thousand roundings of 1e-16 m, and of some 1e-14 m/s
    assert p[~mesh.pinned] == pytest.approx(theirs, abs=1e-12)
    assert v[~mesh.pinned] == pytest.approx(scene.qvel.reshape(-1, 3), abs=1e-11)


@pytest.mark.statement(28, oracle="MuJoCo, a flex of edges")
@pytest.mark.statement(29, oracle="MuJoCo, a flex of edges")
def test_a_solid_flies_and_wobbles_as_mujocos_flex_of_the_same_edges(installed):
    installed("mujoco")
    mujoco = load_engine("mujoco").module()
    position, edges = lattice(3, 3, 3, 0.1)
    mesh = spring_mesh(position, edges, 50.0, 0.05, 0.02)
    velocity = np.random.default_rng(24).normal(size=position.shape)
    points, ends = (" ".join(map(repr, array.ravel().tolist())) for array in (position, edges))
    model = mujoco.MjModel.from_xml_string(
        '<mujoco><option timestep="1e-3" gravity="0 0 -9.81"><flag contact="disable"/></option><worldbody>'
        f'<flexcomp name="solid" type="direct" dim="1" mass="{27 * 0.02}" point="{points}" element="{ends}">'
        '<edge stiffness="50" damping="0.05"/><contact selfcollide="none"/></flexcomp></worldbody></mujoco>'
    )
    scene = mujoco.MjData(model)
    scene.qvel[:] = velocity.ravel()
    for _ in range(1000):
        mujoco.mj_step(model, scene)
    p, _ = run(mesh_step, mesh, position, velocity, 1e-3, 1000)
    # The same step: roundings alone, 1e-16 of the 5 m it falls, and MuJoCo keeps its masses to some digits less
    assert p - position == pytest.approx(scene.qpos.reshape(-1, 3), abs=1e-11)


def pymunk_paths(mesh, position, velocity, dt, count):
    """Positions after `count` steps of pymunk, whose step moves first and pushes then."""
    pymunk = oracle("pymunk")
    space = pymunk.Space()
    space.gravity = (0.0, -9.81)
    space.iterations = 1
    bodies = []
    for node, place in enumerate(position):
        kind = pymunk.Body.STATIC if mesh.pinned[node] else pymunk.Body.DYNAMIC
        body = pymunk.Body(float(mesh.mass[node]), float("inf"), kind)
        body.position, body.velocity = tuple(map(float, place[[0, 2]])), tuple(map(float, velocity[node, [0, 2]]))
        bodies.append(body)
    space.add(*bodies)
    for (i, j), rest, k, c in zip(mesh.edges, mesh.rest_length, mesh.stiffness, mesh.damping, strict=True):
        space.add(pymunk.DampedSpring(bodies[i], bodies[j], (0, 0), (0, 0), float(rest), float(k), float(c)))
    for _ in range(count):
        space.step(dt)
    found = np.zeros_like(position)
    found[:, [0, 2]] = [body.position for body in bodies]
    return found


def upright_cloth(damping):
    position, edges = cloth(4, 4, 0.1)
    position = position[:, [0, 2, 1]]  # in the plane of x and z, as pymunk has two dimensions
    mesh = spring_mesh(position, edges, 40.0, damping, 0.1, [12, 15])
    velocity = np.where(
        mesh.pinned[:, None], 0, 0.3 * np.random.default_rng(23).normal(size=position.shape) * (1, 0, 1)
    )
    return mesh, position, velocity


@pytest.mark.statement(28, oracle="pymunk's DampedSpring")
def test_an_undamped_cloth_in_the_plane_moves_as_pymunks_springs_move_it():
    mesh, position, velocity = upright_cloth(0.0)
    dt, count = 1e-3, 500
    theirs = pymunk_paths(mesh, position, velocity, dt, count)
    # pymunk moves first: our step from where its first move leads, one move less
    ours, _ = run(mesh_step, mesh, position + dt * velocity, velocity, dt, count - 1)
    assert ours == pytest.approx(theirs, abs=1e-12)  # rounding of some hundred steps


@pytest.mark.statement(29, oracle="pymunk's DampedSpring")
def test_a_damped_cloth_converges_on_the_motion_of_pymunks_dampers():
    # pymunk takes 1 − exp(−c dt Σ1/m) of a spring's own rate, one spring after another: the same to first order
    mesh, position, velocity = upright_cloth(0.2)
    apart = []
    for dt, count in ((1e-3, 300), (2.5e-4, 1200)):
        theirs = pymunk_paths(mesh, position, velocity, dt, count)
        ours, _ = run(mesh_step, mesh, position + dt * velocity, velocity, dt, count - 1)
        apart.append(np.abs(ours - theirs).max())
    assert apart[0] < 3e-4  # a fifth of a millimetre, as measured, and a half more
    assert apart[0] / apart[1] == pytest.approx(4, rel=0.1)
