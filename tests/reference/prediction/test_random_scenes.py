"""Every recurrence on scenes that nobody chose: a run is within its band, or the recurrence says nothing."""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
import random_scenes as scenes
from hypothesis import given, note, settings
from hypothesis import strategies as st

from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.friction import slack_aside
from reference.comparison.verdicts import AS_IT_MUST, Verdict
from reference.engines import Engine, engine_names
from reference.engines.base import Method
from reference.errors import CannotExpress, NeedsFunction
from reference.prediction import (
    answering,
    bouncing,
    corners,
    draped,
    edges,
    loaded,
    passing,
    sliding,
    steered,
    striking,
)
from reference.prediction.predicted import Prediction
from reference.running.study import plan, run_job
from reference.scene.scenario import Box, HalfSpace, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

PLACES = "positions", "velocities"
EVERYTHING = (*PLACES, "angular_velocities", "orientations", "answers", "watched")


@dataclass(frozen=True)
class Kind:
    """scenes: what is drawn. predict: the recurrence. of: what it says.

    aside: how far beside its way, m, a body may be besides, by the settings.
    """

    scenes: st.SearchStrategy[Scenario]
    predict: Callable[..., Prediction | None]
    of: tuple[str, ...] = EVERYTHING
    aside: Callable[..., float] = lambda scenario, settings, method: 0.0


def beside_a_slide(scenario: Scenario, told: Settings, method: Method) -> float:
    """The slack of every slab in the catalogue, for boxes."""
    return slack_aside(None, told, method) * any(isinstance(body.shape, Box) for body in scenario.bodies)


KINDS = {
    "bouncing": Kind(scenes.bounces(), bouncing.predict),
    "striking": Kind(scenes.strikes(), striking.predict),
    "sliding": Kind(scenes.slides(), sliding.predict, PLACES[:1], beside_a_slide),
    "driven": Kind(scenes.drives(), sliding.predict, PLACES[:1], beside_a_slide),
    "loaded": Kind(scenes.loaded_balls(), loaded.predict),
    "joints": Kind(scenes.springs(), loaded.predict),
    "draped": Kind(scenes.drapes(), draped.predict),
    "passing": Kind(
        scenes.shots(), passing.predict, PLACES
    ),  # where a centre lies in a box, Bullet's contact is 7 nm beside it
    "steered": Kind(scenes.fliers(), steered.predict),
    "corners": Kind(scenes.corners(), corners.predict),
    "edges": Kind(
        scenes.crossed_edges(), edges.predict, PLACES[1:]
    ),  # nor how overlap is taken back and the boxes tumble
    "answering": Kind(scenes.surveys(), answering.predict),
}


def bands_off(ran: Trajectory, prediction: Prediction, of: tuple[str, ...] = EVERYTHING, aside: float = 0.0) -> float:
    """The largest difference of any number from the predicted one, in bands; spins as speeds at the surface, m/s.

    aside: what a place may be off across the way and level with the plane, m.
    """
    then = prediction.trajectory
    sizes = np.array([_size(body.shape) for body in ran.scenario.bodies])[:, None]
    same = np.sign(np.sum(ran.orientations * then.orientations, axis=-1, keepdims=True))  # q and −q are one orientation
    units = {"angular_velocities": (sizes, sizes), "orientations": (1.0, same)}
    worst = 0.0
    for name in of:
        unit, unit_of_expected = units.get(name, (1.0, 1.0))
        found, expected = unit * getattr(ran, name), unit_of_expected * getattr(then, name)
        alike = (found == expected) | np.isnan(expected)  # also where both are infinite
        off = np.where(alike, 0.0, found) - np.where(alike, 0.0, expected)
        if aside:
            off = _without_aside(off, then, aside)
        off = np.abs(off)
        bands = prediction.near * np.maximum(1.0, np.abs(np.where(alike, 1.0, expected)))
        worst = max(worst, float(np.max(off / bands, initial=0.0)))
    return worst


