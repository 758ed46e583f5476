"""A student's own code as plain Python, for tools that look for copies: without stubs and without what the lab gives.

Two files that are alike are no proof: a lesson suggests names and an order, and many students make the same mistake.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import TypeVar

from labs.building import lessons
from labs.grading.errors import UnreadableSubmission
from labs.grading.submission.excerpts import Excerpt, TopicExcerpts, text_of
from labs.grading.submission.reading import read
from labs.grading.submission.statements import Group, groups
from labs.grading.submission.stubs import is_stub
from reference import lecture

D = TypeVar("D", Group, Excerpt)


def own_code(path: Path, lab: str) -> str:
    """What a file has of the student's own: the functions of the lab that are written, and helpers of their own.

    Layout, comments and docstrings are left out, since a copy often differs in these alone. Empty if nothing is
    written, or the file cannot be read or written in one layout: Python writes no integer of 5000 digits.
    """
    names = [entry.name for entry in lecture.functions_of(lab) if entry.role == "written"]
    try:
        tree = ast.parse(read(path, names).text)
        own = [node for node in tree.body if not isinstance(node, ast.Import | ast.ImportFrom) and not is_stub(node)]
        texts = [text for text in map(_bare, own) if text not in _given(lab)]
    except (UnreadableSubmission, SyntaxError, ValueError, RecursionError, MemoryError):
        return ""
    return "\n\n\n".join(texts) + "\n" * bool(texts)


def function_in(code: str, name: str) -> str:
    """A function of some code, after the helpers that it uses; without other functions of the lab. Empty if missing.

    Of several definitions of a name the last one counts. What another lab gives to its students is nobody's answer: a
    function with such a name is a helper of the student's own.
    """
    try:
        last = {each: group for group in groups(code) for each in group.defines}
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return ""
    lines = code.splitlines()
    own = lecture.FUNCTIONS.get(name)

    def is_helper(used: str) -> bool:
        other = lecture.FUNCTIONS.get(used)
        return other is None or (own is not None and other.role == "given" and other.topic != own.topic)

    wanted = _with_helpers(last, name, is_helper)
    return "\n\n\n".join("\n".join(lines[group.first - 1 : group.last]) for group in wanted)


@cache
def right_code(name: str) -> str:
    """The solution of a function without its description, after the private helpers that it uses."""
    topic = TopicExcerpts.of(lecture.function(name).topic)
    last = {each: excerpt for excerpt in topic.every for each in excerpt.defines}
    last[name] = topic.defining(name)
    wanted = _with_helpers(last, name, lambda used: used.startswith("_"))
    return "\n\n\n".join(_without_descriptions(excerpt.text) for excerpt in wanted)


def _with_helpers(definitions: Mapping[str, D], name: str, is_helper: Callable[[str], bool]) -> list[D]:
    """The definition of a name, after those of the helpers that it uses directly or through others."""
    waiting, found = [name], dict[str, D]()
    while waiting:
        each = waiting.pop()
        if each in definitions and each not in found:
            found[each] = definitions[each]
            waiting += [used for used in sorted(found[each].uses) if is_helper(used)]
    return list({id(found[each]): found[each] for each in definitions if each in found}.values())


def _without_descriptions(text: str) -> str:
    lines = text.splitlines()
    functions = [node for node in ast.parse(text).body if isinstance(node, ast.FunctionDef)]
    for function in reversed(functions):
        if ast.get_docstring(function) is not None:
            del lines[function.body[0].lineno - 1 : function.body[0].end_lineno]
    return "\n".join(lines)


@cache
def _given(lab: str) -> frozenset[str]:
    """The statements that a lab gives, each in plain form."""
    excerpts = TopicExcerpts.of(lab).needed(lessons.read(lab).given)
    return frozenset(_bare(node) for node in ast.parse(text_of(excerpts)).body)


def _bare(node: ast.stmt) -> str:
    """A statement in one layout, without its docstrings, which are taken out of the node."""
    for each in ast.walk(node):
        if isinstance(each, ast.FunctionDef | ast.ClassDef) and ast.get_docstring(each, clean=False) is not None:
            each.body = each.body[1:] or [ast.Pass()]
    return ast.unparse(ast.Module([node], []))
