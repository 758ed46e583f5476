"""Swept volumes (slide 10): examples that a student sees.

Most scenes are turned and away from the origin, so that no axis is special. `place(x, y, z)` and `way(x, y, z)` are a
point and a direction of a scene's own axes, in the axes of the world.
"""

from __future__ import annotations

import math

import numpy as np

from labs.grading.calling.scenario_runs import compared_with_theory, with_solutions
from labs.grading.judging.comparison import expect, numbers
from labs.grading.judging.markers import asks

TURN = np.array([[2.0, 1, -2], [1, 2, 2], [2, -2, 1]]) / 3
"""A rotation: its columns are unit vectors at right angles to each other."""
CORNER = np.array([1.0, -2, 3])
REST = [0.0, 0.0, 0.0]
INFINITY, MISS = math.inf, (math.inf, -math.inf)


def way(x, y, z):
    """A direction of a scene's own axes."""
    return TURN @ [x, y, z]


def place(x, y, z):
    """A point of a scene's own axes."""
    return CORNER + way(x, y, z)


@asks(
    "ray_sphere", 5, "A ray meets the sphere at the first time at which it is as far from the middle as the radius.",
    "How far is x + u t from the middle? Where is this distance r, and at which of the two times does the ray come in?",
)  # fmt: skip
def test_a_ray_meets_the_sphere_where_it_first_comes_in(submission, part):
    with part(1, "from every side, fast and slow"):
        expect(submission.ray_sphere, ([-5, 0, 0], [2, 0, 0], 1.0), 2.0)
        expect(submission.ray_sphere, ([5, 4, 2], [-2, -1, 0], 3.0), 2.0)  # at (1, 2, 2)
        expect(submission.ray_sphere, ([3.5, -5.5, -5], [-1, 3, 2], 3.0), 1.5)  # at (2, −1, −2)
        expect(submission.ray_sphere, ([-4, -0.5, 3], [4, -1, -2], 3.0), 0.5)  # at (−2, −1, 2)
        expect(submission.ray_sphere, ([2.5, 3.25, 6.75], [-0.125, -0.0625, -0.1875], 7.0), 4.0)  # at (2, 3, 6)
        expect(submission.ray_sphere, ([5e-6, 4e-6, 2e-6], [-2e-6, -1e-6, 0], 3e-6), 2.0)  # a grain of dust
    with part(1, "past the sphere, and away from it"):
        expect(submission.ray_sphere, ([5, 4, 2], [-2, 1, 0], 3.0), INFINITY)
        expect(submission.ray_sphere, ([-6, 2, 2.5], [3, 0, 0], 3.0), INFINITY)
        expect(submission.ray_sphere, ([5, 4, 2], [2, 1, 0], 3.0), INFINITY)
        expect(submission.ray_sphere, ([5e-6, 4e-6, 2e-6], [2e-6, 1e-6, 0], 3e-6), INFINITY)
        expect(submission.ray_sphere, ([-4, -0.5, 3], [-4, 1, 2], 3.0), INFINITY)
    with part(1, "it grazes the sphere, or almost does"):
        expect(submission.ray_sphere, ([-6, 0, 2], [3, 0, 0], 2.0), 2.0)
        expect(submission.ray_sphere, ([-6, 0, 2.001], [3, 0, 0], 2.0), INFINITY)
        expect(submission.ray_sphere, ([6, 0, 2], [3, 0, 0], 2.0), INFINITY)
    with part(1, "from inside and from the surface, whichever way; without a direction; a point"):
        for x in ([1, 0.5, -1], REST, [2, -1, 2], [0, 0, -3]):
            for u in ([1, 2, 3], [-2, 1, 1], [0, 0, 5], REST):
                expect(submission.ray_sphere, (x, u, 3.0), 0.0)
        expect(submission.ray_sphere, ([2, -1, 3], REST, 3.0), INFINITY)
        expect(submission.ray_sphere, ([0, -6, 0], [0, 3, 0], 0.0), 2.0)
        expect(submission.ray_sphere, ([1, -6, 0], [0, 3, 0], 0.0), INFINITY)
        expect(submission.ray_sphere, (REST, [1, 0, 0], 0.0), 0.0)
    with part(1, "several in one call"):
        starts, ways = [[5, 4, 2], [1, 0.5, -1], [5, 4, 2]], [[-2, -1, 0], [2, 1, 0], [2, 1, 0]]
        expect(submission.ray_sphere, (starts, ways, 3.0), [2.0, 0.0, INFINITY])
        expect(submission.ray_sphere, ([5, 4, 2], [-2, -1, 0], [[3.0], [7.0]]), [[2.0], [0.0]])


