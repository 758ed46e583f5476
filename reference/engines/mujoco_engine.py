"""MuJoCo as an engine: units, frames and how its contact model is told a pair's restitution and friction.

MuJoCo has no coefficient of restitution. A contact is a spring and a dashpot, `solref = (−stiffness, −damping)`, that
sets the acceleration along the normal to −stiffness·r − damping·ṙ (with an impedance d near 1) and never pulls.

`contact = "one step"` (tuned): under Euler a damping of (1 + e)/dt turns the normal velocity v into −e v in exactly
one step, which is Newton's restitution; a small stiffness brings back what overlap is left.
`contact = "spring"`: the textbook reading, an elastic contact resolved over many steps; ζ follows from e.
`contact = "default"` (stock): what a user gets who sets nothing but the friction of the geoms. It has no restitution.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from reference import truth
from reference.engines import mixing, mujoco_read_back
from reference.engines.base import AT_STEP, COMPLIANT, MUJOCO_ONE_STEP, MUJOCO_SPRING, Engine, Method
from reference.engines.ranges import COUNT_OR_NONE, NOT_NEGATIVE, POSITIVE, SHARE, Allowed, Range
from reference.impact_truth import APART, NEWTON
from reference.scene import geometry
from reference.scene.off_centre import may_rub_off_centre, may_strike_off_centre
from reference.scene.query import Query, Ray
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere
from reference.scene.settings import Move, Option, Settings, steps_per_sample
from reference.scene.trajectory import Recorder, Trajectory

SPRING_STIFFNESS = 1e6
"""Stiffness per unit mass of the `spring` profile, 1/s²: a contact lasts about π ms and a 1 m drop sinks in 4.4 mm."""
FARTHEST = 1e6
"""Distance beyond which no two geoms lie, m: MuJoCo searches for closest points up to it."""


class MuJoCo(Engine):
    """DeepMind's MuJoCo, through its own Python package."""

    name = "mujoco"
    title = "MuJoCo"
    order = 20
    package = "mujoco"
    extra = "mujoco"
    wheels = "CPython from 3.11 on Linux, macOS on ARM and Windows"
    applies_forces = True
    allowed: ClassVar[Mapping[str, Allowed]] = {
        "contact": ("one step", "spring", "default"),
        "integrator": ("Euler", "RK4", "implicit", "implicitfast"),
        "cone": ("elliptic", "pyramidal"),
        "impedance": Range(1e-4, 0.9999),  # MuJoCo takes the nearest of these for any other
        "stiffness": POSITIVE,
        "overlap_recovery": SHARE,
        "impratio": POSITIVE,
        "noslip_iterations": COUNT_OR_NONE,
        "margin": NOT_NEGATIVE,
    }

    def profiles(self, scenario: Scenario) -> Mapping[str, str]:
        """`spring`, the resolved contact of the textbooks, joins where something falls."""
        found = {"tuned": "one-step contact"}
        if not geometry.starts_in_contact(scenario):
            found["spring"] = "spring–dashpot contact"
        return found | {"stock": "defaults, friction set"}

    def settings(self, scenario: Scenario, profile: str) -> Settings:
        """Derive the settings of a profile; every option is a number that MuJoCo gets, under its own name."""
        self.check_profile(scenario, profile)
        if profile == "stock":
            return Settings(2e-3, options={"contact": "default", "integrator": "Euler", "cone": "pyramidal"})
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
        return Settings(1e-4, steps_per_sample(1e-4), options)

    def method(self, scenario: Scenario, settings: Settings) -> Method:
        """A resolved spring is compliant; the others respond at the step. Overlap returns as speed."""
        if settings["contact"] == "spring":
            rule = MUJOCO_SPRING if settings["integrator"] == "RK4" else ""
            return Method(COMPLIANT, stiffness=settings.number("stiffness"), inset=0.5, rule=rule)
        share = settings.number("overlap_recovery") if "overlap_recovery" in settings.options else 0.0
        # The noslip passes change the friction and leave the normal impulse as it was without.
        passes = settings.options.get("noslip_iterations", 0)
        rule = MUJOCO_ONE_STEP if settings["contact"] == "one step" and settings["integrator"] == "Euler" else ""
        return Method(AT_STEP, speed_recovery=share, inset=0.5, law=APART if passes else NEWTON, rule=rule)

    def moves(self, scenario: Scenario, settings: Settings) -> tuple[Move, ...]:
        """A firmer contact for what rests, a weaker one for what rebounds, or a stiffer spring; more noslip passes."""
        if settings["contact"] == "spring":
            return (Move("contact model", "stiffness", 4 * settings.number("stiffness")),)
        if settings["contact"] == "default":
            return ()
        recovery, passes = settings.number("overlap_recovery"), int(settings.number("noslip_iterations"))
        rests = all(pair.restitution == 0 for pair in scenario.pairs)
        found = []
        if recovery:
            weaker = min(10 * recovery, 0.5) if rests else recovery / 10
            found.append(Move("contact model", "overlap_recovery", weaker))
        if passes:
            found.append(Move("solver", "noslip_iterations", 2 * passes))
        return tuple(found)

    def run(self, scenario: Scenario, settings: Settings) -> Trajectory:
        """Build the model, step it in C between samples and read positions and velocities at the samples."""
        mujoco: Any = self.module()
        self.check_friction(scenario)
        self.check_impacts(scenario)
        steps = self.check_settings(scenario, settings)
        mujoco.set_mju_user_warning(lambda message: None)  # a bad state is found in the samples; write no log file
        model = self._model(mujoco, scenario, settings)
        mujoco_read_back.check_world(mujoco, model, scenario, settings)
        state = mujoco.MjData(model)
        movable = [place for place, body in enumerate(scenario.bodies) if not body.immovable]
        for slot, place in enumerate(movable):
            _set_velocity(state, slot, scenario.bodies[place])
        for force in scenario.forces:
            state.xfrc_applied[1 + scenario.index(force.body), :3] += force.force  # body 0 is the world
        recorder = Recorder(self.name, scenario, settings)
        fixed = [list(body.state()) for body in scenario.bodies]
        recorder.sample(_state(state, movable, fixed))
        for _ in range(steps // settings.sample_every):
            mujoco.mj_step(model, state, nstep=settings.sample_every)
            recorder.sample(_state(state, movable, fixed))
            if state.ncon:
                _keep_contacts(recorder, state.contact)
        return recorder.trajectory(spin_in_body_frame=True)

    def check_impacts(self, scenario: Scenario) -> None:
        """Refuse impacts off the centre of a body with rebound and friction; see docs/engines-mujoco.md.

        The convex solver adds μ times the slip that is left to the speed of parting. The noslip passes take that away,
        but they settle friction after the normal impulse, which off the centre depends on it. It also does where a face
        or an edge lands and slips: friction presses the corners ahead, and each corner is beside the centre.
        """
        if may_strike_off_centre(scenario) or may_rub_off_centre(scenario):
            raise self.cannot(scenario, "no setting of it keeps both e and μ in an impact off the centre of a body")

    def query(self, query: Query) -> float:
        """Answer with MuJoCo's own rays and distances of geoms."""
        mujoco: Any = self.module()
        bodies = (query.body,) if isinstance(query, Ray) else (query.body_a, query.body_b)
        scenario = Scenario("query", bodies, (), 1.0, (0.0, 0.0, 0.0))
        model = self._model(mujoco, scenario, self.settings(scenario, "stock"))
        state = mujoco.MjData(model)
        mujoco.mj_forward(model, state)
        if isinstance(query, Ray):
            # MuJoCo takes its ray for endless, and −1 for a miss.
            share = mujoco.mj_ray(model, state, np.array(query.start), np.array(query.way), None, 1, -1, None)
            return float(share) if 0 <= share <= 1 else math.inf
        return float(mujoco.mj_geomDistance(model, state, 0, 1, FARTHEST, None))

    def _model(self, mujoco: Any, scenario: Scenario, settings: Settings) -> Any:
        spec = mujoco.MjSpec()
        spec.option.timestep = settings.timestep
        spec.option.gravity = scenario.gravity
        spec.option.integrator = _choice(mujoco.mjtIntegrator, "mjINT_", str(settings["integrator"]))
        spec.option.cone = _choice(mujoco.mjtCone, "mjCONE_", str(settings["cone"]))
        spec.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)  # or a bad state restarts the run
        if "impratio" in settings.options:
            spec.option.impratio = settings.number("impratio")
            spec.option.noslip_iterations = int(settings.number("noslip_iterations"))
            spec.option.noslip_tolerance = 0.0
        stock = settings["contact"] == "default"
        friction = self._stock_friction(scenario) if stock else [None] * len(scenario.bodies)
        for body, own_friction in zip(scenario.bodies, friction, strict=True):
            self._add_body(mujoco, spec, body, own_friction)
        if not stock:
            for pair in scenario.pairs:
                set_restitution_and_friction(spec, pair, settings)
        else:
            for first, second in scenario.unlisted_pairs():
                spec.add_exclude(bodyname1=first, bodyname2=second)
        return spec.compile()

    def _stock_friction(self, scenario: Scenario) -> Sequence[float]:
        """One friction per body such that the larger one of every pair is what the scenario asks for."""
        friction = mixing.greatest(scenario, lambda pair: pair.kinetic_friction)
        if friction is None:
            raise self.cannot(scenario, "it takes the larger friction of two geoms, and no choice gives all pairs")
        return friction

    def _add_body(self, mujoco: Any, spec: Any, body: Body, friction: float | None) -> None:
        orientation: Any = body.orientation
        if isinstance(body.shape, HalfSpace):
            orientation = geometry.upright_on(np.array(body.shape.normal))
        frame = spec.worldbody.add_body(name=body.name, pos=body.position, quat=orientation)
        kind, size = _geom(mujoco, body.shape)
        options: dict[str, Any] = {"contype": 0, "conaffinity": 0}  # only the pairs that are listed collide
        if friction is not None:
            options = {"friction": [friction, 0.005, 0.0001]}  # the two others are MuJoCo's defaults
        if not body.immovable:
            frame.add_freejoint()
            options["mass"] = body.mass
        if body.inertia:
            frame.explicitinertial, frame.mass, frame.inertia = True, body.mass, body.inertia
            frame.ipos, frame.iquat = (0, 0, 0), (1, 0, 0, 0)  # in the body; without it MuJoCo takes the body's pose
        frame.add_geom(name=body.name, type=kind, size=size, **options)


