"""`collisions show`: a question for the class, half a minute of runs, a plot, a table and what they teach."""

from __future__ import annotations

import io
import os
import tempfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Group
from rich.table import Table
from rich.text import Text

from labs.cli import jobs
from labs.cli.console import output
from labs.demonstrations.outcomes import Seen
from labs.demonstrations.questions import DEMONSTRATIONS, Demonstration, find
from labs.demonstrations.replay import page_of
from reference.catalogue.scenarios import catalogue
from reference.comparison.results import Job
from reference.errors import InvalidInput
from reference.report import figures, terminal
from reference.report.summary import MARKS, Line, error_of, recordings
from reference.running.cache import Cache
from reference.running.study import plan

SUFFIXES, PAGES = (".svg", ".png", ".pdf"), (".html", ".htm")
LEAST_HEIGHT, MOST_WIDTH = 11, 140
"""Lines of the lowest plot that can be read, and columns of the widest."""
CLOSE = 5
"""So many implementations side by side stand closer together, so that each has its room in a terminal of 80."""
SIZE, DPI = (9.0, 5.0), 160
"""Of a plot in a file: inches, and dots an inch."""
PLOTEXT = 'pip install -e ".[show]"'


def show(
    name: Annotated[
        str | None, typer.Argument(metavar="NAME", help="A demonstration; without one they are listed.")
    ] = None,
    engine: jobs.Engines = None,
    implementation: jobs.Implementations = "solutions",
    plot: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Write the plot to a file too: .svg, .png or .pdf.")
    ] = None,
    html: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Write a replay to a page that a browser opens: .html.")
    ] = None,
    no_plot: Annotated[bool, typer.Option("--no-plot", help="No plot in the terminal.")] = False,
    workers: jobs.Workers = None,
    fresh: jobs.Fresh = False,
) -> None:
    """Show a demonstration to a class: the question, the plot, the numbers and the lesson.

    For example:  collisions show bounce
    """
    if name is None:
        _list()
        return
    demonstration = find(name)
    for file, option, suffixes in ((plot, "--plot", SUFFIXES), (html, "--html", PAGES)):
        if file is not None:
            _check(file, option, suffixes)
    planned = [replace(job, with_poses=html is not None) for job in _planned(demonstration, engine, implementation)]
    output.print(Text(demonstration.title, style="bold"))
    output.print(Text(demonstration.question), Text(demonstration.look, style="italic"), "", sep="\n")
    results = jobs.run(planned, workers, Cache(fresh=fresh))
    seen = Seen(demonstration, tuple(results))
    table = _across(seen) if demonstration.labels else _down(seen)
    below = Group(*_notes(seen), *(Text.assemble(("→ ", "bold"), line) for line in seen.lesson()), *_recorded(seen))
    if not no_plot:
        _plot(seen, len(output.render_lines(Group(table, below))))
    output.print(table, below)
    if plot is not None:
        _write(plot, "--plot", _figure(seen, plot.suffix.lower().lstrip(".")))
        output.print(f"The plot is in {plot}.", soft_wrap=True, markup=False)
    if html is not None:
        content = page_of(seen)
        _write(html, "--html", content.encode()) if content else None
        said = f"The replay is in {html}." if content else f"Nobody gave poses: there is no replay, and no {html}."
        output.print(said, soft_wrap=True, markup=False)
    raise typer.Exit(0 if any(row.measured is not None for row in seen.rows) else jobs.COULD_NOT_COMPARE)


def _list() -> None:
    table = Table(box=None, header_style="bold", padding=(0, 1), pad_edge=False)
    table.add_column("demonstration", no_wrap=True)
    table.add_column("what will happen?")
    for demonstration in DEMONSTRATIONS:
        table.add_row(Text(demonstration.name, style="bold"), Text(demonstration.question))
    output.print(table)
    output.print("Tuned: settings that say what the question means. Stock: an engine as it is installed.")


def _planned(demonstration: Demonstration, engines: Sequence[str] | None, implementation: str) -> list[Job]:
    """The runs of a demonstration; an engine that it does not know runs in all its profiles."""
    cases = {demonstration.family: tuple(demonstration.cases.values())}
    changes = [{"timestep": timestep} for timestep in demonstration.timesteps.values()] or [{}]
    found: list[Job] = []
    for engine in engines or demonstration.profiles:
        profiles = tuple(demonstration.profiles.get(engine, ()))
        for change in changes:
            found += plan([catalogue()[demonstration.family]], [engine], profiles, cases, implementation, change)
    return found


