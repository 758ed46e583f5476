"""What the lesson on avoidance says in numbers: its experiments, the engines' recordings, and its model answers."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest
from made_lessons import experiments_of, recorded, text_of

import solutions.avoidance
from labs.desk.own_steering import walkers

pytestmark = pytest.mark.slow  # `make test` has test_detection_lesson of this kind

ENGINES = ("pybullet", "mujoco", "dart")


@pytest.fixture(scope="module")
def text():
    return text_of("avoidance")


@pytest.fixture(scope="module")
def experiments():
    return experiments_of("avoidance")


def in_engines(case, profile, quantity):
    """A quantity of a case in each engine."""
    return [recorded(engine, case, profile, quantity).item() for engine in ENGINES]


def test_the_copied_line_leads_away_from_the_target(experiments):
    places = experiments.fly(experiments.as_copied, (3.0, 4.0), (0.0, 0.0))
    # v = 1 − exp(−t/τ) from rest with τ = 0.2 s: in 2 s it goes 1.800 m; steps of 10 ms are off by some 10 ms · 1 m/s
    assert np.linalg.norm(places[-1]) == pytest.approx(6.8, abs=0.02)


def test_bodies_from_three_sides_come_nearer(experiments, capsys):
    experiments.from_three_sides()
    ends = np.array(re.findall(r"ends at \((\S+), (\S+)\) m", capsys.readouterr().out), dtype=float)
    starts = np.array([(4.0, 1.0), (-3.0, 3.0), (-2.0, -3.0)])
    assert len(ends) == 3  # of the picture's text, which is printed where nothing shows pictures
    assert np.all(np.linalg.norm(ends, axis=1) < np.linalg.norm(starts, axis=1))


def test_one_that_slows_from_half_the_radius_needed_runs_six_centimetres_past(experiments):
    assert 1e3 * experiments.past_the_target(1.0) == pytest.approx(65, abs=1)
    assert experiments.past_the_target(2.0) == 0.0  # R = 4 v τ
    assert 20 < 1e3 * experiments.past_the_target(1.3) < 40


def test_a_body_with_a_lag_needs_three_quarters_of_the_force_of_one_without(experiments, text):
    force, v, tau = 1.0 * 2.0**2 / 2.0, 2.0, 0.25  # m v²/R
    for share, past in ((1.0, 0), (0.75, 0), (0.5, 153)):
        assert 1e3 * experiments.past_the_target(2.0, most=share * force) == pytest.approx(past, abs=1)
    places = experiments.fly(lambda p: solutions.avoidance.arrive(p, 0 * p, v, 2.0), [-4.0], [v], tau, 6.0, 1e-3)
    most = np.abs(np.diff(places[:, 0], 2)).max() / 1e-6
    assert most / force == pytest.approx(2 / math.e, abs=0.002)  # steps of 1 ms of some 0.5 s
    assert "2/e of yours, which is 74 %" in text


def test_beside_a_wall_a_body_rests_where_the_field_carries_its_pull(experiments, text):
    seek = experiments.beside_a_wall(lambda p, goal: solutions.avoidance.seek(p, goal, 1.0))[-1][1]
    arrive = experiments.beside_a_wall(lambda p, goal: solutions.avoidance.arrive(p, goal, 1.0, 2.0))[-1][1]
    assert seek == pytest.approx(1 - math.sqrt(2 / 8), abs=1e-4)
    assert 8 * (1 - arrive) ** 2 == pytest.approx(arrive - 0.2, abs=1e-4)  # of the model answer
    assert "follows s = 0.74 m" in text
    weaker = min(np.roots([0.8, -2.6, 1.0]))  # 0.8 (1 − s)² = s − 0.2
    assert f"s is still {weaker:.2f} m" in text
    for strength in (8.0, 0.8):
        assert f"{math.sqrt(2 * strength / 3):.2g} m/s" in text  # ½ m v² = F₀R/3
    assert experiments.thrown_at_a_wall(2.3) > 0.0 == experiments.thrown_at_a_wall(2.32)


def test_two_streams_that_heed_nobody_overlap_by_44_centimetres(text):
    found = in_engines("crossing-streams/θ=70°,straight on", "tuned", "overlap")
    assert found == pytest.approx([0.444921] * 3, abs=1e-6)
    assert "overlap by 0.44 m" in text
    both = walkers("crossing-streams/θ=70°,straight on")
    i, j = np.triu_indices(len(both.radii), 1)
    given = (each[k] for k in (i, j) for each in (both.positions, both.velocities))
    _, gap = solutions.avoidance.nearest_approach(*given, both.radii[i], both.radii[j])
    assert -gap.min() == pytest.approx(found[0], abs=1e-9)


def test_off_the_line_a_thousandth_costs_nine_seconds(experiments, text):
    times = [experiments.past_posts((-6.0, aside), [(0.0, 0.0)]) for aside in (1e-9, 1e-6)]
    assert times[0] == pytest.approx(33.5, abs=0.5)
    assert times[0] - times[1] == pytest.approx(9.0, abs=0.1)
    growth = -1 + math.sqrt(1 + 4 * (1 / 1.5 - 1 / 7.5))  # of λ² + 2λ = 4 (1/1.5 − 1/7.5)
    assert math.log(1000) / growth == pytest.approx(times[0] - times[1], abs=0.1)
    assert "λ = −1 + √3.133 = 0.770" in text


@pytest.mark.parametrize(("gap", "passes"), [(1.5, False), (2.0, True)])
def test_two_posts_hold_up_a_flier_that_would_fit_through(experiments, gap, passes):
    y = 0.5 + gap / 2
    time = experiments.past_posts((-6.0, 0.01), [(0.0, y), (0.0, -y)], duration=8)
    assert math.isfinite(time) == passes


def test_the_way_around_is_hardly_longer(experiments, capsys, text):
    experiments.length_of_the_way()
    exact = 2 * math.sqrt(35) + 2 * math.asin(1 / 6)  # two tangents and the arc between them
    assert f"{exact:.3f} m for 12 m, 1.4 % more" in capsys.readouterr().out


def test_around_where_the_ball_is_a_flier_is_carried_along(experiments):
    places, _ = experiments.across(experiments.where_it_is)
    assert places[-1][1] == pytest.approx(8.5, abs=0.1)
    places, gap = experiments.across(experiments.where_it_will_be)
    assert places[-1] == pytest.approx([6, 0, 0], abs=0.05)
    assert gap > 0.2


def test_all_three_rules_make_several_flocks_and_two_make_them_coincide(experiments):
    whole = experiments.settle(1, (0.15, 1.0, 0.8))
    assert experiments.flocks_of(whole) == 5
    assert experiments.nearest_two(whole) > 0.5
    assert experiments.nearest_two(experiments.settle(1, (0.0, 1.0, 0.8))) < 1e-5


def test_a_weak_separation_lets_boids_overlap_and_a_strong_one_does_not():
    assert in_engines("flock-past-pillar/w=0.1", "tuned", "overlap") == pytest.approx([0.065] * 3, abs=1e-4)
    assert in_engines("flock-past-pillar/w=0.4", "tuned", "overlap") == [0, 0, 0]


def test_two_who_both_make_everything_sway_and_two_halves_do_not(experiments):
    _, gap, sways = experiments.corridor((1, 1), 0.2)
    assert sways == 40
    assert gap < -0.01
    for share in ((0.5, 0.5), (0.5, 0)):
        _, gap, sways = experiments.corridor(share, 0.2)
        assert sways <= 2
        assert gap > -1e-9  # rounding of metres


def test_exactly_head_on_two_walkers_stop_and_a_micrometre_frees_them(experiments):
    assert experiments.corridor((0.5, 0.5), 0.0)[0] >= 14
    assert experiments.corridor((0.5, 0.5), 1e-6)[0] == pytest.approx(10.0, abs=0.1)


def test_damped_walkers_arrive_earlier():
    tuned, stock = (in_engines("crossing-streams/θ=70°", profile, "arrival") for profile in ("tuned", "stock"))
    assert tuned == pytest.approx([tuned[0]] * 3, abs=1e-9)
    assert tuned[0] - stock[0] == pytest.approx(0.9, abs=0.02)


def test_a_lag_breaks_the_promise_and_a_longer_horizon_mends_most_of_it(experiments):
    near, far = (1e3 * experiments.ring(0.8, horizon) for horizon in (1.0, 3.0))
    assert near < -50
    assert -10 < far < 0
