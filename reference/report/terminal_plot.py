"""Curves as characters in the terminal, drawn by plotext."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from rich.text import Text

from reference.engines.profiles import is_plain
from reference.report.sections import Line

_GLYPHS = {"handwritten": "●○×", "pybullet": "■□+", "mujoco": "▲△*", "dart": "◆◇~"}
"""An engine's marks for its profiles: tuned, stock, any other."""
_OTHER_GLYPHS, _OTHER_COLOUR = "▼▽-", 36
"""Those of an engine that is not the lab's own."""
_COLOURS = {"handwritten": None, "pybullet": 33, "mujoco": 208, "dart": 35}
"""Among the 256 colours that terminals have; None is the terminal's own. All of them show on black and on white."""
_MARKS_OF_A_CURVE = 6
"""How many marks a curve carries at most."""
_NEAR = 0.1
"""An axis is extended to the next tick if that lies within this share of the axis."""
_COLUMNS_OF_A_TICK, _ROWS_OF_A_TICK = 12, 3
"""How much room each tick takes on the two axes, in characters."""
_ROUNDING = 1e-9
"""A number of ticks is whole if it is so near to a whole number."""


@dataclass(frozen=True)
class Points:
    """Points in the terminal.

    line: the implementation that they belong to, None for theory. joined: whether they form a curve.
    """

    line: Line | None
    xs: Sequence[float]
    ys: Sequence[float]
    joined: bool = True


def marked(line: Line | None) -> Text:
    """The character that marks an implementation's curve: its shape shows the engine, and a filled one counts."""
    if line is None:
        return Text("─")
    job, colour = line.result.job, _colour(line)
    glyphs = _GLYPHS.get(job.engine, _OTHER_GLYPHS)
    glyph = glyphs[0] if line.counts else glyphs[1] if is_plain(job.profile) else glyphs[2]
    return Text(glyph, style="" if colour is None else f"color({colour})")


def plot(curves: Sequence[Points], x_label: str, y_label: str, width: int, height: int) -> Text:
    """Curves against axes of so many characters, drawn by plotext; `ImportError` where that is not installed.

    Lines are made of fine dots. Their marks distinguish them, spread so that the marks of curves that coincide lie side
    by side; colours only help.
    """
    import plotext  # late: an extra, and a plot is not always wanted

    low, high = _range(x for curve in curves for x in curve.xs)
    bottom, top = _rounded(*_range(y for curve in curves for y in curve.ys), height // _ROWS_OF_A_TICK)
    figure = plotext.figure
    plotext.terminal.limit(False, False)  # rich knows the size of the terminal better
    figure.clear()
    figure.theme("colorless")
    figure.plot_size(width, height - 1)
    figure.axes(False, axis="x", side="upper")
    figure.axes(False, axis="y", side="right")
    room = (high - low) * (1 - (len(x_label) + 5) / width)
    for axis, ends, last in (("x", (low, high), low + room), ("y", (bottom, top), top)):
        ticks = [
            tick
            for tick in _ticks(*ends, width // _COLUMNS_OF_A_TICK if axis == "x" else height // _ROWS_OF_A_TICK)
            if tick <= last
        ]
        figure.ruler(axis).lim(*ends)
        figure.ruler(axis).ticks(ticks, [f"{tick:.6g}".replace("-", "−") for tick in ticks])
    for curve in reversed(curves):  # where curves coincide the first is on top, and the others show where they leave it
        if curve.joined:
            figure.draw(figure.signal(list(curve.xs), list(curve.ys), marker=_pen("braille", curve.line)).lines(True))
    owned = [curve for curve in curves if curve.line is not None and len(curve.xs)]
    for place, curve in enumerate(owned):
        xs, ys = _marks(curve, place, len(owned), low, high, width)
        figure.draw(figure.signal(xs, ys, marker=_pen(marked(curve.line).plain, curve.line)))
    lines = Text.from_ansi(figure.build().string()).split("\n")
    lines[-1].truncate(width - len(x_label), pad=True)
    lines[-1].append(x_label)
    return Text("\n", no_wrap=True, end="").join([Text(y_label), *lines])


def _pen(shape: str, line: Line | None) -> object:
    import plotext

    colour = _colour(line)
    return plotext.marker(shape, plotext.pixel() if colour is None else plotext.pixel(foreground=colour))


def _colour(line: Line | None) -> int | None:
    return None if line is None else _COLOURS.get(line.result.job.engine, _OTHER_COLOUR)


def _marks(
    curve: Points, place: int, count: int, low: float, high: float, width: int
) -> tuple[list[float], list[float]]:
    """Where a curve gets its marks: the first of `count` curves early, the last late; single points side by side."""
    if not curve.joined:
        aside = (place - (count - 1) / 2) * (high - low) / width
        return [x + aside for x in curve.xs], list(curve.ys)
    repeats = max(1, min(_MARKS_OF_A_CURVE, width // (3 * count)))
    wanted = [low + (high - low) * (turn + (place + 0.5) / count) / repeats for turn in range(repeats)]
    nearest = [min(range(len(curve.xs)), key=lambda k: abs(curve.xs[k] - x)) for x in wanted if x <= curve.xs[-1]]
    return [curve.xs[k] for k in nearest], [curve.ys[k] for k in nearest]


def _range(values: Iterable[float]) -> tuple[float, float]:
    """Smallest and largest value, moved apart where they are equal."""
    found = list(values)
    low, high = min(found, default=0.0), max(found, default=1.0)
    return (low, high) if high > low else (low - 0.5, high + 0.5)


def _rounded(low: float, high: float, most: int) -> tuple[float, float]:
    """The range up to the next round number, where that is near."""
    step = _step(low, high, most)
    end = math.ceil(high / step - _ROUNDING) * step
    return low, end if end - high <= _NEAR * (high - low) else high


def _ticks(low: float, high: float, most: int) -> list[float]:
    """Round numbers from low to high, about as many as requested and no more."""
    step = _step(low, high, most)
    return [count * step for count in range(math.ceil(low / step - _ROUNDING), math.floor(high / step + _ROUNDING) + 1)]


def _step(low: float, high: float, most: int) -> float:
    """Distance of the ticks: 1, 2 or 5 times a power of ten."""
    finest = (high - low) / max(1, most)
    power = 10.0 ** math.floor(math.log10(finest))
    return next(factor * power for factor in (1, 2, 5, 10) if factor * power >= finest * (1 - _ROUNDING))
