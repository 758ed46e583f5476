from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solutions.meshes import (
    SpringMesh,
    cloth,
    edge_strain,
    lattice,
    limit_strain,
    mesh_forces,
    mesh_sphere_contact,
    mesh_step,
    pin,
    spring_mesh,
    static_shape,
)

SEED = st.integers(0, 2**32 - 1)
SOME = settings(max_examples=settings.default.max_examples // 7)
"""For examples that each take a tenth of a second."""
GRAVITY = np.array((0.0, 0.0, -9.81))
UP = (0.0, 0.0, 1.0)
NOTHING = (0.0, 0.0, 0.0)


def chain(nodes, stiffness=200.0, mass=0.5, pinned=(0,), along=(0, 0, -1), damping=0.0):
    position = np.arange(nodes)[:, None] * np.array(along, dtype=float)
    return spring_mesh(position, [(i, i + 1) for i in range(nodes - 1)], stiffness, damping, mass, pinned), position


# The shape at rest


@pytest.mark.statement(28, oracle="closed form of a hanging chain")
@SOME
@given(st.integers(1, 8), st.floats(1, 1e4), st.floats(0.01, 10))
def test_a_hanging_chain_sags_by_the_weight_below_every_spring(count, stiffness, mass):
    mesh, position = chain(count + 1, stiffness, mass)
    number = np.arange(1, count + 1)
    sag = mass * 9.81 / stiffness * np.cumsum(count - number + 1)
    found = (position - static_shape(mesh, position, GRAVITY))[1:, 2]
    # The tolerance: at each node up to 1e-8 of a weight is missing, and so of each sag; rounding of the heights, 1e-10
    assert found == pytest.approx(sag, rel=1e-7)


@pytest.fixture(scope="module")
def hanging_chain():
    """A chain of five nodes, plumb and unloaded, and its shape at rest."""
    mesh, position = chain(5)
    return mesh, position, static_shape(mesh, position, GRAVITY)


@SOME
@given(SEED)
def test_the_hanging_chain_is_found_from_any_shape(hanging_chain, seed):
    mesh, position, expected = hanging_chain
    guess = position + np.where(mesh.pinned[:, None], 0, np.random.default_rng(seed).uniform(-0.4, 0.4, (5, 3)))
    # A net force of 1e-10 weights or of the first imbalance, some 100 N; over springs of 200 N/m
    assert static_shape(mesh, guess, GRAVITY, 1e-10) == pytest.approx(expected, abs=1e-6)


@pytest.mark.statement(28, oracle="statics: the pull of the pins, catenary")
def test_a_chain_between_two_pins_hangs_in_the_curve_of_constant_pull():
    mesh, position = chain(12, 1e5, 0.1, (0, 11), along=(0.8, 0, 0))
    mesh = SpringMesh(mesh.edges, 1.0, mesh.stiffness, mesh.damping, mesh.mass, mesh.pinned)  # longer than the span
    guess = position - np.array([0, 0, 1.0]) * np.sin(np.linspace(0, math.pi, 12))[:, None]
    shape = static_shape(mesh, guess, GRAVITY)
    assert shape[::-1] * (-1, 1, 1) + (8.8, 0, 0) == pytest.approx(shape, abs=1e-6)
    pull = mesh_forces(mesh, shape, np.zeros_like(shape))
    assert pull[[0, 11], 2] == pytest.approx([-10 * 0.1 * 9.81 / 2] * 2, rel=1e-6)  # each pin: half of ten weights
    slopes = np.diff(shape[:, 2]) / np.diff(shape[:, 0])  # tan of each link: weight below it over the constant pull H
    assert np.diff(slopes) == pytest.approx(np.full(10, 0.1 * 9.81 / pull[0, 0]), rel=1e-6)


def test_a_cloth_that_hangs_from_two_corners_is_symmetric():
    position, edges = cloth(6, 6, 0.1)
    mesh = spring_mesh(position, edges, 50.0, 0.1, 0.01, [0, 5])
    shape = static_shape(mesh, position, GRAVITY)
    rows = shape.reshape(6, 6, 3)
    assert rows[:, ::-1] * (-1, 1, 1) + (0.5, 0, 0) == pytest.approx(rows, abs=1e-9)
    net = mesh_forces(mesh, shape, np.zeros_like(shape)) + 0.01 * GRAVITY
    # Tolerance 1e-8 of the first imbalance, which is the weight of a node
    assert np.linalg.norm(net[~mesh.pinned], axis=1).max() <= 1.01e-8 * 0.01 * 9.81
    held = net[mesh.pinned].sum(axis=0) - 2 * 0.01 * GRAVITY
    assert held == pytest.approx([0, 0, -34 * 0.01 * 9.81], abs=1e-7)  # what the pins carry


@pytest.mark.statement(28, oracle="Euler and Bernoulli's order of magnitude; a mechanism that hangs plumb")
def test_without_internal_springs_a_cantilever_hangs_down():
    ends = {}
    for kinds in (("structural",), ("structural", "face", "space")):
        position, edges = lattice(6, 2, 2, 0.1, kinds)
        mesh = spring_mesh(position, edges, 2000.0, 0.0, 0.01, range(4))
        ends[kinds] = static_shape(mesh, position, GRAVITY, 1e-6)[-4:].mean(axis=0) - (0.5, 0.05, 0.05)
    without, braced = ends.values()
    # 0.5 m long: without the diagonals it is a parallel linkage that hangs down to the plumb line from its pinned end
    assert without[2] < -0.45
    # 0.2 kg on springs that carry 2 × 2000 N/m each way, 0.1 m apart: w l³/8EI with EI = 4 · 2000 · 0.1 · 0.05² N m²
    # is 0.015 m; the diagonals help, shear hinders: within a factor of two
    assert -0.03 < braced[2] < -0.0075


def test_a_mesh_at_rest_stays_and_one_that_nothing_holds_is_refused():
    position, edges = cloth(3, 3, 0.1)
    mesh = spring_mesh(position, edges, 50.0)
    assert np.array_equal(static_shape(mesh, position, (0, 0, 0)), position)
    with pytest.raises(RuntimeError, match=r"no shape at rest found in 200 steps: a net force of \d+.* N is left"):
        static_shape(mesh, position, GRAVITY, iterations=200)
    loose = SpringMesh(np.zeros((0, 2)), 0.0, 0.0, 0.0, np.ones(2), [True, False])
    with pytest.raises(RuntimeError, match="no shape at rest"):
        static_shape(loose, np.zeros((2, 3)), GRAVITY, iterations=10)
    assert static_shape(pin(loose, [1]), np.ones((2, 3)), GRAVITY).tolist() == np.ones((2, 3)).tolist()


def test_without_weight_a_mesh_relaxes_to_the_lengths_of_its_springs():
    position, edges = lattice(2, 2, 2, 0.1)
    mesh = spring_mesh(position, edges, 50.0)
    found = static_shape(mesh, 1.3 * position, NOTHING)
    # A net force of 1e-8 of the first, which strains of a third give: 1e-8 of these, and more in soft ways
    assert edge_strain(mesh, found) == pytest.approx(np.zeros(28), abs=1e-7)


def test_the_search_stops_at_the_given_share_of_weight_or_first_force():
    position, edges = lattice(2, 2, 2, 0.1)
    for pull, scale in ((NOTHING, 1.0), (GRAVITY, 9.81)):
        mesh = spring_mesh(position, edges, 50.0, pinned=[0] if pull is GRAVITY else [])
        stretched = 1.3 * position
        if pull is NOTHING:
            scale = np.linalg.norm(mesh_forces(mesh, stretched, np.zeros_like(stretched)), axis=1).max()
        found = static_shape(mesh, stretched, pull, tolerance=0.1)
        net = np.linalg.norm((mesh_forces(mesh, found, np.zeros_like(found)) + pull)[~mesh.pinned], axis=1).max()
        assert 1e-4 * scale < net <= 0.1 * scale


def test_a_chain_hangs_from_a_node_of_infinite_mass():
    mesh, position = chain(4)
    anchored = SpringMesh(mesh.edges, mesh.rest_length, 200.0, 0.0, [np.inf, 0.5, 0.5, 0.5], False)
    assert np.array_equal(static_shape(anchored, position, GRAVITY), static_shape(mesh, position, GRAVITY))


def test_shapes_at_rest_of_many_meshes_are_as_one_after_another():
    rng = np.random.default_rng(4)
    mesh, position = chain(4)
    guesses = position + np.where(mesh.pinned[:, None], 0, rng.uniform(-0.3, 0.3, (3, 4, 3)))
    pulls = GRAVITY * rng.uniform(0.5, 2, (3, 1, 1))
    guesses.flags.writeable = False
    together = static_shape(mesh, guesses, pulls)
    for at in range(3):  # the others go on until the last has come to rest: the tolerance of both
        assert together[at] == pytest.approx(static_shape(mesh, guesses[at], pulls[at]), abs=1e-6)


# Strain limiting


@pytest.mark.statement(28, oracle="the limit itself")
@SOME
@given(SEED)
def test_no_spring_of_a_hanging_chain_stays_longer_than_the_limit(seed):
    rng = np.random.default_rng(seed)
    mesh, position = chain(6, mass=rng.uniform(1, 2, 6))
    stretched = position * rng.uniform(0.8, 1.6)
    limited = limit_strain(mesh, stretched)
    # The slowest way to correct a chain of five springs shrinks by about (π/10)²/2 = 0.05 a round: e⁻⁵⁰ after 1000
    assert edge_strain(mesh, limited).max() <= 0.1 + 1e-6
    assert np.array_equal(limited[0], stretched[0])


@SOME
@given(SEED)
def test_limiting_moves_no_centre_of_mass(seed):
    rng = np.random.default_rng(seed)
    rest, edges = lattice(2, 2, 2, 1.0)
    mesh = spring_mesh(rest, edges, 1.0, mass=rng.uniform(0.1, 5, 8))
    stretched = 1.5 * rest + 0.3 * rng.normal(size=rest.shape)
    one_round = limit_strain(mesh, stretched, 0.1, iterations=1)
    assert mesh.mass @ one_round == pytest.approx(mesh.mass @ stretched, abs=1e-12)
    limited = limit_strain(mesh, stretched)
    assert edge_strain(mesh, limited).max() <= 0.1 + 1e-6
    assert mesh.mass @ limited == pytest.approx(mesh.mass @ stretched, abs=1e-10)


def test_one_stretched_spring_is_corrected_at_once_by_inverse_masses():
    mesh = spring_mesh([(0, 0, 0), (1, 0, 0)], [(0, 1)], 1.0, mass=[1.0, 3.0])
    found = limit_strain(mesh, [(0, 0, 0), (2, 0, 0)], 0.2, iterations=1)
    assert found == pytest.approx(np.array([(0.6, 0, 0), (1.8, 0, 0)]))  # 0.8 too long: 3/4 for the light end
    pinned = limit_strain(pin(mesh, [0]), [(0, 0, 0), (2, 0, 0)], 0.2, iterations=1)
    assert pinned == pytest.approx(np.array([(0, 0, 0), (1.2, 0, 0)]))  # the free end takes all
    both = limit_strain(pin(mesh, [0, 1]), [(0, 0, 0), (2, 0, 0)], 0.2)
    assert both.tolist() == [[0, 0, 0], [2, 0, 0]]


def test_the_second_of_two_springs_between_pins_undoes_what_the_first_did():
    mesh, _ = chain(3, pinned=(0, 2), along=(1, 0, 0))
    stretched = [(0, 0, 0), (1.5, 0, 0), (2.8, 0, 0)]
    for springs, middle in ((mesh, 1.7), (mesh._replace(edges=[(1, 2), (0, 1)]), 1.1)):  # 1.1 from the end of the last
        assert limit_strain(springs, stretched, 0.1, iterations=1)[1] == pytest.approx([middle, 0, 0])


def test_springs_within_the_limit_are_left_alone():
    mesh = SpringMesh([(0, 1), (1, 2), (2, 3)], [1.0, 1.0, 0.0], 1.0, 0.0, np.ones(4), False)
    position = np.array([(0, 0, 0), (1.1, 0, 0), (0.4, 0, 0), (5.0, 0, 0)])
    assert np.array_equal(limit_strain(mesh, position), position)
    assert not np.shares_memory(limit_strain(mesh, position), position)
    with pytest.raises(ValueError, match=r"limit must be zero or positive, not -0\.1"):
        limit_strain(mesh, position, -0.1)


def test_pins_that_are_too_far_apart_stay_and_some_spring_is_too_long():
    mesh, _ = chain(4, pinned=(0, 3), along=(1, 0, 0))
    stretched = [(0, 0, 0), (2, 0, 0), (2.5, 0, 0), (6, 0, 0)]
    found = limit_strain(mesh, stretched)
    assert found[[0, 3]].tolist() == [[0, 0, 0], [6, 0, 0]]
    assert edge_strain(mesh, found).max() >= 1


def test_strain_limiting_of_many_meshes_is_as_one_after_another():
    rng = np.random.default_rng(12)
    rest, edges = cloth(3, 3, 1.0)
    mesh = spring_mesh(rest, edges, 1.0, pinned=[0])
    shapes = rest * rng.uniform(1, 1.5, (2, 2, 1, 1)) + 0.05 * rng.normal(size=(2, 2, 9, 3))
    together = limit_strain(mesh, shapes, iterations=50)
    for at in np.ndindex(2, 2):
        assert np.array_equal(together[at], limit_strain(mesh, shapes[at], iterations=50))


@pytest.mark.slow
@pytest.mark.statement(28, oracle="the limit itself")
def test_a_soft_cloth_limited_in_every_step_hangs_without_stretching():
    position, edges = cloth(4, 4, 0.1)
    mesh = spring_mesh(position, edges, 5.0, 0.05, 0.01, [0, 3])  # by itself it would stretch by a third
    p, v, dt = position, np.zeros_like(position), 0.005
    for _ in range(100):
        moved, v = mesh_step(mesh, p, v, GRAVITY, dt)
        p = limit_strain(mesh, moved, iterations=50)
        v = v + (p - moved) / dt
    free = static_shape(mesh, position, GRAVITY)
    assert edge_strain(mesh, free).max() > 0.3
    assert edge_strain(mesh, p).max() < 0.101


# Contact


@given(SEED, st.floats(0, 1), st.floats(0, 1))
def test_a_node_within_a_sphere_is_put_back_reversed_and_slowed(seed, e, mu):
    rng = np.random.default_rng(seed)
    mesh = spring_mesh(rng.normal(size=(8, 3)), [(0, 1)], 1.0, pinned=[0])
    p, v, centre = rng.normal(size=(8, 3)), rng.normal(size=(8, 3)), 0.3 * rng.normal(size=3)
    position, velocity = mesh_sphere_contact(mesh, p, v, centre, 1.5, e, mu)
    for node in range(8):
        away = p[node] - centre
        n = away / np.linalg.norm(away)
        if np.linalg.norm(away) >= 1.5 or node == 0:
            assert np.array_equal(position[node], p[node])
            assert np.array_equal(velocity[node], v[node])
            continue
        across = v[node] @ n
        along = v[node] - across * n
        speed, lost = np.linalg.norm(along), mu * (1 + e) * max(0.0, -across)
        assert position[node] == pytest.approx(centre + 1.5 * n, abs=1e-12)
        assert velocity[node] @ n == pytest.approx(-e * across if across < 0 else across, abs=1e-12)
        after = velocity[node] - (velocity[node] @ n) * n
        assert after == pytest.approx(along * max(0.0, 1 - lost / speed), abs=1e-12)


def test_a_node_at_the_centre_of_a_sphere_goes_up():
    mesh = spring_mesh([(0, 0, 0)], np.zeros((0, 2)), 1.0)
    position, velocity = mesh_sphere_contact(mesh, [(1, 2, 3)], [(1, 0, -2)], (1, 2, 3), 0.5, 0.5)
    assert position.tolist() == [[1, 2, 3.5]]
    assert velocity.tolist() == [[1, 0, 1]]


def test_a_node_on_the_surface_is_not_within_it():
    mesh = spring_mesh([(0, 0, 0)], np.zeros((0, 2)), 1.0)
    position, velocity = mesh_sphere_contact(mesh, [(0, 0, 0)], [(0, 0, -1)], (0, 0, -1), 1.0)
    assert position.tolist() == [[0, 0, 0]]
    assert velocity.tolist() == [[0, 0, -1]]


def test_a_resting_node_slides_for_its_speed_squared_over_two_mu_g():
    mesh = spring_mesh([(0, 0, 0)], np.zeros((0, 2)), 1.0)
    p, v, dt = np.zeros((1, 3)), np.array([(2.0, 0, 0)]), 1e-3
    for _ in range(1000):
        moved = mesh_step(mesh, p, v, GRAVITY, dt)
        p, v = mesh_sphere_contact(mesh, *moved, (0, 0, -1e6), 1e6, 0.5, 0.4)  # nearly a plane
    # e = 0.5 stirs it a little; a step more or less of 2 m/s × 1 ms, and the last step's rounding to a stop
    assert p[0, 0] == pytest.approx(2**2 / (2 * 0.4 * 9.81), abs=3e-3)
    assert v[0, 0] == pytest.approx(0, abs=1e-6)


def test_a_cloth_comes_to_rest_on_a_sphere_and_no_node_is_within():
    position, edges = cloth(9, 9, 0.1)
    position = position - (0.4, 0.4, -0.5)
    mesh = spring_mesh(position, edges, 100.0, 0.3, 0.01)
    p, v = position, np.zeros_like(position)
    for _ in range(1500):
        p, v = mesh_sphere_contact(mesh, *mesh_step(mesh, p, v, GRAVITY, 0.002), (0, 0, 0), 0.4, friction=0.8)
        assert np.linalg.norm(p, axis=-1).min() >= 0.4 - 1e-12
    assert np.linalg.norm(v, axis=-1).max() < 0.05
    # Four sides hang alike; without noise nothing tells them apart
    assert p[:, 0].sum() == pytest.approx(0, abs=1e-6)
    assert p[:, 2].max() == pytest.approx(0.4, abs=1e-3)
    assert p[:, 2].min() < 0.25


def test_contacts_of_many_meshes_at_once_are_as_one_after_another():
    rng = np.random.default_rng(13)
    mesh = spring_mesh(*cloth(2, 2, 1.0), 1.0, pinned=[3])
    p, v, centre = (rng.normal(size=(5, *shape)) for shape in ((4, 3), (4, 3), (1, 3)))
    radius, e, mu = rng.uniform([[[1]], [[0]], [[0]]], [[[2]], [[1]], [[1]]], (3, 5, 1))
    kept = [array.copy() for array in (p, v, centre, radius)]
    together = mesh_sphere_contact(mesh, p, v, centre, radius, e, mu)
    for at in range(5):
        alone = mesh_sphere_contact(mesh, p[at], v[at], centre[at], radius[at], e[at], mu[at])
        assert all(np.array_equal(a[at], b) for a, b in zip(together, alone, strict=True))
    assert all(np.array_equal(a, b) for a, b in zip((p, v, centre, radius), kept, strict=True))


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        ((0.0,), "radius must be positive, not 0"),
        ((float("nan"),), "radius must be positive, not nan"),
        ((1.0, -0.5), "restitution must be from 0 to 1, not -0.5"),
        ((1.0, 0.5, -1.0), "friction must be zero or positive, not -1"),
    ],
)
def test_an_invalid_contact_is_refused(arguments, complaint):
    mesh = spring_mesh(*cloth(2, 2, 1.0), 1.0)
    with pytest.raises(ValueError, match=complaint):
        mesh_sphere_contact(mesh, np.zeros((4, 3)), np.zeros((4, 3)), (0, 0, 0), *arguments)
