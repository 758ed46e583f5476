"""Known mistakes about the side of a line, and about a segment and a triangle."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import over


def area(u, v):
    return u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]


def side(number):
    """The sign of a number made of three points."""
    return lambda a, b, c: np.sign(number(*np.broadcast_arrays(a, b, c)) + 0.0)


def above(a, b, c):
    """How far c is above the line, wherever that leads."""
    way = b - a
    return np.where(way[..., 0] < 0, -1, 1) * area(way, c - a)


def left_or_on(a, b, c):
    return np.where(area(np.subtract(b, a), np.subtract(c, a)) >= 0, 1, -1)


def rounded_off(a, b, c):
    found = area(np.subtract(b, a), np.subtract(c, a))
    return np.where(np.abs(found) < 1e-6, 0, np.sign(found))


def strictly_left(a, b, c):
    return np.where(area(np.subtract(b, a), np.subtract(c, a)) > 0, 1, -1)


# A segment and a triangle


def solved(start, end, triangle):
    """T and the weights where the line of the segment meets the plane."""
    p, q, corners = (np.asarray(each, dtype=float) for each in (start, end, triangle))
    a, b, c = (corners[..., k, :] for k in range(3))
    n = np.cross(b - a, c - a)
    t = over(np.sum(n * (a - p), axis=-1), np.sum(n * (q - p), axis=-1), np.nan)
    x = p + t[..., None] * (q - p)
    below = np.sum(n * n, axis=-1)
    w_b = np.sum(n * np.cross(x - a, c - a), axis=-1) / below
    w_c = np.sum(n * np.cross(b - a, x - a), axis=-1) / below
    return t, np.stack([1 - w_b - w_c, w_b, w_c], axis=-1)


def on_segment(t, w):
    return (t >= 0) & (t <= 1)


def on_triangle(t, w):
    return np.all(w >= 0, axis=-1)


def meeting(hits, change=lambda t, w, p, q: (t, w), nothing=(np.inf, np.nan)):
    """Where the two meet, if the hit passes; otherwise nothing."""

    def found(start, end, triangle):
        t, w = solved(start, end, triangle)
        hit = hits(t, w)
        t, w = change(t, w, np.asarray(start), np.asarray(end))
        return np.where(hit, t, nothing[0]), np.where(hit[..., None], w, nothing[1])

    return found


def both(t, w):
    return on_segment(t, w) & on_triangle(t, w)


def from_the_front(start, end, triangle):
    corners = np.asarray(triangle, dtype=float)
    a, b, c = (corners[..., k, :] for k in range(3))
    t, w = solved(start, end, triangle)
    down = np.sum(np.cross(b - a, c - a) * np.subtract(end, start), axis=-1) < 0
    hit = both(t, w) & down
    return np.where(hit, t, np.inf), np.where(hit[..., None], w, np.nan)


def nearly_parallel(limit):
    """A fixed limit for the determinant, whatever the size."""

    def found(start, end, triangle):
        corners = np.asarray(triangle, dtype=float)
        a, b, c = (corners[..., k, :] for k in range(3))
        t, w = solved(start, end, triangle)
        hit = both(t, w) & (np.abs(np.sum(np.cross(b - a, c - a) * np.subtract(end, start), axis=-1)) > limit)
        return np.where(hit, t, np.inf), np.where(hit[..., None], w, np.nan)

    return found


def unsigned(t, w, p, q):
    return t, np.abs(w) / np.sum(np.abs(w), axis=-1, keepdims=True)


def two_limits(t, w):
    """0 ≤ v ≤ 1 and 0 ≤ w ≤ 1: a parallelogram."""
    return on_segment(t, w) & np.all((w[..., 1:] >= 0) & (w[..., 1:] <= 1), axis=-1)


def within_box(start, end, triangle):
    """In the box around the triangle."""
    t, w = solved(start, end, triangle)
    corners = np.asarray(triangle, dtype=float)
    x = np.asarray(start) + t[..., None] * np.subtract(end, start)
    low, high = corners.min(axis=-2) - 1e-9, corners.max(axis=-2) + 1e-9
    hit = on_segment(t, w) & np.all((x >= low) & (x <= high), axis=-1)
    return np.where(hit, t, np.inf), np.where(hit[..., None], w, np.nan)


# fmt: off
BANK = (
    M("side_of_line", "right for left", side(lambda a, b, c: area(c - a, b - a)),
      "Left and right are exchanged: the two vectors are multiplied in the wrong order.",
      "Stand at the origin and look along x. On which side is y, and what is (1, 0)×(0, 1)?"),
    M("side_of_line", "scalar product", side(lambda a, b, c: np.sum((b - a) * (c - a), axis=-1)),
      "The sign is that of the scalar product: it says whether c is ahead or behind, not on which side it is.",
      "What is the scalar product of (1, 0) with (0, 1), and with (0, −1)?"),
    M("side_of_line", "above for left", side(above),
      "It says whether c is above the line. Left is above only if the line runs to the right.",
      "Look from (1, 0) towards (0, 0). Is (0.5, 1) on your left?"),
    M("side_of_line", "c from the origin", side(lambda a, b, c: area(b - a, c)),
      "The way to c begins at the origin, not at a: the line is moved to the origin.",
      "Move all three points by (10, 10). Does the side of c change?"),
    M("side_of_line", "a left out", side(lambda a, b, c: area(b, c)),
      "The product is that of b and c alone: the side of the line from the origin to b.",
      "Which argument makes no difference to your answer?"),
    M("side_of_line", "product added", side(lambda a, b, c: (b - a)[..., 0] * (c - a)[..., 1]
                                            + (b - a)[..., 1] * (c - a)[..., 0]),
      "The two products are added. A determinant is the difference of them.",
      "A point c on the line has (c − a) = s (b − a). What is your number then?"),
    M("side_of_line", "area for its sign", lambda a, b, c: area(np.subtract(b, a), np.subtract(c, a)),
      "It gives twice the area of the triangle, not its sign.",
      "Which three numbers may be returned?"),
    M("side_of_line", "on the line is left", left_or_on,
      "A point on the line counts as on the left: there are three answers, not two.",
      "What should be returned for c = a?"),
    M("side_of_line", "on the line is right", strictly_left,
      "A point on the line counts as on the right: there are three answers, not two.",
      "What should be returned for c = a?"),
    M("side_of_line", "left or not", lambda a, b, c: np.maximum(strictly_left(a, b, c), 0),
      "It says 1 or 0, left or not. Right is −1, and 0 is kept for points on the line.",
      "How can a caller tell right from on the line?"),
    M("side_of_line", "tolerance", rounded_off,
      "It says 0 where the number is small. The number is an area, and for a triangle of 0.1 mm it is always small. The"
      " function has no tolerance.",
      "How large is the number for a triangle with sides of a tenth of a millimetre, in square metres?"),
    M("segment_triangle", "hit of the plane", meeting(on_segment),
      "Crossing the plane counts as hitting the triangle. The plane goes on for ever, and the triangle does not.",
      "Which signs have the three weights of a point beside the triangle?"),
    M("segment_triangle", "line for segment", meeting(on_triangle),
      "The line through both ends is taken, which goes on for ever: hits behind the start and beyond the end count.",
      "At which fractions of the segment are its ends?"),
    M("segment_triangle", "behind the start", meeting(lambda t, w: on_triangle(t, w) & (t <= 1)),
      "Hits behind the start count. The triangle is behind the segment, at a negative fraction.",
      "Where on the line is t = −1?"),
    M("segment_triangle", "beyond the end", meeting(lambda t, w: on_triangle(t, w) & (t >= 0)),
      "Hits beyond the end count, as for a ray. A segment ends.",
      "Where on the line is t = 2?"),
    M("segment_triangle", "from the front alone", from_the_front,
      "Only segments that come from the front of the triangle hit it. Here it is met from both sides.",
      "Exchange start and end. Does the segment still meet the triangle?"),
    M("segment_triangle", "fraction from the end", meeting(both, lambda t, w, p, q: (1 - t, w)),
      "The fraction is counted from the end.",
      "A segment starts just above the triangle and ends far below. Is t near 0 or near 1?"),
    M("segment_triangle", "length for fraction",
      meeting(both, lambda t, w, p, q: (t * np.linalg.norm(q - p, axis=-1), w)),
      "It gives the way from the start in metres, not as a fraction of the segment.",
      "What is t at the end of a segment of 5 m?"),
    M("segment_triangle", "weights in another order", meeting(both, lambda t, w, p, q: (t, np.roll(w, -1, axis=-1))),
      "The weights are in another order than the corners. The weight of the first corner comes first: it is what the"
      " other two leave of 1.",
      "Multiply each weight with its corner and add. Is that the point on the segment?"),
    M("segment_triangle", "parallelogram", meeting(two_limits),
      "Both weights from 0 to 1 is a parallelogram. The third weight must not be negative either.",
      "Draw the point with the weights 0.8 and 0.8 of the second and the third corner."),
    M("segment_triangle", "unsigned areas", meeting(on_segment, unsigned),
      "The areas have lost their signs, and divided by their sum they are weights of some point of the triangle for"
      " every point of the plane.",
      "A point is beyond a side. Which of its three triangles is turned over?"),
    M("segment_triangle", "lengths of areas", meeting(on_segment, lambda t, w, p, q: (t, np.abs(w))),
      "The areas are lengths of cross products, and a length is never negative. So no weight is, and every place in the"
      " plane seems to be on the triangle.",
      "Go once round each small triangle, and once round the large one. Which of them turns the other way for a place"
      " beyond a side?"),
    M("segment_triangle", "box around the triangle", within_box,
      "A place in the box around the triangle counts as on the triangle.",
      "How much of a square do the points of a triangle with three of its corners fill?"),
    M("segment_triangle", "tiny limit for parallel", nearly_parallel(1e-9),
      "Where the determinant is below a tiny number, the segment is taken to be parallel. The determinant is an area"
      " times a length: with triangles of some micrometres it is always smaller than that.",
      "How large is your determinant if all lengths are a million times smaller?"),
    M("segment_triangle", "fixed limit for parallel", nearly_parallel(1e-6),
      "Where the determinant is below a fixed number, the segment is taken to be parallel. The determinant is an area"
      " times a length: with triangles of a millimetre it is always small.",
      "How large is your determinant if all lengths are a thousand times smaller?"),
    M("segment_triangle", "zero weights for none", meeting(both, nothing=(np.inf, 0.0)),
      "Where the two do not meet, the weights are zero. They should be NaN, because zero is a possible weight.",
      "What should the weights be where there is no such point?"),
    M("segment_triangle", "no fraction for none", meeting(both, nothing=(np.nan, np.nan)),
      "Where the two do not meet, the fraction is NaN. It should be infinite: then the least of several fractions is"
      " that of the first hit.",
      "What is the least of 0.5 and NaN for NumPy, and of 0.5 and infinity?"),
)
# fmt: on
