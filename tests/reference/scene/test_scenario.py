from __future__ import annotations

import math
import pickle

import numpy as np
import pytest

from reference.errors import CollisionsError, InvalidInput, UnknownName
from reference.scene.forces import Fluid, Force, Spring
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere
from reference.scene.steering import Steering

FLOOR = Body("floor", HalfSpace())
BALL = Body("ball", Sphere(0.1), mass=1.0, position=(0.0, 0.0, 1.0))
BOX = Body("box", Box((0.1, 0.2, 0.3)), mass=2.0, velocity=(1.0, 0.0, 0.0), angular_velocity=(0.0, 0.0, 2.0))


def scenario(**changes):
    parts = {"name": "drop", "bodies": (FLOOR, BALL), "pairs": (Pair("ball", "floor"),), "duration": 1.0}
    return Scenario(**parts | changes)


def _steered(rule="seek", bodies=("ball",), goals=((1.0, 1.0, 1.0),), parameters=()):
    return Steering(rule, bodies, goals, 1.0, 0.1, parameters=parameters)


# What cannot be is refused, by name and value

REFUSED = {
    "a scenario with a lone spring": (
        lambda: scenario(springs=Spring("ball", "", 3.0)),
        "drop: springs is Spring(body_a='ball'",
    ),
    "a spring among forces": (
        lambda: scenario(forces=(Spring("ball", "", 3.0),)),
        "it must be a Force or GrowingForce or OscillatingForce",
    ),
    "a word among bodies": (lambda: scenario(bodies=("ball",)), "drop: bodies[0] is 'ball'; it must be a Body"),
    "a rule by its name alone": (lambda: scenario(steering=("seek",)), "steering[0] is 'seek'; it must be a Steering"),
    "a fluid in a tuple": (lambda: scenario(fluid=(Fluid(1.0),)), "drop: fluid is (Fluid(density=1.0"),
    "a fluid of a number": (
        lambda: scenario(fluid=1000.0),
        "drop: fluid is 1000.0; it must be a Fluid, or () for none",
    ),
    "a fluid of None": (lambda: scenario(fluid=None), "drop: fluid is None; it must be a Fluid"),
    "a rule for the letters of a name": (lambda: _steered(bodies="ab", goals=((0, 0, 0), (1, 1, 1))), "bodies is 'ab'"),
    "a rule with a flat parameter": (
        lambda: _steered("arrive", parameters=("slowing_radius", 1.0)),
        "arrive: parameters is ('slowing_radius', 1.0); it must hold names with their numbers",
    ),
    "a field without reach": (
        lambda: _steered("repelling_force", parameters=(("strength", 1.0), ("reach", 0.0), ("response_time", 1.0))),
        "repelling_force: reach is 0.0; it must be above zero",
    ),
    "a sphere of radius zero": (lambda: Sphere(0.0), "radius is 0.0; it must be above zero"),
    "a sphere of negative radius": (lambda: Sphere(-0.5), "radius is -0.5; it must be above zero"),
    "a sphere of radius NaN": (lambda: Sphere(math.nan), "radius is nan; it must be a finite number"),
    "a sphere of infinite radius": (lambda: Sphere(math.inf), "radius is inf; it must be a finite number"),
    "a sphere of radius 'wide'": (lambda: Sphere("wide"), "radius is 'wide'; it must be a number"),
    "a box without thickness": (lambda: Box((1.0, 0.0, 2.0)), "half extent y is 0.0; it must be above zero"),
    "a box in the plane": (lambda: Box((1.0, 2.0)), "half_extents is (1.0, 2.0); it must hold three numbers"),
    "a box of size 2": (lambda: Box(2.0), "half_extents is 2.0; it must hold three numbers"),
    "a plane without direction": (lambda: HalfSpace((0.0, 0.0, 0.0)), "normal is (0.0, 0.0, 0.0); a direction must"),
    "a plane with a NaN in it": (lambda: HalfSpace((0.0, math.nan, 1.0)), "normal[1] is nan; it must be a finite"),
    "a body without a name": (lambda: Body("", Sphere(1.0)), "name is empty"),
    "a body of mass zero": (lambda: Body("ball", Sphere(1.0), mass=0.0), "ball: mass is 0.0; it must be above zero"),
    "a body of negative mass": (lambda: Body("ball", Sphere(1.0), mass=-2.0), "ball: mass is -2.0; it must be above"),
    "a body of mass minus infinity": (lambda: Body("ball", Sphere(1.0), mass=-math.inf), "ball: mass is -inf"),
    "a body of mass NaN": (lambda: Body("ball", Sphere(1.0), mass=math.nan), "ball: mass is nan; it must be a finite"),
    "a half-space of 3 kg": (
        lambda: Body("floor", HalfSpace(), mass=3.0),
        "floor: a half-space has mass 3.0; only inf",
    ),
    "an immovable body that moves": (
        lambda: Body("wall", Sphere(1.0), velocity=(1.0, 0.0, 0.0)),
        "wall: an immovable body (mass inf) has velocity (1.0, 0.0, 0.0); only 0",
    ),
    "an immovable body that spins": (
        lambda: Body("wall", Sphere(1.0), angular_velocity=(0.0, 2.0, 0.0)),
        "wall: an immovable body (mass inf) has angular_velocity (0.0, 2.0, 0.0); only 0",
    ),
    "an immovable body whose velocity is no vector": (
        lambda: Body("wall", Sphere(1.0), velocity=3.0),
        "wall: velocity is 3.0; it must hold three numbers",
    ),
    "a body at NaN": (
        lambda: Body("ball", Sphere(1.0), mass=1.0, position=(0.0, 0.0, math.nan)),
        "ball: position[2] is nan; it must be a finite number",
    ),
    "a body with four velocities": (
        lambda: Body("ball", Sphere(1.0), mass=1.0, velocity=(1.0, 2.0, 3.0, 4.0)),
        "ball: velocity is (1.0, 2.0, 3.0, 4.0); it must hold three numbers",
    ),
    "a body whose velocity is a word": (
        lambda: Body("ball", Sphere(1.0), mass=1.0, velocity="123"),
        "ball: velocity is '123'; it must hold three numbers",
    ),
    "a body with infinite spin": (
        lambda: Body("ball", Sphere(1.0), mass=1.0, angular_velocity=(math.inf, 0.0, 0.0)),
        "ball: angular_velocity[0] is inf; it must be a finite number",
    ),
    "a body with three Euler angles": (
        lambda: Body("ball", Sphere(1.0), mass=1.0, orientation=(0.0, 0.0, 1.0)),
        "ball: orientation is (0.0, 0.0, 1.0); it must hold four numbers, w x y z",
    ),
    "a body without orientation": (
        lambda: Body("ball", Sphere(1.0), mass=1.0, orientation=(0.0, 0.0, 0.0, 0.0)),
        "ball: orientation is (0.0, 0.0, 0.0, 0.0); an orientation must not be zero",
    ),
    "a body whose orientation is not finite": (
        lambda: Body("ball", Sphere(1.0), mass=1.0, orientation=(1.0, 0.0, math.nan, 0.0)),
        "ball: orientation[2] is nan; it must be a finite number",
    ),
    "a body with an orientation in words": (
        lambda: Body("ball", Sphere(1.0), mass=1.0, orientation="wxyz"),
        "ball: orientation is 'wxyz'; it must hold four numbers",
    ),
    "an inertia that is a number": (
        lambda: Body("ball", Sphere(1.0), mass=1.0, inertia=0.4),
        "ball: inertia is 0.4; it must hold three numbers",
    ),
    "an inertia of no numbers": (
        lambda: Body("ball", Sphere(1.0), mass=1.0, inertia=[]),
        "ball: inertia is []; it must hold three numbers",
    ),
    "a moment of inertia of zero": (
        lambda: Body("ball", Sphere(1.0), mass=1.0, inertia=(0.4, 0.0, 0.4)),
        "ball: inertia[1] is 0.0; it must be above zero",
    ),
    "an infinite moment of inertia": (
        lambda: Body("ball", Sphere(1.0), mass=1.0, inertia=(math.inf, 0.4, 0.4)),
        "ball: inertia[0] is inf; it must be a finite number",
    ),
    "moments of inertia of no body": (
        lambda: Body("ball", Sphere(1.0), mass=1.0, inertia=(0.1, 0.30001, 0.2)),
        "ball: inertia is (0.1, 0.30001, 0.2); no moment may exceed the sum of the two others",
    ),
    "an inertia of a body that nothing turns": (
        lambda: Body("wall", Sphere(1.0), inertia=(0.4, 0.4, 0.4)),
        "wall: inertia is (0.4, 0.4, 0.4), and the body is immovable (mass inf): nothing turns it",
    ),
    "a pair of one body": (lambda: Pair("ball", "ball"), "pair ball–ball: a body cannot be paired with itself"),
    "a restitution above one": (
        lambda: Pair("ball", "floor", restitution=1.01),
        "pair ball–floor: restitution is 1.01; it must lie between 0 and 1",
    ),
    "a negative restitution": (
        lambda: Pair("ball", "floor", restitution=-0.1),
        "pair ball–floor: restitution is -0.1; it must lie between 0 and 1",
    ),
    "a restitution of NaN": (
        lambda: Pair("ball", "floor", restitution=math.nan),
        "restitution is nan; it must be a fin",
    ),
    "a negative kinetic friction": (
        lambda: Pair("ball", "floor", kinetic_friction=-0.1),
        "pair ball–floor: kinetic_friction is -0.1; it must not be negative",
    ),
    "a negative static friction": (
        lambda: Pair("ball", "floor", static_friction=-0.1),
        "pair ball–floor: static_friction is -0.1; it must not be negative",
    ),
    "a static friction of NaN": (lambda: Pair("ball", "floor", static_friction=math.nan), "static_friction is nan; it"),
    "a static friction below the kinetic one": (
        lambda: Pair("ball", "floor", kinetic_friction=0.5, static_friction=0.4),
        "pair ball–floor: static_friction 0.4 is below kinetic_friction 0.5",
    ),
    "a scenario that lasts no time": (lambda: scenario(duration=0.0), "drop: duration is 0.0; it must be above zero"),
    "a scenario that runs backwards": (
        lambda: scenario(duration=-1.0),
        "drop: duration is -1.0; it must be above zero",
    ),
    "a scenario without end": (
        lambda: scenario(duration=math.inf),
        "drop: duration is inf; it must be a finite number",
    ),
    "a gravity that is a number": (lambda: scenario(gravity=9.81), "drop: gravity is 9.81; it must hold three numbers"),
    "two bodies of one name": (
        lambda: scenario(bodies=(FLOOR, BALL, BALL)),
        "drop: two bodies share a name in ['floor', 'ball', 'ball']",
    ),
    "one pair given twice": (
        lambda: scenario(pairs=(Pair("ball", "floor"), Pair("floor", "ball"))),
        "drop: the pair ['ball', 'floor'] is given twice",
    ),
    "a force that is a number": (lambda: Force("ball", 9.81), "force on ball is 9.81; it must hold three numbers"),
    "a force on the floor": (
        lambda: scenario(forces=(Force("floor", (1.0, 0.0, 0.0)),)),
        "drop: a force of (1.0, 0.0, 0.0) N acts on floor, which is immovable",
    ),
    "a force on nobody": (
        lambda: scenario(forces=(Force("bell", (1.0, 0.0, 0.0)),)),
        "unknown body 'bell'. Did you mean 'ball'?",
    ),
}


