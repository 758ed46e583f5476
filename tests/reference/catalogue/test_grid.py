"""What can be moved: any value in range runs, and where an engine is only recorded, all go to the nearest point."""

from __future__ import annotations

from dataclasses import replace

import pytest

from reference.catalogue.grid import nearest, nearest_in_ratio
from reference.catalogue.scenarios import catalogue
from reference.comparison.results import Job
from reference.errors import InvalidInput, UnknownName
from reference.running import snapping, study
from reference.running.snapping import moved, snapped

FAMILIES = [family for family in catalogue().values() if family.grid is not None]
DROPPED = catalogue()["dropped-ball"]


def test_each_point_of_a_grid_is_a_case_and_the_defaults_are_one():
    for family in FAMILIES:
        names = [case.name for case in family.grid.cases]
        assert len(set(names)) == len(names), family.name
        assert family.grid.case().name in names, family.name
        for case in family.grid.cases:
            assert all(scenario.name.startswith(f"{family.name}/") for scenario in case.scenarios)


def test_a_case_and_a_grid_point_with_the_same_name_are_the_same():
    for family in FAMILIES:
        for case in family.grid.cases:
            assert case.name not in [own.name for own in family.cases] or case in family.cases, case.name


ONE_TIMESTEP = {
    *("step-limit", "hanging-cloth", "jelly", "cloth-over-a-ball"),
    *("antipodal-circle", "crossing-streams", "flock-past-pillar"),
}
"""Grids with one timestep. Of step-limit the parameter `ratio` is already the timestep over its limit. The others are
there for another parameter, and half the timestep changes little: in MuJoCo the depth of the hanging cloth and the
height of the jelly by 10⁻⁵ of themselves at most, and the arrival of the last walker by up to 0.2 s of 6.6. A second
timestep of all of them would take a megabyte of recordings, which may hold 10 MB and are nearly there."""


def test_values_and_timesteps_of_a_grid_increase():
    for family in FAMILIES:
        values, timesteps = [parameter.values for parameter in family.grid.parameters], family.grid.timesteps
        assert all(row == tuple(sorted(set(row))) for row in (*values, timesteps)), family.name
        assert all(len(row) > 1 for row in values), family.name
        assert (len(timesteps) == 1) == (family.name in ONE_TIMESTEP), family.name


def test_every_value_in_range_makes_a_case():
    case = DROPPED.grid.case(restitution=0.37)
    assert case.parameters == {"restitution": 0.37}
    assert {pair.restitution for scenario in case.scenarios for pair in scenario.pairs} == {0.37}
    assert catalogue()["incline"].grid.case(angle=25).parameters["friction"] == 0.3  # the default


@pytest.mark.parametrize(
    ("family", "at", "said"),
    [
        ("dropped-ball", {"bounciness": 0.5}, "unknown parameter 'bounciness'. Choices: restitution."),
        ("dropped-ball", {"restitution": 1.2}, "restitution is 1.2; it must be a number from 0 to 1"),
        ("incline", {"angle": 50}, "angle is 50; it must be a number from 3° to 40°"),
        ("cradle", {"balls": 3.5}, "balls is 3.5; it must be a whole number from 3 to 5"),
        ("two-balls", {"mass": float("nan")}, "mass is nan; it must be a finite number"),
    ],
)
def test_parameters_out_of_range_are_refused_with_the_range(family, at, said):
    with pytest.raises(InvalidInput) as refused:
        catalogue()[family].grid.case(**at)
    assert said in str(refused.value)


def test_the_nearest_grid_point_is_nearest_in_every_parameter():
    found = nearest(DROPPED.grid, {"restitution": 0.37}, 1.5e-3)
    assert (found.at, found.timestep) == ({"restitution": 0.4}, 2e-3)  # 1.5/1 = 1.5 is farther than 2/1.5 = 1.33
    assert found.moved == "restitution 0.37 → 0.4, timestep 1.5 ms → 2 ms"
    assert nearest_in_ratio((1e-3, 4e-3), 1.9e-3) == 1e-3  # in difference too, 2.2 ms is nearer to 1 ms, in ratio not
    assert nearest_in_ratio((1e-3, 4e-3), 2.2e-3) == 4e-3
    assert nearest(DROPPED.grid, {"restitution": 0.37}, 2e-3).moved.endswith("timestep 2 ms → 2 ms")
    assert nearest(DROPPED.grid, {"restitution": 0.4}, 2e-3).moved == ""
    assert nearest(DROPPED.grid, {"restitution": 0.4}, 3e-3).moved == "timestep 3 ms → 2 ms"
    incline = catalogue()["incline"].grid
    assert nearest(incline, {"friction": 0.5, "angle": 24.0}).moved == "angle 24° → 20°"
    assert nearest(DROPPED.grid, {"restitution": 0.96}).at == {"restitution": 0.95}


