"""Who may import whom: read off the syntax trees of all modules, so an import within a function counts as well."""

from __future__ import annotations

import ast
import functools
import sys
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
LATE = {"mujoco", "pybullet", "dartpy", "matplotlib", "plotext"}
"""Engines and plotting: imported within functions, so that a machine without them runs everything else."""
OURS = {"solutions", "reference", "labs", "tests"}
MAY_IMPORT = {"solutions": {"solutions"}, "reference": {"reference"}, "labs": {"labs", "reference"}}
"""Which of our own packages each package may import."""
FLOORS = {
    "reference": (
        "report", "published", "running", "recording", "comparison", "catalogue", "prediction", "viewer", "engines",
        "scene", "lecture",
    ),
    "reference/published": (
        "jobs", "recorded", "judging", "drivers", "in_engines", "by_hand", "results", "theirs",
    ),
    "labs": (
        "notebook", "cli", "desk", "gradebook", "building", "demonstrations", "assessment", "guidance", "grading",
        "benching",
    ),
    "labs/grading": ("feedback", "judging", "diagnosis", "calling", "submission", "worker"),
}  # fmt: skip
"""The folders and modules of a package from the top floor down. Each imports only from those below it; modules that
are not named are the ground floor, on which everything may stand."""
ABOVE_ALL = {"labs.__init__", "labs.__main__"}
"""Modules beside the folders that are no ground floor: entrances."""


@dataclass(frozen=True)
class Import:
    """One import: what, in which line, whether it happens as soon as the module is loaded, and which names of it."""

    module: str
    line: int
    at_module_level: bool
    names: tuple[str, ...] = ()

    @property
    def top(self) -> str:
        return self.module.partition(".")[0]


@functools.cache  # three tests read the same modules
def imports(text: str, package: str) -> tuple[Import, ...]:
    """All imports of a module that lies in `package` (dotted), the dynamic ones with a literal name included.

    After `import reference`, what is said of it (`reference.engines.base`) counts as an import too.
    """
    tree = ast.parse(text)
    whole = {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names} & OURS
    loaders = {"import_module", "__import__", "run_module"}
    for node in (node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)):
        loaders |= {alias.asname for alias in node.names if alias.name in loaders and alias.asname}

    def visit(node: ast.AST, outside: bool) -> Iterator[Import]:
        if isinstance(node, ast.Import):
            yield from (Import(alias.name, node.lineno, outside) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            names = tuple(alias.name for alias in node.names)
            yield Import(_absolute("." * node.level + (node.module or ""), package), node.lineno, outside, names)
        elif isinstance(node, ast.Call) and _name(node.func) in loaders:
            named = {entry.arg: entry.value for entry in node.keywords}
            given = [*node.args[:2], *(named[word] for word in ("name", "package") if word in named)]
            said = [value.value for value in given if isinstance(value, ast.Constant) and isinstance(value.value, str)]
            if said:
                yield Import(_absolute(said[0], said[1] if len(said) > 1 else package), node.lineno, outside)
        elif whole and isinstance(node, ast.Attribute) and (dotted := ast.unparse(node)).partition(".")[0] in whole:
            yield Import(dotted, node.lineno, outside)
            return
        inside = isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda) or _for_types_only(node)
        for child in ast.iter_child_nodes(node):
            yield from visit(child, outside and not inside)

    return tuple(visit(tree, True))


def _absolute(name: str, package: str) -> str:
    """The name of a module with dots in front of it, said in `package`."""
    bare = name.lstrip(".")
    if bare == name:
        return name
    above = package.split(".")[: len(package.split(".")) - (len(name) - len(bare)) + 1]
    return ".".join([*above, bare] if bare else above)


def _for_types_only(node: ast.AST) -> bool:
    """Whether nothing in it ever runs: it is read by the type checker alone."""
    return isinstance(node, ast.If) and _name(node.test) == "TYPE_CHECKING" and not node.orelse


def _name(called: ast.expr) -> str:
    return called.attr if isinstance(called, ast.Attribute) else getattr(called, "id", "")


