"""A run is refused where an engine has something else than it was told, quantity by quantity."""

from __future__ import annotations

import functools
import re

import numpy as np
import pytest
from engine_grid import FLOOR, TURNED

from reference.comparison.results import Job
from reference.comparison.verdicts import Verdict
from reference.engines import load_engine
from reference.errors import NotAsTold
from reference.running.study import run_job
from reference.scene.scenario import Body, Pair, Scenario, Sphere

BALL = Body("ball", Sphere(0.13), 1.3, (0.0, 0.0, 0.5))
WHEEL = Body("wheel", Sphere(0.21), 2.7, (0.0, 0.0, 2.0), TURNED, inertia=(0.05, 0.07, 0.04))
SCENE = Scenario(
    "odd",
    (FLOOR, BALL, WHEEL),
    (Pair("ball", "floor", 0.37, 0.41), Pair("wheel", "ball", 0.37, 0.53)),
    0.005,
    (0.11, 0.22, -9.33),
)
"""Odd and unequal values, so that none of them can be a default or another one's."""


def bullet_told(name: str, changed):
    """Makes PyBullet's function `name` be called with changed arguments."""

    def inject(monkeypatch):
        module = load_engine("pybullet").module()
        real = getattr(module, name)

        def called(*positional, **named):
            positional, named = changed(list(positional), named)
            return real(*positional, **named)

        monkeypatch.setattr(module, name, called)

    return inject


def first_times(factor: float):
    return lambda positional, named: ([positional[0] * factor, *positional[1:]], named)


def word_times(word: str, factor: float):
    def changed(positional, named):
        value = named.get(word)
        if value is None:
            return positional, named
        more = [factor * number for number in value] if isinstance(value, tuple) else type(value)(factor * value)
        return positional, named | {word: more}

    return changed


def in_substeps(positional, named):
    load_engine("pybullet").module().setPhysicsEngineParameter(numSubSteps=2, **named)
    return positional, named


def slightly_less_gravity(positional, named):
    return [*positional[:2], -9.32], named


def at_least_one(positional, named):
    return [max(1.0, positional[0]), *positional[1:]], named


def model_told(name: str, changed):
    """Makes an array or an option of MuJoCo's compiled model another one."""

    def inject(monkeypatch):
        mujoco = load_engine("mujoco").module()
        real = mujoco.MjSpec.compile

        def compiled(spec):
            model = real(spec)
            owner = model.opt if hasattr(model.opt, name) else model
            setattr(owner, name, changed(getattr(owner, name)))
            return model

        monkeypatch.setattr(mujoco.MjSpec, "compile", compiled)

    return inject


def scaled(*factors):
    return lambda values: values * np.array(factors)


def dart_told(path: str, changed):
    """Makes a method of one of DART's classes do something else: `changed` gets it, and its arguments."""

    def inject(monkeypatch):
        *way, name = path.split(".")
        dart = load_engine("dart").module()
        owner = functools.reduce(getattr, way, dart)
        real = getattr(owner, name)
        monkeypatch.setattr(owner, name, lambda *arguments: changed(real, *arguments))

    return inject


def nothing(real, *arguments):
    pass


def halved(real, owner, value):
    real(owner, np.array(value) / 2 if np.ndim(value) else value / 2)


def with_inertia(mass=1.0, moment=1.0, product=0.0, centre=(0, 0, 0)):
    """Makes DART get another inertia, of the same class as the one that it was told."""

    def changed(real, owner, inertia):
        tensor = inertia.getMoment() * moment + product * (1 - np.eye(3))
        real(owner, type(inertia)(inertia.getMass() * mass, centre, tensor))

    return changed


def weightless(real, owner, inertia):
    real(owner, inertia)
    owner.setGravityMode(False)


def that_rolls_hard(positional, named):
    return positional, named | {"rollingFriction": 0.01}


def loose(real, skeleton):
    _, node = skeleton.createFreeJointAndBodyNodePair()
    return Immobile(), node


class Immobile:
    """Stands for the joint that would hold a body."""

    def setTransformFromParentBodyNode(self, transform) -> None:
        pass


