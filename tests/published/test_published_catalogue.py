"""The second catalogue as a whole: all cases, each with its source, and an answer or a reason why there is none."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from reference import lecture
from reference.engines import engine_names
from reference.errors import UnknownName
from reference.published.case import numbers_of
from reference.published.drivers import DRIVERS, NOT_SET_UP
from reference.published.theirs import published, published_cases

KINDS = {"verification", "validation", "cross-engine"}
CASES = published_cases().values()


def test_the_catalogue_lists_all_forty_one_cases_in_order():
    assert list(published_cases()) == [f"P{number}" for number in range(1, 42)]
    assert {case.kind for case in CASES} == KINDS


def test_each_case_has_a_title_a_source_and_a_tolerance_with_its_reason():
    for case in CASES:
        assert case.title, case.name
        assert case.source, case.name
        assert case.reason, case.name
        assert lecture.statement(case.statement)
        assert case.setup, case.name
        assert case.expected.keys() == case.tolerance.keys(), case.name


def test_each_figure_has_a_tolerance_and_a_label_for_every_number():
    for case in CASES:
        assert case.units.keys() | case.labels.keys() <= case.expected.keys(), case.name
        for figure, expected in case.expected.items():
            count = len(numbers_of(expected))
            assert len(numbers_of(case.tolerance[figure])) in (1, count), (case.name, figure)
            assert len(case.labels.get(figure, range(count))) == count, (case.name, figure)
            assert np.all(np.isfinite(numbers_of(expected)))
            assert np.all(np.array(numbers_of(case.tolerance[figure])) >= 0)


def test_each_case_runs_by_hand_and_in_the_engines_or_says_why_not():
    engines = [name for name in engine_names() if name != "handwritten"]
    assert list(DRIVERS) == list(published_cases())
    for case in CASES:
        drivers = DRIVERS[case.name]
        assert drivers.by_hand, case.name
        assert bool(drivers.in_engines) == (not drivers.why_not and drivers.lacking == NOT_SET_UP), case.name
        assert drivers.why_not_in.keys() <= set(engines), case.name
        assert case.origin in ("", *engines), case.name


def test_an_unknown_case_is_refused_with_the_list_of_known_ones():
    with pytest.raises(UnknownName, match=r"unknown published case 'P42'\. .*P1, P2"):
        published("P42")


def test_the_documentation_lists_each_case_by_its_title_and_kind():
    page = (Path(__file__).parents[2] / "docs" / "published.md").read_text(encoding="utf-8")
    rows = [[cell.strip() for cell in line.split("|")] for line in page.splitlines() if line.startswith("| P")]
    assert [(row[1], row[2], row[4]) for row in rows] == [(case.name, case.title, case.kind) for case in CASES]
