"""Contacts that give way, as other people published them, by hand."""

from __future__ import annotations

import math

import pytest

from reference.engines.implementation import Implementation
from reference.published.by_hand.springs import granular
from reference.published.theirs import published
from solutions.response import penalty_damping, penalty_restitution


@pytest.mark.statement(8, oracle="P3: LAMMPS")
def test_p3_the_adhesive_dashpot_moves_a_ball_as_in_lammps(as_published):
    as_published("P3")


def test_p3_with_the_clamp_the_same_dashpot_leaves_more_speed():
    case = published("P3")
    found = granular(case, Implementation(), adhesive=False)
    assert found[1, 0] == pytest.approx(0.17994, abs=5e-6)  # half of the last digit printed
    mass = case.value("density") * math.pi * case.value("diameter") ** 3 / 6
    damping = penalty_damping(0.9, mass, case.value("stiffness"), adhesive=True)
    assert penalty_restitution(mass, case.value("stiffness"), damping) == pytest.approx(0.902, abs=5e-4)


@pytest.mark.statement(8, oracle="P9: the depths that MuJoCo's tests expect")
def test_p9_a_body_rests_as_deep_as_in_mujoco(as_published):
    as_published("P9")


@pytest.mark.statement(8, oracle="P18: Siconos")
def test_p18_a_ball_turns_where_all_its_energy_is_in_the_spring(as_published):
    # Verlet's own error: the contact begins within a step, k d dt at d = v dt, 2e-5 m/s; then (ω dt)² = 4e-6
    as_published("P18")
