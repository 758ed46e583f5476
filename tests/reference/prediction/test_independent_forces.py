"""What engines are told of forces, and what their recurrences take for them, are two statements."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import random_scenes as scenes
from hypothesis import given
from levels import in_turn

from reference.catalogue.scenarios import catalogue
from reference.comparison.compare import judged, measured
from reference.comparison.verdicts import Verdict
from reference.prediction.forces import Forces
from reference.scene import loads
from reference.scene.loads import Loads
from reference.scene.scenario import Scenario

ENGINES = ("pybullet", "mujoco", "dart")
LARGER = 1.01


@given(scenes.loaded_balls())
def test_both_statements_agree_on_any_forces(scenario: Scenario):
    states = np.split(np.array([body.state() for body in scenario.bodies]), (3, 7, 10), axis=-1)
    told, taken = (of(scenario).on_bodies(0.37, *states) for of in (Loads, Forces))
    for one, other in zip(told, taken, strict=True):
        np.testing.assert_allclose(one, other, rtol=0, atol=1e-13 * (1 + np.max(np.abs(one))))  # some roundings


def enlarged(owner: type, name: str, after: str = "__init__"):
    """A method of the engines' statement that also makes a number of it, or what it adds, 1 % larger."""
    method = getattr(owner, after)

    def with_fault(self, *args, **kwargs):
        method(self, *args, **kwargs)
        setattr(self, name, LARGER * getattr(self, name))

    return owner, after, with_fault


on_bodies = Loads.on_bodies


def stronger_pushes(self, time, *state):
    force, torque = on_bodies(self, time, *state)
    for place, push in zip(self._pushed, self.scenario.forces, strict=True):
        force[place] += (LARGER - 1) * np.array(push.at(time))
    return force, torque


FAULTS = {
    "drag": (enlarged(loads._Immersed, "drag"), "sinking-ball"),
    "lift": (enlarged(loads._Immersed, "lift"), "sinking-ball"),
    "stiffness": (enlarged(loads._Springs, "stiffness"), "oscillator"),
    "damping": (enlarged(loads._Springs, "damping"), "oscillator"),
    "rest length": (enlarged(loads._Springs, "rest_length"), "cloth-over-a-ball"),
    "attraction": (enlarged(loads._Attractions, "strength"), "orbit"),
    "push": ((Loads, "on_bodies", stronger_pushes), "driven-oscillator"),
}


@pytest.mark.parametrize(("name", "fault"), in_turn(ENGINES, [(fault,) for fault in FAULTS], []))
def test_an_engine_that_is_told_a_load_one_per_cent_too_large_fails(name, fault, installed, monkeypatch):
    """Hand-written code is not told these sums, and its rows stay as they are."""
    change, family_name = FAULTS[fault]
    family, engine = catalogue()[family_name], installed(name)
    case = replace(family.cases[-1], scenarios=family.cases[-1].scenarios[:1])
    (scenario,) = case.scenarios
    settings = engine.settings(scenario, "tuned")
    with monkeypatch.context() as patched:
        patched.setattr(*change)
        run = engine.run(scenario, settings)
    numbers = {quantity.name: measured(quantity, [run]) for quantity in family.quantities}
    rows = judged(family, case, name, "tuned", settings, engine.method(scenario, settings), numbers)
    assert Verdict.FAIL in {row.verdict for row in rows}
