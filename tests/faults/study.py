"""Faults in the lab's own code, each with the test that notices it: `make weekly` makes them again.

    python tests/faults/study.py run [--all]                makes a quarter of faults.csv each week and runs their tests
    python tests/faults/study.py draw COVERAGE [--seed 41]  draws faults in lines that tests execute, into faults.csv
    python tests/faults/study.py find                       finds the test of each fault that has none

COVERAGE is what `pytest --cov=reference --cov=labs --cov=solutions --cov-context=test` and `coverage json
--show-contexts` write: which test executes which line. A fault is made in a copy of the tree, never in the tree itself.
"""

from __future__ import annotations

import argparse
import contextlib
import csv
import datetime
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path

import pytest
from mutations import Fault, faults, with_fault

ROOT = Path(__file__).parents[2]
TABLE = Path(__file__).with_name("faults.csv")
PACKAGES = ("reference", "labs", "solutions")
OF_EACH = 20
"""So many faults are drawn in each package."""
MOST_FILES = 8
"""In so many files a test is sought that notices a fault; where none does, the others are for a person to try."""
LEVELS = {"test": "not slow and not weekly", "verify": "slow and not weekly", "weekly": "weekly"}
LIMIT = 900.0
"""Time that the tests of one fault may take, s; a fault may make a loop endless."""
_COPIED = (*PACKAGES, "tests", "docs", "pyproject.toml", "README.md", "CONTRIBUTING.md", "Makefile", "LICENSE")


@dataclass(frozen=True)
class Entry:
    """A row of the table. level, test: of the test that notices it, empty where none is known.

    Where a fault changes no result, the level is `same`, and a person has put the reason in the place of the test.
    """

    path: str
    function: str
    before: str
    after: str
    count: int
    level: str = ""
    test: str = ""

    @property
    def fault(self) -> Fault:
        return Fault(self.path, self.function, self.before, self.after, self.count)


def read() -> list[Entry]:
    """The table."""
    with TABLE.open(encoding="utf-8", newline="") as file:
        return [Entry(**{**row, "count": int(row["count"])}) for row in csv.DictReader(file)]


def write(entries: list[Entry]) -> None:
    """Keep the table."""
    with TABLE.open("w", encoding="utf-8", newline="") as file:
        rows = csv.DictWriter(file, [field.name for field in fields(Entry)], lineterminator="\n")
        rows.writeheader()
        rows.writerows(map(asdict, entries))


def draw(executed: dict[str, dict[int, list[str]]], seed: int) -> list[Entry]:
    """Faults in executed lines, the same for the same seed; one in a line at most."""
    drawn, found = random.Random(seed), []
    for package in PACKAGES:
        lines: dict[tuple[str, int], list[Fault]] = {}
        for path in sorted(each for each in executed if each.startswith(f"{package}/")):
            for line, fault in faults(ROOT, path):
                if executed[path].get(line):
                    lines.setdefault((path, line), []).append(fault)
        places = drawn.sample(sorted(lines), OF_EACH)
        found += [Entry(**asdict(drawn.choice(lines[place]))) for place in places]
    return found


def near(entry: Entry) -> list[str]:
    """Test files that may notice a fault: those that name its function, its module, or the folder of its module."""
    *_, folder, module = Path(entry.path).with_suffix("").parts
    public = [name for name in entry.function.split(".") if not name.startswith("_")]

    def likeness(path: Path) -> int:
        text = path.read_text(encoding="utf-8")
        names_it = any(re.search(rf"\b{name}\b", text) for name in public)
        return 4 * names_it + 2 * bool(re.search(rf"\b{module}\b", text)) + (folder in str(path.relative_to(ROOT)))

    likely = {path: likeness(path) for folder in ("reference", "labs", "solutions") for path in _tests_of(folder)}
    best = sorted((path for path in likely if likely[path]), key=lambda path: -likely[path])
    return [str(path.relative_to(ROOT)) for path in best[:MOST_FILES]]


def _tests_of(package: str) -> list[Path]:
    return sorted((ROOT / "tests" / package).rglob("test_*.py"))


def noticed(entry: Entry, tests: list[str], level: str) -> str:
    """The first of these tests of a level that fails with the fault; empty if none does."""
    with copied() as copy:
        target = copy / entry.path
        target.write_text(with_fault(target.read_text(encoding="utf-8"), entry.fault), encoding="utf-8")
        return failing(copy, tests, LEVELS[level])


