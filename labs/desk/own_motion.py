"""A ball that a loop in the notebook moves, in a replay beside recordings of the same fall in engines.

`lab.run` moves bodies with the hand-written world, which asks for functions of other labs. Where a lab has a loop of
its own, that loop returns the ball's places, and this module shows them.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from labs.desk.display import Replay
from labs.desk.stock import recorded
from reference.arrays import Array
from reference.catalogue.scenarios import find
from reference.engines.handwritten.surveyor import posed
from reference.engines.profiles import STOCK, TUNED
from reference.errors import InvalidInput
from reference.scene.polyhedron import Polyhedron
from reference.scene.scenario import Scenario, Sphere
from reference.scene.surfaces import hull_faces
from reference.viewer import page
from reference.viewer.clip_making import clip
from reference.viewer.picture_bounds import seen_into
from reference.viewer.poses import Poses, rate_of
from reference.viewer.tracks import unpack

YOURS = "yours"


@dataclass(frozen=True, eq=False)
class Fall:
    """A ball that falls onto a solid, in the frame of the world.

    vertices: (v, 3), m. faces: (f, 3), indices. pieces: the vertices and faces of each convex piece. start: the ball's
    centre, (3,), m. radius: m. restitution: of an impact. duration: s.
    """

    vertices: Array
    faces: NDArray[np.int64]
    pieces: tuple[tuple[Array, NDArray[np.int64]], ...]
    start: Array
    radius: float
    restitution: float
    duration: float


def fall(case: str) -> Fall:
    """The `solid` and the `ball` of a case such as `ball-in-a-bowl/hull`.

    Raises
    ------
    InvalidInput, UnknownName
        If there is no such case, it has no bodies of these names, or they have other shapes.
    """
    scenario = first_scenario(case)
    solid, ball = scenario.body("solid"), scenario.body("ball")
    if not (isinstance(solid.shape, Polyhedron) and isinstance(ball.shape, Sphere)):
        raise InvalidInput(f"{case} is no ball that falls onto a polyhedron")
    vertices = posed(solid)
    pieces = tuple((vertices[list(piece)], _triangles(vertices[list(piece)])) for piece in solid.shape.convex_pieces)
    return Fall(
        vertices,
        np.array(solid.shape.faces),
        pieces,
        np.array(ball.position),
        ball.shape.radius,
        scenario.pairs[0].restitution,
        scenario.duration,
    )


def beside(
    case: str, places: ArrayLike, engines: Sequence[str], *, stock: bool = False, times: ArrayLike | None = None
) -> Replay:
    """A replay of your own ball beside engines, seen from obliquely above.

    case: `family/case`. places: (n, 3), m, the ball's centre at n instants: at `times`, (n,), s, which rise; without
    them, at instants that divide the case's duration evenly, from its start to its end. engines: such as `("mujoco",
    "dart")`. stock: whether they are shown as they come.

    Raises
    ------
    InvalidInput, UnknownName
        If the places or times are not of that form or not finite, there is no such case or engine, it has no recording,
        or several bodies move in the case.
    """
    way = np.asarray(places, dtype=float)
    if way.ndim != 2 or way.shape[1] != 3 or len(way) < 2:
        raise InvalidInput(f"places must have the shape (n, 3), not {way.shape}")
    if not np.all(np.isfinite(way)):
        raise InvalidInput("places must be finite: somewhere the ball is at inf or NaN")
    scenario = first_scenario(case)
    moving = tuple(body.name for body in scenario.bodies if not body.immovable)
    if len(moving) != 1:
        raise InvalidInput(f"in {case} these bodies move: {', '.join(moving)}")
    known = np.linspace(0.0, scenario.duration, len(way)) if times is None else np.asarray(times, dtype=float)
    if known.shape != (len(way),) or not np.all(np.diff(known) >= 0):
        raise InvalidInput(f"times must be {len(way)} rising instants, one for each place")

    def poses(instants: Array) -> tuple[Array, Array]:
        ball = np.stack([np.interp(instants, known, along) for along in way.T], axis=-1)[:, None]
        return ball, np.broadcast_to([1.0, 0.0, 0.0, 0.0], (len(instants), 1, 4))

    return replay_beside(case, moving, poses, engines, stock=stock)


def replay_beside(
    case: str,
    bodies: tuple[str, ...],
    poses: Callable[[Array], tuple[Array, Array]],
    engines: Sequence[str],
    *,
    stock: bool = False,
    oblique: bool = True,
) -> Replay:
    """A replay of your own bodies beside engines.

    bodies: the names of all that move. poses: of these bodies at n instants, places (n, bodies, 3), m, and orientations
    (n, bodies, 4). oblique: whether it is seen from obliquely above.

    Raises
    ------
    InvalidInput, UnknownName
        If there is no such case or engine, or it has no recording.
    """
    scenario = first_scenario(case)
    times = np.arange(round(scenario.duration * rate_of(scenario)) + 1) / rate_of(scenario)
    found = {YOURS: Poses(YOURS, bodies, times, *poses(times))}
    family, chosen, results = recorded(case, engines, STOCK if stock else TUNED)
    for result in results:
        title = f"{result.title}, stock" if stock else result.title
        found[result.job.engine] = unpack(result.poses[0], title, result.recording)
    title = f"{family.title}, {chosen.name}: {', '.join(each.title for each in found.values())}"
    whole = clip(scenario, found, title)
    return Replay(
        f'<div style="max-width:640px">{page.frame(seen_into(whole) if oblique else whole)}</div>',
        f"[replay: {', '.join(each.title for each in found.values())}]",
    )


def _triangles(corners: Array) -> NDArray[np.int64]:
    """The faces of the hull of some corners, each cut into triangles from its first corner."""
    return np.array([(a, b, c) for a, *rest in hull_faces(corners) for b, c in itertools.pairwise(rest)])


def first_scenario(case: str) -> Scenario:
    """The first scenario of a case, which its replay shows; raises `InvalidInput` if the case is not named in full."""
    family, chosen = find(case)
    if chosen is None:
        raise InvalidInput(f"{case!r} names no case: give family/case, such as {family.name}/{family.curve.case}")
    return chosen.scenarios[0]
