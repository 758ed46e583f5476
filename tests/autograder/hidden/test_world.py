"""Impacts in a row and resting contact: drawn examples, limiting cases, and many at once."""

from __future__ import annotations

import math

import numpy as np

from labs.grading.diagnosis.probes.world_scenes import orientation
from labs.grading.judging.comparison import expect, numbers, plainly, refuse_changes
from labs.grading.judging.markers import asks
from labs.plain_worlds import BALL, BOX, FLOOR, PLANE, contacts, load, thing, world

X, Y, UP, LEANS, REST = [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1 / 3, 2 / 3, 2 / 3], [0.0, 0.0, 0.0]
INFINITY = math.inf


def row(velocity, mass, e):
    """Pair after pair from the left, and again, until no ball is faster than the next."""
    v, m = [float(each) for each in velocity], np.broadcast_to(mass, len(velocity))
    e = np.broadcast_to(e, max(len(v) - 1, 0))
    for _ in range(2000):
        for i in range(len(v) - 1):
            closing = v[i] - v[i + 1]
            if closing > 0 and m[i + 1] == INFINITY:
                v[i] = v[i + 1] - e[i] * closing
            elif closing > 0:
                centre = (m[i] * v[i] + m[i + 1] * v[i + 1]) / (m[i] + m[i + 1])
                v[i] = centre - e[i] * closing * m[i + 1] / (m[i] + m[i + 1])
                v[i + 1] = centre + e[i] * closing * m[i] / (m[i] + m[i + 1])
    return np.array(v)


@asks("propagate_impacts", 5, "Each impact of two keeps their momentum and leaves e of their closing speed.")
def test_each_impact_of_two_in_the_row(submission, part, examples):
    masses = [2.0, 1.0, 0.5]

    def rows(draw):
        return draw.vector(3), np.array(masses), 0.75

    with part(2, "any three balls"):
        examples.agree(submission.propagate_impacts, row, rows, count=6)
    with part(2, "a wall, one ball, parting, from the right, restitutions that differ"):
        for case in (
            ([1, 0, 0], [1, 1, INFINITY], 1.0), ([3], 1.0, 0.5), ([-1, 0, 2], 1.0, 0.5), ([0, 0, -1], 1.0, 1.0),
            ([2, 0, 0], 1.0, [0.5, 1.0]), ([2, 2, 2], 1.0, 0.5), ([1, 0, 0], [3, 1, 1], 1.0), ([1, 0], [1, 4], 1.0),
            ([2, -1], [1, 3], 0.0), ([2, -1], [2, 1], 0.5), ([1, 0, 0], 1.0, 0.5), ([1, 1, 0, 0, 0], 1.0, 1.0),
        ):  # fmt: skip
            case = plainly(*case)
            expect(submission.propagate_impacts, case, row(*case))
        for size in (1e-6, 1e6):
            v, masses = np.array([2.0, 1.0, -1.0]), np.array([2.0, 1.0, 3.0])
            expect(submission.propagate_impacts, (size * v, masses, 1.0), size * row(v, masses, 1.0))
            expect(submission.propagate_impacts, (v, size * masses, 1.0), row(v, masses, 1.0))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.propagate_impacts, row, rows, single=(1, 2))


def matrix_of(q):
    """The columns are a body's axes, turned one by one by the quaternion."""
    w, v = q[0], q[1:]
    return np.stack([e + 2 * w * np.cross(v, e) + 2 * np.cross(v, np.cross(v, e)) for e in np.eye(3)], axis=-1)


def turn_by(q, rotation):
    angle = math.sqrt(rotation @ rotation)
    axis = rotation / angle if angle else rotation
    w, v = math.cos(angle / 2), math.sin(angle / 2) * axis
    return np.array([w * q[0] - v @ q[1:], *(w * q[1:] + q[0] * v + np.cross(v, q[1:]))])


def free_turn(q, w, moments, dt):
    after = turn_by(q, w * dt)
    if not np.all(np.isfinite(moments)):
        return after, w
    inertia, other = (matrix_of(each) @ np.diag(moments) @ matrix_of(each).T for each in (q, after))
    return after, np.linalg.solve(other, inertia @ w)


@asks("rotate_by_momentum", 5, "The body turns by ω dt, and then it has the ω that gives the old angular momentum.")
def test_a_free_body_keeps_its_angular_momentum(submission, part, examples):
    def body(draw):
        return orientation(draw), draw.vector(3), np.abs(draw.vector(2)) + 0.2, 0.25

    with part(2, "any body"):
        examples.agree(submission.rotate_by_momentum, free_turn, body)
    with part(2, "a ball, a rest, a body that is held, no time, back in time, fast, small, and heavy"):
        q, w = np.array([0.8, 0.0, 0.6, 0.0]), np.array([0.5, 2.0, -1.0])
        brick, held = np.array([1.0, 2.0, 3.0]), np.full(3, INFINITY)
        for spin, moments, dt in (
            (w, np.full(3, 2.0), 0.25), (0 * w, brick, 0.25), (w, held, 0.25), (w, brick, 0.0), (w, brick, -0.5),
            (500 * w, brick, 0.003), (w, 1e-7 * brick, 0.25), (w, 1e7 * brick, 0.25), (1e-7 * w, brick, 1e6),
            (1e-6 * w, brick, 0.25), (1e5 * w, brick, 1e-6),
        ):  # fmt: skip
            expect(submission.rotate_by_momentum, (q, spin, moments, dt), free_turn(q, spin, moments, dt))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.rotate_by_momentum, free_turn, body, single=(3,))


