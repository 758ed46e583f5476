"""Impulses between rigid bodies (slides 11 to 21): examples that a student sees.

A body is (v, ω, r, 1/M, I⁻¹). The normal points from B to A, so what approaches has a negative normal velocity.
"""

from __future__ import annotations

import numpy as np

from labs.grading.calling.scenario_runs import compared_with_theory, with_solutions
from labs.grading.judging.comparison import expect, numbers
from labs.grading.judging.markers import asks

X, Y, UP, REST = [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]
TURNS = np.diag([1.0, 2.0, 4.0])
"""Unlike about each axis: I⁻¹(r × J) is something else than (I⁻¹ r) × J then."""
FALLING = ([0, 0, -2], REST, REST, 1.0, TURNS)
"""A body of 1 kg that comes down with 2 m/s, struck right below its centre."""
BESIDE = ([0, 0, -2], REST, [0.5, 0, 0], 1.0, TURNS)
"""The same, struck half a metre beside its centre."""
TRIPPED = ([0, -2, 0], REST, [0, 0, -0.5], 1.0, TURNS)
"""It moves against y, and is struck half a metre below its centre: it turns about x."""
ABOVE = (REST, REST, [0.5, 0, 0.5], 1.0, TURNS)
"""At rest, with the contact beside and above its centre."""
SWINGING = ([-2, 0, 0], REST, [0, 0.5, 0], 1.0, TURNS)
"""It moves against x, and is struck half a metre beside its centre: it turns about z."""
SPINS = (REST, [0, 2, 0], [0.5, 0, 0], 1.0, TURNS)
"""Its centre is at rest; half a metre beside it, it comes down with 1 m/s."""
ROLLS = ([1, 0, 0], [0, 2, 0], [0, 0, -0.5], 1.0, TURNS)
"""A ball that rolls along x."""
STILL = (REST, REST, REST, 1.0, TURNS)
LIGHT = (REST, REST, REST, 3.0, TURNS)
"""A third of a kilogram."""
PIVOTED = (REST, REST, [1, 0, 0], 0.0, TURNS)
"""It cannot be moved, but turned about its centre."""
GROUND = (REST, REST, REST, 0.0, np.zeros((3, 3)))
SLANTED = [1 / 3, 2 / 3, 2 / 3]
"""A unit normal along no axis."""
OPPOSITE = [-1 / 3, -2 / 3, -2 / 3]
SPINNING_A = ([-1, -2, -3], [-1, 2, -2], [0.5, -0.5, -2], 0.25, [[2, 1, 0], [1, 3, 1], [0, 1, 4]])
SPINNING_B = ([2.5, 2, 1], [3, -2, 4], [1, -1, 0.5], 0.5, [[3, 0, 1], [0, 2, 1], [1, 1, 2]])
"""4 kg and 2 kg. Both move, turn, and are struck beside their centres, on the slanted normal.

r_A × n = (1, −1, 1/2) and r_B × n = (−1, −1/2, 1), so the denominator of slide 20 is 1/4 + 3 + 1/2 + 5/2 = 6.25
per kilogram. The points have the velocities (−6, −5, −3.5) and (5.5, 4.5, 0): they approach with 12.5 m/s along
the normal.
"""
SPINNING_AFTER = ([-0.75, -1.5, -2.5], [2, -2.5, 1], [2, 1, 0], [9, -2, 2.5])
"""Their v_A, ω_A, v_B and ω_B after an impulse of 3 N s along the normal: J = (1, 2, 2) on A and −J on B."""
EXCHANGED_AFTER = (*SPINNING_AFTER[2:], *SPINNING_AFTER[:2])
"""The same with A and B exchanged, and with the opposite normal."""
TUMBLING_A = ([-4, -2, 3], [1, -2, 2], [2, 1, -2], 0.5, [[1, -1, 0], [-1, 2, 0], [0, 0, 0.5]])
TUMBLING_B = ([2.5, -1, -3], [2, 1, -1], [-1, 0.5, 2], 0.25, [[1, 0, 0], [0, 2, -1], [0, -1, 1]])
"""2 kg and 4 kg, with the inertias ((2, 1, 0), (1, 1, 0), (0, 0, 2)) and ((1, 0, 0), (0, 1, 1), (0, 1, 2)) kg m²."""
TUMBLING_AFTER = ([-3, 0, 1], [1, 2, 5], [2, -2, -2], [12, -4, 4])
"""Their v_A, ω_A, v_B and ω_B after J = (2, 4, −4) N s on A and −J on B."""
WRONG_V, WRONG_W = [3, 0, -4], [-8, 6, -6]
"""B's v and ω after +J. r_B × J = (−10, 0, −5)."""


