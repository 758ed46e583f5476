"""Of several files the one about the lab is graded, whatever they are called, and what is doubtful gets a line."""

from __future__ import annotations

import time
import zipfile
from pathlib import Path

import pytest
from submissions import notebook, solved_notebook

from labs.gradebook import subject
from labs.gradebook.arrivals import arrivals, content_of
from labs.gradebook.subject import Subject, subject_of
from labs.project_folders import STUDENT_NOTEBOOKS
from reference import lecture

WANTED = [entry.name for entry in lecture.functions_of("impulse") if entry.role == "written"]
STUB = "def {}(*given):\n    'What it does.'\n    raise NotImplementedError('it is yours to write')\n"
BEGIN = "from labs import lab\nlab.begin('impulse')"
FULL = notebook(BEGIN, *(f"def {each}(*given):\n    return sum(given)\n" for each in WANTED))
HALF = notebook(BEGIN, *(f"def {each}(*given):\n    return 1\n" for each in WANTED[:5]))
OPEN = notebook(BEGIN, *map(STUB.format, WANTED))
OTHER = notebook('from labs import lab\nlab.begin("response")', f"def {WANTED[0]}(u):\n    return u\n")
COPIES = notebook('lab.begin("response")', *(f"def {each}(*given):\n    return 1\n" for each in WANTED[:5]))
CUT = FULL[:300]
PLOT = b"def plot(run):\n    print(run)\n"
ONE = f"def {WANTED[0]}(n, u):\n    return 0\n".encode()
ALL = "".join(f"def {each}(*given):\n    return 1\n" for each in WANTED).encode()


def test_what_each_file_is_about():
    files = {"a.ipynb": FULL, "b.ipynb": OPEN, "c.ipynb": OTHER, "d.ipynb": COPIES, "e.ipynb": CUT, "f.py": PLOT}
    found = {name: subject_of(raw, name, "impulse") for name, raw in files.items()}
    assert [look.subject for look in found.values()] == [
        Subject.WRITTEN, Subject.UNTOUCHED, Subject.OTHER, Subject.WRITTEN, Subject.DAMAGED, Subject.UNKNOWN,
    ]  # fmt: skip
    assert [look.said for look in found.values()] == [
        "", "", "begins the lab response and defines 1 of the 8 functions of impulse",
        "begins the lab response and defines 5 of the 8 functions of impulse", "",
        "does not begin the lab impulse and defines no function of it",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("raw", "name", "kind"),
    [
        (b"# lab.begin('response')\nlab . begin( 'impulse' )\n", "x.py", Subject.UNTOUCHED),
        (b"x = 1\n", "impulse.py", Subject.UNKNOWN),
        (f"{WANTED[0]} = lambda n, u: 1\n".encode(), "x.py", Subject.WRITTEN),
        (f"def {WANTED[0]}(n, u):\n    return (n\n".encode(), "x.py", Subject.WRITTEN),
        (f"%%time\ndef {WANTED[0]}(n, u):\n    return n\n".encode("utf-16"), "x.py", Subject.WRITTEN),
        (f"class Ball:\n    def {WANTED[0]}(self):\n        return 1\n".encode(), "x.py", Subject.UNKNOWN),
        (notebook({"cell_type": "markdown", "source": "lab.begin('impulse')", "metadata": {}}, "x = 1"), "x.ipynb",
         Subject.UNKNOWN),
        (notebook(*(BEGIN, 'lab.begin("response")', "x = 1")), "x.ipynb", Subject.UNTOUCHED),
        (b"", "x.ipynb", Subject.UNKNOWN),
        (b"\0" * 99, "x.ipynb", Subject.UNKNOWN),
    ],
)  # fmt: skip
def test_a_file_is_about_a_lab_by_its_code_alone(raw, name, kind):
    assert subject_of(raw, name, "impulse").subject is kind


@pytest.mark.parametrize("topic", ["impulse", "response", "meshes"])
def test_the_projects_notebooks_are_each_about_their_lab(topic):
    for path in STUDENT_NOTEBOOKS.glob("*.ipynb"):
        for content, kind in ((solved_notebook(path.stem), Subject.WRITTEN), (path.read_bytes(), Subject.UNTOUCHED)):
            found = subject_of(content, path.name, topic)
            assert found.subject is (kind if path.stem == topic else Subject.OTHER)


