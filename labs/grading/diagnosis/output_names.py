"""What each thing is called that a function returns, for functions that return several; as its description calls it."""

from __future__ import annotations

from collections.abc import Sequence

_VELOCITIES = ("v_A", "ω_A", "v_B", "ω_B")
OUTPUT_NAMES: dict[str, tuple[str, ...]] = {
    "count_impacts": ("count", "position"),
    "overlap_interval": ("start", "end"),
    "respond_at_step": ("position", "velocity"),
    "respond_at_impact": ("position", "velocity"),
    "sliding_motion": ("position", "velocity", "stopping time"),
    "support_force": ("normal force", "along"),
    "roll_step": ("velocity", "spin"),
    "resting_problem": ("A", "b"),
    "apply_impulse": _VELOCITIES,
    "collide": _VELOCITIES,
    "audit": ("ΔP", "ΔL", "ΔE"),
    "face_planes": ("normal", "offset"),
    "convex_separation": ("separation", "face"),
    "segment_triangle": ("fraction", "barycentric"),
}


def output_names(function: str) -> tuple[str, ...]:
    """The names of what a function returns; none for a single thing."""
    return OUTPUT_NAMES.get(function, ())


def labelled(values: Sequence[str], names: Sequence[str]) -> str:
    """Several things in a line, each with its name if there is one for each."""
    if len(names) != len(values):
        return ", ".join(values)
    return ", ".join(f"{name}={value}" for name, value in zip(names, values, strict=True))