def many(*bodies):
    """Bodies side by side, as one that holds them all."""
    return tuple(np.stack([np.asarray(part, dtype=float) for part in parts]) for parts in zip(*bodies, strict=True))


@asks(
    "normal_velocity", 3, "It is the rate at which the points of contact part: negative while they approach.",
    "Slides 14, 15 and 19. How fast does each point move, in metres a second, and which way does the normal point?",
)  # fmt: skip
def test_points_that_approach_have_a_negative_normal_velocity(submission, part):
    with part(1, "one body flies, or spins on the spot, or rolls"):
        expect(submission.normal_velocity, (FALLING, STILL, UP), -2.0)
        expect(submission.normal_velocity, (STILL, FALLING, UP), 2.0)
        expect(submission.normal_velocity, (FALLING, STILL, X), 0.0)  # it slides along
        expect(submission.normal_velocity, (SPINS, GROUND, UP), -1.0)
        expect(submission.normal_velocity, (GROUND, SPINS, UP), 1.0)
        expect(submission.normal_velocity, (ROLLS, GROUND, X), 0.0)  # its lowest point is at rest
    with part(1, "both bodies fly, spin, and are touched beside their centres"):
        expect(submission.normal_velocity, (SPINNING_A, SPINNING_B, SLANTED), -12.5)
        expect(submission.normal_velocity, (SPINNING_B, SPINNING_A, OPPOSITE), -12.5)
        expect(submission.normal_velocity, (SPINNING_A, SPINNING_B, [0.6, 0, -0.8]), -4.1)
        expect(submission.normal_velocity, (TUMBLING_A, TUMBLING_B, SLANTED), 9.0)
    with part(1, "several contacts in one call"):
        expect(submission.normal_velocity, (many(FALLING, SPINS), GROUND, UP), [-2.0, -1.0])
        expect(submission.normal_velocity, (many(FALLING, SPINS), many(SPINS, STILL), UP), [-1.0, -1.0])
        expect(submission.normal_velocity, (SPINNING_A, SPINNING_B, [X, UP, SLANTED]), [-11.5, -3.5, -12.5])


@asks(
    "edge_edge_normal",
    2,
    "The normal of two edges stands on both, has unit length and points towards A.",
    "Slide 17. How long is the cross product of the edges, and which ways may it point?",
)
def test_the_normal_of_two_edges_stands_on_both_and_points_towards_a(submission, part):
    with part(1, "A above, A below, beside B; edges along no axis"):
        expect(submission.edge_edge_normal, ([2, 0, 0], [1, 1, 0], [0, 0, 1], REST), UP)
        expect(submission.edge_edge_normal, ([2, 0, 0], [1, 1, 0], [0, 0, -1], REST), [0.0, 0.0, -1.0])
        expect(submission.edge_edge_normal, ([2, 0, 0], [1, 1, 0], [3, 0, 0], REST), UP)
        expect(submission.edge_edge_normal, ([-2, 0, 0], [1, 1, 0], [0, 0, 1], REST), UP)
        expect(submission.edge_edge_normal, ([2, 1, -2], [4, -1, -1], [-5, -1, -2], [-2, -2, -3]), SLANTED)
        expect(submission.edge_edge_normal, ([4, -1, -1], [2, 1, -2], [4, 1, 2], [-1, 2, 3]), SLANTED)
        expect(submission.edge_edge_normal, ([1, 2, 0], [0, 2, 1], X, REST), [2 / 3, -1 / 3, 2 / 3])
        expect(submission.edge_edge_normal, ([1e-4, 0, 0], [1e-4, 1e-6, 0], [0, 0, 1], REST), UP)  # 0.6° apart
    with part(1, "both in one call"):
        expect(submission.edge_edge_normal, ([2, 0, 0], [1, 1, 0], [[0, 0, 1], [0, 0, -1]], REST), [UP, [0, 0, -1]])
        expect(submission.edge_edge_normal, ([X, [0, 3, 0]], [[1, 1, 0], UP], [1, 0, 1], REST), [UP, X])


