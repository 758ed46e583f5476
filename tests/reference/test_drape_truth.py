"""What theory says of a mesh that lies on a ball, against closed forms, differences and SciPy's own minimisation."""

from __future__ import annotations

import numpy as np
import pytest

from reference import drape_truth, mesh_truth
from reference.catalogue.scenarios import catalogue, settled
from reference.errors import RunFailed
from reference.scene.spring_network import network
from tests.suite.oracles import oracle

RADIUS, WEIGHT, STIFFNESS = 0.1, 2.0, 40.0  # m, N, N/m
DRAPES = {case.name: case.scenarios[0] for case in catalogue()["cloth-over-a-ball"].cases}
each_drape = pytest.mark.parametrize("name", DRAPES)


def one_on_a_spring(anchor, start) -> tuple:
    """A mass on a spring without rest length, and a ball about the origin that the anchor does not meet."""
    load = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, -WEIGHT]])
    ball = drape_truth.Ball(np.zeros(3), np.array([0.0, RADIUS]))
    edges = np.array([[0, 1]])
    return np.array([anchor, start]), np.array([1]), edges, np.array([STIFFNESS]), np.array([0.0]), load, ball


def as_told(name: str) -> tuple:
    net = network(DRAPES[name])
    return net.place, net.free, net.edges, net.stiffness, net.rest_length, net.load, settled.ball_of(DRAPES[name])


# A spring without rest length holds a mass at c = anchor − W/k ẑ, with the energy k |x − c|²/2 and a constant. So the
# least energy outside the ball is at the point of the ball that is nearest to c, or at c itself.


@pytest.mark.parametrize("start", [(0.02, 0.0, 0.2), (-0.3, 0.2, 0.0), (0.05, -0.02, -0.01)])
def test_a_mass_rests_where_the_ball_is_nearest_to_its_place_without(start):
    anchor = np.array([0.07, 0.03, 0.09])
    middle = anchor - (0.0, 0.0, WEIGHT / STIFFNESS)
    assert np.linalg.norm(middle) < RADIUS
    told = one_on_a_spring(anchor, start)
    shape = drape_truth.draped(*told)
    np.testing.assert_allclose(shape[1], RADIUS * middle / np.linalg.norm(middle), atol=1e-11)
    # Pressed with k (R − |c|), so that k less this over R is left of the stiffness across.
    left = STIFFNESS * np.linalg.norm(middle) / RADIUS
    assert drape_truth.softest(shape, *told[1:]) == pytest.approx(left, rel=1e-9)


def test_a_mass_hangs_where_no_ball_is_in_its_way():
    anchor = np.array([0.12, -0.03, 0.02])
    told = one_on_a_spring(anchor, (-0.05, 0.1, 0.1))
    np.testing.assert_allclose(drape_truth.draped(*told)[1], anchor - (0.0, 0.0, WEIGHT / STIFFNESS), atol=1e-11)


def test_masses_that_nothing_holds_slide_off_the_ball():
    place, *_ = one_on_a_spring((0.01, 0.0, 0.11), (0.03, 0.0, 0.11))
    ball, load = drape_truth.Ball(np.zeros(3), np.full(2, RADIUS)), np.tile((0.0, 0.0, -1.0), (2, 1))
    with pytest.raises(RunFailed, match="nothing holds it there"):
        drape_truth.draped(place, np.arange(2), np.array([[0, 1]]), np.array([40.0]), np.array([0.02]), load, ball)


@each_drape
def test_the_forces_of_a_drape_balance_or_press_on_the_ball(name):
    told = as_told(name)
    shape, ball = settled.at_rest(DRAPES[name]), told[-1]
    force = mesh_truth.net_force(shape, *told[2:-1])[told[1]]
    normal, gap = (each[told[1]] for each in ball.outwards(shape))
    on_it = drape_truth.pressed(shape, told[1], mesh_truth.net_force(shape, *told[2:-1]), ball)[told[1]]
    press = -np.sum(force * normal, axis=-1)
    assert np.all(gap >= -1e-15), "m: rounding"
    # Those that rest are pressed, and those that hang are clear, both by far more than the balance leaves, 10⁻¹¹ N.
    assert press[on_it].min() > 0.05
    assert gap[~on_it].min() > 4e-4
    np.testing.assert_allclose(force + np.where(on_it, press, 0.0)[:, None] * normal, 0.0, atol=1e-10)
    assert on_it.sum() == {"structural,radius=0.03": 14, "shear,radius=0.03": 9}[name]


@each_drape
def test_the_stiffness_of_a_drape_is_the_bend_of_its_energy(name):
    told = as_told(name)
    shape, ball = settled.at_rest(DRAPES[name]), told[-1]
    free, springs, load = told[1], told[2:5], told[5]
    force = mesh_truth.net_force(shape, *springs, load)
    on_it, onto = drape_truth.pressed(shape, free, force, ball), drape_truth.allowed(shape, free, *springs, load, ball)
    matrix = drape_truth.stiffness(shape, free, *springs, load, ball)
    for way in np.random.default_rng(28).normal(size=(5, onto.shape[1])):
        aside = 1e-5 * (onto @ way).reshape(-1, 3)
        before, *around = (
            mesh_truth.energy(ball.put_out(shape + sign * aside, on_it), *springs, load) for sign in (0, 1, -1)
        )
        # Fourth derivatives of some 10⁵ N/m³ times 10⁻¹⁰ m², and rounding of 10⁻¹⁶ J over 10⁻¹⁰ m².
        assert (sum(around) - 2 * before) / 1e-10 == pytest.approx(way @ matrix @ way, rel=1e-4)


@each_drape
def test_a_drape_is_where_scipy_finds_the_least_energy(name):
    optimize = oracle("scipy.optimize")
    place, free, *springs, load, ball = as_told(name)

    def shape_of(numbers):
        shape = place.copy()
        shape[free] = numbers.reshape(-1, 3)
        return shape

    def clear(numbers):
        return np.sum((numbers.reshape(-1, 3) - ball.centre) ** 2, axis=-1) - ball.reach[free] ** 2

    def slope_of_clear(numbers):
        slope = np.zeros((len(free), len(free), 3))
        slope[range(len(free)), range(len(free))] = 2 * (numbers.reshape(-1, 3) - ball.centre)
        return slope.reshape(len(free), -1)

    rest = settled.at_rest(DRAPES[name])
    found = optimize.minimize(
        lambda numbers: mesh_truth.energy(shape_of(numbers), *springs, load),
        place[free].ravel(),  # the flat cloth
        jac=lambda numbers: -mesh_truth.net_force(shape_of(numbers), *springs, load)[free].ravel(),
        constraints={"type": "ineq", "fun": clear, "jac": slope_of_clear},
        method="SLSQP",
        options={"ftol": 1e-14, "maxiter": 500},
    )
    assert found.success
    # SLSQP ends where a step gains less than 10⁻¹⁴ J: √(2·10⁻¹⁴/3) m = 8·10⁻⁸ m along the softest motion, 3 N/m.
    np.testing.assert_allclose(found.x.reshape(-1, 3), rest[free], atol=2e-7)
