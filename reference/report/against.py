"""How the rows of a comparison differ from those of an earlier `rows.json`, and which versions gave both."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from reference.comparison.verdicts import Row
from reference.engines import load_engine
from reference.errors import CollisionsError

NEAR = 1e-6
"""Numbers that differ by a smaller share of the larger one are the same."""


def differences(rows: Sequence[Row], earlier: Sequence[Row]) -> list[str]:
    """Lines that say what differs: versions first, since they explain the rest; then each row, and how many are alike.

    Rows are those of the same case, quantity, implementation and profile. What only one of the two has is counted.
    """
    then, now = ({_place(row): row for row in some} for some in (earlier, rows))
    both = [(then[place], row) for place, row in now.items() if place in then]
    changed = [line for old, row in both if (line := _change(old, row))]
    alike = f"{len(both) - len(changed):,} of {len(both):,} rows are as they were"
    alone = len(now) - len(both), len(then) - len(both)
    counted = f"{alike}; {alone[0]:,} are new, and {alone[1]:,} have no counterpart here."
    return [*_versions(both), *changed, counted]


def _place(row: Row) -> tuple[str, ...]:
    return row.family, row.case, row.engine, row.profile, row.quantity


def _versions(both: Iterable[tuple[Row, Row]]) -> Iterator[str]:
    found = {(row.engine, *_versions_of(old), *_versions_of(row)): None for old, row in both}
    for name, old, old_adapter, new, new_adapter in found:
        if old and new and old != new:
            yield f"The rows of {_title(name)} are of different versions: {old} then, {new} now."
        if old_adapter and new_adapter and old_adapter != new_adapter:
            yield f"The lab told {_title(name)} its scenarios in version {old_adapter} then, {new_adapter} now."


def _versions_of(row: Row) -> tuple[str, str]:
    return row.engine_version, row.adapter_version


def _title(engine: str) -> str:
    try:
        return load_engine(engine).title
    except CollisionsError:  # an engine file that is not here
        return engine


def _change(old: Row, new: Row) -> str:
    """How a row differs; empty where it does not."""
    what = []
    if old.verdict is not new.verdict:
        what.append(f"{old.verdict} → {new.verdict}")
    a, b = old.measured, new.measured
    if a != b and (a is None or b is None or abs(a - b) > NEAR * max(abs(a), abs(b))):
        what.append(f"{_number(a)} → {_number(b)} {new.unit}".rstrip())
    where = f"{new.family}/{new.case}, {_title(new.engine)} ({new.profile})"
    return f"{where}{f', {new.quantity}' * bool(new.quantity)}: {', '.join(what)}" if what else ""


def _number(value: float | None) -> str:
    return "no number" if value is None else f"{value:.7g}"
