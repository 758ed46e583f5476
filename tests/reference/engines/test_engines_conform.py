"""What every engine promises, whatever it is and whatever it runs: trajectories and settings."""

from __future__ import annotations

import pickle
from dataclasses import replace

import numpy as np
import pytest
from catalogue_rows import counted
from engine_grid import (
    CELLS,
    DAMPING,
    ROUNDING,
    SCENARIOS,
    arrays,
    cells_of,
    each_engine,
    every_cell,
    fast_and_slow,
    flies_exactly,
    is_damped,
    is_often,
    same,
    setup,
)

from reference.engines import load_engine
from reference.engines.base import AT_STEP, COMPLIANT, EXACT, INTERPOLATED
from reference.engines.handwritten.scenario_kind import kind
from reference.engines.profiles import WORLD, counts, is_plain
from reference.errors import InvalidInput, UnknownName
from reference.scene.scenario import GRAVITY
from reference.scene.settings import Settings
from reference.scene.survey import Survey

# What a trajectory is


IN_SINES = {("oscillator", "exact"), ("driven-oscillator", "exact")}


@every_cell
def test_a_trajectory_starts_at_time_zero_in_the_scenarios_state(cell, trajectory):
    bodies = SCENARIOS[cell.scenario].bodies
    assert trajectory.times[0] == 0
    # The sines of a closed form give the start to a rounding or two of 1 m; all others begin with the very numbers.
    near = 4e-16 if (cell.scenario, cell.profile) in IN_SINES else 0.0
    np.testing.assert_allclose(trajectory.positions[0], [body.position for body in bodies], rtol=0, atol=near)
    np.testing.assert_allclose(trajectory.velocities[0], [body.velocity for body in bodies], rtol=0, atol=near)
    np.testing.assert_allclose(trajectory.orientations[0], [body.orientation for body in bodies], atol=ROUNDING)
    np.testing.assert_allclose(
        trajectory.angular_velocities[0], [body.angular_velocity for body in bodies], atol=ROUNDING
    )


@every_cell
def test_samples_are_evenly_spaced_until_the_scenario_ends(cell, trajectory):
    _, scenario, settings = setup(cell)
    interval = settings.timestep * settings.sample_every
    np.testing.assert_allclose(trajectory.times, interval * np.arange(len(trajectory.times)), rtol=1e-12)
    tiny = 1e-9 * interval  # 0.6 s are 144 steps of 1/240 s only up to rounding
    assert scenario.duration - tiny <= trajectory.times[-1] < scenario.duration + interval - tiny


@every_cell
def test_a_trajectory_is_finite_and_its_quaternions_have_unit_length(cell, trajectory):
    assert all(np.isfinite(values).all() for values in arrays(trajectory))
    # Engines normalise at every step; the lab's own code never changes an orientation.
    np.testing.assert_allclose(np.linalg.norm(trajectory.orientations, axis=-1), 1, atol=1e-12)


@every_cell
def test_a_trajectory_names_its_engine_scenario_and_settings(cell, trajectory):
    engine, scenario, settings = setup(cell)
    assert (trajectory.engine, trajectory.scenario, trajectory.settings) == (engine.name, scenario, settings)


@every_cell
def test_a_repeated_run_gives_the_same_numbers_and_changes_no_input(cell, trajectory):
    engine, scenario, settings = setup(cell)
    before = pickle.dumps((scenario, settings))
    again = engine.run(scenario, settings)
    assert pickle.dumps((scenario, settings)) == before
    assert same(again, trajectory)


@fast_and_slow([cell for cell in CELLS if any(body.immovable for body in SCENARIOS[cell.scenario].bodies)], is_often)
def test_an_immovable_body_does_not_move(cell, trajectory):
    fixed = [place for place, body in enumerate(SCENARIOS[cell.scenario].bodies) if body.immovable]
    for values in (trajectory.positions, trajectory.orientations):
        assert np.array_equal(values[:, fixed], np.broadcast_to(values[:1, fixed], values[:, fixed].shape))
    assert not trajectory.velocities[:, fixed].any()
    assert not trajectory.angular_velocities[:, fixed].any()


@fast_and_slow(
    [
        cell
        for cell in CELLS
        # By hand penalty springs are for scenarios of up to 0.4 s, and the dropped ball of this test takes longer.
        if cell.scenario == "thrown-ball" and (cell.engine, cell.profile) != ("handwritten", "spring")
    ],
    is_often,
)
def test_scenarios_run_together_give_what_each_gives_alone(cell, installed):
    engine = installed(cell.engine)
    first = SCENARIOS["dropped-ball"]
    ball = replace(first.body("ball"), position=(0.0, 0.0, 0.4))
    lower = replace(first, bodies=tuple(ball if body.name == "ball" else body for body in first.bodies), duration=0.35)
    settings = engine.settings(first, cell.profile)
    together = engine.run_many([first, lower, first], settings)
    assert all(
        same(one, engine.run(scenario, settings)) for one, scenario in zip(together, (first, lower, first), strict=True)
    )


# Settings


