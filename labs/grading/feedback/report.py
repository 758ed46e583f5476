"""Writes what a student reads about their visible tests: each function right, wrong or to do, and why; 80 columns."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from labs.grading.feedback.error_advice import Advice
from labs.grading.feedback.faults import listed, share, wrong
from labs.grading.judging.score_sheet import Sheet
from labs.grading.phrases import needed_function
from labs.grading.wrapping import folded
from reference import lecture
from reference.lecture import Function

RIGHT, WRONG, TO_DO = "✓", "✗", "·"
HIDDEN = "hidden tests ask the same of other inputs, at limits and of many cases at once"


def report(sheet: Sheet, topics: Sequence[str]) -> Iterator[str]:
    """All lines: first those about the file, then topic by topic, and at the end what to do next."""
    for complaint in sheet.complaints:
        if complaint.kind != "missing":  # missing functions are on the list below
            yield from folded(str(complaint), 0)
    advice = Advice(sheet.given)
    for name in topics:
        yield ""
        yield f"{lecture.topic(name).title} ({name})"
        blocks = [list(_function(sheet, entry, advice)) for entry in tested(sheet, name)]
        for at, block in enumerate(blocks):
            yield from [""] * (at > 0 and max(len(block), len(blocks[at - 1])) > 1)
            yield from block
    yield ""
    for reason, count in sheet.left_out.items():
        yield from folded(f"{count} test{'s' * (count != 1)} left out: {reason}.", 0)
    yield from folded(_next(sheet, [entry for name in topics for entry in tested(sheet, name)]), 0)


def all_right(sheet: Sheet) -> bool:
    """Whether every test passed."""
    return bool(sheet.outcomes) and all(outcome.passed for outcome in sheet.outcomes)


def state(sheet: Sheet, name: str) -> str:
    """`RIGHT`, `WRONG` or `TO_DO` of a function."""
    about = sheet.about(name)
    if about and all(outcome.passed for outcome in about):
        return RIGHT
    diagnosis = sheet.diagnoses.get(name)
    unwritten = bool(diagnosis and diagnosis.verdict == "unwritten")
    return TO_DO if name not in sheet.unread and (unwritten or _waits(sheet, name)) else WRONG


def tested(sheet: Sheet, topic: str) -> list[Function]:
    """The functions of a topic that were tested, and the wrong ones that these call."""
    beneath = {outcome.function for outcome in sheet.beneath}
    about = {outcome.function for outcome in sheet.outcomes} | {name for name in beneath if state(sheet, name) == WRONG}
    return [entry for entry in lecture.functions_of(topic) if entry.name in about]


def _function(sheet: Sheet, entry: Function, advice: Advice) -> Iterator[str]:
    """One function."""
    mark = state(sheet, entry.name)
    if entry.name in sheet.unread:
        yield f"  {mark} {entry.name}  cannot be read, see the first lines"
    elif mark == WRONG:
        yield f"  {mark} {entry.name}{share(sheet, entry.name)}"
        yield from wrong(sheet, entry.name, advice)
    else:
        yield f"  {mark} {entry.name}{_to_do(sheet, entry) if mark == TO_DO else ''}"


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
    faulty = [name for name, mark in states.items() if mark == WRONG]
    to_do = [entry for entry in entries if states[entry.name] == TO_DO]
    right = len(states) - len(faulty) - len(to_do)
    to_do = [entry for entry in to_do if not _waits(sheet, entry.name)]
    if to_do and len(to_do) == len(states):
        return f"{len(to_do)} function{'s' * (len(to_do) != 1)} to write. Begin with {_task(sheet, to_do[0])}"
    partly = sum(bool(share(sheet, name)) for name in faulty)
    counted = f"{right} of {len(states)} functions right" + f", {partly} in part" * bool(partly)
    if faulty:
        return f"{counted}. Next: {_nearest(sheet, faulty)}, marked {WRONG} above."
    if to_do:
        return f"{counted}. Next: write {_task(sheet, to_do[0])}"
    return f"{counted}. {HIDDEN[0].upper()}{HIDDEN[1:]}."


def _nearest(sheet: Sheet, wrong: Sequence[str]) -> str:
    """The first wrong function that uses no other wrong function."""
    return next((name for name in wrong if not set(sheet.uses.get(name, [])) & set(wrong)), wrong[0])


def _task(sheet: Sheet, entry: Function) -> str:
    """What a function is to do, in the words of its tests."""
    outcome = sheet.about(entry.name)[0]
    words = [f"{entry.name} ({entry.topic}, step {entry.step}, slide {entry.statement}).", outcome.rationale]
    return " ".join(word for word in words if word)
