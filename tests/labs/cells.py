"""What a kernel has run, as tests of the desk have it: the solutions as cells, and notebooks of one's own."""

from __future__ import annotations

import json
import re
from pathlib import Path

SOLUTIONS = Path(__file__).parents[2] / "solutions"
DETECTION = tuple(f"detection/{name}" for name in ("planes", "time_of_impact", "two_walls", "sampling"))
CELLS = (("arrays", "checks", "domain", "vectors"), DETECTION)
"""The modules of each cell: what is given, and what is written."""
OURS = re.compile(r"^from (solutions|__future__)[\w.]* import (\([^)]*\)|.*)\n", re.MULTILINE)
SIDE = (
    "def side_of_plane(separation, tolerance=0.0):\n"
    "    return (separation > tolerance) * 1 - (separation < -tolerance) * 1"
)
"""A right function of a student, in a cell of its own."""
STUB = """
def signed_distance(point, normal, offset):
    \"\"\"Distance.\"\"\"
    raise NotImplementedError("detection, step 1: signed_distance is yours to write")
"""


def right_cells():
    """The solutions as the cells of a notebook that imports nothing of ours."""
    texts = [[(SOLUTIONS / f"{name}.py").read_text(encoding="utf-8") for name in modules] for modules in CELLS]
    return [OURS.sub("", "\n".join(text)) for text in texts]


def said(capsys, call, *arguments, **named):
    """What a call prints."""
    call(*arguments, **named)
    return capsys.readouterr().out


def write_notebook(path, *sources):
    cells = [{"cell_type": "code", "metadata": {}, "source": source, "outputs": []} for source in sources]
    path.write_text(json.dumps({"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": cells}), encoding="utf-8")
    return path
