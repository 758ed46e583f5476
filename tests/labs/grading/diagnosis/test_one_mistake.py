"""One mistake is called one, whatever the form of the formula in which it is made."""

from __future__ import annotations

import numpy as np
import pytest

from labs.grading.diagnosis.recognition import diagnose


def step_limit(omega, zeta, factor=2.0, shortened=lambda z: 1 / (np.sqrt(1 + z**2) + z)):
    """The limit of a penalty contact, from formulas for ω and ζ that may be wrong."""

    def limit(mass, stiffness, damping=0.0):
        m, k, c = (np.asarray(each, dtype=float) for each in (mass, stiffness, damping))
        return factor / omega(m, k) * shortened(zeta(m, k, c))

    return limit


def frequency(m, k):
    return np.sqrt(k / m)


def damping_ratio(m, k, c):
    return c / (2 * np.sqrt(k * m))


@pytest.mark.parametrize(
    ("mistake", "formula"),
    [
        ("1/ω", step_limit(frequency, damping_ratio, factor=1.0)),
        ("ω squared", step_limit(lambda m, k: k / m, damping_ratio)),
        ("ω upside down", step_limit(lambda m, k: np.sqrt(m / k), damping_ratio)),
        ("ζ without the root", step_limit(frequency, lambda m, k, c: c / (2 * k * m))),
    ],
)
def test_one_mistake_in_a_form_that_keeps_its_digits_is_one_mistake(mistake, formula):
    with np.errstate(all="ignore"):
        found = diagnose("penalty_step_limit", lambda _, *given: formula(*given))
    assert (found.verdict, [known.id for known in found.mistakes], found.odd) == (
        "named", [f"penalty_step_limit/{mistake}"], None,
    )  # fmt: skip


def test_a_mistake_in_a_form_that_loses_its_digits_is_two_mistakes():
    formula = step_limit(lambda m, k: k / m, damping_ratio, shortened=lambda z: np.sqrt(1 + z**2) - z)
    with np.errstate(all="ignore"):
        found = diagnose("penalty_step_limit", lambda _, *given: formula(*given))
    assert (found.verdict, found.mistakes[0].id) == ("likely", "penalty_step_limit/ω squared")
    assert "damping" in found.odd.probe.note
