"""Known mistakes of the loop of a ball over a plane: what it looks at, in which order, and what it carries on."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import col, dot, flat, formulas_of

RESPONSE = formulas_of("response")
flight, respond, at_step, semi_euler = (
    getattr(RESPONSE, name) for name in ("flight", "respond", "at_step", "semi_euler")
)


def gap(p, n, d):
    return flat(dot(p, n)) + np.asarray(d)


def behind(p, v, a, n, d, dt):
    return gap(p, n, d) < 0


def looking(look):
    """A step whose look at the plane is another one, from the state at its start."""

    def step(p, v, a, n, d, e, dt):
        return at_step(p, v, a, n, look(p, v, a, n, d, dt), e, dt)

    return step


right = looking(behind)


def looped(step, kept=lambda start, now: now):
    """A run of such steps. kept: the state from which the next step starts, from that of the run's start and of now."""

    def run(p, v, a, n, d, e, dt, steps):
        rows = [started(p, v, a, n, d, e, dt)]
        for _ in range(steps):
            rows.append(step(*kept(rows[0], rows[-1]), a, n, d, e, dt))
        return tuple(np.array(column) for column in zip(*rows, strict=True))

    return run


def started(p, v, a, n, d, e, dt):
    """The start, as often as there are balls."""
    p, v, *_ = np.broadcast_arrays(p, v, a, n, col(d), col(e), col(dt))
    return p, v


def looks_once(p, v, a, n, d, e, dt, steps):
    once = gap(p, n, d) < 0
    return looped(lambda p, v, a, n, d, e, dt: at_step(p, v, a, n, once, e, dt))(p, v, a, n, d, e, dt, steps)


def after(move):
    """It moves first, looks where it is then, and responds there."""

    def step(p, v, a, n, d, e, dt):
        p, v = move(p, v, a, dt)
        return p, np.where(col(gap(p, n, d) < 0) > 0, respond(v, n, e), v)

    return step


def put_back(p, v, a, n, d, e, dt):
    """A ball behind the plane is set on it before its step."""
    s = gap(p, n, d)
    return at_step(p - col(np.minimum(s, 0)) * n, v, a, n, s < 0, e, dt)


def weight_kept(p, v, a, n, d, e, dt):
    """The response, and then a free step, as if nothing carried the ball."""
    return semi_euler(p, np.where(col(gap(p, n, d) < 0) > 0, respond(v, n, e), v), a, dt)


def one_step_late(*given):
    """The state is noted before the step and not after it."""
    return tuple(np.concatenate([rows[:1], rows])[: len(rows)] for rows in looped(right)(*given))


def last_everywhere(*given):
    """One array in all rows, which every step writes to."""
    return tuple(np.array([rows[-1]] * len(rows)) for rows in looped(right)(*given))


def reversed_outputs(*given):
    return looped(right)(*given)[::-1]


