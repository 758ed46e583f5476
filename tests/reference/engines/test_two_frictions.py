"""Static friction that differs from kinetic friction: by hand as theory has it, and no setting of an engine for it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from reference.catalogue import measure
from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.friction import slab_on_plane
from reference.comparison.verdicts import Verdict, judge
from reference.engines import load_engine, mujoco_bodies, mujoco_read_back, pybullet_bodies, pybullet_read_back
from reference.engines.implementation import Implementation
from reference.scene.forces import Force
from reference.scene.scenario import GRAVITY

FAMILY = catalogue()["two-frictions"]
BETWEEN = ("θ=18°", "θ=22°", "θ=26°", "F=3", "F=4", "F=4.8")
"""What static friction holds and kinetic friction would not."""
ONE_COEFFICIENT = """
import numpy as np
import solutions.friction as right

def friction_force(push, velocity, normal_force, static_friction, kinetic_friction):
    return right.friction_force(push, velocity, normal_force, kinetic_friction, kinetic_friction)

def sliding_motion(position, velocity, push, normal_force, static_friction, *rest):
    return right.sliding_motion(position, velocity, push, normal_force, rest[0], *rest)
"""


def verdicts(engine, profile: str) -> dict[str, set[Verdict]]:
    """The verdicts on each case; all of them run as one batch."""
    scenarios = [case.scenarios[0] for case in FAMILY.cases]
    settings = engine.settings(scenarios[0], profile)
    method, runs = engine.method(scenarios[0], settings), engine.run_many(scenarios, settings)
    return {
        case.name: {judge(each.measure(run), each.expect(case, settings, method)) for each in FAMILY.quantities}
        for case, run in zip(FAMILY.cases, runs, strict=True)
    }


@pytest.mark.slow
def test_every_case_of_two_coefficients_agrees_by_hand():
    engine = load_engine("handwritten")
    assert all(found == {Verdict.PASS} for found in verdicts(engine, "exact").values())
    stepped = verdicts(engine, "step")
    assert set().union(*stepped.values()) == {Verdict.PASS, Verdict.KNOWN_DEVIATION}
    assert all(stepped[name] == {Verdict.PASS} for name in BETWEEN)


@pytest.mark.parametrize("profile", ["exact", "step"])
@pytest.mark.slow
def test_kinetic_friction_in_place_of_static_fails_wherever_it_decides(profile, tmp_path):
    file = tmp_path / "one_coefficient.py"
    file.write_text(ONE_COEFFICIENT)
    wrong = load_engine("handwritten", Implementation(f"{file} | solutions"))
    failed = {name for name, found in verdicts(wrong, profile).items() if Verdict.FAIL in found}
    assert failed == {*BETWEEN, "θ=22°,v=-2"}  # the last one stops on its way up and would come down again


# What was tried to give an engine a second coefficient

Tried = tuple[str, Any, Callable[..., None]]
"""Engine; the module whose `set_restitution_and_friction` is followed by something else; and what that is."""


def anchored(bullet: Any, number: int, restitution: float, friction: float, here: dict[str, int]) -> None:
    """A spring at the contact that keeps a resting body in its place, and friction against rolling and spinning."""
    bullet.changeDynamics(
        number, -1, frictionAnchor=1, contactStiffness=1e5, contactDamping=1e3, rollingFriction=0.5, **here
    )


def in_all_five_directions(spec: Any, *_: Any) -> None:
    """0.3 along both tangents, and 0.5 against twisting and rolling."""
    spec.pairs[-1].friction, spec.pairs[-1].condim = [0.3, 0.3, 0.5, 0.5, 0.5], 6


TRIED: dict[str, Tried] = {
    "a friction anchor in PyBullet": ("pybullet", pybullet_bodies, anchored),
    "five coefficients in MuJoCo": ("mujoco", mujoco_bodies, in_all_five_directions),
}


@pytest.mark.parametrize("what", TRIED)
def test_no_setting_that_was_tried_holds_more_at_rest_than_in_motion(what, installed, monkeypatch):
    name, module, more = TRIED[what]
    engine, plain = installed(name), module.set_restitution_and_friction

    def both(*arguments: Any) -> None:
        plain(*arguments)
        more(*arguments)

    monkeypatch.setattr(module, "set_restitution_and_friction", both)
    read_back = pybullet_read_back if name == "pybullet" else mujoco_read_back
    monkeypatch.setattr(read_back, "check_world", lambda *_: None)  # it would refuse what the engine was not told
    for speed in (0.0, 0.1):
        level = slab_on_plane("level", 0.3, 0.0, speed, 0.2)
        pushed = replace(level, forces=(Force("slab", (0.4 * GRAVITY, 0.0, 0.0)),))
        made = engine.run(pushed, engine.settings(pushed, "tuned"))
        # 0.1 g at rest as in motion: nothing between 0.3 and 0.5 holds the slab. 0.4 %: 0.983 for 0.981 at most.
        gained = made.velocity("slab")[-1, 0] - speed
        assert gained / made.times[-1] == pytest.approx(0.1 * GRAVITY, rel=4e-3)
    assert measure.displacement(made, "slab") > 0.03


def test_darts_shapes_have_one_coefficient_of_friction(installed):
    dart = installed("dart").module()
    words = [word for word in dir(dart.dynamics.DynamicsAspect) if "Friction" in word or "Slip" in word]
    assert words == ["getFrictionCoeff", "setFrictionCoeff"]
