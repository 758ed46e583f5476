"""Students who return the same wrong numbers share a mistake; those who nearly do not."""

from __future__ import annotations

import random
import time

import pytest
from made_grades import COUNT, FUNCTION, LAB, SCALED, grade_of

from labs.gradebook.mistakes.clusters import clusters
from labs.gradebook.mistakes.entries import Entry
from labs.gradebook.mistakes.same_numbers import Numbers, Shelf, numbers_in
from labs.gradebook.pages import class_page, clusters_page
from labs.gradebook.roster import Student
from labs.gradebook.similarity import function_in
from labs.gradebook.tables import Mark
from labs.grading.diagnosis.deviations import TOLERANCE


def changed(at: int, value: float | str) -> list[float | str]:
    return [*SCALED[:at], value, *SCALED[at + 1 :]]


def found(*numbers, code=lambda _: "", waiting=()):
    return clusters({f"s{at}": grade_of(each) for at, each in enumerate(numbers)}, code, waiting)


def groups(*numbers) -> list[list[int]]:
    """Which of some numbers belong together."""
    return sorted([int(each[1:]) for each in cluster.students] for cluster in found(*numbers))


def test_the_same_numbers_belong_together_within_rounding():
    rounded = [value * (1 + 1e-6) for value in SCALED]
    assert groups(SCALED, rounded, SCALED) == [[0, 1, 2]]
    assert found(SCALED) == []


@pytest.mark.parametrize(
    "other",
    [
        changed(3, SCALED[3] + 3 * TOLERANCE),  # a little more than rounding
        changed(3, 0),  # right where the others are wrong
        changed(3, -SCALED[3]),
        changed(3, "none"),
        changed(3, "shape"),
        [2 * value for value in SCALED],
    ],
)
def test_a_near_miss_is_another_mistake(other):
    assert groups(SCALED, other) == []
    assert groups(SCALED, other, SCALED, other) == [[0, 2], [1, 3]]


def test_answers_without_a_number_have_to_fail_alike():
    fails = [changed(3, word) for word in ("none", "shape", "kind")]
    assert groups(*fails, *fails) == [[0, 3], [1, 4], [2, 5]]


def test_who_nearly_agrees_with_two_joins_the_nearest():
    low, high = SCALED, changed(0, SCALED[0] + 1.8 * TOLERANCE)
    middle = changed(0, SCALED[0] + 1.0 * TOLERANCE)
    assert groups(low, low, high, high) == [[0, 1], [2, 3]]
    waiting = [
        Entry("low", numbers_in(grade_of(low)["functions"][0])),
        Entry("high", numbers_in(grade_of(high)["functions"][0])),
    ]
    shared = found(low, high, middle, waiting=waiting)
    assert {each.id: each.students for each in shared} == {"high": ("s1", "s2")}


def test_the_order_of_the_class_makes_no_difference():
    mistakes = [SCALED, changed(5, "none"), [0.5] * COUNT, changed(7, 4.0)]
    several = [
        [value * (1 + at * 1e-7) if isinstance(value, float) else value for value in mistakes[at % 4]]
        for at in range(24)
    ]
    contents = {f"s{at:02d}": grade_of(each) for at, each in enumerate(several)}
    first = clusters(contents, lambda _: "")
    order = list(contents)
    random.Random(5).shuffle(order)
    assert clusters({each: contents[each] for each in order}, lambda _: "") == first
    assert [len(each.students) for each in first] == [6, 6, 6, 6]


def test_a_cluster_keeps_its_name_when_a_number_crosses_the_rounding_of_its_digits():
    (first,) = found(changed(0, 0.1234564), changed(0, 0.1234564))
    waiting = [Entry(first.id, Numbers.read(FUNCTION, first.numbers.text()))]
    below, above = changed(0, 0.1234565), changed(0, 0.1234566)
    (fresh,) = found(above, above)
    assert fresh.id != first.id  # the digits alone would give another name
    (kept,) = found(below, above, waiting=waiting)
    assert (kept.id, kept.numbers) == (first.id, waiting[0].numbers)
    assert found(below, above, waiting=waiting) == [kept]


