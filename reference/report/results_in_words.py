"""The result of a scenario in words: what agrees with theory and what does not, and what is accepted."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from reference.comparison.verdicts import Row, Verdict, why
from reference.engines.handwritten_engine import Handwritten
from reference.engines.implementation import Implementation
from reference.engines.steering import functions_of
from reference.errors import listed
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
    Verdict.LOST: "{who} have no number because their runs were lost",
    Verdict.RUNNING: "{who} are still running",
    Verdict.SHOWN: "the numbers of {who} are only shown",
}
"""What is said of implementations by their worst verdict."""
_OF_ONE = {
    f" {several} ": f" {one} "
    for several, one in {
        "agree": "agrees", "differ": "differs", "are": "is", "wait": "waits", "have": "has", "need": "needs"
    }.items()
}  # fmt: skip


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
        groups = tolerances(section, quantity.name)
        largest = max((len(titles) for _, titles in groups), default=0)
        for reason, titles in groups:
            whose = "; ".join(titles)
            if len(titles) == largest and len(titles) > 2:
                whose = "all" if len(groups) == 1 else "all others"
            found.setdefault((reason, whose), []).append(quantity.title)
    return [Accepted(", ".join(titles), whose, reason) for (reason, whose), titles in found.items()]


def tolerances(section: Section, quantity: str) -> list[tuple[str, list[str]]]:
    """Each reason for a tolerance of a quantity, once, with the lines to which it applies."""
    found: dict[str, dict[str, None]] = {}
    for line in section.lines:
        for row in line.result.rows:
            if row.quantity == quantity and row.reason:
                found.setdefault(row.reason, {})[line.title] = None
    return [(reason, list(titles)) for reason, titles in found.items()]


_STEERED = (
    "The code that is tried here steers the bodies of the engines too. A check that fails in all implementations is a"
    " fault of that code."
)


@dataclass(frozen=True)
class Remark:
    """Why numbers deviate or are missing, as a sentence."""

    verdict: Verdict
    said: str


def remarks(section: Section) -> list[Remark]:
    """Each note on rows, once, with the implementations that it belongs to and how often in each."""
    found: dict[tuple[Verdict, str, str], dict[str, dict[str, int]]] = {}
    for line in section.lines:
        for row in line.result.rows:
            if row.note:
                kind = row.verdict, *_words_of(row)
                times = found.setdefault(kind, {}).setdefault(line.name, {})
                times[line.result.job.profile] = times.get(line.result.job.profile, 0) + 1
    said = [Remark(verdict, _remark(words, note, times)) for (verdict, words, note), times in found.items()]
    return said + _whose_rule(section)


def _whose_rule(section: Section) -> list[Remark]:
    """What to think of failures where code that is not the lab's own steers the bodies of every implementation."""
    names = functions_of(scenario for case in section.family.cases for scenario in case.scenarios)
    failed = [line for line in section.lines if any(row.verdict is Verdict.FAIL for row in line.result.rows)]
    sources = {line.result.job.implementation for line in failed}
    if not names or all(Implementation(source).takes_ours(names) for source in sources):
        return []
    return [Remark(Verdict.FAIL, _STEERED)]


def _words_of(row: Row) -> tuple[str, str]:
    """What is said of the implementations that have this row's note, and the note behind it."""
    if row.verdict is Verdict.NEEDS:
        return "{who} need {note}", row.note.removeprefix("needs ")
    own = row.verdict in (Verdict.FAIL, Verdict.DISAGREES, Verdict.KNOWN_DEVIATION)  # in the lab's own words
    note = row.note.replace(": ", "; ") if own else why(row.verdict, row.note).removeprefix(f"{row.verdict}: ")
    if (own or row.verdict in (Verdict.NOT_AVAILABLE, Verdict.SHOWN)) and row.measured is None:
        return "{who} have no number: {note}", note.removeprefix("no finite number; ")
    return f"{_SAID[row.verdict].removesuffix(' in every check')}: {{note}}", note


def _remark(words: str, note: str, times: dict[str, dict[str, int]]) -> str:
    who = [f"{name} ({', '.join(map(_times, profiles.items()))})" for name, profiles in times.items()]
    said = _of_one(words) if len(who) == 1 else words
    return _capital(said.format(who=listed(who), note=note)) + "."


def _times(often: tuple[str, int]) -> str:
    profile, count = often
    return profile if count == 1 else f"{profile} {count}×"


def _of_one(words: str) -> str:
    """The words for one implementation: `agrees` for `agree`."""
    return re.sub("|".join(_OF_ONE), lambda found: _OF_ONE[found[0]], words, count=1)


def _capital(text: str) -> str:
    return f"{text[:1].upper()}{text[1:]}"


def _sentence(lines: Sequence[Line], opening: str = "") -> str:
    """What is to be said of these lines, verdict by verdict; empty where there are none."""
    parts = []
    for verdict, words in _SAID.items():
        own = [line for line in lines if line.whole.verdict is verdict]
        some = {_lacking(line) for line in own}
        if len(some) == 1 and "" not in some:
            words, who = f"{{who}} {some.pop()}", _names(own, lines)
        elif verdict is Verdict.PASS:
            who = _names(own, lines)
        else:
            who = [_named(line, lines) for line in own]
        if own:
            parts.append((_of_one(words) if len(who) == 1 else words).format(who=listed(who)))
    return f"{_capital(opening + '; '.join(parts))}." if parts else ""


def _lacking(line: Line) -> str:
    """What is said of an implementation that cannot express some of the cases; empty where it is not so."""
    cases = line.whole.in_words.removeprefix(f"{Verdict.CANNOT_EXPRESS}: ")
    if line.whole.verdict is not Verdict.CANNOT_EXPRESS or not cases:
        return ""
    others = {row.verdict for row in line.result.rows} - {Verdict.CANNOT_EXPRESS, Verdict.SHOWN}
    agrees = " and agree with theory in the others" if others == {Verdict.PASS} else ""
    return f"cannot express {cases}{agrees}"


def _names(own: Sequence[Line], lines: Sequence[Line]) -> list[str]:
    """The names of implementations; one that all lines of its name share stands once, without its methods."""
    names: dict[str, None] = {}
    for line in own:
        alike = [other for other in lines if other.name == line.name]
        names[line.name if all(other in own for other in alike) else _name(line, lines)] = None
    return list(names)


def _named(line: Line, lines: Sequence[Line]) -> str:
    """An implementation, with the number that is furthest from theory."""
    name = _name(line, lines)
    return f"{name} ({line.whole.in_words})" if line.whole.in_words else name


def _name(line: Line, lines: Sequence[Line]) -> str:
    """An implementation, with its method where other lines have its name too."""
    if sum(other.name == line.name for other in lines) == 1:
        return line.name
    kind = "by the method" if _by_hand(line) else "in the profile"
    return f"{line.name} {kind} {line.result.job.profile}"


def _by_hand(line: Line) -> bool:
    return line.result.job.engine == Handwritten.name
