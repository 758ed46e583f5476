"""The wire between the grader and the worker: plain values of exact types, as JSON, never pickle.

Threat: everything that arrives was written by untrusted code. A pickle runs its sender's code; a subclass brings its
own `==`, `__float__` or `__array_ufunc__` and can agree with any expected number. So reading a message builds values of
the types below and of no others, whatever the bytes say: None, bool, int, float, str, tuple, list, and NumPy arrays and
scalars of plain dtypes. The sender sends named tuples as tuples and the members of an IntEnum as numbers. It refuses
everything else by the name of its type, so that an honest student learns what was wrong. A message has a limit in
bytes and in parts, as a few megabytes of `[[],[],…` would become a hundred times that in memory; the length comes first
and is checked before anything is read.

Numbers arrive bit by bit as they were sent: a NaN keeps its payload, −0.0 its sign, an array its dtype and shape. The
one exception are bits that make the processor complain whenever they are computed with, such as a signalling NaN. They
arrive as the quiet NaN that the first computation would have made of them.
The worker loads this module as well, so it needs only the standard library and NumPy.
"""

from __future__ import annotations

import binascii
import enum
import json
import math
import re
import struct
from functools import lru_cache
from typing import Any, Final

import numpy as np

MESSAGE_LIMIT: Final = 8 * 2**20
"""Bytes of the longest message."""
PARTS_LIMIT: Final = 200_000
"""The most commas and brackets in a message: how much larger it can get in memory than it was on the wire."""
INTEGER_LIMIT: Final = 4000
"""Bits of the longest integer; Python itself stops reading decimal digits a little above that many digits."""
HEADER: Final = 8
"""Bytes that say how long the message is."""

_KINDS = "biufcUS"  # bool, integers, floats, complex, text, bytes
_DTYPE = re.compile(r"[<>|](?:b1|[iufc][0-9]{1,2}|[US][0-9]{1,7})")  # as `dtype.str` writes them
_DEEPEST = 20  # lists in lists in lists


class Refused(Exception):
    """A value that no message carries, or a message that is not one."""


def pack(value: Any) -> bytes:
    """The message's bytes, length first; raises `Refused` if a value is of another type, or too large."""
    body = json.dumps(encoded(value), separators=(",", ":")).encode("ascii")
    _check_size(body)
    return len(body).to_bytes(HEADER, "big") + body


def length(header: bytes) -> int:
    """How many bytes follow the header; raises `Refused` if that is more than a message may have."""
    announced = int.from_bytes(header, "big")
    if announced > MESSAGE_LIMIT:
        raise Refused(f"a message of {announced} bytes; at most {MESSAGE_LIMIT} are read")
    return announced


def unpack(body: bytes) -> Any:
    """The value of a message without its header; raises `Refused` for anything that `pack` does not write."""
    _check_size(body)
    try:
        return decoded(_DECODER.decode(body.decode("ascii")))
    except (ValueError, RecursionError, OverflowError) as error:
        raise Refused(f"not a message: {error}") from None


def encoded(value: Any, depth: int = 0) -> Any:
    """The value in terms of JSON. Lists, tuples, arrays, scalars and odd floats become lists that begin with a tag."""
    exact = type(value)
    if exact is np.ndarray:
        return ["array", _dtype_name(value.dtype), list(value.shape), _text_of(value)]
    if exact is float:
        return value if math.isfinite(value) else ["float", struct.pack(">d", value).hex()]
    if value is None or exact is bool:
        return value
    if exact is str:
        return _short(value, MESSAGE_LIMIT, "text", "characters")
    if exact is int:
        if value.bit_length() > INTEGER_LIMIT:
            raise Refused(f"an integer of {value.bit_length()} bits")
        return value
    if exact is tuple or exact is list:
        if depth == _DEEPEST:
            raise Refused(f"a {exact.__name__} nested more than {_DEEPEST} deep")
        _short(value, PARTS_LIMIT, exact.__name__, "parts")
        return [exact.__name__, [encoded(part, depth + 1) for part in value]]
    if exact in _SCALARS:
        array = np.asarray(value)  # its dtype has room for a character even if the text is empty
        return ["scalar", _dtype_name(array.dtype), [], _text_of(array)]
    if (plain := _as_plain(value)) is not value:
        return encoded(plain, depth)
    raise Refused(f"an object of type {_type_name(exact)}")


def decoded(parts: Any, depth: int = 0) -> Any:
    """The value that `encoded` made these parts of."""
    if type(parts) is not list:
        if type(parts) is dict:
            raise Refused("not a message: it holds an object")
        if type(parts) is int and parts.bit_length() > INTEGER_LIMIT:
            raise Refused(f"not a message: an integer of {parts.bit_length()} bits")
        return parts
    match parts:  # the most frequent ones first
        case ["array", str(name), list(shape), str(text)]:
            return _array(name, shape, text)
        case ["tuple", list(members)] if depth < _DEEPEST:
            return tuple([decoded(part, depth + 1) for part in members])
        case ["list", list(members)] if depth < _DEEPEST:
            return [decoded(part, depth + 1) for part in members]
        case ["float", str(digits)]:
            return _odd_float(digits)
        case ["scalar", str(name), [], str(text)]:
            return _array(name, [], text)[()]
    raise Refused("not a message: it holds a list without a known tag, or one nested too deep")


