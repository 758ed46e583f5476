"""Impulses between rigid bodies: drawn examples against closed forms, limiting cases, and many at once.

A body is (v, ω, r, 1/M, I⁻¹). Formulas here are for one contact.
"""

from __future__ import annotations

import itertools

import numpy as np

from labs.grading.judging.comparison import expect, numbers, plainly
from labs.grading.judging.markers import asks

X, UP, LEANS, REST = [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1 / 3, 2 / 3, 2 / 3], [0.0, 0.0, 0.0]
FLAT, NO_TURN = np.diag([2.0, 2.0, 2.0]), np.zeros((3, 3))
GROUND = (REST, REST, REST, 0.0, NO_TURN)


def body(velocity, arm=REST, spin=REST, share=1.0, turning=FLAT):
    """A body of 1 kg, unless said otherwise."""
    return plainly(velocity, spin, arm, share, turning)


def point(velocity, spin, arm):
    """Turned about the axis by hand: component by component of ω × r."""
    (a, b, c), (x, y, z) = spin, arm
    return velocity + np.array([b * z - c * y, c * x - a * z, a * y - b * x])


def towards_a(normal, a, b):
    """Of unit length, on A's side."""
    unit = normal / np.sqrt(normal @ normal)
    return -unit if unit @ a < unit @ b else unit


@asks("edge_edge_normal", 3, "At right angles to both edges, of unit length, on A's side.")
def test_the_normal_of_any_two_edges_is_a_unit_vector_on_the_side_of_a(submission, part, examples):
    def across(edge_a, edge_b, a, b):
        return towards_a(point(np.zeros(3), edge_a, edge_b), a, b)

    def edges(draw):
        return draw.vector(), draw.vector(), draw.vector(3), draw.vector(3)

    with part(1, "any two edges"):
        examples.agree(submission.edge_edge_normal, across, edges, far=4)
    with part(1, "both centres on one side, and side by side; any size"):
        for a, b, right in (
            ([0, 0, 5], [0, 0, 9], [0, 0, -1]),
            ([4, 0, 1], [0, 0, 1], UP),
            ([9, 9, -1], REST, [0, 0, -1]),
        ):
            expect(submission.edge_edge_normal, ([3, 0, 0], [1, 2, 0], a, b), right)
        expect(submission.edge_edge_normal, ([1, 2, 0], [3, 0, 0], [4, 0, 1], [0, 0, 1]), [0.0, 0.0, -1.0])
        for size, a, b in itertools.product((1e-6, 1e6), (2, 4), (3,)):
            two, centres = np.array([[3.0, 0, 1], [1, 2, 0]]), size * np.array([[1.0, -1, a], [1, -1, b]])
            for given in ((*two, *centres), (*size * two, *centres)):
                expect(submission.edge_edge_normal, given, across(*given))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.edge_edge_normal, across, edges)


@asks("world_inverse_inertia", 4, "Each of the body's axes, turned, keeps its own moment.")
def test_each_axis_of_the_body_keeps_its_moment(submission, part, examples):
    def turned(axis, orientation):
        w, q = orientation[0], orientation[1:]
        return axis + 2 * w * np.cross(q, axis) + 2 * np.cross(q, np.cross(q, axis))

    def inverse(moments, orientation):
        axes = [turned(axis, orientation) for axis in np.eye(3)]
        return sum(np.outer(axis, axis) / moment for axis, moment in zip(axes, moments, strict=True))

    def bodies(draw):
        orientation = np.array([draw.number(0.1, 1) * draw.sign() for _ in range(4)])
        return np.array([draw.number(0.2, 4) for _ in range(3)]), orientation / np.sqrt(orientation @ orientation)

    with part(2, "any body"):
        examples.agree(submission.world_inverse_inertia, inverse, bodies)
    with part(1, "a ball, a thin rod, what cannot be turned; light and heavy"):
        lying = turned(np.array(UP), np.array([0.8, 0, 0.6, 0]))
        expect(submission.world_inverse_inertia, ([2, 2, 2], [0.8, 0, 0.6, 0]), np.eye(3) / 2)
        expect(
            submission.world_inverse_inertia, ([2, 2, 0], [0.8, 0, 0.6, 0]), (np.eye(3) - np.outer(lying, lying)) / 2
        )
        expect(submission.world_inverse_inertia, ([np.inf] * 3, [0.8, 0, 0.6, 0]), NO_TURN)
        for size in (1e-7, 1e7):
            given = size * np.array([1, 2, 3]), np.array([0.8, 0, 0.6, 0])
            expect(submission.world_inverse_inertia, given, inverse(*given))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.world_inverse_inertia, inverse, bodies)


