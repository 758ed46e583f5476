"""Forces on bodies of the world: against closed forms, statics, and the balance of energy."""

from __future__ import annotations

import math

import numpy as np
import pytest

from solutions.forces import spring_energy
from solutions.impulse import box_inertia, world_inverse_inertia
from solutions.meshes import SpringMesh, spring_mesh, static_shape
from solutions.world.attachments import WORLD, forces_at_points, point_motion
from solutions.world.forces import (
    buoyancy_forces,
    drag_forces,
    gravity_forces,
    mesh_body_forces,
    spring_forces,
    wind_forces,
)
from solutions.world.rotation import turn_freely, turned

GRAVITY = np.array([0.0, 0.0, -9.81])
UPRIGHT = np.array([1.0, 0, 0, 0])
TIES = {
    "body_a": [0, 2, 1, WORLD],
    "point_a": [(0.3, -0.1, 0.2), (0.1, 0.4, -0.2), (-0.2, 0.0, 0.1), (2.0, 1.0, -1.0)],
    "body_b": [1, 0, 2, 1],
    "point_b": [(0.0, 0.2, -0.5), (0.2, 0.1, 0.3), (0.1, -0.3, 0.0), (0.1, 0.2, 0.3)],
}
"""Three springs between bodies and one to an anchor. Each body is at an end A and at an end B, and at several."""
STIFFNESS, REST, DAMPING = (
    np.array([30.0, 20.0, 50.0, 40.0]),
    np.array([0.5, 1.0, 0.0, 2.0]),
    np.array([1.0, 2.0, 0.5, 3.0]),
)


def random_state(seed, *batch, bodies=3):
    rng = np.random.default_rng(seed)
    orientation = rng.normal(size=(*batch, bodies, 4))
    orientation /= np.linalg.norm(orientation, axis=-1, keepdims=True)
    position, velocity, spin = rng.normal(size=(3, *batch, bodies, 3))
    return position, orientation, velocity, spin


def at_rest(position):
    position = np.array(position, dtype=float)
    still = np.zeros_like(position)
    return position, np.tile(UPRIGHT, (len(position), 1)), still, still


def first_three(ties):
    """The ties without the anchor."""
    return {name: value[:3] for name, value in ties.items()}


def ends(state, ties=TIES):
    place_a, _ = point_motion(state, ties["body_a"], ties["point_a"])
    place_b, _ = point_motion(state, ties["body_b"], ties["point_b"])
    return place_a, place_b


def moved(state, time):
    """The bodies after they have flown and turned with the velocities that they have."""
    position, orientation, velocity, spin = state
    return position + time * velocity, turned(orientation, time * spin), velocity, spin


def test_springs_between_bodies_change_no_momentum_and_no_angular_momentum():
    state = random_state(1)
    force, torque = spring_forces(state, **first_three(TIES), stiffness=STIFFNESS[:3], rest_length=0.5, damping=2.0)
    assert np.min(np.linalg.norm(force, axis=-1)) > 1  # N
    assert force.sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-13)  # roundings of some 100 N
    assert (np.cross(state[0], force) + torque).sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-13)


def test_the_power_of_springs_is_the_energy_they_lose_and_dampers_waste():
    state, h = random_state(2), 1e-5
    force, torque = spring_forces(state, **TIES, stiffness=STIFFNESS, rest_length=REST, damping=DAMPING)
    power = np.sum(force * state[2]) + np.sum(torque * state[3])
    (before_a, before_b), (after_a, after_b) = ends(moved(state, -h)), ends(moved(state, h))
    stored = spring_energy(after_a, after_b, STIFFNESS, REST) - spring_energy(before_a, before_b, STIFFNESS, REST)
    lengthening = np.linalg.norm(after_a - after_b, axis=-1) - np.linalg.norm(before_a - before_b, axis=-1)
    wasted = np.sum(DAMPING * (lengthening / (2 * h)) ** 2)
    assert abs(wasted) > 1  # W
    assert power == pytest.approx(-stored.sum() / (2 * h) - wasted, rel=1e-7)  # h² and rounding over h


