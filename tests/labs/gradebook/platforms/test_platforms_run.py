"""What is exported, run as each platform would run it: its own scripts, its folders, its files of results.

A platform installs packages from the network. Here they are those of this environment, so that pip finds them there.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from program import collisions
from submissions import notebook, solved_notebook

from labs.gradebook.platforms import classroom50, gradescope, prairielearn
from labs.project_folders import STUDENT_NOTEBOOKS

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the platforms run Linux")

STUB = STUDENT_NOTEBOOKS / "impulse.ipynb"
REVERSED = """\
import numpy as np


def normal_velocity(body_a, body_b, normal):
    normal = np.asarray(normal, float)
    if not np.allclose((normal**2).sum(-1), 1):
        raise ValueError("no unit normal")
    points = [np.asarray(each[0]) + np.cross(each[1], each[2]) for each in (body_a, body_b)]
    return ((points[1] - points[0]) * normal).sum(-1)
"""
"""B's velocity less A's: a known mistake."""
ATTACK = """\
import os, sys
os.system("echo {} > RESULTS")


def normal_velocity(body_a, body_b, normal):
    found = "".join(open(path).read() for path in ["TESTS", "RESULTS"])
    raise ValueError("<script>" + found)


def collide(*bodies, **named):
    open("RESULTS", "w").write('{"score": 65}')
    os._exit(0)
