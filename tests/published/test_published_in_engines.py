"""Published cases in the engines: what comes out as published, what does not, and that the reasons given are right."""

from __future__ import annotations

import functools
import math
from dataclasses import replace

import live
import numpy as np
import pytest

from reference import truth
from reference.catalogue import measure
from reference.comparison.verdicts import Verdict
from reference.engines import load_engine, pybullet_settings
from reference.engines.base import AT_STEP, Method
from reference.published.case import Published
from reference.published.drivers import DRIVERS
from reference.published.in_engines import bouncing, loaded, scenes, springs
from reference.published.in_engines.at_step import Bounce, apexes_off, stepped, times_off
from reference.published.judging import compare_published
from reference.published.results import PublishedJob, PublishedRow
from reference.published.theirs import published, published_cases
from reference.scene.query import Distance
from reference.scene.scenario import Body, Box, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

ENGINES = ("pybullet", "mujoco", "dart")
SLOW = ("P1", "P2")
each_engine = pytest.mark.parametrize("name", ENGINES)
FAST = {
    "pybullet": ("P3", "P5", "P12", "P13", "P18", "P28", "P39"),
    "mujoco": ("P6", "P12", "P15", "P22", "P27", "P37"),
    "dart": ("P10", "P12", "P19", "P25", "P31"),
}
"""What the fast suite runs: some cases in each engine. `make verify` runs every case in each."""
DEVIATES = {
    "P3": {("position", 2), ("position", 3), ("velocity", 1), ("velocity", 2)},
    "P4": {("position", 0), ("velocity", 0), ("spin", 0)},
    "P11": {
        ("tangent_restitution", 1),
        ("tangent_restitution", 2),
        ("tangent_restitution", 3),
        ("spin", 1),
        ("spin", 2),
    },
    "P12": {("height", 0), ("velocity", 0)},
    "P16": {("turning_point", 0), ("fall", 0), ("sticks_at", 0)},
    "P39": {(when, place) for when in ("after_a_third", "after_a_period") for place in range(1, 7)},
}
"""The known deviations, by figure and place: a contact that never pulls, friction that acts from the first step on, a
real contact that yields sideways, an answer that comes when bodies touch, and steps of first order (P16 and P39)."""
DISAGREES = {("dart", "P12"): {("velocity", 0)}}
"""The deviations as large as the figure itself: after 1000 steps DART's ball is at another place of its bounce."""
ALONE = {("P3", "pybullet"): {("position", 1)}, ("P30", "pybullet"): {("meets_at", 0)}}
"""What deviates in one engine alone: steps of first order fall g t dt/2 too far; Bullet rounds the corners of a box."""
UNASKED = {
    "P19": {("time_of_impact", 0)},
    "P21": {("net_force", 0), ("contact_force", 0)},
    "P25": {("speed", 0)},
    "P41": {(name, 0) for name in ("floor_normal", "wall", "friction", "floor", "direction", "coefficient")},
    "P31": {("point_triangle", 0), ("edge_edge", 0), ("in_one_plane", 1), ("in_one_plane", 2)},
}


def rows(case: Published, engine: str) -> tuple[PublishedRow, ...]:
    found, _ = compare_published(case, load_engine(engine))
    return found


@functools.cache
def rows_of(name: str, engine: str) -> tuple[PublishedRow, ...]:
    """Those of a case as it stands in the catalogue: from the live runs of `make verify`, or else run here."""
    made = live.kept(PublishedJob(name, engine))
    return made.rows if made else rows(published(name), engine)


def with_verdict(found: tuple[PublishedRow, ...], verdict: Verdict) -> set[tuple[str, int]]:
    return {(row.figure, row.place) for row in found if row.verdict is verdict}


def run_by(engine: str) -> list[Published]:
    """The cases that an engine runs, except for those that take long."""
    return [
        case
        for name, case in published_cases().items()
        if DRIVERS[name].in_engines and engine not in DRIVERS[name].why_not_in and name not in SLOW
    ]


def in_engines(*cases: str) -> pytest.MarkDecorator:
    """Each engine with each of the cases that it runs, slow where the fast suite runs them in another engine."""
    pairs = [(name, case.name) for name in ENGINES for case in run_by(name) if case.name in cases]
    marks = [() if case in FAST[name] else (pytest.mark.slow,) for name, case in pairs]
    return pytest.mark.parametrize(
        ("name", "case"), [pytest.param(*pair, marks=mark) for pair, mark in zip(pairs, marks, strict=True)]
    )


@in_engines(*published_cases())
def test_an_engine_gives_the_published_numbers_or_differs_as_predicted(name, case, installed):
    installed(name)
    found = rows_of(case, name)
    assert [row for row in found if row.verdict in (Verdict.FAIL, Verdict.CRASHED)] == []
    disagrees = with_verdict(found, Verdict.DISAGREES)
    assert disagrees == DISAGREES.get((name, case), set())
    deviates = DEVIATES.get(case, set()) | ALONE.get((case, name), set())
    assert with_verdict(found, Verdict.KNOWN_DEVIATION) | disagrees == deviates
    assert with_verdict(found, Verdict.CANNOT_EXPRESS) == UNASKED.get(case, set())


