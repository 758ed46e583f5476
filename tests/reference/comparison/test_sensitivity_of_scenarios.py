"""How small a fault the verdicts of the whole catalogue notice: what is kept of it, and some measured again."""

from __future__ import annotations

import datetime

import pytest
from run_allowances import MORE

from reference.catalogue.scenarios import catalogue
from reference.comparison.faults import FAULTS
from reference.comparison.sensitivity import Outcome, Sensitivity
from reference.engines import engine_names
from reference.engines.profiles import TUNED, WORLD
from reference.errors import CannotExpress, NeedsFunction
from reference.recording import sensitivity as kept
from reference.running.sensitivity import SensitivityJob, plan, run_job

JOBS = plan(list(catalogue()), engine_names())
SIZED = ("restitution", "friction", "gravity", "timestep")
WHOLE = ("static", "sample", "sign")
"""Faults without a size. A sample and a sign move a number by no more than the method's own deviation from theory.
Where no recurrence says how large that is, it lies within the tolerance of theory, and no verdict can tell such
deviations apart."""
TO_ROUNDING, BY_TOLERANCE = 1e-3, 5e-3
"""Largest share that may pass where a method is judged by its recurrence, and where theory has a tolerance."""
KEPT_WITHIN = 3.0
"""Factor by which a kept figure may differ from one that is measured again."""
EXCEPTIONS = {
    # A thousandth of the timestep changes the shift of a slide or a roll, v dt/2 and the like, by 10⁻⁷ m. What friction
    # leaves is more: 1.5·10⁻⁶ m and up of a box that rocks in MuJoCo, 3·10⁻⁷ m of a ball or of corners in DART.
    ("sliding-slab", "timestep"): "mujoco",
    ("incline", "timestep"): "mujoco dart",
    ("sliding-ball", "timestep"): "mujoco dart",
    ("rolling-ball", "timestep"): "mujoco dart",
    # Nor is the way aside of a slab a shift, or the lean of a cube: each is as large as its band.
    ("sliding-slab", "sign"): "mujoco",
    ("box-flat", "sign"): "dart",
    ("box-flat", "friction"): "dart",
    # How far a surface is beside its edge has no sign.
    ("crossed-edges", "sign"): "pybullet",
    # Next to the critical slope the way is a small difference, 0.25 m in 3 s, and MuJoCo's box rocks by 0.15 mm.
    ("critical-incline", "gravity"): "mujoco",
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
    # Where a spring almost grips a spinning ball, MuJoCo's solver leaves as much as 0.16 % of the friction.
    ("superball", "friction"): "mujoco",
    ("tipping-box", "timestep"): "mujoco dart",
    # The Runge–Kutta method by hand is of fourth order: what longer steps change is less than what rounding may.
    ("orbit", "timestep"): "handwritten",
    # The box tips over its edge and comes to rest without sliding: what moves is how still the solver holds it.
    ("box-on-edge", "friction"): "mujoco",
    ("box-on-edge", "timestep"): "mujoco",
    ("friction-oscillator", "timestep"): "mujoco",
    ("friction-oscillator", "sign"): "mujoco",
    # A slab that friction holds stands, whatever these are; MuJoCo's creeps a little more or less.
    **dict.fromkeys([("creep", fault) for fault in ("friction", "gravity", "timestep", "sign")], "mujoco"),
    # A stack stands, whatever its weight, its friction and the timestep are.
    ("stack", "gravity"): "pybullet dart",
    ("stack", "friction"): "pybullet dart",
    ("stack", "timestep"): "pybullet dart",
}
"""Scenario and fault: the engines in which a fault of the size of its limit passes, and why it has to."""