@asks(
    "sweep_sphere_sphere", 6, "As seen from B, A moves alone; and balls touch when their centres are r_A + r_B apart.",
    "Slide 10, the motion of one object relative to the other. Sit on B: where do you see A, and how fast? How large"
    " must B be so that A may be a point?",
)  # fmt: skip
def test_two_balls_touch_within_the_step_or_not(submission, part, examples):
    a = np.array([6.0, 2, 5]), np.array([-1.0, 1, 3]), 1.0
    b = np.array([1.0, -2, 3]), np.array([1.0, 2, 3]), 2.0

    with part(1, "both move, and have different radii"):
        expect(submission.sweep_sphere_sphere, ([-4, 0, 0], [2, 0, 0], 0.5, [4, 0, 0], [-1, 0, 0], 1.5, 5.0), 2.0)
        expect(submission.sweep_sphere_sphere, (*a, *b, 5.0), 2.0)
        expect(submission.sweep_sphere_sphere, (*b, *a, 5.0), 2.0)
        expect(submission.sweep_sphere_sphere, ([0, 4, 1], [2, 0, -1], 0.25, [4, 4.5, -2], [-2, 1, 1], 2.75, 1.0), 0.5)
        expect(submission.sweep_sphere_sphere, ([2.5, -7.5, -8], [2, 1, 4], 2.5, [-1, -2, -3], [3, -2, 2], 0.5, 9), 1.5)
    with part(1, "past each other, grazing, and away from each other; one at rest, or both"):
        expect(submission.sweep_sphere_sphere, ([-4, 3, 0], [2, 0, 1], 1.0, [4, 0, 0], [-2, 0, 1], 2.0, 4.0), 2.0)
        expect(submission.sweep_sphere_sphere, ([6, 2, 5], [-1, 3, 3], 1.0, *b, 5.0), INFINITY)
        expect(submission.sweep_sphere_sphere, ([6, 2, 5], [3, 3, 3], 1.0, *b, 5.0), INFINITY)
        expect(submission.sweep_sphere_sphere, ([6, 2, 5], [-2, -1, 0], 1.0, [1, -2, 3], REST, 2.0, 5.0), 2.0)
        expect(submission.sweep_sphere_sphere, ([6, 2, 5], [1, 2, 3], 1.0, *b, 5.0), INFINITY)
    with part(1, "before the step ends, at its very end, and too late; a step without an end"):
        for dt, time in ((0.0, INFINITY), (0.999, INFINITY), (1.0, 1.0), (1.001, 1.0), (INFINITY, 1.0)):
            expect(submission.sweep_sphere_sphere, ([-5, 0, 0], [2, 0, 1], 0.5, REST, [-1, 0, 1], 1.5, dt), time)
        expect(submission.sweep_sphere_sphere, (*a, *b, 1.5), INFINITY)
        expect(submission.sweep_sphere_sphere, ([6, 2, 5], [-1, 3, 3], 1.0, *b, INFINITY), INFINITY)
    with part(1, "balls that overlap or touch now, even if they part"):
        for velocity in ([5, 0, 0], [-5, 0, 0], [2, -1, 2]):
            for dt in (0.0, 1.0):
                expect(submission.sweep_sphere_sphere, ([2, -1, 4], velocity, 1.0, *b, dt), 0.0)
                expect(submission.sweep_sphere_sphere, ([3, -3, 5], velocity, 1.0, *b, dt), 0.0)
    with part(1, "a wind that carries both changes nothing"):

        def same(wind):
            calm = numbers(submission.sweep_sphere_sphere, (*a, *b, 5.0))
            (x, v, r), (y, w, s) = a, b
            windy = numbers(submission.sweep_sphere_sphere, (x, v + wind, r, y, w + wind, s, 5.0))
            assert abs(windy - calm) < 1e-3, f"the wind {wind} changes the time"

        examples.every(lambda draw: (draw.vector(),), same)
        expect(submission.sweep_sphere_sphere, ([6, 2, 5], [8, 5, -4], 1.0, [1, -2, 3], [10, 6, -4], 2.0, 5.0), 2.0)
    with part(1, "several pairs in one call"):
        starts, late = [[6, 2, 5], [2, -1, 4], [6, 2, 5]], [5.0, 5.0, 1.0]
        expect(submission.sweep_sphere_sphere, (starts, *a[1:], *b, late), [2.0, 0.0, INFINITY])


