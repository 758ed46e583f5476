"""Why an implementation's numbers are apart from the others', where neither theory nor its method says that they are.

One sentence or two for each engine and profile that fails in a family, and one for each family in which theory is
silent. What an engine does in several families is in `reference.engines.facts`. A test asks for a reason wherever two
numbers of the catalogue are apart.
"""

from __future__ import annotations

from collections.abc import Mapping

from reference.engines import facts
from reference.engines.profiles import STOCK
from reference.engines.pybullet_settings import STOCK_REST_SPEED

SPRING = "spring"
_BOUNCES: Mapping[tuple[str, str], str] = {
    ("pybullet", STOCK): f"{facts.PYBULLET_STARTS_EARLY} {facts.PYBULLET_GIVES_BACK} {facts.PYBULLET_DAMPS}",
    ("mujoco", STOCK): facts.MUJOCO_HAS_NO_RESTITUTION,
}

REASONS: Mapping[str, Mapping[tuple[str, str], str]] = {
    "solid-edges": {("", ""): "A ray along an edge touches the solid at best: rounding decides whether it is a hit."},
    "thin-wall": {
        ("pybullet", STOCK): (
            "At 1/240 s PyBullet moves a fast ball past the wall in one step."
            f" {facts.PYBULLET_GIVES_BACK} {facts.PYBULLET_DAMPS}"
        ),
        ("mujoco", STOCK): (
            f"{facts.MUJOCO_IS_SOFT} The ball sinks past the middle of the wall and is pushed out behind it. Only a"
            " stiffer contact helps."
        ),
    },
    "pellets": {
        ("pybullet", STOCK): (
            "At 1/240 s PyBullet moves a pellet past the wall in one step. It limits speeds to 100 m/s."
            f" {facts.PYBULLET_GIVES_BACK} {facts.PYBULLET_DAMPS}"
        ),
        ("mujoco", STOCK): (
            f"{facts.MUJOCO_IS_SOFT} The pellet sinks past the middle of the wall and is pushed out behind it."
        ),
    },
    "passing-balls": {
        ("pybullet", STOCK): (
            f"{facts.PYBULLET_DAMPS} Fast balls therefore meet later and at other phases of a step."
            f" {facts.PYBULLET_GIVES_BACK}"
        ),
        ("mujoco", STOCK): (
            f"{facts.MUJOCO_IS_SOFT} Fast balls have passed each other before it has pushed them noticeably."
        ),
    },
    "spinning-rod": {
        ("pybullet", STOCK): (
            "At 1/240 s the rod passes almost every ball in PyBullet. The few that it strikes get a wrong momentum."
            f" {facts.PYBULLET_GIVES_BACK} {facts.PYBULLET_DAMPS}"
        ),
        ("mujoco", STOCK): f"{facts.MUJOCO_IS_SOFT} The rod is past the ball before the contact pushes.",
    },
    "dropped-ball": _BOUNCES,
    "one-drop": _BOUNCES,
    "ball-in-a-bowl": _BOUNCES,
    "hanging-chain": {("pybullet", STOCK): facts.PYBULLET_DAMPS},
    "hanging-cloth": {("pybullet", STOCK): facts.PYBULLET_DAMPS},
    "jelly": {("pybullet", STOCK): facts.PYBULLET_DAMPS},
    "cloth-over-a-ball": {
        ("pybullet", STOCK): f"{facts.PYBULLET_DAMPS} It leaves 10 µm of each overlap.",
        ("mujoco", STOCK): (
            f"{facts.MUJOCO_IS_SOFT} Masses rest up to half a millimetre deep in the ball, and the cloth drapes"
            " otherwise."
        ),
    },
    "step-limit": {
        ("pybullet", STOCK): "PyBullet, as installed, steps 4.2 ms, four times the longest stable step.",
        ("mujoco", STOCK): "MuJoCo, as installed, steps 2 ms, twice the longest stable step.",
    },
    "ball-to-rest": {
        ("pybullet", STOCK): (
            f"{facts.PYBULLET_STARTS_EARLY} {facts.PYBULLET_DAMPS} It takes any rebound below"
            f" {STOCK_REST_SPEED:g} m/s for rest."
        ),
        ("mujoco", STOCK): facts.MUJOCO_HAS_NO_RESTITUTION,
        ("mujoco", SPRING): (
            "The contact of MuJoCo's spring profile chatters at about g Δt/2, just the 1 mm/s that counts as motion."
        ),
    },
    "corner": _BOUNCES,
    "two-walls": {
        ("pybullet", STOCK): f"{facts.PYBULLET_STARTS_EARLY} After two or three impacts it has caught the ball.",
        ("mujoco", STOCK): f"{facts.MUJOCO_HAS_NO_RESTITUTION} The ball never meets the walls five times.",
    },
    "sliding-slab": {
        ("pybullet", STOCK): (
            f"{facts.PYBULLET_DAMPS} That shortens long slides, and a slab that rocks calms down late."
        ),
        ("mujoco", STOCK): f"{facts.MUJOCO_HAS_A_DIAMOND} A fast slab hops, and calms down late.",
        ("dart", STOCK): f"{facts.DART_HAS_ONE_POINT} It hardly ever counts as stopped. {facts.DART_HAS_A_SQUARE}",
    },
    "incline": {
        ("pybullet", STOCK): f"{facts.PYBULLET_DAMPS} That slows every slide by up to a quarter.",
        ("mujoco", STOCK): f"{facts.MUJOCO_CREEPS} On all slopes but the gentlest that counts as sliding.",
        ("dart", STOCK): f"{facts.DART_HAS_ONE_POINT} Some slabs that should hold walk off that way.",
    },
    "break-away": {
        ("pybullet", STOCK): (
            f"{facts.PYBULLET_DAMPS} The damping slows a slab that slides. Before the break-away the slab creeps."
        ),
        ("mujoco", STOCK): (
            f"{facts.MUJOCO_CREEPS} {facts.MUJOCO_HAS_A_DIAMOND} The slab breaks away early, and does not slide in the"
            " direction of the push."
        ),
        ("dart", STOCK): f"{facts.DART_HAS_ONE_POINT} The slab breaks away late, and turns as it slides.",
    },
    "critical-incline": {
        ("pybullet", STOCK): (
            f"PyBullet, as installed, creeps by millimetres at 1 % below critical. {facts.PYBULLET_DAMPS}"
        ),
        ("mujoco", STOCK): facts.MUJOCO_CREEPS,
        ("dart", STOCK): f"{facts.DART_HAS_ONE_POINT} Rocking, it slides where it should hold.",
    },
    "sliding-ball": {
        ("pybullet", STOCK): (
            f"{facts.PYBULLET_DAMPS} A ball that rolls has no drive to set against it, and gets slower and slower."
        ),
        ("mujoco", STOCK): f"{facts.MUJOCO_LIFTS} It begins to roll late.",
    },
    "rolling-ball": {
        ("pybullet", STOCK): f"{facts.PYBULLET_DAMPS} The spin loses most.",
        ("mujoco", STOCK): (
            "At MuJoCo's own 2 ms the way is longer by a t Δt/2, and a ball that slips spins a little too fast."
        ),
    },
    "struck-cube": {
        ("pybullet", STOCK): f"{facts.PYBULLET_GIVES_BACK} {facts.PYBULLET_DAMPS}",
    },
    "off-centre-impact": {
        ("pybullet", STOCK): (
            f"{facts.PYBULLET_STARTS_EARLY} {facts.PYBULLET_GIVES_BACK} {facts.PYBULLET_TAKES_CORNERS_IN_TURN} That is"
            " not always the corner that strikes."
        ),
        ("mujoco", SPRING): "The corner of MuJoCo's spring profile sinks in for some 3 ms, while the cube turns.",
        ("mujoco", STOCK): facts.MUJOCO_HAS_NO_RESTITUTION,
        ("dart", STOCK): (
            f"{facts.DART_HAS_A_SQUARE} It limits friction by the normal impulse that it has found without friction."
            " Of an edge its detector finds points that do not strike alike."
        ),
    },
    "two-balls": _BOUNCES,
    "box-flat": {
        ("pybullet", STOCK): (
            f"{facts.PYBULLET_TAKES_CORNERS_IN_TURN} A flat cube is kicked at one corner first, and tumbles."
        ),
        ("mujoco", STOCK): facts.MUJOCO_HAS_NO_RESTITUTION,
    },
    "cradle": {
        ("", ""): (
            "The balls touch, and Newton's rule allows more than one result. Hand-written code at the exact instant"
            " takes the impacts in turn, so the last ball flies off; the others solve all contacts together, so that"
            " the first one comes back. A contact that lasts gives a third result."
        ),
        ("pybullet", STOCK): (
            f"{facts.PYBULLET_STARTS_EARLY} Where balls are apart, this makes energy. {facts.PYBULLET_DAMPS}"
        ),
        ("mujoco", STOCK): facts.MUJOCO_HAS_NO_RESTITUTION,
        ("dart", STOCK): "DART's solver, as installed, finds four contacts at once to 0.07 % only.",
    },
    "parting-ball": {
        ("", ""): (
            "The balls touch, and three rules that sound right give three results: one impact after another, all at"
            " once, or every relative velocity turned back."
        ),
        ("pybullet", STOCK): f"PyBullet solves all contacts at once. {facts.PYBULLET_DAMPS}",
        ("mujoco", STOCK): facts.MUJOCO_HAS_NO_RESTITUTION,
    },
    "struck-rod": {
        ("pybullet", STOCK): f"{facts.PYBULLET_GIVES_BACK} {facts.PYBULLET_DAMPS}",
        ("mujoco", STOCK): facts.MUJOCO_HAS_NO_RESTITUTION,
    },
    "rod-on-peg": {
        ("pybullet", STOCK): f"{facts.PYBULLET_GIVES_BACK} The rod rebounds too high.",
        ("mujoco", STOCK): facts.MUJOCO_HAS_NO_RESTITUTION,
    },
    "spinning-ball": {
        ("pybullet", STOCK): (
            "PyBullet's multibody, as installed, loses up to half of the speed that spin should become, and up to four"
            " fifths of the spin that should be left."
        ),
        ("mujoco", STOCK): (
            f"{facts.MUJOCO_HAS_NO_RESTITUTION} Friction acts for as long as the ball sinks in and is pushed out."
        ),
    },
    "crossed-edges": {
        ("pybullet", STOCK): f"{facts.PYBULLET_GIVES_BACK} {facts.PYBULLET_DAMPS}",
        ("mujoco", STOCK): facts.MUJOCO_HAS_NO_RESTITUTION,
        ("mujoco", SPRING): "In the 3 ms that MuJoCo's spring lasts, the boxes turn, and the normal with them.",
    },
    "mass-ratios": {
        ("pybullet", STOCK): (
            f"PyBullet, as installed, makes 50 sweeps in a step, too few for so light a ball. {facts.PYBULLET_DAMPS}"
        ),
        ("mujoco", STOCK): f"{facts.MUJOCO_IS_SOFT} The balls are pushed apart again.",
        ("dart", STOCK): "DART, as installed, gives overlap back as speed: a hundredth of it in each step.",
    },
    "superball": {
        **_BOUNCES,
        ("dart", STOCK): f"{facts.DART_HAS_A_SQUARE} It deflects the ball. DART also responds up to 1 ms late.",
    },
    "box-on-edge": {("dart", STOCK): "DART, as installed, leaves the box 1.5 to 3.1 mm deep in the floor."},
    "tipping-box": {
        ("", ""): (
            "A box that tips falls from edge to edge. Where it is a second later depends on every contact of its way,"
            " and no closed form says so."
        ),
        ("pybullet", STOCK): f"{facts.PYBULLET_TAKES_CORNERS_IN_TURN} The box rocks on them, and slides too far.",
        ("mujoco", STOCK): facts.MUJOCO_CREEPS,
        ("dart", STOCK): f"{facts.DART_HAS_ONE_POINT} Two of three boxes that should tip slide.",
    },
    "stack": {
        ("pybullet", STOCK): "PyBullet, as installed, lets the stack drift by a centimetre and sink by what it allows.",
        ("mujoco", STOCK): "MuJoCo's contacts, as installed, give by 0.2 mm each under the weight of a stack of ten.",
    },
}
"""By family, then by engine and profile; under two empty names, why theory is silent and what there is instead."""


def why_apart(family: str, engine: str = "", profile: str = "") -> str:
    """The reason for an engine and profile, or without them for a family; empty where the catalogue has none."""
    return REASONS.get(family, {}).get((engine, profile), "")
