"""Who agrees with whom: a matrix of all implementations of a family, as text, for the page, the terminal and files."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, fields
from typing import Any

from reference.comparison.pairs import NO_REASON, Agreement, Name, Pair, Relation, agreements
from reference.engines.profiles import counts
from reference.recording.files import MARK
from reference.report import numbers
from reference.report.sections import Line, Section

MARKS = {Relation.ALIKE: "✓", Relation.EXPLAINED: "≈", Relation.APART: "≠"}
LEGEND = {
    Relation.ALIKE: "no farther apart than the more tightly bound of the two may be from theory, or than a thousandth",
    Relation.EXPLAINED: "farther apart in so many numbers, each as theory and the two methods say",
    Relation.APART: "farther apart in so many numbers, some of them for a reason that is listed here",
}


@dataclass(frozen=True)
class Entry:
    """Two implementations in one family. text: as in a cell, `≠ 7`. title: of how many, and where they differ most."""

    relation: Relation
    text: str
    title: str


@dataclass(frozen=True)
class Matrix:
    """All implementations of a family against each other.

    titles: of the implementations that have a number. rows: for each of them, an entry for each one before it, None
    where the two never have a number of the same quantity. whys: each reason why some are apart, with the titles of
    those that it belongs to; with none where theory is silent about all, or where the reason names them itself.
    """

    titles: tuple[str, ...]
    rows: tuple[tuple[Entry | None, ...], ...]
    whys: tuple[tuple[str, tuple[str, ...]], ...]

    @classmethod
    def of(cls, section: Section) -> Matrix:
        """The matrix of a section's lines, in their order."""
        found = agreements(section.pairs).get(section.family.name, {})
        met = {name for names in found for name in names}
        lines = [line for line in section.lines if _name(line) in met]
        rows = tuple(
            tuple(_entry(section, one, other, found.get((_name(other), _name(one)))) for other in lines[:place])
            for place, one in enumerate(lines)
        )
        return cls(tuple(line.title for line in lines), rows, _whys(lines, found))


def _name(line: Line) -> Name:
    return line.result.job.engine, line.result.job.profile


def _entry(section: Section, one: Line, other: Line, agreement: Agreement | None) -> Entry | None:
    if agreement is None:
        return None
    relation = agreement.relation
    count = len(agreement.pairs) - agreement.count(Relation.ALIKE)
    text = MARKS[relation] if relation is Relation.ALIKE else f"{MARKS[relation]} {count}"
    if not count:
        return Entry(relation, text, "")
    most = _where(section, agreement.worst, "most ")
    return Entry(relation, text, f"{count} of {len(agreement.pairs)} numbers differ, {most}")


def _where(section: Section, pair: Pair, most: str = "") -> str:
    """By how much two numbers differ, and which: `by 2.3 mm in “deepest penetration” (e=0)`."""
    quantity = section.family.quantity(pair.quantity)
    where = f"“{quantity.title}” ({pair.case})"
    if pair.difference is None:
        return f"one has no {where}"
    share = f" of {quantity.share_of}" if quantity.share_of else ""
    return f"{most}by {numbers.size(abs(pair.difference), pair.unit)}{share} in {where}"


def _whys(
    lines: Sequence[Line], found: Mapping[tuple[Name, Name], Agreement]
) -> tuple[tuple[str, tuple[str, ...]], ...]:
    """Each reason with the titles of those that it belongs to; none where theory is silent, or it names them itself."""
    of_name = {_name(line): line for line in lines}
    named: dict[str, dict[str, None]] = {}
    for reason in (reason for agreement in found.values() for reason in agreement.whys):
        whose = named.setdefault(reason.said, {})
        if reason.whose is not None and not _names(reason.said, of_name[reason.whose]):
            whose[of_name[reason.whose].title] = None
    return tuple((said, tuple(whose)) for said, whose in named.items())


def _names(reason: str, line: Line) -> bool:
    """Whether a reason says itself to which implementation it belongs: `MuJoCo, as installed, …`."""
    profile = "as installed" if line.plain else line.result.job.profile
    return line.result.title.removesuffix(MARK) in reason and profile in reason


