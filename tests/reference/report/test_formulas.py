"""Formulas between backticks: MathML for a page, plain text for a terminal."""

from __future__ import annotations

import re

import pytest

from reference.catalogue.scenarios import catalogue
from reference.report.formulas import mathml, plain, typeset


def _over(above, function, of):
    return f'<mfrac>{above}<mrow>{function}<mspace width="0.17em"/>{of}</mrow></mfrac>'


@pytest.mark.parametrize(
    ("formula", "expected"),
    [
        ("e²", "<msup><mi>e</mi><mtext>2</mtext></msup>"),
        ("m_A", "<msub><mi>m</mi><mtext>A</mtext></msub>"),
        ("−e v", "<mo>−</mo><mi>e</mi><mi>v</mi>"),
        ("2/7 m", "<mfrac><mn>2</mn><mn>7</mn></mfrac><mi>m</mi>"),
        ("a b/2 + c", "<mfrac><mrow><mi>a</mi><mi>b</mi></mrow><mn>2</mn></mfrac><mo>+</mo><mi>c</mi>"),
        ("v/(4 r)", "<mfrac><mi>v</mi><mrow><mn>4</mn><mi>r</mi></mrow></mfrac>"),
        ("√(2 h)", "<msqrt><mrow><mn>2</mn><mi>h</mi></mrow></msqrt>"),
        ("dt²", "<msup><mrow><mi>d</mi><mi>t</mi></mrow><mtext>2</mtext></msup>"),
        ("e^(−β t)", "<msup><mi>e</mi><mrow><mo>−</mo><mi>β</mi><mi>t</mi></mrow></msup>"),
        ("1/cos φ", _over("<mn>1</mn>", "<mi>cos</mi>", "<mi>φ</mi>")),
        ("1/sin 2φ", _over("<mn>1</mn>", "<mi>sin</mi>", "<mn>2</mn><mi>φ</mi>")),
        ("1/cos² φ", _over("<mn>1</mn>", "<msup><mi>cos</mi><mtext>2</mtext></msup>", "<mi>φ</mi>")),
        ("a ≤ b", "<mi>a</mi><mo>≤</mo><mi>b</mi>"),
        ("a < b", "<mi>a</mi><mo>&lt;</mo><mi>b</mi>"),
    ],
)
def test_a_formula_is_typeset(formula, expected):
    assert mathml(formula) == f"<math>{expected}</math>"


def test_brackets_stay_where_no_stroke_replaces_them():
    found = mathml("g (1 − e)/2")
    assert re.sub("<[^>]*>", "", found) == "g(1−e)2"
    assert re.sub("<[^>]*>", "", mathml("(1 − e)/2")) == "1−e2"


@pytest.mark.parametrize("broken", ["(1 + e", "1 + e)", "a/", "a # b"])
def test_a_broken_formula_is_refused(broken):
    with pytest.raises(ValueError, match=r"."):
        mathml(broken)


def test_prose_about_a_formula_is_escaped_and_the_terminal_has_no_backticks():
    assert typeset("a < `b` & c") == "a &lt; <math><mi>b</mi></math> &amp; c"
    assert plain("the share `d/2` of it") == "the share d/2 of it"


@pytest.mark.parametrize(
    "name",
    ["mesh_step", "tangent_point", "hanging-chain", "ccdSweptSphereRadius", "inertia box", "enableConeFriction=0"],
)
def test_a_name_in_code_is_no_formula(name):
    assert typeset(f"with `{name}` alone") == f"with <code>{name}</code> alone"


def test_every_formula_of_the_catalogue_can_be_typeset():
    texts = [text for family in catalogue().values() for text in (family.about, family.expected, *family.why)]
    assert sum(typeset(text).count("<math>") for text in texts) > 100
    assert all(text.count("`") % 2 == 0 for text in texts)
