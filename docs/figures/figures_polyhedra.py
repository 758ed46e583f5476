"""Figures of the polyhedra statement: the convex test on a concave solid, rays along edges, holes, doubtful signs."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from solutions import as_printed
from solutions.polyhedra import inside_by_parity, orient2d, side_of_line, winding_number

INSIDE, WRONG, OUTSIDE = "#0072b2", "#d55e00", "#999999"
CORNERS = np.array([(0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4)], dtype=float)
HALVES = np.array([(0, 1, 3), (1, 2, 3), (0, 3, 4), (0, 4, 5)])


def _prism(outline: np.ndarray, triangles: np.ndarray, height: float) -> tuple[np.ndarray, np.ndarray]:
    n = len(outline)
    ring, ahead = np.arange(n), (np.arange(n) + 1) % n
    walls = [np.stack([ring, ahead, ahead + n], axis=1), np.stack([ring, ahead + n, ring + n], axis=1)]
    low = np.column_stack([outline, np.zeros(n)])
    return np.concatenate([low, low + np.array([0, 0, height])]), np.concatenate(
        [triangles[:, ::-1], triangles + n, *walls]
    )


def _outline(axes: Axes, corners: np.ndarray) -> None:
    closed = np.concatenate([corners, corners[:1]])
    axes.plot(closed[:, 0], closed[:, 1], color="#1b1b1b", linewidth=1.5)


def _answers(axes: Axes, points: np.ndarray, truth: np.ndarray, answer: np.ndarray) -> None:
    for chosen, marker, colour, label in (
        (truth & answer, "o", INSIDE, "inside"),
        (~truth & ~answer, ".", OUTSIDE, "outside"),
        (truth != answer, "X", WRONG, "wrong"),
    ):
        x, y = points[chosen, 0], points[chosen, 1]
        axes.plot(x, y, marker, color=colour, markersize=3 if marker == "." else 5, label=label)


def convex_test_on_an_l(figure: Figure) -> None:
    """A section through an L: behind all planes are only the points where its arms cross; the parity of a ray is right.

    Crosses are answers that are wrong.
    """
    solid = _prism(CORNERS, HALVES, 3.0)
    steps = np.arange(-0.25, 4.5, 0.5)
    points = np.stack([*np.meshgrid(steps, steps), np.full((len(steps), len(steps)), 1.4)], axis=-1).reshape(-1, 3)
    x, y = points[:, 0], points[:, 1]
    truth = (x > 0) & (y > 0) & (x < 4) & (y < 4) & ((x < 2) | (y < 2))
    answers = (as_printed.inside_polyhedron(points, *solid), inside_by_parity(points, *solid))
    titles = ("The slide: behind all planes", "Parity of a ray")
    for axes, answer, title in zip(figure.subplots(1, 2, sharey=True), answers, titles, strict=True):
        _outline(axes, CORNERS)
        axes.plot([2, 2], [0, 2], ":", color="#1b1b1b")
        axes.plot([0, 2], [2, 2], ":", color="#1b1b1b")
        _answers(axes, points, truth, answer)
        axes.set(aspect="equal", xlabel="x, m", title=title, xlim=(-0.6, 4.6), ylim=(-0.6, 4.6))
    figure.axes[0].set_ylabel("y, m")
    figure.axes[0].legend(loc="upper right", fontsize=8, frameon=True, framealpha=1, edgecolor="white")


def rays_along_edges(figure: Figure) -> None:
    """Seen from above, a lid of eight faces: a ray up from under an edge or the middle vertex meets several of them.

    Counted with their borders, an even number says outside; with the point moved by (ε, ε²) one face has each ray.
    """
    turns = np.arange(8) * np.pi / 4
    wheel = np.round(3 * np.stack([np.cos(turns), np.sin(turns)], axis=-1))
    rim = np.column_stack([wheel, np.zeros(8)])
    solid = (
        np.concatenate([rim, [[0, 0, 2], [0, 0, -2]]]),
        np.concatenate([[[k, (k + 1) % 8, 8], [(k + 1) % 8, k, 9]] for k in range(8)]),
    )
    steps = np.arange(-3.0, 3.5, 0.5)
    points = np.stack([*np.meshgrid(steps, steps), np.full((len(steps), len(steps)), 0.05)], axis=-1).reshape(-1, 3)
    reach = 1 - points[:, 2] / 2  # the section of the double cone is the wheel, made smaller
    ends = np.roll(wheel, -1, axis=0)
    sides = [orient2d(a * reach[:, None], b * reach[:, None], points[:, :2]) for a, b in zip(wheel, ends, strict=True)]
    truth = np.all(np.stack(sides) > 0, axis=0)
    answers = (as_printed.inside_by_touched_faces(points, *solid), inside_by_parity(points, *solid))
    titles = ("All faces that a ray touches", "Moved by (ε, ε², ε³)")
    for axes, answer, title in zip(figure.subplots(1, 2, sharey=True), answers, titles, strict=True):
        _outline(axes, wheel)
        for x, y in wheel:
            axes.plot([0, x], [0, y], color="#cccccc", zorder=0)
        _answers(axes, points, truth, answer)
        axes.set(aspect="equal", xlabel="x, m", title=title, xlim=(-3.4, 3.4), ylim=(-3.4, 4.6))
    figure.axes[0].set_ylabel("y, m")
    figure.axes[0].legend(loc="upper center", fontsize=8, ncols=3, columnspacing=0.8, handletextpad=0.1)


def winding_number_with_a_hole(figure: Figure) -> None:
    """Sections through a box, and through the same without its lid: the winding number is 1 inside and 0 outside.

    Through the hole it falls smoothly, and the heavy line, 1/2, counts as the border; beside the box it is below 0.
    """
    square = np.array([(0, 0), (4, 0), (4, 4), (0, 4)], dtype=float)
    vertices, faces = _prism(square, np.array([(0, 1, 2), (0, 2, 3)]), 4.0)
    x, z = np.meshgrid(np.linspace(-1.53, 5.53, 120), np.linspace(-1.53, 6.03, 120))
    points = np.stack([x, np.full_like(x, 2.03), z], axis=-1)
    meshes = ((faces, "Closed"), (np.delete(faces, [2, 3], axis=0), "Without its lid"))
    for axes, (kept, title) in zip(figure.subplots(1, 2, sharey=True), meshes, strict=True):
        winding = winding_number(points, vertices, kept)
        filled = axes.contourf(x, z, winding, np.linspace(-0.25, 1.05, 14), cmap="Blues")
        axes.contour(x, z, winding, [0.5], colors="#d55e00", linewidths=2.5)
        rim = np.array([(0, 4), (0, 0), (4, 0), (4, 4)])
        axes.plot(rim[:, 0], rim[:, 1], color="#1b1b1b", linewidth=1)
        axes.set(aspect="equal", xlabel="x, m", title=title)
    figure.axes[0].set_ylabel("z, m")
    figure.colorbar(filled, ax=figure.axes, label="winding number", ticks=[0, 0.5, 1], shrink=0.8)


def doubtful_signs(figure: Figure) -> None:
    """Which side of a diagonal 256 × 256 neighbouring doubles are on: in plain doubles 11 972 of 65 536 are wrong.

    Light is left of the line, mid-grey on it, dark right of it (points and line of Kettner et al. 2008).
    """
    i, j = np.meshgrid(*2 * [np.arange(256)], indexing="ij")
    p, q, r = 0.5 + np.stack([i, j], axis=-1) * 2.0**-53, np.array([12.0, 12.0]), np.array([24.0, 24.0])
    plain, exact = side_of_line(p, q, r), orient2d(p, q, r)
    signs = ((plain, f"Plain: {np.sum(plain != exact)} wrong"), (exact, "Exact where it must be"))
    for axes, (sign, title) in zip(figure.subplots(1, 2, sharey=True), signs, strict=True):
        axes.imshow(sign.T, origin="lower", cmap="cividis", vmin=-1, vmax=1, interpolation="nearest")
        axes.set(xlabel="steps of 2⁻⁵³ in x", title=title)
        axes.grid(False)
    figure.axes[0].set_ylabel("steps of 2⁻⁵³ in y")


FIGURES = {
    (9, "convex-test"): convex_test_on_an_l,
    (9, "rays-along-edges"): rays_along_edges,
    (9, "winding-number"): winding_number_with_a_hole,
    (9, "doubtful-signs"): doubtful_signs,
}
