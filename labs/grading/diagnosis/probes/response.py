"""Probes of the functions that respond to a collision with a plane."""

from __future__ import annotations

from typing import Any

from labs.grading.diagnosis.probes.probe import Draw, Probe, edge, made, refused, usual

UP, LEANS, WALL = [0.0, 0.0, 1.0], [1 / 3, 2 / 3, 2 / 3], [-0.6, 0.8, 0.0]
REST, FALL = [0.0, 0.0, 0.0], [0.0, 0.0, -9.81]
INFINITY = float("inf")


def probes(function: str) -> tuple[Probe, ...]:
    """The probes of one of this topic's functions."""
    return tuple(_TABLE[function]())


def _kinematic() -> list[Probe]:
    by_hand = [
        usual("straight down on the floor", [0, 0, -2], UP, 0.5),
        usual("slanting", [3, 0, -4], UP, 0.5),
        usual("a plane that leans", [0, 0, -3], LEANS, 0.5),
        usual("already moving away", [1, 2, 3], UP, 0.5),
        usual("already moving away from a plane that leans", [2, 1, 2], LEANS, 0.25),
        usual("no bounce", [1, 0, -2], UP, 0.0),
        usual("perfect bounce", [1, 0, -2], UP, 1.0),
        usual("against a wall", [1, -2, 3], WALL, 0.8),
        edge("along the plane", [2, 1, 0], UP, 0.5),
        edge("at rest", REST, UP, 0.5),
        edge("perfect bounce, straight on", [0, 0, -3], UP, 1.0),
        refused("a normal that is not of unit length", [0, 0, -2], [0, 0, 2], 0.5),
        refused("a restitution above 1", [0, 0, -2], UP, 1.5),
    ]
    return made(
        "kinematic_response", by_hand, lambda draw: (draw.vector(), draw.unit(), draw.number(0.1, 0.9)), single=()
    )


def _moving_plane() -> list[Probe]:
    by_hand = [
        usual("a plane at rest", [1, 0, -2], REST, UP, 0.5),
        usual("a racket comes to meet the ball", [0, 0, -2], [0, 0, 3], UP, 0.5),
        usual("the plane draws back, more slowly", [1, 0, -4], [0, 0, -1], UP, 0.5),
        usual("the plane draws back faster than the ball follows", [1, 0, -1], [0, 0, -4], UP, 0.5),
        usual("the plane catches up with a ball that moves away", [1, 0, 1], [0, 0, 3], UP, 0.5),
        usual("the plane slides in itself", [1, 0, -2], [5, 3, 0], UP, 0.5),
        usual("the ball gets away", [0, 1, 3], [0, 0, 1], UP, 0.8),
        usual("no bounce: the ball goes with the plane", [1, 0, -2], [2, 0, 1], UP, 0.0),
        edge("both at the same speed", [1, 0, -2], [0, 1, -2], UP, 0.5),
        edge("both at rest", REST, REST, UP, 0.5),
        edge("perfect bounce", [0, 0, -2], [0, 0, 2], UP, 1.0),
        refused("a normal that is not of unit length", [0, 0, -2], REST, [0, 0, 2], 0.5),
    ]
    maker = lambda draw: (draw.vector(), draw.vector(3), draw.unit(), draw.number(0.1, 0.9))  # noqa: E731
    return made("moving_plane_response", by_hand, maker)


