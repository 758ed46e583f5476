"""The replay of a demonstration as a page: the question, what happened in every implementation, and the lesson."""

from __future__ import annotations

from labs.demonstrations.outcomes import Seen
from reference.catalogue.scenarios import catalogue
from reference.report.replays import case_clip
from reference.report.summary import recordings
from reference.viewer import page
from reference.viewer.clip import Clip


def page_of(seen: Seen) -> str:
    """The page, which needs nothing beside it; empty where no implementation gave poses."""
    asked, clips = seen.demonstration, clips_of(seen)
    notes = recordings(line.result for line in seen.section.lines)
    return page.html(clips, asked.title, (asked.question, asked.look), (*seen.lesson(), *notes)) if clips else ""


def clips_of(seen: Seen) -> list[Clip]:
    """A clip for each case, or each timestep, that is asked for; those alone that somebody gave poses of."""
    asked, found = seen.demonstration, []
    family = catalogue()[asked.family]
    for label, name in asked.cases.items():
        for called, timestep in asked.timesteps.items() or [(label, None)]:
            lines = [line for line in seen.section.lines if dict(line.result.job.changes).get("timestep") == timestep]
            found.append(case_clip(family.case(name), lines, f"{asked.title}, {called}", asked.profiles))
    return [clip for clip in found if clip is not None]
