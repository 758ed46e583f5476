"""Avoiding a collision (slide 1): examples that a student sees.

Most scenes are turned and away from the origin, so that no axis is special. `place(x, y, z)` and `way(x, y, z)` are a
point and a direction of a scene's own axes, in the axes of the world.
"""

from __future__ import annotations

import numpy as np

from labs.grading.judging.comparison import expect, numbers
from labs.grading.judging.markers import asks

TURN = np.array([[2.0, 1, -2], [1, 2, 2], [2, -2, 1]]) / 3
"""A rotation: its columns are unit vectors at right angles to each other."""
CORNER = np.array([1.0, -2, 3])
REST = [0.0, 0.0, 0.0]
SIZES = (1e-10, 1e-3, 100.0, 1e7)


def way(x, y, z):
    """A direction of a scene's own axes."""
    return TURN @ [x, y, z]


def place(x, y, z):
    """A point of a scene's own axes."""
    return CORNER + way(x, y, z)


@asks(
    "seek", 4, "A body that seeks a target wants to move towards it at full speed, however far it is.",
    "Which way does target − position point, and which way position − target? How long is a direction?",
)  # fmt: skip
def test_a_body_that_seeks_wants_full_speed_towards_the_target(submission, part):
    with part(1, "in space, towards every side"):
        expect(submission.seek, ([1, -2, 3], [7, 1, -3], 3.0), [2, 1, -2])
        expect(submission.seek, ([7, 1, -3], [1, -2, 3], 1.5), [-1, -0.5, 1])
        expect(submission.seek, ([-3, 4, 1], [-1, 1, 7], 3.5), [1, -1.5, 3])
        expect(submission.seek, (REST, [0, 0, -0.5], 2.0), [0, 0, -2])
    with part(1, "in the plane; slowly, and not at all"):
        expect(submission.seek, ([1, 1], [4, 5], 2.0), [1.2, 1.6])
        expect(submission.seek, ([4, 5], [1, 1], 0.25), [-0.15, -0.2])
        expect(submission.seek, ([1, -2, 3], [7, 1, -3], 0.0), REST)
    with part(1, "at the target, near it and far from it"):
        expect(submission.seek, ([1, -2, 3], [1, -2, 3], 3.0), REST)
        for size in SIZES:
            expect(submission.seek, (REST, size * np.array([2, 1, -2]), 3.0), [2, 1, -2])
            expect(submission.seek, (size * np.array([2, 1, -2]), REST, 3.0), [-2, -1, 2])
            expect(submission.seek, ([1, -2, 3], [7, 1, -3], 3 * size), size * np.array([2, 1, -2]))
    with part(1, "several in one call"):
        targets = [[7, 1, -3], [1, -2, 3], [1, -2, 5]]
        expect(submission.seek, ([1, -2, 3], targets, 3.0), [[2, 1, -2], REST, [0, 0, 3]])
        expect(submission.seek, ([1, -2, 3], [7, 1, -3], [3.0, 1.5]), [[2, 1, -2], [1, 0.5, -1]])