def violations(root: Path, package: str) -> list[str]:
    """What the modules of a package import and may not, one line each."""
    found = []
    for file in sorted((root / package).rglob("*.py")):
        place = ".".join(file.relative_to(root).parent.parts)
        for entry in imports(file.read_text(encoding="utf-8"), place):
            if entry.top in OURS and entry.top not in MAY_IMPORT[package]:
                why = f"{package} must not import {entry.top}"
            elif package == "solutions" and entry.top not in {"numpy", *OURS, *sys.stdlib_module_names}:
                why = "solutions needs nothing but the standard library and NumPy"
            elif entry.at_module_level and entry.top in LATE:
                why = f"{entry.top} is imported late, within a function"
            else:
                continue
            found.append(f"{file.relative_to(root).as_posix()}:{entry.line}: {entry.module}: {why}")
    return found


def climbs(root: Path, building: str) -> list[str]:
    """The imports of a package that run up from one of its floors to a higher one, one line each."""
    floors, dotted = FLOORS[building], building.replace("/", ".")

    def floor(module: str) -> int:
        """How far down a module lies: 0 is the top, and the ground has the largest number."""
        first = module.removeprefix(f"{dotted}.").partition(".")[0]
        return floors.index(first) if first in floors else len(floors)

    found = []
    for file in sorted((root / building).rglob("*.py")):
        own = ".".join(file.relative_to(root).with_suffix("").parts)
        if own in ABOVE_ALL:
            continue
        for entry in imports(file.read_text(encoding="utf-8"), own.rpartition(".")[0]):
            modules = [f"{dotted}.{name}" for name in entry.names] if entry.module == dotted else [entry.module]
            for module in modules:
                if module.startswith(f"{dotted}.") and floor(module) < floor(own):
                    found.append(f"{file.relative_to(root).as_posix()}:{entry.line}: {module} lies on a higher floor")
    return found


def circles(root: Path, package: str) -> list[set[str]]:
    """The sets of modules of a package that import one another in a circle."""
    files = {".".join(file.relative_to(root).with_suffix("").parts): file for file in (root / package).rglob("*.py")}
    files = {name.removesuffix(".__init__"): file for name, file in files.items()}
    uses = {name: set(_used(name, file, files)) for name, file in files.items()}
    while ends := {name for name, used in uses.items() if not used}:  # what imports nothing is in no circle
        uses = {name: used - ends for name, used in uses.items() if name not in ends}
    return [{name, *used} for name, used in uses.items()]


def _used(name: str, file: Path, files: Collection[str]) -> Iterator[str]:
    inside = name if file.name == "__init__.py" else name.rpartition(".")[0]
    for entry in imports(file.read_text(encoding="utf-8"), inside):
        members = [f"{entry.module}.{member}" for member in entry.names]
        whole = [entry.module] if not members or any(member not in files for member in members) else []
        yield from (used for used in (*members, *whole) if used in files and used != name)


@pytest.mark.parametrize("building", [name for name in FLOORS if (ROOT / name).is_dir()])
def test_no_import_runs_up_a_floor(building):
    there = {path.name for path in (ROOT / building).iterdir() if any(path.glob("*.py"))}
    assert there <= set(FLOORS[building]), "every folder has its floor"
    assert climbs(ROOT, building) == []


@pytest.mark.parametrize("package", [name for name in MAY_IMPORT if (ROOT / name).is_dir()])
def test_no_modules_import_one_another_in_a_circle(package):
    assert circles(ROOT, package) == []


@pytest.mark.parametrize(
    ("building", "file", "line"),
    [
        ("reference", "scene/scenario.py", "from reference.engines.base import Engine"),
        ("reference", "comparison/results.py", "def f():\n    from reference.published import judging"),
        ("reference", "truth.py", "from reference import lecture"),
        ("reference/published", "theirs/bounces.py", "from reference.published.by_hand import bounces"),
        ("reference", "lecture/topics.py", "if TYPE_CHECKING:\n    from reference.catalogue.family import Family"),
        ("labs/grading", "diagnosis/deviations.py", "from labs.grading.judging.score_sheet import Sheet"),
        ("labs/grading", "worker/serving.py", "from ..submission import cells"),
        ("labs", "demonstrations/catalogue.py", "import labs.desk.tables"),
        ("labs", "grading/examples.py", "import_module('.desk.tables', 'labs')"),
        ("labs", "grading/examples.py", "import_module('..desk.tables', __package__)"),
        ("labs", "grading/examples.py", "import_module(package='labs.grading', name='labs.desk.tables')"),
        ("reference", "scene/scenario.py", "from importlib import import_module as load; load('reference.engines')"),
        ("reference", "scene/scenario.py", "import reference; reference.engines.base"),
    ],
)
def test_an_import_turned_round_is_found(building, file, line, tmp_path):
    planted = tmp_path / building / file
    planted.parent.mkdir(parents=True)
    planted.write_text(f"import math\n{line}\n")
    (found,) = climbs(tmp_path, building)
    assert found.startswith(f"{building}/{file}:")


