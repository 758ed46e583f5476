"""A mistake is named by its numbers; what is not certain is not said."""

from __future__ import annotations

import importlib
import inspect
import re

import numpy as np
import pytest

from labs.grading.diagnosis import fingerprints
from labs.grading.diagnosis.misconceptions import read_bank
from labs.grading.diagnosis.probes import probed
from labs.grading.diagnosis.recognition import diagnose
from labs.grading.diagnosis.words import called, told
from labs.grading.phrases import no_answer
from reference import lecture
from reference.errors import UnknownName
from solutions import as_printed
from solutions.impulse import (
    apply_impulse,
    collide,
    edge_edge_normal,
    impulse_magnitude,
    inverse_effective_mass,
    normal_velocity,
)
from solutions.polyhedra import edges_through_faces, inside_by_parity
from solutions.response import kinematic_response

BANK = read_bank()

TOPICS = ("detection", "response", "friction", "impulse", "polyhedra", "sweeping", "forces", "meshes", "avoidance")

pytestmark = pytest.mark.filterwarnings("ignore::RuntimeWarning")  # wrong formulas divide by zero


def of(function):
    """A submission of one function."""
    return lambda _, *arguments: function(*arguments)


def bounce(v, n, e, w=(0.0, 0.0, 0.0)):
    """Right for one contact or many, without checks of its input."""
    return v - (1 + np.asarray(e))[..., None] * np.minimum(np.sum((v - np.asarray(w)) * n, axis=-1), 0)[..., None] * n


def not_turned_round(a, b, n, e):
    """The impulse after which the points have the velocity that the slide prints."""
    u, k = normal_velocity(a, b, n), inverse_effective_mass(a, b, n)
    wanted = as_printed.velocity_after_restitution(u, e) - u
    return np.where(k > 0, wanted / np.where(k > 0, k, 1.0), 0.0)


def plus_on_both(a, b, j):
    """As slide 18 prints it."""
    turned = [np.cross(body[2], j)[..., None] for body in (a, b)]
    v_a, v_b = as_printed.velocities_after_impulse(a[0], b[0], 1 / np.asarray(a[3]), 1 / np.asarray(b[3]), j)
    return v_a, a[1] + (a[4] @ turned[0])[..., 0], v_b, b[1] + (b[4] @ turned[1])[..., 0]


def colliding_as_printed(a, b, n, e, threshold=0.0):
    """The slide's test for a collision, with the normal from B to A."""
    hit = as_printed.contact_kind(normal_velocity(a, b, n), threshold) == "colliding"
    return apply_impulse(a, b, np.where(hit, impulse_magnitude(a, b, n, e), 0.0)[..., None] * n)


# What the slides print


@pytest.mark.parametrize(
    ("function", "printed", "name"),
    [
        ("kinematic_response", lambda v, n, e, w=0: as_printed.mirror_response(v, n), "the slide's mirror"),
        (
            "time_of_impact_interpolated",
            lambda s0, s1, t, dt: as_printed.time_of_impact(t, dt, s0, s1),
            "the slide's magnitudes",
        ),
        (
            "penalty_force",
            lambda s, u, n, k, c=0.0, adhesive=False: as_printed.penalty_force(k, s)[..., None] * n,
            "the slide's spring",
        ),
        ("impulse_magnitude", not_turned_round, "1 − e"),
        ("collide", colliding_as_printed, "guard turned round"),
        ("apply_impulse", plus_on_both, "+J to both"),
        (
            "normal_velocity",
            lambda a, b, n: np.vecdot(a[2] + np.cross(a[1], a[2]) - b[2] - np.cross(b[1], b[2]), n),
            "a place",
        ),
    ],
    ids=lambda value: "" if callable(value) else value,
)
def test_a_wrong_formula_of_the_slides_is_named(function, printed, name):
    found = diagnose(function, of(printed))
    assert [entry.id for entry in found.mistakes] == [f"{function}/{name}"]


# One function at a time


def test_a_right_answer_without_input_checks_hears_about_them():
    found = diagnose("kinematic_response", of(bounce))
    assert found.right
    assert found.accepted == ("a normal that is not of unit length", "a restitution above 1")
    assert "It should refuse, with a ValueError" in told(found)


def test_a_right_answer_with_input_checks_hears_nothing_else():
    assert told(diagnose("kinematic_response", of(kinematic_response))) == "kinematic_response: right on every probe."


