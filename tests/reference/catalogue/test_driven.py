"""The driven oscillator: what steps make of resonance, and a wrong drive that its verdicts notice."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference import forces_truth
from reference.catalogue.scenarios import find
from reference.catalogue.scenarios.driven_oscillator import DAMPING, FORCE, MASS, STIFFNESS
from reference.comparison.compare import compare_case
from reference.comparison.verdicts import Verdict
from reference.engines import load_engine

FAMILY, CASE = find("driven-oscillator/Ω=2ω")
(SCENARIO,) = CASE.scenarios
HANDWRITTEN = load_engine("handwritten")


def test_steps_reach_the_amplitude_and_lag_of_their_closed_form():
    settings = HANDWRITTEN.settings(SCENARIO, "step").change(timestep=4e-3)
    run = HANDWRITTEN.run(SCENARIO, settings)
    amplitude, lag = (FAMILY.quantity(name).measure(run) for name in ("amplitude", "lag"))
    stepped = forces_truth.stepped_steady_swing(STIFFNESS, DAMPING, MASS, FORCE, 20.0, settings.timestep)
    exact = forces_truth.steady_swing(STIFFNESS, DAMPING, MASS, FORCE, 20.0)
    # It starts in the steady swing of theory. Of the difference e^(−2.5 · 1.8) = 1 % is left in the last swing.
    for seen, of_steps, of_theory in zip((amplitude, lag), stepped, exact, strict=True):
        assert abs(seen - of_steps) < 0.05 * abs(of_steps - of_theory)


@pytest.mark.parametrize("wrong", [{"phase": 0.6 + 1e-6}, {"angular_frequency": 20.0 * (1 + 1e-7)}])
def test_a_drive_that_is_off_by_a_millionth_fails(wrong):
    (drive,) = SCENARIO.forces
    settings = HANDWRITTEN.settings(SCENARIO, "step").change(timestep=4e-3)
    other = replace(SCENARIO, forces=(replace(drive, **wrong),))
    ran = replace(HANDWRITTEN.run(other, settings), scenario=SCENARIO)
    rows, _ = compare_case(FAMILY, CASE, HANDWRITTEN, "step", settings, [ran])
    assert "lag" in {row.quantity for row in rows if row.verdict is Verdict.FAIL}


def test_energy_balances_where_force_and_velocity_are_of_one_instant():
    run = HANDWRITTEN.run(SCENARIO, HANDWRITTEN.settings(SCENARIO, "exact"))
    assert FAMILY.quantity("balance").measure(run) == pytest.approx(1.0, abs=1e-12)
    amplitude, lag = forces_truth.steady_swing(STIFFNESS, DAMPING, MASS, FORCE, 20.0)
    assert FAMILY.quantity("work").measure(run) == pytest.approx(np.pi * FORCE * amplitude * np.sin(lag), rel=1e-12)
