from __future__ import annotations

import pickle
import sys
import textwrap

import numpy as np
import pytest

import solutions.detection
from reference.engines.implementation import Implementation
from reference.errors import InvalidInput, NeedsFunction, UnknownName
from reference.running.isolate import run_isolated, stop_workers

HANDED_IN = """
    def signed_distance(point, normal, offset):
        return "mine"

    def time_of_impact_exact(separation, normal_velocity, normal_acceleration):
        raise NotImplementedError

    def kinematic_response(velocity, normal, restitution):
        raise ZeroDivisionError("my own mistake")

    side_of_plane = "not a function"
"""


@pytest.fixture
def handed_in(tmp_path):
    """Write a student's file and return its path."""

    def write(text: str = HANDED_IN, name: str = "mine.py") -> str:
        path = tmp_path / name
        path.write_text(textwrap.dedent(text), encoding="utf-8")
        return str(path)

    return write


@pytest.fixture
def package(tmp_path, monkeypatch):
    """Write a package of one topic and return its name."""

    def write(topic: str, text: str) -> str:
        name = f"package_{tmp_path.name}".replace("-", "_")
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").touch()
        (tmp_path / name / f"{topic}.py").write_text(textwrap.dedent(text), encoding="utf-8")
        monkeypatch.syspath_prepend(tmp_path)
        return name

    yield write
    for name in [name for name in sys.modules if name.startswith("package_")]:
        del sys.modules[name]


def test_the_solutions_are_the_default_implementation():
    distance = Implementation().function("signed_distance")
    assert distance((0.0, 0.0, 3.0), (0.0, 0.0, 2.0), offset=-2.0) == 2.0
    assert distance((1, 2, 3), (0, 0, 1), 0) == solutions.detection.signed_distance((1, 2, 3), (0, 0, 1), 0)


def test_a_package_answers_with_the_module_of_the_topic(package):
    mine = Implementation(package("response", "def kinematic_response(*arguments): return 'mine', arguments"))
    assert mine.function("kinematic_response")(1, 2, 3) == ("mine", (1, 2, 3))


def test_a_file_answers_for_every_topic_it_has_functions_of(handed_in):
    mine = Implementation(handed_in())
    assert mine.function("signed_distance")(None, None, None) == "mine"


CALLING = '''
"""Functions that call each other."""
from numpy import cross

def signed_distance(point, normal, offset):
    """Its first statement is this."""
    return TABLE["inner"](point)

def _hidden(point):
    return aside(point)

def inner(point):
    return _hidden(point)

def aside(point):
    return 2.0

def bounce_velocty(velocity):
    return velocity

TABLE = {"inner": inner}
'''


def test_what_a_file_has_called_is_known_also_of_functions_within(handed_in):
    first, second = Implementation(handed_in(CALLING)), Implementation(handed_in(CALLING))
    distance = first.function("signed_distance")
    assert first.asked == set(), "it is found, and not yet called"
    assert distance(1, 2, 3) == 2.0
    assert first.asked == {"signed_distance", "inner", "aside"}
    assert second.asked == set()
    assert first.own_functions() == {"mine.py": ("signed_distance", "inner", "aside", "bounce_velocty")}
    assert Implementation(f"{first.source} | solutions").own_functions() == first.own_functions()
    assert Implementation("solutions").own_functions() == {}


def test_a_function_that_calls_another_implementation_is_not_taken_for_it(handed_in):
    inside, outside = Implementation(handed_in(CALLING)), Implementation(handed_in(CALLING, "other.py"))
    inside.function("signed_distance")(1, 2, 3)
    with pytest.raises(TypeError):
        outside.function("signed_distance")()
    assert outside.asked == {"signed_distance"}
    assert inside.function("signed_distance").__doc__ == "Its first statement is this."


# What is not written yet


@pytest.mark.parametrize(
    ("answer", "is_array"),
    [("[1, 2.5, 3]", True), ("[[1.0, 2.0], [3.0, 4.0]]", True), ("[[1.0], [2.0, 3.0]]", False), ("['a', 'b']", False)],
)
def test_a_list_of_numbers_is_taken_as_an_array_as_in_a_check(handed_in, answer, is_array):
    run = Implementation(handed_in(f"def signed_distance(*given):\n    return {answer}\n")).function("signed_distance")
    assert isinstance(run(), np.ndarray) == is_array
    both = Implementation(handed_in(f"def collide(*given):\n    return {answer}, 1.5\n")).function("collide")()
    assert isinstance(both[0], np.ndarray) == is_array
    assert both[1] == 1.5


