"""Submissions as platforms and students really deliver them: several files, odd endings, archives and special files."""

from __future__ import annotations

import errno
import os
import socket
from pathlib import Path

import pytest
from submissions import notebook

from labs.gradebook import chosen_file, delivered_files
from labs.gradebook.arrivals import Arrival, arrivals, content_of
from labs.gradebook.class_list import Class, read_class, tasks
from labs.gradebook.class_run import Failures
from labs.gradebook.for_a_person import left_to_do
from labs.gradebook.layouts import CANVAS, MOODLE, PLAIN, Owner, owner_of
from labs.gradebook.roster import Roster, Student
from reference.errors import InvalidInput

PLOTS = notebook("x = 1\n")
NOTEBOOK = notebook("def normal_velocity(n, u):\n    return n @ u\n")
ADA = Owner(PLAIN, "ada")


def put(folder: Path, *names: str, content: bytes = NOTEBOOK) -> None:
    for name in names:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def one(folder: Path) -> Arrival:
    """The only submission of a folder, in which nothing is missing."""
    (found,), missing = arrivals(folder, "impulse")
    assert missing == []
    return found


def test_canvas_names_say_whose_a_file_is_also_without_names_and_of_texts():
    assert owner_of("LATE_anon_x7Kd2_99_impulse.ipynb") == Owner(
        CANVAS, "anon_x7Kd2", late=True, file="impulse.ipynb", number=99
    )
    assert owner_of("anon_12345_99_impulse.ipynb").key == "anon_12345"
    assert owner_of("de_la_cruzana_7_4711_impulse-3.ipynb.json").file == "impulse.ipynb.json"
    assert owner_of("lovelaceada_LATE_7_text.html") == Owner(
        CANVAS, "7", "lovelaceada", late=True, file="lovelaceada_LATE_7_text.html"
    )
    often = "lovelaceada_7_4711_impulse-0b5e9a3c-11aa-4bbb-8ccc-0123456789ab.ipynb"
    assert owner_of(often).file == "impulse.ipynb"
    assert owner_of("Default group_assignsubmission_file").key == "Default group"


@pytest.mark.parametrize(
    ("names", "graded", "doubt"),
    [
        (["impulse.ipynb", "report.pdf"], 0, False),
        (["zzz.ipynb", "impulse.py", "helpers.py"], 1, False),
        (["impulse.py", "impulse.ipynb"], 1, True),
        (["lab-impulse-final-2.ipynb", "plots.ipynb", "a.png"], 0, False),
        (["Impulse.ipynb", "impulse-final.ipynb"], 0, True),
        (["homework.ipynb", "homework-1.ipynb"], 1, True),
        (["impulse.ipynb.json", "response.ipynb"], 0, False),
        (["impulse.py", "impulse.ipynb.pdf"], 0, False),
        (["week-5.ipynb", "notes.txt"], 0, False),
    ],
)
def test_all_files_of_a_canvas_submission_are_one_and_the_one_of_the_lab_is_graded(tmp_path, names, graded, doubt):
    entries = [f"lovelaceada_7_{100 + place}_{name}" for place, name in enumerate(names)]
    for entry, name in zip(entries, names, strict=True):
        about = NOTEBOOK if any(each in name.lower() for each in ("impulse", "homework", "week")) else PLOTS
        put(tmp_path, entry, content=b"%PDF-1.4\n" if entry.endswith(".pdf") else about)
    found = one(tmp_path)
    assert found.entry == entries[graded]
    assert bool(found.notes) == doubt
    assert all(f"{entries[graded]} is graded" in note for note in found.notes)


def test_files_of_which_nobody_can_say_which_is_the_labs_are_named_and_not_guessed(tmp_path):
    put(tmp_path, "a_7_100_one.ipynb", "a_7_101_two.ipynb", "b_8_3_archive.zip", content=PLOTS)
    put(tmp_path, "bob/one.ipynb", "bob/two.ipynb")
    there, missing = arrivals(tmp_path, "impulse")
    assert there == []
    assert [each.why for each in missing] == [
        "it holds a_7_101_two.ipynb and a_7_100_one.ipynb, and none is named impulse",
        "it cannot be opened: File is not a zip file",
        "it holds one.ipynb and two.ipynb, and none is named impulse",
    ]


