"""Examples that are drawn for a test: the same for the same file, and small where a student reads them."""

from __future__ import annotations

import re

import numpy as np
import pytest
from hypothesis import configuration
from hypothesis.internal.conjecture import providers
from stand_ins import Function

from labs.grading.diagnosis.probes.probe import Draw
from labs.grading.errors import FunctionRaised
from labs.grading.judging import examples
from labs.grading.judging.examples import COUNT, MOST_CALLS, Chosen, Examples


def pair(draw):
    return draw.number(1, 9), draw.number(1, 9)


# Examples


def test_examples_are_foreseen_in_the_order_of_their_calls():
    for ask in (Examples(1).agree, Examples(1).together):
        function = Function(np.add)
        ask(function, np.add, pair)
        assert len(function.asked) == len(function.foreseen) >= 6
        assert [id(x) for each in function.asked for x in each] == [id(x) for each in function.foreseen for x in each]


def test_a_formula_is_called_once_for_each_right_example():
    """Scales are looked for where an answer is off: they take several calls."""
    formula = Function(np.add)
    Examples(1).agree(Function(np.add), formula, pair)
    assert len(formula.asked) == COUNT


def test_a_seed_always_draws_the_same_examples_and_another_others():
    drawn = []
    for seed in (1, 1, 2):
        function = Function(np.add)
        Examples(seed).agree(function, np.add, pair)
        drawn.append(function.asked)
    assert len(drawn[0]) == len(set(drawn[0])) == COUNT
    assert drawn[0] == drawn[1] != drawn[2]


def test_far_examples_have_longer_vectors_and_the_others_stay():
    asked = {}
    for far in (0, 20):
        function = Function(np.add)
        Examples(1).agree(function, np.add, lambda draw: (draw.vector(2), draw.vector(2)), far=far)
        asked[far] = np.abs(function.asked)
    assert np.array_equal(asked[20][:COUNT], asked[0])
    assert asked[0].max() <= 2 < 50 < asked[20].max() <= 200


@pytest.mark.parametrize("ask", ["agree", "every"])
@pytest.mark.parametrize("told", [True, False])
def test_an_example_is_made_small_only_if_a_student_may_read_it(ask, told):
    function, drawn = Function(lambda a, b: a - b), Examples(1, told)

    def adds(a, b):
        assert function(a, b) == a + b, f"{a} and {b}"

    with pytest.raises(AssertionError) as raised:
        drawn.agree(function, np.add, pair) if ask == "agree" else drawn.every(pair, adds)
    smallest = re.search(r"=1, \w+=1\)?$", str(raised.value), re.MULTILINE) is not None
    assert smallest == told
    assert (len(function.asked) > 3) == told


def test_a_failed_property_is_reported_without_digits_of_rounding():
    def holds(x, force, flag):
        raise AssertionError("three\nis four\nassert 3 == 4\n  where 3 is odd")

    def third(draw):
        return 0.1 + 0.2 - 0.3, np.array([1.0, 0.1 + 0.2 - 0.3]), True

    with pytest.raises(AssertionError, match=r"^three\nis four\nfor x=0, force=\(1, 0\), flag=True$"):
        Examples(1).every(third, holds)


def test_a_property_that_ends_in_an_error_fails_with_it():
    def raises(a, b):
        raise FunctionRaised("f raised E: m")

    with pytest.raises(FunctionRaised):
        Examples(1).every(pair, raises)


def test_the_search_for_the_smallest_example_is_limited(monkeypatch):
    tried, most = [], 40
    assert MOST_CALLS == 200
    monkeypatch.setattr(examples, "MOST_CALLS", most)

    def small(*numbers):
        tried.append(numbers)
        assert sum(numbers) < 900

    with pytest.raises(AssertionError):
        Examples(1).every(lambda draw: tuple(draw.number(0, 100) for _ in range(20)), small)
    # Left alone, hypothesis goes on for some 740 calls. One call finds it, and one tells it.
    assert most < len(tried) <= most + 3


