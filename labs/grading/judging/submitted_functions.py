"""A submission's functions as attributes of an object, for tests that call them as if they were here."""

from __future__ import annotations

import contextlib
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from labs.grading.calling.cases import OneCase
from labs.grading.calling.remote import Call, Remote
from labs.grading.diagnosis.probes.one_case import one_case
from labs.grading.errors import StudentError
from labs.grading.judging.case_by_case import CaseByCase
from labs.grading.judging.same_answers import SameAnswers
from labs.grading.judging.score_sheet import Sheet


@dataclass(frozen=True)
class Function:
    """One function. In pytest's own messages it reads as a student writes it: `rebound_velocity(-2.0, 0.5)`."""

    functions: Functions
    name: str

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        """Call it in the process of the test that runs."""
        answers = self.functions.same_answers[self.name]
        try:
            answer = self.functions.process()(self.name, *arguments, **named)
        except StudentError:
            answers.note_error()
            raise
        answers.note(answer)
        return answer

    def foresee(self, several: Iterable[tuple[Any, ...]]) -> None:
        """Say which calls of it come next, so that its process can work ahead."""
        self.functions.process().foresee(self.name, several)

    def __repr__(self) -> str:
        return self.name


class Functions:
    """A submission's functions as attributes; each test has a process of its own, from its first call on.

    same_answers: of each function that the running test has called by itself.
    """

    def __init__(self, remote: Remote, sheet: Sheet) -> None:
        self._remote, self._sheet = remote, sheet
        self._test = contextlib.ExitStack()
        self._call: Call | None = None
        self.same_answers: defaultdict[str, SameAnswers] = defaultdict(SameAnswers)

    def __getattr__(self, name: str) -> Function:
        if name.startswith("_"):
            raise AttributeError(name)
        return Function(self, name)

    def __repr__(self) -> str:
        return "submission"

    @property
    def case_by_case(self) -> CaseByCase:
        """The functions that were asked for one case at a time."""
        return self._sheet.case_by_case

    @staticmethod
    def one_case(name: str) -> OneCase | None:
        """What a function takes and gives for one case."""
        return one_case(name)

    def process(self) -> Call:
        """The process of the running test, for uses beyond a call: `steady`, `changed`, `implementation`."""
        if self._call is None:
            self._call = self._test.enter_context(self._remote.fresh())
            if self._call.sealing:  # where it does not load, later tests have no process
                self._sheet.tier = self._call.sealing.tier.title
                self._sheet.missing = self._call.sealing.missing
        return self._call

    @property
    def answered(self) -> int:
        """How many calls of the running test had an answer."""
        return self._call.answered if self._call else 0

    def begin_part(self) -> None:
        """Begin a part of a test."""
        self.case_by_case.begin_part()
        if self._call:
            self._call.asked.clear()

    @property
    def asked(self) -> set[str]:
        """The functions that were called in the running part: that of the test, and those that a scenario calls."""
        return self._call.asked if self._call else set()

    def end_test(self) -> None:
        """End the test's process."""
        self._call = None
        self.same_answers.clear()
        self._test.close()
