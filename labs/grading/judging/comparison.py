"""Compares what a submission's function returns with the right answer, in a test.

    def test_a_ball_leaves_with_e_times_its_speed(submission, part):
        with part(1, "the direction and the speed"):
            expect(submission.rebound_velocity, (-2.0, 0.5), 1.0)

Vectors may be written as lists: the submission gets arrays, as in the lab. Any answer with the right numbers is
accepted, such as a list or single precision. `diagnosis.deviations` says how close is close enough.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any, Protocol

import numpy as np

from labs.grading.diagnosis.deviations import Answer, Right, deviation_of, outputs
from labs.grading.diagnosis.probes.probe import usual
from labs.grading.diagnosis.words import called, compared, shown
from labs.grading.phrases import gives, no_answer
from reference.arrays import Array
from reference.errors import UnknownName

Formula = Callable[..., Any]


class Called(Protocol):
    """A function of a submission, as the fixture `submission` gives it."""

    name: str

    def __call__(self, *arguments: Any) -> Any:
        """Call it in the test's process."""

    def foresee(self, several: Iterable[tuple[Any, ...]]) -> None:
        """Say which calls of it come next, so that its process can work ahead."""


def expect(function: Called, arguments: tuple[Any, ...], answer: Any) -> None:
    """Call a function and compare: `answer` is a number, a list, or a tuple of these if it returns several things.

    Raises
    ------
    AssertionError
        If the answer is another. The message has the call, its answer, and what physics says.
    """
    wanted = outputs_of(answer)
    check(function, plainly(*arguments), lambda: _sized(wanted), wanted)


def outputs_of(answer: Any) -> tuple[Array, ...]:
    """The right answer as arrays of floats, one for each thing returned."""
    return tuple(np.asarray(part, dtype=float) for part in (answer if isinstance(answer, tuple) else (answer,)))


def check(
    function: Called,
    arguments: tuple[Any, ...],
    right: Callable[[], Right],
    wanted: tuple[Array, ...],
    repeated: bool = False,
) -> None:
    """Call a function and compare, with scales that may be larger than the right numbers themselves.

    wanted: the right numbers. right: gives them with the scales by which they are compared; it is called only if they
    are not met within their own size, because finding scales takes time. repeated: whether an output may be given once
    if it is the same for all contacts of a call, because it depends on no argument that differs.
    """
    value = function(*arguments)
    found = Answer(_repeated(value, wanted) if repeated else value)
    if not deviation_of(found, _sized(wanted)).right and not deviation_of(found, known := right()).right:
        found = replace(found, printed=_printed(function))
        raise AssertionError(f"{_tried(function, arguments)}\n{compared(found, known)}")


def _sized(outputs: tuple[Array, ...]) -> Right:
    """The right answer with the largest number of each output as its scale."""
    return Right(outputs, tuple(_size(array) for array in outputs))


def _repeated(value: Any, right: tuple[Array, ...]) -> Any:
    arrays = outputs(value, len(right))
    try:
        spread = tuple(np.broadcast_to(a, b.shape) for a, b in zip(arrays or (), right, strict=True))
    except ValueError:
        return value
    return spread if len(spread) > 1 else spread[0]


def numbers(function: Called, arguments: tuple[Any, ...], count: int = 1) -> Any:
    """Call a function for an array of floats, or for several; raises an AssertionError if it returns anything else.

    NaN and infinity are refused, because a comparison can take two of them for equal.
    """
    value = function(*arguments)
    found = outputs(value, count)
    if found is None:
        raise AssertionError(f"{_tried(function, arguments)}\n{gives(no_answer(value, count, _printed(function)))}")
    if not all(np.isfinite(array).all() for array in (found if count > 1 else found[:1])):
        came = ", ".join(map(shown, found))
        raise AssertionError(f"{_tried(function, arguments)}\n{gives(came)}, where finite numbers should be")
    return found if count > 1 else found[0]


def _tried(function: Called, arguments: tuple[Any, ...]) -> str:
    return called(_parameters(function.name), arguments, function.name)


def _printed(function: Any) -> str:
    """What the function's last call printed."""
    return str(function.functions.process().printed)


def refuse_changes(function: Any) -> None:
    """Raise an AssertionError if the last call has written into its arguments."""
    if function.functions.process().changed:
        raise AssertionError(
            f"{function.name} writes into its arguments, as a += b and a[0] = b do: the caller's arrays change"
        )


def plainly(*arguments: Any) -> tuple[Any, ...]:
    """Arguments as a submission gets them: lists become arrays of floats, also in tuples; the rest stays as it is."""
    return usual("", *arguments).arguments


def each(formula: Formula, sample: tuple[Any, ...]) -> Formula:
    """Make a formula for one contact work for many; the shapes of the `sample` of arguments say what one contact is."""
    depths = [np.ndim(part) for part in _leaves(sample)]

    def for_many(*arguments: Any) -> Any:
        leaves = [np.asarray(part) for part in _leaves(arguments)]
        several = [leaf.shape[: leaf.ndim - depth] for leaf, depth in zip(leaves, depths, strict=True)]
        shape = np.broadcast_shapes(*several)
        spread = [
            np.broadcast_to(leaf, shape + leaf.shape[leaf.ndim - depth :])
            for leaf, depth in zip(leaves, depths, strict=True)
        ]
        answers = [formula(*_as_in(sample, iter([leaf[place] for leaf in spread]))) for place in np.ndindex(shape)]
        if not isinstance(answers[0], tuple):
            return _side_by_side(answers, shape)
        return tuple(_side_by_side(part, shape) for part in zip(*answers, strict=True))

    return for_many


def _side_by_side(answers: Any, shape: tuple[int, ...]) -> Any:
    stacked = np.stack([np.asarray(answer, dtype=float) for answer in answers])
    return stacked.reshape(shape + stacked.shape[1:])


def _leaves(value: Any) -> list[Any]:
    return [leaf for part in value for leaf in _leaves(part)] if isinstance(value, tuple) else [value]


def _as_in(sample: Any, leaves: Any) -> Any:
    if isinstance(sample, tuple):
        return tuple(_as_in(part, leaves) for part in sample)
    leaf = next(leaves)
    return leaf if isinstance(sample, np.ndarray) else leaf.item()


def _size(array: Any) -> float:
    return float(np.max(np.abs(array[np.isfinite(array)]), initial=0.0)) or 1.0


def _parameters(function: str) -> tuple[str, ...]:
    from labs.grading.diagnosis.fingerprints.reading import known  # noqa: PLC0415 - only a failure needs the names

    try:
        return known(function).parameters
    except UnknownName:
        return ()  # of a function that has no fingerprints yet
