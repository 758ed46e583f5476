"""A pytest plugin: tests call a submission's functions as if they were here, and are worth points.

    pytest tests/autograder --submission lab.ipynb

A test asks the fixture `submission`, `submission.rebound_velocity(-2.0, 0.5)`; each test has a process of its own.
Markers say what it is worth: `points(3)`, one where nothing is said; `rationale("…")`, why it asks; `help("…")`, what
to look at. The fixture `part` gives points for a part: `with part(2, "the normal direction"): assert …`; the test goes
on after it, and fails in the end. Properties (hypothesis) draw the same examples whenever the same file is graded.
Without `--submission` these tests are skipped. What was earned is in `config.stash[SHEET]`.
"""

from __future__ import annotations

import contextlib
import hashlib
import re
import sys
from collections.abc import Callable, Generator, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from labs.grading.diagnosis import diagnose
from labs.grading.errors import FunctionMissing, GraderFailed, StudentError, UnreadableSubmission
from labs.grading.examples import Examples
from labs.grading.files import FILE_LIMIT
from labs.grading.plain import one_line, plain
from labs.grading.remote import Call, Grader, Remote
from labs.grading.sheet import Outcome, Part, Sheet
from labs.grading.submission import read
from reference import lecture
from reference.errors import CollisionsError, UnknownName

SHEET = pytest.StashKey[Sheet]()
GRADER = pytest.StashKey[Grader]()
"""What was earned, and what runs the tests; whoever starts pytest may put a grader there, and closes it then."""
_PARTS = pytest.StashKey[list[Part]]()
_LINES = 8  # of what a failed assertion says
_OBVIOUS = tuple(f"{name} = submission.{name}" for name in lecture.FUNCTIONS)  # as pytest adds it
_MARKERS = {
    "points(n)": "what the test is worth, a whole number",
    "function(name)": "which function it is about; where a test of it fails, the feedback says what is wrong with it",
    "rationale(text)": "why a submission has to pass it",
    "help(text)": "what a student should look at",
}


@dataclass(frozen=True)
class Function:
    """One function, which reads in pytest's own words as a student writes it: `rebound_velocity(-2.0, 0.5)`."""

    functions: Functions
    name: str

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        """Call it in the process of the test that runs."""
        return self.functions.process()(self.name, *arguments, **named)

    def foresee(self, several: Iterable[tuple[Any, ...]]) -> None:
        """Say which calls of it come next, so that its process can work ahead."""
        self.functions.process().foresee(self.name, several)

    def __repr__(self) -> str:
        return self.name


class Functions:
    """A submission's functions as attributes; each test has a process of its own, from its first call on."""

    def __init__(self, remote: Remote, sheet: Sheet) -> None:
        self._remote, self._sheet = remote, sheet
        self._test = contextlib.ExitStack()
        self._call: Call | None = None

    def __getattr__(self, name: str) -> Function:
        if name.startswith("_"):
            raise AttributeError(name)
        return Function(self, name)

    def __repr__(self) -> str:
        return "submission"

    def process(self) -> Call:
        """The process of the test that runs, for what is more than a call: `steady`, `changed`, `implementation`."""
        if self._call is None:
            self._call = self._test.enter_context(self._remote.fresh())
            if self._call.sealing:  # where it does not load, later tests have no process
                self._sheet.tier = self._call.sealing.tier.title
        return self._call

    def end_test(self) -> None:
        """End the test's process."""
        self._call = None
        self._test.close()


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add `--submission`."""
    group = parser.getgroup("grading")
    group.addoption("--submission", type=Path, metavar="FILE", help="the .ipynb or .py file that is graded")


def pytest_configure(config: pytest.Config) -> None:
    """Make the markers known; the grader gets ready while the tests are collected."""
    config.stash[SHEET] = Sheet()
    if config.getoption("--submission") and GRADER not in config.stash:
        config.stash[GRADER] = Grader()
        config.add_cleanup(config.stash[GRADER].close)
    for marker, meaning in _MARKERS.items():
        config.addinivalue_line("markers", f"{marker}: {meaning}")


def pytest_pycollect_makemodule(module_path: Path, parent: pytest.Collector) -> None:
    """Let the properties of a file depend on nothing but the submission: no database, no deadline."""
    if parent.config.getoption("--submission") and b"hypothesis" in module_path.read_bytes():
        import hypothesis  # noqa: PLC0415 - takes as long to load as NumPy, and few files need it

        slow = [hypothesis.HealthCheck.too_slow]
        hypothesis.settings.register_profile(
            "grading", derandomize=True, deadline=None, report_multiple_bugs=False, suppress_health_check=slow
        )
        hypothesis.settings.load_profile("grading")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Check the points, and seed the properties from the submission, so that regrading gives the same marks."""
    for item in _graded(items):
        if type(points := _marker(item, "points", 1)) is not int or points < 0:
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
    found = read(path, wanted, also=lecture.FUNCTIONS)
    sheet = config.stash[SHEET]
    sheet.submission, sheet.complaints = found.name, [str(complaint) for complaint in found.complaints]
    with Remote(found, config.stash[GRADER]) as remote:
        yield Functions(remote, sheet)
        for name in sheet.lost:
            with contextlib.suppress(UnknownName), remote.fresh() as call:  # of a function that has no probes yet
                sheet.diagnoses[name] = diagnose(name, call)


