"""Figures are drawn once: the cache keeps them, and gives back nothing that could run on a page."""

from __future__ import annotations

from dataclasses import replace

import pytest

from reference.report.drawing import SCHEMA, Drawing, drawn
from reference.running.cache import Cache
from reference.running.shelf import sealed

SVG = "<svg>%s</svg>"


def draw(*shown: float) -> str:
    return SVG % sum(shown)


def refuse(*shown: float) -> str:
    raise AssertionError("it was drawn again")


DRAWING = Drawing("a-figure", "A caption.", draw, (1.0, 2.0))


def test_a_figure_from_the_cache_has_the_same_bytes():
    assert drawn([DRAWING], Cache()) == drawn([replace(DRAWING, draw=refuse)], Cache()) == [SVG % 3.0]


def test_another_number_gives_another_figure():
    other = replace(DRAWING, shown=(1.0, 2.5))
    drawn([DRAWING], Cache())
    assert drawn([other, DRAWING], Cache()) == [SVG % 3.5, SVG % 3.0]


def test_a_fresh_cache_draws_again():
    drawn([DRAWING], Cache())
    with pytest.raises(AssertionError):
        drawn([replace(DRAWING, draw=refuse)], Cache(fresh=True))


@pytest.mark.parametrize("evil", ["<script>x()</script>", '<g onload="x()"/>', '<a href="javascript:x()"/>'])
def test_a_kept_figure_that_could_run_something_is_drawn_again(evil, cache_folder):
    drawn([DRAWING], Cache())
    (path,) = cache_folder.iterdir()
    path.write_bytes(sealed(SCHEMA, (SVG % evil).encode()))
    assert drawn([DRAWING], Cache()) == [SVG % 3.0]
