"""One run of the grid, and what it is to promise something of runs."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from engine_grid import Cell, setup

from reference.engines import Engine
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory


@dataclass(frozen=True)
class Run:
    """A cell of the grid and what its engine made of it, once, for all promises."""

    cell: Cell
    engine: Engine
    scenario: Scenario
    settings: Settings
    trajectory: Trajectory

    def again(self, **changes: object) -> Trajectory:
        """Another run with the same settings, of the same scenario or of one changed in these fields."""
        return self.engine.run(replace(self.scenario, **changes), self.settings)


def run_of(cell: Cell) -> Run:
    engine, scenario, settings = setup(cell)
    return Run(cell, engine, scenario, settings, engine.run(scenario, settings))


@dataclass(frozen=True)
class Promise:
    """A statement about runs: a function that bears its name and raises where a run breaks it, and whom it concerns."""

    check: Callable[[Run], None]
    concerns: Callable[[Cell], bool] = lambda cell: True


def broken(run: Run, promises: Iterable[Promise]) -> list[Exception]:
    """What each broken promise has to say, with its statement as a note. A skipped test remains one."""
    found = []
    for promise in promises:
        if promise.concerns(run.cell):
            try:
                promise.check(run)
            except Exception as error:  # whatever an engine raises: the other promises are to be heard as well
                error.add_note(f"{run.cell} breaks its promise: {promise.check.__name__.replace('_', ' ')}")
                found.append(error)
    return found
