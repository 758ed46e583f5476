"""Refuses a wheel or an sdist that would lack what `make docs` writes; hatchling runs it before it packs either."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class BuiltFiles(BuildHookInterface[Any]):
    """An editable install uses the folder itself, and there the files may be written later."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Look for each pattern of the target's `artifacts`, before anything is packed."""
        patterns = [] if version == "editable" else self.build_config.target_config["artifacts"]
        missing = [pattern for pattern in patterns if not any(Path(self.root).glob(pattern.removeprefix("/")))]
        if missing:
            raise SystemExit(f"{', '.join(missing)}: not there to be packed; `make docs` writes these files")
