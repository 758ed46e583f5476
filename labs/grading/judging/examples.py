"""Draws examples with a seed from the submission's text: the same file gets the same examples whenever it is graded.

Numbers are drawn quickly, without hypothesis. If an example fails, hypothesis looks for the smallest one that does.
"""

from __future__ import annotations

import inspect
import itertools
import math
import tempfile
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, cast

import numpy as np

from labs.grading.diagnosis.fingerprints.building import right_answer
from labs.grading.diagnosis.output_names import axes_before
from labs.grading.diagnosis.probes.probe import Draw, Maker, Probe, made
from labs.grading.diagnosis.words import called
from labs.grading.errors import FunctionRaised
from labs.grading.judging.comparison import Called, Formula, check, each, outputs_of, refuse_changes
from labs.grading.phrases import without_explanation
from reference.arrays import Array

COUNT = 8
"""Examples per part. A mistake that shows in fewer than one of so many is a limiting case, with a part of its own."""
MOST, MOST_CALLS = 50, 200
"""Examples that hypothesis may try until one fails, and calls in all while it makes that one smaller."""
_TIDY_DIGITS = 9
"""Digits after the point that are shown of an example; further ones are rounding."""
Check = Callable[..., None]


@dataclass(frozen=True)
class Examples:
    """Draws examples for one test. seed: of the submission's text. shown: whether a student sees one that failed."""

    seed: int
    shown: bool = True

    def agree(self, function: Called, formula: Formula, maker: Maker, count: int = COUNT, far: int = 0) -> None:
        """Require that the function agrees with the formula for one contact, one example after another.

        far: so many more, of which each vector is as long as others, ten or a hundred times as long.
        """

        def agrees(*arguments: Any) -> None:
            check(
                function, arguments, partial(right_answer, formula, Probe(arguments)), outputs_of(formula(*arguments))
            )

        drawn = self._drawn(maker, count) + self._drawn(lambda draw: maker(_FarDraw(draw.rng)), far)
        function.foresee(drawn)
        self._every(maker, drawn, agrees, agrees)

    def together(self, function: Called, formula: Formula, maker: Maker, single: Sequence[int] = ()) -> None:
        """Require the right answer for several contacts in one call, and that no argument is written to.

        The contacts are put side by side in every way in which arguments may be combined. single: the places of the
        arguments that all contacts of a call share.
        """
        name = f"{function.name} {self.seed}"
        sample = maker(Draw(np.random.default_rng(0)))
        probes = made(name, (), maker, 0, single)
        function.foresee([probe.arguments for probe in probes])
        for probe in probes:
            for_many = each(formula, sample, axes_before(function.name))
            right, outputs = partial(right_answer, for_many, probe), outputs_of(for_many(*probe.arguments))
            check(function, probe.arguments, right, outputs, repeated=True)
            refuse_changes(function)

    def every(self, maker: Maker, holds: Check, count: int = COUNT) -> None:
        """Require a property: `holds(*arguments)` raises an AssertionError if it does not hold.

        Raises
        ------
        AssertionError
            With the words of that error, and the smallest example that was found.
        """

        def explained(*arguments: Any) -> None:
            names, tidy = list(inspect.signature(holds).parameters), _tidy(arguments)
            for tried in (tidy, arguments):
                try:
                    holds(*tried)
                except AssertionError as error:
                    words, example = without_explanation(str(error)), called(names, tidy)
                    raise AssertionError(words if f"({example})" in words else f"{words}\nfor {example}") from None

        self._every(maker, self._drawn(maker, count), holds, explained)

    def _drawn(self, maker: Maker, count: int) -> list[tuple[Any, ...]]:
        draw = Draw(np.random.default_rng(self.seed))
        return [maker(draw) for _ in range(count)]

    def _every(self, maker: Maker, drawn: list[tuple[Any, ...]], holds: Check, explained: Check) -> None:
        """Try all examples. explained: raises the error for the student, on the smallest example that fails."""
        for arguments in drawn:
            try:
                holds(*arguments)
            except (AssertionError, FunctionRaised):
                explained(*(self._smallest(maker, holds) or arguments) if self.shown else arguments)
                raise  # `explained` should have raised: the function does not always give the same answer

    def _smallest(self, maker: Maker, holds: Check) -> tuple[Any, ...] | None:
        """The smallest arguments that hypothesis finds for which it does not hold; None if it finds none."""
        import hypothesis  # noqa: PLC0415 - takes as long to load as NumPy, and a right submission never needs it
        from hypothesis import configuration  # noqa: PLC0415
        from hypothesis import strategies as st  # noqa: PLC0415

        failing: list[tuple[Any, ...]] = []
        tries, once = itertools.count(), Chosen(())
        maker(_drawing(once))
        whole = st.lists(st.integers(0, Chosen.MOST), min_size=once.taken, max_size=once.taken)

        @hypothesis.seed(self.seed)
        @hypothesis.settings(
            max_examples=MOST,
            database=None,
            deadline=None,
            derandomize=False,
            phases=(hypothesis.Phase.generate, hypothesis.Phase.shrink),
            report_multiple_bugs=False,
            suppress_health_check=list(hypothesis.HealthCheck),
        )
        @hypothesis.given(whole)
        def search(choices: list[int]) -> None:
            if next(tries) > MOST_CALLS:
                return
            arguments = maker(_drawing(Chosen(choices)))
            try:
                holds(*arguments)
            except (AssertionError, FunctionRaised):
                failing.append(arguments)
                raise AssertionError from None

        with tempfile.TemporaryDirectory() as notes, warnings.catch_warnings():
            warnings.simplefilter("ignore")
            configuration.set_hypothesis_home_dir(notes)  # and not the folder of the notebook that is checked
            try:
                search()
            except Exception:  # hypothesis reports it in several ways; the last example that failed is the smallest
                return failing[-1] if failing else None
            finally:
                configuration.set_hypothesis_home_dir(None)
        return None


