"""The course of an impact with friction: its impulse grows, its slip turns.

The construction is Routh's. Vectors are along the axes of the contact: two
along the surface, and the normal last.
"""

from __future__ import annotations

from typing import Literal

import numpy as np

from solutions.arrays import Array, Booleans, Integers
from solutions.vectors import quotient

End = Literal["speed", "impulse", "work"]
"""What says that a part of the impact is over: u_n, J_n or the work of J_n."""
NORMAL = np.array([0.0, 0.0, 1.0])
STOPPED = 1e-11
"""A slip below this share of the speed of the impact has stopped."""
SPEED_ROUNDING = 16 * float(np.finfo(float).eps)
"""Rounding of u + K J per condition of K, as a share of the impact's speed."""
STRAIGHT = 1e-12
"""A turn of the slip that is rounding, as a share of its fastest change."""
SETTLED = 1e-3
"""The largest angle by which a slip is turned to where it settles."""
FIRST_STEP = 0.05
"""A turning slip's first step changes at most this share of the speed."""
ACCURACY = 1e-10
"""Error of a step at most, as a share of the speed of the impact."""
OF_THE_SLIP = 0.01
"""Error of a step at most, as a share of the slip, lest it be all error."""
MOST_ROUNDS = 5_000
"""Legs and steps of an impact at most; 300 are enough for any two bodies."""
HALVINGS = 60
"""How often an interval is halved at most: from π/2 down to rounding."""
CLOSE = 1e-14
"""Change of a step, as a share of it, that is rounding."""
TINY = 1e-300
"""Keeps a quotient finite."""


class Course:
    """Impacts under way: N contacts with what each has given so far.

    Attributes
    ----------
    start : (N, 3), u before the impact, m/s
    k : (N, 3, 3), K, 1/kg
    mu : (N,), μ
    impulse : (N, 3), J so far, N s
    work : (N,), of the normal force so far, J
    smallest : (N,), a slip below it has stopped, m/s
    accepted : (N,), error of a step at most, m/s
    rate : (N,), 1/kg
        For a unit of normal impulse no velocity changes by more.
    step : (N,), how long the next step may be, N s
    """

    def __init__(self, start: Array, k: Array, mu: Array) -> None:
        self.start, self.k, self.mu = start, k, mu
        self.impulse = np.zeros_like(start)
        self.work = np.zeros(len(start))
        speed = np.linalg.norm(start, axis=-1)
        rounding = SPEED_ROUNDING * np.linalg.cond(k)
        self.smallest = speed * np.maximum(STOPPED, rounding)
        self.accepted = speed * np.maximum(ACCURACY, rounding)
        self.rate = (1 + mu) * np.linalg.norm(k, axis=(-2, -1))
        self.step = FIRST_STEP * speed / self.rate

    def velocity(self, on: Integers, impulse: Array) -> Array:
        """Velocity u + K J of the contacts `on`, (n, 3), m/s."""
        return self.start[on] + np.matvec(self.k[on], impulse)


def follow(course: Course, end: End, target: Array) -> None:
    """Let the impulse of every impact grow until its end is at the target.

    Parameters
    ----------
    course : Course, N impacts, which are taken further
    end : str, what is to reach the target: "speed", "impulse" or "work"
    target : (N,), u_n (m/s), J_n (N s) or the work of J_n (J)

    Notes
    -----
    Let p be the normal impulse so far. While it grows by dp, Coulomb's
    friction grows by μ dp against the slip of this moment, along
    s = u_t/‖u_t‖:

        dJ/dp = n − μ s
        du/dp = K dJ/dp
        dW/dp = u_n

    An impact is a chain of legs of three kinds.

    *The slip keeps its direction*, as in the plane. Then dJ/dp is constant, u
    is linear in p and W quadratic. The leg is one step, up to the end or until
    the slip stops.

    *The slip turns.* Steps of Runge and Kutta follow the equations. The
    smaller the slip is, the faster it turns, so that a step takes away half of
    it at most. Two things end this leg, and the rest is straight: the slip
    would turn no more than rounding before it stops, or it has settled in a
    direction that it keeps. The part that is left across that direction falls
    off, and the faster it does, the shorter the steps would have to be.

    *There is no slip.* It remains zero if friction can hold it, which takes
    the share h = K_tt⁻¹ K_tn of the normal impulse: it sticks if ‖h‖ ≤ μ.
    Otherwise it slips off in the one direction in which it then continues (see
    `direction_of_renewed_slip`).
    """
    every = np.arange(len(target))
    reached = _reached(course, every, course.impulse, course.work, end)
    on = np.flatnonzero(reached < target)
    for _ in range(MOST_ROUNDS):
        if not len(on):
            return
        on = on[~_advance(course, on, end, target[on])]
    raise ValueError(
        "friction or inverse_mass is too extreme to follow an impact: with"
        f" mu = {course.mu[on[0]]:g}"
    )


