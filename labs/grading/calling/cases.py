"""One case and several: a call with many contacts as a call for each contact, and their answers put together again.

Some functions are right for one contact and fail for many. Here they are asked one contact at a time, so that they
are judged by their physics. What a function takes for one contact is said by `OneCase`; nothing here knows an answer.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from reference.arrays import Array


class AsLongAs(NamedTuple):
    """The length of an axis of an argument: the one at a place among all arguments, those of a tuple one by one."""

    place: int
    axis: int


Length = int | AsLongAs | None
"""Of an axis of an answer: None if it differs from case to case and no argument says what it is."""


@dataclass(frozen=True)
class OneCase:
    """What a function takes and gives for a single contact.

    axes: how many axes each argument has, by position; of a tuple, such as a body, how many each part has. Arguments
    further on are numbers. outputs: how many things the function returns. before: how many axes of each of these come
    before those of the contacts, such as the steps of a run. shapes: of these things, as far as they are known.
    """

    axes: tuple[Any, ...]
    outputs: int = 1
    before: int = 0
    shapes: tuple[tuple[Length, ...], ...] = ()

    def leading(self, arguments: tuple[Any, ...]) -> tuple[int, ...]:
        """The axes along which the contacts of a call lie; none for a single contact.

        Raises
        ------
        ValueError
            If the arguments do not fit together.
        """
        return np.broadcast_shapes(*(_lead(value, axes) for value, axes in self._leaves(arguments)))

    def leaves(self, arguments: tuple[Any, ...]) -> list[Any]:
        """All arguments, those of a tuple one by one."""
        return [value for value, _ in self._leaves(arguments)]

    def wanted(self, arguments: tuple[Any, ...]) -> tuple[tuple[int | None, ...], ...]:
        """The shapes of what the function should return for these arguments; none if they are several cases.

        None in a shape stands for any length.
        """
        try:
            if self.leading(arguments):
                return ()
            given = [np.shape(value) for value in self.leaves(arguments)]
        except ValueError:
            return ()
        return tuple(
            tuple(given[each.place][each.axis] if isinstance(each, AsLongAs) else each for each in shape)
            for shape in self.shapes
        )

    def one_by_one(self, function: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
        """Call a function once for each contact, and put the answers side by side.

        Raises
        ------
        ValueError
            If there is no contact, or if the answers have different shapes or are not as many things as `outputs`.
        """
        shape = self.leading(arguments)
        answers = [
            function(*self._with(arguments, lambda value, axes, at=at: _picked(value, axes, shape, at)))  # type: ignore[misc]
            for at in np.ndindex(shape)
        ]
        return self._joined(answers, shape)

    def in_rows(self, function: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
        """Call a function once, with every argument given for every contact and all contacts along one axis.

        How arguments of different leading axes combine is a matter of taste; rows of the same length are not. Whole
        numbers and flags are given as they are: they are shared by all contacts.
        """
        shape = self.leading(arguments)
        value = function(*self._with(arguments, lambda value, axes: _row(value, axes, shape)))
        parts = [value] if self.outputs == 1 else list(value)
        unrolled = tuple(self._unrolled(np.asarray(part), shape) for part in parts)
        return unrolled[0] if self.outputs == 1 else unrolled

    def _unrolled(self, part: Array, shape: tuple[int, ...]) -> Array:
        return part.reshape(part.shape[: self.before] + shape + part.shape[self.before + 1 :])

    def _axes_of(self, place: int) -> Any:
        return self.axes[place] if place < len(self.axes) else 0

    def _leaves(self, arguments: tuple[Any, ...]) -> Iterator[tuple[Any, int]]:
        for place, value in enumerate(arguments):
            axes = self._axes_of(place)
            yield from zip(value, axes, strict=False) if _is_group(value, axes) else ((value, axes),)

    def _with(self, arguments: tuple[Any, ...], change: Callable[[Any, int], Any]) -> tuple[Any, ...]:
        """The arguments with every array changed."""
        found = []
        for place, value in enumerate(arguments):
            axes = self._axes_of(place)
            grouped = _is_group(value, axes)
            found.append(tuple(map(change, value, axes)) if grouped else change(value, axes))
        return tuple(found)

    def _joined(self, answers: Sequence[Any], shape: tuple[int, ...]) -> Any:
        if not answers:
            raise ValueError("there is no contact")
        if self.outputs == 1:
            return self._side_by_side(answers, shape)
        if any(not isinstance(answer, list | tuple | np.ndarray) or len(answer) != self.outputs for answer in answers):
            raise ValueError(f"an answer is not {self.outputs} things")
        return tuple(self._side_by_side([answer[at] for answer in answers], shape) for at in range(self.outputs))

    def _side_by_side(self, answers: Sequence[Any], shape: tuple[int, ...]) -> Array:
        stacked = np.stack([np.asarray(answer) for answer in answers])
        found = stacked.reshape(shape + stacked.shape[1:])
        if not self.before:
            return found
        return np.moveaxis(found, range(len(shape)), range(self.before, self.before + len(shape)))


def has_shape(answer: Array, shape: tuple[int | None, ...]) -> bool:
    """Whether an answer has a shape; an empty list says nothing of the rows that it might have had."""
    if answer.shape == (0,) and None in shape:
        return True
    return answer.ndim == len(shape) and all(map(lambda has, wanted: wanted in (None, has), answer.shape, shape))


def _is_group(value: Any, axes: Any) -> bool:
    """Whether an argument is several things, such as a body; a vector may be a tuple as well."""
    return isinstance(axes, tuple) and isinstance(value, tuple)


def _lead(value: Any, axes: Any) -> tuple[int, ...]:
    if isinstance(axes, tuple):  # several things that were not given
        return ()
    shape: tuple[int, ...] = np.shape(value)
    return shape[: max(0, len(shape) - axes)]


def _picked(value: Any, axes: int, shape: tuple[int, ...], at: tuple[int, ...]) -> Any:
    """What belongs to one contact, as a test of a single contact gives it: a number of Python, or an array."""
    if not _lead(value, axes):
        return value
    found = _spread(value, axes, shape)[at]
    return found.copy() if axes else found.item()


def _row(value: Any, axes: int, shape: tuple[int, ...]) -> Any:
    if np.ndim(value) < axes or isinstance(value, bool | int):
        return value
    spread = _spread(value, axes, shape)
    return spread.reshape(-1, *spread.shape[len(shape) :]).copy()


def _spread(value: Any, axes: int, shape: tuple[int, ...]) -> Array:
    array = np.asarray(value)
    return np.broadcast_to(array, shape + array.shape[array.ndim - axes :])
