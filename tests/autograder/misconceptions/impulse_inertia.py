"""Known mistakes of the inertia of a body that has turned."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import over


def rotation(q):
    q = np.asarray(q)
    across = np.swapaxes(np.cross(q[..., None, 1:], np.eye(3)), -1, -2)
    return np.eye(3) + 2 * q[..., :1, None] * across + 2 * across @ across


def scalar_last(q):
    return rotation(np.roll(np.asarray(q), 1, axis=-1))


def half_a_turn(q):
    q = np.asarray(q)
    return np.eye(3) + q[..., :1, None] * np.swapaxes(np.cross(q[..., None, 1:], np.eye(3)), -1, -2)


def inverse(moments):
    return over(1, moments, 0)


def at(moments, q, turn=rotation, of=inverse, left=lambda r: r, right=lambda r: np.swapaxes(r, -1, -2)):
    r = turn(q)
    return left(r) @ (of(np.asarray(moments))[..., None] * np.eye(3)) @ right(r)


def one(r):
    return np.broadcast_to(np.eye(3), np.shape(r))


# fmt: off
BANK = (
    M("world_inverse_inertia", "not inverted", lambda m, q: at(m, q, of=lambda m: np.where(np.isfinite(m), m, 0)),
      "It is the inertia itself, turned: the moments are not inverted.",
      "About which axis does a rod turn most easily? What does your matrix say?"),
    M("world_inverse_inertia", "body axes", lambda m, q: at(m, q, left=one, right=one),
      "The orientation makes no difference: it is the inverse inertia in the body's own axes.",
      "Which argument makes no difference to your answer?"),
    M("world_inverse_inertia", "turned the other way",
      lambda m, q: at(m, q, left=lambda r: np.swapaxes(r, -1, -2), right=lambda r: r),
      "It is Rᵀ I⁻¹ R in place of R I⁻¹ Rᵀ: the body is turned the other way round.",
      "Read from the right: which matrix takes a vector of the world into the body's axes?"),
    M("world_inverse_inertia", "turned once", lambda m, q: at(m, q, right=one),
      "It is R I⁻¹: the way into the body's axes is there, the way back is missing, and the matrix is not symmetric.",
      "In which axes are the vectors that go into your matrix, and in which those that come out?"),
    M("world_inverse_inertia", "turned once, on the right", lambda m, q: at(m, q, left=one),
      "It is I⁻¹ Rᵀ: what comes out is still in the body's axes.",
      "In which axes are the vectors that go into your matrix, and in which those that come out?"),
    M("world_inverse_inertia", "R on both sides", lambda m, q: at(m, q, right=lambda r: r),
      "It is R I⁻¹ R: the transpose is missing.",
      "Is your matrix symmetric?"),
    M("world_inverse_inertia", "scalar last", lambda m, q: at(m, q, turn=scalar_last),
      "The quaternion is read as x, y, z, w; in the lab it is w, x, y, z.",
      "What is the quaternion of a body that is not turned?"),
    M("world_inverse_inertia", "half the turn",
      lambda m, q: at(m, q, turn=half_a_turn),
      "The rotation matrix is only a part of the quaternion's: the factors of 2 or the squares are missing.",
      "Is R Rᵀ the unit matrix?"),
    M("world_inverse_inertia", "infinite for a rod", lambda m, q: at(m, q, of=lambda m: 1 / m),
      "About the axis of a thin rod, with a moment of 0, 1/0 is infinite, and inf · 0 no number; "
      "no impulse has an arm about that axis, and 0 is what is meant there.",
      "What does the description say of a moment of 0?"),
    M("world_inverse_inertia", "one over each component",
      lambda m, q: over(1, at(np.where(np.isfinite(m), m, 0), q, of=lambda m: m), 0),
      "The matrix is inverted number by number; that is not its inverse.",
      "What is your matrix times the inertia?"),
)
# fmt: on
