"""The demonstrations for a lecture, as plain data; `demonstration.py` says what each field means."""

from __future__ import annotations

import difflib
import functools
import math
import re

from labs.demonstrations.demonstration import Demonstration, Profiles
from labs.demonstrations.lesson import Error, IfKnown, Line, Listed, Magnitude, Measured, Predicted, Theory
from reference.catalogue.scenarios import bouncing_ball, friction, stacks, tipping_box, tunnelling
from reference.engines.dart_settings import REST_SPEED
from reference.engines.profiles import EXACT, SLIDE, STEP, STOCK, TUNED, WORLD
from reference.errors import UnknownName

ENGINES: Profiles = dict.fromkeys(("pybullet", "mujoco", "dart"), (TUNED, STOCK))
STEPPED: Profiles = {"handwritten": (EXACT, STEP), **ENGINES}
IN_THE_WORLD: Profiles = {"handwritten": (WORLD,), **ENGINES}
_KEPT = 0.8
"""Restitution of the ball that bounces."""
_SPEED = 20.0
"""Speed of the balls that are shot at the wall, m/s."""
_HALF_HEIGHT = 0.2
"""Half the height of the box on the slope, m."""


def find(name: str) -> Demonstration:
    """Return the demonstration of that name.

    Raises
    ------
    UnknownName
        If there is none.
    """
    known = {demonstration.name: demonstration for demonstration in DEMONSTRATIONS}
    if name not in known:
        raise UnknownName("demonstration", name, known, _meant(name))
    return known[name]


def _meant(name: str) -> str:
    """The demonstration that a name comes nearest to, be it by its name, its scenario or a word of its title."""
    words: dict[str, str] = {}
    for each in DEMONSTRATIONS:
        for word in (each.name, each.family, *re.findall(r"\w{3,}", each.title.lower())):
            words.setdefault(word, each.name)
    close = difflib.get_close_matches(name.lower(), words, 1, 0.6)
    return words[close[0]] if close else ""


BOUNCE = Demonstration(
    name="bounce",
    title="A bouncing ball",
    question=f"A ball falls {bouncing_ball.DROP_HEIGHT:g} m and keeps {_KEPT:g} of its speed at every impact. What will"
    " happen: does it bounce for ever, or does it come to rest? When?",
    look="Look at who stops first, and at who never leaves the floor.",
    lesson=(
        Line("Infinitely many bounces, each shorter than the last, end after ", Theory("rest_time"), "."),
        Line(
            "Steps miss the last ones: ",
            Listed(
                IfKnown("by hand ", Error("handwritten", "step", "rest_time")),
                IfKnown("DART ", Error("dart", "tuned", "rest_time"), f" (rests below {REST_SPEED:g} m/s)"),
            ),
            ".",
        ),
        Line(
            "Stock: ",
            Listed(
                IfKnown("PyBullet rests at ", Measured("pybullet", "stock", "rest_time"), " (contact too early)"),
                IfKnown("MuJoCo ", Measured("mujoco", "stock", "rest_time"), " (no e)"),
            ),
            ".",
        ),
    ),
    family="ball-to-rest",
    cases={f"e = {_KEPT:g}": f"e={_KEPT:g}"},
    profiles={**STEPPED, "handwritten": (EXACT, SLIDE, STEP)},
    quantity="rest_time",
    heading="time of rest",
)

