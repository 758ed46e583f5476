"""Runs a survey: answers its questions by an implementation's rays and distances.

No engine can say whether a point is inside. A point is inside where a ray from it crosses the surface an odd number of
times, or where a tiny ball at that point overlaps the solid; `inside_by` says which of the two is used. The length of a
segment within a solid follows from its crossings.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Protocol, runtime_checkable

import numpy as np

from reference.arrays import Array
from reference.engines.base import Engine
from reference.errors import CannotExpress
from reference.scene.polyhedron import Polyhedron
from reference.scene.query import Distance, Inside, Query, Ray, Segment, bodies_of
from reference.scene.scenario import Body, Box, Shape, Sphere
from reference.scene.settings import Option, Settings
from reference.scene.survey import Survey, at_time, survey
from reference.scene.trajectory import Trajectory

RAYS_OF, DISTANCES_OF, INSIDE_BY, MESH_MARGIN = "rays_of", "distances_of", "inside_by", "mesh_margin"
"""Settings: what a solid is to an engine's rays and to its distances, what stands in for the question whether a point
is inside, and by how much a shape is thicker than its vertices say, m."""
CONTACTS_OF = "contacts_of"
"""Setting: what a solid is to the contacts of a run, as the first two of the settings above say it of questions."""
TRIANGLES, HULL, PIECES = "triangles", "hull", "pieces"
RAYS, BALL = "rays", "ball"
TIMESTEP = 0.02
"""Time between two samples of a survey, s: 50 questions on a way of one second."""
TINY = 1e-6
"""Radius of the ball that asks whether a point is inside, m."""
AWAY = (0.36, 0.48, 0.8)
"""Direction of the ray that asks whether a point is inside, a unit vector that is no axis of a scene."""
SAME = 1e-9
"""Crossings that are nearer to each other than this share of the way are one: the ray goes through an edge."""


PAST = 1e-7
"""Share of the way by which the search for the next crossing begins behind the last one."""


class Surveyor(Protocol):
    """What an implementation has to know: where a segment goes through a surface, and how far two bodies are apart."""

    def crossings(self, body: Body, start: tuple[float, ...], end: tuple[float, ...]) -> list[float]:
        """The shares of the way from start to end, m, at which it goes through the body's surface, in any order."""
        ...

    def gap(self, body_a: Body, body_b: Body) -> float:
        """How far the surfaces are apart, m; negative where the bodies overlap."""
        ...


@runtime_checkable
class KnowsInside(Protocol):
    """What an implementation may know besides: whether a point is inside."""

    def inside(self, query: Inside) -> float:
        """1 or 0."""
        ...


def allowed(rays_of: tuple[str, ...], distances_of: tuple[str, ...]) -> dict[str, tuple[str, ...]]:
    """What each setting of a survey may be, from what an engine knows."""
    return {RAYS_OF: rays_of, DISTANCES_OF: distances_of, INSIDE_BY: (RAYS, BALL)}


def settings_of(**options: Option) -> Settings:
    """Settings for a survey."""
    return Settings(TIMESTEP, options=options)


def is_of_solids(query: Query) -> bool:
    """Whether a question is answered by way of a survey."""
    return isinstance(query, Inside | Segment) or any(isinstance(body.shape, Polyhedron) for body in bodies_of(query))


def ask(engine: Engine, query: Query) -> float:
    """The answer of an engine to one question, in the profile that counts."""
    alone = survey("query", [("asked", query)])
    return float(engine.run(alone, engine.settings(alone, next(iter(engine.profiles(alone))))).answers[0])


def run(engine: Engine, surveyor: Surveyor, scenario: Survey, settings: Settings) -> Trajectory:
    """Ask all questions, and those that are watched at every sample; each body flies straight on."""
    check(engine, scenario)
    samples = engine.check_settings(scenario, settings) // settings.sample_every
    times = np.arange(samples + 1, dtype=np.float64) * settings.sample_every * settings.timestep
    answers = [answer(surveyor, query, settings) for _, query in scenario.questions]
    watched = [
        [surveyor.gap(at_time(each.body_a, time), at_time(each.body_b, time)) for each in scenario.watched]
        for time in times.tolist()
    ]
    return trajectory_of(engine.name, scenario, settings, answers, watched)