def overlapping(lower, upper):
    """Each pair by itself."""
    found = []
    for j in range(len(lower)):
        for i in range(j):
            gaps = [max(lower[i][k], lower[j][k]) - min(upper[i][k], upper[j][k]) for k in range(3)]
            found += [(i, j)] if max(gaps) <= 0 else []
    return np.array(sorted(found), dtype=float).reshape(-1, 2)


@asks("candidate_pairs", 4, "Two boxes overlap if along each axis none of them begins after the other ends.")
def test_two_boxes_overlap_if_they_do_along_each_axis(submission, part, examples):
    def boxes(draw):
        corner = np.array([draw.vector(3) for _ in range(6)])
        return corner, corner + np.abs([draw.vector(4) for _ in range(6)])

    with part(2, "any six boxes, near and far, large and small"):
        examples.agree(submission.candidate_pairs, overlapping, boxes)
        for size, place in ((1e-6, 0.0), (1e6, 0.0), (1.0, 1e5), (1e-3, -7.0)):
            low, high = (place + size * each for each in boxes_of_a_heap())
            expect(submission.candidate_pairs, (low, high), overlapping(low, high))
    with part(1, "they touch, one is without end, one has no size, there is one alone, none overlap"):
        end = [INFINITY] * 3
        for low, high in (
            ([[0, 0, 0], [2, 1, 1]], [[2, 2, 2], [3, 3, 3]]), ([[0, 0, 0], [1, 2, 1]], [[2, 2, 2], [3, 3, 3]]),
            ([[0, 0, 0], [-INFINITY] * 3], [[1, 1, 1], end]), ([[0, 0, 0], [1, 1, 1]], [[2, 2, 2], [1, 1, 1]]),
            ([[0, 0, 0]], [[2, 2, 2]]), ([[0, 0, 0], [1, 1, 3]], [[2, 2, 2], [4, 4, 4]]),
        ):  # fmt: skip
            expect(submission.candidate_pairs, (low, high), overlapping(np.array(low, float), np.array(high, float)))
    with part(1, "the smaller number first, in ascending order, arrays left as they were"):
        low, high = (
            np.array([[0.0, 0, 0], [7, 7, 7], [7, 8, 7], [1, 1, 1]]),
            np.array([[2.0, 2, 2], [9, 9, 9], [8, 9, 9], [3, 3, 3]]),
        )
        expect(submission.candidate_pairs, (low, high), [[0, 3], [1, 2]])
        low, high = boxes_of_a_heap()
        for order in ([4, 2, 0, 1, 3], [3, 4, 1, 0, 2], [0, 3, 4, 2, 1]):
            expect(submission.candidate_pairs, (low[order], high[order]), overlapping(low[order], high[order]))
            refuse_changes(submission.candidate_pairs)


def boxes_of_a_heap():
    low = np.array([[0.0, 0, 0], [1, 1, 1], [0.5, -1, 0.5], [3, 3, 3], [-1, -1, -1]])
    return low, low + np.array([[2.0, 2, 2], [2.5, 2.25, 2.5], [1, 1.5, 4], [1, 2, 1], [0.75, 9, 9]])


def round_contacts(bodies, state, margin):
    """The contacts of balls with balls, planes and boxes, pair by pair; no other two bodies are in these scenes."""
    share, *_, meet, kind, size = bodies
    position, orientation = state[:2]
    found = []
    for j in range(len(kind)):
        for i in range(j):
            a, b = (i, j) if kind[i] <= kind[j] else (j, i)
            if kind[a] != BALL or not meet[a, b] or share[a] + share[b] == 0:
                continue
            turn, radius = matrix_of(orientation[b]), size[a][0]
            if kind[b] == PLANE:
                normal = turn @ size[b]
                middle = position[a] - normal * (normal @ (position[a] - position[b]))
                depth = 0.0
            else:
                seen = turn.T @ (position[a] - position[b])
                half = size[b] if kind[b] == BOX else np.zeros(3)
                middle = position[b] + turn @ np.clip(seen, -half, half)
                depth = 0.0 if kind[b] == BOX else size[b][0]
                normal = (position[a] - middle) / math.dist(position[a], middle)
            gap = normal @ (position[a] - middle) - radius - depth
            if gap <= margin:
                found.append((min(a, b), max(a, b), a, b, middle + normal * (depth + gap / 2), normal, gap))
    found.sort(key=lambda each: each[:2])
    columns = [[each[at] for each in found] for at in range(2, 7)]
    key = [(each[2] * len(kind) + each[3]) * 65536 for each in found]
    shapes = (-1,), (-1,), (-1, 3), (-1, 3), (-1,), (-1,)
    return tuple(np.array(c, dtype=float).reshape(s) for c, s in zip([*columns, key], shapes, strict=True))


