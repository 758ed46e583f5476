"""What a notebook says ✓ to is what the mark counts: refused inputs, long ones, and how inputs are read."""

from __future__ import annotations

import itertools
import time

import numpy as np
import pytest
from cells import said, write_notebook
from submissions import solved_notebook
from suspects_tried import EXPOSING, HARMLESS, TETRAHEDRON

from labs.assessment import exposures
from labs.assessment.written_inputs import MANY, TRIES, inputs_in
from labs.building import lessons
from labs.desk import student_code
from labs.grading.submission.asked_predictions import predictions_in, predictions_of
from labs.project_folders import STUDENT_NOTEBOOKS
from reference.engines.implementation import Implementation
from reference.errors import InvalidInput, UnknownName

EVERY = [(topic, each.key) for topic in lessons.lessons() for each in exposures.suspects(topic)]
NUMBERS = (-1, 0, 0.25, 2, -0.5, 1e-7, 1e49, 10**40, 1, 3)
INVERTED = [face[::-1] for face in TETRAHEDRON[1]]
REFUSED = (
    ("response", "flipper", ([0, 0, -1], [0, 0, 1], 1.5), "restitution must be from 0 to 1, not 1.5"),
    ("response", "film", ([0, 0, 1], [0, 0, -2], [0, 0, 0], [0, 0, 1], 0.5, -0.5, 1.0), "time_of_impact must be zero"),
    ("friction", "carts", ([1, 0, 0], [0, 0, 0], 10, 0.2, 0.25), "0.2 is less than 0.25"),
    ("friction", "track", ([3, 4, 0, 0], 2), "tangent_force must be 3 numbers"),
    ("forces", "buffers", (2.0, 0, 1.0), "mass must be positive, not 0"),
    ("avoidance", "lighthouse", (1.0, [0, 0.6, 0.6], 8.0, 2.0), "normal must have length 1, not 0.848528"),
    ("avoidance", "lighthouse", (1.0, [0, 0, 1], 8.0, 0), "reach must be positive, not 0"),
    ("impulse", "crates", ([1, 0, 0], [-3, 0, 0], [0, 0, 1], [0, 0, 0]), "are parallel"),
    ("impulse", "aircraft", ([1, -1, 1], [1, 0, 0, 0]), "inertia must be zero or positive, not -1"),
    ("polyhedra", "crates", ([2, 0.1, 0.1], TETRAHEDRON[0], INVERTED), "look outwards"),
    ("polyhedra", "garden", ([2, 0.1, 0.1], TETRAHEDRON[0], INVERTED[:3]), "3 edges belong to an odd number of faces"),
    ("polyhedra", "statue", ([2, 0.1, 0.1], TETRAHEDRON[0], [[0, 1, 4]]), "vertices from 0 to 3, not 4"),
    ("meshes", "game", (([[0, 1], [1, 1]], [1, 1], [5, 5], [0, 0], [1, 9], [0, 0]),), "node 1 to itself"),
    ("meshes", "game", (([[0, 999_999_999]], [1], [5], [0], [1, 1], [0, 0]),), "nodes from 0 to 1, not 999999999"),
    ("detection", "hail", ([1.0], -1.0, -9.81), "separation must be one number, not a list"),
    ("detection", "distance", ([0, 0, 3], [0, 0, 0], 1), "normal is zero"),
    ("detection", "distance", ([0, 0, 3], [0, 0, 1]), "it takes 3 arguments, point, normal, offset, and 2 are given"),
    ("world", "crane", ([[2, 1], [1, 2]], [-4, -4], 10**9), "sweeps must be a whole number from 0 to 1000, not 1e+09"),
    ("world", "crane", ([[2, 1], [1, 2]], [-4, -4], 2.5), "sweeps must be a whole number"),
    ("world", "wagons", ([2, 0, 0], [1, 1, 9], 0.5, 10**12), "most must be a whole number from 0 to 10000"),
    ("world", "wagons", ([2] * 40, 1, 0), "velocity must be 3 to 5 numbers"),
    ("world", "satellite", ([1, 1, 0, 0], [1, 1, 0], [1, 2, 3], 0.25), "orientation must have length 1, not 1.41421"),
)
LONG = (
    "[0.0] * 200", repr([0.0] * 200), repr([[]] * 200), "[" * 60 + "1" + "]" * 60, "0x" + "f" * 50_000, "-" * 300 + "1",
    "{1, 2, 3}", "'a' * 10**9", "10**1000", "1e999", "True", "1j", "b'1'", "(1).__class__", "[i for i in range(9)]",
)  # fmt: skip


