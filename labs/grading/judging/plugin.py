"""A pytest plugin: tests call a submission's functions as if they were here, and are worth points.

    pytest tests/autograder --submission lab.ipynb

A test calls functions of the fixture `submission`, as in `submission.side_of_plane(-2.0, 0.5)`; each test has a
process of its own. Markers say what the test is worth: `points(3)`, or one point by default; `rationale("…")`, why it
asks; `help("…")`, what to look at. The fixture `part` gives points for a part: `with part(2, "the normal direction"):
assert …`; the test continues after it, and fails at the end. Properties (hypothesis) draw the same examples whenever
the same file is graded. Without `--submission` these tests are skipped. What was earned is in `config.stash[SHEET]`.
"""

from __future__ import annotations

import contextlib
import hashlib
import inspect
import sys
from collections.abc import Callable, Generator, Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest

from labs.grading.budget import Budget
from labs.grading.calling.remote import Grader, Remote
from labs.grading.errors import GraderFailed, StudentError, UnreadableSubmission
from labs.grading.judging.case_by_case import CaseByCase
from labs.grading.judging.examples import Examples
from labs.grading.judging.given_names import given_names
from labs.grading.judging.lent_functions import LostTest, lend
from labs.grading.judging.markers import MEANINGS, is_hidden, marker
from labs.grading.judging.outcomes import NOTHING_COMPUTED, explain, outcome_of, summary
from labs.grading.judging.parts import Parts, require_evidence
from labs.grading.judging.score_sheet import Part, Sheet
from labs.grading.judging.submitted_functions import Functions
from labs.grading.safe_text import one_line
from labs.grading.submission.opening import FILE_LIMIT
from labs.grading.submission.reading import read
from reference import lecture
from reference.errors import CollisionsError

SHEET = pytest.StashKey[Sheet]()
GRADER = pytest.StashKey[Grader]()
BUDGET = pytest.StashKey[Budget]()
PAID = pytest.StashKey[Mapping[str, str]]()
STOPPED = pytest.StashKey[CollisionsError]()
"""What was earned, what runs the tests, the time that the submission has, and why no test can be run.

The caller of pytest may provide a grader, and closes it afterwards. It may also provide a budget, which has run since
before the file was first read, and say which functions have paid for being right for one case alone (`CaseByCase`).
"""
_LOST = pytest.StashKey[list[LostTest]]()
_PARTS = pytest.StashKey[list[Part]]()


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add `--submission`."""
    group = parser.getgroup("grading")
    group.addoption("--submission", type=Path, metavar="FILE", help="the .ipynb or .py file that is graded")


def pytest_configure(config: pytest.Config) -> None:
    """Make the markers known; the grader gets ready while the tests are collected."""
    paid = config.stash.setdefault(PAID, {})
    config.stash[SHEET] = Sheet(case_by_case=CaseByCase(paid=dict(paid)))
    config.stash[_LOST] = []
    if config.getoption("--submission") and GRADER not in config.stash:
        config.stash[GRADER] = Grader()
        config.add_cleanup(config.stash[GRADER].close)
    for usage, meaning in MEANINGS.items():
        config.addinivalue_line("markers", f"{usage}: {meaning}")


def pytest_pycollect_makemodule(module_path: Path, parent: pytest.Collector) -> None:
    """Let the properties of a file depend on the submission only: no database, no deadline."""
    if parent.config.getoption("--submission") and b"hypothesis" in module_path.read_bytes():
        import hypothesis  # noqa: PLC0415 - takes as long to load as NumPy, and few files need it

        slow = [hypothesis.HealthCheck.too_slow]
        hypothesis.settings.register_profile(
            "grading", derandomize=True, deadline=None, report_multiple_bugs=False, suppress_health_check=slow
        )
        hypothesis.settings.load_profile("grading")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Check the points, and seed the properties from the submission, so that regrading gives the same points."""
    for item in _graded(items):
        if type(points := marker(item, "points", 1)) is not int or points < 0:
            raise pytest.UsageError(f"{item.nodeid}: points are a whole number, not {points!r}")
        test: Any = getattr(item, "obj", None)
        if (hypothesis := sys.modules.get("hypothesis")) and hypothesis.is_hypothesis_test(test):
            hypothesis.seed(_seed(item))(getattr(test, "__func__", test))


