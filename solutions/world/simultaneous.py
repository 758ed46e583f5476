"""All impulses at once: a complementarity problem (slide 22)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array, Integers
from solutions.world.complementarity import solve_by_pivots
from solutions.world.rows import Rows, after_impulses, speeds
from solutions.world.sequential import Targets

STILL = 1e-9
"""Share of the largest speed below which a slip counts as rounding."""


def solve_simultaneously(
    rows: Rows,
    velocity: Array,
    angular_velocity: Array,
    targets: Targets,
    directions: int = 8,
) -> tuple[Array, Array, Array]:
    """Velocities after the impulses of all contacts, and the impulses.

    Parameters
    ----------
    rows : of m contacts
    velocity, angular_velocity : (n, 3), of all bodies before, m/s and rad/s
        With what all other forces add in this step.
    targets : what the impulses have to reach
    directions : k, an even number
        In so many directions friction can push.

    Returns
    -------
    velocity, angular_velocity : (n, 3)
    impulse : (m, 3), along each contact's directions, N s

    Raises
    ------
    ValueError
        If no impulses reach the targets, as where a ball between two
        immovable walls is to part from both.

    Notes
    -----
    Without friction the impulses p solve the problem of `resting_problem`. The
    speeds after them are u⁺ = u + A p, and at each contact

        u⁺ ≥ target speed,    p ≥ 0,    and one of them with equality

    **Friction** (Stewart and Trinkle 1996) is the sum of impulses β ≥ 0 in k
    directions d along the surface. So Coulomb's cone has a polygon for its
    circle. Its corners lie on the circle, and in the middle of an edge
    friction is weaker by cos(π/k), 8 % for k = 8. A number σ for each contact
    is the speed at which it slips:

        d·u⁺ + σ ≥ 0,      β ≥ 0    the direction most against the slip acts
        μ p − Σ β ≥ 0,     σ ≥ 0    a contact that slips uses all its friction

    These are complementary, too, and so it is one problem of m (2 + k)
    unknowns, which Lemke's method solves. Where friction acts along
    d − (a·d) n, the normal impulse is p − Σ β a·d. Then each β counts
    1 + μ a·d times in the last line. At a rebound, σ counts as often in the
    line before: these are the conditions of the least energy.

    A contact that slips with μ_s is solved a second time with μ_k.

    **Energy.** Without friction the impulses do the work

        Σ p (u + u⁺)/2

    Where p > 0, u⁺ = −e u, so that a contact that approaches, u ≤ 0, takes (1
    − e) p |u|/2. This holds for unequal e as well. So the energy cannot rise
    if every contact approaches or rests. It can if one parts, u > 0, and the
    others drive it together again: its rule is u⁺ ≥ 0, and it gains p u/2.
    `simultaneous_impacts` has such a row of balls; of 700 random heaps of five
    balls 14 gain energy, 9 % at most.
    """
    apart = speeds(rows, velocity, angular_velocity)
    impulse = np.zeros_like(apart)
    for island in islands(rows, len(velocity)):
        impulse[island] = _impulses(
            Rows._make(array[island] for array in rows),
            apart[island],
            targets.rows(island),
            len(velocity),
            directions,
        )
    return *after_impulses(rows, velocity, angular_velocity, impulse), impulse


def islands(rows: Rows, bodies: int) -> list[Integers]:
    """Numbers (k,) of the contacts of each island.

    Contacts of two islands have no body in common that an impulse moves. So
    the problem of all contacts falls into one for each island.
    """
    moves_a, moves_b = (
        np.any(rows.answer[:, 0, part], axis=-1)
        for part in (slice(0, 6), slice(6, 12))
    )
    both = moves_a & moves_b
    a, b, label = rows.body_a[both], rows.body_b[both], np.arange(bodies)
    while np.any(label[a] != label[b]):
        least = np.minimum(label[a], label[b])
        np.minimum.at(label, a, least)
        np.minimum.at(label, b, least)
    of = label[np.where(moves_a, rows.body_a, rows.body_b)]
    return [np.flatnonzero(of == island) for island in np.unique(of)]


def _impulses(
    rows: Rows, apart: Array, targets: Targets, bodies: int, directions: int
) -> Array:
    """Impulses (m, 3) of one island, N s."""
    softness = _softness_of_all(rows, bodies)
    # Impulses over a mass are speeds, and the matrix is then one of mere
    # shares.
    mass = 1 / np.max(softness[:, 0, :, 0])
    scaled = softness * mass
    if not np.any(targets.static_friction):
        missing = apart[:, 0] - targets.speed
        normal = mass * solve_by_pivots(scaled[:, 0, :, 0], missing)
        return np.stack([normal, 0 * normal, 0 * normal], axis=-1)
    friction = targets.static_friction
    solved, slip = _with_friction(
        rows, scaled, apart, targets, friction, directions
    )
    weaker = (slip > STILL * np.max(np.abs(apart))) & (
        targets.kinetic_friction < friction
    )
    if np.any(weaker):
        friction = np.where(weaker, targets.kinetic_friction, friction)
        solved, _ = _with_friction(
            rows, scaled, apart, targets, friction, directions
        )
    return mass * solved


def _softness_of_all(rows: Rows, bodies: int) -> Array:
    """How all speeds change with unit impulses, (m, 3, m, 3), 1/kg."""
    count = len(rows.body_a)
    contact = np.arange(count)
    speed, answer = np.zeros((2, count, 3, bodies, 6))
    for whole, part in ((speed, rows.speed), (answer, rows.answer)):
        whole[contact, :, rows.body_a] = part[:, :, :6]
        whole[contact, :, rows.body_b] = part[:, :, 6:]
    size = (3 * count, 6 * bodies)
    softness = speed.reshape(size) @ answer.reshape(size).T
    return softness.reshape(count, 3, count, 3)


def _with_friction(
    rows: Rows,
    softness: Array,
    apart: Array,
    targets: Targets,
    friction: Array,
    directions: int,
) -> tuple[Array, Array]:
    """Impulses (m, 3) over the unit of mass, and speeds of slip (m,), m/s."""
    count = len(friction)
    angle = 2 * np.pi * np.arange(directions) / directions
    d = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    reach = 1 + friction[:, None] * rows.coupling @ d.T
    hold = np.where(targets.rebounds[:, None], reach, 1.0)
    # Which directions are each contact's own
    fan = np.repeat(np.eye(count), directions, axis=1)
    normal = softness[:, 0, :, 0]
    across = (softness[:, 0, :, 1:] @ d.T).reshape(count, -1)
    along = np.einsum("ip,apbq,jq->aibj", d, softness[:, 1:, :, 1:], d)
    along = along.reshape(count * directions, -1)
    none = np.zeros((count, count))
    matrix = np.block(
        [
            [normal, across, none],
            [across.T, along, (fan * hold.ravel()).T],
            [np.diag(friction), -fan * reach.ravel(), none],
        ]
    )
    missing = apart[:, 0] - targets.speed
    slip = (apart[:, 1:] @ d.T).ravel()
    offset = np.concatenate([missing, slip, np.zeros(count)])
    solved = solve_by_pivots(matrix, offset)
    pushes = solved[count:-count].reshape(count, directions)
    impulse = np.concatenate([solved[:count, None], pushes @ d], axis=-1)
    return impulse, solved[-count:]
