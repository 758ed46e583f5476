"""A clip: one scenario as one or several implementations ran it, small enough for a page.

`reference.viewer.clip_making` makes it. Its JSON is the same for the same poses; `docs/design.md` says what is in it.
"""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from reference.arrays import Array
from reference.viewer import camera
from reference.viewer.contacts import Touch
from reference.viewer.packing import packed
from reference.viewer.shapes import Shape, written

SCHEMA, VERSION = "collisions-lab/replay", 1
STEP, TURN = 1e-4, 5e-4
"""Coarsest step, m, in which positions are kept, and that of the parts of quaternions."""
FINENESS = 5e3
"""Steps across what is seen, at least."""
DASHES: tuple[tuple[int, ...], ...] = ((), (9, 4), (2, 4), (11, 4, 2, 4), (16, 4), (5, 2), (6, 3, 1, 3, 1, 3))
"""Dashes of each look: lines differ by these, and by a label, not by their colours alone."""
WIDTHS = (1.5, 4.0, 2.6, 1.4, 4.0, 2.5, 2.0)
"""Width of each look's outlines, px: where two coincide, the earlier one shows on both sides of the later one."""
SPEEDS = (0.25, 0.5, 1.0, 2.0)
"""Offered, as multiples of real time, or of the slow motion in which a short run is watched."""
SHOWN_RATE = 60
"""Samples a second that a screen shows."""
LEAST_RATIO, MOST_RATIO = 0.36, 0.75
"""Height over width of a picture."""
LEAST = 0.02
"""Share of its radius by which a ball moves at least, to be shown where it began."""
LOOKS = {"handwritten": 0, "pybullet": 1, "mujoco": 2, "dart": 3}
"""The look that an engine has in every replay; other runs take a free one."""


@dataclass(frozen=True)
class Solid:
    """A body as it is drawn. position, orientation: where it is as long as no run says otherwise, m, w x y z."""

    name: str
    shape: Shape
    position: tuple[float, ...] = (0.0, 0.0, 0.0)
    orientation: tuple[float, ...] = (1.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True, eq=False)
class Run:
    """One implementation. bodies: b names. poses: (n, b, 7), position and orientation. points: (n, p, 3), of a mesh.

    look: place in `DASHES`. shown: whether one sees it before asking. note: what there is to say of it.
    """

    title: str
    look: int
    bodies: tuple[str, ...]
    poses: Array
    points: Array
    touches: tuple[Touch, ...] = ()
    shown: bool = True
    note: str = ""

    @property
    def count(self) -> int:
        """How many samples it has."""
        return len(self.poses)