def _as_plain(value: Any) -> Any:
    """A named tuple as a tuple, and a member of an IntEnum as its number, past all methods of their own classes."""
    exact = type(value)
    if exact is not tuple and issubclass(exact, tuple) and hasattr(exact, "_fields"):
        return (*tuple.__iter__(value),)
    if exact is not int and issubclass(exact, int) and issubclass(exact, enum.Enum):
        return int.__add__(value, 0)
    return value


_SCALARS = frozenset(
    {np.dtype(code).type for code in (*np.typecodes["AllInteger"], *np.typecodes["AllFloat"], "?", "U", "S")}
)


def _short(value: Any, limit: int, kind: str, parts: str) -> Any:
    """The value, unless it is too long to be worth the time of writing it out."""
    if len(value) > limit:
        raise Refused(f"a {kind} of {len(value)} {parts}; at most {limit} are sent")
    return value


def _dtype_name(dtype: np.dtype[Any]) -> str:
    # The byte order is part of the name. A user's metadata is not, nor are fields and subarrays: those are kind V.
    if dtype.kind not in _KINDS:
        raise Refused(f"an array of dtype {dtype}" if dtype.kind != "O" else "an array of objects (dtype object)")
    return dtype.str


def _text_of(array: np.ndarray[Any, Any]) -> str:
    if array.nbytes > MESSAGE_LIMIT:
        raise Refused(f"an array of {array.nbytes} bytes; at most {MESSAGE_LIMIT} are sent")
    return binascii.b2a_base64(array.tobytes(), newline=False).decode("ascii")


def _odd_float(digits: str) -> float:
    """A float given by its bits, because JSON has no word for it: a quiet NaN with its payload, and the infinities.

    The product by one makes a quiet NaN of a signalling one.
    """
    found: float = struct.unpack(">d", bytes.fromhex(digits))[0] * 1.0 if len(digits) == 16 else 0.0
    if math.isfinite(found):
        raise Refused(f"not a message: {digits[:20]!r} is no odd float")
    return found


def _array(name: str, shape: list[Any], text: str) -> np.ndarray[Any, Any]:
    """An array that owns its memory and can be written to."""
    dtype = _plain_dtype(name)
    if len(shape) > 32:
        raise Refused("not a message: no such shape")
    for axis in shape:
        if type(axis) is not int or not 0 <= axis <= MESSAGE_LIMIT:
            raise Refused("not a message: no such shape")
    if math.prod(shape) > MESSAGE_LIMIT or (0 in shape and math.prod(filter(None, shape)) > MESSAGE_LIMIT):
        raise Refused(f"not a message: no such shape as {tuple(shape)}")  # no bytes, but rows without end
    try:
        raw = binascii.a2b_base64(text, strict_mode=True)
    except binascii.Error as error:
        raise Refused(f"not a message: {error}") from None
    if len(raw) != math.prod(shape) * dtype.itemsize:
        raise Refused(f"not a message: {len(raw)} bytes for shape {tuple(shape)} of {dtype}")
    array = np.frombuffer(raw, dtype).reshape(shape).copy()
    _check_bits(array)
    _quieten(array)
    return array


@lru_cache(maxsize=256)
def _plain_dtype(name: str) -> np.dtype[Any]:
    if not _DTYPE.fullmatch(name):  # NumPy's own reading knows much more, warns of some of it, and takes its time
        raise Refused(f"not a message: dtype {name[:20]!r}")
    try:
        dtype = np.dtype(name)
    except (TypeError, ValueError):
        raise Refused(f"not a message: no dtype {name!r}") from None
    if dtype.str != name or dtype.itemsize == 0:  # NumPy itself makes room for a character if there is none
        raise Refused(f"not a message: dtype {name!r}")
    return dtype


def _check_bits(array: np.ndarray[Any, Any]) -> None:
    """Refuse bits that no honest array holds: a truth value that is neither 0 nor 1, a character beyond Unicode."""
    if array.dtype.kind == "b" and array.view(np.uint8).max(initial=0) > 1:
        raise Refused("not a message: a truth value that is neither 0 nor 1")
    if array.dtype.kind == "U":
        codes = np.frombuffer(array.tobytes(), f"{array.dtype.str[0]}u4")
        if codes.max(initial=0) > 0x10FFFF:
            raise Refused("not a message: a character beyond Unicode")


def _quieten(array: np.ndarray[Any, Any]) -> None:
    """Make quiet NaNs of signalling ones, and of the bits of a wide float that mean no number; keep all other bits."""
    if array.dtype.kind in "fc":
        parts = array.reshape(-1).view(array.real.dtype)  # a product of complex numbers would mix the two parts
        with np.errstate(all="ignore"):
            np.multiply(parts, 1, out=parts)


def _check_size(body: bytes) -> None:
    if len(body) > MESSAGE_LIMIT:
        raise Refused(f"a message of {len(body)} bytes; at most {MESSAGE_LIMIT} are sent")
    parts = body.count(b",") + body.count(b"[") + body.count(b"{")
    if parts > PARTS_LIMIT:
        raise Refused(f"a message of {parts} parts; at most {PARTS_LIMIT} are sent (give an array)")


def _no_constant(name: str) -> Any:
    raise Refused(f"not a message: {name}")


_DECODER = json.JSONDecoder(parse_constant=_no_constant)


def _type_name(exact: type) -> str:
    """Where the type comes from and its name, cut short; `type` itself is asked, as a class may lie about its name."""
    module, name = type.__dict__["__module__"].__get__(exact), type.__dict__["__qualname__"].__get__(exact)
    where = "" if module in ("builtins", "__main__", "submission") else f"{module}."
    return f"{where}{name}"[:100]
