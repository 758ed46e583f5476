"""`collisions engines`: what is installed here, in which version, and how to get the rest."""

from __future__ import annotations

import base64
import hashlib
import importlib.metadata
import re
from pathlib import Path

import pytest
from program import collisions

from labs.cli import engines
from reference.engines import distributions, engine_names, load_engine, tried_versions
from reference.errors import EngineNotInstalled
from reference.running.isolate import stop_workers


def test_the_list_of_engines_names_each_with_its_version():
    said = collisions("engines")
    assert said.code == 0
    assert f"hand-written handwritten {importlib.metadata.version('collisions-lab')} ✓ ready" in said.text
    for name in engine_names():
        assert re.search(rf" {name} .*(✓ ready|– not installed|! broken)", said.output)


def test_the_list_says_how_to_get_a_missing_engine_and_why_one_is_broken(tmp_path, monkeypatch):
    missing = "raise ModuleNotFoundError('no module named pybullet', name='pybullet')\n"
    (tmp_path / "pybullet.py").write_text(missing)
    (tmp_path / "mujoco.py").write_text("import os\nos._exit(3)\n")
    (tmp_path / "dartpy.py").write_text("raise ImportError('a library of it is missing')\n")
    monkeypatch.syspath_prepend(tmp_path)  # workers get this path too
    monkeypatch.setattr(engines, "engine_names", lambda: ("pybullet", "mujoco", "dart"))
    stop_workers()  # those that are idle have the old one
    try:
        said = collisions("engines")
    finally:
        stop_workers()
    assert said.code == 0
    assert re.search(r"PyBullet +pybullet +– not installed", said.output)
    assert re.search(r"MuJoCo +mujoco +! broken", said.output)
    assert "pip install --force-reinstall --no-deps --require-hashes -r bullet.txt" in said.text
    assert re.search(r"DART +dart +! broken", said.output)
    assert "DART is installed but cannot be imported: a library of it is missing" in said.text
    assert "MuJoCo is installed but cannot be imported: its process died (exit code 3)" in said.text


def test_an_engine_of_another_distribution_says_which(monkeypatch):
    monkeypatch.setattr(engines, "engine_names", lambda: ("pybullet",))
    monkeypatch.setattr(engines, "run_isolated", lambda *_: ("pybullet-arm64", "3.2.8"))
    said = collisions("engines")
    assert "PyBullet pybullet 3.2.8 (pybullet-arm64) ✓ ready" in said.text
    assert "none of the versions" not in said.text


def installed(folder, name, version, written):
    """Metadata of a distribution that has written the one file of the module."""
    kept = folder / f"{name.replace('-', '_')}-{version}.dist-info"
    kept.mkdir()
    digest = base64.urlsafe_b64encode(hashlib.sha256(written).digest()).rstrip(b"=").decode()
    (kept / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n")
    (kept / "top_level.txt").write_text("bullet\n")
    (kept / "RECORD").write_text(f"bullet.so,sha256={digest},{len(written)}\n")
    (folder / "bullet.so").write_bytes(written)


def test_a_tree_that_is_not_installed_still_knows_its_version(tmp_path, monkeypatch):
    """On Colab the lab is unpacked, with its `pyproject.toml`; a wheel has none, and is installed."""
    engine = load_engine("handwritten")
    installed_as = importlib.metadata.version("collisions-lab")
    monkeypatch.setattr(distributions, "_known", lambda name: None)
    assert (engine.version(), engine.versions()["adapter_version"]) == (installed_as, installed_as)
    (tmp_path / "pyproject.toml").write_text('[project]\nname = "somebody-elses"\nversion = "9"\n')
    monkeypatch.setattr(distributions, "_TREE", tmp_path)
    assert (engine.version(), engine.versions()["adapter_version"]) == ("", "")


@pytest.mark.parametrize("last", [("bullet", "bullet-of-another"), ("bullet-of-another", "bullet")])
def test_of_two_distributions_that_wrote_the_same_module_the_last_one_counts(last, tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(tmp_path)
    for name in last:
        installed(tmp_path, name, f"1.{len(name)}", name.encode())
    found = distributions.installed(("bullet", "bullet-of-another"), "bullet")
    assert found.name == last[-1]
    assert distributions.installed(("bullet",), "bullet").name == "bullet"
    assert distributions.installed(("no-bullet",), "bullet").name == last[-1], "any other that says it has the module"
    assert distributions.installed(("no-bullet",), "no_bullet") is None
    (tmp_path / "bullet.so").unlink()
    assert not distributions.is_here("bullet"), "uninstalling one has taken the file of both"


def test_a_package_without_a_distribution_is_of_unknown_version_and_one_without_a_wheel_has_no_cure(monkeypatch):
    engine = load_engine("mujoco")
    monkeypatch.setattr(distributions, "is_here", lambda module: True)
    monkeypatch.setattr(distributions, "installed", lambda names, module: None)
    assert engine.version() == "of unknown version"
    assert "none of the versions" in tried_versions.warning(engine, engine.version())
    monkeypatch.setattr(distributions, "is_here", lambda module: False)
    monkeypatch.setattr(distributions, "offered", lambda names, extra: False)
    with pytest.raises(EngineNotInstalled, match="there is no package of it for this machine"):
        engine.version()
    assert engine.versions()["engine_version"] == ""


def test_each_distribution_has_its_own_bounds():
    engine = load_engine("pybullet")
    assert "3.2.7 is none of the versions" in tried_versions.warning(engine, "3.2.7", "pybullet-arm64")
    assert tried_versions.warning(engine, "3.2.7", "pybullet") == tried_versions.warning(engine, "3.2.7") == ""


@pytest.mark.parametrize(
    ("version", "warned"), [("3.12.0", False), ("4.0.0", False), ("4.9.9rc1", False), ("3.11.0", True), ("5.0", True)]
)
def test_a_version_that_was_not_tried_gets_a_warning(version, warned, monkeypatch):
    monkeypatch.setattr(engines, "engine_names", lambda: ("mujoco",))
    monkeypatch.setattr(engines, "run_isolated", lambda *_: ("mujoco", version))
    said = collisions("engines")
    assert said.code == 0
    line = f"MuJoCo {version} is none of the versions that the lab was tried with (mujoco>=3.12,<5): its numbers may"
    assert (line in said.text) == warned


def test_the_versions_that_are_pinned_are_within_the_bounds():
    for line in (Path(__file__).parents[3] / "constraints.txt").read_text().splitlines():
        name, _, version = line.partition(";")[0].partition("==")
        for engine in map(load_engine, engine_names()):
            if name in engine.sources():
                assert tried_versions.warning(engine, version) == ""
                assert tried_versions.warning(engine, "0.1") != "", "each engine has bounds"
