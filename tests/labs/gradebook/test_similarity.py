"""A student's own code, for tools that look for copies."""

from __future__ import annotations

import pytest
from submissions import notebook, solved_notebook

from labs.gradebook.similarity import own_code
from labs.project_folders import STUDENT_NOTEBOOKS

GIVEN = "def unit(name, vector):\n"
WRITTEN = '''
import numpy as np

def helper(a):   # mine
    """Mine."""
    return   a

def normal_velocity(body_a, body_b, normal):
    """Slide 15."""
    return helper( np.vecdot(body_a[0], normal) )
'''


def test_only_what_a_student_wrote_is_left_in_one_layout(tmp_path):
    path = tmp_path / "impulse.ipynb"
    path.write_bytes(notebook(WRITTEN, "print(normal_velocity)", "def collide():\n    raise NotImplementedError\n"))
    assert own_code(path, "impulse") == (
        "def helper(a):\n    return a\n\n\n"
        "def normal_velocity(body_a, body_b, normal):\n    return helper(np.vecdot(body_a[0], normal))\n"
    )


def test_what_the_lab_gives_and_what_nobody_wrote_is_left_out(tmp_path):
    assert own_code(STUDENT_NOTEBOOKS / "impulse.ipynb", "impulse") == ""
    (tmp_path / "solved.ipynb").write_bytes(solved_notebook("impulse"))
    solved = own_code(tmp_path / "solved.ipynb", "impulse")
    assert "def collide(" in solved
    assert GIVEN not in solved
    (tmp_path / "broken.py").write_text("def collide(:", encoding="utf-8")
    assert own_code(tmp_path / "broken.py", "impulse") == ""


@pytest.mark.parametrize("literal", ["0b1" + "0" * 100_000, "-0o7" + "1" * 50_000, "[0xA, 0xB" + "C" * 150_000 + "]"])
def test_an_integer_that_python_cannot_write_stops_nobody(tmp_path, literal):
    path = tmp_path / "impulse.py"
    path.write_text(
        f"N = {literal}\n\n\ndef normal_velocity(body_a, body_b, normal):\n    return N\n", encoding="utf-8"
    )
    assert len(own_code(path, "impulse")) < 1000
