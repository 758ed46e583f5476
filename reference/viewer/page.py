"""Replays in pages: a page that needs nothing beside it, a piece of the report, and a frame for a notebook."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from html import escape
from importlib import resources

from reference.viewer.clip import Clip
from reference.viewer.still import still

FRAME_HEIGHT, FRAME_WIDTH = 430, 640
"""Least height and greatest width of the frame in a notebook, px."""
POLICY = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:"
"""What a page of ours may do: it loads nothing from elsewhere."""
_ABOUT = (
    "<style>:is([data-jp-theme-light=true],.vscode-light) .replay-frame{color-scheme:light}"
    ":is([data-jp-theme-light=false],.vscode-dark,[theme=dark]) .replay-frame{color-scheme:dark}"
    "@media print{.replay-frame{display:none}:has(>.replay-frame){min-height:0!important}}</style>"
)
"""A frame is light or dark as the notebook about it (Jupyter, VS Code, Colab), not as the desktop.

Paper has none, and no room for it.
"""
_PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>
{style}</style>
</head>
<body class="{kind}">
{body}
<script>
{script}</script>
</body>
</html>
"""


def script() -> str:
    """The script, once for all replays of a page, below them; without the indents and comments of its source."""
    lines = (f" {line}".partition(" // ")[0].strip() for line in _own("replay.js").splitlines())
    return "\n".join(line for line in lines if line) + "\n"


def style() -> str:
    """The styles, once for all replays of a page."""
    return _own("replay.css")


def _own(name: str) -> str:
    return resources.files("reference.viewer").joinpath(name).read_text(encoding="utf-8")


def fragment(clip: Clip, autoplay: bool = False) -> str:
    """A replay as a piece of a page that has `style()` and, at its end, `script()`; without it the still is shown."""
    start = " data-autoplay" if autoplay else ""
    return (
        f'<div class="replay" role="group" aria-label="{escape(f"Replay: {clip.title}{clip.words()}")}"{start}>'
        f'<div class="replay-still">{still(clip, alone=False)}</div>'
        f'<script type="application/json">{clip.json()}</script></div>'
    )


def html(clips: Sequence[Clip], title: str = "", above: Sequence[str] = (), below: Sequence[str] = ()) -> str:
    """A whole page with one replay or several, which needs nothing beside it.

    title: its heading, the first clip's where it is empty. above, below: paragraphs about the replays.
    """
    heading = title or (clips[0].title if clips else "")
    lines = [f"<h1>{escape(heading)}</h1>", *(f"<p>{escape(paragraph)}</p>" for paragraph in above)]
    for clip in clips:
        lines += [f"<h2>{escape(clip.title)}</h2>"] if clip.title != heading else []
        lines.append(fragment(clip, autoplay=len(clips) == 1))
    lines += [f"<p>{escape(paragraph)}</p>" for paragraph in below]
    return _page(heading, "replay-page", "\n".join(lines))


def _page(title: str, kind: str, body: str) -> str:
    parts = {"policy": escape(POLICY), "title": escape(title), "kind": kind, "body": body}
    return _PAGE.format(**parts, style=style(), script=script())


def frame(clip: Clip) -> str:
    """A replay for a notebook: a shut-in frame over a still picture, which is left where scripts are not trusted."""
    picture = base64.b64encode(still(clip).encode()).decode("ascii")
    page = escape(_page(clip.title, "replay-fill", fragment(clip)))
    label = escape(clip.title)
    shown = f"{label}, the last frame{clip.words()}"
    return (
        f'<div style="position:relative;max-width:{FRAME_WIDTH}px;min-height:{FRAME_HEIGHT}px">'
        f'<img alt="{shown}" style="width:100%" src="data:image/svg+xml;base64,{picture}">'
        f'{_ABOUT}<iframe class="replay-frame" title="{escape("Replay: " + clip.title)}"'
        f' sandbox="allow-scripts" srcdoc="{page}"'
        ' style="position:absolute;top:0;left:0;width:100%;height:100%;border:0"></iframe></div>'
    )
