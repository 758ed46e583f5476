from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solutions.meshes import (
    SpringMesh,
    cloth,
    diagonals,
    lattice,
    limit_strain,
    mesh_forces,
    mesh_sphere_contact,
    mesh_step,
    spring_mesh,
    timestep_bound,
    zero_energy_modes,
)

SEED = st.integers(0, 2**32 - 1)
FEW = settings(max_examples=settings.default.max_examples // 5)
"""For examples that each take some hundredths of a second."""


def shuffled(rng, pairs):
    """The same pairs in another order, some of them turned round."""
    return np.array([pair[:: rng.choice([-1, 1])] for pair in rng.permutation(pairs)])


@pytest.mark.statement(28, oracle="Maxwell's count; eigenvalues of the stiffness matrix")
@FEW
@given(SEED, st.integers(2, 3), st.integers(2, 3), st.integers(2, 3))
def test_a_lattice_needs_as_many_diagonals_as_it_has_lines_less_six(seed, nx, ny, nz):
    position, edges = lattice(nx, ny, nz, 0.1, ("structural",))
    candidates = shuffled(np.random.default_rng(seed), lattice(nx, ny, nz, 0.1, ("face", "space"))[1])
    needed = diagonals(position, edges, candidates)
    # Every line of nodes can slide along itself without stretching an edge; six of these motions are those of a body.
    assert np.count_nonzero(needed) == nx * ny + ny * nz + nz * nx - 6
    braced = spring_mesh(position, np.concatenate([edges, candidates[needed]]), 1.0)
    assert zero_energy_modes(braced, position) == 6


@given(SEED, st.integers(2, 4), st.integers(2, 4))
def test_what_is_needed_does_not_change_in_a_turned_and_larger_mesh(seed, rows, columns):
    rng = np.random.default_rng(seed)
    position, edges = cloth(rows, columns, 0.1, ("structural",))
    candidates = shuffled(rng, cloth(rows, columns, 0.1, ("shear", "bend"))[1]) if rows * columns > 4 else edges
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    moved = rng.uniform(0.1, 1e4) * position @ turn + rng.normal(size=3)
    assert np.array_equal(diagonals(position, edges, candidates), diagonals(moved, edges, candidates))


def test_all_springs_between_generic_places_are_needed_up_to_the_count():
    position = np.random.default_rng(5).normal(size=(6, 3))
    pairs = np.array([(i, j) for i in range(6) for j in range(i)])
    needed = diagonals(position, np.zeros((0, 2), dtype=int), pairs)
    assert np.count_nonzero(needed) == 3 * 6 - 6


def test_no_spring_of_zero_length_is_needed_and_impossible_ones_are_refused():
    position = [(0, 0, 0), (0, 0, 0), (1, 0, 0)]
    assert diagonals(position, [(0, 2)], [(0, 1), (1, 2)]).tolist() == [False, True]
    assert diagonals(position, [(0, 2)], []).tolist() == []
    with pytest.raises(ValueError, match="edges must join nodes from 0 to 2"):
        diagonals(position, [(0, 2)], [(0, 3)])


def test_a_plain_tuple_of_its_arrays_is_as_good_as_a_mesh():
    position, edges = cloth(2, 3, 0.1)
    mesh = spring_mesh(position, edges, 5.0, 0.1, 0.02, [0])
    velocity, far = np.ones_like(position), 1.5 * position
    for function, others in (
        (mesh_forces, (far, velocity)),
        (mesh_step, (far, velocity, (0, 0, -9.81), 0.01)),
        (mesh_sphere_contact, (far, velocity, (0, 0, 0), 0.2)),
        (limit_strain, (far,)),
        (timestep_bound, ()),
    ):
        assert np.array_equal(function(mesh, *others), function(tuple(mesh), *others))


def test_a_mesh_with_another_array_is_checked_again():
    mesh = SpringMesh([(0, 1)], 1.0, 5.0, 0.0, [1.0, 2.0], False)
    assert mesh._replace(stiffness=7.0).stiffness.tolist() == [7.0]
    assert mesh.stiffness.tolist() == [5.0]
    with pytest.raises(ValueError, match="mass must be positive, not 0"):
        mesh._replace(mass=[1.0, 0.0])
