"""Avoiding a collision: drawn examples against other ways of finding the same, limiting cases, many at once."""

from __future__ import annotations

import itertools
import math

import numpy as np

from labs.grading.judging.comparison import expect, numbers, refuse_changes
from labs.grading.judging.markers import asks

REST = np.zeros(3)
SIZES = (1e-9, 1e-6, 1e4, 1e8)


def length(vector):
    return math.sqrt(vector @ vector)


def pursued(position, target, speed):
    left = length(target - position)
    return np.zeros(len(position)) if left == 0 else (speed / left) * (target - position)


def chase(draw):
    return draw.vector(), draw.vector(), draw.number(0.2, 5)


@asks("seek", 4, "Full speed along the straight line to the target.")
def test_a_seeker_comes_nearer_by_speed_times_time(submission, part, examples):
    with part(2, "any body and any target"):
        examples.agree(submission.seek, pursued, chase, count=16, far=4)
    with part(1, "it comes nearer as fast as it can, and in the plane as well"):

        def nears(position, target, speed):
            for places in ((position, target), (position[:2], target[:2])):
                wanted = numbers(submission.seek, (*places, speed))
                before, far = length(places[1] - places[0]), 1e-3
                after = length(places[1] - places[0] - far * wanted)
                np.testing.assert_allclose(before - after, far * speed, rtol=1e-2, atol=1e-6)

        examples.every(chase, nears)
        for size, speed in itertools.product(SIZES, SIZES):
            start, end = size * np.array([3.0, -1, 2]), size * np.array([1.0, 5, 5])
            expect(submission.seek, (start, end, 7 * speed), speed * np.array([-2, 6, 3]))
        expect(submission.seek, ([2, 5], [2, 5], 3.0), [0, 0])
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.seek, pursued, chase)


def slowing(position, target, speed, radius):
    left = length(target - position)
    return pursued(position, target, speed * min(1.0, left / radius))


@asks("arrive", 5, "The speed is that of seeking, or as much less as the distance is less than the radius.")
def test_one_that_arrives_has_a_speed_in_proportion_to_the_distance(submission, part, examples):
    def drawn(draw):
        return (*chase(draw), draw.number(1, 15))

    with part(2, "any body, target and radius"):
        examples.agree(submission.arrive, slowing, drawn, count=24)
    with part(1, "twice as far is twice as fast, until it is fast enough"):

        def doubles(position, target, speed, radius):
            far = length(target - position)
            for share in (0.001, 0.25, 0.5, 1.0, 2.0, 4.0):
                wanted = numbers(submission.arrive, (target - share * (target - position), target, speed, far))
                np.testing.assert_allclose(length(wanted), speed * min(share, 1.0), rtol=1e-4)

        examples.every(drawn, doubles, count=4)
    with part(1, "in nanometres and in light seconds; at the target; in the plane"):
        for size, speed in itertools.product(SIZES, SIZES):
            start, end = size * np.array([3.0, -1, 2]), size * np.array([1.0, 5, 5])
            for radius, share in ((3.5, 1.0), (28.0, 0.25)):
                given = start, end, 7 * speed, radius * size
                expect(submission.arrive, given, share * speed * np.array([-2, 6, 3]))
        expect(submission.arrive, ([2, 5], [2, 5], 3.0, 1.0), [0, 0])
        expect(submission.arrive, ([1, 1], [4, 5], 2.0, 8.0), [0.75, 1.0])
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.arrive, slowing, drawn)


def repelled(separation, normal, strength, reach):
    if separation >= reach:
        return 0.0 * normal
    left = min(reach - separation, reach)
    return strength * left / reach * left / reach * normal


