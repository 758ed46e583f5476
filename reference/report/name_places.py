"""Where the names of curves fit into a picture: beside their own curve, and clear of the others and of one another.

Everything is in points from the lower left corner of the picture.
"""

from __future__ import annotations

import itertools
import textwrap
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from reference.arrays import Array

LETTERS = 8.0
"""Size of the text."""
_NEAR = 9.0
"""A name that is farther than this from its curve needs a line that leads there, and so does one nearer to another."""
_WIDTH, _HEIGHT, _GAP = 0.55, 1.2, 1.5
"""Width of a letter and height of a line of text, as shares of its size; the least gap around a name."""
_MOST_LINES = 3
_TOUCHING = 1.5
"""Curves that are this near are crossed."""
_FAR, _SHARE, _ALONE = 25.0, 0.4, 6.0
"""Distance from other curves is good up to the first, and counts by the second against distance from the own curve. A
curve counts as alone from the third on."""
_LINE, _LEADER, _CROSSING = 4.0, 15.0, 15.0
"""What a line of text costs, a line that leads to the curve, and one that crosses others on its way."""
_MOST = 500
"""Places of a name that are compared; all others are worse."""
_MOST_IN_TURN = 6
"""So many names are tried in every order, 720 of them; more are placed in the order in which they come."""
_ELSEWHERE = 1e4
"""Outside of every picture: a point of no curve, where there is only one."""
_ACROSS, _UP = 5.0, 0.5
"""How far apart the places are that are tried."""

Box = tuple[float, float, float, float]
"""Left, bottom, right and top."""


@dataclass(frozen=True)
class Place:
    """Where a name may be written.

    cost: how much worse it is than other places. point: of its curve, to which a line leads if `led`.
    """

    text: str
    box: Box
    cost: float
    point: Array
    led: bool

    @property
    def start(self) -> Array:
        """Where a line to the point begins."""
        return np.clip(self.point, self.box[:2], self.box[2:])

    def overlaps(self, other: Place) -> bool:
        """Whether two names would run into each other."""
        (left, bottom, right, top), (left_2, bottom_2, right_2, top_2) = self.box, other.box
        return left < right_2 + _GAP and left_2 < right + _GAP and bottom < top_2 and bottom_2 < top


def placed(area: Box, names: Sequence[str], curves: Sequence[Array]) -> list[Place | None]:
    """The places for the names of these curves that are best together; None for a name that fits nowhere."""
    choices = []
    for number, name in enumerate(names):
        others = np.concatenate([*curves[:number], *curves[number + 1 :], np.full((1, 2), -_ELSEWHERE)])
        choices.append(_places(area, name, curves[number], others))
    orders = itertools.permutations(range(len(names))) if len(names) <= _MOST_IN_TURN else [range(len(names))]
    tried = [_in_turn(order, choices) for order in orders]
    best = min(tried, key=lambda found: (-len(found), sum(place.cost for place in found.values())))
    return [best.get(number) for number in range(len(names))]


def _in_turn(order: Sequence[int], choices: Sequence[Sequence[Place]]) -> dict[int, Place]:
    """For each name in turn, the best place that those before it have left free."""
    found: dict[int, Place] = {}
    for number in order:
        free = (place for place in choices[number] if not any(place.overlaps(taken) for taken in found.values()))
        if best := next(free, None):
            found[number] = best
    return found


def _places(area: Box, name: str, mine: Array, others: Array) -> list[Place]:
    """Where no curve runs through the name, the best first: near its curve where that is alone, far from others."""
    alone = np.hypot(*np.moveaxis(mine[:, None] - others, -1, 0)).min(axis=1)
    named = mine[alone >= min(_ALONE, 0.7 * alone.max())]
    every = np.concatenate([mine, others])
    found = []
    for lines in _wrapped(name):
        width, height = LETTERS * _WIDTH * max(map(len, lines)), LETTERS * (1 + _HEIGHT * (len(lines) - 1))
        for left in np.arange(area[0], area[2] - width, _ACROSS).tolist():
            bottoms = np.arange(area[1], area[3] - height, _UP)
            boxes = np.stack([np.full_like(bottoms, it) for it in (left, 0.0, left + width, 0.0)], axis=1)
            boxes[:, 1], boxes[:, 3] = bottoms, bottoms + height
            boxes = boxes[_are_free(boxes, every)]
            if not len(boxes):
                continue
            from_others, from_own = _distances(boxes, others).min(axis=1), _distances(boxes, named)
            own, nearest = from_own.min(axis=1), named[from_own.argmin(axis=1)]
            led = own > np.minimum(_NEAR, from_others)
            costs = own + _LINE * len(lines) - _SHARE * np.minimum(from_others, _FAR) + _LEADER * led
            for box, cost, point, leads in zip(boxes, costs.tolist(), nearest, led.tolist(), strict=True):
                found.append(Place("\n".join(lines), tuple(box.tolist()), cost, point, leads))
    found = sorted(found, key=lambda place: place.cost)[:_MOST]
    crossing = [_CROSSING if place.led and _crosses(place, others) else 0.0 for place in found]
    dearer = [replace(place, cost=place.cost + more) for place, more in zip(found, crossing, strict=True)]
    return sorted(dearer, key=lambda place: place.cost)


def _are_free(boxes: Array, points: Array) -> Array:
    """Which of some boxes, one above the other, no point is in or near."""
    left, _, right, _ = boxes[0]
    heights = np.sort(points[(points[:, 0] > left - _GAP) & (points[:, 0] < right + _GAP), 1])
    below = np.searchsorted(heights, boxes[:, 1] - _GAP)
    return np.asarray(below == np.searchsorted(heights, boxes[:, 3] + _GAP))


def _crosses(place: Place, others: Array) -> bool:
    """Whether the straight way from a name to its curve crosses other curves."""
    way = np.linspace(place.start, place.point, 12)[:-1, None]
    return bool((np.hypot(*np.moveaxis(others - way, -1, 0)) < _TOUCHING).any())


def _wrapped(name: str) -> Iterator[list[str]]:
    """A name in one line, in two and in three, each time as narrow as it goes."""
    for most in range(1, _MOST_LINES + 1):
        broken = (textwrap.wrap(name, letters) for letters in range(len(name) // most, len(name) + 1))
        yield next(lines for lines in broken if len(lines) <= most)


def _distances(boxes: Array, points: Array) -> Array:
    """How far each point is from each box; 0 within it."""
    left, bottom, right, top = (boxes[:, [side]] for side in range(4))
    across = np.maximum(np.maximum(left - points[:, 0], points[:, 0] - right), 0.0)
    up = np.maximum(np.maximum(bottom - points[:, 1], points[:, 1] - top), 0.0)
    return np.asarray(np.hypot(across, up))