@pytest.fixture
def examples(request: pytest.FixtureRequest) -> Examples:
    """Inputs drawn for this test from the submission's text, and the test's own."""
    return Examples(_seed(request.node), told=not _is_hidden(request.node))


@pytest.fixture
def part(request: pytest.FixtureRequest) -> Callable[[int, str], contextlib.AbstractContextManager[None]]:
    """Points for a part of the test: a block that may fail without ending it."""
    parts = _parts(request.node)

    @contextlib.contextmanager
    def worth(points: int, reason: str) -> Iterator[None]:
        try:
            yield
        except (AssertionError, StudentError) as error:
            parts.append(Part(points, reason, _said(error, _is_hidden(request.node))))
        else:
            parts.append(Part(points, reason))

    return worth


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Generator[None, object, object]:
    """Fail a test that lost a part, and end its process."""
    try:
        result = yield
        lost = [each for each in _parts(item) if not each.passed]
        if lost:
            pytest.fail("\n".join(f"{each.reason}: {each.said}" for each in lost), pytrace=False)
        return result
    finally:
        functions = getattr(item, "funcargs", {}).get("submission")
        if isinstance(functions, Functions):
            functions.end_test()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[None]
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Note what the test earned; what the submission did wrong is told in a line, not as our own traceback."""
    report = yield
    error = call.excinfo.value if call.excinfo else None
    if "submission" in getattr(item, "fixturenames", ()) and not report.skipped:
        if report.failed and isinstance(error, CollisionsError):
            report.longrepr = one_line(str(error), 1000)
        if isinstance(error, GraderFailed):
            item.session.shouldstop = one_line(str(error), 1000)  # our fault is not to cost the student's points
        elif report.when == "call" or (report.when == "setup" and report.failed):
            item.config.stash[SHEET].outcomes.append(_outcome(item, report.passed, error))
    return report


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    """For the student: what is wrong with the file, what each lost test is about, and the points."""
    sheet = config.stash[SHEET]
    if not sheet.outcomes:
        return
    write = terminalreporter.write_line
    terminalreporter.section(sheet.submission or "no submission")
    for complaint in sheet.complaints:
        write(complaint)
    for outcome in sheet.outcomes:
        if not outcome.passed:
            write("\n    ".join(line for lines in outcome.lines() for line in lines.splitlines()))
    for diagnosis in sheet.diagnoses.values():
        write(str(diagnosis))
    write(f"{sheet.earned} of {sheet.points} points ({sheet.tier or 'not run'})")


def _seed(item: pytest.Item) -> int:
    """What examples are drawn with: a number made of the submission's text and of the file of the test.

    The second is for hidden tests: else a student could change a comment until no example meets the mistake.
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


def _parts(item: pytest.Item) -> list[Part]:
    return item.stash.setdefault(_PARTS, [])


def _outcome(item: pytest.Item, passed: bool, error: BaseException | None) -> Outcome:
    hidden, parts = _is_hidden(item), tuple(_parts(item))
    return Outcome(
        test=item.name,
        points=_marker(item, "points", 1),
        passed=passed,
        hidden=hidden,
        said="" if passed or any(not part.passed for part in parts) else _said(error, hidden),
        rationale=_marker(item, "rationale", ""),
        help=_marker(item, "help", ""),
        parts=parts,
        function=_marker(item, "function", ""),
    )


def _said(error: BaseException | None, hidden: bool) -> str:
    """What may be told of a failure, never nothing: a part of which nothing is said has passed.

    A hidden test keeps its numbers, and what the submission could make of them.
    """
    if hidden and isinstance(error, StudentError):
        return f"the function {error.gist}"
    if hidden and not isinstance(error, UnreadableSubmission):  # what a driver says may hold numbers
        return "the answer is wrong"
    lines = [line.strip() for line in plain(str(error), 1000).splitlines()]
    ours = not isinstance(error, StudentError)  # a submission may say what pytest says
    kept = [line for line in lines if line and not (ours and line.endswith(_OBVIOUS))][:_LINES]
    notes = [] if isinstance(error, FunctionMissing) else getattr(error, "__notes__", [])
    said = [*kept, *(f"for {example}" for note in notes if (example := _example(note)))]
    return "\n".join(said) or "the answer is wrong"


def _example(note: str) -> str:
    """The arguments of the smallest example that hypothesis found, as it notes them, one a line."""
    arguments = re.findall(r"^ {4}(\w+=.*?),?(?:  #.*)?$", plain(note, 1000), re.MULTILINE)
    return ", ".join(argument for argument in arguments if argument != "submission=submission")


def _is_hidden(item: pytest.Item) -> bool:
    return "hidden" in item.path.parts


def _marker(item: pytest.Item, name: str, otherwise: Any) -> Any:
    marker = item.get_closest_marker(name)
    return marker.args[0] if marker and marker.args else otherwise
