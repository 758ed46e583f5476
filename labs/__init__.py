"""What a student opens, and what checks their work."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from labs.notebook import lab

__all__ = ["lab"]


def __getattr__(name: str) -> Any:
    """`from labs import lab` loads the desk; an import of another part of the package does not."""
    if name == "lab":
        from labs.notebook import lab  # noqa: PLC0415

        return lab
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
