"""What a class has in common: how it did in each function, and which mistakes with a name several students made."""

from __future__ import annotations

import statistics
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from labs.grading.diagnosis.fingerprints.reading import BETWEEN
from labs.grading.diagnosis.misconceptions import read_bank
from reference import lecture

WAITS = ("calls a wrong function", "tested with a wrong function", "not tried")
"""Verdicts that leave open whether a function is right itself."""
_INHERITED = " < "
"""Stands between a function and the mistakes of the others that it may call."""
_MOST_ORIGINS = 2


@dataclass(frozen=True)
class Item:
    """How a class did in one function. share: of the points that were reached.

    tried: students who wrote it. right: who have it right. waits: of whom nobody can say yet, because a function that
    it calls is wrong, or because the time was used up. tells: how far the function separates strong students from weak
    ones, the correlation of its points with all the others', −1 to 1; None if everybody has the same points.
    """

    name: str
    step: int
    right: int
    tried: int
    share: float
    tells: float | None
    waits: int = 0

    @property
    def wrong(self) -> int:
        """Students who have a mistake in it."""
        return self.tried - self.right - self.waits


@dataclass(frozen=True)
class Mistake:
    """A known mistake, how many students made it, and what its author seems to think."""

    id: str
    students: int
    rationale: str


def items(lab: str, contents: Sequence[Mapping[str, Any]]) -> list[Item]:
    """How the class did in each function of the lab."""
    found = []
    for entry in lecture.functions_of(lab):
        if entry.role != "written":
            continue
        mine, others, verdicts = [], [], Counter[str]()
        for content in contents:
            for each in content.get("functions", []):
                if each["name"] == entry.name and each["possible"]:
                    mine.append(each["got"] / each["possible"])
                    others.append(content["got"] - each["got"])
                    verdicts[each["verdict"]] += 1
        share = statistics.fmean(mine) if mine else 0.0
        tried, waits = len(mine) - verdicts["unwritten"], sum(verdicts[each] for each in WAITS)
        tells = _correlation(mine, others)
        found.append(Item(entry.name, entry.step, verdicts["right"], tried, share, tells, waits))
    return found


def weakest(found: Sequence[Item]) -> Item | None:
    """What to teach again: the function in which the most students have a mistake."""
    return max((each for each in found if each.wrong), key=lambda each: each.wrong, default=None)


def mistakes(contents: Sequence[Mapping[str, Any]]) -> list[Mistake]:
    """The mistakes with a name that students made, the most common first. A student counts once for each.

    A function that only calls a wrong one adds nothing where the mistake of the latter is counted anyway.
    """
    counts, titles = Counter[str](), {entry.id: entry.rationale for entry in read_bank()}
    for content in contents:
        functions = content.get("functions", [])
        made = dict.fromkeys(known for each in functions for known in each["mistakes"])
        counts.update(known for known in made if made.keys().isdisjoint(_origins(known)))
        for each in functions:
            if "named_by_course" in each:
                titles[each["mistakes"][0]] = each["named_by_course"]["title"]
    return [
        Mistake(_name(known), count, _rationale(known, titles))
        for known, count in sorted(counts.items(), key=lambda each: (-each[1], each[0]))
    ]


def _origins(known: str) -> list[str]:
    """The mistakes of other functions that a mistake may come from; none if it is the function's own."""
    _, inherited, origins = known.partition(_INHERITED)
    return origins.split(BETWEEN) if inherited else []


def _callees(known: str) -> str:
    return " or ".join(dict.fromkeys(origin.partition("/")[0] for origin in _origins(known)))


def _name(known: str) -> str:
    return f"{known.partition(_INHERITED)[0]} with a wrong {_callees(known)}" if _origins(known) else known


def _rationale(known: str, titles: Mapping[str, str]) -> str:
    origins = _origins(known)
    if not origins:
        return titles.get(known, "")
    texts = [titles[each] for each in origins if each in titles][:_MOST_ORIGINS]
    more = f" Or one of {len(origins) - len(texts)} others." if len(origins) > len(texts) else ""
    return f"It would be right itself, but uses a wrong {_callees(known)}: {' Or: '.join(texts)}{more}"


def _correlation(one: Sequence[float], other: Sequence[float]) -> float | None:
    if len(one) < 3 or len(set(one)) == 1 or len(set(other)) == 1:
        return None
    return statistics.correlation(one, other)
