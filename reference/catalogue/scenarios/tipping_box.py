"""A box on a slope that holds, slides or tips (slides 17, 22 and 24)."""

from __future__ import annotations

import math

import numpy as np

from reference import truth
from reference.catalogue import measure, turning
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.scenarios.friction import CREEPS, HOLDS, SLIDES, slack_of_creep
from reference.catalogue.scenarios.slopes import normal_of
from reference.catalogue.scenarios.tolerances import DEGREE, MILLIMETRE, ROUNDING, from_rest
from reference.engines import facts
from reference.engines.base import EXACT, Method
from reference.prediction import sliding
from reference.scene import geometry
from reference.scene.scenario import GRAVITY, Body, Box, HalfSpace, Pair, Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

HALF_WIDTH = 0.1
"""Half the width of every box, m."""
DURATION = 1.0
"""s."""
TIPS = 2.0
"""The third outcome, as a number."""


def _standing_on_slope(half_height: float, friction: float, degrees: float) -> Case:
    slope = math.radians(degrees)
    normal = normal_of(slope)
    shape = Box((HALF_WIDTH, HALF_WIDTH, half_height))
    box = Body("box", shape, 1.0, tuple(half_height * normal), tuple(geometry.upright_on(normal)))
    name = f"h={half_height:g},μ={friction:g},θ={degrees:g}°"
    pair = Pair("box", "plane", kinetic_friction=friction)
    bodies = (Body("plane", HalfSpace(tuple(normal))), box)
    scenario = Scenario(f"tipping-box/{name}", bodies, (pair,), DURATION)
    return Case(name, (scenario,), {"half_height": half_height, "friction": friction, "slope": slope})


def _outcome(trajectory: Trajectory) -> float:
    if float(np.max(turning.lean(trajectory, "box", "plane"))) > 10 * DEGREE:
        return TIPS
    return SLIDES if measure.displacement(trajectory, "box") > MILLIMETRE else HOLDS


def _true_outcome(case: Case) -> float:
    friction, slope = case.parameters["friction"], case.parameters["slope"]
    if truth.tips(HALF_WIDTH, case.parameters["half_height"], friction, slope):
        return TIPS
    return HOLDS if truth.incline_holds(friction, slope) else SLIDES


def _expect_outcome(case: Case, settings: Settings, method: Method) -> Expectation:
    words = "holds (0) below 1 mm in 1 s, tips (2) beyond 10°, else slides (1)"
    return Expectation(_true_outcome(case), 0.0, words, shift_reason=CREEPS)


def _acceleration(case: Case) -> float:
    return truth.incline_acceleration(case.parameters["friction"], case.parameters["slope"], GRAVITY)


def _true_way(case: Case) -> float:
    """Way after `DURATION` of a box that stays upright, m."""
    return _acceleration(case) / 2 * DURATION**2


def _expect_way(case: Case, settings: Settings, method: Method) -> Expectation | None:
    """The way of a box that stays upright; for one that falls over there is no closed form."""
    if _true_outcome(case) == TIPS:
        return None
    exact = _true_way(case)
    if method.kind == EXACT:
        return Expectation(exact, ROUNDING, "rounding only")
    if exact == 0:
        return Expectation(0.0, MILLIMETRE, "1 mm in 1 s: what holds must not creep")
    return from_rest(_acceleration(case), DURATION, settings, 2e-3, "0.2 %: a step of 1 ms makes 0.1 % of 1 s")


TIPPING_BOX = Family(
    name="tipping-box",
    title="Box on a slope: holds, slides or tips",
    topic="world",
    statements=(17, 22, 24),
    about="A box stands on a slope and is let go: a cube, a box twice as high as wide, and one three times as high.",
    expected="The normal force acts within the face, so a box of half width `b` and half height `h` stays upright"
    " while `tan θ ≤ b/h`. Otherwise it tips, provided that friction holds its lower edge, `μ > b/h`. With"
    " less friction it slides before it tips; with `tan θ ≤ μ` and `tan θ ≤ b/h` nothing moves.",
    why=(
        "Every tuned engine gets all three outcomes right. A box that slides is `a t dt/2` ahead, as on the incline."
        " In MuJoCo it is a little farther ahead, for friction spends a part of its first impulses on turning the box."
        f" {facts.MUJOCO_ROCKS}",
        "The hand-written code treats a box as a point and so runs only where the box cannot tip; the rest needs a"
        " rigid-body world.",
    ),
    cases=(
        *(_standing_on_slope(0.1, friction, degrees) for friction, degrees in ((0.5, 20.0), (0.5, 35.0), (1.5, 50.0))),
        *(_standing_on_slope(0.2, friction, degrees) for friction, degrees in ((0.7, 20.0), (0.3, 20.0), (0.7, 32.0))),
        *(_standing_on_slope(0.3, friction, degrees) for friction, degrees in ((0.5, 12.0), (0.2, 16.0), (0.5, 24.0))),
    ),
    quantities=(
        Quantity("outcome", "holds (0), slides (1) or tips (2)", "", _outcome, _expect_outcome, slack=slack_of_creep),
        Quantity(
            "way",
            "way in 1 s",
            "m",
            lambda trajectory: measure.displacement(trajectory, "box"),
            _expect_way,
            _true_way,
        ),
    ),
    curve=Curve(
        "h=0.2,μ=0.7,θ=32°",
        "Lean of the box that tips, h = 0.2 m at 32°",
        "lean, °",
        lambda trajectory: np.degrees(turning.lean(trajectory, "box", "plane")),
    ),
    convergence=Convergence("h=0.1,μ=0.5,θ=35°", "way"),
    predict=sliding.predict,
)

FAMILIES = (TIPPING_BOX,)
