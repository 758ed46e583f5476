"""The functions that an implementation hands in move its runs: a wrong one shows in the numbers."""

from __future__ import annotations

from pathlib import Path

import pytest

from reference import truth
from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.bouncing_ball import DROP_HEIGHT
from reference.catalogue.scenarios.tunnelling import SHOTS, passing_share
from reference.comparison.compare import compare_case
from reference.comparison.verdicts import Row, Verdict
from reference.engines import load_engine
from reference.engines.handwritten import ball_over_plane
from reference.engines.implementation import Implementation
from reference.scene.scenario import GRAVITY
from solutions.detection import missing_probability

WEIGHT_NOT_CARRIED = """
from solutions.forces import semi_implicit_euler
from solutions.response import kinematic_response

def respond_at_step(position, velocity, acceleration, normal, behind, restitution, dt):
    struck = behind[:, None]
    velocity = struck * kinematic_response(velocity, normal, restitution) + ~struck * velocity
    return semi_implicit_euler(position, velocity, acceleration, dt)
"""
REST_OF_THE_STEP_LOST = """
from solutions.response import respond_at_impact as right

def respond_at_impact(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    return right(position, velocity, acceleration, normal, restitution, time_of_impact, dt.clip(max=time_of_impact))
"""
WALL_WITHOUT_THICKNESS = """
from solutions.detection import overlap_interval as right

def overlap_interval(distance, normal_velocity, radius, thickness, dt):
    return right(distance, normal_velocity, radius, 0 * thickness, dt)
"""


IMPACT_ON_THE_WAY_UP = """
from solutions.detection import time_of_impact_exact as right

def time_of_impact_exact(separation, velocity, acceleration):
    return right(separation, velocity, acceleration) * (velocity <= 0)
"""


def row(source: str, where: str, profile: str, quantity: str, **changes) -> Row:
    """The row of one quantity of a case, named as on the command line, with the functions of this source."""
    family, case = (found := catalogue()[where.split("/")[0]]), found.case(where.split("/")[1])
    engine = load_engine("handwritten", Implementation(source))
    settings = engine.settings(case.scenarios[0], profile).change(**changes)
    return next(each for each in compare_case(family, case, engine, profile, settings)[0] if each.quantity == quantity)


def handed_in(folder: Path, text: str) -> str:
    """A file with one function, and the solutions for all others."""
    (folder / "mine.py").write_text(text)
    return f"{folder / 'mine.py'} | solutions"


def test_a_step_in_which_the_plane_carries_no_weight_rebounds_too_low(tmp_path):
    source, dt = handed_in(tmp_path, WEIGHT_NOT_CARRIED), 0.01
    found = row(source, "dropped-ball/e=0.5", "step", "rebound", timestep=dt)
    # −(1 + e) v Δt/2, three times what the method gives; 3 %: terms in Δt², and 13 drops.
    error = -1.5 * truth.impact_speed(DROP_HEIGHT, GRAVITY) * dt / 2 / DROP_HEIGHT
    assert found.measured - 0.25 == pytest.approx(error, rel=0.03)
    assert found.verdict is Verdict.FAIL


@pytest.mark.parametrize("profile", ["exact", "slide"])
def test_a_step_that_ends_at_its_impact_comes_to_rest_late(profile, tmp_path):
    source = handed_in(tmp_path, REST_OF_THE_STEP_LOST)
    late, right = (
        row(each, "ball-to-rest/e=0.5", profile, "rest_time", timestep=0.01) for each in (source, "solutions")
    )
    assert right.measured + 0.01 < late.measured
    assert late.verdict is Verdict.FAIL


def test_an_overlap_that_ends_too_early_lets_more_balls_pass(tmp_path):
    short, right = (
        row(source, "thin-wall/v=10", "step", "passed", timestep=0.01)
        for source in (handed_in(tmp_path, WALL_WITHOUT_THICKNESS), "solutions")
    )
    # A step goes 0.1 m. Balls overlap the wall on 0.05 m of it, and on 0.04 m if the wall has no thickness.
    assert right.measured == pytest.approx(float(missing_probability(10.0, 0.01, 0.02, 0.01)), abs=1 / SHOTS)
    assert short.measured == pytest.approx(passing_share(10.0, 0.01, 0.04), abs=1 / SHOTS)
    assert (right.verdict, short.verdict) == (Verdict.DISAGREES, Verdict.FAIL)


def test_an_impact_that_comes_again_at_once_is_given_up(tmp_path, monkeypatch):
    monkeypatch.setattr(ball_over_plane, "_MOST_IMPACTS", 100)
    found = row(handed_in(tmp_path, IMPACT_ON_THE_WAY_UP), "dropped-ball/e=0.5", "exact", "")
    assert "more than 100 impacts in one step" in found.note
