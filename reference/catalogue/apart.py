"""Why an implementation's numbers are apart from the others', where neither theory nor its method says that they are.

One sentence or two for each engine and profile that fails in a family, and one for each family in which theory is
silent. A test asks for a reason wherever two numbers of the catalogue are apart.
"""

from __future__ import annotations

from collections.abc import Mapping

from reference.engines.profiles import STOCK

SPRING = "spring"
_DRAG = "PyBullet, as installed, damps every velocity by 4 % a second, and by more at speed."
_EARLY = (
    "PyBullet, as installed, makes a contact while there is still a gap and takes gap/Δt off the rebound, or finds the"
    " bodies in overlap and gives it back as speed. Its damping slows the flight as well."
)
_NO_RESTITUTION = "MuJoCo, as installed, has no restitution: its contact is a soft, critically damped spring."
_CREEPS = "MuJoCo, as installed, creeps: its friction is a soft constraint, and any pull makes it yield a little."
_ONE_POINT = "DART, as installed, finds one contact point of a box on its half-space, so the box rocks without end."

REASONS: Mapping[str, Mapping[tuple[str, str], str]] = {
    "solid-edges": {("", ""): "A ray along an edge touches the solid at best: rounding decides whether it is a hit."},
    "thin-wall": {
        ("pybullet", STOCK): (
            "At 1/240 s PyBullet moves a fast ball past the wall in one step. It gives overlap back as speed, and"
            " damps the flight."
        ),
        ("mujoco", STOCK): (
            "MuJoCo's contact, as installed, is so soft that the ball sinks past the middle of the wall and is pushed"
            " out behind it."
        ),
    },
    "pellets": {
        ("pybullet", STOCK): (
            "At 1/240 s PyBullet moves a pellet past the wall in one step. It limits speeds to 100 m/s, damps the"
            " flight, and gives overlap back as speed."
        ),
        ("mujoco", STOCK): (
            "MuJoCo's contact, as installed, is so soft that the pellet sinks past the middle of the wall and is pushed"
            " out behind it."
        ),
    },
    "passing-balls": {
        ("pybullet", STOCK): (
            "PyBullet, as installed, slows fast balls in flight, so that they meet later and at other phases of a"
            " step. Balls whose overlap it notices it pushes apart faster than they came."
        ),
        ("mujoco", STOCK): (
            "MuJoCo's contact, as installed, is so soft that fast balls have passed each other before it has pushed"
            " them noticeably."
        ),
    },
    "spinning-rod": {
        ("pybullet", STOCK): (
            "At 1/240 s the rod passes almost every ball in PyBullet. The few that it strikes get a wrong momentum:"
            " damping slows the rod, and overlap comes back as speed."
        ),
        ("mujoco", STOCK): (
            "MuJoCo's contact, as installed, is so soft that the rod is past the ball before the contact pushes."
        ),
    },
    "dropped-ball": {("pybullet", STOCK): _EARLY, ("mujoco", STOCK): _NO_RESTITUTION},
    "one-drop": {
        ("pybullet", STOCK): _EARLY,
        ("mujoco", STOCK): _NO_RESTITUTION,
    },
    "ball-in-a-bowl": {("pybullet", STOCK): _EARLY, ("mujoco", STOCK): _NO_RESTITUTION},
    "hanging-chain": {("pybullet", STOCK): _DRAG},
    "hanging-cloth": {("pybullet", STOCK): _DRAG},
    "jelly": {("pybullet", STOCK): _DRAG},
    "cloth-over-a-ball": {
        ("pybullet", STOCK): f"{_DRAG} It leaves 10 µm of each overlap.",
        ("mujoco", STOCK): (
            "MuJoCo's contact, as installed, is soft: masses rest up to half a millimetre deep in the ball, and"
            " the cloth drapes otherwise."
        ),
    },
    "step-limit": {
        ("pybullet", STOCK): "PyBullet, as installed, steps 4.2 ms, four times the longest stable step.",
        ("mujoco", STOCK): "MuJoCo, as installed, steps 2 ms, twice the longest stable step.",
    },
    "ball-to-rest": {
        ("pybullet", STOCK): (
            "PyBullet, as installed, makes contacts while there is still a gap, which takes height off every bounce;"
            " it damps the flight, and takes any rebound below 0.2 m/s for rest."
        ),
        ("mujoco", STOCK): _NO_RESTITUTION,
        ("mujoco", SPRING): (
            "The contact of MuJoCo's spring profile chatters at about g Δt/2, just the 1 mm/s that counts as motion."
        ),
    },
    "corner": {("pybullet", STOCK): _EARLY, ("mujoco", STOCK): _NO_RESTITUTION},
    "two-walls": {
        ("pybullet", STOCK): (
            "PyBullet, as installed, catches the ball after two or three impacts: it makes each early."
        ),
        ("mujoco", STOCK): "MuJoCo, as installed, has no restitution, so the ball never meets the walls five times.",
    },
    "sliding-slab": {
        ("pybullet", STOCK): f"{_DRAG} That shortens long slides, and a slab that rocks calms down late.",
        ("mujoco", STOCK): (
            "MuJoCo's friction cone, as installed, is a pyramid: at 30° to its axes it is weaker, and pulls sideways."
            " A fast slab hops, and calms down late."
        ),
        ("dart", STOCK): f"{_ONE_POINT} It hardly ever counts as stopped. Its friction cone is a pyramid.",
    },
    "incline": {
        ("pybullet", STOCK): f"{_DRAG} That slows every slide by up to a quarter.",
        ("mujoco", STOCK): _CREEPS,
        ("dart", STOCK): f"{_ONE_POINT} Some slabs that should hold walk off that way.",
    },
    "break-away": {
        ("pybullet", STOCK): (f"{_DRAG} The damping slows a slab that slides. Before the break-away the slab creeps."),
        ("mujoco", STOCK): (
            "MuJoCo's friction cone, as installed, is a pyramid, weaker between its axes, and it yields a little to any"
            " pull. The slab creeps, breaks away early, and does not slide in the direction of the push."
        ),
        ("dart", STOCK): f"{_ONE_POINT} The slab breaks away late, and turns as it slides.",
    },
    "critical-incline": {
        ("pybullet", STOCK): (
            "PyBullet, as installed, creeps by 2 to 3 mm in 3 s at 1 % below critical, and damps every slide."
        ),
        ("mujoco", STOCK): _CREEPS,
        ("dart", STOCK): f"{_ONE_POINT} Rocking, it slides where it should hold.",
    },
    "sliding-ball": {
        ("pybullet", STOCK): f"{_DRAG} A ball that rolls has no drive to set against it, and gets slower and slower.",
        ("mujoco", STOCK): (
            "A ball that slides hops in MuJoCo, as installed: its convex cone pays for slip with lift. It rolls late."
        ),
    },
    "rolling-ball": {
        ("pybullet", STOCK): f"{_DRAG} The spin loses most.",
        ("mujoco", STOCK): (
            "At MuJoCo's own 2 ms the way is longer by a t Δt/2, 0.1 %, and a ball that slips spins 0.3 % too fast."
        ),
    },
    "struck-cube": {
        ("pybullet", STOCK): (
            "PyBullet, as installed, gives overlap back as speed at its 1/240 s, and damps every velocity."
        )
    },
    "off-centre-impact": {
        ("pybullet", STOCK): (
            "PyBullet, as installed, strikes early at 1/240 s, and takes overlap back as speed. Of a leaning box it"
            " finds one contact point in each step, not always the corner that strikes."
        ),
        ("mujoco", SPRING): "The corner of MuJoCo's spring profile sinks in for some 3 ms, while the cube turns.",
        ("mujoco", STOCK): _NO_RESTITUTION,
        ("dart", STOCK): (
            "DART's solver, as installed, limits friction along each axis by itself, by the normal impulse that it has"
            " found without friction. Of an edge its detector finds points that do not strike alike."
        ),
    },
    "two-balls": {("pybullet", STOCK): _EARLY, ("mujoco", STOCK): _NO_RESTITUTION},
    "box-flat": {
        ("pybullet", STOCK): (
            "PyBullet finds one new contact point of a box on its half-space in each step, so a flat cube is kicked at"
            " one corner first and tumbles."
        ),
        ("mujoco", STOCK): _NO_RESTITUTION,
    },
    "cradle": {
        ("", ""): (
            "The balls touch, and Newton's rule allows more than one result. Hand-written code at the exact instant"
            " takes the impacts in turn, so the last ball flies off; the others solve all contacts together, so that"
            " the first one comes back. A contact that lasts gives a third result."
        ),
        ("pybullet", STOCK): (
            "PyBullet, as installed, responds ahead of the contact, which makes energy where balls are apart. Its"
            " damping takes energy everywhere."
        ),
        ("mujoco", STOCK): _NO_RESTITUTION,
        ("dart", STOCK): "DART's solver, as installed, finds four contacts at once to 0.07 % only.",
    },
    "parting-ball": {
        ("", ""): (
            "The balls touch, and three rules that sound right give three results: one impact after another, all at"
            " once, or every relative velocity turned back."
        ),
        ("pybullet", STOCK): "PyBullet, as installed, solves all contacts at once, and damps every velocity.",
        ("mujoco", STOCK): _NO_RESTITUTION,
    },
    "struck-rod": {
        ("pybullet", STOCK): f"{_DRAG} Overlap that is taken back adds speed.",
        ("mujoco", STOCK): _NO_RESTITUTION,
    },
    "rod-on-peg": {
        ("pybullet", STOCK): "PyBullet, as installed, takes overlap back as speed, so the rod rebounds too high.",
        ("mujoco", STOCK): _NO_RESTITUTION,
    },
    "spinning-ball": {
        ("pybullet", STOCK): (
            "PyBullet's multibody, as installed, loses up to half of the speed that spin should become, and up to four"
            " fifths of the spin that should be left."
        ),
        ("mujoco", STOCK): (
            "MuJoCo, as installed, has no restitution: friction acts for as long as the ball sinks in and is pushed"
            " out."
        ),
    },
    "crossed-edges": {
        ("pybullet", STOCK): "PyBullet, as installed, gives overlap back as speed, and damps the flight.",
        ("mujoco", STOCK): _NO_RESTITUTION,
        ("mujoco", SPRING): "In the 3 ms that MuJoCo's spring lasts, the boxes turn, and the normal with them.",
    },
    "mass-ratios": {
        ("pybullet", STOCK): (
            "PyBullet, as installed, makes 50 sweeps in a step, too few for so light a ball, and damps the flight."
        ),
        ("mujoco", STOCK): ("MuJoCo's contact, as installed, is soft: the balls sink in and are pushed apart again."),
        ("dart", STOCK): "DART, as installed, gives overlap back as speed: a hundredth of it in each step.",
    },
    "superball": {
        ("pybullet", STOCK): _EARLY,
        ("mujoco", STOCK): _NO_RESTITUTION,
        ("dart", STOCK): "DART's friction cone, as installed, is a pyramid, and DART responds up to 1 ms late.",
    },
    "box-on-edge": {("dart", STOCK): "DART, as installed, leaves the box 1.5 to 3.1 mm deep in the floor."},
    "tipping-box": {
        ("", ""): (
            "A box that tips falls from edge to edge. Where it is a second later depends on every contact of its way,"
            " and no closed form says so."
        ),
        ("pybullet", STOCK): (
            "On PyBullet's half-space a box rocks from one contact point to the next, and slides too far."
        ),
        ("mujoco", STOCK): _CREEPS,
        ("dart", STOCK): f"{_ONE_POINT} Two of three boxes that should tip slide.",
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
