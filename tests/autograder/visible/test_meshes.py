"""Spring meshes (slides 28 and 29): examples that a student sees.

Most scenes are turned and away from the origin, so that no axis is special. `places(...)` are points of a scene's own
axes, in the axes of the world, and `ways(...)` are velocities, forces and accelerations.
"""

from __future__ import annotations

import math

import numpy as np

from labs.grading.judging.comparison import expect, refuse_changes
from labs.grading.judging.markers import asks

TURN = np.array([[2.0, 1, -2], [1, 2, 2], [2, -2, 1]]) / 3
"""A rotation: its columns are unit vectors at right angles to each other."""
CORNER = np.array([1.0, -2, 3])
REST = [0.0, 0.0, 0.0]
INFINITY = math.inf


def ways(*vectors):
    """Vectors of a scene's own axes."""
    return np.array(vectors, dtype=float) @ TURN.T


def places(*points):
    """Points of a scene's own axes."""
    return CORNER + ways(*points)


def whole(pairs):
    """Pairs of nodes, (m, 2)."""
    return np.array(pairs, dtype=int).reshape(-1, 2)


def mesh(edges, rest_length, stiffness, damping, mass, pinned=()):
    """The six arrays of a spring mesh; one number stands for all springs. pinned: the numbers of these nodes."""
    ends = whole(edges)
    rest, k, c = (np.broadcast_to(np.asarray(each, dtype=float), len(ends)).copy() for each in
                  (rest_length, stiffness, damping))  # fmt: skip
    return ends, rest, k, c, np.array(mass, dtype=float), np.isin(np.arange(len(mass)), pinned)


NODES = [REST, [3, 0, 0], [0, 4, 0], [3, 0, 4]]
EDGES = [[1, 0], [0, 2], [1, 2], [3, 1], [0, 3]]
"""Five springs between these nodes, 3 m, 4 m, 5 m, 4 m and 5 m long."""
LENGTHS, STIFF = [2, 5, 4, 3, 5], [6, 2, 5, 8, 10]
"""At rest, m, and N/m: the springs pull with 6 N, −2 N, 5 N, 8 N and 0 N."""
PULLS = [[6, -2, 0], [-9, 4, 8], [3, -2, 0], [0, 0, -8]]
"""What they do to each node, N."""
DAMPED, MOVING = [1, 4, 5, 2, 5], [[1, 2, 0], [-1, 0, 1], [0, 3, 0], [2, 1, 1]]
"""Dampers, N s/m, and velocities: the pulls are 4 N, 2 N, 14 N, 8 N and 7 N then."""
DAMPED_PULLS = [[8.2, 2, 5.6], [-12.4, 11.2, 8], [8.4, -13.2, 0], [-4.2, 0, -13.6]]
MASSES = [2.0, 1.0, 4.0, 0.5]
STILL = np.zeros((4, 3))


