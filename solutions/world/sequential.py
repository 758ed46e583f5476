"""Sequential impulses: contact after contact, again and again (slide 22)."""

from __future__ import annotations

import itertools
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Booleans, Integers
from solutions.world.rows import Rows, after_impulses, speeds

SLIPS = 1e-6
"""Share by which friction falls short of ending a slip that counts as one."""


class Targets(NamedTuple):
    """What the impulses of m contacts have to reach, and what they may be.

    Attributes
    ----------
    speed : (m,), the least normal speed after the impulses, m/s
    static_friction, kinetic_friction : (m,), μ_s and μ_k
    rebounds : (m,), whether the points part after an impact
    """

    speed: Array
    static_friction: Array
    kinetic_friction: Array
    rebounds: Booleans

    def rows(self, chosen: Integers) -> Targets:
        """What some of the contacts have to reach, in the order given."""
        return Targets._make(part[chosen] for part in self)


def in_groups(
    body_a: Integers, body_b: Integers, movable: Booleans
) -> tuple[Integers, list[slice]]:
    """An order of contacts, in groups in which no two move the same body.

    Parameters
    ----------
    body_a, body_b : (m,), the bodies of each contact
    movable : (n,), whether an impulse moves a body

    Returns
    -------
    order : (m,), numbers of the contacts, group by group
    groups : where each group stands in this order

    Notes
    -----
    First the pairs of bodies are put into groups: one after another, each into
    the first group that moves neither of its bodies. Then each pair's first
    contact takes its turn, group after group, then each pair's next one, and
    so on. If a box had turns at all of its corners before the next box has
    one, ten boxes would need eight times as many turns until they stand.

    Of the contacts around a face, every other one comes first. A turn disturbs
    the neighbours most, and so a box that holds on a slope slips a hundred
    times less in its first step than if its corners took their turns one after
    another.

    Contacts of one group do not notice each other. So an array of them may
    take its turn together, and the result is the same as one after another.
    """
    signs = body_a * len(movable) + body_b
    sign, pair, count = np.unique(
        signs, return_inverse=True, return_counts=True
    )
    group_of_pair = _first_fit(*np.divmod(sign, len(movable)), movable)
    # Which contact of its pair each one is: 0, 1, 2 and so on.
    pair_by_pair = np.argsort(pair, kind="stable")
    first = np.repeat(np.cumsum(count) - count, count)
    place = np.empty_like(pair)
    place[pair_by_pair] = np.arange(len(pair)) - first
    place = np.where(place % 2 == 0, place, place + len(place)) // 2
    turn = place * (np.max(group_of_pair, initial=0) + 1) + group_of_pair[pair]
    _, size = np.unique(turn, return_counts=True)
    ends = np.cumsum([0, *size]).tolist()
    groups = [slice(start, end) for start, end in itertools.pairwise(ends)]
    return np.argsort(turn, kind="stable"), groups


def _first_fit(
    body_a: Integers, body_b: Integers, movable: Booleans
) -> Integers:
    """The group of each pair of bodies: the first that moves neither."""
    # The groups of each body are the bits of a whole number.
    groups_of = [0] * len(movable)
    group_of_pair = []
    for a, b in zip(body_a.tolist(), body_b.tolist(), strict=True):
        free = ~(groups_of[a] | groups_of[b])
        first = free & -free
        group_of_pair.append(first.bit_length() - 1)
        for body in (a, b):
            if movable[body]:
                groups_of[body] |= first
    return np.array(group_of_pair, dtype=np.int64)


