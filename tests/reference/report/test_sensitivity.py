"""The smallest fault that a verdict notices: found by runs, kept for the report, and said in a sentence."""

from __future__ import annotations

import datetime
import io
import json
import sys
from dataclasses import replace

import pytest
from rich.console import Console

from reference.catalogue.scenarios import catalogue
from reference.comparison.faults import FAULTS
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Row, Verdict
from reference.engines import engine_names, load_engine
from reference.errors import CannotExpress
from reference.prediction.bands import Term
from reference.recording.files import read_json
from reference.report import page
from reference.report import sensitivity as module
from reference.report.row_files import rows_json
from reference.report.sections import Section, sections
from reference.report.sensitivity import (
    NO_EFFECT,
    NOT_NOTICED,
    NOTICED,
    Finding,
    Subject,
    chosen,
    kept,
    kept_sentence,
    measure,
    plan,
    sensitivity,
    sentence,
)
from reference.report.terminal import print_comparison

HAND = load_engine("handwritten")
FAULT = {fault.name: fault for fault in FAULTS}
DROPS = catalogue()["dropped-ball"]
REST = catalogue()["ball-to-rest"]


# How the smallest fault is found


def with_bands(family, factor):
    """The same family, with a judge so many times as coarse."""

    def predict(*asked):
        found = family.predict(*asked)
        return replace(found, terms=(*found.terms, Term("coarser", (factor - 1) * found.near)))

    return replace(family, predict=predict)


def found_in(family, case, profile, fault):
    return Subject(family, family.case(case), HAND, profile).finding(FAULT[fault])


@pytest.mark.parametrize("fault", ["restitution", "timestep"])
def test_a_judge_that_is_coarser_notices_only_larger_faults(fault):
    sharp, coarse = (found_in(with_bands(DROPS, factor), "e=0.5", "step", fault) for factor in (1.0, 100.0))
    assert sharp.outcome == NOTICED
    assert coarse.size == pytest.approx(100 * sharp.size, rel=0.2)


def test_the_size_of_a_restitution_is_what_the_band_allows():
    """A rebound of e² of 1 m changes by 2 e² of the share by which e changes."""
    found, case = found_in(DROPS, "e=0.5", "slide", "restitution"), DROPS.case("e=0.5")
    settings = HAND.settings(case.scenarios[0], "slide")
    near = DROPS.predict(case.scenarios[0], settings, HAND.method(case.scenarios[0], settings)).near
    assert found.case == "e=0.5"
    assert near / 0.5 < found.size < 1.1 * near / 0.5


def test_a_restitution_of_one_can_only_be_too_small():
    assert found_in(DROPS, "e=1", "slide", "restitution").outcome == NOTICED


@pytest.mark.slow
def test_what_physics_does_not_depend_on_has_no_effect():
    for fault in ("mass", "inertia", "sample"):
        assert found_in(DROPS, "e=0.5", "slide", fault).outcome == NO_EFFECT


@pytest.mark.slow
def test_a_judge_that_accepts_everything_notices_nothing():
    blind = with_bands(DROPS, 1e12)
    assert found_in(blind, "e=0.5", "slide", "restitution").outcome == NOT_NOTICED
    assert found_in(blind, "e=0.5", "slide", "sign").outcome == NOT_NOTICED


def test_faults_without_a_size_are_noticed_or_not():
    assert found_in(REST, "e=0.5", "slide", "sample") == Finding(NOTICED, None, "e=0.5")
    assert found_in(DROPS, "e=0.5", "slide", "sign").outcome == NOTICED


@pytest.mark.slow
def test_a_step_that_falls_elsewhere_is_found_by_trying():
    """The time of rest is a whole number of steps: no slope says where it changes."""
    found = found_in(replace(REST, quantities=REST.quantities[:1]), "e=0.5", "step", "gravity")
    assert 1e-5 < found.size < 0.01


def test_a_case_that_has_the_coefficient_is_chosen_too():
    drops = replace(DROPS, convergence=replace(DROPS.convergence, case="e=0"))
    assert [case.name for case in chosen(DROPS)] == ["e=0.5"]
    assert [case.name for case in chosen(drops)] == ["e=0", "e=0.2"]


@pytest.mark.slow
def test_friction_is_tried_in_the_case_where_it_matters():
    """In the studied case the cube grips, and more friction changes nothing; elsewhere it slips."""
    found = sensitivity(catalogue()["struck-cube"], HAND, "exact")
    assert found["friction"].case == "x=0.08,ω=40,μ=0.1"
    assert "timestep" not in found, "the exact root has no timestep"


