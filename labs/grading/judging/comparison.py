"""Compares what a submission's function returns with the right answer, in a test.

    def test_a_point_behind_the_plane_is_behind(submission, part):
        with part(1, "by more than the tolerance"):
            expect(submission.side_of_plane, (-2.0, 0.5), -1)

Vectors may be written as lists: the submission gets arrays, as in the lab. Any answer with the right numbers is
accepted, such as a list or single precision. `diagnosis.deviations` says how close is close enough.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, Protocol

import numpy as np

from labs.grading.calling.cases import OneCase, has_shape
from labs.grading.diagnosis.deviations import Answer, Right, deviation_of, outputs
from labs.grading.diagnosis.output_names import labelled, output_names, rows_of
from labs.grading.diagnosis.probes.one_case import one_case
from labs.grading.diagnosis.probes.probe import usual
from labs.grading.diagnosis.words import called, compared, shape_in_words, shown
from labs.grading.errors import ArgumentsChanged, FunctionRaised, WrongType
from labs.grading.judging.case_by_case import right_alone
from labs.grading.phrases import gives, no_answer
from reference.arrays import Array
from reference.errors import UnknownName

Formula = Callable[..., Any]


class Called(Protocol):
    """A function of a submission, as the fixture `submission` gives it."""

    name: str
    functions: Any

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
    check(function, plainly(*arguments), lambda: _sized(wanted, function.name), wanted)


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
    if it is the same for all contacts of a call, because it depends on no argument that differs. A function that is
    right for one case and fails for several is asked for one at a time (`case_by_case`).
    """

    def is_right(value: Any) -> bool:
        found = Answer(_repeated(value, wanted) if repeated else value)
        return deviation_of(found, _sized(wanted)).right or deviation_of(found, right()).right

    try:
        value = function(*arguments)
        if not is_right(value):
            found = Answer(_repeated(value, wanted) if repeated else value, printed=_printed(function))
            words = compared(found, right(), output_names(function.name))
            raise AssertionError(f"{_tried(function, arguments)}\n{words}")
    except (AssertionError, FunctionRaised, WrongType) as failure:
        if not right_alone(function, arguments, is_right, failure):
            raise


def _sized(outputs: tuple[Array, ...], function: str = "") -> Right:
    """The right answer of a function with the largest number of each output as its scale."""
    return Right(outputs, tuple(_size(array) for array in outputs), *rows_of(function))


def _repeated(value: Any, right: tuple[Array, ...]) -> Any:
    arrays = outputs(value, len(right))
    try:
        spread = tuple(np.broadcast_to(a, b.shape) for a, b in zip(arrays or (), right, strict=True))
    except ValueError:
        return value
    return spread if len(spread) > 1 else spread[0]


def numbers(function: Called, arguments: tuple[Any, ...], count: int = 1, finite: bool = True) -> Any:
    """Call a function for an array of floats, or for several; raises an AssertionError if it returns anything else.

    For a single case the arrays must have the shapes that the function promises, because arrays without numbers have
    almost any property. finite: whether NaN and infinity are refused, as a comparison can take two of them for equal.
    """
    value = function(*arguments)
    found = outputs(value, count)
    if found is None:
        raise AssertionError(f"{_tried(function, arguments)}\n{gives(no_answer(value, count, _printed(function)))}")
    came, wanted = labelled(list(map(shown, found)), output_names(function.name)), _wanted(function, arguments)
    if len(wanted) == count and not all(map(has_shape, found, wanted)):
        shapes, promised = (", ".join(map(shape_in_words, each)) for each in ([a.shape for a in found], wanted))
        raise AssertionError(f"{_tried(function, arguments)}\n{gives(came)} of shape {shapes} instead of {promised}")
    if finite and not all(np.isfinite(array).all() for array in found):
        raise AssertionError(f"{_tried(function, arguments)}\n{gives(came)}, where finite numbers should be")
    return found if count > 1 else found[0]


def _wanted(function: Called, arguments: tuple[Any, ...]) -> tuple[tuple[int | None, ...], ...]:
    """The shapes of what a function should return for one case; none where that is not known."""
    case = one_case(function.name)
    return case.wanted(arguments) if case else ()


def _tried(function: Called, arguments: tuple[Any, ...]) -> str:
    return called(_parameters(function.name), arguments, function.name)


def _printed(function: Any) -> str:
    """What the function's last call printed."""
    return str(function.functions.process().printed)


def refuse_changes(function: Any) -> None:
    """Raise ArgumentsChanged if the last call has written into its arguments."""
    if function.functions.process().changed:
        raise ArgumentsChanged(f"{function.name} {ArgumentsChanged.gist}")


def plainly(*arguments: Any) -> tuple[Any, ...]:
    """Arguments as a submission gets them: lists become arrays of floats or of flags, also in tuples."""
    return usual("", *arguments).arguments


def each(formula: Formula, sample: tuple[Any, ...], before: int = 0) -> Formula:
    """Make a formula for one contact work for many; the shapes of the `sample` of arguments say what one contact is.

    before: how many axes of what it returns come before those of the contacts.
    """
    outputs = formula(*sample)
    case = OneCase(_axes(sample), len(outputs) if isinstance(outputs, tuple) else 1, before)
    return lambda *arguments: case.one_by_one(formula, arguments)


def _axes(sample: Any) -> tuple[Any, ...]:
    return tuple(_axes(part) if isinstance(part, tuple) else np.ndim(part) for part in sample)


def _size(array: Any) -> float:
    return float(np.max(np.abs(array[np.isfinite(array)]), initial=0.0)) or 1.0


def _parameters(function: str) -> tuple[str, ...]:
    from labs.grading.diagnosis.fingerprints.reading import known  # noqa: PLC0415 - only a failure needs the names

    try:
        return known(function).parameters
    except UnknownName:
        return ()  # of a function that has no fingerprints yet
