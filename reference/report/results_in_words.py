"""The result of a scenario in words: what agrees with theory and what does not, and what is accepted."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from reference.comparison.verdicts import Verdict
from reference.engines.handwritten_engine import Handwritten
from reference.report.sections import Line, Section

_SAID = {
    Verdict.PASS: "{who} agree with theory in every check",
    Verdict.KNOWN_DEVIATION: "{who} differ as the method must",
    Verdict.DISAGREES: "{who} are nowhere near theory, as the method must be",
    Verdict.FAIL: "{who} differ by more than the method explains",
    Verdict.NEEDS: "{who} wait for functions that are not written yet",
    Verdict.CANNOT_EXPRESS: "{who} cannot express this",
    Verdict.NO_WORDS: "the lab has no words for this in {who}",
    Verdict.NOT_AVAILABLE: "{who} are not installed here",
    Verdict.CRASHED: "{who} crashed",
    Verdict.RUNNING: "{who} are still running",
    Verdict.SHOWN: "the numbers of {who} are only shown",
}
"""What is said of implementations by their worst verdict."""
_OF_ONE = {" agree ": " agrees ", " differ ": " differs ", " are ": " is ", " wait ": " waits "}


def counted(section: Section) -> str:
    """What the implementations give that count: hand-written code at its best, engines told what the scenario means."""
    return _sentence([line for line in section.lines if line.counts])


def plain(section: Section) -> str:
    """What the engines give as installed, and what hand-written code gives at the step."""
    lines = [line for line in section.lines if line.plain]
    engines, by_hand = [line for line in lines if not _by_hand(line)], [line for line in lines if _by_hand(line)]
    return f"{_sentence(engines, 'As installed, ')} {_sentence(by_hand, 'At the step, ')}".strip()


@dataclass(frozen=True)
class Accepted:
    """What counts as near theory, and why: of which quantities, in which implementations."""

    quantities: str
    whose: str
    reason: str


def accepted(section: Section) -> list[Accepted]:
    """Each reason for a tolerance, once for all quantities to which it applies in the same implementations."""
    found: dict[tuple[str, str], list[str]] = {}
    for quantity in section.family.quantities:
        groups = section.tolerances(quantity.name)
        largest = max((len(titles) for _, titles in groups), default=0)
        for reason, titles in groups:
            whose = "; ".join(titles)
            if len(titles) == largest and len(titles) > 2:
                whose = "all" if len(groups) == 1 else "all others"
            found.setdefault((reason, whose), []).append(quantity.title)
    return [Accepted(", ".join(titles), whose, reason) for (reason, whose), titles in found.items()]


def _sentence(lines: Sequence[Line], opening: str = "") -> str:
    """What is to be said of these lines, verdict by verdict; empty where there are none."""
    parts = []
    for verdict, words in _SAID.items():
        own = [line for line in lines if line.whole.verdict is verdict]
        if len(own) == 1:
            words = re.sub("|".join(_OF_ONE), lambda found: _OF_ONE[found[0]], words, count=1)
        if own:
            parts.append(words.format(who=_listed([_named(line, verdict) for line in own])))
    text = opening + "; ".join(parts)
    return f"{text[0].upper()}{text[1:]}." if parts else ""


def _named(line: Line, verdict: Verdict) -> str:
    """An implementation, with the number that is furthest from theory unless all are near it."""
    name = "hand-written code" if _by_hand(line) else line.result.title
    return f"{name} ({line.whole.in_words})" if verdict is not Verdict.PASS and line.whole.in_words else name


def _by_hand(line: Line) -> bool:
    return line.result.job.engine == Handwritten.name


def _listed(names: Iterable[str]) -> str:
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last
