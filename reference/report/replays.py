"""Replays of a comparison: one case in all implementations that gave its poses, run here or recorded elsewhere."""

from __future__ import annotations

from collections.abc import Iterable

from reference.catalogue.case import Case
from reference.comparison.results import JobResult
from reference.comparison.verdicts import Verdict
from reference.recording.entries import case_of
from reference.report.sections import Line, Section
from reference.viewer.clip import Clip
from reference.viewer.clip_making import clip
from reference.viewer.poses import Poses
from reference.viewer.tracks import Track, unpack


def replay_of(section: Section) -> Clip | None:
    """The plotted case of a family; None where no implementation gave poses of it.

    It shows what counts, and beside it what an engine does as installed, or hand-written code at the step, where that
    is not as its method must be.
    """
    family = section.family
    case = family.case(family.curve.case)
    told = [line for line in section.lines if line.counts or (line.plain and _failed(line, case))]
    return case_clip(case, told, f"{family.title}: {case.name}", all_shown=True)


def _failed(line: Line, case: Case) -> bool:
    return any(row.verdict is Verdict.FAIL for row in line.result.rows if row.case == case.name)


def case_clip(case: Case, lines: Iterable[Line], title: str, all_shown: bool = False) -> Clip | None:
    """One case in these implementations, the first of them drawn solid.

    all_shown: whether profiles that do not count are to be seen at first as well. Of two that count, as by hand, the
    second is not.
    """
    found: dict[str, Poses] = {}
    hidden = set()
    for line in lines:
        track = _track(line.result, case)
        if track is not None:
            engine, profile = line.result.job.engine, line.result.job.profile
            first = line.counts and engine not in found
            name = engine if first else f"{engine} {profile}"
            called = line.result.title if first else line.title
            found[name] = unpack(track, called, line.result.recording)
            hidden |= set() if first or (all_shown and not line.counts) else {name}
    return clip(case.scenarios[0], found, title, hidden) if found else None


def _track(result: JobResult, case: Case) -> Track | None:
    """A result's poses of a case, with any settings."""
    return next((track for track in result.poses if case_of(track.key) == case.name), None)
