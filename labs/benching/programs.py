"""Other programs, watched from outside: how long they take, and how much memory all their processes take together.

Some rivals need so many packages that they get environments of their own, in the folder for caches; never the lab's.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from reference.errors import CollisionsError, RunFailed
from reference.running.shelf import default_folder

_LOOKS_EVERY = 0.1  # s between two looks at the memory, which take a third processor beside the grader and its worker
_SAID = 400  # characters of the output of a program that failed


@dataclass(frozen=True)
class Run:
    """How a program ended.

    seconds: from start to end. memory: the most bytes that all its processes took together; None if the system does not
    report that. said: what it printed.
    """

    seconds: float
    memory: int | None
    said: str


def run(command: Sequence[str | Path], folder: Path, environment: Mapping[str, str] | None = None) -> Run:
    """Run a program to its end.

    On Linux, the memory of the program and of all its child processes is looked at all the while. Memory that several
    processes share counts once. If a process does not let us look that closely, all of its memory counts.

    Raises
    ------
    RunFailed
        If it cannot be started, or its exit code is not 0.
    """
    most = 0
    with tempfile.TemporaryFile() as said:
        start = time.perf_counter()
        try:
            started = subprocess.Popen(
                command, cwd=folder, env={**os.environ, **(environment or {})},
                stdin=subprocess.DEVNULL, stdout=said, stderr=subprocess.STDOUT,
            )  # fmt: skip
        except OSError as error:
            raise RunFailed(f"{command[0]} cannot be started: {error}") from None
        with started:
            while started.poll() is None:
                most = max(most, _memory(started.pid))
                with contextlib.suppress(subprocess.TimeoutExpired):
                    started.wait(_LOOKS_EVERY)
        seconds = time.perf_counter() - start
        said.seek(0)
        text = said.read().decode(errors="replace")
    if started.returncode:
        raise RunFailed(f"{Path(command[0]).name} ended with {started.returncode}: {text[-_SAID:].strip()}")
    return Run(seconds, most or None, text)


def _memory(process: int) -> int:
    """Bytes of a process and of all its children; zero if it is gone, or if there is no `/proc`."""
    own = Path("/proc", str(process))
    try:
        below = [
            int(child)
            for children in own.glob("task/*/children")
            for child in children.read_text(encoding="ascii").split()
        ]
        return _share(own) + sum(map(_memory, below))
    except (OSError, IndexError):
        return 0


def _share(process: Path) -> int:
    """Bytes of a process, with its share of those that it shares."""
    with contextlib.suppress(OSError):
        for line in (process / "smaps_rollup").read_text(encoding="ascii").splitlines():
            if line.startswith("Pss:"):
                return int(line.split()[1]) * 1024
    return int((process / "statm").read_text(encoding="ascii").split()[1]) * os.sysconf("SC_PAGE_SIZE")


@dataclass(frozen=True)
class Environment:
    """A virtual environment in the folder for caches. packages: as pip takes them, the one that is timed first."""

    name: str
    packages: tuple[str, ...]

    @property
    def folder(self) -> Path:
        """The folder of the environment."""
        return default_folder() / "environments" / self.name

    @property
    def ready(self) -> bool:
        """Whether it was installed completely, with these packages."""
        with contextlib.suppress(OSError):
            return self._note.read_text(encoding="utf-8") == "\n".join(self.packages)
        return False

    @property
    def _note(self) -> Path:
        return self.folder / "packages.txt"

    def program(self, name: str) -> Path:
        """Return one of its programs.

        Raises
        ------
        ImportError
            If it was not installed.
        """
        if not self.ready:
            raise ImportError(f"no environment with {self.packages[0]}", name=self.packages[0])
        return self.folder / ("Scripts" if os.name == "nt" else "bin") / name

    def install(self) -> None:
        """Make it again from nothing, with the user's own configuration of pip.

        Raises
        ------
        CollisionsError
            If pip cannot install it; the message ends with pip's last words.
        """
        shutil.rmtree(self.folder, ignore_errors=True)
        python = self.folder / ("Scripts" if os.name == "nt" else "bin") / "python"
        try:
            run([sys.executable, "-m", "venv", self.folder], Path.cwd())
            run([python, "-m", "pip", "install", "--quiet", *self.packages], Path.cwd())
            self._note.write_text("\n".join(self.packages), encoding="utf-8")
        except (OSError, RunFailed) as error:
            raise CollisionsError(f"{self.packages[0]} cannot be installed: {error}") from None
