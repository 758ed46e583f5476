"""Writes all files that come from code and are not in git: `make docs` or `python docs/build.py`.

These are the figures of the pages and of the labs, the solved notebooks, the instructors' pages, and the pages of the
course, the statements and the symbols. The students' notebooks, which are in git, are written with them. A figure that
is newer than all code is left as it is. It takes a minute of processor time to write everything, and a quarter of a
minute if no figure has to be drawn.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PROGRAMS = (
    ("docs/figures/draw.py",),  # first: the labs say which of their figures are missing
    ("-m", "labs", "lab", "build"),
    ("docs/statement_table.py",),
    ("docs/symbol_table.py",),
)


def main() -> int:
    """Run the programs one after another, and stop at the first that fails."""
    for program in PROGRAMS:
        if code := subprocess.run([sys.executable, *program], cwd=ROOT, check=False).returncode:
            print(f"{' '.join(program)} failed, so what `make docs` writes is not complete.", file=sys.stderr)
            return code
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit("Interrupted, so what `make docs` writes is not complete.")
