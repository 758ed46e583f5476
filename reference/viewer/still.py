"""The still picture of a clip: an SVG by our own hand, for print, for a page without scripts, and beside a replay.

It shows the last frame as the script would, with the way of the centres behind it, and what is what below. It is the
same text for the same clip.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from html import escape

import numpy as np

from reference.arrays import Array
from reference.scene import geometry
from reference.scene.scenario import HalfSpace
from reference.viewer.camera import Picture, basis
from reference.viewer.clip import DASHES, WIDTHS, Clip, Run, Solid
from reference.viewer.shapes import Capsule, faces_of, vertices_of

WIDTH, MARGIN, LINE = 640, 16, 20
LETTERS, LETTER = 14, 0.55
"""Size of the letters, and how wide one is, as a share of this, on average: a long caption gets smaller ones."""
POINTS = 90
"""Of a body's way, at most."""
STYLE = (
    ".page{fill:#fff}.text{fill:#1b1b1b}.body{fill:#c3d4e2}.rest{fill:#e6e4dc;stroke:#5b5b58}"
    ".k0{stroke:#1b1b1b}.k1{stroke:#0063a8}.k2{stroke:#b94700}.k3{stroke:#007653}.k4{stroke:#9c3f7c}.k5{stroke:#7a5600}"
    ".k6{stroke:#4b3fa8}"
)
"""Colours of a picture that stands alone; in a page they are the replay's own."""


@dataclass(frozen=True)
class _Part:
    """An SVG element, and how near the viewer it is, m."""

    depth: float
    text: str


def still(clip: Clip, alone: bool = True) -> str:
    """The picture, with a line for each run below it. alone: with its own colours and ground, for an `<img>`."""
    height = round(WIDTH * clip.ratio)
    picture = Picture(clip.view, clip.low, clip.high, WIDTH, height, MARGIN)
    shown = [run for run in clip.runs if run.shown]
    whole = height + LINE * (len(shown) + 1) + 6
    time = f"{clip.title}, {(clip.count - 1) / clip.rate:.2f} s"
    label = escape(time + clip.words())
    content = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {whole}" role="img" aria-label="{label}"'
        f' font-family="sans-serif" font-size="{LETTERS}" stroke-width="1.5" stroke-linejoin="round" fill="none">',
        f'<style>{STYLE}</style><path class="page" d="M0 0H{WIDTH}V{whole}H0z"/>' if alone else "",
        f'<svg width="{WIDTH}" height="{height}" viewBox="0 0 {WIDTH} {height}">',
        *_drawn(clip, picture),
        "</svg>",
        *_legend(time, shown, clip, height),
        "</svg>",
    ]
    return "".join(content)


def _drawn(clip: Clip, picture: Picture) -> Iterator[str]:
    first = clip.runs[0] if clip.runs else None
    moving = {name for run in clip.runs if run.count for name in run.bodies}
    for solid in clip.solids:
        if isinstance(solid.shape, HalfSpace):
            yield _ground(solid, solid.shape, picture)
    parts = [
        part
        for solid in clip.solids
        if solid.name not in moving
        for part in _parts(solid, np.array(solid.position), np.array(solid.orientation), picture, 'class="rest"')
    ]
    if first is not None and first.shown:
        yield from _ways(first, picture)
        parts += _run(clip, first, picture, f'class="body k{first.look}"')
    yield from (part.text for part in sorted(parts, key=lambda part: part.depth))
    if first is not None and first.shown:
        yield from _starts(first, clip.covered(first), picture)
    for run in clip.runs[1:]:
        if run.shown:
            yield f'<g class="k{run.look}" stroke-width="{WIDTHS[run.look]}" stroke-dasharray="{_dash(run)}">'
            yield from (part.text for part in _run(clip, run, picture, None))
            yield "</g>"


def _dash(run: Run) -> str:
    return " ".join(map(str, DASHES[run.look])) or "none"


def _run(clip: Clip, run: Run, picture: Picture, fill: str | None) -> Iterator[_Part]:
    """All that a run shows in its last frame. fill: attributes of filled shapes; None for outlines."""
    style = fill or ""
    solids = {solid.name: solid for solid in clip.solids}
    for name, pose in zip(run.bodies, run.poses[-1] if run.count else (), strict=False):
        turn = pose[3:] / max(float(np.linalg.norm(pose[3:])), 1e-9)
        yield from _parts(solids[name], pose[:3], turn, picture, fill)
    if run.count and run.points.size:
        points = picture.project(run.points[-1])
        for start, end in clip.springs:
            yield _Part(float(points[[start, end], 2].mean()), f'<path {style} d="{_path(points[[start, end]])}"/>')
        for point in points:
            yield _Part(float(point[2]), f'<circle {style} cx="{point[0]:.1f}" cy="{point[1]:.1f}" r="3"/>')


