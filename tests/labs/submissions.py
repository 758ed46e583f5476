"""Files as students hand them in: the solutions of a topic, or its stubs as they start with them."""

from __future__ import annotations

import importlib
import inspect
from pathlib import Path

from labs.building.excerpts import TopicExcerpts, imports_of, text_of
from reference import lecture


def solved(folder: Path, topic: str) -> Path:
    """The solutions of a topic as one file, which imports nothing of ours."""
    found = TopicExcerpts.of(topic).needed([entry.name for entry in lecture.functions_of(topic)])
    path = folder / "solved.py"
    path.write_text(f"from __future__ import annotations\n{imports_of(found)}\n{text_of(found)}\n")
    return path


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
