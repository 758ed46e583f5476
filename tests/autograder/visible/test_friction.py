"""Friction, sticking and sliding (slides 16, 22 and 24): examples that a student sees."""

from __future__ import annotations

import math

import numpy as np

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
    "apparent_force",
    2,
    "Seen from a lift or a lorry, a body has another weight.",
    "A lift starts upwards and you feel heavier. With which sign does its acceleration go in?",
)
def test_in_a_lift_a_body_has_another_weight(submission, part):
    with part(1, "at rest with a push, in a lift that starts upwards"):
        expect(submission.apparent_force, (2.0, [0, 0, -10], [5, 0, 0], REST), [5.0, 0.0, -20.0])
        expect(submission.apparent_force, (2.0, [0, 0, -10], REST, [0, 0, 3]), [0.0, 0.0, -26.0])
        expect(submission.apparent_force, (2.0, [1, 2, -10], [5, -1, 3], [2, -3, 4]), [3.0, 9.0, -25.0])
    with part(1, "two bodies in one call"):
        expect(submission.apparent_force, ([2.0, 1.0], [0, 0, -10], REST, REST), [[0, 0, -20], [0, 0, -10]])


@asks(
    "normal_force",
    2,
    "The support pushes as hard as the body is pressed on it, and never pulls.",
    "Slide 24. On a slope, how much of the weight presses on it? And when something lifts the body off?",
)
def test_the_support_pushes_and_never_pulls(submission, part):
    with part(1, "pressed on a floor, pushed along it, lifted off; on a slope along no axis"):
        expect(submission.normal_force, ([7, 0, -20], UP), 20.0)
        expect(submission.normal_force, ([7, 0, 0], UP), 0.0)
        expect(submission.normal_force, ([0, 0, 5], UP), 0.0)
        expect(submission.normal_force, ([-6, -9, -6], LEANING), 8.0)
    with part(1, "two bodies in one call"):
        expect(submission.normal_force, ([[0, 0, -20], [0, 0, 5]], UP), [20.0, 0.0])


@asks(
    "along_surface",
    2,
    "What is left of a force when its part along the normal is taken away.",
    "How much of your answer points along the normal? Nothing should.",
)
def test_along_the_surface_is_what_the_normal_part_leaves(submission, part):
    with part(1, "on a floor, and on a slope along no axis"):
        expect(submission.along_surface, ([3, 4, -20], UP), [3.0, 4.0, 0.0])
        expect(submission.along_surface, ([-3, -6, -9], LEANING), [-6.0, 0.0, -3.0])
        expect(submission.along_surface, ([0, 0, -20], UP), REST)
    with part(1, "two forces in one call"):
        expect(submission.along_surface, ([[3, 4, -20], [1, 0, 9]], UP), [[3, 4, 0], [1, 0, 0]])


@asks(
    "holds", 2, "Static friction holds against any push up to μ_s N.", "Slide 24. μ_s N is the most that it can take."
)
def test_static_friction_holds_up_to_its_limit(submission, part):
    with part(1, "a weak push and a strong one, along an axis and across; just the limit"):
        expect(submission.holds, ([1, 0, 0], 10.0, 0.5), True)
        expect(submission.holds, ([8, 0, 0], 10.0, 0.5), False)
        expect(submission.holds, ([4, 4, 0], 10.0, 0.5), False)
        expect(submission.holds, ([6, 3, -6], 10.0, 0.875), False)  # 9 N against 8.75 N
        expect(submission.holds, ([6, 3, -6], 12.0, 0.75), True)  # 9 N against 9 N
    with part(1, "two bodies in one call"):
        expect(submission.holds, ([[1, 0, 0], [0, -8, 0]], 10.0, 0.5), [True, False])


@asks(
    "friction_angle",
    2,
    "The steepest slope on which a body stays has tan θ = μ_s.",
    "Draw the weight on the slope. Which part pulls down it, and which part presses on it?",
)
def test_the_steepest_slope_has_the_tangent_of_the_friction(submission, part):
    with part(1, "45°, and no friction"):
        expect(submission.friction_angle, (1.0,), math.pi / 4)
        expect(submission.friction_angle, (0.0,), 0.0)
    with part(1, "several in one call"):
        expect(submission.friction_angle, ([1.0, math.sqrt(3)],), [math.pi / 4, math.pi / 3])