@asks("repelling_force", 5, "F0 times the square of the share of the reach that is left, along the normal.")
def test_any_field_falls_with_the_square_of_the_reach_that_is_left(submission, part, examples):
    def drawn(draw):
        reach = draw.number(0.3, 6)
        return draw.number(-0.3, 1.3) * reach, draw.unit(), draw.number(0.5, 50), reach

    with part(2, "any field, near and far"):
        examples.agree(submission.repelling_force, repelled, drawn, count=24)
    with part(1, "it never pulls, and never grows on the way out"):

        def falls(separation, normal, strength, reach):
            sizes = [
                numbers(submission.repelling_force, (share * reach, normal, strength, reach)) @ normal
                for share in (-1.0, 0.0, 0.3, 0.6, 0.9, 1.0, 1.2, 2.0, 9.0)
            ]
            assert np.all(np.diff(sizes) <= 1e-6), "it grows on the way out"
            assert sizes[-1] == sizes[-2] == 0, "it goes on beyond its reach"

        examples.every(drawn, falls, count=4)
    with part(1, "in nanometres and in thousands of kilometres, weak and strong"):
        n = np.array([6.0, 2, -3]) / 7
        for size, strength in itertools.product(SIZES, SIZES):
            expect(submission.repelling_force, (3 * size, n, 112 * strength, 4 * size), strength * 7 * n)
            expect(submission.repelling_force, (5 * size, n, 112 * strength, 4 * size), REST)
            expect(submission.repelling_force, (-3 * size, n, strength, 4 * size), strength * n)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.repelling_force, repelled, drawn)


def touched(position, heading, centre, radius):
    """By turning the line to the centre by the angle whose sine is r/L, towards the heading."""
    to_centre = centre - position
    far = length(to_centre)
    if far <= radius:
        return centre - radius / far * to_centre
    ahead = to_centre / far
    across = heading - (heading @ ahead) * ahead
    angle = math.asin(radius / far)
    along = math.cos(angle) * ahead + math.sin(angle) / length(across) * across
    return position + math.cos(angle) * far * along


@asks("tangent_point", 6, "Turn the line to the centre by the angle whose sine is r/L, and go as far as its cosine L.")
def test_any_tangent_touches_the_sphere_on_the_side_of_the_heading(submission, part, examples):
    def drawn(draw):
        centre, radius = draw.vector(), draw.number(0.3, 4)
        position = centre + draw.rng.choice([0.3, 0.8, 1.05, 2.0, 4.0]) * draw.number(0.9, 1.1) * radius * draw.unit()
        return position, draw.vector(3), centre, radius

    with part(2, "any position, heading and sphere"):
        examples.agree(submission.tangent_point, touched, drawn, count=24)
    with part(1, "the point is on the sphere, and the radius is at right angles to the way"):

        def right_angle(position, heading, centre, radius):
            found = numbers(submission.tangent_point, (position, heading, centre, radius))
            np.testing.assert_allclose(length(found - centre), radius, rtol=1e-3, err_msg="it is not on the sphere")
            if length(position - centre) > 1.01 * radius:
                cosine = (found - position) @ (found - centre) / radius / length(found - position)
                assert abs(cosine) < 1e-2, "the angle between radius and way is none of 90°"

        examples.every(drawn, right_angle)
    with part(1, "no side is named: to the left as seen from above, or towards +x"):
        for turn in np.linspace(0.1, 6.2, 5):
            ahead, left = (np.array([math.cos(t), math.sin(t), 0]) for t in (turn, turn + math.pi / 2))
            for heading in (REST, ahead, -3 * ahead):
                given = 2 * left - 1, heading, 2 * left - 1 + 13 * ahead, 5.0
                expect(submission.tangent_point, given, given[0] + 144 / 13 * ahead + 60 / 13 * left)
        for up in (13.0, -13.0):
            given = [1, 2, 3], [0, 0, up], [1, 2, 3 + up], 12.0
            expect(submission.tangent_point, given, [1 + 60 / 13, 2, 3 + 25 / 169 * up])
    with part(1, "in nanometres and in thousands of kilometres, whatever the speed; inside and at the centre"):
        at = np.array([2.0, -3, 1])
        for size, speed in itertools.product(SIZES, SIZES):
            given = size * at, speed * np.array([1.0, 2, 0]), size * np.add(at, [13, 0, 0]), 5 * size
            expect(submission.tangent_point, given, size * np.add(at, [144 / 13, 60 / 13, 0]))
            inside = size * at, speed * np.array([1.0, 2, 0]), size * np.add(at, [2, 3, 6]), 14 * size
            expect(submission.tangent_point, inside, size * (at - [2, 3, 6]))
        for heading in (REST, [1, 0, 0], [0, 0, -1]):
            expect(submission.tangent_point, (at, heading, at, 0.25), np.add(at, [0, 0, 0.25]))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.tangent_point, touched, drawn)


