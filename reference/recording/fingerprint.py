"""What a recording belongs to: a hash of scenarios and settings, the same on every machine."""

from __future__ import annotations

import functools
import hashlib
import json
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from typing import Any

from reference.catalogue.case import Case
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings

DIGITS = 16
"""Length of a fingerprint; two of some ten thousand agree by chance with a probability of 10⁻¹¹."""
_SURE_DIGITS = 10
"""Digits of a number that count: two machines may round a sine differently in its sixteenth digit, not in its tenth."""
_NOTHING = 1e-14
"""A smaller number counts as zero: it is left over from a difference of rounded numbers."""


def fingerprint(case: Case, settings: Settings) -> str:
    """A hash of all scenarios of a case and of the settings that they ran with."""
    return hashed((_hash_of(case.scenarios), settings))


@functools.lru_cache(1024)
def _hash_of(scenarios: tuple[Scenario, ...]) -> str:
    return hashed(scenarios)


def hashed(value: Any) -> str:
    """A hash of plain data: dataclasses, mappings, tuples, numbers, words."""
    return hashlib.sha256(json.dumps(_plain(value), sort_keys=True).encode()).hexdigest()[:DIGITS]


def _plain(value: Any) -> Any:
    """Dataclasses as dictionaries that also name their class, and numbers without their last digits.

    A field whose default is an empty tuple is left out while it is empty, so that a new one changes no fingerprint.
    """
    if is_dataclass(value):
        every = ((field, getattr(value, field.name)) for field in fields(value))
        told = {field.name: _plain(own) for field, own in every if own != () or field.default != ()}
        return {"kind": type(value).__name__} | told
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, float):
        return float(f"{value:.{_SURE_DIGITS}g}") if abs(value) > _NOTHING else 0.0
    return [_plain(item) for item in value] if isinstance(value, tuple) else value
