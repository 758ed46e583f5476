"""Friction, sticking and sliding (slide 24): examples that a student sees."""

from __future__ import annotations

import math

from labs.grading.calling.scenario_runs import compared_with_theory, with_solutions
from labs.grading.judging.comparison import expect, numbers
from labs.grading.judging.markers import asks

X, Y, UP, REST = [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]
SLANTED = [1 / 3, 2 / 3, 2 / 3]
"""A unit normal along no axis. (2, 1, −2) and (2, −2, 1) are at right angles to it and to each other."""
LEANING = [-1 / 3, 2 / 3, 2 / 3]
"""Its mirror image: it leans the other way along x."""
START = [1.0, -2.0, 3.0]
INFINITY = math.inf


@asks(
    "support_force",
    4,
    "The support pushes as hard as the body leans on it, and never pulls; the rest lies along the surface.",
    "Slide 24. Draw every force on the body as somebody on the support sees it. Which part leans on the support?",
)
def test_the_support_pushes_and_friction_has_the_rest(submission, part):
    down = [0, 0, -10]
    with part(2, "on a floor: the weight, a push, a lift that starts upwards, a lorry that brakes"):
        expect(submission.support_force, (2.0, down, REST, REST, UP), (20.0, REST))
        expect(submission.support_force, (2.0, down, [8, 3, -6], REST, UP), (26.0, [8.0, 3.0, 0.0]))
        expect(submission.support_force, (2.0, down, REST, [0, 0, 3], UP), (26.0, REST))
        expect(submission.support_force, (3.0, down, REST, [-4, 1, 0], UP), (30.0, [12.0, -3.0, 0.0]))
    with part(1, "on a slope along no axis; lifted off"):
        # all forces on it add up to (6, −6, −9) N, and then to (6, 3, 15) N
        expect(submission.support_force, (2.0, [1, 2, -10], [8, -6, 7], [2, 2, -2], LEANING), (12.0, [2.0, 2.0, -1.0]))
        along = [4 / 3, -19 / 3, 17 / 3]
        expect(submission.support_force, (1.5, [2, 0, -10], [0, 6, 24], [-2, 2, -4], SLANTED), (0.0, along))
        expect(submission.support_force, (2.0, down, [5, 0, 20], REST, UP), (0.0, [5.0, 0.0, 0.0]))
    with part(1, "two bodies in one call"):
        found = ([20.0, 0.0], [REST, [3.0, 0.0, 0.0]])
        expect(submission.support_force, ([2.0, 1.0], down, [REST, [3, 0, 15]], REST, UP), found)


@asks(
    "friction_force", 4, "Sliding: μ_k N against the velocity. At rest: just as much as the push, as long as it holds.",
    "Slide 24. Three cases: it slides, it is held, it gives way.",
)  # fmt: skip
def test_friction_opposes_sliding_and_holds_what_it_can(submission, part, examples):
    with part(1, "it slides, however slowly"):
        expect(submission.friction_force, (REST, [3, -4, 0], 10.0, 0.75, 0.5), [-3.0, 4.0, 0.0])
        for slow in (1e-6, 1e-15):  # no threshold is right for both, and the square of the speed is no zero in float32
            expect(submission.friction_force, (REST, [3 * slow, -4 * slow, 0], 10.0, 0.75, 0.5), [-3.0, 4.0, 0.0])
        expect(submission.friction_force, (REST, [0, 4, 0], 10.0, 0.75, 0.5), [0.0, -5.0, 0.0])
        expect(submission.friction_force, (REST, [0, 0, -4], 10.0, 0.75, 0.5), [0.0, 0.0, 5.0])
        expect(submission.friction_force, ([4, 1, 0], [1, -2, 2], 12.0, 0.75, 0.5), [-2.0, 4.0, -4.0])
    with part(1, "it is held, and it gives way"):
        expect(submission.friction_force, ([3, 1, 0], REST, 10.0, 0.75, 0.5), [-3.0, -1.0, 0.0])
        expect(submission.friction_force, ([6, -3, 6], REST, 12.0, 0.75, 0.5), [-6.0, 3.0, -6.0])  # 9 N, the limit
        expect(submission.friction_force, ([0, 9, 0], REST, 10.0, 0.75, 0.5), [0.0, -5.0, 0.0])
        expect(submission.friction_force, ([6, -3, 6], REST, 10.0, 0.875, 0.3), [-2.0, 1.0, -2.0])  # 9 N, beyond it
    with part(1, "friction never drives a body that slides"):

        def brakes(push, velocity, normal_force, kinetic):
            found = numbers(submission.friction_force, (push, velocity, normal_force, kinetic + 0.25, kinetic))
            assert found @ velocity <= 1e-4, f"friction {found.round(4)} drives a body with velocity {velocity}"

        examples.every(lambda draw: (draw.vector(), draw.vector(), draw.number(1, 20), draw.number(0, 1)), brakes)
    with part(1, "two bodies in one call"):
        expect(submission.friction_force, ([3, 0, 0], [[4, 0, 0], REST], 10.0, 0.75, 0.5), [[-5, 0, 0], [-3, 0, 0]])


