"""Tells a function's own mistakes from those of the functions that it calls: no mistake counts twice."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace

from labs.grading.diagnosis.findings import Diagnosis
from labs.grading.diagnosis.probes import probes
from labs.grading.diagnosis.words import listed, told
from labs.grading.judging.score_sheet import Sheet
from labs.grading.phrases import needed_function, no_answer_in, was_raised
from reference.errors import UnknownName

_RIGHT_ALONE = ("right", "one at a time", "unwritten")
"""Verdicts on functions that give no wrong number to a function that calls them for a single case."""
_HOLDS_ANYWAY = ("unwritten", "not tried")
"""Verdicts that hold whatever a function calls."""
NOT_EXPLAINED = "wrong"
"""The verdict on a function that failed a test, and of which nothing more is known."""
CALLS_WRONG, BESIDE_WRONG = "calls a wrong function", "tested with a wrong function"
"""Verdicts on functions that may be right: they call a wrong function, or all that they lost are runs that call one."""
_OF_SHAPES = re.compile(r"shape|broadcast|dimension|out of bounds|not aligned")
"""What is said of errors that an array of another shape than promised may bring about: they are not held against the
caller of a function that gives one."""
Failures = Sequence[tuple[str, str]]
"""Lost parts, each with what was tried and the answer."""


def gives_wrong_numbers(sheet: Sheet, name: str) -> bool:
    """Whether a wrong or suspect function gives wrong numbers to one that calls it for a single, usual case."""
    diagnosis = sheet.diagnosis(name)
    if diagnosis is None or diagnosis.verdict in (*_RIGHT_ALONE, "not tried"):
        return False
    return not (name in sheet.suspects and diagnosis.limits_alone)


def misleads(sheet: Sheet, other: str, name: str) -> bool:
    """Whether a wrong function may be all that is wrong with one that calls it.

    So may one that is right for each single case of its probes, unless the caller makes a known mistake: if it writes
    into its arguments, which the caller still needs; if it fails for several cases, and the caller has no single case;
    or if a test finds a mistake that neither its own probes nor those of the caller show.
    """
    if gives_wrong_numbers(sheet, other):
        return True
    known, own = sheet.diagnosis(other), sheet.diagnosis(name)
    if known is None or known.verdict not in ("right", "one at a time") or (own and own.mistakes):
        return False
    if known.changes_input:
        return True
    if known.verdict == "one at a time":
        return not _is_asked_for_several(name)
    return "" in sheet.causes(other) and (own is None or own.verdict in ("right", "wrong"))


def _is_asked_for_several(name: str) -> bool:
    """Whether there is a single case of a function, so that its probes ask for several in one call as well."""
    try:
        return any(probe.group == "many" for probe in probes(name))
    except UnknownName:
        return True


def certain(sheet: Sheet, name: str, uses: Collection[str]) -> Diagnosis | None:
    """What is certain of a function that lost points. uses: the wrong functions that it calls.

    If one of these misleads it, its own numbers say nothing about it.
    """
    diagnosis = sheet.diagnoses.get(name)
    if any(misleads(sheet, other, name) for other in uses):
        return None
    if diagnosis and uses:
        return replace(diagnosis, crashes=(), one_alone=False)  # with many it fails as they do
    return diagnosis


def without_answers(sheet: Sheet, name: str, uses: Collection[str], failures: Failures) -> Failures:
    """The failures of a function in which it gave no answer at all, or an error that is not one of the others.

    They are its own even if one of the functions that it calls gives it wrong numbers. An exception that has passed
    through a wrong function belongs to that one, whatever it says; so does one that both raise in the same words.
    """
    theirs = {own_words(said, name) for each in sheet.about(name) for said in each.raised_in(uses)}
    theirs |= {own_words(said, other) for other in uses for each in sheet.about(other) for _, said in each.failures}
    none = [(reason, said) for reason, said in failures if was_raised(said) or no_answer_in(said)]
    if any((known := sheet.diagnosis(other)) and known.verdict == "shape" for other in uses):
        none = [(reason, said) for reason, said in none if not _OF_SHAPES.search(said)]
    return [(reason, said) for reason, said in none if said not in theirs]


def failures_of(sheet: Sheet, name: str) -> Failures:
    """Everything that a function lost, and what was said of it."""
    return [(reason, own_words(said, name)) for each in sheet.about(name) for reason, said in each.failures]


def needed_functions(sheet: Sheet, name: str) -> list[str]:
    """The functions that are not written yet and that a function waits for, as far as its tests name them."""
    said = [said for outcome in sheet.about(name) for _, said in outcome.failures]
    return list(dict.fromkeys(needed for words in said if (needed := needed_function(words))))


def own_words(said: str, name: str) -> str:
    """What was said of a function, without its name at the start of a line."""
    return "\n".join(line.removeprefix(f"{name} ") for line in said.splitlines())


def elsewhere(sheet: Sheet, name: str, uses: Collection[str]) -> dict[str, list[str]]:
    """Lost parts in which a scenario called wrong functions that this one does not call, with those functions."""
    found = {}
    for part in [part for outcome in sheet.about(name) for part in outcome.parts]:
        others = [other for other in part.others if gives_wrong_numbers(sheet, other)]
        if others and not set(uses) & set(part.others):
            found[part.reason] = others
    return found


@dataclass(frozen=True)
class Blame:
    """What may be held against a function that lost points or is suspect.

    verdict: on it. mend_first: wrong and suspect functions that it calls, or that a scenario of a lost part calls.
    diagnosis: as far as it is certain. why: what is said before it.
    """

    verdict: str
    mend_first: tuple[str, ...] = ()
    diagnosis: Diagnosis | None = None
    why: tuple[str, ...] = ()

    def lines(self) -> Iterator[str]:
        """All that is said of the function."""
        yield from self.why
        if self.diagnosis:
            yield told(replace(self.diagnosis, accepted=()))  # no test asks for errors


def blame_of(sheet: Sheet, name: str) -> Blame:
    """What may be held against a function, by the rule that the student's report follows as well.

    A function without an answer in time is excused only if one that it calls had none either.
    """
    found, uses = sheet.diagnosis(name), sheet.wrong_uses(name)
    if name not in sheet.lost:
        return Blame(_verdict(found), tuple(uses) if found else (), found)
    if _only_waits(sheet, name, found):
        waits = [other for other in needed_functions(sheet, name) if other != name]
        if not waits:
            return Blame("unwritten", tuple(uses), Diagnosis(name, "unwritten"))
        return Blame("unwritten", tuple(uses), None, (f"{name} waits for {listed(waits)}.",))
    in_runs = elsewhere(sheet, name, uses)
    mend_first = tuple(dict.fromkeys([*uses, *(other for others in in_runs.values() for other in others)]))
    if misleading := _misleading(sheet, name, found, uses):
        own = without_answers(sheet, name, uses, failures_of(sheet, name))
        said = dict.fromkeys(words for _, words in own if words)
        without_numbers = _verdict(found) if found and found.verdict in ("crashes", "shape") else NOT_EXPLAINED
        which = "that" if len(misleading) == 1 else "them"
        why = (
            f"{name} calls {listed(misleading)}: mend {which} first; until then the numbers of {name} say nothing about"
            " its own code."
        )
        return Blame(without_numbers if own else CALLS_WRONG, mend_first, None, (why, *said))
    if found and found.right and not found.accepted and all(each in in_runs for each, _ in failures_of(sheet, name)):
        why = f"{name} is right on every probe; the runs that it lost also call {listed(mend_first)}."
        return Blame(BESIDE_WRONG, mend_first, None, (why,))
    sure = certain(sheet, name, uses)
    return Blame(_verdict(found), mend_first, replace(sure, verdict="wrong") if sure and sure.right else sure)


def lent_words(sheet: Sheet, name: str) -> Iterator[str]:
    """Whose fault it is where a function failed parts of its tests only because of others that it calls."""
    if lent := sheet.lent(name):
        which = "that one is" if len(lent) == 1 else "those are"
        yield (
            f"{name} calls your {listed(lent)}, and {which} not right yet. The tests ran again with the lab's own in"
            f" {'its' if len(lent) == 1 else 'their'} place, and the parts that passed then count."
        )


def _only_waits(sheet: Sheet, name: str, found: Diagnosis | None) -> bool:
    """Whether all that a function lost, and all that its probes hold against it, is that a function is not written."""
    if sheet.causes(name) != {"missing"}:
        return False
    example = found.counterexample if found else None
    return found is None or found.verdict in _RIGHT_ALONE or bool(example and example.answer.unwritten)


def _verdict(found: Diagnosis | None) -> str:
    return found.verdict if found and found.verdict != "right" else NOT_EXPLAINED


def _misleading(sheet: Sheet, name: str, found: Diagnosis | None, uses: Collection[str]) -> list[str]:
    """Those of the functions that one calls which explain its failures, as far as their numbers or their time can."""
    if found and found.verdict in _HOLDS_ANYWAY:
        return []
    wrong = [other for other in uses if misleads(sheet, other, name)]
    slow = [other for other in wrong if (known := sheet.diagnosis(other)) and known.verdict == "too slow"]
    return slow if found and found.verdict == "too slow" else wrong