@contextlib.contextmanager
def copied() -> Iterator[Path]:
    """A copy of the tree, for as long as it is needed."""
    with tempfile.TemporaryDirectory() as place:
        copy = Path(place, "lab")
        copy.mkdir()
        for name in _COPIED:
            source = ROOT / name
            if source.is_dir():
                shutil.copytree(source, copy / name, ignore=shutil.ignore_patterns("__pycache__"))
            else:
                shutil.copy2(source, copy / name)
        yield copy


def failing(copy: Path, tests: Sequence[str], marks: str, limit: float = LIMIT) -> str:
    """The first of these tests that fails in a copy of the tree, or all if they did not end; empty if none fails.

    Raises
    ------
    LookupError
        If tests are given by name, and there is none of these marks.
    """
    environment = os.environ | {"PYTHONPATH": str(copy), "MPLBACKEND": "Agg", "COLLISIONS_LIVE": "here"}
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", "-m", marks, *tests]
    try:
        ended = subprocess.run(
            command, cwd=copy, env=environment, capture_output=True, text=True, timeout=limit, check=False
        )
    except subprocess.TimeoutExpired:
        return " ".join(tests)
    none_there = ended.returncode == pytest.ExitCode.NO_TESTS_COLLECTED
    if ended.returncode == pytest.ExitCode.USAGE_ERROR or (none_there and "::" in tests[0]):
        raise LookupError(f"there is no such test of this level: {' '.join(tests)}")
    if none_there or ended.returncode == pytest.ExitCode.OK:
        return ""
    name = re.search(r"^(?:FAILED|ERROR) ([^\s\[]+)", ended.stdout, re.MULTILINE)
    return name[1] if name else tests[0]


def found(entry: Entry, levels: list[str]) -> Entry:
    """The entry with the test that notices it, sought level by level in the files that are near it."""
    for level in levels:
        if test := noticed(entry, near(entry), level):
            return replace(entry, level=level, test=test)
    return entry


def run(workers: int, week: int | None) -> int:
    """Make faults of the table again; 1 if one of them is not noticed, or its test fails without it too.

    week: of the year, which decides which quarter of them is made; None for all.
    """
    entries = [entry for entry in read() if entry.level in LEVELS]
    if week is not None:
        entries = entries[week % 4 :: 4]
    with copied() as copy:
        if test := failing(copy, sorted({entry.test for entry in entries}), "", limit=4 * LIMIT):
            print(f"without any fault, this fails or does not end: {test}")
            return 1

    def again(entry: Entry) -> str:
        try:
            if noticed(entry, [entry.test], entry.level):
                return ""
            return f"{entry.test} does not notice {entry.before} → {entry.after} in {entry.path}, {entry.function}"
        except LookupError as error:
            return f"draw another, or find its test: {error}"

    with ThreadPoolExecutor(workers) as executor:
        missed = list(filter(None, executor.map(again, entries)))
    print(*missed, f"{len(entries) - len(missed)} of {len(entries)} faults are noticed.", sep="\n")
    return 1 if missed else 0


def executed_lines(path: Path) -> dict[str, dict[int, list[str]]]:
    """By file and line, the tests that execute it."""
    whole = json.loads(path.read_text(encoding="utf-8"))["files"]
    return {
        name: {int(line): names for line, tests in each["contexts"].items() if (names := [it for it in tests if it])}
        for name, each in whole.items()
    }


def main() -> int:
    """Carry out a command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=["run", "draw", "find"])
    parser.add_argument("coverage", type=Path, nargs="?")
    parser.add_argument("--seed", type=int, default=41)
    parser.add_argument("--levels", nargs="+", choices=LEVELS, default=list(LEVELS))
    parser.add_argument("--all", action="store_true", help="run every fault, and not the quarter of this week")
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    asked = parser.parse_args()
    if asked.command == "run":
        return run(asked.workers, None if asked.all else datetime.date.today().isocalendar().week)
    if asked.command == "draw":
        write(draw(executed_lines(asked.coverage), asked.seed))
        return 0
    entries = read()
    with ThreadPoolExecutor(asked.workers) as executor:
        looking = {
            executor.submit(found, entry, asked.levels): place for place, entry in enumerate(entries) if not entry.test
        }
        for each in as_completed(looking):
            entries[looking[each]] = each.result()
            write(entries)  # what is known so far outlives an interrupt
    return 0


if __name__ == "__main__":
    sys.exit(main())
