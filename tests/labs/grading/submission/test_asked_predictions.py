"""Predictions are read from the cells of a notebook: which are asked for, and which were made."""

from __future__ import annotations

import warnings

import pytest
from cells import write_notebook

from labs.grading.submission.asked_predictions import in_words, predictions_in, predictions_of


@pytest.mark.parametrize(
    ("answer", "made"),
    [("...", False), ("None", False), ("'…'", False), ("0", True), ("'up'", True), ("2 * e", True), ("-1", True)],
)
def test_a_prediction_is_made_once_its_dots_are_gone(answer, made):
    assert predictions_in([f"lab.predict('key', 'How high?', answer={answer}, unit='m')"]) == {"key": made}
    assert predictions_in([f"lab.predict('key', 'How high?', {answer})"]) == {"key": made}


def test_predictions_of_a_file_are_counted_whatever_else_it_holds(tmp_path):
    cells = [
        "%matplotlib inline\nlab.predict('a', '?', answer=1)",
        "lab.predict('b', '?', answer=???)",
        "lab.predict('c', '?', answer=...)",
        "lab.predict('c', '?', answer=2)",
        "lab.predict('d', '?')",
    ]
    found = predictions_of(write_notebook(tmp_path / "lab.ipynb", *cells))
    assert found == {"a": True, "c": True, "d": False}
    assert in_words(found) == "Predictions: 2 of 3 made."
    assert in_words({}) == ""


def test_the_last_answer_in_the_text_counts_however_deep_it_is():
    cell = 'if True:\n    lab.predict("rest", "When?", answer=1.0)\nlab.predict("rest", "When?", answer=...)\n'
    assert predictions_in([cell]) == {"rest": False}
    assert predictions_in([cell, 'for _ in "a":\n    lab.predict("rest", "When?", 2.0)']) == {"rest": True}


@pytest.mark.parametrize(
    "odd", ['x = "\\d"', "x = " + "-" * 20_000 + "1", "x = 0x" + "f" * 50_000, "x = " + "[" * 199 + "]" * 199, "x = ("]
)
def test_an_odd_line_beside_a_prediction_raises_nothing(odd):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert predictions_in([f'{odd}\nlab.predict("rest", "When?", 2.0)']) in ({}, {"rest": True})
