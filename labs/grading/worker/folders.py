"""Removes folders in which a submission could write.

Threat: folders that lie so deep that recursion ends in an error and no path reaches them, or that cannot be entered.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator

_LONG = 200  # characters of a path below the top; no system takes a path of any length


def remove(folder: str | os.PathLike[str]) -> None:
    """Remove a folder with everything in it, as far as the system allows; links are removed and not followed."""
    found = [os.fspath(folder)]
    with contextlib.suppress(OSError):
        if os.path.islink(folder):
            os.unlink(folder)
    for each in found:  # which grows meanwhile
        with contextlib.suppress(OSError):
            found.extend(_emptied(each, found[0]))
    for each in reversed(found):
        with contextlib.suppress(OSError):
            os.rmdir(each)


def _emptied(folder: str, top: str) -> Iterator[str]:
    """Remove the files of a folder, and return its folders; those with a long path are moved to the top."""
    os.chmod(folder, 0o700)
    with os.scandir(folder) as entries:
        found = list(entries)
    for entry in found:
        with contextlib.suppress(OSError):
            if not entry.is_dir(follow_symlinks=False):
                os.unlink(entry.path)
            elif len(entry.path) - len(top) < _LONG:
                yield entry.path
            else:
                os.chmod(entry.path, 0o700)  # what may not be written cannot be moved
                moved = os.path.join(top, os.urandom(8).hex())
                os.rename(entry.path, moved)
                yield moved