def right(name):
    return Implementation("solutions").function(name)


def places(value, place=()):
    """Where numbers and lists are in an input."""
    yield place
    if isinstance(value, list | tuple):
        for at, each in enumerate(value):
            yield from places(each, (*place, at))


def changed(value, place, change):
    """An input with one of its numbers or lists changed."""
    if not place:
        return change(value)
    return [changed(each, place[1:], change) if at == place[0] else each for at, each in enumerate(value)]


def inputs_like(first):
    """An input, and others that differ from it in one place: another number, or a list that is longer or shorter."""
    numbers = itertools.cycle(NUMBERS)
    yield list(first)
    for number, place in enumerate(places(list(first))):
        found = list(first)
        for at in place:
            found = found[at]
        if isinstance(found, list | tuple):
            yield changed(list(first), place, lambda old, number=number: [*old, old[-1]] if number % 2 else [*old[1:]])
        else:
            yield changed(list(first), place, lambda _: next(numbers))
            yield changed(list(first), place, lambda _: next(numbers))


def as_given(value):
    """An input as arrays, unless its parts differ in shape."""
    try:
        return np.array(value) if isinstance(value, list | tuple) else value
    except ValueError:
        return value


@pytest.mark.parametrize(
    ("topic", "key"), [pytest.param(*each, marks=pytest.mark.slow if at % 5 else ()) for at, each in enumerate(EVERY)]
)
def test_a_notebook_says_exposed_where_the_mark_counts_it(lab, cells, capsys, monkeypatch, tmp_path, topic, key):
    lab.topic, suspect = topic, exposures.suspect(topic, key)
    monkeypatch.setattr(student_code, "defined_now", right)
    counted, refused = 0, 0
    for arguments in inputs_like(EXPOSING[topic, key]):
        text = f"lab.expose({key!r}, {', '.join(map(repr, arguments))})"
        cells[:] = [text]
        promised = said(capsys, lab.expose, key, *arguments)
        found = exposures.found_in(write_notebook(tmp_path / "lab.ipynb", text), topic)
        assert found == {each.key: each.key == key and "✓" in promised for each in exposures.suspects(topic)}, promised
        assert "Error" not in promised, promised  # what the right function refuses, the contract refuses as well
        counted += "✓" in promised
        refused += "refuses this input" in promised
        if "refuses this input" in promised and not any(
            word in promised for word in ("shape", "number", "argument", "2 bars")
        ):
            with pytest.raises((ValueError, TypeError)), np.errstate(all="ignore"):
                right(suspect.function)(*map(as_given, arguments))
    assert counted
    assert refused


@pytest.mark.parametrize(("topic", "key", "arguments", "words"), REFUSED)
def test_an_input_that_the_contract_refuses_exposes_nothing(topic, key, arguments, words):
    suspect = exposures.suspect(topic, key)

    def never(*_):
        raise AssertionError("it must not be called")

    with pytest.raises(InvalidInput) as refused:
        exposures.tried(suspect, arguments, never)
    assert f"{suspect.function} refuses this input (" in str(refused.value)
    assert words in str(refused.value)


@pytest.mark.parametrize("text", LONG, ids=range(len(LONG)))
def test_an_input_that_is_long_or_no_numbers_is_not_even_read(tmp_path, text):
    began = time.process_time()
    notebook = write_notebook(tmp_path / "lab.ipynb", f'lab.expose("wagons", {text}, 1, 0.5)')
    assert inputs_in([f'lab.expose("wagons", {text}, 1, 0.5)']) == {}
    assert exposures.found_in(notebook, "world") == {"crane": False, "wagons": False, "satellite": False}
    assert time.process_time() - began < 1


def test_no_input_that_is_taken_costs_more_than_a_moment(tmp_path):
    longest = [f'lab.expose("wagons", [{each}.0, 0, 0, 0, 1e-5], 1, 0, 10000)' for each in range(TRIES)]
    longest += [f'lab.expose("crane", {[[2, 1, 1, 1]] * 4}, [{each}, -4, -4, -4], 1000)' for each in range(TRIES)]
    began = time.process_time()
    exposures.found_in(write_notebook(tmp_path / "lab.ipynb", *longest), "world")
    assert time.process_time() - began < 10


