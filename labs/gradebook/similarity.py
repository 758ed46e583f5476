"""A student's own code as plain Python, for tools that look for copies: without stubs and without what the lab gives.

Two files that are alike are no proof: a lesson suggests names and an order, and many students make the same mistake.
"""

from __future__ import annotations

import ast
from functools import cache
from pathlib import Path

from labs.building import lessons
from labs.building.excerpts import TopicExcerpts, text_of
from labs.grading.errors import UnreadableSubmission
from labs.grading.submission.reading import read
from labs.grading.submission.stubs import is_stub
from reference import lecture


def own_code(path: Path, lab: str) -> str:
    """What a file has of the student's own: the functions of the lab that are written, and helpers of their own.

    Layout, comments and docstrings are left out, since a copy often differs in these alone. Empty if nothing is written
    or the file cannot be read.
    """
    names = [entry.name for entry in lecture.functions_of(lab) if entry.role == "written"]
    try:
        tree = ast.parse(read(path, names).text)
    except (UnreadableSubmission, SyntaxError, ValueError, RecursionError, MemoryError):
        return ""
    own = [node for node in tree.body if not isinstance(node, ast.Import | ast.ImportFrom) and not is_stub(node)]
    texts = [text for text in map(_bare, own) if text not in _given(lab)]
    return "\n\n\n".join(texts) + "\n" * bool(texts)


@cache
def _given(lab: str) -> frozenset[str]:
    """The statements that a lab gives, each in plain form."""
    excerpts = TopicExcerpts.of(lab).needed(lessons.read(lab).given)
    return frozenset(_bare(node) for node in ast.parse(text_of(excerpts)).body)


def _bare(node: ast.stmt) -> str:
    """A statement without its docstrings, in one layout."""
    bare = ast.parse(ast.unparse(node))
    for each in ast.walk(bare):
        if isinstance(each, ast.FunctionDef | ast.ClassDef) and ast.get_docstring(each) is not None:
            each.body = each.body[1:] or [ast.Pass()]
    return ast.unparse(bare)
