"""Follows objects from name to name through a file, and finds the statements that may change the object of a name.

A call counts as one that changes what it is given, unless it is sure to change nothing: what shows things cannot be
called where this is graded, the file's own functions are looked into, and NumPy says which of its functions give a
value. The top level is followed in order: a name that is bound again has another object from there on. Within a
function, and within a statement that holds others, names that share an object at some time share it all the time.
"""

from __future__ import annotations

import builtins
import collections
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence, Set
from functools import cached_property

from labs.grading.submission.effects import CHANGING_METHODS, OPERATOR, Call, Effects, Function
from labs.grading.submission.known_calls import (
    AT_HAND,
    CHANGING_BUILTINS,
    IN_PLACE,
    LAZY,
    READING_METHODS,
    SHOWING,
    gives_a_value,
)
from labs.grading.submission.sharing import COPIES, LOOKED_AT, Binding, Objects
from labs.grading.submission.statements import Group

_VERSIONS = 10
"""So many functions of one name are looked at, the last ones. Thousands with thousands of calls would take hours."""


class Flow:
    """What the statements of a file may change."""

    def __init__(self, every: Sequence[Group]) -> None:
        self.every = every
        self._imported = {name: path for each in every for name, path in each.modules.items()}
        self._bound = {name for each in every for name in each.kinds}
        self._others = self._bound | vars(builtins).keys()
        constants = {name for each in every for name in each.constants}
        constants -= {name for each in every for name in each.kinds if name not in each.constants}
        self._values = {name for each in every for name, kind in each.kinds.items() if kind == "value"} - constants
        self._own = {name: each for each in every for name, kind in each.kinds.items() if kind in ("def", "class")}
        self._functions: dict[str, list[Function]] = {}
        for group, function in ((each, function) for each in every for function in each.functions):
            self._functions.setdefault(function.called, []).append(function)
            if not function.called.startswith("."):
                self._own[function.called] = group
        self._functions = {name: several[-_VERSIONS:] for name, several in self._functions.items()}
        self._knows_all = not any(each.is_dynamic for each in every)
        self._has_lazy = any(each.is_lazy for several in self._functions.values() for each in several)
        bindings = (binding for each in every for binding in each.does.bindings)
        self._has_lazy |= any(lent.call in LAZY for binding in bindings for lent in binding.lent)
        self._unchangeable = constants | self._imported.keys()
        self._absent = self._not_at_hand()
        self._inside: dict[int, Objects] = {}
        self._changed: dict[int, set[Hashable]] = {}  # of each function the objects
        self._changing: set[str] = set()  # functions that may change what they are given, or were made of
        self._reached: dict[str, frozenset[str]] = {}
        self._follow_functions()

    def _not_at_hand(self) -> set[str]:
        """Names that only stand for what is not there where this is graded: other packages, and what they make."""
        there = {each for each, kind in ((n, k) for g in self.every for n, k in g.kinds.items()) if kind != "import"}
        of = [each for group in self.every for each in group.does.bindings if each.name in self._bound]
        waiting = [name for name, path in self._imported.items() if path.partition(".")[0] not in AT_HAND]
        absent = set(waiting) - there
        made: dict[str, list[Binding]] = {}
        for each in of:
            for start in each.roots:
                made.setdefault(start, []).append(each)
        missing = {start for start in made if self._is_unknown(start)}
        waiting = [*absent, *missing]
        others = {each.name: 0 for each in of}
        for each in of:
            others[each.name] += 1
        while waiting:
            for each in made.pop(waiting.pop(), ()):
                others[each.name] -= 1
                if others[each.name] <= 0 and each.name not in absent and each.name not in self._own:
                    absent.add(each.name)
                    waiting.append(each.name)
        return absent

    def _is_unknown(self, name: str) -> bool:
        return bool(name) and self._knows_all and name not in self._bound and not hasattr(builtins, name)

    def _follow_functions(self) -> None:
        """Find what each function changes by itself and through those that it calls, until nothing is added."""
        every = [function for several in self._functions.values() for function in several]
        callers: dict[str, list[Function]] = {}
        for function in every:
            self._inside[id(function)] = objects = Objects()
            for each in (*function.does.bindings, *function.does.stores):
                for name in each.shares.union(*(lent.names for lent in each.lent if not self._is_unknown(lent.call))):
                    if name in self._values or name in function.given or name in function.does.local:
                        objects.join(each.name, name)
            for call in function.does.calls:
                for name in (call.called, *call.given):
                    if name in self._functions:
                        callers.setdefault(name, []).append(function)
        waiting, looked_at = [*every], collections.Counter[int]()
        while waiting:
            function = waiting.pop()
            looked_at[id(function)] += 1
            if looked_at[id(function)] > _VERSIONS:
                continue
            objects = self._inside[id(function)]
            changed = self._changed.setdefault(id(function), set())
            changed |= {objects.of(name) for name in self._touched(function.does, function)}
            if function.called not in self._changing and any(objects.of(name) in changed for name in function.given):
                self._changing.add(function.called)
                waiting += callers.get(function.called, ())

    def _touched(self, does: Effects, function: Function | None = None) -> Iterator[str]:
        """Names whose objects some statements may change, those of a function if one is given."""
        yield from (name for name in does.changes if name not in self._imported or function is None)
        if OPERATOR in self._changing:
            yield from self._only_values(does.operated)
        local = does.local | function.given if function else does.local - self._bound
        made = self._made_nowhere(does, local) if function else set()
        for call in does.calls:
            if not self._is_absent(call, made, local):
                yield from self._touched_by(call, function is not None, local)

    def _made_nowhere(self, does: Effects, local: frozenset[str]) -> set[str]:
        """The names of a function that stand for what is made by something that is not at hand."""
        found = set[str]()
        for each in does.bindings:
            if any(start in found or (start not in local and self._is_nowhere(start)) for start in each.roots):
                found.add(each.name)
        return found

    def _is_absent(self, call: Call, made: set[str], local: frozenset[str]) -> bool:
        """Whether a call is sure to fail where this is graded, as it needs what is not there."""
        starts = (call.root, *call.roots)
        return any(start in made or (start not in local and self._is_nowhere(start)) for start in starts)

    def _is_nowhere(self, name: str) -> bool:
        return name in self._absent or self._is_unknown(name)

    def _touched_by(self, call: Call, inside: bool, local: frozenset[str]) -> Iterator[str]:
        """Names whose objects a call may change."""
        name = call.called.removeprefix(".")
        is_method, at_hand = call.called.startswith("."), call.root in self._imported and call.root not in local
        if call.is_statement and is_method and not inside:
            yield call.root
        if (
            not at_hand
            and not (call.path and hasattr(builtins, call.root))
            and self._changes_receiver(call, name, inside, local)
        ):
            yield from (each for each in self._expanded(call.receiver) if each not in self._unchangeable)
        if self._changes_given(call, name, inside, at_hand, local):
            names = self._expanded(call.given)
            yield from names if call.called in CHANGING_BUILTINS else self._only_values(names)

    def _changes_receiver(self, call: Call, name: str, inside: bool, local: frozenset[str]) -> bool:
        if not call.called.startswith("."):  # a value that is called, as a bound method or a closure
            return call.called not in self._own and not (inside and call.called in local)
        if call.called in self._changing or name in CHANGING_METHODS:
            return True
        return not (inside or call.is_lookup or name in READING_METHODS or call.called in self._functions)

    def _changes_given(self, call: Call, name: str, inside: bool, at_hand: bool, local: frozenset[str]) -> bool:
        if not call.given or call.is_lookup or name in COPIES:
            return False
        if call.called in self._changing or not self._changing.isdisjoint(call.given):
            return True
        if at_hand:
            return not gives_a_value((self._imported[call.root], *call.path[1:])) or bool(call.keywords & IN_PLACE)
        if hasattr(builtins, call.root) and call.root not in self._bound:
            is_method = call.called.startswith(".")
            return name in CHANGING_METHODS if is_method else self._builtin_changes(call)
        return self._changes_receiver(call, name, inside, local) and name not in CHANGING_METHODS

    def _builtin_changes(self, call: Call) -> bool:
        """Whether one of Python's own functions changes what it is given; of a generator it takes the items."""
        return call.called in CHANGING_BUILTINS or (self._has_lazy and call.called != SHOWING)

    def _only_values(self, names: Iterable[str]) -> Iterator[str]:
        """Those of some names that are no function, module or constant of the file, and none of Python's own."""
        return (name for name in names if name in self._values or name not in self._others)

    def _expanded(self, names: Iterable[str]) -> Iterator[str]:
        """Some names, and the values that those of them that are functions or classes may give back."""
        for name in names:
            yield name
            if name in self._own:
                yield from self._values_of(name)

    def _values_of(self, function: str) -> frozenset[str]:
        """The values of the file that a function looks up, directly or through others."""
        if function not in self._reached:
            waiting, seen = [function], {function}
            for _ in range(LOOKED_AT):
                if waiting and (group := self._own.get(waiting.pop())):
                    found = {each for each in group.inner if each in self._own or each in self._values} - seen
                    seen |= found
                    waiting += found
            self._reached[function] = frozenset(sorted(seen & self._values)[:LOOKED_AT])
        return self._reached[function]

    def _shared(self, binding: Binding) -> Iterator[str]:
        """The names that may share the object of a binding."""
        names = binding.shares.union(*(lent.names for lent in binding.lent if not self._gives_new(lent.call)))
        return self._only_values(self._expanded(names))

    def _gives_new(self, called: str) -> bool:
        """Whether a function of the file gives back nothing of what it is given, or looks up."""
        several = self._functions.get(called, ())
        return bool(several) and not any(map(self._lends, several))

    def _lends(self, function: Function) -> bool:
        objects = self._inside[id(function)]
        given = {objects.of(name) for name in function.given}
        return function.is_lazy or any(objects.of(name) in given for name in function.result)

    def calls(self, group: Group) -> set[str]:
        """The functions that a group's statements may call at once, with a dot before a method."""
        there = [call for call in group.does.calls if not self._is_absent(call, set(), group.does.local - self._bound)]
        named = {name for call in there for name in (call.called, *call.given)}
        named |= {name for each in group.does.bindings for name in each.shares}
        return named | ({OPERATOR} if group.does.operated else set())

    def changed_by(self, function: Function, names: Set[str]) -> set[str]:
        """Which of some names of the file have objects that a function may change."""
        if id(function) not in self._inside:
            return set()
        objects, changed = self._inside[id(function)], self._changed[id(function)]
        own = {*objects.joined, *changed}  # few, where the names of a file may be thousands
        found = {name for name in names & own if objects.of(name) in changed}
        return found - self._imported.keys()  # nobody changes NumPy by a call of it

    @cached_property
    def changers(self) -> Mapping[str, Sequence[int]]:
        """For each name the numbers of the statements that may change an object that it has at some time."""
        objects, now, had = Objects(), dict[str, tuple[str, int]](), dict[str, list[tuple[str, int]]]()
        touched: list[tuple[int, Hashable]] = []
        for at, each in enumerate(self.every):
            values = [name for name in each.kinds if name in self._values]
            before = {name: now[name] for name in values if name in now}
            for name in values:
                if name not in now or not (each.is_compound or name in each.does.changes):
                    now[name] = (name, at)
                    had.setdefault(name, []).append(now[name])
            made = (binding for binding in each.does.bindings if binding.name not in self._own)
            for binding in (*made, *each.does.stores):
                thing: Hashable = now.get(binding.name, binding.name)
                for name in (name for name in self._shared(binding) if name in now):
                    objects.join(thing, now[name])
                    objects.join(thing, before.get(name, now[name]))
            touched += ((at, now.get(name, name)) for name in self._touched(each.does))
        places: dict[Hashable, list[int]] = {}
        for at, thing in touched:
            places.setdefault(objects.of(thing), []).append(at)
        found = {name: {objects.of(each) for each in (name, *had.get(name, ()))} for name in self._bound}
        return {name: [at for thing in things for at in places.get(thing, ())] for name, things in found.items()}
