"""The slides' formulas exactly as they are printed, kept to be refuted.

Only tests and the figures that show what goes wrong use these functions. The
docstring of each function gives the slide's formula, says what goes wrong with
it, and names the function that is right.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.arrays import Array, Booleans
from solutions.domain import Number, Triple, domain

# Detection and response


@domain
def point_plane_collision(point: Triple, coefficients: Number) -> Booleans:
    """Slide 4: a x + b y + c z + d < 0 ⇒ collision.

    Takes points (..., 3) and coefficients (..., 4), and returns bools (...).

    A point that touches the plane does not collide, because 0 < 0 is false.
    Slide 5 uses the left side as a distance, and as a distance it is wrong by
    the factor √(a² + b² + c²). The right functions are `signed_distance` and
    `side_of_plane`.
    """
    abc, d = coefficients[..., :3], coefficients[..., 3]
    return np.sum(abc * point, axis=-1) + d < 0


@domain
def time_of_impact(t: Number, dt: Number, d1: Number, d2: Number) -> Array:
    """Slide 5: T = t + Δt d1/(d1 + d2), (...), s.

    Slide 4 gives signed distances, and behind the plane d2 is negative. T then
    lies outside the step, and where d1 = −d2 it is infinite or not a number.
    Two distances on the same side of the plane give a T although nothing was
    hit. The right function is `time_of_impact_interpolated`.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        return t + dt * d1 / (d1 + d2)


@domain
def mirror_response(velocity: Triple, normal: Triple) -> Array:
    """Slide 7: v' = v − 2 (v·N) N, (..., 3), m/s.

    Every bounce is elastic. The formula also lacks a guard: a point that is
    still behind the plane at the next step, but already moves out, is thrown
    back in and never leaves. The right function is `kinematic_response`.
    """
    v, n = velocity, normal
    return v - 2 * np.sum(v * n, axis=-1, keepdims=True) * n


@domain
def penalty_force(stiffness: Number, distance: Number) -> Array:
    """Slide 8: F = k d, (...), N, a number without a direction.

    With the signed distance of slide 4, the force pulls a point behind the
    plane deeper in and pushes away a point that does not touch. With a depth
    for d, the formula must still be kept from pulling before the contact; and
    without damping every impact is elastic. The right function is
    `penalty_force` of `solutions.response`.
    """
    return stiffness * distance


# Friction


@domain
def static_friction_force(
    normal_force: Number, static_friction: Number
) -> Array:
    """Slide 24: F_s = μ_s F_N, (...), N, a number without a direction.

    Taken as the force of friction, it sets a body in motion that nothing
    pushes, and it pushes back harder than one pushes. It is only the largest
    value that static friction can take. The right functions are `holds` and
    `friction_force`.
    """
    return static_friction * normal_force


# Impulse


@domain
def velocity_after_restitution(
    normal_velocity: Number, restitution: Number
) -> Array:
    """Prose of slide 12: e u_n⁻, (...), m/s.

    The slide says "the fraction of the relative velocity the points will
    have". Without the reversal, two points that approach each other continue
    to approach, only more slowly. The right function is `rebound_velocity`.
    """
    return restitution * normal_velocity


@domain
def velocities_after_impulse(
    velocity_a: Triple,
    velocity_b: Triple,
    mass_a: Number,
    mass_b: Number,
    impulse: Triple,
) -> tuple[Array, Array]:
    """Slide 18: v⁺_A = v⁻_A + j n/M_A and v⁺_B = v⁻_B + j n/M_B, m/s.

    The argument `impulse` is J = j n, (..., 3), N s, and the velocities are
    (..., 3). With a plus sign on both, the pair gains the momentum 2 J out of
    nothing and pushes itself along. The right function is `apply_impulse`.
    """
    after_a = velocity_a + impulse / mass_a[..., None]
    after_b = velocity_b + impulse / mass_b[..., None]
    return after_a, after_b


@domain
def contact_kind(
    relative_velocity: Number, threshold: Number
) -> NDArray[np.str_]:
    """Slide 21: the kind of a contact by the sign of V_rel, (...), words.

    The slide calls V_rel > threshold colliding, otherwise V_rel < −threshold
    resting, and everything else moving away. With n from A to B, V_rel is
    positive for bodies that approach, and the first test is right. The second
    test calls bodies that move away fast resting, and bodies that rest moving
    away. With n from B to A the first test is wrong too. The right function is
    `classify_contact`.
    """
    resting = relative_velocity < -threshold
    otherwise = np.where(resting, "resting", "separating")
    return np.where(relative_velocity > threshold, "colliding", otherwise)


# Avoidance


