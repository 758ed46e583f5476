"""The page: self-contained, well formed, and complete for every family, engine and profile."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import replace

import pytest
from pages import REST, Element, by_id, came_out, everything, read, result, with_id, written

from reference import lecture
from reference.catalogue.scenarios import catalogue
from reference.comparison.curves import Series
from reference.comparison.verdicts import Verdict
from reference.engines.settings_in_words import sentence_and_value
from reference.report import figures, page
from reference.report.marks import LEGEND, MARKS
from reference.report.sections import sections


@pytest.fixture(scope="module")
def whole() -> str:
    return written(everything())


@pytest.fixture(scope="module")
def tree(whole) -> Element:
    return read(whole)


every_family = pytest.mark.parametrize("family", catalogue().values(), ids=lambda family: family.name)


# The page as a whole


def test_the_page_is_well_formed(whole, tree):
    assert whole.startswith("<!doctype html>")
    for tag in ("html", "head", "body", "title", "h1", "header", "footer"):
        assert len(tree.all(tag)) == 1, tag
    assert tree.all("meta")[0].attributes == {"charset": "utf-8"}
    assert tree.all("html")[0].attributes["lang"] == "en"


def test_the_page_is_self_contained(whole, tree):
    for element in tree.all(""):
        for name in ("src", "href", "xlink:href", "srcset", "action", "data", "poster"):
            value = element.attributes.get(name)
            assert value is None or value.startswith("#"), (element.tag, name, value)
    assert not {it.tag for it in tree.all("")} & {"link", "img", "iframe", "object", "embed", "base"}
    assert "@import" not in whole
    assert not re.search(r"url\(\s*['\"]?(?!#)", whole)
    assert re.findall(r"https?:[^\s\"'<>]*", re.sub(r'xmlns(:\w+)?="[^"]*"', "", whole)) == []


def test_every_link_has_a_target_and_every_id_is_unique(tree):
    ids = Counter(it.attributes["id"] for it in tree.all("") if "id" in it.attributes)
    assert max(ids.values()) == 1
    links = {it.attributes["href"] for it in tree.all("a")}
    assert {link.removeprefix("#") for link in links} <= set(ids)
    assert {f"#{name}" for name in catalogue()} | {"#top"} <= links


def test_tables_have_a_heading_for_every_column(tree):
    for table in tree.all("table"):
        headings = len(table.all("thead")[0].all("th"))
        for line in table.all("tbody")[0].all("tr"):
            cells = [it for it in line.inside if it.tag in ("th", "td")]
            assert sum(int(it.attributes.get("colspan") or 1) for it in cells) == headings


def test_the_page_opens_with_the_implementations_and_the_checks_that_count(tree):
    assert "in hand-written code, an engine 3.2.7." in tree.all("header")[0].text
    counting = ("exact", "world", "tuned")
    checks = sum(row.profile in counting and row.verdict is Verdict.PASS for it in everything() for row in it.rows)
    (said,) = tree.all("p", "verdict")
    assert said.text == (
        f"Of {checks:,} checks that count, {checks:,} came out as predicted and near theory and none failed."
        " Engines as installed are shown, but not counted."
    )


def test_the_page_ends_with_its_origin_and_its_files(tree):
    said = tree.all("footer")[0].text
    assert "Collisions Lab on a machine" in said
    for name in ("rows.json", "rows.csv", "provenance.json"):
        assert name in said


def test_the_legend_explains_exactly_the_marks_that_occur(tree):
    entries = [it.text for it in tree.all("ul", "legend")[0].all("li")]
    assert entries == [f"{MARKS[verdict]} {verdict} {LEGEND[verdict]}" for verdict in (Verdict.PASS, Verdict.SHOWN)]


def test_the_overview_has_a_cell_for_each_run_and_shows_what_counts(tree):
    first, *folded = with_id(tree, "overview").all("table")
    assert all(it in with_id(tree, "overview").all("details")[place].walk() for place, it in enumerate(folded))
    headings = [[it.text for it in table.all("thead")[0].all("th")][1:] for table in (first, *folded)]
    assert headings[0].pop() == "each with each"
    # What counts, what is plain, other methods by hand, and other settings of the engines.
    assert [len(titles) for titles in headings] == [5, 4, 8, 9]
    assert {title.rpartition(", ")[2] for title in headings[0]} == {"exact", "world", "tuned"}
    assert {title.rpartition(", ")[2] for title in headings[1]} == {"step", "stock"}
    shown = {}
    for titles, table in zip(headings, (first, *folded), strict=True):
        for line in table.all("tbody")[0].all("tr"):
            cells = [cell for cell in line.all("td") if cell.attributes.get("data-label") != "each with each"]
            for title, cell in zip(titles, cells, strict=True):
                shown[line.all("th")[0].text, title] = cell
    for it in everything():
        family = catalogue()[it.job.family]
        judged = len(family.cases) * sum(quantity.expect is not None for quantity in family.quantities)
        cell = shown.pop((family.title, f"{it.title}, {it.job.profile}"))
        assert cell.text.startswith(f"{MARKS[Verdict.PASS]} {judged}/{judged}")
        assert cell.attributes["data-label"] == f"{it.title}, {it.job.profile}"
    assert all(cell.classes == ["empty"] for cell in shown.values())


def test_the_page_begins_with_links_to_all_scenarios_and_to_the_worst(tree):
    (jumps,) = tree.all("nav")
    assert [link.attributes["href"] for link in jumps.all("a")] == [*(f"#{name}" for name in catalogue()), "#worst"]


def test_tables_of_cases_can_be_sorted_by_the_size_of_the_error(tree):
    table = with_id(tree, "ball-to-rest").all("table", "sortable")[0]
    cells = [cell for cell in table.all("td") if "data-sort" in cell.attributes]
    assert cells
    assert all(cell.attributes["data-sort"] == "" or float(cell.attributes["data-sort"]) >= 0 for cell in cells)


# Each family


@every_family
def test_a_familys_section_has_its_whole_description(family, tree):
    section = with_id(tree, family.name)
    assert section.all("h2")[0].text == family.title
    marked = []
    for text in (family.about, family.expected, *family.why):
        marked += re.findall(r"`([^`]+)`", text)
        for prose in re.sub(r"`[^`]+`", "\0", text).split("\0"):  # formulas are typeset
            assert prose.strip() in section.text
    code = [name for name in marked if re.match(r"(?!sin |cos |tan |asin\()[A-Za-z]{3}", name)]
    assert set(code) <= {element.text for element in section.all("code")}
    assert len(section.all("math")) == len(marked) - len(code)


@every_family
def test_a_statement_is_explained_once_and_then_linked(family, tree):
    section = with_id(tree, family.name)
    told = {number for before in catalogue().values() if before is not family for number in before.statements}
    for number in family.statements:
        entry, target = lecture.statement(number), f"#statement-{number}"
        assert f"{number}. {entry.title}" in section.text
        own = [it for it in section.all("li") if it.attributes.get("id") == target[1:]]
        if own:
            for text in filter(None, (entry.erratum,)):
                assert " ".join(text.split()) in own[0].text
        else:
            assert number in told
            assert target[1:] in by_id(tree)
            assert target in {it.attributes["href"] for it in section.all("a")}


@every_family
def test_every_profile_has_a_line_and_is_told_its_settings(family, tree):
    section = with_id(tree, family.name)
    ran = [it for it in everything() if it.job.family == family.name]
    for line, given in zip(came_out(section).all("tbody")[0].all("tr"), ran, strict=True):
        title = f"{given.title}, {given.job.profile}"
        assert line.all("th")[0].text == title
        assert ("counts" in line.classes) == (given.job.profile in ("exact", "world", "tuned"))
        assert len(line.all("td")) == len(family.quantities)
        told = told_of(tree, "told", title) + told_of(tree, f"told-{family.name}", title)
        assert given.description in told or told_of(tree, "told", title) == ""
        for setting in given.settings.split(", "):
            sentence, _ = sentence_and_value(given.job.engine, setting)
            for part in re.split(r"\{[a-z]*\}", sentence.replace("`", "")):
                assert part in told, setting


def told_of(tree: Element, table: str, title: str) -> str:
    """What the page says of an implementation's settings there, or where a link says that it is the same."""
    if table not in by_id(tree):
        return ""
    for line in with_id(tree, table).all("tbody")[0].all("tr"):
        if line.all("th")[0].text == title:
            links = [str(it.attributes["href"]) for it in line.all("a")]
            return told_of(tree, links[0].removeprefix("#"), title) if links else line.text
    return ""


