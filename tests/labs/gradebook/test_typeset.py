"""The lab's own questions and model answers are typeset; what students write stays plain text."""

from __future__ import annotations

import re
import sys
from xml.etree import ElementTree

import pytest

from labs.building import lessons
from labs.gradebook.typeset import mathml, typeset
from labs.gradebook.written import questions, write_questions

OURS = [each for lab in lessons.lessons() for question in questions(lab) for each in (question.text, question.model)]


def test_every_formula_of_the_questions_and_model_answers_is_typeset():
    page = "".join(map(typeset, OURS))
    found = re.findall(r"<math.*?</math>", page, re.DOTALL)
    assert len(found) > 50
    for formula in found:
        ElementTree.fromstring(formula)
        assert "\\" not in formula
    assert "$" not in re.sub(r"<(code|pre)\b.*?</\1>", "", page, flags=re.DOTALL)
    assert "<li>" not in page  # no formula begins a list


def test_a_dollar_in_code_is_none_of_a_formula_and_html_is_escaped():
    page = typeset("`$x$` costs $ 5, <b>$v\n- g\\,\\Delta t$</b>\n\n```\n$y$\n```\n")
    assert "<code>$x$</code>" in page
    assert "costs $ 5" in page
    assert "$y$" in page
    assert page.count("<math") == 1
    assert "<b>" not in page
    assert "<li>" not in page


def test_a_formula_alone_is_on_a_line_of_its_own_and_greek_capitals_are_upright():
    page = typeset("so that\n\n$$y = -\\Delta t$$\n\nholds.")
    assert 'display="block"' in page
    assert '<mi mathvariant="normal">&#x00394;</mi>' in page
    assert '<mo form="prefix">&#x02212;</mo>' in page


@pytest.mark.parametrize("missing", [True, False])
def test_a_formula_that_cannot_be_typeset_stays_as_it_was_written(missing, monkeypatch):
    formula = "x < \\frac12" if missing else "x^a^b <"
    if missing:
        monkeypatch.setitem(sys.modules, "latex2mathml.converter", None)
    assert mathml(formula) == f"<code>{formula.replace('<', '&lt;')}</code>"


def test_what_a_student_writes_is_not_typeset(tmp_path):
    (question, *_) = questions("impulse")
    write_questions(tmp_path, "impulse", {"1": {question.key: "**no** $\\frac12$ <math><mi>x</mi></math> ```code```"}})
    page = (tmp_path / "questions" / f"{question.key}.html").read_text(encoding="utf-8")
    assert "**no** $\\frac12$ &lt;math&gt;&lt;mi&gt;x&lt;/mi&gt;&lt;/math&gt; ```code```" in page
    assert "*1 point*" not in page
    assert "<em>1 point</em>" in page
