from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from solutions.meshes import (
    SpringMesh,
    cloth,
    edge_damping,
    edge_directions,
    edge_stiffness,
    edge_strain,
    lattice,
    mesh_energy,
    mesh_forces,
    mesh_matrix,
    mesh_product,
    spring_mesh,
)

ROUNDING = 1e-11
"""Some hundred roundings of forces up to 100 N/m × 10 m."""
SEED = st.integers(0, 2**32 - 1)


def any_mesh(seed, nodes=6, edges=12):
    """A mesh of random springs between random nodes, with a state that is not at rest."""
    rng = np.random.default_rng(seed)
    ends = np.array([rng.choice(nodes, 2, replace=False) for _ in range(edges)])
    rest, stiffness, damping = rng.uniform(0, [[2.0], [100.0], [5.0]], (3, edges))
    mesh = SpringMesh(ends, rest, stiffness, damping, rng.uniform(0.1, 2, nodes), rng.random(nodes) < 0.2)
    return mesh, rng.normal(size=(nodes, 3)), rng.normal(size=(nodes, 3)), rng


def one_spring(x1, x2, v1, v2, stiffness, damping, rest_length):
    """The force on end 1, word by word from the statement, for one spring."""
    length = sum((a - b) ** 2 for a, b in zip(x1, x2, strict=True)) ** 0.5
    if length == 0:
        return np.zeros(3)
    u = [(a - b) / length for a, b in zip(x1, x2, strict=True)]
    rate = sum((a - b) * c for a, b, c in zip(v1, v2, u, strict=True))
    return np.array([(-stiffness * (length - rest_length) - damping * rate) * c for c in u])


def spring_by_spring(mesh, position, velocity):
    force = np.zeros_like(position)
    for (i, j), rest, k, c in zip(mesh.edges, mesh.rest_length, mesh.stiffness, mesh.damping, strict=True):
        on_i = one_spring(position[i], position[j], velocity[i], velocity[j], k, c, rest)
        force[i] += on_i
        force[j] -= on_i
    return force


