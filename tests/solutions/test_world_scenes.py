"""Boxes that stand, fall over, tip and carry: scenes of the hand-written world whose end follows from statics."""

from __future__ import annotations

import numpy as np
import pytest
from world_scenes import DOWN, FLOOR, GRAVITY, Thing, energy, scene, turn

from solutions.impulse import rotation_matrix
from solutions.world.bodies import State
from solutions.world.contacts import find_contacts
from solutions.world.rotation import quaternion_product
from solutions.world.rules import Rules
from solutions.world.run import run_world

MM = 1e-3
SLOP = Rules().slop


def tower(masses, seed):
    """Boxes one upon another, each a little beside the last, of another height and turned about z."""
    rng, boxes, top = np.random.default_rng(seed), [], 0.0
    for mass in masses:
        half = np.array([0.25, 0.2, 0.1 * rng.uniform(0.8, 1.2)])
        place = (*rng.uniform(-0.02, 0.02, 2), top + half[2])
        boxes.append(Thing(("box", half), mass, place, turn((0, 0, 1), rng.uniform(-0.5, 0.5))))
        top += 2 * half[2]
    return boxes


@pytest.mark.slow
def test_three_unequal_boxes_stand_for_two_seconds():
    bodies, start = scene([FLOOR, *tower((3, 1, 2), 0)], friction=0.5)
    end = run_world(bodies, start, DOWN, 1 / 60, 120)
    moved = np.abs(end.position - start.position)
    # Each contact may sink by the slop. Sideways, a contact whose impulses are found to 1e-6 creeps by micrometres.
    assert np.max(moved[..., 2]) < 3 * SLOP
    assert np.max(moved[..., :2]) < 0.02 * MM
    np.testing.assert_allclose(end.orientation[-1], start.orientation, atol=1e-4)
    assert np.max(np.abs(end.velocity[-1])) < 1e-6


