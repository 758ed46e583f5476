"""A course names a mistake once: its students read the name, next year's too, and nothing written is lost."""

from __future__ import annotations

import copy
import re
from concurrent.futures import ThreadPoolExecutor

import pytest
from made_grades import COUNT, FUNCTION, LAB, SCALED, grade_of

from labs.gradebook.mistakes.clusters import clusters
from labs.gradebook.mistakes.course_bank import CourseBank, read_bank
from labs.gradebook.mistakes.entries import Entry, entries_of, read_entries
from labs.gradebook.mistakes.naming import FILE, name_filled_in, read_waiting, write_waiting
from labs.gradebook.mistakes.same_numbers import Numbers, numbers_in
from labs.gradebook.pages import class_page, student_page
from labs.gradebook.roster import Student
from labs.gradebook.tables import Mark
from labs.grading.diagnosis.fingerprints.reading import known
from labs.grading.diagnosis.unnamed import known_numbers, probe_keys
from reference.errors import InvalidInput

OTHER = [0.5] * COUNT
TITLE, HELP = 'The impulse is "doubled" <b>\x7f</b> é \\', "What is e = 0?\nAnd e = 1?"


def numbers(values) -> Numbers:
    return Numbers(FUNCTION, dict(zip(probe_keys(FUNCTION), values, strict=True)))


@pytest.fixture
def places(tmp_path):
    """The folders of the grades and of the course's bank."""
    (tmp_path / "grades").mkdir()
    return tmp_path / "grades", tmp_path / "bank"


def run(places, *values) -> tuple[list[dict], list[str]]:
    """What a run of the command does about mistakes without a name: the grades with names joined, and what it says."""
    folder, bank = places
    names, waiting, notes = name_filled_in(folder, read_bank(bank))
    contents = {f"s{at}": names.joined(grade_of(each)) for at, each in enumerate(values)}
    shared = clusters(contents, lambda _: "", waiting, [entry.id for entry in names.entries])
    write_waiting(folder, shared, waiting, names)
    return list(contents.values()), notes


def write(folder, title: str, help: str, at: int = 0) -> None:
    """Fill in a table as a person does."""
    entries = read_waiting(folder)
    entries[at] = Entry(entries[at].id, entries[at].numbers, title, help)
    (folder / FILE).write_text("\n".join(entry.text() for entry in entries), encoding="utf-8")


def messages(contents) -> list[str]:
    return [content["functions"][0]["message"] for content in contents]


def test_a_mistake_is_named_once_and_everybody_who_makes_it_reads_title_and_help(places):
    folder, bank = places
    run(places, SCALED, SCALED, OTHER, OTHER)
    assert (folder / FILE).stat().st_mode & 0o777 == 0o600
    first = read_waiting(folder)
    assert [(entry.title, entry.help) for entry in first] == [("", ""), ("", "")]
    at = next(at for at, entry in enumerate(first) if entry.numbers == numbers(SCALED))
    write(folder, TITLE, HELP, at)
    contents, notes = run(places, SCALED, SCALED, OTHER, OTHER)
    assert notes == [f"{first[at].id} is named: {TITLE}"]
    assert read_waiting(folder) == [first[1 - at]]
    assert [entry.title for entry in read_bank(bank).entries] == [TITLE]
    for named in contents[:2]:
        function = named["functions"][0]
        assert function["named_by_course"] == {"title": TITLE.replace("\x7f", "␡"), "help": HELP}
        assert function["mistakes"] == [first[at].id]
        assert function["message"].startswith(f"{FUNCTION}: The impulse is")
        assert "Hint: What is e = 0? And e = 1?" in function["message"]
    assert messages(contents[2:]) == [grade_of(OTHER)["functions"][0]["message"]] * 2
    page = student_page(Mark(Student("1"), LAB, 1.0, content=contents[0]), (), {})
    assert "&lt;b&gt;" in page
    assert "<b>␡" not in page
    shown = class_page(LAB, [Mark(Student("1"), LAB, 1.0, content=each) for each in contents], {})
    assert re.search(rf">2</td><td><code>{first[at].id}</code></td><td>The impulse is", shown)