def is_hidden(box, a, b, point, normal, gap, _):
    """Whether the box is touched behind what else the same ball touches; the given function leaves such a place out."""
    for i in np.flatnonzero(b == box):
        for j in np.flatnonzero((np.arange(len(b)) != i) & ((a == a[i]) | (b == a[i]))):
            away = normal[j] if a[j] == a[i] else -normal[j]
            surface = point[j] - away * gap[j] / 2
            if away @ (point[i] - normal[i] * gap[i] / 2 - surface) <= 1e-6 * abs(gap[i]):
                return True
    return False


@asks("collect_contacts", 7, "Boxes around bodies find the pairs, and the given function where their surfaces touch.")
def test_contacts_are_found_where_surfaces_are_near(submission, part, examples):
    def balls(draw, size=1.0):
        things = [thing(PLANE, draw.unit(), position=size * draw.vector(1))]
        things += [thing(BALL, size * draw.number(0.3, 0.9), 1.0, size * draw.vector(1.2)) for _ in range(4)]
        half, middle, q = size * (np.abs(draw.vector(0.5)) + 0.05), size * (draw.vector(1) + 2), orientation(draw)
        margin = size * (draw.number(0.01, 0.4) + 0.00137)  # no gap of short numbers is just as large
        meet = np.ones((6, 6), dtype=bool)
        meet[0, 2] = meet[2, 0] = meet[1, 4] = meet[4, 1] = False  # the box is not to meet the plane
        while True:
            given = (*world([*things[:2], thing(BOX, half, 2.0, middle, q), *things[2:]], meet=meet), margin)
            # Where a ball's centre is in the box, no point of the box is nearest to it.
            inside = any(np.all(np.abs(matrix_of(q).T @ (ball[4] - middle)) <= half) for ball in things[1:])
            if not inside and not is_hidden(2, *round_contacts(*given)):
                return given
            middle = middle + 0.25 * size

    with part(2, "any balls, a box and a plane"):
        examples.agree(submission.collect_contacts, round_contacts, balls, count=6)
    with part(1, "in micrometres and in kilometres"):
        for size in (1e-6, 1e6):
            examples.agree(submission.collect_contacts, round_contacts, lambda draw, size=size: balls(draw, size), 2)
        far = [thing(BALL, 1e5, 1.0, (-2e5, 0, 0)), thing(BALL, 1e5, 1.0, (1e5, 0, 0))]
        expect(submission.collect_contacts, (*world(far), 1.5e5), round_contacts(*world(far), 1.5e5))
    with part(2, "a box on the floor, and one that leans: the corners that are near"):
        for q, half, height in (([1, 0, 0, 0], [0.5, 0.25, 0.75], 0.745), ([0.8, 0, 0.6, 0], [0.5, 1, 2], 1.7)):
            for order in (1, -1):
                things = [FLOOR, thing(BOX, half, 3.0, (1, -1, height), q)][::order]
                expect(submission.collect_contacts, (*world(things), 0.05), box_on_floor(q, half, height, order))
    with part(1, "rods that are turned, with a ball at their end"):
        for q in ([0.5, 0.5, 0.5, 0.5], [0.5, -0.5, -0.5, -0.5], [0.1, 0.5, 0.5, 0.7], [0.2, 0.4, -0.8, 0.4]):
            way = matrix_of(np.array(q))[:, 0]
            beside = np.cross(way, [0.1, 0.2, 0.3])
            place = 2.9 * way + 0.3 * beside / math.sqrt(beside @ beside)
            given = (*world([thing(BALL, 0.3, 1.0, place - 5), thing(BOX, (3, 0.1, 0.1), 1.0, (-5, -5, -5), q)]), 0.01)
            expect(submission.collect_contacts, given, round_contacts(*given))
    with part(1, "immovable bodies, those that do not meet, nothing in touch; arrays left as they were"):
        low = thing(BALL, 0.5, 2.0, (3, 1, 0.45))
        for things, meet in (
            ([FLOOR, thing(BALL, 1.0, position=(3, 1, -0.5)), low], True),
            ([FLOOR, low], [[True, False], [False, True]]),
            ([low, thing(BALL, 0.5, 1.0, (0, 5, 0))], True),
            ([low], True),
        ):
            given = (*world(things, meet=meet), 0.01)
            expect(submission.collect_contacts, given, round_contacts(*given))
            refuse_changes(submission.collect_contacts)


def box_on_floor(q, half, height, order):
    """The corners of a box that are at most 5 cm above the floor, in the order of x, y and z."""
    corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    places = np.array([[1, -1, height] + matrix_of(np.array(q, float)) @ (np.array(c) * half) for c in corners])
    near = np.flatnonzero(places[:, 2] <= 0.05)
    a, b = (1, 0) if order == 1 else (0, 1)
    up = np.tile([0.0, 0, 1], (len(near), 1))
    middle = places[near] - up * places[near, 2:] / 2
    return np.full(len(near), a), np.full(len(near), b), middle, up, places[near, 2], (2 * a + b) * 65536 + near