@asks(
    "friction_force", 4, "Sliding: μ_k N against the velocity. At rest: just as much as the push, as long as it holds.",
    "Slide 24. Three cases: it slides, it is held, it gives way.",
)  # fmt: skip
def test_friction_opposes_sliding_and_holds_what_it_can(submission, part, examples):
    with part(1, "it slides"):
        expect(submission.friction_force, (REST, [3, -4, 0], 10.0, 0.75, 0.5), [-3.0, 4.0, 0.0])
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
    with part(1, "it stops within the step, and stays or is pushed back"):
        found = ([1.0, 0, 0], REST, 1.0)
        expect(submission.sliding_motion, (REST, [2, 0, 0], REST, 10.0, 0.5, 0.2, 1.0, 4.0), found)
        found = ([6, -12, 13], REST, 2.0)  # 9 N against 9 N of friction
        expect(submission.sliding_motion, (START, [5, -10, 10], [-3, 6, -6], 12.0, 0.75, 0.5, 2.0, 3.0), found)
        found = ([0.5, -1, 2], [-2, 4, -4], 1.0)  # 12 N, and only 9 N of friction
        expect(submission.sliding_motion, (START, [3, -6, 6], [-4, 8, -8], 12.0, 0.75, 0.5, 2.0, 3.0), found)
        found = ([3, -6, 7], REST, 2.0)  # at its very end
        expect(submission.sliding_motion, (START, [2, -4, 4], REST, 12.0, 0.5, 0.5, 2.0, 2.0), found)
    with part(1, "both in one call"):
        found = ([[2.5, 0, 0], [1, 0, 0]], [[2, 0, 0], REST], [INFINITY, 1.0])
        expect(
            submission.sliding_motion, (REST, [[3, 0, 0], [2, 0, 0]], REST, 10.0, 0.5, 0.2, [2.0, 1.0],
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
    "clamp_to_square",
    2,
    "Each component is clamped on its own, along the axes given.",
    "How much of the force is along each axis? The axes may be turned.",
)
def test_each_component_is_clamped_on_its_own(submission, part):
    with part(1, "along x and y, and along axes that are turned"):
        expect(submission.clamp_to_square, ([6, -3, 0], 5.0, X, Y), [5.0, -3.0, 0.0])
        expect(submission.clamp_to_square, ([3, 4, 0], 4.0, [0.8, -0.6, 0], [0.6, 0.8, 0]), [2.4, 3.2, 0.0])
        expect(submission.clamp_to_square, ([0, 2, 11], 4.0, [0, 0.6, 0.8], [0, -0.8, 0.6]), [0.0, -0.8, 5.6])
    with part(1, "two forces in one call"):
        expect(submission.clamp_to_square, ([[6, -3, 0], [-6, -9, 0]], 5.0, X, Y), [[5, -3, 0], [-5, -5, 0]])


@asks(
    "break_away_time", 2, "A push that grows breaks the body away when it reaches μ_s N.",
    "Both the push and the normal force may change with time.",
)  # fmt: skip
def test_a_growing_push_breaks_the_body_away(submission, part):
    with part(1, "growing, too strong already, never; lifted off; on a slope, with all that changes"):
        expect(submission.break_away_time, ([1, 0, -10], [2, 0, 0], UP, 0.5), 2.0)
        expect(submission.break_away_time, ([5, 0, -10], [-1, 0, 0], UP, 0.5), 10.0)  # from one edge to the other
        expect(submission.break_away_time, ([0, 0, -10], [0, 0, 5], UP, 0.0), 2.0)  # nothing presses any more
        expect(submission.break_away_time, ([0, 0, 5], REST, UP, 0.5), 0.0)
        expect(submission.break_away_time, (REST, [0, 0, -1], UP, 0.5), INFINITY)
        expect(submission.break_away_time, (REST, REST, UP, 0.5), INFINITY)
        expect(submission.break_away_time, ([3, 0, -10], [0, 0, 2], UP, 0.5), 2.0)  # pressed less and less
        # After 2 s: (6, 8) times 3 N along the slope, 20 times 3 N against it; then (3, 4) and 10.
        expect(submission.break_away_time, ([-8, -64, -40], [8, 7, -2], SLANTED, 0.5), 2.0)
        expect(submission.break_away_time, ([12, -39, -18], [-8, 7, -2], LEANING, 0.5), 2.0)
        expect(submission.break_away_time, ([8, 0, -10], X, UP, 0.5), 0.0)
        expect(submission.break_away_time, ([8, 0, -10], [-1, 0, 0], UP, 0.5), 0.0)
        expect(submission.break_away_time, ([1, -1, -4], [-1, -0.5, 1], SLANTED, 0.95), 0.0)  # 3 N against 2.85 N
        expect(submission.break_away_time, ([1, 0, -10], REST, UP, 0.5), INFINITY)
    with part(1, "two bodies in one call"):
        expect(submission.break_away_time, ([[1, 0, -10], [8, 0, -10]], [2, 0, 0], UP, 0.5), [2.0, 0.0])


@asks(
    "sphere_grips",
    2,
    "Friction stops the slip of a solid sphere if it is at most 7/2 μ (1 + e) v_n.",
    "One impulse slows the ball and spins it. By how much does each of the two change the slip?",
)
def test_a_sphere_grips_where_friction_can_stop_its_slip(submission, part):
    with part(1, "little slip, a lot of it, just the most"):
        expect(submission.sphere_grips, (1.0, 2.0, 0.5, 0.5), True)
        expect(submission.sphere_grips, (5.25, 2.0, 0.5, 0.5), True)
        expect(submission.sphere_grips, (6.0, 2.0, 0.5, 0.5), False)
    with part(1, "several in one call"):
        expect(submission.sphere_grips, ([1.0, 5.0, 6.0], 2.0, 0.5, 0.5), [True, True, False])


@asks(
    "friction_impulse", 3, "The impulse that grips, where friction is strong enough, else one at the cone's edge.",
    "First find the impulse that stops the slip and turns the approach round.",
)  # fmt: skip
def test_an_impact_grips_or_slips(submission, part):
    one = np.eye(3)  # of a body of 1 kg that does not turn
    two = np.array([[2, 0, -1], [0, 3, 1], [-1, 1, 2]])  # of bodies that turn: an impulse moves its point elsewhere
    with part(1, "straight on, gripping, parting, grazing; bodies that turn, on a slanted face"):
        expect(submission.friction_impulse, ([2, -5, -3], LEANING, two, 0.5, 0.5), [-1.0, 2.0, 1.0])
        expect(submission.friction_impulse, ([-10, -11, -2], SLANTED, one, 0.5, 0.51), [12.0, 15.0, 6.0])
        expect(submission.friction_impulse, ([-1, 2, 0], UP, two, 0.5, 1.5), REST)
        expect(submission.friction_impulse, ([0, 0, -2], UP, one, 0.5, 0.5), [0.0, 0.0, 3.0])
        expect(submission.friction_impulse, ([1, 0, -2], UP, one, 0.5, 0.5), [-1.0, 0.0, 3.0])
        expect(submission.friction_impulse, ([1, 0, 2], UP, one, 0.5, 0.5), REST)
    with part(1, "slipping"):
        expect(submission.friction_impulse, ([9, 0, -2], UP, one, 0.5, 0.5), [-1.5, 0.0, 3.0])
        expect(submission.friction_impulse, ([-10, -11, -2], SLANTED, one, 0.5, 0.475), [11.7, 14.85, 6.3])
        expect(submission.friction_impulse, ([22.5, 5, -16.25], LEANING, two, 0.5, 0.25), [-3.0, 3.0, 4.5])
    with part(1, "two contacts in one call"):
        expect(
            submission.friction_impulse, ([[1, 0, -2], [9, 0, -2]], UP, one, 0.5, 0.5), [[-1, 0, 3], [-1.5, 0, 3]]
        )  # fmt: skip


@asks(
    "sphere_impact", 3, "Friction in an impact turns spin into way.",
    "A solid sphere that grips leaves with v_t = 2/7 R ω of its backspin.",
)  # fmt: skip
def test_a_spinning_ball_that_grips_rolls_away(submission, part):
    with part(1, "it grips: 2/7 of the surface's speed"):
        expect(submission.sphere_impact, ([0, 0, -4], [0, 7, 0], UP, 0.5, 0.5, 1.0), ([1, 0, 2], [0, 2, 0]))
        found = (np.array([-9, 16, 20]) / 7, np.array([15, 18, 34]) / 7)
        expect(submission.sphere_impact, ([-6, -2, -4], [5, 4, 2], SLANTED, 1.5, 0.5, 0.3), found)
        found = ([-6.5, 10, -4.5], [-4, -2, 2])  # a cylinder, I = m r²/2: a third of the surface's speed
        expect(submission.sphere_impact, ([-5, 4, -6], [-6, -3, 4], SLANTED, 3.0, 0.5, 1.0, 0.5), found)
    with part(1, "too little friction, or none; parting already; straight on without spin"):
        found = ([1.32, 2.32, 2.84], [2.2, -2.6, -4.8])  # it would take 2/7
        expect(submission.sphere_impact, ([6, -2, -4], [5, -4, -2], LEANING, 1.5, 0.5, 0.28), found)
        expect(submission.sphere_impact, ([1, 0, 4], [0, 7, 0], UP, 0.5, 0.5, 1.0), ([1, 0, 4], [0, 7, 0]))
        expect(submission.sphere_impact, ([1, 0, -4], [0, 7, 0], UP, 0.5, 0.5, 0.0), ([1, 0, 2], [0, 7, 0]))
        expect(submission.sphere_impact, ([0, 0, -4], REST, UP, 0.5, 0.5, 1.0), ([0, 0, 2], REST))
    with part(1, "two balls in one call"):
        found = ([[1, 0, 2], [0, 0, 2]], [[0, 2, 0], REST])
        expect(submission.sphere_impact, ([0, 0, -4], [[0, 7, 0], REST], UP, 0.5, 0.5, 1.0), found)


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
    with part(1, "two balls that are not alike, and lose; three, two of which meet before the others"):
        expect(submission.propagate_impacts, ([1, -1], [1, 3], 0.5), [-1.25, -0.25])
        expect(submission.propagate_impacts, ([6, 0], [2, 1], 0.5), [3.0, 6.0])
        expect(submission.propagate_impacts, ([0, -1, -2], [1, 3, 1], 1.0), [-1.5, -1.25, 0.25])
    with part(1, "two rows in one call"):
        expect(submission.propagate_impacts, ([[1, 0, 0], [0, 0, 2]], 1.0, 1.0), [[0, 0, 1], [0, 0, 2]])


@asks(
    "resting_problem", 2, "A = G M⁻¹ Gᵀ and b = G M⁻¹ F.", "Slide 22. What does a unit force at a contact accelerate?"
)
def test_the_problem_of_resting_contacts(submission, part):
    with part(1, "one body on one contact"):
        expect(submission.resting_problem, ([[0, 0, 1]], np.eye(3) / 2, [0, 0, -20]), ([[0.5]], [-10.0]))
        g, w = [[1, 2, 0], [0, -1, -1]], [[2, 1, 0], [1, 3, 1], [0, 1, 4]]  # two contacts
        expect(submission.resting_problem, (g, w, [1, 2, 3]), ([[18, -9], [-9, 9]], [24.0, -24.0]))
    with part(1, "two loads in one call"):
        found = ([[0.5]], [[-10.0], [-5.0]])
        g, w = np.broadcast_to([[0.0, 0.0, 1.0]], (2, 1, 3)), np.eye(3) / 2
        expect(submission.resting_problem, (g, w, [[0, 0, -20], [0, 0, -10]]), ([[[0.5]], [[0.5]]], found[1]))


@asks(
    "complementarity_residual",
    2,
    "Of pressing and parting one has to be zero, and neither below it.",
    "Slide 22. A contact gets f = 0 and has A f + b = −1. What is wrong with it, and by how much?",
)
def test_the_residual_is_zero_for_a_solution_alone(submission, part):
    with part(1, "a solution, too little force, a force where it lifts off"):
        expect(submission.complementarity_residual, ([[2]], [-4], [2]), 0.0)
        expect(submission.complementarity_residual, ([[2]], [-4], [1.5]), 1.0)
        expect(submission.complementarity_residual, ([[2]], [4], [1]), 2.0)
        expect(submission.complementarity_residual, ([[0]], [3], [2]), 2.0)  # nothing that it could move
        three = [[2, -3, 0], [-3, 9, 1], [0, 1, 4]]
        expect(submission.complementarity_residual, (three, [1, -7, -6], [1, 1, 1]), 1.0)
    with part(1, "two guesses in one call"):
        expect(submission.complementarity_residual, ([[2]], [-4], [[2], [-1]]), [0.0, 6.0])  # the second one pulls


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
        expect(submission.solve_by_sweeps, ([[2, 1], [1, 2]], [-6, -6], 60), [2.0, 2.0])
        expect(submission.solve_by_sweeps, ([[2, 1], [1, 2]], [4, -4], 1), [0.0, 2.0])
        three = [[2, -1, 0], [-1, 4, 1], [0, 1, 2]]
        expect(submission.solve_by_sweeps, (three, [-2, -8, -6], 1, [1, 4, 3]), [3.0, 2.0, 2.0])
        expect(submission.solve_by_sweeps, ([[0]], [-4], 1), [0.0])  # nothing that it could move
    with part(1, "two loads in one call"):
        expect(submission.solve_by_sweeps, ([[2]], [[-4], [4]], 1), [[2.0], [0.0]])


@asks("sliding_motion", 2, "A block slides v²/(2 μ g) far, as in every engine.")
def test_a_block_slides_as_far_as_theory_says(submission, part):
    code = with_solutions(submission, "friction")
    with part(1, "on the level: how far, and how long"):
        compared_with_theory(code, "sliding-slab", ("μ=0.2,v=2",), ("stopping_distance", "stopping_time"))
    with part(1, "on a slope: it holds, or slides down"):
        compared_with_theory(code, "incline", ("μ=0.3,θ=10°", "μ=0.1,θ=20°"), ("moves", "way"))
