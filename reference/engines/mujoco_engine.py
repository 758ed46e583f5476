"""MuJoCo as an engine: units, frames and how its contact model is told a pair's restitution and friction.

MuJoCo has no coefficient of restitution. A contact is a spring and a dashpot, `solref = (−stiffness, −damping)`, that
sets the acceleration along the normal to −stiffness·r − damping·ṙ (with an impedance d near 1) and never pulls.

`contact = "one step"` (tuned): under Euler a damping of (1 + e)/dt turns the normal velocity v into −e v in exactly
one step, which is Newton's restitution; a small stiffness brings back what overlap is left.
`contact = "spring"`: the textbook reading, an elastic contact resolved over many steps; ζ follows from e.
`contact = "default"` (stock): what a user gets who sets nothing but the friction of the geoms.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from reference.engines import (
    mixing,
    mujoco_bodies,
    mujoco_own_forces,
    mujoco_read_back,
    mujoco_settings,
    mujoco_surveyor,
    surveying,
)
from reference.engines.base import (
    Engine,
    Method,
)
from reference.engines.mujoco_own_forces import FLUIDS, TENDONS
from reference.engines.profiles import JOINT, SWEPT
from reference.engines.ranges import COUNT_OR_NONE, NOT_NEGATIVE, POSITIVE, SHARE, Allowed, Range
from reference.engines.sliding_joint import SlidingJoint, has_joint, joint_of
from reference.scene import geometry, leaping
from reference.scene.draping import ball_under
from reference.scene.loads import Loads
from reference.scene.off_centre import may_rub_off_centre, may_strike_off_centre
from reference.scene.query import Distance, Query, Ray
from reference.scene.scenario import Scenario
from reference.scene.settings import Move, Settings
from reference.scene.straight_spring import on_one_spring
from reference.scene.survey import Survey
from reference.scene.trajectory import Recorder, Trajectory

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
        "margin_steps": NOT_NEGATIVE,
        "springs": (TENDONS, JOINT),
        "fluid": FLUIDS,
        **mujoco_surveyor.ALLOWED,
        surveying.CONTACTS_OF: (surveying.PIECES, surveying.HULL),
    }

    def profiles(self, scenario: Scenario) -> Mapping[str, str]:
        """`spring`, a resolved contact, joins where something falls; `swept` for fast shots; a spring has two more.

        A mesh that drapes over a ball does not rebound, and what forces it has it is told once a step.
        """
        found = {"tuned": "one-step contact"}
        if leaping.may_leap(scenario):  # a spring would give way farther than the wall is thick
            found[SWEPT] = "contact a step ahead"
        elif scenario.pairs and not (
            geometry.starts_in_contact(scenario) or scenario.steering or scenario.meets_a_solid or ball_under(scenario)
        ):
            found["spring"] = "spring–dashpot contact"
        if scenario.in_flight and len(scenario.springs) == 1:  # the lab computes the forces of a whole mesh
            found[TENDONS] = "a tendon for the spring"
        if on_one_spring(scenario):
            found[JOINT] = "a sliding joint with a spring"
        if scenario.in_flight and scenario.fluid and not scenario.springs and not scenario.attractions:
            found |= {name: f"its fluid, {name}" for name in FLUIDS}
        return found | {"stock": "defaults, friction set"}

    def settings(self, scenario: Scenario, profile: str) -> Settings:
        """Derive the settings of a profile; every option is a number that MuJoCo gets, under its own name."""
        self.check_profile(scenario, profile)
        return mujoco_settings.settings_of(scenario, profile)

    def method(self, scenario: Scenario, settings: Settings) -> Method:
        """A resolved spring is compliant; the others respond at the step. Overlap returns as speed."""
        return self.steered(scenario, mujoco_settings.method_of(scenario, settings))

    def moves(self, scenario: Scenario, settings: Settings) -> tuple[Move, ...]:
        """A firmer contact for what rests, a weaker one for what rebounds, or a stiffer spring; more noslip passes."""
        return mujoco_settings.moves_of(scenario, settings)

    def run(self, scenario: Scenario, settings: Settings) -> Trajectory:
        """Build the model, step it in C between samples and read positions and velocities at the samples."""
        mujoco: Any = self.module()
        if isinstance(scenario, Survey):
            return surveying.run(self, mujoco_surveyor.Surveyor(mujoco, settings), scenario, settings)
        self.check_friction(scenario)
        self.check_impacts(scenario)
        steps = self.check_settings(scenario, settings)
        mujoco.set_mju_user_warning(lambda message: None)  # a bad state is found in the samples; write no log file
        model = self._model(mujoco, scenario, settings)
        mujoco_read_back.check_world(mujoco, model, scenario, settings)
        mujoco_own_forces.check(model, scenario, settings)
        state = mujoco.MjData(model)
        movable = [place for place, body in enumerate(scenario.bodies) if not body.immovable]
        joint = joint_of(scenario, settings)
        for slot, place in enumerate(movable):
            mujoco_bodies.set_velocity(state, slot, scenario.bodies[place], joint)
        loads = Loads(mujoco_own_forces.from_outside(scenario, settings), steers=self.steers(scenario))
        recorder = Recorder(self.name, scenario, settings)
        fixed = [list(body.state()) for body in scenario.bodies]
        bodies = (model.geom_bodyid - 1).tolist()  # body 0 is the world
        recorder.sample(_state(state, movable, fixed, joint))
        changes = loads.scenario.pushes_change
        at_once = 1 if changes else settings.sample_every
        for number in range(0, steps, at_once):
            if changes or (number == 0 and scenario.forces):
                _push(state, loads, movable, fixed, number * settings.timestep)
            mujoco.mj_step(model, state, nstep=at_once)
            if (number + at_once) % settings.sample_every:
                continue
            recorder.sample(_state(state, movable, fixed, joint))
            if state.ncon:
                _keep_contacts(recorder, state.contact, bodies)
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
        if surveying.is_of_solids(query):
            return surveying.ask(self, query)
        assert isinstance(query, Ray | Distance)
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
        contacts_of = str(settings.options.get(surveying.CONTACTS_OF, surveying.HULL))
        friction = self._stock_friction(scenario) if stock else [None] * len(scenario.bodies)
        for body, own_friction in zip(scenario.bodies, friction, strict=True):
            free = not has_joint(settings)
            mujoco_bodies.add_body(mujoco, spec, body, own_friction, contacts_of, free=free)
        if not stock:
            for pair in scenario.pairs:
                margin = mujoco_read_back.margin_of(scenario, settings)
                mujoco_bodies.set_restitution_and_friction(spec, scenario, pair, settings, margin)
        else:
            for first, second in scenario.unlisted_pairs():
                spec.add_exclude(bodyname1=first, bodyname2=second)
        mujoco_own_forces.add(spec, scenario, settings)
        return spec.compile()

    def _stock_friction(self, scenario: Scenario) -> Sequence[float]:
        """One friction per body such that the larger one of every pair is what the scenario asks for."""
        friction = mixing.greatest(scenario, lambda pair: pair.kinetic_friction)
        if friction is None:
            raise self.cannot(scenario, "it takes the larger friction of two geoms, and no choice gives all pairs")
        return friction


def _choice(enumeration: Any, prefix: str, name: str) -> Any:
    return getattr(enumeration, prefix + name.upper())


def _state(state: Any, movable: list[int], fixed: list[list[float]], joint: SlidingJoint | None = None) -> list[float]:
    """The 13 numbers of every body in the scenario's order; the spin stays in the body's frame, as MuJoCo keeps it."""
    numbers = list(fixed)
    poses, velocities = state.qpos.tolist(), state.qvel.tolist()
    if joint:
        poses, velocities = joint.as_free(*poses, *velocities)
    for slot, place in enumerate(movable):
        numbers[place] = poses[7 * slot : 7 * slot + 7] + velocities[6 * slot : 6 * slot + 6]
    return [number for values in numbers for number in values]


def _push(state: Any, loads: Loads, movable: list[int], fixed: list[list[float]], time: float) -> None:
    """Hand MuJoCo the forces and torques that act until the next ones are handed over; its body 0 is the world."""
    if loads.kept(time) is not None:
        return  # they are as they were told
    numbers = np.array(_state(state, movable, fixed)).reshape(len(fixed), 13)
    position, orientation, velocity, own_spin = np.split(numbers, (3, 7, 10), axis=-1)
    force, torque = loads.on_bodies(time, position, orientation, velocity, geometry.rotate(orientation, own_spin))
    state.xfrc_applied[1:] = np.concatenate([force, torque], axis=-1)


def _keep_contacts(recorder: Recorder, contact: Any, bodies: list[int]) -> None:
    """Keep the contacts of the latest step. MuJoCo's normal points from its first geom to its second: A is that.

    bodies: the place of each geom's body in the scenario.
    """
    columns = (contact.geom, contact.pos, contact.frame[:, :3], contact.dist)
    for (first, second), position, normal, separation in zip(*(column.tolist() for column in columns), strict=True):
        recorder.contact(bodies[second], bodies[first], position, normal, separation)


ENGINE = MuJoCo
