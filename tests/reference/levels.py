"""To which level of the tests the points of a grid belong."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import Any

import pytest


def in_turn(names: Sequence[str], points: Sequence[tuple[Any, ...]], fast: Sequence[tuple[Any, ...]] = ()) -> list[Any]:
    """Every point in every engine, as (name, *point): all engines take turns in `make verify`.

    There each point is run by one engine, and each engine runs some points. A fault of a point or of an engine shows in
    such a row as well as in the whole table, which `make weekly` runs. What is in `fast` has no mark.
    """
    grid = [(name, *point) for name, point in itertools.product(names, points)]
    turns = {(names[place % len(names)], *point) for place, point in enumerate(points)}
    marks = {True: pytest.mark.slow, False: pytest.mark.weekly}
    return [entry if entry in fast else pytest.param(*entry, marks=marks[entry in turns]) for entry in grid]
