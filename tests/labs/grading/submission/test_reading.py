"""What a submission defines, which of several definitions counts, and what is said of the rest."""

from __future__ import annotations

import pytest
from submissions import BOTH, WANTED, defined, handed_in, notebook, tagged, told

from labs.grading.submission import reading


@pytest.mark.parametrize("name", ["lab.py", "lab.ipynb"])
def test_functions_are_read_whole_and_without_complaint(name, tmp_path):
    content = BOTH if name.endswith("py") else notebook(*BOTH.split("\n\n\n"))
    submission = handed_in(tmp_path, content, name)
    assert submission.functions == WANTED
    assert submission.complaints == ()
    assert defined(submission)["rebound_velocity"](-2.0, 0.5) == 1.0


def test_the_last_of_several_definitions_counts_with_a_complaint(tmp_path):
    wrong, right = "def rebound_velocity(v, e): return 0.0", "def rebound_velocity(v, e): return -e * v"
    submission = handed_in(tmp_path, notebook(wrong, "x = 1\n" + right))
    assert defined(submission)["rebound_velocity"](-2.0, 0.5) == 1.0
    assert "rebound_velocity is defined 2 times; the one at code cell 2, line 2 counts" in told(submission)


@pytest.mark.parametrize("made_for_it", [tagged, None])
def test_the_cell_made_for_a_function_counts_before_a_later_copy(made_for_it, tmp_path):
    right, wrong = "def rebound_velocity(v, e): return -e * v", "def rebound_velocity(v, e): return 0.0"
    cell = tagged(right, "rebound_velocity")
    if made_for_it is None:  # as nbgrader names it
        cell["metadata"] = {"nbgrader": {"grade_id": "rebound_velocity", "solution": True}}
    submission = handed_in(tmp_path, notebook(cell, wrong))
    assert defined(submission)["rebound_velocity"](-2.0, 0.5) == 1.0
    assert "the one at code cell 1, line 1 counts" in told(submission)


FIRST, SECOND = "def rebound_velocity(v, e): return 0.0", "def rebound_velocity(v, e): return -e * v"
AGAIN = 'def rebound_velocity(v, e):\n    """Rebound."""\n    raise NotImplementedError("it is yours to write again")'


@pytest.mark.parametrize(
    ("second", "speed"), [(SECOND, 1.0), (AGAIN, 0.0), (f"{AGAIN}\n\n{SECOND}", 1.0)], ids=["written", "stub", "both"]
)
def test_a_first_version_counts_until_the_second_is_written(tmp_path, second, speed):
    cells = tagged(FIRST, "draft-rebound_velocity"), tagged(second, "rebound_velocity")
    submission = handed_in(tmp_path, notebook(*cells))
    assert defined(submission)["rebound_velocity"](-2.0, 0.5) == speed
    assert "defined" not in told(submission)
    in_a_kernel = handed_in(tmp_path, notebook(FIRST, second))  # where cells have no tags
    assert defined(in_a_kernel)["rebound_velocity"](-2.0, 0.5) == speed


BEGUN = 'def rebound_velocity(v, e):\n    u = v\n    {}raise NotImplementedError("a first version of it is yours")'


@pytest.mark.parametrize(("ending", "speed"), [("", 0.0), ("return 3\n    ", 3)], ids=["open", "written"])
def test_a_version_with_lines_to_begin_with_counts_once_it_returns(tmp_path, ending, speed):
    cells = tagged(FIRST, "draft-rebound_velocity"), tagged(BEGUN.format(ending), "draft-rebound_velocity")
    submission = handed_in(tmp_path, notebook(*cells, tagged(AGAIN, "rebound_velocity")))
    assert defined(submission)["rebound_velocity"](-2.0, 0.5) == speed
    assert "defined" not in told(submission)


def test_a_stub_after_a_function_counts_if_it_asks_for_no_second_version(tmp_path):
    submission = handed_in(tmp_path, notebook(SECOND, AGAIN.replace(" again", "")))
    with pytest.raises(NotImplementedError):
        defined(submission)["rebound_velocity"](-2.0, 0.5)


def test_a_missing_and_an_imported_function_are_named(tmp_path):
    submission = handed_in(tmp_path, "from solutions.impulse import rebound_velocity\n", "lab.py")
    assert submission.functions == ()
    assert told(submission) == "line 1: rebound_velocity is imported, not written\nnormal_velocity is missing"


def test_a_syntax_error_costs_only_its_cell_and_names_its_line(tmp_path):
    broken = "x = 1\ndef rebound_velocity(v, e:\n    return 1"
    submission = handed_in(tmp_path, notebook("import numpy as np", broken, BOTH.split("\n\n\n")[1]))
    assert submission.functions == ("normal_velocity",)
    assert "code cell 2, line 2: Python cannot read 'def rebound_velocity(v, e:'" in told(submission)


