from __future__ import annotations

import numpy as np
import pytest

from reference.published.theirs import published
from solutions.polyhedra import orient2d


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