@asks("resting_problem", 3, "A force at one contact accelerates all contacts of the body.")
def test_a_force_at_one_contact_is_felt_at_the_others(submission, part, examples):
    def problem(g, w, force):
        rows = range(len(g))
        return np.array([[g[i] @ (w @ g[j]) for j in rows] for i in rows]), np.array([g[i] @ (w @ force) for i in rows])

    def bodies(draw):
        half = np.array([draw.vector(1) for _ in range(3)])
        return np.array([draw.vector(2) for _ in range(2)]), half @ half.T + np.eye(3), draw.vector(9)

    with part(1, "any two contacts"):
        examples.agree(submission.resting_problem, problem, bodies)
    with part(1, "no force, an immovable body, no contact"):
        expect(submission.resting_problem, (np.zeros((0, 3)), np.eye(3), REST), (np.zeros((0, 0)), np.zeros(0)))
        for case in (
            ([UP], np.eye(3) / 2, REST),
            ([UP], np.zeros((3, 3)), [0, 0, -20]),
            ([[1, 0], [0, 1]], [[2, 0.5], [0.5, 1]], [-4, 2]),
        ):
            case = plainly(*case)
            expect(submission.resting_problem, case, problem(*case))
        g, w, force = np.array([[1.0, 0.5], [0.0, 2.0]]), np.array([[2.0, 0.5], [0.5, 1.0]]), np.array([-4.0, 2.0])
        for a, b, c in ((1e-6, 1, 1), (1e6, 1, 1), (1, 1e-6, 1), (1, 1e6, 1), (1, 1, 1e-6), (1, 1, 1e6)):
            expect(submission.resting_problem, (a * g, b * w, c * force), problem(a * g, b * w, c * force))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.resting_problem, problem, bodies)


def problem(draw):
    """A and b of three contacts."""
    half = np.array([draw.vector(1.5) for _ in range(3)])
    return half @ half.T + np.eye(3), draw.vector(5)


@asks("solve_by_sweeps", 4, "Contact after contact, each with what the others give now.")
def test_each_contact_sees_what_the_others_give_now(submission, part, examples):
    def sweep(a, b, sweeps, start=0.0):
        f = np.array(np.broadcast_to(start, b.shape), dtype=float)
        for _ in range(int(sweeps)):
            for i in range(len(b)):
                f[i] = max(0.0, f[i] - (a[i] @ f + b[i]) / a[i, i]) if a[i, i] > 0 else 0.0
        return f

    def problems(draw):
        return (*problem(draw), 2, np.abs(draw.vector(2)))

    with part(2, "any three contacts, two sweeps"):
        examples.agree(submission.solve_by_sweeps, sweep, problems)
    with part(1, "no sweep, three and many, from a start, a contact that moves nothing, no contact"):
        coupled = [[2, 1], [1, 2]]
        for case in (
            (coupled, [-4, -4], 0, [1, 2]), (coupled, [4, 4], 3), (coupled, [-6, 4], 3), (coupled, [-4, -4], 1, [3, 1]),
            (coupled, [-4, 2], 1, [5, 5]), ([[2, 0], [0, 0]], [-4, 1], 2), ([[2, 0], [0, 0]], [-4, -1], 2),
            (coupled, [-4, -4], 100),
        ):  # fmt: skip
            case = plainly(*case)
            expect(submission.solve_by_sweeps, case, sweep(*case))
        expect(submission.solve_by_sweeps, (np.zeros((0, 0)), [], 3, []), np.zeros(0))
        a, b, start = np.array([[2.0, -1.0], [-1.0, 2.0]]), np.array([-4.0, 1.0]), np.array([3.0, 1.0])
        for size in (1e-6, 1e6):
            expect(submission.solve_by_sweeps, (size * a, b, 1, start), sweep(size * a, b, 1, start))
            expect(submission.solve_by_sweeps, (a, size * b, 1, size * start), sweep(a, size * b, 1, size * start))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.solve_by_sweeps, sweep, problems, single=(2,))


def frame(n):
    """A normal and two directions at right angles to it."""
    first = np.cross(n, np.eye(3)[np.argmin(np.abs(n))])
    first /= math.sqrt(first @ first)
    return n, first, np.cross(n, first)


def gained(share, turns, arm, n):
    """The change of v and ω that a unit impulse along n gives."""
    return np.concatenate([share * n, turns @ np.cross(arm, n)])