"""


@pytest.fixture(scope="module")
def packages(tmp_path_factory) -> Path:
    """An environment that has the packages of this one, and nothing of this copy of the lab."""
    folder = tmp_path_factory.mktemp("environment") / "python"
    subprocess.run([sys.executable, "-m", "venv", folder], check=True)
    (site,) = folder.glob("lib/python*/site-packages")
    (site / "packages.pth").write_text(f"{Path(np.__file__).parents[1]}\n", encoding="utf-8")
    return folder


def exported(platform: str, out: Path) -> Path:
    done = collisions("export", platform, "--lab", "impulse", "--out", out)
    assert done.code == 0, done.error
    return out


def emptied(folder: Path) -> Path:
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


# Gradescope


@pytest.fixture(scope="module")
def autograder(tmp_path_factory, packages):
    """The folder /autograder after Gradescope has unpacked the archive and run setup.sh."""
    root = tmp_path_factory.mktemp("gradescope") / "autograder"
    shutil.copytree(packages, root / "python", symlinks=True)
    archive = exported("gradescope", root.parent / "gradescope.zip")
    shutil.unpack_archive(archive, root / "source")
    subprocess.run(["bash", root / "source" / "setup.sh"], env={**os.environ, "AUTOGRADER_ROOT": str(root)}, check=True)
    shutil.copy(root / "source" / "run_autograder", root)
    (root / "run_autograder").chmod(0o755)
    (root / gradescope.METADATA).write_text('{"id": 123, "users": [{"name": "Ada", "email": "a@b.c"}]}')
    return root


def on_gradescope(root: Path, files: dict[str, bytes]) -> dict | None:
    """What Gradescope reads after a submission of these files; None if there is nothing to read."""
    place = emptied(root / "submission")
    for name, content in files.items():
        (place / name).write_bytes(content)
    path = root / gradescope.RESULTS
    path.parent.mkdir(exist_ok=True)
    path.write_text('{"score": 65}')  # of the submission before
    run = subprocess.run([root / "run_autograder"], cwd=root, env={**os.environ, "AUTOGRADER_ROOT": str(root)})
    assert (run.returncode == 0) == path.exists()
    if not path.exists():
        return None
    found = json.loads(path.read_text(encoding="utf-8"))
    assert list(gradescope.CHECK(found, "")) == []
    assert not path.stat().st_mode & 0o007
    assert "Ada" not in json.dumps(found)
    return found


@pytest.mark.weekly
def test_gradescope_gives_all_points_to_the_solved_notebook(autograder):
    found = on_gradescope(autograder, {"impulse.ipynb": solved_notebook("impulse")})
    assert found["score"] == 65
    assert {test["status"] for test in found["tests"]} == {"passed"}
    assert {test["visibility"] for test in found["tests"]} == {"visible", "after_published"}
    assert found["extra_data"]["grade"]["student"] == "123"
    assert (autograder / "source").stat().st_mode & 0o007 == 0


@pytest.mark.weekly
def test_gradescope_gives_nothing_to_the_notebook_that_everybody_starts_with(autograder):
    assert on_gradescope(autograder, {"impulse.ipynb": STUB.read_bytes()})["score"] == 0


@pytest.mark.slow
def test_gradescope_names_a_known_mistake_and_keeps_hidden_tests_back(autograder):
    files = {"impulse.ipynb": notebook(REVERSED), "other.py": b"x = 1\n"}
    found = on_gradescope(autograder, files)
    assert "normal_velocity" in found["extra_data"]["mistakes"]
    first = next(test for test in found["tests"] if test["name"].startswith("normal_velocity"))
    assert (first["status"], first["visibility"]) == ("failed", "visible")
    assert "The order is wrong" in first["output"]
    assert "are missing" in found["output"]
    hidden = [test for test in found["tests"] if test["visibility"] == "after_published"]
    assert len(hidden) > 5
    assert not [test for test in hidden if "body_a=" in test["output"]]


@pytest.mark.weekly
def test_gradescope_pays_no_attack_and_shows_it_nothing(autograder):
    tests = autograder / "source/project/tests/autograder/hidden/test_impulse.py"
    text = ATTACK.replace("TESTS", str(tests)).replace("RESULTS", str(autograder / gradescope.RESULTS))
    found = on_gradescope(autograder, {"impulse.py": text.encode()})
    assert found["score"] == 0
    assert "<script>" not in found["output"]
    assert "asks(" not in json.dumps(found)


@pytest.mark.weekly
@pytest.mark.parametrize(
    ("files", "said"),
    [
        ({"impulse.ipynb": b"{"}, "cut off"),
        ({}, "neither a notebook nor a .py file"),
        ({"a.py": b"", "=1+1.py": b""}, "none is named impulse"),
    ],
)
def test_gradescope_says_why_there_is_nothing_to_grade(autograder, files, said):
    found = on_gradescope(autograder, files)
    assert (found["score"], found["tests"]) == (0, [])
    assert said in found["output"]


@pytest.mark.weekly
def test_gradescope_gets_no_result_if_the_grader_fails(autograder):
    lab = autograder / "source" / "lab.txt"
    before = lab.read_text(encoding="utf-8")
    lab.write_text("nonsense\n", encoding="utf-8")
    assert on_gradescope(autograder, {"impulse.py": b"x = 1\n"}) is None
    lab.write_text(before, encoding="utf-8")


# PrairieLearn


@pytest.fixture(scope="module")
def job(tmp_path_factory, packages):
    """The folder /grade, and how PrairieLearn grades the files of a student in it."""
    course = exported("prairielearn", tmp_path_factory.mktemp("prairielearn") / "course")
    question = course / "questions" / "collisions-impulse"
    entrypoint = json.loads((question / "info.json").read_text())["externalGradingOptions"]["entrypoint"]
    root = course / "grade"
    shutil.copytree(question / "tests", root / "tests")

    def graded(content: bytes) -> dict:
        (emptied(root / "student") / "impulse.ipynb").write_bytes(content)
        shutil.rmtree(root / "results", ignore_errors=True)
        environment = {
            **os.environ,
            "GRADE_ROOT": str(root),
            "PATH": f"{packages / 'bin'}{os.pathsep}{os.environ['PATH']}",
        }
        subprocess.run([entrypoint.replace("/grade", str(root), 1)], env=environment, check=True)
        path = root / prairielearn.RESULTS
        assert path.stat().st_size < prairielearn.MOST_BYTES
        found = json.loads(path.read_text(encoding="utf-8"))
        assert list(prairielearn.CHECK(found, "")) == []
        return found

    return graded


@pytest.mark.slow
def test_prairielearn_grades_the_files_of_a_student(job):
    wrong = job(notebook(REVERSED))
    assert 0 <= wrong["score"] < 1
    assert any("The order is wrong" in test["message"] for test in wrong["tests"])
    assert job(b"{")["gradable"] is False


# Classroom 50


@pytest.mark.slow
def test_classroom_50_grades_a_repository_that_is_full_of_traps(tmp_path, packages):
    bundle, repository = exported("classroom50", tmp_path / "impulse"), tmp_path / "repository"
    names = [path.relative_to(bundle).as_posix() for path in bundle.rglob("*")]
    assert not [name for name in names if "/hidden" in name or "/solutions" in name or "/misconceptions/" in name]
    secret = tmp_path / "secret"
    secret.write_text("not yours")

    def graded(content: bytes) -> dict:
        emptied(repository)
        for name in ("numpy", "labs", "json"):
            (repository / name).mkdir()
            (repository / name / "__init__.py").write_text("raise SystemExit(9)\n")
        (repository / "impulse.ipynb").write_bytes(content)
        (repository / classroom50.RESULT).symlink_to(secret)
        environment = {
            **os.environ, "CLASSROOM": "physics", "ASSIGNMENT": "impulse", "ASSIGNMENT_TYPE": "individual",
            "SUBMISSION_TAG": "submit/2026-11-01T10-00-00Z-abc", "COMMIT_URL": "https://a/c", "OWNER": "ada",
            "RELEASE_URL": "https://a/r",
        }  # fmt: skip
        run = subprocess.run([packages / "bin/python", bundle / "autograder.py"], cwd=repository, env=environment)
        assert run.returncode == 0
        found = json.loads((repository / classroom50.RESULT).read_text(encoding="utf-8"))
        assert list(classroom50.CHECK(found, "")) == []
        return found

    wrong = graded(notebook(REVERSED))
    assert 0 <= wrong["score"] < wrong["max-score"]
    assert "The order is wrong" in (repository / classroom50.BODY).read_text(encoding="utf-8")
    broken = graded(b"{")
    assert (broken["score"], broken["max-score"]) == (0, wrong["max-score"])
    assert secret.read_text() == "not yours"
