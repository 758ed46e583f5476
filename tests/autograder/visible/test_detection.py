"""Detecting a collision (slides 2, 4, 5 and 9): examples that a student sees."""

from __future__ import annotations

import math

from labs.grading.calling.scenario_runs import compared_with_theory, with_solutions
from labs.grading.judging.comparison import expect
from labs.grading.judging.markers import asks

UP = [0.0, 0.0, 1.0]
INFINITY = math.inf


@asks(
    "signed_distance", 3, "A distance says how far a point is from a plane, and its sign on which side.",
    "Slide 4: a x + b y + c z + d. When is that a distance in metres?",
)  # fmt: skip
def test_a_point_has_a_distance_from_a_plane_with_a_sign(submission, part):
    with part(1, "above and below a floor"):
        expect(submission.signed_distance, ([3, 1, 2], UP, 0.0), 2.0)
        expect(submission.signed_distance, ([3, 1, -0.5], UP, 0.0), -0.5)
        expect(submission.signed_distance, ([0, 0, 3], UP, -1.0), 2.0)  # the plane z = 1
    with part(1, "a normal that is longer than 1"):
        expect(submission.signed_distance, ([0, 0, 3], [0, 0, 2], -4.0), 1.0)  # 2 z − 4 = 0 is the plane z = 2
        expect(submission.signed_distance, ([-3, 1, 2], [-1, 2, 2], -3.0), 2.0)  # a plane along no axis: (9 − 3)/3
    with part(1, "two points in one call, and two planes"):
        expect(submission.signed_distance, ([[0, 0, 1], [0, 0, -2]], UP, 0.0), [1.0, -2.0])
        expect(submission.signed_distance, ([[0, 0, 1], [5, 0, 0]], [[0, 0, 2], [3, 0, 4]], 0.0), [1.0, 3.0])


@asks(
    "side_of_plane", 3, "A point is in front, behind, or on the plane: three answers, 1, −1 and 0.",
    "Slide 4 knows two sides. What should come out of a point that touches, except for rounding?",
)  # fmt: skip
def test_a_point_is_in_front_behind_or_on_the_plane(submission, part):
    with part(1, "without a tolerance"):
        expect(submission.side_of_plane, (2.0,), 1)
        expect(submission.side_of_plane, (-2.0,), -1)
        expect(submission.side_of_plane, (0.0,), 0)
        expect(submission.side_of_plane, (0.001,), 1)
        expect(submission.side_of_plane, (-0.001,), -1)
    with part(1, "with a tolerance, in front of the plane and behind it"):
        expect(submission.side_of_plane, (0.5, 0.375), 1)
        expect(submission.side_of_plane, (-0.5, 0.375), -1)
        expect(submission.side_of_plane, (0.125, 0.25), 0)
        expect(submission.side_of_plane, (-0.125, 0.25), 0)
        expect(submission.side_of_plane, (0.25, 0.25), 0)
        expect(submission.side_of_plane, (-0.25, 0.25), 0)
    with part(1, "several in one call"):
        expect(submission.side_of_plane, ([-2.0, -0.25, 0.125, 2.0], 0.25), [-1, 0, 0, 1])
        expect(submission.side_of_plane, ([-0.25, -0.251, 0.25, 0.251], 0.25), [0, -1, 0, 1])


@asks(
    "time_of_impact_interpolated", 3, "Between two samples of opposite sign the separation is zero somewhere.",
    "Slide 5. Draw the separation over the step as a straight line; d2 on the slide is a magnitude.",
)  # fmt: skip
def test_the_separation_is_zero_where_a_straight_line_crosses_it(submission, part):
    with part(1, "half way, a quarter of the way, and from the plane on"):
        expect(submission.time_of_impact_interpolated, (1.0, -1.0, 0.0, 2.0), 1.0)
        expect(submission.time_of_impact_interpolated, (1.0, -3.0, -5.0, 0.5), -4.875)
        expect(submission.time_of_impact_interpolated, (2.0, -1.0, 0.0, 3.0), 2.0)
        expect(submission.time_of_impact_interpolated, (0.0, -1.0, 4.0, 0.5), 4.0)
    with part(1, "no impact in this step"):
        expect(submission.time_of_impact_interpolated, (2.0, 1.0, 0.0, 0.5), INFINITY)
        expect(submission.time_of_impact_interpolated, (-1.0, 2.0, 0.0, 0.5), INFINITY)
        expect(submission.time_of_impact_interpolated, (-1.0, -2.0, 0.0, 0.5), INFINITY)  # behind it all the time
        expect(submission.time_of_impact_interpolated, (1.0, 0.0, 0.0, 0.5), INFINITY)  # not behind it yet
    with part(1, "several in one call, one of them without an impact"):
        expect(submission.time_of_impact_interpolated, ([1.0, 2.0], [-1.0, 1.0], 0.0, 2.0), [1.0, INFINITY])


