"""`collisions show --html`: the replay of a demonstration as a page."""

from __future__ import annotations

import json
import re

import pytest
from program import collisions

from labs.cli import jobs
from labs.demonstrations.catalogue import find
from reference.comparison.results import Job
from reference.errors import InvalidInput

pytestmark = pytest.mark.usefixtures("one_worker")


def clips(text: str) -> list[dict]:
    """The clips in a page."""
    return [json.loads(data) for data in re.findall(r'<script type="application/json">(.*?)</script>', text)]


def test_a_page_has_the_question_the_replay_and_the_lesson(tmp_path):
    file = tmp_path / "cradle.html"
    said = collisions("show", "cradle", "--engine", "handwritten", "--no-plot", "--html", file)
    assert said.code == 0, said.errors
    assert f"The replay is in {file}." in said.output.replace("\n", "")
    assert list(tmp_path.iterdir()) == [file]
    text = file.read_text(encoding="utf-8")
    (clip,) = clips(text)
    assert clip["title"] == "Newton's cradle, five, touching"
    assert [run["title"] for run in clip["runs"]] == ["hand-written", "hand-written, step"]
    assert [run["shown"] for run in clip["runs"]] == [True, False]
    asked = find("cradle")
    places = [
        text.index(words) for words in (asked.question.split("?")[0], "application/json", "Both ways keep energy")
    ]
    assert places == sorted(places)


def test_each_timestep_of_a_demonstration_has_a_replay_of_its_own(tmp_path):
    file = tmp_path / "wall.html"
    assert collisions("show", "tunnelling", "--engine", "handwritten", "--no-plot", "--html", file).code == 0
    titles = [clip["title"] for clip in clips(file.read_text(encoding="utf-8"))]
    assert titles == [f"A fast ball and a thin wall, {label}" for label in find("tunnelling").timesteps]


def test_poses_are_requested_only_for_a_page(tmp_path, monkeypatch):
    asked = []

    def run(planned: list[Job], *_: object, **__: object) -> None:
        asked.append({job.with_poses for job in planned})
        raise InvalidInput("that is enough")

    monkeypatch.setattr(jobs, "run", run)
    for more in ((), ("--html", tmp_path / "page.html")):
        assert collisions("show", "cradle", *more).code == 2
    assert asked == [{False}, {True}]


def test_without_poses_there_is_no_page(tmp_path):
    mine = tmp_path / "homework.py"
    mine.write_text("", encoding="utf-8")
    file = tmp_path / "page.html"
    said = collisions("show", "stop", "--engine", "handwritten", "--implementation", mine, "--html", file)
    assert said.code == 3
    assert "No run gave poses, so there is no replay" in said.text
    assert not file.exists()


@pytest.mark.parametrize(
    ("file", "said"),
    [
        ("page.svg", "page.svg' is no page; it ends in .html, .htm"),
        ("nowhere/page.html", "cannot write the replay to"),
        ("folder.html", "Is a directory; choose another --html"),
    ],
)
def test_a_page_that_cannot_be_written_is_refused_before_any_run(file, said, tmp_path, monkeypatch):
    monkeypatch.setattr(jobs, "run", lambda *_: pytest.fail("something ran"))
    (tmp_path / "folder.html").mkdir()
    ended = collisions("show", "bounce", "--html", tmp_path / file)
    assert ended.code == 2
    assert said in ended.error
