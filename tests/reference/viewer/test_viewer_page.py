"""Pages with replays: whole in themselves, well formed, and a still picture where no script runs."""

from __future__ import annotations

import base64
import html as escaping
import json
import re
import xml.etree.ElementTree as tree
from dataclasses import replace
from html.parser import HTMLParser
from importlib import resources

import numpy as np
import pytest
from clips import BALL, EVIL, bouncing, chain, flying, three_engines

from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Verdict
from reference.recording.reading import recall
from reference.report import files
from reference.report import page as report_page
from reference.report.replays import replay_of
from reference.report.sections import sections
from reference.running.study import run_job
from reference.scene.scenario import Box
from reference.viewer import page
from reference.viewer.clip import DASHES, Clip, Run, Solid
from reference.viewer.clip_making import clip
from reference.viewer.picture_bounds import framed
from reference.viewer.shapes import Capsule
from reference.viewer.still import still

SVG = "{http://www.w3.org/2000/svg}"


class Elements(HTMLParser):
    """The elements of a page with their attributes, and what stands in its scripts."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.found: list[tuple[str, dict[str, str | None]]] = []
        self.scripts: list[str] = []
        self._within = False
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found.append((tag, dict(attrs)))
        self._within = tag == "script"
        if self._within:
            self.scripts.append("")

    def handle_endtag(self, tag: str) -> None:
        self._within = False

    def handle_data(self, data: str) -> None:
        if self._within:
            self.scripts[-1] += data


def hostile() -> Clip:
    return clip(replace(BALL, name=EVIL), {"handwritten": bouncing(EVIL)})


# A page


def test_a_page_of_replays_requests_nothing():
    text = page.html([three_engines()])
    allowed = {"http://www.w3.org/2000/svg", "http://www.w3.org/1999/xhtml"}  # names, not addresses
    assert set(re.findall(r"https?://[^\s\"'<]+", text)) <= allowed
    elements = Elements(text)
    assert not [it for it in elements.found if {"src", "href"} & set(it[1])]
    assert not re.search(r"\b(fetch|import|XMLHttpRequest|WebSocket|eval)\b\s*\(", page.script())
    (policy,) = [it[1]["content"] for it in elements.found if it[1].get("http-equiv")]
    assert policy.startswith("default-src 'none';")


def test_many_replays_share_one_script_and_one_style():
    text = page.html([three_engines(f"Ball {i}") for i in range(20)], "Twenty")
    assert text.count(page.script()) == text.count(page.style()) == 1
    assert text.count('<div class="replay"') == 20
    assert len(text) < len(page.script()) + len(page.style()) + 20 * 11_000


def test_a_page_contains_the_text_given_about_its_replays():
    text = page.html([chain()], "Title", ["a question?"], ["a <lesson>"])
    places = [text.index(words) for words in ("<h1>Title", "a question?", "application/json", "a &lt;lesson&gt;")]
    assert places == sorted(places)


def test_each_of_several_replays_has_its_heading_and_none_starts_by_itself():
    first, second = three_engines("First"), three_engines("Second")
    alone, together = page.html([first]), page.html([first, second])
    assert ("<title>First</title>" in alone, "<h1>First</h1>" in alone, "<h2>" in alone) == (True, True, False)
    assert [f"<h2>{title}</h2>" in together for title in ("First", "Second")] == [False, True]
    starts = [text.partition("<style")[2].count('"Replay: First" data-autoplay') for text in (alone, together)]
    assert starts == [1, 0]


@pytest.mark.parametrize("made", [page.html([hostile()]), page.fragment(hostile()), page.frame(hostile())])
def test_hostile_names_make_no_element_and_end_no_script(made):
    inner = [it[1]["srcdoc"] or "" for it in Elements(made).found if "srcdoc" in it[1]]
    for text in (made, *inner):
        elements = Elements(text)
        assert not [it for it in elements.found if it[0] == "b"]
        assert not [script for script in elements.scripts if script.strip().startswith("window.evil")]
        data = [json.loads(script) for script in elements.scripts if script.startswith("{")]
        assert all(it["title"] == EVIL for it in data)


def test_the_script_sent_is_the_source_without_comments_and_indents():
    source = resources.files("reference.viewer").joinpath("replay.js").read_text(encoding="utf-8")
    sent = page.script()
    assert len(sent) < 22_000
    kept = [re.sub(r"(^|\s)//\s.*", "", line).strip() for line in source.splitlines()]
    assert sent.splitlines() == [line for line in kept if line]
    # A text that is cut off at two strokes would lose one of its quotation marks.
    assert all(line.count('"') % 2 == 0 for line in sent.splitlines())
    # A line of the source that is stripped must not be within a text of several lines.
    assert all(line.count("`") % 2 == 0 for line in kept)


# In a notebook


def test_a_frame_is_sandboxed_and_covers_a_still_picture():
    elements = Elements(page.frame(three_engines()))
    kinds = [tag for tag, _ in elements.found]
    assert kinds == ["div", "img", "style", "iframe"]
    picture, frame = elements.found[1][1], elements.found[3][1]
    assert frame["sandbox"] == "allow-scripts"
    assert "application/json" in (frame["srcdoc"] or "")
    assert picture["alt"] == "Bouncing ball, the last frame"
    kind, _, content = (picture["src"] or "").partition(",")
    assert kind == "data:image/svg+xml;base64"
    assert base64.b64decode(content).decode() == still(three_engines())


# The still


@pytest.mark.parametrize("made", [three_engines(), chain(), hostile(), clip(BALL, {})])
@pytest.mark.parametrize("alone", [True, False])
def test_a_still_is_a_self_contained_reproducible_picture(made, alone):
    text = still(made, alone)
    root = tree.fromstring(text)
    assert root.tag == f"{SVG}svg"
    assert "nan" not in text
    assert text == still(made, alone)
    assert ("<style>" in text) == alone


def test_a_still_shows_the_last_frame_with_each_run_in_its_line_style():
    made = three_engines()
    root = tree.fromstring(still(made))
    circles = list(root.iter(f"{SVG}circle"))
    assert len(circles) == 4
    heights = [float(circle.attrib["cy"]) for circle in circles]
    assert len(set(heights)) == 4
    groups = [group.attrib["stroke-dasharray"] for group in root.iter(f"{SVG}g")]
    assert groups == [" ".join(map(str, DASHES[look])) for look in (1, 2, 3)]
    words = [text.text or "" for text in root.iter(f"{SVG}text")]
    assert words == ["Bouncing ball, 1.00 s", "hand-written", "PyBullet*", "MuJoCo", "DART"]


def test_a_still_is_drawn_to_scale():
    made = clip(BALL, {"handwritten": bouncing()})
    root = tree.fromstring(still(made))
    (circle,) = root.iter(f"{SVG}circle")
    (ground,) = [path for path in root.iter(f"{SVG}path") if path.attrib.get("class") == "rest"]
    floor = max(float(y) for _, y in re.findall(r"([-\d.]+) ([-\d.]+)", ground.attrib["d"])[:2])
    up = made.runs[0].poses[-1, 0, 2]  # of the centre, m
    radius = float(circle.attrib["r"])
    assert (floor - float(circle.attrib["cy"])) / radius == pytest.approx(up / 0.1, rel=0.01)  # to a tenth of a pixel


def test_the_still_says_which_runs_ended_early_or_have_no_poses():
    made = clip(BALL, {"handwritten": bouncing(), "pybullet": bouncing("PyBullet", count=31)})
    assert ">PyBullet, until 0.50 s" in still(made)


def test_boxes_and_capsules_are_drawn_from_any_side():
    scenario, poses = flying(Box((0.1, 0.2, 0.3)), (0.0, 0.0, 2.0))
    oblique = tree.fromstring(still(clip(scenario, {"it": poses})))
    assert len([path for path in oblique.iter(f"{SVG}path") if path.attrib.get("class") == "body k0"]) == 3
    states = np.zeros((3, 1, 7))
    states[..., 3] = 1
    lone = framed(
        Clip("pill", 60, (Solid("pill", Capsule(0.1, 0.2)),), (Run("it", 0, ("pill",), states, np.zeros((3, 0, 3))),))
    )
    assert still(lone).count("A") == 2


# In the report


@pytest.fixture(scope="module")
def results():
    cases = {"ball-to-rest": ("e=0.8",), "struck-rod": ("e=1,x=0.499",)}
    return [
        run_job(Job(family, "handwritten", profile, names, with_poses=True))
        for family, names in cases.items()
        for profile in ("exact", "step")
    ]


def written(results: list[JobResult]) -> str:
    """The page of a report without its figures."""
    found = sections(results)
    replays = {section.family.name: made for section in found if (made := replay_of(section)) is not None}
    return report_page.render(found, {section.family.name: () for section in found}, [], "here", replays=replays)


def test_a_report_has_one_script_and_a_replay_for_each_scenario_with_poses(results):
    silent = [replace(result, poses=()) for result in results if result.job.family == "struck-rod"]
    text = written([*(result for result in results if result.job.family == "ball-to-rest"), *silent])
    assert text.count(page.script()) == 1
    (data,) = [json.loads(script) for script in Elements(text).scripts if script.startswith("{")]
    assert data["title"] == "Ball coming to rest: e=0.8"
    assert [run["title"] for run in data["runs"]] == ["hand-written"]  # what is not tuned is not in it
    assert text.index('id="ball-to-rest"') < text.index("application/json") < text.index('id="struck-rod"')


def test_a_report_without_poses_has_no_replay_script(results):
    text = written([replace(result, poses=()) for result in results])
    assert "application/json" not in text
    assert "replay" not in text


@pytest.mark.slow
def test_a_report_with_replays_is_reproducible_to_the_byte(results, tmp_path):
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        files.write(results[:1], tmp_path / name)
    assert (tmp_path / "one/index.html").read_bytes() == (tmp_path / "two/index.html").read_bytes()
    assert b"application/json" in (tmp_path / "one/index.html").read_bytes()


def test_the_replay_of_a_section_is_its_plotted_case(results):
    (rest, _) = sections(results)
    made = replay_of(rest)
    assert made is not None
    track = results[0].poses[0]
    assert (made.count, made.rate) == (track.count, track.rate)


def test_a_replay_has_what_is_plain_beside_what_counts_where_it_fails(results):
    exact, step = results[:2]
    wrong = replace(step, rows=tuple(replace(row, verdict=Verdict.FAIL) for row in step.rows))
    made = replay_of(sections([exact, wrong])[0])
    assert made is not None
    assert list(zip(made.tags(), (run.shown for run in made.runs), strict=True)) == [
        ("hand-written", True),
        ("hand-written step", True),
    ]


def test_a_missing_engine_is_replayed_from_its_recording():
    result = recall(Job("cradle", "pybullet", "tuned", ("5 touching",), with_poses=True))
    assert result is not None
    made = replay_of(sections([result])[0])
    assert made is not None
    (run,) = made.runs
    assert (run.title, run.note.split(" was recorded")[0]) == ("PyBullet*", f"* PyBullet {result.version}")
    assert run.count == made.count > 60
    assert ">PyBullet*, recorded" in still(made)


def test_names_in_a_fragment_are_escaped_for_html():
    text = page.fragment(hostile())
    assert escaping.escape(f"Replay: {EVIL}") in text


def test_script_and_style_are_in_the_package():
    folder = resources.files("reference.viewer")
    assert {"replay.js", "replay.css"} <= {entry.name for entry in folder.iterdir()}