MISMATCHES = [
    ("pybullet", "timestep 0.0005 s, and was told 0.001 s", bullet_told("setTimeStep", first_times(0.5))),
    ("pybullet", "gravity (0.11, 0.22, -9.32) m/s²", bullet_told("setGravity", slightly_less_gravity)),
    ("pybullet", "mass of ball 1.3013 kg", bullet_told("createMultiBody", first_times(1.001))),
    ("pybullet", "mass of floor 1 kg, and was told inf kg", bullet_told("createMultiBody", at_least_one)),
    ("pybullet", "inertia of wheel (0.0505, ", bullet_told("changeDynamics", word_times("localInertiaDiagonal", 1.01))),
    (
        "pybullet",
        "friction of floor against rolling and spinning (0.01, 0)",
        bullet_told("changeDynamics", that_rolls_hard),
    ),
    ("pybullet", "friction of ball and floor ", bullet_told("changeDynamics", word_times("lateralFriction", 1.001))),
    (
        "pybullet",
        "solver iterations 50, and was told 100",
        bullet_told("setPhysicsEngineParameter", word_times("numSolverIterations", 0.5)),
    ),
    ("pybullet", "substeps 2, and was told 0", bullet_told("setTimeStep", in_substeps)),
    (
        "pybullet multibody",
        "restitution of ball and floor ",
        bullet_told("changeDynamics", word_times("restitution", 1.001)),
    ),
    ("mujoco", "timestep 5e-05 s, and was told 0.0001 s", model_told("timestep", lambda dt: dt / 2)),
    ("mujoco", "gravity (0.11, 0.22, -9.32067) m/s²", model_told("gravity", scaled(1, 1, 0.999))),
    ("mujoco", "integrator IMPLICIT, and was told EULER", model_told("integrator", lambda _: 2)),
    ("mujoco", "cone PYRAMIDAL, and was told ELLIPTIC", model_told("cone", lambda _: 0)),
    ("mujoco", "impratio 1, and was told 1e-10", model_told("impratio", lambda _: 1.0)),
    ("mujoco", "noslip_iterations 0, and was told 5", model_told("noslip_iterations", lambda _: 0)),
    ("mujoco", "noslip_tolerance 1e-06, and was told 0", model_told("noslip_tolerance", lambda _: 1e-6)),
    ("mujoco", "mass of ball 1.3013 kg", model_told("body_mass", scaled(1, 1, 1.001, 1))),
    ("mujoco", "mass of ball inf kg", model_told("body_dofnum", lambda dofs: dofs * [1, 1, 0, 1])),
    ("mujoco", "inertia of ball (", model_told("body_inertia", scaled(1.001))),
    (
        "mujoco",
        "turn of the axes of inertia of wheel (0, 1, 0, 0)",
        model_told("body_iquat", lambda turns: np.vstack([turns[:3], [0, 1, 0, 0]])),
    ),
    (
        "mujoco",
        "contact pairs of ball and floor 0, and was told 1",
        model_told("pair_geom1", lambda geoms: geoms * 0 + 9),
    ),
    ("mujoco", "friction of ball and floor 0.41041", model_told("pair_friction", scaled(1.001))),
    ("mujoco", "impedance of ball and floor 0.9", model_told("pair_solimp", lambda told: told * 0 + 0.9)),
    ("mujoco", "1 + restitution of ball and floor 1.37137", model_told("pair_solref", scaled(1, 1.001))),
    ("mujoco", "overlap_recovery of ball and floor ", model_told("pair_solref", scaled(1.001, 1))),
    (
        "mujoco",
        "share of the slip that a step takes away of ball and floor 0.5",
        model_told("pair_solreffriction", scaled(0.5)),
    ),
    ("mujoco", "dimensions of the contact of ball and floor 1, and was told 3", model_told("pair_dim", lambda _: 1)),
    ("mujoco", "disableflags ", model_told("disableflags", lambda flags: flags | 16)),
    ("mujoco", "margin of ball and floor 0.01, and was told 0", model_told("pair_margin", lambda _: 0.01)),
    ("mujoco spring", "stiffness of ball and floor 1001000", model_told("pair_solref", scaled(1.001, 1))),
    ("mujoco spring", "restitution of ball and floor 0.36", model_told("pair_solref", scaled(1, 1.01))),
    ("mujoco stock", "friction of ball and floor 0.41041", model_told("geom_friction", scaled(1.001))),
    ("dart", "timestep 5e-05 s, and was told 0.0001 s", dart_told("simulation.World.setTimeStep", halved)),
    ("dart", "gravity (0.055, 0.11, -4.665) m/s²", dart_told("simulation.World.setGravity", halved)),
    ("dart", "mass of ball 1.3013 kg", dart_told("dynamics.BodyNode.setInertia", with_inertia(mass=1.001))),
    (
        "dart",
        "mass of floor 1 kg, and was told inf kg",
        dart_told("dynamics.Skeleton.createWeldJointAndBodyNodePair", loose),
    ),
    ("dart", "inertia of ball (", dart_told("dynamics.BodyNode.setInertia", with_inertia(moment=1.001))),
    (
        "dart",
        "products of inertia of ball (0.0001, ",
        dart_told("dynamics.BodyNode.setInertia", with_inertia(product=1e-4)),
    ),
    (
        "dart",
        "centre of mass of ball (0.01, 0, 0) m",
        dart_told("dynamics.BodyNode.setInertia", with_inertia(centre=[0.01, 0, 0])),
    ),
    ("dart", "weight of ball 0, and was told 1", dart_told("dynamics.BodyNode.setInertia", weightless)),
    ("dart", "restitution of ball and floor 0.0925", dart_told("dynamics.DynamicsAspect.setRestitutionCoeff", halved)),
    ("dart", "friction of ball and floor 0.205", dart_told("dynamics.DynamicsAspect.setFrictionCoeff", halved)),
    ("dart", "detector fcl, and was told dart", dart_told("constraint.ConstraintSolver.setCollisionDetector", nothing)),
    (
        "dart",
        "solver DantzigBoxedLcpSolver, and was told NsgsFrictionSolver",
        dart_told("constraint.BoxedLcpConstraintSolver.setBoxedLcpSolver", nothing),
    ),
    ("dart", "solver tolerance ", dart_told("constraint.NsgsFrictionSolver.setOptions", nothing)),
    (
        "dart",
        "split impulses 0, and was told 1",
        dart_told("constraint.ConstraintSolver.setSplitImpulseEnabled", nothing),
    ),
    ("dart", "sleep 1, and was told 0", dart_told("simulation.World.setDeactivationOptions", nothing)),
]
"""Engine and profile, what the refusal says, and how the engine is made to have something else than it was told."""


