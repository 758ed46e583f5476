"""One drop on a slope: closed forms of a penalty contact with weight, and what each response makes of it, by step."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from reference import truth
from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.one_drop import DOWN, HEIGHT, deepest, predict, time_below
from reference.engines import load_engine
from reference.prediction.laws import BulletSpring, Penalty
from reference.spring_truth import SpringContact

FAMILY = catalogue()["one-drop"]
SPEED = truth.impact_speed(HEIGHT, DOWN)
STIFFNESS = 1e6  # 1/s², of the spring profiles
PROFILES = [
    ("handwritten", "spring"),
    ("handwritten", "step"),
    ("pybullet", "spring"),
    pytest.param("mujoco", "tuned", marks=pytest.mark.slow),
    ("mujoco", "spring"),
    pytest.param("dart", "tuned", marks=pytest.mark.slow),
]


def contact(restitution: float) -> SpringContact:
    return SpringContact(SPEED, DOWN, STIFFNESS, truth.damping_ratio(restitution))


def in_small_steps(of: SpringContact, dt: float) -> tuple[float, float, float]:
    """Deepest point, time below the surface and speed on the way up, by midpoint steps of the equation of motion."""
    damping = 2 * of.damping_ratio * math.sqrt(of.stiffness)
    height, rate, time, lowest = 0.0, -of.speed, 0.0, 0.0
    while height < 0 or rate < 0:
        half = max(0.0, -of.stiffness * height - damping * rate) - of.gravity
        at, going = height + rate * dt / 2, rate + half * dt / 2
        full = max(0.0, -of.stiffness * at - damping * going) - of.gravity
        height, rate, time = height + going * dt, rate + full * dt, time + dt
        lowest = min(lowest, height)
    return -lowest, time - height / rate, rate + of.gravity * height / rate


@pytest.mark.parametrize("restitution", [0.2, 0.5, 1.0])
def test_a_penalty_contact_with_weight_is_what_small_steps_give(restitution):
    of = contact(restitution)
    found = of.deepest, of.time_below, of.rebound_speed
    # Midpoint steps are of second order: (ω dt)² = 10⁻⁶, and the last step is taken back to the surface.
    assert found == pytest.approx(in_small_steps(of, 1e-6), rel=2e-5)


def test_without_dashpot_or_weight_a_contact_has_the_known_closed_forms():
    elastic, omega = contact(1.0), math.sqrt(STIFFNESS)
    sag = DOWN / STIFFNESS
    assert elastic.deepest == pytest.approx(sag + math.hypot(sag, SPEED / omega), rel=1e-12)
    assert elastic.rebound_speed == pytest.approx(SPEED, rel=1e-12)
    assert elastic.rest_depth == pytest.approx(sag)
    light = replace(contact(0.5), gravity=1e-9)
    assert light.rebound_speed / SPEED == pytest.approx(0.5, rel=1e-9)
    left = truth.spring_dashpot_exit_depth(light.damping_ratio, SPEED, STIFFNESS)
    damped = math.sqrt(1 - light.damping_ratio**2)
    lasts = 2 * math.acos(light.damping_ratio) / (damped * omega)
    assert light.time_below == pytest.approx(lasts + left / (0.5 * SPEED), rel=1e-9)


@pytest.mark.parametrize(("engine", "dt"), [("handwritten", 5e-5), ("pybullet", 5e-5), ("mujoco", 2e-4)])
def test_a_spring_is_as_deep_and_lasts_as_long_as_its_closed_form_says(engine, dt, installed):
    found, scenario = installed(engine), FAMILY.case("e=0.5").scenarios[0]
    settings = found.settings(scenario, "spring")
    assert settings.timestep == dt
    trajectory, of = found.run(scenario, settings), contact(0.5)
    if engine == "mujoco":  # its contact does not feel the weight
        of = replace(of, gravity=1e-9)
    # To first order in a step: the touch is noticed up to one late, and the dashpot acts a step off.
    off = 2 * of.damping_ratio * 1e3 * dt if engine != "mujoco" else (1e3 * dt) ** 2
    assert deepest(trajectory) == pytest.approx(of.deepest, rel=off)
    assert time_below(trajectory) == pytest.approx(of.time_below, rel=off)


@pytest.mark.parametrize(("engine", "profile"), PROFILES)
@pytest.mark.slow
def test_each_response_follows_its_recurrence_down_a_slope(engine, profile, installed):
    found, scenario = installed(engine), FAMILY.case("e=0.2").scenarios[0]
    settings = found.settings(scenario, profile)
    predicted = predict(scenario, settings, found.method(scenario, settings)).trajectory
    ran = found.run(scenario, settings)
    # Down to rest: a gap that rounding leaves, and MuJoCo's solver, whose velocity is right to 10⁻⁹ of that of the fall
    np.testing.assert_allclose(ran.positions, predicted.positions, atol=1e-11, rtol=0)
    np.testing.assert_allclose(ran.velocities, predicted.velocities, atol=1e-9, rtol=0)


@pytest.mark.parametrize(
    "wrong",
    [
        {"stiffness": STIFFNESS * (1 + 1e-5)},
        pytest.param({"timestep": 5e-5 * (1 + 1e-6)}, marks=pytest.mark.slow),
    ],
)
def test_a_slightly_wrong_spring_is_not_as_predicted(wrong):
    engine, scenario = load_engine("handwritten"), FAMILY.case("e=0.5").scenarios[0]
    settings = engine.settings(scenario, "spring")
    predicted = predict(scenario, settings, engine.method(scenario, settings))
    rebound = FAMILY.quantity("rebound").measure
    told = replace(engine.run(scenario, settings.change(**wrong)), settings=settings)
    assert abs(rebound(told) - rebound(predicted.trajectory)) > predicted.near


def test_a_dashpot_of_the_velocity_after_the_step_is_another_contact():
    """Bullet's takes that one, the lecture's the velocity before: they differ by (c dt)² of it."""
    before, after = Penalty(5e-5, STIFFNESS, 510.0), BulletSpring(5e-5, STIFFNESS, 510.0)
    rates = [law.step(-1e-6, -1.0, 0.0)[1] for law in (before, after)]
    assert rates[0] - rates[1] == pytest.approx((510.0 * 5e-5) ** 2, rel=0.2)


def test_mujocos_spring_does_not_sink_under_the_weight(installed):
    scenario = FAMILY.case("e=0.2").scenarios[0]
    depths = {}
    for name in ("handwritten", "pybullet", "mujoco"):
        engine = installed(name)
        gap = engine.run(scenario, engine.settings(scenario, "spring"))
        depths[name] = -FAMILY.quantity("end").measure(gap)
    assert depths["handwritten"] == pytest.approx(DOWN / STIFFNESS, rel=1e-6)
    assert depths["pybullet"] == pytest.approx(DOWN / STIFFNESS, rel=1e-6)
    # What is left of the chatter: a fall of some steps of 0.2 ms, g dt²
    assert abs(depths["mujoco"]) < 2 * DOWN * 2e-4**2


def test_the_lecture_spring_is_for_short_drops_alone():
    engine, short = load_engine("handwritten"), FAMILY.case("e=0.5").scenarios[0]
    assert "spring" in engine.profiles(short)
    assert "spring" not in engine.profiles(replace(short, duration=0.5))
