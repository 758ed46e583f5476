"""Where an error comes from: the shares add up to it, and what has no effect is said to have none."""

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


def test_moves_without_a_visible_effect_are_listed_separately():
    found = origin(*STOCK, *TUNED)
    assert found.idle == ("slop unset → 0", "iterations 50 → 100")
    assert [step.moved for step in found.steps] == [
        "damping unset → 0",
        "timestep 0.004 → 0.001",
        "timestep 0.001 → 0.0005",
        "slop 0.1 → 0.01",
        "what no move explains",
    ]


def test_the_sentence_has_shares_that_add_up_to_the_tuned_error():
    assert origin(*STOCK, *TUNED).sentence == (
        "Stock is off by −22 %, tuned by −3.7 %. The latter is made up of −3 % discretisation, −0.59 % contact model,"
        " 0 % solver, −0.15 % remainder."
    )


def test_without_a_stock_number_only_the_tuned_error_is_given():
    assert origin(*TUNED).sentence.startswith("Tuned: −3.7 %. It is made up of −3 % discretisation,")


def test_a_stock_run_without_a_number_is_reported_as_such():
    step = origin(Share(DEFAULTS, "all", None, -0.05, None), *TUNED).steps[0]
    assert (step.before, step.size) == ("no such number", "no such number")


@pytest.mark.parametrize("error", [0.0, 1e-12])
def test_an_error_of_rounding_is_not_split(error):
    tiny = (Share(DISCRETISATION, "timestep", error, -error, 4 * error), Share(REMAINDER, "rest", error, error, error))
    found = origin(*STOCK, *tiny)
    assert found.sentence.endswith("That is rounding: there is nothing left to split.")
    assert {step.kind for step in found.steps} == {"defaults"}


def test_a_quantity_without_a_scale_is_split_in_its_unit():
    shares = (
        Share(DISCRETISATION, "timestep", 4e-5, 3e-5, 2e-5),
        Share(REMAINDER, "what no move explains", 4e-5, 2e-5, 2e-5),
    )
    found = origin(*shares, family="stack", case="boxes=5", quantity="height")
    assert found.sentence == "Tuned: +40 µm. It is made up of +20 µm discretisation, +20 µm remainder."


def test_lines_without_a_split_have_no_origin():
    (section,) = sections([JobResult(Job("stack", "pybullet", "stock"), "PyBullet", "", ())])
    assert origins(section) == []
