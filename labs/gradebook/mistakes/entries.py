"""Mistakes with a title and a hint in a TOML file, as a course writes them.

    [normal_velocity-7K3Q]
    title = "Both spins are turned round"
    help = "Which way does a point move that lies above the centre?"
    function = "normal_velocity"
    numbers = "3f2a9c -2.96, 77aa01 none"

A person writes the title and the help. The program writes the rest, by which it recognises the mistake again.
"""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from labs.gradebook.mistakes.same_numbers import Numbers
from labs.gradebook.sheets import read_text
from labs.grading.diagnosis.probes import probed
from reference import lecture
from reference.errors import InvalidInput, UnknownName

FIELDS = ("title", "help", "function", "numbers")
LONGEST = 1000
"""Characters of a title or a help."""


@dataclass(frozen=True)
class Entry:
    """A mistake of a course. title: what is wrong, and help: a hint; both empty as long as nobody has written them.

    where: its line and its file, for messages.
    """

    id: str
    numbers: Numbers
    title: str = ""
    help: str = ""
    where: str = field(default="", compare=False)

    @property
    def function(self) -> str:
        """Which function is wrong."""
        return self.numbers.function

    @property
    def topic(self) -> str:
        """The lab of that function."""
        return lecture.function(self.function).topic

    def text(self) -> str:
        """The entry as a file has it."""
        fields = {"title": self.title, "help": self.help, "function": self.function, "numbers": self.numbers.text()}
        return f"[{self.id}]\n" + "".join(f"{name} = {_quoted(value)}\n" for name, value in fields.items())


def _quoted(text: str) -> str:
    """A string as TOML writes it: as JSON does, except for the one control character that JSON leaves as it is."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def read_entries(path: Path) -> list[Entry]:
    """The entries of a file, in its order; none if there is no file.

    Raises
    ------
    InvalidInput
        If it cannot be read, or an entry is not as it has to be: the message names the file, the line and the choices.
    """
    return entries_of(text_in(path), path.name)


def text_in(path: Path) -> str:
    """The text of a file; empty if there is none. Raises `InvalidInput` if it cannot be read."""
    try:
        return read_text(path)
    except FileNotFoundError:
        return ""
    except OSError as error:
        raise InvalidInput(f"cannot read {str(path)!r}: {error.strerror}") from None


def entries_of(text: str, name: str) -> list[Entry]:
    """The entries of the text of a file that is called so; raises what `read_entries` raises."""
    try:
        content = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise InvalidInput(f"{name} is no TOML file: {error}") from None
    return [_Table(text, name, id).entry(table) for id, table in content.items()]


@dataclass(frozen=True)
class _Table:
    """One table of a file, and where it is."""

    text: str
    file: str
    id: str

    def entry(self, table: Any) -> Entry:
        if not isinstance(table, dict):
            where = self._at(self.id, below=False)
            raise InvalidInput(f"{where}: {self.id} belongs to no mistake; write it below a [name] in brackets")
        for name in table:
            if name not in FIELDS:
                raise InvalidInput(f"{self._at(name)}: {UnknownName(f'field of [{self.id}]', name, FIELDS)}")
        for name in FIELDS:
            if not isinstance(table.get(name), str):
                said = f"has no {name}" if name not in table else f"has {table[name]!r} as {name}"
                needs = f"it needs a text in quotes for each of {', '.join(FIELDS)}"
                raise InvalidInput(f"{self._at(name)}: [{self.id}] {said}; {needs}")
        title, help = (table[name].strip() for name in ("title", "help"))
        for name, said in (("title", title), ("help", help)):
            if len(said) > LONGEST:
                raise InvalidInput(f"{self._at(name)}: the {name} has {len(said)} characters, more than {LONGEST}")
        return Entry(self.id, self._numbers(table["function"], table["numbers"]), title, help, self._at())

    def _numbers(self, function: str, numbers: str) -> Numbers:
        known = [entry.name for entry in probed()]
        if function not in known:
            raise InvalidInput(f"{self._at('function')}: {UnknownName('function', function, known)}")
        try:
            return Numbers.read(function, numbers)
        except ValueError as error:
            raise InvalidInput(f"{self._at('numbers')}: the numbers of [{self.id}] are wrong: {error}") from None

    def _at(self, field: str = "", below: bool = True) -> str:
        """The line of a field; that of the table's head without one, or if the table lacks it.

        below: whether the field is in the table, not above all tables.
        """
        lines = self.text.splitlines()
        head = re.compile(rf"\s*\[\s*[\"']?{re.escape(self.id)}[\"']?\s*[\].]")
        first = next((at for at, line in enumerate(lines) if head.match(line)), 0) if below else 0
        own = re.compile(rf"\s*[\"']?{re.escape(field)}[\"']?\s*[=.]")
        for at, line in enumerate(lines[first + below :], first + below):
            if field and own.match(line):
                return f"line {at + 1} of {self.file}"
            if below and line.lstrip().startswith("["):
                break
        return f"line {first + 1} of {self.file}"


def text_of(entries: Iterable[Entry]) -> str:
    """Entries as a file has them, an empty line between two."""
    return "\n".join(entry.text() for entry in entries)
