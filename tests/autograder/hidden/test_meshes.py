"""Spring meshes (slides 28 and 29): drawn examples and limiting cases, against formulas written spring by spring."""

from __future__ import annotations

import itertools
import math

import numpy as np

from labs.grading.judging.comparison import expect, numbers, refuse_changes
from labs.grading.judging.markers import asks

REST = [0.0, 0.0, 0.0]
INFINITY = math.inf
PAIRS = ((0, 1), (1, 2), (3, 1), (0, 3), (2, 3), (4, 0), (2, 4))


def length(vector):
    return math.hypot(*vector)


def a_mesh(draw, pins=0, undamped=False, immovable=True):
    """Five nodes and six or seven springs, in any order and direction, some of the nodes pinned."""
    pairs = [PAIRS[each][:: draw.sign()] for each in draw.rng.permutation(7)[: 6 + draw.rng.integers(2)]]
    count = len(pairs)
    rest, stiffness = ([draw.number(*limits) for _ in pairs] for limits in ((0.5, 5), (1, 30)))
    damping = [0.0 if undamped else draw.number(0.1, 4) for _ in range(count)]
    mass, pinned = np.array([draw.number(0.2, 4) for _ in range(5)]), np.zeros(5, dtype=bool)
    pinned[draw.rng.choice(5, draw.rng.integers(pins + 1), replace=False)] = True
    mass[pinned] = [INFINITY if immovable and draw.rng.random() < 0.3 else each for each in mass[pinned]]
    return np.array(pairs), np.array(rest), np.array(stiffness), np.array(damping), mass, pinned


def points(draw, size=4.0):
    return np.array([draw.vector(size) for _ in range(5)])


def pulls(mesh, position, velocity):
    """Spring by spring: the tension, from the length and from how fast it changes."""
    edges, rest, stiffness, damping, mass, _ = mesh
    force = np.zeros((len(mass), 3))
    for (i, j), at_rest, k, c in zip(edges.tolist(), rest, stiffness, damping, strict=True):
        way = position[j] - position[i]
        long = length(way)
        if long > 0:
            tension = k * (long - at_rest) + c * ((velocity[j] - velocity[i]) @ way) / long
            force[i] += tension * way / long
            force[j] -= tension * way / long
    return force


def pair(rest=2.0, stiffness=4.0, damping=3.0, masses=(1.0, 2.0), pinned=(False, False)):
    """One spring between two nodes."""
    springs = (np.array([each]) for each in (rest, stiffness, damping))
    return np.array([[0, 1]]), *springs, np.array(masses), np.array(pinned)


def sized(mesh, metre=1.0, newton=1.0, second=1.0):
    """The same mesh with other units of length, force and time."""
    edges, rest, stiffness, damping, mass, pinned = mesh
    mass = mass * (newton * second**2 / metre)
    return edges, rest * metre, stiffness * (newton / metre), damping * (newton * second / metre), mass, pinned


