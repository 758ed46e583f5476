"""Free rotation: against Jacobi's elliptic functions, scipy's integrator and closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles import oracle

from solutions.impulse import rotation_matrix
from solutions.world.rotation import quaternion_product, turn_freely, turned

MOMENTS = np.array([1.0, 2.0, 3.0])
TURNED = np.array([0.5, 0.1, -0.7, 0.5])  # of length 1
ROUNDING = 1e-15
"""What a step may change of the angular momentum, as a share: a few roundings of the last digit."""

QUATERNION = (
    st.tuples(*[st.floats(-1, 1)] * 4)
    .map(np.array)
    .filter(lambda q: np.linalg.norm(q) > 1e-3)
    .map(lambda q: q / np.linalg.norm(q))
)


def to_body(orientation, vector):
    return (vector[..., None, :] @ rotation_matrix(orientation))[..., 0, :]


def to_world(orientation, vector):
    return (rotation_matrix(orientation) @ vector[..., None])[..., 0]


def angular_momentum(orientation, spin, moments):
    return to_world(orientation, moments * to_body(orientation, spin))


def run(orientation, spin, moments, dt, count):
    """All states from the start on, (count + 1, ..., 4) and (count + 1, ..., 3)."""
    states = [(orientation, spin)]
    for _ in range(count):
        states.append(turn_freely(*states[-1], moments, dt))
    return tuple(np.array(part) for part in zip(*states, strict=True))


def rotation(quaternion):
    """The same rotation as scipy's, whose quaternions have w last."""
    return oracle("scipy.spatial.transform").Rotation.from_quat(np.roll(quaternion, -1, axis=-1))


def jacobi(spin, time):
    """Spin about the axes with the moments 1, 2, 3 (Landau and Lifshitz, Mechanics, § 37), and the half period.

    The start must lie on a curve around axis 3, with a positive spin about it.
    """
    special = oracle("scipy.special")
    i1, i2, i3 = MOMENTS
    twice_energy, squared = np.sum(MOMENTS * spin**2), np.sum((MOMENTS * spin) ** 2)
    assert squared > twice_energy * i2
    assert spin[2] > 0
    near, far = twice_energy * i3 - squared, squared - twice_energy * i1
    size = np.sqrt([near / (i1 * (i3 - i1)), near / (i2 * (i3 - i2)), far / (i3 * (i3 - i1))])
    rate, m = np.sqrt((i3 - i2) * far / (i1 * i2 * i3)), (i2 - i1) * near / ((i3 - i2) * far)
    start = special.ellipkinc(np.arctan2(spin[1] / size[1], spin[0] / size[0]), m)
    sn, cn, dn, _ = special.ellipj(start + rate * np.asarray(time), m)
    return size * np.stack([cn, sn, dn], axis=-1), 2 * special.ellipk(m) / rate


def test_an_asymmetric_top_follows_jacobis_elliptic_functions():
    start, until = np.array([3.0, 5.0, 7.0]), 0.5
    expected, _ = jacobi(start, until)
    error = []
    for count in (50, 100):
        orientation, spin = run(TURNED, to_world(TURNED, start), MOMENTS, until / count, count)
        error.append(to_body(orientation[-1], spin[-1]) - expected)
    assert error[0] == pytest.approx(4 * error[1], rel=0.05)  # second order; what is left is of a higher one
    assert np.linalg.norm(error[1]) < 1.8e-2  # (ω dt)² = 2e-3 times the spin of 9 rad/s


def test_the_orientation_of_a_top_is_that_of_scipys_integrator():
    # moments out of order, so that no axis has a role of its own; the start is on a curve around the smallest
    moments, start, until = np.array([2.0, 3.0, 1.0]), np.array([1.0, -0.5, 3.0]), 2.0

    def rates(_, state):
        w, x, y, z, *spin = state
        s = np.array(spin)
        matrix = np.array([[-x, -y, -z], [w, -z, y], [z, w, -x], [-y, x, w]])  # q̇ = q ω/2, ω in the body
        return np.concatenate([matrix @ s / 2, np.cross(moments * s, s) / moments])

    solved = oracle("scipy.integrate").solve_ivp(
        rates, (0, until), np.concatenate([TURNED, start]), "DOP853", rtol=1e-12, atol=1e-12
    )
    expected = rotation(solved.y[:4, -1])
    error = []
    for count in (50, 100):
        orientation, _ = run(TURNED, to_world(TURNED, start), moments, until / count, count)
        error.append((rotation(orientation[-1]) * expected.inv()).as_rotvec())
    assert error[0] == pytest.approx(4 * error[1], rel=0.05)  # second order; what is left is of a higher one
    assert np.linalg.norm(error[1]) < 4e-3  # (ω dt)², in rad


