"""Writes docs/symbols.md: the slides' symbols, their names in code and their units, from `reference.lecture.symbols`.

`make docs` runs it.
"""

from __future__ import annotations

from pathlib import Path

from reference.lecture.symbols import SYMBOLS

PAGE = Path(__file__).with_name("symbols.md")
HEAD = """# Symbols

What the slides write, what it is called in code, and its unit. One thing has one name, in functions, tables and axes.
Vectors have three components along the last axis, all other axes count contacts; quaternions are w, x, y, z; z points
up. Written by `python docs/symbol_table.py` from `reference/lecture/symbols.py`.

| slide | here | in code | unit | what it is | statements |
|---|---|---|---|---|---|
"""


def page() -> str:
    """The page's text."""
    rows = (
        f"| {each.slide} | {each.here} | `{each.name}` | {each.unit} | {each.meaning} |"
        f" {', '.join(map(str, each.statements))} |\n"
        for each in SYMBOLS
    )
    return HEAD + "".join(rows)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8", newline="\n")
