"""What every engine promises, whatever it is and whatever it runs: one suite over engines × scenarios × profiles."""

from __future__ import annotations

import functools
import math
import pickle
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest

from reference import geometry, measure
from reference.engines import Engine, engine_names, load_engine
from reference.engines.base import AT_STEP, COMPLIANT, EXACT, INTERPOLATED
from reference.errors import CannotExpress, InvalidInput, NeedsFunction, UnknownName
from reference.scenario import GRAVITY, Body, Box, Force, HalfSpace, Pair, Scenario, Sphere
from reference.scenarios import catalogue
from reference.settings import Settings
from reference.trajectory import Trajectory

TOY = str(Path(__file__).with_name("toy_engine.py"))
ENGINES = (*engine_names(), TOY)
REPORT_CONTACTS = ("pybullet", "mujoco", "dart")
DURATION = 0.6  # s: a ball let go 1 m above the floor falls for 0.45 s and rebounds
ROUNDING = 1e-14  # a frame changed twice costs a few times 2e-16 of a spin of some rad/s
DAMPING = 0.04  # 1/s, Bullet's default
FLOOR = Body("floor", HalfSpace())
HALF_TURN = math.sqrt(0.5)


def thrown(name: str, shape: Sphere | Box, orientation=(1, 0, 0, 0), spin=(0, 0, 0)) -> Scenario:
    """A body thrown so high above the floor that it meets nothing."""
    body = Body("thrown", shape, 2.0, (1, 2, 50), orientation, (3, -2, 4), spin)
    return Scenario(name, (FLOOR, body), (Pair("thrown", "floor", restitution=0.5),), DURATION)


def lying_box() -> Scenario:
    """A box that lies on its end, its own x axis up, and turned by 30° about the vertical."""
    on_end, about_z = (HALF_TURN, 0, -HALF_TURN, 0), (math.cos(math.pi / 12), 0, 0, math.sin(math.pi / 12))
    box = Body("box", Box((0.1, 0.2, 0.3)), 1.5, (0.3, -0.4, 0.1), product(about_z, on_end))
    return Scenario("lying-box", (FLOOR, box), (Pair("floor", "box", kinetic_friction=0.5),), DURATION)


def product(left, right) -> tuple[float, float, float, float]:
    """Hamilton product: the turn `right`, then the turn `left`."""
    a, b, c, d = left
    e, f, g, h = right
    return (
        a * e - b * f - c * g - d * h,
        a * f + b * e + c * h - d * g,
        a * g - b * h + c * e + d * f,
        a * h + b * g - c * f + d * e,
    )


TURNED = (0.4, -0.2, 0.8, 0.4)  # a unit quaternion: 0.16 + 0.04 + 0.64 + 0.16 = 1
OWN_Z = tuple(geometry.rotate(np.array(TURNED), np.array([0.0, 0.0, 1.0])))  # a principal axis: it spins steadily
EXTRA = (
    thrown("thrown-ball", Sphere(0.1)),
    thrown("twirled-ball", Sphere(0.1), TURNED, (1.0, -2.0, 3.0)),
    thrown("twirled-box", Box((0.1, 0.2, 0.3)), TURNED, tuple(5.0 * part for part in OWN_Z)),
    lying_box(),
)
CATALOGUE = tuple(
    replace(family.case(family.curve.case).scenarios[0], name=family.name, duration=DURATION)
    for family in catalogue().values()
)
SCENARIOS = {scenario.name: scenario for scenario in (*CATALOGUE, *EXTRA)}
NEEDS_A_WORLD = (
    *("corner", "two-walls", "sliding-ball", "rolling-ball"),
    *("box-flat", "box-on-edge", "tipping-box", "stack", "twirled-box"),
)
"""What rolls, tumbles or meets more than one thing."""
STRIKING = ("thin-wall", "spinning-ball", "two-balls", "struck-rod", "rod-on-peg", "cradle", "parting-ball")
"""What strikes another body, or spins as it strikes."""
SAYS_NO = {
    "handwritten": dict.fromkeys(NEEDS_A_WORLD, (NeedsFunction, r"^needs a rigid-body world \(world\)$")),
    TOY: dict.fromkeys(
        (*NEEDS_A_WORLD, *STRIKING, "sliding-slab", "incline", "lying-box", "twirled-ball"),
        (
            CannotExpress,
            r"^a toy cannot express \S+: it knows one ball over one plane, without friction and without spin$",
        ),
    ),
}
"""What an engine has no words for, the error that says so, and its words. Everything else it must run."""


