"""Which version of a function is in use, where a lab has it written several times: first for simpler cases, then whole.

The whole version begins as a stub, which says that the function is yours to write again. Versions are told apart by
their descriptions, because a cell may be run again at any time.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from labs.grading.submission.magics import without_magics
from labs.grading.submission.stubs import AGAIN, is_open_version, is_stub, says


def earlier_versions(cells: Sequence[str]) -> dict[str, str]:
    """Functions of which an earlier version is in use although the stub of the whole one was run: why, in a sentence.

    cells: those that were run, the n-th is In [n].
    """
    every: dict[str, list[tuple[int, ast.FunctionDef]]] = {}
    for number, cell in enumerate(cells, start=1):
        for function in _functions(cell):
            every.setdefault(function.name, []).append((number, function))
    said = {name: _said(name, versions) for name, versions in every.items()}
    return {name: sentence for name, sentence in said.items() if sentence}


def _said(name: str, versions: Sequence[tuple[int, ast.FunctionDef]]) -> str:
    """Why an earlier version is in use; empty if none is."""
    stubs = [(number, ast.get_docstring(each)) for number, each in versions if _is_to_do_again(each)]
    written = [(number, ast.get_docstring(each)) for number, each in versions if not _is_open(each)]
    if not stubs or not written:
        return ""
    begun, contract = stubs[0]
    number, description = written[-1]
    described = {text for at, text in written if at < begun and text}
    if number > begun and (description not in described or description == contract):
        return ""
    if any(text == contract for _, text in written):
        return f"{name}: the earlier version in cell [{number}] is in use, because that cell was run last."
    return f"{name}: the version in cell [{number}] is in use, because the last one is not written yet."


def _functions(cell: str) -> Iterator[ast.FunctionDef]:
    try:
        statements = ast.parse(without_magics(cell)).body
    except (SyntaxError, ValueError):
        return
    yield from (each for each in statements if isinstance(each, ast.FunctionDef))


def _is_open(function: ast.FunctionDef) -> bool:
    return is_stub(function) or is_open_version(function)


def _is_to_do_again(function: ast.FunctionDef) -> bool:
    return _is_open(function) and says(function.body[-1], AGAIN)
