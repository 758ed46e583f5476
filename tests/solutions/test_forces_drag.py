from __future__ import annotations

import math
import warnings

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles import oracle

from solutions import as_printed
from solutions.forces import (
    LARGEST_REYNOLDS,
    STOKES_LIMIT,
    StokesRegimeWarning,
    buoyancy,
    check_stokes_regime,
    drag_correction,
    drag_motion,
    relaxation_time,
    reynolds_number,
    sample_field,
    sphere_shape_factor,
    spheroid_shape_factors,
    stokes_drag,
    terminal_velocity,
    terminal_velocity_corrected,
    uniform_gravity,
    wind_force,
)

RNG_SEED = 9
STILL = np.zeros(3)
DOWN = np.array([0.0, 0.0, -9.81])
COMPONENT = st.floats(-10, 10).map(lambda value: round(value, 6))
VECTOR = st.tuples(COMPONENT, COMPONENT, COMPONENT).map(np.array)
POSITIVE = st.floats(1e-3, 1e3)
RATIO = st.floats(-3, 3).map(lambda exponent: 10**exponent)


# Stokes' drag


@pytest.mark.statement(26, oracle="arithmetic")
def test_drag_is_six_pi_eta_r_v_against_the_motion_through_the_fluid():
    force = stokes_drag((3.0, 0.0, 1.0), (1.0, 0.0, 1.0), 0.5, 0.1)
    assert force == pytest.approx([-6 * math.pi * 0.5 * 0.1 * 2, 0, 0], rel=1e-15, abs=0)


@given(VECTOR, VECTOR, POSITIVE, POSITIVE)
def test_drag_only_takes_energy_and_none_from_a_body_that_drifts_along(v, u, viscosity, radius):
    assert not stokes_drag(u, u, viscosity, radius).any()
    assert stokes_drag(v, u, viscosity, radius) @ (v - u) <= 0


@given(VECTOR, VECTOR, VECTOR)
def test_a_moving_observer_sees_the_same_drag(v, u, boost):
    force = stokes_drag(v, u, 2.0, 0.2)
    assert stokes_drag(v + boost, u + boost, 2.0, 0.2) == pytest.approx(force, abs=2e-13)  # 7.5 times numbers up to 30


@pytest.mark.erratum(26)
def test_the_slides_drag_stops_a_leaf_that_drifts_along_a_river():
    river = np.array([2.0, 0.0, 0.0])
    still = as_printed.viscous_force(river, sphere_shape_factor(0.01), 1e-3)
    assert still == pytest.approx([-3.77e-4, 0, 0], abs=5e-7)
    assert not stokes_drag(river, river, 1e-3, 0.01).any()
    assert np.array_equal(still, stokes_drag(river, STILL, 1e-3, 0.01))  # it is right in a fluid at rest


# Where Stokes ends


def test_the_reynolds_number_compares_inertia_with_viscosity():
    # A ball of 2 cm at 3 m/s through water that moves with it at 1 m/s
    assert reynolds_number((3.0, 0, 0), (1.0, 0, 0), 0.01, 1000.0, 1e-3) == pytest.approx(40_000, rel=1e-15, abs=0)


@pytest.mark.statement(26, oracle="fluids: Reynolds")
def test_the_reynolds_number_is_that_of_the_package_fluids():
    fluids = oracle("fluids")
    rng = np.random.default_rng(RNG_SEED)
    for v, radius, rho, eta in rng.uniform(0.1, 10, size=(20, 4)):
        theirs = fluids.Reynolds(V=v, D=2 * radius, rho=rho, mu=eta)
        assert reynolds_number((0, -v, 0), STILL, radius, rho, eta) == pytest.approx(theirs, rel=1e-14, abs=0)


@pytest.mark.statement(26, oracle="the excess of the measured drag in the lecture's erratum")
def test_stokes_law_is_right_to_two_percent_where_the_warning_begins():
    assert STOKES_LIMIT == 0.1
    assert drag_correction(STOKES_LIMIT) - 1 == pytest.approx(0.018, abs=5e-4)
    assert drag_correction(1.0) - 1 == pytest.approx(0.13, abs=5e-3)


