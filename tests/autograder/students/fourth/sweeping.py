"""Of the fourth lot of wrong answers, those to the lab on swept volumes."""

from __future__ import annotations

import math

import numpy as np
from abbreviations import arr, col

from solutions.sweeping import rotated, separation_of_hulls


def _over(top, bottom, otherwise):
    """A quotient, and something else where the divisor is 0."""
    good = bottom != 0
    return np.where(good, top / np.where(good, bottom, 1.0), otherwise)


def ray_sphere_1(origin, direction, radius):
    """Takes the direction for a unit vector: t = −b − √(b² − c), without u·u."""
    o, u, r = arr(origin, direction, radius)
    b = np.vecdot(o, u)
    c = np.vecdot(o, o) - r**2
    root = b**2 - c
    t = -b - np.sqrt(np.maximum(root, 0.0))
    hit = (root >= 0) & (t >= 0) & (np.vecdot(u, u) > 0)
    return np.where(c <= 0, 0.0, np.where(hit, t, np.inf))


def ray_sphere_2(origin, direction, radius):
    """From within returns where the ray comes out: the first root that is not negative."""
    o, u = arr(origin, direction)
    a, b, c = u @ u, o @ u, o @ o - radius**2
    if a == 0:
        return 0.0 if c <= 0 else math.inf
    D = b * b - a * c
    if D < 0:
        return math.inf
    for t in ((-b - math.sqrt(D)) / a, (-b + math.sqrt(D)) / a):
        if t >= 0:
            return t
    return math.inf


def ray_sphere_3(origin, direction, radius):
    """Does not ask whether t is in the future: spheres behind the ray are hit at t < 0."""
    o, u, r = arr(origin, direction, radius)
    a, b = np.vecdot(u, u), np.vecdot(o, u)
    c = np.vecdot(o, o) - r * r
    D = b * b - a * c
    t = _over(-b - np.sqrt(np.maximum(D, 0)), a, np.inf)
    return np.where(c <= 0, 0.0, np.where(D >= 0, t, np.inf))


def ray_sphere_4(origin, direction, radius):
    """Normalises the direction and returns metres instead of t."""
    o, u, r = arr(origin, direction, radius)
    length = np.linalg.norm(u, axis=-1)
    u = u / np.where(length > 0, length, 1.0)[..., None]
    b, c = np.vecdot(o, u), np.vecdot(o, o) - r**2
    D = b**2 - c
    hit = (length > 0) & (D >= 0) & (b < 0)
    t = np.where(hit, -b - np.sqrt(np.maximum(D, 0)), np.inf)
    return np.where(c <= 0, 0.0, t)


def ray_sphere_5(origin, direction, radius):
    """Returns when the ray is nearest to the centre, not when it meets the sphere."""
    o, u, r = arr(origin, direction, radius)
    a, b = np.vecdot(u, u), np.vecdot(o, u)
    t = np.maximum(_over(-b, a, 0.0), 0.0)
    near = o + t[..., None] * u
    t = np.where(np.vecdot(near, near) <= r * r, t, np.inf)
    return np.where(np.vecdot(o, o) <= r * r, 0.0, t)


def ray_sphere_6(origin, direction, radius):
    """Early return: a ray that moves away from the centre misses, also from within."""
    o, u = arr(origin, direction)
    b = o @ u
    if b >= 0:
        return math.inf
    a, c = u @ u, o @ o - radius**2
    if c <= 0:
        return 0.0
    D = b * b - a * c
    return math.inf if D < 0 else (-b - math.sqrt(D)) / a


def _first_touch(o, u, r):
    """ray_sphere, as it should be."""
    a, b = np.vecdot(u, u), np.vecdot(o, u)
    c = np.vecdot(o, o) - r * r
    D = b * b - a * c
    hit = (b < 0) & (D >= 0)
    root = np.sqrt(np.maximum(D, 0))
    t = np.where(hit, c / np.where(hit, root - b, 1.0), np.inf)
    return np.where(c <= 0, 0.0, t)


def sweep_sphere_sphere_1(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt):
    """Place of A from B, but velocity of B from A: approach and parting are swapped."""
    pa, va, ra, pb, vb, rb, h = arr(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt)
    t = _first_touch(pa - pb, vb - va, ra + rb)
    return np.where(t <= h, t, np.inf)


def sweep_sphere_sphere_2(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt):
    """Forgets the end of the step: reports a touch that comes later than dt."""
    pa, va, ra, pb, vb, rb = arr(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b)
    return _first_touch(pa - pb, va - vb, ra + rb) + 0 * np.where(np.isinf(dt), 0.0, dt)


