"""Probes: inputs on which a submission's numbers are compared with the right ones and with those of known mistakes.

Students may see them, and they carry no points: the tests that give points use other inputs. The probes of a topic are
in the module of its name.
"""

from __future__ import annotations

import contextlib
import functools
import importlib.util

from labs.grading.diagnosis.probes.probe import GROUPS, Group, Probe
from reference import lecture
from reference.errors import UnknownName

__all__ = ["GROUPS", "Group", "Probe", "probed", "probes"]


@functools.cache  # drawing them takes time; a function that may write to its arguments is given copies
def probes(function: str) -> tuple[Probe, ...]:
    """The probes of a function: usual and limiting cases, the simple ones first, then several at once, then bad input.

    Raises
    ------
    UnknownName
        If the lecture has no such function, or there are no probes of it.
    """
    entry = lecture.function(function)
    name = f"{__name__}.{entry.topic}"
    if importlib.util.find_spec(name):
        try:
            found: tuple[Probe, ...] = importlib.import_module(name).probes(entry.name)
        except KeyError as missing:
            if missing.args != (entry.name,):
                raise
        else:
            return found
    raise UnknownName("function with probes", function, ())


@functools.cache
def probed() -> tuple[lecture.Function, ...]:
    """The functions that have probes, of those that a student writes."""
    written = (entry for topic in lecture.TOPICS for entry in lecture.functions_of(topic.name))
    return tuple(entry for entry in written if entry.role == "written" and _has_probes(entry.name))


def _has_probes(function: str) -> bool:
    with contextlib.suppress(UnknownName):
        return bool(probes(function))
    return False
