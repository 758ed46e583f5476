"""A submitted file as cells of source text: a notebook's code cells, or the whole of a `.py` file as one.

Threat: the file is hostile data. It is read as JSON and text only: no kernel, no nbformat, no import.
"""

from __future__ import annotations

import contextlib
import io
import json
import re
import tokenize
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path, PurePath
from typing import Any, Literal

from labs.grading.errors import UnreadableSubmission
from labs.grading.safe_text import one_line
from labs.grading.submission.opening import FILE_LIMIT, bytes_of, is_called_python

CELL_LIMIT = 2000
"""The most code cells."""
CODE_LIMIT = 2**18
"""Characters of the longest source, all code cells together: some five thousand lines."""
BRACE_LIMIT = 10_000
"""The most opening braces in it. Python's time for an f-string grows as their square: 80,000 need a minute."""

_DECLARED = {"iso-8859-1", "iso-8859-15", "cp1252", "cp1250", "mac-roman", "ascii"}
"""Encodings besides UTF-8 that a first line `# coding: …` may name. Others can be made to take very long."""
_PROGRAM = re.compile(r"^(?:def|import|from|class) \w+", re.MULTILINE)
"""The start of a line that only a program has, never a notebook's file."""
_MERGE_MARK = re.compile(r"^(<{7} |={7}$|>{7} |\|{7} )", re.MULTILINE)


@dataclass(frozen=True)
class Complaint:
    """What is wrong with a submission, in a line. cell: which code cell, from 1. line: in that cell or in the file.

    kind: missing, if wanted functions are not there; repeated, if a function is defined several times; unreadable, if
    Python cannot read a cell or the file; other for anything else.
    """

    text: str
    cell: int | None = None
    line: int | None = None
    kind: Literal["missing", "repeated", "unreadable", "other"] = "other"

    def __str__(self) -> str:
        found = place(self.cell, self.line)
        return f"{found}: {self.text}" if found else self.text


@dataclass(frozen=True)
class Cell:
    """One cell of source. number: which code cell of the notebook, None for a `.py` file. tags: what it is for.

    code: whether it is a code cell; a cell of text has the number of the last code cell before it.
    """

    source: str
    number: int | None = None
    tags: frozenset[str] = frozenset()
    code: bool = True


def place(cell: int | None, line: int | None) -> str:
    """A place in words, such as "code cell 3, line 2"; empty if neither is known."""
    parts = [f"code cell {cell}"] * (cell is not None) + [f"line {line}"] * (line is not None)
    return ", ".join(parts)


def read_cells(path: Path) -> tuple[list[Cell], list[Complaint]]:
    """The file's cells, those of text as well; raises `UnreadableSubmission` if it has no code that can be read."""
    raw, size = bytes_of(path)
    cells, complaints = cells_of(raw, path)
    if size > FILE_LIMIT:
        complaints.append(Complaint(f"it has {size / 2**20:.0f} MB, and its outputs are not read: clear them"))
    return cells, complaints


def cells_of(raw: bytes, path: PurePath) -> tuple[list[Cell], list[Complaint]]:
    """The same for a file's bytes. path: of which the name counts."""
    text, complaints = _text(raw)
    suffix = path.suffix.lower()
    braced = text.lstrip().startswith("{")
    notebook = braced and ('"cells"' in text or '"worksheets"' in text)
    if suffix == ".ipynb" and not braced and _PROGRAM.search(text):
        cells = [Cell(text)]
        complaints.append(Complaint("it is a Python file, though its name ends in .ipynb: rename it to .py"))
    elif suffix == ".ipynb" or (notebook and suffix != ".py") or (notebook and _is_json(text)):
        cells = list(_notebook_cells(text))
        if suffix != ".ipynb":
            ending = one_line(path.suffix) or "nothing"
            complaints.append(Complaint(f"it is a notebook, though its name ends in {ending}: rename it to .ipynb"))
    elif is_called_python(path.name):
        cells = [Cell(text)]
        if suffix != ".py":
            ending = one_line(path.suffix)
            complaints.append(Complaint(f"it is a Python file, though its name ends in {ending}: rename it to .py"))
    else:
        ending = f"ends in {one_line(path.suffix)!r}" if path.suffix else "has no ending"
        raise UnreadableSubmission(f"its name {ending}: hand in a .ipynb or a .py file")
    code = [cell for cell in cells if cell.code]
    if not any(cell.source.strip() for cell in code):
        raise UnreadableSubmission("it holds no code: all its cells are empty, or text")
    if len(code) > CELL_LIMIT:
        raise UnreadableSubmission(f"it has {len(code)} code cells, and at most {CELL_LIMIT} are read")
    if sum(len(cell.source) for cell in code) > CODE_LIMIT:
        raise UnreadableSubmission(f"it holds more than {CODE_LIMIT} characters of code")
    if sum(cell.source.count("{") for cell in code) > BRACE_LIMIT:
        raise UnreadableSubmission(f"it holds more than {BRACE_LIMIT} opening braces")
    return cells, complaints


