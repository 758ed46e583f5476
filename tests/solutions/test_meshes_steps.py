from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from solutions.meshes import (
    SpringMesh,
    cloth,
    conjugate_gradient,
    edge_damping,
    edge_stiffness,
    implicit_mesh_step,
    largest_eigenvalue,
    lattice,
    mesh_energy,
    mesh_forces,
    mesh_matrix,
    mesh_product,
    mesh_step,
    pin,
    spring_mesh,
    stable_timestep,
    static_shape,
    timestep_bound,
    zero_energy_modes,
)

SEED = st.integers(0, 2**32 - 1)
GRAVITY = (0.0, 0.0, -9.81)
NOTHING = (0.0, 0.0, 0.0)
KINDS = [("structural",), ("structural", "shear"), ("structural", "shear", "bend")]
LECTURE = [1.01, 0.72, 0.646]  # √(m/k), of a 10×10 cloth
MOVES = [mesh_step, implicit_mesh_step]


def any_mesh(seed, nodes=6, edges=12):
    """A mesh of random springs between random nodes, at rest in its shape."""
    rng = np.random.default_rng(seed)
    ends = np.array([rng.choice(nodes, 2, replace=False) for _ in range(edges)])
    position = rng.normal(size=(nodes, 3))
    stiffness, damping = rng.uniform(1, [[100.0], [5.0]], (2, edges))
    pinned = np.flatnonzero(rng.random(nodes) < 0.2)
    return spring_mesh(position, ends, stiffness, damping, rng.uniform(0.1, 2, nodes), pinned), position, rng


def undamped(mesh):
    return mesh._replace(damping=np.asarray(0.0))


def kinetic_energy(mesh, velocity):
    return np.sum(np.where(mesh.pinned, 0, mesh.mass)[:, None] * velocity**2, axis=(-2, -1)) / 2


def growth(mesh, position, dt):
    """How much the fastest growing small motion grows in a step of semi-implicit Euler, from the whole matrices."""
    free = np.repeat(~mesh.pinned, 3)
    inverse = np.repeat(mesh.inverse_mass, 3)[free, None]
    k, c = (mesh_matrix(mesh, b)[free][:, free] for b in (edge_stiffness(mesh, position), edge_damping(mesh, position)))
    eye, nothing = np.eye(free.sum()), np.zeros((free.sum(), free.sum()))
    kick = np.block([[eye, nothing], [-dt * inverse * k, eye - dt * inverse * c]])
    drift = np.block([[eye, dt * eye], [nothing, eye]])
    return np.abs(np.linalg.eigvals(drift @ kick)).max()


# Zero-energy modes: what internal springs are for


@pytest.mark.statement(28, oracle="rank of the matrix of directions; Maxwell's count")
@pytest.mark.parametrize(
    ("kinds", "modes"),
    [
        (("structural",), 12),
        (("structural", "face"), 6),
        (("structural", "space"), 9),
        (("structural", "face", "space"), 6),
    ],
)
def test_internal_springs_remove_the_six_ways_a_cube_can_collapse(kinds, modes):
    position, edges = lattice(2, 2, 2, 1.0, kinds)
    mesh = spring_mesh(position, edges, 50.0)
    assert zero_energy_modes(mesh, position) == modes
    directions = np.zeros((len(edges), 8, 3))  # how a small motion changes the length of every edge
    for row, (i, j) in enumerate(edges):
        directions[row, i], directions[row, j] = position[i] - position[j], position[j] - position[i]
    assert modes == 24 - np.linalg.matrix_rank(directions.reshape(len(edges), 24))
    assert modes >= 24 - len(edges)


@given(st.integers(2, 4), st.integers(2, 4), st.integers(2, 4))
def test_a_braced_solid_has_only_the_six_motions_of_a_rigid_body(nx, ny, nz):
    position, edges = lattice(nx, ny, nz, 0.1)
    assert zero_energy_modes(spring_mesh(position, edges, 7.0), position) == 6


@given(st.integers(2, 5), st.integers(2, 5))
def test_without_shear_springs_a_flat_cloth_slips_along_rows_and_columns(rows, columns):
    # Out of its plane nothing resists a small motion, not even bend springs: rows · columns ways. In the plane 2 r c
    # motions less r (c − 1) + c (r − 1) springs leave r + c; with the diagonals only the three of a rigid body.
    for kinds, in_plane in zip(KINDS, (rows + columns, 3, 3), strict=True):
        position, edges = cloth(rows, columns, 0.1, kinds)
        assert zero_energy_modes(spring_mesh(position, edges, 1.0), position) == rows * columns + in_plane


