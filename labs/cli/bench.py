"""`collisions bench`: how long our own functions take, beside others."""

from __future__ import annotations

from typing import Annotated

import typer
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from labs.benching import timing
from labs.benching.programs import Environment
from labs.cli.console import errors, output
from reference.errors import CollisionsError, InvalidInput


def bench(
    name: Annotated[list[str] | None, typer.Argument(help="Which ones; all if you name none.")] = None,
    repeats: Annotated[
        int | None, typer.Option(min=1, help="Calls of each; the median is shown. By default each bench has its own.")
    ] = None,
) -> None:
    """Time hand-written functions beside other libraries on the same input, in one run.

    A bench that you name installs what it needs into an environment of its own, and says so.

    For example:  collisions bench point-plane
    """
    chosen = [timing.find(each) for each in name] if name else list(timing.benches().values())
    if not chosen:
        raise InvalidInput("there is nothing to time: the folder tests/bench of the project is missing")
    for environment in [environment for each in chosen if name for environment in each.environments]:
        _install(environment)
    for each in chosen:
        with errors.status(each.name):
            timings = timing.measure(each, repeats)
        _print(each, timings)


def _install(environment: Environment) -> None:
    if environment.ready:
        return
    packages = ", ".join(environment.packages)
    errors.print(f"Installing {packages} into {environment.folder}, for this bench alone …", soft_wrap=True)
    try:
        environment.install()
    except CollisionsError as error:  # the table says who is missing
        errors.print(escape(str(error)), soft_wrap=True)


def _print(timed: timing.Bench, timings: list[timing.Timing]) -> None:
    beyond = f" beyond “{timed.beyond}”" if timed.beyond else ""
    goal = f" Goal: {timed.goal:g} s{beyond}." if timed.goal else ""
    output.print(Text.assemble((timed.name, "bold"), f": {timed.what}.{goal}"))
    table = Table(box=None, header_style="bold", padding=(0, 1), pad_edge=False)
    table.add_column("")
    counted = any(each.memory for each in timings)
    seen = [timed.watched.heading] if timed.watched else []
    for heading in ("median, s", "fastest, s", "÷ ours", *(["MB"] if counted else []), *seen):
        table.add_column(heading, justify="right")
    own = next(each.median for each in timings if each.median is not None)
    for each in timings:
        if each.median is None or each.fastest is None:
            table.add_row(each.who, each.note, "", "")
        else:
            memory = f"{each.memory / 1e6:.0f}" if each.memory else ""
            ratio = f"{each.median / own:.2f}"
            number = f"{each.watched:.3g}" if each.watched is not None else ""
            columns = [*[memory] * counted, *[number] * len(seen)]
            table.add_row(each.who, f"{each.median:.3g}", f"{each.fastest:.3g}", ratio, *columns)
    output.print(table)
    less = next((each.median for each in timings if each.who == timed.beyond), None)
    if less is not None:
        output.print(f"Beyond “{timed.beyond}”: {own - less:.3g} s.")
    output.print()