@asks("mesh_forces", 6, "Each spring pulls its ends together by its tension; the forces on a node add up.")
def test_the_forces_of_any_mesh_are_those_of_its_springs(submission, part, examples):
    def moving(draw):
        return a_mesh(draw, pins=2), points(draw), points(draw, 3)

    with part(2, "any mesh that moves"):
        examples.agree(submission.mesh_forces, pulls, moving)
    with part(1, "nothing is added to the momentum or the angular momentum"):

        def free(mesh, position, velocity):
            force = numbers(submission.mesh_forces, (mesh, position, velocity))
            assert np.abs(force.sum(axis=0)).max() < 1e-3, "the forces do not add up to zero"
            torque = np.cross(position, force).sum(axis=0)
            assert np.abs(torque).max() < 1e-2, "the forces turn the mesh as a whole"

        examples.every(moving, free, count=4)
    with part(1, "edges of no length, springs of no rest length, no springs, and slack ones"):
        at = np.array([[1.0, -2, 3], [1, -2, 3], [2, 0, 5], [1, -2, 3], [4, 0, 1]])
        mesh = np.array([[0, 1], [1, 2], [3, 0], [2, 4]]), np.array([1.0, 0, 0, 9]), *np.full((2, 4), 3.0), np.ones(5)
        velocity = np.array([[1.0, 2, 3], [0, -1, 1], [2, 2, 0], [5, 0, 1], [-3, 1, 1]])
        given = (*mesh, np.zeros(5, dtype=bool)), at, velocity
        expect(submission.mesh_forces, given, pulls(*given))
        none = (np.zeros((0, 2), dtype=int), *np.zeros((3, 0)), np.ones(3), np.zeros(3, dtype=bool))
        expect(submission.mesh_forces, (none, at[:3], velocity[:3]), np.zeros((3, 3)))
    with part(1, "many springs at one node"):
        spokes = np.array([[0, k][:: 1 - 2 * (k % 2)] for k in range(1, 13)])
        wheel = spokes, np.full(12, 0.5), np.arange(1.0, 13), np.full(12, 2.0), np.ones(13), np.zeros(13, dtype=bool)
        rim = [[math.cos(k), math.sin(k), 0.1 * k] for k in range(1, 13)]
        given = wheel, np.array([REST, *rim]), np.array([[0.5, -1, 2], *np.roll(rim, 1, axis=1)])
        expect(submission.mesh_forces, given, pulls(*given))
        refuse_changes(submission.mesh_forces)
    with part(1, "in micrometres and in kilometres, weak and stiff"):
        for metre, newton in ((1e-6, 1.0), (1e4, 1e-3), (1e-3, 1e6), (1e7, 1e5)):
            mesh = sized(wheel, metre, newton)
            moved = mesh, given[1] * metre, given[2] * metre
            expect(submission.mesh_forces, moved, newton * pulls(*given))


def stepped(mesh, position, velocity, acceleration, dt):
    """Node by node."""
    *_, mass, pinned = mesh
    velocity = np.array([REST if held else each for held, each in zip(pinned, velocity, strict=True)], dtype=float)
    force = pulls(mesh, position, velocity)
    other = np.broadcast_to(acceleration, position.shape)
    places = np.array(position, dtype=float)
    for node in range(len(mass)):
        if not pinned[node]:
            velocity[node] += dt * (force[node] / mass[node] + other[node])
            places[node] += dt * velocity[node]
    return places, velocity


@asks("mesh_step", 6, "Forces at the start of the step, the new velocities, and with these the new positions.")
def test_any_mesh_steps_as_semi_implicit_euler_does(submission, part, examples):
    def moving(draw):
        return a_mesh(draw, pins=2), points(draw), points(draw, 3), draw.vector(10), draw.number(0.02, 0.5)

    with part(2, "any mesh that moves"):
        examples.agree(submission.mesh_step, stepped, moving)
    with part(1, "an acceleration for each node, also for pinned ones"):

        def each(draw):
            mesh, at, velocity, _, dt = moving(draw)
            return mesh, at, velocity, points(draw, 10), dt

        examples.agree(submission.mesh_step, stepped, each, count=4)
    with part(1, "all pinned, nothing acts, and a step as long as one likes"):
        at, thrown = np.array([[1.0, -2, 3], [3, -3, 5]]), np.array([[4.0, 1, 0], [0, 2, -1]])
        for given in (
            (pair(pinned=(True, True)), at, thrown, [1.0, 2, 3], 0.5),
            (pair(3.0), at, np.zeros((2, 3)), np.zeros(3), 0.5),
            (pair(2.0), at, thrown, np.array([0, 0, -9.81]), 40.0),
            (pair(2.0, masses=(INFINITY, 0.5), pinned=(True, False)), at, thrown, np.array([0, 0, -9.81]), 0.01),
        ):
            expect(submission.mesh_step, given, stepped(*given))
            refuse_changes(submission.mesh_step)
    with part(1, "a mesh that nothing holds falls like a stone, and its middle knows nothing of its springs"):

        def falls(mesh, at, velocity, pull, dt):
            mass = mesh[4]
            for _ in range(5):
                before = mass @ velocity
                at, velocity = numbers(submission.mesh_step, (mesh, at, velocity, pull, dt), 2)
                gained = (mass @ velocity - before) / (mass.sum() * dt)
                assert np.abs(gained - pull).max() < 1e-2, "the middle of the mesh does not fall with gravity"

        examples.every(
            lambda draw: (a_mesh(draw), points(draw), points(draw, 3), draw.vector(10), 0.01), falls, count=3
        )
    with part(1, "in micrometres and in kilometres, quick and slow"):
        mesh, velocity, pull = pair(2.0), thrown, np.array([1.0, -2, 4])
        for metre, second in ((1e-6, 1e-3), (1e6, 1e5), (1e-3, 1e4), (1e7, 1e-2)):
            same = sized(mesh, metre, metre / second**2, second)
            given = same, at * metre, velocity * metre / second, pull * metre / second**2, 0.25 * second
            places, fast = stepped(mesh, at, velocity, pull, 0.25)
            expect(submission.mesh_step, given, (places * metre, fast * metre / second))


