"""What a scenario means, in every engine: coefficients are of pairs, and what there are no words for is refused."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from engine_grid import (
    CATALOGUE,
    CELLS,
    ENGINES,
    EXTRA,
    FLOOR,
    REFUSED,
    REPORT_CONTACTS,
    ROUNDING,
    SAYS_NO,
    SCENARIOS,
    TURNED,
    Cell,
    cells_of,
    fast_and_slow,
    is_often,
    setup,
)

from reference.catalogue import measure
from reference.catalogue.scenarios import catalogue
from reference.engines import load_engine
from reference.engines.profiles import WORLD, counts
from reference.errors import CannotExpress
from reference.scene import geometry
from reference.scene.scenario import GRAVITY, Body, Box, HalfSpace, Pair, Scenario, Sphere


@pytest.mark.parametrize("cell", REFUSED, ids=str)
def test_an_engine_refuses_what_it_cannot_express_with_a_reason(cell, installed):
    installed(cell.engine)
    engine, scenario, settings = setup(cell)
    kind, reason = SAYS_NO[cell.engine][cell.scenario]
    with pytest.raises(kind, match=reason):
        engine.run(scenario, settings)
    with pytest.raises(kind, match=reason):
        engine.run_many([scenario, scenario], settings)


def test_the_grid_holds_every_family_and_every_scenario_of_this_suite():
    assert set(SCENARIOS) == {*catalogue(), *(scenario.name for scenario in EXTRA)}
    assert len(SCENARIOS) == len(CATALOGUE) + len(EXTRA), "two scenarios of one name: the second hides the first"
    for engine in ENGINES:
        runs = {cell.scenario for cell in CELLS if cell.engine == engine}
        assert runs | set(SAYS_NO.get(engine, {})) == set(SCENARIOS)
        assert not runs & set(SAYS_NO.get(engine, {}))


ORDERED = ("dropped-ball", "corner", "cradle", "stack")


LIGHT_BALL = "mass-ratios"
"""A ball between two that are 1000 and 300 times as heavy: every turn of a solver carries little through it."""
FEW_TURNS = {("handwritten", WORLD), ("pybullet", "stock")}
"""Who stops so early that the order of the bodies decides what is left; the test below says how much that may be."""


@fast_and_slow(
    [
        cell
        for cell in CELLS
        if cell.scenario in catalogue()
        and not (cell.scenario == LIGHT_BALL and (cell.engine, cell.profile) in FEW_TURNS)
    ],
    lambda cell: (
        counts(cell.profile) and is_often(cell) and cell.scenario in ("dropped-ball", "corner", "cradle", "stack")
    ),
)
def test_the_order_of_bodies_and_pairs_does_not_change_a_motion(cell, trajectory):
    engine, scenario, settings = setup(cell)
    turned_pairs = tuple(replace(pair, body_a=pair.body_b, body_b=pair.body_a) for pair in scenario.pairs)
    swapped = engine.run(replace(scenario, pairs=turned_pairs), settings)
    reordered = engine.run(replace(scenario, bodies=scenario.bodies[::-1]), settings)
    near = 1e-9 + first_fall(cell) + unfinished(cell)
    for body in scenario.bodies:
        for other in (swapped, reordered):
            # A solver that visits contacts in another order rounds differently, and steps add that up.
            np.testing.assert_allclose(other.position(body.name), trajectory.position(body.name), atol=near)


@pytest.mark.parametrize(
    ("name", "profile", "option", "turns", "pushed", "parts"),
    [
        # By hand the velocities are solved at once, and turns only take back the overlap: a step at 10 m/s, 10 mm.
        ("handwritten", WORLD, "push_sweeps", 200, 10.0 * 1e-3, 2.9e-3),
        # Stock, Bullet stops at a velocity that is wrong by a share of 10 m/s, for the rest of the 30 ms.
        ("pybullet", "stock", "solver_iterations", 50, 10.0 * 0.03, 85.4e-3),
    ],
)
def test_turns_leave_what_they_cannot_carry_through_a_light_ball(
    name, profile, option, turns, pushed, parts, installed
):
    engine, scenario = installed(name), SCENARIOS[LIGHT_BALL]
    first, middle, last = (1 / body.mass for body in scenario.bodies)
    # Of two contacts that share a ball, a turn leaves the square of their coupling: 0.9957 here
    left = (middle**2 / ((first + middle) * (middle + last))) ** turns
    told = engine.settings(scenario, profile)

    def apart(**changes: float) -> float:
        settings = replace(told, options={**told.options, **changes})
        one, other = (
            engine.run(replace(scenario, bodies=bodies), settings)
            for bodies in (scenario.bodies, scenario.bodies[::-1])
        )
        return max(float(np.abs(one.position(it.name) - other.position(it.name)).max()) for it in scenario.bodies)

    assert apart() == pytest.approx(parts, rel=0.01)  # m, as measured: whatever changes it is to be noticed
    assert apart() < left * pushed
    # A hundred times as many turns leave less than 10⁻⁹ of it: rounding, and the tolerance by hand, 10⁻¹⁰
    enough = {option: 100 * turns} | ({"solver_residual": 0.0} if name == "pybullet" else {})
    assert apart(**enough) < 1e-9


def unfinished(cell: Cell) -> float:
    """How far bodies may get apart that push each other where a solver is left to stop early, m.

    Stock, Bullet goes through the contacts in turn and stops after 50 rounds or at a residual of 1e-7, MuJoCo at 1e-8
    of what it minimises. What is left hangs on the order, up to 0.1 mm/s, for the rest of the run. So it does in DART
    wherever a box has more corners down than it takes to carry it: its sweeps never end, its pivots break off. In the
    hand-written world the sweeps stop early where boxes stand on each other or tip.
    """
    movable = [body for body in SCENARIOS[cell.scenario].bodies if not body.immovable]
    boxes = (cell.engine == "dart" or cell.profile == WORLD) and any(isinstance(body.shape, Box) for body in movable)
    return 1e-4 * SCENARIOS[cell.scenario].duration if boxes or (cell.profile == "stock" and len(movable) > 1) else 0.0


def first_fall(cell: Cell) -> float:
    """How far what stands may fall before it is caught, m, where two boxes a gap of zero apart touch or do not.

    Bullet's test of two boxes wants an overlap, and rounding decides whether a gap of zero is one. What is not caught
    falls g dt² in a step; each box of a stack only then meets the one below it.
    """
    _, scenario, settings = setup(cell)
    boxes = settings.options.get("ground") == "box" or geometry.leaning(scenario)
    if cell.engine != "pybullet" or not boxes or not geometry.starts_in_contact(scenario):
        return 0.0
    return GRAVITY * settings.timestep**2 * sum(not body.immovable for body in scenario.bodies)


TWO_BALLS = Scenario(
    "two-balls",
    (
        Body("dull", Sphere(0.1), 1.0, (-2.0, 0.0, 1.1)),
        FLOOR,
        Body("lively", Sphere(0.1), 1.0, (2.0, 0.0, 1.1)),
    ),
    (Pair("dull", "floor", restitution=0.2), Pair("floor", "lively", restitution=0.8)),
    0.9,  # the lively ball is at its apex after 0.45 s × 1.8
)


@pytest.mark.parametrize("name", REPORT_CONTACTS)
def test_two_balls_on_one_floor_bounce_each_as_its_own_pair_says(name, installed):
    engine = installed(name)
    trajectory = engine.run(TWO_BALLS, engine.settings(TWO_BALLS, "tuned"))
    overlap = math.sqrt(2 * GRAVITY) * 1e-3  # v dt: a single drop may be off by as much, at 1 ms
    assert measure.first_apex(trajectory, "dull", "floor") == pytest.approx(0.2**2, abs=overlap)
    assert measure.first_apex(trajectory, "lively", "floor") == pytest.approx(0.8**2, abs=overlap)


@pytest.mark.parametrize("profile", ["tuned", "stock"])
@pytest.mark.parametrize("name", REPORT_CONTACTS)
def test_bodies_whose_pair_is_not_listed_pass_through_each_other(name, profile, installed):
    engine = installed(name)
    scenario = replace(TWO_BALLS, pairs=TWO_BALLS.pairs[1:], duration=0.6)
    trajectory = engine.run(scenario, engine.settings(scenario, profile))
    fallen = GRAVITY * 0.6**2 / 2  # 1.77 m from 1.1 m: below the floor
    assert trajectory.position("dull")[-1, 2] == pytest.approx(1.1 - fallen, abs=0.05)  # drag takes 0.04 · 0.6 of it
    assert trajectory.position("lively")[-1, 2] > 0.09
    alone = replace(scenario, pairs=())
    lonely = engine.run(alone, engine.settings(alone, profile))
    assert lonely.position("lively")[-1, 2] == pytest.approx(1.1 - fallen, abs=0.05)


@pytest.mark.parametrize("name", REPORT_CONTACTS)
@pytest.mark.parametrize("profile", ["tuned", "stock"])
def test_an_engine_with_one_coefficient_of_friction_refuses_two(name, profile, installed):
    engine, scenario = installed(name), SCENARIOS["incline"]
    two = replace(scenario, pairs=(replace(scenario.pairs[0], static_friction=0.5),))
    with pytest.raises(CannotExpress, match="friction"):
        engine.run(two, engine.settings(two, profile))


@cells_of("dropped-ball")
def test_a_half_spaces_normal_does_not_turn_with_its_body(cell, trajectory):
    engine, scenario, settings = setup(cell)
    bodies = tuple(replace(body, orientation=TURNED) if body.immovable else body for body in scenario.bodies)
    turned = engine.run(replace(scenario, bodies=bodies), settings)
    # A normal turned into the body's frame and back is off by some 1e-16, and so is all that follows.
    np.testing.assert_allclose(turned.position("ball"), trajectory.position("ball"), atol=1e-12)
    np.testing.assert_allclose(
        turned.orientations[:, 0], np.broadcast_to(TURNED, (len(turned.times), 4)), atol=ROUNDING
    )


def test_the_hand_written_slab_uses_both_coefficients_of_friction():
    engine, scenario = load_engine("handwritten"), replace(SCENARIOS["incline"], duration=0.6)
    # tan 20° = 0.364 against μ = 0.3
    settings = engine.settings(scenario, "exact")
    held = replace(scenario, pairs=(replace(scenario.pairs[0], static_friction=0.5),))
    assert measure.displacement(engine.run(scenario, settings), "slab") > 0.1
    assert measure.displacement(engine.run(held, settings), "slab") == 0


def test_a_ball_landing_on_a_tilted_plane_as_a_step_ends_bounces_once():
    # Left on the plane by an impact, it may be behind it by rounding, which the slide's T must not take for the next.
    rng, engine, dt = np.random.default_rng(2), load_engine("handwritten"), 1e-3
    scenarios = []
    for number in range(300):
        normal = rng.normal(size=3)
        normal /= np.linalg.norm(normal)
        foot, speed, time = 30 * rng.normal(size=3), 0.1 * rng.integers(1, 50), dt * rng.integers(1, 12)
        gap = speed * time + GRAVITY * time**2 / 2
        ball = Body("ball", Sphere(0.1), 1.0, tuple(foot + (0.1 + gap) * normal), velocity=tuple(-speed * normal))
        plane = Body("plane", HalfSpace(tuple(normal)), position=tuple(foot))
        pair = Pair("ball", "plane", restitution=1.0)
        scenarios.append(Scenario(f"landing-{number}", (plane, ball), (pair,), 0.018, tuple(-GRAVITY * normal)))
    for profile in ("exact", "slide"):
        settings = engine.settings(scenarios[0], profile)
        for trajectory in engine.run_many(scenarios, settings):
            # It leaves with 0.1 m/s or more, so the next impact is 20 ms later at the least.
            assert [event.kind for event in trajectory.events] == ["impact"]
            landing, end = trajectory.events[0].time, float(trajectory.times[-1])
            normal = np.array(trajectory.scenario.body("plane").shape.normal)
            speeds = trajectory.velocity("ball") @ normal
            # v + g t in, the same out; rounding of 1e-14 m in the gap moves the landing by that over 0.1 m/s.
            assert speeds[-1] == pytest.approx(-speeds[0] + 2 * GRAVITY * landing - GRAVITY * end, abs=1e-9)