@asks(
    "world_inverse_inertia", 4, "I⁻¹ turns with the body: R I_body⁻¹ Rᵀ.",
    "Slide 18. Turned by a quarter about z, the body's x axis lies along the world's y.",
)  # fmt: skip
def test_the_inverse_inertia_turns_with_the_body(submission, part):
    half = np.sqrt(0.5)
    turned = np.array([[0.6, 0, 0.8], [0.64, 0.6, -0.48], [-0.48, 0.8, 0.36]])  # the matrix of (0.8, 0.4, 0.4, 0.2)
    with part(1, "not turned, a quarter turn about z, a third of a turn about the diagonal, any other"):
        expect(submission.world_inverse_inertia, ([1, 2, 4], [1, 0, 0, 0]), np.diag([1.0, 0.5, 0.25]))
        expect(submission.world_inverse_inertia, ([1, 2, 4], [half, 0, 0, half]), np.diag([0.5, 1.0, 0.25]))
        expect(submission.world_inverse_inertia, ([1, 2, 4], [0.5, -0.5, -0.5, -0.5]), np.diag([0.5, 0.25, 1.0]))
        inverse = turned @ np.diag([1.0, 0.5, 0.25]) @ turned.T
        expect(submission.world_inverse_inertia, ([1, 2, 4], [0.8, 0.4, 0.4, 0.2]), inverse)
    with part(1, "what cannot be turned"):
        expect(submission.world_inverse_inertia, ([np.inf] * 3, [1, 0, 0, 0]), np.zeros((3, 3)))
    with part(1, "a thin rod"):
        expect(submission.world_inverse_inertia, ([2, 2, 0], [1, 0, 0, 0]), np.diag([0.5, 0.5, 0.0]))
    with part(1, "two bodies in one call"):
        both = [np.diag([1.0, 0.5, 0.25]), np.diag([0.5, 1.0, 0.25])]
        expect(submission.world_inverse_inertia, ([1, 2, 4], [[1, 0, 0, 0], [half, 0, 0, half]]), both)
        expect(submission.world_inverse_inertia, ([[1, 2, 4], [2, 1, 4]], [1, 0, 0, 0]), both)


@asks(
    "inverse_effective_mass", 3, "A body gives way more easily where it can turn.",
    "Slide 20, the denominator: what does a unit impulse do to the velocity of each point?",
)  # fmt: skip
def test_a_body_gives_way_more_easily_beside_its_centre(submission, part):
    with part(1, "through both centres: 1/M_A + 1/M_B"):
        expect(submission.inverse_effective_mass, (FALLING, LIGHT, UP), 4.0)
        expect(submission.inverse_effective_mass, (FALLING, STILL, UP), 2.0)
        expect(submission.inverse_effective_mass, (FALLING, GROUND, UP), 1.0)
    with part(1, "beside a centre, r²/I more; beside both"):
        expect(submission.inverse_effective_mass, (BESIDE, GROUND, UP), 1.5)
        expect(submission.inverse_effective_mass, (GROUND, ABOVE, [-0.6, 0, 0.8]), 1.98)
        expect(submission.inverse_effective_mass, (TRIPPED, GROUND, Y), 1.25)
        expect(submission.inverse_effective_mass, (SWINGING, GROUND, X), 2.0)
        expect(submission.inverse_effective_mass, (SPINNING_B, SPINNING_A, OPPOSITE), 6.25)
    with part(1, "two contacts in one call"):
        expect(submission.inverse_effective_mass, (many(FALLING, BESIDE), GROUND, UP), [1.0, 1.5])
        expect(submission.inverse_effective_mass, (many(BESIDE, BESIDE), GROUND, [UP, X]), [1.5, 1.0])


