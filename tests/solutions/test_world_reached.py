"""What is struck is what two bodies reach: no rebound before they touch, and nothing in the way at a seam."""

from __future__ import annotations

import numpy as np
import pytest

from labs.plain_worlds import BALL, BOX, PLANE, thing, world
from solutions.impulse import rotation_matrix
from solutions.world import find_contacts, make_bodies, make_state, run_world, step_world
from solutions.world.rules import LAWS, Rules

TURN = np.array([0.4, -0.2, 0.8, 0.4])  # a unit quaternion: 0.16 + 0.04 + 0.64 + 0.16 = 1
R = rotation_matrix(TURN)
NO_WEIGHT, DOWN = np.zeros(3), np.array([0.0, 0.0, -9.81])
FIXED = np.full(3, np.inf)
WEDGE = np.array([[x, y, -0.05] for x in (-0.1, 0.1) for y in (-0.06, 0.06)] + [[0.02, y, 0.05] for y in (-0.06, 0.06)])
WEDGE_FACES = [[0, 1, 3, 2], [0, 4, 5, 1], [2, 3, 5, 4], [0, 2, 4, 4], [1, 5, 3, 3]]
ROUNDING = 1e-12  # of velocities of some m/s, added up over hundreds of steps


def turned(*vectors):
    return [R @ each for each in np.array(vectors, dtype=float)]


def balls(gap, dt, shift):
    """Two balls of 7 and 5 mm that both move, and pass at this gap, in a scene that is turned."""
    bodies = make_bodies([("sphere", 0.007), ("sphere", 0.005)], [1.0, 0.3], [[2e-5] * 3, [3e-6] * 3], restitution=0.8)
    velocity = np.array([[1.3, 0.2, 0.1], [-0.9, 0.2, 0.1]])
    start = -0.0125 - 2.2 * dt * shift
    state = make_state(turned([start, 0.012 + gap, 0], [0, 0, 0]), [TURN, TURN], turned(*velocity))
    return bodies, state, round(2 * abs(start) / (2.2 * dt)) + 2


@pytest.mark.parametrize("response", LAWS)
@pytest.mark.parametrize("dt", [pytest.param(4e-4, marks=pytest.mark.slow), 4e-3, 0.05, 0.7])
def test_balls_that_pass_each_other_exchange_nothing(dt, response):
    for gap in (2e-9, 3e-6, 2e-4, 9.9e-4):
        for shift in (0.0, 0.37, 0.81):
            bodies, state, steps = balls(gap, dt, shift)
            after = run_world(bodies, state, NO_WEIGHT, dt, steps, Rules(response=response, looks=50))
            assert np.array_equal(after.velocity[-1], state.velocity), (gap, shift)


@pytest.mark.slow
def test_balls_leave_along_the_line_of_their_centres():
    """An impact is put at the nearest beginning of a step, so that the line errs by half a step's way at most."""
    for dt in (3e-5, 1e-4):
        for offset in (-0.008, 0.003, 0.0101):
            bodies, state, _ = balls(offset - 0.012, dt, 0.4)
            after = run_world(bodies, state, NO_WEIGHT, dt, round(0.014 / (2.2 * dt)), Rules()).velocity[-1]
            line = np.array([-np.sqrt(0.012**2 - offset**2), offset, 0.0]) / 0.012
            impulse = 1.8 * 2.2 * -line[0] / (1 / 1.0 + 1 / 0.3)
            gained = (after[0] - state.velocity[0]) @ R
            turn = 2.2 * dt / 2 / 0.012  # of the line, while they move on half a step
            assert np.linalg.norm(gained - impulse * line) < 2 * impulse * turn / abs(line[0]), (dt, offset)


LOADED = ("compound", [(("polyhedron", WEDGE, WEDGE_FACES), (0, 0, 0), (1, 0, 0, 0))])
SHAPES = {
    "sphere": (("sphere", 0.05), 0.05),
    "capsule": (("capsule", 0.05, 0.1), 0.15),
    "box": (("box", (0.05, 0.1, 0.03)), 0.03),
    "polyhedron": (LOADED, 0.05),
}
FLOORS = {
    "half-space": (("half-space", (0, 0, 1)), 0.0),
    "box": (("box", (1.0, 0.9, 0.2)), -0.2),
    "compound": (("compound", [(("box", (0.9, 0.9, 0.2)), (0, 0, 0), (1, 0, 0, 0))]), -0.2),
}


