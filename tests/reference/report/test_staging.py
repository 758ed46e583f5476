"""A report replaces an earlier one completely or not at all."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from reference.errors import InvalidInput
from reference.report.staging import staged


def content(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.fixture
def earlier(tmp_path) -> Path:
    """A folder with a good report in it, and with something of somebody else's."""
    out = tmp_path / "out"
    (out / "figures").mkdir(parents=True)
    for name in ("index.html", "rows.json", "figures/a.svg", "notes.txt", "figures/mine.png"):
        (out / name).write_text(f"earlier {name}")
    return out


def test_staged_files_are_moved_only_when_all_went_well(earlier):
    before = content(earlier)
    with staged(earlier) as folder:
        assert folder.parent == earlier, "on the same disk, so that a file can be replaced in one go"
        (folder / "index.html").write_text("new page")
        (folder / "figures").mkdir()
        (folder / "figures" / "b.svg").write_text("new figure")
        assert {name: content(earlier)[name] for name in before} == before
    new = {"index.html": b"new page", os.path.join("figures", "b.svg"): b"new figure"}
    assert content(earlier) == before | new
    assert not folder.exists()


@pytest.mark.parametrize("error", [RuntimeError, KeyboardInterrupt, SystemExit])
def test_a_report_that_is_broken_off_leaves_the_earlier_one_unchanged(error, earlier):
    before, names = content(earlier), sorted(os.listdir(earlier))
    with pytest.raises(error), staged(earlier) as folder:  # noqa: PT012  half of it has to be written before it fails
        (folder / "index.html").write_text("half a pa")
        raise error
    assert content(earlier) == before
    assert sorted(os.listdir(earlier)) == names


def test_a_report_that_is_broken_off_leaves_no_new_folder(tmp_path):
    def break_off() -> None:
        with staged(tmp_path / "a" / "b" / "c") as folder:
            assert folder.is_dir()
            raise RuntimeError

    with pytest.raises(RuntimeError):
        break_off()
    assert os.listdir(tmp_path) == []
    (tmp_path / "a").mkdir()
    with pytest.raises(RuntimeError):
        break_off()
    assert (tmp_path / "a").is_dir(), "a folder that was there stays"
    assert os.listdir(tmp_path / "a") == []


def test_the_page_is_replaced_after_all_other_files(earlier, monkeypatch):
    moved, replace_one = [], os.replace

    def watched(source: Path, target: Path) -> None:
        moved.append(target.relative_to(earlier).as_posix())
        replace_one(source, target)

    monkeypatch.setattr("reference.report.staging.os.replace", watched)
    with staged(earlier) as folder:
        (folder / "zebras").mkdir()
        for name in ("index.html", "a.json", "zebras/index.html", "z.json"):
            (folder / name).write_text("new")
    assert sorted(moved) == ["a.json", "index.html", "z.json", "zebras/index.html"]
    assert moved[-1] == "index.html"
    assert (earlier / "index.html").read_text() == (earlier / "zebras" / "index.html").read_text() == "new"


def test_an_unusable_folder_for_a_report_is_refused(tmp_path):
    occupied = tmp_path / "occupied"
    occupied.write_text("mine")
    page = tmp_path / "page"
    (page / "index.html").mkdir(parents=True)
    for out in (occupied, occupied / "deeper", occupied / "still" / "deeper", tmp_path / ("long" * 100), page):
        with pytest.raises(InvalidInput, match=r"cannot write the report to .*; choose another --out"), staged(out):
            raise AssertionError("found out before anything runs")
    assert occupied.read_text() == "mine"
    assert sorted(os.listdir(tmp_path)) == ["occupied", "page"]
    assert os.listdir(page) == ["index.html"]


def test_a_folder_in_the_way_of_a_file_is_refused_without_leftovers(tmp_path):
    out = tmp_path / "out"
    (out / "rows.json").mkdir(parents=True)
    (out / "rows.json" / "mine").write_text("mine")

    def try_it() -> None:
        with staged(out) as folder:
            (folder / "rows.json").write_text("new")

    with pytest.raises(InvalidInput, match="cannot write the report"):
        try_it()
    assert content(out) == {os.path.join("rows.json", "mine"): b"mine"}
    assert os.listdir(out) == ["rows.json"]
