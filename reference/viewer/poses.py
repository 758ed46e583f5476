"""Poses for a replay: where the moving bodies are, sampled for a viewer, and how they are packed into files.

A viewer takes `Poses`, whoever they come from: `poses_of` a trajectory that has just been run, or
`reference.recording.reading.replay` of one that was recorded elsewhere.
"""

from __future__ import annotations

import io
import json
import math
import zipfile
import zlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reference.arrays import Array
from reference.errors import InvalidInput
from reference.scene.scenario import Scenario
from reference.scene.trajectory import Trajectory

SCHEMA, VERSION = "collisions-lab/poses", 2
RATE = 60
"""Samples a second of a replay."""
LEAST_SAMPLES = 60
"""A run of less than a second has a whole multiple of `RATE`, so that it can be watched in slow motion."""
LENGTH, TURN = 1e-5, 1e-4
"""Steps in which positions, m, and the parts of quaternions are kept."""
FARTHEST = 2e3
"""What flies farther than this, m, is kept as being there."""
_PARTS = 7
_NO_DATE = (1980, 1, 1, 0, 0, 0)
"""The first that a zip file knows: the same poses make the same bytes on every day."""


@dataclass(frozen=True, eq=False)
class Poses:
    """Where the moving bodies of a scenario are. What cannot move stands in the scenario itself.

    title: whose run it is. bodies: their b names. times: (n,), s, evenly spaced from 0. positions: (n, b, 3), centres
    of mass, m. orientations: (n, b, 4), w x y z, without jumps of sign. recording: where and when it ran, if not here.
    Arrays are read-only.
    """

    title: str
    bodies: tuple[str, ...]
    times: Array
    positions: Array
    orientations: Array
    recording: str = ""

    def __post_init__(self) -> None:
        for name in ("times", "positions", "orientations"):
            view = np.asarray(getattr(self, name), dtype=np.float64).view()
            view.flags.writeable = False
            object.__setattr__(self, name, view)


@dataclass(frozen=True)
class Track:
    """Packed poses of one run; plain data.

    profile, key: whose run it is, and of what. fingerprint: of the scenario and settings. rate: samples a second, of
    which there are `count`. packed: `LENGTH` and `TURN` as steps, second differences, compressed. curve: what is
    plotted of the run, as `reference.comparison.curves` packs it; empty where nobody asked.
    """

    profile: str
    key: str
    fingerprint: str
    bodies: tuple[str, ...]
    rate: int
    count: int
    packed: bytes
    curve: bytes = b""


def rate_of(scenario: Scenario) -> int:
    """Samples a second of a scenario's replay: `RATE`, or a multiple of it where the run is short."""
    return RATE * max(1, math.ceil(LEAST_SAMPLES / RATE / scenario.duration))


def poses_of(trajectory: Trajectory, title: str = "") -> Poses:
    """Sample a trajectory for a replay, in straight lines between its own samples, which are a few milliseconds apart.

    What a step method did between two of its samples, an impact say, it did not say either.
    """
    scenario = trajectory.scenario
    moving = [place for place, body in enumerate(scenario.bodies) if not body.immovable]
    rate = rate_of(scenario)
    times = np.arange(math.floor(scenario.duration * rate + 1e-6) + 1) / rate
    orientations = _turning_on(trajectory.orientations[:, moving])
    return Poses(
        title or trajectory.engine,
        tuple(scenario.bodies[place].name for place in moving),
        times,
        _at(times, trajectory.times, trajectory.positions[:, moving]),
        _unit(_at(times, trajectory.times, orientations)),
    )


def _turning_on(orientations: Array) -> Array:
    """The same orientations with signs that do not jump: q and −q are one orientation."""
    same = np.sum(orientations[1:] * orientations[:-1], axis=-1) >= 0
    signs = np.cumprod(np.where(same, 1.0, -1.0), axis=0)
    return np.concatenate([orientations[:1], orientations[1:] * signs[..., np.newaxis]])


def _at(times: Array, known: Array, values: Array) -> Array:
    """Values (n, b, k) known at some times, at others."""
    right = np.clip(np.searchsorted(known, times, side="right"), 1, len(known) - 1)
    share = np.clip((times - known[right - 1]) / (known[right] - known[right - 1]), 0.0, 1.0)[:, None, None]
    return np.asarray(values[right - 1] * (1 - share) + values[right] * share, dtype=np.float64)


def _unit(orientations: Array) -> Array:
    return np.asarray(orientations / np.linalg.norm(orientations, axis=-1, keepdims=True), dtype=np.float64)


# Packing


def pack(poses: Poses, profile: str, key: str, fingerprint: str) -> Track:
    """Pack poses into plain data, which is small and can be pickled."""
    rate = round(1 / poses.times[1])
    packed = zlib.compress(_whole(poses).tobytes(), level=1)  # once more and better when they are written
    return Track(profile, key, fingerprint, poses.bodies, rate, len(poses.times), packed)


