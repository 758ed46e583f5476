"""Follows objects from name to name through a file, and finds the statements that may change the object of a name.

The top level is followed in order: a name that is bound again has another object from there on. Within a function, and
within a statement that holds others, all names that share an object at some time count as sharing it all the time.
"""

from __future__ import annotations

import builtins
import sys
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from labs.grading.submission.effects import ANY, Call, Effects, Function
from labs.grading.submission.sharing import LOOKED_AT, Binding
from labs.grading.submission.statements import Group

_VERSIONS = 10
"""So many functions of one name are looked at, the last ones. Thousands with thousands of calls would take hours."""
AT_HAND = {*sys.stdlib_module_names, "numpy"}
"""Packages that a submission can import where it is graded."""


class _Objects:
    """Sets of things that may share an object; two sets become one when a thing of each may share it."""

    def __init__(self) -> None:
        self._above: dict[Hashable, Hashable] = {}

    def of(self, thing: Hashable) -> Hashable:
        """The thing that stands for the set of another one."""
        while (above := self._above.get(thing, thing)) != thing:
            self._above[thing] = self._above.get(above, above)
            thing = above
        return thing

    def join(self, one: Hashable, other: Hashable) -> None:
        """Make one set of the sets of two things."""
        if (first := self.of(one)) != (second := self.of(other)):
            self._above[first] = second


@dataclass
class Flow:
    """What the statements of a file may change."""

    every: Sequence[Group]
    _changed: set[tuple[int, Hashable]] = field(default_factory=set)  # objects of functions, each with its function
    _inside: dict[int, _Objects] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._imported = {name for each in self.every for name in each.modules}
        self._bound = {name for each in self.every for name in each.kinds}
        self._others = self._bound | vars(builtins).keys()
        changing = {name for each in self.every for name in each.kinds if name not in each.constants}
        self._values = {name for each in self.every for name, kind in each.kinds.items() if kind == "value"} & changing
        self._present = {name for each in self.every for name, top in each.modules.items() if top in AT_HAND}
        self._present |= {name for each in self.every for name in self._made_here(each.does)}
        self._functions: dict[str, list[Function]] = {}
        for function in (function for each in self.every for function in each.functions):
            self._functions.setdefault(function.called, []).append(function)
        self._functions = {name: several[-_VERSIONS:] for name, several in self._functions.items()}
        self._follow_functions()

    def _made_here(self, does: Effects) -> Iterator[str]:
        """Names that are bound to what a package at hand has made."""
        return (each.name for each in does.bindings if each.root in self._present)

    def _follow_functions(self) -> None:
        """Find what each function changes by itself and through those that it calls, until nothing is added."""
        every = [function for several in self._functions.values() for function in several]
        for function in every:
            self._inside[id(function)] = objects = _Objects()
            for binding in function.does.bindings:
                for name in self._shared(binding):
                    objects.join(binding.name, name)
        passed: dict[tuple[int, Hashable], list[tuple[Function, frozenset[str]]]] = {}
        waiting: list[tuple[Function, str]] = []
        for function in every:
            waiting += ((function, name) for name in self._changed_itself(function.does))
            for callee, parameter, names in self._passed(function.does):
                passed.setdefault(self._object(callee, parameter), []).append((function, names))
        given = {self._object(function, name) for function in every for name in function.parameters}
        while waiting:
            function, name = waiting.pop()
            if (found := self._object(function, name)) not in self._changed:
                self._changed.add(found)
                waiting += ((caller, each) for caller, names in passed.get(found, ()) for each in names)
                waiting += [(function, ANY)] * (found in given)

    def _object(self, function: Function, name: str) -> tuple[int, Hashable]:
        return id(function), self._inside[id(function)].of(name)

    def _shared(self, binding: Binding) -> frozenset[str]:
        """The names that may share the object of a binding; what the file's own functions are given is not in it."""
        lent = (names for root, names in binding.lent if root in self._present or hasattr(builtins, root))
        return frozenset(self._only_values(binding.shares.union(*lent)))

    def _changed_itself(self, does: Effects) -> Iterator[str]:
        """Names whose objects statements change themselves, or by a call of a package for its effect."""
        yield from does.changes
        yield from self._only_values(does.mutates)
        for call in does.calls:
            if call.for_effect and call.receiver is None and call.root in self._values:
                yield call.root  # a method of an object that has a name of its own: `note = TABLE.append; note(3)`
            if call.for_effect and call.root in self._present:
                for _, names in call.given:
                    yield from self._only_values(names)

    def _only_values(self, names: Iterable[str]) -> Iterator[str]:
        """Those of some names that are no function, module or constant of the file, and none of Python's own."""
        return (name for name in names if name in self._values or name not in self._others)

    def _passed(self, does: Effects) -> Iterator[tuple[Function, str, frozenset[str]]]:
        """What statements give to functions of the file: the function, its parameter, and names of what it is given.

        A function that is given to one of Python's own, as in `list(map(fill, A))`, is given everything beside it.
        """
        for call in does.calls:
            for callee in self._callees(call):
                if callee.itself and call.receiver:
                    yield callee, callee.itself, call.receiver
                for place, names in call.given:
                    yield from ((callee, parameter, names) for parameter in callee.bound_to(place))
            beside = frozenset[str]().union(*(names for _, names in call.given) if call.for_effect else ())
            if len(beside) <= LOOKED_AT:
                yield from ((callee, ANY, beside) for name in beside for callee in self._functions.get(name, ()))

    def _callees(self, call: Call) -> Sequence[Function]:
        """The functions of the file that a call may call."""
        if call.receiver is None:
            return self._functions.get(call.name, ())
        return () if call.root in self._imported else self._functions.get(f".{call.name}", ())

    def changed_by(self, function: Function, names: Iterable[str]) -> set[str]:
        """Which of some names have objects that a function may change."""
        own = (name for name in names if name in self._bound or name not in self._others)
        known = function in self._functions[function.called]
        changed = (name for name in own if known and self._object(function, name) in self._changed)
        return {name for name in changed if name not in self._imported}  # nobody changes NumPy by a call of it

    @cached_property
    def changers(self) -> Mapping[str, Sequence[int]]:
        """For each name the numbers of the statements that may change an object that it has at some time."""
        objects, now, had = _Objects(), dict[str, tuple[str, int]](), dict[str, list[tuple[str, int]]]()
        touched: list[tuple[int, Hashable]] = []
        for at, each in enumerate(self.every):
            values = [name for name in each.kinds if name in self._values]
            before = {name: now[name] for name in values if name in now}
            for name in values:
                if name not in now or not (each.is_compound or name in each.does.changes):
                    now[name] = (name, at)
                    had.setdefault(name, []).append(now[name])
            for binding in (binding for binding in each.does.bindings if binding.name in now):
                for name in (name for name in self._shared(binding) if name in now):
                    objects.join(now[binding.name], now[name])
                    objects.join(now[binding.name], before.get(name, now[name]))
            touched += ((at, now.get(name, name)) for name in self._touched(each.does))
        places: dict[Hashable, list[int]] = {}
        for at, thing in touched:
            places.setdefault(objects.of(thing), []).append(at)
        found = {name: {objects.of(each) for each in (name, *had.get(name, ()))} for name in self._bound}
        return {name: [at for thing in things for at in places.get(thing, ())] for name, things in found.items()}

    def _touched(self, does: Effects) -> Iterator[str]:
        yield from self._changed_itself(does)
        for callee, parameter, names in self._passed(does):
            if self._object(callee, parameter) in self._changed:
                yield from names