def set_restitution_and_friction(spec: Any, pair: Pair, settings: Settings) -> None:
    """Add an explicit contact pair: its `solref` makes the restitution."""
    dt, restitution, friction = settings.timestep, pair.restitution, pair.kinetic_friction
    impedance = settings.number("impedance")
    # An impedance that does not depend on depth; width, midpoint and power, which then do nothing, are the defaults
    options: dict[str, Any] = {"solimp": [impedance, impedance, 0.001, 0.5, 2]}
    if settings["contact"] == "one step":
        options["solref"] = [-settings.number("overlap_recovery") / dt**2, -(1 + restitution) / dt]
        options["solreffriction"] = [0, -1 / dt]  # takes away the whole slip in a step, as far as Coulomb allows
    else:
        stiffness = settings.number("stiffness")
        ratio = min(truth.damping_ratio(restitution), mujoco_read_back.MOST_DAMPED)
        options["solref"] = [-stiffness, -2 * ratio * math.sqrt(stiffness)]
    if "margin" in settings.options:
        options["margin"] = settings.number("margin")
    spec.add_pair(
        geomname1=pair.body_a,
        geomname2=pair.body_b,
        condim=mujoco_read_back.DIMENSIONS,
        friction=[friction, friction, 0, 0, 0],
        **options,
    )


