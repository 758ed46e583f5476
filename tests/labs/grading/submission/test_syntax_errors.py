"""Of a source that Python cannot read, a student hears the line of the mistake, and what to do about it."""

from __future__ import annotations

import sys

import pytest
from submissions import handed_in, notebook, told

PROGRAM = """import numpy as np


def rebound_velocity(v, e):
    \"\"\"After the impact.\"\"\"
    speed = np.abs(np.asarray(v))
    return np.where(v < 0, e * speed, v)


def normal_velocity(n, u):
    \"\"\"Along the normal.\"\"\"
    return np.sum(n * u, axis=-1)
"""
QUOTES = '"""'


@pytest.mark.parametrize(
    ("right", "wrong", "line", "says"),
    [
        # brackets and texts that are never closed: Python gives up further down
        ("(np.asarray(v))", "(np.asarray(v)", 6, "np.abs( is opened here and never closed: add its )"),
        ("(v))\n", "(v)\n    bounce = e * speed\n", 6, "np.abs( is opened here"),
        ("(np.asarray(v))", "(np.asarray(v),", 6, "np.abs( is opened here"),
        ("axis=-1)", "axis=-1", 12, "np.sum( is opened here"),
        ("(v, e):", "(v, e:", 4, "rebound_velocity( is opened here"),
        ("\n\n\ndef rebound", "\nX = [1,\n     2\n\ndef rebound", 2, "[ is opened here"),
        ("impact." + QUOTES, "impact.", 5, "the text that begins here with \"\"\" does not end"),
        ("normal." + QUOTES, "normal.", 11, "the text that begins here with \"\"\" does not end"),
        (QUOTES + "After the impact." + QUOTES, "print('after)", 5, "a text begins in it and has no closing quote"),
        ("(np.asarray(v))", "(np.asarray(v)))", 6, "the bracket ) closes nothing"),
        ("(np.asarray(v))", "(np.asarray(v])", 6, "the bracket ] cannot close the bracket (: which of the two"),
        # indentation
        ("    return np.where", "\treturn np.where", 7, "tabs and spaces are mixed"),
        ("    return np.where", "      return np.where", 7, "it is indented further than the line above"),
        ("    return np.where", "  return np.where", 7, "it is indented differently from every line above"),
        (PROGRAM[PROGRAM.index("    " + QUOTES + "After") : PROGRAM.index("def normal")], "\n", 4,
         "this function has no lines: indent what belongs to it by four spaces"),
        ("    return np.where", "    if e > 1:\n    return np.where", 7, "nothing is indented below this line"),
        # characters that look like Python's
        ("e * speed", "e × speed", 7, "Python does not know the character × (U+00D7): type * instead"),
        ("-1)", "\u22121)", 12, "Python does not know the character − (U+2212): type - instead"),
        ("axis=-1", "axis=“last”", 12, "Python does not know the character “ (U+201C): type \" instead"),
        ("v < 0", "v ≤ 0", 7, "type <= instead"),
        ("v < 0", "v ＜ 0", 7, "type < instead"),
        ("v < 0", "v → 0", 7, "Python does not know the character → (U+2192): delete it"),
        ("    return", "\u00a0   return", 7, "no plain space (U+00A0): delete it and type a space (2 lines have one)"),
        ("def normal", "\u200bdef normal", 10, "an invisible character (U+200B) is in it: delete the line"),
        # words and signs of other languages
        ("    return np.where", "    print speed\n    return np.where", 7,
         "'print speed': print is a function, so brackets belong around what follows it, as in print(x). Until"),
        ("v, e):", "v, e)", 4, "a colon is missing"),
        ("    return np.where", "    if e = 1: e = 0.9\n    return np.where", 7, "to compare, write =="),
        ("    return np.where", "    if e > 1:\n        e = 1\n    else if e < 0: e = 0\n    return np.where", 9,
         "Python writes elif for else if"),
        ("v < 0", "v =< 0", 7, "Python writes <= for =<"),
        ("v < 0", "v < 0 && e > 0", 7, "Python writes and for &&"),
        ("def normal", "Def normal", 10, "Python writes def, in small letters"),
        ("e * speed", "2speed", 7, "a number runs into a name: is a * missing between them?"),
        ("(n, u)", "(lambda, u)", 10, "lambda is a word of Python's own: choose another name"),
        ("def normal", "The answer is given by this\ndef normal", 10, "it reads like a sentence: put a # before it"),
        ("speed = np", "speed = = np", 6, "Python does not understand it from '=' on"),
        ("def normal", ">>> rebound_velocity(1, 2)\ndef normal", 10, "a prompt such as >>> is no part of a program"),
        ("v, e):", "v, e) {", 4, "Python writes : instead of {"),
        ("speed = np", "speed(v) = np", 6, "left of = only a name can be written, no function call; to compare"),
        ("def normal_velocity", "def normal velocity", 10, "the name of a function is one word"),
        ("(n, u)", "(n=1, u)", 10, "arguments with a default come last"),
        ("(n, u)", "(n, n)", 10, "two of its arguments are named n"),
        ("    return np.where", "    else:\n        e = 1\n    return np.where", 7, "this else belongs to no if above"),
        ("    return np.where", "    e++\n    return np.where", 7, "Python has no ++: write += 1"),
        ("e * speed, v", "e * speed, \\ \n v", 7, "nothing may follow a backslash in its line"),
        ("import numpy", "1 import numpy", 1, "a line number was copied with it"),
        # characters at which an editor and Python begin no new line
        ("impact." + QUOTES, "im\u2028pa\x0cct\x85." + QUOTES + ")", 5, "the bracket ) closes nothing"),
    ],
)  # fmt: skip
def test_a_mistake_is_found_on_its_line_and_explained(right, wrong, line, says, tmp_path):
    assert right in PROGRAM
    source = PROGRAM.replace(right, wrong)
    first = told(handed_in(tmp_path, source, "lab.py")).splitlines()[0]
    place, quoted = first.split(": ", 1)
    assert place == f"line {line}"
    assert says in quoted
    assert " Until then rebound_velocity and normal" in first


