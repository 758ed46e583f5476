"""Quick jobs, engines that break in a way of their own, and what comes of running them."""

from __future__ import annotations

import textwrap
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from reference.comparison.results import Job, JobResult
from reference.running.jobs import run_all
from reference.running.study import SCENARIOS

GOOD = Job("sliding-slab", "handwritten", "exact", ("μ=0.7,v=1",))
STUDIED = Job("parting-ball", "handwritten", "exact", ("v=0.1",), with_studies=True)
"""A job with everything that a result can hold: rows, curve, convergence and split; a quick one."""
ENOUGH = 60.0  # s: any honest job here takes one, on a busy machine too

ENGINE_FILE = """
import os, signal, sys, threading, time

from reference.engines.base import Engine, Method
from reference.errors import CannotExpress
from reference.scene.settings import Settings
from reference.scene.trajectory import Recorder


class Odd(Engine):
    name = "odd"
    title = {title!r}
    package = {package!r}

    def settings(self, scenario, profile):
        self.check_profile(scenario, profile)
        return Settings(0.01)

    def method(self, scenario, settings):
        return Method("at step")

    def run(self, scenario, settings):
        recorder = Recorder(self.name, scenario, settings)
        state = [n for b in scenario.bodies for n in (*b.position, *b.orientation, *b.velocity, *b.angular_velocity)]
        steps = self.check_settings(scenario, settings)
{body}
        return recorder.trajectory()


ENGINE = Odd
"""


def engine_file(
    folder: Path, name: str, body: str = "pass", package: str | None = None, title: str = "an odd one"
) -> str:
    """Write an engine to a file of its own; `body` is what its run does before it hands in its samples."""
    path, body = folder / f"{name}.py", textwrap.indent(textwrap.dedent(body), " " * 8)
    path.write_text(ENGINE_FILE.format(body=body, package=package, title=title), encoding="utf-8")
    return str(path)


def results_of(jobs: list[Job], timeout: float = ENOUGH) -> dict[Job, JobResult]:
    with ThreadPoolExecutor(2) as executor:
        return {result.job: result for result in run_all(jobs, SCENARIOS, executor, timeout)}
