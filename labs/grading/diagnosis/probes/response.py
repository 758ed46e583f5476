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
        usual("a racket comes to meet the ball", [0, 0, -2], UP, 0.5, [0, 0, 3]),
        usual("the plane draws back, more slowly", [1, 0, -4], UP, 0.5, [0, 0, -1]),
        usual("the plane draws back faster than the ball follows", [1, 0, -1], UP, 0.5, [0, 0, -4]),
        usual("the plane catches up with a ball that moves away", [1, 0, 1], UP, 0.5, [0, 0, 3]),
        usual("the plane slides within itself", [1, 0, -2], UP, 0.5, [5, 3, 0]),
        usual("the ball gets away from a plane that follows", [0, 1, 3], UP, 0.8, [0, 0, 1]),
        usual("no bounce: the ball goes with the plane", [1, 0, -2], UP, 0.0, [2, 0, 1]),
        edge("along the plane", [2, 1, 0], UP, 0.5),
        edge("at rest", REST, UP, 0.5),
        edge("perfect bounce, straight on", [0, 0, -3], UP, 1.0),
        edge("ball and plane at the same speed", [1, 0, -2], UP, 0.5, [0, 1, -2]),
        edge("perfect bounce off a racket", [0, 0, -2], UP, 1.0, [0, 0, 2]),
        refused("a normal that is not of unit length", [0, 0, -2], [0, 0, 2], 0.5),
        refused("a restitution above 1", [0, 0, -2], UP, 1.5),
    ]
    maker = lambda draw: (draw.vector(), draw.unit(), draw.number(0.1, 0.9), draw.vector(3))  # noqa: E731
    return made("kinematic_response", by_hand, maker)


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


