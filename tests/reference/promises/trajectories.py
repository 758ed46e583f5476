"""What every engine promises of a trajectory, whatever the engine is and whatever it runs."""

from __future__ import annotations

import pickle

import numpy as np
from engine_grid import ROUNDING, SCENARIOS, Cell, arrays, is_rare, same

from .run import Promise, Run

IN_SINES = {("oscillator", "exact"), ("driven-oscillator", "exact")}


def a_trajectory_starts_at_time_zero_in_the_scenarios_state(run: Run) -> None:
    trajectory, bodies = run.trajectory, run.scenario.bodies
    assert trajectory.times[0] == 0
    # The sines of a closed form give the start to a rounding or two of 1 m; all others begin with the very numbers.
    near = 4e-16 if (run.cell.scenario, run.cell.profile) in IN_SINES else 0.0
    np.testing.assert_allclose(trajectory.positions[0], [body.position for body in bodies], rtol=0, atol=near)
    np.testing.assert_allclose(trajectory.velocities[0], [body.velocity for body in bodies], rtol=0, atol=near)
    np.testing.assert_allclose(trajectory.orientations[0], [body.orientation for body in bodies], atol=ROUNDING)
    np.testing.assert_allclose(
        trajectory.angular_velocities[0], [body.angular_velocity for body in bodies], atol=ROUNDING
    )


def samples_are_evenly_spaced_until_the_scenario_ends(run: Run) -> None:
    times, duration = run.trajectory.times, run.scenario.duration
    interval = run.settings.timestep * run.settings.sample_every
    np.testing.assert_allclose(times, interval * np.arange(len(times)), rtol=1e-12)
    tiny = 1e-9 * interval  # 0.6 s are 144 steps of 1/240 s only up to rounding
    assert duration - tiny <= times[-1] < duration + interval - tiny


def a_trajectory_is_finite_and_its_quaternions_have_unit_length(run: Run) -> None:
    assert all(np.isfinite(values).all() for values in arrays(run.trajectory))
    # Engines normalise at every step; the lab's own code never changes an orientation.
    np.testing.assert_allclose(np.linalg.norm(run.trajectory.orientations, axis=-1), 1, atol=1e-12)


def a_trajectory_names_its_engine_scenario_and_settings(run: Run) -> None:
    made = run.trajectory
    assert (made.engine, made.scenario, made.settings) == (run.engine.name, run.scenario, run.settings)


def a_repeated_run_gives_the_same_numbers_and_changes_no_input(run: Run) -> None:
    before = pickle.dumps((run.scenario, run.settings))
    again = run.engine.run(run.scenario, run.settings)
    assert pickle.dumps((run.scenario, run.settings)) == before
    assert same(again, run.trajectory)


def an_immovable_body_does_not_move(run: Run) -> None:
    trajectory = run.trajectory
    fixed = [place for place, body in enumerate(run.scenario.bodies) if body.immovable]
    for values in (trajectory.positions, trajectory.orientations):
        assert np.array_equal(values[:, fixed], np.broadcast_to(values[:1, fixed], values[:, fixed].shape))
    assert not trajectory.velocities[:, fixed].any()
    assert not trajectory.angular_velocities[:, fixed].any()


def has_an_immovable_body(cell: Cell) -> bool:
    return any(body.immovable for body in SCENARIOS[cell.scenario].bodies)


PROMISES = (
    Promise(a_trajectory_starts_at_time_zero_in_the_scenarios_state),
    Promise(samples_are_evenly_spaced_until_the_scenario_ends),
    Promise(a_trajectory_is_finite_and_its_quaternions_have_unit_length),
    Promise(a_trajectory_names_its_engine_scenario_and_settings),
    Promise(an_immovable_body_does_not_move, has_an_immovable_body),
    Promise(a_repeated_run_gives_the_same_numbers_and_changes_no_input, lambda cell: not is_rare(cell)),
)