@asks(
    "missed_share", 4, "A chord shorter than the way between two looks may lie between them.",
    "How long is the chord along which A overlaps B if it passes at the offset b? With which probability does no look"
    " fall on it? Take the mean over the area of the disk.",
)  # fmt: skip
def test_the_share_of_collisions_that_looks_miss(submission, part):
    with part(1, "a way as long as both radii together, half of it and twice it"):
        expect(submission.missed_share, (10.0, 0.5, 1.5, 0.2), 1 / 12)
        expect(submission.missed_share, (5.0, 1.5, 0.5, 0.2), 1 / 48)
        expect(submission.missed_share, (40.0, 0.5, 1.5, 0.1), 1 / 3)
        expect(submission.missed_share, (3.0, 0.75, 0.25, 0.5), 3 / 16)
    with part(1, "a way longer than every chord"):
        expect(submission.missed_share, (40.0, 0.5, 1.5, 0.2), 2 / 3)
        expect(submission.missed_share, (8.0, 0.75, 0.25, 0.5), 2 / 3)
        expect(submission.missed_share, (100.0, 0.25, 0.5, 0.1), 0.9)
    with part(1, "at rest, looks without a pause, and points"):
        expect(submission.missed_share, (0.0, 0.5, 1.5, 0.2), 0.0)
        expect(submission.missed_share, (10.0, 0.5, 1.5, 0.0), 0.0)
        expect(submission.missed_share, (10.0, 0.0, 0.0, 0.2), 1.0)
        expect(submission.missed_share, (0.0, 0.0, 0.0, 0.2), 0.0)
        expect(submission.missed_share, (10.0, 2.0, 0.0, 0.2), 1 / 12)
    with part(1, "several in one call"):
        speeds, radii = [10.0, 40.0, 0.0, 3.0], [1.5, 1.5, 1.5, 0.0]
        expect(submission.missed_share, (speeds, 0.5, radii, 0.2), [1 / 12, 2 / 3, 0.0, 0.12])
        expect(submission.missed_share, (10.0, [0.5, 0.0], [1.5, 0.0], 0.2), [1 / 12, 1.0])


HALF = [1.0, 2.0, 3.0]


