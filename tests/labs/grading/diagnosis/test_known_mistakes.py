"""Every known mistake is named and explained, in code for many cases or for one, and none is taken for another.

Every run tries the mistakes of a few functions, and `make verify` those of the others. A failure lists them by name.
"""

from __future__ import annotations

import functools
from dataclasses import replace

import numpy as np
import pytest
from known_mistakes import by_function, refuses_many, remembered

from labs.grading.diagnosis import recognition
from labs.grading.diagnosis.recognition import diagnose
from labs.grading.diagnosis.words import told
from labs.grading.feedback.report import report
from labs.grading.judging.score_sheet import Outcome, Sheet
from reference import lecture

pytestmark = pytest.mark.filterwarnings("ignore::RuntimeWarning")  # wrong formulas divide by zero
MISTAKES = by_function()
IN_MANY_ALONE = {
    "signed_distance/one length for all", "clamp_to_circle/one for all",
    "complementarity_residual/one for all", "edge_edge_normal/one length for all", "kinematic_response/one for all",
}  # fmt: skip
"""Mistakes that a function of one case cannot make."""


@functools.lru_cache(maxsize=1)  # the tests of a function follow one another
def wrong(function):
    """The known mistakes of a function by name, as formulas that compute each answer once."""
    return {entry.id: remembered(entry.formula) for entry in MISTAKES[function]}


def pytest_generate_tests(metafunc):
    """One function after another, each with all tests: they ask its wrong formulas the same."""
    functions = [
        pytest.param(name, marks=() if place % 36 == 0 else pytest.mark.slow) for place, name in enumerate(MISTAKES)
    ]
    metafunc.parametrize("function", functions, scope="module")


@pytest.fixture(autouse=True)
def cache_folder():
    """No cache: nothing here runs a scenario in a worker."""


def test_the_mistakes_of_a_function_are_recognised_and_explained(function):
    unsaid = {}
    for entry in MISTAKES[function]:
        formula = wrong(function)[entry.id]
        found = diagnose(function, lambda _, *given, formula=formula: formula(*given))
        unsaid[entry.id] = lacking_in_feedback(entry, found)
    assert {name: lacking for name, lacking in unsaid.items() if lacking} == {}


def lacking_in_feedback(entry, found):
    """What the feedback does not tell of a mistake with that diagnosis."""
    if (found.verdict, [each.id for each in found.mistakes[:1]]) != ("named", [entry.id]):
        return told(found)
    sheet = Sheet(outcomes=[Outcome("test_x", 1, False, said="wrong", function=entry.function)])
    sheet.diagnoses[entry.function] = found
    feedback = " ".join("\n".join(report(sheet, [lecture.function(entry.function).topic])).split())
    return [text for text in (entry.rationale, entry.help) if text not in feedback]


def test_the_mistakes_of_a_function_are_named_in_code_for_one_case(function):
    expected, found = {}, {}
    for name, formula in wrong(function).items():
        here = diagnose(function, refuses_many(function, formula))
        expected[name] = ("one at a time", []) if name in IN_MANY_ALONE else ("named", [name])
        found[name] = here.verdict, [each.id for each in here.mistakes[:1]]
    assert found == expected


def test_a_mistake_that_is_not_listed_is_not_taken_for_another(function, monkeypatch):
    """Each entry is left out in turn; at most the same mistake is named, except for touching, and with reserve."""
    listed, certain = recognition.known(function), {}
    for name, formula in wrong(function).items():
        others = tuple(other for other in listed.mistakes if other.id != name)
        monkeypatch.setattr(recognition, "known", lambda _, others=others: replace(listed, mistakes=others))
        with np.errstate(all="ignore"):
            found = diagnose(function, lambda _, *given, formula=formula: formula(*given))
        if found.verdict == "named":
            certain[name] = found.mistakes[0].id
    assert certain == {}


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
