"""Tells a student whose functions are right for one case alone what the lab did about it, and how to write for many."""

from __future__ import annotations

from collections.abc import Iterator

from labs.grading.feedback.error_advice import Advice
from labs.grading.judging.score_sheet import Sheet
from labs.grading.wrapping import INDENT, folded
from reference import lecture

_DONE = (
    "Where a test has several cases in one call, the lab called it for one case after the other instead, and those"
    " answers are right. That costs one part of the {topic} lab, this one, however many of its functions do it. But a"
    " function of yours that hands it several cases in one call gets no right numbers from it, and loses its own parts"
    " until this one is mended."
)
_HOW = "To turn a function of one case into one of many:"
_WHERE = "It is written for one case. The check of {at} shows how to write for one or many."
_FORMS = (
    ("for one case", "for one or many"),
    ("x = v[0]", "x = v[..., 0]"),
    ("np.dot(a, b), a @ b", "np.sum(a * b, axis=-1)"),
    ("np.linalg.norm(a)", "np.linalg.norm(a, axis=-1)"),
    ("matrix @ a", "(matrix @ a[..., None])[..., 0]"),
    ("j * n", "np.asarray(j)[..., None] * n"),
    ("b if s < 0 else c", "np.where(s < 0, b, c)"),
    ("  with vectors b and c", "np.where((s < 0)[..., None], b, c)"),
)


def in_short(sheet: Sheet, name: str, before: str = "  ") -> str:
    """What is said beside a function that loses nothing although it is right for one case alone."""
    return f"{before}for one case at a time" if name in sheet.case_by_case.functions else ""


def explained(sheet: Sheet, name: str, advice: Advice) -> Iterator[str]:
    """What the lab did about a function that is right for one case alone, and how to write it.

    The forms are shown once, at the function that loses a part of the lab; others refer to it.
    """
    if name not in sheet.case_by_case.functions:
        return
    topic = lecture.function(name).topic
    loser = sheet.case_by_case.paid.get(topic, name)
    if loser != name:
        yield from folded(_WHERE.format(at=loser), 1)
        return
    if topic in sheet.case_by_case.paid:
        yield from folded(_DONE.format(topic=topic), 1)
    if advice.is_new(_HOW):
        yield from folded(_HOW, 1)
        width = max(len(one) for one, _ in _FORMS) + 2
        yield from (f"{INDENT * 2}{one:<{width}}{many}" for one, many in _FORMS)
