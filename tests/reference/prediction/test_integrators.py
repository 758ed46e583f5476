"""The recurrences of the integrators: their orders, what they keep, and that hand-written code follows them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.catalogue.scenarios import find
from reference.comparison.compare import compare_case
from reference.comparison.verdicts import Verdict
from reference.engines import load_engine
from reference.prediction import integrators, loaded
from reference.scene.settings import Settings

SWING = np.array([[1.0, 0.0, 0.5]]), np.array([[0.0, 2.0, 0.0]])
ORDERS = {
    integrators.semi_implicit_euler: 1,
    integrators.explicit_euler: 1,
    integrators.velocity_verlet: 2,
    integrators.runge_kutta: 4,
}
FAMILY, CASE = find("orbit/e=0.5,m=3")
HANDWRITTEN = load_engine("handwritten")


@pytest.mark.parametrize(("step", "order"), ORDERS.items(), ids=lambda each: getattr(each, "__name__", ""))
def test_an_integrator_has_its_order_on_an_undamped_swing(step, order):
    errors = []
    for count in (50, 100):
        (place, velocity), dt = SWING, 1.0 / count
        for _ in range(count):
            place, velocity = step(lambda x, v: -4.0 * x, place, velocity, dt)
        exact = SWING[0] * np.cos(2.0) + SWING[1] * np.sin(2.0) / 2
        errors.append(np.linalg.norm(place - exact))
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.1)


def test_semi_implicit_euler_is_verlet_with_another_start():
    dt, pull = 0.02, lambda x, v: -4.0 * x
    place, velocity = SWING
    other, moving = place, velocity + dt / 2 * pull(place, velocity)
    for _ in range(100):
        place, velocity = integrators.semi_implicit_euler(pull, place, velocity, dt)
        other, moving = integrators.velocity_verlet(pull, other, moving, dt)
    np.testing.assert_allclose(place, other, atol=1e-13)


def test_each_integrator_by_hand_is_judged_by_its_own_recurrence_alone():
    case = replace(CASE, scenarios=(replace(CASE.scenarios[0], duration=1.0),))
    (scenario,) = case.scenarios
    for profile in ("runge-kutta", "verlet", "explicit", "step"):
        settings = replace(HANDWRITTEN.settings(scenario, profile), timestep=1e-2)
        own = HANDWRITTEN.run(scenario, settings)
        for other in ("runge-kutta", "verlet", "explicit", "step"):
            method = HANDWRITTEN.method(scenario, HANDWRITTEN.settings(scenario, other))
            expected = loaded.predict(scenario, settings, method).trajectory
            near = np.max(np.abs(own.positions - expected.positions))
            assert (near < 1e-11) == (other == profile), (profile, other)


def test_a_pull_that_is_too_strong_by_a_millionth_fails():
    engine = load_engine("handwritten")
    (scenario,) = CASE.scenarios
    settings = Settings(4e-3, options={"policy": "verlet"})
    (pull,) = scenario.attractions
    stronger = replace(scenario, attractions=(replace(pull, constant=pull.constant * (1 + 1e-6)),))
    wrong = replace(engine.run(stronger, settings), scenario=scenario)
    rows, _ = compare_case(FAMILY, CASE, engine, "verlet", settings, [wrong])
    assert {row.quantity for row in rows if row.verdict is Verdict.FAIL} >= {"period", "near", "far"}
    right, _ = compare_case(FAMILY, CASE, engine, "verlet", settings)
    assert Verdict.FAIL not in {row.verdict for row in right}
