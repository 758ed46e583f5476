"""The walkers of a case for a notebook's own formulas, and moved by its own rules."""

from __future__ import annotations

import math

import numpy as np
import pytest

from labs.desk.own_steering import steered, walkers
from reference.errors import InvalidInput, RunFailed
from solutions.avoidance import arrive, steering_force


def test_eight_walkers_of_two_streams_have_their_speeds_and_sizes():
    found = walkers("crossing-streams/θ=70°")
    assert found.positions.shape == found.velocities.shape == (8, 3)
    np.testing.assert_allclose(np.linalg.norm(found.velocities, axis=-1), 1.2, rtol=1e-12)
    assert np.all((found.radii > 0.15) & (found.radii < 0.35))


def test_a_case_without_steered_balls_is_named():
    with pytest.raises(InvalidInput, match="no rule steers balls"):
        walkers("passing-balls/v=40")


def test_your_rules_steer_the_bodies_as_the_labs_own_do_in_engines():
    run = steered(
        "crossing-streams/θ=70°,straight on", [arrive, steering_force], ("mujoco", "dart"), ("overlap", "arrived")
    )
    overlap, arrived = run.numbers
    assert (overlap.title, overlap.headings) == ("Deepest overlap", ("", "value, m"))
    assert (arrived.title, arrived.headings) == ("At their goals", ("", "value"))
    assert overlap.rows == tuple((who, "0.44492") for who in ("yours", "MuJoCo*", "DART*", "theory"))
    assert {count for _, count in arrived.rows} == {"8"}
    shown = run._repr_mimebundle_()
    assert shown["text/plain"].startswith("[replay: yours, MuJoCo*, DART*]\nDeepest overlap\n         value, m\nyours ")
    assert shown["text/html"].count("<table") == 2


def for_one_alone(position, target, max_speed, slowing_radius):
    way = [b - a for a, b in zip(position, target, strict=True)]
    far = math.hypot(*way)
    return [max_speed / max(far, slowing_radius) * x for x in way]


def test_a_rule_for_one_body_alone_steers_all_of_them():
    for_one_alone.__name__ = "arrive"
    case = "crossing-streams/θ=70°,straight on"
    (numbers,) = steered(case, [for_one_alone, steering_force], ("mujoco",), ("overlap",)).numbers
    assert numbers.rows[0] == ("yours", "0.44492")


def steering_force_to_the_left(*_):
    return "left"


def test_what_cannot_be_steered_is_named():
    steering_force_to_the_left.__name__ = "steering_force"
    with pytest.raises(InvalidInput, match="steered by steering_force as well"):
        steered("crossing-streams/θ=70°,straight on", [arrive], ("mujoco",), ("overlap",))
    with pytest.raises(InvalidInput, match="no rule steers anybody"):
        steered("passing-balls/v=40", [arrive], ("mujoco",), ("passed",))
    with pytest.raises(RunFailed, match="steering_force returned"):
        steered("crossing-streams/θ=70°,straight on", [arrive, steering_force_to_the_left], ("mujoco",), ("overlap",))
