"""When a mistake is named, and how sure that is: a made-up function whose right answer is its argument."""

from __future__ import annotations

import numpy as np
import pytest

from labs.grading.diagnosis import recognition, words
from labs.grading.diagnosis.deviations import Answer, Right, deviation_of
from labs.grading.diagnosis.findings import Diagnosis
from labs.grading.diagnosis.fingerprints import reading
from labs.grading.diagnosis.fingerprints.reading import Knowledge, Known
from labs.grading.diagnosis.probes import Probe
from labs.grading.diagnosis.recognition import DIFFERENT, LEAST, SHOWN_FOR_EACH_SPARED, diagnose
from labs.grading.diagnosis.words import example_of

SINGLE = [*(Probe((float(x),), "usual", f"case {x}") for x in range(1, 7)), Probe((0.0,), "edge", "nothing"),
          Probe((9.0,), "edge", "much")]  # fmt: skip
MANY = [Probe((np.array(x, dtype=float),), "many") for x in ([1, 2], [3, 4, 5], [6])]
PROBES = [*SINGLE, *MANY, Probe((-1.0,), "refused", "less than nothing"), Probe((-2.0,), "refused", "still less")]


def twice(x):
    return 2 * x


def one_more(x):
    return x + 1


def at(places, wrong, right=lambda x: x):
    """Wrong at some numbers, for single contacts; right elsewhere."""
    return lambda x: wrong(x) if np.ndim(x) == 0 and x in places else right(x)


def by_number(single, many):
    return lambda x: many(x) if np.ndim(x) else single(x)


def raises(x):
    raise ZeroDivisionError("division by zero")


def shapeless(x):
    return [x, x]


MISTAKES = {
    "twice": twice,
    "one more": one_more,
    "three less": lambda x: x - 3,
    "one more but at nothing": at([0], twice, one_more),
    "at nothing": at([0], one_more),
    "in two cases": at([1, 2], twice),
    "in three cases": at([1, 2, 3], twice),
    "in four cases": at([1, 2, 3, 4], twice),
    "in five cases": at([1, 2, 3, 4, 5], twice),
    "several together": by_number(lambda x: x, twice),
    "three times, of one contact": by_number(lambda x: 3 * x, shapeless),
    "through another": lambda x: 7 * x,
}


def deviations(formula, right):
    answers = zip(PROBES, right, strict=True)
    return tuple(deviation_of(Answer(formula(*probe.arguments)), own) for probe, own in answers if own)


def origins(name):
    return ("g/other",) if name == "through another" else ()


@pytest.fixture(autouse=True)
def made_up(monkeypatch):
    right = (*(Right((np.asarray(probe.arguments[0]),), (1.0,)) for probe in (*SINGLE, *MANY)), None, None)
    known = tuple(Known(f"f/{name}", f"It is {name}.", "Why?", deviations(formula, right), origins(name))
                  for name, formula in MISTAKES.items())  # fmt: skip
    monkeypatch.setattr(recognition, "known", lambda _: Knowledge("f", ("x",), right, known))
    monkeypatch.setattr(recognition, "probes", lambda _: PROBES)


def told(function):
    found = diagnose("f", lambda _, x: function(x))
    return (found.verdict, *(entry.id.removeprefix("f/") for entry in found.mistakes))


# Named


@pytest.mark.parametrize("name", MISTAKES)
def test_the_numbers_of_exactly_one_mistake_name_it(name):
    found = diagnose("f", lambda _, x: MISTAKES[name](x))
    assert (found.verdict, [entry.id for entry in found.mistakes]) == ("named", [f"f/{name}"])
    assert not found.one_alone
    assert "With several" not in words.told(found)


