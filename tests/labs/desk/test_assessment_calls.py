"""Numbers of one's own, and inputs that expose a wrong function, as a student calls them in a notebook."""

from __future__ import annotations

import pytest
from cells import said

from labs.desk import student_code
from solutions.detection import signed_distance


def test_numbers_are_the_first_ones_until_the_student_is_known(lab, capsys):
    assert lab.numbers("late", e=(0.3, 0.5, 0.7)).e == 0.3
    assert "until lab.student" in capsys.readouterr().out
    drawn = set()
    for name in "abcdefgh":
        lab.student(name)
        drawn.add(lab.numbers("late", e=(0.3, 0.5, 0.7)).e)
    assert drawn == {0.3, 0.5, 0.7}
    assert "several values" in said(capsys, lab.numbers, "late", e=0.5)


def test_an_input_is_tried_on_the_suspect_and_on_ones_own_function(lab, capsys, monkeypatch):
    assert "in place of the dots" in said(capsys, lab.expose, "distance", ...)
    plane = ([0.0, 0.0, 3.0], [0.0, 0.0, 2.0], 4.0)
    assert "Write signed_distance first" in said(capsys, lab.expose, "distance", *plane)
    monkeypatch.setattr(student_code, "defined_now", lambda name: signed_distance)
    assert "✓ Exposed" in (told := said(capsys, lab.expose, "distance", *plane))
    assert "signed_distance gives 5, and your colleague's 7" in " ".join(told.split())
    assert "✗ Not exposed" in said(capsys, lab.expose, "distance", *plane[:2], 0.0)
    assert max(map(len, told.splitlines())) <= 80
    assert "refuses this input" in said(capsys, lab.expose, "distance", plane[0], [0.0, 0.0, 0.0], 1.0)


def bounce(mass, velocity, after):
    """P and v of three steps of a program. after: what v is once P has changed."""
    momentum, found = mass * velocity, []
    for _ in range(3):
        if velocity < 0:
            momentum -= 2 * mass * velocity
            velocity = after(momentum, mass, velocity)
        found.append((momentum, velocity))
    return found


@pytest.mark.parametrize(
    ("after", "words"),
    [
        (lambda p, m, v: p / m, "✓ Mended"),
        (lambda p, m, v: -v, "✓ Mended"),
        (lambda p, m, v: v, "A ball of 2 kg at −3 m/s: after step 0, P = +6 kg m/s and v = −3 m/s."),
        (lambda p, m, v: 3.0, "A ball of 0.5 kg at −4 m/s: after step 0, P = +2 kg m/s and v = +3 m/s."),
        (lambda p, m, v: p / 0, "cannot be tried (ZeroDivisionError"),
    ],
)
def test_a_mended_program_is_tried_with_other_numbers(lab, capsys, after, words):
    lab.topic = "impulse"
    told = said(capsys, lab.mended, "momenta", lambda mass, velocity: bounce(mass, velocity, after))
    assert words in " ".join(told.split())
