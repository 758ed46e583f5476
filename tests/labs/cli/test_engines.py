"""`collisions engines`: what is installed here, in which version, and how to get the rest."""

from __future__ import annotations

import importlib.metadata
import re
from pathlib import Path

import pytest
from program import collisions

from labs.cli import engines
from reference.engines import engine_names, load_engine, tried_versions
from reference.running.isolate import stop_workers


def test_the_list_of_engines_names_each_with_its_version():
    said = collisions("engines")
    assert said.code == 0
    assert f"hand-written handwritten {importlib.metadata.version('collisions-lab')} ✓ ready" in said.text
    for name in engine_names():
        assert re.search(rf" {name} .*(✓ ready|– not installed|! broken)", said.output)


def test_the_list_says_how_to_get_a_missing_engine_and_why_one_is_broken(tmp_path, monkeypatch):
    (tmp_path / "pybullet.py").write_text("raise ImportError('a library of it is missing')\n")
    (tmp_path / "mujoco.py").write_text("import os\nos._exit(3)\n")
    monkeypatch.syspath_prepend(tmp_path)  # workers get this path too
    monkeypatch.setattr(engines, "engine_names", lambda: ("pybullet", "mujoco"))
    stop_workers()  # those that are idle have the old one
    try:
        said = collisions("engines")
    finally:
        stop_workers()
    assert said.code == 0
    assert re.search(r"PyBullet +pybullet +– not installed", said.output)
    assert re.search(r"MuJoCo +mujoco +! broken", said.output)
    assert 'pip install -e ".[pybullet]"' in said.text
    assert "MuJoCo is installed but cannot be imported: its process died (exit code 3)" in said.text


@pytest.mark.parametrize(
    ("version", "warned"), [("3.12.0", False), ("4.0.0", False), ("4.9.9rc1", False), ("3.11.0", True), ("5.0", True)]
)
def test_a_version_that_was_not_tried_gets_a_warning(version, warned, monkeypatch):
    monkeypatch.setattr(engines, "engine_names", lambda: ("mujoco",))
    monkeypatch.setattr(engines, "run_isolated", lambda *_: version)
    said = collisions("engines")
    assert said.code == 0
    line = f"MuJoCo {version} is none of the versions that the lab was tried with (mujoco>=3.12,<5): its numbers may"
    assert (line in said.text) == warned


def test_the_versions_that_are_pinned_are_within_the_bounds():
    for line in (Path(__file__).parents[3] / "constraints.txt").read_text().splitlines():
        name, _, version = line.partition("==")
        for engine in map(load_engine, engine_names()):
            if engine.package == name:
                assert tried_versions.warning(engine, version) == ""
                assert tried_versions.warning(engine, "0.1") != "", "each engine has bounds"
