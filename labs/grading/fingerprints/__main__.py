"""`python -m labs.grading.fingerprints [--check]`: make the files, or say what is stale."""

from __future__ import annotations

import sys

from labs.grading.fingerprints import stale, write


def main(arguments: list[str]) -> int:
    """Run the command; 1 where `--check` finds something stale."""
    if arguments not in ([], ["--check"]):
        print("usage: python -m labs.grading.fingerprints [--check]")
        return 2
    if not arguments:
        print(*(f"wrote {path.name}" for path in write()), sep="\n")
        return 0
    found = stale()
    print(*found or ["the fingerprints are fresh"], sep="\n")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