@asks(
    "ray_box", 6, "The ray is in the box from the last time at which it enters a slab until the first at which it"
    " leaves one.",
    "When is the ray between the two faces across x? When is it between those across y? When is both true? And what"
    " do you divide by if the ray goes along x?",
)  # fmt: skip
def test_a_ray_is_in_the_box_while_it_is_in_all_its_slabs(submission, part):
    with part(1, "in through each of the six faces, and out through another"):
        for x, u, times in (
            ([-4, -1, 2], [2, 1, -0.5], (1.5, 2.5)), ([5, 1, 2], [-4, 0.5, -1], (1, 1.5)),
            ([0.5, -6, 1], [0.25, 4, -1], (1, 2)), ([0, 10, 1], [-0.125, -2, 0.25], (4, 6)),
            ([0.5, 1, -5], [-1, 0.5, 4], (0.5, 1.5)), ([-0.5, 1, 7], [0.125, -1, -2], (2, 3)),
        ):  # fmt: skip
            expect(submission.ray_box, (x, u, HALF), times)
        slow = 2.0**-60  # slower than any threshold below which a ray might be taken to stand still
        expect(submission.ray_box, ([-4, -1, 2], slow * np.array([2, 1, -0.5]), HALF), (1.5 / slow, 2.5 / slow))
    with part(1, "along an axis: between the faces beside it, on one of them, and outside"):
        for x, u, times in (
            ([-3, 1, 2], [2, 0, 0], (1, 2)), ([0.5, 8, -1], [0, -2, 0], (3, 5)), ([-0.5, 1, -5], [0, 0, 1], (2, 8)),
            ([-3, 2, 1], [2, 0, 0], (1, 2)), ([-3, -2, -3], [2, 0, 0], (1, 2)), ([1, 8, 3], [0, -2, 0], (3, 5)),
            ([-3, 2.5, 1], [2, 0, 0], MISS), ([-3, 1, -3.5], [2, 0, 0], MISS), ([-1.5, 8, 1], [0, -2, 0], MISS),
            ([0.5, 8, 4], [0, -2, 0], MISS), ([1.5, 1, -5], [0, 0, 1], MISS), ([0.5, -3, -5], [0, 0, 1], MISS),
            ([-3, 3, 0], [2, 1, 0], MISS), ([-3, -3, 3], [2, 2, 0], (1, 2)), ([-3, -3, 3.5], [2, 2, 0], MISS),
        ):  # fmt: skip
            expect(submission.ray_box, (x, u, HALF), times)
    with part(1, "past the box, and away from it"):
        for x, u in (
            ([-4, -5, 2], [2, 1, -1]), ([4, 1, 5], [1, 0.5, 2]), ([-4, 1, 2], [-2, 1, 1]), ([2, 6, 0], [-1, -1, 4]),
            ([0.5, 1, 4], [-0.25, -0.5, 0.125]), ([-5, 4, 0.5], [2, 2, 0.25]), ([3, 3, 2], [-1, 0.5, 0]),
        ):  # fmt: skip
            expect(submission.ray_box, (x, u, HALF), MISS)
    with part(1, "from within and from a face"):
        for x, u, times in (
            ([0.5, -1, 2], [2, 1, -4], (0, 0.25)), ([0.5, -1, 2], [0, -4, 0], (0, 0.25)), (REST, [1, 1, 6], (0, 0.5)),
            ([1, 0.5, 0.5], [2, 1, 0], (0, 0)), ([1, 0.5, 0.5], [-2, 1, 0], (0, 1)), ([0.5, -2, 1], [0, 1, -2], (0, 2)),
        ):  # fmt: skip
            expect(submission.ray_box, (x, u, HALF), times)
    with part(1, "it grazes an edge; it has no direction; a box that is flat or a point"):
        expect(submission.ray_box, ([-3, 0, 0.5], [1, 1, 0], HALF), (2, 2))
        expect(submission.ray_box, ([0.5, -1, 2], REST, HALF), (0, INFINITY))
        expect(submission.ray_box, ([1, -2, 3], REST, HALF), (0, INFINITY))
        expect(submission.ray_box, ([0.5, -1, 4], REST, HALF), MISS)
        expect(submission.ray_box, ([-4, 1, 2], [2, 0.25, -1], [0, 2, 3]), (2, 2))
        expect(submission.ray_box, ([0, -5, 2], [0, 2, -1], [0, 2, 3]), (1.5, 3.5))
        expect(submission.ray_box, ([-4, -2, 2], [2, 1, -1], REST), (2, 2))
    with part(1, "several in one call"):
        starts, ways = [[-4, -1, 2], [-3, 2.5, 1], [0.5, -1, 2]], [[2, 1, -0.5], [2, 0, 0], [2, 1, -4]]
        expect(submission.ray_box, (starts, ways, HALF), ([1.5, INFINITY, 0], [2.5, -INFINITY, 0.25]))
        expect(submission.ray_box, ([-3, 1, 2], [2, 0, 0], [HALF, [1, 0.5, 3]]), ([1, INFINITY], [2, -INFINITY]))


A, B = CORNER.tolist(), place(6, 0, 0).round(9).tolist()
"""The ends of a capsule, (1, −2, 3) and (5, 0, 7). In its own axes it lies along x, from 0 to 6."""


def ray_to(spot, along, time):
    """A ray that is at a spot of the capsule's own axes after a time."""
    spot, along = np.asarray(spot, dtype=float), np.asarray(along, dtype=float)
    return place(*(spot - time * along)), way(*along)


