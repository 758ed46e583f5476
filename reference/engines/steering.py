"""The steering rules of a scenario, asked of an implementation: the force with which each body moves itself.

All engines and the recurrence use this module, so a student's rule steers the bodies of every engine. Each rule is a
function of the lecture. The module passes a scenario to the rule and turns the velocity that it returns into a force.
"""

from __future__ import annotations

import math
import reprlib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace

import numpy as np

from reference.arrays import Array
from reference.engines.implementation import Implementation
from reference.errors import InvalidInput, RunFailed
from reference.scene.loads import Steers
from reference.scene.scenario import Body, Box, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.steering import Steering

ROUNDING = 1e-9
"""Share of an interval by which a step may begin too early, in rounding, for the rule to be asked again."""
STEPS = 4
"""Steps in an interval of steering, where nothing else asks for shorter ones."""


def unhurried(scenario: Scenario, settings: Settings) -> Settings:
    """The settings with long steps and one sample an interval where bodies are steered.

    No contact is meant to happen there, and between two contacts a step may be as long as the steering allows.
    """
    if not scenario.steering:
        return settings
    interval = min(steering.interval for steering in scenario.steering)
    return sampled(scenario, replace(settings, timestep=interval / STEPS))


def sampled(scenario: Scenario, settings: Settings) -> Settings:
    """The settings with one sample an interval where bodies are steered: a body's force changes no more often."""
    if not scenario.steering:
        return settings
    interval = min(steering.interval for steering in scenario.steering)
    return replace(settings, sample_every=max(1, round(interval / settings.timestep)))


def steers_of(scenario: Scenario, implementation: Implementation) -> Steers | None:
    """What all rules of a scenario ask for together, for one run; None where nothing is steered."""
    return _Rules(scenario, implementation) if scenario.steering else None


class _Rules:
    """All rules of one run."""

    def __init__(self, scenario: Scenario, implementation: Implementation) -> None:
        self._rules = [_Rule(scenario, steering, implementation) for steering in scenario.steering]

    def waits(self, time: float) -> bool:
        """Whether all forces are at this time what they were when they were last asked for."""
        return not any(rule.is_due(time) for rule in self._rules)

    def __call__(self, time: float, position: Array, velocity: Array) -> Array:
        force = np.zeros(position.shape)
        for rule in self._rules:
            force[rule.places] = rule.held(time, position, velocity)
        return force


class _Rule:
    """One rule in one run. It is asked at the first step of each interval, and its forces stay until the next."""

    def __init__(self, scenario: Scenario, told: Steering, implementation: Implementation) -> None:
        self.told, self.function = told, implementation.function
        self.places = np.array([scenario.index(name) for name in told.bodies])
        bodies = [scenario.body(name) for name in told.bodies]
        self.goals, self.mass = np.array(told.goals), np.array([body.mass for body in bodies])
        self.radius = np.array([_bounding_radius(body) for body in bodies])
        obstacles = [scenario.body(name) for name in told.obstacles]
        self.centres = np.array([body.position for body in obstacles]).reshape(-1, 3)
        self.reaches = np.array([_bounding_radius(body) for body in obstacles])
        for told_to_code in (self.goals, self.mass, self.radius):
            told_to_code.flags.writeable = False  # or a rule that changes its arguments would change the scenario
        self._asked, self._force = 0, np.zeros((len(bodies), 3))

    def is_due(self, time: float) -> bool:
        """Whether an interval has begun in which the rule has not been asked yet."""
        return time >= (self._asked - ROUNDING) * self.told.interval

    def held(self, time: float, position: Array, velocity: Array) -> Array:
        """The force on each steered body at a time, (n, 3), N."""
        if self.is_due(time):
            self._asked = math.floor(time / self.told.interval + ROUNDING) + 1
            own = position[self.places], velocity[self.places]
            for each in own:
                each.flags.writeable = False
            self._force = self._now(*own)
        return self._force

    def _now(self, position: Array, velocity: Array) -> Array:
        if self.told.rule == "repelling_force":
            return _in_a_field(self, position, velocity)
        return self.force(velocity, WANTED[self.told.rule](self, position, velocity), self.told.interval)

    def force(self, velocity: Array, wanted: Array, time: float) -> Array:
        """The force that would give each body the wanted velocity within so many seconds."""
        answer = self.function("steering_force")(velocity, wanted, self.mass, time, self.told.max_force)
        return numbers("steering_force", answer, velocity.shape)

    def around(self, position: Array, velocity: Array) -> Array:
        """Direction of each body to its goal, or around the nearest obstacle."""
        if not len(self.centres):
            return numbers("seek", self.function("seek")(position, self.goals, 1.0), position.shape)
        nearest = np.argmin(self._gaps(position), axis=-1)
        reach = self.reaches[nearest] + self.radius + self.told.margin
        answer = self.function("steer_around")(position, velocity, self.goals, self.centres[nearest], reach)
        return numbers("steer_around", answer, position.shape)

    def _gaps(self, position: Array) -> Array:
        """From each body to the bounding sphere of each obstacle, (n, obstacles), m."""
        between = np.linalg.norm(position[:, None] - self.centres, axis=-1)
        return np.asarray(between - self.reaches - self.radius[:, None])

    def field(self, position: Array) -> Array:
        """The repelling forces of all obstacles on each body, (n, 3), N."""
        away = position[:, None] - self.centres
        normal = away / np.linalg.norm(away, axis=-1, keepdims=True)
        strength, reach = self.told.parameter("strength"), self.told.parameter("reach")
        answer = self.function("repelling_force")(self._gaps(position), normal, strength, reach)
        return np.asarray(np.sum(numbers("repelling_force", answer, normal.shape), axis=1))


