"""Constant forces on bodies: what they do in every engine, and who does not know them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from catalogue_rows import counted
from engine_grid import DAMPING, ENGINES, SCENARIOS

from reference.engines import load_engine
from reference.errors import CannotExpress
from reference.scene.forces import Force
from reference.scene.scenario import GRAVITY

PUSHED = replace(
    SCENARIOS["thrown-ball"], forces=(Force("thrown", (3.0, -1.0, 0.5)), Force("thrown", (0.0, 0.0, 2.0 * GRAVITY)))
)
"""A ball of 2 kg whose weight one force carries, and which another one pushes."""


@pytest.mark.parametrize("name", [name for name in ENGINES if load_engine(name).applies_forces])
def test_constant_forces_accelerate_a_free_body_by_their_sum_over_its_mass(name, installed):
    engine = installed(name)
    for profile in ("tuned", "stock"):
        pushed = engine.run(PUSHED, engine.settings(PUSHED, profile))
        expected = np.array([3, -2, 4]) + np.outer(pushed.times, [1.5, -0.5, 0.25])
        # v grows by F/m dt in every step, to rounding. Bullet, stock, brakes the ball's 5.4 m/s by 0.04 (1 + v) v a
        # second.
        speed = np.linalg.norm([3, -2, 4]) + 0.1
        near = DAMPING * (1 + speed) * speed * PUSHED.duration if (name, profile) == ("pybullet", "stock") else 1e-12
        np.testing.assert_allclose(pushed.velocity("thrown"), expected, atol=near)
        # A force at the centre turns nothing, but for rounding of where the centre is.
        assert np.abs(pushed.angular_velocity("thrown")).max() < 1e-12


@pytest.mark.parametrize("name", [name for name in ENGINES if not load_engine(name).applies_forces])
def test_an_engine_that_applies_no_forces_says_so(name):
    engine = load_engine(name)
    with pytest.raises(CannotExpress, match="it knows no forces but weight and those of contacts"):
        engine.run(PUSHED, engine.settings(PUSHED, counted(name)))
