"""A family that costs more than it may is named."""

from __future__ import annotations

import pytest
from run_allowances import MORE, NOISE, SECONDS, too_long

from reference.catalogue.scenarios import catalogue
from reference.comparison.results import Job, JobResult
from reference.engines import engine_names

SLOWNESS = 2.5


def result(profile, seconds):
    """A run of the cradle in MuJoCo that took these seconds of the machine of the allowances."""
    return JobResult(Job("cradle", "mujoco", profile), "MuJoCo", "", (), processor_seconds=seconds * SLOWNESS)


def test_a_family_is_too_long_by_all_its_profiles_together():
    most = NOISE * SECONDS
    fine = [result("tuned", 0.6 * most), result("stock", 0.3 * most)]
    assert too_long(fine, SLOWNESS) == {}
    assert too_long([*fine, result("spring", 0.2 * most)], SLOWNESS) == {
        ("cradle", "mujoco"): pytest.approx(1.1 * most)
    }


def test_only_families_and_engines_that_there_are_may_take_longer():
    assert {family for family, _ in MORE} <= set(catalogue())
    assert {engine for _, engine in MORE} <= set(engine_names())
    assert min(MORE.values()) > SECONDS
