"""Refuses a wheel or an sdist that would lack what `make docs` writes; hatchling runs it before it packs either."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class BuiltFiles(BuildHookInterface[Any]):
    """An editable install uses the folder itself, and there the files may be written later."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Look for a file of each of the target's `artifacts`, and for all that the lessons name or are made into."""
        if version == "editable":
            return
        root, patterns = Path(self.root), self.build_config.target_config["artifacts"]
        missing = [pattern for pattern in patterns if not any(root.glob(pattern.removeprefix("/")))]
        made = ["solutions/notebooks/{}.ipynb"] + ["docs/instructors/{}.md"] * ("/docs/instructors/*.md" in patterns)
        for lesson in sorted((root / "labs" / "lessons").glob("*.md")):
            drawn = re.findall(r"lab\.figure\(\s*[\"'](\w[\w-]*)", lesson.read_text(encoding="utf-8"))
            named = [each.format(lesson.stem) for each in made] + [f"labs/figures/{name}.svg" for name in drawn]
            missing += [name for name in named if not (root / name).is_file()]
        if missing:
            raise SystemExit(f"{', '.join(missing)}: not there to be packed; `make docs` writes these files")
