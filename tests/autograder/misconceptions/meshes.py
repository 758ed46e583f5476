"""Known mistakes about spring meshes: the forces on their nodes, and one step of their motion."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import dot, flat, size


def vectors(value):
    return np.asarray(value, dtype=float)


def ends_of(mesh):
    return np.asarray(mesh[0])[:, 0], np.asarray(mesh[0])[:, 1]


def unit(between):
    """Directions of edges; zero where an edge has no length."""
    long = size(between)
    return between / np.where(long > 0, long, 1.0)


def spring(mesh, long, between):
    return np.asarray(mesh[2]) * (long - np.asarray(mesh[1]))


def damper(mesh, between, v, w):
    return np.asarray(mesh[3]) * flat(dot(v - w, unit(between)))


def onto(force, mesh):
    """Every contribution counts, plus on the first end, minus on the second."""
    first, second = ends_of(mesh)
    total = np.zeros((len(mesh[4]), 3))
    np.add.at(total, first, force)
    np.add.at(total, second, -force)
    return total


def forces(pulls=spring, resists=damper, way=unit, spread=onto):
    """The right forces, with one part of them changed.

    pulls: the tension of the springs, of the lengths. resists: that of the dampers, of the velocities of the ends.
    way: the direction of an edge, from its second end to its first. spread: sums over the edges at each node.
    """

    def found(mesh, position, velocity):
        p, v = vectors(position), vectors(velocity)
        first, second = ends_of(mesh)
        between = p[first] - p[second]
        tension = pulls(mesh, flat(size(between)), between) + resists(mesh, between, v[first], v[second])
        return spread(-tension[:, None] * way(between), mesh)

    return found


right = forces()


def nothing(*_):
    return 0.0


def last_alone(force, mesh):
    """As `f[i] += F` does it: of several contributions to a node the last one counts."""
    first, second = ends_of(mesh)
    total = np.zeros((len(mesh[4]), 3))
    total[first] += force
    total[second] -= force
    return total


def on_first(force, mesh):
    total = np.zeros((len(mesh[4]), 3))
    np.add.at(total, ends_of(mesh)[0], force)
    return total


def on_second(force, mesh):
    total = np.zeros((len(mesh[4]), 3))
    np.add.at(total, ends_of(mesh)[1], -force)
    return total


def same_on_both(force, mesh):
    total = np.zeros((len(mesh[4]), 3))
    for end in ends_of(mesh):
        np.add.at(total, end, force)
    return total


def in_order_of_edges(force, mesh):
    """Nodes for edges: the force of edge k on node k."""
    total = np.zeros((len(mesh[4]), 3))
    count = min(len(force), len(total))
    total[:count] = force[:count]
    return total


def free_alone(force, mesh):
    return np.where(np.asarray(mesh[5])[:, None], 0.0, onto(force, mesh))


def mean(force, mesh):
    count = np.bincount(np.asarray(mesh[0]).ravel(), minlength=len(mesh[4]))
    return onto(force, mesh) / np.where(count > 0, count, 1)[:, None]


def accelerations(force, mesh):
    return onto(force, mesh) / np.asarray(mesh[4])[:, None]


def slides_damping(mesh, position, velocity):
    """Every damper brakes all of the motion of its two ends."""
    total, v = forces(resists=nothing)(mesh, position, velocity), vectors(velocity)
    for end in ends_of(mesh):
        np.add.at(total, end, -np.asarray(mesh[3])[:, None] * v[end])
    return total


def whole_relative(mesh, position, velocity):
    first, second = ends_of(mesh)
    v = vectors(velocity)
    return forces(resists=nothing)(mesh, position, velocity) + onto(
        -np.asarray(mesh[3])[:, None] * (v[first] - v[second]), mesh
    )


def by_components(mesh, position, velocity):
    """Each coordinate a spring of its own."""
    first, second = ends_of(mesh)
    p = vectors(position)
    between = p[first] - p[second]
    pull = np.asarray(mesh[2])[:, None] * (between - np.asarray(mesh[1])[:, None] * np.sign(between))
    return onto(-pull, mesh) + forces(pulls=nothing)(mesh, position, velocity)


def neighbours_in_number(mesh, position, velocity):
    """Edge k between the nodes k and k + 1."""
    count = min(len(mesh[0]), len(mesh[4]) - 1)
    edges = np.stack([np.arange(count), np.arange(count) + 1], axis=-1)
    return right((edges, *(np.asarray(each)[:count] for each in mesh[1:4]), *mesh[4:]), position, velocity)


# A step


def held(mesh, value):
    return np.where(np.asarray(mesh[5])[:, None], 0.0, value)


def stepping(gains=None, moves=lambda p, v, w, dt: p + dt * w, pins=True, forces_at=lambda p, v, dt: (p, v), keep=held):
    """The right step, with one part of it changed.

    gains: the acceleration, of the mesh, the force and the given one. moves: the position at the end, of the old and
    the new velocity. pins: whether pinned nodes stay. forces_at: the state whose forces act. keep: what is left of the
    velocity of pinned nodes.
    """

    def found(mesh, position, velocity, acceleration, dt):
        p, v, other = vectors(position), vectors(velocity), vectors(acceleration)
        v = keep(mesh, v)
        force = right(mesh, *forces_at(p, v, dt))
        mass = np.asarray(mesh[4])[:, None]
        a = force / mass + other if gains is None else gains(force, mass, other)
        w = v + dt * (held(mesh, a) if pins else a)
        return moves(p, v, w, dt), w

    return found


def pinned_in_place_alone(mesh, position, velocity, acceleration, dt):
    """Their positions are kept, and their velocities go on changing."""
    p, w = stepping(pins=False, keep=lambda mesh, v: v)(mesh, position, velocity, acceleration, dt)
    return np.where(np.asarray(mesh[5])[:, None], vectors(position), p), w


def pins_move_on(mesh, position, velocity, acceleration, dt):
    return stepping(keep=lambda mesh, v: v)(mesh, position, velocity, acceleration, dt)


def pinned_seen_moving(mesh, position, velocity, acceleration, dt):
    """The dampers feel the velocity that was given for a pinned node."""
    p, w = stepping(keep=lambda mesh, v: v)(mesh, position, velocity, acceleration, dt)
    held_at = np.asarray(mesh[5])[:, None]
    return np.where(held_at, vectors(position), p), np.where(held_at, 0.0, w)


def changes(mesh, position, velocity, acceleration, dt):
    p, v = stepping()(mesh, position, velocity, acceleration, dt)
    return p - vectors(position), v - vectors(velocity)


# fmt: off
BANK = (
    M("mesh_forces", "last spring alone", forces(spread=last_alone),
      "A node gets the force of one of its springs alone. `f[i] += F` with an array i of nodes reads all of f first and"
      " writes it afterwards, so that of several springs at a node the last one wins.",
      "Let a node have three springs. Which of their three forces are in your sum? NumPy has `np.add.at`."),
    M("mesh_forces", "slide's sign", forces(pulls=lambda *given: -spring(*given)),
      "A stretched spring pushes its ends farther apart, as slide 29 prints it.",
      "Stretch one spring. Which way should its first end go?"),
    M("mesh_forces", "damper drives", forces(resists=lambda *given: -damper(*given)),
      "The dampers drive the motion: a spring that grows longer is pushed farther apart.",
      "The ends of a spring part. Which way should a damper pull them?"),
    M("mesh_forces", "both signs", forces(lambda *g: -spring(*g), lambda *g: -damper(*g)),
      "All forces have the wrong sign: those on the first end are on the second.",
      "Stretch one spring along x. Which way is its first end pulled?"),
    M("mesh_forces", "all of the motion", slides_damping,
      "A damper brakes all of the motion of its nodes, as slide 29 says. Then a mesh that flies is braked by nothing.",
      "Throw the mesh, without changing its shape. What should its dampers do?"),
    M("mesh_forces", "damping across the edge", whole_relative,
      "A damper acts on all of the velocity of one end as seen from the other, also on the part across the edge. That"
      " part turns the edge and does not change its length.",
      "Turn a spring about one of its ends. How fast does its length change?"),
    M("mesh_forces", "one end's velocity", forces(
        resists=lambda m, d, v, w: np.asarray(m[3]) * flat(dot(v, unit(d)))),
      "The dampers know only the velocity of the first end.",
      "Both ends fly alike. How fast does the length change?"),
    M("mesh_forces", "speed for rate", forces(resists=lambda m, d, v, w: np.asarray(m[3]) * flat(size(v - w))),
      "A damper takes the relative speed, whichever way it points. It pulls the ends together even while they"
      " approach.",
      "The ends approach each other. Which sign has the rate at which the length changes?"),
    M("mesh_forces", "dampers left out", forces(resists=nothing),
      "The dampers are left out.",
      "Which of the arrays of the mesh does your answer not depend on?"),
    M("mesh_forces", "springs left out", forces(pulls=nothing),
      "The springs are left out: nothing but the dampers acts.",
      "Stretch a mesh that is at rest. What pulls it back?"),
    M("mesh_forces", "rest length zero", forces(pulls=lambda m, long, d: np.asarray(m[2]) * long),
      "The rest length is left out, so that every spring tries to become a point.",
      "How strongly does a spring pull that is as long as it is at rest?"),
    M("mesh_forces", "strain for stretch", forces(
        pulls=lambda m, long, d: spring(m, long, d) / np.where(np.asarray(m[1]) > 0, m[1], 1.0)),
      "The stretch is divided by the rest length. A stiffness in N/m belongs to a stretch in metres.",
      "Which unit has your force if the stiffness is in N/m?"),
    M("mesh_forces", "direction not of unit length", forces(way=lambda between: between),
      "The vector along the edge is not divided by its length, so that long edges pull too strongly.",
      "How long is the vector with which you multiply the tension?"),
    M("mesh_forces", "first end alone", forces(spread=on_first),
      "Only the first end of each spring feels it.",
      "Add up all forces of the mesh. What should the sum be?"),
    M("mesh_forces", "second end alone", forces(spread=on_second),
      "Only the second end of each spring feels it.",
      "Add up all forces of the mesh. What should the sum be?"),
    M("mesh_forces", "same force on both ends", forces(spread=same_on_both),
      "Both ends get the same force, and the spring drags them along. The second end is pulled the other way.",
      "What does a stretched spring do to its second end?"),
    M("mesh_forces", "edges for nodes", forces(spread=in_order_of_edges),
      "Edge 0 acts on node 0, edge 1 on node 1, and so on. Which nodes an edge joins is in `mesh.edges`.",
      "Which two nodes does the third spring of your mesh join?"),
    M("mesh_forces", "neighbours in number", neighbours_in_number,
      "Every spring is taken to join a node and the next one in number. Which nodes an edge joins is in `mesh.edges`.",
      "Which two nodes does the third spring of your mesh join?"),
    M("mesh_forces", "pinned nodes feel nothing", forces(spread=free_alone),
      "The force on a pinned node is set to zero. A pin holds against the pull of the springs; it does not end it.",
      "What does the description say of a pinned node?"),
    M("mesh_forces", "mean of the springs", forces(spread=mean),
      "A node gets the mean of what its springs do. Two springs side by side pull twice as strongly as one.",
      "Hang a weight on three springs side by side. How strongly do they pull together?"),
    M("mesh_forces", "accelerations", forces(spread=accelerations),
      "The forces are divided by the masses: these are accelerations.",
      "Which unit has what you return?"),
    M("mesh_forces", "a rope", forces(pulls=lambda *given: np.maximum(spring(*given), 0)),
      "A shortened spring does nothing, like a rope. A spring pushes as well.",
      "Press a spring together and let go. What happens?"),
    M("mesh_forces", "always pulling", forces(pulls=lambda *given: np.abs(spring(*given))),
      "A shortened spring pulls as well.",
      "Press a spring together and let go. What happens?"),
    M("mesh_forces", "squared stretch", forces(
        pulls=lambda m, long, d: np.asarray(m[2]) * (long - np.asarray(m[1])) ** 2),
      "The stretch is squared. That is twice the energy of the spring, not its force.",
      "Stretch a spring twice as far. How much more strongly does it pull?"),
    M("mesh_forces", "half to each end", forces(lambda *g: spring(*g) / 2, lambda *g: damper(*g) / 2),
      "Each end gets half of the force. The force that pulls at one end is the whole tension, and so is that at the"
      " other.",
      "Hold one end of a spring and pull with 10 N at the other. How strongly do you have to hold?"),
    M("mesh_forces", "by components", by_components,
      "Each coordinate is taken for a spring of its own, with its own rest length.",
      "A slanted spring is at its rest length. How strongly does yours pull then?"),
    M("mesh_forces", "NaN at one place", forces(way=lambda between: between / size(between)),
      "An edge whose ends are at one place is divided by its length, which is zero: the forces there are NaN.",
      "What does the description say of an edge of zero length?"),

    M("mesh_step", "old velocity", stepping(moves=lambda p, v, w, dt: p + dt * v),
      "The positions move with the velocities at the start of the step. That is explicit Euler, which makes every"
      " vibration grow.",
      "Which velocity do the nodes have by the time they move: the old one or the new one?"),
    M("mesh_step", "mean velocity", stepping(moves=lambda p, v, w, dt: p + dt * (v + w) / 2),
      "The positions move with the mean of the old and the new velocity. That is right for a constant force, and makes"
      " vibrations grow.",
      "What does the name of the method say about the velocity that is used?"),
    M("mesh_step", "positions before forces", stepping(
        forces_at=lambda p, v, dt: (p + dt * v, v), moves=lambda p, v, w, dt: p + dt * v),
      "The positions move first, and the forces are those at their end.",
      "In which order does the description put forces, velocities and positions?"),
    M("mesh_step", "pins left out", stepping(pins=False, keep=lambda mesh, v: v),
      "Pinned nodes move like all others.",
      "Which of the arrays of the mesh does your answer not depend on?"),
    M("mesh_step", "pinned nodes drift on", pins_move_on,
      "A pinned node is not accelerated, but it keeps the velocity that it has, and moves on with it.",
      "What does the description say of a pinned node that is given a velocity?"),
    M("mesh_step", "pinned in place alone", pinned_in_place_alone,
      "The positions of pinned nodes are kept, but their velocities go on changing, and the dampers feel them.",
      "Which velocity should a node have that does not move?"),
    M("mesh_step", "dampers feel thrown pins", pinned_seen_moving,
      "The dampers feel the velocity that was given for a pinned node, although the node does not move.",
      "In which order do you set the velocities of pinned nodes to zero and ask for the forces?"),
    M("mesh_step", "force for acceleration", stepping(gains=lambda f, m, a: f + a),
      "The forces are not divided by the masses.",
      "A node is twice as heavy. How much faster does a spring make it?"),
    M("mesh_step", "times the mass", stepping(gains=lambda f, m, a: f * np.where(np.isfinite(m), m, 0.0) + a),
      "The forces are multiplied by the masses.",
      "A node is twice as heavy. How much faster does a spring make it?"),
    M("mesh_step", "gravity divided by the mass", stepping(gains=lambda f, m, a: (f + a) / m),
      "The given acceleration is divided by the mass as well, as if it were a force.",
      "How much faster does a heavy stone fall?"),
    M("mesh_step", "gravity for a force with mass", stepping(gains=lambda f, m, a: f / m + m * a),
      "The given acceleration is multiplied by the mass, and added to accelerations.",
      "How much faster does a heavy stone fall?"),
    M("mesh_step", "acceleration left out", stepping(gains=lambda f, m, a: f / m),
      "The acceleration due to everything else is left out.",
      "Let go of a mesh whose springs are at rest. What should it do?"),
    M("mesh_step", "springs left out", stepping(gains=lambda f, m, a: a + 0 * f),
      "The forces of the mesh are left out: every node falls by itself.",
      "Stretch the mesh and let go. What should it do?"),
    M("mesh_step", "forces turned round", stepping(gains=lambda f, m, a: a - f / m),
      "The forces of the mesh are subtracted.",
      "Stretch the mesh and let go. Which way should its ends go?"),
    M("mesh_step", "dt left out", lambda mesh, p, v, a, dt: (
        vectors(p) + stepping()(mesh, p, v, a, dt)[1], stepping()(mesh, p, v, a, dt)[1]),
      "The positions change by the velocity itself, not by what the nodes move in the time of the step.",
      "How far does a node move in a tenth of a second?"),
    M("mesh_step", "velocity without dt", lambda mesh, p, v, a, dt: (
        vectors(p) + dt * stepping()(mesh, p, v, a, 1.0)[1], stepping()(mesh, p, v, a, 1.0)[1]),
      "The velocities change by the acceleration itself, not by what it makes in the time of the step.",
      "How much faster does a node become in a tenth of a second?"),
    M("mesh_step", "half of a dt²", stepping(moves=lambda p, v, w, dt: p + dt * w + dt * (w - v) / 2),
      "To the new velocity times dt, half of a dt² is added as well. The new velocity has more than that in it"
      " already.",
      "Write out the new position with the old velocity. How often does a dt² occur in it?"),
    M("mesh_step", "changes alone", changes,
      "What is returned is how much position and velocity change, not what they are.",
      "What does the description say of the two things that are returned?"),
)
# fmt: on