@pytest.mark.parametrize("what", REFUSED)
def test_an_impossible_value_is_refused_with_its_name(what):
    make, text = REFUSED[what]
    with pytest.raises(InvalidInput) as caught:
        make()
    assert text in str(caught.value)


def test_a_pair_of_an_unknown_body_reports_the_choices():
    with pytest.raises(UnknownName) as caught:
        scenario(pairs=(Pair("bal", "floor"),))
    assert str(caught.value) == "unknown body 'bal'. Did you mean 'ball'? Choices: floor, ball."
    with pytest.raises(UnknownName, match=r"unknown body 'ceiling'\. Choices: floor, ball\."):
        scenario(pairs=(Pair("ball", "ceiling"),))


def test_a_refusal_is_a_usage_error_and_a_value_error():
    with pytest.raises(CollisionsError) as caught:
        Sphere(-1.0)
    assert isinstance(caught.value, ValueError)
    assert caught.value.exit_code == 2


# What can be is accepted


@pytest.mark.parametrize("restitution", [0, 0.0, 1, 1.0, 0.5])
def test_a_restitution_from_zero_to_one_is_accepted(restitution):
    assert Pair("ball", "floor", restitution=restitution).restitution == restitution


def test_moments_of_inertia_are_a_bodys_own_or_its_shapes():
    assert BALL.moments_of_inertia() == pytest.approx((0.004, 0.004, 0.004), rel=1e-15)
    assert BOX.moments_of_inertia() == pytest.approx((2 * 0.13 / 3, 2 * 0.1 / 3, 2 * 0.05 / 3), rel=1e-15)
    assert Body("ball", Sphere(0.1), 1.0, inertia=[1, 2, 2]).moments_of_inertia() == (1.0, 2.0, 2.0)
    assert FLOOR.moments_of_inertia() == (math.inf,) * 3
    assert Body("peg", Sphere(0.1)).moments_of_inertia() == (math.inf,) * 3