@asks(
    "mesh_forces", 6, "Each spring pulls its two ends towards each other, equally, and each node gets the sum.",
    "How strongly does one spring pull, and in which direction is its first end pulled? And if a node has three"
    " springs, do all three reach it?",
)  # fmt: skip
def test_each_node_gets_the_sum_of_what_its_springs_do(submission, part):
    with part(1, "one spring, longer and shorter than at rest"):
        expect(submission.mesh_forces, (mesh([[0, 1]], 2, 10, 0, [1, 1]), [REST, [3, 0, 0]], np.zeros((2, 3))),
               [[10, 0, 0], [-10, 0, 0]])  # fmt: skip
        for rest, pull in ((2.0, 4.0), (3.5, -2.0), (3.0, 0.0)):
            for ends in ([[0, 1]], [[1, 0]]):
                given = mesh(ends, rest, 4, 7, [1, 2]), places(REST, [2, -1, 2]), np.zeros((2, 3))
                expect(submission.mesh_forces, given, pull / 3 * ways([2, -1, 2], [-2, 1, -2]))
    with part(1, "a damper resists the change of the length, and nothing else"):
        apart = places(REST, [2, -1, 2])
        for velocities, pull in (
            ([REST, [2, -1, 2]], 3), ([[2, -1, 2], REST], -3), ([[1, 4, 1], REST], 0), ([REST, [0, 0, 3]], 2),
            ([[5, -1, 2], [5, -1, 2]], 0), ([[1, 1, -1], [2, 0, 1]], 7 / 3), ([[3, 0, -1], [-2, 4, 0]], -4),
        ):  # fmt: skip
            given = mesh([[0, 1]], 3, 4, 5, [1, 2]), apart, ways(*velocities)
            expect(submission.mesh_forces, given, 5 * pull / 3 * ways([2, -1, 2], [-2, 1, -2]))
    with part(1, "several springs at each node"):
        given = mesh(EDGES, LENGTHS, STIFF, 0, MASSES), places(*NODES), STILL
        expect(submission.mesh_forces, given, ways(*PULLS))
        order = [3, 0, 4, 2, 1]
        shuffled = whole(EDGES)[order, ::-1], np.array(LENGTHS)[order], np.array(STIFF)[order]
        expect(submission.mesh_forces, (mesh(*shuffled, 0, MASSES), places(*NODES), STILL), ways(*PULLS))
    with part(1, "springs and dampers together"):
        added = mesh(EDGES, LENGTHS, STIFF, DAMPED, MASSES), places(*NODES), ways(*MOVING)
        expect(submission.mesh_forces, added, ways(*DAMPED_PULLS))
        whirl = np.cross([0.5, -1, 2], NODES) + np.array([3, -2, 1])  # in one piece
        expect(submission.mesh_forces, (added[0], places(*NODES), ways(*whirl)), ways(*PULLS))
    with part(1, "ends at one place, no rest length, no springs, two springs between two nodes, a pinned node"):
        given = mesh([[0, 1], [1, 2]], [1, 2], 4, 7, [1, 2, 3]), places(REST, REST, [0, 3, 0])
        expect(submission.mesh_forces, (*given, ways([5, 1, 0], REST, REST)), ways(REST, [0, 4, 0], [0, -4, 0]))
        expect(submission.mesh_forces, (mesh([[1, 0]], 0, 4, 0, [1, 2]), places(REST, [2, -1, 2]), np.zeros((2, 3))),
               4 * ways([2, -1, 2], [-2, 1, -2]))  # fmt: skip
        expect(submission.mesh_forces, (mesh([], 0, 0, 0, MASSES), places(*NODES), STILL), STILL)
        twice = mesh([[0, 1], [1, 0], [0, 1]], [1, 2, 4], [4, 6, 5], 0, [1, 2]), places(REST, [2, -1, 2])
        expect(submission.mesh_forces, (*twice, np.zeros((2, 3))), ways([6, -3, 6], [-6, 3, -6]))
        expect(submission.mesh_forces, (mesh(EDGES, LENGTHS, STIFF, 0, MASSES, [0, 2]), places(*NODES), STILL),
               ways(*PULLS))  # fmt: skip
        refuse_changes(submission.mesh_forces)
    with part(1, "a millimetre and a kilometre, weak and stiff"):
        for size, strength in ((1e-3, 1e-4), (1e3, 1.0), (1e-3, 1e7), (1e6, 1e6)):
            lengths, stiff = size * np.array(LENGTHS), strength * np.array(STIFF)
            given = mesh(EDGES, lengths, stiff, strength * np.array(DAMPED), MASSES), size * places(*NODES)
            forces = ways(*DAMPED_PULLS)
            expect(submission.mesh_forces, (*given, size * ways(*MOVING)), size * strength * forces)