@pytest.fixture(scope="session")
def submission(request: pytest.FixtureRequest) -> Iterator[Functions]:
    """The functions of the file given by `--submission`."""
    config, path = request.config, request.config.getoption("--submission")
    if path is None:
        pytest.skip("give --submission FILE to grade one")
    topics = {item.path.stem.removeprefix("test_") for item in _graded(request.session.items)}
    wanted = [name for name, entry in lecture.FUNCTIONS.items() if entry.topic in topics and entry.role == "written"]
    budget = config.stash.setdefault(BUDGET, Budget(config.stash[GRADER].limits.submission))
    found = read(path, wanted, also=lecture.FUNCTIONS)
    sheet = config.stash[SHEET]
    sheet.submission, sheet.unread = found.name, found.unread
    sheet.given = given_names(topics) if found.starts else frozenset()
    sheet.complaints = list(found.complaints)
    with Remote(found, config.stash[GRADER], budget) as remote:
        yield Functions(remote, sheet)
        explain(sheet, found, remote)
        lost = config.stash[_LOST]
        if any(map(is_hidden, _graded(request.session.items))):  # it is marked; a check says what to mend first
            lend(sheet, lost, found, remote)
        sheet.complaints += remote.complaints


@pytest.fixture
def examples(request: pytest.FixtureRequest) -> Examples:
    """Inputs drawn for this test from the submission's text, and the test's own."""
    return Examples(_seed(request.node), shown=not is_hidden(request.node))


@pytest.fixture
def part(request: pytest.FixtureRequest) -> Callable[[int, str], contextlib.AbstractContextManager[None]]:
    """Points for a part of the test: a block that may fail without ending it."""
    parts = _parts_of(request.node, request.getfixturevalue("submission"))
    request.node.stash[_PARTS] = parts.found
    return parts


def _parts_of(item: pytest.Item, functions: Functions) -> Parts:
    return Parts(functions, item.name, marker(item, "function", ""), is_hidden(item))


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Generator[None, object, object]:
    """Fail a test that lost a part, and end its process."""
    given = getattr(item, "funcargs", {})
    functions, parts = given.get("submission"), given.get("part")
    try:
        result = yield
        if parts is not None:
            parts.take_back()
        lost = [each for each in _parts(item) if not each.passed]
        if lost:
            pytest.fail("\n".join(_told(lost)), pytrace=False)
        if isinstance(functions, Functions):
            require_evidence(item.name, functions)
        return result
    finally:
        if isinstance(functions, Functions):
            functions.end_test()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[None]
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Note what the test earned; report what the submission did wrong in a line, not with our own traceback."""
    report = yield
    error, sheet = call.excinfo.value if call.excinfo else None, item.config.stash[SHEET]
    if "submission" not in getattr(item, "fixturenames", ()):
        return report
    if report.skipped:
        sheet.skipped.append(str(error))
    else:
        if isinstance(error, CollisionsError):
            report.longrepr = one_line(str(error), 1000)
        if isinstance(error, GraderFailed | UnreadableSubmission):  # there is nothing to judge the student by
            item.session.shouldstop = one_line(str(error), 1000)
            item.config.stash[STOPPED] = error
        elif report.when == "call" or (report.when == "setup" and report.failed):
            if report.failed and marker(item, "function", ""):
                item.config.stash[_LOST].append(LostTest(len(sheet.outcomes), _again(item)))
            sheet.outcomes.append(outcome_of(item, report.passed, error, tuple(_parts(item))))
    return report


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    """Say what was lost and why, and the points."""
    summary(terminalreporter, config.stash[SHEET])


def _again(item: pytest.Item) -> Callable[[Functions], list[Part]]:
    """Runs a test once more with other functions, for its parts alone: no word of it is shown."""

    def run(functions: Functions) -> list[Part]:
        parts, test = _parts_of(item, functions), getattr(item, "obj")  # noqa: B009 - only a function's item has one
        given = {"submission": functions, "part": parts, "examples": Examples(_seed(item), shown=False)}
        try:
            test(**{name: given[name] for name in inspect.signature(test).parameters})
            parts.take_back()
            return parts.found
        except (AssertionError, StudentError, *NOTHING_COMPUTED):  # outside of all parts
            return []
        finally:
            functions.end_test()

    return run


def _seed(item: pytest.Item) -> int:
    """The seed of the examples, made from the submission's text and from the file of the test.

    The file of a hidden test keeps students from changing a comment until no example meets the mistake.
    """
    path: Path | None = item.config.getoption("--submission")
    if path is None or not path.is_file():
        return 0
    drawn = hashlib.sha256(item.path.read_bytes())
    with path.open("rb") as file:  # no more of it than a submission may have
        drawn.update(file.read(FILE_LIMIT))
    return int.from_bytes(drawn.digest()[:8])


def _graded(items: list[pytest.Item]) -> list[pytest.Item]:
    return [item for item in items if "submission" in getattr(item, "fixturenames", ())]


def _told(lost: list[Part]) -> Iterator[str]:
    """The parts that were lost, with what was said of each; equal words are said once."""
    for words in dict.fromkeys(part.said for part in lost):
        yield f"{'; '.join(part.reason for part in lost if part.said == words)}: {words}"


def _parts(item: pytest.Item) -> list[Part]:
    return item.stash.setdefault(_PARTS, [])
