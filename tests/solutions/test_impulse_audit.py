"""Impulses, last part: the audit of an impact, beside sums over the particles that a body is made of."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from solutions.impulse import (
    Body,
    apply_impulse,
    audit,
    collide,
    energy_lost,
    mass_and_inertia,
    rod_inertia,
    world_inverse_inertia,
)

STILL, X, UP = np.zeros(3), np.array([1.0, 0, 0]), np.array([0.0, 0, 1])
FIXED = np.zeros((3, 3))
GROUND = Body(STILL, STILL, STILL, 0.0, FIXED)


class Particles:
    """A body of particles: their masses, and their places about their centre of mass; or an immovable one."""

    def __init__(self, rng, kind):
        count = 2 if kind == "rod" else 5
        self.masses, places = rng.uniform(0.2, 2, count), rng.normal(size=(count, 3))
        self.places = places - self.masses @ places / self.masses.sum()
        self.arm, self.velocity, self.spin = rng.normal(size=(3, 3))
        if kind == "rod":
            self.arm = rng.normal() * self.places[0]  # it is struck somewhere along itself
        self.immovable = kind == "immovable"

    def body(self):
        if self.immovable:
            return Body(self.velocity, self.spin, self.arm, 0.0, FIXED)
        if len(self.masses) == 2:  # all mass lies on one axis
            along = self.places[0] / np.linalg.norm(self.places[0])
            inverse = (np.eye(3) - np.outer(along, along)) / (self.masses @ np.vecdot(self.places, self.places))
        else:
            inverse = np.linalg.inv(
                sum(m * (s @ s * np.eye(3) - np.outer(s, s)) for m, s in zip(self.masses, self.places, strict=True))
            )
        return Body(self.velocity, self.spin, self.arm, 1 / self.masses.sum(), inverse)

    def sums(self, velocity, spin, origin):
        """P, L about a point that is given from the contact, and kinetic energy, particle by particle."""
        if self.immovable:
            return np.zeros(3), np.zeros(3), 0.0
        moving = velocity + np.cross(spin, self.places)
        momenta = self.masses[:, None] * moving
        places = self.places - self.arm - origin
        return momenta.sum(axis=0), np.cross(places, momenta).sum(axis=0), np.vecdot(momenta, moving).sum() / 2


KIND = st.sampled_from(["cloud", "rod", "immovable"])


@pytest.mark.statement(21, oracle="sums over the particles of the bodies")
@given(st.integers(0, 10**6), st.tuples(KIND, KIND))
def test_an_audit_is_what_the_particles_of_both_bodies_gain(seed, kinds):
    rng = np.random.default_rng(seed)
    made = [Particles(rng, kind) for kind in kinds]
    after, origin = rng.normal(size=(4, 3)), rng.normal(size=3)  # any velocities, right or wrong

    def gained(about):
        later = [body.sums(*after[2 * at : 2 * at + 2], about) for at, body in enumerate(made)]
        before = [body.sums(body.velocity, body.spin, about) for body in made]
        return [
            sum(new) - sum(old) for new, old in zip(zip(*later, strict=True), zip(*before, strict=True), strict=True)
        ]

    # An inertia of particles in nearly one line is right to 1e-11; sums of ten terms of some tens
    momentum, angular, energy = audit(*(body.body() for body in made), after)
    for found, expected in zip((momentum, angular, energy), gained(STILL), strict=True):
        assert found == pytest.approx(expected, abs=1e-9)
    assert angular - np.cross(origin, momentum) == pytest.approx(gained(origin)[1], abs=1e-9)  # about any other point


@pytest.mark.statement(21, oracle="Newton's third law, and the energy that restitution takes")
@given(st.integers(0, 10**6), st.tuples(*[st.sampled_from(["cloud", "rod"])] * 2), st.floats(0, 1))
def test_a_correct_impact_keeps_both_momenta_and_loses_only_energy(seed, kinds, e):
    rng = np.random.default_rng(seed)
    a, b = (Particles(rng, kind).body() for kind in kinds)
    normal = rng.normal(size=3)
    normal /= np.linalg.norm(normal)
    momentum, angular, energy = audit(a, b, collide(a, b, normal, e))
    assert momentum == pytest.approx(0, abs=1e-9)
    assert angular == pytest.approx(0, abs=1e-9)
    assert energy == pytest.approx(-energy_lost(a, b, normal, e), abs=1e-9)


@pytest.mark.statement(18, oracle="arithmetic by hand, with each sign of B turned round")
def test_a_wrong_sign_on_b_shows_in_one_of_the_two_momenta():
    impulse = np.array([0.0, 0, 3])
    a = Body((0, 0, -1), STILL, (0.5, 0, 0), 0.5, np.diag([1.0, 2, 4]))
    b = Body(STILL, STILL, (0, -0.5, 0.25), 0.25, np.diag([2.0, 1, 4]))
    v_a, w_a, v_b, w_b = apply_impulse(a, b, impulse)
    both = audit(a, b, (v_a, w_a, -v_b, -w_b))  # slide 18 as it is printed
    assert both[0].tolist() == (2 * impulse).tolist()
    assert both[1].tolist() == [0, 0, 0]
    spin_alone = audit(a, b, (v_a, w_a, v_b, -w_b))
    assert spin_alone[0].tolist() == [0, 0, 0]
    assert spin_alone[1].tolist() == (2 * np.cross(b.arm, impulse)).tolist()


@pytest.mark.statement(21, oracle="arithmetic by hand")
def test_beside_the_ground_the_momentum_is_what_the_ground_has_given():
    ball = Body((0, 0, -2), STILL, (0.5, 0, 0), 0.5, np.diag([1.0, 2, 4]))
    # 3 N s upwards: 1.5 m/s more, and r × J = (0, −1.5, 0) turns it with −3 rad/s. ΔE = 3 × (−2 − 0.5)/2 + 4.5/2
    momentum, angular, energy = audit(ball, GROUND, apply_impulse(ball, GROUND, (0, 0, 3)))
    assert momentum.tolist() == [0, 0, 3]
    assert angular.tolist() == [0, 0, 0]
    assert energy == 3 * (-2 - 0.5) / 2 + 4.5 / 2
    moving_wall = GROUND._replace(velocity=(0, 0, 5.0), angular_velocity=UP)
    assert audit(ball, moving_wall, (ball.velocity, STILL, STILL, STILL))[2] == 0  # nothing counts of what cannot move


def test_a_door_counts_with_the_turn_that_its_hinges_allow():
    door = Body(STILL, STILL, X, 0.0, np.diag([0.0, 0, 0.5]))
    momentum, angular, energy = audit(door, GROUND, (X, (0, 0, 3.0), STILL, STILL))
    assert momentum.tolist() == [0, 0, 0]
    assert angular.tolist() == [0, 0, 6]
    assert energy == 9


def test_a_thin_rod_has_no_inertia_about_itself_however_it_lies():
    for seed in range(20):
        turn = np.random.default_rng(seed).normal(size=4)
        inverse = world_inverse_inertia(rod_inertia(3.0, 2.0), turn / np.linalg.norm(turn))
        mass, inertia = mass_and_inertia(0.5, inverse)
        assert mass == 2
        assert np.linalg.eigvalsh(inertia) == pytest.approx([0, 1, 1], abs=1e-14)  # m L²/12, to a few roundings


def test_many_impacts_are_audited_in_one_call():
    one = Body((0, 0, -2), STILL, (0.5, 0, 0), 0.5, np.diag([1.0, 2, 4]))
    impulses = np.array([[0, 0, 3.0], [0, 1.0, 0]])
    momentum, angular, energy = audit(one, GROUND, apply_impulse(one, GROUND, impulses))
    assert momentum.tolist() == impulses.tolist()
    assert angular.shape == (2, 3)
    assert energy[0] == audit(one, GROUND, apply_impulse(one, GROUND, impulses[0]))[2]


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: audit(GROUND, GROUND, (STILL, STILL, STILL)), "unpack"),
        (lambda: audit(GROUND, GROUND, (STILL, STILL, STILL, 1.0)), "after must have shape"),
        (lambda: audit(GROUND, GROUND, (STILL, (0, 0, math.nan), STILL, STILL)), "after must be finite"),
        (lambda: audit(GROUND._replace(arm=(0, 0, math.nan)), GROUND, [STILL] * 4), "arm must be finite"),
        (lambda: audit(GROUND, GROUND._replace(velocity=(0, 0, math.nan)), [STILL] * 4), "^velocity must be finite"),
        (lambda: mass_and_inertia(-1.0, FIXED), "inverse_mass must be zero or positive"),
        (lambda: mass_and_inertia(math.inf, FIXED), "inverse_mass must be finite"),
        (lambda: mass_and_inertia(1.0, UP), "inverse_inertia must have shape"),
    ],
)
def test_what_makes_no_sense_is_refused_by_name_and_value(call, message):
    with pytest.raises(ValueError, match=message):
        call()