def test_a_fast_flow_is_warned_of_and_a_slow_one_is_not():
    with pytest.warns(StokesRegimeWarning, match=r"here Re is 0\.2$"):
        check_stokes_regime([0.05, 0.2, 0.11])
    check_stokes_regime(STOKES_LIMIT)  # any warning is an error here
    check_stokes_regime([])
    assert issubclass(StokesRegimeWarning, UserWarning)


def test_the_warning_points_at_the_line_that_asked_for_the_fall():
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        terminal_velocity(1e-3, 2600.0, 1000.0, 1e-3, DOWN)
    assert caught[0].filename == __file__


# Falling through a fluid


@pytest.mark.statement(26, oracle="scipy brentq on the balance of weight, buoyancy and drag")
@pytest.mark.parametrize("density", [2600.0, 900.0])
def test_at_the_terminal_velocity_weight_buoyancy_and_drag_cancel(density):
    optimize = oracle("scipy.optimize")
    radius, fluid, viscosity, volume = 1e-4, 1000.0, 0.05, 4 / 3 * math.pi * 1e-12

    def net(v):
        force = uniform_gravity(density * volume, DOWN) + buoyancy(volume, fluid, DOWN)
        return float((force + stokes_drag((0, 0, v), STILL, viscosity, radius))[2])

    v = terminal_velocity(radius, density, fluid, viscosity, DOWN)
    assert v[2] == pytest.approx(
        optimize.brentq(net, -1, 1, xtol=1e-16), rel=1e-11, abs=0
    )  # a root to 1e-16 of 1e-4 m/s
    assert (v[2] < 0) == (density > fluid)


def test_a_bubble_rises_and_a_drop_of_the_fluid_itself_stays():
    fall = terminal_velocity(1e-5, [0.0, 1000.0, 2000.0], 1000.0, 1e-3, DOWN)
    assert fall[:, 2].tolist() == [-fall[2, 2], 0.0, fall[2, 2]]
    assert fall[0, 2] > 0


@pytest.mark.erratum(26)
def test_by_the_slide_a_bubble_sinks():
    radius, air, water = 1e-5, 1.2, 1000.0
    mass = air * 4 / 3 * math.pi * radius**3
    assert as_printed.terminal_speed(mass, 9.81, radius, 1e-3) > 0
    assert terminal_velocity(radius, air, water, 1e-3, DOWN) @ DOWN < 0
    # A grain of sand is only 1 − ρ_f/ρ_s as fast in truth
    mass, sand = 2600 / air * mass, terminal_velocity(radius, 2600.0, water, 1e-3, DOWN)
    assert np.linalg.norm(sand) / as_printed.terminal_speed(mass, 9.81, radius, 1e-3) == pytest.approx(1 - 1 / 2.6)


@pytest.mark.statement(26, oracle="fluids: v_terminal by Stokes")
def test_the_terminal_speed_is_that_of_the_package_fluids():
    fluids = oracle("fluids")
    theirs = fluids.v_terminal(D=2e-5, rhop=2600.0, rho=1000.0, mu=1e-3, Method="Stokes")
    gravity = (0, 0, -9.80665)
    assert np.linalg.norm(terminal_velocity(1e-5, 2600.0, 1000.0, 1e-3, gravity)) == pytest.approx(
        theirs, rel=1e-14, abs=0
    )


@pytest.mark.parametrize("density", [1.2, 2600.0])
def test_a_fall_that_is_too_fast_for_stokes_warns_and_so_does_a_rise(density):
    # Re = 2 r ρ_f v/η: the density of the fluid counts, and that of the body only through its speed
    speed = 2 * abs(density - 1000) * 1e-8 * 9.81 / 9e-3
    with pytest.warns(StokesRegimeWarning, match=f"Re is {2e-4 * 1000 * speed / 1e-3:.3g}$"):
        terminal_velocity(1e-4, density, 1000.0, 1e-3, DOWN)


