"""What can be moved in a family: its parameters, and the points of a grid at which engines are recorded.

An engine that runs takes any value within a parameter's range. An engine that is recorded has results at the points of
the grid alone; `nearest` moves the wanted values to the nearest point and says so in words.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

from reference import checks
from reference.catalogue.case import Case
from reference.errors import InvalidInput, UnknownName

TENTHS = tuple(tenth / 10 for tenth in range(11))
"""0, 0.1, … 1."""


@dataclass(frozen=True)
class Parameter:
    """One number that can be moved.

    values: those of the grid, increasing, in `unit`; the first and the last are the range. default: the value if none
    is given. whole: whether only whole numbers make sense. in_ratio: whether "near" means a ratio near 1.
    """

    name: str
    unit: str
    values: tuple[float, ...]
    default: float
    whole: bool = False
    in_ratio: bool = False

    def check(self, value: float) -> float:
        """Return the value as a number; refuse one out of range, and a fraction where only whole numbers make sense."""
        number, (least, *_, most) = checks.finite(self.name, value), self.values
        # An end of the range may be typed as it is printed, with six digits
        number = next((end for end in (least, most) if math.isclose(number, end, rel_tol=1e-5)), number)
        if not least <= number <= most or (self.whole and not number.is_integer()):
            kind = "a whole number" if self.whole else "a number"
            raise InvalidInput(
                f"{self.name} is {value}; it must be {kind} from {self.said(least)} to {self.said(most)}"
            )
        return number

    def nearest(self, value: float) -> float:
        """The nearest value of the grid; of two that are equally near, the smaller one."""
        if self.in_ratio:
            return nearest_in_ratio(self.values, value)
        return min(self.values, key=lambda known: (round(abs(known - value), 9), known))

    def said(self, value: float) -> str:
        """The value with its unit."""
        return f"{value:g}{self.unit}" if self.unit == "°" else f"{value:g} {self.unit}".strip()


@dataclass(frozen=True)
class Grid:
    """The parameters of a family and the timesteps, s, that its recordings have beside each profile's own.

    The family's own cases are recorded at these timesteps as well, points of the grid or not. build: the parameters by
    name → the case.
    """

    parameters: tuple[Parameter, ...]
    timesteps: tuple[float, ...]
    build: Callable[..., Case]

    def case(self, **at: float) -> Case:
        """The case at these values, of the grid or not; a parameter that is not named has its default.

        Raises
        ------
        UnknownName
            If there is no such parameter.
        InvalidInput
            If a value is out of range.
        """
        return self.build(**self.full(at))

    def full(self, at: Mapping[str, float]) -> dict[str, float]:
        """All parameters in their order, checked, with defaults for those that are not named."""
        for name in at:
            if name not in self.names:
                raise UnknownName("parameter", name, self.names)
        return {each.name: each.check(at.get(each.name, each.default)) for each in self.parameters}

    @property
    def names(self) -> tuple[str, ...]:
        """What can be moved."""
        return tuple(parameter.name for parameter in self.parameters)

    @cached_property
    def cases(self) -> tuple[Case, ...]:
        """The case of every point of the grid."""
        points = itertools.product(*(parameter.values for parameter in self.parameters))
        return tuple(self.build(**dict(zip(self.names, point, strict=True))) for point in points)


@dataclass(frozen=True)
class Nearest:
    """A point of a grid.

    at: all parameters. timestep: s, None for a profile's own. moved: what had to be moved, in words, or "".
    """

    at: Mapping[str, float]
    timestep: float | None
    moved: str


def nearest(grid: Grid, at: Mapping[str, float], timestep: float | None = None) -> Nearest:
    """The point of a grid that is nearest to what is wanted: each value for itself, timesteps and masses in ratio.

    `moved` is such as `restitution 0.37 → 0.4, timestep 2 ms → 2 ms`: what moved, and the timestep if one is given.
    """
    full = grid.full(at)
    values = {each.name: each.nearest(full[each.name]) for each in grid.parameters}
    words = [
        f"{each.name} {each.said(full[each.name])} → {each.said(values[each.name])}"
        for each in grid.parameters
        if not math.isclose(full[each.name], values[each.name])
    ]
    if timestep is None:
        return Nearest(values, None, ", ".join(words))
    step = nearest_in_ratio(grid.timesteps, checks.positive("timestep", timestep))
    if words or not math.isclose(timestep, step):
        words.append(f"timestep {1e3 * timestep:g} ms → {1e3 * step:g} ms")
    return Nearest(values, step, ", ".join(words))


def nearest_in_ratio(known: Iterable[float], wanted: float) -> float:
    """The value whose ratio to the wanted one is nearest to 1; all are above zero."""
    return min(known, key=lambda each: abs(math.log(each / wanted)))
