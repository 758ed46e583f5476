"""Forty bad inputs, to the commands and to the library, with what the lab says to each.

`make.py` runs the commands one by one, and this file as a program for all expressions: it prints a JSON object of what
each of them raised or printed. Commands run in a folder with the files of `FILES`.
"""

from __future__ import annotations

import contextlib
import importlib
import io
import json
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

FILES = {
    "notes.txt": "Not a program.\n",
    "roster.csv": "student,points\nada,3\n",
    "broken.ipynb": '{"cells": [',
    "syntax.py": "def side_of_plane(separation, tolerance=0.0)\n    return 1\n",
    "text.py": "def side_of_plane(separation, tolerance=0.0):\n    return 'in front'\n",
    "short.py": "from solutions.detection import *\nfrom solutions.forces import *\n\n\n"
    "def kinematic_response(velocity, normal, restitution, plane_velocity=0):\n    return velocity[:2]\n",
    "missing.py": "def side_of_plane(separation, tolerance=0.0):\n    return 1\n",
    "class/ada/detection.py": "def side_of_plane(separation, tolerance=0.0):\n    return 1\n",
}
BY_HAND = "--engine handwritten --profile exact --jobs 1"
COMMANDS = (
    # Names and numbers of scenarios, engines and settings
    "compare no-such-ball",
    "compare dropped-ball/e=2",
    "compare dropped-ball --engine bullet",
    "compare dropped-ball --profile fast",
    "compare dropped-ball --at restitution",
    "compare dropped-ball --at restitution=2",
    "compare dropped-ball --at bounce=0.5",
    "compare dropped-ball --engine pybullet --set contact_erp=soft",
    "compare dropped-ball --timestep -1",
    "compare --published P99",
    "show bounze",
    "sensitivity dropped-ball/e=0.5",
    "record dropped-ball --engine handwritten",
    "engines bullet",
    # Hand-written code that cannot be used
    f"compare ball-to-rest/e=0.5 {BY_HAND} --implementation nowhere.py",
    f"compare ball-to-rest/e=0.5 {BY_HAND} --implementation missing.py",
    f"compare ball-to-rest/e=0.5 {BY_HAND} --implementation short.py",
    "check notes.txt",
    "check broken.ipynb",
    "check syntax.py",
    "check text.py",
    # Places that cannot be written, and files of another kind
    "report --only ball-to-rest/e=0.5 --out notes.txt/report",
    "show bounce --plot plot.gif",
    "lab release --out .",
    "lab release --out new --through impulze",
    "export moodle --lab impulse --out new",
    "export gradescope --lab impulse --out new",
    "grade class --lab detection --roster roster.csv",
)
MODULES = ("solutions.detection", "solutions.response", "solutions.impulse", "solutions.forces",
           "reference.scene.scenario", "reference.scene.settings", "labs.notebook")  # fmt: skip
"""What the expressions name."""
EXPRESSIONS = (
    # Vectors, coefficients and masses
    "solutions.detection.signed_distance((0, 0), (0, 0, 1), 0)",
    "solutions.detection.signed_distance((0, 0, 1), (0, 0, 0), 0)",
    "solutions.response.kinematic_response((0, 0, -1), (0, 0, 2), 0.5)",
    "solutions.response.kinematic_response((0, 0, -1), (0, 0, 1), 1.5)",
    "solutions.impulse.sphere_inertia(-1, 0.5)",
    "solutions.forces.spring_force('left', (0, 0, 1), 2)",
    "reference.scene.scenario.Body('ball', reference.scene.scenario.Sphere(0.5), -1)",
    "reference.scene.scenario.Scenario('drop', (), (reference.scene.scenario.Pair('ball', 'floor'),), 1)",
    "reference.scene.settings.Settings(0.01).change(erp=0.2)",
    # What a notebook calls
    "labs.notebook.lab.begin('detektion')",
    "labs.notebook.lab.run('dropped-ball')",
    "labs.notebook.lab.predict('height', 'How high?', math.nan, unit='m')",
)


def said_to_commands(folder: Path, environment: Mapping[str, str]) -> dict[str, object]:
    """Run each command in a folder that gets the files; return its exit code and the lines that it printed."""
    for name, content in FILES.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(content, encoding="utf-8")
    found: dict[str, object] = {}
    for command in COMMANDS:
        arguments = [sys.executable, "-m", "labs", *command.split()]
        ended = subprocess.run(arguments, cwd=folder, env=environment, capture_output=True, text=True, check=False)
        found[f"collisions {command}"] = {"code": ended.returncode, "said": (ended.stdout + ended.stderr).splitlines()}
    return found


def said_to_expressions() -> dict[str, object]:
    """Evaluate each expression; return the type of its error, empty if it raised none, and the lines that it said."""
    names = {package: importlib.import_module(package) for package in ("solutions", "reference", "labs", "math")}
    for module in MODULES:
        importlib.import_module(module)
    found: dict[str, object] = {}
    for expression in EXPRESSIONS:
        error = ""
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            try:
                print(eval(expression, names))
            except Exception as raised:
                error = type(raised).__name__
                print(raised)
        found[expression] = {"error": error, "said": printed.getvalue().splitlines()}
    return found


if __name__ == "__main__":
    print(json.dumps(said_to_expressions()))