def test_the_search_for_the_smallest_example_leaves_no_files(monkeypatch, tmp_path):
    """Hypothesis keeps notes on our modules in files; here it only says where."""
    configuration.set_hypothesis_home_dir(None)
    monkeypatch.setenv("HYPOTHESIS_STORAGE_DIRECTORY", str(tmp_path))
    folders = []

    def noted():
        folders.append(configuration.storage_directory("constants").path)
        return providers.Constants()

    monkeypatch.setattr(providers, "_get_local_constants", noted)

    def small(*numbers):
        assert sum(numbers) < 900

    with pytest.raises(AssertionError):
        Examples(1).every(lambda draw: tuple(draw.number(0, 100) for _ in range(20)), small)
    assert folders
    assert not any(folder.is_relative_to(tmp_path) or folder.parent.exists() for folder in folders)


def test_an_answer_that_is_wrong_only_once_still_fails():
    """Nothing smaller is found then: the example that failed is told."""
    tries = []

    def once(a, b):
        tries.append(a)
        assert len(tries) != 3, "the third"

    with pytest.raises(AssertionError, match="the third"):
        Examples(1).every(pair, once)


def drawn_by(choices):
    from labs.grading.judging.examples import _drawing  # noqa: PLC0415 - what is drawn with is no part of the interface

    return _drawing(Chosen(choices))


# Drawing by choices that hypothesis makes small


def test_the_simplest_draws_are_simple():
    draw = drawn_by(())
    assert [draw.number(0.5, 4), draw.number(-3, 0), draw.number(-5, -2), draw.number(1.5, 3)] == [1, 0, -5, 2]
    assert draw.number(0.2, 0.7) == 0.45
    assert draw.sign() == 1
    assert draw.vector().tolist() == [1, 1, 1]


def test_every_choice_of_hypothesis_is_a_possible_draw():
    rng = np.random.default_rng(7)
    for draw in (drawn_by(rng.integers(0, Chosen.MOST + 1, 60).tolist()) for _ in range(60)):
        assert draw.sign() in (-1, 1)
        assert 2 <= draw.number(2, 3) <= 3
        assert np.all((np.abs(draw.vector(2)) <= 2) & (np.abs(draw.vector(2)) >= 0.1))
        unit, turn = draw.unit(), draw.turn()
        np.testing.assert_allclose([unit @ unit, *np.linalg.norm(turn, axis=0)], 1.0)
        np.testing.assert_allclose(np.linalg.det(turn), 1.0)
    assert drawn_by([Chosen.MOST]).number(2, 3) == 3
    assert drawn_by([1]).number(2, 3, digits=3) == 2.001


def test_drawn_numbers_stay_within_their_limits():
    draw = Draw(np.random.default_rng(3))
    numbers = [draw.number(2, 3) for _ in range(200)]
    assert 2 <= min(numbers) < 2.1
    assert 2.9 < max(numbers) <= 3
    signs = [draw.sign() for _ in range(100)]
    assert {*signs} == {-1, 1}
    normal = draw.unit()
    assert abs(draw.tangent(normal) @ normal) < 1e-12
    inertia = draw.inverse_inertia()
    np.testing.assert_allclose(inertia, inertia.T)
    assert np.all(np.linalg.eigvalsh(inertia) > 0.4)


def test_the_number_of_choices_is_counted():
    chosen = Chosen([3, 1])
    chosen.uniform(), chosen.integers(4), chosen.choice([1, 2], 3), chosen.permutation([1, 2])
    assert chosen.taken == 6
    assert sorted(Chosen([5]).permutation([1, 2, 3])) == [1, 2, 3]
    assert Chosen([]).permutation([3, 1, 2]).tolist() == [3, 1, 2]
    assert [Chosen([n]).integers(4) for n in (0, 3, 4)] == [0, 3, 0]
