"""The split of an error as text: where it comes from, as the page prints it."""

from __future__ import annotations

from dataclasses import dataclass

from reference.comparison.convergence import ROUNDING
from reference.comparison.error_split import CONTACT_MODEL, DEFAULTS, DISCRETISATION, REMAINDER, SOLVER, Split
from reference.report import numbers
from reference.report.sections import Section

KINDS = (DISCRETISATION, CONTACT_MODEL, SOLVER, REMAINDER)
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

    title: the engine. quantity, case: whose error it is. plain, counted: the error in the plain profile and in the one
    that counts; plain is empty where it was not measured. shares: what each of `KINDS` makes of the latter, empty where
    nothing was moved; no share at all where that error is rounding. steps: the moves with an effect.
    """

    title: str
    quantity: str
    case: str
    plain: str
    counted: str
    shares: tuple[str, ...]
    steps: tuple[Step, ...]


def origins(section: Section) -> list[Origin]:
    """The splits of a family's lines, one an engine."""
    return [
        _origin(section, line.result.title, line.result.split)
        for line in section.lines
        if line.result.split is not None
    ]


def _origin(section: Section, title: str, split: Split) -> Origin:
    quantity, case = section.family.quantity(split.quantity), section.family.case(split.case)
    scale = quantity.scale(case) if quantity.scale else None

    def text(error: float | None) -> str:
        if error is None:
            return "no such number"
        return numbers.percent(error / scale) if scale else numbers.deviation(error, quantity.unit)

    sizes = [abs(share.size) for share in split.shares if share.size is not None]
    floor = VISIBLE * max((size for size in sizes if size > 0), default=0.0)
    error = _own_error(split)
    steps = []
    for share in split.shares:
        least = floor if share.kind == DEFAULTS else VISIBLE * abs(error)
        if share.size is None or abs(share.size) > least:
            steps.append(Step(share.kind, share.moved, text(share.before), text(share.after), text(share.size)))
    shares = tuple(text(_total(split, kind)) if _has(split, kind) else "" for kind in KINDS)
    if abs(error) <= ROUNDING * abs(scale or 1.0):
        shares, steps = (), [step for step in steps if step.kind == DEFAULTS]
    plain = next((text(share.before) for share in split.shares if share.kind == DEFAULTS), "")
    return Origin(title, quantity.title, split.case, plain, text(error), shares, tuple(steps))


def _own_error(split: Split) -> float:
    before = next(share.before for share in split.shares if share.kind == REMAINDER)
    assert before is not None
    return before


def _has(split: Split, kind: str) -> bool:
    return any(share.kind == kind for share in split.shares)


def _total(split: Split, kind: str) -> float:
    """All shares of a kind together."""
    return sum(share.size or 0.0 for share in split.shares if share.kind == kind)
