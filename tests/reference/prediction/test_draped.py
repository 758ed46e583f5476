"""A cloth that falls over a ball: every implementation does what its law of one contact says, mass by mass."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.catalogue.scenarios import catalogue, settled
from reference.drape_truth import pressed
from reference.mesh_truth import net_force
from reference.prediction import draped, loaded
from reference.scene.scenario import Pair
from reference.scene.spring_network import network

FAMILY = catalogue()["cloth-over-a-ball"]
FALL = replace(FAMILY.cases[1].scenarios[0], duration=0.3)
PROFILES = [
    ("handwritten", "world"),
    ("handwritten", "step"),
    ("pybullet", "tuned"),
    ("mujoco", "tuned"),
    ("dart", "tuned"),
    pytest.param("dart", "stock", marks=pytest.mark.slow),
]


@pytest.mark.parametrize(("name", "profile"), PROFILES)
def test_every_mass_lands_and_slides_as_the_law_of_its_contact_says(name, profile, installed):
    engine = installed(name)
    settings = engine.settings(FALL, profile)
    found, method = engine.run(FALL, settings), engine.method(FALL, settings)
    prediction = draped.predict(FALL, settings, method)
    # 300 steps of 18 masses leave some 10⁻¹⁵ m of rounding; MuJoCo's solver ten times that.
    np.testing.assert_allclose(found.positions, prediction.trajectory.positions, rtol=0, atol=1e-13)
    without = loaded.predict(replace(FALL, pairs=()), settings, method)
    if without is not None:  # the rule of the step by hand with contacts is no rule of flight
        apart = np.abs(prediction.trajectory.positions - without.trajectory.positions)
        assert apart[-1].max() > 1e-3, "m: masses have landed, and lie elsewhere than if they had not"


def test_masses_in_mujoco_rest_as_deep_as_what_presses_them_says(installed):
    """At rest the acceleration of a contact, d (−K r)/d + (1 − d) (−N/m) with r below zero, vanishes."""
    engine, scenario = installed("mujoco"), FAMILY.cases[1].scenarios[0]
    settings = engine.settings(scenario, "tuned")
    place = engine.run(scenario, settings).positions[-1]
    net, ball = network(scenario), settled.ball_of(scenario)
    shape = settled.at_rest(scenario)
    force = net_force(shape, net.edges, net.stiffness, net.rest_length, net.load)
    on_it = pressed(shape, net.free, force, ball)
    press = -np.sum(force * ball.outwards(shape)[0], axis=-1)[on_it]
    stiffness = settings.number("overlap_recovery") / settings.timestep**2
    expected = (1 - settings.number("impedance")) * press / net.mass[on_it] / stiffness
    # 0.03 mm of the swings are left: some 250 N/m make 8 mN of it, and 4·10⁻¹⁰ m for the lightest mass, 20 g.
    np.testing.assert_allclose(-ball.outwards(place)[1][on_it], expected, atol=4e-10)
    assert expected.max() > 4e-8


def test_a_profile_without_a_rule_has_no_prediction(installed):
    for name in ("pybullet", "mujoco"):
        engine = installed(name)
        settings = engine.settings(FALL, "stock")
        assert draped.predict(FALL, settings, engine.method(FALL, settings)) is None


def test_masses_that_may_meet_each_other_have_no_prediction(installed):
    engine = installed("handwritten")
    settings = engine.settings(FALL, "world")
    first, second, *_ = (body.name for body in FALL.bodies if not body.immovable)
    met = replace(FALL, pairs=(*FALL.pairs, Pair(first, second)))
    assert draped.predict(met, settings, engine.method(met, settings)) is None