@domain
def force_field(position: Triple, centre: Triple, strength: Number) -> Array:
    """Slide 1: "force fields", read as F0 (p − c)/‖p − c‖³, (..., 3), N.

    The slide says no more than these two words. This function gives the field
    no range, as gravity has none; F0 is its strength in N at a distance of
    1 m.

    Every body feels the field everywhere. A body at rest far away is driven
    off, and a body that is drawn to a goal comes to rest beside it. At the
    surface of a large obstacle the field is weak. The right function is
    `sphere_force`, which ends at its reach.
    """
    away = position - centre
    distance = np.linalg.norm(away, axis=-1, keepdims=True)
    return strength[..., None] * away / distance**3


@domain
def seek(position: Number, target: Number, max_speed: Number) -> Array:
    """Beside slide 1: v_wanted = v_max normalize(position − target), m/s.

    Takes positions (..., d) and returns velocities (..., d).

    The sign is wrong, so that the body flees. The formula is printed this way
    in "Steering Behaviors For Autonomous Characters" (Reynolds, 1999), whose
    figure shows the right direction, and it has been copied widely. The right
    function is `seek` of `solutions.avoidance`.
    """
    away = position - target
    distance = np.linalg.norm(away, axis=-1)[..., None]
    return max_speed[..., None] * away / distance


# Forces


def gravity_in_feet() -> float:
    """Slide 25: 32 ft/s² = 9.8 m/s²; returns the left side in m/s².

    A foot is 0.3048 m, so that the left side is 9.7536 m/s². The two sides
    differ by 0.5 %. The right value is `STANDARD_GRAVITY`.
    """
    return 32 * 0.3048


@domain
def viscous_force(
    velocity: Triple, shape_factor: Number, viscosity: Number
) -> Array:
    """Slide 26: F_vis = −K n v, (..., 3), N; the slide's n is the viscosity η.

    Read with the body's own velocity, the force brakes a body that drifts
    along with a river. The right function is `stokes_drag`.
    """
    return -(shape_factor * viscosity)[..., None] * velocity


@domain
def terminal_speed(
    mass: Number, gravity: Number, radius: Number, viscosity: Number
) -> Array:
    """Slide 26: m g = 6πr n v, solved for v, (...), m/s.

    Without buoyancy a bubble sinks, and a ball of the fluid itself sinks in
    that fluid. The right function is `terminal_velocity`.
    """
    return mass * gravity / (6 * np.pi * radius * viscosity)


@domain
def spring_force(
    displacement: Number, rest: Number, stiffness: Number
) -> Array:
    """Slide 27: F = k (x − x_rest), (...), N.

    Taken as the force on the mass, it pushes the mass away from rest. The
    right function is `spring_force` of `solutions.forces`.
    """
    return stiffness * (displacement - rest)


@domain
def spring_damper_force(
    displacement: Number,
    rest: Number,
    stiffness: Number,
    velocity: Number,
    damping: Number,
) -> Array:
    """Slide 29: F = (x' − x_rest) k − v k_d, (...), N.

    The slide's x' is the current position. The motion grows as e^(λt) with

        λ = −c/(2m) + √((c/2m)² + k/m) > 0

    and no damping calms it. The term −v k_d also brakes a spring that flies as
    a whole. The right function is `spring_damper_force` of
    `solutions.forces`.
    """
    return (displacement - rest) * stiffness - velocity * damping


# Polyhedra


@domain
def inside_polyhedron(
    point: Triple, vertices: Triple, faces: ArrayLike
) -> Booleans:
    """Slide 9: inside means behind the planes of all faces.

    Takes points (..., 3), and returns bools (...).

    The slide says this of any polyhedron. A concave solid is not the
    intersection of the half-spaces behind its faces: a point in one arm of an
    L is in front of the wall of the other arm. The right functions are
    `inside_by_parity` and `inside_by_winding`, and for convex solids
    `inside_convex`.
    """
    p = point[..., None, :]
    a, b, c = np.moveaxis(vertices[np.asarray(faces)], 1, 0)
    normal = np.cross(b - a, c - a)
    return np.all(np.sum(normal * (p - a), axis=-1) < 0, axis=-1)


@domain
def inside_by_touched_faces(
    point: Triple, vertices: Triple, faces: ArrayLike
) -> Booleans:
    """Slide 9: inside when a ray up meets an odd number of faces.

    Takes points (..., 3), and returns bools (...). The borders of the faces
    are included.

    The test is mostly written down in this way. A ray through an edge meets
    two faces where it crosses the surface once, and a ray through a vertex
    meets all the faces that share the vertex. The right function is
    `inside_by_parity`.
    """
    p = point[..., None, :]
    a, b, c = np.moveaxis(vertices[np.asarray(faces)], 1, 0)
    normal = np.cross(b - a, c - a)
    looks_up = np.sign(normal[:, 2])
    sides = [
        np.cross(end - start, p - start)[..., 2] * looks_up
        for start, end in ((a, b), (b, c), (c, a))
    ]
    above = np.sum(normal * (p - a), axis=-1) * looks_up < 0
    met = np.all(np.stack(sides) >= 0, axis=0) & above
    return np.sum(met, axis=-1) % 2 == 1
