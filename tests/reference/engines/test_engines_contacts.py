"""What the point of a contact is, in every engine that reports contacts; `promises/contacts.py` has the rest."""

from __future__ import annotations

import numpy as np
import pytest
from engine_grid import FLOOR, REPORT_CONTACTS

from reference.scene.scenario import Body, Pair, Scenario, Sphere


@pytest.mark.parametrize("name", REPORT_CONTACTS)
@pytest.mark.parametrize("floor_first", [True, False])
def test_the_point_of_a_contact_lies_midway_between_the_surfaces(name, floor_first, installed):
    engine, depth = installed(name), 0.01
    ball = Body("ball", Sphere(0.1), 1.0, (0.3, -0.2, 0.1 - depth))
    bodies = (FLOOR, ball) if floor_first else (ball, FLOOR)
    scenario = Scenario("sunk-in", bodies, (Pair(bodies[0].name, bodies[1].name, restitution=0.5),), 0.01)
    contacts = engine.run(scenario, engine.settings(scenario, "tuned").change(timestep=1e-3, sample_every=1)).contacts
    # Found before the first step moves the ball: the overlap is still that of the start.
    assert contacts.sample[0] == 1
    assert contacts.separation[0] == pytest.approx(-depth, abs=1e-12)
    np.testing.assert_allclose(contacts.position[0], (0.3, -0.2, -depth / 2), atol=1e-12)


@pytest.mark.parametrize("name", REPORT_CONTACTS)
@pytest.mark.parametrize("profile", ["tuned", "stock"])
def test_the_point_of_a_contact_of_unequal_balls_lies_midway_between_their_surfaces(name, profile, installed):
    engine, depth, line = installed(name), 0.01, np.array([0.6, 0.0, -0.8])
    large = Body("large", Sphere(0.1), 1.0, (0.3, -0.2, 0.5))
    small = Body("small", Sphere(0.04), 0.3, tuple(np.array(large.position) + (0.14 - depth) * line))
    scenario = Scenario("sunk-in", (large, small), (Pair("large", "small", restitution=0.5),), 0.01, (0.0, 0.0, 0.0))
    contacts = engine.run(scenario, engine.settings(scenario, profile).change(timestep=1e-3, sample_every=1)).contacts
    assert contacts.sample[0] == 1
    expected = np.array(large.position) + (0.1 - depth / 2) * line
    np.testing.assert_allclose(contacts.position[0], expected, atol=1e-9)