def test_pinning_three_corners_leaves_a_braced_cube_no_motion():
    mesh = spring_mesh(*lattice(2, 2, 2, 1.0), 1.0)
    position = lattice(2, 2, 2, 1.0)[0]
    counts = [int(zero_energy_modes(pin(mesh, nodes), position)) for nodes in ([0], [0, 1], [0, 1, 2], range(8))]
    assert counts == [3, 1, 0, 0]


def test_a_mesh_without_springs_resists_nothing():
    position, edges = cloth(2, 2, 1.0, ())
    mesh = spring_mesh(position, edges, 1.0)
    assert zero_energy_modes(mesh, position) == 12
    assert largest_eigenvalue(mesh, position) == 0
    assert stable_timestep(mesh, position) == np.inf
    assert timestep_bound(mesh) == np.inf


def test_tension_makes_a_chain_resist_sideways_motion():
    chain = spring_mesh([(x, 0, 0) for x in range(4)], [(0, 1), (1, 2), (2, 3)], 1.0, pinned=[0, 3])
    assert zero_energy_modes(chain, [(x, 0, 0) for x in range(4)]) == 4  # both inner nodes, sideways
    assert zero_energy_modes(chain, [(2.0 * x, 0, 0) for x in range(4)]) == 0


# The longest stable step


@pytest.mark.statement(28, oracle="dense eigenvalues; simulation on both sides")
@pytest.mark.parametrize(("kinds", "stated"), list(zip(KINDS, LECTURE, strict=True)))
def test_every_kind_of_spring_shortens_the_step_to_the_stated_length(kinds, stated):
    position, edges = cloth(10, 10, 1.0, kinds)
    mesh = spring_mesh(position, edges, 4.0, mass=9.0)
    unit = math.sqrt(9 / 4)
    limit = stable_timestep(mesh, position)
    assert limit == pytest.approx(stated * unit, rel=5e-3)  # as many digits as are stated
    exact = 2 / math.sqrt(np.linalg.eigvalsh(mesh_matrix(mesh, edge_stiffness(mesh, position)))[-1] / 9)
    assert exact <= limit * (1 + 1e-12)  # the quotient is never above the eigenvalue, but for rounding
    assert limit == pytest.approx(exact, rel=1e-4)  # the tolerance of the power iteration
    assert limit == pytest.approx(2 / math.sqrt(largest_eigenvalue(mesh, position)), rel=1e-4)
    assert 2 * unit / limit == pytest.approx(2 / stated, rel=5e-3)  # how far the single spring's limit is off


@pytest.mark.statement(28, oracle="simulation on both sides of the limit")
@pytest.mark.parametrize("kinds", [KINDS[0], *(pytest.param(kinds, marks=pytest.mark.slow) for kinds in KINDS[1:])])
def test_a_cloth_vibrates_below_the_limit_and_blows_up_above_it(kinds):
    position, edges = cloth(10, 10, 1.0, kinds)
    mesh = spring_mesh(position, edges, 1.0)
    kick = 1e-9 * np.random.default_rng(1).normal(size=position.shape) * (1, 1, 0)
    limit = float(stable_timestep(mesh, position))
    farthest = []
    for dt in (0.99 * limit, 1.01 * limit):
        p, v = position + kick, np.zeros_like(position)
        for _ in range(120):
            p, v = mesh_step(mesh, p, v, NOTHING, dt)
        farthest.append(np.abs(p - position).max())
    # Below, the amplitude may rise to 1/√(1 − 0.99²) ≈ 7 times the kick's. Above, dt²λ = 4.08 gives a factor of 1.33 a
    # step, 1e15 in all, until the springs turn round.
    assert farthest[0] < 1e-7
    assert farthest[1] > 1e-2


@pytest.mark.statement(29, oracle="eigenvalues of the matrix of one step")
@given(SEED)
def test_with_any_dampers_a_motion_grows_just_above_the_limit(seed):
    mesh, position, _ = any_mesh(seed)
    limit = float(stable_timestep(mesh, position, tolerance=1e-6))
    # Motions that nothing holds have a double eigenvalue 1, which rounding splits by 1e-8. Above, the one at −1 grows
    # by a few times the share that dt is too long.
    assert growth(mesh, position, 0.999 * limit) < 1 + 1e-6
    assert growth(mesh, position, 1.002 * limit) > 1 + 1e-4


