"""The smallest fault that turns a verdict red, for one family in one implementation."""

from __future__ import annotations

import contextlib
import functools
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from reference.catalogue.case import Case
from reference.catalogue.family import Family
from reference.comparison.compare import Number, judged, measured, predicted
from reference.comparison.faults import FAULTS, Fault, run_with_fault
from reference.comparison.verdicts import Row, Verdict
from reference.engines.base import Engine, Method
from reference.errors import CannotExpress, InvalidInput, NeedsFunction, RunFailed, as_failed_run
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

FIRST_OF_AN_ENSEMBLE = 3
"""So many scenarios of an ensemble are run where each is judged by itself; where the mean is judged, all are."""
NOTHING = 1e-6
"""Share of a number, or of one unit, that a fault has to change to have an effect; a solver may leave less."""
MARGIN, CLOSE = 1.05, 1.25
"""A size is tried a little above the expected one, and kept if no smaller one than by this factor may be noticed."""
MOST_RUNS = 6
"""Of one fault in one case, after those that say where to look."""
HALVINGS = 48
"""From the largest size down to rounding, on the line through two runs."""
Numbers = Mapping[str, Number]


class Outcome(StrEnum):
    """What came of injecting a fault."""

    NOTICED = "noticed"
    NO_EFFECT = "no effect"
    NOT_NOTICED = "not noticed"
    NOT_TRIED = "not tried"


@dataclass(frozen=True)
class Finding:
    """What came of one fault. size: the smallest that was noticed, a share or in degrees; None for one without a size.

    case, quantity: the row that turned red; of a sign not noticed, one that did not. note: why it was not tried.
    """

    fault: str
    outcome: Outcome
    size: float | None = None
    case: str = ""
    quantity: str = ""
    note: str = ""


@dataclass(frozen=True)
class Sensitivity:
    """What one implementation's verdicts notice in a family.

    title: of the engine. predicted: whether the method has a recurrence there, so that it is judged to rounding.
    findings: one for each fault that the family's cases name.
    """

    family: str
    engine: str
    title: str
    profile: str
    predicted: bool
    findings: tuple[Finding, ...]

    def finding(self, fault: str) -> Finding | None:
        """What came of the fault of that name; None where the family does not name it."""
        return next((each for each in self.findings if each.fault == fault), None)


def sensitivity(family: Family, engine: Engine, profile: str) -> tuple[Sensitivity, tuple[Row, ...]]:
    """Inject each fault that the family's cases name; return the findings, and the rows without any fault.

    A coefficient that changes nothing in the chosen cases, such as the friction of a ball that rolls, is tried in the
    family's other cases too. Cases that the implementation cannot run are left out; errors as those of the first case
    where it can run none.
    """
    able = [case for case in (*chosen(family), *family.cases) if profile in engine.profiles(case.scenarios[0])]
    known = {case.name: case for case in able}
    names = [case.name for case in chosen(family) if case.name in known]
    others = [name for name in known if name not in names]
    run = functools.cache(lambda name: Subject.of(family, known[name], engine, profile))
    subjects = list(_possible(names, run)) or list(_possible(others, run))[:1] or [run([*names, *others][0])]
    found = []
    for fault in FAULTS:
        finding = _with_effect(each.finding(fault) for each in subjects if each.names(fault))
        if fault.of_a_pair and (finding is None or finding.outcome is Outcome.NO_EFFECT):
            rest = (each for each in _possible(others, run) if each not in subjects)
            finding = _with_effect(each.finding(fault) for each in rest if each.names(fault)) or finding
        if finding is not None:
            found.append(finding)
    rows = tuple(row for each in subjects for row in each.rows)
    judged_to_rounding = any(row.predicted is not None for row in rows)
    return Sensitivity(family.name, engine.name, engine.title, profile, judged_to_rounding, tuple(found)), rows


def _possible(names: Iterable[str], run: Callable[[str], Subject]) -> Iterator[Subject]:
    """The runs of those cases that the implementation can run."""
    for name in names:
        with contextlib.suppress(CannotExpress, NeedsFunction):
            yield run(name)


