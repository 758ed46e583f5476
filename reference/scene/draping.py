"""Whether a scenario is a mesh of small balls on springs that lies on one fixed ball, or falls onto it."""

from __future__ import annotations

from reference.scene.scenario import Body, Scenario, Sphere


def ball_under(scenario: Scenario) -> Body | None:
    """The fixed ball that masses on springs may meet, each of them that one alone; None where it is another scene.

    Nothing rebounds and nothing rubs, so that no mass begins to turn. Every mass may then have one contact, and whether
    it has does not depend on those of the others.
    """
    fixed = {body.name for body in scenario.bodies if body.immovable}
    movable = [body for body in scenario.bodies if not body.immovable]
    met = {name for pair in scenario.pairs for name in (pair.body_a, pair.body_b)} & fixed
    if len(met) != 1 or not scenario.springs or scenario.steering:
        return None
    ball = scenario.body(met.pop())
    balls = [ball, *movable]
    smooth = not any(pair.restitution or pair.kinetic_friction or pair.static_friction for pair in scenario.pairs)
    on_it = all(ball.name in (pair.body_a, pair.body_b) for pair in scenario.pairs)
    round_and_still = all(isinstance(body.shape, Sphere) and not any(body.angular_velocity) for body in balls)
    return ball if smooth and on_it and round_and_still and _central(scenario) else None


def reach(ball: Body, mass: Body) -> float:
    """Distance of the centres of two balls that touch, m."""
    assert isinstance(ball.shape, Sphere)
    assert isinstance(mass.shape, Sphere)
    return ball.shape.radius + mass.shape.radius


def _central(scenario: Scenario) -> bool:
    """Whether all springs end at the centres of bodies, or in the world."""
    return not any(
        any(point)
        for each in scenario.springs
        for name, point in ((each.body_a, each.point_a), (each.body_b, each.point_b))
        if name
    )
