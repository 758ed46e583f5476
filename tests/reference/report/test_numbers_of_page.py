"""Every number in the tables of a whole page, read back from its text and compared with the rows of `rows.json`."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

import live
import pytest
from pages import Element, read, with_id

from reference.catalogue.scenarios import catalogue
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Row
from reference.engines import engine_names, load_engine
from reference.engines.profiles import counts
from reference.recording.reading import recall
from reference.report import files
from reference.report.row_files import read_rows
from reference.running.study import run_job

pytestmark = pytest.mark.slow
FAMILIES = "dropped-ball", "two-walls", "sliding-slab", "off-centre-impact", "cradle", "stack"
AGREE, NOT_JUDGED = ("pass", "known deviation"), ("shown",)
DIGITS = r"\d+(?:\.\d+)?"
NUMBER = re.compile(rf"([<+−]?)(?:(?:({DIGITS})·)?10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)|({DIGITS})) ?(.*)")
PREFIXES = {"": 1.0, "m": 1e-3, "µ": 1e-6, "n": 1e-9}
POWERS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")


@dataclass(frozen=True)
class Told:
    """A number as a page tells it: in the row's unit, half of its last digit, and whether it is a share or a bound."""

    value: float
    near: float
    share: bool
    bound: bool

    def is_told_of(self, value: float, scale: float | None) -> bool:
        """Whether it is what the page should tell of a value."""
        told = value / (scale or 1.0) if self.share else value
        if self.bound:
            return abs(told) <= self.value
        return abs(told - self.value) <= self.near * (1 + 1e-9) or abs(abs(told) - abs(self.value)) <= 1e-9


def number(text: str, unit: str) -> Told:
    """Read `−0.39 %`, `+5.5 µm`, `<10⁻¹¹ %` or `6.3·10⁻⁵`."""
    sign, before_power, power, plain, named = NUMBER.fullmatch(text.strip()).groups()  # type: ignore[union-attr]
    digits = plain or before_power
    share = named == "%"
    prefix = named.removesuffix(unit) if not share and unit else ""
    factor = (0.01 if share else PREFIXES[prefix]) * 10.0 ** int((power or "0").translate(POWERS))
    decimals = len(digits.partition(".")[2]) if digits else 0
    value = float(digits or 1) * factor
    return Told(-value if sign == "−" else value, 0.5 * 10.0**-decimals * factor, share, sign == "<")


def run_by_hand(family: str, profile: str) -> JobResult:
    """The cases that a whole report has: from the live runs of `make verify`, or else run here."""
    planned = live.planned()[family, "handwritten", profile]
    return live.kept(planned) or run_job(Job(family, "handwritten", profile, planned.cases))


@pytest.fixture(scope="module")
def report(tmp_path_factory) -> tuple[Element, list[Row], dict[str, tuple[str, str]]]:
    results: list[JobResult] = []
    for family in FAMILIES:
        for name in engine_names():
            engine = load_engine(name)
            for profile in catalogue()[family].profiles(engine):
                job = Job(family, name, profile)
                found = run_by_hand(family, profile) if name == "handwritten" else recall(job)
                assert found is not None
                results.append(found)
    folder = tmp_path_factory.mktemp("report")
    files.write(results, folder)
    tree = read((folder / "index.html").read_text(encoding="utf-8"))
    names = {f"{it.title}, {it.job.profile}": (it.job.engine, it.job.profile) for it in results}
    return tree, read_rows(folder / "rows.json"), names


def of(rows: list[Row], name: tuple[str, str], **wanted: str) -> list[Row]:
    own = [row for row in rows if (row.engine, row.profile) == name]
    return [row for row in own if all(getattr(row, key) in (value, "") for key, value in wanted.items())]


def lines_of(table: Element) -> Iterator[tuple[str, list[Element]]]:
    """The heading of each line of a table, and its cells."""
    for line in table.all("tbody")[0].all("tr"):
        yield line.all("th")[0].text, line.all("td")