@each_engine
def test_a_case_that_an_engine_cannot_run_is_one_row_with_the_reason(name, installed):
    installed(name)
    refused = [case for case in published_cases().values() if case not in run_by(name) and case.name not in SLOW]
    assert len(refused) == {"pybullet": 8, "mujoco": 8, "dart": 11}[name]
    for case in refused:
        (row,) = rows_of(case.name, name)
        lacking = case.name == "P35"  # the rest of a cable
        assert (row.verdict, row.figure) == (Verdict.NO_WORDS if lacking else Verdict.CANNOT_EXPRESS, "")
        assert len(row.note.split()) > 4


@pytest.mark.slow
@each_engine
def test_a_plate_is_pushed_from_under_balls_as_published(name, installed):
    installed(name)
    found = rows_of("P2", name)
    asked = [row for row in found if row.figure != "square_cone_error"]
    assert [row.verdict for row in asked] == 4 * [Verdict.PASS]
    # A square cone, DART's default and Bullet's other one, holds the plate: the score is that of doing nothing.
    square = Verdict.CANNOT_EXPRESS if name == "mujoco" else Verdict.PASS
    assert found[-1].verdict is square


# The step that answers an impact


def coarse(timesteps: tuple[float, ...]) -> Published:
    """P1 at its longest timesteps only."""
    case, count = published("P1"), len(timesteps)
    expected, tolerance = (
        {column: values[:count] for column, values in figures.items()} for figures in (case.expected, case.tolerance)
    )
    setup = {**case.setup, "timesteps": timesteps}
    return replace(case, setup=setup, expected=expected, tolerance=tolerance)


def energies_as_published(case: Published, found: tuple[PublishedRow, ...], name: str) -> None:
    count = len(case.expected["ode"])
    column = {"mujoco": "ode", "dart": "bullet"}.get(name)
    if column is None:  # PyBullet: both columns, to the last digit printed
        assert with_verdict(found, Verdict.PASS) == {
            (which, place + 1) for which in case.expected for place in range(count)
        }
    else:  # and what is known to be a little else in the two others, to a thousandth of that
        assert with_verdict(found, Verdict.KNOWN_DEVIATION) == {(column, place + 1) for place in range(count)}


@each_engine
def test_an_elastic_impact_at_the_step_makes_the_published_energy(name, installed):
    installed(name)
    energies_as_published(coarse((1e-2,)), rows(coarse((1e-2,)), name), name)


@pytest.mark.slow
@each_engine
def test_it_makes_the_published_energy_at_every_timestep(name, installed):
    installed(name)
    energies_as_published(published("P1"), rows_of("P1", name), name)


def test_bullets_own_multibody_is_far_from_the_numbers_published_for_it(installed):
    # Contacts form ahead of the touch, overlap comes back as speed, and every velocity is damped.
    engine, case = installed("pybullet"), published("P1")
    scenario = scenes.ball_over_floor(case, 4.9, 20.0, 1.0, 0.1, 10.0)
    energy = {}
    for options in ({"coordinates": "multibody"}, bouncing.MULTIBODY):
        trajectory = engine.run(scenario, Settings(1e-2, options=options))
        energy[len(options)] = measure.energy(trajectory, "ball")
    drift = {count: np.mean((49 * (values - values[0])[:-1]) ** 2) for count, values in energy.items()}
    assert drift[5] == pytest.approx(case.expected["bullet"][0], abs=5.0)
    assert drift[1] > 20 * drift[5]


@in_engines("P7")
def test_a_box_stops_half_a_step_short_of_the_published_way(name, case, installed):
    installed(name)
    setup = published(case)
    short = truth.semi_implicit_stopping_shift(setup.value("speed"), setup.value("timestep"))
    # To 10 µm, half of the last digit printed twice over: friction stops the box within one of its steps, of 1.1 mm at
    # first and none at last, and MuJoCo's needs a few more for the last micrometres.
    assert [row.difference for row in rows_of(case, name)] == pytest.approx(3 * [short], abs=1e-5)


@in_engines("P4")
def test_a_sphere_differs_from_lammps_own_steps_by_the_stated_half_step(name, case, installed, judged):
    installed(name)
    lammps = judged(case)  # its own loop, with all digits
    for theirs, found in zip(lammps[:3], rows_of(case, name)[:3], strict=True):
        assert found.shift != 0
        # DART's solver is iterated: 2e-9 after 5000 steps
        assert found.measured - theirs.measured == pytest.approx(found.shift, abs=1e-8)