@pytest.mark.statement(26, oracle="scipy solve_ivp DOP853")
@pytest.mark.parametrize("wind", [STILL, np.array([1.0, -2.0, 0.5])])
def test_the_motion_in_closed_form_is_what_the_forces_integrate_to(wind):
    integrate = oracle("scipy.integrate")
    radius, density, fluid, viscosity = 1e-4, 2600.0, 1000.0, 0.05
    mass, factor = density * 4 / 3 * math.pi * radius**3, sphere_shape_factor(radius)
    constant = uniform_gravity(mass, DOWN) + buoyancy(mass / density, fluid, DOWN)
    tau = relaxation_time(mass, factor, viscosity)

    def rate(_, state):
        return np.concatenate([state[3:], (constant + stokes_drag(state[3:], wind, viscosity, radius)) / mass])

    start = np.array([1.0, 2.0, 3.0, 0.1, 0.0, 1.0])
    found = integrate.solve_ivp(rate, (0, 5 * tau), start, method="DOP853", rtol=1e-12, atol=1e-16)
    last = wind + terminal_velocity(radius, density, fluid, viscosity, DOWN)
    p, v = drag_motion(start[:3], start[3:], last, tau, 5 * tau)
    assert p == pytest.approx(found.y[:3, -1], abs=1e-13)  # rtol of places near 1 m, travelled by 1e-3
    assert v == pytest.approx(found.y[3:, -1], abs=1e-10)  # rtol over some dozens of steps


def test_a_fall_has_63_percent_of_its_speed_after_one_relaxation_time():
    _, v = drag_motion(STILL, STILL, (0, 0, -2.0), 3.0, 3.0)
    assert v[2] == pytest.approx(-2 * (1 - math.exp(-1)), rel=1e-15, abs=0)


@given(VECTOR, VECTOR, VECTOR, st.floats(0.1, 10), st.floats(0, 10), st.floats(0, 10))
def test_two_falls_one_after_the_other_are_one_long_fall(p, v, last, tau, first, second):
    halfway = drag_motion(p, v, last, tau, first)
    then, whole = drag_motion(*halfway, last, tau, second), drag_motion(p, v, last, tau, first + second)
    assert then[0] == pytest.approx(whole[0], abs=1e-12)  # some ten roundings of ways up to 400 m
    assert then[1] == pytest.approx(whole[1], abs=1e-13)


def test_a_fall_much_shorter_than_the_relaxation_time_is_free():
    tau, t = 1e6, 1.0
    p, v = drag_motion(STILL, (1.0, 0, 0), DOWN * tau, tau, t)
    # The next order is t/τ of the effect
    assert p == pytest.approx([1, 0, -9.81 / 2], rel=1e-6, abs=0)
    assert v == pytest.approx([1, 0, -9.81], rel=1e-6, abs=0)


# Drag beyond Stokes


@pytest.mark.statement(26, oracle="fluids: Clift")
def test_the_drag_of_a_sphere_is_the_fit_of_clift_grace_and_weber():
    drag = oracle("fluids.drag")
    # From 0.01 on: below, the package adds 3/16 to C_D where Oseen has 3/16 of 24
    reynolds = np.geomspace(0.011, 3.3e5, 400)
    theirs = np.array([drag.Clift(re) * re / 24 for re in reynolds])
    assert drag_correction(reynolds) == pytest.approx(theirs, rel=1e-13, abs=0)  # powers of ten


def test_the_pieces_of_the_fit_meet_and_grow():
    for end in (0.01, 20.0, 260.0, 1500.0, 1.2e4, 4.4e4):
        below, above = drag_correction([end * (1 - 1e-9), end * (1 + 1e-9)])
        assert below == pytest.approx(above, rel=0.01, abs=0)  # the fit's own mismatch, at most 0.9 %
    assert np.all(np.diff(drag_correction(np.geomspace(1e-6, LARGEST_REYNOLDS, 2000))) > -0.01)


@given(st.floats(0, 0.0099))
def test_in_a_creeping_flow_the_correction_is_oseens(reynolds):
    # The next term of the theory, 9/160 Re² ln(Re/2), is below 3e-5
    assert drag_correction(reynolds) == pytest.approx(1 + 3 / 16 * reynolds, abs=3e-5)


def test_a_turbulent_flow_is_refused():
    assert drag_correction(LARGEST_REYNOLDS) > 1000
    with pytest.raises(ValueError, match=r"reynolds must be from 0 to 338000, not 338001"):
        drag_correction([1.0, 338001.0])
    with pytest.raises(ValueError, match="the fall is too fast: its Reynolds number is above 338000"):
        terminal_velocity_corrected(1.0, 8000.0, 1000.0, 1e-3, DOWN)


