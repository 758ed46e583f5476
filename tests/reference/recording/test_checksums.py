"""Checksums of recordings: a byte that was changed anywhere is noticed, without any engine."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from reference.comparison.results import Job
from reference.comparison.verdicts import Verdict
from reference.errors import EngineNotInstalled, InvalidInput
from reference.published import recorded
from reference.published.results import PublishedJob
from reference.recording import checksums, files
from reference.recording.files import FOLDER, content_of, tracks_of
from reference.running import jobs, snapping
from reference.running.jobs import run_one
from reference.running.snapping import snapped
from reference.running.study import SCENARIOS

NAMES = ("mujoco/corner.json", "mujoco/corner.npz", "mujoco/published.json", "dart/corner.json")
READERS = {
    "mujoco/corner.json": lambda folder: content_of("mujoco", "corner", folder),
    "mujoco/corner.npz": lambda folder: tracks_of("mujoco", "corner", folder),
    "mujoco/published.json": lambda folder: recorded.recall(PublishedJob("P15", "mujoco"), folder),
}
COMMANDS = {
    "mujoco/corner.json": "collisions record corner --engine mujoco",
    "mujoco/corner.npz": "collisions record corner --engine mujoco",
    "mujoco/published.json": "collisions record --published --engine mujoco",
}


@pytest.fixture
def folder(tmp_path) -> Path:
    """Copies of some recordings, which a test may change."""
    for name in NAMES:
        (tmp_path / name).parent.mkdir(exist_ok=True)
        shutil.copy(FOLDER / name, tmp_path / name)
    checksums.renew(tmp_path, [tmp_path / name for name in NAMES])
    files.forget()
    return tmp_path


def change_one_number(path: Path) -> None:
    """Change the last digit in the middle of a text, or one byte of a packed file."""
    content = bytearray(path.read_bytes())
    place = len(content) // 2
    while path.suffix == ".json" and not chr(content[place]).isdigit():
        place += 1
    content[place] ^= 1
    path.write_bytes(content)
    files.forget()


@pytest.mark.parametrize("name", READERS)
def test_a_changed_recording_is_refused_with_file_and_remedy(name, folder):
    assert READERS[name](folder)
    change_one_number(folder / name)
    with pytest.raises(InvalidInput) as refused:
        READERS[name](folder)
    path = str(folder / name)
    assert str(refused.value) == (
        f"the recording {path!r} was changed since it was made; restore it, or make a new one: {COMMANDS[name]}"
    )
    assert list(checksums.changed(folder)) == [name]


def test_a_file_whose_checksum_was_never_kept_is_refused(folder):
    shutil.copy(folder / "mujoco/corner.json", folder / "mujoco/cradle.json")
    with pytest.raises(InvalidInput, match=r"cradle\.json' has no checksum in checksums\.txt"):
        content_of("mujoco", "cradle", folder)
    assert list(checksums.changed(folder)) == ["mujoco/cradle.json"]


def test_two_recordings_that_were_exchanged_are_noticed(folder):
    (folder / "dart/corner.json").rename(folder / "other")
    (folder / "mujoco/corner.json").rename(folder / "dart/corner.json")
    (folder / "other").rename(folder / "mujoco/corner.json")
    assert list(checksums.changed(folder)) == ["dart/corner.json", "mujoco/corner.json"]


def test_a_recording_that_was_removed_is_noticed(folder):
    (folder / "mujoco/corner.npz").unlink()
    assert checksums.changed(folder) == {"mujoco/corner.npz": "is missing"}


def test_new_recordings_leave_the_checksums_of_others_alone(folder):
    change_one_number(folder / "dart/corner.json")
    change_one_number(folder / "mujoco/corner.json")
    checksums.renew(folder, [folder / "mujoco/corner.json"])
    assert list(checksums.changed(folder)) == ["dart/corner.json"]


def test_where_nothing_was_recorded_no_checksum_is_touched(folder, tmp_path):
    (folder / "mujoco/corner.npz").unlink()
    recorded.write([], folder)
    assert checksums.changed(folder) == {"mujoco/corner.npz": "is missing"}
    recorded.write([], tmp_path / "new")
    assert not (tmp_path / "new").exists()


def test_a_number_changed_with_its_checksum_changes_the_one_over_all(folder):
    before = checksums.over_all(folder)
    checksums.renew(folder, [folder / "mujoco/corner.npz"])
    assert checksums.over_all(folder) == before
    change_one_number(folder / "mujoco/corner.npz")
    checksums.renew(folder, [folder / "mujoco/corner.npz"])
    assert (checksums.changed(folder), checksums.over_all(folder) == before) == ({}, False)


def test_a_missing_engine_with_a_changed_recording_has_no_number(folder, monkeypatch):
    def missing(*_):
        raise EngineNotInstalled("MuJoCo is not here")

    monkeypatch.setattr(jobs, "run_isolated", missing)
    monkeypatch.setattr(files, "FOLDER", folder)
    job = Job("corner", "mujoco", "tuned")
    assert len(run_one(job, SCENARIOS).rows) > 1
    for name in ("corner.npz", "corner.json"):  # the curve, then the numbers
        change_one_number(folder / "mujoco" / name)
        (row,) = run_one(job, SCENARIOS).rows
        assert (row.verdict, row.measured) == (Verdict.NOT_AVAILABLE, None)
        assert row.note.startswith("MuJoCo is not here; the recording ")
        assert f"{name}' was changed since it was made" in row.note


def test_no_job_is_moved_to_a_recording_that_cannot_be_used(folder, monkeypatch):
    monkeypatch.setattr(snapping, "absent", lambda name: name == "mujoco")
    monkeypatch.setattr(files, "FOLDER", folder)
    at = (("restitution", 0.37), ("later", 0.0))
    wish = [Job("corner", engine, "tuned", at=at) for engine in ("mujoco", "dart")]
    assert snapped(wish) != wish
    change_one_number(folder / "mujoco/corner.json")
    assert snapped(wish) == wish