def row(position, pair):
    """By how much a motion of all nodes stretches a spring, as numbers to multiply the motion with."""
    found = np.zeros_like(position)
    way = position[pair[0]] - position[pair[1]]
    found[pair[0]], found[pair[1]] = way, -way
    return found.ravel() / (length(way) or 1.0)


def needed(position, edges, candidates):
    """By making each row perpendicular to those before it: what is left of it is new."""
    basis, found = [], []
    for number, pair in enumerate([*edges.tolist(), *candidates.tolist()]):
        rest = row(position, pair)
        for _ in range(2):
            for known in basis:
                rest = rest - (rest @ known) * known
        new = math.sqrt(rest @ rest) > 1e-6
        if new:
            basis.append(rest / math.sqrt(rest @ rest))
        if number >= len(edges):
            found.append(new)
    return np.array(found, dtype=bool)


def corners(draw):
    """Seven places of a turned grid, and springs between them: most of them in any order as candidates."""
    grid = np.array(list(itertools.product((0.0, 1, 2), (0.0, 1), (0.0, 1))))
    at = (grid[draw.rng.choice(12, 7, replace=False)] * draw.number(0.5, 2)) @ draw.turn().T + draw.vector()
    pairs = np.array([pair[:: draw.sign()] for pair in itertools.combinations(range(7), 2)])
    pairs = pairs[draw.rng.permutation(21)]
    return at, pairs[:9], pairs[9:]