@pytest.mark.statement(26, oracle="fluids: v_terminal by Clift")
@pytest.mark.parametrize("radius", [3.5e-5, 5e-4, 5e-3])
def test_a_fall_with_the_measured_drag_is_that_of_the_package_fluids(radius):
    fluids = oracle("fluids")
    theirs = fluids.v_terminal(D=2 * radius, rhop=2600.0, rho=1000.0, mu=1e-3, Method="Clift")
    ours = terminal_velocity_corrected(radius, 2600.0, 1000.0, 1e-3, (0, -9.80665, 0))
    assert ours[1] == pytest.approx(-theirs, rel=1e-9, abs=0)  # the package solves to 1e-10 or so


def test_a_creeping_fall_needs_no_correction():
    arguments = ([1e-6, 1e-6, 1e-6], [2000.0, 1000.0, 0.0], 1000.0, 1e-2, DOWN)
    # 3/16 of a Reynolds number of 4e-8
    assert terminal_velocity_corrected(*arguments) == pytest.approx(terminal_velocity(*arguments), rel=1e-7, abs=0)


def test_a_fall_in_vacuum_or_without_gravity_has_no_drag_to_correct():
    assert terminal_velocity_corrected(1e-5, 2000.0, 1000.0, 1e-3, STILL).tolist() == [0, 0, 0]
    vacuum = terminal_velocity_corrected(1e-5, 2000.0, 0.0, 1e-3, DOWN)
    assert vacuum == pytest.approx(terminal_velocity(1e-5, 2000.0, 0.0, 1e-3, DOWN), rel=1e-15, abs=0)  # Re = 0


def test_a_correction_of_ones_own_is_used():
    ours = terminal_velocity_corrected(1e-3, 2600.0, 1000.0, 1e-3, DOWN, correction=lambda re: 1 + re)
    stokes = 2 * 1600 * 1e-6 * 9.81 / (9e-3)
    # Re (1 + Re) = S
    reynolds = (math.sqrt(1 + 4 * 2000 * stokes) - 1) / 2
    assert ours[2] == pytest.approx(-reynolds / 2000, rel=1e-12, abs=0)


# Spheroids


@given(POSITIVE)
def test_a_spheroid_with_equal_axes_is_a_sphere(radius):
    factors = spheroid_shape_factors(radius, radius)
    assert factors == pytest.approx([6 * math.pi * radius] * 2, rel=1e-15, abs=0)
    assert sphere_shape_factor(radius) == pytest.approx(6 * math.pi * radius, rel=1e-15, abs=0)


@pytest.mark.statement(26, oracle="scipy: Carlson's elliptic integrals in Oberbeck's solution")
@given(RATIO, POSITIVE)
def test_the_shape_factors_are_oberbecks_elliptic_integrals(ratio, across):
    check_against_carlson(ratio * across, across)


@pytest.mark.statement(26, oracle="scipy: Carlson's elliptic integrals in Oberbeck's solution")
@given(st.floats(-0.2, 0.2))
def test_the_shape_factors_keep_their_digits_near_a_sphere(difference):
    check_against_carlson(1 + difference, 1.0)
    check_against_carlson(1 + difference**5, 1.0)


@pytest.mark.parametrize("m", [-0.2501, -0.2499, 0.2499, 0.2501])
def test_series_and_closed_form_of_the_shape_factors_meet(m):
    check_against_carlson(1.0, math.sqrt(1 - m))


def check_against_carlson(a, b):
    """Oberbeck 1876: K_i = 16π/(χ + a_i² α_i), with the integrals χ = 2 R_F and α_i = 2/3 R_D of the squared axes."""
    special = oracle("scipy.special")
    chi = 2 * special.elliprf(a * a, b * b, b * b)
    along = 2 / 3 * a * a * special.elliprd(b * b, b * b, a * a)
    across = 2 / 3 * b * b * special.elliprd(a * a, b * b, b * b)
    theirs = [16 * math.pi / (chi + along), 16 * math.pi / (chi + across)]
    # Some ten roundings; where the closed forms begin, |1 − b²/a²| = 1/4, they cancel half a digit more
    assert spheroid_shape_factors(a, b) == pytest.approx(theirs, rel=5e-15, abs=0)


@pytest.mark.statement(26, oracle="the known drag of a disc: 16 b broadside, 32/3 b edgewise")
def test_a_disc_still_has_drag():
    assert spheroid_shape_factors(0.0, 0.1) == pytest.approx([1.6, 3.2 / 3], rel=1e-15, abs=0)
    assert spheroid_shape_factors([0.0, 1e-60], 2.0) == pytest.approx(np.array([[32, 64 / 3]] * 2), rel=1e-15, abs=0)


