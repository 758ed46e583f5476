"""What the drawn figures of the labs have in common: colours, boards, arrows and lengths with their names."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from numpy.typing import ArrayLike, NDArray

INK, GREY, LIGHT, BLUE, ORANGE = "#1b1b1b", "#767676", "#e4e8ee", "#0072b2", "#c04f00"
Draw = Callable[[Figure], None]


def board(figure: Figure, x: tuple[float, float], y: tuple[float, float]) -> Axes:
    """Axes without ticks, of equal scale."""
    axes = figure.add_subplot()
    axes.set(xlim=x, ylim=y, aspect="equal")
    axes.set_axis_off()
    return axes


def plot(figure: Figure, x: str, y: str) -> Axes:
    """Axes with names and no numbers."""
    axes = figure.add_subplot()
    axes.set(xlabel=x, ylabel=y, xticks=[], yticks=[])
    axes.spines[["top", "right"]].set_visible(False)
    return axes


def unit(degrees: float) -> NDArray[np.float64]:
    """The unit vector at an angle to the right, counter-clockwise."""
    return np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])


def rotated(vector: ArrayLike, degrees: float) -> NDArray[np.float64]:
    """A vector, turned counter-clockwise."""
    along, across = unit(degrees), unit(degrees + 90)
    x, y = np.asarray(vector)
    return np.asarray(x * along + y * across)


def across(vector: ArrayLike, degrees: float) -> NDArray[np.float64]:
    """The part of a vector that is across a direction."""
    along = unit(degrees)
    return np.asarray(vector) - np.dot(vector, along) * along


def dot(axes: Axes, place: ArrayLike) -> None:
    """A centre of mass."""
    axes.plot(*np.asarray(place), "o", mfc="white", mec=INK, markersize=7, zorder=5)


def arrow(
    axes: Axes,
    start: ArrayLike,
    along: ArrayLike,
    colour: str,
    text: str = "",
    at: float = 1.0,
    beside: tuple[float, float] = (0, 0),
    style: str = "-",
    size: float = 11,
) -> None:
    """An arrow, and its name beside a place on it."""
    start, along = np.asarray(start, dtype=float), np.asarray(along, dtype=float)
    looks = {"arrowstyle": "-|>", "color": colour, "linewidth": 1.8, "linestyle": style, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", start + along, start, arrowprops=looks, zorder=4)
    if text:
        axes.annotate(
            text,
            start + at * along,
            beside,
            textcoords="offset points",
            color=colour,
            ha="center",
            va="center",
            size=size,
        )


def span(
    axes: Axes,
    start: tuple[float, float],
    end: tuple[float, float],
    text: str,
    vertical: bool = False,
    below: bool = False,
) -> None:
    """A length between two points, with its name."""
    looks = {"arrowstyle": "<->", "color": GREY, "linewidth": 1.2, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", end, start, arrowprops=looks)
    middle = np.add(start, end) / 2
    offset = (9, 0) if vertical else (0, -10 if below else 9)
    side = "left" if vertical else "center"
    axes.annotate(text, middle, offset, textcoords="offset points", ha=side, va="center", color=INK)


def floor(axes: Axes, left: float, right: float, height: float) -> None:
    """A level floor with its top at a height."""
    axes.plot([left, right], [height, height], color=INK, lw=2)
    corners = [(left, height), (right, height), (right, height - 0.16), (left, height - 0.16)]
    axes.add_patch(Polygon(corners, fc=LIGHT, ec="none"))