def direction_of_renewed_slip(k: Array, mu: Array) -> Array:
    """Direction s in which a contact that cannot hold begins to slip.

    Parameters
    ----------
    k : (N, 3, 3), K in the axes of the contact, 1/kg, with ‖K_tt⁻¹ K_tn‖ > μ
    mu : (N,), μ

    Returns
    -------
    (N, 2), unit

    Notes
    -----
    A slip that begins along s has friction −μ s, and it grows along s itself:

        K_tn − μ K_tt s = β s    with β > 0

    So s = (β + μ K_tt)⁻¹ K_tn, and β is where this has length 1. The length
    falls as β grows. It is above 1 at β = 0, and not above 1 at β = ‖K_tn‖.
    Halving finds β.
    """
    pull = k[:, :2, 2]
    rubbing = mu[:, None, None] * k[:, :2, :2]
    low, high = np.zeros(len(mu)), np.linalg.norm(pull, axis=-1)
    for _ in range(HALVINGS):
        beta = (low + high) / 2
        s = _solve(rubbing + beta[:, None, None] * np.eye(2), pull)
        short = np.linalg.norm(s, axis=-1) < 1
        low, high = np.where(short, low, beta), np.where(short, beta, high)
    s = _solve(rubbing + high[:, None, None] * np.eye(2), pull)
    return s / np.linalg.norm(s, axis=-1, keepdims=True)


def _reached(
    course: Course, on: Integers, impulse: Array, work: Array, end: End
) -> Array:
    """How far the contacts `on` are in the quantity with a target, (n,)."""
    if end == "work":
        return work
    if end == "impulse":
        return impulse[:, 2]
    return course.velocity(on, impulse)[:, 2]


def _advance(
    course: Course, on: Integers, end: End, target: Array
) -> Booleans:
    """One leg or step of the contacts `on`; says which of them have ended."""
    k, mu, smallest = course.k[on], course.mu[on], course.smallest[on]
    u = course.velocity(on, course.impulse[on])
    slip = np.linalg.norm(u[:, :2], axis=-1)
    still = slip <= smallest
    s = quotient(u[:, :2], slip[:, None])
    turning, settling, slowing = _turn(course, on, s)
    near = np.minimum(SETTLED, quotient(smallest, slip))
    settled = ~still & (settling > 0) & (np.abs(turning) <= near * settling)
    if np.any(settled):
        turn = (turning[settled] / settling[settled])[:, None]
        kept = s[settled] + turn * _across(s[settled])
        s[settled] = kept / np.linalg.norm(kept, axis=-1, keepdims=True)
        slowing[settled] = _turn(course, on[settled], s[settled])[2]
    push = np.concatenate([-mu[:, None] * s, np.ones((len(on), 1))], axis=-1)
    if np.any(still):
        push[still] = _push_without_slip(k[still], mu[still])
    gain = np.matvec(k, push)[:, 2]
    straight = still | settled
    straight |= np.abs(turning) <= STRAIGHT * course.rate[on]
    straight |= slip * np.abs(turning) <= smallest * slowing
    slows = ~still & (slowing > 0)
    stop = np.where(slows, quotient(slip, slowing), np.inf)
    accepted = np.minimum(course.accepted[on], OF_THE_SLIP * slip)
    done = np.zeros(len(on), dtype=bool)
    legs = (x[straight] for x in (u[:, 2], push, gain, stop, target))
    done[straight] = _leg(course, on[straight], end, *legs)
    steps = (x[~straight] for x in (stop / 2, accepted, target))
    done[~straight] = _steps(course, on[~straight], end, *steps)
    return done


def _turn(
    course: Course, on: Integers, s: Array
) -> tuple[Array, Array, Array]:
    """How fast a slip along s turns, settles and slows down, (n,) each.

    For a unit of normal impulse: the change of the velocity across the slip,
    the share λ with which the part across a kept direction falls, and the loss
    of speed, all in 1/kg.
    """
    mu, across = course.mu[on], _across(s)
    k_tn, k_tt = course.k[on][:, :2, 2], course.k[on][:, :2, :2]
    change = k_tn - mu[:, None] * np.matvec(k_tt, s)
    slowing = -np.vecdot(s, change)
    settling = mu * np.vecdot(across, np.matvec(k_tt, across)) - slowing
    return np.vecdot(across, change), settling, slowing


def _across(s: Array) -> Array:
    """The direction a quarter turn on from s, (n, 2)."""
    return np.stack([-s[:, 1], s[:, 0]], axis=-1)


def _push_without_slip(k: Array, mu: Array) -> Array:
    """Impulse per normal impulse at a contact that does not slip, (n, 3)."""
    hold = -_solve(k[:, :2, :2], k[:, :2, 2])
    lost = np.linalg.norm(hold, axis=-1) > mu
    if np.any(lost):
        s = direction_of_renewed_slip(k[lost], mu[lost])
        hold[lost] = -mu[lost, None] * s
    return np.concatenate([hold, np.ones((len(mu), 1))], axis=-1)


