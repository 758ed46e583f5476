"""What the lesson on swept volumes says in numbers: its experiments, the engines' recordings, and its model answers."""

from __future__ import annotations

import math
import re

import pytest
from made_lessons import experiments_of, printed, recorded, text_of

from labs.desk.own_sweeps import passes
from reference.catalogue.scenarios import find
from reference.running.study import plan, run_job
from solutions.sweeping import missed_share

pytestmark = pytest.mark.slow  # `make test` has test_detection_lesson of this kind

ENGINES = ("pybullet", "mujoco", "dart")
BALLS = 29


@pytest.fixture(scope="module")
def text():
    return text_of("sweeping")


@pytest.fixture(scope="module")
def experiments():
    return experiments_of("sweeping")


def test_most_pairs_pass_in_stock_engines(text):
    passed = {engine: recorded(engine, "passing-balls/v=40", "stock", "passed") for engine in ENGINES}
    assert {engine: int(share.sum()) for engine, share in passed.items()} == {"pybullet": 55, "mujoco": 50, "dart": 42}
    low, high = (round(100 * edge(share.mean() for share in passed.values())) for edge in (min, max))
    assert f"{low} to {high} % do" in text
    assert all(share[0] == 1 for share in passed.values())  # those of the replay pass


@pytest.mark.parametrize(("radius", "share"), [("radius_a + radius_b", 56), ("radius_a", 95)])
def test_a_first_version_lets_pairs_pass_because_b_moves(tmp_path, text, radius, share):
    first = tmp_path / "first.py"
    first.write_text(
        "import numpy as np\nfrom solutions.sweeping import ray_sphere\n"
        "def sweep_sphere_sphere(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt):\n"
        f"    time = ray_sphere(position_a - position_b, velocity_a, {radius})\n"
        "    return np.where(time <= dt, time, np.inf)\n",
        encoding="utf-8",
    )
    family, case = find("passing-balls/v=40")
    (job,) = plan([family], ["handwritten"], ["exact"], {family.name: (case.name,)}, f"{first} | solutions")
    assert round(100 * run_job(job).rows[0].measured) == share
    assert f"{share} % of" in text


def test_from_within_the_friend_finds_the_far_side(experiments):
    assert 1e3 * experiments.friends_root(-1e-6) == pytest.approx(4.0, abs=1e-3)
    assert experiments.friends_root(1e-6) == pytest.approx(1e-7, rel=1e-6)


def test_no_wind_changes_a_time(experiments, capsys):
    assert len(set(re.findall(r"after ([\d.]+) s", printed(capsys, experiments.in_the_wind)))) == 1


def test_looks_miss_what_the_formula_says(experiments):
    for way in (0.5, 1.0, 2.0, 4.0):
        counted = experiments.looks_miss(way)
        share = float(missed_share(way, 0.4, 0.6, 1.0))
        assert counted == pytest.approx(share, abs=4 * math.sqrt(share / 200_000))  # four deviations of a count
    assert float(missed_share(1.0, 1.0, 0.0, 1.0)) == pytest.approx(0.083, abs=5e-4)
    assert float(missed_share(0.35, 1.0, 0.0, 1.0)) == pytest.approx(0.01, abs=3e-4)


def test_a_response_loses_as_many_pairs_as_looks_twice_as_far_apart_miss():
    lost = recorded("pybullet", "passing-balls/v=40", "tuned", "passed").mean()
    assert missed_share(40.0, 0.01, 0.01, 2e-3) == pytest.approx(2 / 3)
    assert missed_share(40.0, 0.01, 0.01, 1e-3) == pytest.approx(1 / 3)
    assert abs(lost - 2 / 3) < 1.4 / 61  # the lattice of 61 meetings; see `passing_balls`


def test_only_the_bottom_face_is_met_in_plain_python(experiments, capsys):
    assert printed(capsys, experiments.along_the_faces).split("\n")[:2] == ["top: a miss", "bottom: a hit"]


