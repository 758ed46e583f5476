"""Boxes: dropped flat, dropped on an edge, tipping or sliding on a slope, and stacked (slides 11, 17, 22, 24)."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from reference import truth
from reference.arrays import Array
from reference.catalogue import measure, turning
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.scenarios.response import FLOOR, REBOUND, dropped
from reference.engines.base import EXACT, Method
from reference.scene import geometry
from reference.scene.scenario import GRAVITY, Body, Box, HalfSpace, Pair, Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

HALF = 0.1
"""Half the edge of a cube, m."""
CUBE = Box((HALF, HALF, HALF))
FRICTION = 0.5
MILLIMETRE = 1e-3
DEGREE = math.radians(1)
EDGE_GAP = 0.3
"""Gap below the lowest edge at the start, m."""
TOPPLE_DURATION = 1.0
STANDING = 10.0
"""How long a stack is watched, s."""
DROPS = 31
"""Drops of the flat cube: fewer than of the ball, for a box takes an engine longer."""
HOLDS, SLIDES, TIPS = 0.0, 1.0, 2.0


def _millimetre(case: Case, settings: Settings, method: Method) -> Expectation:
    return Expectation(0.0, MILLIMETRE, "1 mm: nobody sees it in a scene of metres")


def _millimetre_a_second(case: Case, settings: Settings, method: Method) -> Expectation:
    return Expectation(0.0, measure.REST_SPEED, "1 mm/s: what counts as rest")


def _upright(case: Case, settings: Settings, method: Method) -> Expectation:
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
    expected="Four equal impulses at the corners have no moment about the centre: the cube does not turn, and rebounds"
    " to e² of the drop height as a ball does.",
    why=(
        "On its half-space PyBullet finds one new contact point of a box in each step, so that a flat box gets a kick"
        " at one corner first: stock, it tilts by 5° at e = 0, and tumbles at e = 0.5. Given a large box as ground, it"
        " finds all four corners at once, and with enough solver iterations the cube stays level to the last digit."
        " That is what its tuned settings do.",
        "MuJoCo finds the four corners at once. They share the load, and each of its soft contacts gives a little too"
        " much: the rebound is some 0.02 % high. At e = 0 it sinks by up to v dt = 0.4 mm and comes back slowly.",
    ),
    cases=tuple(dropped("box-flat", restitution, _falling_cube, DROPS) for restitution in (0.0, 0.5)),
    quantities=(
        REBOUND,
        Quantity("lean", "largest lean", "rad", _lean, _upright),
        Quantity("aside", "largest way aside", "m", _aside, _millimetre),
    ),
    curve=Curve(
        "e=0.5",
        "One drop at e = 0.5",
        "gap below the cube, m",
        lambda trajectory: measure.separation(trajectory, "cube", "floor"),
    ),
    convergence=Convergence("e=0.5", "rebound"),
)


# On an edge


def _on_edge(degrees: float) -> Case:
    tilt = math.radians(degrees)
    lowest = HALF * (math.cos(tilt) + math.sin(tilt))
    orientation = (math.cos(tilt / 2), 0.0, math.sin(tilt / 2), 0.0)
    cube = Body("cube", CUBE, 1.0, (0.0, 0.0, lowest + EDGE_GAP), orientation)
    pair = Pair("cube", "floor", kinetic_friction=FRICTION)
    name = f"tilt={degrees:g}°"
    scenario = Scenario(f"box-on-edge/{name}", (FLOOR, cube), (pair,), 3.0)
    return Case(name, (scenario,), {"tilt": tilt})


def _face(trajectory: Trajectory) -> float:
    return float(turning.face_down(trajectory, "cube", "floor"))


def _expect_face(case: Case, settings: Settings, method: Method) -> Expectation:
    return Expectation(3.0, 0.0, "3: the face that was lowest, below the centre")


def _energy_gained(trajectory: Trajectory) -> float:
    """Largest energy above that of the start, J; a contact can only take away."""
    energy = measure.energy(trajectory, "cube")
    return float(np.max(energy) - energy[0])


def _expect_no_gain(case: Case, settings: Settings, method: Method) -> Expectation:
    start = 1.0 * GRAVITY * (EDGE_GAP + HALF * (math.cos(case.parameters["tilt"]) + math.sin(case.parameters["tilt"])))
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
    expected="The edge stops where it strikes and the cube turns about it, towards the side where its centre is: below"
    " 45° back onto the face that was lowest. What energy is left lets it rock, but not turn over. In the end it has"
    " m g a, with half an edge a, and never more than at the start.",
    why=(
        "What happens between the first touch and rest differs from engine to engine: the impact also absorbs the"
        " weight of a step, so that the cube turns 0.4 % too fast in PyBullet at 1 ms; small things grow as it rocks."
        " The face and the energy at the end do not depend on that, and all agree.",
        "PyBullet, tuned, keeps contacts up to the fall of one step, g dt², apart: with none at all a cube that has"
        " landed askew rocks from corner to corner for ever. Stock MuJoCo sinks in by 17 mm on landing, and all end on"
        " the right face too.",
    ),
    cases=tuple(_on_edge(degrees) for degrees in (10.0, 20.0, 30.0, 40.0)),
    quantities=(
        Quantity("face", "face below (3 expected)", "", _face, _expect_face),
        Quantity(
            "tilt",
            "tilt at the end",
            "rad",
            lambda trajectory: float(turning.tilt(trajectory, "cube", "floor")[-1]),
            _upright,
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


# Tipping or sliding


def _standing_on_slope(half_height: float, friction: float, degrees: float) -> Case:
    slope = math.radians(degrees)
    normal = np.array([math.sin(slope), 0.0, math.cos(slope)])
    orientation = geometry.quaternion_between(np.array([0.0, 0.0, 1.0]), normal)
    shape = Box((HALF, HALF, half_height))
    box = Body("box", shape, 1.0, tuple(half_height * normal), tuple(orientation))
    name = f"h={half_height:g},μ={friction:g},θ={degrees:g}°"
    pair = Pair("box", "plane", kinetic_friction=friction)
    bodies = (Body("plane", HalfSpace(tuple(normal))), box)
    scenario = Scenario(f"tipping-box/{name}", bodies, (pair,), TOPPLE_DURATION)
    return Case(name, (scenario,), {"half_height": half_height, "friction": friction, "slope": slope})


def _outcome(trajectory: Trajectory) -> float:
    if float(np.max(turning.lean(trajectory, "box", "plane"))) > 10 * DEGREE:
        return TIPS
    return SLIDES if measure.displacement(trajectory, "box") > MILLIMETRE else HOLDS


def _true_outcome(case: Case) -> float:
    friction, slope = case.parameters["friction"], case.parameters["slope"]
    if truth.tips(HALF, case.parameters["half_height"], friction, slope):
        return TIPS
    return HOLDS if truth.incline_holds(friction, slope) else SLIDES


def _expect_outcome(case: Case, settings: Settings, method: Method) -> Expectation:
    return Expectation(_true_outcome(case), 0.0, "holds (0) below 1 mm in 1 s, tips (2) beyond 10°, else slides (1)")


def _way(trajectory: Trajectory) -> float:
    return measure.displacement(trajectory, "box") * (TOPPLE_DURATION / float(trajectory.times[-1])) ** 2


def _true_way(case: Case) -> float:
    return truth.incline_acceleration(case.parameters["friction"], case.parameters["slope"], GRAVITY) / 2


def _expect_way(case: Case, settings: Settings, method: Method) -> Expectation | None:
    """The way of a box that stays upright; how far one gets that falls over, no closed form says."""
    if _true_outcome(case) == TIPS:
        return None
    exact = _true_way(case) * TOPPLE_DURATION**2
    near = 1e-3 * exact + MILLIMETRE
    reason = "0.1 % and 1 mm: a box that rocks a little as it sets out"
    if method.kind == EXACT:
        return Expectation(exact, near, reason)
    shift = truth.semi_implicit_sliding_shift(2 * _true_way(case), settings.timestep, TOPPLE_DURATION)
    why = "+a t dt/2: a step moves with the velocity that it has just gained"
    return Expectation(exact, near, reason, shift, why, near)


TIPPING_BOX = Family(
    name="tipping-box",
    title="Box on a slope: holds, slides or tips",
    topic="world",
    statements=(17, 22, 24),
    about="A box stands on a slope and is let go: a cube, a box twice as high as wide, and one three times as high.",
    expected="The normal force acts within the face, so a box of half width b and half height h stays upright while"
    " tan θ ≤ b/h. If it does not, it tips, provided that friction holds its lower edge, μ > b/h. With less friction"
    " it slides before it tips; with tan θ ≤ μ and tan θ ≤ b/h nothing moves.",
    why=(
        "All three outcomes come out right in every engine, tuned. A box that slides is a t dt/2 ahead, as on the"
        " incline. In MuJoCo a cube that holds creeps by 0.4 mm in a second: its friction makes it rock on two corners"
        " and four in turns, and on two they carry too little to hold. The higher boxes do not.",
        "The hand-written code for sliding boxes treats a box as a point and so answers only where the box cannot tip;"
        " the rest needs a rigid-body world.",
        "Stock MuJoCo creeps by millimetres where the box should hold. On stock PyBullet's plane a box rocks from one"
        " contact point to the next and slides up to 5 % too far, damping or not. Stock DART has but one contact point"
        " there, and two of three boxes that should tip slide.",
    ),
    cases=(
        *(_standing_on_slope(0.1, friction, degrees) for friction, degrees in ((0.5, 20.0), (0.5, 35.0), (1.5, 50.0))),
        *(_standing_on_slope(0.2, friction, degrees) for friction, degrees in ((0.7, 20.0), (0.3, 20.0), (0.7, 32.0))),
        *(_standing_on_slope(0.3, friction, degrees) for friction, degrees in ((0.5, 12.0), (0.2, 16.0), (0.5, 24.0))),
    ),
    quantities=(
        Quantity("outcome", "holds (0), slides (1) or tips (2)", "", _outcome, _expect_outcome),
        Quantity("way", "way in 1 s", "m", _way, _expect_way, lambda case: _true_way(case) * TOPPLE_DURATION**2),
    ),
    curve=Curve(
        "h=0.2,μ=0.7,θ=32°",
        "Lean of the box that tips, h = 0.2 m at 32°",
        "lean, °",
        lambda trajectory: np.degrees(turning.lean(trajectory, "box", "plane")),
    ),
    convergence=Convergence("h=0.1,μ=0.5,θ=35°", "way"),
)


# Stacks


def _stack(count: int) -> Case:
    cubes = tuple(Body(f"cube {place + 1}", CUBE, 1.0, (0.0, 0.0, HALF * (2 * place + 1))) for place in range(count))
    names = ["floor", *(cube.name for cube in cubes)]
    pairs = tuple(Pair(upper, lower, kinetic_friction=FRICTION) for lower, upper in pairwise(names))
    name = f"boxes={count}"
    scenario = Scenario(f"stack/{name}", (FLOOR, *cubes), pairs, STANDING)
    return Case(name, (scenario,), {"count": float(count)})


def _top(trajectory: Trajectory) -> str:
    return trajectory.scenario.bodies[-1].name


def _height_error(trajectory: Trajectory) -> float:
    """Largest distance of the top's height from where it was set down, m, with its sign."""
    height = trajectory.position(_top(trajectory))[:, 2]
    off = height - height[0]
    return float(off[np.argmax(np.abs(off))])


