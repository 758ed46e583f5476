"""The command line `collisions`, one file a command."""

from labs.cli.app import app, main

__all__ = ["app", "main"]