@pytest.mark.parametrize(
    "moments",
    [(2.0, 2.0, 0.7), (1.0, 1.0, 1.9), (0.7, 2.0, 2.0), (2.0, 1.5, 2.0), (1.0, 1.0, 0.0), (0.0, 1.0, 1.0)],
    ids=["long", "flat", "long along x", "flat along y", "rod", "rod along x"],
)
def test_a_symmetric_top_turns_about_its_axis_and_about_l_at_steady_rates(moments):
    moments, start, until = np.array(moments), np.array([1.0, 2.0, 1.6]), 1.0
    own = int(np.argmax([np.ptp(np.delete(moments, axis)) == 0 for axis in range(3)]))
    across = moments[own - 1]
    spin = to_world(TURNED, start)
    precession = angular_momentum(TURNED, spin, moments) / across
    turn = np.zeros(3)
    turn[own] = (1 - moments[own] / across) * start[own]
    vector = oracle("scipy.spatial.transform").Rotation.from_rotvec
    expected = vector(precession * until) * rotation(TURNED) * vector(turn * until)
    for count in (1, 50):
        orientation, after = run(TURNED, spin, moments, until / count, count)
        error = np.linalg.norm((rotation(orientation[-1]) * expected.inv()).as_rotvec())
        assert error < 1e-13  # each step is exact, and some 50 of them leave roundings
        assert to_body(orientation[-1], after[-1])[own] == pytest.approx(start[own], rel=1e-12)


def test_a_top_spun_about_its_middle_axis_flips_at_jacobis_half_period():
    start, dt = np.array([0.1, 5.0, 0.3]), 0.01
    _, half_period = jacobi(start, 0.0)
    orientation, spin = run(TURNED, to_world(TURNED, start), MOMENTS, dt, int(1.6 * half_period / dt))
    about_middle = to_body(orientation, spin)[:, 1]
    before = np.flatnonzero(about_middle[:-1] * about_middle[1:] < 0)
    crossing = dt * (before + about_middle[before] / (about_middle[before] - about_middle[before + 1]))
    assert np.diff(crossing) == pytest.approx([half_period], rel=2e-3)  # (ω dt)² = 2.5e-3, and a share of it
    assert np.max(np.abs(about_middle)) == pytest.approx(5.0, rel=1e-3)  # it comes to stand upside down


def test_angular_momentum_stays_to_rounding_at_steps_however_coarse():
    rng = np.random.default_rng(7)
    orientation, spin = rng.normal(size=(6, 4)), 5 * rng.normal(size=(6, 3))
    orientation /= np.linalg.norm(orientation, axis=-1, keepdims=True)
    moments = np.array([[1, 2, 3], [3, 1, 2], [0.01, 2, 2], [1, 1, 2], [2, 2, 0], [1, 1, 1]])
    before = angular_momentum(orientation, spin, moments)
    count = 100
    states = run(orientation, spin, moments, 0.2, count)  # a radian a step
    change = np.linalg.norm(angular_momentum(states[0][-1], states[1][-1], moments) - before, axis=-1)
    ratio = np.array([3, 3, 200, 2, 1, 1])  # of the moments: the roundings of a large one disturb a small one
    assert np.all(change < ROUNDING * ratio * count * np.linalg.norm(before, axis=-1))


def energy_errors(start, dt, count):
    """Of the kinetic energy, as a share of it at the start, after each step."""
    orientation, spin = run(TURNED, to_world(TURNED, np.array(start)), MOMENTS, dt, count)
    energy = np.sum(MOMENTS * to_body(orientation, spin) ** 2, axis=-1) / 2
    return energy / energy[0] - 1


