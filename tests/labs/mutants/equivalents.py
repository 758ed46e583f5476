"""Mutants that no check can notice, each with the reason: they give the same numbers wherever a function may be called.

By the function in whose source the change is made, then by the reason. In a line, … stands for anything. What is
listed for a function holds wherever that function is called as well.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from mutants.making import Mutant
from reference import lecture

ROUNDING = "It only keeps rounding from a root of a negative number."
FIRST_OF_BOTH = "On the boundary both branches give the same number."
SYMMETRIC = "The matrix is symmetric."
TWICE = "It enters twice, so that its sign drops out."
SHORTENED = "The vector is divided by its length afterwards, and may be longer or shorter before."
ORDER = "The order does not matter."
NOT_OF_THE_VELOCITIES = "How easily two bodies give way does not depend on how they move."
LEVER = "Without a lever r × n is zero except for rounding, and adds nothing."
ONLY_WHETHER_ZERO = "Only whether the vector is zero counts."
ONLY_THE_SHAPE = "Only the shape of what is broadcast together counts."
NOT_NEGATIVE = "What the size is taken of is never negative."
PLANE_AT_REST = "It has no plane that moves."
OF_A_PLANE_AT_REST = (
    "in kinematic_response: term dropped: velocity - plane_velocity → velocity",
    "in kinematic_response: sign flipped: velocity - plane_velocity → velocity + plane_velocity",
    "in kinematic_response: size for it: velocity - plane_velocity → velocity - np.abs(plane_velocity)",
)

ONE_MESH = "There is one mesh in a call."
POSITIVE_PARTS = tuple(f"{part} of mesh: size for it" for part in ("rest_length", "stiffness", "damping", "mass"))

ANY_NEGATIVE = "NumPy takes any negative number for the length that is left over."

EQUIVALENT: dict[str, dict[str, tuple[str, ...]]] = {
    "time_of_impact_interpolated": {
        "Only a separation that is positive at the start crosses zero.": (
            "size for it: separation_0 - separation_1 → np.abs(separation_0) - separation_1",
        ),
        NOT_NEGATIVE: ("size for it: t + dt * fraction → t + np.abs(dt * fraction)",),
    },
    "count_impacts": {"A puck at rest is done with before.": ("boundary: v > 0 → v >= 0",)},
    "time_of_impact_exact": {
        "This root is taken only while the body does not approach, and then the velocity is not negative.": (
            "size for it: u + root → np.abs(u) + root",
        ),
        "The root of a negative number is not used.": (
            "limit dropped: np.maximum(arrival_squared, 0.0) → shaped(arrival_squared, 0.0)",
        ),
        "By zero the quotient is infinite as well.": ("boundary: denominator > 0 → denominator >= 0",),
        NOT_NEGATIVE: (
            "size for it: u * u - 2 * a * s → np.abs(u * u) - 2 * a * s",
            "size for it: root - u → np.abs(root) - u",
            "size for it: u + root → u + np.abs(root)",
            "size for it: quotient(numerator, …",
        ),
    },
    "overlap_interval": {
        NOT_NEGATIVE: (
            "size for it: r - x → np.abs(r) - x",
            "size for it: w + r → …",
            "size for it: (np.where(meets, start, np.inf), …) → (np.abs(np.where(meets, start, np.inf)), …",
        ),
    },
    "missing_probability": {
        "From a ratio of 1 on, none is missed.": ("twice the number: 1.0 → 2.0",),
        NOT_NEGATIVE: ("size for it: …",),
    },
    "kinematic_response": {NOT_NEGATIVE: ("size for it: 1 + restitution → …",)},
    "respond_at_step": {PLANE_AT_REST: OF_A_PLANE_AT_REST},
    "bounce": {
        PLANE_AT_REST: OF_A_PLANE_AT_REST,
        ONLY_THE_SHAPE: ("results swapped: (offset, restitution, dt) → …",),
    },
    "respond_at_impact": {PLANE_AT_REST: OF_A_PLANE_AT_REST, NOT_NEGATIVE: ("size for it: dt - before → …",)},
    "penalty_force": {
        "Only a body behind the plane is pushed, and then the depth is positive.": (
            "size for it: stiffness * depth - damping * normal_velocity → np.abs(stiffness * depth) - …",
        ),
    },
    "penalty_step_limit": {NOT_NEGATIVE: ("size for it: …",)},
    "design_contact": {
        TWICE: ("speed: sign flipped", "depth: sign flipped"),
        NOT_NEGATIVE: ("size for it: …",),
    },
    "frequency_and_ratio": {NOT_NEGATIVE: ("size for it: …",)},
    "friction_force": {
        ONLY_WHETHER_ZERO: (
            "largest component: np.linalg.norm(tangent_velocity, axis=-1) → …",
            "sum of components: np.linalg.norm(tangent_velocity, axis=-1) → …",
        ),
    },
    "sliding_motion": {
        NOT_NEGATIVE: ("size for it: dt[..., None] - sliding_time → …", "size for it: (p, … np.abs(stopping_time))"),
        "At the stop v + a t is zero, except for rounding.": (
            "branch dropped: np.where(stops[..., None], 0.0, v + a * sliding_time) → shaped(v + a * sliding_time…",
        ),
        "Where the body does not stop, nothing is left of the step.": (
            "branch dropped: np.where(stops[..., None], acceleration(v), 0.0) → shaped(acceleration…",
        ),
    },
    "clamp_to_circle": {FIRST_OF_BOTH: ("boundary: size > limit → size >= limit",)},
    "support_force": {NOT_NEGATIVE: ("size for it: (normal_force, … → (np.abs(normal_force), …",)},
    "roll_step": {
        "The velocity and the impulse lie along the floor, and the arm is vertical.": (
            "velocity: axis 2 left out",
            "in clamp_to_circle: axis 2 left out: np.linalg.norm(tangent_force, axis=-1) → …",
            "axis 2 left out: np.cross(spin, arm) → …",
            "axis 0 left out: np.cross(arm, impulse) → np.cross(without(0, arm), impulse)",
            "axis 1 left out: np.cross(arm, impulse) → np.cross(without(1, arm), impulse)",
            "axis 2 left out: np.cross(arm, impulse) → without(2, np.cross(arm, impulse))",
        ),
    },
    "break_away_time": {
        "This quotient is taken only where b is positive.": ("size for it: b + root → np.abs(b) + root",),
        NOT_NEGATIVE: (
            "size for it: np.vecdot(along_rate, along_rate) - …",
            "size for it: np.vecdot(along, along) - …",
            "size for it: mu ** 2 * np.vecdot(spread, spread) - …",
            "size for it: b + root → b + np.abs(root)",
            "size for it: root - b → np.abs(root) - b",
            "size for it: np.where(held, …",
        ),
        "Only its square is used.": (
            "sign flipped: press[..., None] * along_rate - … → press_rate[…",
            "cross product turned round: np.cross(along, along_rate) → np.cross(along_rate, along)",
        ),
        "What is held is within the limit, except for rounding.": (
            "limit dropped: np.minimum(0.0, np.vecdot(along, along) - … → shaped(np.vecdot…",
        ),
        ROUNDING: ("limit dropped: np.maximum(0.0, discriminant) → shaped(discriminant, 0.0)",),
    },
    "propagate_impacts": {
        "Only the ratios of the masses count.": ("mass: sign flipped",),
        NOT_NEGATIVE: (
            "size for it: 1 + e[i] → 1 + np.abs(e[i])",
            "size for it: w[i] + w[i + 1] → …",
            "size for it: … + np.abs(j * w[i + 1])",
            "size for it: … - np.abs(j * w[i])",
        ),
        "More sweeps change nothing any longer.": ("one for the other: v → w (2)", "one for the other: v → w (9)"),
    },
    "_row": {
        "Only the ratios of the masses count.": ("twice the number: 1 → 2", "half the number: 1 → 0.5"),
        NOT_NEGATIVE: (
            "size for it: (w, …) → (np.abs(w), …",
            "size for it: (w, …) → (w, np.abs(…",
            "size for it: count - 1 → np.abs(count) - 1",
        ),
    },
    "solve_by_sweeps": {
        "A force of the step before is never negative, and no other is.": (
            "start: size for it",
            "size for it: f[..., i] - … → np.abs(f[..., i]) - …",
            "size for it: f → np.abs(f)",
        ),
        "The first contact is solved before its force is used.": ("start: axis 0 left out",),
    },
    "normal_velocity": {
        "How fast the points part depends on neither mass nor inertia.": (
            "inverse_mass of body_…",
            "inverse_inertia of body_…",
        ),
    },
    "edge_edge_normal": {
        "The product of two edges that are both turned round is the same.": ("edge_a and edge_b: sign flipped",),
        SHORTENED: ("length kept: direction(edge_…",),
    },
    "world_inverse_inertia": {
        "q and −q are the same rotation.": ("orientation: sign flipped",),
        NOT_NEGATIVE: ("inertia: size for it",),
    },
    "inverse_effective_mass": {
        NOT_OF_THE_VELOCITIES: (
            "velocity of body_…",
            "angular_velocity of body_…",
        ),
        TWICE: ("arm of body_…: sign flipped", "normal: sign flipped"),
        NOT_NEGATIVE: ("size for it: …",),
    },
    "impulse_magnitude": {
        NOT_NEGATIVE: ("size for it: 1 + restitution → …",),
        "It only keeps rounding from giving a negative number.": (
            "limit dropped: np.maximum(k, 0.0) → shaped(k, 0.0)",
        ),
    },
    "velocity_changes": {
        SYMMETRIC: ("transposed: inverse_inertia @ np.cross(r, impulse)[..., None] → …",),
    },
    "_gained": {SYMMETRIC: ("transposed: inertia @ turn[..., None] → …",)},
    "_softness": {
        NOT_NEGATIVE: ("size for it: …",),
        LEVER: (
            "boundary: lever > NO_LEVER * np.linalg.norm(r, axis=-1) → …",
            "condition dropped: lever > NO_LEVER * np.linalg.norm(r, axis=-1) → always(…",
            "branch dropped: np.where(has_lever, np.vecdot(normal, np.cross(dw, r)), 0.0) → shaped(np.vecdot…",
        ),
        "The bound of what counts as rounding may be another one.": (
            "largest component: np.linalg.norm(…",
            "sum of components: np.linalg.norm(…",
            "axis … left out: np.linalg.norm(r, axis=-1) → …",
            "factor forgotten: NO_LEVER * np.linalg.norm(r, axis=-1) → NO_LEVER",
            "ratio for product: NO_LEVER * np.linalg.norm(r, axis=-1) → NO_LEVER / np.linalg.norm(r, axis=-1)",
        ),
        ONLY_WHETHER_ZERO: ("cross product turned round: np.cross(r, normal) → np.cross(normal, r)",),
    },
    "collide": {
        "Only bodies that approach get an impulse, and it is never negative.": (
            "in impulse_magnitude: size for it: quotient(…",
        ),
    },
    "face_planes": {
        "Any corner of the face will do.": ("one for the other: a → b (2)", "one for the other: a → b (3)")
    },
    "convex_separation": {
        ANY_NEGATIVE: ("twice the number: 1 → 2",),
        NOT_NEGATIVE: ("size for it: (separation…, face…) → (separation…, np.abs(face…",),
        "Any corner of the face will do.": (
            "in face_planes: one for the other: a → b (2)",
            "in face_planes: one for the other: a → b (3)",
        ),
    },
    "segment_triangle": {
        "The area of a triangle is the same from each of its corners.": ("one for the other: a → b (2)",),
        "In general position both candidates are the same.": (
            "…: np.linalg.norm(weights @ corners - places, axis=-1) → …",
            "term dropped: weights @ corners - places → …",
            "sign flipped: weights @ corners - places → …",
            "size for it: weights @ corners - places → …",
            "factor forgotten: weights @ corners → weights",
            "only the diagonal: weights @ corners → …",
        ),
        NOT_NEGATIVE: ("size for it: (fraction, …",),
    },
    "_candidates": {
        "In general position the segment is not in the plane, and both candidates are the same.": (
            "condition dropped: …orient3d(…",
            "and for or: …",
            "comparison turned round: orient3d(…",
            "one for the other: a → b",
            "one for the other: b → a",
            "one for the other: a → b (2)",
            "one for the other: b → a (2)",
            "one for the other: start → end",
            "one for the other: end → start",
            "one for the other: start → end (2)",
            "one for the other: end → start (2)",
            "branch dropped: np.where(in_plane… → shaped(both…",
            "another function: np.minimum(first, last) → …",
            "limit dropped: …",
            "one for the other: first → …",
            "one for the other: last → …",
        ),
        "Every corner of the triangle is in its plane.": (
            "one for the other: a → b (3)",
            "one for the other: a → b (4)",
        ),
        NOT_NEGATIVE: ("size for it: np.where(in_plane…",),
    },
    "_side_by_side": {ONLY_THE_SHAPE: ("one for the other: start → end", "one for the other: end → start")},
    "_weights": {
        "Within the triangle no area is negative.": (
            "limit dropped: np.maximum(areas, 0.0) → shaped(areas, 0.0)",
            "size for it: quotient(areas, …",
        ),
    },
    "_crossing_share": {
        "A segment that goes through the plane does so at a share from 0 to 1.": (
            "size for it: np.clip(…",
            "limit dropped: np.clip(…",
            "twice the number: 1.0 → 2.0",
        ),
        "The heights of both ends are the same there.": ("one for the other: s0 → s1 (3)",),
    },
    "side_of_line": {
        "The points have two coordinates.": ("…: axis 2 left out",),
        "The area of a triangle is the same from each of its corners.": ("one for the other: a → b (2)",),
    },
    "inside_by_parity": {
        ANY_NEGATIVE: ("twice the number: 1 → 2",),
        NOT_NEGATIVE: ("size for it: inside…",),
    },
    "_ray_crosses": {
        ORDER: ("results swapped: ((b, c), (c, a)) → ((c, a), (b, c))",),
        NOT_NEGATIVE: ("size for it: crossed → np.abs(crossed)",),
    },
    "_before_face": {
        "It decides about points on the surface alone, which the lab leaves open.": (
            "condition dropped: side == 0 → never(side == 0)",
            "results swapped: (a[on], b[on], c[on]) → …",
            "one for the other: a → b (2)",
            "one for the other: b → a (2)",
            "one for the other: a → b (3)",
            "one for the other: b → a (3)",
        ),
    },
    "_beside_edge": {
        "Any tiny move will do, as long as it is the same for all faces.": (
            "sign flipped: a[:, 1] - b[:, 1] → b[:, 1] - a[:, 1]",
            "sign flipped: b[:, 0] - a[:, 0] → a[:, 0] - b[:, 0]",
        ),
    },
    "winding_number": {
        "Both ways of adding up give the same number.": (
            "boundary: point.size * len(faces) <= FEW → …",
            "comparison turned round: point.size * len(faces) <= FEW → …",
            "condition dropped: point.size * len(faces) <= FEW → …",
            "factor forgotten: point.size * len(faces) → …",
            "ratio for product: point.size * len(faces) → …",
            "size for it: winding_of_mesh(point, vertices, faces) → …",
        ),
    },
    "polyhedra_intersect": {
        "Mirrored, both solids meet as before.": ("vertices_a and vertices_b: sign flipped",),
        NOT_NEGATIVE: ("size for it: bool(…",),
    },
    "tangent_point": {
        NOT_NEGATIVE: ("size for it: centre + radius[..., None] * … → centre + np.abs(radius[..., None] * …",),
    },
    "_distance_and_tangent": {
        NOT_NEGATIVE: ("size for it: …",),
    },
    "nearest_approach": {
        NOT_NEGATIVE: (
            "size for it: (time, distance - … → (np.abs(time), …",
            "size for it: distance - radius_a → …",
            "size for it: distance - radius_a - radius_b → distance - radius_a - np.abs(radius_b)",
        ),
    },
    "towards_mean": {
        NOT_NEGATIVE: ("size for it: np.bincount(first, minlength=n) + …",),
        "Without neighbours the sum is zero.": ("half the number: 1 → 0.5",),
    },
    "orca_half_plane": {
        "The vectors have two components.": ("…: axis 2 left out", "axis 2 left out: …"),
        NOT_NEGATIVE: (
            "size for it: radius_a + radius_b → …",
            "size for it: 1 - sine → …",
            "size for it: 1 + sine → …",
        ),
        "The sides of the cone are used only where the cap does not decide.": (
            "branch dropped: np.where(capped, 0.0, reach) → shaped(reach, capped)",
        ),
        "A sign is its own inverse.": ("ratio for product: side * cosine → cosine / side",),
    },
    "ray_sphere": {
        "Only its square is used.": ("cross product turned round: np.cross(x, u) → np.cross(u, x)",),
        "From within the result is zero, whatever the size of the sphere.": (
            "limit dropped: np.minimum(radius, distance) → shaped(radius, distance)",
        ),
        "A ray that comes no nearer misses; without a direction the quotient is infinite.": (
            "boundary: closing > 0 → closing >= 0",
        ),
        "The root is used only where the ray meets the sphere.": (
            "branch dropped: np.where(meets, quarter, 0.0) → shaped(quarter, meets)",
        ),
        NOT_NEGATIVE: ("size for it: …",),
    },
    "sweep_sphere_sphere": {
        NOT_NEGATIVE: ("size for it: …",),
        "The root of a negative number is NaN, and NaN is in no step.": (
            "in ray_sphere: condition dropped: (closing > 0) & (quarter >= 0) → closing > 0",
            "in ray_sphere: condition dropped: quarter >= 0 → always(quarter >= 0)",
        ),
    },
    "within": {NOT_NEGATIVE: ("size for it: …",)},
    "missed_share": {
        NOT_NEGATIVE: ("size for it: …",),
    },
    "ray_box": {NOT_NEGATIVE: ("half_extents: size for it",)},
    "in_all": {
        NOT_NEGATIVE: ("size for it: (np.where(meets, entry, np.inf), … → (np.abs(…",),
    },
    "time_between": {
        "A sign is its own inverse.": ("ratio for product: -x * np.sign(u) → -x / np.sign(u)",),
        "A slab behind the start is left before the start, whenever it is entered.": (
            "size for it: to_middle - h → np.abs(to_middle) - h",
        ),
        NOT_NEGATIVE: ("size for it: to_middle … np.abs(h)",),
    },
    "ray_capsule": {
        "Where the side is not met, the place is that of no time, and the ends decide.": (
            "branch dropped: np.where(np.isfinite(time_side), time_side, 0.0) → shaped(time_side…",
        ),
        "At the end of the side, the ball around this end is met at the same time.": (
            "boundary: share_there >= 0 → share_there > 0",
            "boundary: share_there <= 1 → share_there < 1",
        ),
        NOT_NEGATIVE: ("size for it: np.minimum(…",),
    },
    "motion_bound": {
        TWICE: (
            "angular_velocity: sign flipped",
            "cross product turned round: np.cross(normal, angular_velocity) → np.cross(angular_velocity, normal)",
        ),
        NOT_NEGATIVE: ("size for it: np.vecdot(normal, velocity) + … + np.abs(across * reach)",),
    },
    "rotate_by_momentum": {
        TWICE: ("moments: sign flipped",),
        "q and −q are the same rotation.": ("orientation: size for it",),
        NOT_NEGATIVE: ("moments: size for it",),
        "What is held keeps its spin, whatever its momentum.": (
            "branch dropped: np.where(free, moments, 0.0) → shaped(moments, free)",
        ),
        SYMMETRIC: ("transposed: np.matvec(inverse_inertias(moments, q_after), momentum) → …",),
    },
    "candidate_pairs": {
        NOT_NEGATIVE: ("size for it: np.argwhere(…",),
        "The diagonals of a triangle are whole numbers.": ("half the number: 1 → 0.5",),
    },
    "collect_contacts": {
        NOT_NEGATIVE: (
            "…of bodies: size for it",
            "size for it: np.where(of_kind == PLANE, np.inf, reach) + margin / 2 → …",
            "size for it: position - reach → position - …",
            "size for it: inverse_mass[first] + inverse_mass[second] → …",
        ),
        "Only a lower corner that is too high, or an upper one that is too low, hides a contact.": (
            "size for it: position + reach → …",
        ),
        "Only places and shapes count.": (
            "moments of bodies: …",
            "restitution of bodies: …",
            "friction of bodies: …",
            "velocity of state…",
            "angular_velocity of state…",
        ),
        "q and −q are the same rotation.": ("orientation of state: sign flipped",),
        "More candidates only take longer: the given function leaves out what does not touch.": (
            "branch dropped: np.where(of_kind == PLANE, np.inf, reach) → shaped(np.inf, of_kind == PLANE)",
            "condition dropped: of_kind == PLANE → always(of_kind == PLANE)",
            "factor forgotten: margin / 2 → margin",
            "product for ratio: margin / 2 → margin * 2",
            "half the number: 2 → 1.0",
        ),
    },
    "respond": {
        NOT_NEGATIVE: ("inverse_mass of bodies: size for it",),
        "What touches is known already.": (
            "meet of bodies: …",
            "kind of bodies: …",
            "size of bodies: …",
            "key of contacts: …",
        ),
        "q and −q are the same rotation.": ("orientation of state: sign flipped",),
        "Both have one entry for each contact.": ("one for the other: a → b",),
        SYMMETRIC: (
            "product turned round: dt * share @ load.ravel() → …",
            "transposed: dt * share @ load.ravel() → …",
            "transposed: share @ normals.T → …",
        ),
        ANY_NEGATIVE: ("twice the number: 1 → 2",),
    },
    "step_world": {
        NOT_NEGATIVE: (
            "inverse_mass of bodies: size for it",
            "… → (position, orientation, velocity, spin, np.abs(contacts[-1]), impulse)",
        ),
    },
    "advance": {
        NOT_NEGATIVE: (
            "size for it: int(looks) + 1 → …",
            "size for it: time + float(separation / closing) → …",
            "size for it: (time, used) → …",
            "size for it: (np.inf, used) → …",
            "size for it: (np.nan, used) → …",
        ),
        "Without any approach the quotient is infinite as well.": ("boundary: closing <= 0 → closing < 0",),
    },
    "universal_gravity": {
        "Only its square is used.": ("softening: sign flipped",),
    },
    "spring_damper_force": {NOT_NEGATIVE: ("size for it: length - rest_length → …",)},
    "spring_step_limit": {
        FIRST_OF_BOTH: ("boundary: damping_squared > critical_squared → damping_squared >= critical_squared",),
        "The root is used only where the motion does not swing.": (
            "branch dropped: np.where(overdamped, …) → shaped(damping_squared - critical_squared, overdamped)",
        ),
        NOT_NEGATIVE: ("size for it: …",),
    },
    "terminal_velocity": {
        "Only its square is used.": ("radius: sign flipped",),
        NOT_NEGATIVE: ("size for it: density - fluid_density → …",),
    },
    "total_force": {
        NOT_NEGATIVE: tuple(
            f"{name}: size for it" for name in ("mass", "radius", "stiffness", "rest_length", "damping")
        ),
    },
    "mesh_forces": {
        NOT_NEGATIVE: (
            *POSITIVE_PARTS,
            "size for it: length - mesh.rest_length → np.abs(length) - mesh.rest_length",
            "size for it: length - mesh.rest_length → length - np.abs(mesh.rest_length)",
        ),
        "A force depends neither on the masses nor on what is pinned.": (
            "mass of mesh: left out",
            "mass of mesh: sign flipped",
            "mass of mesh: axis …",
            "pinned of mesh: left out",
        ),
    },
    "mesh_step": {
        NOT_NEGATIVE: POSITIVE_PARTS,
    },
    "onto_nodes": {
        ONE_MESH: (
            "results swapped: (*force.shape[:-2], len(mesh.mass), 3) → (len(mesh.mass), *force.shape[:-2], 3)",
            "…: batch * shape[-2] + end → end",
            "…: batch * shape[-2] + end → -(batch * shape[-2]) + end",
            "factor forgotten: batch * shape[-2] → batch",
        ),
        NOT_NEGATIVE: ("size for it: (batch * shape[-2] + end)…", "size for it: batch * shape[-2] + end → …"),
    },
    "edge_directions": {
        NOT_NEGATIVE: ("size for it: (quotient(between, … np.abs(length))",),
    },
    "diagonals": {
        "Mirrored, the same springs are needed.": ("position: sign flipped",),
        "A row may be longer or shorter.": ("in lengths: root forgotten: …",),
        "A row that raises no rank may be kept: it raises none later either.": (
            "boundary: raised > rank → raised >= rank (2)",
            "condition dropped: raised > rank → always(raised > rank) (2)",
        ),
        NOT_NEGATIVE: ("size for it: np.array(needed, …", "in _rank: size for it: …"),
    },
    "_rank": {
        "Newer versions of NumPy know that no rows have the rank 0.": (
            "branch dropped: int(np.linalg.matrix_rank(rows, rtol=TINY)) if rows.size else 0 → int(…",
        ),
    },
    "_rows": {
        "A row may be turned round, and be longer or shorter.": (
            "sign flipped: … → position[second] - position[first]",
            "factor forgotten: quotient(span, … → span",
            "product for ratio: quotient(span, …",
        ),
    },
    "timestep_bound": {
        "No shape makes a spring stiffer than its stiffness.": (
            "rest_length of mesh: left out",
            "rest_length of mesh: sign flipped",
            "rest_length of mesh: axis …",
        ),
        NOT_NEGATIVE: (*POSITIVE_PARTS, "size for it: …"),
    },
    "mesh_sphere_contact": {
        "A node meets the sphere by itself: neither its springs nor its mass count.": (
            "edges of mesh: left out",
            *(
                f"{part} of mesh: {change}"
                for part in ("rest_length", "stiffness", "damping", "mass")
                for change in ("left out", "sign flipped", "size for it", "axis …")
            ),
        ),
        "Only its size is used.": ("sign flipped: bounced - velocity → velocity - bounced",),
        NOT_NEGATIVE: ("size for it: distance - radius → …",),
    },
    "_slowed": {NOT_NEGATIVE: ("size for it: 1 - np.minimum(…",)},
    "limit_strain": {
        "Only lengths and masses count.": tuple(
            f"{part} of mesh: {change}"
            for part in ("stiffness", "damping")
            for change in ("left out", "sign flipped", "axis …")
        ),
        NOT_NEGATIVE: (*POSITIVE_PARTS, "size for it: 1 + limit → …", "size for it: w1 + w2 → …"),
    },
    "_fit": {
        "It only keeps rounding from going on for ever.": (
            "boundary: length > longest * (1 + SLACK) → length >= longest * (1 + SLACK)",
            "factor forgotten: longest * (1 + SLACK) → longest",
            "ratio for product: longest * (1 + SLACK) → longest / (1 + SLACK)",
            "term dropped: 1 + SLACK → 1",
            "sign flipped: 1 + SLACK → 1 - SLACK",
        ),
        NOT_NEGATIVE: ("size for it: 1 + SLACK → …", "size for it: 1 - longest / …", "size for it: 1 - share → …"),
    },
}


def reason(mutant: Mutant) -> str:
    """Why no check can notice a mutant; empty if it is not listed."""
    for listed, change in ((mutant.function, mutant.name), (mutant.owner, mutant.change)):
        for why, changes in EQUIVALENT.get(listed, {}).items():
            if any(_is(change, each) for each in changes):
                return why
    return ""


def unmatched(function: str, mutants: Sequence[Mutant]) -> list[str]:
    """What is listed for a function, or for helpers of its own, but is none of its mutants."""
    helpers = {mutant.owner for mutant in mutants} - lecture.FUNCTIONS.keys()
    listed = [line for name in (function, *helpers) for lines in EQUIVALENT.get(name, {}).values() for line in lines]
    changes = {mutant.name for mutant in mutants} | {mutant.change for mutant in mutants}
    return [line for line in listed if not any(_is(change, line) for change in changes)]


def _is(change: str, listed: str) -> bool:
    return re.fullmatch(".*".join(map(re.escape, listed.split("…"))), change) is not None
