"""Spring meshes by hand: which scenarios are meshes, and that the mesh topic's functions answer them."""

from __future__ import annotations

from dataclasses import replace

import pytest

from reference.catalogue.scenarios import catalogue
from reference.comparison.compare import compare_case
from reference.comparison.verdicts import Row, Verdict
from reference.engines import load_engine
from reference.engines.handwritten.scenario_kind import Kind, kind
from reference.engines.implementation import Implementation
from reference.scene.forces import Attraction, Fluid, Force, GrowingForce, Spring
from reference.scene.scenario import Scenario, Sphere

LIMIT = catalogue()["step-limit"]
PATCH = LIMIT.cases[0].scenarios[0]
CHAIN = catalogue()["hanging-chain"].cases[0].scenarios[0]
DRAPE = catalogue()["cloth-over-a-ball"].cases[1].scenarios[0]
SOFTER = """
from solutions.meshes import edge_stiffness as right

def edge_stiffness(mesh, position):
    return 0.999 * right(mesh, position)
"""
SHAPE_OF_OTHER_WEIGHT = """
from solutions.meshes import static_shape as right

def static_shape(mesh, position, acceleration, *more):
    return right(mesh, position, 1.0001 * acceleration, *more)
"""
MEAN_VELOCITY = """
from solutions.meshes import mesh_step as right

def mesh_step(mesh, position, velocity, acceleration, dt):
    _, after = right(mesh, position, velocity, acceleration, dt)
    return position + dt * (velocity + after) / 2, after
"""
LEFT_INSIDE = """
from solutions.meshes import mesh_sphere_contact as right

def mesh_sphere_contact(mesh, position, velocity, *more):
    return position, right(mesh, position, velocity, *more)[1]
"""

LISTS = """
from solutions.meshes import mesh_sphere_contact as right_contact, mesh_step as right_step

def mesh_step(*given):
    return [part.tolist() for part in right_step(*given)]

def mesh_sphere_contact(*given):
    return [part.tolist() for part in right_contact(*given)]
"""


def rows(source: str, profile: str, tmp_path, name: str = "hanging-chain", place: int = 0) -> dict[str, Row]:
    """The rows of one case with functions of this source, which stand before the right ones."""
    path = tmp_path / "mine.py"
    path.write_text(source, encoding="utf-8")
    case, engine = catalogue()[name].cases[place], load_engine("handwritten", Implementation(f"{path} | solutions"))
    settings = engine.settings(case.scenarios[0], profile)
    if name in ("hanging-chain", "cloth-over-a-ball"):
        settings = settings.change(timestep=4e-3)  # a quarter of the steps
    return {row.quantity: row for row in compare_case(catalogue()[name], case, engine, profile, settings)[0]}


def test_a_shape_at_rest_under_another_weight_turns_the_chain_red(tmp_path):
    found = rows(SHAPE_OF_OTHER_WEIGHT, "exact", tmp_path)
    assert {found[name].verdict for name in ("sag", "pull", "off")} == {Verdict.FAIL}


def test_masses_that_are_left_inside_the_ball_turn_a_drape_red(tmp_path):
    found = rows(LEFT_INSIDE, "step", tmp_path, "cloth-over-a-ball")
    assert {name for name, row in found.items() if row.verdict is Verdict.FAIL} >= {"height", "carried", "sunk", "off"}


def test_places_and_velocities_in_lists_drape_like_those_in_arrays(tmp_path):
    listed, right = (rows(source, "step", tmp_path, "cloth-over-a-ball") for source in (LISTS, ""))
    assert {name: row.measured for name, row in listed.items()} == {name: row.measured for name, row in right.items()}


def test_a_step_with_the_mean_velocity_shows_under_way(tmp_path):
    found = rows(MEAN_VELOCITY, "step", tmp_path)
    assert found["under_way"].verdict is Verdict.FAIL


def with_spring(**changes) -> Scenario:
    return replace(CHAIN, springs=(replace(CHAIN.springs[0], **changes), *CHAIN.springs[1:]))