@every_cell
def test_an_engine_runs_with_the_timestep_it_is_given(cell, installed):
    installed(cell.engine)
    engine, scenario, settings = setup(cell)
    changed = settings.change(timestep=2 * settings.timestep)
    trajectory = engine.run(replace(scenario, duration=0.05), changed)
    assert trajectory.settings == changed
    interval = changed.timestep * changed.sample_every
    np.testing.assert_allclose(np.diff(trajectory.times), interval, rtol=1e-9)


@cells_of("thrown-ball")
def test_a_longer_timestep_shows_in_the_flight_itself(cell, installed):
    installed(cell.engine)
    engine, scenario, settings = setup(cell)
    stretch = 2 * settings.timestep
    coarse = engine.run(scenario, settings.change(timestep=stretch, sample_every=1))
    fine = engine.run(scenario, settings.change(sample_every=2))
    lower = (fine.position("thrown") - coarse.position("thrown"))[:, 2]
    expected = 0 * fine.times if flies_exactly(cell) else GRAVITY * fine.times * settings.timestep / 2  # g t dt/2 each
    # Drag is taken in steps too: it adds a first-order term of its own, a share 0.04 (1 + 2 v) t of this one.
    np.testing.assert_allclose(
        lower, expected, rtol=DAMPING * 13 * scenario.duration if is_damped(cell) else 1e-6, atol=1e-10
    )


@each_engine
def test_one_profile_counts_and_is_first_and_the_plain_one_is_last(name):
    for scenario in SCENARIOS.values():
        found = load_engine(name).profiles(scenario)
        if name == "handwritten" and kind(scenario) is None:
            # The world counts as well, and runs what no other method can; questions have one method, which is exact.
            assert list(found) == (["exact"] if isinstance(scenario, Survey) else [WORLD])
            continue
        first, *between, last = found
        # No closed form says where an orbit leads, or how a cloth comes to lie on a ball.
        by_hand = [WORLD if scenario.name in ("orbit", "cloth-over-a-ball") else "exact", "step"]
        assert [first, last] == (by_hand if name == "handwritten" else ["tuned", "stock"]), scenario.name
        assert not any((counts(each) and each != WORLD) or is_plain(each) for each in between), scenario.name
        assert all(line.strip() for line in found.values()), scenario.name


@every_cell
def test_every_profile_names_one_of_four_ways_to_resolve_an_impact(cell):
    engine, scenario, settings = setup(cell)
    method = engine.method(scenario, settings)
    assert method.kind in (EXACT, INTERPOLATED, AT_STEP, COMPLIANT)
    assert 0 <= method.recovery <= 1
    assert method.stiffness > 0
    assert method.rest_speed >= 0


@each_engine
def test_an_unknown_profile_is_refused_with_the_known_ones(name):
    engine = load_engine(name)
    for scenario in SCENARIOS.values():
        with pytest.raises(UnknownName) as refused:
            engine.settings(scenario, "tunde")
        assert refused.value.choices == tuple(engine.profiles(scenario)), scenario.name
        assert "tunde" in str(refused.value)


@cells_of("thrown-ball")  # settings are the same kind of thing whatever the scenario
def test_an_unknown_setting_is_refused_with_the_known_ones(cell):
    _, _, settings = setup(cell)
    with pytest.raises(UnknownName) as refused:
        settings.change(timestpe=0.1)
    assert refused.value.choices == ("timestep", "sample_every", *settings.options)


@every_cell
def test_a_timestep_longer_than_the_scenario_is_refused(cell, installed):
    installed(cell.engine)
    engine, scenario, settings = setup(cell)
    with pytest.raises(InvalidInput, match="longer than"):
        engine.run(scenario, settings.change(timestep=1.01 * scenario.duration))
    with pytest.raises(InvalidInput, match="1e\\+08 is the most"):  # it would end in some hours
        engine.run(scenario, settings.change(timestep=1e-9 * scenario.duration))


@each_engine
def test_a_run_covers_its_scenario_in_the_fewest_whole_samples(name):
    engine = load_engine(name)
    for duration, settings, steps in (
        (3.0, Settings(1 / 240), 720),  # 3/(1/240) is 720.0000000000001 in floats
        (0.3, Settings(0.1), 3),  # and 0.3/0.1 is 2.9999999999999996
        (1.0, Settings(0.3), 4),
        (1.0, Settings(1e-4, 10), 10_000),
        (1.0003, Settings(1e-4, 10), 10_010),
    ):
        scenario = replace(SCENARIOS["thrown-ball"], duration=duration)
        settings = replace(
            engine.settings(scenario, counted(name)), timestep=settings.timestep, sample_every=settings.sample_every
        )
        assert engine.check_settings(scenario, settings) == steps


@each_engine
def test_a_duration_between_two_samples_is_run_to_the_next_one(name, installed):
    engine, scenario = installed(name), replace(SCENARIOS["thrown-ball"], duration=0.1037)
    settings = engine.settings(scenario, counted(name)).change(timestep=1e-3, sample_every=4)
    assert engine.run(scenario, settings).times[-1] == pytest.approx(0.104)


@each_engine
def test_an_engine_knows_its_version(name, installed):
    assert installed(name).version().strip()
