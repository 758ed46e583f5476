"""One line of a derivation: every form of it is right, a wrong one is told where, and nothing else is evaluated."""

from __future__ import annotations

import pytest

from labs.guidance.hint_files import derivation
from reference.errors import InvalidInput

IMPULSE = derivation("j = -(1 + e) * u / k\nu: before, m/s, -5 to -1\ne: restitution, 0 to 1\nk: 1/kg, 0.2 to 4")
SHARE = derivation("P = max(0, 1 - w / d)\nw: way, m, 0.01 to 0.06\nd: step, m, 0.02 to 0.1")
TIME = derivation("T = 2 * s / (sqrt(u**2 - 2 * a * s) - u)\ns: m, 0 to 3\nu: m/s, -4 to -1\na: m/s², -10 to -1")


def difference(derivation, line):
    return derivation.difference(derivation.read(line))


@pytest.mark.parametrize(
    ("asked", "line"),
    [
        (IMPULSE, "-(1 + e) * u / k"),
        (IMPULSE, "j = (u + e*u) / -k"),
        (IMPULSE, "−u/k − e*u/k"),
        (SHARE, "-min(w/d - 1, 0)"),
        (SHARE, "(abs(1 - w/d) + 1 - w/d) / 2"),
        (TIME, "(-u - (u*u - 2*a*s)**0.5) / a"),
    ],
)
def test_every_equivalent_form_is_right(asked, line):
    assert difference(asked, line) == ""


def test_a_wrong_line_is_told_the_roundest_numbers_and_not_the_formula():
    said = difference(IMPULSE, "-(1 - e) * u / k")
    assert said == "At u = −1, e = 0.5 and k = 2 your line gives 0.25; the equation holds for 0.75."


def test_round_numbers_of_a_small_range_have_its_size():
    said = difference(SHARE, "1 - w / d")  # differs only where the step is shorter than the way
    assert said == "At w = 0.03 and d = 0.02 your line gives −0.5; the equation holds for 0."


@pytest.mark.parametrize(
    ("line", "slip"),
    [
        ("(1 + e) * u / k", "Yours is −1 times what is needed, whatever the numbers: look for a sign."),
        ("-2 * (1 + e) * u / k", "Yours is 2 times what is needed, whatever the numbers: look for a factor."),
        ("-(1 + e) * u", ""),
        ("0", ""),
    ],
)
def test_a_constant_ratio_is_named_as_a_sign_or_a_factor(line, slip):
    said = difference(IMPULSE, line)
    assert said.endswith(slip or ".")
    assert ("times" in said) == bool(slip)


def test_a_term_that_vanishes_at_round_numbers_is_still_missed():
    asked = derivation("y = x + sin(3.141592653589793 * x)\nx: 1, 1 to 5")
    assert "At x = 2.12 your line gives 2.12; the equation holds for 2.489." in difference(asked, "x")


@pytest.mark.parametrize("line", ["sqrt(u)", "1 / 0", "9 ** 9 ** 9 ** 9", "1e299 * 1e299"])
def test_a_line_without_a_value_is_wrong_and_says_so(line):
    assert "your line gives no number" in difference(IMPULSE, line)


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("-(1 + e) * v / k", "unknown quantity 'v'. Choices: u, e, k."),
        ("2u", "a product without \\*"),
        ("u^2", "write \\*\\* for it"),
        ("e(u)", "a \\* is missing between e and"),
        ("2(u)", "a \\* is missing before a bracket"),
        ("sqrt(u, k)", "sqrt takes one value"),
        ("max(u)", "max takes two values or more"),
        ("__import__('os').system('true')", "is not understood here"),
        ("u.real", "is not understood here"),
        ("[u][0]", "is not understood here"),
        ("u if e else k", "is not understood here"),
        ("max(*u)", "max takes|not understood"),
        ("sqrt(x=u)", "is not understood here"),
        ("'u'", "is not understood here"),
        ("True", "is not understood here"),
        ("1j", "is not understood here"),
        ("1" * 400, "is not understood here"),
        ("u" * 501, "501 characters"),
    ],
)
def test_anything_but_a_formula_is_refused_in_words(line, said):
    with pytest.raises(InvalidInput, match=said):
        difference(IMPULSE, line)


@pytest.mark.parametrize(
    ("block", "said"),
    [
        ("u / k\nu: a, 0 to 1", "is no line such as"),
        ("j = u\nu: velocity", "is no quantity such as"),
        ("j = u\nu: velocity, 2 to 1", "is empty"),
        ("j = u\nu: velocity, a to 1", "is not two numbers"),
        ("j = u\nj: impulse, N s", "names no quantities"),
        ("j = u / v\nu: velocity, 0 to 1", "unknown quantity 'v'"),
        ("j = sqrt(u)\nu: velocity, -2 to 1", "has no value somewhere"),
    ],
)
def test_a_block_that_asks_for_nothing_sensible_is_refused(block, said):
    with pytest.raises(InvalidInput, match=said):
        derivation(block)
