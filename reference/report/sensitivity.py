"""The smallest fault that a verdict notices: measured, kept in a file for the report, and said in a sentence.

    python -m reference.report.sensitivity                 measures every scenario, in more than an hour of processor
    python -m reference.report.sensitivity sliding-slab --engine mujoco
    python -m reference.report.sensitivity --keep          measures, and keeps the figures for the report

An implementation is run with a fault of `reference.comparison.faults`, and its numbers are judged as those of the true
scenario. The smallest fault with which a verdict turns red is found on the line through two runs, and confirmed by one.
"""

from __future__ import annotations

import argparse
import contextlib
import functools
import itertools
import math
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

from reference.catalogue.case import Case
from reference.catalogue.family import Family
from reference.catalogue.scenarios import catalogue, find
from reference.comparison.compare import Number, judged, measured, predicted
from reference.comparison.faults import FAULTS, Fault, run_with_fault
from reference.comparison.verdicts import Row, Verdict
from reference.engines import engine_names, load_engine
from reference.engines.base import Engine, Method
from reference.engines.implementation import Implementation
from reference.engines.profiles import WORLD, counts
from reference.errors import CannotExpress, CollisionsError, InvalidInput, NeedsFunction, as_failed_run, listed
from reference.recording.files import FOLDER, read_json, write_json
from reference.report import numbers
from reference.report.sections import Line, Section
from reference.running.jobs import each_isolated
from reference.scene.trajectory import Trajectory

FILE, SCHEMA, VERSION = FOLDER.with_name("sensitivity.json"), "collisions-lab/sensitivity", 2
LONG_IN_THE_WORLD = (
    "ball-to-rest", "sliding-slab", "incline", "critical-incline", "two-frictions", "tipping-box",
    "break-away", "slab-at-30-degrees", "creep", "friction-oscillator",
)  # fmt: skip
"""Families whose faults are not tried in the hand-written world, where they take one to ten minutes each.

They follow the recurrence that the world has in all other families.
"""
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
ALIKE = 2.0
"""Sizes that differ by less than this factor are told as one."""
NOTICED, NO_EFFECT, NOT_NOTICED, NOT_TRIED = "noticed", "no effect", "not noticed", "not tried"
"""What comes of a fault."""
Place = tuple[str, str, str]
"""A family, an engine and a profile."""
Numbers = Mapping[str, Number]


@dataclass(frozen=True)
class Finding:
    """What came of one fault. size: the smallest that was noticed, a share or in degrees; None for one without a size.

    case: where a verdict turned red; of a sign that was not noticed, where one did not.
    """

    outcome: str
    size: float | None = None
    case: str = ""


Findings = Mapping[str, Finding]
"""What came of each fault that the cases of a family name, in one implementation, by the fault's name."""


def plan(families: Iterable[str], engines: Sequence[str]) -> list[Place]:
    """Where faults are injected: in each implementation of these families whose verdicts count.

    The hand-written world has to have a recurrence: what theory's tolerance lets pass is known of the engines.
    """
    known = ((catalogue()[name], engine) for name in families for engine in engines)
    return [
        (family.name, engine, profile)
        for family, engine in known
        for profile in family.profiles(load_engine(engine))
        if counts(profile) and (profile != WORLD or (family.predict and family.name not in LONG_IN_THE_WORLD))
    ]


def sensitivity(family: Family, engine: Engine, profile: str) -> Findings:
    """Inject each fault that the family's cases name.

    A coefficient that changes nothing in the chosen cases, such as the friction of a ball that rolls, is tried in the
    family's other cases too. Where the implementation can run no case, errors are those of the first.
    """
    able = [case for case in (*chosen(family), *family.cases) if profile in engine.profiles(case.scenarios[0])]
    cases = {case.name: case for case in able}
    run = functools.cache(lambda name: Subject(family, cases[name], engine, profile))
    subjects = list(_possible((case.name for case in chosen(family) if case.name in cases), run))
    subjects = subjects or list(itertools.islice(_possible(cases, run), 1)) or [run(able[0].name)]
    others = [name for name in cases if name not in [each.case.name for each in subjects]]
    found: dict[str, Finding] = {}
    for fault in FAULTS:
        for subject in itertools.chain(subjects, _possible(others if fault.of_a_pair else (), run)):
            if subject.names(fault):
                finding = subject.finding(fault)
                if finding.outcome != NO_EFFECT:
                    found[fault.name] = finding
                    break
                found.setdefault(fault.name, finding)
    return {name: each for name, each in found.items() if each.outcome != NOT_TRIED}


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


