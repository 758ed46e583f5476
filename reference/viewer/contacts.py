"""Where bodies touch in a replay, and the impulses of their impacts, from the poses alone.

Engines and hand-written code are treated alike. A pair touches where its gap is next to nothing. Momentum that weight
and forces do not account for came through the pairs that could touch just then. In a chain or a tree of bodies the
impulses follow from that. In a ring, as on two grounds at once, they do not, and the smallest impulses are taken.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reference.arrays import Array
from reference.scene.loads import Loads
from reference.scene.scenario import Body, Scenario
from reference.viewer.pair_gaps import Meeting, Places, meeting_of
from reference.viewer.poses import Poses

SUDDEN_FALLS = 2.0
"""An impact changes a velocity by more than so many times what weight changes in a sample, and"""
SUDDEN_SHARE = 0.02
"""by more than this share of the top speed."""
LEAST_IMPULSE = 0.01
"""Share of a pair's largest push below which a push is none."""
SAME_NORMAL = 0.999
"""Cosine of the angle, some 2.5°, by which a normal may turn while a contact stays the same."""
MOST = 200
"""Contacts and impacts of a run that a replay has; what comes later is left out."""


@dataclass(frozen=True)
class Touch:
    """A contact from one sample to another, both included; an impact where it has an impulse.

    body: a moving one. place: of a contact from its centre, of an impact in the world, m. normal: unit, towards it.
    impulse: on it, N s.
    """

    first: int
    last: int
    body: str
    place: tuple[float, ...]
    normal: tuple[float, ...]
    impulse: tuple[float, ...] = ()


def touches(scenario: Scenario, poses: Poses) -> list[Touch]:
    """Contacts and impacts of a run, in the order of time."""
    if len(poses.times) < 3 or not poses.bodies:
        return []
    places = {name: (poses.positions[:, at], poses.orientations[:, at]) for at, name in enumerate(poses.bodies)}
    meetings = [meeting for pair in scenario.pairs if (meeting := meeting_of(scenario, pair, places)) is not None]
    found = [touch for meeting in meetings for touch in _contacts(meeting, places[meeting.body_a.name][0])]
    if not scenario.steering:  # the poses do not say which momentum a body gave to itself
        found += _impacts(scenario, meetings, places, float(poses.times[1]))
    return sorted(found, key=lambda touch: (touch.first, touch.body))[:MOST]


# Contacts that last


def _contacts(meeting: Meeting, centre: Array) -> list[Touch]:
    """The samples in which a pair touches, those together in which its contact stays where it is on the body."""
    near = np.flatnonzero(meeting.gap < meeting.close).tolist()
    offset, spans = meeting.point - centre, list[list[int]]()
    for sample in near:
        if spans and sample == spans[-1][1] + 1 and not _moved(offset, meeting, spans[-1][0], sample):
            spans[-1][1] = sample
        else:
            spans.append([sample, sample])
    return [_touch(first, last, meeting.body_a, offset[first], meeting.normal[first]) for first, last in spans]


def _moved(offset: Array, meeting: Meeting, first: int, sample: int) -> bool:
    far = float(np.linalg.norm(offset[sample] - offset[first]))
    return far > meeting.close or float(meeting.normal[sample] @ meeting.normal[first]) < SAME_NORMAL


def _touch(first: int, last: int, body: Body, place: Array, normal: Array, impulse: Array | None = None) -> Touch:
    def plain(values: Array, digits: int) -> tuple[float, ...]:
        return tuple((np.round(values, digits) + 0.0).tolist())

    pushed = () if impulse is None else tuple(float(f"{part:.3g}") + 0.0 for part in impulse)
    return Touch(first, last, body.name, plain(place, 4), plain(normal, 3), pushed)


# Impacts


def _impacts(scenario: Scenario, meetings: Sequence[Meeting], places: Places, dt: float) -> list[Touch]:
    """Impulses through the pairs, those of neighbouring samples together."""
    loads = _loads(scenario, places, dt)
    gained = {name: _gained(scenario, scenario.body(name), places[name][0], loads[name], dt) for name in places}
    through = np.zeros((len(meetings), len(next(iter(gained.values()))), 3))
    least = _least(scenario, places, dt)
    changes = np.max([np.linalg.norm(gained[name], axis=-1) / scenario.body(name).mass for name in places], axis=0)
    sudden = np.flatnonzero(np.convolve(changes > least, np.ones(3), "same"))  # an impact between samples is in both
    for sample in sudden.tolist():
        able = [at for at, meeting in enumerate(meetings) if _could_touch(meeting, sample)]
        if able:
            through[able, sample] = _shared([meetings[at] for at in able], sample, gained)
    pairs = zip(meetings, through, strict=True)
    return [touch for meeting, impulses in pairs for touch in _gathered(meeting, impulses, least)]


