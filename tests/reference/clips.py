"""What the tests of the viewer share: runs that nobody had to run, a reader of packed numbers, and a browser."""

from __future__ import annotations

import base64
import html
import json
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from reference.replay import Poses
from reference.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere
from reference.viewer.clip import Clip
from reference.viewer.making import clip, mesh_clip

GRAVITY, RATE, KEPT, HEIGHT = 9.81, 60, 0.5, 1.0
EVIL = "</script><script>window.evil = 1</script>\"'&<b>"
BALL = Scenario(
    "ball",
    (
        Body("floor", HalfSpace()),
        Body("ball", Sphere(0.1), 2.0, (0.0, 0.0, 0.1 + HEIGHT), angular_velocity=(0.0, 3.0, 0.0)),
    ),
    (Pair("ball", "floor", KEPT),),
    1.0,
)


def bouncing(title: str = "hand-written", late: float = 0.0, count: int = 61) -> Poses:
    """A ball that falls 1 m from rest, `late` in s, and bounces once: the closed form, turning about y at 3 rad/s."""
    times = np.arange(count) / RATE
    since = np.maximum(times - late, 0.0)
    fall = np.sqrt(2 * HEIGHT / GRAVITY)
    after = since - fall
    up = np.where(after < 0, HEIGHT - GRAVITY * since**2 / 2, KEPT * GRAVITY * fall * after - GRAVITY * after**2 / 2)
    nothing = np.zeros_like(times)
    positions = np.stack([nothing, nothing, 0.1 + up], axis=-1)
    turns = np.stack([np.cos(1.5 * times), nothing, np.sin(1.5 * times), nothing], axis=-1)
    return Poses(title, ("ball",), times, positions[:, None], turns[:, None])


def three_engines(title: str = "Bouncing ball") -> Clip:
    """The ball, in three implementations beside the exact one."""
    late = {"pybullet": ("PyBullet*", 0.02), "mujoco": ("MuJoCo", 0.04), "dart": ("DART", 0.06)}
    return clip(BALL, {"handwritten": bouncing()} | {name: bouncing(*each) for name, each in late.items()}, title=title)


def chain() -> Clip:
    """A chain of four points that swings, in two implementations."""
    times, place = np.arange(31)[:, None] / RATE, np.arange(4)
    angles = 0.5 * np.cos(3 * times) * np.ones(4)
    points = np.stack([0.3 * place * np.sin(angles), 0 * angles, -0.3 * place * np.cos(angles)], axis=-1)
    return mesh_clip("Chain", [(0, 1), (1, 2), (2, 3)], {"by hand": points, "other": 1.05 * points[:20]})


def flying(shape: Box | Sphere, turn: tuple[float, float, float], count: int = 31) -> tuple[Scenario, Poses]:
    """A body that flies over a floor along x + y and turns about an axis, without gravity."""
    body = Body("it", shape, 1.0, (0.0, 0.0, 1.0), velocity=(1.0, 1.0, 0.0), angular_velocity=turn)
    scenario = Scenario("flying", (Body("floor", HalfSpace()), body), (), 0.5, (0.0, 0.0, 0.0))
    times = np.arange(count) / RATE
    along = np.stack([times, times, np.ones_like(times)], axis=-1)
    rate = float(np.linalg.norm(turn))
    axis = np.array(turn) / (rate or 1.0)
    turns = np.concatenate([np.cos(rate * times / 2)[:, None], np.sin(rate * times / 2)[:, None] * axis], axis=-1)
    return scenario, Poses("it", ("it",), times, along[:, None], turns[:, None])


def unpacked(text: str, count: int, columns: int) -> np.ndarray:
    """Whole steps (count, columns) of packed text, read as docs/viewer.md describes it."""
    numbers, content, at = [], base64.b64decode(text), 0

    def number() -> int:
        nonlocal at
        value, shift = 0, 0
        while True:
            byte = content[at]
            at += 1
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return value

    while at < len(content):
        found = number()
        numbers += [found] if found else [0] * (number() + 1)
    zigzag = np.array(numbers, dtype=np.int64).reshape(columns, count)
    twice = np.where(zigzag % 2 == 1, -(zigzag + 1) // 2, zigzag // 2)
    return np.cumsum(np.cumsum(twice, axis=1), axis=1).T


# A browser

CHROMIUM = next(
    (found for name in ("chromium", "chromium-browser", "google-chrome") if (found := shutil.which(name))), ""
)
needs_browser = pytest.mark.skipif(not CHROMIUM, reason="there is no Chromium here")
_HARNESS = """<script>
window.errors = [];
addEventListener("error", event => errors.push(event.message));
const wait = seconds => new Promise(resolve => setTimeout(resolve, 1000 * seconds));
const press = (key, more = {}, target = document.activeElement) =>
  target.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true, ...more }));
const ink = canvas => { // a number that changes with the picture
  const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
  return pixels.reduce((sum, value) => (sum * 31 + value) % 1000003, 0);
};
addEventListener("load", async () => {
  const found = {};
  try { await wait(0.3); await (async () => { %s })(); } catch (error) { errors.push(String(error)); }
  const out = document.createElement("pre");
  out.id = "found";
  out.textContent = JSON.stringify({ ...found, errors });
  document.body.append(out);
});
</script>
</head>"""


def browse(page: str, script: str, folder: Path, *flags: str) -> dict[str, Any]:
    """What a script found out in a page. It fills `found`, and has `wait`, `press` and `ink`."""
    path = folder / "page.html"
    path.write_text(page.replace("</head>", _HARNESS.replace("%s", script), 1), encoding="utf-8")
    command = [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={folder / 'profile'}"]
    command += ["--enable-logging=stderr", "--window-size=900,700", "--virtual-time-budget=20000", *flags, "--dump-dom"]
    said = subprocess.run([*command, path.as_uri()], capture_output=True, timeout=120, check=True, text=True)
    result = re.search(r'<pre id="found">(.*?)</pre>', said.stdout, re.S)
    assert result, "the script in the page did not end"
    console = [line for line in said.stderr.splitlines() if "CONSOLE" in line]
    found: dict[str, Any] = json.loads(html.unescape(result[1]))
    return found | {"console": console}
