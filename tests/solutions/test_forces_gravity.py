from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles import oracle

from solutions import as_printed
from solutions.forces import (
    GRAVITATIONAL_CONSTANT,
    STANDARD_GRAVITY,
    mutual_gravity,
    surface_gravity,
    uniform_gravity,
    universal_gravity,
    universal_gravity_energy,
    velocity_verlet,
)

EARTH, EARTH_RADIUS = 5.9722e24, 6.371e6  # kg and mean radius, m (IAU)
ORIGIN = np.zeros(3)
COMPONENT = st.floats(-10, 10).map(lambda value: round(value, 6))  # no numbers that vanish when squared
PLACE = st.tuples(COMPONENT, COMPONENT, COMPONENT).map(np.array)
MASS = st.floats(0, 1e12)
SOFTENING = st.one_of(st.just(0.0), st.floats(1e-3, 10))
RNG_SEED = 5


# Two bodies


@pytest.mark.statement(25, oracle="the table value of the moon's pull, 1.98e20 N")
def test_the_earth_pulls_the_moon_with_the_force_of_the_text_books():
    force = universal_gravity(7.346e22, EARTH, (3.844e8, 0.0, 0.0), ORIGIN)
    assert force == pytest.approx([-1.98e20, 0, 0], rel=5e-3, abs=0)  # three digits are in the books


@pytest.mark.statement(25, oracle="arithmetic on a 2-3-6-7 triangle")
def test_the_pull_points_to_the_other_body_and_obeys_the_inverse_square():
    force = universal_gravity(3.0, 5.0, (1.0, 1.0, 1.0), (3.0, 4.0, 7.0))
    # Ten roundings
    assert force == pytest.approx(GRAVITATIONAL_CONSTANT * 15 / 49 * np.array([2, 3, 6]) / 7, rel=1e-15, abs=0)


@given(MASS, MASS, PLACE, PLACE, SOFTENING)
def test_body_1_pulls_body_2_as_body_2_pulls_body_1(mass_1, mass_2, place_1, place_2, softening):
    on_1 = universal_gravity(mass_1, mass_2, place_1, place_2, softening)
    assert np.array_equal(universal_gravity(mass_2, mass_1, place_2, place_1, softening), -on_1)


@given(PLACE, PLACE, SOFTENING, st.integers(0, 99))
def test_turning_and_shifting_both_bodies_turns_the_pull(place_1, place_2, softening, seed):
    rng = np.random.default_rng(seed)
    turn, shift = np.linalg.qr(rng.normal(size=(3, 3)))[0], rng.normal(size=3)
    if np.linalg.norm(place_1 - place_2) < 1e-3:
        return  # shifting them would change how far they are apart by rounding
    force = universal_gravity(1e10, 1.0, place_1, place_2, softening)
    turned = universal_gravity(1e10, 1.0, turn @ place_1 + shift, turn @ place_2 + shift, softening)
    # A distance above 1e-3 between places up to 30 m: rounded to 1e-11 of itself, and it enters by its cube
    assert turned == pytest.approx(turn @ force, rel=1e-10, abs=1e-10 * np.linalg.norm(force))


@pytest.mark.parametrize("softening", [0.0, 0.5])
def test_bodies_at_the_same_place_do_not_pull_each_other(softening):
    assert universal_gravity(1e12, 1e12, (1.0, 2.0, 3.0), (1.0, 2.0, 3.0), softening).tolist() == [0, 0, 0]


def test_only_softening_bounds_the_energy_of_points_at_one_place():
    assert universal_gravity_energy(2.0, 3.0, ORIGIN, ORIGIN) == -math.inf
    assert universal_gravity_energy(2.0, 3.0, ORIGIN, ORIGIN, 0.5) == -GRAVITATIONAL_CONSTANT * 12
    assert universal_gravity_energy(0.0, 3.0, ORIGIN, ORIGIN) == 0


@pytest.mark.statement(25, oracle="Plummer's formula for the greatest pull")
def test_a_softened_pull_is_strongest_at_its_length_over_root_two():
    distance = np.linspace(0.01, 3, 300)[:, None] * [1.0, 0, 0]
    pull = universal_gravity(1.0, 1e10, ORIGIN, distance, 1.0)[:, 0]
    assert distance[np.argmax(pull), 0] == pytest.approx(1 / math.sqrt(2), abs=0.01)  # the distances' spacing
    assert pull.max() == pytest.approx(GRAVITATIONAL_CONSTANT * 1e10 * 2 / 27**0.5, rel=1e-4, abs=0)  # flat at the top


@given(PLACE.filter(lambda place: np.linalg.norm(place) > 0.1), SOFTENING)
def test_the_pull_is_the_slope_of_the_energy(place, softening):
    step = 1e-5
    force = universal_gravity(1.0, 1e10, place, ORIGIN, softening)
    ahead, behind = (
        universal_gravity_energy(1.0, 1e10, place + sign * step * np.eye(3), ORIGIN, softening) for sign in (1, -1)
    )
    size = GRAVITATIONAL_CONSTANT * 1e10 / np.linalg.norm(place) ** 2
    # Central differences: (step/distance)² is 1e-8, and the rounding of the energies 1e-16 over a step of 1e-5
    assert -(ahead - behind) / (2 * step) == pytest.approx(force, abs=2e-7 * size)


