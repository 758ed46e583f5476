"""The published cases as one HTML page that needs nothing beside it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from reference import lecture
from reference.published.case import Figure, Kind, Published
from reference.published.results import PublishedRow
from reference.report import numbers
from reference.report.marks import MARKS, occurring
from reference.report.page import as_markup, environment
from reference.report.published.tables import LEGEND, TITLES, PublishedTables, engine_title, figure, label

FEW = 5
"""A case with no more numbers than this shows them without a click."""
SET_UP_DIGITS = 7
"""Digits of a number of the set-up."""
MANY_EQUAL = 4
"""If more numbers of one entry than this are repetitions, each value is shown once."""
ABOUT: dict[Kind, str] = {
    "verification": "The number is a closed form, or that of a method which can be repeated digit by digit. A"
    " difference is a mistake, or the method's own error, whose size is known beforehand.",
    "validation": "The number was measured on real bodies. No formula has to agree with it. Where a formula differs,"
    " that shows what it leaves out.",
    "cross-engine": "The number is what another simulator gave. It may be right or wrong: to agree means to do as it"
    " does. Where the implementation is the simulator itself, it does not count as a confirmation.",
}


def render(
    tables: PublishedTables,
    figures: Mapping[str, Sequence[tuple[str, str]]],
    versions: Sequence[str],
    provenance: str,
    report: str,
    unfinished: str = "",
) -> str:
    """Return the page. figures: by case, SVG texts with their captions. report: the address of the other page.

    unfinished: what the page says of itself while runs have not ended.
    """
    return (
        environment()
        .get_template("published.html.j2")
        .render(
            tables=tables,
            kinds=TITLES,
            about=ABOUT,
            figures=as_markup(figures),
            versions=versions,
            provenance=provenance,
            report=report,
            unfinished=unfinished,
            legend={verdict: LEGEND[verdict] for verdict in occurring(tables.rows)},
            marks=MARKS,
            few=FEW,
            engine_title=engine_title,
            statement=lecture.statement,
            set_up=set_up,
            label=label,
            figure=figure,
            difference=_difference,
        )
    )


def set_up(case: Published) -> str:
    """The set-up in words."""
    parts = [f"{name.replace('_', ' ')} {_said(value)}" for name, value in case.setup.items()]
    return f"Set up with {', '.join(parts)} (SI units, angles in degrees)."


def _said(value: Figure) -> str:
    """One number, or several; where many of them are equal, each value once."""
    if not isinstance(value, tuple):
        return numbers.digits(value, SET_UP_DIGITS)
    different = list(dict.fromkeys(value)) if len(value) > len(set(value)) + MANY_EQUAL else list(value)
    return f"({', '.join(numbers.digits(each, SET_UP_DIGITS) for each in different)})"


def _difference(row: PublishedRow) -> str:
    return numbers.deviation(row.difference, "") if row.difference else ""
