from __future__ import annotations

import pytest
from oracles import oracle

from reference.published.theirs import published


@pytest.mark.statement(1, oracle="RVO2, and navground which runs it")
def test_our_half_plane_is_the_one_of_rvo2(as_published):
    as_published("P23")


def test_navground_still_gives_the_published_line():
    core = oracle("navground.core")
    case = published("P23")
    setup = case.setup
    kinematics = core.kinematics.OmnidirectionalKinematics(max_speed=2.0, max_angular_speed=1.0)
    behavior = core.behaviors.ORCABehavior(kinematics, setup["radius_a"])
    behavior.time_horizon, behavior.horizon, behavior.safety_margin = setup["horizon"], 100.0, 0.0
    behavior.position, behavior.velocity = setup["position_a"], setup["velocity_a"]
    behavior.target = core.Target.Direction((1.0, 0.0))
    behavior.environment_state.neighbors = [
        core.Neighbor(setup["position_b"], setup["radius_b"], setup["velocity_b"], 1)
    ]
    behavior.compute_cmd(0.1)
    (line,) = behavior.lines
    # printed with five decimals, of numbers in single precision
    assert line.point == pytest.approx(case.expected["point"], abs=6e-6)
    assert line.direction == pytest.approx(case.expected["direction"], abs=6e-6)
