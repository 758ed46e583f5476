"""What the lesson on the whole world says in numbers: its experiments, and the recordings of the engines."""

from __future__ import annotations

import re
from types import SimpleNamespace

import numpy as np
import pytest

import solutions.forces
import solutions.impulse
import solutions.world
from labs.building import lessons
from reference.recording.files import content_of

# `make test` has test_detection_lesson of this kind. The lesson stops sweeps early on purpose, and says so
pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("ignore::solutions.world.NotConverged")]

ENGINES = ("pybullet", "mujoco", "dart")


@pytest.fixture(scope="module")
def text():
    """The lesson in one line."""
    return " ".join(" ".join(cell.text for cell in lessons.read("world").cells).split())


@pytest.fixture(scope="module")
def experiments():
    """What the cells of the lesson define, with the solutions for the student's functions. Nothing is shown."""
    lab = SimpleNamespace(show=lambda *_, **__: None, earlier=lambda name: getattr(solutions.forces, name))
    defined = {name: getattr(solutions.world, name) for name in solutions.world.__all__}
    defined |= {"lab": lab, "rotation_matrix": solutions.impulse.rotation_matrix}
    for cell in lessons.read("world").cells:
        if cell.code and not cell.kind and re.search(r"^def |^[A-Z]+ = |^import |^from ", cell.text, re.MULTILINE):
            exec(compile(cell.text, "lesson", "exec"), defined)
    return SimpleNamespace(**defined)


def printed(experiment, capsys):
    experiment()
    return capsys.readouterr().out


def recorded(case, profile, quantity):
    """A quantity of a case in each engine, as it was recorded at the profile's own timestep."""
    family, _, name = case.partition("/")
    taken = [content_of(engine, family)["profiles"][profile] for engine in ENGINES]
    return [each["entries"][name][1][each["quantities"].index(quantity)] for each in taken]


def test_the_friends_satellite_keeps_its_energy_and_turns_its_angular_momentum(experiments, capsys):
    said = printed(experiments.friends_satellite, capsys)
    # Turned by half a turn about ω = (1, 1, 0), L = (1, 2, 0) becomes (2, 1, 0): off by √2/√5.
    assert f"off by up to {100 * np.sqrt(2 / 5):.0f} %" in said
    assert float(re.findall(r"energy is off by up to (\S+) %", said)[0]) < 1e-9


def test_the_students_satellite_keeps_its_angular_momentum_and_gains_energy_with_the_step(experiments, capsys, text):
    said = printed(experiments.your_satellite, capsys)
    gains = [float(each) for each in re.findall(r"energy \+(\S+) %", said)]
    off = [float(each) for each in re.findall(r"L (\S+) off", said)]
    assert max(off) < 1e-10  # rounding, 4000 steps of it
    assert gains[0] / gains[1] == pytest.approx(2, rel=0.05)  # an error of the first order in the step
    assert f"by {gains[1]:.1f} % in 20 s" in text


def test_three_balls_break_the_mirror_and_keep_momentum_and_energy(experiments):
    v, masses = experiments.propagate_impacts([1.0, 0.0, -1.0], [1.0, 3.0, 1.0], 1.0), np.array([1.0, 3.0, 1.0])
    assert v == pytest.approx([-0.5, -0.25, 1.25], abs=1e-12)
    assert masses @ v == pytest.approx(0, abs=1e-12)
    assert masses @ v**2 == pytest.approx(2, rel=1e-12)


def test_a_row_collides_again_after_every_pair_had_its_turn(experiments, capsys):
    rounds = printed(experiments.a_row_of_three, capsys).splitlines()
    assert rounds[0].split(":")[1] != rounds[1].split(":")[1] == rounds[2].split(":")[1]


def test_the_child_lifts_the_right_end_of_the_plank(experiments, capsys):
    said = printed(experiments.a_child_on_a_plank, capsys)
    assert "forces (392.4, 0.0) N: off by 0.00" in said


def test_ten_sweeps_carry_a_third_of_ten_boxes(experiments, capsys):
    said = printed(experiments.ten_boxes, capsys)
    assert "10 sweeps: 35.2 %" in said
    assert "178 sweeps: 99.0 %" in said


def test_warm_sweeps_carry_all_after_twenty_steps(experiments, capsys):
    assert "step 20: 99." in printed(experiments.warm, capsys)


def test_a_light_box_below_a_heavy_one_takes_463_sweeps(experiments, capsys):
    said = printed(experiments.light_and_heavy, capsys)
    needed = np.log(0.01) / np.log(100 / 101)  # each sweep leaves 100/101 of what is missing at the floor
    assert f"{np.ceil(needed):.0f} sweeps" in said
    assert "1 kg on 100 kg: 1 sweeps" in said


