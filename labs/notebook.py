"""The desk of a course notebook: `from labs import lab`.

    lab.begin("detection")                    which engines are available, and which functions
    lab.predict("rest", "…?", answer=...)     a guess, kept for the run
    lab.derive("impulse_magnitude", j="…")    one line of a derivation, right or where it is wrong
    lab.hint("signed_distance")               the idea, then the next line, then the formula, then help with your code
    lab.figure("contact")                     a drawn figure
    lab.show(experiment, predicted="rest")    a function of the notebook, run after the prediction
    lab.check("signed_distance")              what was tried, what came, what physics expects
    lab.run("dropped-ball/e=0.5")             the same case with your functions and with engines
    lab.watch("dropped-ball/e=0.5")           the replay alone
    lab.numbers("late", e=(0.3, 0.5))         numbers of a question that are yours, once lab.student("…") has your name
    lab.expose("distance", point, normal, 2)  whether an input shows what is wrong with somebody else's function
    lab.mended("momenta", bounce)             whether you have found the bug of a program
    lab.sweep("dropped-ball", "restitution")  one parameter moved: where your method breaks, and where theirs does

Your functions run in processes of their own: a loop without end or a crash costs a line of text, and the kernel lives
on. Every call takes the functions as they are in the cells that you have run.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from labs.desk.guiding import Guiding, name_of
from labs.desk.hints import Text
from labs.desk.predicting import Predicting
from labs.desk.progress_line import Progress
from labs.desk.questions import Questions
from labs.desk.refusals import errors_in_words
from labs.grading.feedback.tries import Tries
from reference import lecture
from reference.errors import InvalidInput, UnknownName

if TYPE_CHECKING:
    from labs.desk.case_runs import CaseRuns, Request
    from labs.desk.student_code import StudentCode
    from labs.grading.calling.remote import Grader

logging.getLogger("reference").addHandler(logging.NullHandler())  # a table says what happened to a worker


class Lab(Guiding, Predicting, Questions):
    """One student at one notebook."""

    def __init__(self) -> None:
        super().__init__()
        self.topic = ""
        self._grader: Grader | None = None
        self._tries = Tries()
        self._paid: dict[str, str] = {}

    @errors_in_words
    def begin(self, topic: str) -> None:
        """Say which lab this is, which engines are available here, and which earlier functions were found."""
        from labs.desk import engine_status, page_style  # noqa: PLC0415

        self.topic = lecture.topic(topic).name
        page_style.shown()
        print(f"{lecture.topic(topic).title} ({self.topic})")
        for line in engine_status.answering():
            print(line)
        code = self._student_code([""])
        for notebook in dict.fromkeys(notebook for _, notebook in code.earlier):
            print(f"Yours from {notebook}: {', '.join(name for name, at in code.earlier if at == notebook)}")
        for complaint in code.complaints:
            print(complaint)
        if not code.package:
            print("Functions of other labs are not at hand: some runs will say what they need.")

    @errors_in_words
    def check(self, *functions: str | Callable[..., object]) -> float | None:
        """Check functions by name, or all of this lab: what was tried, what came, and what physics expects.

        A function that is changed and still wrong gets a hint, and then what its mistake is. It returns a value for
        nbgrader only: the points that count.
        """
        return self._check(functions)

    def _show(self, *shown: object) -> None:
        _display(*shown)

    def _written(self) -> list[str]:
        """The functions that a student of this lab writes."""
        return [entry.name for entry in lecture.functions_of(self._begun()) if entry.role == "written"]

    def _check(self, functions: Sequence[str | Callable[..., object]], hint: bool = False) -> float | None:
        from labs.desk import checks, student_code  # noqa: PLC0415 - loads the grader
        from labs.grading.submission import asked_predictions  # noqa: PLC0415

        here, names = self._written(), [name_of(function) for function in functions]
        for name in names:
            if name not in lecture.FUNCTIONS:
                raise UnknownName("function of this lab", name, here)
        cells = student_code.executed_cells()
        unseen = [name for name in names or here if name not in student_code.defined_in(cells)]
        if unseen and (names or unseen == here):
            what = ", ".join(names and unseen) or "a function of this lab"
            print(f"No cell that defines {what} has been run since the kernel started (Run ▸ Run All Above).")
        for name in [name for name in student_code.vanished_functions(cells) if name in (names or here)]:
            print(f"{name} is not there any more: deleted, or its cell ended in an error. The last one is checked.")
        notebook = self._notebook_file(student_code.without_outdone(cells))
        with Progress("checking"):
            found = checks.check(notebook, self._begun(), names, self._started_grader(), self._tries, self._paid, hint)
        print(found.report)
        _say_which_versions(names or here)
        if not names and (made := asked_predictions.in_words(asked_predictions.predictions_in(cells))):
            print(made)
        _warn_of_printing(name for name in student_code.functions_that_print(cells) if name in (names or here))
        return found.credit

    @errors_in_words
    def earlier(self, name: str) -> Callable[..., Any]:
        """A function of an earlier lab: yours, if its notebook lies beside this one, and otherwise a given one."""
        from reference.engines.implementation import Implementation  # noqa: PLC0415

        return Implementation(self._student_code([""]).source).function(lecture.function(name).name)

    @errors_in_words
    def run(
        self,
        scenario: str,
        *,
        predicted: str | Sequence[str] = (),
        quantity: str | Sequence[str] = (),
        engines: Sequence[str] | None = None,
        profile: str = "exact",
        timestep: float | None = None,
        unfold: bool = False,
        **parameters: float,
    ) -> None:
        """Run a case with your functions and with engines: replay, curve, and numbers beside theory.

        predicted: the key of a prediction to compare with the result, or several keys; the run stays folded until these
        predictions were made. unfold: whether to show it without them. quantity: which numbers; all if
        none is named. engines: such as ("mujoco",); no engine runs if it is empty. profile: the method of your code,
        such as "step", which responds at the end of a step. timestep: s, for all. Give parameters of the scenario,
        such as restitution=0.3, instead of a case.
        """
        from labs.desk import case_runs, display, student_code, tables  # noqa: PLC0415
        from reference.catalogue.scenarios import find  # noqa: PLC0415 - a check needs no catalogue

        wanted = [quantity] if isinstance(quantity, str) else list(quantity)
        for name in wanted:
            find(scenario)[0].quantity(name)
        options = ("predicted", "quantity", "unfold", *case_runs.OPTIONS)
        chosen = case_runs.chosen_engines(engines)
        predictions = self._predicted(predicted, unfold)
        if predictions is None:
            return
        runs = self._run_case(case_runs.Request(scenario, chosen, profile, timestep, parameters, options=options))
        theory = tables.theory(runs, wanted)
        verdicts = [Text(said) for each in predictions if (said := each.verdict(theory))]
        _display(*display.pictures(runs), tables.tables(runs, wanted, predictions), *verdicts)
        if runs.results[0].job.engine == case_runs.HANDWRITTEN:
            _say_which_versions(runs.results[0].functions)
            printing = student_code.functions_that_print(student_code.executed_cells())
            _warn_of_printing(set(printing) & set(runs.results[0].functions))

    @errors_in_words
    def watch(
        self,
        scenario: str,
        *,
        engines: Sequence[str] | None = None,
        profile: str = "exact",
        timestep: float | None = None,
        **parameters: float,
    ) -> None:
        """Show the replay of a run alone."""
        from labs.desk import case_runs, display, tables  # noqa: PLC0415

        chosen = case_runs.chosen_engines(engines)
        runs = self._run_case(case_runs.Request(scenario, chosen, profile, timestep, parameters))
        replay = display.replay(runs)
        _display(replay if replay is not None else tables.tables(runs, ()))
        _say_which_versions(runs.results[0].functions)

    @errors_in_words
    def sweep(
        self,
        scenario: str,
        parameter: str,
        values: Sequence[float] = (),
        *,
        predicted: str | Sequence[str] = (),
        quantity: str = "",
        engines: Sequence[str] | None = None,
        profile: str = "exact",
        unfold: bool = False,
    ) -> None:
        """Move one parameter of a scenario, or its timestep: a slider beside small pictures of every value."""
        from labs.desk import case_runs, sweep_picture, sweeps  # noqa: PLC0415

        values, predictions = sweeps.values_of(scenario, parameter, values), self._predicted(predicted, unfold)
        if predictions is None:
            return
        request = case_runs.Request(scenario, case_runs.chosen_engines(engines), profile, recorded=True)
        with Progress("running", len(values)) as progress:
            cases: list[CaseRuns] = []
            for value in values:
                if parameter == sweeps.TIMESTEP:
                    each = replace(request, timestep=value)
                else:  # the parameters take the place of a case
                    at = sweeps.point(scenario, parameter, value)
                    each = replace(request, scenario=scenario.partition("/")[0], at=at)
                cases.append(case_runs.run_case(each, self._student_code()))
                progress.done(len(cases), len(values), f"{parameter} {value:g}")
        guesses = ", ".join(each.with_unit for each in predictions if not each.verdict())
        found = sweeps.Sweep(parameter, tuple(values), tuple(cases), quantity, guesses)
        _display(sweep_picture.picture(found), found.table)
        sweeps.slide(found)
        _display(*(Text(said) for each in predictions if (said := each.verdict())))
        _say_which_versions(name for runs in cases for name in runs.results[0].functions)

    def _run_case(self, request: Request) -> CaseRuns:
        from labs.desk import case_runs  # noqa: PLC0415 - loads the catalogue

        with Progress("running") as progress:
            runs = case_runs.run_case(request, self._student_code(), progress.done)
        if runs.snapped:
            print(runs.snapped)
        return runs

    def _student_code(self, cells: Sequence[str] | None = None) -> StudentCode:
        from labs.desk import student_code  # noqa: PLC0415

        beside = student_code.earlier_notebooks(self._begun(), Path.cwd())
        return student_code.collect(self._begun(), self._notebook_file(cells), beside)

    def _notebook_file(self, cells: Sequence[str] | None = None) -> Path:
        """The cells that were run, or others, written to a file."""
        from labs.desk import student_code  # noqa: PLC0415

        found = list(student_code.executed_cells() if cells is None else cells)
        return student_code.write_notebook([*found, "pass"])

    def _begun(self) -> str:
        """The topic of the lab that was begun; refuses if none was."""
        if not self.topic:
            names = ", ".join(topic.name for topic in lecture.TOPICS)
            raise InvalidInput(f'which lab is this? Run the first cell, or lab.begin("…") with one of {names}')
        return self.topic

    def _started_grader(self) -> Grader:
        """The grader that runs the tests. It is started once, since that takes longer than a check."""
        if self._grader is None:
            from labs.grading.calling.remote import Grader  # noqa: PLC0415

            self._grader = Grader()
        return self._grader


def _say_which_versions(names: Iterable[str]) -> None:
    """Say of which functions an earlier version is in use, among some."""
    from labs.desk import student_code, versions  # noqa: PLC0415

    said = versions.earlier_versions(student_code.executed_cells())
    for name in dict.fromkeys(names):
        if name in said:
            print(said[name])


def _warn_of_printing(names: Iterable[str]) -> None:
    """Say that functions run in processes of their own, so that what they print is lost."""
    if printing := sorted(names):
        print(f"What {', '.join(printing)} prints is not shown here: call it in a cell of your own to see it.")


def _display(*shown: object) -> None:
    from IPython.display import display  # noqa: PLC0415 - the program has no notebook

    display(*shown)  # type: ignore[no-untyped-call]


lab = Lab()
"""The object that a notebook imports."""
