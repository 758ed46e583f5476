"""`python -m labs.grading.diagnosis.fingerprints [--check]`: make the files, or say what is stale."""

from __future__ import annotations

import sys

from labs.grading.diagnosis.fingerprints import stale, write
from reference.errors import CollisionsError


def main(arguments: list[str]) -> int:
    """Run the command; returns 1 if `--check` finds something stale, 2 if the bank or the probes have to be mended."""
    if arguments not in ([], ["--check"]):
        print("usage: python -m labs.grading.diagnosis.fingerprints [--check]")
        return 2
    try:
        found = stale() if arguments else [f"wrote {path.name}" for path in write()]
    except CollisionsError as error:
        print(error)
        return 2
    if not arguments:
        print(*found, sep="\n")
        return 0
    print(*found or ["the fingerprints are fresh"], sep="\n")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
