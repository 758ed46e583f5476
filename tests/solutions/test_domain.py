"""What an argument may be is declared at the parameter, and what is said of a parameter is said once."""

from __future__ import annotations

import importlib
import inspect
import pickle
import pkgutil
import re

import numpy as np
import pytest

import solutions
from solutions.arrays import Array
from solutions.domain import Finite, Positive, Share, Unit, domain, require
from solutions.response import kinematic_response

MODULES = [
    importlib.import_module(found.name)
    for found in pkgutil.walk_packages(solutions.__path__, "solutions.")
    if "notebooks" not in found.name
]
FUNCTIONS = {
    f"{module.__name__}.{name}": each
    for module in MODULES
    for name, each in vars(module).items()
    if inspect.isfunction(each) and each.__module__ == module.__name__ and not name.startswith("_")
}


@domain
def weighed(n: Unit, mass: Positive | None, share: Share = 0.5, *, shift: Finite = 2) -> tuple[Array, ...]:
    """A function of all kinds of arguments; it returns what it got."""
    return n, mass, share, shift


@domain
def doubled(number: Finite) -> Array:
    return 2 * np.vecdot(number[..., None], np.ones(1))


def test_lists_and_numbers_become_arrays_and_so_do_defaults_and_results():
    n, mass, share, shift = weighed([0, 0, 1], 3, shift=1)
    assert [each.dtype for each in (n, mass, share, shift)] == [np.dtype(float)] * 4
    assert (n.shape, mass.shape, float(share), float(shift)) == ((3,), (), 0.5, 1.0)
    assert isinstance(doubled(3), np.ndarray)
    assert weighed([0, 0, 1], None)[1] is None


@pytest.mark.parametrize(
    ("args", "named", "error", "says"),
    [
        (([0, 0, 2], 1), {}, ValueError, "^n must have length 1, not 2"),
        (([0, 0, 1], -1), {}, ValueError, "^mass must be positive, not -1"),
        (([0, 0, 1], 1, 1.5), {}, ValueError, "^share must be from 0 to 1, not 1.5"),
        (([0, 0, 1],), {"mass": 1, "shift": np.inf}, ValueError, "^shift must be finite, not inf"),
        (([0, 0, 1], 1j), {}, ValueError, "^mass must be real numbers"),
        (([0, 0, 1],), {}, TypeError, "mass"),
        (([0, 0, 1], 1, 0.5, 2, 3), {}, TypeError, "positional"),
        (([0, 0, 1], 1), {"mass": 1}, TypeError, "multiple values"),
        (([0, 0, 1], 1), {"masses": 1}, TypeError, "masses"),
    ],
)
def test_the_argument_outside_its_domain_is_named(args, named, error, says):
    with pytest.raises(error, match=says):
        weighed(*args, **named)


def test_a_default_is_shared_and_cannot_be_changed():
    share = weighed([0, 0, 1], 1)[2]
    with pytest.raises(ValueError, match="read-only"):
        share += 0.1


def test_a_function_of_a_domain_pickles_and_shows_its_unchecked_body():
    assert pickle.loads(pickle.dumps(kinematic_response)) is kinematic_response
    assert "np.vecdot(relative, normal)" in inspect.getsource(inspect.unwrap(kinematic_response))


def test_a_relation_between_arguments_is_refused_in_its_words():
    require(np.array([True, True]), "never said")
    with pytest.raises(ValueError, match="kinetic above static"):
        require(np.array([True, False]), "kinetic above static")


def sections(function) -> dict[str, list[str]]:
    """The sections of a docstring, by title: their lines."""
    found, title, lines = {}, "", inspect.getdoc(function).split("\n")
    for line, below in zip(lines, [*lines[1:], ""], strict=True):
        if line and re.fullmatch("-+", below) and len(below) == len(line):
            title = line
        elif not re.fullmatch("-+", line):
            found.setdefault(title, []).append(line)
    return found


DESCRIBED = [name for name, function in FUNCTIONS.items() if "Parameters" in sections(function)]


@pytest.mark.parametrize("name", DESCRIBED)
def test_each_parameter_is_described_once_with_its_shape_or_kind(name):
    described = sections(FUNCTIONS[name])["Parameters"]
    entries = [line for line in described if line and not line.startswith(" ")]
    assert all(re.fullmatch(r"\*{0,2}\w+(, \*{0,2}\w+)* : \S.*", line) for line in entries), entries
    names = [each.strip("* ") for line in entries for each in line.partition(" : ")[0].split(",")]
    assert sorted(names) == sorted(inspect.signature(FUNCTIONS[name]).parameters)
