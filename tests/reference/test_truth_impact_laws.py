"""Closed forms of impacts with friction in a plane, against small steps of the impact and its own definitions."""

from __future__ import annotations

import math

import numpy as np
import pytest

from reference.impact_truth import APART, DISSIPATIVE, NEWTON, POISSON, STRONGE, Contact, planar_impact

LAWS = (NEWTON, DISSIPATIVE, POISSON, STRONGE)


def contacts(count, seed=0):
    """Contacts of random rods, with slip that stops, turns round or goes on."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        x, z = rng.uniform(-0.5, 0.5, 2)
        k = 1 + 12 * z * z, -12 * x * z, 1 + 12 * x * x
        yield Contact(*k, rng.normal(), -rng.uniform(0.2, 2), rng.choice([0.1, 0.4, 1.0])), rng.choice([0.2, 0.6, 1.0])


def small_steps(contact, e, law, count=20_000):
    """An impact in small normal impulses, each with friction against the slip at that moment."""
    along = pressed = work = 0.0
    piece, target = -2 * contact.normal / contact.k_nn / count, math.inf
    taken = None
    while taken is None or (pressed if law == POISSON else work) < target:
        slip, normal = contact.after(along, pressed)
        if taken is None and normal >= 0:
            taken = work
            target = (1 + e) * pressed if law == POISSON else (1 - e**2) * work
        holding = -(slip + contact.k_tn * piece) / contact.k_tt
        most = contact.friction * piece
        along, pressed, work = along + min(max(holding, -most), most), pressed + piece, work + normal * piece
    return along, pressed


@pytest.mark.parametrize("law", [POISSON, STRONGE])
def test_poisson_and_stronge_are_the_impact_in_small_steps(law):
    for contact, e in contacts(8):
        found, expected = planar_impact(contact, e, law), small_steps(contact, e, law)
        assert found == pytest.approx(expected, abs=2e-3 * expected[1])  # a few of 20 000 steps, over an angle


@pytest.mark.parametrize("law", LAWS)
def test_every_law_stays_in_the_cone_and_newtons_two_keep_e(law):
    for contact, e in contacts(200, seed=1):
        along, pressed = planar_impact(contact, e, law)
        assert pressed > 0
        assert abs(along) <= contact.friction * pressed * (1 + 1e-12)
        if law in (NEWTON, DISSIPATIVE):
            assert contact.after(along, pressed)[1] == pytest.approx(-e * contact.normal, abs=1e-12)


def test_only_newtons_law_with_friction_against_the_slip_left_adds_energy():
    gained = {
        law: max(contact.energy_gained(*planar_impact(contact, e, law)) for contact, e in contacts(2000, 2))
        for law in LAWS
    }
    assert gained.pop(NEWTON) > 0.01
    assert max(gained.values()) <= 1e-12


def test_a_solver_that_settles_friction_last_keeps_the_smooth_normal_impulse():
    for contact, e in contacts(50, seed=3):
        along, pressed = planar_impact(contact, e, APART)
        assert pressed == -(1 + e) * contact.normal / contact.k_nn
        if abs(along) < contact.friction * pressed * (1 - 1e-12):
            assert contact.after(along, pressed)[0] == pytest.approx(0, abs=1e-12)
