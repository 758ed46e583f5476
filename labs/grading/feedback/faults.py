"""Writes what a student reads about one wrong function: what to mend first, what was tried, and what is known of it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from labs.grading.diagnosis.findings import Counterexample, Diagnosis
from labs.grading.diagnosis.words import ODD, besides, example_of, listed, verdict
from labs.grading.feedback.error_advice import Advice
from labs.grading.feedback.one_at_a_time import explained
from labs.grading.judging.blame import certain, elsewhere, failures_of, misleads, without_answers
from labs.grading.judging.score_sheet import Sheet
from labs.grading.phrases import (
    ended_without_numbers,
    has_answer,
    has_no_number,
    has_physics,
    no_answer_in,
    scenario_needs_a_function,
)
from labs.grading.wrapping import folded

MOST_PARTS = 2
"""So many parts are reported with what was tried; only one if the mistake has a name, or lies elsewhere first."""
_SAID_BY_THE_EXAMPLE = ("crashes", "shape", "unknown", "too slow", "wrong", "not tried")
"""Verdicts that say no more than the call and its answer do."""
_NOT_PHYSICS = ("crashes", "shape", "too slow", "not tried", "one at a time", "another order")
"""Verdicts that a hint about the slide does not help with."""
Told = Sequence[tuple[str, str]]
"""Parts, each with what was tried and the answer."""
HINT, EXPLANATION = "hint", "explanation"
"""Levels of help besides what was tried: where to look, and then what the mistake is."""
_NEXT = {
    HINT: 'A hint on your code comes with your next try; lab.hint("{}") helps before that.',
    EXPLANATION: 'What is wrong is said with your next try; lab.hint("{}") helps before that.',
}


def share(sheet: Sheet, name: str) -> str:
    """How much of a wrong function is right already."""
    parts = [part.passed for outcome in sheet.about(name) for part in outcome.parts]
    return f"  {sum(parts)} of {len(parts)} parts right" if any(parts) else ""


def wrong(sheet: Sheet, name: str, advice: Advice, levels: int | None = None) -> Iterator[str]:
    """What to mend first, what was tried, the answer, what is known of the mistake, a hint, and other lost parts.

    levels: how many levels of help are shown, as far as there are so many; all if it is not given.
    """
    uses = sheet.wrong_uses(name)
    in_runs = elsewhere(sheet, name, uses)
    failures = [(reason, said) for reason, said in failures_of(sheet, name) if reason not in in_runs]
    diagnosis, told = _certain(sheet, name, uses, failures)
    bears = _hint_bears(diagnosis, bool(uses) or not failures, told, advice)
    helps = dict.fromkeys(each.help for each in sheet.about(name) if bears and each.help and not each.passed)
    every = _levels(diagnosis, bool(helps))
    shown = every[:levels]
    yield from _first(sheet, name, uses)
    for reason, said in told:
        yield from folded(f"Not yet: {reason}", 1)
        yield from _indented(said, advice, bool(diagnosis and diagnosis.verdict == "named"))
    if diagnosis and not diagnosis.right:
        yield from _diagnosed(diagnosis, [said for _, said in told], advice, shown)
    yield from explained(sheet, name, advice)
    for reason, others in in_runs.items():
        yield from folded(f"Not yet: {reason}", 1)
        which = "which is not right yet" if len(others) == 1 else "which are not right yet"
        yield from folded(f"This run also calls your {listed(others)}, {which}: look there first.", 2)
    if HINT in shown:
        yield from (line for help in helps for line in folded(f"Hint: {help}", 1))
    others = [reason for reason, _ in failures if reason not in [reason for reason, _ in told]]
    if others:
        yield from folded(f"{'Not yet either' if told else 'Not yet'}: {'; '.join(others)}", 1)
    yield from _next_level(name, every, levels)


def _levels(diagnosis: Diagnosis | None, has_help: bool) -> list[str]:
    """The levels of help that there are for a function, in their order. has_help: whether its tests have a hint."""
    explained = bool(diagnosis and diagnosis.mistakes)
    hints = has_help or (diagnosis and any(map(_is_hint, verdict(diagnosis))))
    return [HINT] * bool(hints) + [EXPLANATION] * explained


def _is_hint(paragraph: str) -> bool:
    return paragraph.startswith("Hint: ")


def _certain(sheet: Sheet, name: str, uses: Sequence[str], failures: Told) -> tuple[Diagnosis | None, Told]:
    """What is certain of its own mistakes, and which of its parts to report. uses: wrong functions that it calls."""
    diagnosis = certain(sheet, name, uses)
    if any(misleads(sheet, other, name) for other in uses):
        return None, _told(without_answers(sheet, name, uses, failures), 1)
    return diagnosis, _told(failures, 1 if uses or _says_all(diagnosis) else MOST_PARTS)


def _says_all(diagnosis: Diagnosis | None) -> bool:
    """Whether what is known of the mistake explains all parts that are lost."""
    return bool(diagnosis and (diagnosis.mistakes or diagnosis.verdict == "another order"))


def suspect(name: str, diagnosis: Diagnosis, advice: Advice, levels: int | None = None) -> Iterator[str]:
    """What open probes show of a function that passes its tests. levels: as for `wrong`."""
    every = _levels(diagnosis, has_help=False)
    wrong = "too slow" if diagnosis.verdict == "too slow" else "wrong"
    rest = "" if diagnosis.verdict == "right" else f", and is {wrong} on other input all the same"
    yield from folded(f"It passes these tests{rest}.", 1)
    yield from _diagnosed(diagnosis, (), advice, every[:levels])
    yield from _next_level(name, every, levels)


def _next_level(name: str, every: Sequence[str], levels: int | None) -> Iterator[str]:
    """How to see the next level of help, if one is held back."""
    if levels is not None and levels < len(every):
        yield from folded(_NEXT[every[levels]].format(name), 1)


def _first(sheet: Sheet, name: str, uses: Sequence[str]) -> Iterator[str]:
    """What lies outside the function: functions to mend before it, and variables that it takes from other cells."""
    slow = [other for other in uses if (found := sheet.diagnosis(other)) and found.verdict == "too slow"]
    if slow:
        what = "that" if len(slow) == 1 else "them"
        yield from folded(f"It calls your {listed(slow)}, which gave no answer in time: mend {what} first.", 1)
    elif suspected := [other for other in uses if other in sheet.suspects]:
        which = "which passes its tests but is" if len(suspected) == 1 else "which pass their tests but are"
        yield from folded(f"It calls your {listed(suspected)}, {which} suspect: look there first.", 1)
    elif len(uses) == 1:
        yield from folded(f"It calls your {uses[0]}, which is not right yet: mend that first.", 1)
    elif uses:
        yield from folded(f"It calls your {listed(uses)}, which are not right yet: mend them first.", 1)
    for variable, cell in sheet.borrows.get(name, {}).items():
        if variable not in sheet.given:
            yield from folded(f"It takes {variable} from {cell}, not from its arguments: is that meant?", 1)


def _told(failures: Told, most: int) -> Told:
    """The parts to report with what was tried; no two of them say the same."""
    first = {_gist(said): (reason, said) for reason, said in reversed(failures) if said}
    told = [failure for failure in failures if failure in first.values()]
    told = [(reason, said) for reason, said in told if not scenario_needs_a_function(said)] or told
    return told[: 1 if told and no_answer_in(told[0][1]) else most]


def _gist(said: str) -> str:
    """What a failure says. If there was no answer at all, the example does not matter."""
    return no_answer_in(said) or said


def _hint_bears(diagnosis: Diagnosis | None, elsewhere: bool, told: Told, advice: Advice) -> bool:
    """Whether the test's own hint, on the physics, helps with the mistake, and nothing else does."""
    if elsewhere or (told and all(no_answer_in(said) or advice.known(said) for _, said in told)):
        return False
    return not diagnosis or not (diagnosis.mistakes or diagnosis.limits_alone or diagnosis.verdict in _NOT_PHYSICS)


