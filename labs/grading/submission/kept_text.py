"""Cuts a file down to the pieces that some functions need; all other lines stay as empty lines."""

from __future__ import annotations

import ast

from labs.grading.submission.cells import Cell
from labs.grading.submission.complaints import Located
from labs.grading.submission.slicing import needed
from labs.grading.submission.statements import Group


def kept_pieces(pieces: list[Located], functions: list[str]) -> list[Located]:
    """The pieces that the functions need, in order."""
    made_for_it = _in_cells_made_for(pieces, functions)
    counting = [piece for piece in pieces if not _outdone(piece, made_for_it)]
    return [counting[at] for at in sorted(needed([piece.group for piece in counting], functions))]


def assembled(cells: list[Cell], sources: list[str], kept: list[Located]) -> tuple[str, tuple[tuple[int, int], ...]]:
    """The text of the kept pieces, with all other lines empty, and where each code cell starts in it."""
    of_cells: dict[int, list[Group]] = {}
    for piece in kept:
        of_cells.setdefault(id(piece.cell), []).append(piece.group)
    lines: list[str] = []
    starts = []
    for cell, source in zip(cells, sources, strict=True):
        if cell.number is not None:
            starts.append((len(lines), cell.number))
        lines += _only(source, of_cells.get(id(cell), []))
    return "\n".join(lines).rstrip("\n") + "\n", tuple(starts)


def _in_cells_made_for(pieces: list[Located], functions: list[str]) -> dict[str, Located]:
    """The functions that are defined in a cell made for them, each with the definition that counts."""
    return {name: piece for piece in pieces for name in piece.group.defines & set(functions) if name in piece.cell.tags}


def _outdone(piece: Located, made_for_it: dict[str, Located]) -> bool:
    """Whether it is only another definition of a function that has a cell made for it."""
    alone = len(piece.group.statements) == 1 and isinstance(piece.group.statements[0], ast.FunctionDef)
    return alone and any(name not in piece.cell.tags for name in piece.group.defines & made_for_it.keys())


def _only(source: str, kept: list[Group]) -> list[str]:
    """The source's lines, empty except for those of the kept groups, and without a backslash behind a last one."""
    lines = source.split("\n")
    wanted = {number for group in kept for number in range(group.first, group.last + 1)}
    for group in kept:
        lines[group.last - 1] = lines[group.last - 1].rstrip().removesuffix("\\")
    return [line if number in wanted else "" for number, line in enumerate(lines, start=1)]