def test_a_flat_plate_may_have_its_rounded_moments():
    a, b = 0.1 / 3, 0.2 / 3  # in its plane; the third is their sum, which is rounded
    assert Body("plate", Sphere(0.1), 1.0, inertia=(a, b, (a + b) * (1 + 1e-15))).inertia[:2] == (a, b)


def test_bodies_and_pairs_have_plain_defaults():
    body, pair = Body("ball", Sphere(1.0), mass=1.0), Pair("ball", "floor")
    assert (body.position, body.velocity, body.angular_velocity) == ((0.0, 0.0, 0.0),) * 3
    assert body.orientation == (1.0, 0.0, 0.0, 0.0)
    assert (pair.restitution, pair.kinetic_friction, pair.static_friction) == (0.0, 0.0, 0.0)
    assert HalfSpace().normal == (0.0, 0.0, 1.0)


def test_static_friction_defaults_to_kinetic_friction():
    assert Pair("ball", "floor", kinetic_friction=0.3).static_friction == 0.3
    assert Pair("ball", "floor", kinetic_friction=0.3, static_friction=0.3).static_friction == 0.3
    assert Pair("ball", "floor", kinetic_friction=0.3, static_friction=0.4).static_friction == 0.4
    assert Pair("ball", "floor", kinetic_friction=2.0).kinetic_friction == 2.0  # rubber: above one


