"""What the builder makes of drafts, and what it says of hints, figures and answers that a lesson lacks or tells."""

from __future__ import annotations

import ast
import json

import pytest
from made_lessons import EACH_LAB, HEAD, WRITES, sources

from labs.building import lessons, notebooks
from labs.building.guidance_gaps import gaps
from labs.building.revealed_answers import compact
from labs.grading.submission.reading import read
from labs.guidance import hint_files
from reference import lecture
from reference.errors import InvalidInput

NAMES = [entry.name for entry in lecture.functions_of("detection") if entry.role == "written"]
LEVELS = "\n### The idea\nA.\n\n### The next line\nB.\n\n### The formula\n{}\n"
BLOCK = "\n```derive\nw = (s0 + 2 * s1) / s0\ns0: m, 1 to 2\ns1: m, 1 to 2\n```\n"
DRAFT = '''
```python draft="signed_distance"
def signed_distance(point, normal, offset):
    """Distance from a level floor, m."""
```

```python model="draft-signed_distance"
def signed_distance(point, normal, offset):
    return point[..., 2]
```
'''
CALLS = """
```python guess="'up'"
lab.predict("way", "Which way?", answer=..., choices=("up", "down"))
```

```python
lab.run("dropped-ball", predicted="way")
lab.derive("signed_distance")
lab.figure("contact")
```
"""


def complete() -> str:
    """Hints in which nothing is missing for the lesson below."""
    sections = [f"## {name}\n{BLOCK * (name == NAMES[0])}{LEVELS.format('C.')}" for name in NAMES]
    return "\n".join([*sections, "## Predictions\n", "- way: up — so it is"])


@pytest.fixture
def write(tmp_path, monkeypatch):
    """Writes a lesson of detection and its hints."""
    for module, name in ((lessons, "LESSONS"), (hint_files, "HINTS")):
        monkeypatch.setattr(module, name, tmp_path / name)
        (tmp_path / name).mkdir()

    def write(lesson=HEAD + WRITES + CALLS, hints=None):
        (tmp_path / "LESSONS" / "detection.md").write_text(lesson, encoding="utf-8")
        (tmp_path / "HINTS" / "detection.md").write_text(complete() if hints is None else hints, encoding="utf-8")

    write()
    return write


def test_a_complete_lab_has_no_gaps(write):
    assert gaps("detection") == []


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("### The next line\nB.\n", "", "detection.md: signed_distance lacks The next line"),
        ("A.", "![A peg.](figure:pegs)", "figure pegs: unknown figure"),
        (BLOCK, "", "calls lab.derive('signed_distance'), and hints/detection.md has no derivation of it"),
        ("- way: up", "- ways: up", "no line for the prediction way"),
        ("- way: up", "- way: left", "the answer to way is none of up, down"),
        ("## signed_distance", "## is_coliding", "section is_coliding: there is no function"),
    ],
)
def test_whatever_the_hints_lack_is_named(write, old, new, said):
    write(hints=complete().replace(old, new, 1))
    assert any(said in gap for gap in gaps("detection")), gaps("detection")


@pytest.mark.parametrize("told", ["so $w^+ = \\frac{s_0 + 2\\,s_1}{s_0}$", "`(s0 + 2*s1)/s0`", "w = (s0 + 2·s1) / s0"])
def test_a_lesson_that_prints_what_is_to_be_derived_is_named(write, told):
    write(HEAD + WRITES + CALLS + f"\n{told}\n")
    assert gaps("detection") == [f"the lesson of detection prints what is to be derived for {NAMES[0]}: s0+2s1/s0"]


def test_a_derivation_that_the_lesson_never_asks_for_is_named(write):
    write(HEAD + WRITES + CALLS.replace("lab.derive", "lab.hint"))
    assert gaps("detection") == ["the lesson never calls lab.derive('signed_distance')"]


def test_a_derivation_without_a_list_of_its_quantities_is_named(write):
    asked = '\n```python guess="1"\n{}lab.derive("signed_distance", w=...)\n```\n'
    write(HEAD + WRITES + CALLS + asked.format("# Write w with s0, s1.\n"))
    assert gaps("detection") == []
    write(HEAD + WRITES + CALLS + asked.format("# Write w with s0.\n"))
    line = "# Write w with s0, s1."
    assert gaps("detection") == [f"the lesson asks for w of signed_distance without a line {line}"]