def test_a_point_of_a_body_moves_as_it_flies_and_turns():
    state, h = random_state(3), 1e-5
    place, velocity = point_motion(state, TIES["body_a"], TIES["point_a"])
    after, before = (ends(moved(state, time))[0] for time in (h, -h))
    assert velocity == pytest.approx((after - before) / (2 * h), abs=1e-8)
    assert np.array_equal(place[3], TIES["point_a"][3])  # the anchor
    assert np.array_equal(velocity[3], np.zeros(3))


def test_a_body_tied_off_its_centre_swings_with_its_effective_mass():
    # A spring along x that is tied at the height r above the centre feels the mass 1/(1/m + r²/I).
    mass, size, r, stiffness, rest = 2.0, np.array([0.6, 0.2, 0.4]), 0.15, 50.0, 30.0
    moments = box_inertia(mass, size)
    rate = math.sqrt(stiffness * (1 / mass + r**2 / moments[1]))
    dt, count = 2 * math.pi / rate / 100, 100
    tie = {"body_a": [0], "point_a": [(0, 0, r)], "body_b": [WORLD], "point_b": [(-rest, 0, r)]}
    position, orientation, velocity, spin = at_rest([(1e-4, 0, 0)])
    stretch = []
    for _ in range(count):
        state = position, orientation, velocity, spin
        stretch.append(float(point_motion(state, [0], tie["point_a"])[0][0, 0]))
        force, torque = spring_forces(state, **tie, stiffness=stiffness, rest_length=rest)
        velocity = velocity + dt * force / mass
        spin = spin + dt * (world_inverse_inertia(moments, orientation) @ torque[..., None])[..., 0]
        position = position + dt * velocity
        orientation, spin = turn_freely(orientation, spin, moments, dt)
    expected = 1e-4 * np.cos(rate * dt * np.arange(count))
    assert stretch == pytest.approx(expected, abs=4e-6)  # Euler's step is ω dt/2 = 3 % of the amplitude off


def test_a_body_hung_from_a_spring_is_a_double_pendulum():
    # Its centre is at d below the tie, and the tie is at l below the anchor. With x of the centre and the angle a,
    # m x¨ = -(m g/l)(x + d a),  I a¨ = -(m g d/l)(x + d a) - m g d a. It swings up and down with k, and twists freely.
    mass, d, length, stiffness, g = 2.0, 0.3, 0.5, 4000.0, 9.81
    moments = box_inertia(mass, (0.6, 0.2, 0.5))
    tie = {"body_a": [WORLD], "point_a": [(0, 0, d + length)], "body_b": [0], "point_b": [(0, 0, d)]}

    def loads(shift, turn):
        state = (shift[None], turned(UPRIGHT, turn)[None], np.zeros((1, 3)), np.zeros((1, 3)))
        spring = spring_forces(state, **tie, stiffness=stiffness, rest_length=length - mass * g / stiffness)
        return np.concatenate(np.sum([spring, gravity_forces(state, [mass], (0, 0, -g))], axis=0), axis=None)

    assert loads(np.zeros(3), np.zeros(3)) == pytest.approx(np.zeros(6), abs=1e-11)  # in balance
    h = 1e-5
    steps = [(h * row[:3], h * row[3:]) for row in np.eye(6)]
    stiff = -np.array([(loads(*step) - loads(*(-part for part in step))) / (2 * h) for step in steps]).T
    inertia = np.array([mass, mass, mass, *moments])
    found = np.sort(np.linalg.eigvals(stiff / inertia[:, None]).real)
    expected, m_g_d = [0.0, stiffness / mass], mass * g * d
    for moment in moments[:2]:
        swing = np.array([[g / length, g * d / length], [m_g_d / (length * moment), m_g_d * (1 + d / length) / moment]])
        expected.extend(np.linalg.eigvals(swing))
    assert found == pytest.approx(np.sort(expected), rel=1e-6, abs=1e-6)  # h² and rounding over h


