"""Swept volumes: drawn examples against other ways of finding the same, limiting cases, many at once."""

from __future__ import annotations

import itertools
import math

import numpy as np

from labs.grading.judging.comparison import expect, numbers, refuse_changes
from labs.grading.judging.markers import asks

REST = [0.0, 0.0, 0.0]
INFINITY, MISS = math.inf, (math.inf, -math.inf)


def length(vector):
    return math.sqrt(vector @ vector)


def beside(draw, along, distance):
    """A vector at right angles to a direction."""
    across = np.cross(along, draw.vector())
    return distance * across / length(across)


def met(x, u, radius):
    """By the point of the ray that is nearest to the middle, and half the chord on either side of it."""
    if length(x) <= radius:
        return 0.0
    way = u / length(u)
    ahead, half = -x @ way, radius**2 - length(x - (x @ way) * way) ** 2
    return (ahead - math.sqrt(half)) / length(u) if ahead > 0 and half >= 0 else INFINITY


def ray(draw, shares=(0.05, 0.95)):
    """A ray that passes a sphere at a share of its radius: it comes, it goes, or it starts within."""
    u, radius = draw.vector(4), draw.number(0.3, 3)
    nearest = beside(draw, u, (draw.number(*shares) + 0.003) * radius)  # so that none grazes the sphere
    return nearest - draw.rng.choice([1, 1, 1, -1, 0]) * draw.number(0.5, 4) * (1 + radius / length(u)) * u, u, radius


@asks("ray_sphere", 6, "Half a chord before the point of the ray that is nearest to the middle.")
def test_any_ray_meets_a_sphere_half_a_chord_before_its_nearest_point(submission, part, examples):
    with part(2, "any ray that passes through a sphere, comes from it, or starts in it"):
        examples.agree(submission.ray_sphere, met, ray, count=30)
    with part(1, "any ray that passes by"):
        examples.agree(submission.ray_sphere, met, lambda draw: ray(draw, (1.05, 3)), count=12)
    with part(1, "in millimetres and in kilometres; slowly, from far away, and hardly at all"):
        for size in (1e-6, 1e-4, 1e3, 1e6):
            for speed in (1e-6, 1e-3, 1, 1e4):
                x, u = size * np.array([5.0, 4, 2]), size * speed * np.array([-2.0, -1, 0])
                expect(submission.ray_sphere, (x, u, 3 * size), 2 / speed)
        expect(submission.ray_sphere, ([1e5, 0, 1.5], [-1, 0, 0], 2.5), 1e5 - 2)
        for offset in (1.9999, 2.0001):
            x, u = np.array([offset, -3, 0]), np.array([0.0, 2, 0])
            expect(submission.ray_sphere, (x, u, 2.0), met(x, u, 2.0))
    with part(1, "twice as fast, and it takes half the time"):

        def halved(x, u, radius):
            once, twice = (float(numbers(submission.ray_sphere, (x, k * u, radius), finite=False)) for k in (1, 2))
            assert math.isfinite(once), "it passes through the sphere"
            np.testing.assert_allclose(2 * twice, once, rtol=1e-4)

        def coming(draw):
            u, radius = draw.vector(4), draw.number(0.3, 3)
            return beside(draw, u, 0.5 * radius) - (1 + radius / length(u)) * u, u, radius

        examples.every(coming, halved)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.ray_sphere, met, ray)


def touched(xa, va, ra, xb, vb, rb, dt):
    time = met(xa - xb, va - vb, ra + rb) if length(va - vb) else (0.0 if length(xa - xb) <= ra + rb else INFINITY)
    return time if time <= dt else INFINITY


def flight(draw):
    """Two balls that come near each other, within the step or not."""
    ra, xb, vb, dt = draw.number(0.2, 1.5), draw.vector(), draw.vector(4), draw.number(0.5, 3)
    x, u, radius = ray(draw, (0.05, 1.3))
    if draw.sign() > 0 and radius > 0.4:
        ra = radius / 2
    return xb + x, vb + u, min(ra, radius), xb, vb, radius - min(ra, radius), dt


