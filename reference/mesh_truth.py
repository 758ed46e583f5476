"""What theory says of point masses joined by springs: the shape in which they rest, how stiff it is, how it vibrates.

A mesh is arrays: place (n, 3), m; edges (m, 2), the nodes at the two ends of each spring; stiffness and rest_length,
(m,) or one for all, N/m and m; free, the numbers of the nodes that move; load (n, 3), N. Energies are minimised by
Newton's method with the stiffness matrix written out: slow for thousands of nodes, and independent of any step through
time.
"""

from __future__ import annotations

import math

import numpy as np

from reference.arrays import Array, Integers
from reference.errors import RunFailed

Numbers = Array | float
"""One for each spring, (m,), or one for all."""
MOST_ROUNDS = 500
"""Of Newton's method, most of which go by while the mesh is far from its shape."""
ROUNDING = 1e-12
"""Share by which rounding may raise an energy that goes down."""
SOFT = 1e-6
"""Share of the largest stiffness below which a direction counts as not held at all, far from the valley."""
BALANCED = 1e-11
"""Net force that counts as none, as a share of the largest load: rounding of some hundred terms."""


def net_force(place: Array, edges: Integers, stiffness: Numbers, rest_length: Numbers, load: Array) -> Array:
    """Load and springs on each node, (n, 3), N: a spring of length L pulls its ends together with k (L − L0)."""
    force = load.copy()
    along, length = _along(place, edges)
    pull = (stiffness * (length - rest_length))[:, None] * along
    np.add.at(force, edges[:, 0], -pull)
    np.add.at(force, edges[:, 1], pull)
    return force


def stiffness_matrix(place: Array, edges: Integers, stiffness: Numbers, rest_length: Numbers) -> Array:
    """What a displacement of the nodes takes off the net force on them, (3n, 3n), N/m.

    Along a spring k; across it k (1 − L0/L), its tension over its length, as a taut spring that turns pulls back.
    """
    along, length = _along(place, edges)
    onto = along[:, :, None] * along[:, None, :]
    across = (1 - rest_length / length)[:, None, None] * (np.eye(3) - onto)
    blocks = (stiffness * np.ones(len(edges)))[:, None, None] * (onto + across)
    matrix = np.zeros((len(place), len(place), 3, 3))
    for one, other, sign in ((0, 0, 1), (1, 1, 1), (0, 1, -1), (1, 0, -1)):
        np.add.at(matrix, np.index_exp[edges[:, one], edges[:, other]], sign * blocks)
    return np.asarray(np.swapaxes(matrix, 1, 2)).reshape(3 * len(place), -1)


def equilibrium(
    place: Array, free: Integers, edges: Integers, stiffness: Numbers, rest_length: Numbers, load: Array
) -> Array:
    """The shape in which springs and loads balance, (n, 3), m: the valley of the energy Σ k (L − L0)²/2 − Σ f·x.

    Newton's method from `place` on. Far from the valley the energy is not convex, and each round goes down it as if
    every node were held by one more spring, as stiff as it takes.

    Raises
    ------
    RunFailed
        If it finds no such shape: nothing holds the mesh, say.
    """
    shape, rows = place.copy(), (3 * free[:, None] + np.arange(3)).ravel()
    told = edges, stiffness, rest_length
    limit = BALANCED * max(float(np.abs(load[free]).max()), float(np.abs(net_force(place, *told, load)[free]).max()))
    held = 0.0
    for _ in range(MOST_ROUNDS):
        force = net_force(shape, *told, load)[free].ravel()
        if np.abs(force).max() <= limit:
            return shape
        matrix = stiffness_matrix(shape, *told)[np.ix_(rows, rows)]
        softest, *_, stiffest = np.linalg.eigvalsh(matrix).tolist()
        if softest < SOFT * stiffest:
            held = max(held, SOFT * stiffest - 1.01 * softest)
        step = np.linalg.solve(matrix + held * np.eye(len(rows)), force).reshape(-1, 3)
        trial = shape.copy()
        trial[free] += step
        before = energy(shape, *told, load)
        if energy(trial, *told, load) <= before + ROUNDING * abs(before):
            shape, held = trial, held / 4 if held > 1e-9 * np.abs(matrix).max() else 0.0
        else:
            held = max(4 * held, 1e-6 * float(np.abs(matrix).max()))
    raise RunFailed(f"no shape at rest in {MOST_ROUNDS} rounds of Newton's method: nothing holds these nodes")


