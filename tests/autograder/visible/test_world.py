"""Impacts in a row and resting contact (slide 22): examples that a student sees."""

from __future__ import annotations

import math

import numpy as np

from labs.grading.judging.comparison import expect, numbers, plainly, refuse_changes
from labs.grading.judging.markers import asks
from labs.plain_worlds import BALL, BOX, EMPTY, FLOOR, PLANE, contacts, load, thing, world

UP, REST, UNTURNED, LEANS = [0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.8, 0.0, 0.6, 0.0]
INFINITY = math.inf
WAY = np.array([2.0, -1.0, 2.0]) / 3
"""A unit vector along no axis. (1, 2, 0) and (−4, 2, 5) are at right angles to it and to each other."""


@asks(
    "rotate_by_momentum", 5, "The body turns by ω dt. The angular momentum of the start then has another ω.",
    "Slide 18. Without a torque something stays as it is while the body turns. Is it ω? And what of it changes"
    " because the body lies differently afterwards?",
)  # fmt: skip
def test_what_turns_freely_keeps_its_angular_momentum(submission, part):
    with part(1, "about one of its own axes"):
        half = math.sqrt(0.5)
        for axis in range(3):
            spin, turned = 2 * np.eye(3)[axis], np.array([half, *(half * np.eye(3)[axis])])
            expect(submission.rotate_by_momentum, (UNTURNED, spin, [1, 2, 3], math.pi / 4), (turned, spin))
    with part(1, "about no axis of its own, and turned at the start; back in time"):
        for q, w, moments, dt, wanted in (
            (UNTURNED, [1, 1, 0], [1, 2, 3], math.pi / math.sqrt(8),
             ([0.707106781, 0.5, 0.5, 0], [0.958333333, 1.291666667, -0.530330086])),
            ([0.5, 0.5, 0.5, 0.5], [1, -2, 0.5], [1, 2, 3], 0.25,
             ([0.510456498, 0.387158486, 0.325509481, 0.695403515], [1.268610898, -2.113290882, 0.024571526])),
            (LEANS, [0.5, 2, -1], [3, 1, 2], 0.25,
             ([0.619453578, 0.123298011, 0.772835212, -0.061649006], [1.032911062, 1.953024143, -0.991692035])),
            (LEANS, [0.5, 2, -1], [3, 1, 2], -0.5,
             ([0.956160665, -0.236550685, 0.125743787, 0.118275342], [-0.109827721, 2.06591657, -1.963456936])),
        ):  # fmt: skip
            expect(submission.rotate_by_momentum, (q, w, moments, dt), wanted)
    with part(1, "a pin; a fast grain; a slow boulder"):
        for q, w, moments, dt, wanted in (
            ([0.1, 0.5, 0.5, 0.7], [2, 1, -4], [0.02, 0.5, 1], 0.125,
             ([0.176070106, 0.658414111, 0.276190276, 0.677649693], [0.477945449, 7.982582729, 3.157063877])),
            (LEANS, [30, 10, -20], [2e-5, 1e-5, 4e-5], 0.002,
             ([0.793441465, 0.035991601, 0.607578182, 0.001999533], [30.043366247, 12.561886657, -19.170201895])),
            (LEANS, [3e-4, 1e-4, -2e-4], [2e6, 1e6, 4e6], 600.0,
             ([0.777003066, 0.107773343, 0.620173599, 0.005987408], [3.07919e-4, 1.75611e-4, -1.67866e-4])),
        ):  # fmt: skip
            expect(submission.rotate_by_momentum, (q, w, moments, dt), wanted)
    with part(1, "a ball, a body at rest, a body that something else turns"):
        spin = [0.5, 2.0, -1.0]
        turned = [0.619453578, 0.123298011, 0.772835212, -0.061649006]
        expect(submission.rotate_by_momentum, (LEANS, spin, [2, 2, 2], 0.25), (turned, spin))
        expect(submission.rotate_by_momentum, (LEANS, spin, [INFINITY] * 3, 0.25), (turned, spin))
        expect(submission.rotate_by_momentum, (LEANS, REST, [1, 2, 3], 0.25), (LEANS, REST))
    with part(1, "two bodies in one call"):
        given = [LEANS, LEANS], [[0.5, 2, -1], [0.5, 2, -1]], [[3, 1, 2], [INFINITY] * 3], 0.25
        turned = [0.619453578, 0.123298011, 0.772835212, -0.061649006]
        expect(submission.rotate_by_momentum, given, ([turned] * 2, [[1.032911062, 1.953024143, -0.991692035], spin]))


@asks(
    "candidate_pairs", 4, "Two boxes overlap if they do so along each of the three axes.",
    "Two intervals on a line: when do they NOT overlap? Which two comparisons are left if you turn that round? And how"
    " many axes have to agree?",
)  # fmt: skip
def test_boxes_overlap_that_do_so_along_every_axis(submission, part):
    def pairs(low, high, *wanted):
        expect(submission.candidate_pairs, (low, high), np.array(wanted, dtype=float).reshape(-1, 2))

    with part(1, "two that overlap, and two that are apart along one axis alone, in either order"):
        low, high = [[0, 0, 0], [1, -1, 1]], [[2, 2, 2], [4, 1, 5]]
        pairs(low, high, (0, 1))
        pairs(low[::-1], high[::-1], (0, 1))
        for axis in range(3):
            away = 3 * np.eye(3)[axis]
            for side in (away, -away):
                pairs([[0, 0, 0], side - 0.5], [[2, 2, 2], side + 0.5])
    with part(1, "many, in ascending order"):
        low = np.array([[4.0, 4, 4], [0, 0, 0], [1, 1, 1], [0.5, -1, 0.5], [-9, -9, -9]])
        high = np.array([[6.0, 6, 6], [2, 2, 2], [4.5, 4.5, 4.5], [1.5, 0.5, 4.5], [-8, 9, 9]])
        pairs(low, high, (0, 2), (1, 2), (1, 3))
        pairs(1e-6 * low, 1e-6 * high, (0, 2), (1, 2), (1, 3))
        pairs(1e6 * low + 7, 1e6 * high + 7, (0, 2), (1, 2), (1, 3))
        pairs(low[::-1], high[::-1], (1, 3), (2, 3), (2, 4))
        pairs(
            [[0, 0, 0], [7, 7, 7], [7, 8, 7], [1, 1, 1]], [[2, 2, 2], [9, 9, 9], [8, 9, 9], [3, 3, 3]], (0, 3), (1, 2)
        )
    with part(1, "one inside another, one that crosses, and two that are the same"):
        pairs([[0, 0, 0], [1, 1, 1]], [[4, 4, 4], [2, 2, 2]], (0, 1))
        pairs([[1, 1, 1], [0, 0, 0]], [[2, 2, 2], [4, 4, 4]], (0, 1))
        pairs([[0, 1, 1], [1, 0, 0]], [[4, 2, 2], [2, 3, 3]], (0, 1))
        pairs([[0, 0, 0], [0, 0, 0]], [[2, 2, 2], [2, 2, 2]], (0, 1))
    with part(1, "they touch; one has no end; one stands alone"):
        pairs([[0, 0, 0], [2, 1, 1]], [[2, 2, 2], [3, 3, 3]], (0, 1))
        pairs([[0, 2, 0], [2, 0, 1]], [[2, 4, 2], [3, 2, 3]], (0, 1))
        pairs([[0, 0, 1], [-INFINITY] * 3], [[1, 1, 2], [INFINITY] * 3], (0, 1))
        pairs([[0, 0, 0]], [[1, 1, 1]])


