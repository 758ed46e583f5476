"""How fast a machine is, and that its measure is the same work everywhere."""

from __future__ import annotations

import itertools

import pytest

from reference import pace


def clock_of(rounds):
    """A clock by which the rounds take these times, s."""
    ends = itertools.accumulate(rounds)
    return itertools.chain.from_iterable((end - own, end) for own, end in zip(rounds, ends, strict=True)).__next__


def test_a_machine_is_as_slow_as_its_rounds_are_longer():
    assert pace.slowness(clock_of([2.5 * pace.ROUND] * pace.ROUNDS)) == pytest.approx(2.5)


def test_one_round_beside_other_work_changes_nothing():
    rounds = [pace.ROUND] * (pace.ROUNDS - 1)
    assert pace.slowness(clock_of([9.0, *rounds])) == pytest.approx(1.0)


def test_the_workload_does_the_same_work_everywhere():
    # Rounding differs between machines, by some 10⁻¹⁶ of a sum of 1,500 distances near 1 m
    assert pace.workload() == pytest.approx(1078.0856413216663, rel=1e-9)


def test_this_machine_takes_some_time():
    assert 0.05 < pace.slowness() < 50  # twenty times faster or fifty times slower is a broken clock
