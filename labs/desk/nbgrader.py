"""Whether nbgrader runs the notebook."""

from __future__ import annotations

import os


def run_of_nbgrader() -> str:
    """What nbgrader runs this notebook for, `autograde` or `validate`; empty if a person runs it."""
    return os.environ.get("NBGRADER_EXECUTION", "")
