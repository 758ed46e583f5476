from __future__ import annotations

import numpy as np
import pytest
from oracles import oracle

from reference.comparison.verdicts import Verdict
from reference.published.theirs import published
from solutions.avoidance import orca_half_plane


@pytest.mark.statement(1, oracle="RVO2, and navground which runs it")
def test_our_half_plane_is_the_one_of_rvo2(as_published):
    as_published("P23")


def navgrounds_line(radius, horizon, position, velocity, other_position, other_radius, other_velocity):
    """The border that navground, which runs RVO2, finds for one disc and one neighbour."""
    core = oracle("navground.core")
    kinematics = core.kinematics.OmnidirectionalKinematics(max_speed=20.0, max_angular_speed=1.0)
    behavior = core.behaviors.ORCABehavior(kinematics, radius)
    behavior.time_horizon, behavior.horizon, behavior.safety_margin = horizon, 100.0, 0.0
    behavior.position, behavior.velocity = position, velocity
    behavior.target = core.Target.Direction((1.0, 0.0))
    behavior.environment_state.neighbors = [core.Neighbor(other_position, other_radius, other_velocity, 1)]
    behavior.compute_cmd(0.1)
    (line,) = behavior.lines
    return line


def test_navground_still_gives_the_published_line():
    case = published("P23")
    of = case.setup
    line = navgrounds_line(
        *(of["radius_a"], of["horizon"], of["position_a"], of["velocity_a"]),
        *(of["position_b"], of["radius_b"], of["velocity_b"]),
    )
    # printed with five decimals, of numbers in single precision
    assert line.point == pytest.approx(case.expected["point"], abs=6e-6)
    assert line.direction == pytest.approx(case.expected["direction"], abs=6e-6)


@pytest.mark.statement(1, oracle="P32: dodgy, a port of RVO2")
def test_dodgy_takes_the_whole_way_to_the_border_where_rvo2_takes_half(judged):
    rows = judged("P32")
    deviate = [(row.figure, row.place) for row in rows if row.verdict is Verdict.KNOWN_DEVIATION]
    # At rest with one neighbour ahead, and past it: the three whose velocity leads to no collision within the horizon
    assert deviate == [("point", place) for place in (1, 2, 6, 9, 10)]
    assert {row.verdict for row in rows} == {Verdict.PASS, Verdict.KNOWN_DEVIATION}
    # Half of dodgy's way from the present velocity, which is zero in the first and the last
    assert [row.measured / row.expected for row in rows if row.place in (1, 2, 9, 10)][:4] == pytest.approx([0.5] * 4)


def test_rvo2_in_navground_takes_half_where_no_collision_threatens():
    line = navgrounds_line(1.0, 1.0, (0.0, 0.0), (0.0, 0.0), (1.0, 2.0), 1.0, (0.0, 0.0))
    point, _ = orca_half_plane([0, 0], [0, 0], 1.0, [1, 2], [0, 0], 1.0, 1.0, 0.1)
    assert line.point == pytest.approx(point.tolist(), abs=1e-6)
    assert np.linalg.norm(point) == pytest.approx(np.linalg.norm(published("P32").expected["point"][:2]) / 2, rel=1e-12)


@pytest.mark.statement(1, oracle="P33: dodgy's linear programs")
def test_our_permitted_velocities_are_those_of_dodgy(as_published):
    as_published("P33")