@given(st.floats(0, 3), st.floats(0.1, 10))
def test_a_single_spring_has_the_limit_of_a_damped_oscillator(ratio, frequency):
    # Reduced mass 1/2 of two unit masses: k = ω²/2 and c = 2ζω/2
    mesh = spring_mesh([(0, 0, 0), (1, 0, 0)], [(0, 1)], frequency**2 / 2, ratio * frequency)
    limit = 2 / frequency * (math.sqrt(1 + ratio**2) - ratio)
    assert stable_timestep(mesh, [(0, 0, 0), (1, 0, 0)]) == pytest.approx(limit, rel=1e-9)
    assert timestep_bound(mesh) == pytest.approx(limit, rel=1e-12)  # here adding up is exact


@given(SEED, st.floats(0.2, 5))
def test_the_step_found_by_adding_up_is_safe_in_every_shape(seed, size):
    mesh, position, rng = any_mesh(seed)
    shape = size * position + 0.3 * rng.normal(size=position.shape)
    assert timestep_bound(mesh) <= stable_timestep(mesh, shape) * (1 + 1e-12)


def test_the_step_found_by_adding_up_wastes_a_third_on_a_full_cloth():
    position, edges = cloth(10, 10, 1.0)
    bound = timestep_bound(spring_mesh(position, edges, 1.0))
    assert bound == pytest.approx(2 / math.sqrt(2 * 12))  # twelve springs meet at an inner node
    assert bound / 0.646 == pytest.approx(0.632, abs=1e-3)


@given(SEED)
def test_scaling_and_pinning_change_the_largest_eigenvalue_as_derived(seed):
    mesh, position, _ = any_mesh(seed)
    found = float(largest_eigenvalue(mesh, position, tolerance=1e-8))
    heavier = mesh._replace(mass=4 * mesh.mass, stiffness=9 * mesh.stiffness)
    # The iteration takes the same way: roundings alone
    assert largest_eigenvalue(heavier, position, tolerance=1e-8) == pytest.approx(9 / 4 * found, rel=1e-9)
    # What is pinned takes motions away. A millionth for what the iteration has not found.
    assert largest_eigenvalue(pin(mesh, [0]), position) <= found * (1 + 1e-6)


def test_the_power_iteration_approaches_the_eigenvalue_from_below():
    position, edges = cloth(4, 4, 1.0)
    mesh = spring_mesh(position, edges, 1.0, 0.1)
    found = [float(largest_eigenvalue(mesh, position, 1e-12, rounds)) for rounds in (1, 5, 25, 1000)]
    exact = np.linalg.eigvalsh(mesh_matrix(mesh, edge_stiffness(mesh, position)))[-1]
    assert found == sorted(found)
    assert found[-1] == pytest.approx(exact, rel=1e-9)  # 1000 rounds of a gap of some hundredths
    steps = [float(stable_timestep(mesh, position, 1e-12, rounds)) for rounds in (1, 5, 25, 1000)]
    assert steps == sorted(steps, reverse=True)


# The cheap step


@given(st.floats(0.01, 0.95), st.floats(0.1, 10), st.floats(0.1, 10), st.integers(1, 60))
def test_two_nodes_swing_with_the_exact_frequency_of_the_step(share, mass_1, mass_2, count):
    # x = (L − L0) follows x_n = A cos((n + ½) θ)/cos(θ/2) with 2 sin(θ/2) = ω dt, ω² = k (1/m1 + 1/m2)
    mesh = spring_mesh([(0, 0, 0), (1, 0, 0)], [(0, 1)], 3.0, mass=[mass_1, mass_2])
    frequency = math.sqrt(3 * (1 / mass_1 + 1 / mass_2))
    dt, theta = 2 * share / frequency, 2 * math.asin(share)
    p, v = np.array([(0, 0, 0), (1.01, 0, 0)]), np.zeros((2, 3))
    for _ in range(count):
        p, v = mesh_step(mesh, p, v, NOTHING, dt)
    stretch = 0.01 * math.cos((count + 0.5) * theta) / math.cos(theta / 2)
    assert p[1, 0] - p[0, 0] - 1 == pytest.approx(stretch, abs=1e-12)  # some hundred roundings of lengths of 1


