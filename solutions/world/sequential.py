"""Sequential impulses: contact after contact, again and again, until nothing changes (slides 16 and 22)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Booleans, Integers
from solutions.world.rows import Rows


class Wanted(NamedTuple):
    """What the impulses of m contacts have to reach, and what they may be.

    Attributes
    ----------
    speed : (m,), the least normal speed after the impulses, m/s
    least : (m,), the least normal impulse, N s: 0, because contacts do not pull
    static_friction, kinetic_friction : (m,), μ_s and μ_k
    rebounds : (m,), whether the points part after an impact
    """

    speed: Array
    least: Array
    static_friction: Array
    kinetic_friction: Array
    rebounds: Booleans


def colours(body_a: Integers, body_b: Integers, movable: Booleans) -> list[Integers]:
    """Contacts in groups, such that no two of one group move the same body.

    Parameters
    ----------
    body_a, body_b : (m,), the bodies of each contact
    movable : (n,), whether an impulse moves a body

    Returns
    -------
    list of (k,) numbers of contacts
        Each contact is in one group.

    Notes
    -----
    In every round, each body that can be moved picks the first of its contacts that are
    left. A contact picked by both of its bodies goes into this round's group. Contacts
    of one group do not notice each other, so that an array of them may take its turn
    together; the result is the same as one after another.
    """
    left, groups = np.arange(len(body_a)), []
    free_a, free_b = ~movable[body_a], ~movable[body_b]
    while len(left):
        first = np.full(len(movable), len(body_a))
        # Written from the last to the first, so that the first stays.
        both = np.concatenate([body_a[left], body_b[left]]), np.concatenate([left, left])
        order = np.argsort(-both[1], kind="stable")
        first[both[0][order]] = both[1][order]
        picked = (free_a[left] | (first[body_a[left]] == left)) & (free_b[left] | (first[body_b[left]] == left))
        groups.append(left[picked])
        left = left[~picked]
    return groups


def solve_sequentially(
    rows: Rows,
    groups: list[Integers],
    velocity: Array,
    angular_velocity: Array,
    wanted: Wanted,
    start: ArrayLike = 0.0,
    sweeps: int = 50,
    tolerance: float = 0.0,
) -> tuple[Array, Array, Array]:
    """Velocities after the impulses of all contacts, and the impulses.

    Parameters
    ----------
    rows : of m contacts
    groups : contacts that may take their turn together, as `colours` gives them
    velocity, angular_velocity : (n, 3), of all bodies before, m/s and rad/s
        With what all other forces add in this step.
    wanted : what the impulses have to reach
    start : (m, 3), impulses to begin with, such as those of the last step, N s
    sweeps : how often all contacts take their turn, at most
    tolerance : of the largest impulse
        The sweeps end when no impulse changes by more than this share of it.

    Returns
    -------
    velocity, angular_velocity : (n, 3)
    impulse : (m, 3), along each contact's directions, N s

    Notes
    -----
    In its turn a contact sees the velocities as all others have left them. Along the
    normal it gets what makes its speed the wanted one; what it has had in all is
    clamped, not what is added now, so that a later turn may take back what an earlier
    one gave too much. Friction gets what ends the slip. If that is more than μ_s times
    the normal impulse, the points slip: friction opposes the slip with μ_k times the
    normal impulse.

    The clamp is a circle (Coulomb's cone), not a square for each direction. Friction
    along t − a n takes a·λ_t from the normal impulse, which is then λ_n − a·λ_t. In the
    direction d the edge of the cone lies at R = μ (λ_n − a·d R), so that
    R = μ λ_n/(1 + μ a·d).

    With a rebound, friction leaves the least energy if it opposes not the slip w but
    w + c μ a, where c is how strongly the edge holds; `dissipative_impulse` derives it.
    Without a rebound, u_n = 0, friction opposes the slip, as Coulomb says.
    """
    velocities = np.concatenate([velocity, angular_velocity], axis=-1)
    impulse = np.array(np.broadcast_to(start, (len(rows.body_a), 3)), dtype=float)
    if np.any(impulse):
        given = np.vecmat(impulse, rows.answer)
        np.add.at(velocities, rows.body_a, given[:, :6])
        np.add.at(velocities, rows.body_b, given[:, 6:])
    turns = [_Turn(rows, wanted, group) for group in groups]
    for _ in range(sweeps):
        before = impulse.copy()
        for turn in turns:
            turn.take(velocities, impulse)
        if np.max(np.abs(impulse - before), initial=0.0) <= tolerance * np.max(np.abs(impulse), initial=0.0):
            break
    return velocities[:, :3], velocities[:, 3:], impulse


class _Turn:
    """The turn of one group: what stays the same from sweep to sweep."""

    def __init__(self, rows: Rows, wanted: Wanted, group: Integers) -> None:
        self.group, self.a, self.b = group, rows.body_a[group], rows.body_b[group]
        self.speed, self.answer = rows.speed[group], rows.answer[group]
        self.coupling, softness = rows.coupling[group], rows.softness[group]
        self.normal_mass = 1 / softness[:, 0, 0]
        self.wanted = Wanted(*(each[group] for each in wanted))
        self.rough = bool(np.any(self.wanted.static_friction))
        self.tangent_mass = np.linalg.inv(softness[:, 1:, 1:])
        # The larger eigenvalue of two: no step along the slip that is divided by it goes too far.
        half, off = (softness[:, 1, 1] + softness[:, 2, 2]) / 2, softness[:, 1, 2]
        self.slip_mass = 1 / (half + np.hypot((softness[:, 1, 1] - softness[:, 2, 2]) / 2, off))[:, None]

    def take(self, velocities: Array, impulse: Array) -> None:
        """Change the impulses of these contacts, and the velocities of their bodies."""
        had = impulse[self.group]
        speed = np.matvec(self.speed, np.concatenate([velocities[self.a], velocities[self.b]], axis=-1))
        new = np.empty_like(had)
        pull = np.vecdot(self.coupling, had[:, 1:])
        normal = had[:, 0] - (speed[:, 0] - self.wanted.speed) * self.normal_mass
        new[:, 0] = np.maximum(self.wanted.least + pull, normal)
        new[:, 1:] = self._friction(had[:, 1:], speed[:, 1:], new[:, 0]) if self.rough else 0.0
        impulse[self.group] = new
        given = np.vecmat(new - had, self.answer)
        velocities[self.a] += given[:, :6]
        velocities[self.b] += given[:, 6:]

    def _friction(self, had: Array, slip: Array, normal: Array) -> Array:
        """Impulses (k, 2) that end the slip, or oppose it at the edge of the cone."""
        coupling, kinetic = self.coupling, self.wanted.kinetic_friction
        sticking = had - np.matvec(self.tangent_mass, slip)
        most = self.wanted.static_friction * (normal - np.vecdot(coupling, sticking))
        holds = np.vecdot(sticking, sticking) <= np.maximum(most, 0.0) ** 2
        if np.all(holds):
            return sticking
        if np.any(self.wanted.rebounds):
            slip = slip + self._towards_least_energy(had, slip)
        sliding = had - self.slip_mass * slip
        length = np.sqrt(np.vecdot(sliding, sliding))
        along = sliding / np.where(length > 0, length, 1.0)[:, None]
        steepness = 1 + kinetic * np.vecdot(coupling, along)
        edge = np.where(steepness > 0, kinetic * normal / np.where(steepness > 0, steepness, 1.0), length)
        return np.where(holds[:, None], sticking, np.minimum(edge, length)[:, None] * along)

    def _towards_least_energy(self, had: Array, slip: Array) -> Array:
        """What turns friction from the direction against the slip to that of least energy, c μ a, at rebounds."""
        length = np.sqrt(np.vecdot(had, had))
        along = had / np.where(length > 0, length, 1.0)[:, None]
        mu_a = self.wanted.kinetic_friction[:, None] * self.coupling
        steepness = 1 + np.vecdot(mu_a, along)
        hold = np.maximum(-np.vecdot(slip, along), 0.0) / np.where(steepness > 0, steepness, 1.0)
        return np.where(self.wanted.rebounds & (steepness > 0), hold, 0.0)[:, None] * mu_a
