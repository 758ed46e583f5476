"""The page and the tables of published cases: three kinds apart, every number, and what does not agree."""

from __future__ import annotations

import io
import json
import re
from dataclasses import replace
from html.parser import HTMLParser

import pytest
from rich.console import Console

from reference.comparison.verdicts import Verdict
from reference.errors import InvalidInput
from reference.published import recorded
from reference.published.jobs import run_job
from reference.published.results import PublishedJob
from reference.published.theirs import published
from reference.report import drawing, files, row_files
from reference.report.published.page import set_up
from reference.report.published.tables import PublishedTables, figure, label
from reference.report.published.terminal import print_published

NAMES = ("P11", "P15", "P22", "P23", "P24")


@pytest.fixture(scope="module")
def results():
    by_hand = [run_job(PublishedJob(name, "handwritten")) for name in NAMES]
    return [*by_hand, run_job(PublishedJob("P24", "pybullet"))]


@pytest.fixture(scope="module")
def tables(results):
    return PublishedTables.of(results)


@pytest.fixture(scope="module")
def folder(results, tmp_path_factory):
    made = tmp_path_factory.mktemp("report")
    files.write([], made, results)
    return made


@pytest.fixture(scope="module")
def text(folder):
    return (folder / "published.html").read_text(encoding="utf-8")


def printed(tables, with_cases=False) -> str:
    console = Console(width=80, record=True, file=io.StringIO())
    print_published(console, tables, with_cases)
    return console.export_text()


def with_rows(results, **changes):
    """The first result with all its rows changed."""
    rows = tuple(replace(row, **changes) for row in results[1].rows)
    return [results[0], replace(results[1], rows=rows), *results[2:]]


def test_three_kinds_of_published_cases_are_listed_in_order(tables):
    kinds = {kind: [line.case.name for line in tables.of_kind(kind)] for kind in ("verification", "validation")}
    assert kinds == {"verification": ["P15", "P22", "P24"], "validation": ["P11"]}
    assert [line.case.name for line in tables.of_kind("cross-engine")] == ["P23"]
    assert tables.engines == ("handwritten", "pybullet")


def test_a_cell_shows_the_worst_mark_and_how_many_numbers_agree(tables, results):
    cells = {line.case.name: {name: cell.text for name, cell in line.cells.items()} for line in tables.lines}
    assert cells["P15"] == {"handwritten": "✓ 11/11"}
    assert cells["P11"] == {"handwritten": "≈ 15/15"}
    assert cells["P24"] == {"handwritten": "✓ 2/2", "pybullet": "∅"}
    failed = PublishedTables.of(with_rows(results, verdict=Verdict.FAIL)).lines[1]
    assert failed.cells["handwritten"].text == "✗ 0/11"
    recorded = PublishedTables.of([replace(results[1], recording="* made elsewhere")])
    assert recorded.lines[0].cells["handwritten"].text == "✓ 11/11*"
    assert recorded.recordings == ["* made elsewhere"]


def test_the_sentence_counts_reproduced_cases_and_names_the_others(tables, results):
    assert tables.sentence.startswith("4 of 5 published cases agree in every number")
    (exception,) = tables.exceptions
    assert exception.startswith("P11: hand-written: known deviation: a real contact yields sideways")
    # Its own engine's agreement is none
    own = replace(results[1], job=PublishedJob("P9", "mujoco"))
    assert PublishedTables.of([own]).sentence.startswith("0 of 1")
    assert PublishedTables.of([replace(own, job=PublishedJob("P9", "dart"))]).sentence.startswith("1 of 1")


def test_the_published_table_fits_in_eighty_columns(tables):
    said = printed(tables)
    assert max(map(len, said.splitlines())) <= 80
    for title in ("Verification", "Validation against measurement", "Cross-engine"):
        assert re.search(f"^{title}", said, re.MULTILINE)
    assert re.search(r"^P15 +Impacts, apexes and the end of a bouncing ball +✓ 11/11", said, re.MULTILINE)
    assert "4 of 5 published cases agree" in said


def test_every_published_number_is_printed_with_its_difference_and_limit(tables):
    said = printed(tables, with_cases=True)
    assert max(map(len, said.splitlines())) <= 80
    assert re.search(r"^impacts 1, s +0\.45152 +published", said, re.MULTILINE)
    assert re.search(r"^  hand-written +0\.451523641 +\+3\.6·10⁻⁶ +5·10⁻⁶ +✓ pass", said, re.MULTILINE)
    assert "hand-written: accepted: half of the last of five printed decimals" in said
    assert "PyBullet: cannot express: " in said
    assert "Siconos, example BouncingBallED" in said