def test_ties_go_to_the_smaller_value_and_masses_compare_by_ratio():
    for between in range(10):  # 0.05, 0.15, … 0.85 are a rounding error nearer to either; 0.925 has 0.9 and 0.95
        assert nearest(DROPPED.grid, {"restitution": between / 10 + (0.025 if between == 9 else 0.05)}).at == {
            "restitution": between / 10
        }
    balls = catalogue()["two-balls"].grid
    assert nearest(balls, {"mass": 4e5}).at["mass"] == 1e6  # 4·10⁵ times 3 kg, but 0.4 of 10⁶ kg
    assert nearest(balls, {"mass": 1.8}).at["mass"] == 3.0  # 1.8 times 1 kg, 3/1.67 kg


def test_an_end_of_a_range_may_be_typed_as_it_is_printed():
    mass = catalogue()["two-balls"].grid.full({"mass": 0.333333})["mass"]
    assert mass == 1 / 3
    with pytest.raises(InvalidInput, match=r"from 0\.333333 kg"):
        catalogue()["two-balls"].grid.full({"mass": 0.3333})


def test_a_plan_fills_in_default_parameters_and_refuses_nonsense():
    incline = catalogue()["incline"]
    (job,) = study.plan([incline], ["handwritten"], ["exact"], at={"angle": 25.0})
    assert job.at == (("friction", 0.3), ("angle", 25.0))
    assert str(job) == "incline, friction 0.3, angle 25 in handwritten, exact"
    with pytest.raises(InvalidInput, match=r"stack has no parameters that can be moved; these have: .*dropped-ball"):
        study.plan([catalogue()["stack"]], ["handwritten"], at={"restitution": 0.5})
    with pytest.raises(UnknownName, match="unknown parameter of incline 'restitution'"):
        study.plan([incline], ["handwritten"], at={"restitution": 0.5})
    with pytest.raises(InvalidInput, match="name one of the two"):
        study.plan([incline], ["handwritten"], cases={"incline": ("μ=0.1,θ=3°",)}, at={"angle": 25.0})


def test_a_job_at_some_parameters_runs_one_case_with_curve_and_poses():
    job = Job("cradle", "handwritten", "exact", at=(("balls", 3.0), ("gap", 2e-4)), with_poses=True)
    result = study.run_job(job)
    assert {row.case for row in result.rows} == {"3, 200 µm apart"}
    assert result.series is not None
    (track,) = result.poses
    assert track.bodies == ("ball 1", "ball 2", "ball 3")
    assert study.run_job(replace(job, with_poses=False)).poses == ()


JOBS = [
    Job("dropped-ball", engine, "tuned", changes=(("timestep", 1.5e-3),), at=(("restitution", 0.37),))
    for engine in ("handwritten", "pybullet", "mujoco", "dart")
]


def test_one_recorded_engine_moves_a_comparison_to_a_grid_point(monkeypatch):
    monkeypatch.setattr(snapping, "absent", lambda name: name in ("pybullet", "dart"))
    monkeypatch.setattr(snapping, "content_of", lambda engine, family: {} if engine == "dart" else {"made": {}})
    found = snapped(JOBS)
    assert {(job.at, job.changes) for job in found} == {((("restitution", 0.4),), (("timestep", 2e-3),))}
    words = "dropped-ball: restitution 0.37 → 0.4, timestep 1.5 ms → 2 ms for all, since PyBullet is shown from "
    assert {job.snapped for job in found} == {words + "recordings"}
    assert moved(JOBS[0], ["pybullet", "mujoco", "dart"]).snapped.endswith(
        "PyBullet, MuJoCo and DART are shown from recordings"
    )


def test_a_comparison_of_live_engines_is_not_moved_to_the_grid(monkeypatch):
    monkeypatch.setattr(snapping, "content_of", lambda engine, family: {"made": {}})
    monkeypatch.setattr(snapping, "absent", lambda name: False)
    assert snapped(JOBS) == JOBS
    monkeypatch.setattr(snapping, "absent", lambda name: name == "pybullet")
    others = [
        Job("dropped-ball", "pybullet", "tuned"),
        Job("stack", "pybullet", "tuned", changes=(("timestep", 3e-3),)),
        Job("incline", "pybullet", "tuned", changes=(("contact_erp", 0.1), ("timestep", 3e-3))),
        Job("incline", "pybullet", "tuned", at=(("friction", 0.5), ("angle", 20.0))),  # a point already
    ]
    assert snapped(others) == others


@pytest.mark.parametrize("family", ["incline", "dropped-ball"], ids=["points of its grid", "none of them"])
def test_a_timestep_is_moved_for_a_familys_own_cases_too(family, monkeypatch):
    monkeypatch.setattr(snapping, "absent", lambda name: name == "pybullet")
    monkeypatch.setattr(snapping, "content_of", lambda engine, family: {"made": {}})
    own = [Job(family, engine, "tuned", changes=(("timestep", 3e-3),)) for engine in ("handwritten", "pybullet")]
    assert {job.changes for job in snapped(own)} == {(("timestep", 2e-3),)}
    assert {job.at for job in snapped(own)} == {()}
