"""The table in which an instructor names the clusters of a class, and what becomes of it.

    grades/clusters.toml    each cluster, with a title and a help to be written

The next run moves what is named to the course's own bank, and leaves everything else.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from labs.gradebook.mistakes.clusters import Cluster
from labs.gradebook.mistakes.course_bank import CourseBank
from labs.gradebook.mistakes.entries import Entry, read_entries
from labs.grading.judging.grade import write_private

FILE, PAGE = "clusters.toml", "clusters.html"
_HEAD = """\
# Mistakes without a name that several students share. {page} shows each of them.
# Write a title and a help, and run the command again: it moves the mistake to the course's
# own bank, {bank}, and these students read both, as everybody does who makes it later.
# Leave both empty if you do not want to name one. Comments of your own are not kept.
"""


def read_waiting(folder: Path) -> list[Entry]:
    """What is in the table; raises `InvalidInput` if it is not as it has to be, with the line and the choices."""
    return read_entries(folder / FILE)


def name_filled_in(folder: Path, bank: CourseBank) -> tuple[CourseBank, list[Entry], list[str]]:
    """Move everything that has a title and a help to the bank.

    Returns the bank, the entries that are left, and what the instructor should know. Raises what `read_waiting` does.
    """
    left, new, notes = list[Entry](), list[Entry](), list[str]()
    for entry in read_waiting(folder):
        if entry in bank.entries:  # a run was stopped when it had been moved
            continue
        why = CourseBank(bank.folder, (*bank.entries, *new)).refusal(entry) if entry.title and entry.help else ""
        if entry.title and entry.help and not why:
            new.append(entry)
            notes.append(f"{entry.id} is named: {entry.title}")
            continue
        left.append(entry)
        if why:
            notes.append(f"{entry.id} is not named: {why}.")
        elif entry.title or entry.help:
            has, lacks = ("title", "help") if entry.title else ("help", "title")
            notes.append(f"{entry.id} is not named yet: it has a {has} and no {lacks}.")
    return bank.with_entries(new), left, notes


def write_waiting(folder: Path, found: Sequence[Cluster], waiting: Sequence[Entry], bank: CourseBank) -> None:
    """Write the table: the clusters of this run, and of the last one those for which somebody has written something."""
    before = {entry.id: entry for entry in waiting}
    tables = []
    for each in found:
        entry = before.pop(each.id, None) or Entry(each.id, each.numbers)
        tables.append(f"# {len(each.students)} students\n{entry.text()}")
    tables += [f"# no two students any more\n{entry.text()}" for entry in before.values() if entry.title or entry.help]
    head = _HEAD.format(page=PAGE, bank=bank.folder)
    if tables:
        write_private(folder / FILE, "\n".join([head, *tables]))
    else:
        (folder / FILE).unlink(missing_ok=True)
