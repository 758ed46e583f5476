"""The smallest faults that verdicts notice, in the report: a sentence for each family, on the page and elsewhere."""

from __future__ import annotations

import io
import json

import pytest
from rich.console import Console

from reference.comparison.results import Job
from reference.comparison.sensitivity import Finding, Outcome, Sensitivity
from reference.engines import load_engine
from reference.recording import sensitivity as kept
from reference.report import page
from reference.report.row_files import rows_json
from reference.report.sections import sections
from reference.report.sensitivity import sentence
from reference.report.terminal import print_comparison
from reference.running.study import run_job

JOB = Job("parting-ball", "handwritten", "exact", ("v=0.1",))


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


@pytest.mark.parametrize("known", [KEPT, ()])
def test_the_report_says_what_is_kept_and_nothing_without(known, monkeypatch):
    monkeypatch.setattr(kept, "read", lambda: known)
    result = run_job(JOB)
    parts = sections([result])
    console = Console(width=1000, record=True, file=io.StringIO())
    print_comparison(console, parts)
    assert (SAID in console.export_text()) is bool(known)
    whole = page.render(parts, {"parting-ball": []}, [], "")
    assert (SAID in whole) is bool(known)
    written = json.loads(rows_json([result]))["sensitivity"]
    assert written.keys() == ({"parting-ball"} if known else set())
