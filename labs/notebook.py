"""The desk of a course notebook: `from labs import lab`.

    lab.begin("detection")                    which engines answer, and what is at hand
    lab.predict("rest", "…?", answer=...)     a guess, kept for the run
    lab.check("signed_distance")              what was tried, what came, what physics expects
    lab.run("dropped-ball/e=0.5")             the same case with your functions and with engines
    lab.watch("dropped-ball/e=0.5")           the replay alone
    lab.sweep("dropped-ball", "restitution")  one parameter moved: where your method breaks, and where theirs does

Your functions run in processes of their own: a loop without end or a crash costs a line of text, and the kernel lives
on. Every call takes the functions as they are in the cells that you have run.
"""

from __future__ import annotations

import functools
import inspect
import logging
import os
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from types import EllipsisType
from typing import TYPE_CHECKING, ParamSpec, TypeVar

from labs.desk.predictions import Prediction, predicted
from labs.desk.progress_line import Progress
from reference import lecture
from reference.errors import CollisionsError, InvalidInput, UnknownName

if TYPE_CHECKING:
    from labs.desk.case_runs import Asked, Wanted
    from labs.desk.student_code import Hand
    from labs.grading.calling.remote import Grader

P = ParamSpec("P")
R = TypeVar("R")
logging.getLogger("reference").addHandler(logging.NullHandler())  # a table says what happened to a worker


def _spoken(method: Callable[P, R]) -> Callable[P, R | None]:
    """What the lab refuses or cannot do is a line of text, and no traceback through its own code."""

    @functools.wraps(method)
    def call(*arguments: P.args, **named: P.kwargs) -> R | None:
        try:
            inspect.signature(method).bind(*arguments, **named)
        except TypeError as error:
            print(f"lab.{method.__name__}: {error}; help(lab.{method.__name__}) says what it takes")
            return None
        try:
            return method(*arguments, **named)
        except CollisionsError as error:
            if os.environ.get("NBGRADER_EXECUTION") == "autograde":
                raise  # or the cell would get all its points
            print(f"lab.{method.__name__}: {error}")
        except KeyboardInterrupt:
            print(f"lab.{method.__name__}: interrupted")
        return None

    return call


