from __future__ import annotations

import math

import numpy as np
import pytest
from oracles import oracle

from reference.published.theirs import published
from solutions import as_printed
from solutions.forces import (
    StokesRegimeWarning,
    ballistic_motion,
    drag_correction,
    explicit_euler,
    friction_oscillator,
    reynolds_number,
    runge_kutta_4,
    terminal_velocity,
    terminal_velocity_corrected,
)
from solutions.friction import friction_force

STILL = np.zeros(3)


@pytest.mark.statement(30, oracle="P14: Gazebo's benchmark of free boxes")
def test_a_first_order_flight_is_off_by_half_a_step_of_gravity(as_published):
    found = as_published("P14")["position_error"][0]
    case = published("P14")
    v, g = (np.array(case.numbers(name)) for name in ("velocity", "gravity"))
    p, (dt, duration) = np.zeros(3), case.values("timestep", "duration")
    true, _ = ballistic_motion(p, v, g, duration)
    for _ in range(round(duration / dt)):
        p, v = explicit_euler(p, v, g, dt)
    # With the forces first it ends as far above as the other below
    assert (p - true)[2] == pytest.approx(found, abs=case.tolerance["position_error"])


@pytest.mark.statement(23, oracle="P16: Siconos' friction oscillator")
def test_dry_friction_takes_two_mu_n_over_k_from_every_swing(as_published):
    as_published("P16")
    case = published("P16")
    start, parameters = case.values("displacement", "velocity"), case.values("stiffness", "friction", "mass")
    first = math.atan2(6, 13)  # ω t of the first turning point, seen from the centre −1
    x, v = friction_oscillator(*start, *parameters, first + math.pi * np.arange(6))
    assert v == pytest.approx(np.zeros(6), abs=1e-13)
    assert np.abs(x[:-1]) - np.abs(x[1:]) == pytest.approx(np.full(5, case.expected["fall"]), abs=1e-12)
    assert friction_oscillator(*start, *parameters, 100.0)[1] == 0


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
def test_the_viscosity_of_glycerol_follows_from_the_fall_of_a_sphere(as_published):
    viscosity = as_published("P20")["viscosity"][0]
    case = published("P20")
    mass, radius, fluid, speed = case.values("mass", "radius", "fluid_density", "speed")
    gravity = (0.0, 0.0, -case.value("gravity"))
    # With the slide's viscosity the slide's own formula gives the speed back, with the right one it does not
    printed = as_printed.terminal_speed(mass, -gravity[2], radius, case.expected["viscosity"])
    assert printed / speed == pytest.approx(1.19, abs=5e-3)
    # It is a little outside Stokes' regime
    with pytest.warns(StokesRegimeWarning, match=r"Re is 0\.147"):
        fall = terminal_velocity(radius, mass / (4 / 3 * math.pi * radius**3), fluid, viscosity, gravity)
    assert fall == pytest.approx(np.array([0.0, 0.0, -speed]), rel=1e-14, abs=0)


@pytest.mark.statement(26, oracle="P25: the documentation of fluids")
def test_a_sand_grain_sinks_a_little_slower_than_stokes_says(as_published):
    speed = as_published("P25")["speed"][0]
    case = published("P25")
    radius, density, fluid, viscosity = case.values("radius", "density", "fluid_density", "viscosity")
    with pytest.warns(StokesRegimeWarning, match=r"Re is 0\.299"):
        terminal_velocity(radius, density, fluid, viscosity, (0.0, 0.0, -case.value("gravity")))
    reynolds = float(reynolds_number(np.array([0.0, 0.0, -speed]), STILL, radius, fluid, viscosity))
    theory = 1 + 3 / 16 * reynolds + 9 / 160 * reynolds**2 * math.log(reynolds / 2)
    assert drag_correction(reynolds) == pytest.approx(theory, abs=3e-3)  # the next terms are of order Re³/100
    assert case.expected["speed"] == pytest.approx(1.014 * speed, rel=1e-3, abs=0)


@pytest.mark.statement(26, oracle="P25: the documentation of fluids, with its own drag correlation")
def test_with_baratis_correlation_the_grain_sinks_exactly_as_in_fluids():
    drag = oracle("fluids.drag")
    case = published("P25")
    names = ("radius", "density", "fluid_density", "viscosity")
    arguments = [*(case.setup[name] for name in names), (0.0, 0.0, -case.setup["gravity"])]

    def barati(reynolds):
        return np.array(drag.Barati(float(reynolds)) * reynolds / 24)

    found = terminal_velocity_corrected(*arguments, correction=barati)
    assert -found[2] == pytest.approx(case.expected["speed"], abs=5e-8)  # half of the last digit printed


@pytest.mark.statement(25, oracle="P39: the figure of eight of Chenciner, Montgomery and Simó")
def test_three_bodies_have_changed_places_after_a_third_of_a_period(as_published):
    as_published("P39")


@pytest.mark.statement(27, oracle="P40: a textbook's block on a spring")
def test_a_block_on_a_spring_swings_as_fast_as_the_textbook_says(as_published):
    as_published("P40")