@asks(
    "arrive", 5, "Outside the slowing radius full speed, inside a speed in proportion to the distance.",
    "How fast is the body at half the slowing radius? How fast at the radius itself, and farther out?",
)  # fmt: skip
def test_a_body_that_arrives_slows_in_proportion_to_what_is_left(submission, part):
    target = [7, 1, -3]  # 9 m from (1, −2, 3)
    with part(1, "outside the slowing radius and at it, as fast as if it sought the target"):
        expect(submission.arrive, ([1, -2, 3], target, 3.0, 4.5), [2, 1, -2])
        expect(submission.arrive, ([1, -2, 3], target, 3.0, 8.75), [2, 1, -2])
        expect(submission.arrive, ([1, -2, 3], target, 3.0, 9.0), [2, 1, -2])
        expect(submission.arrive, (target, [1, -2, 3], 1.5, 2.0), [-1, -0.5, 1])
        expect(submission.arrive, ([1, 1], [4, 5], 2.0, 4.0), [1.2, 1.6])
    with part(1, "inside the slowing radius"):
        expect(submission.arrive, ([1, -2, 3], target, 3.0, 18.0), [1, 0.5, -1])
        expect(submission.arrive, ([1, -2, 3], target, 3.0, 36.0), [0.5, 0.25, -0.5])
        expect(submission.arrive, (target, [1, -2, 3], 1.5, 12.0), [-0.75, -0.375, 0.75])
        expect(submission.arrive, ([-3, 4, 1], [-1, 1, 7], 14.0, 28.0), [1, -1.5, 3])
        expect(submission.arrive, ([1, 1], [4, 5], 2.0, 20.0), [0.3, 0.4])
        expect(submission.arrive, ([1, -2, 3], target, 3.0, 1800.0), [0.01, 0.005, -0.01])
    with part(1, "at the target; without a speed"):
        expect(submission.arrive, (target, target, 3.0, 4.5), REST)
        expect(submission.arrive, ([1, -2, 3], target, 0.0, 4.5), REST)
        expect(submission.arrive, ([1, -2, 3], target, 0.0, 18.0), REST)
    with part(1, "tiny, small and large distances, slowly and fast"):
        for size in SIZES:
            start, near, whole = size * np.array([-2, -1, 2]), 0.5 * size * np.array([-2, -1, 2]), 3 * size
            expect(submission.arrive, (start, REST, 3.0, 0.5 * whole), [2, 1, -2])
            expect(submission.arrive, (near, REST, 3.0, whole), [1, 0.5, -1])
            for speed in (1e-6, 1e6):
                expect(submission.arrive, (near, REST, 3 * speed, whole), speed * np.array([1, 0.5, -1]))
                expect(submission.arrive, (start, REST, 3 * speed, 0.5 * whole), speed * np.array([2, 1, -2]))
    with part(1, "several in one call"):
        places = [[1, -2, 3], [4, -0.5, 0], target]
        expect(submission.arrive, (places, target, 3.0, 9.0), [[2, 1, -2], [1, 0.5, -1], REST])
        expect(submission.arrive, ([1, -2, 3], target, [3.0, 6.0], [18.0, 4.5]), [[1, 0.5, -1], [4, 2, -4]])


@asks(
    "repelling_force", 5, "The force points away, is F0 at the surface and inside, and falls to zero at the reach.",
    "How large is the share of the reach that is left halfway? What is its square? And what is it beyond the reach?",
)  # fmt: skip
def test_a_field_repels_less_the_farther_away_and_not_at_all_from_its_reach_on(submission, part):
    n = [2 / 7, -3 / 7, 6 / 7]
    with part(1, "between the surface and the reach"):
        expect(submission.repelling_force, (1.0, [0, 0, 1], 8.0, 2.0), [0, 0, 2])
        expect(submission.repelling_force, (0.5, n, 112.0, 2.0), [18, -27, 54])
        expect(submission.repelling_force, (1.5, n, 112.0, 2.0), [2, -3, 6])
        expect(submission.repelling_force, (3.0, n, 112.0, 4.0), [2, -3, 6])
        expect(submission.repelling_force, (0.0625, n, 28.0, 0.125), [2, -3, 6])
        expect(submission.repelling_force, (0.375, n, 112.0, 0.5), [2, -3, 6])
    with part(1, "at the reach and beyond it"):
        for s in (2.0, 2.5, 4.0, 100.0):
            expect(submission.repelling_force, (s, n, 112.0, 2.0), REST)
        expect(submission.repelling_force, (0.5, n, 112.0, 0.25), REST)
    with part(1, "at the surface and inside"):
        for s in (0.0, -0.5, -2.0, -5.0):
            expect(submission.repelling_force, (s, n, 14.0, 2.0), [4, -6, 12])
        expect(submission.repelling_force, (1.0, n, 0.0, 2.0), REST)
    with part(1, "tiny, small and large, weak and strong"):
        for size in SIZES:
            for strength in (1e-6, 1.0, 1e6):
                force = strength * np.array([2, -3, 6])
                expect(submission.repelling_force, (size, n, 28 * strength, 2 * size), force)
                expect(submission.repelling_force, (3 * size, n, 28 * strength, 2 * size), REST)
    with part(1, "several in one call"):
        normals = [n, [0, 0, 1], n]
        found = [[2, -3, 6], [0, 0, 28], REST]
        expect(submission.repelling_force, ([1.0, -1.0, 3.0], normals, 28.0, 2.0), found)
        expect(submission.repelling_force, (1.0, n, [28.0, 112.0], [2.0, 0.5]), [[2, -3, 6], REST])


