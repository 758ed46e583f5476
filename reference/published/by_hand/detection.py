"""Collisions that are detected, by hand: when a point meets a plane, and how deep a box is below one."""

from __future__ import annotations

import itertools
import math

import numpy as np

from reference.engines.implementation import Implementation
from reference.published.answers import Answers, as_answers
from reference.published.by_hand.axes import STILL, UP, X
from reference.published.case import Published
from reference.published.landing import at_impact


def hot_rock(case: Published, code: Implementation) -> Answers:
    """P28: the exact instant at which the rock is as low as the plane, and its velocity there."""
    angle, pull = math.radians(case.value("angle")), -case.value("gravity") * UP
    thrown = case.value("speed") * (math.cos(angle) * X + math.sin(angle) * UP)
    gap = code.function("signed_distance")(STILL, UP, case.value("below"))
    time = code.function("time_of_impact_exact")(gap, thrown @ UP, pull @ UP)
    _, velocity = code.function("ballistic_motion")(STILL, thrown, pull, time)
    return at_impact(float(time), velocity)


def box_below_plane(case: Published, code: Implementation) -> Answers:
    """P29: the signed distance of the lowest of the eight corners."""
    corners = np.array(list(itertools.product((-0.5, 0.5), repeat=3))) * case.numbers("size")
    turns = np.reshape(case.numbers("orientation"), (-1, 4))
    turned = corners @ np.swapaxes(code.function("rotation_matrix")(turns), -1, -2)
    places = turned + np.multiply.outer(case.numbers("height"), UP)[:, None, :]
    distance = np.min(code.function("signed_distance")(places, UP, 0.0), axis=-1)
    return as_answers(distance=tuple(distance.tolist()))
