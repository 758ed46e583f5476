"""Balls on springs that a notebook's own loop moves, in a replay."""

from __future__ import annotations

import numpy as np
import pytest

from labs.desk.own_scene import in_motion
from reference.errors import InvalidInput

PLACES = np.array([[[0.0, 0, 0], [0, 0, -t]] for t in np.linspace(1.0, 2.0, 11)])


def test_the_replay_has_all_balls_and_springs():
    shown = in_motion(PLACES, 1.0, [0.1, 0.2], [[0, 1]])
    assert shown.text == "[replay: yours, 2 balls and 1 springs]"
    assert "<iframe" in shown.markup
    assert in_motion(PLACES, 1.0, [0.1, 0.2]).text == "[replay: yours, 2 balls and 0 springs]"


@pytest.mark.parametrize(
    ("places", "radius", "ends", "words"),
    [
        (PLACES[:, 0], [0.1, 0.1], (), r"places must have the shape \(n, balls, 3\), not \(11, 3\)"),
        (PLACES * np.nan, [0.1, 0.1], (), "places must be finite"),
        (PLACES, 0.1, (), r"radius must have the shape \(2,\)"),
        (PLACES, [0.1, 0.1], [[0, 2]], "springs join balls from 0 to 1"),
    ],
)
def test_what_cannot_be_shown_is_named(places, radius, ends, words):
    with pytest.raises(InvalidInput, match=words):
        in_motion(places, 1.0, radius, ends)
