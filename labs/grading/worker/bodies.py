"""The bodies and meshes that a submission's functions get: tuples whose parts have the names of the notebook's own."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np


class Body(NamedTuple):
    """One of the two bodies of an impact."""

    velocity: Any
    angular_velocity: Any
    arm: Any
    inverse_mass: Any
    inverse_inertia: Any


class SpringMesh(NamedTuple):
    """A spring mesh, as plain arrays."""

    edges: Any
    rest_length: Any
    stiffness: Any
    damping: Any
    mass: Any
    pinned: Any

    @property
    def inverse_mass(self) -> Any:
        """Of every node, zero where it is pinned."""
        return np.where(self.pinned, 0.0, 1 / np.asarray(self.mass))


_BY_SIZE = {len(kind._fields): kind for kind in (Body, SpringMesh)}


def with_names(argument: Any) -> Any:
    """A body or a mesh with its names; any other argument as it is.

    The contacts of a world are six arrays as well, but begin with a list of numbers and not with pairs of them.
    """
    kind = _BY_SIZE.get(len(argument)) if type(argument) is tuple else None
    if kind is SpringMesh and np.ndim(argument[0]) != 2:
        return argument
    return kind(*argument) if kind else argument
