"""Several contacts at once, as other people published them, by hand, and what is behind the figures."""

from __future__ import annotations

import math

import numpy as np
import pytest

from reference.published.by_hand.world import _square
from reference.published.theirs import published
from solutions.world import complementarity_residual, solve_by_pivots


@pytest.mark.statement(22, oracle="P37: Irodov's three discs")
def test_a_disc_that_strikes_two_at_once_recoils_stops_or_moves_on(as_published):
    found = as_published("P37")["velocity"]
    spread = np.array(published("P37").numbers("spread"))
    # The two are driven off along the lines of centres with w each: momentum v = u + 2 w cos φ, energy v² = u² + 2 w²
    pushed = (1 - np.array(found)) / (2 * np.sqrt(1 - spread**2 / 4))
    assert np.array(found) ** 2 + 2 * pushed**2 == pytest.approx(np.ones(4), abs=1e-14)


@pytest.mark.statement(22, oracle="P38: a handbook's complementarity problems, as Drake's tests have them")
def test_pivots_solve_the_problems_of_a_handbook(as_published):
    as_published("P38")


def test_with_the_handbooks_misprint_its_solution_solves_nothing():
    case = published("P38")
    matrix, forces = _square(case, "market_matrix"), np.array(case.expected["market_16"])
    offset = np.array([50.0, 50.0, 16.0, -6.0])
    assert np.max(np.abs(complementarity_residual(matrix, offset, forces))) < 1e-12
    matrix[3, 3] = 1.0
    assert np.max(np.abs(complementarity_residual(matrix, offset, forces))) > 80
    assert solve_by_pivots(matrix, offset) == pytest.approx([0, 0, 0, 6], abs=1e-12)


@pytest.mark.statement(22, oracle="P41: a textbook's ladder")
def test_a_ladder_holds_from_the_coefficient_of_the_textbook_on(as_published):
    found = as_published("P41")
    # Torques about the foot: the wall's force times the height is the weight times half of the way along the floor
    assert found["wall"] == pytest.approx([200 / math.tan(math.radians(53))], rel=1e-9)


def test_the_direction_of_the_textbooks_ladder_is_cut_off_and_not_rounded():
    direction = math.degrees(math.atan2(400.0, 150.7))  # from its own rounded forces
    assert round(direction, 1) == 69.4
    assert math.floor(10 * direction) / 10 == published("P41").expected["direction"]
