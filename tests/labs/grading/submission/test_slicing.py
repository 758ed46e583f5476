"""Of a submitted file remain the wanted functions and what they need."""

from __future__ import annotations

import pytest
from submissions import BOTH, WANTED, defined, handed_in, told

from labs.grading.submission.reading import read


def test_statements_that_no_function_needs_are_left_out(tmp_path):
    source = """
import numpy as np
from math import *
import matplotlib.pyplot as plt
from labs import lab
G = 9.81
TABLE = {}
TABLE["half"] = 0.5
LOG = []
LOG.append("never needed")
plot = plt.plot([1, 2])
def helper(v):
    return [x for x in (v,)][0] * TABLE["half"] * sqrt(4.0) * G / G
def unneeded():
    return plot
def rebound_velocity(v, e):
    x = -helper(v)
    return x * e
for x in range(3):
    plt.plot(x)
print(rebound_velocity(1, 2))
lab.check()
raise SystemExit
def normal_velocity(n, u, axis=-1): return np.sum(n * u, axis)
"""
    submission = handed_in(tmp_path, source, "lab.py")
    kept = [line.split("#")[0].strip() for line in submission.text.splitlines() if line.strip()]
    for gone in ("plt", "lab", "LOG", "unneeded", "print", "raise"):
        assert not any(gone in line for line in kept), gone
    assert submission.text.splitlines()[12 - 1] == "def helper(v):"  # a line keeps its number
    assert defined(submission)["rebound_velocity"](-2.0, 0.5) == 1.0


@pytest.mark.parametrize(
    "source",
    [
        "rebound_velocity = lambda v, e: -e * v",
        "def other(v, e): return -e * v\nrebound_velocity = other",
        "from functools import partial\ndef three(k, v, e): return k * e * v\nrebound_velocity = partial(three, -1)",
        "if True:\n    def rebound_velocity(v, e): return -e * v\nelse:\n    rebound_velocity = None",
        "try:\n    import numba\nexcept ImportError:\n    pass\ndef rebound_velocity(v, e): return -e * v",
        "import functools\n\n@functools.lru_cache(\n    None,\n)\ndef rebound_velocity(v, e): return -e * v",
        "MINUS = 1; MINUS = -MINUS; print(MINUS)\ndef rebound_velocity(v, e, s=MINUS): return s * e * v",
        "class Rule:\n    sign = -1\n    def of(self, v, e): return self.sign * e * v\nrebound_velocity = Rule().of",
        "def rebound_velocity(v, e):\n    global helper\n    return helper(v) * e\ndef helper(v): return -v",
        "s = 1\ns -= 2\ndef rebound_velocity(v, e): return s * e * v",
        "def rebound_velocity(v, e): return (lambda: sign * e * v)()\nsign = -1",
        "with open('/dev/null') as sink: sign = -1\ndef rebound_velocity(v, e): return sign * e * v",
        "def rebound_velocity(v, e, *, s=-1, k=1, **more): return k * s * e * v",
        "def scaled(v, *, by): return by * v\ndef rebound_velocity(v, e): return scaled(v, by=-e)",
        "async def other(v): pass\nBASE = 1\nclass A:\n    a = BASE\nclass B(A): pass\n"
        "def rebound_velocity(v, e): return -e * v * B.a",
        "import numpy.linalg\nrebound_velocity = lambda v, e: -e * numpy.linalg.norm(numpy.ones(1)) * v",
        "TABLE = {'a': {}}\nTABLE['a']['s'] = -1\ndef rebound_velocity(v, e): return TABLE['a']['s'] * e * v",
        "def sign(): return sign.value\nsign.value = -1\ndef rebound_velocity(v, e): return sign() * e * v",
        "TABLE = [1]\nTABLE[0] -= 2\ndef rebound_velocity(v, e): return TABLE[0] * e * v",
        "def shift(f): return lambda v, e: f(v, e) - 1\n@shift\ndef rebound_velocity(v, e): return 1 - e * v",
        "from functools import singledispatch\n@singledispatch\ndef sign(v): raise TypeError(v)\n"
        "@sign.register(float)\ndef _(v): return -1\ndef rebound_velocity(v, e): return sign(v) * e * v",
        "LAWS = {}\ndef law(name): return lambda f: LAWS.setdefault(name, f)\n@law('closing')\ndef closing(v, e): "
        "return -e * v\ndef rebound_velocity(v, e): return LAWS['closing'](v, e)",
        "class Law:\n    every = []\n    def __init_subclass__(cls): Law.every.append(cls)\nclass Closing(Law):\n    "
        "sign = -1\ndef rebound_velocity(v, e): return Law.every[0].sign * e * v",
        "def begin():\n    more()\ndef more():\n    global SIGN\n    SIGN = -1\nbegin()\n"
        "def rebound_velocity(v, e): return SIGN * e * v",
        "class Law: pass\nsetattr(Law, 'sign', -1)\ndef rebound_velocity(v, e): return Law.sign * e * v",
        "def rebound_velocity(v, e): \\\n    return -e * v \\\n\nprint(1)",
        "[sign] = [-1]\ndef rebound_velocity(v, e): return sign * e * v",
    ],
)
def test_a_function_is_found_with_its_needs_however_it_is_defined(source, tmp_path):
    submission = handed_in(tmp_path, source, "lab.py")
    assert submission.functions == ("rebound_velocity",)
    assert defined(submission)["rebound_velocity"](-2.0, 0.5) == 1.0
    assert told(submission) == "normal_velocity is missing"


def test_a_function_that_remembers_keeps_no_statement_that_only_shows_it(tmp_path):
    source = (
        "SEEN = []\ndef rebound_velocity(v, e):\n    SEEN.append(v)\n    return -e * v\nplot(rebound_velocity(1, 1))"
    )
    assert "plot" not in handed_in(tmp_path, source, "lab.py").text


def test_a_function_uses_what_it_calls_directly_or_through_others(tmp_path):
    source = (
        BOTH
        + """
RATE = rebound_velocity(-1.0, 1.0)
def approach(n, u): return RATE * normal_velocity(n, u)
def collide(n, u): return approach(n, u)
def mean_force(normal_velocity): return normal_velocity
"""
    )
    (tmp_path / "lab.py").write_text(source)
    submission = read(tmp_path / "lab.py", (*WANTED, "collide", "mean_force"))
    assert submission.uses("collide") == ["rebound_velocity", "normal_velocity"]
    assert submission.uses("mean_force") == [], "a parameter of that name is no function"


def test_what_a_decorator_may_look_up_in_type_hints_is_kept(tmp_path):
    source = """
from __future__ import annotations
from typing import get_type_hints
Speed = float
def described(function):
    def wrapped(*given):
        return function(*given) if get_type_hints(function) else None
    return wrapped
@described
def rebound_velocity(v: Speed, e: Speed) -> Speed: return -e * v
"""
    submission = handed_in(tmp_path, source, "lab.py")
    assert defined(submission)["rebound_velocity"](-2.0, 0.5) == 1.0
