"""How late a submission is, and what a person should know of it: that its time is unknown, or that Moodle differs."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import replace

from labs.gradebook.arrivals import Arrival
from labs.gradebook.deadlines import CALLED_LATE, NO_TIME, OTHER_DEADLINE, Deadlines, Lateness
from labs.gradebook.roster import Student
from labs.gradebook.times import Received
from labs.grading.safe_text import one_line


def calling_late(arrivals: Iterable[Arrival]) -> set[str]:
    """The platforms that call some of these submissions late. They have a deadline, so the others were in time."""
    return {arrival.owner.platform for arrival in arrivals if arrival.owner.late}


def lateness(
    arrival: Arrival, student: Student, lab: str, rules: Deadlines, call_late: Collection[str]
) -> tuple[Lateness, list[str]]:
    """How late a submission is by the rules, and notes on it. call_late: the platforms that call some others late."""
    received, notes = _received(arrival, student), []
    late = rules.lateness(student.id, lab, received, arrival.owner.platform in call_late)
    if received.stamp and late.said in (NO_TIME, CALLED_LATE):
        notes.append(f"the platform says {_shown(received)}, which is not a time in one known zone")
    if rules.is_judged_otherwise(student.id, lab, received):
        notes.append(OTHER_DEADLINE)
    return late, notes


def not_there(student: Student) -> str:
    """What is said of a student of whom nothing is in the folder."""
    although = f", although the platform says {_shown(student.received)}" if student.received.stamp else ""
    return f"nothing handed in{although}"


def _received(arrival: Arrival, student: Student) -> Received:
    """When a submission came, as the platform says beside it, or else in its roster."""
    if arrival.received is not None or arrival.stamp:
        return Received(arrival.stamp, arrival.received, called_late=arrival.owner.late)
    return replace(student.received, called_late=arrival.owner.late or student.received.called_late)


def _shown(received: Received) -> str:
    return repr(one_line(received.stamp, 60))
