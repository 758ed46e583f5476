"""A ball that a notebook's own loop moves: its solid from the scenario, and its replay beside recordings."""

from __future__ import annotations

import numpy as np
import pytest

from labs.desk.own_motion import beside, fall
from reference.errors import InvalidInput, UnknownName
from solutions.polyhedra import convex_separation, signed_volume

BOWL, HULL = "ball-in-a-bowl/depth=0.3125", "ball-in-a-bowl/hull"


def test_ball_starts_above_the_middle_of_the_block():
    block = fall(HULL)
    separation, face = convex_separation(block.start, block.vertices, block.faces)
    assert separation == pytest.approx(0.2 + block.radius)
    assert np.ptp(block.vertices[block.faces[face], 2]) == pytest.approx(0)


def test_convex_pieces_fill_the_bowl_and_not_its_hull():
    bowl, block = fall(BOWL), fall(HULL)
    with pytest.raises(ValueError, match="convex"):
        convex_separation(bowl.start, bowl.vertices, bowl.faces)
    assert all(np.isfinite(convex_separation(bowl.start, *piece)[0]) for piece in bowl.pieces)
    volume = signed_volume(bowl.vertices, bowl.faces)
    assert sum(signed_volume(*piece) for piece in bowl.pieces) == pytest.approx(volume)
    assert volume < signed_volume(block.vertices, block.faces)


@pytest.mark.parametrize(("stock", "title"), [(False, "MuJoCo*"), (True, "MuJoCo*, stock")])
@pytest.mark.slow
def test_replay_has_your_ball_beside_the_engines(stock, title):
    block = fall(HULL)
    places = np.linspace(block.start, block.start - [0, 0, 0.2], 1001)
    shown = beside(HULL, places, ("mujoco",), stock=stock)
    assert shown.text == f"[replay: yours, {title}]"
    assert "<iframe" in shown.markup


def test_what_cannot_be_shown_is_named():
    with pytest.raises(InvalidInput, match=r"\(n, 3\), not \(5, 2\)"):
        beside(HULL, np.zeros((5, 2)), ("mujoco",))
    with pytest.raises(InvalidInput, match="finite"):
        beside(HULL, np.full((5, 3), np.nan), ("mujoco",))
    with pytest.raises(InvalidInput, match="names no case"):
        fall("ball-in-a-bowl")
    with pytest.raises(UnknownName, match="ball"):
        fall("convex-solid/turned")
