from __future__ import annotations

import math

import numpy as np
import pytest

from reference.published import published
from solutions import as_printed
from solutions.forces import (
    StokesRegimeWarning,
    ballistic_motion,
    buoyancy,
    drag_correction,
    explicit_euler,
    friction_oscillator,
    reynolds_number,
    runge_kutta_4,
    semi_implicit_euler,
    sphere_shape_factor,
    stokes_drag,
    terminal_velocity,
    terminal_velocity_corrected,
    uniform_gravity,
)
from solutions.friction import friction_force

STILL = np.zeros(3)


def within(case, name, value):
    return value == pytest.approx(case.expected[name], abs=case.tolerance[name])


@pytest.mark.statement(30, oracle="P14: Gazebo's benchmark of free boxes")
@pytest.mark.parametrize("step", [semi_implicit_euler, explicit_euler])
def test_a_first_order_flight_is_off_by_half_a_step_of_gravity(step):
    case = published("P14")
    v, g = np.array(case.setup["velocity"]), np.array(case.setup["gravity"])
    p, dt, duration = np.zeros(3), case.setup["timestep"], case.setup["duration"]
    true, _ = ballistic_motion(p, v, g, duration)
    for _ in range(round(duration / dt)):
        p, v = step(p, v, g, dt)
    assert within(case, "position_error", np.linalg.norm(p - true))
    assert np.sign((p - true)[2]) == (-1 if step is semi_implicit_euler else 1)


@pytest.mark.statement(23, oracle="P16: Siconos' friction oscillator")
def test_dry_friction_takes_two_mu_n_over_k_from_every_swing_and_sticks_where_siconos_does():
    case = published("P16")
    start = (case.setup["displacement"], case.setup["velocity"])
    parameters = (case.setup["stiffness"], case.setup["friction"], case.setup["mass"])
    first = math.atan2(6, 13)  # ω t of the first turning point, seen from the centre −1
    x, v = friction_oscillator(*start, *parameters, first + math.pi * np.arange(6))
    assert v == pytest.approx(np.zeros(6), abs=1e-13)
    assert within(case, "turning_point", x[0])
    assert np.abs(x[:-1]) - np.abs(x[1:]) == pytest.approx(np.full(5, case.expected["fall"]), abs=1e-12)
    end, stuck = friction_oscillator(*start, *parameters, 100.0)
    assert within(case, "sticks_at", end)
    assert stuck == 0


@pytest.mark.statement(23, oracle="P16: Siconos' friction oscillator")
def test_the_friction_force_in_small_steps_sticks_where_siconos_does():
    case = published("P16")
    x, v = np.array([case.setup["displacement"], 0, 0]), np.array([case.setup["velocity"], 0, 0])
    stiffness, dt = case.setup["stiffness"], 1e-2
    for _ in range(3000):
        rub = friction_force(-stiffness * x, v, case.setup["friction"], 1.0, 1.0)
        force = rub - stiffness * x
        after_x, after_v = runge_kutta_4(x, v, lambda p, _, rub=rub: rub - stiffness * p, dt)
        if after_v @ v < 0:  # it turns within the step: to the turning point by the parabola
            time = float(v @ v / -(v @ force))
            after_x, after_v = x + v * time + force * time**2 / 2, STILL
        x, v = after_x, after_v
    # At each of seven turning points a parabola over at most dt leaves up to dt³/6 × 13/s³
    assert x[0] == pytest.approx(case.expected["sticks_at"], abs=1e-4)
    assert v[0] == pytest.approx(0, abs=1e-15)


@pytest.mark.statement(26, oracle="P20: the viscosity of glycerol from a falling sphere")
def test_the_viscosity_of_glycerol_follows_from_the_fall_of_a_sphere_and_is_too_large_without_buoyancy():
    case = published("P20")
    mass, radius, fluid = (case.setup[name] for name in ("mass", "radius", "fluid_density"))
    gravity, speed = (0.0, 0.0, -case.setup["gravity"]), (0.0, 0.0, -case.setup["speed"])
    volume = 4 / 3 * math.pi * radius**3
    weight = uniform_gravity(mass, gravity)
    drag_at_one_pascal_second = stokes_drag(speed, STILL, 1.0, sphere_shape_factor(radius))
    viscosity = -(weight + buoyancy(volume, fluid, gravity))[2] / drag_at_one_pascal_second[2]
    assert within(case, "viscosity", viscosity)
    assert within(case, "viscosity_without_buoyancy", -weight[2] / drag_at_one_pascal_second[2])
    # With the slide's viscosity the slide's own formula gives the speed back, with the right one it does not
    printed = as_printed.terminal_speed(mass, -gravity[2], radius, case.expected["viscosity"])
    assert printed / case.setup["speed"] == pytest.approx(1.19, abs=5e-3)
    # It is a little outside Stokes' regime
    with pytest.warns(StokesRegimeWarning, match=r"Re is 0\.147"):
        fall = terminal_velocity(radius, mass / volume, fluid, viscosity, gravity)
    assert fall == pytest.approx(np.array(speed), rel=1e-14, abs=0)


@pytest.mark.statement(26, oracle="P25: the documentation of fluids")
def test_a_sand_grain_sinks_a_little_slower_than_stokes_says():
    case = published("P25")
    names = ("radius", "density", "fluid_density", "viscosity")
    arguments = [*(case.setup[name] for name in names), (0.0, 0.0, -case.setup["gravity"])]
    with pytest.warns(StokesRegimeWarning, match=r"Re is 0\.299"):
        stokes = terminal_velocity(*arguments)
    assert within(case, "speed_by_stokes", -stokes[2])
    found = terminal_velocity_corrected(*arguments)
    assert within(case, "speed", -found[2])
    reynolds = float(reynolds_number(found, STILL, *(case.setup[n] for n in ("radius", "fluid_density", "viscosity"))))
    theory = 1 + 3 / 16 * reynolds + 9 / 160 * reynolds**2 * math.log(reynolds / 2)
    assert drag_correction(reynolds) == pytest.approx(theory, abs=3e-3)  # the next terms are of order Re³/100
    assert case.expected["speed"] == pytest.approx(found[2] / -1 * 1.014, rel=1e-3, abs=0)


@pytest.mark.statement(26, oracle="P25: the documentation of fluids, with its own drag correlation")
def test_with_the_correlation_of_barati_the_grain_sinks_as_fluids_says_to_its_last_digit():
    drag = pytest.importorskip("fluids.drag")
    case = published("P25")
    names = ("radius", "density", "fluid_density", "viscosity")
    arguments = [*(case.setup[name] for name in names), (0.0, 0.0, -case.setup["gravity"])]

    def barati(reynolds):
        return np.array(drag.Barati(float(reynolds)) * reynolds / 24)

    found = terminal_velocity_corrected(*arguments, correction=barati)
    assert -found[2] == pytest.approx(case.expected["speed"], abs=5e-8)  # half of the last digit printed
