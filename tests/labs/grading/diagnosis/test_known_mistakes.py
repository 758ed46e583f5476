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