@asks(
    "mesh_step", 5, "First the forces, then the velocities, and with these the positions; what is pinned stays.",
    "With which velocity do the nodes move during the step? What does the mass do to a force, and what to gravity?",
)  # fmt: skip
def test_a_step_moves_the_nodes_with_their_new_velocities(submission, part):
    net, at = mesh(EDGES, LENGTHS, STIFF, 0, MASSES), places(*NODES)
    pushed = [[3, -1, 0], [-9, 4, 8], [0.75, -0.5, 0], [0, 0, -16]]  # force over mass, m/s²
    with part(1, "from rest: springs, and nothing else"):
        for dt in (0.5, 2.0):
            after = dt * ways(*pushed)
            expect(submission.mesh_step, (net, at, STILL, REST, dt), (at + dt * after, after))
    with part(1, "gravity, and an acceleration for each node"):
        free, pull = mesh(EDGES, [3, 4, 5, 4, 5], STIFF, 3, MASSES), ways([1, -2, 3])[0]
        flying = ways(*[[2, 0, -1]] * 4)
        expect(submission.mesh_step, (free, at, flying, pull, 0.5),
               (at + 0.5 * ways(*[[2.5, -1, 0.5]] * 4), ways(*[[2.5, -1, 0.5]] * 4)))  # fmt: skip
        each = [[1, 0, 0], [0, -2, 0], [0, 0, 4], [-3, 1, 2]]
        after = 0.5 * ways([4, -1, 0], [-9, 2, 8], [0.75, -0.5, 4], [-3, 1, -14])
        expect(submission.mesh_step, (net, at, STILL, ways(*each), 0.5), (at + 0.5 * after, after))
    with part(1, "moving nodes and dampers, all of it together"):
        damped = mesh(EDGES, LENGTHS, STIFF, DAMPED, MASSES)
        moving = ways(*MOVING)
        after = moving + 0.25 * ways([5.1, -1, 5.8], [-11.4, 9.2, 11], [3.1, -5.3, 3], [-7.4, -2, -24.2])
        given = damped, at, moving, ways([1, -2, 3])[0], 0.25
        expect(submission.mesh_step, given, (at + 0.25 * after, after))
        refuse_changes(submission.mesh_step)
    with part(1, "pinned nodes stay, also if they are thrown; immovable ones; ends at one place; no springs"):
        pins = mesh(EDGES, LENGTHS, STIFF, DAMPED, MASSES, [1, 3])
        after = ways([1, 2, 0], REST, [0, 3, 0], REST) + 0.25 * ways([2.6, -1, 1.8], REST, [3.55, -5.9, 3], REST)
        for thrown in (ways([1, 2, 0], REST, [0, 3, 0], REST), ways([1, 2, 0], [9, 9, 9], [0, 3, 0], [-1, 5, 2])):
            expect(submission.mesh_step, (pins, at, thrown, ways([1, -2, 3])[0], 0.25), (at + 0.25 * after, after))
        together = mesh([[0, 1]], 2, 4, 3, [1, 2]), places(REST, REST), ways([1, 0, 2], REST)
        expect(submission.mesh_step, (*together, REST, 0.5), (places([0.5, 0, 1], REST), ways([1, 0, 2], REST)))
        immovable = mesh([[0, 1]], 2, 4, 0, [INFINITY, 2], [0]), places(REST, [2, -1, 2]), np.zeros((2, 3))
        expect(submission.mesh_step, (*immovable, REST, 0.5),
               (places(REST, [5 / 3, -5 / 6, 5 / 3]), ways(REST, [-2 / 3, 1 / 3, -2 / 3])))  # fmt: skip
        expect(submission.mesh_step, (mesh([], 0, 0, 0, [2, 3]), places(REST, [2, -1, 2]), ways([1, 0, 2], REST),
               ways([0, 4, 0])[0], 0.5), (places([0.5, 1, 1], [2, 0, 2]), ways([1, 2, 2], [0, 2, 0])))  # fmt: skip
    with part(1, "a millimetre and a kilometre, quick and slow"):
        for size, second in ((1e-3, 1e-3), (1e3, 1.0), (1e-2, 1e4), (1e6, 1e5)):
            pulled = size / second**2
            stiff = mesh(EDGES, size * np.array(LENGTHS), np.array(STIFF) / second**2, 0, MASSES)
            after = 0.5 * size / second * ways([4, -3, 3], [-8, 2, 11], [1.75, -2.5, 3], [1, -2, -13])
            given = stiff, size * at, STILL, pulled * ways([1, -2, 3])[0], 0.5 * second
            expect(submission.mesh_step, given, (size * at + 0.5 * second * after, after))


CUBE = [[x, y, z] for x in (0, 2) for y in (0, 2) for z in (0, 2)]
CUBE_EDGES = [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]]
FACES = [[0, 3], [1, 2], [4, 7], [5, 6], [0, 5], [1, 4], [2, 7], [3, 6], [0, 6], [2, 4], [1, 7], [3, 5]]
"""The diagonals of the faces, two by two."""
SPACE = [[0, 7], [1, 6], [2, 5], [3, 4]]


