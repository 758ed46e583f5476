"""A corner that strikes a plane, step by step, against the engines: a turned plane off the origin, box, edge, rod."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.catalogue.scenarios import catalogue
from reference.prediction import corners
from reference.prediction.axes import bullets_axes
from reference.scene import geometry
from reference.scene.scenario import HalfSpace, Pair, Scenario

TURN = np.array([0.4, -0.2, 0.8, 0.4])  # a unit quaternion: 0.16 + 0.04 + 0.64 + 0.16 = 1
FOOT = np.array([0.3, -0.2, 0.1])
FAMILY = catalogue()["off-centre-impact"]
CASES = "corner,e=1,μ=0.2", "spinning,e=0.5,μ=0.2", "rod ahead,e=0.5,μ=0.2", "edge,e=0.5,μ=0.2"
ENGINES = ("handwritten", "step"), ("handwritten", "world"), ("pybullet", "tuned"), ("dart", "tuned")
ONE_CORNER = {"pybullet": CASES[:3], "dart": CASES[:2]}
EVERY = [(case, *each) for case in CASES for each in ENGINES if case in ONE_CORNER.get(each[0], CASES)]
"""Bullet's friction and DART's softness have axes of their own. Where these are aside of the plane of an impact, an
edge's two corners part, and a rod begins to tumble; then there is no prediction."""


def turned(vector) -> tuple[float, ...]:
    return tuple(geometry.rotate(TURN, np.array(vector, dtype=float)).tolist())


def scene(case: str) -> Scenario:
    """A scenario of the catalogue, turned and moved, with other coefficients and a mass that is not 1 kg."""
    scenario = FAMILY.case(case).scenarios[0]
    floor, box = scenario.bodies
    plane = replace(floor, shape=HalfSpace(turned(floor.shape.normal)), position=tuple(FOOT))
    as_matrix = geometry.rotate(TURN, geometry.rotate(np.array(box.orientation), np.eye(3))).T
    vectors = {each: turned(getattr(box, each)) for each in ("velocity", "angular_velocity")}
    place = tuple(np.add(turned(box.position), FOOT))
    box = replace(box, mass=1.7, position=place, orientation=tuple(quaternion(as_matrix)), **vectors)
    return replace(scenario, bodies=(plane, box), pairs=(Pair("box", "floor", 0.6, 0.23),))


def quaternion(matrix):
    """Of a rotation matrix whose trace is above −1."""
    w = np.sqrt(1 + np.trace(matrix)) / 2
    x, y, z = matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1]
    return np.array([w, x / (4 * w), y / (4 * w), z / (4 * w)])


def farthest_off(case: str, engine: str, profile: str, installed) -> float:
    """The largest difference of any velocity, spin or pose at the end from the predicted one, in bands."""
    scenario, found = scene(case), installed(engine)
    settings = found.settings(scenario, profile)
    prediction = corners.predict(scenario, settings, found.method(scenario, settings))
    assert prediction is not None
    ran = found.run(scenario, settings)
    assert np.max(np.abs(ran.velocities[-1] - ran.velocities[0])) > 0.5  # there was an impact
    then = prediction.trajectory
    same = np.sign(np.sum(ran.orientations * then.orientations, axis=-1, keepdims=True))  # q and −q are one orientation
    compared = (
        (ran.velocities, then.velocities),
        (ran.positions, then.positions),
        (ran.angular_velocities / 10, then.angular_velocities / 10),
        (ran.orientations, same * then.orientations),
    )
    return max(float(np.max(np.abs(one[-1] - other[-1]))) for one, other in compared) / prediction.near


@pytest.mark.parametrize(("case", "engine", "profile"), EVERY)
def test_an_engine_does_what_is_predicted_of_it_step_by_step(case, engine, profile, installed):
    assert farthest_off(case, engine, profile, installed) < 1


def stepped(self, state):
    """Every turn as large as spin times step."""
    orientation = geometry.turned(state.orientation, state.spin * self.law.dt)
    return state._replace(position=state.position + state.velocity * self.law.dt, orientation=orientation)


def other_axes(normal):
    """Two axes half-way between Bullet's."""
    first, second, _ = bullets_axes(normal)
    return np.array([(first + second) / 2**0.5, (second - first) / 2**0.5, normal])


MUTATIONS = {
    "friction along other axes": (corners, "bullets_axes", other_axes),
    "nothing soft": (corners, "SOFTNESS", 0.0),
    "turns without DART's arcsine": (corners._Corners, "_moved", stepped),
}


@pytest.mark.parametrize(
    ("mutation", "case", "engine"),
    [
        ("friction along other axes", "corner,e=1,μ=0.2", "pybullet"),
        ("nothing soft", "corner,e=1,μ=0.2", "dart"),
        ("turns without DART's arcsine", "spinning,e=0.5,μ=0.2", "dart"),
    ],
)
def test_a_mutated_recurrence_no_longer_agrees(mutation, case, engine, installed, monkeypatch):
    monkeypatch.setattr(*MUTATIONS[mutation])
    assert farthest_off(case, engine, "tuned", installed) > 10