def _bounce() -> list[Probe]:
    above = [0, 0, 1]
    by_hand = [
        usual("a fall, a bounce, and some flight", above, [1, 0, -2], FALL, UP, 0.0, 0.5, 0.25, 4),
        usual("two bounces", [0, 1, 0.25], [2, 0, -3], [0, 0, -8], UP, 0.0, 0.5, 0.25, 8),
        usual("a floor two metres up", [0, 0, 2.5], [1, 0, -2], FALL, UP, -2.0, 0.5, 0.25, 4),
        usual("a plane that leans", [1, 1, 1], [0, 0, -5], FALL, LEANS, 0.5, 0.8, 0.25, 4),
        usual("without gravity", above, [1, 0, -3], REST, UP, 0.0, 0.5, 0.25, 4),
        usual("it does not arrive", [0, 0, 9], [1, 0, -2], FALL, UP, 0.0, 0.5, 0.25, 3),
        usual("behind the plane at the start, on its way in", [0, 0, -0.5], [1, 0, -2], FALL, UP, 0.0, 0.5, 0.25, 3),
        usual("behind the plane at the start, on its way out", [0, 0, -0.5], [1, 0, 4], FALL, UP, 0.0, 0.5, 0.25, 3),
        usual("no bounce", above, [1, 0, -4], FALL, UP, 0.0, 0.0, 0.25, 4),
        usual("pulled along the plane", above, [1, 0, -4], [2, -1, -8], UP, 0.0, 0.5, 0.25, 4),
        usual("pulled off the plane", above, [1, 0, -8], [0, 0, 4], UP, 0.0, 0.5, 0.25, 4),
        edge("perfect bounce", above, [1, 0, -4], FALL, UP, 0.0, 1.0, 0.25, 4),
        edge("a step ends on the plane", [0, 0, 2], [1, 0, -1], REST, UP, -2.0, 0.5, 0.5, 3),
        edge("a later step ends on the plane", [0, 0, 3], [1, 0, -1], REST, UP, -2.0, 0.5, 0.5, 4),
        edge("at rest on the plane", REST, REST, [0, 0, -8], UP, 0.0, 0.5, 0.25, 4),
        edge("no steps", above, [1, 0, -2], FALL, UP, 0.0, 0.5, 0.25, 0),
        edge("one step", above, [1, 0, -2], FALL, UP, 0.0, 0.5, 0.25, 1),
        edge("steps of no length", [0, 0, -1], [1, 0, -2], FALL, UP, 0.0, 0.5, 0.0, 2),
        refused("a negative number of steps", above, [1, 0, -2], FALL, UP, 0.0, 0.5, 0.25, -1),
        refused("steps of negative length", above, [1, 0, -2], FALL, UP, 0.0, 0.5, -0.25, 2),
        refused("a restitution above 1", above, [1, 0, -2], FALL, UP, 0.0, 1.5, 0.25, 2),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        normal, offset = draw.unit(), draw.number(-2, 2)
        position = draw.tangent(normal, 3) + (draw.number(0.1, 1) - offset) * normal
        velocity = draw.tangent(normal, 3) - draw.number(3, 6) * normal
        pull = draw.vector(2) - draw.number(4, 9) * normal
        return position, velocity, pull, normal, offset, draw.number(0.1, 0.9), draw.number(0.1, 0.3), 6

    return made("bounce", by_hand, maker, single=(7,))


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
        usual("in front of a plane that leans, with adhesion", 0.5, -2.0, LEANS, 60.0, 9.0, True),
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


def _step_limit() -> list[Probe]:
    by_hand = [
        usual("no damping", 1.0, 100.0, 0.0),
        usual("damping left out", 4.0, 100.0),
        usual("little damping", 1.0, 100.0, 2.0),
        usual("critical damping", 1.0, 100.0, 20.0),
        usual("a lot of damping", 1.0, 100.0, 200.0),
        usual("heavy", 50.0, 200.0, 10.0),
        edge("far more damping than anything else", 1.0, 1.0, 1e4),
        edge("so much damping that a difference has no digits left", 1.0, 100.0, 1e10),
        edge("so much damping that a difference has one digit left", 1.0, 100.0, 3e8),
        refused("no mass", 0.0, 100.0, 0.0),
        refused("a negative damping", 1.0, 100.0, -1.0),
    ]
    maker = lambda draw: (draw.number(0.2, 5), draw.number(50, 900, 0), draw.number(1, 60))  # noqa: E731
    return made("penalty_step_limit", by_hand, maker)


def _design() -> list[Probe]:
    by_hand = [
        usual("perfect bounce", 2.0, 3.0, 0.5, 1.0, 10.0),
        usual("half of the speed", 2.0, 3.0, 0.5, 0.5, 10.0),
        usual("a ball of 50 g at 4.4 m/s, a millimetre deep", 0.05, 4.4, 1e-3, 0.7, 30.0),
        usual("heavy and slow", 50.0, 0.25, 0.02, 0.3, 20.0),
        edge("hardly any bounce", 1.0, 2.0, 0.1, 0.01, 10.0),
        edge("half a step per contact", 1.0, 2.0, 0.1, 0.5, 0.5),
        refused("no mass", 0.0, 3.0, 0.5, 0.5, 10.0),
        refused("no depth", 2.0, 3.0, 0.0, 0.5, 10.0),
        refused("no bounce at all", 2.0, 3.0, 0.5, 0.0, 10.0),
        refused("a restitution above 1", 2.0, 3.0, 0.5, 1.5, 10.0),
        refused("no steps", 2.0, 3.0, 0.5, 0.5, 0.0),
    ]

    def maker(draw: Draw) -> tuple[float, ...]:
        return (
            draw.number(0.2, 5), draw.number(0.5, 6), draw.number(0.05, 0.5), draw.number(0.1, 0.95),
            draw.number(3, 40, 1),
        )  # fmt: skip

    return made("design_contact", by_hand, maker)


_TABLE = {
    "kinematic_response": _kinematic,
    "respond_at_step": _at_step,
    "bounce": _bounce,
    "respond_at_impact": _at_impact,
    "penalty_force": _penalty_force,
    "penalty_step_limit": _step_limit,
    "design_contact": _design,
}
