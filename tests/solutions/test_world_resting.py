"""Contacts that rest and several impacts at once: complementarity, redundant supports, cradles."""

from __future__ import annotations

import itertools
import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from oracles import oracle

from solutions.world import (
    NotConverged,
    complementarity_residual,
    contact_jacobian,
    inverse_mass_matrix,
    propagate_impacts,
    resting_problem,
    sequential_impulses,
    simultaneous_impacts,
    solve_by_pivots,
    solve_by_sweeps,
)

G = 9.81
UP, X, Y = np.eye(3)[2], np.eye(3)[0], np.eye(3)[1]
SMALL = st.integers(0, 100_000)


def some_contacts(seed, whole=False):
    """G, M⁻¹ and F of some contacts, redundant ones too; in whole numbers many of them tie."""
    rng = np.random.default_rng(seed)
    rows, columns = rng.integers(1, 8), rng.integers(1, 7)
    if whole:
        numbers = rng.integers(-2, 3, size=(rows, columns)).astype(float)
        return numbers, np.eye(columns), rng.integers(-3, 4, size=columns).astype(float)
    return rng.normal(size=(rows, columns)), np.diag(rng.uniform(0.1, 3, size=columns)), rng.normal(size=columns)


def separate_contacts(seed):
    """Contacts that each move a body of their own besides, so that no two are almost one and sweeps converge fast."""
    g, weights, force = some_contacts(seed)
    count = len(g)
    both = np.diag(np.concatenate([np.diag(weights), np.ones(count)]))
    return np.hstack([g, np.eye(count)]), both, np.concatenate([force, np.zeros(count)])


def by_active_sets(a, b):
    """All solutions that a choice of pressed contacts gives: A_cc f_c = −b_c, checked."""
    found = []
    for size in range(len(b) + 1):
        for chosen in itertools.combinations(range(len(b)), size):
            c = list(chosen)
            f = np.zeros(len(b))
            f[c] = np.linalg.lstsq(a[np.ix_(c, c)], -b[c], rcond=None)[0]
            if np.all(f >= -1e-9) and np.all(a @ f + b >= -1e-9) and abs(f @ (a @ f + b)) <= 1e-9:
                found.append(f)
    return found


def table(force, torque=(0.0, 0.0, 0.0), height=1.0, mass=2.0):
    """Four legs at the corners of a square of 2 m, centre of mass above the middle; the problem and its G."""
    arm = np.array([(x, y, -height) for x in (-1, 1) for y in (-1, 1)], dtype=float)
    rows = contact_jacobian(0, -1, np.tile(UP, (4, 1)), arm, arm, 1)
    weights = inverse_mass_matrix([1 / mass], np.eye(3)[None] / 1.5)
    return *resting_problem(rows, weights, [*force, *torque]), rows


# The complementarity problem


@pytest.mark.statement(22, oracle="scipy's nnls: Gauss' principle of least constraint")
@pytest.mark.parametrize("whole", [False, True])
@given(seed=SMALL)
def test_contact_forces_change_the_free_acceleration_least(seed, whole):
    optimize = oracle("scipy.optimize")
    g, weights, force = some_contacts(seed, whole)
    a, b = resting_problem(g, weights, force)
    f = solve_by_pivots(a, b)
    # Gauss: the forces minimise (Gᵀf + F)ᵀ M⁻¹ (Gᵀf + F)
    root = np.sqrt(weights)
    other, _ = optimize.nnls(root @ g.T, -root @ force)
    # The forces may not be unique, the accelerations are. Ties within 1e-11 count as such; nnls works in 1e-12
    assert weights @ (g.T @ f + force) == pytest.approx(weights @ (g.T @ other + force), abs=1e-8)
    assert complementarity_residual(a, b, f) <= 1e-8
    assert np.all(f >= 0)


@pytest.mark.statement(22, oracle="all active sets one after another")
@given(seed=SMALL)
def test_pivoting_finds_a_valid_choice_of_pressed_contacts(seed):
    a, b = resting_problem(*some_contacts(seed))
    f = solve_by_pivots(a, b)
    assert any(a @ f == pytest.approx(a @ other, abs=1e-7) for other in by_active_sets(a, b))
    if np.linalg.eigvalsh(a)[0] > 1e-3:  # then the forces are unique
        (only, *_) = by_active_sets(a, b)
        assert f == pytest.approx(only, abs=1e-7)


