"""Inputs that expose a wrong function: whether one does, and which of them a notebook holds."""

from __future__ import annotations

import contextlib
import importlib
import importlib.util
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from labs.assessment.contracts import Contract
from labs.assessment.written_inputs import inputs_in, refuse_other_than_numbers
from labs.grading.diagnosis.output_names import labelled, output_names
from labs.grading.submission.cells import read_cells
from reference import lecture
from reference.engines.implementation import Implementation
from reference.errors import InvalidInput, UnknownName

NEAR = 1e-9
"""Two answers that differ by no more than this, relative to the larger one, are the same: rounding."""


@dataclass(frozen=True)
class Suspect:
    """A wrong function. key: its name in the lab. function: which function it should be. contract: what both take."""

    key: str
    function: str
    wrong: Callable[..., Any]
    contract: Contract


@dataclass(frozen=True)
class Exposure:
    """The result of an input. exposed: whether the two answers differ. said: both answers in words."""

    exposed: bool
    said: str


def suspects(topic: str) -> tuple[Suspect, ...]:
    """The wrong functions of a lab; none where the lab has no such question."""
    name = f"labs.assessment.suspects.{lecture.topic(topic).name}"
    if importlib.util.find_spec(name) is None:
        return ()
    table = importlib.import_module(name).SUSPECTS
    return tuple(Suspect(key, *parts) for key, parts in table.items())


def suspect(topic: str, key: str) -> Suspect:
    """A lab's wrong function by its key; raises `UnknownName` if the lab has none of that name."""
    found = {each.key: each for each in suspects(topic)}
    if key not in found:
        raise UnknownName("wrong function", key, found)
    return found[key]


def tried(wrong: Suspect, arguments: Sequence[Any], right: Callable[..., Any]) -> Exposure:
    """Whether an input exposes a wrong function. right: a function that is right.

    Each of the two gets arrays of its own, so that neither sees what the other writes into them.

    Raises
    ------
    InvalidInput
        If it is no single case, or one of the two functions refuses it: then it says nothing about the mistake.
    """
    refuse_other_than_numbers(arguments)
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        try:
            needed = right(*wrong.contract.values(arguments))
            answer = _flat(needed)
        except NotImplementedError:
            raise InvalidInput(f"write {wrong.function} first: your colleague's is compared with it") from None
        except InvalidInput as error:
            raise _refused(wrong, str(error)) from None
        except Exception as error:
            raise _refused(wrong, f"{type(error).__name__}: {error}" if str(error) else type(error).__name__) from None
        try:
            theirs = wrong.wrong(*wrong.contract.values(arguments))
            given = _flat(theirs)
        except Exception as error:
            raise InvalidInput(
                f"your colleague's function ends in {type(error).__name__}: take another input"
            ) from None
    if _shapes(needed) != _shapes(theirs):
        raise InvalidInput(
            f"{wrong.function} gives something of the shape {_shapes(needed)}, and one case has {_shapes(theirs)}:"
            f' lab.check("{wrong.function}") says more'
        )
    if np.allclose(given, answer, rtol=NEAR, atol=NEAR, equal_nan=True):
        return Exposure(False, f"Both give {_shown(needed, needed, wrong.function)}")
    yours, colleagues = _shown(needed, needed, wrong.function), _shown(theirs, needed, wrong.function)
    return Exposure(True, f"{wrong.function} gives {yours}, and your colleague's {colleagues}")


def _refused(wrong: Suspect, why: str) -> InvalidInput:
    return InvalidInput(f"{wrong.function} refuses this input ({why}), so it exposes nothing")


def found_in(path: Path, topic: str, source: str = "solutions") -> dict[str, bool]:
    """Of each of a lab's suspects, whether an input for it in a notebook exposes it. source: of the right functions.

    The notebook is read, never run; an input counts only if it is written in numbers.
    """
    right = Implementation(source)
    written = inputs_in(cell.source for cell in read_cells(path)[0] if cell.code)
    return {
        each.key: any(_exposes(each, arguments, right) for arguments in reversed(written.get(each.key, [])))
        for each in suspects(topic)
    }


def _exposes(wrong: Suspect, arguments: Sequence[Any], right: Implementation) -> bool:
    with contextlib.suppress(InvalidInput):
        return tried(wrong, arguments, right.function(wrong.function)).exposed
    return False


def _flat(answer: Any) -> np.ndarray[Any, Any]:
    """An answer's numbers in a row; a tuple is read as its parts one after another."""
    return np.concatenate([np.ravel(np.asarray(part, dtype=float)) for part in _parts(answer)])


def _shapes(answer: Any) -> str:
    """The shape of an answer in words; of several things the shape of each."""
    return ", ".join(str(np.shape(part)) for part in _parts(answer))


def _parts(answer: Any) -> tuple[Any, ...]:
    return answer if isinstance(answer, tuple) else (answer,)


def _shown(answer: Any, needed: Any, function: str) -> str:
    """An answer in words; of several things each has its name. needed: the right answer, which may be yes or no."""
    yes_or_no = all(np.asarray(part).dtype == bool for part in _parts(needed))
    return labelled([_in_words(_flat(part), yes_or_no) for part in _parts(answer)], output_names(function))


def _in_words(numbers: np.ndarray[Any, Any], yes_or_no: bool) -> str:
    if yes_or_no and np.isin(numbers, (0, 1)).all():
        return ", ".join(map(str, numbers.astype(bool).tolist()))
    words = [f"{value + 0.0:.4g}".replace("-", "−") for value in np.round(numbers, 12)]
    return words[0] if len(words) == 1 else f"({', '.join(words)})"
