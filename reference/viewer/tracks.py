"""Tracks: the poses of many runs, packed into one file, and back.

A viewer takes `Poses`; a recording keeps a `Track` of each.
"""

from __future__ import annotations

import io
import json
import zipfile
import zlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reference.errors import InvalidInput
from reference.viewer.packing import second_differences
from reference.viewer.poses import FARTHEST, Poses, unit_quaternions
from reference.writable import write_whole

SCHEMA, VERSION = "collisions-lab/poses", 2
LENGTH, TURN = 1e-5, 1e-4
"""Steps in which positions, m, and the parts of quaternions are kept."""
_PARTS = 7
"""Of a pose: three of the position, four of the quaternion."""
_NO_DATE = (1980, 1, 1, 0, 0, 0)
"""The first that a zip file knows: the same poses make the same bytes on every day."""


@dataclass(frozen=True)
class Track:
    """Packed poses of one run; plain data.

    profile, key: of which profile and which case. fingerprint: of the scenario and settings. rate: samples a second, of
    which there are `count`. packed: `LENGTH` and `TURN` as steps, second differences, compressed. curve: what is
    plotted of the run, as `reference.comparison.curves` packs it; empty if none was wanted.
    """

    profile: str
    key: str
    fingerprint: str
    bodies: tuple[str, ...]
    rate: int
    count: int
    packed: bytes
    curve: bytes = b""


def pack(poses: Poses, profile: str, key: str, fingerprint: str) -> Track:
    """Pack poses into plain data, which is small and can be pickled."""
    rate = round(1 / poses.times[1])
    packed = zlib.compress(_whole_steps(poses).tobytes(), level=1)  # again and better when they are written
    return Track(profile, key, fingerprint, poses.bodies, rate, len(poses.times), packed)


def unpack(track: Track, title: str, recording: str = "") -> Poses:
    """The poses in a track, rounded to `LENGTH` and `TURN`."""
    found = _values(np.frombuffer(zlib.decompress(track.packed), dtype="<u4"), track)
    orientations = unit_quaternions(np.asarray(found[..., 3:], dtype=np.float64) * TURN)
    times = np.arange(track.count) / track.rate
    return Poses(
        title, track.bodies, times, np.asarray(found[..., :3], dtype=np.float64) * LENGTH, orientations, recording
    )


def _whole_steps(poses: Poses) -> NDArray[np.uint32]:
    """Positions and orientations in whole steps: (b, 7, n), each row its first value, slope, and second differences.

    A free flight has second differences near one constant, and zigzag makes small numbers of either sign small: that
    is what compression needs.
    """
    positions = np.clip(poses.positions, -FARTHEST, FARTHEST) / LENGTH
    steps = np.rint(np.concatenate([positions, poses.orientations / TURN], axis=-1)).astype(np.int64)
    return np.ascontiguousarray(np.moveaxis(second_differences(steps), 0, -1).astype("<u4"))


def _values(zigzag: NDArray[np.uint32], track: Track) -> NDArray[np.int64]:
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
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as file:
        for name, values in (("index", text), ("planes", planes), ("curves", curves)):
            entry = zipfile.ZipInfo(f"{name}.npy", _NO_DATE)
            entry.compress_type, entry.create_system = zipfile.ZIP_DEFLATED, 3
            content = io.BytesIO()
            np.lib.format.write_array(content, np.ascontiguousarray(values), allow_pickle=False)
            file.writestr(entry, content.getvalue(), compresslevel=9)
    write_whole(path, packed.getvalue())


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
    """The entry of a track in the index: everything except its poses, and of its curve the number of bytes."""
    own = {field.name: getattr(track, field.name) for field in fields(track) if field.name != "packed"}
    return own | {"curve": len(track.curve)}
