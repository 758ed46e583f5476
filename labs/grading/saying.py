"""What a student reads of their visible tests: each function right, wrong or to do, and why; 80 columns."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace

from labs.grading.advice import advice
from labs.grading.diagnosis import Diagnosis
from labs.grading.folding import folded
from labs.grading.sheet import Outcome, Sheet
from labs.grading.telling import besides, verdict
from reference import lecture
from reference.lecture import Function

RIGHT, WRONG, TO_DO = "✓", "✗", "·"
HIDDEN = "hidden tests ask the same of other inputs, at limits and of many contacts at once"
MOST_PARTS = 2
"""Parts of a function that are told with what was tried; one where the mistake has a name, or lies elsewhere first."""
_SAID_BY_THE_EXAMPLE = ("crashes", "shape", "unknown", "too slow")
"""Verdicts that say no more than what was tried and what came."""
_NOT_PHYSICS = ("crashes", "one at a time")
"""Verdicts on which a hint about the slide does not bear."""

_NEEDS = re.compile(r"\bneeds (\w+) \(")  # as it is said of a function that is not there


def report(sheet: Sheet, topics: Sequence[str]) -> Iterator[str]:
    """All lines, those of the file first, then topic by topic, and in the end what to do next."""
    for complaint in sheet.complaints:
        if not complaint.endswith("missing"):  # what is missing is on the list below
            yield from folded(complaint, 0)
    given: set[str] = set()
    for name in topics:
        yield ""
        yield f"{lecture.topic(name).title} ({name})"
        blocks = [list(_function(sheet, entry, given)) for entry in tested(sheet, name)]
        for at, block in enumerate(blocks):
            yield from [""] * (at > 0 and max(len(block), len(blocks[at - 1])) > 1)
            yield from block
    yield ""
    for reason, count in sheet.left_out.items():
        yield from folded(f"{count} test{'s' * (count != 1)} left out: {reason}.", 0)
    yield from folded(_next(sheet, [entry for name in topics for entry in tested(sheet, name)]), 0)


def all_right(sheet: Sheet) -> bool:
    """Whether every test passed."""
    return all(outcome.passed for outcome in sheet.outcomes)


def state(sheet: Sheet, name: str) -> str:
    """`RIGHT`, `WRONG` or `TO_DO` of a function."""
    if all(outcome.passed for outcome in sheet.outcomes if outcome.function == name):
        return RIGHT
    diagnosis = sheet.diagnoses.get(name)
    unwritten = bool(diagnosis and diagnosis.verdict == "unwritten")
    return TO_DO if name not in sheet.unread and (unwritten or _waits(sheet, name)) else WRONG


def tested(sheet: Sheet, topic: str) -> list[Function]:
    """The functions of a topic that a test asked for."""
    about = {outcome.function for outcome in sheet.outcomes}
    return [entry for entry in lecture.functions_of(topic) if entry.name in about]


def _function(sheet: Sheet, entry: Function, given: set[str]) -> Iterator[str]:
    """One function. given: the advice that was given already, which is not repeated."""
    mark = state(sheet, entry.name)
    if entry.name in sheet.unread:
        yield f"  {mark} {entry.name}  cannot be read, see the first lines"
    elif mark == WRONG:
        yield f"  {mark} {entry.name}{_share(sheet, entry.name)}"
        yield from _wrong(sheet, entry.name, given)
    else:
        yield f"  {mark} {entry.name}{_to_do(sheet, entry) if mark == TO_DO else ''}"


def _share(sheet: Sheet, name: str) -> str:
    """How much of a wrong function is right, to go on from."""
    parts = [part.passed for outcome in _about(sheet, name) for part in outcome.parts]
    return f"  {sum(parts)} of {len(parts)} parts right" if any(parts) else ""


def _to_do(sheet: Sheet, entry: Function) -> str:
    if waits := _waits(sheet, entry.name):
        return f"{_share(sheet, entry.name)}  waits for {_listed(waits)}"
    return f"  to do, slide {entry.statement}"


def _waits(sheet: Sheet, name: str) -> list[str]:
    """Other functions that are not written yet, where nothing else keeps this one from being right."""
    said = [said for outcome in _about(sheet, name) for _, said in outcome.failures if said]
    needed = [found[1] if (found := _NEEDS.search(words)) else name for words in said]
    return [] if name in needed else list(dict.fromkeys(needed))


def _about(sheet: Sheet, name: str) -> list[Outcome]:
    return [outcome for outcome in sheet.outcomes if outcome.function == name]


def _wrong(sheet: Sheet, name: str, given: set[str]) -> Iterator[str]:
    """What to mend first, what was tried and came, what is known of it, what to look at, and what else is not so."""
    lost = [outcome for outcome in _about(sheet, name) if not outcome.passed]
    failures = [(reason, _own(said, name)) for outcome in lost for reason, said in outcome.failures]
    diagnosis = sheet.diagnoses.get(name)
    named = bool(diagnosis and diagnosis.mistakes)
    uses = [each for each in sheet.uses.get(name, []) if each in sheet.diagnoses]
    told = _told(failures, 1 if named or uses else MOST_PARTS)
    if uses:
        verb = "is" if len(uses) == 1 else "are"
        yield from folded(f"It uses {_listed(uses)}, which {verb} not right yet: begin there.", 1)
    for reason, said in told:
        yield from folded(f"Not yet: {reason}", 1)
        yield from _indented(said, given)
    if diagnosis and not diagnosis.right:
        yield from _diagnosed(diagnosis, [said for _, said in told], given)
    if not named and not (diagnosis and diagnosis.verdict in _NOT_PHYSICS):
        helps = dict.fromkeys(outcome.help for outcome in lost if outcome.help)
        yield from (line for help in helps for line in folded(f"Hint: {help}", 1))
    others = [reason for reason, _ in failures if reason not in [reason for reason, _ in told]]
    if others:
        yield from folded(f"{'Not yet either' if told else 'Not yet'}: {'; '.join(others)}", 1)


def _told(failures: Sequence[tuple[str, str]], most: int) -> list[tuple[str, str]]:
    """The parts that are told with what was tried, no two of which say the same."""
    first = {said: (reason, said) for reason, said in reversed(failures) if said}
    return [failure for failure in failures if failure in first.values()][:most]


def _own(said: str, name: str) -> str:
    """What was said of a function, below its name."""
    return "\n".join(line.removeprefix(f"{name} ") for line in said.splitlines())


def _indented(said: str, given: set[str]) -> Iterator[str]:
    """What was tried and what came of it, with advice that was not given yet."""
    for line in said.splitlines():
        yield from folded(line, 2)
    yield from _advised(said, given)


def _advised(said: str, given: set[str]) -> Iterator[str]:
    if (words := advice(said)) and words not in given:
        given.add(words)
        yield from folded(f"→ {words}", 2)


def _diagnosed(diagnosis: Diagnosis, told: Sequence[str], given: set[str]) -> Iterator[str]:
    """What is known of the mistake: no example and no error where the tests have shown one already."""
    example, compared = diagnosis.counterexample, any("\nphysics " in said for said in told)
    if not (told and diagnosis.verdict in _SAID_BY_THE_EXAMPLE):
        first, *others = verdict(diagnosis)
        if diagnosis.verdict != "named":  # a mistake's own text may begin with a symbol, such as e
            first = first[:1].upper() + first[1:]
        yield from (line for paragraph in (first, *others) for line in folded(paragraph, 1))
    in_many = diagnosis.verdict == "one at a time" or (example and example.answer.error)
    if example and not compared and not (told and in_many):
        yield from folded("For example", 1)
        yield from _indented(str(example), given)
    shown = any(said.startswith(("raised ", "needs ", "gave ")) for said in told)
    rest = replace(diagnosis, accepted=(), crashes=() if shown else diagnosis.crashes)
    for paragraph in besides(rest):
        yield from folded(paragraph.replace(f"error: {diagnosis.function} raised ", "error: "), 1)
        yield from _advised(paragraph, given)


def _next(sheet: Sheet, entries: Sequence[Function]) -> str:
    """How far it is, and what comes next."""
    states = {entry.name: state(sheet, entry.name) for entry in entries}
    wrong = [name for name, mark in states.items() if mark == WRONG]
    to_do = [entry for entry in entries if states[entry.name] == TO_DO]
    right = len(states) - len(wrong) - len(to_do)
    to_do = [entry for entry in to_do if not _waits(sheet, entry.name)]
    if to_do and len(to_do) == len(states):
        return f"{len(to_do)} function{'s' * (len(to_do) != 1)} to write. Begin with {_task(sheet, to_do[0])}"
    partly = sum(bool(_share(sheet, name)) for name in wrong)
    counted = f"{right} of {len(states)} functions right" + f", {partly} in part" * bool(partly)
    if wrong:
        return f"{counted}. Next: {_nearest(sheet, wrong)}, marked {WRONG} above."
    if to_do:
        return f"{counted}. Next: write {_task(sheet, to_do[0])}"
    return f"{counted}. {HIDDEN[0].upper()}{HIDDEN[1:]}."


def _nearest(sheet: Sheet, wrong: Sequence[str]) -> str:
    """The first one that uses no other wrong one."""
    return next((name for name in wrong if not set(sheet.uses.get(name, [])) & set(wrong)), wrong[0])


def _task(sheet: Sheet, entry: Function) -> str:
    """What a function is to do, in the words of its tests."""
    outcome = _about(sheet, entry.name)[0]
    words = [f"{entry.name} ({entry.topic}, step {entry.step}, slide {entry.statement}).", outcome.rationale]
    return " ".join(word for word in words if word)


def _listed(names: Sequence[str]) -> str:
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)
