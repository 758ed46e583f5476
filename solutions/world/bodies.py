"""What a world is made of: bodies that do not change, and the state that does."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Booleans, Integers
from solutions.checks import finite, not_negative, positive, unit, vector
from solutions.world.pieces import Pieces, pieces_of
from solutions.world.shapes import Shape


class Surfaces(NamedTuple):
    """What happens where two materials meet, one row and one column for each material.

    Attributes
    ----------
    restitution : (k, k), e
    static_friction, kinetic_friction : (k, k), μ_s ≥ μ_k
    collide : (k, k), whether two bodies of these materials collide at all
    """

    restitution: Array
    static_friction: Array
    kinetic_friction: Array
    collide: Booleans


class Bodies(NamedTuple):
    """What there is in a world, and does not change.

    Attributes
    ----------
    inverse_mass : (n,), 1/kg; 0 for an immovable body
    moments : (n, 3), about each body's own axes, kg m²; inf for what nothing turns
    material : (n,), numbers of rows in `surfaces`
    group : (n,), bodies collide within their group alone
        Several scenes side by side in one world are as many groups.
    surfaces : the coefficients of each two materials
    pieces : the convex pieces that the bodies are made of
    """

    inverse_mass: Array
    moments: Array
    material: Integers
    group: Integers
    surfaces: Surfaces
    pieces: Pieces


class State(NamedTuple):
    """Where the bodies are and how they move; all that a step changes.

    Attributes
    ----------
    position : (n, 3), of the centres of mass, m
    orientation : (n, 4), unit quaternions w x y z, body to world
    velocity : (n, 3), m/s
    angular_velocity : (n, 3), in the world frame, rad/s
    """

    position: Array
    orientation: Array
    velocity: Array
    angular_velocity: Array


def make_bodies(
    shapes: Sequence[Shape],
    mass: ArrayLike,
    moments: ArrayLike,
    restitution: ArrayLike = 0.0,
    friction: ArrayLike = 0.0,
    static_friction: ArrayLike | None = None,
    material: ArrayLike | None = None,
    group: ArrayLike = 0,
    collide: ArrayLike = True,
) -> Bodies:
    """Bodies of a world.

    Parameters
    ----------
    shapes : n shapes, as `solutions.world.shapes` describes them
    mass : (n,), kg; infinity for an immovable body
    moments : (n, 3), principal moments about the body's own axes, kg m²
        `mass_properties` gives those of a solid body; others may be given as well.
        Those of an immovable body are taken as infinite, whatever they are.
    restitution, friction : (k, k) or one number, e and μ of each two materials
        The friction is kinetic.
    static_friction : (k, k) or one number; the same as friction if it is not given
    material : (n,), numbers from 0; all bodies are of one material if it is not given
    group : (n,) or one number; bodies of different groups never meet
    collide : (k, k) or one truth value, whether two materials collide

    Returns
    -------
    Bodies

    Raises
    ------
    ValueError
        If a mass or a moment is not positive, a coefficient is out of its range, static
        friction is below kinetic friction, or the shapes of the arrays do not fit.
    """
    count = len(shapes)
    masses = np.broadcast_to(positive("mass", mass), count)
    about = np.broadcast_to(not_negative("moments", vector("moments", moments)), (count, 3))
    about = np.where(np.isinf(masses)[:, None], np.inf, about)
    kinds = np.zeros(count, dtype=np.int64) if material is None else np.array(np.broadcast_to(material, count))
    most = 1 + int(np.max(kinds, initial=0))
    kinetic = not_negative("friction", friction)
    static = kinetic if static_friction is None else not_negative("static_friction", static_friction)
    if np.any(static < kinetic):
        raise ValueError("static_friction must not be below friction")
    table = (most, most)
    surfaces = Surfaces(
        np.array(np.broadcast_to(not_negative("restitution", restitution), table)),
        np.array(np.broadcast_to(static, table)),
        np.array(np.broadcast_to(kinetic, table)),
        np.array(np.broadcast_to(np.asarray(collide, dtype=bool), table)),
    )
    inverse = np.where(np.isinf(masses), 0.0, 1 / masses)
    groups = np.array(np.broadcast_to(np.asarray(group, dtype=np.int64), count))
    return Bodies(inverse, about, kinds, groups, surfaces, pieces_of(shapes))


def make_state(
    position: ArrayLike,
    orientation: ArrayLike = (1.0, 0.0, 0.0, 0.0),
    velocity: ArrayLike = (0.0, 0.0, 0.0),
    angular_velocity: ArrayLike = (0.0, 0.0, 0.0),
) -> State:
    """State of n bodies; what is given once holds for all of them.

    Parameters
    ----------
    position : (n, 3), m
    orientation : (n, 4) or (4,), unit quaternions w x y z, body to world
    velocity, angular_velocity : (n, 3) or (3,), m/s and rad/s

    Returns
    -------
    State, with arrays of its own

    Raises
    ------
    ValueError
        If something is not finite, a quaternion does not have length 1, or the shapes
        do not fit.
    """
    places = finite("position", vector("position", position))
    count = len(places)
    return State(
        places.copy(),
        np.array(np.broadcast_to(unit("orientation", orientation), (count, 4))),
        np.array(np.broadcast_to(finite("velocity", vector("velocity", velocity)), (count, 3))),
        np.array(np.broadcast_to(finite("angular_velocity", vector("angular_velocity", angular_velocity)), (count, 3))),
    )
