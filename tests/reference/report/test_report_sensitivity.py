"""The smallest faults that verdicts notice, in the report: a sentence for each family, on the page and elsewhere."""

from __future__ import annotations

import io
import json
from dataclasses import replace

import pytest
from rich.console import Console

from reference.catalogue.scenarios import catalogue
from reference.comparison.results import Job, JobResult
from reference.comparison.sensitivity import Finding, Outcome, Sensitivity
from reference.comparison.verdicts import Row, Verdict
from reference.engines import engine_names, load_engine
from reference.recording import sensitivity as kept
from reference.report import page
from reference.report.row_files import rows_json
from reference.report.sections import Section, sections
from reference.report.sensitivity import kept_sentence, sentence
from reference.report.terminal import print_comparison


def noticed(fault, size=None):
    return Finding(fault, Outcome.NOTICED, size, "v=0.1", "off")


def found(engine, *findings, profile="tuned"):
    return Sensitivity("parting-ball", engine, load_engine(engine).title, profile, True, findings)


KEPT = (
    found("pybullet", noticed("restitution", 2e-9), noticed("normal", 0.5), Finding("sign", Outcome.NOT_NOTICED)),
    found("mujoco", noticed("restitution", 3e-8), noticed("normal", 0.6), Finding("mass", Outcome.NOT_NOTICED)),
    found("mujoco", noticed("restitution", 0.04), profile="spring"),
    found("dart", noticed("restitution", 1e-8), Finding("inertia", Outcome.NO_EFFECT)),
)
SAID = (
    "The smallest fault that a verdict here would notice: restitution 2·10⁻⁷ % (PyBullet) to 3·10⁻⁶ % (MuJoCo),"
    " direction of a normal 0.6°. Not noticed: mass up to 5 % (MuJoCo), sign of the deviation (PyBullet)."
    " Without effect on any number: inertia."
)


def test_the_sentence_names_the_most_and_the_least_sensitive_engine():
    assert sentence(KEPT) == SAID
    assert sentence([]) == ""


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
def known(monkeypatch):
    monkeypatch.setattr(kept, "read", lambda: KEPT)


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


@pytest.mark.parametrize("engine", ["pybullet", "handwritten"])
def test_the_report_says_what_is_kept_and_nothing_without(engine, known):
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