@pytest.mark.filterwarnings("ignore::solutions.world.NotConverged")
@pytest.mark.statement(22, oracle="scipy's lsq_linear with bounds")
@settings(max_examples=settings.default.max_examples // 10)
@given(seed=SMALL)
def test_sweeping_comes_to_the_same_forces(seed):
    optimize = oracle("scipy.optimize")
    g, weights, force = separate_contacts(seed)
    a, b = resting_problem(g, weights, force)
    root = np.sqrt(weights)
    other = optimize.lsq_linear(root @ g.T, -root @ force, bounds=(0, np.inf), method="bvls", tol=1e-14).x
    # linear convergence, by some hundredths a sweep at worst; a residual of r leaves r over the least eigenvalue, 1
    assert solve_by_sweeps(a, b, 1000) == pytest.approx(other, abs=1e-9)
    few = [complementarity_residual(a, b, solve_by_sweeps(a, b, sweeps)) for sweeps in (10, 300)]
    assert few[1] <= few[0] + 1e-12
    assert solve_by_sweeps(a, b, 1, start=other) == pytest.approx(other, abs=1e-9)  # a good start stays


def test_the_residual_counts_pulling_sinking_in_and_pressing_from_afar():
    a = np.diag([2.0, 2.0])
    assert complementarity_residual(a, [-4.0, 1.0], [2.0, 0.0]) == 0
    assert complementarity_residual(a, [-4.0, 1.0], [1.5, 0.0]) == 1.0  # still sinks in at 1 m/s²
    assert complementarity_residual(a, [-4.0, 1.0], [2.0, -0.25]) == 0.5  # pulls
    assert complementarity_residual(a, [-4.0, 1.0], [3.0, 0.0]) == 2.0  # lifts it off, and presses
    assert complementarity_residual([[0.5]], [1.0], [5.0]) == 2.5  # m/s² that 5 N give, though it parts at 3.5 m/s²
    assert complementarity_residual(np.zeros((0, 0)), [], []) == 0


def test_only_zero_force_solves_a_contact_that_moves_nothing():
    # [[0]] f + 1 ≥ 0 holds for any f; the product with 1 asks for f = 0
    assert complementarity_residual([[0.0]], [1.0], [0.0]) == 0
    assert complementarity_residual([[0.0]], [1.0], [5.0]) == 1.0
    assert complementarity_residual([[0.0]], [1.0], [0.5]) == 0.5
    assert complementarity_residual([[0.0]], [1.0], [-5.0]) == 5.0
    assert complementarity_residual([[0.0]], [-1.0], [0.0]) == 1.0


@given(SMALL, st.integers(-40, 40), st.integers(-40, 40))
def test_units_of_mass_and_time_change_only_the_numbers(seed, mass, time):
    # Powers of two, up to 1e12 and down to 1e-12; a contact that moves nothing and one that lies still keep their zeros
    g, weights, force = some_contacts(seed)
    g, force = np.vstack([g, np.zeros_like(g[:1])]), np.append(force, 0.0)
    g, weights = np.hstack([g, np.zeros((len(g), 1))]), np.pad(weights, (0, 1))
    a, b = resting_problem(g, weights, force)
    f = solve_by_pivots(a, b)
    assert np.array_equal(solve_by_pivots(a * 2.0**mass, b * 2.0**time), f * 2.0 ** (time - mass))


def test_many_resting_problems_at_once_are_as_one_after_another():
    rng = np.random.default_rng(6)
    g, force, weights = rng.normal(size=(3, 2, 4, 5)), rng.normal(size=(2, 5)), np.diag(rng.uniform(1, 2, size=5))
    a, b = resting_problem(g, weights, force)
    for at in np.ndindex(3, 2):
        alone = resting_problem(g[at], weights, force[at[1]])
        assert a[at] == pytest.approx(alone[0], abs=1e-14)  # sums of five numbers in another order
        assert b[at] == pytest.approx(alone[1], abs=1e-14)


def test_a_contact_that_moves_only_by_rounding_gets_no_force():
    a, b = [[1.0, 0.0], [0.0, -1e-17]], [-2.0, 1.0]
    for f in (solve_by_pivots(a, b), solve_by_sweeps(a, b, 3)):
        assert f.tolist() == [2.0, 0.0]
        assert complementarity_residual(a, b, f) == 0


def test_bodies_that_no_force_keeps_apart_have_no_solution():
    with pytest.raises(ValueError, match="offset"):
        solve_by_pivots([[0.0]], [-1.0])
    with pytest.raises(ValueError, match="offset"):
        solve_by_pivots([[1.0, -1.0], [-1.0, 1.0]], [-1.0, -1.0])  # between two walls that come together
    with pytest.warns(NotConverged, match=r"5 sweeps have not converged: .* by up to 1 m/s²"):
        assert solve_by_sweeps([[0.0]], [-1.0], 5).tolist() == [0.0]
    chain = np.diff(np.eye(4), axis=0, prepend=0, append=0)[:, [2, 0, 3, 1]]  # four bodies, walls on both sides
    a, _ = resting_problem(chain, np.diag([1.0, 1e-12, 1e-3, 1e-9]), np.zeros(4))
    with pytest.raises(ValueError, match="offset"):
        solve_by_pivots(a, [0.3, -0.4, -0.2, 0.1, 0.1])  # the gaps close by 0.1 in all


def test_contacts_that_part_and_no_contacts_at_all_feel_no_force():
    assert solve_by_pivots(np.eye(2), [1.0, 0.0]).tolist() == [0.0, 0.0]
    assert solve_by_sweeps(np.eye(2), [1.0, 0.0], 1).tolist() == [0.0, 0.0]
    assert solve_by_pivots(np.zeros((0, 0)), []).shape == (0,)
    none = np.zeros((0, 2, 2)), np.zeros((0, 2))
    assert solve_by_pivots(*none).shape == solve_by_sweeps(*none, 1).shape == (0, 2)
    assert complementarity_residual(*none, none[1]).shape == (0,)
    assert contact_jacobian([], [], np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 3)), 2).shape == (0, 12)


