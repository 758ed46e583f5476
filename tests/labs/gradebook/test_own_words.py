"""What a class reads about runs without a number has no word that a student wrote."""

from __future__ import annotations

import pytest
from submissions import solved

from labs.gradebook import scenario_runs
from labs.gradebook.own_words import NO_RESULT, NOT_TRIED, in_our_words
from labs.gradebook.runs_compared import spreads
from labs.grading.budget import SECONDS
from reference.comparison.verdicts import NOTHING_FINITE


@pytest.mark.parametrize(
    ("note", "said"),
    [
        ("collide raised ValueError: Bob is ill (cell 3, line 2)", "collide raised ValueError"),
        ("collide raised BobIsIll: no", "collide raised an exception of its own"),
        ("collide could not be defined: NameError: bob", "collide could not be defined because of NameError"),
        ("collide could not be defined: Bob", "collide could not be defined because of an exception of its own"),
        ("collide needs audit (impulse, step 9): it is not written yet", "audit is not written yet"),
        ("collide gave no answer within 5 s and was stopped", "collide ran out of time"),
        ("collide gave no answer: the 20 s of this test are used up", "collide ran out of time"),
        ("collide gave no answer: it ended itself with code 7", "collide gave no answer"),
        ("collide gave a Bob; an answer is a number", "collide gave something that is no answer"),
        ("it was not tried to the end: the 20 s that the whole file has are used up", NOT_TRIED),
        ("ValueError: could not convert 'Bob'", f"{NO_RESULT}, but to a ValueError"),
        ("Bob: is ill", NO_RESULT),
        ("bob raised ValueError", NO_RESULT),
        ("100 impacts within one step of 0.02 s: Bob", "100 impacts within one step"),
        ("with these answers the run comes to no end", "with these answers the run comes to no end"),
        ("", NO_RESULT),
        (NOTHING_FINITE, NOTHING_FINITE),
    ],
)
def test_a_note_is_said_in_our_own_words(note, said):
    assert in_our_words(note) == said


def test_an_exceptions_text_is_not_on_the_page_of_the_class(grader, tmp_path):
    raised = "\n\ndef respond_at_impact(*arguments):\n    raise {}('Bob is ill')\n"
    kept = []
    for number, kind in enumerate(("ValueError", "type('Bob', (Exception,), {})")):
        path = tmp_path / f"{number}.py"
        path.write_text(solved(tmp_path, "response").read_text() + raised.format(kind))
        kept.append(scenario_runs.run(path, "response", grader, SECONDS))
    said = dict(spreads(kept, "response")[0].without)
    assert said == {"respond_at_impact raised ValueError": 1, "respond_at_impact raised an exception of its own": 1}
