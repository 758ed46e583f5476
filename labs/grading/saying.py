"""What a student reads of their visible tests: each function right, wrong or to do, and why; 80 columns."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence
from dataclasses import replace

from labs.grading.diagnosis import Diagnosis
from labs.grading.sheet import Outcome, Sheet
from labs.grading.telling import WIDTH
from reference import lecture
from reference.lecture import Function

RIGHT, WRONG, TO_DO = "✓", "✗", "·"
MOST_PARTS = 2
"""Parts of a function that are told with what was tried, one where the mistake has a name; of more, the title alone."""
_INDENT = " " * 4


def report(sheet: Sheet, topics: Sequence[str]) -> Iterator[str]:
    """All lines, those of the file first, then topic by topic, and in the end what to do next."""
    for complaint in sheet.complaints:
        if not complaint.endswith("missing"):  # what is missing is on the list below
            yield from _wrapped(complaint, "")
    for name in topics:
        functions = _tested(sheet, name)
        yield ""
        yield f"{lecture.topic(name).title} ({name})"
        for entry in functions:
            yield from _function(sheet, entry)
    yield ""
    yield from _wrapped(_next(sheet, [entry for name in topics for entry in _tested(sheet, name)]), "")


def all_right(sheet: Sheet) -> bool:
    """Whether every test passed."""
    return all(outcome.passed for outcome in sheet.outcomes)


def state(sheet: Sheet, name: str) -> str:
    """`RIGHT`, `WRONG` or `TO_DO` of a function."""
    if all(outcome.passed for outcome in sheet.outcomes if outcome.function == name):
        return RIGHT
    diagnosis = sheet.diagnoses.get(name)
    return TO_DO if diagnosis and diagnosis.verdict == "unwritten" else WRONG


def _tested(sheet: Sheet, topic: str) -> list[Function]:
    about = {outcome.function for outcome in sheet.outcomes}
    return [entry for entry in lecture.functions_of(topic) if entry.name in about]


def _function(sheet: Sheet, entry: Function) -> Iterator[str]:
    mark = state(sheet, entry.name)
    yield f"  {mark} {entry.name}" + ("  to do" if mark == TO_DO else "")
    if mark != WRONG:
        return
    lost = [outcome for outcome in sheet.outcomes if outcome.function == entry.name and not outcome.passed]
    failures = [failure for outcome in lost for failure in _failures(outcome)]
    diagnosis = sheet.diagnoses.get(entry.name)
    named = bool(diagnosis and diagnosis.mistakes)
    for number, (reason, said) in enumerate(failures):
        yield from _wrapped(f"Not so: {reason}", _INDENT)
        if number < (1 if named else MOST_PARTS):
            for line in said.splitlines():
                yield from _wrapped(line, _INDENT * 2)
    if diagnosis:
        yield from _diagnosis(diagnosis, any(said for _, said in failures))
    if not named:
        helps = dict.fromkeys(outcome.help for outcome in lost if outcome.help)
        yield from (line for help in helps for line in _wrapped(f"Look at: {help}", _INDENT))


def _failures(outcome: Outcome) -> list[tuple[str, str]]:
    """What was lost, and what was said of it; equal words are said once."""
    found: list[tuple[str, str]] = []
    for part in outcome.parts:
        if not part.passed:
            found.append((part.reason, "" if any(part.said == said for _, said in found) else part.said))
    return found or [(outcome.title, outcome.said)]


def _diagnosis(diagnosis: Diagnosis, has_example: bool) -> Iterator[str]:
    """What is known of the mistake, with the smallest example where the tests have shown none."""
    if diagnosis.right:
        return
    shown = replace(diagnosis, accepted=(), counterexample=None if has_example else diagnosis.counterexample)
    told = str(shown).removeprefix(f"{diagnosis.function}: ")
    if diagnosis.verdict != "named":  # a mistake's own text may begin with a symbol, such as e
        told = told[:1].upper() + told[1:]
    for paragraph in _paragraphs(told):
        yield from _wrapped(paragraph, _INDENT)


def _paragraphs(told: str) -> list[str]:
    """Lines that were wrapped for the full width, put together again; an example keeps its own."""
    found: list[str] = []
    for line in told.splitlines():
        begins = line.startswith((" ", "Hint:", "For example", "- ", "It ", "With several", "On some"))
        if found and not begins and not found[-1].startswith((" ", "For example")):
            found[-1] += f" {line}"
        else:
            found.append(line)
    return found


def _next(sheet: Sheet, entries: Sequence[Function]) -> str:
    states = {entry.name: state(sheet, entry.name) for entry in entries}
    wrong = [name for name, mark in states.items() if mark == WRONG]
    to_do = [entry for entry in entries if states[entry.name] == TO_DO]
    right = len(states) - len(wrong) - len(to_do)
    counted = f"{right} of {len(states)} functions right"
    if wrong:
        return f"{counted}. Next: {wrong[0]}, marked {WRONG} above."
    if to_do:
        return f"{counted}. Next: write {to_do[0].name} ({to_do[0].topic}, step {to_do[0].step})."
    return f"{counted}. Hidden tests ask the same of other inputs."


def _wrapped(text: str, indent: str) -> list[str]:
    lead = " " * (len(text) - len(text.lstrip()))
    return textwrap.wrap(
        text.strip(),
        WIDTH,
        initial_indent=indent + lead,
        subsequent_indent=indent + lead + "  ",
        break_on_hyphens=False,
    )