def _at_impact() -> list[Probe]:
    start = [0, 0, 2]
    by_hand = [
        usual("straight down, half way through the step", start, [0, 0, -4], REST, UP, 0.5, 0.5, 1.0),
        usual("with gravity", start, [1, 0, -4], FALL, UP, 0.5, 0.35, 1.0),
        usual("no collision in this step", start, [1, 0, -4], FALL, UP, 0.5, INFINITY, 0.25),
        usual("a collision after this step", start, [1, 0, -4], FALL, UP, 0.5, 0.75, 0.25),
        usual("no bounce", start, [1, 2, -4], REST, UP, 0.0, 0.5, 1.0),
        usual("a plane that leans", start, [0, 0, -3], FALL, LEANS, 0.8, 0.2, 0.5),
        edge("at the start of the step", start, [1, 0, -4], FALL, UP, 0.5, 0.0, 0.25),
        edge("at the end of the step", start, [1, 0, -4], FALL, UP, 0.5, 0.25, 0.25),
        edge("moving away at that time", start, [0, 0, 4], REST, UP, 0.5, 0.5, 1.0),
        edge("a step of no length", start, [1, 0, -4], FALL, UP, 0.5, INFINITY, 0.0),
        refused("a negative time", start, [1, 0, -4], FALL, UP, 0.5, -1.0, 0.25),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        normal, dt = draw.unit(), draw.number(0.2, 0.9)
        fall = draw.vector(6)
        velocity = draw.vector() - draw.number(12, 15) * normal  # towards the plane, whatever the acceleration
        return draw.vector(), velocity, fall, normal, draw.number(0.1, 0.9), round(dt * draw.number(0.1, 0.9), 3), dt

    return made("respond_at_impact", by_hand, maker)


def _at_step() -> list[Probe]:
    inside = [0, 0, -0.5]
    by_hand = [
        usual("behind the floor, on its way in", inside, [1, 0, -3], REST, UP, True, 0.5, 0.5),
        usual("with gravity", inside, [1, 0, -3], FALL, UP, True, 0.5, 0.5),
        usual("in front of the floor, falling", [0, 0, 1], [1, 0, -1], FALL, UP, False, 0.5, 0.125),
        usual("behind, but on its way out", inside, [1, 0, 1], FALL, UP, True, 0.5, 0.5),
        usual("in front, on its way out", [0, 0, 1], [1, 0, 2], FALL, UP, False, 0.5, 0.5),
        usual("pulled along the plane", inside, [1, 0, -3], [2, -1, -8], UP, True, 0.5, 0.5),
        usual("pulled off the plane", inside, [1, 0, -4], [0, 0, 2], UP, True, 0.5, 0.5),
        usual("no bounce", inside, [1, 0, -3], FALL, UP, True, 0.0, 0.5),
        usual("a plane that leans", [0, 0, -1], [0, 0, -5], FALL, LEANS, True, 0.8, 0.5),
        edge("perfect bounce", inside, [1, 0, -3], FALL, UP, True, 1.0, 0.5),
        edge("a step of no length", inside, [1, 0, -2], FALL, UP, True, 0.5, 0.0),
        edge("along the floor", inside, [2, 1, 0], FALL, UP, True, 0.5, 0.5),
        edge("at rest behind the floor", inside, REST, FALL, UP, True, 0.5, 0.5),
        refused("a negative step", inside, [1, 0, -2], REST, UP, True, 0.5, -0.5),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        normal = draw.unit()
        velocity = draw.tangent(normal, 3) + draw.number(1, 6) * draw.sign() * normal
        behind, e, dt = draw.sign() > 0, draw.number(0.1, 0.9), draw.number(0.2, 0.6)
        return draw.vector(2), velocity, draw.vector(4), normal, behind, e, dt

    return made("respond_at_step", by_hand, maker)


def _until_rest() -> list[Probe]:
    by_hand = [
        usual("let fall from rest", 2.0, 0.0, -10.0, 0.5),
        usual("thrown down", 2.0, -3.0, -10.0, 0.5),
        usual("thrown up", 2.0, 3.0, -10.0, 0.5),
        usual("from the plane up", 0.0, 3.0, -10.0, 0.5),
        edge("no bounce", 2.0, -3.0, -10.0, 0.0),
        usual("hardly a loss", 1.0, 0.0, -9.81, 0.95),
        edge("a bounce without gravity", 3.0, -1.5, 0.0, 0.5),
        edge("no bounce, without gravity", 3.0, -1.5, 0.0, 0.0),
        edge("pulled away", 3.0, -1.0, 2.0, 0.5),
        edge("it arrives and is pulled off again", 1.0, -4.0, 2.0, 0.5),
        edge("it arrives for good, and is pulled off again", 1.0, -4.0, 2.0, 0.0),
        edge("pulled off the plane", 0.0, 0.0, 2.0, 0.5),
        edge("behind the plane, moving out", -0.5, 2.0, -10.0, 0.5),
        edge("it bounces for ever", 2.0, 0.0, -10.0, 1.0),
        edge("it lies on the plane", 0.0, 0.0, -10.0, 0.5),
        edge("it lies on the plane, without gravity", 0.0, 0.0, 0.0, 0.5),
        edge("it lies on the plane, e = 1", 0.0, 0.0, -10.0, 1.0),
        edge("behind the plane, at rest", -0.5, 0.0, -10.0, 0.5),
        edge("moving in on the plane", 0.0, -2.0, -10.0, 0.5),
        edge("at rest above the plane, without gravity", 1.0, 0.0, 0.0, 0.5),
        refused("a restitution above 1", 1.0, 0.0, -10.0, 1.5),
    ]

    def maker(draw: Draw) -> tuple[float, ...]:
        return draw.number(0.2, 3), draw.number(-4, 4), -draw.number(1, 12), draw.number(0.1, 0.95)

    return made("time_until_rest", by_hand, maker)


def _penalty_force() -> list[Probe]:
    by_hand = [
        usual("pressed in, at rest", -0.125, 0.0, UP, 800.0, 0.0, False),
        usual("moving in", -0.125, -2.0, UP, 800.0, 10.0, False),
        usual("moving out slowly", -0.125, 2.0, UP, 800.0, 10.0, False),
        usual("moving out fast: the dashpot would pull", -0.125, 20.0, UP, 800.0, 10.0, False),
        usual("the same with adhesion", -0.125, 20.0, UP, 800.0, 10.0, True),
        usual("in front of the plane", 0.25, 0.0, UP, 800.0, 10.0, False),
        usual("in front of the plane, moving in", 0.25, -3.0, UP, 800.0, 10.0, False),
        usual("in front of the plane, with adhesion", 0.25, 3.0, UP, 800.0, 10.0, True),
        usual("damping and adhesion left out", -0.5, -3.0, UP, 400.0),
        usual("a plane that leans", -0.25, -1.0, LEANS, 100.0, 5.0, False),
        edge("touching exactly", 0.0, 0.0, UP, 800.0, 10.0, False),
        edge("touching exactly, moving in", 0.0, -2.0, UP, 800.0, 10.0, False),
        edge("touching exactly, moving in, with adhesion", 0.0, -2.0, UP, 800.0, 10.0, True),
        edge("no stiffness", -0.5, -2.0, UP, 0.0, 10.0, False),
        refused("a negative stiffness", -0.5, 0.0, UP, -1.0, 0.0, False),
        refused("a normal that is not of unit length", -0.5, 0.0, [0, 0, 2], 100.0, 0.0, False),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        depth, stiffness = draw.number(-0.5, -0.05), draw.number(50, 900, 0)
        return depth, draw.number(-4, 4), draw.unit(), stiffness, draw.number(1, 60), False

    return made("penalty_force", by_hand, maker, single=(5,))


def _rest_depth() -> list[Probe]:
    by_hand = [
        usual("a kilogram", 1.0, 9.81, 1000.0),
        usual("a soft floor", 2.0, 9.81, 50.0),
        usual("on the moon", 3.0, 1.62, 400.0),
        edge("no gravity", 2.0, 0.0, 500.0),
        edge("no mass", 0.0, 9.81, 500.0),
        refused("no stiffness", 1.0, 9.81, 0.0),
    ]
    maker = lambda draw: (draw.number(0.2, 5), draw.number(1, 12), draw.number(50, 900, 0))  # noqa: E731
    return made("penalty_rest_depth", by_hand, maker)


def _step_limit() -> list[Probe]:
    by_hand = [
        usual("no damping", 1.0, 100.0, 0.0),
        usual("damping left out", 4.0, 100.0),
        usual("little damping", 1.0, 100.0, 2.0),
        usual("critical damping", 1.0, 100.0, 20.0),
        usual("a lot of damping", 1.0, 100.0, 200.0),
        usual("heavy", 50.0, 200.0, 10.0),
        edge("far more damping than anything else", 1.0, 1.0, 1e4),
        refused("no mass", 0.0, 100.0, 0.0),
        refused("a negative damping", 1.0, 100.0, -1.0),
    ]
    maker = lambda draw: (draw.number(0.2, 5), draw.number(50, 900, 0), draw.number(1, 60))  # noqa: E731
    return made("penalty_step_limit", by_hand, maker)


_TABLE = {
    "kinematic_response": _kinematic,
    "moving_plane_response": _moving_plane,
    "respond_at_impact": _at_impact,
    "respond_at_step": _at_step,
    "time_until_rest": _until_rest,
    "penalty_force": _penalty_force,
    "penalty_rest_depth": _rest_depth,
    "penalty_step_limit": _step_limit,
}
