"""The longest timestep for springs, dampers and drag: closed forms, steps that grow, and rows that name it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from reference.catalogue.scenarios import find
from reference.comparison.compare import compare_case
from reference.engines import load_engine
from reference.scene.forces import Fluid, Spring
from reference.scene.scenario import Body, Scenario, Sphere
from reference.scene.step_limit import step_limit
from solutions.forces import spring_step_limit


def balls(*mass, **others):
    """Balls on a line that is aslant, 1 m apart, and a scenario of them."""
    line = np.array([2, -1, 2]) / 3
    bodies = tuple(Body(f"ball {n}", Sphere(0.1), m, tuple(n * line)) for n, m in enumerate(mass))
    return Scenario("balls", bodies, (), 1.0, **others)


@pytest.mark.parametrize(("stiffness", "damping"), [(300.0, 0.0), (0.0, 70.0), (40.0, 9.0)])
def test_one_spring_has_the_limit_of_its_reduced_mass(stiffness, damping):
    spring = Spring("ball 0", "ball 1", stiffness, 0.3, damping)
    reduced = 1 / (1 / 0.4 + 1 / 1.7)
    limit = spring_step_limit(stiffness, reduced, damping)[1] if stiffness else 2 * reduced / damping
    assert step_limit(balls(0.4, 1.7, springs=(spring,))) == pytest.approx(limit, rel=1e-12)
    tied = Spring("", "ball 1", stiffness, 0.3, damping, point_a=(3.0, 1.0, -2.0))
    fixed = spring_step_limit(max(stiffness, 1e-12), 1.7, damping)[1]
    assert step_limit(balls(math.inf, 1.7, springs=(tied,))) == pytest.approx(fixed, rel=1e-12)


def test_drag_has_the_limit_two_m_over_c_of_the_lightest_ball_and_nothing_has_none():
    assert step_limit(balls(0.4, 1.7)) == math.inf
    found = step_limit(balls(0.4, 1.7, fluid=Fluid(viscosity=3.0)))
    assert found == pytest.approx(2 * 0.4 / (6 * math.pi * 3.0 * 0.1), rel=1e-12)


def test_a_chain_grows_beyond_the_limit_and_not_before():
    mass, stiffness, damping = np.array([0.3, 1.1, 0.6]), np.array([90.0, 200.0]), np.array([1.5, 0.0])
    springs = tuple(Spring(f"ball {n}", f"ball {n + 1}", stiffness[n], 1.0, damping[n]) for n in (0, 1))
    rows = np.diff(np.eye(3), axis=0)
    k, c = (rows.T @ np.diag(each) @ rows for each in (stiffness, damping))
    limit = step_limit(balls(*mass, springs=springs))
    for share, grows in ((0.99, False), (1.15, True)):
        place, speed = np.array([0.01, -0.02, 0.015]), np.zeros(3)
        for _ in range(800):
            speed = speed - share * limit * (k @ place + c @ speed) / mass
            place = place + share * limit * speed
        assert (np.max(np.abs(place)) > 1e3) == grows  # the two largest eigenvalues need not be of one motion


@pytest.mark.parametrize("profile", ["step", "world"])
def test_a_run_that_fails_beyond_the_limit_names_it(profile):
    family, case = find("oscillator/ζ=2")
    engine = load_engine("handwritten")
    for timestep, names in ((30.0, True), (1e-3, False)):
        scenario = replace(case.scenarios[0], duration=400 * timestep)
        limit = step_limit(scenario)
        settings = engine.settings(case.scenarios[0], profile).change(timestep=timestep, sample_every=1)
        rows, _ = compare_case(family, replace(case, scenarios=(scenario,)), engine, profile, settings)
        told = f"need a timestep below {limit:.3g} s, and here it is 30 s"
        assert any(told in row.note for row in rows) == names