@pytest.mark.parametrize("move", MOVES)
@given(seed=SEED)
def test_pinned_nodes_do_not_move_even_with_a_velocity(move, seed):
    mesh, position, rng = any_mesh(seed)
    mesh = pin(mesh, [2])
    p, v = move(mesh, position, rng.normal(size=(6, 3)), GRAVITY, 0.01)
    assert np.array_equal(p[mesh.pinned], position[mesh.pinned])
    assert not v[mesh.pinned].any()
    at_rest = np.where(mesh.pinned[:, None], 0, v)
    assert np.array_equal(v, at_rest)
    assert v[~mesh.pinned].any(axis=-1).all()


@pytest.mark.parametrize(("move", "steps", "tolerance"), [(mesh_step, 20, 1e-12), (implicit_mesh_step, 3, 1e-7)])
@given(seed=SEED)
def test_a_free_mesh_keeps_its_momentum(move, steps, tolerance, seed):
    # Roundings of these steps; the implicit step to the tolerance of its solver, 1e-8 of dt times forces of some 100 N
    mesh, position, rng = any_mesh(seed)
    mesh = mesh._replace(pinned=np.asarray(False))
    p, v = position + 0.1 * rng.normal(size=(6, 3)), rng.normal(size=(6, 3))
    before = mesh.mass @ v
    for _ in range(steps):
        p, v = move(mesh, p, v, NOTHING, 0.01)
    assert mesh.mass @ v == pytest.approx(before, abs=tolerance)


@given(SEED)
def test_a_free_mesh_keeps_its_angular_momentum_in_the_cheap_step(seed):
    mesh, position, rng = any_mesh(seed)
    mesh = mesh._replace(pinned=np.asarray(False))
    p, v = position + 0.1 * rng.normal(size=(6, 3)), rng.normal(size=(6, 3))
    before = mesh.mass @ np.cross(p, v)
    for _ in range(20):
        p, v = mesh_step(mesh, p, v, NOTHING, 0.01)
    assert mesh.mass @ np.cross(p, v) == pytest.approx(before, abs=1e-11)  # exact except for roundings of 20 steps


@pytest.mark.parametrize("move", MOVES)
def test_a_mesh_that_flies_together_falls_like_a_stone(move):
    position, edges = lattice(2, 2, 2, 0.1)
    mesh = spring_mesh(position, edges, 100.0, 1.0, 0.2)
    p, v, dt = position, np.tile((1.0, 2.0, 3.0), (8, 1)), 0.01
    for _ in range(100):
        p, v = move(mesh, p, v, GRAVITY, dt)
    # Half a step of g ahead of the parabola: −g t (t + dt)/2. The solver's tolerance: 1e-8 of 0.1 m/s, a hundred times.
    assert v == pytest.approx(np.tile((1, 2, 3 - 9.81), (8, 1)), abs=1e-6)
    assert p - position == pytest.approx(np.tile((1, 2, 3 - 9.81 * 1.01 / 2), (8, 1)), abs=1e-6)


def test_an_undamped_mesh_keeps_its_energy_in_the_long_run():
    position, edges = lattice(2, 2, 2, 1.0)
    mesh = spring_mesh(position, edges, 100.0)
    p, v = 1.05 * position, np.zeros_like(position)
    p = p + 0.05 * np.random.default_rng(2).normal(size=p.shape)
    dt = 0.2 * float(stable_timestep(mesh, position))
    path = []
    for _ in range(3000):
        p, v = mesh_step(mesh, p, v, NOTHING, dt)
        path.append((p, v))
    positions, velocities = np.moveaxis(path, 1, 0)
    energies = mesh_energy(mesh, positions) + kinetic_energy(mesh, velocities)
    early, late = np.mean(energies[:1000]), np.mean(energies[-1000:])
    # The energy swings by ω dt/2 = 0.2 of the fastest mode at most, about a mean that stays
    assert late == pytest.approx(early, rel=0.01)
    assert np.ptp(energies) < 0.4 * early