class _Choosy(type(HAND)):
    """Hand-written code that has no words for the studied case of the three balls."""

    def run_many(self, scenarios, settings):
        if "v=0.1" in scenarios[0].name:
            raise self.cannot(scenarios[0], "it is too slow")
        return super().run_many(scenarios, settings)


def test_another_case_is_tried_where_the_studied_one_cannot_be_run():
    family = catalogue()["parting-ball"]
    assert sensitivity(family, _Choosy(), "exact")["restitution"].case == "v=0.3"
    with pytest.raises(CannotExpress, match="too slow"):
        sensitivity(replace(family, cases=family.cases[:1]), _Choosy(), "exact")


# What is kept of the whole catalogue

PLAN = plan(catalogue(), engine_names())
SIZED = ("restitution", "friction", "gravity", "timestep")
WHOLE = ("static", "sample", "sign")
"""Faults without a size. A sample and a sign move a number by no more than the method's own deviation from theory.
Where no recurrence says how large that is, it lies within the tolerance of theory, and no verdict can tell such
deviations apart."""
TO_ROUNDING, BY_TOLERANCE = 1e-3, 5e-3
"""Largest share that may pass where a method is judged by its recurrence, and where theory has a tolerance."""
KEPT_WITHIN = 3.0
"""Factor by which a kept figure may differ from one that is measured again."""
AGAIN = (
    ("driven-oscillator", "handwritten", "exact"),
    ("off-centre-impact", "handwritten", "exact"),
    ("sinking-ball", "handwritten", "exact"),
    ("concave-solid", "handwritten", "exact"),
    ("break-away", "handwritten", "exact"),
    ("crossed-edges", "handwritten", "world"),
    ("dropped-ball", "pybullet", "tuned"),
    ("dropped-ball", "mujoco", "tuned"),
    ("dropped-ball", "dart", "tuned"),
    ("orbit", "dart", "tuned"),
)
"""Where `make verify` injects all faults again: together they notice every kind."""
IN_TURN = PLAN[datetime.date.today().isocalendar().week % 12 :: 12]
"""Where `make weekly` does it: elsewhere each week, because everywhere it takes more than an hour of processor."""
EXCEPTIONS = {
    # A thousandth of the timestep changes the shift of a slide or a roll, v dt/2 and the like, by 10⁻⁷ m. What friction
    # leaves is more: 1.5·10⁻⁶ m and up of a box that rocks in MuJoCo, 3·10⁻⁷ m of a ball or of corners in DART.
    ("sliding-slab", "timestep"): "mujoco",
    ("incline", "timestep"): "mujoco dart",
    # Nor is the way aside of a slab a shift, or the lean of a cube: each is as large as its band.
    ("sliding-slab", "sign"): "mujoco",
    ("box-flat", "sign"): "dart",
    ("box-flat", "friction"): "dart",
    # How far a surface is beside its edge has no sign.
    ("crossed-edges", "sign"): "pybullet",
    # Next to the critical slope the way is a small difference, 0.25 m in 3 s, and MuJoCo's box rocks by 0.15 mm.
    ("critical-incline", "sample"): "mujoco",
    ("critical-incline", "sign"): "mujoco",
    ("slab-at-30-degrees", "timestep"): "mujoco dart",
    ("slab-at-30-degrees", "sign"): "mujoco",
    # Half a step of 0.1 ms at a break-away is less than what the rocking leaves. DART's heading has no sign: 10⁻⁵ °.
    ("break-away", "sign"): "mujoco dart",
    # The speed that is read may be μ g dt too large: the instant is then 0.3 ms too early, 0.12 % of what it takes.
    ("break-away", "friction"): "mujoco",
    ("break-away", "gravity"): "mujoco",
    # A ball rests after whole steps of 1 ms: 0.11 % of 1.35 s is one and a half.
    ("ball-to-rest", "gravity"): "dart",
    # All numbers are those of the end of the scenario, whatever the timestep: it changes half a step's way alone.
    ("critical-incline", "timestep"): "pybullet mujoco dart",
    ("break-away", "timestep"): "pybullet mujoco dart",
    ("tipping-box", "timestep"): "mujoco dart",
    # MuJoCo's method has no recurrence here: a deviation to either side is within the tolerance of theory.
    ("off-centre-impact", "sign"): "mujoco",
    # The box tips over its edge and comes to rest without sliding: what moves is how still the solver holds it.
    ("box-on-edge", "friction"): "mujoco",
    ("box-on-edge", "timestep"): "mujoco",
    ("friction-oscillator", "timestep"): "mujoco",
    ("friction-oscillator", "sign"): "mujoco",
    # A slab that friction holds stands, whatever these are; MuJoCo's creeps a little more or less.
    **dict.fromkeys([("creep", fault) for fault in ("friction", "gravity", "timestep", "sign")], "mujoco"),
    # A stack stands, whatever its weight, its friction and the timestep are.
    ("stack", "gravity"): "pybullet dart",
    ("stack", "friction"): "pybullet",
    ("stack", "timestep"): "pybullet dart",
}
"""Scenario and fault: the engines in which a fault of the size of its limit passes, and why it has to."""


