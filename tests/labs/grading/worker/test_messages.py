"""The wire between grader and worker: exact types arrive bit by bit, and nothing else is sent or read."""

from __future__ import annotations

import base64
import contextlib
import enum
import json
import math
import re
import struct
from collections import OrderedDict
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from labs.grading.worker import messages
from labs.grading.worker.messages import HEADER, INTEGER_LIMIT, MESSAGE_LIMIT, PARTS_LIMIT, Refused, pack, unpack

DTYPES = st.one_of(
    hnp.boolean_dtypes(),
    hnp.integer_dtypes(endianness="?"),
    hnp.unsigned_integer_dtypes(endianness="?"),
    hnp.floating_dtypes(endianness="?", sizes=(16, 32, 64)),
    hnp.complex_number_dtypes(endianness="?"),
    hnp.unicode_string_dtypes(endianness="?", max_len=5),
    hnp.byte_string_dtypes(max_len=5),
)
ARRAYS = hnp.arrays(DTYPES, hnp.array_shapes(min_dims=0, max_dims=4, min_side=0, max_side=4))
PLAIN = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-(2**200), 2**200)
    | st.floats(allow_nan=False)
    | st.text(st.characters(), max_size=20)
    | ARRAYS
    | ARRAYS.map(lambda array: array.reshape(-1)[0] if array.size else None),
    lambda parts: st.lists(parts, max_size=4) | st.lists(parts, max_size=4).map(tuple),
    max_leaves=10,
)


def there_and_back(value):
    return unpack(pack(value)[HEADER:])


def same(sent, arrived) -> bool:
    """Whether both have one type and the same bits, all the way down."""
    if type(sent) is not type(arrived):
        return False
    if isinstance(sent, list | tuple):
        return len(sent) == len(arrived) and all(map(same, sent, arrived))
    if isinstance(sent, np.ndarray | np.generic):
        layout = sent.dtype.str == arrived.dtype.str and sent.shape == arrived.shape
        return layout and sent.tobytes() == arrived.tobytes()
    return struct.pack("d", sent) == struct.pack("d", arrived) if isinstance(sent, float) else sent == arrived


@given(PLAIN)
@settings(max_examples=50)
def test_every_plain_value_arrives_as_sent(value):
    assert same(value, there_and_back(value))


QUIET = 1 << 51


@given(st.sampled_from([0, 1]), st.integers(0, QUIET - 1), st.booleans())
def test_a_nan_keeps_its_payload_and_an_infinity_its_sign(is_nan, payload, negative):
    bits = (0x7FF << 52 | is_nan * (QUIET | payload) | negative << 63).to_bytes(8, "big")
    odd = struct.unpack(">d", bits)[0]
    assert struct.pack(">d", there_and_back(odd)) == bits
    array = np.frombuffer(bits, ">f8")
    assert there_and_back(array).tobytes() == bits


SIGNALLING = {
    "a double": np.array([0x7FF0000000000001, 0xFFF7FFFFFFFFFFFF], "<u8").view("<f8"),
    "a double of the other byte order": np.array([0x7FF4000000000000], ">u8").view(">f8"),
    "single precision": np.array([0x7F800001, 0xFFBFFFFF], "<u4").view("<f4"),
    "half precision": np.array([[0x7C01], [0xFDFF]], "<u2").view("<f2"),
    "a complex number": np.array([0x7FF0000000000001, 0], "<u8").view("<c16"),
    "a wide float": np.frombuffer((b"\x01" * 8 + b"\xff\x7f").ljust(np.longdouble().itemsize, b"\0"), np.longdouble),
}


@pytest.mark.parametrize("array", SIGNALLING.values(), ids=SIGNALLING)
def test_bits_of_which_the_processor_complains_arrive_as_a_quiet_nan(array):
    for arrived in (there_and_back(array), there_and_back(array[0])):
        with np.errstate(all="raise"):
            parts = np.ravel([np.real(arrived), np.imag(arrived)])
            assert np.isnan(parts.astype(float)).any()
            assert not np.any(parts - 1 == parts)


def test_a_number_of_python_that_signals_arrives_as_a_quiet_nan():
    message = b'["float","7ff0000000000001"]'
    with np.errstate(all="raise"):
        assert np.isnan(np.asarray([unpack(message)]) - 1.0).all()


