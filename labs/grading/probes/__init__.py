"""Probes: inputs on which a submission's numbers are compared with the right ones and with those of known mistakes.

They are open, carry no points and echo freely: what is paid for is tested on other inputs. A topic's probes are in the
module of its name.
"""

from __future__ import annotations

import importlib.util

from labs.grading.probes.making import GROUPS, Group, Probe
from reference import lecture

__all__ = ["GROUPS", "Group", "Probe", "probed", "probes"]


def probes(function: str) -> tuple[Probe, ...]:
    """The probes of a function: usual and limiting cases, the simple ones first, then several at once, then bad input.

    Raises
    ------
    UnknownName
        If the lecture has no such function, or its topic has no probes.
    """
    entry = lecture.function(function)
    module = importlib.import_module(f"{__name__}.{entry.topic}")
    found: tuple[Probe, ...] = module.probes(entry.name)
    return found


def probed() -> tuple[lecture.Function, ...]:
    """The functions that have probes: all that a student writes in the topics that have a module here."""
    return tuple(
        entry
        for topic in lecture.TOPICS
        if importlib.util.find_spec(f"{__name__}.{topic.name}")
        for entry in lecture.functions_of(topic.name)
        if entry.role == "written"
    )