def let_pass(family, engine, profile, seen):
    """The faults that should have been noticed, and were not, or only when they were too large."""
    scenario = family.case(family.convergence.case).scenarios[0]
    engine = load_engine(engine)
    to_rounding = family.predict and engine.method(scenario, engine.settings(scenario, profile)).rule
    limit = TO_ROUNDING if to_rounding else BY_TOLERANCE
    asked = {name: seen[name] for name in (*SIZED, "static", *(WHOLE if to_rounding else ())) if name in seen}
    return {name for name, each in asked.items() if each["outcome"] == NOT_NOTICED or each.get("size", 0.0) > limit}


@pytest.mark.parametrize("family", catalogue())
def test_every_fault_of_the_size_of_its_limit_turns_a_verdict_red(family):
    assert kept()[family], "python -m reference.report.sensitivity --keep measures it"
    for engine, profiles in kept()[family].items():
        allowed = {fault for (name, fault), engines in EXCEPTIONS.items() if name == family and engine in engines}
        for profile, seen in profiles.items():
            assert let_pass(catalogue()[family], engine, profile, seen) <= allowed, (engine, profile)


def test_kept_figures_are_of_scenarios_and_faults_that_there_are():
    """Without any engine: what the report says belongs to the catalogue of today."""
    places = {(name, engine, profile) for name, own in kept().items() for engine in own for profile in own[engine]}
    assert places <= set(PLAN)
    again = [each for name, engine, profile in AGAIN for each in kept()[name][engine][profile].items()]
    assert {fault for fault, found in again if found["outcome"] == NOTICED} == set(FAULT)


@pytest.mark.parametrize(
    "place",
    [
        *(pytest.param(place, marks=pytest.mark.slow, id="-".join(place)) for place in AGAIN),
        *(pytest.param(each, marks=pytest.mark.weekly, id="-".join(each)) for each in IN_TURN if each not in AGAIN),
    ],
)
def test_what_is_kept_is_what_is_measured_again(place, installed):
    name, engine, profile = place
    installed(engine)
    then, now = kept().get(name, {}).get(engine, {}).get(profile, {}), measure(place)
    assert {fault for fault in now if now[fault].outcome == NOTICED} == {
        fault for fault in then if then[fault]["outcome"] == NOTICED
    }
    for fault, finding in now.items():
        assert finding.size is None or 1 / KEPT_WITHIN < finding.size / then[fault]["size"] < KEPT_WITHIN, fault


def test_nothing_is_measured_where_no_case_can_be_run():
    assert measure(("two-frictions", "dart", "tuned")) == {}