def in_turn(week: int) -> list[SensitivityJob]:
    """For every second family the jobs of one implementation: of other families and implementations each week.

    Left out are pairs that take long, and the hand-written world where an engine can have the turn: to inject all
    faults everywhere takes more than an hour of processor time. `collisions sensitivity --keep` does it.
    """
    found = list[SensitivityJob]()
    for place, family in enumerate(catalogue()):
        own = [
            job for job in JOBS if job.family == family and job.profile != WORLD and (family, job.engine) not in MORE
        ]
        engines = list(dict.fromkeys(job.engine for job in own))
        found += [job for job in own if (place + week) % 2 == 0 and job.engine == engines[week // 2 % len(engines)]]
    return found


INJECTED = in_turn(datetime.date.today().isocalendar().week)


KEPT = {(each.family, each.engine, each.profile): each.findings for each in kept.read()}


def noticed(job: SensitivityJob) -> set[str]:
    """The kinds of fault that turned a verdict red when they were injected last."""
    findings = KEPT.get((job.family, job.engine, job.profile), ())
    return {finding.fault for finding in findings if finding.outcome is Outcome.NOTICED}


def representatives() -> list[SensitivityJob]:
    """Jobs that together notice every kind of fault, those of the step loops by hand first, which are quick.

    `make verify` injects theirs, `make weekly` those of some others.
    """
    chosen, kinds = list[SensitivityJob](), set[str]()

    def gained(job: SensitivityJob) -> tuple[int, int]:
        return len(noticed(job) - kinds), -len(catalogue()[job.family].cases)

    for among in ([job for job in JOBS if job.profile == "step"], JOBS):
        while not noticed(best := max(among, key=gained)) <= kinds:
            chosen.append(best)
            kinds |= noticed(best)
    return chosen


OFTEN = representatives()


def test_every_kind_of_fault_is_injected_again():
    assert {kind for job in OFTEN for kind in noticed(job)} == {fault.name for fault in FAULTS}


def measured(job: SensitivityJob) -> Sensitivity | None:
    try:
        return run_job(job).sensitivity
    except (NeedsFunction, CannotExpress):
        return None


def let_pass(seen: Sensitivity) -> set[str]:
    """The faults that should have been noticed, and were not, or only when they were too large."""
    must = (*SIZED, *WHOLE) if seen.predicted else (*SIZED, "static")
    limit = TO_ROUNDING if seen.predicted else BY_TOLERANCE
    asked = [each for each in seen.findings if each.fault in must]
    return {each.fault for each in asked if each.outcome is Outcome.NOT_NOTICED or (each.size or 0.0) > limit}


@pytest.mark.parametrize("family", catalogue())
def test_every_fault_of_the_size_of_its_limit_turns_a_verdict_red(family):
    seen = [each for each in kept.read() if each.family == family and (each.profile == TUNED or each.predicted)]
    assert seen, "collisions sensitivity --keep measures it"  # others count nowhere, and have no prediction
    for each in seen:
        exceptions = EXCEPTIONS.items()
        allowed = {fault for (name, fault), engines in exceptions if name == family and each.engine in engines}
        assert let_pass(each) <= allowed, each.engine


@pytest.mark.parametrize(
    "job",
    [
        *(pytest.param(job, marks=pytest.mark.slow, id=str(job)) for job in OFTEN),
        *(pytest.param(job, marks=pytest.mark.weekly, id=str(job)) for job in INJECTED if job not in OFTEN),
    ],
)
def test_what_is_kept_is_what_is_measured_again(job, installed):
    installed(job.engine)
    seen = measured(job)
    then = {(each.engine, each.profile): each for each in kept.read() if each.family == job.family}
    before = then.get((job.engine, job.profile))
    assert (seen is None) == (before is None), "collisions sensitivity --keep measures it"
    for now in seen.findings if seen else ():
        was = before.finding(now.fault)
        assert (was.outcome is Outcome.NOTICED) == (now.outcome is Outcome.NOTICED), now
        assert now.size is None or 1 / KEPT_WITHIN < now.size / was.size < KEPT_WITHIN, now


def test_kept_figures_are_of_scenarios_and_faults_that_there_are():
    """Without any engine: what the report says belongs to the catalogue of today."""
    known = {(job.family, job.engine, job.profile) for job in JOBS}
    assert {(each.family, each.engine, each.profile) for each in kept.read()} <= known
