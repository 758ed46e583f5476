"""What can be wrong in an expression: each operator has a name and gives the wrong expressions for a right one.

An operator is a function of a node of the syntax tree. It gives pairs: what was done, in words, and the node to put in
its place. The functions that wrong expressions and loops call, such as `without`, are at the end of this file.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator

import numpy as np

Wrong = Iterator[tuple[str, ast.expr]]
AXES = range(3)
BOUNDARY = {ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt}
REVERSED = {ast.Lt: ast.Gt, ast.LtE: ast.GtE, ast.Gt: ast.Lt, ast.GtE: ast.LtE, ast.Eq: ast.NotEq}
OTHER_FUNCTIONS = {
    "np.minimum": ("np.maximum",), "np.maximum": ("np.minimum",), "np.floor": ("np.ceil", "np.round"),
    "np.arctan": ("np.tan", "np.sin", "np.cos"), "np.max": ("np.min",),
}  # fmt: skip
TWINS = (("a", "b"), ("COLLIDING", "SEPARATING"), ("s0", "s1"), ("time_at_front", "time_at_back"), ("start", "end"),
         ("first", "last"), ("rebound", "slowing"), ("press", "press_rate"), ("force", "force_rate"),
         ("along", "along_rate"), ("slides", "lifts"), ("grip", "slip"), ("before", "dt"), ("before", "time_of_impact"),
         ("x", "y"), ("velocity", "angular_velocity"), ("velocity", "plane_velocity"), ("velocity", "spin"),
         ("momentum", "angular_momentum"), ("v", "w"), ("remaining", "dt"), ("remaining", "time_to_wall"),
         ("dt", "duration"), ("x", "wall"))  # fmt: skip
"""Names that are mistaken for one another, besides those that differ in their ending alone."""
ENDINGS = (("_a", "_b"), ("_0", "_1"), ("_x", "_y"), ("_static", "_kinetic"))
BEGINNINGS = (("static_", "kinetic_"),)


def text(node: ast.AST) -> str:
    """The source of a node."""
    return ast.unparse(node)


def made(form: str, **parts: ast.AST) -> ast.expr:
    """The expression of a form such as `{a} / {b}`."""
    put = {name: f"({text(part)})" for name, part in parts.items()}
    return ast.parse(form.format(**put), mode="eval").body


def several(name: str, forms: tuple[str, ...], **parts: ast.AST) -> Wrong:
    """One mutant for each form."""
    for form in forms:
        yield name, made(form, **parts)


def sums(node: ast.expr) -> Wrong:
    """A term dropped, a sign flipped, a difference turned round."""
    match node:
        case ast.BinOp(a, ast.Add(), b):
            yield from several("term dropped", ("{a}", "{b}"), a=a, b=b)
            yield from several("sign flipped", ("{a} - {b}", "-{a} + {b}"), a=a, b=b)
        case ast.BinOp(a, ast.Sub(), b):
            yield from several("term dropped", ("{a}", "-{b}"), a=a, b=b)
            yield from several("sign flipped", ("{a} + {b}", "{b} - {a}"), a=a, b=b)
        case ast.UnaryOp(ast.USub(), a) if not isinstance(a, ast.Constant):
            yield "sign flipped", a


def sizes(node: ast.expr) -> Wrong:
    """The absolute value of one term of a sum or a difference."""
    match node:
        case ast.BinOp(a, (ast.Add() | ast.Sub()) as op, b):
            sign = "+" if isinstance(op, ast.Add) else "-"
            for form, term in ((f"np.abs({{a}}) {sign} {{b}}", a), (f"{{a}} {sign} np.abs({{b}})", b)):
                if _may_be_negative(term):
                    yield "size for it", made(form, a=a, b=b)


def sizes_returned(node: ast.expr) -> Wrong:
    """The absolute value of what a function returns, of one result at a time."""
    if isinstance(node, ast.Tuple):
        for at, part in enumerate(node.elts):
            for name, other in sizes_returned(part):
                yield name, ast.Tuple([*node.elts[:at], other, *node.elts[at + 1 :]], ast.Load())
    elif _may_be_negative(node):
        yield "size for it", made("np.abs({a})", a=node)


def _may_be_negative(node: ast.expr) -> bool:
    """Whether a node is anything but a positive constant, a comparison, a square or a root."""
    match node:
        case ast.Constant() | ast.Compare() | ast.BinOp(_, ast.Pow(), ast.Constant(2)):
            return False
        case ast.Call(function, [argument, *_]):
            return text(function) != "np.sqrt" and (text(function) != "np.asarray" or _may_be_negative(argument))
    return True


def products(node: ast.expr) -> Wrong:
    """A factor forgotten, a ratio inverted, a square or a root forgotten."""
    match node:
        case ast.BinOp(a, ast.Mult(), b):
            yield from several("factor forgotten", ("{a}", "{b}"), a=a, b=b)
            yield from several("ratio for product", ("{a} / {b}", "{b} / {a}"), a=a, b=b)
        case ast.BinOp(a, ast.Div(), b):
            yield from several("factor forgotten", ("{a}", "1 / {b}"), a=a, b=b)
            yield "ratio inverted", made("{b} / {a}", a=a, b=b)
            yield "product for ratio", made("{a} * {b}", a=a, b=b)
        case ast.BinOp(a, ast.MatMult(), b):
            yield from several("factor forgotten", ("{a}", "{b}"), a=a, b=b)
            yield "product turned round", made("{b} @ {a}", a=a, b=b)
            yield "transposed", made("transposed({a}) @ {b}", a=a, b=b)
            yield "only the diagonal", made("diagonal({a}) @ {b}", a=a, b=b)
        case ast.BinOp(a, ast.Pow(), ast.Constant(2)):
            yield "square forgotten", a
        case ast.Constant(float() | int() as value) if value and not isinstance(value, bool):
            yield "twice the number", ast.Constant(2 * value)
            yield "half the number", ast.Constant(value / 2)


def conditions(node: ast.expr) -> Wrong:
    """A boundary on the other side, a comparison turned round, a condition dropped."""
    match node:
        case ast.Compare(a, [op], [b]) if type(op) in REVERSED:
            for name, table in (("boundary", BOUNDARY), ("comparison turned round", REVERSED)):
                if type(op) in table:
                    yield name, ast.Compare(a, [table[type(op)]()], [b])
            yield from several("condition dropped", ("always({c})", "never({c})"), c=node)
        case ast.BinOp(a, (ast.BitAnd() | ast.BitOr()) as op, b):
            yield from several("condition dropped", ("{a}", "{b}"), a=a, b=b)
            yield "and for or", ast.BinOp(a, ast.BitOr() if isinstance(op, ast.BitAnd) else ast.BitAnd(), b)
        case ast.BoolOp(op, values) if not any(isinstance(each, ast.Constant) for each in values):
            for at in range(len(values)):
                rest = [*values[:at], *values[at + 1 :]]
                yield "condition dropped", ast.BoolOp(op, rest) if len(rest) > 1 else rest[0]
        case ast.IfExp(_, a, b):
            yield from several("branch dropped", ("{a}", "{b}"), a=a, b=b)


def calls(node: ast.expr) -> Wrong:
    """A branch, an argument, an axis or a root left out; another function of the kind; operands turned round."""
    if not isinstance(node, ast.Call) or any(isinstance(each, ast.Starred) for each in node.args):
        return
    name, given = text(node.func), node.args
    for other in OTHER_FUNCTIONS.get(name, ()):
        yield "another function", ast.Call(made(other), given, node.keywords)
    match name, given:
        case "np.where", [c, a, b]:
            yield from several("branch dropped", ("shaped({a}, {c})", "shaped({b}, {c})"), c=c, a=a, b=b)
            yield "branches turned round", made("np.where({c}, {b}, {a})", c=c, a=a, b=b)
        case "np.minimum" | "np.maximum", [a, b]:
            yield from several("limit dropped", ("shaped({a}, {b})", "shaped({b}, {a})"), a=a, b=b)
        case "np.clip", [a, low, high]:
            yield "limit dropped", made("np.minimum({a}, {high})", a=a, high=high)
            yield "limit dropped", made("np.maximum({a}, {low})", a=a, low=low)
        case "quotient", [a, b, *otherwise]:
            rest = "".join(f", {text(each)}" for each in otherwise)
            yield "factor forgotten", a
            yield from several("factor forgotten", (f"quotient(1.0, {{b}}{rest})",), b=b)
            yield from several("ratio inverted", (f"quotient({{b}}, {{a}}{rest})",), a=a, b=b)
            yield from several("product for ratio", ("{a} * {b}",), a=a, b=b)
        case "direction", [a]:
            yield "length kept", a
        case "part_across" | "part_along", [a, _]:
            yield "part forgotten", a
        case "np.abs", [a]:
            yield "size forgotten", a
        case "np.sqrt", [a]:
            yield "root forgotten", a
        case "np.swapaxes", [a, *_]:
            yield "transposed", a
        case "np.linalg.solve", [a, b]:
            yield from several("not solved", ("{b}", "{a} @ {b}"), a=a, b=b)
        case "np.cross", [a, b]:
            yield "cross product turned round", made("np.cross({b}, {a})", a=a, b=b)
            yield "turning left out", made("0 * np.cross({a}, {b})", a=a, b=b)
            for axis in AXES:
                yield f"axis {axis} left out", made(f"np.cross(without({axis}, {{a}}), {{b}})", a=a, b=b)
                yield f"axis {axis} left out", made(f"without({axis}, np.cross({{a}}, {{b}}))", a=a, b=b)
        case "np.vecdot", [a, b]:
            for axis in AXES:
                yield f"axis {axis} left out", made(f"np.vecdot(without({axis}, {{a}}), {{b}})", a=a, b=b)
                yield f"axis {axis} alone", made(f"np.vecdot(alone({axis}, {{a}}), {{b}})", a=a, b=b)
        case "np.matvec", [a, b]:
            yield "transposed", made("np.matvec(transposed({a}), {b})", a=a, b=b)
            yield "only the diagonal", made("np.matvec(diagonal({a}), {b})", a=a, b=b)
        case "np.linalg.norm", [a]:
            yield "largest component", made("np.max(np.abs({a}), {k})".replace("{k}", keywords(node)), a=a)
            yield "sum of components", made("np.sum(np.abs({a}), {k})".replace("{k}", keywords(node)), a=a)
            for axis in AXES:
                form = f"np.linalg.norm(without({axis}, {{a}}), {keywords(node)})"
                yield f"axis {axis} left out", made(form, a=a)
        case "np.sum", [a]:
            for axis in AXES:
                yield f"axis {axis} left out", made(f"np.sum(without({axis}, {{a}}), {keywords(node)})", a=a)


def results(node: ast.expr) -> Wrong:
    """Two results in each other's place."""
    match node:
        case ast.Tuple(parts, ast.Load()):
            for at in range(len(parts) - 1):
                swapped = [*parts[:at], parts[at + 1], parts[at], *parts[at + 2 :]]
                yield "results swapped", ast.Tuple(swapped, ast.Load())


