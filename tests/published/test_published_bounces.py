"""Bounces that other people published, by hand, and what is behind the figures."""

from __future__ import annotations

import math

import pytest

from reference.published.theirs import published
from solutions.response import bounce_along_normal


@pytest.mark.statement(6, oracle="P1: ODE and Bullet as published by SimBenchmark")
def test_p1_balls_resolved_at_the_step_gain_the_energy_of_two_engines(as_published):
    as_published("P1")


@pytest.mark.statement(7, oracle="P5: MFiX")
def test_p5_the_apexes_of_a_bouncing_ball(as_published):
    as_published("P5")


@pytest.mark.statement(3, oracle="P6: Newton's own validation")
def test_p6_the_first_rebound_is_the_square_of_the_restitution(as_published):
    # A sample is at most g (dt/2)²/2 = 1.25 µm below the top, of a drop of 0.95 m
    assert as_published("P6")["ratio"] == pytest.approx([0.25, 0.64], abs=2e-6)


@pytest.mark.statement(6, oracle="P12: Jolt")
def test_p12_a_thousand_steps_of_a_ball_that_is_resolved_at_the_step(as_published):
    as_published("P12")


@pytest.mark.statement(3, oracle="P15: Siconos")
def test_p15_the_impacts_the_apexes_and_the_end_of_a_bouncing_ball(as_published):
    as_published("P15")
    case = published("P15")
    height, e, g = case.values("height", "restitution", "gravity")
    for shift, count in ((-1e-5, 5), (1e-5, 6)):  # the whole motion in one step, to either side of the last impact
        assert bounce_along_normal(height, 0.0, -g, e, case.expected["impacts"][-1] + shift)[2] == count
    assert bounce_along_normal(height, 0.0, -g, e, case.expected["rest"] - 1e-5)[2] < math.inf
    assert bounce_along_normal(height, 0.0, -g, e, case.expected["rest"] + 1e-5)[2] == math.inf


def test_p26_balls_with_the_apparent_restitution_rebound_as_prescribed(as_published):
    as_published("P26")
