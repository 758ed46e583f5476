"""Finds functions that pass their tests and are wrong all the same, with the open probes.

Visible tests are few, so a mistake may slip through all of those of its function and show only in another one that
calls it. Before that caller is blamed, the functions that it calls are asked for more. This costs and gives no points.
"""

from __future__ import annotations

import contextlib
import functools
from collections import deque
from collections.abc import Callable, Iterable
from typing import Any

from labs.grading.calling.remote import Remote
from labs.grading.diagnosis.deviations import Right, ask, deviation_of
from labs.grading.diagnosis.findings import Diagnosis
from labs.grading.diagnosis.fingerprints.reading import right_answers
from labs.grading.diagnosis.probes import Probe, probes
from labs.grading.diagnosis.recognition import diagnose
from labs.grading.errors import GraderFailed
from reference.errors import UnknownName


def suspects(names: Iterable[str], remote: Remote) -> dict[str, Diagnosis]:
    """What is wrong with those of some functions that give wrong answers to the probes.

    All functions share a process as long as they are right. A function that is not is asked again in a process of its
    own, so that nothing that another one left behind can be held against it.
    """
    found = {}
    for name in _deviating(names, remote):
        if name in remote.slow:
            found[name] = Diagnosis(name, "too slow")
            continue
        with contextlib.suppress(GraderFailed), remote.fresh() as call:
            diagnosis = diagnose(name, call, remote.submission.uses)
            written_for_one = diagnosis.verdict == "one at a time" and not diagnosis.changes_input
            if not diagnosis.right and not written_for_one:
                found[name] = diagnosis
    return found


def _deviating(names: Iterable[str], remote: Remote) -> list[str]:
    waiting, found = deque(names), []
    with contextlib.suppress(GraderFailed):
        while waiting:
            with remote.fresh() as call:
                right = True
                while waiting and right:
                    right = _is_right(name := waiting.popleft(), call)
                if not right:
                    found.append(name)
    return found


def _is_right(name: str, call: Callable[..., Any]) -> bool:
    """Whether every answer is right, and no argument was written to; also if there are no probes of a function."""
    cases = _cases(name)
    answers = ask(call, name, [probe for probe, _ in cases])
    pairs = zip(answers, cases, strict=True)
    return all(deviation_of(answer, right).right and not answer.changed for answer, (_, right) in pairs)


@functools.cache
def _cases(name: str) -> tuple[tuple[Probe, Right], ...]:
    """The probes of a function that have a right answer; made once for all submissions, because reading takes time."""
    try:
        return tuple((probe, right) for probe, right in zip(probes(name), right_answers(name), strict=True) if right)
    except UnknownName:
        return ()
