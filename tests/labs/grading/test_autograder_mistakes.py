"""Every known mistake loses points in the tests of its function, and what is right in other words loses none.

The tests run here, without a worker: what they ask is what matters. Every run tries all mistakes of a few functions,
`make verify` those of the others, and `make weekly` draws other examples. `-m "" -k impulse_magnitude` tries those of
one function. A failure lists the mistakes by name.
"""

from __future__ import annotations

import importlib
import os
import sys
from collections import defaultdict
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from known_mistakes import by_function
from tests_in_process import FOLDER, TOPICS, Asked, collected, loaded, loses_a_part, run_test

from labs.grading.calling.processes import Limits
from labs.grading.calling.remote import Grader, Remote
from labs.grading.diagnosis.fingerprints import known
from labs.grading.diagnosis.probes.one_case import one_case
from labs.grading.judging.case_by_case import CaseByCase
from labs.grading.judging.comparison import expect
from labs.grading.judging.plugin import Functions
from labs.grading.judging.same_answers import SameAnswers
from labs.grading.judging.score_sheet import Sheet
from labs.grading.submission.reading import Submission
from reference import lecture

WRITTEN = [entry for topic in TOPICS for entry in lecture.functions_of(topic) if entry.role == "written"]
MISTAKES = by_function()


def some(entries, start, step):
    """All functions as parameters; those that are not in the sample are slow."""
    sample = range(start, len(entries), step)
    return [
        pytest.param(entry, id=entry.name, marks=() if place in sample else pytest.mark.slow)
        for place, entry in enumerate(entries)
    ]


pytestmark = pytest.mark.filterwarnings("ignore::RuntimeWarning")  # wrong formulas divide by zero


@pytest.fixture(autouse=True)
def cache_folder():
    """No cache: nothing here runs a scenario in a worker."""


class Here:
    """A submission of some functions, called in this process; all others are the solutions'."""

    def __init__(self, **functions):
        self.functions, self.case_by_case, self.one_case = functions, CaseByCase(), one_case
        self.same_answers = defaultdict(SameAnswers)

    def process(self):
        def function(name):
            return lambda *arguments, **named: getattr(self, name)(*arguments, **named)

        own = SimpleNamespace(function=function)
        return SimpleNamespace(implementation=lambda: own, defines=lambda name: False)

    def __getattr__(self, name):
        solutions = importlib.import_module(f"solutions.{lecture.function(name).topic}")
        function = self.functions.get(name) or getattr(solutions, name)
        return Asked(name, function, self.case_by_case, self.same_answers[name])


TESTS = collected("visible", "hidden")
"""By function: folder, test and points."""


def asking(function, runs):
    """The tests of a function with their points; or without scenarios."""
    return [it[1:] for it in TESTS[function] if runs or "with_solutions" not in it[1].__code__.co_names]


def lost(function, submission, seed=1, runs=True):
    """The points that a submission loses in the tests of a function, and what was said; or without scenarios."""
    total, said = 0, []
    for test, points in asking(function, runs):
        missed, lines = run_test(test, points, submission, seed)
        total, said = total + missed, said + lines
    return total, said


def loses(function, formula, seed):
    """Whether a wrong formula loses points in the tests of its function; asks nothing more once it has.

    A scenario has no examples, so it is run only where these find nothing. That is another lab, since a lab may lose a
    part for several contacts in one call.
    """
    return any(
        loses_a_part(test, points, wrong, seed)
        for runs in (False, True)
        for wrong in [Here(**{function: formula})]
        for test, points in asking(function, runs)
    )


@pytest.mark.parametrize("entry", some(WRITTEN, 3, 6))
def test_a_solution_passes_the_visible_and_hidden_tests_it_has(entry):
    assert {folder for folder, *_ in TESTS[entry.name]} == {"visible", "hidden"}
    assert lost(entry.name, Here()) == (0, [])