def nearest(pa, va, pb, vb, ra=0.0, rb=0.0):
    """By thirds: the distance of two bodies first falls and then grows."""
    x, u = pa - pb, va - vb
    if length(u) == 0 or x @ u >= 0:
        return 0.0, length(x) - ra - rb
    low, high = 0.0, 2 * length(x) / length(u)
    for _ in range(90):
        first, second = low + (high - low) / 3, high - (high - low) / 3
        # Of squares, the part that both share would leave few digits of the difference.
        falls = (first - second) * (2 * x @ u + (first + second) * u @ u) > 0
        low, high = (first, high) if falls else (low, second)
    return low, length(x + u * low) - ra - rb


@asks("nearest_approach", 6, "The time at which the distance stops falling, or now.")
def test_any_two_bodies_are_nearest_when_their_distance_stops_falling(submission, part, examples):
    def drawn(draw):
        place, velocity, towards = draw.vector(), draw.vector(3), draw.vector(3)
        start = place - draw.rng.choice([-1, 1, 1, 1]) * draw.number(0.3, 3) * towards + draw.vector(1)
        return start, velocity + towards, place, velocity, draw.number(0.1, 2), draw.number(0.1, 2)

    with part(2, "any two bodies"):
        examples.agree(submission.nearest_approach, nearest, drawn, count=24)
    with part(1, "exchanged, they are as near at the same time; twice as fast, and it takes half of it"):

        def exchanged(pa, va, pb, vb, ra, rb):
            time, gap = numbers(submission.nearest_approach, (pa, va, pb, vb, ra, rb), 2)
            for given, factor in (((pb, vb, pa, va, rb, ra), 1.0), ((pa, 2 * va, pb, 2 * vb, rb, ra), 0.5)):
                found = numbers(submission.nearest_approach, given, 2)
                np.testing.assert_allclose(found, (factor * time, gap), rtol=1e-4, atol=1e-6)

        examples.every(drawn, exchanged)
    with part(1, "at rest, side by side, nearest now, at one place, and without radii"):
        for pa, va, pb, vb in (
            ([0, 3, 4], REST, REST, REST),
            ([0, 3, 4], [7, 8, 9], REST, [7, 8, 9]),
            ([0, 3, 4], [2, 4, -3], REST, REST),
            ([1, 2, 3], [2, 4, -3], [1, 2, 3], [5, 0, 0]),
            ([0.5, 3, 4], [0, -6, -8], REST, REST),
            ([5, 3, 4], [-1, 0, 0], REST, REST),
        ):
            given = [np.array(each, dtype=float) for each in (pa, va, pb, vb)]
            expect(submission.nearest_approach, (*given, 0.5, 0.25), nearest(*given, 0.5, 0.25))
            expect(submission.nearest_approach, tuple(given), nearest(*given))
    with part(1, "in nanometres and in thousands of kilometres, slow and fast"):
        x, u = np.array([6.0, 0, -3]), np.array([-2.0, 1, 2])
        for size, speed in itertools.product(SIZES, SIZES):
            given = size * (x + 1), size * speed * (u - 1), size * np.ones(3), -size * speed * np.ones(3)
            expect(submission.nearest_approach, (*given, size, 0.5 * size), (2 / speed, 1.5 * size))
            parting = given[0], size * speed * (-u - 1), given[2], given[3], size, 0.5 * size
            expect(submission.nearest_approach, parting, (0.0, (math.sqrt(45) - 1.5) * size))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.nearest_approach, nearest, drawn)


def some_pairs(draw, count):
    both = [pair for pair in itertools.combinations(range(count), 2) if draw.number(0, 3) < 2]
    found = np.array(both, dtype=int).reshape(-1, 2)
    return found[:, 0], found[:, 1]


