"""The order of convergence, read from errors at several timesteps."""

from __future__ import annotations

import pytest

from reference.comparison.convergence import order_of


@pytest.mark.parametrize("order", [0.5, 1, 2, 4])
def test_the_order_is_the_slope_of_error_against_timestep(order):
    steps = [4e-3, 2e-3, 1e-3, 5e-4]
    assert order_of(steps, [1e5 * dt**order for dt in steps], 1.0) == pytest.approx(order)  # a line: rounding only


def test_errors_of_rounding_have_no_order():
    assert order_of([4e-3, 2e-3, 1e-3], [1e-16, 3e-16, 2e-16], 1.0) is None
    assert order_of([4e-3, 2e-3, 1e-3], [0.0, 0.0, 0.0], 0.0) is None


def test_the_order_is_read_from_the_errors_above_rounding():
    steps = [4e-3, 2e-3, 1e-3, 5e-4]
    assert order_of(steps, [1.6e-7, 4e-8, 1e-8, 1e-13], 1.0) == pytest.approx(2)
    assert order_of(steps, [1.6e-7, 1e-13, 1e-13, 1e-13], 1.0) is None, "one point makes no line"
    assert order_of([1e-3], [1e-3], 1.0) is None


@pytest.mark.parametrize("unit", [1e6, 1e-6])
def test_which_errors_are_rounding_does_not_depend_on_the_unit(unit):
    errors = [unit * error for error in (1.6e-7, 4e-8, 1e-8, 1e-13)]
    assert order_of([4e-3, 2e-3, 1e-3, 5e-4], errors, -unit) == pytest.approx(2)


def test_errors_that_grow_as_the_timestep_shrinks_have_a_negative_order():
    assert order_of([4e-3, 2e-3, 1e-3], [1.0, 2.0, 4.0], 1.0) == pytest.approx(-1)
