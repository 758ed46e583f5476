"""The replay of a demonstration as a page: the question, what happened in every implementation, and the lesson."""

from __future__ import annotations

from labs.demonstrations.outcomes import Outcome
from reference.catalogue.scenarios import catalogue
from reference.report.replays import case_clip
from reference.report.sections import recordings
from reference.viewer import page
from reference.viewer.clip import Clip


def page_of(outcome: Outcome) -> str:
    """The page, which needs no other files; empty if no implementation gave poses."""
    asked, clips = outcome.demonstration, clips_of(outcome)
    notes = recordings(line.result for line in outcome.section.lines)
    return page.html(clips, asked.title, (asked.question, asked.look), (*outcome.lesson(), *notes)) if clips else ""


def clips_of(outcome: Outcome) -> list[Clip]:
    """A clip for each case or timestep of the demonstration, if an implementation gave poses of it."""
    asked, found = outcome.demonstration, []
    family = catalogue()[asked.family]
    for label, name in asked.cases.items():
        for called, timestep in asked.timesteps.items() or [(label, None)]:
            lines = [
                line for line in outcome.section.lines if dict(line.result.job.changes).get("timestep") == timestep
            ]
            found.append(case_clip(family.case(name), lines, f"{asked.title}, {called}"))
    return [clip for clip in found if clip is not None]