def test_modules_in_a_circle_are_found(tmp_path):
    for name, other in (("a", "b"), ("b", "c"), ("c", "a"), ("d", "a")):
        (tmp_path / "labs").mkdir(exist_ok=True)
        (tmp_path / f"labs/{name}.py").write_text(f"def f():\n    from labs import {other}\n")
    assert set.union(*circles(tmp_path, "labs")) >= {"labs.a", "labs.b", "labs.c"}
    (tmp_path / "labs/c.py").write_text("")
    assert circles(tmp_path, "labs") == []


@pytest.mark.parametrize("package", [name for name in MAY_IMPORT if (ROOT / name).is_dir()])  # a release lacks some
def test_every_import_goes_the_way_it_may(package):
    assert list((ROOT / package).rglob("*.py"))
    assert violations(ROOT, package) == []


@pytest.mark.parametrize(
    ("package", "line", "complaint"),
    [
        ("solutions", "import reference", "solutions must not import reference"),
        ("solutions", "from labs import cli", "solutions must not import labs"),
        ("solutions", "import scipy.linalg", "nothing but the standard library and NumPy"),
        ("solutions", "def f():\n    import matplotlib", "nothing but the standard library and NumPy"),
        ("reference", "import solutions", "reference must not import solutions"),
        ("reference", "from solutions.detection import signed_distance", "reference must not import solutions"),
        ("reference", "def f():\n    import labs.cli", "reference must not import labs"),
        ("reference", "from tests import conftest", "reference must not import tests"),
        ("reference", "import pybullet", "imported late"),
        ("reference", "from mujoco import MjSpec", "imported late"),
        ("reference", "class A:\n    import matplotlib.pyplot as plt", "imported late"),
        ("reference", "try:\n    import mujoco\nexcept ImportError:\n    mujoco = None", "imported late"),
        ("reference", "if TYPE_CHECKING:\n    pass\nelse:\n    import mujoco", "imported late"),
        ("reference", "import importlib\nimportlib.import_module('solutions.forces')", "must not import solutions"),
        ("reference", "def f():\n    return __import__('labs')", "reference must not import labs"),
        ("labs", "import solutions.response", "labs must not import solutions"),
        ("labs", "import tests.conftest", "labs must not import tests"),
        ("labs", "import matplotlib", "imported late"),
    ],
)
def test_an_import_that_goes_the_wrong_way_is_found(package, line, complaint, tmp_path):
    (tmp_path / package / "deep").mkdir(parents=True)
    (tmp_path / package / "deep" / "planted.py").write_text(f"import math\n{line}\n")
    (found,) = violations(tmp_path, package)
    assert found.startswith(f"{package}/deep/planted.py:")
    assert complaint in found


@pytest.mark.parametrize(
    ("package", "line"),
    [
        ("solutions", "import numpy as np\nfrom solutions.detection import signed_distance\nimport dataclasses"),
        ("solutions", "from . import world"),
        ("reference", "from reference import truth\nimport numpy"),
        ("reference", "def f():\n    import mujoco"),
        ("reference", "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    import matplotlib"),
        ("reference", "source = 'solutions'"),  # which code runs is said by data
        ("reference", "from ..engines import base"),
        ("labs", "from reference import lecture\nfrom labs import cli"),
        ("labs", "async def f():\n    from matplotlib import pyplot"),
    ],
)
def test_an_import_that_goes_the_right_way_is_let_through(package, line, tmp_path):
    (tmp_path / package / "deep").mkdir(parents=True)
    (tmp_path / package / "deep" / "planted.py").write_text(f"{line}\n")
    assert violations(tmp_path, package) == []
