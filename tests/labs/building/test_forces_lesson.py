"""What the lesson on forces says in numbers: its experiments, the engines' recordings, and its model answers."""

from __future__ import annotations

import math
import re
import warnings

import numpy as np
import pytest
from made_lessons import experiments_of, printed, text_of

import solutions.forces
from reference.recording.files import content_of
from solutions.forces import spring_step_limit, terminal_velocity, terminal_velocity_corrected

DOWN = np.array([0.0, 0.0, -9.81])


@pytest.fixture(scope="module")
def text():
    return text_of("forces")


@pytest.fixture(scope="module")
def experiments():
    return experiments_of("forces")


def numbers(capsys, experiment):
    """The numbers that an experiment prints."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the solutions warn where Stokes' law ends
        return [float(each) for each in re.findall(r"[-+]?\d+(?:\.\d+)?(?:e[-+]\d+)?", printed(capsys, experiment))]


def test_the_slides_two_numbers_differ_and_all_bodies_fall_alike(experiments, capsys):
    assert numbers(capsys, experiments.on_the_ground) == [1, 9.820, 100, 9.820, 32, 9.754]


def test_ten_revolutions_end_where_the_lesson_says(experiments):
    for step, end, farthest in (("semi_implicit_euler", 1.004, 1.03), ("explicit_euler", 2.43, 3.22)):
        distance = np.linalg.norm(experiments.orbits(getattr(solutions.forces, step)), axis=1)
        assert (round(distance[-1], 3), round(distance.max(), 2)) == pytest.approx((end, farthest), abs=6e-3)
    finer = experiments.orbits(solutions.forces.explicit_euler, 1000)
    assert np.linalg.norm(finer[-1]) == pytest.approx(1.49, abs=5e-3)


def test_a_swing_gains_what_the_factor_says(experiments, capsys, text):
    low, high, end, *semi = numbers(capsys, experiments.one_swing)
    assert (low, high, end) == pytest.approx((1.04, 1.04**31, 1.04**31), abs=6e-3)
    assert semi == pytest.approx([0.91, 1.11, 1.01], abs=6e-3)
    assert "off by up to 11 %" in text


def test_the_printed_spring_doubles_as_its_growth_says(experiments, capsys):
    found = numbers(capsys, experiments.as_printed)
    for c, time in zip(found[::2], found[1::2], strict=True):
        growth = math.sqrt((c / 2) ** 2 + 100) - c / 2
        assert time == pytest.approx(math.log(2) / growth, abs=6e-4)
    assert found[5] / found[1] == pytest.approx(18, abs=0.1)


def test_beyond_its_limit_a_step_throws_the_ball_to_and_fro_and_farther(experiments, capsys):
    found = np.reshape(numbers(capsys, experiments.too_long), (4, 5))
    for dt, *last in found:
        grows = dt > 2 * math.sqrt(2) - 2
        assert grows == (abs(last[-1]) > 0.5)
        assert not grows or (np.diff(np.sign(last)).all() and np.diff(np.abs(last)).min() > 0)


def test_a_damper_shortens_the_step_and_explicit_euler_is_longer_from_058(experiments, capsys, text):
    found = numbers(capsys, experiments.with_a_damper)
    assert found[:15] == [0, 0, 2, 0.1, 0.2, 1.81, 0.5, 1, 1.236, 1, 2, 0.828, 2, 0.536, 0.472]
    below, above = found[17], found[21]
    assert below < 1e-9
    assert above > 1e9
    explicit, semi = spring_step_limit(1.0, 1.0, 2 / math.sqrt(3))
    assert explicit == pytest.approx(semi)
    assert f"beyond ζ = {1 / math.sqrt(3):.2f} explicit" in text


def test_darts_spring_keeps_73_percent_of_a_swing(experiments, capsys):
    found = numbers(capsys, experiments.dart_swings)
    kept = 1.01 ** (-63 / 2)
    assert found[1::2] == pytest.approx([kept, kept**2, kept**3], abs=2e-3)  # largest of seven places
    assert kept == pytest.approx(0.73, abs=2e-3)


def test_a_grain_of_sand_explodes_just_beyond_two_relaxation_times(experiments, capsys):
    found = numbers(capsys, experiments.grain_of_sand)
    speeds = dict(zip(found[::2], found[1::2], strict=True))
    assert [speeds[share] for share in (0.1, 1.5, 1.99)] == pytest.approx([8.992] * 3, abs=1e-3)
    assert min(abs(speeds[2.01]), abs(speeds[2.1])) > 1e8


def test_buoyancy_and_reynolds_as_the_lesson_says(experiments, capsys, text):
    found = numbers(capsys, experiments.in_glycerine)
    assert found[2::3] == pytest.approx([1.193, 32.5, -0.0009533], rel=1e-3)
    for size, speed in ((0.05, 2.205e-3), (0.1, 8.098e-3), (0.2, 2.464e-2), (1.0, 0.1577)):
        true = -terminal_velocity_corrected(5e-4 * size, 2650.0, 1e3, 1e-3, DOWN)[2]
        assert speed == pytest.approx(true, rel=5e-4)
    assert numbers(capsys, experiments.sand)[-2:] == pytest.approx([5.7, 160], rel=0.01)
    assert "five times off at Re = 158" in text


def test_mujocos_box_sinks_29_percent_too_fast(text):
    taken = content_of("mujoco", "sinking-ball")["profiles"]
    place = taken["inertia box"]["quantities"].index("speed")
    box, ellipsoid = (taken[name]["entries"]["m=4.3,η=200"][1][place] for name in ("inertia box", "ellipsoid"))
    assert box / ellipsoid == pytest.approx(math.sqrt(5 / 3), abs=5e-3)
    assert math.sqrt(5 / 3) * 7800 / 6540 == pytest.approx(1.54, abs=2e-3)
    assert "29 % too fast" in text
    assert "54 % too fast" in text


def test_with_the_wind_nothing_pushes_along_it(experiments, capsys):
    capsys.readouterr()
    experiments.table_tennis()
    pushes = re.findall(r"([\d.]+) mN", capsys.readouterr().out)
    assert pushes[1] == "0.0"
    assert float(pushes[2]) > float(pushes[0]) > 20


def test_a_chain_comes_to_rest_in_the_stream(experiments):
    places, *_ = experiments.chain()
    assert np.max(np.abs(places[-1] - places[-100])) < 5e-3
    mass, drag = 5 * 0.5, 5 * 6 * math.pi * 0.06 * 1.5
    away = places[-1, 1] / np.linalg.norm(places[-1, 1])  # the first spring holds all balls below it
    assert away[0] / -away[2] == pytest.approx(drag / (mass * 9.81), rel=0.02)


def test_a_burst_keeps_the_momentum(experiments, capsys):
    momentum, energy = numbers(capsys, experiments.burst)
    assert abs(momentum) < 1e-12  # a thousand roundings of some N s
    assert energy > 10


def test_model_answer_of_the_viscometer():
    speed, radius, g = 0.2 / 8.5, 1.5e-3, 9.81
    viscosity, slide = (2 * excess * radius**2 * g / (9 * speed) for excess in (7800 - 1260, 7800))
    assert (round(viscosity, 2), round(slide, 2)) == (1.36, 1.63)
    assert 2 * radius * 1260 * speed / viscosity == pytest.approx(0.065, abs=1e-3)
    assert terminal_velocity(radius, 7800.0, 1260.0, viscosity, -DOWN)[2] == pytest.approx(speed)
    share = 0.1  # of the tube, by Faxén's series for a ball on its axis
    assert 1 / (1 - 2.104 * share + 2.09 * share**3 - 0.95 * share**5) == pytest.approx(1.26, abs=5e-3)
