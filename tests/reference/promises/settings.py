"""What every engine promises of its settings."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from engine_grid import DAMPING, Cell, flies_exactly, is_damped

from reference.engines.base import AT_STEP, COMPLIANT, EXACT, INTERPOLATED
from reference.errors import InvalidInput, UnknownName
from reference.scene.scenario import GRAVITY

from .run import Promise, Run


def an_engine_runs_with_the_timestep_it_is_given(run: Run) -> None:
    changed = run.settings.change(timestep=2 * run.settings.timestep)
    trajectory = run.engine.run(replace(run.scenario, duration=0.05), changed)
    assert trajectory.settings == changed
    interval = changed.timestep * changed.sample_every
    np.testing.assert_allclose(np.diff(trajectory.times), interval, rtol=1e-9)


def a_longer_timestep_shows_in_the_flight_itself(run: Run) -> None:
    settings, cell = run.settings, run.cell
    coarse = run.engine.run(run.scenario, settings.change(timestep=2 * settings.timestep, sample_every=1))
    fine = run.engine.run(run.scenario, settings.change(sample_every=2))
    lower = (fine.position("thrown") - coarse.position("thrown"))[:, 2]
    expected = 0 * fine.times if flies_exactly(cell) else GRAVITY * fine.times * settings.timestep / 2  # g t dt/2 each
    # Drag is taken in steps too: it adds a first-order term of its own, a share 0.04 (1 + 2 v) t of this one.
    near = DAMPING * 13 * run.scenario.duration if is_damped(cell) else 1e-6
    np.testing.assert_allclose(lower, expected, rtol=near, atol=1e-10)


def a_profile_names_one_of_four_ways_to_resolve_an_impact(run: Run) -> None:
    method = run.engine.method(run.scenario, run.settings)
    assert method.kind in (EXACT, INTERPOLATED, AT_STEP, COMPLIANT)
    assert 0 <= method.recovery <= 1
    assert method.stiffness > 0
    assert method.rest_speed >= 0


def an_unknown_setting_is_refused_with_the_known_ones(run: Run) -> None:
    with pytest.raises(UnknownName) as refused:
        run.settings.change(timestpe=0.1)
    assert refused.value.choices == ("timestep", "sample_every", *run.settings.options)


def a_timestep_longer_than_the_scenario_is_refused(run: Run) -> None:
    with pytest.raises(InvalidInput, match="longer than"):
        run.engine.run(run.scenario, run.settings.change(timestep=1.01 * run.scenario.duration))
    with pytest.raises(InvalidInput, match="1e\\+08 is the most"):  # it would end in some hours
        run.engine.run(run.scenario, run.settings.change(timestep=1e-9 * run.scenario.duration))


def is_thrown(cell: Cell) -> bool:
    """Whether a ball without spin flies, which meets nothing."""
    return cell.scenario == "thrown-ball"


PROMISES = (
    Promise(a_profile_names_one_of_four_ways_to_resolve_an_impact),
    Promise(an_unknown_setting_is_refused_with_the_known_ones),
    Promise(a_timestep_longer_than_the_scenario_is_refused),
    Promise(an_engine_runs_with_the_timestep_it_is_given),
    Promise(a_longer_timestep_shows_in_the_flight_itself, is_thrown),
)