def after_one_contact(bodies, state, touching, load, dt, rest_speed, sweeps, start):
    """Two bodies that touch at one place, without friction: by the formulas of the lectures, in one turn."""
    share, moments, e, *_ = bodies
    position, orientation, velocity, spin = state
    i, j, point, n, gap = (each[0] for each in touching[:5])
    turns = [matrix_of(q) @ np.diag(1 / m) @ matrix_of(q).T for q, m in zip(orientation, moments, strict=True)]
    motion = np.concatenate([velocity, spin], axis=1)
    row = {k: np.concatenate([s * n, np.cross(point - position[k], s * n)]) for k, s in ((i, 1), (j, -1))}
    give = {k: s * gained(share[k], turns[k], point - position[k], n) for k, s in ((i, 1), (j, -1))}
    soft = row[i] @ give[i] + row[j] @ give[j]

    def speed():
        return row[i] @ motion[i] + row[j] @ motion[j]

    def push(impulse):
        for k in (i, j):
            motion[k] = motion[k] + impulse * give[k]

    least = -max(gap, 0) / dt
    if speed() < -rest_speed and gap + dt * speed() < 0:
        push(-(1 + e[i, j]) * speed() / soft)
        least = max(speed(), 0)
    for k in range(len(share)):
        motion[k] = motion[k] + dt * np.concatenate([share[k] * load[k, :3], turns[k] @ load[k, 3:]])
    impulse = max(0.0, (least - speed()) / soft)
    push(impulse)
    return motion[:, :3], motion[:, 3:], np.array([[impulse, 0, 0]])


def after_row(speeds, masses, e, rest_speed=0.1):
    """Balls in a row that touch: pair after pair from the left, and again, until none closes faster than this."""
    v, m = [float(each) for each in speeds], list(masses)
    for _ in range(100):
        quiet = True
        for k in range(len(v) - 1):
            closing = v[k] - v[k + 1]
            if closing > rest_speed:
                j = (1 + e) * closing / (1 / m[k] + 1 / m[k + 1])
                v[k], v[k + 1], quiet = v[k] - j / m[k], v[k + 1] + j / m[k + 1], False
        if quiet:
            break
    return v


def row_of(speeds, masses, e):
    """A row of balls along a slanted line."""
    way = np.array([2, -1, 2]) / 3
    balls = [
        thing(BALL, 0.5, m, k * way, velocity=v * way) for k, (v, m) in enumerate(zip(speeds, masses, strict=True))
    ]
    bodies, state = world(balls, e)
    touching = contacts(*((k + 1, k, (k + 0.5) * way, way, 0.0) for k in range(len(balls) - 1)))
    rest = np.zeros((len(balls), 6))
    return (bodies, state, touching, rest, 0.125, 0.1, 20, np.zeros((len(balls) - 1, 3))), way


