"""Making clips: of a scenario and the poses of its runs, or of a mesh of springs."""

from __future__ import annotations

import itertools
from collections.abc import Collection, Mapping, Sequence

import numpy as np

from reference.arrays import Array
from reference.checks import Vector
from reference.errors import InvalidInput
from reference.scene import geometry
from reference.scene.query import bodies_of
from reference.scene.scenario import Body, Scenario
from reference.scene.survey import Survey
from reference.viewer.clip import DASHES, LOOKS, Clip, Run, Solid
from reference.viewer.contacts import touches
from reference.viewer.picture_bounds import framed
from reference.viewer.poses import FARTHEST, Poses


def clip(scenario: Scenario, runs: Mapping[str, Poses], title: str = "", hidden: Collection[str] = ()) -> Clip:
    """Make a clip of a scenario and of poses by name; the first of them is drawn solid, the others in outline.

    A name that is an engine's gives the run that engine's line style. hidden: names of runs that are there to be
    switched on. A run ends where its poses end, or are not finite any more.

    Raises
    ------
    InvalidInput
        If the runs are not sampled alike, or a body is not in the scenario.
    """
    rate, looks = _rate(runs), _looks(runs)
    solids = tuple(Solid(body.name, body.shape, body.position, body.orientation) for body in _drawn(scenario))
    found = [_run(scenario, poses, name, looks[name], name not in hidden) for name, poses in runs.items()]
    ends = _ends(scenario)
    springs = tuple(
        (ends[spring.body_a, spring.point_a], ends[spring.body_b, spring.point_b]) for spring in scenario.springs
    )
    return framed(Clip(title or scenario.name, rate, solids, tuple(found), springs))


def _drawn(scenario: Scenario) -> tuple[Body, ...]:
    """The bodies of a clip: of a survey only those that are watched, which those of its questions would hide."""
    if not isinstance(scenario, Survey):
        return scenario.bodies
    watched = {body.name for query in scenario.watched for body in bodies_of(query)}
    return tuple(body for body in scenario.bodies if body.name in watched)


def _run(scenario: Scenario, poses: Poses, name: str, look: int, shown: bool) -> Run:
    for body in poses.bodies:
        scenario.body(body)  # or it is refused
    count = _whole(np.concatenate([poses.positions, poses.orientations], axis=-1))
    positions = np.clip(poses.positions[:count], -FARTHEST, FARTHEST)
    whole = Poses(poses.title, poses.bodies, poses.times[:count], positions, poses.orientations[:count])
    values = np.concatenate([positions, whole.orientations], axis=-1)
    found = tuple(touches(scenario, whole))
    return Run(poses.title or name, look, poses.bodies, values, _points(scenario, whole), found, shown, poses.recording)


def _ends(scenario: Scenario) -> dict[tuple[str, Vector], int]:
    """The points at which springs end, by body and by the point in its own axes, each once, with its number."""
    both = (((it.body_a, it.point_a), (it.body_b, it.point_b)) for it in scenario.springs)
    return {end: number for number, end in enumerate(dict.fromkeys(itertools.chain.from_iterable(both)))}


def _points(scenario: Scenario, poses: Poses) -> Array:
    """Where springs end at each sample, (n, ends, 3), m."""
    found = np.zeros((len(poses.times), len(_ends(scenario)), 3))
    for (name, point), number in _ends(scenario).items():
        if name in poses.bodies:
            body = poses.bodies.index(name)
            found[:, number] = poses.positions[:, body] + geometry.rotate(poses.orientations[:, body], np.array(point))
        elif name:
            body_at = scenario.body(name)
            found[:, number] = body_at.position + geometry.rotate(np.array(body_at.orientation), np.array(point))
        else:
            found[:, number] = point
    return found


def mesh_clip(
    title: str,
    springs: Sequence[tuple[int, int]],
    runs: Mapping[str, Array],
    rate: int = 60,
    solids: Sequence[Solid] = (),
) -> Clip:
    """Make a clip of a mesh of springs: points (n, p, 3), m, by name of the run; the springs join two points each.

    solids: bodies that stand beside it.

    Raises
    ------
    InvalidInput
        If the points have another shape, or a spring joins points that are not there.
    """
    looks, found = _looks(runs), []
    for name, given in runs.items():
        points = np.asarray(given, dtype=np.float64)
        if points.ndim != 3 or points.shape[2] != 3:
            raise InvalidInput(f"{title}: the points of {name} have shape {points.shape}; expected (n, p, 3)")
        for pair in springs:
            if not all(0 <= end < points.shape[1] for end in pair):
                raise InvalidInput(f"{title}: spring {pair} is none of the {points.shape[1]} points of {name}")
        count = _whole(points)
        found.append(Run(name, looks[name], (), np.zeros((count, 0, 7)), np.clip(points[:count], -FARTHEST, FARTHEST)))
    pairs = tuple((int(start), int(end)) for start, end in springs)
    return framed(Clip(title, rate, tuple(solids), tuple(found), pairs))


def _rate(runs: Mapping[str, Poses]) -> int:
    """Samples a second, the same in all runs."""
    rates = {name: round(1 / float(poses.times[1])) for name, poses in runs.items() if len(poses.times) > 1}
    if len(set(rates.values())) > 1:
        said = ", ".join(f"{name} {rate}" for name, rate in rates.items())
        raise InvalidInput(f"a replay needs runs that are sampled alike; samples a second here: {said}")
    return next(iter(rates.values()), 60)


def _looks(names: Collection[str]) -> dict[str, int]:
    """The look of each run: an engine's own, or the next that nobody has; the first is drawn solid."""
    taken = {LOOKS[name] for name in names if name in LOOKS}
    others = [look for look in range(1, len(LOOKS)) if look not in taken]
    free = itertools.cycle([*range(len(LOOKS), len(DASHES)), *others])
    first = next(iter(names)) if names and 0 not in taken else None
    return {name: LOOKS.get(name, 0) if name in LOOKS or name == first else next(free) for name in names}


def _whole(values: Array) -> int:
    """How many samples, from the first on, are finite as a whole."""
    broken = np.flatnonzero(~np.isfinite(values).all(axis=(1, 2)))
    return int(broken[0]) if broken.size else len(values)
