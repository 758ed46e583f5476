"""Boxes that slide and hold, as other people published them, by hand."""

from __future__ import annotations

import pytest

from reference.published.theirs import published


@pytest.mark.statement(24, oracle="P2: SimBenchmark's plate under twenty-five balls")
def test_p2_a_plate_slides_from_under_its_balls_as_published(as_published):
    found = as_published("P2")
    # By hand the balls roll: 2/7 of the plate's acceleration; fifty sweeps leave 1e-12 of that
    assert found["ball_acceleration"][0] == pytest.approx(2 / 7 * found["box_acceleration"][0], rel=1e-10)


@pytest.mark.statement(24, oracle="P7: Newton's own validation")
def test_p7_a_box_slides_as_far_as_its_energy_lasts(as_published):
    # Five decimals were published, of which theirs is allowed 1 %: ours has all five
    assert as_published("P7")["distance"] == pytest.approx(published("P7").expected["distance"], abs=5.5e-6)


@pytest.mark.statement(24, oracle="P8: Chrono")
def test_p8_a_fast_cube_slides_as_far_as_its_energy_lasts(as_published):
    assert as_published("P8")["distance"] == pytest.approx([published("P8").expected["distance"]], abs=5.5e-6)


@pytest.mark.statement(24, oracle="P10: Newton's ramps")
def test_p10_a_box_rests_on_a_ramp_below_the_friction_angle_alone(as_published):
    rests = as_published("P10")["rests"]
    assert rests == [1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 1, 1, 0, 0, 1, 1, 1, 1, 0, 1, 1, 1, 1, 1]