def test_the_mistake_is_named_with_a_hint_and_the_simplest_example():
    found = diagnose("kinematic_response", of(lambda v, n, e, *w: bounce(v, n, 1 + 0 * np.asarray(e), *w)))
    text = told(found)
    assert found.mistakes[0].id == "kinematic_response/always perfect"
    assert "Every bounce is perfect" in text
    assert (
        "kinematic_response(velocity=(0, 0, -2), normal=(0, 0, 1), restitution=0.5), straight down on the floor" in text
    )
    assert "gives   (0, 0, 2)\n  physics (0, 0, 1)" in text


def test_a_mistake_is_named_if_the_function_takes_one_contact_only():
    def single(velocity, normal, restitution, plane_velocity=(0.0, 0.0, 0.0)):
        approach = (velocity - plane_velocity) @ normal
        return velocity - restitution * approach * normal if approach < 0 else velocity

    found = diagnose("kinematic_response", of(single))
    assert found.mistakes[0].id == "kinematic_response/e for 1 + e"
    assert "With several cases in one call it ends in an error" in told(found)


def test_a_function_that_is_right_for_one_contact_only_hears_so():
    found = diagnose("edge_edge_normal", of(lambda *given: edge_edge_normal(*(each.reshape(3) for each in given))))
    assert found.verdict == "one at a time"
    assert not found.mistakes


def test_writing_into_arguments_is_noticed_if_the_numbers_are_right():
    def in_place(velocity, *others):
        after = bounce(velocity, *others)
        velocity *= 2
        return after

    found = diagnose("kinematic_response", of(in_place))
    assert (found.verdict, found.changes_input, found.right) == ("right", True, False)
    assert "its answers are right, but it writes into its arguments" in told(found)


def test_a_change_of_arguments_reported_by_the_process_counts():
    class Elsewhere:
        changed = (0,)

        def __call__(self, _, *arguments):
            return kinematic_response(*arguments)

    assert diagnose("kinematic_response", Elsewhere()).changes_input


def test_a_function_that_calls_a_wrong_one_is_not_blamed(monkeypatch):
    entry = next(entry for entry in BANK if entry.id == "normal_velocity/component by component")
    monkeypatch.setattr("solutions.impulse.impact.normal_velocity", entry.formula)
    found = diagnose("collide", of(collide))
    assert found.mistakes[0].origins == (entry.id,)
    assert "It answers as if it were right itself and used a wrong normal_velocity" in " ".join(told(found).split())


def test_one_wrong_answer_to_a_mesh_without_faces_accuses_no_other_function():
    """A vertex of no face is taken for a solid, and so it would be by a wrong inside_by_parity as well."""

    def intersect(*meshes):
        pairs = (meshes[:2], meshes[2:]), (meshes[2:], meshes[:2])
        corners = [a[0][np.unique(a[1]) if len(a[1]) else [0]] for a, _ in pairs]
        return any(
            len(edges_through_faces(*a, *b)[0]) or inside_by_parity(places, *b).any()
            for places, (a, b) in zip(corners, pairs, strict=True)
        )

    found = diagnose("polyhedra_intersect", of(intersect))
    assert found.verdict == "unknown"
    assert found.counterexample.probe.note == "the other without a face"


def test_a_stub_counts_as_unwritten():
    def stub(*arguments):
        raise NotImplementedError("your turn")

    found = diagnose("collide", of(stub))
    assert (found.verdict, found.counterexample) == ("unwritten", None)
    assert told(found) == "collide: not written yet."


def test_an_error_everywhere_is_shown_with_its_input():
    found = diagnose("signed_distance", of(lambda point, normal, offset: point.no_such_thing))
    assert found.verdict == "crashes"
    assert "AttributeError" in told(found)


@pytest.mark.parametrize("value", [None, "up", {"a": 1}, [[1, 2], [3]], np.zeros(2, complex), np.zeros((3, 1))])
def test_a_value_that_is_no_answer_has_the_wrong_shape(value):
    found = diagnose("edge_edge_normal", of(lambda *_: value))
    assert found.verdict == "shape"
    assert not found.mistakes


def test_one_output_instead_of_several_has_the_wrong_shape():
    found = diagnose("apply_impulse", of(lambda a, b, j: a[0] + np.asarray(a[3])[..., None] * j))
    assert "gives   one array instead of 4 arrays" in told(found)


@pytest.mark.parametrize(
    ("value", "count", "printed", "words"),
    [
        (None, 1, "", "nothing (None): is a return missing?"),
        (None, 2, "3\n", "nothing (None): it prints, and has to return"),
        ("never", 1, "", "the text 'never' instead of a number or an array"),
        ((1.0, 2.0), 3, "", "2 things instead of 3"),
        ([1.0, [2.0]], 1, "", "a list that is not a number or an array of numbers"),
    ],
)
def test_a_value_that_is_no_answer_is_described_in_words(value, count, printed, words):
    assert no_answer(value, count, printed) == words


