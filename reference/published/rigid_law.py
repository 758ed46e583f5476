"""The law of a rigid sphere that strikes a floor obliquely, and how far it is off the measured impacts of P11."""

from __future__ import annotations

import numpy as np

from reference.arrays import Array, Mask
from reference.published.answers import Answer, Answers
from reference.published.case import Published

YIELDS = (
    "a real contact yields sideways and swings back, which no rigid impulse does: where the sphere grips, it is off by"
    " what the rigid law is off the measurement"
)


def against_rigid_law(
    case: Published, tangent_restitution: tuple[float, ...], spin: tuple[float, ...], near: float
) -> Answers:
    """Answers to P11 that may be off the measurement by as much as the rigid law is, where the sphere grips.

    near: how well the implementation follows that law, as a share of the largest number.
    """
    answers = {}
    for name, found in (("tangent_restitution", tangent_restitution), ("spin", spin)):
        measured, law, grips = np.array(case.expected[name]), *rigid_law(case)[name]
        shift = np.where(grips, law - measured, 0.0)
        answers[name] = Answer(
            found, shift=tuple(shift.tolist()), shift_reason=YIELDS, shift_tolerance=near * max(found)
        )
    return answers


def rigid_law(case: Published) -> dict[str, tuple[Array, Mask]]:
    """By figure, what a rigid sphere does at the measured angles of P11, and at which of them it grips."""
    kept, _, grips = rigid_sphere(case, np.array(case.numbers("angle")))
    _, spin, turns = rigid_sphere(case, np.array(case.numbers("angle_of_spin")))
    return {"tangent_restitution": (kept, grips), "spin": (spin, turns)}


def rigid_sphere(case: Published, angle: Array) -> tuple[Array, Array, Mask]:
    """Share of the tangential speed that is left, spin, rad/s, and whether it grips, at angles from the normal, °.

    A sphere that grips leaves rolling. Its angular momentum about the contact, m v r, becomes (1 + 2/5) m v' r, so that
    5/7 of the tangential speed is left, and friction has taken 2/7 of it. Friction can take μ (1 + e) times the normal
    speed at most: where that is less than 2/7, the sphere slides, and the impulse turns it by 1/(2/5) of the speed that
    is taken.
    """
    radius, speed, e, mu = case.values("radius", "speed", "restitution", "friction")
    turned = np.radians(angle)
    grips = np.tan(turned) < 7 / 2 * mu * (1 + e)
    kept = np.where(grips, 5 / 7, 1 - mu * (1 + e) / np.tan(turned))
    spin = np.where(grips, 5 / 7 * np.sin(turned), 5 / 2 * mu * (1 + e) * np.cos(turned)) * speed / radius
    return kept, spin, grips
