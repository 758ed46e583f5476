"""Shows a run in a notebook: the replay, and the curve beside it.

Each output has a plain-text version as well, because a notebook that is not trusted yet shows no markup, and a terminal
never does.
"""

from __future__ import annotations

import base64
import io
import textwrap
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any

from labs.desk.case_runs import HANDWRITTEN
from labs.desk.tables import who
from labs.guidance.drawings import CARD
from reference.report import figures
from reference.report.sections import Line

if TYPE_CHECKING:
    from labs.desk.case_runs import CaseRuns
    from reference.comparison.curves import Series

DPI = 110
_LEVEL = 0.02
"""A curve that changes by less than this share of its size counts as level."""
_TITLE, _LABEL = 60, 34
"""So many letters of a title have room above a curve, and of a label beside it; a longer one takes two lines."""
_HALF = "flex:1 1 400px;min-width:min(300px,100%);max-width:640px"
"""Replay and curve are side by side if there is room for 400 px each, otherwise one below the other."""


@dataclass(frozen=True)
class Picture:
    """A figure as PNG. text: what it shows, for readers who cannot see it."""

    png: bytes
    text: str

    def _repr_mimebundle_(self, **_: Any) -> dict[str, Any]:
        return {"text/plain": self.text, "text/html": self._image(), "image/png": self.png}

    @property
    def markup(self) -> str:
        """The figure as part of a page, as wide as the place that it has there."""
        return self._image(";width:100%")

    def _image(self, fitted: str = "") -> str:
        """The figure with its text as alternative text, which a bare PNG cannot carry."""
        content = base64.b64encode(self.png).decode("ascii")
        return f'<img alt="{escape(self.text)}" style="{CARD}{fitted}" src="data:image/png;base64,{content}">'


@dataclass(frozen=True)
class Replay:
    """A replay in a frame of its own, over a still picture."""

    markup: str
    text: str

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        return {"text/plain": self.text, "text/html": self.markup}


@dataclass(frozen=True)
class Beside:
    """A replay and a curve side by side; only the curve where no page can be shown."""

    replay: Replay
    curve: Picture

    def _repr_mimebundle_(self, **_: Any) -> dict[str, Any]:
        halves = "".join(f'<div style="{_HALF}">{each.markup}</div>' for each in (self.replay, self.curve))
        markup = f'<div style="display:flex;flex-wrap:wrap;gap:0 12px">{halves}</div>'
        text = f"{self.replay.text}\n{self.curve.text}"
        return {"text/plain": text, "text/html": markup, "image/png": self.curve.png}


def pictures(runs: CaseRuns) -> list[Beside | Replay | Picture]:
    """Replay and curve, if there is anything to see."""
    moving, plotted = replay(runs), curve(runs)
    if moving is not None and plotted is not None:
        return [Beside(moving, plotted)]
    return [each for each in (moving, plotted) if each is not None]


def curve(runs: CaseRuns) -> Picture | None:
    """The family's curve in every implementation; None if no implementation has one."""
    plotted = [line for line in runs.lines if line.result.series is not None]
    if not plotted:
        return None
    import matplotlib
    from matplotlib.figure import Figure

    with matplotlib.rc_context(figures.STYLE):
        figure = Figure(figsize=(figures.WIDTH, figures.HEIGHT), layout="constrained", dpi=DPI)
        axes = figure.add_subplot()
        for line in plotted:
            series = line.result.series
            assert series is not None
            sparse = figures.staggered(len(axes.lines))
            axes.plot(*series.dense(), label=who(line), **figures.marker(line), **look(line), **sparse)
        _widen(axes)
        beside = textwrap.fill(runs.family.curve.y_label, _LABEL)
        axes.set(title=textwrap.fill(runs.title, _TITLE), xlabel="time, s", ylabel=beside)
        figure.legend(loc="outside lower left", ncols=2, handlelength=3)
        content = io.BytesIO()
        figure.savefig(content, format="png")
    told = "; ".join(f"{who(line)} {_course(line.result.series)}" for line in plotted)
    return Picture(content.getvalue(), f"[{runs.family.curve.y_label} over time: {told}]")


def _course(series: Series | None) -> str:
    """Where a curve begins and ends, and between which values it stays, for readers who cannot see it."""
    values = series.values if series else ()
    if not len(values):
        return "has no values"
    first, last, low, high = (f"{each:.3g}" for each in (values[0], values[-1], min(values), max(values)))
    return f"from {first} to {last}, between {low} and {high}"


def _widen(axes: Any) -> None:
    """Show zero if a curve is nearly level: on a scale of its own it would look like a fall."""
    low, high = axes.get_ylim()
    if high - low < _LEVEL * max(abs(low), abs(high)):
        axes.set_ylim(min(low, 0.0), max(high, 0.0))


def look(line: Line) -> dict[str, Any]:
    """A line's colour and stroke: the student's is a broad band in every profile, so it shows below all others."""
    return figures.line_style(line, as_counted=line.result.job.engine == HANDWRITTEN)


def replay(runs: CaseRuns) -> Replay | None:
    """All runs in one picture, the student's solid and the engines as outlines; None if nothing ran."""
    poses = runs.poses
    if not poses:
        return None
    from reference.viewer import clip_making, page  # noqa: PLC0415 - a check needs none of it

    clip = clip_making.clip(runs.case.scenarios[0], poses, runs.title)
    return Replay(page.frame(clip), f"[replay: {', '.join(each.title for each in poses.values())}]")
