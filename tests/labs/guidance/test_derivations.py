"""One line of a derivation: every form of it is right, a wrong one is told where, and nothing else is evaluated."""

from __future__ import annotations

import re

import numpy as np
import pytest

from labs.building.lessons import lessons
from labs.guidance.hint_files import derivation, hints
from reference.errors import InvalidInput

IMPULSE = derivation("j = -(1 + e) * u / k\nu: before, m/s, -5 to -1\ne: restitution, 0 to 1\nk: 1/kg, 0.2 to 4")
SHARE = derivation("P = max(0, 1 - w / d)\nw: way, m, 0.01 to 0.06\nd: step, m, 0.02 to 0.1")
LEAN = derivation("y = i * c**2\ni: 1/kg, 1 to 5\nc: cosine, -1 to 1\ns: sine, = sqrt(1 - c**2)")
LOSS = derivation("E = s_0 - s_1\ns_0: m, 1 to 2\ns_1: m, 3 to 4")
TIME = derivation("T = 2 * s / (sqrt(u**2 - 2 * a * s) - u)\ns: m, 0 to 3\nu: m/s, -4 to -1\na: m/s², -10 to -1")

ONE_SIGN = {
    "it is a mass, a moment of inertia, or an inverse of them": """world_inverse_inertia.i inverse_effective_mass.M
        inverse_effective_mass.I impulse_magnitude.k apply_impulse.M_A apply_impulse.M_B collide.M_A collide.M_B
        audit.k""",
    "it is a mass, a stiffness or a damping": """penalty_force.m penalty_force.k penalty_force.c penalty_step_limit.m
        penalty_step_limit.k penalty_step_limit.c design_contact.m""",
    "what friction takes away is above zero": """clamp_to_circle.D clamp_to_circle.L friction_force.g
        friction_force.mu sliding_motion.g sliding_motion.mu sliding_motion.v support_force.F support_force.g
        support_force.m support_force.mu roll_step.m""",
    "it is an angle between level and upright": "friction_force.theta sliding_motion.theta clamp_to_circle.c",
    "it is a number of faces": "polyhedra_intersect.F_A polyhedra_intersect.F_B",
    "a point beyond a corner is farther out than the corner": "convex_separation.x convex_separation.y",
    "it is a distance": "winding_number.h",
    "it is a length or its square, or a square of a speed": """ray_sphere.a ray_capsule.s ray_capsule.q ray_box.h
        missed_share.c missed_share.D missed_share.R sweep_sphere_sphere.d sweep_sphere_sphere.r_A
        sweep_sphere_sphere.r_B advance.s advance.L advance.g""",
    "of bodies that avoid each other it is a length, a speed, a time, a mass, a pull, a weight or a number": """
        arrive.v arrive.tau arrive.m arrive.R repelling_force.R repelling_force.F repelling_force.F0 repelling_force.m
        tangent_point.L tangent_point.r nearest_approach.a separation.w_s separation.w_c towards_mean.n
        orca_half_plane.R orca_half_plane.L""",
    "of a mesh it is a number of nodes, a length, a mass, a stiffness, a damping, a speed, a time or a coefficient": """
        diagonals.a diagonals.b diagonals.c diagonals.d limit_strain.m_1 limit_strain.m_2 limit_strain.x mesh_forces.L
        mesh_forces.L_0 mesh_forces.c mesh_forces.k mesh_forces.v mesh_sphere_contact.e mesh_sphere_contact.mu
        mesh_sphere_contact.s mesh_step.dt timestep_bound.C timestep_bound.K timestep_bound.S timestep_bound.dt
        timestep_bound.m""",
    "a ray enters where it approaches": "ray_sphere.b ray_box.u",
    "the one that follows is the faster one": "sweep_sphere_sphere.v_A",
    "it is a reach, a spin or an angle below half a turn": "motion_bound.r motion_bound.w motion_bound.a",
    "it is a bound on a speed of approach, or a time from now": "advance.mu ray_capsule.t",
    "it is a depth, or a number of steps": "penalty_force.d design_contact.d design_contact.N",
    "it is a size": """convex_separation.A convex_separation.B overlap_interval.r overlap_interval.w
        missing_probability.w missing_probability.r""",
    "it is a time": """respond_at_step.dt respond_at_impact.dt respond_at_impact.T side_of_plane.dt
        time_of_impact_interpolated.dt missing_probability.dt""",
    "it is a speed": """side_of_plane.v missing_probability.v edge_edge_normal.c kinematic_response.v
        respond_at_step.v respond_at_impact.v penalty_force.v design_contact.v""",
    "it is the size of the weight's acceleration": "respond_at_impact.g",
    "no body parts faster for a negative e": """side_of_plane.e edge_edge_normal.e impulse_magnitude.e collide.e
        kinematic_response.e respond_at_step.e respond_at_impact.e""",
    "a step with an impact starts in front and ends behind": """time_of_impact_interpolated.s0
        time_of_impact_interpolated.s1""",
    "a separation below zero counts as zero": "time_of_impact_exact.s",
    "what moves away and is pushed away never arrives": "time_of_impact_exact.u",
    "what falls, drags or attracts has a mass, a size and a density": """universal_gravity.G universal_gravity.m_1
        universal_gravity.m_2 universal_gravity.d stokes_drag.m stokes_drag.K stokes_drag.eta terminal_velocity.s
        terminal_velocity.f terminal_velocity.eta wind_force.m wind_force.g wind_force.rho wind_force.C wind_force.A""",
    "it is a stiffness, a damping, a frequency or a damping ratio": """spring_damper_force.k spring_damper_force.c
        spring_damper_force.m spring_step_limit.w spring_step_limit.z total_force.a total_force.b""",
    "the three balls lie in this order": "total_force.x_1 total_force.x_3",
    "what turns, rests or is struck has a mass, a moment of inertia and a size": """rotate_by_momentum.I
        rotate_by_momentum.J collect_contacts.h collect_contacts.k propagate_impacts.m propagate_impacts.M
        resting_problem.m resting_problem.I step_world.w solve_by_sweeps.a""",
    "balls that collide approach, and have a restitution from 0 to 1": "propagate_impacts.u propagate_impacts.e",
    "no contact pulls": "solve_by_sweeps.f",
    "a step has a length, and a contact in overlap closes no gap": "step_world.dt respond.dt respond.s",
}
"""Quantities that can have one sign only: there a line may hold q or abs(q). Beside them, why."""


