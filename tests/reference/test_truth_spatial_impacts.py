"""Impacts with friction in space, against the closed forms in a plane, small steps and each law's own definition."""

from __future__ import annotations

import math

import numpy as np
import pytest

from reference.impact_truth import DISSIPATIVE, NEWTON, POISSON, STRONGE, Contact, planar_impact
from reference.spatial_impact import ALONG_GRIP, BY_AXES, SpatialContact, spatial_impact

KINEMATIC = (NEWTON, ALONG_GRIP, BY_AXES, DISSIPATIVE)


def turned_plane(rng):
    """A contact in a vertical plane that is turned about the normal, with its planar twin and its direction."""
    x, z, angle = *rng.uniform(-0.5, 0.5, 2), rng.uniform(0, 2 * np.pi)
    flat = Contact(
        1 + 12 * z * z, -12 * x * z, 1 + 12 * x * x, rng.normal(), -rng.uniform(0.2, 2), rng.choice([0.1, 0.4])
    )
    k = np.array([[flat.k_tt, 0, flat.k_tn], [0, 3.0, 0], [flat.k_tn, 0, flat.k_nn]])
    turn = np.array([[math.cos(angle), -math.sin(angle), 0], [math.sin(angle), math.cos(angle), 0], [0, 0, 1]])
    before = turn @ np.array([flat.slip, 0.0, flat.normal])
    return SpatialContact(turn @ k @ turn.T, before, flat.friction), flat, turn


def odd(rng):
    """A contact of an odd body, whose slip turns."""
    arm = rng.uniform(-0.2, 0.2, 3)
    across = np.cross(np.eye(3), arm)
    k = np.eye(3) + across @ np.diag(rng.uniform(20, 150, 3)) @ across.T
    return SpatialContact(k, np.array([*rng.normal(size=2), -rng.uniform(0.5, 2)]), rng.choice([0.1, 0.3, 0.6]))


@pytest.mark.parametrize(
    "law", [NEWTON, STRONGE, *(pytest.param(law, marks=pytest.mark.slow) for law in (DISSIPATIVE, POISSON))]
)
def test_in_a_plane_of_any_heading_it_is_the_closed_form(law):
    rng = np.random.default_rng(0)
    for _ in range(6):
        contact, flat, turn = turned_plane(rng)
        e = rng.choice([0.2, 0.6, 1.0])
        along, pressed = planar_impact(flat, e, law)
        found = turn.T @ spatial_impact(contact, e, law)
        assert found == pytest.approx([along, 0.0, pressed], abs=1e-9 * pressed)


@pytest.mark.parametrize("law", KINEMATIC)
def test_laws_of_newtons_kind_stay_in_the_cone_and_keep_e(law):
    rng = np.random.default_rng(1)
    for _ in range(10):
        contact, e = odd(rng), rng.choice([0.2, 0.6, 1.0])
        impulse = spatial_impact(contact, e, law)
        assert np.hypot(*impulse[:2]) <= contact.friction * impulse[2] * (1 + 1e-12)
        assert contact.after(impulse)[2] == pytest.approx(-e * contact.before[2], abs=1e-12)


@pytest.mark.parametrize(("law", "weighted"), [(NEWTON, False), (BY_AXES, True)])
def test_friction_that_slips_opposes_the_slip_that_is_left(law, weighted):
    rng, slipped = np.random.default_rng(2), 0
    for _ in range(10):
        contact = odd(rng)
        impulse = spatial_impact(contact, 0.5, law)
        slip = contact.after(impulse)[:2] / (np.diagonal(contact.k)[:2] if weighted else 1.0)
        if np.linalg.norm(slip) > 1e-9:
            slipped += 1
            assert -impulse[:2] / np.hypot(*impulse[:2]) == pytest.approx(slip / np.linalg.norm(slip), abs=1e-9)
    assert slipped > 4


def test_no_impulse_in_the_cone_with_that_parting_leaves_less_energy():
    rng = np.random.default_rng(3)
    for _ in range(5):
        contact = odd(rng)
        least = contact.energy_gained(spatial_impact(contact, 0.5, DISSIPATIVE))
        push = np.ones((2000, 3))
        angle, share = rng.uniform(0, 2 * np.pi, 2000), contact.friction * np.sqrt(rng.uniform(0, 1, 2000))
        push[:, 0], push[:, 1] = share * np.cos(angle), share * np.sin(angle)
        gain = push @ contact.k[2]
        some = push[gain > 0] * (-1.5 * contact.before[2] / gain[gain > 0])[:, None]
        energies = [contact.energy_gained(impulse) for impulse in some]
        assert least <= min(energies) <= least + 0.05 * abs(least)


def small_steps(contact, e, law, count=6000):
    """An impact in small normal impulses; friction in each is what stops the slip of that moment, within the cone."""
    impulse, work, piece = np.zeros(3), 0.0, -3 * contact.before[2] / contact.k[2, 2] / count
    taken, target = None, math.inf
    while taken is None or (impulse[2] if law == POISSON else work) < target:
        u = contact.after(impulse)
        if taken is None and u[2] >= 0:
            taken, target = work, (1 + e) * impulse[2] if law == POISSON else (1 - e**2) * work
        push = np.linalg.solve(contact.k[:2, :2], -u[:2] - contact.k[:2, 2] * piece)
        if np.hypot(*push) > contact.friction * piece:
            push = -contact.friction * piece * u[:2] / np.hypot(*u[:2])
        impulse, work = impulse + np.array([*push, piece]), work + piece * u[2]
    return impulse


@pytest.mark.parametrize("law", [POISSON, STRONGE])
def test_a_slip_that_turns_is_followed_as_in_small_steps(law):
    rng = np.random.default_rng(4)
    for _ in range(3):
        contact = odd(rng)
        found, expected = spatial_impact(contact, 0.6, law), small_steps(contact, 0.6, law)
        assert found == pytest.approx(expected, abs=3e-3 * expected[2])


def test_a_slip_that_friction_cannot_hold_starts_again_in_one_direction():
    k = np.array([[2.0, 0.3, 1.2], [0.3, 2.5, 0.4], [1.2, 0.4, 2.0]])
    impulse = spatial_impact(SpatialContact(k, np.array([0.0, 0.0, -1.0]), 0.1), 1.0, POISSON)
    slip = (k @ impulse)[:2]
    assert -impulse[:2] / np.hypot(*impulse[:2]) == pytest.approx(slip / np.hypot(*slip), abs=1e-9)
    assert np.hypot(*impulse[:2]) == pytest.approx(0.1 * impulse[2], rel=1e-12)