# Falling


@pytest.mark.statement(25, oracle="G M of the Earth from satellites (WGS 84)")
def test_the_earth_gives_9_82_at_its_mean_radius():
    # WGS 84 knows G M to nine digits; G alone is known to 2.2e-5, and the mass with it
    assert surface_gravity(EARTH, EARTH_RADIUS) == pytest.approx(3.986004418e14 / EARTH_RADIUS**2, rel=5e-5, abs=0)
    assert surface_gravity(EARTH, EARTH_RADIUS) == pytest.approx(9.820, abs=5e-4)


@given(st.floats(1e-3, 1e3), st.floats(1e-3, 1e3))
def test_all_bodies_fall_alike_towards_a_planet(light, heavy):
    pulls = universal_gravity([light, heavy], EARTH, (0.0, 0.0, EARTH_RADIUS), ORIGIN)
    falls = pulls / np.array([light, heavy])[:, None]
    assert falls[0] == pytest.approx(falls[1], rel=1e-15, abs=0)
    assert -falls[0, 2] == pytest.approx(float(surface_gravity(EARTH, EARTH_RADIUS)), rel=1e-15, abs=0)


def test_near_the_ground_the_pull_of_the_planet_is_the_uniform_one():
    near = universal_gravity(2.0, EARTH, (0.0, 0.0, EARTH_RADIUS + 10.0), ORIGIN)
    uniform = uniform_gravity(2.0, (0.0, 0.0, -surface_gravity(EARTH, EARTH_RADIUS)))
    assert near == pytest.approx(uniform, rel=2 * 10 / EARTH_RADIUS * 1.01, abs=0)  # (1 + h/R)⁻², to first order −2h/R


@pytest.mark.erratum(25)
def test_thirty_two_feet_is_half_a_percent_short_of_standard_gravity():
    assert as_printed.gravity_in_feet() == pytest.approx(9.7536, abs=1e-12)  # one rounding
    assert 1 - as_printed.gravity_in_feet() / STANDARD_GRAVITY == pytest.approx(0.0054, abs=5e-5)
    assert as_printed.gravity_in_feet() != pytest.approx(
        9.8, rel=4e-3, abs=0
    )  # the two sides of the slide's own equation
    after_ten_seconds = (STANDARD_GRAVITY - as_printed.gravity_in_feet()) * 10**2 / 2
    assert after_ten_seconds == pytest.approx(2.65, abs=5e-3)  # m of a fall of 490 m


# Many bodies


@pytest.mark.statement(25, oracle="a double loop in exact fractions of the pairs")
def test_the_pull_on_each_of_many_is_the_sum_over_the_others():
    rng = np.random.default_rng(RNG_SEED)
    mass, place = rng.uniform(1, 2, size=6) * 1e10, rng.normal(size=(6, 3))
    together = mutual_gravity(mass, place, 0.1)
    for i in range(6):
        alone = [0.0, 0.0, 0.0]
        for j in range(6):
            d = [float(place[j, k] - place[i, k]) for k in range(3)]
            cube = (sum(x * x for x in d) + 0.01) ** 1.5
            for k in range(3):
                alone[k] += 6.6743e-11 * mass[i] * mass[j] * d[k] / cube
        assert together[i] == pytest.approx(alone, rel=1e-12, abs=0)  # some dozens of roundings


def test_the_forces_within_a_group_cancel_and_turn_nothing():
    rng = np.random.default_rng(RNG_SEED)
    place = rng.normal(size=(4, 7, 3))
    force = mutual_gravity(rng.uniform(1, 2, size=(4, 7)) * 1e10, place)
    size = np.abs(force).sum()
    assert force.sum(axis=1) == pytest.approx(np.zeros((4, 3)), abs=1e-15 * size)
    assert np.cross(place, force).sum(axis=1) == pytest.approx(np.zeros((4, 3)), abs=1e-14 * size)


def test_groups_keep_their_own_softening():
    place = np.array([[[0, 0, 0], [1, 0, 0]]] * 2, dtype=float)
    pulls = mutual_gravity(np.full(2, 1.0), place, [0.0, 1.0])[:, 0, 0]
    assert pulls == pytest.approx(GRAVITATIONAL_CONSTANT * np.array([1, 8**-0.5]), rel=1e-15, abs=0)


def test_a_single_body_does_not_pull_itself():
    assert mutual_gravity([1e12], [(1.0, 2.0, 3.0)]).tolist() == [[0, 0, 0]]


# An orbit


