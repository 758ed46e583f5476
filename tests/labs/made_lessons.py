"""A lesson of the detection lab that tests make; and what the lessons of all labs say, define and print."""

from __future__ import annotations

import importlib
import re
from types import SimpleNamespace

import numpy as np
import pytest

from labs.building import lessons
from reference import lecture
from reference.recording.files import content_of

IN_EVERY_RUN = ("detection", "impulse")
EACH_LAB = pytest.mark.parametrize(
    "topic",
    [pytest.param(each.name, marks=() if each.name in IN_EVERY_RUN else pytest.mark.slow) for each in lecture.TOPICS],
)
"""What holds for every lab is tried with two of them in every run, and with the others by `make verify`."""
HEAD = """---
jupyter:
  jupytext:
    text_representation:
      extension: .md
      format_name: markdown
---

# Detecting

```python lab="setup" lends="kinematic_response"
```

```python given="finite not_negative positive vector"
```
"""
WRITES = "".join(
    f'\n```python write="{entry.name}"\n```\n' for entry in lecture.functions_of("detection") if entry.role == "written"
)


def sources(notebook, kind="code"):
    """The cells of a kind, as text."""
    return ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == kind]


def text_of(topic):
    """A lesson in one line."""
    return " ".join(" ".join(cell.text for cell in lessons.read(topic).cells).split())


def nothing(*_, **__):
    """Stands for a call of the desk that shows something."""


def experiments_of(topic):
    """What the cells of a lesson define, with the solutions for the student's functions. Nothing is run or shown."""
    solved = importlib.import_module(f"solutions.{topic}")
    defined = {name: getattr(solved, name) for name in solved.__all__}
    defined["lab"] = SimpleNamespace(show=nothing, run=nothing, sweep=nothing)
    for cell in lessons.read(topic).cells:
        if cell.code and not cell.kind and re.search(r"^def |^[A-Z]+ = |^import ", cell.text, re.MULTILINE):
            exec(compile(cell.text, "lesson", "exec"), defined)
    return SimpleNamespace(**defined)


def printed(capsys, experiment):
    """What an experiment prints."""
    capsys.readouterr()
    experiment()
    return capsys.readouterr().out


def recorded(engine, case, profile, quantity):
    """A quantity of each scenario of a case, as it was recorded at the profile's own timestep."""
    family, _, name = case.partition("/")
    taken = content_of(engine, family)["profiles"][profile]
    return np.array(taken["entries"][name][1][taken["quantities"].index(quantity)])
