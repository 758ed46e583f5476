"""What a notebook's questions need: numbers of a student's own, and wrong functions to expose or to mend."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from types import SimpleNamespace

from labs.assessment import seeded
from labs.desk.refusals import errors_in_words
from labs.grading.wrapping import folded
from reference.errors import InvalidInput


class Questions:
    """The part of the desk that questions call. _student: who is asked; empty if nobody has said so."""

    _student = ""

    def _begun(self) -> str:
        """The topic of the lab that was begun."""
        raise NotImplementedError

    @errors_in_words
    def student(self, name: str) -> None:
        """Say who you are, by name or number as your course has it: questions then have numbers of your own."""
        self._student = str(name).strip()
        print(f"Your numbers are those of {self._student!r}." if self._student else "Put your name between the quotes.")

    @errors_in_words
    def numbers(self, key: str, /, **choices: Sequence[float]) -> SimpleNamespace:
        """The numbers of a question, one of the values of each name: always the same for one student."""
        found = seeded.drawn(self._student, self._begun(), key, choices)
        whose = f"numbers of {self._student!r}" if self._student else 'numbers, until lab.student("…") has your name'
        print(f"Your {whose}: {seeded.in_words(found)}.")
        return found

    @errors_in_words
    def expose(self, key: str, /, *arguments: object) -> None:
        """Try an input on a wrong function and on yours: an input at which they differ exposes the wrong one.

        Write the input in numbers, without names: it is read from the notebook when the lab is marked.
        """
        from labs.assessment import exposures, written_inputs  # noqa: PLC0415
        from labs.desk import student_code  # noqa: PLC0415

        suspect = exposures.suspect(self._begun(), key)
        if not arguments or any(each is ... for each in arguments):
            _say(f"Put an input of {suspect.function} in place of the dots: one at which your colleague's is wrong.")
            return
        yours = student_code.defined_now(suspect.function)
        if yours is None:
            _say(f"Write {suspect.function} first: your colleague's is compared with it.")
            return
        cells = student_code.executed_cells()
        written = written_inputs.inputs_in(cells).get(key, [])
        if cells and list(arguments) not in written:
            raise InvalidInput(written_inputs.NOT_WRITTEN)
        found = exposures.tried(suspect, arguments, yours)
        exposed = "✓ Exposed" if found.exposed else "✗ Not exposed"
        _say(f"{exposed}, if your {suspect.function} is right. {found.said}.")
        if len(written) == written_inputs.TRIES:
            _say(written_inputs.MANY)

    @errors_in_words
    def mended(self, key: str, program: Callable[..., object], /) -> None:
        """Say whether you have found the bug of a program, which is tried with other numbers too."""
        from labs.assessment import mending  # noqa: PLC0415

        wrong = mending.still_wrong(self._begun(), key, program)
        _say(f"✗ Not mended yet. {wrong}" if wrong else "✓ Mended: it is right for other numbers as well.")


def _say(text: str) -> None:
    print("\n".join(folded(text, 0)))