def merge_mark(source: str) -> tuple[int, str] | None:
    """The first mark that a merge left in a source, with its line; None if there is none."""
    found = _MERGE_MARK.search(source)
    return (source.count("\n", 0, found.start()) + 1, found.group().strip()) if found else None


def _text(raw: bytes) -> tuple[str, list[Complaint]]:
    """The file as text with plain line ends; with a complaint if its encoding had to be guessed."""
    complaints = []
    encoding = utf_16(raw) or "utf-8-sig"
    with contextlib.suppress(SyntaxError):  # raised for an encoding that Python does not know
        declared, _ = tokenize.detect_encoding(io.BytesIO(raw).readline)
        encoding = declared if declared in _DECLARED else encoding
    try:
        text = raw.decode(encoding)
    except UnicodeDecodeError:
        text = raw.decode("cp1252", errors="replace")
        complaints.append(
            Complaint(
                "it is not UTF-8, and is read as Windows-1252: save it as UTF-8, or letters with accents may be wrong"
            )
        )
    if encoding.startswith("utf-16"):
        complaints.append(Complaint("it is UTF-16, which Python does not run: save it as UTF-8"))
    if "\0" in text:
        line = re.split("\r\n|\r|\n", text[: text.index("\0")])
        raise UnreadableSubmission(
            f"line {len(line)}: a NUL character is in it, so it is not a text file; save it as text, in UTF-8"
        )
    return text.replace("\r\n", "\n").replace("\r", "\n"), complaints


def utf_16(raw: bytes) -> str:
    """Which kind of UTF-16 a file is, by its mark or by the zeros of its first line; empty for any other encoding."""
    if raw[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return "utf-16"
    start = raw[:64]
    if len(start) > 3 and not any(start[1::2]):
        return "utf-16-le"
    return "utf-16-be" if len(start) > 3 and not any(start[::2]) else ""


def _is_json(text: str) -> bool:
    try:
        json.loads(text)
    except (ValueError, RecursionError):
        return False
    return True


def _notebook_cells(text: str) -> Iterator[Cell]:
    try:
        notebook = json.loads(text)
    except (ValueError, RecursionError) as error:
        if found := merge_mark(text):
            raise UnreadableSubmission(
                f"line {found[0]}: a merge left its marks in the notebook, so it cannot be read: take one of the two"
                " versions whole"
            ) from None
        if text.lstrip().startswith("{"):
            raise UnreadableSubmission(f"it is a notebook that is {_damage(error, text)}") from None
        raise UnreadableSubmission("it is not a notebook, whatever its name says: save it again in Jupyter") from None
    number = 0
    for cell in _cells_of(notebook):
        if isinstance(cell, dict):
            code = cell.get("cell_type") == "code"
            number += code
            source = _joined(cell.get("source", cell.get("input", ""))).replace("\r\n", "\n").replace("\r", "\n")
            yield Cell(source, number, _tags(cell.get("metadata")), code)


def _damage(error: Exception, text: str) -> str:
    """Where a notebook's file stops to be one."""
    again = "save it again in Jupyter, or take an earlier copy"
    if not isinstance(error, json.JSONDecodeError):
        return f"nested too deeply to be read: {again}"
    cut_off = error.msg.startswith("Unterminated string") or error.pos >= len(text.rstrip())
    return f"{'cut off' if cut_off else 'damaged'} at line {error.lineno}: {again}"


def _cells_of(notebook: Any) -> list[Any]:
    """The cells of a notebook of format 4, or those of all worksheets in format 3."""
    if isinstance(notebook, dict):
        sheets = notebook.get("worksheets")
        found = notebook.get("cells")
        if found is None and isinstance(sheets, list):
            each = [sheet.get("cells") for sheet in sheets if isinstance(sheet, dict)]
            found = [cell for cells in each if isinstance(cells, list) for cell in cells]
        if isinstance(found, list):
            return found
    raise UnreadableSubmission("it is not a notebook: it has no cells")


def _joined(source: Any) -> str:
    """A cell's source, which is a text or a list of its lines."""
    lines = source if isinstance(source, list) else [source]
    return "".join(line for line in lines if isinstance(line, str))


def _tags(metadata: Any) -> frozenset[str]:
    """A cell's tags, and the name that nbgrader gave it."""
    if not isinstance(metadata, dict):
        return frozenset()
    tags, grading = metadata.get("tags"), metadata.get("nbgrader")
    found = list(tags) if isinstance(tags, list) else []
    found += [grading.get("grade_id")] if isinstance(grading, dict) else []
    return frozenset(tag for tag in found if isinstance(tag, str))
