"""Examples that are drawn from the submission's text: the same file meets the same ones whenever it is graded.

Numbers are drawn quickly, without hypothesis; where one fails, hypothesis looks for the smallest example that does.
"""

from __future__ import annotations

import inspect
import itertools
import math
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, cast

import numpy as np

from labs.grading.diagnosis.fingerprints.building import right_answer
from labs.grading.diagnosis.probes.probe import Draw, Maker, Probe, made
from labs.grading.diagnosis.words import called
from labs.grading.errors import FunctionRaised
from labs.grading.judging.comparison import Called, Formula, check, each, outputs_of, refuse_changes

COUNT = 8
"""Examples a part. A wrong formula that shows only in one of so many is a limiting case, and asked for by itself."""
MOST, MOST_CALLS = 50, 200
"""Examples that hypothesis may try to find one that fails, and calls in all until it is small enough."""
Check = Callable[..., None]


@dataclass(frozen=True)
class Examples:
    """What draws examples for one test. seed: of the submission's text. told: whether a student reads what failed."""

    seed: int
    told: bool = True

    def agree(self, function: Called, formula: Formula, maker: Maker, count: int = COUNT) -> None:
        """The function gives what the formula for one contact gives, one example after another."""

        def agrees(*arguments: Any) -> None:
            check(
                function, arguments, partial(right_answer, formula, Probe(arguments)), outputs_of(formula(*arguments))
            )

        drawn = self._drawn(maker, count)
        function.foresee(drawn)
        self._every(maker, drawn, agrees, agrees)

    def together(self, function: Called, formula: Formula, maker: Maker, single: Sequence[int] = ()) -> None:
        """Several contacts in one call, side by side in every way in which they may stand, and nothing written to.

        single: the places of the arguments that all contacts of a call share.
        """
        name = f"{function.name} {self.seed}"
        sample = maker(Draw(np.random.default_rng(0)))
        probes = made(name, (), maker, 0, single)
        function.foresee([probe.arguments for probe in probes])
        for probe in probes:
            for_many = each(formula, sample)
            right, outputs = partial(right_answer, for_many, probe), outputs_of(for_many(*probe.arguments))
            check(function, probe.arguments, right, outputs, repeated=True)
            refuse_changes(function)

    def every(self, maker: Maker, holds: Check, count: int = COUNT) -> None:
        """A property: `holds(*arguments)` raises an AssertionError where it does not hold.

        Raises
        ------
        AssertionError
            With what it said, and the smallest example that was found.
        """

        def told(*arguments: Any) -> None:
            names, tidy = list(inspect.signature(holds).parameters), _tidy(arguments)
            for tried in (tidy, arguments):
                try:
                    holds(*tried)
                except AssertionError as error:
                    words, example = _own_words(error), called(names, tidy)
                    raise AssertionError(words if f"({example})" in words else f"{words}\nfor {example}") from None

        self._every(maker, self._drawn(maker, count), holds, told)

    def _drawn(self, maker: Maker, count: int) -> list[tuple[Any, ...]]:
        draw = Draw(np.random.default_rng(self.seed))
        return [maker(draw) for _ in range(count)]

    def _every(self, maker: Maker, drawn: list[tuple[Any, ...]], holds: Check, told: Check) -> None:
        for arguments in drawn:
            try:
                holds(*arguments)
            except (AssertionError, FunctionRaised):
                told(*(self._smallest(maker, holds) or arguments) if self.told else arguments)
                raise  # told should have raised: the function does not always answer alike

    def _smallest(self, maker: Maker, holds: Check) -> tuple[Any, ...] | None:
        """The smallest arguments that hypothesis finds for which it does not hold; None where it finds none."""
        import hypothesis  # noqa: PLC0415 - takes as long to load as NumPy, and a right submission never needs it
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

        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                search()
        except Exception:  # what hypothesis says of it, in any of its ways; the last example tried is the smallest
            return failing[-1] if failing else None
        return None


def _own_words(error: AssertionError) -> str:
    """The message of an assertion without what pytest adds on how it came to be false."""
    lines = str(error).splitlines()
    added = [number for number, line in enumerate(lines) if number and line.startswith("assert ")]
    return "\n".join(lines[: added[0]] if added else lines)


def _tidy(value: Any) -> Any:
    """Without digits that are but rounding."""
    if isinstance(value, tuple):
        return tuple(map(_tidy, value))
    return np.round(value, 9) if isinstance(value, float | np.ndarray) else value


def _drawing(chosen: Chosen) -> Draw:
    return _SimpleDraw(cast(np.random.Generator, chosen))


class _SimpleDraw(Draw):
    def sign(self) -> int:
        """1 or −1; 1 is the simpler one."""
        return int(self.rng.choice([-1, 1]))


class Chosen:
    """What `Draw` asks of a random generator, made of whole numbers that hypothesis makes smaller; 0 is the simplest.

    taken: how many of them were asked for.
    """

    MOST = 1000

    def __init__(self, choices: Sequence[int]) -> None:
        self._choices, self.taken = iter(choices), 0

    def _next(self) -> int:
        self.taken += 1
        return next(self._choices, 0)

    def uniform(self, low: float = 0.0, high: float = 1.0) -> float:
        """A number: 1 or 0 where they will do."""
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
