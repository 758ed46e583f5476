"""Expressions such as `-(1 + e) * u / k`: read from text, and evaluated at numbers without running any code.

An expression may hold numbers, the named quantities, + - * / **, brackets, and the functions below. Everything else is
refused in words. Underscores in a name make no difference: s_0 is s0. Values are NumPy floats, so that a large power
gives infinity instead of taking for ever, and the root of a negative number gives NaN.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reference.errors import InvalidInput, UnknownName

Values = NDArray[np.float64]
LONGEST = 500
"""Characters of the longest expression."""
_TOO_LARGE = 1e300
_ONE: dict[str, Callable[..., Any]] = {"sqrt": np.sqrt, "sin": np.sin, "cos": np.cos, "log": np.log, "abs": np.abs}
_SEVERAL: dict[str, Any] = {"min": np.minimum, "max": np.maximum}
FUNCTIONS = (*_ONE, *_SEVERAL)
_BINARY: dict[type, Callable[..., Any]] = {
    ast.Add: np.add,
    ast.Sub: np.subtract,
    ast.Mult: np.multiply,
    ast.Div: np.divide,
    ast.Pow: np.power,
}
_SIGN: dict[type, Callable[..., Any]] = {ast.USub: np.negative, ast.UAdd: np.positive}
UNDERSTOOD = f"+ - * / **, brackets, {', '.join(FUNCTIONS)}"


@dataclass(frozen=True)
class Expression:
    """An expression that was read. text: as it was written. names: the quantities that it uses."""

    text: str
    names: frozenset[str]
    tree: ast.expr

    def at(self, values: Mapping[str, Values]) -> Values:
        """Its values where the quantities have these; NaN or infinity where it has none."""
        shape = np.shape(next(iter(values.values()), 0.0))
        with np.errstate(all="ignore"):
            return np.broadcast_to(np.asarray(_value(self.tree, values), dtype=float), shape)


def expression(text: str, quantities: Collection[str]) -> Expression:
    """Read an expression in named quantities.

    Raises
    ------
    InvalidInput, UnknownName
        If it is no expression, holds anything but what is listed above, or names an unknown quantity.
    """
    text = text.strip()
    if len(text) > LONGEST:
        raise InvalidInput(f"the line has {len(text)} characters; {LONGEST} are enough for any line here")
    try:
        tree = ast.parse(text.replace("−", "-"), mode="eval").body
    except (SyntaxError, ValueError):
        if text.count("(") != text.count(")"):
            raise InvalidInput(f"“{text}” cannot be read: it has not as many ) as (") from None
        raise InvalidInput(
            f"“{text}” cannot be read: is something missing, or a product without *, or a power without **?"
        ) from None
    except (RecursionError, MemoryError):
        raise InvalidInput("the line is nested too deeply") from None
    _spell_as(quantities, tree)
    try:
        return Expression(text, frozenset(_names(tree, quantities)), tree)
    except RecursionError:
        raise InvalidInput("the line is nested too deeply") from None


def _spell_as(quantities: Collection[str], tree: ast.expr) -> None:
    """Write the names of a tree as the quantities are written that differ from them in underscores alone."""
    spelled = {name.replace("_", ""): name for name in quantities}
    for node in ast.walk(tree):
        if isinstance(node, ast.Name) and node.id not in quantities:
            node.id = spelled.get(node.id.replace("_", ""), node.id)


def _names(node: ast.expr, quantities: Collection[str]) -> list[str]:
    """The quantities in an expression; raises if it holds anything that is not allowed."""
    match node:
        case ast.Constant(value=bool()):
            pass
        case ast.Constant(value=int() | float() as number) if abs(number) < _TOO_LARGE:
            return []
        case ast.Name(id=name):
            if name not in quantities:
                raise UnknownName("quantity", name, list(quantities))
            return [name]
        case ast.UnaryOp(op=op, operand=operand) if type(op) in _SIGN:
            return _names(operand, quantities)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _BINARY:
            return _names(left, quantities) + _names(right, quantities)
        case ast.BinOp(op=ast.BitXor()):
            raise InvalidInput("^ is no power in Python: write ** for it")
        case ast.Call(func=ast.Name(id=name), args=arguments, keywords=[]) if name in FUNCTIONS:
            if len(arguments) != 1 if name in _ONE else len(arguments) < 2:
                raise InvalidInput(f"{name} takes {'one value' if name in _ONE else 'two values or more'}")
            return [each for argument in arguments for each in _names(argument, quantities)]
        case ast.Call(func=ast.Name(id=name)) if name in quantities:
            raise InvalidInput(f"a * is missing between {name} and the bracket behind it")
        case ast.Call(func=ast.Constant() | ast.BinOp()):
            raise InvalidInput("a * is missing before a bracket")
    raise InvalidInput(f"“{ast.unparse(node)}” is not understood here: a line may hold numbers, {UNDERSTOOD}")


def _value(node: ast.expr, values: Mapping[str, Values]) -> Any:
    match node:
        case ast.Name(id=name):
            return values[name]
        case ast.UnaryOp(op=op, operand=operand):
            return _SIGN[type(op)](_value(operand, values))
        case ast.BinOp(left=left, op=op, right=right):
            return _BINARY[type(op)](_value(left, values), _value(right, values))
        case ast.Call(func=ast.Name(id=name), args=arguments):
            found = [_value(argument, values) for argument in arguments]
            if name in _ONE:
                return _ONE[name](found[0])
            first, *others = found
            for other in others:
                first = _SEVERAL[name](first, other)
            return first
        case ast.Constant(value=int() | float() as number):
            return np.float64(number)
    raise AssertionError(node)  # _names lets nothing else through