@asks("sweep_sphere_sphere", 6, "The distance of two centres that move is r_A + r_B for the first time.")
def test_any_two_balls_touch_when_their_centres_are_both_radii_apart(submission, part, examples):
    with part(2, "any two balls"):
        examples.agree(submission.sweep_sphere_sphere, touched, flight, count=40)
    with part(1, "which of them is A does not matter, and at that time they touch"):

        def touching(xa, va, ra, xb, vb, rb, dt):
            a, b = (xa, va, ra), (xb, vb, rb)
            time, other = (
                float(numbers(submission.sweep_sphere_sphere, (*first, *second, dt), finite=False))
                for first, second in ((a, b), (b, a))
            )
            assert time == other or abs(time - other) < 1e-3, "the time is another one if A and B are exchanged"
            if 0 < time < INFINITY:
                apart = length(xa + va * time - xb - vb * time)
                np.testing.assert_allclose(apart, ra + rb, atol=1e-2, err_msg="they do not touch at the time")

        examples.every(flight, touching, count=16)
    with part(1, "at rest beside each other, in each other, points, a step that ends in time"):
        for xa, va, ra, xb, vb, rb, dt in (
            ([0, 0, 1], [1, 2, 3], 0.5, [0, 0, 3], [1, 2, 3], 1.5, 2.0),
            ([0, 0, 1], REST, 0.5, [0, 0, 3], REST, 1.0, 2.0),
            ([0, 0, 1], [9, 0, 0], 5.0, [1, 0, 1], REST, 0.5, 2.0),
            ([0, 4, 1], [0, -2, 0], 0.0, [0, 0, 1], REST, 0.0, 9.0),
            ([0, 4, 1], [0, -2, 0], 0.0, [0, 0, 1], REST, 0.0, 1.9),
            ([0, 4, 1], [0, -2, 0], 1.0, REST, REST, 0.0, INFINITY),
        ):
            xa, va, xb, vb = (np.array(each, dtype=float) for each in (xa, va, xb, vb))
            given = xa, va, ra, xb, vb, rb, dt
            expect(submission.sweep_sphere_sphere, given, touched(*given))
    with part(1, "two bullets at a kilometre a second; grains of dust, and drifting moons"):
        bullets = ([-500, 0, 0.004], [900, 1, 0], 0.005, [500, 1, 0], [-1100, -1, 0], 0.003)
        given = tuple(np.asarray(each, dtype=float) for each in bullets)
        expect(submission.sweep_sphere_sphere, (*bullets, 1.0), touched(*given, 1.0))
        for size, speed in itertools.product((1e-6, 1e6), (1e-6, 1, 1e6)):
            moving = (
                (size * np.array([6.0, 2, 5]), size * speed * np.array([-1.0, 1, 3]), size),
                (size * np.array([1.0, -2, 3]), size * speed * np.array([1.0, 2, 3]), 2 * size),
            )
            expect(submission.sweep_sphere_sphere, (*moving[0], *moving[1], 5 / speed), 2 / speed)
            expect(submission.sweep_sphere_sphere, (*moving[0], *moving[1], 1.5 / speed), INFINITY)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.sweep_sphere_sphere, touched, flight)


HALF_CHORDS = (np.arange(20_000) + 0.5) / 20_000
"""Of a disk of radius 1. Its area is the sum of strips: the one with a half chord s has an area in proportion to s."""


def missed(speed, ra, rb, dt):
    """The mean over the area of the disk."""
    if speed * dt == 0:
        return 0.0
    free = np.maximum(0.0, 1 - 2 * (ra + rb) * HALF_CHORDS / (speed * dt))
    return float(np.average(free, weights=HALF_CHORDS))


@asks("missed_share", 4, "The mean over the offsets of the probability that no look falls on the chord.")
def test_the_share_missed_is_the_mean_over_all_offsets(submission, part, examples):
    def looks(draw):
        return draw.number(1, 20), draw.number(0.1, 1), draw.number(0.1, 1), draw.number(0.05, 0.4)

    with part(2, "any two balls and any looks"):
        examples.agree(submission.missed_share, missed, looks, count=20)
    with part(1, "only the way over both radii matters, and a longer way misses more; any unit"):
        for size, speed in itertools.product((1e-6, 1e6), (1e-6, 1e6)):
            for way, share in ((2, 1 / 12), (8, 2 / 3)):
                given = (way * size * speed, 0.5 * size, 1.5 * size, 1 / speed)
                expect(submission.missed_share, given, share)

        def grows(speed, ra, rb, dt):
            found = [
                numbers(submission.missed_share, given)
                for given in ((speed, ra, rb, dt), (dt, rb, ra, speed), (speed, 3 * ra, 3 * rb, 3 * dt))
            ]
            np.testing.assert_allclose(found, found[0], atol=1e-5)
            assert numbers(submission.missed_share, (1.1 * speed, ra, rb, dt)) > found[0], "a longer way misses less"

        examples.every(looks, grows)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.missed_share, missed, looks)