def moved(one, impulse):
    """Velocities of a body after an impulse on it."""
    v, w, r, share, turning = one
    return v + share * impulse, w + turning @ np.cross(r, impulse)


def parting(a, b, normal):
    """How fast the points of contact part, along the normal."""
    return normal @ (point(*a[:3]) - point(*b[:3]))


def after(a, b, impulse):
    """Both bodies' velocities after J on A and −J on B."""
    return (*moved(a, impulse), *moved(b, -impulse))


def softness(a, b, normal):
    """What a unit impulse adds to the speed of parting: tried out."""
    v_a, w_a, v_b, w_b = after(a, b, normal)
    return parting((v_a, w_a, a[2]), (v_b, w_b, b[2]), normal) - parting(a, b, normal)


def magnitude(a, b, normal, e):
    """The impulse after which they part at −e times the speed before."""
    k = softness(a, b, normal)
    return -(1 + e) * parting(a, b, normal) / k if k > 1e-12 else 0.0


def collision(a, b, normal, e, threshold=0.0):
    """Velocities after an impact, unchanged where it is none."""
    colliding = parting(a, b, normal) < -threshold
    return after(a, b, magnitude(a, b, normal, e) * normal if colliding else np.zeros(3))


def pairs(draw):
    """Two bodies and a normal, mostly coming nearer."""
    normal = draw.unit()
    velocity, *others = draw.body()
    return (velocity - draw.number(1, 6) * normal, *others), draw.body(), normal


def with_e(draw):
    """The same with a restitution."""
    return (*pairs(draw), draw.number(0.1, 0.9))


LIMITS = tuple(
    plainly(*case)
    for case in (
        (body([0, 0, -2], [0.5, 0, -0.5]), GROUND, UP),
        (GROUND, body([0, 0, 2], [0.5, 0, 0.5]), UP),
        (body(REST, [1, 0, 0], [0, 2, 0], 0.0), body([0, 0, 1]), UP),  # on a pivot
        (body([3, 0, 0], [0, 0, -1]), body(REST), UP),  # grazing
        (body(REST, X), body(REST), UP),
        (body([0, 0, -2], X, turning=NO_TURN), body(REST), UP),
        (body([1, 0, -2], [0.25, 0, -1], [0, 1, 0]), body([0, 1, 0], [0, 0, 1], [2, 0, 0], 0.25), LEANS),
        (body([0, 0, 2], [0.5, 0, -0.5]), body([0, 0, -1]), UP),  # parting
        (body([0, 0, -2], share=0.0, turning=NO_TURN), GROUND, UP),  # both immovable
    )
)
"""A on the ground, B on the ground, a pivot, grazing, at rest, what cannot turn, a slanting plane, parting,
immovable."""


def sized(one, mass, length, time):
    """The same body in other units of mass, length and time."""
    v, w, r, share, turning = one
    return v * length / time, w / time, r * length, share / mass, turning / (mass * length**2)


UNITS = ((1e-7, 1, 1), (1e7, 1, 1), (1, 1e-5, 1), (1, 1e5, 1), (1, 1, 1e-5), (1, 1, 1e5))
"""From a tenth of a milligram to a ship of ten thousand tonnes; tiny and large, fast and slow."""
SIZED = tuple((sized(LIMITS[6][0], *unit), sized(LIMITS[6][1], *unit), LIMITS[6][2]) for unit in UNITS)
WHOLE = tuple((*(np.array(each) for each in whole), 1, np.eye(3, dtype=int)) for whole in (
    ([1, 0, -2], [0, 1, 0], [0, 1, 1]), ([0, 1, 1], [1, 0, 0], [1, 0, 0])
))  # fmt: skip
"""Two bodies in whole numbers, whose velocities afterwards are none."""


