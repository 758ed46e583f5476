"""MuJoCo without its refusal of impacts off the centre, and what was tried to make them right."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import pytest

from reference.engines import mujoco_read_back
from reference.engines.mujoco_engine import MuJoCo
from reference.scene.scenario import Scenario
from reference.scene.settings import Option
from reference.scene.trajectory import Trajectory


@dataclass(frozen=True)
class Attempt:
    """One attempt: a profile, changes of its settings, and an edit of the model that no setting of the lab makes."""

    profile: str = "tuned"
    changes: Mapping[str, Option] = field(default_factory=dict)
    edit: Callable[[Any, Any], None] = lambda mujoco, model: None


class Unchecked(MuJoCo):
    """MuJoCo that runs what the lab's adapter refuses, with the model edited."""

    def __init__(self, attempt: Attempt) -> None:
        super().__init__()
        self.attempt = attempt

    def check_impacts(self, scenario: Scenario) -> None:
        """Let everything pass."""

    def _model(self, mujoco: Any, scenario: Scenario, settings: Any) -> Any:
        model = super()._model(mujoco, scenario, settings)
        self.attempt.edit(mujoco, model)
        return model


def tried(scenario: Scenario, attempt: Attempt) -> Trajectory:
    """What MuJoCo makes of a scenario with an attempt."""
    engine = Unchecked(attempt)
    settings = engine.settings(scenario, attempt.profile).change(**attempt.changes)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(mujoco_read_back, "check_world", lambda *_: None)  # an edited model is not what it was told
        return engine.run(scenario, replace(settings, sample_every=1))


def friction_slower(mujoco: Any, model: Any) -> None:
    """Let a step take away a hundredth of the slip instead of all of it."""
    model.pair_solreffriction[:, 1] /= 100


def friction_like_the_normal(mujoco: Any, model: Any) -> None:
    """Let friction have the damping of the normal direction, as a pair has it by default."""
    model.pair_solreffriction[:] = 0


def solver(name: str, iterations: int) -> Callable[[Any, Any], None]:
    """Another solver."""

    def edit(mujoco: Any, model: Any) -> None:
        model.opt.solver = getattr(mujoco.mjtSolver, f"mjSOL_{name}")
        model.opt.iterations, model.opt.tolerance = iterations, 0.0

    return edit


CONVEX = {"impratio": 1.0, "noslip_iterations": 0}
"""Friction in the main solver, and no passes after it."""
ATTEMPTS = {
    "tuned, five noslip passes": Attempt(),
    "100 noslip passes": Attempt(changes={"noslip_iterations": 100}),
    "friction in the main solver": Attempt(changes=CONVEX),
    "impratio 10": Attempt(changes=CONVEX | {"impratio": 10.0}),
    "impratio 100": Attempt(changes=CONVEX | {"impratio": 100.0}),
    "impratio 100, five noslip passes": Attempt(changes={"impratio": 100.0}),
    "timestep 0.01 ms": Attempt(changes=CONVEX | {"timestep": 1e-5}),
    "impedance 0.9": Attempt(changes=CONVEX | {"impedance": 0.9}),
    "pyramidal cone": Attempt(changes=CONVEX | {"cone": "pyramidal"}),
    "solreffriction a hundredth": Attempt(changes=CONVEX, edit=friction_slower),
    "solreffriction as solref": Attempt(changes=CONVEX, edit=friction_like_the_normal),
    "PGS, 1000 iterations": Attempt(changes=CONVEX, edit=solver("PGS", 1000)),
    "PGS, two iterations": Attempt(changes=CONVEX, edit=solver("PGS", 2)),
    "CG, 1000 iterations": Attempt(changes=CONVEX, edit=solver("CG", 1000)),
    "spring": Attempt("spring"),
    "spring, 0.02 ms": Attempt("spring", {"timestep": 2e-5}),
}
