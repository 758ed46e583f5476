"""Known mistakes of springs and dampers, of the longest stable steps, and of the sum of all forces."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import col, direction, dot, flat, formulas_of, over, size

FORCES = formulas_of("forces")


def along(relative, u):
    """The part of the relative velocity along the spring."""
    return dot(relative, u) * u


def spring(
    pull=lambda k, length, rest: -k * (length - rest),
    damper=lambda c, relative, u: -c * along(relative, u),
    relative=lambda v1, v2: v1 - v2,
    way=direction,
):
    """A spring with a damper from its parts."""

    def force(x1, x2, v1, v2, k, rest, c):
        x1, x2, v1, v2 = (np.asarray(each, dtype=float) for each in (x1, x2, v1, v2))
        d = x1 - x2
        u = way(d)
        return pull(col(k), size(d), col(rest)) * u + damper(col(c), relative(v1, v2), u)

    return force


def nan_without_length(x1, x2, v1, v2, k, rest, c):
    return spring(way=lambda d: d / size(d))(x1, x2, v1, v2, k, rest, c)


def rest_along_x(x1, x2, v1, v2, k, rest, c):
    """The rest length is taken from each component."""
    x1, x2, v1, v2 = (np.asarray(each, dtype=float) for each in (x1, x2, v1, v2))
    d = x1 - x2
    return -col(k) * (d - col(rest)) - col(c) * along(v1 - v2, direction(d))


def vector_times_stretch(x1, x2, v1, v2, k, rest, c):
    """The stretch times the whole vector between the ends."""
    d = np.asarray(x1, dtype=float) - x2
    return -col(k) * (size(d) - col(rest)) * d - col(c) * along(np.asarray(v1, dtype=float) - v2, direction(d))


def limits(explicit=None, semi=None):
    """Both limits, one of them wrong: functions of frequency, damping ratio and damping, stiffness, mass."""

    def right_explicit(w, z, c, k, m):
        root = np.sqrt(np.maximum(z * z - 1, 0))
        return np.where(z <= 1, 2 * z / w, 2 / (w * (z + root)))

    def right_semi(w, z, c, k, m):
        return 2 * (np.sqrt(1 + z * z) - z) / w

    def both(k, m, c):
        k, m, c = np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in (k, m, c)))
        given = np.sqrt(k / m), c / (2 * np.sqrt(k * m)), c, k, m
        return (explicit or right_explicit)(*given), (semi or right_semi)(*given)

    return both


def swapped(k, m, c):
    return limits()(k, m, c)[::-1]


RIGHT_DRAG, RIGHT_SPRING = FORCES.drag(), spring()


def total(
    weight=lambda m, g: m * g,
    drag=RIGHT_DRAG,
    pull=RIGHT_SPRING,
    first=1.0,
    second=-1.0,
    adds=True,
    used=lambda ends: ends,
):
    """The sum of all forces from its parts: how much of a pull each end gets, and whether pulls are added up."""

    def force(x, v, m, r, g, viscosity, stream, ends, k, rest, c):
        x, v, m = (np.asarray(each, dtype=float) for each in (x, v, m))
        found = weight(m[:, None], np.asarray(g)) + drag(v, stream, viscosity, r)
        start = found.copy()
        pairs = used(np.asarray(ends, dtype=int))
        for at, (a, b) in enumerate(pairs):
            on_a = pull(x[a], x[b], v[a], v[b], np.asarray(k)[at], np.asarray(rest)[at], np.asarray(c)[at])
            for end, share in ((a, first), (b, second)):
                found[end] = (found if adds else start)[end] + share * on_a
        return found

    return force


def springs_alone(*given):
    return total(weight=lambda m, g: 0 * m * g, drag=lambda v, u, eta, r: 0 * v)(*given)


def all_on_one(x, v, m, r, g, viscosity, stream, ends, k, rest, c):
    """Each spring pulls every ball."""
    found = total(used=lambda ends: ends[:0])(x, v, m, r, g, viscosity, stream, ends, k, rest, c)
    x, v = np.asarray(x, dtype=float), np.asarray(v, dtype=float)
    for at, (a, b) in enumerate(ends):
        found = found + spring()(x[a], x[b], v[a], v[b], np.asarray(k)[at], np.asarray(rest)[at], np.asarray(c)[at])
    return found


def one_assignment(x, v, m, r, g, viscosity, stream, ends, k, rest, c):
    """Without a loop, and with indices that come more than once."""
    x, v = np.asarray(x, dtype=float), np.asarray(v, dtype=float)
    found = total(used=lambda ends: ends[:0])(x, v, m, r, g, viscosity, stream, ends, k, rest, c)
    a, b = np.asarray(ends).T
    pulls = spring()(x[a], x[b], v[a], v[b], k, rest, c)
    found[a] += pulls
    found[b] -= pulls
    return found


def same_numbers(x, v, m, r, g, viscosity, stream, ends, k, rest, c):
    first = (np.full(len(ends), each[0]) if len(ends) else each for each in (k, rest, c))
    return total()(x, v, m, r, g, viscosity, stream, ends, *first)


# fmt: off
BANK = (
    M("spring_damper_force", "spring pushes", spring(pull=lambda k, length, rest: k * (length - rest)),
      "The spring has the sign of slides 27 and 29, or its direction points the other way: stretched, it pushes its"
      " ends farther apart.",
      "Pull the ball away from the wall. Which way does the spring pull it, and which way does yours?"),
    M("spring_damper_force", "damper drives", spring(damper=lambda c, w, u: c * along(w, u)),
      "The damper has the wrong sign, or the velocities are subtracted the other way round than the positions: it makes"
      " every motion of the spring faster.",
      "The spring becomes longer. Which way should the damper pull end 1?"),
    M("spring_damper_force", "both signs",
      spring(lambda k, length, rest: k * (length - rest), lambda c, w, u: c * along(w, u)),
      "It is the force on end 2.",
      "Which of the two ends does the description ask about?"),
    M("spring_damper_force", "slide's damper", spring(damper=lambda c, w, u: -c * w),
      "The damper brakes the whole relative velocity. Only its part along the spring changes the length; a spring that"
      " turns as a whole is not damped.",
      "The ends circle around each other at the same distance. Does the length change?"),
    M("spring_damper_force", "damped in space",
      spring(damper=lambda c, w, u: -c * w, relative=lambda v1, v2: v1 + 0 * v2),
      "The damper brakes end 1 itself, with −k_d v as slide 29 prints it. A spring that flies as a whole would be"
      " stopped.",
      "Throw a spring. What brakes it, apart from the air?"),
    M("spring_damper_force", "end 2 does not move", spring(relative=lambda v1, v2: v1 + 0 * v2),
      "The velocity of end 2 is left out.",
      "End 1 is held and end 2 moves away. Does the damper feel that?"),
    M("spring_damper_force", "velocities added", spring(relative=lambda v1, v2: v1 + v2),
      "The velocities of the ends are added up. The length changes with their difference.",
      "Both ends move with the same velocity. How fast does the length change?"),
    M("spring_damper_force", "rest length left out", spring(pull=lambda k, length, rest: -k * length + 0 * rest),
      "The rest length makes no difference.",
      "How large is the force of a spring at its rest length?"),
    M("spring_damper_force", "vector times stretch", vector_times_stretch,
      "The stretch is multiplied with the whole vector between the ends, and not with the unit vector.",
      "How long is the vector that gives your force its direction?"),
    M("spring_damper_force", "whole vector for the direction", spring(way=lambda d: d),
      "The vector between the ends is used as if it had the length 1, in the spring and twice in the damper.",
      "How long is the vector that gives your force its direction?"),
    M("spring_damper_force", "whole vector for both", lambda x1, x2, v1, v2, k, rest, c: size(
        np.asarray(x1, dtype=float) - x2) * spring()(x1, x2, v1, v2, k, rest, c),
      "The force is multiplied with the whole vector between the ends, and not with the unit vector.",
      "How long is the vector that gives your force its direction?"),
    M("spring_damper_force", "rate from the whole vector", lambda x1, x2, v1, v2, k, rest, c: spring()(
        x1, x2, v1, v2, k, rest, np.asarray(c, dtype=float) * flat(size(np.asarray(x1, dtype=float) - x2))),
      "The rate at which the length changes is the product with the unit vector. Yours is too large by the length.",
      "The ends part with 1 m/s, straight away from each other. How fast does the length change?"),
    M("spring_damper_force", "rest length from each component", rest_along_x,
      "The rest length is taken away from each component. It belongs to the length of the spring.",
      "A spring of length 1 m along x is at rest. Which force along y does your function give?"),
    M("spring_damper_force", "never pushes", spring(pull=lambda k, length, rest: -k * np.maximum(length - rest, 0)),
      "A compressed spring exerts no force, like a rope. It pushes.",
      "Press a spring together. What do you feel?"),
    M("spring_damper_force", "size of the stretch", spring(pull=lambda k, length, rest: -k * np.abs(length - rest)),
      "The size of the stretch is taken, so that a compressed spring pulls as well.",
      "Press a spring together. Which way does it push?"),
    M("spring_damper_force", "no damper", spring(damper=lambda c, w, u: 0 * c * w),
      "The damper is missing.",
      "Which arguments make no difference to your answer?"),
    M("spring_damper_force", "no spring", spring(pull=lambda k, length, rest: 0 * k * length),
      "The spring is missing.",
      "Which arguments make no difference to your answer?"),
    M("spring_damper_force", "NaN without length", nan_without_length,
      "Where both ends are at the same place, the function returns NaN, because it divides zero by zero. The"
      " description"
      " says what it should return.",
      "What do you divide by where both ends are at the same place?"),
    M("spring_damper_force", "relative change", spring(pull=lambda k, length, rest: -k * over(length - rest, rest, 0)),
      "The stretch is divided by the rest length. The stiffness of this lab is in N/m, so it multiplies metres.",
      "Which unit has k times a strain?"),
    M("spring_damper_force", "stretch squared",
      spring(pull=lambda k, length, rest: -k * (length - rest) * np.abs(length - rest)),
      "The stretch is squared. The energy has a square; the force is proportional to the stretch.",
      "Pull twice as far. By which factor does the force grow?"),
    M("spring_damper_force", "half the stiffness", spring(pull=lambda k, length, rest: -k * (length - rest) / 2),
      "The spring is half as stiff as it should be. The ½ belongs to the energy.",
      "Hang 1 N on a spring of 1 N/m. By how much does it stretch?"),
    M("spring_damper_force", "damped in proportion to the length", spring(damper=lambda c, w, u: -c * dot(w, u) * w),
      "The rate at which the length changes is multiplied with the relative velocity, and not with the direction of the"
      " spring.",
      "Along which line does a damper act?"),
    M("spring_damper_force", "size of the rate", spring(damper=lambda c, w, u: -c * size(w) * u),
      "The damper takes the size of the relative velocity for the rate at which the length changes. It pulls the ends"
      " together even where they approach.",
      "The ends approach each other. Which way should the damper push?"),
    M("spring_damper_force", "always pushes", spring(damper=lambda c, w, u: c * np.abs(dot(w, u)) * u),
      "The size of the rate is taken, so that the damper pushes the ends apart whether they part or approach.",
      "The ends part. Which way should the damper push or pull?"),
    M("spring_damper_force", "always pulls", spring(damper=lambda c, w, u: -c * np.abs(dot(w, u)) * u),
      "The size of the rate is taken, so that the damper pulls the ends together whether they part or approach.",
      "The ends approach each other. Which way should the damper push?"),
    M("spring_damper_force", "difference of the speeds", lambda x1, x2, v1, v2, k, rest, c: spring(
        damper=lambda c, w, u: 0 * w)(x1, x2, v1, v2, k, rest, c) - col(c) * (size(v1) - size(v2)) * direction(
            np.asarray(x1, dtype=float) - x2),
      "The difference of the two speeds is taken for the rate at which the length changes.",
      "The ends fly apart, equally fast. How fast does the length change?"),
    M("spring_step_limit", "swapped", swapped,
      "The two results are in the wrong order.",
      "In which order does the description list them?"),
    M("spring_step_limit", "semi-implicit without the damper", limits(semi=lambda w, z, c, k, m: 2 / w),
      "The limit of semi-implicit Euler is that of a spring without a damper. A damper makes it shorter.",
      "Make the damper very strong. Which of the two forces is the stiff one then?"),
    M("spring_step_limit", "damper makes it longer",
      limits(semi=lambda w, z, c, k, m: 2 * (np.sqrt(1 + z * z) + z) / w),
      "A damper makes your limit of semi-implicit Euler longer. You took the other root of the quadratic.",
      "What does the force of the damper do in a step that is too long for it?"),
    M("spring_step_limit", "explicit never stable", limits(explicit=lambda w, z, c, k, m: 0 * w),
      "Explicit Euler is said to be unstable always. That is true without a damper; with one there is a step that is"
      " short enough.",
      "How much energy does the damper take away in a short step, and how much does the step add?"),
    M("spring_step_limit", "explicit without the damper", limits(explicit=lambda w, z, c, k, m: 2 / w),
      "The limit of explicit Euler is taken to be 2/ω, which is that of semi-implicit Euler.",
      "Without a damper, does a swing grow in a short step of explicit Euler?"),
    M("spring_step_limit", "explicit underdamped always", limits(explicit=lambda w, z, c, k, m: c / k),
      "The limit of explicit Euler is c/k however strong the damper is. Beyond critical damping another condition comes"
      " first.",
      "Make the damper very strong. Can explicit Euler take longer and longer steps?"),
    M("spring_step_limit", "explicit of the damper alone", limits(explicit=lambda w, z, c, k, m: over(2 * m, c)),
      "The limit of explicit Euler is that of the damper alone, 2m/c.",
      "What remains of your limit if there is hardly any damper?"),
    M("spring_step_limit", "semi-implicit of the damper alone", limits(semi=lambda w, z, c, k, m: over(2 * m, c)),
      "The limit of semi-implicit Euler is that of the damper alone.",
      "Which argument makes no difference to your second answer?"),
    M("spring_step_limit", "smaller of the two", limits(semi=lambda w, z, c, k, m: np.minimum(2 / w, over(2 * m, c))),
      "The spring alone and the damper alone are asked for their limits, and the smaller one is taken. Together they"
      " allow less than either.",
      "What does one step do to a body on which both act?"),
    M("spring_step_limit", "frequency for its square",
      limits(semi=lambda w, z, c, k, m: 2 * (np.sqrt(1 + z * z) - z) / w**2),
      "ω² = k/m is taken for ω.",
      "Which unit has your limit?"),
    M("spring_step_limit", "explicit half", limits(explicit=lambda w, z, c, k, m: limits()(k, m, c)[0] / 2),
      "The limit of explicit Euler is half of what it should be.",
      "By which factor does one step multiply the motion? Expand the square of its size."),
    M("spring_step_limit", "slow rate", limits(explicit=lambda w, z, c, k, m: np.where(
        z <= 1, 2 * z / w, 2 * (z + np.sqrt(np.maximum(z * z - 1, 0))) / w)),
      "Of the two rates of an overdamped motion the slow one is taken. The fast one limits the step.",
      "Which of the two motions does a long step make explode?"),
    M("spring_step_limit", "critical at c² = km", limits(explicit=lambda w, z, c, k, m: np.where(
        z <= 0.5, 2 * z / w, 2 / (w * (z + np.sqrt(np.maximum(z * z - 1, 0)))))),
      "The two cases of explicit Euler change over at the wrong damping.",
      "At which damping does the motion no longer swing?"),
    M("spring_step_limit", "NaN where it does not swing", limits(explicit=lambda w, z, c, k, m: np.where(
        z <= 1, 2 * z / w, np.nan)),
      "Where the motion does not swing, the limit of explicit Euler is NaN.",
      "Which square root do you take, and of what?"),
    M("spring_step_limit", "period", limits(semi=lambda w, z, c, k, m: 2 * np.pi / w),
      "The limit of semi-implicit Euler is taken to be the period of the swing.",
      "How often does a step look at the spring if it is as long as the period?"),
    M("spring_step_limit", "twice the damping ratio",
      limits(semi=lambda w, z, c, k, m: 2 * (np.sqrt(1 + 4 * z * z) - 2 * z) / w),
      "The damping ratio is twice too large: it is c/(2√(k m)).",
      "At which c does the motion of a damped spring stop swinging?"),
    M("spring_step_limit", "damping ratio without the 2", lambda k, m, c: limits()(k, m, 2 * np.asarray(c)),
      "The damping ratio is twice too large in both limits: it is c/(2√(k m)).",
      "At which c does the motion of a damped spring stop swinging?"),
    M("spring_step_limit", "ω² for ω in both", lambda k, m, c: tuple(
        each * np.sqrt(np.asarray(m, dtype=float) / k) for each in limits()(k, m, c)),
      "ω² = k/m is taken for ω.",
      "Which unit has your limit?"),
    M("spring_step_limit", "each from one half", limits(lambda w, z, c, k, m: c / k, lambda w, z, c, k, m: 2 / w),
      "The limit of explicit Euler is that of a motion that swings, and that of semi-implicit Euler is that of a spring"
      " without a damper.",
      "Make the damper very strong. Which of your two limits changes, and in which direction?"),
    M("total_force", "second end pulled alike", total(second=1.0),
      "Both ends of a spring are pulled with the same force. By Newton's third law the second one gets the opposite.",
      "A stretched spring pulls its ends together. Which way is each of them pulled?"),
    M("total_force", "first end alone", total(second=0.0),
      "Only the first end of each spring is pulled. The second end gets the opposite force.",
      "Hang a ball on a spring in the hand. What does the hand feel?"),
    M("total_force", "ends exchanged", total(first=-1.0, second=1.0),
      "The force of a spring is given to the wrong end: stretched springs push their balls apart.",
      "On which of the two ends is the force that `spring_damper_force` returns?"),
    M("total_force", "last spring only", total(adds=False),
      "Where a ball has several springs, only the last one counts: the others are overwritten.",
      "A ball hangs on two springs. How many of them pull it in your function?"),
    M("total_force", "several springs in one assignment", one_assignment,
      "All springs are added in one assignment, F[ends] += pulls. NumPy keeps only the last pull for a ball"
      " that is named"
      " several times, without an error.",
      "A ball is the first end of two springs. How many of them pull it in your function?"),
    M("total_force", "numbers of the first spring", same_numbers,
      "All springs have the stiffness, the rest length and the damping of the first one.",
      "Which index do the numbers of a spring have in your loop?"),
    M("total_force", "accelerations", lambda *given: total()(*given) / np.asarray(given[2], dtype=float)[:, None],
      "The function returns accelerations: the forces are divided by the masses.",
      "Which unit does the description give for the result?"),
    M("total_force", "weights left out", total(weight=lambda m, g: 0 * m * g),
      "The weights are missing.",
      "Which argument makes no difference to your answer?"),
    M("total_force", "acceleration for weight", total(weight=lambda m, g: g + 0 * m),
      "The acceleration of free fall is added to forces. A weight has the mass in it.",
      "How large is the weight of a ball of 2 kg?"),
    M("total_force", "drags left out", total(drag=lambda v, u, eta, r: 0 * v),
      "The drag of the fluid is missing.",
      "Which arguments make no difference to your answer?"),
    M("total_force", "drag in still fluid", total(drag=FORCES.drag(relative=lambda v, u: v + 0 * u)),
      "The velocity of the fluid is left out.",
      "A leaf drifts along with a river. What does your function say that it feels?"),
    M("total_force", "springs alone", springs_alone,
      "Only the springs are there: weights and drags are missing.",
      "Which arguments make no difference to your answer?"),
    M("total_force", "springs left out", total(used=lambda ends: ends[:0]),
      "The springs are missing.",
      "Which arguments make no difference to your answer?"),
    M("total_force", "first spring only", total(used=lambda ends: ends[:1]),
      "Only the first spring is there.",
      "How often does your loop run? Where is its return?"),
    M("total_force", "undamped springs", total(pull=spring(damper=lambda c, w, u: 0 * c * w)),
      "The dampers of the springs are missing.",
      "Which argument makes no difference to your answer?"),
    M("total_force", "every ball on every spring", all_on_one,
      "Each spring pulls all balls of the scene.",
      "Which balls does a spring pull that joins the first two?"),
)
# fmt: on