@pytest.mark.filterwarnings("ignore::solutions.world.NotConverged")
def test_one_problem_is_swept_from_many_starts():
    starts = np.array([[0.0, 0.0], [5.0, 0.0], [0.0, 7.0]])
    found = solve_by_sweeps(np.diag([2.0, 0.25]), [-2.0, 3.0], 1, start=starts)
    assert found.tolist() == [[1.0, 0.0]] * 3
    assert solve_by_sweeps([[0.25]], [-1.0], 1).tolist() == [4.0]
    assert solve_by_sweeps([[0.0]], [1.0], 1, start=7.0).tolist() == [0.0]
    assert solve_by_sweeps(np.diag([2.0, 1.0]), [-2.0, 3.0], 0, start=starts).tolist() == starts.tolist()


def test_many_problems_at_once_are_the_same_as_one_after_another():
    rng = np.random.default_rng(11)
    root = rng.normal(size=(20, 4, 4))
    a, b = root @ np.swapaxes(root, 1, 2), rng.normal(size=(20, 4))
    for together, one in (
        (solve_by_pivots(a, b), solve_by_pivots),
        (solve_by_sweeps(a, b, 30), lambda x, y: solve_by_sweeps(x, y, 30)),
    ):
        assert together == pytest.approx(np.stack([one(a[i], b[i]) for i in range(20)]), rel=1e-9, abs=1e-12)
    assert complementarity_residual(a, b, solve_by_pivots(a, b)).shape == (20,)


# Bodies at rest


@pytest.mark.statement(22, oracle="the balance of forces and moments")
def test_on_four_legs_only_the_sum_and_moments_of_the_forces_are_unique():
    weight = 2 * G
    a, b, rows = table((0.0, 0.0, -weight), torque=(3.0, 5.0, 0.0))
    assert np.linalg.matrix_rank(a) == 3
    ways = [solve_by_pivots(a, b), solve_by_sweeps(a, b, 300), solve_by_sweeps(a, b, 300, start=[9.0, 0, 0, 9.0])]
    for f in ways:
        assert complementarity_residual(a, b, f) <= 1e-12
        assert rows.T @ f == pytest.approx([0, 0, weight, -3, -5, 0], abs=1e-11)  # rounding of 20 N
    assert np.abs(ways[1] - ways[2]).max() > 1  # N: two answers, both right
    # what one may add without anyone noticing
    assert a @ [1.0, -1.0, -1.0, 1.0] == pytest.approx(np.zeros(4), abs=1e-15)


@pytest.mark.statement(22, oracle="the lever, by hand")
def test_a_table_loaded_beyond_its_legs_lifts_the_far_ones():
    # 20 N in the middle carry a torque of 20 N m about the edge; 24 N m turn it over
    for torque, lifts in ((19.0, False), (24.0, True)):
        a, b, _ = table((0.0, 0.0, -20.0), torque=(0.0, torque, 0.0))
        f = solve_by_pivots(a, b)
        up = a @ f + b
        assert np.all(f[2:] > 0)  # the legs at x = +1
        assert up[2:] == pytest.approx([0.0, 0.0], abs=1e-13)
        assert bool(np.all(up[:2] > 0.1)) == lifts
        if lifts:
            assert np.all(f[:2] == 0)


