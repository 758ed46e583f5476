"""Places to write to: what is made is removed again, and what cannot be written is refused in one line."""

from __future__ import annotations

import errno
import os
import shutil
from pathlib import Path

import pytest

from reference.errors import CannotWrite, InvalidInput
from reference.writable import check_file, folder_for, new_folder_for, refused_in_words, write_whole


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


@pytest.mark.parametrize("code", [errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO])
def test_a_full_disk_is_not_the_fault_of_the_path(code, tmp_path):
    words = rf"cannot write notes to '{tmp_path}/a': {os.strerror(code)}$"
    with pytest.raises(CannotWrite, match=words), refused_in_words("notes", tmp_path / "a", "--out"):
        raise OSError(code, os.strerror(code))


def test_a_folder_that_cannot_be_copied_is_one_reason_and_not_one_for_each_file(tmp_path):
    (tmp_path / "in").mkdir()
    for name in "ab":
        (tmp_path / "in" / name).touch()

    def full(source: str, target: str) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), source, None, target)

    with pytest.raises(CannotWrite) as caught, refused_in_words("notes", tmp_path / "out", "--out"):
        shutil.copytree(tmp_path / "in", tmp_path / "out", copy_function=full)
    assert str(caught.value).count("No space left on device") == 1


def test_an_error_about_another_file_is_not_said_of_the_path(tmp_path):
    other = FileNotFoundError(errno.ENOENT, "No such file", str(tmp_path / "input" / "b"))
    (tmp_path / "out").mkdir()
    with pytest.raises(FileNotFoundError), refused_in_words("notes", tmp_path / "out", "--out"):
        raise other


def test_a_file_that_cannot_be_written_leaves_the_earlier_one_and_nothing_else(tmp_path, monkeypatch):
    write = Path.write_bytes

    def half(path: Path, content: bytes) -> int:
        write(path, content[:2])
        raise OSError(errno.ENOSPC, "full")

    write_whole(tmp_path / "kept", b"earlier")
    (tmp_path / "link").symlink_to("kept")
    with monkeypatch.context() as patched:
        patched.setattr(Path, "write_bytes", half)
        with pytest.raises(OSError, match="full"):
            write_whole(tmp_path / "link", b"later")
    assert ((tmp_path / "kept").read_bytes(), sorted(os.listdir(tmp_path))) == (b"earlier", ["kept", "link"])
    write_whole(tmp_path / "link", b"later")
    assert ((tmp_path / "kept").read_bytes(), (tmp_path / "link").is_symlink()) == (b"later", True)


def test_a_new_folder_that_is_not_finished_can_be_tried_again(tmp_path):
    def fill(error: BaseException) -> None:
        with new_folder_for("notes", tmp_path / "new", "--out"):
            (tmp_path / "new" / "below").mkdir()
            (tmp_path / "new" / "below" / "note").touch()
            (tmp_path / "new" / "note").touch()
            raise error

    for error, raised in ((OSError(errno.ENOSPC, "full"), CannotWrite), (KeyboardInterrupt(), KeyboardInterrupt)):
        with pytest.raises(raised):
            fill(error)
        assert os.listdir(tmp_path) == []
