"""A third engine in one file, as anyone may add one: a ball over one plane, stepped by symplectic Euler.

`collisions … --engine path/to/toy_engine.py` is all it takes; nothing else in the lab knows of this file.
"""

from __future__ import annotations

import numpy as np

from reference.engines.base import AT_STEP, Engine, Method
from reference.scene import geometry
from reference.scene.scenario import HalfSpace, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Recorder, Trajectory


class Toy(Engine):
    """v' = v + g dt, p' = p + v' dt; a ball behind the plane that moves in is sent back with e times its speed."""

    name = "toy"
    title = "a toy"

    def settings(self, scenario: Scenario, profile: str) -> Settings:
        """Derive the timestep; there is nothing else to set."""
        self.check_profile(scenario, profile)
        return Settings({"tuned": 1e-3, "stock": 4e-3}[profile])

    def method(self, scenario: Scenario, settings: Settings) -> Method:
        """It answers at the step."""
        return Method(AT_STEP)

    def run(self, scenario: Scenario, settings: Settings) -> Trajectory:
        """Step one ball over one plane, without friction and without spin."""
        shapes, pairs = [type(body.shape) for body in scenario.bodies], scenario.pairs
        turns = any(part for body in scenario.bodies for part in body.angular_velocity)
        if sorted(shapes, key=str) != [HalfSpace, Sphere] or not pairs or pairs[0].kinetic_friction or turns:
            raise self.cannot(scenario, "it knows one ball over one plane, without friction and without spin")
        steps, dt = self.check_settings(scenario, settings), settings.timestep
        ball, plane = (scenario.bodies[shapes.index(shape)] for shape in (Sphere, HalfSpace))
        gravity, normal = np.array(scenario.gravity), np.array(plane.shape.normal)
        position, velocity = np.array(ball.position), np.array(ball.velocity)
        pose = np.array([ball.orientation])
        recorder = Recorder(self.name, scenario, settings)
        for step in range(steps + 1):
            if step % settings.sample_every == 0:
                now = {ball.name: (*position, *ball.orientation, *velocity, *ball.angular_velocity)}
                still = (*plane.position, *plane.orientation, *plane.velocity, *plane.angular_velocity)
                recorder.sample([number for body in scenario.bodies for number in now.get(body.name, still)])
            gap = geometry.separation(scenario, ball.name, plane.name, position[None], pose)[0]
            inward = min(0.0, float(velocity @ normal))
            if gap < 0 and inward:
                velocity = velocity - (1 + pairs[0].restitution) * inward * normal
            else:
                velocity = velocity + gravity * dt
            position = position + velocity * dt
        return recorder.trajectory()


ENGINE = Toy
