"""What the README's picture of a report says: the program that makes it keeps the text in the file."""

from __future__ import annotations

from pathlib import Path

from PIL import Image

PICTURE = Path(__file__).parents[2] / "docs" / "images" / "report.png"
AGAIN = "make the picture again: make report, then python docs/report_picture.py report"


def in_the_picture() -> str:
    """The text of the first screen, without the marks of numbers that come from recordings."""
    with Image.open(PICTURE) as picture:
        return str(picture.text["Description"]).replace("*", "")