def test_a_mistake_is_named_though_several_contacts_raise_an_error():
    crashing = diagnose("f", lambda _, x: by_number(one_more, raises)(x))
    assert (crashing.verdict, len(crashing.mistakes)) == ("named", 1)
    assert (crashing.crash_in_many, crashing.one_alone) == (True, False)
    said = " ".join(words.told(crashing).split())
    assert "With several cases in one call it ends in an error: ZeroDivisionError" in said
    shaped = diagnose("f", lambda _, x: by_number(one_more, shapeless)(x))
    assert (shaped.verdict, len(shaped.mistakes), shaped.one_alone) == ("named", 1, False)


def test_five_wrong_numbers_name_a_mistake_though_batches_differ():
    assert DIFFERENT == 5
    assert told(by_number(MISTAKES["in five cases"], lambda x: -x)) == ("named", "in five cases")
    assert told(by_number(MISTAKES["in four cases"], lambda x: -x)) == ("likely", "in four cases")
    found = diagnose("f", lambda _, x: by_number(twice, lambda x: -x)(x))
    assert (found.verdict, found.one_alone) == ("named", True)
    assert "With several cases in one call it is wrong in another way besides." in words.told(found)


def test_a_mistake_without_an_answer_for_batches_says_nothing_of_them():
    found = diagnose("f", lambda _, x: 3 * x)
    assert [entry.id for entry in found.mistakes] == ["f/three times, of one contact"]
    assert (found.verdict, found.one_alone) == ("named", False)


def test_a_wrong_shape_for_one_contact_counts_against_a_mistake():
    assert told(at([3], shapeless, twice)) == ("unknown",)


def test_one_wrong_number_repeated_makes_a_mistake_only_likely():
    """Three less is off by the same each time, as much else would be."""
    assert told(by_number(lambda x: x - 3, lambda x: -x)) == ("likely", "three less")


# Not certain


def test_a_mistake_in_the_usual_cases_alone_is_likely():
    assert told(by_number(at([0, 9], lambda x: x - 3, twice), twice)) == ("likely", "twice")


def test_a_mistake_that_a_case_of_its_own_spares_somewhere_is_likely():
    assert SHOWN_FOR_EACH_SPARED == 3
    spared_once = at([1], lambda x: x, twice)
    assert told(by_number(spared_once, twice)) == ("likely", "twice")
    found = diagnose("f", lambda _, x: by_number(spared_once, twice)(x))
    assert (found.odd, found.spares_cases, found.spares_limits) == (None, True, False)
    assert "some cases are right that it would get wrong" in " ".join(words.told(found).split())
    assert told(by_number(at([1, 2], lambda x: x, twice), twice)) == ("unknown",)  # five wrong, two spared
    assert told(by_number(at([1], lambda x: x, at([2], one_more, twice)), twice)) == ("unknown",)  # of another mistake


def test_an_inherited_mistake_in_the_usual_cases_alone_is_not_named():
    assert told(by_number(at([0, 9], lambda x: x - 3, lambda x: 7 * x), twice)) == ("unknown",)


def test_a_mistake_is_inherited_only_from_a_function_that_is_called():
    def named(calls):
        return diagnose("f", lambda _, x: 7 * x, lambda name: calls.get(name, ())).verdict

    assert [named(calls) for calls in ({}, {"f": ["h"]}, {"f": ["g"]}, {"f": ["h"], "h": ["f", "g"]})] == [
        "unknown", "unknown", "named", "named",
    ]  # fmt: skip


def test_only_called_functions_are_named_as_the_origin_of_a_mistake():
    knowledge = reading.known("collide")
    both = next(
        each for each in knowledge.mistakes if {"impulse_magnitude", "inverse_effective_mass"} == functions_of(each)
    )
    left = [
        each for each in reading.of_functions(knowledge, ["impulse_magnitude"]) if each.deviations == both.deviations
    ]
    assert [functions_of(each) for each in left] == [{"impulse_magnitude"}]
    assert left[0].rationale.startswith("It answers as if it were right itself and used a wrong impulse_magnitude: ")