def test_a_stub_that_holds_a_line_to_be_derived_is_refused(write, monkeypatch):
    monkeypatch.setattr(notebooks, "answers_of", lambda topic, name: [compact("n·p + d")] * (name == "signed_distance"))
    with pytest.raises(InvalidInput, match="the stub of signed_distance holds a line that is to be derived"):
        notebooks.student("detection")


def test_a_draft_is_a_stub_then_a_model_and_its_function_is_written_again(write, tmp_path):
    write(HEAD + DRAFT + WRITES + CALLS)
    student, solved = notebooks.student("detection"), notebooks.solved("detection")
    first, again = [source for source in sources(student) if source.startswith("def signed_distance(")]
    assert first.endswith('\n        "detection: a first version of signed_distance is yours to write"\n    )')
    assert '"""Distance from a level floor, m."""' in first
    assert "signed_distance is yours to write again" in again
    assert "return point[..., 2]" not in "".join(sources(student))
    (cell,) = [cell for cell in student["cells"] if "draft-signed_distance" in cell["metadata"].get("tags", ())]
    assert "nbgrader" not in cell["metadata"]
    path = tmp_path / "solved.ipynb"
    path.write_text(json.dumps(solved), encoding="utf-8")
    found = read(path, NAMES)
    assert found.complaints == ()
    assert "return point[..., 2]" not in found.text
    assert "def signed_distance" in found.text


def test_the_first_of_two_drafts_is_solved_by_the_first_model(write):
    write(HEAD + DRAFT + DRAFT.replace("point[..., 2]", "-point[..., 2]") + WRITES + CALLS)
    solved = sources(notebooks.solved("detection"))
    student = "".join(sources(notebooks.student("detection")))
    first, second = (student.index(f"a {each} version of signed_distance is yours") for each in ("first", "second"))
    assert first < second
    assert [source.split("return ")[1] for source in solved if source.count("\n") == 1 and "def signed" in source] == [
        "point[..., 2]",
        "-point[..., 2]",
    ]


def test_a_line_to_derive_is_open_until_the_notebook_is_solved(write):
    asked = '\n```python guess="\'(s0 + 2 * s1) / s0\'"\nlab.derive("signed_distance", w=...)\n```\n'
    write(HEAD + WRITES + CALLS + asked)
    assert 'lab.derive("signed_distance", w=...)' in sources(notebooks.student("detection"))
    assert "lab.derive(\"signed_distance\", w='(s0 + 2 * s1) / s0')" in sources(notebooks.solved("detection"))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("signed_distance", "finite", "a draft of finite, which it does not write"),
        ('    """Distance from a level floor, m."""', "    return 0", "is to be one function with a docstring"),
        ("def signed_distance(point", "def distance(point", "is to be one function with a docstring"),
        ('model="draft-signed_distance"', 'model="draft"', "no model='draft-signed_distance'"),
        ("```python model", DRAFT.split("```python model")[0].strip() + "\n\n```python model", "for each draft"),
    ],
)
def test_a_draft_of_nothing_or_without_a_model_is_refused(write, old, new, said):
    write(HEAD + DRAFT.replace(old, new) + WRITES + CALLS)
    with pytest.raises(InvalidInput, match=said):
        lessons.read("detection")


@EACH_LAB
def test_every_lab_has_its_hints_figures_and_verdicts(topic):
    missing = gaps(topic)
    assert not missing, "\n".join(missing)


@EACH_LAB
def test_lines_of_the_solved_notebook_are_right(topic):
    calls = [node for cell in lessons.read(topic).cells if cell.code and "lab.derive(" in cell.text
             for node in ast.walk(ast.parse(cell.guessed)) if isinstance(node, ast.Call)]  # fmt: skip
    assert calls
    for call in calls:
        for line in call.keywords:
            asked = hint_files.hints(topic).of(ast.literal_eval(call.args[0])).derivation(str(line.arg))
            assert asked.difference(asked.read(ast.literal_eval(line.value))) == ""
