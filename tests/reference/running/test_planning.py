"""Which jobs a question needs, and which questions are refused."""

from __future__ import annotations

import pytest

from reference.catalogue.scenarios import catalogue
from reference.comparison.results import Job
from reference.engines import engine_names, load_engine
from reference.errors import InvalidInput, UnknownName
from reference.running.study import plan

DROPPED, SLIDING = catalogue()["dropped-ball"], catalogue()["sliding-slab"]


def planned(jobs: list[Job]) -> list[tuple[str, str, str]]:
    return [(job.family, job.engine, job.profile) for job in jobs]


def test_without_named_profiles_an_engine_runs_all_of_them():
    assert planned(plan([DROPPED], engine_names())) == [
        ("dropped-ball", "handwritten", "exact"),
        ("dropped-ball", "handwritten", "world"),
        ("dropped-ball", "handwritten", "slide"),
        ("dropped-ball", "handwritten", "step"),
        ("dropped-ball", "pybullet", "tuned"),
        ("dropped-ball", "pybullet", "spring"),
        ("dropped-ball", "pybullet", "stock"),
        ("dropped-ball", "mujoco", "tuned"),
        ("dropped-ball", "mujoco", "spring"),
        ("dropped-ball", "mujoco", "stock"),
        ("dropped-ball", "dart", "tuned"),
        ("dropped-ball", "dart", "stock"),
    ]


def test_the_world_runs_what_no_other_method_can_or_else_the_plotted_case():
    tipping, stack = catalogue()["tipping-box"], catalogue()["stack"]
    planned_cases = {(job.family, job.profile): job.cases for job in plan([tipping, stack, SLIDING], ["handwritten"])}
    assert planned_cases == {
        ("tipping-box", "exact"): (),
        ("tipping-box", "world"): (
            *("h=0.1,μ=1.5,θ=50°", "h=0.2,μ=0.7,θ=20°", "h=0.2,μ=0.7,θ=32°"),
            *("h=0.3,μ=0.5,θ=12°", "h=0.3,μ=0.5,θ=24°"),
        ),
        ("tipping-box", "step"): (),
        ("stack", "world"): (),
        ("sliding-slab", "exact"): (),
        ("sliding-slab", "world"): (SLIDING.curve.case,),
        ("sliding-slab", "step"): (),
    }


def test_the_world_runs_all_cases_or_those_that_are_named():
    (whole,) = plan([SLIDING], ["handwritten"], ["world"])
    assert whole.cases == ()
    (exact, world, step) = plan([SLIDING], ["handwritten"], cases={"sliding-slab": ("μ=0.1,v=1",)})
    assert exact.cases == world.cases == step.cases == ("μ=0.1,v=1",)
    (tips,) = plan([catalogue()["tipping-box"]], ["handwritten"], ["exact"], {"tipping-box": ("h=0.2,μ=0.7,θ=32°",)})
    assert tips.profile == "world"


def test_a_plan_of_everything_has_every_family_engine_and_profile():
    jobs = planned(plan(catalogue().values(), engine_names()))
    assert len(set(jobs)) == len(jobs)
    for name in engine_names():
        for family in catalogue().values():
            for profile in load_engine(name).profiles(family.cases[0].scenarios[0]):
                assert (family.name, name, profile) in jobs


def test_an_engine_without_a_named_profile_runs_the_one_that_counts():
    jobs = plan([DROPPED], engine_names(), ["spring", "tuned"])
    assert planned(jobs) == [
        ("dropped-ball", "handwritten", "exact"),
        ("dropped-ball", "pybullet", "spring"),
        ("dropped-ball", "pybullet", "tuned"),
        ("dropped-ball", "mujoco", "spring"),
        ("dropped-ball", "mujoco", "tuned"),
        ("dropped-ball", "dart", "tuned"),
    ]


