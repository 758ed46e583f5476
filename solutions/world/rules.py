"""How a world responds to its contacts."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

from solutions.checks import between, finite, not_negative, positive, whole

LAWS = {
    "sequential": ("dissipative", "newton"),
    "simultaneous": ("dissipative", "newton"),
    "penalty": ("dissipative",),
    "in time order": ("dissipative", "newton", "poisson", "stronge"),
}
"""The responses, and the laws of restitution that each of them knows.

A penalty contact has no law besides its spring and its damper. They add no
energy if the steps are short enough; see `stiffness`.
"""


class Rules(NamedTuple):
    """How a world responds to its contacts.

    Attributes
    ----------
    rest_speed : m/s
        A slower approach ends without rebound. Two steps' gain of
        weight is a good choice, 2 g Δt: what is slower has fallen for two
        steps at most.
    margin : m
        A gap up to which a contact is kept, so that resting bodies keep
        theirs.
    with_weight : whether a rebound includes the speed gained in this step
        Newton's law speaks of the speed of approach. At a step one may take it
        before the forces of the step act, or after; engines of both kinds
        exist.
    slop : m
        An overlap that is left alone, so that resting bodies are not moved
        about.
    recovery : share of a deeper overlap that each step moves away, 0 to 1
    sweeps : how often all contacts take their turn in a step, at most
        In the first five steps of a run up to 500 may follow, but no more than
        ten times as many, because of what rests no impulses are known to begin
        with.
    tolerance : share of the largest impulse; smaller changes end the sweeps
    push_sweeps : how often they do so to move overlaps away
    response : 'sequential', 'simultaneous', 'penalty' or 'in time order'
    law : of restitution: 'dissipative', 'newton', 'poisson' or 'stronge'
        `LAWS` lists the laws that each response knows. 'dissipative' is
        Newton's law with the friction in Coulomb's cone that takes the most
        energy, 'newton' the same law with friction that opposes the slip after
        the impact.
    directions : of friction, in the polygon of the simultaneous response
        An even number.
    stiffness : k of a penalty contact, N/m
        A step that is longer than `penalty_step_limit` makes a contact gain
        energy without end, with this k, the effective mass and the damping of
        the contact. The world does not refuse it, but `run_world` ends when
        the motion has run away.
    sleep_speed : m/s; bodies that stay slower for `sleep_after` s are left out
        0, and nothing sleeps; it must be 0 with the response 'in time order'.
        Only a contact with a faster body wakes a sleeper. It does not notice a
        change of the forces on it.
    sleep_after : s, above 0
    sleep_size : m; a spin counts as a speed that far from the centre
    looks : how often a step in time order may back up the world
        The rest of such a step is resolved without rebound and without another
        look.
    """

    rest_speed: float = 0.1
    margin: float = 1e-3
    with_weight: bool = False
    slop: float = 1e-4
    recovery: float = 0.2
    sweeps: int = 50
    tolerance: float = 1e-6
    push_sweeps: int = 10
    response: str = "sequential"
    law: str = "dissipative"
    directions: int = 8
    stiffness: float = 1e4
    sleep_speed: float = 0.0
    sleep_after: float = 0.5
    sleep_size: float = 0.1
    looks: int = 1000


@lru_cache(maxsize=64)
def known(rules: Rules) -> Rules:
    """Return the rules; refuse an unknown choice and a wrong number."""
    if rules.response not in LAWS:
        raise ValueError(
            f"response must be one of {', '.join(LAWS)}, not"
            f" {rules.response!r}"
        )
    if rules.law not in LAWS[rules.response]:
        laws = ", ".join(LAWS[rules.response])
        raise ValueError(
            f"law of the response {rules.response!r} must be one of {laws},"
            f" not {rules.law!r}"
        )
    for name in (
        "rest_speed",
        "margin",
        "slop",
        "tolerance",
        "sleep_speed",
        "sleep_size",
    ):
        not_negative(name, getattr(rules, name))
    for name in ("sweeps", "push_sweeps", "looks", "directions"):
        finite(name, whole(name, not_negative(name, getattr(rules, name))))
    if rules.directions % 2 or rules.directions < 4:
        raise ValueError(
            f"directions must be an even number from 4, not {rules.directions}"
        )
    finite("margin", rules.margin)
    between("recovery", rules.recovery, 0, 1)
    finite("stiffness", positive("stiffness", rules.stiffness))
    positive("sleep_after", rules.sleep_after)
    if rules.sleep_speed and rules.response == "in time order":
        raise ValueError(
            "sleep_speed must be 0 with the response 'in time order', not"
            f" {rules.sleep_speed:g}: an impact within a step would not wake"
            " a sleeper"
        )
    return rules
