"""Neighbours by a grid of cells, and Reynolds' three rules among them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles import oracle

from solutions.avoidance import flock_step, neighbour_pairs, separation, towards_mean

RNG_SEED = 1
WEIGHTS = (0.4, 0.5, 0.3)


def brute_force(position: np.ndarray, radius: float) -> np.ndarray:
    """All pairs within the radius, (pairs, 2), from all distances."""
    squared = sum((axis[:, None] - axis[None]) ** 2 for axis in np.asarray(position, dtype=float).T)
    return np.argwhere(np.triu(squared <= radius**2, 1))


def by_a_tree(position: np.ndarray, radius: float) -> np.ndarray:
    pairs = oracle("scipy.spatial").cKDTree(position).query_pairs(radius, output_type="ndarray")
    pairs = np.sort(pairs, axis=1)
    return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]


def rotation(rng: np.random.Generator) -> np.ndarray:
    q, r = np.linalg.qr(rng.normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return q * np.linalg.det(q)  # a reflection becomes a rotation


# Neighbours


@pytest.mark.statement(1, oracle="scipy's k-d tree, and all distances")
@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize("spread", [0.3, 3.0, 30.0])
def test_the_grid_finds_the_pairs_that_a_tree_finds_each_once(dimensions, spread):
    rng = np.random.default_rng(RNG_SEED)
    for count in (2, 3, 50, 400):
        position = rng.uniform(-spread, spread, (count, dimensions))
        pairs = np.stack(neighbour_pairs(position, 1.0), axis=1)
        assert np.array_equal(pairs, brute_force(position, 1.0))
        assert np.array_equal(pairs, by_a_tree(position, 1.0))


@given(
    st.integers(2, 3).flatmap(
        lambda d: st.lists(st.tuples(*[st.integers(-4, 4)] * d), min_size=1, max_size=60).map(
            lambda rows: np.array(rows, dtype=float)
        )
    ),
    st.sampled_from([0.5, 1.0, math.sqrt(2), 2.0, 3.0, 100.0]),
    st.sampled_from([0.0, 0.5, -7.0, 1e6]),
)
def test_points_on_borders_of_cells_are_paired_as_by_brute_force(lattice, radius, shift):
    position = lattice + shift  # whole and half numbers: distances are exact, many of them equal to the radius
    assert np.array_equal(np.stack(neighbour_pairs(position, radius), axis=1), brute_force(position, radius))


def test_points_exactly_a_radius_apart_are_still_neighbours():
    place = [[0.0, 0.0], [1.0, 0.0], [0.0, np.nextafter(1.0, 2.0)]]
    assert np.stack(neighbour_pairs(place, 1.0), axis=1).tolist() == [[0, 1]]
    assert len(neighbour_pairs([[0.0, 0.0, 0.0], [2.0, 3.0, 6.0]], 7.0)[0]) == 1


@pytest.mark.parametrize("dimensions", [2, 3])
def test_nobody_and_one_alone_have_no_neighbours(dimensions):
    for count in (0, 1):
        first, second = neighbour_pairs(np.zeros((count, dimensions)), 1.0)
        assert first.shape == second.shape == (0,)
        assert first.dtype.kind == second.dtype.kind == "i"


@pytest.mark.parametrize("dimensions", [2, 3])
def test_a_crowd_in_one_cell_and_at_one_place_is_all_pairs(dimensions):
    rng = np.random.default_rng(RNG_SEED)
    all_pairs = np.argwhere(np.triu(np.ones((30, 30)), 1))
    for position in (rng.uniform(0, 0.1, (30, dimensions)), np.full((30, dimensions), -3.7)):
        assert np.array_equal(np.stack(neighbour_pairs(position, 1.0), axis=1), all_pairs)


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize("spread", [1e3, 1e6, 1e9, 1e12, 1e15, 1e18, 1e60])
def test_clusters_any_distance_apart_are_found_in_the_same_memory(dimensions, spread):
    rng = np.random.default_rng(RNG_SEED)
    centres = rng.uniform(-spread, spread, (20, dimensions))
    position = np.concatenate([centres, centres + rng.uniform(-0.6, 0.6, centres.shape), centres])
    pairs = np.stack(neighbour_pairs(position, 1.0), axis=1)
    assert np.array_equal(pairs, brute_force(position, 1.0))
    assert len(pairs) >= 20


@given(
    st.floats(1e-6, 1e6), st.lists(st.tuples(*[st.integers(-3, 3)] * 3), min_size=2, max_size=20), st.integers(0, 99)
)
def test_points_that_rounding_moves_across_a_border_are_not_lost(radius, steps, seed):
    # Whole multiples of the radius, each coordinate moved by one or two spacings, far from the origin
    rng = np.random.default_rng(seed)
    position = np.array(steps) * radius + 1e4 * radius
    position = position * (1 + rng.integers(-2, 3, position.shape) * np.finfo(float).eps)
    assert np.array_equal(np.stack(neighbour_pairs(position, radius), axis=1), brute_force(position, radius))


def test_neighbours_depend_neither_on_the_order_nor_on_the_place():
    rng = np.random.default_rng(RNG_SEED)
    position = rng.uniform(-3, 3, (200, 3))
    pairs = {frozenset(pair) for pair in zip(*neighbour_pairs(position, 1.0), strict=True)}
    order = rng.permutation(200)
    shuffled = {frozenset((order[i], order[j])) for i, j in zip(*neighbour_pairs(position[order], 1.0), strict=True)}
    turned = position @ rotation(rng).T + (1e3, -500.0, 7.0)
    assert shuffled == pairs
    # no pair of these 200 is nearer to the radius than 1e-6 m, far above the rounding of 1e3 m
    assert {frozenset(pair) for pair in zip(*neighbour_pairs(turned, 1.0), strict=True)} == pairs


@pytest.mark.parametrize(
    ("position", "radius", "complaint"),
    [
        (np.zeros((2, 4)), 1.0, r"shape \(n, 2\) or \(n, 3\), not \(2, 4\)"),
        (np.zeros(3), 1.0, r"not \(3,\)"),
        ([[0.0, math.nan]], 1.0, "position must be finite, not nan"),
        ([[0.0, math.inf]], 1.0, "position must be finite, not inf"),
        (np.zeros((2, 2)), 0.0, "radius must be positive, not 0"),
        (np.zeros((2, 2)), math.nan, "radius must be positive, not nan"),
    ],
)
def test_places_and_radii_that_make_no_sense_are_refused(position, radius, complaint):
    with pytest.raises(ValueError, match=complaint):
        neighbour_pairs(position, radius)


# The three rules


def rules_by_loops(position, velocity, radius):
    """Separation, alignment and cohesion as they are said in words, one boid and one neighbour at a time."""
    out = np.zeros((3, *position.shape))
    for i in range(len(position)):
        others = [j for j in range(len(position)) if j != i and np.linalg.norm(position[i] - position[j]) <= radius]
        for j in others:
            away = position[i] - position[j]
            distance = np.linalg.norm(away)
            out[0, i] += away / distance / distance if distance > 0 else 0.0
        if others:
            out[1, i] = np.mean(velocity[others], axis=0) - velocity[i]
            out[2, i] = np.mean(position[others], axis=0) - position[i]
    return out


@pytest.mark.statement(1, oracle="the rules in words, by loops over all")
@pytest.mark.parametrize("dimensions", [2, 3])
def test_separation_alignment_and_cohesion_are_what_the_words_say(dimensions):
    rng = np.random.default_rng(RNG_SEED)
    position, velocity = rng.uniform(-2, 2, (2, 60, dimensions))
    position[7] = position[3]  # two at the same place
    pairs = neighbour_pairs(position, 1.0)
    found = [separation(position, *pairs), towards_mean(velocity, *pairs), towards_mean(position, *pairs)]
    # 1e-12: sums of some 20 numbers, of which two close neighbours may make one as large as 1e3
    assert np.abs(np.array(found) - rules_by_loops(position, velocity, 1.0)).max() < 1e-12


def test_two_boids_push_each_other_apart_by_one_over_their_distance():
    position = np.array([[0.0, 0.0], [3.0, 4.0]])
    push = separation(position, [0], [1])
    assert push == pytest.approx(np.array([[-3.0, -4.0], [3.0, 4.0]]) / 25, abs=1e-16)


@given(st.lists(st.tuples(*[st.integers(-8, 8)] * 2), min_size=1, max_size=40), st.floats(0.5, 6))
def test_separation_adds_no_momentum_to_the_flock(lattice, radius):
    position = np.array(lattice) / 4
    push = separation(position, *neighbour_pairs(position, radius))
    # each pair adds a number and its opposite; 1e-13: the rounding of up to 800 sums of numbers up to 4
    assert np.abs(push.sum(axis=0)).max(initial=0.0) < 1e-13 * (1 + np.abs(push).sum())


def test_boids_at_the_same_place_do_not_push_each_other():
    position = np.array([[1.0, 1.0, 1.0]] * 3 + [[1.0, 1.0, 1.5]])
    push = separation(position, *neighbour_pairs(position, 1.0))
    assert push.tolist() == [[0.0, 0.0, -2.0]] * 3 + [[0.0, 0.0, 6.0]]
    step = flock_step(position, np.zeros((4, 3)), 0.1, 1.0, WEIGHTS, 1.0, 10.0)
    assert np.all(np.isfinite(step))


def test_one_without_neighbours_flies_straight_on():
    position, velocity = np.array([[0.0, 0.0], [9.0, 0.0]]), np.array([[1.0, 0.5], [-1.0, 0.0]])
    after, moving = flock_step(position, velocity, 0.5, 1.0, WEIGHTS, 5.0, 10.0)
    assert np.array_equal(moving, velocity)
    assert np.array_equal(after, position + velocity / 2)


@pytest.mark.parametrize("dimensions", [2, 3])
def test_a_flock_of_nobody_takes_a_step(dimensions):
    nobody = np.zeros((0, dimensions))
    position, velocity = flock_step(nobody, nobody, 0.1, 1.0, WEIGHTS, 1.0, 1.0)
    assert position.shape == velocity.shape == (0, dimensions)


def test_cohesion_keeps_its_digits_far_from_the_origin():
    far = np.array([[2.0**40, 0.0], [2.0**40 + 0.25, 0.0], [2.0**40 + 0.75, 0.0]])
    pull = towards_mean(far, *neighbour_pairs(far, 1.0))
    assert pull[:, 0].tolist() == [0.5, 0.125, -0.625]


@pytest.mark.statement(1, oracle="the step's formula, by hand")
def test_a_step_of_two_boids_by_hand():
    position, velocity = np.array([[0.0, 0.0], [2.0, 0.0]]), np.array([[1.0, 0.0], [0.0, 1.0]])
    after, moving = flock_step(position, velocity, 0.5, 3.0, (4.0, 0.5, 0.25), 100.0, 100.0)
    # separation ∓1/2 · 4, alignment (−1, 1) and (1, −1) · ½, cohesion ±2 · ¼
    acceleration = np.array([[-2.0 - 0.5 + 0.5, 0.5], [2.0 + 0.5 - 0.5, -0.5]])
    assert moving == pytest.approx(velocity + acceleration / 2, abs=1e-15)
    assert after == pytest.approx(position + moving / 2, abs=1e-15)


def test_no_boid_is_faster_or_changes_faster_than_it_may():
    rng = np.random.default_rng(RNG_SEED)
    position, velocity = rng.uniform(-1, 1, (2, 100, 3))
    velocity *= 0.5 / np.linalg.norm(velocity, axis=1)[:, None]
    _, moving = flock_step(position, velocity, 0.1, 1.0, (50.0, 1.0, 1.0), 0.6, 2.0)
    speed = np.linalg.norm(moving, axis=1)
    change = np.linalg.norm(moving - velocity, axis=1)
    assert speed.max() == pytest.approx(0.6, abs=1e-15)
    assert change.max() == pytest.approx(0.2, abs=1e-15)  # a_max dt; the limit of speed only brings it back


@pytest.mark.statement(1, oracle="rotation, translation, Galilean boost and renumbering of the scene")
@given(st.integers(0, 1000))
def test_a_flock_turns_moves_and_renumbers_with_the_scene(seed):
    rng = np.random.default_rng(seed)
    position, velocity = rng.uniform(-2, 2, (2, 40, 3))
    turn, shift, order = rotation(rng), rng.normal(size=3), rng.permutation(40)
    after, moving = flock_step(position, velocity, 0.1, 1.5, WEIGHTS, 3.0, 5.0)
    args = (0.1, 1.5, WEIGHTS, 3.0, 5.0)
    turned, turning = flock_step(position @ turn.T + shift, velocity @ turn.T, *args)
    # 1e-11: two boids may be as near as 1e-2 m, where rounding of 1e-15 m turns into 1e-11 of a push of 100/m
    assert np.abs(turned - (after @ turn.T + shift)).max() < 1e-11
    assert np.abs(turning - moving @ turn.T).max() < 1e-11
    renumbered, _ = flock_step(position[order], velocity[order], *args)
    assert np.abs(renumbered - after[order]).max() < 1e-12  # sums in another order
    boosted, _ = flock_step(position, velocity + shift, 0.1, 1.5, WEIGHTS, math.inf, 5.0)
    free, _ = flock_step(position, velocity, 0.1, 1.5, WEIGHTS, math.inf, 5.0)
    assert np.abs(boosted - (free + shift * 0.1)).max() < 1e-12


@pytest.mark.statement(
    1, oracle="linear theory: everybody sees everybody, so differences decay as (1 − w n/(n − 1) dt)"
)
def test_alignment_alone_approaches_the_mean_velocity_at_its_weight():
    rng = np.random.default_rng(RNG_SEED)
    count, rate, dt, steps = 20, 0.8, 0.05, 40
    position, velocity = rng.uniform(0, 0.1, (count, 3)), rng.normal(size=(count, 3))
    mean, start = velocity.mean(axis=0), velocity - velocity.mean(axis=0)
    for _ in range(steps):
        position, velocity = flock_step(position, velocity, dt, 100.0, (0.0, rate, 0.0), math.inf, math.inf)
    decay = (1 - rate * count / (count - 1) * dt) ** steps
    assert np.abs(velocity - mean - decay * start).max() < 1e-13  # rounding of 40 steps with numbers of order 1


def test_two_boids_come_to_rest_where_separation_balances_cohesion():
    position, velocity = np.array([[0.0, 0.0], [0.4, 0.3]]), np.zeros((2, 2))
    for _ in range(800):
        position, velocity = flock_step(position, velocity, 0.05, 5.0, (1.0, 1.0, 0.25), 10.0, 100.0)
    # 1/d = d/4 at d = 2; alignment has calmed the oscillation: exp(−40) of it is left
    assert np.linalg.norm(position[1] - position[0]) == pytest.approx(2.0, abs=1e-12)


def test_a_flock_step_leaves_what_enters_as_it_was():
    rng = np.random.default_rng(RNG_SEED)
    position, velocity = rng.uniform(-1, 1, (2, 30, 2))
    before = position.copy(), velocity.copy()
    flock_step(position, velocity, 0.1, 1.0, WEIGHTS, 0.1, 0.1)
    assert np.array_equal(position, before[0])
    assert np.array_equal(velocity, before[1])


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        ({"dt": 0.0}, "dt must be positive, not 0"),
        ({"radius": -1.0}, "radius must be positive, not -1"),
        ({"max_speed": -1.0}, "max_speed must be zero or positive, not -1"),
        ({"max_acceleration": math.nan}, "max_acceleration must be zero or positive, not nan"),
        ({"velocity": np.zeros((3, 2))}, r"velocity must have the shape \(2, 2\) of the positions, not \(3, 2\)"),
    ],
)
def test_a_flock_step_that_makes_no_sense_is_refused(change, complaint):
    sound = {
        "position": np.zeros((2, 2)),
        "velocity": np.zeros((2, 2)),
        "dt": 0.1,
        "radius": 1.0,
        "weights": WEIGHTS,
        "max_speed": 1.0,
        "max_acceleration": 1.0,
    }
    with pytest.raises(ValueError, match=complaint):
        flock_step(**(sound | change))