@pytest.mark.parametrize("family", FAMILIES)
def test_each_case_has_the_measured_number_and_its_error(report, family):
    tree, rows, names = report
    tables = with_id(tree, family).all("table", "cases")
    seen = 0
    for quantity, table in zip(catalogue()[family].quantities, tables, strict=True):
        for case, cells in lines_of(table):
            for cell in cells[1:]:
                if cell.classes == ["empty"]:
                    continue
                title = cell.attributes["data-label"]
                row = next(iter(of(rows, names[title], family=family, case=case, quantity=quantity.name)))
                mark = cell.all("b")[0].text
                measured = cell.text.partition(mark)[0].strip()
                assert bool(measured) == (row.measured is not None)
                if measured:
                    assert number(measured, row.unit).is_told_of(row.measured, None), (case, title, cell.text)
                for error in cell.all("small"):
                    assert number(error.text, row.unit).is_told_of(row.error, row.scale), (case, title, cell.text)
                seen += 1
    assert seen > 20


@pytest.mark.parametrize("family", FAMILIES)
def test_each_cell_of_numbers_counts_its_rows_and_tells_one_of_them(report, family):
    tree, rows, names = report
    told = next(table for table in with_id(tree, family).all("table", "stack") if not table.all("caption"))
    for title, cells in lines_of(told):
        for quantity, cell in zip(catalogue()[family].quantities, cells, strict=False):
            own = of(rows, names[title], family=family, quantity=quantity.name)
            judged = [row for row in own if str(row.verdict) not in NOT_JUDGED]
            count = re.search(r"(\d+)/(\d+)", cell.text)
            if count:
                assert int(count[1]) == sum(str(row.verdict) in AGREE for row in judged)
                assert int(count[2]) == len(judged)
            for span in cell.all("span"):
                assert any(_tells(span.text, row) for row in own), (title, quantity.name, span.text)


def _tells(text: str, row: Row) -> bool:
    if row.measured is None or not NUMBER.fullmatch(text):
        return row.measured is None
    value = abs(row.measured) if row.error is None else row.error
    scale = row.scale if row.error is not None else None
    return number(text, row.unit).is_told_of(value, scale)


@pytest.mark.parametrize("family", FAMILIES)
def test_the_matrix_counts_the_pairs_that_differ(report, family):
    tree, rows, names = report
    (matrix,) = with_id(tree, family).all("table", "matrix")
    titles = [title.partition(" ")[2] for title, _ in lines_of(matrix)]
    for title, cells in lines_of(matrix):
        one = names[title.partition(" ")[2]]
        for other, cell in zip(titles, cells, strict=False):
            if not cell.text:
                continue
            met = [
                (a, b)
                for a in of(rows, one, family=family)
                for b in of(rows, names[other], family=family, case=a.case, quantity=a.quantity)
                if all(
                    it.quantity and (it.measured is not None or str(it.verdict) in ("fail", "disagrees"))
                    for it in (a, b)
                )
            ]
            differ = sum(not _alike(a, b) for a, b in met)
            assert (re.sub(r"\D", "", cell.text) or "0") == str(differ), (title, other)


def _alike(one: Row, other: Row) -> bool:
    if one.measured is None or other.measured is None:
        return False
    between = abs(one.measured - other.measured)
    if one.tolerance is None or other.tolerance is None:
        return between <= max(1e-6, 1e-3 * abs(one.measured), 1e-3 * abs(other.measured))
    thousandth = 1e-3 * max(abs(one.expected or 0), abs(other.expected or 0))
    return between <= max(min(one.tolerance, other.tolerance), thousandth, 1e-12)


def test_the_headline_counts_the_rows_that_count(report):
    tree, rows, _ = report
    every = [row for row in rows if counts(row.profile)]
    counted = [(str(row.verdict), row.expected is not None) for row in every if row.evidence]
    near, silent = counted.count(("pass", True)), counted.count(("pass", False))
    away = sum(verdict in ("known deviation", "disagrees") for verdict, _ in counted)
    told = [int(it.replace(",", "")) for it in re.findall(r"\d[\d,]*", tree.all("p", "verdict")[0].text)]
    verdicts = [str(row.verdict) for row in every]
    idle = sum(verdict in ("pass", "known deviation", "disagrees") for verdict in verdicts) - near - silent - away
    beside = [idle, verdicts.count("cannot express"), verdicts.count("needs")]
    assert told == [near + silent + away, near, silent, away, *(it for it in beside if it)]
