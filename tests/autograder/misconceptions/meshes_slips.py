"""Slips about meshes: pins that fall, edges and springs that are miscounted, absolute tolerances, a lost centre."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import formulas_of

MESHES, LIMITS, CONTACT = map(formulas_of, ("meshes", "meshes_limits", "meshes_contact"))


def damper_of_first_end(mesh, position, velocity):
    """The springs pull both ends, the dampers the first one alone."""
    springs = MESHES.forces(resists=MESHES.nothing)(mesh, position, velocity)
    return springs + MESHES.forces(pulls=MESHES.nothing, spread=MESHES.on_first)(mesh, position, velocity)


def nothing_if_one_has_no_length(mesh, position, velocity):
    p = MESHES.vectors(position)
    first, second = MESHES.ends_of(mesh)
    if np.any(np.all(p[first] == p[second], axis=1)):
        return np.zeros_like(p)
    return MESHES.right(mesh, position, velocity)


def last_of_a_pair(mesh, position, velocity):
    """A table by pairs of nodes has room for one spring between two of them."""
    last = {frozenset(pair): number for number, pair in enumerate(np.asarray(mesh[0]).tolist())}
    kept = sorted(last.values())
    return MESHES.right((*(np.asarray(each)[kept] for each in mesh[:4]), *mesh[4:]), position, velocity)


def falling_pins(stays):
    """The springs do not move a pinned node, the acceleration does. stays: whether its place is kept all the same."""

    def found(mesh, position, velocity, acceleration, dt):
        p, v = MESHES.vectors(position), MESHES.held(mesh, MESHES.vectors(velocity))
        pulled = MESHES.held(mesh, MESHES.right(mesh, p, v) / np.asarray(mesh[4])[:, None])
        w = v + dt * (pulled + MESHES.vectors(acceleration))
        return np.where(np.asarray(mesh[5])[:, None] & stays, p, p + dt * w), w

    return found


def until_the_count(position, edges, candidates):
    """None any more as soon as 3 n − 6 springs resist something."""
    rows, flags = LIMITS.stretches(position, edges), []
    for row in LIMITS.stretches(position, candidates):
        more, enough = np.vstack([rows, row]), LIMITS.rank(rows) >= 3 * len(position) - 6
        flags.append(not enough and LIMITS.rank(more) > LIMITS.rank(rows))
        rows = more if flags[-1] else rows
    return np.array(flags, dtype=bool)


def absolute(position, edges, candidates):
    """Rows as long as the springs, and whatever is below a thousandth counts as zero."""

    def rank(rows):
        return int(np.linalg.matrix_rank(np.array(rows), tol=1e-3)) if rows else 0

    p, flags = np.asarray(position, dtype=float), []
    known, new = (list(LIMITS.stretches(p, pairs)) for pairs in (edges, candidates))
    long = [[np.linalg.norm(p[a] - p[b]) for a, b in np.asarray(pairs).tolist()] for pairs in (edges, candidates)]
    known = [row * each for row, each in zip(known, long[0], strict=True)]
    for row, each in zip(new, long[1], strict=True):
        flags.append(rank([*known, row * each]) > rank(known))
        known += [row * each] * flags[-1]
    return np.array(flags, dtype=bool)


def two_masses(mesh):
    """Spring by spring, between its two masses, dampers as well."""
    with np.errstate(all="ignore"):
        light = np.where(mesh[5], 0.0, 1 / np.asarray(mesh[4], dtype=float))
    both = np.sum(light[np.asarray(mesh[0])], axis=-1)
    return float(np.min(LIMITS.step(mesh[2] * both, mesh[3] * both), initial=np.inf))


def without_the_centre(mesh, position, velocity, centre, radius, *others):
    p, v = CONTACT.touched()(mesh, position, velocity, centre, radius, *others)
    moved = np.any(p != np.asarray(position, dtype=float), axis=-1, keepdims=True)
    return np.where(moved, p - centre, p), v


def unchanged_at_the_centre(mesh, position, velocity, centre, *others):
    """At the centre a node is put on top, and keeps its velocity."""
    p, v = CONTACT.touched()(mesh, position, velocity, centre, *others)
    middle = np.all(np.asarray(position, dtype=float) == centre, axis=-1, keepdims=True)
    return p, np.where(middle, velocity, v)


def put_back(shares):
    """Pinned nodes are moved like all others, and put back at the end of each round."""

    def found(mesh, position, limit=0.1, iterations=1000):
        start = np.array(position, dtype=float)
        p, held = start, np.asarray(mesh[5])[:, None]
        for _ in range(iterations):
            p = np.where(held, start, CONTACT.fitted(shares=shares, pins=False)(mesh, p, limit, 1))
        return p

    return found


def halves(w1, w2):
    return 0.5, 0.5


# fmt: off
BANK = (
    M("mesh_forces", "damper on the first end alone", damper_of_first_end,
      "The springs pull both ends, but the dampers act on the first end alone.",
      "Add up all forces of a mesh whose nodes move. What should the sum be?"),
    M("mesh_forces", "nothing if one edge has no length", nothing_if_one_has_no_length,
      "As soon as one edge of the mesh has no length, all forces are zero. The description says this of the force of"
      " that edge alone.",
      "Two of a hundred nodes are at one place. What should the other ninety-eight feel?"),
    M("mesh_forces", "one spring for two nodes", last_of_a_pair,
      "Of several springs between the same two nodes the last one alone acts, as in a table with one place for each"
      " pair of nodes.",
      "Two springs join the same two nodes. How strongly do they pull together?"),
    M("mesh_step", "pins fall", falling_pins(stays=False),
      "The springs do not move a pinned node, because its inverse mass is zero. But the given acceleration is added to"
      " it as to all others, and it falls.",
      "Which of the two terms of your acceleration does an inverse mass of zero take away?"),
    M("mesh_step", "pins stay, their velocity falls", falling_pins(stays=True),
      "The places of pinned nodes are kept, but the velocities that are returned for them have the given acceleration.",
      "Which velocity should a node have that does not move?"),
    M("diagonals", "none from 3 n − 6 on", until_the_count,
      "No candidate is tried any more as soon as 3 n − 6 springs resist something. Two nodes need one spring, and"
      " 3 n − 6 is zero there.",
      "Two nodes and nothing between them. Is a spring needed, and what does your count say?"),
    M("diagonals", "absolute tolerance", absolute,
      "The rows are as long as the springs, and what is below a fixed number counts as zero. For a mesh of a millimetre"
      " everything is.",
      "Make the mesh a million times smaller. Should the answer change?"),
    M("timestep_bound", "two masses by themselves, with dampers", two_masses,
      "Every spring and its damper is taken by itself, between its two masses. A node in a mesh has many springs.",
      "Give a node six springs. What pulls it back then?"),
    M("mesh_sphere_contact", "centre forgotten in the place", without_the_centre,
      "The new place is the radius times the normal. That is a place on a sphere around the origin: the centre is not"
      " added.",
      "Move mesh and sphere by 10 m. Where are your nodes afterwards?"),
    M("mesh_sphere_contact", "no bounce at the centre", unchanged_at_the_centre,
      "A node at the centre is put on top of the sphere, but keeps its velocity, because its normal is zero there.",
      "What does the description say about the normal of a node exactly at the centre?"),
    M("limit_strain", "strain of the present length", CONTACT.fitted(
        lambda rest, limit: rest / (1 - limit), goal=lambda rest, limit, long: rest / (1 - limit)),
      "The strain is taken to be the stretch over the present length. It is the stretch over the rest length.",
      "A spring of 1 m is stretched to 2 m. What is its strain?"),
    M("limit_strain", "pins put back afterwards", put_back(CONTACT.both_shares),
      "Pinned nodes make their share of the way like all others, and are put back at the end of the round. So the"
      " springs at a pin stay too long.",
      "One end is pinned. How far has the other one to move, at once?"),
    M("limit_strain", "halves, and pins put back afterwards", put_back(halves),
      "Each end makes half of the way, whatever its mass, and pinned nodes are put back at the end of the round.",
      "A marble and a bowling ball are drawn together. Which one moves farther? And if one of them is pinned?"),
)
# fmt: on