MIDDLE = place(5, 0, 0)
"""The centre of a sphere, 5 m from CORNER."""


@asks(
    "tangent_point", 6, "At the tangent point the radius and the way meet at a right angle.",
    "Position, centre and tangent point form a triangle. Where is its right angle? Drop a perpendicular from it onto"
    " the longest side: which triangles have the same shape?",
)  # fmt: skip
def test_the_radius_and_the_way_to_the_tangent_point_meet_at_a_right_angle(submission, part):
    with part(1, "to the side of the heading, 3, 4 and 5 m"):
        expect(submission.tangent_point, (REST, [2, 1, 0], [5, 0, 0], 3.0), [3.2, 2.4, 0])
        expect(submission.tangent_point, (REST, [1, -3, 0], [5, 0, 0], 4.0), [1.8, -2.4, 0])
        for side in ([1, 0], [-1, 0], [0, 1], [0.6, -0.8]):
            heading = way(2, 0.25 * side[0], 0.25 * side[1])
            touches = place(3.2, 2.4 * side[0], 2.4 * side[1])
            expect(submission.tangent_point, (CORNER, heading, MIDDLE, 3.0), touches)
    with part(1, "other spheres, other headings, and one that flies away"):
        far = place(13, 0, 0)
        expect(submission.tangent_point, (CORNER, way(1, 3, 4), far, 5.0), place(144 / 13, 36 / 13, 48 / 13))
        expect(submission.tangent_point, (CORNER, way(-4, 3, 4), far, 12.0), place(25 / 13, 36 / 13, 48 / 13))
        expect(submission.tangent_point, (far, way(-1, -1, 0), CORNER, 5.0), place(25 / 13, -60 / 13, 0))
        expect(submission.tangent_point, (CORNER, 1e3 * way(2, 0, 1), MIDDLE, 3.0), place(3.2, 0, 2.4))
    with part(1, "a heading that names no side: to the left, or towards +x"):
        for heading in ([2, 0, 0], [-2, 0, 0], REST):
            expect(submission.tangent_point, ([1, -2, 3], heading, [6, -2, 3], 3.0), [4.2, 0.4, 3])
        expect(submission.tangent_point, ([1, -2, 8], [0, 0, -1], [1, -2, 3], 3.0), [3.4, -2, 4.8])
    with part(1, "on the sphere, inside it and at its centre"):
        expect(submission.tangent_point, (CORNER, way(1, 2, 2), MIDDLE, 5.0), CORNER)
        for heading in (way(2, 1, 0), way(-1, 0, 2), way(1, 0, 0)):
            expect(submission.tangent_point, (place(3, 0, 0), heading, MIDDLE, 4.0), place(1, 0, 0))
        expect(submission.tangent_point, ([1, -2, 3], [1, 2, 0], [1, -2, 3], 3.0), [1, -2, 6])
    with part(1, "tiny, small and large"):
        for size in SIZES:
            for speed in (1e-6, 1e6):
                given = REST, speed * way(2, 0, -1), size * way(5, 0, 0), 3 * size
                expect(submission.tangent_point, given, size * way(3.2, 0, -2.4))
            inside = size * way(3, 0, 0), way(0, 1, 0), size * way(5, 0, 0), 4 * size
            expect(submission.tangent_point, inside, size * way(1, 0, 0))
    with part(1, "several in one call"):
        places = [CORNER, place(3, 0, 0), place(5, 5, 0)]
        touches = [place(3.2, 2.4, 0), place(2, 0, 0), place(7.4, 1.8, 0)]
        expect(submission.tangent_point, (places, way(1, 1, 0), MIDDLE, 3.0), touches)
        expect(submission.tangent_point, (CORNER, way(1, 1, 0), MIDDLE, [[3.0], [4.0]]),
               [[place(3.2, 2.4, 0)], [place(1.8, 2.4, 0)]])  # fmt: skip


