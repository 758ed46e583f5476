"""What theory says of a spring mesh that lies on a fixed ball: the shape in which it rests, and what the ball carries.

The mesh is given as in `reference.mesh_truth`. Its nodes are small balls, so that each has a distance from the centre
of the large ball within which it cannot come, its reach. The ball is smooth: it pushes along the line of centres alone.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reference.arrays import Array, Integers, Mask
from reference.errors import RunFailed
from reference.mesh_truth import BALANCED, MOST_ROUNDS, ROUNDING, SOFT, Numbers, energy, net_force, stiffness_matrix

ON_IT = 1e-12
"""A node counts as on the ball up to this gap, as a share of its reach: it was put there, to rounding."""


@dataclass(frozen=True, eq=False)
class Ball:
    """centre: (3,), m. reach: (n,), m, the least distance of each node from it, 0 for a node that passes through."""

    centre: Array
    reach: Array

    def outwards(self, place: Array) -> tuple[Array, Array]:
        """Unit normals out of the ball, (n, 3), and the gaps, (n,), m, negative in overlap."""
        away = place - self.centre
        distance = np.sqrt(np.sum(away**2, axis=-1))
        return away / np.where(distance > 0, distance, 1.0)[:, None], distance - self.reach

    def put_out(self, place: Array, which: Mask) -> Array:
        """The places with some of them moved onto the ball, by the shortest way."""
        normal, _ = self.outwards(place)
        return np.where(which[:, None], self.centre + self.reach[:, None] * normal, place)


def draped(
    place: Array, free: Integers, edges: Integers, springs: Numbers, rest_length: Numbers, load: Array, ball: Ball
) -> Array:
    """The shape with the least energy near `place` among those in which no node is inside the ball, (n, 3), m.

    Newton's method among the displacements that are allowed: a node that is pressed against the ball moves along it,
    and one that is not, anywhere. What a step puts into the ball is moved out before its energy counts. springs: the
    stiffness of each, N/m.

    Raises
    ------
    RunFailed
        If it finds no such shape: nothing holds the mesh, say.
    """
    told, movable = (edges, springs, rest_length), np.isin(np.arange(len(place)), free)
    shape = ball.put_out(place, movable & (ball.outwards(place)[1] < 0))
    limit = BALANCED * max(float(np.abs(load[free]).max()), float(np.abs(net_force(shape, *told, load)[free]).max()))
    held = 0.0
    for _ in range(MOST_ROUNDS):
        force, onto = net_force(shape, *told, load), allowed(shape, free, *told, load, ball)
        pull = onto.T @ force.ravel()
        if np.abs(pull).max() <= limit:
            return shape
        matrix = stiffness(shape, free, *told, load, ball)
        least, *_, stiffest = np.linalg.eigvalsh(matrix).tolist()
        if least < SOFT * stiffest:
            held = max(held, SOFT * stiffest - 1.01 * least)
        step = onto @ np.linalg.solve(matrix + held * np.eye(len(matrix)), pull)
        trial = shape + step.reshape(-1, 3)
        trial = ball.put_out(trial, movable & ((ball.outwards(trial)[1] < 0) | pressed(shape, free, force, ball)))
        before = energy(shape, *told, load)
        if energy(trial, *told, load) <= before + ROUNDING * abs(before):
            shape, held = trial, held / 4 if held > 1e-9 * np.abs(matrix).max() else 0.0
        else:
            held = max(4 * held, 1e-6 * float(np.abs(matrix).max()))
    raise RunFailed(f"no shape at rest on the ball in {MOST_ROUNDS} rounds of Newton's method: nothing holds it there")


def pressed(place: Array, free: Integers, force: Array, ball: Ball) -> Mask:
    """Which free nodes are on the ball and are pulled into it by their net force, (n,)."""
    normal, gap = ball.outwards(place)
    found = (gap <= ON_IT * ball.reach) & (np.sum(force * normal, axis=-1) < 0)
    return np.asarray(found & np.isin(np.arange(len(place)), free))


def allowed(
    place: Array, free: Integers, edges: Integers, springs: Numbers, rest_length: Numbers, load: Array, ball: Ball
) -> Array:
    """Unit displacements that the ball allows, as columns, (3n, free ones): two of a pressed node, three of another."""
    normal, _ = ball.outwards(place)
    on_it = pressed(place, free, net_force(place, edges, springs, rest_length, load), ball)
    columns = []
    for node in free.tolist():
        axes = np.eye(3)
        if on_it[node]:
            # The columns of Q after the first are across the normal.
            axes = np.linalg.qr(np.column_stack([normal[node], axes]))[0][:, 1:]
        block = np.zeros((len(place), 3, axes.shape[1]))
        block[node] = axes
        columns.append(block.reshape(3 * len(place), -1))
    return np.concatenate(columns, axis=1)


def stiffness(
    place: Array, free: Integers, edges: Integers, springs: Numbers, rest_length: Numbers, load: Array, ball: Ball
) -> Array:
    """What an allowed displacement, in the columns of `allowed`, takes off the net force along them, N/m.

    Along the ball a node turns away from its tangent by u²/(2 reach), and what presses it, N, then does work: that
    takes N/reach off its stiffness. springs: stiffness of each, N/m.
    """
    told = edges, springs, rest_length
    force, onto = net_force(place, *told, load), allowed(place, free, *told, load, ball)
    normal, _ = ball.outwards(place)
    press = np.where(pressed(place, free, force, ball), -np.sum(force * normal, axis=-1), 0.0)
    bend = press / np.where(press > 0, ball.reach, 1.0)
    return np.asarray(onto.T @ (stiffness_matrix(place, *told) - np.diag(np.repeat(bend, 3))) @ onto)


def softest(
    place: Array, free: Integers, edges: Integers, springs: Numbers, rest_length: Numbers, load: Array, ball: Ball
) -> float:
    """Least eigenvalue of the stiffness against what the ball allows, N/m: above zero where the shape is stable."""
    return float(np.linalg.eigvalsh(stiffness(place, free, edges, springs, rest_length, load, ball))[0])