@pytest.mark.statement(29, oracle="exponential decay of a damped oscillator")
def test_dampers_stop_vibrations_and_leave_the_flight_alone():
    position, edges = lattice(2, 2, 2, 1.0)
    mesh = spring_mesh(position, edges, 100.0, 2.0)
    flight = np.array([3.0, 0.0, 1.0])
    p, v = 1.1 * position, np.tile(flight, (8, 1))
    for _ in range(1500):
        p, v = mesh_step(mesh, p, v, NOTHING, 0.01)
    # Each spring alone has c/k = 0.02 s, so a mode of ω² ≥ 100 rad²/s² decays at 0.01 ω² ≥ 1/s: e⁻¹⁵ after 15 s
    assert mesh_energy(mesh, p) < 1e-10
    assert v == pytest.approx(np.tile(flight, (8, 1)), abs=1e-5)


@pytest.mark.statement(29, oracle="momentum")
def test_the_slides_damping_on_every_node_also_stops_the_flight():
    position, edges = lattice(2, 2, 2, 1.0)
    mesh = spring_mesh(position, edges, 100.0)
    p, v = position, np.tile((3.0, 0.0, 0.0), (8, 1))
    for _ in range(100):
        p, v = mesh_step(mesh, p, v, -2.0 * v, 0.005)
    assert v == pytest.approx(np.tile((3 * 0.99**100, 0, 0), (8, 1)), abs=1e-12)


@pytest.mark.parametrize("move", MOVES)
def test_a_node_of_infinite_mass_is_an_anchor(move):
    mesh = spring_mesh([(0, 0, 0), (1, 0, 0)], [(0, 1)], 10.0, mass=[np.inf, 1.0])
    pinned = spring_mesh([(0, 0, 0), (1, 0, 0)], [(0, 1)], 10.0, pinned=[0])
    state = np.array([(0, 0, 0), (1.5, 0, 0)]), np.zeros((2, 3))
    assert all(
        np.array_equal(a, b)
        for a, b in zip(move(mesh, *state, GRAVITY, 0.1), move(pinned, *state, GRAVITY, 0.1), strict=True)
    )
    assert stable_timestep(mesh, state[0]) == stable_timestep(pinned, state[0])
    assert timestep_bound(mesh) == timestep_bound(pinned)


# The step that takes any dt


@pytest.mark.statement(28, oracle="eigenvalues of backward Euler, 1/(1 ± iω dt)")
@given(st.floats(-4, 4).map(lambda power: 10**power), st.integers(1, 5))
def test_backward_euler_damps_a_vibration_by_the_stated_factor(share, count):
    # Along the edge the spring is linear, so that one linearisation is exact: of v² + ω²x², 1/(1 + ω²dt²) a step
    mesh = spring_mesh([(0, 0, 0), (1, 0, 0)], [(0, 1)], 2.0, mass=[1.0, 1.0])
    frequency, dt = 2.0, share / 2
    p, v = np.array([(0, 0, 0), (1.01, 0, 0)]), np.zeros((2, 3))
    for _ in range(count):
        p, v = implicit_mesh_step(mesh, p, v, NOTHING, dt, tolerance=1e-12)
    x, rate = p[1, 0] - p[0, 0] - 1, v[1, 0] - v[0, 0]
    kept = abs(1 / (1 + 1j * frequency * dt))
    assert math.hypot(x, rate / frequency) == pytest.approx(0.01 * kept**count, rel=1e-6, abs=1e-14)


@pytest.mark.statement(29, oracle="closed form of one step of backward Euler")
@given(st.floats(-1, 1), st.floats(-1, 1), st.floats(0, 5), st.floats(-3, 3).map(lambda power: 10**power))
def test_a_damped_oscillator_takes_the_step_of_backward_euler(stretch, rate, ratio, dt):
    # On an anchor: v' = (v − dt ω² x)/(1 + 2ζω dt + ω² dt²), x' = x + dt v', with m = 1 and ω = 3
    mesh = spring_mesh([(0, 0, 0), (2, 0, 0)], [(0, 1)], 9.0, 2 * ratio * 3, pinned=[0])
    p, v = implicit_mesh_step(mesh, [(0, 0, 0), (2 + stretch, 0, 0)], [(0, 0, 0), (rate, 0, 0)], NOTHING, dt, 1e-12)
    after = (rate - dt * 9 * stretch) / (1 + 6 * ratio * dt + 9 * dt**2)
    assert v[1] == pytest.approx([after, 0, 0], rel=1e-9, abs=1e-12)  # rounding of terms up to dt² ω²
    assert p[1] == pytest.approx([2 + stretch + dt * after, 0, 0], rel=1e-9)


