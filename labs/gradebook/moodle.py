"""Moodle's grading worksheet in the languages of Moodle: which column is which, and when a submission came."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from labs.gradebook.sheets import plain
from labs.gradebook.times import Received, duration_in_words, moment_in_words

_NOTHING = ("", "-")
_OF_A_WORKSHEET = (("identifier", "name"), ("identifier", "status", "grade"))
"""What a worksheet has at least: with hidden identities it has no names."""
HEADINGS = (
    "identifier", "name", "email", "number", "status", "grade", "maximum", "submitted", "graded", "comments",
)  # fmt: skip


@dataclass(frozen=True)
class Words:
    """A language of Moodle. headings: of each column, all that are in use. late: what the status says of lateness.

    units: minutes of each unit of time. months: from January on.
    """

    headings: Mapping[str, tuple[str, ...]]
    late: tuple[str, ...]
    units: Mapping[str, int]
    months: tuple[str, ...]

    def columns(self, header: Iterable[str]) -> dict[str, str]:
        """What each heading of a table means: the heading as `plain` spells it, by meaning."""
        there = [plain(each) for each in header]
        found = {
            meaning: next((plain(each) for each in names if plain(each) in there), "")
            for meaning, names in self.headings.items()
        }
        return {meaning: heading for meaning, heading in found.items() if heading}

    def received(self, submitted: str, status: str) -> Received:
        """When a submission came, from the two cells that say so."""
        stamp = "" if submitted.strip() in _NOTHING else submitted.strip()
        parts = [plain(part) for part in status.split(" - ")]
        late = [part for part in parts if any(plain(word) in part for word in self.late)]
        found = (duration_in_words(part, self.units) for part in late)
        late_by = next((each for each in found if each is not None), None)
        at, says = moment_in_words(stamp, self.months), bool(status.strip())
        return Received(stamp, at, late_by, called_late=late_by is not None, says_lateness=says)


@cache
def languages() -> tuple[Words, ...]:
    """Every language whose words are known, English first."""
    content = tomllib.loads(files("labs.gradebook").joinpath("moodle.toml").read_text(encoding="utf-8"))
    return tuple(
        Words(
            {meaning: tuple(each[meaning]) for meaning in HEADINGS},
            tuple(each["late"]), each["units"], tuple(each["months"]),
        )
        for each in content.values()
    )  # fmt: skip


def language_of(header: Iterable[str]) -> Words | None:
    """The language in which a table has the headings of Moodle's worksheet; None if it is no worksheet."""
    there = list(header)
    every = [(words, words.columns(there)) for words in languages()]
    fit = [
        (len(columns), -place)
        for place, (_, columns) in enumerate(every)
        if any(set(needs) <= columns.keys() for needs in _OF_A_WORKSHEET)
    ]
    return languages()[-max(fit)[1]] if fit else None


def every_heading() -> set[str]:
    """All headings in all languages."""
    return {name for words in languages() for names in words.headings.values() for name in names}
