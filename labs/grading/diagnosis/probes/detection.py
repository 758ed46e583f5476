"""Probes of the functions that detect a collision."""

from __future__ import annotations

from labs.grading.diagnosis.probes.probe import YES_OR_NO, Draw, Probe, edge, made, refused, usual

UP = [0.0, 0.0, 1.0]


def probes(function: str) -> tuple[Probe, ...]:
    """The probes of one of this topic's functions."""
    return tuple(_TABLE[function]())


def _signed_distance() -> list[Probe]:
    by_hand = [
        usual("a metre above the floor", [0, 0, 1], UP, 0.0),
        usual("below the floor", [1, 2, -0.5], UP, 0.0),
        usual("a normal of length 2", [0, 0, 3], [0, 0, 2], -4.0),
        usual("a short normal", [1, 2, 3], [0.1, 0.2, 0.2], 0.3),
        usual("a plane that leans", [1, 1, 1], [1, -2, 2], 5.0),
        edge("exactly on the plane", [4, 5, 2], UP, -2.0),
        edge("at the origin, the plane too", [0, 0, 0], [1, 2, 2], 0.0),
        refused("a normal of no length", [0, 0, 1], [0, 0, 0], 1.0),
    ]
    return made("signed_distance", by_hand, lambda draw: (draw.vector(), draw.vector(3), draw.number(-5, 5)), single=())


def _side() -> list[Probe]:
    by_hand = [
        usual("in front", 1.0),
        usual("behind", -1.0),
        usual("in front, within the tolerance", 0.05, 0.1),
        usual("behind, within the tolerance", -0.05, 0.1),
        usual("in front, beyond the tolerance", 0.7, 0.1),
        usual("behind, beyond the tolerance", -0.7, 0.1),
        edge("on the plane", 0.0),
        edge("on the plane, with a tolerance", 0.0, 0.25),
        edge("in front by exactly the tolerance", 0.25, 0.25),
        edge("behind by exactly the tolerance", -0.25, 0.25),
        edge("hardly in front", 1e-12),
        edge("hardly behind", -1e-12),
        refused("a separation that is no number", float("nan"), 0.0),
        refused("a negative tolerance", 1.0, -0.5),
    ]
    return made("side_of_plane", by_hand, _separation_and_tolerance, count=YES_OR_NO)


def _separation_and_tolerance(draw: Draw) -> tuple[float, float]:
    return draw.number(-1, 1), draw.number(0.05, 0.6)


def _interpolated() -> list[Probe]:
    by_hand = [
        usual("half way", 1.0, -1.0, 0.0, 2.0),
        usual("a quarter of the way", 1.0, -3.0, 5.0, 0.4),
        usual("it stays in front", 2.0, 1.0, 0.0, 0.1),
        usual("it moves away", 1.0, 2.0, 3.0, 0.1),
        edge("behind all the time", -1.0, -2.0, 1.0, 0.1),
        edge("it comes out from behind", -1.0, 2.0, 1.0, 0.1),
        edge("from the plane through it", 0.0, -1.0, 2.0, 0.5),
        edge("from the plane away", 0.0, 1.0, 2.0, 0.5),
        edge("it ends on the plane", 1.0, 0.0, 2.0, 0.5),
        edge("on the plane all the time", 0.0, 0.0, 2.0, 0.5),
        edge("no change", 1.0, 1.0, 2.0, 0.5),
        edge("a step of no length", 1.0, -1.0, 2.0, 0.0),
        refused("a negative step", 1.0, -1.0, 0.0, -0.1),
    ]

    def maker(draw: Draw) -> tuple[float, ...]:
        return draw.number(0.1, 2), draw.number(-3, -0.1), draw.number(0.5, 5), draw.number(0.1, 1)

    return made("time_of_impact_interpolated", by_hand, maker)


