"""A chain of point masses and springs that hangs between two anchors and settles in a viscous fluid (slide 28)."""

from __future__ import annotations

import numpy as np

from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.catalogue.scenarios import settled, tolerances
from reference.prediction import loaded
from reference.scene.forces import Fluid, Spring
from reference.scene.scenario import Body, Scenario, Sphere
from reference.scene.trajectory import Trajectory

MASSES = (0.08, 0.2, 0.12, 0.05, 0.16)
"""From the left anchor to the right one, kg."""
REST_LENGTHS = (0.05, 0.06, 0.05, 0.08, 0.06, 0.05)
"""Of the springs between them, m."""
RADIUS_PER_MASS = 0.1
"""m/kg. So large a ball is drawn for a mass. All have the same drag for their mass, and every swing dies away alike."""
RISE = 0.07
"""How much higher the right anchor is, m."""
TOWARDS = np.array([0.8, 0.6, 0.0])
"""Horizontal direction from the left anchor to the right one."""
ASIDE = np.array([-0.6, 0.8, 0.0])
"""Horizontal direction across: the chain starts aside of the plane in which it comes to hang."""
STIFFNESS, DAMPING = 400.0, 0.5
"""Of every spring, N/m and N s/m."""
HONEY = Fluid(viscosity=7.0)
"""A fluid as viscous as honey, and without weight: 6πηr/m is 13.2 1/s for each ball, just below twice the slowest swing
of the chain, some 7 rad/s. With more, that swing would creep; with less, all would last longer."""
DURATION = 1.4
"""s. Swings die away as (1 + 6.6 t) e^(−6.6 t) or faster, and at most 80 µm are left of 8 cm."""
UNDER_WAY = 0.1
"""s. The chain is in full swing then."""
LEFT = "less than 80 µm of the swings is left"


def _hung(span: float, stiffness: float = STIFFNESS) -> Case:
    """A chain whose anchors are so far apart horizontally, m, with springs of so many N/m."""
    name = f"span={span:g},k={stiffness:g}"
    right = span * TOWARDS + (0.0, 0.0, RISE)
    share = np.cumsum(REST_LENGTHS)[:-1, None] / sum(REST_LENGTHS)
    dip = 4 * share * (1 - share)
    places = share * right + dip * (0.08 * ASIDE - (0.0, 0.0, 0.06))
    balls = [
        Body(f"mass {number}", Sphere(RADIUS_PER_MASS * mass), mass, tuple(place.tolist()))
        for number, (mass, place) in enumerate(zip(MASSES, places, strict=True), 1)
    ]
    anchors = Body("left", Sphere(0.004)), Body("right", Sphere(0.004), position=tuple(right.tolist()))
    row = (anchors[0], *balls, anchors[1])
    springs = tuple(
        Spring(one.name, other.name, stiffness, rest_length, DAMPING)
        for one, other, rest_length in zip(row, row[1:], REST_LENGTHS, strict=False)
    )
    scenario = Scenario(f"hanging-chain/{name}", row, (), DURATION, springs=springs, fluid=HONEY)
    return Case(name, (scenario,), {"span": span, "stiffness": stiffness})


def _sag(scenario: Scenario, place: Array) -> float:
    """How far the lowest mass hangs below the left anchor, the lower one, m."""
    return float(-np.min(place[:, 2]))


def _sag_of(case: Case) -> float:
    return _sag(case.scenarios[0], settled.at_rest(case.scenarios[0]))


def _pull(scenario: Scenario, place: Array) -> float:
    """Force of the last spring on the right anchor, N."""
    last = scenario.springs[-1]
    return float(last.stiffness * (np.linalg.norm(place[-1] - place[-2]) - last.rest_length))


HANGING_CHAIN = Family(
    name="hanging-chain",
    title="A hanging chain",
    topic="meshes",
    statements=(28, 29),
    about="Five unequal masses on six springs between two anchors, one 7 cm higher than the other. A fluid as viscous"
    " as honey damps the swing of the chain, so that the chain is at rest within 1.4 s. The end pull is the force of"
    " the last spring on the right anchor, and the early sag is the depth of the lowest mass after 0.1 s.",
    expected="At rest, springs and weights balance at every mass, and no damper has any influence. The shape is the"
    " minimum of the energy `Σ k (L − L0)²/2 + Σ m g z`, which Newton's method finds without stepping through time."
    " With more and more, smaller and smaller masses the shape approaches the elastic catenary.",
    why=(
        "The hand-written function `static_shape` finds the shape without any motion, and `mesh_step` steps until the"
        " chain has settled into it. At the start of each step the lab tells the engines with which force springs and"
        " fluid act on each body. All engines then step by semi-implicit Euler. They follow its recurrence to"
        " rounding, also on the way to rest, where theory has no figure.",
    ),
    cases=(_hung(0.2), _hung(0.3), _hung(0.3, 60.0)),
    quantities=(
        Quantity("sag", "sag", "m", settled.at_end(_sag), settled.expect(_sag, "sag", LEFT), scale=_sag_of),
        Quantity("pull", "end pull", "N", settled.at_end(_pull), settled.expect(_pull, "force", LEFT)),
        Quantity("off", "off shape", "m", settled.off, tolerances.within_a_millimetre),
        Quantity("under_way", "early sag", "m", settled.early(_sag, UNDER_WAY), None, absent="takes no steps"),
    ),
    curve=Curve("span=0.3,k=60", "The lowest mass", "height above the left anchor, m", lambda run: _lowest(run)),
    convergence=Convergence("span=0.3,k=60", "sag", (4.0, 2.0, 1.0)),
    grid=Grid((Parameter("span", "m", (0.15, 0.2, 0.25, 0.3), 0.3),), (2e-3, 4e-3), _hung),
    predict=loaded.predict,
)


def _lowest(trajectory: Trajectory) -> Array:
    return np.asarray(np.min(trajectory.positions[..., 2], axis=1))


FAMILIES = (HANGING_CHAIN,)
