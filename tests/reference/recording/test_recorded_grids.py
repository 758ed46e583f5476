"""Every number recorded on a family's grid, at all its points and timesteps: as predicted, or without a rule."""

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
SLICES = 25
"""`make verify` looks at one of so many parts of the pairs, another one each week."""
THIS_WEEK = PAIRS[datetime.date.today().isocalendar().week % SLICES :: SLICES]


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
@pytest.mark.parametrize(("family", "engine"), THIS_WEEK)
def test_recorded_numbers_of_a_few_grids_are_as_predicted(family, engine):
    assert off_band(family, engine) == []


@pytest.mark.weekly
@pytest.mark.parametrize(("family", "engine"), PAIRS)
def test_every_number_recorded_on_a_grid_is_as_predicted_or_has_no_rule(family, engine):
    assert off_band(family, engine) == []
