"""A family that costs more than it may is named; what came from the cache costs nothing."""

from __future__ import annotations

import pytest
from run_allowances import MORE, NOISE, SECONDS, spent, too_long

from reference.catalogue.scenarios import catalogue
from reference.engines import engine_names

SLOWNESS = 2.5


def entry(family, profile, seconds, cached=False):
    """One run of a family in MuJoCo that took these seconds of the machine of the allowances."""
    used = {"seconds": 0.0, "processor_seconds": seconds * SLOWNESS}
    return {"family": family, "engine": "mujoco", "profile": profile, "cached": cached} | used


def test_a_family_is_too_long_by_all_its_profiles_together():
    most = NOISE * SECONDS
    fine = [entry("cradle", "tuned", 0.6 * most), entry("cradle", "stock", 0.3 * most)]
    assert too_long(fine, SLOWNESS) == {}
    assert too_long([*fine, entry("cradle", "spring", 0.2 * most)], SLOWNESS) == {
        ("cradle", "mujoco"): pytest.approx(1.1 * most)
    }
    assert too_long([*fine, entry("cradle", "spring", 0.2 * most, cached=True)], SLOWNESS) == {}


def test_what_was_spent_comes_with_the_dearest_first():
    found = spent([entry("cradle", "tuned", 1.0), entry("stack", "tuned", 2.0)], SLOWNESS)
    assert list(found) == [("stack", "mujoco"), ("cradle", "mujoco")]


def test_only_families_and_engines_that_there_are_may_take_longer():
    assert {family for family, _ in MORE} <= set(catalogue())
    assert {engine for _, engine in MORE} <= set(engine_names())
    assert min(MORE.values()) > SECONDS
