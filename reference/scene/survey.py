"""A survey: a scenario in which nothing happens except that questions of geometry are asked."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from reference.errors import InvalidInput, UnknownName
from reference.scene.query import Distance, Query, asked_of, bodies_of
from reference.scene.scenario import Body, Scenario


@dataclass(frozen=True)
class Survey(Scenario):
    """Questions to an implementation, as a scenario, so that they go the way of all scenarios.

    questions: with their names, asked once, of the bodies as they start. watched: distances that are asked at every
    sample. No two bodies collide, nothing pulls and no force acts: what has a velocity flies straight on. The bodies
    are the truth: each question is about the body of that name.
    """

    questions: tuple[tuple[str, Query], ...] = ()
    watched: tuple[Distance, ...] = ()

    def __post_init__(self) -> None:
        super().__post_init__()
        acts = self.pairs or self.forces or self.pushes_change or any(self.gravity)
        if acts or any(any(body.angular_velocity) for body in self.bodies):
            raise InvalidInput(f"{self.name}: in a survey nothing collides, pulls or turns")
        names = [name for name, _ in self.questions]
        if len(set(names)) != len(names) or not names:
            raise InvalidInput(f"{self.name}: each question needs a name of its own; there are {names}")
        known = {body.name: body for body in self.bodies}
        for query in (*dict(self.questions).values(), *self.watched):
            for body in bodies_of(query):
                self.body(body.name)
        object.__setattr__(self, "questions", tuple((name, asked_of(query, known)) for name, query in self.questions))
        object.__setattr__(self, "watched", tuple(asked_of(query, known) for query in self.watched))

    def place(self, question: str) -> int:
        """The place of a question, and so of its answer in a trajectory."""
        for place, (name, _) in enumerate(self.questions):
            if name == question:
                return place
        raise UnknownName("question", question, (name for name, _ in self.questions))


def survey(
    name: str, questions: Iterable[tuple[str, Query]], watched: Iterable[Distance] = (), duration: float = 1.0
) -> Survey:
    """A survey of the bodies that its questions are about."""
    questions, watched = tuple(questions), tuple(watched)
    bodies = dict[str, Body]()
    for query in [*(query for _, query in questions), *watched]:
        for body in bodies_of(query):
            if bodies.setdefault(body.name, body) != body:
                raise InvalidInput(f"{name}: two bodies that it asks about share the name {body.name!r}")
    still = (0.0, 0.0, 0.0)
    return Survey(name, tuple(bodies.values()), (), duration, still, questions=questions, watched=watched)


def at_time(body: Body, time: float) -> Body:
    """The body as it is after so many seconds of straight flight."""
    x, y, z = (start + time * speed for start, speed in zip(body.position, body.velocity, strict=True))
    return replace(body, position=(x, y, z))