@dataclass(frozen=True)
class Cell:
    """One run of the grid."""

    engine: str
    scenario: str
    profile: str

    def __str__(self) -> str:
        return f"{Path(self.engine).stem}-{self.scenario}-{self.profile}"


def profiles(engine: str, scenario: str) -> list[str]:
    return list(load_engine(engine).profiles(SCENARIOS[scenario]))


CELLS = [
    Cell(engine, scenario, profile)
    for engine in ENGINES
    for scenario in SCENARIOS
    if scenario not in SAYS_NO.get(engine, {})
    for profile in profiles(engine, scenario)
]
KINDS = [Cell(engine, scenario, "") for engine in ENGINES for scenario in SCENARIOS]
REFUSED = [
    Cell(engine, scenario, profile)
    for engine, names in SAYS_NO.items()
    for scenario in names
    for profile in profiles(engine, scenario)
]
every_cell = pytest.mark.parametrize("cell", CELLS, ids=str)
each_engine = pytest.mark.parametrize("name", ENGINES, ids=lambda name: Path(name).stem)


def cells_of(*scenarios: str):
    return pytest.mark.parametrize("cell", [cell for cell in CELLS if cell.scenario in scenarios], ids=str)


def flies_exactly(cell: Cell) -> bool:
    """Whether this profile solves for free flight, or integrates it to fourth order."""
    return (cell.engine, cell.profile) in (("handwritten", "tuned"), ("handwritten", "slide"), ("mujoco", "spring"))


def is_damped(cell: Cell) -> bool:
    """Whether this profile leaves Bullet's drag on, which brakes v and ω by 0.04 (1 + v) v a second."""
    return (cell.engine, cell.profile) == ("pybullet", "stock")


def setup(cell: Cell) -> tuple[Engine, Scenario, Settings]:
    engine, scenario = load_engine(cell.engine), SCENARIOS[cell.scenario]
    return engine, scenario, engine.settings(scenario, cell.profile)


@functools.cache
def run(cell: Cell) -> Trajectory:
    engine, scenario, settings = setup(cell)
    return engine.run(scenario, settings)


@pytest.fixture
def trajectory(cell: Cell, installed) -> Trajectory:
    installed(cell.engine)
    return run(cell)


def arrays(trajectory: Trajectory) -> list[np.ndarray]:
    names = ("times", "positions", "orientations", "velocities", "angular_velocities")
    return [getattr(trajectory, name) for name in names]


def same(one: Trajectory, other: Trajectory) -> bool:
    return all(np.array_equal(a, b) for a, b in zip(arrays(one), arrays(other), strict=True))


# What a trajectory is


@every_cell
def test_a_trajectory_starts_at_time_zero_with_exactly_the_scenarios_own_state(cell, trajectory):
    bodies = SCENARIOS[cell.scenario].bodies
    assert trajectory.times[0] == 0
    assert np.array_equal(trajectory.positions[0], [body.position for body in bodies])
    assert np.array_equal(trajectory.velocities[0], [body.velocity for body in bodies])
    np.testing.assert_allclose(trajectory.orientations[0], [body.orientation for body in bodies], atol=ROUNDING)
    np.testing.assert_allclose(
        trajectory.angular_velocities[0], [body.angular_velocity for body in bodies], atol=ROUNDING
    )


@every_cell
def test_samples_come_every_so_many_steps_and_the_last_one_when_the_scenario_ends(cell, trajectory):
    _, scenario, settings = setup(cell)
    interval = settings.timestep * settings.sample_every
    np.testing.assert_allclose(trajectory.times, interval * np.arange(len(trajectory.times)), rtol=1e-12)
    tiny = 1e-9 * interval  # 0.6 s are 144 steps of 1/240 s only up to rounding
    assert scenario.duration - tiny <= trajectory.times[-1] < scenario.duration + interval - tiny


