"""Hertz's contact against closed forms and scipy's integration; the tangential spring against Coulomb and Jenkin."""

from __future__ import annotations

import math

import numpy as np
import pytest
from oracles import oracle

from reference.superball_truth import ball_after_impact
from solutions.forces import semi_implicit_euler
from solutions.response import (
    hertz_contact_time,
    hertz_damping,
    hertz_force,
    hertz_largest_depth,
    hertz_restitution,
    hertz_stiffness,
    penalty_force,
    tangential_spring,
)

UP, X = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])
TILTED = np.array([2.0, -3.0, 6.0]) / 7
MASS, STIFFNESS = 0.3, 5e5


def impact(speed, damping=0.0, adhesive=False):
    """Duration, speed after and largest depth of an impact along a tilted normal, integrated by scipy."""
    integrate = oracle("scipy.integrate")

    def motion(_, state):
        force = hertz_force(state[0], state[1], TILTED, STIFFNESS, damping, adhesive)
        return [state[1], force @ TILTED / MASS]

    def out(_, state):
        return state[0] if adhesive else state[0] + 1e-12

    def deepest(_, state):
        return state[1]

    out.terminal, out.direction = True, 1
    depth = (5 * MASS * speed**2 / (4 * STIFFNESS)) ** 0.4
    found = integrate.solve_ivp(
        motion, (0, 20 * depth / speed), [-1e-15, -speed], "DOP853", rtol=1e-10, atol=1e-13, events=(out, deepest)
    )
    return found.t[-1], found.y[1, -1], -found.y_events[1][0][0]


# Hertz


@pytest.mark.statement(8, oracle="scipy solve_ivp, and the Gamma functions of the energy integral")
@pytest.mark.parametrize("speed", [0.2, 3.0])
def test_an_elastic_hertz_impact_lasts_and_dips_as_its_closed_form_says(speed):
    lasts, after, deepest = impact(speed)
    assert after == pytest.approx(speed, rel=1e-8)
    assert hertz_contact_time(MASS, STIFFNESS, speed) == pytest.approx(lasts, rel=1e-6)
    assert hertz_largest_depth(MASS, STIFFNESS, speed) == pytest.approx(deepest, rel=1e-8)
    gamma = math.gamma(0.4) / math.gamma(0.9)
    closed = 0.8 * math.sqrt(math.pi) * gamma * 1.25**0.4 * (MASS**2 / (STIFFNESS**2 * speed)) ** 0.2
    assert hertz_contact_time(MASS, STIFFNESS, speed) == pytest.approx(closed, rel=1e-14)
    assert closed * (STIFFNESS**2 * speed / MASS**2) ** 0.2 == pytest.approx(3.218, abs=1e-3)
    for slower in (1e-60, 1e60):
        scaled = hertz_contact_time(MASS, STIFFNESS, speed * slower) * slower**0.2
        assert scaled == pytest.approx(closed, rel=1e-12)
        scaled = hertz_largest_depth(MASS, STIFFNESS, speed * slower) / slower**0.8
        assert scaled == pytest.approx(deepest, rel=1e-8)


@pytest.mark.statement(8, oracle="scipy solve_ivp; Antypov and Elliott's linear oscillator")
@pytest.mark.parametrize("adhesive", [False, True])
@pytest.mark.parametrize("restitution", [0.15, 0.6])
def test_a_damped_hertz_contact_keeps_e_at_every_speed(restitution, adhesive):
    damping = hertz_damping(restitution, MASS, STIFFNESS, adhesive)
    assert hertz_restitution(MASS, STIFFNESS, damping, adhesive) == pytest.approx(restitution, rel=1e-12)
    for speed in (0.05, 4.0):
        # Without adhesion the last 1e-12 m take no force; with it the event is the surface itself.
        assert impact(speed, damping, adhesive)[1] == pytest.approx(restitution * speed, rel=2e-6)


def test_tsujis_damping_with_adhesion_is_the_formula_in_print():
    for e in (0.1, 0.5, 0.9):
        alpha = -math.sqrt(5) * math.log(e) / math.hypot(math.pi, math.log(e))  # Antypov and Elliott 2011, eq. 19
        assert hertz_damping(e, 2.0, 8.0, adhesive=True) == pytest.approx(alpha * 4, rel=1e-14)
    assert hertz_damping([1.0, 0.0], 2.0, 8.0).tolist() == [0.0, math.inf]