class Subject:
    """One case in one implementation, which is run without a fault; errors as those of `Engine.run_many`."""

    def __init__(self, family: Family, case: Case, engine: Engine, profile: str) -> None:
        self.family, self.engine, self.profile = family, engine, profile
        self.settings = engine.settings(case.scenarios[0], profile)
        self.method = engine.method(case.scenarios[0], self.settings)
        alone = predicted(family, case, self.settings, self.method)
        self.case = replace(case, scenarios=case.scenarios[:FIRST_OF_AN_ENSEMBLE]) if alone else case
        quantities = tuple(replace(each, measure=functools.cache(each.measure)) for each in family.quantities)
        predict = functools.cache(family.predict) if family.predict else None
        self.judging = replace(family, quantities=quantities, predict=predict)  # computes each prediction once
        with as_failed_run():
            self.numbers = self._measured(engine.run_many(self.case.scenarios, self.settings))
        self.rows = self._judged(self.numbers)

    def names(self, fault: Fault) -> bool:
        """Whether there is anything in the case that this fault can spoil."""
        if fault.of_contacts and not any(quantity.reported for quantity in self.family.quantities):
            return False
        return fault.named(self.case.scenarios[0], self.method)

    def finding(self, fault: Fault) -> Finding:
        """What comes of a fault in this case; none is tried where the numbers fail without a fault."""
        if all(row.verdict in (Verdict.FAIL, Verdict.CRASHED, Verdict.SHOWN) for row in self.rows):
            return Finding(NOT_TRIED)
        try:
            return self._smallest(fault) if fault.most else self._without_size(fault)
        except CollisionsError:
            return Finding(NOT_TRIED)

    def _without_size(self, fault: Fault) -> Finding:
        found = self.with_fault(fault, 0.0)
        red = self.red(found)
        judged = {row.quantity for row in self.rows if row.verdict not in (Verdict.FAIL, Verdict.SHOWN)}
        if fault.mirrored and any(name in judged and name not in red for name in self._changed(found)):
            return Finding(NOT_NOTICED, None, self.case.name)
        return Finding(NOTICED, None, self.case.name) if red else self._missed(found)

    def _smallest(self, fault: Fault) -> Finding:
        """Follow the line through two runs to where a verdict turns red, and run there, until a run confirms it."""
        signs = []
        for sign in (1.0, -1.0):
            with contextlib.suppress(InvalidInput):  # no restitution is above one
                fault.world(self.case.scenarios[0], self.settings, sign * fault.most)
                signs.append(sign)
        first, size = self.with_fault(fault, signs[0] * fault.first), signs[0] * fault.first
        guesses = {sign: self._guess(first, size, sign, fault.most) for sign in signs}
        sign = min(signs, key=guesses.__getitem__)
        guess, low, high = guesses[sign], 0.0, math.inf
        if math.isinf(guess):  # no slope, or too small a one: the largest sizes say whether there is an effect at all
            at_most = {sign: self.with_fault(fault, sign * fault.most) for sign in signs}
            reds = [sign for sign, found in at_most.items() if self.red(found)]
            if not reds:
                return self._missed(*at_most.values())
            sign = reds[0]
            high, low = fault.most, fault.first if sign == signs[0] and not self.red(first) else 0.0
        for _ in range(MOST_RUNS):
            trial = min(_between(low, min(MARGIN * guess, fault.most), high), fault.most)
            found = self.with_fault(fault, sign * trial)
            is_red = bool(self.red(found))
            guess = self._guess(found, sign * trial, sign, fault.most)
            low, high = (low, trial) if is_red else (trial, high)
            if high <= CLOSE * max(low, guess if is_red else 0.0) or low >= fault.most:
                break
        if math.isinf(high):
            return self._missed(found)
        return Finding(NOTICED, float(f"{high:.1e}"), self.case.name)

    def _missed(self, *found: Numbers) -> Finding:
        return Finding(NOT_NOTICED if any(map(self._changed, found)) else NO_EFFECT)

    def with_fault(self, fault: Fault, size: float) -> Numbers:
        """What is measured of the case with this fault."""
        if fault.mirrored:
            return {name: self._mirrored(name, number) for name, number in self.numbers.items()}
        with as_failed_run():
            trajectories = run_with_fault(self.engine, fault, size, self.case.scenarios, self.settings)
        return self._measured(trajectories)

    def _measured(self, trajectories: Sequence[Trajectory]) -> Numbers:
        return {quantity.name: measured(quantity, trajectories, self.engine) for quantity in self.family.quantities}

    def _judged(self, found: Numbers) -> list[Row]:
        return judged(self.judging, self.case, self.engine.name, self.profile, self.settings, self.method, found)

    def red(self, found: Numbers) -> list[str]:
        """The quantities whose verdict fails with these numbers, and did not without the fault."""
        pairs = zip(self.rows, self._judged(found), strict=True)
        return [now.quantity for then, now in pairs if now.verdict is Verdict.FAIL and then.verdict is not Verdict.FAIL]

    def _mirrored(self, name: str, number: Number) -> Number:
        theory = self.family.quantity(name).theory(self.case)
        return number if theory is None else replace(number, values=tuple(2 * theory - each for each in number.values))

    def _guess(self, found: Numbers, size: float, sign: float, most: float) -> float:
        """Where a verdict first turns red if every number changes in proportion to the fault; infinite if nowhere."""

        def is_red(at: float) -> bool:
            share = sign * at / size
            return bool(self.red({name: _on_line(self.numbers[name], found[name], share) for name in found}))

        sizes = [most * 0.5**halvings for halvings in range(HALVINGS, -1, -1)]
        high = next((at for at in sizes if is_red(at)), math.inf)
        if math.isinf(high):
            return high
        low = high / 2
        for _ in range(5):
            middle = (low + high) / 2
            low, high = (low, middle) if is_red(middle) else (middle, high)
        return high

    def _changed(self, found: Numbers) -> list[str]:
        """The quantities whose number, or the lack of one, is not what it was without the fault."""
        return [name for name, before in self.numbers.items() if _differ(before.values, found[name].values)]


