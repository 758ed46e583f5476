"""Makes figures smaller: long lines in steps of a tenth of a point, one style for the markers of a line, no blanks."""

from __future__ import annotations

import re
from itertools import pairwise

FEWEST = 8
"""Points of a line that is rewritten; shorter ones are markers, ticks and frames, which many tests read."""
PARTS = 10
"""Parts of a point to which the places of a line are kept: a tenth of one, 0.035 mm on paper, is not seen."""
FONT = "font-family: 'DejaVu Sans', sans-serif; "
"""What every text of a figure says of itself, and the figure can say for all."""
_LINE = re.compile(r'(?<= d=")M -?[\d.]+ -?[\d.]+\s+(?:L -?[\d.]+ -?[\d.]+\s*)+(?=")')
_MARKERS = re.compile(r"(<g clip-path=[^>]*)>((?:<use [^>]*/>)+)</g>")
_TICK = re.compile(r'<path id="(\w+)" d="M 0 0 \s*L (-?[\d.]+) (-?[\d.]+)\s*"( style="[^"]*")/>')
_STYLE = re.compile(r' style="[^"]*"')
_NUMBER = re.compile(r"-?[\d.]+")


def compact(svg: str) -> str:
    """The same figure. Steps are between rounded places, so that no error adds up along a line."""
    svg = _LINE.sub(lambda found: _steps(found[0]), svg)
    svg = re.sub(r' transform="rotate\(-0 [^"]*"', "", svg)
    if FONT in svg:
        svg = svg.replace(FONT, "").replace("<svg", f'<svg style="{FONT.rstrip("; ")}"', 1)
    return _ticks_together(_without_bare_groups(_MARKERS.sub(_styled_together, re.sub(r">\s+<", "><", svg))))


def _ticks_together(svg: str) -> str:
    """The same with one path for ticks that follow each other along an axis."""
    for name, x, y, style in _TICK.findall(svg):
        one = rf'<use xlink:href="#{name}" x="(-?[\d.]+)" y="(-?[\d.]+)"/>'

        def drawn(ticks: re.Match[str], one: str = one, way: str = f"l{x} {y}", style: str = style) -> str:
            places = re.findall(one, ticks[0])
            return f'<path d="{"".join(f"M{at_x} {at_y}{way}" for at_x, at_y in places)}"{style}/>'

        svg = re.sub(f"(?:{one}){{2,}}", drawn, svg)
    return svg


def _styled_together(group: re.Match[str]) -> str:
    """The markers of a line with their style in their group, where they all have the same."""
    styles = _STYLE.findall(group[2])
    if len(styles) != group[2].count("<use ") or len(set(styles)) != 1:
        return group[0]
    return f"{group[1]}{styles[0]}>{_STYLE.sub('', group[2])}</g>"


def _without_bare_groups(svg: str) -> str:
    """The same without groups that say nothing of what they hold."""
    kept, bare = list[str](), list[bool]()
    for part in re.split(r"(<g(?: [^>]*)?>|</g>)", svg):
        if part == "</g>":
            if not bare.pop():
                kept.append(part)
            continue
        if part.startswith("<g"):
            bare.append(part == "<g>")
        if part != "<g>":
            kept.append(part)
    return "".join(kept)


def _steps(line: str) -> str:
    numbers = [round(float(number) * PARTS) for number in _NUMBER.findall(line)]
    places = list(zip(numbers[::2], numbers[1::2], strict=True))
    if len(places) < FEWEST:
        return line
    steps = [(x - before_x, y - before_y) for (before_x, before_y), (x, y) in pairwise(places)]
    words = [_said(part) for step in steps if step != (0, 0) for part in step]
    # A minus sign, or a point after a number that has one, needs no blank before it
    rest = re.sub(r" (?=-)", "", " ".join(words))
    return f"M{_said(places[0][0])} {_said(places[0][1])}l{rest}" if words else line


def _said(tenths: int) -> str:
    """A number of tenths as SVG reads it: 12 → 1.2, 5 → .5, −20 → −2."""
    text = f"{abs(tenths) / PARTS:.1f}".removesuffix(".0").removeprefix("0" if 0 < abs(tenths) < PARTS else "")
    return f"-{text}" if tenths < 0 else text
