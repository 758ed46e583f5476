"""Naming the mistake: a submission's numbers on the probes beside the right ones and those of all known mistakes.

A mistake is named when its numbers and the submission's are the same wherever both give some. What is not certain is
said so: several known mistakes may fit, one may fit but for limiting cases, or none, and then there is the
counterexample alone.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

from labs.grading.fingerprints.reading import Knowledge, Known, known
from labs.grading.marks import Answer, Right, ask, mark
from labs.grading.probes import Probe, probes
from labs.grading.telling import called, compared, told

Verdict = Literal["right", "named", "likely", "several", "unknown", "one at a time", "crashes", "shape", "unwritten"]
"""right: on every probe. named: one known mistake explains every answer. likely: one explains the usual cases, but not
all limiting ones. several: more than one explains the same. unknown: none does. one at a time: right for a single
contact only. crashes, shape: it gives no number to compare. unwritten: it is the stub."""
LEAST = 3
"""Usual cases that must be wrong in just the known way before a mistake with wrong usual cases is named."""


@dataclass(frozen=True)
class Counterexample:
    """The simplest probe that a submission fails. note: the case in words. came, expected: what it gave, and should."""

    probe: Probe
    parameters: tuple[str, ...]
    answer: Answer
    right: Right

    def __str__(self) -> str:
        case = f" ({self.probe.note})" if self.probe.note else ""
        return called(self.parameters, self.probe.arguments) + case + "\n" + compared(self.answer, self.right)


@dataclass(frozen=True)
class Diagnosis:
    """What is known of one function of a submission.

    mistakes: the known ones that explain its numbers. counterexample: the simplest probe that it fails. crashes: the
    errors that it ended in on good input. alone: whether that was with several contacts in one call only. accepted:
    cases of bad input that it answered. changes_input: whether it writes into its arguments.
    """

    function: str
    verdict: Verdict
    mistakes: tuple[Known, ...] = ()
    counterexample: Counterexample | None = None
    crashes: tuple[str, ...] = ()
    alone: bool = False
    accepted: tuple[str, ...] = ()
    changes_input: bool = False

    @property
    def right(self) -> bool:
        """Whether every number is right and no input was changed."""
        return self.verdict == "right" and not self.changes_input

    def __str__(self) -> str:
        return told(self)


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
        return Diagnosis(
            self.knowledge.function,
            verdict,
            mistakes,
            None if verdict in ("right", "unwritten") else self._counterexample(),
            tuple(dict.fromkeys(answer.error for _, _, answer in self.answered if answer.error)),
            all(probe.group == "many" for probe, _, answer in self.answered if answer.error),
            tuple(probe.note for probe, answer in self.refused if not answer.error),
            any(answer.changed for _, _, answer in self.answered),
        )

    def _verdict(self) -> tuple[Verdict, tuple[Known, ...]]:
        if all(own.right for own in self.marks):
            return "right", ()
        if all(own.failure == "unwritten" for own in self.marks):
            return "unwritten", ()
        whole = [entry for entry in self.knowledge.mistakes if self._explains(entry, strictly=True)]
        if whole:
            return ("named" if len(whole) == 1 else "several"), tuple(whole)
        usual = [entry for entry in self.knowledge.mistakes if self._explains(entry, strictly=False)]
        if usual:
            return ("likely" if len(usual) == 1 else "several"), tuple(usual)
        return self._without_name(), ()

    def _without_name(self) -> Verdict:
        single = [own for own, group in zip(self.marks, self.groups, strict=True) if group != "many"]
        if all(own.right for own in single):
            return "one at a time"
        wrong = [own.failure for own in single if not own.right]
        if all(failure == "error" for failure in wrong):
            return "crashes"
        return "shape" if all(failure in ("shape", "kind") for failure in wrong) else "unknown"

    def _explains(self, entry: Known, strictly: bool) -> bool:
        """Whether a known mistake gives what the submission gives; strictly: in limiting cases and in many as well.

        Who writes for one contact alone may have no answer for several: that is told apart, and hides no mistake.
        """
        seen = 0
        for own, theirs, group in zip(self.marks, entry.marks, self.groups, strict=True):
            silent = group == "many" and (own.failure or theirs.failure)
            if group == "usual":
                seen += not own.right
            if not silent and (strictly or group == "usual") and not own.agrees(theirs):
                return False
        return self._shown(entry, seen, strictly)

    def _shown(self, entry: Known, seen: int, strictly: bool) -> bool:
        """Whether there are wrong numbers enough to speak of a mistake."""
        if strictly:
            pairs = zip(self.marks, entry.marks, strict=True)
            return any(not own.right and not own.failure and own.agrees(theirs) for own, theirs in pairs)
        return seen >= LEAST and not all(own.failure for own in self.marks)

    def _counterexample(self) -> Counterexample | None:
        for (probe, right, answer), own in zip(self.answered, self.marks, strict=True):
            if not own.right:
                return Counterexample(probe, self.knowledge.parameters, answer, right)
        return None