@every_cell
def test_a_trajectory_is_finite_and_its_quaternions_have_unit_length(cell, trajectory):
    assert all(np.isfinite(values).all() for values in arrays(trajectory))
    # Engines normalise at every step; the lab's own code never changes an orientation.
    np.testing.assert_allclose(np.linalg.norm(trajectory.orientations, axis=-1), 1, atol=1e-12)


@every_cell
def test_a_trajectory_says_what_it_came_from(cell, trajectory):
    engine, scenario, settings = setup(cell)
    assert (trajectory.engine, trajectory.scenario, trajectory.settings) == (engine.name, scenario, settings)


@every_cell
def test_the_same_run_gives_the_same_numbers_and_leaves_scenario_and_settings_alone(cell, trajectory):
    engine, scenario, settings = setup(cell)
    before = pickle.dumps((scenario, settings))
    again = engine.run(scenario, settings)
    assert pickle.dumps((scenario, settings)) == before
    assert same(again, trajectory)


@cells_of(*(name for name, scenario in SCENARIOS.items() if any(body.immovable for body in scenario.bodies)))
def test_what_is_immovable_does_not_move(cell, trajectory):
    fixed = [place for place, body in enumerate(SCENARIOS[cell.scenario].bodies) if body.immovable]
    for values in (trajectory.positions, trajectory.orientations):
        assert np.array_equal(values[:, fixed], np.broadcast_to(values[:1, fixed], values[:, fixed].shape))
    assert not trajectory.velocities[:, fixed].any()
    assert not trajectory.angular_velocities[:, fixed].any()


@cells_of("thrown-ball")
def test_many_scenarios_at_once_give_what_each_gives_alone(cell, installed):
    engine = installed(cell.engine)
    first = SCENARIOS["dropped-ball"]
    ball = replace(first.body("ball"), position=(0.0, 0.0, 0.4))
    lower = replace(first, bodies=tuple(ball if body.name == "ball" else body for body in first.bodies), duration=0.35)
    settings = engine.settings(first, cell.profile)
    together = engine.run_many([first, lower, first], settings)
    assert all(
        same(one, engine.run(scenario, settings)) for one, scenario in zip(together, (first, lower, first), strict=True)
    )


# Contacts


with_contacts = pytest.mark.parametrize("cell", [cell for cell in CELLS if cell.engine in REPORT_CONTACTS], ids=str)
RESTING = ("sliding-slab", "incline", "lying-box", "stack")
CHECKED = 60
"""Samples of a trajectory at which the gap between two boxes is worked out; that of a plane is, at all."""


def pairs_in_contact(trajectory: Trajectory) -> list[tuple[int, int, np.ndarray]]:
    """Bodies A and B, by place, that touched at some sample, and which of the contacts are theirs."""
    contacts = trajectory.contacts
    found = sorted({(int(a), int(b)) for a, b in zip(contacts.body_a, contacts.body_b, strict=True)})
    return [(a, b, (contacts.body_a == a) & (contacts.body_b == b)) for a, b in found]


def placed(trajectory: Trajectory, place: int, sample: int) -> Body:
    """A body as it is at a sample."""
    position, orientation = trajectory.positions[sample, place], trajectory.orientations[sample, place]
    return replace(
        trajectory.scenario.bodies[place], position=tuple(position), orientation=tuple(orientation), velocity=(0, 0, 0)
    )


def surface_speed(trajectory: Trajectory, place: int) -> np.ndarray:
    """More than the speed of any point of a body at each sample: that of its centre, and of its farthest corner."""
    shape = trajectory.scenario.bodies[place].shape
    extent = shape.radius if isinstance(shape, Sphere) else np.linalg.norm(getattr(shape, "half_extents", 0.0))
    speed = np.linalg.norm(trajectory.velocities[:, place], axis=1)
    return speed + extent * np.linalg.norm(trajectory.angular_velocities[:, place], axis=1)