@dataclass(frozen=True)
class Between:
    """How the implementations of one scenario compare with each other.

    alike, explained, apart: pairs of numbers of those that count. farthest: which two of them are farthest apart, and
    by how much, as a sentence without its stop; empty where all are alike. others: pairs apart with one that does not
    count.
    """

    section: Section
    alike: int
    explained: int
    apart: int
    farthest: str
    others: int

    @property
    def relation(self) -> Relation:
        """The worst relation of any two that count."""
        return Relation.APART if self.apart else Relation.EXPLAINED if self.explained else Relation.ALIKE

    @property
    def text(self) -> str:
        """As in a cell: `≠ 36`."""
        return f"{MARKS[self.relation]} {self.apart or self.explained or ''}".strip()

    @property
    def in_words(self) -> str:
        """Whether those that count agree with each other, in a sentence where they do not."""
        if not self.apart:
            return ""
        return (
            f"With each other they do not agree: {self.apart} of {self.alike + self.explained + self.apart} pairs of"
            f" their numbers are apart. Most of all, {self.farthest}."
        )


def by_scenario(found: Iterable[Section]) -> dict[str, Between]:
    """By family, a summary where two implementations that count have a number."""
    return {section.family.name: summary for section in found if (summary := _between(section)) is not None}


def _between(section: Section) -> Between | None:
    counted = Agreement(tuple(pair for pair in section.pairs if _counts(pair)))
    if not counted.pairs:
        return None
    alike, explained, apart = (counted.count(relation) for relation in Relation)
    names = {_name(line): f"{line.name} ({line.result.job.profile})" for line in section.lines}
    pair = counted.worst
    farthest = ""
    if explained + apart:
        differ = "differ" if pair.difference is not None else "differ:"
        farthest = f"{names[pair.first]} and {names[pair.second]} {differ} {_where(section, pair)}"
    others = sum(pair.relation is Relation.APART for pair in section.pairs) - apart
    return Between(section, alike, explained, apart, farthest, others)


def sentence(every: Iterable[Pair]) -> str:
    """How many pairs of counted implementations are alike, in one sentence; empty where there is no pair."""
    found = Agreement(tuple(pair for pair in every if _counts(pair)))
    if not found.pairs:
        return ""
    alike, explained, apart = (f"{found.count(relation):,}" for relation in Relation)
    unsaid = sum(any(reason.said == NO_REASON for reason in pair.why) for pair in found.pairs)
    ending = f", {unsaid:,} of them without a reason that the lab knows" if unsaid else ""
    return (
        f"Compared with each other, {alike} of {len(found.pairs):,} pairs of numbers are alike, {explained} differ as"
        f" their methods say, and {apart} {'is' if apart == '1' else 'are'} apart{ending}."
    )


def _counts(pair: Pair) -> bool:
    """Whether both implementations count."""
    return counts(pair.first[1]) and counts(pair.second[1])


def as_content(every: Iterable[Pair]) -> list[dict[str, Any]]:
    """The matrices of all families as plain data: for each two implementations the counts, and the farthest pair."""
    return [
        {
            "family": family,
            "first": {"engine": first[0], "profile": first[1]},
            "second": {"engine": second[0], "profile": second[1]},
            **{relation.value: agreement.count(relation) for relation in Relation},
            "farthest": {
                key: getattr(agreement.worst, key) for key in ("case", "quantity", "unit", "difference", "near")
            },
            "whys": [reason.said for reason in agreement.whys],
        }
        for family, both in agreements(every).items()
        for (first, second), agreement in both.items()
    ]


def pairs_csv(every: Iterable[Pair]) -> str:
    """Every pair of numbers as CSV."""
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    names = [entry.name for entry in fields(Pair) if entry.name not in ("first", "second")]
    table.writerow(["first_engine", "first_profile", "second_engine", "second_profile", *names])
    for pair in every:
        values = asdict(pair) | {"why": " ".join(reason.said for reason in pair.why)}
        table.writerow([*pair.first, *pair.second, *(values[name] for name in names)])
    return text.getvalue()
