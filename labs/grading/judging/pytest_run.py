"""Runs the tests of topics on a file, in this process; returns what was found and prints nothing."""

from __future__ import annotations

import contextlib
import importlib.util
import io
import os
from collections.abc import Collection, Iterable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

from labs.grading.budget import Budget
from labs.grading.calling.remote import Grader
from labs.grading.errors import GraderFailed, UnreadableSubmission
from labs.grading.submission.reading import Submission, read
from labs.project_folders import AUTOGRADER
from reference import lecture
from reference.errors import CollisionsError, InvalidInput

if TYPE_CHECKING:
    import pytest

    from labs.grading.judging.score_sheet import Sheet

VISIBLE, HIDDEN = "visible", "hidden"
_UNUSED = (
    "cacheprovider", "debugging", "doctest", "faulthandler", "junitxml", "legacypath", "logging", "pastebin",
    "setuponly", "setupplan", "stepwise", "subtests", "threadexception", "unraisableexception",
)  # fmt: skip
"""Parts of pytest that are left out: registering each takes time for every submission.

In a notebook the tests run in the kernel. What goes wrong in its other threads is no mistake of the student's.
"""
_OPTIONS = (
    "-q", "--noconftest", "--disable-plugin-autoload", "-p", "labs.grading.judging.plugin",
    *(option for name in _UNUSED for option in ("-p", f"no:{name}")),
    "--import-mode=importlib", "--strict-markers", "-W", "error",
)  # fmt: skip
"""Only the tests and the plugin: other plugins and the settings of the project's own tests would take time."""
_FINE = (0, 1)  # all tests passed, some failed
_TAIL = 400  # characters of what pytest printed, where it could not run


def run(
    path: Path | str,
    topics: Collection[str],
    folders: Iterable[str] = (VISIBLE, HIDDEN),
    grader: Grader | None = None,
    functions: Collection[str] = (),
    budget: Budget | None = None,
    paid: Mapping[str, str] | None = None,
) -> Sheet:
    """Run the tests of some topics on a file. No process of the submission is left when this returns.

    functions: those to test; all if none is named. If one of them is wrong, the functions that it calls are tested as
    well by the visible tests, without points. Without a grader it makes its own, which gets ready while pytest loads.
    budget: the time that is left to the submission; without one, it has the whole time of the grader's limits. paid: of
    each topic, the function that has lost a part already because it is right for one case alone.

    Raises
    ------
    UnreadableSubmission
        If the file is missing, or holds nothing that can be read.
    InvalidInput
        If a topic has no tests.
    GraderFailed
        If the tests or pytest are missing, if pytest could not run the tests, or if a test's process failed for no
        fault of the submission.
    """
    _require_tests()
    if importlib.util.find_spec("pytest") is None:
        raise GraderFailed('the tests need pytest: pip install -e ".[dev]"')
    files = [str(file) for folder in folders for file in _files(folder, topics)]
    with Grader() if grader is None else contextlib.nullcontext(grader) as found:
        time = budget or Budget(found.limits.submission)
        sheet = _run(Path(path), files, found, functions, time, paid or {})
        beside = {name for outcome in sheet.outcomes for part in outcome.parts for name in part.others}
        names = [*sheet.lost, *sheet.suspects, *beside]
        if functions and (used := _used(path, topics, names) - set(functions)):
            sheet.add_beneath(_run(Path(path), [str(file) for file in _files(VISIBLE, topics)], found, used, time))
        time.refuse_if_cut()  # the diagnosis goes without probes that no process can answer
        return sheet


def _used(path: Path | str, topics: Collection[str], names: Collection[str]) -> set[str]:
    """Some functions of a file, and all functions of the topics that these call, directly or through others."""
    with contextlib.suppress(UnreadableSubmission):  # the file was changed since its tests ran
        submission = read(path, [entry.name for topic in topics for entry in _written(topic)])
        waiting, seen = list(names), set(names)
        while waiting:
            found = set(submission.uses(waiting.pop())) - seen
            seen |= found
            waiting += found
        return seen
    return set()


