"""Balls, a rod and drops, and how they are stepped, for the tests of the world's responses."""

from __future__ import annotations

import numpy as np

from solutions.world.bodies import make_bodies, make_state
from solutions.world.step import NOTHING, advance_world

G = 9.81
FLOOR = ("half-space", (0.0, 0.0, 1.0))
IMPULSES = ["sequential", "simultaneous", "in time order"]
EXACT = {"sweeps": 500, "tolerance": 1e-14, "rest_speed": 1e-9}
"""Sequential impulses until nothing changes, and every approach an impact."""


def spheres(position, velocity, mass=1.0, restitution=1.0, friction=0.0, radius=0.5, spin=(0.0, 0.0, 0.0)):
    position = np.array(position, dtype=float)
    count = len(position)
    masses, radii = np.broadcast_to(mass, count), np.broadcast_to(radius, count)
    moments = 0.4 * (masses * radii**2)[:, None] * np.ones(3)
    bodies = make_bodies([("sphere", each) for each in radii], masses, moments, restitution, friction)
    return bodies, make_state(position, velocity=velocity, angular_velocity=spin)


def row(velocity, **others):
    """Balls of radius 1/2 m along the x axis that touch their neighbours."""
    along = np.zeros((2, len(velocity), 3))
    along[:, :, 0] = np.arange(len(velocity)), velocity
    return spheres(*along, **others)


def rod(velocity, restitution, friction, spin=(0.0, 0.0, 0.0)):
    """A body of 1 kg with the moments of a rod of 1 m, whose lowest corner (−2/5, 0, −3/10) touches the floor."""
    corners = np.array([(-0.4, 0.0, -0.3), (0.4, 0.05, 0.3), (0.4, -0.05, 0.3), (0.35, 0.0, 0.35)])
    faces = [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)]
    loaded = ("compound", [(("polyhedron", corners, faces), (0, 0, 0), (1, 0, 0, 0))])
    moments = [[1 / 12] * 3, [np.inf] * 3]
    bodies = make_bodies([loaded, FLOOR], [1.0, np.inf], moments, restitution, friction)
    at_rest = (0.0, 0.0, 0.0)
    return bodies, make_state([(0, 0, 0.3), at_rest], velocity=[velocity, at_rest], angular_velocity=[spin, at_rest])


ROD_SOFTNESS = np.array([[52.0, 0.0, -36.0], [0.0, 100.0, 0.0], [-36.0, 0.0, 73.0]]) / 25
"""K of that corner: 1 + 12 (r·r 1 − r rᵀ) with r = (−2/5, 0, −3/10)."""


def drops(heights, restitution, floor=FLOOR, friction=0.0):
    """Balls of radius 0.1 m and 1 kg at rest over a floor, each in a group of its own."""
    count = len(heights)
    shapes = [shape for _ in heights for shape in (("sphere", 0.1), floor)]
    moments = np.tile([[0.004] * 3, [np.inf] * 3], (count, 1))
    bodies = make_bodies(
        shapes, [1.0, np.inf] * count, moments, restitution, friction, group=np.repeat(np.arange(count), 2)
    )
    position = np.zeros((2 * count, 3))
    position[::2, 2] = 0.1 + np.asarray(heights)
    return bodies, make_state(position)


def run(bodies, state, dt, steps, rules, gravity=G):
    """The states after each step."""
    memory, states = NOTHING, []
    for _ in range(steps):
        state, memory, _ = advance_world(bodies, state, (0, 0, -gravity), dt, rules, memory)
        states.append(state)
    return states


def once(bodies, state, rules, dt=1e-9):
    """The velocities and spins after one short step without forces."""
    after, _, _ = advance_world(bodies, state, (0, 0, 0), dt, rules)
    return after.velocity, after.angular_velocity


def energy(bodies, state, gravity=0.0):
    """Of all bodies that can be moved, whose moments are the same about all axes, J."""
    free = bodies.inverse_mass > 0
    mass, moment = 1 / bodies.inverse_mass[free], bodies.moments[free, 0]
    v, w, z = state.velocity[free], state.angular_velocity[free], state.position[free, 2]
    return float(np.sum(mass * (np.vecdot(v, v) / 2 + gravity * z) + moment * np.vecdot(w, w) / 2))


def slope(degrees):
    angle = np.radians(degrees)
    return np.array([np.cos(angle), 0.0, -np.sin(angle)]), np.array([np.sin(angle), 0.0, np.cos(angle)])
