from __future__ import annotations

import math
from dataclasses import FrozenInstanceError

import numpy as np
import pytest

from solutions.forces import (
    Force,
    acceleration_of,
    audit_energy,
    damper_force,
    evaluate_forces,
    mutual_gravity,
    runge_kutta_4,
    semi_implicit_euler,
    spring_energy,
    spring_force,
    stokes_drag,
    uniform_gravity,
    velocity_verlet,
)
from solutions.friction import friction_force

DOWN = np.array([0.0, 0.0, -9.81])
MASS = np.array([1.0, 2.0])
WIND = np.array([2.0, 0.0, 0.5])
START = (np.array([[0.0, 0.0, 1.0], [1.5, 0.0, 1.0]]), np.array([[0.0, 1.0, 0.0], [0.0, -0.5, 2.0]]))


def ends(on_1):
    return np.stack([on_1, -on_1], axis=-2)


WEIGHT = Force(
    "weight",
    "position",
    lambda p, v: uniform_gravity(MASS, DOWN),
    lambda p: -np.sum(MASS[:, None] * p * DOWN, (-2, -1)),
)
SPRING = Force(
    "spring",
    "position",
    lambda p, v: ends(spring_force(p[..., 0, :], p[..., 1, :], 30.0, 1.0)),
    lambda p: spring_energy(p[..., 0, :], p[..., 1, :], 30.0, 1.0),
)
DAMPER = Force(
    "damper",
    "velocity",
    lambda p, v: ends(damper_force(p[..., 0, :], p[..., 1, :], v[..., 0, :], v[..., 1, :], 0.5)),
)
AIR = Force("air", "velocity", lambda p, v: stokes_drag(v, WIND, 0.1, 0.1))
ALL = [WEIGHT, SPRING, DAMPER, AIR]


def run(step, forces, dt, steps, mass=MASS, start=START):
    acceleration, path = acceleration_of(forces, mass), [start]
    for _ in range(steps):
        path.append(step(*path[-1], acceleration, dt))
    return np.array([p for p, _ in path]), np.array([v for _, v in path])


@pytest.fixture(scope="module")
def flight():
    """The pair for a second in steps of 1 ms by the fourth-order method: its positions and velocities, (1001, 2, 3)."""
    return run(runge_kutta_4, ALL, 1e-3, 1000)


@pytest.mark.statement(30, oracle="each force computed alone")
def test_the_sum_of_the_forces_is_what_accelerates_each_body():
    p, v = START
    each = evaluate_forces(ALL, p, v)
    assert list(each) == ["weight", "spring", "damper", "air"]
    assert np.array_equal(each["weight"], [[0, 0, -9.81], [0, 0, -19.62]])
    assert each["spring"] == pytest.approx(np.array([[15, 0, 0], [-15, 0, 0]]), abs=1e-14)
    total = each["weight"] + each["spring"] + each["damper"] + each["air"]
    assert acceleration_of(ALL, MASS)(p, v) == pytest.approx(total / [[1], [2]], abs=1e-14)


def test_without_forces_nothing_accelerates():
    assert acceleration_of([], MASS)(*START).tolist() == np.zeros((2, 3)).tolist()


def test_an_infinite_mass_is_not_accelerated_and_has_no_energy():
    held = np.array([math.inf, 2.0])
    assert acceleration_of([SPRING], held)(*START)[0].tolist() == [0, 0, 0]
    still = (START[0], START[1] * [[0], [1]])
    p, v = run(velocity_verlet, [SPRING], 1e-2, 10, held, still)
    audit = audit_energy([SPRING], held, p, v, 1e-2)
    assert np.array_equal(p[-1, 0], p[0, 0])
    assert audit.kinetic[0] == pytest.approx(0.25 + 4)