def sweep_sphere_sphere_3(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt):
    """Balls that overlap and part do not collide: infinity instead of 0."""
    d = [x - y for x, y in zip(position_a, position_b, strict=True)]
    u = [x - y for x, y in zip(velocity_a, velocity_b, strict=True)]
    r = radius_a + radius_b
    b = sum(x * y for x, y in zip(d, u, strict=True))
    if b >= 0:
        return math.inf
    a = sum(x * x for x in u)
    c = sum(x * x for x in d) - r * r
    if c <= 0:
        return 0.0
    D = b * b - a * c
    if D < 0:
        return math.inf
    t = (-b - math.sqrt(D)) / a
    return t if t <= dt else math.inf


def sweep_sphere_sphere_4(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt):
    """Looks only at balls that overlap at the end of the step; those passed through are missed."""
    pa, va, ra, pb, vb, rb, h = arr(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt)
    d, u, r = pa - pb, va - vb, ra + rb
    t = _first_touch(d, u, r)
    long = np.where(np.isfinite(h), h, 0.0)
    end = d + u * long[..., None]
    ends_in = (np.linalg.norm(end, axis=-1) <= r) | ~np.isfinite(h)
    return np.where((t == 0) | ((t <= h) & ends_in), t, np.inf)


def sweep_sphere_sphere_5(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt):
    """Squares the radii one by one: r_A² + r_B² instead of (r_A + r_B)²."""
    pa, va, ra, pb, vb, rb, h = arr(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt)
    t = _first_touch(pa - pb, va - vb, np.sqrt(ra**2 + rb**2))
    return np.where(t <= h, t, np.inf)


def sweep_sphere_sphere_6(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt):
    """Lets A fly against a B that rests: B's velocity is not used."""
    pa, va, ra, pb, vb, rb, h = arr(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt)
    t = _first_touch(pa - pb, va + 0 * vb, ra + rb)
    return np.where(t <= h, t, np.inf)


def missed_share_1(speed, radius_a, radius_b, dt):
    """All collisions are head-on: 1 − 2 (r_A + r_B)/(v dt), or 0."""
    v, ra, rb, h = arr(speed, radius_a, radius_b, dt)
    way = v * h
    return np.maximum(1 - 2 * (ra + rb) / np.where(way > 0, way, 1.0), 0) * (way > 0)


def missed_share_2(speed, radius_a, radius_b, dt):
    """A step shorter than the diameter misses nothing: leaves grazing balls out."""
    way = speed * dt
    diameter = 2 * (radius_a + radius_b)
    if way <= diameter:
        return 0.0
    return 1 - 2 / 3 * diameter / way


def missed_share_3(speed, radius_a, radius_b, dt):
    """Offsets as in the plane: every distance from the middle is equally frequent."""
    v, ra, rb, h = arr(speed, radius_a, radius_b, dt)
    way = v * h
    k = 2 * (ra + rb) / np.where(way > 0, way, 1.0)
    x = np.sqrt(np.maximum(1 - 1 / np.maximum(k, 1.0) ** 2, 0.0))
    area = (np.arccos(x) - x * np.sqrt(1 - x * x)) / 2
    return np.where(way > 0, (1 - x) - k * area, 0.0)


def missed_share_4(speed, radius_a, radius_b, dt):
    """Takes the mean chord for every chord: 1 − 4 R/(3 v dt), or 0 if that is negative."""
    v, ra, rb, h = arr(speed, radius_a, radius_b, dt)
    way = v * h
    mean = 4 / 3 * (ra + rb)
    share = 1 - mean / np.where(way > 0, way, 1.0)
    return np.where(way > 0, np.clip(share, 0.0, 1.0), 0.0)


def _missed(k):
    return np.where(k <= 1, 1 - 2 * k / 3, 1 / (3 * np.maximum(k, 1.0) ** 2))


def missed_share_5(speed, radius_a, radius_b, dt):
    """Takes the sum of the radii for the way through the middle, not twice of it."""
    v, ra, rb, h = arr(speed, radius_a, radius_b, dt)
    way = v * h
    k = (ra + rb) / np.where(way > 0, way, 1.0)
    return np.where(way > 0, _missed(k), 0.0)


def missed_share_6(speed, radius_a, radius_b, dt):
    """Returns the share that is noticed."""
    v, ra, rb, h = arr(speed, radius_a, radius_b, dt)
    way = v * h
    k = 2 * (ra + rb) / np.where(way > 0, way, 1.0)
    return np.where(way > 0, 1 - _missed(k), 1.0)