def travel(trajectory: Trajectory, a: int, b: int, sample: int) -> float:
    """How far two surfaces may have come towards each other in the step before a sample, m."""
    settings = trajectory.settings
    speeds = surface_speed(trajectory, a) + surface_speed(trajectory, b)
    gained = GRAVITY * settings.timestep * settings.sample_every
    return float(max(speeds[sample - 1], speeds[sample]) + gained) * settings.timestep


@with_contacts
def test_contacts_name_listed_bodies_and_their_unit_normal_points_from_b_to_a(cell, trajectory):
    scenario, contacts = SCENARIOS[cell.scenario], trajectory.contacts
    bodies = scenario.bodies
    listed = {frozenset((pair.body_a, pair.body_b)) for pair in scenario.pairs}
    if cell.scenario in RESTING:
        assert len(contacts.sample) >= len(trajectory.times) - 1, "a box on a plane has a contact at every sample"
    np.testing.assert_allclose(np.linalg.norm(contacts.normal, axis=1), 1, atol=1e-12)
    for a, b, here in pairs_in_contact(trajectory):
        assert {bodies[a].name, bodies[b].name} in listed
        for plane, sense in ((b, 1), (a, -1)):
            if isinstance(bodies[plane].shape, HalfSpace):  # nothing but rounding
                expected = np.broadcast_to(sense * np.array(bodies[plane].shape.normal), (here.sum(), 3))
                np.testing.assert_allclose(contacts.normal[here], expected, atol=1e-12)
        for sample, normal in zip(contacts.sample[here], contacts.normal[here], strict=True):
            # Of two convex bodies, one lies on the normal's side of the other; a fast one passes in a step.
            across = (trajectory.positions[sample, a] - trajectory.positions[sample, b]) @ normal
            assert across > -travel(trajectory, a, b, sample) or isinstance(bodies[a].shape, HalfSpace)


