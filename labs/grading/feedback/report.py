"""Writes what a student reads about their visible tests: each function right, wrong or to do, and why; 80 columns."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from labs.grading.diagnosis.words import listed
from labs.grading.feedback.error_advice import Advice
from labs.grading.feedback.faults import share, suspect, wrong
from labs.grading.feedback.one_at_a_time import in_short
from labs.grading.feedback.tries import Tries
from labs.grading.judging.score_sheet import Sheet
from labs.grading.phrases import needed_function
from labs.grading.submission.cells import place
from labs.grading.wrapping import folded
from reference import lecture
from reference.lecture import Function

RIGHT, WRONG, TO_DO, SUSPECT = "✓", "✗", "·", "?"
HIDDEN = "hidden tests ask the same of other inputs, at limits and of many cases at once"


def report(sheet: Sheet, topics: Sequence[str], tries: Tries | None = None) -> Iterator[str]:
    """All lines: first those about the file, then topic by topic, and at the end what to do next.

    tries: so many were made at each function, and so much help is shown; all help if there is none.
    """
    for complaint in sheet.complaints:
        if complaint.kind != "missing":  # missing functions are on the list below
            yield from folded(str(complaint), 0)
    advice = Advice(sheet.given)
    for name in topics:
        yield ""
        yield f"{lecture.topic(name).title} ({name})"
        entries = tested(sheet, name)
        blocks = [list(_function(sheet, entry, advice, tries)) for entry in entries if entry.name not in sheet.unread]
        if unread := [entry.name for entry in entries if entry.name in sheet.unread]:
            blocks.insert(0, list(folded(f"  {WRONG} {listed(unread)}  cannot be read, see the first lines", 0)))
        for at, block in enumerate(blocks):
            yield from [""] * (at > 0 and max(len(block), len(blocks[at - 1])) > 1)
            yield from block
    yield ""
    for reason, count in sheet.left_out.items():
        yield from folded(f"{count} test{'s' * (count != 1)} left out: {reason}.", 0)
    yield from folded(_next(sheet, [entry for name in topics for entry in tested(sheet, name)]), 0)


def all_right(sheet: Sheet) -> bool:
    """Whether there were tests, every one of them passed, and no function is suspect."""
    return bool(sheet.outcomes) and all(outcome.passed for outcome in sheet.outcomes) and not sheet.suspects


def state(sheet: Sheet, name: str) -> str:
    """`RIGHT`, `WRONG`, `TO_DO` or `SUSPECT` of a function."""
    about = sheet.about(name)
    if about and all(outcome.passed for outcome in about):
        return SUSPECT if name in sheet.suspects else RIGHT
    diagnosis = sheet.diagnoses.get(name)
    unwritten = bool(diagnosis and diagnosis.verdict == "unwritten")
    return TO_DO if name not in sheet.unread and (unwritten or _waits(sheet, name)) else WRONG


def tested(sheet: Sheet, topic: str) -> list[Function]:
    """The functions of a topic that were tested, and the wrong or suspect ones that these call."""
    beneath = {outcome.function for outcome in sheet.beneath if state(sheet, outcome.function) in (WRONG, SUSPECT)}
    about = {outcome.function for outcome in sheet.outcomes} | beneath
    return [entry for entry in lecture.functions_of(topic) if entry.name in about]


def _function(sheet: Sheet, entry: Function, advice: Advice, tries: Tries | None) -> Iterator[str]:
    """One function."""
    mark, name = state(sheet, entry.name), entry.name
    count = tries.count(name) if tries else 0
    tried = f" try {count}" if count else ""
    if mark == SUSPECT:
        yield f"  {mark} {name}  suspect{',' * bool(tried)}{tried}"
        yield from suspect(name, sheet.suspects[name], advice, tries.levels(name) if tries else None)
    elif mark == WRONG:
        some = share(sheet, name)
        yield f"  {mark} {name}{some}{',' if some and tried else ' ' * bool(tried)}{tried}"
        yield from wrong(sheet, name, advice, tries.levels(name) if tries else None)
    elif mark == TO_DO:
        yield f"  {mark} {name}{_to_do(sheet, entry)}"
    else:
        yield f"  {mark} {name}{f'  at try {count + 1}' if count else ''}{in_short(sheet, name)}"


def _to_do(sheet: Sheet, entry: Function) -> str:
    if waits := _waits(sheet, entry.name):
        return f"{share(sheet, entry.name)}  waits for {listed(waits)}"
    return f"  to do, slide {entry.statement}"


def _waits(sheet: Sheet, name: str) -> list[str]:
    """Other functions that are not written yet, if nothing else keeps this one from being right."""
    said = [said for outcome in sheet.about(name) for _, said in outcome.failures if said]
    needed = [needed_function(words) or name for words in said]
    return [] if name in needed else list(dict.fromkeys(needed))


def _next(sheet: Sheet, entries: Sequence[Function]) -> str:
    """How many functions are right, and what to do next."""
    states = {entry.name: state(sheet, entry.name) for entry in entries}
    faulty = [name for name, mark in states.items() if mark in (WRONG, SUSPECT)]
    to_do = [entry for entry in entries if states[entry.name] == TO_DO]
    right = len(states) - len(faulty) - len(to_do)
    to_do = [entry for entry in to_do if not _waits(sheet, entry.name)]
    if to_do and len(to_do) == len(states):
        return f"{len(to_do)} function{'s' * (len(to_do) != 1)} to write. Begin with {_task(sheet, to_do[0])}"
    suspected = sum(name in sheet.suspects for name in faulty)
    partly = sum(bool(share(sheet, name)) for name in faulty) - suspected
    counted = f"{right} of {len(states)} functions right" + f", {partly} in part" * bool(partly)
    counted += f", {suspected} suspect" * bool(suspected)
    if broken := [name for name in faulty if name in sheet.unread]:
        return f"{counted}. Next: {_to_mend(sheet) or broken[0]}, so that it can be read."
    if faulty:
        return f"{counted}. Next: {(first := _nearest(sheet, faulty))}, marked {states[first]} above."
    if to_do:
        return f"{counted}. Next: write {_task(sheet, to_do[0])}"
    return f"{counted}. {HIDDEN[0].upper()}{HIDDEN[1:]}."


def _to_mend(sheet: Sheet) -> str:
    """The first place that Python cannot read; empty if none is known."""
    places = (place(each.cell, each.line) for each in sheet.complaints if each.kind == "unreadable")
    return next((f"mend {found}" for found in places if found), "")


def _nearest(sheet: Sheet, wrong: Sequence[str]) -> str:
    """The first wrong function that uses no other wrong function."""
    return next((name for name in wrong if not set(sheet.wrong_uses(name)) & set(wrong)), wrong[0])


def _task(sheet: Sheet, entry: Function) -> str:
    """What a function is to do, in the words of its tests."""
    outcome = sheet.about(entry.name)[0]
    words = [f"{entry.name} ({entry.topic}, step {entry.step}, slide {entry.statement}).", outcome.rationale]
    return " ".join(word for word in words if word)
