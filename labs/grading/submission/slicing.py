"""Finds the statements of a submission that its functions need, from the names in the syntax tree.

A function needs the statements that define the names which it looks up outside itself, and those that may change what
these names stand for; these need others in turn. All other statements only plot, print, check or animate. They are left
out, so that they can neither fail nor cost time, while a line number still means the line that the student sees.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence

from labs.grading.submission.flow import Flow
from labs.grading.submission.statements import Group


def needed(every: Sequence[Group], wanted: Collection[str]) -> set[int]:
    """The numbers of the groups that the wanted names need.

    A function that a needed function calls changes what it changes whenever that happens. But one that none of them
    calls, such as a decorator that fills a table, counts through the statements that call it.
    """
    flow = Flow(every)
    defining, using = _places(group.defines for group in every), _places(group.uses for group in every)
    calling = _places(map(flow.calls, every))
    changing: dict[str, list[str]] = {}
    for group in every:
        for each in group.functions:
            for name in flow.changed_by(each, group.inner):
                changing.setdefault(name, []).append(each.called)
    kept = {at for at, group in enumerate(every) if group.is_dynamic}
    names, functions = list({*wanted, *(name for at in kept for name in every[at].uses)}), list[str]()
    seen, within, active = set(names), set(wanted), set[str]()
    while names or functions:
        if names:
            name = names.pop()
            new = [*defining.get(name, ()), *flow.changers.get(name, ())]
            functions += changing.get(name, ())
        elif (function := functions.pop()) in active or function in within:
            continue
        else:
            active.add(function)
            new = calling.get(function, [])
            functions += (each.called for at in using.get(function, []) for each in every[at].functions)
        for at in new:
            if at not in kept:
                kept.add(at)
                names += every[at].uses - seen
                seen |= every[at].uses
                within |= every[at].inner - every[at].defines
    return kept


def _places(every: Iterable[Collection[str]]) -> dict[str, list[int]]:
    """The numbers of the groups that have to do with a name, from the names of each group."""
    found: dict[str, list[int]] = {}
    for at, names in enumerate(every):
        for name in names:
            found.setdefault(name, []).append(at)
    return found


def used_by(every: Sequence[Group], name: str, among: Collection[str]) -> list[str]:
    """Which of some names a name needs, directly or through names that are not among them; in their order."""
    seen = looked_up(every, [name], set(among) - {name})
    return [other for other in among if other in seen and other != name]


def looked_up(every: Sequence[Group], names: Collection[str], ends: Collection[str] = ()) -> set[str]:
    """Some names, and those that they look up directly or through names other than the ends."""
    used: dict[str, list[frozenset[str]]] = {}
    for group in every:
        for each in group.defines:
            used.setdefault(each, []).append(group.uses)
    waiting, seen = [*names], {*names}
    while waiting:
        each = waiting.pop()
        for uses in used.pop(each, []) if each not in ends else []:
            found = uses - seen
            seen |= found
            waiting.extend(found)
    return seen