def test_truth_values_are_shown_as_true_and_false():
    found = diagnose("inside_by_parity", of(lambda point, vertices, faces: np.sum(point, axis=-1) > 0))
    assert re.search(r"gives   (False|True)\n  physics (False|True)", told(found))


def test_a_constant_answer_is_no_known_mistake():
    """It may be that of any mistake that happens to say no in the usual cases."""
    found = diagnose("polyhedra_intersect", of(lambda *solids: np.False_))
    assert not found.mistakes


def test_an_unknown_mistake_gets_an_example_only():
    found = diagnose("edge_edge_normal", of(lambda e, f, a, b: 1.37 * edge_edge_normal(e, f, a, b)))
    assert (found.verdict, found.mistakes) == ("unknown", ())
    assert "in a way that the lab does not know" in told(found)
    assert "edge_a=(1, 0, 0)" in told(found)


def test_a_known_mistake_with_another_at_the_edges_is_only_likely():
    """Against the push where there is none: 0/0."""

    def divides_by_zero(push, v, normal_force, static, kinetic):
        speed, size = np.linalg.norm(v, axis=-1)[..., None], np.linalg.norm(push, axis=-1)[..., None]
        mu_n = np.asarray(kinetic * np.asarray(normal_force))[..., None]
        held = size <= (static * np.asarray(normal_force))[..., None]
        broken = -mu_n * push / size
        return np.where(speed > 0, mu_n * v / speed, np.where(held & (size > 0), -push, broken))

    found = diagnose("friction_force", of(divides_by_zero))
    assert found.verdict == "likely"
    assert found.mistakes[0].id == "friction_force/along the velocity"
    text = " ".join(told(found).split())
    assert "This mistake alone does not explain: friction_force(" in text
    assert "gives (nan, nan, nan)" in text.partition("does not explain")[2]


def test_several_explanations_are_listed_and_none_is_chosen():
    """The three mistakes differ in touching alone, where this one has no answer."""

    def without_touching(separation, tolerance=0.0):
        if np.any(separation == 0):
            raise ZeroDivisionError("float division by zero")
        return np.where(np.broadcast_arrays(separation, tolerance)[0] < 0, -1, 1)

    found = diagnose("side_of_plane", of(without_touching))
    assert found.verdict == "several"
    assert [known.id for known in found.mistakes] == [
        "side_of_plane/tolerance left out",
        "side_of_plane/two sides, tolerance left out",
        "side_of_plane/two sides, touching behind, tolerance left out",
    ]
    assert "do not say which it is" in " ".join(told(found).split())


def test_one_wrong_number_is_no_known_mistake():
    """Right but for a single probe: no known mistake explains that alone."""

    def nearly(a, b, n, e):
        right = impulse_magnitude(a, b, n, e)
        return right + 1 if np.ndim(right) == 0 and np.array_equal(a[0], [0, 0, -1]) else right

    found = diagnose("impulse_magnitude", of(nearly))
    assert not found.mistakes


def test_a_function_without_probes_is_refused():
    with pytest.raises(UnknownName, match="no_such"):
        diagnose("no_such", of(kinematic_response))
    for entry in lecture.FUNCTIONS.values():
        if entry.role == "written" and entry not in probed():
            with pytest.raises(UnknownName, match=f"function with probes '{entry.name}'"):
                diagnose(entry.name, of(kinematic_response))


def test_an_example_without_fingerprints_has_no_parameter_names():
    assert called(("normal_velocity", "restitution"), (-2.0, 0.5)) == "normal_velocity=-2, restitution=0.5"
    assert called((), (-2.0, [0.5, 1.0]), "no_such") == "no_such(-2, (0.5, 1))"


def test_matrices_are_shown_briefly():
    assert called((), (np.diag([2.0, 1.0]), np.ones((2, 2)), np.eye(1), np.full((2, 2), np.inf)), "f") == (
        "f(diag(2, 1), ((1, 1), (1, 1)), ((1,),), ((inf, inf), (inf, inf)))"
    )


@pytest.mark.parametrize("topic", TOPICS)
def test_the_names_of_parameters_are_those_of_the_solutions(topic):
    module = importlib.import_module(f"solutions.{topic}")
    for entry in lecture.functions_of(topic):
        if entry.role == "written":
            code = inspect.unwrap(getattr(module, entry.name)).__code__
            assert fingerprints.known(entry.name).parameters == code.co_varnames[: code.co_argcount]
