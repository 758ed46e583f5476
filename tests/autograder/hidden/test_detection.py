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


@asks("is_colliding", 3, "Behind by more than the tolerance collides, anything else does not.")
def test_touching_is_not_colliding(submission, part, examples):
    def separations(draw):
        return draw.number(-1, 1), draw.number(0.05, 0.6)

    with part(1, "any separation and tolerance"):
        examples.agree(submission.is_colliding, lambda s, tolerance: s < -tolerance, separations, count=40)
    with part(1, "exactly at the limit"):
        for separation, tolerance in ((0.0, 0.0), (-0.5, 0.5), (0.5, 0.5), (0.0, 0.5)):
            expect(submission.is_colliding, (separation, tolerance), False)
        expect(submission.is_colliding, (-1e-9, 0.0), True)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.is_colliding, lambda s, tolerance: s < -tolerance, separations)


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


@asks("substeps_needed", 4, "With so many parts no ball passes unseen; with one part fewer it may.")
def test_one_part_fewer_would_let_the_ball_pass(submission, part, examples):
    def parts(v, w, r, dt):
        count = 1
        while v * dt / count >= w + 2 * r:
            count += 1
        return count

    def away_from_a_whole_number(draw):  # of walls, where rounding would decide
        _, w, r, dt = walls(draw)
        return (draw.rng.integers(6) + draw.number(0.1, 0.9)) * (w + 2 * r) / dt, w, r, dt

    with part(2, "any wall"):
        examples.agree(submission.substeps_needed, parts, away_from_a_whole_number, count=20)
    with part(1, "no motion, a point, a sheet, a way that just fits"):
        for wall in (
            (0.0, 0.5, 0.25, 0.125), (4.0, 0.5, 0.25, 0.0), (8.0, 0.5, 0.25, 0.125), (24.0, 0.5, 0.25, 0.125),
            (20.0, 0.5, 0.0, 0.125), (20.0, 0.0, 0.25, 0.125), (4.0, 0.5, 0.25, 0.125),
        ):  # fmt: skip
            expect(submission.substeps_needed, wall, parts(*wall))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.substeps_needed, parts, away_from_a_whole_number)
