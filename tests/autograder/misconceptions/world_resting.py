"""Known mistakes of contacts that rest together."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M


def resting(g, w, f):
    return g @ w @ np.swapaxes(g, -1, -2), np.matvec(g @ w, f)


def sweep(
    a,
    b,
    sweeps,
    start=0.0,
    update=None,
    order=None,
    jacobi=False,
    last=None,
    limit=None,
    each=lambda f: f,
    reads=lambda row, i: row,
    over=lambda row, i: row[..., i],
):
    a, b = np.asarray(a), np.asarray(b)
    f = np.array(np.broadcast_to(start, np.broadcast_shapes(a.shape[:-1], b.shape, np.shape(start))), dtype=float)
    count = f.shape[-1]
    for k in range(sweeps):
        before = f.copy()
        for i in range(count) if order is None else order(count, k):
            own = over(a[..., i, :], i)
            gap = np.vecdot(reads(a[..., i, :], i), before if jacobi else f) + b[..., i]
            new = update or (lambda f, gap, own: np.maximum(0, f - gap / own))
            with np.errstate(all="ignore"):
                f[..., i] = np.where(own > 0, new(f[..., i], gap, np.where(own > 0, own, 1.0)), 0.0)
        f = each(f)
    return f if last is None else last(f)


def sweeps(**parts):
    return lambda a, b, count, start=0.0: sweep(a, b, count, start, **parts)


# fmt: off
BANK = (
    M("resting_problem", "offset's sign", lambda g, w, f: (g @ w @ np.swapaxes(g, -1, -2), -np.matvec(g @ w, f)),
      "b has the wrong sign: the acceleration of the contacts is A f + b, and b is what the other forces give.",
      "The weight alone: does it bring the bodies nearer to each other? Which sign has that?"),
    M("resting_problem", "force for acceleration",
      lambda g, w, f: (g @ w @ np.swapaxes(g, -1, -2), np.matvec(g + 0 * (g @ w), f)),
      "b is G F: the forces have to become accelerations first.",
      "What unit should b have?"),
    M("resting_problem", "masses left out",
      lambda g, w, f: (g @ np.swapaxes(g, -1, -2) + 0 * (g @ w @ np.swapaxes(g, -1, -2)), np.matvec(g @ w, f)),
      "A is G Gᵀ: how much a force accelerates depends on the masses.",
      "What unit should A have?"),
    M("resting_problem", "mass for its inverse",
      lambda g, w, f: (g @ np.linalg.pinv(w) @ np.swapaxes(g, -1, -2), np.matvec(g @ np.linalg.pinv(w), f)),
      "The matrix given is M⁻¹ already, and is inverted once more.",
      "What does the argument's name say?"),
    M("resting_problem", "inverse masses squared",
      lambda g, w, f: (g @ w @ w @ np.swapaxes(g, -1, -2), np.matvec(g @ w, f)),
      "M⁻¹ comes in twice in A.",
      "What unit should A have?"),
    M("resting_problem", "no coupling",
      lambda g, w, f: ((g @ w @ np.swapaxes(g, -1, -2)) * np.eye(np.shape(g)[-2]), np.matvec(g @ w, f)),
      "Only the diagonal of A is kept: one contact's force would not move another contact.",
      "Push one corner of a table. What do the other legs feel?"),
    M("resting_problem", "masses left out in the offset",
      lambda g, w, f: (g @ w @ np.swapaxes(g, -1, -2), np.matvec(g @ w @ w, f)),
      "M⁻¹ comes in twice in b.",
      "What unit should b have?"),
    M("resting_problem", "sign of A", lambda g, w, f: (-(g @ w @ np.swapaxes(g, -1, -2)), np.matvec(g @ w, f)),
      "A has the wrong sign: a contact force that pushes drives the bodies apart.",
      "Which sign has A_ii?"),
    M("resting_problem", "only what presses", lambda g, w, f: (resting(g, w, f)[0], np.minimum(resting(g, w, f)[1], 0)),
      "Offsets above zero are set to zero: a contact that the load lifts off would not know of it.",
      "The load lifts one side of a box. Which sign has b there?"),
    M("resting_problem", "no negative coupling", lambda g, w, f: (np.abs(resting(g, w, f)[0]), resting(g, w, f)[1]),
      "The sizes of the numbers in A are taken: a force at one contact may well press another one together.",
      "Push up one end of a seesaw. Which way does the other end move?"),
    M("resting_problem", "upper triangle", lambda g, w, f: (np.triu(resting(g, w, f)[0]), resting(g, w, f)[1]),
      "The numbers of A below its diagonal are left out.",
      "What does the first contact do to the second one, and the second one to the first?"),
    M("resting_problem", "rows of length one",
      lambda g, w, f: resting(g / np.linalg.norm(g, axis=-1, keepdims=True), w, f),
      "The rows of G are made unit vectors first. They have arms in them, and their length counts.",
      "Which part of a row of G says how far the contact is from the middle of the body?"),
    M("resting_problem", "each component alone",
      lambda g, w, f: resting(g, w * np.eye(np.shape(w)[-1]), f),
      "Only the diagonal of M⁻¹ is used; the inverse inertia of a body that does not stand along the axes has more.",
      "What does the inverse inertia of a turned box look like?"),
    M("solve_by_sweeps", "old forces", sweeps(jacobi=True),
      "All contacts of a sweep use the forces from before it: that is Jacobi's method. "
      "Gauss and Seidel use what is there already.",
      "When the second contact has its turn, which force has the first?"),
    M("solve_by_sweeps", "may pull", sweeps(update=lambda f, gap, own: f - gap / own),
      "The clamp at zero is missing: contacts pull.",
      "Can a floor pull?"),
    M("solve_by_sweeps", "change clamped", sweeps(update=lambda f, gap, own: f + np.maximum(0, -gap / own)),
      "The change is clamped at zero, not the force: what was given too much can never be taken back.",
      "A later contact lifts the body off. May an earlier one let go?"),
    M("solve_by_sweeps", "clamped at the end",
      sweeps(update=lambda f, gap, own: f - gap / own, last=lambda f: np.maximum(f, 0)),
      "The forces are clamped once at the end: meanwhile the others have answered to contacts that pull.",
      "What does a neighbour make of a negative force?"),
    M("solve_by_sweeps", "clamped after each sweep",
      sweeps(update=lambda f, gap, own: f - gap / own, each=lambda f: np.maximum(f, 0)),
      "The forces are clamped at the end of each sweep: within it the others have answered to contacts that pull.",
      "What does a neighbour make of a negative force?"),
    M("solve_by_sweeps", "to and fro", sweeps(order=lambda count, k: range(count)[:: -1 if k % 2 else 1]),
      "Every second sweep goes backwards; the description always begins with the first contact.",
      "Which contact comes first in the second sweep?"),
    M("solve_by_sweeps", "over the sum of the row", sweeps(over=lambda row, i: np.sum(np.abs(row), axis=-1)),
      "The gap is divided by the sum of the row in place of A_ii.",
      "By how much does a unit force at contact i move contact i itself?"),
    M("solve_by_sweeps", "later contacts left out", sweeps(reads=lambda row, i: row * (np.arange(row.shape[-1]) <= i)),
      "A contact knows of those before it and of itself, and not of those behind it.",
      "What do the contacts carry that have had no turn yet in this sweep?"),
    M("solve_by_sweeps", "not over the diagonal", sweeps(update=lambda f, gap, own: np.maximum(0, f - gap)),
      "The gap is not divided by A_ii: an acceleration is taken from a force.",
      "What unit has (A f + b)_i?"),
    M("solve_by_sweeps", "gap's sign", sweeps(update=lambda f, gap, own: np.maximum(0, f + gap / own)),
      "The sign is wrong: a contact that is pressed on gets less force.",
      "The gap is negative. Should the force grow or fall?"),
    M("solve_by_sweeps", "own force forgotten", sweeps(update=lambda f, gap, own: np.maximum(0, -gap / own)),
      "The force is set to the change: what the contact carried already is lost.",
      "The gap is zero. What should become of the force?"),
    M("solve_by_sweeps", "start left out", lambda a, b, count, start=0.0: sweep(a, b, count, 0.0 * np.asarray(start)),
      "It always begins with no forces.",
      "Which argument makes no difference to your answer?"),
    M("solve_by_sweeps", "backwards", sweeps(order=lambda count, k: reversed(range(count))),
      "The contacts are gone through from the last to the first; the description goes contact after contact.",
      "Which contact comes first?"),
    M("solve_by_sweeps", "one sweep too few", lambda a, b, count, start=0.0: sweep(a, b, max(count - 1, 0), start),
      "There is one sweep too few.",
      "How often does range(1, n) go round?"),
    M("solve_by_sweeps", "one sweep", lambda a, b, count, start=0.0: sweep(a, b, min(count, 1), start),
      "There is one sweep, whatever number is asked for.",
      "Which argument makes no difference to your answer?"),
    M("solve_by_sweeps", "one sweep too many", lambda a, b, count, start=0.0: sweep(a, b, count + 1, start),
      "There is one sweep too many.",
      "What should come out after no sweep at all?"),
    M("solve_by_sweeps", "offset's sign", lambda a, b, count, start=0.0: sweep(a, -np.asarray(b), count, start),
      "The offset has the wrong sign: the gap is (A f + b)_i.",
      "Which sign has b in the problem?"),
    M("solve_by_sweeps", "absolute value", sweeps(update=lambda f, gap, own: np.abs(f - gap / own)),
      "The absolute value is taken in place of the clamp: a contact that lifts off gets a force.",
      "What should the force of a contact be that lifts off?"),
    M("solve_by_sweeps", "no coupling",
      lambda a, b, count, start=0.0: sweep(np.asarray(a) * np.eye(np.shape(a)[-1]), b, count, start),
      "Each contact is solved on its own: what the others carry makes no difference.",
      "Push one corner of a table. What do the other legs feel?"),
)
# fmt: on