def functions_of(entry):
    return {origin.partition("/")[0] for origin in entry.origins}


def test_none_of_two_fitting_mistakes_is_chosen():
    assert told(by_number(at([0], raises, one_more), one_more)) == ("several", "one more", "one more but at nothing")


def test_a_mistake_needs_three_cases_where_others_are_silent():
    assert LEAST == 3
    assert told(by_number(at([0], one_more, at([5], raises)), lambda x: x)) == ("unknown",)
    assert told(at([6], raises, MISTAKES["in two cases"])) == ("unknown",)
    assert told(at([6], raises, MISTAKES["in three cases"])) == ("named", "in three cases")
    assert told(at([0], lambda x: -3.0, MISTAKES["in two cases"])) == ("unknown",)
    assert told(at([0], lambda x: -3.0, MISTAKES["in three cases"])) == ("likely", "in three cases")


# Without a name


@pytest.mark.parametrize(
    ("function", "verdict"),
    [
        (by_number(lambda x: x, lambda x: -x), "one at a time"),
        (by_number(lambda x: x, raises), "one at a time"),
        (raises, "crashes"),
        (at([3, 0], raises), "crashes"),
        (shapeless, "shape"),
        (lambda x: "up", "shape"),
        (at([3, 4], shapeless, at([5], raises)), "unknown"),
        (lambda x: x - 4, "unknown"),
        (lambda x: x, "right"),
    ],
)
def test_an_unexplained_answer_is_described_by_its_form(function, verdict):
    assert told(function) == (verdict,)
    assert not diagnose("f", lambda _, x: function(x)).one_alone


def test_the_example_is_the_simplest_probe_that_fails():
    found = diagnose("f", lambda _, x: at([4, 5], lambda x: x - 3)(x))
    assert found.counterexample.probe.note == "case 4"
    assert example_of(found.counterexample) == "f(x=4), case 4\ngives   1\nphysics 4"
    assert diagnose("f", lambda _, x: x).counterexample is None
    without_note = diagnose("f", lambda _, x: by_number(lambda x: x, lambda x: -x)(x)).counterexample
    assert example_of(without_note).startswith("f(x=(1, 2))\n")


def test_a_function_is_unwritten_only_if_every_probe_says_so():
    def stub(x):
        raise NotImplementedError

    assert told(stub) == ("unwritten",)
    assert told(at([1], lambda x: x, stub)) == ("unknown",)


def test_a_function_is_right_if_its_numbers_are_and_arguments_stay():
    assert Diagnosis("f", "right").right
    assert not Diagnosis("f", "right", changes_input=True).right
    assert not Diagnosis("f", "unknown").right


def test_errors_are_listed_in_the_order_in_which_they_occurred():
    def many_ways(x):
        if np.ndim(x) or x in (2, 5):
            raise ValueError("first")
        if x == 4:
            raise ValueError("second")
        return x

    found = diagnose("f", lambda _, x: many_ways(x))
    assert found.crashes == ("ValueError: first", "ValueError: second")
    assert not found.crash_in_many
    assert diagnose("f", lambda _, x: x).crashes == ()
    assert not diagnose("f", lambda _, x: x).crash_in_many


def test_bad_input_is_listed_if_it_is_answered_and_not_if_refused():
    def checked(x):
        if np.ndim(x) == 0 and x < -1.5:
            raise ValueError
        return x

    found = diagnose("f", lambda _, x: checked(x))
    assert found.accepted == ("less than nothing",)
    assert (found.verdict, found.right, found.changes_input, found.crashes) == ("right", True, False, ())


def test_writing_into_arguments_is_noticed_in_any_probe():
    def writes(x):
        if np.ndim(x):
            x[0] += 1
            return x - np.eye(1, len(x))[0]
        return x

    found = diagnose("f", lambda _, x: writes(x))
    assert (found.verdict, found.changes_input, found.right) == ("right", True, False)
