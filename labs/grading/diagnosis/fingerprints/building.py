"""Makes the files of fingerprints from an implementation that is right and a bank of wrong ones."""

from __future__ import annotations

import contextlib
import inspect
import itertools
import json
import math
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from labs.grading.diagnosis.deviations import Deviation, Right, ask, deviation_of, outputs
from labs.grading.diagnosis.fingerprints.inherited_mistakes import inherited
from labs.grading.diagnosis.fingerprints.reading import BETWEEN, FOLDER, SCHEMA, VERSION, known, read
from labs.grading.diagnosis.misconceptions import Misconception, read_bank
from labs.grading.diagnosis.output_names import rows_of
from labs.grading.diagnosis.probes import Probe, probed, probes
from reference import lecture
from reference.arrays import Array
from reference.engines.implementation import Implementation
from reference.errors import InvalidInput

NUDGE = 2e-7
"""Relative change of an input: what rounding to single precision does to it, and still a unit vector of unit length."""
JUMP = 1e4
"""An output that moves by more than this many times its size is on an edge: there the scale is its size."""
DIGITS = 9
"""Significant digits of the numbers in the files."""
SMALLEST_SIZE = 1e-3
"""An output of zeros is judged as one of this size when it is asked whether the probe is on an edge."""
HEADROOM = 0.9
"""Sizes of cases made by hand are powers of two; times this, their rounding cannot change the scale's power of two."""
WITH_GIVEN_FUNCTIONS = ("world",)
"""Labs in which the functions of other labs are given: what students wrote there is not in their notebook."""
Content = dict[str, Any]


def write(folder: Path | None = None, implementation: Implementation | None = None) -> list[Path]:
    """Write one file a topic and return the files."""
    written = []
    for topic, content in build(implementation).items():
        path = (folder or FOLDER) / f"{topic}.json"
        path.write_text(lines(content) + "\n", encoding="utf-8")
        written.append(path)
    read.cache_clear()
    known.cache_clear()
    return written


def build(
    implementation: Implementation | None = None,
    bank: Iterable[Misconception] | None = None,
    inheriting: bool = True,
) -> dict[str, Content]:
    """The files' content by topic; on request without what a function inherits from others, which takes longest.

    Raises
    ------
    InvalidInput
        If an entry of the bank is right on every probe, or two entries deviate equally on all probes: either they are
        one mistake, or the probes are too few to tell them apart.
    """
    right, table = implementation or Implementation("solutions"), tuple(read_bank() if bank is None else bank)
    content: dict[str, Content] = {}
    earlier: dict[str, tuple[Callable[..., Any], list[Misconception]]] = {}
    for entry in probed():
        head = {"schema": SCHEMA, "version": VERSION, "functions": {}}
        own = [known for known in table if known.function == entry.name]
        functions = content.setdefault(entry.topic, head)["functions"]
        function = vars(right.function(entry.name))["__wrapped__"]  # as its module has it
        known_here = {name: each for name, each in earlier.items() if _may_spoil(name, entry.topic)}
        functions[entry.name] = learned(entry.name, function, own, known_here if inheriting else {})
        earlier[entry.name] = function, own
    return content


def _may_spoil(name: str, topic: str) -> bool:
    """Whether a mistake in that function may show in functions of a topic."""
    return topic not in WITH_GIVEN_FUNCTIONS or lecture.function(name).topic == topic


def learned(
    name: str,
    right: Callable[..., Any],
    bank: list[Misconception],
    earlier: Mapping[str, tuple[Callable[..., Any], Sequence[Misconception]]] | None = None,
) -> Content:
    """What is known of one function, as the file holds it; raises what `build` raises."""
    cases = probes(name)
    answers = [None if probe.group == "refused" else right_answer(right, probe, name) for probe in cases]
    deviations = {entry.name: deviations_of(entry.formula, name, cases, answers) for entry in bank}
    _tell_apart(name, deviations)
    through = inherited(name, right, earlier or {}, cases, answers, list(deviations.values()), deviations_of)
    return {
        "parameters": list(inspect.signature(right).parameters),
        "right": [answer and _kept(answer) for answer in answers],
        "mistakes": {
            entry.name: {
                "rationale": entry.rationale,
                "help": entry.help,
                "deviations": _short(deviations[entry.name]),
            }
            for entry in bank
        },
        "inherited": {BETWEEN.join(ids): _short(own) for ids, own in through},
    }