@asks("respond", 10, "First the impacts, pair after pair, until none collides; then what rests is carried.")
def test_impacts_come_first_and_then_what_rests_is_carried(submission, part, examples):
    def one(draw, size=1.0, speed=1.0):
        a, b = (
            thing(BOX, size * (np.abs(draw.vector(1)) + 0.2), draw.number(1, 4), size * draw.vector(2),
                  orientation(draw), size * speed * draw.vector(3), speed * draw.vector(2))
            for _ in range(2)
        )  # fmt: skip
        bodies, state = world([a, b], draw.number(0.1, 0.9))
        place = state[0].mean(axis=0) + size * draw.vector(0.3)
        touching = contacts((0, 1, place, draw.unit(), size * draw.number(-0.05, 0.1)))
        push = size * speed**2 * draw.vector(30), size**2 * speed**2 * draw.vector(9)
        loads = np.concatenate([np.tile(push[0], (2, 1)), np.tile(push[1], (2, 1))], axis=1)
        return bodies, state, touching, loads, 0.125 / speed, size * speed, 6, np.zeros((1, 3))

    with part(2, "any two bodies that touch at one place"):
        examples.agree(submission.respond, after_one_contact, one, count=12)
    with part(1, "in millimetres and in kilometres, fast and slow"):
        for size, speed in ((1e-3, 1.0), (1e6, 1.0), (1.0, 1e-6), (1.0, 1e3), (1e-3, 1e3)):
            maker = lambda draw, size=size, speed=speed: one(draw, size, speed)  # noqa: E731
            examples.agree(submission.respond, after_one_contact, maker, count=4)
        for size in (1e-6, 1e6):
            given, way = row_of([0.05 * size, 0], [1, 1], 1.0)  # too slow to collide
            rests = [0.025 * size * way] * 2, np.zeros((2, 3)), [[0.025 * size, 0, 0]]
            expect(submission.respond, (*given[:5], 0.1 * size, *given[6:]), rests)
            things = [FLOOR, thing(BALL, 0.5, size, (0, 0, 0.5))]
            bodies, state = world(things)
            given = (bodies, state, contacts((1, 0, [0, 0, 0], UP, 0.0)), load(bodies), 0.125, 2.5)
            carried = np.array([[1.25 * size, 0, 0]])
            expect(submission.respond, (*given, 0, carried), (np.zeros((2, 3)), np.zeros((2, 3)), carried))
    with part(2, "rows of balls: from the left, masses that differ, both ends, some loss"):
        for speeds, masses, e in (
            ([3, 0, 0, 0], [1, 1, 1, 1], 1.0), ([2, 0, 0], [3, 1, 2], 1.0), ([2, 0, -2], [1, 3, 1], 1.0),
            ([2, 0, 0], [1, 1, 1], 0.5), ([0, 0, -2], [1, 2, 1], 0.75), ([1, 0.95, 0.5], [1, 1, 1], 0.5),
            ([2, 0, -1], [1000, 1, 1200], 1.0),  # 37 rounds
        ):  # fmt: skip
            given, way = row_of(speeds, masses, e)
            given = (*given[:5], 0.0, *given[6:])  # whatever closes collides: nothing is left for the contacts at rest
            v, *_ = numbers(submission.respond, given, 3)
            found, wanted = v @ way, after_row(speeds, masses, e)
            assert np.all(np.diff(found) > -1e-6), "two of the balls still come nearer"
            assert abs(np.dot(masses, found) - np.dot(masses, speeds)) < 1e-4, "the momentum of the row has changed"
            if np.all(np.diff(wanted) >= 0):
                assert np.allclose(found, wanted, atol=1e-4), f"the row moves with {found}, not with {wanted}"
    with part(2, "a box strikes at several places: one impulse, in the middle of those that collide; a rough impact"):
        for velocity, spin, feet in (
            ([0.5, 0, -4], [0, 0, 0], 4), ([0, 0, -4], [0, 0, 0], 2), ([0, 0, -3], [7, 0, 0], 4),
            ([0, 1, -3], [0, 5, 0], 4),
        ):  # fmt: skip
            places = [(0, 1.5, 0), (2, 1.5, 0), (0, 2.5, 0), (2, 2.5, 0)][:feet]
            struck = thing(BOX, (1, 0.5, 2), 3.0, (1, 2, 2), velocity=velocity, spin=spin)
            e = np.array([[1.0, 1.0, 1.0], [1.0, 0.0, 0.25], [1.0, 0.25, 0.0]])
            bodies, state = world([thing(BALL, 0.5, 1.0, (40, 0, 9)), struck, FLOOR], e)
            falls = [np.add(velocity, np.cross(spin, np.subtract(p, [1, 2, 2])))[2] for p in places]
            middle = np.mean([p for p, u in zip(places, falls, strict=True) if u < -1], axis=0)
            still = np.zeros((3, 6)), 0.125, 1.0, 20
            one = after_one_contact(bodies, state, contacts((1, 2, middle, UP, 0.0)), *still, np.zeros((1, 3)))
            standing = contacts(*((1, 2, p, UP, 0.0) for p in places)), *still, np.zeros((feet, 3))
            found = numbers(submission.respond, (bodies, state, *standing), 3)
            assert np.allclose(found[0], one[0], atol=1e-4), f"the box leaves with {found[0][1]}, not with {one[0][1]}"
            assert np.allclose(found[1], one[1], atol=1e-4), f"the box turns with {found[1][1]}, not with {one[1][1]}"
        spinning = thing(BALL, 0.5, 2.0, (1, 2, 0.5), velocity=(1, 0, -4), spin=(0, -6, 0))
        bodies, state = world([FLOOR, spinning], 0.5, 0.125)
        given = (bodies, state, contacts((1, 0, [1, 2, 0], UP, 0.0)), np.zeros((2, 6)), 0.125, 1.0, 9, np.zeros((1, 3)))
        # Its lowest point slips at 1 + 3 m/s; the impulse of 12 N s allows a friction of 1.5 N s.
        v, w, _ = numbers(submission.respond, given, 3)
        assert np.allclose(v[1], [0.25, 0, 2], atol=1e-4), f"the ball leaves with {v[1]}, not with (0.25, 0, 2)"
        assert np.allclose(w[1], [0, -2.25, 0], atol=1e-4), f"the ball turns with {w[1]}, not with (0, −2.25, 0)"
    with part(2, "a tower: weight is passed down sweep by sweep, from nothing and from the last step"):
        things = [FLOOR, thing(BALL, 0.5, 1.0, (0, 0, 0.5)), thing(BALL, 1.0, 5.0, (0, 0, 2))]
        bodies, state = world(things)
        touching = contacts((1, 0, [0, 0, 0], UP, 0.0), (2, 1, [0, 0, 1], UP, 0.0))
        for sweeps, start in ((0, 0.0), (1, 0.0), (4, 0.0), (40, 0.0), (1, 5.0), (2, 5.0)):
            j = [start, start]
            for _ in range(sweeps):
                # The lower ball ends its fall, 1.25 m/s, with what the upper contact takes from it; then the upper one.
                j[0] = max(0.0, j[0] - ((j[0] - j[1]) / 1 - 1.25))
                j[1] = max(0.0, j[1] - ((j[1] - j[0]) / 1 + j[1] / 5) / (1 + 1 / 5))
            v = np.array([[0, 0, 0], [0, 0, j[0] - j[1] - 1.25], [0, 0, j[1] / 5 - 1.25]])
            begin = np.array([[start, 0, 0], [start, 0, 0]])
            given = (bodies, state, touching, load(bodies), 0.125, 2.5, sweeps, begin)
            wanted = v, np.zeros((3, 3)), np.array([[j[0], 0, 0], [j[1], 0, 0]])
            expect(submission.respond, given, wanted)
    with part(1, "friction: a ball that is pushed along holds, rolls or slips; arrays left as they were"):
        for push in (1.5, 6.0, 40.0):
            ball = thing(BALL, 0.5, 2.0, (1, 2, 0.5))
            bodies, state = world([FLOOR, ball], friction=0.25)
            touching = contacts((1, 0, [1, 2, 0], UP, 0.0))
            given = (bodies, state, touching, load(bodies, (push, 0, 0)), 0.125, 2.5, 30, np.zeros((1, 3)))
            rub = min(push * 0.125 / 3.5, 0.25 * 2.5)  # 2/7 of the push makes it roll, or μ times the weight
            v = np.array([[0, 0, 0], [(push * 0.125 - rub) / 2, 0, 0]])
            w = np.array([[0, 0, 0], [0, rub * 0.5 / (0.4 * 2 * 0.25), 0]])
            j = np.array([[2.5, *(frame(np.array(UP)) @ np.array([-rub, 0, 0]))[1:]]])
            expect(submission.respond, given, (v, w, j))
            refuse_changes(submission.respond)


