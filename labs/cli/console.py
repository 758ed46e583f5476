"""Where the commands write: tables to the standard output, progress and errors to the standard error."""

from __future__ import annotations

import sys

from rich.console import Console

output = Console(highlight=False)
errors = Console(stderr=True, highlight=False)


def speak_unicode() -> None:
    """Let both streams carry μ and θ even if the system's own encoding cannot, as on some Windows consoles."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(encoding="utf-8", errors="replace")
