"""Magics, shell lines and questions of a notebook are taken out, and every line keeps its number."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from submissions import BOTH, WANTED, defined, handed_in, notebook, told

from labs.grading.submission.magics import without_magics


def test_magics_shell_lines_and_questions_are_removed(tmp_path):
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
        ("%a", "pass"), ("x = 1\n%time y", "x = 1\npass"), ("  !a \\\n  b \\\n  c\nx = 1", "pass\n\n\nx = 1"),
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
def test_a_magic_is_removed_only_where_a_statement_begins(cell, python):
    assert without_magics(cell) == python


@given(
    st.lists(
        st.sampled_from(["%a\n", "!b (\n", "c?\n", "x = (1,\n", "% 2)\n", "'''\n", "\\\n", "#(\n", "pass\n", "\n"])
    )
)
def test_removing_magics_keeps_every_line_number(lines):
    source = "".join(lines)
    assert without_magics(source).count("\n") == source.count("\n")


FUNCTION = "def rebound_velocity(v, e):\n    return -e * v\n"


@pytest.mark.parametrize(
    "magic", ["%%snakeviz", "%%heat -o x.png", "%%scalene --cpu", "%%debug", "\n%%time\n%%mprun -f f"]
)
def test_a_function_below_a_magic_from_elsewhere_is_read(magic, tmp_path):
    submission = handed_in(tmp_path, notebook("x = 1", f"{magic}\n{FUNCTION}"))
    assert defined(submission)["rebound_velocity"](-2.0, 0.5) == 1.0


@pytest.mark.parametrize("magic", ["%%writefile rebound.py", "%%bash", "%%script python3", "%%file x.py", "%%html"])
def test_a_function_below_a_magic_that_takes_it_elsewhere_is_missing_with_the_reason(magic, tmp_path):
    submission = handed_in(tmp_path, notebook("x = 1", f"{magic}\n{FUNCTION}"))
    assert submission.functions == ()
    assert f"code cell 2, line 1: its first line, {magic}, keeps the notebook from defining rebound_velocity" in told(
        submission
    )


@pytest.mark.parametrize("cell", ["%%R\nf <- function(v) v", "%%sql\nselect 1", "%%latex\n$x$", "%%julia\nf(x) = x"])
def test_a_cell_in_another_language_is_left_out_without_a_word(cell, tmp_path):
    assert told(handed_in(tmp_path, notebook(cell, BOTH))) == ""