@pytest.mark.statement(22, oracle="the weights above, in fractions")
def test_every_contact_of_a_stack_carries_the_weights_above_it():
    masses = [Fraction(1), Fraction(5, 2), Fraction(3), Fraction(1, 2), Fraction(2)]
    count = len(masses)
    rows = contact_jacobian(
        np.arange(count), np.arange(count) - 1, np.tile(UP, (count, 1)), np.zeros(3), np.zeros(3), count
    )
    weights = inverse_mass_matrix([1 / float(m) for m in masses], np.tile(np.eye(3), (count, 1, 1)))
    force = np.concatenate([[0, 0, -10 * float(m), 0, 0, 0] for m in masses])
    a, b = resting_problem(rows, weights, force)
    carried = [float(10 * sum(masses[i:])) for i in range(count)]
    assert solve_by_pivots(a, b) == pytest.approx(carried, rel=1e-13)
    # sweeps converge linearly: after 2000 to rounding, and after 20 not at all
    assert solve_by_sweeps(a, b, 2000) == pytest.approx(carried, rel=1e-12)
    with pytest.warns(NotConverged, match="20 sweeps"):
        assert complementarity_residual(a, b, solve_by_sweeps(a, b, 20)) > 0.1
    with pytest.warns(NotConverged, match=r"by up to 10 m/s²"):  # one of many: the first lies still
        solve_by_sweeps(a, np.array([0 * b, b]), 0)
    with pytest.warns(NotConverged, match=r"by up to 1 m/s²"):  # a row 1e7 times as large hides none
        solve_by_sweeps(np.diag([1.0, 0.0]), [-1e7, -1.0], 1)


@pytest.mark.parametrize("seed", [0, 785, 1183, 3256])
def test_duplicated_contacts_on_bodies_of_very_unequal_mass_are_solved(seed):
    # With rows twice over, what should be zero in the table is rounding that the exchanges have made larger
    rng = np.random.default_rng(seed)
    g = rng.normal(size=(8, 6))
    weights = np.diag(10.0 ** rng.uniform(-6, 0, size=6))
    a, b = resting_problem(np.vstack([g, g]), weights, rng.normal(size=6))
    # Masses 1e6 apart, which square in A: some 1e-16 × 1e6 of accelerations near 1 m/s²
    assert complementarity_residual(a, b, solve_by_pivots(a, b)) <= 1e-9


@pytest.mark.parametrize("ratio", [1e-11, 1e-6, 1e3, 1e6, 1e9, 1e11])
@pytest.mark.parametrize("heavy", [(4,), (1, 3), (0, 2), (5, 2, 3)])
def test_a_stack_of_light_and_heavy_bodies_stands(ratio, heavy):
    masses = [Fraction(ratio) * (3 + i) / 4 if i in heavy else Fraction(2 + i, 3) for i in range(6)]
    rows = np.eye(6) - np.eye(6, k=-1)
    weight = np.array([float(m) for m in masses])
    a, b = resting_problem(rows, np.diag(1 / weight), -10 * weight)
    carried = [float(10 * sum(masses[i:])) for i in range(6)]
    # A_ii keeps the share of a heavy body next to a light one in 1e-16 of the sum, here for six contacts
    rounding = 1e-15 * max(ratio, 1 / ratio)
    assert solve_by_pivots(a, b) == pytest.approx(carried, rel=10 * rounding + 1e-12)


