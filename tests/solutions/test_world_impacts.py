"""Single impacts in the hand-written world, from where bodies touch to how they part, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from world_scenes import FLOOR_NORMAL, GRAVITY, Thing, energy, scene, turn

from reference.impact_truth import DISSIPATIVE, NEWTON, POISSON, STRONGE, Contact, planar_impact
from reference.truth import balls_after, impact_impulse, rod_softness, spinning_impact
from solutions.friction import point_inverse_mass, poisson_impulse
from solutions.impulse import rotation_matrix, world_inverse_inertia
from solutions.world.rotation import quaternion_product
from solutions.world.rules import Rules
from solutions.world.run import run_world
from solutions.world.step import advance_world

TOUCHING = Rules(rest_speed=0.0, recovery=0.0, sweeps=500, tolerance=1e-14)
"""One step from where bodies touch: any approach rebounds, and nothing is moved out of a rounding of overlap."""

FREE = (0.0, 0.0, 0.0)  # no weight
ROUNDING = 1e-9
"""Of speeds of order 1: the shapes touch to some 1e-16 m, sweeps end at 1e-14 of the impulse, and arms are short."""


def placed_at(pose, place, shift):
    return tuple(rotation_matrix(pose) @ np.asarray(place) + shift)


@pytest.mark.parametrize("peg", ["capsule", "edge of a box"])
def test_a_rod_that_falls_across_a_peg_leaves_it_as_the_closed_form(peg):
    half, mass, speed, arms, e = np.array([0.5, 0.04, 0.03]), 1.3, 2.0, (0.37, -0.2, 0.05), (0.6, 0.0, 1.0)
    things = []
    for group, arm in enumerate(arms):
        pose, shift = turn((1, 2 - group, 3), 0.8 + group), np.array([0.3, -group, 2.0])
        down = -speed * rotation_matrix(pose)[:, 2]
        things.append(Thing(("box", half), mass, shift, pose, tuple(down), group=group))
        if peg == "capsule":
            shape, depth, across = ("capsule", 0.02, 0.3), 0.02, turn((1, 0, 0), np.pi / 2)
        else:
            shape, depth, across = ("box", (0.05, 0.3, 0.05)), 0.05 * np.sqrt(2), turn((0, 1, 0), np.pi / 4)
        place = placed_at(pose, (arm, 0, -half[2] - depth), shift)
        things.append(Thing(shape, np.inf, place, quaternion_product(pose, across), group=group))
    rebound = np.zeros((4, 4))
    rebound[3, :3] = rebound[:3, 3] = e
    bodies, start = scene(things, material=[0, 3, 1, 3, 2, 3], restitution=rebound)
    end, _, _ = advance_world(bodies, start, FREE, 1e-4, TOUCHING)
    for group, (arm, each) in enumerate(zip(arms, e, strict=True)):
        along = rotation_matrix(start.orientation[2 * group])
        impulse = impact_impulse(speed, each, rod_softness(mass, arm, half[0], half[2]))
        spin = -arm * impulse / (mass / 3 * (half[0] ** 2 + half[2] ** 2))
        np.testing.assert_allclose(end.velocity[2 * group], (impulse / mass - speed) * along[:, 2], atol=ROUNDING)
        # A step of 1e-4 s also turns the rod, which changes the spin of an odd body; about a main axis it does not.
        np.testing.assert_allclose(end.angular_velocity[2 * group], spin * along[:, 1], atol=ROUNDING)


def test_balls_part_off_axis_as_the_closed_form_and_equal_ones_at_90_degrees():
    offsets, masses, e = np.array([0.15, 0.5, 0.8, 0.5, 0.7]), (0.7, 0.7, 0.7, 2.0, 0.1), (1.0, 1.0, 1.0, 1.0, 0.4)
    radii, things = (0.12, 0.07), []
    for group, (offset, mass) in enumerate(zip(offsets, masses, strict=True)):
        pose, shift = turn((3, 1, -group), 1.0 + group), np.array([group, 0.5, 1.0])
        apart = sum(radii) * np.array([-np.sqrt(1 - offset**2), offset, 0])
        flight = tuple(3.0 * rotation_matrix(pose)[:, 0])
        things.append(Thing(("sphere", radii[0]), 0.7, placed_at(pose, apart, shift), velocity=flight, group=group))
        things.append(Thing(("sphere", radii[1]), mass, tuple(shift), group=group))
    material = np.repeat([0, 0, 0, 0, 1], 2)
    bodies, start = scene(things, material=material, restitution=[[1.0, 0.0], [0.0, 0.4]])
    end, _, _ = advance_world(bodies, start, FREE, 1e-4, TOUCHING)
    for group, offset in enumerate(offsets):
        plane = rotation_matrix(turn((3, 1, -group), 1.0 + group))[:, :2]
        expected = balls_after(3.0, offset, e[group], 0.7, masses[group])
        found = end.velocity[2 * group : 2 * group + 2]
        np.testing.assert_allclose(found, [plane @ each for each in expected], atol=ROUNDING)
        if group < 3:
            assert abs(found[0] @ found[1]) < ROUNDING


def test_a_spinning_ball_strikes_a_sloping_floor_as_the_closed_form():
    """With enough friction it grips: 2/7 of its surface speed becomes speed along the floor, and as much remains."""
    radius, spin, speed, frictions, e = 0.11, 40.0, 3.0, (0.05, 0.2, 0.9), 0.7
    pose = turn((1, -2, 0.5), 0.6)
    along, across, normal = rotation_matrix(pose).T
    things = [Thing(("half-space", tuple(normal)), position=(0.2, 0, 1))]
    for group in range(3):
        place = things[0].position + radius * normal + group * along
        things.append(
            Thing(("sphere", radius), 0.5 + group, place, velocity=-speed * normal, spin=tuple(spin * across))
        )
    friction = np.zeros((4, 4))
    friction[3, :3] = friction[:3, 3] = frictions
    bodies, start = scene(things, material=[3, 0, 1, 2], friction=friction, restitution=e)
    end, _, _ = advance_world(bodies, start, FREE, 1e-4, TOUCHING)
    for ball, mu in enumerate(frictions, start=1):
        after, surface = spinning_impact(speed, radius * spin, e, mu)
        np.testing.assert_allclose(end.velocity[ball], e * speed * normal + after * along, atol=ROUNDING)
        np.testing.assert_allclose(end.angular_velocity[ball], surface / radius * across, atol=ROUNDING / radius)
    assert after == pytest.approx(2 / 7 * radius * spin)  # the roughest floor grips


ROD = ("capsule", 1e-3, 0.5)
"""A thin rod of 1 m. Its round ends of 1 mm change the closed forms of a line by a few thousandths."""


def rod_on_floor(lean, slip, spin, heading=0.4, mass=1.0):
    """A rod that leans by an angle (rad) from the floor, its foot ahead of its centre and sliding on, without lift."""
    ahead = np.array([np.cos(heading), np.sin(heading), 0.0])
    down = np.cos(lean) * ahead - np.sin(lean) * np.array(FLOOR_NORMAL)
    pose = quaternion_product(turn((0, 0, 1), heading), turn((0, 1, 0), np.pi / 2 + lean))  # its own z runs to the foot
    arm = ROD[2] * down - ROD[1] * np.array(FLOOR_NORMAL)
    side = np.cross(FLOOR_NORMAL, ahead)
    velocity = slip * ahead - np.cross(spin * side, arm)
    floor = Thing(("half-space", FLOOR_NORMAL))
    return [floor, Thing(ROD, mass, -arm, pose, tuple(velocity), tuple(spin * side))], ahead, arm


def press(lean, friction):
    """How much a normal impulse lifts the foot of a thin rod of 1 kg while it slides: 1 + 3 cos θ (cos θ − μ sin θ).

    Friction on a foot ahead of the centre turns the rod into the floor. Beyond μ = 4/3 this may be negative: then the
    harder the floor presses, the faster the foot sinks.
    """
    return 1 + 3 * np.cos(lean) * (np.cos(lean) - friction * np.sin(lean))


@pytest.mark.parametrize("friction", [0.5, 1.2])
def test_a_sliding_rod_is_pressed_by_the_floor_as_newton_and_coulomb_say(friction):
    lean, dt = np.arctan(2.0), 1e-4
    things, ahead, _ = rod_on_floor(lean, 2.0, 0.0)
    bodies, start = scene(things, friction=friction)
    _, memory, _ = advance_world(bodies, start, (0, 0, -GRAVITY), dt)
    force = memory.impulse[0] / dt
    pressed = GRAVITY / press(lean, friction)
    np.testing.assert_allclose(
        force, pressed * (np.array(FLOOR_NORMAL) - friction * ahead), rtol=1e-2
    )  # its round ends


@pytest.mark.parametrize("dt", [1e-2, 1e-3, 1e-5])
@pytest.mark.parametrize("spin", [0.0, 5.5])
def test_painleves_rod_jams_by_an_impact_without_a_collision(dt, spin):
    """At μ = 1.6 and tan θ = 2 no finite force keeps the foot on the floor and lets it slide.

    `press` is negative. Let b be the acceleration of the foot without the floor, ω² l sin θ − g. At rest, b < 0, the
    equation b + press·N = 0 with N ≥ 0 has no solution (Painlevé 1895). At ω = 5.5 rad/s, b > 0, it has two: the foot
    lifts off with N = 0, or it stays with N = −b/press.

    The world looks for impulses, and they exist. In one step, no matter how short, the floor ends the slip: an impact,
    although nothing collides. Lecornu (1905) proposed this, and all step methods with impulses do it. The impulse does
    not shrink with dt. It is that of K J = −u, with the velocity u of the foot, and it lies within the cone. A step
    sees only the velocity of the foot, which weight turns downwards, and not the centripetal part of b. So the world
    jams in the second case too, where theory also allows the foot to lift off.
    """
    friction, lean, slip = 1.6, np.arctan(2.0), 2.0
    assert press(lean, friction) < 0
    lifts = spin**2 * ROD[2] * np.sin(lean) - GRAVITY
    assert lifts > 0 if spin else lifts < 0
    things, ahead, arm = rod_on_floor(lean, slip, spin)
    bodies, start = scene(things, friction=friction)
    end, memory, _ = advance_world(bodies, start, (0, 0, -GRAVITY), dt)
    inertia = world_inverse_inertia(bodies.moments[1], start.orientation[1])
    softness = point_inverse_mass(1.0, inertia, arm)
    free = slip * ahead - GRAVITY * dt * np.array(FLOOR_NORMAL)
    np.testing.assert_allclose(memory.impulse[0], np.linalg.solve(softness, -free), rtol=1e-5)  # the contact's height
    routh = poisson_impulse(free, FLOOR_NORMAL, softness, 0.0, friction)
    np.testing.assert_allclose(
        memory.impulse[0], routh, rtol=1e-5
    )  # followed through: u_n falls, and then the slip ends
    assert np.linalg.norm(memory.impulse[0]) > 0.5
    assert energy(bodies, end).sum() < energy(bodies, start).sum()


def test_a_rod_beyond_its_jam_turns_over_its_foot_and_loses_energy():
    things, _, _ = rod_on_floor(np.arctan(2.0), 2.0, 0.0)
    bodies, start = scene(things, friction=1.6)
    run = run_world(bodies, start, (0, 0, -GRAVITY), 1e-3, 120)
    total = np.sum(energy(bodies, run, GRAVITY), axis=-1)
    assert np.all(np.diff(total[1:]) < 1e-3)  # an overlap of the slop lifts 1 kg by 0.1 mm
    assert run.position[-1, 1, 2] > run.position[0, 1, 2]  # it vaults


def struck_rod(slip, **coefficients):
    """A rod at 45° whose foot strikes the floor at 1 m/s while it slides: world, direction ahead, and K of the foot."""
    things, ahead, arm = rod_on_floor(np.radians(45), slip, 0.0)
    velocity = np.asarray(things[1].velocity) - np.array(FLOOR_NORMAL)
    bodies, start = scene([things[0], things[1]._replace(velocity=tuple(velocity))], **coefficients)
    inertia = world_inverse_inertia(bodies.moments[1], start.orientation[1])
    return bodies, start, ahead, point_inverse_mass(1.0, inertia, arm)


def test_the_world_parts_from_the_laws_of_topics_where_a_rods_slip_turns():
    """A rod at 45° strikes a floor with μ = 0.4 and e = 0.5 at 1 m/s, its foot sliding back at 0.2 m/s.

    The normal impulse drives the foot ahead. The slip ends before the approach does, and turns round, because
    friction of 0.4 cannot hold it: that takes |k_tn|/k_tt = 0.6. The laws then differ in the slip that they leave, in
    the normal speed and in the energy. At 3 m/s the foot slides all along, and all laws agree. `docs/world.md` prints
    the table.
    """
    friction, e, after = 0.4, 0.5, {}
    for slip in (-0.2, -3.0):
        bodies, start, ahead, softness = struck_rod(slip, friction=friction, restitution=e)
        k_tt, k_tn, k_nn = ahead @ softness @ ahead, ahead @ softness @ FLOOR_NORMAL, softness[2, 2]
        contact = Contact(k_tt, k_tn, k_nn, slip, -1.0, friction)
        for law in (DISSIPATIVE, NEWTON, POISSON, STRONGE):
            along, pressed = planar_impact(contact, e, law)
            after[law, slip] = (*contact.after(along, pressed), contact.energy_gained(along, pressed))
        for law in (DISSIPATIVE, NEWTON):
            _, memory, _ = advance_world(bodies, start, FREE, 1e-5, TOUCHING._replace(law=law))
            along, pressed = memory.impulse[0] @ ahead, memory.impulse[0, 2]
            after["world, " + law, slip] = (*contact.after(along, pressed), contact.energy_gained(along, pressed))
    for law in (DISSIPATIVE, NEWTON):
        for slip in (-0.2, -3.0):
            np.testing.assert_allclose(after["world, " + law, slip], after[law, slip], atol=1e-9)
    np.testing.assert_allclose([after[law, -3.0] for law in (NEWTON, POISSON, STRONGE)], [after[DISSIPATIVE, -3.0]] * 3)
    left = {law: motion[0] for (law, slip), motion in after.items() if slip == -0.2}  # the slip turned from -0.2 m/s
    assert min(left.values()) > 0.19
    assert left[DISSIPATIVE] - left[NEWTON] > 0.1
    assert abs(left[STRONGE] - left[DISSIPATIVE]) < 0.02  # the world's own law is the nearer to what was followed


@pytest.mark.parametrize("response", ["sequential", "simultaneous", "in time order"])
def test_an_approach_rebounds_only_above_the_rest_speed(response):
    ball, floor = ("sphere", 0.1), ("half-space", FLOOR_NORMAL)
    speeds = (0.099, 0.101, -0.05)  # the last one parts
    things = []
    for group, speed in enumerate(speeds):
        things += [Thing(floor, group=group), Thing(ball, 2.0, (0.3, 0, 0.1), velocity=(0, 0, -speed), group=group)]
    bodies, start = scene(things, restitution=0.6)
    after, _, _ = advance_world(bodies, start, FREE, 1e-6, Rules(response=response, rest_speed=0.1))
    # rounding; a gap of 1e-17 m counts with 1/Δt
    np.testing.assert_allclose(after.velocity[1::2, 2], [0.0, 0.6 * 0.101, 0.05], atol=1e-10)
