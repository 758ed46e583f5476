"""Figures that are drawn for the labs: vector files in `labs/figures`, each with a title and a description in words.

`make docs` draws them. They are not in git, and a wheel and a student's release have them.
"""

from __future__ import annotations

import base64
import re
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from html import escape
from typing import Any

from labs.project_folders import DRAWING, FIGURES
from reference.errors import InvalidInput, UnknownName

IN_TEXT = re.compile(r"!\[([^\]]*)\]\(figure:([\w-]+)\)")
"""A figure in a text in Markdown: its alternative text and its name."""
_SVG = "{http://www.w3.org/2000/svg}"
CARD = (
    "display:block;box-sizing:border-box;max-width:100%;height:auto;margin:4px 0;padding:8px;"
    "background-color:#ffffff;border-radius:6px"
)
"""A light card, so that dark strokes can be read where the notebook is dark."""


@dataclass(frozen=True)
class Drawing:
    """A figure. alternative: what it shows, for readers who cannot see it."""

    svg: str
    alternative: str

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        source = base64.b64encode(self.svg.encode()).decode("ascii")
        markup = f'<img alt="{escape(self.alternative)}" style="{CARD}" src="data:image/svg+xml;base64,{source}">'
        return {"text/plain": f"[Figure: {self.alternative}]", "text/html": markup, "image/svg+xml": self.svg}


def names() -> list[str]:
    """The figures that there are."""
    return sorted(path.stem for path in FIGURES.glob("*.svg"))


def named_in(text: str) -> list[str]:
    """The figures that a text in Markdown shows."""
    return [found[2] for found in IN_TEXT.finditer(text)]


def drawing(name: str, alternative: str = "") -> Drawing:
    """A figure by its name. alternative: instead of the description that the file has.

    Raises
    ------
    UnknownName, InvalidInput
        If there is no such figure, if none is drawn yet, or if it is no SVG with a title and a description.
    """
    if not names() and DRAWING.is_dir():
        raise InvalidInput("labs/figures has no figure yet: `make docs` draws them")
    if name not in names():
        unknown = UnknownName("figure", name, names())
        raise InvalidInput(f"{unknown} `make docs` draws those that are missing.") if DRAWING.is_dir() else unknown
    svg = (FIGURES / f"{name}.svg").read_text(encoding="utf-8")
    try:
        root = ElementTree.fromstring(svg)
    except ElementTree.ParseError as error:
        raise InvalidInput(f"figures/{name}.svg cannot be read: {error}") from None
    texts = [(root.findtext(f"{_SVG}{tag}") or "").strip() for tag in ("title", "desc")]
    if not all(texts):
        raise InvalidInput(f"figures/{name}.svg needs a <title> and a <desc> that say what it shows")
    return Drawing(svg, alternative or ". ".join(text.rstrip(".") for text in texts) + ".")