def _slabs(o, u, h):
    """When each slab is entered and left, and which axes the ray does not move along."""
    still = u == 0
    safe = np.where(still, 1.0, u)
    one, other = (-h - o) / safe, (h - o) / safe
    first, last = np.minimum(one, other), np.maximum(one, other)
    within = np.abs(o) <= h
    first = np.where(still, np.where(within, -np.inf, np.inf), first)
    last = np.where(still, np.where(within, np.inf, -np.inf), last)
    return first, last


def ray_box_1(origin, direction, half_extents):
    """Leaves an axis out along which the ray does not move, without asking where it is."""
    o, u, h = (list(map(float, x)) for x in (origin, direction, half_extents))
    entry, leave = 0.0, math.inf
    for i in range(3):
        if u[i] == 0:
            continue
        one, other = (-h[i] - o[i]) / u[i], (h[i] - o[i]) / u[i]
        entry = max(entry, min(one, other))
        leave = min(leave, max(one, other))
    if entry > leave:
        return math.inf, -math.inf
    return entry, leave


def ray_box_2(origin, direction, half_extents):
    """Enters by −h and leaves by +h, whichever way the ray goes."""
    o, u, h = np.broadcast_arrays(*arr(origin, direction, half_extents))
    still = u == 0
    safe = np.where(still, 1.0, u)
    within = np.abs(o) <= h
    first = np.where(still, np.where(within, -np.inf, np.inf), (-h - o) / safe)
    last = np.where(still, np.where(within, np.inf, -np.inf), (h - o) / safe)
    entry, leave = np.maximum(first.max(axis=-1), 0.0), last.min(axis=-1)
    miss = entry > leave
    return np.where(miss, np.inf, entry), np.where(miss, -np.inf, leave)


def ray_box_3(origin, direction, half_extents):
    """Lets the ray run backwards: entry may be negative, and boxes behind it are hit."""
    o, u, h = np.broadcast_arrays(*arr(origin, direction, half_extents))
    first, last = _slabs(o, u, h)
    entry, leave = first.max(axis=-1), last.min(axis=-1)
    miss = entry > leave
    return np.where(miss, np.inf, entry), np.where(miss, -np.inf, leave)


def ray_box_4(origin, direction, half_extents):
    """Min and max swapped: in the box as long as the ray is in any one slab."""
    o, u, h = np.broadcast_arrays(*arr(origin, direction, half_extents))
    first, last = _slabs(o, u, h)
    entry = np.maximum(first.min(axis=-1), 0.0)
    leave = last.max(axis=-1)
    miss = entry > leave
    return np.where(miss, np.inf, entry), np.where(miss, -np.inf, leave)


def ray_box_5(origin, direction, half_extents):
    """Takes the half extents for whole edges and halves them again."""
    o, u, h = np.broadcast_arrays(*arr(origin, direction, half_extents))
    first, last = _slabs(o, u, h / 2)
    entry, leave = np.maximum(first.max(axis=-1), 0.0), last.min(axis=-1)
    miss = entry > leave
    return np.where(miss, np.inf, entry), np.where(miss, -np.inf, leave)


def ray_box_6(origin, direction, half_extents):
    """The box is open: grazing, gliding along a face and a box of thickness 0 are misses."""
    o, u, h = np.broadcast_arrays(*arr(origin, direction, half_extents))
    first, last = _slabs(o, u, h)
    outside = np.any((u == 0) & (np.abs(o) >= h), axis=-1)
    entry, leave = np.maximum(first.max(axis=-1), 0.0), last.min(axis=-1)
    miss = outside | (entry >= leave)
    return np.where(miss, np.inf, entry), np.where(miss, -np.inf, leave)


def _to_segment(x, a, b):
    """Distance of a place from a segment."""
    s = b - a
    length = np.vecdot(s, s)
    share = np.clip(_over(np.vecdot(x - a, s), length, 0.0), 0, 1)
    return np.linalg.norm(x - a - share[..., None] * s, axis=-1)


def _cylinder(o, u, a, b, r):
    """Both times at which the ray is on the endless cylinder around a b, or NaN."""
    s = b - a
    length = np.vecdot(s, s)
    across_u = u - _over(np.vecdot(u, s), length, 0.0)[..., None] * s
    d = o - a
    across_d = d - _over(np.vecdot(d, s), length, 0.0)[..., None] * s
    A = np.vecdot(across_u, across_u)
    B = np.vecdot(across_u, across_d)
    C = np.vecdot(across_d, across_d) - r * r
    D = B * B - A * C
    good = (1e-24 * np.vecdot(u, u) < A) & (D >= 0) & (length > 0)
    root = np.sqrt(np.where(good, D, 0.0))
    first = np.where(good, _over(-B - root, A, np.nan), np.nan)
    last = np.where(good, _over(-B + root, A, np.nan), np.nan)
    return first, last


