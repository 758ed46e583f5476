"""An engine in a file that does what no engine should: it crashes, hangs, raises, or answers with NaN."""

from __future__ import annotations

from pathlib import Path

_FILE = """
import os, time

from reference.engines.base import Engine, Method
from reference.errors import CannotExpress, NotAsTold
from reference.scene.settings import Settings
from reference.scene.trajectory import Recorder


class Odd(Engine):
    name, title, package = "odd", "an odd one", {package!r}

    def settings(self, scenario, profile):
        self.check_profile(scenario, profile)
        return Settings({{"tuned": 0.01, "stock": 0.02}}[profile])

    def method(self, scenario, settings):
        return Method("at step")

    def run(self, scenario, settings):
        recorder = Recorder(self.name, scenario, settings)
        state = [n for b in scenario.bodies for n in (*b.position, *b.orientation, *b.velocity, *b.angular_velocity)]
        recorder.sample(state)
        {body}
        return recorder.trajectory()


ENGINE = Odd
"""
CRASH = "os._exit(3)"
RAISE = "raise ZeroDivisionError('[bold]by the moon[/]')"
NAN = "recorder.sample([float('nan')] * len(state))"
ELSE = "raise NotAsTold('an odd one says timestep 0.02 s, and was told 0.01 s')"
NO_WORDS = "raise CannotExpress('an odd one has no words for it')"


def write_engine(path: Path, body: str = "pass", package: str | None = None) -> str:
    """Write the engine to a file. body: a line that its run does. package: what has to be installed for it."""
    path.write_text(_FILE.format(body=body, package=package), encoding="utf-8")
    return str(path)