def keywords(node: ast.Call) -> str:
    """The named arguments of a call."""
    return ", ".join(f"{each.arg}={text(each.value)}" for each in node.keywords)


def twins(name: str) -> Iterator[str]:
    """Names that may be mistaken for a name."""
    for pair in TWINS:
        if name in pair:
            yield pair[1 - pair.index(name)]
    for first, second in ENDINGS + ENDINGS_TURNED:
        if name.endswith(first):
            yield name.removesuffix(first) + second
    for first, second in BEGINNINGS + BEGINNINGS_TURNED:
        if name.startswith(first):
            yield second + name.removeprefix(first)


ENDINGS_TURNED = tuple((second, first) for first, second in ENDINGS)
BEGINNINGS_TURNED = tuple((second, first) for first, second in BEGINNINGS)


def mistaken(known: frozenset[str]) -> Callable[[ast.expr], Wrong]:
    """The operator that takes A's value for B's, where both are known."""

    def names(node: ast.expr) -> Wrong:
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
            for other in twins(node.id):
                if other in known:
                    yield "one for the other", ast.Name(other, ast.Load())

    return names


# What wrong expressions call


def shaped(value: object, other: object) -> object:
    """A value alone, in the shape that it had beside another one."""
    return np.broadcast_arrays(np.asarray(value, dtype=float), other)[0]


def always(condition: object) -> object:
    """True for each."""
    return np.ones_like(condition, dtype=bool)


def never(condition: object) -> object:
    """False for each."""
    return np.zeros_like(condition, dtype=bool)


def without(axis: int, vector: object) -> object:
    """Vectors with one component left out."""
    found = np.array(vector, dtype=float)
    if found.ndim and axis < found.shape[-1]:
        found[..., axis] = 0.0
    return found


def alone(axis: int, vector: object) -> object:
    """Vectors with one component alone."""
    return np.asarray(vector, dtype=float) - without(axis, vector)


def transposed(matrix: object) -> object:
    """Matrices with rows for columns."""
    return np.swapaxes(np.asarray(matrix, dtype=float), -1, -2)


def diagonal(matrix: object) -> object:
    """Matrices with nothing beside their diagonal."""
    found = np.asarray(matrix, dtype=float)
    return found * np.eye(*found.shape[-2:])


def rounds() -> Iterator[int]:
    """The rounds of a loop, for a mutant that would never leave it."""
    yield from range(1000)
    raise RuntimeError("the loop does not end")
