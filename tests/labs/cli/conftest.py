"""What tests of the commands hand in: engines that fail in some way, and homework that is wrong or unfinished."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from odd_engine import write_engine


@pytest.fixture
def odd(tmp_path) -> Callable[..., str]:
    """Write an engine to a file, as `write_engine` does."""
    return lambda *body, **package: write_engine(tmp_path / "odd.py", *body, **package)


@pytest.fixture
def homework(tmp_path) -> Callable[[str], str]:
    """Write hand-written code to a file, as a student hands it in."""

    def write(text: str) -> str:
        path = tmp_path / "homework.py"
        path.write_text(text, encoding="utf-8")
        return str(path)

    return write
