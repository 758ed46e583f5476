"""What an engine is to the lab: it derives settings from a scenario, and runs the scenario with them."""

from __future__ import annotations

import importlib
import importlib.metadata
import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import ModuleType
from typing import ClassVar, TypedDict

from reference.engines import distributions, profiles
from reference.engines.implementation import Implementation
from reference.engines.ranges import Allowed, check_options
from reference.engines.steering import ROUNDING, steers_of
from reference.errors import CannotExpress, EngineBroken, EngineNotInstalled, InvalidInput, NoWords, UnknownName
from reference.impact_truth import NEWTON
from reference.scene.loads import Steers
from reference.scene.polyhedron import Polyhedron
from reference.scene.query import Query
from reference.scene.scenario import Scenario, Sphere
from reference.scene.settings import Move, Settings
from reference.scene.trajectory import Trajectory

EXACT, INTERPOLATED, AT_STEP, COMPLIANT = "exact", "interpolated", "at step", "compliant"
RULES = (
    RESPOND_THEN_STEP,
    STEP_THEN_PUT_OUT,
    TURN_BACK,
    CHORD,
    PENALTY,
    EXPLICIT,
    VERLET,
    RUNGE_KUTTA,
    WORLD,
    BULLET,
    BULLET_DAMPED,
    BULLET_SPRING,
    MUJOCO_ONE_STEP,
    MUJOCO_SPRING,
    MUJOCO_JOINT,
    DART,
    DART_JOINT,
    ANSWERS_EXACT,
    ANSWERS_OF_BULLET,
    ANSWERS_IN_SINGLE,
) = (
    "respond, then step",
    "step, then put out",
    "turn back, then step",
    "chord",
    "penalty",
    "explicit Euler",
    "velocity Verlet",
    "Runge–Kutta",
    "the world's",
    "Bullet's",
    "Bullet's, damped",
    "Bullet's spring",
    "MuJoCo's in one step",
    "MuJoCo's spring",
    "MuJoCo's joint",
    "DART's",
    "DART's joint",
    "exact answers",
    "Bullet's answers",
    "answers of vertices in single precision",
)
"""The recurrences that `reference.prediction` has, step by step; the last three are of surveys, which have no steps."""
CONES = CIRCLE, DIAMOND, SQUARE = "circle", "diamond", "square"
"""What friction on a level plane may be: within a circle (Coulomb's law), |x| + |y| ≤ μN, or |x| ≤ μN and |y| ≤ μN."""
MOST_STEPS = 10**8
"""No engine takes more steps than this within the time limit of a job."""


@dataclass(frozen=True)
class Method:
    """How an engine treats the instant at which a force changes. An expectation computes what that does to a quantity.

    kind: it solves for the instant (`EXACT`), interpolates it as the slide does (`INTERPOLATED`), notices it at the
    next step of semi-implicit Euler (`AT_STEP`) or spreads the force over a stiff contact (`COMPLIANT`).
    recovery: share of the overlap that the step of the response takes back without adding speed.
    speed_recovery: share of the overlap that this step turns into speed, so that later steps take it back.
    stiffness: of a compliant contact, per unit mass, 1/s².
    rest_speed: the engine lets a body rest after an impact slower than this, m/s.
    inset: share of the overlap by which the point where forces act lies inside a body.
    softness: share of the change of speed, (1 + e) v, by which an impact falls short.
    weighed: share of the speed that gravity adds in the step of an impact, which the impact turns back as well.
    law: of restitution in an impact with friction, one of `reference.impact_truth` or `reference.spatial_impact`.
    reach: gap up to which it makes a contact, m.
    cone: which friction forces it lets a plane make, one of those above; the corners of a diamond and the sides of a
    square lie along its axes.
    drag: of a ball in a fluid, as a share of Stokes' drag.
    rule: the recurrence that a run follows step by step, one of those above; "" if none has been written down.
    steered_by: the hand-written code that steers bodies; None where nothing is steered.
    in_turn: whether impacts of bodies that touch in a row are passed on one after another within a step.
    """

    kind: str
    recovery: float = 0.0
    speed_recovery: float = 0.0
    stiffness: float = math.inf
    rest_speed: float = 0.0
    inset: float = 0.0
    softness: float = 0.0
    weighed: float = 0.0
    law: str = NEWTON
    reach: float = 0.0
    rule: str = ""
    drag: float = 1.0
    cone: str = CIRCLE
    steered_by: Implementation | None = None
    in_turn: bool = False

    def __post_init__(self) -> None:
        if self.cone not in CONES:
            raise InvalidInput(f"the cone of a method is {self.cone!r}; it is one of {', '.join(CONES)}")
        if self.rule and self.rule not in RULES:
            raise InvalidInput(f"the rule of a method is {self.rule!r}; it is one of {', '.join(RULES)}, or none, ''")