def boids(draw):
    count = 2 + int(draw.number(0, 4.9))
    return np.array([draw.vector(3) for _ in range(count)]), *some_pairs(draw, count)


def boids_in_the_plane(draw):
    values, *both = boids(draw)
    return values[:, :2], *both


def neighbours(which, first, second):
    """Everybody who is in a pair with this one."""
    return [j for i, j in zip(first, second, strict=True) if i == which] + [
        i for i, j in zip(first, second, strict=True) if j == which
    ]


def pushed(position, first, second):
    found = np.zeros(position.shape)
    for i in range(len(position)):
        for j in neighbours(i, first, second):
            far = length(position[i] - position[j])
            found[i] += (position[i] - position[j]) / far / far if far else 0.0
    return found


def drawn_together(value, first, second):
    found = np.zeros(value.shape)
    for i in range(len(value)):
        others = neighbours(i, first, second)
        if others:
            found[i] = np.mean([value[j] for j in others], axis=0) - value[i]
    return found


CROWD = np.random.default_rng(4).normal(size=(30, 3))
CROWD_PAIRS = np.array([pair for pair in itertools.combinations(range(30), 2) if sum(pair) % 3]).T


def flock_parts(submission, part, examples, name, formula, power):
    """The parts of a test of a rule of flocks. power: of a length in what it returns."""
    function = getattr(submission, name)
    with part(2, "any flock in space"):
        examples.agree(function, formula, boids, count=14)
        refuse_changes(function)
    with part(1, "any flock in the plane"):
        examples.agree(function, formula, boids_in_the_plane, count=6)
    with part(1, "the order of the boids does not matter, and neither does that of the pairs"):

        def renumbered(value, first, second):
            found = numbers(function, (value, first, second))
            back = len(value) - 1
            turned = numbers(function, (value[::-1].copy(), back - second[::-1], back - first[::-1]))
            np.testing.assert_allclose(turned[::-1], found, atol=1e-5)

        examples.every(boids, renumbered)
    with part(1, "a crowd of thirty; one alone, and nobody near; two at one place"):
        expect(function, (CROWD, *CROWD_PAIRS), formula(CROWD, *CROWD_PAIRS))
        nobody = np.array([], dtype=int)
        for value in ([[1, 2, 3]], [[1, 2], [3, 4]], CROWD[:7]):
            expect(function, (value, nobody, nobody), np.zeros(np.shape(value)))
        both = np.array([0, 0, 1]), np.array([1, 2, 2])
        double = np.array([[1.0, 2, 3], [1, 2, 3], [0, 4, 1]])
        expect(function, (double, *both), formula(double, *both))
    with part(1, "in nanometres and in thousands of kilometres"):
        both = np.array([0, 1, 1]), np.array([2, 2, 3])
        for size in SIZES:
            expect(function, (size * CROWD[:4], *both), size**power * formula(CROWD[:4], *both))


@asks("separation", 6, "A push away from everybody in a pair with a boid, each with one over the distance.")
def test_in_any_flock_each_neighbour_pushes_with_one_over_its_distance(submission, part, examples):
    flock_parts(submission, part, examples, "separation", pushed, -1)


@asks("towards_mean", 6, "The mean over everybody in a pair with a boid, less its own value.")
def test_in_any_flock_the_mean_is_that_of_the_neighbours_alone(submission, part, examples):
    flock_parts(submission, part, examples, "towards_mean", drawn_together, 1)


def turned(vector, angle):
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]])


def border(pa, va, ra, pb, vb, rb, horizon, dt):
    """The nearest of three points: on either side of the cone, which are half-lines, and on the round end."""
    x, u, reach = pb - pa, va - vb, ra + rb
    time = dt if length(x) <= reach else horizon
    middle, outwards = x / time, u - x / time
    rounded = middle + reach / time * outwards / length(outwards)
    candidates = [rounded]
    if length(x) > reach:
        sine, ahead = reach / length(x), x / length(x)
        starts = math.sqrt(x @ x - reach**2) / time
        legs = [turned(ahead, sign * math.asin(sine)) for sign in (1, -1)]
        candidates = [max(starts, u @ leg) * leg for leg in legs]
        if -(outwards @ ahead) >= sine * length(outwards):
            candidates.append(rounded)
    point = min(candidates, key=lambda each: length(each - u))
    meets = min(max(x @ u / (u @ u), 0.0), time)  # when the two are nearest within the time
    inside = length(u * meets - x) < reach if length(x) > reach else length(outwards) < reach / time
    return va + (point - u) / 2, (1 if inside else -1) * (point - u) / length(point - u)


