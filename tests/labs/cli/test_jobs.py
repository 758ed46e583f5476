"""Which runs a command line asks for, and what is refused with the choices there are."""

from __future__ import annotations

import pytest
from made_results import made
from program import EXACT, QUICK, collisions

from labs.cli import jobs
from reference.catalogue.scenarios import catalogue
from reference.engines import engine_names
from reference.errors import InvalidInput
from reference.running.study import SCENARIOS

pytestmark = pytest.mark.usefixtures("one_worker")

# Which runs a command line asks for


def test_a_scenario_named_without_a_case_means_all_of_its_cases():
    def cases(*names: str) -> dict[str, tuple[str, ...]]:
        return {job.family: job.cases for job in jobs.planned(names, ["handwritten"], ["exact"])}

    assert cases("ball-to-rest/e=0.8", "incline", "ball-to-rest/e=0.5", "ball-to-rest/e=0.8") == {
        "ball-to-rest": ("e=0.8", "e=0.5"),
        "incline": (),
    }
    for names in (("ball-to-rest", "ball-to-rest/e=0.8"), ("ball-to-rest/e=0.8", "ball-to-rest")):
        assert cases(*names) == {"ball-to-rest": ()}
    assert cases().keys() == catalogue().keys()


def test_a_setting_may_be_written_as_it_is_printed():
    for text in ("shortest_flight=3", "shortest-flight = 3", "shortest flight=3"):
        (job,) = jobs.planned([QUICK[0]], ["handwritten"], ["exact"], assignments=[text])
        assert job.changes == (("shortest_flight", "3"),)


def test_parameters_replace_the_cases_and_take_any_value_in_range():
    found = jobs.planned(["incline"], ["handwritten"], ["exact"], parameters=["friction=0.123", "angle = 7"])
    assert [job.at for job in found] == [(("friction", 0.123), ("angle", 7.0))]
    rest = "ball-to-rest", "--engine", "handwritten", "--profile", "exact", "--at", "restitution=0.37", "--cases"
    # √(2h/g) (1 + e)/(1 − e) = 0.451524 · 1.37/0.63
    assert "e=0.37 0.98188 s expected hand-written, exact 0.98188 s" in collisions("compare", *rest).text


def test_settings_of_the_command_line_reach_the_run():
    assert "e=0.5 1.3546 s expected" in collisions("compare", *EXACT, "--cases").text
    late = collisions("compare", *EXACT, "--cases", "--set", "policy=at_step", "--timestep", "0.01").text
    assert "hand-written, exact 1.3546 s <10" not in late
    with pytest.raises(InvalidInput):
        jobs.planned([QUICK[0]], ["handwritten"], ["exact"], timestep=-1.0)