def _indented(said: str, advice: Advice, named: bool = False) -> Iterator[str]:
    """What was tried and the answer, with advice that was not given yet. named: whether a mistake's text says more."""
    for line in said.splitlines():
        yield from folded(line, 2)
    if not named or not has_answer(said):
        yield from _advised(said, advice)


def _advised(said: str, advice: Advice) -> Iterator[str]:
    if words := advice.new(said):
        yield from folded(f"→ {words}", 2)


def _diagnosed(
    diagnosis: Diagnosis, told: Sequence[str], advice: Advice, shown: Sequence[str] = (HINT, EXPLANATION)
) -> Iterator[str]:
    """What is known of the mistake, without an example or an error if the tests have shown one already.

    shown: the levels of help that are shown.
    """
    if diagnosis.limits_alone or not (told and diagnosis.verdict in _SAID_BY_THE_EXAMPLE):
        first, *others = verdict(diagnosis)
        if diagnosis.verdict != "named":  # a mistake's own text may begin with a symbol, such as e
            first = first[:1].upper() + first[1:]
        for paragraph in (first, *others):
            level = HINT if _is_hint(paragraph) else EXPLANATION
            if not diagnosis.mistakes or level in shown:
                yield from folded(paragraph, 1)
    shown_examples = []
    if (example := diagnosis.counterexample) and not _is_shown(diagnosis, example, told):
        shown_examples.append(example)
        yield from folded("For example", 1)
        yield from _indented(example_of(example), advice, diagnosis.verdict == "named")
    if diagnosis.odd and EXPLANATION in shown and not any(advice.known(said) for said in told):
        shown_examples.append(diagnosis.odd)
        yield from folded(ODD, 1)
        yield from _indented(example_of(diagnosis.odd), advice)
    ended = any(map(ended_without_numbers, told)) or diagnosis.error_is_in(*shown_examples)
    rest = replace(diagnosis, accepted=(), crashes=() if ended else diagnosis.crashes)
    for paragraph in besides(rest):
        yield from folded(paragraph.replace(f"error: {diagnosis.function} raised ", "error: "), 1)
        yield from _advised(paragraph, advice)


def _is_shown(diagnosis: Diagnosis, example: Counterexample, told: Sequence[str]) -> bool:
    """Whether the reported tests show the mistake already, so that an example adds nothing."""
    if diagnosis.verdict == "crashes" and not any(map(ended_without_numbers, told)):
        return False
    if told and (diagnosis.verdict == "one at a time" or example.answer.error):
        return True
    return any(map(has_physics, told)) and not (diagnosis.odd and any(map(has_no_number, told)))