def two_discs(draw):
    """Two discs, mostly apart; the relative velocity is off the border, off the axis and off where a leg begins."""
    while True:
        a, ahead, va, vb = (draw.vector(size)[:2] for size in (5, 4, 2, 2))
        far = length(ahead)
        share = draw.rng.choice([0.15, 0.3, 0.45, 0.6])
        given = a, va, 0.8 * share * far, a + ahead, vb, draw.rng.choice([0.3, 0.7]) * share * far
        given = (*given, draw.number(1, 12), draw.number(0.05, 0.4))
        point, _ = border(*given)
        u = va - vb
        off = abs(u[0] * ahead[1] - u[1] * ahead[0]) / far
        if length(point - va) > 0.01 and off > 0.01:
            return given


@asks("orca_half_plane", 7, "The nearest point of two half-lines and a circle; A goes half of the way.")
def test_any_half_plane_is_half_way_to_the_nearest_point_of_the_border(submission, part, examples):
    with part(2, "any two discs"):
        examples.agree(submission.orca_half_plane, border, two_discs, count=30)
    with part(1, "if both go their half, they just graze each other within the horizon"):

        def graze(pa, va, ra, pb, vb, rb, horizon, dt):
            x, reach = pb - pa, ra + rb
            if length(x) <= reach:
                return
            mine, n = numbers(submission.orca_half_plane, (pa, va, ra, pb, vb, rb, horizon, dt), 2)
            theirs, m = numbers(submission.orca_half_plane, (pb, vb, rb, pa, va, ra, horizon, dt), 2)
            np.testing.assert_allclose(n, -m, atol=1e-3, err_msg="the normals of A and B are not opposite")
            u = mine - theirs
            meets = min(max(x @ u / (u @ u), 0.0), horizon)
            if meets > 1e-6:
                np.testing.assert_allclose(length(u * meets - x), reach, rtol=1e-2, err_msg="they do not graze")

        examples.every(two_discs, graze)
    with part(1, "exactly head-on each turns to its right"):
        for along in ([1.0, 0], [0, 1], [-1, 0], [0, -1]):
            n, right = np.array(along), np.array([along[1], -along[0]])
            given = 2 * right, n, 5.0, 2 * right + 13 * n, -2 * n, 7.0, 9.0, 0.1
            normal = 5 / 13 * right - 12 / 13 * n
            expect(submission.orca_half_plane, given, (n + 18 / 13 * normal, normal))
    with part(1, "they touch, overlap or are at one place"):
        for x, reach, u in (((3, 4), 5.0, (1, 2)), ((3, 4), 6.5, (-2, 1)), ((0, 0), 2.0, (3, -4)), ((1, 0), 2, (9, 9))):
            given = np.array([1.0, -2]), np.array(u, dtype=float), 0.25 * reach, np.array([1.0, -2]) + x
            given = (*given, np.array([0.5, 0.5]), 0.75 * reach, 3.0, 0.25)
            expect(submission.orca_half_plane, given, border(*given))
    with part(1, "in nanometres and in thousands of kilometres, slow and fast"):
        for size, speed in itertools.product(SIZES, SIZES):
            v, w = np.array([2.0, 0.5]), np.array([-1.0, 0.25])
            for share in (0.5, 1.5, 4.0):
                scene = np.array([1.0, 2]), v, 1.5 * share, np.array([6.0, 2.25]), w, 0.5, 8.0, 0.1
                point, normal = border(*scene)
                factors = size, size * speed, size, size, size * speed, size, 1 / speed, 1 / speed
                given = tuple(factor * each for factor, each in zip(factors, scene, strict=True))
                expect(submission.orca_half_plane, given, (size * speed * point, normal))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.orca_half_plane, border, two_discs)