@asks("normal_velocity", 3, "The part of the velocity of A's point, as seen from B's, along the normal.")
def test_only_the_part_along_the_normal_counts(submission, part, examples):
    with part(1, "any two bodies"):
        examples.agree(submission.normal_velocity, parting, pairs, far=4)
    with part(1, "limiting cases: the ground, a pivot, grazing, at rest, the centre, the axis; bodies of any size"):
        for case in (*LIMITS, *SIZED):
            expect(submission.normal_velocity, case, parting(*case))
        for spin, arm in (([4, 5, 6], REST), ([0, 0, 2], [0, 0, 3])):
            expect(submission.normal_velocity, (body([1, 2, 3], arm, spin), body([1, 2, 3]), LEANS), 0.0)
            expect(submission.normal_velocity, (body(REST), body([1, 2, 3], arm, spin), LEANS), -11 / 3)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.normal_velocity, parting, pairs)


@asks("inverse_effective_mass", 5, "The speed of parting that a unit impulse gives.")
def test_a_unit_impulse_tried_out_gives_the_inverse_effective_mass(submission, part, examples):
    with part(2, "any two bodies"):
        examples.agree(submission.inverse_effective_mass, softness, pairs, far=4)
    with part(1, "limiting cases: the ground, a pivot, what cannot turn; bodies of any size"):
        for case in (*LIMITS, *SIZED):
            expect(submission.inverse_effective_mass, case, softness(*case))
    with part(1, "the same for −n, and for A and B swapped"):

        def symmetric(a, b, normal):
            k = numbers(submission.inverse_effective_mass, (a, b, normal))
            for other in ((a, b, -normal), (b, a, normal)):
                np.testing.assert_allclose(numbers(submission.inverse_effective_mass, other), k, rtol=1e-4)

        examples.every(pairs, symmetric)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.inverse_effective_mass, softness, pairs)


@asks("impulse_magnitude", 5, "With that impulse they part at −e times the speed before.")
def test_with_that_impulse_they_part_at_e_times_the_speed(submission, part, examples):
    with part(2, "any two bodies"):
        examples.agree(submission.impulse_magnitude, magnitude, with_e, far=4)
    with part(1, "limiting cases: the ground, a pivot, what cannot turn, parting; bodies of any size"):
        for case, e in (*itertools.product(LIMITS, (0.0, 0.5, 1.0)), *itertools.product(SIZED, (0.5,))):
            expect(submission.impulse_magnitude, (*case, e), magnitude(*case, e))
    with part(1, "twice the speed takes twice the impulse"):

        def in_proportion(a, b, normal, e):
            double = tuple((2 * one[0], 2 * one[1], *one[2:]) for one in (a, b))
            twice = numbers(submission.impulse_magnitude, (*double, normal, e))
            once = numbers(submission.impulse_magnitude, (a, b, normal, e))
            np.testing.assert_allclose(twice, 2 * once, rtol=1e-3, atol=1e-4)

        examples.every(with_e, in_proportion)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.impulse_magnitude, magnitude, with_e)


@asks("apply_impulse", 5, "J at the end of A's arm, −J at the end of B's.")
def test_the_impulse_acts_at_the_end_of_each_arm(submission, part, examples):
    def struck(draw):
        return draw.body(), draw.body(), draw.vector(4)

    with part(2, "any two bodies"):
        examples.agree(submission.apply_impulse, after, struck, far=4)
    with part(1, "limiting cases: the ground, no impulse; whole numbers; bodies of any size"):
        for a, b, _ in LIMITS:
            for impulse in (np.array([0, 1, 3.0]), np.zeros(3)):
                expect(submission.apply_impulse, (a, b, impulse), after(a, b, impulse))
        for (a, b, _), (mass, length, time) in zip(SIZED, UNITS, strict=True):
            impulse = mass * length / time * np.array([0, 1, 3.0])
            expect(submission.apply_impulse, (a, b, impulse), after(a, b, impulse))
        quarter = np.array([0.25, -0.5, 0.75])
        expect(submission.apply_impulse, (*WHOLE, quarter), after(*WHOLE, quarter))
    with part(1, "angular momentum about the point of contact is kept"):

        def kept(a, b, impulse):
            v_a, w_a, v_b, w_b = numbers(submission.apply_impulse, (a, b, impulse), 4)
            for (_, _, r, share, turning), dv, dw in ((a, v_a - a[0], w_a - a[1]), (b, v_b - b[0], w_b - b[1])):
                gained = np.linalg.solve(turning, dw) - np.cross(r, dv / share)
                np.testing.assert_allclose(gained, 0, atol=1e-3)

        examples.every(struck, kept)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.apply_impulse, after, struck)


