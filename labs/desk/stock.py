"""Engines as they come, for a notebook: their replay and numbers from recordings, and the ways of bodies from above.

`lab.run` has tuned engines. A lesson shows stock ones with this module where their defaults are the story, or engines
of another profile, such as those whose contacts are springs.
"""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from labs.desk.case_runs import CaseRuns
from labs.desk.display import DPI, Picture, Replay
from labs.desk.tables import tables
from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.family import Family
from reference.catalogue.scenarios import find
from reference.comparison.results import JobResult
from reference.engines.profiles import STOCK
from reference.errors import InvalidInput
from reference.recording.reading import recall
from reference.report import figures
from reference.report.replays import case_clip
from reference.running.study import plan
from reference.viewer import page
from reference.viewer.picture_bounds import seen_into
from reference.viewer.tracks import unpack

STROKES = ("-", "--", ":", "-.")
MARKERS = ("o", "s", "^", "D", "v", "P")
_LOWEST, _AROUND = 2.4, 1.6
"""Inches: the height of a picture of ways that are long and flat, and what title, axis and legend take of a height."""


@dataclass(frozen=True)
class StockRuns:
    """Recorded runs of one case in engines.

    quantities: the numbers that a table shows. title: of the replay. into: whether it is seen from obliquely above.
    """

    runs: CaseRuns
    quantities: tuple[str, ...]
    title: str
    into: bool = False

    def way(self, engine: str) -> Array:
        """Where the moving body's centre is from above, from its start, (n, 2), m."""
        found = {line.result.job.engine: line.result for line in self.runs.lines}
        if engine not in found:
            raise InvalidInput(f"{engine!r} is none of these runs: {', '.join(found)}")
        (track,) = found[engine].poses
        places = unpack(track, engine).positions[:, 0, :2]
        return np.asarray(places - places[0])

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        table = tables(self.runs, self.quantities)._repr_mimebundle_()
        clip = case_clip(self.runs.case, self.runs.lines, self.title, all_shown=True)
        if clip is None:
            return table
        seen = seen_into(clip) if self.into else clip
        shown = Replay(page.frame(seen), f"[replay: {', '.join(line.title for line in self.runs.lines)}]")
        return {
            "text/plain": f"{shown.text}\n{table['text/plain']}",
            "text/html": f'<div style="max-width:640px">{shown.markup}</div>{table["text/html"]}',
        }


def as_they_come(
    case: str, engines: Sequence[str], quantities: Sequence[str], profile: str = STOCK, *, into: bool = False
) -> StockRuns:
    """Recorded runs of stock engines, or of engines with another profile.

    case: `family/case`. engines: such as `("mujoco", "dart")`. profile: such as `"spring"`, contacts that are springs.
    into: whether the replay is seen from obliquely above, as one looks into a bowl.

    Raises
    ------
    InvalidInput, UnknownName
        If there is no such case, engine, profile or quantity, or an engine has no recording of it.
    """
    family, chosen, results = recorded(case, engines, profile)
    for name in quantities:
        family.quantity(name)
    runs = CaseRuns(family, chosen, results)
    return StockRuns(runs, tuple(quantities), f"{runs.title}: engines {_words(profile)}", into)


def recorded(case: str, engines: Sequence[str], profile: str) -> tuple[Family, Case, tuple[JobResult, ...]]:
    """The recorded runs of a case, with their poses, in engines with the settings of a profile.

    Raises
    ------
    InvalidInput, UnknownName
        If there is no such case or engine, or an engine has no recording of it.
    """
    family, chosen = find(case)
    if chosen is None:
        raise InvalidInput(f"{case!r} names no case: give family/case, such as {family.name}/{family.curve.case}")
    results = []
    for engine in engines:
        (job,) = plan([family], [engine], [profile], {family.name: (chosen.name,)})
        result = recall(replace(job, with_poses=True, with_curve=True))
        if result is None or not result.poses:
            raise InvalidInput(f"{engine}: no recording of {case} {_words(profile)}")
        results.append(result)
    return family, chosen, tuple(results)


def _words(profile: str) -> str:
    return "as they come" if profile == STOCK else f"with the profile {profile}"


def from_above(ways: Mapping[str, Array]) -> Picture:
    """Draw ways over the floor, (n, 2) or (n, 3) each, m, by name; a marker of its own at each end."""
    import matplotlib
    from matplotlib.figure import Figure

    with matplotlib.rc_context(figures.STYLE):
        figure = Figure(figsize=(figures.WIDTH, _height(ways)), layout="constrained", dpi=DPI)
        axes = figure.add_subplot()
        for place, (name, way) in enumerate(ways.items()):
            points = np.asarray(way, dtype=float)[:, :2]
            (line,) = axes.plot(points[:, 0], points[:, 1], STROKES[place % len(STROKES)], label=name)
            last = MARKERS[place % len(MARKERS)]
            axes.plot(*points[-1], last, color=line.get_color(), mfc="none", markersize=9)
        axes.set(xlabel="x, m", ylabel="y, m", aspect="equal", title="from above")
        figure.legend(loc="outside lower left", ncols=2, handlelength=3)
        content = io.BytesIO()
        figure.savefig(content, format="png")
    ends = "; ".join(f"{name} ends at ({_metres(way[-1][0])}, {_metres(way[-1][1])}) m" for name, way in ways.items())
    return Picture(content.getvalue(), f"[from above: {ends}]")


def _height(ways: Mapping[str, Array]) -> float:
    """Inches for a picture of ways at equal scales: long, flat ones would leave most of a high picture empty."""
    across, up = np.ptp(np.concatenate([np.asarray(way, dtype=float)[:, :2] for way in ways.values()]), axis=0)
    flat = figures.WIDTH * up / across if across > 0 else np.inf
    return float(np.clip(flat + _AROUND, _LOWEST, figures.HEIGHT))


def _metres(coordinate: float) -> str:
    """A coordinate to the millimetre, with a zero that has no sign."""
    return f"{round(float(coordinate), 3) + 0.0:.3f}"