@asks(
    "nearest_approach", 6, "The distance is smallest where the vector between the two is at right angles to the"
    " relative velocity, or now if they move apart.",
    "Sit on B: where is A, and how fast does it come? Square the distance after the time t. Where is it smallest? And"
    " what if that was yesterday?",
)  # fmt: skip
def test_two_bodies_are_nearest_where_their_distance_stops_shrinking(submission, part):
    a, b = (np.array([7.0, -2, 0]), np.array([-1.0, 3, 5])), (np.array([1.0, -2, 3]), np.array([1.0, 2, 3]))

    with part(1, "they pass each other, and have different radii"):
        expect(submission.nearest_approach, ([-4, 1, 0], [2, 0, 0], [4, 0, 0], [-2, 0, 0], 0.25, 0.5), (2.0, 0.25))
        expect(submission.nearest_approach, (*a, *b, 0.5, 0.25), (2.0, 2.25))
        expect(submission.nearest_approach, (*b, *a, 0.125, 1.5), (2.0, 1.375))
        expect(submission.nearest_approach, (*a, *b), (2.0, 3.0))
        expect(submission.nearest_approach, ([3, 0, 1.5], [-3, 1, 1], [1, -2, 3], [1, 1, -2], 0.25, 0.5), (0.5, 1.25))
    with part(1, "they will overlap, or meet head-on"):
        expect(submission.nearest_approach, (*a, *b, 2.0, 1.5), (2.0, -0.5))
        expect(submission.nearest_approach, ([5, 0, 7], [-2, -1, -2], [1, -2, 3], REST, 1.0, 0.5), (2.0, -1.5))
    with part(1, "they move apart, or keep their distance"):
        expect(submission.nearest_approach, ([7, 0, 6], [2, 1, 2], [1, -2, 3], REST, 1.0, 0.5), (0.0, 5.5))
        expect(submission.nearest_approach, ([7, 0, 6], [1, 2, 5], [1, -2, 3], [-1, 1, 3], 5.0, 4.0), (0.0, -2.0))
        expect(submission.nearest_approach, ([3, 0, 4], [2, -2, 0], [1, -2, 3], REST, 1.0, 0.25), (0.0, 1.75))
        expect(submission.nearest_approach, ([7, 0, 6], [1, 2, 5], [1, -2, 3], [1, 2, 5], 1.0, 0.5), (0.0, 5.5))
        expect(submission.nearest_approach, ([7, 0, 6], REST, [1, -2, 3], REST, 1.0, 0.5), (0.0, 5.5))
        expect(submission.nearest_approach, ([1, -2, 3], [1, 2, 5], [1, -2, 3], REST, 1.0, 0.5), (0.0, -1.5))
    with part(1, "a wind that carries both changes nothing"):
        for wind in ([8, -4, 16], [-64, 32, 8]):
            (x, v), (y, w) = a, b
            expect(submission.nearest_approach, (x, v + wind, y, w + wind, 0.5, 0.25), (2.0, 2.25))
            expect(submission.nearest_approach, (x + wind, v, y + wind, w, 0.5, 0.25), (2.0, 2.25))
        expect(submission.nearest_approach, ([7, -2, 0], [-2, 1, 2], [1, -2, 3], REST, 0.5, 0.25), (2.0, 2.25))
        expect(submission.nearest_approach, ([7, -2, 0], REST, [1, -2, 3], [2, -1, -2], 0.5, 0.25), (2.0, 2.25))
    with part(1, "tiny, small and large, slowly and fast"):
        for size in SIZES:
            for speed in (1e-6, 1e6):
                (x, v), (y, w) = a, b
                given = size * x, size * speed * v, size * y, size * speed * w, 0.5 * size, 0.25 * size
                assert abs(numbers(submission.nearest_approach, given, 2)[0] * speed - 2) < 1e-3, "the time is wrong"
                expect(submission.nearest_approach, given, (2 / speed, 2.25 * size))
                far, fast = np.add(y, [6, 2, 3]), np.add(w, [2, 1, 2])
                parting = size * y, size * speed * w, size * far, size * speed * fast
                expect(submission.nearest_approach, (*parting, size, 0.5 * size), (0.0, 5.5 * size))
    with part(1, "several in one call"):
        velocities = [[-1, 3, 5], [1, 2, 3], [3, 1, 1]]
        expect(submission.nearest_approach, (a[0], velocities, *b, 0.5, 0.25),
               ([2, 0, 0], [2.25, np.sqrt(45) - 0.75, np.sqrt(45) - 0.75]))  # fmt: skip
        velocities, radii = [[-1, 3, 5], [0.5, 2.25, 3.5]], ([0.5, 2.0], [0.25, 1.5])
        expect(submission.nearest_approach, (a[0], velocities, *b, *radii), ([2, 8], [2.25, -0.5]))


