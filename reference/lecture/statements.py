"""The thirty statements of the lecture "Collisions" (Rick Parent, CIS 682) in the order of its slides.

Import them from `reference.lecture`, which gives the conventions and the topics. Where a slide and the lab differ in
notation, `slide` keeps the slide's symbols and `right` the lab's: e for ε, s for a signed distance, η for a viscosity.
"""

from __future__ import annotations

from dataclasses import dataclass

from reference.errors import UnknownName


@dataclass(frozen=True)
class Statement:
    """One statement of the lecture.

    number: 1 to 30. title: a few words. topic: the name of the topic that teaches it. slide: what the slide says, in
    its own formula. right: what is right. erratum: the error or gap to teach, empty where there is none.
    """

    number: int
    title: str
    topic: str
    slide: str
    right: str
    erratum: str


# fmt: off
# A table, one heading and three texts a row: the formatter would make it twice as long.
STATEMENTS: tuple[Statement, ...] = (
    Statement(1, "Avoiding a collision", "avoidance",
        slide="Collision avoidance: force fields, steer to avoid, etc.; as in flocking.",
        right="A repelling field has a limited range. Steering aims at the tangent point of the obstacle's bounding "
        "sphere: with the centre at distance L and the radius r, the way to that point is k = √(L² − r²); it lies "
        "t = r²/L short of the centre and s = √(r² − t²) to the side. Flocking is Reynolds' separation, alignment "
        "and cohesion, with seek, flee and arrive beside them.",
        erratum="A force field does not let one fly along a wall; head-on its force has no lateral part, a deadlock; "
        "the forces of several obstacles can cancel. A widely copied text has seek = normalize(position − target): "
        "wrong sign, it flees; it must be target − position."),
    Statement(2, "When objects overlap", "detection",
        slide="Collision detection: calculating when objects overlap; during a time interval.",
        right="Two tests: the discrete one looks for an overlap at one instant, the continuous one at any time "
        "within a step.",
        erratum=""),
    Statement(3, "Accuracy against computation", "response",
        slide="Collision response: computation v. accuracy; back up time v. after-the-fact.",
        right="Event-driven simulation goes back to the instant of contact, fixed time-stepping answers at the next "
        "step. What the first costs and how far the second errs is the headline study of the lab.",
        erratum="Backing up is half of the work: the rest of the step must then be integrated with the new velocity."),
    Statement(4, "Point against plane", "detection",
        slide="a x + b y + c z + d < 0 ⇒ collision; every time step, see if the point is on the wrong side.",
        right="The signed distance is s = (n·p + d)/‖n‖ with n = (a, b, c), negative behind the plane.",
        erratum="The slide's expression is a distance only when ‖n‖ = 1; its strict < calls a touching point, s = 0, "
        "not colliding; and it tests a half-space, not a face of limited size."),
    Statement(5, "Time of impact", "detection",
        slide="T = t + Δt·d1/(d1 + d2)",
        right="T = t + Δt·s0/(s0 − s1) for signed distances s0 ≥ 0 > s1 at the start and the end of the step. s0 = 0 "
        "gives T = t: a point left exactly on the plane must not tunnel. Three policies to compare: the exact root, "
        "the slide's T, and responding at the step.",
        erratum="The slide's d are magnitudes: d1 = s0 and d2 = −s1. T is exact if the velocity is constant within "
        "the step; under gravity it is early by up to g_n Δt²/(8 v_n), where v_n is the approach speed and g_n the "
        "pull of gravity, both along the normal."),
    Statement(6, "Two policies", "response",
        slide="Either back time up to the point of collision and go from there, or respond to the collision only at "
        "time steps.",
        right="Two policies, each with its own error and cost; the lab implements both and compares them.",
        erratum=""),
    Statement(7, "Kinematic response", "response",
        slide="v' = v − 2(v·N)N: negate the velocity component in the direction of the normal.",
        right="v' = v − (1 + e)(v·N)N, and only if v·N < 0.",
        erratum="The slide is the case e = 1 and has no guard: a point that is already leaving is reflected again, "
        "back into the plane, and sticks there."),
    Statement(8, "Penalty method", "response",
        slide="F = k d: a spring with zero rest length.",
        right="F = max(0, k d − c v_n) N, with the depth d and the normal velocity v_n, negative when approaching.",
        erratum="The slide has no direction, no damping and no clamp, without which a damped contact pulls. A body at "
        "rest sinks in by m g/k. Semi-implicit Euler is stable for dt < (2/ω)(√(1 + ζ²) − ζ) only, where ω = √(k/m) "
        "and ζ = c/(2√(k m))."),
    Statement(9, "Polyhedra and temporal aliasing", "polyhedra",
        slide="Point inside a convex/concave polyhedron test; edge–plane intersection; temporal aliasing.",
        right="Convex: the point is behind all face planes. Concave: parity of a ray's crossings, or the winding "
        "number. Edges: segment against triangle. Aliasing: a ball of radius r and speed v misses a slab of "
        "thickness w with probability max(0, 1 − (w + 2r)/(v Δt)).",
        erratum="The convex test is wrong on concave solids; a ray through a vertex or an edge is miscounted; an open "
        "or self-intersecting mesh has no plain inside."),
    Statement(10, "Swept volumes", "sweeping",
        slide="Compute the motion of one relative to the other; compute the swept volume; determine if the other "
        "object intersects it. Tractable only for simple motion.",
        right="A relative translation is a ray against the Minkowski sum, one shape grown by the other's mirror "
        "image. Rotation needs conservative advancement.",
        erratum=""),
    Statement(11, "Two bodies collide", "impulse",
        slide="Two objects, both translating and rotating in space, collide at points of contact.",
        right="The reaction changes four velocities at once: v and ω of A, v and ω of B.",
        erratum=""),
    Statement(12, "Restitution", "impulse",
        slide="v⁺_rel = −ε v⁻_rel; the user specifies the fraction of the relative velocity the points will have "
        "after collision.",
        right="u_n⁺ = −e u_n⁻ with 0 ≤ e ≤ 1: the normal component alone.",
        erratum="The prose omits the reversal: a mere fraction would let the bodies move further into each other."),
    Statement(13, "Impulse", "impulse",
        slide="J = F Δt = M a Δt = M Δv = Δ(M v) = ΔP; J = j N; a force applied over (short) time, with linear and "
        "angular components.",
        right="J = ∫F dt, in N s: the change of momentum that a force leaves behind. Off the centre of mass it "
        "changes the angular momentum too.",
        erratum="The slides call an impulse a force."),
    Statement(14, "Velocity of a point", "impulse",
        slide="p_A(t) = v_A(t) + ω_A(t) × r_A",
        right="ṗ_A = v_A + ω_A × r_A, with r_A from the centre of mass to the contact, in the world frame.",
        erratum="The dot is lost: a velocity is printed as a position."),
    Statement(15, "Relative velocity", "impulse",
        slide="The relative velocity is the difference of the velocities of the two points of contact.",
        right="u = ṗ_A − ṗ_B and u_n = n·u, negative when approaching, with n from B to A.",
        erratum="The order matters, and the slide does not fix it."),
    Statement(16, "Along the normal", "impulse",
        slide="Forces are applied to both objects along the normal to the contact surface, at the point of contact.",
        right="So it is in an impact without friction: J = j n on A, −j n on B.",
        erratum="Friction during the impact is absent from the slides; the friction lab teaches it."),
    Statement(17, "Contact normal", "impulse",
        slide="Point–plane: the normal of the plane; edge–edge: the cross product of the edges, A × B.",
        right="Unit length, oriented towards A: flip it if it points from A's centre to B's. The cross product of "
        "parallel edges is zero, so there it is undefined.",
        erratum=""),
    Statement(18, "Velocities after the impact", "impulse",
        slide="v⁺_A = v⁻_A + j n/M_A; v⁺_B = v⁻_B + j n/M_B; ω⁺_A = ω⁻_A + I_A⁻¹(t)(r_A × j n); "
        "ω⁺_B = ω⁻_B + I_B⁻¹(t)(r_B × j n)",
        right="B takes minus: v_B⁺ = v_B⁻ − j n/M_B and ω_B⁺ = ω_B⁻ − I_B⁻¹(r_B × j n). The inverse inertia turns "
        "with the body: I⁻¹(t) = R I_body⁻¹ Rᵀ.",
        erratum="Plus on both contradicts the slides' own pseudo-code, P_B −= J, and Newton's third law."),
    Statement(19, "Relative velocity after the impact", "impulse",
        slide="v⁺_rel = n·(p⁺_A(t) − p⁺_B(t)) = n·(v⁺_A + ω⁺_A × r_A − v⁺_B − ω⁺_B × r_B)",
        right="u_n⁺ = n·(v_A⁺ + ω_A⁺ × r_A − v_B⁺ − ω_B⁺ × r_B)",
        erratum=""),
    Statement(20, "Solving for the impulse", "impulse",
        slide="Put in terms of the unknown impulse; using the user-supplied desired reaction, compute impulse. To "
        "simplify equations, drop time dependence.",
        right="j = −(1 + e) u_n⁻ / (1/M_A + 1/M_B + n·((I_A⁻¹(r_A × n)) × r_A) + n·((I_B⁻¹(r_B × n)) × r_B))",
        erratum="The formula is missing from every text of the slides that we have: derive it. Dropping the time "
        "dependence is the model's central assumption: r, n and I⁻¹ are frozen and gravity is ignored during the "
        "impact."),
    Statement(21, "Colliding, resting or separating", "impulse",
        slide="Given two points of contact and the normal: compute v_a, v_b; compute the relative velocity along the "
        "normal. If V_rel > threshold: compute j; P_A += J, P_B −= J, L_A += r_A × J, L_B −= r_B × J. Else if "
        "V_rel < −threshold: resting contact. Else they are moving away.",
        right="u_n < −threshold: colliding. |u_n| ≤ threshold: resting. u_n > threshold: separating.",
        erratum="The second < should be >, and the slide presumes n from A to B. Only the test depends on that: left "
        "unguarded, j n is the same under n → −n. After the update of P and L, v = P/M and ω = I⁻¹ L must be "
        "recomputed."),
    Statement(22, "Resting contact", "world",
        slide="Resting contact: the branch is empty.",
        right="Contact forces, found as a linear complementarity problem or a quadratic programme (LCP, QP), or by "
        "sequential impulses.",
        erratum="Simultaneous contact is not unique: a cradle of 5 balls, one arriving at unit speed, ends with "
        "(0, 0, 0, 0, 1) if the impact propagates from ball to ball and with (−0.6, 0.4, 0.4, 0.4, 0.4) if all act "
        "at once."),
    Statement(23, "Other forces", "forces",
        slide="Other forces: gravity, friction, viscosity, springs (Hooke's law).",
        right="Each acts over a time, where an impulse acts at an instant: it enters as an acceleration F/m.",
        erratum=""),
    Statement(24, "Friction", "friction",
        slide="Supporting object, resting contact, normal force F_N; static friction F_s = μ_s F_N; kinetic friction "
        "F_k = μ_k F_N.",
        right="Static: ‖F_t‖ ≤ μ_s N, and F_t cancels the push. Kinetic: F_t = −μ_k N v_t/‖v_t‖.",
        erratum="F_s = μ_s F_N is only the maximum of static friction; the slide gives no direction; N is not always "
        "m g."),
    Statement(25, "Gravity", "forces",
        slide="F = G m1 m2/r²; a_object = F/m_object = G m_earth/r_earth² = 32 ft/s² = 9.8 m/s²",
        right="On body 1: F = G m1 m2 (x2 − x1)/‖x2 − x1‖³. Its own mass cancels in F/m1: all bodies fall alike.",
        erratum="32 ft/s² is 9.7536 m/s². The standard g₀ = 9.80665 m/s² is 32.174 ft/s². G M/R² is 9.820 m/s² (mean "
        "radius 6371 km, no rotation)."),
    Statement(26, "Viscosity", "forces",
        slide="F_vis = −K n v; K depends on the shape of the object, n on the properties of the liquid; K = 6πr for a "
        "spherical object; terminal velocity where m g = 6πr n v.",
        right="F = −6π η r (v − u), with u the velocity of the fluid; terminal speed v_t = 2(ρ_s − ρ_f) g r²/(9η).",
        erratum="The slide's n is η, its v is relative to the fluid, and buoyancy is missing. It holds for Re ≪ 1 "
        "only: the true drag exceeds Stokes by 1.8 % at Re = 2 r ρ_f v/η = 0.1 and by 13 % at 1 (fit of Clift, Grace "
        "and Weber). Shape: compare MuJoCo's box model with its ellipsoid model."),
    Statement(27, "Spring", "forces",
        slide="F_spring = k_spring (x − x_rest); at its rest length it exerts zero force.",
        right="On the mass: F = −k (x − x_rest).",
        erratum="Sign: taken as the force on the mass, the slide's formula pushes it away from rest."),
    Statement(28, "Spring mesh", "meshes",
        slide="Edges ⇒ springs; internal springs to stabilize shape.",
        right="Structural, shear and bend springs. The step limit follows from the largest eigenvalue: a 10×10 cloth "
        "takes 1.01, 0.72 and 0.646 √(m/k) as the three kinds are added, so that the single spring's 2√(m/k) is 3 "
        "times too optimistic.",
        erratum=""),
    Statement(29, "Damping", "forces",
        slide="F_damping = −k_damping v: calm down spring oscillations; F = (x' − x_rest) k_spring − v k_damper",
        right="On end 1 of a spring: F = −k (L − L0) u − k_d ((v1 − v2)·u) u, with the length L, the rest length L0 "
        "and the unit vector u from end 2 to end 1.",
        erratum="x' is the current position, not a velocity. As printed the motion diverges: the spring has the "
        "wrong sign."),
    Statement(30, "Recap of the forces", "forces",
        slide="Based on position: springs, gravity, wind; based on velocity: viscosity, dampers; based on object "
        "interactions: collisions, friction; they give rise to accelerations.",
        right="One force accumulator for all of them, with an audit of the energy.",
        erratum="A wind field is sampled at a position but acts through the relative velocity v − w."),
)
# fmt: on


def statement(number: int) -> Statement:
    """Return the statement of that number, 1 to 30.

    Raises
    ------
    UnknownName
        If no statement has that number.
    """
    for entry in STATEMENTS:
        if entry.number == number:
            return entry
    raise UnknownName("statement", number, (str(entry.number) for entry in STATEMENTS))