def touching(place, normal, gap, a, b, count, features=(0,)):
    """What is expected where two bodies touch; of several places, one in each row."""
    places = np.reshape(place, (-1, 3))
    many = len(places)
    gaps = np.broadcast_to(np.asarray(gap, dtype=float), many)
    key = (a * count + b) * 65536.0 + np.array(features)
    return np.full(many, float(a)), np.full(many, float(b)), places, np.tile(normal, (many, 1)), gaps, key


NOTHING = np.zeros(0), np.zeros(0), np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0), np.zeros(0)


@asks(
    "collect_contacts", 6, "A box around each body, the pairs whose boxes overlap, and their places of contact.",
    "How far does a body reach along x, y and z if it is turned? Which pairs of bodies are not worth a look at their"
    " surfaces? And where does the margin come in?",
)  # fmt: skip
def test_contacts_are_those_of_the_pairs_whose_boxes_overlap(submission, part):
    ball = thing(BALL, 0.5, 2.0, (3, 1, 0.45))
    with part(1, "a ball and the floor, a slope, another ball"):
        on_floor = touching([3, 1, -0.025], UP, -0.05, 1, 0, 2)
        expect(submission.collect_contacts, (*world([FLOOR, ball]), 0.01), on_floor)
        slope = thing(PLANE, WAY, position=(1, 2, 3))
        above = thing(BALL, 0.5, 2.0, np.array([1, 2, 3]) + 0.4 * WAY)
        wanted = touching(np.array([1, 2, 3]) - 0.05 * WAY, WAY, -0.1, 0, 1, 2)
        expect(submission.collect_contacts, (*world([above, slope]), 0.01), wanted)
        other = thing(BALL, 1.0, 1.0, np.array([3, 1, 0.45]) + 1.45 * WAY)
        wanted = touching(np.array([3, 1, 0.45]) + 0.475 * WAY, -WAY, -0.05, 0, 1, 2)
        expect(submission.collect_contacts, (*world([ball, other]), 0.01), wanted)
    with part(1, "a box on the floor, and one that leans"):
        box = thing(BOX, (0.5, 0.25, 0.75), 3.0, (1, -1, 0.7))
        corners = [[x, y, -0.025] for x in (0.5, 1.5) for y in (-1.25, -0.75)]
        expect(
            submission.collect_contacts,
            (*world([FLOOR, box]), 0.01),
            touching(corners, UP, -0.05, 1, 0, 2, [0, 2, 4, 6]),
        )
        # (0.8, 0, 0.6, 0) turns (x, y, z) to (0.28 x + 0.96 z, y, −0.96 x + 0.28 z).
        leaning = thing(BOX, (0.5, 1, 2), 3.0, (1, -1, 1.03), LEANS)
        corners = [[1 + 0.14 - 1.92, y, -0.005] for y in (-2, 0)]
        expect(
            submission.collect_contacts, (*world([FLOOR, leaning]), 0.02), touching(corners, UP, -0.01, 1, 0, 2, [4, 6])
        )
    with part(1, "a long box that is turned reaches far along each axis, and a plate with two terms"):
        for q, place, normal in (
            (LEANS, [2.5 * 0.28, 0.3, -2.5 * 0.96], [0, 1, 0]), ([0.8, 0, 0, 0.6], [2.5 * 0.28, 2.5 * 0.96, 0.3], UP),
            ([0.5, 0.5, 0.5, 0.5], [0, 2.5, 0.3], UP), ([0.5, -0.5, -0.5, -0.5], [0.3, 0, 2.5], [1, 0, 0]),
            ([0.8, 0.6, 0, 0], [0.3, 2.5 * 0.28, 2.5 * 0.96], [1, 0, 0]),
        ):  # fmt: skip
            half = np.full(3, 0.1)
            half[1 if q[1] == 0.6 else 0] = 3.0
            spot = np.array([-4, -5, -6])
            rod, near = thing(BOX, half, 1.0, spot, q), thing(BALL, 0.25, 1.0, spot + place)
            at = spot + np.array(place) - 0.225 * np.array(normal)
            expect(submission.collect_contacts, (*world([rod, near]), 0.01), touching(at, normal, -0.05, 1, 0, 2))
        # The corner (1, −1, 0) of the plate lies at (1.24, 0.68, 0), and the ball is 0.2 m from it.
        plate, out = thing(BOX, (1, 1, 0.5), 1.0, REST, [0.8, 0, 0, 0.6]), np.array([0.936, 0.352, 0])
        near = thing(BALL, 0.25, 1.0, np.array([1.24, 0.68, 0]) + 0.2 * out)
        at = np.array([1.24, 0.68, 0]) - 0.025 * out
        expect(submission.collect_contacts, (*world([plate, near]), 0.01), touching(at, out, -0.05, 1, 0, 2))
    with part(1, "within the margin, and beyond it; in micrometres and in kilometres"):
        for size in (1.0, 1e-6, 1e3):
            for gap, margin, seen in ((0.1, 0.12, True), (0.1, 0.08, False), (0.0, 0.0, True), (2.0, 2.5, True)):
                pair = [thing(BALL, size, 2e4, REST), thing(BALL, 0.5 * size, 1e4, (1.5 + gap) * size * WAY)]
                wanted = touching((1 + gap / 2) * size * WAY, -WAY, gap * size, 0, 1, 2) if seen else NOTHING
                if gap:  # without one, rounding would decide
                    expect(submission.collect_contacts, (*world(pair), margin * size), wanted)
        for axis in np.vstack([np.eye(3), -np.eye(3)]):
            for gap, margin in ((0.125, 0.15625), (0.0, 0.0)):
                pair = [thing(BALL, 1.0, 1.0, [-3, -3, -3]), thing(BALL, 0.5, 1.0, (1.5 + gap) * axis - 3)]
                wanted = touching((1 + gap / 2) * axis - 3, -axis, gap, 0, 1, 2)
                expect(submission.collect_contacts, (*world(pair), margin), wanted)
    with part(1, "two immovable bodies; two that do not meet; bodies far apart; far along a floor, and up a wall"):
        wall, high = thing(PLANE, (1, 0, 0)), thing(BALL, 0.5, 2.0, (0.45, 30, 4000))
        wanted = touching([-0.025, 30, 4000], [1, 0, 0], -0.05, 1, 0, 2)
        expect(submission.collect_contacts, (*world([wall, high]), 0.01), wanted)
        block = thing(BOX, (1, 1, 1), position=(3, 1, -0.5))
        far = thing(BALL, 0.5, 1.0, (0, 9, 5))
        expect(submission.collect_contacts, (*world([FLOOR, block, far]), 0.01), NOTHING)
        meet = np.array([[True, False], [False, True]])
        expect(submission.collect_contacts, (*world([FLOOR, ball], meet=meet), 0.01), NOTHING)
        expect(submission.collect_contacts, (*world([ball, far]), 0.01), NOTHING)
    with part(1, "three bodies, pair after pair"):
        lifted = thing(BALL, 0.5, 2.0, (3, 1, 1.4))
        first, second = touching([3, 1, -0.025], UP, -0.05, 0, 2, 3), touching([3, 1, 0.925], UP, -0.05, 0, 1, 3)
        second = (*second[:3], -second[3], *second[4:])
        apart = thing(BALL, 0.5, 1.0, (0, 9, 5))
        last = touching([3, 1, -0.025], UP, -0.05, 2, 0, 3)
        expect(submission.collect_contacts, (*world([FLOOR, apart, ball]), 0.01), last)
        both = tuple(np.concatenate(each) for each in zip(second, first, strict=True))
        expect(submission.collect_contacts, (*world([ball, lifted, FLOOR]), 0.01), both)