@asks("diagonals", 5, "A spring is needed if it resists a motion that the springs before it let through.")
def test_any_springs_are_told_apart_by_what_they_resist(submission, part, examples):
    with part(2, "any places on a grid, with any springs between them"):
        examples.agree(submission.diagonals, needed, corners, count=6)
    with part(1, "as many as the count says, whatever comes first; those that are left out add nothing"):

        def count(at, edges, candidates):
            chosen = numbers(submission.diagonals, (at, edges, candidates))
            turned = numbers(submission.diagonals, (at, edges, candidates[::-1].copy()))
            assert chosen.sum() == turned.sum(), "another order needs another number of springs"
            again = numbers(submission.diagonals, (at, np.concatenate([edges, candidates[chosen > 0]]), candidates))
            assert again.sum() == 0, "springs are missing after all that are needed have been added"

        examples.every(corners, count, count=3)
        none, both = np.zeros((0, 2), dtype=int), np.array([[1, 0], [0, 1]])
        expect(submission.diagonals, (np.array([[1.0, -2, 3], [3, -3, 5]]), none, both), np.array([True, False]))
    with part(1, "a block of cubes and a flat cloth"):
        grid = [[x, y, z] for x in range(2) for y in range(2) for z in range(3)]
        at = np.array(grid, dtype=float) @ np.array([[2.0, 3, 6], [3, -6, 2], [6, 2, -3]]).T / 7
        close = [(a, b, sum((p - q) ** 2 for p, q in zip(grid[a], grid[b], strict=True)))
                 for a, b in itertools.combinations(range(12), 2)]  # fmt: skip
        edges, others = (np.array([[a, b] for a, b, far in close if far in squares]) for squares in ((1,), (2, 3)))
        expect(submission.diagonals, (at, edges, others), needed(at, edges, others))
        flat = np.array([[x, y, 0.5] for x in range(3) for y in range(3)])
        close = [(a, b, round(sum((flat[a] - flat[b]) ** 2))) for a, b in itertools.combinations(range(9), 2)]
        edges, others = (np.array([[a, b] for a, b, far in close if far == square]) for square in (1, 2))
        expect(submission.diagonals, (flat, edges, others), needed(flat, edges, others))
        refuse_changes(submission.diagonals)
    with part(1, "long and short springs beside each other, in micrometres and in kilometres"):
        skew = np.array([[0.0, 0, 0], [100, 0, 0], [0, 0.01, 0], [3, 4, 5], [40, 0.02, 0]])
        pairs = np.array(list(itertools.combinations(range(5), 2)))
        for size in (1e-6, 1.0, 1e4):
            expect(submission.diagonals, (size * skew, pairs[:3], pairs[3:]), needed(size * skew, pairs[:3], pairs[3:]))


def shortest(mesh):
    """By halving at every node: the longest step with dt² k + 2 dt c ≤ 4."""
    edges, _, stiffness, damping, mass, pinned = mesh
    least = INFINITY
    for node in np.flatnonzero(~pinned):
        at = [number for number, ends in enumerate(edges.tolist()) if node in ends]
        k, c = (2 * each[at].sum() / mass[node] for each in (stiffness, damping))
        low, high = 0.0, 1.0
        while 0 < high * high * k + 2 * high * c <= 4:
            high *= 2
        for _ in range(60 if k + c > 0 else 0):
            middle = (low + high) / 2
            low, high = (middle, high) if middle * middle * k + 2 * middle * c <= 4 else (low, middle)
        least = min(least, low) if k + c > 0 else least
    return least


@asks("timestep_bound", 5, "The shortest of the steps that each free node allows against all its neighbours.")
def test_the_safe_step_of_any_mesh_is_that_of_its_worst_node(submission, part, examples):
    with part(2, "any mesh"):
        examples.agree(submission.timestep_bound, shortest, lambda draw: (a_mesh(draw, pins=3),))
    with part(1, "any mesh without dampers"):
        examples.agree(
            submission.timestep_bound, shortest, lambda draw: (a_mesh(draw, pins=1, undamped=True),), count=5
        )
    with part(1, "no springs, all pinned, springs without stiffness, a lonely light node"):
        none = np.zeros((0, 2), dtype=int), *np.zeros((3, 0)), np.ones(3), np.zeros(3, dtype=bool)
        lonely = np.array([[0, 1]]), *np.array([[1.0], [4.0], [0.0]]), np.array([1, 2, 1e-9]), np.zeros(3, dtype=bool)
        for mesh in (none, pair(pinned=(True, True)), pair(stiffness=0.0, damping=0.0), lonely, pair(stiffness=0.0)):
            expect(submission.timestep_bound, (mesh,), shortest(mesh))
            refuse_changes(submission.timestep_bound)
    with part(1, "light and heavy, quick and slow"):
        for newton, second in ((1e-6, 1.0), (1e6, 1e-4), (1.0, 1e5), (1e-3, 1e-3)):
            mesh = sized(pair(damping=0.5), 1.0, newton, second)
            expect(submission.timestep_bound, (mesh,), shortest(pair(damping=0.5)) * second)


