"""The timestep at which a spring mesh explodes, from its largest eigenvalue (slides 28 and 29)."""

from __future__ import annotations

import functools
import math
from dataclasses import replace
from itertools import product

import numpy as np

from reference import mesh_truth
from reference.arrays import Array, Integers
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.engines.base import BULLET_DAMPED, EXACT, Method
from reference.errors import RunFailed
from reference.prediction import loaded
from reference.prediction.bands import ULP, Term
from reference.prediction.predicted import Prediction
from reference.scene.forces import Spring
from reference.scene.scenario import Body, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.spring_network import network
from reference.scene.trajectory import Trajectory

ROWS, COLUMNS, SPACING = 5, 4, 0.5
"""Nodes of the patch of cloth, and the distance of neighbours, m."""
ALONG, ACROSS = np.array([2.0, 1.0, 2.0]) / 3, np.array([-2.0, 2.0, 1.0]) / 3
"""Unit vectors along its rows and its columns: it lies askew in space."""
MASSES = (0.2, 0.26, 0.16, 0.3, 0.22, 0.18, 0.24)
"""Of the nodes in turn, kg."""
SPRINGS = {
    "structural": ((0, 1), (1, 0)),
    "shear": ((1, 1), (1, -1)),
    "bend": ((0, 2), (2, 0)),
}
"""Which nodes each kind of spring joins: rows and columns from the first end to the second."""
STEP = 1e-3
"""The timestep to which the stiffness of a case is cut, s: that of all tuned engines."""
RATIOS = 0.99, 1.01
"""What that is of the longest stable timestep in each pair of cases."""
DAMPED = 0.25
"""ζ of the fastest vibration where springs have dampers."""
AMPLITUDE = 1e-7
"""Largest displacement at the start, m. Forces are linear in it to such a share of a spacing, and 10⁵ times as large as
this nearly so."""
WINDOW, APART, DURATION = 12, 24, 0.036
"""The energy is compared of so many steps, at the start and so many steps later; the run lasts 36 of them, s."""
NEAR = 0.01
"""Accepted difference of two powers of ten."""
FAR = 20.0
"""How large a logarithm is, which has no size of its own: 10²⁰ times 0.1 µm are 70 astronomical units."""
FASTEST = 100.0
"""Bullet's `maxJointVelocity` as installed, which it also holds free bodies to, m/s."""
TURNED_OVER = 1e4
"""How much more a disturbance grows than the vibration where springs turn over: up to 200 times in 85 runs."""


@functools.cache
def _patch(kinds: int) -> tuple[Array, Integers, Array, Array, float, Array]:
    """Places, edges, rest lengths, masses, and for springs of 1 N/m the largest ω² and its displacements.

    The displacements are rounded, so that a scenario has the same bits wherever the eigenvectors are computed.
    """
    grid = list(product(range(ROWS), range(COLUMNS)))
    place = np.array([SPACING * (column * ALONG + row * ACROSS) for row, column in grid])
    offsets = [offset for kind in list(SPRINGS)[:kinds] for offset in SPRINGS[kind]]
    edges = np.array(
        [
            (first, grid.index((row + down, column + right)))
            for down, right in offsets
            for first, (row, column) in enumerate(grid)
            if (row + down, column + right) in grid
        ]
    )
    rest_length = np.linalg.norm(place[edges[:, 0]] - place[edges[:, 1]], axis=-1)
    mass = np.array([MASSES[number % len(MASSES)] for number in range(len(grid))])
    square, mode = mesh_truth.fastest_mode(place, edges, 1.0, rest_length, mass)
    return place, edges, rest_length, mass, square, np.round(mode, 8)


def _vibrating(ratio: float, kinds: float = 1.0, damping_ratio: float = 0.0) -> Case:
    """A patch that starts in its fastest vibration, of which 1 ms is `ratio` of the longest stable timestep."""
    place, edges, rest_length, mass, square, mode = _patch(int(kinds))
    frequency = mesh_truth.longest_step(1.0, damping_ratio) * ratio / STEP
    stiffness = float(f"{frequency**2 / square:.9g}")
    damping = float(f"{2 * damping_ratio * stiffness / frequency:.9g}")
    name = f"{list(SPRINGS)[int(kinds) - 1]}{f',ζ={damping_ratio:g}' if damping_ratio else ''},ratio={ratio:g}"
    nodes = tuple(
        Body(f"node {number}", Sphere(0.05), float(own), tuple(at.tolist()))
        for number, (own, at) in enumerate(zip(mass, place + AMPLITUDE * mode, strict=True))
    )
    springs = tuple(
        Spring(f"node {first}", f"node {second}", stiffness, float(length), damping)
        for (first, second), length in zip(edges, rest_length, strict=True)
    )
    scenario = Scenario(f"step-limit/{name}", nodes, (), DURATION, (0.0, 0.0, 0.0), springs=springs)
    return Case(name, (scenario,), {"ratio": ratio, "kinds": kinds, "damping": damping_ratio, "frequency": frequency})


def _energy(trajectory: Trajectory) -> Array:
    """Kinetic energy and that of the springs at each sample, (n,), J."""
    net = network(trajectory.scenario)
    along = trajectory.positions[:, net.edges[:, 0]] - trajectory.positions[:, net.edges[:, 1]]
    stretch = np.linalg.norm(along, axis=-1) - net.rest_length
    moving = np.sum(net.mass * np.sum(trajectory.velocities**2, axis=-1), axis=-1)
    return np.asarray((moving + np.sum(net.stiffness * stretch**2, axis=-1)) / 2)