@asks(
    "impulse_magnitude", 4, "After the impulse the points part with e times the speed of their approach.",
    "Slide 20. Put u_n⁺ in terms of the unknown j, and ask for −e u_n⁻.",
)  # fmt: skip
def test_the_impulse_makes_the_points_part_as_asked(submission, part):
    with part(1, "a body on the ground, two equal bodies"):
        expect(submission.impulse_magnitude, (FALLING, GROUND, UP, 0.5), 3.0)
        expect(submission.impulse_magnitude, (FALLING, STILL, UP, 0.5), 1.5)
        expect(submission.impulse_magnitude, (STILL, FALLING, UP, 0.5), -1.5)  # they part: it would have to pull
    with part(1, "beside the centre, also of a body that spins on the spot; beside both"):
        expect(submission.impulse_magnitude, (SPINNING_B, SPINNING_A, OPPOSITE, 0.5), 3.0)
        expect(submission.impulse_magnitude, (BESIDE, GROUND, UP, 0.5), 2.0)
        expect(submission.impulse_magnitude, (TRIPPED, GROUND, Y, 0.5), 2.4)
        expect(submission.impulse_magnitude, (SWINGING, GROUND, X, 0.5), 1.5)
        expect(submission.impulse_magnitude, (SPINS, GROUND, UP, 0.5), 1.0)
    with part(1, "nothing to push away"):
        expect(submission.impulse_magnitude, (GROUND, GROUND, UP, 0.5), 0.0)
        expect(submission.impulse_magnitude, (([0, 0, -2], *GROUND[1:]), GROUND, UP, 0.5), 0.0)
    with part(1, "two contacts in one call"):
        expect(submission.impulse_magnitude, (many(FALLING, BESIDE), GROUND, UP, 0.5), [3.0, 2.0])
        expect(submission.impulse_magnitude, (FALLING, GROUND, [UP, X], [0.25, 0.5]), [2.5, 0.0])


@asks(
    "apply_impulse", 4, "An impulse moves and turns A, and B the other way: momentum stays.",
    "Slide 18 has a plus for both. Compare the slide's own pseudo-code, P_B −= J.",
)  # fmt: skip
def test_an_impulse_moves_a_and_b_in_opposite_directions(submission, part, examples):
    with part(1, "through the centres, and beside one"):
        expect(submission.apply_impulse, (FALLING, STILL, [0, 0, 3]), ([0, 0, 1], REST, [0, 0, -3], REST))
        expect(submission.apply_impulse, (BESIDE, GROUND, [0, 0, 1]), ([0, 0, -1], [0, -1, 0], REST, REST))
        expect(submission.apply_impulse, (PIVOTED, GROUND, [0, 0, 1]), (REST, [0, -2, 0], REST, REST))
    with part(1, "both bodies move, turn, and are struck beside their centres"):
        expect(submission.apply_impulse, (SPINNING_B, SPINNING_A, [-1, -2, -2]), EXCHANGED_AFTER)
    with part(1, "momentum is kept"):

        def kept(body_a, body_b, impulse):
            v_a, _, v_b, _ = numbers(submission.apply_impulse, (body_a, body_b, impulse), 4)
            gained = (v_a - body_a[0]) / body_a[3] + (v_b - body_b[0]) / body_b[3]
            assert np.allclose(gained, 0, atol=3e-4), f"the two together gain a momentum of {gained.round(3)} kg m/s"

        examples.every(lambda draw: (draw.body(), draw.body(), draw.vector(4)), kept)
    with part(1, "two impulses in one call"):
        expect(
            submission.apply_impulse,
            (FALLING, GROUND, [[0, 0, 3], [0, 0, 2]]),
            ([[0, 0, 1], REST], [REST, REST], [REST, REST], [REST, REST]),
        )
        two = (many(FALLING, BESIDE), GROUND, [[0, 0, 2], [0, 0, 2]])
        expect(submission.apply_impulse, two, ([REST, REST], [REST, [0, -2, 0]], [REST, REST], [REST, REST]))