@pytest.mark.statement(8, oracle="Hertz's law by hand")
def test_a_hertz_contact_pushes_with_three_halves_and_pulls_only_if_it_may():
    force = hertz_force([-0.25, 0.0, 0.25], [0.0, -2.0, -2.0], TILTED, 8.0, 3.0)
    assert force == pytest.approx(np.outer([1.0, 0.0, 0.0], TILTED), abs=1e-15)
    leaving = (-0.0625, 2.0, UP, 64.0, 3.0)  # spring 1 N, dashpot −3 N
    assert hertz_force(*leaving).tolist() == [0, 0, 0]
    assert hertz_force(*leaving, adhesive=True).tolist() == [0, 0, -2.0]
    # at the first touch the dashpot of a linear contact jumps, and this one does not
    assert hertz_force(-1e-12, -2.0, UP, 64.0, 3.0)[2] < 0.01 < penalty_force(-1e-12, -2.0, UP, 64.0, 3.0)[2]


@pytest.mark.statement(8, oracle="Hertz's area of contact: a² = R d, and the pressure (3/2) F/(π a²) = (2/π) E* a/R")
def test_the_hertz_stiffness_agrees_with_the_largest_pressure():
    radius, modulus, depth = 0.02, 7e9, 3e-6
    force = hertz_force(-depth, 0.0, UP, hertz_stiffness(radius, modulus))[2]
    a = math.sqrt(radius * depth)
    assert 1.5 * force / (math.pi * a**2) == pytest.approx(2 / math.pi * modulus * a / radius, rel=1e-14)


def test_hertz_refuses_what_no_contact_has():
    for call, words in (
        (lambda: hertz_force(-1.0, 0.0, UP, -1.0), "stiffness must be zero or positive, not -1"),
        (lambda: hertz_force(-1.0, 0.0, 2 * UP, 1.0), "normal must have length 1"),
        (lambda: hertz_contact_time(1.0, 1.0, 0.0), "speed must be positive, not 0"),
        (lambda: hertz_largest_depth(0.0, 1.0, 1.0), "mass must be positive, not 0"),
        (lambda: hertz_restitution(1.0, 1.0, -3.0), "damping must be zero or positive, not -3"),
        (lambda: hertz_stiffness(1.0, 0.0), "modulus must be positive, not 0"),
        (lambda: tangential_spring(np.zeros(3), X, UP, -1.0, 0.5, 1.0, 0.0, 0.1), "normal_force must be zero"),
    ):
        with pytest.raises(ValueError, match=f"^{words}"):
            call()


# The tangential spring


@pytest.mark.statement(24, oracle="the energy of Jenkin's element: 4 μN (A − μN/k_t) in each cycle")
def test_a_contact_rubbed_to_and_fro_loses_the_energy_of_its_loop():
    press, mu, k, amplitude, steps = 5.0, 0.4, 1000.0, 0.007, 500
    along = np.cross(TILTED, X) / np.linalg.norm(np.cross(TILTED, X))
    place = amplitude * np.cos(2 * np.pi * np.arange(steps * 2 + 1) / steps)
    xi, before, work = np.zeros(3), np.zeros(3), 0.0
    for step, way in enumerate(np.diff(place)):
        force, xi = tangential_spring(xi, way * along + 3 * TILTED, TILTED, press, mu, k, 0.0, 1.0)
        assert abs(force @ TILTED) < 1e-12
        assert np.linalg.norm(force) <= mu * press * (1 + 1e-12)
        work -= (before + force) @ along / 2 * way if step >= steps else 0.0
        before = force
    # by trapezoids, whose corners are not those of the loop
    assert work == pytest.approx(4 * mu * press * (amplitude - mu * press / k), rel=2e-3)


@pytest.mark.statement(24, oracle="the balance of forces on a slope")
def test_a_spring_holds_a_block_below_the_friction_angle_without_creep():
    mass, gravity, k, c, dt = 2.0, 9.81, 1e4, 400.0, 1e-3
    for slope, holds in ((0.45, True), (0.6, False)):  # tan is 0.483 and 0.684
        pull = mass * gravity * math.sin(slope)
        x, v, xi, places = np.zeros(3), np.zeros(3), np.zeros(3), []
        for _ in range(600):
            force, xi = tangential_spring(xi, v, UP, mass * gravity * math.cos(slope), 0.5, k, c, dt)
            x, v = semi_implicit_euler(x, v, (force + pull * X) / mass, dt)
            places.append(x[0])
        if holds:
            assert xi[0] == pytest.approx(pull / k, rel=1e-6)  # stretched, and at rest
            assert abs(places[-1] - places[-100]) < 1e-5 * places[-1]
        else:
            slides = gravity * (math.sin(slope) - 0.5 * math.cos(slope))
            assert v[0] == pytest.approx(0.6 * slides, rel=0.05)  # all of 0.6 s but the time of the first stretch


