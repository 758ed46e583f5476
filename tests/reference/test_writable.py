"""Places to write to: what is made is removed again, and what cannot be written is refused in one line."""

from __future__ import annotations

import os

import pytest

from reference.errors import InvalidInput
from reference.writable import check_file, folder_for


def test_new_folders_remain_only_if_something_was_written(tmp_path):
    with folder_for("notes", tmp_path / "a" / "b", "--out"):
        assert (tmp_path / "a" / "b").is_dir()
    assert os.listdir(tmp_path) == []
    with folder_for("notes", tmp_path / "a" / "b", "--out"):
        (tmp_path / "a" / "b" / "note").touch()
    with folder_for("notes", tmp_path / "a" / "b", "--out"):
        pass
    assert os.listdir(tmp_path / "a" / "b") == ["note"]


def test_a_path_that_cannot_be_made_leaves_no_folders_above_it(tmp_path):
    out = tmp_path / "new" / ("long" * 100)
    words = r"cannot write notes to .*: File name too long; choose another --out"
    with pytest.raises(InvalidInput, match=words), folder_for("notes", out, "--out"):
        raise AssertionError("found out before anything runs")
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("folder", "Is a directory"),
        ("missing/file", "No such file or directory"),
        ("file/below", "Not a directory"),
    ],
)
def test_a_file_that_cannot_be_written_is_refused_with_the_reason(name, why, tmp_path):
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").write_text("mine")
    with pytest.raises(InvalidInput) as refused:
        check_file("the plot", tmp_path / name, "--plot")
    assert str(refused.value) == f"cannot write the plot to {str(tmp_path / name)!r}: {why}; choose another --plot"
    check_file("the plot", tmp_path / "file", "--plot")
    assert sorted(os.listdir(tmp_path)) == ["file", "folder"]
