"""How a lab's texts break where a notebook is narrower than they are, on a telephone and on paper, and its pages."""

from __future__ import annotations

_STYLE = (
    "<style>"
    ".jp-OutputArea-output pre{word-break:normal;overflow-wrap:anywhere}"
    ".jp-MarkdownOutput pre{margin-bottom:1em}"
    "@media print{.jp-InputArea-editor pre{white-space:pre-wrap;overflow-wrap:anywhere}"
    "body{--jp-code-font-size:11px}"
    ".jp-MarkdownOutput :is(h1,h2,h3){break-after:avoid}"
    ".jp-OutputArea-child{break-inside:auto}.jp-OutputArea-output :is(img,table){break-inside:avoid}}"
    "</style>"
)
"""Jupyter breaks printed lines within words, and puts a text close below its code.

On paper it cuts off long code, and leaves a page half empty before an output that is long; eighty characters fit there
if they are a little smaller.
"""


class PageStyle:
    """Breaks printed lines between words, and long lines of code on paper, for as long as the output is on the page."""

    def __repr__(self) -> str:
        return ""

    def _repr_html_(self) -> str:
        return _STYLE


def shown() -> None:
    """Put the style on the page of a notebook; a terminal has none."""
    from IPython.core.getipython import get_ipython  # noqa: PLC0415 - the program has no notebook
    from IPython.display import display  # noqa: PLC0415

    if get_ipython() is not None:
        display(PageStyle())  # type: ignore[no-untyped-call]