@asks(
    "ray_capsule", 6, "The first of three times: at the side, between the ends, and at the two balls around the ends.",
    "Look along the segment: what do you see of the capsule, and of the ray? What do you have to ask afterwards? And"
    " what is around each of the ends?",
)  # fmt: skip
def test_a_ray_meets_the_side_of_a_capsule_or_one_of_its_ends(submission, part):
    with part(1, "at the side, from all around, near either end and in the middle"):
        expect(submission.ray_capsule, ([1, 5, 0], [0, -2, 0], REST, [4, 0, 0], 1.0), 2.0)
        for spot, along in (
            ([3, 0.75, 1], [0.5, -1, -0.5]), ([0.25, -1, 0.75], [-1, 2, -0.5]), ([5.75, -0.75, -1], [2, 1, 0]),
            ([1, 1.25, 0], [0, -1, 3]),
        ):  # fmt: skip
            for time in (0.5, 2):
                expect(submission.ray_capsule, (*ray_to(spot, along, time), A, B, 1.25), time)
                expect(submission.ray_capsule, (*ray_to(spot, along, time), B, A, 1.25), time)
    with part(1, "at the balls around the ends, slanted and along the segment"):
        expect(submission.ray_capsule, ([-5, 0, 0], [2, 0, 0], REST, [4, 0, 0], 1.0), 2.0)
        for spot, along in (
            ([7, 2, 2], [-1, -1, 0]), ([8, -1, 2], [-2, 1.5, 1]), ([-1, 2, -2], [1.5, -3, 0.5]),
            ([-2, -2, 1], [1, 1, 0]), ([9, 0, 0], [-2, 0, 0]), ([-3, 0, 0], [4, 0, 0]),
            ([8, -2, 1], [-0.5, 0, 0]), ([-2, 1, 2], [1, 0, 0]),
        ):  # fmt: skip
            for time in (0.5, 2):
                expect(submission.ray_capsule, (*ray_to(spot, along, time), A, B, 3.0), time)
        for spot, along in (([6.75, 1, 0], [1, -1, 0]), ([-0.75, 1, 0], [-1, -1, 0])):  # it starts nearer the other end
            expect(submission.ray_capsule, (*ray_to(spot, along, 4), A, B, 1.25), 4.0)
    with part(1, "past the side, past the ends, and away from it"):
        for spot, along in (
            ([3, 1.5, 0], [0.5, 0, 1]), ([7.375, 1, 0], [0, -1, 0]), ([7, -1, 0.75], [0.25, 1, 0]),
            ([-1, 1, 0], [-1, -1, 0.5]), ([-2, 0, 0], [0, 1, -1]), ([2, 0, -1.5], [1, 0, 0]),
        ):  # fmt: skip
            expect(submission.ray_capsule, (*ray_to(spot, along, 4), A, B, 1.25), INFINITY)
        for spot, along in (([3, 1.5, 0], [0, 1, 0]), ([8, 0, 0], [1, 0, 0]), ([-2, 1, 1], [-1, 1, 2])):
            expect(submission.ray_capsule, (*ray_to(spot, along, 0), A, B, 1.25), INFINITY)
    with part(1, "from within and from the surface, whichever way; without a direction"):
        for spot in ([3, 0.5, 1], [6.5, 0.5, 0], [-0.75, 0, 0.75], [2, 0, 0]):
            for along in ([3, 1, -1], [0, -1, 2], [-1, 0, 0], REST):
                expect(submission.ray_capsule, (*ray_to(spot, along, 0), A, B, 1.25), 0.0)
        for u in ([0, 0, 1], [1, 2, 0], REST):
            expect(submission.ray_capsule, ([2, 3, 0], u, [-1, 1, 0], [4, 1, 0], 2.0), 0.0)
        expect(submission.ray_capsule, (place(3, 2, 0), REST, A, B, 1.25), INFINITY)
    with part(1, "both ends at one point; the bare segment"):
        expect(submission.ray_capsule, ([6, 2, 5], [-2, -1, 0], A, A, 3.0), 2.0)
        expect(submission.ray_capsule, ([6, 2, 5], [2, 1, 0], A, A, 3.0), INFINITY)
        expect(submission.ray_capsule, ([-4, 1, 0], [2, 0, 0], [1, -2, 0], [1, 3, 0], 0.0), 2.5)
        expect(submission.ray_capsule, ([-4, 4, 0], [2, 0, 0], [1, -2, 0], [1, 3, 0], 0.0), INFINITY)
    with part(1, "several in one call"):
        rays = [ray_to([3, 0.75, 1], [0.5, -1, -0.5], 2), ray_to([2, 0, -1.5], [1, 0, 0], 4)]
        starts, ways = np.stack(rays, axis=1)
        expect(submission.ray_capsule, (starts, ways, A, B, 1.25), [2.0, INFINITY])
        expect(submission.ray_capsule, (*rays[0], [A, B], [B, B], 1.25), [2.0, INFINITY])


N, M = TURN[:, 0].tolist(), TURN[:, 1].tolist()
"""Two unit vectors at right angles, (2, 1, 2)/3 and (1, 2, −2)/3."""


