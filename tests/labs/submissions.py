"""Files as students hand them in: the solutions of a topic, its stubs, and notebooks or files of any text."""

from __future__ import annotations

import functools
import importlib
import inspect
import json
from pathlib import Path

from labs.building import notebooks
from labs.grading.calling.remote import Grader
from labs.grading.feedback import report
from labs.grading.judging import pytest_run
from labs.grading.judging.score_sheet import Sheet
from labs.grading.submission.excerpts import TopicExcerpts, imports_of, text_of
from labs.grading.submission.reading import Submission, read
from reference import lecture

WANTED = ("rebound_velocity", "normal_velocity")

BOTH = "def rebound_velocity(v, e):\n    return -e * v\n\n\ndef normal_velocity(n, u):\n    return n @ u\n"


def solved(folder: Path, topic: str) -> Path:
    """The solutions of a topic as one file, which imports nothing of ours."""
    names = [entry.name for entry in lecture.functions_of(topic) if entry.role != "read"]
    found = TopicExcerpts.of(topic).needed(names)
    path = folder / "solved.py"
    path.write_text(f"from __future__ import annotations\n{imports_of(found)}\n{text_of(found)}\n")
    return path


@functools.cache
def solved_notebook(topic: str) -> bytes:
    """The solved notebook of a lab, made of its lesson and the solutions as they are now."""
    return notebooks.text(notebooks.solved(topic)).encode()


def stubs(folder: Path, topic: str) -> Path:
    """What a student starts from: signatures and docstrings."""
    module, text = importlib.import_module(f"solutions.{topic}"), "import numpy as np\n"
    for entry in lecture.functions_of(topic):
        if entry.role == "written":
            function = getattr(module, entry.name)
            names = ", ".join(
                name if parameter.default is parameter.empty else f"{name}={parameter.default!r}"
                for name, parameter in inspect.signature(function).parameters.items()
            )
            text += f"\n\ndef {entry.name}({names}):\n    {function.__doc__!r}\n    raise NotImplementedError\n"
    path = folder / "stubs.py"
    path.write_text(text)
    return path


def notebook(*sources: str | list[str] | dict, nbformat: int = 4) -> bytes:
    """A notebook of these code cells; of other cells where a dictionary is given."""
    cells = [
        source if isinstance(source, dict) else {"cell_type": "code", "source": source, "outputs": [], "metadata": {}}
        for source in sources
    ]
    return json.dumps({"nbformat": nbformat, "nbformat_minor": 5, "metadata": {}, "cells": cells}).encode()


def tagged(source: str, *tags: str) -> dict:
    """A code cell with tags."""
    return {"cell_type": "code", "source": source, "metadata": {"tags": list(tags)}}


def handed_in(folder: Path, content: bytes | str, name: str = "lab.ipynb") -> Submission:
    """Write a file, and read it as a submission of two functions."""
    path = folder / name
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return read(path, WANTED)


def defined(submission: Submission) -> dict:
    """The names that a submission has when its text was run."""
    names: dict = {"__name__": "__main__"}
    exec(submission.text, names)
    return names


def told(submission: Submission) -> str:
    """What is said of a submission, a line each."""
    return "\n".join(map(str, submission.complaints))


def sheet_of(folder: Path, grader: Grader, text: str, *names: str, topic: str = "impulse") -> Sheet:
    """What the visible tests find in a submission of that text."""
    (folder / "lab.py").write_text(text, encoding="utf-8")
    return pytest_run.run(folder / "lab.py", (topic,), (pytest_run.VISIBLE,), grader, names)


def checked(folder: Path, grader: Grader, text: str, *names: str, topic: str = "impulse") -> str:
    """What a student reads about a submission of that text, on one line."""
    return joined("\n".join(report.report(sheet_of(folder, grader, text, *names, topic=topic), (topic,))))


def joined(text: str) -> str:
    """A text on one line."""
    return " ".join(text.split())