def clipped(x, u, half):
    """By cutting off what is beyond each of the six faces in turn."""
    start, end = 0.0, INFINITY
    for axis, side in itertools.product(range(3), (-1, 1)):
        room, rate = half[axis] - side * x[axis], side * u[axis]  # it is inside while room − rate t ≥ 0
        if rate == 0:
            end = end if room >= 0 else -INFINITY
        elif rate > 0:
            end = min(end, room / rate)
        else:
            start = max(start, room / rate)
    return (start, end) if start <= end else MISS


def through(draw):
    """A ray through a box, past it, from it or from within; two times in five along one axis or two."""
    half = np.array([draw.number(0.5, 2) for _ in range(3)])
    spot = half * np.array([draw.number(-0.98, 0.98) for _ in range(3)])
    u = draw.vector(3) * draw.rng.choice([[1, 1, 1], [1, 1, 1], [1, 1, 1], [0, 1, 1], [0, 0, 1]])
    u = draw.rng.permutation(u)
    aside = np.where(draw.rng.integers(3), 0, 2.1 * half * draw.sign())
    return spot + aside - draw.rng.choice([1, 1, 0, -1]) * draw.number(0.3, 2) * u, u, half


@asks("ray_box", 7, "What is left of the ray when all that is beyond one of the six faces is cut off.")
def test_any_ray_is_in_a_box_where_six_faces_leave_something_of_it(submission, part, examples):
    with part(2, "any ray"):
        examples.agree(submission.ray_box, clipped, through, count=40)
    with part(1, "all rays along one axis or two, between, on and beside the faces"):
        half = np.array([1.0, 2, 3])
        ways = [each for each in itertools.product((-1.0, 0, 1), repeat=3) if 0 < np.count_nonzero(each) < 3]
        places = [each * half for each in itertools.product((-2.0, -1, 0.5), repeat=3)]
        cases = [(np.asarray(x), np.array(u)) for u in ways for x in places]
        starts, directions = (np.array(each) for each in zip(*cases, strict=True))
        entry, leaving = zip(*(clipped(x, u, half) for x, u in cases), strict=True)
        expect(submission.ray_box, (starts, directions, half), (entry, leaving))
    with part(1, "no direction, anywhere; a plate, a stick and a point"):
        for x in itertools.product((0.5, -1.0, 1.5), (2.0, 0), (3.0, -3.25)):
            expect(submission.ray_box, (x, REST, half), clipped(np.array(x), np.zeros(3), half))
        for flat in ([0, 2, 3], [1, 0, 3], [0, 0, 3], REST):
            for x, u in (
                ([-4, 0, 0], [2, 0, 0]),
                ([-4, -4, 0], [2, 2, 0]),
                ([0, 0, 8], [0, 0, -2]),
                ([3, 3, 3], [-1, -1, 0]),
            ):
                expect(submission.ray_box, (x, u, flat), clipped(np.array(x), np.array(u), flat))
    with part(1, "between entry and exit it is inside, before and after outside"):

        def inside(x, u, half):
            entry, leaving = numbers(submission.ray_box, (x, u, half), 2, finite=False)
            for time in np.linspace(0, 6, 61):
                deep = np.min(half - np.abs(x + u * time))  # how far inside all faces
                within = entry <= time <= leaving
                assert abs(deep) < 1e-2 or within == (deep > 0), (
                    f"at {time:.3g} it is {'outside' if within else 'inside'}"
                )

        examples.every(through, inside)
    with part(1, "in millimetres and in kilometres, fast and slow"):
        for size, speed in itertools.product((1e-6, 1e-4, 1e3, 1e6), (1e-6, 1e-3, 1, 1e4)):
            x, u = size * np.array([-4.0, -1, 2]), size * speed * np.array([2, 1, -0.5])
            expect(submission.ray_box, (x, u, size * half), (1.5 / speed, 2.5 / speed))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.ray_box, clipped, through)


