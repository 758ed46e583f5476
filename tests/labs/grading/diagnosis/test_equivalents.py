"""No false accusation: what is right in other words is right, and no mistake is named."""

from __future__ import annotations

import ast
import functools
import importlib
import inspect
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from labs.grading.diagnosis.probes import probed
from labs.grading.diagnosis.recognition import diagnose
from labs.grading.diagnosis.words import told
from reference import lecture
from solutions import checks

ALTERNATIVES = Path(__file__).parents[3] / "autograder" / "alternatives"
NAMES = [entry.name for entry in probed()]


class Rewriting(ast.NodeTransformer):
    """One way of saying the same in other words."""

    def __init__(self, kind):
        self.kind = kind

    def visit_BinOp(self, node):
        self.generic_visit(node)
        a, b, op = node.left, node.right, type(node.op)
        if self.kind == "commuted" and op in (ast.Add, ast.Mult):
            return ast.BinOp(b, node.op, a)
        if self.kind == "regrouped" and op in (ast.Add, ast.Mult) and isinstance(a, ast.BinOp) and type(a.op) is op:
            return ast.BinOp(a.left, op(), ast.BinOp(a.right, op(), b))
        if self.kind == "differences turned" and op is ast.Sub:
            return ast.UnaryOp(ast.USub(), ast.BinOp(b, ast.Sub(), a))
        if self.kind == "quotients as products" and op is ast.Div:
            return ast.BinOp(a, ast.Mult(), ast.BinOp(ast.Constant(1.0), ast.Div(), b))
        if self.kind == "squares multiplied" and op is ast.Pow and getattr(b, "value", 0) == 2:
            return ast.BinOp(a, ast.Mult(), a)
        return node

    def visit_Compare(self, node):
        self.generic_visit(node)
        turned = {ast.Lt: ast.Gt, ast.Gt: ast.Lt, ast.LtE: ast.GtE, ast.GtE: ast.LtE}
        if self.kind == "comparisons turned" and len(node.ops) == 1 and type(node.ops[0]) in turned:
            return ast.Compare(node.comparators[0], [turned[type(node.ops[0])]()], [node.left])
        return node

    def visit_Call(self, node):
        self.generic_visit(node)
        if any(isinstance(argument, ast.Starred) for argument in node.args):
            return node
        text = {name: f"({ast.unparse(value)})" for name, value in zip("abc", node.args, strict=False)}
        form = FORMS.get((self.kind, ast.unparse(node.func)))
        keeps = next((keyword for keyword in node.keywords if keyword.arg == "keepdims"), None)
        if form and "{k}" in form:
            text["k"] = f", keepdims={ast.unparse(keeps.value)}" if keeps else ""
        return ast.parse(form.format(**text), mode="eval").body if form else node

    def visit_keyword(self, node):
        self.generic_visit(node)
        if self.kind == "single precision" and node.arg == "dtype" and getattr(node.value, "id", "") == "float":
            node.value = ast.parse("np.float32", mode="eval").body
        return node


FORMS = {
    ("sums", "np.vecdot"): "np.sum({a} * {b}, axis=-1)",
    ("sums", "np.matvec"): "np.sum({a} * {b}[..., None, :], axis=-1)",
    ("einsum", "np.vecdot"): "np.einsum('...i,...i->...', {a}, {b})",
    ("einsum", "np.matvec"): "({a} @ {b}[..., None])[..., 0]",
    ("roots", "np.linalg.norm"): "np.sqrt(np.sum(np.square({a}), axis=-1{k}))",
    ("branches turned", "np.where"): "np.where(np.logical_not({a}), {c}, {b})",
    ("branches turned", "np.minimum"): "-np.maximum(-({a}), -({b}))",
    ("branches turned", "np.maximum"): "np.where({a} > {b}, {a}, {b})",
    ("cross products turned", "np.cross"): "-np.cross({b}, {a})",
}
KINDS = (
    *("commuted", "regrouped", "differences turned", "quotients as products", "squares multiplied"),
    *("comparisons turned", "sums", "einsum", "roots", "branches turned", "cross products turned", "single precision"),
)


EACH_IN_ONE_HALF = tuple(tuple(kind for kind in KINDS if kind != "single precision")[at::2] for at in (0, 1))
"""Two halves: what two rewritings make right together shows where only one of them is made."""


