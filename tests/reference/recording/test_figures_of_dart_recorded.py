"""What docs/engines-dart.md says of DART, as recorded runs have it; the slow run measures it again in a live engine."""

from __future__ import annotations

import pytest

from reference.comparison.results import Job
from reference.comparison.verdicts import Row, Verdict
from reference.recording.reading import recall


def recorded(family: str, profile: str, quantity: str) -> dict[str, Row]:
    rows = recall(Job(family, "dart", profile)).rows
    return {row.case: row for row in rows if row.quantity == quantity}


def test_bounces_end_two_percent_early_and_stock_ones_ten_percent_late():
    tuned, stock = (recorded("ball-to-rest", profile, "rest_time") for profile in ("tuned", "stock"))
    assert tuned["e=0.5"].relative_error == pytest.approx(-0.020, abs=5e-4)
    assert stock["e=0.9"].relative_error == pytest.approx(0.098, abs=5e-4)


def test_recorded_slides_stop_half_a_step_short_and_keep_their_line():
    found = recorded("sliding-slab", "tuned", "stopping_distance")
    assert max(abs(row.off) / row.expected for row in found.values()) < 1.2e-5
    assert max(abs(row.measured) for row in recorded("sliding-slab", "tuned", "sideways").values()) < 16e-9


def test_recorded_slabs_hold_or_slide_as_theory_says():
    found, ways = recorded("incline", "tuned", "moves"), recorded("incline", "tuned", "way")
    assert len(found) == 25
    assert all(row.measured == row.expected for row in found.values())
    assert 0.1e-6 < max(ways[case].measured for case, row in found.items() if row.measured == 0) < 0.155e-6


def test_a_recorded_stack_of_ten_stands_as_stated():
    heights, drifts = recorded("stack", "tuned", "height"), recorded("stack", "tuned", "drift")
    assert heights["boxes=10"].measured == pytest.approx(-45e-6, abs=0.5e-6)
    assert drifts["boxes=10"].measured == pytest.approx(2e-6, abs=0.5e-6)


@pytest.mark.parametrize(("profile", "speed", "spin"), [("tuned", 0.0005, 0.0017), ("stock", 0.009, 0.032)])
def test_a_recorded_spinning_ball_gains_what_its_short_lever_arm_adds(profile, speed, spin):
    gripping = [case for case in recorded("spinning-ball", profile, "speed_along") if "ω=60,μ=0.1" not in case]
    for quantity, most in (("speed_along", speed), ("surface_speed", spin)):
        found = recorded("spinning-ball", profile, quantity)
        assert max(found[case].relative_error for case in gripping) == pytest.approx(most, rel=0.05)


def test_a_flat_cube_hardly_leans():
    leans = [row.measured for row in recorded("box-flat", "tuned", "lean").values()]
    assert max(leans) == pytest.approx(0.06e-3, abs=0.005e-3)


def test_recorded_stock_boxes_rock_walk_off_and_sink():
    stops = recorded("sliding-slab", "stock", "stopping_distance")
    assert (len(stops), sum(row.measured is None for row in stops.values())) == (15, 14)
    aside = recorded("sliding-slab", "stock", "sideways")["μ=0.1,v=2,heading=30°"].measured
    assert abs(aside) == pytest.approx(0.32, abs=0.005)
    moves = recorded("incline", "stock", "moves").values()
    assert sum(row.expected == 0 and row.measured == 1 for row in moves) == 7
    assert all(row.measured == 1 for row in moves if row.expected == 1)
    outcomes = recorded("tipping-box", "stock", "outcome").values()
    assert (len(outcomes), sum(row.measured == row.expected for row in outcomes)) == (9, 5)


def test_a_stock_box_dropped_on_an_edge_sinks_in_by_millimetres():
    deep = [-row.error / 9.81 for row in recorded("box-on-edge", "stock", "energy").values()]
    assert (min(deep), max(deep)) == pytest.approx((1.5e-3, 3.1e-3), abs=0.05e-3)


@pytest.mark.parametrize("quantity", ["height", "drift", "speed"])
def test_stock_stacks_stand(quantity):
    assert all(row.verdict is Verdict.PASS for row in recorded("stack", "stock", quantity).values())


def test_stock_balls_are_right_except_for_their_step():
    for family, cases in (("corner", 9), ("rolling-ball", 15), ("sliding-ball", 9)):
        rows = recall(Job(family, "dart", "stock")).rows
        assert len({row.case for row in rows}) == cases
        assert all(row.verdict.value in ("pass", "known deviation") for row in rows)
