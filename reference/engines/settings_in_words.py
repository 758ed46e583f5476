"""What each engine is told, in words: a sentence for each setting, with the engine's own name for it in code type.

A setting is looked up as `Settings.describe` writes it, `contact erp 0.5`: first with its value, then by its name. In a
sentence {} stands for the value, {s} and {m} for the value as a time and as a length, and code is between backticks.
"""

from __future__ import annotations

from collections.abc import Mapping

_INSIDE: Mapping[str, str] = {
    "inside by rays": "A point is inside if a ray from it crosses the triangles an odd number of times.",
    "inside by ball": "A point is inside if a ball with a radius of 1 µm at that point overlaps the solid.",
}
_RAISED = "The ground is {m} higher, so that rounding cannot part a body from it."
SENTENCES: Mapping[str, Mapping[str, str]] = {
    "pybullet": {
        "timestep": "A timestep is {s} long (`setTimeStep`).",
        "coordinates maximal": "Bodies are plain rigid bodies, not multibodies (`useMaximalCoordinates` = 1).",
        "coordinates multibody": "Bodies are multibodies, as by default (`useMaximalCoordinates` = 0).",
        "linear damping 0": "Nothing damps the velocity of a body (`linearDamping` = 0).",
        "linear damping": "A body loses the share {} of its velocity in a second (`linearDamping`).",
        "angular damping 0": "Nothing damps the spin of a body (`angularDamping` = 0).",
        "angular damping": "A body loses the share {} of its spin in a second (`angularDamping`).",
        "contact slop 0": "An overlap counts however small it is (`contactSlop` = 0).",
        "contact slop": "An overlap of {m} is left alone (`contactSlop`).",
        "contact erp": "Of an overlap, each step takes back the share {} (`contactERP`).",
        "contact gap falls 0": "A contact counts only where no gap is left (`contactProcessingThreshold` = 0).",
        "contact gap falls": "A contact counts from a gap of {} g dt² on (`contactProcessingThreshold`).",
        "split impulse True": "Taking back an overlap of any depth adds no speed (`useSplitImpulse` = 1,"
        " `splitImpulsePenetrationThreshold` = 0).",
        "split impulse False": "Taking back an overlap adds speed (`useSplitImpulse` = 0).",
        "rest threshold steps": "An impact slower than {} g dt does not bounce (`restitutionVelocityThreshold`).",
        "solver iterations": "The solver sweeps over all contacts at most {} times a step (`numSolverIterations`).",
        "solver residual 0": "The solver never stops early (`solverResidualThreshold` = 0).",
        "solver residual": "The solver stops at a residual of {} (`solverResidualThreshold`).",
        "cone friction": "Whether friction has a cone: {} (`enableConeFriction`).",
        "ground box": "The ground is a large box, on which Bullet finds all corners of a body at once (`GEOM_BOX`).",
        "ground plane": "The ground is a plane (`GEOM_PLANE`).",
        "margin": _RAISED,
        "contacts of triangles": "A ball touches the triangles of a solid (`indices` of `createCollisionShape`).",
        "contacts of hull": "A ball touches the convex hull of a solid, which is 1 mm thicker than its vertices say"
        " (`GEOM_MESH` with `vertices` alone).",
        "rays of triangles": "A ray meets the triangles of a solid (`indices` of `createCollisionShape`).",
        "rays of hull": "A ray meets the convex hull of a solid (`GEOM_MESH` with `vertices` alone).",
        "distances of hull": "Gaps are measured to the convex hull of a solid (`GEOM_MESH` with `vertices` alone).",
        "distances of pieces": "Gaps are measured to the nearest convex piece of a solid; each piece is a hull"
        " (`GEOM_MESH`).",
        "mesh margin": "A hull is thicker than its vertices say, by {m} on every side (`collisionMargin`).",
        **_INSIDE,
        "stiffness": "A contact is a spring of {} N/m for each kilogram, with a dashpot that gives e.",
        "swept inset": "A ball with a radius smaller by {m} is swept along each step, which ends where it touches"
        " (`ccdSweptSphereRadius`).",
        "sweep from 0": "Every step is swept, however little it approaches the surface (`allowedCcdPenetration` = 0).",
        "sweep from": "A step is swept if it goes farther than {m} towards the surface (`allowedCcdPenetration`).",
        "spring of world": "All contacts share the spring (`contactERP` and `globalCFM`).",
        "spring of bodies": "Each body has a spring (`contactStiffness` and `contactDamping`).",
    },
    "mujoco": {
        "timestep": "A timestep is {s} long (`timestep`).",
        "contact one step": "The damping of a contact turns its normal velocity v into −e v in one step (`solref`), and"
        " friction may end the slip in one step (`solreffriction`).",
        "contact spring": "A contact is a spring with the damping that gives e, resolved over many steps (`solref`).",
        "contact default": "A contact keeps MuJoCo's default, which knows no e (`solref`).",
        "fluid ellipsoid": "The fluid has the drag of an ellipsoid (`viscosity`, `wind`, `fluid_ellipsoid` = 1) and"
        " lifts a body by a share of its weight (`gravcomp`).",
        "fluid inertia box": "The fluid has the drag of a box with the body's inertia (`viscosity`, `wind`) and lifts"
        " a body by a share of its weight (`gravcomp`).",
        "springs tendons": "A spring is a spatial tendon between two sites (`tendon_stiffness`, `tendon_damping`,"
        " `tendon_lengthspring`).",
        "springs joint": "The ball slides in a joint along the spring, which is the joint's own (`jnt_stiffness`,"
        " `dof_damping`, `springref`).",
        "integrator Euler": "Semi-implicit Euler moves the bodies (`integrator` = Euler).",
        "integrator RK4": "The fourth-order Runge–Kutta method moves the bodies (`integrator` = RK4).",
        "integrator": "The method that moves the bodies is {} (`integrator`).",
        "cone elliptic": "Friction has a round cone (`cone` = elliptic).",
        "cone pyramidal": "Friction has a pyramid for a cone, which is weaker between its edges (`cone` = pyramidal).",
        "impedance": "A contact is as hard as an impedance of {} makes it (`solimp`).",
        "overlap recovery": "Of an overlap, each step takes back the share {} (`solref`).",
        "impratio 1": "In the main solver friction is as hard as the normal force (`impratio` = 1).",
        "impratio": "In the main solver friction is {} times as hard as the normal force (`impratio`).",
        "noslip iterations 0": "Friction is settled by the main solver alone (`noslip_iterations` = 0).",
        "noslip iterations": "After the main solver, {} passes settle friction (`noslip_iterations`).",
        "frictionless True": "A contact has no friction, not even MuJoCo's least one (`condim` = 1).",
        "margin": "A contact counts from a gap of {m} on (`margin`).",
        "contacts of hull": "A ball touches the convex hull of a solid (`mesh`).",
        "contacts of pieces": "A ball touches the convex pieces of a solid, each of them a geom (`mesh`).",
        "rays of triangles": "A ray meets the triangles of a mesh (`mj_ray`).",
        "distances of hull": "Gaps are measured to the convex hull of a mesh (`mj_geomDistance`).",
        "distances of pieces": "Gaps are measured to the nearest convex piece of a solid; each piece is a mesh"
        " (`mj_geomDistance`).",
        **_INSIDE,
        "margin steps": "A contact begins at a gap that the fastest body crosses in {} timesteps (`margin`).",
        "stiffness": "The spring has {} N/m for each kilogram (`solref`).",
    },
    "dart": {
        "timestep": "A timestep is {s} long (`setTimeStep`).",
        "detector dart": "DART's own detector finds the contacts (`DARTCollisionDetector`).",
        "detector fcl": "The Flexible Collision Library finds the contacts (`FCLCollisionDetector`).",
        "detector bullet": "Bullet's detector finds the contacts (`BulletCollisionDetector`).",
        "detector ode": "The detector of Open Dynamics Engine finds the contacts (`OdeCollisionDetector`).",
        "ground plane": "The ground is a plane (`PlaneShape`).",
        "ground box": "The ground is a large box, on which DART finds all corners of a body at once (`BoxShape`).",
        "margin": _RAISED,
        "rays of triangles": "A ray meets the triangles of a mesh (`DARTCollisionDetector`).",
        "distances of triangles": "Gaps are measured to the nearest triangle of a mesh (`FCLCollisionDetector`).",
        **_INSIDE,
        "springs joint": "The ball slides in a joint along the spring, which is the joint's own (`PrismaticJoint`,"
        " `setSpringStiffness`, `setDampingCoefficient`, `setRestPosition`).",
        "split impulse True": "Taking back an overlap adds no speed (`setSplitImpulseEnabled` = True).",
        "split impulse False": "Taking back an overlap adds speed (`setSplitImpulseEnabled` = False).",
        "sleep False": "What is at rest is never put to sleep (`DeactivationOptions.mEnabled` = False).",
        "sleep True": "What is at rest may be put to sleep (`DeactivationOptions.mEnabled` = True).",
        "solver dantzig": "Pivots solve all contacts at once, with a pyramid for friction (`DantzigBoxedLcpSolver`).",
        "solver nsgs": "Sweeps solve one contact after another, with a cone for friction (`NsgsFrictionSolver`).",
        "solver fbf": "Forward and backward steps solve all contacts, with a cone for friction (`FbfFrictionSolver`).",
        "solver tolerance": "The solver stops at a residual of {} (`tolerance`).",
        "solver iterations": "The solver sweeps at most {} times a step (`maxSweeps`).",
    },
    "handwritten": {
        "timestep": "A timestep is {s} long.",
        "policy exact_root": "An impact is resolved at the exact instant (`policy` = exact_root).",
        "policy interpolated": "An impact is resolved at the slide's T, on the straight line between two steps"
        " (`policy` = interpolated).",
        "policy at_step": "An impact is resolved at the end of the step that finds it (`policy` = at_step).",
        "policy penalty": "While bodies overlap, a spring with a dashpot pushes them apart (`policy` = penalty).",
        "stiffness": "A contact is a spring of {} N/m for each kilogram, with a dashpot that gives e.",
        "policy closed_form": "The motion has a closed form, which gives the state at any time (`policy` ="
        " closed_form).",
        "policy explicit": "Explicit Euler moves the bodies, with the velocities of the start of each step (`policy` ="
        " explicit).",
        "policy verlet": "Velocity Verlet moves the bodies, by the mean of the forces at the start and the end of each"
        " step (`policy` = verlet).",
        "policy runge_kutta": "The fourth-order Runge–Kutta method moves the bodies (`policy` = runge_kutta).",
        "policy semi_implicit": "Semi-implicit Euler moves the bodies, by the forces at the start of each step"
        " (`policy` = semi_implicit).",
        "signs exact": "All signs are exact: no tolerance decides on which side of a face a point is (`orient3d`).",
        "impact law": "Restitution follows the law of {} (`impact_law`).",
        "impact law dissipative": "Restitution follows Newton's law, and friction takes the most energy that it can"
        " (`impact_law` = dissipative).",
        "impact law newton": "Restitution follows Newton's law (`impact_law` = newton).",
        "impact law poisson": "Restitution follows Poisson's law (`impact_law` = poisson).",
        "impact law stronge": "Restitution follows Stronge's law (`impact_law` = stronge).",
        "shortest flight 1": "A ball rests if its next flight ends within one timestep (`shortest_flight` = 1).",
        "rest threshold steps": "An approach slower than {} g dt is answered without rebound (`rest_threshold_steps`).",
        "contact gap falls": "A contact counts from a gap of {} g dt² on, or of a nanometre (`contact_gap_falls`).",
        "with weight False": "The rebound is e times the speed before the step (`with_weight` = False).",
        "with weight True": "The rebound is e times the speed with what weight adds to it in the step"
        " (`with_weight` = True).",
        "overlap slop": "An overlap of {m} is left alone (`overlap_slop`).",
        "overlap recovery": "Of a deeper overlap, each step takes back the share {} (`overlap_recovery`).",
        "sweeps": "All contacts take their turn at most {} times a step (`sweeps`).",
        "tolerance": "They stop when no impulse changes by more than the share {} of the largest (`tolerance`).",
        "response simultaneous": "All contacts of a step are solved at once (`response` = simultaneous).",
        "response": "The contacts of a step are solved in the way {} (`response`).",
        "push sweeps": "To take back overlaps, they take their turn at most {} times a step (`push_sweeps`).",
        "shortest flight": "A ball rests if its next flight ends within {} timesteps (`shortest_flight`).",
    },
}
"""By engine and setting."""


def sentence_and_value(engine: str, told: str) -> tuple[str, str]:
    """The sentence of one setting, as `Settings.describe` writes it, and its value.

    A setting that has no sentence is its own: `stiffness 3`.
    """
    own = SENTENCES.get(engine, {})
    if told in own:
        return own[told], ""
    names = [name for name in own if told.startswith(f"{name} ")]
    if not names:
        return told.replace("{", "{{").replace("}", "}}"), ""
    name = max(names, key=len)
    return own[name], told.removeprefix(name).strip()
