"""What a run leaves to a person is a handful of lines, however large the class is."""

from __future__ import annotations

from pathlib import Path

from labs.gradebook.arrivals import EARLIER, Arrival, Missing
from labs.gradebook.class_list import Class
from labs.gradebook.class_run import Failures
from labs.gradebook.deadlines import CALLED_LATE, Lateness
from labs.gradebook.for_a_person import left_to_do
from labs.gradebook.layouts import PLAIN, Owner
from labs.gradebook.roster import Roster, Student
from labs.gradebook.tables import Mark

CODE = {"identity": {"file": "impulse.py"}, "answers": {"third-law": ""}}
NOTEBOOK = {"identity": {"file": "impulse.ipynb"}, "answers": {"third-law": "yes"}}


def arrival(*notes: str) -> Arrival:
    return Arrival(Owner(PLAIN, "1"), "1", "impulse.ipynb", bytes, notes=notes)


def test_three_hundred_odd_submissions_make_a_handful_of_lines():
    everybody = tuple(Student(str(number)) for number in range(300))
    found = Class(
        "impulse", Roster(everybody), {each.id: arrival("it holds a and b; a is graded") for each in everybody}
    )
    late = Lateness(said=CALLED_LATE)
    every = [Mark(each, "impulse", 45.0, 35.0, late, CODE) for each in everybody]
    lines = list(left_to_do(Path("grades"), found, every, Failures({"7": "busy", "8": "died"}, {"7"}), ()))
    assert [line.partition(": ")[0] for line in lines] == [
        "1 not graded for lack of time", "1 could not be graded", "300 with a doubt about what they handed in",
        "300 who handed in a Python file", "300 late, but the platform does not say by how much",
        "The written questions of 300 are to be marked",
    ]  # fmt: skip
    assert lines[2].startswith("300 with a doubt about what they handed in: 0, 1, 2, 3, 4 and 295 others. The notes in")
    assert all(len(line) < 250 for line in lines)


def test_what_needs_nobody_is_not_said():
    ada = Student("ada")
    found = Class("impulse", Roster((ada,)), {"ada": arrival(f"ada_1 {EARLIER} and is not graded")})
    every = [Mark(ada, "impulse", 100.0, content=NOTEBOOK), Mark(Student("bob"), "impulse", None, notes=("nothing",))]
    assert list(left_to_do(Path("grades"), found, every, Failures(), ())) == []


def test_who_is_on_no_roster_and_whose_file_cannot_be_read_are_named():
    found = Class("impulse", Roster(()), unusable={"bob": Missing(Owner(PLAIN, "bob"), "bob", "it is a link")})
    found.strangers["Canvas 66"] = Student("Canvas 66")
    every = [Mark(Student("eve"), "impulse", 0.0, content=CODE | {"unreadable": "it is empty"})]
    first, second = left_to_do(Path("grades"), found, every, Failures(), ())
    assert first == "1 not on the roster: Canvas 66. Their marks are in grades.csv, but in no file to upload."
    assert second.startswith("2 with nothing that could be graded: eve, bob. The notes in")