def chosen(family: Family) -> list[Case]:
    """The case of the convergence study, and for each coefficient that it lacks the first case that has it."""
    found = [family.case(family.convergence.case)]
    for fault in (fault for fault in FAULTS if fault.of_a_pair):
        with_it = [case for case in family.cases if fault.named(case.scenarios[0], Method(""))]
        if with_it and not any(case in with_it for case in found):
            found.append(with_it[0])
    return found


def _with_effect(found: Iterable[Finding]) -> Finding | None:
    """The first finding of an effect; the first of all where none is."""
    first = None
    for finding in found:
        if finding.outcome is not Outcome.NO_EFFECT:
            return finding
        first = first or finding
    return first


@dataclass(frozen=True, eq=False)  # compared by identity: one run is one run
class Subject:
    """One case in one implementation, run without a fault. judging: the family, its predictions computed once."""

    family: Family
    judging: Family
    case: Case
    engine: Engine
    profile: str
    settings: Settings
    method: Method
    numbers: Numbers
    rows: tuple[Row, ...]

    @classmethod
    def of(cls, family: Family, case: Case, engine: Engine, profile: str) -> Subject:
        """Run the case; errors as those of `Engine.run_many`."""
        settings = engine.settings(case.scenarios[0], profile)
        method = engine.method(case.scenarios[0], settings)
        if predicted(family, case, settings, method):
            case = replace(case, scenarios=case.scenarios[:FIRST_OF_AN_ENSEMBLE])
        with as_failed_run():
            numbers = _measured(family, engine.run_many(case.scenarios, settings), engine)
        judging = _remembering(family)
        rows = judged(judging, case, engine.name, profile, settings, method, numbers)
        return cls(family, judging, case, engine, profile, settings, method, numbers, tuple(rows))

    def names(self, fault: Fault) -> bool:
        """Whether there is anything in the case that this fault can spoil."""
        if fault.of_contacts and not any(quantity.reported for quantity in self.family.quantities):
            return False
        return fault.named(self.case.scenarios[0], self.method)

    def finding(self, fault: Fault) -> Finding:
        """What comes of a fault in this case."""
        if all(row.verdict in (Verdict.FAIL, Verdict.CRASHED, Verdict.SHOWN) for row in self.rows):
            return Finding(fault.name, Outcome.NOT_TRIED, note="it fails without a fault")
        try:
            return self._smallest(fault) if fault.most else self._without_size(fault)
        except (CannotExpress, NeedsFunction, RunFailed, InvalidInput) as error:
            return Finding(fault.name, Outcome.NOT_TRIED, note=str(error))

    def _without_size(self, fault: Fault) -> Finding:
        numbers = self.with_fault(fault, 0.0)
        red, changed = self.red(numbers), self._changed(numbers)
        judged = {row.quantity for row in self.rows if row.verdict not in (Verdict.FAIL, Verdict.SHOWN)}
        if fault.mirrored and (missed := [name for name in changed if name in judged and name not in red]):
            return Finding(fault.name, Outcome.NOT_NOTICED, None, self.case.name, missed[0])
        return self._noticed(fault, None, red) or self._missed(fault, [numbers])

    def _smallest(self, fault: Fault) -> Finding:
        """Follow the line through two runs to where a verdict turns red, and run there, until a run confirms it."""
        signs = [sign for sign in (1.0, -1.0) if self._possible(fault, sign * fault.most)]
        first, size = self.with_fault(fault, signs[0] * fault.first), signs[0] * fault.first
        guesses = {sign: self._guess(first, size, sign, fault.most) for sign in signs}
        sign = min(signs, key=guesses.__getitem__)
        guess, low, high, red = guesses[sign], 0.0, math.inf, list[str]()
        if math.isinf(guess):  # no slope, or too small a one: the largest sizes say whether there is an effect at all
            at_most = {sign: self.with_fault(fault, sign * fault.most) for sign in signs}
            reds = {sign: names for sign, numbers in at_most.items() if (names := self.red(numbers))}
            if not reds:
                return self._missed(fault, list(at_most.values()))
            sign, red = next(iter(reds.items()))
            high, low = fault.most, fault.first if sign == signs[0] and not self.red(first) else 0.0
        for _ in range(MOST_RUNS):
            trial = min(_between(low, min(MARGIN * guess, fault.most), high), fault.most)
            numbers = self.with_fault(fault, sign * trial)
            names = self.red(numbers)
            guess = self._guess(numbers, sign * trial, sign, fault.most)
            if names:
                high, red = trial, names
            else:
                low = trial
            if high <= CLOSE * max(low, guess if names else 0.0) or low >= fault.most:
                break
        return self._noticed(fault, high, red) or self._missed(fault, [numbers])

    def _noticed(self, fault: Fault, size: float | None, red: Sequence[str]) -> Finding | None:
        if not red:
            return None
        return Finding(fault.name, Outcome.NOTICED, _two_digits(size), self.case.name, red[0])

    def _missed(self, fault: Fault, numbers: Sequence[Numbers]) -> Finding:
        changed = any(self._changed(each) for each in numbers)
        return Finding(fault.name, Outcome.NOT_NOTICED if changed else Outcome.NO_EFFECT)

    def with_fault(self, fault: Fault, size: float) -> dict[str, Number]:
        """What is measured of the case with this fault."""
        if fault.mirrored:
            return {name: self._mirrored(name, number) for name, number in self.numbers.items()}
        with as_failed_run():
            trajectories = run_with_fault(self.engine, fault, size, self.case.scenarios, self.settings)
        return _measured(self.family, trajectories, self.engine)

    def red(self, numbers: Numbers) -> list[str]:
        """The quantities whose verdict fails with these numbers, and did not without the fault."""
        rows = judged(self.judging, self.case, self.engine.name, self.profile, self.settings, self.method, numbers)
        pairs = zip(self.rows, rows, strict=True)
        return [now.quantity for then, now in pairs if now.verdict is Verdict.FAIL and then.verdict is not Verdict.FAIL]

    def _possible(self, fault: Fault, size: float) -> bool:
        """Whether there is such a world: no restitution is above one."""
        try:
            fault.world(self.case.scenarios[0], self.settings, size)
        except InvalidInput:
            return False
        return True

    def _mirrored(self, name: str, number: Number) -> Number:
        theory = self.family.quantity(name).theory(self.case)
        return number if theory is None else replace(number, values=tuple(2 * theory - each for each in number.values))

    def _guess(self, numbers: Numbers, size: float, sign: float, most: float) -> float:
        """Where a verdict first turns red if every number changes in proportion to the fault; infinite if nowhere."""

        def is_red(at: float) -> bool:
            share = sign * at / size
            return bool(self.red({name: _on_line(self.numbers[name], numbers[name], share) for name in numbers}))

        sizes = [most * 0.5**halvings for halvings in range(HALVINGS, -1, -1)]
        high = next((at for at in sizes if is_red(at)), math.inf)
        if math.isinf(high):
            return high
        low = high / 2
        for _ in range(5):
            middle = (low + high) / 2
            low, high = (low, middle) if is_red(middle) else (middle, high)
        return high

    def _changed(self, numbers: Numbers) -> list[str]:
        """The quantities whose number, or the lack of one, is not what it was without the fault."""
        return [name for name, before in self.numbers.items() if _differ(before, numbers[name])]


