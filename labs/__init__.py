"""What a student opens, and what checks their work."""

from __future__ import annotations

TYPE_CHECKING = False  # that of `typing`, whose place a student's own `typing.py` may take; see `labs.__main__`
if TYPE_CHECKING:
    from typing import Any

    from labs.notebook import lab

__all__ = ["lab"]


def __getattr__(name: str) -> Any:
    """`from labs import lab` loads the desk; an import of another part of the package does not."""
    if name == "lab":
        from pathlib import Path  # noqa: PLC0415

        from labs.files_in_the_way import warning  # noqa: PLC0415

        if found := warning(Path.cwd()):
            print(found)
        from labs.notebook import lab  # noqa: PLC0415

        return lab
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