def test_a_damped_pair_keeps_its_momenta_and_loses_what_its_damper_wastes():
    mass, moments = np.array([1.0, 3.0]), np.array([[0.02, 0.05, 0.04], [0.3, 0.1, 0.2]])
    tie = {"body_a": [0], "point_a": [(0.2, 0.1, 0)], "body_b": [1], "point_b": [(0, -0.3, 0.4)]}
    stiffness, rest, damping, dt, count = 40.0, 0.8, 3.0, 1e-3, 150
    position, orientation, velocity, spin = random_state(8, bodies=2)

    def account():
        inertia = np.linalg.inv(world_inverse_inertia(moments, orientation))
        own = (inertia @ spin[..., None])[..., 0]
        linear = mass[:, None] * velocity
        stored = spring_energy(*ends((position, orientation, velocity, spin), tie), stiffness, rest)
        energy = (np.sum(linear * velocity) + np.sum(own * spin)) / 2 + stored.sum()
        return np.concatenate([linear.sum(axis=0), (np.cross(position, linear) + own).sum(axis=0)]), energy

    def push(share):
        state = position, orientation, velocity, spin
        force, torque = spring_forces(state, **tie, stiffness=stiffness, rest_length=rest, damping=damping)
        turn = (world_inverse_inertia(moments, orientation) @ torque[..., None])[..., 0]
        return velocity + share * dt * force / mass[:, None], spin + share * dt * turn

    (momenta, energy), lengths = account(), []
    for _ in range(count):
        lengths.append(np.linalg.norm(np.subtract(*ends((position, orientation, velocity, spin), tie))))
        velocity, spin = push(0.5)
        position = position + dt * velocity
        orientation, spin = turn_freely(orientation, spin, moments, dt)
        velocity, spin = push(0.5)
    lengths.append(np.linalg.norm(np.subtract(*ends((position, orientation, velocity, spin), tie))))
    wasted = damping * np.sum(np.diff(lengths) ** 2) / dt  # the integral of c L̇², by midpoints
    momenta_after, energy_after = account()
    assert momenta_after == pytest.approx(momenta, abs=1e-12)
    assert wasted > 0.1 * energy
    assert energy - energy_after == pytest.approx(wasted, rel=2e-3)  # of first order in dt; 1.5e-3 measured


def catenary():
    """Five nodes between two anchors on one curve, with weights that balance it, and springs that fit.

    Across each link the horizontal pull is the same, H, and the vertical one changes by the weight of the node between.
    """
    weight, across, pull = np.array([1.0, 2.0, 0.5, 3.0, 1.5]), np.array([0.3, 0.5, 0.2, 0.4, 0.3, 0.5]), 4.0
    vertical = -3.0 + np.concatenate([[0.0], np.cumsum(weight)])
    step = np.stack([across, 0.2 * across, across * math.hypot(1, 0.2) * vertical / pull], axis=-1)
    place = np.cumsum(np.vstack([(0.5, -1.0, 2.0), step]), axis=0)
    length, tension = np.linalg.norm(step, axis=-1), np.hypot(pull, vertical)
    stiffness = np.array([50.0, 80.0, 60.0, 90.0, 70.0, 40.0])
    return place, weight / 9.81, stiffness, length - tension / stiffness


def test_a_hanging_chain_of_bodies_is_in_balance_on_the_catenary():
    place, mass, stiffness, rest = catenary()
    body = np.array([4, 0, 3, 1, 2])  # along the chain; bodies in another order
    position = np.empty((5, 3))
    position[body] = place[1:-1]
    masses = np.empty(5)
    masses[body] = mass
    state, tied = at_rest(position), np.concatenate([[WORLD], body, [WORLD]])
    points = np.where((tied == WORLD)[:, None], place, 0.0)
    springs = spring_forces(state, tied[:-1], points[:-1], tied[1:], points[1:], stiffness, rest)
    force, torque = np.sum([springs, gravity_forces(state, masses, GRAVITY)], axis=0)
    assert force == pytest.approx(np.zeros((5, 3)), abs=1e-13)  # roundings of 6 N
    assert torque == pytest.approx(np.zeros((5, 3)), abs=1e-13)