@pytest.mark.statement(26, oracle="slender-body theory")
def test_a_needle_is_half_as_hard_to_move_lengthwise_as_broadside():
    along, across = spheroid_shape_factors(1.0, 1e-9)
    log = math.log(2e9)
    # 4π a/(ln(2a/b) − 1/2) and 8π a/(ln(2a/b) + 1/2); the next terms are (b/a)²
    assert along == pytest.approx(4 * math.pi / (log - 0.5), rel=1e-13, abs=0)
    assert across == pytest.approx(8 * math.pi / (log + 0.5), rel=1e-13, abs=0)


@given(RATIO, POSITIVE, POSITIVE)
def test_the_shape_factor_is_proportional_to_size_and_grows_with_each_axis(ratio, across, factor):
    factors = spheroid_shape_factors(ratio * across, across)
    scaled = spheroid_shape_factors(ratio * across * factor, across * factor)
    assert scaled == pytest.approx(factor * factors, rel=1e-12, abs=0)  # (a − b)(a + b) near a sphere
    assert np.all(spheroid_shape_factors(1.01 * ratio * across, across) > factors)
    assert np.all(spheroid_shape_factors(ratio * across, 1.01 * across) > factors)


def test_long_and_flat_spheroids_and_spheres_can_come_in_one_batch():
    axes = np.array([0.0, 0.3, 0.95, 1.0, 1.05, 4.0])
    together = spheroid_shape_factors(axes, 1.0)
    assert together.shape == (6, 2)
    for axis, factors in zip(axes, together, strict=True):
        assert np.array_equal(spheroid_shape_factors(axis, 1.0), factors)


# Wind


def linear_wind(x):
    matrix = np.array([[0.5, -1, 2], [0, 1, -0.5], [1, 1, 1]])
    return x @ matrix.T + [1, 2, 3]


@pytest.mark.statement(30, oracle="a wind that is linear in space")
@given(st.tuples(st.floats(-1, 2), st.floats(0, 1.5), st.floats(2, 2.5)).map(np.array))
def test_a_wind_that_is_linear_in_space_is_sampled_exactly(x):
    origin, spacing = np.array([-1.0, 0.0, 2.0]), np.array([1.0, 0.5, 0.25])
    nodes = origin + spacing * np.stack(np.meshgrid(range(4), range(4), range(3), indexing="ij"), axis=-1)
    assert sample_field(x, linear_wind(nodes), origin, spacing) == pytest.approx(linear_wind(x), abs=1e-13)


@pytest.mark.statement(30, oracle="scipy: RegularGridInterpolator")
def test_any_wind_is_sampled_as_by_scipys_interpolator():
    interpolate = oracle("scipy.interpolate")
    rng = np.random.default_rng(RNG_SEED)
    field, x = rng.normal(size=(4, 5, 3, 3)), rng.uniform(0, 1, size=(50, 3)) * [3, 4, 2]
    theirs = interpolate.RegularGridInterpolator((range(4), range(5), range(3)), field)(x)
    assert sample_field(x, field, STILL, 1.0) == pytest.approx(theirs, abs=1e-14)


def test_outside_the_grid_the_wind_is_that_of_its_nearest_point():
    field = np.arange(24.0).reshape(2, 2, 2, 3)
    assert sample_field((-5.0, 9.0, 0.0), field, STILL, 1.0).tolist() == field[0, 1, 0].tolist()
    assert sample_field((math.inf, 0.0, 9.0), field, STILL, 1.0).tolist() == field[1, 0, 1].tolist()
    assert sample_field((3.0, 4.0, 5.0), field[:1, :1, :1], STILL, 1.0).tolist() == [0, 1, 2]


@pytest.mark.statement(30, oracle="the drag of a ball in a steady wind, computed from its pressure")
def test_wind_pushes_with_the_square_of_the_relative_velocity():
    # Air of 1.2 kg/m³ at 10 m/s: 60 Pa; a ball of 0.1 m²: 0.47 × 6 N
    assert wind_force(STILL, (10.0, 0, 0), 0.1, 0.47, 1.2) == pytest.approx([2.82, 0, 0], rel=1e-14, abs=0)
    assert wind_force((0, 0, -10.0), STILL, 0.1, 0.47, 1.2) == pytest.approx([0, 0, 2.82], rel=1e-14, abs=0)
    assert wind_force((30.0, 0, 0), (10.0, 0, 0), 0.1, 0.47, 1.2)[0] == pytest.approx(-4 * 2.82, rel=1e-14, abs=0)