@asks(
    "motion_bound", 4, "The velocity along the normal, and at most the turning across it at the farthest point.",
    "A point at r moves with v + ω × r. Which part of this is along n? How large can it become while r turns, if its"
    " length stays?",
)  # fmt: skip
def test_no_point_moves_faster_along_a_direction_than_the_bound(submission, part):
    with part(1, "without turning, forwards, backwards and sideways"):
        expect(submission.motion_bound, ([1, 2, 3], REST, 1.5, [0, 0, 1]), 3.0)
        expect(submission.motion_bound, ([4, 2, 1], REST, 1.5, N), 4.0)
        expect(submission.motion_bound, ([-2, -3, 0.5], REST, 1.5, N), -2.0)
        expect(submission.motion_bound, ([1, 2, -2], REST, 1.5, N), 0.0)
        expect(submission.motion_bound, ([4, 2, 1], REST, 1.5, M), 2.0)
    with part(1, "turning across the direction, along it, and both"):
        expect(submission.motion_bound, (REST, [2, 0, 0], 1.5, [0, 0, 1]), 3.0)
        expect(submission.motion_bound, (REST, way(0, 3, 0), 2.0, N), 6.0)
        expect(submission.motion_bound, (REST, way(0, 3, -4), 2.0, N), 10.0)
        expect(submission.motion_bound, (REST, way(7, 0, 0), 2.0, N), 0.0)
        expect(submission.motion_bound, (REST, way(6, -4, 3), 0.5, N), 2.5)
        expect(submission.motion_bound, (REST, way(4, 6, 3), 0.5, M), 2.5)
    with part(1, "flying and turning; backwards, faster than it turns; a point"):
        expect(submission.motion_bound, ([4, 2, 1], way(6, -4, 3), 0.5, N), 6.5)
        expect(submission.motion_bound, ([4, 2, 1], way(6, -4, 3), 0.5, way(-1, 0, 0)), -1.5)
        expect(submission.motion_bound, ([-2, -3, 0.5], way(5, 0, -2), 0.5, N), -1.0)
        expect(submission.motion_bound, ([4, 2, 1], way(6, -4, 3), 0.0, N), 4.0)
        expect(submission.motion_bound, ([1, -2, 3], [3, 5, 4], 2.0, [0, 0, 1]), 3 + 2 * math.sqrt(34))
    with part(1, "several in one call"):
        expect(submission.motion_bound, ([[4, 2, 1], REST], way(6, -4, 3), 0.5, N), [6.5, 2.5])
        expect(submission.motion_bound, ([4, 2, 1], [way(0, 3, 0), REST], [2.0, 1.0], [N, M]), [10.0, 2.0])


GROUND = np.array([[x, 0.0, z] for x in (-9, 9) for z in (-9, 9)])
PLATE = CORNER + GROUND @ TURN.T
"""The same square, turned: in its own axes y is the height above it."""
TRIPOD = np.array([way(0.5, -1, 0.25), way(-1, 0.5, 0.5), way(1, 1, -2), way(0, 0.75, 1)])
"""Its foot is 1 m below the point about which it turns."""
UNTURNED_ARM = np.array([REST, [2, 0, 0], [1, 0.5, 0]])
ARM = UNTURNED_ARM @ TURN.T
"""It reaches 2 m to the side of the point about which it turns."""


