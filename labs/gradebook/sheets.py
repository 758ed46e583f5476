"""Reads the tables and texts that an instructor may have saved with any program, such as Excel or Notepad.

A table may be UTF-8 with or without a byte-order mark, UTF-16 or Windows-1252. Its cells may be separated by commas,
semicolons or tabs, its numbers may have decimal commas, and it may have blank rows. What it says is read all the same;
what cannot be meant is refused with the line, because a cell that is read wrongly costs somebody points.
"""

from __future__ import annotations

import csv
import io
import re
import unicodedata
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from labs.grading.submission.cells import utf_16
from reference.errors import InvalidInput

MOST_BYTES = 10 * 2**20
MOST_CELLS = 10**6
"""Of a table, those included that its lines leave out; the gradebook of 1,000 students and 500 assignments has half."""
csv.field_size_limit(MOST_BYTES)  # Python's own limit is below what a student may write into Moodle, which is one cell
BYTE_ORDER_MARK = "\ufeff"
_DELIMITERS = (",", ";", "\t")
_LINE_END = re.compile(r"\r\n|\r|\n")
_HINT = re.compile(r"sep=([,;\t|])[\r\n]+", re.IGNORECASE)
"""The line before the header with which Excel names the delimiter."""
_NO_TEXT = {b"PK\x03\x04": "a workbook or an archive", b"\xd0\xcf\x11\xe0": "an old workbook of Excel"}
_NUMBER = re.compile(r"[+-]?(?:[0-9]+(?:[.,][0-9]*)?|[.,][0-9]+)")


@dataclass(frozen=True)
class Dialect:
    """How a table is written. mark: the byte-order mark that it begins with, or empty."""

    delimiter: str = ","
    newline: str = "\n"
    mark: str = ""

    def text(self, lines: Iterable[Iterable[str]]) -> str:
        """Lines of cells as the text of a file."""
        file = io.StringIO(newline="")
        csv.writer(file, delimiter=self.delimiter, lineterminator=self.newline).writerows(lines)
        return self.mark + file.getvalue()


@dataclass(frozen=True)
class Row:
    """A line of a table. number: of the line in the file, from 1. cells: by heading as `plain` spells it, stripped."""

    number: int
    cells: Mapping[str, str]

    def __getitem__(self, heading: str) -> str:
        return self.cells.get(plain(heading), "")


@dataclass(frozen=True)
class Sheet:
    """A table as somebody saved it.

    header, lines: every cell as it is written; blank lines are left out, and each line has as many cells as the header.
    numbers: the line of the file on which each line begins, from 1.
    """

    name: str
    header: tuple[str, ...] = ()
    lines: tuple[tuple[str, ...], ...] = field(default=(), repr=False)
    numbers: tuple[int, ...] = field(default=(), repr=False)
    dialect: Dialect = Dialect()

    def places(self, heading: str) -> list[int]:
        """The columns that have a heading, from 0."""
        return [place for place, each in enumerate(self.header) if plain(each) == plain(heading)]

    def rows(self) -> Iterator[Row]:
        """The lines by heading; of several columns with one heading, the first."""
        headings = [plain(each) for each in self.header]
        for number, line in zip(self.numbers, self.lines, strict=True):
            yield Row(number, dict(reversed([*zip(headings, map(str.strip, line), strict=True)])))


def read_sheet(path: Path, known: Collection[str]) -> Sheet:
    """Read a table. known: headings that it may have, by which the delimiter is recognised.

    Raises
    ------
    InvalidInput
        If the file cannot be read or is no table, or a line has more cells than the header.
    """
    try:
        text, mark = _decoded(_bytes(path), path)
    except OSError as error:
        raise InvalidInput(f"cannot read {str(path)!r}: {error.strerror}") from None
    ended = _LINE_END.search(text)
    hint = _HINT.match(text)
    delimiter = hint[1] if hint else _delimiter(text, {plain(each) for each in known})
    lines = list(_lines(text[hint.end() :] if hint else text, delimiter, path, 2 if hint else 1))
    header = _header(lines, delimiter, path)
    full = (tuple([*line, *[""] * len(header)][: len(header)]) for _, line in lines[1:])
    numbers = tuple(number for number, _ in lines[1:])
    return Sheet(path.name, tuple(header), tuple(full), numbers, Dialect(delimiter, ended[0] if ended else "\n", mark))


