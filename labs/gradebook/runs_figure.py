"""The numbers of a class in one scenario as a picture: how many students have which, theory and the engines below."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from reference.arrays import Array
from reference.engines import engine_names, load_engine
from reference.report.figures import STYLE, as_svg, colour_of, marker_of

_BINS = 31
"""An odd number, so that theory is in the middle of one."""
_WIDTH, _HEIGHT = 7.5, 2.6  # inches
_INK = "#444444"


def edges(values: Sequence[float], marks: Mapping[str, float]) -> Array:
    """Edges of the bins, (b + 1,): theory is in the middle, or without theory the median, and all engines are within.

    They reach as far as the engines and most of the students, at most to three times theory; everybody beyond is
    counted in the outermost bins.
    """
    middle = marks.get("theory", float(np.median(values)))
    engines = max((abs(value - middle) for value in marks.values()), default=0.0)
    students = float(np.quantile(np.abs(np.asarray(values) - middle), 0.9))
    reach = max(1.3 * engines, min(1.1 * students, 2 * abs(middle)) if middle else 1.1 * students, 0.1 * abs(middle))
    reach = reach or 1.0
    return np.linspace(middle - reach, middle + reach, _BINS + 1)


def figure(values: Sequence[float], marks: Mapping[str, float], label: str, name: str) -> str:
    """Draw it as an SVG element. marks: theory and engines by name. label: of the axis. name: for ids of its own."""
    import matplotlib
    from matplotlib.figure import Figure

    names = {load_engine(each).title: each for each in engine_names()}
    bins = edges(values, marks)
    counts, _ = np.histogram(np.clip(values, bins[0], bins[-1]), bins)
    with matplotlib.rc_context(STYLE | {"svg.hashsalt": name, "font.size": 9}):
        drawn = Figure(figsize=(_WIDTH, _HEIGHT), layout="constrained")
        above, below = drawn.subplots(2, 1, sharex=True, height_ratios=(3, 1 + len(marks) / 3))
        bars = above.bar(bins[:-1], counts, np.diff(bins), align="edge", color="#9a9a9a", edgecolor="white")
        above.bar_label(bars, _labels(values, counts, bins), padding=1, fontsize=8)
        above.set(yticks=[], ylabel="students", ylim=(0, 1.4 * max(counts)))
        above.spines["left"].set_visible(False)
        for lane, (who, value) in enumerate(marks.items()):
            engine = names.get(who, "")
            look = (
                {"marker": marker_of(engine), "color": colour_of(engine)} if engine else {"marker": "|", "color": _INK}
            )
            below.plot([value], [-lane], markersize=6 if engine else 10, linestyle="", **look)
        below.set(yticks=[-lane for lane in range(len(marks))], ylim=(-len(marks) + 0.4, 0.6), xlabel=label)
        below.set_yticklabels(list(marks))
        below.tick_params(axis="y", length=0)
        below.grid(True, axis="y", color="#dddddd", linewidth=0.6)
        below.spines["left"].set_visible(False)
        if "theory" in marks:
            for axes in (above, below):
                axes.axvline(marks["theory"], color=_INK, linewidth=0.8, linestyle=":")
        return as_svg(drawn, name)


def _labels(values: Sequence[float], counts: Array, bins: Array) -> list[str]:
    """What is written above each bar; above an outermost one, also how many of its students are beyond it."""
    found = np.asarray(values)
    beyond = {0: int((found < bins[0]).sum()), len(counts) - 1: int((found > bins[-1]).sum())}
    return [
        f"{count}\n({beyond[place]} beyond)" if beyond.get(place) else str(count) if count else ""
        for place, count in enumerate(counts)
    ]
