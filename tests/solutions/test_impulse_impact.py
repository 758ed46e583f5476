"""Impulses, second part: impacts from a ball on a line to two bodies in space, and what no impact may change."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from oracles import oracle

from solutions import as_printed
from solutions.friction import point_inverse_mass
from solutions.impulse import (
    Body,
    apply_impulse,
    apply_impulse_to_momenta,
    box_inertia,
    collide,
    contact_impulses,
    energy_lost,
    impulse_magnitude,
    inverse_effective_mass,
    normal_velocity,
    point_velocity,
    rebound_velocity,
    rod_inertia,
    rotation_matrix,
    sphere_inertia,
    velocities_from_momenta,
    world_inertia,
    world_inverse_inertia,
)

STILL = (0.0, 0.0, 0.0)
FIXED = np.zeros((3, 3))
UPRIGHT = (1.0, 0.0, 0.0, 0.0)
X, UP = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])
RESTITUTION = st.floats(0, 1)
GROUND = Body(STILL, STILL, STILL, 0.0, FIXED)


def ball(velocity, mass, arm, radius=0.1, spin=STILL):
    return Body(velocity, spin, arm, 1 / mass, world_inverse_inertia(sphere_inertia(mass, radius), UPRIGHT))


# A ball on a line


@pytest.mark.statement(20, oracle="Newton's two balls, in fractions")
@pytest.mark.parametrize("e", [Fraction(0), Fraction(1, 2), Fraction(1)])
def test_two_balls_on_a_line_collide_as_newton_says(e):
    m_a, m_b, v_a, v_b = Fraction(3), Fraction(2), Fraction(-4), Fraction(1)
    common = (m_a * v_a + m_b * v_b) / (m_a + m_b)
    after_a = common - e * m_b / (m_a + m_b) * (v_a - v_b)
    after_b = common + e * m_a / (m_a + m_b) * (v_a - v_b)
    a, b = ball((float(v_a), 0, 0), 3.0, -0.1 * X), ball((float(v_b), 0, 0), 2.0, 0.1 * X)
    found_a, spin_a, found_b, spin_b = collide(a, b, X, float(e))
    assert found_a == pytest.approx([float(after_a), 0, 0], abs=1e-15)  # two or three roundings of numbers below 5
    assert found_b == pytest.approx([float(after_b), 0, 0], abs=2e-15)
    assert spin_a.tolist() == spin_b.tolist() == [0, 0, 0]


@pytest.mark.statement(11, oracle="arithmetic by hand")
def test_a_ball_on_the_floor_has_the_kinematic_response():
    found = collide(ball((1, 0, -4), 0.5, -0.1 * UP), GROUND, UP, 0.75)
    assert [vector.tolist() for vector in found] == [[1, 0, 3], [0, 0, 0], [0, 0, 0], [0, 0, 0]]


def test_a_light_ball_leaves_a_very_heavy_one_twice_as_fast():
    # e = 1: v_A⁺ = (M − m)/(M + m) v, v_B⁺ = 2M/(M + m) v
    heavy, light = ball(X, 1e6, 0.1 * X), ball(STILL, 1.0, -0.1 * X)
    v_a, _, v_b, _ = collide(heavy, light, -X, 1.0)
    assert v_a[0] == pytest.approx((1e6 - 1) / (1e6 + 1), rel=1e-15)
    assert v_b[0] == pytest.approx(2e6 / (1e6 + 1), rel=1e-15)


def test_equal_frictionless_balls_off_axis_leave_at_a_right_angle():
    for angle in np.radians([0.0, 10.0, 45.0, 80.0]):
        line = np.array([math.cos(angle), math.sin(angle), 0.0])  # from A to B at the contact
        v_a, _, v_b, _ = collide(ball(2 * X, 1.0, 0.1 * line), ball(STILL, 1.0, -0.1 * line), -line, 1.0)
        assert v_a @ v_b == pytest.approx(0, abs=1e-15)  # roundings of products below 4
        assert v_b == pytest.approx(2 * math.cos(angle) * line, abs=1e-15)  # the normal components swap


# A rod in the plane


@pytest.mark.statement(20, oracle="closed form: (1 + e) m/4")
@given(RESTITUTION, st.floats(0.01, 100), st.floats(0.01, 100), st.integers(0, 99))
def test_a_rod_struck_at_its_end_takes_a_quarter_of_the_impulse_of_a_ball(e, mass, length, seed):
    turn = np.random.default_rng(seed).normal(size=4)
    turn /= np.linalg.norm(turn)
    across, _, along = rotation_matrix(turn).T
    inverse = world_inverse_inertia(rod_inertia(mass, length), turn)
    rod = Body(-across, STILL, length / 2 * along, 1 / mass, inverse)
    # u_n = −1: k = 1/m + (L/2)²/(m L²/12) = 4/m. A dozen roundings of numbers of the size of 4/m
    assert impulse_magnitude(rod, GROUND, across, e) == pytest.approx((1 + e) * mass / 4, rel=1e-14)


@pytest.mark.statement(18, oracle="closed form: centre of percussion")
def test_a_rod_struck_at_its_end_turns_about_a_point_two_thirds_along():
    length, mass = 2.0, 3.0
    rod = Body(STILL, STILL, (0, 0, 1.0), 1 / mass, world_inverse_inertia(rod_inertia(mass, length), UPRIGHT))
    velocity, spin, *_ = apply_impulse(rod, GROUND, (1.5, 0, 0))
    assert velocity.tolist() == [0.5, 0, 0]
    # ω = r × J/I = 1 × 1.5/(3 × 4/12) about y; two or three roundings
    assert spin == pytest.approx([0, 1.5, 0], abs=1e-15)
    pivot = (0, 0, length / 2 - 2 / 3 * length)
    assert point_velocity(velocity, spin, pivot) == pytest.approx(0, abs=1e-15)


@pytest.mark.statement(18, oracle="closed form: a rod held at a point y is struck at x without a jolt if x y = −I/M")
def test_the_struck_end_is_the_centre_of_percussion_of_the_still_point():
    length, mass = 1.2, 0.7
    inverse = world_inverse_inertia(rod_inertia(mass, length), UPRIGHT)

    def jolt(struck, held):
        """Impulse of a hand that keeps the point `held` at rest, as a share of the blow; both from the centre."""
        rod = Body(STILL, STILL, (0, 0, struck), 1 / mass, inverse)
        velocity, spin, *_ = apply_impulse(rod, GROUND, (1.0, 0, 0))
        gives_way = float(inverse_effective_mass(rod._replace(arm=(0, 0, held)), GROUND, (1.0, 0, 0)))
        return -float(point_velocity(velocity, spin, (0, 0, held))[0]) / gives_way

    end, still = length / 2, -length / 6
    assert jolt(end, still) == pytest.approx(0, abs=1e-15)
    # A hand at the still point is jarred by any other blow, and a hand at the end is not by one at the still point
    assert jolt(0.8 * end, still) < -0.1
    assert jolt(still, still) == pytest.approx(-1, rel=1e-14)
    assert jolt(still, end) == pytest.approx(0, abs=1e-15)


def test_a_thin_rod_struck_along_itself_does_not_turn():
    rod = Body((0, 0, -1.0), STILL, (0, 0, -1.0), 1.0, world_inverse_inertia(rod_inertia(1.0, 2.0), UPRIGHT))
    velocity, spin, *_ = collide(rod, GROUND, UP, 0.5)
    assert velocity.tolist() == [0, 0, 0.5]
    assert spin.tolist() == [0, 0, 0]


# Two bodies in space


@pytest.mark.statement(20, oracle="the same sum in fractions")
def test_the_impulse_of_two_boxes_is_what_exact_fractions_give():
    cross = lambda p, q: [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]  # noqa: E731
    dot = lambda p, q: sum(x * y for x, y in zip(p, q, strict=True))  # noqa: E731
    n = [Fraction(3, 5), Fraction(0), Fraction(4, 5)]
    k, closing, bodies = Fraction(0), Fraction(0), []
    for sign, mass, size, arm, v, w in (
        (1, 2, (1, 2, 3), (Fraction(1, 2), 1, Fraction(-3, 2)), (-3, 1, -2), (1, -2, 3)),
        (-1, 5, (2, 1, 1), (-1, Fraction(1, 2), Fraction(1, 2)), (1, 0, 2), (0, 4, -1)),
    ):
        moments = [Fraction(mass * (sum(x * x for x in size) - own * own), 12) for own in size]
        lever = cross(arm, n)
        k += Fraction(1, mass) + sum(x * x / moment for x, moment in zip(lever, moments, strict=True))
        closing += sign * (dot(n, v) + dot(n, cross(w, arm)))
        bodies.append(
            Body(v, w, [float(x) for x in arm], 1 / mass, world_inverse_inertia(box_inertia(mass, size), UPRIGHT))
        )
    e = Fraction(1, 4)
    assert closing < 0
    normal = [float(x) for x in n]
    # Some twenty roundings of sums whose terms are no larger than a few times the result
    assert inverse_effective_mass(*bodies, normal) == pytest.approx(float(k), rel=1e-14)
    assert impulse_magnitude(*bodies, normal, 0.25) == pytest.approx(float(-(1 + e) * closing / k), rel=1e-14)


class Scene:
    """Two bodies about to touch, and what a property needs: masses, moments, orientations, the place of contact."""

    def __init__(self, seed: int, kinds: tuple[str, str], touch: str) -> None:
        rng = np.random.default_rng(seed)
        self.normal = _unit(rng.normal(size=3))
        self.contact = rng.normal(size=3)
        self.mass, self.moments, self.orientation, self.body = [], [], [], []
        for kind in kinds:
            mass = math.inf if kind == "immovable" else 10.0 ** rng.uniform(-3, 3)
            orientation = _unit(rng.normal(size=4))
            arm = rng.normal(size=3)
            if kind == "rod":
                moments, arm = rod_inertia(mass, 2.0), rng.uniform(-1, 1) * rotation_matrix(orientation)[:, 2]
            elif kind == "point":
                moments, arm = sphere_inertia(mass, 0.0), np.zeros(3)
            else:
                moments = box_inertia(mass, rng.uniform(0.1, 3, 3))
            if touch == "central" and kind == "box":
                arm = rng.normal() * self.normal
            spin = rng.normal(size=3)
            if kind in ("rod", "point"):  # momenta know no spin about an axis without inertia
                spin = rotation_matrix(orientation) @ (rotation_matrix(orientation).T @ spin * (moments > 0))
            inverse = world_inverse_inertia(moments, orientation)
            self.body.append(Body(rng.normal(size=3), spin, arm, 1 / mass, inverse))
            self.mass.append(mass)
            self.moments.append(moments)
            self.orientation.append(orientation)
        if touch == "grazing":
            a = self.body[0]
            self.body[0] = a._replace(velocity=a.velocity - self.closing() * self.normal)
        elif (self.closing() > 0) != (touch == "separating"):
            a, b = self.body
            self.body = [a._replace(velocity=-a.velocity, angular_velocity=-a.angular_velocity)]
            self.body.append(b._replace(velocity=-b.velocity, angular_velocity=-b.angular_velocity))

    def closing(self) -> float:
        return normal_velocity(*self.body, self.normal)

    def after(self, restitution: float) -> tuple[np.ndarray, ...]:
        return collide(*self.body, self.normal, restitution)

    def sums(self, velocities) -> tuple[np.ndarray, np.ndarray, float]:
        """P, L about the origin and the kinetic energy of all that can move; by axes, not by matrices."""
        momentum, angular, energy = np.zeros(3), np.zeros(3), 0.0
        for index, (v, w) in enumerate((velocities[:2], velocities[2:])):
            if math.isinf(self.mass[index]):
                continue
            m, axes = self.mass[index], rotation_matrix(self.orientation[index]).T
            turning = self.moments[index] * (axes @ w)
            momentum += m * v
            angular += np.cross(self.contact - self.body[index].arm, m * v) + turning @ axes
            energy += m * (v @ v) / 2 + turning @ (axes @ w) / 2
        return momentum, angular, energy

    def size(self) -> float:
        """Sum of all masses that can move: momenta and energies here are a few times as large."""
        return sum(mass for mass in self.mass if not math.isinf(mass))


def _unit(vector):
    return vector / np.linalg.norm(vector)


KIND = st.sampled_from(["box", "rod", "point", "immovable"])
TOUCH = st.sampled_from(["any", "central", "separating", "grazing"])
SCENE = st.builds(Scene, st.integers(0, 10**6), st.tuples(KIND, KIND), TOUCH)
CLOSING = st.builds(Scene, st.integers(0, 10**6), st.tuples(KIND, KIND), st.sampled_from(["any", "central"]))
MOVABLE = st.sampled_from(["box", "rod", "point"])
FREE = st.builds(Scene, st.integers(0, 10**6), st.tuples(MOVABLE, MOVABLE), st.sampled_from(["any", "central"]))
ROUNDING = 1e-11
"""Velocities of some 5 m/s, levers and moments down to 1e-3 of the largest: 1e4 times the rounding of a number of 5."""


def immovable(scene) -> bool:
    return all(math.isinf(mass) for mass in scene.mass)


@pytest.mark.statement(19, oracle="the restitution that was set")
@given(CLOSING, RESTITUTION)
def test_the_points_part_at_e_times_the_speed_at_which_they_closed(scene, e):
    v_a, w_a, v_b, w_b = scene.after(e)
    a, b = scene.body
    moved = a._replace(velocity=v_a, angular_velocity=w_a), b._replace(velocity=v_b, angular_velocity=w_b)
    after = normal_velocity(*moved, scene.normal)
    expected = scene.closing() if immovable(scene) else rebound_velocity(scene.closing(), e)
    assert after == pytest.approx(expected, abs=ROUNDING)


@pytest.mark.statement(18, oracle="momentum and angular momentum")
@given(FREE, RESTITUTION)
def test_an_impact_keeps_momentum_and_angular_momentum(scene, e):
    a, b = scene.body
    before, after = scene.sums((*a[:2], *b[:2])), scene.sums(scene.after(e))
    scale = scene.size() * 1e-13  # sums of some twenty terms, each of a few masses at 1 m/s and 1 m
    assert after[0] == pytest.approx(before[0], abs=10 * scale)
    assert after[1] == pytest.approx(before[1], abs=100 * scale)  # L about another point differs by p × P, also kept


@pytest.mark.statement(20, oracle="kinetic energy")
@given(CLOSING, RESTITUTION)
def test_an_impact_takes_one_minus_e_squared_of_the_closing_energy(scene, e):
    a, b = scene.body
    k = inverse_effective_mass(a, b, scene.normal)
    expected = 0.0 if immovable(scene) else (1 - e**2) * scene.closing() ** 2 / (2 * k)
    assert energy_lost(a, b, scene.normal, e) == pytest.approx(expected, rel=1e-14)
    if not any(math.isinf(mass) for mass in scene.mass):  # a moving wall does work; see the next test
        before, after = scene.sums((*a[:2], *b[:2]))[2], scene.sums(scene.after(e))[2]
        assert before - after == pytest.approx(expected, abs=1e-11 * scene.size())


@given(st.integers(0, 99), RESTITUTION)
def test_against_a_wall_at_rest_the_body_alone_loses_that_energy(seed, e):
    scene = Scene(seed, ("box", "immovable"), "any")
    a = scene.body[0]
    wall = Body(STILL, STILL, STILL, 0.0, FIXED)
    after = collide(a, wall, scene.normal, e)
    lost = scene.sums((*a[:2], STILL, STILL))[2] - scene.sums(after)[2]
    assert lost == pytest.approx(energy_lost(a, wall, scene.normal, e), abs=1e-11 * scene.size())


@pytest.mark.statement(16, oracle="velocities along the contact plane and spins of balls")
@given(st.integers(0, 999), RESTITUTION)
def test_without_friction_balls_keep_spin_and_tangential_velocity(seed, e):
    rng = np.random.default_rng(seed)
    n = _unit(rng.normal(size=3))
    a = ball(rng.normal(size=3) - 3 * n, 2.0, -0.1 * n, spin=rng.normal(size=3))
    b = ball(rng.normal(size=3) + 3 * n, 1.0, 0.1 * n, spin=rng.normal(size=3))
    v_a, w_a, v_b, w_b = collide(a, b, n, e)
    for before, after in ((a.velocity, v_a), (b.velocity, v_b)):
        assert np.cross(after, n) == pytest.approx(np.cross(before, n), abs=1e-14)  # roundings of numbers up to 10
    for before, after in ((a, w_a), (b, w_b)):
        # r × n = 0 but for rounding, 1e-17 × j of 10 over a moment of 0.004
        assert after == pytest.approx(before.angular_velocity, abs=1e-12)


@pytest.mark.erratum(16)
def test_without_friction_a_spinning_ball_does_not_hop_forward():
    # With friction that grips, the floor gives a solid ball 2/7 r ω = 1.43 m/s. The slides have none of it.
    after = collide(ball((0, 0, -1), 1.0, -0.1 * UP, spin=(0, 50.0, 0)), GROUND, UP, 0.5)
    assert after[0].tolist() == [0, 0, 0.5]
    assert after[1].tolist() == [0, 50, 0]


@given(SCENE)
def test_the_denominator_is_the_contact_matrix_along_the_normal(scene):
    k = sum(point_inverse_mass(body.inverse_mass, body.inverse_inertia, body.arm) for body in scene.body)
    # Two sums of the same terms; what they cancel is a share of the largest
    scale = np.abs(k).max()
    found = inverse_effective_mass(*scene.body, scene.normal)
    assert found == pytest.approx(scene.normal @ k @ scene.normal, abs=1e-14 * scale)


@given(SCENE, RESTITUTION, *[st.integers(-20, 20)] * 3)
def test_bodies_of_any_size_mass_and_speed_collide_alike(scene, e, metres, kilograms, seconds):
    # Powers of two, up to 1e6 and down to 1e-6: the numbers scale without rounding, and so must the answers
    length, mass, time = 2.0**metres, 2.0**kilograms, 2.0**seconds
    scaled = [
        Body(
            np.multiply(body.velocity, length / time),
            np.multiply(body.angular_velocity, 1 / time),
            np.multiply(body.arm, length),
            body.inverse_mass / mass,
            np.multiply(body.inverse_inertia, 1 / (mass * length**2)),
        )
        for body in scene.body
    ]
    factors = (length / time, 1 / time) * 2
    for found, here, factor in zip(collide(*scaled, scene.normal, e), scene.after(e), factors, strict=True):
        assert np.array_equal(found, here * factor)
    j, lost = impulse_magnitude(*scene.body, scene.normal, e), energy_lost(*scene.body, scene.normal, e)
    assert impulse_magnitude(*scaled, scene.normal, e) == j * mass * length / time
    assert energy_lost(*scaled, scene.normal, e) == lost * mass * (length / time) ** 2


@pytest.mark.statement(21, oracle="velocities and momenta, two ways to the same")
@given(FREE, RESTITUTION)
def test_the_slides_way_over_p_and_l_gives_the_same_velocities(scene, e):
    a, b = scene.body
    impulses = contact_impulses(impulse_magnitude(a, b, scene.normal, e), scene.normal)
    direct = scene.after(e)
    for index, impulse in enumerate(impulses):
        body, orientation = scene.body[index], scene.orientation[index]
        spin = world_inertia(scene.moments[index], orientation) @ body.angular_velocity
        momenta = apply_impulse_to_momenta(scene.mass[index] * body.velocity, spin, body.arm, impulse)
        found = velocities_from_momenta(*momenta, body.inverse_mass, body.inverse_inertia)
        assert found[0] == pytest.approx(direct[2 * index], abs=ROUNDING)
        assert found[1] == pytest.approx(direct[2 * index + 1], abs=1e3 * ROUNDING)  # moments down to 1e-3 of a mass


@pytest.mark.statement(11, oracle="an observer who moves along")
@given(SCENE, RESTITUTION, st.integers(0, 99))
def test_every_observer_sees_the_same_impact(scene, e, seed):
    if abs(scene.closing()) < 1e-9:
        return  # grazing: which side of zero rounding falls on is no physics
    boost = np.random.default_rng(seed).normal(size=3)
    boosted = [body._replace(velocity=body.velocity + boost) for body in scene.body]
    seen = collide(*boosted, scene.normal, e)
    for shift, found, here in zip((boost, 0, boost, 0), seen, scene.after(e), strict=True):
        assert found - shift == pytest.approx(here, abs=100 * ROUNDING)  # spins up to some 100 rad/s


@pytest.mark.statement(15, oracle="the two bodies exchanged")
@given(SCENE, RESTITUTION)
def test_it_does_not_matter_which_body_is_called_a(scene, e):
    a, b = scene.body
    v_a, w_a, v_b, w_b = scene.after(e)
    for found, here in zip(collide(b, a, -scene.normal, e), (v_b, w_b, v_a, w_a), strict=True):
        assert found == pytest.approx(here, abs=1e-13)  # sums of the same numbers in another order


@pytest.mark.statement(11, oracle="the whole scene turned")
@given(SCENE, RESTITUTION, st.integers(0, 99))
def test_turning_the_whole_scene_turns_the_answer(scene, e, seed):
    if abs(scene.closing()) < 1e-9:
        return  # as above
    turn = rotation_matrix(_unit(np.random.default_rng(seed).normal(size=4)))
    turned = [
        Body(*(turn @ vector for vector in body[:3]), body.inverse_mass, turn @ body.inverse_inertia @ turn.T)
        for body in scene.body
    ]
    for found, here in zip(collide(*turned, turn @ scene.normal, e), scene.after(e), strict=True):
        assert found == pytest.approx(turn @ here, abs=100 * ROUNDING)


@settings(max_examples=settings.default.max_examples // 4)  # six scenes each
@given(st.integers(0, 99))
def test_a_batch_of_impacts_is_the_impacts_one_by_one(seed):
    rng = np.random.default_rng(seed)
    kinds = [tuple(rng.choice(["box", "rod", "point", "immovable"], 2)) for _ in range(6)]
    touches = rng.choice(["any", "central", "separating", "grazing"], 6)
    scenes = [Scene(6 * seed + i, kind, touch) for i, (kind, touch) in enumerate(zip(kinds, touches, strict=True))]
    e = rng.uniform(size=6)
    bodies = [
        Body(*(np.array(parts) for parts in zip(*(scene.body[side] for scene in scenes), strict=True)))
        for side in (0, 1)
    ]
    together = collide(*bodies, np.array([scene.normal for scene in scenes]), e)
    for index, scene in enumerate(scenes):
        for found, here in zip(together, scene.after(e[index]), strict=True):
            assert found[index] == pytest.approx(here, abs=1e-13)  # a matrix product of many may add in another order


def test_a_row_and_a_column_of_bodies_collide_in_all_pairs():
    rows = [Scene(seed, ("box", "box"), "any") for seed in range(3)]
    column = Body(*(np.array(parts)[:, None] for parts in zip(*(scene.body[0] for scene in rows[:2]), strict=True)))
    row = Body(*(np.array(parts) for parts in zip(*(scene.body[1] for scene in rows), strict=True)))
    together = collide(column, row, UP, [0.0, 0.5, 1.0])
    for i, j in np.ndindex(2, 3):
        alone = collide(rows[i].body[0], rows[j].body[1], UP, 0.5 * j)
        for found, here in zip(together, alone, strict=True):
            assert found[i, j] == pytest.approx(here, abs=1e-13)  # as above
    none = np.zeros((0, 3))
    assert [part.shape for part in collide(Body(none, none, none, 1.0, np.eye(3)), GROUND, UP, 0.5)] == [(0, 3)] * 4


def test_many_balls_on_one_floor_need_no_copies_of_the_floor():
    velocity = np.array([[0, 0, -1.0], [0, 0, -2.0], [0, 0, 3.0]])
    found, _, floor, _ = collide(ball(velocity, 1.0, -0.1 * UP), GROUND, UP, (1.0, 0.5, 0.5))
    assert found.tolist() == [[0, 0, 1], [0, 0, 1], [0, 0, 3]]
    assert not floor.any()


def test_inputs_are_not_modified():
    scene = Scene(1, ("box", "box"), "any")
    before = [[np.copy(part) for part in body] for body in scene.body]
    scene.after(0.5)
    assert all(
        np.array_equal(*parts)
        for body, copy in zip(scene.body, before, strict=True)
        for parts in zip(body, copy, strict=True)
    )


# What is left alone


@pytest.mark.statement(21, oracle="the guard")
@given(st.integers(0, 10**6), st.tuples(KIND, KIND), RESTITUTION)
def test_a_pair_that_separates_is_left_alone(seed, kinds, e):
    scene = Scene(seed, kinds, "separating")
    a, b = scene.body
    for found, before in zip(scene.after(e), (*a[:2], *b[:2]), strict=True):
        assert np.array_equal(found, before)


def test_a_pair_that_grazes_or_is_below_the_threshold_is_left_alone():
    a, slow = ball((5, 0, 0.0), 1.0, -0.1 * UP), ball((5, 0, -0.1), 1.0, -0.1 * UP)
    assert collide(a, GROUND, UP, 0.5)[0].tolist() == [5, 0, 0]
    assert collide(slow, GROUND, UP, 0.5, threshold=0.1)[0].tolist() == [5, 0, -0.1]
    assert collide(slow, GROUND, UP, 0.5, threshold=0.05)[0] == pytest.approx([5, 0, 0.05], abs=1e-16)  # one rounding


def test_no_impulse_stops_two_immovable_bodies():
    lift, press = Body(UP, STILL, STILL, 0.0, FIXED), Body(-UP, STILL, STILL, 0.0, FIXED)
    assert inverse_effective_mass(press, lift, UP) == 0
    assert impulse_magnitude(press, lift, UP, 0.5) == 0
    assert energy_lost(press, lift, UP, 0.5) == 0
    v_a, _, v_b, _ = collide(press, lift, UP, 0.5)
    assert v_a.tolist() == [0, 0, -1]
    assert v_b.tolist() == [0, 0, 1]


@pytest.mark.statement(20, oracle="closed form: a door on its hinges")
def test_a_door_on_its_hinges_yields_by_its_moment_of_inertia_alone():
    # m w²/3 about the hinges, struck at its edge, w away: k = w²/(m w²/3) = 3/m, beside 1/M of the ball
    mass, width = 6.0, 0.8
    hinged = Body(STILL, STILL, width * X, 0.0, np.diag([0.0, 0.0, 3 / (mass * width**2)]))
    striker, across = ball((0, 2.0, 0), 0.5, (0, 0.1, 0)), np.array([0.0, -1.0, 0.0])
    j = 1.5 * 2.0 / (1 / 0.5 + 3 / mass)
    v_ball, _, v_door, spin = collide(striker, hinged, across, 0.5)
    assert v_ball == pytest.approx([0, 2 - j / 0.5, 0], abs=1e-15)  # a few roundings of numbers below 3
    assert spin == pytest.approx([0, 0, width * j * 3 / (mass * width**2)], abs=1e-15)
    assert v_door.tolist() == [0, 0, 0]


def test_a_body_struck_towards_its_pivot_gets_no_impulse():
    # r × n = 0 but for rounding, and 1/M = 0: what is left of k would be rounding, and j up to 1e33
    for seed in range(20):
        rng = np.random.default_rng(seed)
        n, turn = _unit(rng.normal(size=3)), rotation_matrix(_unit(rng.normal(size=4)))
        pivoted = Body(-n, rng.normal(size=3), 0.7 * n, 0.0, turn @ np.diag([1.0, 2.0, 3.0]) @ turn.T)
        assert inverse_effective_mass(pivoted, GROUND, n) == 0
        assert impulse_magnitude(pivoted, GROUND, n, 0.5) == 0
        assert energy_lost(pivoted, GROUND, n, 0.5) == 0
        for found, before in zip(collide(pivoted, GROUND, n, 0.5), (*pivoted[:2], STILL, STILL), strict=True):
            assert np.array_equal(found, before)
        # A lever of a millionth of the arm is one: the body yields, and the contact parts as asked
        aside = 1e-6 * _unit(np.cross(n, rng.normal(size=3)))
        slightly = pivoted._replace(velocity=STILL, angular_velocity=STILL, arm=0.7 * (n + aside))
        lever = np.cross(slightly.arm, n)
        expected = lever @ pivoted.inverse_inertia @ lever
        # The lever is rounded by 1e-16 of the arm, 1e-10 of itself
        assert inverse_effective_mass(slightly, GROUND, n) == pytest.approx(expected, rel=1e-8)


def test_an_unstoppable_racket_adds_twice_its_speed_to_the_ball():
    racket = Body((0, 0, 10.0), STILL, STILL, 0.0, FIXED)
    v_ball, _, v_racket, _ = collide(ball((0, 0, -20.0), 0.06, -0.03 * UP), racket, UP, 1.0)
    assert v_ball == pytest.approx([0, 0, 40], abs=1e-13)  # 1 + e, over 1/m and back: two roundings of 60
    assert v_racket.tolist() == [0, 0, 10]


# The slide as printed, and its assumptions


@pytest.mark.erratum(18)
def test_as_printed_a_plus_on_both_bodies_creates_momentum():
    a, b = ball(-X, 1.0, -0.1 * X), ball(X, 1.0, 0.1 * X)  # equal, head-on: nothing in all
    impulse = impulse_magnitude(a, b, X, 1.0) * X
    v_a, v_b = as_printed.velocities_after_impulse(a.velocity, b.velocity, 1.0, 1.0, impulse)
    assert v_a + v_b == pytest.approx(2 * impulse, abs=1e-15)
    assert v_b.tolist() == [3, 0, 0]  # the kinetic energy is five times what it was
    assert v_a.tolist() == [1, 0, 0]
    right_a, _, right_b, _ = collide(a, b, X, 1.0)
    assert right_a.tolist() == [1, 0, 0]
    assert right_b.tolist() == [-1, 0, 0]


def test_the_inverse_inertia_turns_with_the_body():
    # A rod along z of its own, turned to lie along x: struck across its end it turns; the body's own I⁻¹ has it still.
    lying = (math.sqrt(0.5), 0.0, math.sqrt(0.5), 0.0)
    moments = rod_inertia(1.0, 2.0)
    for orientation, k in ((lying, 4.0), (UPRIGHT, 1 + 3.0)):
        arm = rotation_matrix(orientation) @ UP
        rod = Body(STILL, STILL, arm, 1.0, world_inverse_inertia(moments, orientation))
        across = np.array([0.0, 1.0, 0.0])
        assert inverse_effective_mass(rod, GROUND, across) == pytest.approx(k, rel=1e-14)
    frozen = Body(STILL, STILL, X, 1.0, world_inverse_inertia(moments, UPRIGHT))
    assert inverse_effective_mass(frozen, GROUND, np.array([0.0, 1.0, 0.0])) == 1


def test_a_thin_rod_turned_there_and_back_is_not_refused_for_rounding():
    # About its own axis its inverse inertia is 0; turned there and back by matrices it may be −1e-17
    least = []
    for seed in range(30):
        turn = rotation_matrix(_unit(np.random.default_rng(seed).normal(size=4)))
        inverse = turn @ (turn.T @ np.diag([3.0, 3.0, 0.0]) @ turn) @ turn.T
        least.append(inverse[2, 2])
        rod = Body(-X, STILL, UP, 1.0, inverse)
        assert inverse_effective_mass(rod, GROUND, X) == pytest.approx(4, abs=1e-14)  # a dozen roundings of 3
    assert min(least) < 0


@pytest.mark.erratum(20)
def test_dropping_the_time_dependence_leaves_out_m_g_times_the_duration():
    # A ball on a spring: its force over the contact, weight and all, leaves more than j by m g Δt; nothing for Δt → 0.
    solve = oracle("scipy.integrate").solve_ivp
    mass, gravity, speed = 0.05, 9.81, 2.0
    j = impulse_magnitude(ball(-speed * UP, mass, -0.02 * UP), GROUND, UP, 1.0)
    missing = []
    for stiffness in (1e3, 1e5):
        leaves = lambda _t, state: state[0]  # noqa: E731
        leaves.terminal, leaves.direction = True, 1
        stiff = stiffness / mass
        path = solve(
            lambda _t, state, stiff=stiff: [state[1], -stiff * state[0] - gravity, -stiff * mass * state[0]],
            (0, 1),
            [0, -speed, 0],
            events=leaves,
            rtol=1e-10,
            atol=1e-13,
        )
        missing.append(path.y[2, -1] - j)
        assert missing[-1] == pytest.approx(
            mass * gravity * path.t[-1], rel=1e-6
        )  # the solver's 1e-10 of j, 1e-3 of it
    assert missing[0] > 8 * missing[1] > 0  # Δt falls with √stiffness


# What is refused


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: collide(GROUND, GROUND, (0, 0, 2), 0.5), "normal must have length 1, not 2"),
        (lambda: inverse_effective_mass(GROUND, GROUND, 1.0), "normal must have shape"),
        (lambda: collide(GROUND, GROUND, UP, 1.5), "restitution must be from 0 to 1, not 1.5"),
        (lambda: collide(GROUND, GROUND, UP, 0.5, -1), "threshold must be zero or positive, not -1"),
        (lambda: impulse_magnitude(GROUND, GROUND, UP, -0.5), "restitution must be from 0 to 1, not -0.5"),
        (lambda: energy_lost(GROUND, GROUND, UP, 2), "restitution must be from 0 to 1, not 2"),
        (lambda: collide(GROUND._replace(inverse_mass=-1), GROUND, UP, 0.5), "inverse_mass must be zero or positive"),
        (lambda: collide(GROUND, GROUND._replace(inverse_mass=math.inf), UP, 0.5), "inverse_mass must be finite"),
        (lambda: collide(GROUND._replace(inverse_inertia=1.0), GROUND, UP, 0.5), "inverse_inertia must have shape"),
        (lambda: collide(GROUND._replace(velocity=(0, 0, math.nan)), GROUND, UP, 0.5), "^velocity must be finite"),
        (lambda: collide(GROUND._replace(angular_velocity=(0, math.inf, 0)), GROUND, UP, 0.5), "angular_velocity must"),
        (lambda: impulse_magnitude(GROUND, GROUND._replace(arm=(0, math.nan, 0)), UP, 0.5), "arm must be finite"),
        (lambda: energy_lost(GROUND._replace(arm=(0, math.nan, 0)), GROUND, UP, 0.5), "arm must be finite"),
        (
            lambda: impulse_magnitude(GROUND._replace(inverse_inertia=-3 * np.eye(3)), GROUND, UP, 0.5),
            "diagonal of inverse_inertia must be zero or positive, not -3",
        ),
        (lambda: collide(GROUND._replace(arm=1.0), GROUND, UP, 0.5), "arm must have shape"),
        (lambda: collide(GROUND._replace(angular_velocity=1.0), GROUND, UP, 0.5), "angular_velocity must have shape"),
        (lambda: collide(GROUND._replace(velocity=1.0), GROUND, UP, 0.5), "velocity must have shape"),
        (lambda: apply_impulse(GROUND, GROUND, 1.0), "impulse must have shape"),
        (lambda: apply_impulse(GROUND, GROUND, (0, 0, math.nan)), "impulse must be finite"),
    ],
)  # fmt: skip
def test_what_makes_no_sense_is_refused_by_name_and_value(call, message):
    with pytest.raises(ValueError, match=message):
        call()


def test_a_plain_tuple_is_a_body_as_well():
    assert collide(tuple(ball(-UP, 1.0, -0.1 * UP)), tuple(GROUND), UP, 1.0)[0].tolist() == [0, 0, 1]