def numbers(name: str, answer: object, shape: tuple[int, ...]) -> Array:
    """What a function of an implementation gave, as an array of finite numbers.

    Raises
    ------
    RunFailed
        If it is of another shape, or holds anything else than finite numbers; the message names the function.
    """
    try:
        found = np.asarray(answer)
    except ValueError:
        raise RunFailed(f"{name} returned rows of unequal length; it must return an array {shape}") from None
    if found.dtype.kind not in "biuf":
        raise RunFailed(f"{name} returned {reprlib.repr(answer)}; it must return an array {shape} of real numbers")
    if found.shape != shape:
        raise RunFailed(f"{name} returned an array {found.shape}; its shape must be {shape}")
    if not np.all(np.isfinite(found)):
        first = found[~np.isfinite(found)][0]
        raise RunFailed(f"{name} returned {first}; it must return finite numbers")
    return np.asarray(found, dtype=np.float64)


def _second(name: str, answer: object, shape: tuple[int, ...]) -> Array:
    """The velocities of a function that returns positions and velocities."""
    if not isinstance(answer, tuple | list) or len(answer) != 2:
        raise RunFailed(f"{name} returned {reprlib.repr(answer)}; it must return two arrays, positions and velocities")
    return numbers(name, answer[1], shape)


def _bounding_radius(body: Body) -> float:
    """Radius of the sphere about its centre that just holds a body, m."""
    if isinstance(body.shape, Sphere):
        return body.shape.radius
    if isinstance(body.shape, Box):
        return math.hypot(*body.shape.half_extents)
    raise InvalidInput(
        f"{body.name} is a {type(body.shape).__name__}; steering knows the size of balls and boxes alone"
    )


# What each rule wants: velocities (n, 3), m/s


def _to_the_goal(rule: _Rule, position: Array, velocity: Array) -> Array:
    return _towards_the_goal(rule, rule.told.rule, position)


def _towards_the_goal(rule: _Rule, name: str, position: Array) -> Array:
    answer = rule.function(name)(position, rule.goals, rule.told.max_speed)
    return numbers(name, answer, position.shape)


def _to_stop_there(rule: _Rule, position: Array, velocity: Array) -> Array:
    told = rule.told
    answer = rule.function("arrive")(position, rule.goals, told.max_speed, told.parameter("slowing_radius"))
    return numbers("arrive", answer, position.shape)


def _around(rule: _Rule, position: Array, velocity: Array) -> Array:
    return rule.told.max_speed * rule.around(position, velocity)


def _in_a_crowd(rule: _Rule, position: Array, velocity: Array) -> Array:
    """Discs in the plane, each larger by the margin."""
    told, preferred = rule.told, _to_stop_there(rule, position, velocity)
    flat = (values[:, :2] for values in (position, velocity, preferred))
    radius = rule.radius + told.margin
    answer = rule.function("crowd_step")(*flat, radius, told.max_speed, told.parameter("horizon"), told.interval)
    wanted = _second("crowd_step", answer, (len(position), 2))
    return np.concatenate([wanted, np.zeros((len(position), 1))], axis=-1)


def _in_a_flock(rule: _Rule, position: Array, velocity: Array) -> Array:
    """What separation, alignment and cohesion give, and a share of the turn towards the goal or around an obstacle."""
    told = rule.told
    weights = tuple(told.parameter(name) for name in ("separation", "alignment", "cohesion"))
    limits = told.max_speed, told.parameter("max_acceleration")
    answer = rule.function("flock_step")(position, velocity, told.interval, told.parameter("radius"), weights, *limits)
    among = _second("flock_step", answer, position.shape)
    turn = told.max_speed * rule.around(position, velocity) - velocity
    wanted = among + told.interval / told.parameter("response_time") * turn
    return numbers("limited", rule.function("limited")(wanted, told.max_speed), position.shape)


WANTED: Mapping[str, Callable[[_Rule, Array, Array], Array]] = {
    "seek": _to_the_goal,
    "flee": _to_the_goal,
    "arrive": _to_stop_there,
    "steer_around": _around,
    "flock_step": _in_a_flock,
    "crowd_step": _in_a_crowd,
}
"""The velocity that each rule wants, from the rule, positions and velocities. A repelling force wants none."""


CALLS: Mapping[str, tuple[str, ...]] = {
    "seek": ("seek", "steering_force"),
    "flee": ("flee", "steering_force"),
    "arrive": ("arrive", "steering_force"),
    "repelling_force": ("repelling_force", "seek", "steering_force"),
    "steer_around": ("steer_around", "seek", "steering_force"),
    "flock_step": ("flock_step", "steer_around", "seek", "limited", "steering_force"),
    "crowd_step": ("crowd_step", "arrive", "steering_force"),
}
"""The functions of an implementation that each rule may call."""


def functions_of(scenarios: Iterable[Scenario]) -> frozenset[str]:
    """The functions of an implementation that steer bodies of these scenarios."""
    return frozenset(name for each in scenarios for told in each.steering for name in CALLS[told.rule])


def _in_a_field(rule: _Rule, position: Array, velocity: Array) -> Array:
    """A body is drawn to its goal, and pushed off by each obstacle that it is near."""
    wanted = _towards_the_goal(rule, "seek", position)
    return rule.force(velocity, wanted, rule.told.parameter("response_time")) + rule.field(position)
