"""The numbers recorded on a family's grid, at all its points and timesteps: as predicted, or without a rule."""

from __future__ import annotations

import datetime

import pytest

from reference.catalogue.scenarios import catalogue
from reference.engines import engine_names, load_engine
from reference.recording.files import never_recorded
from reference.recording.making import jobs_of
from reference.recording.reading import recall

ENGINES = tuple(name for name in engine_names() if load_engine(name).package is not None)
PAIRS = [
    (family.name, engine)
    for family in catalogue().values()
    for engine in ENGINES
    if family.grid is not None and not never_recorded(family.name, (engine,))
]
WEEK = datetime.date.today().isocalendar().week
IN_VERIFY, IN_WEEKLY = 25, 4
"""`make verify` and `make weekly` look at one of so many parts of the pairs, another one each week."""


def off_band(family: str, engine: str) -> list[str]:
    """The recorded numbers that are farther from what is predicted than their bands, in words."""
    return [
        f"{job} {row.case} {row.quantity}: predicted {row.predicted:.12g}, off {row.off:.3g}, band {row.band:.3g}"
        for job in jobs_of(catalogue()[family], engine)
        if (found := recall(job)) is not None
        for row in found.rows
        if row.band is not None and row.off is not None and abs(row.off) > row.band
    ]


@pytest.mark.slow
@pytest.mark.parametrize(("family", "engine"), PAIRS[WEEK % IN_VERIFY :: IN_VERIFY])
def test_recorded_numbers_of_a_few_grids_are_as_predicted(family, engine):
    assert off_band(family, engine) == []


@pytest.mark.weekly
@pytest.mark.parametrize(("family", "engine"), PAIRS[WEEK % IN_WEEKLY :: IN_WEEKLY])
def test_numbers_recorded_on_a_quarter_of_the_grids_are_as_predicted_or_have_no_rule(family, engine):
    assert off_band(family, engine) == []
