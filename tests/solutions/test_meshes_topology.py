from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from solutions.meshes import (
    SpringMesh,
    cloth,
    edge_strain,
    lattice,
    mesh_energy,
    pin,
    spring_mesh,
)

SIZE = st.integers(1, 5)


def as_pairs(edges):
    return sorted(tuple(sorted(edge)) for edge in np.asarray(edges).tolist())


def at_distance(position, length):
    """All pairs of nodes that are this length apart, by looking at every pair."""
    pairs = np.array(list(itertools.combinations(range(len(position)), 2)), dtype=int).reshape(-1, 2)
    between = np.linalg.norm(position[pairs[:, 0]] - position[pairs[:, 1]], axis=1)
    return as_pairs(pairs[np.isclose(between, length)])


# Cloth and lattice: every kind of spring is known by its length


@given(SIZE, SIZE, st.sampled_from([("structural", 1.0), ("shear", np.sqrt(2)), ("bend", 2.0)]))
def test_each_kind_of_spring_of_a_cloth_joins_nodes_its_length_apart(rows, columns, kind_length):
    kind, length = kind_length
    position, edges = cloth(rows, columns, 0.5, {kind})
    assert as_pairs(edges) == at_distance(position, 0.5 * length)


@given(SIZE, SIZE, SIZE, st.sampled_from([("structural", 1), ("face", 2), ("space", 3)]))
def test_each_kind_of_spring_of_a_lattice_joins_nodes_its_length_apart(nx, ny, nz, kind_square):
    kind, square = kind_square
    position, edges = lattice(nx, ny, nz, 0.5, {kind})
    assert as_pairs(edges) == at_distance(position, 0.5 * np.sqrt(square))


def test_a_cloth_lies_in_rows_along_x_and_columns_along_y():
    position, edges = cloth(2, 3, 0.5)
    assert position.tolist() == [[0, 0, 0], [0.5, 0, 0], [1, 0, 0], [0, 0.5, 0], [0.5, 0.5, 0], [1, 0.5, 0]]
    assert edges.tolist() == [
        *[[0, 1], [1, 2], [3, 4], [4, 5], [0, 3], [1, 4], [2, 5]],
        *[[0, 4], [1, 5], [1, 3], [2, 4]],
        [0, 2],
        [3, 5],
    ]


def test_a_lattice_is_numbered_with_z_fastest():
    position, _ = lattice(2, 2, 3, 0.1)
    assert position[[1, 3, 6]].tolist() == [[0, 0, 0.1], [0, 0.1, 0], [0.1, 0, 0]]


def test_a_cube_has_twelve_edges_and_sixteen_diagonals():
    assert [len(lattice(2, 2, 2, 1.0, {kind})[1]) for kind in ("structural", "face", "space")] == [12, 12, 4]
    assert len(lattice(2, 2, 2, 1.0)[1]) == 28


@given(SIZE, SIZE)
def test_the_order_of_kinds_does_not_matter_and_all_are_the_default(rows, columns):
    _, edges = cloth(rows, columns, 1.0, ["bend", "shear", "structural"])
    assert np.array_equal(edges, cloth(rows, columns, 1.0)[1])
    assert len(set(as_pairs(edges))) == len(edges)


def test_a_single_node_is_a_cloth_without_springs():
    position, edges = cloth(1, 1, 1.0)
    assert position.tolist() == [[0, 0, 0]]
    assert edges.shape == (0, 2)
    assert cloth(3, 3, 1.0, ())[1].shape == (0, 2)


@pytest.mark.parametrize(
    ("make", "arguments", "complaint"),
    [
        (cloth, (0, 3, 1.0), "rows must be at least 1, not 0"),
        (cloth, (3, -1, 1.0), "columns must be at least 1, not -1"),
        (cloth, (3, 3, 0.0), "spacing must be positive, not 0"),
        (cloth, (3, 3, 1.0, ("structural", "face")), "structural, shear, bend, not 'face'"),
        (lattice, (2, 2, 0, 1.0), "nz must be at least 1, not 0"),
        (lattice, (2, 2, 2, float("nan")), "spacing must be positive, not nan"),
        (lattice, (2, 2, 2, 1.0, ("shear",)), "structural, face, space, not 'shear'"),
    ],
)
def test_an_impossible_cloth_is_refused(make, arguments, complaint):
    with pytest.raises(ValueError, match=complaint):
        make(*arguments)


# The mesh


@given(st.integers(0, 2**32 - 1))
def test_a_mesh_is_at_rest_in_the_shape_that_it_is_made_in(seed):
    position = np.random.default_rng(seed).normal(size=(8, 3))
    mesh = spring_mesh(position, lattice(2, 2, 2, 1.0)[1], 100.0)
    assert mesh_energy(mesh, position) == 0
    assert edge_strain(mesh, position).tolist() == [0.0] * 28
    grown = edge_strain(mesh, 1.5 * position)
    assert grown == pytest.approx(np.full(28, 0.5), abs=1e-14)  # a few roundings of lengths of some metres