@asks(
    "propagate_impacts",
    3,
    "Two at a time, from the left and again, until no ball is faster than the next.",
    "Slide 22. Go through a row of three by hand: which two meet first, and which two then?",
)
def test_the_impact_runs_through_the_row(submission, part):
    with part(1, "Newton's cradle"):
        expect(submission.propagate_impacts, ([1, 0, 0, 0, 0], 1.0, 1.0), [0.0, 0.0, 0.0, 0.0, 1.0])
        expect(submission.propagate_impacts, ([1, 1, 0, 0, 0], 1.0, 1.0), [0.0, 0.0, 0.0, 1.0, 1.0])
    with part(1, "unequal balls that lose, also slowly; the last two meet first; a light ball; a wall"):
        expect(submission.propagate_impacts, ([1, -1], [1, 3], 0.5), [-1.25, -0.25])
        expect(submission.propagate_impacts, ([6, 0], [2, 1], 0.5), [3.0, 6.0])
        expect(submission.propagate_impacts, ([0, -1, -2], [1, 3, 1], 1.0), [-1.5, -1.25, 0.25])
        expect(submission.propagate_impacts, ([1, 0, 0], [1, 1, INFINITY], 1.0), [-1.0, 0.0, 0.0])
        expect(submission.propagate_impacts, ([2, -1], [1, INFINITY], 0.5), [-2.5, -1.0])  # a wall that comes nearer
        expect(submission.propagate_impacts, ([2e-4, 0, 0], 1.0, [0.5, 1.0]), [1.25e-5, 3.75e-5, 1.5e-4])
        expect(submission.propagate_impacts, ([-1, 0, 0, -2], 1.0, 0.5), [-1.09375, -1.03125, -0.46875, -0.40625])
        light = [-1.076353385, -0.650233692, 3.044389438, 3.285414433]
        expect(submission.propagate_impacts, ([4, 0, 0, -1], [12, 1, 16, 3], 1.0), light)
        expect(submission.propagate_impacts, ([0, 0, -1], 1.0, 1.0, 1), [0.0, -1.0, 0.0])
        expect(submission.propagate_impacts, ([0, 0, -1], 1.0, 1.0, 2), [-1.0, 0.0, 0.0])
        expect(submission.propagate_impacts, ([1, 0, 0], 1.0, 1.0, 1), [0.0, 0.0, 1.0])  # one round of two impacts
        found = numbers(submission.propagate_impacts, (np.array([2, 0, 0]), 1.0, np.array([0.5, 1.0])))
        assert np.allclose(found, [0.125, 0.375, 1.5]), f"whole numbers in, and {found} in place of (0.125, 0.375, 1.5)"
    with part(1, "two rows in one call"):
        expect(submission.propagate_impacts, ([[1, 0, 0], [0, 0, 2]], 1.0, 1.0), [[0, 0, 1], [0, 0, 2]])
        refuse_changes(submission.propagate_impacts)