class Versions(TypedDict):
    """What a row says of the engine that gave it, and of the lab's adapter to that engine."""

    engine_version: str
    adapter_version: str


class Engine(ABC):
    """One implementation of rigid-body motion.

    name: as typed on the command line. title: as printed. order: place in tables. package: the module that it needs,
    None for ours. distributions: what may have installed that, where it is not called alike. extra: the extra of
    this project that installs it. installing: the command for it, where it is another. wheels: where its package can
    be installed without a compiler. applies_forces: whether it lets forces, springs and the like act, whatever the
    scenario. allowed: what each option may be; one that is not in it may be anything of its kind. implementation: which
    hand-written code runs. All of it is the hand-written engine's; the others ask it where bodies are steered.
    """

    name: ClassVar[str]
    title: ClassVar[str]
    order: ClassVar[int] = 100
    package: ClassVar[str | None] = None
    distributions: ClassVar[tuple[str, ...]] = ()
    extra: ClassVar[str | None] = None
    installing: ClassVar[str] = ""
    wheels: ClassVar[str] = ""
    applies_forces: ClassVar[bool] = False
    allowed: ClassVar[Mapping[str, Allowed]] = {}

    def __init__(self, implementation: Implementation | None = None) -> None:
        self.implementation = implementation or Implementation()

    def profiles(self, scenario: Scenario) -> Mapping[str, str]:
        """Name → one-line description of each set of settings that makes sense here: `tuned` first, `stock` last.

        The hand-written engine has methods in their place, `exact` first and `step` last.
        """
        return {profiles.TUNED: "says what the scenario means", profiles.STOCK: "what a user gets who sets nothing"}

    @abstractmethod
    def settings(self, scenario: Scenario, profile: str) -> Settings:
        """Derive the settings of a profile for a scenario; raise `UnknownName` if the engine has no such profile."""

    @abstractmethod
    def method(self, scenario: Scenario, settings: Settings) -> Method:
        """How the engine treats the instant at which a force changes, with these settings."""

    def moves(self, scenario: Scenario, settings: Settings) -> tuple[Move, ...]:
        """Settings worth moving, each to a better value, to see how much of an error is due to it; none by default."""
        return ()

    @abstractmethod
    def run(self, scenario: Scenario, settings: Settings) -> Trajectory:
        """Run a scenario and return its trajectory, first sample at time 0."""

    def query(self, query: Query) -> float:
        """Answer a question of geometry; an engine that knows the answer overrides this."""
        raise CannotExpress(f"{self.title} answers no questions of geometry")

    def run_many(self, scenarios: Sequence[Scenario], settings: Settings) -> list[Trajectory]:
        """Run several scenarios with the same settings; an engine that can run them together overrides this."""
        return [self.run(scenario, settings) for scenario in scenarios]

    def runs_together(self, settings: Settings) -> bool:
        """Whether `run_many` runs the scenarios of several cases together, more quickly; no engine does by default."""
        return False

    def lets_forces_act(self, scenario: Scenario, settings: Settings) -> bool:
        """Whether it lets this scenario's forces act; an engine that does in some scenarios alone overrides this."""
        return self.applies_forces

    def sources(self) -> tuple[str, ...]:
        """Names of the distributions that may have installed the engine's package, the preferred one first."""
        return self.distributions or ((self.package,) if self.package else ())

    def distribution(self) -> importlib.metadata.Distribution | None:
        """The distribution that has installed the engine's package; None where nobody says.

        Raises
        ------
        EngineNotInstalled
            If the package is not here.
        """
        package = self.package or ""
        if not distributions.is_here(package):
            raise self._missing("no such package")
        return distributions.installed(self.sources(), package)

    def version(self) -> str:
        """Version of the engine's package, or of this project for our own; `EngineNotInstalled` where it is missing."""
        if not self.package:
            return distributions.lab_version()
        found = self.distribution()
        return (found and found.version) or distributions.UNKNOWN

    def versions(self) -> Versions:
        """The versions of the engine and of the adapter; the engine's is empty where it is missing."""
        try:
            version = self.version()
        except EngineNotInstalled:
            version = ""
        return {"engine_version": version, "adapter_version": distributions.lab_version()}

    def module(self) -> ModuleType:
        """Import the engine's package, late; `EngineNotInstalled` says how to get it, or why it cannot be imported."""
        try:
            return importlib.import_module(self.package or "reference")
        except ModuleNotFoundError as error:
            if error.name == self.package:
                raise self._missing(str(error)) from None
            raise EngineBroken(f"{self.title} is installed but cannot be imported: {error}") from None
        except ImportError as error:
            raise EngineBroken(f"{self.title} is installed but cannot be imported: {error}") from None

    def _missing(self, why: str) -> EngineNotInstalled:
        said, where = f"{self.title} is not installed here ({why})", f"ready-made for {self.wheels}"
        if self.extra and not distributions.offered(self.sources(), self.extra):
            return EngineNotInstalled(f"{said}, and there is no package of it for this machine: it is {where}")
        how = self.installing or (f'pip install -e ".[{self.extra}]"' if self.extra else f"pip install {self.package}")
        return EngineNotInstalled(f"{said}; to get it: {how}" + f" ({where})" * bool(self.wheels))

    def steers(self, scenario: Scenario) -> Steers | None:
        """What the scenario's steering rules ask for in one run, in the implementation's words; None without any."""
        return steers_of(scenario, self.implementation)

    def steered(self, scenario: Scenario, method: Method) -> Method:
        """The method with the code that steers, where anything is steered."""
        return replace(method, steered_by=self.implementation) if scenario.steering else method

    def check_profile(self, scenario: Scenario, profile: str) -> None:
        """Refuse a profile that this engine does not have for this scenario, naming those it has."""
        if profile not in self.profiles(scenario):
            kind, choices = f"profile of {self.title} for {scenario.name}", self.profiles(scenario)
            raise UnknownName(kind, profile, choices, profiles.counterpart(profile))

    def check_settings(self, scenario: Scenario, settings: Settings) -> int:
        """Return how many steps cover the scenario, in whole samples; refuse what cannot be stepped through.

        Raises
        ------
        InvalidInput
            If an option is out of its range, or if the timestep is longer than the scenario or than the interval of a
            steering rule, or so short that there are too many.
        CannotExpress
            If forces act that this engine does not apply.
        NoWords
            If a polyhedron is in the way of anything but a ball.
        """
        check_options(self.allowed, settings.options)
        self._check_solids(scenario)
        if (scenario.forces or scenario.pushes_change) and not self.lets_forces_act(scenario, settings):
            raise self.cannot(scenario, "it knows no forces but weight and those of contacts")
        if settings.timestep * settings.sample_every > scenario.duration:
            raise InvalidInput(
                f"timestep {settings.timestep:g} s × {settings.sample_every} steps a sample is longer than"
                f" {scenario.name}, which lasts {scenario.duration:g} s"
            )
        for steering in scenario.steering:
            if settings.timestep > steering.interval * (1 + ROUNDING):
                raise InvalidInput(
                    f"timestep {settings.timestep:g} s is longer than the {steering.interval:g} s after which"
                    f" {steering.rule} is asked again"
                )
        steps = settings.steps_for(scenario.duration)
        if steps > MOST_STEPS:
            made = f"timestep {settings.timestep:g} s makes {steps:.1e} steps of {scenario.name}"
            raise InvalidInput(f"{made}; {MOST_STEPS:.0e} is the most")
        return steps

    def _check_solids(self, scenario: Scenario) -> None:
        for pair in scenario.pairs:
            shapes = [scenario.body(name).shape for name in (pair.body_a, pair.body_b)]
            if any(isinstance(shape, Polyhedron) for shape in shapes) and not any(
                isinstance(shape, Sphere) for shape in shapes
            ):
                raise NoWords(f"in {scenario.name} a polyhedron is in the way of a body that is no ball")

    def check_friction(self, scenario: Scenario) -> None:
        """Refuse a pair whose static friction is not its kinetic friction, for an engine that has one coefficient."""
        for pair in scenario.pairs:
            if pair.static_friction != pair.kinetic_friction:
                two = f"static {pair.static_friction:g} and kinetic {pair.kinetic_friction:g}"
                raise self.cannot(scenario, f"it has one coefficient of friction, not {two}")

    def cannot(self, scenario: Scenario, what: str) -> CannotExpress:
        """Make the error for a scenario that this engine has no words for."""
        return CannotExpress(f"{self.title} cannot express {scenario.name}: {what}")