def test_directions_and_orientations_are_scaled_to_unit_length():
    assert HalfSpace((2.0, -3.0, 6.0)).normal == (2 / 7, -3 / 7, 6 / 7)
    assert Body("ball", Sphere(1.0), mass=1.0, orientation=(1, 2, -2, 4)).orientation == (0.2, 0.4, -0.4, 0.8)
    turned = Body("ball", Sphere(1.0), mass=1.0, orientation=(2.0, 0.0, 0.0, -2.0))
    assert turned.orientation == pytest.approx((math.sqrt(0.5), 0, 0, -math.sqrt(0.5)), abs=2.3e-16)  # two roundings


def test_numbers_of_any_kind_become_plain_floats_in_tuples():
    body = Body("ball", Sphere(np.float32(0.5)), mass=np.int64(2), position=np.array([1, 2, 3]), velocity=[0, 1, 0])
    assert body.position == (1.0, 2.0, 3.0)
    assert body.velocity == (0.0, 1.0, 0.0)
    for value in (body.mass, body.shape.radius, *body.position, *body.velocity):
        assert type(value) is float


def test_a_body_of_infinite_mass_is_immovable():
    assert FLOOR.immovable
    assert FLOOR.inverse_mass == 0
    assert not BOX.immovable
    assert BOX.inverse_mass == 0.5


