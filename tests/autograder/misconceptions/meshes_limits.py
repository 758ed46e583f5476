"""Known mistakes about which springs a lattice needs, and about the timestep that a mesh allows."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M


def stretches(position, pairs, both=(1, -1), axes=3):
    """For each pair a row of numbers: a motion of all nodes times it is the stretch."""
    p, ends = np.asarray(position, dtype=float), np.asarray(pairs)
    rows = np.zeros((len(ends), len(p), axes))
    for number, (one, other) in enumerate(ends.tolist()):
        way = p[one] - p[other]
        long = np.linalg.norm(way)
        u = (way / long if long > 0 else way)[:axes]
        rows[number, one], rows[number, other] = both[0] * u, both[1] * u
    return rows.reshape(len(ends), axes * len(p))


def rank(rows):
    return int(np.linalg.matrix_rank(rows)) if rows.size else 0


def chosen(rows=stretches, known=lambda before, needed: before):
    """Candidate by candidate. known: what the next one is compared with, of the rows with this one and without."""

    def found(position, edges, candidates):
        before, flags = rows(position, edges), []
        for row in rows(position, candidates):
            more = np.vstack([before, row])
            flags.append(rank(more) > rank(before))
            before = known(more if flags[-1] else before, before)
        return np.array(flags, dtype=bool)

    return found


def right(position, edges, candidates):
    return chosen()(position, edges, candidates)


def counted(motions, places=lambda missing, flags: np.flatnonzero(flags >= 0)[: max(missing, 0)]):
    """As many as the count says, whichever come first."""

    def found(position, edges, candidates):
        flags = np.zeros(len(candidates), dtype=bool)
        flags[places(3 * len(position) - motions - len(edges), flags)] = True
        return flags

    return found


def joins_parts(position, edges, candidates):
    """Whether it joins two nodes that no chain of springs joins."""
    part = list(range(len(position)))
    flags = []
    for number, (one, other) in enumerate([*np.asarray(edges).tolist(), *np.asarray(candidates).tolist()]):
        new = part[one] != part[other]
        part = [part[one] if each == part[other] else each for each in part]
        if number >= len(edges):
            flags.append(new)
    return np.array(flags, dtype=bool)


def not_there_yet(position, edges, candidates):
    there, flags = {frozenset(each) for each in np.asarray(edges).tolist()}, []
    for each in np.asarray(candidates).tolist():
        flags.append(frozenset(each) not in there)
        there.add(frozenset(each))
    return np.array(flags, dtype=bool)


def backwards(position, edges, candidates):
    return right(position, edges, np.asarray(candidates)[::-1])[::-1]


def until_rigid(position, edges, candidates):
    """All of them, up to the one that leaves six motions."""
    rows, flags = stretches(position, edges), []
    for row in stretches(position, candidates):
        flags.append(3 * np.asarray(position).shape[0] - rank(rows) > 6)
        rows = np.vstack([rows, row])
    return np.array(flags, dtype=bool)


def no_crossing(position, edges, candidates):
    """One spring for each place at which two of them cross in their middles."""
    p, seen, flags = np.asarray(position, dtype=float), [], []
    for one, other in np.asarray(candidates).tolist():
        middle = (p[one] + p[other]) / 2
        flags.append(all(np.linalg.norm(middle - each) > 1e-9 for each in seen))
        seen.append(middle)
    return np.array(flags, dtype=bool)


# The safe step


def sums(mesh, numbers, factor=2.0, ends=(0, 1), pinned=True):
    """The sums over the springs at each node, divided by its mass."""
    edges, mass = np.asarray(mesh[0]), np.asarray(mesh[4], dtype=float)
    total = np.zeros(len(mass))
    for end in ends:
        np.add.at(total, edges[:, end], np.asarray(numbers, dtype=float))
    with np.errstate(all="ignore"):
        return np.where(np.asarray(mesh[5]) & pinned, 0.0, factor * total / mass)


def step(k, c=0.0):
    with np.errstate(all="ignore"):
        below = c + np.sqrt(c * c + 4 * k)
        return np.where(below > 0, 4 / below, np.inf)


def bound(of=step, **others):
    def found(mesh):
        k, c = (sums(mesh, numbers, **others) for numbers in mesh[2:4])
        return float(np.min(of(k, c), initial=np.inf))

    return found


def longest(mesh):
    """The node that allows most, of those that set a limit at all."""
    steps = step(*(sums(mesh, numbers) for numbers in mesh[2:4]))
    return float(np.max(steps[np.isfinite(steps)])) if np.isfinite(steps).any() else np.inf


def single_springs(mesh, mass_of, least=2.0):
    """Spring by spring, as if each were alone."""
    edges, mass = np.asarray(mesh[0]), np.where(mesh[5], np.inf, np.asarray(mesh[4], dtype=float))
    with np.errstate(all="ignore"):
        lone = mass_of(mass[edges[:, 0]], mass[edges[:, 1]]) / np.asarray(mesh[2])
        return float(np.min(np.where(np.isfinite(lone), least * np.sqrt(lone), np.inf), initial=np.inf))


def extremes(mesh):
    """The largest sums and the smallest mass, wherever they are."""
    free = ~np.asarray(mesh[5])
    mass = np.min(np.asarray(mesh[4], dtype=float)[free], initial=np.inf)
    unit_masses = (*mesh[:4], np.ones(len(free)), mesh[5])
    k, c = (np.max(sums(unit_masses, numbers), initial=0.0) / mass for numbers in mesh[2:4])
    return float(step(k, c))


def means(mesh):
    free = ~np.asarray(mesh[5])
    k, c = (np.mean(sums(mesh, numbers)[free]) if free.any() else 0.0 for numbers in mesh[2:4])
    return float(step(k, c))


def separate_limits(k, c):
    """The shorter one of the limits of the springs and of the dampers."""
    with np.errstate(all="ignore"):
        return np.minimum(np.where(k > 0, 2 / np.sqrt(k), np.inf), np.where(c > 0, 2 / c, np.inf))


def of_ratio(k, c):
    """With c for ζ: the damping ratio without what it is divided by."""
    with np.errstate(all="ignore"):
        return np.where(k > 0, 2 / np.sqrt(k) * (np.sqrt(1 + c * c) - c), np.inf)


def explicit(k, c):
    """The limit of explicit Euler: c/k, at most 2/c."""
    with np.errstate(all="ignore"):
        return np.where(k > 0, np.minimum(c / k, np.where(c > 0, 2 / c, np.inf)), np.where(c > 0, 2 / c, np.inf))


# fmt: off
BANK = (
    M("diagonals", "each by itself", chosen(known=lambda more, before: before),
      "Each candidate is compared with the edges alone, and not with the candidates that have been chosen before it. Of"
      " two that do the same work both are kept.",
      "A square has one of its diagonals already. Which motion is left for the other one to resist?"),
    M("diagonals", "by the count", counted(6),
      "As many candidates are taken as are missing from 3 n − 6, whichever come first. A spring that repeats what"
      " others do counts for nothing.",
      "Give a cube the diagonals of its space first. How many motions are left after six of them?"),
    M("diagonals", "by the count in the plane", counted(3),
      "As many candidates are taken as are missing from 3 n − 3, whichever come first. A body in space has six rigid"
      " motions, and a spring that repeats what others do counts for nothing.",
      "In how many ways can a body move without changing its shape?"),
    M("diagonals", "by the count of all motions", counted(0),
      "As many candidates are taken as the nodes have motions without a spring of their own, the rigid ones included.",
      "Which motions of a free body does no spring resist, however many there are?"),
    M("diagonals", "the last ones", backwards,
      "The candidates are tried from the last one to the first.",
      "Which of the two diagonals of a square should be kept?"),
    M("diagonals", "whatever joins two parts", joins_parts,
      "A candidate is kept if it joins nodes that were not joined by any chain of springs. A chain of springs can"
      " fold.",
      "A square of four springs hangs together. Is it rigid?"),
    M("diagonals", "whatever is new", not_there_yet,
      "Every candidate is kept that is not there yet. A spring may be in vain although no other joins the same two"
      " nodes.",
      "Both diagonals of a square are new. Does the second one resist anything that the first does not?"),
    M("diagonals", "all until it is rigid", until_rigid,
      "All candidates are kept until only six motions are left, also those that resist nothing new.",
      "A cube gets both diagonals of a face. What does the second one resist?"),
    M("diagonals", "one for each crossing", no_crossing,
      "Of springs that cross in their middles one is kept. That is right for the faces of a cube, and wrong elsewhere.",
      "Take a mesh whose springs do not cross. Can one of them be in vain?"),
    M("diagonals", "the others", lambda p, e, c: ~right(p, e, c),
      "True and false are exchanged: the candidates that are not needed are marked.",
      "Which of the two should be true for a spring that resists something new?"),
    M("diagonals", "same sign at both ends", chosen(rows=lambda p, pairs: stretches(p, pairs, (1, 1))),
      "Both ends have the same sign in the row, so that a mesh that flies would stretch its springs.",
      "Both ends move by the same vector. By how much does the length change?"),
    M("diagonals", "first end alone", chosen(rows=lambda p, pairs: stretches(p, pairs, (1, 0))),
      "The row knows the first end alone. The length changes with the motion of both.",
      "The second end of a spring moves. Does your row notice it?"),
    M("diagonals", "z left out", chosen(rows=lambda p, pairs: stretches(p, pairs, axes=2)),
      "The motions along z are left out.",
      "How many numbers does it take to say how n nodes move in space?"),
    M("diagonals", "all of them", lambda p, e, c: np.ones(len(c), dtype=bool),
      "All candidates are kept.",
      "Both diagonals of a square: does the second one resist anything that the first does not?"),

    M("timestep_bound", "one spring by itself", lambda mesh: single_springs(mesh, np.minimum),
      "Every spring is taken by itself, with the lighter one of its two masses: 2 √(m/k). A node in a mesh has many"
      " springs, and its neighbours move against it.",
      "Give a node six springs. What pulls it back then?"),
    M("timestep_bound", "two masses by themselves", lambda mesh: single_springs(
        mesh, lambda m, n: 1 / (1 / m + 1 / n)),
      "Every spring is taken by itself, between its two masses. A node in a mesh has many springs.",
      "Give a node six springs. What pulls it back then?"),
    M("timestep_bound", "neighbours at rest", bound(factor=1.0),
      "The neighbours of a node are taken to be at rest. In the fastest vibration they move against it, and each spring"
      " changes by twice as much.",
      "A node moves by x and its neighbour by −x. By how much does the spring between them change?"),
    M("timestep_bound", "neighbours at rest, dampers left out", bound(lambda k, c: step(k), factor=1.0),
      "The neighbours of a node are taken to be at rest, and the dampers are left out.",
      "A node moves by x and its neighbour by −x. By how much does the spring between them change?"),
    M("timestep_bound", "dampers left out", bound(lambda k, c: step(k)),
      "The dampers are left out. They make the limit of this method shorter.",
      "Which of the arrays of the mesh does your answer not depend on?"),
    M("timestep_bound", "dampers make it longer", bound(lambda k, c: np.where(k > 0, step(k, -c), step(k, c))),
      "The dampers make the step longer, because the sign of one of the two c is wrong.",
      "Solve dt² k + 2 dt c = 4 for dt with a very large c. What comes out?"),
    M("timestep_bound", "half of the dampers", bound(lambda k, c: step(k, c / 2)),
      "The dampers count half. The ends of a damper part twice as fast as the node moves, and after a step that turns"
      " the position over, the velocity is 2 x/dt.",
      "A node moves with v and its neighbour with −v. How fast does the damper between them change its length?"),
    M("timestep_bound", "two limits", bound(separate_limits),
      "The limits of the springs and of the dampers are found separately, and the shorter one is taken. Together they"
      " allow less than either of them.",
      "Put both into one equation: what is the velocity after a step that turns the position over?"),
    M("timestep_bound", "damping ratio without ω", bound(of_ratio),
      "The damping in the formula for a damped oscillator is the ratio ζ = c/2ω, not c.",
      "Which unit has the damping in your formula, and which unit has 1?"),
    M("timestep_bound", "explicit Euler", bound(explicit),
      "This is the limit of explicit Euler, which needs dampers to be stable at all.",
      "Which velocity moves the nodes in your step?"),
    M("timestep_bound", "longest for shortest", longest,
      "The node that allows the longest step decides. The whole mesh explodes as soon as one node does.",
      "Which node explodes first?"),
    M("timestep_bound", "one node is the mean", means,
      "Stiffness and mass are averaged over the nodes. The mesh explodes as soon as one node does.",
      "One node is a hundred times lighter than all others. What happens to it with your step?"),
    M("timestep_bound", "stiffest and lightest", extremes,
      "The most stiffness at any node is divided by the smallest mass of any node, although these may be two nodes.",
      "The node with the most springs is a heavy one. Is its step as short as you say?"),
    M("timestep_bound", "pinned nodes count", bound(pinned=False),
      "Pinned nodes shorten the step as well. They cannot vibrate.",
      "All springs are at one pinned node. Which nodes vibrate?"),
    M("timestep_bound", "first ends alone", bound(ends=(0,)),
      "Only the springs that begin at a node count, not those that end there.",
      "Turn a spring round. Should anything change?"),
    M("timestep_bound", "square for root", bound(lambda k, c: step(k, c) ** 2),
      "This is the square of the step, in s².",
      "Which unit has your answer?"),
    M("timestep_bound", "half of it", bound(lambda k, c: step(k, c) / 2),
      "The step is half as long as it may be. A vibration ωdt = 2 is the limit, not 1.",
      "Try the step on a single spring to the wall. At which ω dt does it begin to grow?"),
    M("timestep_bound", "1/ω", bound(lambda k, c: step(k) / 2),
      "The step is 1/ω, half of what is stable, and the dampers are left out.",
      "Try the step on a single spring to the wall. At which ω dt does it begin to grow?"),
    M("timestep_bound", "a whole swing", bound(lambda k, c: np.pi * step(k)),
      "The step is a whole swing, 2π/ω. Already a third of that is too long.",
      "Try the step on a single spring to the wall. At which ω dt does it begin to grow?"),
)
# fmt: on