@asks(
    "diagonals", 5, "A spring is needed if no sum of the springs that are there does its work already.",
    "A spring forbids one motion of all nodes. Write down which: it is a row of numbers. How does a row show that it"
    " says nothing new?",
)  # fmt: skip
def test_a_spring_is_needed_if_it_resists_what_no_other_does(submission, part):
    square, sides = places(REST, [2, 0, 0], [2, 2, 0], [0, 2, 0]), whole([[0, 1], [1, 2], [3, 2], [0, 3]])
    with part(1, "the diagonals of a square, and of two squares side by side"):
        for both in ([[0, 2], [1, 3]], [[3, 1], [2, 0]]):
            expect(submission.diagonals, ([REST, [2, 0, 0], [2, 2, 0], [0, 2, 0]], sides, whole(both)), [1, 0])
            expect(submission.diagonals, (square, sides, whole(both)), [1, 0])
        ladder = places(*[[x, y, 0] for x in (0, 1, 3) for y in (0, 2)])
        rungs = whole([[0, 1], [2, 3], [4, 5], [0, 2], [2, 4], [1, 3], [3, 5]])
        expect(submission.diagonals, (ladder, rungs, whole([[0, 3], [1, 2], [2, 5], [3, 4], [1, 4]])), [1, 0, 1, 0, 0])
    with part(1, "a cube and the diagonals of its faces"):
        expect(submission.diagonals, (CUBE, whole(CUBE_EDGES), whole(FACES)), [1, 0] * 6)
        expect(submission.diagonals, (places(*CUBE), whole(CUBE_EDGES), whole(FACES)[::-1]), [1, 0] * 6)
        mixed = whole(FACES)[[0, 2, 4, 6, 1, 8, 10, 3, 5]]
        expect(submission.diagonals, (places(*CUBE), whole(CUBE_EDGES), mixed), [1, 1, 1, 1, 0, 1, 1, 0, 0])
    with part(1, "a cube and the diagonals of its space: it is not enough to count"):
        expect(submission.diagonals, (places(*CUBE), whole(CUBE_EDGES), whole(SPACE + FACES)),
               [1, 1, 1, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0])  # fmt: skip
        expect(submission.diagonals, (places(*CUBE), whole(CUBE_EDGES), whole(FACES + SPACE)), [1, 0] * 6 + [0] * 4)
    with part(1, "an edge once more, a hinge, nodes on a line and nodes at one place"):
        tetrahedron = places(REST, [2, 0, 0], [0, 3, 0], [1, 1, 2])
        six = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]]
        expect(submission.diagonals, (tetrahedron, whole(six[:5]), whole([[3, 0], [2, 3], [3, 2]])), [0, 1, 0])
        hinge = places(REST, [2, 0, 0], [1, 2, 1], [1, -2, 1])
        expect(submission.diagonals, (hinge, whole(six[:5]), whole([[1, 0], [3, 2], [2, 3]])), [0, 1, 0])
        line = places(REST, [1, 2, 3], [2, 4, 6])
        expect(submission.diagonals, (line, whole([[0, 1], [1, 2]]), whole([[0, 2]])), [0])
        stacked = places(REST, REST, [1, 2, 3])
        expect(submission.diagonals, (stacked, whole([[0, 2]]), whole([[0, 1], [2, 1]])), [0, 1])
    with part(1, "nothing there yet, nothing to add; a millimetre and a kilometre"):
        expect(submission.diagonals, (tetrahedron, whole([]), whole([*six, [0, 1]])), [1] * 6 + [0])
        expect(submission.diagonals, (tetrahedron, whole(six), whole([])), np.zeros(0))
        for size in (1e-6, 1e-3, 1e3, 1e6):
            expect(submission.diagonals, (size * places(*CUBE), whole(CUBE_EDGES), whole(FACES)), [1, 0] * 6)
        refuse_changes(submission.diagonals)