def test_a_family_without_a_named_profile_runs_the_one_that_counts():
    assert planned(plan([SLIDING, DROPPED], ["handwritten"], ["slide"])) == [
        ("sliding-slab", "handwritten", "exact"),
        ("dropped-ball", "handwritten", "slide"),
    ]


def test_families_may_come_from_a_generator():
    jobs = plan((family for family in (DROPPED, SLIDING)), ["handwritten"], ["exact"])
    assert [job.family for job in jobs] == ["dropped-ball", "sliding-slab"]


@pytest.mark.parametrize(
    ("arguments", "wrong", "choice"),
    [
        ({"profiles": ["exat"]}, "exat", "exact"),
        ({"engines": ["pybulet"]}, "pybulet", "pybullet"),
        ({"profiles": ["exact"], "changes": {"polcy": "at_step"}}, "polcy", "policy"),
        ({"cases": {"dropped-ball": ("e=0.7",)}}, "e=0.7", "e=0.5"),
    ],
)
def test_an_unknown_name_in_a_plan_is_refused_with_the_known_ones(arguments, wrong, choice):
    with pytest.raises(UnknownName) as refused:
        plan(**({"families": [DROPPED], "engines": ["handwritten"]} | arguments))
    assert refused.value.value == wrong
    assert choice in refused.value.choices


def test_a_profile_of_no_planned_engine_is_refused():
    with pytest.raises(UnknownName):
        plan([DROPPED], ["handwritten", "dart"], ["spring"])


def test_a_timestep_longer_than_a_case_is_refused_when_planned():
    shortest, longest = DROPPED.cases[0], DROPPED.cases[-1]
    between = (shortest.scenarios[0].duration + longest.scenarios[0].duration) / 2
    for cases in ({"dropped-ball": (shortest.name,)}, {}):
        with pytest.raises(InvalidInput, match="longer than"):
            plan([DROPPED], ["handwritten"], ["exact"], cases, changes={"timestep": between})
    assert plan([DROPPED], ["handwritten"], ["exact"], {"dropped-ball": (longest.name,)}, changes={"timestep": between})


def test_a_family_or_engine_named_twice_is_planned_once():
    twice = plan(
        [DROPPED, SLIDING, DROPPED],
        ["handwritten", "pybullet", "handwritten"],
        ["exact", "step", "tuned", "stock", "tuned"],
        {"dropped-ball": ("e=1", "e=0.5", "e=1")},
    )
    profiles, cases = ["exact", "step", "tuned", "stock"], {"dropped-ball": ("e=1", "e=0.5")}
    once = plan([DROPPED, SLIDING], ["handwritten", "pybullet"], profiles, cases)
    assert twice == once
    assert len(once) == 8
    assert once[0].cases == ("e=1", "e=0.5")


def test_no_profiles_or_cases_mean_all_and_no_engines_mean_none():
    everything = plan([DROPPED], ["handwritten"])
    assert plan([DROPPED], ["handwritten"], []) == everything
    assert plan([DROPPED], ["handwritten"], (), {}) == everything
    assert plan([DROPPED], ["handwritten"], (), {"dropped-ball": ()}) == everything
    assert [job.cases for job in everything] == [(), ("e=0.5",), (), ()]  # of the world the plotted case
    assert plan([DROPPED], []) == plan([], ["handwritten"]) == []


def test_a_plan_passes_cases_changes_and_implementation_to_every_job():
    changes = {"timestep": 2e-3, "sample_every": 2}
    jobs = plan(
        [DROPPED, SLIDING],
        ["handwritten", "pybullet"],
        ["tuned"],
        cases={"dropped-ball": ("e=0.5", "e=1")},
        implementation="mine.py",
        changes=changes,
        with_studies=True,
    )
    assert [job.cases for job in jobs] == [("e=0.5", "e=1")] * 2 + [()] * 2
    assert all(dict(job.changes) == changes for job in jobs)
    assert all(job.implementation == "mine.py" and job.with_studies for job in jobs)