def test_a_missing_function_is_needed_by_name_topic_and_step(handed_in):
    mine = Implementation(handed_in("pass"))
    with pytest.raises(NeedsFunction) as caught:
        mine.function("time_of_impact_exact")
    assert str(caught.value) == "needs time_of_impact_exact (detection, step 4)"


def test_a_stub_is_needed_once_it_is_called(handed_in):
    function = Implementation(handed_in()).function("time_of_impact_exact")
    with pytest.raises(NeedsFunction) as caught:
        function(1.0, 0.0, -9.81)
    assert str(caught.value) == "needs time_of_impact_exact (detection, step 4)"


def test_a_name_that_is_no_function_is_refused(handed_in):
    with pytest.raises(NeedsFunction, match=r"needs side_of_plane \(detection, step 2\)"):
        Implementation(handed_in()).function("side_of_plane")


def test_a_package_without_the_topic_needs_its_functions(package):
    mine = Implementation(package("response", ""))
    for name, where in [("holds", "friction, step 1"), ("kinematic_response", "response, step 1")]:
        with pytest.raises(NeedsFunction) as caught:
            mine.function(name)
        assert str(caught.value) == f"needs {name} ({where})"


def test_a_mistake_inside_a_function_is_raised_as_it_is(handed_in):
    with pytest.raises(ZeroDivisionError, match="my own mistake"):
        Implementation(handed_in()).function("kinematic_response")(1, 2, 3)


def test_a_function_unknown_to_the_lecture_is_an_unknown_name(handed_in):
    with pytest.raises(UnknownName, match=r"unknown function 'hold'\. Did you mean 'holds'\?"):
        Implementation(handed_in()).function("hold")


# Bad sources


@pytest.mark.parametrize(
    "source", ["no_such_package", "solutions.nothing", "no.such.package", "", ".", "./mine", "a b"]
)
def test_a_source_that_is_no_package_is_refused_with_the_choices(source):
    with pytest.raises(InvalidInput) as caught:
        Implementation(source).function("holds")
    choices = "a package such as 'solutions', or the path of a .py file"
    assert str(caught.value) == f"no implementation {source!r}; give {choices}"


def test_a_file_that_is_not_there_is_refused_with_its_path(tmp_path):
    missing = tmp_path / "missing.py"
    with pytest.raises(InvalidInput) as caught:
        Implementation(str(missing)).function("holds")
    assert str(caught.value) == f"no implementation {str(missing)!r}: there is no such file"
    (tmp_path / "folder.py").mkdir()
    with pytest.raises(InvalidInput, match=r"folder\.py': it is a folder"):
        Implementation(str(tmp_path / "folder.py")).function("holds")


@pytest.mark.parametrize(
    ("source", "said"),
    [
        ("no_such_package", "no implementation 'no_such_package'; give a package such as 'solutions', or the path"),
        ("solutions.no.such", "no implementation 'solutions.no.such'; give a package"),
        ("__main__", "no implementation '__main__'; give a package"),
        ("solutions | ", "no implementation ''; give a package"),
        ("{}", "; give a package such as 'solutions', or the path of a .py file"),
        ("{}/notes.txt", "; give a package such as 'solutions', or the path of a .py file"),
        ("{}/missing.py", "missing.py': there is no such file"),
        ("{}/folder.py", "folder.py': it is a folder"),
        ("{}/wrong.py", "wrong.py', line 2: SyntaxError: invalid syntax"),
        ("{}/good.py | {}/wrong.py", "wrong.py', line 2: SyntaxError: invalid syntax"),
        ("{}/outside.py", "outside.py', line 1: SyntaxError: 'return' outside function"),
        ("{}/bytes.py", "cannot read the implementation "),
    ],
)
def test_a_source_is_refused_without_running_any_of_it(source, said, tmp_path):
    (tmp_path / "folder.py").mkdir()
    (tmp_path / "notes.txt").touch()
    (tmp_path / "good.py").write_text(f"open({str(tmp_path / 'ran')!r}, 'w')\n")
    (tmp_path / "wrong.py").write_text("x = 1\ndef holds(:\n")
    (tmp_path / "outside.py").write_text("return 1\n")
    (tmp_path / "bytes.py").write_bytes(b"x = '\xff'\0")
    with pytest.raises(InvalidInput) as refused:
        Implementation(source.replace("{}", str(tmp_path))).check()
    assert said in str(refused.value)
    assert "\n" not in str(refused.value)
    assert not (tmp_path / "ran").exists()


