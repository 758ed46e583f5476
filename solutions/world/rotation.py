"""A free body keeps its angular momentum, but not its spin (slide 18)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array, Booleans
from solutions.domain import Finite, Matrix, Quaternion, Vector, domain
from solutions.impulse.inertia import Moments
from solutions.vectors import quotient
from solutions.world.vectors import cross


@domain
def turned(orientation: Quaternion, rotation: Vector) -> Array:
    """Orientation of a body that is turned further, about a world axis.

    Parameters
    ----------
    orientation : (..., 4), unit quaternion w, x, y, z
    rotation : (..., 3), along the axis and as long as the angle in rad
        After a time t at the angular velocity ω it is ω t.

    Returns
    -------
    (..., 4), unit quaternion w, x, y, z
        A rotation of 0 leaves the orientation as it is, to rounding.

    Notes
    -----
    A turn by the angle θ about the unit vector n is the quaternion

        (cos θ/2, n sin θ/2) = (cos θ/2, w sin(θ/2)/θ)

    with the rotation w = n θ. As θ goes to 0, the quotient goes to ½, and
    `np.sinc` uses this limit. The formula is exact for an angle of any size.
    The turn that comes later is the left factor of the `quaternion_product`.
    """
    return _product(_turn_of(rotation), orientation)


@domain
def quaternion_product(second: Quaternion, first: Quaternion) -> Array:
    """One rotation after another, as one rotation.

    Parameters
    ----------
    second, first : (..., 4), unit quaternions w, x, y, z
        The rotation `first` turns a vector, and then `second` turns the
        result.

    Returns
    -------
    (..., 4), unit quaternion w, x, y, z

    Notes
    -----
    Written as a number a and a vector p, the product of (a, p) and (b, q) is

        (a b − p·q,  a q + b p + p × q)

    The cross product makes the order matter. The product of two unit
    quaternions has length 1. The function divides by its length nevertheless,
    since roundings would add up over many steps.
    """
    return _product(second, first)


@domain
def orientation_of(rotation: Matrix) -> Array:
    """Quaternion of a rotation matrix: the inverse of `rotation_matrix`.

    Parameters
    ----------
    rotation : (..., 3, 3), R
        Its columns are the body's axes as seen in the world: perpendicular, of
        unit length and right-handed.

    Returns
    -------
    (..., 4), unit quaternion w, x, y, z, or its opposite, which means the same

    Notes
    -----
    The numbers of R = 1 + 2 w [q×] + 2 [q×]² give the products of any two
    components of the quaternion. For example,

        R₃₂ − R₂₃ = 4 w x
        R₂₁ + R₁₂ = 4 x y
        1 + R₁₁ + R₂₂ + R₃₃ = 4 w²

    All sixteen products together are a matrix each row of
    which is a multiple of the quaternion. The function takes the row with the
    largest square, because this row has lost the fewest digits.
    """
    r = rotation
    transposed = np.swapaxes(r, -1, -2)
    trace = np.trace(r, axis1=-2, axis2=-1)[..., None, None]
    with_w = (r - transposed)[..., [2, 0, 1], [1, 2, 0]]
    products = np.empty((*r.shape[:-2], 4, 4))
    products[..., 0, 0] = 1 + trace[..., 0, 0]
    products[..., 0, 1:] = with_w
    products[..., 1:, 0] = with_w
    products[..., 1:, 1:] = r + transposed + (1 - trace) * np.eye(3)
    largest = np.argmax(np.diagonal(products, axis1=-2, axis2=-1), axis=-1)
    row = np.take_along_axis(products, largest[..., None, None], axis=-2)
    row = row[..., 0, :]
    return row / np.linalg.norm(row, axis=-1, keepdims=True)


@domain
def turn_freely(
    orientation: Quaternion,
    angular_velocity: Vector,
    moments: Moments,
    dt: Finite,
) -> tuple[Array, Array]:
    """Turn bodies on which no torque acts, over a time dt (slide 18).

    The angular momentum of each body stays as it is, to rounding. The spin
    follows from it, because the inertia turns with the body: this is the
    gyroscopic term.

    Parameters
    ----------
    orientation : (..., 4), q, unit quaternion w, x, y, z
    angular_velocity : (..., 3), ω in the world frame, rad/s
    moments : (..., 3), kg m², not negative
        Principal moments about the body's own axes.
    dt : (...), s
        A negative time turns the bodies back.

    Returns
    -------
    orientation, angular_velocity : (..., 4) and (..., 3)
        A body with three equal moments keeps its spin, exactly. So does a body
        that has an infinite moment, because something else holds it or drives
        it. About an axis without a moment, as that of a thin rod, the angular
        momentum is zero and says nothing of the spin. The body keeps its spin
        about this axis and takes it along.

    Notes
    -----
    The angular momentum in the world frame is

        L = I(q) ω
        I(q) = R I_body Rᵀ

    Without a torque, L is constant. As the body turns, R changes. So I(q)
    changes, and ω = I⁻¹(q) L must change too. A program that keeps ω instead
    breaks L, and in such a program nothing ever tumbles.

    How the body turns can be written down for a part of its energy at a time.
    Let M be L along the body's own axes, i, j and k, and a = 1/I. The energy
    is

        (a_i M_i² + a_j M_j² + a_k M_k²)/2
            = a_j ‖L‖²/2 + (a_k − a_j) M_k²/2 + (a_i − a_j) M_i²/2

    With the first part alone, the body would be like a ball: it would turn
    about L, by a_j L in each second. With the second part alone it would turn
    about its own axis k, by (a_k − a_j) M_k, and M_k would stay. The third
    part does the same about i. A step takes half of the third part, then the
    first and the second one, and then the other half of the third.

    The axes i and j are the two whose a differ least. In a body with two equal
    moments, such as a rod or a coin, the third part is zero, and the other two
    do not disturb each other: the step is exact, however long it is. In other
    bodies the error of the orientation is proportional to dt².

    The step only ever turns the body, so that L stays. It reads the same from
    both ends. If it gained energy on the way forwards, it would lose as much
    on the way back, which is a free rotation like any other. So the energy
    oscillates by a share of the order (ω dt)², and does not drift. It cannot
    grow without bound in any case: it stays between ‖L‖²/2 over the largest
    moment and ‖L‖²/2 over the smallest.

    A rule that turns the body by the spin in the middle of the step needs to
    find this spin. In a slender body a slight error of the orientation is a
    large spin about the long axis. There such a rule gains energy, and at
    coarse steps it finds nothing.
    """
    given = orientation, angular_velocity, moments, dt[..., None]
    shape = np.broadcast_shapes(*(array.shape[:-1] for array in given))
    q, w, moments, dt = (
        np.broadcast_to(array, (*shape, array.shape[-1])) for array in given
    )
    q_after, w_after = turned(q, w * dt), w.copy()
    unequal = np.any(moments != moments[..., :1], axis=-1)
    tumbling = unequal & np.all(np.isfinite(moments), axis=-1)
    if np.any(tumbling):
        q_after[tumbling], w_after[tumbling] = _tumbled(
            q[tumbling], w[tumbling], moments[tumbling], dt[tumbling]
        )
    return q_after, w_after


def _tumbled(
    q: Array, w: Array, moments: Array, dt: Array
) -> tuple[Array, Array]:
    """The same for n bodies with finite, unequal moments; dt is (n, 1)."""
    has_moment = moments > 0
    own = _in_its_axes(q, w)
    momentum = _in_the_world(q, moments * own)
    a = quotient(1.0, moments)

    def turned_about_own(
        orientation: Array, share: Array, time: Array
    ) -> Array:
        """Orientation after a part (a − a_j) M²/2 of the energy alone."""
        turn = time * share * _in_its_axes(orientation, momentum)
        return _product(orientation, _turn_of(turn))

    axis_i, axis_j, axis_k = _axes(a, has_moment)
    a_j = np.sum(np.where(axis_j, a, 0.0), axis=-1, keepdims=True)
    second = np.where(axis_k, a - a_j, 0.0)
    third = np.where(axis_i, a - a_j, 0.0)
    q = turned_about_own(q, third, dt / 2)
    q = turned_about_own(q, second, dt)
    q = _product(_turn_of(a_j * momentum * dt), q)
    q = turned_about_own(q, third, dt / 2)
    w = _in_the_world(q, a * _in_its_axes(q, momentum))
    if not np.all(has_moment):
        unknown_to_momentum = _in_the_world(q, np.where(has_moment, 0.0, own))
        q = _product(_turn_of(unknown_to_momentum * dt), q)
        w = w + unknown_to_momentum
    return q, w


def _axes(
    a: Array, has_moment: Booleans
) -> tuple[Booleans, Booleans, Booleans]:
    """Which of its axes are i, j and k of each body, (n, 3) each."""
    # An axis without a moment is far from all others.
    a = np.where(has_moment, a, np.finfo(float).max)
    # For each axis, how far the other two are apart.
    apart = np.abs(np.roll(a, -1, axis=-1) - np.roll(a, -2, axis=-1))
    axis_k = np.arange(3) == np.argmin(apart, axis=-1)[:, None]
    return np.roll(axis_k, 1, axis=-1), np.roll(axis_k, 2, axis=-1), axis_k


def _in_the_world(q: Array, v: Array) -> Array:
    """R v: vectors along a body's own axes, as seen in the world."""
    twice = 2 * cross(q[..., 1:], v)
    return v + q[..., :1] * twice + cross(q[..., 1:], twice)


def _in_its_axes(q: Array, v: Array) -> Array:
    """Rᵀ v: vectors of the world along a body's own axes."""
    return _in_the_world(q * (1.0, -1.0, -1.0, -1.0), v)


def _turn_of(w: Array) -> Array:
    """The quaternion of a rotation vector."""
    angle = np.sqrt(np.vecdot(w, w))[..., None]
    vector = w * np.sinc(angle / (2 * np.pi)) / 2
    return np.concatenate([np.cos(angle / 2), vector], axis=-1)


def _product(second: Array, first: Array) -> Array:
    """The product of two quaternions (a, p) and (b, q), of length 1."""
    a, p = second[..., :1], second[..., 1:]
    b, q = first[..., :1], first[..., 1:]
    scalar = a * b - np.vecdot(p, q)[..., None]
    product = np.concatenate([scalar, a * q + b * p + cross(p, q)], axis=-1)
    return product / np.sqrt(np.vecdot(product, product))[..., None]
