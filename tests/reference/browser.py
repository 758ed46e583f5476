"""A real browser for tests: Chromium without a window, spoken to through a pair of pipes and nothing else."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

CHROMIUM = next(
    (found for name in ("chromium", "chromium-browser", "google-chrome") if (found := shutil.which(name))), ""
)
needs_browser = pytest.mark.skipif(not CHROMIUM, reason="there is no Chromium here")
FLAGS = ("--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run", "--disable-3d-apis")
AS_3_AND_4 = """
import fcntl, os, sys
high = [fcntl.fcntl(int(end), fcntl.F_DUPFD, 50) for end in sys.argv[1:3]]  # out of each other's way
for place, end in enumerate(high):
    os.dup2(end, 3 + place)
os.execv(sys.argv[3], sys.argv[3:])
"""
"""Starts a browser with its pipes where it looks for them."""
NOISE = ("Runtime.consoleAPICalled", "Runtime.exceptionThrown", "Log.entryAdded")
HELPERS = """
const wait = seconds => new Promise(resolve => setTimeout(resolve, 1000 * seconds));
const until = async check => { for (let i = 0; i < 200 && !check(); i++) await wait(0.05); };
const ink = canvas => { // a number that changes with the picture
  const copy = Object.assign(document.createElement("canvas"), { width: canvas.width, height: canvas.height });
  const pen = copy.getContext("2d");
  pen.drawImage(canvas, 0, 0);
  return pen.getImageData(0, 0, copy.width, copy.height).data.reduce((sum, part) => (sum * 31 + part) % 1000003, 0);
};
const element = document.querySelector(".replay"), replay = element && element.replay, canvas = replay && replay.canvas;
"""


class Browser:
    """Pages one after another in one tab. noise: what the page said to the console or threw since it was opened."""

    def __init__(self, folder: Path) -> None:
        commands, answers = os.pipe(), os.pipe()
        flags = [*FLAGS, "--remote-debugging-pipe", f"--user-data-dir={folder / 'profile'}", "about:blank"]
        start = [sys.executable, "-c", AS_3_AND_4, str(commands[0]), str(answers[1]), CHROMIUM, *flags]
        self._process = subprocess.Popen(start, pass_fds=(commands[0], answers[1]), stderr=subprocess.DEVNULL)
        os.close(commands[0])
        os.close(answers[1])
        self._commands, self._answers = commands[1], answers[0]
        self._number, self._kept, self._session = 0, b"", ""
        self.noise: list[str] = []
        self._page = folder / "page.html"
        target = self.do("Target.createTarget", url="about:blank")["targetId"]
        self._session = self.do("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.do(f"{domain}.enable")

    def close(self) -> None:
        """End the browser."""
        self._process.kill()
        self._process.wait()
        os.close(self._commands)
        os.close(self._answers)

    def do(self, method: str, **parameters: Any) -> Any:
        """Send one command and return what comes of it."""
        self._number += 1
        message: dict[str, Any] = {"id": self._number, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._commands, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._next()
            if answer.get("method") in NOISE:
                self.noise.append(json.dumps(answer["params"])[:500])
            if answer.get("id") == self._number:
                assert "error" not in answer, answer
                return answer["result"]

    def _next(self) -> dict[str, Any]:
        while b"\0" not in self._kept:
            found = os.read(self._answers, 1 << 20)
            assert found, "the browser is gone"
            self._kept += found
        first, _, self._kept = self._kept.partition(b"\0")
        answer: dict[str, Any] = json.loads(first)
        return answer

    def open(self, text: str, width: int = 900, height: int = 800, density: float = 1, motion: bool = False) -> None:
        """Open a page of this text. motion: whether its reader welcomes it."""
        self._page.write_text(text, encoding="utf-8")
        self.do(
            "Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=density, mobile=False
        )
        self.media("screen", motion)
        self.do("Page.navigate", url="about:blank")
        self.noise.clear()
        self.do("Page.navigate", url=self._page.as_uri())
        end = time.monotonic() + 20
        while self.do("Runtime.evaluate", expression="document.readyState")["result"].get("value") != "complete":
            assert time.monotonic() < end, "the page does not open"
        self.run("await wait(0.15);")  # observers speak up a frame later

    @contextlib.contextmanager
    def within(self, title: str) -> Iterator[None]:
        """Speak to the shut-in frame of the page whose document has this title; it has a process of its own."""
        page = self._session
        try:
            self._session = next(session for session in self._frames() if self._title(session) == title)
            for domain in ("Runtime", "Log"):
                self.do(f"{domain}.enable")
            yield
        finally:
            self._session = page

    def _frames(self) -> Iterator[str]:
        """A session for each shut-in frame."""
        for target in self.do("Target.getTargets")["targetInfos"]:
            if target["type"] == "iframe":
                yield self.do("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]

    def _title(self, session: str) -> str:
        self._session = session
        return str(self.do("Runtime.evaluate", expression="document.title")["result"]["value"])

    def media(self, name: str, motion: bool = False) -> None:
        """Show the page on a screen or on paper."""
        features = [{"name": "prefers-reduced-motion", "value": "no-preference" if motion else "reduce"}]
        self.do("Emulation.setEmulatedMedia", media=name, features=features)

    def run(self, script: str) -> dict[str, Any]:
        """What a script puts into `found`; it has the helpers, and the first `replay` with its element and canvas."""
        whole = f"(async () => {{ {HELPERS} const found = {{}}; {script} ; return found; }})()"
        answer = self.do("Runtime.evaluate", expression=whole, awaitPromise=True, returnByValue=True)
        assert "exceptionDetails" not in answer, answer["exceptionDetails"]
        found: dict[str, Any] = answer["result"]["value"]
        return found

    def press(self, key: str, modifiers: int = 0) -> None:
        """Press a key as a hand does. modifiers: 2 for Control, 8 for Shift."""
        text = {"text": key} if len(key) == 1 and modifiers != 2 else {}
        for kind in ("keyDown", "keyUp"):
            self.do(
                "Input.dispatchKeyEvent", type=kind, key=key, modifiers=modifiers, **(text if kind == "keyDown" else {})
            )

    def mouse(self, kind: str, x: float, y: float) -> None:
        """Move, press or release the mouse."""
        held = {} if kind == "Moved" else {"button": "left", "clickCount": 1}
        self.do("Input.dispatchMouseEvent", type=f"mouse{kind}", x=x, y=y, buttons=int(kind != "Released"), **held)
