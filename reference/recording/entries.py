"""The entries of a recording: how they are named, and what each holds of one case.

A family's own case has its own name while a profile has its own timestep, and a point of the family's grid then has
` @ own` behind the name. At another timestep both are named after it, as in `e=0.5 @ 0.002 s`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from reference.comparison.compare import Number
from reference.comparison.verdicts import Row, Verdict
from reference.scene.settings import Settings

_AT, _OWN, _UNIT = " @ ", "own", " s"
GRID_DIGITS = 11
"""Digits of a number at a point or a timestep of a grid, so that the files stay half as large."""
_ROUNDED = 0.5 * 10.0 ** (1 - GRID_DIGITS)
"""Share by which that rounds a number at most."""


def names_of(case: str, own: Settings, settings: Settings) -> tuple[str, str]:
    """The names under which a case with these settings may be kept: as the family's own, and as a point of its grid.

    own: the settings of the profile, before anything was changed.
    """
    if settings == own:
        return case, f"{case}{_AT}{_OWN}"
    name = f"{case}{_AT}{settings.timestep:.6g}{_UNIT}"
    return name, name


def name_of(case: str, own: Settings, settings: Settings, of_grid: bool) -> str:
    """The name under which a case with these settings is kept, as the family's own or as a point of its grid."""
    of_family, as_point = names_of(case, own, settings)
    return as_point if of_grid else of_family


def case_of(name: str) -> str:
    """The case of an entry."""
    return name.partition(_AT)[0]


def rounded(name: str) -> float:
    """Share by which the numbers of an entry may have been rounded: those of a family's own cases are whole."""
    return _ROUNDED if _AT in name else 0.0


def timestep_of(name: str) -> float | None:
    """The timestep of an entry, s; None where it is the profile's own."""
    at = name.partition(_AT)[2]
    return None if at in ("", _OWN) else float(at.removesuffix(_UNIT))


def name_as_own_case(name: str) -> str:
    """The name that the entry of a point of the grid would have if it were one of the family's own cases."""
    return name.removesuffix(f"{_AT}{_OWN}")


@dataclass(frozen=True)
class Entry:
    """What a recording holds of one case.

    fingerprint: of its scenarios and settings. numbers: one for each quantity of the family; empty where the run gave
    none, and then `verdict` and `note` say why.
    """

    fingerprint: str
    numbers: tuple[Number, ...] = ()
    verdict: Verdict | None = None
    note: str = ""

    @classmethod
    def of(cls, fingerprint: str, rows: Sequence[Row], digits: int | None = None) -> Entry:
        """The entry of a case from its rows, each number with so many digits, or all of them."""
        first = rows[0]
        if not first.quantity:
            return cls(fingerprint, verdict=first.verdict, note=first.note)
        return cls(fingerprint, tuple(_number(row, digits) for row in rows))

    @classmethod
    def read(cls, kept: Sequence[Any]) -> Entry:
        """The entry from its JSON: a fingerprint and a list of numbers, or a fingerprint, a verdict and a note."""
        fingerprint, *found = kept
        if len(found) == 1:
            return cls(fingerprint, tuple(_read(each) for each in found[0]))
        return cls(fingerprint, (), Verdict(found[0]), found[1])

    def as_json(self) -> list[Any]:
        """The entry as `read` reads it: of each quantity its value, those of an ensemble, or why there is none."""
        if self.verdict is not None:
            return [self.fingerprint, str(self.verdict), self.note]
        return [
            self.fingerprint,
            [_written(each) for each in self.numbers],
        ]


def _read(kept: float | list[float] | str) -> Number:
    if isinstance(kept, str):
        return Number(note=kept)
    return Number(tuple(kept) if isinstance(kept, list) else (kept,))


def _written(number: Number) -> float | list[float] | str:
    if number.mean is None:
        return number.note
    return number.values[0] if len(number.values) == 1 else list(number.values)


def _number(row: Row, digits: int | None) -> Number:
    if row.measured is None:
        return Number(note=row.note)
    return Number(tuple(_rounded(value, digits) for value in row.values))


def _rounded(value: float, digits: int | None) -> float:
    return value if digits is None else float(f"{value:.{digits}g}")
