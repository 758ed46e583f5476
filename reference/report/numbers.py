"""Numbers as a person reads them: a real minus sign, few digits, a prefix or a power of ten for what is small."""

from __future__ import annotations

import math

_PREFIXES = ((1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"))
_LEAST = 1e-9
"""The least size that is printed: a measured value below it is zero, and a difference is below a power of ten."""
_LEAST_PERCENT = 1e-4
"""The least percentage that is printed, in percent; below it, only the power of ten is."""


def percent(share: float) -> str:
    """A signed share of one as percent: `+0.39 %`, `−36 %`; below 0.0001 % the next power of ten above it."""
    size = abs(share) * 100
    if size == 0:
        return "0 %"
    if size < _LEAST_PERCENT:
        return f"{_below(size)} %"
    return f"{_sign(share)}{_few_digits(size)} %"


def deviation(value: float, unit: str) -> str:
    """A signed difference in its unit: `+5.5 µm`, `−0.0002`, `<1 nm`."""
    if value == 0:
        return f"0 {unit}".strip()
    small = size(abs(value), unit)
    return small if small.startswith("<") else f"{_sign(value)}{small}"


def quantity(value: float, unit: str) -> str:
    """A measured value in its unit: `0.81547 m`, `5.5 µm`."""
    if abs(value) < _LEAST:
        return f"0 {unit}".strip()
    sign = "−" if value < 0 else ""
    if abs(value) >= 0.1 or not unit:
        return f"{sign}{_digits(abs(value), 5)} {unit}".strip()
    return f"{sign}{size(abs(value), unit)}"


def digits(value: float, count: int) -> str:
    """A value with so many digits, without a unit: `0.179593007`, `−6.2784·10⁻⁵`."""
    return ("−" if value < 0 else "") + _digits(abs(value), count)


def size(value: float, unit: str) -> str:
    """A positive value with a prefix and two or three digits; the limits are those at which rounding changes both."""
    if value == 0:
        return f"0 {unit}".strip()
    if unit in ("", "°"):  # neither has prefixes
        return f"{_few_digits(value) if value >= _LEAST else _below(value)} {unit}".strip()
    for factor, prefix in _PREFIXES:
        if value >= factor * (0.0995 if factor == 1 else 0.995):  # 0.51 m, not 510 mm
            return f"{_few_digits(value / factor)} {prefix}{unit}"
    return f"<1 n{unit}"


def power_of_ten(value: float) -> str:
    """A positive value with one digit, as on a logarithmic axis: `10⁻³`, `2·10⁻³`."""
    digit, _, power = f"{value:.0e}".partition("e")
    return f"{'' if digit == '1' else f'{digit}·'}10{_superscript(int(power))}"


def _few_digits(value: float) -> str:
    return f"{value:.0f}" if 9.95 <= value < 99999.5 else _digits(value, 2)


def _digits(value: float, count: int) -> str:
    """So many digits, with a power of ten where there would be many zeros: `1.2·10⁻⁵`."""
    if math.isinf(value):
        return "∞"
    digits, exponent, power = f"{value:.{count}g}".partition("e")
    return f"{digits}·10{_superscript(int(power))}" if exponent else digits


def _below(value: float) -> str:
    """The power of ten next above a value: `<10⁻¹²`."""
    return f"<10{_superscript(math.floor(math.log10(value)) + 1)}"


def _sign(value: float) -> str:
    return "−" if value < 0 else "+"


def _superscript(power: int) -> str:
    return str(power).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