def unpack(track: Track, title: str, recording: str = "") -> Poses:
    """The poses in a track, but for what rounding took."""
    found = _steps(np.frombuffer(zlib.decompress(track.packed), dtype="<u4"), track)
    orientations = _unit(np.asarray(found[..., 3:], dtype=np.float64) * TURN)
    times = np.arange(track.count) / track.rate
    return Poses(
        title, track.bodies, times, np.asarray(found[..., :3], dtype=np.float64) * LENGTH, orientations, recording
    )


def _whole(poses: Poses) -> NDArray[np.uint32]:
    """Positions and orientations in whole steps: (b, 7, n), each row its first value, slope, and second differences.

    A free flight has second differences near one constant, and zigzag makes small numbers of either sign small: that
    is what compression needs.
    """
    positions = np.clip(poses.positions, -FARTHEST, FARTHEST) / LENGTH
    steps = np.rint(np.concatenate([positions, poses.orientations / TURN], axis=-1)).astype(np.int64)
    twice = np.diff(steps, n=2, axis=0, prepend=np.zeros((2, *steps.shape[1:]), dtype=np.int64))
    zigzag = np.where(twice < 0, -2 * twice - 1, 2 * twice)
    return np.ascontiguousarray(np.moveaxis(zigzag, 0, -1).astype("<u4"))


def _steps(zigzag: NDArray[np.uint32], track: Track) -> NDArray[np.int64]:
    values = zigzag.astype(np.int64).reshape(len(track.bodies), _PARTS, track.count)
    twice = np.where(values % 2 == 1, -(values + 1) // 2, values // 2)
    return np.moveaxis(np.cumsum(np.cumsum(twice, axis=-1), axis=-1), -1, 0)


# Files


def write_tracks(path: Path, tracks: Iterable[Track], made: Mapping[str, str]) -> None:
    """Write tracks into one `.npz`: poses and curves, byte by byte in planes, and an index.

    The same tracks make the same bytes. made: where and when they were recorded.
    """
    tracks = sorted(tracks, key=lambda track: (track.profile, track.key))
    index = {"schema": SCHEMA, "version": VERSION, "made": dict(made), "tracks": [_entry(track) for track in tracks]}
    planes = _planes(b"".join(zlib.decompress(track.packed) for track in tracks))
    curves = _planes(b"".join(track.curve for track in tracks))
    text = np.frombuffer(json.dumps(index, ensure_ascii=False).encode(), dtype=np.uint8)
    with zipfile.ZipFile(path, "w") as file:
        for name, values in (("index", text), ("planes", planes), ("curves", curves)):
            entry = zipfile.ZipInfo(f"{name}.npy", _NO_DATE)
            entry.compress_type, entry.create_system = zipfile.ZIP_DEFLATED, 3
            content = io.BytesIO()
            np.lib.format.write_array(content, np.ascontiguousarray(values), allow_pickle=False)
            file.writestr(entry, content.getvalue(), compresslevel=9)


def _planes(numbers: bytes) -> NDArray[np.uint8]:
    """Numbers of four bytes as all first bytes, all second ones …, which compresses better."""
    return np.frombuffer(numbers, dtype=np.uint8).reshape(-1, 4).T


def _numbers(planes: NDArray[np.uint8]) -> bytes:
    return np.ascontiguousarray(planes.T).tobytes()


def read_tracks(path: Path) -> tuple[dict[tuple[str, str], Track], dict[str, str]]:
    """The tracks of a file by profile and key, and where and when they were recorded; nothing where there is no file.

    Raises
    ------
    InvalidInput
        If the file holds no poses, or those of another version.
    """
    if not path.exists():
        return {}, {}
    try:
        with np.load(path, allow_pickle=False) as content:
            index = json.loads(content["index"].tobytes())
            numbers, points = _numbers(content["planes"]), _numbers(content["curves"]) if "curves" in content else b""
        known = index["schema"], index["version"]
    except (OSError, ValueError, KeyError, TypeError, zipfile.BadZipFile, zlib.error) as error:
        raise InvalidInput(f"{str(path)!r} holds no poses: {error}") from None
    if known != (SCHEMA, VERSION):
        raise InvalidInput(f"{str(path)!r} holds no poses of version {VERSION}; collisions record makes new ones")
    found, start, first = {}, 0, 0
    for entry in index["tracks"]:
        entry["bodies"] = tuple(entry["bodies"])
        end, last = start + 4 * _PARTS * len(entry["bodies"]) * entry["count"], first + entry.pop("curve")
        packed, curve = zlib.compress(numbers[start:end], level=1), points[first:last]
        found[entry["profile"], entry["key"]] = Track(**entry, packed=packed, curve=curve)
        start, first = end, last
    return found, index["made"]


def _entry(track: Track) -> dict[str, Any]:
    """What stands in the index: of the poses nothing, and of the curve how many bytes it has."""
    own = {field.name: getattr(track, field.name) for field in fields(track) if field.name != "packed"}
    return own | {"curve": len(track.curve)}
