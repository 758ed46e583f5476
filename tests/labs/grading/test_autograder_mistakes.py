"""Every known mistake loses points in the tests of its function, and what is right in other words loses none.

The tests run here, without a worker: what they ask is what matters.
"""

from __future__ import annotations

import contextlib
import importlib
import importlib.util
import os
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from labs.grading.calling.processes import Limits
from labs.grading.calling.remote import Grader, Remote
from labs.grading.diagnosis.misconceptions import read_bank
from labs.grading.diagnosis.recognition import diagnose
from labs.grading.feedback.report import report
from labs.grading.judging.examples import Examples
from labs.grading.judging.plugin import Functions
from labs.grading.judging.score_sheet import Outcome, Sheet
from labs.grading.submission.reading import Submission
from reference import lecture
from reference.errors import CollisionsError

FOLDER = Path(__file__).parents[2] / "autograder"
TOPICS = ("detection", "response", "friction", "impulse")
WRITTEN = [entry for topic in TOPICS for entry in lecture.functions_of(topic) if entry.role == "written"]
BANK = read_bank()
pytestmark = pytest.mark.filterwarnings("ignore::RuntimeWarning")  # wrong formulas divide by zero


class Here:
    """A submission of some functions, called in this process; all others are the solutions'."""

    def __init__(self, **functions):
        self.functions = functions

    def process(self):
        def function(name):
            return lambda *arguments, **named: getattr(self, name)(*arguments, **named)

        own = SimpleNamespace(function=function)
        return SimpleNamespace(implementation=lambda: own, defines=lambda name: False)

    def __getattr__(self, name):
        solutions = importlib.import_module(f"solutions.{lecture.function(name).topic}")
        return Asked(name, self.functions.get(name) or getattr(solutions, name))


class Asked:
    def __init__(self, name, function):
        self.name, self.function = name, function
        self.functions = SimpleNamespace(process=lambda: SimpleNamespace(changed=self.changed, printed=""))

    def __call__(self, *arguments, **named):
        before = repr(arguments)
        try:
            answer = self.function(*arguments, **named)
        except Exception as error:
            raise AssertionError(f"raised {error!r}") from None
        self.changed = repr(arguments) != before
        return answer

    def foresee(self, several):
        pass


def collected():
    found = {}
    for folder in ("visible", "hidden"):
        for topic in TOPICS:
            path = FOLDER / folder / f"test_{topic}.py"
            spec = importlib.util.spec_from_file_location(f"{folder}_{topic}", path)
            module = importlib.util.module_from_spec(spec)
            spec.loader.exec_module(module)
            for name, test in vars(module).items():
                marks = {mark.name: mark.args for mark in getattr(test, "pytestmark", ())} if callable(test) else {}
                if name.startswith("test_") and "function" in marks:
                    found.setdefault(marks["function"][0], []).append((folder, test, marks["points"][0]))
    return found


TESTS = collected()
"""By function: folder, test and points."""


def lost(function, submission, seed=1, runs=True):
    """The points that a submission loses in the tests of a function, and what was said; or without scenarios."""
    total, said = 0, []
    for _, test, points in TESTS[function]:
        if not runs and "with_solutions" in test.__code__.co_names:
            continue
        missed, told = run_test(test, points, submission, seed)
        total, said = total + missed, said + told
    return total, said


def run_test(test, points, submission, seed=1):
    """The points that a submission loses in one test, and what was said."""
    said, earned = [], []

    @contextlib.contextmanager
    def part(worth, reason):
        try:
            yield
        except (AssertionError, CollisionsError) as error:
            said.append(f"{reason}: {error}")
        else:
            earned.append(worth)

    given = {"submission": submission, "part": part, "examples": Examples(seed, shown=False)}
    test(**{name: given[name] for name in test.__code__.co_varnames[: test.__code__.co_argcount]})
    return points - sum(earned), said


def test_every_function_that_a_student_writes_has_visible_and_hidden_tests():
    for entry in WRITTEN:
        assert {folder for folder, *_ in TESTS[entry.name]} == {"visible", "hidden"}, entry.name


@pytest.mark.parametrize("topic", TOPICS)
def test_the_solutions_lose_no_point(topic):
    for entry in lecture.functions_of(topic):
        if entry.role == "written":
            assert lost(entry.name, Here()) == (0, [])


def unnamed(bank):
    """The entries whose rationale is not in what a student reads."""
    found = []
    for entry in bank:
        sheet = Sheet(outcomes=[Outcome("test_x", 1, False, said="wrong", function=entry.function)])
        sheet.diagnoses[entry.function] = diagnose(entry.function, lambda _, *given, own=entry: own.formula(*given))
        told = " ".join("\n".join(report(sheet, [lecture.function(entry.function).topic])).split())
        if entry.rationale not in told or entry.help not in told:
            found.append(entry.id)
    return found


def test_mistakes_are_named_in_the_feedback():
    assert unnamed(BANK[::24]) == []


@pytest.mark.slow
def test_every_mistake_is_named_in_the_feedback():
    assert unnamed(BANK) == []


