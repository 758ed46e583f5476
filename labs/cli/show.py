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

from labs.cli import jobs
from labs.cli.console import output
from labs.cli.file_options import PAGE, PLOT
from labs.demonstrations.catalogue import DEMONSTRATIONS, find
from labs.demonstrations.demonstration import Demonstration
from labs.demonstrations.outcomes import Outcome
from labs.demonstrations.replay import page_of
from reference.catalogue.scenarios import catalogue
from reference.comparison.results import Job
from reference.report import figures, terminal, terminal_plot
from reference.report.marks import MARKS
from reference.report.row_text import error_of
from reference.report.sections import Line, recordings
from reference.running.cache import Cache
from reference.running.study import plan

LEAST_HEIGHT, MOST_WIDTH = 11, 140
"""Lines of the lowest plot that can be read, and columns of the widest."""
CLOSE = 5
"""From so many implementations on, the table's columns move closer together, so that all fit into 80 columns."""
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
    for file, option in ((plot, PLOT), (html, PAGE)):
        if file is not None:
            option.check(file)
    planned = [replace(job, with_poses=html is not None) for job in _planned(demonstration, engine, implementation)]
    output.print(Text(demonstration.title, style="bold"))
    output.print(Text(demonstration.question), Text(demonstration.look, style="italic"), "", sep="\n")
    results = jobs.run(planned, workers, Cache(fresh=fresh))
    outcome = Outcome(demonstration, tuple(results))
    table = _across(outcome) if demonstration.labels else _down(outcome)
    below = Group(
        *_notes(outcome), *(Text.assemble(("→ ", "bold"), line) for line in outcome.lesson()), *_recorded(outcome)
    )
    if not no_plot:
        _plot(outcome, len(output.render_lines(Group(table, below))))
    output.print(table, below)
    if plot is not None:
        PLOT.write(plot, _figure(outcome, plot.suffix.lower().lstrip(".")))
        output.print(f"The plot is in {plot}.", soft_wrap=True, markup=False)
    if html is not None:
        content = page_of(outcome)
        if content:
            PAGE.write(html, content.encode())
        said = f"The replay is in {html}." if content else f"Nobody gave poses: there is no replay, and no {html}."
        output.print(said, soft_wrap=True, markup=False)
    raise typer.Exit(0 if any(row.measured is not None for row in outcome.rows) else jobs.COULD_NOT_COMPARE)


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
        profiles = tuple(demonstration.profiles.get(engine, ()))
        for change in changes:
            found += plan([catalogue()[demonstration.family]], [engine], profiles, cases, implementation, change)
    return found


def _plot(outcome: Outcome, beside: int) -> None:
    """Draw the curves in the terminal, and leave room for so many other lines and one for the prompt."""
    if not outcome.curves:
        return
    width = min(output.width, MOST_WIDTH)
    height = max(LEAST_HEIGHT, min(output.height - beside - 1, width // 3))
    try:
        drawn = terminal_plot.plot(outcome.curves, *outcome.axes, width, height)
    except ImportError:
        output.print(f"Plots in the terminal need plotext; to get it: {PLOTEXT}", soft_wrap=True, markup=False)
    else:
        output.print(drawn)


def _recorded(outcome: Outcome) -> list[Text]:
    return [Text(line, style="dim") for line in recordings(line.result for line in outcome.section.lines)]


def _notes(outcome: Outcome) -> list[Text]:
    """Why numbers are missing, each reason once."""
    found: dict[str, dict[str, None]] = {}
    for line in outcome.section.lines:
        for row in line.result.rows:
            if row.measured is None and row.note:
                found.setdefault(row.why, {})[line.title] = None
    return [Text(f"{'; '.join(titles)}: {note}", style="dim") for note, titles in found.items()]


def _down(outcome: Outcome) -> Table:
    asked = outcome.demonstration
    judged = ("expected", "difference") if outcome.theory(asked.quantity) is not None else ()
    table = _table("", "implementation", "profile", asked.heading, *judged, *asked.beside.values())
    for (engine, profile), line in outcome.implementations.items():
        row = outcome.row(engine, profile, asked.quantity)
        beside = [_cell(outcome, engine, profile, quantity) for quantity in asked.beside if row and row.quantity]
        error = Text(error_of(row), style=terminal.style_of(row.verdict)) if row else Text()
        expected = Text(outcome.formatted(row.expected, asked.quantity) if row else "")
        name = Text(line.result.title), Text(asked.profiles.get(engine, {}).get(profile) or profile)
        cell = _cell(outcome, engine, profile, asked.quantity)
        table.add_row(_mark(outcome, line), *name, cell, *((expected, error) if judged else ()), *beside)
    return table


def _across(outcome: Outcome) -> Table:
    asked = outcome.demonstration
    heads = [
        Text.assemble(_mark(outcome, line), " ", line.result.title, "\n  ", line.result.job.profile)
        for line in outcome.implementations.values()
    ]
    first = "timestep" if asked.timesteps else asked.heading
    theory = "theory" if asked.predicted is None else Text.assemble(terminal_plot.marked(None), " predicted")
    table = _table(f"\n{first}", Text.assemble("\n", theory), *heads)
    table.padding = table.padding if len(heads) < CLOSE else (0, 1, 0, 0)
    for label in asked.labels:
        value = asked.predicted(asked.timesteps[label]) if asked.predicted else outcome.theory(asked.quantity, label)
        cells = [_cell(outcome, engine, profile, asked.quantity, label) for engine, profile in outcome.implementations]
        table.add_row(label, outcome.formatted(value, asked.quantity), *cells)
    return table


def _table(*headings: str | Text) -> Table:
    table = Table(box=None, header_style="bold", padding=(0, 1), pad_edge=False)
    for heading in headings:
        table.add_column(heading, no_wrap=True)
    return table


def _mark(outcome: Outcome, line: Line) -> Text:
    drawn = {curve.line.title for curve in outcome.curves if curve.line is not None}
    return terminal_plot.marked(line) if line.title in drawn else Text(" ")


def _cell(outcome: Outcome, engine: str, profile: str, quantity: str, label: str = "") -> Text:
    """What was measured, or why there is no number: one word, or its mark if columns are narrow."""
    row = outcome.row(engine, profile, quantity, label)
    if row is None:
        return Text()
    if row.measured is None:
        narrow = bool(label) and " " in row.verdict
        return Text(MARKS[row.verdict] if narrow else str(row.verdict), style=terminal.style_of(row.verdict))
    wrong = bool(outcome.demonstration.labels) and row.error and not outcome.demonstration.predicted
    return Text(outcome.formatted(row.measured, quantity), style=terminal.style_of(row.verdict) if wrong else "")


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