@pytest.mark.parametrize(
    ("scenario", "expected"),
    [
        (CHAIN, Kind.MESH),
        (replace(CHAIN, forces=(Force("mass 1", (1.0, 0.0, 0.0)),)), Kind.MESH),
        (replace(CHAIN, forces=(GrowingForce("mass 1", (1.0, 0.0, 0.0)),)), None),
        (replace(CHAIN, fluid=Fluid(density=1.0)), None),
        (replace(CHAIN, springs=CHAIN.springs[1:-1]), None),
        (with_spring(point_b=(0.0, 0.0, 0.001)), None),
        (with_spring(body_a="", point_a=(0.0, 0.0, 0.1)), Kind.MESH),
        (replace(CHAIN, attractions=(Attraction("mass 1", "mass 2", 1.0),)), None),
        (replace(CHAIN, bodies=CHAIN.bodies[:3], springs=(*CHAIN.springs[:2], Spring("mass 2", "", 1.0))), None),
    ],
    ids=["itself", "pushed", "pushed more", "thin", "not held", "off centre", "on the world", "attracted", "two"],
)
def test_a_mesh_settles_if_it_hangs_in_a_viscous_fluid(scenario, expected):
    assert kind(scenario) is expected


def other_mass(**changes) -> Scenario:
    return replace(DRAPE, bodies=(DRAPE.bodies[0], replace(DRAPE.bodies[1], **changes), *DRAPE.bodies[2:]))


def other_pair(**changes) -> Scenario:
    return replace(DRAPE, pairs=(replace(DRAPE.pairs[0], **changes), *DRAPE.pairs[1:]))


@pytest.mark.parametrize(
    ("scenario", "expected"),
    [
        (DRAPE, Kind.DRAPE),
        (other_mass(mass=0.1), Kind.DRAPE),
        (other_mass(shape=Sphere(0.005)), None),
        (other_mass(angular_velocity=(0.0, 0.0, 1.0)), None),
        (other_pair(kinetic_friction=0.1, static_friction=0.1), None),
        (other_pair(restitution=0.5), None),
        (other_pair(body_a=DRAPE.bodies[2].name), None),
        (replace(DRAPE, pairs=DRAPE.pairs[1:]), None),
        (replace(DRAPE, fluid=()), None),
    ],
    ids=[
        "itself",
        "heavier",
        "larger",
        "spinning",
        "rubs",
        "rebounds",
        "on another mass",
        "passes through",
        "no fluid",
    ],
)
def test_a_mesh_drapes_if_alike_smooth_balls_come_to_rest_on_one(scenario, expected):
    assert kind(scenario) is expected


def with_dampers(*dampings: float) -> Scenario:
    each = zip(PATCH.springs, dampings * len(PATCH.springs), strict=False)
    return replace(PATCH, springs=tuple(replace(spring, damping=damping) for spring, damping in each))


@pytest.mark.parametrize(
    ("scenario", "expected"),
    [
        (PATCH, Kind.VIBRATION),
        (with_dampers(2.0), Kind.VIBRATION),
        (with_dampers(2.0, 1.9), None),
        (replace(PATCH, gravity=(0.0, 0.0, -1.0)), None),
        (replace(PATCH, springs=(replace(PATCH.springs[0], rest_length=0.501), *PATCH.springs[1:])), None),
    ],
    ids=["free", "alike dampers", "unlike dampers", "weight", "strained"],
)
def test_a_mesh_vibrates_if_nothing_loads_it_and_its_modes_do_not_mix(scenario, expected):
    assert kind(scenario) is expected


def test_a_softer_matrix_shows_where_vibrations_fade(tmp_path):
    """Without dampers no frequency changes the energy; with them a thousandth of the stiffness takes 0.002 off."""
    right, softer = (rows(source, "exact", tmp_path, "step-limit", -1)["growth"] for source in ("", SOFTER))
    assert (right.verdict, softer.verdict) == (Verdict.PASS, Verdict.FAIL)


@pytest.mark.parametrize("name", ["handwritten", "pybullet", "mujoco", "dart"])
def test_only_the_row_of_a_mesh_that_leaves_the_range_of_numbers_fails(name, installed):
    """At ten times its limit it grows by e⁶ in a step, and passes 10³⁰⁸ within 120."""
    engine, case = installed(name), replace(LIMIT.cases[0], scenarios=(replace(PATCH, duration=2.0),))
    profile = "step" if name == "handwritten" else "tuned"
    settings = engine.settings(PATCH, profile).change(timestep=0.01)
    (row,), ran = compare_case(LIMIT, case, engine, profile, settings)
    assert (row.verdict, ran) == (Verdict.CRASHED, [])
    assert "not finite" in row.note
