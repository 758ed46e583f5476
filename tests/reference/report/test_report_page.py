"""The page: whole in itself, well formed, and complete for every family, engine and profile, or for what there is."""

from __future__ import annotations

import functools
import re
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from html.parser import HTMLParser

import pytest

from reference import lecture
from reference.catalogue.family import Family
from reference.catalogue.scenarios import catalogue
from reference.comparison.convergence import Errors
from reference.comparison.curves import Series
from reference.comparison.error_split import Share, Split
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import ALL_CASES, Row, Verdict
from reference.engines import engine_names, load_engine
from reference.report import figures, page
from reference.report.marks import LEGEND, MARKS
from reference.report.sections import sections
from reference.running.study import run_job

VOID = {"meta", "br", "link", "img", "hr", "input", "col", "wbr", "source", "base", "area", "embed", "track"}
PICTURE = '<svg xmlns="http://www.w3.org/2000/svg" id="{name}-figure"><path id="{name}-path" d="M0 0"/></svg>'
REST = catalogue()["ball-to-rest"]
STUDY = Errors((2e-3, 1e-3), (0.02, 0.01), 1.0)
EVIL = "<script>alert('moon')</script> & \"quotes\""


@dataclass(eq=False)
class Element:
    """An element of the page, with all the text inside it."""

    tag: str
    attributes: dict[str, str | None]
    inside: list[Element] = field(default_factory=list)
    words: list[str] = field(default_factory=list)

    def all(self, tag: str, name: str = "") -> list[Element]:
        """Elements of a tag at any depth, in the order of the page; of a class if one is given."""
        return [it for it in self.walk() if tag in ("", it.tag) and name in ("", *it.classes)]

    def walk(self) -> Iterator[Element]:
        """All elements at any depth, in the order of the page."""
        waiting = self.inside[::-1]
        while waiting:
            found = waiting.pop()
            yield found
            waiting += found.inside[::-1]

    @property
    def classes(self) -> list[str]:
        return (self.attributes.get("class") or "").split()

    @property
    def text(self) -> str:
        return " ".join("".join(self.words).split())


