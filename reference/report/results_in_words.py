"""The result of a scenario in words: what agrees with theory and what does not, and what is accepted."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from reference.comparison.verdicts import Verdict
from reference.engines.handwritten_engine import Handwritten
from reference.report.sections import Line, Section

_OPENINGS = {
    Verdict.KNOWN_DEVIATION: "As its method must, {who} differs",
    Verdict.DISAGREES: "As its method must, {who} is nowhere near theory",
    Verdict.FAIL: "{who} differs by more than its method explains",
    Verdict.NEEDS: "{who} waits for functions that are not written yet",
    Verdict.CANNOT_EXPRESS: "{who} cannot express this",
    Verdict.NO_WORDS: "The lab has no words for this in {who}",
    Verdict.NOT_AVAILABLE: "{who} is not installed here",
    Verdict.CRASHED: "{who} crashed",
}
"""How a sentence about one implementation begins, by its worst verdict."""
_WITHOUT_NUMBER = (Verdict.NEEDS, Verdict.CANNOT_EXPRESS, Verdict.NO_WORDS, Verdict.NOT_AVAILABLE, Verdict.CRASHED)


def counted(section: Section) -> str:
    """What the implementations give that count: hand-written code at its best, engines told what the scenario means."""
    return _sentences([line for line in section.lines if line.counts], _name)


def plain(section: Section) -> str:
    """What hand-written code gives at the step, and what the engines give as installed."""
    return _sentences([line for line in section.lines if line.plain], _plain_name)


def accepted(section: Section) -> list[tuple[str, str]]:
    """Each reason for a tolerance, once, with the quantities and the implementations to which it applies."""
    found: dict[tuple[str, str], list[str]] = {}
    for quantity in section.family.quantities:
        groups = section.tolerances(quantity.name)
        largest = max((len(titles) for _, titles in groups), default=0)
        for reason, titles in groups:
            who = "; ".join(titles)
            if len(titles) == largest and len(titles) > 2:
                who = "all" if len(groups) == 1 else "all others"
            found.setdefault((reason, who), []).append(quantity.title)
    return [(reason, f"{', '.join(quantities)}: {who}") for (reason, who), quantities in found.items()]


def _sentences(lines: Sequence[Line], name: Callable[[Line], str]) -> str:
    good = [name(line) for line in lines if line.whole.verdict is Verdict.PASS]
    shown = [name(line) for line in lines if line.whole.verdict is Verdict.SHOWN]
    parts = []
    if good:
        parts.append(f"{_listed(good)} {'agrees' if len(good) == 1 else 'agree'} with theory in every check.")
    if shown:
        parts.append(f"Of {_listed(shown)} the numbers are only shown.")
    for verdict, opening in _OPENINGS.items():
        own = [line for line in lines if line.whole.verdict is verdict]
        if own:
            parts.append(_about(opening, verdict, own, name))
    return " ".join(part[0].upper() + part[1:] for part in parts)


def _about(opening: str, verdict: Verdict, lines: Sequence[Line], name: Callable[[Line], str]) -> str:
    """One sentence on all lines with the same worst verdict, each with its worst number."""
    who = _listed([name(line) for line in lines])
    if len(lines) > 1:
        for one, many in ((" differs", " differ"), (" is ", " are "), (" waits", " wait"), ("its method", "their methods")):
            opening = opening.replace(one, many)
    said = opening.format(who=who)
    if verdict in _WITHOUT_NUMBER and all(not line.whole.in_words for line in lines):
        return f"{said}."
    details = [
        (f"{name(line)}: " if len(lines) > 1 else "") + line.whole.in_words for line in lines if line.whole.in_words
    ]
    return f"{said} ({'; '.join(details)})."


def _name(line: Line) -> str:
    return "hand-written code" if _by_hand(line) else line.result.title


def _plain_name(line: Line) -> str:
    return "hand-written code at the step" if _by_hand(line) else f"{line.result.title} as installed"


def _by_hand(line: Line) -> bool:
    return line.result.job.engine == Handwritten.name


def _listed(names: Iterable[str]) -> str:
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last
