"""What is shown of a demonstration: its numbers are those of the runs, and its curves those of the report."""

from __future__ import annotations

import dataclasses

import pytest
from made_results import made, planned, seen_of

from labs.cli import show
from labs.demonstrations.catalogue import find
from labs.demonstrations.lesson import Error, Magnitude, Measured, Theory
from labs.demonstrations.outcomes import Outcome
from reference.running.study import run_job


def test_a_number_in_a_lesson_is_the_number_of_the_run():
    seen = seen_of(find("bounce"))
    for value in (2.345, 6.789):
        results = [
            dataclasses.replace(result, rows=tuple(dataclasses.replace(row, measured=value) for row in result.rows))
            if (result.job.engine, result.job.profile) == ("pybullet", "stock")
            else result
            for result in seen.results
        ]
        lesson = " ".join(Outcome(seen.demonstration, tuple(results)).lesson())
        assert f"PyBullet rests at {value:g} s" in lesson
        assert "MuJoCo 0.5 s" in lesson


def test_a_number_of_one_timestep_or_case_is_not_that_of_another():
    demonstration = find("tunnelling")
    seen = Outcome(
        demonstration, tuple(made(job, 50 * dict(job.changes)["timestep"]) for job in planned(demonstration))
    )
    assert seen.written(Measured("pybullet", "tuned", "passed", at="1 ms")) == "5 %"
    assert seen.written(Measured("pybullet", "tuned", "passed", at="1/60 s")) == "83 %"
    tip = seen_of(find("tip"))
    stock = next(each for each in tip.results if (each.job.engine, each.job.profile) == ("mujoco", "stock"))
    (other,) = [row for row in stock.rows if (row.quantity, row.case) == ("way", "h=0.2,μ=0.7,θ=20°")]
    rows = tuple(dataclasses.replace(row, measured=0.9) if row is other else row for row in stock.rows)
    changed = dataclasses.replace(stock, rows=rows)
    tip = Outcome(tip.demonstration, tuple(changed if each is stock else each for each in tip.results))
    assert tip.written(Measured("mujoco", "stock", "way", at="20°, μ = 0.7")) == "0.9 m"
    assert tip.written(Measured("mujoco", "stock", "way", at="20°, μ = 0.3")) == "0.5 m"


@pytest.mark.parametrize(
    ("number", "said"),
    [
        (Measured("mujoco", "stock", "height"), "−0.25 m"),
        (Magnitude("mujoco", "stock", "height"), "0.25 m"),
        (Error("mujoco", "stock", "height"), "−1.2 m"),
        (Theory("height"), "0 m"),
    ],
)
def test_a_lesson_shows_a_number_its_magnitude_its_error_or_theory(number, said):
    demonstration = find("stack")
    assert Outcome(demonstration, tuple(made(job, -0.25) for job in planned(demonstration))).written(number) == said


def test_a_hand_written_run_is_drawn_as_the_report_draws_it():
    (job, *_) = show._planned(find("stop"), ["handwritten"], "solutions")
    seen = Outcome(find("stop"), (run_job(job),))
    (curve,) = seen.curves
    assert (curve.xs, curve.ys) == (seen.results[0].series.times, seen.results[0].series.values)
    assert seen.axes == ("time, s", "distance, m")
