"""Reciprocal avoidance by hand."""

from __future__ import annotations

import numpy as np

from reference.engines.implementation import Implementation
from reference.published.answers import Answer, Answers, as_answers
from reference.published.case import Published

ANY_STEP = 0.1
"""Timestep, s. It counts only where two discs overlap already, and these do not."""
WHOLE = "where no collision threatens, it takes half of the way to the border, as RVO2 does; dodgy takes all of it"


def half_plane(case: Published, code: Implementation) -> Answers:
    """P23: the border of the permitted velocities, a point on it and its direction."""
    point, normal = code.function("orca_half_plane")(**case.setup, dt=ANY_STEP)
    return as_answers(point=tuple(point.tolist()), direction=(float(normal[1]), -float(normal[0])))


def lines_of_the_port(case: Published, code: Implementation) -> Answers:
    """P32: five borders. Where the disc keeps clear already, dodgy leaves it twice the room that RVO2 does."""
    velocity, neighbour, theirs = (
        np.reshape(numbers, (-1, 2))
        for numbers in (case.numbers("velocity"), case.numbers("neighbour"), case.expected_numbers("point"))
    )
    radius, horizon, dt = (np.array(case.numbers(name)) for name in ("radius", "horizon", "timestep"))
    still = np.zeros(2)
    point, normal = code.function("orca_half_plane")(still, velocity, radius, neighbour, still, radius, horizon, dt)
    clear = np.sum((velocity - theirs) * normal, axis=-1) > 0
    shift = np.where(clear[:, None], (velocity - theirs) / 2, 0.0)
    along = np.stack([normal[:, 1], -normal[:, 0]], axis=-1)
    return {
        "point": Answer(
            tuple(point.ravel().tolist()),
            shift=tuple(shift.ravel().tolist()),
            shift_reason=WHOLE,
            shift_tolerance=case.tolerance["point"],
        ),
        "direction": Answer(tuple(along.ravel().tolist())),
    }


def permitted(case: Published, code: Implementation) -> Answers:
    """P33: the velocity of the five wishes, and of the one that three lines leave nothing."""
    nearest = code.function("permitted_velocity")

    def chosen(which: str) -> tuple[float, ...]:
        points, along, wishes = (
            np.reshape(case.numbers(which + name), (-1, 2)) for name in ("points", "directions", "preferred")
        )
        left = np.stack([-along[:, 1], along[:, 0]], axis=-1)
        found = nearest(wishes, case.value(which + "max_speed"), points, left)
        return tuple(np.ravel(found).tolist())

    return as_answers(velocity=chosen(""), least_bad=chosen("blocked_"))
