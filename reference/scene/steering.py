"""Steering: bodies that move by themselves, each with a force that a rule of the lecture asks for.

A scenario names the rule. An engine takes the function of that name from its implementation.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from reference import checks
from reference.checks import Vector
from reference.errors import InvalidInput, UnknownName

RULES: Mapping[str, tuple[str, ...]] = {
    "seek": (),
    "flee": (),
    "arrive": ("slowing_radius",),
    "steer_around": (),
    "repelling_force": ("strength", "reach", "response_time"),
    "flock_step": ("radius", "separation", "alignment", "cohesion", "max_acceleration", "response_time"),
    "crowd_step": ("slowing_radius", "horizon"),
}
"""Each rule, a function of the lecture, and the parameters that it needs besides the common ones."""
DIVISORS = ("reach", "response_time", "horizon")
"""Parameters that something is divided by."""
AROUND = ("steer_around", "repelling_force", "flock_step")
"""The rules that heed obstacles."""


@dataclass(frozen=True)
class Steering:
    """A rule that steers some bodies of a scenario, each to a goal of its own.

    rule: one of `RULES`. bodies: whom it steers. goals: where to, one for each body, m. max_speed: m/s. interval: the
    rule is asked every so many seconds, and in between each force stays as it is. max_force: the largest force of a
    body, N. obstacles: bodies that stand still, of which the rule knows the bounding sphere. margin: by which a rule
    takes bodies for larger than they are, m. parameters: those that the rule needs, by name, in SI units:

    - slowing_radius, m, of `arrive`, which `crowd_step` uses for the velocity that a body would like to have;
    - horizon, s, for which `crowd_step` excludes collisions;
    - radius, m, the weights separation, m²/s², alignment, 1/s, and cohesion, 1/s², max_acceleration, m/s², all of
      `flock_step`;
    - strength, N, and reach, m, of the repelling field;
    - response_time, s, in which a boid, or a body in a field, would turn towards its goal.

    A rule gives the velocity that each body wants. To get it within the interval takes the force m (v_wanted − v)/τ
    with the interval as τ, shortened to max_force. A repelling force acts as it is, beside the force m (v_wanted − v)/τ
    with the response time as τ that draws the body to its goal.
    """

    rule: str
    bodies: tuple[str, ...]
    goals: tuple[Vector, ...]
    max_speed: float
    interval: float
    max_force: float = math.inf
    obstacles: tuple[str, ...] = ()
    margin: float = 0.0
    parameters: tuple[tuple[str, float], ...] = ()

    def __post_init__(self) -> None:
        if self.rule not in RULES:
            raise UnknownName("steering rule", self.rule, RULES)
        for name in ("bodies", "obstacles"):
            object.__setattr__(self, name, checks.all_of(f"{self.rule}: {name}", getattr(self, name), str))
        if not self.bodies or len(set(self.bodies)) != len(self.bodies):
            raise InvalidInput(f"{self.rule} steers {self.bodies}; it needs one or more bodies, each once")
        if len(self.goals) != len(self.bodies):
            raise InvalidInput(f"{self.rule} has {len(self.goals)} goals for {len(self.bodies)} bodies")
        goals = (checks.vector(f"goal of {name}", goal) for name, goal in zip(self.bodies, self.goals, strict=True))
        object.__setattr__(self, "goals", tuple(goals))
        for name in ("max_speed", "interval"):
            object.__setattr__(self, name, checks.positive(f"{self.rule}: {name}", getattr(self, name)))
        if self.max_force != math.inf:
            object.__setattr__(self, "max_force", checks.positive(f"{self.rule}: max_force", self.max_force))
        object.__setattr__(self, "margin", checks.not_negative(f"{self.rule}: margin", self.margin))
        self._check_parameters()

    def _check_parameters(self) -> None:
        """Refuse parameters that the rule does not have, and obstacles that it would not heed."""
        try:
            told = dict(self.parameters)
        except (TypeError, ValueError):
            raise InvalidInput(
                f"{self.rule}: parameters is {self.parameters!r}; it must hold names with their numbers,"
                f" (name, number), of {RULES[self.rule]}"
            ) from None
        if tuple(told) != RULES[self.rule]:
            raise InvalidInput(
                f"{self.rule} has the parameters {tuple(told)}; it needs {RULES[self.rule]}, in this order"
            )
        known = tuple(
            (name, (checks.positive if name in DIVISORS else checks.not_negative)(f"{self.rule}: {name}", value))
            for name, value in told.items()
        )
        object.__setattr__(self, "parameters", known)
        if (horizon := dict(known).get("horizon", math.inf)) < self.interval:
            raise InvalidInput(
                f"{self.rule}: horizon is {horizon:g} s; it must be no shorter than the interval, {self.interval:g} s,"
                " in which each body keeps its velocity"
            )
        if self.obstacles and self.rule not in AROUND:
            raise InvalidInput(f"{self.rule} heeds no obstacles, and has {self.obstacles}; {', '.join(AROUND)} do")

    def parameter(self, name: str) -> float:
        """A parameter of the rule, by name."""
        return dict(self.parameters)[name]