def deviations_of(
    formula: Callable[..., Any], name: str, cases: Iterable[Probe], answers: Iterable[Right | None]
) -> list[Deviation]:
    """The deviation of a formula on each probe that has a right answer."""
    pairs = [(probe, answer) for probe, answer in zip(cases, answers, strict=True) if answer]
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        said = ask(lambda _, *arguments: formula(*arguments), name, [probe for probe, _ in pairs])
    return [deviation_of(answer, right) for answer, (_, right) in zip(said, pairs, strict=True)]


def _tell_apart(name: str, deviations: Mapping[str, list[Deviation]]) -> None:
    for entry, own in deviations.items():
        if all(known.right for known in own):
            raise InvalidInput(f"{name}/{entry} is right on every probe; drop it, or add a probe that shows it")
        if all(known.failure for known in own):
            raise InvalidInput(f"{name}/{entry} fails on every probe: its formula is broken")
    for first, second in itertools.combinations(deviations, 2):
        if all(a.agrees(b) for a, b in zip(deviations[first], deviations[second], strict=True)):
            raise InvalidInput(f"{name}/{first} and {name}/{second} give the same numbers; merge them or add a probe")


# Right answers


def right_answer(function: Callable[..., Any], probe: Probe, name: str = "") -> Right:
    """What the function returns, with the size of the numbers that went into it. name: of the function."""
    value = function(*probe.arguments)
    count = len(value) if isinstance(value, tuple) else 1
    found = outputs(value, count)
    assert found is not None
    moved = [outputs(value, count) for value in _beside(function, probe)]
    scales = [_scale(array, [other[place] for other in moved if other]) for place, array in enumerate(found)]
    return Right(found, tuple(scales), *rows_of(name))


def _beside(function: Callable[..., Any], probe: Probe) -> Iterator[Any]:
    for seed in range(2):
        with contextlib.suppress(ValueError):  # nudged beyond a limit, such as two equal coefficients of friction
            yield function(*_nudged(probe.arguments, seed))


def _scale(array: Array, moved: list[Array]) -> float:
    finite = array[np.isfinite(array)]
    size = float(np.max(np.abs(finite), initial=0.0))
    with np.errstate(invalid="ignore"):
        shifts = np.array([np.max(np.nan_to_num(np.abs(other - array), nan=0.0), initial=0.0) for other in moved])
    reach = float(np.max(shifts, initial=0.0)) / NUDGE
    scale = max(size, reach) if reach <= JUMP * max(size, SMALLEST_SIZE) else size
    return float(2.0 ** math.ceil(math.log2(HEADROOM * scale))) if scale else 1.0  # a power: two machines agree on it


def _nudged(value: Any, seed: int) -> Any:
    """The input with every number changed a little; whole numbers and flags stay."""
    rng = np.random.default_rng(seed)

    def change(item: Any) -> Any:
        if isinstance(item, tuple):
            return tuple(change(part) for part in item)
        if isinstance(item, np.ndarray) and item.dtype.kind == "f":
            return item * (1 - NUDGE * rng.uniform(size=item.shape))  # less, never more: e = 1 must not pass 1
        return item * (1 - NUDGE * rng.uniform()) if isinstance(item, float) else item

    return change(value)


# The files


def _short(deviations: Iterable[Deviation]) -> list[Any]:
    return [each.failure or _digits(each.total) for each in deviations]


def _kept(answer: Right) -> list[list[Any]]:
    pairs = zip(answer.outputs, answer.scales, strict=True)
    return [[list(array.shape), [_digits(number) for number in array.ravel()], scale] for array, scale in pairs]


def _digits(number: float) -> float | int | str:
    """A number of nine digits; a word for what JSON has none for."""
    if not math.isfinite(number):
        return str(float(number))
    rounded = float(f"{number:.{DIGITS}g}")
    return int(rounded) if rounded == int(rounded) and abs(rounded) < 1e9 else rounded


def lines(content: Any, depth: int = 6) -> str:
    """JSON with a line for each entry down to some depth, so that a mistake that changes changes few lines."""
    if depth == 0 or not isinstance(content, Mapping) or not content:
        return json.dumps(content, ensure_ascii=False, separators=(",", ":"))
    entries = (f"{json.dumps(name, ensure_ascii=False)}: {lines(value, depth - 1)}" for name, value in content.items())
    return "{\n" + ",\n".join(entries) + "\n}"