@pytest.mark.parametrize(
    ("names", "effect"),
    [("", ""), ("a", ". Until then a cannot be checked."), ("abc", ". Until then a, b and c cannot be checked."),
     ("abcde", ". Until then a, b, c and 2 more cannot be checked.")],
)  # fmt: skip
def test_a_syntax_error_names_the_functions_it_costs(names, effect, tmp_path):
    source = "".join(f"def {name}(): pass\n" for name in names) + "x = )"
    first = told(handed_in(tmp_path, source, "lab.py")).splitlines()[0]
    closes = "the bracket ) closes nothing: delete it, or add the one that it closes"
    assert first == f"line {len(names) + 1}: Python cannot read 'x = )': {closes}{effect}"


def test_a_cell_that_cannot_be_read_says_which_earlier_cell_counts(tmp_path):
    submission = handed_in(tmp_path, notebook(BOTH, BOTH.replace("-e * v", "-e * (v")))
    assert submission.functions == WANTED
    assert told(submission).endswith("Until then code cell 1 counts for rebound_velocity and normal_velocity.")


def test_of_two_thousand_broken_cells_five_are_quoted_and_the_others_counted(tmp_path):
    submission = handed_in(tmp_path, notebook(BOTH, *["x = = 3"] * 1999))
    assert submission.functions == WANTED
    assert len(submission.complaints) == 6
    assert told(submission).endswith("\nand 1994 more cells that Python cannot read")


@pytest.mark.parametrize("error", [RecursionError, MemoryError, ValueError])
def test_source_too_deep_for_python_is_reported(error, tmp_path, monkeypatch):
    def groups(source):
        raise error

    monkeypatch.setattr(reading, "groups", groups)
    found = handed_in(tmp_path, notebook(BOTH))
    assert told(found).startswith("code cell 1: Python cannot read this: too deeply nested. Until then")
    assert found.functions == ()


def test_an_error_line_leads_back_to_the_cell(tmp_path):
    submission = handed_in(tmp_path, notebook("# one\n", {"cell_type": "markdown", "source": "words"}, "\n\n" + BOTH))
    line = submission.text.splitlines().index("def rebound_velocity(v, e):") + 1
    assert submission.where(line) == "code cell 2, line 3"


@pytest.mark.parametrize(
    ("name", "near"),
    [("reboundVelocity", True), ("rebound_velocty", True), ("rebound", False), ("velocity_of_sound", False)],
)
def test_a_misspelt_function_name_is_pointed_out(name, near, tmp_path):
    submission = handed_in(tmp_path, f"def {name}(v, e):\n    return -e * v\n", "lab.py")
    assert (f"line 1: is {name} meant to be rebound_velocity?" in told(submission)) == near


@pytest.mark.parametrize(
    ("source", "line"),
    [
        ("def outer(v):\n    return v\n\n    def rebound_velocity(v, e):\n        return -e * v\n",
         "line 4: rebound_velocity is inside the function outer, where nothing else finds it: move it"),
        ("class Lab:\n    def rebound_velocity(self, v, e):\n        return -e * v\n",
         "line 2: rebound_velocity is inside the class Lab, where nothing else finds it: move it"),
        ("def rebound_velocity(v, e):\n    v = -v\nreturn e * v\n",
         "line 3: this return is outside of every function: if it belongs to rebound_velocity, indent it"),
        ("return 3\n" + BOTH, "line 1: this return is outside of every function\n"),
    ],
)  # fmt: skip
def test_lines_that_are_out_of_place_are_named(source, line, tmp_path):
    assert line in told(handed_in(tmp_path, source, "lab.py")) + "\n"


def test_a_function_in_a_cell_of_text_is_named(tmp_path):
    first, second = BOTH.split("\n\n\n")
    submission = handed_in(tmp_path, notebook("x = 1", {"cell_type": "markdown", "source": first}, second))
    assert submission.functions == ("normal_velocity",)
    assert "rebound_velocity is in a cell of text after code cell 1: select that cell, and press" in told(submission)
    quoted = {"cell_type": "markdown", "source": f"```\n{first}\n```"}
    assert told(handed_in(tmp_path, notebook(quoted, second))) == "rebound_velocity is missing"


def test_a_letter_that_only_looks_like_the_right_one_is_named(tmp_path):
    submission = handed_in(tmp_path, BOTH.replace("rebound_velo", "rebound_vel\u03bf"), "lab.py")
    assert "counts under that name alone, and \u03bf (U+03BF) is another letter" in told(submission)


@pytest.mark.parametrize(
    ("later", "same"),
    [
        ("def rebound_velocity(v, e):  # as before\n\n    return SIGN*e*v", True),
        ("SIGN = -1", True),
        ("def normal_velocity(n, u): return 0", True),
        ("def rebound_velocity(v, e): return SIGN * v * e", False),
        ("def rebound_velocity(v, e): return sign() * e * v\ndef sign(): return -1", False),
    ],
)
def test_the_code_of_a_function_changes_with_what_it_is_made_of_alone(later, same, tmp_path):
    first = ["SIGN = -1", "def rebound_velocity(v, e):\n    return SIGN * e * v", BOTH.split("\n\n\n")[1]]
    code = handed_in(tmp_path, notebook(*first)).code_of("rebound_velocity")
    assert (handed_in(tmp_path, notebook(*first, later)).code_of("rebound_velocity") == code) == same