def test_next_year_the_first_who_makes_it_reads_its_name_within_rounding(places, tmp_path):
    run(places, SCALED, SCALED)
    write(places[0], "Doubled", "Why?")
    run(places, SCALED)
    (tmp_path / "next").mkdir()
    near = [value * (1 + 1e-6) for value in SCALED]
    (content,), notes = run((tmp_path / "next", places[1]), near)
    assert notes == []
    assert messages([content])[0].startswith(f"{FUNCTION}: Doubled\nHint: Why?")
    assert not (tmp_path / "next" / FILE).exists()


def test_a_grade_is_left_as_it_is_and_a_title_that_is_changed_later_reaches_its_students(places):
    run(places, SCALED, SCALED)
    write(places[0], "Doubled", "Why?")
    run(places, SCALED)
    before = grade_of(SCALED)
    kept, bank = copy.deepcopy(before), read_bank(places[1])
    bank.joined(before)
    assert before == kept
    path = places[1] / f"{LAB}.toml"
    path.write_text(f"# mine\n{path.read_text(encoding='utf-8').replace('Doubled', 'Twice as much')}", encoding="utf-8")
    contents, _ = run(places, SCALED)
    assert messages(contents)[0].startswith(f"{FUNCTION}: Twice as much\n")
    run(places, OTHER, OTHER)
    write(places[0], "Half", "Why?")
    run(places, OTHER)
    assert path.read_text(encoding="utf-8").startswith("# mine\n")  # what a person wrote stays
    assert [entry.title for entry in read_bank(places[1]).entries] == ["Twice as much", "Half"]


def test_nobody_else_is_accused(places):
    run(places, SCALED, SCALED)
    write(places[0], "Doubled", "Why?")
    run(places, SCALED)
    right = {"name": FUNCTION, "verdict": "right", "mistakes": [], "message": ""}
    known_one = {"name": FUNCTION, "verdict": "named", "mistakes": ["x"], "message": ""}
    bank = read_bank(places[1])
    for function in (right, known_one, grade_of(OTHER)["functions"][0], grade_of([*SCALED[:-1], 0])["functions"][0]):
        assert bank.joined({"functions": [function]})["functions"] == [function]
    assert bank.joined({"unreadable": "no"}) == {"unreadable": "no"}


def test_what_is_half_written_stays_until_it_is_whole(places):
    run(places, SCALED, SCALED)
    write(places[0], "Doubled", "")
    for values in ((SCALED, SCALED), ()):  # even if nobody makes the mistake any more
        _, notes = run(places, *values)
        assert "not named yet: it has a title and no help" in notes[0]
        assert [entry.title for entry in read_waiting(places[0])] == ["Doubled"]
    write(places[0], "Doubled", "Why?")
    run(places)
    assert [entry.title for entry in read_bank(places[1]).entries] == ["Doubled"]


def test_a_run_that_was_stopped_after_the_bank_was_written_changes_nothing_when_it_is_repeated(places):
    run(places, SCALED, SCALED)
    write(places[0], "Doubled", "Why?")
    text = (places[0] / FILE).read_text(encoding="utf-8")
    run(places, SCALED)
    bank = (places[1] / f"{LAB}.toml").read_bytes()
    (places[0] / FILE).write_text(text, encoding="utf-8")
    _, notes = run(places, SCALED)
    assert notes == []
    assert (places[1] / f"{LAB}.toml").read_bytes() == bank


def test_the_same_numbers_as_a_known_mistake_or_another_entry_get_no_name_and_the_reason_is_said(places):
    mistake = known(FUNCTION).mistakes[0]
    values = known_numbers(FUNCTION, mistake)
    run(places, values, values, SCALED, SCALED)
    entries = read_waiting(places[0])
    write(places[0], "Known", "?", next(at for at, each in enumerate(entries) if each.numbers == numbers(values)))
    _, notes = run(places, values, values)
    assert f"as {mistake.id}, which the lab knows" in notes[0]
    assert [entry.title for entry in read_waiting(places[0])] == ["Known"]
    bank = CourseBank(places[1], (Entry("mine", numbers(SCALED), "Mine", "?"),))
    assert "mine, 'Mine', has the same numbers" in bank.refusal(Entry("other", numbers(SCALED), "a", "b"))
    assert "of this name" in bank.refusal(Entry("mine", numbers(OTHER), "a", "b"))
    assert bank.refusal(Entry("other", numbers(OTHER), "a", "b")) == ""


