"""The replay in a real browser: what plays, what stops, and what each key does. Skipped where there is no Chromium."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from browser import Browser, needs_browser
from clips import BALL, EVIL, bouncing, chain, three_engines
from numpy.testing import assert_allclose

from reference.viewer import page
from reference.viewer.clip import TURN
from reference.viewer.clip_making import clip

pytestmark = [needs_browser, pytest.mark.slow]


@pytest.fixture(scope="module")
def opened(tmp_path_factory) -> Iterator[Browser]:
    browser = Browser(tmp_path_factory.mktemp("browser"))
    yield browser
    browser.close()


@pytest.fixture
def browser(opened) -> Iterator[Browser]:
    """The browser; whatever a test does in it, the page says nothing to the console."""
    yield opened
    assert opened.noise == []


@pytest.fixture(scope="module")
def alone() -> str:
    return page.html([three_engines()])


# Time


def test_a_page_of_one_replay_starts_by_itself_and_stops_at_its_end(browser, alone):
    browser.open(alone, motion=True)
    found = browser.run("""found.early = replay.frame; await until(() => replay.frame > found.early);
        found.later = replay.frame; await until(() => replay.frame === 60);
        found.last = replay.frame; found.label = replay.toggle.title;""")
    assert found["early"] < found["later"] <= found["last"] == 60
    assert found["label"] == "Play"


def test_with_reduced_motion_a_replay_waits_to_be_played(browser, alone):
    browser.open(alone)
    found = browser.run("""await wait(0.3); found.waiting = replay.frame; replay.toggle.click();
        found.label = replay.toggle.title; await wait(0.5); found.playing = replay.frame; replay.toggle.click();
        await wait(0.1); found.stopped = replay.frame; await wait(0.3); found.after = replay.frame;""")
    assert (found["waiting"], found["label"]) == (0, "Pause")
    assert 0 < found["playing"] <= 45  # half a second at 60 samples a second, on a busy machine
    assert found["stopped"] == found["after"] > 0


def test_a_replay_plays_at_the_chosen_speed(browser, alone):
    browser.open(alone)
    found = browser.run("""found.speeds = [];
        for (const place of [0, 3]) {
          replay.reset(); replay.speed.selectedIndex = place; replay.play(true); await wait(0.1);
          const start = performance.now(), from = replay.time; await wait(0.3);
          found.speeds.push((replay.time - from) / ((performance.now() - start) / 1000));
        }""")
    slow, fast = found["speeds"]
    assert slow == pytest.approx(0.25, rel=0.3)  # to a frame or two of some twenty
    assert fast == pytest.approx(2.0, rel=0.3)


def test_the_bar_sets_the_frame_and_shows_its_time(browser, alone):
    browser.open(alone)
    found = browser.run("""const before = ink(canvas);
        replay.scrub.value = 30; replay.scrub.dispatchEvent(new Event("input"));
        found.frame = replay.frame; found.drawn = before !== ink(canvas);
        found.said = [replay.clock.textContent, replay.scrub.getAttribute("aria-valuetext")];""")
    assert found == {"frame": 30, "drawn": True, "said": ["0.500 s · frame 30 of 60"] * 2}


# What is shown


def test_every_run_and_the_contacts_can_be_switched_off_and_on(browser, alone):
    browser.open(alone)
    found = browser.run("""replay.show(30); const whole = ink(canvas); found.less = []; found.again = [];
        for (const box of [...replay.boxes, replay.contactBox]) {
          box.click(); found.less.push(ink(canvas) !== whole); box.click(); found.again.push(ink(canvas) === whole);
        }
        found.labels = [...element.querySelectorAll("label")].map(label => label.textContent);""")
    assert found["less"] == found["again"] == [True] * 5
    assert found["labels"] == ["hand-written", "PyBullet*", "MuJoCo", "DART", "contacts of hand-written"]


def test_a_run_that_is_switched_off_is_not_painted(browser, alone):
    browser.open(alone)
    found = browser.run("""const plain = replay.run.bind(replay); found.painted = [];
        replay.run = (run, fill) => { found.painted.push(run.tag); return plain(run, fill); };
        for (const place of [0, 2]) { found.painted = []; replay.boxes[place].click(); }""")
    assert found["painted"] == ["PyBullet", "DART"]


def test_the_browser_unpacks_the_poses_that_were_packed(browser, alone):
    browser.open(alone)
    found = browser.run("""const [run] = replay.clip.runs; found.step = replay.clip.step;
        found.at = run.at.map(column => [...column]); found.turned = run.turned.map(column => [...column]);""")
    poses = bouncing()
    assert_allclose(found["at"], poses.positions[:, 0].T, atol=found["step"] / 2 * (1 + 1e-6), rtol=0)
    assert_allclose(found["turned"], poses.orientations[:, 0].T, atol=TURN / 2 * (1 + 1e-6), rtol=0)


def test_the_contacts_are_those_of_the_first_run_shown(browser, alone):
    browser.open(alone)
    found = browser.run("replay.boxes[0].click(); found.label = replay.whose.textContent;")
    assert found == {"label": "contacts of PyBullet"}


def test_a_single_label_is_clear_of_all_bodies(browser):
    browser.open(page.html([chain()]))
    found = browser.run("""for (const [place, run] of replay.clip.runs.entries()) if (place) run.shown = false;
        const second = { ...replay.clip.runs[0], tag: "other", shown: true }; replay.clip.runs.push(second);
        replay.draw(); const [[, label]] = replay.labels; const [, middle, half] = replay.around(second);
        found.count = replay.labels.length; found.clear = Math.abs(label - middle) >= half + 16;
        const reach = () => replay.around(second)[2], without = reach();
        replay.clip.solids.push({ sphere: 9, at: [0, 0, 0], turn: [1, 0, 0, 0] }); // which no run moves
        replay.draw(); found.rest = reach() > without;""")
    assert found == {"count": 1, "clear": True, "rest": True}


def test_a_new_width_redraws_the_picture_as_sharply(browser, alone):
    browser.open(alone, density=2)
    found = browser.run("""replay.show(20); const before = [canvas.width, ink(canvas)];
        element.style.width = "320px"; await wait(0.2); found.smaller = canvas.width < before[0];
        found.sharp = canvas.width === Math.round(canvas.clientWidth * 2);
        found.fits = canvas.clientWidth <= 320 && element.scrollWidth <= 320;
        found.drawn = ink(canvas) !== before[1];""")
    assert found == {"smaller": True, "sharp": True, "fits": True, "drawn": True}


@pytest.mark.parametrize("width", [320, 360, 800, 1280])
def test_nothing_is_wider_than_the_page(browser, alone, width):
    browser.open(alone, width=width)
    found = browser.run("found.over = document.documentElement.scrollWidth - innerWidth;")
    assert found["over"] <= 0


def test_only_the_still_is_printed_on_paper(browser, alone):
    script = """found.shown = [...element.children].filter(it => getComputedStyle(it).display !== "none")
        .map(it => it.className || it.tagName);"""
    browser.open(alone)
    assert browser.run(script)["shown"] == ["CANVAS", "replay-bar", "replay-runs", "replay-help"]
    browser.media("print")
    assert browser.run(script)["shown"] == ["replay-still"]


# Hands


def test_keys_do_what_the_help_says(browser, alone):
    browser.open(alone)

    def after(key: str, modifiers: int = 0) -> int:
        browser.press(key, modifiers)
        return int(browser.run("found.frame = replay.frame;")["frame"])

    assert after("ArrowRight") == 1  # alone in its page it hears every key
    browser.run("canvas.focus();")
    assert [after("ArrowRight"), after("ArrowRight", 8), after("ArrowLeft")] == [2, 12, 11]
    assert [after("End"), after("ArrowRight"), after("Home"), after("ArrowLeft")] == [60, 60, 0, 0]
    assert [after("i"), after("i")] == [27, 27]  # the fall of 1 m takes 0.4515 s; after the last comes the first
    for key in "--+2c]}":
        browser.press(key)
    found = browser.run("""found.speed = replay.speed.value; found.run = replay.clip.runs[1].shown;
        found.contacts = replay.contacts; found.turned = [replay.azimuth, replay.pitch];""")
    assert found == {"speed": "0.5", "run": False, "contacts": False, "turned": [-80, 10]}
    assert after("r") == 0
    browser.press(" ")
    playing = browser.run("found.label = replay.toggle.title; await wait(0.1);")["label"]
    browser.press(" ")
    found = browser.run("found.label = replay.toggle.title; found.view = [replay.azimuth, replay.pitch];")
    assert (playing, found) == ("Pause", {"label": "Play", "view": [-90, 0]})


def test_a_key_keeps_its_meaning_in_the_focused_control(browser, alone):
    browser.open(alone)
    for where in ("replay.boxes[0]", "replay.speed"):
        browser.run(f"{where}.focus();")
        browser.press(" ")
    browser.run("canvas.focus(); replay.show(5);")
    browser.press("r", 2)
    assert browser.run("found.as = [replay.frame, replay.toggle.title];") == {"as": [5, "Play"]}


def test_dragging_turns_the_view_and_a_click_plays(browser, alone):
    browser.open(alone)
    for kind, x, y in (("Pressed", 300, 200), ("Moved", 320, 205), ("Moved", 340, 210), ("Released", 340, 210)):
        browser.mouse(kind, x, y)
    found = browser.run("found.turned = [replay.azimuth, replay.pitch]; found.label = replay.toggle.title;")
    assert found == {"turned": [-106, 4], "label": "Play"}
    for kind in ("Pressed", "Released"):
        browser.mouse(kind, 300, 200)
    assert browser.run("found.label = replay.toggle.title;") == {"label": "Pause"}


# Many, shut in, broken


def test_one_of_twenty_replays_plays_and_hidden_ones_cost_nothing(browser):
    browser.open(
        page.html([*(three_engines(f"Ball {place}") for place in range(19)), chain()], "Twenty"),
        height=1700,
        motion=True,
    )
    found = browser.run("""const all = [...document.querySelectorAll(".replay")].map(it => it.replay);
        const playing = () => all.filter(it => it.toggle.title === "Pause").length;
        let asked = 0; const plain = window.requestAnimationFrame;
        window.requestAnimationFrame = next => { asked++; return plain(next); };
        await wait(0.3); found.idle = [all.length, asked]; found.drawn = all.filter(it => it.pen).length;
        all[9].play(true); found.hidden = all[9].toggle.title;
        all[0].play(true); all[1].play(true); await until(() => asked > 5);
        found.playing = playing(); found.asked = asked;
        scrollTo(0, document.body.scrollHeight); await wait(0.3); found.away = playing(); found.last = !!all[19].pen;
        asked = 0; await wait(0.3); found.after = asked;""")
    assert 0 < found.pop("drawn") < 20  # what nobody has seen is not drawn
    assert found.pop("asked") > 5
    assert found == {"idle": [20, 0], "hidden": "Play", "playing": 1, "away": 0, "last": True, "after": 0}


def test_in_a_notebook_a_sandboxed_replay_covers_the_still(browser):
    browser.open(f"<!doctype html><html><body>{page.frame(three_engines())}</body></html>")
    found = browser.run("""const frame = document.querySelector("iframe").getBoundingClientRect();
        const still = document.querySelector("img").getBoundingClientRect();
        found.covers = frame.left <= still.left && frame.right >= still.right && frame.bottom >= still.bottom;
        found.apart = document.querySelector("iframe").contentDocument === null; found.loaded = still.height > 100;""")
    assert found == {"covers": True, "apart": True, "loaded": True}


def test_broken_runs_and_hostile_names_disturb_nothing(browser):
    runs = {"handwritten": bouncing(EVIL), "pybullet": bouncing("P", count=20), "dart": bouncing("D", count=0)}
    browser.open(page.html([clip(BALL, runs)]))
    found = browser.run("""for (let frame = 0; frame < 61; frame++) replay.show(frame);
        found.evil = "evil" in window; found.title = element.querySelector("label span").textContent;
        found.notes = [...element.querySelectorAll("small")].map(it => it.textContent);""")
    assert found == {"evil": False, "title": EVIL, "notes": ["ends at 0.32 s", "no poses"]}


@pytest.mark.parametrize("runs", [{}, {"handwritten": bouncing(count=0)}, {"handwritten": bouncing(count=1)}])
def test_a_clip_without_poses_can_be_looked_at_and_played(browser, runs):
    browser.open(page.html([clip(BALL, runs)]))
    found = browser.run("replay.toggle.click(); await wait(0.1); found.as = [replay.frame, replay.toggle.title];")
    assert found == {"as": [0, "Play"]}
