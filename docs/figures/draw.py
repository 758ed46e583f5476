"""Draws the figures of the pages: `python docs/figures/draw.py [FOLDER]`, by default into docs/images.

Each topic has one or more files `figures_….py` beside this one, each with a table `FIGURES`: (statement, name) → a
function that draws on a matplotlib `Figure`. Its docstring is the caption. They go into the folder `statements`. The
figures of the findings about the engines are in `findings.py` and go into the folder `engines`. The labs' own figures
are in the files `lab_figures….py`, which share `blackboard.py`, and go into `labs/figures`, or into the folder `labs`
of another one.

A figure that is newer than everything it may be drawn from is left as it is.
"""

from __future__ import annotations

import functools
import importlib.util
import inspect
import io
import sys
from collections.abc import Callable
from html import escape
from pathlib import Path
from types import ModuleType
from typing import Any

import matplotlib
from matplotlib.figure import Figure

from reference.report import figures as figures_of_the_report
from reference.writable import write_whole

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
IMAGES = HERE.parent / "images"
LABS = ROOT / "labs" / "figures"
Draw = Callable[[Figure], None]
_SOURCES = (".py", ".json", ".npz")
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


def lab_figures() -> dict[str, Draw]:
    """The drawn figures of the labs, by name."""
    found: dict[str, Draw] = {}
    for path in sorted(HERE.glob("lab_figures*.py")):
        found |= _loaded(path).LAB_FIGURES
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


def draw_all(folder: Path, labs: Path) -> set[Path]:
    """Write every figure as SVG, without dates or random names, so that the same numbers give the same bytes.

    Returns the files of all figures.
    """
    wanted: dict[Path, Callable[[], str]] = {}
    for (statement, name), draw in figures().items():
        wanted[folder / "statements" / file_name(statement, name)] = functools.partial(_of_a_page, name, draw)
    for name, draw in findings().items():
        wanted[folder / "engines" / f"{name}.svg"] = functools.partial(_of_a_page, name, draw)
    for name, draw in lab_figures().items():
        wanted[labs / f"{name}.svg"] = functools.partial(_described, name, draw)
    changed = _last_change()
    for path, drawn in wanted.items():
        if not path.is_file() or path.stat().st_mtime <= changed:
            path.parent.mkdir(parents=True, exist_ok=True)
            write_whole(path, drawn().encode())
    return {*wanted}


def _last_change() -> float:
    """When one of the files was changed last that figures are drawn from, code or recordings."""
    folders = (HERE, ROOT / "solutions", ROOT / "reference", ROOT / "labs" / "desk")
    return max(path.stat().st_mtime for folder in folders for path in folder.rglob("*") if path.suffix in _SOURCES)


def _of_a_page(salt: str, draw: Draw) -> str:
    return _svg(salt, draw, (5.8, 3.6), STYLE)


def _described(name: str, draw: Draw) -> str:
    """A figure with its title and description inside, for readers who cannot see it.

    Its letters are drawn, because a notebook may be read on a machine without the font.
    """
    title, _, text = inspect.cleandoc(draw.__doc__ or "").partition("\n\n")
    described = f"<title>{escape(title)}</title>\n <desc>{escape(' '.join(text.split()))}</desc>"
    before, tag, after = _svg(name, draw, (5.4, 3.0), STYLE | {"svg.fonttype": "path"}).partition("<svg ")
    head, end, rest = after.partition(">")
    return f'{before}{tag}role="img" {head}{end}\n {described}{rest}'


def _svg(salt: str, draw: Draw, size: tuple[float, float], style: dict[Any, Any]) -> str:
    content = io.StringIO()
    with matplotlib.rc_context(style | {"svg.hashsalt": salt}):
        figure = Figure(figsize=size, layout="constrained")
        draw(figure)
        metadata = dict.fromkeys(("Date", "Creator", "Format", "Type"))
        figure.savefig(content, format="svg", metadata=metadata)
    return content.getvalue()


def main() -> None:
    """Draw into the folder that is named; or where the pages and the notebooks look, and remove what no figure is."""
    if len(sys.argv) > 1:
        draw_all(Path(sys.argv[1]), Path(sys.argv[1], "labs"))
    else:
        drawn = draw_all(IMAGES, LABS)
        for path in {each for folder in {file.parent for file in drawn} for each in folder.glob("*.svg")} - drawn:
            path.unlink()


if __name__ == "__main__":
    main()