def _decades(trajectory: Trajectory) -> Array:
    """Powers of ten by which the amplitude, the root of the energy, is larger than at the start, (n,)."""
    energy = _energy(trajectory)
    return np.asarray(np.log10(np.maximum(energy / energy[0], 1e-300)) / 2)


def _growth(trajectory: Trajectory) -> float:
    """Powers of ten by which the amplitude grows in 24 ms, each the largest within 12 ms."""
    decades, steps = _decades(trajectory), trajectory.times / STEP
    half = (steps[1] - steps[0]) / 2
    early, late = steps < WINDOW - half, (steps > APART - half) & (steps < APART + WINDOW - half)
    if not np.any(late):
        raise RunFailed(f"no sample lies {APART} to {APART + WINDOW} ms after the start")
    return float(np.max(decades[late]) - np.max(decades[early]))


def _expect_growth(case: Case, settings: Settings, method: Method) -> Expectation | None:
    """None for an exact decay of which no sample lies 24 ms after the first."""
    frequency, damping_ratio = case.parameters["frequency"], case.parameters["damping"]
    value = math.log10(mesh_truth.energy_kept(frequency, damping_ratio, APART * STEP)) / 2
    if method.kind == EXACT:
        samples = APART * STEP / (settings.timestep * settings.sample_every)
        if damping_ratio and not math.isclose(samples, round(samples)):
            return None
        reason = "10⁻⁵: forces are linear in a displacement of 10⁻⁷ m to a share of 10⁻⁶"
        return Expectation(value, 1e-5, reason, size=FAR)
    if damping_ratio:
        reason = "near its limit a step turns the fastest vibration over, whatever the dampers take"
    else:
        reason = "a step beyond 2/ω makes the vibration grow from step to step"
    tolerance = "0.01, or 2 %: near the limit energy beats, and 12 steps may miss its top by 1 %"
    return Expectation(value, NEAR, tolerance, shift_reason=reason, size=FAR)


def _predict(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    """The recurrence; none where a body is faster than stock Bullet lets it be."""
    found = loaded.predict(scenario, settings, method)
    if found is None:
        return None
    if method.rule == BULLET_DAMPED and np.max(np.abs(found.trajectory.velocities)) > FASTEST:
        return None
    places = found.trajectory.positions
    # Each step rounds the length of a spring by an ulp of its coordinates, which disturbs the vibration.
    disturbed = settings.steps_for(scenario.duration) * ULP * float(np.max(np.abs(places[0]))) / AMPLITUDE
    if np.max(np.abs(places - places[0])) >= SPACING:
        disturbed *= TURNED_OVER
    return replace(found, terms=(Term("rounding in springs", disturbed / math.log(10) / FAR),))


STEP_LIMIT = Family(
    name="step-limit",
    title="Just below and above the longest step",
    topic="meshes",
    statements=(28, 29),
    about="A patch of cloth of 5 × 4 unequal masses, without weight, starts in its fastest vibration, 0.1 µm large."
    " Its springs are so stiff that 1 ms, the timestep of the tuned engines, is 99 % or 101 % of the longest stable"
    " timestep. The cases have structural springs alone, shear springs as well, bend springs as well, or structural"
    " springs with dampers. The growth is given in powers of ten in 24 ms.",
    expected="A vibration without dampers neither grows nor decays: its growth is 0. Semi-implicit Euler is stable as"
    " long as its step is below `2/ω`, where `ω²` is the largest eigenvalue of the mesh. With a longer step every step"
    " reverses the vibration and makes it larger, at 101 % by a factor of 1.33. With dampers the limit is shorter,"
    " `(2/ω)(√(1 + ζ²) − ζ)`.",
    why=(
        "All implementations that step explode at the same timestep, and equally fast: by 2.95 powers of ten in 24"
        " steps. More springs make the limit shorter. For a 10 × 10 cloth of equal masses the longest step is 1.01"
        " `√(m/k)` with structural springs, 0.72 `√(m/k)` with shear springs as well, and 0.646 `√(m/k)` with bend"
        " springs as well. For a single spring between a mass and the world it is `2 √(m/k)`.",
        "A damper does not help: at `ζ = 0.25` the limit is at 78 % of the undamped one, and just below the limit the"
        " fastest vibration decays by 0.83 powers of ten, where in truth it decays by four.",
        "The hand-written method `exact` computes each vibration mode of the mesh by its formula, and no mode grows.",
    ),
    cases=(
        *(_vibrating(ratio, kinds) for kinds in (1.0, 2.0, 3.0) for ratio in RATIOS),
        *(_vibrating(ratio, 1.0, DAMPED) for ratio in RATIOS),
    ),
    quantities=(Quantity("growth", "growth in powers of ten", "", _growth, _expect_growth),),
    curve=Curve("structural,ratio=1.01", "Beyond the limit", "amplitude, powers of ten of the first", _decades),
    convergence=Convergence("structural,ratio=1.01", "growth", (2.0, 1.0, 0.5)),
    grid=Grid(
        (
            Parameter("ratio", "", (0.5, 0.9, 0.99, 1.01, 1.02), 0.99),
            Parameter("kinds", "", (1.0, 2.0, 3.0), 1.0, whole=True),
        ),
        (5e-4,),
        _vibrating,
    ),
    predict=_predict,
)

FAMILIES = (STEP_LIMIT,)
