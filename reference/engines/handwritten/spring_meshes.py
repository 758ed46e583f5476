"""Spring meshes: their shape at rest, their vibrations, their steps and their contacts, all with the mesh topic."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from reference.arrays import Array
from reference.engines.handwritten.loads import LoadsByHand
from reference.engines.handwritten.stepping import Step, policy_of, record, start
from reference.engines.implementation import Implementation
from reference.scene.draping import ball_under, reach
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.spring_network import network
from reference.scene.trajectory import Trajectory

BALANCE = 1e-10
"""Net force that `static_shape` may leave, as a share of the largest weight."""
STILL = 1e-7
"""The same where nothing has a weight, as a share of the largest force at the start of a small vibration: rounding of
the rest lengths leaves more than 10⁻¹⁰ of it."""


def settle(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """A mesh that comes to rest: with `exact_root` it takes its last shape at once, with `at_step` it steps there."""
    return _run(_Settling, engine, scenarios, settings, steps, implementation)


def vibrate(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """A mesh that vibrates: with `exact_root` each of its modes swings by itself, with `at_step` the mesh steps."""
    return _run(_Vibrating, engine, scenarios, settings, steps, implementation)


def drape(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """A mesh that comes to rest on a ball: it steps, and its nodes then respond to the ball that they have entered."""
    return _run(_Draping, engine, scenarios, settings, steps, implementation)


def _run(
    kind: Callable[[Scenario, Settings, Implementation], _Mesh],
    engine: str,
    scenarios: Sequence[Scenario],
    settings: Settings,
    steps: list[int],
    implementation: Implementation,
) -> list[Trajectory]:
    found = []
    for scenario, count in zip(scenarios, steps, strict=True):
        mesh = kind(scenario, settings, implementation)
        step = policy_of(mesh.policies(), settings)
        found += record(engine, [scenario], settings, [count], mesh.states, step, [[]])
    return found


class _Mesh:
    """The nodes of a scenario, its bodies first and then points of the world, and the implementation's mesh of them."""

    def __init__(self, scenario: Scenario, settings: Settings, implementation: Implementation) -> None:
        self.net, self.dt, self.function = network(scenario), settings.timestep, implementation.function
        self._start, bodies = start([scenario]), len(scenario.bodies)
        pinned = np.flatnonzero(~np.isfinite(self.net.mass)).tolist()
        mesh = self.function("spring_mesh")(
            self.net.place, self.net.edges, self.net.stiffness, self.net.damping, self.net.mass, pinned
        )
        self.mesh: Any = mesh._replace(rest_length=self.net.rest_length)  # the shape at the start is not one at rest
        self.place, self.velocity = self.net.place, np.zeros_like(self.net.place)
        self.velocity[:bodies] = self._start[0, :, 7:10]
        self.gravity = np.array(scenario.gravity)
        # Springs are the mesh's own; the rest of the forces is added to the weight.
        self._loads = LoadsByHand([replace(scenario, springs=())], implementation)

    def policies(self) -> dict[str, Step]:
        """The steps that this kind of mesh has."""
        return {"at_step": self.step_by_forces}

    def step_by_forces(self, time: float) -> None:
        """Step with the forces at the start of the step."""
        acceleration = self._acceleration(time, self.velocity)
        self.place, self.velocity = self.function("mesh_step")(
            self.mesh, self.place, self.velocity, acceleration, self.dt
        )

    def _acceleration(self, time: float, velocity: Array) -> Array:
        """What weight, pushes and the fluid make of the motion of each node, (n, 3), m/s²."""
        bodies = self._start.shape[1]
        state = self.place[:bodies], self._start[0, :, 3:7], velocity[:bodies], np.zeros((bodies, 3))
        force = np.zeros_like(self.place)
        force[:bodies] = self._loads.on_bodies(time, state)[0]
        return np.asarray(self.gravity + force / self.net.mass[:, None])

    def states(self) -> Array:
        """The states of all bodies as a sample keeps them, (1, bodies, 13)."""
        states, bodies = self._start.copy(), self._start.shape[1]
        states[0, :, :3], states[0, :, 7:10] = self.place[:bodies], self.velocity[:bodies]
        return states


