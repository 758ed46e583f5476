"""The walkers of a case for a notebook's own formulas."""

from __future__ import annotations

import numpy as np
import pytest

from labs.desk.own_steering import walkers
from labs.desk.student_code import collect, write_notebook
from reference.errors import InvalidInput


def test_eight_walkers_of_two_streams_have_their_speeds_and_sizes():
    found = walkers("crossing-streams/θ=70°")
    assert found.positions.shape == found.velocities.shape == (8, 3)
    np.testing.assert_allclose(np.linalg.norm(found.velocities, axis=-1), 1.2, rtol=1e-12)
    assert np.all((found.radii > 0.15) & (found.radii < 0.35))


def test_a_case_without_steered_balls_is_named():
    with pytest.raises(InvalidInput, match="no rule steers balls"):
        walkers("passing-balls/v=40")


def test_a_rule_that_a_lesson_makes_of_own_functions_counts_as_the_students():
    own = "def seek(position, target, speed):\n    return target - position\n"
    rule = "def steer_around(position, velocity, goal, centre, radius):\n    return seek(position, goal, 1.0)\n"
    alone = "def flee(position, target, speed):\n    return position - target\n"
    code = collect("avoidance", write_notebook([own, rule, alone]))
    assert code.own == ("seek",)
    assert code.through == ("steer_around",)