def from_segment(point, a, b):
    along = b - a
    share = min(max((point - a) @ along / (along @ along), 0), 1) if along @ along else 0.0
    return length(point - a - share * along)


def reached(x, u, a, b, radius):
    """By halving: along a ray the distance from a segment first falls and then grows."""

    def apart(time):
        return from_segment(x + u * time, a, b) - radius

    low, high = 0.0, 1e3
    for _ in range(70):  # the time of the smallest distance, by thirds
        first, second = low + (high - low) / 3, high - (high - low) / 3
        low, high = (first, high) if apart(first) > apart(second) else (low, second)
    low, high = 0.0, (low + high) / 2
    if apart(0.0) <= 0:
        return 0.0
    if apart(high) > 0:
        return INFINITY
    for _ in range(45):
        middle = (low + high) / 2
        low, high = (low, middle) if apart(middle) <= 0 else (middle, high)
    return high


def towards(draw):
    """A ray that comes to a capsule, misses it, leaves it or starts within; at its side or at its ends."""
    a, b, u, radius = draw.vector(3), draw.vector(3), draw.vector(3), draw.number(0.3, 1)
    share = draw.rng.choice([-0.05, 0, 0.2, 0.5, 0.8, 1, 1.05])
    offset = draw.rng.choice([0.1, 0.5, 0.9, 1.2, 2]) * radius
    spot = a + share * (b - a) + beside(draw, u, offset)
    x = spot - draw.rng.choice([1, 1, 1, -1, 0]) * draw.number(0.5, 4) * u
    return x + 0.001 * draw.vector(), u, a, b, radius  # so that nothing is touched exactly


@asks("ray_capsule", 7, "The first time at which the distance from the segment is the radius.")
def test_any_ray_meets_a_capsule_where_its_distance_is_the_radius(submission, part, examples):
    with part(2, "any ray and capsule"):
        examples.agree(submission.ray_capsule, reached, towards, count=14)
    with part(1, "along the segment, through its middle and beside it; straight across"):
        a, b = np.array([1.0, -1, 2]), np.array([3.0, 3, 6])
        along, across, third = np.array([1.0, 2, 2]), np.array([2.0, -2, 1]), np.array([2.0, 1, -2])
        for x, u in (
            (a - 3 * along, along),
            (b + 2 * along, -along),
            (a - 3 * along + 0.2 * across, along),
            (a - 3 * along + 0.5 * across, along),
            (b + 2 * along + 0.3 * third, -along),
            (a + along + 2 * third, -third),
            (a + along + 2 * third, third),
            (a - 0.2 * along + 2 * third, -third),
            (b + 0.5 * along + 2 * third, -third),
            (a + 0.8 * along + 1.6 * across, along - across),  # past the nearer end to the other one
            (a + 1.2 * along + 1.6 * across, -along - across),
        ):
            expect(submission.ray_capsule, (x, u, a, b, 1.0), reached(x, u, a, b, 1.0))
    with part(1, "which end comes first does not matter, and both may be one"):

        def same(x, u, a, b, radius):
            time, turned, ball = (
                float(numbers(submission.ray_capsule, (x, u, *ends, radius), finite=False))
                for ends in ((a, b), (b, a), (a, a))
            )
            assert time == turned or abs(time - turned) < 1e-3, "the time is another one if the ends are exchanged"
            assert time <= ball + 1e-3, "it meets the ball around an end before the capsule, of which this is a part"

        examples.every(towards, same)
    with part(1, "very long, very short, very thin and very fat"):
        x, u, a, b = np.array([0.5, -4, 0.25]), np.array([0.25, 2, 0]), np.array([-1.0, 0, 0]), np.array([1.0, 0, 0.5])
        for longer, radius in ((1000, 0.5), (1e-3, 1.0), (1, 1e-3), (1, 3.0), (100, 2.0)):
            given = (x, u, longer * a, longer * b, radius)
            expect(submission.ray_capsule, given, reached(*given))
    with part(1, "in millimetres and in kilometres, fast and slow"):
        for size, speed in itertools.product((1e-6, 1e-4, 1e3, 1e6), (1e-6, 1, 1e6)):
            given = tuple(size * each for each in (x, speed * u, a, b, 0.75))
            expect(submission.ray_capsule, given, reached(x, u, a, b, 0.75) / speed)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.ray_capsule, reached, towards)