def test_several_entries_of_a_plain_or_moodle_student_are_one_submission(tmp_path):
    put(tmp_path, "ada.ipynb", "ada/impulse.ipynb", "bob.py", "bob.ipynb")
    put(tmp_path, "Eve_4_assignsubmission_file_impulse.ipynb")
    put(tmp_path, "Eve_4_assignsubmission_file_plots.py", content=b"x = 1\n")
    put(tmp_path, "Eve_4_assignsubmission_onlinetext_onlinetext.html", content=b"<p>done</p>")
    put(tmp_path, "Kim_5_assignsubmission_onlinetext_/onlinetext.html", content=b"<p>done</p>")
    there, missing = arrivals(tmp_path, "impulse")
    assert [each.entry for each in there] == ["Eve_4_assignsubmission_file_impulse.ipynb", "ada", "bob.ipynb"]
    assert [len(each.notes) for each in there] == [0, 1, 1]
    assert [each.why for each in missing] == ["there is neither a notebook nor a .py file, only onlinetext.html"]


def test_the_later_of_two_gradescope_submissions_is_graded_also_if_it_has_one_digit_more(tmp_path):
    put(tmp_path, "submission_99/impulse.ipynb", "submission_100/impulse.ipynb")
    people = "  :submitters:\n  - :name: Ada\n    :sid: '7'\n"
    put(tmp_path, "submission_metadata.yml", content=f"submission_99:\n{people}submission_100:\n{people}".encode())
    assert one(tmp_path).entry == "submission_100"
    (tmp_path / "submission_100" / "impulse.ipynb").unlink()
    (missing,) = arrivals(tmp_path, "impulse")[1]
    assert missing.why == "there is neither a notebook nor a .py file; submission_99 came before it and is not graded"


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("impulse.ipynb.json", NOTEBOOK),
        ("impulse.ipynb.txt", b"\xef\xbb\xbf" + NOTEBOOK),
        ("Impulse.IPYNB.download", NOTEBOOK),
        ("impulse.json", NOTEBOOK),
        ("impulse", NOTEBOOK),
        ("impulse.py.txt", b"def normal_velocity(): ...\n"),
    ],
)
def test_a_notebook_with_another_ending_is_read(tmp_path, name, content):
    put(tmp_path, f"lovelaceada_7_4711_{name}", f"ada/{name}", content=content)
    there, missing = arrivals(tmp_path, "impulse")
    assert ([each.file for each in there], missing) == ([name, name], [])
    assert content_of(there[0]) == content


@pytest.mark.parametrize("name", ["impulse.pdf", "impulse.rar", "impulse.docx", "impulse.html", "impulse.ipynb.pdf"])
def test_what_is_no_notebook_is_named_and_never_called_nothing(tmp_path, name):
    put(tmp_path, f"lovelaceada_7_4711_{name}", f"ada/{name}", content=b"%PDF-1.7\n")
    there, missing = arrivals(tmp_path, "impulse")
    assert (there, [each.why for each in missing]) == (
        [], [f"there is neither a notebook nor a .py file, only {name}"] * 2,
    )  # fmt: skip


def test_a_file_that_is_nobodys_makes_no_student_and_is_named(tmp_path):
    put(tmp_path, "ada.ipynb")
    put(tmp_path, "canvas.csv", "bob.pdf", "Thumbs.db", ".DS_Store", content=b"Student,ID\n")
    without = read_class(tmp_path, "impulse")
    assert ([each.id for each in without.students], without.strays) == (["ada"], ["Thumbs.db", "bob.pdf", "canvas.csv"])
    found = read_class(tmp_path, "impulse", Roster((Student("ada"), Student("bob"), Student("carl"))))
    assert (list(found.unusable), found.strays, found.strangers) == (["bob"], ["Thumbs.db", "canvas.csv"], {})
    (line, *_) = left_to_do(tmp_path, found, [], Failures(), ())
    assert "1 with nothing that could be graded: bob" in line
    assert any("2 among the submissions that no student handed in: Thumbs.db, canvas.csv" in each
               for each in left_to_do(tmp_path, found, [], Failures(), ()))  # fmt: skip
    (tmp_path / "ada.ipynb").unlink()
    with pytest.raises(InvalidInput, match="holds no submission"):
        arrivals(tmp_path, "impulse")