@asks(
    "sliding_motion", 3, "A body that slides to a stop within the step stays, or is pushed on from there.",
    "When does the velocity reach zero? What is left of the step then?",
)  # fmt: skip
def test_a_sliding_body_stops_and_does_not_turn_round(submission, part):
    with part(1, "it slides on; at rest, it is held or breaks away"):
        found = ([2.5, 0, 0], [2, 0, 0], INFINITY)
        expect(submission.sliding_motion, (REST, [3, 0, 0], REST, 10.0, 0.5, 0.2, 2.0, 1.0), found)
        found = ([7, -14, 15], [4, -8, 8], INFINITY)  # pushed on: it accelerates with (1, −2, 2) m/s²
        expect(submission.sliding_motion, (START, [2, -4, 4], [3, -6, 6], 12.0, 0.5, 0.25, 2.0, 2.0), found)
        expect(submission.sliding_motion, (START, REST, [3, 1, 0], 12.0, 0.5, 0.25, 2.0, 2.0), (START, REST, INFINITY))
        found = ([5, -4, 7], [4, -2, 4], INFINITY)
        expect(submission.sliding_motion, (START, REST, [6, -3, 6], 10.0, 0.875, 0.3, 2.0, 2.0), found)
    with part(1, "it stops within the step, even if it is pushed on; it stays or is pushed back"):
        found = ([2, -4, 5], REST, 2.0)  # pushed along its way with 3 N, against 6 N of friction
        expect(submission.sliding_motion, (START, [1, -2, 2], [1, -2, 2], 12.0, 0.75, 0.5, 2.0, 3.0), found)
        found = ([1.0, 0, 0], REST, 1.0)
        expect(submission.sliding_motion, (REST, [2, 0, 0], REST, 10.0, 0.5, 0.2, 1.0, 4.0), found)
        found = ([6, -12, 13], REST, 2.0)  # 9 N against 9 N of friction
        expect(submission.sliding_motion, (START, [5, -10, 10], [-3, 6, -6], 12.0, 0.75, 0.5, 2.0, 3.0), found)
        found = ([0.5, -1, 2], [-2, 4, -4], 1.0)  # 12 N, and only 9 N of friction
        expect(submission.sliding_motion, (START, [3, -6, 6], [-4, 8, -8], 12.0, 0.75, 0.5, 2.0, 3.0), found)
        found = ([3, -6, 7], REST, 2.0)  # at its very end
        expect(submission.sliding_motion, (START, [2, -4, 4], REST, 12.0, 0.5, 0.5, 2.0, 2.0), found)
    with part(1, "both in one call"):
        found = ([[0, 2.5, 0], [0, 0, 1]], [[0, 2, 0], REST], [INFINITY, 1.0])
        expect(
            submission.sliding_motion, (REST, [[0, 3, 0], [0, 0, 2]], REST, 10.0, 0.5, 0.2, [2.0, 1.0],
            [1.0, 4.0]), found
        )  # fmt: skip


@asks(
    "clamp_to_circle",
    2,
    "Too large a force is shortened to the limit; its direction stays.",
    "Slide 24. How long may the force be, and which way does it point afterwards?",
)
def test_a_force_beyond_the_limit_is_shortened(submission, part):
    with part(1, "below and above the limit"):
        expect(submission.clamp_to_circle, ([1, 2, 0], 5.0), [1.0, 2.0, 0.0])
        expect(submission.clamp_to_circle, ([6, -8, 0], 5.0), [3.0, -4.0, 0.0])
        expect(submission.clamp_to_circle, ([4, -2, 4], 3.0), [2.0, -1.0, 2.0])
        expect(submission.clamp_to_circle, (REST, 0.0), REST)
    with part(1, "two forces in one call"):
        expect(submission.clamp_to_circle, ([[1, 2, 0], [6, 8, 0]], 5.0), [[1, 2, 0], [3, 4, 0]])