def _differ(then: Sequence[float], now: Sequence[float]) -> bool:
    return len(then) != len(now) or any(abs(n - t) > NOTHING * max(1.0, abs(t)) for t, n in zip(then, now, strict=True))


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


def kept() -> dict[str, Any]:
    """What the file holds, by family, engine, profile and fault; empty where there is no file."""
    return dict((read_json(FILE, SCHEMA, VERSION) or {"families": {}})["families"])


def keep(found: Mapping[Place, Findings]) -> None:
    """Write findings to the file beside those of other runs, and drop families that the lab no longer has."""
    known = kept()
    for (family, engine, profile), findings in found.items():
        told = {name: {key: value for key, value in asdict(each).items() if value} for name, each in findings.items()}
        known.setdefault(family, {}).setdefault(engine, {})[profile] = told
    families = {family: known[family] for family in catalogue() if family in known}
    write_json(FILE, {"schema": SCHEMA, "version": VERSION, "families": families}, 4)


def kept_sentence(section: Section) -> str:
    """What the verdicts that count in a section notice, as the lab has measured it; "" where it has not.

    Where it has measured it of some of the implementations alone, they are named.
    """
    known, asked = kept().get(section.family.name, {}), [line for line in section.lines if line.counts]
    found = [(line, own) for line in asked if (own := _kept_of(line, section.cases, known))]
    whose = listed([_named(line.name, line.result.job.profile) for line, _ in found])
    told = {_named(line.result.title, line.result.job.profile): own for line, own in found}
    return sentence(told, whose if len(found) < len(asked) else "")


