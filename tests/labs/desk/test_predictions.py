"""A verdict on a prediction: in words, in numbers, by theory, or by what the lab says itself."""

from __future__ import annotations

import pytest

from labs.desk.predictions import predicted
from labs.guidance.hint_files import Answer

UP = Answer("up", reason="it keeps half")
THIN = Answer("0.4 ± 0.05", 0.4, 0.05, "$w/2$ counts")


@pytest.mark.parametrize(
    ("answer", "choices", "right", "theory", "verdict"),
    [
        ("up", ("up", "down"), UP, None, "You predicted “up”, and that is right. It keeps half."),
        ("down", ("up", "down"), UP, None, "You predicted “down”, but “up” is right. It keeps half."),
        ("up", ("up", "down"), None, 1.0, ""),
        (0.25, (), None, 0.25, "You predicted 0.25 m, and that is right."),
        (0.26, (), None, 0.25, "You predicted 0.26 m, which is near enough: 0.25 m is right."),
        (0.3, (), Answer(reason="e² counts."), 0.25, "You predicted 0.3 m, but 0.25 m is right. e² counts."),
        (-1.0, (), None, 0.0, "You predicted −1 m, but 0 m is right."),
        (0.005, (), None, 0.0, "You predicted 0.005 m, which is near enough: 0 m is right."),
        (0.44, (), THIN, 0.0, "You predicted 0.44 m, which is near enough: 0.4 m is right. $w/2$ counts."),
        (0.0, (), THIN, 0.0, "You predicted 0 m, but 0.4 m is right. $w/2$ counts."),
        (0.3, (), None, None, ""),
        (..., (), UP, 1.0, ""),
    ],
)
def test_a_prediction_gets_a_verdict_with_its_reason(answer, choices, right, theory, verdict):
    assert predicted("key", "?", answer, "" if choices else "m", choices, right).verdict(theory) == verdict


def test_an_experiment_is_run_and_judged_once_it_was_predicted(lab, capsys):
    lab.predict("counted", "It counts …", answer=..., choices=("more", "170", "fewer"))
    lab.show(lambda: print("100 of 170"), predicted="counted")
    assert "Folded until you have predicted 'counted'" in (said := capsys.readouterr().out)
    assert "100" not in said
    lab.show(lambda: print("100 of 170"), predicted="counted", unfold=True)
    assert capsys.readouterr().out == "100 of 170\n"
    lab.predict("counted", "It counts …", answer="more", choices=("more", "170", "fewer"))
    lab.show(lambda: print("100 of 170"), predicted="counted")
    said = capsys.readouterr().out
    assert "100 of 170\nYou predicted “more”, but “fewer” is right. Only 100 of the 170" in said


def test_an_experiment_with_an_unwritten_function_says_what_it_waits_for(lab, capsys):
    def slides():
        raise NotImplementedError("friction: sliding_motion is yours to write")

    lab.show(slides)
    said = "This runs as soon as you have written what it needs (friction: sliding_motion is yours to write).\n"
    assert capsys.readouterr().out == said