def test_pipes_sockets_and_links_are_named_and_never_opened(tmp_path):
    folder = tmp_path / "class"
    put(folder, "ada/homework.py", "bob/impulse.ipynb")
    os.mkfifo(folder / "pipe.ipynb")
    os.mkfifo(folder / "bob" / "impulse.py")
    os.mkfifo(folder / "eve.zip")
    os.symlink(folder / "bob" / "impulse.ipynb", folder / "ada" / "impulse.ipynb")
    os.symlink("/dev/zero", folder / "zero.ipynb")
    with socket.socket(socket.AF_UNIX) as bound:
        here = Path.cwd()
        os.chdir(folder)  # the name of a socket may be short alone
        bound.bind("socket.ipynb")
        os.chdir(here)
        there, missing = arrivals(folder, "impulse")
    assert {each.entry: each.notes for each in there} == {
        "ada": ("impulse.ipynb is a link, which is not followed",),
        "bob": ("impulse.py is a pipe between programs and not a file",),
    }
    pipe = "it is a pipe between programs and not a file"
    assert {each.entry: each.why for each in missing} == {
        "pipe.ipynb": pipe, "eve.zip": pipe, "socket.ipynb": pipe, "zero.ipynb": "it is a link, which is not followed",
    }  # fmt: skip


@pytest.fixture
def refused(monkeypatch):
    """Names that the system does not let anybody open or list, as an unprivileged user finds them."""
    names: set[str] = set()
    opened, iterdir = delivered_files.opened, Path.iterdir

    def open_unless_refused(path: Path) -> int:
        if path.name in names:
            raise PermissionError(errno.EACCES, "Permission denied", str(path))
        return opened(path)

    def list_unless_refused(path: Path):
        if path.name in names:
            raise PermissionError(errno.EACCES, "Permission denied", str(path))
        return iterdir(path)

    monkeypatch.setattr(delivered_files, "opened", open_unless_refused)
    monkeypatch.setattr(Path, "iterdir", list_unless_refused)
    return names


def test_what_this_machine_refuses_to_read_has_no_score_and_stops_nobody(tmp_path, refused):
    put(
        tmp_path, "ada.ipynb", "bob/impulse.ipynb", "carl/impulse.ipynb", "carl/inner/x.py", "eve.zip", "zoe/impulse.py"
    )
    refused |= {"ada.ipynb", "bob", "eve.zip", "inner"}
    for _ in range(2):  # the next run does the same
        found, failures = read_class(tmp_path, "impulse"), Failures()
        graded = [task.student for task in tasks(found, "", 60.0, with_runs=False, failures=failures)]
        assert graded == ["carl", "zoe"]
        assert failures.said == {
            "ada": "it could not be graded: ada.ipynb cannot be read: Permission denied",
            "bob": "it could not be graded: it cannot be opened: Permission denied",
            "eve": "it could not be graded: it cannot be opened: Permission denied",
        }
    assert found.handed["carl"].notes == ("inner cannot be opened: Permission denied",)
    refused.add(tmp_path.name)
    with pytest.raises(InvalidInput, match="cannot be read: Permission denied"):
        arrivals(tmp_path, "impulse")


def test_an_error_that_nobody_expects_belongs_to_its_entry(tmp_path, monkeypatch):
    put(tmp_path, "ada.zip", "bob.ipynb")

    def broken(*_):
        raise AssertionError("not even this")

    monkeypatch.setattr(delivered_files, "_list_archive", broken)
    (bob,), (ada,) = arrivals(tmp_path, "impulse")
    assert (bob.entry, ada.why) == ("bob.ipynb", "it cannot be opened: AssertionError: not even this")


def test_an_error_at_a_look_leaves_one_submission_without_a_score_and_an_unknown_lab_is_refused(tmp_path, monkeypatch):
    put(tmp_path, "ada.ipynb", "bob.ipynb")
    with pytest.raises(InvalidInput, match="impulses"):
        arrivals(tmp_path, "impulses")
    looks = chosen_file.looks

    def broken_once(files, lab):
        assert files[0].name != "ada.ipynb", "not even this"
        return looks(files, lab)

    monkeypatch.setattr(chosen_file, "looks", broken_once)
    (bob,), (ada,) = arrivals(tmp_path, "impulse")
    assert (bob.entry, ada.entry, ada.unreadable_here) == ("bob.ipynb", "ada.ipynb", True)
    assert ada.why.startswith("it cannot be looked at: AssertionError: not even this")


