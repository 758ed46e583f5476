"""Engines as they come, in a notebook: from recordings, as theory says that their friction makes a slab slide."""

from __future__ import annotations

import numpy as np
import pytest

from labs.desk.stock import as_they_come, from_above
from reference import friction_truth
from reference.errors import InvalidInput, UnknownName
from reference.scene.scenario import GRAVITY

CASE = "slab-at-30-degrees/μ=0.4,v=2,heading=30°"


@pytest.fixture(scope="module")
def stock():
    return as_they_come(CASE, ("mujoco", "dart"), ("distance", "aside"))


@pytest.mark.parametrize(("engine", "cone"), [("mujoco", "diamond"), ("dart", "square")])
def test_a_way_from_above_ends_where_the_engines_cone_says(stock, engine, cone):
    way = stock.way(engine)
    assert way[0] == pytest.approx([0, 0])
    end = friction_truth.end_of_slide(cone, 2.0, 0.4, GRAVITY, np.radians(30))
    assert np.linalg.norm(way[-1] - end) < 3e-3


def test_a_page_has_the_replay_and_the_numbers_of_stock_engines(stock):
    shown = stock._repr_mimebundle_()
    assert "replay: MuJoCo*, stock, DART*, stock" in shown["text/plain"]
    assert "<iframe" in shown["text/html"]
    assert "DART*, stock" in shown["text/html"]


def test_springs_of_engines_are_shown_from_their_recordings():
    shown = as_they_come("one-drop/e=0.5", ("pybullet", "mujoco"), ("rebound", "steps"), "spring")
    assert shown.title.endswith("engines with the profile spring")
    found = [row.measured for line in shown.runs.lines for row in line.result.rows if row.quantity == "steps"]
    assert found == [20000, 5000]


def test_ways_from_above_say_where_they_end(stock):
    picture = from_above({"theirs": stock.way("dart"), "mine": np.array([[0, 0, 9.0], [0.5, 0.25, 9.0]])})
    assert picture.png.startswith(b"\x89PNG")
    assert "mine ends at (0.500, 0.250) m" in picture.text
    assert f'alt="{picture.text}"' in picture._repr_mimebundle_()["text/html"]


def test_long_flat_ways_have_a_low_picture():
    low, high = (
        int.from_bytes(from_above({"mine": np.array([[0.0, 0.0], [4.0, up]])}).png[20:24])  # the height of a PNG
        for up in (0.1, 4.0)
    )
    assert low < 0.7 * high


def test_what_is_not_there_is_named(stock):
    with pytest.raises(InvalidInput, match="'pybullet' is none of these runs: mujoco, dart"):
        stock.way("pybullet")
    with pytest.raises(InvalidInput, match="names no case"):
        as_they_come("slab-at-30-degrees", ("mujoco",), ("distance",))
    with pytest.raises(UnknownName, match="springs"):
        as_they_come("one-drop/e=0.5", ("mujoco",), ("rebound",), "springs")
    with pytest.raises(UnknownName, match="width"):
        as_they_come(CASE, ("mujoco",), ("width",))
