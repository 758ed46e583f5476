"""What is uploaded to a platform, or copied there: files by name, and those of them that can be run.

Threat: Classroom 50 publishes what an autograder is made of, and PrairieLearn's image may be public. Hidden tests and
solutions are in the bundles of Gradescope and PrairieLearn alone, and there beside the tests, never in the image.
"""

from __future__ import annotations

import re
import sys
import tempfile
import tomllib
import uuid
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from labs.building import lessons
from labs.building.archives import files_below
from labs.building.points import points_of
from labs.building.release import release
from labs.gradebook import written
from labs.gradebook.book import GRADE, STUDENTS, Book
from labs.gradebook.marking import Given, Key
from labs.gradebook.mistakes.course_bank import CourseBank
from labs.gradebook.platforms import nbgrader as marks_of_nbgrader
from labs.gradebook.written import Codes
from labs.grading.judging.grade import as_json, read_grade
from labs.project_folders import ROOT
from reference import lecture
from reference.engines.distributions import lab_version
from reference.errors import InvalidInput

FILES = Path(__file__).with_name("files")
IMAGE = "collisions-lab-grader"
"""The image that PrairieLearn grades in, unless somebody names another."""
_FOLDERS = ("labs", "reference", "solutions", "tests/autograder/visible", "tests/autograder/hidden")
_AT_THE_ROOT = ("constraints.txt", "LICENSE")
_LEFT_OUT = ("solutions/notebooks/", "labs/notebooks/", "labs/figures/", "labs/given/")
_MODULES = ("classroom50", "lines", "running", "shapes", "text", "__init__")
"""What Classroom 50 needs of this folder, besides the tree that students get."""
_READERS = ("__init__", "arrivals", "chosen_file", "delivered_files", "layouts", "sheets", "subject", "times")
_MOST = 10 * 2**20
"""Bytes that Classroom 50 takes, packed."""
_SECONDS = 180
"""How long PrairieLearn lets a submission be graded."""
_TESTS = re.compile(r"tests/autograder/\w+/test_(\w+)\.py")


@dataclass(frozen=True)
class Bundle:
    """Files by name. executable: those that can be run."""

    files: Mapping[str, bytes]
    executable: frozenset[str] = frozenset()


def gradescope(lab: str) -> Bundle:
    """What is uploaded to Gradescope as the autograder of a lab."""
    scripts = ("setup.sh", "run_autograder")
    files = {name: (FILES / name).read_bytes() for name in scripts}
    return Bundle({**files, **_with_project(lab)}, frozenset(scripts))


def prairielearn(lab: str, image: str = IMAGE) -> Bundle:
    """A question for a PrairieLearn course, and what its image is made of."""
    name = f"questions/collisions-{lab}"
    info = {
        "uuid": str(uuid.uuid5(uuid.NAMESPACE_URL, f"collisions-lab/{lab}")),
        "title": lecture.topic(lab).title,
        "topic": "Collisions",
        "tags": ["collisions-lab"],
        "type": "v3",
        "singleVariant": True,
        "gradingMethod": "External",
        "externalGradingOptions": {
            "enabled": True, "image": image, "entrypoint": "/grade/tests/grade.sh", "timeout": _SECONDS,
            "enableNetworking": False,
        },
    }  # fmt: skip
    question = (FILES / "question.html").read_text(encoding="utf-8").replace("LAB.ipynb", f"{lab}.ipynb")
    return Bundle(
        {
            f"{name}/info.json": as_json(info).encode(),
            f"{name}/question.html": question.encode(),
            f"{name}/tests/grade.sh": (FILES / "grade.sh").read_bytes(),
            **{f"{name}/tests/{path}": content for path, content in _with_project(lab).items()},
            "grader/Dockerfile": (FILES / "Dockerfile").read_bytes(),
            "grader/constraints.txt": (ROOT / "constraints.txt").read_bytes(),
            "grader/requirements.txt": _requirements(),
        },
        frozenset({f"{name}/tests/grade.sh"}),
    )


