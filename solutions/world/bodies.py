"""What a world is made of: bodies that do not change, and the state that does."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Booleans, Integers
from solutions.checks import (
    finite,
    in_space,
    in_unit_interval,
    not_negative,
    of_shape,
    positive,
    unit,
    vector,
    whole,
)
from solutions.world.mass import mass_properties
from solutions.world.pieces import Pieces, pieces_of
from solutions.world.shapes import HALF_SPACE, Shape

ROUNDING = 1e-6
"""Share up to which moments and a centre of mass may be off, as in single precision."""


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
        `mass_properties` gives those of a solid body; others may be given as
        well. Those of an immovable body are taken as infinite, whatever they
        are.
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
        If a mass is not positive, a moment is negative, a restitution is not
        from 0 to 1, a friction is negative or infinite, static friction is
        below kinetic friction, a table is not symmetric, a material or a group
        is not a whole number, a half-space has a finite mass, there is no such
        shape, or the shapes of the arrays do not fit. If a moment exceeds the
        sum of the two others, or the centre of mass of a polyhedron that can
        be moved is not its origin.
    """
    count = len(shapes)
    masses = of_shape("mass", positive("mass", mass), (count,))
    about = of_shape(
        "moments",
        not_negative("moments", vector("moments", moments)),
        (count, 3),
    )
    about = np.where(np.isinf(masses)[:, None], np.inf, about)
    _refuse_impossible(about)
    kinds, groups = (
        of_shape(name, finite(name, whole(name, numbers)), (count,)).astype(
            np.int64
        )
        for name, numbers in (
            ("material", 0 if material is None else material),
            ("group", group),
        )
    )
    not_negative("material", kinds)
    static_friction = friction if static_friction is None else static_friction
    named = {
        "restitution": restitution,
        "friction": friction,
        "static_friction": static_friction,
        "collide": collide,
    }
    most = max(
        1 + int(np.max(kinds, initial=0)),
        *(max(np.shape(table), default=1) for table in named.values()),
    )
    bounce, kinetic, static, meet = (
        _table(name, table, most) for name, table in named.items()
    )
    in_unit_interval("restitution", bounce)
    below = static < kinetic
    if np.any(below):
        found = f"{static[below][0]:g} where friction is {kinetic[below][0]:g}"
        raise ValueError(
            f"static_friction must not be below friction, not {found}"
        )
    pieces = pieces_of(shapes)
    movable = (pieces.kind == HALF_SPACE) & np.isfinite(masses[pieces.body])
    if np.any(movable):
        raise ValueError(
            "a half-space must have an infinite mass, not"
            f" {masses[pieces.body][movable][0]:g} kg"
        )
    for number, shape in enumerate(shapes):
        if np.isfinite(masses[number]):
            _refuse_off_centre(number, shape)
    inverse = np.where(np.isinf(masses), 0.0, 1 / masses)
    surfaces = Surfaces(bounce, static, kinetic, meet.astype(bool))
    return Bodies(inverse, about, kinds, groups, surfaces, pieces)


def _refuse_impossible(moments: Array) -> None:
    """Refuse moments (n, 3) of which one exceeds the sum of the two others.

    I_x + I_y − I_z is 2 ∫ z² dm, which no distribution of mass makes negative.
    About an axis with an infinite moment something else holds the body.
    """
    total, largest = np.sum(moments, axis=-1), np.max(moments, axis=-1)
    wrong = np.isfinite(total) & (2 * largest > total * (1 + ROUNDING))
    if np.any(wrong):
        found = ", ".join(f"{each:g}" for each in moments[wrong][0])
        raise ValueError(
            f"moments must not exceed the sum of the two others, as in {found}"
            f" of body {np.flatnonzero(wrong)[0]}"
        )


def _refuse_off_centre(number: int, shape: Shape) -> None:
    """Refuse a polyhedron that turns about another point than its centre of mass."""
    if shape[0] != "polyhedron":
        return
    centre, moments, _ = mass_properties(shape, 1.0)
    if np.linalg.norm(centre) > ROUNDING * np.sqrt(np.max(moments)):
        found = ", ".join(f"{each:.6g}" for each in centre)
        raise ValueError(
            f"the polyhedron of body {number} must have its centre of mass at"
            f" its origin, not at {found}: `in_principal_axes` moves it there;"
            " one that is not filled evenly can be the part of a compound"
        )


def _table(name: str, values: ArrayLike, count: int) -> Array:
    """A coefficient of each two materials, the same in either order."""
    table = of_shape(
        name, finite(name, not_negative(name, values)), (count, count)
    )
    if np.any(table != table.T) and np.shape(values) != table.shape:
        advice, letter = "", name[0]
        if np.asarray(values).dtype != bool:
            advice = (
                f". For one {letter} of each body give each a material,"
                f" material=range({len(table)}), and as the table for instance"
                f" np.sqrt(np.outer({letter}, {letter}))"
            )
        raise ValueError(
            f"{name} must be one value, or a table (k, k) of each two"
            f" materials, not {np.shape(values)}: two bodies that meet have it"
            f" in common{advice}"
        )
    if np.any(table != table.T):
        a, b = np.argwhere(table != table.T)[0]
        found = f"{table[a, b]:g} and {table[b, a]:g} for {a} and {b}"
        raise ValueError(
            f"{name} must be the same for two materials in either order, not"
            f" {found}"
        )
    return table


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
        If something is not finite, a quaternion does not have length 1, or the
        shapes do not fit.
    """
    places = finite("position", vector("position", position))
    if places.ndim != 2:
        raise ValueError(
            f"position must have the shape (n, 3), not {places.shape}"
        )
    count = len(places)
    return State(
        places.copy(),
        unit("orientation", of_shape("orientation", orientation, (count, 4))),
        of_shape("velocity", finite("velocity", velocity), (count, 3)),
        of_shape(
            "angular_velocity",
            finite("angular_velocity", angular_velocity),
            (count, 3),
        ),
    )


def fitting(
    bodies: Bodies, state: State, *loads: ArrayLike
) -> tuple[State, Array, Array, Array]:
    """Return the state, acceleration, force and torque; refuse what does not fit."""
    count = len(bodies.inverse_mass)
    for name, array in zip(State._fields, state, strict=True):
        shape = (count, 4 if name == "orientation" else 3)
        if finite(name, array).shape != shape:
            raise ValueError(
                f"{name} must have the shape {shape}, that of {count} bodies,"
                f" not {np.shape(array)}"
            )
    names = ("acceleration", "force", "torque")
    acceleration, force, torque = (
        of_shape(name, in_space(name, load), (count, 3))
        for name, load in zip(names, loads, strict=True)
    )
    return state, acceleration, force, torque
