"""A statement that fails on loading costs its own names, and within a loop or a branch nothing else."""

from __future__ import annotations

import textwrap
from types import ModuleType

import pytest

from labs.grading.worker.loading import compiled as code_of
from labs.grading.worker.loading import load


def loaded(text: str) -> tuple[dict, list, list, list[int]]:
    """The names that a text defines, its failures, those in loops and branches, and the lines that were told."""
    text, module, lines = textwrap.dedent(text), ModuleType("submission"), list[int]()
    failures, inner = load(text, module, code_of(text), lines.append)
    return vars(module), failures, inner, lines


@pytest.mark.parametrize(
    "filling",
    [
        "for n in range(3):\n    plt.plot(n)\n    TABLE[n] = -n",
        "n = 0\nwhile n < 3:\n    fig, ax = plt.subplots()\n    TABLE[n] = -n\n    ax.plot(n)\n    n += 1",
        "if True:\n    import nowhere_at_all as plt\n    for n in range(3):\n        if n:\n            plt.show()\n"
        "        TABLE[n] = -n",
        "match 3:\n    case 3:\n        display(TABLE)\n        TABLE.update({1: -1, 2: -2})",
        "for n in range(3):\n    TABLE[n] = -n\nfor n in TABLE:\n    TABLE[n] = plot(n)",
        "rows = iter([1, 2])\nwhile True:\n    n = next(rows)\n    TABLE[n] = -n",
        "TABLE.update({1: -1, 2: -2})\nplot()",
    ],
)
def test_what_fails_in_a_loop_leaves_the_rest_of_it(filling):
    names, _, inner, _ = loaded(f"TABLE = {{}}\n{filling}\ndef f():\n    return TABLE[1] + TABLE[2]\n")
    assert names["f"]() == -3
    assert all(kind in ("NameError", "ModuleNotFoundError") for _, kind, _, _ in inner)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("try:\n    X = missing\n    X = 1\nexcept NameError:\n    X = 2", 2),
        ("import contextlib\nX = 2\nwith contextlib.suppress(NameError):\n    missing\n    X = 1", 2),
        ("X = 1\nfor n in range(3):\n    if n == 1:\n        X = 2\n        raise ValueError", 2),
        ("X = 0\nfor n in (1, 2):\n    try:\n        [][n]\n    except IndexError:\n        X += n", 3),
        ("X = 0\nfor n in range(9):\n    X += 1\n    if n == 3:\n        break\nelse:\n    X = 0", 4),
    ],
)
def test_what_expects_an_exception_gets_it(text, value):
    assert loaded(text)[0]["X"] == value


def test_failures_name_their_line_and_what_is_not_defined():
    text = "for n in range(2):\n    if n:\n        X = missing\nY = absent\ndef f(): return 1\n"
    names, failures, inner, _ = loaded(text)
    assert failures == [(["Y"], "NameError", "name 'absent' is not defined", 4)]
    assert inner == [(["X"], "NameError", "name 'missing' is not defined", 3)]
    assert names["f"]() == 1


def test_a_loop_that_only_fails_ends():
    _, failures, inner, _ = loaded("while True:\n    missing()")
    assert [failure[1] for failure in failures] == [failure[1] for failure in inner] == ["NameError"]


def test_the_lines_of_statements_that_may_take_long_are_told_before():
    text = "import math\nA = 1\nB = math.sqrt(4)\ndef f(): return sum([])\nfor n in range(3):\n    f()\nC = 2**9"
    assert loaded(text)[3] == [3, 5, 7]
    decorated = "def same(f): return f\n@same\ndef f(): return 1\ndef g(n=0, m=sum([])): return n\n"
    assert loaded(decorated)[3] == [3, 4]


def test_of_very_many_statements_the_last_lines_are_not_told():
    told = loaded("TABLE = {}\n" + "TABLE[0] = len('a')\n" * 250)[3]
    assert told[-2:] == [200, None]
    assert len(told) == 200


def test_of_statements_that_cannot_be_compiled_together_each_is_run_alone():
    text = "X = 1\nfrom __future__ import annotations\nfor n in range(2):\n    missing()\n    X += 1"
    names, failures, inner, lines = loaded(text)
    assert (names["X"], failures, len(inner), lines) == (3, [], 1, [3])


def test_nothing_of_loading_is_left_in_the_module():
    assert {name for name in loaded("for n in range(3):\n    missing()")[0] if not name.startswith("__")} == {"n"}
