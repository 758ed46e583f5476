"""The program `collisions`, and its commands."""

from __future__ import annotations

import importlib
import importlib.util
import logging
from typing import Annotated, Any

import typer
from rich.logging import RichHandler
from typer.core import TyperGroup

from labs.cli.console import errors, own_streams
from labs.cli.ending import let_signals_interrupt, told, told_whatever_happens
from reference.engines.distributions import lab_version

COMMANDS = ("check", "grade", "export", "compare", "report", "engines", "show", "record", "bench")
"""Each is a function of the same name in a module of the same name."""
GROUPS = ("lab",)
"""Modules with several commands in their `app`."""
FOR_INSTRUCTORS = ("grade", "export", "lab")
"""What a student's tree lacks: there is nothing to build from, and no hidden test."""


class _Commands(TyperGroup):
    """Loads only the command that is run, and says how it ended if not well."""

    def list_commands(self, _: Any) -> list[str]:
        missing = [name for name in FOR_INSTRUCTORS if not importlib.util.find_spec(f"labs.cli.{name}")]
        return [name for name in (*COMMANDS, *GROUPS) if name not in missing]

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        if cmd_name not in self.list_commands(ctx):
            return None
        module = importlib.import_module(f"labs.cli.{cmd_name}")
        alone = module.app if cmd_name in GROUPS else typer.Typer(add_completion=False)
        if cmd_name in COMMANDS:
            alone.command(cmd_name)(getattr(module, cmd_name))
        command = typer.main.get_command(alone)
        command.name = cmd_name
        return command

    def invoke(self, ctx: Any) -> Any:
        with told():  # here, because the group itself takes an interrupt for its own
            return super().invoke(ctx)


app = typer.Typer(
    cls=_Commands,
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    help="Collisions Lab: hand-written physics, PyBullet, MuJoCo and DART, compared with theory and with each other.",
)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"collisions-lab {lab_version()}")
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
    own_streams()
    let_signals_interrupt()
    with told_whatever_happens():
        app()