def bounced(mesh, position, velocity, centre, radius, restitution=0.0, friction=0.0):
    """Node by node."""
    places, after = np.array(position, dtype=float), np.array(velocity, dtype=float)
    for node, held in enumerate(mesh[5]):
        away = places[node] - centre
        if held or length(away) >= radius:
            continue
        n = away / length(away) if length(away) > 0 else np.array([0.0, 0, 1])
        places[node] = centre + radius * n
        across = after[node] @ n
        if across < 0:
            along = after[node] - across * n
            lost = min(length(along), friction * (1 + restitution) * -across)
            kept = 1 - lost / length(along) if length(along) > 0 else 1.0
            after[node] = kept * along - restitution * across * n
    return places, after


@asks("mesh_sphere_contact", 6, "Nodes inside go back to the surface; they bounce, and friction slows them.")
def test_nodes_of_any_mesh_bounce_off_a_sphere(submission, part, examples):
    def near(draw):
        centre, radius = draw.vector(), draw.number(1, 4)
        depths = [draw.number(0.2, 0.95) if draw.rng.random() < 0.8 else draw.number(1.05, 1.5) for _ in range(5)]
        at = np.array([centre + depth * radius * draw.unit() for depth in depths])
        return a_mesh(draw, pins=2), at, points(draw, 3), centre, radius, draw.number(0, 1), draw.number(0, 1.5)

    with part(2, "any mesh and sphere"):
        examples.agree(submission.mesh_sphere_contact, bounced, near, count=10)
    with part(1, "without a bounce and without friction, given or not"):

        def plain(draw):
            return near(draw)[:5]

        examples.agree(submission.mesh_sphere_contact, bounced, plain, count=4)
        examples.agree(submission.mesh_sphere_contact, bounced, lambda draw: (*plain(draw), 1.0, 0.0), count=3)
    with part(1, "nothing is inside afterwards, no node is faster, and no node slides the other way"):

        def holds(mesh, at, velocity, centre, radius, e, mu):
            given = (mesh, at, velocity, centre, radius, e, mu)
            places, after = numbers(submission.mesh_sphere_contact, given, 2)
            free = ~mesh[5]
            assert np.all(np.linalg.norm(places - centre, axis=1)[free] > radius - 1e-3), "a node is inside"
            speeds = [np.linalg.norm(each, axis=1) for each in (velocity, after)]
            assert np.all(speeds[1] <= speeds[0] + 1e-3), "a node is faster afterwards"
            n = (places - centre) / np.linalg.norm(places - centre, axis=1)[:, None]
            slides = [each - np.sum(each * n, axis=1)[:, None] * n for each in (velocity, after)]
            assert np.all(np.sum(slides[0] * slides[1], axis=1) > -1e-2), "friction turns a slide round"

        examples.every(near, holds, count=4)
    with part(1, "at the centre, on the surface, along the surface, and at rest"):
        mesh = pair(), np.array([[1.0, -2, 3], [5, -2, 3]])
        for first, second in itertools.product(
            ([0.0, 0, -4], [3, 4, -1], [3, 4, 1], REST), (REST, [-2, 1, 0], [0, 1, 2])
        ):
            given = *mesh, np.array([first, second], dtype=float), np.array([1.0, -2, 3]), 4.0, 0.5, 0.25
            expect(submission.mesh_sphere_contact, given, bounced(*given))
            refuse_changes(submission.mesh_sphere_contact)
    with part(1, "in micrometres and in kilometres, fast and slow"):
        at, velocity, centre = np.array([[1.0, -1, 4], [2, -4, 3]]), np.array([[1.0, -2, -3], [0, 2, 1]]), [1.0, -2, 3]
        for metre, speed in itertools.product((1e-6, 1e-3, 1e6), (1e-6, 1.0, 1e4)):
            given = sized(pair(), metre), metre * at, speed * velocity, metre * np.array(centre), 3 * metre, 0.5, 0.25
            expect(submission.mesh_sphere_contact, given, bounced(*given))