def pairs(*both):
    """The indices of pairs, as `neighbour_pairs` gives them."""
    found = np.array(both, dtype=int).reshape(-1, 2)
    return found[:, 0], found[:, 1]


SQUARE = np.array([place(0, 0, 0), place(2, 0, 0), place(0, 4, 0), place(2, 4, 0)])
"""The corners of a rectangle of 2 m by 4 m."""


@asks(
    "separation", 6, "Each neighbour pushes away from itself, with one over its distance.",
    "Which way does the push on i point? How long is p_i − p_j, and what must you divide it by to make it 1/d long? And"
    " which pairs is i a part of?",
)  # fmt: skip
def test_neighbours_push_each_other_apart_by_one_over_their_distance(submission, part):
    with part(1, "two, near and far, in the plane and in space"):
        expect(submission.separation, ([[1, 1], [4, 5]], *pairs((0, 1))), [[-0.12, -0.16], [0.12, 0.16]])
        expect(submission.separation, ([[1, -2, 3], [7, 1, -3]], *pairs((0, 1))), [[-2 / 27, -1 / 27, 2 / 27],
               [2 / 27, 1 / 27, -2 / 27]])  # fmt: skip
        expect(submission.separation, ([place(0, 0.5, 0), CORNER], *pairs((0, 1))), [way(0, 2, 0), way(0, -2, 0)])
    with part(1, "several neighbours, whether they come first or second in a pair"):
        expect(submission.separation, (SQUARE, *pairs((0, 1), (0, 2))),
               [way(-0.5, -0.25, 0), way(0.5, 0, 0), way(0, 0.25, 0), REST])  # fmt: skip
        expect(submission.separation, (SQUARE, *pairs((0, 1), (0, 2), (1, 3), (2, 3))),
               [way(-0.5, -0.25, 0), way(0.5, -0.25, 0), way(-0.5, 0.25, 0), way(0.5, 0.25, 0)])  # fmt: skip
        expect(submission.separation, (SQUARE, *pairs((0, 3), (1, 3), (2, 3))),
               [way(-0.1, -0.2, 0), way(0, -0.25, 0), way(-0.5, 0, 0), way(0.6, 0.45, 0)])  # fmt: skip
        line = [place(0, 0, 0), place(0, 0, 1), place(0, 0, 3)]
        expect(submission.separation, (line, *pairs((0, 1), (0, 2), (1, 2))),
               [way(0, 0, -4 / 3), way(0, 0, 0.5), way(0, 0, 5 / 6)])  # fmt: skip
    with part(1, "who is nobody's neighbour is not pushed"):
        expect(submission.separation, (SQUARE, *pairs((1, 3))), [REST, way(0, -0.25, 0), REST, way(0, 0.25, 0)])
        expect(submission.separation, (SQUARE, *pairs()), [REST] * 4)
        expect(submission.separation, ([[1, 2]], *pairs()), [[0, 0]])
    with part(1, "two at the same place do not push each other"):
        double = [CORNER, CORNER, place(0, 2, 0)]
        expect(submission.separation, (double, *pairs((0, 1), (0, 2), (1, 2))),
               [way(0, -0.5, 0), way(0, -0.5, 0), way(0, 1, 0)])  # fmt: skip
        expect(submission.separation, (double, *pairs((0, 1))), [REST] * 3)
    with part(2, "tiny, small and large"):
        for size in SIZES:
            three = size * (SQUARE[:3] - CORNER)
            expect(submission.separation, (three, *pairs((0, 1), (0, 2))),
                   np.array([way(-0.5, -0.25, 0), way(0.5, 0, 0), way(0, 0.25, 0)]) / size)  # fmt: skip