def turned(point, spin, time):
    """By the matrix of the turn: 1 + sin θ K + (1 − cos θ) K²."""
    angle = length(spin) * time
    if angle == 0:
        return point
    x, y, z = spin / length(spin)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return point @ (np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k).T


def fastest(v, w, reach, n):
    """By Pythagoras: what is left of ω without its part along n."""
    return v @ n + reach * math.sqrt(max(w @ w - (w @ n) ** 2, 0))


@asks("motion_bound", 5, "No point of the body is ever faster along n, and one of them is so fast at some time.")
def test_the_bound_holds_at_all_times_and_is_reached(submission, part, examples):
    def motion(draw):
        return draw.vector(), draw.vector(4), draw.number(0.2, 3), draw.unit()

    with part(2, "any motion"):
        examples.agree(submission.motion_bound, fastest, motion, count=20)
    with part(1, "no point is faster at any time, and one is as fast"):

        def holds(v, w, reach, n, point):
            bound = numbers(submission.motion_bound, (v, w, reach, n))
            start = reach * point
            most = max(n @ (v + np.cross(w, turned(start, w, time))) for time in np.linspace(0, 3, 40))
            assert most <= bound + 1e-3, f"a point moves at {most:.4g} m/s along n"
            across = np.cross(n, w)
            fast = n @ (v + np.cross(w, reach * across / length(across)))
            assert fast >= bound - 1e-3, f"the fastest point moves at {fast:.4g} m/s only"

        examples.every(lambda draw: (*motion(draw), draw.unit()), holds)
    with part(1, "a point, no motion, turning about n alone, and very slow"):
        n = np.array([2, -3, 6]) / 7
        for v, w, reach in (
            ([-2e-7, 3e-7, 1e-7], [4e-7, 5e-7, 6e-7], 2.0),
            (REST, [4, 5, 6], 1e-7),
            (REST, [4e-7, 5e-7, 6e-7], 1e6),
            ([-2e6, 3e6, 1e6], [4e6, 5e6, 6e6], 2.0),
            ([1, 2, 3], [4, 5, 6], 0.0),
            (REST, REST, 2.0),
            (REST, 7 * n, 2.0),
            ([-2, 3, -6], 7 * n, 2.0),
        ):
            given = np.array(v, dtype=float), np.array(w, dtype=float), reach, n
            expect(submission.motion_bound, given, fastest(*given))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.motion_bound, fastest, motion)


PLATE = 60 * np.array([[-1.0, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]])


def heights(points, position, velocity, spin, plate, times):
    """How high the lowest corner is above a plate that is wide enough, at some times."""
    normal = np.cross(plate[2] - plate[0], plate[1] - plate[3])
    normal = normal / length(normal)
    normal = normal * np.sign(normal @ (position - plate[0]))
    corners = [position + velocity * time + turned(points, spin, time) for time in times]
    return normal, np.array([np.min((each - plate[0]) @ normal) for each in corners])


def onto_plate(points, position, velocity, spin, plate, dt, tolerance, looks):
    """Look by look, with the height of the lowest corner for the separation."""
    reach, time = max(map(length, points)), 0.0
    for used in range(1, looks + 1):
        normal, (height,) = heights(points, position, velocity, spin, plate, [time])
        if height <= tolerance:
            return time, used
        down = fastest(velocity, spin, reach, -normal)
        time = time + height / down if down > 0 else INFINITY
        if time > dt:
            return INFINITY, used
    return math.nan, looks


def fall(draw):
    """A body that turns and falls onto a plate, in time or not. It turns about any point."""
    turn, middle = draw.turn(), draw.vector(3)
    points = np.array([draw.vector(1) for _ in range(4)]) + draw.vector(0.5)
    reach = max(map(length, points))
    high, down = reach + draw.number(0.2, 2), draw.number(0.5, 2)
    position = turn @ np.array([draw.number(-1, 1), high, draw.number(-1, 1)])
    velocity = turn @ np.array([draw.number(-2, 2), -down, draw.number(-2, 2)])
    dt = draw.number(0.4, 1.2) * high / down
    return points @ turn.T, middle + position, velocity, draw.vector(0.8), middle + PLATE @ turn.T, dt, 0.02, 14


