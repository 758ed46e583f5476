"""Detecting a collision: drawn examples against closed forms, limiting cases, and many at once."""

from __future__ import annotations

import math

import numpy as np

from labs.grading.judging.comparison import expect
from labs.grading.judging.markers import asks

UP = [0.0, 0.0, 1.0]
INFINITY = math.inf


@asks("signed_distance", 4, "The foot of the perpendicular is a point of the plane.")
def test_the_distance_leads_to_the_foot_of_the_perpendicular(submission, part, examples):
    def distance(point, normal, offset):
        return (normal @ point + offset) / math.hypot(*normal)

    def planes(draw):
        return draw.vector(), draw.vector(3), draw.number(-5, 5)

    with part(2, "any point and any plane"):
        examples.agree(submission.signed_distance, distance, planes)
    with part(1, "points on the plane"):
        expect(submission.signed_distance, ([7, -3, 2], [0, 0, 4], -8.0), 0.0)
        expect(submission.signed_distance, ([0, 0, 0], [1, 2, 2], 0.0), 0.0)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.signed_distance, distance, planes)


@asks("side_of_plane", 3, "Up to and with the tolerance, on either side, a point is on the plane.")
def test_a_point_within_the_tolerance_is_on_the_plane(submission, part, examples):
    def side(s, tolerance):
        return 0 if abs(s) <= tolerance else math.copysign(1, s)

    def separations(draw):
        return draw.number(-1, 1), draw.number(0.05, 0.6)

    with part(1, "any separation and tolerance"):
        examples.agree(submission.side_of_plane, side, separations, count=40)
    with part(1, "exactly at the limit"):
        for separation, tolerance in ((0.5, 0.5), (-0.5, 0.5), (0.0, 0.5), (0.0, 0.0)):
            expect(submission.side_of_plane, (separation, tolerance), 0)
        expect(submission.side_of_plane, (1e-9, 0.0), 1)
        expect(submission.side_of_plane, (-1e-9, 0.0), -1)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.side_of_plane, side, separations)


@asks("time_of_impact_interpolated", 4, "T divides the step as the two separations divide the way.")
def test_t_divides_the_step_as_the_separations_divide_the_way(submission, part, examples):
    def crossing(s0, s1, t, dt):
        return t + dt * s0 / (s0 - s1) if s0 >= 0 > s1 else INFINITY

    def steps(draw):
        return draw.number(0.1, 2), draw.number(-3, 0.2), draw.number(0.5, 5), draw.number(0.1, 1)

    with part(2, "any step"):
        examples.agree(submission.time_of_impact_interpolated, crossing, steps)
    with part(1, "steps that start or end on the plane, or behind it"):
        expect(submission.time_of_impact_interpolated, (0.0, -2.0, 3.0, 0.25), 3.0)
        expect(submission.time_of_impact_interpolated, (1.0, -1.0, 3.0, 0.0), 3.0)
        for s0, s1 in (
            (0.0, 2.0),
            (2.0, 0.0),
            (0.0, 0.0),
            (2.0, 2.0),
            (2.0, 3.0),
            (-1.0, -3.0),
            (-3.0, -1.0),
            (-1.0, 2.0),
        ):
            expect(submission.time_of_impact_interpolated, (s0, s1, 3.0, 0.25), INFINITY)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.time_of_impact_interpolated, crossing, steps)


@asks("count_impacts", 4, "Mirrored at the walls, the puck's way is straight: it passes a wall at each length.")
def test_the_impacts_are_the_walls_that_a_straight_way_passes(submission, part, examples):
    def images(x, v, length, dt, duration):
        """The walls between, and the place in the strip, after a straight way through its mirror images."""
        end = x + v * duration
        place = end % (2 * length)
        passed = math.floor(end / length) - math.floor(x / length)
        return abs(passed), min(place, 2 * length - place)

    def away_from_a_wall(draw, speed, dt):  # in the end, where rounding would decide
        length, sign = draw.number(0.5, 2.5), draw.sign()
        x, steps = draw.number(0.1, 0.9) * length, int(draw.rng.integers(1, 12))
        way = (math.floor(speed * steps * dt / length) + draw.number(0.1, 0.9)) * length
        return x, sign * (way - x if sign > 0 else way - length + x) / (steps * dt), length, dt, steps * dt

    def slow(draw):
        return away_from_a_wall(draw, draw.number(1, 3), draw.number(0.05, 0.2))

    def fast(draw):
        return away_from_a_wall(draw, draw.number(20, 50), draw.number(0.2, 0.5))

    with part(1, "any puck"):
        examples.agree(submission.count_impacts, images, slow)
    with part(1, "several impacts in a step"):
        examples.agree(submission.count_impacts, images, fast)
    with part(1, "from a wall, into it and away from it, and at rest"):
        for motion, answer in (
            ((0.0, -0.75, 2.0, 0.5, 2.0), (1, 1.5)),
            ((0.0, 0.75, 2.0, 0.5, 2.0), (0, 1.5)),
            ((2.0, -0.75, 2.0, 0.5, 2.0), (0, 0.5)),
            ((2.0, 2.25, 2.0, 0.5, 2.0), (3, 1.5)),
            ((0.0, 0.0, 2.0, 0.5, 2.0), (0, 0.0)),
            ((0.75, 0.0, 2.0, 0.5, 2.0), (0, 0.75)),
        ):
            expect(submission.count_impacts, motion, answer)
    with part(1, "steps and ways that end on a wall, and no step"):
        for motion, answer in (
            ((0.0, 3.0, 1.5, 0.5, 2.0), (4, 0.0)),
            ((1.5, -3.0, 1.5, 1.0, 2.0), (4, 1.5)),
            ((0.5, 1.0, 1.5, 1.0, 1.0), (1, 1.5)),
            ((0.5, 2.0, 1.5, 1.0, 0.0), (0, 0.5)),
            ((0.5, 2.0, 1.0, 0.1, 0.3), (1, 0.9)),
            ((0.25, 2.0, 1.0, 0.1, 1.0), (2, 0.25)),
        ):
            expect(submission.count_impacts, motion, answer)


