"""An oral kit: three prompts made from a student's own file, each with what a good answer says.

Nothing of the file is run. The functions are chosen by the file's own text, so that the same file gives the same
prompts, and two students with different files rarely the same ones.
"""

from __future__ import annotations

import ast
import copy
import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from labs.grading.submission.reading import read
from labs.grading.submission.stubs import is_stub
from reference import lecture
from reference.errors import InvalidInput

_FLIPPED: dict[type[ast.operator], type[ast.operator]] = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult,
}  # fmt: skip
_DECIDES = ("where", "minimum", "maximum", "clip", "isfinite", "min", "max")
"""Functions by which code decides about a limiting case."""


@dataclass(frozen=True)
class Prompt:
    """One prompt. code: the student's own line that it is about. good: what a full answer holds, a point each."""

    title: str
    question: str
    code: str
    good: tuple[str, ...]


@dataclass(frozen=True)
class _Line:
    """A statement of a student's function."""

    function: str
    statement: ast.stmt

    @property
    def text(self) -> str:
        return ast.unparse(self.statement)

    @property
    def weight(self) -> int:
        """How much arithmetic is in it."""
        return sum(isinstance(node, ast.BinOp | ast.Call) for node in ast.walk(self.statement))


def kit(path: Path, topic: str) -> tuple[Prompt, Prompt, Prompt]:
    """Three prompts about a file's functions of a lab: explain a line, change a line, and a limiting case.

    Raises
    ------
    InvalidInput
        If the file holds fewer than two functions of the lab that do anything, or no arithmetic in them.
    """
    lines = _lines(path, topic)
    functions = sorted({line.function for line in lines})
    if len(functions) < 2:
        raise InvalidInput(f"{path.name} holds too few functions of {topic} for three prompts: write two at least")
    turn = int.from_bytes(hashlib.sha256("".join(line.text for line in lines).encode()).digest()[:4], "big")
    ordered = functions[turn % len(functions) :] + functions[: turn % len(functions)]
    changed = max(
        lines, key=lambda line: (_changed(line) is not None, _is_sum(line), line.weight, -ordered.index(line.function))
    )
    if _changed(changed) is None:
        raise InvalidInput(
            f"{path.name} has no line that adds, subtracts, multiplies or divides: nothing can be changed"
        )
    other = next(name for name in ordered if name != changed.function)
    explained = max((line for line in lines if line.function == other), key=lambda line: line.weight)
    limit = max(lines, key=lambda line: (_decides(line), line.function not in (other, changed.function)))
    return _explain(explained), _change(changed), _limit(limit)


def text(prompts: tuple[Prompt, Prompt, Prompt], name: str) -> str:
    """The kit as Markdown, for the person who asks."""
    parts = [
        f"# Oral questions on {name}",
        "About three minutes each. The student sees the code and not the list below it.",
    ]
    for number, prompt in enumerate(prompts, 1):
        parts += [f"## {number}. {prompt.title}", f"````python\n{prompt.code}\n````", prompt.question]
        parts.append("\n".join(f"- 1 point: {each}" for each in prompt.good))
    return "\n\n".join(parts) + "\n"


def _explain(line: _Line) -> Prompt:
    return Prompt(
        f"Explain a line of {line.function}",
        "What does this line compute, in words and with its unit? Where on the slides does it come from? Which of its"
        " factors would you expect to matter least, and in which scene does it matter after all?",
        line.text,
        (
            "the quantity by its physical name, with its unit, and what each name in the line stands for",
            f"the statement that it puts into code: {_statement(line.function)}",
            "a scene, not a formula, in which the factor decides",
        ),
    )


def _change(line: _Line) -> Prompt:
    changed = _changed(line)
    return Prompt(
        f"One sign or operator changed in {line.function}",
        f"Somebody changes this line to\n\n````python\n{changed}\n````\n\nWithout running it: what would one"
        " see first, and in which scene? Which quantity that should be kept is not kept any more? In which scene would"
        " nobody notice?",
        line.text,
        (
            "the direction of the effect (too large, too small, the wrong way), reasoned from the line",
            "a conserved or measured quantity that shows it",
            "a symmetric scene that hides it, such as equal masses, an arm of zero, or a plane along an axis",
        ),
    )


def _limit(line: _Line) -> Prompt:
    return Prompt(
        f"A limiting case of {line.function}",
        "For which input is this line there? What would the function return without it, and how would a simulation that"
        " uses the function go wrong? If nothing in your function treats a limiting case: name one, and say what it"
        " returns there now.",
        line.text,
        (
            "an input, in numbers, that needs the line, or a limiting case that the function misses",
            "the value without it: a NaN, an infinity, or a number that is plainly wrong",
            "what a step loop would do with that value",
        ),
    )


def _statement(function: str) -> str:
    entry = lecture.statement(lecture.function(function).statement)
    return f"slide {entry.number}, {entry.title.lower()}"


def _lines(path: Path, topic: str) -> list[_Line]:
    names = [entry.name for entry in lecture.functions_of(topic) if entry.role == "written"]
    tree = ast.parse(read(path, names, also=lecture.FUNCTIONS).text)
    found = []
    for node in tree.body:
        if isinstance(node, ast.FunctionDef) and node.name in names and not is_stub(node):
            found += [_Line(node.name, each) for each in _statements(node) if isinstance(each, ast.Assign | ast.Return)]
    return [line for line in found if line.weight]


def _statements(node: ast.AST) -> Iterator[ast.stmt]:
    return (each for each in ast.walk(node) if isinstance(each, ast.stmt) and each is not node)


def _changed(line: _Line) -> str | None:
    """The line with its outermost + or −, or else * or /, turned into the opposite; None where it has neither."""
    statement = copy.deepcopy(line.statement)
    operators = [node for node in ast.walk(statement) if isinstance(node, ast.BinOp) and type(node.op) in _FLIPPED]
    operators.sort(key=lambda node: isinstance(node.op, ast.Mult | ast.Div))
    if not operators:
        return None
    operators[0].op = _FLIPPED[type(operators[0].op)]()
    return ast.unparse(ast.fix_missing_locations(statement))


def _is_sum(line: _Line) -> bool:
    """Whether a line adds or subtracts; in such a line one wrong sign is a mistake that people make."""
    return any(
        isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add | ast.Sub) for node in ast.walk(line.statement)
    )


def _decides(line: _Line) -> int:
    """How many calls and comparisons of a line decide about cases."""
    calls = [node.func for node in ast.walk(line.statement) if isinstance(node, ast.Call)]
    names = [getattr(each, "attr", getattr(each, "id", "")) for each in calls]
    return sum(name in _DECIDES for name in names) + sum(
        isinstance(node, ast.Compare) for node in ast.walk(line.statement)
    )
