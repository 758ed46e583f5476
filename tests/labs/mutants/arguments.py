"""What can be wrong with what a function is given: a number left out, one body's for the other's, one axis alone.

These mutants compute the right formula with wrong numbers. They are what is left of a body that was forgotten.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from mutants.operators import AXES, alone, diagonal, twins, without

Place = tuple[int, ...]
"""Where a number is: the place of the argument, and of the part of it if it is a body."""
Change = Callable[[Any], Any]
PARTS = ("velocity", "angular_velocity", "arm", "inverse_mass", "inverse_inertia")
"""The parts of a body, in their order."""
TUPLES = {
    "mesh": ("edges", "rest_length", "stiffness", "damping", "mass", "pinned"),
    "bodies": ("inverse_mass", "moments", "restitution", "friction", "meet", "kind", "size"),
    "state": ("position", "orientation", "velocity", "angular_velocity"),
    "contacts": ("contact_a", "contact_b", "point", "normal", "separation", "key"),
    "memory": ("key", "impulse"),
    "rules": ("rest_speed", "margin", "sweeps"),
}
"""The parts of a spring mesh and of the tuples of a world, in their order."""
AFTER = ("velocity_a", "angular_velocity_a", "velocity_b", "angular_velocity_b")
"""The parts of the velocities after an impact, in their order."""


def wrong_arguments(parameters: Sequence[str], sample: Sequence[Any]) -> Iterator[tuple[str, Callable[..., Any]]]:
    """What was done, and a function that makes wrong arguments of right ones. sample: arguments of a single case."""
    names = dict(_places(parameters, sample))
    for place, name in names.items():
        value = _at(sample, place)
        for words, change in _changes(value):
            yield f"{name}: {words}", functools.partial(_changed, place=place, change=change)
        for other, theirs in names.items():
            if theirs in _mistaken(name) and np.ndim(_at(sample, other)) == np.ndim(value):
                yield f"{name}: that of {theirs}", functools.partial(_copied, place=place, other=other)
                for words, change in _changes(value) if place < other else ():
                    yield f"{name} and {theirs}: {words}", functools.partial(_both, (place, other), change)


def _places(parameters: Sequence[str], sample: Sequence[Any]) -> Iterator[tuple[Place, str]]:
    for at, (name, value) in enumerate(zip(parameters, sample, strict=False)):
        if isinstance(value, tuple):
            parts = TUPLES.get(name, AFTER if name == "after" else PARTS)
            yield from (((at, part), f"{parts[part]} of {name}") for part in range(len(value)))
        elif isinstance(value, float | np.ndarray):  # no flag, and no number of rounds
            yield (at,), name


def _mistaken(name: str) -> set[str]:
    part, _, owner = name.rpartition(" of ")
    if not part:
        return set(twins(name))
    return {f"{part} of {other}" for other in twins(owner)} | {f"{other} of {owner}" for other in twins(part)}


def _changes(value: Any) -> Iterator[tuple[str, Change]]:
    yield "left out", lambda given: 0.0 * given
    if np.asarray(value).dtype.kind != "f":  # numbers of nodes, and flags
        return
    yield "sign flipped", lambda given: -given
    match np.ndim(value):
        case 0:
            yield "1 for it", np.ones_like
            yield "its inverse", lambda given: np.where(given != 0, 1 / np.where(given != 0, given, 1.0), 0.0)
            yield "its square", lambda given: given * np.abs(given)
        case 1:
            yield "size for it", np.abs
            for axis in AXES:
                yield f"axis {axis} left out", functools.partial(without, axis)
                yield f"axis {axis} alone", functools.partial(alone, axis)
        case 2 if value.shape[0] != value.shape[1]:
            for axis in AXES:
                yield f"axis {axis} left out", functools.partial(without, axis)
                yield f"axis {axis} alone", functools.partial(alone, axis)
        case 2:
            yield "only the diagonal", diagonal
            yield "1 for it", lambda given: np.broadcast_to(np.eye(given.shape[-1]), np.shape(given))


def _at(arguments: Sequence[Any], place: Place) -> Any:
    return functools.reduce(lambda value, at: value[at], place, arguments)


def _changed(arguments: Sequence[Any], place: Place, change: Change) -> tuple[Any, ...]:
    """The arguments with another number at one place; those that were not given stay so."""
    at, *deeper = place
    if at >= len(arguments):
        return tuple(arguments)
    value = arguments[at]
    new = _changed(value, tuple(deeper), change) if deeper else change(np.asarray(value, dtype=float))
    return (*arguments[:at], new, *arguments[at + 1 :])


def _both(places: Sequence[Place], change: Change, arguments: Sequence[Any]) -> tuple[Any, ...]:
    """The arguments with the same change at two places."""
    for place in places:
        arguments = _changed(arguments, place, change)
    return tuple(arguments)


def _copied(arguments: Sequence[Any], place: Place, other: Place) -> tuple[Any, ...]:
    """The arguments with the number of one place at another as well."""
    if max(place[0], other[0]) >= len(arguments):
        return tuple(arguments)
    theirs = np.asarray(_at(arguments, other), dtype=float)
    return _changed(arguments, place, lambda _: theirs)