@asks(
    "resting_problem", 2, "A = G M⁻¹ Gᵀ and b = G M⁻¹ F.", "Slide 22. What does a unit force at a contact accelerate?"
)
def test_the_problem_of_resting_contacts(submission, part):
    with part(1, "one body on one contact"):
        expect(submission.resting_problem, ([[0, 0, 1]], np.eye(3) / 2, [0, 0, -20]), ([[0.5]], [-10.0]))
        turning = ([[0, 0, 1, 2, -1, 0]], np.diag([0.5, 0.5, 0.5, 1, 2, 4]), [0, 0, -20, 3, 1, 0])  # a torque, too
        expect(submission.resting_problem, turning, ([[6.5]], [-6.0]))
        g, w = [[1, 2, 0], [0, -1, -1]], [[2, 1, 0], [1, 3, 1], [0, 1, 4]]  # two contacts
        expect(submission.resting_problem, (g, w, [1, 2, 3]), ([[18, -9], [-9, 9]], [24.0, -24.0]))
    with part(1, "two loads in one call"):
        found = ([[0.5]], [[-10.0], [-5.0]])
        g, w = np.broadcast_to([[0.0, 0.0, 1.0]], (2, 1, 3)), np.eye(3) / 2
        expect(submission.resting_problem, (g, w, [[0, 0, -20], [0, 0, -10]]), ([[[0.5]], [[0.5]]], found[1]))


@asks(
    "solve_by_sweeps",
    2,
    "Contact after contact gets what it needs now, and no contact pulls.",
    "Slide 22. Does the second contact of a sweep know what the first one has just got?",
)
def test_sweeps_go_from_contact_to_contact(submission, part):
    with part(1, "one contact; two that share a load, after one sweep and after many"):
        expect(submission.solve_by_sweeps, ([[2]], [-4], 1), [2.0])
        expect(submission.solve_by_sweeps, ([[2, 1], [1, 2]], [-4, -4], 1), [2.0, 1.0])
        expect(submission.solve_by_sweeps, ([[2, 1], [1, 2]], [-4, -4], 2), [1.5, 1.25])
        expect(submission.solve_by_sweeps, ([[2, 1], [1, 2]], [-6, -6], 60), [2.0, 2.0])
        expect(submission.solve_by_sweeps, ([[2, 1], [1, 2]], [4, -4], 1), [0.0, 2.0])
        three = [[2, -1, 0], [-1, 4, 1], [0, 1, 2]]
        expect(submission.solve_by_sweeps, (three, [-2, -8, -6], 1, [1, 4, 3]), [3.0, 2.0, 2.0])
        expect(submission.solve_by_sweeps, ([[0]], [-4], 1), [0.0])  # nothing that it could move
        expect(submission.solve_by_sweeps, ([[0]], [-4], 1, [3]), [0.0])
        expect(submission.solve_by_sweeps, (np.zeros((0, 0)), [], 1), np.zeros(0))  # nothing touches
        refuse_changes(submission.solve_by_sweeps)
        whole = np.array([[2.0, 1], [1, 2]]), np.array([-3.0, -3]), 1, np.array([0, 0])
        found = numbers(submission.solve_by_sweeps, whole)
        assert np.allclose(found, [1.5, 0.75]), f"from the whole numbers 0 and 0 to {found}, and not to (1.5, 0.75)"
    with part(1, "two loads in one call"):
        expect(submission.solve_by_sweeps, ([[2]], [[-4], [4]], 1), [[2.0], [0.0]])


def on_floor(body, places, gap=0.0, start=0.0, sweeps=8, others=REST, turning=REST, rest_speed=2.5, **more):
    """Arguments of `respond` for a body that touches the floor, which is body 0, at some places."""
    bodies, state = world([FLOOR, body], **more)
    gaps = np.broadcast_to(np.asarray(gap, dtype=float), len(places))
    several = contacts(*((1, 0, place, UP, each) for place, each in zip(places, gaps, strict=True)))
    begin = np.array(np.broadcast_to(start, (len(places), 3)), dtype=float)
    return bodies, state, several, load(bodies, others, turning), 0.125, rest_speed, sweeps, begin


def of_body(v, w=REST, impulses=((0, 0, 0),)):
    """The result for the floor, which stays, and the body."""
    return [REST, v], [REST, w], np.reshape(impulses, (-1, 3))


UNDER = [(1, 2, 0)]
FOOT = [(0, 1.5, 0), (2, 1.5, 0), (0, 2.5, 0), (2, 2.5, 0)]


def falling(velocity, spin=REST, size=1.0):
    return thing(BALL, 0.5 * size, 2.0, np.array([1, 2, 0.5]) * size, UNTURNED, velocity, spin)


def box(velocity=REST, spin=REST):
    """Half a metre wide along y, 4 m high, and 3 kg: its moments are 4.25, 5 and 1.25 kg m²."""
    return thing(BOX, (1, 0.5, 2), 3.0, (1, 2, 2), UNTURNED, velocity, spin)


def row(speeds, masses, e=1.0, sweeps=8):
    """Balls in a row along a slanted line, in touch, without weight."""
    balls = [
        thing(BALL, 0.5, m, i * WAY, UNTURNED, v * WAY) for i, (v, m) in enumerate(zip(speeds, masses, strict=True))
    ]
    bodies, state = world(balls, e)
    several = contacts(*((i + 1, i, (i + 0.5) * WAY, WAY, 0.0) for i in range(len(balls) - 1)))
    return bodies, state, several, np.zeros((len(balls), 6)), 0.125, 0.1, sweeps, np.zeros((len(balls) - 1, 3))


def along(speeds):
    """The result for a row of balls: nothing turns, and nothing rests."""
    return [v * WAY for v in speeds], np.zeros((len(speeds), 3)), np.zeros((len(speeds) - 1, 3))


