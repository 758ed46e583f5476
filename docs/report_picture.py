"""Makes docs/images/report.png, the README's picture: `python docs/report_picture.py REPORT`, with Chromium.

REPORT is the folder of a finished report. The file also holds the text of the first screen, so that a test can compare
it with what a report says today.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tempfile
from html import unescape
from pathlib import Path

from PIL import Image
from PIL.PngImagePlugin import PngInfo

PICTURE = Path(__file__).parent / "images" / "report.png"
SIZE = "1200,800"
"""Pixels of the window."""
BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome")


def text_of(page: str) -> str:
    """What the first screen says: its tags, its pictures and line ends are left out."""
    screen = page.partition('<section id="first"')[2].partition(">")[2].partition("</section>")[0]
    return " ".join(unescape(re.sub(r"(?s)<figure>.*?</figure>|<[^>]*>", "", screen)).split())


def main() -> None:
    """Open the page in a browser without a window, and keep what it shows."""
    page = Path(sys.argv[1], "index.html").resolve()
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser is None:
        raise SystemExit(f"This needs one of the programs {', '.join(BROWSERS)}.")
    information = PngInfo()
    information.add_itxt("Description", text_of(page.read_text(encoding="utf-8")))
    with tempfile.TemporaryDirectory() as folder:
        shot = Path(folder, "shot.png")
        options = ("--headless", "--no-sandbox", "--hide-scrollbars", f"--window-size={SIZE}", f"--screenshot={shot}")
        subprocess.run([browser, *options, page.as_uri()], check=True, capture_output=True)
        drawn = Image.open(shot).convert("RGB").quantize(256, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
        drawn.save(PICTURE, optimize=True, pnginfo=information)


if __name__ == "__main__":
    main()
