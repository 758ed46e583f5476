"""Impacts in a row and resting contact (slide 22): examples that a student sees."""

from __future__ import annotations

import math

import numpy as np

from labs.grading.judging.comparison import expect
from labs.grading.judging.markers import asks

X, Y, UP, REST = [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]
SLANTED = [1 / 3, 2 / 3, 2 / 3]
"""A unit normal along no axis. (2, 1, −2) and (2, −2, 1) are at right angles to it and to each other."""
LEANING = [-1 / 3, 2 / 3, 2 / 3]
"""Its mirror image: it leans the other way along x."""
START = [1.0, -2.0, 3.0]
INFINITY = math.inf


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