# fmt: off
BANK = (
    M("bounce", "side for behind", looped(looking(lambda p, v, a, n, d, dt: gap(p, n, d) != 0)),
      "What `side_of_plane` returns goes into `respond_at_step` as it is. It is −1, 0 or 1, and Python takes both 1 "
      "and −1 for true: a ball in front of the plane responds as well.",
      "What is bool(1), what is bool(−1), and which of the two is behind?"),
    M("bounce", "always behind", looped(looking(lambda p, v, a, n, d, dt: gap(p, n, d) < np.inf)),
      "Every ball that moves towards the plane responds, wherever it is: nothing looks for a collision.",
      "A ball falls from ten metres. When should it respond for the first time?"),
    M("bounce", "in front for behind", looped(looking(lambda p, v, a, n, d, dt: gap(p, n, d) > 0)),
      "The test is the wrong way round: the ball responds in front of the plane and falls through it.",
      "Which sign has the separation of a ball behind the plane?"),
    M("bounce", "never looks", looped(looking(lambda p, v, a, n, d, dt: gap(p, n, d) > np.inf)),
      "The ball falls through the plane: it never responds.",
      "Print `behind` in every step. When does it become true?"),
    M("bounce", "touching is behind", looped(looking(lambda p, v, a, n, d, dt: gap(p, n, d) <= 0)),
      "A ball whose centre is exactly on the plane responds already. `side_of_plane` is 0 there, and behind is −1.",
      "What does the description say of touching?"),
    M("bounce", "looks once", looks_once,
      "The look at the plane is taken before the loop, once for all steps. The ball moves, so it may be in front of "
      "the plane in one step and behind it in the next.",
      "Which of your lines have to run again in every step?"),
    M("bounce", "looks ahead",
      looped(looking(lambda p, v, a, n, d, dt: gap(flight(p, v, a, dt)[0], n, d) < 0)),
      "The loop looks where the ball would be at the end of the step, and responds before it has arrived. "
      "It turns round above the plane.",
      "Where is the ball at the time at which you look? And where at the time at which it responds?"),
    M("bounce", "looks along the old way",
      looped(looking(lambda p, v, a, n, d, dt: gap(np.asarray(p) + np.asarray(v) * col(dt), n, d) < 0)),
      "The loop looks at p + v Δt, where the ball is not yet, and responds before it has arrived. "
      "It turns round above the plane.",
      "Where is the ball at the time at which you look? And where at the time at which it responds?"),
    M("bounce", "steps, then responds", looped(after(semi_euler)),
      "The ball takes its step first, and the loop looks and responds at the end of it. "
      "This order costs as much, and its apex is lower by (1 + e) v Δt/2 on average instead of (1 − e) v Δt/2.",
      "Which of the three comes first in a step: look, respond or move?"),
    M("bounce", "flies, then responds", looped(after(flight)),
      "The ball flies exactly over the whole step, and the loop looks and responds at the end of it. "
      "This order costs as much, and its apex is lower by (1 − e²) v Δt/2 on average instead of (1 − e) v Δt/2.",
      "Which of the three comes first in a step: look, respond or move?"),
    M("bounce", "put back on the plane", looped(put_back),
      "A ball behind the plane is moved back onto it before it takes its step. "
      "That adds height which it did not have, and the contract leaves it where it is.",
      "Lift a ball by 5 cm in every bounce. What does that do to its energy?"),
    M("bounce", "weight not carried", looped(weight_kept),
      "The ball responds and then takes a free step, in which its weight pulls it back at once. "
      "In the step of the response the plane carries the weight: `respond_at_step` does both.",
      "Do you call respond_at_step, or kinematic_response and a step of your own?"),
    M("bounce", "offset left out", looped(looking(lambda p, v, a, n, d, dt: gap(p, n, 0 * np.asarray(d)) < 0)),
      "The plane goes through the origin, whatever its offset: n·p + d lacks the d.",
      "Which argument makes no difference to your answer?"),
    M("bounce", "offset subtracted", looped(looking(lambda p, v, a, n, d, dt: gap(p, n, -np.asarray(d)) < 0)),
      "The plane is taken as n·p = d. The lab writes n·p + d = 0, so that a floor 2 m up has d = −2.",
      "Which sign has n·p + d of a point in front of the plane?"),
    M("bounce", "old velocity in every step", looped(right, lambda start, now: (now[0], start[1])),
      "Each step starts with the velocity of the start: what the last step has made of it is lost.",
      "Which two variables have to change at the end of each step?"),
    M("bounce", "old position in every step", looped(right, lambda start, now: (start[0], now[1])),
      "Each step starts from the position of the start: what the last step has made of it is lost.",
      "Which two variables have to change at the end of each step?"),
    M("bounce", "the first step again and again", looped(right, lambda start, now: start),
      "Every step starts from the start, so that all rows but the first are the same.",
      "Which two variables have to change at the end of each step?"),
    M("bounce", "one step late", one_step_late,
      "The state is noted before its step and not after it: the start appears twice, and the last step is missing.",
      "What should the second row be, after one step?"),
    M("bounce", "every row is the last", last_everywhere,
      "All rows are one and the same array: `p += …` writes into the array that is in the list already. "
      "`p = p + …` makes a new one.",
      "Append an array to a list, change it, and print the list. What is in it?"),
    M("bounce", "velocities first", reversed_outputs,
      "The velocities are returned first, the positions second.",
      "In which order does the description name what is returned?"),
)
# fmt: on