@dataclass(frozen=True, eq=False)
class Clip:
    """A replay's content. rate: samples a second. springs: pairs of points. The first run is drawn solid."""

    title: str
    rate: int
    solids: tuple[Solid, ...]
    runs: tuple[Run, ...]
    springs: tuple[tuple[int, int], ...] = ()
    view: camera.View = camera.FRONT
    low: Array = field(default_factory=lambda: -np.ones(3))
    high: Array = field(default_factory=lambda: np.ones(3))

    @property
    def count(self) -> int:
        """Samples of the longest run, at least one."""
        return max((run.count for run in self.runs), default=0) or 1

    @property
    def slow(self) -> float:
        """How much slower than in reality one watches it: a short run is sampled more often for that."""
        return min(1.0, SHOWN_RATE / self.rate)

    @property
    def ratio(self) -> float:
        """Height over width of its picture."""
        wide, high = camera.Picture(self.view, self.low, self.high, 1.0, 1.0, 0.0).extent
        return min(MOST_RATIO, max(LEAST_RATIO, high / max(wide, 1e-9)))

    def tags(self) -> list[str]:
        """A short label for each run, no two alike: its name, and what distinguishes it: `PyBullet`, `PyBullet stock`.

        It is a word, because a letter beside a ball would be read as the name of the ball.
        """
        found: list[str] = []
        for run in self.runs:
            name, _, profile = run.title.partition(", ")
            label = " ".join([name.strip("* ") or "?", *profile.split()[-1:]])
            numbered = (f"{label} {number}" for number in range(2, len(self.runs) + 2))
            found.append(label if label not in found else next(tag for tag in numbered if tag not in found))
        return found

    def json(self) -> str:
        """The clip as the script reads it, without a character that could end a script element in a page."""
        step = min(STEP, 10.0 ** math.floor(math.log10(max(float(np.max(self.high - self.low)), 1e-9) / FINENESS)))
        marked = self._marked() if self.runs else 0
        content = {
            "schema": SCHEMA,
            "version": VERSION,
            "title": self.title,
            "rate": self.rate,
            "count": self.count,
            "step": step,
            "turn": TURN,
            "speeds": [[speed * self.slow, _fraction(speed * self.slow)] for speed in SPEEDS],
            "ratio": _rounded(self.ratio),
            "view": list(self.view),
            "low": [_rounded(value) for value in self.low],
            "high": [_rounded(value) for value in self.high],
            "solids": [_solid(solid) for solid in self.solids],
            "springs": [list(pair) for pair in self.springs],
            "runs": [self._run(run, tag, step, marked) for run, tag in zip(self.runs, self.tags(), strict=True)],
        }
        text = json.dumps(content, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
        escapes = {ord(sign): f"\\u{ord(sign):04x}" for sign in "<>&\u2028\u2029"}
        return text.translate(escapes)

    def covered(self, run: Run) -> list[int]:
        """The places of the balls that move, and hide the whole of their way: a ring shows where these began."""
        shapes = {solid.name: solid.shape for solid in self.solids}
        radii = np.array([getattr(shapes[name], "radius", 0.0) for name in run.bodies])
        if not run.count or not run.bodies:
            return []
        most = np.linalg.norm(run.poses[..., :3] - run.poses[0, :, :3], axis=-1).max(axis=0)
        return np.flatnonzero((most > LEAST * radii) & (most < radii)).tolist()

    def words(self) -> str:
        """What a text for those who do not see the picture adds to its title: the ring, where there is one."""
        ring = bool(self.runs) and self.runs[0].shown and bool(self.covered(self.runs[0]))
        return "; a ring where a ball’s centre began, a dot where it is" if ring else ""

    def _marked(self) -> int:
        """The body, or the point of a mesh, that is at some time furthest from where the first run has it.

        All runs are labelled at it: a label at another body for each run would be read as the name of that body.
        """
        apart = [self._apart(run) for run in self.runs]
        alike = [each for each in apart if each.shape == apart[0].shape]
        return int(np.argmax(np.max(alike, axis=0))) if alike and alike[0].size else 0

    def _apart(self, run: Run) -> Array:
        """How far each body of a run, or point of its mesh, is at most from where the first run has it."""
        first, count = self.runs[0], min(run.count, self.runs[0].count)
        own, other = ((it.poses[:count, :, :3] if run.bodies else it.points[:count]) for it in (run, first))
        if own.shape != other.shape or not own.size:
            return np.zeros(0)
        return np.asarray(np.linalg.norm(own - other, axis=-1).max(axis=0))

    def _run(self, run: Run, tag: str, step: float, marked: int) -> dict[str, Any]:
        places = {solid.name: at for at, solid in enumerate(self.solids)}
        return {
            "title": run.title,
            "tag": tag,
            "look": run.look,
            "dash": list(DASHES[run.look]),
            "width": WIDTHS[run.look],
            "covered": self.covered(run),
            "marked": marked if marked < max(len(run.bodies), run.points.shape[1]) else 0,
            "shown": run.shown,
            "note": run.note,
            "count": run.count,
            "bodies": [places[name] for name in run.bodies],
            "positions": packed(run.poses[..., :3], step),
            "turns": packed(run.poses[..., 3:], TURN),
            "points": packed(run.points, step),
            "mesh": run.points.shape[1],
            "touches": [
                [touch.first, touch.last, places[touch.body], *touch.place, *touch.normal, *touch.impulse]
                for touch in run.touches
            ],
        }


def _fraction(speed: float) -> str:
    """A speed as one reads it: ×2, ×¼, ×1/20."""
    if speed >= 1:
        return f"×{speed:g}"
    whole = round(1 / speed)
    exact = abs(whole * speed - 1) < 1e-6
    return "×" + {2: "½", 4: "¼", 8: "⅛"}.get(whole if exact else 0, f"1/{whole}" if exact else f"{speed:.2g}")


def _rounded(value: float) -> float:
    return round(float(value), 5) + 0.0


def _solid(solid: Solid) -> dict[str, Any]:
    place = [_rounded(part) for part in solid.position], [_rounded(part) for part in solid.orientation]
    return {"name": solid.name, **written(solid.shape), "at": place[0], "turn": place[1]}
