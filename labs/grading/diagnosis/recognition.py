"""Recognises the mistake: compares a submission's numbers on the probes with the right ones and all known mistakes.

A mistake is named when its numbers and the submission's are the same wherever both give some. The verdict says how
certain that is: several known mistakes may fit, or one may fit except in limiting cases. If none fits, the diagnosis
has only a counterexample.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from labs.grading.calling.cases import OneCase
from labs.grading.diagnosis.deviations import (
    Answer,
    Deviation,
    Right,
    ask,
    copied,
    deviation_of,
    fitted,
    outputs,
    spread,
)
from labs.grading.diagnosis.findings import LEAST, Counterexample, Diagnosis, Unnamed, Verdict
from labs.grading.diagnosis.fingerprints.reading import Knowledge, Known, known, of_functions
from labs.grading.diagnosis.probes import Group, Probe, probes
from labs.grading.diagnosis.probes.one_case import one_case
from labs.grading.diagnosis.unnamed import unnamed
from labs.grading.errors import GraderFailed

DIFFERENT = 5
"""So many different wrong numbers identify a formula even if calls with several contacts go wrong in another way."""
SHOWN_FOR_EACH_SPARED = 3
"""A mistake that a case of its own spares somewhere must show in so many cases for each one that is spared."""

Uses = Callable[[str], Iterable[str]]
"""Says which functions of a submission one of them calls."""


def diagnose(function: str, call: Callable[..., Any], uses: Uses | None = None) -> Diagnosis:
    """Say what is wrong with a function, from its answers to the probes by `call(name, *arguments)`.

    uses: what each function of the submission calls. A mistake is inherited only from a function that is reached by
    such calls; from any function if nothing is known of them.

    Raises
    ------
    UnknownName
        If there are no probes or no fingerprints of such a function.
    """
    cases, knowledge = probes(function), known(function)
    answers = ask(call, function, cases)
    called = None if uses is None else _reached(function, uses)
    found = judge(function, answers, called)
    certain = found.verdict in ("right", "named", "unwritten", "another order")
    if one_case(function) is None or (certain and not found.one_alone):
        return found
    single_answers = _one_at_a_time(call, function, answers, knowledge)
    if not _differ(function, answers, single_answers):
        in_many = found.odd is not None and found.odd.probe.group == "many"
        spared = in_many and found.spares_limits  # as one of the several cases
        return replace(found, one_alone=False, odd=None if spared else found.odd)
    alone = judge(function, single_answers, called)
    if certain or not (alone.mistakes or alone.verdict == "another order"):
        return found
    return replace(alone, crashes=found.crashes, one_alone=True, crash_in_many=found.crash_in_many)


def _reached(function: str, uses: Uses) -> set[str]:
    """The functions that one calls, directly or through others."""
    waiting, seen = [function], {function}
    while waiting:
        found = set(uses(waiting.pop())) - seen
        seen |= found
        waiting += found
    return seen - {function}


def _differ(function: str, together: list[Answer], single: list[Answer]) -> bool:
    """Whether a call with several contacts gives anything else than calls for each of them.

    An answer that is given once for all of them, where it should be given for each, is the same.
    """
    for at, (probe, right) in enumerate(zip(probes(function), known(function).right, strict=True)):
        if right and together[at] is not single[at]:
            own, alone = (_fitted(function, answers[at], right, probe) for answers in (together, single))
            repeated = replace(own, value=spread(own.value, right))
            if not deviation_of(repeated, right).agrees(deviation_of(alone, right)):
                return True
    return False


def _one_at_a_time(
    call: Callable[..., Any], function: str, answers: list[Answer], knowledge: Knowledge
) -> list[Answer]:
    """The answers, with those for several contacts found by a call for each contact, where the whole was not right.

    A function for a single contact makes its mistake there as well, although it gives no number for several.
    """
    case, found = one_case(function), []
    for probe, right, answer in zip(probes(function), knowledge.right, answers, strict=True):
        if case and right and probe.group == "many" and not deviation_of(answer, right).right:
            found.append(_alone(call, function, case, probe) or answer)
        else:
            found.append(answer)
    return found


def _alone(call: Callable[..., Any], function: str, case: OneCase, probe: Probe) -> Answer | None:
    """The answer to a probe with several contacts, by a call for each; None if these fail as well."""
    try:
        return Answer(case.one_by_one(lambda *given: call(function, *given), copied(probe.arguments)))
    except GraderFailed:
        raise
    except Exception:  # whatever a function raises, here or in a worker
        return None


def judge(function: str, answers: list[Answer], called: Collection[str] | None = None) -> Diagnosis:
    """Diagnose answers that are there already, one per probe. called: what the function calls, if that is known."""
    return _Evidence(function, answers, called).diagnosis()


def _fitted(function: str, answer: Answer, right: Right, probe: Probe) -> Answer:
    case = one_case(function) if probe.group == "many" and not answer.error else None
    return replace(answer, value=fitted(answer.value, right, case.leading(probe.arguments))) if case else answer


class _Evidence:
    """One function's probes, answers and deviations, side by side."""

    def __init__(self, function: str, answers: list[Answer], called: Collection[str] | None = None) -> None:
        self.knowledge: Knowledge = known(function)
        self.mistakes = self.knowledge.mistakes if called is None else of_functions(self.knowledge, called)
        rows = list(zip(probes(function), self.knowledge.right, answers, strict=True))
        self.answered = [(probe, right, answer) for probe, right, answer in rows if right]
        self.refused = [(probe, answer) for probe, right, answer in rows if not right]
        self.deviations = [
            deviation_of(_fitted(function, answer, right, probe), right) for probe, right, answer in self.answered
        ]
        self.groups = [probe.group for probe, _, _ in self.answered]

    def diagnosis(self) -> Diagnosis:
        verdict, mistakes = self._verdict()
        order = () if verdict in ("right", "unwritten", "named") else self._order()
        if order:
            verdict, mistakes = "another order", ()
        errors: dict[str, Group] = {}
        for probe, _, answer in self.answered:
            if answer.error:
                errors.setdefault(answer.error, probe.group)
        wrong = [at for at, own in enumerate(self.deviations) if not own.right]
        explained = [at for at in wrong if any(self.deviations[at].agrees(entry.deviations[at]) for entry in mistakes)]
        known_in_many = any(self._fits(entry, ("many",), silently=True) for entry in mistakes)
        return Diagnosis(
            self.knowledge.function,
            verdict,
            mistakes,
            None if verdict in ("right", "unwritten") else self._simplest(explained or wrong),
            tuple(errors),
            verdict == "named" and not known_in_many,
            set(errors.values()) == {"many"},
            tuple(probe.note for probe, answer in self.refused if not answer.error),
            any(answer.changed for _, _, answer in self.answered),
            self._simplest([at for at in wrong if at not in explained]) if verdict == "likely" else None,
            all(self.groups[at] != "usual" for at in wrong),
            order,
            verdict == "likely" and any(map(self._spares_limits, mistakes)),
            verdict == "likely" and any(map(self._spared, mistakes)),
            self._unnamed() if verdict == "unknown" else None,
        )

    def _verdict(self) -> tuple[Verdict, tuple[Known, ...]]:
        if self.deviations and all(own.right for own in self.deviations):
            return "right", ()
        if all(own.failure == "unwritten" for own in self.deviations):
            return "unwritten", ()
        whole = self._explained(("usual", "edge"))
        closer = [entry for entry in whole if self._fits(entry, ("many",), silently=True)]
        in_many = self._explained(("many",), ("usual", "edge"))
        mostly = [] if self._always_the_same() else self._explained(("usual",))
        mostly = [entry for entry in mostly if not entry.origins]  # not by way of another function
        certain = closer or in_many or (whole if self._identifies_a_formula() else [])
        found = certain or mostly or self._with_an_exception()
        if not found:
            return self._without_name(), ()
        return ("several" if len(found) > 1 else "named" if certain else "likely"), tuple(found)

    def _unnamed(self) -> Unnamed | None:
        knowledge = self.knowledge
        return unnamed(knowledge.function, self.answered, self.deviations, knowledge.parameters)

    def _with_an_exception(self) -> list[Known]:
        """The known mistakes that give all that is wrong in single contacts, but also get wrong a few that are right.

        An `if` of the submission's own catches these. Of several such mistakes, those that need the fewest count.
        """
        wrong = {own.total for own, _ in self._single() if not (own.right or own.failure)}
        if len(wrong) < DIFFERENT:
            return []
        spared = {entry: self._spared(entry) for entry in self.mistakes if not entry.origins}
        few = [len(cases) for cases in spared.values() if cases is not None]
        return [entry for entry, cases in spared.items() if cases is not None and len(cases) == min(few)]

    def _spared(self, entry: Known) -> list[int] | None:
        """The single contacts that are right and that a mistake gets wrong; None if it is not the submission's own."""
        single = [at for at, group in enumerate(self.groups) if group != "many"]
        wrong = [at for at in single if not self.deviations[at].right and self.deviations[at].failure != "error"]
        if not all(self.deviations[at].agrees(entry.deviations[at]) for at in wrong):
            return None
        spared = [at for at in single if self.deviations[at].right and not entry.deviations[at].right]
        return spared if len(spared) * SHOWN_FOR_EACH_SPARED <= len(wrong) else None

    def _order(self) -> tuple[int, ...]:
        """The places of what is returned, if all single contacts are right except for their order; else empty."""
        single = [
            (right, answer) for probe, right, answer in self.answered if probe.group != "many" and not answer.error
        ]
        count = len(single[0][0].outputs) if len(single) >= LEAST else 0
        values = [outputs(answer.value, count) for _, answer in single] if count > 1 else [None]
        if any(value is None for value in values):
            return ()
        for order in itertools.permutations(range(count)):
            sorted_back = [tuple(value[order.index(at)] for at in range(count)) for value in values if value]
            pairs = zip(sorted_back, single, strict=True)
            if all(deviation_of(Answer(value), right).right for value, (right, _) in pairs):
                return order if list(order) != sorted(order) else ()
        return ()

    def _explained(self, shows: tuple[Group, ...], agrees: tuple[Group, ...] = ()) -> list[Known]:
        """The known mistakes that give what the submission gives in both lists of groups, and that `shows` reveals."""
        fit = [entry for entry in self.mistakes if self._fits(entry, shows + agrees)]
        return [entry for entry in fit if self._shown(entry, shows)]

    def _fits(self, entry: Known, groups: tuple[Group, ...], silently: bool = False) -> bool:
        """Whether a known mistake gives what the submission gives.

        An error is no evidence: plain Python raises one where NumPy gives infinity. silently: no other failure counts
        as evidence either, because code for a single contact fails when it gets many.
        """
        for own, theirs, group in zip(self.deviations, entry.deviations, self.groups, strict=True):
            nothing_said = own.failure == "error" or (silently and (own.failure or theirs.failure))
            if group in groups and not nothing_said and not own.agrees(theirs):
                return False
        return True

    def _shown(self, entry: Known, groups: tuple[Group, ...]) -> bool:
        """Whether enough wrong numbers are the known mistake's own.

        One or two numbers, such as the answer to a mesh without faces, are too few to accuse another function.
        """
        rows = [row for row in zip(self.deviations, entry.deviations, self.groups, strict=True) if row[2] in groups]
        seen = sum(not own.right and not own.failure and own.agrees(theirs) for own, theirs, _ in rows)
        errors = any(own.failure == "error" for own, _, _ in rows)
        return seen >= (LEAST if errors or entry.origins or groups == ("usual",) else 1)

    def _spares_limits(self, entry: Known) -> bool:
        """Whether a limiting case is right that a known mistake gets wrong."""
        rows = zip(self.deviations, entry.deviations, self.groups, strict=True)
        return any(group == "edge" and own.right and not theirs.right for own, theirs, group in rows)

    def _always_the_same(self) -> bool:
        """Whether every usual case gets the same answer: that fits any mistake which does the same."""
        values = [answer.value for probe, _, answer in self.answered if probe.group == "usual" and not answer.error]
        return all(np.array_equal(value, values[0]) for value in values)

    def _identifies_a_formula(self) -> bool:
        """Whether single contacts give enough different wrong numbers to identify a formula without the other calls."""
        return len({own.total for own, group in self._single() if not own.right}) >= DIFFERENT

    def _single(self) -> list[tuple[Deviation, Group]]:
        return [(own, group) for own, group in zip(self.deviations, self.groups, strict=True) if group != "many"]

    def _without_name(self) -> Verdict:
        single = [own for own, _ in self._single()]
        if all(own.right for own in single):
            return "one at a time"
        wrong = [own.failure for own in single if not own.right]
        if all(failure == "error" for failure in wrong):
            return "crashes"
        return "shape" if all(failure in ("shape", "kind") for failure in wrong) else "unknown"

    def _simplest(self, numbers: Sequence[int]) -> Counterexample | None:
        """The probe to show: one with a single case before one with several, one made by hand before a drawn one."""
        if not numbers:
            return None
        simplest = min(numbers, key=lambda at: (self.groups[at] == "many", not self.answered[at][0].note))
        probe, right, answer = self.answered[simplest]
        return Counterexample(self.knowledge.function, probe, self.knowledge.parameters, answer, right)
