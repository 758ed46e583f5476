"""Bullet's continuous detection sweeps bodies along the way of their centres: a rod that turns it does not see."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.catalogue.scenarios import find
from reference.engines import load_engine, pybullet_bodies
from reference.engines.profiles import TUNED
from reference.scene.scenario import Sphere

RADIUS = 0.002
"""Of the ball, m. The rod is 2 mm thick."""


@pytest.mark.slow
@pytest.mark.parametrize("bodies", ["the ball", "both bodies"])
@pytest.mark.parametrize(("inset", "gained"), [(0.0, 0.674), (0.0011, 0.511)])
def test_a_spinning_rod_passes_the_same_balls_with_continuous_detection(installed, monkeypatch, bodies, inset, gained):
    installed("pybullet")
    family, case = find("spinning-rod/ω=100")
    engine = load_engine("pybullet")
    settings = engine.settings(case.scenarios[0], TUNED)
    plain = momenta(family, engine, case, settings)
    if bodies == "both bodies":
        add_body = pybullet_bodies.stand

        def swept(bullet, body, here, *rest, **options):
            number = add_body(bullet, body, here, *rest, **options)
            if not isinstance(body.shape, Sphere):
                bullet.changeDynamics(number, -1, ccdSweptSphereRadius=1e-3, **here)
            return number

        monkeypatch.setattr(pybullet_bodies, "stand", swept)
    options = {**settings.options, "swept_inset": inset, "sweep_from": 0.0}
    found = momenta(family, engine, case, replace(settings, options=options))
    assert np.sum(plain < 1e-3) == 26
    np.testing.assert_array_equal(found < 1e-3, plain < 1e-3)
    struck = plain > 1e-3
    assert plain[struck] == pytest.approx(1.0, abs=1e-3)  # 0.1 %: an impact is all that changes a momentum
    assert found[struck] == pytest.approx(gained, abs=2e-3)  # measured, three digits


def momenta(family, engine, case, settings):
    """What each ball gains, as a share of what theory says."""
    gained = family.quantity("gained")
    return np.array([gained.measure(run) for run in engine.run_many(list(case.scenarios), settings)])