@asks(
    "count_impacts", 5, "After an impact the puck goes the rest of the step with its new velocity, perhaps to another.",
    "Slide 3: back up time. When the puck stands on the wall, how much of the step is left? And where does it go then?",
)  # fmt: skip
def test_a_puck_between_two_walls_loses_no_time(submission, part):
    with part(1, "from inside towards either wall, at most one impact in a step"):
        expect(submission.count_impacts, (0.25, 0.5, 1.0, 0.25, 1.25), (0, 0.875))
        expect(submission.count_impacts, (0.25, 2.0, 1.0, 0.25, 0.5), (1, 0.75))  # it turns round after 0.375 s
        expect(submission.count_impacts, (0.25, -1.5, 1.0, 0.25, 0.5), (1, 0.5))
        expect(submission.count_impacts, (0.75, 1.5, 1.0, 0.25, 1.75), (3, 0.625))
    with part(1, "walls that are not 1 m apart"):
        expect(submission.count_impacts, (0.75, 2.0, 2.5, 0.375, 2.25), (2, 0.25))
        expect(submission.count_impacts, (0.25, -1.0, 0.5, 0.125, 1.0), (2, 0.25))
    with part(1, "several impacts in one step"):
        expect(submission.count_impacts, (0.25, 6.0, 1.0, 0.5, 0.5), (3, 0.75))
        expect(submission.count_impacts, (0.5, -7.0, 2.0, 1.5, 4.5), (16, 1.0))
    with part(1, "the same way in coarse and in fine steps"):
        expect(submission.count_impacts, (0.25, 3.0, 1.0, 1.5, 1.5), (4, 0.75))
        expect(submission.count_impacts, (0.25, 3.0, 1.0, 0.75, 1.5), (4, 0.75))
        expect(submission.count_impacts, (0.25, 3.0, 1.0, 0.015625, 1.5), (4, 0.75))
        expect(submission.count_impacts, (0.25, 3.0, 1.0, 0.1, 1.0), (3, 0.75))
        expect(submission.count_impacts, (0.25, 3.0, 1.0, 0.1, 0.3), (1, 0.85))  # three steps, not two
    with part(1, "on a wall at the start or at the end, at rest, and for no time"):
        expect(submission.count_impacts, (0.0, 0.5, 1.0, 0.5, 1.5), (0, 0.75))
        expect(submission.count_impacts, (1.0, 0.5, 1.0, 0.5, 1.5), (1, 0.25))
        expect(submission.count_impacts, (0.5, 1.0, 1.0, 0.25, 1.5), (2, 0.0))  # it arrives with the last step
        expect(submission.count_impacts, (1.0, 0.0, 1.0, 0.25, 1.5), (0, 1.0))
        expect(submission.count_impacts, (0.25, 2.0, 1.0, 0.25, 0.0), (0, 0.25))


@asks(
    "time_of_impact_exact", 6, "Under gravity the way is a parabola, and its root is the time of impact.",
    "s + u t + a t²/2 = 0. Which root is the one on the way down? Where does it subtract nearly equal numbers?",
)  # fmt: skip
def test_a_falling_body_meets_the_plane_at_the_root_of_its_parabola(submission, part):
    with part(1, "let fall, thrown down, thrown up"):
        expect(submission.time_of_impact_exact, (5.0, 0.0, -10.0), 1.0)
        expect(submission.time_of_impact_exact, (15.0, -10.0, -10.0), 1.0)
        expect(submission.time_of_impact_exact, (15.0, 10.0, -10.0), 3.0)
        expect(submission.time_of_impact_exact, (0.0, 5.0, -10.0), 1.0)
    with part(1, "all but on the plane"):
        expect(submission.time_of_impact_exact, (1e-15, -5.0, -10.0), 2e-16)  # no nearly equal numbers to subtract
        expect(submission.time_of_impact_exact, (1e-15, 5.0, -10.0), 1.0)
    with part(1, "behind the plane by rounding"):
        expect(submission.time_of_impact_exact, (-1e-12, 0.0, -10.0), 0.0)
        expect(submission.time_of_impact_exact, (-1e-12, -5.0, -10.0), 0.0)
    with part(1, "without gravity, towards the plane and away"):
        expect(submission.time_of_impact_exact, (3.0, -1.5, 0.0), 2.0)
        expect(submission.time_of_impact_exact, (3.0, 1.5, 0.0), INFINITY)
    with part(1, "pulled away, so that it turns round before"):
        expect(submission.time_of_impact_exact, (1.0, -1.0, 5.0), INFINITY)
        expect(submission.time_of_impact_exact, (1.0, 1.0, 0.125), INFINITY)
    with part(1, "several in one call"):
        expect(submission.time_of_impact_exact, ([5.0, 15.0], [0.0, 10.0], -10.0), [1.0, 3.0])