def difference(derivation, line):
    return derivation.difference(derivation.read(line))


@pytest.mark.parametrize(
    ("asked", "line"),
    [
        (IMPULSE, "-(1 + e) * u / k"),
        (IMPULSE, "j = (u + e*u) / -k"),
        (IMPULSE, "−u/k − e*u/k"),
        (SHARE, "-min(w/d - 1, 0)"),
        (SHARE, "(abs(1 - w/d) + 1 - w/d) / 2"),
        (TIME, "(-u - (u*u - 2*a*s)**0.5) / a"),
        (LEAN, "i * (1 - s**2)"),
        (LOSS, "s0 - s1"),
        (TIME, "2 * s_ / (sqrt(_u**2 - 2 * a * s) - u)"),
    ],
)
def test_every_equivalent_form_is_right(asked, line):
    assert difference(asked, line) == ""


@pytest.mark.parametrize("topic", lessons())
def test_a_quantity_with_another_sign_is_refused(topic):
    """Unless the right side does not depend on the sign, or the quantity can have one sign only."""
    single = set()
    for function, guide in hints(topic).guides.items():
        for asked in guide.derivations:
            for each in asked.free:
                opposite = asked.right.at(asked.random | {each.name: -asked.random[each.name]})
                is_even = np.allclose(opposite, asked.right.at(asked.random), rtol=1e-12)
                for other in ("(-{})", "abs({})", "(-abs({}))"):
                    line = re.sub(rf"\b{each.name}\b", other.format(each.name), asked.right.text)
                    if "abs" in other and not is_even and each.low * each.high >= 0:
                        single.add(f"{function}.{each.name}")
                    else:
                        assert (difference(asked, line) == "") == is_even, line
    listed = " ".join(ONE_SIGN.values()).split()
    assert single == {name for name in listed if name.partition(".")[0] in hints(topic).guides}


def test_a_line_is_told_the_value_of_a_quantity_that_follows_from_another():
    assert difference(LEAN, "i * c * s").startswith("At i = 2, c = 1 and s = 0 your line gives 0; the equation")


