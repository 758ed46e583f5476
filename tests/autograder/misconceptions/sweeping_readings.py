"""Loose readings of the slide about swept volumes: volumes for motions, only the ends of a step, parting for a miss."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import formulas_of
from solutions.sweeping import rotated, separation_of_hulls

SWEEPING, BOXES, TURNING = map(formulas_of, ("sweeping", "sweeping_boxes", "sweeping_turning"))


def against_the_volume(xa, va, ra, xb, vb, rb, dt):
    """A against all that B sweeps in the whole step."""
    far = np.where(np.isfinite(dt), dt, 1e6)
    end = np.asarray(xb) + np.asarray(vb) * far[..., None]
    time = BOXES.capsule()(np.asarray(xa, dtype=float), va + 0 * np.asarray(vb), xb, end, np.asarray(ra) + rb)
    return SWEEPING.late(time, np.asarray(dt, dtype=float))


def grown_at_the_ends(points, position, v, w, target, dt, tolerance, looks):
    """The start and the end of the step, and nothing between."""
    points, position, v, w = (np.asarray(each, dtype=float) for each in (points, position, v, w))
    for used, t in enumerate((0.0, dt)[:looks], start=1):
        if separation_of_hulls(TURNING.placed(points, position, v, w, t), np.asarray(target))[0] <= tolerance:
            return t, used
    return np.inf, min(2, looks)


def only_approaching(x, u, r):
    """Nothing is asked of a ray that moves away from the middle."""
    return np.where(SWEEPING.inner(x, u) < 0, SWEEPING.right(x, u, r), np.inf)


def touching_at_the_end(xa, va, ra, xb, vb, rb, dt):
    """The time of the touch, if the balls overlap now or at the end of the step."""
    x, u, r = np.asarray(xa) - xb, np.asarray(va) - vb, np.asarray(ra) + rb
    time, far = SWEEPING.right(x + 0 * u, u + 0 * x, r), np.asarray(dt, dtype=float)
    end = SWEEPING.length(x + u * np.where(np.isfinite(far), far, 0.0)[..., None])
    seen = (end <= r) | np.isinf(far) | (time == 0)
    return np.where(seen, SWEEPING.late(time, far), np.inf)


def open_crossings(x, u, h):
    """On a face is not between the faces."""
    low, high = BOXES.crossings(x, u, h)
    on = np.broadcast_to((np.asarray(u) == 0) & (np.abs(x) >= h), low.shape)
    return np.where(on, np.inf, low), np.where(on, -np.inf, high)


def starts_within(x, a, b, r):
    return BOXES.capsule()(x, 0 * np.asarray(x), a, b, r) == 0


def within_or_side(x, u, a, b, r):
    """Now from within, or at the side; nothing around the ends."""
    long = BOXES.length(np.asarray(b) - a) > 0
    side = BOXES.capsule(first=False, second=False)(x, u, a, b, r)
    return np.where(starts_within(x, a, b, r), 0.0, np.where(long, side, np.inf))


def not_along_it(x, u, a, b, r):
    """A ray along the segment meets nothing unless it starts within."""
    e, whole, _, _, _, across = BOXES.split(x, u, a, b)
    along = (BOXES.length(across) <= 1e-12 * BOXES.length(np.asarray(u) + 0 * e)) & (whole > 0)
    return np.where(along & ~starts_within(x, a, b, r), np.inf, BOXES.capsule()(x, u, a, b, r))


def longer_cylinder(x, u, a, b, r):
    """Flat ends, each of them farther out by the radius."""
    e = BOXES.direction(np.asarray(b) - a)
    e = np.where(BOXES.length(e)[..., None] > 0, e, [0.0, 0.0, 1.0]) * np.asarray(r)[..., None]
    return BOXES.flat_ends(x, u, a - e, b + e, r)


# fmt: off
BANK = (
    M("ray_sphere", "moving away is a miss", only_approaching,
      "A ray that moves away from the middle is said to miss, also where it starts in the sphere.",
      "Start in the sphere and fly out of it. Is the ray inside at t = 0?"),
    M("sweep_sphere_sphere", "parting is no touch", SWEEPING.swept(only_approaching),
      "Balls that move apart are said not to touch, also where they overlap now.",
      "What does the description say of balls that overlap and part?"),
    M("sweep_sphere_sphere", "overlap at the end alone", touching_at_the_end,
      "The time of the touch counts only if the balls overlap at the end of the step. A fast ball has passed through"
      " the other one by then.",
      "Let the step be so long that A flies from one side of B to the other. What should your function say?"),
    M("missed_share", "short ways miss nothing", TURNING.share(lambda d, r: np.where(
        d <= 2 * r, 0.0, TURNING.long(d, r))),
      "A way shorter than the longest chord is said to miss nothing. Balls that hardly graze each other overlap along a"
      " much shorter chord.",
      "How long is the chord of two balls that hardly graze each other? Does a look always fall on it?"),
    M("ray_box", "open box", BOXES.box(open_crossings, meets=lambda entry, leaving: entry < leaving),
      "The faces do not belong to the box: a ray that grazes it, glides along a face or crosses a flat box is said to"
      " miss.",
      "What does the description say of a ray that glides along a face?"),
    M("ray_capsule", "ends left out, except from within", within_or_side,
      "A ray from outside is tested against the side alone. Around each end there is half a ball as well.",
      "Fly along the segment, straight at one of its ends. What do you meet?"),
    M("ray_capsule", "along it is a miss", not_along_it,
      "A ray along the segment is said to miss, because it never meets the side. It may meet an end.",
      "Fly along the segment, straight at one of its ends. What do you meet?"),
    M("ray_capsule", "flat ends, longer by the radius", longer_cylinder,
      "The capsule is taken for a cylinder that is longer by r at both ends. Its edges stick out beyond the"
      " half balls.",
      "How far is the rim of your cylinder from the end of the segment?"),
    M("advance", "places turned about the origin", TURNING.loop(
        place=lambda points, position, v, w, t: rotated(points + position, w * t) + v * t),
      "The corners are put at their places first and turned then, about the origin of the world.",
      "About which point does A turn?"),
    M("advance", "along tangents", TURNING.loop(
        place=lambda points, position, v, w, t: points + np.cross(w, points) * t + position + v * t),
      "The corners move on along their tangents, with the velocity that turning gives them at the start. So the body"
      " grows as it turns.",
      "How far is a corner from the point about which A turns, now and after a quarter of a turn?"),
    M("sweep_sphere_sphere", "against B's swept volume", against_the_volume,
      "A is tested against all that B sweeps in the whole step, as if B were everywhere on its way at once. Slide 10"
      " says to compute the motion of one object relative to the other first.",
      "B crosses a street a second before A comes along it. Do they collide?"),
    M("missed_share", "the slab of slide 9", TURNING.share(TURNING.head_on),
      "Every collision is taken for one through the middle, as if B were a slab that is 2R thick. Most balls cross the"
      " other one along a chord that is shorter.",
      "How long is the chord of two balls that hardly graze each other?"),
    M("advance", "only the ends of the step", grown_at_the_ends,
      "It looks at the start and at the end of the step. A rod may be clear of B at both times and hit it in between.",
      "A rod turns half round in a step. What do you see at its end?"),
)
# fmt: on