@pytest.mark.parametrize("first", ["    ", "\t", ">>> "])
def test_a_cell_that_was_copied_with_its_margin_is_read_as_the_kernel_reads_it(first, tmp_path):
    lines = BOTH.splitlines(keepends=True)
    rest = "... " if first == ">>> " else first
    submission = handed_in(tmp_path, notebook("".join([first + lines[0], *(rest + line for line in lines[1:])])))
    assert defined(submission)["rebound_velocity"](-2.0, 0.5) == 1.0
    assert submission.where(6) == "code cell 1, line 6"


CALLER = "def rebound_velocity(v, e):\n    return v + halved(e) * spin"


@pytest.mark.parametrize(
    ("cells", "borrowed"),
    [
        (("halved = 3\nspin = 2", "def halved(e): return e / 2", CALLER), {"spin"}),
        (("halved = lambda e: e / 2\nspin = 2", CALLER), {"spin"}),
        (("halved = spin = 2", "def halved(e): return e / 2\ndef spin(): pass", CALLER), set()),
    ],
    ids=["a helper of that name comes later", "a helper is a value", "all are functions in the end"],
)
def test_no_helper_counts_as_a_variable_of_another_cell(cells, borrowed, tmp_path):
    assert set(handed_in(tmp_path, notebook(*cells)).borrows("rebound_velocity")) == borrowed


@pytest.mark.parametrize(
    ("head", "said"),
    [
        ("import helpers\nS = helpers.sign", "line 1: helpers is not there where this is graded, only NumPy and"),
        ("from physics_utils.signs import S", "line 1: physics_utils is not there where this is graded"),
        ("x = 1\nimport scipy.constants as S", "line 2: scipy is not there where this is graded"),
        ("from mine import *\nT = SIGN", "line 1: mine is not there where this is graded"),
        ("from pathlib import Path\nS = Path(__file__).parent", "line 2: __file__ is not defined where this is graded"),
        ("def S():\n    return open(__file__)", "line 1: __file__ is not defined where this is graded"),
        ("import os\nS = os.path.dirname(__file__)", "line 2: __file__ is not defined"),
    ],
)
def test_what_is_not_there_where_it_is_graded_is_named(head, said, tmp_path):
    source = f"{head}\n\n{BOTH.replace('-e * v', 'S * e * v')}"
    assert told(handed_in(tmp_path, source, "lab.py")).startswith(said)


@pytest.mark.parametrize(
    "head",
    ["import matplotlib.pyplot as plt\nplt.plot([1])", "try:\n    import numba\nexcept ImportError:\n    pass",
     "import numpy.linalg, json, heapq", "from mine import helper\nhelper = 1", "print(__file__)", "from mine import *",
     "import plots\nax = plots.axes()\nT = []\nfor n in (1, 2):\n    ax.plot(n)\n    T.append(n)",
     "from labs import lab\nlab.begin('impulse')"],
)  # fmt: skip
def test_what_no_function_needs_may_be_absent(head, tmp_path):
    assert told(handed_in(tmp_path, f"{head}\n\n{BOTH}", "lab.py")) == ""


@pytest.mark.parametrize("number", ["0x" + "f" * 4000, "0b" + "1" * 15_000, "0o" + "7" * 5000, "9" * 5000])
def test_a_number_that_python_cannot_write_is_named_with_its_line(number, tmp_path):
    found = handed_in(tmp_path, f"x = 1\ny = {number}\n{BOTH}", "lab.py")
    assert told(found).startswith("line 2: Python cannot read 'y = ")
    assert "this number has more than 4300 digits" in told(found)
    assert found.functions == ()


@pytest.mark.parametrize("number", ["0x" + "f" * 3000, "10 ** 5000", "1e300", f"'{'0x' + 'f' * 5000}'"])
def test_a_number_that_python_can_write_is_read(number, tmp_path):
    assert told(handed_in(tmp_path, f"x = 1\ny = {number}\n{BOTH}", "lab.py")) == ""


@pytest.mark.parametrize(
    "long", [" + ".join(["e"] * 700), "e" + ".real" * 700, "".join(f"{n} if e == {n} else " for n in range(300)) + "e"]
)
def test_an_expression_of_hundreds_of_parts_is_read_like_any_other(long, tmp_path):
    source = (
        f"def rebound_velocity(v, e):\n    return {long}\ndef normal_velocity(n, u):\n    raise NotImplementedError\n"
    )
    submission = handed_in(tmp_path, source, "lab.py")
    assert submission.functions == ("rebound_velocity", "normal_velocity")
    assert long[:40] in submission.code_of("rebound_velocity")


def test_of_too_many_statements_none_is_read(tmp_path):
    found = handed_in(tmp_path, "x = 1\n" * 20_000 + BOTH, "lab.py")
    assert "20000 statements outside of functions end here" in told(found)
