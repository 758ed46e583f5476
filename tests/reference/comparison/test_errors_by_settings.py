"""A question that is asked again and again: each settings are run once, and every answer is what a run would give."""

from __future__ import annotations

import math

import pytest

from reference.catalogue.scenarios import catalogue
from reference.comparison.compare import compare_case
from reference.comparison.errors_by_settings import Question
from reference.engines import load_engine

DROPPED = catalogue()["dropped-ball"]


class Counting:
    """An engine, but for the count of its runs."""

    def __init__(self, name: str) -> None:
        self.engine, self.runs = load_engine(name), 0

    def __getattr__(self, name: str) -> object:
        return getattr(self.engine, name)

    def run_many(self, scenarios, settings):
        self.runs += 1
        return self.engine.run_many(scenarios, settings)


@pytest.fixture
def asked() -> tuple[Question, Counting]:
    engine = Counting("handwritten")
    return Question.of(DROPPED, engine), engine


def test_each_setting_is_run_once(asked):
    question, engine = asked
    at_step = engine.settings(question.case.scenarios[0], "step")
    first = question.mean_error(at_step), question.rms_error(at_step)
    assert (question.mean_error(at_step), question.rms_error(at_step), engine.runs) == (*first, 1)
    question.mean_error(at_step.change(timestep=2e-3))
    assert engine.runs == 2


def test_mean_and_root_mean_square_are_those_of_the_rows(asked):
    question, engine = asked
    at_step = engine.settings(question.case.scenarios[0], "step")
    rows, _ = compare_case(DROPPED, question.case, engine, "step", at_step)
    row = next(row for row in rows if row.quantity == question.quantity.name)
    assert question.mean_error(at_step) == pytest.approx(row.error, rel=1e-9)  # rounding of a sum of 107
    # The mean square is the square of the mean and the variance.
    assert question.rms_error(at_step) == pytest.approx(math.hypot(row.error, row.spread), rel=1e-9)


def test_a_run_that_was_handed_in_is_not_repeated(asked):
    question, engine = asked
    at_step = engine.settings(question.case.scenarios[0], "step")
    _, trajectories = compare_case(DROPPED, question.case, engine, "step", at_step)
    fresh = Question.of(DROPPED, engine)
    question.remember(at_step, trajectories)
    runs = engine.runs
    assert question.rms_error(at_step) == fresh.rms_error(at_step)
    assert engine.runs == runs + 1  # of the one that had to ask


def test_a_run_that_was_sampled_too_rarely_is_repeated():
    engine = Counting("handwritten")
    question = Question.of(catalogue()["ball-to-rest"], engine)
    assert question.every_step
    settings = engine.settings(question.case.scenarios[0], "step").change(sample_every=7)
    question.remember(settings, engine.run_many(question.case.scenarios, settings))
    question.mean_error(settings)
    assert engine.runs == 2


def test_an_engine_that_breaks_is_asked_once_and_has_no_answer(asked, monkeypatch):
    question, engine = asked
    settings = engine.settings(question.case.scenarios[0], "exact")
    calls = []
    monkeypatch.setattr(engine, "run_many", lambda *_: calls.append(1) or 1 / 0, raising=False)
    assert question.mean_error(settings) is None
    assert question.rms_error(settings) is None
    assert calls == [1]
