"""The terms of a band that were measured, measured again on random scenes: none too small, none far too large."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest

from reference.engines import load_engine
from reference.prediction import bands, bouncing, corners, sliding
from reference.prediction.predicted import Prediction
from reference.scene import geometry
from reference.scene.forces import GrowingForce
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere
from reference.scene.trajectory import Trajectory

SEED = 20261128
LEAST_OF_A_CONSTANT = 0.1
"""A measured constant is at most ten times the worst of the random scenes."""


def on_a_slope(rng, slope, friction, speed, height, duration, towards_x=False) -> Scenario:
    """A box of unequal sides on a slope that falls towards no axis, or towards x; it slides along one of its own."""
    about = rng.uniform(0, 2 * math.pi) * (not towards_x)
    turn = np.array([math.cos(about / 2), 0.0, 0.0, math.sin(about / 2)])
    normal, down = (
        geometry.rotate(turn, np.array(each))
        for each in (
            (math.sin(slope), 0.0, math.cos(slope)),
            (math.cos(slope), 0.0, -math.sin(slope)),
        )
    )
    standing = geometry.turned(turn, slope * np.cross([0.0, 0.0, 1.0], normal) / max(math.sin(slope), 1e-12))
    half = np.array([*rng.uniform(0.08, 0.3, size=2), 0.0])
    half[2] = half[0] * height
    box = Body("box", Box(tuple(half)), rng.uniform(0.2, 5), tuple(half[2] * normal), tuple(standing))
    pair = Pair("box", "plane", kinetic_friction=friction)
    bodies = Body("plane", HalfSpace(tuple(normal))), replace(box, velocity=tuple(speed * down))
    return Scenario("random", bodies, (pair,), duration)


def held(rng) -> Scenario:
    slope = rng.uniform(0.05, 0.6)
    friction = math.tan(slope) * rng.uniform(1.01, 2.5)
    return on_a_slope(rng, slope, friction, 0.0, min(rng.uniform(0.05, 1.0), 0.9 / friction), 0.5)


def sliding_down(rng, least=0.1, most=0.94, duration=0.5) -> Scenario:
    slope = rng.uniform(0.05, 0.6)
    speed, height = rng.uniform(0, 1.5) * (rng.uniform() < 0.6), min(rng.uniform(0.05, 1.0), 0.9 / math.tan(slope))
    return on_a_slope(rng, slope, math.tan(slope) * rng.uniform(least, most), speed, height, duration)


def nearly_critical(rng, towards_x=False) -> Scenario:
    slope = rng.uniform(0.05, 0.6)
    height = min(rng.uniform(0.05, 1.0), 0.9 / math.tan(slope))
    return on_a_slope(rng, slope, math.tan(slope) * rng.uniform(0.955, 0.995), 0.0, height, 0.5, towards_x)


def nearly_critical_towards_x(rng) -> Scenario:
    """Along an axis of Bullet's friction."""
    return nearly_critical(rng, towards_x=True)


def pushed(rng) -> Scenario:
    """A slab on the level under a push that grows until it breaks away."""
    slab = on_a_slope(rng, 0.0, rng.uniform(0.2, 0.6), 0.0, rng.uniform(0.05, 0.3), 0.5)
    box, pair = slab.body("box"), slab.pairs[0]
    ahead = geometry.rotate(np.array(box.orientation), np.array([1.0, 0.0, 0.0]))
    rate = pair.kinetic_friction * box.mass * 9.81 / rng.uniform(0.2, 0.4)
    return replace(slab, forces=(GrowingForce("box", tuple(rate * ahead)),))


def dropped_flat(rng) -> Scenario:
    half = rng.uniform(0.05, 0.2, size=3)
    drop, restitution = rng.uniform(0.1, 1.0), rng.uniform(0.2, 0.9)
    box = Body("box", Box(tuple(half)), rng.uniform(0.2, 5), (0.0, 0.0, half[2] + drop))
    pair = Pair("box", "plane", restitution, rng.uniform(0, 0.5))
    until = math.sqrt(2 * drop / 9.81) * (1 + 1.5 * restitution)  # on its way down again
    return Scenario("random", (Body("plane", HalfSpace()), box), (pair,), until)


