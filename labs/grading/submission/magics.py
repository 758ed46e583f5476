"""Takes out of a cell what only a notebook's kernel understands: magics, shell commands, questions, copied prompts.

A line is taken out only if it begins a statement, never inside a bracket or a string. `pass` takes its place, so that
blocks stay whole and every other line keeps its number. Of a cell that was copied with prompts (`>>> `), or from inside
a block, these and the indentation of its first line are taken off each line, as the kernel does.

Threat: a megabyte made to be read again and again. No pattern here looks at a character more than a few times.
"""

from __future__ import annotations

import re

_CELL_MAGIC = re.compile(r"\n*%%[ \t]*(?P<name>[\w!]*)[^\n]*(?:\n|\Z)\n*")
"""A first line that says what becomes of its cell."""
_PYTHON = {"time", "timeit", "capture", "prun", "debug", "code_wrap"}
"""IPython's own that run their cell as Python."""
_NOT_PYTHON = {
    "", "!", "HTML", "SVG", "bash", "cmd", "file", "html", "javascript", "js", "latex", "markdown", "perl", "pypy",
    "python", "python2", "python3", "ruby", "script", "sh", "svg", "sx", "system", "writefile",
}  # fmt: skip
"""IPython's own that do something else with it. Any other one comes from elsewhere, as pyinstrument, memit and R do."""
_FUNCTION = re.compile(r"^def[ \t]+\w+[ \t]*\(", re.MULTILINE)
_START = re.compile(r"\n*(?P<indent>[ \t]*)(?P<prompt>>>>(?: |$))?", re.MULTILINE)
_PROMPT = re.compile(r"^[ \t]*(?:>>>|\.\.\.)(?: |$)", re.MULTILINE)
_MAGIC = re.compile(
    r"""[ \t]*(?:
        [%!?].*                                # %matplotlib inline, !pip install, ?name
      | [\w.]+\?{1,2}[ \t]*                    # name?
      | [\w.][\w., \t]*=[ \t]*[%!](?!=).*     # files = !ls
    )$""",
    re.VERBOSE | re.MULTILINE,
)
TOKEN = re.compile(
    r"""
    (?P<long>'''|\"\"\")(?:\\.|(?!(?P=long)).)*(?:(?P=long)|\Z)
  | '(?:\\.|[^'\\\n])*'? | "(?:\\.|[^"\\\n])*"?    # one that does not end goes to the end of its line
  | \#[^\n]* | \\\n | (?P<open>[(\[{]) | (?P<close>[)\]}]) | (?P<end>\n)
    """,
    re.VERBOSE | re.DOTALL,
)


def without_magics(source: str) -> str:
    """The cell's Python; empty if its first line says that the cell is in another language, or goes elsewhere.

    A magic that is not IPython's own is taken for one that runs its cell as Python if the cell defines a function.
    """
    source = _at_the_margin(source)
    at = 0
    while found := _CELL_MAGIC.match(source, at):
        if not _runs_python(found, source):
            return ""
        at = found.end()
    parts = ["\n" * source.count("\n", 0, at)]
    while at < len(source):
        end = _end_of_line(source, at) if _MAGIC.match(source, at) else 0
        if end:
            line = source[at:end]
            indent = line[: len(line) - len(line.lstrip())]
            parts.append(f"{indent}pass" + "\n" * line.count("\n"))
        else:
            end = _end_of_statement(source, at)
            parts.append(source[at:end])
        at = end
    return "".join(parts)


def cell_magic(source: str) -> str:
    """The first line of a cell that keeps its code from being run in the notebook; empty if there is none."""
    found = _CELL_MAGIC.match(source)
    return found[0].strip() if found and not _runs_python(found, source) else ""


def _runs_python(magic: re.Match[str], source: str) -> bool:
    if magic["name"] in _PYTHON:
        return True
    return magic["name"] not in _NOT_PYTHON and _FUNCTION.search(source, magic.end()) is not None


def _at_the_margin(source: str) -> str:
    """The cell without prompts, if it begins with one, and without the indentation of its first line."""
    start = _START.match(source)
    if start and start["prompt"]:
        return _PROMPT.sub("", source)
    indent = start["indent"] if start else ""
    return "\n".join(line.removeprefix(indent) for line in source.split("\n")) if indent else source


def _end_of_line(source: str, at: int) -> int:
    """Where a magic ends: after its line and those that a backslash joins to it."""
    while True:
        end = source.find("\n", at)
        if end < 0:
            return len(source)
        if source[end - 1] != "\\":
            return end + 1
        at = end + 1


def _end_of_statement(source: str, at: int) -> int:
    """Where a logical line ends: all its brackets and strings are closed."""
    depth = 0
    for token in TOKEN.finditer(source, at):
        depth += (token["open"] is not None) - (token["close"] is not None)
        if token["end"] and depth <= 0:
            return token.end()
    return len(source)
