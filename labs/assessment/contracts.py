"""What a function takes, one case of it: the checks that decide whether an input may expose a wrong function.

They refuse what the function's description lists under *Raises*, so that a notebook says ✓ to no input that the right
function would refuse when the lab is marked. Numbers that say how often or how many have a limit here as well, because
an input must not cost more than a moment. Each check returns the value as the tests of a lab give it to a function.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from labs.grading.worker.bodies import Body, SpringMesh
from reference.arrays import Array
from reference.errors import InvalidInput

Check = Callable[[str, Any], Any]
"""Takes the name of an argument and its value, and returns the value; raises `InvalidInput` if it is refused."""
UNIT_TOLERANCE = 1e-6
"""How far the length of a unit vector may be from 1."""
LARGEST_WHOLE = 2**63
"""Whole numbers from here on are floats, as an array of whole numbers cannot hold them."""
ROUNDING = 1e-10
"""A diagonal that is negative by no more than this share of the largest number counts as zero."""


def _nothing(*_: Any) -> None:
    """Refuse nothing."""


@dataclass(frozen=True)
class Contract:
    """The arguments of a function by name, in order, and what each has to be. optional: how many may be left out.

    together: refuses values that do not fit each other; it gets those that were given.
    """

    arguments: Mapping[str, Check]
    optional: int = 0
    together: Callable[..., None] = _nothing

    def values(self, given: Sequence[Any]) -> list[Any]:
        """The arguments of a call, each as a function gets it.

        Raises
        ------
        InvalidInput
            If there are too many or too few, or the function's description refuses one.
        """
        most = len(self.arguments)
        if not most - self.optional <= len(given) <= most:
            count = f"{most - self.optional} to {most}" if self.optional else f"{most}"
            raise InvalidInput(f"it takes {count} arguments, {', '.join(self.arguments)}, and {len(given)} are given")
        found = [check(name, value) for (name, check), value in zip(self.arguments.items(), given, strict=False)]
        self.together(*found)
        return found


def number(name: str, value: Any) -> Any:
    """One number."""
    if isinstance(value, list | tuple):
        raise InvalidInput(f"{name} must be one number, not a list: an input is one case")
    return value if abs(value) < LARGEST_WHOLE else float(value)


def _bounded(right: Callable[[Any], bool], words: str) -> Check:
    def check(name: str, value: Any) -> Any:
        found = number(name, value)
        if not right(found):
            raise InvalidInput(f"{name} must be {words}, not {float(found):g}")
        return found

    return check


not_negative = _bounded(lambda value: value >= 0, "zero or positive")
positive = _bounded(lambda value: value > 0, "positive")
share = _bounded(lambda value: 0 <= value <= 1, "from 0 to 1")


def whole(most: int) -> Check:
    """A whole number from 0 to a limit, which keeps an input from taking long."""
    return _bounded(lambda value: type(value) is int and 0 <= value <= most, f"a whole number from 0 to {most}")


def array(*shape: int) -> Check:
    """Numbers of a shape, in lists in lists."""
    words = f"{shape[0]} numbers" if len(shape) == 1 else f"numbers of the shape {shape}"

    def check(name: str, value: Any) -> Array:
        found = _array(name, value)
        if found.shape != shape:
            raise InvalidInput(f"{name} must be {words}, not of the shape {found.shape}")
        return found

    return check


vector = array(3)
"""Three components."""


def unit(count: int = 3) -> Check:
    """A vector or a quaternion of length 1."""

    def check(name: str, value: Any) -> Array:
        found: Array = array(count)(name, value)
        length = float(np.linalg.norm(found.astype(float)))
        if not abs(length - 1) <= UNIT_TOLERANCE:
            raise InvalidInput(f"{name} must have length 1, not {length:g}")
        return found

    return check


def nonzero(name: str, value: Any) -> Array:
    """A vector of any length but zero."""
    found: Array = vector(name, value)
    if not np.any(found):
        raise InvalidInput(f"{name} is zero: it has no direction")
    return found


def every(of_one: Check, whole_array: Check) -> Check:
    """An array in which each number has to pass."""

    def check(name: str, value: Any) -> Array:
        found: Array = whole_array(name, value)
        for each in found.ravel().tolist():
            of_one(name, each)
        return found

    return check


def several(least: int, most: int) -> Check:
    """A list of numbers, at least and at most so many."""

    def check(name: str, value: Any) -> Array:
        found = _array(name, value)
        if found.ndim != 1 or not least <= len(found) <= most:
            raise InvalidInput(f"{name} must be {least} to {most} numbers, not of the shape {found.shape}")
        return found

    return check


def one_or_each(of_one: Check) -> Check:
    """One number for all, or a list with one for each; whether the list is long enough is seen elsewhere."""

    def check(name: str, value: Any) -> Any:
        return (
            every(of_one, several(1, len(value)))(name, value)
            if isinstance(value, list | tuple)
            else of_one(name, value)
        )

    return check


def rows(width: int) -> Check:
    """Rows of so many numbers each, at least one."""

    def check(name: str, value: Any) -> Array:
        found = _array(name, value)
        if found.ndim != 2 or found.shape[1] != width:
            raise InvalidInput(f"{name} must be rows of {width} numbers, not of the shape {found.shape}")
        return found

    return check


def matrix(name: str, value: Any) -> Array:
    """A square of numbers."""
    found = _array(name, value)
    if found.ndim != 2 or found.shape[0] != found.shape[1]:
        raise InvalidInput(f"{name} must have as many rows as columns, not the shape {found.shape}")
    return found


def whole_rows(width: int) -> Check:
    """Rows of so many whole numbers each, at least one, such as the corners of faces."""

    def check(name: str, value: Any) -> Any:
        found = rows(width)(name, value)
        if found.dtype.kind not in "iu":
            raise InvalidInput(f"{name} must be whole numbers")
        return found

    return check


def pairs(name: str, value: Any) -> Any:
    """Pairs of nodes; an empty list has none."""
    return np.zeros((0, 2), dtype=int) if value in ([], ()) else whole_rows(2)(name, value)


def as_floats(check: Check) -> Check:
    """An array of floats even if all its numbers are whole, as beside a mesh."""
    return lambda name, value: np.asarray(check(name, value), dtype=float)


def body(name: str, value: Any) -> Body:
    """A body: its velocity, angular velocity, arm, inverse mass and inverse inertia."""
    of_each: dict[str, Check] = {
        "velocity": vector, "angular_velocity": vector, "arm": vector, "inverse_mass": not_negative,
        "inverse_inertia": array(3, 3),
    }  # fmt: skip
    found = Body(*_parts(name, value, of_each))
    not_negative_diagonal(f"inverse_inertia of {name}", found.inverse_inertia)
    return found


def mesh(name: str, value: Any) -> SpringMesh:
    """A spring mesh: its edges, rest lengths, stiffnesses, dampings, masses, and which nodes are pinned."""
    nodes, springs = (len(value[at]) if _has_list(value, at) else 0 for at in (4, 0))
    of_each = dict.fromkeys(SpringMesh._fields[1:4], as_floats(every(not_negative, array(springs))))
    of_each |= {"mass": as_floats(every(positive, array(nodes))), "pinned": array(nodes)}
    ends, rest, stiffness, damping, mass, pinned = _parts(name, value, {"edges": pairs} | of_each)
    refuse_other_nodes(f"edges of {name}", ends, nodes)
    return SpringMesh(ends, rest, stiffness, damping, mass, pinned.astype(bool))


def refuse_other_nodes(name: str, ends: Any, nodes: int) -> None:
    """Refuse pairs that name a node that does not exist, or the same node twice."""
    refuse_other_places(name, ends, nodes, "nodes")
    for first, second in ends.tolist():
        if first == second:
            raise InvalidInput(f"{name} must join two different nodes, not node {first} to itself")


def refuse_other_places(name: str, places: Any, there: int, what: str) -> None:
    """Refuse numbers that name none of so many things."""
    for each in places.ravel().tolist():
        if not 0 <= each < there:
            raise InvalidInput(f"{name} must name {what} from 0 to {there - 1}, not {each}")


def not_negative_diagonal(name: str, matrix: Array) -> None:
    """Refuse a matrix with a negative number on its diagonal, unless it is negative by rounding alone."""
    least = float(np.min(np.diagonal(matrix), initial=0.0))
    if least < -ROUNDING * float(np.max(np.abs(matrix), initial=0.0)):
        raise InvalidInput(f"the diagonal of {name} must not be negative, and {least:g} is on it")


def _parts(name: str, value: Any, of_each: Mapping[str, Check]) -> list[Any]:
    if not isinstance(value, list | tuple) or len(value) != len(of_each):
        raise InvalidInput(f"{name} must have the parts {', '.join(of_each)}, in lists")
    return [check(f"{part} of {name}", each) for (part, check), each in zip(of_each.items(), value, strict=True)]


def _has_list(value: Any, at: int) -> bool:
    return isinstance(value, list | tuple) and len(value) > at and isinstance(value[at], list | tuple)


def _array(name: str, value: Any) -> Array:
    """A list as an array: of whole numbers if all are whole and an array can hold them."""
    try:
        found = np.array(value)
        return found.astype(float) if found.dtype == object else found
    except (ValueError, TypeError):
        raise InvalidInput(f"{name} must be numbers in lists of equal length") from None