def swing_of_energy(start):
    """The largest error of the energy, as a share of it and divided by dt², to lowest order in dt.

    A step is half of A, all of B and half of A, with A = α M_1²/2 and B = β M_0²/2. By the series of Baker, Campbell
    and Hausdorff it keeps H + dt² F but for order dt⁴, with F = ±({A, {A, B}} + 2 {B, {A, B}})/24. From the brackets
    {M_0, M_1} = M_2, and so on in a circle, F becomes what stands below. M keeps its length and, to this order, its
    energy, so that M_1² = x and M_0² = z follow from M_2² = y, which runs as far as neither is negative.
    """
    momentum, a = MOMENTS * start, 1 / MOMENTS
    length, energy, alpha, beta = momentum @ momentum, a @ momentum**2 / 2, a[1] - a[2], a[0] - a[2]

    def f(x, y, z):
        return (alpha**2 * beta * x * (z - y) + 2 * alpha * beta**2 * z * (y - x)) / 24

    rest = 2 * energy - a[2] * length  # α x + β z, while x + z = length − y
    y = np.linspace(max(0, length - rest / alpha), length - rest / beta, 1001)  # a parabola: 1e-6 beside its extreme
    x, z = (beta * (length - y) - rest) / (beta - alpha), (rest - alpha * (length - y)) / (beta - alpha)
    return np.max(np.abs(f(x, y, z) - f(*momentum[[1, 2, 0]] ** 2))) / energy


def test_the_energy_of_a_fast_top_does_not_drift():
    start, dt = np.array([6.0, 10.0, 14.0]), 0.01
    swing = np.max(np.abs(energy_errors(start, dt, 200)))
    assert swing == pytest.approx(swing_of_energy(start) * dt**2, rel=(start @ start) * dt**2)  # the next order, 3.3e-2


@pytest.mark.parametrize("moments", [(0.01, 1.0, 1.005), (1.0, 0.004, 1.001), (1.3, 1.3, 1e-4)])
def test_a_slender_body_that_spins_keeps_its_energy_at_coarse_steps(moments):
    # At 60 steps a second it turns by a third of a radian about its own long axis in each. The midpoint rule
    # gains 15 % of energy here, or 137 times the energy, because a slight error of the orientation is a large spin
    # about this axis. Here the two large moments alone disturb each other, as far as they differ.
    moments = np.array(moments)
    start = np.where(moments < 0.1, 20.0, (3.0, 8.0, 5.0))
    orientation, spin = run(TURNED, to_world(TURNED, start), moments, 1 / 60, 120)
    energy = np.sum(moments * to_body(orientation, spin) ** 2, axis=-1) / 2
    assert energy == pytest.approx(energy[0], rel=1e-3)


@pytest.mark.parametrize(
    ("dt", "until"),
    [pytest.param(0.01, 100, marks=pytest.mark.slow), pytest.param(0.001, 10, marks=pytest.mark.weekly)],
)
def test_the_energy_of_a_top_is_kept_over_a_long_time(dt, until):
    start = np.array([3.0, 5.0, 7.0])
    swing = np.max(np.abs(energy_errors(start, dt, round(until / dt))))  # a drift would add to it with the time
    assert swing == pytest.approx(swing_of_energy(start) * dt**2, rel=(start @ start) * dt**2)


def test_keeping_the_spin_instead_breaks_angular_momentum_by_63_percent():
    spin, dt, count = np.array([1.0, 1.0, 0.0]), 0.01, 240  # half a turn at √2 rad/s takes 2.2 s
    upright = np.array([1.0, 0, 0, 0])
    kept = turned(upright, spin * dt * np.arange(count)[:, None])
    start = MOMENTS * spin
    broken = np.linalg.norm(angular_momentum(kept, spin, MOMENTS) - start, axis=-1) / np.linalg.norm(start)
    assert np.max(broken) == pytest.approx(2 / math.sqrt(10), rel=1e-4)  # twice the sine between spin and momentum
    assert np.vecdot(angular_momentum(kept, spin, MOMENTS), spin) == pytest.approx(3.0)  # and the energy looks right
    orientation, after = run(upright, spin, MOMENTS, dt, count)
    assert angular_momentum(orientation, after, MOMENTS) == pytest.approx(np.tile(start, (count + 1, 1)), abs=1e-12)
    assert np.max(np.abs(to_body(orientation, after)[:, 2])) > 0.5  # it tumbles: this began with 0


