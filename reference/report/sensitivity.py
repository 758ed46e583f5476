"""The smallest faults that verdicts notice, in words: a sentence for each family, a table for each in the terminal."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from rich.console import Console
from rich.table import Table
from rich.text import Text

from reference.catalogue.scenarios import catalogue
from reference.comparison.faults import FAULTS, Fault
from reference.comparison.sensitivity import Finding, Outcome, Sensitivity
from reference.engines.implementation import Implementation
from reference.engines.profiles import WORLD, counts
from reference.errors import listed
from reference.recording import sensitivity as kept
from reference.report import numbers
from reference.report.sections import Line, Section

NO_SIZE = "✓"
ALIKE = 2.0
"""Sizes that differ by less than this factor are told as one."""
_NARROWEST = len("implementation")
"""Width of the first column where many faults have an effect; engine and profile then have a line each."""
_STYLES = {Outcome.NOTICED: "green", Outcome.NOT_NOTICED: "yellow"}


def kept_sentence(section: Section) -> str:
    """What the verdicts that count in a section notice, as the lab has measured it; "" where it has not.

    Where it has measured it of some of the implementations alone, they are named.
    """
    asked = [line for line in section.lines if line.counts]
    found = [(line, of_it) for line in asked if (of_it := _kept_of(line, section.cases))]
    whose = listed([f"{line.name}{f', {WORLD}' * (of_it.profile == WORLD)}" for line, of_it in found])
    return sentence([of_it for _, of_it in found], whose if len(found) < len(asked) else "")


def _kept_of(line: Line, cases: Sequence[str]) -> Sensitivity | None:
    """What was measured of just this line: the lab's own code, in a profile's own settings, in the cases that ran.

    None where no run gave a number: verdicts on nothing notice nothing.
    """
    job = line.result.job
    if all(row.measured is None for row in line.result.rows):
        return None
    functions = line.result.functions
    if job.changes or job.at or (functions and not Implementation(job.implementation).takes_ours(functions)):
        return None
    known = {(each.family, each.engine, each.profile): each for each in kept.read()}
    found = known.get((job.family, job.engine, job.profile))
    own = tuple(each for each in found.findings if not each.case or each.case in cases) if found else ()
    return replace(found, findings=own) if found and own else None


def sentence(found: Sequence[Sensitivity], whose: str = "") -> str:
    """The smallest fault of each kind that a verdict that counts notices in one family, and what they do not notice.

    whose: the implementations, where it is not said of all that stand there.
    """
    tuned = [each for each in found if counts(each.profile)]
    sizes = list(filter(None, (_sizes(tuned, fault) for fault in FAULTS if fault.most)))
    parts = {
        f"The smallest fault that a verdict {f'on {whose}' if whose else 'here'} would notice": sizes,
        "Not noticed": list(filter(None, (_missed(tuned, fault) for fault in FAULTS))),
        "Without effect on any number": [fault.title for fault in FAULTS if _is_idle(tuned, fault)],
    }
    return " ".join(f"{opening}: {', '.join(words)}." for opening, words in parts.items() if words)


def _sizes(found: Sequence[Sensitivity], fault: Fault) -> str:
    """The smallest size of a fault in the most and in the least sensitive implementation; "" where none has any."""
    sizes = {_named(each): finding.size for each in found if (finding := each.finding(fault.name)) and finding.size}
    if not sizes:
        return ""
    best, worst = min(sizes, key=sizes.__getitem__), max(sizes, key=sizes.__getitem__)
    if sizes[worst] < ALIKE * sizes[best]:
        return f"{fault.title} {size_text(fault, sizes[worst])}"
    return f"{fault.title} {size_text(fault, sizes[best])} ({best}) to {size_text(fault, sizes[worst])} ({worst})"


def _named(found: Sensitivity) -> str:
    """The implementation in a sentence; by hand two methods count."""
    return f"{found.title}, {found.profile}" if found.profile == WORLD else found.title


def _missed(found: Sequence[Sensitivity], fault: Fault) -> str:
    """A fault that has an effect and is not noticed, with the implementations; "" where that is so in none."""
    titles = [_named(each) for each in found if _outcome(each, fault) is Outcome.NOT_NOTICED]
    up_to = f" up to {size_text(fault, fault.most)}" if fault.most else ""
    return f"{fault.title}{up_to} ({', '.join(titles)})" if titles else ""


def _is_idle(found: Sequence[Sensitivity], fault: Fault) -> bool:
    outcomes = {_outcome(each, fault) for each in found}
    return Outcome.NO_EFFECT in outcomes and outcomes <= {Outcome.NO_EFFECT, Outcome.NOT_TRIED, None}


def _outcome(found: Sensitivity, fault: Fault) -> Outcome | None:
    finding = found.finding(fault.name)
    return finding.outcome if finding else None


def size_text(fault: Fault, size: float) -> str:
    """The size of a fault with its unit: `2.1·10⁻⁷ %`, `0.5°`."""
    if fault.unit == "%":
        return f"{numbers.digits(100 * size, 2)} %"
    return f"{numbers.digits(size, 2)}{fault.unit}"


def print_sensitivity(console: Console, found: Iterable[Sensitivity], notes: Iterable[str] = ()) -> None:
    """Print a table for each family, implementation × fault, each with the sentence that sums it up, and the notes."""
    found = list(found)
    for family in catalogue().values():
        own = [each for each in found if each.family == family.name]
        if own:
            console.print()
            console.print(Text(family.title, style="bold"))
            console.print(_table(own))
            console.print(Text(sentence(own)))
    for note in dict.fromkeys(notes):
        console.print(Text(note, style="dim"))


def _table(found: Sequence[Sensitivity]) -> Table:
    """A line for each implementation, a column for each fault that has an effect in one of them."""
    faults = [fault for fault in FAULTS if any(_has_effect(each.finding(fault.name)) for each in found)]
    table = Table(box=None, header_style="bold", padding=(0, 1, 0, 0), pad_edge=False)
    table.add_column("\nimplementation", min_width=_NARROWEST)
    for fault in faults:
        table.add_column(f"{fault.name}\n{fault.unit}")
    for each in found:
        cells = [_cell(fault, each.finding(fault.name)) for fault in faults]
        table.add_row(Text(f"{each.title}, {each.profile}", style="bold" if counts(each.profile) else ""), *cells)
    return table


def _has_effect(finding: Finding | None) -> bool:
    return finding is not None and finding.outcome in (Outcome.NOTICED, Outcome.NOT_NOTICED)


def _cell(fault: Fault, finding: Finding | None) -> Text:
    """The size without its unit, and below it the quantity whose verdict turns red."""
    if finding is None or finding.outcome is Outcome.NOT_TRIED:
        return Text("–", style="dim")
    if finding.outcome is not Outcome.NOTICED:
        return Text(str(finding.outcome), style=_STYLES.get(finding.outcome, "dim"))
    size = NO_SIZE if finding.size is None else size_text(fault, finding.size).removesuffix(fault.unit).strip()
    return Text(f"{size}\n{finding.quantity.replace('_', ' ')}", style=_STYLES[Outcome.NOTICED])