@with_contacts
def test_the_separation_of_a_contact_is_the_gap_of_the_step_that_it_was_found_in(cell, trajectory):
    scenario, contacts = SCENARIOS[cell.scenario], trajectory.contacts
    for a, b, here in pairs_in_contact(trajectory):
        samples = np.unique(contacts.sample[here])
        for sample in samples[:: max(1, len(samples) // CHECKED)]:
            now = here & (contacts.sample == sample)
            gap = geometry.gap(placed(trajectory, a, sample), placed(trajectory, b, sample))
            # A contact is found before its step moves the bodies; no point of them is faster than at the samples
            # around it. 1 µm: a box that rocks, seen at its corners.
            near = travel(trajectory, a, b, sample) + 1e-6
            assert contacts.separation[now].min() == pytest.approx(gap, abs=near)
            for place in (a, b):
                if isinstance(ball := scenario.bodies[place].shape, Sphere):  # midway: half the gap off its surface
                    off = np.linalg.norm(contacts.position[now] - trajectory.positions[sample, place], axis=1)
                    np.testing.assert_allclose(off, ball.radius + contacts.separation[now] / 2, atol=near)
        for plane in (a, b):
            if isinstance(scenario.bodies[plane].shape, HalfSpace):
                normal = np.array(scenario.bodies[plane].shape.normal)
                height = (contacts.position[here] - scenario.bodies[plane].position) @ normal
                # Midway between the surfaces: half the gap above the plane. Rounding of some 1e-16 of metres.
                near = 1e-12 + point_off(cell, trajectory, a, b, here)
                np.testing.assert_array_less(np.abs(height - contacts.separation[here] / 2), near)


def point_off(cell: Cell, trajectory: Trajectory, a: int, b: int, here: np.ndarray) -> float:
    """How far the points of a box on a plane may be from where their depth is, m: as far as its deepest corner is in.

    Of a box that leans, DART's detectors give the depth of one corner and a point between it and others.
    """
    box = any(isinstance(trajectory.scenario.bodies[place].shape, Box) for place in (a, b))
    return float(1.1 * np.abs(trajectory.contacts.separation[here]).max()) if cell.engine == "dart" and box else 0.0


@pytest.mark.parametrize("name", REPORT_CONTACTS)
@pytest.mark.parametrize("floor_first", [True, False])
def test_the_point_of_a_contact_lies_midway_between_the_surfaces_whichever_body_is_a(name, floor_first, installed):
    engine, depth = installed(name), 0.01
    ball = Body("ball", Sphere(0.1), 1.0, (0.3, -0.2, 0.1 - depth))
    bodies = (FLOOR, ball) if floor_first else (ball, FLOOR)
    scenario = Scenario("sunk-in", bodies, (Pair(bodies[0].name, bodies[1].name, restitution=0.5),), 0.01)
    contacts = engine.run(scenario, engine.settings(scenario, "tuned").change(timestep=1e-3, sample_every=1)).contacts
    # Found before the first step moves the ball: the overlap is still that of the start.
    assert contacts.sample[0] == 1
    assert contacts.separation[0] == pytest.approx(-depth, abs=1e-12)
    np.testing.assert_allclose(contacts.position[0], (0.3, -0.2, -depth / 2), atol=1e-12)


# What engines make of free flight


@cells_of("thrown-ball", "twirled-ball", "twirled-box")
def test_in_free_flight_the_centre_follows_the_parabola_of_its_integrator(cell, trajectory):
    body = SCENARIOS[cell.scenario].body("thrown")
    t, gravity = trajectory.times[:, None], np.array(SCENARIOS[cell.scenario].gravity)
    parabola = np.array(body.position) + np.array(body.velocity) * t + gravity * t**2 / 2
    off = trajectory.position("thrown") - parabola
    # Semi-implicit Euler: Σ (v0 + g i dt) dt over i = 1 … n is v0 t + g t²/2 + g t dt/2.
    late = 0 if flies_exactly(cell) else gravity * t * trajectory.settings.timestep / 2
    speed = np.linalg.norm(trajectory.velocity("thrown"), axis=1).max()
    # Bullet's own damping takes 0.04 (1 + v) v of the speed a second. All else is rounding, 1e-16 of 50 m a step.
    near = DAMPING * (1 + speed) * speed * DURATION**2 / 2 if is_damped(cell) else 1e-10
    np.testing.assert_allclose(off, np.broadcast_to(late, off.shape), atol=near)


@cells_of("twirled-ball", "twirled-box")
def test_a_body_spins_steadily_about_an_axis_that_stands_still_in_the_world(cell, trajectory):
    body, place = SCENARIOS[cell.scenario].body("thrown"), SCENARIOS[cell.scenario].index("thrown")
    spin, found = np.array(body.angular_velocity), trajectory.angular_velocities[:, place]
    start, rate = np.linalg.norm(spin), np.linalg.norm(found, axis=1)
    np.testing.assert_allclose(found / rate[:, None], np.broadcast_to(spin / start, found.shape), atol=1e-9)  # rounding
    if is_damped(cell):  # ω' = −k (1 + ω) ω: ω/(1 + ω) decays as exp(−k t), up to the steps that Bullet does it in
        share = start / (1 + start) * np.exp(-DAMPING * trajectory.times)
        np.testing.assert_allclose(rate, share / (1 - share), rtol=1e-3)
    else:
        np.testing.assert_allclose(rate, start, rtol=1e-9)


@cells_of("twirled-ball", "twirled-box")
def test_the_orientation_turns_with_the_spin(cell, trajectory):
    body, place = SCENARIOS[cell.scenario].body("thrown"), SCENARIOS[cell.scenario].index("thrown")
    spin, end = np.array(body.angular_velocity), float(trajectory.times[-1])
    rate = float(np.linalg.norm(spin))
    turn = np.array([math.cos(rate * end / 2), *(math.sin(rate * end / 2) * spin / rate)])
    expected = np.array(product(turn, body.orientation))
    # Engines turn by ω dt a step, exactly; a quaternion is off by half the angle that damping takes.
    near = DAMPING * (1 + rate) * rate * end**2 / 4 if is_damped(cell) else 1e-9 + turned_too_far(cell, rate)
    assert min(np.linalg.norm(expected - sign * trajectory.orientations[-1, place]) for sign in (1, -1)) < near


def turned_too_far(cell: Cell, rate: float) -> float:
    """Error of the last quaternion where an engine takes x for sin x in each step, as DART does below 1 mrad a step.

    The angle x then grows by x³/6 more, and a quaternion is off by half the angle.
    """
    angle = rate * setup(cell)[2].timestep
    return DURATION / setup(cell)[2].timestep * angle**3 / 12 if cell.engine == "dart" and angle < 1e-3 else 0.0


@cells_of("lying-box")
def test_a_box_that_lies_on_its_side_stays_as_it_lies(cell, trajectory):
    assert measure.separation(trajectory, "box", "floor")[0] == pytest.approx(0, abs=1e-15)
    assert measure.drift(trajectory, "box", DURATION) < 1e-3  # 1 mm: nobody sees it
    place = trajectory.scenario.index("box")
    turned = np.abs(trajectory.orientations[:, place] @ trajectory.orientations[0, place])
    assert 2 * math.acos(min(1.0, float(turned.min()))) < 1e-2  # rad: a corner of the box lifts by less than 4 mm


# Settings


@every_cell
def test_a_changed_timestep_is_what_runs(cell, installed):
    installed(cell.engine)
    engine, scenario, settings = setup(cell)
    changed = settings.change(timestep=2 * settings.timestep)
    trajectory = engine.run(scenario, changed)
    assert trajectory.settings == changed
    interval = changed.timestep * changed.sample_every
    np.testing.assert_allclose(np.diff(trajectory.times), interval, rtol=1e-9)


@cells_of("thrown-ball")
def test_the_changed_timestep_shows_in_the_flight_itself(cell, installed):
    installed(cell.engine)
    engine, scenario, settings = setup(cell)
    stretch = 2 * settings.timestep
    coarse = engine.run(scenario, settings.change(timestep=stretch, sample_every=1))
    fine = engine.run(scenario, settings.change(sample_every=2))
    lower = (fine.position("thrown") - coarse.position("thrown"))[:, 2]
    expected = 0 * fine.times if flies_exactly(cell) else GRAVITY * fine.times * settings.timestep / 2  # g t dt/2 each
    # Drag is taken in steps too: it adds a first-order term of its own, a share 0.04 (1 + 2 v) t of this one.
    np.testing.assert_allclose(lower, expected, rtol=DAMPING * 13 * DURATION if is_damped(cell) else 1e-6, atol=1e-10)


@pytest.mark.parametrize("cell", KINDS, ids=str)
def test_tuned_comes_first_and_stock_last_and_each_says_what_it_is(cell):
    found = load_engine(cell.engine).profiles(SCENARIOS[cell.scenario])
    assert [*found][:1] == ["tuned"]
    assert [*found][-1:] == ["stock"]
    assert all(line.strip() for line in found.values())


@every_cell
def test_every_profile_says_when_it_answers_in_one_of_four_ways(cell):
    engine, scenario, settings = setup(cell)
    method = engine.method(scenario, settings)
    assert method.kind in (EXACT, INTERPOLATED, AT_STEP, COMPLIANT)
    assert 0 <= method.recovery <= 1
    assert method.stiffness > 0
    assert method.rest_speed >= 0


@pytest.mark.parametrize("cell", KINDS, ids=str)
def test_a_profile_that_there_is_not_is_refused_with_those_there_are(cell):
    engine, scenario = load_engine(cell.engine), SCENARIOS[cell.scenario]
    with pytest.raises(UnknownName) as refused:
        engine.settings(scenario, "tunde")
    assert refused.value.choices == tuple(engine.profiles(scenario))
    assert "tunde" in str(refused.value)


@every_cell
def test_a_setting_that_there_is_not_is_refused_with_those_there_are(cell):
    _, _, settings = setup(cell)
    with pytest.raises(UnknownName) as refused:
        settings.change(timestpe=0.1)
    assert refused.value.choices == ("timestep", "sample_every", *settings.options)


@every_cell
def test_a_timestep_longer_than_the_scenario_is_refused(cell, installed):
    installed(cell.engine)
    engine, scenario, settings = setup(cell)
    with pytest.raises(InvalidInput, match="longer than"):
        engine.run(scenario, settings.change(timestep=1.01 * DURATION))
    with pytest.raises(InvalidInput, match="1e\\+08 is the most"):  # it would end in some hours
        engine.run(scenario, settings.change(timestep=1e-9 * DURATION))


@each_engine
def test_a_run_covers_the_scenario_in_as_few_whole_samples_as_do(name):
    engine = load_engine(name)
    for duration, settings, steps in (
        (3.0, Settings(1 / 240), 720),  # 3/(1/240) is 720.0000000000001 in floats
        (0.3, Settings(0.1), 3),  # and 0.3/0.1 is 2.9999999999999996
        (1.0, Settings(0.3), 4),
        (1.0, Settings(1e-4, 10), 10_000),
        (1.0003, Settings(1e-4, 10), 10_010),
    ):
        scenario = replace(SCENARIOS["thrown-ball"], duration=duration)
        settings = replace(
            engine.settings(scenario, "tuned"), timestep=settings.timestep, sample_every=settings.sample_every
        )
        assert engine.check_settings(scenario, settings) == steps


@each_engine
def test_a_duration_of_no_whole_number_of_samples_is_run_to_its_end(name, installed):
    engine, scenario = installed(name), replace(SCENARIOS["thrown-ball"], duration=0.1037)
    settings = engine.settings(scenario, "tuned").change(timestep=1e-3, sample_every=4)
    assert engine.run(scenario, settings).times[-1] == pytest.approx(0.104)


@each_engine
def test_an_engine_knows_its_version(name, installed):
    assert installed(name).version().strip()


# What the scenario means


@pytest.mark.parametrize("cell", REFUSED, ids=str)
def test_what_an_engine_has_no_words_for_it_refuses_with_a_reason(cell, installed):
    installed(cell.engine)
    engine, scenario, settings = setup(cell)
    kind, reason = SAYS_NO[cell.engine][cell.scenario]
    with pytest.raises(kind, match=reason):
        engine.run(scenario, settings)
    with pytest.raises(kind, match=reason):
        engine.run_many([scenario, scenario], settings)


def test_every_family_of_the_catalogue_is_in_the_grid_and_so_is_every_scenario_of_this_suite():
    assert set(SCENARIOS) == {*catalogue(), *(scenario.name for scenario in EXTRA)}
    assert len(SCENARIOS) == len(CATALOGUE) + len(EXTRA), "two scenarios of one name: the second hides the first"
    for engine in ENGINES:
        runs = {cell.scenario for cell in CELLS if cell.engine == engine}
        assert runs | set(SAYS_NO.get(engine, {})) == set(SCENARIOS)
        assert not runs & set(SAYS_NO.get(engine, {}))


@cells_of(*catalogue())
def test_the_coefficients_belong_to_the_pair_so_its_order_and_that_of_the_bodies_change_nothing(cell, trajectory):
    engine, scenario, settings = setup(cell)
    turned_pairs = tuple(replace(pair, body_a=pair.body_b, body_b=pair.body_a) for pair in scenario.pairs)
    swapped = engine.run(replace(scenario, pairs=turned_pairs), settings)
    reordered = engine.run(replace(scenario, bodies=scenario.bodies[::-1]), settings)
    near = 1e-9 + first_fall(cell) + unfinished(cell)
    for body in scenario.bodies:
        for other in (swapped, reordered):
            # A solver that visits contacts in another order rounds differently, and steps add that up.
            np.testing.assert_allclose(other.position(body.name), trajectory.position(body.name), atol=near)


def unfinished(cell: Cell) -> float:
    """How far bodies may get apart that push each other where a solver is left to stop early, m.

    Stock, Bullet goes through the contacts in turn and stops after 50 rounds or at a residual of 1e-7, MuJoCo at 1e-8
    of what it minimises. What is left hangs on the order, up to 0.1 mm/s, for the rest of the run. So it does in DART
    wherever a box has more corners down than it takes to carry it: its sweeps never end, its pivots break off.
    """
    movable = [body for body in SCENARIOS[cell.scenario].bodies if not body.immovable]
    boxes = cell.engine == "dart" and any(isinstance(body.shape, Box) for body in movable)
    return 1e-4 * DURATION if boxes or (cell.profile == "stock" and len(movable) > 1) else 0.0


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
def test_an_engine_with_one_coefficient_of_friction_refuses_two_instead_of_dropping_one(name, profile, installed):
    engine, scenario = installed(name), SCENARIOS["incline"]
    two = replace(scenario, pairs=(replace(scenario.pairs[0], static_friction=0.5),))
    with pytest.raises(CannotExpress, match="friction"):
        engine.run(two, engine.settings(two, profile))


@cells_of("dropped-ball")
def test_a_half_spaces_normal_is_the_worlds_however_its_body_is_turned(cell, trajectory):
    engine, scenario, settings = setup(cell)
    bodies = tuple(replace(body, orientation=TURNED) if body.immovable else body for body in scenario.bodies)
    turned = engine.run(replace(scenario, bodies=bodies), settings)
    # A normal turned into the body's frame and back is off by some 1e-16, and so is all that follows.
    np.testing.assert_allclose(turned.position("ball"), trajectory.position("ball"), atol=1e-12)
    np.testing.assert_allclose(
        turned.orientations[:, 0], np.broadcast_to(TURNED, (len(turned.times), 4)), atol=ROUNDING
    )


def test_the_hand_written_slab_knows_both_coefficients_of_friction():
    engine, scenario = load_engine("handwritten"), SCENARIOS["incline"]  # tan 20° = 0.364 against μ = 0.3
    settings = engine.settings(scenario, "tuned")
    held = replace(scenario, pairs=(replace(scenario.pairs[0], static_friction=0.5),))
    assert measure.displacement(engine.run(scenario, settings), "slab") > 0.1
    assert measure.displacement(engine.run(held, settings), "slab") == 0


def test_a_ball_that_lands_just_at_the_end_of_a_step_on_a_tilted_plane_bounces_once():
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
    for profile in ("tuned", "slide"):
        settings = engine.settings(scenarios[0], profile)
        for trajectory in engine.run_many(scenarios, settings):
            # It leaves with 0.1 m/s or more, so the next impact is 20 ms later at the least.
            assert [event.kind for event in trajectory.events] == ["impact"]
            landing, end = trajectory.events[0].time, float(trajectory.times[-1])
            normal = np.array(trajectory.scenario.body("plane").shape.normal)
            speeds = trajectory.velocity("ball") @ normal
            # v + g t in, the same out; rounding of 1e-14 m in the gap moves the landing by that over 0.1 m/s.
            assert speeds[-1] == pytest.approx(-speeds[0] + 2 * GRAVITY * landing - GRAVITY * end, abs=1e-9)


# Forces


PUSHED = replace(
    SCENARIOS["thrown-ball"], forces=(Force("thrown", (3.0, -1.0, 0.5)), Force("thrown", (0.0, 0.0, 2.0 * GRAVITY)))
)
"""A ball of 2 kg whose weight one force carries, and which another one pushes."""


@pytest.mark.parametrize("name", [name for name in ENGINES if load_engine(name).applies_forces])
def test_constant_forces_add_up_and_give_a_free_body_their_sum_over_its_mass(name, installed):
    engine = installed(name)
    for profile in ("tuned", "stock"):
        pushed = engine.run(PUSHED, engine.settings(PUSHED, profile))
        expected = np.array([3, -2, 4]) + np.outer(pushed.times, [1.5, -0.5, 0.25])
        # v grows by F/m dt in every step, to rounding. Bullet, stock, brakes the ball's 5.4 m/s by 0.04 (1 + v) v a
        # second.
        speed = np.linalg.norm([3, -2, 4]) + 0.1
        near = DAMPING * (1 + speed) * speed * DURATION if (name, profile) == ("pybullet", "stock") else 1e-12
        np.testing.assert_allclose(pushed.velocity("thrown"), expected, atol=near)
        # A force at the centre turns nothing, but for rounding of where the centre is.
        assert np.abs(pushed.angular_velocity("thrown")).max() < 1e-12


@pytest.mark.parametrize("name", [name for name in ENGINES if not load_engine(name).applies_forces])
def test_an_engine_that_applies_no_forces_says_so(name):
    engine = load_engine(name)
    with pytest.raises(CannotExpress, match="it knows no forces but weight and those of contacts"):
        engine.run(PUSHED, engine.settings(PUSHED, "tuned"))