def fitted(mesh, position, limit=0.1, iterations=1000):
    """Spring by spring, each end as far as the centre of mass of the two allows."""
    edges, rest, _, _, mass, pinned = mesh
    at = np.array(position, dtype=float)
    for _ in range(iterations):
        for (i, j), at_rest in zip(edges.tolist(), rest, strict=True):
            way, allowed = at[j] - at[i], at_rest * (1 + limit)
            if at_rest > 0 and length(way) > allowed and not (pinned[i] and pinned[j]):
                light = [0.0 if held else 1 / each for held, each in zip(pinned[[i, j]], mass[[i, j]], strict=True)]
                first = light[0] / sum(light)
                over = way * (1 - allowed / length(way))
                at[i], at[j] = at[i] + first * over, at[j] - (1 - first) * over
    return at


@asks("limit_strain", 6, "One spring after another: it is shortened to the limit, and the centre of mass stays.")
def test_any_mesh_is_drawn_together_spring_by_spring(submission, part, examples):
    def stretched(draw, rounds=3):
        return a_mesh(draw, pins=2), points(draw), draw.number(0, 0.4), int(draw.rng.integers(1, rounds + 1))

    with part(2, "any mesh, for some rounds"):
        examples.agree(submission.limit_strain, fitted, stretched)
    with part(1, "the centre of mass of a free mesh stays, and so do pinned nodes"):

        def stays(mesh, at, limit, rounds):
            found = numbers(submission.limit_strain, (mesh, at, limit, rounds))
            assert np.abs(found[mesh[5]] - at[mesh[5]]).max(initial=0) < 1e-6, "a pinned node has moved"
            if not mesh[5].any():
                assert np.abs(mesh[4] @ (found - at)).max() < 1e-3, "the centre of mass has moved"

        examples.every(stretched, stays, count=4)
        examples.every(lambda draw: (a_mesh(draw), *stretched(draw)[1:]), stays, count=3)
    with part(1, "after many rounds nothing is too long; a tenth unless something else is said"):
        ends = np.array([[k, k + 1] for k in range(4)])
        chain = ends, np.ones(4), np.ones(4), np.zeros(4), np.array([1.0, 2, 3, 1, 2]), np.arange(5) == 0
        at = 1.5 * np.arange(5)[:, None] * np.array([2.0, 3, 6]) / 7 + [1.0, -2, 3]
        expect(submission.limit_strain, (chain, at, 0.2, 40), fitted(chain, at, 0.2, 40))
        found = numbers(submission.limit_strain, (chain, at))
        refuse_changes(submission.limit_strain)
        assert np.abs(np.linalg.norm(np.diff(found, axis=0), axis=1) - 1.1).max() < 1e-3, (
            "some spring is not 1.1 m long"
        )
    with part(1, "both pinned, no rest length, shortened, at one place, no rounds"):
        places = np.array([[1.0, -2, 3], [3, -3, 5]])
        for mesh, rounds in ((pair(1.0, pinned=(True, True)), 3), (pair(0.0), 3), (pair(9.0), 3), (pair(1.0), 0)):
            expect(submission.limit_strain, (mesh, places, 0.1, rounds), places)
        expect(submission.limit_strain, (pair(1.0), places[[0, 0]], 0.1, 2), places[[0, 0]])
    with part(1, "in micrometres and in kilometres, light and heavy"):
        for metre, kilogram in ((1e-6, 1e-6), (1e4, 1e3), (1e-3, 1e6), (1e7, 1.0)):
            mesh = sized(pair(1.5), metre, kilogram)
            expect(submission.limit_strain, (mesh, metre * places, 0.2, 1), metre * fitted(pair(1.5), places, 0.2, 1))