class Lab:
    """One student at one notebook."""

    def __init__(self) -> None:
        self.topic = ""
        self._predictions: dict[str, Prediction] = {}
        self._grader: Grader | None = None

    @_spoken
    def begin(self, topic: str) -> None:
        """Say which lab this is, which engines answer here, and what earlier work is at hand."""
        from labs.desk import engine_status  # noqa: PLC0415

        self.topic = lecture.topic(topic).name
        print(f"{lecture.topic(topic).title} ({self.topic})")
        for line in engine_status.answering():
            print(line)
        hand = self._hand([""])
        for notebook in dict.fromkeys(notebook for _, notebook in hand.earlier):
            print(f"Yours from {notebook}: {', '.join(name for name, at in hand.earlier if at == notebook)}")
        for complaint in hand.complaints:
            print(complaint)
        if not hand.given:
            print("Functions of other labs are not at hand: some runs will say what they need.")

    @_spoken
    def check(self, *functions: str | Callable[..., object]) -> float | None:
        """Check functions by name, or all of this lab: what was tried, what came, and what physics expects.

        Only for nbgrader it has a value, the points that count.
        """
        from labs.desk import checks, student_code  # noqa: PLC0415 - loads the grader

        here = [entry.name for entry in lecture.functions_of(self._begun()) if entry.role == "written"]
        names = [str(getattr(function, "__name__", function)) for function in functions]
        for name in names:
            if name not in lecture.FUNCTIONS:
                raise UnknownName("function of this lab", name, here)
        cells = student_code.executed_cells()
        unseen = [name for name in names or here if name not in student_code.defined_in(cells)]
        if unseen and (names or unseen == here):
            what = ", ".join(names and unseen) or "a function of this lab"
            print(f"No cell that defines {what} has been run since the kernel started (Run ▸ Run All Above).")
        for name in [name for name in student_code.vanished(cells) if name in (names or here)]:
            print(f"{name} is not there any more: deleted, or its cell ended in an error. The last one is checked.")
        with Progress("checking"):
            found = checks.check(self._notebook(), self._begun(), names, self._tests())
        print(found.said)
        _say_of_printing(name for name in student_code.printing(cells) if name in (names or here))
        return found.credit

    @_spoken
    def predict(
        self,
        key: str,
        question: str,
        answer: float | str | EllipsisType | None = None,
        unit: str = "",
        choices: Sequence[str] = (),
    ) -> None:
        """Keep what you expect, to be shown beside the result. It is not graded."""
        self._predictions[key] = predicted(key, question, answer, unit, choices)
        print(self._predictions[key])

    @_spoken
    def run(
        self,
        scenario: str,
        *,
        predicted: str | Sequence[str] = (),
        quantity: str | Sequence[str] = (),
        engines: Sequence[str] | None = None,
        profile: str = "tuned",
        timestep: float | None = None,
        **parameters: float,
    ) -> None:
        """Run a case with your functions and with engines: replay, curve, and numbers beside theory.

        predicted: the key of a prediction to show beside, or several. quantity: which numbers, all if none is named.
        engines: such as ("mujoco",), none if empty. profile: of your side, such as "stock", which answers at the end of
        a step. timestep: s, of all. Parameters of the scenario, such as restitution=0.3, instead of a case.
        """
        from labs.desk import case_runs, display, student_code, tables  # noqa: PLC0415
        from reference.catalogue.scenarios import find  # noqa: PLC0415 - a check needs no catalogue

        predictions = self._guesses(predicted)
        wanted = [quantity] if isinstance(quantity, str) else list(quantity)
        for name in wanted:
            find(scenario)[0].quantity(name)
        options = ("predicted", "quantity", *case_runs.OPTIONS)
        asked = self._ask(
            case_runs.Wanted(scenario, case_runs.named(engines), profile, timestep, parameters, options=options)
        )
        _display(*display.pictures(asked), tables.tables(asked, wanted, predictions))
        if asked.results[0].job.engine == case_runs.HANDWRITTEN:
            _say_of_printing(
                set(student_code.printing(student_code.executed_cells())) & set(asked.results[0].functions)
            )

    @_spoken
    def watch(
        self,
        scenario: str,
        *,
        engines: Sequence[str] | None = None,
        profile: str = "tuned",
        timestep: float | None = None,
        **parameters: float,
    ) -> None:
        """Show the replay of a run alone."""
        from labs.desk import case_runs, display, tables  # noqa: PLC0415

        asked = self._ask(case_runs.Wanted(scenario, case_runs.named(engines), profile, timestep, parameters))
        replay = display.replay(asked)
        _display(replay if replay is not None else tables.tables(asked, ()))

    @_spoken
    def sweep(
        self,
        scenario: str,
        parameter: str,
        values: Sequence[float] = (),
        *,
        predicted: str | Sequence[str] = (),
        quantity: str = "",
        engines: Sequence[str] | None = None,
        profile: str = "tuned",
    ) -> None:
        """Move one parameter of a scenario, or its timestep: a slider beside small pictures of every value."""
        from labs.desk import case_runs, sweeps  # noqa: PLC0415

        values, predictions = sweeps.values_of(scenario, parameter, values), self._guesses(predicted)
        wanted = case_runs.Wanted(scenario, case_runs.named(engines), profile, recorded=True)
        with Progress("running", len(values)) as progress:
            asked: list[Asked] = []
            for value in values:
                if parameter == sweeps.TIMESTEP:
                    each = replace(wanted, timestep=value)
                else:  # it stands in place of a case
                    each = replace(wanted, scenario=scenario.partition("/")[0], at={parameter: value})
                asked.append(case_runs.ask(each, self._hand()))
                progress.done(len(asked), len(values), f"{parameter} {value:g}")
        guesses = ", ".join(each.with_unit for each in predictions)
        found = sweeps.Sweep(parameter, tuple(values), tuple(asked), quantity, guesses)
        _display(found.picture, found.table)
        sweeps.slide(found)

    def _ask(self, wanted: Wanted) -> Asked:
        from labs.desk import case_runs  # noqa: PLC0415 - loads the catalogue

        with Progress("running") as progress:
            asked = case_runs.ask(wanted, self._hand(), progress.done)
        if asked.snapped:
            print(asked.snapped)
        return asked

    def _hand(self, cells: Sequence[str] | None = None) -> Hand:
        from labs.desk import student_code  # noqa: PLC0415

        beside = student_code.earlier_notebooks(self._begun(), Path.cwd())
        return student_code.in_hand(self._begun(), self._notebook(cells), beside)

    def _notebook(self, cells: Sequence[str] | None = None) -> Path:
        """The cells that were run, as a file."""
        from labs.desk import student_code  # noqa: PLC0415

        found = list(student_code.executed_cells() if cells is None else cells)
        return student_code.written_down([*found, "pass"])

    def _begun(self) -> str:
        if not self.topic:
            names = ", ".join(topic.name for topic in lecture.TOPICS)
            raise InvalidInput(f'which lab is this? Run the first cell, or lab.begin("…") with one of {names}')
        return self.topic

    def _guesses(self, keys: str | Sequence[str]) -> list[Prediction]:
        """The predictions of those keys that are made; of others it is said that they are not."""
        keys = [keys] if isinstance(keys, str) else list(keys)
        made = {key: each for key, each in self._predictions.items() if each.answer is not None}
        for key in [key for key in keys if key and key not in made]:
            print(f"There is no prediction {key!r} yet: guess first, in a cell above; it is the point of the run.")
        return [made[key] for key in keys if key in made]

    def _tests(self) -> Grader:
        """What runs the tests; started once, since it takes longer than a check."""
        if self._grader is None:
            from labs.grading.calling.remote import Grader  # noqa: PLC0415

            self._grader = Grader()
        return self._grader


def _say_of_printing(names: Iterable[str]) -> None:
    """Functions run in processes of their own: what they print is lost."""
    if printing := sorted(names):
        print(f"What {', '.join(printing)} prints is not shown here: call it in a cell of your own to see it.")


def _display(*shown: object) -> None:
    from IPython.display import display  # noqa: PLC0415 - the program has no notebook

    display(*shown)  # type: ignore[no-untyped-call]


lab = Lab()
"""What a notebook imports."""
