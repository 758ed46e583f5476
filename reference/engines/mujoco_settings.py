"""MuJoCo's settings: what each profile tells it, what it then does, and which settings are worth moving."""

from __future__ import annotations

from reference.engines import mujoco_own_forces, mujoco_surveyor, surveying
from reference.engines.base import (
    ANSWERS_IN_SINGLE,
    AT_STEP,
    CIRCLE,
    COMPLIANT,
    DIAMOND,
    EXACT,
    MUJOCO_JOINT,
    MUJOCO_ONE_STEP,
    MUJOCO_SPRING,
    Method,
)
from reference.engines.mujoco_own_forces import FLUIDS, TENDONS
from reference.engines.profiles import JOINT, SWEPT
from reference.engines.sliding_joint import has_joint
from reference.engines.steering import sampled, unhurried
from reference.impact_truth import APART, NEWTON
from reference.scene import geometry
from reference.scene.draping import ball_under
from reference.scene.scenario import Box, Scenario
from reference.scene.settings import Move, Option, Settings, steps_per_sample
from reference.scene.survey import Survey

SPRING_STIFFNESS = 1e6
"""Stiffness per unit mass of the `spring` profile, 1/s²: a contact lasts about π ms and a 1 m drop sinks in 4.4 mm."""


WITHOUT_FRICTION = "contact", "integrator", "cone", "impedance"
"""What is told where no contact has friction."""


def settings_of(scenario: Scenario, profile: str) -> Settings:
    """Derive the settings of a profile; every option is a number that MuJoCo gets, under its own name."""
    if isinstance(scenario, Survey):
        return surveying.settings_of(**mujoco_surveyor.SETTINGS[profile])
    if profile == "stock":
        as_installed: dict[str, Option] = {"contact": "default", "integrator": "Euler", "cone": "pyramidal"}
        if scenario.meets_a_solid:
            as_installed[surveying.CONTACTS_OF] = surveying.HULL
        return sampled(scenario, Settings(2e-3, options=as_installed))
    if profile in (TENDONS, JOINT, *FLUIDS):
        told: dict[str, Option] = {"contact": "default", "integrator": "Euler", "cone": "pyramidal"}
        return Settings(1e-3, options=told | {"fluid" if profile in FLUIDS else "springs": profile})
    if profile == "spring":
        # √stiffness · timestep = 0.2 gives some sixteen steps a contact. RK4: Euler is first order here.
        return Settings(
            2e-4,
            steps_per_sample(2e-4),
            {
                "contact": "spring",
                "integrator": "RK4",
                "cone": "elliptic",
                "impedance": 0.9999,
                "stiffness": SPRING_STIFFNESS,
            },
        )
    restitution = max((pair.restitution for pair in scenario.pairs), default=0.0)
    sliding = restitution == 0 and geometry.starts_in_contact(scenario)
    options: dict[str, Option] = {
        "contact": "one step",
        "integrator": "Euler",
        "cone": "elliptic",
        "impedance": 0.9999,
        # Share of the overlap that the spring takes back in a step. What an impact leaves, up to v dt, comes back
        # as speed, so it must be small there and vanish with e → 1; a body that starts in contact needs it firm.
        "overlap_recovery": 0.1 if sliding else min(1e-4, 0.01 * (1 - restitution) ** 2),
        # MuJoCo's convex cone lifts a sliding contact. A tiny impratio takes friction out of the main solver, and
        # the noslip passes put Coulomb's cone back, without the lift.
        "impratio": 1e-10,
        "noslip_iterations": 5,
    }
    if scenario.meets_a_solid:
        options[surveying.CONTACTS_OF] = surveying.PIECES  # a mesh would be its hull
    if not scenario.pairs:
        return unhurried(scenario, Settings(1e-3, options=options))  # no instant of an impact can be missed
    if ball_under(scenario):
        # Nothing rebounds, so that overlap may come back fast. Without friction a contact is a number, and no cone.
        firm: dict[str, Option] = {"overlap_recovery": 0.1, "frictionless": True}
        return Settings(1e-3, options={**{name: options[name] for name in WITHOUT_FRICTION}, **firm})
    if geometry.leaning(scenario):
        # In a stack the normal forces depend on friction. Nothing slides, so the main solver may have it. At a
        # gap of exactly zero rounding decides whether MuJoCo sees a contact; with the margin it sees all of them.
        options |= {"impratio": 1.0, "noslip_iterations": 0, "margin": 1e-9}
        return Settings(1e-3, options=options)
    if sliding and any(isinstance(body.shape, Box) and not body.immovable for body in scenario.bodies):
        # Friction turns a slab's nose down, which the normal forces of the main solver do not know of, and corners
        # come off the ground in turn. Just above the critical slope, where the acceleration is a small difference,
        # the way shows how well friction is solved: 0.18 % off with 5 passes, 0.08 % with 20.
        options |= {"noslip_iterations": 20, "margin": 1e-8}
    elif sliding:
        options["margin"] = 1e-10  # a ball rises by as much, and its lever arm grows
    if profile == SWEPT:
        options["margin_steps"] = 1.0  # a step ends within the margin before any can end behind the surface
        return Settings(1e-3, options=options)
    return unhurried(scenario, Settings(1e-4, steps_per_sample(1e-4), options))


def method_of(scenario: Scenario, settings: Settings) -> Method:
    """A resolved spring is compliant; the others respond at the step. Overlap returns as speed."""
    if isinstance(scenario, Survey):
        return Method(EXACT, rule=ANSWERS_IN_SINGLE)
    if settings["contact"] == "spring":
        rule = MUJOCO_SPRING if settings["integrator"] == "RK4" else ""
        return Method(COMPLIANT, stiffness=settings.number("stiffness"), inset=0.5, rule=rule)
    share = settings.number("overlap_recovery") if "overlap_recovery" in settings.options else 0.0
    # The noslip passes change the friction and leave the normal impulse as it was without.
    passes = settings.options.get("noslip_iterations", 0)
    without_contacts = not scenario.pairs or scenario.steering  # nobody means to touch anybody; then all are one
    in_one_step = settings["contact"] == "one step" or without_contacts
    ours = MUJOCO_JOINT if has_joint(settings) else MUJOCO_ONE_STEP
    rule = ours if in_one_step and settings["integrator"] == "Euler" else ""
    law, cone = APART if passes else NEWTON, DIAMOND if settings["cone"] == "pyramidal" else CIRCLE
    drag = mujoco_own_forces.drag(settings)
    return Method(AT_STEP, speed_recovery=share, inset=0.5, drag=drag, law=law, rule=rule, cone=cone)


def moves_of(scenario: Scenario, settings: Settings) -> tuple[Move, ...]:
    """A firmer contact for what rests, a weaker one for what rebounds, or a stiffer spring; more noslip passes."""
    if not scenario.pairs:
        return ()
    if settings["contact"] == "spring":
        return (Move("contact model", "stiffness", 4 * settings.number("stiffness")),)
    if settings["contact"] == "default":
        return ()
    recovery, passes = settings.number("overlap_recovery"), settings.options.get("noslip_iterations", 0)
    rests = all(pair.restitution == 0 for pair in scenario.pairs)
    found = []
    if recovery:
        weaker = min(10 * recovery, 0.5) if rests else recovery / 10
        found.append(Move("contact model", "overlap_recovery", weaker))
    if passes:
        found.append(Move("solver", "noslip_iterations", 2 * int(passes)))
    return tuple(found)