def _run(
    path: Path,
    files: list[str],
    grader: Grader,
    functions: Collection[str],
    budget: Budget,
    paid: Mapping[str, str] = MappingProxyType({}),
) -> Sheet:
    import pytest  # noqa: PLC0415 - a student's install may lack it

    from labs.grading.judging.plugin import BUDGET, GRADER, PAID, SHEET, STOPPED  # noqa: PLC0415

    class Keep:
        sheet: Sheet | None = None
        broken = ""
        stopped: BaseException | None = None
        why: CollisionsError | None = None

        @pytest.hookimpl(tryfirst=True)
        def pytest_configure(self, config: pytest.Config) -> None:
            config.stash[GRADER], config.stash[BUDGET], config.stash[PAID] = grader, budget, paid

        def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
            items[:] = [item for item in items if not functions or _about(item) in functions]

        def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
            if report.when == "teardown" and report.failed:  # not the submission's fault: pytest counts it as failed
                self.broken = report.longreprtext

        def pytest_keyboard_interrupt(self, excinfo: pytest.ExceptionInfo[BaseException]) -> None:
            self.stopped = excinfo.value

        def pytest_unconfigure(self, config: pytest.Config) -> None:
            self.sheet, self.why = config.stash[SHEET], config.stash.get(STOPPED, None)

    keep, printed = Keep(), io.StringIO()
    options = [*_OPTIONS, "-c", os.devnull, "--rootdir", str(AUTOGRADER.parent), "--confcutdir", str(AUTOGRADER)]
    options += [
        "-W",
        "ignore::pytest.PytestAssertRewriteWarning",
    ]  # the plugin may be loaded already; it has no asserts
    with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
        code = pytest.main([*options, "--submission", str(path.absolute()), *files], plugins=[keep])
    if isinstance(keep.stopped, KeyboardInterrupt) and not isinstance(keep.stopped, pytest.Session.Interrupted):
        raise KeyboardInterrupt
    if keep.why:
        raise keep.why.with_traceback(None)
    if keep.stopped:
        raise GraderFailed(str(keep.stopped))
    if code not in _FINE or keep.broken or keep.sheet is None or not keep.sheet.outcomes:
        raise GraderFailed(f"the tests could not be run: {(keep.broken or printed.getvalue()).strip()[-_TAIL:]}")
    return keep.sheet


def _about(item: pytest.Item) -> str:
    marker = item.get_closest_marker("function")
    return str(marker.args[0]) if marker else ""


def tested() -> tuple[str, ...]:
    """The topics that have tests, in the order of teaching."""
    return tuple(topic.name for topic in lecture.TOPICS if (AUTOGRADER / VISIBLE / f"test_{topic.name}.py").exists())


def topics_of(path: Path | str) -> tuple[Submission, tuple[str, ...]]:
    """Read a file, and name the topics of which it defines a function that students write, readable or not.

    Raises
    ------
    UnreadableSubmission, GraderFailed
        If the file holds no code, or if the tests are missing.
    """
    _require_tests()
    submission = read(path, [entry.name for topic in tested() for entry in _written(topic)])
    found = {lecture.function(name).topic for name in (*submission.functions, *submission.unread)}
    return submission, tuple(topic for topic in tested() if topic in found)


def _require_tests() -> None:
    if not (AUTOGRADER / VISIBLE).is_dir():
        raise GraderFailed(
            "the tests are missing: this is an installed copy of the lab without its folder tests/autograder; check"
            " with the folder of the course, where the lab is installed by pip install -e ."
        )


def _written(topic: str) -> list[lecture.Function]:
    """The functions of a topic that students write."""
    return [entry for entry in lecture.functions_of(topic) if entry.role == "written"]


def _files(folder: str, topics: Collection[str]) -> list[Path]:
    """The test files of a folder; a student's tree has no hidden ones."""
    files = {lecture.topic(topic).name: AUTOGRADER / folder / f"test_{topic}.py" for topic in topics}
    missing = [topic for topic, file in files.items() if not file.exists()]
    if missing and folder == VISIBLE:
        raise InvalidInput(f"no tests of {', '.join(missing)}; there are tests of {', '.join(tested())}")
    return [file for file in files.values() if file.exists()]
