"""A file of hints: sections, levels, derivations and answers to predictions; and figures with a description."""

from __future__ import annotations

import pytest

from labs.guidance import drawings, hint_files
from labs.guidance.hint_files import LEVELS, Answer, hints
from reference.errors import InvalidInput, UnknownName

FILE = """# Hints

## impulse_magnitude

```derive
j = -(1 + e) * u / k
j: size of the impulse, N s
u: velocity², along the normal, m²/s², -5 to −1
e: coefficient of restitution, 0 to 1
k: inverse effective mass, 1/kg, 0.2 to 4
```

```derive
w = -e * u
u: velocity, m/s, -5 to -1
e: coefficient of restitution, 0 to 1
```

### The idea

Two lines.

### The next line

$u + jk$

### The formula

$$j = …$$

## Predictions

- corner: zero — the impulse acts
  along the line of centres
- passed: 0.4 ± 0.05 — a test at each step misses so many
- speed: −2 — both move on
- rebound — the height goes with the square of the speed
"""


@pytest.fixture
def write(tmp_path, monkeypatch):
    """Writes the hints of the impulse lab."""
    monkeypatch.setattr(hint_files, "HINTS", tmp_path)

    def write(text):
        (tmp_path / "impulse.md").write_text(text, encoding="utf-8")

    write(FILE)
    return write


def test_a_section_has_its_derivations_and_levels(write):
    guide = hints("impulse").of("impulse_magnitude")
    assert [title for title, _ in guide.titled] == list(LEVELS)
    assert guide.levels[0] == "Two lines."
    asked = guide.derivation("j")
    assert asked.asked == "size of the impulse, N s"
    assert asked.quantities[0].meaning == "velocity², along the normal, m²/s²"
    assert (asked.quantities[0].low, asked.quantities[0].high) == (-5, -1)
    assert guide.derivation("w").names == ["u", "e"]
    with pytest.raises(InvalidInput, match="no line k = … is asked for; there is j and w"):
        guide.derivation("k")


def test_predictions_have_an_answer_or_leave_it_to_theory(write):
    assert hints("impulse").answers == {
        "corner": Answer("zero", reason="the impulse acts along the line of centres"),
        "passed": Answer("0.4 ± 0.05", 0.4, 0.05, "a test at each step misses so many"),
        "speed": Answer("−2", -2, None, "both move on"),
        "rebound": Answer(reason="the height goes with the square of the speed"),
    }


def test_a_topic_without_a_file_has_no_hints(write):
    assert hints("avoidance").of("seek").levels == ()


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("## impulse_magnitude", "## impulse_magnitud", "section impulse_magnitud: there is no function"),
        ("### The idea", "### An idea", "section impulse_magnitude: “An idea” is no level"),
        ("## Predictions", "## impulse_magnitude\n\n## Predictions", "two sections of this name"),
        ("- corner: zero — the impulse acts\n  along the line of centres", "- corner: zero", "is no line such as"),
    ],
)
def test_a_mistake_in_a_file_is_named_with_its_section(write, old, new, said):
    write(FILE.replace(old, new))
    with pytest.raises(InvalidInput, match=f"hints/impulse.md.*{said}"):
        hints("impulse")


SVG = '<svg xmlns="http://www.w3.org/2000/svg"><title>A peg</title>{}<path d="M0 0"/></svg>'


@pytest.fixture
def draw(tmp_path, monkeypatch):
    monkeypatch.setattr(drawings, "FIGURES", tmp_path)
    return lambda text: (tmp_path / "peg.svg").write_text(text, encoding="utf-8")


def test_a_figure_has_its_description_in_every_form(draw):
    draw(SVG.format('<desc>A rod &amp; a peg "below".</desc>'))
    shown = drawings.drawing("peg")._repr_mimebundle_()
    assert shown["text/plain"] == '[Figure: A peg. A rod & a peg "below".]'
    assert 'alt="A peg. A rod &amp; a peg &quot;below&quot;."' in shown["text/html"]
    assert "background-color:#ffffff" in shown["text/html"]  # so that it can be read on a dark page
    assert shown["image/svg+xml"].startswith("<svg")
    assert drawings.drawing("peg", "Another text.").alternative == "Another text."


def test_where_no_figure_is_drawn_the_command_is_named(monkeypatch, tmp_path):
    monkeypatch.setattr(drawings, "FIGURES", tmp_path)
    with pytest.raises(InvalidInput, match="no figure yet: `make docs` draws them"):
        drawings.drawing("peg")
    monkeypatch.setattr(drawings, "DRAWING", tmp_path / "nowhere")  # as in a student's tree
    with pytest.raises(UnknownName, match="unknown figure 'peg'"):
        drawings.drawing("peg")


def test_a_figure_without_a_description_or_a_name_is_refused(draw):
    for empty in ("", "<desc> </desc>"):
        draw(SVG.format(empty))
        with pytest.raises(InvalidInput, match="needs a <title> and a <desc>"):
            drawings.drawing("peg")
    draw("<svg")
    with pytest.raises(InvalidInput, match="cannot be read"):
        drawings.drawing("peg")
    with pytest.raises(InvalidInput, match=r"unknown figure 'pig'. Did you mean 'peg'.*`make docs` draws those"):
        drawings.drawing("pig")
