"""What is measured of two balls, rods and cradles, and what is expected of a method, on made-up trajectories."""

from __future__ import annotations

import math

import numpy as np
import pytest

from reference import truth
from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.rods import END
from reference.engines.base import AT_STEP, COMPLIANT, EXACT, Method
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

G = 9.81


def ended(family: str, case: str, **velocities) -> dict[str, float]:
    """What is measured of a trajectory that ends with these velocities, 6 numbers a body: linear and angular."""
    scenario = catalogue()[family].case(case).scenarios[0]
    states = np.array([[(*body.velocity, *body.angular_velocity) for body in scenario.bodies]] * 2)
    for body, values in velocities.items():
        states[1, scenario.index(body.replace("_", " "))] = values
    places = np.array([[body.position for body in scenario.bodies]] * 2)
    turns = np.array([[body.orientation for body in scenario.bodies]] * 2)
    times = np.array([0.0, scenario.duration])
    made = Trajectory(scenario, Settings(1e-3), "made", times, places, turns, states[..., :3], states[..., 3:])
    return {quantity.name: quantity.measure(made) for quantity in catalogue()[family].quantities}


# The measures, on trajectories made up so that the number is known


def test_two_balls_are_judged_by_speeds_directions_and_energy():
    found = ended("two-balls", "e=0.8,m=3,b=0.5", striker=(0.6, 0.8, 0, 0, 0, 0), target=(0.3, -0.4, 0, 0, 0, 0))
    expected = {"striker": 1.0, "target": 0.5, "way": math.atan2(4, 3), "corner": -0.14 / 4, "energy": 1.75 / 4}
    assert found == pytest.approx(expected, rel=1e-14)


def test_a_rod_is_judged_by_impulse_spin_and_separating_speed():
    found = ended("struck-rod", "e=0.5,x=0.25", ball=(0, 0, -1.5, 0, 0, 0), rod=(0, 0, -0.5, 0, 4, 0))
    # The ball has lost 0.5 of 2 m/s; the rod's point goes down with 0.5 + 4 · 0.25.
    assert found == pytest.approx({"impulse": 0.25, "spin": 4.0, "kept": 0.0}, abs=1e-15)


def test_a_rod_on_a_peg_is_judged_without_its_weight():
    case = catalogue()["rod-on-peg"].case("e=0.5,x=0.25").scenarios[0]
    speed = truth.impact_speed(0.5, G)
    down = -G * case.duration + 0.5 * speed  # fallen all the time, and pushed up once by half of m v
    found = ended("rod-on-peg", "e=0.5,x=0.25", rod=(0, 0, down, 0, -3.0, 0))
    expected = {"impulse": 0.5, "spin": 3.0, "kept": 0.5 - 1 + 3.0 * 0.25 / speed}
    assert found == pytest.approx(expected, abs=1e-14)


def test_a_cradle_is_judged_by_its_ends_reading_momentum_and_energy():
    def of(case, *velocities, family="cradle"):
        return ended(family, case, **{f"ball_{n}": (v, 0, 0, 0, 0, 0) for n, v in enumerate(velocities, 1)})

    at_once = of("3 touching", -0.3, 0.65, 0.65)  # the readings are (0, 0, 1), (−1/3, 2/3, 2/3) and no third
    assert at_once == pytest.approx(
        {"first": -0.3, "last": 0.65, "off": 1 / 30, "momentum": 1.0, "energy": 0.09 + 2 * 0.65**2}, rel=1e-13
    )
    assert of("5, 1 µm apart", -0.6, 0.4, 0.4, 0.4, 0.4)["off"] == pytest.approx(0.6)  # apart, it is none
    assert of("5, 1 mm apart, two struck", 0, 0, 0, 1, 1) == {
        "first": 0.0, "last": 1.0, "off": 0.0, "momentum": 1.0, "energy": 1.0
    }  # fmt: skip
    for reading in ((0, 0.1, 1), (-0.3, 0.7, 0.7), (-0.8 / 3, 1.9 / 3, 2.2 / 3)):
        assert of("v=0.1", *reading, family="parting-ball")["off"] == pytest.approx(0.0, abs=1e-15)