@asks(
    "respond", 7, "The impacts first, pair after pair, until none collides; then what is in touch carries the loads.",
    "Slide 21. Which contacts collide, before any load has acted? Which impulses do they get, and do others collide"
    " afterwards? Then add the loads: how slowly may the points of each contact part at least?",
)  # fmt: skip
def test_first_what_collides_and_then_what_rests(submission, part):
    with part(1, "a ball that strikes the floor, rests, closes a gap, or leaves; weight 20 N for 1/8 s"):
        for more, wanted in (
            ({"body": falling([1, 0, -4])}, ([1, 0, 2], [2.5, 0, 0])),
            ({"body": falling([1, 0, -4]), "restitution": 0.0}, ([1, 0, 0], [2.5, 0, 0])),
            ({"body": falling(REST)}, (REST, [2.5, 0, 0])),
            ({"body": falling([1, 0, -2.25])}, ([1, 0, 0], [7, 0, 0])),
            ({"body": falling([1, 0, -2.75])}, ([1, 0, 1.375], [2.5, 0, 0])),
            ({"body": falling([1, 0, -0.5]), "rest_speed": 0.0}, ([1, 0, 0.25], [2.5, 0, 0])),
            ({"body": falling(REST), "gap": 0.0625}, ([0, 0, -0.5], [1.5, 0, 0])),
            ({"body": falling(REST), "gap": 0.25}, ([0, 0, -1.25], REST)),
            ({"body": falling(REST), "gap": -0.25}, (REST, [2.5, 0, 0])),
            ({"body": falling([0, 1, -4]), "gap": 0.25}, ([0, 1, 2], [2.5, 0, 0])),
            ({"body": falling([0, 1, -4]), "gap": 0.75}, ([0, 1, -5.25], REST)),  # it does not touch in this step
            ({"body": falling([0, 1, 3])}, ([0, 1, 1.75], REST)),
            ({"body": falling(REST), "others": (0, 0, 52)}, ([0, 0, 2], REST)),
            ({"body": falling(REST), "others": (16, -8, 0)}, ([1, -0.5, 0], [2.5, 0, 0])),
        ):
            expect(submission.respond, on_floor(places=UNDER, **more), of_body(wanted[0], REST, wanted[1]))
        expect(submission.respond, on_floor(falling([1, 2, -4]), []), of_body([1, 2, -5.25], REST, ()))
        pushed = on_floor(falling([1, 2, -4], [1, 2, 3]), [], turning=(0.4, 0.8, -1.6))
        expect(submission.respond, pushed, of_body([1, 2, -5.25], [1.25, 2.5, 2], ()))
    with part(
        1, "two balls in the air, and rows: from the left, unequal, from both ends, with loss, too slow to collide"
    ):
        expect(submission.respond, row([2, -1], [1, 3], 0.5), along([-1.375, 0.125]))
        expect(submission.respond, row([2, 0, 0], [1, 1, 1]), along([0, 0, 2]))
        expect(submission.respond, row([0, 0, -2], [1, 1, 1]), along([-2, 0, 0]))
        expect(submission.respond, row([1, 0, -1], [1, 3, 1]), along([-0.5, -0.25, 1.25]))
        expect(submission.respond, row([2, 0, 0], [3, 1, 2]), along([0, 2, 2]))
        expect(submission.respond, row([2, 0, 0], [1, 1, 1], 0.5), along([0.40625, 0.46875, 1.125]))
        pairs = [[0, 0.5, 0], [0.5, 0, 1], [0, 1, 0]]
        expect(submission.respond, row([2, 0, 0], [1, 1, 1], pairs), along([0.125, 0.375, 1.5]))
        four = along([-1.076353385, -0.650233692, 3.044389438, 3.285414433])  # after four rounds
        expect(submission.respond, row([4, 0, 0, -1], [12, 1, 16, 3]), four)
        between = along([-1.275570474, 0.597704855, 1.724661188])  # a light one between two heavy ones, after 12 rounds
        expect(submission.respond, row([2, 0, -1], [100, 1, 120]), between)
        slowly = [0.025 * WAY] * 2, np.zeros((2, 3)), [[0.025, 0, 0]]
        expect(submission.respond, row([0.05, 0], [1, 1]), slowly)
    with part(1, "a box lands on a corner, on an edge, on its foot"):
        v, w = [0.5, 0, -1.168874172], [-1.440397351, 2.448675497, 0]
        expect(submission.respond, on_floor(box([0.5, 0, -4]), FOOT[:1]), of_body(v, w, [2.110927152, 0, 0]))
        on_edge = of_body([0, 0, 0.9125], [-2.175, 0, 0], [[1.59375, 0, 0]] * 2)
        expect(submission.respond, on_floor(box([0, 0, -4]), FOOT[:2], sweeps=20), on_edge)
        v, w, j = numbers(submission.respond, plainly(*on_floor(box([0.5, 0, -4]), FOOT, sweeps=60)), 3)
        assert np.allclose(v[1], [0.5, 0, 2], atol=1e-4), f"it leaves with {v[1]}, not with (0.5, 0, 2)"
        assert np.allclose(w, 0, atol=1e-4), f"it turns with {w[1]}"
        assert np.allclose(np.sum(j, axis=0), [3.75, 0, 0], atol=1e-3), "the four places do not carry its weight"
    with part(1, "a box stands on three places, or on four with the impulses of the last step, and is pushed over"):
        tripod = [(0, 1.5, 0), (2, 1.5, 0), (1, 2.5, 0)]
        shares = [[0.9375, 0, 0], [0.9375, 0, 0], [1.875, 0, 0]]
        expect(submission.respond, on_floor(box(), tripod, sweeps=99), of_body(REST, REST, shares))
        tips = of_body([0, 0, -0.1875], [-0.375, 0, 0], [[1.59375, 0, 0], [1.59375, 0, 0], REST])
        expect(submission.respond, on_floor(box(), tripod, [0, 0, 0.5], sweeps=20), tips)
        quarters = [[0.9375, 0, 0]] * 4
        expect(submission.respond, on_floor(box(), FOOT, start=quarters, sweeps=0), of_body(REST, REST, quarters))
        expect(submission.respond, on_floor(box(), FOOT, start=quarters, sweeps=1), of_body(REST, REST, quarters))
        over = of_body([0, 0, -0.5625], [-1.125, 0, 0], [[1.03125, 0, 0]] * 2)
        pushed = on_floor(box(), FOOT[:2], turning=(-30, 0, 0), sweeps=20)
        expect(submission.respond, pushed, over)
        near = of_body([0, 0, -0.827814570], [-0.149006622, 0.253311258, 0], [[1.266556291, 0, 0], REST])
        expect(submission.respond, on_floor(box(), FOOT[:2], [0.0625, 0.5], sweeps=20), near)
        wide = thing(BOX, (2, 0.5, 0.5), 3.0, (1, 2, 0.5), UNTURNED, (0, 0, -2.25), (0, -0.875, 0))
        ends = [[3.041225490, 0, 0], [4.320312500, 0, 0]]  # the second end closes slowly, and rests
        given = on_floor(wide, [(-1, 2, 0), (3, 2, 0)], sweeps=30, restitution=0.0)
        expect(submission.respond, given, of_body(REST, REST, ends))
        leans = thing(BOX, (1, 0.5, 2), 3.0, (1, 2, 2), LEANS, (0.5, 1, -4), (1, -1, 2))
        bodies, state = world([thing(PLANE, WAY), leans])
        given = bodies, state, contacts((1, 0, (0.5, 1.5, 0.25), WAY, 0.0)), load(bodies, (3, 2, 1), (-9, 6, 12))
        leaves = [1.225536078, 0.783065294, -4.607797255], [-1.289495597, -1.300402059, 2.250313073]
        expect(submission.respond, (*given, 0.125, 1.0, 6, [REST]), of_body(*leaves, [0.173488962, 0, 0]))
        turned = state[0], [UNTURNED, [0.1, 0.5, 0.5, 0.7]], *state[2:]
        leaves = [1.012359045, 0.889653811, -4.820974288], [-0.831125723, -2.024955970, 2.522599088]
        given = bodies, turned, *given[2:]
        expect(submission.respond, (*given, 0.125, 1.0, 6, [REST]), of_body(*leaves, [0.107042969, 0, 0]))
    with part(1, "a tower: sweep after sweep, from nothing and from the impulses of the last step"):
        things = [FLOOR, thing(BALL, 0.5, 1.0, (0, 0, 0.5)), thing(BALL, 1.0, 5.0, (0, 0, 2))]
        bodies, state = world(things)
        tower = bodies, state, contacts((1, 0, REST, UP, 0.0), (2, 1, UP, UP, 0.0)), load(bodies), 0.125, 2.5
        for sweeps, start, speeds, impulses in (
            (1, (0, 0), (-1.041666667, -1.041666667), (1.25, 1.041666667)),
            (2, (0, 0), (-0.868055556, -0.868055556), (2.291666667, 1.909722222)),
            (1, (5, 5), (-0.208333333, -0.208333333), (6.25, 5.208333333)),
            (1, (7.5, 6.25), (0, 0), (7.5, 6.25)),
        ):
            begin = [[each, 0, 0] for each in start]
            moved = [REST, [0, 0, speeds[0]], [0, 0, speeds[1]]]
            wanted = moved, np.zeros((3, 3)), [[each, 0, 0] for each in impulses]
            expect(submission.respond, (*tower, sweeps, begin), wanted)
    with part(2, "a rough floor: a ball that strikes and spins, others that roll or slip, each in its own way; a box"):
        # The directions of `contact_frames` are here up, y and −x.
        spins = of_body([0.285714286, 0, 2], [0, 0.571428571, 2], [2.5, 0, 0.428571429])
        expect(submission.respond, on_floor(falling([2, 0, -4], [0, -8, 2]), UNDER, friction=0.25), spins)
        rolls = of_body([0, 0.178571429, 0], [-0.357142857, 0, 0], [2.5, -0.142857143, 0])
        expect(submission.respond, on_floor(falling(REST), UNDER, others=(0, 4, 0), friction=0.25), rolls)
        slips = of_body([4.6875, 0, 0], [0, 1.5625, 0], [2.5, 0, 0.625])
        expect(submission.respond, on_floor(falling(REST), UNDER, others=(80, 0, 0), friction=0.25), slips)
        start = [[0.75, 0.125, -0.25], [1, -0.25, 0.125], [0.875, 0.25, 0.125], [1, 0, -0.375]]
        given = on_floor(box(), FOOT, others=(4, -6, 0), friction=0.75, start=start, sweeps=50)
        moves = [0.000995132, -0.002590210, -0.000052868], [0.000589309, 0.000498063, -0.000913569]
        carried = [
            [1.379151251, 0.255696452, 0.069962015], [1.977723623, 0.192271880, 0.410523714],
            [0, 0, 0], [0.392966522, 0.294261037, 0.016528876],
        ]  # fmt: skip
        expect(submission.respond, given, of_body(*moves, carried))
        refuse_changes(submission.respond)
        # Two balls strike and two are pushed, and with each the floor has a friction of its own.
        mu = np.full((5, 5), 0.5)
        mu[0, 1:] = mu[1:, 0] = [0.0, 0.09375, 0.25, 0.125]
        arriving = [[2, 0, -4], [2, 0, -4], REST, REST]
        balls = [thing(BALL, 0.5, 2.0, (3 * k, 2, 0.5), UNTURNED, v) for k, v in enumerate(arriving, 1)]
        bodies, state = world([FLOOR, *balls], 0.5, mu)
        several = contacts(*((k, 0, (3 * k, 2, 0), UP, 0.0) for k in range(1, 5)))
        loads = load(bodies, [REST, REST, REST, [80, 0, 0], [80, 0, 0]])
        leave = [REST, [2, 0, 2], [1.428571429, 0, 2], [4.6875, 0, 0], [4.84375, 0, 0]]
        spins = [REST, REST, [0, 2.857142857, 0], [0, 1.5625, 0], [0, 0.78125, 0]]
        carried = [[2.5, 0, 0], [2.5, 0, 0.017857143], [2.5, 0, 0.625], [2.5, 0, 0.3125]]
        given = (bodies, state, several, loads, 0.125, 2.5, 8, np.zeros((4, 3)))
        expect(submission.respond, given, (leave, spins, carried))
        small = falling([0, 0, -4e-3], REST, 1e-3)
        bodies, state = world([FLOOR, small])
        few = contacts((1, 0, [1e-3, 2e-3, 0], UP, 0.0))
        given = (bodies, state, few, load(bodies), 1e-4, 2e-3, 8, np.zeros((1, 3)))
        expect(submission.respond, given, of_body([0, 0, 2e-3], REST, [2e-3, 0, 0]))


