"""Why a run gave no number, in the project's words alone, for a page that a class may see.

Threat: a message of an exception, and the name of a type that a submission defines, are a student's own text. It may
name somebody or insult them, so nothing of it is kept. Of exceptions, the types that Python itself has are named.
"""

from __future__ import annotations

import builtins
import re

from labs.grading.phrases import needed_function
from reference import lecture
from reference.comparison.verdicts import NOTHING_FINITE

NOT_TRIED, NO_RESULT = "it was not tried: the time was used up", "the run came to no result"
_KINDS = {name for name, each in vars(builtins).items() if isinstance(each, type) and issubclass(each, Exception)}
_RAISED = re.compile(r"^\w+ (?:raised|could not be defined:) (\w+)\b")
_KIND = re.compile(r"^(\w+)(?::|$)")
_OUT_OF_TIME = re.compile(r"^\w+ gave no answer(?: within|: .*(?:used up$|its share of ))")
_OUR_DRIVERS = re.compile(
    r"^(?:(?:more than )?\d+ impacts (?:in|within) one step|with these answers the run comes to no end)"
)
_REST = {
    "gave no answer": "gave no answer", "gave ": "gave something that is no answer", "wrote ": "gave no answer",
    "answered ": "answered the same call in two ways", "writes ": "changes its arguments",
}  # fmt: skip


def in_our_words(note: str) -> str:
    """What a note says, without anything that a student has written."""
    if (needed := needed_function(note)) in lecture.FUNCTIONS and "it is not " in note:
        return f"{needed} is not written yet"
    if note.startswith("it was not tried"):
        return NOT_TRIED
    if note == NOTHING_FINITE:
        return note
    if ours := _OUR_DRIVERS.match(note):
        return ours[0]
    function, _, rest = note.partition(" ")
    if function not in lecture.FUNCTIONS:
        kind = _KIND.match(note)
        return f"{NO_RESULT}, but to a {kind[1]}" if kind and kind[1] in _KINDS else NO_RESULT
    if found := _RAISED.match(note):
        verb = "raised" if rest.startswith("raised") else "could not be defined because of"
        return f"{function} {verb} {found[1] if found[1] in _KINDS else 'an exception of its own'}"
    if _OUT_OF_TIME.match(note):
        return f"{function} ran out of time"
    return next((f"{function} {said}" for start, said in _REST.items() if rest.startswith(start)), NO_RESULT)
