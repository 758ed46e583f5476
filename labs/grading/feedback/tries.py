"""Counts the tries at each function, from which follows how much help a student reads.

A try is a function that was checked and is not right. The same code again is no new try, whatever its layout and its
comments; neither is code that was tried before. The first try shows what was tried, the answer, and what physics says;
each further one shows one level of help more, as far as there is one. A function that is right begins again.
"""

from __future__ import annotations


class Tries:
    """The tries of one student, as long as this object lives."""

    def __init__(self) -> None:
        self._codes: dict[str, set[str]] = {}
        self._requests: dict[str, int] = {}

    def add(self, function: str, code: str) -> None:
        """Note that a function was checked and is not right. code: what it is made of."""
        self._codes.setdefault(function, set()).add(code)

    def request(self, function: str) -> None:
        """Note that the student asks for the next level of help before the next try."""
        self._requests[function] = self._requests.get(function, 0) + 1

    def forget(self, function: str) -> None:
        """Begin again, as the function is right."""
        self._codes.pop(function, None)
        self._requests.pop(function, None)

    def count(self, function: str) -> int:
        """How often a function was tried since it was last right."""
        return len(self._codes.get(function, ()))

    def levels(self, function: str) -> int:
        """How many levels of help are shown besides what was tried: one for each try after the first, or request."""
        return max(self.count(function) - 1, 0) + self._requests.get(function, 0)