class Strict(HTMLParser):
    """Reads a page into a tree and refuses what a browser would quietly mend."""

    def __init__(self) -> None:
        super().__init__()
        self.root = Element("", {})
        self.open = [self.root]

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        names = [name for name, _ in attributes]
        assert len(set(names)) == len(names), f"<{tag}> has an attribute twice"
        element = Element(tag, dict(attributes))
        self.open[-1].inside.append(element)
        if tag not in VOID:
            self.open.append(element)
        elif tag == "br":
            self.handle_data(" ")

    def handle_startendtag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        self.open[-1].inside.append(Element(tag, dict(attributes)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open[-1].tag == tag, f"</{tag}> closes <{self.open[-1].tag}>"
        self.open.pop()

    def handle_data(self, data: str) -> None:
        for element in self.open:
            element.words.append(data)


def read(text: str) -> Element:
    reader = Strict()
    reader.feed(text)
    reader.close()
    assert reader.open == [reader.root], f"<{reader.open[-1].tag}> is never closed"
    return reader.root


def row(family: Family, quantity: str, case: str, job: Job, **changes) -> Row:
    entry = family.quantity(quantity)
    theory = {"expected": 0.25, "tolerance": 0.1, "reason": "a step late", "scale": 1.0} if entry.expect else {}
    verdict = Verdict.PASS if entry.expect else Verdict.SHOWN
    plain = Row(family.name, case, job.engine, job.profile, quantity, entry.unit, verdict, 0.26, **theory)
    return replace(plain, **changes)


def result(family: Family, name: str, profile: str) -> JobResult:
    engine, job = load_engine(name), Job(family.name, name, profile)
    scenario = family.cases[0].scenarios[0]
    settings = engine.settings(scenario, profile).describe()
    rows = tuple(row(family, quantity.name, case.name, job) for case in family.cases for quantity in family.quantities)
    described = engine.profiles(scenario)[profile]
    return JobResult(job, engine.title, described, rows, settings, "1.2.3", convergence=STUDY)


@functools.cache
def everything() -> tuple[JobResult, ...]:
    """Every family in every engine and profile."""
    return tuple(
        result(family, name, profile)
        for family in catalogue().values()
        for name in engine_names()
        for profile in load_engine(name).profiles(family.cases[0].scenarios[0])
    )


def without_answer(given: JobResult, verdict: Verdict, note: str) -> JobResult:
    """What a job gives whose worker died, or whose engine is not there."""
    rows = (Row(given.job.family, ALL_CASES, given.job.engine, given.job.profile, "", "", verdict, note=note),)
    return replace(given, rows=rows, settings="", version="", convergence=None)


def written(results: Iterable[JobResult], with_figures: bool = True) -> str:
    found = sections(results)
    names = [f"{it.family.name}-{kind}" for it in found for kind in ("trajectories", "convergence")]
    pictures = {
        it.family.name: [(PICTURE.format(name=name), f"What {name} shows.") for name in names if it.family.name in name]
        for it in found
    }
    shown = pictures if with_figures else dict.fromkeys(pictures, ())
    return page.render(found, shown, ["hand-written code", "an engine 1.2.3"], "Collisions Lab on a machine")


@pytest.fixture(scope="module")
def whole() -> str:
    return written(everything())


@pytest.fixture(scope="module")
def tree(whole) -> Element:
    return read(whole)


@functools.cache
def by_id(tree: Element) -> dict[str | None, Element]:
    return {it.attributes["id"]: it for it in tree.walk() if "id" in it.attributes}


def with_id(tree: Element, name: str) -> Element:
    return by_id(tree)[name]


def came_out(section: Element) -> Element:
    """The section's table of implementations: the first one."""
    return section.all("table")[0]


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


def test_the_page_opens_with_the_implementations_and_the_tuned_checks(tree):
    said = tree.all("header")[0].text
    assert "run by hand-written code, an engine 1.2.3." in said
    checks = sum(row.profile == "tuned" and row.verdict is Verdict.PASS for it in everything() for row in it.rows)
    assert f"{checks} of {checks} checks of tuned settings agree with theory, 0 fail." in said


def test_the_page_ends_with_its_origin_and_its_files(tree):
    said = tree.all("footer")[0].text
    assert "Collisions Lab on a machine" in said
    for name in ("rows.json", "rows.csv", "provenance.json"):
        assert name in said


def test_the_legend_explains_exactly_the_marks_that_occur(tree):
    entries = [it.text for it in tree.all("ul", "legend")[0].all("li")]
    assert entries == [f"{MARKS[verdict]} {verdict} {LEGEND[verdict]}" for verdict in (Verdict.PASS, Verdict.SHOWN)]


def test_the_overview_has_a_line_for_each_family_and_a_cell_for_each_run(tree):
    table = with_id(tree, "overview").all("table")[0]
    titles = [it.text for it in table.all("thead")[0].all("th")][1:]
    assert len(titles) == len(set(titles)) == 10
    for line, family in zip(table.all("tbody")[0].all("tr"), catalogue().values(), strict=True):
        assert line.all("th")[0].text == family.title
        ran = [
            f"{load_engine(name).title}, {profile}"
            for name in engine_names()
            for profile in load_engine(name).profiles(family.cases[0].scenarios[0])
        ]
        for title, cell in zip(titles, line.all("td"), strict=True):
            assert ("empty" in cell.classes) == (title not in ran)
            if title in ran:
                judged = len(family.cases) * sum(quantity.expect is not None for quantity in family.quantities)
                assert cell.text.startswith(f"{MARKS[Verdict.PASS]} {judged}/{judged}")
                assert cell.attributes["data-label"] == title


# Each family


@every_family
def test_a_familys_section_has_its_whole_description(family, tree):
    section = with_id(tree, family.name)
    assert section.all("h2")[0].text == family.title
    for text in (family.about, family.expected, *family.why):
        assert " ".join(text.split()) in section.text


@every_family
def test_a_statement_is_explained_once_and_then_linked(family, tree):
    section = with_id(tree, family.name)
    told = {number for before in catalogue().values() if before is not family for number in before.statements}
    for number in family.statements:
        entry, target = lecture.statement(number), f"#statement-{number}"
        assert f"{number}. {entry.title}" in section.text
        own = [it for it in section.all("li") if it.attributes.get("id") == target[1:]]
        if own:
            for text in filter(None, (entry.slide, entry.right, entry.erratum)):
                assert " ".join(text.split()) in own[0].text
        else:
            assert number in told
            assert target[1:] in by_id(tree)
            assert target in {it.attributes["href"] for it in section.all("a")}


@every_family
def test_every_profile_has_a_line_with_its_description_and_settings(family, tree):
    lines = came_out(with_id(tree, family.name)).all("tbody")[0].all("tr")
    ran = [it for it in everything() if it.job.family == family.name]
    for line, given in zip(lines, ran, strict=True):
        heading = line.all("th")[0].text
        assert heading == f"{given.title}, {given.job.profile} {given.description}"
        assert line.all("td", "settings")[0].text == given.settings
        assert ("counts" in line.classes) == (given.job.profile == "tuned")
        assert len(line.all("td")) == len(family.quantities) + 1


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
def test_a_family_shows_its_figures_with_captions(family, tree):
    section = with_id(tree, family.name)
    assert [it.all("figcaption")[0].text for it in section.all("figure")] == [
        f"What {family.name}-{kind} shows." for kind in ("trajectories", "convergence")
    ]
    assert all(len(it.all("svg")) == 1 and it.attributes["aria-label"] for it in section.all("figure"))


@every_family
def test_the_studied_errors_are_in_a_table_with_their_order(family, tree):
    (table,) = (it for it in with_id(tree, family.name).all("table") if "measured order" in it.text)
    lines = table.all("tbody")[0].all("tr")
    assert len(lines) == sum(it.job.family == family.name for it in everything())
    assert all("at 2 ms" in line.text and "at 1 ms" in line.text and "order 1.00" in line.text for line in lines)


@every_family
def test_reasons_for_tolerances_are_given_once_under_their_quantity(family, tree):
    notes = [it.text for it in with_id(tree, family.name).all("p", "note")]
    judged = [quantity for quantity in family.quantities if quantity.expect]
    assert sum(note.endswith("accepted: a step late.") for note in notes) == len(judged)


def test_the_figures_of_matplotlib_are_in_the_page_unchanged():
    drawn = replace(result(REST, "handwritten", "tuned"), series=Series((0.0, 1.0, 2.0), (1.0, 0.5, 0.25)))
    found = sections([drawn])
    pictures = [(figures.trajectories(found[0]), "curve"), (figures.convergence(found[0]), "errors")]
    tree = read(page.render(found, {"ball-to-rest": pictures}, [], ""))
    assert len(tree.all("svg")) == 2
    ids = Counter(it.attributes["id"] for it in tree.all("") if "id" in it.attributes)
    assert max(ids.values()) == 1
    assert {"ball-to-rest", "ball-to-rest-trajectories-axes_1", "ball-to-rest-convergence-axes_1"} <= set(ids)


# Less than everything

OURS = [result(REST, "handwritten", profile) for profile in ("tuned", "slide", "stock")]


def test_the_page_can_be_made_of_one_engine_alone():
    section = with_id(read(written(OURS)), "ball-to-rest")
    assert len(came_out(section).all("tbody")[0].all("tr")) == 3
    assert "PyBullet, tuned" not in section.text


def test_a_page_without_results_is_well_formed():
    tree = read(page.render([], {}, [], "Collisions Lab"))
    assert "run by nobody here: no engine answered." in tree.text
    assert "0 of 0 checks" in tree.text


@pytest.mark.parametrize(
    ("verdict", "note", "said"),
    [
        (Verdict.NOT_AVAILABLE, "get it by pip", "not available: get it by pip"),
        (Verdict.CRASHED, "its process died (SIGSEGV)", "crashed: its process died (SIGSEGV)"),
        (Verdict.NEEDS, "needs kinematic_response (step 1)", "needs kinematic_response (step 1)"),
        (Verdict.CANNOT_EXPRESS, "it has no words", "cannot express: it has no words"),
    ],
)
def test_an_engine_without_an_answer_has_a_line_that_says_why(verdict, note, said):
    missing = without_answer(result(REST, "mujoco", "tuned"), verdict, note)
    tree = read(written([*OURS, missing]))
    line = came_out(with_id(tree, "ball-to-rest")).all("tbody")[0].all("tr")[-1]
    assert line.all("th")[0].text.startswith("MuJoCo, tuned")
    assert line.all("td")[0].text == f"{MARKS[verdict]} {said}"
    assert line.all("td")[0].attributes["colspan"] == str(len(REST.quantities))
    glance = with_id(tree, "overview").all("tbody")[0].all("td")[-1]
    assert glance.text == f"{MARKS[verdict]} {verdict}"
    assert f"{verdict} {LEGEND[verdict]}" in tree.all("ul", "legend")[0].text


def test_a_page_of_crashed_runs_alone_lists_all_cases_as_crashed():
    crashed = without_answer(OURS[0], Verdict.CRASHED, "hung")
    section = with_id(read(written([crashed], with_figures=False)), "ball-to-rest")
    cases = section.all("table", "cases")[0].all("tbody")[0].all("tr")
    times = [f"{REST.quantity('rest_time').theory(case):.5g} s" for case in REST.cases]  # theory needs no run
    assert [line.text for line in cases] == [
        f"{case.name}{time}{MARKS[Verdict.CRASHED]}" for case, time in zip(REST.cases, times, strict=True)
    ]
    assert section.all("figure") == []


def test_without_studies_there_is_no_table_of_errors():
    plain = [replace(it, convergence=None) for it in OURS]
    section = with_id(read(written(plain)), "ball-to-rest")
    assert "Error against timestep in figures" not in section.text
    assert "measured order" not in section.text


def test_a_case_run_in_one_engine_is_an_empty_cell_in_the_other():
    one = replace(OURS[0], rows=tuple(it for it in OURS[0].rows if it.case == "e=0.5"))
    table = with_id(read(written([one, OURS[2]])), "ball-to-rest").all("table", "cases")[0]
    empty = [[it.classes == ["empty"] for it in line.all("td")[1:]] for line in table.all("tbody")[0].all("tr")]
    assert empty == [[False, False], [True, False], [True, False]]


# Worst first, and where errors come from


def test_the_page_begins_with_links_to_all_scenarios_and_to_the_worst(tree):
    (jumps,) = tree.all("nav")
    assert [link.attributes["href"] for link in jumps.all("a")] == [*(f"#{name}" for name in catalogue()), "#worst"]


def test_the_worst_tuned_row_is_first_with_the_share_of_its_limit():
    bad = replace(OURS[0].rows[0], measured=0.33)  # 0.08 of a tolerance of 0.1; all others use 0.01 of it
    worst = with_id(read(written([replace(OURS[0], rows=(bad, *OURS[0].rows[1:]))])), "worst")
    first = worst.all("tbody")[0].all("tr")[0]
    assert first.text.strip().startswith("ball-to-rest")
    assert "80 %" in first.text


def test_stock_rows_that_fail_are_listed_separately():
    stock = next(it for it in OURS if it.job.profile == "stock")
    failed = replace(stock.rows[0], verdict=Verdict.FAIL, measured=1.25)
    worst = with_id(read(written([OURS[0], replace(stock, rows=(failed, *stock.rows[1:]))])), "worst")
    tuned, others = worst.all("tbody")
    assert "stock" not in tuned.text
    assert [line.all("td")[0].text.strip() for line in others.all("tr")] == ["hand-written, stock"]


def test_a_split_error_lists_each_moved_setting_and_both_errors():
    shares = (
        Share("discretisation", "timestep 0.001 → 0.0005", 0.01, 0.005, 0.01),
        Share("solver", "iterations 50 → 100", 0.01, 0.01, 0.0),
        Share("remainder", "what no move explains", 0.01, 0.0, 0.0),
    )
    given = replace(OURS[0], split=Split("e=0.5", "rest_time", shares))
    section = with_id(read(written([given])), "ball-to-rest")
    table = next(it for it in section.all("table") if "error before" in it.text)
    (line,) = table.all("tbody")[0].all("tr")
    assert [cell.text.strip() for cell in (*line.all("th"), *line.all("td"))] == [
        "discretisation",
        "timestep 0.001 → 0.0005",
        "+0.74 %",  # 0.01 s of the 1.3546 s that the ball takes at e = 0.5
        "+0.37 %",
        "+0.74 %",
    ]
    assert "No visible effect: iterations 50 → 100; remainder." in section.text


def test_without_a_split_the_page_has_no_table_of_shares():
    assert "Where the error comes from" not in with_id(read(written(OURS)), "ball-to-rest").text


def test_tables_of_cases_can_be_sorted_by_the_size_of_the_error(tree):
    table = with_id(tree, "ball-to-rest").all("table", "sortable")[0]
    cells = [cell for cell in table.all("td") if "data-sort" in cell.attributes]
    assert cells
    assert all(cell.attributes["data-sort"] == "" or float(cell.attributes["data-sort"]) >= 0 for cell in cells)


# Whatever a message holds


def test_messages_of_engines_are_shown_as_text_and_never_run():
    crashed = without_answer(result(REST, "mujoco", "tuned"), Verdict.CRASHED, EVIL)
    odd = replace(OURS[0], title=EVIL, description=EVIL, settings=EVIL)
    text = page.render(sections([odd, crashed]), {"ball-to-rest": [(PICTURE, EVIL)]}, [EVIL], EVIL)
    tree = read(text)
    assert "<script>alert" not in text
    assert len(tree.all("script")) == 1  # our own, for printing
    section, shown = with_id(tree, "ball-to-rest"), " ".join(EVIL.split())
    ours, theirs = came_out(section).all("tbody")[0].all("tr")
    assert ours.all("th")[0].text == f"{shown}, tuned {shown}"
    assert ours.all("td", "settings")[0].text == shown
    assert theirs.all("td")[0].text == f"{MARKS[Verdict.CRASHED]} crashed: {shown}"
    assert section.all("figcaption")[0].text == shown
    assert section.all("figure")[0].attributes["aria-label"] == EVIL
    assert shown in tree.all("header")[0].text
    assert shown in tree.all("footer")[0].text


def test_a_known_deviation_shows_its_remainder_and_its_reason():
    first, *others = (it for it in OURS[0].rows if it.case == "e=0.5")
    known = replace(first, verdict=Verdict.KNOWN_DEVIATION, measured=0.55, shift=0.29, note="half a step")
    tree = read(written([replace(OURS[0], rows=(known, *others))]))
    section = with_id(tree, "ball-to-rest")
    cell = came_out(section).all("td")[0]
    assert "known_deviation" in cell.classes
    assert (cell.all("b")[0].text, cell.all("span")[0].text, cell.all("small")[0].text) == (
        "≈ 1/1",
        "+30 %",
        "left 1 %",
    )
    assert "hand-written, tuned · known deviation: half a step." in [it.text for it in section.all("p", "note")]


# What waits for a rigid-body world


def test_the_page_shows_which_scenarios_need_a_world():
    both = ("h=0.1,μ=0.5,θ=20°", "h=0.1,μ=1.5,θ=50°")  # a cube that holds, as a point would, and one that tips
    jobs = [Job("tipping-box", "handwritten", "tuned", both), Job("stack", "handwritten", "tuned")]
    tree = read(written([run_job(job) for job in jobs]))
    overview = [[cell.text for cell in line.inside] for line in tree.all("table", "overview")[0].all("tr")]
    assert ["Stack of boxes", "… needs"] in overview
    assert ["Box on a slope: holds, slides or tips", "… 2/3"] in overview
    for name, times in (("tipping-box", ""), ("stack", " (2×)")):
        notes = [note.text for note in with_id(tree, name).all("p", "note")]
        assert f"hand-written, tuned{times} · needs a rigid-body world (world)." in notes
    (whole,) = (cell for cell in came_out(with_id(tree, "stack")).all("td", "needs"))
    assert whole.text == "… needs a rigid-body world (world)"
    halves = [cell.text for cell in came_out(with_id(tree, "tipping-box")).all("td", "needs")]
    assert [text.split(" ")[:2] for text in halves] == [["…", "1/2"], ["…", "1/2"]]