@pytest.fixture(scope="module")
def hanging_cloth():
    """A cloth held at two corners, flat and at rest, its shape at rest under gravity, and a hundred times its limit."""
    position, edges = cloth(6, 6, 0.1)
    mesh = spring_mesh(position, edges, 50.0, 0.02, 0.01, [0, 5])
    return mesh, position, static_shape(mesh, position, GRAVITY), 100 * float(stable_timestep(mesh, position))


def total_energy(mesh, position, velocity):
    weight = 9.81 * np.sum(np.where(mesh.pinned, 0, mesh.mass) * position[:, 2])
    return float(mesh_energy(mesh, position) + kinetic_energy(mesh, velocity) + weight)


@pytest.mark.statement(28, oracle="the energy of the shape at rest")
def test_at_a_hundred_times_the_limit_the_implicit_step_only_loses_energy(hanging_cloth):
    mesh, _, rest, dt = hanging_cloth
    pushed = rest + np.where(mesh.pinned[:, None], 0, 1e-4 * np.random.default_rng(1).normal(size=rest.shape))
    p, v = pushed, np.zeros_like(rest)
    energies = [total_energy(mesh, p, v)]
    for _ in range(20):
        p, v = implicit_mesh_step(mesh, p, v, GRAVITY, dt)
        energies.append(total_energy(mesh, p, v))
    assert all(np.diff(energies) <= 1e-9 * abs(energies[0]))  # the solver's tolerance and the rounding of sums
    p, v = pushed, np.zeros_like(rest)
    for _ in range(20):
        p, v = mesh_step(mesh, p, v, GRAVITY, dt)
    assert np.abs(p).max() > 1e6


@pytest.mark.statement(28, oracle="the shape at rest, found by dynamic relaxation")
def test_a_flat_cloth_thrown_far_by_one_long_step_still_comes_to_rest(hanging_cloth):
    # At rest and flat it resists nothing across: within the first step of almost a second it falls free, g dt²
    mesh, position, rest, dt = hanging_cloth
    p, v = implicit_mesh_step(mesh, position, np.zeros_like(position), GRAVITY, dt)
    assert -p[-1, 2] == pytest.approx(9.81 * dt**2, rel=1e-6)
    assert total_energy(mesh, p, v) > 1e4
    for _ in range(60):
        p, v = implicit_mesh_step(mesh, p, v, GRAVITY, dt)
    # Where springs are shortened the clamped K makes it creep: the last tenths of a millimetre take long
    assert p == pytest.approx(rest, abs=1e-3)


def test_the_implicit_step_slows_a_spin_and_keeps_the_momentum():
    position, edges = lattice(2, 2, 2, 1.0)
    mesh = spring_mesh(position, edges, 1000.0)
    p = position - 0.5
    v = np.cross((0, 0, 2.0), p)
    before = np.cross(p, v).sum(axis=0)
    for _ in range(20):
        p, v = implicit_mesh_step(mesh, p, v, NOTHING, 0.05)
    # Each step turns by 0.1 rad along the tangent, away from the circle; stiff springs take that back and some spin
    assert 0.2 < np.cross(p, v).sum(axis=0)[2] / before[2] < 0.98
    assert v.sum(axis=0) == pytest.approx([0, 0, 0], abs=1e-6)  # the solver's tolerance


def test_without_the_clamp_a_short_spring_makes_the_matrix_indefinite():
    # dt² k (L0/L − 1) above the mass: Baraff and Witkin's matrix has a negative eigenvalue, and no minimum to find
    mesh = SpringMesh([(0, 1)], 1.0, 100.0, 0.0, np.ones(2), [True, False])
    position, dt = [(0, 0, 0), (0.5, 0, 0)], 0.2
    lowest = []
    for clamped in (False, True):
        matrix = mesh_matrix(mesh, dt**2 * edge_stiffness(mesh, position, clamped))[3:, 3:] + np.eye(3)
        lowest.append(np.linalg.eigvalsh(matrix)[0])
    assert lowest == pytest.approx([1 - 4, 1])