VALUES = np.array([[1.0, -2, 3], [5, 0, 2], [3, 6, -5], [-3, 2, 12]])


@asks(
    "towards_mean", 6, "The mean of the neighbours alone, less the own value.",
    "Who belongs to the mean, and who does not? How many neighbours does each boid have?",
)  # fmt: skip
def test_the_mean_of_the_neighbours_less_the_own_value(submission, part):
    with part(1, "two, in the plane and in space"):
        expect(submission.towards_mean, ([[1, 1], [4, 5]], *pairs((0, 1))), [[3, 4], [-3, -4]])
        expect(submission.towards_mean, (VALUES[:2], *pairs((0, 1))), [[4, 2, -1], [-4, -2, 1]])
    with part(1, "several neighbours, whether they come first or second in a pair"):
        expect(submission.towards_mean, (VALUES, *pairs((0, 1), (0, 2))),
               [[3, 5, -4.5], [-4, -2, 1], [-2, -8, 8], REST])  # fmt: skip
        expect(submission.towards_mean, (VALUES, *pairs((0, 3), (1, 3), (2, 3))),
               [[-4, 4, 9], [-8, 2, 10], [-6, -4, 17], [6, -2 / 3, -12]])  # fmt: skip
        expect(submission.towards_mean, (VALUES, *pairs((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))),
               [[2 / 3, 14 / 3, 0], [-14 / 3, 2, 4 / 3], [-2, -6, 32 / 3], [6, -2 / 3, -12]])  # fmt: skip
    with part(1, "a chain, in which each has other neighbours"):
        expect(submission.towards_mean, (VALUES, *pairs((0, 1), (1, 2), (2, 3))),
               [[4, 2, -1], [-3, 2, -3], [-2, -5, 12], [6, 4, -17]])  # fmt: skip
    with part(1, "without neighbours"):
        expect(submission.towards_mean, (VALUES, *pairs((1, 2))), [REST, [-2, 6, -7], [2, -6, 7], REST])
        expect(submission.towards_mean, (VALUES, *pairs()), [REST] * 4)
        expect(submission.towards_mean, ([[1, 2]], *pairs()), [[0, 0]])
    with part(1, "all alike"):
        expect(submission.towards_mean, ([[1, -2, 3]] * 3, *pairs((0, 1), (0, 2), (1, 2))), [REST] * 3)
    with part(1, "tiny, small and large"):
        for size in SIZES:
            expect(submission.towards_mean, (size * VALUES, *pairs((0, 1), (0, 2))),
                   size * np.array([[3, 5, -4.5], [-4, -2, 1], [-2, -8, 8], REST]))  # fmt: skip


A_AT, B_AT, B_MOVES = np.array([-2.0, -5]), np.array([1.0, -1]), np.array([0.5, -1])
"""B is 5 m from A. Ahead is (0.6, 0.8), and left of it (−0.8, 0.6)."""


def plane(ahead, left):
    """A vector with these parts ahead and to the left, in the axes of the world."""
    return np.array([0.6 * ahead - 0.8 * left, 0.8 * ahead + 0.6 * left])


def approaching(ahead, left, horizon, radius_a=2.0, radius_b=1.0, dt=0.125):
    """The arguments for a relative velocity with these parts. With radii of 3 m, half the cone has the sine 3/5."""
    return A_AT, B_MOVES + plane(ahead, left), radius_a, B_AT, B_MOVES, radius_b, horizon, dt