def test_packages_and_files_pass_the_check_without_being_run(tmp_path, package):
    file = tmp_path / "good.py"
    file.write_text("x = '\\d'\nraise RuntimeError\n")  # what would only warn, or fail, as it runs
    Implementation(f"solutions | labs.grading | {file} | {package('friction', 'raise RuntimeError')}").check()


def test_a_failing_import_inside_a_package_is_no_missing_topic(package):
    mine = Implementation(package("friction", "import no_such_library"))
    with pytest.raises(ModuleNotFoundError, match="no_such_library"):
        mine.function("holds")


def test_a_file_that_does_not_compile_says_where(handed_in):
    path = handed_in("def holds(:\n    pass")
    with pytest.raises(SyntaxError) as caught:
        Implementation(path).function("holds")
    assert (caught.value.filename, caught.value.lineno) == (path, 1)


# Files are modules like any other


@pytest.mark.parametrize(
    "failing", ["plot()", "for n in range(2):\n    plot(n)", "if SIGN:\n    plot()", "print(plot)"]
)
def test_a_statement_that_defines_nothing_may_fail(handed_in, failing):
    text = (
        f"from __future__ import annotations\nSIGN = -1\n{failing}\ndef side_of_plane(before: X, after): return SIGN\n"
    )
    assert Implementation(handed_in(text)).function("side_of_plane")(1.0, 2.0) == -1
    with pytest.raises(NameError):
        Implementation(handed_in(text.replace("= -1", "= absent"))).function("side_of_plane")


def test_a_file_is_run_once_for_all_its_functions(handed_in):
    counted = "runs = {'times': 0}\nruns['times'] += 1\n"
    path = handed_in(counted + "def holds(): return runs\ndef friction_force(): return runs")
    mine = Implementation(path)
    assert mine.function("holds")() is mine.function("friction_force")()
    assert mine.function("holds")() == {"times": 1}


def test_a_file_may_hold_dataclasses_and_know_its_own_path(handed_in):
    path = handed_in(
        """
        from __future__ import annotations
        from dataclasses import dataclass

        @dataclass
        class Contact:
            depth: float

        def holds():
            return Contact(2.0).depth, __file__
        """
    )
    assert Implementation(path).function("holds")() == (2.0, path)


def test_an_edited_file_is_loaded_again_in_the_same_worker(handed_in):
    for answer in ("11", "22"):  # of one length and written within a moment: no time stamp tells them apart
        path = handed_in(f"def holds(): return {answer}")
        assert Implementation(path).function("holds")() == int(answer)
        module = "__import__('reference.engines.implementation', fromlist=['here'])"
        assert run_isolated(eval, 60.0, f"{module}.Implementation({path!r}).function('holds')()") == int(answer)
    stop_workers()


def test_an_implementation_is_plain_data():
    mine = Implementation("some/where/mine.py")
    copy = pickle.loads(pickle.dumps(mine))
    assert copy == mine
    assert {mine: "found"}[copy] == "found"
    assert Implementation() == Implementation("solutions")


def test_the_function_that_is_missing_is_named_and_not_the_one_that_calls_it(tmp_path):
    path = tmp_path / "half.py"
    path.write_text(
        "def respond(*given):\n    raise NotImplementedError('yours')\n\n\n"
        "def step_world(*given):\n    return respond(*given)\n"
    )
    with pytest.raises(NeedsFunction, match=r"^needs respond \(world, step 4\)$"):
        Implementation(str(path)).function("step_world")(1)
