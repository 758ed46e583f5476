"""Trajectories of one body over a plane, made up so that what is measured of them is known."""

from __future__ import annotations

import math

import numpy as np

from reference.scene.scenario import Body, HalfSpace, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

G = 9.81
RADIUS = 0.1
HEIGHT = 1.0
EXACT = 1e-9
"""What a number read from a parabola may be off, SI: rounding of numbers near 1, over sample intervals down to 1e-4."""


def scenario(shape=None, normal=(0.0, 0.0, 1.0), gravity=(0.0, 0.0, -G), mass=1.0):
    body = Body("ball", shape or Sphere(RADIUS), mass=mass, position=(0.0, 0.0, HEIGHT + RADIUS))
    return Scenario("made up", (Body("floor", HalfSpace(normal)), body), (Pair("ball", "floor"),), 1.0, gravity)


def trajectory(times, position, velocity, events=(), made=None, orientation=(1.0, 0.0, 0.0, 0.0), spin=(0.0, 0.0, 0.0)):
    """A trajectory whose second body has the given states; whatever is given once holds at every sample."""
    made = made or scenario()
    count = len(times)
    columns = [
        np.stack((np.tile(still, (count, 1)), np.broadcast_to(moving, (count, len(still)))), axis=1)
        for still, moving in (
            ((0.0, 0.0, 0.0), position),
            ((1.0, 0.0, 0.0, 0.0), orientation),
            ((0.0, 0.0, 0.0), velocity),
            ((0.0, 0.0, 0.0), spin),
        )
    ]
    return Trajectory(made, Settings(1e-3), "made up", np.asarray(times, dtype=float), *columns, events=tuple(events))


def upright(gap, normal=(0.0, 0.0, 1.0)):
    """Positions of a ball with that gap, (n,), above a plane through the origin."""
    return (np.asarray(gap) + RADIUS)[:, None] * np.array(normal)


def bounce(times, restitution, gravity=G, count=40):
    """Gap and normal velocity of a ball dropped from 1 m at t = 0, and the instants of its first impacts."""
    fall = math.sqrt(2 * HEIGHT / gravity)
    launches = fall * np.cumsum([1, *(2 * restitution**n for n in range(1, count))])
    speeds = gravity * fall * restitution ** np.arange(1, count + 1)
    after = np.searchsorted(launches, times, side="right") - 1
    since = times - launches[after]
    gap = np.where(after < 0, HEIGHT - gravity * times**2 / 2, speeds[after] * since - gravity * since**2 / 2)
    velocity = np.where(after < 0, -gravity * times, speeds[after] - gravity * since)
    return gap, velocity, launches


def bouncing(times, restitution, normal=(0.0, 0.0, 1.0), gravity=G):
    gap, velocity, launches = bounce(times, restitution, gravity)
    made = scenario(normal=normal, gravity=tuple(-gravity * np.array(normal)))
    return trajectory(times, upright(gap, normal), velocity[:, None] * np.array(normal), made=made), launches


def sampled(end, interval, phase, jitter):
    """Sample times from 0 on: evenly spaced, the first interval cut to `phase`, each moved by a part of `jitter`."""
    times = np.concatenate(([0.0], np.arange(phase * interval, end, interval)))
    moved = np.random.default_rng(1).uniform(-0.5, 0.5, size=len(times)) * jitter * interval
    moved[0] = 0.0
    return np.unique(np.clip(times + moved, 0.0, None))