@asks("time_of_impact_exact", 7, "At the time of impact the separation is zero, and falling.")
def test_at_the_time_of_impact_the_separation_is_zero_and_falling(submission, part, examples):
    def root(s, u, a):
        roots = np.roots([a / 2, u, s])
        on_the_way_down = [float(t.real) for t in roots if not t.imag and t.real >= 0 and u + a * t.real < 0]
        return min(on_the_way_down, default=INFINITY)

    def throws(draw):
        return draw.number(0.2, 3), draw.number(-5, 5), draw.number(-10, 1.5)

    with part(2, "any throw"):
        examples.agree(submission.time_of_impact_exact, root, throws, count=20)
    for situation, motions in (
        ("on the plane", (((0.0, 4.0, -8.0), 1.0), ((0.0, -4.0, -8.0), 0.0), ((0.0, 0.0, -8.0), 0.0))),
        ("just behind the plane", (((-0.25, 4.0, -8.0), 1.0), ((-0.25, -4.0, -8.0), 0.0))),
        (
            "without gravity",
            (
                ((0.0, 4.0, 0.0), INFINITY), ((4.0, 0.0, 0.0), INFINITY), ((4.0, -2.0, 0.0), 2.0),
                ((4.0, 2.0, 0.0), INFINITY),
            ),
        ),
        ("pulled away", (((4.0, -1.0, 1.0), INFINITY), ((3.0, -4.0, 2.0), 1.0), ((4.0, 0.0, 2.0), INFINITY))),
    ):  # fmt: skip
        with part(1, situation):
            for motion, time in motions:
                expect(submission.time_of_impact_exact, motion, time)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.time_of_impact_exact, root, throws)


@asks("overlap_interval", 4, "The interval holds just the instants at which the ball overlaps the wall.")
def test_the_ball_overlaps_the_wall_in_the_interval_and_at_no_other_time(submission, part, examples):
    def interval(x, u, r, w, dt):
        if u == 0:
            return (0.0, dt) if -(w + r) <= x <= r else (INFINITY, -INFINITY)
        start, end = sorted(((r - x) / u, (-(w + r) - x) / u))
        start, end = max(start, 0.0), min(end, dt)
        return (start, end) if start <= end else (INFINITY, -INFINITY)

    def flights(draw):
        return (
            draw.number(-2, 2), draw.number(1, 9) * draw.sign(), draw.number(0.05, 0.5), draw.number(0.05, 0.6),
            draw.number(0.2, 1),
        )  # fmt: skip

    with part(2, "any flight"):
        examples.agree(submission.overlap_interval, interval, flights, count=30)
    with part(1, "along the wall, a point, a sheet, a half-space, touching"):
        for flight in (
            (3.0, 0.0, 0.5, 1.0, 2.0), (-0.25, 0.0, 0.5, 1.0, 2.0), (-4.0, 0.0, 0.5, 1.0, 2.0),
            (0.5, 0.0, 0.5, 1.0, 2.0),
            (-1.5, 0.0, 0.5, 1.0, 2.0), (2.0, -4.0, 0.0, 1.0, 2.0), (2.0, -4.0, 0.0, 0.0, 2.0),
            (2.0, -4.0, 0.5, 0.0, 2.0),
            (2.0, -1.0, 0.5, INFINITY, 4.0), (0.5, 1.0, 0.5, 1.0, 2.0), (2.5, -1.0, 0.5, 1.0, 2.0),
            (0.0, -1.0, 0.5, 1.0, 0.0),
            (-1.5, -1.0, 0.5, 1.0, 2.0), (9.0, -1.0, 0.5, 1.0, 2.0), (1.0, 2.0, 0.5, 1.0, 2.0),
            (-4.0, 4.0, 0.5, 1.0, 2.0),
        ):  # fmt: skip
            expect(submission.overlap_interval, flight, interval(*flight))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.overlap_interval, interval, flights)


def walls(draw):
    """Speed, thickness of the wall, radius and step, where some balls are missed and some are not."""
    return draw.number(5, 60), draw.number(0.02, 0.4), draw.number(0.02, 0.2), draw.number(0.01, 0.06)


@asks("missing_probability", 4, "Of all the places at which the first test may find the ball, some lead past the wall.")
def test_the_share_that_is_missed_is_the_way_that_no_test_sees(submission, part, examples):
    def share(v, w, r, dt):
        way, seen = v * dt, w + 2 * r
        return (way - seen) / way if way > seen else 0.0

    with part(2, "any wall"):
        examples.agree(submission.missing_probability, share, walls, count=20)
    with part(1, "no motion, a point, a sheet, a way that just fits"):
        for wall in (
            (0.0, 0.5, 0.25, 0.125), (4.0, 0.5, 0.25, 0.0), (4.0, 0.0, 0.0, 0.125), (0.0, 0.0, 0.0, 0.125),
            (8.0, 0.5, 0.25, 0.125), (16.0, 0.5, 0.0, 0.125), (16.0, 0.0, 0.25, 0.125),
        ):  # fmt: skip
            expect(submission.missing_probability, wall, share(*wall))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.missing_probability, share, walls)
