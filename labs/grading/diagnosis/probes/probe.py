"""What a probe is, and how probes are made: by hand, or drawn with the function's name as the seed.

The seed makes the drawn probes the same every time.
"""

from __future__ import annotations

import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from reference.arrays import Array

Group = Literal["usual", "edge", "many", "refused"]
GROUPS: tuple[Group, ...] = get_args(Group)
Arguments = tuple[Any, ...]
YES_OR_NO = 40
"""So many are drawn if an answer is one of two or three values, since each then reveals little of the formula."""
_LENGTHS = ((1, 2, 2, 3), (2, 3, 6, 7), (1, 4, 8, 9), (4, 4, 7, 9), (2, 6, 9, 11), (6, 6, 7, 11), (0, 3, 4, 5))
"""Whole numbers with a² + b² + c² = d²: they give unit vectors in many directions, exactly of length 1."""
_TURNS = (
    np.array([[2, -1, 2], [2, 2, -1], [-1, 2, 2]]) / 3,
    np.array([[2, 3, 6], [3, -6, 2], [6, 2, -3]]) / 7,
    np.array([[1, 8, 4], [8, 1, -4], [4, -4, 7]]) @ np.diag([1, 1, -1]) / 9,
)
"""Rotation matrices whose columns are such unit vectors."""
_SIDE_BY_SIDE = 12
"""So many are drawn for the probes with several contacts; `_several` divides them up."""


@dataclass(frozen=True)
class Probe:
    """One input. arguments: plain data, by position. group: what kind of case. note: the case in words, or nothing.

    usual: what happens every day. edge: a limit, such as touching exactly or no velocity. many: several contacts
    in one call. refused: bad input, for which the function's description promises an error.
    """

    arguments: Arguments
    group: Group = "usual"
    note: str = ""


@dataclass
class Draw:
    """Random plain numbers, few digits each, so that a person can follow a probe by hand."""

    rng: np.random.Generator = field(repr=False)

    def number(self, low: float, high: float, digits: int = 2) -> float:
        """A number of so many digits after the point."""
        return round(float(self.rng.uniform(low, high)), digits)

    def vector(self, size: float = 5.0) -> Array:
        """Three components up to a size, none of them zero."""
        return np.array([self.number(0.1, size) * self.sign() for _ in range(3)])

    def sign(self) -> int:
        """1 or −1."""
        return 1 if self.rng.integers(2) else -1  # choice takes four times as long, and thousands are drawn

    def unit(self) -> Array:
        """A unit vector, along no axis."""
        *parts, length = _LENGTHS[self.rng.integers(len(_LENGTHS) - 1)]
        return np.asarray(self.rng.permutation(parts) * self.rng.choice([-1, 1], 3) / length)

    def turn(self) -> Array:
        """A rotation matrix."""
        turn = _TURNS[self.rng.integers(len(_TURNS))]
        return np.asarray(turn * np.linalg.det(turn).round())

    def tangent(self, normal: Array, size: float = 5.0) -> Array:
        """A vector at right angles to a normal."""
        free = self.vector(size)
        return np.asarray(free - (free @ normal) * normal)

    def inverse_inertia(self) -> Array:
        """The inverse inertia of a body that is not aligned with the axes, in the world frame, 1/(kg m²)."""
        turn = self.turn()
        matrix = turn @ np.diag([self.number(0.5, 4) for _ in range(3)]) @ turn.T
        return np.asarray((matrix + matrix.T).round(2) / 2)  # symmetric to the last digit

    def body(self, speed: float = 3.0) -> Arguments:
        """Velocity, angular velocity, arm, inverse mass and inverse inertia of a body that can move."""
        return self.vector(speed), self.vector(2), self.vector(1), self.number(0.2, 2), self.inverse_inertia()


Maker = Callable[[Draw], Arguments]


def usual(note: str, *arguments: Any) -> Probe:
    """A case made by hand."""
    return Probe(_plain(arguments), "usual", note)


def edge(note: str, *arguments: Any) -> Probe:
    """A limiting case made by hand."""
    return Probe(_plain(arguments), "edge", note)


def refused(note: str, *arguments: Any) -> Probe:
    """Bad input made by hand."""
    return Probe(_plain(arguments), "refused", note)


def made(name: str, by_hand: Sequence[Probe], maker: Maker, count: int = 20, single: Sequence[int] = ()) -> list[Probe]:
    """All probes of a function: those by hand, drawn ones, and several drawn at once.

    single: the places of the arguments that are the same for all contacts of one call, such as a number of sweeps; all
    places of a function that takes one case alone.
    """
    draw = Draw(np.random.default_rng(zlib.crc32(name.encode())))
    drawn = [Probe(_plain(maker(draw))) for _ in range(count)]
    good = [probe for probe in by_hand if probe.group != "refused"]
    many = _several([_plain(maker(draw)) for _ in range(_SIDE_BY_SIDE)], frozenset(single))
    return [
        *(probe for probe in good if probe.group == "usual"),
        *drawn,
        *(probe for probe in good if probe.group == "edge"),
        *(probe for probe in good if probe.group == "many"),
        *many,
        *(probe for probe in by_hand if probe.group == "refused"),
    ]


def _several(draws: list[Arguments], single: frozenset[int]) -> list[Probe]:
    """Drawn arguments side by side, in every way in which a call may combine them."""
    every = range(len(draws[0]))
    if single.issuperset(every):
        return []
    first = next(place for place in every if place not in single)
    last = next(place for place in reversed(every) if place not in single)
    found = [
        Probe(_stacked(draws[:4], single), "many", "four at once"),
        # As many contacts as components: an axis forgotten gives wrong numbers here and an error elsewhere.
        Probe(_stacked(draws[4:7], single), "many", "three at once"),
        Probe(_stacked(draws[:1], single), "many", "an array of one"),
    ]
    for place in {first, last} if first != last else ():
        alone = "the first argument" if place == first else "the last argument"
        found.append(Probe(_stacked(draws[7:9], single | {place}), "many", f"two at once, {alone} the same for both"))
    columns, rows = _stacked(draws[9:11], single), _stacked(draws[7:10], single)
    grid = tuple(_each(columns[place], _as_column) if place == first else rows[place] for place in every)
    if first not in single and first != last:
        found.append(Probe(grid, "many", "a table of two by three"))
    return found


def _stacked(draws: list[Arguments], single: frozenset[int]) -> Arguments:
    return tuple(draws[0][i] if i in single else _stack([draw[i] for draw in draws]) for i in range(len(draws[0])))


def _stack(values: list[Any]) -> Any:
    if isinstance(values[0], tuple):
        return tuple(_stack([value[i] for value in values]) for i in range(len(values[0])))
    return np.stack([_array(value) for value in values])


def _as_column(value: Any) -> Any:
    return value[:, None]


def _each(value: Any, change: Callable[[Any], Any]) -> Any:
    return tuple(_each(item, change) for item in value) if isinstance(value, tuple) else change(value)


def _plain(value: Any) -> Any:
    """Lists of numbers as arrays of floats, and of flags as arrays of flags; the rest, such as faces, as it is."""
    if isinstance(value, tuple):
        return tuple(_plain(item) for item in value)
    if isinstance(value, np.ndarray) and value.dtype.kind in "iu":
        return value
    return _array(value) if isinstance(value, list | np.ndarray) else value


def _array(value: Any) -> NDArray[Any]:
    """Numbers as floats, and flags as flags: a function may say `~behind`, which no float allows."""
    array = np.asarray(value)
    return array if array.dtype == bool else np.asarray(value, dtype=float)
