"""Whole submissions that are right in other words lose no point, and nobody is said to have made a mistake.

Each file of `tests/autograder/alternatives/whole` has all functions of a topic, in one manner of writing. It is graded
as a class is: a file on disk, visible and hidden tests, a worker. Functions for a single case lose one part of a lab.

How a file is stored matters only until it is read: whatever is graded is made of the text that reading returns. So
each file is read in every format. One is graded as a notebook too, and in the other formats by `make weekly`.
"""

from __future__ import annotations

import ast
import functools
import json
from pathlib import Path

import pytest
from tests_in_process import TOPICS

from labs.grading.diagnosis.fingerprints.building import WITH_GIVEN_FUNCTIONS
from labs.grading.judging.grade import grade
from labs.grading.submission.excerpts import TopicExcerpts, imports_of, text_of
from labs.grading.submission.reading import read
from labs.project_folders import AUTOGRADER
from reference import lecture

FILES = {path.stem: path for path in sorted((AUTOGRADER / "alternatives" / "whole").glob("*.py"))}
OFTEN = {"impulse_named"}
"""Those that are tried in every run, and later in every format: the manner that used to lose most."""


def unchanged(text: str) -> bytes:
    return text.encode()


def windows(text: str) -> bytes:
    return text.replace("\n", "\r\n").encode()


def windows_with_a_mark(text: str) -> bytes:
    return b"\xef\xbb\xbf" + windows(text)


def tabs(text: str) -> bytes:
    """Four spaces at the start of a line as a tab, and what is left as it is."""
    lines = text.split("\n")
    return "\n".join("\t" * ((len(line) - len(line.lstrip(" "))) // 4) + line.lstrip(" ") for line in lines).encode()


def notebook(text: str) -> bytes:
    """A cell for every block of the file, in the order of the file."""
    blocks = [block for block in text.split("\n\n\n") if block.strip()]
    cells = [
        {"cell_type": "code", "source": block, "metadata": {}, "outputs": [], "execution_count": None}
        for block in blocks
    ]
    return json.dumps({"cells": cells, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}).encode()


@functools.cache
def handed_in(name: str) -> str:
    """A file's text; in a lab that gives functions without which no answer runs, these come first."""
    text, topic = FILES[name].read_text(encoding="utf-8"), name.partition("_")[0]
    if topic not in WITH_GIVEN_FUNCTIONS:
        return text
    given = [entry.name for entry in lecture.functions_of(topic) if entry.role == "given"]
    found = TopicExcerpts.of(topic).needed(given)
    return f"{imports_of(found)}\n\n\n{text_of(found)}\n\n\n{text}"


FORMATS = (unchanged, windows, windows_with_a_mark, tabs, notebook)


def topic_of(name: str) -> str:
    return name.partition("_")[0]


def stored(name: str, written, folder: Path) -> Path:
    path = folder / ("lab.ipynb" if written is notebook else "lab.py")
    path.write_bytes(written(handed_in(name)))
    return path


def program(text: str) -> str:
    """What runs of a text: a description of several lines has other spaces in it if its file is written with tabs."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.ClassDef | ast.Module) and ast.get_docstring(node) is not None:
            del node.body[0]
    return ast.dump(tree)


def lost(content: dict) -> list[str]:
    return [
        f"{test['function']}: {part['reason']}: {part['message']}"
        for test in content["tests"]
        for part in test["parts"]
        if part["got"] < part["possible"]
    ]


def level(name: str, written) -> tuple | pytest.MarkDecorator:
    """When a file is graded in a format."""
    if written is unchanged and name in OFTEN:
        return ()
    return pytest.mark.slow if written in (unchanged, notebook) else pytest.mark.weekly


@pytest.mark.parametrize(
    ("name", "written"),
    [
        pytest.param(
            name,
            written,
            id=f"{name}-{written.__name__}",
            marks=level(name, written),
        )
        for name in FILES
        for written in FORMATS
        if written is unchanged or name in OFTEN
    ],
)
def test_a_right_submission_in_other_words_loses_no_point(name, written, grader, tmp_path):
    found = grade(stored(name, written, tmp_path), (topic_of(name),), grader=grader).content()
    missed = lost(found)
    if "one_case" in name:
        assert [line for line in missed if "in one call" not in line] == []
        assert len(missed) == 1
    else:
        assert missed == []
    assert found["possible"] - found["got"] == len(missed)
    assert [entry["name"] for entry in found["functions"] if entry["mistakes"]] == []
    verdicts = {entry["verdict"] for entry in found["functions"]}
    assert verdicts <= {"right", "one at a time"}, verdicts
    assert found["complaints"] == []


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in OFTEN else pytest.mark.slow) for name in FILES]
)
def test_a_submission_is_read_as_the_same_program_in_every_format(name, tmp_path):
    wanted = [entry.name for entry in lecture.functions_of(topic_of(name))]
    found = [read(stored(name, written, tmp_path), wanted) for written in FORMATS]
    assert found[0].functions
    assert {program(each.text) for each in found} == {program(found[0].text)}
    assert {(each.functions, each.complaints, each.unread) for each in found} == {
        (found[0].functions, found[0].complaints, ())
    }


def test_there_are_far_more_than_fifty_right_answers_in_other_words():
    topics = [topic_of(name) for name in FILES]
    written = [entry for topic in topics for entry in lecture.functions_of(topic) if entry.role == "written"]
    assert len(written) > 70
    assert set(topics) == set(TOPICS)
