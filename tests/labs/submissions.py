"""Files as students hand them in: the solutions of a topic, or its stubs as they start with them."""

from __future__ import annotations

import importlib
import inspect
import re
from pathlib import Path

from reference import lecture

MODULES = {
    "detection": ("detection",),
    "response": ("detection", "forces.integrators", "response.kinematic", "response.stepping", "response.penalty"),
    "friction": tuple(
        f"friction.{name}" for name in ("complementarity", "cone", "contacts", "dry", "support", "cradle", "impact")
    ),
    "impulse": tuple(f"impulse.{name}" for name in ("body", "points", "normals", "momentum", "inertia", "impact")),
}
"""The modules of the solutions that hold a topic and what it needs, in an order in which they may stand in one file."""


def solved(folder: Path, *topics: str) -> Path:
    """The solutions of some topics as one file, as a student hands them in."""
    names = dict.fromkeys(name for topic in topics for name in MODULES[topic])
    texts = [inspect.getsource(importlib.import_module(f"solutions.{name}")) for name in ("checks", *names)]
    ours = r"^from (solutions|__future__)[^\n(]*(\([^)]*\))?[^\n]*\n"
    path = folder / "solved.py"
    path.write_text("from __future__ import annotations\n" + re.sub(ours, "", "\n".join(texts), flags=re.MULTILINE))
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
