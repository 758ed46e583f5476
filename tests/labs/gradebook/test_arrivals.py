"""Submissions in folders as platforms deliver them, with hostile names, links and archives."""

from __future__ import annotations

import os
import zipfile
from datetime import UTC, datetime

import pytest

from labs.gradebook.arrivals import arrivals
from labs.gradebook.layouts import CANVAS, GRADESCOPE, MOODLE, NBGRADER, PLAIN, Owner, owner_of
from labs.grading.submission.large_notebooks import LARGEST
from labs.grading.submission.opening import FILE_LIMIT
from reference.errors import InvalidInput


def put(folder, name: str, text: str = "x = 1\n") -> None:
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def found(folder, lab: str = "impulse") -> dict[str, str]:
    there, _ = arrivals(folder, lab)
    return {each.owner.key: each.file for each in there}


def test_each_platforms_names_say_whose_a_submission_is():
    assert owner_of("submission_310").key == "310"
    late = owner_of("lovelaceada_LATE_7_4711_impulse-2.ipynb")
    assert late == Owner(CANVAS, "7", "lovelaceada", late=True, file="impulse.ipynb", number=4711)
    in_time = owner_of("o'brien_8_4712_my lab_final.py")
    assert (in_time.platform, in_time.key, in_time.late, in_time.file) == (CANVAS, "8", False, "my lab_final.py")
    moodle = owner_of("Ada van der Lovelace_4711_assignsubmission_file_")
    assert (moodle.platform, moodle.key, moodle.name) == (MOODLE, "4711", "Ada van der Lovelace")
    assert owner_of("Ada_4711_assignsubmission_file_impulse.ipynb").file == "impulse.ipynb"
    files = ("ada", "ada.ipynb", "ada.b.zip", "ada.ipynb.json", "ada.PDF")
    assert [owner_of(each).key for each in files] == ["ada", "ada", "ada.b", "ada", "ada"]
    assert owner_of("ada.b", is_file=False).key == "ada.b"


def test_canvas_files_of_several_attempts_count_once(tmp_path):
    for name in ("ada_1_9_impulse.ipynb", "ada_1_11_impulse-2.ipynb", "ada_1_10_impulse-1.ipynb", "bob_2_8_lab.py"):
        put(tmp_path, name)
    there, missing = arrivals(tmp_path, "impulse")
    assert {(each.owner.key, each.entry) for each in there} == {
        ("1", "ada_1_11_impulse-2.ipynb"),
        ("2", "bob_2_8_lab.py"),
    }
    (ada,) = (each for each in there if each.owner.key == "1")
    assert ada.notes == ("it holds ada_1_11_impulse-2.ipynb and 2 others; ada_1_11_impulse-2.ipynb is graded",)
    assert missing == []


def test_gradescope_says_who_handed_in_and_when_also_for_a_group(tmp_path):
    put(tmp_path, "submission_310/impulse.ipynb")
    put(tmp_path, "submission_311/impulse.ipynb")
    put(
        tmp_path,
        "submission_metadata.yml",
        """\
submission_310:
  :submitters:
  - :name: Ada Lovelace
    :sid: '4711'
    :email: ada@example.org
  - :name: Bob
    :sid: '4712'
    :email: bob@example.org
  :created_at: 2026-11-30 22:10:00 Z
""",
    )
    there, _ = arrivals(tmp_path, "impulse")
    assert [(each.owner.platform, each.owner.key, each.email) for each in there] == [
        (GRADESCOPE, "4711", "ada@example.org"),
        (GRADESCOPE, "4712", "bob@example.org"),
        (GRADESCOPE, "311", ""),
    ]
    assert there[0].received == datetime(2026, 11, 30, 22, 10, tzinfo=UTC)


def test_nbgraders_folder_is_found_below_with_its_times(tmp_path):
    put(tmp_path, "submitted/ada/impulse/impulse.ipynb")
    put(tmp_path, "submitted/ada/impulse/timestamp.txt", "2026-11-30 22:10:00.123456 UTC\n")
    put(tmp_path, "submitted/ada/detection/detection.ipynb")
    (ada,) = arrivals(tmp_path, "impulse")[0]
    assert (ada.owner.platform, ada.file) == (NBGRADER, "impulse/impulse.ipynb")
    assert ada.received == datetime(2026, 11, 30, 22, 10, 0, 123456, UTC)


def test_a_time_of_another_assignment_or_one_that_a_student_wrote_does_not_count(tmp_path):
    early = "2026-11-01 12:00:00 UTC"
    put(tmp_path, "ada/avoidance/timestamp.txt", early)
    put(tmp_path, "ada/impulse/impulse.ipynb")
    put(tmp_path, "ada/impulse/old/timestamp.txt", early)
    put(tmp_path, "Bob_31_assignsubmission_file_/impulse.ipynb")
    put(tmp_path, "Bob_31_assignsubmission_file_/timestamp.txt", early)
    with zipfile.ZipFile(tmp_path / "cyd.zip", "w") as archive:
        archive.writestr("impulse.ipynb", "x = 1")
        archive.writestr("timestamp.txt", early)
    assert [(each.received, each.stamp) for each in arrivals(tmp_path, "impulse")[0]] == [(None, "")] * 3


def test_what_nbgrader_says_of_the_time_is_kept_where_nobody_can_read_it(tmp_path):
    for name, stamp in (("ada", "\ufeff2026-11-30 22:10:00"), ("bob", "2026-11-30 22:10:00 CST"), ("cyd", "soon")):
        put(tmp_path, f"submitted/{name}/ps1/impulse.ipynb")
        put(tmp_path, f"submitted/{name}/ps1/timestamp.txt", f"{stamp}\n")
    assert [(each.received, each.stamp) for each in arrivals(tmp_path, "impulse")[0]] == [
        (datetime(2026, 11, 30, 22, 10, tzinfo=UTC), "2026-11-30 22:10:00"),
        (None, "2026-11-30 22:10:00 CST"),
        (None, "soon"),
    ]