def unpunished(bank):
    return [entry.id for entry in bank if not lost(entry.function, Here(**{entry.function: entry.formula}))[0]]


def test_mistakes_lose_points():
    assert unpunished(BANK[5::16]) == []


@pytest.mark.slow
def test_every_mistake_loses_points():
    assert unpunished(BANK) == []


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2, 5))
def test_every_mistake_loses_points_whatever_the_examples(seed):
    def still(entry):
        return lost(entry.function, Here(**{entry.function: entry.formula}), seed)[0]

    assert [entry.id for entry in BANK if not still(entry)] == []
    assert [entry.name for entry in WRITTEN if lost(entry.name, Here(), seed)[0]] == []


@pytest.mark.parametrize("path", sorted((FOLDER / "alternatives").glob("*.py")), ids=lambda path: path.stem)
def test_other_answers_by_hand_lose_no_point(path):
    space = {}
    exec(compile(path.read_text(encoding="utf-8"), path, "exec"), space)
    written = {entry.name: space[entry.name] for entry in WRITTEN if entry.name in space}
    one_alone = path.stem == "single"
    told = [line for name in written for line in lost(name, Here(**written), runs=not one_alone)[1]]
    if one_alone:  # what asks for several contacts is all that is lost, as the runs do
        told = [line for line in told if "one call" not in line.split(":")[0] and "at once" not in line.split(":")[0]]
    assert told == []


def as_lists(value):
    return tuple(map(as_lists, value)) if isinstance(value, tuple) else np.asarray(value).tolist()


def as_single_precision(value):
    return tuple(map(as_single_precision, value)) if isinstance(value, tuple) else np.asarray(value, dtype=np.float32)


def told_of(entries, said):
    """What is said to the solutions' own answers in another form."""

    def answering(name):
        right = getattr(Here(), name)
        return lambda *arguments, **named: said(right(*arguments, **named))

    return [line for entry in entries for line in lost(entry.name, Here(**{entry.name: answering(entry.name)}))[1]]


@pytest.mark.parametrize("form", [as_lists, as_single_precision])
def test_lists_and_single_precision_lose_no_point(form):
    assert told_of(WRITTEN[2::5], form) == []


@pytest.mark.slow
@pytest.mark.parametrize("form", [as_lists, as_single_precision])
def test_lists_and_single_precision_of_every_function_lose_no_point(form):
    assert told_of(WRITTEN, form) == []


def equivalents():
    """How the diagnosis' own tests say the solutions in other words."""
    path = Path(__file__).parent / "diagnosis" / "test_diagnosis_equivalents.py"
    spec = importlib.util.spec_from_file_location("equivalents", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def told_of_rewritten(entries, kinds):
    otherwise, told = equivalents().said_otherwise, []
    for entry in entries:
        said = otherwise(entry.name, kinds)
        function = {entry.name: lambda *arguments, said=said, name=entry.name: said(name, *arguments)}
        told += lost(entry.name, Here(**function))[1]
    return told


def test_the_solutions_in_other_words_lose_no_point():
    assert told_of_rewritten(WRITTEN[1::7], ["commuted", "differences turned", "branches turned", "roots"]) == []


@pytest.mark.slow
def test_each_way_of_saying_the_solutions_in_other_words_loses_no_point():
    for kind in equivalents().KINDS:
        if kind != "single precision":  # of which there is a test of its own
            assert told_of_rewritten(WRITTEN, [kind]) == []


# Hostile submissions, asked by the real tests


@pytest.fixture(scope="module")
def grader():
    with Grader(Limits(call=0.4, test=1.0)) as found:
        yield found


def hidden_points(text, grader):
    """What a submission of that text earns in the hidden tests of rebound_velocity, and what is to be earned."""
    earned = possible = 0
    for folder, test, points in TESTS["rebound_velocity"]:
        if folder == "hidden":
            with Remote(Submission("hostile.py", text), grader) as remote:
                functions = Functions(remote, Sheet())
                try:
                    lost_here, _ = run_test(test, points, functions)
                finally:
                    functions.end_test()
            earned, possible = earned + points - lost_here, possible + points
    return earned, possible


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere there is a time limit alone, and it says so")
@pytest.mark.parametrize("path", sorted(Path(__file__).parent.glob("hostile/*.py")), ids=lambda path: path.stem)
def test_an_attack_earns_no_hidden_point(path, grader, tmp_path):
    text = path.read_text(encoding="utf-8")
    for name, value in (("FOLDER", tmp_path), ("ROOT", FOLDER.parents[1]), ("GRADER", os.getpid()), ("PORT", 9)):
        text = text.replace("{" + name + "}", str(value))
    for name in ("SECRET", "RESULTS"):
        text = text.replace("{" + name + "}", str(tmp_path / name))
    assert hidden_points(text, grader)[0] == 0
    right = "import numpy as np\ndef rebound_velocity(u, e): return np.where(np.asarray(u) < 0, -e * u, u)\n"
    assert hidden_points(right, grader) == (3, 3)
