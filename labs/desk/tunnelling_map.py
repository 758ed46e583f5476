"""Draws which pellets pass a wall, over the thickness of the wall and the distance per step: yours and the engines'."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from labs.desk.display import DPI, Picture
from reference.arrays import Array
from reference.catalogue.scenarios import pellets
from reference.engines import load_engine
from reference.engines.profiles import SWEPT, TUNED
from reference.errors import InvalidInput, NotRecorded
from reference.recording.entries import Entry, names_of
from reference.recording.files import content_of
from reference.recording.fingerprint import fingerprint
from reference.report import figures

RADIUS = pellets.RADIUS
"""Of the pellets, m."""
ENGINE = "pybullet"
"""Whose shares are on the map. At equal timesteps those of MuJoCo and DART are the same; only DART cannot sweep."""
_PASS, _CAUGHT = "#d55e00", "white"
_CARD = {"boxstyle": "round,pad=0.1", "fc": "white", "ec": "none", "alpha": 0.8}


def tunnelling_map(yours: Mapping[str, ArrayLike], thicknesses: ArrayLike, ways: ArrayLike) -> Picture:
    """Draw two maps side by side: a test at the ends of steps, and one along them.

    yours: for each of the two, by its title, the share of your pellets that pass, (t, w). It is drawn in grey, the
    darker the more pass. thicknesses: of the wall, (t,), m. ways: of a pellet in a step, (w,), m. The recorded shares
    of engines are written on the maps: those of tuned engines on the first, and those of engines that sweep on the
    second. Three lines on the first map are the ways on which a pellet is noticed.

    Raises
    ------
    InvalidInput
        If there are not two maps, or one has another shape.
    """
    walls, steps = np.asarray(thicknesses, dtype=float), np.asarray(ways, dtype=float)
    shares = {name: np.asarray(values, dtype=float) for name, values in yours.items()}
    if len(shares) != 2:
        raise InvalidInput(f"give two maps, not {len(shares)}")
    for name, values in shares.items():
        if values.shape != (len(walls), len(steps)):
            raise InvalidInput(f"{name}: {values.shape} shares for {len(walls)} walls and {len(steps)} ways")
    import matplotlib
    from matplotlib.figure import Figure

    said = []
    with matplotlib.rc_context(figures.STYLE):
        figure = Figure(figsize=(1.35 * figures.WIDTH, 1.1 * figures.HEIGHT), layout="constrained", dpi=DPI)
        panels = figure.subplots(1, 2, sharey=True)
        for axes, (name, values), profile in zip(panels, shares.items(), (TUNED, SWEPT), strict=True):
            axes.pcolormesh(1e3 * walls, 1e3 * steps, values.T, cmap="Greys", vmin=0, vmax=1.6, shading="nearest")
            axes.set(xscale="log", yscale="log", title=name, xlabel="thickness of the wall w, mm")
            axes.set_xticks(*_ticks(walls, (2, 3, 5, 10, 20, 30)), minor=False)
            axes.set_yticks(*_ticks(steps, (5, 10, 20, 50, 100, 200)), minor=False)
            axes.minorticks_off()
            axes.grid(False)
            points = recorded_shares(ENGINE, profile)
            _mark(axes, points)
            passing = sum(share > 0 for *_, share in points)
            said.append(f"{name}: yours {values.max():.0%} at most, engines pass at {passing} of {len(points)} points")
        thick = np.linspace(walls.min(), walls.max(), 100)
        panels[0].plot(1e3 * thick, 1e3 * (thick + 2 * RADIUS), color=figures.COLOURS["handwritten"], label="w + 2r")
        panels[0].plot(
            1e3 * thick, 1e3 * (thick / 2 + RADIUS), "--", color=figures.COLOURS["pybullet"], label="w/2 + r"
        )
        panels[0].set(ylabel="distance per step D, mm", xlim=(1e3 * walls.min(), 1e3 * walls.max()))
        panels[0].set(ylim=(1e3 * steps.min(), 1e3 * steps.max()))
        panels[1].set(xlim=panels[0].get_xlim())
        shown = dict(zip(*panels[0].get_legend_handles_labels()[::-1], strict=True))
        figure.legend(shown.values(), shown.keys(), loc="outside lower center", ncols=4, handlelength=3)
        content = io.BytesIO()
        figure.savefig(content, format="png")
    return Picture(content.getvalue(), f"[tunnelling map: {'; '.join(said)}]")


def recorded_shares(engine: str, profile: str) -> list[tuple[float, float, float]]:
    """Thickness of the wall, m, distance per step, m, and the share of recorded pellets that pass, for a whole grid.

    Raises
    ------
    NotRecorded
        If a point of the grid was never recorded, or with other scenarios or settings than today's.
    """
    family, loaded = pellets.PELLETS, load_engine(engine)
    content = content_of(engine, family.name)
    if family.grid is None or content is None:
        raise NotRecorded(f"{engine}: no pellets were recorded")
    taken, found = content["profiles"][profile], []
    place = taken["quantities"].index("passed")
    for case in family.grid.cases:
        own = loaded.settings(case.scenarios[0], profile)
        for timestep in family.grid.timesteps:
            settings = own.change(timestep=timestep)
            names = [name for name in names_of(case.name, own, settings) if name in taken["entries"]]
            entries = [Entry.read(taken["entries"][name]) for name in names]
            asked = fingerprint(case, settings)
            share = next((each.numbers[place].mean for each in entries if each.fingerprint == asked), None)
            if share is None:
                raise NotRecorded(f"{engine}, {profile}: {case.name} was not recorded at {1e3 * timestep:g} ms")
            found.append((case.parameters["thickness"], case.parameters["speed"] * timestep, share))
    return found


def _ticks(values: Array, marks: Sequence[float]) -> tuple[list[float], list[str]]:
    """Those marks, mm, that lie within some lengths, m, and what is written at each."""
    inside = [mark for mark in marks if 1e3 * values.min() <= mark <= 1e3 * values.max()]
    return inside, [f"{mark:g}" for mark in inside]


def _mark(axes: Any, points: Sequence[tuple[float, float, float]]) -> None:
    """A mark for each point, full if pellets pass, with the share in percent on one side and the other in turns."""
    for passes, label in ((False, "engines: none passes"), (True, "engines: some pass")):
        chosen = np.array([point for point in points if (point[2] > 0) == passes]).reshape(-1, 3)
        looks = {"mfc": _PASS if passes else _CAUGHT, "mec": "black", "markersize": 7}
        axes.plot(1e3 * chosen[:, 0], 1e3 * chosen[:, 1], "s" if passes else "o", label=label, ls="", **looks)
    for number, (thickness, way, share) in enumerate(sorted(points)):
        right = number % 2 == 0
        looks = {"va": "center", "ha": "left" if right else "right", "size": 8, "bbox": _CARD}
        place = (1e3 * thickness, 1e3 * way)
        axes.annotate(f"{share:.0%}", place, (8 if right else -8, 0), textcoords="offset points", **looks)
