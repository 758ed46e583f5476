"""The split of an error in words: where it comes from, as the page prints it."""

from __future__ import annotations

from dataclasses import dataclass

from reference.comparison.convergence import ROUNDING
from reference.comparison.error_split import CONTACT_MODEL, DEFAULTS, DISCRETISATION, REMAINDER, SOLVER, Split
from reference.engines.profiles import PLAIN_OF
from reference.report import numbers
from reference.report.sections import Line, Section

_KINDS = (DISCRETISATION, CONTACT_MODEL, SOLVER, REMAINDER)
VISIBLE = 0.01
"""A move has no visible effect if it changes less than this share of the largest change, or of the error itself."""


@dataclass(frozen=True)
class Step:
    """One move: which share of the error it shows, what was moved, the errors before and after, and its size."""

    kind: str
    moved: str
    before: str
    after: str
    size: str


@dataclass(frozen=True)
class Origin:
    """The split of one engine's error.

    title: the engine. quantity, case: whose error it is. steps: the moves with an effect. idle: those without one.
    sentence: all shares together.
    """

    title: str
    quantity: str
    case: str
    steps: tuple[Step, ...]
    idle: tuple[str, ...]
    sentence: str


def origins(section: Section) -> list[Origin]:
    """The splits of a family's lines, one an engine."""
    return [_origin(section, line, line.result.split) for line in section.lines if line.result.split is not None]


def _origin(section: Section, line: Line, split: Split) -> Origin:
    quantity, case = section.family.quantity(split.quantity), section.family.case(split.case)
    scale = quantity.scale(case) if quantity.scale else None

    def text(error: float | None) -> str:
        if error is None:
            return "no such number"
        return numbers.percent(error / scale) if scale else numbers.deviation(error, quantity.unit)

    sizes = [abs(share.size) for share in split.shares if share.size is not None]
    floor = VISIBLE * max((size for size in sizes if size > 0), default=0.0)
    error, profile = _own_error(split), line.result.job.profile
    steps, idle = [], []
    for share in split.shares:
        least = floor if share.kind == DEFAULTS else VISIBLE * abs(error)
        if share.size is not None and abs(share.size) <= least:
            idle.append(share.moved if share.kind != REMAINDER else REMAINDER)
        else:
            steps.append(Step(share.kind, share.moved, text(share.before), text(share.after), text(share.size)))
    plain = next((share.before for share in split.shares if share.kind == DEFAULTS), None)
    opening = f"{profile}: {text(error)}.".capitalize()
    if plain is not None:
        opening = f"{PLAIN_OF[profile].capitalize()} is off by {text(plain)}, {profile} by {text(error)}."
    if abs(error) <= ROUNDING * abs(scale or 1.0):
        opening += " That is rounding: there is nothing left to split."
        steps = [step for step in steps if step.kind == DEFAULTS]
    else:
        parts = [f"{text(_total(split, kind))} {kind}" for kind in _KINDS if _has(split, kind)]
        opening += f" {'It' if plain is None else 'The latter'} is made up of {', '.join(parts)}."
    return Origin(line.result.title, quantity.title, split.case, tuple(steps), tuple(idle), opening)


def _own_error(split: Split) -> float:
    before = next(share.before for share in split.shares if share.kind == REMAINDER)
    assert before is not None
    return before


def _has(split: Split, kind: str) -> bool:
    return any(share.kind == kind for share in split.shares)


def _total(split: Split, kind: str) -> float:
    """All shares of a kind together."""
    return sum(share.size or 0.0 for share in split.shares if share.kind == kind)
