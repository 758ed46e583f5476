"""Figures of a sphere's drag beyond Stokes' law: fast flows and walls near by (statement 26)."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from solutions import forces

WIDTH = 1.6


def where_stokes_ends(figure: Figure) -> None:
    """Drag of a sphere over Stokes', against the Reynolds number, by several fits to experiments, each in its range.

    It is 1.8 % more at 0.1, where the lab begins to warn, and 13 % more at 1; a ball in the air meets hundreds of times
    what Stokes' law says. Only Morrison's fit follows the fall of the drag where the boundary layer turns turbulent.
    """
    axes = figure.add_subplot()
    others = [name for name in forces.CORRELATIONS if name not in ("Clift", "Morrison", "Stokes")]
    for name in (*others, "Morrison", "Clift"):
        fit = forces.CORRELATIONS[name]
        reynolds = np.geomspace(max(fit.least, 1e-3), fit.most, 500)
        style = {
            "Clift": {"color": "#1b1b1b", "lw": WIDTH, "label": "measured (Clift, Grace and Weber)"},
            "Morrison": {"color": "#009e73", "lw": WIDTH, "ls": ":", "label": "Morrison"},
        }.get(name, {"color": "#999999", "lw": 0.7, "label": f"{len(others)} other fits" if name == "Rouse" else None})
        axes.loglog(reynolds, forces.drag_correction(reynolds, name), **style)
    axes.axhline(1, ls="--", color="#0072b2", label="Stokes")
    for at, words in ((0.1, "1.8 %"), (1.0, "13 %")):
        axes.plot(at, forces.drag_correction(at), "o", ms=5, color="#d55e00")
        axes.annotate(words, (at, forces.drag_correction(at)), (-6, 9), textcoords="offset points", ha="center")
    marks = {"sand grain\nin water": 0.3, "hail": 3e3, "tennis ball": 1.2e5}
    for words, at in marks.items():
        axes.annotate(words, (at, 0.33), ha="center", va="center", fontsize=9, color="#555555")
    axes.axvspan(1e-3, forces.STOKES_LIMIT, color="#0072b2", alpha=0.1, lw=0)
    axes.set(xlabel="Reynolds number 2 r ρ_f v/η", ylabel="drag over 6πη r v", ylim=(0.15, 1e4))
    axes.set_title("Stokes' law is for slow and small things")
    axes.legend(loc="upper left")


def walls(figure: Figure) -> None:
    """How walls raise the drag of a slow sphere: lines by formula, within their ranges; marks are exact values.

    The exact values are those of Haberman and Sayre (tube), of Goldman, Cox and Brenner (along a wall) and of Brenner
    (towards it). A sphere at a tenth of the distance already meets 6 % to 26 % more drag.
    """
    axes = figure.add_subplot()
    cases = (
        ("in a tube, r/R", forces.tube_wall_factor, 0.3, [0.1, 0.2, 0.3], [1.263, 1.680, 2.371], "#1b1b1b", "o"),
        (
            "towards a plane wall, r/h",
            forces.perpendicular_wall_factor,
            0.75,
            1 / np.cosh([3.0, 2.5, 2.0, 1.5, 1.0]),
            [1.12525, 1.22199, 1.41287, 1.83747, 3.03606],
            "#d55e00",
            "s",
        ),
        (
            "along a plane wall, r/h",
            forces.parallel_wall_factor,
            1 / 1.5,
            1 / np.array([10.0677, 3.7622, 2.3524, 1.5431]),
            [1.0591, 1.1738, 1.3079, 1.5675],
            "#0072b2",
            "^",
        ),
    )
    for name, factor, end, shares, exact, colour, marker in cases:
        share = np.linspace(1e-3, end, 200)
        axes.plot(share, factor(share, 1.0), color=colour, lw=WIDTH, label=name)
        axes.plot(shares, exact, marker, ms=5, color=colour)
    axes.set(xlabel="radius over the distance of the wall", ylabel="drag over 6πη r v", ylim=(0.9, 4), xlim=(0, 0.75))
    axes.set_title("A wall near by leaves the fluid less room")
    axes.legend(loc="upper left")


FIGURES = {
    (26, "where-stokes-ends"): where_stokes_ends,
    (26, "walls"): walls,
}