def past_point(points, position, velocity, spin, target, dt, tolerance, looks):
    """Look by look, with the distance of a point from a rod."""
    reach, time = max(map(length, points)), 0.0
    for used in range(1, looks + 1):
        a, b = position + velocity * time + turned(points, spin, time)
        apart = from_segment(target[0], a, b)
        if apart <= tolerance:
            return time, used
        along = b - a
        share = min(max((target[0] - a) @ along / (along @ along), 0), 1)
        near = fastest(velocity, spin, reach, (target[0] - a - share * along) / apart)
        time = time + apart / near if near > 0 else INFINITY
        if time > dt:
            return INFINITY, used
    return math.nan, looks


def swing(draw):
    """A rod that swings and flies towards a point or past it."""
    turn, middle = draw.turn(), draw.vector(3)
    rod = np.array([[-draw.number(0.5, 2), 0, 0], [draw.number(0.5, 2), draw.number(0, 0.5), 0]])
    position, velocity = (
        np.array([draw.number(-2, 2), 3, draw.number(-0.05, 0.05)]),
        np.array([draw.number(-0.5, 0.5), -1.5, 0]),
    )
    target = np.array([[draw.number(-1, 1), 0, draw.number(-0.05, 0.05)]])
    spin = turn @ np.array([draw.number(-0.05, 0.05), draw.number(-0.05, 0.05), draw.number(-2, 2)])
    return rod @ turn.T, middle + turn @ position, turn @ velocity, spin, middle + target @ turn.T, 4.0, 0.1, 14


@asks("advance", 7, "Every look comes before anything can have happened, and the last one finds the contact.")
def test_looks_come_in_time_and_are_no_more_than_needed(submission, part, examples):
    with part(2, "any body that falls onto a plate"):
        examples.agree(submission.advance, onto_plate, fall, count=6)
    with part(1, "any rod that swings past a point"):
        examples.agree(submission.advance, past_point, swing, count=6)
    with part(1, "never late: the bodies are apart until then, and at most the tolerance apart at that time"):

        def never_late(*given):
            *body, dt, tolerance, _ = given
            time = float(numbers(submission.advance, given, 2, finite=False)[0])
            if math.isnan(time):  # the looks are used up
                return
            before = heights(*body, np.linspace(0, min(time, dt), 200))[1]
            assert np.all(before > 0), "the plate has been reached before the time"
            if time < INFINITY:
                assert before[-1] <= tolerance + 1e-3, f"they are {before[-1]:.3g} m apart at the time"

        examples.every(fall, never_late, count=4)
    with part(1, "just enough looks, and one less"):
        rod, flies = np.array([[-1.0, 0, 0], [1, 0.1, 0], [0, 0.05, 0.02]]), np.array([0.2, -1.0, 0])
        falling = (rod, np.array([0, 1.5, 0]), flies, np.array([0, 0.5, 2.0]), PLATE, 4.0, 1e-3)
        time, used = onto_plate(*falling, 99)
        expect(submission.advance, (*falling, used + 1), (time, used))
        expect(submission.advance, (*falling, used), (time, used))
        expect(submission.advance, (*falling, used - 1), (math.nan, used - 1))
    with part(1, "two that overlap, two points, one that spins beside a plate; arrays left as they were"):
        across = np.array([[0.1, -1, 0], [0.1, 1, -0.1], [0.2, 1, 0.3]])
        expect(submission.advance, (rod, REST, [5, 0, 0], REST, across, 1.0, 1e-6, 3), (0, 1))
        expect(submission.advance, ([REST], [3, 0, 0], [-1, 0, 0], [1, 2, 3], [REST], 9.0, 0.1, 9), (3, 2))
        given = (rod, np.array([0, 2.0, 0]), np.zeros(3), np.array([0.0, 0, 3]), PLATE, 1.0, 1e-3, 50)
        expect(submission.advance, given, onto_plate(*given))
        refuse_changes(submission.advance)
    with part(1, "in micrometres and in kilometres, fast and slow"):
        for size, speed in ((1e-6, 1), (1e6, 1), (1, 1e-6), (1, 1e6)):
            aside = np.array([0.25, -0.5, 0.75])
            points, position, plate = (size * np.asarray(each) for each in (rod, falling[1] + aside, PLATE + aside))
            moves = size * speed * flies, speed * falling[3]
            given = (points, position, *moves, plate, 4.0 / speed, 1e-3 * size, 99)
            expect(submission.advance, given, (time / speed, used))
