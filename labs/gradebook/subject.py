"""Which lab a delivered file is about: its first cell says `lab.begin("impulse")`, or it defines the lab's functions.

Threat: the file is hostile data, and it is looked at before the submission has a process of its own. So the text is
short, outputs are cut out before it becomes objects, and only cells that name a function of the lab are parsed.
"""

from __future__ import annotations

import ast
import re
import warnings
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import IntEnum
from pathlib import PurePosixPath

from labs.gradebook.delivered_files import DeliveredFile
from labs.grading.errors import UnreadableSubmission
from labs.grading.submission.cells import Cell, cells_of
from labs.grading.submission.complaints import definitions
from labs.grading.submission.large_notebooks import LARGEST, without_outputs
from labs.grading.submission.magics import without_magics
from labs.grading.submission.opening import is_called_python, most_bytes
from labs.grading.submission.stubs import is_open_version, is_stub
from reference import lecture

MOST_LOOKS = 20
"""So many files of a submission are looked at, the likely ones first, and no more than `LARGEST` bytes."""
_MOST_TEXT = 2**21
"""Bytes of a notebook without its outputs that become objects."""
_BEGINS = re.compile(r"""^[^#\n]*\.\s*begin\(\s*["'](\w+)["']""", re.MULTILINE)


class Subject(IntEnum):
    """What a file is about, the likeliest to be meant first.

    WRITTEN: this lab, with functions of it written. DAMAGED: this lab, in a file that cannot be read. UNTOUCHED: this
    lab, as the student found it. UNKNOWN: nothing that is known. OTHER: another lab.
    """

    WRITTEN = 0
    DAMAGED = 1
    UNTOUCHED = 2
    UNKNOWN = 3
    OTHER = 4


@dataclass(frozen=True)
class Look:
    """What a look at a file finds. written: how many functions of the lab. said: why it may not be this lab's file.

    What is said is empty if it surely is this lab's, or if nobody can tell.
    """

    subject: Subject = Subject.UNKNOWN
    written: int = 0
    said: str = ""

    @property
    def is_this_lab(self) -> bool:
        """Whether it is about this lab."""
        return self.subject <= Subject.UNTOUCHED


def looks(files: Sequence[DeliveredFile], lab: str) -> list[Look]:
    """A look at each of a submission's files, the likeliest first."""
    left, found = LARGEST, list[Look]()
    for file in files:
        fits = len(found) < MOST_LOOKS and not file.shut and file.size <= min(left, most_bytes(file.name))
        found.append(_look(file, lab) if fits else Look())
        left -= file.size * fits
    return found


def subject_of(raw: bytes, name: str, lab: str) -> Look:
    """What a file is about, by its bytes."""
    wanted = [entry.name for entry in lecture.functions_of(lab) if entry.role == "written"]
    if len(raw) > _MOST_TEXT and not is_called_python(name):
        raw = without_outputs(raw) or b""
    try:
        if len(raw) > _MOST_TEXT:
            raise UnreadableSubmission("it is too long to be looked at")
        cells, _ = cells_of(raw, PurePosixPath(name))
    except UnreadableSubmission:
        return Look(Subject.DAMAGED if any(each.encode() in raw for each in wanted) else Subject.UNKNOWN)
    code = [cell for cell in cells if cell.code]
    begun = dict.fromkeys(each for cell in code for each in _BEGINS.findall(cell.source))
    written, untouched = _defined(code, wanted)
    return _judged(lab, list(begun), len(written), len(untouched), len(wanted))


def _look(file: DeliveredFile, lab: str) -> Look:
    try:
        return subject_of(file.read(file.size), file.name, lab)
    except (OSError, UnreadableSubmission):  # what is wrong with it is said when it is graded
        return Look()


def _judged(lab: str, begun: Sequence[str], written: int, untouched: int, of: int) -> Look:
    """What a file is about. One that begins another lab may only use some of this lab's functions there."""
    if begun and lab not in begun:
        has = f"{written} of the {of} functions" if written else "no function"
        said = f"begins the lab {begun[-1]} and defines {has} of {lab}"
        return Look(Subject.WRITTEN if 2 * written > of else Subject.OTHER, written, said)
    if begun or written or untouched:
        return Look(Subject.WRITTEN if written else Subject.UNTOUCHED, written)
    return Look(said=f"does not begin the lab {lab} and defines no function of it")


def _defined(cells: Iterable[Cell], wanted: Sequence[str]) -> tuple[set[str], set[str]]:
    """The wanted functions that are written, in some version at least, and those that are as the student found them."""
    written, untouched = set[str](), set[str]()
    for cell in cells:
        if any(name in cell.source for name in wanted):
            for name, is_open in _functions(cell.source):
                (untouched if is_open else written).update({name} & {*wanted})
    return written, untouched - written


def _functions(source: str) -> list[tuple[str, bool]]:
    """The functions of a cell, each with whether it is open. In a cell that Python cannot read something is written."""
    tree = _parsed(source) or _parsed(without_magics(source))
    if tree is None:
        return [(name, False) for name in definitions(source)]
    made = [each for each in tree.body if isinstance(each, ast.FunctionDef)]
    targets = [target for each in tree.body if isinstance(each, ast.Assign) for target in each.targets]
    found = [(each.name, is_stub(each) or is_open_version(each)) for each in made]
    return found + [(target.id, False) for target in targets if isinstance(target, ast.Name)]


def _parsed(source: str) -> ast.Module | None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # about a backslash in a text: the student sees that elsewhere
        try:
            return ast.parse(source)
        except (SyntaxError, ValueError, RecursionError, MemoryError):  # the last two: text that no person writes
            return None
