"""Pellets and rods of the catalogue for a notebook's own loops, and their replays beside recordings."""

from __future__ import annotations

import numpy as np
import pytest

from labs.desk import own_sweeps
from labs.desk.own_sweeps import passes, rod_beside, shot_beside, shots
from labs.desk.tunnelling_map import recorded_shares, tunnelling_map
from reference.catalogue.scenarios import find
from reference.engines import load_engine
from reference.engines.profiles import EXACT, SWEPT, TUNED
from reference.errors import InvalidInput, NotRecorded
from solutions.sweeping import rotated, separation_of_hulls

PELLETS, ROD = "pellets/v=60,w=12mm", "spinning-rod/ω=100"


def test_every_shot_flies_along_x_and_would_touch_the_wall_10_ms_before_its_end():
    seen = shots(PELLETS)
    np.testing.assert_allclose(seen.velocity, [60, 0, 0], atol=1e-12)
    assert seen.half_extents[0] == pytest.approx(0.006)
    touch = seen.starts[:, 0] + 60 * (seen.durations - 0.01)
    assert touch == pytest.approx(-(seen.half_extents[0] + seen.radius))


def test_a_grown_rod_reaches_the_balls_centre_when_the_rod_touches_the_ball():
    for each in passes(ROD)[::7]:
        before, after = (
            separation_of_hulls(rotated(each.grown, each.spin * time), each.ball[None])[0]
            for time in (each.touch - 1e-6, each.touch + 1e-6)
        )
        assert before == pytest.approx(1e-6 * 100 * 0.3, rel=1e-3)  # the speed of the rod there is 30 m/s
        assert after == 0


def test_rod_and_ball_part_as_hand_written_code_makes_them():
    _, case = find(ROD)
    engine, scenario = load_engine("handwritten"), case.scenarios[0]
    run = engine.run(scenario, engine.settings(scenario, EXACT))
    spin = np.array(scenario.body("rod").angular_velocity)
    change = {name: run.velocity(name)[-1] - run.velocity(name)[0] for name in ("rod", "ball")}
    size = np.linalg.norm(change["ball"])
    gained, slower = own_sweeps._parting(spin, change["ball"] / size)
    assert gained / scenario.body("ball").mass == pytest.approx(change["ball"], rel=1e-6)  # the touch is 4 nm early
    assert spin - slower == pytest.approx(run.angular_velocity("rod")[-1], rel=1e-6)


def test_replays_have_your_pellet_and_your_rod_beside_the_engines():
    seen = shots(PELLETS)
    way = np.stack([seen.starts[0], seen.starts[0] + 0.04 * seen.velocity])
    assert shot_beside(PELLETS, [0, 0.04], way, ("pybullet",)).text == "[replay: yours, PyBullet*]"
    for time in (passes(ROD)[0].touch, np.inf):
        assert rod_beside(ROD, time, ("mujoco",), stock=True).text == "[replay: yours, MuJoCo*, stock]"


def test_what_cannot_be_shown_is_named():
    with pytest.raises(InvalidInput, match="not about one box and one ball"):
        shots("passing-balls/v=40")
    with pytest.raises(InvalidInput, match="names no case"):
        passes("spinning-rod")
    with pytest.raises(InvalidInput, match=r"\(n, 3\), not \(2, 2\)"):
        shot_beside(PELLETS, [0, 1], np.zeros((2, 2)), ("pybullet",))
    with pytest.raises(InvalidInput, match="rising instants"):
        shot_beside(PELLETS, [1, 0], np.zeros((2, 3)), ("pybullet",))
    with pytest.raises(InvalidInput, match="from 0 on, or never"):
        rod_beside(ROD, np.nan, ("pybullet",))


@pytest.mark.parametrize(("profile", "engines"), [(TUNED, ("mujoco", "dart")), (SWEPT, ("mujoco",))])
def test_all_engines_have_the_same_map(profile, engines):
    points = recorded_shares("pybullet", profile)
    assert len(points) == 18
    assert all(recorded_shares(engine, profile) == points for engine in engines)


def test_the_map_says_how_many_of_its_points_let_pellets_pass():
    shares = np.zeros((2, 3))
    picture = tunnelling_map({"at the end": shares + 0.25, "along": shares}, [0.002, 0.03], [0.003, 0.03, 0.4])
    assert picture.png.startswith(b"\x89PNG")
    assert "at the end: yours 25% at most, engines pass at 16 of 18 points" in picture.text
    assert "along: yours 0% at most, engines pass at 0 of 18 points" in picture.text


def test_maps_that_fit_no_grid_are_named():
    with pytest.raises(InvalidInput, match="give two maps, not 1"):
        tunnelling_map({"one": [[0.0]]}, [1.0], [1.0])
    with pytest.raises(InvalidInput, match=r"second: \(1, 2\) shares for 1 walls and 1 ways"):
        tunnelling_map({"first": [[0.0]], "second": [[0.0, 1.0]]}, [1.0], [1.0])
    with pytest.raises(NotRecorded, match="no pellets"):
        recorded_shares("handwritten", TUNED)
