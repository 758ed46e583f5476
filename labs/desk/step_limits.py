"""Draws how long a step may be for one spring with its critical damper: yours, and what was measured in the engines."""

from __future__ import annotations

import io
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from labs.desk.display import DPI, Picture
from reference.errors import InvalidInput
from reference.report import figures


@dataclass(frozen=True)
class Measured:
    """A limit in an engine.

    engine: its name. title: how it was told of the spring. limit: the longest step ω Δt at which the swing dies, within
    half a thousandth; infinity if none was found up to 60.
    """

    engine: str
    title: str
    limit: float


ENGINES = (
    Measured("pybullet", "PyBullet, the force told in every step", 0.8285),
    Measured("mujoco", "MuJoCo, a tendon, integrator Euler", 0.8285),
    Measured("mujoco", "MuJoCo, a tendon, implicitfast", 4.8288),
    Measured("mujoco", "MuJoCo, a sliding joint, Euler", 4.8288),
    Measured("dart", "DART, a sliding joint", np.inf),
)
"""One kilogram on a spring with ζ = 1, steps of 1 ms, 6000 of them, the stiffness found by halving.

PyBullet 3.2.7, MuJoCo 4.0.0 and DART 6.20.0. `tests/labs/desk/test_step_limits.py` tries both sides of each limit.
"""
LARGEST = 60.0
"""No limit was looked for beyond this ω Δt."""


def step_limits(yours: Mapping[str, float]) -> Picture:
    """Draw limits ω Δt of your own, by name, above those of the engines.

    Raises
    ------
    InvalidInput
        If no limit is given, or one is not a positive number.
    """
    own = {name: float(value) for name, value in yours.items()}
    wrong = {name: value for name, value in own.items() if not value > 0}
    if wrong or not own:
        raise InvalidInput(f"give limits above zero by name, not {wrong or 'nothing'}")
    rows = [(f"yours, {name}", value, "handwritten") for name, value in own.items()]
    rows += [(each.title, each.limit, each.engine) for each in ENGINES]
    import matplotlib
    from matplotlib.figure import Figure

    with matplotlib.rc_context(figures.STYLE):
        figure = Figure(figsize=(figures.WIDTH, 0.34 * len(rows) + 0.7), layout="constrained", dpi=DPI)
        axes = figure.subplots()
        for place, (_, limit, engine) in enumerate(rows):
            end, colour = min(limit, LARGEST), figures.COLOURS[engine]
            axes.plot([0.3, end], [place, place], color=colour, lw=3)
            axes.plot(end, place, "o" if np.isfinite(limit) else ">", color=colour)
            axes.annotate(_said(limit), (end, place), (7, 0), textcoords="offset points", va="center")
        axes.set(xscale="log", xlim=(0.3, 1500), ylim=(len(rows) - 0.5, -0.5), xlabel="longest step, ω Δt")
        axes.set_yticks(range(len(rows)), [title for title, *_ in rows])
        axes.set_xticks([0.5, 1, 2, 5, 10, 20, 50], ["0.5", "1", "2", "5", "10", "20", "50"])
        axes.minorticks_off()
        content = io.BytesIO()
        figure.savefig(content, format="png")
    said = "; ".join(f"{title}: {_said(limit)}" for title, limit, _ in rows)
    return Picture(content.getvalue(), f"[longest steps ω Δt at ζ = 1: {said}]")


def _said(limit: float) -> str:
    return f"{limit:.2f}" if np.isfinite(limit) else f"none up to {LARGEST:g}"
