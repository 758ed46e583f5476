"""`collisions engines`: what is installed here, in which version, and how to get the rest."""

from __future__ import annotations

from rich.table import Table

from labs.cli.console import output
from reference.engines import engine_names, load_engine, tried_versions
from reference.errors import EngineBroken, EngineNotInstalled, RunFailed, RunLost
from reference.running.availability import PROBE_LIMIT
from reference.running.isolate import run_isolated


def engines() -> None:
    """List the engines: installed or not, versions, and how to get the rest."""
    table = Table(box=None, header_style="bold", padding=(0, 1), pad_edge=False)
    for heading in ("engine", "name", "version", "here"):
        table.add_column(heading)
    missing = []
    for name in engine_names():
        try:
            (distribution, version), here = run_isolated(_found, PROBE_LIMIT, name), "[green]✓ ready[/]"
            missing.append(tried_versions.warning(load_engine(name), version, distribution))
            if distribution and distribution != load_engine(name).package:
                version = f"{version} ({distribution})"
        except EngineBroken as error:
            version, here = "", "[red]! broken[/]"
            missing.append(str(error))
        except EngineNotInstalled as error:
            version, here = "", "[yellow]– not installed[/]"
            missing.append(str(error))
        except RunLost as error:
            version, here = "", "[yellow]? unknown[/]"
            missing.append(f"{load_engine(name).title}: {error}")
        except RunFailed as error:
            version, here = "", "[red]! broken[/]"
            missing.append(f"{load_engine(name).title} is installed but cannot be imported: {error}")
        table.add_row(load_engine(name).title, name, version, here)
    output.print(table)
    for message in filter(None, missing):
        output.print(message, soft_wrap=True, markup=False)


def _found(name: str) -> tuple[str, str]:
    """Import an engine's package; say its distribution and version. In a worker: it may print or crash as it likes."""
    engine = load_engine(name)
    engine.module()
    found = engine.distribution() if engine.package else None
    return found.name if found else "", engine.version()