@pytest.mark.parametrize("floor", FLOORS)
@pytest.mark.parametrize("kind", SHAPES)
def test_a_rebound_waits_for_the_nearest_beginning_of_a_step(kind, floor):
    (shape, height), (ground, middle), dt, e = SHAPES[kind], FLOORS[floor], 1e-4, 0.6
    bodies = make_bodies([ground, shape], [np.inf, 0.7], [FIXED, [2e-3, 3e-3, 4e-3]], restitution=e)
    for speed, gap in ((0.31, 7.3e-4), (3.0, 8.31e-4), (0.7, 1.7e-3)):
        place = turned([0, 0, middle], [0.02, -0.03, height + gap])
        state = make_state(place, [TURN, TURN], turned([0, 0, 0], [0.4, 0, -speed]))
        free = round(gap / (speed * dt) + 0.5 - 1e-9)  # the steps that end before the touch by half a step or more
        run = run_world(bodies, state, NO_WEIGHT, dt, free + 3).velocity[:, 1] @ R
        np.testing.assert_allclose(run[:free], np.tile([0.4, 0, -speed], (free, 1)), atol=ROUNDING)
        np.testing.assert_allclose(run[free + 1], [0.4, 0, e * speed], atol=1e-9)


@pytest.mark.parametrize("response", ["sequential", "simultaneous"])
def test_a_cradle_with_gaps_passes_the_impact_on_from_ball_to_ball(response):
    """What others drive together is not stopped at the gap: it would lose the speed with which it is to rebound."""
    for e, gaps in ((1.0, (7e-4, 3e-4, 2e-4)), (0.5, (3e-4, 9e-4, 1e-4))):
        bodies = make_bodies([("sphere", 0.02)] * 4, [1.0] * 4, [[1e-4] * 3] * 4, restitution=e)
        x = np.cumsum([0.0, *(0.04 + np.array(gaps))])
        state = make_state(turned(*([each, 0, 0] for each in x)), velocity=turned([1, 0, 0], *[[0, 0, 0]] * 3))
        run = run_world(bodies, state, NO_WEIGHT, 1e-3, 5, Rules(response=response)).velocity[-1] @ R
        shares = np.array([1.0, 1.0, 1.0, 1.0]) * (1 + e) / 2
        v = np.cumprod(shares)[[0, 1, 2]]  # of the balls that were struck, before they strike the next one
        expected = [(1 - e) / 2, v[0] * (1 - e) / 2, v[1] * (1 - e) / 2, v[2]]
        np.testing.assert_allclose(run[:, 0], expected, atol=1e-9)


def tiles(angle, pattern):
    """Level or upright boxes without a gap: shapes, places and the quaternion of all, turned about z by an angle."""
    half = (np.cos(angle / 2), 0.0, 0.0, np.sin(angle / 2))
    shapes = [("box", each[:3]) for each in pattern]
    return shapes, np.array([each[3:] for each in pattern], dtype=float) @ rotation_matrix(half).T, half


LEVEL = {
    "two": [(1, 1, 0.5, -1, 0, -0.5), (1, 1, 0.2, 1, 0, -0.2)],
    "T": [(0.5, 0.5, 0.5, -0.5, 0.5, -0.5), (0.5, 0.5, 0.3, -0.5, -0.5, -0.3), (1, 2, 0.5, 1, 0.1, -0.5)],
    "wide": [(0.5, 0.3, 0.1, -0.5, 0, -0.1), (0.5, 3, 0.1, 0.5, 0, -0.1)],
}
SLIDERS = {
    "box": (("box", (0.1, 0.08, 0.05)), 0.05),
    "sphere": (("sphere", 0.06), 0.06),
    "polyhedron": (LOADED, 0.05),
    "lying capsule": (("compound", [(("capsule", 0.04, 0.1), (0, 0, 0), (0.5**0.5, 0.5**0.5, 0, 0))]), 0.04),
    "dumbbell": (("compound", [(("box", (0.03, 0.03, 0.03)), (x, 0, 0), (1, 0, 0, 0)) for x in (-0.03, 0.03)]), 0.03),
}