def settings_of(engine: str, words: list[str]):
    profile = next((word for word in words if word in ("spring", "stock")), "tuned")
    settings = load_engine(engine).settings(SCENE, profile)
    return settings.change(coordinates="multibody") if "multibody" in words else settings


@pytest.mark.parametrize(
    "engine",
    [
        "pybullet",
        "pybullet multibody",
        "pybullet stock",
        "mujoco",
        "mujoco spring",
        "mujoco stock",
        "dart",
        "dart stock",
    ],
)
def test_a_world_that_is_as_told_runs(engine, installed):
    name, *words = engine.split()
    installed(name).run(SCENE, settings_of(name, words))


@pytest.mark.parametrize(("engine", "words", "inject"), MISMATCHES, ids=[f"{one[0]}, {one[1]}" for one in MISMATCHES])
def test_a_world_that_is_not_as_told_is_refused(engine, words, inject, installed, monkeypatch):
    name, *profile = engine.split()
    adapter, settings = installed(name), settings_of(name, profile)
    inject(monkeypatch)
    with pytest.raises(NotAsTold, match=f"^{adapter.title} says {re.escape(words)}"):
        adapter.run(SCENE, settings)


def test_a_mismatch_becomes_the_row_that_says_why(installed, monkeypatch):
    installed("mujoco")
    model_told("timestep", lambda dt: dt / 2)(monkeypatch)
    result = run_job(Job("dropped-ball", "mujoco", "tuned", ("e=0.5",)))
    assert [row.verdict for row in result.rows] == [Verdict.CRASHED]
    assert result.rows[0].note == "MuJoCo says timestep 5e-05 s, and was told 0.0001 s"
