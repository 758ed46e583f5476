"""Hints, derivations and figures in a notebook: what is shown, and in which order."""

from __future__ import annotations

import pytest
from cells import said

from labs.desk.hints import Text
from labs.guidance import hint_files

HINTS = """
## signed_distance

```derive
s = z - r
s: separation, m
z: height of the centre, m, 0 to 3
r: radius, m, 0.1 to 0.5
```

```derive
w = 2 * z
w: width, m
z: height of the centre, m, 0 to 3
```

### The idea

Above $z = 0$ ![A contact.](figure:contact) and below.

### The next line

Then this.

### The formula

At last.
"""


@pytest.fixture(autouse=True)
def hints_of_detection(tmp_path, monkeypatch):
    monkeypatch.setattr(hint_files, "HINTS", tmp_path)
    (tmp_path / "detection.md").write_text(HINTS, encoding="utf-8")


def test_each_call_reveals_one_level_and_then_helps_with_the_code(lab, monkeypatch):
    asked = []
    monkeypatch.setattr(lab, "_check", lambda names, hint: asked.append((names, hint)))
    for count, (title, text) in enumerate([("idea", "Above"), ("next line", "Then"), ("formula", "At last")], 1):
        lab.shown.clear()
        lab.hint("signed_distance")
        shown = "\n".join(map(str, lab.shown))
        assert f"**signed_distance, hint {count} of 3: the {title}**" in shown
        assert text in shown
        assert asked == []
    assert "shows help with your own code." in shown
    lab.hint("signed_distance")
    assert asked == [(("signed_distance",), True)]


def test_a_figure_in_a_hint_is_an_output_between_its_texts(lab):
    lab.hint("signed_distance")
    before, figure, after = lab.shown
    assert before._repr_mimebundle_()["text/markdown"].endswith("Above $z = 0$")
    assert figure._repr_mimebundle_()["text/plain"] == "[Figure: A contact.]"
    assert isinstance(after, Text)


def test_a_function_without_hints_gets_help_with_its_code(lab, monkeypatch):
    asked = []
    monkeypatch.setattr(lab, "_check", lambda names, hint: asked.append(names))
    lab.hint("side_of_plane")
    assert asked == [("side_of_plane",)]


def test_derive_says_what_is_asked_for_and_what_it_is_made_of(lab, capsys):
    found = said(capsys, lab.derive, "signed_distance")
    assert "Find s, separation, m, from\n    z  height of the centre, m\n    r  radius, m\n" in found
    assert 'lab.derive("signed_distance", s="…")' in found
    assert "z - r" not in found
    assert "Find w, width, m, from" in found
    assert "Of side_of_plane no line is asked for." in said(capsys, lab.derive, "side_of_plane")


def test_derive_says_what_is_asked_for_in_the_lines_that_are_still_dots(lab, capsys):
    found = said(capsys, lab.derive, "signed_distance", s=...)
    assert "Find s, " in found
    assert "Find w, " not in found
    found = said(capsys, lab.derive, "signed_distance", s="z - r", w=...)
    assert found.startswith("✓ s = z - r is right")
    assert "Find w, width, m, from" in found
    assert "no line d = … is asked for" in said(capsys, lab.derive, "signed_distance", d=...)


@pytest.mark.parametrize(
    ("lines", "words"),
    [
        ({"s": "-r + z"}, "✓ s = -r + z is right"),
        ({"s": "z + r"}, "✗ s = z + r\n    At z = 1 and r = 0.1 your line gives 1.1; the equation holds for 0.9."),
        ({"s": "z - d"}, "lab.derive: unknown quantity 'd'. Choices: z, r."),
        ({"d": "z - r"}, "lab.derive: of signed_distance no line d = … is asked for; there is s and w"),
        ({"s": 0.5}, "lab.derive: write the line between quotes"),
    ],
)
def test_derive_judges_a_line_in_words(lab, capsys, lines, words):
    assert words in said(capsys, lab.derive, "signed_distance", **lines)


def test_an_unknown_function_or_figure_prints_one_line(lab, capsys):
    assert "Did you mean 'signed_distance'?" in said(capsys, lab.derive, "signed_distanc", s="z")
    assert "lab.figure: unknown figure 'contcat'. Did you mean 'contact'?" in said(capsys, lab.figure, "contcat")
    lab.figure("contact")
    assert "image/svg+xml" in lab.shown[-1]._repr_mimebundle_()