def crossing(kind, pattern, angle, speed, phase, dt=1e-3, steps=60, yaw=0.0, response="sequential", restitution=0.0):
    """Velocities along and across the way of a body that crosses the seam at x = 0, without friction."""
    (shape, height), (floor, places, half) = SLIDERS[kind], tiles(angle, LEVEL[pattern])
    count, rotation = len(floor), rotation_matrix(half)
    bodies = make_bodies(
        [*floor, shape], [*[np.inf] * count, 1.0], [*[FIXED] * count, [2e-3, 3e-3, 4e-3]], restitution=restitution
    )
    q = np.array([np.cos((angle + yaw) / 2), 0, 0, np.sin((angle + yaw) / 2)])
    x = -speed * dt * (steps / 2 + phase) - (0.1 if kind in ("box", "polyhedron") else 0.0)
    state = make_state(
        [*places, rotation @ [x, 0.013, height]], [*[half] * count, q], [*[NO_WEIGHT] * count, rotation @ [speed, 0, 0]]
    )
    rules = Rules(slop=1e-6, margin=9.81 * dt**2, rest_speed=2 * 9.81 * dt, response=response)
    return run_world(bodies, state, DOWN, dt, steps, rules).velocity[:, -1] @ rotation


@pytest.mark.parametrize("kind", ["box", *(pytest.param(each, marks=pytest.mark.slow) for each in [*SLIDERS][1:])])
def test_a_body_crosses_a_seam_as_if_there_were_none(kind):
    for pattern, angle, speed, phase in (
        ("two", 0.0, 1.0, 0.001), ("T", 0.61, 0.009, 0.4), ("wide", 2.2, 0.3, 0.77), ("two", 4.0, 2.7, 0.2),
    ):  # fmt: skip
        velocity = crossing(kind, pattern, angle, speed, phase)
        # Bodies that stand on corners or an edge of the tiles rock by what the sweeps leave of an impulse
        np.testing.assert_allclose(velocity, np.tile([speed, 0, 0], (61, 1)), atol=1e-7, err_msg=f"{pattern} {speed}")


def test_a_wall_of_two_blocks_lets_a_ball_fall_along_it():
    """The blocks stand on each other, and a ball is pushed against them as it falls past the seam."""
    floor, places, half = tiles(0.7, [(0.2, 1, 0.5, -0.2, 0, -0.5), (0.2, 1, 0.5, -0.2, 0, 0.5)])
    rotation = rotation_matrix(half)
    bodies = make_bodies([*floor, ("sphere", 0.05)], [np.inf, np.inf, 1.0], [FIXED, FIXED, [1e-3] * 3])
    state = make_state([*places, rotation @ [0.05, 0.02, 0.0103]], [half, half, (1, 0, 0, 0)])
    weight = rotation @ [-9.81, 0, -2.0]
    run = run_world(bodies, state, weight, 1e-3, 150, Rules(slop=1e-6, margin=9.81e-6, rest_speed=0.02))
    expected = np.outer(np.arange(151) * 1e-3, rotation @ [0, 0, -2.0])
    np.testing.assert_allclose(run.velocity[:, 2], expected, atol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["box", "sphere", "polyhedron"])
def test_a_step_in_the_floor_is_struck(kind):
    """A millimetre is a step, and so is one that lies a gap away: nothing hides its side."""
    (shape, height), dt = SLIDERS[kind], 1e-3
    start = -0.025 if kind == "sphere" else -0.1035
    for up, gap in ((1e-3, 0.0), (1e-3, 2e-3), (0.02, 0.0)):
        bodies = make_bodies(
            [*[("box", (0.5, 1, 0.1))] * 2, shape], [np.inf, np.inf, 1.0], [FIXED, FIXED, [2e-3, 3e-3, 4e-3]]
        )
        state = make_state(
            [[-0.5, 0, -0.1], [0.5 + gap, 0, up - 0.1], [start, 0.02, height]], velocity=[[0] * 3] * 2 + [[0.3, 0, 0]]
        )
        run = run_world(bodies, state, DOWN, dt, 70, Rules(slop=1e-6, margin=9.81e-6, rest_speed=0.02))
        # The ball keeps what is along its edge: it meets that of 1 mm at √(2 · 60 · 1) mm, 0.18 rad from the vertical
        assert np.min(run.velocity[:, 2, 0]) < (0.3 - 0.3 * 0.18**2 / 2 if kind == "sphere" else 0.2), (up, gap)