def test_your_pellet_turns_back_where_it_touches_the_wall(experiments):
    shot = experiments.shots("pellets/v=60,w=12mm")
    _, places = experiments.fly("pellets/v=60,w=12mm")
    assert places[:, 0].max() == pytest.approx(-shot.half_extents[0] - shot.radius, abs=1e-12)
    passed = {engine: recorded(engine, "pellets/v=60,w=12mm", "tuned", "passed")[0] for engine in ("pybullet", "dart")}
    assert passed == {"pybullet": 1, "dart": 0}


def test_the_rounded_box_is_hit_in_proportion_to_its_surface(experiments, capsys):
    plain, true, false, missed = re.findall(r"[\d.]+", printed(capsys, experiments.from_all_sides))
    share = (24 + 16 * math.pi) / 96
    assert int(true) / int(plain) == pytest.approx(share, abs=4 * math.sqrt(share * (1 - share) / int(plain)))
    assert float(false) > 20
    assert int(missed) == 0
    assert re.findall(r"[\d.]+", printed(capsys, experiments.beyond_a_corner)) == ["0.785"]


def test_neither_the_ends_nor_their_hull_notice_the_post(experiments, capsys):
    gaps = re.findall(r"([+-]?\d+) mm", printed(capsys, experiments.hand_of_a_clock))
    assert [gaps[place] for place in (0, 3, 6, 7)] == ["+551", "-50", "+551", "93"]


def test_grazing_takes_as_many_looks_as_the_formula_says(experiments, text):
    looks = [experiments.past_a_wall(gap)[1] for gap in (0.1, 0.01, 0.001, 0.0001)]
    assert looks == pytest.approx([math.pi * math.sqrt(1.0 / gap) for gap in (0.1, 0.01, 0.001, 0.0001)], rel=0.2)
    assert looks[3] / looks[1] == pytest.approx(10, rel=0.1)
    assert f"1 cm this takes {looks[1]} looks" in text
    assert experiments.past_a_wall(0.01, spin=1000.0)[1] == looks[1]


def test_hits_are_early_by_what_the_tolerance_allows(experiments):
    for gap in (-0.1, -0.01, -0.0001):
        time, _ = experiments.past_a_wall(gap)
        angle = math.acos(1 + gap / 0.5)
        exact = (math.pi / 2 - angle) / 10.0
        assert 0 <= exact - time < 1.1e-6 / (10.0 * 0.5 * math.sin(angle))  # 1 µm, at the speed towards the wall


def test_eleven_looks_see_every_ball_and_ten_at_fixed_instants_see_six(experiments, text):
    times, looks = experiments.strike("spinning-rod/ω=100")
    assert times == pytest.approx([each.touch for each in passes("spinning-rod/ω=100")], abs=1e-7)
    assert round(looks.mean()) == 11
    assert experiments.seen("spinning-rod/ω=100", 1e-3) == 6
    assert "Ten looks at fixed instants see 6 of 29 balls. Eleven looks" in text


def test_stock_rods_pass_nearly_every_ball_and_the_tuned_one_26(text):
    assert all(recorded(engine, "spinning-rod/ω=100", "stock", "passed").sum() >= 26 for engine in ENGINES)
    assert recorded("pybullet", "spinning-rod/ω=100", "tuned", "passed").sum() == 26
    assert "passes 26 of the 29 balls" in text


def test_engines_that_sweep_pay_in_time():
    late = {engine: 1e3 * recorded(engine, "pellets/v=60,w=12mm", "swept", "late").mean() for engine in ENGINES[:2]}
    assert late == pytest.approx({"pybullet": 0.5, "mujoco": -1.5}, abs=0.05)


def test_swept_balls_in_place_of_the_rod_find_nothing_or_everything(experiments, capsys):
    assert re.findall(r"finds (\d+)", printed(capsys, experiments.what_the_sphere_sees)) == ["0", str(BALLS)]