def _leg(
    course: Course,
    on: Integers,
    end: End,
    speed: Array,
    push: Array,
    gain: Array,
    stop: Array,
    target: Array,
) -> Booleans:
    """Advance in a straight leg to the end, or to where the slip stops.

    Parameters
    ----------
    speed : (n,), u_n, m/s
    push : (n, 3), impulse per normal impulse
    gain : (n,), what a unit of normal impulse adds to u_n, 1/kg
    stop : (n,), the normal impulse after which the slip stops, N s

    Returns
    -------
    (n,), bool, which have ended
    """
    impulse, work = course.impulse[on], course.work[on]
    left = target - _reached(course, on, impulse, work, end)
    with np.errstate(divide="ignore", invalid="ignore"):
        if end == "speed":
            whole = np.where(gain > 0, left / gain, np.inf)
        elif end == "impulse":
            whole = left
        else:  # the root of speed p + gain p²/2 = left that does not cancel
            whole = 2 * left / (speed + np.sqrt(speed**2 + 2 * gain * left))
            whole = np.where(np.isnan(whole), np.inf, whole)
    p = np.minimum(whole, stop)
    course.impulse[on] += p[:, None] * push
    course.work[on] += p * (speed + gain * p / 2)
    return whole <= stop


def _steps(
    course: Course,
    on: Integers,
    end: End,
    longest: Array,
    accepted: Array,
    target: Array,
) -> Booleans:
    """Advance by a step of a slip that turns, or by its part up to the end.

    A step that is not accurate enough is not taken, and the next one is
    shorter.

    Parameters
    ----------
    longest : (n,), how long a step may be, as a normal impulse, N s
    accepted : (n,), how wrong it may be, m/s

    Returns
    -------
    (n,), bool, which have ended
    """
    step = np.minimum(course.step[on], longest)
    impulse, work, error = _double_step(course, on, step)
    good = error <= accepted
    longer = 0.9 * (accepted / np.maximum(error, TINY)) ** 0.2
    course.step[on] = step * np.clip(longer, 0.2, 4.0)
    done = good & (_reached(course, on, impulse, work, end) >= target)
    if np.any(done):
        last = on[done]
        part = _part_of_step(course, last, step[done], end, target[done])
        impulse[done], work[done], _ = _double_step(course, last, part)
    course.impulse[on[good]] = impulse[good]
    course.work[on[good]] = work[good]
    return done


def _part_of_step(
    course: Course, on: Integers, step: Array, end: End, target: Array
) -> Array:
    """Part of a step (n,) that leads just to the end, by Newton's method.

    A guess outside the bounds is replaced by their middle.
    """
    low, high, part = np.zeros(len(on)), step, step
    for _ in range(HALVINGS):
        impulse, work, _ = _double_step(course, on, part)
        off = _reached(course, on, impulse, work, end) - target
        low, high = np.where(off < 0, part, low), np.where(off < 0, high, part)
        now = np.concatenate([impulse, work[:, None]], axis=-1)
        growth = _slope(course.start[on], course.k[on], course.mu[on], now)
        speed = np.vecdot(course.k[on, 2], growth[:, :3])
        gains = {"speed": speed, "impulse": growth[:, 2], "work": growth[:, 3]}
        gain = gains[end]
        guess = part - off / np.where(gain > 0, gain, TINY)
        inside = (guess > low) & (guess < high)
        guess = np.where(inside, guess, (low + high) / 2)
        correction = np.abs(guess - part)
        part = guess
        if np.all(correction <= CLOSE * step):
            break
    return part


def _double_step(
    course: Course, on: Integers, step: Array
) -> tuple[Array, Array, Array]:
    """Impulse and work after a step (n,) of p, and the velocity's error, m/s.

    The step is taken once whole and once in two halves. Their difference is
    the error, and the two together are more accurate than either.
    """
    contact = course.start[on], course.k[on], course.mu[on]
    work = course.work[on][:, None]
    now = np.concatenate([course.impulse[on], work], axis=-1)
    whole = _runge_kutta(*contact, now, step)
    half = _runge_kutta(*contact, now, step / 2)
    halves = _runge_kutta(*contact, half, step / 2)
    off = (halves - whole) / 15
    error = np.linalg.norm(np.matvec(course.k[on], off[:, :3]), axis=-1)
    after = halves + off
    return after[:, :3], after[:, 3], error


def _runge_kutta(
    start: Array, k: Array, mu: Array, now: Array, step: Array
) -> Array:
    """Impulse and work, (n, 4), after a step (n,), by the classical rule."""
    h = step[:, None]
    first = _slope(start, k, mu, now)
    second = _slope(start, k, mu, now + h / 2 * first)
    third = _slope(start, k, mu, now + h / 2 * second)
    fourth = _slope(start, k, mu, now + h * third)
    return now + h / 6 * (first + 2 * second + 2 * third + fourth)


def _slope(start: Array, k: Array, mu: Array, now: Array) -> Array:
    """Growth of impulse and work with the normal impulse p, (n, 4)."""
    u = start + np.matvec(k, now[:, :3])
    slip = np.sqrt(np.vecdot(u[:, :2], u[:, :2]))
    friction = quotient(-mu, slip)[:, None] * u[:, :2]
    return np.concatenate([friction, np.ones((len(u), 1)), u[:, 2:]], axis=-1)


def _solve(k: Array, right: Array) -> Array:
    """Solve k x = right for vectors."""
    return np.asarray(np.linalg.solve(k, right[..., None])[..., 0])