def _impacts() -> list[Probe]:
    by_hand = [
        usual("it does not arrive", 0.25, 0.5, 1.0, 0.25, 1.25),
        usual("one impact within a step", 0.25, 2.0, 1.0, 0.25, 0.5),
        usual("to the left", 0.25, -1.5, 1.0, 0.25, 0.5),
        usual("to the left, then to the right", 0.75, -1.5, 1.0, 0.25, 2.25),
        usual("walls 2.5 m apart", 0.5, 2.0, 2.5, 0.375, 3.375),
        usual("to the left, walls 0.5 m apart", 0.375, -1.25, 0.5, 0.125, 1.25),
        usual("three impacts in one step", 0.25, 6.0, 1.0, 0.5, 0.5),
        usual("eleven impacts in one step", 0.5, -7.0, 2.0, 3.0, 3.0),
        usual("the same in six steps", 0.5, -7.0, 2.0, 0.5, 3.0),
        edge("from a wall, away from it", 0.0, 0.75, 2.0, 0.5, 2.0),
        edge("from the far wall, away from it", 2.0, -0.75, 2.0, 0.5, 2.0),
        edge("from a wall, into it", 0.0, -0.75, 2.0, 0.5, 2.0),
        edge("from the far wall, into it", 2.0, 0.75, 2.0, 0.5, 2.0),
        edge("some steps end on a wall", 0.5, 1.0, 1.0, 0.25, 3.25),
        edge("the last step ends on a wall", 0.5, 1.0, 1.0, 0.25, 2.5),
        edge("at rest", 0.25, 0.0, 1.0, 0.25, 1.0),
        edge("at rest on a wall", 1.0, 0.0, 1.0, 0.25, 1.0),
        edge("three steps, though 0.3/0.1 is just below 3", 0.5, 2.0, 1.0, 0.1, 0.3),
        edge("ten steps of 0.1 s, which add up to just below 1 s", 0.25, 2.0, 1.0, 0.1, 1.0),
        edge("no step", 0.5, 2.0, 1.0, 0.25, 0.0),
        refused("a start beyond the wall", 1.5, 2.0, 1.0, 0.25, 1.0),
    ]

    def maker(draw: Draw) -> tuple[float, ...]:
        length, dt, sign = draw.number(0.5, 2.5), draw.number(0.05, 0.5), draw.sign()
        duration = round(int(draw.rng.integers(2, 12)) * dt, 6)
        start, end = draw.number(0.1, 0.9) * length, (int(draw.rng.integers(6)) + draw.number(0.2, 0.8)) * length
        way = end - start if sign > 0 else start + end  # it ends away from a wall, where rounding would decide
        return round(start, 4), round(sign * way / duration, 2), length, dt, duration

    return made("count_impacts", by_hand, maker, single=range(5))


def _exact() -> list[Probe]:
    by_hand = [
        usual("let fall from rest", 2.0, 0.0, -9.81),
        usual("thrown down", 2.0, -3.0, -9.81),
        usual("thrown up", 2.0, 4.0, -9.81),
        edge("thrown up from the plane", 0.0, 3.0, -9.81),
        edge("straight on, without gravity", 3.0, -1.5, 0.0),
        edge("away, without gravity", 3.0, 1.5, 0.0),
        edge("pulled away before it arrives", 3.0, -1.0, 2.0),
        edge("pulled away, but fast enough", 1.0, -4.0, 2.0),
        edge("at rest on the plane, pressed on", 0.0, 0.0, -9.81),
        edge("at rest above the plane, no gravity", 1.0, 0.0, 0.0),
        edge("on the plane, moving in", 0.0, -2.0, -9.81),
        edge("on the plane, moving away, no gravity", 0.0, 2.0, 0.0),
        edge("just behind the plane, moving in", -0.5, -2.0, -9.81),
        edge("just behind the plane, moving out", -0.5, 3.0, -10.0),
        refused("a velocity that is no number", 1.0, float("nan"), -1.0),
    ]
    maker = lambda draw: (draw.number(0.2, 3), draw.number(-5, 5), -draw.number(1, 10))  # noqa: E731
    return made("time_of_impact_exact", by_hand, maker)