def test_a_mesh_of_bodies_is_in_balance_on_the_catenary():
    place, mass, stiffness, rest = catenary()
    links = np.stack([np.arange(6), np.arange(1, 7)], axis=-1)
    mesh = SpringMesh(links, rest, stiffness, np.array(2.0), np.array([np.inf, *mass, np.inf]), np.array(False))
    body = np.array([7, 4, 0, 3, 1, 2, 5])  # body 6 belongs to no node
    position, masses = np.full((8, 3), 9.0), np.ones(8)
    position[body], masses[body] = place, mesh.mass
    state = at_rest(position)
    force, torque = np.sum([mesh_body_forces(state, mesh, body), gravity_forces(state, masses, GRAVITY)], axis=0)
    assert force[body[1:-1]] == pytest.approx(np.zeros((5, 3)), abs=1e-13)  # roundings of 6 N
    assert force[6] == pytest.approx(GRAVITY)
    assert -force[[7, 5], 2].sum() == pytest.approx(mass.sum() * 9.81)  # the two ends carry the whole weight
    assert np.array_equal(torque, np.zeros((8, 3)))


def test_bodies_on_springs_rest_where_a_mesh_of_nodes_does():
    place, mass, stiffness, _ = catenary()
    links = np.stack([np.arange(6), np.arange(1, 7)], axis=-1)
    mesh = spring_mesh(place, links, stiffness, 0.0, [np.inf, *mass, np.inf])
    shape = static_shape(mesh, place, GRAVITY, tolerance=1e-10)
    state = at_rest(shape)
    ties = links[:, 0], np.zeros((6, 3)), links[:, 1], np.zeros((6, 3)), stiffness, mesh.rest_length
    force = (spring_forces(state, *ties)[0] + gravity_forces(state, mesh.mass, GRAVITY)[0])[1:-1]
    assert force == pytest.approx(np.zeros((5, 3)), abs=1e-9)  # what static_shape leaves of the weight of 3 N


def test_mesh_dampers_resist_bodies_as_dampers_between_their_centres_do():
    state = random_state(4, bodies=4)
    edges, body, centres = np.array([(0, 1), (2, 1)]), np.array([3, 0, 2]), np.zeros((2, 3))
    mesh = SpringMesh(
        edges, np.array([0.5, 0.1]), np.array([7.0, 9.0]), np.array([2.0, 3.0]), np.ones(3), np.array(False)
    )
    expected = spring_forces(
        state, body[edges[:, 0]], centres, body[edges[:, 1]], centres, mesh.stiffness, mesh.rest_length, mesh.damping
    )
    force, torque = mesh_body_forces(state, mesh, body)
    assert force == pytest.approx(expected[0], abs=1e-14)
    assert torque == pytest.approx(expected[1], abs=1e-14)
    with pytest.raises(ValueError, match="twice"):
        mesh_body_forces(state, mesh, [3, 0, 3])
    with pytest.raises(ValueError, match="from 0 to 3"):
        mesh_body_forces(state, mesh, [3, 0, WORLD])


def test_a_ball_sinks_through_a_thick_fluid_at_its_terminal_velocity():
    radius, density, fluid, viscosity = np.array([1e-3, 2e-3]), np.array([7800.0, 1100.0]), 1260.0, 1.4
    ball = 4 / 3 * np.pi * radius**3
    current = np.array([0.02, -0.01, 0.003])
    position, orientation, _, spin = random_state(6, bodies=2)
    velocity = current + 2 / 9 * ((density - fluid) * radius**2 / viscosity)[:, None] * GRAVITY  # Stokes
    state = position, orientation, velocity, spin
    weight, lift = gravity_forces(state, density * ball, GRAVITY), buoyancy_forces(state, ball, fluid, GRAVITY)
    drag = drag_forces(state, current, viscosity, radius)
    force, torque = np.sum([weight, lift, drag], axis=0)
    assert force == pytest.approx(np.zeros((2, 3)), abs=1e-12 * np.max(np.abs(weight[0])))
    assert np.array_equal(torque, np.zeros((2, 3)))


