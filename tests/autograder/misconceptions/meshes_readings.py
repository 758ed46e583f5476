"""Loose readings of the slides about meshes: rates that are none, other methods, counts for ranks, other rubbing."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import dot, flat, formulas_of, size

MESHES, LIMITS, CONTACT = map(formulas_of, ("meshes", "meshes_limits", "meshes_contact"))
DOWN = np.array([0.0, 0.0, -9.81])


def overwritten(force, mesh):
    """A loop that assigns and does not add."""
    total = np.zeros((len(mesh[4]), 3))
    for pull, (one, other) in zip(force, np.asarray(mesh[0]).tolist(), strict=True):
        total[one], total[other] = pull, -pull
    return total


def over_rest_length(mesh, position, velocity):
    """The vector along the edge, divided by the rest length."""
    first, second = MESHES.ends_of(mesh)
    p, v = MESHES.vectors(position), MESHES.vectors(velocity)
    rest = np.asarray(mesh[1])[:, None]
    u = (p[first] - p[second]) / np.where(rest > 0, rest, 1.0)
    tension = MESHES.spring(mesh, flat(size(p[first] - p[second])), None) + np.asarray(mesh[3]) * flat(
        dot(v[first] - v[second], u)
    )
    return MESHES.onto(-tension[:, None] * u, mesh)


def brakes_each_node(mesh, position, velocity):
    """Each node is braked by its own velocity, as strongly as the first damper says."""
    strength = np.asarray(mesh[3])[0] if len(mesh[3]) else 0.0
    return MESHES.forces(resists=MESHES.nothing)(mesh, position, velocity) - strength * MESHES.vectors(velocity)


def seen_from_above(mesh, long, between):
    return MESHES.spring(mesh, np.linalg.norm(between[:, :2], axis=1), between)


def with_weight(mesh, position, velocity):
    mass = np.where(np.isfinite(mesh[4]), mesh[4], 0.0)
    return MESHES.right(mesh, position, velocity) + mass[:, None] * DOWN


def accelerated(mesh, position, velocity, acceleration):
    force = MESHES.right(mesh, position, velocity)
    return MESHES.held(mesh, force / np.asarray(mesh[4])[:, None] + acceleration)


def midpoint(mesh, position, velocity, acceleration, dt):
    p, v = MESHES.vectors(position), MESHES.held(mesh, MESHES.vectors(velocity))
    half = v + dt / 2 * accelerated(mesh, p, v, acceleration)
    return p + dt * half, v + dt * accelerated(mesh, p + dt / 2 * v, half, acceleration)


def verlet(mesh, position, velocity, acceleration, dt):
    p, v = MESHES.vectors(position), MESHES.held(mesh, MESHES.vectors(velocity))
    a = accelerated(mesh, p, v, acceleration)
    after = p + dt * v + dt * dt / 2 * a
    return after, v + dt / 2 * (a + accelerated(mesh, after, v, acceleration))


def moved_and_then_stopped(mesh, position, velocity, acceleration, dt):
    """Pinned nodes make the step, and only their velocities are set to zero."""
    p, w = MESHES.stepping(pins=False, keep=lambda mesh, v: v)(mesh, position, velocity, acceleration, dt)
    return p, MESHES.held(mesh, w)


def old_velocity_returned(mesh, position, velocity, acceleration, dt):
    return MESHES.stepping()(mesh, position, velocity, acceleration, dt)[0], MESHES.held(mesh, MESHES.vectors(velocity))


def shared_mass(force, mass, other):
    return force / np.sum(mass[np.isfinite(mass)]) + other


# Which springs, and which step


def shortest_first(position, edges, candidates):
    ends, p = np.asarray(candidates), np.asarray(position, dtype=float)
    order = np.argsort(np.linalg.norm(p[ends[:, 0]] - p[ends[:, 1]], axis=1), kind="stable")
    found = np.zeros(len(ends), dtype=bool)
    found[order] = LIMITS.right(position, edges, ends[order])
    return found


def missed_by_all(position, edges, candidates):
    """Whether something is lost if it is left out of all."""
    rows = LIMITS.stretches(position, [*np.asarray(edges).tolist(), *np.asarray(candidates).tolist()])
    first = len(edges)
    found = [LIMITS.rank(np.delete(rows, first + k, axis=0)) < LIMITS.rank(rows) for k in range(len(candidates))]
    return np.array(found, dtype=bool)


def counted_by_rank(position, edges, candidates):
    missing = 3 * len(position) - 6 - LIMITS.rank(LIMITS.stretches(position, edges))
    return np.arange(len(candidates)) < missing


def stiffest_spring(mesh, factor=1.0):
    """The stiffest spring and the lightest node, wherever they are."""
    mass = np.min(np.asarray(mesh[4], dtype=float)[~np.asarray(mesh[5])], initial=np.inf)
    k = np.max(np.asarray(mesh[2]), initial=0.0) * factor / mass
    return float(2 / np.sqrt(k)) if k > 0 else np.inf


def most_springs(mesh):
    """As many of the stiffest spring as any node has springs."""
    return stiffest_spring(mesh, 2.0 * np.max(np.bincount(np.asarray(mesh[0]).ravel(), minlength=1)))


def pins_stand_still(mesh):
    """A neighbour that is pinned does not move against the node."""
    fixed = np.any(np.asarray(mesh[5])[np.asarray(mesh[0])], axis=-1)
    k, c = (LIMITS.sums(mesh, np.where(fixed, 0.5, 1.0) * np.asarray(numbers)) for numbers in mesh[2:4])
    return float(np.min(LIMITS.step(k, c), initial=np.inf))


# Rubbing, and springs that are too long


def per_axis(along, most):
    return np.sign(along) * np.maximum(np.abs(along) - most, 0.0)


def all_of_it_rubbed(mesh, position, velocity, centre, radius, restitution=0.0, friction=0.0):
    """Friction takes from the whole speed, the bounce included."""
    p, w = CONTACT.touched()(mesh, position, velocity, centre, radius, restitution, 0.0)
    v = np.asarray(velocity, dtype=float)
    away = np.asarray(position, dtype=float) - centre
    across = dot(v, CONTACT.outwards(away))
    hit = (size(away) < radius) & (across < 0) & ~np.asarray(mesh[5])[:, None]
    return p, np.where(hit, CONTACT.slowed(w, -friction * (1 + restitution) * across), w)


def of_the_speed(mesh, position, velocity, centre, radius, restitution=0.0, friction=0.0):
    """Friction takes μ times the whole speed from the sliding."""
    v = np.asarray(velocity, dtype=float)
    lost = friction * size(v)
    return CONTACT.touched(most=lambda across, e, mu: np.where(across < 0, lost, 0.0))(
        mesh, position, velocity, centre, radius, restitution, friction
    )


def straight_pull(mesh, position, limit=0.1, iterations=1000):
    """The unit vector is forgotten: what is too long, times the whole vector along the spring."""
    edges, rest = np.asarray(mesh[0]), np.asarray(mesh[1], dtype=float)
    w = np.where(np.asarray(mesh[5]), 0.0, 1 / np.asarray(mesh[4], dtype=float))
    p = np.array(position, dtype=float)
    for _ in range(iterations):
        for (one, other), at_rest in zip(edges.tolist(), rest, strict=True):
            between = p[one] - p[other]
            over = np.linalg.norm(between) - at_rest * (1 + limit)
            if over > 0 and at_rest > 0 and w[one] + w[other] > 0:
                p[one] -= w[one] / (w[one] + w[other]) * over * between
                p[other] += w[other] / (w[one] + w[other]) * over * between
    return p


def inverse_masses_alone(w1, w2):
    return w1, w2


def beside_pins_nothing(w1, w2):
    return CONTACT.both_shares(w1, w2) if w1 > 0 and w2 > 0 else (0.0, 0.0)


def stretched_as_well(mesh, position, limit=0.1, iterations=1000):
    """A spring that is too short is made longer, to the limit below its rest length."""
    p = np.array(position, dtype=float)
    for _ in range(iterations):
        for edge, rest in zip(np.asarray(mesh[0]), np.asarray(mesh[1]), strict=True):
            one = (edge[None], np.array([rest]), *(np.zeros(1), np.zeros(1)), *mesh[4:])
            p = CONTACT.fitted()(one, p, limit, 1)
            short = CONTACT.fitted(
                lambda rest, limit: rest * (1 - limit),
                goal=lambda rest, limit, long: rest * (1 - limit),
                too_long=lambda long, most: 0 < long < most,
            )
            p = short(one, p, limit, 1)
    return p


def first_too_long_alone(mesh, position, limit=0.1, iterations=1000):
    """A round ends with the first spring that was too long."""
    p = np.array(position, dtype=float)
    for _ in range(iterations):
        for edge, rest in zip(np.asarray(mesh[0]), np.asarray(mesh[1]), strict=True):
            one = (edge[None], np.array([rest]), *(np.zeros(1), np.zeros(1)), *mesh[4:])
            moved = CONTACT.fitted()(one, p, limit, 1)
            if not np.array_equal(moved, p):
                p = moved
                break
    return p


# fmt: off
BANK = (
    M("mesh_forces", "rate not divided by the length", MESHES.forces(
        resists=lambda m, d, v, w: np.asarray(m[3]) * flat(dot(v - w, d))),
      "The relative velocity is multiplied with the whole vector along the edge, not with its direction.",
      "Two nodes are 5 m apart and part at 1 m/s. How fast does the length change?"),
    M("mesh_forces", "size of the rate", MESHES.forces(
        resists=lambda m, d, v, w: np.asarray(m[3]) * np.abs(flat(dot(v - w, MESHES.unit(d))))),
      "The dampers take the size of the rate, and pull also while the ends approach.",
      "The ends approach each other. Which way should the damper push?"),
    M("mesh_forces", "last spring of a loop", MESHES.forces(spread=overwritten),
      "The loop assigns the force of each spring to its nodes and does not add it: the last spring wins.",
      "What is in f[i] before you write the force of the next spring into it?"),
    M("mesh_forces", "direction by the rest length", over_rest_length,
      "The vector along the edge is divided by the rest length. It has the length 1 only if the spring is at rest.",
      "How long is the vector that you multiply with the tension if the spring is stretched to twice its length?"),
    M("mesh_forces", "every node braked", brakes_each_node,
      "Each node is braked by its own velocity, as on slide 29, and by one damper only.",
      "Throw the mesh without changing its shape. What should its dampers do?"),
    M("mesh_forces", "length seen from above", MESHES.forces(pulls=seen_from_above),
      "The length of a spring is that of its shadow on the floor: z is left out.",
      "A spring is upright. How long is it?"),
    M("mesh_forces", "with the weight", with_weight,
      "Gravity is added. The forces asked for are those of the springs and dampers.",
      "Which forces does the description name?"),

    M("mesh_step", "midpoint", midpoint,
      "The forces are those in the middle of the step. That is the midpoint method, which is another one.",
      "At which time does the description ask for the forces?"),
    M("mesh_step", "velocity Verlet", verlet,
      "This is velocity Verlet, which takes the mean of the forces before and after the step.",
      "At which time does the description ask for the forces?"),
    M("mesh_step", "pins move once more", moved_and_then_stopped,
      "Pinned nodes make the step, and only afterwards their velocities are set to zero.",
      "Where is a pinned node after the step, and where was it before?"),
    M("mesh_step", "old velocity returned", old_velocity_returned,
      "The velocity that is returned is that before the step.",
      "Let a mesh fall for two steps. How fast is it after the second one?"),
    M("mesh_step", "gravity built in", MESHES.stepping(gains=lambda f, m, a: f / m + DOWN),
      "Gravity is written into the function, and the acceleration that is given makes no difference.",
      "Which of the arguments does your answer not depend on?"),
    M("mesh_step", "mass of all nodes", MESHES.stepping(gains=shared_mass),
      "The forces are divided by the mass of the whole mesh.",
      "A light node and a heavy one are pulled equally strongly. Which is accelerated more?"),

    M("diagonals", "shortest first", shortest_first,
      "The candidates are tried from the shortest to the longest, not in their order.",
      "In which order does the description try the candidates?"),
    M("diagonals", "missed by all others", missed_by_all,
      "A candidate is kept if something is lost when it alone is left out of all candidates. Of two that do the same"
      " work neither is kept.",
      "Give a square both diagonals. Is one of them needed?"),
    M("diagonals", "by the count of the rank", counted_by_rank,
      "How many are missing is counted rightly, and then the first ones are taken, whether they help or not.",
      "The first two candidates are the two diagonals of one face. Are both of them needed?"),

    M("timestep_bound", "stiffest spring, lightest node", stiffest_spring,
      "The stiffest spring and the lightest node are taken, wherever they are, as if there were a single spring.",
      "Give a node six springs. What pulls it back then?"),
    M("timestep_bound", "most springs of the stiffest", most_springs,
      "Every node is taken to have as many springs as the one with most, all of them as stiff as the stiffest.",
      "The stiff springs are at one node and the light mass is another one. Is the step as short as you say?"),
    M("timestep_bound", "pinned neighbours at rest", pins_stand_still,
      "Springs to pinned nodes count half. That is right for one spring to a wall, but the description lets all"
      " neighbours move against the node.",
      "What does the description say of the neighbours of a node?"),
    M("mesh_sphere_contact", "friction for each axis", CONTACT.touched(slides=per_axis),
      "Friction is subtracted from each component by itself. It acts along the sliding.",
      "A node slides along a diagonal. In which direction does friction act?"),
    M("mesh_sphere_contact", "friction from the bounce as well", all_of_it_rubbed,
      "Friction shortens the whole velocity, the bounce included.",
      "A node hits the sphere head-on. Is there any sliding that friction could take?"),
    M("mesh_sphere_contact", "friction by the speed", of_the_speed,
      "Friction takes μ times the whole speed.",
      "Two nodes hit equally hard, one of them sliding fast. On which does more friction act?"),
    M("mesh_sphere_contact", "exponential friction", CONTACT.touched(
        most=lambda across, e, mu: np.where(across < 0, mu, 0.0), slides=lambda along, most: along * np.exp(-most)),
      "The sliding is multiplied by e to the −μ, however hard the node hits.",
      "A node falls onto the sphere twice as fast. How much more can friction take?"),

    M("limit_strain", "vector for direction", straight_pull,
      "What is too long is multiplied with the whole vector along the spring, not with its direction.",
      "How long is the vector with which you multiply the excess?"),
    M("limit_strain", "inverse masses for shares", CONTACT.fitted(shares=inverse_masses_alone),
      "Each end moves by its inverse mass times the excess. Shares have to add up to 1.",
      "Both ends weigh 10 kg. How much shorter does the spring become?"),
    M("limit_strain", "nothing beside a pin", CONTACT.fitted(shares=beside_pins_nothing),
      "Springs with a pinned end are left alone.",
      "One end is pinned. How far has the other one to move?"),
    M("limit_strain", "short ones lengthened", stretched_as_well,
      "Springs that are shorter than the limit below their rest length are made longer.",
      "What does the description say of shortened springs?"),
    M("limit_strain", "one spring a round", first_too_long_alone,
      "A round ends with the first spring that is too long.",
      "Through how many springs does one round go?"),
)
# fmt: on
