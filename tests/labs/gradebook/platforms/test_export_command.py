"""`collisions export`: what it writes for each platform, and what it refuses in a line."""

from __future__ import annotations

import json
import stat
import zipfile

import pytest
from made_platform_grades import grade
from program import collisions

from labs.building.archives import pack
from labs.building.points import points_of
from labs.gradebook.platforms import bundles, shapes
from labs.gradebook.written import Codes, questions
from labs.grading.judging import pytest_run
from reference import lecture

INFO = shapes.table(
    {
        "uuid": shapes.like("[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}"), "title": shapes.name, "topic": shapes.name,
        "tags": shapes.listed(shapes.name), "type": shapes.one_of("v3"), "singleVariant": shapes.flag,
        "gradingMethod": shapes.one_of("External"),
        "externalGradingOptions": shapes.table(
            {
                "enabled": shapes.flag, "image": shapes.name, "entrypoint": shapes.like("/grade/tests/.+"),
                "timeout": shapes.number(600), "enableNetworking": shapes.flag,
            },
            needed=("image", "entrypoint"),
        ),
    },
    needed=("uuid", "type", "title", "topic"),
)  # fmt: skip
"""Of a question's info.json: PrairieLearn's own schema infoQuestion.json, as far as it is used here."""


@pytest.fixture
def grades(tmp_path):
    """A folder of the grades of one student, whose lab has the points that it has."""
    content = grade()
    written = [entry.name for entry in lecture.functions_of("impulse") if entry.role == "written"]
    content["functions"] = [
        {**content["functions"][0], "name": name, "got": 1, "possible": points_of(name)} for name in written
    ]
    place = tmp_path / "grades" / "students" / "4711"
    place.mkdir(parents=True)
    (place / "grade.json").write_text(json.dumps(content), encoding="utf-8")
    return tmp_path / "grades"


@pytest.fixture(scope="module")
def of_gradescope():
    return bundles.gradescope("impulse")


def test_gradescopes_archive_has_two_scripts_at_its_root_that_can_be_run(tmp_path, of_gradescope):
    few = {name: content for name, content in of_gradescope.files.items() if name.count("/") < 2}
    pack(tmp_path / "gradescope.zip", few, of_gradescope.executable)
    with zipfile.ZipFile(tmp_path / "gradescope.zip") as archive:
        modes = {info.filename: stat.S_IMODE(info.external_attr >> 16) for info in archive.infolist()}
    assert {name for name, mode in modes.items() if mode == 0o755} == {"setup.sh", "run_autograder"}
    assert {mode for name, mode in modes.items() if "/" in name} == {0o644}


def test_an_autograder_holds_the_tests_of_its_own_lab_and_no_other(of_gradescope):
    tests = {name.removeprefix("project/tests/autograder/") for name in of_gradescope.files if "/autograder/" in name}
    assert tests == {"hidden/test_impulse.py", "visible/test_impulse.py"}
    assert not [name for name in of_gradescope.files if "__pycache__" in name or "/notebooks/" in name]


def test_an_autograder_says_which_packages_it_needs(of_gradescope):
    needed = of_gradescope.files["project/requirements.txt"].decode()
    assert all(f"{name}>=" in needed for name in ("numpy", "pytest", "hypothesis", "jupytext"))
    assert "collisions-lab[" not in needed


def test_prairielearns_question_has_its_settings_and_its_image_no_tests():
    bundle = bundles.prairielearn("impulse", "course/grader")
    question = "questions/collisions-impulse"
    info = json.loads(bundle.files[f"{question}/info.json"])
    assert list(INFO(info, "")) == []
    assert info["externalGradingOptions"]["image"] == "course/grader"
    assert b'file-names="impulse.ipynb"' in bundle.files[f"{question}/question.html"]
    assert {name for name in bundle.files if name.startswith("grader/")} == {
        "grader/Dockerfile", "grader/constraints.txt", "grader/requirements.txt",
    }  # fmt: skip
    assert f"{question}/tests/project/tests/autograder/hidden/test_impulse.py" in bundle.files
    assert bundle.executable == {f"{question}/tests/grade.sh"}


def test_nbgraders_marks_can_be_read_by_their_owner_alone(tmp_path, grades):
    (key, *_) = questions("impulse")
    code = Codes(grades)("4711")
    (grades / "questions").mkdir()
    line = f"{key.key},{code},{key.points},2,good"
    (grades / "questions" / "points.csv").write_text(f"question,code,possible,points,comment\n{line}\n", "utf-8")
    out = tmp_path / "marks"
    done = collisions("export", "nbgrader", "--lab", "impulse", "--grades", grades, "--out", out)
    assert done.code == 0, done.error
    assert [stat.S_IMODE(path.stat().st_mode) for path in (out, out / "marks.json")] == [0o700, 0o600]
    marks = json.loads((out / "marks.json").read_text(encoding="utf-8"))
    assert marks["students"]["ada"]["answers"] == {f"answer-{key.key}": {"points": 2.0, "comment": "    good"}}
    assert marks["students"]["ada"]["scores"]["check-collide"] == {"got": 1, "possible": points_of("collide")}


def test_grades_of_other_tests_are_not_exported(tmp_path, grades):
    path = grades / "students" / "4711" / "grade.json"
    path.write_text(path.read_text(encoding="utf-8").replace('"got": 1', '"got": 99'), encoding="utf-8")
    done = collisions("export", "nbgrader", "--lab", "impulse", "--grades", grades, "--out", tmp_path / "marks")
    assert done.code == 2
    assert "the grades do not fit the lab, so grade again" in done.error


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("moodle", "--lab", "impulse", "--out", "a"), "Choices: gradescope, classroom50, nbgrader, prairielearn."),
        (("gradescop", "--lab", "impulse", "--out", "a"), "Did you mean 'gradescope'?"),
        (("gradescope", "--lab", "impuls", "--out", "a.zip"), "Did you mean 'impulse'?"),
        (("gradescope", "--lab", "impulse", "--out", "a"), "it ends in .zip"),
        (("gradescope", "--lab", "impulse", "--out", "missing/a.zip"), "choose another --out"),
        (("gradescope", "--lab", "impulse", "--out", "a.zip", "--image", "x"), "--image is for prairielearn alone"),
        (("classroom50", "--lab", "impulse", "--out", "full"), "name a new folder"),
        (("classroom50", "--lab", "impulse", "--out", "a", "--grades", "b"), "--grades is for nbgrader alone"),
        (("nbgrader", "--lab", "impulse", "--out", "a"), "with --grades"),
        (("nbgrader", "--lab", "impulse", "--out", "a", "--grades", "full"), "run collisions grade first"),
    ],
)
def test_what_cannot_be_exported_is_said_in_a_line(tmp_path, monkeypatch, arguments, said):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "file").touch()
    found = collisions("export", *arguments)
    assert found.code == 2
    assert said in found.error
    assert [path.name for path in tmp_path.iterdir()] == ["full"]


def test_a_lab_without_tests_cannot_be_exported(tmp_path, monkeypatch):
    monkeypatch.setattr(pytest_run, "tested", lambda: ("detection", "impulse"))
    found = collisions("export", "gradescope", "--lab", "meshes", "--out", tmp_path / "a.zip")
    assert found.code == 2
    assert "meshes cannot be graded yet; choose one of detection, impulse" in found.error
    assert list(tmp_path.iterdir()) == []
