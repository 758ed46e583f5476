"""Known mistakes about whether two solids intersect."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from solutions.polyhedra import edges_through_faces, face_planes, inside_by_parity


def mesh(v, f):
    return np.asarray(v, dtype=float), np.asarray(f)


def corners_inside(a, b, of=lambda a: a[0][np.unique(a[1])], enough=np.any):
    """Whether corners of A are in B."""
    if not len(a[1]) or not len(b[1]):
        return False
    return bool(enough(inside_by_parity(of(a), *b)))


def edges_through(a, b):
    return len(edges_through_faces(*a, *b)[1]) > 0


def of_two(*parts):
    """True if any of the parts is, of A and B."""
    return lambda va, fa, vb, fb: any(part(mesh(va, fa), mesh(vb, fb)) for part in parts)


def turned(part):
    return lambda a, b: part(b, a)


def boxes(a, b):
    if not len(a[1]) or not len(b[1]):
        return False
    (low_a, high_a), (low_b, high_b) = ((m[0][m[1]].min(axis=(0, 1)), m[0][m[1]].max(axis=(0, 1))) for m in (a, b))
    return bool(np.all((low_a <= high_b) & (low_b <= high_a)))


def spheres(a, b):
    """Balls around the corners."""
    if not len(a[1]) or not len(b[1]):
        return False
    (m_a, r_a), (m_b, r_b) = (
        (m[0][np.unique(m[1])].mean(axis=0), np.max(np.linalg.norm(m[0] - m[0][np.unique(m[1])].mean(axis=0), axis=1)))
        for m in (a, b)
    )
    return bool(np.linalg.norm(m_a - m_b) <= r_a + r_b)


def no_plane_between(a, b):
    """No face of either has all of the other in front of it."""
    if not len(a[1]) or not len(b[1]):
        return False
    for one, other in ((a, b), (b, a)):
        n, d = face_planes(*one)
        if np.any(np.all(other[0][np.unique(other[1])] @ n.T + d > 0, axis=0)):
            return False
    return True


def all_vertices(a):
    return a[0]


def first_vertex(a):
    return a[0][:1]


def inside_with(**how):
    return lambda a, b: corners_inside(a, b, **how)


def crossing(a, b):
    """An edge goes through the inside of a face: touching does not count."""
    edges, faces = edges_through_faces(*a, *b)
    for (s, e), face in zip(edges, faces, strict=True):
        p, q, (u, v, w) = a[0][s], a[0][e], b[0][b[1][face]]
        n = np.cross(v - u, w - u)
        if (n @ (p - u)) * (n @ (q - u)) < -1e-12:
            x = p + (n @ (u - p)) / (n @ (q - p)) * (q - p)
            if all(n @ np.cross(g - h, x - h) > 1e-9 for h, g in ((u, v), (v, w), (w, u))):
                return True
    return False


def moved_in(a, b):
    """A corner of A, moved a little towards the middle of A, is in B."""
    if not len(a[1]) or not len(b[1]):
        return False
    corners = a[0][np.unique(a[1])]
    return bool(np.any(inside_by_parity(corners + 1e-6 * (corners.mean(axis=0) - corners), *b)))


# fmt: off
BANK = (
    M("polyhedra_intersect", "corners alone", of_two(corners_inside, turned(corners_inside)),
      "Only corners are looked at. Two solids can go through each other without a corner of either being inside of the"
      " other.",
      "Push a bar right through a cube. Where are its corners, and where are those of the cube?"),
    M("polyhedra_intersect", "edges alone", of_two(edges_through, turned(edges_through)),
      "Only edges and faces are looked at. A solid that lies within the other touches none of its faces.",
      "Put a small cube into the middle of a large one. Which edges go through which faces?"),
    M("polyhedra_intersect", "edges of A alone", of_two(edges_through, corners_inside, turned(corners_inside)),
      "Only edges of A are tried against faces of B. Where B is a bar through a side of A, it is an edge of B that goes"
      " through a face of A.",
      "Exchange A and B. Does the answer change?"),
    M("polyhedra_intersect", "edges of B alone",
      of_two(turned(edges_through), corners_inside, turned(corners_inside)),
      "Only edges of B are tried against faces of A. Where A is a bar through a side of B, it is an edge of A that goes"
      " through a face of B.",
      "Exchange A and B. Does the answer change?"),
    M("polyhedra_intersect", "A in B alone", of_two(edges_through, turned(edges_through), corners_inside),
      "It is asked whether A lies within B, but not whether B lies within A.",
      "Put B into the middle of A. Which of your questions has the answer yes?"),
    M("polyhedra_intersect", "B in A alone", of_two(edges_through, turned(edges_through), turned(corners_inside)),
      "It is asked whether B lies within A, but not whether A lies within B.",
      "Put A into the middle of B. Which of your questions has the answer yes?"),
    M("polyhedra_intersect", "boxes around them", of_two(boxes),
      "It says whether the boxes around the two solids meet. Two solids may be apart although their boxes overlap.",
      "Turn a long bar by 45°. How much of the box around it is empty?"),
    M("polyhedra_intersect", "balls around them", of_two(spheres),
      "It says whether the balls around the two solids meet. That is a quick test for solids that are far apart, and no"
      " more.",
      "How far apart may two bars lie side by side while the balls around them overlap?"),
    M("polyhedra_intersect", "no plane between them", of_two(no_plane_between),
      "It says yes unless the plane of some face has all of the other solid in front of it. A solid in the pocket of an"
      " L has no such plane, and two convex solids may pass each other edge to edge.",
      "A ball lies in a bowl. Which plane has the ball on one side and the bowl on the other?"),
    M("polyhedra_intersect", "vertices of no face",
      of_two(edges_through, turned(edges_through), inside_with(of=all_vertices),
             turned(inside_with(of=all_vertices))),
      "Vertices that belong to no face are taken for corners of the solid.",
      "Which of the vertices do the faces name?"),
    M("polyhedra_intersect", "first vertex",
      of_two(edges_through, turned(edges_through), inside_with(of=first_vertex), turned(inside_with(of=first_vertex))),
      "The first vertex of a mesh stands for the solid. No face may name it, and then it is no corner of the solid; and"
      " in a solid of several parts it is a corner of only one of them.",
      "The list of vertices may begin with one that no face names. Is it a part of the solid?"),
    M("polyhedra_intersect", "all corners", of_two(edges_through, turned(edges_through), inside_with(enough=np.all),
                                                   turned(inside_with(enough=np.all))),
      "One solid must have all corners in the other. A solid of several parts may have one part inside and another"
      " elsewhere.",
      "Two dice are one solid A, and one of them lies in the box B. How many corners of A are in B?"),
    M("polyhedra_intersect", "touching left out", of_two(crossing, turned(crossing), moved_in, turned(moved_in)),
      "Solids that only touch are said to be apart. A point of both is all that it takes.",
      "Two cubes stand side by side, face to face. Which points do they have in common?"),
    M("polyhedra_intersect", "edges of both at once",
      lambda va, fa, vb, fb: (edges_through(mesh(va, fa), mesh(vb, fb)) and edges_through(mesh(vb, fb), mesh(va, fa)))
      or corners_inside(mesh(va, fa), mesh(vb, fb)) or corners_inside(mesh(vb, fb), mesh(va, fa)),
      "Edges of both must go through faces of the other. One edge through one face is enough.",
      "A bar goes through the middle of a wall. Which edges of the wall go through the bar?"),
)
# fmt: on
