"""What engines promise of a scenario's meaning: it lies in no order, in no frame of a body, and in no other run."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from engine_grid import ONE_OF_EACH, ROUNDING, SCENARIOS, TURNED, Cell, is_rare, same

from reference.catalogue.scenarios import catalogue
from reference.engines.profiles import WORLD
from reference.scene import geometry
from reference.scene.scenario import GRAVITY, Box, Pair

from .run import Promise, Run

LIGHT_BALL = "mass-ratios"
"""A ball between two that are 1000 and 300 times as heavy: every turn of a solver carries little through it."""
FEW_TURNS = {("handwritten", WORLD), ("pybullet", "stock")}
"""Who stops so early that the order decides what is left; a test of `test_engines_pairs.py` says how much that is."""


def the_order_of_bodies_and_pairs_does_not_change_a_motion(run: Run) -> None:
    others = [run.again(bodies=run.scenario.bodies[::-1], pairs=every_second_swapped(run.scenario.pairs))]
    if run.cell.scenario in ONE_OF_EACH and run.scenario.pairs:
        others.append(run.again(pairs=tuple(map(swapped, run.scenario.pairs))))
    near = 1e-9 + first_fall(run) + unfinished(run)
    for body in run.scenario.bodies:
        for other in others:
            # A solver that visits contacts in another order rounds differently, and steps add that up.
            np.testing.assert_allclose(other.position(body.name), run.trajectory.position(body.name), atol=near)


def every_second_swapped(pairs: tuple[Pair, ...]) -> tuple[Pair, ...]:
    """Together with reversed bodies: in the first, third … pair the bodies' order is no longer that of the pair.

    In the others only the pair itself says which body is its first. That an engine asks the pair is a matter of the two
    shapes, so the scenarios that have each pair of shapes also run with all their pairs swapped and bodies as they are.
    """
    return tuple(swapped(pair) if place % 2 else pair for place, pair in enumerate(pairs))


def swapped(pair: Pair) -> Pair:
    return replace(pair, body_a=pair.body_b, body_b=pair.body_a)


def unfinished(run: Run) -> float:
    """How far bodies may get apart that push each other where a solver is left to stop early, m.

    Stock, Bullet goes through the contacts in turn and stops after 50 rounds or at a residual of 1e-7, MuJoCo at 1e-8
    of what it minimises. What is left depends on the order, up to 0.1 mm/s, for the rest of the run. So it does in DART
    wherever a box has more corners down than it takes to carry it: its sweeps never end, its pivots break off. In the
    hand-written world the sweeps stop early where boxes stand on each other or tip.
    """
    movable = [body for body in run.scenario.bodies if not body.immovable]
    sweeps = run.cell.engine == "dart" or run.cell.profile == WORLD
    boxes = sweeps and any(isinstance(body.shape, Box) for body in movable)
    stops = boxes or (run.cell.profile == "stock" and len(movable) > 1)
    return 1e-4 * run.scenario.duration if stops else 0.0


def first_fall(run: Run) -> float:
    """How far what stands may fall before it is caught, m, where two boxes a gap of zero apart touch or do not.

    Bullet's test of two boxes wants an overlap, and rounding decides whether a gap of zero is one. What is not caught
    falls g dt² in a step; each box of a stack only then meets the one below it.
    """
    boxes = run.settings.options.get("ground") == "box" or geometry.leaning(run.scenario)
    if run.cell.engine != "pybullet" or not boxes or not geometry.starts_in_contact(run.scenario):
        return 0.0
    return GRAVITY * run.settings.timestep**2 * sum(not body.immovable for body in run.scenario.bodies)


def a_half_spaces_normal_does_not_turn_with_its_body(run: Run) -> None:
    bodies = tuple(replace(body, orientation=TURNED) if body.immovable else body for body in run.scenario.bodies)
    turned = run.again(bodies=bodies)
    # A normal turned into the body's frame and back is off by some 1e-16, and so is all that follows.
    np.testing.assert_allclose(turned.position("ball"), run.trajectory.position("ball"), atol=1e-12)
    np.testing.assert_allclose(
        turned.orientations[:, 0], np.broadcast_to(TURNED, (len(turned.times), 4)), atol=ROUNDING
    )


def scenarios_run_together_give_what_each_gives_alone(run: Run) -> None:
    first = run.scenario
    ball = replace(first.body("ball"), position=(0.0, 0.0, 0.4))
    lower = replace(first, bodies=tuple(ball if body.name == "ball" else body for body in first.bodies), duration=0.35)
    alone = (run.trajectory, run.engine.run(lower, run.settings))
    together = run.engine.run_many([first, lower], run.settings)
    assert all(same(one, other) for one, other in zip(together, alone, strict=True))


def has_an_order(cell: Cell) -> bool:
    finishes = cell.scenario != LIGHT_BALL or (cell.engine, cell.profile) not in FEW_TURNS
    bodies = SCENARIOS[cell.scenario].bodies
    return cell.scenario in catalogue() and finishes and len(bodies) > 1 and not is_rare(cell)


def drops(cell: Cell) -> bool:
    return cell.scenario == "dropped-ball"


PROMISES = (
    Promise(the_order_of_bodies_and_pairs_does_not_change_a_motion, has_an_order),
    Promise(a_half_spaces_normal_does_not_turn_with_its_body, drops),
    Promise(scenarios_run_together_give_what_each_gives_alone, drops),
)
