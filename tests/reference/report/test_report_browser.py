"""The page of the report in a real browser: its width, its links, its keyboard, and the names that are read aloud."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import pytest
from browser import Browser, needs_browser
from pages import everything, written

pytestmark = [needs_browser, pytest.mark.slow]
SPOKEN = ("button", "link", "checkbox", "slider", "combobox", "img", "image", "region", "navigation")
"""Roles that a screen reader announces by their names."""


@pytest.fixture(scope="module")
def browser(tmp_path_factory) -> Iterator[Browser]:
    opened = Browser(tmp_path_factory.mktemp("browser"))
    yield opened
    opened.close()


@pytest.fixture(scope="module")
def whole() -> str:
    return written(everything())


@pytest.mark.parametrize("width", [390, 1200])
def test_the_page_is_no_wider_than_its_window_folded_or_not(browser, whole, width):
    browser.open(whole, width=width)
    found = browser.run("""const over = () => document.documentElement.scrollWidth - innerWidth;
        found.folded = over(); document.querySelectorAll("details").forEach(it => { it.open = true; });
        await wait(0.3); found.unfolded = over();""")
    assert found["folded"] <= 0
    assert found["unfolded"] <= 0
    assert browser.noise == []


def test_a_link_unfolds_its_scenario(browser, whole):
    browser.open(whole)
    found = browser.run("""const fold = document.querySelector("#stack details"); found.before = fold.open;
        document.querySelector("#overview a[href='#stack']").click(); await wait(0.3); found.after = fold.open;""")
    assert found == {"before": False, "after": True}


def test_the_keyboard_skips_to_the_results_and_sorts_a_table(browser, whole):
    browser.open(whole, width=1200)
    browser.press("Tab")
    assert browser.run("found.text = document.activeElement.textContent;") == {"text": "Skip to the results"}
    found = browser.run("""document.querySelectorAll("details").forEach(it => { it.open = true; }); await wait(0.3);
        const button = document.querySelector("#stack .sortable button"), heading = button.closest("th");
        button.focus(); found.focused = document.activeElement === button;
        button.click(); found.once = heading.ariaSort; button.click(); found.again = heading.ariaSort;""")
    assert found == {"focused": True, "once": "descending", "again": "ascending"}


def test_whatever_is_read_aloud_has_a_name(browser, whole):
    browser.open(whole)
    browser.run("document.querySelectorAll('details').forEach(it => { it.open = true; }); await wait(0.3);")
    nodes = browser.do("Accessibility.getFullAXTree")["nodes"]
    spoken = [it for it in nodes if not it["ignored"] and it["role"]["value"] in SPOKEN]
    assert len(spoken) > 100
    named = {it["nodeId"] for it in spoken if it.get("name", {}).get("value")}
    inside = {it["nodeId"] for it in spoken if it.get("parentId") in named}  # a drawing in a picture that has a name
    assert [it for it in spoken if it["nodeId"] not in named | inside] == []
    script = 'found.levels = [...document.querySelectorAll("h1, h2, h3, h4")].map(it => Number(it.tagName[1]));'
    levels = browser.run(script)["levels"]
    assert levels.count(1) == 1
    assert all(later <= earlier + 1 for earlier, later in itertools.pairwise(levels))


def test_tables_keep_their_headings_for_a_screen_reader_in_a_narrow_window(browser, whole):
    counts = []
    for width in (1200, 390):
        browser.open(whole, width=width)
        nodes = browser.do("Accessibility.getFullAXTree")["nodes"]
        roles = [it["role"]["value"] for it in nodes if not it["ignored"]]
        counts.append({role: roles.count(role) for role in ("table", "rowheader", "columnheader")})
    assert counts[0] == counts[1]
    assert counts[0]["columnheader"] > 4


def test_paper_has_every_result_and_the_long_tables_that_were_unfolded(browser, whole):
    browser.open(whole)
    found = browser.run("""const folds = () => [...document.querySelectorAll("#stack details")].map(it => it.open);
        const last = [...document.querySelectorAll("#stack details")].at(-1); last.open = true; found.screen = folds();
        dispatchEvent(new Event("beforeprint")); found.paper = folds();
        dispatchEvent(new Event("afterprint")); found.after = folds();""")
    assert found["screen"] == found["after"]
    assert found["paper"] == [True, *found["screen"][1:]]
    assert found["screen"][1:-1].count(True) == 0