def _plot(seen: Seen, beside: int) -> None:
    """Draw the curves in the terminal, as high as leaves room for so many other lines, and one for the prompt."""
    if not seen.curves:
        return
    width = min(output.width, MOST_WIDTH)
    height = max(LEAST_HEIGHT, min(output.height - beside - 1, width // 3))
    try:
        drawn = terminal.plot(seen.curves, *seen.axes, width, height)
    except ImportError:
        output.print(f"Plots in the terminal need plotext; to get it: {PLOTEXT}", soft_wrap=True, markup=False)
    else:
        output.print(drawn)


def _recorded(seen: Seen) -> list[Text]:
    return [Text(line, style="dim") for line in recordings(line.result for line in seen.section.lines)]


def _notes(seen: Seen) -> list[Text]:
    """Why there is no number, each reason once."""
    found: dict[str, dict[str, None]] = {}
    for line in seen.section.lines:
        for row in line.result.rows:
            if row.measured is None and row.note:
                found.setdefault(row.why, {})[line.title] = None
    return [Text(f"{'; '.join(titles)}: {note}", style="dim") for note, titles in found.items()]


def _down(seen: Seen) -> Table:
    asked = seen.demonstration
    judged = ("expected", "difference") if seen.theory(asked.quantity) is not None else ()
    table = _table("", "implementation", "profile", asked.heading, *judged, *asked.beside.values())
    for (engine, profile), line in seen.implementations.items():
        row = seen.row(engine, profile, asked.quantity)
        beside = [_cell(seen, engine, profile, quantity) for quantity in asked.beside if row and row.quantity]
        error = Text(error_of(row), style=terminal.style_of(row.verdict)) if row else Text()
        expected = Text(seen.said(row.expected, asked.quantity) if row else "")
        name = Text(line.result.title), Text(asked.profiles.get(engine, {}).get(profile) or profile)
        cell = _cell(seen, engine, profile, asked.quantity)
        table.add_row(_mark(seen, line), *name, cell, *((expected, error) if judged else ()), *beside)
    return table


def _across(seen: Seen) -> Table:
    asked = seen.demonstration
    heads = [
        Text.assemble(_mark(seen, line), " ", line.result.title, "\n  ", line.result.job.profile)
        for line in seen.implementations.values()
    ]
    first = "timestep" if asked.timesteps else asked.heading
    theory = "theory" if asked.predicted is None else Text.assemble(terminal.marked(None), " predicted")
    table = _table(f"\n{first}", Text.assemble("\n", theory), *heads)
    table.padding = table.padding if len(heads) < CLOSE else (0, 1, 0, 0)
    for label in asked.labels:
        value = asked.predicted(asked.timesteps[label]) if asked.predicted else seen.theory(asked.quantity, label)
        cells = [_cell(seen, engine, profile, asked.quantity, label) for engine, profile in seen.implementations]
        table.add_row(label, seen.said(value, asked.quantity), *cells)
    return table


def _table(*headings: str | Text) -> Table:
    table = Table(box=None, header_style="bold", padding=(0, 1), pad_edge=False)
    for heading in headings:
        table.add_column(heading, no_wrap=True)
    return table


def _mark(seen: Seen, line: Line) -> Text:
    drawn = {curve.line.title for curve in seen.curves if curve.line is not None}
    return terminal.marked(line) if line.title in drawn else Text(" ")


def _cell(seen: Seen, engine: str, profile: str, quantity: str, label: str = "") -> Text:
    """What was measured, or why there is no number: one word, or its mark where columns are narrow."""
    row = seen.row(engine, profile, quantity, label)
    if row is None:
        return Text()
    if row.measured is None:
        narrow = bool(label) and " " in row.verdict
        return Text(MARKS[row.verdict] if narrow else str(row.verdict), style=terminal.style_of(row.verdict))
    wrong = bool(seen.demonstration.labels) and row.error and not seen.demonstration.predicted
    return Text(seen.said(row.measured, quantity), style=terminal.style_of(row.verdict) if wrong else "")


def _check(file: Path, option: str, suffixes: Sequence[str]) -> None:
    """Refuse, before anything runs, a file that cannot be written."""
    if file.suffix.lower() not in suffixes:
        kind = "picture that can be drawn" if option == "--plot" else "page"
        raise InvalidInput(f"{option} {str(file)!r} is no {kind}; it ends in {', '.join(suffixes)}")
    try:
        with tempfile.TemporaryFile(dir=file.parent):
            pass
        if file.is_dir():
            raise IsADirectoryError(None, "Is a directory")
    except OSError as error:
        raise _unwritable(file, option, error) from None


def _unwritable(file: Path, option: str, error: OSError) -> InvalidInput:
    what = "plot" if option == "--plot" else "replay"
    return InvalidInput(f"cannot write the {what} to {str(file)!r}: {error.strerror}; choose another {option}")


def _write(file: Path, option: str, content: bytes) -> None:
    """Write a whole file, or none."""
    unfinished = file.with_name(f".unfinished-{file.name}")
    try:
        unfinished.write_bytes(content)
        os.replace(unfinished, file)
    except OSError as error:
        unfinished.unlink(missing_ok=True)
        raise _unwritable(file, option, error) from None


def _figure(seen: Seen, kind: str) -> bytes:
    """The plot as the report draws it, large enough for a projector."""
    import matplotlib  # late: half a second that a table need not wait for
    from matplotlib.figure import Figure

    with matplotlib.rc_context(figures.STYLE | {"svg.hashsalt": seen.demonstration.name}):
        figure = Figure(figsize=SIZE, layout="constrained", dpi=DPI)
        axes = figure.add_subplot()
        for place, curve in enumerate(seen.curves):
            style: dict[str, Any] = {"color": "#999999", "label": "predicted"}
            if curve.line is not None:
                style = {**figures.marker(curve.line), **figures.line_style(curve.line), "label": curve.line.title}
                spread = {"markevery": (0.05 * place, 0.4)}
                style |= spread if curve.joined else {"linestyle": "none", "markersize": max(5, 14 - 4 * place)}
                style["zorder"] = 3 if curve.line.tuned else 2
            axes.plot(curve.xs, curve.ys, **style)
        x_label, y_label = seen.axes
        axes.set(title=seen.demonstration.title, xlabel=x_label, ylabel=y_label)
        figure.legend(loc="outside lower left", ncols=3, handlelength=3)
        content = io.BytesIO()
        figure.savefig(content, format=kind, metadata={"Date": None} if kind == "svg" else None)
    return content.getvalue()
