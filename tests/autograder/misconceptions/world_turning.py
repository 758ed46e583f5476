"""Known mistakes of bodies that turn freely."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from solutions.impulse import rotation_matrix
from solutions.world import turned


def spin(
    q,
    w,
    moments,
    dt,
    turn=lambda q, w, dt: turned(q, w * dt),
    before=lambda q: rotation_matrix(q),
    after=lambda q: rotation_matrix(q),
    weigh=lambda moments, own: moments * own,
    unweigh=lambda moments, own: own / moments,
    found=lambda new, old, held: np.where(held, old, new),
):
    """Turn, and find the spin that has the same angular momentum; each part may be another one."""
    q, w, moments = (np.asarray(each, dtype=float) for each in (q, w, moments))
    later = turn(q, w, dt)
    held = np.any(np.isinf(moments), axis=-1, keepdims=True)
    finite = np.where(np.isfinite(moments), moments, 1.0)
    momentum = np.matvec(before(q), weigh(finite, np.vecmat(w, before(q))))
    return later, found(np.matvec(after(later), unweigh(finite, np.vecmat(momentum, after(later)))), w, held)


def with_(**parts):
    return lambda q, w, moments, dt: spin(q, w, moments, dt, **parts)


def product(second, first):
    a, p, b, q = second[..., :1], second[..., 1:], first[..., :1], first[..., 1:]
    return np.concatenate([a * b - np.sum(p * q, axis=-1, keepdims=True), a * q + b * p + np.cross(p, q)], axis=-1)


def quaternion(rotation):
    angle = np.linalg.norm(rotation, axis=-1, keepdims=True)
    way = rotation / np.where(angle > 0, angle, 1.0)
    return np.concatenate([np.cos(angle / 2), np.sin(angle / 2) * way], axis=-1)


def added(q, w, dt):
    """The quaternion q + dt/2 (0, ω) q, without a length of 1."""
    return q + dt / 2 * product(np.concatenate([0 * w[..., :1], w], axis=-1), q)


def of_length_one(q):
    return q / np.linalg.norm(q, axis=-1, keepdims=True)


def euler_step(q, w, moments, dt):
    """ω by Euler's equations, one explicit step of them."""
    q, w, moments = (np.asarray(each, dtype=float) for each in (q, w, moments))
    held = np.any(np.isinf(moments), axis=-1, keepdims=True)
    finite = np.where(np.isfinite(moments), moments, 1.0)
    r = rotation_matrix(q)
    own = np.vecmat(w, r)
    change = np.matvec(r, -np.cross(own, finite * own) / finite)
    return turned(q, w * dt), np.where(held, w, w + dt * change)


def turned_by_the_mean(q, w, moments, dt):
    """The turn takes the mean of the old and the new spin."""
    _, new = spin(q, w, moments, dt)
    return turned(q, (np.asarray(w) + new) / 2 * dt), new


def turned_by_the_new(q, w, moments, dt):
    """The turn takes the new spin."""
    _, new = spin(q, w, moments, dt)
    return turned(q, new * dt), new


def energy_kept(q, w, moments, dt):
    """The new spin has the energy of the old one."""
    later, new = spin(q, w, moments, dt)
    held = np.any(np.isinf(moments), axis=-1)
    finite = np.where(np.isfinite(moments), moments, 1.0)
    before, after = (
        np.sum(finite * np.vecmat(w, rotation_matrix(q)) ** 2, axis=-1) for q, w in ((q, np.asarray(w)), (later, new))
    )
    scale = np.where(held | (after == 0), 1.0, np.sqrt(before / np.where(after > 0, after, 1.0)))
    return later, new * scale[..., None]


