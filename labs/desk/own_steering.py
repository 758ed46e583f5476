"""The bodies of a case whose rules steer them, moved by a notebook's own rules beside recordings of engines.

`lab.run` moves bodies with the hand-written world, which asks for functions of other labs. Bodies that steer themselves
and touch nothing need no more than a force and a step, and this module takes both steps with the notebook's functions.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from labs.desk.display import Replay
from labs.desk.own_motion import YOURS, first_scenario, replay_beside
from labs.desk.stock import recorded
from labs.desk.tables import Table, Tables, capital
from labs.grading.diagnosis.probes.one_case import one_case
from reference import lecture
from reference.arrays import Array
from reference.catalogue.scenarios import find
from reference.engines.implementation import Implementation
from reference.engines.profiles import TUNED
from reference.engines.steering import STEPS, steers_of
from reference.errors import InvalidInput
from reference.prediction.steered import without_contacts
from reference.scene.scenario import Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

Function = Callable[..., Any]


@dataclass(frozen=True, eq=False)
class Walkers:
    """Those whom a rule steers, at the start. positions, velocities: (n, 3), m and m/s. radii: (n,), m."""

    positions: Array
    velocities: Array
    radii: Array


def walkers(case: str) -> Walkers:
    """The walkers of a case such as `crossing-streams/θ=70°`.

    Raises
    ------
    InvalidInput, UnknownName
        If there is no such case, or no rule steers balls in it.
    """
    scenario = first_scenario(case)
    bodies = [scenario.body(name) for rule in scenario.steering for name in rule.bodies]
    radii = [body.shape.radius for body in bodies if isinstance(body.shape, Sphere)]
    if not bodies or len(radii) < len(bodies):
        raise InvalidInput(f"in {case} no rule steers balls")
    return Walkers(
        np.array([body.position for body in bodies]), np.array([body.velocity for body in bodies]), np.array(radii)
    )


@dataclass(frozen=True, eq=False)
class SteeredRun:
    """Bodies that your rules steer, beside recordings. numbers: a table for each quantity, of who has which value."""

    replay: Replay
    numbers: tuple[Table, ...]

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        below = Tables("", self.numbers, ())._repr_mimebundle_()
        return {
            "text/plain": f"{self.replay.text}{below['text/plain']}",
            "text/html": f"{self.replay.markup}{below['text/html']}",
        }


class _Own(Implementation):
    """The functions that a notebook hands over. Those of one case alone are asked for one after the other."""

    def __init__(self, functions: Sequence[Function]) -> None:
        super().__init__()
        self._own = {each.__name__: each for each in functions}

    def function(self, name: str) -> Function:
        """One of the functions; refuses a name that was not handed over."""
        if name not in self._own:
            raise InvalidInput(f"these bodies are steered by {name} as well: hand it over")
        return _for_many(name, self._own[name])


def steered(case: str, functions: Sequence[Function], engines: Sequence[str], quantities: Sequence[str]) -> SteeredRun:
    """Bodies of a case that your functions steer, beside engines in which the lab's own functions steered them.

    case: such as `crossing-streams/θ=70°`. functions: all that its rule calls. engines: such as `("mujoco", "dart")`.
    quantities: numbers of the case, by name. Bodies go through each other, and the engines' are tuned recordings.

    Raises
    ------
    InvalidInput, UnknownName
        If there is no such case, engine or quantity, nothing is steered in it, or a function is missing.
    RunFailed
        If a function returns anything else than numbers of the right shape.
    """
    family, chosen = find(case)
    scenario = first_scenario(case)
    if chosen is None or not scenario.steering:
        raise InvalidInput(f"in {case} no rule steers anybody")
    interval = scenario.steering[0].interval
    settings = Settings(interval / STEPS, sample_every=STEPS)
    run = without_contacts(scenario, settings, steers_of(scenario, _Own(functions)))
    _, _, results = recorded(case, engines, TUNED)
    titles = [result.title for result in results]
    numbers = []
    for name in quantities:
        quantity = family.quantity(name)
        values = [(YOURS, quantity.measure(run))]
        for result, title in zip(results, titles, strict=True):
            (row,) = (row for row in result.rows if row.quantity == name)
            values.append((title, row.measured if row.measured is not None else np.nan))
        theory = quantity.theory(chosen)
        values += [("theory", theory)] if theory is not None else []
        unit = f", {quantity.unit}" * bool(quantity.unit)
        rows = tuple((who, f"{value:.5g}".replace("-", "−")) for who, value in values)
        numbers.append(Table(capital(quantity.title), ("", f"value{unit}"), rows))
    return SteeredRun(_replay(case, run, engines), tuple(numbers))


def _replay(case: str, run: Trajectory, engines: Sequence[str]) -> Replay:
    places = [place for place, body in enumerate(run.scenario.bodies) if not body.immovable]
    names = tuple(run.scenario.bodies[place].name for place in places)

    def poses(instants: Array) -> tuple[Array, Array]:
        ways = run.positions[:, places].reshape(len(run.times), -1)
        between = np.stack([np.interp(instants, run.times, along) for along in ways.T], axis=-1)
        upright = np.broadcast_to([1.0, 0.0, 0.0, 0.0], (len(instants), len(places), 4))
        return between.reshape(len(instants), len(places), 3), upright

    return replay_beside(case, names, poses, engines, oblique=False)


def _for_many(name: str, function: Function) -> Function:
    """The function, asked for one body after the other where the lab knows what a single case is."""
    case = one_case(name) if lecture.function(name).role == "written" else None
    return function if case is None else lambda *given: case.one_by_one(function, given)