@functools.cache
def rewritten(module, kinds):
    """A module of the solutions in other words."""
    tree = ast.parse(inspect.getsource(module))
    for kind in kinds:
        tree = ast.fix_missing_locations(Rewriting(kind).visit(tree))
    made = ModuleType("rewritten")
    sys.modules["rewritten"] = made  # a named tuple looks itself up there
    exec(compile(ast.unparse(tree), "rewritten", "exec"), made.__dict__)
    return made


def said_otherwise(name, kinds):
    topic = next(entry.topic for entry in probed() if entry.name == name)
    original = getattr(importlib.import_module(f"solutions.{topic}"), name)
    function = getattr(rewritten(sys.modules[original.__module__], kinds), name)
    return lambda _, *arguments: function(*arguments)


@pytest.fixture
def single_precision(monkeypatch):
    """The checks of what enters keep single precision too."""
    for entry in probed():  # a topic that is imported meanwhile would keep these checks for ever
        importlib.import_module(f"solutions.{entry.topic}")
    narrow = rewritten(checks, ("single precision",))
    for name in ("positive", "not_negative", "in_unit_interval", "finite", "vector", "matrix", "unit"):
        for module in [module for key, module in sys.modules.items() if key.startswith("solutions")]:
            if hasattr(module, name):
                monkeypatch.setattr(module, name, getattr(narrow, name))


def is_right(name, kinds):
    diagnosis = diagnose(name, said_otherwise(name, kinds))
    assert diagnosis.right, told(diagnosis)


def some(names, start, step):
    """All functions as parameters; those that are not in the sample are slow."""
    sample = names[start::step]
    return [pytest.param(name, marks=() if name in sample else pytest.mark.slow) for name in names]


@pytest.mark.parametrize("name", some(NAMES, 0, 8))
def test_a_solution_in_other_words_is_right(name):
    is_right(name, tuple(kind for kind in KINDS if kind not in ("sums", "single precision")))


@pytest.mark.slow
def test_a_solution_with_sums_for_scalar_products_is_right():
    is_right("normal_velocity", ("sums",))


@pytest.mark.weekly
@pytest.mark.parametrize("name", NAMES)
def test_a_solution_in_half_of_the_other_wordings_is_right(name):
    for kinds in EACH_IN_ONE_HALF:
        is_right(name, kinds)


EXACT = ("inside_by_parity",)
"""Decides on which side of an edge a point is, without rounding: rounded to single precision it is another point."""


@pytest.mark.slow
@pytest.mark.usefixtures("single_precision")
@pytest.mark.parametrize("name", [name for name in NAMES if name not in EXACT])
def test_a_solution_in_single_precision_is_right(name):
    is_right(name, ("single precision",))


# Written by hand


def alternatives():
    return sorted(ALTERNATIVES.glob("*.py"))


def handed_in(path):
    space = {}
    exec(compile(path.read_text(encoding="utf-8"), path, "exec"), space)
    return space


WRITTEN = {path.stem: handed_in(path) for path in alternatives()}
BY_HAND = [name for name in NAMES if any(name in space for space in WRITTEN.values())]


@pytest.mark.parametrize("name", some(BY_HAND, 1, 6))
def test_answers_by_hand_are_right(name):
    for file, space in WRITTEN.items():
        if name in space:
            diagnosis = diagnose(name, lambda name, *arguments, space=space: space[name](*arguments))
            assert diagnosis.verdict in ("right", "one at a time" if file == "single" else "right"), told(diagnosis)
            assert not diagnosis.mistakes, file
            assert not diagnosis.changes_input, file


def test_each_file_by_hand_answers_ten_functions_or_more():
    assert WRITTEN.keys() == {"algebra", "loops", "single"}
    assert all(sum(name in space for name in NAMES) >= 10 for space in WRITTEN.values())


def nested(value):
    return [nested(part) for part in value] if isinstance(value, tuple) else np.asarray(value).tolist()


def narrow(value):
    return tuple(narrow(part) for part in value) if isinstance(value, tuple) else np.asarray(value, dtype=np.float32)


@pytest.mark.parametrize("name", some(NAMES, 0, 12))
def test_answers_in_lists_or_single_precision_are_right(name):
    right = getattr(importlib.import_module(f"solutions.{lecture.function(name).topic}"), name)
    for form in (nested, narrow):
        diagnosis = diagnose(name, lambda _, *given, form=form: form(right(*given)))
        assert diagnosis.right, f"{form.__name__}: {told(diagnosis)}"