def test_a_pushed_ball_rolls_if_the_floor_is_rough_enough(experiments, capsys):
    slips = [float(each) for each in re.findall(r"slip (\S+) m/s", printed(experiments.rolls_or_slips, capsys))]
    assert slips[0] == pytest.approx(0.125, abs=1e-4)  # all of 1/8 N s on 1 kg
    assert slips[1] > 0.1
    assert abs(slips[2]) < 1e-4


def test_twice_the_looks_halve_the_depth_of_one_ball_and_backing_up_leaves_none(experiments, capsys):
    said = printed(experiments.one_ball, capsys)
    rows = re.findall(r"(after the fact|backed up), (\d+) looks: (\d+) mm deep, (\S+) % off", said)
    after, backed = (
        np.array([row[1:] for row in rows if row[0] == name], float) for name in ("after the fact", "backed up")
    )
    # At 4.5 m/s a ball moves so far in a step, and the last of the six heights comes near it.
    assert np.all(after[:, 1] <= 4.6e3 * np.array([0.02, 0.01]))
    assert after[:-1, 1] / after[1:, 1] == pytest.approx([2], rel=0.15)
    assert np.all(backed[:, 0] - after[:, 0] <= 2)
    assert np.all(backed[:, 1] == 0)
    # The apex is looked for once in a step: g Δt²/8 of 1/4 m, in per cent.
    assert np.all(backed[:, 2] <= 0.05 + 100 * 9.81 * np.array([0.02, 0.01]) ** 2 / 8 / 0.25)


def test_to_back_up_has_no_end_where_balls_come_to_rest(experiments):
    counts, _ = experiments.backed_up(0.5, (0.15, 0.3, 0.45), 200, 1 / 240)
    assert len(counts) == 60
    assert counts[-1] == 1500
    assert max(counts[:-1]) < 100
    elastic, _ = experiments.backed_up(1.0, (0.15, 0.3, 0.45), 200, 1 / 240)
    assert len(elastic) == 200  # balls that keep their energy never come to rest


def test_after_the_fact_finishes_and_a_quarter_of_the_step_is_a_quarter_as_deep(experiments, capsys):
    said = printed(experiments.slide_three, capsys)
    first, second = (float(each) for each in re.findall(r"(\S+) mm deep", said))
    assert 2.5 < first / second < 5.5  # the way of a step; where in its step a ball arrives is chance


@pytest.fixture
def filmed(experiments):
    """Runs an experiment; returns the bodies that it films and their states."""
    shown = []
    experiments.run_world.__globals__["film"] = lambda bodies, states, *_, **__: shown.append((bodies, states))
    experiments.run_world.__globals__["display"] = lambda *_: None

    def run(experiment):
        experiment()
        return shown.pop()

    return run


def test_the_jelly_ends_on_one_of_its_faces(experiments, filmed):
    bodies, states = filmed(experiments.a_jelly)
    place, radius, edge = states[-1][0], bodies[6][1, 0], 0.3
    # Four springs of 250 N/m carry the upper half. Put down at once they give way by twice as much as under its weight,
    # and what falls onto the floor is as deep in it at most as it moves in a step, at no more than √(2 g 0.9 m)
    sag = 2 * 4 * 0.25 * 9.81 / (4 * 250)
    deep = np.sqrt(2 * 9.81 * 0.9) / 240
    heights = np.sort(place[1:, 2])
    assert heights[:4] == pytest.approx(radius, abs=deep)
    assert np.all(heights[4:] > radius + edge - sag - deep)
    assert np.all(heights[4:] < radius + edge + sag + deep)


def test_the_heap_comes_to_rest_above_the_floor(experiments, filmed):
    bodies, states = filmed(experiments.the_heap)
    place, _, velocity, _ = states[-1]
    moving = bodies[0] > 0
    lowest = np.where(bodies[5] == experiments.BALL, bodies[6][:, 0], np.min(bodies[6], axis=1))
    deep = np.sqrt(2 * 9.81 * 0.8) / 120  # the way of a step at the speed of the last one to land
    assert np.all(place[moving, 2] > lowest[moving] - deep)
    assert np.max(np.abs(velocity[moving])) < 2 * 9.81 / 120  # what its rules take for rest: two steps' gain of weight


def test_a_cube_of_a_tower_drifts_farthest_in_pybullet():
    drift = recorded("stack/boxes=10", "stock", "drift")
    assert drift[0] == pytest.approx(0.0118, abs=1e-3)
    assert max(drift[1:]) < 1e-6