@pytest.mark.parametrize("array", [np.arange(12.0).reshape(3, 4).T, np.arange(10)[::-2], np.broadcast_to(1.0, (2, 3))])
def test_a_view_arrives_as_a_writable_array_of_its_own(array):
    arrived = there_and_back(array)
    np.testing.assert_array_equal(arrived, array, strict=True)
    arrived[...] = 0
    assert arrived.base is None


class Subclass(float):
    pass


class Pair(NamedTuple):
    left: object
    right: object


class Agreeing(Pair):
    """A named tuple that answers everything in its own way."""

    def __iter__(self):
        return iter(["expected"])

    def __len__(self):
        return 1

    def __eq__(self, other):
        return True

    __hash__ = None


class Kind(enum.IntEnum):
    FIRST = -1

    def __int__(self):
        return 7

    __index__ = __add__ = __int__


@pytest.mark.parametrize(
    ("value", "plainly"),
    [
        (Pair(1.0, Pair(2, None)), (1.0, (2, None))),
        (Agreeing(1.0, 2.0), (1.0, 2.0)),
        (Kind.FIRST, -1),
        ([Kind.FIRST], [-1]),
        (enum.IntFlag("Flag", "UP").UP, 1),
    ],
)
def test_named_tuples_and_whole_number_constants_arrive_as_what_they_hold(value, plainly):
    arrived = unpack(pack(value)[HEADER:])
    assert type(arrived) is type(plainly)
    assert repr(arrived) == repr(plainly)


class Array(np.ndarray):
    pass


