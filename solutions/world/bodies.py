"""What a world is made of: bodies, which do not change, and their state."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Booleans, Integers
from solutions.checks import (
    finite,
    in_space,
    in_unit_interval,
    not_negative,
    of_shape,
    unit,
    whole,
)
from solutions.domain import (
    Finite,
    Number,
    Positive,
    Vector,
    Whole,
    domain,
    require,
)
from solutions.impulse.inertia import Moments
from solutions.world.mass import mass_properties
from solutions.world.pieces import Pieces, pieces_of
from solutions.world.shapes import HALF_SPACE, Shape

ROUNDING = 1e-6
"""Share up to which moments and a centre of mass may be off.

So values in single precision will do.
"""


class Surfaces(NamedTuple):
    """What happens where two of k materials meet.

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
    moments : (n, 3), about each body's own axes, kg m²
        Infinite for what nothing turns.
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


@domain
def make_bodies(
    shapes: Sequence[Shape],
    mass: Positive,
    moments: Moments,
    restitution: ArrayLike = 0.0,
    friction: ArrayLike = 0.0,
    static_friction: ArrayLike | None = None,
    material: Whole | None = None,
    group: Annotated[Array, whole, finite] = 0,
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
    static_friction : (k, k) or one number, not below friction
        The same as friction if it is not given.
    material : (n,), numbers from 0
        All bodies are of one material if it is not given.
    group : (n,) or one number; bodies of different groups never meet
    collide : (k, k) or one truth value, whether two materials collide

    Returns
    -------
    Bodies

    Raises
    ------
    ValueError
        If the shapes of the arrays do not fit, a table has a value that no two
        materials have or is not symmetric, static friction is below kinetic
        friction, there is no such shape, or a half-space has a finite mass. If
        a moment exceeds the sum of the two others, or the centre of mass of a
        polyhedron that can be moved is not its origin.
    """
    count = len(shapes)
    mass = of_shape("mass", mass, (count,))
    moments = of_shape("moments", moments, (count, 3))
    moments[np.isinf(mass)] = np.inf
    _refuse_impossible(moments)
    row = 0 if material is None else material
    rows = of_shape("material", row, (count,)).astype(np.int64)
    static = friction if static_friction is None else static_friction
    surfaces = _surfaces(
        1 + int(np.max(rows, initial=0)),
        restitution=restitution,
        friction=friction,
        static_friction=static,
        collide=collide,
    )
    pieces = pieces_of(shapes)
    _refuse_off_centre(shapes, pieces, mass)
    return Bodies(
        np.where(np.isinf(mass), 0.0, 1 / mass),
        moments,
        rows,
        of_shape("group", group, (count,)).astype(np.int64),
        surfaces,
        pieces,
    )


def _surfaces(least: int, **given: ArrayLike) -> Surfaces:
    """The tables of at least so many materials."""
    count = max(least, *(max(np.shape(v), default=1) for v in given.values()))
    restitution, kinetic, static, collide = (
        _table(name, values, count) for name, values in given.items()
    )
    in_unit_interval("restitution", restitution)
    below = static < kinetic
    if np.any(below):
        pair = f"{static[below][0]:g} where friction is {kinetic[below][0]:g}"
        raise ValueError(
            f"static_friction must not be below friction, not {pair}"
        )
    return Surfaces(restitution, static, kinetic, collide.astype(bool))


def _refuse_impossible(moments: Array) -> None:
    """Refuse moments (n, 3) of which one exceeds the sum of the two others.

    I_x + I_y − I_z is 2 ∫ z² dm, which no distribution of mass makes negative.
    About an axis with an infinite moment something else holds the body.
    """
    total, largest = np.sum(moments, axis=-1), np.max(moments, axis=-1)
    wrong = np.isfinite(total) & (2 * largest > total * (1 + ROUNDING))
    if np.any(wrong):
        three = ", ".join(f"{moment:g}" for moment in moments[wrong][0])
        raise ValueError(
            f"moments must not exceed the sum of the two others, as in {three}"
            f" of body {np.flatnonzero(wrong)[0]}"
        )


def _refuse_off_centre(
    shapes: Sequence[Shape], pieces: Pieces, mass: Array
) -> None:
    """Refuse bodies that can be moved but do not turn about their origin.

    They are half-spaces, and polyhedra with another centre of mass.
    """
    of_piece = mass[pieces.body]
    movable = (pieces.kind == HALF_SPACE) & np.isfinite(of_piece)
    if np.any(movable):
        raise ValueError(
            "a half-space must have an infinite mass, not"
            f" {of_piece[movable][0]:g} kg"
        )
    for number, shape in enumerate(shapes):
        if shape[0] != "polyhedron" or np.isinf(mass[number]):
            continue
        centre, moments, _ = mass_properties(shape, 1.0)
        if np.linalg.norm(centre) > ROUNDING * np.sqrt(np.max(moments)):
            place = ", ".join(f"{length:.6g}" for length in centre)
            raise ValueError(
                f"the polyhedron of body {number} must have its centre of mass"
                f" at its origin, not at {place}: `in_principal_axes` moves it"
                " there; one that is not filled evenly can be the part of a"
                " compound"
            )


def _table(name: str, values: ArrayLike, count: int) -> Array:
    """A coefficient of each two materials, the same in either order."""
    numbers = finite(name, not_negative(name, values))
    table = of_shape(name, numbers, (count, count))
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
        raise ValueError(
            f"{name} must be the same for two materials in either order, not"
            f" {table[a, b]:g} and {table[b, a]:g} for {a} and {b}"
        )
    return table


@domain
def make_state(
    position: Vector,
    orientation: Number = (1.0, 0.0, 0.0, 0.0),
    velocity: Finite = (0.0, 0.0, 0.0),
    angular_velocity: Finite = (0.0, 0.0, 0.0),
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
        If the shapes do not fit.
    """
    require(
        position.ndim == 2,
        f"position must have the shape (n, 3), not {position.shape}",
    )
    n = len(position)
    return State(
        position.copy(),
        unit("orientation", of_shape("orientation", orientation, (n, 4))),
        of_shape("velocity", velocity, (n, 3)),
        of_shape("angular_velocity", angular_velocity, (n, 3)),
    )


def fitting(
    bodies: Bodies, state: State, *loads: ArrayLike
) -> tuple[State, Array, Array, Array]:
    """Return the state, acceleration, force and torque, if they fit."""
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