@pytest.mark.statement(30, oracle="kinetic energy itself, at two steps")
@pytest.mark.parametrize(("step", "order"), [(semi_implicit_euler, 1), (velocity_verlet, 2), (None, 2)])
def test_the_kinetic_energy_gained_is_the_work_of_all_forces(step, order, flight):
    residuals = []
    for steps in (200, 400) if step else (250, 500):
        # By the method of fourth order the audit alone decides: it looks at every fourth and every second step
        p, v = run(step, ALL, 1 / steps, steps) if step else (path[:: 1000 // steps] for path in flight)
        audit = audit_energy(ALL, MASS, p, v, 1 / steps)
        residuals.append(np.abs(audit.residual()).max())
    # The audit's trapezoids are of second order; the next order is smaller by some ω dt = 0.03
    assert math.log2(residuals[0] / residuals[1]) == pytest.approx(order, abs=0.15)
    # Semi-implicit Euler is half a step, 1/800 s, out in a power of some 100 W; the others by (ω dt)²/12 of 100 J
    assert residuals[1] < (0.2 if order == 1 else 1e-2)


@pytest.mark.statement(30, oracle="the potentials")
def test_the_work_of_a_conservative_force_is_what_its_potential_loses(flight):
    audit = audit_energy(ALL, MASS, *flight, 1e-3)
    assert set(audit.potential) == {"weight", "spring"}
    for name, potential in audit.potential.items():
        assert audit.work[name] == pytest.approx(potential[0] - potential, abs=1e-4)  # trapezoids: (ω dt)²/12 of 10 J
    assert audit.work["damper"][-1] < 0
    assert np.all(np.diff(audit.work["damper"]) <= 0)
    brought_in = audit.work["damper"] + audit.work["air"]
    assert audit.mechanical() - audit.mechanical()[0] == pytest.approx(brought_in, abs=1e-4)


def test_what_is_conservative_keeps_its_mechanical_energy():
    p, v = run(runge_kutta_4, [WEIGHT, SPRING], 1e-3, 1000)
    audit = audit_energy([WEIGHT, SPRING], MASS, p, v, 1e-3)
    mechanical = audit.mechanical()
    assert mechanical == pytest.approx(np.full(1001, mechanical[0]), abs=1e-9)  # RK4: 1000 steps of (ω dt)⁵


def test_gravity_between_bodies_shifts_no_centre_of_mass():
    attraction = Force("attraction", "position", lambda p, v: mutual_gravity(MASS * 1e10, p))
    p, v = run(velocity_verlet, [attraction], 1e-3, 500, MASS * 1e10)
    centre, drift = (p * MASS[:, None]).sum(1), (v[0] * MASS[:, None]).sum(0)
    assert centre[-1] == pytest.approx(centre[0] + drift * 0.5, abs=1e-13)  # 500 roundings of 1e-16


def test_friction_is_an_interaction_whose_work_is_mu_n_over_the_way():
    def rub(p, v):
        return friction_force(np.zeros(3), v, 9.81, 0.3, 0.3)

    p, v = run(
        velocity_verlet,
        [Force("friction", "interaction", rub)],
        1e-3,
        500,
        [1.0],
        (np.zeros((1, 3)), np.array([[3.0, 0, 0]])),
    )
    audit = audit_energy([Force("friction", "interaction", rub)], [1.0], p, v, 1e-3)
    assert audit.work["friction"][-1] == pytest.approx(
        -0.3 * 9.81 * p[-1, 0, 0], rel=1e-12, abs=0
    )  # constant: no error
    assert audit.residual() == pytest.approx(np.zeros(501), abs=1e-11)


def test_an_impulse_is_the_work_of_no_force_and_appears_in_the_residual():
    p, v = run(velocity_verlet, [WEIGHT], 1e-2, 20)
    v[10:, 0, 2] += 3.0
    for k in range(10, 20):
        p[k + 1], v[k + 1] = velocity_verlet(p[k], v[k], DOWN, 1e-2)
    residual = audit_energy([WEIGHT], MASS, p, v, 1e-2).residual()
    assert residual[:10] == pytest.approx(np.zeros(10), abs=1e-12)
    before = v[10, 0, 2] - 3.0
    # m ((v + 3)² − v²)/2; the trapezoid across the jump takes half of it for a power: 9.81 × 3/2 × dt
    assert residual[10] == pytest.approx(((before + 3) ** 2 - before**2) / 2 + 9.81 * 1.5 * 1e-2, abs=1e-12)
    assert residual[11:] == pytest.approx(np.full(10, residual[10]), abs=1e-12)


def test_steps_of_unequal_length_are_audited_as_well():
    dt = np.array([0.1, 0.05, 0.2, 0.1])
    acceleration, path = acceleration_of([WEIGHT], MASS), [START]
    for h in dt:
        path.append(velocity_verlet(*path[-1], acceleration, h))
    p, v = np.array([p for p, _ in path]), np.array([v for _, v in path])
    audit = audit_energy([WEIGHT], MASS, p, v, dt)
    assert audit.residual() == pytest.approx(np.zeros(5), abs=1e-12)  # Verlet and trapezoids are exact on a parabola
    assert audit.work["weight"][0] == 0


def test_forces_are_checked_and_cannot_be_changed():
    with pytest.raises(ValueError, match="tag must be one of position, velocity, interaction, not 'magic'"):
        Force("spell", "magic", lambda p, v: v)
    with pytest.raises(ValueError, match="forces must have names of their own, not weight, weight"):
        evaluate_forces([WEIGHT, WEIGHT], *START)
    with pytest.raises(ValueError, match="mass must be positive, not 0"):
        acceleration_of([WEIGHT], [0.0, 1.0])
    with pytest.raises(ValueError, match="mass must be positive, not -1"):
        audit_energy([WEIGHT], [-1.0, 1.0], np.zeros((2, 2, 3)), np.zeros((2, 2, 3)), 0.1)
    with pytest.raises(ValueError, match=r"same shape \(T, N, 3\), not \(2, 3\) and \(2, 3\)"):
        audit_energy([WEIGHT], MASS, *START, 0.1)
    with pytest.raises(ValueError, match=r"same shape \(T, N, 3\), not \(3, 2, 3\) and \(2, 2, 3\)"):
        audit_energy([WEIGHT], MASS, np.zeros((3, 2, 3)), np.zeros((2, 2, 3)), 0.1)
    with pytest.raises(FrozenInstanceError):
        WEIGHT.name = "lightness"