@given(seed=SMALL, power=st.floats(0, 11))
def test_forces_are_found_whatever_the_masses_of_a_heap_are(seed, power):
    # Bodies on each other and on the ground, some contacts twice over, in any order
    rng = np.random.default_rng(seed)
    count = rng.integers(2, 9)
    below = np.array([rng.integers(-1, i) if i else -1 for i in range(count)])
    rows = np.eye(count)
    rows[np.flatnonzero(below >= 0), below[below >= 0]] = -1
    more = rng.integers(0, count, size=(count // 2, 2))
    across = np.eye(count)[more[:, 0]] - np.where(more[:, :1] == more[:, 1:], 0, np.eye(count)[more[:, 1]])
    rows = np.vstack([rows, across, rows[rng.integers(0, count, size=2)]])[rng.permutation(count + len(more) + 2)]
    mass = 10 ** (power * rng.uniform(size=count))
    a, b = resting_problem(rows, np.diag(1 / mass), -9.81 * mass * rng.choice([1, 1, 1, -0.3], size=count))
    f = solve_by_pivots(a, b)
    gap, terms = a @ f + b, np.abs(a) @ f + np.abs(b)
    assert np.all(f >= 0)
    # The conditions themselves, to a share of what is added up in a row: 1e-16 that m exchanges have made larger
    assert np.all(gap >= -1e-7 * terms)
    assert np.all(np.minimum(f * np.diag(a), np.abs(gap)) <= 1e-7 * terms)


def test_a_contact_feels_the_point_of_each_body_and_the_ground_none():
    row = contact_jacobian([0, 1], [1, -1], [UP, X], [[1.0, 0, 0], Y], [[0, 2.0, 0], Y], 2)
    assert row[0].tolist() == [0, 0, 1, 0, -1, 0, 0, 0, -1, -2, 0, 0]
    assert row[1].tolist() == [0] * 6 + [1, 0, 0, 0, 0, -1]


def slab(friction, slope, sweeps=1000, dt=0.01):
    """Velocity after a step of a table at rest on a slope, and what its feet felt."""
    arm = np.array([(x, y, -0.1) for x in (-1, 1) for y in (-1, 1)], dtype=float)
    rows = np.stack([contact_jacobian(0, -1, np.tile(d, (4, 1)), arm, arm, 1) for d in (UP, X, Y)], axis=1)
    weights = inverse_mass_matrix([1 / 2.0], np.eye(3)[None] / 1.5)
    fall = dt * G * np.array([math.sin(slope), 0, -math.cos(slope), 0, 0, 0])
    return sequential_impulses(fall, rows, weights, friction, sweeps)


@pytest.mark.statement(22, oracle="tan θ ≤ μ, and g (sin θ − μ cos θ) beyond")
@pytest.mark.parametrize("friction", [0.0, 0.2, 0.7])
def test_sequential_impulses_hold_a_slab_up_to_the_angle_of_friction(friction):
    critical, dt = math.atan(friction), 0.01
    for slope in (critical - 1e-2, critical + 1e-2, critical + 0.3):
        if slope < 0:
            continue
        v, impulse = slab(friction, slope)
        slides = max(0.0, G * (math.sin(slope) - friction * math.cos(slope)))
        # g dt is 0.1 m/s; sweeps converge slowly next to the limit, where a foot after the other gives way
        assert v == pytest.approx([slides * dt, 0, 0, 0, 0, 0], abs=1e-6)
        assert np.sum(impulse[:, 0]) == pytest.approx(2 * G * math.cos(slope) * dt, abs=1e-6)
        assert np.all(np.linalg.norm(impulse[:, 1:], axis=1) <= friction * impulse[:, 0] * (1 + 1e-12))


@pytest.mark.statement(22, oracle="scipy's nnls")
@settings(max_examples=settings.default.max_examples // 10)
@given(seed=SMALL)
def test_frictionless_sequential_impulses_change_the_velocities_least(seed):
    optimize = oracle("scipy.optimize")
    g, weights, v = separate_contacts(seed)
    rows = np.zeros((len(g), 3, g.shape[1]))
    rows[:, 0] = g
    after, impulse = sequential_impulses(v, rows, weights, 0.5, 400)
    root = np.sqrt(weights)
    other, _ = optimize.nnls(root @ g.T, -np.linalg.solve(root, v))
    assert after == pytest.approx(v + weights @ g.T @ other, abs=1e-4)  # linear convergence
    assert np.all(impulse[:, 0] >= 0)
    assert np.all(impulse[:, 1:] == 0)  # rows of zeros: nothing moves, no impulse


def test_an_oblique_slip_is_stopped_along_both_directions():
    # By turning, the point of contact yields along x as if it were 1/3 of the body; along y as all of it
    arm = [[0.0, 0.0, -1.0]]
    rows = np.stack([contact_jacobian(0, -1, d[None], arm, arm, 1) for d in (UP, X, Y)], axis=1)
    weights = inverse_mass_matrix([1.0], np.diag([0.0, 2.0, 0.0]))
    v, impulse = sequential_impulses([3.0, -2.0, -1.0, 0, 0, 0], rows, weights, 10.0, 1)
    assert impulse[0] == pytest.approx([1.0, -1.0, 2.0], abs=1e-15)
    assert v == pytest.approx([2.0, 0, 0, 0, 2.0, 0], abs=1e-15)


def test_one_body_of_any_mass_at_one_contact_is_stopped_in_one_sweep():
    rows = np.stack([contact_jacobian(0, -1, d[None], [-UP], [-UP], 1) for d in (UP, X, Y)], axis=1)
    for mass in (0.25, 4.0, 2.0**20):
        weights = inverse_mass_matrix([1 / mass], np.zeros((3, 3)))
        v, impulse = sequential_impulses([2.0, 0, -1.0, 0, 0, 0], rows, weights, 10.0, 1)
        assert v.tolist() == [0] * 6
        assert impulse.tolist() == [[mass, -2 * mass, 0]]


def test_an_earlier_contact_may_take_back_its_impulse_after_a_later_one():
    # A ball between two walls at 60°: the first impulse on the left wall is too much once the right one has pushed
    s, c = math.sin(math.pi / 3), math.cos(math.pi / 3)
    rows = np.zeros((2, 3, 6))
    rows[0, 0, :3], rows[1, 0, :3] = (s, 0, c), (-s, 0, c)
    v, impulse = sequential_impulses([0, 0, -1.0, 0, 0, 0], rows, np.eye(6), 0.0, 100)
    assert v == pytest.approx(np.zeros(6), abs=1e-12)
    assert impulse[:, 0] == pytest.approx([1.0, 1.0], abs=1e-12)  # 2 j cos 60° = 1


def test_two_immovable_bodies_exchange_no_impulse():
    # Three bodies fall, the first two onto each other though nothing can stop them, the third onto the ground
    rows = np.stack([contact_jacobian([0, 2], [1, -1], np.tile(d, (2, 1)), [UP], [-UP], 3) for d in (UP, X, Y)], axis=1)
    weights = inverse_mass_matrix([0.0, 0.0, 1.0], np.zeros((3, 3)))
    start = np.array([[3.0, 0, -10, 0, 0, 0], [0] * 6, [0.0, 0, -2, 0, 0, 0]]).ravel()
    v, impulse = sequential_impulses(start, rows, weights, 0.5, 3)
    assert v.tolist() == [3, 0, -10, *[0] * 15]
    assert impulse.tolist() == [[0, 0, 0], [2, 0, 0]]


# Cradles


@pytest.mark.erratum(22)
@pytest.mark.statement(22, oracle="the lecture's two answers, and conservation")
def test_newtons_cradle_has_two_solutions_that_keep_momentum_and_energy():
    start = [1.0, 0, 0, 0, 0]
    one_by_one, at_once = propagate_impacts(start, 1.0, 1.0), simultaneous_impacts(start, 1.0, 1.0)
    assert one_by_one.tolist() == [0, 0, 0, 0, 1]
    assert at_once == pytest.approx([-0.6, 0.4, 0.4, 0.4, 0.4], abs=1e-15)
    for v in (one_by_one, at_once):
        assert v.sum() == pytest.approx(1, abs=1e-15)
        assert v @ v == pytest.approx(1, abs=1e-15)


def test_two_balls_let_go_from_a_cradle_send_two_out():
    assert propagate_impacts([1.0, 1, 0, 0, 0], 1.0, 1.0).tolist() == [0, 0, 0, 1, 1]


@pytest.mark.statement(22, oracle="exact fractions")
def test_newtons_rule_for_simultaneous_impacts_can_create_energy():
    start = np.array([1.0, 0.0, 0.1])
    v = simultaneous_impacts(start, 1.0, 1.0)
    assert v == pytest.approx([-0.3, 0.7, 0.7], abs=1e-15)
    before = Fraction(1) + Fraction(1, 100)
    after = 2 * Fraction(49, 100) + Fraction(9, 100)
    assert (before / 2, after / 2) == (Fraction(505, 1000), Fraction(535, 1000))
    assert v @ v / 2 == pytest.approx(0.535, abs=1e-15)
    one_by_one = propagate_impacts(start, 1.0, 1.0)
    assert one_by_one == pytest.approx([0.0, 0.1, 1.0], abs=1e-15)
    assert one_by_one @ one_by_one / 2 == pytest.approx(0.505, abs=1e-15)


def cascade(velocity, mass, e):
    """Impacts of two at a time, always of the pair that comes together fastest."""
    v = list(velocity)
    for _ in range(20_000):
        i = max(range(len(v) - 1), key=lambda k: v[k] - v[k + 1])
        if v[i] - v[i + 1] <= 1e-15:
            break
        j = (1 + e) * (v[i] - v[i + 1]) * mass[i] * mass[i + 1] / (mass[i] + mass[i + 1])
        v[i], v[i + 1] = v[i] - j / mass[i], v[i + 1] + j / mass[i + 1]
    return v


@given(st.lists(st.floats(-3, 3).map(lambda x: round(x, 3)), min_size=2, max_size=6))
def test_equal_elastic_balls_leave_in_the_order_of_their_speeds(velocity):
    # two equal balls swap their velocities, so that the row sorts them, whatever the order of the impacts
    assert propagate_impacts(velocity, 1.0, 1.0) == pytest.approx(sorted(velocity), abs=1e-13)


@pytest.mark.statement(22, oracle="the two balls of the fastest approach first")
@pytest.mark.parametrize("restitution", [1.0, 0.8])
def test_the_impact_of_one_ball_on_a_resting_row_has_one_outcome(restitution):
    mass, start = [1.0, 2.0, 0.5, 3.0], [1.0, 0, 0, 0]
    ours = propagate_impacts(start, mass, restitution)
    if restitution == 1:
        assert ours @ (mass * ours) == pytest.approx(1, rel=1e-14)
    assert ours @ mass == pytest.approx(1, rel=1e-14)
    assert np.all(np.diff(ours) >= -1e-12)
    assert ours == pytest.approx(cascade(start, mass, restitution), abs=1e-9)


@given(
    st.lists(st.floats(-3, 3).map(lambda x: round(x, 3)), min_size=2, max_size=6),
    st.floats(0, 1),
    SMALL,
)
def test_impacts_of_a_row_keep_momentum_and_end_every_approach(velocity, e, seed):
    mass, v = np.random.default_rng(seed).uniform(0.5, 2, size=len(velocity)), np.array(velocity)
    at_once = simultaneous_impacts(v, mass, e)
    one_by_one = propagate_impacts(v, mass, e, most=200)
    for after in (at_once, one_by_one):
        assert mass @ after == pytest.approx(mass @ v, abs=1e-11)  # rounding of a few, hundreds of times
    u, left = np.diff(v), np.diff(at_once)
    assert np.all(left >= -e * np.minimum(u, 0) - 1e-9)
    assert mass @ one_by_one**2 <= mass @ v**2 * (1 + 1e-12)


def test_a_row_against_a_wall_comes_back():
    assert propagate_impacts([1.0, 0.0, 0.0], [1.0, 1.0, np.inf], 1.0).tolist() == [-1.0, 0.0, 0.0]
    assert simultaneous_impacts([1.0, 0.0], [1.0, np.inf], 0.5).tolist() == [-0.5, 0.0]
    assert simultaneous_impacts([3.0], 1.0, 1.0).tolist() == propagate_impacts([3.0], 1.0, 1.0).tolist() == [3.0]


def test_a_row_that_sticks_together_comes_to_an_end():
    # With e = 0 the last approach may be less than rounding: nothing changes any more, after hundreds of impacts
    rng = np.random.default_rng(4)
    for _ in range(20):
        mass, v = rng.uniform(0.5, 2, 6), rng.normal(size=6)
        found = propagate_impacts(v, mass, 0.0, most=10**12)
        assert np.array_equal(found, propagate_impacts(v, mass, 0.0, most=1000))
        assert np.all(np.diff(found) >= -1e-14)


def test_a_ball_between_two_closing_walls_has_no_solution():
    with pytest.raises(ValueError, match="no forces solve this problem"):
        simultaneous_impacts([1.0, 0.0, -1.0], [np.inf, 1.0, np.inf], 0.5)
    assert simultaneous_impacts([1.0, 0.0, 2.0], [np.inf, 1.0, np.inf], 0.5).tolist() == [1.0, 1.5, 2.0]


def test_empty_rows_and_no_rows_are_accepted():
    for answer in (propagate_impacts, simultaneous_impacts):
        assert answer([], 1.0, 1.0).shape == (0,)
        assert answer(np.zeros((0, 5)), 1.0, 1.0).shape == (0, 5)


def test_many_rows_at_once_are_the_same_as_one_after_another():
    rows = np.random.default_rng(2).normal(size=(3, 4, 5))
    kept = rows.copy()
    for answer in (propagate_impacts, simultaneous_impacts):
        together = answer(rows, 1.0, 0.5)
        for at in np.ndindex(3, 4):
            assert together[at] == pytest.approx(answer(rows[at], 1.0, 0.5), abs=1e-12)
    assert np.array_equal(kept, rows)


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (
            lambda: contact_jacobian([2], [-1], [UP], [UP], [UP], 2),
            "body_a must be a number of a body, -1 to 1, not 2",
        ),
        (lambda: contact_jacobian([0], [-2], [UP], [UP], [UP], 1), "body_b"),
        (lambda: contact_jacobian([0.5], [-1], [UP], [UP], [UP], 1), "body_a"),
        (lambda: contact_jacobian([math.nan], [-1], [UP], [UP], [UP], 1), "body_a"),
        (lambda: contact_jacobian([0], [-1], [UP[:2]], [UP], [UP], 1), "direction"),
        (lambda: contact_jacobian([0], [-1], [2 * UP], [UP], [UP], 1), "direction must have length 1"),
        (lambda: contact_jacobian([0], [-1], UP, [UP], [UP], 1), r"direction must have shape \(m, 3\)"),
        (lambda: contact_jacobian([0], [-1], [UP], [UP[:2]], [UP], 1), "arm_a"),
        (lambda: inverse_mass_matrix([-1.0], np.eye(3)[None]), "inverse_mass"),
        (lambda: inverse_mass_matrix([np.inf], np.eye(3)), "inverse_mass must be finite"),
        (lambda: inverse_mass_matrix(1.0, np.eye(3)), r"inverse_mass must have shape \(n,\)"),
        (lambda: inverse_mass_matrix([1.0], [1.0, 2.0, 3.0]), "inverse_inertia must have shape"),
        (lambda: inverse_mass_matrix([1.0], np.full((3, 3), np.nan)), "inverse_inertia must be finite"),
        (lambda: sequential_impulses(np.full(6, np.nan), np.zeros((1, 3, 6)), np.eye(6), 0.1), "velocity"),
        (lambda: sequential_impulses(np.zeros(6), np.zeros((1, 3, 6)), np.eye(6), np.inf), "friction"),
        (lambda: sequential_impulses(np.zeros(6), np.zeros((1, 3, 6)), np.eye(6), -0.1), "friction"),
        (lambda: solve_by_pivots(np.eye(3), [1.0, 2.0]), "matrix"),
        (lambda: solve_by_sweeps([1.0], [1.0], 3), "matrix"),
        (lambda: sequential_impulses(np.zeros(6), np.zeros((1, 3, 6)), np.eye(6), 0.1, -1), "sweeps must be zero or"),
        (lambda: solve_by_sweeps(np.eye(2), [1.0, 2.0], 3, start=np.nan), "start"),
        (lambda: solve_by_sweeps(np.eye(2), [1.0, 2.0], -1), "sweeps must be zero or positive, not -1"),
        (lambda: solve_by_sweeps(np.eye(2), [1.0, 2.0], True), "sweeps must be a whole number, not True"),
        (lambda: solve_by_pivots(-np.eye(2), [1.0, -2.0]), "diagonal of matrix"),
        (lambda: solve_by_sweeps([[-1e-12]], [1.0], 1), "diagonal of matrix"),
        (lambda: complementarity_residual(np.eye(2), [np.nan, 0.0], [0.0, 0.0]), "offset"),
        (lambda: complementarity_residual([[np.inf]], [0.0], [0.0]), "matrix"),
        (lambda: complementarity_residual(np.eye(2), [0.0, 0.0], [0.0, np.nan]), "force"),
        (lambda: propagate_impacts(1.0, 1.0, 1.0), "velocity"),
        (lambda: propagate_impacts([1.0, 0.0], np.inf, 1.0), "mass"),
        (lambda: propagate_impacts([1.0, 0.0, 0.0], [1.0, np.inf, np.inf], 1.0), "mass must be finite"),
        (lambda: propagate_impacts([np.nan, 1.0], 1.0, 1.0), "velocity"),
        (lambda: propagate_impacts([0.0, 1.0], 0.0, 1.0), "mass"),
        (lambda: propagate_impacts([0.0, 1.0], 1.0, 1.1), "restitution"),
        (lambda: simultaneous_impacts([1.0, 0.0], np.inf, 1.0), "mass"),
        (lambda: simultaneous_impacts([1.0, 0.0], 1.0, -1.0), "restitution"),
        (lambda: simultaneous_impacts([np.inf, 0.0], 1.0, 1.0), "velocity"),
    ],
)
def test_an_invalid_contact_is_refused_by_name(call, name):
    with pytest.raises(ValueError, match=f"^{name}"):
        call()


@pytest.mark.parametrize(
    ("velocity", "mass"),
    [
        ([2.0, 2.0 + 1e-15, 0.0], [1.0, 1.125, 1.0]),
        ([1.58e-11, 0, 0, 2, 2.0000001], [1.7, 1.6, 1, 1.2, 1.9]),
        ([-0.9999999999709576, -1, -1, 1], [0.75, 1.43, 0.52, 1.54]),
    ],
)
def test_what_hardly_closes_beside_faster_parting_is_no_reason_to_give_up(velocity, mass):
    after = simultaneous_impacts(velocity, mass, 0.5)
    assert np.dot(mass, after - velocity) == pytest.approx(0.0, abs=1e-14)
    assert np.min(np.diff(after)) >= -1e-14
