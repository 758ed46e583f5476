"""Known mistakes about what contacts do in a step, and about the step itself."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from solutions.impulse import Body, world_inverse_inertia
from solutions.world import (
    collect_contacts,
    collide_with_friction,
    contact_frames,
    contacts_by_pair,
    inverse_mass_matrix,
    kept_impulses,
    out_of_overlap,
    resting_problem,
    rotate_by_momentum,
    sequential_impulses,
    solve_by_sweeps,
    turned,
)

COLUMNS = np.array([1.0, 0.0, 0.0])


def middle(places, closing):
    return np.mean(places[closing], axis=0)


def response(
    bodies,
    state,
    contacts,
    load,
    dt,
    rest_speed,
    sweeps,
    start,
    rounds=100,
    place=lambda points, pair, closing: middle(points, closing),
    closes=lambda speed, rest_speed: speed < -rest_speed,
    split=False,
    order=lambda pairs: pairs,
    e=lambda table, i, j: table[i, j],
    mu=lambda table, i, j: table[i, j],
    loads_first=False,
    least=lambda collided, parting, gap, dt: np.where(collided, np.maximum(parting, 0), -np.maximum(gap, 0) / dt),
    offset=lambda parting, dt, gained, least: parting + dt * gained - least,
    begin=lambda start: start,
    often=lambda sweeps: sweeps,
    solve=solve_by_sweeps,
    loaded=lambda motion, dt, share, load: motion + dt * share @ load,
    given=lambda share, normals, pressed: share @ normals.T @ pressed,
    rough=True,
    told=lambda impulse: impulse,
    turns=world_inverse_inertia,
    both=True,
    arm=lambda arm: arm,
    stale=False,
    twice=False,
    rough_least=lambda least: least,
    rub=lambda table, a, b: table[a, b],
    first_alone=False,
    early=False,
):
    """Impacts, then rest; each part may be another one."""
    inverse_mass, moments, restitution, friction, *_ = bodies
    position, orientation, velocity, spin = state
    a, b, point, normal, gap, _ = contacts
    inverse = turns(moments, orientation)
    share = inverse_mass_matrix(inverse_mass, inverse)
    motion = np.concatenate([velocity, spin], axis=-1)
    before = motion.ravel().copy()
    if loads_first:
        motion = loaded(motion.ravel(), dt, share, load.ravel()).reshape(-1, 6)
    rows = contact_frames(contacts, position)

    def body(k, at):
        return Body(motion[k, :3], motion[k, 3:], arm(at - position[k]), inverse_mass[k], inverse[k])

    collided = np.zeros(len(a), dtype=bool)
    for _ in range(rounds):
        quiet = True
        for pair in order([each[k : k + 1] for each in contacts_by_pair(contacts) for k in range(len(each))]
                          if split else contacts_by_pair(contacts)):  # fmt: skip
            speed = rows[pair, 0] @ motion.ravel()
            closing = pair[closes(speed, rest_speed) & (early | (dt * speed < -gap[pair]))]
            if len(closing):
                i, j, at = a[pair[0]], b[pair[0]], place(point, pair, closing)
                after = collide_with_friction(
                    body(i, at), body(j, at), normal[pair[0]], e(restitution, i, j), mu(friction, i, j)
                )
                motion[i] = np.concatenate(after[:2])
                if both:
                    motion[j] = np.concatenate(after[2:])
                collided[pair], quiet = True, False
                if first_alone:
                    break
        if quiet:
            break
    normals = rows[:, 0]
    matrix, gained = resting_problem(normals, share, load.ravel())
    parting = normals @ (before if stale else motion.ravel())
    gained = 0 * gained if loads_first else gained
    speeds = least(collided, parting, gap, dt)
    pressed = solve(matrix, offset(parting, dt, gained, speeds), often(sweeps), begin(start)[:, 0])
    moved = motion.ravel() if loads_first else loaded(motion.ravel(), dt, share, load.ravel())
    ended, impulse = moved + given(share, normals, pressed), pressed[:, None] * COLUMNS
    if rough and np.any(friction[a, b]):
        first = np.concatenate([pressed[:, None], begin(start)[:, 1:]], axis=-1)
        moved = ended if twice else moved
        rubbed = rub(friction, a, b)
        ended, impulse = sequential_impulses(moved, rows, share, rubbed, often(sweeps), first, rough_least(speeds))
    ended = ended.reshape(-1, 6)
    return ended[:, :3], ended[:, 3:], told(impulse)


def with_(**parts):
    return lambda *given: response(*given, **parts)


def never(matrix, offset, sweeps, start):
    return 0 * offset


def of_balls(moments, orientation):
    """Nothing turns."""
    return 0 * world_inverse_inertia(moments, orientation)


def step(
    bodies,
    state,
    acceleration,
    dt,
    rules,
    memory=None,
    force=(0.0, 0.0, 0.0),
    torque=(0.0, 0.0, 0.0),
    weight=lambda mass, acceleration: mass * acceleration,
    loads=lambda push, torque: np.concatenate([push, np.broadcast_to(torque, push.shape)], axis=-1),
    forces=lambda weight, force: weight + force,
    margin=lambda margin: margin,
    start=kept_impulses,
    way=lambda push, dt: push,
    place=lambda x, dt, before, after: x + dt * after,
    turn=rotate_by_momentum,
    responds=response,
    later=False,
    swapped=False,
    key=lambda keys: keys,
    told=lambda impulse, begin: impulse,
    often=lambda sweeps: sweeps,
    overlap=lambda bodies, state, after, contacts, dt: out_of_overlap(bodies, after, contacts, dt),
    out=lambda orientation, spin, push, moments, dt, turn: turn(turned(orientation, push), spin, moments, dt),
    faster=lambda push, dt: 0 * push,
):
    """A step of the world; each part may be another one."""
    inverse_mass, moments, *_ = bodies
    position, orientation = state[:2]
    rest_speed, gap, sweeps = rules
    mass = np.where(inverse_mass > 0, 1 / np.where(inverse_mass > 0, inverse_mass, 1.0), 0.0)[:, None]
    load = loads(forces(weight(mass, np.asarray(acceleration)), np.asarray(force)), np.asarray(torque))
    seen = (position + dt * state[2], *state[1:]) if later else state
    contacts = collect_contacts(bodies, seen, margin(gap))
    begin = start(memory, contacts)
    velocity, spin, impulse = responds(bodies, state, contacts, load, dt, rest_speed, often(sweeps), begin)
    found = overlap(bodies, state, (position, orientation, velocity, spin), contacts, dt)
    push, more = way(found, dt), faster(found, dt)
    velocity, spin = velocity + more[:, :3], spin + more[:, 3:]
    after = place(position, dt, state[2], velocity) + push[:, :3]
    orientation, spin = out(orientation, spin, push[:, 3:], moments, dt, turn)
    return after, orientation, velocity, spin, key(contacts[-1]), told(impulse, begin)


def steps(**parts):
    return lambda *given: step(*given, **parts)


def spin_kept(orientation, spin, moments, dt):
    return turned(orientation, spin * dt), spin


# fmt: off
BANK = (
    M("respond", "no impacts", with_(rounds=0),
      "Nothing rebounds: every contact is treated as one that rests.",
      "A ball falls at 4 m/s onto the floor with e = ½. How fast does it leave?"),
    M("respond", "one round", with_(rounds=1),
      "Every pair gets its impulse once. An impact may make another pair collide that had its turn before.",
      "After the last pair: is there one that closes faster than rest_speed?"),
    M("respond", "nothing rests", with_(solve=never, rough=False),
      "There are impacts only. What lies on the floor falls through it, a little in each step.",
      "A ball rests on the floor, and its weight acts for dt. How fast may it move down afterwards?"),
    M("respond", "the loads come first", with_(loads_first=True),
      "The loads act before the impacts: a ball then rebounds with the speed that its weight has just added.",
      "An impact is very short. How much does weight do in it? With which velocity does the ball arrive?"),
    M("respond", "rest_speed forgotten", with_(closes=lambda u, rest: u < 0),
      "Whatever closes collides, however slowly: nothing ever comes to rest.",
      "Slide 21 has three cases. In which of them is a contact that closes more slowly than rest_speed?"),
    M("respond", "struck before it touches", with_(early=True),
      "Whatever closes fast collides at once, although its gap would still be open at the end of the step.",
      "The gap is 6 cm, the points close at 1 m/s, and the step is 1/100 s. Do they touch in this step?"),
    M("respond", "collides if it parts", with_(closes=lambda u, rest: u > rest, rounds=1, early=True),
      "A contact collides where its points part. The normal points from B to A, so that closing is negative.",
      "What sign has the normal velocity of two points that come nearer?"),
    M("respond", "size of the speed", with_(closes=lambda u, rest: np.abs(u) > rest, rounds=1, early=True),
      "It asks for the size of the speed: contacts whose points part collide, too.",
      "A ball leaves the floor at 3 m/s. Does it collide?"),
    M("respond", "the first place alone", with_(place=lambda points, pair, closing: points[closing[0]]),
      "Two bodies in touch at several places get their impulse at the first of them: a box that lands flat is turned.",
      "A box lands flat. Where is the middle of the places at which it collides?"),
    M("respond", "the middle of all places", with_(place=lambda points, pair, closing: np.mean(points[pair], axis=0)),
      "The impulse is in the middle of all places of two bodies, also of those that do not collide.",
      "A box lands with one corner first. Which places collide?"),
    M("respond", "each place by itself", with_(split=True),
      "Each place gets an impulse of its own, one after another: a box that lands flat is turned by the first.",
      "A box lands flat on four corners. Should it turn? What does the impulse of the first corner do?"),
    M("respond", "from the right", with_(order=lambda pairs: pairs[::-1]),
      "The pairs have their turns from the last to the first.",
      "Which pair comes first?"),
    M("respond", "perfect always", with_(e=lambda table, i, j: 1.0),
      "Every impact is perfect: the restitution makes no difference.",
      "Which part of `bodies` makes no difference to your answer?"),
    M("respond", "no rebound", with_(e=lambda table, i, j: 0.0),
      "No impact has a rebound: the restitution makes no difference.",
      "Which part of `bodies` makes no difference to your answer?"),
    M("respond", "the first pair's restitution", with_(e=lambda table, i, j: table[0, 1]),
      "There is one restitution for all pairs; the table has one for each two bodies.",
      "Where in the table is the restitution of the two bodies of this contact?"),
    M("respond", "impacts without friction", with_(mu=lambda table, i, j: 0.0),
      "Impacts have no friction; only what rests has.",
      "A spinning ball strikes a rough floor. Does it keep its spin?"),
    M("respond", "no friction", with_(mu=lambda table, i, j: 0.0, rough=False),
      "There is no friction at all.",
      "Which part of `bodies` makes no difference to your answer?"),
    M("respond", "rest without friction", with_(rough=False),
      "What rests has no friction: a box on a slope slides off.",
      "Which function continues the sweeps where there is friction?"),
    M("respond", "one body of two", with_(both=False),
      "In an impact only A gets its new velocities.",
      "What does Newton's third law say of B?"),
    M("respond", "not carried", with_(least=lambda c, parting, gap, dt: -np.maximum(gap, 0) / dt),
      "What has just collided loses the weight of this step from its rebound. It is carried in the step of its impact.",
      "Which speed does the description ask for, at a contact that has collided?"),
    M("respond", "gap forgotten", with_(least=lambda c, parting, gap, dt: np.where(c, np.maximum(parting, 0), 0.0)),
      "Bodies stop where their gap is still open: they may close it in this step.",
      "The gap is 6 cm and the step is 1/8 s. How fast may the points close?"),
    M("respond", "gap's sign",
      with_(least=lambda c, parting, gap, dt: np.where(c, np.maximum(parting, 0), np.maximum(gap, 0) / dt)),
      "The gap has the wrong sign: the points are made to part by it.",
      "The gap is 6 cm. May the points come nearer, or have they to part?"),
    M("respond", "overlap thrown out",
      with_(least=lambda c, parting, gap, dt: np.where(c, np.maximum(parting, 0), -gap / dt)),
      "An overlap counts as a negative gap: the bodies are thrown apart, and gain energy.",
      "A ball has sunk into the floor by 25 cm. With what speed should it leave?"),
    M("respond", "gap over no time",
      with_(least=lambda c, parting, gap, dt: np.where(c, np.maximum(parting, 0), -np.maximum(gap, 0))),
      "The gap itself is taken for a speed: it is not divided by dt.",
      "What unit has the gap? What unit has the least speed?"),
    M("respond", "load not through dt", with_(offset=lambda parting, dt, gained, least: parting + gained - least),
      "b is an acceleration; what the contacts gain in this step is b dt.",
      "What unit has each term of the offset?"),
    M("respond", "load left out of the problem", with_(offset=lambda parting, dt, gained, least: parting - least),
      "The contacts do not know of the loads: the impulses end the approach as it was, and then the weight acts.",
      "At the end of the step, how fast does a resting ball move in your answer?"),
    M("respond", "least speed added", with_(offset=lambda parting, dt, gained, least: parting + dt * gained + least),
      "The least speed is added where it has to be subtracted: G v + b dt − least is what must not be negative.",
      "A gap is open. Does your offset become larger or smaller by it?"),
    M("respond", "no load", with_(loaded=lambda motion, dt, share, load: motion),
      "The loads press on the contacts but move no body.",
      "A ball in the air: which velocity has it after the step?"),
    M("respond", "load times dt forgotten", with_(loaded=lambda motion, dt, share, load: motion + share @ load),
      "The whole acceleration is added to the velocity: it is not multiplied by dt.",
      "What unit has M⁻¹ F? What unit has a velocity?"),
    M("respond", "load not over the mass",
      with_(loaded=lambda motion, dt, share, load: motion + dt * (np.diag(share) > 0) * load),
      "The load is added to the velocity without M⁻¹.",
      "Two bodies of different masses are pushed alike. Do they gain the same velocity?"),
    M("respond", "impulses pull",
      with_(given=lambda share, normals, pressed: -share @ normals.T @ pressed),
      "The impulses have the wrong sign: they press the bodies into each other.",
      "A ball rests on the floor. Which way does the floor's impulse point?"),
    M("respond", "impulses not over the mass",
      with_(given=lambda share, normals, pressed: (np.diag(share) > 0) * (normals.T @ pressed)),
      "The impulses are added to the velocities without M⁻¹.",
      "What unit has Gᵀ j? What unit has a velocity?"),
    M("respond", "start left out", with_(begin=lambda start: 0 * start),
      "The sweeps always begin with no impulses.",
      "Which argument makes no difference to your answer?"),
    M("respond", "always one sweep", with_(often=lambda sweeps: min(sweeps, 1)),
      "There is one sweep, whatever number is asked for.",
      "Which argument makes no difference to your answer?"),
    M("respond", "nothing turns", with_(turns=of_balls),
      "The bodies cannot turn: there is no inverse inertia.",
      "A box lands on one corner. Does it turn?"),
    M("respond", "impulses of the step before",
      lambda *given: (*response(*given)[:2], np.array(given[-1], dtype=float)),
      "The impulses that are returned are those with which the sweeps began.",
      "Which impulses should the next step begin with?"),
    M("step_world", "old velocity", steps(place=lambda x, dt, before, after: x + dt * before),
      "The bodies move with the velocities of the start: explicit Euler. What falls is one step late.",
      "With which velocity does the description move the bodies?"),
    M("step_world", "mean velocity", steps(place=lambda x, dt, before, after: x + dt * (before + after) / 2),
      "The bodies move with the mean of the old and the new velocities; after an impact that leads into the floor.",
      "With which velocity does the description move the bodies?"),
    M("step_world", "no weight", steps(weight=lambda mass, g: 0 * mass * g),
      "Nothing has a weight.",
      "Which argument makes no difference to your answer?"),
    M("step_world", "weight without mass", steps(weight=lambda mass, g: (mass > 0) * g),
      "g is taken for a force: all bodies have the weight of 1 kg.",
      "What unit has the load? How large is the weight of a body?"),
    M("step_world", "weight turned round", steps(weight=lambda mass, g: -mass * g),
      "The weight has the wrong sign.",
      "g is a vector. Which way does it point?"),
    M("step_world", "forces left out", steps(forces=lambda weight, force: weight + 0 * force),
      "The other forces do nothing.",
      "Which argument makes no difference to your answer?"),
    M("step_world", "forces for accelerations",
      lambda b, s, g, dt, rules, memory=None, force=(0.0, 0.0, 0.0), torque=(0.0, 0.0, 0.0):
      step(b, s, g, dt, rules, memory, np.asarray(force) / np.where(b[0] > 0, b[0], 1.0)[:, None], torque),
      "The forces are taken for accelerations.",
      "A force of 8 N acts on 1 kg, and on 4 kg. Which body gains more speed?"),
    M("step_world", "torques left out", steps(loads=lambda push, torque: np.concatenate([push, 0 * push], axis=-1)),
      "The torques do nothing.",
      "Which argument makes no difference to your answer?"),
    M("step_world", "spin kept", steps(turn=spin_kept),
      "The spin is kept in place of the angular momentum: nothing ever tumbles.",
      "Which function turns a body and finds its new spin?"),
    M("step_world", "nothing turns", steps(turn=lambda q, w, moments, dt: (q, w)),
      "The orientations stay as they are.",
      "A ball spins. How does it lie after the step?"),
    M("step_world", "not out of overlaps", steps(way=lambda push, dt: 0 * push),
      "Overlaps are never moved away: what has sunk in stays there.",
      "A ball has sunk into the floor. Which of the given functions brings it out?"),
    M("step_world", "into the overlaps", steps(way=lambda push, dt: -push),
      "Bodies are moved deeper into their overlap.",
      "Which way should a ball move that has sunk into the floor?"),
    M("step_world", "contacts at the end", steps(later=True),
      "The contacts are looked for where the bodies would be after the step.",
      "At which places does the description look for contacts?"),
    M("step_world", "memory left out", steps(start=lambda memory, contacts: np.zeros((len(contacts[0]), 3))),
      "The impulses of the last step are forgotten: a tall stack never finds its weight.",
      "Which argument makes no difference to your answer?"),
    M("step_world", "no memory", steps(told=lambda impulse, begin: 0 * impulse),
      "The impulses that are returned are all zero.",
      "What should the next step begin with?"),
)
# fmt: on
