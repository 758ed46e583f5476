"""What every engine promises, whatever it is and whatever it runs.

One test is one run of an engine with every promise that concerns the run. The promises are the functions in
`tests/reference/promises/`. Below are those that no single run can keep.
"""

from __future__ import annotations

from dataclasses import replace

import pytest
from catalogue_rows import counted
from engine_grid import (
    CATALOGUE,
    CELLS,
    ENGINES,
    EXTRA,
    SAYS_NO,
    SCENARIOS,
    Cell,
    each_engine,
    every_cell,
    is_often,
    profiles,
    setup,
)
from promises import PROMISES, Promise, Run, broken, run_of

from reference.catalogue.scenarios import catalogue
from reference.engines import load_engine
from reference.engines.handwritten.scenario_kind import kind
from reference.engines.profiles import WORLD, counts, is_plain
from reference.errors import UnknownName
from reference.scene.settings import Settings
from reference.scene.survey import Survey


@every_cell
def test_a_run_keeps_every_promise_of_an_engine(cell, installed):
    installed(cell.engine)
    if errors := broken(run_of(cell), PROMISES):
        raise ExceptionGroup(f"{cell} breaks {len(errors)} of the promises of an engine", errors)


# The suite itself


def test_the_grid_holds_every_family_and_every_scenario_of_this_suite():
    assert set(SCENARIOS) == {*catalogue(), *(scenario.name for scenario in EXTRA)}
    assert len(SCENARIOS) == len(CATALOGUE) + len(EXTRA), "two scenarios of one name: the second hides the first"
    for engine in ENGINES:
        runs = {cell.scenario for cell in CELLS if cell.engine == engine}
        assert runs | set(SAYS_NO.get(engine, {})) == set(SCENARIOS)
        assert not runs & set(SAYS_NO.get(engine, {}))


def test_the_fast_run_has_each_promise_of_each_engine():
    for engine in ENGINES:
        cells = [cell for cell in CELLS if cell.engine == engine]
        for promise in PROMISES:
            concerned = [cell for cell in cells if promise.concerns(cell)]
            assert any(map(is_often, concerned)) or not concerned, (engine, promise.check.__name__)


def test_all_broken_promises_of_a_run_are_told_and_not_just_the_first():
    def is_late(run: Run) -> None:
        raise AssertionError("0.1 s")

    def is_missing(run: Run) -> None:
        raise ValueError("no run")

    cell = next(cell for cell in CELLS if cell.scenario == "dropped-ball")
    found = broken(run_of(cell), [Promise(is_late), Promise(is_missing), Promise(is_late, lambda cell: False)])
    assert [str(error) for error in found] == ["0.1 s", "no run"]
    assert [error.__notes__ for error in found] == [
        [f"{cell} breaks its promise: is late"],
        [f"{cell} breaks its promise: is missing"],
    ]


# Profiles and settings


@each_engine
def test_an_engine_refuses_what_it_cannot_express_with_a_reason(name, installed):
    installed(name)
    for scenario, (error, reason) in SAYS_NO.get(name, {}).items():
        for profile in profiles(name, scenario):
            engine, made, settings = setup(Cell(name, scenario, profile))
            with pytest.raises(error, match=reason):
                engine.run(made, settings)
            with pytest.raises(error, match=reason):
                engine.run_many([made, made], settings)


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


@each_engine
def test_an_unknown_profile_is_refused_with_the_known_ones(name):
    engine = load_engine(name)
    for scenario in SCENARIOS.values():
        with pytest.raises(UnknownName) as refused:
            engine.settings(scenario, "tunde")
        assert refused.value.choices == tuple(engine.profiles(scenario)), scenario.name
        assert "tunde" in str(refused.value)


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