def softest(place: Array, free: Integers, edges: Integers, stiffness: Numbers, rest_length: Numbers) -> float:
    """Least eigenvalue of the stiffness of the free nodes, N/m: above zero where the shape at rest is stable."""
    rows = (3 * free[:, None] + np.arange(3)).ravel()
    matrix = stiffness_matrix(place, edges, stiffness, rest_length)[np.ix_(rows, rows)]
    return float(np.linalg.eigvalsh(matrix)[0])


def energy(place: Array, edges: Integers, stiffness: Numbers, rest_length: Numbers, load: Array) -> float:
    """Energy of the springs and of the loads, J: Σ k (L − L0)²/2 − Σ f·x."""
    _, length = _along(place, edges)
    return float(np.sum(stiffness * (length - rest_length) ** 2) / 2 - np.sum(load * place))


def _along(place: Array, edges: Integers) -> tuple[Array, Array]:
    """Direction from the second end to the first, (m, 3), and length, (m,), m, of each spring."""
    between = place[edges[:, 0]] - place[edges[:, 1]]
    length = np.sqrt(np.sum(between**2, axis=-1))
    return between / length[:, None], length


def fastest_mode(
    place: Array, edges: Integers, stiffness: Numbers, rest_length: Numbers, mass: Array
) -> tuple[float, Array]:
    """Largest ω² of the free mesh, rad²/s², and its displacements (n, 3), the largest component of which is 1.

    The equation is K x = ω² M x, solved for √M x, whose matrix is symmetric. mass: (n,), kg.
    """
    scale = np.repeat(np.sqrt(mass), 3)
    matrix = stiffness_matrix(place, edges, stiffness, rest_length) / np.outer(scale, scale)
    squares, modes = np.linalg.eigh(matrix)
    mode = modes[:, -1] / scale
    return float(squares[-1]), np.asarray(mode / mode[np.argmax(np.abs(mode))]).reshape(-1, 3)


def longest_step(frequency: float, damping_ratio: float = 0.0) -> float:
    """Timestep up to which semi-implicit Euler does not let a vibration grow, s: (2/ω)(√(1 + ζ²) − ζ).

    With a = (ω dt)² and b = 2ζω dt one step multiplies a vibration by a z with z² − (2 − a − b) z + 1 − b = 0. Of two
    complex z the size is √(1 − b), below 1. As dt grows they become real and negative, and one of them is −1 where
    a + 2b = 4. The positive root of that equation for dt is the limit.
    """
    return 2 / frequency * (math.hypot(1, damping_ratio) - damping_ratio)


def energy_kept(frequency: float, damping_ratio: float, time: float) -> float:
    """Share of the energy that a vibration keeps which starts from rest: x″ + 2ζω x′ + ω² x = 0, with ζ below 1.

    x = e^(−ζωt) (cos st + (ζω/s) sin st) and x′ = −(ω²/s) e^(−ζωt) sin st with s = ω √(1 − ζ²), and the energy is
    proportional to x′² + ω² x².
    """
    own = frequency * math.sqrt(1 - damping_ratio**2)
    fade, sine, cosine = math.exp(-damping_ratio * frequency * time), math.sin(own * time), math.cos(own * time)
    displacement = fade * (cosine + damping_ratio * frequency / own * sine)
    velocity = -(frequency**2) / own * fade * sine
    return displacement**2 + (velocity / frequency) ** 2
