"""`collisions show`: a question for the class, half a minute of runs, a plot, a table, and what the runs teach."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Group
from rich.table import Table
from rich.text import Text

from labs.cli import ending, jobs
from labs.cli.console import output
from labs.cli.file_options import PAGE, PLOT
from labs.demonstrations.catalogue import DEMONSTRATIONS, find
from labs.demonstrations.demonstration import Demonstration
from labs.demonstrations.outcomes import Outcome
from labs.demonstrations.replay import page_of
from labs.demonstrations.tables import table_of
from reference.catalogue.scenarios import catalogue
from reference.comparison.results import Job
from reference.errors import listed
from reference.report import figures, terminal_plot
from reference.running.cache import Cache
from reference.running.jobs import TIME_LIMIT
from reference.running.study import plan

LEAST_HEIGHT, MOST_WIDTH = 8, 140
"""Lines of the lowest plot that can be read, and columns of the widest."""
ROWS = 24
"""Rows of the smallest usual terminal, for which a text is made that goes elsewhere."""
RUNS_AND_PROMPT = 2
"""Lines that stand on the screen as well: how many runs there are, and the prompt."""
SIZE, DPI = (9.0, 5.0), 160
"""Size of a plot in a file, in inches, and its dots per inch."""
LARGEST_MARKER, SMALLEST_MARKER, SMALLER = 14, 5, 4
"""Points: markers of separate points shrink by so much from one implementation to the next, so that all show."""
PLOTEXT = 'pip install -e ".[show]"'


def show(
    name: Annotated[
        str | None, typer.Argument(metavar="NAME", help="A demonstration; without one they are listed.")
    ] = None,
    engine: jobs.Engines = None,
    implementation: jobs.Implementations = jobs.CORRECT,
    plot: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Write the plot to a file too: .svg, .png or .pdf.")
    ] = None,
    html: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Write a replay to a page that a browser opens: .html.")
    ] = None,
    no_plot: Annotated[bool, typer.Option("--no-plot", help="No plot in the terminal.")] = False,
    workers: jobs.Workers = None,
    seconds: jobs.Seconds = TIME_LIMIT,
    fresh: jobs.Fresh = False,
) -> None:
    """Show a demonstration to a class: the question, the plot, the numbers and the lesson.

    For example:  collisions show bounce
    """
    if name is None:
        _list()
        return
    demonstration = find(name)
    for file, option in ((plot, PLOT), (html, PAGE)):
        if file is not None:
            option.check(file)
    planned = [replace(job, with_poses=html is not None) for job in _planned(demonstration, engine, implementation)]
    title, look = (f"{demonstration.title}. ", "bold"), (f" {demonstration.look}", "italic")
    asked = Text.assemble(title, demonstration.question, look)
    output.print(asked)
    cache = Cache(fresh=fresh)
    with jobs.continuing(cache):
        results = jobs.run(planned, workers, cache, seconds=seconds)
    outcome = Outcome(demonstration, tuple(results))
    lesson = (Text.assemble(("→ ", "bold"), line) for line in outcome.lesson())
    below = Group(table_of(outcome), *_notes(outcome), *lesson, *_recorded(outcome))
    if not no_plot:
        _plot(outcome, len(output.render_lines(Group(asked, below))) + RUNS_AND_PROMPT)
    output.print(below)
    if plot is not None:
        PLOT.write(plot, _figure(outcome, plot.suffix.lower().lstrip(".")))
        output.print(f"The plot is in {plot}.", soft_wrap=True, markup=False)
    if html is not None:
        content = page_of(outcome)
        if content:
            PAGE.write(html, content.encode())
        said = f"The replay is in {html}." if content else f"No run gave poses, so there is no replay and no {html}."
        output.print(said, soft_wrap=True, markup=False)
    raise typer.Exit(ending.code_of(False, unanswered=all(row.measured is None for row in outcome.rows)))


def _list() -> None:
    table = Table(box=None, header_style="bold", padding=(0, 1), pad_edge=False)
    table.add_column("demonstration", no_wrap=True)
    table.add_column("what will happen?")
    for demonstration in DEMONSTRATIONS:
        table.add_row(Text(demonstration.name, style="bold"), Text(demonstration.question))
    output.print(table)
    output.print(
        "By hand: exact, the slide's T, at the step. An engine: tuned to the question; stock, as it is installed."
    )


def _planned(demonstration: Demonstration, engines: Sequence[str] | None, implementation: str) -> list[Job]:
    """The runs of a demonstration; an engine that it does not mention runs in all its profiles."""
    cases = {demonstration.family: tuple(demonstration.cases.values())}
    changes = [{"timestep": timestep} for timestep in demonstration.timesteps.values()] or [{}]
    found: list[Job] = []
    for engine in engines or demonstration.profiles:
        profiles = demonstration.profiles.get(engine, ())
        for change in changes:
            found += plan([catalogue()[demonstration.family]], [engine], profiles, cases, implementation, change)
    return found


def _plot(outcome: Outcome, beside: int) -> None:
    """Draw the curves in the terminal, and leave room for so many other lines."""
    if not outcome.curves:
        return
    width = min(output.width, MOST_WIDTH)
    height = max(LEAST_HEIGHT, min((output.height if output.is_terminal else ROWS) - beside, width // 3))
    try:
        drawn = terminal_plot.plot(outcome.curves, *outcome.axes, width, height)
    except ImportError:
        output.print(f"Plots in the terminal need plotext; to get it: {PLOTEXT}", soft_wrap=True, markup=False)
    else:
        output.print(drawn)


def _recorded(outcome: Outcome) -> list[Text]:
    """Which engines were not run here, in one line; and what was moved to a recorded point."""
    results = [line.result for line in outcome.section.lines]
    titles = list(dict.fromkeys(result.title for result in results if result.recording))
    said = [f"{listed(titles)}: recorded elsewhere, not run here."] if titles else []
    moved = dict.fromkeys(result.job.snapped for result in results if result.job.snapped)
    return [Text(line, style="dim") for line in (*said, *moved)]


def _notes(outcome: Outcome) -> list[Text]:
    """Why numbers are missing, each reason once."""
    found: dict[str, dict[str, None]] = {}
    for line in outcome.section.lines:
        for row in line.result.rows:
            if row.measured is None and row.note and row.quantity in ("", outcome.demonstration.quantity):
                found.setdefault(row.why, {})[line.title] = None
    return [Text(f"{'; '.join(titles)}: {note}", style="dim") for note, titles in found.items()]


def _figure(outcome: Outcome, kind: str) -> bytes:
    """The plot as the report draws it, large enough for a projector."""
    import matplotlib  # late: half a second that a table need not wait for
    from matplotlib.figure import Figure

    with matplotlib.rc_context(figures.STYLE | {"svg.hashsalt": outcome.demonstration.name}):
        figure = Figure(figsize=SIZE, layout="constrained", dpi=DPI)
        axes = figure.add_subplot()
        for place, curve in enumerate(outcome.curves):
            style: dict[str, Any] = {"color": "#999999", "label": "predicted"}
            if curve.line is not None:
                style = {**figures.marker(curve.line), **figures.line_style(curve.line), "label": curve.line.title}
                nested = {"linestyle": "none", "markersize": max(SMALLEST_MARKER, LARGEST_MARKER - SMALLER * place)}
                style |= figures.staggered(place) if curve.joined else nested
                style["zorder"] = 3 if curve.line.counts else 2
            axes.plot(curve.xs, curve.ys, **style)
        x_label, y_label = outcome.axes
        axes.set(title=outcome.demonstration.title, xlabel=x_label, ylabel=y_label)
        figure.legend(loc="outside lower left", ncols=3, handlelength=3)
        content = io.BytesIO()
        figure.savefig(content, format=kind, metadata={"Date": None} if kind == "svg" else None)
    return content.getvalue()