@pytest.mark.parametrize("moments", [(2.0, 2.0, 2.0), (np.inf, np.inf, np.inf), (np.inf, 1.0, np.inf), (0.0, 0.0, 0.0)])
def test_a_ball_and_a_driven_body_keep_their_spin_to_the_last_bit(moments):
    spin = np.array([3.0, -40.0, 11.0])
    orientation, after = turn_freely(TURNED, spin, moments, 0.3)  # two turns in one step
    assert np.array_equal(after, spin)
    expected = oracle("scipy.spatial.transform").Rotation.from_rotvec(0.3 * spin) * rotation(TURNED)
    assert rotation(orientation).as_matrix() == pytest.approx(expected.as_matrix(), abs=1e-14)  # of 12 rad


@given(QUATERNION, QUATERNION, st.tuples(*[st.floats(-10, 10)] * 3))
def test_rotations_follow_one_another_as_in_scipy(second, first, vector):
    expected = rotation(second) * rotation(first)
    assert rotation(quaternion_product(second, first)).as_matrix() == pytest.approx(expected.as_matrix(), abs=2e-15)
    expected = oracle("scipy.spatial.transform").Rotation.from_rotvec(vector) * rotation(first)
    assert rotation(turned(first, vector)).as_matrix() == pytest.approx(expected.as_matrix(), abs=1e-14)


@pytest.mark.parametrize("tiny", [0.0, 5e-324, 1e-200, 1e-9])
def test_a_turn_by_a_tiny_angle_or_none_is_half_the_rotation(tiny):
    after = turned((1.0, 0, 0, 0), (0.0, tiny, 0))
    assert np.array_equal(after, [1.0, 0, tiny / 2, 0])


def test_the_length_of_an_orientation_stays_1_over_many_turns():
    orientation = TURNED
    for _ in range(1000):
        orientation = turned(orientation, (0.1, -0.2, 0.05))
    assert np.linalg.norm(orientation) == pytest.approx(1.0, abs=3e-16)  # the last digit, not a sum of 1000 of them


def test_bodies_of_all_kinds_turn_together_as_each_does_alone():
    rng = np.random.default_rng(3)
    moments = np.array([[1, 1, 1], [1, 2, 3], [np.inf, np.inf, np.inf], [0, 1, 1], [3, 1, 2]])
    orientation, spin, dt = rng.normal(size=(2, 5, 4)), rng.normal(size=(5, 3)), np.array([[0.1], [-0.02]])
    orientation /= np.linalg.norm(orientation, axis=-1, keepdims=True)
    given_values = orientation.copy(), spin.copy()
    together = turn_freely(orientation, spin, moments, dt)
    for row, body in np.ndindex(2, 5):
        alone = turn_freely(orientation[row, body], spin[body], moments[body], dt[row, 0])
        for whole, one in zip(together, alone, strict=True):
            assert whole[row, body] == pytest.approx(one, abs=1e-15)  # sums in another order
    assert np.array_equal(orientation, given_values[0])
    assert np.array_equal(spin, given_values[1])


def test_what_cannot_be_turned_is_refused_by_name():
    good = {"orientation": TURNED, "angular_velocity": np.ones(3), "moments": MOMENTS, "dt": 0.1}
    wrong = {
        "orientation": [np.ones(4), np.ones(3), np.full(4, np.nan)],
        "angular_velocity": [np.full(3, np.inf), np.ones(2)],
        "moments": [-MOMENTS, np.full(3, np.nan), 1.0],
        "dt": [np.inf, np.nan],
    }
    for name, values in wrong.items():
        for value in values:
            with pytest.raises(ValueError, match=name):
                turn_freely(**{**good, name: value})
    with pytest.raises(ValueError, match="rotation"):
        turned(TURNED, (0.0, np.nan, 0))
    with pytest.raises(ValueError, match="first"):
        quaternion_product(TURNED, np.ones(4))
