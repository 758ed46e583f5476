"""What helps a student on: lines of a derivation that are checked, hints one at a time, and drawn figures."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from types import EllipsisType

from labs.desk.hints import Revealed
from labs.desk.refusals import errors_in_words
from labs.guidance import drawings
from labs.guidance.hint_files import Guide, hints
from reference import lecture
from reference.errors import UnknownName


class Guiding:
    """The part of the desk that guides. _revealed: the hints that were shown."""

    def __init__(self) -> None:
        super().__init__()
        self._revealed = Revealed()

    def _show(self, *shown: object) -> None:
        """Display something below the cell."""
        raise NotImplementedError

    def _written(self) -> list[str]:
        """The functions that a student of this lab writes."""
        raise NotImplementedError

    def _check(self, functions: Sequence[str | Callable[..., object]], hint: bool = False) -> float | None:
        """Check functions, and show the next hint on them if one is wanted."""
        raise NotImplementedError

    @errors_in_words
    def derive(self, function: str | Callable[..., object], /, **lines: str | EllipsisType) -> None:
        """Check a line of the derivation that a function needs; as long as it is dots, say what is asked for.

        Write the right side between quotes, as in j="-(1 + e) * u / k". Every form of the right line is right.
        """
        from labs.desk import derivations  # noqa: PLC0415

        guide = self._guide(function)
        found = {left: line for left, line in lines.items() if line is not ...}
        waiting = [left for left in lines if left not in found]
        for line in derivations.judged(guide, found):
            print(line)
        if waiting or not found:
            for line in derivations.asked(guide, waiting):
                print(line)

    @errors_in_words
    def hint(self, function: str | Callable[..., object]) -> None:
        """Show the next hint on a function: the idea, the next line, the formula, then help with your own code.

        Hints cost nothing.
        """
        if shown := self._revealed.next(self._guide(function)):
            self._show(*shown)
        else:
            self._check((function,), hint=True)

    @errors_in_words
    def figure(self, name: str) -> None:
        """Show a drawn figure by its name."""
        self._show(drawings.drawing(name))

    def _guide(self, function: str | Callable[..., object]) -> Guide:
        """The hints on a function of a lab."""
        name = name_of(function)
        if name not in lecture.FUNCTIONS:
            raise UnknownName("function of this lab", name, self._written())
        return hints(lecture.function(name).topic).of(name)


def name_of(function: str | Callable[..., object]) -> str:
    """The name of a function that is given as such, or by its name."""
    return str(getattr(function, "__name__", function))