@asks(
    "advance", 5, "Nothing happens before the separation is used up at the fastest approach: look again then.",
    "Slide 10, bodies that turn. How far apart are the hulls now, and along which direction? How fast can they come"
    " nearer at most along it? How long are they surely apart, and when do you look next?",
)  # fmt: skip
def test_the_next_look_comes_when_the_separation_may_be_used_up(submission, part):
    with part(1, "it flies without turning: down onto a plate, along it, and away from it"):
        expect(submission.advance, (UNTURNED_ARM, [0, 3, 0], [1, -2, 0], REST, GROUND, 5.0, 0.01, 12), (1.5, 2))
        for velocity, dt, found in (
            (way(1, -2, 0.5), 5.0, (1.5, 2)), (way(-1, -0.75, 0), 5.0, (4, 2)), (way(1, -2, 0.5), 1.25, (INFINITY, 1)),
            (way(2, 0, 1), 5.0, (INFINITY, 1)), (way(2, 0.5, 1), 5.0, (INFINITY, 1)), (REST, 5.0, (INFINITY, 1)),
        ):  # fmt: skip
            expect(submission.advance, (TRIPOD, place(1, 4, -1), velocity, REST, PLATE, dt, 0.01, 12), found)
        expect(submission.advance, ([[1, 0, 0]], [0, 2, 0], [0, -1, 0], REST, [[1, 0, 0]], 2.0, 0.25, 12), (2, 2))
    with part(1, "it turns: onto the plate, about the plate's normal, and away from it"):
        # The end of the arm is 1 − 2 sin t above the plate, and moves at 2 m/s at most: looks at 0, 1/2, 1 − sin(1/2).
        unturned = (UNTURNED_ARM, [0, 1, 0], REST, [0, 0, -1], GROUND, 5.0, 0.01, 12)
        expect(submission.advance, unturned, (1 - math.sin(0.5), 3))
        arm, down = (ARM, place(1, 1, 2), REST), way(0, 0, -1)
        expect(submission.advance, (*arm, down, PLATE, 5.0, 0.01, 12), (1 - math.sin(0.5), 3))
        expect(submission.advance, (*arm, down, PLATE, 0.51, 0.01, 12), (INFINITY, 2))
        expect(submission.advance, (*arm, 2 * down, PLATE, 5.0, 0.05, 12), (0.25, 2))
        expect(submission.advance, (*arm, way(0, 3, 0), PLATE, 5.0, 0.01, 12), (INFINITY, 1))
        # The end rises, and the point about which it turns stays 1 m above the plate: looks at 0, 1/2, 1, 3/2.
        expect(submission.advance, (*arm, -down, PLATE, 1.25, 0.01, 12), (INFINITY, 3))
        expect(submission.advance, (*arm, -down, PLATE, 1.75, 0.01, 12), (INFINITY, 4))
    with part(1, "it flies and turns"):
        # The end is 4 − t − 2 sin t above the plate: 4 m now, 0.723 m at 4/3, 0.426 m at 1.574, and 0.305 m at 1.716.
        high = (ARM, place(0, 4, 1), way(1, -1, 0.5), way(0, 0, -1), PLATE, 5.0)
        expect(submission.advance, (*high, 0.5, 12), (1.5742636, 3))
        expect(submission.advance, (*high, 0.4, 12), (1.7161798, 4))
    with part(1, "hulls that touch or overlap now; just enough looks, and too few"):
        expect(submission.advance, ([REST], [0, 5, 0], [0, -1, 0], REST, [REST], 2.0, 0.1, 1), (INFINITY, 1))
        expect(submission.advance, (ARM, place(1, 1, 2), REST, way(0, 0, -1), PLATE, 0.51, 0.01, 2), (INFINITY, 2))
        spins, turns = way(0, 3, 0), way(1, 2, 3)
        expect(submission.advance, (TRIPOD, place(1, 0.5, -1), spins, turns, PLATE, 5.0, 0.01, 12), (0, 1))
        expect(submission.advance, (TRIPOD, place(1, 1.2, -1), spins, turns, PLATE, 5.0, 0.25, 1), (0, 1))
        expect(submission.advance, (ARM, place(1, 1, 2), REST, way(0, 0, -1), PLATE, 5.0, 0.01, 2), (math.nan, 2))
        enough = (ARM, place(1, 1, 2), REST, way(0, 0, -1), PLATE, 5.0, 0.01, 3)
        expect(submission.advance, enough, (1 - math.sin(0.5), 3))
    with part(1, "past a point, a step of no length, and exactly the tolerance"):
        # A point flies past a point: as seen along the first direction it arrives when it has long passed.
        past = ([REST], place(-3, 0, 1), way(2, 0, 0), REST, [CORNER])
        expect(submission.advance, (*past, 9.0, 0.01, 12), (INFINITY, 2))
        expect(submission.advance, (*past, 0.0, 0.01, 12), (INFINITY, 1))
        expect(submission.advance, ([REST], [0, 2.25, 0], [0, -1, 0], REST, [[0, 2, 0]], 1.0, 0.25, 12), (0, 1))


@asks("sweep_sphere_sphere", 1, "Two fast balls that meet are turned aside, at the instant at which they touch.")
def test_two_fast_balls_do_not_pass_through_each_other(submission, part):
    code = with_solutions(submission, "sweeping")
    with part(1, "two marbles at 40 m/s"):
        compared_with_theory(code, "passing-balls", ("v=40",), ("passed", "exchanged"))