# What is refused


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (
            ["balltorest"],
            f"unknown scenario 'balltorest'. Did you mean 'ball-to-rest'? Choices: {', '.join(catalogue())}.",
        ),
        (["nowhere"], f"unknown scenario 'nowhere'. Choices: {', '.join(catalogue())}."),
        (
            ["ball-to-rest/e=0.55"],
            "unknown case of ball-to-rest 'e=0.55'. Did you mean 'e=0.5'? Choices: e=0.5, e=0.8, e=0.9.",
        ),
        (["ball-to-rest/"], "unknown case of ball-to-rest ''."),
        (
            ["--engine", "pybulet"],
            f"unknown engine 'pybulet'. Did you mean 'pybullet'? Choices: {', '.join(engine_names())}.",
        ),
        (
            ["--engine", "no/such.py"],
            f"such.py'; an engine is a name ({', '.join(engine_names())}) or a .py file",
        ),
        (
            [*QUICK, "--profile", "exat"],
            "unknown profile 'exat'. Did you mean 'exact'? Choices: exact, world, slide, step.",
        ),
        (
            [*QUICK, "--profile", "tuned"],
            "unknown profile 'tuned'. Did you mean 'exact'? Choices: exact, world, slide, step.",
        ),
        ([*QUICK, "--profile", "spring"], "unknown profile 'spring'. Choices: exact, world, slide, step."),
        ([*QUICK, "--timestep", "-1"], "timestep is -1.0; it must be above zero"),
        ([*QUICK, "--timestep", "0"], "timestep is 0.0; it must be above zero"),
        ([*QUICK, "--timestep", "nan"], "timestep is nan; it must be a finite number"),
        ([*QUICK, "--timestep", "inf"], "timestep is inf; it must be a finite number"),
        ([*QUICK, "--timestep", "100"], "is longer than ball-to-rest/e=0.5, which lasts 6.6"),
        ([*QUICK, "--timestep", "soon"], "Invalid value for '--timestep'"),
        ([*QUICK, "--set", "timestep=-1"], "timestep is '-1'; it must be above zero"),
        ([*QUICK, "--set", "timestep=soon"], "timestep is 'soon'; it must be a number"),
        ([*QUICK, "--set", "policy"], "--set 'policy' is not of the form name=value, such as"),
        ([*QUICK, "--set", "[bold]"], "--set '[bold]' is not of the form name=value, such as"),
        (["incline", "--at", "friction"], "--at 'friction' is not of the form name=value, such as"),
        (["incline", "--at", "friction=much"], "friction is 'much'; it must be a number"),
        (["incline", "--at", "friction=2"], "friction is 2.0; it must be a number from 0 to 1"),
        (
            ["incline", "--at", "frictoin=1"],
            "unknown parameter of incline 'frictoin'. Did you mean 'friction'? Choices: friction, angle.",
        ),
        (["stack", "--at", "friction=1"], "stack has no parameters that can be moved; these have: "),
        ([*QUICK, "--at", "restitution=0.5"], "ball-to-rest/e=0.5 is one case, and so is what parameters make"),
        ([*QUICK, "--set", "=3"], "--set '=3' is not of the form name=value, such as"),
        ([*QUICK, "--set", "policy="], "--set 'policy=' is not of the form name=value, such as"),
        (
            [*QUICK, "--set", "polcy=at_step"],
            "unknown setting of hand-written's exact profile 'polcy'. Did you mean 'policy'? Choices: timestep, ",
        ),
        ([*QUICK, "--set", "shortest_flight=long"], "shortest_flight is 'long'; it must be a number"),
        ([*QUICK, "--set", "policy=guess"], "policy is 'guess'; here it is one of exact_root, interpolated, at_step"),
        ([*QUICK, "--jobs", "0"], "Invalid value for '--jobs' / '-j'"),
        ([*QUICK, "--jobs", "-2"], "Invalid value for '--jobs' / '-j'"),
        ([*EXACT, "--implementation", "solution"], "no implementation 'solution'; give a package such as 'solutions'"),
        ([*EXACT, "--implementation", "no/such/homework.py"], "homework.py': there is no such file"),
        ([*EXACT, "--implementation", "../homework"], "no implementation '../homework'; give a package"),
    ],
    ids=lambda value: " ".join(value).replace(" ".join(QUICK), "…") if isinstance(value, list) else "",
)
def test_a_run_that_cannot_be_made_is_refused_with_the_choices(arguments, said):
    refused = collisions("compare", *arguments)
    assert refused.code == 2
    assert said in refused.error
    assert "Traceback" not in refused.error
    assert refused.output == ""


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (
            ("--at", "restitution=0.4"),
            "--at 'restitution=0.4' needs the scenario that it belongs to. Name one of: thin-wall,",
        ),
        (
            ("dropped-ball", "--at", "restitution=0.4", "--at", "restitution=0.7"),
            "restitution is given twice, as 0.4 and",
        ),
        (("dropped-ball", "--set", "timestep=0.002", "--timestep", "0.003"), "timestep is given twice, as 0.002 and"),
        (("dropped-ball", "--set", "contact_erp=0.2", "--engine", "pybullet"), "setting of PyBullet's spring profile"),
        (("p15",), "p15 is other people's case, no scenario: collisions compare --published p15"),
        (("--published", "dropped-ball"), "unknown published case 'dropped-ball'"),
    ],
)
def test_an_ambiguous_request_is_refused_with_what_to_say_instead(arguments, said):
    refused = collisions("compare", *arguments)
    assert refused.code == 2
    assert said in refused.error


def test_results_come_in_the_order_of_the_jobs(monkeypatch):
    planned = jobs.planned(["struck-cube"], ["handwritten"])
    monkeypatch.setattr(jobs, "run_all", lambda missing, *_: (made(job, 1.0) for job in reversed(missing)))
    had = [made(planned[1], 1.0)]
    assert [result.job for result in jobs.run_work(planned, SCENARIOS, 1, had=had)] == planned
