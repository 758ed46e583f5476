"""What theory says of spring meshes, against closed forms and finite differences."""

from __future__ import annotations

import math

import numpy as np
import pytest

from reference import mesh_truth
from reference.errors import RunFailed

EDGES = np.array([[0, 1], [1, 2], [2, 3], [0, 2], [1, 3]])
STIFFNESS, REST_LENGTH = np.array([40.0, 25.0, 60.0, 15.0, 30.0]), np.array([0.9, 1.2, 0.7, 1.4, 1.1])
PLACE = np.array([[0.0, 0.1, 0.0], [1.0, -0.2, 0.3], [1.2, 0.9, -0.4], [0.1, 1.1, 0.5]])


def test_the_stiffness_matrix_is_the_slope_of_the_forces():
    load = np.zeros((4, 3))
    matrix = mesh_truth.stiffness_matrix(PLACE, EDGES, STIFFNESS, REST_LENGTH)
    for column in range(12):
        aside = np.zeros(12)
        aside[column] = 1e-6
        more, less = (
            mesh_truth.net_force(PLACE + sign * aside.reshape(4, 3), EDGES, STIFFNESS, REST_LENGTH, load)
            for sign in (1, -1)
        )
        # Central differences: third derivatives of some 10² N/m³ times 10⁻¹², and rounding of 10 N over 10⁻⁶ m.
        np.testing.assert_allclose((less - more).ravel() / 2e-6, matrix[:, column], atol=1e-7)


def test_a_weight_on_one_spring_stretches_it_by_its_weight_over_the_stiffness():
    place, load = np.array([[0.0, 0.0, 0.0], [0.3, 0.2, 0.1]]), np.array([[0.0, 0.0, 0.0], [0.0, 0.0, -5.0]])
    shape = mesh_truth.equilibrium(place, np.array([1]), np.array([[0, 1]]), 40.0, 0.5, load)
    np.testing.assert_allclose(shape[1], (0.0, 0.0, -0.5 - 5 / 40), atol=1e-10)


def test_a_mesh_that_nothing_holds_has_no_shape_at_rest():
    load = np.tile((0.0, 0.0, -1.0), (4, 1))
    with pytest.raises(RunFailed, match="nothing holds these nodes"):
        mesh_truth.equilibrium(PLACE, np.arange(4), EDGES, STIFFNESS, REST_LENGTH, load)


def catenary(length: float, weight: float, stretch: float, pull: tuple[float, float]) -> tuple[float, float]:
    """Span and rise, m, of an elastic catenary (Irvine, Cable Structures, 1981) that pulls on its lower end like this.

    length: unstretched, m. weight: of all of it, N. stretch: stiffness times length, E A, N. pull: forwards, down, N.
    """
    h, v = pull
    low, high = v / h, (v - weight) / h
    across = h * length / stretch + h * length / weight * (math.asinh(low) - math.asinh(high))
    down = length / stretch * (v - weight / 2) + h * length / weight * (math.hypot(1, low) - math.hypot(1, high))
    return across, -down


def chain_forces(links: int, length: float, weight: float, stretch: float, span: float, rise: float) -> np.ndarray:
    """How a chain of springs, each with half its weight at either end, pulls on its lower end: forwards and down, N."""
    share = np.linspace(0, 1, links + 1)
    place = np.stack([span * share, 0 * share, rise * share - 2 * share * (1 - share)], axis=-1)
    edges = np.stack([np.arange(links), np.arange(links) + 1], axis=-1)
    load = np.zeros((links + 1, 3))
    load[:, 2] = -weight / links * np.where((share == 0) | (share == 1), 0.5, 1.0)
    told = edges, stretch * links / length, length / links
    shape = mesh_truth.equilibrium(place, np.arange(1, links), *told, load)
    assert mesh_truth.softest(shape, np.arange(1, links), *told) > 0
    return mesh_truth.net_force(shape, *told, load)[0, [0, 2]] * (1, -1)


def test_a_fine_chain_is_an_elastic_catenary_to_the_square_of_a_link():
    rope, pull = {"length": 1.5, "weight": 7.0, "stretch": 90.0}, (2.6, 3.1)
    span, rise = catenary(**rope, pull=pull)
    assert 0.1 < rise < span < 1.5, "a rope as one would hang it"
    coarse, fine = (np.abs(chain_forces(links, **rope, span=span, rise=rise) - pull) for links in (8, 16))
    assert np.all(fine < 2e-2)
    np.testing.assert_allclose(coarse / fine, 4, rtol=0.1)  # the next order is 1/8² of it, times some five


def cloth(kinds: int, size: int = 10) -> tuple[np.ndarray, np.ndarray]:
    """Nodes of a square cloth, 1 m apart, and pairs of them: neighbours, diagonals and every second one."""
    row, column = np.divmod(np.arange(size**2), size)
    apart = [np.abs(each[:, None] - each) for each in (row, column)]
    squares = [1, 2, 4][:kinds]
    straight = apart[0] ** 2 + apart[1] ** 2
    edges = np.argwhere(np.isin(straight, squares) & (np.arange(size**2)[:, None] < np.arange(size**2)))
    return np.stack([column, row, 0 * row], axis=-1).astype(float), edges


@pytest.mark.parametrize(("kinds", "limit"), [(1, 1.01), (2, 0.72), (3, 0.646)])
def test_a_cloth_of_ten_by_ten_has_the_limits_of_the_statement(kinds, limit):
    place, edges = cloth(kinds)
    length = np.linalg.norm(place[edges[:, 0]] - place[edges[:, 1]], axis=-1)
    square, mode = mesh_truth.fastest_mode(place, edges, 1.0, length, np.ones(len(place)))
    assert mesh_truth.longest_step(math.sqrt(square)) == pytest.approx(limit, rel=5e-3)  # as many digits as it has
    matrix = mesh_truth.stiffness_matrix(place, edges, 1.0, length)
    np.testing.assert_allclose(matrix @ mode.ravel(), square * mode.ravel(), atol=1e-12)


@pytest.mark.parametrize("damping_ratio", [0.0, 0.25, 2.0])
def test_the_longest_step_is_where_one_step_begins_to_enlarge_a_vibration(damping_ratio):
    def factor(dt: float) -> float:
        after = np.array(
            [[1 - (3 * dt) ** 2, dt * (1 - 6 * damping_ratio * dt)], [-9 * dt, 1 - 6 * damping_ratio * dt]]
        )
        return float(np.abs(np.linalg.eigvals(after)).max())  # of x and v, with ω = 3 rad/s

    limit = mesh_truth.longest_step(3.0, damping_ratio)
    assert factor(0.999 * limit) <= 1 + 1e-12 < 1 + 1e-4 < factor(1.001 * limit)


def test_a_damped_vibration_keeps_the_energy_that_small_steps_leave_it():
    place, speed, dt = 1.0, 0.0, 1e-6
    for _ in range(20000):  # the midpoint rule, of second order
        middle = place + dt / 2 * speed, speed - dt / 2 * (2 * 0.3 * 50 * speed + 2500 * place)
        place, speed = place + dt * middle[1], speed - dt * (2 * 0.3 * 50 * middle[1] + 2500 * middle[0])
    assert mesh_truth.energy_kept(50.0, 0.3, 0.02) == pytest.approx(place**2 + (speed / 50) ** 2, rel=1e-8)