@asks(
    "step_world", 6, "Contacts where the step begins; their response to the loads; then move and turn.",
    "Slide 3. Which forces act? What touches, and what does it do to the velocities? With which velocity does each body"
    " then move, and what does its spin become?",
)  # fmt: skip
def test_one_step_of_the_world(submission, part):
    def step(given, wanted, weight=(0, 0, -10), dt=0.125, sweeps=10, memory=EMPTY, more=(), near=(0.5, 0.01)):
        place, q, v, w, key, impulse = wanted
        outputs = place, q, v, w, np.asarray(key, dtype=float), np.reshape(impulse, (-1, 3))
        arguments = (*given, list(weight), dt, (*near, sweeps), memory, *more)
        expect(submission.step_world, arguments, outputs)

    ball = world([thing(BALL, 0.5, 2.0, (1, 2, 3))])
    with part(1, "a brick flies and tumbles, with weight, a force and a torque; an immovable one flies on"):
        brick = thing(BOX, (1, 1, 1), 2.0, (1, 2, 5), LEANS, (1, 0.5, -2), (0.5, 2, -1))
        held = thing(BOX, (1, 1, 1), position=(0, 0, -9), orientation=LEANS, velocity=(1, 2, 3), spin=(0.5, 2, -1))
        bodies, state = world([brick, held])
        bodies = (bodies[0], np.array([[3.0, 1, 2], [INFINITY] * 3]), *bodies[2:])
        q = [[0.619453578, 0.123298011, 0.772835212, -0.061649006]] * 2
        w = [[1.032911062, 1.953024143, -0.991692035], [0.5, 2, -1]]
        falls = [[1.25, 2.125, 3.875], [0.25, 0.5, -8.25]], q, [[1, 0.5, -4.5], [1, 2, 3]], w, [], []
        step((bodies, state), falls, dt=0.25)
        pushed = [[1.75, 1.875, 5.375], [0.25, 0.5, -8.25]], q, [[3, -0.5, 1.5], [1, 2, 3]], w, [], []
        step((bodies, state), pushed, (0, 0, 0), 0.25, more=([[16.0, -8, 28], [5, 5, 5]], [REST, [5, 5, 5]]))
        three = [thing(BALL, 0.5, mass, (3 * mass, 0, 0)) for mass in (1, 2, 4)]
        places, speeds = [[3.125, 0, 0], [6.0625, 0, 0], [12.03125, 0, 0]], [[1, 0, 0], [0.5, 0, 0], [0.25, 0, 0]]
        wanted = places, [UNTURNED] * 3, speeds, [REST] * 3, [], []
        step(world(three), wanted, (0, 0, 0), more=([[8, 0, 0]] * 3, REST))
        # The ball turns about every axis alike, 0.2 kg m²: its spin of 0.7 rad/s turns it by 0.0875 in 1/8 s.
        twisted = [math.cos(0.04375), *(math.sin(0.04375) / 7 * np.array([3, -6, 2]))]
        spins = [[1, 2, 3]], [twisted], [REST], [[0.3, -0.6, 0.2]], [], []
        step(ball, spins, (0, 0, 0), more=([REST], [[0.48, -0.96, 0.32]]))
    with part(2, "a ball strikes the floor, comes near, rests, and is in it"):
        for height, v, after, z, key, impulse in (
            (0.45, (1, 0, -4), (1, 0, 2), 0.7, [131072], [2.5, 0, 0]),
            (0.505, (1, 0, -4), (1, 0, 2), 0.755, [131072], [2.5, 0, 0]),
            (0.75, (1, 0, -4), (1, 0, -5.25), 0.09375, [], []),
            (0.5, REST, REST, 0.5, [131072], [2.5, 0, 0]),
            (0.505, REST, (0, 0, -0.04), 0.5, [131072], [2.42, 0, 0]),
            (0.4, REST, REST, 0.42, [131072], [2.5, 0, 0]),
            (0.5, (0, 0, -0.75), (0, 0, 0.375), 0.546875, [131072], [2.5, 0, 0]),
            (0.5, (0, 0, -0.375), REST, 0.5, [131072], [3.25, 0, 0]),
        ):
            bodies, state = world([FLOOR, thing(BALL, 0.5, 2.0, (1, 2, height), UNTURNED, v)])
            places = [REST, [1 + 0.125 * v[0], 2, z]]
            step((bodies, state), (places, [UNTURNED] * 2, [REST, after], np.zeros((2, 3)), key, impulse))
        things = [thing(BALL, 0.5, 2.0, (1, 2, 0.5)), thing(BALL, 1.0, 16384.0, (9, 9, 9)), FLOOR]
        places, speeds = [[1, 2, 0.5], [9, 9, 8.84375], REST], [REST, [0, 0, -1.25], REST]
        step(world(things), (places, [UNTURNED] * 3, speeds, [REST] * 3, [131072], [2.5, 0, 0]))
        slow = world([FLOOR, thing(BALL, 0.5, 2.0, (1, 2, 0.515), UNTURNED, (0, 0, -2))])
        settled = [REST, [1, 2, 0.5]], [UNTURNED] * 2, [REST, [0, 0, -0.12]], [REST] * 2, [131072], [6.26, 0, 0]
        step(slow, settled, near=(2.5, 0.02))
    with part(1, "a tower, in one sweep, and from what it carried in the last step"):
        tower = world([FLOOR, thing(BALL, 0.5, 1.0, (0, 0, 0.5)), thing(BALL, 1.0, 5.0, (0, 0, 2))])
        key = [3 * 65536, 5 * 65536]
        fallen = [REST, [0, 0, -1.041666667], [0, 0, -1.041666667]]
        sunk = [REST, [0, 0, 0.395153892], [0, 0, 1.895152892]], [UNTURNED] * 3, fallen, [REST] * 3
        step(tower, (*sunk, key, [[1.25, 0, 0], [1.041666667, 0, 0]]), sweeps=1)
        rest = [REST, [0, 0, 0.5], [0, 0, 2]], [UNTURNED] * 3, np.zeros((3, 3)), np.zeros((3, 3))
        carried = [[7.5, 0, 0], [6.25, 0, 0]]
        step(tower, (*rest, key, carried), sweeps=0, memory=(np.array(key), np.array(carried)))
        other = np.array([9, *key[::-1]]), np.array([[4.0, 0, 0], *carried[::-1]])
        step(tower, (*rest, key, carried), sweeps=0, memory=other)
    with part(1, "two balls strike in the air, and three; no pair is special; a box deep in the floor turns out of it"):
        a = thing(BALL, 0.5, 1.0, REST, velocity=2 * WAY)
        b = thing(BALL, 0.5, 3.0, 0.95 * WAY, velocity=-WAY)
        after = -1.375 * WAY, 0.125 * WAY
        places = [0.125 * after[0], 0.95 * WAY + 0.125 * after[1]]
        wanted = places, [UNTURNED] * 2, after, np.zeros((2, 3)), [65536], REST
        step(world([a, b]), wanted, (0, 0, 0))
        masses, speeds = (120.0, 1.0, 100.0), (2, 0, -1)  # a light one between two heavy ones takes twelve rounds
        balls = [
            thing(BALL, 0.5, m, k * WAY, velocity=v * WAY) for k, m, v in zip(range(3), masses, speeds, strict=True)
        ]
        after = np.outer([-0.732651762, 1.138495645, 2.267797158], WAY)
        places = np.outer([0, 1, 2], WAY) + 0.125 * after
        wanted = places, [UNTURNED] * 3, after, [REST] * 3, [65536, 5 * 65536], [REST] * 2
        step(world(balls, 1.0), wanted, (0, 0, 0), near=(0.1, 0.01))
        near = world([thing(BALL, 0.5, 1.0, REST), thing(BALL, 0.5, 1.0, (0, 0.9, 0))])
        apart = [[0, -0.01, 0], [0, 0.91, 0]], [UNTURNED] * 2, [REST] * 2, [REST] * 2, [65536], REST
        step(near, apart, (0, 0, 0))
        deep = thing(BOX, (2, 0.5, 0.25), 3.0, (1, 2, 0.3), [0.9, 0.1, 0.3, 0.3], (0.5, -0.25, -0.1), (0.3, -0.4, 0.2))
        places, q = [REST, [1.0625, 1.96875, 0.223280419]], [0.912573021, 0.107048839, 0.215117251, 0.330870966]
        w = [0.962117668, -0.219753319, -0.122870396]
        key, impulse = 131072.0 + np.array([4, 5, 6, 7]), [[0.752498541, 0, 0], REST, REST, REST]
        wanted = places, [UNTURNED, q], [REST, [0.5, -0.25, -1.099167153]], [REST, w], key, impulse
        step(world([FLOOR, deep]), wanted, sweeps=3, more=([REST] * 2, [REST, [3, 1, -2]]))
        refuse_changes(submission.step_world)
    with part(1, "weight along no axis; on a rough floor: a ball that is pushed, and on a slope a box that holds"):
        slanted = [[1.015625, 1.96875, 3.046875]], [UNTURNED], [[0.125, -0.25, 0.375]], [REST], [], []
        step(ball, slanted, (1, -2, 3))
        rolls = world([FLOOR, thing(BALL, 0.5, 2.0, (1, 2, 0.5))], 0.5, 0.25)
        turned = [math.cos(0.0223214286), -math.sin(0.0223214286), 0, 0]
        moved = [REST, [1, 2.0223214286, 0.5]], [UNTURNED, turned], [REST, [0, 0.178571429, 0]]
        wanted = *moved, [REST, [-0.357142857, 0, 0]], [131072], [2.5, -0.142857143, 0]
        step(rolls, wanted, more=([REST, [0, 4, 0]], REST))
        before = np.array([[0.75, 0.125, -0.25], [1, -0.25, 0.125], [0.875, 0.25, 0.125], [1, 0, -0.375]])
        key = 131072 + np.array([0, 2, 4, 6])
        carried = [
            [1.378205249, 0.143880904, -0.020717893], [0, 0, 0],
            [1.984176498, 0.421478054, 0.727088678], [0.388025646, 0.179823326, -0.208431232],
        ]  # fmt: skip
        moved = [REST, [1.000085852, 1.999799262, 2.000025524]], [UNTURNED, [1, 4.5352e-5, 2.0963e-5, 9.73e-7]]
        speeds = [REST, [6.86816e-4, -1.605906e-3, 1.35797e-4]], [REST, [7.49769e-4, 3.76441e-4, 1.5553e-5]]
        wanted = *moved, *speeds, key, carried
        given = world([FLOOR, box()], 0.5, 0.75)
        step(given, wanted, sweeps=50, memory=(key, before), more=([REST, [4, -6, 0]], [REST] * 2))
        up = np.array([0.0, -0.6, 0.8])
        q = [math.sqrt(0.9), math.sqrt(0.1), 0, 0]  # turned by the angle with the cosine 0.8 about x
        box_there = thing(BOX, (2, 2, 0.5), 2.0, 0.5 * up, q)
        bodies, state = world([thing(PLANE, up), box_there], 0.5, 1.0)
        given = plainly(bodies, state, [0, 0, -10], 0.015625, (0.5, 0.01, 200))
        place, _, v, w, _, j = numbers(submission.step_world, given, 6)
        assert np.allclose(place[1], 0.5 * up, atol=1e-5), f"the box is at {place[1]} and not where it was"
        assert np.allclose(v, 0, atol=1e-4), f"it slides with {v[1]}"
        assert np.allclose(w, 0, atol=1e-4), f"it turns with {w[1]}"
        assert np.isclose(np.sum(j, axis=0)[0], 0.25, rtol=1e-3), "the slope does not carry 0.8 of its weight"