@asks(
    "timestep_bound", 5, "The node on which the most stiffness acts for its mass allows the shortest step.",
    "Let a node and its neighbours move against each other. By how much does each spring change, and what is pulling at"
    " the node? Which step is the limit then?",
)  # fmt: skip
def test_the_node_with_the_most_stiffness_for_its_mass_decides(submission, part):
    def bound(*net):
        return (mesh(*net),)

    with part(1, "one spring: equal and unequal masses, and a wall"):
        expect(submission.timestep_bound, bound([[0, 1]], 1, 50, 0, [1, 1]), 0.2)
        expect(submission.timestep_bound, bound([[1, 0]], 3, 50, 0, [4, 0.25]), 0.1)
        expect(submission.timestep_bound, bound([[0, 1]], 1, 50, 0, [4, 0.25], [1]), 0.4)
        expect(submission.timestep_bound, bound([[0, 1]], 0, 200, 0, [1, 4]), 0.1)
    with part(1, "several springs at a node"):
        expect(submission.timestep_bound, bound([[0, 1], [2, 1], [1, 3]], 1, [90, 50, 60], 0, [9, 4, 3, 3]), 0.2)
        expect(submission.timestep_bound, bound([[1, 0], [1, 2]], 1, [18, 32], 0, [5, 1, 2]), 0.2)
        expect(
            submission.timestep_bound,
            bound([[0, 1], [1, 2], [2, 3]], 1, [400, 1, 2], 0, [16, 16, 0.02, 9]),
            2 / math.sqrt(300),
        )
        expect(submission.timestep_bound, bound(EDGES, LENGTHS, STIFF, 0, MASSES), 2 / math.sqrt(72))
    with part(1, "dampers make it shorter"):
        expect(submission.timestep_bound, bound([[0, 1]], 1, 50, 7.5, [1, 1]), 0.1)
        expect(submission.timestep_bound, bound([[0, 1], [1, 2]], 1, [30, 70], [5, 10], [9, 2, 9]), 0.1)
        expect(submission.timestep_bound, bound([[0, 1]], 1, 0, 4, [1, 2]), 0.25)
        expect(
            submission.timestep_bound,
            bound([[0, 1], [2, 1]], 1, [50, 25], [0, 7.5], [2, 6, 1]),
            4 / (15 + math.sqrt(425)),
        )
        expect(submission.timestep_bound, bound([[0, 1], [0, 2], [1, 2]], 1, [48, 2, 20], [0, 0, 8], [1, 1, 1]),
               4 / (16 + math.sqrt(256 + 544)))  # fmt: skip
    with part(1, "pinned and immovable nodes set no limit"):
        expect(submission.timestep_bound, bound([[0, 1], [0, 2], [0, 3]], 1, 50, 0, [0.01, 1, 4, 1], [0]), 0.2)
        expect(submission.timestep_bound, bound([[0, 1], [1, 2]], 1, [50, 150], 0, [INFINITY, 4, 16], [0]), 0.2)
        for free in (
            bound([], 1, 1, 1, [1, 2]),
            bound([[0, 1]], 1, 50, 3, [1, 2], [0, 1]),
            bound([[0, 1]], 1, 0, 0, [1, 2]),
        ):
            expect(submission.timestep_bound, free, INFINITY)
        refuse_changes(submission.timestep_bound)
    with part(1, "light and heavy, weak and stiff"):
        for kilogram, second in ((1e-6, 1.0), (1e3, 1e-5), (1e-4, 1e4), (1e6, 1e3)):
            net = bound([[0, 1]], 1, 50 * kilogram / second**2, 7.5 * kilogram / second, [kilogram, kilogram])
            expect(submission.timestep_bound, net, 0.1 * second)


NEAR = [[2 / 3, 4 / 3, 4 / 3], [2, -2, 1], [-2, 0, 0], [1, 4, 1]]
"""In a sphere of 3 m around the origin: 2 m from its middle, on its surface, 2 m from its middle, and outside."""


