"""What the tests of the viewer share: runs that nobody had to run, and a reader of packed numbers."""

from __future__ import annotations

import base64

import numpy as np

from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere
from reference.viewer.clip import Clip
from reference.viewer.clip_making import clip, mesh_clip
from reference.viewer.poses import Poses

GRAVITY, RATE, KEPT, HEIGHT = 9.81, 60, 0.5, 1.0
EVIL = "</script><script>window.evil = 1</script>\"'&<b>"
BALL = Scenario(
    "ball",
    (
        Body("floor", HalfSpace()),
        Body("ball", Sphere(0.1), 2.0, (0.0, 0.0, 0.1 + HEIGHT), angular_velocity=(0.0, 3.0, 0.0)),
    ),
    (Pair("ball", "floor", KEPT),),
    1.0,
)


def bouncing(title: str = "hand-written", late: float = 0.0, count: int = 61) -> Poses:
    """A ball that falls 1 m from rest, `late` in s, and bounces once: the closed form, turning about y at 3 rad/s."""
    times = np.arange(count) / RATE
    since = np.maximum(times - late, 0.0)
    fall = np.sqrt(2 * HEIGHT / GRAVITY)
    after = since - fall
    up = np.where(after < 0, HEIGHT - GRAVITY * since**2 / 2, KEPT * GRAVITY * fall * after - GRAVITY * after**2 / 2)
    nothing = np.zeros_like(times)
    positions = np.stack([nothing, nothing, 0.1 + up], axis=-1)
    turns = np.stack([np.cos(1.5 * times), nothing, np.sin(1.5 * times), nothing], axis=-1)
    return Poses(title, ("ball",), times, positions[:, None], turns[:, None])


def three_engines(title: str = "Bouncing ball") -> Clip:
    """The ball, in three implementations beside the exact one."""
    late = {"pybullet": ("PyBullet*", 0.02), "mujoco": ("MuJoCo", 0.04), "dart": ("DART", 0.06)}
    return clip(BALL, {"handwritten": bouncing()} | {name: bouncing(*each) for name, each in late.items()}, title=title)


def chain() -> Clip:
    """A chain of four points that swings, in two implementations."""
    times, place = np.arange(31)[:, None] / RATE, np.arange(4)
    angles = 0.5 * np.cos(3 * times) * np.ones(4)
    points = np.stack([0.3 * place * np.sin(angles), 0 * angles, -0.3 * place * np.cos(angles)], axis=-1)
    return mesh_clip("Chain", [(0, 1), (1, 2), (2, 3)], {"by hand": points, "other": 1.05 * points[:20]})


def flying(shape: Box | Sphere, turn: tuple[float, float, float], count: int = 31) -> tuple[Scenario, Poses]:
    """A body that flies over a floor along x + y and turns about an axis, without gravity."""
    body = Body("it", shape, 1.0, (0.0, 0.0, 1.0), velocity=(1.0, 1.0, 0.0), angular_velocity=turn)
    scenario = Scenario("flying", (Body("floor", HalfSpace()), body), (), 0.5, (0.0, 0.0, 0.0))
    times = np.arange(count) / RATE
    along = np.stack([times, times, np.ones_like(times)], axis=-1)
    rate = float(np.linalg.norm(turn))
    axis = np.array(turn) / (rate or 1.0)
    turns = np.concatenate([np.cos(rate * times / 2)[:, None], np.sin(rate * times / 2)[:, None] * axis], axis=-1)
    return scenario, Poses("it", ("it",), times, along[:, None], turns[:, None])


def unpacked(text: str, count: int, columns: int) -> np.ndarray:
    """Whole steps (count, columns) of packed text, read as docs/design.md describes it."""
    numbers, content, at = [], base64.b64decode(text), 0

    def number() -> int:
        nonlocal at
        value, shift = 0, 0
        while True:
            byte = content[at]
            at += 1
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return value

    while at < len(content):
        found = number()
        numbers += [found] if found else [0] * (number() + 1)
    zigzag = np.array(numbers, dtype=np.int64).reshape(columns, count)
    twice = np.where(zigzag % 2 == 1, -(zigzag + 1) // 2, zigzag // 2)
    return np.cumsum(np.cumsum(twice, axis=1), axis=1).T