def test_a_wrong_line_is_tried_first_at_the_sign_of_the_longer_side():
    asked = derivation("y = 3 * x\nx: m, -5 to 4")
    assert difference(asked, "x").startswith("At x = −1 your")
    assert difference(asked, "3 * abs(x)").startswith("At x = −1 your")
    assert difference(asked, "-3 * abs(x)").startswith("At x = 1 your")


def test_a_wrong_line_is_told_the_roundest_numbers_and_not_the_formula():
    said = difference(IMPULSE, "-(1 - e) * u / k")
    assert said == "At u = −1, e = 0.5 and k = 2 your line gives 0.25; the equation holds for 0.75."


def test_round_numbers_of_a_small_range_have_its_size():
    said = difference(SHARE, "1 - w / d")  # differs only where the step is shorter than the way
    assert said == "At w = 0.03 and d = 0.02 your line gives −0.5; the equation holds for 0."


@pytest.mark.parametrize(
    ("line", "slip"),
    [
        ("(1 + e) * u / k", "Yours is −1 times what is needed, whatever the numbers: look for a sign."),
        ("-2 * (1 + e) * u / k", "Yours is 2 times what is needed, whatever the numbers: look for a factor."),
        ("-(1 + e) * u", ""),
        ("0", ""),
    ],
)
def test_a_constant_ratio_is_named_as_a_sign_or_a_factor(line, slip):
    said = difference(IMPULSE, line)
    assert said.endswith(slip or ".")
    assert ("times" in said) == bool(slip)


def test_a_term_that_vanishes_at_round_numbers_is_still_missed():
    asked = derivation("y = x + sin(3.141592653589793 * x)\nx: 1, 1 to 5")
    assert "At x = 2.12 your line gives 2.12; the equation holds for 2.489." in difference(asked, "x")


@pytest.mark.parametrize("line", ["sqrt(u)", "1 / 0", "9 ** 9 ** 9 ** 9", "1e299 * 1e299"])
def test_a_line_without_a_value_is_wrong_and_says_so(line):
    assert "your line gives no number" in difference(IMPULSE, line)


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("-(1 + e) * v / k", "unknown quantity 'v'. Choices: u, e, k."),
        ("2u", "a product without \\*"),
        ("u^2", "write \\*\\* for it"),
        ("e(u)", "a \\* is missing between e and"),
        ("2(u)", "a \\* is missing before a bracket"),
        ("sqrt(u, k)", "sqrt takes one value"),
        ("max(u)", "max takes two values or more"),
        ("__import__('os').system('true')", "is not understood here"),
        ("u.real", "is not understood here"),
        ("[u][0]", "is not understood here"),
        ("u if e else k", "is not understood here"),
        ("max(*u)", "max takes|not understood"),
        ("sqrt(x=u)", "is not understood here"),
        ("'u'", "is not understood here"),
        ("True", "is not understood here"),
        ("1j", "is not understood here"),
        ("1" * 400, "is not understood here"),
        ("u" * 501, "501 characters"),
    ],
)
def test_anything_but_a_formula_is_refused_in_words(line, said):
    with pytest.raises(InvalidInput, match=said):
        difference(IMPULSE, line)


@pytest.mark.parametrize(
    ("block", "said"),
    [
        ("u / k\nu: a, 0 to 1", "is no line such as"),
        ("j = u\nu: velocity", "is no quantity such as"),
        ("j = u\nu: velocity, 2 to 1", "is empty"),
        ("j = u\nu: velocity, a to 1", "is not two numbers"),
        ("j = u\nj: impulse, N s", "names no quantities"),
        ("j = 1 + s\ns: sine, = 1 / 2", "names no quantities"),
        ("j = s\ns: sine, = sqrt(c)\nc: cosine, 0 to 1", "unknown quantity 'c'"),
        ("j = u / v\nu: velocity, 0 to 1", "unknown quantity 'v'"),
        ("j = sqrt(u)\nu: velocity, -2 to 1", "has no value somewhere"),
    ],
)
def test_a_block_that_asks_for_nothing_sensible_is_refused(block, said):
    with pytest.raises(InvalidInput, match=said):
        derivation(block)
