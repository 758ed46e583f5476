"""The slides' symbols and what they are called in code: one word a thing, the same in functions, docs and axes."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Symbol:
    """One thing. slide: as the slides write it. name: in code. unit: SI. meaning: with sign and frame.

    statements: numbers of those that use it. here: how our own formulas write it, where that differs. of: a function
    that takes it, or, where it is an answer, the function that gives it.
    """

    slide: str
    name: str
    unit: str
    meaning: str
    statements: tuple[int, ...]
    here: str
    of: str


SYMBOLS: tuple[Symbol, ...] = (
    Symbol("(a, b, c)", "normal", "1", "normal of a plane, any length", (4,), "n", "signed_distance"),
    Symbol("d", "offset", "m", "of the plane n·p + d = 0, for a unit normal", (4,), "d", "signed_distance"),
    Symbol("(x, y, z)", "point", "m", "a point", (4,), "p", "signed_distance"),
    Symbol("a x + b y + c z + d", "separation", "m", "signed distance, negative behind", (4,), "s", "side_of_plane"),
    Symbol("t", "t", "s", "start of a step", (5,), "t", "time_of_impact_interpolated"),
    Symbol("Δt", "dt", "s", "length of a step", (5, 13), "Δt", "time_of_impact_interpolated"),
    Symbol("d1", "separation_0", "m", "signed distance at its start", (5,), "s0", "time_of_impact_interpolated"),
    Symbol("d2", "separation_1", "m", "signed distance at its end: −d2", (5,), "s1", "time_of_impact_interpolated"),
    Symbol("T", "time_of_impact", "s", "from the start of the step, or as a time", (5, 6), "T", "respond_at_impact"),
    Symbol("N", "normal", "1", "unit normal of the plane, out of it", (7, 8), "n", "kinematic_response"),
    Symbol("v", "velocity", "m/s", "of a body's centre of mass", (7, 14), "v", "kinematic_response"),
    Symbol("k (spring)", "stiffness", "N/m", "of a penalty spring, a spring", (8, 27, 29), "k", "penalty_force"),
    Symbol("d (spring)", "separation", "m", "depth −s of a penetration", (8,), "d = −s", "penalty_force"),
    Symbol("k_damping, k_damper", "damping", "N s/m", "of a damper", (29,), "c, k_d", "damper_force"),
    Symbol("ε", "restitution", "1", "share of the closing speed kept, 0 to 1", (12, 20), "e", "rebound_velocity"),
    Symbol(
        "v_rel", "normal_velocity", "m/s", "n·u, negative when approaching", (12, 19, 21), "u_n", "rebound_velocity"
    ),
    Symbol("J", "impulse", "N s", "on A; −J on B", (13, 16, 21), "J = j n", "apply_impulse"),
    Symbol("j", "magnitude", "N s", "of an impulse along the normal", (13, 18, 20), "j", "contact_impulses"),
    Symbol("F", "force", "N", "force", (13,), "F", "impulse_of_force"),
    Symbol("P", "momentum", "N s", "M v", (13, 21), "P", "velocities_from_momenta"),
    Symbol("L", "angular_momentum", "N m s", "about the centre of mass", (21,), "L", "velocities_from_momenta"),
    Symbol(
        "p_A(t)",
        "point_velocity_a",
        "m/s",
        "velocity of A's point: a dot is lost",
        (14, 19),
        "ṗ_A",
        "relative_velocity",
    ),
    Symbol("ω", "angular_velocity", "rad/s", "world frame", (14, 18), "ω", "point_velocity"),
    Symbol(
        "r_A", "arm", "m", "from the centre of mass to the contact, world frame", (14, 18, 20), "r", "point_velocity"
    ),
    Symbol("n", "normal", "1", "unit normal of a contact, from B to A", (13, 17, 18), "n", "contact_impulses"),
    Symbol("A × B", "edge_a, edge_b", "m", "two edges, of any length", (17,), "a × b", "edge_edge_normal"),
    Symbol("1/M", "inverse_mass", "1/kg", "0 for what cannot be moved", (18, 20), "1/M", "velocities_from_momenta"),
    Symbol(
        "I⁻¹(t)", "inverse_inertia", "1/(kg m²)", "world frame, turns along", (18, 20), "I⁻¹", "velocities_from_momenta"
    ),
    Symbol(
        "threshold", "threshold", "m/s", "slowest normal velocity that is no rest", (21,), "u_min", "classify_contact"
    ),
    Symbol("F_N", "normal_force", "N", "with which a surface carries", (24,), "N", "friction_force"),
    Symbol("μ_s", "static_friction", "1", "coefficient of a pair at rest", (24,), "μ_s", "friction_force"),
    Symbol("μ_k", "kinetic_friction", "1", "coefficient of a pair that slides", (24,), "μ_k", "friction_force"),
    Symbol("m", "mass", "kg", "of a body", (25, 26), "m", "uniform_gravity"),
    Symbol("g", "gravity", "m/s²", "acceleration of free fall, down", (25, 26), "g", "uniform_gravity"),
    Symbol("n (liquid)", "viscosity", "Pa s", "dynamic viscosity", (26,), "η", "stokes_drag"),
    Symbol("r (ball)", "radius", "m", "of a sphere", (9, 26), "r", "terminal_velocity"),
    Symbol("x", "position", "m", "of a mass, a body's centre", (27,), "x", "ballistic_motion"),
    Symbol("x_rest", "rest_length", "m", "of a spring that pulls at nothing", (27, 29), "L0", "spring_force"),
)
"""In the order of the slides."""