def test_bullets_distance_is_that_of_a_box_rounded_by_its_margin(installed):
    bullet, half, radius, margin = installed("pybullet"), np.array([0.3, 0.5, 0.7]), 0.2, pybullet_settings.MARGIN
    box, found, rounded = Body("box", Box(tuple(half))), [], []
    for place in ((0.9, 1.1, 1.0), (0.2, 1.4, 1.2), (0.1, 0.2, 1.5)):  # near a corner, an edge and a face
        ball = Body("ball", Sphere(radius), position=place)
        found.append(bullet.query(Distance(ball, box)))
        core = np.clip(place, margin - half, half - margin)
        rounded.append(np.linalg.norm(place - core) - margin - radius)
    # Bullet stops its iteration at a relative 1e-6 of the square of the distance
    assert found == pytest.approx(rounded, abs=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "larger"),
    [
        # Bullet keeps the corners of a box in a step of 2 % of half its diagonal: 0.10 m, and 0.41 m of the larger one.
        ("pybullet", (20.0, 4.0, 0.001)),
        # In MuJoCo a slab on two of its corners falls by 3/4 g dt² in a step, 3 mm: its middle must not get below the
        # plane. The half height is 1 mm here, and 10 mm of the larger one.
        ("mujoco", (5.0, 1.0, 0.01)),
    ],
)
def test_at_20_ms_a_larger_slab_swings_as_predicted_and_that_of_p16_does_not(name, larger, installed, monkeypatch):
    engine, case = installed(name), published("P16")
    monkeypatch.setattr(loaded, "SWING_STEP", 0.02)

    def off() -> list[float]:
        found = loaded.dry_oscillator(case, engine)
        expected = {figure: case.expected_value(figure) + answer.shift for figure, answer in found.items()}
        return [abs(answer.value - expected[figure]) / answer.shift_tolerance for figure, answer in found.items()]

    assert max(off()) > 10
    monkeypatch.setattr(loaded, "SLAB", larger)
    assert max(off()) < 1


def by_steps(bounce: Bounce, weighed: float, duration: float) -> Trajectory:
    """A bounce by the loop of three lines, as a trajectory that can be measured like any other."""
    e, fall = bounce.restitution, bounce.gravity * bounce.timestep
    states = np.array(stepped(bounce, lambda v: -e * (v - weighed * fall), round(duration / bounce.timestep)))
    scenario = scenes.ball_over_floor(published("P15"), bounce.drop, duration, e)
    count = len(states)
    places, velocities = np.zeros((count, 2, 3)), np.zeros((count, 2, 3))
    places[:, 1, 2], velocities[:, 1, 2] = states[:, 0] + 0.1, states[:, 1]
    upright = np.broadcast_to([1.0, 0.0, 0.0, 0.0], (count, 2, 4))
    times = bounce.timestep * np.arange(count)
    return Trajectory(scenario, Settings(bounce.timestep), "loop", times, places, upright, velocities, 0 * places)


@pytest.mark.parametrize("weighed", [0.0, 1.0])
@pytest.mark.parametrize("e", [0.5, 0.9])
def test_the_bound_on_what_a_step_does_to_a_bounce_is_reached_not_passed(e, weighed):
    """Over drops that meet the floor at all phases of a step, three flights each."""
    g, dt, most = 9.81, 1e-3, np.zeros((2, 3))
    method = Method(AT_STEP, weighed=weighed)
    for phase in range(53):
        drop = g * (0.45 + phase / 53 * dt) ** 2 / 2
        bounce = Bounce(drop, e, g, dt)
        instants = truth.bounce_times(drop, e, g, 4)
        trajectory = by_steps(bounce, weighed, float(instants[-1]))
        heights = measure.apex_heights(trajectory, "ball", "floor")[:3]
        off = np.abs(heights - drop * e ** (2 * np.arange(1, 4))) / apexes_off(bounce, method, 3)
        late = np.abs(measure.impact_times(trajectory, "ball", "floor")[:3] - instants[:3]) / times_off(
            bounce, method, 3
        )
        most = np.maximum(most, [off, late])
    assert np.all(most <= 1)
    # Of 53 phases one is near the worst for the first apex; the first instant is dt/2 early at any phase.
    assert most[0, 0] > 0.95
    assert most[1, 0] > 0.99
    assert np.all(most > 0.7)  # extremes of later impacts do not all fall together


def test_without_gravity_a_contact_ends_at_the_speed_and_depth_of_theory():
    for ratio in (0.02, 0.3, 0.8):
        _, gap, speed = springs._let_go(2.5, 4e4, ratio, 0.0)
        assert speed == pytest.approx(2.5 * truth.spring_dashpot_restitution(ratio), rel=1e-12)
        assert gap == pytest.approx(-truth.spring_dashpot_exit_depth(ratio, 2.5, 4e4), rel=1e-10)


def test_with_gravity_an_undamped_contact_returns_the_approach_speed():
    time, gap, speed = springs._let_go(2.5, 4e4, 0.0, 9.81)
    assert (gap, speed) == pytest.approx((0.0, 2.5), abs=1e-12)
    # Half a swing about the depth of rest g/k, and twice the arc from there to the surface.
    assert time == pytest.approx((math.pi + 2 * math.atan(9.81 / (2.5 * 200))) / 200, rel=1e-12)