def trajectory_of(
    name: str, scenario: Survey, settings: Settings, answers: list[float], watched: list[list[float]]
) -> Trajectory:
    """The trajectory of a survey: straight flights, and the answers."""
    times = np.arange(len(watched), dtype=np.float64) * settings.sample_every * settings.timestep
    states = np.tile(np.array([body.state() for body in scenario.bodies]), (len(times), 1, 1))
    states[..., :3] += times[:, None, None] * states[..., 7:10]
    position, orientation, velocity, spin = np.split(states, (3, 7, 10), axis=-1)
    return Trajectory(
        scenario, settings, name, times, position, orientation, velocity, spin,
        answers=np.array(answers), watched=np.array(watched).reshape(len(times), -1),
    )  # fmt: skip


def check(engine: Engine, scenario: Survey) -> None:
    """Refuse questions that nobody here has words for."""
    for query in (*dict(scenario.questions).values(), *scenario.watched):
        first, *others = sorted((body.shape for body in bodies_of(query)), key=lambda shape: not _is_solid(shape))
        if not _is_solid(first) or not all(isinstance(shape, Polyhedron | Box | Sphere) for shape in others):
            names = " and ".join(sorted(type(body.shape).__name__ for body in bodies_of(query)))
            raise engine.cannot(
                scenario,
                f"a survey asks about a polyhedron, or how far it is from another, a box or a ball, not {names}",
            )


def _is_solid(shape: Shape) -> bool:
    return isinstance(shape, Polyhedron)


def answer(surveyor: Surveyor, query: Query, settings: Settings) -> float:
    """Answer one question."""
    match query:
        case Distance():
            return surveyor.gap(query.body_a, query.body_b)
        case Ray():
            end = tuple(np.add(query.start, query.way).tolist())
            return min(surveyor.crossings(query.body, query.start, end), default=math.inf)
        case Segment():
            return _within(surveyor, query)
        case Inside():
            if isinstance(surveyor, KnowsInside):
                return surveyor.inside(query)
            if settings.options.get(INSIDE_BY, RAYS) == BALL:
                probe = Body("probe", Sphere(TINY), position=query.point)
                return float(surveyor.gap(query.body, probe) < 0)
            return _parity(surveyor, query.body, query.point)
    raise CannotExpress(f"a survey has no words for a {type(query).__name__}")


def _parity(surveyor: Surveyor, body: Body, point: tuple[float, ...]) -> float:
    """1 where a ray to a place beyond the solid crosses the surface an odd number of times, else 0."""
    assert isinstance(body.shape, Polyhedron)
    centre = np.array(body.position)
    beyond = np.linalg.norm(centre - point) + 2 * np.max(np.linalg.norm(body.shape.points, axis=-1))
    end = tuple((np.array(point) + beyond * np.array(AWAY)).tolist())
    return float(len(once(surveyor.crossings(body, point, end))) % 2)


def _within(surveyor: Surveyor, query: Segment) -> float:
    """The length between each odd crossing and the next."""
    found = once(surveyor.crossings(query.body, query.start, query.end))
    shares = [after - before for before, after in list(pairwise(found))[::2]]
    return float(np.linalg.norm(np.subtract(query.end, query.start)) * sum(shares))


def marched(first: Callable[[Array], float], start: tuple[float, ...], end: tuple[float, ...]) -> list[float]:
    """All crossings, for an engine that gives the first alone: the search goes on behind each.

    first: from a place, m, the share of the whole way to the next crossing; infinite or negative where there is none.
    """
    way, share, found = np.subtract(end, start), 0.0, list[float]()
    while share < 1:
        hit = first(np.add(start, share * way))
        if not 0 <= hit <= 1 - share:
            break
        found.append(share + hit)
        share += hit + PAST
    return found


def once(shares: list[float]) -> list[float]:
    """The shares in their order, each once: an edge is crossed with two triangles."""
    found: list[float] = []
    for share in sorted(shares):
        if not found or share - found[-1] > SAME:
            found.append(share)
    return found