def _parts(solid: Solid, position: Array, turn: Array, picture: Picture, fill: str | None) -> Iterator[_Part]:
    style = fill or ""
    points, radius = vertices_of(solid.shape)
    places = position + geometry.rotate(turn, points)
    seen, size = picture.project(places), radius * picture.scale
    if isinstance(solid.shape, Capsule):
        text = f'<path {style} d="{_stadium(seen[0, :2], seen[1, :2], size)}"/>'
        yield _Part(float(seen[:, 2].mean()), text)
    elif radius:
        x, y, depth = seen[0].tolist()
        yield _Part(depth, f'<circle {style} cx="{x:.1f}" cy="{y:.1f}" r="{max(size, 1.5):.1f}"/>')
    towards, edges = basis(picture.view)[2], dict[tuple[int, ...], None]()
    for face in map(list, faces_of(solid.shape)):
        normal = np.cross(places[face[1]] - places[face[0]], places[face[2]] - places[face[1]])
        if normal @ towards > 1e-3 * np.linalg.norm(normal):
            edges |= dict.fromkeys(tuple(sorted(pair)) for pair in zip(face, face[1:] + face[:1], strict=True))
            if fill is not None:
                yield _Part(float(seen[face, 2].mean()), f'<path {style} d="{_path(seen[face])}z"/>')
    if edges and fill is None:  # an outline has each edge once, or its dashes would fill each other's gaps
        yield _Part(0.0, f'<path d="{"".join(_path(seen[list(pair)]) for pair in edges)}"/>')


def _stadium(start: Array, end: Array, radius: float) -> str:
    along = (end - start) / max(float(np.linalg.norm(end - start)), 1e-9)
    aside = radius * np.array([-along[1], along[0]])
    a, b, c, d = (f"{x:.1f} {y:.1f}" for x, y in (start + aside, start - aside, end - aside, end + aside))
    return f"M{a}A{radius:.1f} {radius:.1f} 0 0 1 {b}L{c}A{radius:.1f} {radius:.1f} 0 0 1 {d}z"


def _path(points: Iterable[Sequence[float]]) -> str:
    return "M" + "L".join(f"{point[0]:.1f} {point[1]:.1f}" for point in points)


def _ground(solid: Solid, shape: HalfSpace, picture: Picture) -> str:
    """All below a line where it is seen edge on; else a square piece."""
    normal, axes = np.array(shape.normal), basis(picture.view)
    middle = (picture.low + picture.high) / 2
    foot = middle - normal * ((middle - solid.position) @ normal)
    far = 2 * float(np.linalg.norm(picture.high - picture.low)) + 1
    facing = float(normal @ axes[2])
    if abs(facing) < 0.03:
        along = np.cross(normal, axes[2])
        sides = np.array([foot - far * along, foot + far * along])
        below = picture.project(np.concatenate([sides, sides[::-1] - far * normal]))
        return f'<path class="rest" d="{_path(below)}z"/>'
    one = np.cross(normal, (1.0, 0.0, 0.0) if abs(normal[0]) < 0.8 else (0.0, 1.0, 0.0))
    one = one / np.linalg.norm(one)
    other, half = np.cross(normal, one), 0.65 * float(np.max(picture.high - picture.low))
    square = np.array([foot + half * (i * one + j * other) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
    fill = "" if facing > 0 else ' fill-opacity="0"'
    return f'<path class="rest"{fill} d="{_path(picture.project(square))}z"/>'


def _ways(run: Run, picture: Picture) -> Iterator[str]:
    """The ways of the centres, thinned where they are long, and without what does not move."""
    kept = np.unique(np.linspace(0, max(run.count - 1, 0), min(run.count, POINTS)).round().astype(int))
    for at in range(len(run.bodies)):
        way = np.round(picture.project(run.poses[kept, at, :3]), 1)
        if len(way) and np.ptp(way[:, :2], axis=0).max() > 1:
            yield f'<path class="k{run.look}" stroke-opacity=".45" d="{_path(way)}"/>'


def _starts(run: Run, covered: Sequence[int], picture: Picture) -> Iterator[str]:
    """A ring where the centre of each of these bodies began, and a dot where it is."""
    for at in covered:
        for (x, y, _), radius in zip(picture.project(run.poses[[0, -1], at, :3]).tolist(), (5, 1), strict=True):
            yield f'<circle class="k{run.look}" cx="{x:.1f}" cy="{y:.1f}" r="{radius}"/>'


def _legend(time: str, shown: Sequence[Run], clip: Clip, height: int) -> Iterator[str]:
    size = (WIDTH - MARGIN) / (LETTER * len(time))
    smaller = f' font-size="{size:.1f}"' if size < LETTERS else ""
    yield f'<text class="text" x="8" y="{height + LINE - 3}"{smaller}>{escape(time)}</text>'
    for at, run in enumerate(shown):
        y = height + LINE * (at + 2) - 8
        if run is clip.runs[0]:
            yield f'<rect class="body k{run.look}" x="9" y="{y - 6}" width="34" height="12"/>'
        else:
            yield f'<path class="k{run.look}" stroke-width="2.5" stroke-dasharray="{_dash(run)}" d="M8 {y}H44"/>'
        known = ", recorded" if run.note else ""
        early = "" if run.count == clip.count else f", until {max(run.count - 1, 0) / clip.rate:.2f} s"
        yield f'<text class="text" x="52" y="{y + 5}">{escape(f"{run.title}{known}{early}")}</text>'