def _side_hit(o, u, a, b, r):
    """First t ≥ 0 on the side of the cylinder between its ends."""
    t, _ = _cylinder(o, u, a, b, r)
    s = b - a
    x = o + np.where(np.isfinite(t), t, 0.0)[..., None] * u
    along = _over(np.vecdot(x - a, s), np.vecdot(s, s), -1.0)
    return np.where(np.isfinite(t) & (t >= 0) & (along >= 0) & (along <= 1), t, np.inf)


def ray_capsule_1(origin, direction, start, end, radius):
    """A cylinder without the half balls: what comes in beyond the ends misses."""
    o, u, a, b, r = arr(origin, direction, start, end, radius)
    side = _side_hit(o, u, a, b, r)
    return np.where(_to_segment(o, a, b) <= r, 0.0, side)


def ray_capsule_2(origin, direction, start, end, radius):
    """Takes the segment for an endless line: the cylinder does not end."""
    o, u, a, b, r = arr(origin, direction, start, end, radius)
    s = b - a
    length = np.vecdot(s, s)
    d = o - a
    across = d - _over(np.vecdot(d, s), length, 0.0)[..., None] * s
    t, _ = _cylinder(o, u, a, b, r)
    t = np.where(np.isfinite(t) & (t >= 0), t, np.inf)
    t = np.where(length > 0, t, _first_touch(d, u, r))
    return np.where(np.linalg.norm(across, axis=-1) <= r, 0.0, t)


def ray_capsule_3(origin, direction, start, end, radius):
    """Tests the two balls at the ends and forgets the cylinder between them."""
    o, u, a, b, r = arr(origin, direction, start, end, radius)
    return np.minimum(_first_touch(o - a, u, r), _first_touch(o - b, u, r))


def ray_capsule_4(origin, direction, start, end, radius):
    """Early return for a ray along the segment: a cylinder's side is never met by it."""
    o, u, a, b, r = arr(origin, direction, start, end, radius)
    if _to_segment(o, a, b) <= r:
        return 0.0
    s = b - a
    if np.any(s) and np.linalg.norm(np.cross(u, s)) <= 1e-12 * np.linalg.norm(u) * np.linalg.norm(s):
        return math.inf
    return min(float(_side_hit(o, u, a, b, r)), float(_first_touch(o - a, u, r)), float(_first_touch(o - b, u, r)))


def ray_capsule_5(origin, direction, start, end, radius):
    """From within returns where the ray leaves the cylinder or a ball."""
    o, u, a, b, r = arr(origin, direction, start, end, radius)
    hit = np.minimum(_side_hit(o, u, a, b, r), np.minimum(_first_touch(o - a, u, r), _first_touch(o - b, u, r)))
    _, leaves = _cylinder(o, u, a, b, r)
    within = _to_segment(o, a, b) <= r
    for centre in (a, b):
        d = o - centre
        A, B = np.vecdot(u, u), np.vecdot(d, u)
        D = np.maximum(B * B - A * (np.vecdot(d, d) - r * r), 0.0)
        ball = _over(-B + np.sqrt(D), A, 0.0)
        leaves = np.where(np.isfinite(leaves), leaves, ball)
    return np.where(within, np.maximum(leaves, 0.0), hit)


def ray_capsule_6(origin, direction, start, end, radius):
    """Prolongs the segment by r at both ends and takes the flat cylinder for the capsule."""
    o, u, a, b, r = np.broadcast_arrays(*arr(origin, direction, start, end), col(radius))
    r = r[..., 0]
    s = b - a
    length = np.linalg.norm(s, axis=-1)
    axis = np.where((length > 0)[..., None], s / np.where(length > 0, length, 1.0)[..., None], [0.0, 0.0, 1.0])
    a, b = a - r[..., None] * axis, b + r[..., None] * axis
    half = np.vecdot(b - a, axis) / 2
    d = o - (a + b) / 2
    z, w = np.vecdot(d, axis), np.vecdot(u, axis)
    across, sideways = d - z[..., None] * axis, u - w[..., None] * axis
    A, B = np.vecdot(sideways, sideways), np.vecdot(across, sideways)
    C = np.vecdot(across, across) - r * r
    D = B * B - A * C
    root = np.sqrt(np.maximum(D, 0))
    steep = A > 0
    first = np.where(steep, _over(-B - root, A, 0.0), np.where(C <= 0, -np.inf, np.inf))
    last = np.where(steep, _over(-B + root, A, 0.0), np.where(C <= 0, np.inf, -np.inf))
    bad = steep & (D < 0)
    moving = w != 0
    one, other = _over(-half - z, w, -np.inf), _over(half - z, w, np.inf)
    low = np.where(moving, np.minimum(one, other), np.where(np.abs(z) <= half, -np.inf, np.inf))
    high = np.where(moving, np.maximum(one, other), np.where(np.abs(z) <= half, np.inf, -np.inf))
    enter = np.maximum(np.maximum(first, low), 0.0)
    return np.where(bad | (enter > np.minimum(last, high)), np.inf, enter)