@pytest.mark.parametrize(
    ("value", "named"),
    [
        (Subclass(1), "test_messages.Subclass"),
        (np.zeros(2).view(Array), "Array"),
        (np.ma.zeros(2), "numpy.ma.MaskedArray"),
        (type("Pair", (tuple,), {})(), "Pair"),
        (enum.Enum("Plain", {"A": 1}).A, "Plain"),
        (type("Whole", (int,), {})(1), "Whole"),
        ({"a": 1}, "dict"),
        ({1.0}, "set"),
        (b"bytes", "bytes"),
        (1j, "complex"),
        (len, "builtin_function_or_method"),
        (range(3), "range"),
        (object(), "object"),
        (np.array([None]), "array of objects"),
        (np.zeros(1, "i4,f8"), "an array of dtype"),
        (np.array(["2026-01-01"], "M8[D]"), "an array of dtype datetime64"),
        (np.float64, "type"),
        (2**5000, "an integer of 5001 bits"),
        ("x" * (MESSAGE_LIMIT + 1), "a text of"),
        ("\u00e9" * MESSAGE_LIMIT, "a message of"),  # six bytes each on the wire
        (np.zeros(MESSAGE_LIMIT // 8 + 1), "an array of"),
        ([0.0] * (PARTS_LIMIT + 1), "a list of"),
        ([[0.0] * (PARTS_LIMIT // 2)] * 3, "parts"),
    ],
    ids=lambda value: value if isinstance(value, str) and len(value) < 60 else "",
)
@pytest.mark.parametrize("wrapped", [False, True])
def test_any_other_value_is_refused_with_the_name_of_its_type(value, named, wrapped):
    with pytest.raises(Refused, match=named):
        pack((value,) if wrapped else value)


def array_of(dtype: object, shape: object, raw: bytes) -> list[object]:
    return ["array", dtype, shape, base64.b64encode(raw).decode()]


@pytest.mark.parametrize(
    "parts",
    [
        {"a": 1},
        ["tuple", {"a": 1}],
        ["tuple"],
        [],
        ["set", []],
        ["list", [["dict", []]]],
        ["float", "7ff000000000000"],  # a digit short
        ["float", "0000000000000000"],  # finite, so to be written as a number
        ["float", "zz"],
        array_of("|O", [1], bytes(8)),
        array_of("O", [1], bytes(8)),
        array_of("f8", [1], bytes(8)),  # another spelling of <f8
        array_of("<f8,<f8", [1], bytes(16)),
        array_of("(2,)<f8", [1], bytes(16)),
        array_of("<M8[D]", [1], bytes(8)),
        array_of("V8", [1], bytes(8)),
        array_of(["a", "b"], [1], bytes(8)),
        array_of("import os", [1], bytes(8)),
        array_of("a8", [1], bytes(8)),  # NumPy warns of it
        array_of("<i3", [1], bytes(3)),
        array_of("<f8\n", [1], bytes(8)),
        array_of("<f8", [2], bytes(8)),
        array_of("<f8", [-1], bytes(8)),
        array_of("<f8", [True], bytes(8)),
        array_of("<f8", [1.0], bytes(8)),
        array_of("<f8", [0, 2**62], b""),
        array_of("<f8", [1] * 33, bytes(8)),
        array_of("|b1", [1], b"\2"),  # a truth value that is neither
        array_of("<U1", [1], b"\xff\xff\xff\x7f"),  # beyond Unicode
        ["array", "<f8", [1], "not base64!"],
        ["scalar", "<f8", [1], "AAAAAAAAAAA="],
    ],
    ids=repr,
)
def test_a_message_that_pack_does_not_write_is_refused(parts):
    with pytest.raises(Refused):
        unpack(json.dumps(parts).encode())


@pytest.mark.parametrize(
    "body",
    [
        b"",
        b"{",
        b"NaN",
        b"Infinity",
        b"1e5x",
        b"\xff",
        b"[" * 100_000,
        b"1" * 10_000,
        b"[" + b"[]," * PARTS_LIMIT + b"[]]",
    ],
    ids=lambda body: repr(body[:12]),
)
def test_bytes_that_are_no_message_are_refused(body):
    with pytest.raises(Refused):
        unpack(body)


@given(st.binary(max_size=200))
def test_any_bytes_give_a_plain_value_or_are_refused(body):
    try:
        value = unpack(body)
    except Refused:
        return
    assert type(value) in {type(None), bool, int, float, str, tuple, list, np.ndarray}


PARTS = st.sampled_from(
    [
        "tuple",
        "list",
        "array",
        "scalar",
        "float",
        "<f8",
        ">f8",
        "|b1",
        "<U1",
        "|S1",
        "AAAAAAAAAAA=",
        "AA==",
        "",
        0,
        1,
        -1,
        1.5,
        None,
        True,
        [],
        [0],
        [1],
        [2, 1],
        [[]],
        ["list", []],
        {},
    ]
)


@given(st.lists(PARTS, min_size=1, max_size=4))
def test_any_json_gives_a_plain_value_or_is_refused(parts):
    with contextlib.suppress(Refused):
        pack(unpack(json.dumps(parts).encode()))


def test_a_number_too_large_for_a_float_arrives_as_infinity():
    assert unpack(b"1e999") == math.inf


def test_a_length_above_the_limit_is_refused_before_reading():
    assert messages.length(pack(1.0)[:HEADER]) == len(b"1.0")
    with pytest.raises(Refused, match="at most"):
        messages.length((MESSAGE_LIMIT + 1).to_bytes(HEADER, "big"))


# Just within a limit, and just beyond


def nested(depth, kind):
    value = kind()
    for _ in range(depth - 1):
        value = kind([value])
    return value


@pytest.mark.parametrize("kind", [list, tuple])
def test_lists_nest_twenty_deep(kind):
    assert same(nested(20, kind), there_and_back(nested(20, kind)))
    with pytest.raises(Refused, match=f"^a {kind.__name__} nested more than 20 deep$"):
        pack(nested(21, kind))


@pytest.mark.parametrize("sign", [-1, 1])
def test_an_integer_has_four_thousand_bits_at_most(sign):
    longest = sign * (2**INTEGER_LIMIT - 1)
    assert there_and_back(longest) == longest
    with pytest.raises(Refused, match="an integer of 4001 bits"):
        pack(sign * 2**INTEGER_LIMIT)


def test_a_message_may_be_as_long_as_the_limit_and_no_longer():
    text = "x" * (MESSAGE_LIMIT - 2)  # with its quotes
    assert there_and_back(text) == text
    for longer in ("x" * (MESSAGE_LIMIT - 1), np.zeros(MESSAGE_LIMIT, "u1")):
        with pytest.raises(Refused, match=f"a message of .* bytes; at most {MESSAGE_LIMIT} are sent"):
            pack(longer)
    with pytest.raises(Refused, match="an array of 8388609 bytes"):
        pack(np.zeros(MESSAGE_LIMIT + 1, "u1"))
    with pytest.raises(Refused, match="a text of"):
        pack("x" * (MESSAGE_LIMIT + 1))
    assert messages.length(MESSAGE_LIMIT.to_bytes(HEADER, "big")) == MESSAGE_LIMIT
    with pytest.raises(Refused, match="at most"):
        unpack(b'"' + b"x" * (MESSAGE_LIMIT - 1) + b'"')


def test_a_message_may_have_as_many_parts_as_the_limit_and_no_more():
    fits = [None] * (PARTS_LIMIT - 2)  # a comma less than parts, a bracket for the tag and one for the list, one comma
    assert len(there_and_back(fits)) == PARTS_LIMIT - 2
    with pytest.raises(Refused, match=f"a message of {PARTS_LIMIT + 1} parts"):
        pack([*fits, None])
    with pytest.raises(Refused, match=f"a message of {PARTS_LIMIT + 1} parts"):
        unpack(b"[" * (PARTS_LIMIT + 1))
    with pytest.raises(Refused, match=f"a message of {PARTS_LIMIT + 1} parts"):
        unpack(b"{" * (PARTS_LIMIT + 1))
    with pytest.raises(Refused, match=f"a list of {PARTS_LIMIT + 1} parts"):
        pack([None] * (PARTS_LIMIT + 1))


def test_an_array_has_as_many_axes_as_the_limit_and_no_more():
    assert unpack(json.dumps(array_of("<f8", [1] * 32, bytes(8))).encode()).shape == (1,) * 32
    with pytest.raises(Refused, match="no such shape"):
        unpack(json.dumps(array_of("<f8", [1] * 33, bytes(8))).encode())


@pytest.mark.parametrize("rows", [1, 2])
def test_an_array_without_bytes_has_as_many_rows_as_the_limit_and_no_more(rows):
    most = [rows, 0, MESSAGE_LIMIT // rows]
    assert unpack(json.dumps(array_of("<f8", most, b"")).encode()).shape == tuple(most)
    with pytest.raises(Refused, match="no such shape"):
        unpack(json.dumps(array_of("<f8", [rows, 0, MESSAGE_LIMIT // rows + 1], b"")).encode())


@pytest.mark.parametrize(
    ("parts", "why"),
    [
        ({"a": 1}, "it holds an object"),
        (["set", []], "a list without a known tag"),
        (["float", "3ff0000000000000"], "'3ff0000000000000' is no odd float"),
        (array_of("|O", [1], bytes(8)), "dtype '|O'"),
        (array_of("<i3", [1], bytes(3)), "no dtype '<i3'"),
        (array_of("|f8", [1], bytes(8)), "dtype '|f8'"),
        (array_of("<b1", [1], b"\1"), "dtype '<b1'"),
        (array_of("<U0", [2], b""), "dtype '<U0'"),
        (array_of("|S0", [2], b""), "dtype '|S0'"),
        (array_of("<f8", [-1], bytes(8)), "no such shape"),
        (array_of("<f8", [2], bytes(8)), "8 bytes for shape (2,) of float64"),
        (array_of("|b1", [1], b"\2"), "a truth value that is neither 0 nor 1"),
        (array_of("<U1", [1], (0x110000).to_bytes(4, "little")), "a character beyond Unicode"),
        (array_of(">U1", [1], (0x110000).to_bytes(4, "big")), "a character beyond Unicode"),
        (["array", "<f8", [1], "no!"], "base64"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_a_message_is_refused_with_the_reason(parts, why):
    with pytest.raises(Refused, match=re.escape(why)) as refused:
        unpack(json.dumps(parts).encode())
    assert str(refused.value).startswith("not a message: ")


def test_values_just_within_the_limits_arrive():
    assert unpack(json.dumps(array_of("|b1", [2], b"\0\1")).encode()).tolist() == [False, True]
    assert unpack(json.dumps(array_of("<U1", [1], (0x10FFFF).to_bytes(4, "little"))).encode())[0] == chr(0x10FFFF)
    assert unpack(json.dumps(array_of("<U1", [2], bytes(8))).encode()).tolist() == ["", ""]


def test_a_refused_type_is_named_with_its_module_and_cut_short():
    with pytest.raises(Refused, match=r"^an object of type collections\.OrderedDict$"):
        pack(OrderedDict())
    with pytest.raises(Refused) as refused:
        pack(type("L" * 500, (), {"__module__": "submission"})())
    assert str(refused.value) == "an object of type " + "L" * 100