def test_a_box_in_a_corner_keeps_the_floor_and_the_wall():
    """Also where only its edge is in the corner, so that each of the two ends where the other one begins."""
    shapes = [("box", (0.5, 1, 0.1)), ("box", (0.1, 1, 0.5)), ("box", (0.1, 0.2, 0.05))]
    bodies = make_bodies(shapes, [np.inf, np.inf, 1.0], [FIXED, FIXED, [1e-3] * 3])
    for angle in (0.0, np.pi / 6):
        q = (np.cos(angle / 2), 0, np.sin(angle / 2), 0)
        x, z = 0.1 * np.cos(angle) + 0.05 * np.sin(angle), 0.1 * np.sin(angle) + 0.05 * np.cos(angle)
        for sunk in (0.0, 3e-7, -3e-7):
            state = make_state([[0.5, 0, -0.1], [-0.1, 0, 0.5], [x - sunk, 0.01, z - sunk]], [(1, 0, 0, 0)] * 2 + [q])
            met = find_contacts(bodies, state, 1e-4)
            assert {int(each) for each in met.body_a if each != 2} == {0, 1}, (q, sunk)


UPRIGHT = (1.0, 0, 0, 0)
LEGS = [(("box", (0.4, 0.1, 0.05)), (0, 0, 0), UPRIGHT)]
LEGS += [(("box", (0.05, 0.1, 0.1)), (x, 0, -0.15), UPRIGHT) for x in (0.35, -0.35)]
ROOM = [(("box", (3, 3, 0.5)), (0, 0, -0.5), UPRIGHT), (("box", (0.2, 3, 1)), (1.2, 0, 0.5), UPRIGHT)]


def test_each_piece_of_a_body_is_kept_by_what_it_touches_and_hides_no_other_piece():
    """A table whose top meets the wall while its legs stand on the floor; and a saddle of two plates on a ridge."""
    bodies = make_bodies([("compound", LEGS), ("compound", ROOM)], [5.0, np.inf], [[1.0] * 3, FIXED])
    met = find_contacts(bodies, make_state([[0.6001, 0, 0.25 - 1e-6], [0, 0, 0]]), 1e-4)
    assert {tuple(normal) for normal in np.round(met.normal, 9) + 0.0} == {(-1, 0, 0), (0, 0, 1)}
    half = np.radians(40)
    plank = [
        (("box", (0.5, 0.2, 0.02)), (s * 0.5 * np.cos(half), 0, -0.5 * np.sin(half)), turn_about_y(s * half))
        for s in (1, -1)
    ]
    bodies = make_bodies([("compound", plank), ("compound", plank)], [2.0, np.inf], [[1.0] * 3, FIXED])
    met = find_contacts(bodies, make_state([[0, 0, 0.04 / np.cos(half)], [0, 0, 0]]), 1e-4)
    assert np.ptp(np.sign(met.normal[:, 0])) == 2  # both slopes carry it


def turn_about_y(angle):
    return (np.cos(angle / 2), 0.0, np.sin(angle / 2), 0.0)


@pytest.mark.parametrize("dt", [1e-3, 1 / 60])
def test_in_the_world_of_the_lab_marbles_that_pass_exchange_nothing(dt):
    for shift in (5.0, 5.4, 5.8):
        bodies, state = world(
            [
                thing(BALL, 0.008, 1.0, turned([-5 * dt * shift - 0.01, 0.0135, 0])[0], velocity=5 * R[:, 0]),
                thing(BALL, 0.005, 2.0),
            ]
        )
        memory = None
        for _ in range(15):
            *state, key, impulse = step_world(bodies, tuple(state), NO_WEIGHT, dt, (0.02, 1e-3, 20), memory)
            memory = key, impulse
        assert not np.any(state[2][1])


