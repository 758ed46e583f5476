"""The functions of the hand-written side: which topic and step each belongs to, and who writes it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from reference.errors import UnknownName
from reference.lecture.topics import topic

Role = Literal["written", "given", "read"]
"""A function is written by the student, given to them to use, or shown for them to read."""


@dataclass(frozen=True)
class Function:
    """One function of the hand-written side.

    name: as it is called. topic: the name of the topic whose module holds it. step: of the lab in which it comes, from
    1; a step may have several. statement: the number of the statement that it puts into code. role: who writes it.
    begun: the step in which a student writes a first version of it, if that is an earlier one.
    """

    name: str
    topic: str
    step: int
    statement: int
    role: Role
    begun: int | None = None

    @property
    def first_step(self) -> int:
        """The step from which on a student may have it."""
        return self.step if self.begun is None else self.begun


_FUNCTIONS = (
    Function("signed_distance", "detection", 1, 4, "written"),
    Function("is_colliding", "detection", 2, 4, "read"),
    Function("side_of_plane", "detection", 2, 4, "written"),
    Function("time_of_impact_interpolated", "detection", 3, 5, "written"),
    Function("count_impacts", "detection", 3, 3, "written"),
    Function("time_of_impact_exact", "detection", 4, 5, "written"),
    Function("overlap_interval", "detection", 5, 2, "written"),
    Function("missing_probability", "detection", 6, 9, "written"),
    Function("kinematic_response", "response", 2, 7, "written", begun=1),
    Function("respond_at_step", "response", 3, 6, "written"),
    Function("bounce", "response", 3, 6, "written"),
    Function("respond_at_impact", "response", 4, 6, "written"),
    Function("time_until_rest", "response", 4, 3, "read"),
    Function("bounce_along_normal", "response", 4, 3, "read"),
    Function("bounce_through_step", "response", 4, 3, "read"),
    Function("penalty_force", "response", 5, 8, "written"),
    Function("penalty_rest_depth", "response", 5, 8, "given"),
    Function("penalty_step_limit", "response", 6, 8, "written"),
    Function("penalty_restitution", "response", 7, 8, "read"),
    Function("penalty_damping", "response", 7, 8, "given"),
    Function("design_contact", "response", 7, 8, "written"),
    Function("hertz_stiffness", "response", 7, 8, "read"),
    Function("hertz_force", "response", 7, 8, "read"),
    Function("hertz_largest_depth", "response", 7, 8, "read"),
    Function("hertz_contact_time", "response", 7, 8, "read"),
    Function("hertz_restitution", "response", 7, 8, "read"),
    Function("hertz_damping", "response", 7, 8, "read"),
    Function("tangential_spring", "response", 7, 8, "read"),
    Function("holds", "friction", 1, 24, "given"),
    Function("support_force", "friction", 2, 24, "written"),
    Function("friction_force", "friction", 3, 24, "written", begun=1),
    Function("sliding_motion", "friction", 4, 24, "written", begun=1),
    Function("clamp_to_circle", "friction", 5, 24, "written"),
    Function("clamp_to_square", "friction", 5, 24, "given"),
    Function("roll_step", "friction", 6, 24, "written"),
    Function("break_away_time", "friction", 7, 24, "written"),
    Function("point_inverse_mass", "friction", 8, 16, "given"),
    Function("friction_impulse", "friction", 8, 16, "read"),
    Function("impact_energy", "friction", 8, 16, "given"),
    Function("sphere_impact", "friction", 8, 16, "read"),
    Function("dissipative_impulse", "friction", 8, 16, "read"),
    Function("poisson_impulse", "friction", 8, 16, "read"),
    Function("stronge_impulse", "friction", 8, 16, "read"),
    Function("rebound_velocity", "impulse", 1, 12, "given"),
    Function("classify_contact", "impulse", 1, 21, "given"),
    Function("impulse_of_force", "impulse", 1, 13, "given"),
    Function("mean_force", "impulse", 1, 13, "read"),
    Function("point_velocity", "impulse", 2, 14, "read"),
    Function("relative_velocity", "impulse", 2, 15, "read"),
    Function("normal_velocity", "impulse", 2, 19, "written"),
    Function("point_plane_normal", "impulse", 3, 17, "read"),
    Function("edge_edge_normal", "impulse", 3, 17, "written"),
    Function("sphere_inertia", "impulse", 4, 18, "given"),
    Function("box_inertia", "impulse", 4, 18, "given"),
    Function("rod_inertia", "impulse", 4, 18, "given"),
    Function("rotation_matrix", "impulse", 4, 18, "given"),
    Function("world_inertia", "impulse", 4, 18, "read"),
    Function("world_inverse_inertia", "impulse", 4, 18, "written"),
    Function("inverse_effective_mass", "impulse", 5, 20, "written"),
    Function("impulse_magnitude", "impulse", 5, 20, "written"),
    Function("contact_impulses", "impulse", 6, 16, "read"),
    Function("apply_impulse", "impulse", 6, 18, "written"),
    Function("apply_impulse_to_momenta", "impulse", 7, 21, "read"),
    Function("velocities_from_momenta", "impulse", 7, 21, "read"),
    Function("collide", "impulse", 7, 11, "written", begun=1),
    Function("energy_lost", "impulse", 7, 20, "read"),
    Function("mass_and_inertia", "impulse", 8, 21, "given"),
    Function("audit", "impulse", 8, 21, "written"),
    Function("face_planes", "polyhedra", 1, 9, "written"),
    Function("signed_volume", "polyhedra", 1, 9, "given"),
    Function("convex_separation", "polyhedra", 2, 9, "written"),
    Function("inside_convex", "polyhedra", 2, 9, "read"),
    Function("segment_triangle", "polyhedra", 3, 9, "written"),
    Function("segment_plane", "polyhedra", 3, 9, "read"),
    Function("side_of_line", "polyhedra", 4, 9, "written"),
    Function("orient2d", "polyhedra", 4, 9, "given"),
    Function("orient3d", "polyhedra", 4, 9, "given"),
    Function("inside_by_parity", "polyhedra", 5, 9, "written"),
    Function("mesh_report", "polyhedra", 6, 9, "given"),
    Function("solid_angle", "polyhedra", 6, 9, "given"),
    Function("winding_number", "polyhedra", 6, 9, "written"),
    Function("inside_by_winding", "polyhedra", 6, 9, "read"),
    Function("segment_meets_triangle", "polyhedra", 7, 9, "given"),
    Function("mesh_edges", "polyhedra", 7, 9, "given"),
    Function("edges_through_faces", "polyhedra", 7, 9, "given"),
    Function("polyhedra_intersect", "polyhedra", 7, 9, "written"),
    Function("ray_sphere", "sweeping", 1, 10, "written"),
    Function("relative_motion", "sweeping", 2, 10, "read"),
    Function("sweep_sphere_sphere", "sweeping", 2, 10, "written", begun=1),
    Function("sweep_sphere_plane", "sweeping", 2, 10, "read"),
    Function("missed_share", "sweeping", 3, 10, "written"),
    Function("ray_box", "sweeping", 4, 10, "written"),
    Function("ray_capsule", "sweeping", 5, 10, "written"),
    Function("nearest_on_triangle", "sweeping", 5, 10, "given"),
    Function("motion_bound", "sweeping", 6, 10, "written"),
    Function("rotated", "sweeping", 6, 10, "given"),
    Function("separation_of_hulls", "sweeping", 7, 10, "given"),
    Function("advance", "sweeping", 7, 10, "written"),
    Function("sweep_convex", "sweeping", 7, 10, "read"),
    Function("vertex_face_impact", "sweeping", 7, 10, "read"),
    Function("edge_edge_impact", "sweeping", 7, 10, "read"),
    Function("uniform_gravity", "forces", 1, 25, "given"),
    Function("universal_gravity", "forces", 1, 25, "written"),
    Function("ballistic_motion", "forces", 1, 25, "given"),
    Function("surface_gravity", "forces", 1, 25, "read"),
    Function("universal_gravity_energy", "forces", 1, 25, "given"),
    Function("mutual_gravity", "forces", 1, 25, "given"),
    Function("semi_implicit_euler", "forces", 1, 30, "given"),
    Function("explicit_euler", "forces", 2, 30, "written"),
    Function("velocity_verlet", "forces", 2, 30, "read"),
    Function("runge_kutta_4", "forces", 2, 30, "read"),
    Function("implicit_euler", "forces", 2, 30, "read"),
    Function("spring_force", "forces", 3, 27, "read"),
    Function("spring_energy", "forces", 3, 27, "given"),
    Function("damper_force", "forces", 3, 29, "read"),
    Function("spring_damper_force", "forces", 3, 27, "written"),
    Function("natural_frequency", "forces", 4, 27, "given"),
    Function("damping_ratio", "forces", 4, 29, "given"),
    Function("spring_step_limit", "forces", 4, 29, "written"),
    Function("damped_oscillator", "forces", 4, 29, "read"),
    Function("driven_oscillator", "forces", 4, 29, "read"),
    Function("friction_oscillator", "forces", 4, 23, "read"),
    Function("sphere_shape_factor", "forces", 5, 26, "given"),
    Function("stokes_drag", "forces", 5, 26, "written"),
    Function("relaxation_time", "forces", 5, 26, "given"),
    Function("spheroid_shape_factors", "forces", 5, 26, "read"),
    Function("buoyancy", "forces", 6, 26, "given"),
    Function("terminal_velocity", "forces", 6, 26, "written"),
    Function("drag_motion", "forces", 6, 26, "given"),
    Function("reynolds_number", "forces", 6, 26, "given"),
    Function("check_stokes_regime", "forces", 6, 26, "read"),
    Function("drag_correction", "forces", 6, 26, "read"),
    Function("terminal_velocity_corrected", "forces", 6, 26, "read"),
    Function("wind_force", "forces", 7, 30, "written"),
    Function("sample_field", "forces", 7, 30, "read"),
    Function("total_force", "forces", 8, 30, "written"),
    Function("evaluate_forces", "forces", 8, 30, "read"),
    Function("acceleration_of", "forces", 8, 23, "read"),
    Function("audit_energy", "forces", 8, 30, "read"),
    Function("cloth", "meshes", 1, 28, "given"),
    Function("spring_mesh", "meshes", 1, 28, "given"),
    Function("pin", "meshes", 1, 28, "given"),
    Function("mesh_forces", "meshes", 2, 29, "written", begun=1),
    Function("mesh_step", "meshes", 3, 28, "written", begun=1),
    Function("edge_directions", "meshes", 3, 28, "read"),
    Function("edge_strain", "meshes", 3, 28, "given"),
    Function("mesh_energy", "meshes", 3, 28, "read"),
    Function("lattice", "meshes", 4, 28, "given"),
    Function("diagonals", "meshes", 4, 28, "written"),
    Function("zero_energy_modes", "meshes", 4, 28, "given"),
    Function("static_shape", "meshes", 4, 28, "read"),
    Function("timestep_bound", "meshes", 5, 28, "written"),
    Function("largest_eigenvalue", "meshes", 5, 28, "given"),
    Function("stable_timestep", "meshes", 5, 28, "read"),
    Function("mesh_sphere_contact", "meshes", 6, 28, "written"),
    Function("limit_strain", "meshes", 7, 28, "written"),
    Function("edge_stiffness", "meshes", 8, 28, "read"),
    Function("edge_damping", "meshes", 8, 29, "read"),
    Function("mesh_product", "meshes", 8, 28, "read"),
    Function("mesh_matrix", "meshes", 8, 28, "read"),
    Function("conjugate_gradient", "meshes", 8, 28, "read"),
    Function("implicit_mesh_step", "meshes", 8, 28, "read"),
    Function("seek", "avoidance", 1, 1, "written"),
    Function("flee", "avoidance", 1, 1, "read"),
    Function("limited", "avoidance", 1, 1, "given"),
    Function("steering_force", "avoidance", 1, 1, "given"),
    Function("arrive", "avoidance", 2, 1, "written"),
    Function("repelling_force", "avoidance", 3, 1, "written"),
    Function("sphere_force", "avoidance", 3, 1, "read"),
    Function("tangent_point", "avoidance", 4, 1, "written"),
    Function("side_of", "avoidance", 4, 1, "given"),
    Function("is_in_the_way", "avoidance", 4, 1, "given"),
    Function("steer_around", "avoidance", 4, 1, "read"),
    Function("nearest_approach", "avoidance", 5, 1, "written"),
    Function("separation", "avoidance", 6, 1, "written"),
    Function("towards_mean", "avoidance", 6, 1, "written"),
    Function("neighbour_pairs", "avoidance", 6, 1, "given"),
    Function("flock_step", "avoidance", 6, 1, "read"),
    Function("orca_half_plane", "avoidance", 7, 1, "written"),
    Function("cap_of_cone", "avoidance", 7, 1, "given"),
    Function("permitted_velocity", "avoidance", 7, 1, "read"),
    Function("crowd_step", "avoidance", 7, 1, "read"),
    Function("rotate_by_momentum", "world", 2, 18, "written"),
    Function("turn_freely", "world", 2, 18, "read"),
    Function("mass_properties", "world", 2, 18, "read"),
    Function("turned", "world", 2, 18, "given"),
    Function("inverse_inertias", "world", 2, 18, "given"),
    Function("candidate_pairs", "world", 3, 2, "written"),
    Function("pairs_in_grid", "world", 3, 2, "read"),
    Function("collect_contacts", "world", 3, 17, "written"),
    Function("find_contacts", "world", 3, 17, "read"),
    Function("manifolds", "world", 3, 17, "given"),
    Function("contacts_by_pair", "world", 4, 21, "given"),
    Function("collide_with_friction", "world", 4, 16, "given"),
    Function("propagate_impacts", "world", 5, 22, "written"),
    Function("simultaneous_impacts", "world", 5, 22, "read"),
    Function("contact_jacobian", "world", 6, 22, "given"),
    Function("contact_frames", "world", 6, 22, "given"),
    Function("inverse_mass_matrix", "world", 6, 22, "given"),
    Function("resting_problem", "world", 6, 22, "written"),
    Function("complementarity_residual", "world", 7, 22, "given"),
    Function("solve_by_sweeps", "world", 7, 22, "written"),
    Function("solve_by_pivots", "world", 7, 22, "read"),
    Function("sequential_impulses", "world", 8, 22, "given"),
    Function("respond", "world", 8, 21, "written", begun=4),
    Function("kept_impulses", "world", 9, 22, "given"),
    Function("out_of_overlap", "world", 9, 22, "given"),
    Function("step_world", "world", 9, 3, "written", begun=1),
    Function("make_bodies", "world", 9, 11, "read"),
    Function("make_state", "world", 9, 11, "read"),
    Function("advance_world", "world", 9, 3, "read"),
)

FUNCTIONS: dict[str, Function] = {entry.name: entry for entry in _FUNCTIONS}
"""The functions of the hand-written side by name."""


def function(name: str) -> Function:
    """Return the function of that name.

    Raises
    ------
    UnknownName
        If the lecture has no such function.
    """
    try:
        return FUNCTIONS[name]
    except KeyError:
        raise UnknownName("function", name, FUNCTIONS) from None


def functions_of(topic_name: str) -> tuple[Function, ...]:
    """Return the functions of a topic in the order of its steps; none where the topic has no functions yet.

    Raises
    ------
    UnknownName
        If the lecture has no such topic.
    """
    name = topic(topic_name).name
    return tuple(sorted((entry for entry in _FUNCTIONS if entry.topic == name), key=lambda entry: entry.step))
