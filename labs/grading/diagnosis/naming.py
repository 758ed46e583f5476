"""Naming the mistake: a submission's numbers on the probes beside the right ones and those of all known mistakes.

A mistake is named when its numbers and the submission's are the same wherever both give some. What is not certain is
said so: several known mistakes may fit, one may fit but for limiting cases, or none, and then there is the
counterexample alone.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from labs.grading.diagnosis.findings import Counterexample, Diagnosis, Verdict
from labs.grading.diagnosis.fingerprints.reading import Knowledge, Known, known
from labs.grading.diagnosis.marks import Answer, Mark, ask, mark
from labs.grading.diagnosis.probes import Group, probes

DIFFERENT = 5
"""Different wrong numbers by which a formula is known although several contacts at once are wrong in another way."""
LEAST = 3
"""Cases that must be wrong in just the known way where others say nothing, or otherwise."""


def diagnose(function: str, call: Callable[..., Any]) -> Diagnosis:
    """Say what is wrong with a function, from its answers to the probes by `call(name, *arguments)`.

    Raises
    ------
    UnknownName
        If there are no probes or no fingerprints of such a function.
    """
    cases = probes(function)
    return judge(function, ask(call, function, cases))


def judge(function: str, answers: list[Answer]) -> Diagnosis:
    """The same of answers that are there already, one a probe."""
    return _Case(function, answers).diagnosis()


class _Case:
    """One function's probes, answers and marks, side by side."""

    def __init__(self, function: str, answers: list[Answer]) -> None:
        self.knowledge: Knowledge = known(function)
        rows = list(zip(probes(function), self.knowledge.right, answers, strict=True))
        self.answered = [(probe, right, answer) for probe, right, answer in rows if right]
        self.refused = [(probe, answer) for probe, right, answer in rows if not right]
        self.marks = [mark(answer, right) for _, right, answer in self.answered]
        self.groups = [probe.group for probe, _, _ in self.answered]

    def diagnosis(self) -> Diagnosis:
        verdict, mistakes = self._verdict()
        errors: dict[str, Group] = {}
        for probe, _, answer in self.answered:
            if answer.error:
                errors.setdefault(answer.error, probe.group)
        wrong = [at for at, own in enumerate(self.marks) if not own.right]
        explained = [at for at in wrong if any(self.marks[at].agrees(entry.marks[at]) for entry in mistakes)]
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
        )

    def _verdict(self) -> tuple[Verdict, tuple[Known, ...]]:
        if all(own.right for own in self.marks):
            return "right", ()
        if all(own.failure == "unwritten" for own in self.marks):
            return "unwritten", ()
        whole = self._explained(("usual", "edge"))
        closer = [entry for entry in whole if self._fits(entry, ("many",), silently=True)]
        in_many = self._explained(("many",), ("usual", "edge"))
        mostly = [] if self._always_the_same() else self._explained(("usual",))
        mostly = [entry for entry in mostly if not entry.origins]  # not by way of another function
        certain = closer or in_many or (whole if self._telling() else [])
        found = certain or mostly
        if not found:
            return self._without_name(), ()
        return ("several" if len(found) > 1 else "named" if certain else "likely"), tuple(found)

    def _explained(self, shows: tuple[Group, ...], agrees: tuple[Group, ...] = ()) -> list[Known]:
        """The known mistakes that give what the submission gives in some groups, and are seen in the first of them."""
        fit = [entry for entry in self.knowledge.mistakes if self._fits(entry, shows + agrees)]
        return [entry for entry in fit if self._shown(entry, shows)]

    def _fits(self, entry: Known, groups: tuple[Group, ...], silently: bool = False) -> bool:
        """Whether a known mistake gives what the submission gives.

        An error says nothing: plain Python ends in one where NumPy has infinity. Silently: nor does any other failure,
        as of who writes for one contact alone.
        """
        for own, theirs, group in zip(self.marks, entry.marks, self.groups, strict=True):
            nothing_said = own.failure == "error" or (silently and (own.failure or theirs.failure))
            if group in groups and not nothing_said and not own.agrees(theirs):
                return False
        return True

    def _shown(self, entry: Known, groups: tuple[Group, ...]) -> bool:
        """Whether there are wrong numbers enough, the same ones, to speak of a mistake."""
        rows = [row for row in zip(self.marks, entry.marks, self.groups, strict=True) if row[2] in groups]
        seen = sum(not own.right and not own.failure and own.agrees(theirs) for own, theirs, _ in rows)
        errors = any(own.failure == "error" for own, _, _ in rows)
        return seen >= (LEAST if errors or groups == ("usual",) else 1)

    def _always_the_same(self) -> bool:
        """Whether it answers alike whatever it is given: that fits any mistake which does so in the usual cases."""
        values = [answer.value for probe, _, answer in self.answered if probe.group == "usual" and not answer.error]
        return all(np.array_equal(value, values[0]) for value in values)

    def _telling(self) -> bool:
        """Whether single contacts give enough different wrong numbers to know a formula by, though several disagree."""
        return len({own.deviation for own, group in self._single() if not own.right}) >= DIFFERENT

    def _single(self) -> list[tuple[Mark, Group]]:
        return [(own, group) for own, group in zip(self.marks, self.groups, strict=True) if group != "many"]

    def _without_name(self) -> Verdict:
        single = [own for own, _ in self._single()]
        if all(own.right for own in single):
            return "one at a time"
        wrong = [own.failure for own in single if not own.right]
        if all(failure == "error" for failure in wrong):
            return "crashes"
        return "shape" if all(failure in ("shape", "kind") for failure in wrong) else "unknown"

    def _simplest(self, places: Sequence[int]) -> Counterexample | None:
        """Of some probes the one to show: of one case before several, made by hand before drawn."""
        if not places:
            return None
        simplest = min(places, key=lambda at: (self.groups[at] == "many", not self.answered[at][0].note))
        probe, right, answer = self.answered[simplest]
        return Counterexample(self.knowledge.function, probe, self.knowledge.parameters, answer, right)
