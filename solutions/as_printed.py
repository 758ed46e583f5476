"""The slides' formulas exactly as they are printed, kept to be refuted.

Nothing here is used by anything but tests and figures that show what goes wrong. Each docstring says what breaks, and
which function is right.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

# Detection and response


def point_plane_collision(point: ArrayLike, coefficients: ArrayLike) -> NDArray[np.bool_]:
    """Slide 4: a x + b y + c z + d < 0 ⇒ collision, for a point (..., 3) and coefficients (..., 4).

    A point that touches, 0 < 0, does not collide. And whoever takes the left side for a distance, as slide 5 does, is
    wrong by the factor √(a² + b² + c²). Right: signed_distance, side_of_plane.
    """
    plane = np.asarray(coefficients, dtype=float)
    return np.asarray(np.sum(plane[..., :3] * np.asarray(point, dtype=float), axis=-1) + plane[..., 3] < 0)


def time_of_impact(t: ArrayLike, dt: ArrayLike, d1: ArrayLike, d2: ArrayLike) -> Array:
    """Slide 5: T = t + Δt d1/(d1 + d2), (...), s.

    Slide 4 gives signed distances, and behind the plane d2 is negative: T then lies outside the step, or is no number
    where d1 = −d2. Two distances on the same side give a T though nothing was hit. Right: time_of_impact_interpolated.
    """
    first, second = np.asarray(d1, dtype=float), np.asarray(d2, dtype=float)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(t + np.asarray(dt) * first / (first + second))


def mirror_response(velocity: ArrayLike, normal: ArrayLike) -> Array:
    """Slide 7: v' = v − 2 (v·N) N, (..., 3), m/s.

    Every bounce is elastic. Without a guard a point that is still behind the plane at the next step, but on its way
    out, is thrown back in: it never leaves. Right: kinematic_response.
    """
    v, n = np.asarray(velocity, dtype=float), np.asarray(normal, dtype=float)
    return np.asarray(v - 2 * np.sum(v * n, axis=-1, keepdims=True) * n)


def penalty_force(stiffness: ArrayLike, distance: ArrayLike) -> Array:
    """Slide 8: F = k d, (...), N; a number, without direction.

    With the signed distance of slide 4 it pulls a point behind the plane deeper in, and pushes one away that does not
    touch. With a depth for d it must still be kept from pulling before the contact; and without damping every impact is
    elastic. Right: penalty_force of solutions.response.
    """
    return np.asarray(np.asarray(stiffness, dtype=float) * np.asarray(distance, dtype=float))


# Friction


def static_friction_force(normal_force: ArrayLike, static_friction: ArrayLike) -> Array:
    """Slide 24: F_s = μ_s F_N, (...), N; a number, without direction.

    Taken as the force, it sets a body in motion that nothing pushes, and pushes back harder than one pushes. It is only
    the largest value of static friction. Right: holds, friction_force.
    """
    return np.asarray(np.asarray(static_friction, dtype=float) * np.asarray(normal_force, dtype=float))


# Impulse


def velocity_after_restitution(normal_velocity: ArrayLike, restitution: ArrayLike) -> Array:
    """Prose of slide 12: "the fraction of the relative velocity the points will have", e u_n⁻, (...), m/s.

    Without the reversal what approaches goes on approaching, only more slowly. Right: rebound_velocity.
    """
    return np.asarray(np.asarray(restitution, dtype=float) * np.asarray(normal_velocity, dtype=float))


def velocities_after_impulse(
    velocity_a: ArrayLike, velocity_b: ArrayLike, mass_a: ArrayLike, mass_b: ArrayLike, impulse: ArrayLike
) -> tuple[Array, Array]:
    """Slide 18: v⁺_A = v⁻_A + j n/M_A and v⁺_B = v⁻_B + j n/M_B, (..., 3), m/s, with J = j n, (..., 3).

    Plus on both: the pair gains the momentum 2 J out of nothing, and pushes itself along. Right: apply_impulse.
    """
    j = np.asarray(impulse, dtype=float)
    after_a = np.asarray(velocity_a, dtype=float) + j / np.asarray(mass_a, dtype=float)[..., None]
    after_b = np.asarray(velocity_b, dtype=float) + j / np.asarray(mass_b, dtype=float)[..., None]
    return np.asarray(after_a), np.asarray(after_b)


def contact_kind(relative_velocity: ArrayLike, threshold: ArrayLike) -> NDArray[np.str_]:
    """Slide 21: V_rel > threshold: colliding; else V_rel < −threshold: resting; else moving away, (...).

    With n from A to B, V_rel is positive when approaching, and the first test is right. The second calls what moves
    away fast resting, and what rests moving away. With n from B to A the first is wrong too. Right: classify_contact.
    """
    v, limit = np.asarray(relative_velocity, dtype=float), np.asarray(threshold, dtype=float)
    return np.where(v > limit, "colliding", np.where(v < -limit, "resting", "separating"))


# Avoidance


def force_field(position: ArrayLike, centre: ArrayLike, strength: ArrayLike) -> Array:
    """Slide 1: "force fields", and no more. Without a range, as for gravity: F0 (p − c)/‖p − c‖³, (..., 3), N at 1 m.

    It is felt everywhere: a body at rest far away is driven off, one that is drawn to a goal comes to rest beside it,
    and at the surface of a large obstacle it is weak. Right: sphere_force, which ends at its reach.
    """
    away = np.asarray(position, dtype=float) - np.asarray(centre, dtype=float)
    distance = np.linalg.norm(away, axis=-1, keepdims=True)
    return np.asarray(np.asarray(strength, dtype=float)[..., None] * away / distance**3)


def seek(position: ArrayLike, target: ArrayLike, max_speed: ArrayLike) -> Array:
    """Widely copied beside slide 1: v_wanted = v_max normalize(position − target), (..., d), m/s.

    The sign is wrong: the body flees. It is printed so in "Steering Behaviors For Autonomous Characters" (Reynolds,
    1999), whose figure shows the right way. Right: seek.
    """
    away = np.asarray(position, dtype=float) - np.asarray(target, dtype=float)
    return np.asarray(np.asarray(max_speed, dtype=float)[..., None] * away / np.linalg.norm(away, axis=-1)[..., None])


# Forces


def gravity_in_feet() -> float:
    """Slide 25: 32 ft/s² = 9.8 m/s². The left side, in m/s².

    A foot is 0.3048 m, so that it is 9.7536, and the two sides are 0.5 % apart. Right: STANDARD_GRAVITY.
    """
    return 32 * 0.3048


def viscous_force(velocity: ArrayLike, shape_factor: ArrayLike, viscosity: ArrayLike) -> Array:
    """Slide 26: F_vis = −K n v, (..., 3), N, with n for the viscosity η.

    Read with the body's own velocity, it brakes a body that drifts along with a river. Right: stokes_drag.
    """
    size = np.asarray(shape_factor, dtype=float) * np.asarray(viscosity, dtype=float)
    return np.asarray(-size[..., None] * np.asarray(velocity, dtype=float))


def terminal_speed(mass: ArrayLike, gravity: ArrayLike, radius: ArrayLike, viscosity: ArrayLike) -> Array:
    """Slide 26: m g = 6πr n v, solved for v, (...), m/s.

    Without buoyancy a bubble sinks, and a ball of the fluid itself sinks in it. Right: terminal_velocity.
    """
    weight = np.asarray(mass, dtype=float) * np.asarray(gravity, dtype=float)
    return np.asarray(weight / (6 * np.pi * np.asarray(radius, dtype=float) * np.asarray(viscosity, dtype=float)))


def spring_force(displacement: ArrayLike, rest: ArrayLike, stiffness: ArrayLike) -> Array:
    """Slide 27: F = k (x − x_rest), (...), N.

    Taken as the force on the mass it pushes the mass away from rest. Right: spring_force of solutions.forces.
    """
    stretch = np.asarray(displacement, dtype=float) - np.asarray(rest, dtype=float)
    return np.asarray(np.asarray(stiffness, dtype=float) * stretch)


def spring_damper_force(
    displacement: ArrayLike, rest: ArrayLike, stiffness: ArrayLike, velocity: ArrayLike, damping: ArrayLike
) -> Array:
    """Slide 29: F = (x' − x_rest) k − v k_d, (...), N, with x' the current position.

    The motion grows as e^(λt), λ = −c/(2m) + √((c/2m)² + k/m) > 0: no damping calms it. And −v k_d brakes a spring that
    flies as a whole. Right: spring_damper_force of solutions.forces.
    """
    damped = np.asarray(damping, dtype=float) * np.asarray(velocity, dtype=float)
    return np.asarray(spring_force(displacement, rest, stiffness) - damped)


# Polyhedra


def inside_polyhedron(point: ArrayLike, vertices: ArrayLike, faces: ArrayLike) -> NDArray[np.bool_]:
    """Slide 9: a point is inside when it is behind the planes of all faces, said of any polyhedron. (...), bool.

    A concave solid is not the intersection of the half-spaces behind its faces: a point in one arm of an L is in front
    of the wall of the other. Right: inside_by_parity, inside_by_winding; on convex solids inside_convex.
    """
    p = np.asarray(point, dtype=float)[..., None, :]
    a, b, c = np.moveaxis(np.asarray(vertices, dtype=float)[np.asarray(faces)], 1, 0)
    return np.asarray(np.all(np.sum(np.cross(b - a, c - a) * (p - a), axis=-1) < 0, axis=-1))


def inside_by_touched_faces(point: ArrayLike, vertices: ArrayLike, faces: ArrayLike) -> NDArray[np.bool_]:
    """Slide 9, as it is mostly written down: a ray up that meets an odd number of faces, their borders included.

    A ray through an edge meets two faces where it crosses the surface once, one through a vertex as many as are there.
    (...), bool. Right: inside_by_parity.
    """
    p = np.asarray(point, dtype=float)[..., None, :]
    a, b, c = np.moveaxis(np.asarray(vertices, dtype=float)[np.asarray(faces)], 1, 0)
    n = np.cross(b - a, c - a)
    looks_up = np.sign(n[:, 2])
    sides = [np.cross(end - start, p - start)[..., 2] * looks_up for start, end in ((a, b), (b, c), (c, a))]
    above = np.sum(n * (p - a), axis=-1) * looks_up < 0
    return np.asarray(np.sum(np.all(np.stack(sides) >= 0, axis=0) & above, axis=-1) % 2 == 1)
