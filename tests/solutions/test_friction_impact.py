"""Friction in an impact: grip and slip, against the closed form, impacts in small steps, three modes, and pymunk."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from oracles import oracle

from reference import truth
from solutions.friction import (
    friction_impulse,
    impact_energy,
    point_inverse_mass,
    sphere_impact,
)

UP = np.array([0.0, 0.0, 1.0])
SPEED = st.floats(0.1, 5).map(lambda value: round(value, 6))
SLIP = st.floats(-5, 5).map(lambda value: round(value, 6))
RESTITUTION, FRICTION = st.floats(0, 1), st.floats(0, 2)
ARM = st.floats(-1, 1).map(lambda value: round(value, 3))


def body(seed):
    """Inverse mass, inverse inertia and arm of some body."""
    rng = np.random.default_rng(seed)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    # principal moments that a real body can have: sums of two squares of radii
    radii = rng.uniform(0.1, 0.5, size=3) ** 2
    return rng.uniform(0.2, 3), turn @ np.diag(1 / (radii.sum() - radii)) @ turn.T, rng.normal(size=3) * 0.3


def plane_matrix(arm_x, arm_z, inertia):
    """K of a body of 1 kg that moves in the x–z plane alone."""
    return point_inverse_mass(1.0, np.diag([0, 1 / inertia, 0]), (arm_x, 0.0, arm_z)) + np.diag([0, 1.0, 0])


# The matrix of a contact


@pytest.mark.statement(16, oracle="velocities of the point before and after, by Newton and Euler")
@given(st.integers(0, 10_000))
def test_an_impulse_changes_the_velocity_of_its_point_by_k_j(seed):
    inverse_mass, inverse_inertia, arm = body(seed)
    rng = np.random.default_rng(seed + 1)
    j, v, spin = rng.normal(size=(3, 3))
    before = v + np.cross(spin, arm)
    after = v + inverse_mass * j + np.cross(spin + inverse_inertia @ np.cross(arm, j), arm)
    k = point_inverse_mass(inverse_mass, inverse_inertia, arm)
    assert after - before == pytest.approx(k @ j, abs=1e-12)  # rounding of numbers up to some hundred
    assert np.array_equal(k, k.T) or k == pytest.approx(k.T, abs=1e-12)
    assert np.linalg.eigvalsh(k)[0] >= inverse_mass * (1 - 1e-12)  # never heavier than the whole body


def test_an_immovable_body_does_not_give_way():
    assert np.array_equal(point_inverse_mass(0.0, np.zeros((3, 3)), (1.0, 2.0, 3.0)), np.zeros((3, 3)))


def test_a_body_on_a_pivot_that_cannot_be_stopped_is_refused():
    # K r = 0: whether rounding leaves the determinant at 1e-18, 0 or −1e-18 must not decide between nonsense and a word
    for seed in range(50):
        arm = np.random.default_rng(seed).normal(size=3)
        k = point_inverse_mass(0.0, np.eye(3), arm)
        assert k @ arm == pytest.approx(np.zeros(3), abs=1e-14)  # rounding of the cubes of arms up to 3
        with pytest.raises(ValueError, match=r"^inverse_mass must be positive definite"):
            friction_impulse(-UP, UP, k, 0.5, 0.5)
        # One part in 1e6 of a mass beside it, and it is stopped
        j = friction_impulse(-UP, UP, k + 1e-6 * np.eye(3), 0.5, 0.0)
        assert UP @ (k + 1e-6 * np.eye(3)) @ j == pytest.approx(1.5, rel=1e-9)  # ten digits less six, and some


# Grip or slip


@pytest.mark.statement(16, oracle="the closed form for a spinning sphere")
@given(SPEED, SLIP, RESTITUTION, FRICTION)
def test_a_spinning_ball_leaves_the_floor_as_the_closed_form_says(speed, surface_speed, restitution, friction):
    radius = 0.3
    v, spin = sphere_impact(-speed * UP, (0.0, surface_speed / radius, 0.0), UP, radius, restitution, friction)
    # spin about +y moves the lowest point towards −x, so that friction drives the ball towards +x
    along, left = truth.spinning_impact(speed, surface_speed, restitution, friction)
    assert v == pytest.approx([along, 0.0, restitution * speed], abs=1e-14)  # rounding of 5 m/s
    assert radius * spin == pytest.approx([0.0, left, 0.0], abs=1e-14)


def small_impulses(velocity, spin, radius, restitution, friction, count=4000):
    """An impact in many small normal impulses, each with Coulomb friction against the slip at that moment (Routh).

    friction: (n,), one ball for each; velocity and spin afterwards, (n, 3).
    """
    v, w = (np.tile(start, (len(friction), 1)) for start in (velocity, spin))
    across = np.array([[0, radius, 0], [-radius, 0, 0], [0, 0, 0]])  # w @ across = w × (−r n)
    normal_impulse = -(1 + restitution) * velocity[2] / count
    most = friction[:, None] * normal_impulse
    for _ in range(count):
        slip = (v + w @ across) * [1, 1, 0]
        size = np.linalg.norm(slip, axis=-1, keepdims=True)
        j = -slip * np.minimum(2 / 7, most / np.where(size > 0, size, 1.0)) + normal_impulse * UP
        v, w = v + j, w - j @ across / (0.4 * radius**2)
    return v, w


@pytest.mark.statement(16, oracle="the impact in small impulses")
def test_an_oblique_spinning_ball_leaves_as_after_many_small_impulses():
    velocity, spin, friction = np.array([1.0, -0.4, -2.0]), np.array([3.0, 7.0, -5.0]), np.array([0.0, 0.05, 0.2, 1.0])
    ours = sphere_impact(velocity, spin, UP, 0.2, 0.6, friction)
    for value, expected in zip(ours, small_impulses(velocity, spin, 0.2, 0.6, friction), strict=True):
        assert value == pytest.approx(expected, abs=1e-11)  # rounding of 4000 sums of tens


@pytest.mark.statement(16, oracle="seven halves of mu (1 + e) v, and the slip that is left")
@given(SPEED, st.floats(0, 10), RESTITUTION, FRICTION, st.floats(0.05, 2))
def test_a_solid_sphere_grips_up_to_seven_halves_of_mu_one_plus_e_v(speed, slip, restitution, friction, radius):
    limit = 3.5 * friction * (1 + restitution) * speed
    assume(abs(slip - limit) > 1e-9)  # rounding decides at the limit
    v, spin = sphere_impact((slip, 0.0, -speed), np.zeros(3), UP, radius, restitution, friction)
    left = v[0] - radius * spin[1]
    assert left == pytest.approx(max(0.0, slip - limit), abs=1e-12)  # rounding of some tens


def test_a_hollow_ball_grips_with_less_friction():
    # slip changes by (1 + 3/2) J/m instead of 7/2: grips up to 5/2 μ (1 + e) v
    v, spin = sphere_impact((4.0, 0.0, -1.0), np.zeros(3), UP, 1.0, 1.0, 0.5, inertia_share=2 / 3)
    assert v[0] - spin[1] == pytest.approx(4.0 - 2.5, abs=1e-14)


def test_a_sphere_is_struck_by_the_impulse_of_any_two_bodies():
    rng = np.random.default_rng(5)
    v, w, n = rng.normal(size=(3, 50, 3))
    n /= np.linalg.norm(n, axis=-1, keepdims=True)
    arm = -0.3 * n
    k = point_inverse_mass(1.0, np.eye(3) / (0.4 * 0.3**2), arm)
    j = friction_impulse(v + np.cross(w, arm), n, k, 0.6, 0.2)
    after = sphere_impact(v, w, n, 0.3, 0.6, 0.2)
    assert after[0].tobytes() == (v + j).tobytes()  # bit for bit


# Any two bodies


def modes(u, k, e, mu):
    """Impact in the plane by trying all three modes: the ones whose own conditions hold. (J_t, J_n) each."""
    found = []
    matrix = np.array([[k[0][0], k[0][2]], [k[2][0], k[2][2]]])
    wanted = -(1 + e) * u[2]
    grip = np.linalg.solve(matrix, [-u[0], wanted])
    if grip[1] >= 0 and abs(grip[0]) <= mu * grip[1]:
        found.append(grip)
    for sign in (1.0, -1.0):  # of the slip that is left
        j = wanted / (matrix[1, 1] - sign * mu * matrix[1, 0])
        left = u[0] + matrix[0] @ [-sign * mu * j, j]
        if j > 0 and sign * left > 0:
            found.append(np.array([-sign * mu * j, j]))
    return found


@pytest.mark.statement(16, oracle="trying grip, slip forwards and slip backwards")
@given(ARM, ARM, st.floats(0.02, 1), SPEED, SLIP, RESTITUTION, FRICTION)
def test_in_the_plane_the_impact_takes_a_mode_whose_conditions_hold(
    arm_x, arm_z, inertia, speed, slip, restitution, friction
):
    k, u = plane_matrix(arm_x, arm_z, inertia), np.array([slip, 0.0, -speed])
    possible = modes(u, k, restitution, friction)
    assume(len(possible) > 0)
    j = friction_impulse(u, UP, k, restitution, friction)
    # a matrix of condition up to some thousand
    scale = 1e-10 * (1 + np.linalg.norm(j))
    assert any(np.linalg.norm(j[[0, 2]] - other) <= scale for other in possible)
    assert j[1] == 0


@pytest.mark.statement(16, oracle="Newton's restitution and Coulomb's cone")
@given(st.integers(0, 10_000), RESTITUTION, FRICTION)
def test_any_two_bodies_part_at_e_times_the_approach_within_the_cone(seed, restitution, friction):
    rng = np.random.default_rng(seed)
    n = np.linalg.qr(rng.normal(size=(3, 3)))[0][0]
    k = point_inverse_mass(*body(seed)) + point_inverse_mass(*body(seed + 1))
    u = rng.normal(size=3)
    j = friction_impulse(u, n, k, restitution, friction)
    if u @ n >= 0:
        assert np.array_equal(j, np.zeros(3))
        return
    after = u + k @ j
    assert after @ n == pytest.approx(-restitution * (u @ n), abs=1e-11)  # K up to some hundred, solved once
    across = j - (j @ n) * n
    assert j @ n > 0
    assert np.linalg.norm(across) <= friction * (j @ n) * (1 + 1e-9) + 1e-15
    if np.linalg.norm(across) < friction * (j @ n) * (1 - 1e-9) - 1e-12:
        assert after - (after @ n) * n == pytest.approx(np.zeros(3), abs=1e-11)  # inside the cone it grips


@given(st.integers(0, 10_000), RESTITUTION, FRICTION)
def test_exchanging_the_bodies_or_turning_the_scene_turns_the_impulse(seed, restitution, friction):
    rng = np.random.default_rng(seed)
    n, turn = np.linalg.qr(rng.normal(size=(3, 3)))[0][0], np.linalg.qr(rng.normal(size=(3, 3)))[0]
    k, u = point_inverse_mass(*body(seed)), rng.normal(size=3)
    j = friction_impulse(u, n, k, restitution, friction)
    scale = 1e-11 * (1 + np.linalg.norm(j))  # a 3 × 3 matrix solved twice
    assert friction_impulse(-u, -n, k, restitution, friction) == pytest.approx(-j, abs=scale)
    turned = friction_impulse(turn @ u, turn @ n, turn @ k @ turn.T, restitution, friction)
    assert turned == pytest.approx(turn @ j, abs=1e3 * scale)


def test_a_grazing_contact_gets_no_impulse_even_if_slip_is_coupled():
    # Stopping the slip of this rod would take a push along the normal one way, and a pull the other
    k = plane_matrix(-0.4, -0.3, 1 / 12)
    wanted = [np.linalg.solve(k, (-slip, 0.0, 0.0)) for slip in (0.5, -0.5)]
    assert sorted(np.sign([j[2] for j in wanted])) == [-1, 1]
    for slip in (0.5, -0.5):
        assert friction_impulse((slip, 0.0, 0.0), UP, k, 0.5, 10.0).tolist() == [0, 0, 0]
        assert friction_impulse((slip, 0.0, 1e-60), UP, k, 0.5, 10.0).tolist() == [0, 0, 0]


def test_friction_opposes_the_slip_that_is_left_after_a_reversal():
    # The rod of the energy below: the normal impulse alone turns its slip of +1/2 m/s to about −0.49 m/s
    k = plane_matrix(-0.4, -0.3, 1 / 12)
    assert (np.array([0.5, 0, -1]) + k @ friction_impulse((0.5, 0, -1.0), UP, k, 1.0, 0.0))[0] < -0.48
    # j (2.92 − 1.44 μ) = 2 with J_t = +μ j, along the first slip; in fractions, for μ = 1/10
    j = Fraction(2) / (Fraction(292, 100) - Fraction(144, 1000))
    left = Fraction(1, 2) + Fraction(208, 100) * j / 10 - Fraction(144, 100) * j
    assert left < 0
    found = friction_impulse((0.5, 0.0, -1.0), UP, k, 1.0, 0.1)
    assert found == pytest.approx([float(j / 10), 0.0, float(j)], abs=1e-15)
    # A slip that it would just not turn round is stopped: grip, however little friction there is
    turned = 1.44 * 2 / 2.92
    assert friction_impulse((turned, 0.0, -1.0), UP, k, 1.0, 1e-9)[0] == pytest.approx(0, abs=1e-15)


@given(st.integers(0, 10_000), RESTITUTION, st.integers(0, 20), st.integers(-20, 20), st.integers(-20, 20))
def test_units_of_mass_and_speed_change_only_the_numbers(seed, restitution, tenths, mass, speed):
    k, u, friction = point_inverse_mass(*body(seed)), np.random.default_rng(seed).normal(size=3), tenths / 10
    j = friction_impulse(u, UP, k, restitution, friction)
    # Powers of two, up to 1e6 and down to 1e-6, round nothing
    found = friction_impulse(u * 2.0**speed, UP, k * 2.0**-mass, restitution, friction)
    assert np.array_equal(found, j * 2.0 ** (mass + speed))
    assert impact_energy(u * 2.0**speed, found, k * 2.0**-mass) == impact_energy(u, j, k) * 2.0 ** (mass + 2 * speed)


def test_a_ball_against_a_very_heavy_one_acts_as_against_a_wall():
    light = point_inverse_mass(1.0, np.eye(3) / 0.4, -UP)
    heavy = point_inverse_mass(1e-6, np.eye(3) / 0.4e6, UP)
    for slip, grips in ((3.0, True), (4.0, False)):  # 7/2 × 1/2 × 2 × 1 is the limit
        u = np.array([slip, 0, -1.0])
        j = friction_impulse(u, UP, light + heavy, 1.0, 0.5)
        # 1e-6 less than against a wall: both masses take part, by 1/(1 + 1e-6)
        assert j * (1 + 1e-6) == pytest.approx(friction_impulse(u, UP, light, 1.0, 0.5), rel=1e-14)
        assert (abs((u + (light + heavy) @ j)[0]) < 1e-14) == grips


def test_parting_bodies_are_left_alone_without_a_warning():
    # n·K(n + 2 x) = 2 − 2: no matter, nothing is to be moved
    k = np.array([[2.0, 0, -1], [0, 1, 0], [-1, 0, 2]])
    with np.errstate(all="raise"):
        assert friction_impulse((-2.0, 0.0, 1.0), UP, k, 0.0, 2.0).tolist() == [0, 0, 0]


@given(st.integers(0, 10_000), SPEED, RESTITUTION)
def test_without_friction_only_the_normal_takes_part(seed, speed, restitution):
    k = point_inverse_mass(*body(seed))
    j = friction_impulse((3.0, 1.0, -speed), UP, k, restitution, 0.0)
    assert j == pytest.approx((1 + restitution) * speed / k[2, 2] * UP, rel=1e-13)


def test_in_space_friction_is_only_nearly_opposite_to_the_slip_left():
    off = []
    for seed in range(400):
        k, u = point_inverse_mass(*body(seed)), np.random.default_rng(seed).normal(size=3)
        u[2] = -abs(u[2])
        j = friction_impulse(u, UP, k, 0.5, 0.2)
        left = u + k @ j
        if np.linalg.norm(left[:2]) > 1e-6:
            cosine = -(left[:2] @ j[:2]) / np.linalg.norm(left[:2]) / np.linalg.norm(j[:2])
            off.append(math.degrees(math.acos(min(1.0, cosine))))
    # the limit of the method, as it is: an exact law would have zero
    assert np.median(off) == pytest.approx(6, abs=2)
    assert 30 < max(off) < 90  # never along the slip


# Energy


@pytest.mark.statement(16, oracle="energy of the two motions")
@given(SPEED, SLIP, SLIP, RESTITUTION, FRICTION)
def test_a_sphere_never_gains_energy(speed, slip, spin, restitution, friction):
    v, w = np.array([slip, 0.3, -speed]), np.array([0.1, spin, 2.0])
    after_v, after_w = sphere_impact(v, w, UP, 0.5, restitution, friction)
    before, after = v @ v + 0.1 * w @ w, after_v @ after_v + 0.1 * after_w @ after_w
    assert after <= before * (1 + 1e-14)


def rod(velocity, spin, impulse):
    """Exact energy, in fractions, of a rod of 1 m and 1 kg in the plane, struck at its end (−2/5, −3/10)."""
    (x, z), (jx, jz) = velocity, impulse
    x, z, w = x + jx, z + jz, spin + 12 * (Fraction(-3, 10) * jx - Fraction(-2, 5) * jz)
    return (x * x + z * z + w * w / 12) / 2


@pytest.mark.statement(16, oracle="exact fractions")
def test_newtons_restitution_with_coulomb_friction_can_create_energy():
    # A rod falls at 1 m/s, aslant, its end slides at 1/2 m/s, and the normal impulse turns that slip round. Friction
    # keeps it from being turned, so that in all it has pushed along the first slip; e = 1 gives the whole speed back.
    zero, one = Fraction(0), Fraction(1)
    k = [
        [one + 12 * Fraction(9, 100), -12 * Fraction(12, 100)],
        [-12 * Fraction(12, 100), one + 12 * Fraction(16, 100)],
    ]
    slip, approach = Fraction(1, 2), -one
    determinant = k[0][0] * k[1][1] - k[0][1] * k[1][0]
    jx = (-slip * k[1][1] - -2 * approach * k[0][1]) / determinant
    jz = (-2 * approach * k[0][0] + slip * k[1][0]) / determinant
    assert abs(jx) < Fraction(3, 4) * jz
    gained = rod((slip, approach), zero, (jx, jz)) - rod((slip, approach), zero, (zero, zero))
    assert gained == Fraction(71, 800)  # 5/8 J become 571/800 J
    matrix = plane_matrix(-0.4, -0.3, 1 / 12)
    j = friction_impulse((0.5, 0.0, -1.0), UP, matrix, 1.0, 0.75)
    assert j == pytest.approx([float(jx), 0.0, float(jz)], abs=1e-14)  # numbers near 1
    assert impact_energy((0.5, 0.0, -1.0), j, matrix) == pytest.approx(float(gained), abs=1e-14)
    # without friction, or without restitution, the same rod gains nothing
    for e, mu in ((1.0, 0.0), (0.0, 0.75)):
        j = friction_impulse((0.5, 0.0, -1.0), UP, matrix, e, mu)
        assert impact_energy((0.5, 0.0, -1.0), j, matrix) <= 1e-15


@given(st.integers(0, 10_000))
def test_with_zero_restitution_and_grip_no_energy_is_created(seed):
    k, u = point_inverse_mass(*body(seed)), np.random.default_rng(seed).normal(size=3)
    u[2] = -abs(u[2])
    assume(np.linalg.solve(k, -u)[2] > 1e-3)  # some bodies would have to be pulled to stop dead
    j = friction_impulse(u, UP, k, 0.0, 1e6)
    assert u + k @ j == pytest.approx(np.zeros(3), abs=1e-11)  # K up to some hundred, solved once
    assert impact_energy(u, j, k) == pytest.approx(-u @ np.linalg.solve(k, u) / 2, abs=1e-11)


# Others


@pytest.mark.statement(16, oracle="pymunk's impulses in the plane")
@pytest.mark.parametrize("friction", [0.05, 0.3, 1.0])
@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_pymunk_gives_a_spinning_disc_the_same_velocities(friction, restitution):
    pymunk = oracle("pymunk")
    space = pymunk.Space()
    space.iterations = 100
    floor = pymunk.Segment(space.static_body, (-50, -1), (50, -1), 1.0)
    disc = pymunk.Body(1.0, 0.4)
    shape = pymunk.Circle(disc, 1.0)
    for one in (floor, shape):
        one.friction, one.elasticity = math.sqrt(friction), math.sqrt(restitution)
    space.add(floor, disc, shape)
    disc.position, disc.velocity, disc.angular_velocity = (0, 0.9999), (1.5, -2.0), 4.0
    space.step(1e-6)
    v, spin = sphere_impact((1.5, 0.0, -2.0), (0.0, -4.0, 0.0), UP, 1.0, restitution, friction)
    # rounding of a few sums; what pymunk does against the overlap of 1e-4 stays out of its velocities
    assert disc.velocity == pytest.approx((v[0], v[2]), abs=1e-12)
    assert disc.angular_velocity == pytest.approx(-spin[1], abs=1e-12)


# One is many; what is refused


def test_many_impacts_at_once_are_the_same_as_one_after_another():
    rng = np.random.default_rng(5)
    k = np.stack([point_inverse_mass(*body(seed)) for seed in range(60)])
    u, e, mu = rng.normal(size=(60, 3)), rng.uniform(size=60), rng.uniform(size=60)
    kept = k.copy(), u.copy()
    together = friction_impulse(u, UP, k, e, mu)
    alone = np.stack([friction_impulse(u[i], UP, k[i], e[i], mu[i]) for i in range(60)])
    assert together == pytest.approx(alone, abs=1e-13)
    assert np.array_equal(kept[0], k)
    assert np.array_equal(kept[1], u)
    many = sphere_impact(u, u[::-1], UP, [0.1] * 60, e, mu)
    for i in (0, 7, 59):
        one = sphere_impact(u[i], u[59 - i], UP, 0.1, e[i], mu[i])
        assert many[0][i] == pytest.approx(one[0], abs=1e-13)
        assert many[1][i] == pytest.approx(one[1], abs=1e-12)


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda: friction_impulse(UP, 2 * UP, np.eye(3), 0.5, 0.5), "normal"),
        (lambda: friction_impulse(UP, UP, np.eye(3), 1.5, 0.5), "restitution"),
        (lambda: friction_impulse(UP, UP, np.eye(3), 0.5, -0.5), "friction"),
        (lambda: friction_impulse(UP[:2], UP, np.eye(3), 0.5, 0.5), "velocity"),
        (lambda: friction_impulse(UP, UP, np.zeros((3, 3)), 0.5, 0.5), "inverse_mass"),
        (lambda: friction_impulse(UP, UP, -np.eye(3), 0.5, 0.5), "inverse_mass"),
        (
            lambda: friction_impulse(UP, UP, np.ones((3, 3)) + 1e-13 * np.eye(3), 0.5, 0.5),
            "inverse_mass must be positive",
        ),
        (lambda: friction_impulse(UP, UP, np.diag([-1.0, -1.0, 1.0]), 0.5, 0.5), "inverse_mass"),
        (lambda: friction_impulse(UP, UP, np.full((3, 3), np.nan), 0.5, 0.5), "inverse_mass must be finite"),
        (lambda: friction_impulse(UP, UP, UP, 0.5, 0.5), "inverse_mass must have shape"),
        (lambda: friction_impulse(np.nan * UP, UP, np.eye(3), 0.5, 0.5), "velocity must be finite"),
        (lambda: friction_impulse(UP, UP, np.eye(3), 0.5, np.inf), "friction must be finite"),
        (lambda: point_inverse_mass(1.0, (1.0, 2.0, 3.0), UP), "inverse_inertia must have shape"),
        (lambda: point_inverse_mass(np.inf, np.eye(3), UP), "inverse_mass must be finite"),
        (lambda: point_inverse_mass(1.0, np.eye(3), np.inf * np.ones(3)), "arm must be finite"),
        (lambda: sphere_impact(UP, UP, UP, np.inf, 0.5, 0.5), "radius must be finite"),
        (lambda: sphere_impact(UP, UP, UP, 1.0, 0.5, 0.5, np.inf), "inertia_share must be finite"),
        (lambda: impact_energy(UP, UP, UP), "inverse_mass must have shape"),
        (lambda: point_inverse_mass(-1.0, np.eye(3), UP), "inverse_mass"),
        (lambda: point_inverse_mass(1.0, np.eye(3), UP[:2]), "arm"),
        (lambda: sphere_impact(UP, UP, UP, 0.0, 0.5, 0.5), "radius"),
        (lambda: sphere_impact(UP, UP, UP, 1.0, 0.5, 0.5, 0.0), "inertia_share"),
        (lambda: impact_energy(UP[:2], UP, np.eye(3)), "velocity"),
    ],
)
def test_an_invalid_impact_is_refused_by_name(call, name):
    with pytest.raises(ValueError, match=f"^{name}"):
        call()