@asks(
    "mesh_sphere_contact", 6, "What is inside is put back on the surface; its normal velocity is turned round, and"
    " friction slows it along the surface.",
    "In which direction is the surface nearest? Split the velocity into a part along it and a part across. What does"
    " the sphere do to each of them, and how large may friction be?",
)  # fmt: skip
def test_what_is_in_the_sphere_is_put_back_on_it_and_bounces(submission, part):
    net, at = mesh(EDGES, LENGTHS, STIFF, 3, MASSES), places(*NEAR)
    out = places([1, 2, 2], NEAR[1], [-3, 0, 0], NEAR[3])
    falls = ways([1, -1, -4], [-3, 1, 2], [4, 3, -4], [-2, -5, -1])

    def after(first, third):
        return out, ways(first, [-3, 1, 2], third, [-2, -5, -1])

    with part(1, "straight into it, without a bounce"):
        drop = ways([-2, -4, -4], REST, [3, 0, 0], REST)
        expect(submission.mesh_sphere_contact, (net, at, drop, CORNER, 3.0), (out, np.zeros((4, 3))))
        one = mesh([], 0, 0, 0, [1]), [[0, 0, 1.5]], [[0, 0, -2]], REST, 2.0, 0.5, 0.0
        expect(submission.mesh_sphere_contact, one, ([[0, 0, 2]], [[0, 0, 1]]))
    with part(1, "slanted, without friction"):
        expect(submission.mesh_sphere_contact, (net, at, falls, CORNER, 3.0), after([2, 1, -2], [0, 3, -4]))
        expect(
            submission.mesh_sphere_contact, (net, at, falls, CORNER, 3.0, 0.5, 0.0), after([2.5, 2, -1], [-2, 3, -4])
        )
        expect(submission.mesh_sphere_contact, (net, at, falls, CORNER, 3.0, 1.0, 0.0), after([3, 3, 0], [-4, 3, -4]))
    with part(1, "with friction that slows it, or stops it"):
        expect(submission.mesh_sphere_contact, (net, at, falls, CORNER, 3.0, 0.5, 0.2),
               after([1.9, 1.7, -0.4], [-2, 2.28, -3.04]))  # fmt: skip
        expect(
            submission.mesh_sphere_contact, (net, at, falls, CORNER, 3.0, 0.0, 0.5), after([1, 0.5, -1], [0, 1.8, -2.4])
        )
        expect(submission.mesh_sphere_contact, (net, at, falls, CORNER, 3.0, 0.5, 3.0), after([0.5, 1, 1], [-2, 0, 0]))
    with part(1, "on its way out or along the surface; pinned"):
        leaving = ways([2, 2, 0], REST, [0, 2, 5], [1, 1, 1])
        expect(submission.mesh_sphere_contact, (net, at, leaving, CORNER, 3.0, 0.5, 0.2), (out, leaving))
        held = mesh(EDGES, LENGTHS, STIFF, 3, [*MASSES[:2], INFINITY, 0.5], [0, 2])
        expect(submission.mesh_sphere_contact, (held, at, falls, CORNER, 3.0, 0.5, 0.2), (at, falls))
        one = mesh(EDGES, LENGTHS, STIFF, 3, MASSES, [2]), at, falls, CORNER, 3.0, 0.5, 0.2
        expect(
            submission.mesh_sphere_contact, one, (np.vstack([out[:2], at[2:]]), after([1.9, 1.7, -0.4], [4, 3, -4])[1])
        )
        refuse_changes(submission.mesh_sphere_contact)
    with part(1, "at the centre, on the surface, and without a velocity"):
        middle, up = CORNER[None], CORNER[None] + np.array([0, 0, 3])
        for velocity, gives in (([3, 4, -5], [1.8, 2.4, 2.5]), ([3, 4, 5], [3, 4, 5]), (REST, REST)):
            given = mesh([], 0, 0, 0, [1]), middle, [velocity], CORNER, 3.0, 0.5, 0.2 / 0.75
            expect(submission.mesh_sphere_contact, given, (up, [gives]))
        on = [[0, 0, 5.0], [3, 0, 4], [0, -5, 0]], [[0, 1, -2], [-1, 0, -2], [0, 3, 0]], REST, 5.0, 0.5, 0.3
        expect(submission.mesh_sphere_contact, (mesh([], 0, 0, 0, [1, 2, 3]), *on), on[:2])
    with part(1, "a millimetre and a kilometre, fast and slow"):
        for size, speed in ((1e-3, 1e-3), (1e3, 1e4), (1e-4, 1.0), (1e6, 1e-4)):
            scaled = np.array(LENGTHS) * size
            given = mesh(EDGES, scaled, STIFF, 3, MASSES), size * at, speed * falls, size * CORNER, 3.0 * size, 0.5, 0.2
            right = after([1.9, 1.7, -0.4], [-2, 2.28, -3.04])
            expect(submission.mesh_sphere_contact, given, (size * right[0], speed * right[1]))


