"""The page of the statements has no gap, and the findings about the engines have figures."""

from __future__ import annotations

import importlib.util
import re
import sys
from pathlib import Path
from types import ModuleType

import pytest

from reference.catalogue.scenarios import catalogue
from reference.lecture import STATEMENTS

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def table() -> ModuleType:
    spec = importlib.util.spec_from_file_location("statement_table", ROOT / "docs" / "statement_table.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # as any import does; its dataclass looks itself up there
    spec.loader.exec_module(module)
    return module


each_statement = pytest.mark.parametrize("entry", STATEMENTS, ids=lambda entry: f"{entry.number} {entry.title}")


@each_statement
def test_statement_has_a_function_a_failing_test_and_a_figure(entry, table):
    assert table._functions(entry.number)
    judged = [test for test in table.marked_tests() if test.statement == entry.number and test.oracle]
    assert judged
    assert [name for number, name, _ in table.figures() if number == entry.number]


def test_no_cell_of_the_overview_is_empty(table):
    rows = [line.split("|")[1:-1] for line in table.page().splitlines() if re.match(r"\| (#|\d+) \|", line)]
    assert len(rows) == 1 + len(STATEMENTS)
    assert {len(row) for row in rows} == {len(rows[0])}
    assert all(cell.strip() for row in rows for cell in row)


def test_every_family_of_the_catalogue_is_in_the_columns_of_the_engines(table):
    assert set(table.statement_engines().kept()) == set(catalogue()), "run make verdicts"


@each_statement
def test_an_erratum_is_shown_to_break_something(entry, table):
    shown = [test for test in table.marked_tests() if test.statement == entry.number and not test.oracle]
    assert bool(shown) >= bool(entry.erratum)


def test_every_mark_names_a_statement_and_every_judgement_its_oracle(table):
    for test in table.marked_tests():
        assert test.statement in range(1, 31), test
        assert test.oracle == test.oracle.strip(), test


def test_every_figure_has_a_caption_that_is_a_sentence(table):
    assert all(caption.endswith(".") for _, _, caption in table.figures())


def test_every_finding_is_listed_at_the_top_of_its_page():
    page = (ROOT / "docs" / "engines.md").read_text(encoding="utf-8").partition("\n## What to set")[0]
    findings = re.findall(r"\n\n## ([^\n]+)\n\n", page)
    anchors = [re.sub(r"[^\w -]", "", finding.lower()).replace(" ", "-") for finding in findings]
    assert anchors
    assert re.findall(r"^\| \[[^]]+\]\(#([\w-]+)\) \|", page, re.MULTILINE) == anchors


def test_every_figure_of_a_finding_is_named_on_its_page(table):
    named = re.findall(r"images/engines/([\w-]+)\.svg", (ROOT / "docs" / "engines.md").read_text(encoding="utf-8"))
    assert set(named) == set(table.drawing().findings())
