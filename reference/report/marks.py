"""How a verdict is marked in every table, and what the mark means."""

from __future__ import annotations

from collections.abc import Iterable

from reference.comparison.verdicts import Verdict
from reference.running.protocol import Row

MARKS = {
    Verdict.PASS: "✓",
    Verdict.KNOWN_DEVIATION: "≈",
    Verdict.DISAGREES: "≠",
    Verdict.FAIL: "✗",
    Verdict.CANNOT_EXPRESS: "∅",
    Verdict.NO_WORDS: "◌",
    Verdict.NEEDS: "…",
    Verdict.NOT_AVAILABLE: "–",
    Verdict.CRASHED: "!",
    Verdict.LOST: "?",
    Verdict.SHOWN: "·",
    Verdict.RUNNING: "▷",
}
LEGEND = {
    Verdict.PASS: "as the method must, and near theory where it has a figure",
    Verdict.KNOWN_DEVIATION: "as the method must, and away from theory; “left” is what the method does not explain",
    Verdict.DISAGREES: "as its method predicts, and wrong by as much as the number itself",
    Verdict.FAIL: "not as the method must; counted where it is exact by hand or a tuned engine, else only shown",
    Verdict.CANNOT_EXPRESS: "the engine cannot express it",
    Verdict.NO_WORDS: "the lab cannot express it yet, no matter what the engine can do",
    Verdict.NEEDS: "a function that is not written yet",
    Verdict.NOT_AVAILABLE: "the engine is not installed here",
    Verdict.CRASHED: "the run died or gave no usable state",
    Verdict.LOST: "the run was lost to load, a time limit or short memory; it was not judged",
    Verdict.SHOWN: "theory has no figure; the largest value is shown",
    Verdict.RUNNING: "the run has not ended yet; it counts nowhere",
}
SEVERITY = (
    Verdict.CRASHED,
    Verdict.LOST,
    Verdict.FAIL,
    Verdict.DISAGREES,
    Verdict.NEEDS,
    Verdict.CANNOT_EXPRESS,
    Verdict.NO_WORDS,
    Verdict.NOT_AVAILABLE,
    Verdict.RUNNING,
    Verdict.KNOWN_DEVIATION,
    Verdict.PASS,
    Verdict.SHOWN,
)
"""The worst first: where one mark is shown for many verdicts, it is that of the worst."""
AGREES = (Verdict.PASS, Verdict.KNOWN_DEVIATION)
"""The verdicts of numbers that agree with theory or differ from it as their method predicts."""


def occurring(rows: Iterable[Row]) -> list[Verdict]:
    """The verdicts that occur in rows of any kind, in the order in which they are defined."""
    found = {row.verdict for row in rows}
    return [verdict for verdict in Verdict if verdict in found]
