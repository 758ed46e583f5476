"""Where a replay is seen from, and how much of space it shows.

The projection is parallel. `azimuth` says where the viewer stands, in degrees about the vertical from x; `pitch`, how
far above the horizon. At −90° and 0° x points to the right and z up. The script has the same few lines.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reference.arrays import Array

View = tuple[float, float]
"""Azimuth and pitch, degrees."""
FRONT: View = (-90.0, 0.0)
OBLIQUE: View = (-62.0, 22.0)
INTO: View = (60.0, 35.0)
"""Steep enough to see into a bowl."""
_FLAT = 0.02
"""What leaves a plane by less than this share of its extent is in it."""
_TURN = 0.02
"""Vector part of a quaternion from which a body is seen to turn: some 2°."""


def basis(view: View) -> Array:
    """Unit vectors of a view, (3, 3): to the right, up, and towards the viewer."""
    azimuth, pitch = math.radians(view[0]), math.radians(view[1])
    right = np.array([-math.sin(azimuth), math.cos(azimuth), 0.0])
    towards = np.array([math.cos(pitch) * math.cos(azimuth), math.cos(pitch) * math.sin(azimuth), math.sin(pitch)])
    return np.stack((right, np.cross(towards, right), towards))


def default_view(places: Array, normals: Sequence[Sequence[float]], turns: Array) -> View:
    """The side from which a planar motion is seen in full, or an oblique view of one that is not planar.

    places: (n, 3), m, where bodies come. normals: of half-spaces. turns: (m, 3), vector parts of the turns made.
    """
    spread = places - places.mean(axis=0) if len(places) else np.zeros((0, 3))
    extent = float(np.abs(spread).max(initial=0.0))
    directions = np.concatenate([spread / extent if extent else spread[:0], np.array(normals).reshape(-1, 3)])
    turns = turns[np.linalg.norm(turns, axis=-1) > _TURN]
    towards = _across(directions, turns)
    flat = np.abs(directions @ towards).max(initial=0.0) < _FLAT
    along = np.linalg.norm(np.cross(turns, towards), axis=-1).max(initial=0.0) < _TURN
    if not (flat and along):
        return OBLIQUE
    azimuth = FRONT[0] if abs(towards[2]) > 1 - _FLAT else math.degrees(math.atan2(towards[1], towards[0]))
    return round(azimuth, 2) + 0.0, round(math.degrees(math.asin(np.clip(towards[2], -1.0, 1.0))), 2) + 0.0


def _across(directions: Array, turns: Array) -> Array:
    """The unit vector that is most nearly at right angles to all directions; a turn's axis where there is choice."""
    if not len(directions):
        return np.asarray(basis(FRONT)[2])
    squares, columns = np.linalg.eigh(directions.T @ directions)  # from the least to the most
    if squares[1] > _FLAT**2 * squares[2]:
        towards = columns[:, 0]
    elif len(turns):
        towards = turns[-1] / np.linalg.norm(turns[-1])
    else:
        beside = np.cross(columns[:, 2], (0.0, 0.0, 1.0))  # motion along a line: seen with the vertical upright
        size = float(np.linalg.norm(beside))
        towards = beside / size if size > _FLAT else basis(FRONT)[2]
    sign = next((part for part in (-towards[1], towards[0], towards[2]) if abs(part) > _FLAT), 1.0)
    return np.asarray(towards * math.copysign(1.0, sign))


@dataclass(frozen=True, eq=False)
class Picture:
    """A view on paper: space (…, 3), m, to (…, 3): right and down, in px, and towards the viewer, in m."""

    view: View
    low: Array
    high: Array
    width: float
    height: float
    margin: float

    @property
    def scale(self) -> float:
        """Pixels a metre: what is between `low` and `high` just fits."""
        wide, high = self.extent
        room = self.width - 2 * self.margin, self.height - 2 * self.margin
        return min(room[0] / max(wide, 1e-9), room[1] / max(high, 1e-9))

    @property
    def extent(self) -> tuple[float, float]:
        """Width and height of what is seen, m."""
        least, most = self._seen()
        wide, high = (most - least).tolist()
        return wide, high

    def _seen(self) -> tuple[Array, Array]:
        corners = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
        seen = np.where(corners, self.high, self.low) @ basis(self.view)[:2].T
        return seen.min(axis=0), seen.max(axis=0)

    def project(self, places: Array) -> Array:
        """Where places (…, 3), m, are on paper."""
        (least, most), scale = self._seen(), self.scale
        middle = (least + most) / 2
        found = places @ basis(self.view).T
        across = self.width / 2 + scale * (found[..., 0] - middle[0])
        down = self.height / 2 - scale * (found[..., 1] - middle[1])
        return np.stack([across, down, found[..., 2]], axis=-1)