STOP = Demonstration(
    name="stop",
    title="A slab slides to a stop",
    question="It starts at 2 m/s on a floor with μ = 0.4, at 30° to the axes. What will happen: how far does it go, and"
    " does its direction matter?",
    look="Look at where each curve levels off, and how far aside it ends.",
    lesson=(
        Line("v²/(2 μ g) = ", Theory("stopping_distance"), ", for any mass and direction."),
        Line(
            "Steps stop it v dt/2 short: ",
            Listed(
                IfKnown("by hand ", Error("handwritten", "step", "stopping_distance")),
                IfKnown("PyBullet ", Error("pybullet", "tuned", "stopping_distance")),
                IfKnown("DART ", Error("dart", "tuned", "stopping_distance")),
            ),
            ".",
        ),
        Line(
            "Stock: ",
            Listed(
                IfKnown("PyBullet ", Error("pybullet", "stock", "stopping_distance"), " (damping)"),
                IfKnown("MuJoCo ", Error("mujoco", "stock", "stopping_distance"), " (pyramid)"),
                IfKnown("DART ", Measured("dart", "stock", "sideways"), " aside"),
            ),
            ".",
        ),
    ),
    family="sliding-slab",
    cases={"μ = 0.4, 2 m/s, 30°": "μ=0.4,v=2,heading=30°"},
    profiles=STEPPED,
    quantity="stopping_distance",
    heading="distance",
    beside={"sideways": "aside"},
)

STACK = Demonstration(
    name="stack",
    title="A stack of ten boxes",
    question=f"Ten boxes stand on each other and nobody touches them. What will happen in {stacks.STANDING:g} seconds?",
    look="Look at the top box: how far does it sink, and does it stay there?",
    lesson=(
        Line(
            "Tuned, the top sinks a little: ",
            Listed(
                IfKnown("PyBullet ", Magnitude("pybullet", "tuned", "height")),
                IfKnown("MuJoCo ", Magnitude("mujoco", "tuned", "height")),
                IfKnown("DART ", Magnitude("dart", "tuned", "height")),
            ),
            ".",
        ),
        Line(
            "Stock PyBullet gives its solver too few passes: a box drifts by ",
            Magnitude("pybullet", "stock", "drift"),
            ".",
        ),
        Line(
            "Stock MuJoCo has soft contacts: the top sinks by ",
            Magnitude("mujoco", "stock", "height"),
            ", at once.",
        ),
    ),
    family="stack",
    cases={"ten": "boxes=10"},
    profiles=ENGINES,
    quantity="height",
    heading="top moves",
    beside={"drift": "drift aside"},
)

TUNNELLING = Demonstration(
    name="tunnelling",
    title="A fast ball and a thin wall",
    question=f"A ball of {1000 * tunnelling.RADIUS:g} mm radius flies at {_SPEED:g} m/s at a solid wall"
    f" {1000 * tunnelling.THICKNESS:g} mm thick. What will happen: does the wall stop it – every time?",
    look="Look at the share that passes as the step grows; the line is the prediction.",
    lesson=(
        Line(
            f"A step moves the ball v dt; only on L = w/2 + r = {1000 * tunnelling.CAUGHT:g} mm can the wall stop it."
        ),
        Line(
            "So 1 − L/(v dt) pass: at 1/240 s ",
            Predicted("1/240 s"),
            "; ",
            Listed(
                IfKnown("PyBullet ", Measured("pybullet", "tuned", "passed", at="1/240 s")),
                IfKnown("MuJoCo ", Measured("mujoco", "tuned", "passed", at="1/240 s")),
                IfKnown("DART ", Measured("dart", "tuned", "passed", at="1/240 s")),
            ),
            ".",
        ),
        Line(
            "Cure: small steps, v dt < L",
            IfKnown(", or a swept test, as by hand: ", Measured("handwritten", "exact", "passed", at="1/60 s")),
            ".",
        ),
    ),
    family="thin-wall",
    cases={f"{_SPEED:g} m/s": f"v={_SPEED:g}"},
    profiles={"handwritten": (EXACT,), **dict.fromkeys(ENGINES, (TUNED,))},
    timesteps={"1 ms": 1e-3, "2 ms": 2e-3, "1/240 s": 1 / 240, "1/120 s": 1 / 120, "1/60 s": 1 / 60},
    quantity="passed",
    heading="balls that pass",
    percent=True,
    predicted=functools.partial(tunnelling.passing_share, _SPEED),
)

