"""What the tests of published cases share: the catalogue's own answer by hand, judged."""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import replace

import pytest

from reference.comparison.verdicts import Verdict
from reference.engines import load_engine
from reference.published.case import Figure
from reference.published.judging import compare_published
from reference.published.results import PublishedRow
from reference.published.theirs import published


@pytest.fixture
def judged() -> Callable[..., tuple[PublishedRow, ...]]:
    """Answer a case by hand, with parts of its set-up changed, and return its rows."""

    return _by_hand


@functools.cache
def _by_hand(name: str, **changed: Figure) -> tuple[PublishedRow, ...]:
    case = published(name)
    rows, _ = compare_published(replace(case, setup={**case.setup, **changed}), load_engine("handwritten"))
    return rows


@pytest.fixture
def as_published(judged) -> Callable[..., dict[str, list[float]]]:
    """The same, where every number comes out as published; return ours by figure."""

    def found(name: str, **changed: Figure) -> dict[str, list[float]]:
        rows, ours = judged(name, **changed), {}
        assert [row for row in rows if row.verdict is not Verdict.PASS] == []
        for row in rows:
            ours.setdefault(row.figure, []).append(row.measured)
        assert ours.keys() == published(name).expected.keys()
        return ours

    return found
