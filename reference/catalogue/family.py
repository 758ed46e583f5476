"""A family: one question asked in several cases, what is measured, what is expected and why."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.grid import Grid
from reference.engines.base import EXACT, Engine, Method
from reference.engines.profiles import WORLD
from reference.errors import InvalidInput, UnknownName
from reference.prediction.predicted import Prediction
from reference.scene.query import Query
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

_ANY_TIMESTEP = 1e-3
"""s. Theory does not depend on the timestep; only what a method adds to it does."""


@dataclass(frozen=True)
class Expectation:
    """What theory says of one quantity, and how near is near enough; all in the quantity's unit.

    value: the closed form. tolerance: what counts as near to it, a convention, with its reason. shift_reason: why the
    method is farther off, in a few words. Where a prediction of the method exists, that says how far. Elsewhere shift
    is the change of the value that the method is known to cause, and shift_tolerance the accepted distance from value +
    shift, derived from the next order. size: how large the quantity is, where the value does not say it: what a
    deviation has to reach to be disagreement, and what the band of a prediction is a share of.
    """

    value: float
    tolerance: float
    reason: str
    shift: float = 0.0
    shift_reason: str = ""
    shift_tolerance: float = 0.0
    size: float = 0.0


@dataclass(frozen=True)
class Quantity:
    """One number that is measured in every case.

    measure: trajectory → number. expect: case, settings and the engine's method → expectation; None where theory has
    no figure, in this case or in any; then the number is only shown. scale: what a deviation is judged against when it
    is printed in percent, None to print it as it is. slack: how much of it a method leaves to chance, in its unit,
    besides the band of the prediction; None where nothing is. absent: what a run does that has no such number.
    share_of: what a number without a unit is a share of, where its title does not say so. asked: the same number by the
    implementation's own answers to questions of geometry, where it is to be that; a prediction, which answers none, is
    measured. cost: it says what a run takes, a number that implementations need not agree on. reported: it is read from
    what an implementation says of its contacts. No recurrence predicts a cost or a report.
    """

    name: str
    title: str
    unit: str
    measure: Callable[[Trajectory], float]
    expect: Callable[[Case, Settings, Method], Expectation | None] | None
    scale: Callable[[Case], float] | None = None
    slack: Callable[[Case, Settings, Method], float] | None = None
    absent: str = "has no such number"
    share_of: str = ""
    asked: Callable[[Trajectory, Callable[[Query], float]], float] | None = None
    cost: bool = False
    reported: bool = False

    def theory(self, case: Case) -> float | None:
        """What theory says, which depends on no engine and no timestep; None where it has no figure."""
        expectation = self.expect(case, Settings(_ANY_TIMESTEP), Method(EXACT)) if self.expect else None
        return expectation.value if expectation else None

    def expected_value(self, case: Case) -> float:
        """What theory says; `InvalidInput` where it has no figure."""
        value = self.theory(case)
        if value is None:
            raise InvalidInput(f"{self.name} has no expected value in {case.name}")
        return value


@dataclass(frozen=True)
class Curve:
    """What is plotted of one case: a time series of its first scenario."""

    case: str
    title: str
    y_label: str
    values: Callable[[Trajectory], Array]
    until: float | None = None
    """End of the plotted time, s."""


@dataclass(frozen=True)
class Convergence:
    """Error of one quantity in one case against the timestep.

    factors: the timesteps, as multiples of a profile's own. every_step: whether every step is sampled, for a quantity
    that is read from samples and would otherwise show their interval.
    """

    case: str
    quantity: str
    factors: tuple[float, ...] = (4.0, 2.0, 1.0, 0.5)
    every_step: bool = False


@dataclass(frozen=True)
class Family:
    """A family of cases and all that the report says about it.

    statements: numbers of the lecture's statements. about: what it is. expected: the expected value and why.
    why: why the implementations differ. grid: the parameters that can be moved, None if there are none. predict: what
    a method must give in a scenario, None where no recurrence is written for the family.
    """

    name: str
    title: str
    topic: str
    statements: tuple[int, ...]
    about: str
    expected: str
    why: tuple[str, ...]
    cases: tuple[Case, ...]
    quantities: tuple[Quantity, ...]
    curve: Curve
    convergence: Convergence
    grid: Grid | None = None
    predict: Callable[[Scenario, Settings, Method], Prediction | None] | None = None

    @property
    def steered(self) -> bool:
        """Whether hand-written rules steer bodies of it, in every engine."""
        return any(scenario.steering for case in self.cases for scenario in case.scenarios)

    def profiles(self, engine: Engine) -> Mapping[str, str]:
        """The profiles that an engine has for a case of this family, one that counts first, with a line on each."""
        found: dict[str, str] = {}
        for case in self.cases:
            found |= engine.profiles(case.scenarios[0])
        return found

    def cases_in(self, engine: Engine, profile: str) -> tuple[Case, ...]:
        """The cases that an engine runs in a profile if none is named: all that it can, except in the world.

        There it runs those that none of its other profiles can, or else the plotted one: what the general simulator
        costs in accuracy shows there.
        """
        able = {case.name: engine.profiles(case.scenarios[0]) for case in self.cases}
        own = [name for name, has in able.items() if profile in has]
        if profile == WORLD:
            own = [name for name in own if len(able[name]) == 1] or [self.curve.case]
        return tuple(case for case in self.cases if case.name in own)

    def case(self, name: str) -> Case:
        """Return the case of that name."""
        for case in self.cases:
            if case.name == name:
                return case
        raise UnknownName(f"case of {self.name}", name, (case.name for case in self.cases))

    def quantity(self, name: str) -> Quantity:
        """Return the quantity of that name."""
        for quantity in self.quantities:
            if quantity.name == name:
                return quantity
        raise UnknownName(f"quantity of {self.name}", name, (quantity.name for quantity in self.quantities))
