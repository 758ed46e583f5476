"""A file becomes cells of source text whatever wrote it, or is refused in one line."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tracemalloc
from pathlib import Path

import pytest
from submissions import BOTH, WANTED, handed_in, notebook, tagged, told

from labs.grading.errors import UnreadableSubmission
from labs.grading.submission.cells import CELL_LIMIT, CODE_LIMIT
from labs.grading.submission.opening import FILE_LIMIT
from labs.grading.submission.reading import read


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
        ((" " * 40 + "\n# Ångström\n" + BOTH).encode("utf-16-le"), "UTF-16"),
        ((" " * 40 + "\n# Ångström\n" + BOTH).encode("utf-16-be"), "UTF-16"),
    ],
    ids=["mark", "CRLF", "CR", "declared latin-1", "latin-1", "unknown", "slow codec", "UTF-16", "no mark", "big end"],
)
@pytest.mark.parametrize("name", ["lab.py", "lab.ipynb"])
def test_encodings_and_line_ends_are_handled_and_odd_ones_reported(encoded, complaint, name, tmp_path):
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
def test_unusual_notebooks_are_read(content, tmp_path):
    assert handed_in(tmp_path, content).functions == WANTED


def test_half_a_character_costs_only_its_cell(tmp_path):
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
        ("lab.ipynb", b'{"cells": ' + b"[" * 100_000, "nested too deeply to be read: save it again in Jupyter"),
        ("lab.ipynb", notebook(BOTH)[:-20], "it is a notebook that is cut off at line 1: save it again in Jupyter"),
        ("lab.ipynb", b'{\n"cells": [}\n', "it is a notebook that is damaged at line 2"),
        ("lab.ipynb", b'{\n"cells": [\n<<<<<<< HEAD\n1\n=======\n>>>>>>> x\n]}', "line 3: a merge left its marks"),
        ("lab.py", b"%PDF-1.7 \xff", "a PDF"),
        ("lab.py", b"PK\x03\x04docx", "a zip archive"),
        ("lab.ipynb", b"\n<!DOCTYPE HTML><p>", "a web page"),
        ("lab.py", b"x = 1\r\ny = 2\0\n", "line 2: a NUL character is in it, so it is not a text file"),
        ("lab.txt", BOTH.encode(), "hand in a .ipynb or a .py file"),
        ("lab", BOTH.encode(), "its name has no ending: hand in a .ipynb or a .py file"),
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
    with pytest.raises(UnreadableSubmission, match="it has 10 MB, and at most 10 are read besides"):
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
        ("none", "none.py: there is no file of this name here"),
        ("folder", "folder.py: it is a folder: name the notebook or .py file in it"),
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
    with pytest.raises(UnreadableSubmission, match=r"it has 100 MB, and at most 10 are read besides outputs"):
        read(path, WANTED)
    assert tracemalloc.get_traced_memory()[1] < 2**20
    tracemalloc.stop()


def test_a_merge_mark_is_named_with_its_line(tmp_path):
    source = BOTH + "<<<<<<< HEAD\nx = 1\n=======\nx = 2\n>>>>>>> theirs\n"
    submission = handed_in(tmp_path, source, "lab.py")
    said = "line 7: a merge left its mark '<<<<<<<': keep one version, and delete all marks. Until then"
    assert f"{said} rebound_velocity and normal_velocity cannot be checked." in told(submission)
    assert submission.functions == ()
    assert submission.unread == WANTED


def test_a_notebook_with_the_suffix_py_is_read_with_a_complaint(tmp_path):
    submission = handed_in(tmp_path, notebook(BOTH), "lab.py")
    assert submission.functions == WANTED
    assert told(submission) == "it is a notebook, though its name ends in .py: rename it to .ipynb"


def test_a_python_file_with_the_suffix_ipynb_is_read_with_a_complaint(tmp_path):
    submission = handed_in(tmp_path, BOTH, "lab.ipynb")
    assert submission.functions == WANTED
    assert told(submission) == "it is a Python file, though its name ends in .ipynb: rename it to .py"


def test_a_suffix_in_capitals_is_a_suffix(tmp_path):
    assert handed_in(tmp_path, BOTH, "LAB.PY").functions == WANTED
    assert handed_in(tmp_path, notebook(BOTH), "LAB.IPYNB").complaints == ()


def test_an_underlined_heading_in_a_text_is_no_mark_of_a_merge(tmp_path):
    submission = handed_in(tmp_path, f'"""\nImpulse\n=======\n"""\n{BOTH}', "lab.py")
    assert submission.functions == WANTED
    assert told(submission) == ""


def test_the_folder_that_stands_for_itself_is_named(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(UnreadableSubmission, match=f"^{tmp_path.name}: it is a folder"):
        read(".", WANTED)


SOURCES = [
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
]
"""Source that no person writes: too deep, too long, or too often the same."""


@pytest.fixture(scope="module")
def harmless(tmp_path_factory) -> tuple[list[int], str]:
    """Which of the sources a process reads, one after another, and what it says in the end."""
    folder = tmp_path_factory.mktemp("sources")
    for place, source in enumerate(SOURCES):
        (folder / f"{place}.py").write_text(f"{source}\n{BOTH}")
    code = f"""
from labs.grading.submission.reading import read
for place in range({len(SOURCES)}):
    read(f"{folder}/{{place}}.py", {WANTED})
    print(place, flush=True)
"""
    root = Path(__file__).parents[4]
    ran = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, timeout=120, check=False, cwd=root
    )
    return [int(place) for place in ran.stdout.split()], ran.stderr[-500:]


@pytest.mark.parametrize("place", range(len(SOURCES)), ids=lambda place: SOURCES[place][:12])
def test_source_that_no_person_writes_is_read_without_harm(place, harmless):
    """One process reads them all: a crash also fails every source after the one that caused it."""
    read_to_the_end, said = harmless
    assert place in read_to_the_end, said
