"""Springs and fluids by MuJoCo's own means.

A spring is a spatial tendon between two sites, with its stiffness and its damping. MuJoCo computes the force of a
tendon at the start of a step, as the lab does for the other engines. The spring of a ball that moves along it alone may
also be that of a sliding joint, whose damping the integrator `Euler` takes as it will be at the end of the step.

A fluid is a viscosity and a wind, and a share of each body's weight that is taken off for its buoyancy. MuJoCo is given
no density: with a density its models add forces beyond Stokes' law, which grow with the square of the velocity. In the
profile `ellipsoid`, the model of a geom, a ball has Stokes' drag. In the profile `inertia box`, the model of a body, it
has the drag of a cube with the same inertia.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from reference.engines import read_back
from reference.engines.sliding_joint import SlidingJoint, has_joint, joint_of
from reference.scene.scenario import Body, Scenario, Sphere
from reference.scene.settings import Settings

TITLE = "MuJoCo"
TENDONS = "tendons"
SLIDE = "slide"
"""Name of a sliding joint."""
SLIDING = 2
"""MuJoCo's number for the type of a sliding joint, `mjJNT_SLIDE`."""
ELLIPSOID, INERTIA_BOX = FLUIDS = "ellipsoid", "inertia box"
"""Profiles, and values of the options `springs` and `fluid`."""
DRAG_OF_THE_BOX = math.sqrt(3 / 5)
"""Drag of the inertia box over that of the ball: the cube with 2/5 m r² has the edge r √(12/5), and MuJoCo takes its
edge for the diameter of a ball."""


def add(spec: Any, scenario: Scenario, settings: Settings) -> None:
    """Add to a model what the settings tell MuJoCo in its own words."""
    if has_tendons(settings):
        add_tendons(spec, scenario)
    if joint := joint_of(scenario, settings):
        add_joint(spec, joint)
    if of_fluid(settings):
        fill_with_fluid(spec, scenario, settings)


def check(model: Any, scenario: Scenario, settings: Settings) -> None:
    """Refuse a model that is not what it was told in its own words."""
    if has_tendons(settings):
        check_tendons(model, scenario)
    if joint := joint_of(scenario, settings):
        check_joint(model, joint)
    if of_fluid(settings):
        check_fluid(model, scenario, settings)


def has_tendons(settings: Settings) -> bool:
    """Whether MuJoCo has the springs as tendons of its own."""
    return settings.options.get("springs") == TENDONS


def add_tendons(spec: Any, scenario: Scenario) -> None:
    """Add a tendon for each spring."""
    for number, spring in enumerate(scenario.springs):
        tendon = spec.add_tendon(name=_name(number))
        tendon.stiffness, tendon.damping = [spring.stiffness, 0, 0], [spring.damping, 0, 0]  # linear: no higher powers
        tendon.springlength = [spring.rest_length, spring.rest_length]  # from … to: it is slack nowhere
        for end, (body, point) in enumerate(((spring.body_a, spring.point_a), (spring.body_b, spring.point_b))):
            frame = spec.body(body) if body else spec.worldbody
            frame.add_site(name=f"{_name(number)} {end}", pos=point)
            tendon.wrap_site(f"{_name(number)} {end}")


def check_tendons(model: Any, scenario: Scenario) -> None:
    """Refuse a model whose tendons are not the springs."""
    read_back.check(TITLE, "number of tendons", len(scenario.springs), model.ntendon)
    for number, spring in enumerate(scenario.springs):
        read_back.check(TITLE, f"stiffness of {_name(number)}", spring.stiffness, model.tendon_stiffness[number])
        read_back.check(TITLE, f"damping of {_name(number)}", spring.damping, model.tendon_damping[number])
        rest = (spring.rest_length, spring.rest_length)
        read_back.check(TITLE, f"rest length of {_name(number)}", rest, model.tendon_lengthspring[number])


def add_joint(spec: Any, joint: SlidingJoint) -> None:
    """Let the ball slide along its spring; the coordinate of the joint is the spring's length."""
    body, spring = spec.body(joint.body.name), joint.spring
    slide = body.add_joint(
        name=SLIDE, type=SLIDING, axis=joint.axis, ref=joint.ends.length, springref=spring.rest_length
    )
    slide.stiffness, slide.damping = [spring.stiffness, 0, 0], [spring.damping, 0, 0]  # linear: no higher powers


def check_joint(model: Any, joint: SlidingJoint) -> None:
    """Refuse a model whose joint is not the spring."""
    read_back.check(TITLE, "number of degrees of freedom", 1, model.nv)
    read_back.check(TITLE, "axis of the joint", tuple(joint.axis), model.jnt_axis[0])
    read_back.check(TITLE, "length of the spring", joint.ends.length, model.qpos0[0], "m")
    read_back.check(TITLE, "rest length of the spring", joint.spring.rest_length, model.qpos_spring[0], "m")
    read_back.check(TITLE, "stiffness of the joint", joint.spring.stiffness, model.jnt_stiffness[0], "N/m")
    read_back.check(TITLE, "damping of the joint", joint.spring.damping, model.dof_damping[0], "N s/m")


def of_fluid(settings: Settings) -> bool:
    """Whether MuJoCo has the fluid as one of its own."""
    return settings.options.get("fluid") in FLUIDS


def drag(settings: Settings) -> float:
    """Of a ball in a fluid, as a share of Stokes' drag."""
    return DRAG_OF_THE_BOX if settings.options.get("fluid") == INERTIA_BOX else 1.0


def fill_with_fluid(spec: Any, scenario: Scenario, settings: Settings) -> None:
    """Set viscosity and wind, the model of each geom, and the lift of each ball; bodies and geoms are there already."""
    fluid = scenario.fluid
    assert fluid
    spec.option.viscosity, spec.option.wind = fluid.viscosity, fluid.velocity
    for body in scenario.bodies:
        if not body.immovable:
            spec.body(body.name).gravcomp = _lifted(scenario, body)
            spec.geom(body.name).fluid_ellipsoid = float(settings["fluid"] == ELLIPSOID)


def check_fluid(model: Any, scenario: Scenario, settings: Settings) -> None:
    """Refuse a model with another fluid."""
    fluid = scenario.fluid
    assert fluid
    read_back.check(TITLE, "viscosity of the fluid", fluid.viscosity, model.opt.viscosity, "Pa s")
    read_back.check(TITLE, "density of the fluid", 0.0, model.opt.density, "kg/m³")
    read_back.check(TITLE, "wind", fluid.velocity, model.opt.wind, "m/s")
    for place, body in enumerate(scenario.bodies):
        if not body.immovable:
            read_back.check(TITLE, f"lift of {body.name}", _lifted(scenario, body), model.body_gravcomp[place + 1])
            ellipsoid = float(settings["fluid"] == ELLIPSOID)
            read_back.check(TITLE, f"fluid model of {body.name}", ellipsoid, model.geom_fluid[place, 0])


def from_outside(scenario: Scenario, settings: Settings) -> Scenario:
    """The scenario with only those forces that the lab computes for MuJoCo, step by step."""
    if has_tendons(settings) or has_joint(settings):
        scenario = replace(scenario, springs=())
    return replace(scenario, fluid=()) if of_fluid(settings) else scenario


def _lifted(scenario: Scenario, body: Body) -> float:
    """The share of its weight that a ball loses in the fluid."""
    assert scenario.fluid
    assert isinstance(body.shape, Sphere)
    return scenario.fluid.density * 4 / 3 * math.pi * body.shape.radius**3 / body.mass


def _name(number: int) -> str:
    return f"spring {number}"
