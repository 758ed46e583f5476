"""Known mistakes that a fresh reader made with the lesson alone: slips in what contacts do, and in the step."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import formulas_of
from solutions.impulse import rotation_matrix
from solutions.world import out_of_overlap, turned

_of_steps = formulas_of("world_steps")
responds, response, step, steps = (getattr(_of_steps, name) for name in ("with_", "response", "step", "steps"))


def carried(gap, dt, collided, parting):
    return np.where(collided, np.maximum(parting, 0), -np.maximum(gap, 0) / dt)


def along_the_axes_of_the_world(moments, orientation):
    return (1 / np.asarray(moments))[:, :, None] * np.eye(3)


def the_hastiest(collided, parting, gap, dt):
    """All contacts have the largest of their least speeds."""
    least = carried(gap, dt, collided, parting)
    return np.full(len(least), np.max(least, initial=-1e9))


def as_forces(*given):
    v, w, impulse = response(*given)
    return v, w, impulse / given[4]


def force_of_the_first(bodies, state, g, dt, rules, memory=None, force=(0.0, 0.0, 0.0), torque=(0.0, 0.0, 0.0)):
    force = np.asarray(force, dtype=float)
    return step(bodies, state, g, dt, rules, memory, force if force.ndim == 1 else force[:1], torque)


def torque_of_its_own_axes(bodies, state, g, dt, rules, memory=None, force=(0.0, 0.0, 0.0), torque=(0.0, 0.0, 0.0)):
    torque = np.matvec(rotation_matrix(state[1]), np.broadcast_to(torque, np.shape(state[0])))
    return step(bodies, state, g, dt, rules, memory, force, torque)


def weight_twice(bodies, state, g, dt, rules, memory=None, force=(0.0, 0.0, 0.0), torque=(0.0, 0.0, 0.0)):
    fallen = state[2] + dt * np.asarray(g) * (bodies[0] > 0)[:, None]
    return step(bodies, (*state[:2], fallen, state[3]), g, dt, rules, memory, force, torque)


def turned_with_the_old_spin(bodies, state, *more):
    def out(orientation, spin, push, moments, dt, turn):
        return turn(turned(orientation, push), state[3], moments, dt)

    return step(bodies, state, *more, out=out)


def no_turn(orientation, spin, push, moments, dt, turn):
    return turn(orientation, spin, moments, dt)


def turn_at_the_end(orientation, spin, push, moments, dt, turn):
    orientation, spin = turn(orientation, spin, moments, dt)
    return turned(orientation, push), spin


def turn_against_it(orientation, spin, push, moments, dt, turn):
    return turn(turned(orientation, -push), spin, moments, dt)


def of_the_start(bodies, state, after, contacts, dt):
    return out_of_overlap(bodies, state, contacts, dt)


# fmt: off
BANK = (
    M("respond", "friction of the first contact", responds(rub=lambda table, a, b: np.full(len(a), table[a[0], b[0]])),
      "All contacts at rest have the friction of the first one.",
      "Where in the table is the friction of the two bodies of each contact?"),
    M("respond", "mean friction", responds(rub=lambda table, a, b: np.full(len(a), np.mean(table[a, b]))),
      "All contacts at rest have the mean of their frictions.",
      "A box on ice stands beside one on rubber. What has the one to do with the other's friction?"),
    M("respond", "friction with itself", responds(rub=lambda table, a, b: table[a, a]),
      "The friction of a contact at rest is that of A with a body like A.",
      "Which two numbers find a pair of bodies in the table?"),
    M("respond", "friction with itself in impacts", responds(mu=lambda table, i, j: table[i, i]),
      "The friction of an impact is that of A with a body like A.",
      "Which two numbers find a pair of bodies in the table?"),
    M("respond", "the first pair's friction in impacts", responds(mu=lambda table, i, j: table[0, 1]),
      "There is one friction for all impacts; the table has one for each two bodies.",
      "Where in the table is the friction of the two bodies of this contact?"),
    M("respond", "restitution with itself", responds(e=lambda table, i, j: table[i, i]),
      "The restitution of an impact is that of A with a body like A.",
      "Which two numbers find a pair of bodies in the table?"),
    M("respond", "start along the surface left out", responds(begin=lambda start: start * [1.0, 0.0, 0.0]),
      "The sweeps with friction begin without the impulses along the surface of the last step.",
      "`start` has three columns. Which of them makes no difference to your answer?"),
    M("respond", "three rounds", responds(rounds=3),
      "The pairs have three turns. A light ball between two heavy ones needs more.",
      "How do you know that no pair collides any more?"),
    M("respond", "back to the first pair", responds(first_alone=True),
      "After each impact the pairs begin with the first one again: those behind it wait until it is quiet.",
      "In a round, does every pair have its turn?"),
    M("respond", "speeds before the impacts", responds(stale=True),
      "G v is taken with the velocities before the impacts.",
      "Which velocities do the bodies have when the contacts begin to rest?"),
    M("respond", "least speeds from before the impacts",
      responds(stale=True, least=lambda c, parting, gap, dt: np.where(c, parting, -np.maximum(gap, 0) / dt)),
      "G v is taken with the velocities before the impacts, also for the least speeds.",
      "Which velocities do the bodies have when the contacts begin to rest?"),
    M("respond", "normal impulses twice", responds(twice=True),
      "`sequential_impulses` gets velocities that contain the normal impulses already, and adds those of `start`.",
      "What does `sequential_impulses` do with its `start`, first of all?"),
    M("respond", "no least speeds with friction", responds(rough_least=lambda least: 0 * least),
      "`sequential_impulses` gets no least speeds: with friction, a rebound ends, and a gap counts as closed.",
      "Which argument of `sequential_impulses` says how fast the points of a contact part?"),
    M("respond", "no impulses along the surface returned", responds(told=lambda impulse: impulse * [1.0, 0.0, 0.0]),
      "The impulses along the surface are left out of what is returned.",
      "With which impulses should the next step begin, along a rough floor?"),
    M("respond", "arms turned round", responds(arm=lambda arm: -arm),
      "The arm points from the place to the middle of the body.",
      "From where to where does the vector r of a contact point?"),
    M("respond", "own axes for the world's", responds(turns=along_the_axes_of_the_world),
      "The inverse inertia is 1/moments along the axes of the world, however the body lies.",
      "Which given function turns the moments into the world?"),
    M("respond", "no speed in the offset", responds(offset=lambda parting, dt, gained, least: dt * gained - least),
      "G v is left out: the impulses end what the load adds, and not the approach that is there.",
      "A ball comes down slowly and rests. Which impulse ends its speed?"),
    M("respond", "nothing after an impact",
      responds(least=lambda c, parting, gap, dt: np.where(c, -1e9, -np.maximum(gap, 0) / dt)),
      "What has collided gets no impulse at rest: the load of this step presses it into the other body.",
      "A ball rebounds without restitution. What carries its weight in this step?"),
    M("respond", "gap times dt",
      responds(least=lambda c, parting, gap, dt: np.where(c, np.maximum(parting, 0), -np.maximum(gap, 0) * dt)),
      "The gap is multiplied by dt: a length becomes no speed by that.",
      "What unit has the gap times dt?"),
    M("respond", "forces returned", as_forces,
      "Forces are returned in place of impulses.",
      "What unit has the third thing that you return?"),
    M("respond", "the largest least speed", responds(least=the_hastiest),
      "All contacts have the largest of the least speeds.",
      "One corner of a box has collided, and another has a gap. Have both to part at the same speed?"),
    M("step_world", "impulses of the start", steps(told=lambda impulse, begin: begin),
      "The impulses that are returned are those with which the step began.",
      "Which impulses should the next step begin with?"),
    M("step_world", "overlaps with the old velocities", steps(overlap=of_the_start),
      "`out_of_overlap` gets the velocities of the start: it should know how the bodies move in this step.",
      "How deep will a ball be at the end of the step, if it has just rebounded?"),
    M("step_world", "no turn out of overlaps", steps(out=no_turn),
      "The bodies are moved out of overlaps, and not turned.",
      "`out_of_overlap` returns six numbers for each body. What are the last three?"),
    M("step_world", "turned into the overlap", steps(out=turn_against_it),
      "The turn out of overlaps has the wrong sign.",
      "One corner of a box has sunk in. Which way should the box turn?"),
    M("step_world", "out of overlaps after the turn", steps(out=turn_at_the_end),
      "The turn out of overlaps comes after the free turn. The new spin then does not fit the body as it lies.",
      "For which orientation does `rotate_by_momentum` find the new spin?"),
    M("step_world", "way times dt", steps(way=lambda push, dt: push * dt),
      "The way out of overlaps is multiplied by dt: it is a length already.",
      "What unit has the result of `out_of_overlap`?"),
    M("step_world", "way out as a speed", steps(way=lambda push, dt: 0 * push, faster=lambda push, dt: push / dt),
      "The way out of overlaps becomes a velocity: what sinks in is thrown out, and gains energy.",
      "A ball has sunk into the floor and rests. Which velocity should it have after the step?"),
    M("step_world", "way out twice", steps(way=lambda push, dt: 2 * push),
      "The bodies are moved out of overlaps twice as far.",
      "How far should a ball rise that has sunk in by 10 cm?"),
    M("step_world", "turned with the old spin", turned_with_the_old_spin,
      "`rotate_by_momentum` gets the spin of the start: impacts and torques do not change it.",
      "Which spin does a body have after `respond`?"),
    M("step_world", "weight twice", weight_twice,
      "The weight acts twice: it is added to the velocities, and it is in the load.",
      "How fast should a ball fall after a step of 1/8 s from rest?"),
    M("step_world", "always ten sweeps", steps(often=lambda sweeps: 10),
      "There are ten sweeps, whatever number is asked for.",
      "Which of the rules makes no difference to your answer?"),
    M("step_world", "torque along its own axes", torque_of_its_own_axes,
      "The torque is taken along the body's own axes; it is given along those of the world.",
      "In which frame is the torque given?"),
    M("step_world", "no margin", steps(margin=lambda margin: 0 * margin),
      "The contacts are looked for without the margin.",
      "Which of the rules makes no difference to your answer?"),
    M("step_world", "weight along z", steps(weight=lambda mass, g: mass * g * [0.0, 0.0, 1.0]),
      "Only the z component of the acceleration acts.",
      "Does everything fall along z?"),
    M("step_world", "the same weight for all", steps(weight=lambda mass, g: (mass > 0) * np.max(mass, initial=0) * g),
      "All bodies have the weight of the heaviest.",
      "How large is the weight of each body?"),
    M("step_world", "force of the first body", force_of_the_first,
      "The force on body 0 acts on all bodies.",
      "`force` has a row for each body. Which of them makes no difference to your answer?"),
)
# fmt: on