@pytest.mark.statement(16, oracle="closed form: e_t = −cos(π √(7 k_t/(2 k_n))) of two springs side by side")
def test_springs_both_ways_give_a_rough_ball_its_tangential_restitution():
    # For k_t = 2/7 k_n both springs swing equally long: a superball
    ratio = np.array([0.15, 2 / 7, 0.4])
    k, radius, dt = 1e4, 0.05, 2e-5
    v, spin = np.tile([0.4, -0.3, -1.0], (3, 1)), np.tile([5.0, 8.0, 2.0], (3, 1))
    e_t = -np.cos(np.pi * np.sqrt(3.5 * ratio))
    assert e_t[1] == pytest.approx(1.0, rel=1e-15)
    struck = [ball_after_impact(*each, UP, 1.0, 100.0, back) for *each, back in zip(v, radius * spin, e_t, strict=True)]
    expected, surface = np.swapaxes(struck, 0, 1)
    depth, xi = 0.0, np.zeros((3, 3))
    for _ in range(round(math.pi / math.sqrt(k) / dt)):  # 1 kg
        press = penalty_force(-depth, v[:, 2], UP, k)
        slip = v + np.cross(spin, -radius * UP)
        rub, xi = tangential_spring(xi, slip, UP, press[:, 2], 100.0, ratio * k, 0.0, dt)
        v, spin = v + (press + rub) * dt, spin + np.cross(-radius * UP, rub) * dt / (0.4 * radius**2)
        depth = depth - v[:, 2] * dt
    # Friction begins a step late, and the contact lasts some 1600 steps
    assert v == pytest.approx(expected, abs=2e-3)
    assert radius * spin == pytest.approx(surface, abs=4e-3)


def test_the_stretch_turns_with_the_surface_and_ends_with_the_contact():
    xi = np.array([0.03, 0.0, 0.0])
    turned = np.array([0.6, 0.0, 0.8])
    force, kept = tangential_spring(xi, np.zeros(3), turned, 10.0, 1.0, 100.0, 0.0, 0.1)
    assert kept == pytest.approx([0.024, 0.0, -0.018], abs=1e-17)  # as long as before, along the surface of now
    assert force == pytest.approx(-100 * kept, abs=1e-14)
    assert tangential_spring(xi, np.zeros(3), X, 10.0, 1.0, 100.0, 0.0, 0.1)[1].tolist() == [0, 0, 0]  # none is left
    force, kept = tangential_spring(xi, X, UP, 0.0, 1.0, 100.0, 2.0, 0.1)
    assert force.tolist() == kept.tolist() == [0, 0, 0]


def test_a_sliding_spring_asks_for_the_limit_in_the_next_step_too():
    for c in (0.0, 4.0):
        force, xi = tangential_spring(np.zeros(3), 2 * X, UP, 10.0, 0.3, 100.0, c, 1.0)
        assert force == pytest.approx(-3.0 * X, abs=1e-15)
        again, _ = tangential_spring(xi, 2 * X, UP, 10.0, 0.3, 100.0, c, 0.0)
        assert again == pytest.approx(force, abs=1e-14)
    # While it slides at 2 m/s, 1 N of the 3 N is the dashpot's: the spring keeps the other 2 N when the slip ends
    _, xi = tangential_spring(np.zeros(3), 2 * X, UP, 10.0, 0.3, 100.0, 0.5, 1.0)
    assert tangential_spring(xi, np.zeros(3), UP, 10.0, 0.3, 100.0, 0.5, 1.0)[0] == pytest.approx(-2.0 * X, abs=1e-14)
    one_by_one = [
        tangential_spring(np.zeros(3), 2 * X, UP, press, 0.3, 100.0, 4.0, 0.01)[0] for press in (0.0, 1.0, 99.0)
    ]
    together, _ = tangential_spring(np.zeros(3), 2 * X, UP, [0.0, 1.0, 99.0], 0.3, 100.0, 4.0, 0.01)
    assert np.array_equal(together, one_by_one)