@asks(
    "limit_strain", 5, "Too long a spring is shortened to the limit, and the lighter end makes more of the way.",
    "How long may the spring be, and what is left over? Which share of it has each end to take, so that the centre of"
    " mass stays? Who takes it if one end is pinned?",
)  # fmt: skip
def test_too_long_a_spring_is_shortened_to_the_limit(submission, part):
    def pair(rest, masses=(1, 1), pins=(), ends=((0, 1),)):
        return mesh(ends, rest, 10, 1, masses, pins)

    way = np.array([2, -1, 2])  # 3 m
    with part(1, "one spring, equal and unequal masses"):
        expect(submission.limit_strain, (pair(1), [REST, [2, 0, 0]], 0.2, 1), [[0.4, 0, 0], [1.6, 0, 0]])
        for masses, ends, shares in (((1, 1), [[0, 1]], (0.2, 0.8)), ((1, 3), [[0, 1]], (0.3, 0.9)),
                                     ((1, 3), [[1, 0]], (0.3, 0.9)), ((9, 1), [[0, 1]], (0.04, 0.64))):  # fmt: skip
            given = pair(1.5, masses, (), ends), places(REST, way), 0.2, 1
            expect(submission.limit_strain, given, places(*(each * way for each in shares)))
        expect(submission.limit_strain, (pair(2), places(REST, way), 0.0, 3), places(way / 6, 5 * way / 6))
        expect(submission.limit_strain, (pair(2), places(REST, way)), places(2 * way / 15, 13 * way / 15))
    with part(1, "a pinned end, an immovable one, both"):
        expect(submission.limit_strain, (pair(1.5, (1, 3), [0]), places(REST, way), 0.2, 1), places(REST, 0.6 * way))
        expect(submission.limit_strain, (pair(1.5, (1, 3), [1]), places(REST, way), 0.2, 1), places(0.4 * way, way))
        immovable = pair(1.5, (INFINITY, 3), [0])
        expect(submission.limit_strain, (immovable, places(REST, way), 0.2, 1), places(REST, 0.6 * way))
        expect(submission.limit_strain, (pair(1.5, (1, 3), [0, 1]), places(REST, way), 0.2, 2), places(REST, way))
    with part(1, "within the limit, shortened, without a rest length; no rounds, no springs"):
        for net, rounds in (
            (pair(2.9), 3),
            (pair(2.5), 3),
            (pair(5), 3),
            (pair(0), 3),
            (pair(1), 0),
            (pair(1, ends=()), 3),
        ):
            expect(submission.limit_strain, (net, places(REST, way), 0.2, rounds), places(REST, way))
        expect(submission.limit_strain, (pair(1), places(way, way), 0.2, 3), places(way, way))
        refuse_changes(submission.limit_strain)
    with part(1, "one spring after another, in their order, round after round"):
        chain, row = [[0, 1], [1, 2]], [REST, [2, 0, 0], [3, 0, 0]]
        rounds = {1: [[0.5, 0, 0], [1.75, 0, 0], [2.75, 0, 0]], 2: [[0.625, 0, 0], [1.6875, 0, 0], [2.6875, 0, 0]]}
        for count, right in rounds.items():
            net = mesh(chain, 1, 10, 1, [1, 1, 1])
            expect(submission.limit_strain, (net, places(*row), 0.0, count), places(*right))
        other = mesh(chain[::-1], 1, 10, 1, [1, 1, 1]), places(*row), 0.0, 1
        expect(submission.limit_strain, other, places([0.5, 0, 0], [1.5, 0, 0], [3, 0, 0]))
        star = mesh([[0, 1], [2, 0], [3, 0]], [1, 2, 3], 10, 1, [1, 1, 1, 1], [0])
        given = star, places(REST, [2, 0, 0], [0, 3, 0], [0, 0, 4]), 0.0, 1
        expect(submission.limit_strain, given, places(REST, [1, 0, 0], [0, 2, 0], [0, 0, 3]))
        pins = mesh(chain, 1, 10, 1, [1, 1, 1], [0, 2]), places(REST, [1.5, 0, 0], [2.8, 0, 0])
        expect(submission.limit_strain, (*pins, 0.1, 3), places(REST, [1.7, 0, 0], [2.8, 0, 0]))
    with part(1, "a millimetre and a kilometre, light and heavy"):
        for size, kilogram in ((1e-3, 1e-6), (1e3, 1e3), (1e-5, 1.0), (1e6, 1e-4)):
            net = mesh([[0, 1]], 1.5 * size, 10, 1, [kilogram, 3 * kilogram])
            given = net, size * places(REST, way), 0.2, 1
            expect(submission.limit_strain, given, size * places(0.3 * way, 0.9 * way))
