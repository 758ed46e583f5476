"""Shows hints on a function, one level at a time, and drawn figures, in whatever displays the notebook.

A hint is shown as Markdown with LaTeX, which JupyterLab, Notebook, VS Code and Colab all display in an output. A figure
in it is an output of its own, so that no display has to find an image by its address.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from labs.guidance import drawings
from labs.guidance.drawings import Drawing
from labs.guidance.hint_files import Guide


@dataclass(frozen=True)
class Text:
    """A text in Markdown, shown as it is written where there is no Markdown."""

    markdown: str

    def __str__(self) -> str:
        return self.markdown

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        return {"text/plain": self.markdown, "text/markdown": self.markdown}


@dataclass
class Revealed:
    """How many levels of hints a student has seen of each function, since this kernel started."""

    _counts: dict[str, int] = field(default_factory=dict)

    def next(self, guide: Guide) -> list[Text | Drawing]:
        """Show one more level of hints; nothing if all were shown."""
        count = self._counts.get(guide.function, 0)
        if count >= len(guide.levels):
            return []
        self._counts[guide.function] = count + 1
        titles = [title.lower() for title, _ in guide.titled] + ["help with your own code"]
        heading = f"**{guide.function}, hint {count + 1} of {len(guide.levels)}: {titles[count]}**"
        following = f'*The next `lab.hint("{guide.function}")` shows {titles[count + 1]}.*'
        return pieces(f"{heading}\n\n{guide.levels[count]}\n\n{following}")


def pieces(markdown: str) -> list[Text | Drawing]:
    """A text with figures as outputs in their order."""
    found: list[Text | Drawing] = []
    start = 0
    for figure in drawings.IN_TEXT.finditer(markdown):
        found += [Text(text)] if (text := markdown[start : figure.start()].strip()) else []
        found.append(drawings.drawing(figure[2], figure[1]))
        start = figure.end()
    found += [Text(text)] if (text := markdown[start:].strip()) else []
    return found
