"""Impulses beside pymunk, in the plane, and beside MuJoCo's masses and inertias in space."""

from __future__ import annotations

import numpy as np
import pytest
from oracles import oracle

from solutions.impulse import (
    Body,
    box_inertia,
    collide,
    impulse_magnitude,
    inverse_effective_mass,
    sphere_inertia,
    world_inverse_inertia,
)

UPRIGHT = (1.0, 0.0, 0.0, 0.0)
DT = 1e-6


def in_pymunk(pymunk, bodies, shapes, e):
    """Velocities (2, 3) of two bodies after one short step, as v_x, v_y, ω; no gravity, no friction."""
    space = pymunk.Space()
    space.gravity, space.iterations, space.collision_slop = (0, 0), 50, 0.0
    for body, shape in zip(bodies, shapes, strict=True):
        shape.elasticity, shape.friction = np.sqrt(e), 0.0  # it multiplies those of the two
        space.add(body, shape)
    impulses = []
    space.on_collision(None, None, post_solve=lambda arbiter, _space, _data: impulses.append(arbiter.total_impulse))
    space.step(DT)  # finds the contact and answers it
    assert impulses, "they were meant to touch"
    return np.array([[*body.velocity, body.angular_velocity] for body in bodies]), np.hypot(*impulses[0])


@pytest.mark.statement(20, oracle="pymunk, two discs")
@pytest.mark.parametrize("e", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("angle", [0.0, 0.6, 2.5])
def test_two_discs_leave_an_impact_as_in_pymunk(e, angle):
    pymunk = oracle("pymunk")
    n = np.array([np.cos(angle), np.sin(angle), 0.0])
    masses, radii = (2.0, 0.5), (0.3, 0.2)
    velocities = (-1.5 * n + (0.2, -0.4, 0), 0.5 * n + (-0.3, 0.1, 0))
    theirs, shapes, ours = [], [], []
    for side, mass, radius, velocity in zip((1, -1), masses, radii, velocities, strict=True):
        body = pymunk.Body(mass, mass * radius**2 / 2)
        body.position = tuple(side * radius * (1 - 1e-9) * n[:2])
        body.velocity, body.angular_velocity = tuple(velocity[:2]), 3.0
        theirs.append(body)
        shapes.append(pymunk.Circle(body, radius))
        inertia = world_inverse_inertia(np.full(3, mass * radius**2 / 2), UPRIGHT)
        ours.append(Body(velocity, (0, 0, 3.0), -side * radius * n, 1 / mass, inertia))
    found, impulse = in_pymunk(pymunk, theirs, shapes, e)
    v_a, w_a, v_b, w_b = collide(*ours, n, e)
    # pymunk first moves the bodies for a step of 1e-6 s, which turns the normal and the arms by some 1e-6
    assert np.array([[*v_a[:2], w_a[2]], [*v_b[:2], w_b[2]]]) == pytest.approx(found, abs=1e-5)
    assert impulse_magnitude(*ours, n, e) == pytest.approx(impulse, rel=1e-5)


@pytest.mark.statement(20, oracle="pymunk, a turned box and a disc")
@pytest.mark.parametrize("e", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("place", [-0.4, 0.1, 0.45])
def test_a_disc_that_strikes_a_box_off_its_centre_turns_it_as_in_pymunk(e, place):
    pymunk = oracle("pymunk")
    turn, half, radius = 0.4, np.array([0.5, 0.25]), 0.1
    along, n = np.array([np.cos(turn), np.sin(turn), 0]), np.array([-np.sin(turn), np.cos(turn), 0])
    arm = place * along + half[1] * n  # of the box, B; the disc A is on its upper face
    size = (*(2 * half), 0.0)
    moments = box_inertia(3.0, size)
    box = pymunk.Body(3.0, moments[2])
    box.angle, box.velocity, box.angular_velocity = turn, (0.1, 0.3), 0.7
    disc = pymunk.Body(0.8, 0.8 * radius**2 / 2)
    disc.position = tuple((arm + radius * (1 - 1e-9) * n)[:2])
    disc.velocity = tuple((-2.0 * n + 0.5 * along)[:2])
    shapes = [pymunk.Circle(disc, radius), pymunk.Poly.create_box(box, tuple(size[:2]))]
    found, impulse = in_pymunk(pymunk, [disc, box], shapes, e)
    turned = (np.cos(turn / 2), 0, 0, np.sin(turn / 2))
    ours = (
        Body(-2.0 * n + 0.5 * along, (0, 0, 0), -radius * n, 1 / 0.8, world_inverse_inertia((1, 1, 0.004), UPRIGHT)),
        Body((0.1, 0.3, 0), (0, 0, 0.7), arm, 1 / 3.0, world_inverse_inertia(moments, turned)),
    )
    v_a, w_a, v_b, w_b = collide(*ours, n, e)
    assert np.array([[*v_a[:2], w_a[2]], [*v_b[:2], w_b[2]]]) == pytest.approx(found, abs=1e-5)  # as above
    assert impulse_magnitude(*ours, n, e) == pytest.approx(impulse, rel=1e-5)


@pytest.mark.statement(20, oracle="MuJoCo's inverse mass matrix")
@pytest.mark.parametrize("seed", range(5))
def test_the_denominator_is_the_one_that_mujocos_mass_matrix_gives(seed):
    mujoco = oracle("mujoco")
    rng = np.random.default_rng(seed)
    model = mujoco.MjModel.from_xml_string(
        "<mujoco><worldbody>"
        "<body><freejoint/><geom type='box' size='.5 1 .25' mass='3'/></body>"
        "<body><freejoint/><geom type='sphere' size='.3' mass='2'/></body>"
        "</worldbody></mujoco>"
    )
    data = mujoco.MjData(model)
    moments = (box_inertia(3.0, (1.0, 2.0, 0.5)), sphere_inertia(2.0, 0.3))
    normal = rng.normal(size=3)
    normal /= np.linalg.norm(normal)
    point, bodies = rng.normal(size=3), []
    for index, mass in enumerate((3.0, 2.0)):
        place, turn = rng.normal(size=3), rng.normal(size=4)
        turn /= np.linalg.norm(turn)
        data.qpos[7 * index : 7 * index + 7] = *place, *turn
        inverse = world_inverse_inertia(moments[index], turn)
        bodies.append(Body((0, 0, 0), (0, 0, 0), point - place, 1 / mass, inverse))
    mujoco.mj_forward(model, data)
    rows = []
    for index in (1, 2):
        jacobian = np.zeros((3, model.nv))
        mujoco.mj_jac(model, data, jacobian, None, point, index)
        rows.append(normal @ jacobian)
    row, solved = (rows[0] - rows[1])[None], np.zeros((1, model.nv))
    mujoco.mj_solveM(model, data, solved, row)
    # A dozen sums of terms up to some 50/kg
    assert inverse_effective_mass(*bodies, normal) == pytest.approx((row @ solved.T).item(), rel=1e-12)