def test_a_submission_under_a_groups_name_is_named(tmp_path):
    students = (
        Student("1", "Lovelace, Ada", keys={CANVAS: frozenset({"7"})}),
        Student("2", "Müller, Zoë", keys={CANVAS: frozenset({"8"})}),
        Student("3", "O'Brien-Smith, Pat", keys={CANVAS: frozenset({"9"})}),
    )
    put(tmp_path, "thewaves_7_1_impulse.ipynb", "müllerzoë_8_2_impulse.ipynb", "obriensmithpat_9_3_impulse.ipynb")
    found = read_class(tmp_path, "impulse", Roster(students, CANVAS))
    assert {student: len(each.notes) for student, each in found.handed.items()} == {"1": 1, "2": 0, "3": 0}
    assert "'thewaves', but the roster has 'Lovelace, Ada'" in found.handed["1"].notes[0]
    other = read_class(tmp_path, "impulse", Roster(students, MOODLE))
    assert not any(each.notes for each in other.handed.values())


def test_a_file_that_takes_the_number_of_another_student_does_not_replace_theirs(tmp_path):
    students = tuple(Student(number, f"Last{number}, First", keys={CANVAS: frozenset({number})}) for number in "37")
    put(tmp_path, "last3first_3_100_lab.zip", content=b"PK")
    put(tmp_path, "last7first_7_101_impulse-1.ipynb", "x_7_3_1000_impulse.ipynb", "x_3_7_1000_impulse.ipynb")
    found = read_class(tmp_path, "impulse", Roster(students, CANVAS))
    assert found.handed["7"].entry == "last7first_7_101_impulse-1.ipynb"
    assert found.handed["7"].notes == ("x_7_3_1000_impulse.ipynb is of the same student and is not graded",)
    calls, broken = found.handed["3"].notes
    assert "calls it the submission of 'x'" in calls
    assert broken == "last3first_3_100_lab.zip: it cannot be opened: File is not a zip file"
    nobodys = read_class(tmp_path, "impulse")
    assert [each.id for each in nobodys.students] == ["7", "3"]


def test_doubts_get_a_line_for_a_person(tmp_path):
    found = Class("impulse", Roster(()), {"7": Arrival(ADA, "ada", "a.py", bytes, notes=("a.py is a link",))})
    assert any(
        "1 with a doubt about what they handed in: 7" in each
        for each in left_to_do(tmp_path, found, [], Failures(), ())
    )


def test_blackboard_and_brightspace_say_who_and_when_and_the_last_attempt_is_graded(tmp_path):
    put(tmp_path, "Lab 5_ada_attempt_2026-11-29-22-10-00_impulse.ipynb")
    put(tmp_path, "Lab 5_ada_attempt_2026-11-30-08-10-00_impulse.ipynb")
    put(tmp_path, "Lab 5_ada_attempt_2026-11-30-08-10-00_plots.py", content=b"x = 1\n")
    put(tmp_path, "Lab 5_b_o_b_attempt_2026-11-30-08-10-00_impulse.py")
    put(tmp_path, "Lab 5_ada_attempt_2026-11-30-08-10-00.txt", content=b"Name: Ada Lovelace (ada)\n")
    put(tmp_path, "397063-25 - Mary-Ann Smith - Nov 30, 2026 926 PM/impulse.ipynb")
    put(tmp_path, "397063-25 - Mary-Ann Smith - Nov 30, 2026 1201 AM/impulse.ipynb")
    put(tmp_path, "397063-25 - Al - October 3, 2026 1012 AM/impulse.ipynb")
    put(tmp_path, "index.html", content=b"<html>")
    there, missing = arrivals(tmp_path, "impulse")
    assert [(each.owner.key, f"{each.received:%d %H:%M}", len(each.notes)) for each in there] == [
        ("397063 Al", "03 10:12", 0), ("397063 Mary-Ann Smith", "30 21:26", 1), ("ada", "30 08:10", 1),
        ("b_o_b", "30 08:10", 0),
    ]  # fmt: skip
    assert [each.entry for each in missing] == ["index.html"]
    roster = Roster((Student("ada"), Student("17", "Smith, Mary-Ann"), Student("18", "Al")))
    assert list(read_class(tmp_path, "impulse", roster).handed) == ["18", "ada", "Blackboard b_o_b", "17"]
