"""Draws the figures of the statements: `python docs/figures/draw.py [FOLDER]`, by default into docs/images/statements.

Each topic has one or more files `figures_….py` beside this one, each with a table `FIGURES`: (statement, name) → a
function that draws on a matplotlib `Figure`. Its docstring is the caption.
"""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.figure import Figure

from reference.report import figures as figures_of_the_report

HERE = Path(__file__).resolve().parent
IMAGES = HERE.parent / "images" / "statements"
Draw = Callable[[Figure], None]
STYLE: dict[Any, Any] = figures_of_the_report.STYLE | {
    "axes.prop_cycle": matplotlib.cycler(color=["#1b1b1b", "#0072b2", "#d55e00", "#009e73", "#cc79a7"])
}


def figures() -> dict[tuple[int, str], Draw]:
    """All figures by statement and name, in the order of the statements."""
    found: dict[tuple[int, str], Draw] = {}
    for path in sorted(HERE.glob("figures_*.py")):
        spec = importlib.util.spec_from_file_location(path.stem, path)
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        found |= module.FIGURES
    return dict(sorted(found.items()))


def file_name(statement: int, name: str) -> str:
    """Of a figure: 07-the-guard.svg."""
    return f"{statement:02d}-{name}.svg"


def draw_all(folder: Path) -> None:
    """Write every figure as SVG, without dates or random names, so that the same numbers give the same bytes."""
    folder.mkdir(parents=True, exist_ok=True)
    for (statement, name), draw in figures().items():
        with matplotlib.rc_context(STYLE | {"svg.hashsalt": name}):
            figure = Figure(figsize=(5.8, 3.6), layout="constrained")
            draw(figure)
            metadata = dict.fromkeys(("Date", "Creator", "Format", "Type"))
            figure.savefig(folder / file_name(statement, name), format="svg", metadata=metadata)


if __name__ == "__main__":
    draw_all(Path(sys.argv[1]) if len(sys.argv) > 1 else IMAGES)