@asks(
    "roll_step",
    4,
    "Friction stops the slip where the ball touches the floor, if μ g Δt is enough, and turns the ball as it does.",
    "How fast does the lowest point of the ball move over the floor? What does a push there do to v, and what to ω?",
)
def test_friction_slows_the_ball_and_turns_it(submission, part):
    with part(2, "it slips: thrown, with backspin, with a hook, at a slant"):
        expect(submission.roll_step, ([5, 0, 0], REST, 0.5, 0.2, 10.0, 0.5), ([4, 0, 0], [0, 5, 0]))
        expect(submission.roll_step, ([2, 0, 0], [0, -20, 0], 0.25, 0.4, 5.0, 0.5), ([1, 0, 0], [0, -10, 0]))
        expect(submission.roll_step, ([4, 0, 0], [-12, 0, 3], 0.25, 0.2, 10.0, 0.25), ([3.6, 0.3, 0], [-9, 4, 3]))
        found = ([-4.7, 8.6, 0], [-20, 2.5, 7])  # the slip is (−6, 8): 10 m/s
        expect(submission.roll_step, ([-5, 9, 0], [-10, 10, 7], 0.1, 0.2, 10.0, 0.25), found)
    with part(1, "it rolls at the end of the step, or rolled already; it is at rest"):
        expect(submission.roll_step, ([7, -14, 0], REST, 0.5, 0.8, 10.0, 1.0), ([5, -10, 0], [20, 10, 0]))
        expect(submission.roll_step, ([3, 1, 0], [-4, 12, 5], 0.25, 0.8, 10.0, 1.0), ([3, 1, 0], [-4, 12, 5]))
        expect(submission.roll_step, (REST, [14, -7, 0], 0.5, 0.9, 10.0, 1.0), ([-1, -2, 0], [4, -2, 0]))
        expect(submission.roll_step, (REST, [0, 0, 8], 0.5, 0.2, 10.0, 1.0), (REST, [0, 0, 8]))
    with part(1, "two balls in one call"):
        found = ([[4, 0, 0], [5, -10, 0]], [[0, 5, 0], [20, 10, 0]])
        expect(submission.roll_step, ([[5, 0, 0], [7, -14, 0]], REST, 0.5, 0.2, 10.0, [0.5, 4.0]), found)


@asks(
    "break_away_time", 2, "A push that grows breaks the body away when it reaches μ_s N.",
    "Both the push and the normal force may change with time.",
)  # fmt: skip
def test_a_growing_push_breaks_the_body_away(submission, part):
    with part(1, "the push grows, is too strong, or never is; the body lifts off; on a slope both forces change"):
        expect(submission.break_away_time, ([1, 0, -10], [2, 0, 0], UP, 0.5), 2.0)
        expect(submission.break_away_time, ([5, 0, -10], [-1, 0, 0], UP, 0.5), 10.0)  # from one edge to the other
        expect(submission.break_away_time, ([0, 0, -10], [0, 0, 5], UP, 0.0), 2.0)  # nothing presses any more
        expect(submission.break_away_time, ([0, 0, 5], REST, UP, 0.5), 0.0)
        expect(submission.break_away_time, (REST, [0, 0, -1], UP, 0.5), INFINITY)
        expect(submission.break_away_time, (REST, REST, UP, 0.5), INFINITY)
        expect(submission.break_away_time, ([3, 0, -10], [0, 0, 2], UP, 0.5), 2.0)  # pressed less and less
        expect(submission.break_away_time, ([0, 0, -10], [1, 0, 2], UP, 0.5), 2.5)  # 1 t against (10 − 2 t)/2
        # After 2 s: (6, 8) times 3 N along the slope, 20 times 3 N against it; then (3, 4) and 10.
        expect(submission.break_away_time, ([-8, -64, -40], [8, 7, -2], SLANTED, 0.5), 2.0)
        expect(submission.break_away_time, ([12, -39, -18], [-8, 7, -2], LEANING, 0.5), 2.0)
        expect(submission.break_away_time, ([8, 0, -10], X, UP, 0.5), 0.0)
        expect(submission.break_away_time, ([8, 0, -10], [-1, 0, 0], UP, 0.5), 0.0)
        expect(submission.break_away_time, ([1, -1, -4], [-1, -0.5, 1], SLANTED, 0.95), 0.0)  # 3 N against 2.85 N
        expect(submission.break_away_time, ([1, 0, -10], REST, UP, 0.5), INFINITY)
    with part(1, "two bodies in one call"):
        expect(submission.break_away_time, ([[1, 0, -10], [8, 0, -10]], [2, 0, 0], UP, 0.5), [2.0, 0.0])


@asks("sliding_motion", 2, "A block slides v²/(2 μ g) far, as in every engine.")
def test_a_block_slides_as_far_as_theory_says(submission, part):
    code = with_solutions(submission, "friction")
    with part(1, "on the level: how far, and how long"):
        compared_with_theory(code, "sliding-slab", ("μ=0.2,v=2",), ("stopping_distance", "stopping_time"))
    with part(1, "on a slope: it holds, or slides down"):
        compared_with_theory(code, "incline", ("μ=0.3,θ=10°", "μ=0.1,θ=20°"), ("moves", "way"))
