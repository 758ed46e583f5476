"""The program `collisions`: its commands, how it reports errors, and its exit codes.

Exit codes: 0 fine; 1 a tuned verdict failed; 2 usage; 3 could not compare; 130 interrupted.
"""

from __future__ import annotations

import contextlib
import importlib
import importlib.metadata
import logging
from typing import Annotated, Any

import typer
from rich.logging import RichHandler
from rich.markup import escape
from typer.core import TyperGroup

from labs.cli import bench, check, compare, engines, record, report, show
from labs.cli.console import errors, speak_unicode
from reference.errors import CollisionsError

INTERRUPTED = 130


class _Commands(TyperGroup):
    """Turns errors of the lab into a message and an exit code."""

    def invoke(self, ctx: Any) -> Any:
        try:
            return super().invoke(ctx)
        except CollisionsError as error:
            errors.print(f"[bold red]Error:[/] {escape(str(error))}", highlight=False, soft_wrap=True)
            raise typer.Exit(error.exit_code) from None
        except KeyboardInterrupt:
            errors.print("[bold]Interrupted.[/]")
            raise typer.Exit(INTERRUPTED) from None


app = typer.Typer(
    cls=_Commands,
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    help="Collisions Lab: hand-written physics, PyBullet, MuJoCo and DART, compared with theory and with each other.",
)
app.command("check")(check.check)
app.command("compare")(compare.compare)
app.command("report")(report.report)
app.command("engines")(engines.engines)
app.command("show")(show.show)
app.command("record")(record.record)
app.command("bench")(bench.bench)
with contextlib.suppress(ModuleNotFoundError):  # a student's tree has nothing to build from
    app.add_typer(importlib.import_module("labs.cli.lab").app, name="lab")


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"collisions-lab {importlib.metadata.version('collisions-lab')}")
        raise typer.Exit


@app.callback()
def options(
    verbose: Annotated[bool, typer.Option("--verbose", "-v", help="Log what is run.")] = False,
    version: Annotated[bool, typer.Option("--version", callback=_version, is_eager=True, help="Print it.")] = False,
) -> None:
    """Options that every command has."""
    level = logging.INFO if verbose else logging.WARNING
    handler = RichHandler(console=errors, show_path=False)
    logging.basicConfig(level=level, format="%(message)s", handlers=[handler], force=True)


def main() -> None:
    """Run the program."""
    speak_unicode()
    app()
