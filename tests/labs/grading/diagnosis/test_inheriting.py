"""A function that is right itself goes wrong with a wrong one that it uses: two made-up functions of one package."""

from __future__ import annotations

import contextlib
import sys
from types import ModuleType

import numpy as np
import pytest

from labs.grading.diagnosis.fingerprints.building import deviations_of, right_answer
from labs.grading.diagnosis.fingerprints.inherited_mistakes import inherited, replaced, used
from labs.grading.diagnosis.misconceptions import Misconception
from labs.grading.diagnosis.probes import Probe

CODE = """
def inner(x): return 2.0 * x
def outer(x): return inner(x) + 1.0
def other(x): return x + 1.0
"""
PROBES = [Probe((1.0,)), Probe((2.0,)), Probe((3.0,), "edge"), Probe((-1.0,), "refused")]


@pytest.fixture
def made_up(monkeypatch):
    module, user = ModuleType("made_up"), ModuleType("made_up.user")
    exec(CODE, module.__dict__)
    user.inner = module.inner
    monkeypatch.setitem(sys.modules, "made_up", module)
    monkeypatch.setitem(sys.modules, "made_up.user", user)
    monkeypatch.setitem(sys.modules, "made_up_too", other := ModuleType("made_up_too"))
    other.inner = module.inner
    return module


def mistake(name, formula):
    return Misconception("inner", name, formula, "", "")


BANK = [
    mistake("three times", lambda x: 3.0 * x),
    mistake("again", lambda x: x + x + x),
    mistake("right", lambda x: x + x),
    mistake("four times", lambda x: 4.0 * x),
    mistake("none", lambda x: "no"),
    mistake("also the outer's", lambda x: 2.0 * x - 1.0),
]


def found_for(function, earlier, own=()):
    answers = [None if probe.group == "refused" else right_answer(function, probe) for probe in PROBES]
    deviations = [deviations_of(formula, "f", PROBES, answers) for formula in own]
    return inherited("f", function, earlier, PROBES, answers, deviations, deviations_of)


def test_mistakes_of_a_used_function_are_inherited_with_their_origins(made_up):
    found = found_for(made_up.outer, {"inner": (made_up.inner, BANK)}, [lambda x: 2.0 * x])
    assert [ids for ids, _ in found] == [["inner/three times", "inner/again"], ["inner/four times"]]
    np.testing.assert_allclose(
        [deviation.total for deviation in found[1][1]], [2 * deviation.total for deviation in found[0][1]]
    )
    assert len(found[0][1]) == 3  # nothing of what is to be refused
    assert made_up.outer(1.0) == 3.0


def test_nothing_is_inherited_from_unused_functions_or_from_itself(made_up):
    assert found_for(made_up.other, {"inner": (made_up.inner, BANK)}) == []
    assert found_for(made_up.inner, {"inner": (made_up.inner, BANK)}) == []


def test_a_use_at_an_edge_case_alone_does_not_count(made_up):
    others = [made_up.inner, made_up.other]
    assert used(made_up.outer, others, PROBES) == {made_up.inner}
    assert used(made_up.other, [made_up.inner], PROBES) == set()
    assert used(made_up.outer, others, PROBES[2:]) == set()


def test_a_function_is_replaced_in_its_package_alone_and_put_back(made_up):
    right, user, other = made_up.inner, sys.modules["made_up.user"], sys.modules["made_up_too"]
    with contextlib.suppress(ZeroDivisionError), replaced({right: abs}):
        assert (made_up.inner, user.inner, other.inner) == (abs, abs, right)
        raise ZeroDivisionError
    assert (made_up.inner, user.inner, other.inner) == (right, right, right)
