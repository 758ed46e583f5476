"""The comparison as one HTML page that needs nothing beside it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import jinja2
from markupsafe import Markup

from reference import lecture
from reference.comparison.verdicts import Row
from reference.engines import facts
from reference.lecture import Statement
from reference.report import agreement, numbers, results_in_words, settings_told
from reference.report.agreement import Matrix
from reference.report.error_split import KINDS, origins
from reference.report.first_screen import findings
from reference.report.formulas import typeset
from reference.report.marks import LEGEND, MARKS, occurring
from reference.report.overview import Overview, not_counted, verdict_line, without_answer
from reference.report.row_text import error_of
from reference.report.sections import Section, recordings
from reference.report.sensitivity import kept_sentence
from reference.report.worst_first import furthest_from_theory, nearest_to_fail
from reference.viewer import page as viewer
from reference.viewer.clip import Clip

WORST = 8
"""How many rows the lists of the worst have."""


def render(
    found: Sequence[Section],
    figures: Mapping[str, Sequence[tuple[str, str]]],
    versions: Sequence[str],
    provenance: str,
    published: str = "",
    replays: Mapping[str, Clip] | None = None,
    pictures: Mapping[str, tuple[str, str]] | None = None,
    unfinished: str = "",
) -> str:
    """Return the page.

    figures: by family, SVG texts with their captions. versions: what was compared, as in the opening sentence.
    provenance: on which machine and with what, as in the last sentence. published: the address of the page of published
    cases, if there is one. replays: by family. pictures: by family, the small SVG of the first screen and its meaning.
    unfinished: what the page says of itself while runs have not ended.
    """
    rows = [row for section in found for line in section.lines for row in line.result.rows]
    told_everywhere = settings_told.everywhere(found)
    return (
        environment()
        .get_template("report.html.j2")
        .render(
            sections=found,
            findings=findings(found),
            pictures={name: (Markup(svg), label) for name, (svg, label) in (pictures or {}).items() if svg},
            overview=Overview.of(found),
            figures=as_markup(figures),
            replays={name: Markup(viewer.fragment(clip)) for name, clip in (replays or {}).items()},
            replay_style=Markup(viewer.style() if replays else ""),
            replay_script=Markup(viewer.script() if replays else ""),
            versions=versions,
            provenance=provenance,
            published=published,
            unfinished=unfinished,
            statements=_statements(found),
            verdict_line=verdict_line(rows),
            not_counted=not_counted(rows),
            without_answer=without_answer(line.result for section in found for line in section.lines),
            marks=MARKS,
            legend={verdict: LEGEND[verdict] for verdict in occurring(rows)},
            recordings=recordings(line.result for section in found for line in section.lines),
            nearest=[(*entry[:3], numbers.percent(entry[3]).lstrip("+")) for entry in nearest_to_fail(found, WORST)],
            furthest=furthest_from_theory(found, WORST),
            origins={section.family.name: origins(section) for section in found},
            kinds=KINDS,
            noticed={section.family.name: kept_sentence(section) for section in found},
            measured=_measured,
            measured_with=facts.MEASURED_WITH,
            error_of=error_of,
            matrices={section.family.name: Matrix.of(section) for section in found},
            relations=agreement.LEGEND,
            relation_marks=agreement.MARKS,
            between=agreement.by_scenario(found),
            pairs_line=agreement.sentence(pair for section in found for pair in section.pairs),
            typeset=typeset,
            told_everywhere=told_everywhere,
            told=settings_told.by_scenario(found, told_everywhere),
            code_typed=settings_told.code_typed,
            accepted=results_in_words.accepted,
            counted=results_in_words.counted,
            plain=results_in_words.plain,
            remarks=results_in_words.remarks,
        )
    )


def as_markup(figures: Mapping[str, Sequence[tuple[str, str]]]) -> dict[str, list[tuple[Markup, str]]]:
    """The same figures with SVG texts that no template escapes, since we have drawn them ourselves."""
    return {name: [(Markup(svg), caption) for svg, caption in pairs] for name, pairs in figures.items()}


def environment() -> jinja2.Environment:
    """The pages' templates, and how they are read."""
    return jinja2.Environment(
        loader=jinja2.PackageLoader("reference.report"),
        autoescape=jinja2.select_autoescape(("html.j2",)),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )


def _statements(found: Sequence[Section]) -> dict[str, tuple[list[Statement], list[Statement]]]:
    """By family, the statements that appear on the page for the first time, and those that appear further up."""
    shown: set[int] = set()
    split = {}
    for section in found:
        own = [lecture.statement(number) for number in section.family.statements]
        new = [entry for entry in own if entry.number not in shown]
        split[section.family.name] = new, [entry for entry in own if entry.number in shown]
        shown.update(section.family.statements)
    return split


def _measured(row: Row) -> str:
    return "" if row.measured is None else numbers.quantity(row.measured, row.unit)