def _without_aside(off: np.ndarray, then: Trajectory, aside: float) -> np.ndarray:
    """What is left of distances (n, bodies, 3) of a body that slides on a plane, less what it may be off aside."""
    normal = next(np.array(body.shape.normal) for body in then.scenario.bodies if isinstance(body.shape, HalfSpace))
    way = then.positions[-1] - then.positions[0]
    across = np.cross(normal, way)
    across /= np.maximum(np.linalg.norm(across, axis=-1, keepdims=True), 1e-12)
    length = np.sum(off * across, axis=-1, keepdims=True)
    return off - np.clip(length, -aside, aside) * across


def _size(shape) -> float:
    if isinstance(shape, Sphere):
        return shape.radius
    return math.hypot(*shape.half_extents) if isinstance(shape, Box) else 1.0


def runs_of(kind: Kind, engine: Engine, scenario: Scenario, share: float):
    """Each profile of an engine that has a recurrence of a scene: its name and how many bands its run is off."""
    for profile in engine.profiles(scenario):
        told = engine.settings(scenario, profile)
        told = told.change(timestep=share * told.timestep)
        method = engine.method(scenario, told)
        prediction, aside = kind.predict(scenario, told, method), kind.aside(scenario, told, method)
        if prediction is None:
            continue
        try:
            yield profile, bands_off(engine.run(scenario, told), prediction, kind.of, aside)
        except (CannotExpress, NeedsFunction):
            continue


def check(kind: Kind, count: int, installed, in_turn: bool) -> Counter[tuple[str, str]]:
    """Try so many scenes, and count those that each engine's profile had a recurrence of.

    in_turn: whether each scene is run by one engine alone, and the next scene by the next engine.
    """
    engines, tried, turn = [installed(name) for name in engine_names()], Counter[tuple[str, str]](), itertools.count()

    @settings(max_examples=count)
    @given(kind.scenes, scenes.between(0.55, 1.0))
    def follows(scenario: Scenario, share: float) -> None:
        for engine in [engines[next(turn) % len(engines)]] if in_turn else engines:
            for profile, off in runs_of(kind, engine, scenario, share):
                note(f"{engine.name}, {profile}, timestep × {share}: {off:.3g} bands")
                assert off <= 1
                tried[engine.name, profile] += 1

    follows()
    return tried


@pytest.mark.slow
@pytest.mark.parametrize("name", KINDS)
def test_a_run_is_as_predicted_or_nothing_is_predicted(name, installed):
    assert check(KINDS[name], 5, installed, in_turn=True)


@pytest.mark.weekly
@pytest.mark.parametrize("name", KINDS)
def test_many_runs_are_as_predicted_in_every_implementation(name, installed):
    assert check(KINDS[name], 40, installed, in_turn=False)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("family", "engine", "profile", "timestep", "at"),
    [
        ("one-drop", "pybullet", "tuned", 2.5e-4, {}),  # rounding takes a contact on a slope away for a step
        ("break-away", "dart", "tuned", 3e-4, {}),  # sweeps that end at a tolerance, near the limit of friction
        ("spinning-rod", "pybullet", "tuned", 4.05e-3, {"spin": 205.447}),  # a turn of more than π/4 is too small
        ("passing-balls", "mujoco", "tuned", 2.1e-4, {}),  # one shot of 61 is a tie
        ("friction-oscillator", "handwritten", "exact", 1e-3, {"friction": 0.2771}),  # the last swing is slow
        ("friction-oscillator", "dart", "tuned", 1e-3, {"friction": 0.278}),  # and slower than a step resolves
    ],
)
def test_a_job_off_the_catalogue_fails_nothing(family, engine, profile, timestep, at, installed):
    installed(engine)
    (job,) = plan([catalogue()[family]], [engine], [profile], changes={"timestep": timestep}, at=at)
    verdicts = {row.verdict for row in run_job(job).rows}
    assert Verdict.PASS in verdicts or Verdict.KNOWN_DEVIATION in verdicts
    assert verdicts <= {*AS_IT_MUST, Verdict.SHOWN, Verdict.CANNOT_EXPRESS}
