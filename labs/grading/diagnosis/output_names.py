"""What each thing is called that a function returns, as its description calls it, and how its axes lie."""

from __future__ import annotations

from collections.abc import Sequence

_VELOCITIES = ("v_A", "ω_A", "v_B", "ω_B")
OUTPUT_NAMES: dict[str, tuple[str, ...]] = {
    "count_impacts": ("count", "position"),
    "overlap_interval": ("start", "end"),
    "bounce": ("positions", "velocities"),
    "design_contact": ("stiffness", "damping", "timestep"),
    "respond_at_step": ("position", "velocity"),
    "respond_at_impact": ("position", "velocity"),
    "sliding_motion": ("position", "velocity", "stopping time"),
    "support_force": ("normal force", "along"),
    "roll_step": ("velocity", "spin"),
    "resting_problem": ("A", "b"),
    "rotate_by_momentum": ("orientation", "angular velocity"),
    "collect_contacts": ("body_a", "body_b", "point", "normal", "separation", "key"),
    "respond": ("velocity", "angular velocity", "impulse"),
    "step_world": ("position", "orientation", "velocity", "angular velocity", "key", "impulse"),
    "apply_impulse": _VELOCITIES,
    "collide": _VELOCITIES,
    "audit": ("ΔP", "ΔL", "ΔE"),
    "face_planes": ("normal", "offset"),
    "convex_separation": ("separation", "face"),
    "segment_triangle": ("fraction", "barycentric"),
    "ray_box": ("entry", "exit"),
    "advance": ("time", "used"),
    "explicit_euler": ("position", "velocity"),
    "spring_step_limit": ("explicit", "semi-implicit"),
    "mesh_step": ("position", "velocity"),
    "mesh_sphere_contact": ("position", "velocity"),
    "nearest_approach": ("time", "separation"),
    "orca_half_plane": ("point", "normal"),
}
ROWS: dict[str, tuple[tuple[int, ...], str]] = {
    "candidate_pairs": ((0,), "pair"),
    "collect_contacts": ((0, 1, 2, 3, 4, 5), "contact"),
    "step_world": ((4, 5), "contact"),
}
"""Of functions that find some number of things: which of the outputs have a row for each, and what a thing is."""
_OF_RUNS = ("bounce",)
"""Functions that return a run: the first axis of each thing counts its steps, the next ones the cases."""


def output_names(function: str) -> tuple[str, ...]:
    """The names of what a function returns; none for a single thing."""
    return OUTPUT_NAMES.get(function, ())


def rows_of(function: str) -> tuple[tuple[int, ...], str]:
    """The places of the outputs that have a row for each thing that the function finds, and what it finds."""
    return ROWS.get(function, ((), "row"))


def axes_before(function: str) -> int:
    """How many axes of what a function returns come before those of the cases of a call."""
    return 1 if function in _OF_RUNS else 0


def labelled(values: Sequence[str], names: Sequence[str]) -> str:
    """Several things in a line, each with its name if there is one for each."""
    if len(names) != len(values):
        return ", ".join(values)
    return ", ".join(f"{name}={value}" for name, value in zip(names, values, strict=True))