@pytest.mark.erratum(30)
@given(VECTOR, VECTOR)
def test_the_force_of_wind_depends_on_the_relative_velocity(v, wind):
    assert not wind_force(wind, wind, 0.1, 0.47, 1.2).any()
    assert wind_force(v, wind, 0.1, 0.47, 1.2) @ (v - wind) <= 0


@given(st.floats(1e-9, 1e-6))
def test_with_the_drag_coefficient_24_over_re_the_wind_force_is_stokes(speed):
    radius, rho, eta = 1e-3, 1.2, 1.8e-5
    coefficient = 24 / reynolds_number((speed, 0, 0), STILL, radius, rho, eta)
    force = wind_force((speed, 0, 0), STILL, math.pi * radius**2, coefficient, rho)
    assert force == pytest.approx(stokes_drag((speed, 0, 0), STILL, eta, radius), rel=1e-14, abs=0)


# Input


@pytest.mark.parametrize(
    ("call", "named"),
    [
        (lambda: stokes_drag((1, 2), STILL, 1.0, 1.0), "velocity must have shape"),
        (lambda: stokes_drag(STILL, (1, 2), 1.0, 1.0), "fluid_velocity must have shape"),
        (lambda: stokes_drag(STILL, STILL, -1.0, 1.0), "viscosity must be zero or positive, not -1"),
        (lambda: stokes_drag(STILL, STILL, 1.0, -1.0), "radius must be"),
        (lambda: buoyancy(-1.0, 1.0, DOWN), "volume must be"),
        (lambda: buoyancy(1.0, -1.0, DOWN), "fluid_density must be"),
        (lambda: relaxation_time(0.0, 1.0, 1.0), "mass must be positive"),
        (lambda: relaxation_time(1.0, 0.0, 1.0), "shape_factor must be positive"),
        (lambda: relaxation_time(1.0, 1.0, 0.0), "viscosity must be positive"),
        (lambda: terminal_velocity(0.0, 1.0, 1.0, 1.0, DOWN), "radius must be positive"),
        (lambda: terminal_velocity(1.0, -1.0, 1.0, 1.0, DOWN), "density must be"),
        (lambda: terminal_velocity(1.0, 1.0, -1.0, 1.0, DOWN), "fluid_density must be"),
        (lambda: terminal_velocity(1.0, 1.0, 1.0, 0.0, DOWN), "viscosity must be positive"),
        (lambda: terminal_velocity_corrected(0.0, 1.0, 1.0, 1.0, DOWN), "radius must be positive"),
        (lambda: terminal_velocity_corrected(1.0, -1.0, 1.0, 1.0, DOWN), "density must be"),
        (lambda: terminal_velocity_corrected(1.0, 1.0, -1.0, 1.0, DOWN), "fluid_density must be"),
        (lambda: terminal_velocity_corrected(1.0, 1.0, 1.0, 0.0, DOWN), "viscosity must be positive"),
        (lambda: drag_motion(STILL, STILL, STILL, 0.0, 1.0), "relaxation must be positive"),
        (lambda: drag_motion(STILL, STILL, STILL, math.inf, 1.0), "relaxation must be finite"),
        (lambda: reynolds_number(STILL, STILL, -1.0, 1.0, 1.0), "radius must be"),
        (lambda: reynolds_number(STILL, STILL, 1.0, -1.0, 1.0), "fluid_density must be"),
        (lambda: reynolds_number(STILL, STILL, 1.0, 1.0, 0.0), "viscosity must be positive"),
        (lambda: check_stokes_regime(-1.0), "reynolds must be"),
        (lambda: drag_correction(math.nan), "reynolds must be zero or positive, not nan"),
        (lambda: sphere_shape_factor(-1.0), "radius must be"),
        (lambda: spheroid_shape_factors(-1.0, 1.0), "along must be zero or positive, not -1"),
        (lambda: spheroid_shape_factors(1.0, 0.0), "across must be positive, not 0"),
        (lambda: spheroid_shape_factors(math.inf, 1.0), "along must be finite"),
        (lambda: spheroid_shape_factors(1.0, math.inf), "across must be finite"),
        (lambda: sample_field(STILL, np.zeros((2, 2, 3)), STILL, 1.0), r"field must have shape \(nx, ny, nz, 3\)"),
        (lambda: sample_field(STILL, np.zeros((2, 2, 2, 2)), STILL, 1.0), "field must have shape"),
        (lambda: sample_field(STILL, np.zeros((0, 2, 2, 3)), STILL, 1.0), "field must have shape"),
        (lambda: sample_field(STILL, np.zeros((2, 2, 2, 3)), STILL, 0.0), "spacing must be positive"),
        (lambda: sample_field((math.nan, 0, 0), np.zeros((2, 2, 2, 3)), STILL, 1.0), "position must be a number"),
        (lambda: wind_force(STILL, STILL, -1.0, 1.0, 1.0), "area must be"),
        (lambda: wind_force(STILL, STILL, 1.0, -1.0, 1.0), "drag_coefficient must be"),
        (lambda: wind_force(STILL, STILL, 1.0, 1.0, -1.0), "density must be"),
    ],
)
def test_numbers_without_meaning_are_refused_by_name(call, named):
    with pytest.raises(ValueError, match=named):
        call()