@pytest.mark.parametrize(
    ("files", "graded", "said"),
    [
        ({"impulse-response.ipynb": OTHER, "Untitled.ipynb": FULL}, "Untitled.ipynb", ["it holds"]),
        ({"response.ipynb": OTHER}, "response.ipynb", ["begins the lab response and defines 1 of the 8"]),
        ({"impulse.ipynb": OTHER}, "impulse.ipynb", ["begins the lab response"]),
        ({"impulse.py": PLOT, "Lab5.ipynb": FULL}, "Lab5.ipynb", ["it holds"]),
        ({"impulse.py": ONE, "Untitled.ipynb": FULL}, "Untitled.ipynb", ["it holds"]),
        ({"impulse_plots.py": PLOT, "Lab5.ipynb": HALF}, "Lab5.ipynb", ["it holds"]),
        ({"Lab5.ipynb": FULL, "response.ipynb": OTHER}, "Lab5.ipynb", []),
        ({"Untitled.ipynb": FULL, "Untitled1.ipynb": OPEN}, "Untitled.ipynb", ["it holds"]),
        ({"impulse.ipynb": OPEN, "Untitled1.ipynb": HALF}, "Untitled1.ipynb", ["it holds"]),
        ({"impulse.ipynb": HALF, "Untitled1.ipynb": FULL}, "impulse.ipynb", ["it holds"]),
        ({"impulse.ipynb": CUT, "copy.ipynb": FULL}, "copy.ipynb", ["it holds"]),
        ({"impulse.ipynb": CUT, "copy.ipynb": OPEN}, "impulse.ipynb", ["it holds"]),
        ({"impulse.ipynb": FULL, "response.ipynb": OTHER, "plots.py": PLOT}, "impulse.ipynb", []),
        ({"impulse.ipynb": FULL, "impulse.py": ALL}, "impulse.ipynb", ["it holds"]),
        ({"impulse.py": PLOT, "response.ipynb": OTHER}, "impulse.py", ["it holds", "defines no function of it"]),
        ({"response.ipynb": OTHER, "forces.ipynb": PLOT}, "", []),
        ({"plots.py": PLOT, "response.ipynb": OTHER}, "", []),
    ],
)
@pytest.mark.parametrize("is_canvas", [True, False])
def test_the_file_about_the_lab_is_graded_whatever_it_is_called(tmp_path, files, graded, said, is_canvas):
    for place, (name, content) in enumerate(files.items()):
        path = tmp_path / (f"ada_7_{100 + place}_{name}" if is_canvas else f"ada/{name}")
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(content)
    there, missing = arrivals(tmp_path, "impulse")
    assert [each.owner.file or each.file for each in there] == [graded] * bool(graded)
    assert [each.why.endswith("and none is named impulse") for each in missing] == [True] * (not graded)
    for each in there:
        assert content_of(each) == files[graded]
        assert len(each.notes) == len(said)
        assert all(words in note for words, note in zip(said, each.notes, strict=True))


def test_of_two_that_nothing_tells_apart_the_newest_is_graded_where_the_platform_counts(tmp_path):
    for name in ("a_7_101_one.ipynb", "a_7_99_two.ipynb", "bob/one.ipynb", "bob/two.ipynb"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_bytes(FULL)
    (ada,), (bob,) = arrivals(tmp_path, "impulse")
    assert ada.notes == ("it holds a_7_101_one.ipynb and a_7_99_two.ipynb; a_7_101_one.ipynb is graded",)
    assert bob.why == "it holds one.ipynb and two.ipynb, and none is named impulse"


def test_in_a_whole_tree_the_projects_own_files_are_not_taken_for_the_students(tmp_path):
    for student, own in (("ada", "labs/notebooks/impulse.ipynb"), ("bob", "work.ipynb"), ("eve", "solution.py")):
        tree = {"labs/notebooks/impulse.ipynb": OPEN, "labs/notebooks/response.ipynb": OTHER,
                "labs/assessment/suspects/impulse.py": ONE, own: ALL if own.endswith(".py") else FULL}  # fmt: skip
        with zipfile.ZipFile(tmp_path / f"{student}.zip", "w") as archive:
            for name, content in tree.items():
                archive.writestr(f"lab/{name}", content)
    there, missing = arrivals(tmp_path, "impulse")
    assert [each.file for each in there] == ["lab/labs/notebooks/impulse.ipynb", "lab/work.ipynb", "lab/solution.py"]
    assert [len(each.notes) for each in there] == [0, 1, 1]
    assert missing == []


def test_a_look_costs_little_and_few_files_are_looked_at(tmp_path, monkeypatch):
    outputs = b'{"cells": [' + b'{"outputs": [' + b"[],{}," * 400_000 + b"0]}]}"
    deep = b'{"cells": ' + b"[" * 1_000_000
    began = time.process_time()
    for hostile in (outputs, deep, b"(" * 250_000, b"lab.begin(" * 20_000, f"def {WANTED[0]}(".encode() * 9_000):
        for name in ("x.ipynb", "x.py"):
            assert not subject_of(hostile, name, "impulse").said.startswith("begins")
    assert time.process_time() - began < 5
    monkeypatch.setattr(subject, "MOST_LOOKS", 2)
    for name in ("a.ipynb", "b.ipynb", "c.ipynb"):
        Path(tmp_path / "ada" / name).parent.mkdir(exist_ok=True)
        (tmp_path / "ada" / name).write_bytes(FULL if name == "c.ipynb" else PLOT)
    assert arrivals(tmp_path, "impulse")[0] == []