def solve_sequentially(
    rows: Rows,
    groups: list[slice],
    velocity: Array,
    angular_velocity: Array,
    targets: Targets,
    start: ArrayLike = 0.0,
    sweeps: int = 50,
    tolerance: float = 0.0,
    more_sweeps: int = 0,
) -> tuple[Array, Array, Array]:
    """Velocities after the impulses of all contacts, and the impulses.

    Parameters
    ----------
    rows : of m contacts, in the order of their groups
    groups : contacts that may take their turn together
        As `in_groups` gives them.
    velocity, angular_velocity : (n, 3), of all bodies before, m/s and rad/s
        With what all other forces add in this step.
    targets : what the impulses have to reach
    start : (m, 3), impulses to begin with, such as those of the last step, N s
    sweeps : how often all contacts take their turn at most, a number
    tolerance : share of the largest impulse, a number
        The sweeps end when no impulse changes by more than this.
    more_sweeps : how many may follow where these did not suffice, a number

    Returns
    -------
    velocity, angular_velocity : (n, 3)
    impulse : (m, 3), along each contact's directions, N s

    Notes
    -----
    In its turn a contact sees the velocities as all others have left them.
    Along the normal it gets the impulse with which its speed is the target.
    The sum of all that it has had is clamped, not what is added now, so that a
    later turn may take back what an earlier one gave too much. Along the
    surface it gets the impulse that ends the slip. If that is more than μ
    times the normal impulse, the points slip, and friction opposes the slip
    with μ times the normal impulse.

    Of two coefficients, μ_s is tried first at all contacts: a body that stands
    on four points begins to slip if they cannot hold it together. Those that
    slip then, slip with μ_k.

    The clamp is a circle (Coulomb's cone), not a square for each direction.
    Friction along t − a n takes a·λ_t from the normal impulse, which is then
    λ_n − a·λ_t. In the direction d the edge of the cone lies at

        R = μ (λ_n − a·d R)
        R = μ λ_n/(1 + μ a·d)

    Where λ_n is negative, nothing at this edge is in the cone. Then friction
    gives way, and the normal impulse is clamped again, because friction now
    takes another share.

    With a rebound, friction leaves the least energy if it opposes not the slip
    w but w + c μ a, where c is how strongly the edge holds;
    `dissipative_impulse` derives it. Without a rebound, u_n = 0, friction
    opposes the slip, as Coulomb says.

    In a tall stack the sweeps converge slowly, always in the same direction.
    Each of the further sweeps therefore begins some way ahead in the direction
    of the last change. The way grows from sweep to sweep as Nesterov proposed,
    and begins again when a sweep turns back (O'Donoghue and Candès 2015). For
    eight boxes 160 sweeps then do what takes 5000 without.
    """
    if np.any(targets.static_friction > targets.kinetic_friction):
        sticking = solve_sequentially(
            rows,
            groups,
            velocity,
            angular_velocity,
            targets._replace(kinetic_friction=targets.static_friction),
            start,
            sweeps,
            tolerance,
            more_sweeps,
        )
        slips = _slip(rows, *sticking)
        edge = np.where(
            slips, targets.kinetic_friction, targets.static_friction
        )
        targets = targets._replace(static_friction=edge, kinetic_friction=edge)
    bodies = np.stack([rows.body_a, rows.body_b], axis=-1)
    impulse = np.array(np.broadcast_to(start, (len(bodies), 3)), dtype=float)
    velocities = np.concatenate(
        after_impulses(rows, velocity, angular_velocity, impulse), axis=-1
    )
    friction = _Friction(rows, targets)
    before = swept = impulse.copy()
    ahead = 0
    for sweep in range(sweeps + more_sweeps):
        if sweep < sweeps:
            before = swept = impulse.copy()
        else:
            change, swept = impulse - swept, impulse
            ahead = ahead + 1 if np.vdot(impulse - before, change) >= 0 else 0
            impulse = impulse + ahead / (ahead + 3) * change
            before = impulse.copy()
            velocities = np.concatenate(
                after_impulses(rows, velocity, angular_velocity, impulse),
                axis=-1,
            )
        for group in groups:
            of_both, had = velocities[bodies[group]], before[group]
            coupling = rows.coupling[group]
            speed = np.matvec(rows.speed[group], of_both.reshape(-1, 12))
            missing = targets.speed[group] - speed[:, 0]
            enough = had[:, 0] + missing / rows.softness[group, 0, 0]
            taken = np.vecdot(coupling, had[:, 1:])
            new = impulse[group]
            new[:, 0] = np.maximum(taken, enough)
            new[:, 1:] = friction.impulse(
                group, had[:, 1:], speed[:, 1:], new[:, 0]
            )
            taken = np.vecdot(coupling, new[:, 1:])
            new[:, 0] = np.maximum(taken, new[:, 0])
            gained = np.vecmat(new - had, rows.answer[group])
            velocities[bodies[group]] = of_both + gained.reshape(-1, 2, 6)
        change = np.max(np.abs(impulse - before), initial=0.0)
        if change <= tolerance * np.max(np.abs(impulse), initial=0.0):
            break
    return velocities[:, :3], velocities[:, 3:], impulse


