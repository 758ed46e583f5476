"""Collisions that other people detected, by hand, and what is behind the figures."""

from __future__ import annotations

import pytest


@pytest.mark.statement(5, oracle="P28: a textbook's rock")
def test_a_rock_strikes_below_when_and_as_fast_as_the_textbook_says(as_published):
    found = as_published("P28")
    # The roots of 4.9 t² − 14.339 t − 20 = 0 have the product −20/4.9 and the sum 14.339/4.9
    time, other = found["time"][0], -20 / 4.9 / found["time"][0]
    assert time + other == pytest.approx(25 * 0.573576436351046 / 4.9, rel=1e-14)


def test_two_of_the_textbooks_last_digits_are_those_of_a_rounded_time(as_published):
    found = as_published("P28")
    assert (round(found["upwards"][0], 1), round(found["angle"][0], 1)) == (-24.4, -50.0)
    assert round(14.3 - 9.8 * 3.96, 1) == -24.5


@pytest.mark.statement(4, oracle="P29: FCL's box and half-space")
def test_a_box_is_as_deep_below_a_plane_as_in_fcl(as_published):
    as_published("P29")