# The longest step leaves the most in one, and the shortest with the fewest sweeps creeps in the most steps.
@pytest.mark.parametrize(
    ("dt", "sweeps"),
    [pytest.param(1 / 60, 50, marks=pytest.mark.slow), pytest.param(1 / 240, 10, marks=pytest.mark.weekly)],
)
def test_ten_unequal_boxes_stand_for_thirty_seconds(dt, sweeps):
    masses = np.random.default_rng(1).uniform(1, 3, 10)
    bodies, start = scene([FLOOR, *tower(masses, 0)], friction=0.5)
    steps = round(30 / dt)
    end = run_world(bodies, start, DOWN, dt, steps, Rules(sweeps=sweeps), every=steps // 15)
    moved = end.position - start.position
    assert np.max(np.abs(moved)) < 1 * MM  # ten contacts sink by the slop of 0.1 mm each, and no box creeps farther
    assert np.max(np.abs(end.position[-1] - end.position[1])) < 0.5 * MM  # what the first two seconds leave
    assert np.max(np.abs(end.velocity[-1])) < 1e-4


HALF = np.array([0.3, 0.2, 0.1])
BALANCE = np.arctan2(HALF[0], HALF[2])
"""By how much a box of these half edges leans about its own y axis when its centre is above its edge, rad."""


@pytest.mark.slow
def test_a_box_dropped_on_an_edge_or_corner_falls_to_its_centres_side():
    leans = [BALANCE - 0.3, BALANCE - 0.1, BALANCE + 0.1, BALANCE + 0.3]
    things = []
    for group, (lean, roll) in enumerate((lean, roll) for lean in leans for roll in (0.0, 0.25)):
        pose = quaternion_product(turn((1, 0, 0), roll), turn((0, 1, 0), lean))
        pose = quaternion_product(turn((0, 0, 1), 0.4 + group), pose)
        lowest = np.abs(rotation_matrix(pose)[2]) @ HALF
        things += [FLOOR._replace(group=group), Thing(("box", HALF), 1.7, (group, 2, lowest + 0.02), pose, group=group)]
    bodies, start = scene(things, friction=0.6, restitution=0.2)
    end = run_world(bodies, start, DOWN, 1 / 50, 110, every=110)
    position, velocity, spin = (each[-1, 1::2] for each in (end.position, end.velocity, end.angular_velocity))
    upward = rotation_matrix(end.orientation[-1, 1::2])[:, 2]
    on_its_end = np.repeat(np.array(leans) > BALANCE, 2)
    # An overlap of up to the slop at one side leaves a lean of the slop over an edge of 0.2 m.
    expected = np.where(on_its_end[:, None], (-1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    np.testing.assert_allclose(upward, expected, atol=SLOP / 0.2 * 1.2)
    np.testing.assert_allclose(position[:, 2], np.where(on_its_end, HALF[0], HALF[2]), atol=SLOP * 1.01)
    assert np.max(np.abs(velocity)) < 1e-6
    assert np.max(np.abs(spin)) < 1e-5  # the last of them to fall still settles by micrometres


def on_slope(slope, across, half, group, heading=0.7):
    """A half-space whose slope (rad) descends in a heading, and a box on it, turned on it by `across`."""
    ground = quaternion_product(turn((0, 0, 1), heading), turn((0, 1, 0), slope))
    normal = rotation_matrix(ground)[:, 2]
    pose = quaternion_product(ground, turn((0, 0, 1), across))
    return [
        Thing(("half-space", tuple(normal)), group=group),
        Thing(("box", half), 2.0, half[2] * normal, pose, group=group),
    ], normal


@pytest.mark.slow
def test_a_box_tips_beyond_the_textbook_ratio_if_friction_holds_it():
    """The line of weight through the centre leaves the face, over an edge at the angle ψ to the slope.

    That happens at tan θ cos ψ = b/h. With less friction than tan θ the box slides, and the normal force that it then
    needs lies within the face.
    """
    half, across = np.array([0.2, 0.3, 0.4]), 0.3
    ratio = half[0] / half[2] / np.cos(across)
    cases = [(share, rough) for share in (0.995, 1.005) for rough in (1, 2)]
    things, normals = [], []
    for group, (share, _) in enumerate(cases):
        pair, normal = on_slope(np.arctan(share * ratio), across, half, group)
        things, normals = things + pair, [*normals, normal]
    friction = np.array([[0, 0.3, 0.7], [0.3, 0, 0], [0.7, 0, 0]])  # 0.3 < b/h = 0.5 < 0.52 = tan θ < 0.7
    bodies, start = scene(things, friction=friction, material=np.ravel([(0, rough) for _, rough in cases]))
    end = run_world(bodies, start, DOWN, 1 / 40, 100, every=50)
    leant = np.arccos(np.clip(np.vecdot(rotation_matrix(end.orientation[:, 1::2])[..., 2], normals), -1, 1))
    way = np.linalg.norm(end.position[-1, 1::2] - start.position[1::2], axis=-1)
    slides, holds, slides_beyond, tips = range(4)
    assert leant[1, tips] > 0.05  # half a percent beyond the edge takes about a second and a half to be seen
    assert leant[2, tips] == pytest.approx(np.pi / 2, abs=1e-3)
    np.testing.assert_allclose(leant[:, [slides, holds, slides_beyond]], 0, atol=1e-4)
    assert way[holds] < 1e-6
    slope = np.arctan([cases[slides][0] * ratio, cases[slides_beyond][0] * ratio])
    # Semi-implicit steps add half a step to the time: a t (t + dt)/2.
    expected = GRAVITY * (np.sin(slope) - 0.3 * np.cos(slope)) * 2.5 * (2.5 + 1 / 40) / 2
    np.testing.assert_allclose(way[[slides, slides_beyond]], expected, rtol=1e-6)


def loaded(ratio):
    """A box of 1 kg, and upon it one that is so many times heavier and not quite above it."""
    return [
        FLOOR,
        Thing(("box", (0.2, 0.15, 0.1)), 1.0, (0, 0.03, 0.1), turn((0, 0, 1), 0.2)),
        Thing(("box", (0.25, 0.2, 0.2)), ratio, (0.02, -0.02, 0.4), turn((0, 0, 1), -0.3)),
    ]


@pytest.mark.slow
def test_a_box_carries_one_a_hundred_times_heavier():
    bodies, start = scene(loaded(100.0), friction=0.4)
    end = run_world(bodies, start, DOWN, 1 / 240, 120)
    # Fifty sweeps from nothing do not find the weight of 100 kg; until later steps have found it, the light box sinks.
    assert np.min(end.position[:, 1:, 2] - start.position[1:, 2]) > -1 * MM
    assert np.max(np.abs(end.velocity[-1])) < 0.01


@pytest.mark.weekly
def test_a_box_carries_one_a_thousand_times_heavier_in_more_sweeps():
    """Each sweep moves a share of about 1/1000 of the weight on to the floor, so that 50 sweeps are far too few."""
    bodies, start = scene(loaded(1000.0), friction=0.4)
    end = run_world(bodies, start, DOWN, 1 / 60, 120, Rules(sweeps=2000))
    assert np.min(end.position[:, 1:, 2] - start.position[1:, 2]) > -1.5 * MM
    too_few = run_world(bodies, start, DOWN, 1 / 60, 120)
    assert np.min(too_few.position[:, 2, 2] - start.position[2, 2]) < -40 * MM


@pytest.mark.slow
def test_all_at_once_a_thousandfold_load_does_not_sink():
    bodies, start = scene(loaded(1000.0), friction=0.4)
    end = run_world(bodies, start, DOWN, 1 / 60, 30, Rules(response="simultaneous"))
    np.testing.assert_allclose(end.position[-1], start.position, atol=1e-7)  # weight alone moves it by 2.7 mm in a step


def pile(count, seed):
    """Balls, boxes and capsules, one over another, between four walls that stand askew."""
    rng, things = np.random.default_rng(seed), [FLOOR]
    for number in range(count):
        shape = [
            ("sphere", rng.uniform(0.1, 0.2)),
            ("box", rng.uniform(0.08, 0.2, 3)),
            ("capsule", rng.uniform(0.06, 0.12), rng.uniform(0.08, 0.2)),
        ][number % 3]
        pose = rng.normal(size=4)
        place = (*rng.uniform(-0.35, 0.35, 2), 0.4 + 0.22 * number)
        pose /= np.linalg.norm(pose)
        things.append(Thing(shape, rng.uniform(0.5, 3), place, pose, spin=rng.normal(size=3)))
    for angle in 0.3 + np.pi / 2 * np.arange(4):
        normal = np.array([np.cos(angle), np.sin(angle), 0])
        things.append(Thing(("half-space", tuple(normal)), position=-0.6 * normal))
    return things


@pytest.mark.slow
def test_a_pile_of_thirty_mixed_shapes_comes_to_rest():
    bodies, start = scene(pile(30, 5), friction=0.5, restitution=0.1)
    end = run_world(bodies, start, DOWN, 1 / 60, 600, every=60)
    dropped = np.sum(energy(bodies, start, GRAVITY)) - np.sum(energy(bodies, end, GRAVITY)[-1])
    assert dropped > 500
    assert np.sum(energy(bodies, end)[-1]) < 1e-6 * dropped
    contacts = find_contacts(bodies, State(*(each[-1] for each in end)))
    assert len(contacts.key) > 60
    assert np.min(contacts.separation) > -1.5 * SLOP  # a fifth of what is deeper goes in each step
