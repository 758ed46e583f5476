"""The demonstrations of the lecture: each asks about a scenario of the catalogue, and teaches in a few lines."""

from __future__ import annotations

import itertools
import math
import re

import pytest
from made_results import EVERY, seen_of

from labs.demonstrations.catalogue import DEMONSTRATIONS, find
from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.tunnelling import SHOTS
from reference.engines import engine_names, load_engine
from reference.engines.base import EXACT
from reference.report import terminal_plot


def test_there_are_seven_demonstrations():
    assert [one.name for one in DEMONSTRATIONS] == ["bounce", "stop", "stack", "tunnelling", "roll", "tip", "cradle"]


@EVERY
def test_a_demonstration_names_existing_cases_quantities_and_profiles(demonstration):
    family = catalogue()[demonstration.family]
    cases = [family.case(case) for case in demonstration.cases.values()]
    for quantity in (demonstration.quantity, *demonstration.beside):
        assert family.quantity(quantity).name == quantity
    for engine, profiles in demonstration.profiles.items():
        assert engine in engine_names()
        assert set(profiles) <= set(family.profiles(load_engine(engine)))
    assert demonstration.timesteps or family.curve.case in [case.name for case in cases], "nothing to plot"
    assert bool(demonstration.timesteps) == (demonstration.predicted is not None)


@EVERY
def test_a_demonstration_asks_a_question_and_teaches_in_three_lines(demonstration):
    assert "What will happen" in demonstration.question
    assert demonstration.question.endswith("?")
    assert 1 <= len(demonstration.lesson) <= 3


@EVERY
def test_the_question_has_the_numbers_of_the_scenario(demonstration):
    family, (label, name) = catalogue()[demonstration.family], next(iter(demonstration.cases.items()))
    told = demonstration.question + label
    parameters = family.case(name).parameters
    for parameter in ("restitution", "speed", "friction"):
        if parameter in parameters:
            assert re.search(rf"(?<![\d.]){re.escape(f'{parameters[parameter]:g}')}(?![\d.])", told), parameter
    if "slope" in parameters:
        assert f"{math.degrees(parameters['slope']):.0f}°" in told


@EVERY
def test_the_marks_of_a_demonstration_differ_without_colour(demonstration):
    marks = [terminal_plot.marked(line).plain for line in seen_of(demonstration).implementations.values()]
    assert len(set(marks)) == len(marks)


def test_the_prediction_for_a_timestep_is_the_expectation_of_the_family():
    demonstration = find("tunnelling")
    family = catalogue()[demonstration.family]
    case, quantity = family.case(*demonstration.cases.values()), family.quantity(demonstration.quantity)
    for engine, profiles in demonstration.profiles.items():
        for profile, timestep in itertools.product(profiles, demonstration.timesteps.values()):
            loaded = load_engine(engine)
            settings = loaded.settings(case.scenarios[0], profile).change(timestep=timestep)
            method = loaded.method(case.scenarios[0], settings)
            expectation = quantity.expect(case, settings, method)
            if method.kind == EXACT:
                assert expectation.value + expectation.shift == 0
                continue
            assert demonstration.predicted(timestep) == pytest.approx(
                expectation.value + expectation.shift, abs=1 / SHOTS
            )