def test_what_is_no_input_is_said(lab, cells, capsys, monkeypatch):
    monkeypatch.setattr(student_code, "defined_now", right)
    with pytest.raises(InvalidInput, match="too long"):
        exposures.tried(exposures.suspect("impulse", "crates"), ([0.0] * 200,), right("edge_edge_normal"))
    with pytest.raises(UnknownName, match="crates"):
        exposures.suspect("impulse", "crate")
    assert "in numbers" in said(capsys, lab.expose, "distance", np.zeros(3), [0, 0, 2], 4)
    cells[:] = ['lab.expose("hail", height, 2.0, -10.0)', 'lab.expose("hail", 1/240, 2.0, -10.0)']
    for height in (0.5, 1 / 240):  # the value is a number, and the text that is marked is none
        assert "no names, no 1/240" in said(capsys, lab.expose, "hail", height, 2.0, -10.0)
    cells.append('%%time\nlab.expose("hail", 0.5, 2.0, -10.0)')
    assert "✓ Exposed" in said(capsys, lab.expose, "hail", 0.5, 2.0, -10.0)


def test_a_function_that_returns_another_shape_exposes_nothing(lab, capsys, monkeypatch):
    monkeypatch.setattr(student_code, "defined_now", lambda name: lambda *given: np.full(3, 1.0))
    assert "shape (3,), and one case has ()" in " ".join(said(capsys, lab.expose, "hail", 0.5, 2.0, -10.0).split())


def test_a_function_that_writes_into_its_arguments_changes_nothing_for_the_other():
    def writes(point, normal, offset):
        distance = right("signed_distance")(point, normal, offset)
        point[:] = 0
        return distance

    harmless = HARMLESS["detection", "distance"]
    assert not exposures.tried(exposures.suspect("detection", "distance"), harmless, writes).exposed


def test_inputs_are_read_from_a_notebook_that_is_never_run(tmp_path):
    cells = [
        'lab.expose("hail", 0.5, 2.0, -10.0)',
        'lab.expose("distance", [0, 0, 3], [0, 0, 2], ...)\n# lab.expose("distance", [0, 0, 3], [0, 0, 2], 4)',
        'lab.expose("gallery", *__import__("os").listdir())\nlab.expose("gallery", -0.5, 2.0, 0.1, 0.1, 1.0)',
        'lab.expose("gallery", 0.5, -2.0, 0.1, 0.1, 1.0)',  # exposes nothing, and takes nothing away
    ]
    path = write_notebook(tmp_path / "lab.ipynb", *cells)
    assert exposures.found_in(path, "detection") == {"distance": False, "hail": True, "gallery": True}


@pytest.mark.slow
@pytest.mark.parametrize("topic", lessons.lessons())
def test_a_solved_notebook_gets_every_prediction_and_input_and_an_open_one_none(topic, tmp_path):
    asked = predictions_in(cell.text for cell in lessons.read(topic).cells if cell.code)
    solved = tmp_path / "solved.ipynb"
    solved.write_bytes(solved_notebook(topic))
    for path, done in ((solved, True), (STUDENT_NOTEBOOKS / f"{topic}.ipynb", False)):
        assert predictions_of(path) == dict.fromkeys(asked, done)
        assert set(exposures.found_in(path, topic).values()) == {done}


def test_of_many_inputs_the_last_ones_are_tried_each_once():
    cells = [f'lab.expose("hail", {each}, 2, -9)\nlab.expose("hail", 0, 2, -9)' for each in range(1, 100)]
    found = inputs_in(cells)["hail"]
    assert len(found) == TRIES
    assert found[-2:] == [[99, 2, -9], [0, 2, -9]]


@pytest.mark.parametrize("others", [0, TRIES - 2, TRIES - 1, 3 * TRIES])
def test_who_has_tried_so_many_inputs_that_an_early_one_may_not_count_is_told(lab, cells, capsys, monkeypatch, others):
    lab.topic = "detection"
    monkeypatch.setattr(student_code, "defined_now", right)
    cells[:] = [
        *(f'lab.expose("hail", {each}, 2, -9)' for each in range(others)),
        'lab.expose("hail", 0.5, 2.0, -10.0)',
    ]
    told = " ".join(said(capsys, lab.expose, "hail", 0.5, 2.0, -10.0).split())
    assert "✓ Exposed" in told
    assert (MANY in told) == (others >= TRIES - 1)
