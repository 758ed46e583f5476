"""What docs/engines-dart.md says of DART, measured."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from catalogue_rows import rebound_of_many, row

from reference import truth
from reference.catalogue import measure
from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.bouncing_ball import falling_ball
from reference.catalogue.scenarios.friction import slab_on_plane
from reference.comparison.verdicts import Verdict
from reference.engines import dart_bodies, dart_engine, load_engine
from reference.engines.base import AT_STEP, DART, Method
from reference.errors import CannotExpress, InvalidInput
from reference.scene.scenario import GRAVITY, Body, Box, HalfSpace, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

G = GRAVITY
FALL_SPEED = math.sqrt(2 * G)  # m/s, after 1 m
SOFTNESS = 1e-5
FLOOR = Body("floor", HalfSpace())


@pytest.fixture(autouse=True)
def _dart(installed) -> None:
    installed("dart")


def measured(family: str, case: str, quantity: str) -> float:
    return row(family, "dart", "tuned", case, quantity).measured


def run(scenario: Scenario, profile: str = "tuned", **changes) -> Trajectory:
    engine = load_engine("dart")
    return engine.run(scenario, engine.settings(scenario, profile).change(**changes))


def with_options(scenario: Scenario, **options) -> Trajectory:
    """A run with options that the profile has not derived."""
    engine = load_engine("dart")
    settings = engine.settings(scenario, "tuned")
    return engine.run(scenario, replace(settings, options={**settings.options, **options}))


def drop(restitution: float, speed: float, duration: float = 0.05) -> Trajectory:
    """A weightless ball that meets the floor after some 10 ms."""
    ball = Body("ball", Sphere(0.1), 1.0, (0.0, 0.0, 0.1 + 0.0100003 * speed), velocity=(0.0, 0.0, -speed))
    pair = Pair("ball", "floor", restitution)
    return run(Scenario("shot down", (FLOOR, ball), (pair,), duration, (0.0, 0.0, 0.0)))


# Coefficients


def test_a_pairs_restitution_is_set_as_the_root_of_a_product():
    found = drop(0.5, 2.0).velocity("ball")[-1, 2]
    assert found == pytest.approx(0.5 * 2.0, rel=1e-4)  # a softness of 1e-5 takes 3e-5 of it


def test_a_pairs_friction_is_the_smaller_of_its_bodies_coefficients():
    one = slab_on_plane("one", 0.2, 0.0, 2.0, 1.0)
    other = replace(one.body("slab"), name="other", position=(0.0, 3.0, 0.02))
    pairs = (*one.pairs, Pair("other", "plane", kinetic_friction=0.6))
    trajectory = run(replace(one, bodies=(*one.bodies, other), pairs=pairs))
    for name, friction in (("slab", 0.2), ("other", 0.6)):
        speed = np.linalg.norm(trajectory.velocity(name)[100])
        assert speed == pytest.approx(2.0 - friction * G * 0.1, abs=1e-4)


def test_pairs_that_no_coefficients_of_bodies_give_are_refused():
    engine, ball = load_engine("dart"), Body("ball", Sphere(0.1), 1.0, (0.0, 0.0, 1.0))
    bodies = (FLOOR, ball, replace(ball, name="other", position=(1.0, 0.0, 1.0)))
    three = [("ball", "floor"), ("other", "floor"), ("ball", "other")]

    def refused(pairs: list[Pair], why: str) -> None:
        scenario = Scenario("mixed", bodies, tuple(pairs), 0.1)
        with pytest.raises(CannotExpress, match=why):
            engine.run(scenario, engine.settings(scenario, "tuned"))

    refused([Pair(*two, e) for two, e in zip(three, (0.2, 0.8, 0.9), strict=True)], "restitutions")
    refused([Pair(*two, 0.0, mu) for two, mu in zip(three, (0.5, 0.5, 0.2), strict=True)], "smaller friction")
    refused([Pair("ball", "floor", 0.001)], "restitution of 0.001 for none")
    refused([Pair("ball", "floor", 0.0, 0.001)], "friction of 0.001 for none")


# Impacts


@pytest.mark.parametrize("restitution", [0.2, 0.5, 0.8, 1.0])
def test_an_impact_loses_a_hundred_thousandth_of_the_change_of_speed(restitution):
    kept = drop(restitution, 2.0).velocity("ball")[-1, 2] / 2.0
    # The change (1 + e) v falls short by the softness; its square is 1e-10.
    assert kept == pytest.approx(restitution - (1 + restitution) * SOFTNESS, abs=1e-9)


@pytest.mark.parametrize("restitution", [0.2, 0.5, 0.8, 1.0])
@pytest.mark.slow
def test_the_mean_rebound_differs_by_half_a_step_and_its_weight(restitution):
    dt, drops, apexes = 1e-3, 10, []
    for phase in range(drops):
        height = G * (dt * (451 + (phase + 0.5) / drops)) ** 2 / 2  # 1 m, to a thousandth
        ball = falling_ball("drop", restitution, height, math.sqrt(2 / G) * (1 + restitution) + 0.05)
        apexes.append(measure.first_apex(run(ball, timestep=dt, sample_every=1), "ball", "floor") / height)
    expected = (1 + restitution) * (-(1 - 2 * restitution) / 2 * FALL_SPEED * dt - 2 * restitution * SOFTNESS)
    # Phases in the middle of ten parts of a step have the mean of a straight line: left are squares of g dt, 2 g dt²/h.
    assert np.mean(apexes) - restitution**2 == pytest.approx(expected, abs=2e-5)


@pytest.mark.parametrize(("rebound", "comes_back"), [(0.0999, False), (0.1002, True)])
def test_a_rebound_below_a_tenth_of_a_metre_a_second_is_suppressed(rebound, comes_back):
    assert bool(drop(0.5, rebound / 0.5).velocity("ball")[-1, 2] > 0.05) == comes_back


def test_no_rebound_is_faster_than_a_hundred_metres_a_second():
    # The softness lets 1e-5 of v + 100 m/s pass.
    assert drop(1.0, 150.0).velocity("ball")[-1, 2] == pytest.approx(100 - 250 * SOFTNESS, abs=1e-3)


@pytest.mark.slow
def test_a_lively_ball_never_rests_at_a_millisecond():
    # e (v + g dt) = v has the solution e g dt/(1 − e); above 0.1 m/s that is no rest.
    steady = 0.95 * G * 1e-3 / 0.05
    assert steady > 0.1
    trajectory = run(falling_ball("lively", 0.95, 0.05, 8.0), "stock", sample_every=1)
    late = trajectory.velocity("ball")[-1000:, 2]
    assert late.max() == pytest.approx(steady, rel=0.1)  # a period of whole steps: g dt is 5 % of the speed
    tuned = run(falling_ball("lively", 0.95, 0.05, 5.5))  # the series of bounces ends after 3.9 s
    assert np.abs(tuned.velocity("ball")[-1000:, 2]).max() < 1e-3


@pytest.mark.slow
def test_overlap_is_recovered_at_a_millimetre_a_second_without_speed():
    ball = Body("ball", Sphere(0.1), 1.0, (0.0, 0.0, 0.1 - 2e-3))
    scenario = Scenario("sunk in", (FLOOR, ball), (Pair("ball", "floor"),), 1.0)
    trajectory = run(scenario)
    depth = -measure.separation(trajectory, "ball", "floor")
    assert depth[500] == pytest.approx(2e-3 - 0.5e-3, abs=2e-6)
    assert np.abs(trajectory.velocity("ball")).max() < 1e-6  # what the softness leaves of g dt
    pushed = run(scenario, split_impulse=False)
    assert pushed.velocity("ball")[500, 2] == pytest.approx(1e-3, rel=1e-3)


def test_small_overlaps_are_recovered_by_a_hundredth_a_step():
    ball = Body("ball", Sphere(0.1), 1.0, (0.0, 0.0, 0.1 - 2e-5))
    trajectory = run(Scenario("sunk in", (FLOOR, ball), (Pair("ball", "floor"),), 0.1))
    depth = -measure.separation(trajectory, "ball", "floor")
    # 1 mm/s is 1e-7 m a step, a hundredth of 1e-5 m, which is left after 10 ms; then 400 steps. Gravity adds 1e-10 m.
    assert depth[10] == pytest.approx(1e-5, rel=1e-3)
    assert depth[50] == pytest.approx(1e-5 * 0.99**400, rel=0.01)


# Contacts


def on_the_ground(ground: str, detector: str) -> Trajectory:
    cube = Body("cube", Box((0.1, 0.1, 0.1)), 1.0, (0.0, 0.0, 0.1 - 1e-4))
    scenario = Scenario("cube", (FLOOR, cube), (Pair("cube", "floor", kinetic_friction=0.5),), 0.01)
    return with_options(scenario, ground=ground, detector=detector)


@pytest.mark.parametrize("detector", ["dart", "fcl"])
def test_a_box_has_one_contact_on_a_plane_and_four_on_a_box(detector):
    for ground, count in (("plane", 1), ("box", 4)):
        assert np.count_nonzero(on_the_ground(ground, detector).contacts.sample == 1) == count


def test_bodies_with_a_gap_of_exactly_zero_touch():
    cube = Body("cube", Box((0.1, 0.1, 0.1)), 1.0, (0.0, 0.0, 0.1))
    scenario = Scenario("cube", (FLOOR, cube), (Pair("cube", "floor", kinetic_friction=0.5),), 0.01)
    assert 1 in run(scenario).contacts.sample


# Friction


def slab_at_thirty_degrees(solver: str, timestep: float = 1e-3) -> tuple[float, float]:
    """Way ÷ v²/(2 μ g), and how far aside ÷ the same."""
    scenario = slab_on_plane("slab", 0.4, 0.0, 2.0, 0.8, math.radians(30))
    moved = run(scenario, solver=solver, timestep=timestep).position("slab")
    moved = (moved[-1] - moved[0])[:2] / truth.stopping_distance(2.0, 0.4, G)
    return float(np.hypot(*moved)), float(moved @ [math.sin(math.radians(30)), -math.cos(math.radians(30))])


@pytest.mark.slow
def test_the_default_solvers_friction_pyramid_brakes_each_axis_fully():
    way, aside = slab_at_thirty_degrees("dantzig")
    # Each component stops for itself, after cos² and sin² of the way; v dt/2 of 0.5 m is 0.2 %.
    along, across = math.cos(math.radians(30)) ** 2, math.sin(math.radians(30)) ** 2
    assert way == pytest.approx(math.hypot(along, across), abs=3e-3)
    assert aside == pytest.approx(along * 0.5 - across * math.sqrt(3) / 2, abs=3e-3)


@pytest.mark.parametrize("solver", ["nsgs", "fbf"])
@pytest.mark.slow
def test_the_coulomb_solvers_friction_cone_keeps_a_slab_on_its_line(solver):
    way, aside = slab_at_thirty_degrees(solver)
    assert way == pytest.approx(1 - 2.0 * 1e-3 / 2 / truth.stopping_distance(2.0, 0.4, G), abs=1e-5)  # − v₀ dt/2
    assert abs(aside) < 1e-5


@pytest.mark.slow
def test_a_ball_rolls_with_five_sevenths_of_its_speed():
    found = measured("sliding-ball", "μ=0.3,v=2", "rolling_speed")
    assert found == pytest.approx(10 / 7, rel=1e-6)  # the softness of each step's friction


@pytest.mark.slow
def test_a_slab_on_a_slope_that_holds_creeps_less_than_a_micrometre():
    assert abs(measured("incline", "μ=1,θ=40°", "way")) < 1e-6


@pytest.mark.parametrize(("changes", "left"), [({}, 0.5e-3), ({"sleep": True}, 0.0)])
@pytest.mark.slow
def test_a_slow_body_that_may_sleep_is_frozen_after_half_a_second(changes, left):
    ball = Body("ball", Sphere(0.1), 1.0, (0.0, 0.0, 0.1), velocity=(0.5e-3, 0.0, 0.0))
    trajectory = run(Scenario("creeping", (FLOOR, ball), (Pair("ball", "floor"),), 1.0), **changes)
    assert trajectory.velocity("ball")[[400, -1], 0] == pytest.approx([0.5e-3, left], abs=1e-12)


# Solvers


def cradle(solver: str, reverse: bool) -> np.ndarray:
    scenario = catalogue()["cradle"].case("5 touching").scenarios[0]
    if reverse:
        scenario = replace(scenario, bodies=scenario.bodies[::-1])
    found = with_options(scenario, solver=solver).velocities[-1, :, 0]
    return found[::-1] if reverse else found


@pytest.mark.slow
def test_the_default_solver_breaks_off_for_one_order_of_the_bodies():
    exact = np.array([-0.6, 0.4, 0.4, 0.4, 0.4])
    # Its stand-in sweeps 30 times: 4e-4 are left. Otherwise it is the softness, 1e-5, in each of four contacts.
    assert np.abs(cradle("dantzig", False) - exact).max() < 6e-5
    assert 1e-4 < np.abs(cradle("dantzig", True) - exact).max() < 1e-3
    for reverse in (False, True):
        assert np.abs(cradle("nsgs", reverse) - exact).max() < 6e-5


@pytest.mark.slow
def test_a_stack_falls_into_place_and_stands():
    family = catalogue()["stack"]
    trajectory = run(replace(family.case("boxes=5").scenarios[0], duration=0.3))
    found = {name: family.quantity(name).measure(trajectory) for name in ("height", "drift")}
    assert found["height"] == pytest.approx(-3 * G * 1e-6, rel=0.5)  # some falls of a step
    assert found["drift"] < 1e-5
    assert np.linalg.norm(trajectory.velocities[-100:], axis=-1).max() < 1e-4


# Turning


@pytest.mark.parametrize(("angle", "share"), [(0.9e-3, 1.0), (1.1e-3, 0.0)])
def test_below_a_milliradian_a_step_an_angle_is_replaced_by_its_sine(angle, share):
    ball = Body("ball", Sphere(0.1), 1.0, (0.0, 0.0, 9.0), angular_velocity=(0.0, 0.0, angle / 1e-3))
    w, _, _, z = run(Scenario("turning", (ball,), (), 1.0, (0.0, 0.0, 0.0)), timestep=1e-3).orientation("ball")[-1]
    error = 2 * math.atan2(z, w) - 1000 * angle
    assert error == pytest.approx(share * 1000 * angle**3 / 6, rel=2e-3, abs=1e-10)  # measured: 0.12 % more


def test_a_velocity_of_nan_stays_and_moves_the_pose_to_the_origin(installed):
    dart, engine, scenario = installed("dart").module(), load_engine("dart"), falling_ball("ball", 0.5, 1.0, 1.0)
    settings = engine.settings(scenario, "stock")
    world = dart_engine._world(dart, scenario, settings)
    _, node = dart_bodies.add_body(dart, world, scenario.body("ball"), settings, 0.0, 0.0)
    node.getParentJoint().setLinearVelocity([math.nan, 0.0, 0.0])
    world.step()
    assert np.isnan(node.getLinearVelocity()).all()
    assert not node.getWorldTransform().translation().any()


# Stock


def test_a_stock_box_on_a_plane_rocks_for_ever_on_its_one_contact():
    trajectory = run(slab_on_plane("slab", 0.4, 0.0, 2.0, 1.5), "stock")
    speeds = np.linalg.norm(trajectory.velocity("slab")[-300:], axis=1)
    assert speeds.max() > measure.REST_SPEED
    assert truth.stopping_distance(2.0, 0.4, G) - 1e-3 == pytest.approx(trajectory.position("slab")[-1, 0], abs=1e-3)


# How it is said


def test_the_method_describes_the_contact():
    engine, scenario = load_engine("dart"), falling_ball("ball", 0.5, 1.0, 1.0)
    method = engine.method(scenario, engine.settings(scenario, "tuned"))
    assert method == Method(AT_STEP, rest_speed=0.2, inset=1.0, softness=SOFTNESS, weighed=1.0, rule=DART)
    other = replace(scenario.body("ball"), name="other", position=(1.0, 0.0, 1.1))
    pairs = (*scenario.pairs, Pair("other", "floor", 0.8))
    two = replace(scenario, bodies=(*scenario.bodies, other), pairs=pairs)
    assert engine.method(two, engine.settings(two, "tuned")).rest_speed == 0.2  # the dullest pair's
    (move,) = engine.moves(scenario, engine.settings(scenario, "tuned"))
    assert (move.option, move.value) == ("solver_tolerance", pytest.approx(1e-13))  # a tenth


@pytest.mark.parametrize(
    ("case", "verdict"),
    [
        pytest.param("e=0.5", Verdict.DISAGREES, marks=pytest.mark.slow),
        pytest.param("e=0.8", Verdict.PASS, marks=pytest.mark.slow),
    ],
)
def test_a_fifth_impact_too_slow_to_rebound_disagrees_with_theory(case, verdict):
    found = row("two-walls", "dart", "tuned", case, "speed_left")
    assert found.verdict is verdict  # 2 · 0.5⁵ = 0.0625 m/s is below 0.1, and 2 · 0.8⁵ is not


TABLE = {"stock": (-4.02, -0.005, 0.37, 0.44), "tuned": (-0.41, -0.006, 0.03, 0.04)}
ENTRIES = [(profile, *entry) for profile in TABLE for entry in zip((0.2, 0.5, 0.8, 1.0), TABLE[profile], strict=True)]


@pytest.mark.parametrize(
    ("profile", "restitution", "percent"),
    # Each entry takes 107 drops of its own. The first has the largest figure, so it shows the most.
    [pytest.param(*entry, marks=pytest.mark.slow if entry == ENTRIES[0] else pytest.mark.weekly) for entry in ENTRIES],
)
def test_the_mean_rebounds_over_many_drops_are_those_of_the_table(profile, restitution, percent):
    found = rebound_of_many("dart", profile, f"e={restitution:g}")
    off = 100 * (found.measured / restitution**2 - 1)
    assert off == pytest.approx(percent, abs=0.006 if abs(percent) > 0.01 else 0.0006)  # the last digit


@pytest.mark.parametrize("option", ["detector", "ground", "solver"])
def test_an_unknown_word_is_refused_with_the_known_ones(option):
    with pytest.raises(InvalidInput, match=rf"{option} is 'x'; here it is one of \w+, "):
        run(slab_on_plane("slab", 0.4, 0.0, 2.0, 0.1), **{option: "x"})


def test_stock_sets_nothing():
    assert load_engine("dart").settings(falling_ball("ball", 0.5, 1.0, 1.0), "stock") == Settings(1e-3)