@pytest.mark.statement(25, oracle="scipy solve_ivp DOP853, and Kepler's third law")
@pytest.mark.parametrize("steps", [1000, pytest.param(4000, marks=pytest.mark.weekly)])
def test_an_ellipse_closes_after_keplers_period_and_keeps_its_energy(steps):
    integrate = oracle("scipy.integrate")
    mass = 1 / GRAVITATIONAL_CONSTANT  # G M = 1
    position, velocity = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.2, 0.0])
    axis = 1 / (2 - 1.2**2)  # vis-viva: v² = 2/r − 1/a
    period = 2 * math.pi * axis**1.5

    def pull(x):
        return universal_gravity(1.0, mass, x, ORIGIN)

    def rate(_, state):
        return np.concatenate([state[3:], pull(state[:3])])

    start = np.concatenate([position, velocity])
    found = integrate.solve_ivp(rate, (0, period), start, method="DOP853", rtol=1e-12, atol=1e-14)
    assert found.y[:, -1] == pytest.approx(start, abs=1e-9)  # the solver's error over some hundred steps

    path = [(position, velocity)]
    for _ in range(steps):
        path.append(velocity_verlet(*path[-1], lambda p, _: pull(p), period / steps))
    positions, velocities = np.moveaxis(path, 1, 0)
    energy = np.vecdot(velocities, velocities) / 2 + universal_gravity_energy(1.0, mass, positions, ORIGIN)
    assert energy[0] == pytest.approx(-1 / (2 * axis), rel=1e-14, abs=0)
    # In 4000 steps dt = 0.0037: late by some (ω dt)² = 1.4e-5 a radian, so 9e-5 over the turn, at 1.2 m/s; the energy
    # swings by less, and comes back to an order higher
    coarser = 4000 / steps
    assert positions[-1] == pytest.approx([1, 0, 0], abs=2e-4 * coarser**2)
    assert np.abs(energy - energy[0]).max() < 1e-5 * coarser**2
    assert abs(energy[-1] - energy[0]) < 1e-8 * coarser**3


# Input


@pytest.mark.parametrize(
    ("call", "named"),
    [
        (lambda: uniform_gravity(-1.0, (0, 0, -9.81)), "mass must be zero or positive, not -1"),
        (lambda: uniform_gravity([1.0, math.inf], (0, 0, -9.81)), "mass must be finite, not inf"),
        (lambda: uniform_gravity(math.nan, (0, 0, -9.81)), "mass must be zero or positive, not nan"),
        (lambda: uniform_gravity(1.0, (0, -9.81)), r"gravity must have shape \(\.\.\., 3\), not \(2,\)"),
        (lambda: surface_gravity(EARTH, 0.0), "distance must be positive, not 0"),
        (lambda: surface_gravity(-1.0, 1.0), "mass must be"),
        (lambda: surface_gravity(math.inf, 1.0), "mass must be finite"),
        (lambda: universal_gravity(-1.0, 1.0, ORIGIN, ORIGIN), "mass_1 must be"),
        (lambda: universal_gravity(1.0, -1.0, ORIGIN, ORIGIN), "mass_2 must be"),
        (lambda: universal_gravity(math.inf, 1.0, ORIGIN, ORIGIN), "mass_1 must be finite"),
        (lambda: universal_gravity(1.0, math.inf, ORIGIN, ORIGIN), "mass_2 must be finite"),
        (lambda: universal_gravity(1.0, 1.0, ORIGIN[:2], ORIGIN), "position_1 must have shape"),
        (lambda: universal_gravity(1.0, 1.0, ORIGIN, 1.0), "position_2 must have shape"),
        (lambda: universal_gravity(1.0, 1.0, ORIGIN, ORIGIN, -0.1), "softening must be zero or positive, not -0.1"),
        (lambda: mutual_gravity([1.0], 3.0), "position must have shape"),
    ],
)
def test_masses_and_lengths_without_meaning_are_refused_by_name(call, named):
    with pytest.raises(ValueError, match=named):
        call()


def test_a_place_of_nan_gives_a_force_of_nan():
    assert np.isnan(universal_gravity(1.0, 1.0, (math.nan, 0, 0), ORIGIN)).all()


def test_many_pairs_at_once_are_the_same_as_one_after_another():
    rng = np.random.default_rng(RNG_SEED)
    masses, softening, places = (
        rng.uniform(1, 2, size=(2, 4, 5)),
        rng.uniform(size=(4, 5)),
        rng.normal(size=(2, 4, 5, 3)),
    )
    arrays = [*masses, *places, softening]
    for array in arrays:
        array.flags.writeable = False  # writing to one would raise
    force, energy = universal_gravity(*arrays), universal_gravity_energy(*arrays)
    assert force.shape == (4, 5, 3)
    assert energy.shape == (4, 5)
    for at in np.ndindex(4, 5):
        # Sums over the last axis may be grouped differently in a batch
        assert force[at] == pytest.approx(universal_gravity(*(array[at] for array in arrays)), rel=1e-14, abs=0)
        assert energy[at] == pytest.approx(
            float(universal_gravity_energy(*(array[at] for array in arrays))), rel=1e-14, abs=0
        )