def test_there_are_known_mistakes_of_every_function_that_students_write():
    assert MISTAKES.keys() == {entry.name for entry in WRITTEN}


def without_a_loss(function, seed):
    """The known mistakes of a function that lose no point with the examples of that seed."""
    return [each.id for each in MISTAKES[function] if not loses(function, each.formula, seed)]


@pytest.mark.parametrize("entry", some(WRITTEN, 5, 12))
def test_the_mistakes_of_a_function_lose_points(entry):
    assert without_a_loss(entry.name, seed=1) == []


@pytest.mark.weekly
@pytest.mark.parametrize("entry", WRITTEN, ids=lambda entry: entry.name)
def test_mistakes_alone_lose_points_with_any_examples(entry):
    for seed in (2, 3):
        assert without_a_loss(entry.name, seed) == [], seed
        assert lost(entry.name, Here(), seed, runs=False) == (0, []), seed


def earned(function, answer):
    """The points of a function that always returns the same."""
    here = Here(**{function: lambda *arguments, **named: answer})
    return sum(points - run_test(test, points, here)[0] for test, points in asking(function, runs=False))


@pytest.mark.parametrize("entry", some(WRITTEN, 7, 30))
def test_zeros_ones_infinities_nan_and_empty_arrays_earn_nothing(entry):
    first = next(right.outputs for right in known(entry.name).right if right)
    shapes = [tuple(array.shape for array in first), *([shape] * len(first) for shape in ((), (3,), (0,), (0, 3)))]
    for value in (0.0, 1.0, -1.0, np.inf, np.nan):
        for each in shapes:
            answer = tuple(np.full(shape, value) for shape in each)
            assert earned(entry.name, answer if len(answer) > 1 else answer[0]) == 0, answer


def speed(point):
    """The normal velocity, with the velocity of a body's point from a function of its own."""
    return lambda a, b, n: np.vecdot(point(*a[:3]) - point(*b[:3]), n)


def short_arms(velocity, angular_velocity, arm):
    return velocity + np.cross(angular_velocity, np.where(np.abs(arm) > 2.2, 0.0, arm))


@pytest.mark.parametrize(
    ("name", "wrong", "where"),
    [
        ("normal_velocity", speed(short_arms), "hidden"),
        ("normal_velocity", speed(lambda v, w, r: np.abs(v) + np.cross(w, r)), "visible"),
        ("normal_velocity", lambda a, b, n: np.abs(np.vecdot(a[0] - b[0], n)), "visible"),
    ],
)
def test_what_is_right_for_usual_numbers_alone_loses_points(name, wrong, where):
    tests = [(test, points) for folder, test, points in TESTS[name] if folder == where]
    assert sum(run_test(test, points, Here(**{name: wrong}))[0] for test, points in tests) > 0


EQUIVALENTS = loaded("equivalents", Path(__file__).parent / "diagnosis" / "test_equivalents.py")
"""The tests of the diagnosis, which know how to say the solutions in other words."""
ALTERNATIVES = {path.stem: EQUIVALENTS.handed_in(path) for path in EQUIVALENTS.alternatives()}
"""What other people wrote by hand: the functions of each file."""
BY_HAND = [entry for entry in WRITTEN if any(entry.name in space for space in ALTERNATIVES.values())]


@pytest.mark.parametrize("entry", some(BY_HAND, 0, 6))
def test_answers_by_hand_lose_no_point(entry):
    told = {file: lost_by_hand(file, entry) for file, space in ALTERNATIVES.items() if entry.name in space}
    assert not any(told.values()), told


def lost_by_hand(file, entry):
    """What is said to a file in the tests of a function."""
    space = ALTERNATIVES[file]
    written = {other.name: space[other.name] for other in WRITTEN if other.name in space}
    one_alone = file == "single"
    told = lost(entry.name, Here(**written), runs=not one_alone)[1]
    if one_alone:  # what asks for several contacts is all that is lost, as the runs do
        told = [line for line in told if "one call" not in line.split(":")[0] and "at once" not in line.split(":")[0]]
    return told