def _loads(scenario: Scenario, places: Places, dt: float) -> dict[str, Array]:
    """The force (n, 3), N, on each body about each sample, from all but weight and contact."""
    samples = len(next(iter(places.values()))[0])
    states = np.tile(np.array([body.state() for body in scenario.bodies]), (samples, 1, 1))
    for name, (positions, orientations) in places.items():
        own = states[:, scenario.index(name)]
        own[:, :3], own[:, 3:7], own[:, 7:10] = positions, orientations, np.gradient(positions, dt, axis=0)
    times = dt * np.arange(samples)
    loads, parts = Loads(scenario), np.split(states, (3, 7, 10), axis=-1)
    if scenario.pushes_change:
        force = np.array([loads.on_bodies(time, *now)[0] for time, *now in zip(times, *parts, strict=True)])
    else:
        force, _ = loads.on_bodies(0.0, *parts)
    return {name: force[:, scenario.index(name)] for name in places}


def _gained(scenario: Scenario, body: Body, positions: Array, force: Array, dt: float) -> Array:
    """Momentum (n, 3), N s, that a body gets about each sample from nothing but contact."""
    free = np.array(scenario.gravity) + force / body.mass
    before = positions[0] - dt * np.array(body.velocity) + free[0] * dt**2 / 2
    velocity = np.diff(np.concatenate([before[None], positions]), axis=0) / dt
    change = np.diff(velocity, axis=0, append=velocity[-1:] + free[-1:] * dt)  # the last sample has nothing after it
    return np.asarray(body.mass * (change - free * dt))


def _least(scenario: Scenario, places: Places, dt: float) -> float:
    """The least change of a velocity, m/s, between two samples that is an impact."""
    ways = [np.linalg.norm(np.diff(positions, axis=0), axis=-1) for positions, _ in places.values()]
    fall = float(np.linalg.norm(scenario.gravity)) * dt
    return max(SUDDEN_FALLS * fall, SUDDEN_SHARE * float(np.max(ways)) / dt, 1e-9)


def _could_touch(meeting: Meeting, sample: int) -> bool:
    """Whether a pair is near enough to have touched between the samples about this one."""
    gap = meeting.gap[max(sample - 1, 0) : sample + 2]
    return bool(gap.min() < meeting.close + np.abs(np.diff(gap)).max())


def _shared(meetings: Sequence[Meeting], sample: int, gained: dict[str, Array]) -> Array:
    """Impulses (m, 3) on each pair's first body that together give the bodies what they gained."""
    rows = {name: 3 * at for at, name in enumerate(gained)}
    columns, of = [], []
    for at, meeting in enumerate(meetings):
        axes = meeting.normal[sample][None] if meeting.frictionless else np.eye(3)
        for axis in axes:
            column = np.zeros(3 * len(rows))
            column[rows[meeting.body_a.name] :][:3] += axis
            if meeting.body_b.name in rows:
                column[rows[meeting.body_b.name] :][:3] -= axis
            columns.append(column)
            of.append((at, axis))
    wanted = np.concatenate([momentum[sample] for momentum in gained.values()])
    sizes, *_ = np.linalg.lstsq(np.stack(columns, axis=1), wanted, rcond=None)
    found = np.zeros((len(meetings), 3))
    for (at, axis), size in zip(of, sizes, strict=True):
        found[at] += size * axis
    return found


def _gathered(meeting: Meeting, impulses: Array, least: float) -> list[Touch]:
    """Impacts of a pair: impulses that push, those in neighbouring samples as one; not what weight alone does."""
    push = np.sum(impulses * meeting.normal, axis=-1)
    enough = least * min(meeting.body_a.mass, meeting.body_b.mass)
    strong = np.flatnonzero(push > max(LEAST_IMPULSE * float(push.max()), 1e-9))
    found = []
    for group in np.split(strong, np.flatnonzero(np.diff(strong) > 1) + 1):
        if group.size and push[group].max() > enough:
            at = int(group[np.argmin(meeting.gap[group])])
            whole = impulses[group].sum(axis=0)
            place, normal = meeting.point[at], meeting.normal[at]
            found.append(_touch(int(group[0]), int(group[-1]), meeting.body_a, place, normal, whole))
    return found
