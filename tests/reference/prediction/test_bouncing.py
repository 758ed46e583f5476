"""Bounces, step by step: each engine against its recurrence, and the recurrence against what it must not be."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from catalogue_rows import job

from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.bouncing_ball import FLOOR, falling_ball
from reference.comparison.compare import compare_case
from reference.comparison.verdicts import Verdict
from reference.engines import load_engine
from reference.engines.base import BULLET, RESPOND_THEN_STEP, Method
from reference.errors import InvalidInput
from reference.prediction import bouncing
from reference.prediction.laws import Bullet, Dart, MuJoCoOneStep, MuJoCoSpring, RespondThenStep
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario
from reference.scene.settings import Settings

E, DROP = 0.37, 0.83
BALL = falling_ball("unequal", E, DROP, 0.7, radius=0.13, mass=2.3)
SLAB = Scenario(
    "unequal slab",
    (FLOOR, Body("slab", Box((0.21, 0.17, 0.05)), 3.1, (0.4, -0.3, 0.05 + DROP))),
    (Pair("slab", "floor", E, 0.3),),
    0.7,
)
METHODS = [
    ("handwritten", "slide"),
    ("handwritten", "step"),
    ("handwritten", "world"),
    ("pybullet", "tuned"),
    ("pybullet", "spring"),
    ("mujoco", "tuned"),
    ("mujoco", "spring"),
    ("dart", "tuned"),
    ("dart", "stock"),
]
OFF = 1e-9
"""Rounding, m and m/s: the worst of all engines is 10⁻¹¹."""


def difference(engine, scenario: Scenario, settings: Settings) -> float:
    """Largest difference of any position (m) or velocity (m/s) from the prediction, every step sampled."""
    settings = replace(settings, sample_every=1)
    predicted = bouncing.predict(scenario, settings, engine.method(scenario, settings)).trajectory
    ran = engine.run(scenario, settings)
    return max(
        float(np.abs(ran.positions - predicted.positions).max()),
        float(np.abs(ran.velocities - predicted.velocities).max()),
    )


IN_EVERY_RUN = ("step", "tuned")
OFTEN = [pytest.param(*each, marks=() if each[1] in IN_EVERY_RUN else pytest.mark.slow) for each in METHODS]


@pytest.mark.parametrize(("engine", "profile"), OFTEN)
def test_a_ball_bounces_step_by_step_as_the_recurrence_says(engine, profile, installed):
    found = installed(engine)
    settings = found.settings(BALL, profile)
    assert difference(found, BALL, settings) < OFF
    assert difference(found, BALL, settings.change(timestep=0.83 * settings.timestep)) < OFF


@pytest.mark.parametrize(("engine", "profile"), [METHODS[2], METHODS[3], *METHODS[5:7]])
@pytest.mark.slow
def test_four_corners_share_an_impact_as_the_recurrence_says(engine, profile, installed):
    found = installed(engine)
    assert difference(found, SLAB, found.settings(SLAB, profile)) < OFF


def test_bullet_meets_a_ball_ahead_of_the_touch_and_a_box_at_an_overlap(installed):
    found = installed("pybullet")
    for body in (BALL, SLAB):
        settings = found.settings(body, "tuned").change(contact_gap_falls=200.0)  # 2 mm, of 4 mm a step
        assert found.method(body, settings).reach == pytest.approx(200 * 9.81e-6)
        assert difference(found, body, settings) < OFF


STEPPED = [
    pytest.param(*method, marks=() if method[1] in IN_EVERY_RUN else pytest.mark.slow)
    for method in METHODS
    if method[1] != "spring"
]


@pytest.mark.parametrize(("engine", "profile"), STEPPED)
def test_a_ball_comes_to_rest_in_the_step_that_is_predicted(engine, profile, installed):
    installed(engine)
    # The case that a whole report runs in the world, whose live run is read
    rows = job("ball-to-rest", engine, profile, "e=0.8" if profile == "world" else "e=0.5").rows
    (row,) = [row for row in rows if row.quantity == "rest_time"]
    assert abs(row.off) < 1e-12  # an instant that is solved for, or one of the steps
    assert {row.verdict for row in rows} <= {Verdict.PASS, Verdict.KNOWN_DEVIATION}  # also of a ball that sleeps


def test_by_steps_is_the_loop_that_it_jumps_over():
    dt, fall = 7e-4, -9.81 * 7e-4
    for law in (
        RespondThenStep(dt, E, 0.01),
        Bullet(dt, E, 0.02, 0.4, reach=1e-3),
        MuJoCoOneStep(dt, (1 + E) / dt, 1e-3 / dt**2, 0.999, 2.7),
        MuJoCoSpring(dt, 300.0, 4e4, 0.999),
        Dart(dt, E, split=False),
    ):
        gaps, rates, _ = bouncing.by_steps(DROP, -0.3, fall, law, 1500)
        gap, rate = DROP, -0.3
        for step in range(1, 1501):
            gap, rate = law.step(gap, rate, fall)
            near = 1e-8 if isinstance(law, Bullet) else 1e-10  # a gap ahead takes gap/dt: rounding, 1400 times as large
            assert (gaps[step], rates[step]) == pytest.approx((gap, rate), abs=near), (law, step)


def test_a_ball_thrown_up_or_left_without_weight_is_jumped_over_too():
    law = RespondThenStep(1e-3, E, 0.0)
    for rate, fall in ((2.0, -9.81e-3), (-2.03, 0.0), (2.0, 0.0)):
        gaps, _, _ = bouncing.by_steps(0.31, rate, fall, law, 700)
        gap, now = 0.31, rate
        for step in range(1, 701):
            gap, now = law.step(gap, now, fall)
            assert gaps[step] == pytest.approx(gap, abs=1e-12)


def test_a_rule_that_there_is_not_is_refused_with_those_there_are():
    with pytest.raises(InvalidInput, match=r"'Bullets'; it is one of .*Bullet's, "):
        Method("at step", rule="Bullets")


def test_a_ball_thrown_at_a_ceiling_is_pulled_off_in_the_step_of_its_impact():
    ceiling = Body("floor", HalfSpace((0.0, 0.0, -1.0)), position=(0.0, 0.0, 1.0))
    thrown = replace(BALL.body("ball"), position=(0.0, 0.0, 0.3), velocity=(0.0, 0.0, 4.0))
    scenario, found = replace(BALL, bodies=(ceiling, thrown)), load_engine("handwritten")
    assert difference(found, scenario, found.settings(scenario, "step").change(timestep=0.01)) < OFF


def test_a_method_without_a_rule_has_no_prediction():
    settings = Settings(1e-3)
    assert bouncing.predict(BALL, settings, Method("at step")) is None
    assert bouncing.predict(BALL, settings, Method("at step", rule=BULLET)) is not None


@pytest.mark.parametrize("fault", ["restitution", "gravity", "timestep"])
def test_a_thousandth_of_a_fault_fails_the_row_of_a_rebound(fault):
    engine, family = load_engine("handwritten"), catalogue()["dropped-ball"]
    case = replace(family.case("e=0.5"), scenarios=family.case("e=0.5").scenarios[:3])
    settings = engine.settings(case.scenarios[0], "step")
    assert engine.method(case.scenarios[0], settings).rule == RESPOND_THEN_STEP
    run = engine.run_many

    def faulty(scenarios, settings):
        if fault == "restitution":
            scenarios = [replace(each, pairs=(replace(each.pairs[0], restitution=0.5005),)) for each in scenarios]
        if fault == "gravity":
            scenarios = [replace(each, gravity=(0.0, 0.0, -9.81981)) for each in scenarios]
        if fault == "timestep":
            settings = settings.change(timestep=1.001 * settings.timestep)
        return run(scenarios, settings)

    engine.run_many = faulty
    rows, _ = compare_case(family, case, engine, "step", settings)
    assert {row.quantity: row.verdict for row in rows}["rebound"] is Verdict.FAIL
