"""Numbers as text: few digits, a real minus sign, a prefix or a power of ten, and nothing else."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.report.numbers import deviation, percent, power_of_ten, quantity, size

UNITS = ("", "m", "s", "m/s")
FACTORS = {"": 1.0, "m": 1e-3, "µ": 1e-6, "n": 1e-9}
DIGITS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
NUMBER = re.compile(r"(?P<sign>[+−]?)(?P<digits>\d+(\.\d+)?)(·10(?P<power>⁻?[⁰¹²³⁴⁵⁶⁷⁸⁹]+))?")
BELOW = re.compile(r"<10(?P<power>⁻?[⁰¹²³⁴⁵⁶⁷⁸⁹]+)")
TWO_DIGITS = 0.05  # half of the second digit, which is largest beside a 1
FIVE_DIGITS = 0.5e-4  # half of the fifth digit, likewise
LARGEST = 1e305  # what is printed, rounded and in percent, is still a float
finite = st.floats(-LARGEST, LARGEST)
positive = st.floats(0, LARGEST, exclude_min=True, allow_subnormal=False)  # below these a bound itself rounds
units = st.sampled_from(UNITS)


def read(text: str, unit: str) -> tuple[str, float, int]:
    """Sign, size and count of significant digits that a reader takes from the text; it fails where there is more."""
    number, space, said = text.partition(" ")
    assert said.endswith(unit)
    assert bool(space) == bool(said)
    found = NUMBER.fullmatch(number)
    assert found, text
    digits = found["digits"]
    value = float(digits) * 10.0 ** int((found["power"] or "0").translate(DIGITS))
    return found["sign"], value * FACTORS[said.removesuffix(unit)], len(digits.replace(".", "").lstrip("0"))


def bound(text: str) -> float:
    """The power of ten that a text says its value stays below."""
    return 10.0 ** int(BELOW.fullmatch(text)["power"].translate(DIGITS))


@pytest.mark.parametrize(
    ("share", "text"),
    [
        (0.0, "0 %"),
        (-0.0, "0 %"),
        (0.0039, "+0.39 %"),
        (-0.36, "−36 %"),
        (1.0, "+100 %"),
        (-12.34, "−1234 %"),
        (0.09949, "+9.9 %"),
        (0.0996, "+10 %"),
        (0.994, "+99 %"),
        (0.996, "+100 %"),
        (2e-6, "+0.0002 %"),
        (9e-7, "<10⁻⁴ %"),
        (-9e-7, "<10⁻⁴ %"),
        (-3e-15, "<10⁻¹² %"),
        (1e6, "+1·10⁸ %"),
        (1e307, "+∞ %"),
    ],
)
def test_a_share_is_printed_in_percent(share, text):
    assert percent(share) == text


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (0.0, "m", "0 m"),
        (0.0, "", "0"),
        (5.5e-6, "m", "+5.5 µm"),
        (-5.5e-6, "m", "−5.5 µm"),
        (-0.0002, "", "−0.0002"),
        (1.1e-5, "", "+1.1·10⁻⁵"),
        (0.25, "m", "+0.25 m"),
        (3e-10, "m", "<1 nm"),
        (-3e-10, "m", "<1 nm"),
        (-3e-12, "", "<10⁻¹¹"),
        (1e-3, "m/s", "+1 mm/s"),
    ],
)
def test_a_deviation_is_printed_with_its_sign_and_unit(value, unit, text):
    assert deviation(value, unit) == text


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (0.0, "m", "0 m"),
        (0.0, "", "0"),
        (1.0, "", "1"),
        (0.81547, "m", "0.81547 m"),
        (-0.81547, "m", "−0.81547 m"),
        (1.3545709, "s", "1.3546 s"),
        (5.5e-6, "m", "5.5 µm"),
        (-3.4e-6, "m", "−3.4 µm"),
        (0.0999, "m", "0.1 m"),
        (0.09, "m", "90 mm"),
        (5e-10, "m", "0 m"),
        (-5e-10, "m", "0 m"),
        (-5e-10, "", "0"),
        (1.1e-5, "", "1.1·10⁻⁵"),
        (99999.0, "m", "99999 m"),
        (123456.0, "m", "1.2346·10⁵ m"),
    ],
)
def test_a_measured_value_has_five_digits_and_two_where_it_is_small(value, unit, text):
    assert quantity(value, unit) == text


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (0.0, "m", "0 m"),
        (0.0, "", "0"),
        (0.51, "m", "0.51 m"),
        (0.0996, "m", "0.1 m"),
        (0.0994, "m", "99 mm"),
        (9.96e-3, "m", "10 mm"),
        (9.94e-3, "m", "9.9 mm"),
        (0.996e-3, "m", "1 mm"),
        (0.994e-3, "m", "994 µm"),
        (5e-4, "s", "500 µs"),
        (4 / 240, "s", "17 ms"),
        (1e-9, "m", "1 nm"),
        (0.99e-9, "m", "<1 nm"),
        (123.0, "", "123"),
        (12.3, "", "12"),
        (0.00053, "", "0.00053"),
        (9.1e-5, "", "9.1·10⁻⁵"),
        (9.9e-10, "", "<10⁻⁹"),
        (1.5e6, "m", "1.5·10⁶ m"),
        (99999.4, "m", "99999 m"),
        (99999.6, "m", "1·10⁵ m"),
    ],
)
def test_a_size_has_a_prefix_that_keeps_its_digits_few(value, unit, text):
    assert size(value, unit) == text


@given(share=finite)
def test_a_percentage_has_two_digits_or_a_power_of_ten(share):
    text = percent(share)
    number, _, unit = text.partition(" ")
    assert unit == "%"
    in_percent = abs(share) * 100
    if number == "0":
        assert share == 0
    elif number.startswith("<"):
        assert in_percent < bound(number) <= 1e-4
        assert in_percent > bound(number) / 11 or in_percent < 1e-300  # the next power; denormals have few digits
    else:
        sign, said, digits = read(number, "")
        assert sign == ("−" if share < 0 else "+")
        assert said == pytest.approx(in_percent, rel=TWO_DIGITS)
        assert digits <= 5


@given(value=finite, unit=units)
def test_a_measured_value_is_printed_to_five_digits_or_two_if_small(value, unit):
    text = quantity(value, unit)
    sign, said, digits = read(text, unit)
    if said == 0:
        assert abs(value) < 1e-9
        assert sign == ""
    else:
        assert sign == ("−" if value < 0 else "")
        assert said == pytest.approx(abs(value), rel=FIVE_DIGITS if abs(value) >= 0.1 or not unit else TWO_DIGITS)
        assert digits <= 5


@given(value=positive, unit=units)
def test_a_size_is_printed_to_two_digits_or_as_a_bound(value, unit):
    text = size(value, unit)
    if text.startswith("<"):
        assert value < (1e-9 if unit else bound(text))
        assert not unit or text == f"<1 n{unit}"
    else:
        sign, said, digits = read(text, unit)
        assert sign == ""
        assert said == pytest.approx(value, rel=TWO_DIGITS)
        assert digits <= 5


@given(value=positive, unit=units)
def test_a_deviation_is_a_size_with_the_sign_of_its_direction(value, unit):
    up, down, bare = deviation(value, unit), deviation(-value, unit), size(value, unit)
    if bare.startswith("<"):
        assert up == down == bare
    else:
        assert (up, down) == (f"+{bare}", f"−{bare}")


@given(value=finite, unit=units)
def test_no_number_is_printed_in_programmers_notation(value, unit):
    for text in (percent(value), deviation(value, unit), quantity(value, unit), size(abs(value), unit)):
        assert not re.search(r"e[+-]|nan|inf|-|,|  |^ | $", text), text
        assert len(text) <= 15 + len(unit)  # a column of the narrowest table


@pytest.mark.parametrize(
    ("value", "text"), [(1.0, "10⁰"), (1e-3, "10⁻³"), (2e-12, "2·10⁻¹²"), (9.4e4, "9·10⁴"), (0.96e-3, "10⁻³")]
)
def test_a_logarithmic_label_has_one_digit_and_leaves_out_a_one(value, text):
    assert power_of_ten(value) == text
