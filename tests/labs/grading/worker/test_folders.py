"""Folders that submissions leave are removed, however they are made."""

from __future__ import annotations

import os

import pytest

from labs.grading.worker.folders import remove


def deep(name: str, depth: int) -> None:
    """Make folders within folders in the current one, and a file in the last."""
    for _ in range(depth):
        os.mkdir(name)
        os.chdir(name)
    open("last", "w").close()


@pytest.mark.parametrize(("name", "depth"), [("d", 120), ("a" * 100, 60), ("ä" * 60, 3)])
def test_a_folder_is_removed_however_deep_it_is(name, depth, tmp_path, monkeypatch):
    top = tmp_path / "top"
    top.mkdir()
    monkeypatch.chdir(top)
    deep(name, depth)
    monkeypatch.chdir(tmp_path)
    remove(top)
    assert list(tmp_path.iterdir()) == []


def test_a_link_is_removed_and_what_it_leads_to_is_not(tmp_path):
    (tmp_path / "other").mkdir(mode=0o750)
    (tmp_path / "other" / "kept").touch(mode=0o640)
    (tmp_path / "top" / "closed").mkdir(parents=True)
    (tmp_path / "top" / "link").symlink_to(tmp_path / "other")
    (tmp_path / "top" / "closed" / "file").symlink_to(tmp_path / "other" / "kept")
    os.link(tmp_path / "other" / "kept", tmp_path / "top" / "same")
    (tmp_path / "top" / "closed").chmod(0)
    (tmp_path / "top").chmod(0o500)
    remove(tmp_path / "top")
    (tmp_path / "top").symlink_to(tmp_path / "other")
    remove(tmp_path / "top")
    assert list(tmp_path.rglob("*")) == [tmp_path / "other", tmp_path / "other" / "kept"]
    assert (tmp_path / "other").stat().st_mode & 0o777 == 0o750
    assert (tmp_path / "other" / "kept").stat().st_mode & 0o777 == 0o640
    remove(tmp_path / "nowhere")