ROLL = Demonstration(
    name="roll",
    title="A ball that begins to roll",
    question="A ball is set down at 2 m/s without spin, with μ = 0.1. What will happen: how fast is it in the end –"
    " and would it be slower with more friction?",
    look="Look at the kink, where sliding becomes rolling, and at what comes after it.",
    lesson=(
        Line("5/7 of the speed is left, ", Theory("rolling_speed"), ": about the floor friction has no moment."),
        Line("So μ decides only when it rolls: from 2 v/(7 μ g) = ", Theory("rolling_start"), " on."),
        Line(
            "Stock PyBullet: ",
            Error("pybullet", "stock", "rolling_speed"),
            ", because its damping never stops.",
        ),
    ),
    family="sliding-ball",
    cases={"μ = 0.1, 2 m/s": "μ=0.1,v=2"},
    profiles=IN_THE_WORLD,
    quantity="rolling_speed",
    heading="final speed",
)

TIP = Demonstration(
    name="tip",
    title="A box on a slope",
    question="A box, twice as high as wide, is set on a slope and let go: at 20° with much friction, at 20° with"
    " little, and at 32° with much. What will happen each time: does it hold, slide or tip?",
    look="Look at the lean of the box at 32°, and in the table at who disagrees.",
    lesson=(
        Line(
            f"Where tan θ > b/h ({math.degrees(math.atan(tipping_box.HALF_WIDTH / _HALF_HEIGHT)):.0f}°) the weight"
            " misses the base: it tips, if μ holds it."
        ),
        Line(
            "Below that it slides where tan θ > μ: ",
            Theory("way", at="20°, μ = 0.3"),
            " in 1 s at 20° with μ = 0.3.",
        ),
        Line(
            "Where it should hold, it moves ",
            Listed(
                IfKnown(Magnitude("mujoco", "stock", "way", at="20°, μ = 0.7"), " in stock MuJoCo"),
                IfKnown(Magnitude("dart", "stock", "way", at="20°, μ = 0.7"), " in stock DART"),
            ),
            ".",
        ),
    ),
    family="tipping-box",
    cases={
        "20°, μ = 0.7": f"h={_HALF_HEIGHT:g},μ=0.7,θ=20°",
        "20°, μ = 0.3": f"h={_HALF_HEIGHT:g},μ=0.3,θ=20°",
        "32°, μ = 0.7": f"h={_HALF_HEIGHT:g},μ=0.7,θ=32°",
    },
    profiles=IN_THE_WORLD,
    quantity="outcome",
    heading="what it does",
    words={friction.HOLDS: "holds", friction.SLIDES: "slides", tipping_box.TIPS: "tips"},
)

CRADLE = Demonstration(
    name="cradle",
    title="Newton's cradle",
    question="One ball strikes four others that touch, all alike and elastic, at 1 m/s. What will happen: which of them"
    " move off, and how fast?",
    look="Look at the last ball, and at who agrees with whom.",
    lesson=(
        Line(
            "Newton's rule is for one impact. Two at a time (exact), the last ball gets ",
            Measured("handwritten", "exact", "last"),
            ".",
        ),
        Line(
            "All at once (step), it gets ",
            Measured("handwritten", "step", "last"),
            ", the first one ",
            Measured("handwritten", "step", "first"),
            ". Both ways keep energy.",
        ),
        Line(
            "Engines take them at once: ",
            Listed(
                IfKnown("PyBullet ", Measured("pybullet", "tuned", "last")),
                IfKnown("MuJoCo ", Measured("mujoco", "tuned", "last")),
                IfKnown("DART ", Measured("dart", "tuned", "last")),
            ),
            ".",
        ),
    ),
    family="cradle",
    cases={"five, touching": "5 touching"},
    profiles=STEPPED,
    quantity="last",
    heading="last",
    beside={"first": "first", "energy": "energy"},
)

DEMONSTRATIONS = (BOUNCE, STOP, STACK, TUNNELLING, ROLL, TIP, CRADLE)