GOOD = Entry("mine", numbers(SCALED), "Mine", "Why?").text()


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda text: text.replace("title =", "titel ="), r"line 2 of .*unknown field .*'titel'.*Did you mean 'title'"),
        (lambda text: text.replace("help = ", "#"), r"line 1 of .*\[mine\] has no help; it needs .*title, help"),
        (lambda text: text.replace('"Why?"', "3"), r"line 3 of .*has 3 as help"),
        (lambda text: text.replace('"Why?"', '"' + "x" * 1001 + '"'), r"line 3 of .*1001 characters"),
        (lambda text: text.replace(FUNCTION, "kinematic_respons"), rf"line 4 of .*Did you mean '{FUNCTION}'"),
        (lambda text: text.replace(" 0.1,", " nan,"), r"line 5 of .*no key with a number or one of none, shape, kind"),
        (lambda text: re.sub(r'numbers = ".*"', 'numbers = "abc 0, abd 0"', text), "line 5 of .*right or too few"),
        (lambda text: text.replace('title = "', "title = "), r"no TOML file: .*line 2"),
        (lambda text: f'title = "a"\n{text}', r"line 1 of .*write it below a \[name\]"),
        (lambda text: text + text, r"no TOML file: .*mine"),
    ],
)  # fmt: skip
def test_what_is_wrong_in_a_file_is_said_with_its_line_and_the_choices(tmp_path, change, said):
    path = tmp_path / f"{LAB}.toml"
    path.write_text(change(GOOD), encoding="utf-8")
    before = path.read_bytes()
    for read in (read_entries, lambda path: read_bank(path.parent)):
        with pytest.raises(InvalidInput, match=said):
            read(path)
    assert path.read_bytes() == before


@pytest.mark.parametrize(
    ("file", "text", "said"),
    [
        (f"{LAB}.toml", GOOD.replace('"Why?"', '""'), r"line 1 of .* the help of \[mine\] is empty"),
        (
            f"{LAB}.toml",
            GOOD + GOOD.replace("[mine]", "[too]"),
            r"line 6 of .* \[too\] has the same numbers as \[mine\]",
        ),
        ("respons.toml", GOOD, "unknown lab 'respons'. Did you mean 'response'"),
        ("impulse.toml", GOOD, rf"line 1 of .* \[mine\] is about {FUNCTION}; move it to response.toml"),
    ],
)
def test_a_bank_has_a_title_a_help_and_other_numbers_for_each_mistake(tmp_path, file, text, said):
    (tmp_path / file).write_text(text, encoding="utf-8")
    with pytest.raises(InvalidInput, match=said):
        read_bank(tmp_path)


def test_an_entry_is_read_as_it_was_written():
    entry = Entry("mine", numbers(["none", "shape", "kind", *SCALED[3:]]), TITLE, HELP)
    assert entries_of(entry.text(), "x") == [entry]
    assert numbers_in(grade_of(SCALED)["functions"][0]) == numbers(SCALED)


def test_two_who_name_at_once_lose_nothing(places):
    several = [Entry(f"e{at}", numbers([at + 1.0] * COUNT), f"T{at}", "?") for at in range(8)]
    with ThreadPoolExecutor(4) as pool:
        list(pool.map(lambda entry: read_bank(places[1]).with_entries([entry]), several))
    assert {entry.id for entry in read_bank(places[1]).entries} == {entry.id for entry in several}


def test_what_the_lab_can_no_longer_recognise_is_said_and_kept(places):
    stale = Entry("old", Numbers(FUNCTION, {f"gone{at}": 0.5 for at in range(COUNT)}), "Old", "?")
    bank = read_bank(places[1]).with_entries([stale, Entry("mine", numbers(SCALED), "Mine", "Why?")])
    assert bank.notes(LAB) == ["The lab has changed too much to recognise old of the course's bank."]
    assert bank.notes("impulse") == []
    assert read_bank(places[1]).entries == bank.entries
    (places[1] / f"{LAB}.toml").chmod(0o664)
    bank.with_entries([Entry("other", numbers(OTHER), "Other", "?")])
    assert (places[1] / f"{LAB}.toml").stat().st_mode & 0o777 == 0o664
