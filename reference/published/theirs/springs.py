"""Published cases of contacts that give way: springs, dashpots, and how deep a body rests in them."""

from __future__ import annotations

from reference.published.case import Published

_GRAVITY = 9.81
_SOLREFS = ((-100.0, -10.0), (-10.0, -10.0), (0.1, 0.8), (0.01, 0.8))
_IMPEDANCES = (0.3, 0.9, 0.99)
_CONTACTS = tuple((solref, impedance) for solref in _SOLREFS for impedance in _IMPEDANCES)
"""The contacts of P9: MuJoCo's words for a spring, and how much of it acts."""


def _stiffness(first: float, second: float) -> float:
    """Stiffness per unit mass, 1/s², of MuJoCo's solref: −k and −b, or a time constant and a damping ratio."""
    return -first if first < 0 else 1 / (first * second) ** 2


CASES = (
    Published(
        number=3,
        title="A ball drops on a spring with a dashpot that may pull",
        statement=8,
        kind="cross-engine",
        source="LAMMPS, unit tests of the granular package, dem02",
        setup={
            "diameter": 0.2,
            "density": 2600.0,
            "stiffness": 1e6,
            "restitution": 0.9,
            "height": 0.5,
            "gravity": 9.81,
            "timestep": 2e-4,
            "steps": (1300, 1650, 2450),
        },
        expected={"position": (0.168422, 0.1795930071, 0.4020226518), "velocity": (2.1749852792, 0.6053852792)},
        tolerance={"position": (5e-7, 1.795930071e-9, 4.020226518e-9), "velocity": (2.1749852792e-8, 6.053852792e-9)},
        reason="half of the last of six printed digits for the first position; a share of 1e-8 of all else, printed "
        "with ten",
        note="Velocity Verlet; F = k d − 2β√(k m) v with β = −ln e/√(π² + ln² e), without a clamp. The velocities "
        "belong to the last two steps. With the clamp the ball is at 0.17994 m at step 1650, and the same β "
        "gives e = 0.902.",
        units={"position": "m", "velocity": "m/s"},
        labels={"position": ("step 1300", "step 1650", "step 2450"), "velocity": ("step 1650", "step 2450")},
    ),
    Published(
        number=9,
        title="How deep a body rests in a soft contact",
        statement=8,
        kind="cross-engine",
        source="MuJoCo, tests of the engine's constraints: four settings of solref, three impedances",
        setup={
            "gravity": _GRAVITY,
            "solref_first": tuple(solref[0] for solref, _ in _CONTACTS),
            "solref_second": tuple(solref[1] for solref, _ in _CONTACTS),
            "stiffness": tuple(_stiffness(*solref) for solref, _ in _CONTACTS),
            "impedance": tuple(impedance for _, impedance in _CONTACTS),
        },
        expected={"depth": tuple(_GRAVITY * (1 - d) / _stiffness(*solref) for solref, d in _CONTACTS)},
        tolerance={"depth": 1e-9},
        reason="a closed form, and a state that is at rest",
        note="g (1 − d)/k for solref (−k, −b), g (1 − d) (t ζ)² for solref (t, ζ), with d the impedance. It is the "
        "depth m g/k of a spring that is 1/(1 − d) as stiff.",
        origin="mujoco",
        units={"depth": "m"},
        labels={"depth": tuple(f"({one:g}, {two:g}), d = {d:g}".replace("-", "−") for (one, two), d in _CONTACTS)},
    ),
    Published(
        number=18,
        title="A ball drops on an undamped spring",
        statement=8,
        kind="verification",
        source="Siconos, example CompliantContact",
        setup={"stiffness": 100.0, "mass": 1.0, "contact": 0.1, "height": 1.0, "gravity": 9.81},
        expected={"lowest": -0.4296, "fastest": 4.3151},
        tolerance={"lowest": 5e-5, "fastest": 5e-5},
        reason="four printed decimals",
        note="The spring begins at the contact height and pushes below it.",
        units={"lowest": "m", "fastest": "m/s"},
    ),
)
