"""A submitted file becomes the source of the wanted functions, or a clear line that says why not."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tracemalloc
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from labs.grading.errors import UnreadableSubmission
from labs.grading.submission import reading
from labs.grading.submission.cells import CELL_LIMIT, CODE_LIMIT, FILE_LIMIT
from labs.grading.submission.magics import without_magics
from labs.grading.submission.reading import Submission, read

WANTED = ("rebound_velocity", "normal_velocity")
BOTH = "def rebound_velocity(v, e):\n    return -e * v\n\n\ndef normal_velocity(n, u):\n    return n @ u\n"


def notebook(*sources: str | list[str] | dict, nbformat: int = 4) -> bytes:
    cells = [
        source if isinstance(source, dict) else {"cell_type": "code", "source": source, "outputs": [], "metadata": {}}
        for source in sources
    ]
    return json.dumps({"nbformat": nbformat, "nbformat_minor": 5, "metadata": {}, "cells": cells}).encode()


def tagged(source: str, *tags: str) -> dict:
    return {"cell_type": "code", "source": source, "metadata": {"tags": list(tags)}}


def handed_in(folder: Path, content: bytes | str, name: str = "lab.ipynb") -> Submission:
    path = folder / name
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return read(path, WANTED)


def defined(submission: Submission) -> dict:
    names: dict = {}
    exec(submission.text, names)
    return names


def told(submission: Submission) -> str:
    return "\n".join(map(str, submission.complaints))


@pytest.mark.parametrize("name", ["lab.py", "lab.ipynb"])
def test_functions_come_out_whole_and_without_complaint(name, tmp_path):
    content = BOTH if name.endswith("py") else notebook(*BOTH.split("\n\n\n"))
    submission = handed_in(tmp_path, content, name)
    assert submission.functions == WANTED
    assert submission.complaints == ()
    assert defined(submission)["rebound_velocity"](-2.0, 0.5) == 1.0


def test_what_only_runs_things_is_left_out_and_what_functions_need_stays(tmp_path):
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
        "[sign] = [-1]\ndef rebound_velocity(v, e): return sign * e * v",
    ],
)
def test_however_a_function_is_defined_it_is_found_with_what_it_needs(source, tmp_path):
    submission = handed_in(tmp_path, source, "lab.py")
    assert submission.functions == ("rebound_velocity",)
    assert defined(submission)["rebound_velocity"](-2.0, 0.5) == 1.0
    assert told(submission) == "normal_velocity is missing"


def test_magics_shell_lines_and_questions_are_taken_out(tmp_path):
    cell = (
        "%matplotlib inline\n!pip install 'x' \\\n   y\nfiles = !ls\nrebound_velocity?\n?print\n"
        "if True:\n    %timeit 1\nelapsed = %time 3\n"
        "def rebound_velocity(v, e):\n    s = '''\n%not a magic\n!nor this'''"
        "\n    return (-e\n        % 7 - 7 if e == 0 else -e\n    ) * v"
    )
    submission = handed_in(tmp_path, notebook(cell, "%%bash\nrm -rf '", "%%time\n" + BOTH.split("\n\n\n")[1]))
    assert submission.functions == WANTED
    assert submission.complaints == ()
    assert defined(submission)["rebound_velocity"](-2.0, 0.5) == 1.0
    assert "%not a magic\n!nor this" in submission.text
    assert submission.where(submission.text.splitlines().index("def rebound_velocity(v, e):") + 1).endswith("line 10")


@pytest.mark.parametrize(
    ("cell", "python"),
    [
        ("%a", "pass"), ("x = 1\n%time y", "x = 1\npass"), ("  !a \\\n  b \\\n  c\nx = 1", "  pass\n\n\nx = 1"),
        ("!a \\\n b", "pass\n"), ("x = !ls", "pass"), ("x = %time y\n", "pass\n"),
        ("f?", "pass"), ("m.f??\n", "pass\n"),
        ("?f", "pass"), ("f???", "f???"), ("a %= 2", "a %= 2"), ("a != 2", "a != 2"), ("a =!= 2", "a =!= 2"),
        ("%%bash\nrm", ""), ("%%", ""), ("%%time\n%a\nx", "\npass\nx"), ("\n\n%%time\nx", "\n\n\nx"),
        ("x\n%%time", "x\npass"), ("(1\n% 2)\n%a", "(1\n% 2)\npass"), ("{[1\n% 2]}\n%a", "{[1\n% 2]}\npass"),
        (")\n%a", ")\npass"), ("# ( '\n%a", "# ( '\npass"), ("'('\n%a", "'('\npass"), ('"\\"("\n%a', '"\\"("\npass'),
        ("x = \\\n% 3\n%a", "x = \\\n% 3\npass"), ("'''\n%a\\'''\n'''\n%b", "'''\n%a\\'''\n'''\npass"),
        ('"""\n%a\n"""; x\n%b', '"""\n%a\n"""; x\npass'), ("'''\n%a", "'''\n%a"),
    ],
)  # fmt: skip
def test_a_magic_is_taken_out_where_a_statement_begins_and_nowhere_else(cell, python):
    assert without_magics(cell) == python


@given(
    st.lists(
        st.sampled_from(["%a\n", "!b (\n", "c?\n", "x = (1,\n", "% 2)\n", "'''\n", "\\\n", "#(\n", "pass\n", "\n"])
    )
)
def test_taking_out_magics_keeps_every_line_number(lines):
    source = "".join(lines)
    assert without_magics(source).count("\n") == source.count("\n")


def test_the_last_of_several_definitions_counts_and_is_said(tmp_path):
    wrong, right = "def rebound_velocity(v, e): return 0.0", "def rebound_velocity(v, e): return -e * v"
    submission = handed_in(tmp_path, notebook(wrong, "x = 1\n" + right))
    assert defined(submission)["rebound_velocity"](-2.0, 0.5) == 1.0
    assert "rebound_velocity is defined 2 times; the one at code cell 2, line 2 counts" in told(submission)


@pytest.mark.parametrize("made_for_it", [tagged, None])
def test_the_cell_made_for_a_function_comes_before_a_later_copy(made_for_it, tmp_path):
    right, wrong = "def rebound_velocity(v, e): return -e * v", "def rebound_velocity(v, e): return 0.0"
    cell = tagged(right, "rebound_velocity")
    if made_for_it is None:  # as nbgrader names it
        cell["metadata"] = {"nbgrader": {"grade_id": "rebound_velocity", "solution": True}}
    submission = handed_in(tmp_path, notebook(cell, wrong))
    assert defined(submission)["rebound_velocity"](-2.0, 0.5) == 1.0
    assert "the one at code cell 1, line 1 counts" in told(submission)


def test_a_missing_and_an_imported_function_are_named(tmp_path):
    submission = handed_in(tmp_path, "from solutions.impulse import rebound_velocity\n", "lab.py")
    assert submission.functions == ()
    assert told(submission) == "line 1: rebound_velocity is imported, not written\nnormal_velocity is missing"


def test_a_syntax_error_costs_its_cell_alone_and_is_placed(tmp_path):
    broken = "x = 1\ndef rebound_velocity(v, e:\n    return 1"
    submission = handed_in(tmp_path, notebook("import numpy as np", broken, BOTH.split("\n\n\n")[1]))
    assert submission.functions == ("normal_velocity",)
    assert "code cell 2, line 2: Python cannot read 'def rebound_velocity(v, e:'" in told(submission)


@pytest.mark.parametrize(
    ("names", "effect"),
    [("", ""), ("a", "; so a cannot be read"), ("abc", "; so a, b, c cannot be read"),
     ("abcd", "; so a, b, c … cannot be read")],
)  # fmt: skip
def test_what_a_syntax_error_costs_is_said(names, effect, tmp_path):
    source = "".join(f"def {name}(): pass\n" for name in names) + "x = )"
    first = told(handed_in(tmp_path, source, "lab.py")).splitlines()[0]
    assert first == f"line {len(names) + 1}: Python cannot read 'x = )': unmatched ')'{effect}"


@pytest.mark.parametrize("error", [RecursionError, MemoryError, ValueError])
def test_what_is_too_deep_for_python_is_said(error, tmp_path, monkeypatch):
    def groups(source):
        raise error

    monkeypatch.setattr(reading, "groups", groups)
    found = handed_in(tmp_path, notebook(BOTH))
    assert told(found).splitlines()[0] == "code cell 1: Python cannot read this: too deeply nested"
    assert found.functions == ()


def test_an_error_line_leads_back_to_the_cell(tmp_path):
    submission = handed_in(tmp_path, notebook("# one\n", {"cell_type": "markdown", "source": "words"}, "\n\n" + BOTH))
    line = submission.text.splitlines().index("def rebound_velocity(v, e):") + 1
    assert submission.where(line) == "code cell 2, line 3"


@pytest.mark.parametrize(
    ("encoded", "complaint"),
    [
        (("# Ångström\n" + BOTH).encode("utf-8-sig"), ""),
        (("# Ångström\n" + BOTH).replace("\n", "\r\n").encode(), ""),
        (("# Ångström\n" + BOTH).replace("\n", "\r").encode(), ""),
        (("# coding: latin-1\n# Ångström\n" + BOTH).encode("latin-1"), ""),
        (("\n\n# Ångström\n" + BOTH).encode("latin-1"), "not UTF-8"),
        (("# coding: klingon\n" + BOTH).encode(), ""),
        (("# coding: punycode\n" + BOTH).encode(), ""),
        (("# Ångström\n" + BOTH).encode("utf-16"), "UTF-16"),
    ],
    ids=["mark", "CRLF", "CR", "declared latin-1", "latin-1", "unknown", "slow codec", "UTF-16"],
)
@pytest.mark.parametrize("name", ["lab.py", "lab.ipynb"])
def test_encodings_and_line_ends_are_coped_with_and_odd_ones_said(encoded, complaint, name, tmp_path):
    if name == "lab.ipynb":
        encoding = "utf-16" if complaint == "UTF-16" else "latin-1" if complaint else "utf-8-sig"
        text = json.dumps({"cells": [{"cell_type": "code", "source": "# Ångström\r\n" + BOTH}]}, ensure_ascii=False)
        encoded = ("\n\n" + text).encode(encoding)
    submission = handed_in(tmp_path, encoded, name)
    assert submission.functions == WANTED
    assert complaint in told(submission)
    assert bool(submission.complaints) == bool(complaint)


@pytest.mark.parametrize(
    "content",
    [
        json.dumps({"nbformat": 3, "worksheets": [{"cells": [{"cell_type": "code", "input": BOTH.splitlines(True)}]}]}),
        json.dumps({"cells": [{"cell_type": "code", "source": BOTH.splitlines(True), "metadata": None}]}),
        json.dumps({"cells": [None, 3, {"cell_type": "code"}, {"cell_type": "code", "source": [BOTH, 7, None]}]}),
        notebook("", "# nothing\n", BOTH, {"cell_type": "raw", "source": "def ("}),
        notebook(tagged(BOTH, "a", "b") | {"metadata": {"tags": "no list", "nbgrader": []}}),
        notebook({"cell_type": "code", "source": BOTH, "outputs": [{"data": {"text/html": ["<b>" * 10_000]}}]}),
    ],
    ids=["format 3", "no metadata", "broken cells", "empty cells", "odd tags", "outputs"],
)
def test_odd_notebooks_are_read(content, tmp_path):
    assert handed_in(tmp_path, content).functions == WANTED


def test_half_a_character_costs_its_cell_alone(tmp_path):
    submission = handed_in(tmp_path, notebook(BOTH, "x = '\ud800'"))
    assert submission.functions == WANTED
    assert told(submission) == "code cell 2: Python cannot read this: it holds half a character"


@pytest.mark.parametrize(
    ("name", "content", "line"),
    [
        ("lab.py", b"", "it is empty"),
        ("lab.py", b" \n\n", "it is empty"),
        ("lab.ipynb", notebook("", " \n"), "it holds no code"),
        ("lab.ipynb", b"not json", "it is not a notebook"),
        ("lab.ipynb", b'{"cells": 3}', "it has no cells"),
        ("lab.ipynb", b"[1, 2]", "it has no cells"),
        ("lab.ipynb", b'{"worksheets": [{"cells": 5}, 3, {"cells": [4]}]}', "it holds no code"),
        ("lab.ipynb", b'{"cells": ' + b"[" * 100_000, "it is not a notebook"),
        ("lab.ipynb", notebook(BOTH)[:-20], "it is not a notebook"),
        ("lab.ipynb", b'{\n"cells": [\n<<<<<<< HEAD\n1\n=======\n>>>>>>> x\n]}', "line 3: a merge left its marks"),
        ("lab.py", b"%PDF-1.7 \xff", "a PDF"),
        ("lab.py", b"PK\x03\x04docx", "a zip archive"),
        ("lab.ipynb", b"\n<!DOCTYPE HTML><p>", "a web page"),
        ("lab.py", b"x = 1\0\n", "it is not a text file"),
        ("lab.txt", BOTH.encode(), "hand in a .ipynb or a .py file"),
        ("lab", BOTH.encode(), "hand in a .ipynb or a .py file"),
        ("lab.py", b"# " + b"x" * 2**18, "more than 262144 characters of code"),
        ("lab.py", b'f"' + b"{x}" * 20_000 + b'"', "more than 10000 opening braces"),
        ("la\nb\x1b[2J.py", b"", "la b␛[2J.py: it is empty"),
    ],
)
def test_a_file_without_a_submission_is_refused_in_one_line(name, content, line, tmp_path):
    with pytest.raises(UnreadableSubmission, match=re.escape(line)) as refused:
        handed_in(tmp_path, content, name)
    assert "\n" not in str(refused.value)


def test_a_file_may_be_as_large_as_the_limits_and_no_larger(tmp_path):
    (tmp_path / "lab.py").write_text(BOTH + "#" * (FILE_LIMIT - len(BOTH)))
    with pytest.raises(UnreadableSubmission, match=f"it holds more than {CODE_LIMIT} characters of code"):
        read(tmp_path / "lab.py", WANTED)
    (tmp_path / "lab.py").write_text(BOTH + "#" * (FILE_LIMIT - len(BOTH) + 1))
    with pytest.raises(UnreadableSubmission, match="it has 10 MB, and at most 10 are read"):
        read(tmp_path / "lab.py", WANTED)
    assert handed_in(tmp_path, BOTH + "#" * (CODE_LIMIT - len(BOTH)), "lab.py").functions == WANTED
    with pytest.raises(UnreadableSubmission, match="more than"):
        handed_in(tmp_path, BOTH + "#" * (CODE_LIMIT - len(BOTH) + 1), "lab.py")
    assert handed_in(tmp_path, notebook(BOTH, *["x"] * (CELL_LIMIT - 1))).functions == WANTED
    with pytest.raises(UnreadableSubmission, match=f"it has {CELL_LIMIT + 1} code cells, and at most {CELL_LIMIT}"):
        handed_in(tmp_path, notebook(BOTH, *["x"] * CELL_LIMIT))


def test_a_missing_file_a_folder_a_pipe_and_a_link_are_refused(tmp_path):
    (tmp_path / "folder.py").mkdir()
    os.mkfifo(tmp_path / "pipe.py")
    (tmp_path / "secret.py").write_text("the expected value is 42")
    (tmp_path / "link.py").symlink_to(tmp_path / "secret.py")
    for name, line in (
        ("none", "No such file"),
        ("folder", "folder"),
        ("pipe", "not a file"),
        ("link", "symbolic link"),
    ):
        with pytest.raises(UnreadableSubmission, match=line):
            read(tmp_path / f"{name}.py", WANTED)


def test_a_notebook_of_a_hundred_megabytes_is_refused_without_being_read(tmp_path):
    path = tmp_path / "lab.ipynb"
    with path.open("wb") as file:
        file.truncate(100 * 2**20)
    tracemalloc.start()
    with pytest.raises(UnreadableSubmission, match=r"it has 100 MB, and at most 10 are read: clear"):
        read(path, WANTED)
    assert tracemalloc.get_traced_memory()[1] < 2**20
    tracemalloc.stop()


def test_a_merge_mark_is_named_with_its_line(tmp_path):
    source = BOTH + "<<<<<<< HEAD\nx = 1\n=======\nx = 2\n>>>>>>> theirs\n"
    submission = handed_in(tmp_path, source, "lab.py")
    assert "line 7: a merge left its mark '<<<<<<<': choose one version; so rebound_velocity, " in told(submission)
    assert submission.functions == ()
    assert submission.unread == WANTED


@pytest.mark.parametrize(
    ("name", "near"),
    [("reboundVelocity", True), ("rebound_velocty", True), ("rebound", False), ("velocity_of_sound", False)],
)
def test_a_name_that_is_nearly_the_wanted_one_is_told(name, near, tmp_path):
    submission = handed_in(tmp_path, f"def {name}(v, e):\n    return -e * v\n", "lab.py")
    assert (f"line 1: is {name} meant to be rebound_velocity?" in told(submission)) == near


def test_a_function_uses_what_it_calls_itself_or_by_way_of_what_else_it_needs(tmp_path):
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


def test_a_notebook_under_another_name_is_read_and_it_is_said(tmp_path):
    submission = handed_in(tmp_path, notebook(BOTH), "lab.py")
    assert submission.functions == WANTED
    assert told(submission) == "it is a notebook, though its name ends in .py"


@pytest.mark.parametrize(
    "source",
    [
        "x = " + "-" * 50_000 + "1",
        "x = 1" + "+1" * 50_000,
        "x = " + "(" * 5000 + ")" * 5000,
        "x = a" + ".b" * 50_000,
        "x = " + "lambda: " * 30_000 + "1",
        "if 1: pass\n" + "elif 1: pass\n" * 20_000,
        "".join(" " * depth + "def f():\n" for depth in range(90)) + " " * 90 + "pass",
        "def f(): pass\n" * 2_000,
        "def rebound_velocity(v, e): return 0\n" * 2_000,
        "".join(f"a{i} = a{i + 1}\n" for i in range(2_000)) + "def normal_velocity(): return a0",
        "%" * 50_000 + "\n?" * 20_000,
        " " * 200_000 + "x)",
        "\\'" * 100_000 + ")",
        "%%time\n" * 30_000 + ")",
        'f"' + "{x}" * 9_000 + '"',
    ],
    ids=lambda source: source[:12],
)
def test_source_that_no_person_writes_harms_nothing(source, tmp_path):
    (tmp_path / "lab.py").write_text(f"{source}\n{BOTH}")
    code = f"from labs.grading.submission.reading import read; read({str(tmp_path / 'lab.py')!r}, {WANTED})"
    ran = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
        cwd=Path(__file__).parents[4],
    )
    assert ran.returncode == 0, ran.stderr[-500:]