@asks(
    "collide", 5, "A collision keeps momentum, gains no energy, and leaves alone what does not approach.",
    "Slide 21: point velocities, normal velocity, is it colliding, impulse, new velocities.",
)  # fmt: skip
def test_a_collision_keeps_momentum_and_gains_no_energy(submission, part, examples):
    with part(1, "down on the ground, beside its centre, by its spin alone; one body on another"):
        expect(submission.collide, (FALLING, GROUND, UP, 0.5), ([0, 0, 1], REST, REST, REST))
        expect(submission.collide, (SPINS, GROUND, UP, 0.5), ([0, 0, 1], [0, 1, 0], REST, REST))
        expect(submission.collide, (TRIPPED, GROUND, Y, 0.5), ([0, 0.4, 0], [1.2, 0, 0], REST, REST))
        expect(submission.collide, (SWINGING, GROUND, X, 0.5), ([-0.5, 0, 0], [0, 0, -3], REST, REST))
        expect(submission.collide, (FALLING, STILL, UP, 1.0), (REST, REST, [0, 0, -2], REST))
    with part(1, "both bodies move, turn, and are struck beside their centres; faster than a threshold, and not"):
        expect(submission.collide, (SPINNING_A, SPINNING_B, SLANTED, 0.5), SPINNING_AFTER)
        expect(submission.collide, (SPINNING_B, SPINNING_A, OPPOSITE, 0.5, 12.0), EXCHANGED_AFTER)
        before = (*SPINNING_A[:2], *SPINNING_B[:2])
        expect(submission.collide, (SPINNING_A, SPINNING_B, SLANTED, 0.5, 13.0), before)
    with part(1, "parting already, immovable both, or not faster than the threshold"):
        expect(
            submission.collide, (([0, 0, 2], REST, REST, 1.0, TURNS), GROUND, UP, 0.5), ([0, 0, 2], REST, REST, REST)
        )
        still = ([0, 0, -2], REST, REST, REST)  # two that nothing moves
        expect(submission.collide, (([0, 0, -2], *GROUND[1:]), GROUND, UP, 0.5), still)
        expect(submission.collide, (FALLING, GROUND, UP, 0.5, 3.0), ([0, 0, -2], REST, REST, REST))
        expect(submission.collide, (FALLING, GROUND, UP, 0.5, 2.0), ([0, 0, -2], REST, REST, REST))
    with part(1, "momentum is kept, and no energy gained"):

        def kept(body_a, body_b, normal, restitution):
            v_a, w_a, v_b, w_b = numbers(submission.collide, (body_a, body_b, normal, restitution), 4)
            gained = (v_a - body_a[0]) / body_a[3] + (v_b - body_b[0]) / body_b[3]
            assert np.allclose(gained, 0, atol=1e-3), f"the two together gain a momentum of {gained.round(3)} kg m/s"
            before = energy(body_a[0], body_a[1], body_a) + energy(body_b[0], body_b[1], body_b)
            after = energy(v_a, w_a, body_a) + energy(v_b, w_b, body_b)
            assert after <= before * 1.0001, f"their energy grows from {before:.4g} J to {after:.4g} J"

        examples.every(pair, kept)
    with part(1, "two collisions in one call"):
        expect(
            submission.collide, (many(FALLING, STILL), GROUND, UP, 0.5),
            ([[0, 0, 1], REST], [REST, REST], [REST, REST], [REST, REST]),
        )  # fmt: skip


def energy(velocity, spin, body):
    """Kinetic energy of a body with other velocities, J."""
    return velocity @ velocity / body[3] / 2 + spin @ np.linalg.solve(body[4], spin) / 2


def pair(draw):
    """Two bodies, a normal, e; mostly coming nearer."""
    normal = draw.unit()
    velocity, *others = draw.body()
    return (velocity - draw.number(2, 6) * normal, *others), draw.body(), normal, draw.number(0.1, 0.9)


