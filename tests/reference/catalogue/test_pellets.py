"""Pellets at a wall: the map of speed, timestep and thickness, and what continuous detection gives in each engine."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
import pytest
from levels import in_turn

from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.pellets import RESTITUTION, SHOTS
from reference.catalogue.scenarios.tunnelling import THIN_WALL
from reference.comparison.compare import compare_case
from reference.comparison.verdicts import Verdict
from reference.engines import load_engine
from reference.scene import leaping

FAMILY = catalogue()["pellets"]
FAST = FAMILY.case("v=60,w=12mm")
GOOD = {Verdict.PASS, Verdict.KNOWN_DEVIATION}


def rows_of(name, profile, case=FAST, first=SHOTS, **changes):
    engine, case = load_engine(name), replace(case, scenarios=case.scenarios[:first])
    settings = engine.settings(case.scenarios[0], profile).change(**changes)
    rows, trajectories = compare_case(FAMILY, case, engine, profile, settings)
    return {row.quantity: row for row in rows}, trajectories


MAP = [
    *((60.0, 0.012, 1e-3), (20.0, 0.003, 1e-3), (60.0, 0.003, 2e-4)),
    *((180.0, 0.012, 2e-4), (180.0, 0.012, 1e-3)),
]
FEW = [("pybullet", *MAP[0]), ("mujoco", *MAP[0])]


@pytest.mark.parametrize(("name", "speed", "thickness", "timestep"), in_turn(("dart", "pybullet", "mujoco"), MAP, FEW))
def test_a_discrete_test_loses_what_speed_timestep_and_thickness_say(name, speed, thickness, timestep, installed):
    installed(name)
    case = FAMILY.case(f"v={speed:g},w={1000 * thickness:g}mm")
    rows, _ = rows_of(name, "tuned", case, timestep=timestep)
    lost = max(0.0, 1 - (thickness / 2 + 0.005) / (speed * timestep))
    # Evenly spread phases: less than one pellet off.
    assert rows["passed"].measured == pytest.approx(lost, abs=1 / SHOTS)
    assert rows["passed"].verdict is (Verdict.DISAGREES if lost else Verdict.PASS)


@pytest.mark.parametrize("timestep", [1e-3, *(pytest.param(each, marks=pytest.mark.slow) for each in (2e-4, 2e-3))])
@pytest.mark.parametrize(("name", "mean"), [("pybullet", 0.5), ("mujoco", -0.5 * (1 + RESTITUTION) / RESTITUTION)])
def test_no_pellet_passes_a_swept_test_and_each_is_late_or_early(name, mean, timestep, installed):
    installed(name)
    rows, _ = rows_of(name, "swept", timestep=timestep)
    assert rows["passed"].measured == 0
    assert {row.verdict for row in rows.values()} <= GOOD
    # In PyBullet it turns back 1.1 mm inside, of which half is pushed out, so that it is 1.1 mm late of its way.
    near = 1.1e-3 / 30.0 + timestep / SHOTS
    assert rows["late"].measured == pytest.approx(mean * timestep, abs=near)


def test_bullet_stops_a_ball_in_the_air_that_it_sweeps_with_its_own_radius(installed):
    """A step that ends 0.6 mm before the wall: the next sweep touches at once, without restitution."""
    installed("pybullet")
    shot = replace(FAST, scenarios=(_moved(FAST.scenarios[0], 0.0006),))
    rows, (stopped,) = rows_of("pybullet", "swept", shot, swept_inset=1e-6)
    assert np.linalg.norm(stopped.velocity("pellet")[-1]) == pytest.approx(0, abs=1e-9)
    assert rows["late"].predicted == pytest.approx(rows["late"].measured, abs=1e-9)
    rows, (back,) = rows_of("pybullet", "swept", shot)
    assert rows["velocity_kept"].measured == pytest.approx(-RESTITUTION)
    assert np.linalg.norm(back.velocity("pellet")[-1]) == pytest.approx(30)


def _moved(scenario, gap):
    """The shot so that the 30th step of a millisecond ends as far before the wall, m."""
    wall, pellet = scenario.bodies
    ahead = np.array(pellet.velocity) / np.linalg.norm(pellet.velocity)
    touch = np.array(pellet.position) + 60 * 0.03003 * ahead
    start = touch - (gap + 30 * 0.06) * ahead
    return replace(scenario, bodies=(wall, replace(pellet, position=tuple(start))))


def test_bullet_sweeps_only_steps_of_40_mm_unless_told(installed):
    installed("pybullet")
    case = FAMILY.case("v=20,w=3mm")
    rows, _ = rows_of("pybullet", "swept", case, 11, sweep_from=0.04)
    assert rows["passed"].measured > 0.5
    rows, _ = rows_of("pybullet", "swept", case, 11, sweep_from=0.019)
    assert rows["passed"].measured == 0


def test_bullet_sweeps_no_multibody(installed):
    installed("pybullet")
    rows, _ = rows_of("pybullet", "swept", first=11, coordinates="multibody")
    assert rows["passed"].measured > 0.5


@pytest.mark.parametrize("fault", ["timestep", "inset"])
def test_another_sweep_than_told_is_not_as_predicted(fault, installed):
    engine = installed("pybullet")
    settings = engine.settings(FAST.scenarios[0], "swept")
    other = settings.change(swept_inset=1.2e-3) if fault == "inset" else settings.change(timestep=1.01e-3)
    told, scenario = settings, FAST.scenarios[0]
    ran = replace(engine.run(scenario, other), settings=told)
    prediction = FAMILY.predict(scenario, told, engine.method(scenario, told))
    late = FAMILY.quantity("late").measure
    assert abs(late(ran) - late(prediction.trajectory)) > 1e3 * prediction.band(late(prediction.trajectory))


def test_dart_has_no_continuous_detection(installed):
    dart = installed("dart").module()
    names = [*dir(dart.collision), *dir(dart.collision.CollisionOption), *dir(dart.constraint.ConstraintSolver)]
    assert not [name for name in names if "contin" in name.lower() or "swept" in name.lower() or "ccd" in name.lower()]
    assert "swept" not in FAMILY.profiles(installed("dart"))


def test_only_shots_that_pass_a_wall_in_1_ms_have_the_swept_profile():
    for family in catalogue().values():
        leaps = {leaping.may_leap(scenario) for case in family.cases for scenario in case.scenarios}
        assert leaps == {family is FAMILY}, family.name
    slow, fast = THIN_WALL.case("v=20").scenarios[0], FAST.scenarios[0]
    wall, ball = fast.bodies
    assert leaping.way_of_a_step(slow, 1e-3) == pytest.approx(0.02)
    turned_round = replace(fast, bodies=(ball, wall))
    heavy = replace(fast, gravity=(0.0, 0.0, -9.81))
    assert (leaping.may_leap(turned_round), leaping.may_leap(heavy)) == (True, False)


def test_by_hand_the_way_back_begins_at_the_touch_at_any_timestep():
    for timestep, case in itertools.product((1e-3, 5e-3), FAMILY.cases[::5]):
        rows, _ = rows_of("handwritten", "exact", case, 11, timestep=timestep)
        assert {row.verdict for row in rows.values()} == {Verdict.PASS}
