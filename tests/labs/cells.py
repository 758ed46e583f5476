"""What a kernel has run, as tests of the desk have it: the solutions as cells, and notebooks of one's own."""

from __future__ import annotations

import json
from pathlib import Path

ROOT = Path(__file__).parents[2]
CHECKS = (ROOT / "solutions" / "checks.py").read_text(encoding="utf-8")
DETECTION = (ROOT / "solutions" / "detection.py").read_text(encoding="utf-8")
STUB = """
def signed_distance(point, normal, offset):
    \"\"\"Distance.\"\"\"
    raise NotImplementedError("detection, step 1: signed_distance is yours to write")
"""


def right_cells():
    """The solutions as the cells of a notebook that imports nothing of ours."""
    imports = "from solutions.checks import finite, not_negative, positive, vector"
    return [text.replace(imports, "").replace("from __future__ import annotations", "") for text in (CHECKS, DETECTION)]


def said(capsys, call, *arguments, **named):
    """What a call prints."""
    call(*arguments, **named)
    return capsys.readouterr().out


def write_notebook(path, *sources):
    cells = [{"cell_type": "code", "metadata": {}, "source": source, "outputs": []} for source in sources]
    path.write_text(json.dumps({"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": cells}), encoding="utf-8")
    return path
