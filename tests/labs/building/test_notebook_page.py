"""A notebook that was run, as the page that nbconvert makes of it, in a real browser: its replays are alive there.

Skipped where there is no Chromium or no nbconvert. JupyterLab shows the same outputs in the same frames.
"""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from browser import Browser, needs_browser

ROOT = Path(__file__).parents[3]
CELLS = (
    'from labs import lab\nlab.begin("detection")',
    'lab.run("dropped-ball/e=0.5", quantity="rebound")',
    'lab.watch("thin-wall/v=20")',
)
LIMIT = 240  # s; it takes about ten on an idle machine
OFFLINE = [f"--HTMLExporter.{part}_url=" for part in ("mathjax", "require_js", "jquery", "mermaid_js")]
"""The page asks for nothing from the network: what it could not get would be said to the console."""
HERE = """const bounds = element => { const { left, top, width, height } = element.getBoundingClientRect();
    return [left, top, width, height]; };"""

pytestmark = [
    pytest.mark.slow,
    needs_browser,
    pytest.mark.skipif(importlib.util.find_spec("nbconvert") is None, reason="nbconvert is not installed"),
]


@pytest.fixture(scope="module")
def page(tmp_path_factory) -> str:
    """A short notebook, run and exported."""
    import nbformat  # noqa: PLC0415 - with all of Jupyter behind it, which only these slow tests need

    folder = tmp_path_factory.mktemp("notebook")
    cells = [nbformat.v4.new_code_cell(source) for source in CELLS]
    nbformat.write(nbformat.v4.new_notebook(cells=cells), folder / "lab.ipynb")
    export = [sys.executable, "-m", "nbconvert", "--to", "html", "--execute", *OFFLINE, "lab.ipynb"]
    path = os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")])
    environment = os.environ | {"PYTHONPATH": path, "COLLISIONS_CACHE": str(folder / "cache")}
    subprocess.run(export, cwd=folder, env=environment, check=True, capture_output=True, timeout=LIMIT)
    return (folder / "lab.html").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def opened(tmp_path_factory) -> Iterator[Browser]:
    browser = Browser(tmp_path_factory.mktemp("browser"))
    yield browser
    browser.close()


@pytest.fixture
def browser(opened, page) -> Iterator[Browser]:
    """The browser with the page in it; whatever a test does there, nothing is said to the console."""
    opened.open(page, motion=True)
    yield opened
    assert opened.noise == []


@pytest.fixture
def ball(browser) -> str:
    """The title of the first replay's document."""
    (first, _) = titles(browser)
    return first


def titles(browser: Browser) -> list[str]:
    """Of the replays, from the top of the page to its end."""
    found = browser.run("""found.titles = [...document.querySelectorAll("iframe.replay-frame")]
        .map(it => it.title.replace("Replay: ", ""));""")
    return list(found["titles"])


def click(browser: Browser, title: str, selector: str, share: float = 0.5) -> None:
    """Click into a frame as a hand does, at a share of the width of what is found there."""
    frame = f'document.querySelector("iframe[title=\\"Replay: {title}\\"]")'
    browser.run(f'{frame}.scrollIntoView({{ block: "center" }}); await wait(0.3);')
    left, top, *_ = browser.run(f"{HERE} found.at = bounds({frame});")["at"]
    with browser.within(title):
        x, y, width, height = browser.run(f"{HERE} found.at = bounds(document.querySelector('{selector}'));")["at"]
    for kind in ("Moved", "Pressed", "Released"):
        browser.mouse(kind, left + x + share * width, top + y + height / 2)


def test_each_run_has_a_replay_that_waits_for_a_click(browser):
    assert len(titles(browser)) == 2
    for title in titles(browser):
        with browser.within(title):
            assert browser.run("found.is = [replay.frame, replay.toggle.title];")["is"] == [0, "Play"]


def test_the_progress_line_leaves_no_text_and_no_gap(browser):
    found = browser.run("""const outputs = [...document.querySelectorAll(".jp-OutputArea-child")];
        found.left = outputs.map(it => it.textContent.trim()).filter(text => /^(running|checking)/.test(text));
        const bare = outputs.filter(it => !it.textContent.trim() && !it.querySelector("img, iframe"));
        found.gaps = bare.map(it => it.clientHeight).filter(height => height > 0);""")
    assert found == {"left": [], "gaps": []}


def test_a_click_plays_the_replay_to_its_end(browser, ball):
    click(browser, ball, ".replay-bar button")
    with browser.within(ball):
        found = browser.run("""await until(() => replay.frame > 0); found.label = replay.toggle.title;
            await until(() => replay.frame === replay.clip.count - 1); found.end = replay.frame;
            found.count = replay.clip.count;""")
    assert found["label"] == "Pause"
    assert found["end"] == found["count"] - 1 > 10


def test_a_click_on_the_bar_jumps_and_arrow_keys_step_from_there(browser, ball):
    click(browser, ball, ".replay-bar input")
    with browser.within(ball):
        found = browser.run("found.there = replay.frame; found.count = replay.clip.count;")
    assert found["there"] == pytest.approx(found["count"] / 2, abs=3)
    browser.press("ArrowRight")
    browser.press("ArrowRight")
    with browser.within(ball):
        assert browser.run("found.then = replay.frame;")["then"] == found["there"] + 2


def test_a_tick_removes_an_implementation_from_the_picture(browser, ball):
    with browser.within(ball):
        before = browser.run("found.ink = ink(canvas); found.shown = replay.clip.runs.map(run => run.shown);")
    assert len(before["shown"]) >= 2
    click(browser, ball, ".replay-runs input")
    with browser.within(ball):
        after = browser.run("found.ink = ink(canvas); found.shown = replay.clip.runs.map(run => run.shown);")
    assert after["shown"] == [False, *before["shown"][1:]]
    assert after["ink"] != before["ink"]


@pytest.mark.parametrize("width", [420, 900])
def test_the_replay_fits_a_window_of_any_width(browser, ball, width):
    browser.do("Emulation.setDeviceMetricsOverride", width=width, height=800, deviceScaleFactor=1, mobile=False)
    with browser.within(ball):
        found = browser.run("""await wait(0.3); found.inner = innerWidth; found.across = document.body.scrollWidth;
            found.down = document.documentElement.scrollHeight - innerHeight; found.canvas = canvas.clientWidth;
            found.high = canvas.clientHeight;""")
    assert found["inner"] <= width
    assert found["across"] <= found["inner"]
    assert found["down"] <= 0
    assert found["inner"] - 12 <= found["canvas"] <= found["inner"]
    assert found["high"] >= 120  # px, of a picture in which a ball can still be seen to bounce


def test_on_paper_only_the_still_picture_is_shown(browser):
    browser.media("print")
    found = browser.run("""found.frames = [...document.querySelectorAll("iframe")].map(it => it.clientHeight);
        found.stills = [...document.querySelectorAll("img[alt$='last frame']")].map(it => it.clientHeight > 200);""")
    browser.media("screen")
    assert found == {"frames": [0, 0], "stills": [True, True]}


@pytest.mark.parametrize("light", ["true", "false"])
def test_the_replay_is_light_or_dark_like_its_notebook(browser, ball, light):
    browser.run(f'document.body.dataset.jpThemeLight = "{light}"; await wait(0.3);')
    with browser.within(ball):
        found = browser.run('found.dark = matchMedia("(prefers-color-scheme: dark)").matches;')
    assert found["dark"] == (light == "false")