def _header(lines: Sequence[tuple[int, list[str]]], delimiter: str, path: Path) -> list[str]:
    """The first line without empty cells at its end, after a look at whether the others fit below it."""
    _, header = lines[0] if lines else (0, [])
    if len(lines) * len(header) > MOST_CELLS:
        raise InvalidInput(
            f"{str(path)!r} has {len(lines)} lines of {len(header)} cells: it is not the table that is meant"
        )
    while header and not header[-1].strip():
        header = header[:-1]
    for number, line in lines[1:]:
        if any(each.strip() for each in line[len(header) :]):
            raise InvalidInput(
                f"line {number} of {str(path)!r} has {len(line)} cells, and the header, which begins with"
                f" {header[0]!r}, has {len(header)}. A cell that contains {delimiter!r} must be in quotes."
            )
    return header


def read_text(path: Path) -> str:
    """The text of a file; raises `OSError` if there is none, and `InvalidInput` if it is no text."""
    return _decoded(_bytes(path), path)[0]


def number_in(text: str) -> float | None:
    """The number that a cell holds, with a decimal point or comma; None if it is no number."""
    bare = text.strip()
    return float(bare.replace(",", ".")) if _NUMBER.fullmatch(bare) else None


def plain(text: str) -> str:
    """A name or number in one spelling: no accents, no case, single spaces."""
    bare = "".join(each for each in unicodedata.normalize("NFKD", text) if not unicodedata.combining(each))
    return " ".join(bare.casefold().split())


def _bytes(path: Path) -> bytes:
    with open(path, "rb") as file:
        raw = file.read(MOST_BYTES + 1)
    if len(raw) > MOST_BYTES:
        raise InvalidInput(f"{str(path)!r} has more than {MOST_BYTES / 2**20:.0f} MB: it is not the file that is meant")
    return raw


def _decoded(raw: bytes, path: Path) -> tuple[str, str]:
    """A text, and the byte-order mark with which the program that saved it reads UTF-8 again."""
    for start, kind in _NO_TEXT.items():
        if raw.startswith(start):
            raise InvalidInput(f"{str(path)!r} is {kind} and no text: save the table as CSV (UTF-8)")
    encoding = utf_16(raw) or "utf-8"
    for each in (encoding, "cp1252"):
        try:
            text = raw.decode(each)
        except UnicodeDecodeError:
            continue
        if "\0" not in text:
            bare = text.removeprefix(BYTE_ORDER_MARK)
            return bare, "" if each == "utf-8" and bare == text else BYTE_ORDER_MARK
    raise InvalidInput(f"{str(path)!r} is neither UTF-8 nor UTF-16 nor Windows-1252 text: save it as UTF-8")


def _delimiter(text: str, known: Collection[str]) -> str:
    """The delimiter that shows most of the known headings, or else most cells, in the first line."""

    def found(delimiter: str) -> tuple[int, int]:
        try:
            header = next(_records(text, delimiter), (0, []))[1]
        except csv.Error:
            return -1, 0
        return len({plain(each) for each in header} & set(known)), len(header)

    return max(_DELIMITERS, key=found)


def _lines(text: str, delimiter: str, path: Path, first: int) -> Iterator[tuple[int, list[str]]]:
    try:
        for number, line in _records(text, delimiter):
            yield number + first, line
    except csv.Error as error:
        raise InvalidInput(f"{str(path)!r} is no CSV file: {error}") from None


def _records(text: str, delimiter: str) -> Iterator[tuple[int, list[str]]]:
    """The lines that are not blank, each with the number of the line on which it begins, from 0."""
    reader, begins = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter, strict=True), 0
    for line in reader:
        if any(each.strip() for each in line):
            yield begins, line
        begins = reader.line_num