def _choice(enumeration: Any, prefix: str, name: str) -> Any:
    return getattr(enumeration, prefix + name.upper())


def _geom(mujoco: Any, shape: Sphere | Box | HalfSpace) -> tuple[Any, list[float]]:
    if isinstance(shape, Sphere):
        return mujoco.mjtGeom.mjGEOM_SPHERE, [shape.radius, 0, 0]
    if isinstance(shape, Box):
        return mujoco.mjtGeom.mjGEOM_BOX, list(shape.half_extents)
    return mujoco.mjtGeom.mjGEOM_PLANE, [0, 0, 1]  # infinite


def _set_velocity(state: Any, slot: int, body: Body) -> None:
    """A free joint's velocity: linear in the world frame, angular in the body's own."""
    conjugate = geometry.opposite(np.array(body.orientation))
    state.qvel[6 * slot : 6 * slot + 3] = body.velocity
    state.qvel[6 * slot + 3 : 6 * slot + 6] = geometry.rotate(conjugate, np.array(body.angular_velocity))


def _state(state: Any, movable: list[int], fixed: list[list[float]]) -> list[float]:
    """The 13 numbers of every body in the scenario's order; the spin stays in the body's frame, as MuJoCo keeps it."""
    numbers = list(fixed)
    poses, velocities = state.qpos.tolist(), state.qvel.tolist()
    for slot, place in enumerate(movable):
        numbers[place] = poses[7 * slot : 7 * slot + 7] + velocities[6 * slot : 6 * slot + 6]
    return [number for values in numbers for number in values]


def _keep_contacts(recorder: Recorder, contact: Any) -> None:
    """Keep the contacts of the latest step. MuJoCo's normal points from its first geom to its second: A is that."""
    columns = (contact.geom, contact.pos, contact.frame[:, :3], contact.dist)
    for (first, second), position, normal, separation in zip(*(column.tolist() for column in columns), strict=True):
        recorder.contact(second, first, position, normal, separation)  # one geom a body, in the bodies' order


ENGINE = MuJoCo
