"""`collisions record`: what is recorded, and what is not."""

from __future__ import annotations

import pytest
from program import collisions

from labs.cli import jobs
from reference.errors import InvalidInput
from reference.recording import checksums, files

pytestmark = pytest.mark.usefixtures("one_worker")


def test_only_stale_recordings_are_made_and_their_sizes_printed(tmp_path, installed):
    installed("mujoco")
    wish = "record", "parting-ball", "--engine", "mujoco", "--only-stale", "--out", tmp_path
    first, again = collisions(*wish), collisions(*wish)
    assert first.text.startswith("parting-ball in MuJoCo: never recorded kB of numbers + poses MuJoCo parting-ball ")
    assert sorted(path.name for path in (tmp_path / "mujoco").iterdir()) == ["parting-ball.json", "parting-ball.npz"]
    assert first.text.endswith(f"Checksum over all recordings there: {checksums.over_all(tmp_path)}")
    assert (again.code, again.text) == (0, "All recordings are of today's scenarios and settings.")
    (tmp_path / "mujoco" / "parting-ball.json").write_text("{}")
    files.forget()
    assert "parting-ball.json' was changed since it was made" in collisions(*wish).text
    assert checksums.changed(tmp_path) == {}
    refused = collisions("record", "parting-ball/v=0.1")
    assert (refused.code, "'parting-ball/v=0.1' is one case" in refused.error) == (2, True)


@pytest.mark.parametrize("name", ["handwritten", "mine.py"])
def test_hand_written_code_and_engine_files_are_not_recorded(name, tmp_path):
    refused = collisions("record", "parting-ball", "--engine", name, "--out", tmp_path)
    assert refused.code == 2
    assert f"'{name}' is not recorded; these engines are: pybullet, mujoco, dart" in refused.error


def test_a_refused_recording_leaves_no_folder(tmp_path, installed, monkeypatch):
    installed("mujoco")

    def refuse(*_):
        assert (tmp_path / "new" / "folder").is_dir(), "it was tried before"
        raise InvalidInput("no run today")

    monkeypatch.setattr(jobs, "run", refuse)
    said = collisions("record", "parting-ball", "--engine", "mujoco", "--out", tmp_path / "new" / "folder")
    assert (said.code, said.error, list(tmp_path.iterdir())) == (2, "Error: no run today", [])


def test_a_folder_that_cannot_be_made_is_refused_before_anything_runs(tmp_path, installed):
    installed("mujoco")  # without any engine there is nothing to record
    (tmp_path / "file").touch()
    refused = collisions("record", "parting-ball", "--out", tmp_path / "file" / "folder")
    assert (refused.code, "Not a directory; choose another --out" in refused.error) == (2, True)
