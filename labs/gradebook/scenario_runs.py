"""A submission's functions in scenarios of its lab: what each run measured, and the poses for a replay.

The driver and the trajectory stay with the grader; only the functions run in the shut-in process. Functions of other
labs are correct ones. No mark depends on these runs, so they are kept apart from the grade.
"""

from __future__ import annotations

import base64
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from labs.grading.budget import SHARE, Budget
from labs.grading.calling.remote import Grader, Remote
from labs.grading.calling.scenario_runs import TIMESTEP, Mixed
from labs.grading.diagnosis.probes.one_case import one_case
from labs.grading.errors import StudentError
from labs.grading.submission.reading import read
from reference import lecture
from reference.catalogue.case import Case
from reference.catalogue.family import Family
from reference.catalogue.scenarios import find
from reference.comparison.compare import compare_case, judged
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Row, Verdict
from reference.engines import load_engine
from reference.engines.base import Engine
from reference.engines.implementation import Implementation
from reference.engines.profiles import EXACT, WORLD
from reference.errors import UnknownName
from reference.recording.entries import Entry
from reference.scene.settings import Settings
from reference.viewer.poses import poses_of
from reference.viewer.tracks import Track, pack

YOURS, HANDWRITTEN = "yours", "handwritten"


@dataclass(frozen=True)
class Asked:
    """A case that every submission of a lab runs, `family/case`, and the quantities that are shown, the first first.

    profile: by which method. timestep: s.
    """

    name: str
    quantities: tuple[str, ...]
    profile: str = EXACT
    timestep: float = TIMESTEP

    @property
    def place(self) -> tuple[Family, Case]:
        """The family and the case; of an ensemble the first scenario alone."""
        family, case = find(self.name)
        if case is None:
            raise UnknownName(f"case of {family.name}", self.name, [each.name for each in family.cases])
        return family, replace(case, scenarios=case.scenarios[:1])


RUNS: Mapping[str, tuple[Asked, ...]] = {
    "detection": (Asked("dropped-ball/e=0.5", ("rebound",)), Asked("ball-to-rest/e=0.5", ("rest_time",))),
    "response": (
        Asked("dropped-ball/e=0.8", ("rebound",)),
        Asked("ball-to-rest/e=0.5", ("rest_time", "rest_height")),
    ),
    "friction": (
        Asked("sliding-slab/μ=0.4,v=2,heading=30°", ("stopping_distance", "sideways")),
        Asked("incline/μ=0.3,θ=10°", ("way",)),
        Asked("incline/μ=0.1,θ=20°", ("way",)),
    ),
    "impulse": (
        Asked("two-balls/e=0.5,m=1,b=0.5", ("striker", "target", "energy")),
        Asked("struck-rod/e=0.5,x=0.499", ("spin", "impulse")),
    ),
    "polyhedra": (Asked("convex-solid/turned", ("face", "segment")),),
    "world": (
        Asked("dropped-ball/e=0.5", ("rebound",), WORLD, 0.005),
        Asked("cradle/5, 1 mm apart", ("last", "first", "energy"), WORLD, 0.005),
        Asked("tipping-box/h=0.1,μ=0.5,θ=20°", ("outcome",), WORLD, 0.01),
    ),
}
"""What the submissions of a lab run: first scenarios alone, so a case whose number is a share of many is left out."""


def run(path: Path, lab: str, grader: Grader, seconds: float) -> list[dict[str, Any]]:
    """Run a submission in the scenarios of its lab; plain data, one entry for each run, which `result` reads.

    seconds: that the submission has for its tests; all its runs together have a third as long, besides.

    Raises
    ------
    UnreadableSubmission, GraderFailed
        If the file cannot be read, or a process failed for no fault of the submission; `MachineBusy` is one of these.
    """
    names = [entry.name for entry in lecture.functions_of(lab) if entry.role == "written"]
    found, budget = [], Budget(seconds * SHARE)
    with Remote(read(path, names), grader, budget) as remote, np.errstate(all="ignore"):  # wrong functions overflow
        for asked in RUNS.get(lab, ()):
            with remote.fresh() as call:
                found.append(_one(asked, Mixed(call=call, topic=lab, one_case=one_case)))
    budget.refuse_if_cut()  # a comparison turns errors into rows
    return found


def _one(asked: Asked, code: Mixed) -> dict[str, Any]:
    family, case = asked.place
    engine, settings = _driver(asked, case, code)
    try:
        rows, trajectories = compare_case(family, case, engine, asked.profile, settings)
    except StudentError as error:
        blank = Row(family.name, case.name, HANDWRITTEN, asked.profile, "", "", Verdict.CRASHED, note=str(error))
        rows, trajectories = [blank], []
    kept: dict[str, Any] = {"case": asked.name, "entry": Entry.of("", rows).as_json()}
    if asked.profile != EXACT:
        kept |= {"profile": asked.profile, "timestep": asked.timestep}
    if trajectories:
        track = pack(poses_of(trajectories[0]), asked.profile, case.name, "")
        kept["poses"] = {
            "bodies": list(track.bodies),
            "rate": track.rate,
            "count": track.count,
            "packed": base64.b85encode(track.packed).decode("ascii"),
        }
    return kept


def _driver(asked: Asked, case: Case, code: Implementation) -> tuple[Engine, Settings]:
    engine = load_engine(HANDWRITTEN, code)
    return engine, engine.settings(case.scenarios[0], asked.profile).change(timestep=asked.timestep)


def result(kept: Mapping[str, Any]) -> JobResult:
    """What `run` kept of one run, judged here and now, as every other result of a comparison.

    Raises
    ------
    CollisionsError, LookupError, TypeError, ValueError
        If it is of a case that no longer exists, or was not written by `run`.
    """
    asked = Asked(kept["case"], (), kept.get("profile", EXACT), kept.get("timestep", TIMESTEP))
    family, case = asked.place
    engine, settings = _driver(asked, case, Implementation())
    entry = Entry.read(kept["entry"])
    if entry.verdict is not None:
        rows = [Row(family.name, case.name, HANDWRITTEN, asked.profile, "", "", entry.verdict, note=entry.note)]
    else:
        method = engine.method(case.scenarios[0], settings)
        numbers = {quantity.name: number for quantity, number in zip(family.quantities, entry.numbers, strict=True)}
        rows = judged(family, case, HANDWRITTEN, asked.profile, settings, method, numbers)
    changes = (("timestep", asked.timestep),)
    job = Job(family.name, HANDWRITTEN, asked.profile, (case.name,), changes=changes, with_poses=True)
    return JobResult(job, YOURS, "", tuple(rows), poses=tuple(_tracks(asked, case, kept.get("poses"))))


def _tracks(asked: Asked, case: Case, kept: Mapping[str, Any] | None) -> Iterator[Track]:
    if kept is not None:
        packed = base64.b85decode(kept["packed"])
        yield Track(asked.profile, case.name, "", tuple(kept["bodies"]), int(kept["rate"]), int(kept["count"]), packed)