@pytest.mark.slow
def test_the_command_prints_the_sentence_and_a_new_run_replaces_what_is_kept(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(module, "FILE", tmp_path / "kept.json")
    other = {("dropped-ball", "mujoco", "tuned"): {"gravity": Finding(NOTICED, 1.5e-9, "e=0.5")}}
    module.keep(other | {("parting-ball", "handwritten", "exact"): {}, ("no more", "dart", "tuned"): {}})
    monkeypatch.setattr(sys, "argv", ["sensitivity", "parting-ball", "--engine", "handwritten", "--keep"])
    module.main()
    said = capsys.readouterr().out
    assert "parting-ball: The smallest fault that a verdict here would notice: restitution 8.6·10⁻⁸ %" in said
    assert "(hand-written, world) to 0.11 % (hand-written), mass" in said
    assert "Without effect on any number: inertia" in said
    found = read_json(tmp_path / "kept.json", module.SCHEMA, module.VERSION)["families"]
    assert set(found) == {"dropped-ball", "parting-ball"}
    assert found["dropped-ball"]["mujoco"]["tuned"]["gravity"] == {
        "outcome": "noticed",
        "size": 1.5e-9,
        "case": "e=0.5",
    }
    noticed = found["parting-ball"]["handwritten"]["exact"]["restitution"]
    assert noticed == {"outcome": "noticed", "size": 0.0011, "case": "v=0.1"}


# What the report says of it


def noticed(size=None):
    return Finding(NOTICED, size, "v=0.1")


KNOWN = {
    ("parting-ball", "pybullet", "tuned"): {
        "restitution": noticed(2e-9),
        "sign": Finding(NOT_NOTICED),
        "normal": noticed(0.5),
    },
    ("parting-ball", "mujoco", "tuned"): {
        "restitution": noticed(3e-8),
        "mass": Finding(NOT_NOTICED),
        "normal": noticed(0.6),
    },
    ("parting-ball", "dart", "tuned"): {"restitution": noticed(1e-8), "inertia": Finding(NO_EFFECT)},
}
SAID = (
    "The smallest fault that a verdict here would notice: restitution 2·10⁻⁷ % (PyBullet) to 3·10⁻⁶ % (MuJoCo),"
    " direction of a normal 0.6°. Not noticed: mass up to 5 % (MuJoCo), sign of the deviation (PyBullet)."
    " Without effect on any number: inertia."
)


def test_the_sentence_names_the_most_and_the_least_sensitive_engine():
    assert sentence({load_engine(engine).title: found for (_, engine, _), found in KNOWN.items()}) == SAID
    assert sentence({}) == ""


def shown(*engines, **more):
    """A section with lines of these engines, each with a row of the case in which the faults were injected."""
    results = []
    for engine in engines:
        profile = "exact" if engine == "handwritten" else "tuned"
        names = [quantity.name for quantity in catalogue()["parting-ball"].quantities]
        rows = [Row("parting-ball", "v=0.1", engine, profile, name, "", Verdict.PASS, 1.0) for name in names]
        title = load_engine(engine).title if engine in engine_names() else engine
        results.append(JobResult(replace(Job("parting-ball", engine, profile), **more), title, "", tuple(rows)))
    return sections(results)[0]


@pytest.fixture
def known(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "FILE", tmp_path / "kept.json")
    module.keep(KNOWN)


@pytest.mark.usefixtures("known")
def test_a_figure_is_told_of_those_alone_whose_faults_were_measured():
    assert kept_sentence(shown("pybullet", "mujoco", "dart")) == SAID
    alone = (
        "The smallest fault that a verdict on PyBullet would notice: restitution 2·10⁻⁷ %, direction of a normal 0.5°."
    )
    assert kept_sentence(shown("pybullet", "mine.py")).startswith(alone)
    both = "The smallest fault that a verdict on PyBullet and MuJoCo would notice: restitution 2·10⁻⁷ % (PyBullet) to"
    assert kept_sentence(shown("handwritten", "pybullet", "mujoco")).startswith(both)
    assert kept_sentence(shown("mujoco")).startswith(
        "The smallest fault that a verdict here would notice: restitution 3"
    )
    for unknown in (shown("mine.py"), shown("handwritten")):
        assert kept_sentence(unknown) == ""


@pytest.mark.usefixtures("known")
@pytest.mark.parametrize("more", [{"changes": (("timestep", 1e-4),)}, {"implementation": "mine.py"}])
def test_no_figure_is_told_of_other_settings_places_or_code(more):
    section = shown("pybullet", **more)
    steered = replace(section.lines[0], result=replace(section.lines[0].result, functions=("crowd_step",)))
    assert kept_sentence(replace(section, lines=(steered,))) == ""


@pytest.mark.usefixtures("known")
def test_no_figure_is_told_of_a_case_that_did_not_run():
    (line,) = shown("dart").lines
    rows = tuple(replace(row, case="v=0.3") for row in line.result.rows)
    section = Section(line.family, (replace(line, result=replace(line.result, rows=rows)),))
    assert kept_sentence(section) == "Without effect on any number: inertia."


@pytest.mark.usefixtures("known")
@pytest.mark.parametrize("engine", ["pybullet", "handwritten"])
def test_the_report_says_what_is_kept_and_nothing_without(engine):
    parts = [shown(engine)]
    said = kept_sentence(parts[0])
    assert bool(said) is (engine == "pybullet")
    console = Console(width=1000, record=True, file=io.StringIO())
    print_comparison(console, parts)
    text, whole = console.export_text(), page.render(parts, {"parting-ball": []}, [], "")
    assert ("smallest fault" in text, "smallest fault" in whole) == (bool(said), bool(said))
    assert said in text
    assert said in whole
    written = json.loads(rows_json([line.result for line in parts[0].lines]))["sensitivity"]
    assert written.keys() == {"parting-ball"}