@given(SEED, st.floats(1e-3, 10))
def test_conjugate_gradients_solve_what_elimination_solves(seed, dt):
    mesh, position, rng = any_mesh(seed)
    blocks = dt**2 * edge_stiffness(mesh, position) + dt * edge_damping(mesh, position)
    right = rng.normal(size=(6, 3))
    x = conjugate_gradient(mesh, blocks, right, tolerance=1e-12)
    free = np.repeat(~mesh.pinned, 3)
    matrix = (mesh_matrix(mesh, blocks) + np.diag(np.repeat(mesh.mass, 3)))[free][:, free]
    exact = np.zeros(18)
    exact[free] = np.linalg.solve(matrix, right.ravel()[free])
    # The condition number, up to dt² λ ~ 1e5, times the tolerance and the rounding
    assert x.ravel() == pytest.approx(exact, abs=1e-6 * max(1e-3, np.abs(exact).max()))
    assert not x[mesh.pinned].any()


def test_conjugate_gradients_need_one_round_per_distinct_eigenvalue():
    # Two unit masses and one spring on x, each block (1 + k, 1, 1): P (M + B) has 1 for four motions, and 1/(1 + k) and
    # (1 + 2 k)/(1 + k) for both ends going the same way and for the stretching, so three rounds
    position = np.array([(0.0, 0, 0), (1, 0, 0)])
    mesh = spring_mesh(position, [(0, 1)], 10.0)
    right = np.random.default_rng(3).normal(size=(2, 3))
    blocks = edge_stiffness(mesh, position)
    found = conjugate_gradient(mesh, blocks, right, 1e-12, iterations=3)
    assert found == pytest.approx(conjugate_gradient(mesh, blocks, right, 1e-12))
    with pytest.raises(RuntimeError, match=r"a residual of \d\.\de[+-]0\d of its mass times"):
        conjugate_gradient(mesh, blocks, right, 1e-12, iterations=2)


def test_conjugate_gradients_fail_if_one_of_many_is_not_solved():
    position = np.array([(0.0, 0, 0), (1, 0, 0)])
    blocks = edge_stiffness(spring_mesh(position, [(0, 1)], 10.0), position)
    rights = np.stack([np.zeros((2, 3)), np.random.default_rng(3).normal(size=(2, 3))])
    with pytest.raises(RuntimeError, match="conjugate gradients"):
        conjugate_gradient(spring_mesh(position, [(0, 1)], 10.0), blocks, rights, 1e-12, iterations=1)


@pytest.mark.statement(28, oracle="elimination in fractions")
@pytest.mark.parametrize("ratio", [1e3, 1e6, 1e9, 1e12])
def test_light_nodes_beside_heavy_ones_move_as_in_exact_elimination(ratio):
    position = np.array([(0.0, 0, 0), (1, 0.2, 0), (1.7, 1, 0.1), (2.5, 0.9, 1), (0.3, 1.5, 0.4)])
    edges = [(0, 1), (1, 2), (2, 3), (3, 4), (1, 4), (2, 4)]
    mass = np.array([1.0, 1 / ratio, 2 / ratio, 3.0, 0.5 / ratio])
    mesh = SpringMesh(edges, 0.9, 40.0, 0.3, mass, False)
    velocity = np.random.default_rng(5).normal(size=(5, 3))
    dt = 0.02
    _, found = implicit_mesh_step(mesh, position, velocity, GRAVITY, dt)
    stiffness = edge_stiffness(mesh, position)
    matrix = mesh_matrix(mesh, dt * edge_damping(mesh, position) + dt**2 * stiffness) + np.diag(np.repeat(mass, 3))
    force = mesh_forces(mesh, position, velocity) + mass[:, None] * GRAVITY
    right = dt * (force - dt * mesh_product(mesh, stiffness, velocity))
    exact = velocity + np.reshape(eliminated(matrix, right.ravel()), (5, 3))
    # 1e-8 is asked for; rounding enters through the stiffness over the smallest mass, some ratio/100, at 1e-16
    assert np.abs(found - exact).max() < (1e-7 + 1e-17 * ratio) * np.abs(exact).max()


def eliminated(matrix, right):
    """The solution of a linear system, without rounding."""
    rows = [[Fraction(value) for value in (*row, last)] for row, last in zip(matrix, right, strict=True)]
    for place, row in enumerate(rows):
        for other in rows[:place] + rows[place + 1 :]:
            share = other[place] / row[place]
            other[:] = [value - share * above for value, above in zip(other, row, strict=True)]
    return [float(row[-1] / row[place]) for place, row in enumerate(rows)]


