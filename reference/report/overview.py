"""The report's first table: every scenario × every implementation at a glance, and the sentence that sums it up."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from reference.comparison.verdicts import Row, Verdict
from reference.engines.handwritten_engine import Handwritten
from reference.engines.profiles import counts
from reference.report.marks import AGREES
from reference.report.sections import Line, Section


@dataclass(frozen=True)
class Overview:
    """One row for each scenario and one column for each implementation; `Line.whole` is what a cell shows.

    titles: of the columns.
    """

    sections: tuple[Section, ...]
    titles: tuple[str, ...]

    @classmethod
    def of(cls, found: Sequence[Section]) -> Overview:
        """The table of all sections, with every implementation that occurs in one of them."""
        return cls(tuple(found), tuple(columns(found)))

    @property
    def rows(self) -> Iterator[tuple[Section, list[tuple[str, Line | None]]]]:
        """Each scenario with its cells by column title; None where it has no such implementation."""
        for section in self.sections:
            yield section, [(title, section.line(title)) for title in self.titles]

    def in_parts(self) -> list[Overview]:
        """The columns that count, other methods by hand, and the engines' other settings.

        For a terminal that is too narrow for all of them together; a part without columns is left out.
        """
        lines = [line for section in self.sections for line in section.lines]
        counting = {line.title for line in lines if line.counts}
        by_hand = {line.title for line in lines if line.result.job.engine == Handwritten.name} - counting
        rest = set(self.titles) - counting - by_hand
        parts = [tuple(title for title in self.titles if title in part) for part in (counting, by_hand, rest)]
        return [replace(self, titles=titles) for titles in parts if titles]


def columns(found: Sequence[Section]) -> list[str]:
    """Titles of all implementations that occur, in the order of the tables."""
    fullest_first = sorted(found, key=lambda section: -len(section.lines))
    return list(dict.fromkeys(line.title for section in fullest_first for line in section.lines))


def verdict_line(rows: Sequence[Row]) -> str:
    """One sentence on how many checks that count agree with theory."""
    counted = [row for row in rows if counts(row.profile) and row.verdict is not Verdict.SHOWN]
    agreeing = sum(row.verdict in AGREES for row in counted)
    known = sum(row.verdict is Verdict.KNOWN_DEVIATION for row in counted)
    disagreeing = sum(row.verdict is Verdict.DISAGREES for row in counted)
    failed = sum(row.verdict is Verdict.FAIL for row in counted)
    waiting = sum(row.verdict is Verdict.NEEDS for row in counted)
    without = len(counted) - agreeing - disagreeing - failed - waiting
    judged = len(counted) - waiting
    parts = [f"{agreeing} of {judged} checks that count agree with theory"]
    if known:
        parts.append(f"{known} of them with the difference that their method predicts")
    if disagreeing:
        parts.append(f"{disagreeing} disagree{'s' if disagreeing == 1 else ''} with it as the method must")
    parts.append(f"{failed} fail{'s' if failed == 1 else ''}")
    if without:
        parts.append(f"{without} gave no answer")
    if waiting:
        parts.append(f"{waiting} {'case waits' if waiting == 1 else 'cases wait'} for hand-written functions")
    return ", ".join(parts) + "."
