"""The student's own functions, from the cells that were run and from earlier notebooks, and correct ones for the rest.

A notebook's functions are cut out of the source of its cells as the grader does it (`labs.grading.submission.reading`),
which leaves plots and experiments behind. They are written to a `.py` file, and a worker process loads that file: an
endless loop or a crash in it costs one run, and the kernel lives on.
"""

from __future__ import annotations

import ast
import atexit
import hashlib
import json
import re
import shutil
import tempfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, lru_cache
from pathlib import Path

from labs.correct_functions import package_of_correct_functions
from labs.grading.errors import UnreadableSubmission
from labs.grading.submission.magics import without_magics
from labs.grading.submission.reading import Submission, read
from labs.grading.submission.stubs import UNWRITTEN, is_open_version, is_stub
from reference import lecture
from reference.engines.implementation import Implementation

_ABOVE = 1
"""Lines of a written module before the student's own: one import."""
_DEFINES = re.compile(r"^def (\w+)", re.MULTILINE)


@dataclass(frozen=True)
class StudentCode:
    """What hand-written code runs for one student in one lab.

    topic: of the lab. own: the functions of that lab that the student has written. earlier: those of earlier labs, each
    with the notebook that it comes from. complaints: about these notebooks. package: has correct functions for the
    rest; empty if there is none. source: all of this as an `Implementation` takes it. files: the written modules by
    name, each with the notebook that it comes from (empty for the lab's own) and what was read there.
    """

    topic: str
    own: tuple[str, ...]
    earlier: tuple[tuple[str, str], ...]
    complaints: tuple[str, ...]
    package: str
    source: str
    files: Mapping[str, tuple[str, Submission]] = field(default_factory=dict)

    def located(self, text: str) -> str:
        """A message in which every `line 3 of FILE` names the student's own cell instead."""

        def cell(found: re.Match[str]) -> str:
            line, file = found.groups()
            if file not in self.files:
                return found[0]
            notebook, submission = self.files[file]
            return f"{notebook}{', ' * bool(notebook)}{submission.where(int(line) - _ABOVE)}"

        return with_kernel_numbers(re.sub(r"line (\d+) of (\S+\.py)", cell, text).replace("handwritten: ", ""))

    @property
    def functions(self) -> frozenset[str]:
        """All functions that the student has written, in this lab and in earlier ones."""
        return frozenset((*self.own, *(name for name, _ in self.earlier)))


def with_kernel_numbers(text: str) -> str:
    """A message that names cells as the kernel numbers them: `cell [3]`."""
    return re.sub(r"(?<!ipynb, )code cell (\d+)", r"cell [\1]", text)


def executed_cells() -> list[str]:
    """The source of every cell that this kernel has run, the n-th is In [n]; empty if the cell was corrected later."""
    from IPython import get_ipython  # noqa: PLC0415 - only a notebook has it

    shell = get_ipython()
    return [] if shell is None else without_corrected(shell.history_manager.input_hist_raw[1:])


def vanished_functions(cells: Sequence[str]) -> list[str]:
    """Functions that cells define and the kernel lacks: they were deleted since, or their cell ended in an error."""
    from IPython import get_ipython  # noqa: PLC0415

    shell = get_ipython()
    return [] if shell is None else sorted(defined_in(cells) - shell.user_ns.keys())


def defined_now(name: str) -> Callable[..., object] | None:
    """The function of that name in the kernel; None if it has none."""
    from IPython import get_ipython  # noqa: PLC0415

    shell = get_ipython()
    found = None if shell is None else shell.user_ns.get(name)
    return found if callable(found) else None


def functions_that_print(cells: Sequence[str]) -> list[str]:
    """Functions whose last definition calls print."""
    found: dict[str, bool] = {}
    for cell in cells:
        if not _is_unreadable(cell):
            functions = [node for node in ast.parse(without_magics(cell)).body if isinstance(node, ast.FunctionDef)]
            found |= {node.name: "Name(id='print'" in ast.dump(node) for node in functions}
    return [name for name, prints in found.items() if prints]


def without_corrected(cells: Sequence[str]) -> list[str]:
    """Cells, with those that Python could not read left empty, except for the last try at each function."""
    found = list(cells)
    for place, cell in enumerate(cells):
        tried, later = defined_in([cell]), defined_in(cells[place + 1 :])
        if _is_unreadable(cell) and (not tried or later & tried):
            found[place] = ""
    return found


def without_outdone(cells: Sequence[str]) -> list[str]:
    """Cells without the earlier definitions of functions whose last try Python cannot read.

    So that a check says what keeps the last try from being read, and nothing of a definition that is on no screen.
    """
    found = list(cells)
    for place, cell in enumerate(cells):
        if _is_unreadable(cell):
            tried = defined_in([cell])
            found[:place] = [_without(earlier, tried & defined_in([earlier])) for earlier in found[:place]]
    return found


def _without(cell: str, names: frozenset[str]) -> str:
    """A cell with empty lines where it defines functions of those names."""
    if not names or _is_unreadable(cell):
        return cell
    source = without_magics(cell)
    lines = source.split("\n")
    for node in ast.parse(source).body:
        if isinstance(node, ast.FunctionDef) and node.name in names:
            first = min([node.lineno, *(decorator.lineno for decorator in node.decorator_list)])
            last = node.end_lineno or node.lineno
            lines[first - 1 : last] = [""] * (last - first + 1)
    return "\n".join(lines)


def defined_in(cells: Iterable[str]) -> frozenset[str]:
    """The functions that cells define, or try to."""
    return frozenset(name for cell in cells for name in _DEFINES.findall(cell))


