"""The report's first table: every scenario × every implementation at a glance, and the sentence that sums it up."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from reference.comparison.verdicts import ALL_CASES, Row, Verdict
from reference.engines.profiles import STOCK, counts
from reference.errors import listed
from reference.report.sections import Line, Section
from reference.running.protocol import Result

COUNTED, PLAIN = "what counts", "as installed, and by hand at the step"
BY_HAND, IN_ENGINES = "for other methods by hand", "for other settings of the engines"
"""The parts of the table, in their order."""


@dataclass(frozen=True)
class Overview:
    """One row for each scenario and one column for each implementation; `Line.whole` is what a cell shows.

    titles: of the columns. part: which of the parts it is; empty for the whole table.
    """

    sections: tuple[Section, ...]
    titles: tuple[str, ...]
    part: str = ""

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
        """The implementations that count, the plain ones, the other methods by hand, and other settings of engines.

        A part without columns is left out.
        """
        lines = [line for section in self.sections for line in section.lines]
        counting = {line.title for line in lines if line.counts}
        plain = {line.title for line in lines if line.plain} - counting
        by_hand = {line.title for line in lines if line.handwritten} - counting - plain
        rest = set(self.titles) - counting - plain - by_hand
        parts = [
            (name, tuple(title for title in self.titles if title in part))
            for name, part in ((COUNTED, counting), (PLAIN, plain), (BY_HAND, by_hand), (IN_ENGINES, rest))
        ]
        return [replace(self, titles=titles, part=name) for name, titles in parts if titles]


def columns(found: Sequence[Section]) -> list[str]:
    """Titles of all implementations that occur, in the order of the tables."""
    fullest_first = sorted(found, key=lambda section: -len(section.lines))
    return list(dict.fromkeys(line.title for section in fullest_first for line in section.lines))


_SAID = {
    "{} as predicted and away from theory": (Verdict.KNOWN_DEVIATION, Verdict.DISAGREES),
    "{} failed": (Verdict.FAIL,),
    "{} gave no answer": (Verdict.CRASHED, Verdict.NOT_AVAILABLE),
}
"""What is said of so many checks, by their verdicts."""
_WITHOUT = {
    ("case cannot be", "cases cannot be", "expressed in the engine"): (Verdict.CANNOT_EXPRESS, Verdict.NO_WORDS),
    ("case waits", "cases wait", "for hand-written code"): (Verdict.NEEDS,),
    ("run was", "runs were", "lost and not judged"): (Verdict.LOST,),
}
"""What is said of one case or of several that have no number. One of them stands for all checks of its case."""
_ALWAYS = (Verdict.FAIL,)
_IDLE = ("check", "checks", "would pass even if no body moved")
"""What is said of one check or of several that are no evidence."""


def verdict_line(rows: Sequence[Row]) -> str:
    """The checks that count: near theory, away from it as predicted, failed; and the cases that have no number.

    A check that bodies at rest in their starts would pass as well is no evidence, and is counted apart.
    """
    every = [row for row in rows if counts(row.profile) and row.verdict not in (Verdict.SHOWN, Verdict.RUNNING)]
    judged = [row for row in every if not any(row.verdict in verdicts for verdicts in _WITHOUT.values())]
    counted = [row for row in judged if row.evidence]
    near = sum(row.verdict is Verdict.PASS and row.expected is not None for row in counted)
    silent = sum(row.verdict is Verdict.PASS and row.expected is None for row in counted)
    parts = [f"Of {_checks(len(counted))}, {near:,} came out as predicted and near theory"]
    if silent:
        parts.append(f"{silent:,} as predicted where theory is silent")
    for words, verdicts in _SAID.items():
        count = sum(row.verdict in verdicts for row in counted)
        if count or verdicts == _ALWAYS:
            parts.append(words.format(f"{count:,}" if count else "none"))
    cases = {_IDLE: len(judged) - len(counted)}
    cases |= {words: sum(row.verdict in verdicts for row in every) for words, verdicts in _WITHOUT.items()}
    others = [f"{n:,} {one if n == 1 else several} {rest}" for (one, several, rest), n in cases.items() if n]
    return f"{listed(parts)}." + (f" Besides, {listed(others)}." if others else "")


def without_answer(results: Iterable[Result]) -> list[str]:
    """A line for each reason for which runs crashed or were lost; it names all of these runs, stock ones as well."""
    found: dict[tuple[Verdict, str], dict[str, None]] = {}
    for result in results:
        cases: dict[tuple[Verdict, str], dict[str, None]] = {}
        for row in result.rows:
            if row.verdict in (Verdict.CRASHED, Verdict.LOST):
                cases.setdefault((row.verdict, row.note), {})[row.case] = None
        for reason, names in cases.items():
            which = "" if ALL_CASES in names or result.label.startswith(", ".join(names)) else f" ({', '.join(names)})"
            found.setdefault(reason, {})[f"{result.label}{which}"] = None
    return [f"{verdict}: {'; '.join(runs)}: {note}" for (verdict, note), runs in found.items()]


def not_counted(rows: Sequence[Row]) -> str:
    """What the page says beside the counts, since its marks of failure are those of engines as installed."""
    return "Engines as installed are shown, but not counted." if any(row.profile == STOCK for row in rows) else ""


def _checks(count: int) -> str:
    return "1 check that counts" if count == 1 else f"{count:,} checks that count"