# fmt: off
BANK = (
    M("rotate_by_momentum", "spin kept", with_(found=lambda new, old, held: old + 0 * new),
      "The body keeps ω. Then L = I(q) ω changes as the body turns, without a torque, and nothing ever tumbles.",
      "Without a torque, which of L and ω stays as it is?"),
    M("rotate_by_momentum", "not turned", with_(turn=lambda q, w, dt: q + 0 * w[..., :1]),
      "The body stays as it lies: its orientation does not change.",
      "It spins with ω for the time dt. By which angle has it turned?"),
    M("rotate_by_momentum", "turned the other way", with_(turn=lambda q, w, dt: turned(q, -w * dt)),
      "The body turns by −ω dt.",
      "A positive spin about z turns x towards y. Does your body do that?"),
    M("rotate_by_momentum", "turned in its own axes", with_(turn=lambda q, w, dt: product(q, quaternion(w * dt))),
      "The turn is the right factor, as if ω were along the body's own axes. ω is in the world frame.",
      "In which frame is ω given? On which side of q does a turn about an axis of the world belong?"),
    M("rotate_by_momentum", "half the angle", with_(turn=lambda q, w, dt: turned(q, w * dt / 2)),
      "The body turns by half of ω dt; the half angle of a quaternion is inside of `turned` already.",
      "What does `turned` want: the angle, or half of it?"),
    M("rotate_by_momentum", "twice the angle", with_(turn=lambda q, w, dt: turned(q, 2 * w * dt)),
      "The body turns by twice ω dt.",
      "By which angle does it turn in the time dt?"),
    M("rotate_by_momentum", "added and normalised", with_(turn=lambda q, w, dt: of_length_one(added(q, w, dt))),
      "q + ½ dt ω q with its length mended turns by less than ω dt: by 2 arctan(½ ω dt).",
      "With ω dt = π the body should have made half a turn. How far has yours come?"),
    M("rotate_by_momentum", "old axes at the start alone", with_(before=lambda q: np.eye(3) + 0 * rotation_matrix(q)),
      "The angular momentum of the start is taken as if the body lay along the axes of the world.",
      "How does the body lie at the start? Which matrix takes ω into its own axes?"),
    M("rotate_by_momentum", "R for its transpose",
      with_(before=lambda q: rotation_matrix(q).mT, after=lambda q: rotation_matrix(q).mT),
      "R and Rᵀ have changed places: R turns from the body's own axes into the world, and Rᵀ back.",
      "The columns of R are the body's axes. Which of R ω and Rᵀ ω has the components along them?"),
    M("rotate_by_momentum", "divided by the moments at first",
      with_(weigh=lambda m, own: own / m, unweigh=lambda m, own: m * own),
      "L is found with I⁻¹ and ω with I: the two are the wrong way round.",
      "What unit has L? Does your first product have it?"),
    M("rotate_by_momentum", "momentum for spin", with_(unweigh=lambda m, own: own),
      "The angular momentum itself is returned in place of the spin.",
      "What unit has the second thing that you return?"),
    M("rotate_by_momentum", "spin for momentum", with_(weigh=lambda m, own: own),
      "ω itself is divided by the moments: the angular momentum was never found.",
      "What is L, with ω and the moments?"),
    M("rotate_by_momentum", "Euler's equations", euler_step,
      "The spin takes one explicit step of Euler's equations: then L stays only for small steps, and the energy grows.",
      "Which quantity stays to the last digit in your result? Is there a way to keep L exactly?"),
    M("rotate_by_momentum", "mean spin", turned_by_the_mean,
      "The body turns with the mean of the old and the new spin. The description asks for the whole ω dt of the start.",
      "With which ω should the body turn?"),
    M("rotate_by_momentum", "a torque that is not there",
      with_(found=lambda new, old, held: np.where(held, old, 2 * old - new)),
      "The change of the spin has the wrong sign.",
      "Is I(q⁺) ω⁺ the same as I(q) ω?"),
    M("rotate_by_momentum", "R for its transpose at first", with_(before=lambda q: rotation_matrix(q).mT),
      "For L at the start R and Rᵀ have changed places: R turns from the body's own axes into the world, and Rᵀ back.",
      "The columns of R are the body's axes. Which of R ω and Rᵀ ω has the components along them?"),
    M("rotate_by_momentum", "turned by its own components",
      with_(turn=lambda q, w, dt: turned(q, np.vecmat(w, rotation_matrix(q)) * dt)),
      "The components of ω along the body's own axes are given to `turned`, which wants those in the world.",
      "In which frame is the rotation that `turned` takes?"),
    M("rotate_by_momentum", "turned with the new spin", turned_by_the_new,
      "The body turns with the new spin. The description asks for the whole ω dt of the start.",
      "With which ω should the body turn?"),
    M("rotate_by_momentum", "energy kept", energy_kept,
      "The new spin is made longer or shorter so that the energy stays. Then L changes, without a torque.",
      "Without a torque, which of L and the energy does the description keep?"),
    M("rotate_by_momentum", "dt left out of the turn", with_(turn=lambda q, w, dt: turned(q, w + 0 * dt)),
      "The body turns by ω, as if the step took one second.",
      "By which angle does it turn in the time dt?"),
    M("rotate_by_momentum", "never back in time", with_(turn=lambda q, w, dt: turned(q, w * abs(dt))),
      "The body turns by the size of dt: with a negative dt it should turn back.",
      "What does a film of the body show that runs backwards?"),
    M("rotate_by_momentum", "what is held tumbles", with_(found=lambda new, old, held: np.where(held, 0.0, new)),
      "A body with infinite moments loses its spin. It keeps it: something else turns it.",
      "A mill wheel is driven at a given spin. What is that spin after a step?"),
)
# fmt: on