def test_a_student_counts_once_and_grades_of_other_probes_do_not_count():
    twice = grade_of(SCALED)
    assert numbers_in(grade_of(SCALED[:-1])["functions"][0]) is None
    assert clusters({"a": twice, "b": grade_of(SCALED[:-1])}, lambda _: "") == []


def test_numbers_of_an_older_lab_count_if_it_shares_three_probes_of_four():
    numbers = numbers_in(grade_of(SCALED)["functions"][0])
    keys = list(numbers.values)
    for kept, recognised in ((0.8, True), (0.7, False)):
        older = {key: value for key, value in numbers.values.items() if key in keys[: int(kept * COUNT) + 1]}
        older |= {f"gone{at}": 0.5 for at in range(COUNT - len(older))}
        shelf = Shelf(FUNCTION, [Numbers(FUNCTION, older)])
        assert (shelf.nearest(numbers) == 0) is recognised
        assert shelf.is_of_today(0) is recognised


HOSTILE = """\
def helper(a):
    return '</pre><script>alert(1)</script>'


def {name}(velocity, normal, restitution):
    return helper(velocity)


def penalty_force(x):
    return x
"""


def test_the_shortest_version_stands_escaped_beside_the_right_one_and_only_on_the_page_for_instructors():
    codes = {
        "s0": HOSTILE.format(name=FUNCTION) + "# long\n" * 50,
        "s1": HOSTILE.format(name=FUNCTION).replace("return helper", "unused = 1\n    return helper"),
        "s2": "def other(:",
    }
    shared = found(SCALED, SCALED, SCALED, code=codes.__getitem__)
    assert shared[0].code == function_in(HOSTILE.format(name=FUNCTION), FUNCTION)
    assert "penalty_force" not in shared[0].code
    page = clusters_page(LAB, shared)
    assert "3 students share this wrong <code>kinematic_response</code>" in page
    assert "&lt;/pre&gt;&lt;script&gt;" in page
    assert "<script>" not in page
    assert "(0, 0, &lt;3&gt;)" in page
    assert "physics says" in page
    assert "restitution" in page.split("The right one")[1].split("</pre>")[0]
    assert '"""' not in page
    assert "no evidence that somebody copied" in page
    assert shared[0].id in page
    marks = [Mark(Student(f"s{at}"), LAB, 10.0, content=grade_of(SCALED)) for at in range(3)]
    shown = class_page(LAB, marks, {}, shared=shared)
    assert '<td class="number">3</td><td><code>kinematic_response</code></td>' in shown
    assert "no evidence that somebody copied" in shown
    for hidden in ("helper", "(0, 0,", "unit(", "velocity=", shared[0].id):
        assert hidden not in shown
    assert "No two students share" in clusters_page(LAB, [])


def test_of_two_definitions_the_last_one_is_shown_with_its_helpers():
    assert function_in("def f(x):\n    return 1\n\n\ndef f(x):\n    return g(x)\n\n\ng = abs\n", "f") == (
        "def f(x):\n    return g(x)\n\n\ng = abs"
    )
    own_turned = "def turned(m, x):\n    return m @ x"
    caller = "def point_velocity(v, w, r):\n    return turned(w, r)"
    assert function_in(f"{own_turned}\n\n\n{caller}", "point_velocity") == f"{own_turned}\n\n\n{caller}"
    assert function_in("f = 1", "g") == function_in("def f(:", "f") == ""


def test_three_hundred_students_take_a_moment():
    rng = random.Random(3)
    mistakes = [[rng.uniform(-1, 1) for _ in range(COUNT)] for _ in range(200)]
    contents = {f"s{at}": grade_of(mistakes[at % 200]) for at in range(300)}
    code = "def kinematic_response(v, n, e):\n    return v\n"
    began = time.process_time()
    shared = clusters(contents, lambda _: code)
    assert time.process_time() - began < 1.0  # measured: a tenth of it
    assert len(shared) == 100