@asks("collide", 2, "Two balls, and a rod that is struck at its end, do what theory says, as in every engine.")
def test_balls_and_a_rod_part_as_theory_says(submission, part):
    code = with_solutions(submission, "impulse")
    with part(1, "two balls, head on and beside"):
        compared_with_theory(code, "two-balls", ("e=1,m=1,b=0", "e=0.5,m=1,b=0.5"), ("striker", "target", "energy"))
    with part(1, "a rod, struck at its end"):
        compared_with_theory(code, "struck-rod", ("e=0.5,x=0.499",), ("impulse", "spin", "kept"))


@asks(
    "audit", 4, "Each body adds M Δv to the momentum, and its spin and its flight to the angular momentum.",
    "Which of ΔP, ΔL and ΔE is off? For L: where is the centre of a body, as seen from the point of contact? For E: how"
    " much work does it take to bring a body to its speed and its spin?",
)  # fmt: skip
def test_an_audit_finds_what_an_impact_must_not_change(submission, part):
    a, b = TUMBLING_A, TUMBLING_B
    v_a, w_a, v_b, w_b = TUMBLING_AFTER
    with part(1, "after a right impulse, and after velocities that no impact gives"):
        expect(submission.audit, (FALLING, STILL, ([0, 0, 1], REST, [0, 0, -3], REST)), (REST, REST, 3.0))
        expect(submission.audit, (a, b, TUMBLING_AFTER), (REST, REST, 75.0))
        expect(submission.audit, (SPINNING_B, SPINNING_A, EXCHANGED_AFTER), (REST, REST, -9.375))
        expect(submission.audit, (a, b, (a[0], a[1], b[0], b[1])), (REST, REST, 0.0))  # nothing happens
        back_a, back_b = (v_a, w_a, *a[2:]), (v_b, w_b, *b[2:])
        expect(submission.audit, (back_a, back_b, (a[0], a[1], b[0], b[1])), (REST, REST, -75.0))  # run backwards
        anything = ([-1, 2, 1], [3, 1, -1], [0.5, 2, -2], [1, -2, 3])
        expect(submission.audit, (a, b, anything), ([-2, 20, 0], [16, 22, -3], -27.5))
    with part(1, "a wrong sign on B: of both its changes, of its velocity alone, of its spin alone"):
        expect(submission.audit, (a, b, (v_a, w_a, WRONG_V, WRONG_W)), ([4, 8, -8], REST, 71.0))
        expect(submission.audit, (a, b, (v_a, w_a, WRONG_V, w_b)), ([4, 8, -8], [20, 0, 10], 101.0))
        expect(submission.audit, (a, b, (v_a, w_a, v_b, WRONG_W)), (REST, [-20, 0, -10], 45.0))
    with part(1, "the ground, a body on a pivot, and a thin rod that is struck at its end"):
        expect(submission.audit, (a, GROUND, (v_a, w_a, REST, REST)), ([2, 4, -4], REST, 6.0))
        expect(submission.audit, (GROUND, b, (REST, REST, v_b, w_b)), ([-2, -4, 4], REST, 69.0))
        turned = ([0, -1, -1], REST, REST, [0, 2, 4])  # J = (0, 1, −1) N s on what cannot be moved, but turned
        expect(submission.audit, (FALLING, PIVOTED, turned), ([0, -1, 1], [0, 1, 1], 2.0))
        expect(submission.audit, (PIVOTED, FALLING, (*turned[2:], *turned[:2])), ([0, -1, 1], [0, 1, 1], 2.0))
        rod = (REST, [0, 0, 3], [0, 0, 0.5], 1.0, np.diag([12.0, 12.0, 0.0]))  # it also spins about itself
        expect(submission.audit, (rod, GROUND, ([1, 0, 0], [0, 6, 3], REST, REST)), ([1, 0, 0], REST, 2.0))
    with part(1, "two impacts in one call"):
        two = ([v_a, a[0]], [w_a, a[1]], [v_b, b[0]], [w_b, b[1]])
        expect(submission.audit, (many(a, a), b, two), ([REST, REST], [REST, REST], [75.0, 0.0]))
        one = (many(a, b), GROUND, ([v_a, v_b], [w_a, w_b], REST, REST))
        expect(submission.audit, one, ([[2, 4, -4], [-2, -4, 4]], [REST, REST], [6.0, 69.0]))
