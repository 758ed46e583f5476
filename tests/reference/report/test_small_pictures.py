"""The small pictures of the first screen: which curves are one, what they are called, and where their names are."""

from __future__ import annotations

import re

import numpy as np

from reference.catalogue.scenarios import catalogue
from reference.comparison.curves import Series
from reference.comparison.results import Job, JobResult
from reference.report import name_places
from reference.report.sections import Section, sections
from reference.report.small_pictures import bundles, in_words, picture

TIMES = tuple(0.05 * step for step in range(31))
TITLES = {"handwritten": "hand-written", "pybullet": "PyBullet", "mujoco": "MuJoCo", "dart": "DART"}
STOPS = {"mujoco": 0.67, "dart": 0.4}
"""How far a slab slides in engines as installed; in all others, half a metre."""


def slab() -> Section:
    found = []
    for engine, title in TITLES.items():
        for profile in ("exact", "step") if engine == "handwritten" else ("tuned", "stock"):
            way = STOPS.get(engine, 0.5) if profile == "stock" else 0.5
            series = Series(TIMES, tuple(min(2 * time, way) for time in TIMES))
            found.append(JobResult(Job("sliding-slab", engine, profile), title, "", (), series=series))
    (section,) = sections(found)
    return section


def test_curves_that_coincide_have_one_name():
    names = [bundle.name for bundle in bundles(slab())]
    together = "by hand, all tuned engines, PyBullet as installed: one curve"
    assert names == [together, "MuJoCo as installed", "DART as installed"]
    assert in_words(slab()).startswith(catalogue()["sliding-slab"].curve.title)
    assert in_words(slab()).endswith(f"Curves: {'; '.join(names)}.")


def test_each_curve_of_a_picture_has_its_name_beside_it():
    written = " ".join(re.findall(r"<text[^>]*>([^<]*)</text>", picture(slab())))
    assert all(bundle.name in written for bundle in bundles(slab()))


def test_names_keep_clear_of_curves_and_of_one_another():
    area, across = (0.0, 0.0, 240.0, 110.0), np.linspace(0.0, 240.0, 240)
    heights = {"the upper curve": 90.0, "the middle curve": 60.0, "the lower curve": 57.0}
    curves = [np.stack([across, np.full_like(across, height)], axis=1) for height in heights.values()]
    places = [place for place in name_places.placed(area, list(heights), curves) if place]
    assert [place.text for place in places] == list(heights)
    for place, height in zip(places, heights.values(), strict=True):
        _, bottom, _, top = place.box
        assert not any(bottom <= other <= top for other in heights.values())
        assert sum(place.overlaps(other) for other in places) == 1  # itself
        nearest = min(heights.values(), key=lambda other, box=place.box: max(box[1] - other, other - box[3]))
        assert place.led or nearest == height