def classroom50(lab: str) -> Bundle:
    """An autograder of a lab for Classroom 50, which is published: the tree that students get, and what reads a grade.

    Raises
    ------
    InvalidInput
        If it is larger than Classroom 50 takes.
    """
    with tempfile.TemporaryDirectory() as folder:
        release(Path(folder, "release"), only=[lab])
        files = files_below(Path(folder, "release"))
    here, above = Path(__file__).parent, Path(__file__).parents[1]
    files |= {_inside(here / f"{name}.py"): (here / f"{name}.py").read_bytes() for name in _MODULES}
    files |= {_inside(above / f"{name}.py"): (above / f"{name}.py").read_bytes() for name in _READERS}
    files |= _settings()
    runtime = {"runs-on": "ubuntu-latest", "python": f"{sys.version_info.major}.{sys.version_info.minor}"}
    if (size := sum(len(zlib.compress(content)) for content in files.values())) > _MOST:
        raise InvalidInput(f"the autograder has {size / 2**20:.0f} MB when it is packed; Classroom 50 takes 10")
    return Bundle(
        {
            "autograder.py": (FILES / "autograder.py").read_bytes(),
            "lab.txt": f"{lab}\n".encode(),
            "runtime.json": as_json(runtime).encode(),
            **{f"project/{name}": content for name, content in files.items()},
        }
    )


def nbgrader(grades: Path, lab: str, bank: CourseBank) -> Bundle:
    """The marks of a folder of grades, and the script that writes them into nbgrader's gradebook.

    bank: the mistakes that the course has named, whose texts students read beside ours.

    Raises
    ------
    InvalidInput
        If the folder has no grades of the lab, or what it has is no grade.
    """
    asked = written.questions(lab)
    every = [read_grade(path) for path in sorted(grades.glob(f"{STUDENTS}/*/{GRADE}"))]
    found = {str(each["identity"]["entry"]): bank.joined(each) for each in every if each["identity"]["lab"] == lab}
    if not found:
        raise InvalidInput(f"{str(grades)!r} has no grades of the lab {lab}: run collisions grade first")
    points = written.read_tables(grades, lab, Book(grades).everybody())[0].given
    codes = Codes(grades) if points else str
    given = {entry: _given(points, codes(str(each["identity"]["student"]))) for entry, each in found.items()}
    worth = {name: points_of(name) for name in lessons.read(lab).written}
    marks = marks_of_nbgrader.marks(lab, worth, found, given, asked)
    if wrong := list(marks_of_nbgrader.CHECK(marks, "")):
        raise InvalidInput(f"the grades do not fit the lab, so grade again: {'; '.join(wrong[:3])}")
    script = (FILES / "into_gradebook.py").read_bytes()
    return Bundle({"marks.json": as_json(marks).encode("utf-8", "backslashreplace"), "into_gradebook.py": script})


def _given(points: Mapping[Key, Given], code: str) -> dict[str, Given]:
    """What a person gave for the answers of one student, by question."""
    return {key: each for (key, whose), each in points.items() if whose == code}


def _with_project(lab: str) -> dict[str, bytes]:
    """The whole project as far as grading one lab needs it, hidden tests and solutions included."""
    files = {f"project/{name}": content for name, content in {**_project(lab), **_settings()}.items()}
    return {**files, "lab.txt": f"{lab}\n".encode()}


def _project(lab: str) -> dict[str, bytes]:
    found = {}
    for path in (path for folder in _FOLDERS for path in (ROOT / folder).rglob("*")):
        name = _inside(path)
        tests = _TESTS.fullmatch(name)
        odd = "__pycache__" in path.parts or any(part.startswith(".") for part in Path(name).parts)
        if path.is_file() and not odd and not name.startswith(_LEFT_OUT) and (tests is None or tests[1] == lab):
            found[name] = path.read_bytes()
    return found | {name: (ROOT / name).read_bytes() for name in _AT_THE_ROOT}


def _settings() -> dict[str, bytes]:
    """What makes a copy of the project work where it is not installed: its packages, and the version of itself."""
    version = lab_version()
    metadata = f"Metadata-Version: 2.1\nName: collisions-lab\nVersion: {version}\n"
    return {f"collisions_lab-{version}.dist-info/METADATA": metadata.encode(), "requirements.txt": _requirements()}


def _requirements() -> bytes:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    return "\n".join([*project["dependencies"], *project["optional-dependencies"]["grading"], ""]).encode()


def _inside(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()