class _Solved(_Mesh, ABC):
    """A mesh whose motion, or what becomes of it, has a formula too."""

    def policies(self) -> dict[str, Step]:
        """The formula, and the steps."""
        return {"exact_root": self.step_exactly, **super().policies()}

    @abstractmethod
    def step_exactly(self, time: float) -> None:
        """Take the state at the end of the step from a formula for this kind of mesh."""


class _Settling(_Solved):
    """A mesh that comes to rest."""

    def step_exactly(self, time: float) -> None:
        """Take the shape at rest; from then on nothing changes."""
        if time > 0:
            return
        acceleration = self._acceleration(time, np.zeros_like(self.velocity))
        self.place = self.function("static_shape")(self.mesh, self.place, acceleration, BALANCE)
        self.velocity = np.zeros_like(self.velocity)


class _Draping(_Mesh):
    """A mesh of alike balls that comes to rest on a fixed ball, without friction or rebound.

    No function of the lecture has its shape at rest: `static_shape` knows no contact.
    """

    def __init__(self, scenario: Scenario, settings: Settings, implementation: Implementation) -> None:
        super().__init__(scenario, settings, implementation)
        ball = ball_under(scenario)
        assert ball is not None
        self._centre = np.array(ball.position)
        self._reach = next(reach(ball, body) for body in scenario.bodies if not body.immovable)

    def step_by_forces(self, time: float) -> None:
        """Step, and move the balls that the step has taken into the large one back onto it."""
        super().step_by_forces(time)
        self.place, self.velocity = self.function("mesh_sphere_contact")(
            self.mesh, self.place, self.velocity, self._centre, self._reach
        )


class _Vibrating(_Solved):
    """A mesh that vibrates a little about the shape in which no spring pulls."""

    def __init__(self, scenario: Scenario, settings: Settings, implementation: Implementation) -> None:
        super().__init__(scenario, settings, implementation)
        if settings["policy"] == "exact_root":
            self._find_modes()

    def _find_modes(self) -> None:
        """Modes q of the free nodes, with √m scaled out: K q = ω² q, and the damping 2ζω of each."""
        self._rest = self.function("static_shape")(self.mesh, self.place, np.zeros(3), STILL)
        self._rows = (3 * self.net.free[:, None] + np.arange(3)).ravel()
        self._scale = np.repeat(np.sqrt(self.net.mass[self.net.free]), 3)
        matrices = [self._matrix(name) for name in ("edge_stiffness", "edge_damping")]
        squares, self._modes = np.linalg.eigh(matrices[0])
        dampings = np.einsum("im,ij,jm->m", self._modes, matrices[1], self._modes)
        # Rounding makes a little of the modes that nothing resists, on either side of zero.
        self._oscillators = np.maximum(squares, 0.0), np.maximum(dampings, 0.0)
        displacement = (self.place - self._rest).ravel()[self._rows]
        self._first = tuple(
            self._modes.T @ (self._scale * each) for each in (displacement, self.velocity.ravel()[self._rows])
        )

    def _matrix(self, of_edges: str) -> Array:
        """The matrix of the free nodes, from the implementation's of each edge, divided by the masses."""
        whole = self.function("mesh_matrix")(self.mesh, self.function(of_edges)(self.mesh, self._rest))
        return np.asarray(whole[np.ix_(self._rows, self._rows)] / np.outer(self._scale, self._scale))

    def step_exactly(self, time: float) -> None:
        """Let each mode swing from the start to the end of this step."""
        found = self.function("damped_oscillator")(*self._first, *self._oscillators, 1.0, time + self.dt)
        displacement, velocity = np.zeros(self.place.size), np.zeros(self.place.size)
        for values, mode in ((displacement, found[0]), (velocity, found[1])):
            values[self._rows] = (self._modes @ mode) / self._scale
        self.place = self._rest + displacement.reshape(-1, 3)
        self.velocity = velocity.reshape(-1, 3)