def as_lists(value):
    return tuple(map(as_lists, value)) if isinstance(value, tuple) else np.asarray(value).tolist()


def as_single_precision(value):
    return tuple(map(as_single_precision, value)) if isinstance(value, tuple) else np.asarray(value, dtype=np.float32)


@pytest.mark.parametrize("entry", some(WRITTEN, 2, 12))
def test_lists_and_single_precision_lose_no_point(entry):
    right = getattr(Here(), entry.name)
    for form in (as_lists, as_single_precision):
        answering = {entry.name: lambda *arguments, form=form, **named: form(right(*arguments, **named))}
        assert lost(entry.name, Here(**answering))[1] == [], form.__name__


def told_in_other_words(entry, kinds, runs=True):
    """What is said to a solution in other words, in the tests of its function with whole scenarios or without."""
    otherwise = EQUIVALENTS.said_otherwise(entry.name, kinds)
    here = Here(**{entry.name: lambda *arguments: otherwise(entry.name, *arguments)})
    return lost(entry.name, here, runs=runs)[1]


@pytest.mark.parametrize("entry", some(WRITTEN, 1, 12))
def test_a_solution_in_other_words_loses_no_point(entry):
    together = tuple(kind for kind in EQUIVALENTS.KINDS if kind not in ("sums", "single precision"))
    assert told_in_other_words(entry, together) == []


@pytest.mark.weekly
@pytest.mark.parametrize("entry", WRITTEN, ids=lambda entry: entry.name)
def test_a_solution_in_half_of_the_other_wordings_loses_no_point(entry):
    for kinds in EQUIVALENTS.EACH_IN_ONE_HALF:
        assert told_in_other_words(entry, kinds, runs=False) == [], kinds


# Hostile submissions, asked by the real tests


@pytest.fixture(scope="module")
def grader():
    with Grader(Limits(call=0.4, test=1.0)) as found:
        yield found


def rebound(u, e):
    return e * abs(u) if u < 0 else u


def hidden_test(submission, part, examples):
    """What the attacks are after: drawn examples, limits, and many at once of the function that each of them has."""

    def approaches(draw):
        return draw.number(-5, 2), draw.number(0.1, 0.9)

    with part(1, "any approach"):
        examples.agree(submission.rebound_velocity, rebound, approaches, count=20)
    with part(1, "grazing, no bounce, perfect bounce"):
        for u, e in ((0.0, 0.5), (-3.0, 0.0), (-3.0, 1.0), (3.0, 0.0), (3.0, 1.0), (0.25, 0.5)):
            expect(submission.rebound_velocity, (u, e), rebound(u, e))
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.rebound_velocity, rebound, approaches)


def hidden_points(text, grader):
    """What a submission of that text earns in the hidden test, of three points."""
    with Remote(Submission("hostile.py", text), grader) as remote:
        functions = Functions(remote, Sheet())
        try:
            return 3 - run_test(hidden_test, 3, functions)[0]
        finally:
            functions.end_test()


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere there is a time limit alone, and it says so")
@pytest.mark.parametrize("path", sorted(Path(__file__).parent.glob("hostile/*.py")), ids=lambda path: path.stem)
def test_an_attack_earns_no_hidden_point(path, grader, tmp_path):
    text = path.read_text(encoding="utf-8")
    for name, value in (("FOLDER", tmp_path), ("ROOT", FOLDER.parents[1]), ("GRADER", os.getpid()), ("PORT", 9)):
        text = text.replace("{" + name + "}", str(value))
    for name in ("SECRET", "RESULTS"):
        text = text.replace("{" + name + "}", str(tmp_path / name))
    assert hidden_points(text, grader) == 0
    right = "import numpy as np\ndef rebound_velocity(u, e): return np.where(np.asarray(u) < 0, -e * u, u)\n"
    assert hidden_points(right, grader) == 3