def flown(bodies, state, acceleration, dt, rules, memory=None, force=0.0, torque=0.0):
    """Bodies that meet nothing."""
    share, moments, *_ = bodies
    x, q, v, w = state
    v = v + dt * (np.where(share[:, None] > 0, acceleration, 0.0) + share[:, None] * force)
    turns = [matrix_of(o) @ np.diag(1 / m) @ matrix_of(o).T for o, m in zip(q, moments, strict=True)]
    w = w + dt * np.array([t @ m for t, m in zip(turns, np.broadcast_to(torque, w.shape), strict=True)])
    after = [free_turn(*each, dt) for each in zip(q, w, moments, strict=True)]
    q, w = (np.array(each) for each in zip(*after, strict=True))
    return x + dt * v, q, v, w, np.zeros(0), np.zeros((0, 3))


@asks("step_world", 10, "Find contacts, let them respond to the loads, move with the new velocities, and turn.")
def test_a_step_of_the_world(submission, part, examples):
    rules = (0.5, 0.01, 12)

    def flights(draw, size=1.0):
        things = [
            thing(BOX, size * (np.abs(draw.vector(1)) + 0.2), draw.number(1, 4), size * (9 * draw.vector(1) + side),
                  orientation(draw), size * draw.vector(3), draw.vector(2))
            for side in ((40, 0, 0), (-40, 0, 0))
        ]  # fmt: skip
        things.append(thing(PLANE, UP, position=(0, 0, -90 * size)))
        return *world(things), size * draw.vector(9), 0.125, (0.5, 0.01 * size, 12)

    with part(2, "any flight, and with forces and torques"):
        examples.agree(submission.step_world, flown, flights, count=6)
        pushes = np.array([[4.0, 2, 1], [-3, 6, 9], [1, 2, 3]]), np.array([[0.5, 0.25, -1], [1, 2, 3], [1, 1, 1]])
        none = np.zeros(0, int), np.zeros((0, 3))
        examples.agree(
            submission.step_world, flown, lambda draw: (*flights(draw), none, *pushes), count=3
        )  # fmt: skip
        for size in (1e-6, 1e6):
            maker = lambda draw, size=size: (*flights(draw, size), none, size * pushes[0], size**2 * pushes[1])  # noqa: E731
            examples.agree(submission.step_world, flown, maker, count=2)
            ball = thing(BALL, 0.5, 2.0, (1, 2, 3), velocity=np.array([1, -2, 3]) / size)
            given = (*world([ball]), np.array([2, 1, -3]) / size**2, 0.125 * size, rules)
            expect(submission.step_world, given, flown(*given))
            tower = world([FLOOR, thing(BALL, 0.5, size, (0, 0, 0.5))])
            carried = np.array([2 * 65536]), np.array([[1.25 * size, 0, 0]])
            given = (*tower, np.array([0, 0, -10.0]), 0.125, (0.5, 0.01, 0), carried)
            expect(submission.step_world, given, (*tower[1], carried[0].astype(float), carried[1]))
    with part(
        1, "as fast as a resting contact, or as near as the margin, or a little less; slow and fast, small and large"
    ):
        for size in (4e-5, 1e6):
            for share, rests in ((0.75, True), (1.25, False)):
                things = [
                    FLOOR,
                    thing(BALL, 0.5 * size, 2.0, np.array([1, 2, 0.5]) * size, velocity=(0, 0, -share * size)),
                ]
                given = (*world(things), np.zeros(3), 0.125, (size, size, 9))
                v = numbers(submission.step_world, given, 6)[2][1, 2]
                assert abs(v - (0.0 if rests else 0.5 * share * size)) < 1e-3 * size, (
                    f"the ball has {v:g} m/s afterwards"
                )
                things = [
                    FLOOR,
                    thing(BALL, 0.5 * size, 2.0, np.array([1, 2, 0.5 + share]) * size, velocity=(0, 0, -16 * size)),
                ]
                given = (*world(things), np.zeros(3), 0.125, (99 * size, size, 9))
                v = numbers(submission.step_world, given, 6)[2][1, 2]
                assert abs(v + (8 * share if rests else 16) * size) < 1e-3 * size, f"the ball has {v:g} m/s afterwards"
    with part(2, "a ball that falls, strikes, rises and comes to rest, step by step; in millimetres, in hectometres"):
        for size in (1.0, 1e-3, 100.0):
            speed, dt = math.sqrt(size), 0.125 * math.sqrt(size)  # as long in units of √(h/g)
            limits = (2.5 * speed, 0.3125 * size, 10)
            bodies, state = world([FLOOR, thing(BALL, 0.5 * size, 2.0, np.array([1, 2, 2.5]) * size)])
            memory, gap, rate = None, 2.0, 0.0
            for _ in range(16):
                gap, rate = bounced(gap, rate)
                given = (bodies, tuple(state), 10 * np.array([0, 0, -1.0]), dt, limits, memory)
                *state, key, impulse = numbers(submission.step_world, given, 6)
                memory = remembered(key, impulse)
                assert np.allclose(state[0][1], size * np.array([1, 2, gap + 0.5]), atol=1e-5 * size + SLOP), (
                    "it is elsewhere"
                )
                assert np.allclose(state[2][1], [0, 0, speed * rate], atol=1e-4 * speed + SLOP / dt), (
                    "it has another velocity"
                )
    with part(2, "a box that stands, from the second step on with what the first has found; one that slides"):
        for push, friction in ((0.0, 0.0), (0.0, 0.5), (3.0, 0.5)):
            bodies, state = world(
                [FLOOR, thing(BOX, (1, 0.5, 2), 3.0, (1, 2, 2), velocity=(push, 0, 0))], 0.5, friction
            )
            memory, speed, place = None, push, 1.0
            for _ in range(3):
                given = (bodies, tuple(state), np.array([0, 0, -10.0]), 0.015625, (0.5, 0.01, 60), memory)
                *state, key, impulse = numbers(submission.step_world, given, 6)
                memory, speed = remembered(key, impulse), max(speed - friction * 10 * 0.015625, 0.0)
                place += 0.015625 * speed
                assert np.allclose(state[0][1], [place, 2, 2], atol=1e-3), "the box is elsewhere"
                assert np.allclose(np.sum(impulse, axis=0)[0], 30 * 0.015625, rtol=1e-3), "its weight is not carried"
    with part(1, "a tower, without a sweep: it is carried by what carried it in the last step"):
        tower = world([FLOOR, thing(BALL, 0.5, 1.0, (0, 0, 0.5)), thing(BALL, 1.0, 5.0, (0, 0, 2))])
        key, carried = 65536 * np.array([3, 5]), np.array([[7.5, 0, 0], [6.25, 0, 0]])
        given = (*tower, np.array([0, 0, -10.0]), 0.125, (0.5, 0.01, 0), (key[::-1], carried[::-1]))
        expect(submission.step_world, given, (*tower[1], key.astype(float), carried))
    with part(1, "nothing that moves; one body alone, its arrays left as they were"):
        for things in ([FLOOR], [FLOOR, thing(BOX, (1, 1, 1), position=(0, 0, 5), velocity=(1, 2, 3), spin=(1, 0, 2))]):
            given = (*world(things), np.array([0, 0, -10.0]), 0.125, rules)
            expect(submission.step_world, given, flown(*given))
            refuse_changes(submission.step_world)
    with part(1, "an overlap is moved away by a fifth, and nobody gains a speed by it"):
        bodies, state = world([FLOOR, thing(BALL, 0.5, 2.0, (1, 2, 0.4))])
        x, _, v, *_ = numbers(submission.step_world, (bodies, state, np.zeros(3), 0.125, rules), 6)
        assert abs(x[1, 2] - 0.42) < 1e-5, "the ball is not moved up by a fifth of its overlap"
        assert np.allclose(v, 0.0, atol=1e-9), "the ball has got a velocity"


def remembered(key, impulse):
    """What a step hands to the next one, from an answer in floats; a list may be empty."""
    with np.errstate(invalid="ignore"):  # a wrong key may be any number
        return key.astype(int), impulse.reshape(-1, 3)


SLOP = 2e-6
"""What the given function leaves of an overlap, m, and as much again."""


def bounced(gap, rate):
    """Gap and rate of a ball above the floor after a step, in units in which its steps take an eighth, e = 1/2."""
    dt, fall, near = 0.125, -1.25, 0.3125
    after = rate + fall
    if gap > near:
        return gap + dt * after, after
    after = max(after, -0.5 * rate if -rate > 2.5 else -max(gap, 0.0) / dt)
    ahead = gap + dt * after
    return ahead + 0.2 * max(-ahead, 0.0), after