def on_an_edge(rng) -> Scenario:
    half = rng.uniform(0.05, 0.2, size=3)
    angle = rng.uniform(0.1, 1.4)
    turn = np.array([math.cos(angle / 2), 0.0, math.sin(angle / 2), 0.0])
    lowest = abs(math.cos(angle)) * half[2] + abs(math.sin(angle)) * half[0]
    velocity = rng.uniform(-1, 1), 0.0, -rng.uniform(0.5, 2)
    box = Body("box", Box(tuple(half)), rng.uniform(0.2, 5), (0.0, 0.0, lowest + 0.0105), tuple(turn), velocity)
    pair = Pair("box", "plane", rng.uniform(0.2, 0.9), rng.uniform(0.1, 0.6))
    return Scenario("random", (Body("plane", HalfSpace()), box), (pair,), 0.03, (0.0, 0.0, 0.0))


def fast_along_x(rng) -> Scenario:
    return on_a_slope(rng, 0.0, rng.uniform(0.05, 0.5), rng.uniform(8, 20), rng.uniform(0.05, 0.2), 0.5, towards_x=True)


def at_the_places(predicted: Trajectory, run: Trajectory) -> float:
    """Of the ways from the start, as shares of them or of 1 m; what is aside of a way has a slack of its own."""
    ways = [np.linalg.norm(each.positions - each.positions[0], axis=-1) for each in (predicted, run)]
    return float(np.max(np.abs(ways[0] - ways[1]) / np.maximum(1.0, ways[0])))


def at_the_ends(predicted: Trajectory, run: Trajectory) -> float:
    """Of the positions, velocities and spins of all bodies at the end, as shares of them or of one unit.

    A spin counts as the velocity that it gives the surface.
    """
    shapes = [body.shape for body in run.scenario.bodies]
    out = [
        shape.radius if isinstance(shape, Sphere) else np.linalg.norm(getattr(shape, "half_extents", 0))
        for shape in shapes
    ]
    pairs = [(getattr(predicted, part)[-1], getattr(run, part)[-1]) for part in ("positions", "velocities")]
    pairs.append(tuple(np.array(out)[:, None] * each.angular_velocities[-1] for each in (predicted, run)))
    sizes = [np.maximum(1.0, np.linalg.norm(one, axis=-1)) for one, _ in pairs]
    offs = [np.linalg.norm(one - other, axis=-1) / size for (one, other), size in zip(pairs, sizes, strict=True)]
    return float(np.max(offs))


def of_a_landing(predicted: Trajectory, run: Trajectory) -> float:
    """Of positions, velocities and directions of the axes at the end."""
    parts = "positions", "velocities", "orientations"
    return max(float(np.max(np.abs(getattr(predicted, part)[-1] - getattr(run, part)[-1]))) for part in parts)


@dataclass(frozen=True)
class Measured:
    """A term that was measured. scenes: how many are drawn."""

    name: str
    engine: str
    draw: Callable
    predict: Callable
    off: Callable[[Trajectory, Trajectory], float]
    scenes: int = 25

    def worst(self) -> float:
        """The largest residual, in units of the term."""
        rng, engine, found = np.random.default_rng(SEED), load_engine(self.engine), []
        while len(found) < self.scenes:
            scenario = self.draw(rng)
            settings = engine.settings(scenario, "tuned")
            prediction: Prediction | None = self.predict(scenario, settings, engine.method(scenario, settings))
            share = sum(term.share for term in prediction.terms if term.name == self.name) if prediction else 0.0
            if prediction and share:
                found.append(self.off(prediction.trajectory, engine.run(scenario, settings)) / share)
        return max(found)


TERMS = [
    Measured("a box that MuJoCo lets creep", "mujoco", held, sliding.predict, at_the_places),
    Measured("a box that rocks in MuJoCo", "mujoco", sliding_down, sliding.predict, at_the_places),
    Measured("a box that rocks in MuJoCo", "mujoco", nearly_critical, sliding.predict, at_the_places),
    Measured("a driven box that rocks in MuJoCo", "mujoco", pushed, sliding.predict, at_the_places),
    Measured(bands.DARTS_FOUR_CORNERS.name, "dart", dropped_flat, bouncing.predict, of_a_landing),
    Measured(bands.DARTS_TWO_CORNERS.name, "dart", on_an_edge, corners.predict, at_the_ends),
    Measured(
        "Bullet's sweeps over four corners", "pybullet", nearly_critical_towards_x, sliding.predict, at_the_places
    ),
    Measured("a step in which Bullet loses corners", "pybullet", fast_along_x, sliding.predict, at_the_places),
]


@pytest.mark.weekly
@pytest.mark.parametrize("term", TERMS, ids=lambda term: f"{term.name}: {term.draw.__name__}")
def test_a_measured_term_is_that_of_random_scenes(term, installed):
    installed(term.engine)
    assert LEAST_OF_A_CONSTANT < term.worst() <= 1