def test_a_ball_falls_through_a_wind_at_its_terminal_velocity():
    mass, area, density = np.array([0.1, 0.5]), np.array([0.01, 0.03]), 1.2
    wind = np.array([(3.0, -1.0, 0.5), (0.0, 2.0, 0.0)])
    position, orientation, _, spin = random_state(7, bodies=2)
    velocity = wind - np.sqrt(2 * mass * 9.81 / (density * 0.47 * area))[:, None] * (0, 0, 1)
    state = position, orientation, velocity, spin
    force, torque = np.sum(
        [gravity_forces(state, mass, GRAVITY), wind_forces(state, wind, area, 0.47, density)], axis=0
    )
    assert force == pytest.approx(np.zeros((2, 3)), abs=1e-13)  # roundings of 5 N
    assert np.array_equal(torque, np.zeros((2, 3)))


def test_gravity_pulls_no_immovable_body():
    force, torque = gravity_forces(at_rest(np.ones((2, 3))), [2.0, np.inf], GRAVITY)
    assert np.array_equal(force, [2 * GRAVITY, np.zeros(3)])
    assert np.array_equal(torque, np.zeros((2, 3)))


def test_scenes_side_by_side_feel_what_each_feels_alone():
    state = random_state(5, 2, 3)
    together = spring_forces(state, **TIES, stiffness=STIFFNESS, rest_length=REST, damping=DAMPING)
    for scene in np.ndindex(2, 3):
        alone = tuple(part[scene] for part in state)
        one = spring_forces(alone, **TIES, stiffness=STIFFNESS, rest_length=REST, damping=DAMPING)
        for whole, part in zip(together, one, strict=True):
            assert whole[scene] == pytest.approx(part, abs=1e-13)


def test_one_force_acts_on_scenes_side_by_side():
    position, *motion = random_state(5, 2)
    force, torque = forces_at_points(
        (position, *motion), [1, 1], position[:, [1, 1]] + (0, 0, 1), [(1.0, 0, 0), (3.0, 2.0, 0)]
    )
    assert np.array_equal(force[:, 1], [(4.0, 2.0, 0)] * 2)
    assert torque[:, 1] == pytest.approx(np.array([(-2.0, 4.0, 0)] * 2), abs=1e-14)
    assert np.array_equal(force[:, [0, 2]], np.zeros((2, 2, 3)))


def test_a_force_at_a_point_turns_a_body_and_the_world_takes_none():
    state = at_rest([(1.0, 2.0, 3.0), (0, 0, 0)])
    force, torque = forces_at_points(state, [0, WORLD], [(1.0, 2.5, 3.0), (5.0, 5.0, 5.0)], [(2.0, 0, 0), (7.0, 0, 0)])
    assert np.array_equal(force, [(2.0, 0, 0), (0, 0, 0)])
    assert np.array_equal(torque, [(0, 0, -1.0), (0, 0, 0)])


def test_a_spring_of_no_rest_length_pulls_in_proportion_to_its_length():
    # Neither a rest length nor a damping is given
    state = random_state(9)
    force, torque = spring_forces(state, [0], [(0, 0, 0)], [WORLD], [(1.0, 2.0, -1.0)], 30.0)
    np.testing.assert_allclose(force[0], 30 * (np.array([1.0, 2.0, -1.0]) - state[0][0]), rtol=1e-14)
    assert not torque.any()


@pytest.mark.parametrize(
    ("change", "match"),
    [
        ({"body_a": [0, 2, 3, WORLD]}, "from -1 to 2"),
        ({"body_b": [0, 2, 1, -2]}, "from -1 to 2"),
        ({"body_a": [0.0, 2.0, 1.0, 1.0]}, "whole numbers"),
        ({"point_a": np.full((4, 3), np.nan)}, "point"),
        ({"stiffness": -1.0}, "stiffness"),
    ],
)
def test_a_spring_between_what_does_not_exist_is_refused(change, match):
    with pytest.raises(ValueError, match=match):
        spring_forces(random_state(9), **{**TIES, "stiffness": STIFFNESS, **change})
