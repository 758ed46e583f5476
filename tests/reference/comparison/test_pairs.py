"""Each implementation against each: numbers that are alike, explained or apart, and the reason for those apart."""

from __future__ import annotations

from dataclasses import replace

import live
import pytest

from reference.catalogue.apart import REASONS, why_apart
from reference.catalogue.scenarios import catalogue
from reference.comparison.pairs import NO_REASON, Reason, Relation, agreements, pairs
from reference.comparison.verdicts import Row, Verdict
from reference.engines import load_engine


def row(engine: str, measured: float | None, verdict: Verdict = Verdict.PASS, profile: str = "tuned", **others) -> Row:
    given = {"expected": 1.0, "tolerance": 0.01} | others
    return Row("stack", "boxes=5", engine, profile, "height", "m", verdict, measured, **given)


def relation(one: Row, other: Row) -> Relation:
    (pair,) = pairs([one, other])
    return pair.relation


def test_numbers_are_alike_within_the_smaller_of_two_tolerances():
    assert relation(row("a", 1.004), row("b", 0.9951, tolerance=0.02)) is Relation.ALIKE
    assert relation(row("a", 1.009), row("b", 0.998, tolerance=0.02)) is Relation.EXPLAINED
    assert relation(row("exact", 1.0, tolerance=1e-9), row("b", 1.0009)) is Relation.ALIKE
    assert relation(row("exact", 1.0, tolerance=1e-9), row("b", 1.0011)) is Relation.EXPLAINED


def test_a_sink_of_millimetres_is_not_that_of_micrometres():
    sunk = {"expected": 0.0, "tolerance": 4.4e-3}
    assert relation(row("a", 2.3e-3, **sunk), row("b", 2.4e-5, **sunk | {"tolerance": 4.4e-4})) is Relation.EXPLAINED


def test_two_predictions_explain_a_difference_though_theory_is_silent():
    silent = {"expected": None, "tolerance": None}
    assert relation(row("a", 0.667, **silent), row("b", 1.0, **silent)) is Relation.EXPLAINED
    assert relation(row("a", 0.667, **silent), row("b", 1.0, Verdict.SHOWN, **silent)) is Relation.APART
    assert relation(row("a", 1.0005, **silent), row("b", 1.0, Verdict.SHOWN, **silent)) is Relation.ALIKE


def test_a_number_that_fails_is_apart_even_where_another_has_none():
    (pair,) = pairs([row("mujoco", 1.0), row("pybullet", 1.3, Verdict.FAIL, profile="stock")])
    assert (pair.relation, pair.difference) == (Relation.APART, pytest.approx(-0.3))
    assert pair.why == (Reason(("pybullet", "stock"), why_apart("stack", "pybullet", "stock")),)
    (pair,) = pairs([row("mujoco", 1.0), row("pybullet", None, Verdict.FAIL, profile="stock")])
    assert (pair.relation, pair.difference) == (Relation.APART, None)


def test_a_method_that_must_give_no_number_is_in_a_pair_as_well():
    (pair,) = pairs([row("a", 1.0), row("b", None, Verdict.DISAGREES)])
    assert (pair.relation, pair.difference) == (Relation.EXPLAINED, None)


def test_implementations_need_not_take_as_many_steps():
    of_drop = [
        replace(row(name, count), family="one-drop", quantity="steps") for name, count in (("a", 1e3), ("b", 2e4))
    ]
    assert not list(pairs(of_drop))
    assert list(pairs([replace(each, quantity="rebound") for each in of_drop]))


def test_a_failure_without_a_known_reason_says_so():
    (pair,) = pairs([row("a", 1.0), row("mine.py", 1.3, Verdict.FAIL)])
    assert pair.why == (Reason(("mine.py", "tuned"), NO_REASON),)
    (pair,) = pairs([row("a", 1.0), row("mine.py", None, Verdict.FAIL, note="it never stops")])
    assert pair.why[0].said == "it never stops"


def test_an_implementation_without_words_is_in_no_pair():
    assert not list(pairs([row("a", 1.0), row("b", None, Verdict.CANNOT_EXPRESS)]))


def test_two_implementations_have_one_agreement_with_their_farthest_numbers():
    several = [(1.0, 1.5), (1.0, 1.001), (1.0, 0.2)]
    rows = [
        Row("stack", f"case {number}", engine, "stock", "height", "m", Verdict.FAIL, value, None, 1.0, 0.01)
        for number, both in enumerate(several)
        for engine, value in zip(("pybullet", "mujoco"), both, strict=True)
    ]
    found = agreements(pairs(rows))["stack"][("pybullet", "stock"), ("mujoco", "stock")]
    assert (found.count(Relation.ALIKE), found.count(Relation.APART)) == (1, 2)
    assert (found.relation, found.worst.case) == (Relation.APART, "case 2")


def test_reasons_are_of_families_engines_and_profiles_that_there_are():
    families = catalogue()
    for family, reasons in REASONS.items():
        for engine, profile in reasons:
            assert not engine or profile in families[family].profiles(load_engine(engine)), (family, engine, profile)


@pytest.mark.slow
@pytest.mark.parametrize("family", catalogue())
def test_every_number_that_nothing_accounts_for_has_a_reason(family):
    rows = [row for run in live.planned() if run[0] == family for row in live.rows(*run)]
    assert rows
    for pair in pairs(rows):
        assert pair.why or pair.relation is not Relation.APART, pair
