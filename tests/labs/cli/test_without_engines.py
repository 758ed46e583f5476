"""A machine on which no engine can be imported: every command answers from recordings, and says so."""

from __future__ import annotations

import re

import pytest
from program import collisions

from reference.catalogue.scenarios import catalogue
from reference.comparison.results import Job
from reference.engines import engine_names, load_engine
from reference.recording.reading import recall, replay
from reference.report.row_files import read_published, read_rows

pytestmark = pytest.mark.usefixtures("no_engine")

ENGINES = [name for name in engine_names() if load_engine(name).package]
TITLES = [load_engine(name).title for name in ENGINES]


def test_a_comparison_has_the_numbers_of_every_engine_each_marked_as_recorded():
    said = collisions("compare", "dropped-ball", "--profile", "tuned")
    assert said.code == 0, said.errors
    for title in TITLES:
        assert re.search(rf"^{title}\*, tuned +✓ 6/6", said.output, re.MULTILINE)
        assert re.search(rf"\* {title} \S+ was recorded on \S+ \(.*?\); it is not run here", said.text)


def test_a_value_between_two_recorded_ones_moves_all_to_the_nearest():
    said = collisions("compare", "sliding-slab", "--at", "friction=0.37", "--profile", "tuned")
    assert said.code == 0, said.errors
    names = f"{', '.join(TITLES[:-1])} and {TITLES[-1]}"
    assert f"friction 0.37 → 0.4 for all, since {names} answer from recordings" in said.text
    assert all(f"{title}*, tuned" in said.output for title in TITLES)


def test_other_people_s_cases_come_out_of_the_recordings_too():
    said = collisions("compare", "--published", "P13", "P17")
    assert said.code == 0, said.errors
    assert "2 of 2 published cases come out as published" in said.text
    assert "was recorded on" in said.text


def test_a_class_is_shown_a_question_that_hand_written_code_cannot_answer_yet():
    said = collisions("show", "roll", "--no-plot")
    assert said.code == 0, said.errors
    assert "1.4286 m/s" in said.output


def test_names_with_a_star_leave_room_for_every_column_of_a_terminal(monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    said = collisions("show", "tip", "--no-plot")
    assert said.code == 0, said.errors
    assert "…" not in said.output


@pytest.mark.parametrize("name", ENGINES)
def test_there_is_a_replay_of_every_case_that_was_run(name):
    for family in catalogue().values():
        job = Job(family.name, name, "tuned")
        for case in {row.case for row in recall(job).rows if row.quantity}:
            poses = replay(job, case)
            assert poses.positions.shape[0] == len(poses.times) > 10
            assert "was recorded on" in poses.recording


@pytest.mark.slow
@pytest.mark.timeout(1200)
def test_the_whole_report_is_written_and_all_recorded_tuned_numbers_agree_with_theory(tmp_path):
    said = collisions("report", "--out", tmp_path / "report")
    assert said.code == 0, said.errors
    rows = read_rows(tmp_path / "report" / "rows.json")
    assert {row.engine for row in rows if row.measured is not None} == set(engine_names())
    assert "not available" not in {str(row.verdict) for row in rows}
    judged = {str(row.verdict) for row in rows if row.profile == "tuned" and row.expected is not None}
    assert judged <= {"pass", "known deviation"}
    page = (tmp_path / "report" / "index.html").read_text(encoding="utf-8")
    assert all(f"{title}*" in page for title in TITLES)
    others = {str(row.verdict) for row in read_published(tmp_path / "report" / "published.json")}
    assert others == {"pass", "known deviation", "cannot express"}
