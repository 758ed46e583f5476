"""Numbers of an orbit: taken from made-up samples of an ellipse that turns, and widens."""

from __future__ import annotations

import numpy as np
import pytest

from reference.catalogue import orbits
from reference.errors import RunFailed
from reference.scene.forces import Attraction
from reference.scene.scenario import Body, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

MOON, PLANET = Body("moon", Sphere(0.1), 1.0, (1.0, 0.0, 0.0)), Body("planet", Sphere(0.1), 4.0)
SCENE = Scenario("orbit", (MOON, PLANET), (), 1.0, attractions=(Attraction("moon", "planet", 20.0),))


def around(duration: float, turn: float = 0.0, grow: float = 0.0) -> Trajectory:
    """The distance swings with 1 Hz and grows, and the near point turns by so many rad in a second; both drift."""
    times = np.linspace(0, duration, 1001)
    away = (1 + grow * times) * (2 + np.sin(2 * np.pi * times))
    angle = (2 * np.pi + turn) * times
    moon = away[:, None] * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    drift = np.array([0.3, -0.2, 0.1]) * times[:, None]
    places = np.stack([moon + drift, drift], axis=1)
    velocities = np.gradient(places, times, axis=0, edge_order=2)
    turns = np.tile([1.0, 0.0, 0.0, 0.0], (len(times), 2, 1))
    return Trajectory(SCENE, Settings(1e-3), "made up", times, places, turns, velocities, np.zeros_like(places))


def test_near_and_far_points_come_in_turn_and_a_period_apart():
    found = orbits.apsides(around(2.2))
    assert found.far == pytest.approx((0.25, 1.25), abs=1e-9)
    assert found.near == pytest.approx((0.75, 1.75), abs=1e-9)
    assert orbits.distance_at(around(2.2), 0.75) == pytest.approx(1.0, abs=1e-9)


def test_the_near_point_turns_with_the_motion_or_against_it():
    for turn in (0.2, -0.3):
        assert orbits.turned(around(2.2, turn)) == pytest.approx(turn, abs=1e-9)


def test_energy_and_angular_momentum_are_compared_at_like_points():
    kept, wider = around(2.2), around(2.2, grow=0.1)
    # Velocities are differences of samples, which are good to some 10⁻⁵.
    assert orbits.energy_gained(kept) == pytest.approx(0.0, abs=1e-4)
    first, last = (1 + 0.1 * time for time in (0.25, 1.25))
    speeds = [np.hypot(3 * scale * 2 * np.pi, 0.1 * 3) for scale in (first, last)]
    energies = [speed**2 / 2 - 100 / (3 * scale) for speed, scale in zip(speeds, (first, last), strict=True)]
    gained = (energies[1] - energies[0]) / abs(energies[0])
    assert orbits.energy_gained(wider) == pytest.approx(gained, abs=2e-3)  # it is farthest a little later
    start, end = (2 * np.pi * (1 + 0.1 * time) ** 2 * (2 + np.sin(2 * np.pi * time)) ** 2 for time in (0.0, 2.2))
    assert orbits.angular_momentum_gained(wider) == pytest.approx(end / start - 1, rel=1e-3)


def test_a_run_of_less_than_two_revolutions_has_no_period():
    with pytest.raises(RunFailed, match="1 near and 2 far points by the end"):
        orbits.apsides(around(1.6))
