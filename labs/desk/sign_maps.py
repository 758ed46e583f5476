"""Draws on which side of a line the points of a grid are said to be: one small picture for each way of asking."""

from __future__ import annotations

import io
from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike

from labs.desk.display import DPI, Picture
from reference.errors import InvalidInput
from reference.report import figures


def sign_maps(signs: Mapping[str, ArrayLike], right: ArrayLike) -> Picture:
    """Draw signs over a grid, (n, m) each, by name; the number of those that differ from the right ones is above each.

    Left is light, on the line is grey, right is dark, which can be read without colour.

    Raises
    ------
    InvalidInput
        If no signs are given, or some have another shape than the right ones.
    """
    truth = np.asarray(right)
    found = {name: np.asarray(values) for name, values in signs.items()}
    for name, values in found.items():
        if values.shape != truth.shape or truth.ndim != 2:
            raise InvalidInput(f"{name}: signs of the shape {values.shape} do not fit a grid of {truth.shape}")
    if not found:
        raise InvalidInput("give the signs of at least one way of asking")
    import matplotlib
    from matplotlib.figure import Figure

    wrong = {name: int(np.sum(values != truth)) for name, values in found.items()}
    with matplotlib.rc_context(figures.STYLE):
        figure = Figure(figsize=(figures.WIDTH, figures.WIDTH / len(found) + 0.1), layout="constrained", dpi=DPI)
        for axes, (name, values) in zip(figure.subplots(1, len(found), squeeze=False)[0], found.items(), strict=True):
            axes.imshow(values.T, origin="lower", cmap="gray", vmin=-1.2, vmax=1.2, interpolation="nearest")
            axes.set(title=f"{name}: {wrong[name]} wrong", xticks=[], yticks=[])
            axes.grid(False)
        content = io.BytesIO()
        figure.savefig(content, format="png")
    said = "; ".join(f"{name}: {count} of {truth.size} wrong" for name, count in wrong.items())
    return Picture(content.getvalue(), f"[signs: {said}]")