def test_a_body_is_found_by_name_at_its_place():
    made = scenario()
    assert made.body("ball") is BALL
    assert [made.index(name) for name in ("floor", "ball")] == [0, 1]
    with pytest.raises(UnknownName, match=r"unknown body 'box'\. Choices: floor, ball\."):
        made.index("box")


def test_bodies_that_no_pair_lists_do_not_collide():
    made = scenario(bodies=(FLOOR, BALL, BOX))
    assert made.unlisted_pairs() == [("floor", "box"), ("ball", "box")]
    assert scenario().unlisted_pairs() == []


def test_gravity_points_down_with_the_figure_of_the_published_cases():
    assert scenario().gravity == (0.0, 0.0, -9.81)


# Inertia


def second_moments(inside, half_extents, count=101):
    """Principal moments per unit mass of the points of a grid that are inside, m²."""
    axes = [(np.arange(count) + 0.5) / count * 2 * extent - extent for extent in half_extents]
    x, y, z = np.meshgrid(*axes, indexing="ij")
    kept = inside(x, y, z)
    x, y, z = x[kept], y[kept], z[kept]
    return np.mean(y**2 + z**2), np.mean(z**2 + x**2), np.mean(x**2 + y**2)


def test_the_inertia_of_a_box_is_the_second_moment_of_its_points():
    box = Box((0.1, 0.2, 0.3))
    # Midpoints of 101 cells an axis: out by 1/101² as a share
    assert box.inertia_per_mass() == pytest.approx(second_moments(lambda x, y, z: x == x, box.half_extents), rel=2e-4)


def test_the_inertia_of_a_sphere_is_the_second_moment_of_its_points():
    sphere = Sphere(0.7)
    counted = second_moments(lambda x, y, z: x**2 + y**2 + z**2 < 0.49, (0.7, 0.7, 0.7))
    # Cells cut by the surface are counted whole or not at all; over 5e5 cells that averages out to 1e-3
    assert sphere.inertia_per_mass() == pytest.approx(counted, rel=1e-3)


# Frozen data


def test_a_scenario_survives_pickling_unchanged_and_serves_as_a_key():
    pair = Pair("ball", "floor", restitution=0.5, kinetic_friction=0.2, static_friction=0.3)
    made = scenario(bodies=(FLOOR, BALL, BOX), pairs=(pair,))
    copy = pickle.loads(pickle.dumps(made))
    assert copy == made
    assert hash(copy) == hash(made)
    assert {made: "found"}[copy] == "found"
    assert made != scenario()


def test_a_scenario_made_from_lists_is_the_same_as_one_made_from_tuples():
    from_lists = scenario(bodies=[FLOOR, BALL], pairs=[Pair("ball", "floor")])
    assert from_lists == scenario()
    assert hash(from_lists) == hash(scenario())


@pytest.mark.parametrize(
    ("entry", "name"), [(Sphere(1.0), "radius"), (BALL, "mass"), (Pair("a", "b"), "restitution"), (scenario(), "name")]
)
def test_a_scenario_cannot_be_changed_afterwards(entry, name):
    with pytest.raises(AttributeError, match="cannot assign"):
        setattr(entry, name, 2.0)
