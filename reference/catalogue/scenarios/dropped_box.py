"""A box that is dropped flat, and one that is dropped on an edge (slides 11, 17, 18 and 22)."""

from __future__ import annotations

import math

import numpy as np

from reference.catalogue import measure, turning
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.scenarios.bouncing_ball import FLOOR, REBOUND, dropped
from reference.catalogue.scenarios.tolerances import DEGREE, MILLIMETRE, within_a_millimetre
from reference.engines import facts
from reference.engines.base import Method
from reference.prediction import bouncing
from reference.scene.scenario import GRAVITY, Body, Box, Pair, Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

HALF = 0.1
"""Half the edge of the cube, m."""
CUBE = Box((HALF, HALF, HALF))
FRICTION = 0.5
EDGE_GAP = 0.3
"""Gap below the lowest edge at the start, m."""
DROPS = 11
"""Drops of the flat cube."""
ROCKING = 3.0
"""How long a cube that falls on its edge is watched, s."""


def _level(case: Case, settings: Settings, method: Method) -> Expectation:
    return Expectation(0.0, DEGREE / 10, "0.1°: a box that lies on a face")


# Flat


def _falling_cube(name: str, restitution: float, drop_height: float, duration: float) -> Scenario:
    cube = Body("cube", CUBE, 1.0, (0.0, 0.0, HALF + drop_height))
    pair = Pair("cube", "floor", restitution, FRICTION)
    return Scenario(name, (FLOOR, cube), (pair,), duration)


def _lean(trajectory: Trajectory) -> float:
    return float(np.max(turning.lean(trajectory, "cube", "floor")))


def _aside(trajectory: Trajectory) -> float:
    moved = trajectory.position("cube") - trajectory.position("cube")[0]
    return float(np.max(np.hypot(moved[:, 0], moved[:, 1])))


BOX_FLAT = Family(
    name="box-flat",
    title="Box dropped flat",
    topic="impulse",
    statements=(11, 12, 17, 20),
    about="A level cube falls about 1 m onto the floor, which it meets with four corners at once, and rebounds. As for"
    f" the ball, figures are means over {DROPS} drops.",
    expected="Four equal impulses at the corners have no moment about the centre: the cube does not turn, and"
    " rebounds to `e²` of the drop height as a ball does.",
    why=(
        f"{facts.PYBULLET_TAKES_CORNERS_IN_TURN} Tuned, its ground is a large box on which it finds all four corners"
        " at once, and the cube stays level to the last digit.",
        "MuJoCo finds the four corners at once. Each of its soft contacts gives a little too much, so that the rebound"
        " is a little high. At e = 0 the cube sinks by up to `v dt`, 0.4 mm, and comes back slowly.",
    ),
    cases=tuple(dropped("box-flat", restitution, _falling_cube, DROPS) for restitution in (0.0, 0.5)),
    quantities=(
        REBOUND,
        Quantity("lean", "largest lean", "rad", _lean, _level),
        Quantity("aside", "largest way aside", "m", _aside, within_a_millimetre),
    ),
    curve=Curve(
        "e=0.5",
        "One drop at e = 0.5",
        "gap below the cube, m",
        lambda trajectory: measure.separation(trajectory, "cube", "floor"),
    ),
    convergence=Convergence("e=0.5", "rebound"),
    predict=bouncing.predict,
)


# On an edge


def _on_edge(degrees: float) -> Case:
    tilt = math.radians(degrees)
    orientation = (math.cos(tilt / 2), 0.0, math.sin(tilt / 2), 0.0)
    cube = Body("cube", CUBE, 1.0, (0.0, 0.0, _start_height(tilt)), orientation)
    pair = Pair("cube", "floor", kinetic_friction=FRICTION)
    name = f"tilt={degrees:g}°"
    scenario = Scenario(f"box-on-edge/{name}", (FLOOR, cube), (pair,), ROCKING)
    return Case(name, (scenario,), {"tilt": tilt})


def _start_height(tilt: float) -> float:
    """Height of the centre at the start, m."""
    return HALF * (math.cos(tilt) + math.sin(tilt)) + EDGE_GAP


def _face(trajectory: Trajectory) -> float:
    return float(turning.face_down(trajectory, "cube", "floor"))


def _expect_face(case: Case, settings: Settings, method: Method) -> Expectation:
    return Expectation(3.0, 0.0, "3: the face that was lowest, below the centre")


def _energy_gained(trajectory: Trajectory) -> float:
    """Largest energy above that of the start, J; a contact can only take away."""
    energy = measure.energy(trajectory, "cube")
    return float(np.max(energy) - energy[0])


def _expect_no_gain(case: Case, settings: Settings, method: Method) -> Expectation:
    start = 1.0 * GRAVITY * _start_height(case.parameters["tilt"])
    return Expectation(0.0, 1e-9 * start, "rounding only: a fall in steps loses m g v dt/2, and contacts add nothing")


def _final_energy(trajectory: Trajectory) -> float:
    return float(measure.energy(trajectory, "cube")[-1])


def _true_final_energy(case: Case) -> float:
    return 1.0 * GRAVITY * HALF


def _expect_final_energy(case: Case, settings: Settings, method: Method) -> Expectation:
    exact = _true_final_energy(case)
    return Expectation(exact, GRAVITY * MILLIMETRE, "m g times 1 mm: flat on the floor, and still")


BOX_ON_EDGE = Family(
    name="box-on-edge",
    title="Box dropped on an edge",
    topic="world",
    statements=(11, 17, 18, 22),
    about=f"A cube, tilted about a level axis, falls {EDGE_GAP:g} m onto its lowest edge and comes to rest. Its path"
    " in between is sensitive to everything, so only the end is judged: the face that it lies on, and the energy.",
    expected="The edge stops where it strikes and the cube turns about it, towards the side where its centre is:"
    " below 45° back onto the face that was lowest. In the end it has the energy `m g a`, with half an edge"
    " `a`, and never more than at the start.",
    why=(
        "All agree on the face and on the energy at the end, whatever happens in between: the impact also absorbs"
        " the weight of a step, so that the cube turns 0.4 % too fast in PyBullet at 1 ms, and small differences"
        " grow as it rocks.",
        "PyBullet, tuned, keeps contacts up to the fall of one step, `g dt²`, apart: with none at all a cube that has"
        " landed askew rocks from corner to corner without end. Stock MuJoCo sinks in deep on landing, and ends on the"
        " right face too.",
    ),
    cases=tuple(_on_edge(degrees) for degrees in (10.0, 20.0, 30.0, 40.0)),
    quantities=(
        Quantity("face", "face below (3 expected)", "", _face, _expect_face),
        Quantity(
            "tilt",
            "tilt at the end",
            "rad",
            lambda trajectory: float(turning.tilt(trajectory, "cube", "floor")[-1]),
            _level,
        ),
        Quantity("energy", "energy at the end", "J", _final_energy, _expect_final_energy, _true_final_energy),
        Quantity("gain", "energy gained on the way", "J", _energy_gained, _expect_no_gain),
    ),
    curve=Curve(
        "tilt=30°",
        "Tilt of the cube dropped at 30°",
        "tilt, °",
        lambda trajectory: np.degrees(turning.tilt(trajectory, "cube", "floor")),
        until=1.5,
    ),
    convergence=Convergence("tilt=30°", "energy"),
)

FAMILIES = (BOX_FLAT, BOX_ON_EDGE)