def test_a_failure_is_explained_even_without_the_cases(results):
    said = " ".join(printed(PublishedTables.of(with_rows(results, verdict=Verdict.FAIL, note="it is wrong"))).split())
    assert "P15, hand-written: fail: it is wrong" in said


def test_the_page_has_each_published_case_with_source_and_numbers(text, tables):
    for line in tables.lines:
        section = text[text.index(f'<section id="{line.case.name}">') :]
        assert line.case.title in section
        assert set_up(line.case) in section
        assert f'href="#{line.case.name}"' in text
    assert "0.451523641" in text
    assert "five printed decimals" in text


def test_the_page_says_which_published_numbers_differ_and_why(text):
    end = text[text.index('<section id="exceptions">') :]
    assert "P11: hand-written: known deviation: a real contact yields sideways" in end


def test_the_published_page_is_self_contained(text):
    class Tags(HTMLParser):
        def __init__(self):
            super().__init__()
            self.open, self.ids, self.links = [], [], []

        def handle_starttag(self, tag, attrs):
            given = dict(attrs)
            self.ids += [given["id"]] if "id" in given else []
            self.links += [given[name] for name in ("href", "src") if name in given]
            if tag not in ("meta", "br", "path", "use", "line"):
                self.open.append(tag)

        def handle_endtag(self, tag):
            if tag in self.open:
                while self.open.pop() != tag:
                    pass

    page = Tags()
    page.feed(text)
    assert len(page.ids) == len(set(page.ids))
    assert {link for link in page.links if link.startswith("#")} <= {f"#{own}" for own in page.ids}
    assert {link for link in page.links if not link.startswith("#")} == {"index.html"}
    assert "\x00" not in text


def test_report_and_published_page_link_to_each_other_if_both_exist(folder, text, tmp_path):
    assert 'href="published.html"' in (folder / "index.html").read_text(encoding="utf-8")
    assert 'href="index.html"' in text
    files.write([], tmp_path)
    assert not (tmp_path / "published.html").exists()
    assert "published.html" not in (tmp_path / "index.html").read_text(encoding="utf-8")


def test_measured_impacts_are_drawn_beside_the_rigid_law(tables, folder, text):
    (line,) = tables.of_kind("validation")
    pictures = [(each.name, each(), each.caption) for each in drawing.of_impacts(line)]
    assert [name for name, _, _ in pictures] == ["published-tangent-restitution", "published-spin"]
    for name, svg, caption in pictures:
        assert svg == (folder / "figures" / f"{name}.svg").read_text(encoding="utf-8")
        assert svg in text
        assert caption in text
        assert {"rigid sphere", "hand-written", "measured"} <= set(re.findall(">([a-z -]+)</text>", svg))


def test_a_case_that_is_still_running_is_not_counted_as_missed(results):
    running = with_rows(results, verdict=Verdict.RUNNING, measured=None)[1]
    before, after = PublishedTables.of([results[0]]), PublishedTables.of([results[0], running])
    assert len(after.lines) == 2
    assert (after.sentence, after.exceptions) == (before.sentence, before.exceptions)


def test_published_rows_are_read_back_as_they_were_written(folder, tables):
    assert row_files.read_published(folder / "published.json") == tables.rows


def test_recorded_published_rows_say_which_version_and_when(folder, tmp_path):
    result = recorded.recall(PublishedJob("P15", "mujoco"))
    (tmp_path / "published.json").write_text(row_files.published_json(result.rows), encoding="utf-8")
    (mark,) = {(row.engine_version, row.recorded_on) for row in row_files.read_published(tmp_path / "published.json")}
    assert mark[0] == result.version
    assert f"was recorded on {mark[1]} (" in result.recording
    assert {row.recorded_on for row in row_files.read_published(folder / "published.json")} == {""}


def test_published_rows_of_another_version_are_refused(folder, tmp_path):
    content = json.loads((folder / "published.json").read_text(encoding="utf-8"))
    (tmp_path / "published.json").write_text(json.dumps(content | {"version": 1}), encoding="utf-8")
    with pytest.raises(InvalidInput, match="reads collisions-lab/published version 3"):
        row_files.read_published(tmp_path / "published.json")
    with pytest.raises(InvalidInput, match="reads collisions-lab/rows version 3"):
        row_files.read_rows(folder / "published.json")


def test_published_figures_are_labelled_with_case_and_unit(results):
    tangent, impact = results[0].rows[0], results[1].rows[2]
    assert label(published("P11"), tangent) == "tangent restitution 9.84°"
    assert label(published("P15"), impact) == "impacts 3, s"
    assert [figure(value) for value in (None, 7406640.0, -6.2784e-5)] == ["", "7406640", "−6.2784·10⁻⁵"]
