"""How long a student waits: one check in a notebook, and every cell of a solved one."""

from __future__ import annotations

import atexit
import tempfile
from collections.abc import Callable
from functools import partial

from labs.benching.timing import Bench
from labs.building import notebooks
from labs.desk import checks, student_code
from labs.grading.calling.remote import Grader
from labs.grading.feedback.tries import Tries


def check() -> Callable[[], object]:
    """`lab.check("impulse_magnitude")` in a kernel that has checked before."""
    cells = ["".join(cell["source"]) for cell in notebooks.solved("impulse")["cells"] if cell["cell_type"] == "code"]
    grader = Grader()
    atexit.register(grader.close)
    return lambda: checks.check(
        student_code.write_notebook(cells), "impulse", ["impulse_magnitude"], grader, Tries(), {}
    )


def solved(topic: str) -> Callable[[], object]:
    import nbformat  # noqa: PLC0415 - an extra
    from nbclient import NotebookClient  # noqa: PLC0415

    text = notebooks.text(notebooks.solved(topic))

    def run() -> object:
        notebook = nbformat.reads(text, as_version=4)
        with tempfile.TemporaryDirectory(prefix="bench-notebooks-") as folder:
            place = {"metadata": {"path": folder}}
            return NotebookClient(notebook, timeout=300, resources=place).execute()

    return run


CELLS = "every cell; after the first time its runs are in the cache"
BENCHES = (
    Bench("check", "one function checked in a notebook, its process and its tests", check, goal=1.0, who="lab.check"),
    Bench(
        "notebook-detection",
        f"the solved notebook, {CELLS}",
        partial(solved, "detection"),
        goal=30.0,
        who="detection.ipynb",
    ),
    Bench(
        "notebook-impulse",
        f"the solved notebook, {CELLS}",
        partial(solved, "impulse"),
        goal=30.0,
        who="impulse.ipynb",
    ),
)