def test_many_bodies_in_a_fluid_at_once_are_as_one_after_another():
    rng = np.random.default_rng(RNG_SEED)
    v, u, gravity = rng.normal(size=(3, 4, 5, 3))
    one, two, three, four = rng.uniform(0.5, 1, size=(4, 4, 5))
    field = rng.normal(size=(3, 3, 3, 3))
    for array in (v, u, gravity, one, two, three, four, field):
        array.flags.writeable = False  # writing to one would raise
    calls = [
        (stokes_drag, (v, u, one, two)),
        (buoyancy, (one, two, gravity)),
        (relaxation_time, (one, two, three)),
        (drag_motion, (v, u, gravity, one, two)),
        (reynolds_number, (v, u, one, two, three)),
        (terminal_velocity_corrected, (one, two, three, four, gravity)),
        (drag_correction, (100 * one,)),
        (wind_force, (v, u, one, two, three)),
        (lambda x: sample_field(x, field, (-1.0, -1.0, -1.0), 0.7), (v,)),
    ]
    for function, arguments in calls:
        together = function(*arguments)
        for at in np.ndindex(4, 5):
            alone = function(*(argument[at] for argument in arguments))
            pairs = zip(together, alone, strict=True) if isinstance(together, tuple) else [(together, alone)]
            for several, single in pairs:
                # Sums over the last axis may be grouped differently in a batch
                assert several[at] == pytest.approx(np.asarray(single), rel=1e-13, abs=1e-15)


def test_a_fall_with_next_to_no_drag_is_the_free_fall_less_a_little():
    # The first two terms of the series in x = t/τ: p = v0 t + g t²/2 − (v0 t²/2 + g t³/6)/τ; the next is x²/12 of it
    start, gravity, time = np.array([1.0, -2.0, 3.0]), np.array([0.5, 0.0, -9.81]), np.array([[1e-4], [0.7], [3.0]])
    for tau in (1e8, 1e11, 1e14):
        place, velocity = drag_motion(np.zeros(3), start, gravity * tau, tau, time[:, 0])
        slowed = (start * time**2 / 2 + gravity * time**3 / 6) / tau
        # Roundings of v0 t and g t²/2, and x² is 1e-15 at most
        np.testing.assert_allclose(place, start * time + gravity * time**2 / 2 - slowed, rtol=1e-14)
        np.testing.assert_allclose(
            velocity, start + gravity * time - (start * time + gravity * time**2 / 2) / tau, rtol=1e-14
        )
    # Where the series ends, at x = 1/2, both forms agree with an integral over short pieces
    for x in (0.49999, 0.5, -0.4):
        pieces = (np.arange(4000) + 0.5) / 4000 * x
        integral = np.mean(1 - np.exp(-pieces)) * x
        found, _ = drag_motion(np.zeros(3), np.zeros(3), np.array([0, 0, 1.0]), 1.0, x)
        assert found[2] == pytest.approx(integral, rel=2e-8)  # (x/4000)²/24 and more