def test_an_argument_on_a_line_of_its_own_is_not_taken_for_a_statement(tmp_path):
    """The mistake is on line 12, and the brackets that stay open over several lines are right."""
    call = "np.where(\n        v < 0,\n        e * speed,\n        y = v,\n    )"
    source = PROGRAM.replace("np.where(v < 0, e * speed, v)", call).replace("axis=-1)", "axis=-1))")
    assert told(handed_in(tmp_path, source, "lab.py")).startswith("line 16: Python cannot read 'return np.sum")


def test_a_nul_character_is_named(tmp_path):
    found = told(handed_in(tmp_path, notebook(PROGRAM, "x = 1\ny = 2\0")))
    assert found.startswith("code cell 2, line 2: Python cannot read this: a NUL character is in it")


@pytest.mark.skipif(sys.version_info >= (3, 12), reason="this Python can read it")
@pytest.mark.parametrize(
    ("right", "newer", "line", "says"),
    [
        ("    speed", '    q = f"{v["x"]} {", ".join(e)}"\n    speed', 6, "write other quotes inside the braces"),
        ("    speed", "    q = f'{\"\\n\".join(e)} {{'\n    speed", 6, "inside the braces, and no backslash"),
        ("def normal_velocity(n, u)", "def normal_velocity[T](n: T, u: T)", 10, "leave out [ ] after the name"),
        ("import numpy", "type X = int\nimport numpy", 1, "leave out the word type"),
    ],
)
def test_what_only_a_later_python_reads_is_no_mistake(right, newer, line, says, tmp_path):
    found = told(handed_in(tmp_path, PROGRAM.replace(right, newer), "lab.py"))
    assert found.startswith(f"line {line}: ")
    version = f"{sys.version_info.major}.{sys.version_info.minor}"
    assert f"Python {version}, which grades here, cannot read this; Python 3.12 can: " in found
    assert says in found


@pytest.mark.parametrize("mistake", ["f'{v +}'", 'f"{v[\'x}"', 'f"{v["x"}"', "f'{2v}' + '['", "v[T](", "'a' b'"])
def test_a_mistake_in_any_python_is_not_laid_on_the_version(mistake, tmp_path):
    source = PROGRAM.replace("    speed", f"    q = {mistake}\n    speed")
    assert "which grades here" not in told(handed_in(tmp_path, source, "lab.py"))
