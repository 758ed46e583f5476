"""Rows of single cases of the catalogue, each made once, and what the figures of several tests have in common."""

from __future__ import annotations

import functools
import math
from dataclasses import replace

import live
import pytest

from reference.catalogue.case import Case
from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.bouncing_ball import SPREAD, dropped, falling_ball
from reference.comparison.compare import compare_case
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Row
from reference.engines import load_engine
from reference.engines.profiles import EXACT, TUNED
from reference.running.study import run_job

G = 9.81  # m/s²
DROPS = 107  # a prime: the phases within a step are evenly spread for any timestep
FALL = math.sqrt(2 / G)  # s: from rest through 1 m
SPEED = math.sqrt(2 * G)  # m/s: after 1 m
# The mean of v/h = 2/t over fall times that spread evenly around that of 1 m, 1/s, by integration.
MEAN_SPEED = 2 / SPREAD * math.log((FALL + SPREAD / 2) / (FALL - SPREAD / 2))
ROLLING = tuple(case.name for case in catalogue()["sliding-ball"].cases)
SLIDES = tuple(case.name for case in catalogue()["sliding-slab"].cases)
SLOPES = tuple(case.name for case in catalogue()["incline"].cases)
BOUNCES = tuple(case.name for case in catalogue()["dropped-ball"].cases)
SOME_SLIDES = ("μ=0.4,v=2,heading=30°", "μ=0.7,v=1")  # the turned one, the shortest
NEAREST_SLOPES = ("μ=0.1,θ=10°", "μ=1,θ=40°")  # of those that slide and those that hold, one with tan θ close to μ
CORNERS = tuple(case.name for case in catalogue()["corner"].cases)
TIMESTEP = {"pybullet": 1e-3, "mujoco": 1e-4}
engines = pytest.mark.parametrize("name", ["pybullet", "mujoco"])
all_three = pytest.mark.parametrize("name", ["handwritten", "pybullet", "mujoco"])
slow = pytest.mark.slow
weekly = pytest.mark.weekly


def fast_and_slow(argument: str, fast: tuple[str, ...], everything: tuple[str, ...], rest=slow):
    """The cases of the fast run as they are; all the others marked slow, or as `rest` says."""
    others = [pytest.param(case, marks=rest) for case in everything if case not in fast]
    return pytest.mark.parametrize(argument, [*fast, *others])


def counted(engine: str) -> str:
    """The profile of an implementation whose verdicts count."""
    return EXACT if engine == "handwritten" else TUNED


@functools.cache
def job(family: str, engine: str, profile: str, case: str, **changes: float) -> JobResult:
    """One case: from the live runs of `make verify` if these have it, or else run here."""
    planned = live.planned().get((family, engine, profile))
    whole = live.kept(planned) if planned and not changes else None
    if whole and (rows := tuple(row for row in whole.rows if row.case == case)):
        return replace(whole, rows=rows)
    return run_job(Job(family, engine, profile, (case,), changes=tuple(sorted(changes.items()))))


def row(family: str, engine: str, profile: str, case: str, quantity: str, **changes: float) -> Row:
    rows = job(family, engine, profile, case, **changes).rows
    return next(found for found in rows if found.quantity == quantity)


@functools.cache
def many_drops(case: str) -> Case:
    """A case with many more drops than the lab's own, for figures that are means."""
    return dropped("dropped-ball", restitution(case), falling_ball, DROPS)


def tenth_of_drops(case: str) -> Case:
    """Every tenth of these drops: enough where what is asked is coarser than a step's share of the mean."""
    return replace(many_drops(case), scenarios=many_drops(case).scenarios[::10])


def rebound_of(drops: Case, engine: str, profile: str, **changes: float) -> Row:
    found = load_engine(engine)
    settings = found.settings(drops.scenarios[0], profile).change(**changes)
    rows, _ = compare_case(catalogue()["dropped-ball"], drops, found, profile, settings)
    return next(row for row in rows if row.quantity == "rebound")


@functools.cache
def rebound_of_many(engine: str, profile: str, case: str, **changes: float) -> Row:
    return rebound_of(many_drops(case), engine, profile, **changes)


def rebound_of_a_tenth(engine: str, profile: str, case: str, **changes: float) -> Row:
    return rebound_of(tenth_of_drops(case), engine, profile, **changes)


def restitution(case: str) -> float:
    return float(case.removeprefix("e="))


def near(timestep: float) -> float:
    """How close a mean over evenly spread drops is: a sawtooth of v dt over N phases, and terms of second order, m."""
    return SPEED * timestep / DROPS + 2 * G * timestep**2