def test_in_the_world_of_the_lab_nothing_rebounds_before_it_touches_and_no_seam_stops():
    floor = [thing(BOX, half[:3], position=half[3:]) for half in LEVEL["T"]]
    for kind, size, height in ((BOX, (0.1, 0.08, 0.05), 0.05), (BALL, 0.06, 0.06)):
        bodies, state = world([*floor, thing(kind, size, 1.0, (-0.112, 0.013, height), velocity=(0.7, 0, 0))])
        memory = None
        for _ in range(40):
            *state, key, impulse = step_world(bodies, tuple(state), DOWN, 1e-3, (0.02, 1e-5, 20), memory)
            memory = key, impulse
        assert np.allclose(state[2][-1], [0.7, 0, 0], atol=1e-9)
    bodies, state = world(
        [thing(BALL, 0.02, 1.0), thing(BALL, 0.03, 2.0, turned([0.0, 0, 0.0509])[0], velocity=-R[:, 2])]
    )
    speeds = []
    for _ in range(4):
        *state, _, _ = step_world(bodies, tuple(state), NO_WEIGHT, 4e-4, (0.02, 1e-3, 20), None)
        speeds.append(float(state[2][0] @ R[:, 2]))
    # 0.9 mm are closed in the third step: it begins 0.1 mm before the touch, and all of the impulse comes with it
    assert np.allclose(speeds, [0, 0, -1.0, -1.0], atol=1e-12)


@pytest.mark.parametrize("at", [(0.2, 0.15, 0.02), (0.2, 0.15, 0.1)])  # on an edge, and a corner
def test_in_the_world_of_the_lab_a_ball_that_passes_a_box_is_not_struck(at):
    at = np.array(at)
    out = np.where(np.abs(at) == [0.2, 0.15, 0.1], at, 0.0)
    out /= np.linalg.norm(out)
    along = np.cross(out, [0.3, -0.2, 0.93] if out[2] else [0, 0, 1])
    along /= np.linalg.norm(along)
    for gap, shift in ((5e-5, 0.1), (3e-4, 0.4), (3e-4, 0.7), (9e-4, 0.0)):
        start = at + out * (0.1 + gap) - along * (0.08 + 0.01 * shift)
        ball = thing(BALL, 0.1, 1.0, *turned(start), velocity=turned(along)[0])
        bodies, state = world([thing(BOX, (0.2, 0.15, 0.1), orientation=TURN), ball])
        memory = None
        for _ in range(18):
            *state, key, impulse = step_world(bodies, tuple(state), NO_WEIGHT, 0.01, (0.02, 1e-3, 20), memory)
            memory = key, impulse
        assert np.allclose(state[2][1], R @ along, atol=ROUNDING)


@pytest.mark.parametrize(("dt", "gap", "rate"), [(0.01, 5e-4, 20.0), (1e-3, 1e-5, 20.0), (0.01, 5e-4, 45.0)])
def test_in_the_world_of_the_lab_a_box_that_turns_above_a_plane_is_not_struck(dt, gap, rate):
    half = np.array([0.1, 0.05, 0.1])
    box = thing(BOX, half, 1.0, R[:, 2] * (np.hypot(0.1, 0.1) + gap), TURN, spin=rate * R[:, 1])
    bodies, state = world([thing(PLANE, R[:, 2]), box], 1.0)
    for _ in range(60):
        *state, _, _ = step_world(bodies, tuple(state), NO_WEIGHT, dt, (0.1, 1e-3, 20), None)
        assert not np.any(state[2])


def test_in_the_world_of_the_lab_a_box_that_passes_the_edge_of_another_one_is_not_struck():
    # One moves down at 45° and is past the edge of the other one when it is as low: they pass 0.42 mm apart.
    velocity = 0.2 * (R[:, 0] - R[:, 2])
    passing = thing(BOX, (0.1,) * 3, 1.0, *turned([0.1998, 0.03, 0.2008]), TURN, velocity)
    bodies, state = world([passing, thing(BOX, (0.1,) * 3, 1.0, orientation=TURN)], 1.0)
    for _ in range(6):
        *state, _, _ = step_world(bodies, tuple(state), NO_WEIGHT, 0.01, (0.1, 1e-3, 20), None)
    assert np.allclose(state[2], [velocity, np.zeros(3)], atol=ROUNDING)