def _is_unreadable(cell: str) -> bool:
    try:
        ast.parse(without_magics(cell))
    except (SyntaxError, ValueError):
        return True
    return False


def write_notebook(cells: Sequence[str]) -> Path:
    """Write cells to a notebook file, whose n-th code cell is the n-th of them."""
    path = _folder() / "notebook.ipynb"
    content = {
        "nbformat": 4,
        "nbformat_minor": 5,
        "metadata": {},
        "cells": [{"cell_type": "code", "metadata": {}, "source": cell, "outputs": []} for cell in cells],
    }
    path.write_text(json.dumps(content), encoding="utf-8")
    return path


def collect(topic: str, notebook: Path, beside: Iterable[Path] = ()) -> StudentCode:
    """Collect the functions of a lab from its notebook, and those of earlier labs from the notebooks beside it.

    Raises
    ------
    UnreadableSubmission
        If the notebook holds no code.
    """
    names = [entry.name for entry in lecture.functions_of(topic) if entry.role == "written"]
    submission = read(notebook, names, also=lecture.FUNCTIONS)
    unwritten = _unwritten(submission)
    stubs = [name for name in names if name not in submission.functions]
    own_file = _write_module(topic, submission.text + _stubs(stubs))
    files, complaints = {own_file: ("", submission)}, list[str]()
    earlier: list[tuple[str, str]] = []
    for path in beside:
        try:
            found, unread = _read_earlier(path)
        except UnreadableSubmission as error:
            complaints.append(str(error))
            continue
        complaints += [f"{path.name}, {complaint}" for complaint in unread]
        if found is not None:
            files[_write_module(path.stem, found.text)] = (path.name, found)
            earlier += [(name, path.name) for name in found.functions]
    package = package_of_correct_functions()
    own = tuple(name for name in names if name in submission.functions and name not in unwritten)
    return StudentCode(
        topic,
        own,
        tuple(earlier),
        tuple(complaints),
        package,
        source=" | ".join([*map(str, files), *([package] if package else [])]),
        files={file.name: read_there for file, read_there in files.items()},
    )


def earlier_notebooks(topic: str, folder: Path) -> list[Path]:
    """Notebooks of earlier labs in a folder, the latest lab first; each has its topic's name."""
    names = [each.name for each in lecture.TOPICS]
    found = [folder / f"{name}.ipynb" for name in names[: names.index(topic)]]
    return [path for path in reversed(found) if path.is_file()]


def _read_earlier(path: Path) -> tuple[Submission | None, list[str]]:
    """The functions of its lab written in an earlier notebook, None if there are none; and what cannot be read.

    A program that a student mends there may have the name of a function of another lab, and is not that function.
    """
    try:
        content = path.read_bytes()
    except OSError:  # reading it as a notebook says so in words
        content = b""
    return _read_once(path, content)


@lru_cache(maxsize=2 * len(lecture.TOPICS))
def _read_once(path: Path, _content: bytes) -> tuple[Submission | None, list[str]]:
    """What `_read_earlier` returns for a file of that content: each run of a lab asks for it, and it rarely changes."""
    wanted = [entry.name for entry in lecture.functions_of(path.stem) if entry.role == "written"]
    everything = read(path, wanted)
    unread = [str(complaint) for complaint in everything.complaints if complaint.kind == "unreadable"]
    kept = [name for name in everything.functions if name not in _unwritten(everything)]
    return read(path, kept) if kept else None, unread


def _unwritten(submission: Submission) -> frozenset[str]:
    """The functions that are still stubs: a description, and an error that says whose turn it is."""
    return frozenset(
        node.name
        for node in ast.parse(submission.text).body
        if isinstance(node, ast.FunctionDef) and (is_stub(node) or is_open_version(node))
    )


def _stubs(names: Iterable[str]) -> str:
    """Functions whose cells were not run: an error, so that no correct function takes their place."""
    return "".join(f"\n\ndef {name}(*arguments, **named):\n    raise {UNWRITTEN}\n" for name in names)


def _write_module(name: str, text: str) -> Path:
    """Write the text to a module that stays as long as this process; the same text is always the same file."""
    path = Path(_folder(), f"{name}-{hashlib.sha256(text.encode()).hexdigest()[:12]}.py")
    path.write_text(f"from __future__ import annotations\n{text}", encoding="utf-8")
    return path


@cache
def _folder() -> Path:
    """A folder for this process, which is removed when it ends."""
    made = tempfile.mkdtemp(prefix="collisions-lab-")
    atexit.register(shutil.rmtree, made, ignore_errors=True)
    return Path(made)


def named_implementation(implementation: str) -> str:
    """What `--implementation` names. A notebook stands for its functions, with correct ones for the rest.

    Paths become absolute, as the code of a file may go to another folder.

    Raises
    ------
    UnreadableSubmission
        If a notebook holds no code.
    InvalidInput
        If it is neither a notebook, nor a package, nor a `.py` file that Python can read.
    """
    path = Path(implementation)
    if path.suffix != ".ipynb":
        if implementation != Implementation.source:  # a student's tree lacks the package that stands here by default
            Implementation(implementation).check()
        return Implementation(implementation).wherever().source
    written = [name for name, entry in lecture.FUNCTIONS.items() if entry.role == "written"]
    found = read(path, written)
    topics = {lecture.function(name).topic for name in found.functions}
    latest = next((topic.name for topic in reversed(lecture.TOPICS) if topic.name in topics), lecture.TOPICS[0].name)
    return collect(latest, path, earlier_notebooks(latest, path.parent)).source
