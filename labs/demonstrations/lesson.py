"""The lines of a demonstration's lesson: sentences with numbers of its runs in them, as data.

    Line("Stock: ", Listed(IfKnown("PyBullet ", Measured("pybullet", "stock", "rest_time")), IfKnown(…)), ".")

A run may be missing, and its numbers with it. Then a part marked `IfKnown` is left out by itself, and elsewhere the
whole line is left out. A line that has lost all its numbers is left out as well.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass


@dataclass(frozen=True)
class Measured:
    """A quantity as an engine measured it in a profile; `at` names one of several cases or timesteps."""

    engine: str
    profile: str
    quantity: str
    at: str = ""


class Magnitude(Measured):
    """The same without its sign."""


class Error(Measured):
    """How far the measured quantity is from theory."""


@dataclass(frozen=True)
class Theory:
    """What theory says of a quantity; `at` names one of several cases."""

    quantity: str
    at: str = ""


@dataclass(frozen=True)
class Predicted:
    """What the method must give at one of the demonstration's timesteps."""

    at: str


Number = Measured | Theory | Predicted
Written = Callable[[Number], str]
"""Gives a number as it is written in a lesson, and an empty text if it is missing."""


class IfKnown:
    """A part of a line that is left out if a number in it is missing."""

    def __init__(self, *parts: str | Number | Listed) -> None:
        self.parts = parts


class Listed:
    """Those of several parts whose numbers are known, with commas between them; missing if none of them is."""

    def __init__(self, *choices: IfKnown) -> None:
        self.parts = choices


Part = str | Number | IfKnown | Listed


class Line:
    """One line of a lesson."""

    def __init__(self, *parts: Part) -> None:
        self.parts = parts

    @property
    def numbers(self) -> list[Number]:
        """All numbers that the line asks for."""
        return list(_numbers(self.parts))

    def text(self, written: Written) -> str:
        """The line with its numbers; empty if it is left out."""
        if self.numbers and not any(map(written, self.numbers)):
            return ""
        return _joined(self.parts, written) or ""


def _numbers(parts: tuple[Part, ...]) -> Iterator[Number]:
    for part in parts:
        if isinstance(part, IfKnown | Listed):
            yield from _numbers(part.parts)
        elif not isinstance(part, str):
            yield part


def _joined(parts: tuple[Part, ...], written: Written) -> str | None:
    """The parts one after another; None if something is missing that may not be left out."""
    texts = [_text(part, written) for part in parts]
    return None if None in texts else "".join(text for text in texts if text)


def _text(part: Part, written: Written) -> str | None:
    """A part with its numbers; None if it is missing."""
    if isinstance(part, str):
        return part
    if isinstance(part, IfKnown):
        return _joined(part.parts, written) or ""
    if isinstance(part, Listed):
        return ", ".join(filter(None, (_text(choice, written) for choice in part.parts))) or None
    return written(part) or None