@asks(
    "overlap_interval", 5, "A ball that flies through a wall overlaps it from its front face to behind its back.",
    "Slide 2. Where is the ball's centre when it touches the front, and where when it leaves the back?",
)  # fmt: skip
def test_a_ball_overlaps_a_wall_from_touching_its_front_to_leaving_its_back(submission, part):
    with part(1, "through the wall within the step, from either side"):
        expect(submission.overlap_interval, (2.0, -4.0, 0.5, 1.0, 2.0), (0.375, 0.875))
        expect(submission.overlap_interval, (-3.5, 4.0, 0.5, 1.0, 2.0), (0.5, 1.0))  # from behind
        expect(submission.overlap_interval, (2.5, -4.0, 0.5, 2.0, 2.0), (0.5, 1.25))  # through a thicker wall
    with part(1, "touching the wall at the end of the step"):
        expect(submission.overlap_interval, (0.75, -0.5, 0.25, 1.0, 1.0), (1.0, 1.0))
    with part(1, "inside already, and still inside at the end or on its way out"):
        expect(submission.overlap_interval, (0.0, -1.0, 0.5, 2.0, 1.0), (0.0, 1.0))
        expect(submission.overlap_interval, (0.0, 1.0, 0.5, 2.0, 1.0), (0.0, 0.5))
        expect(submission.overlap_interval, (-2.25, 0.0, 0.5, 2.0, 1.0), (0.0, 1.0))  # most of it behind the wall
    with part(1, "at rest on the wall's face, and on its back"):
        expect(submission.overlap_interval, (0.25, 0.0, 0.25, 1.0, 0.5), (0.0, 0.5))
        expect(submission.overlap_interval, (-2.5, 0.0, 0.5, 2.0, 3.0), (0.0, 3.0))
    with part(1, "no overlap, at rest and beside one, in one call"):
        expect(submission.overlap_interval, (2.0, 0.0, 0.5, 1.0, 2.0), (INFINITY, -INFINITY))
        expect(submission.overlap_interval, (-3.0, 0.0, 0.5, 2.0, 1.0), (INFINITY, -INFINITY))  # behind the wall
        expect(
            submission.overlap_interval, ([2.0, 2.0], [-4.0, 4.0], 0.5, 1.0, 2.0), ([0.375, INFINITY],
            [0.875, -INFINITY])
        )  # fmt: skip


@asks(
    "missing_probability", 2, "A ball is missed when it crosses the wall between two tests.",
    "Slide 9. On which way does it overlap the wall, and which way does it go between two tests?",
)  # fmt: skip
def test_a_fast_ball_is_missed_by_the_share_of_its_way_that_no_test_sees(submission, part):
    with part(1, "half of the balls, none, and none at rest"):
        expect(submission.missing_probability, (64.0, 0.125, 0.0625, 0.0078125), 0.5)
        expect(submission.missing_probability, (1.0, 0.125, 0.0625, 0.0078125), 0.0)
        expect(submission.missing_probability, (0.0, 0.125, 0.0625, 0.0078125), 0.0)
    with part(1, "several in one call"):
        expect(submission.missing_probability, ([64.0, 128.0], 0.125, 0.0625, 0.0078125), [0.5, 0.75])


@asks("time_of_impact_exact", 2, "A ball bounces at the instant at which it meets the floor, not a step later.")
def test_a_falling_ball_turns_round_on_the_floor(submission, part):
    code = with_solutions(submission, "detection")
    with part(1, "how high it rises"):
        compared_with_theory(code, "dropped-ball", ("e=0.5",), ("rebound",))
    with part(1, "when it comes to rest"):
        compared_with_theory(code, "ball-to-rest", ("e=0.5",), ("rest_time",))
