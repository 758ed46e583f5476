"""Poses for a replay: where the bodies are, at even times, packed without loss but for rounding."""

from __future__ import annotations

import json
import zipfile
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from reference.catalogue.scenarios import catalogue
from reference.engines import load_engine
from reference.errors import InvalidInput
from reference.scene.scenario import Body, HalfSpace, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory
from reference.viewer.poses import FARTHEST, RATE, Poses, poses_of
from reference.viewer.tracks import LENGTH, TURN, pack, read_tracks, unpack, write_tracks

SPIN = 20.0
FALLING = Scenario(
    "falling",
    (
        Body("floor", HalfSpace()),
        Body("ball", Sphere(0.1), 1.0, (0.0, 0.0, 9.0), velocity=(1.0, 0.0, 0.0), angular_velocity=(0.0, SPIN, 0.0)),
    ),
    (Pair("floor", "ball"),),
    1.25,
)


def falling(step: float = 1e-3, jumping: bool = True) -> Trajectory:
    """Free fall with a spin, sampled exactly; the signs of its quaternions jump at every other sample."""
    times = np.arange(round(1.25 / step) + 1) * step
    still, states = np.zeros_like(times), np.zeros((len(times), 2, 3))
    states[:, 1] = np.column_stack([times, still, 9.0 - 4.905 * times**2])
    turns = np.column_stack([np.cos(SPIN * times / 2), still, np.sin(SPIN * times / 2), still])
    signs = np.where(np.arange(len(times)) % 2 == 0, 1.0, -1.0) if jumping else np.ones(len(times))
    unit = np.tile([1.0, 0.0, 0.0, 0.0], (len(times), 1))
    orientations = np.stack([unit, turns * signs[:, None]], axis=1)
    return Trajectory(FALLING, Settings(step), "exact", times, states, orientations, np.zeros_like(states), states)


def test_a_replay_has_the_moving_bodies_sixty_times_a_second():
    poses = poses_of(falling())
    assert (poses.title, poses.bodies) == ("exact", ("ball",))
    assert_allclose(poses.times, np.arange(76) / RATE)  # 1.25 s and the first
    # Straight lines between samples of 1 ms are off a parabola by up to g dt²/8 = 1.2 µm.
    assert_allclose(poses.positions[:, 0, 2], 9.0 - 4.905 * poses.times**2, atol=1.3e-6)
    for values in (poses.times, poses.positions, poses.orientations):
        assert not values.flags.writeable


def test_orientations_are_continuous_though_an_engine_flips_their_sign():
    poses = poses_of(falling())
    # A chord of the turn of a step, ω dt/2 = 10 mrad, is off its arc by (ω dt/2)²/8, and normalised by far less.
    exact = np.cos(SPIN * poses.times / 2)
    assert_allclose(poses.orientations[:, 0, 0], exact, atol=1.3e-5)
    assert_allclose(np.linalg.norm(poses.orientations, axis=-1), 1.0)


def test_a_short_run_is_sampled_more_often():
    engine = load_engine("handwritten")
    scenario = catalogue()["cradle"].case("3 touching").scenarios[0]
    poses = poses_of(engine.run(scenario, engine.settings(scenario, "exact")))
    assert len(poses.times) >= 60
    assert (round(1 / poses.times[1]) % RATE, poses.times[-1] <= scenario.duration) == (0, True)


def test_packed_poses_come_back_within_half_a_step_of_rounding():
    poses = poses_of(falling())
    found = unpack(pack(poses, "tuned", "case", "0"), "again*", "* elsewhere")
    assert_allclose(found.times, poses.times)
    assert_allclose(found.positions, poses.positions, atol=LENGTH / 2 * (1 + 1e-6), rtol=0)
    # Four parts, each off by half a step, make the length off by as much again.
    assert_allclose(found.orientations, poses.orientations, atol=1.5 * TURN, rtol=0)
    assert (found.title, found.recording, found.bodies) == ("again*", "* elsewhere", ("ball",))


def test_a_body_that_flies_off_to_infinity_stays_at_the_far_end():
    times = np.arange(4) / RATE
    positions = np.array([0.0, 1e9, -1e9, 5.0])[:, None, None] * np.ones(3)
    turns = np.tile([1.0, 0.0, 0.0, 0.0], (4, 1, 1))
    found = unpack(pack(Poses("", ("ball",), times, positions, turns), "tuned", "case", "0"), "")
    assert_allclose(found.positions[:, 0, 0], [0.0, FARTHEST, -FARTHEST, 5.0], atol=LENGTH)


def test_a_file_of_tracks_is_read_back_and_has_the_same_bytes_every_day(tmp_path):
    tracks = [pack(poses_of(falling(step)), "tuned", f"dt={step}", f"{step}") for step in (1e-3, 2e-3, 5e-3)]
    for place, length in enumerate((40, 0, 16)):  # curves of five points, of none, and of two
        tracks[place] = replace(tracks[place], curve=bytes(range(place, place + length)))
    for name, order in (("one", tracks), ("two", tracks[::-1])):
        write_tracks(tmp_path / f"{name}.npz", order, {"engine": "exact"})
    assert (tmp_path / "one.npz").read_bytes() == (tmp_path / "two.npz").read_bytes()
    with zipfile.ZipFile(tmp_path / "one.npz") as file:
        assert {entry.date_time[0] for entry in file.infolist()} == {1980}
    found, made = read_tracks(tmp_path / "one.npz")
    assert list(found.values()) == tracks
    assert made == {"engine": "exact"}
    assert read_tracks(tmp_path / "nowhere.npz") == ({}, {})


@pytest.mark.parametrize("index", [b"[]", b"{", json.dumps({"schema": "collisions-lab/poses", "version": 99}).encode()])
def test_a_file_without_poses_or_of_another_version_is_refused_by_name(index, tmp_path):
    path = tmp_path / "cradle.npz"
    np.savez(path, index=np.frombuffer(index, dtype=np.uint8), planes=np.zeros((4, 0), dtype=np.uint8))
    with pytest.raises(InvalidInput, match=r"cradle\.npz' holds no poses"):
        read_tracks(path)
    path.write_bytes(b"no zip file")
    with pytest.raises(InvalidInput, match=r"cradle\.npz' holds no poses"):
        read_tracks(path)