def _sideways(trajectory: Trajectory) -> float:
    """Largest distance that any box has moved along the floor, m."""
    moved = trajectory.positions - trajectory.positions[0]
    return float(np.max(np.hypot(moved[..., 0], moved[..., 1])))


def _fastest(trajectory: Trajectory) -> float:
    """Largest speed of any box in the last second, m/s."""
    late = trajectory.times >= trajectory.times[-1] - 1.0
    return float(np.max(np.linalg.norm(trajectory.velocities[late], axis=-1)))


def _top_height(trajectory: Trajectory) -> Array:
    height = trajectory.position(_top(trajectory))[:, 2]
    return np.asarray(1000 * (height - height[0]))


STACK = Family(
    name="stack",
    title="Stack of boxes",
    topic="world",
    statements=(21, 22),
    about=f"Cubes of {2 * HALF:g} m stand on each other, five or ten of them, and are watched for {STANDING:g} s.",
    expected="Nothing moves: each contact carries the weight of all that stands above it.",
    why=(
        "A stack shows the solver: the force below must come out as the weight of all above it, through as many"
        " contacts as there are boxes. PyBullet's sequential impulses need 100 passes and boxes for ground; with 10"
        " the top of five is a tenth of a millimetre low and drifts by one. What is left is chance micro-slip, up to"
        " two tenths of a millimetre in ten seconds, and a drop at the start: whether boxes a gap of zero apart touch,"
        " rounding decides, and until they do, they fall g dt² a step; the top of five three times, that of ten six.",
        "MuJoCo's Newton solver has it in one or two iterations. Its contacts are soft, and the top of n boxes sinks"
        " by n² (1 − d) g dt²/(4 r), a quarter of a micrometre for ten. A contact at a gap of zero is seen or not by"
        " rounding: without a margin of a nanometre the stack would drop by 0.2 mm first, and with the tuned recipe for"
        " slides, which adds friction after the main solver, shift by half a millimetre as well.",
        "DART's default solver goes through the contacts by pivots and has the whole stack at once. In some"
        " orders of the bodies it breaks off, and 30 sweeps stand in for it: a drift of some micrometres is left.",
        "Stock, PyBullet's stack of ten drifts by a centimetre and MuJoCo's sinks by two millimetres. Both stand, and"
        " DART's stands as well as with tuned settings.",
    ),
    cases=(_stack(5), _stack(10)),
    quantities=(
        Quantity("height", "height of the top: error", "m", _height_error, _millimetre),
        Quantity("drift", "drift of any box", "m", _sideways, _millimetre),
        Quantity("speed", "speed in the last second", "m/s", _fastest, _millimetre_a_second),
    ),
    curve=Curve("boxes=10", "Ten boxes: height of the top", "change of height, mm", _top_height),
    convergence=Convergence("boxes=5", "height"),
)

FAMILIES = (BOX_FLAT, BOX_ON_EDGE, TIPPING_BOX, STACK)
