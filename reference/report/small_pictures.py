"""The small pictures of the first screen: curves that coincide are drawn as one, and each curve has its name beside it.

A legend would need more room, and a reader would have to look twice.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from reference.arrays import Array
from reference.engines.handwritten_engine import Handwritten
from reference.report.figures import STYLE, as_svg, colour_of
from reference.report.name_places import LETTERS, Place, placed
from reference.report.sections import Line, Section

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SIZE = (3.7, 2.05)
"""Of a picture, inches. The page shows a point as some 1.26 pixels."""
_AS_ONE = 0.01
"""Curves that are on average less apart than this share of the picture's height are drawn as one."""
_SAMPLES = 240
"""Points of a curve where it is compared with others and kept clear of names."""
_INK = "#1b1b1b"
_DASHES: dict[str, Any] = {"pybullet": (0, (1, 1)), "mujoco": (0, (4, 1.5)), "dart": (0, (4, 1.2, 1, 1.2))}
_NAME_COLOURS = {"pybullet": "#005a90", "mujoco": "#a54300", "dart": "#006b4c"}
"""The engines' colours, dark enough for small text."""


@dataclass(frozen=True)
class Bundle:
    """Implementations whose curves look like one. name: who they are, in words."""

    lines: tuple[Line, ...]
    name: str

    @property
    def colour(self) -> str:
        """Of the name: that of the engine, or of ink where the curve is not one engine's own."""
        return _INK if len(self.lines) > 1 else _NAME_COLOURS.get(self.lines[0].result.job.engine, _INK)


def bundles(section: Section) -> list[Bundle]:
    """What counts and what is plain, together where their curves coincide; first those of the most curves."""
    lines = [line for line in section.lines if (line.counts or line.plain) and _has_curve(line)]
    height = max((float(np.ptp(_sampled(line)[:, 1])) for line in lines), default=0.0)
    found: list[list[Line]] = []
    for line in sorted(lines, key=lambda line: not line.counts):
        near = next((own for own in found if _apart(own[0], line) <= _AS_ONE * height), None)
        if near is None:
            found.append([line])
        else:
            near.append(line)
    return [Bundle(tuple(own), _name(own, lines)) for own in sorted(found, key=len, reverse=True)]


def in_words(section: Section) -> str:
    """The picture for those who hear the page: which implementations share a curve, and which have their own."""
    curve, names = section.family.curve, [bundle.name for bundle in bundles(section)]
    return f"{curve.title}: {curve.y_label} against time. Curves: {'; '.join(names)}."


def picture(section: Section) -> str:
    """The family's curve of what counts and of what is plain, small, as SVG; empty where there is none."""
    drawn = bundles(section)
    if not drawn:
        return ""
    import matplotlib  # late: its import takes half a second
    from matplotlib.figure import Figure

    name = f"{section.family.name}-glance"
    with matplotlib.rc_context(STYLE | {"svg.hashsalt": name, "font.size": LETTERS}):
        figure = Figure(figsize=SIZE, dpi=72, layout="constrained")  # so that a pixel is a point
        axes = figure.add_subplot()
        axes.set_title(f"One run: {section.family.curve.y_label}, against time, s", fontsize=LETTERS)
        axes.tick_params(pad=2, length=3)
        for bundle in drawn:
            _draw(axes, bundle)
        axes.margins(y=0.02)
        low, high = axes.get_ylim()
        axes.set_yticks([tick for tick in axes.get_yticks() if low <= tick <= high])
        axes.set_ylim(low - 0.12 * (high - low), high + 0.08 * (high - low))  # room for names
        figure.draw_without_rendering()  # only now does a point of a curve have its place in the picture
        curves = [np.asarray(axes.transData.transform(_sampled(bundle.lines[0]))) for bundle in drawn]
        places = placed(axes.bbox.extents, [bundle.name for bundle in drawn], curves)
        for bundle, place in zip(drawn, places, strict=True):
            if place:
                _write(axes, bundle, place)
        return as_svg(figure, name)


def _draw(axes: Axes, bundle: Bundle) -> None:
    """One wide line for curves that are one; an engine's own colour and dashes for a curve that goes elsewhere."""
    for line in bundle.lines:
        engine, series = line.result.job.engine, line.result.series
        assert series is not None
        style = {"color": colour_of(engine), "linestyle": _DASHES.get(engine, "--"), "linewidth": 1.5}
        if len(bundle.lines) > 1:
            style = {"color": _INK, "linestyle": "-", "linewidth": 1.8}
        axes.plot(series.times, series.values, **style)


def _write(axes: Axes, bundle: Bundle, place: Place) -> None:
    """A name in its place, with a thin line to its curve where that is not beside it."""
    left, bottom, right, top = place.box
    middle = (left + right) / 2, (bottom + top) / 2
    axes.annotate(place.text, middle, xycoords="figure points", ha="center", va="center", color=bundle.colour)
    if place.led:
        ends = axes.transData.inverted().transform([place.start, place.point])
        axes.plot(*ends.T, color=bundle.colour, linewidth=0.6, scalex=False, scaley=False)


def _has_curve(line: Line) -> bool:
    return line.result.series is not None and bool(line.result.series.times)


def _sampled(line: Line, times: Array | None = None) -> Array:
    """Times of a curve, evenly spread or these, each with the curve's value."""
    series = line.result.series
    assert series is not None
    at = np.linspace(series.times[0], series.times[-1], _SAMPLES) if times is None else times
    return np.stack([at, np.interp(at, series.times, series.values)], axis=1)


def _apart(one: Line, other: Line) -> float:
    """How far two curves are apart on average."""
    first = _sampled(one)
    return float(np.mean(np.abs(first - _sampled(other, first[:, 0]))[:, 1]))


def _name(own: Sequence[Line], every: Sequence[Line]) -> str:
    """The implementations of a bundle in few words: `by hand, all tuned engines, DART as installed: one curve`."""
    by_hand = [line for line in own if line.result.job.engine == Handwritten.name]
    methods = [line for line in every if line.result.job.engine == Handwritten.name]
    parts = ["by hand"] if len(by_hand) == len(methods) > 1 else [line.by_hand for line in by_hand]
    tuned, installed = (_engines(own, counting) for counting in (True, False))
    if len(tuned) > 1 and len(tuned) == len(_engines(every, True)):
        parts.append("all tuned engines")
    elif tuned:
        parts.append(f"{' and '.join(tuned)} tuned")
    if installed:
        parts.append(f"{' and '.join(installed)} as installed")
    return ", ".join(parts) + (": one curve" if len(own) > 1 else "")


def _engines(lines: Sequence[Line], counting: bool) -> list[str]:
    """The engines among these lines, tuned or as installed."""
    engines = [line for line in lines if line.result.job.engine != Handwritten.name]
    return [line.result.title for line in engines if line.counts == counting]