@every_family
def test_every_case_and_quantity_has_a_number_in_every_implementation(family, tree):
    section = with_id(tree, family.name)
    ran = [it for it in everything() if it.job.family == family.name]
    for table, quantity in zip(section.all("table", "cases"), family.quantities, strict=True):
        lines = table.all("tbody")[0].all("tr")
        for line, case in zip(lines, family.cases, strict=True):
            expected, *numbers = [it.text for it in line.all("td")]
            assert line.all("th")[0].text == case.name
            assert expected == (f"0.25 {quantity.unit}".strip() if quantity.expect else "no figure")
            assert len(numbers) == len(ran)
            assert all(number.startswith(f"0.26 {quantity.unit}".strip()) for number in numbers)


@every_family
def test_a_family_shows_its_figures_which_are_named(family, tree):
    section = with_id(tree, family.name)
    assert [it.all("div")[0].attributes["aria-label"] for it in section.all("figure")] == [
        f"What {family.name}-{kind} shows." for kind in ("trajectories", "convergence")
    ]
    assert all(len(it.all("svg")) == 1 for it in section.all("figure"))


@every_family
def test_the_studied_errors_are_in_a_table_with_their_order(family, tree):
    (table,) = (it for it in with_id(tree, family.name).all("table") if "measured order" in it.text)
    lines = table.all("tbody")[0].all("tr")
    assert len(lines) == sum(it.job.family == family.name for it in everything())
    assert all("at 2 ms" in line.text and "at 1 ms" in line.text and "order 1.00" in line.text for line in lines)


@every_family
def test_a_reason_for_a_tolerance_is_given_once_with_its_quantities(family, tree):
    (table,) = (it for it in with_id(tree, family.name).all("table") if "accepted as near theory" in it.text)
    titles = ", ".join(quantity.title for quantity in family.quantities if quantity.expect)
    (line,) = table.all("tbody")[0].all("tr")
    assert [cell.text for cell in line.inside] == [" ".join(titles.split()), "all", "a step late"]


def test_the_figures_of_matplotlib_are_in_the_page_unchanged():
    drawn = replace(result(REST, "handwritten", "exact"), series=Series((0.0, 1.0, 2.0), (1.0, 0.5, 0.25)))
    found = sections([drawn])
    pictures = [(figures.trajectories(found[0]), "curve"), (figures.convergence(found[0]), "errors")]
    tree = read(page.render(found, {"ball-to-rest": pictures}, [], ""))
    assert len(tree.all("svg")) == 2
    ids = Counter(it.attributes["id"] for it in tree.all("") if "id" in it.attributes)
    assert max(ids.values()) == 1
    assert {"ball-to-rest", "ball-to-rest-trajectories-axes_1", "ball-to-rest-convergence-axes_1"} <= set(ids)