def test_a_student_may_have_a_name_that_begins_with_a_dot(tmp_path):
    for name in ("..ada/impulse.ipynb", ".git/impulse.ipynb", ".bob.ipynb", "__MACOSX/impulse.ipynb"):
        put(tmp_path, name)
    assert found(tmp_path) == {"..ada": "impulse.ipynb"}


def test_of_several_files_the_one_of_the_lab_is_graded(tmp_path):
    put(tmp_path, "ada/detection.ipynb")
    put(tmp_path, "ada/Impulse.ipynb")
    put(tmp_path, "ada/.ipynb_checkpoints/impulse.ipynb")
    put(tmp_path, "bob/homework.ipynb")
    put(tmp_path, "carl/a.ipynb")
    put(tmp_path, "carl/b.py")
    put(tmp_path, "dora/impulse (1).ipynb")
    put(tmp_path, "dora/impulse-final.ipynb")
    put(tmp_path, "eve/notes.txt")
    there, missing = arrivals(tmp_path, "impulse")
    assert {each.owner.key: each.file for each in there} == {
        "ada": "Impulse.ipynb",
        "bob": "homework.ipynb",
        "dora": "impulse (1).ipynb",
    }
    assert there[-1].notes == ("it holds impulse (1).ipynb and impulse-final.ipynb; impulse (1).ipynb is graded",)
    assert {each.entry: each.why for each in missing} == {
        "carl": "it holds a.ipynb and b.py, and none is named impulse",
        "eve": "there is neither a notebook nor a .py file, only notes.txt",
    }


def test_the_notebook_is_found_in_a_whole_tree_that_is_handed_in(tmp_path):
    names = [*(f".venv/{number}.py" for number in range(6000)), *(f"data/{number}.npz" for number in range(1000))]
    with zipfile.ZipFile(tmp_path / "bob.zip", "w") as archive:
        for name in (*names, "labs/notebooks/impulse.ipynb"):
            archive.writestr(f"lab/{name}", "")
    with zipfile.ZipFile(tmp_path / "bob.zip") as archive:
        archive.extractall(tmp_path / "ada")
    assert set(found(tmp_path).values()) == {"lab/labs/notebooks/impulse.ipynb"}


def test_an_archive_is_read_without_being_unpacked(tmp_path):
    with zipfile.ZipFile(tmp_path / "ada.zip", "w") as archive:
        archive.writestr("../../impulse.ipynb", "outside")
        archive.writestr("__MACOSX/._impulse.ipynb", "mac")
    (tmp_path / "bob.zip").write_bytes(b"PK\x03\x04 no archive at all")
    there, missing = arrivals(tmp_path, "impulse")
    assert [(each.owner.key, each.read()) for each in there] == [("ada", b"outside")]
    assert [(each.entry, each.why) for each in missing] == [("bob.zip", "it cannot be opened: File is not a zip file")]
    assert not (tmp_path.parent / "impulse.ipynb").exists()


def test_a_bomb_is_refused_by_its_size_and_read_no_further_than_the_limit(tmp_path):
    for student, name, size in (("a", "impulse.ipynb", LARGEST), ("b", "impulse.py", FILE_LIMIT)):
        with zipfile.ZipFile(tmp_path / f"{student}.zip", "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr(name, b"0" * (size + 2**20))
    notebook, python = arrivals(tmp_path, "impulse")[1]
    assert notebook.why == "impulse.ipynb has 65 MB, more than 64"
    assert python.why == "impulse.py has 11 MB, more than 10"


def test_links_are_not_followed(tmp_path):
    secret = tmp_path / "secret.ipynb"
    secret.write_text("secret")
    folder = tmp_path / "class"
    put(folder, "ada/homework.py")
    os.symlink(secret, folder / "ada" / "impulse.ipynb")
    os.symlink(secret, folder / "bob.ipynb")
    os.symlink(tmp_path, folder / "carl")
    assert found(folder) == {"ada": "homework.py"}
    assert {each.entry for each in arrivals(folder, "impulse")[1]} == {"bob.ipynb", "carl"}


@pytest.mark.parametrize("name", ["", "empty"])
def test_a_folder_without_submissions_is_refused(tmp_path, name):
    (tmp_path / "empty").mkdir()
    with pytest.raises(InvalidInput, match="holds no submission" if name else "is no folder"):
        arrivals(tmp_path / (name or "missing"), "impulse")


def test_a_name_that_is_no_text_becomes_one(tmp_path):
    place = os.fsencode(tmp_path) + b"/ada\xff"
    os.mkdir(place)
    with open(place + b"/impulse\xfe.py", "w", encoding="utf-8") as file:
        file.write("x = 1\n")
    (ada,) = arrivals(tmp_path, "impulse")[0]
    assert (ada.owner.key, ada.entry, ada.file) == (r"ada\xff", r"ada\xff", r"impulse\xfe.py")
    assert ada.read() == b"x = 1\n"


def test_a_plain_folder_names_its_students(tmp_path):
    put(tmp_path, "ada.py")
    put(tmp_path, "zoë müller/impulse.py")
    there, _ = arrivals(tmp_path, "impulse")
    assert {(each.owner.platform, each.owner.key) for each in there} == {(PLAIN, "ada"), (PLAIN, "zoë müller")}