def turn(rng):
    """A random rotation."""
    q, r = np.linalg.qr(rng.normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return q * np.linalg.det(q)


# Forces


@pytest.mark.statement(29, oracle="the formula spring by spring")
@given(SEED)
def test_the_force_on_every_node_is_the_sum_over_its_springs(seed):
    mesh, position, velocity, _ = any_mesh(seed)
    assert mesh_forces(mesh, position, velocity) == pytest.approx(
        spring_by_spring(mesh, position, velocity), abs=ROUNDING
    )


@pytest.mark.statement(28, oracle="by hand")
def test_a_stretched_spring_pulls_its_ends_together():
    mesh = spring_mesh([(0, 0, 0), (2, 0, 0)], [(0, 1)], 10.0)
    at_rest = np.zeros((2, 3))
    assert mesh_forces(mesh, [(0, 0, 0), (2.5, 0, 0)], at_rest).tolist() == [[5, 0, 0], [-5, 0, 0]]
    assert mesh_forces(mesh, [(0, 0, 0), (1.5, 0, 0)], at_rest).tolist() == [[-5, 0, 0], [5, 0, 0]]
    assert not mesh_forces(mesh, [(0, 0, 0), (0, 2, 0)], at_rest).any()


@pytest.mark.statement(29, oracle="by hand")
def test_a_damper_resists_only_what_changes_the_length():
    mesh = spring_mesh([(0, 0, 0), (1, 0, 0)], [(0, 1)], 0.0, 3.0)
    position = [(0, 0, 0), (1, 0, 0)]
    assert mesh_forces(mesh, position, [(0, 0, 0), (2, 5, 7)]).tolist() == [[6, 0, 0], [-6, 0, 0]]
    assert not mesh_forces(mesh, position, [(0, -1, 0), (0, 1, 3)]).any()


@given(SEED)
def test_springs_and_dampers_add_no_momentum_and_no_angular_momentum(seed):
    mesh, position, velocity, _ = any_mesh(seed)
    force = mesh_forces(mesh, position, velocity)
    assert force.sum(axis=0) == pytest.approx(np.zeros(3), abs=ROUNDING)
    assert np.cross(position, force).sum(axis=0) == pytest.approx(np.zeros(3), abs=ROUNDING)


@given(SEED)
def test_a_mesh_that_moves_and_turns_as_one_piece_feels_no_damper(seed):
    mesh, position, _, rng = any_mesh(seed)
    v, omega = rng.normal(size=(2, 3))
    moving = mesh_forces(mesh, position, v + np.cross(omega, position))
    assert moving == pytest.approx(mesh_forces(mesh, position, np.zeros_like(position)), abs=ROUNDING)


@given(SEED)
def test_dampers_never_add_energy(seed):
    mesh, position, velocity, _ = any_mesh(seed)
    damping = mesh_forces(mesh, position, velocity) - mesh_forces(mesh, position, np.zeros_like(velocity))
    assert np.sum(damping * velocity) <= ROUNDING


@given(SEED)
def test_the_scene_can_be_moved_and_turned_as_a_whole(seed):
    mesh, position, velocity, rng = any_mesh(seed)
    q, shift, boost = turn(rng), *rng.normal(size=(2, 3))
    force = mesh_forces(mesh, position, velocity)
    assert mesh_forces(mesh, position @ q.T + shift, velocity @ q.T + boost) == pytest.approx(force @ q.T, abs=ROUNDING)
    assert mesh_energy(mesh, position @ q.T + shift) == pytest.approx(mesh_energy(mesh, position), rel=1e-12)


@given(SEED)
def test_renumbering_nodes_or_reversing_edges_changes_no_force(seed):
    mesh, position, velocity, rng = any_mesh(seed)
    name, order = rng.permutation(6), rng.permutation(12)
    swapped = np.where(rng.random((12, 1)) < 0.5, mesh.edges, mesh.edges[:, ::-1])
    where = np.argsort(name)  # which node got that name
    springs = (array[order] for array in (mesh.rest_length, mesh.stiffness, mesh.damping))
    other = SpringMesh(name[swapped][order], *springs, mesh.mass[where], mesh.pinned[where])
    found = mesh_forces(other, position[where], velocity[where])
    assert found[name] == pytest.approx(mesh_forces(mesh, position, velocity), abs=ROUNDING)


@given(SEED)
def test_the_force_on_a_pinned_node_is_the_pull_of_its_springs(seed):
    mesh, position, velocity, _ = any_mesh(seed)
    free = SpringMesh(mesh.edges, mesh.rest_length, mesh.stiffness, mesh.damping, mesh.mass, np.zeros(6, dtype=bool))
    assert np.array_equal(mesh_forces(mesh, position, velocity), mesh_forces(free, position, velocity))


def test_an_edge_of_no_length_has_no_direction_and_no_force():
    mesh = SpringMesh([(0, 1)], 1.0, 10.0, 1.0, np.ones(2), False)
    together = np.ones((2, 3))
    u, length = edge_directions(mesh, together)
    assert u.tolist() == [[0, 0, 0]]
    assert length.tolist() == [0]
    assert not mesh_forces(mesh, together, [(1, 0, 0), (0, 0, 0)]).any()
    assert mesh_energy(mesh, together) == 5.0
    assert edge_strain(mesh, together).tolist() == [-1]


def test_a_spring_of_no_rest_length_obeys_hooke_and_has_no_strain():
    mesh = SpringMesh([(0, 1)], 0.0, 10.0, 0.0, np.ones(2), False)
    assert mesh_forces(mesh, [(3, 4, 0), (0, 0, 0)], np.zeros((2, 3)))[0] == pytest.approx([-30, -40, 0])
    assert edge_strain(mesh, [(3, 4, 0), (0, 0, 0)]).tolist() == [0]


def test_the_direction_of_an_edge_is_from_its_second_end_to_its_first():
    mesh = spring_mesh([(0, 0, 0), (0, 3, 4)], [(1, 0)], 1.0)
    u, length = edge_directions(mesh, [(0, 0, 0), (0, 3, 4)])
    assert u == pytest.approx(np.array([[0, 0.6, 0.8]]))
    assert length.tolist() == [5]


def test_a_mesh_without_springs_has_no_force_and_no_energy():
    mesh = spring_mesh(*cloth(1, 1, 1.0), 1.0)
    assert mesh_forces(mesh, np.ones((1, 3)), np.ones((1, 3))).tolist() == [[0, 0, 0]]
    assert mesh_energy(mesh, np.ones((1, 3))) == 0
    assert mesh_matrix(mesh, edge_stiffness(mesh, np.ones((1, 3)))).tolist() == np.zeros((3, 3)).tolist()


# Force, energy and stiffness belong together


@given(SEED)
def test_the_force_is_the_slope_of_the_energy(seed):
    mesh, position, _, _ = any_mesh(seed)
    force, h = mesh_forces(mesh, position, np.zeros_like(position)), 1e-5
    steps = h * np.eye(18).reshape(18, 6, 3)
    slope = (mesh_energy(mesh, position + steps) - mesh_energy(mesh, position - steps)) / (2 * h)
    # Differences: the energy's third derivative, up to k/L² ~ 1e4 at the shortest edges, times h²; and 1e-13 J/h
    assert -slope.reshape(6, 3) == pytest.approx(force, rel=1e-5, abs=1e-5)


@given(SEED)
def test_the_stiffness_that_is_not_clamped_is_the_slope_of_the_force(seed):
    mesh, position, _, _ = any_mesh(seed)
    h = 1e-6
    steps = h * np.eye(18).reshape(18, 6, 3)
    there, back = (mesh_forces(mesh, position + sign * steps, np.zeros_like(position)) for sign in (1, -1))
    slope = (there - back).reshape(18, 18) / (2 * h)
    # As above one derivative on: h² times up to 1e6 N/m³ at the shortest edges, and the rounding 1e-13 N/h
    assert mesh_matrix(mesh, edge_stiffness(mesh, position, clamped=False)) == pytest.approx(-slope, rel=1e-4, abs=1e-4)


@given(SEED)
def test_the_damping_matrix_is_the_slope_of_the_force_by_velocity(seed):
    mesh, position, velocity, _ = any_mesh(seed)
    steps = np.eye(18).reshape(18, 6, 3)  # the force is linear in the velocity: a step of any size
    slope = mesh_forces(mesh, position, velocity + steps) - mesh_forces(mesh, position, velocity)
    assert mesh_matrix(mesh, edge_damping(mesh, position)) == pytest.approx(-slope.reshape(18, 18), abs=ROUNDING)


@given(SEED)
def test_the_product_edge_by_edge_is_that_of_the_whole_matrix(seed):
    mesh, position, velocity, _ = any_mesh(seed)
    blocks = edge_stiffness(mesh, position) + edge_damping(mesh, position)
    whole = mesh_matrix(mesh, blocks) @ velocity.ravel()
    assert mesh_product(mesh, blocks, velocity).ravel() == pytest.approx(whole, abs=ROUNDING)


def test_the_product_is_right_for_blocks_that_are_not_symmetric():
    mesh, _, vector, rng = any_mesh(1)
    blocks = rng.normal(size=(12, 3, 3))
    assert mesh_product(mesh, blocks, vector).ravel() == pytest.approx(mesh_matrix(mesh, blocks) @ vector.ravel())
    one = spring_mesh([(0, 0, 0), (1, 0, 0)], [(0, 1)], 1.0)
    turned = mesh_product(one, [[(0, 1, 0), (0, 0, 0), (0, 0, 0)]], [(0, 5, 0), (0, 0, 0)])
    assert turned.tolist() == [[5, 0, 0], [-5, 0, 0]]


def test_a_shortened_spring_buckles_except_with_clamped_stiffness():
    # Half its length: g = 1 − L0/L = −1, so a push sideways grows with 10 N/m where the clamp says 0
    mesh = SpringMesh([(0, 1)], 1.0, 10.0, 0.0, np.ones(2), False)
    position = [(0, 0, 0), (0.5, 0, 0)]
    assert edge_stiffness(mesh, position, clamped=False)[0].tolist() == np.diag([10.0, -10, -10]).tolist()
    assert edge_stiffness(mesh, position)[0].tolist() == np.diag([10.0, 0, 0]).tolist()
    aside = mesh_forces(mesh, [(0, 0, 0), (0.5, 0.001, 0)], np.zeros((2, 3)))
    assert aside[1, 1] == pytest.approx(0.01, rel=1e-5)  # away from the line: 10 N/m × 1 mm, less terms of (0.001/0.5)²


def test_a_taut_spring_resists_sideways_by_its_tension_over_its_length():
    mesh = SpringMesh([(0, 1)], 1.0, 10.0, 0.0, np.ones(2), False)
    found = edge_stiffness(mesh, [(0, 0, 0), (0, 0, 2)])[0]  # tension 10 N over 2 m
    assert found.tolist() == np.diag([5.0, 5, 10]).tolist()


@pytest.mark.parametrize(("rest_length", "stiffness"), [(0.0, 10.0), (1.0, 0.0)])
def test_at_no_length_only_a_spring_of_no_rest_length_is_stiff(rest_length, stiffness):
    mesh = SpringMesh([(0, 1)], rest_length, 10.0, 1.0, np.ones(2), False)
    for clamped in (True, False):
        assert edge_stiffness(mesh, np.zeros((2, 3)), clamped)[0].tolist() == (stiffness * np.eye(3)).tolist()
    assert not edge_damping(mesh, np.zeros((2, 3))).any()


@given(SEED)
def test_the_clamped_stiffness_has_no_negative_eigenvalue(seed):
    mesh, position, _, _ = any_mesh(seed)
    assert np.linalg.eigvalsh(mesh_matrix(mesh, edge_stiffness(mesh, position)))[0] > -ROUNDING
    assert np.linalg.eigvalsh(mesh_matrix(mesh, edge_damping(mesh, position)))[0] > -ROUNDING


# One is many, and what does not fit is refused


def test_many_shapes_at_once_are_the_same_as_one_after_another():
    rng = np.random.default_rng(5)
    mesh = spring_mesh(*lattice(2, 2, 2, 1.0), 10.0, 1.0)
    p, v = rng.normal(size=(2, 4, 5, 8, 3))
    calls = (
        lambda p, v: mesh_forces(mesh, p, v),
        lambda p, v: mesh_energy(mesh, p),
        lambda p, v: edge_strain(mesh, p),
        lambda p, v: mesh_product(mesh, edge_stiffness(mesh, p), v),
        lambda p, v: mesh_matrix(mesh, edge_stiffness(mesh, p, clamped=False)),
        lambda p, v: mesh_matrix(mesh, edge_damping(mesh, p)),
    )
    for call in calls:
        together = call(p, v)
        for at in np.ndindex(4, 5):
            assert together[at] == pytest.approx(call(p[at], v[at]), rel=1e-13, abs=1e-13)


def test_one_velocity_serves_for_many_positions():
    mesh = spring_mesh(*cloth(2, 2, 1.0), 10.0, 1.0)
    positions = np.random.default_rng(6).normal(size=(3, 4, 3))
    together = mesh_forces(mesh, positions, np.zeros((4, 3)))
    assert together.shape == (3, 4, 3)
    assert np.array_equal(together[1], mesh_forces(mesh, positions[1], np.zeros((4, 3))))


@pytest.mark.parametrize("call", [mesh_forces, lambda mesh, p, v: mesh_product(mesh, edge_stiffness(mesh, p), v)])
def test_forces_change_none_of_the_inputs(call):
    mesh, position, velocity, _ = any_mesh(3)
    position.flags.writeable = velocity.flags.writeable = False
    call(mesh, position, velocity)


@pytest.mark.parametrize(
    ("position", "velocity"), [((4, 3), (3, 3)), ((3, 3), (4, 3)), ((4, 2), (4, 3)), ((3,), (4, 3))]
)
def test_arrays_of_another_mesh_are_refused(position, velocity):
    mesh = spring_mesh(*cloth(2, 2, 1.0), 1.0)
    with pytest.raises(ValueError, match=r"must have the shape \(\.\.\., 4, 3\)"):
        mesh_forces(mesh, np.zeros(position), np.zeros(velocity))