def test_conjugate_gradients_of_nothing_are_nothing():
    mesh = spring_mesh(*cloth(2, 2, 1.0), 1.0)
    blocks = edge_stiffness(mesh, cloth(2, 2, 1.0)[0])
    assert not conjugate_gradient(mesh, blocks, np.zeros((4, 3))).any()
    all_pinned = pin(mesh, range(4))
    assert not conjugate_gradient(all_pinned, blocks, np.ones((4, 3))).any()
    empty = spring_mesh(np.zeros((0, 3)), [], 1.0)
    for shape in ((0, 3), (2, 0, 3)):
        for state in implicit_mesh_step(empty, np.zeros(shape), np.zeros(shape), GRAVITY, 0.1):
            assert state.shape == shape


# One is many


@pytest.mark.parametrize("move", MOVES)
def test_many_meshes_at_once_are_the_same_as_one_after_another(move):
    rng = np.random.default_rng(8)
    rest, edges = lattice(2, 2, 2, 1.0)
    mesh = spring_mesh(rest, edges, 10.0, 0.1, pinned=[3])
    p, v = rest + 0.2 * rng.normal(size=(2, 3, 8, 3)), rng.normal(size=(2, 3, 8, 3))
    v[0, 0] = 0
    gravity, dt = rng.normal(size=(2, 3, 1, 3)), rng.uniform(0.01, 0.2, size=(2, 3))
    for array in (p, v, gravity, dt):
        array.flags.writeable = False
    positions, velocities = move(mesh, p, v, gravity, dt)
    for at in np.ndindex(2, 3):
        position, velocity = move(mesh, p[at], v[at], gravity[at], dt[at])
        assert positions[at] == pytest.approx(position, abs=1e-13)
        assert velocities[at] == pytest.approx(velocity, abs=1e-13)


def test_limits_and_modes_of_many_shapes_are_as_one_after_another():
    rng = np.random.default_rng(9)
    rest, edges = lattice(2, 2, 2, 1.0)
    mesh = spring_mesh(rest, edges, 10.0, 0.3, pinned=[3])
    shapes = rest + 0.1 * rng.normal(size=(2, 2, 8, 3))
    for call in (largest_eigenvalue, stable_timestep, zero_energy_modes):
        together = call(mesh, shapes)
        assert together.shape == (2, 2)
        for at in np.ndindex(2, 2):
            assert together[at] == pytest.approx(call(mesh, shapes[at]), rel=1e-4)  # rounds end for all at once


@pytest.mark.parametrize("move", MOVES)
@pytest.mark.parametrize("dt", [0.0, -0.1, float("nan")])
def test_a_step_that_is_not_positive_is_refused(move, dt):
    position, edges = cloth(2, 2, 1.0)
    with pytest.raises(ValueError, match="dt must be positive"):
        move(spring_mesh(position, edges, 1.0), position, position, GRAVITY, dt)


@pytest.mark.parametrize("wrong", [float("nan"), float("inf")])
def test_what_is_not_finite_is_refused_where_it_would_leave_no_trace(wrong):
    position, edges = cloth(2, 2, 1.0)
    mesh, broken = spring_mesh(position, edges, 1.0), np.full_like(position, wrong)
    for call in (zero_energy_modes, largest_eigenvalue, stable_timestep):
        with pytest.raises(ValueError, match=f"position must be finite, not {wrong}"):
            call(mesh, broken)
    with pytest.raises(ValueError, match=f"position must be finite, not {wrong}"):
        static_shape(mesh, broken, GRAVITY)
    state = {"position": position, "velocity": 0 * position, "acceleration": (0, 0, -9.81), "dt": 0.1}
    for name, value in {"position": broken, "velocity": broken, "acceleration": (0, 0, wrong), "dt": wrong}.items():
        with pytest.raises(ValueError, match=f"^{name} must be (finite|positive), not {wrong}"):
            implicit_mesh_step(mesh, **(state | {name: value}))
    assert not np.isfinite(mesh_step(mesh, position, np.zeros_like(position), (0, 0, wrong), 0.1)[0]).any(axis=0)[2]


def test_a_search_with_no_rounds_takes_one():
    position, edges = cloth(2, 2, 1.0)
    mesh = spring_mesh(position, edges, 1.0)
    assert largest_eigenvalue(mesh, position, iterations=0) == largest_eigenvalue(mesh, position, iterations=1)
    assert stable_timestep(mesh, position, iterations=0) == stable_timestep(mesh, position, iterations=1)
    assert static_shape(mesh, position, NOTHING, iterations=0).tolist() == position.tolist()
