"""The grid of all engines × scenarios × profiles."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest

from reference.catalogue.family import Family
from reference.catalogue.scenarios import catalogue
from reference.engines import Engine, engine_names, load_engine
from reference.engines.profiles import WORLD, counts
from reference.errors import CannotExpress
from reference.scene import geometry
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

TOY = str(Path(__file__).with_name("toy_engine.py"))
ENGINES = (*engine_names(), TOY)
REPORT_CONTACTS = ("pybullet", "mujoco", "dart")
FALLING, RESTING = 0.5, 0.3  # s: a ball let go 1 m above the floor falls for 0.45 s and rebounds; the rest do not fall
ROUNDING = 1e-14  # a frame changed twice costs a few times 2e-16 of a spin of some rad/s
DAMPING = 0.04  # 1/s, Bullet's default
FLOOR = Body("floor", HalfSpace())
HALF_TURN = math.sqrt(0.5)


def thrown(name: str, shape: Sphere | Box, orientation=(1, 0, 0, 0), spin=(0, 0, 0)) -> Scenario:
    """A body thrown so high above the floor that it meets nothing."""
    body = Body("thrown", shape, 2.0, (1, 2, 50), orientation, (3, -2, 4), spin)
    return Scenario(name, (FLOOR, body), (Pair("thrown", "floor", restitution=0.5),), RESTING)


def lying_box() -> Scenario:
    """A box that lies on its end, its own x axis up, and turned by 30° about the vertical."""
    on_end, about_z = (HALF_TURN, 0, -HALF_TURN, 0), (math.cos(math.pi / 12), 0, 0, math.sin(math.pi / 12))
    box = Body("box", Box((0.1, 0.2, 0.3)), 1.5, (0.3, -0.4, 0.1), product(about_z, on_end))
    return Scenario("lying-box", (FLOOR, box), (Pair("floor", "box", kinetic_friction=0.5),), RESTING)


def product(left, right) -> tuple[float, float, float, float]:
    """Hamilton product: the turn `right`, then the turn `left`."""
    a, b, c, d = left
    e, f, g, h = right
    return (
        a * e - b * f - c * g - d * h,
        a * f + b * e + c * h - d * g,
        a * g - b * h + c * e + d * f,
        a * h + b * g - c * f + d * e,
    )


TURNED = (0.4, -0.2, 0.8, 0.4)  # a unit quaternion: 0.16 + 0.04 + 0.64 + 0.16 = 1
OWN_Z = tuple(geometry.rotate(np.array(TURNED), np.array([0.0, 0.0, 1.0])))  # a principal axis: it spins steadily
EXTRA = (
    thrown("thrown-ball", Sphere(0.1)),
    thrown("twirled-ball", Sphere(0.1), TURNED, (1.0, -2.0, 3.0)),
    thrown("twirled-box", Box((0.1, 0.2, 0.3)), TURNED, tuple(5.0 * part for part in OWN_Z)),
    lying_box(),
)


def shortened(family: Family) -> Scenario:
    """One scenario of a family, just long enough for something to happen; of a stack, the lowest three boxes."""
    scenario = family.case(family.curve.case).scenarios[0]
    if family.name == "step-limit":
        scenario = family.grid.case(ratio=0.5).scenarios[0]  # at its limit, any longer step would make it explode
    if family.name == "stack":
        scenario = replace(scenario, bodies=scenario.bodies[:4], pairs=scenario.pairs[:3])
    hops = family.name == "sliding-slab"  # at first, in stock MuJoCo, and is seldom in contact then
    duration = RESTING if geometry.starts_in_contact(scenario) and not hops else FALLING
    return replace(scenario, name=family.name, duration=min(duration, scenario.duration))


CATALOGUE = tuple(map(shortened, catalogue().values()))
SCENARIOS = {scenario.name: scenario for scenario in (*CATALOGUE, *EXTRA)}
NEEDS_A_WORLD = (
    *("sliding-ball", "rolling-ball"),
    *("box-flat", "box-on-edge", "tipping-box", "stack", "twirled-box"),
    *("antipodal-circle", "crossing-streams", "lone-flier", "flock-past-pillar"),
    "ball-in-a-bowl",
)
"""What rolls, tumbles, meets more than one thing or steers itself."""
STRIKING = (
    "thin-wall",
    "pellets",
    "passing-balls",
    "spinning-rod",
    "spinning-ball",
    "superball",
    "two-balls",
    "struck-rod",
    "rod-on-peg",
    "cradle",
    "parting-ball",
    "mass-ratios",
    "crossed-edges",
    "struck-cube",
    "off-centre-impact",
)
"""What strikes another body, or spins as it strikes."""
WALLED = ("corner", "two-walls")
MESHES = ("hanging-chain", "step-limit", "hanging-cloth", "jelly", "cloth-over-a-ball")
FLYING = ("projectile", "oscillator", "sinking-ball", "orbit", "driven-oscillator")
"""Balls that meet nothing."""
SLIDING = (
    *("sliding-slab", "incline", "critical-incline", "two-frictions"),
    *("break-away", "slab-at-30-degrees", "creep", "friction-oscillator"),
)
ONE_COEFFICIENT = {
    "two-frictions": (CannotExpress, r"it has one coefficient of friction, not static 0\.5 and kinetic 0\.3$")
}
SURVEYS = ("convex-solid", "solid-edges", "concave-solid")
SAYS_NO = {
    **dict.fromkeys(REPORT_CONTACTS, ONE_COEFFICIENT),
    "mujoco": ONE_COEFFICIENT
    | dict.fromkeys(
        ("struck-cube", "off-centre-impact"),
        (CannotExpress, r"^MuJoCo cannot express \S+: no setting of it keeps both e and μ in an impact off the centre"),
    ),
    TOY: dict.fromkeys(
        (*NEEDS_A_WORLD, *STRIKING, *WALLED, *SLIDING, *MESHES, *FLYING, *SURVEYS, "lying-box", "twirled-ball"),
        (
            CannotExpress,
            r"^a toy cannot express \S+: it knows one ball over one plane, without friction and without spin$",
        ),
    ),
}
"""What an engine has no words for, the error that says so, and its words. Everything else it must run."""


@dataclass(frozen=True)
class Cell:
    """One run of the grid."""

    engine: str
    scenario: str
    profile: str

    def __str__(self) -> str:
        return f"{Path(self.engine).stem}-{self.scenario}-{self.profile}"


def profiles(engine: str, scenario: str) -> list[str]:
    return list(load_engine(engine).profiles(SCENARIOS[scenario]))


CELLS = [
    Cell(engine, scenario, profile)
    for engine in ENGINES
    for scenario in SCENARIOS
    if scenario not in SAYS_NO.get(engine, {})
    for profile in profiles(engine, scenario)
]
ONE_OF_EACH = (
    *("thrown-ball", "twirled-box"),  # free flight
    *("dropped-ball", "sliding-slab", "stack", "struck-rod", "cradle", "ball-in-a-bowl"),  # each pair of shapes
    *("thin-wall", "corner", "incline"),  # a wall without weight, two planes at once, a slope
    *("two-balls", "spinning-ball", "box-on-edge", "lying-box"),  # a glance, a spin, a landing on an edge, a turned box
)
"""What `make verify` runs in every profile; every other scenario it runs in the profile whose verdicts count."""
OFTEN = ("thrown-ball", "twirled-box", "dropped-ball", "lying-box", "struck-rod", "cradle", "corner")
"""What `make test` runs where it counts: flight, spin, rest, an impact of two bodies, and several contacts at once."""
OFTEN_IN_THE_WORLD = ("twirled-box", "lying-box")
"""What the fast run does in the hand-written world: free flight, and a body that rests on several contacts."""
FEW = 5
RUNS_OF = Counter((cell.engine, cell.profile) for cell in CELLS)
"""Scenarios of each profile. One that runs in few of them is made for these, and belongs to `make verify` as well."""


def is_often(cell: Cell) -> bool:
    """Whether `make test` has this cell; it has the dropped ball in every profile."""
    if cell.profile == WORLD:
        return cell.scenario in OFTEN_IN_THE_WORLD
    return cell.scenario == "dropped-ball" or (counts(cell.profile) and cell.scenario in OFTEN)


def is_rare(cell: Cell) -> bool:
    """Whether only `make weekly` has this cell.

    What a second profile promises is kept or broken by its settings and the kind of contact, and the scenarios of which
    there is one of each have all these kinds. So a rare cell runs once, for the promises that one run shows. Second is
    a profile that does not count, and the hand-written world where another method runs the scenario too.
    """
    second = len(profiles(cell.engine, cell.scenario)) > 1 if cell.profile == WORLD else not counts(cell.profile)
    special = RUNS_OF[cell.engine, cell.profile] <= FEW
    return second and not special and cell.scenario not in ONE_OF_EACH


def level_of(cell: Cell) -> tuple[pytest.MarkDecorator, ...]:
    return () if is_often(cell) else (pytest.mark.weekly,) if is_rare(cell) else (pytest.mark.slow,)


every_cell = pytest.mark.parametrize("cell", [pytest.param(cell, marks=level_of(cell)) for cell in CELLS], ids=str)
each_engine = pytest.mark.parametrize("name", ENGINES, ids=lambda name: Path(name).stem)


def flies_exactly(cell: Cell) -> bool:
    """Whether this profile solves for free flight, or integrates it to fourth order."""
    return (cell.engine, cell.profile) in (("handwritten", "exact"), ("handwritten", "slide"), ("mujoco", "spring"))


def is_damped(cell: Cell) -> bool:
    """Whether this profile leaves Bullet's drag on, which brakes v and ω by 0.04 (1 + v) v a second."""
    return (cell.engine, cell.profile) == ("pybullet", "stock")


def setup(cell: Cell) -> tuple[Engine, Scenario, Settings]:
    engine, scenario = load_engine(cell.engine), SCENARIOS[cell.scenario]
    return engine, scenario, engine.settings(scenario, cell.profile)


def arrays(trajectory: Trajectory) -> list[np.ndarray]:
    names = ("times", "positions", "orientations", "velocities", "angular_velocities")
    return [getattr(trajectory, name) for name in names]


def same(one: Trajectory, other: Trajectory) -> bool:
    return all(np.array_equal(a, b) for a, b in zip(arrays(one), arrays(other), strict=True))