def _overlap() -> list[Probe]:
    by_hand = [
        usual("through a thin wall within the step", 2.0, -10.0, 0.1, 0.2, 1.0),
        usual("still in the wall at the end", 1.0, -1.0, 0.5, 2.0, 1.5),
        usual("it does not arrive within the step", 5.0, -1.0, 0.5, 1.0, 1.0),
        usual("moving away", 1.0, 2.0, 0.25, 0.5, 1.0),
        usual("it starts inside and leaves by the back", -0.5, -2.0, 0.25, 1.0, 2.0),
        usual("it starts inside and leaves by the front", -0.5, 2.0, 0.25, 1.0, 2.0),
        usual("from behind", -4.0, 3.0, 0.5, 1.0, 3.0),
        edge("along the wall, outside", 2.0, 0.0, 0.5, 1.0, 1.0),
        edge("along the wall, inside", 0.25, 0.0, 0.5, 1.0, 1.0),
        edge("along the wall, behind it", -3.0, 0.0, 0.5, 1.0, 1.0),
        edge("at rest and touching the back", -1.5, 0.0, 0.5, 1.0, 1.0),
        usual("a point against a wall", 1.0, -2.0, 0.0, 0.5, 1.0),
        edge("a point against a sheet", 1.0, -2.0, 0.0, 0.0, 1.0),
        edge("a half-space", 1.0, -2.0, 0.5, float("inf"), 3.0),
        edge("it touches at the first instant", 0.5, 1.0, 0.5, 1.0, 1.0),
        edge("it touches at the last instant", 1.5, -1.0, 0.5, 1.0, 1.0),
        edge("at rest and touching", 0.5, 0.0, 0.5, 1.0, 1.0),
        edge("a step of no length, inside", 0.0, -1.0, 0.5, 1.0, 0.0),
        refused("a negative radius", 1.0, -1.0, -0.5, 1.0, 1.0),
    ]

    def maker(draw: Draw) -> tuple[float, ...]:
        return (
            draw.number(0.8, 2),
            -draw.number(2, 9),
            draw.number(0.05, 0.5),
            draw.number(0.05, 0.6),
            draw.number(0.2, 1),
        )

    return made("overlap_interval", by_hand, maker)


def _walls(draw: Draw) -> tuple[float, ...]:
    return draw.number(5, 60), draw.number(0.02, 0.4), draw.number(0.02, 0.2), draw.number(0.01, 0.06)


def _missing() -> list[Probe]:
    by_hand = [
        usual("half of them pass", 40.0, 0.1, 0.05, 0.01),
        usual("slow enough to be seen", 1.0, 0.1, 0.05, 0.01),
        usual("a point against a wall", 20.0, 0.05, 0.0, 0.01),
        usual("a ball against a sheet", 20.0, 0.0, 0.05, 0.01),
        edge("a ball that does not move", 0.0, 0.1, 0.05, 0.01),
        edge("a step of no length", 3.0, 0.1, 0.05, 0.0),
        edge("a point against a sheet", 3.0, 0.0, 0.0, 0.01),
        edge("at rest, a point against a sheet", 0.0, 0.0, 0.0, 0.01),
        edge("exactly the wall's way", 16.0, 0.5, 0.25, 0.0625),
        refused("a negative speed", -1.0, 0.1, 0.1, 0.01),
    ]
    return made("missing_probability", by_hand, _walls)


_TABLE = {
    "signed_distance": _signed_distance,
    "side_of_plane": _side,
    "time_of_impact_interpolated": _interpolated,
    "count_impacts": _impacts,
    "time_of_impact_exact": _exact,
    "overlap_interval": _overlap,
    "missing_probability": _missing,
}
