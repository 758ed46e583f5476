"""What every engine that reports contacts promises of them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from engine_grid import REPORT_CONTACTS, Cell

from reference.scene import geometry
from reference.scene.scenario import GRAVITY, Body, Box, HalfSpace, Sphere
from reference.scene.trajectory import Trajectory

from .run import Promise, Run

RESTING = ("sliding-slab", "incline", "lying-box", "stack")
CHECKED = 60
"""Samples of a trajectory, shared among its pairs, at which the gap is worked out."""


def contacts_are_of_listed_pairs_with_a_normal_from_b_to_a(run: Run) -> None:
    trajectory, contacts, bodies = run.trajectory, run.trajectory.contacts, run.scenario.bodies
    listed = {frozenset((pair.body_a, pair.body_b)) for pair in run.scenario.pairs}
    if run.cell.scenario in RESTING:
        assert len(contacts.sample) >= len(trajectory.times) - 1, "a box on a plane has a contact at every sample"
    np.testing.assert_allclose(np.linalg.norm(contacts.normal, axis=1), 1, atol=1e-12)
    for a, b, here in pairs_in_contact(trajectory):
        assert {bodies[a].name, bodies[b].name} in listed
        for plane, sense in ((b, 1), (a, -1)):
            if isinstance(bodies[plane].shape, HalfSpace):  # nothing but rounding
                expected = np.broadcast_to(sense * np.array(bodies[plane].shape.normal), (here.sum(), 3))
                np.testing.assert_allclose(contacts.normal[here], expected, atol=1e-12)
        if not isinstance(bodies[a].shape, HalfSpace):
            # Of two convex bodies, one lies on the normal's side of the other; a fast one passes in a step.
            samples = contacts.sample[here]
            apart = trajectory.positions[samples, a] - trajectory.positions[samples, b]
            across = np.sum(apart * contacts.normal[here], axis=1)
            assert np.all(across > -travel(trajectory, a, b)[samples])


def a_contacts_separation_is_the_gap_of_the_step_that_found_it(run: Run) -> None:
    trajectory, contacts = run.trajectory, run.trajectory.contacts
    touching = pairs_in_contact(trajectory)
    for a, b, here in touching:
        # A contact is found before its step moves the bodies; no point of them is faster than at the samples
        # around it. 1 µm: a box that rocks, seen at its corners. Where a step does more than the speeds say, the gap is
        # that of the sample before, to rounding.
        near, before = travel(trajectory, a, b) + 1e-6, 0
        if moves_overlaps_away(run.cell):
            assert run.settings.sample_every == 1
            near, before = np.full(len(trajectory.times), 1e-12), 1
        samples = np.unique(contacts.sample[here])
        for sample in samples[:: max(1, len(samples) * len(touching) // CHECKED)]:
            now = here & (contacts.sample == sample)
            gap = geometry.gap(placed(trajectory, a, sample - before), placed(trajectory, b, sample - before))
            assert contacts.separation[now].min() == pytest.approx(gap, abs=near[sample])
        for place in (a, b):
            if isinstance(ball := run.scenario.bodies[place].shape, Sphere):  # midway: half the gap off its surface
                centres = trajectory.positions[contacts.sample[here] - before, place]
                off = np.linalg.norm(contacts.position[here] - centres, axis=1)
                expected = ball.radius + contacts.separation[here] / 2
                np.testing.assert_array_less(np.abs(off - expected), near[contacts.sample[here]])
        for plane in (a, b):
            if isinstance(run.scenario.bodies[plane].shape, HalfSpace):
                normal = np.array(run.scenario.bodies[plane].shape.normal)
                height = (contacts.position[here] - run.scenario.bodies[plane].position) @ normal
                # Midway between the surfaces: half the gap above the plane. Rounding of some 1e-16 of metres.
                above = 1e-12 + point_off(run, a, b, here)
                np.testing.assert_array_less(np.abs(height - contacts.separation[here] / 2), above)


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


def travel(trajectory: Trajectory, a: int, b: int) -> np.ndarray:
    """How far two surfaces may have come towards each other in the step before each sample, m."""
    settings = trajectory.settings
    speeds = surface_speed(trajectory, a) + surface_speed(trajectory, b)
    gained = GRAVITY * settings.timestep * settings.sample_every
    return (np.maximum(np.roll(speeds, 1), speeds) + gained) * settings.timestep


def moves_overlaps_away(cell: Cell) -> bool:
    """Whether Bullet moves a ball farther than its speed does: 15.6 mm of overlap with a heavy ball go in one step."""
    return cell.engine == "pybullet" and cell.scenario == "mass-ratios"


def point_off(run: Run, a: int, b: int, here: np.ndarray) -> float:
    """How far the points of a box on a plane may be from where their depth is, m: as far as its deepest corner is in.

    Of a box that leans, DART's detectors give the depth of one corner and a point between it and others.
    """
    box = any(isinstance(run.scenario.bodies[place].shape, Box) for place in (a, b))
    deepest = 1.1 * np.abs(run.trajectory.contacts.separation[here]).max()
    return float(deepest) if run.cell.engine == "dart" and box else 0.0


def reports_contacts(cell: Cell) -> bool:
    """Whether the engine reports contacts, and of the solid that the scenario has.

    As installed PyBullet and MuJoCo have the hull of a bowl, and DART gives depths in it a wrong sign;
    `test_ball_in_a_bowl` looks at these contacts.
    """
    another_shape = cell.scenario == "ball-in-a-bowl" and cell.profile == "stock"
    return cell.engine in REPORT_CONTACTS and not another_shape


PROMISES = (
    Promise(contacts_are_of_listed_pairs_with_a_normal_from_b_to_a, reports_contacts),
    Promise(a_contacts_separation_is_the_gap_of_the_step_that_found_it, reports_contacts),
)