@asks(
    "orca_half_plane", 6, "A makes half of the shortest change that takes the relative velocity to the cone's border.",
    "Draw the cone in the plane of relative velocities. Which side of it is nearer? Which way is out, and how far is"
    " it? How much of it is A's?",
)  # fmt: skip
def test_a_makes_half_of_the_way_to_the_border_of_the_cone(submission, part):
    def half(ahead, left, horizon, change, normal, **sizes):
        given = approaching(ahead, left, horizon, **sizes)
        expect(submission.orca_half_plane, given, (given[1] + change / 2 * plane(*normal), plane(*normal)))

    with part(1, "inside the cone, on either side"):
        expect(submission.orca_half_plane, ([0, 0], [1, 0.5], 1.5, [5, 0], [-1, 0], 1.5, 10.0, 0.1),
               ([0.76, 0.82], [-0.6, 0.8]))  # fmt: skip
        half(2, 0.5, 10.0, 0.8, (-0.6, 0.8))
        half(2, -0.5, 10.0, 0.8, (-0.6, -0.8))
        half(3, 1, 8.0, 1.0, (-0.6, 0.8))
        half(3, -1, 8.0, 1.8, (-0.8, -0.6), radius_a=1.0, radius_b=3.0)
    with part(1, "outside the cone: A may give up half of its room"):
        half(1, 2, 10.0, -1.0, (-0.6, 0.8))
        half(0.5, -3, 10.0, -2.1, (-0.6, -0.8))
        half(1, -2, 10.0, -19 / 13, (-5 / 13, -12 / 13), radius_a=25 / 13 - 1, radius_b=1.0)
    with part(1, "at the round end, from inside and from outside"):
        half(1.7, 0.6, 2.0, 0.5, (-0.8, 0.6))
        half(0.5, -1.5, 2.0, -1.0, (-0.8, -0.6))
        half(1.0, 0.0, 2.0, 0.0, (-1, 0))
        half(-6.5, 0.0, 2.0, -7.5, (-1, 0))
    with part(1, "discs that overlap part within the step"):
        given = A_AT, B_MOVES + plane(34, 8), 4.0, B_AT, B_MOVES, 2.0, 10.0, 0.125
        expect(submission.orca_half_plane, given, (given[1] + 19 * plane(-0.6, 0.8), plane(-0.6, 0.8)))
        given = A_AT, B_MOVES + plane(34, 8), 2.0, B_AT, B_MOVES, 3.0, 10.0, 0.125
        expect(submission.orca_half_plane, given, (given[1] + 15 * plane(-0.6, 0.8), plane(-0.6, 0.8)))
        expect(submission.orca_half_plane, ([1, 2], [1, 1], 1.0, [1, 2], [-3, 4], 0.5, 10.0, 0.125),
               ([1 + 2.8, 1 - 2.1], [0.8, -0.6]))  # fmt: skip
    with part(1, "exactly head-on each turns to its right; two points"):
        expect(submission.orca_half_plane, ([0, 0], [1, 0], 1.5, [5, 0], [-1, 0], 1.5, 10.0, 0.1),
               ([1 - 0.36, -0.48], [-0.6, -0.8]))  # fmt: skip
        expect(submission.orca_half_plane, ([5, 0], [-1, 0], 1.5, [0, 0], [1, 0], 1.5, 10.0, 0.1),
               ([0.36 - 1, 0.48], [0.6, 0.8]))  # fmt: skip
        half(2, 0.5, 10.0, -0.5, (0, 1), radius_a=0.0, radius_b=0.0)
        half(2, -1, 10.0, -1.0, (0, -1), radius_a=0.0, radius_b=0.0)
    with part(1, "tiny, small and large, and several in one call"):
        for size in SIZES:
            for speed in (1e-6, 1e6):
                moves = size * speed * B_MOVES
                given = (size * A_AT, moves + size * speed * plane(2, 0.5), 2 * size, size * B_AT, moves, size)
                point = given[1] + 0.4 * size * speed * plane(-0.6, 0.8)
                expect(submission.orca_half_plane, (*given, 10 / speed, 0.1 / speed), (point, plane(-0.6, 0.8)))
        velocities = [B_MOVES + plane(*each) for each in ((2, 0.5), (2, -0.5), (1.7, 0.6))]
        points = [velocities[0] + 0.4 * plane(-0.6, 0.8), velocities[1] + 0.4 * plane(-0.6, -0.8),
                  velocities[2] + 0.25 * plane(-0.8, 0.6)]  # fmt: skip
        expect(submission.orca_half_plane, (A_AT, velocities, 2.0, B_AT, B_MOVES, 1.0, [10.0, 10.0, 2.0], 0.125),
               (points, [plane(-0.6, 0.8), plane(-0.6, -0.8), plane(-0.8, 0.6)]))  # fmt: skip