# What is expected of a method


def test_a_strikers_known_shift_is_half_the_lean_of_one_step():
    family = catalogue()["two-balls"]
    case, way = family.case("e=1,m=1,b=0.5"), family.quantity("way")
    exact, at_step, spring = (
        way.expect(case, Settings(1e-3), method)
        for method in (Method(EXACT), Method(AT_STEP), Method(COMPLIANT, stiffness=1e6))
    )
    assert exact.value == at_step.value == spring.value == pytest.approx(math.pi / 6, rel=1e-15)
    assert (exact.tolerance, at_step.tolerance, spring.tolerance) == (1e-9, 1e-3, 1e-3)
    # d/D · tan α with d = v cos α dt, D = 0.25 m, to first order.
    lean = math.tan(math.pi / 6) * 2 * math.cos(math.pi / 6) * 1e-3 / 0.25
    assert at_step.shift == pytest.approx(lean / 2, rel=0.01)
    assert at_step.shift_tolerance == at_step.shift + 1e-3
    assert (exact.shift, spring.shift) == (0, 0)


def test_a_heavy_target_is_judged_by_a_speed_of_its_own():
    family = catalogue()["two-balls"]
    case, target = family.case("e=1,m=1e+06,b=0.5"), family.quantity("target")
    found = target.expect(case, Settings(1e-3), Method(AT_STEP))
    assert found.value == pytest.approx(2 * 2 * math.cos(math.pi / 6) / 1e6, rel=1e-5)
    assert found.tolerance == pytest.approx(1e-3 * found.value, rel=1e-12)
    assert found.size == found.value


def test_the_known_shift_of_a_rod_is_the_weight_of_one_step():
    family = catalogue()["rod-on-peg"]
    case, impulse = family.case("e=0.5,x=0"), family.quantity("impulse")
    speed, dt = truth.impact_speed(0.5, G), 1e-3
    found = impulse.expect(case, Settings(dt), Method(AT_STEP))
    assert (found.value, found.tolerance) == (pytest.approx(1.5, rel=1e-15), 1e-3)
    weight, late = G * dt / speed / 1.5, G * dt / speed / 2  # of the impulse: the step's weight, and g dt/2 of speed
    assert found.shift == pytest.approx(1.5 * weight, rel=1e-12)
    assert found.shift_tolerance == pytest.approx(1e-3 + 1.5 * late, rel=1e-12)
    aside, spin = family.case("e=0.5,x=0.25"), family.quantity("spin")
    found = spin.expect(aside, Settings(dt), Method(AT_STEP))
    assert found.shift == pytest.approx(found.value * weight, rel=1e-12)  # ω goes with j
    assert found.tolerance == pytest.approx(0.5e-3 * speed / 0.5, rel=1e-12)
    found = impulse.expect(case, Settings(dt), Method(AT_STEP, weighed=1.0))  # g dt is turned back: (1 + e) g dt
    assert found.shift == pytest.approx(1.5 * G * dt / speed, rel=1e-12)
    floating = catalogue()["struck-rod"]
    found = floating.quantity("impulse").expect(floating.case("e=0.5,x=0"), Settings(dt), Method(AT_STEP))
    assert (found.value, found.tolerance, found.shift) == (pytest.approx(0.75, rel=1e-15), 1e-3, 0)


def test_the_rods_impulse_is_nearly_the_quarter_of_the_lecture():
    family = catalogue()["rod-on-peg"]
    for e in (0.5, 1.0):
        theory = family.quantity("impulse").theory(family.case(f"e={e:g},x={END:g}"))
        # 3 x²/(a² + c²) instead of 3: 0.4 % for the millimetre, 0.16 % for the thickness, three quarters of each.
        assert theory == pytest.approx((1 + e) / 4, rel=0.005)
        assert theory > (1 + e) / 4
