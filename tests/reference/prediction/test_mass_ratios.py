"""A light ball between heavy ones: solvers with enough sweeps, solvers with too few, and the limit of the sweeps."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.mass_ratios import LINE, WIND, predict
from reference.engines import load_engine
from reference.prediction import sweeps
from reference.scene.pressed import sweeps_needed

FAMILY = catalogue()["mass-ratios"]
LIGHTEST = FAMILY.case("10000 : 1 : 3000").scenarios[0]


def along(trajectory) -> np.ndarray:
    return (trajectory.velocities[-1] - WIND) @ LINE


@pytest.mark.parametrize("engine", ["handwritten", "pybullet", "mujoco", pytest.param("dart", marks=pytest.mark.slow)])
def test_an_impact_through_a_ten_thousandth_follows_the_recurrence(engine, installed):
    found = installed(engine)
    settings = found.settings(LIGHTEST, "world" if engine == "handwritten" else "tuned")
    predicted = predict(LIGHTEST, settings, found.method(LIGHTEST, settings)).trajectory
    # Impulses of 2·10⁴ N s, of which a share of 10⁻⁴ changes the velocities: rounding of some 10⁻¹² m/s
    np.testing.assert_allclose(along(found.run(LIGHTEST, settings)), along(predicted), atol=1e-10)


@pytest.mark.parametrize(
    ("engine", "profile", "change", "first", "last"),
    [
        ("pybullet", "tuned", {"solver_iterations": 100}, 9.32, 2.27),
        ("dart", "tuned", {"solver_iterations": 1000}, 6.94, 10.20),
        pytest.param("handwritten", "world", {"response": "sequential"}, 7.15, 9.48, marks=pytest.mark.slow),
    ],
)
def test_with_too_few_sweeps_each_solver_fails_in_its_own_way(engine, profile, change, first, last, installed):
    found = installed(engine)
    velocities = along(found.run(LIGHTEST, found.settings(LIGHTEST, profile).change(**change)))
    assert velocities[[0, 2]] == pytest.approx([first, last], abs=0.01)


def test_sweeps_grow_with_the_mass_on_either_side_of_a_light_body():
    assert sweeps_needed(LIGHTEST) == 20 * 10**4
    first, middle, last = LIGHTEST.bodies
    assert sweeps_needed(replace(LIGHTEST, bodies=(replace(first, mass=2.0), middle, last))) == 20 * 3000
    # With one neighbour a body has nothing to carry on, however light it is.
    assert sweeps_needed(replace(LIGHTEST, pairs=LIGHTEST.pairs[:1])) == 20
    assert sweeps_needed(catalogue()["two-balls"].case("e=1,m=1e+06,b=0.5").scenarios[0]) == 20


def test_the_limit_of_many_sweeps_is_found_directly(monkeypatch):
    """A hundred sweeps are far from the limit; ten thousand reach it."""
    scenario, engine = FAMILY.case("100 : 1 : 30").scenarios[0], load_engine("handwritten")
    settings = engine.settings(scenario, "world")
    method = engine.method(scenario, settings)
    directly = along(predict(scenario, settings, method).trajectory)
    monkeypatch.setattr(sweeps, "MOST_SWEEPS", 10_000)
    np.testing.assert_allclose(directly, along(predict(scenario, settings, method).trajectory), atol=1e-12)
