"""Where an error comes from: the shares add up to it, and what has no effect is left out."""

from __future__ import annotations

import pytest

from reference.comparison.error_split import CONTACT_MODEL, DEFAULTS, DISCRETISATION, REMAINDER, SOLVER, Share, Split
from reference.comparison.results import Job, JobResult
from reference.report.error_split import origins
from reference.report.sections import sections

STOCK = (
    Share(DEFAULTS, "damping unset → 0", -0.30, -0.10, -0.20),
    Share(DEFAULTS, "slop unset → 0", -0.10, -0.1001, 0.0001),
    Share(DEFAULTS, "timestep 0.004 → 0.001", -0.1001, -0.05, -0.0501),
)
TUNED = (
    Share(DISCRETISATION, "timestep 0.001 → 0.0005", -0.05, -0.03, -0.04),
    Share(CONTACT_MODEL, "slop 0.1 → 0.01", -0.05, -0.042, -0.008),
    Share(SOLVER, "iterations 50 → 100", -0.05, -0.05, 0.0),
    Share(REMAINDER, "what no move explains", -0.05, -0.002, -0.002),
)


def origin(*shares: Share, family: str = "ball-to-rest", case: str = "e=0.5", quantity: str = "rest_time"):
    result = JobResult(Job(family, "pybullet", "tuned"), "PyBullet", "", (), split=Split(case, quantity, shares))
    (section,) = sections([result])
    (found,) = origins(section)
    return found


def test_every_effective_move_names_its_setting_and_both_errors():
    # The time of rest at e = 0.5 is 1.3546 s: -0.3 s are -22 % of it, -0.1 s are -7.4 %, -0.2 s are -15 %.
    first = origin(*STOCK, *TUNED).steps[0]
    assert (first.kind, first.moved) == ("defaults", "damping unset → 0")
    assert (first.before, first.after, first.size) == ("−22 %", "−7.4 %", "−15 %")


def test_moves_without_a_visible_effect_are_left_out():
    found = origin(*STOCK, *TUNED)
    assert [step.moved for step in found.steps] == [
        "damping unset → 0",
        "timestep 0.004 → 0.001",
        "timestep 0.001 → 0.0005",
        "slop 0.1 → 0.01",
        "what no move explains",
    ]


def test_the_shares_add_up_to_the_error_that_counts():
    found = origin(*STOCK, *TUNED)
    assert (found.plain, found.counted) == ("−22 %", "−3.7 %")
    assert found.shares == ("−3 %", "−0.59 %", "0 %", "−0.15 %")  # discretisation, contact model, solver, remainder


def test_without_a_plain_number_only_the_error_that_counts_is_given():
    found = origin(*TUNED)
    assert (found.plain, found.counted) == ("", "−3.7 %")


def test_a_stock_run_without_a_number_is_reported_as_such():
    step = origin(Share(DEFAULTS, "all", None, -0.05, None), *TUNED).steps[0]
    assert (step.before, step.size) == ("no such number", "no such number")


@pytest.mark.parametrize("error", [0.0, 1e-12])
def test_an_error_of_rounding_is_not_split(error):
    tiny = (Share(DISCRETISATION, "timestep", error, -error, 4 * error), Share(REMAINDER, "rest", error, error, error))
    found = origin(*STOCK, *tiny)
    assert found.shares == ()
    assert {step.kind for step in found.steps} == {"defaults"}


def test_a_quantity_without_a_scale_is_split_in_its_unit():
    shares = (
        Share(DISCRETISATION, "timestep", 4e-5, 3e-5, 2e-5),
        Share(REMAINDER, "what no move explains", 4e-5, 2e-5, 2e-5),
    )
    found = origin(*shares, family="stack", case="boxes=5", quantity="height")
    assert (found.counted, found.shares) == ("+40 µm", ("+20 µm", "", "", "+20 µm"))


def test_lines_without_a_split_have_no_origin():
    (section,) = sections([JobResult(Job("stack", "pybullet", "stock"), "PyBullet", "", ())])
    assert origins(section) == []