def motion_bound_1(velocity, angular_velocity, reach, normal):
    """Takes |v·n|: a bound is never negative, so moving away counts like approaching."""
    v, w, r, n = arr(velocity, angular_velocity, reach, normal)
    return np.abs(np.vecdot(v, n)) + np.linalg.norm(np.cross(w, n), axis=-1) * r


def motion_bound_2(velocity, angular_velocity, reach, normal):
    """All of the spin counts, |ω| r, also the part that turns about n itself."""
    v, w, r, n = arr(velocity, angular_velocity, reach, normal)
    return np.vecdot(v, n) + np.linalg.norm(w, axis=-1) * r


def motion_bound_3(velocity, angular_velocity, reach, normal):
    """The wrong one of two products: |ω·n| r, the part of the spin that does not count."""
    v, w, r, n = arr(velocity, angular_velocity, reach, normal)
    return np.vecdot(v, n) + np.abs(np.vecdot(w, n)) * r


def motion_bound_4(velocity, angular_velocity, reach, normal):
    """Takes the whole speed of the centre, |v|, instead of its component along n."""
    speed = math.sqrt(sum(x * x for x in velocity))
    turning = np.cross(angular_velocity, normal)
    return speed + reach * math.sqrt(sum(x * x for x in turning))


def motion_bound_5(velocity, angular_velocity, reach, normal):
    """Looks at the farthest point along n, v + ω × (r n): it does not move along n at all."""
    v, w, r, n = arr(velocity, angular_velocity, reach, normal)
    point = v + np.cross(w, r[..., None] * n)
    return np.vecdot(point, n)


def motion_bound_6(velocity, angular_velocity, reach, normal):
    """Forgets the arm: adds |ω × n| without the reach."""
    v, w, r, n = arr(velocity, angular_velocity, reach, normal)
    return np.vecdot(v, n) + np.linalg.norm(np.cross(w, n), axis=-1) + 0 * r


def _looks(given, place=None, speed=None, undecided=math.nan):
    """Conservative advancement, with what may be wrong about it."""
    points, x, v, w, target = arr(*given[:5])
    dt, tolerance, looks = given[5:]
    reach = np.linalg.norm(points, axis=1).max()
    t, first = 0.0, None
    for look in range(1, looks + 1):
        corners = place(points, x, v, w, t) if place else rotated(points, w * t) + x + v * t
        gap, n = separation_of_hulls(corners, target)
        if gap <= tolerance:
            return t, look
        first = n if first is None else first
        way = -first if speed == "first" else -n
        closing = v @ way if speed == "centre" else v @ way + np.linalg.norm(np.cross(w, way)) * reach
        if closing <= 0:
            return math.inf, look
        t += gap / closing
        if t > dt:
            return math.inf, look
    return undecided, looks


def advance_1(*given):
    """The bound is the speed of the centre alone: a corner that turns arrives unnoticed."""
    return _looks(given, speed="centre")


def advance_2(*given):
    """Moves the hull without turning it; only the bound knows of ω."""
    return _looks(given, place=lambda points, x, v, w, t: points + x + v * t)


def advance_3(*given):
    """Bounds the speed once, along the first normal, and uses it for all looks."""
    return _looks(given, speed="first")


def advance_4(*given):
    """No contact found within the looks counts as no contact: infinity instead of NaN."""
    return _looks(given, undecided=math.inf)


def advance_5(*given):
    """Turns the hull about the origin of the world and not about its own point."""
    return _looks(given, place=lambda points, x, v, w, t: rotated(points + x, w * t) + v * t)


def advance_6(*given):
    """Turns by p + ω × p t: the corners fly off along tangents."""
    return _looks(given, place=lambda points, x, v, w, t: points + np.cross(w, points) * t + x + v * t)
