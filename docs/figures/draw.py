"""Draws the figures of the pages: `python docs/figures/draw.py [FOLDER]`, by default into docs/images.

Each topic has one or more files `figures_….py` beside this one, each with a table `FIGURES`: (statement, name) → a
function that draws on a matplotlib `Figure`. Its docstring is the caption. They go into the folder `statements`. The
figures of the findings about the engines are in `findings.py` and go into the folder `engines`.
"""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import matplotlib
from matplotlib.figure import Figure

from reference.report import figures as figures_of_the_report

HERE = Path(__file__).resolve().parent
IMAGES = HERE.parent / "images"
Draw = Callable[[Figure], None]
STYLE: dict[Any, Any] = figures_of_the_report.STYLE | {
    "axes.prop_cycle": matplotlib.cycler(color=["#1b1b1b", "#0072b2", "#d55e00", "#009e73", "#cc79a7"])
}


def figures() -> dict[tuple[int, str], Draw]:
    """All figures of statements by statement and name, in the order of the statements."""
    found: dict[tuple[int, str], Draw] = {}
    for path in sorted(HERE.glob("figures_*.py")):
        found |= _loaded(path).FIGURES
    return dict(sorted(found.items()))


def findings() -> dict[str, Draw]:
    """The figures of the findings about the engines, by name."""
    found: dict[str, Draw] = _loaded(HERE / "findings.py").FINDINGS
    return found


def _loaded(path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def file_name(statement: int, name: str) -> str:
    """Of a figure: 07-the-guard.svg."""
    return f"{statement:02d}-{name}.svg"


def draw_all(folder: Path) -> None:
    """Write every figure as SVG, without dates or random names, so that the same numbers give the same bytes."""
    for (statement, name), draw in figures().items():
        _write(folder / "statements" / file_name(statement, name), name, draw)
    for name, draw in findings().items():
        _write(folder / "engines" / f"{name}.svg", name, draw)


def _write(path: Path, salt: str, draw: Draw) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    with matplotlib.rc_context(STYLE | {"svg.hashsalt": salt}):
        figure = Figure(figsize=(5.8, 3.6), layout="constrained")
        draw(figure)
        metadata = dict.fromkeys(("Date", "Creator", "Format", "Type"))
        figure.savefig(path, format="svg", metadata=metadata)


if __name__ == "__main__":
    draw_all(Path(sys.argv[1]) if len(sys.argv) > 1 else IMAGES)