@asks("collide", 6, "An impact where they approach faster than the threshold, and nothing else.")
def test_an_impact_of_any_two_bodies(submission, part, examples):
    with part(2, "any two bodies"):
        examples.agree(submission.collide, collision, with_e, far=4)
    with part(1, "limiting cases: the ground, a pivot, what cannot turn, parting, grazing; whole numbers"):
        for case, e in (*itertools.product(LIMITS, (0.0, 0.5, 1.0)), ((*WHOLE, np.array(UP)), 0.5)):
            expect(submission.collide, (*case, e), collision(*case, e))
    with part(1, "below, at and above the threshold, approaching and parting; bodies of any size"):
        for speed in (-2.0, -0.25, 0.25, 2.0):
            for threshold in (0.125, 0.25, 0.5):
                case = body([0, 0, speed], X), body(REST), np.array(UP), 0.5, threshold
                expect(submission.collide, case, collision(*case))
        for case in SIZED:
            for share in (0.875, 1.125):
                given = (*case, 0.5, -share * parting(*case))
                expect(submission.collide, given, collision(*given))
    with part(1, "the points part with e times the speed of their approach"):

        def as_asked(a, b, normal, e):
            v_a, w_a, v_b, w_b = numbers(submission.collide, (a, b, normal, e), 4)
            before, found = parting(a, b, normal), parting((v_a, w_a, a[2]), (v_b, w_b, b[2]), normal)
            np.testing.assert_allclose(found, -e * before if before < 0 else before, atol=1e-3)

        examples.every(with_e, as_asked)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.collide, collision, with_e)


def gained(one, velocity, spin):
    """Momentum, angular momentum about the point of contact, and energy that one body gains.

    The velocities grow steadily from what they were, in a hundred steps: dL = I dω − r × dP, and dE = v·dP + ω·I dω.
    What nothing moves, or nothing turns, gains nothing.
    """
    v, w, r, share, turning = one
    momentum = (velocity - v) / share if share else np.zeros(3)
    own = np.linalg.solve(turning, spin - w) if turning.any() else np.zeros(3)
    t = (np.arange(100)[:, None] + 0.5) / 100
    energy = np.mean((v + t * (velocity - v)) @ momentum + (w + t * (spin - w)) @ own)
    return momentum, own - np.cross(r, momentum), energy


def account(a, b, after):
    """What both bodies gain together."""
    return tuple(x + y for x, y in zip(gained(a, *after[:2]), gained(b, *after[2:]), strict=True))


@asks("audit", 4, "What both bodies gain together.")
def test_an_audit_of_any_velocities(submission, part, examples):
    def changed(draw):
        return draw.body(), draw.body(), tuple(draw.vector(size) for size in (3, 2, 3, 2))

    with part(2, "any two bodies"):
        examples.agree(submission.audit, account, changed, far=4)
    with part(1, "limiting cases: the ground, a pivot, what cannot turn, no change, correct impacts; any size"):
        for a, b, normal in LIMITS:
            for later in ((*a[:2], *b[:2]), collision(a, b, normal, 0.5)):
                gains = tuple(np.round(gain, 12) for gain in account(a, b, later))  # what is kept is 0, and no rounding
                expect(submission.audit, (a, b, later), gains)
        for (a, b, _), (_, length, time) in zip(SIZED, UNITS, strict=True):
            later = tuple(np.array(each) / time for each in ([1, 2, 3], [0, -1, 2], [-2, 1, 0], [3, 0, 1]))
            later = later[0] * length, later[1], later[2] * length, later[3]
            expect(submission.audit, (a, b, later), account(a, b, later))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.audit, account, changed)
