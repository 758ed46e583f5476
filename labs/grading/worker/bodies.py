"""The bodies that a submission's functions get: tuples whose parts have the names of the notebook's `Body`."""

from __future__ import annotations

from typing import Any, NamedTuple


class Body(NamedTuple):
    """One of the two bodies of an impact."""

    velocity: Any
    angular_velocity: Any
    arm: Any
    inverse_mass: Any
    inverse_inertia: Any


def with_names(argument: Any) -> Any:
    """A body with its names; any other argument as it is. No other argument of the lab is a tuple of five."""
    return Body(*argument) if type(argument) is tuple and len(argument) == len(Body._fields) else argument
