from __future__ import annotations

import numpy as np
import pytest

from reference.published.by_hand.polyhedra import _pentagons
from reference.published.theirs import published
from solutions.polyhedra import inside_by_parity, inside_by_winding, orient2d, winding_number


def grid(case):
    """The points p, and the true sign: p, q, r turn left where p is above the diagonal that q and r are on."""
    setup = case.setup
    i, j = np.meshgrid(*2 * [np.arange(int(setup["count"]))], indexing="ij")
    return np.array(setup["first"]) + np.stack([i, j], axis=-1) * setup["unit"], np.sign(j - i)


def test_plain_doubles_get_the_published_number_of_signs_wrong(as_published):
    as_published("P24")


@pytest.mark.statement(9, oracle="the diagonal of a grid of neighbouring doubles, as published")
def test_our_exact_sign_is_right_for_every_one_of_these_points():
    case = published("P24")
    p, truth = grid(case)
    assert np.array_equal(orient2d(p, case.setup["q"], case.setup["r"]), truth)


@pytest.mark.statement(9, oracle="P34: Coxeter's densities")
def test_star_polyhedra_wind_round_their_centre_as_often_as_published(as_published):
    as_published("P34")


def test_parity_calls_a_part_outside_that_is_wound_twice():
    golden = (1 + np.sqrt(5)) / 2
    peaks = np.array([np.roll((0.0, a, b * golden), shift) for a in (1, -1) for b in (1, -1) for shift in range(3)])
    towards_a_peak = np.array([0.3, 0.6, 1.1])[:, None] * peaks[0] + (0.003, 0.002, 0.001)
    star, dodecahedron = ((peaks, _pentagons(peaks, peaks, step)) for step in (2, 1))
    assert winding_number(towards_a_peak, *star) == pytest.approx([3, 1, 0], abs=1e-12)
    assert winding_number(towards_a_peak, *dodecahedron) == pytest.approx([3, 2, 0], abs=1e-12)
    assert inside_by_parity(towards_a_peak, *dodecahedron).tolist() == [True, False, False]
    assert inside_by_winding(towards_a_peak, *dodecahedron).tolist() == [True, True, False]