def _kept_of(line: Line, cases: Sequence[str], known: Mapping[str, Any]) -> Findings:
    """What was measured of just this line: the lab's own code, in a profile's own settings, in the cases that ran.

    Nothing where no run gave a number: verdicts on nothing notice nothing.
    """
    job, functions = line.result.job, line.result.functions
    if all(row.measured is None for row in line.result.rows) or job.changes or job.at:
        return {}
    if functions and not Implementation(job.implementation).takes_ours(functions):
        return {}
    found = known.get(job.engine, {}).get(job.profile, {})
    return {name: Finding(**each) for name, each in found.items() if each.get("case", cases[0]) in cases}


def _named(title: str, profile: str) -> str:
    """An implementation in a sentence; by hand two methods count."""
    return f"{title}, {profile}" if profile == WORLD else title


def sentence(found: Mapping[str, Findings], whose: str = "") -> str:
    """The smallest fault of each kind that a verdict notices in one family, and what the verdicts do not notice.

    found: by implementation, named as in a sentence. whose: the implementations, where the report shows others too.
    """
    each = [(fault, {name: own[fault.name] for name, own in found.items() if fault.name in own}) for fault in FAULTS]
    parts = {
        f"The smallest fault that a verdict {f'on {whose}' if whose else 'here'} would notice": _sizes,
        "Not noticed": _missed,
        "Without effect on any number": _idle,
    }
    told = {opening: list(filter(None, (say(*own) for own in each))) for opening, say in parts.items()}
    return " ".join(f"{opening}: {', '.join(words)}." for opening, words in told.items() if words)


def _sizes(fault: Fault, found: Findings) -> str:
    """The smallest size of a fault in the most and in the least sensitive implementation; "" where none has any."""
    sizes = {name: finding.size for name, finding in found.items() if finding.size}
    if not sizes:
        return ""
    best, worst = min(sizes, key=sizes.__getitem__), max(sizes, key=sizes.__getitem__)
    if sizes[worst] < ALIKE * sizes[best]:
        return f"{fault.title} {size_text(fault, sizes[worst])}"
    return f"{fault.title} {size_text(fault, sizes[best])} ({best}) to {size_text(fault, sizes[worst])} ({worst})"


def _missed(fault: Fault, found: Findings) -> str:
    """A fault that has an effect and is not noticed, with the implementations; "" where that is so in none."""
    names = [name for name, finding in found.items() if finding.outcome == NOT_NOTICED]
    up_to = f" up to {size_text(fault, fault.most)}" if fault.most else ""
    return f"{fault.title}{up_to} ({', '.join(names)})" if names else ""


def _idle(fault: Fault, found: Findings) -> str:
    """A fault that has no effect wherever it was tried; "" where it was tried nowhere."""
    return fault.title if {finding.outcome for finding in found.values()} == {NO_EFFECT} else ""


def size_text(fault: Fault, size: float) -> str:
    """The size of a fault with its unit: `2.1·10⁻⁷ %`, `0.5°`."""
    return f"{numbers.digits(100 * size, 2)} %" if fault.unit == "%" else f"{numbers.digits(size, 2)}{fault.unit}"


def measure(place: Place) -> Findings:
    """What comes of all faults in one family and implementation; nothing where it cannot run."""
    family, engine, profile = place
    try:
        return sensitivity(catalogue()[family], load_engine(engine), profile)
    except CollisionsError:
        return {}


def main() -> None:
    """Measure, and print what the verdicts of each family notice."""
    parser = argparse.ArgumentParser(prog="python -m reference.report.sensitivity")
    parser.add_argument("scenario", nargs="*", help="a scenario; all if you name none")
    parser.add_argument("--engine", action="append", help="an engine, or the path of an engine file")
    parser.add_argument("--keep", action="store_true", help="keep what is found for the report")
    wish = parser.parse_args()
    families = [find(name)[0].name for name in wish.scenario] or list(catalogue())
    places = plan(families, wish.engine or engine_names())
    everything = zip(places, each_isolated(measure, places, os.cpu_count() or 1), strict=True)
    found = {place: findings for place, findings in everything if findings}
    for family in families:
        told = {
            _named(load_engine(place[1]).title, place[2]): own for place, own in found.items() if place[0] == family
        }
        print(f"{family}: {sentence(told)}")
    if wish.keep:
        keep(found)


if __name__ == "__main__":
    from reference.report import sensitivity as importable  # a worker finds no function of `__main__`

    importable.main()