def _differ(before: Number, number: Number) -> bool:
    then, now = np.array(before.values), np.array(number.values)
    return then.shape != now.shape or bool(np.any(np.abs(now - then) > NOTHING * np.maximum(1.0, np.abs(then))))


def _measured(family: Family, trajectories: Sequence[Trajectory], engine: Engine) -> dict[str, Number]:
    return {quantity.name: measured(quantity, trajectories, engine) for quantity in family.quantities}


def _remembering(family: Family) -> Family:
    """The family with what is predicted, and what is measured of a prediction, computed once."""
    quantities = tuple(replace(each, measure=functools.cache(each.measure)) for each in family.quantities)
    return replace(family, quantities=quantities, predict=functools.cache(family.predict) if family.predict else None)


def _between(low: float, guess: float, high: float) -> float:
    """The guess where it lies between two sizes, the first of which is not noticed and the second is; else another."""
    if low < guess < high:
        return guess
    if math.isinf(high):
        return 10 * low
    return math.sqrt(low * high) if low > 0 else high / 10


def _on_line(before: Number, now: Number, share: float) -> Number:
    if len(before.values) != len(now.values):
        return before
    return Number(tuple(b + share * (n - b) for b, n in zip(before.values, now.values, strict=True)), before.note)


def _two_digits(size: float | None) -> float | None:
    return None if size is None else float(f"{size:.1e}")