def _tidy(value: Any) -> Any:
    """A value without digits that are only rounding."""
    if isinstance(value, tuple):
        return tuple(map(_tidy, value))
    rounds = isinstance(value, float) or (isinstance(value, np.ndarray) and value.dtype.kind == "f")
    return np.round(value, _TIDY_DIGITS) if rounds else value


def _drawing(chosen: Chosen) -> Draw:
    return _SimpleDraw(cast(np.random.Generator, chosen))


class _SimpleDraw(Draw):
    def sign(self) -> int:
        """1 or −1; 1 is the simpler one."""
        return int(self.rng.choice([-1, 1]))


class _FarDraw(Draw):
    def vector(self, size: float = 5.0) -> Array:
        """Three components up to a hundred times a size: what is right for a metre may be wrong for ten."""
        return super().vector(size) * float(self.rng.choice([1, 10, 100]))


class Chosen:
    """Stands in for the random generator of `Draw`, and takes its choices from whole numbers; 0 is the simplest.

    Hypothesis chooses these numbers, and makes them smaller. taken: how many of them were used.
    """

    MOST = 1000

    def __init__(self, choices: Sequence[int]) -> None:
        self._choices, self.taken = iter(choices), 0

    def _next(self) -> int:
        self.taken += 1
        return next(self._choices, 0)

    def uniform(self, low: float = 0.0, high: float = 1.0) -> float:
        """A number: 1 or 0 if they are within the limits."""
        choice = self._next()
        if choice:
            return low + (high - low) * choice / self.MOST
        return next((simple for simple in (1.0, 0.0, float(math.ceil(low))) if low <= simple <= high), (low + high) / 2)

    def integers(self, count: int) -> int:
        """A whole number from 0 to below the count."""
        return self._next() % count

    def choice(self, options: Sequence[Any], size: int | None = None) -> Any:
        """One of the options, or an array of so many; the last of them is the simplest."""
        found = [options[-1 - self._next() % len(options)] for _ in range(size or 1)]
        return found[0] if size is None else np.array(found)

    def permutation(self, values: Sequence[Any]) -> Any:
        """The values in some order."""
        choice = self._next()
        return np.random.default_rng(choice).permutation(values) if choice else np.array(values)