def _slip(
    rows: Rows, velocity: Array, angular_velocity: Array, impulse: Array
) -> Booleans:
    """Whether the points of each contact (m,) slip, by more than rounding."""
    slip = speeds(rows, velocity, angular_velocity)[:, 1:, None]
    missing = np.linalg.solve(rows.softness[:, 1:, 1:], slip)[..., 0]
    least = SLIPS * np.linalg.norm(impulse[:, 1:], axis=-1)
    return np.linalg.norm(missing, axis=-1) > least


class _Friction:
    """Coulomb's cone at all contacts."""

    def __init__(self, rows: Rows, targets: Targets) -> None:
        self.coupling, self.targets = rows.coupling, targets
        self.rough = bool(np.any(targets.static_friction))
        self.rebounds = bool(np.any(targets.rebounds))
        if self.rough:
            softness = rows.softness[:, 1:, 1:]
            self.mass = np.linalg.inv(softness)
            # The larger eigenvalue: no step along the slip that is divided by
            # it goes too far.
            mean = (softness[:, 0, 0] + softness[:, 1, 1]) / 2
            half_difference = (softness[:, 0, 0] - softness[:, 1, 1]) / 2
            most = mean + np.hypot(half_difference, softness[:, 0, 1])
            self.least_mass = 1 / most[:, None]

    def impulse(
        self, group: slice, had: Array, slip: Array, normal: Array
    ) -> Array | float:
        """Impulses (k, 2) that end the slip, or oppose it as they can."""
        if not self.rough:
            return 0.0
        coupling = self.coupling[group]
        static = self.targets.static_friction[group]
        kinetic = self.targets.kinetic_friction[group]
        sticking = had - np.matvec(self.mass[group], slip)
        most = static * (normal - np.vecdot(coupling, sticking))
        # Not most², because there is no edge below zero.
        holds = np.vecdot(sticking, sticking) <= most * np.abs(most)
        if np.all(holds):
            return sticking
        if self.rebounds:
            slip = slip + self._towards_least_energy(group, had, slip)
        sliding = had - self.least_mass[group] * slip
        length, along = _split(sliding)
        steepness = 1 + kinetic * np.vecdot(coupling, along)
        has_edge = steepness > 0
        edge = kinetic * normal / np.where(has_edge, steepness, 1.0)
        edge = np.where(has_edge, edge, length)
        edge = np.where(normal > 0, edge, 0.0)
        sliding = np.minimum(edge, length)[:, None] * along
        return np.where(holds[:, None], sticking, sliding)

    def _towards_least_energy(
        self, group: slice, had: Array, slip: Array
    ) -> Array:
        """What turns friction at rebounds to the least energy, c μ a."""
        mu = self.targets.kinetic_friction[group, None]
        mu_a = mu * self.coupling[group]
        _, along = _split(had)
        steepness = 1 + np.vecdot(mu_a, along)
        turns = self.targets.rebounds[group] & (steepness > 0)
        slowed = np.maximum(-np.vecdot(slip, along), 0.0)
        hold = slowed / np.where(turns, steepness, 1.0)
        return np.where(turns, hold, 0.0)[:, None] * mu_a


def _split(vectors: Array) -> tuple[Array, Array]:
    """Lengths (k,) and directions (k, 2); zero has the direction 0."""
    length = np.sqrt(np.vecdot(vectors, vectors))
    return length, vectors / np.where(length > 0, length, 1.0)[:, None]