def test_one_number_serves_for_all_springs_and_all_nodes():
    position, edges = cloth(2, 2, 0.25)
    mesh = spring_mesh(position, edges, 3.0, 0.5, 0.1, [1])
    assert mesh.stiffness.tolist() == [3.0] * 6
    assert mesh.damping.tolist() == [0.5] * 6
    assert mesh.mass.tolist() == [0.1] * 4
    assert mesh.pinned.tolist() == [False, True, False, False]
    assert mesh.inverse_mass.tolist() == [10, 0, 10, 10]
    assert mesh.rest_length[:4].tolist() == [0.25] * 4


def test_a_node_of_infinite_mass_is_pinned():
    mesh = spring_mesh([(0, 0, 0), (1, 0, 0)], [(0, 1)], 1.0, mass=[np.inf, 2.0])
    assert mesh.pinned.tolist() == [True, False]
    assert mesh.inverse_mass.tolist() == [0, 0.5]


def test_pinning_adds_to_what_is_pinned_and_leaves_the_mesh_as_it_was():
    mesh = spring_mesh(*cloth(2, 2, 1.0), 1.0, pinned=[0])
    assert pin(mesh, [3]).pinned.tolist() == [True, False, False, True]
    assert mesh.pinned.tolist() == [True, False, False, False]
    assert pin(mesh, []).pinned.tolist() == mesh.pinned.tolist()


def test_a_mesh_is_read_only_and_shares_no_array_with_its_maker():
    position, edges = cloth(2, 2, 1.0)
    stiffness, mass = np.ones(len(edges)), np.ones(4)
    mesh = spring_mesh(position, edges, stiffness, 0.0, mass)
    edges[:], stiffness[:], mass[:] = 0, 7.0, 7.0
    assert mesh.edges.tolist() == cloth(2, 2, 1.0)[1].tolist()
    assert mesh.stiffness.tolist() == [1.0] * 6
    assert mesh.mass.tolist() == [1.0] * 4
    for array in mesh:
        assert not array.flags.writeable
    with pytest.raises(AttributeError):
        mesh.stiffness = stiffness


PAIR = {
    "edges": [(0, 1)],
    "rest_length": 1.0,
    "stiffness": 1.0,
    "damping": 0.0,
    "mass": [1.0, 1.0],
    "pinned": False,
}


@pytest.mark.parametrize(
    ("wrong", "complaint"),
    [
        ({"edges": [(0, 2)]}, r"edges must join nodes from 0 to 1, not \[0, 2\]"),
        ({"edges": [(-1, 0)]}, r"edges must join nodes from 0 to 1, not \[-1, 0\]"),
        ({"edges": [(1, 1)]}, r"edges must join two different nodes, not \[1, 1\]"),
        ({"edges": [(0, 1, 1)]}, "edges must be integers of the shape"),
        ({"edges": [(0.0, 1.0)]}, "edges must be integers of the shape"),
        ({"edges": [0, 1]}, "edges must be integers of the shape"),
        ({"rest_length": -1.0}, "rest_length must be zero or positive, not -1"),
        ({"stiffness": -2.0}, "stiffness must be zero or positive, not -2"),
        ({"stiffness": np.inf}, "stiffness must be finite, not inf"),
        ({"damping": np.nan}, "damping must be zero or positive, not nan"),
        ({"mass": [1.0, 0.0]}, "mass must be positive, not 0"),
        ({"mass": 1.0}, r"mass must have the shape \(nodes,\), not \(\)"),
        ({"stiffness": [1.0, 2.0]}, "shape"),
        ({"pinned": [True, False, True]}, "shape"),
    ],
)
def test_an_impossible_mesh_is_refused(wrong, complaint):
    with pytest.raises(ValueError, match=complaint):
        SpringMesh(**PAIR | wrong)


@pytest.mark.parametrize(
    ("position", "pinned", "complaint"),
    [
        ([(0, 0, 0), (1, 0, np.nan)], (), "position must be finite"),
        ([(0, 0), (1, 0)], (), r"position must be finite and of the shape \(nodes, 3\), not \(2, 2\)"),
        ([0.0, 0.0, 0.0], (), r"not \(3,\)"),
        ([(0, 0, 0), (1, 0, 0)], [2], "from 0 to 1, not 2"),
        ([(0, 0, 0), (1, 0, 0)], [-1], "from 0 to 1, not -1"),
    ],
)
def test_impossible_positions_and_pins_are_refused(position, pinned, complaint):
    with pytest.raises(ValueError, match=complaint):
        spring_mesh(position, [(0, 1)], 1.0, pinned=pinned)
