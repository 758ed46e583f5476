"""How the texts of a lab break where a notebook is narrower than they are: on a telephone, and on paper."""

from __future__ import annotations

_STYLE = (
    "<style>"
    ".jp-OutputArea-output pre{word-break:normal;overflow-wrap:anywhere}"
    "@media print{.jp-InputArea-editor pre{white-space:pre-wrap;overflow-wrap:anywhere}}"
    "</style>"
)
"""Jupyter breaks printed lines within words, and cuts long lines of code off on paper."""


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
