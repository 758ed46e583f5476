"""What a lab's mark is made of besides functions: numbers of one's own, inputs found, the sum, and an oral kit."""

from __future__ import annotations

import contextlib
import io
from types import SimpleNamespace

import numpy as np
import pytest
from suspects_tried import BANK_ENTRY, EXPOSING, HARMLESS

from labs.assessment import exposures, mending, oral, seeded
from labs.assessment.marks import marks
from labs.assessment.shares import CODE, INPUTS, QUESTIONS, SHARES
from labs.building import lessons, seeded_questions
from labs.grading.diagnosis import misconceptions
from labs.grading.diagnosis.probes import probes
from reference.engines.implementation import Implementation
from reference.errors import InvalidInput

CHOICES = {"e": (0.3, 0.4, 0.6, 0.7), "mass": (1.0, 2.0, 3.0)}
EVERY = [(topic, suspect) for topic in lessons.lessons() for suspect in exposures.suspects(topic)]


def right(name):
    return Implementation("solutions").function(name)


@pytest.mark.parametrize("topic", lessons.lessons())
def test_the_person_who_marks_sees_what_follows_from_a_students_numbers(topic):
    for question in seeded_questions.questions(topic, "1234"):
        assert question.results, question.key
        assert np.isfinite([*question.results.values()]).all(), question.key


def test_numbers_depend_on_the_student_and_the_question_alone():
    mine = seeded.drawn("Ada 17", "impulse", "weight", CHOICES)
    assert mine == seeded.drawn(" ada 17 ", "impulse", "weight", CHOICES)
    assert seeded.drawn("", "impulse", "weight", CHOICES) == seeded.drawn("", "detection", "other", CHOICES)
    many = [seeded.drawn(str(number), "impulse", "weight", CHOICES) for number in range(200)]
    assert {each.e for each in many} == set(CHOICES["e"])
    assert len({(each.e, each.mass) for each in many}) == 12
    assert max([each.e for each in many].count(e) for e in CHOICES["e"]) < 80  # 50 each, and some luck
    with pytest.raises(InvalidInput, match="several values"):
        seeded.drawn("Ada", "impulse", "weight", {"e": 0.5})


@pytest.mark.parametrize(("topic", "suspect"), EVERY, ids=lambda each: getattr(each, "key", each))
def test_a_suspect_is_wrong_on_some_inputs_alone(topic, suspect):
    assert exposures.tried(suspect, EXPOSING[topic, suspect.key], right(suspect.function)).exposed
    harmless = exposures.tried(suspect, HARMLESS[topic, suspect.key], right(suspect.function))
    assert not harmless.exposed
    assert harmless.said.startswith("Both give")


def test_a_place_and_a_velocity_are_shown_with_their_names():
    found = exposures.tried(
        exposures.suspect("response", "film"), EXPOSING["response", "film"], right("respond_at_impact")
    )
    assert found.said.startswith("respond_at_impact gives position=(0, 0, ")
    assert found.said.count("velocity=(0, 0, ") == 2


def test_a_result_of_several_things_has_a_name_for_each():
    scales = exposures.suspect("friction", "scales")
    said = exposures.tried(scales, EXPOSING["friction", "scales"], right("support_force")).said
    assert "normal force=" in said
    assert "along=(" in said


@pytest.mark.parametrize(("topic", "key"), BANK_ENTRY)
def test_a_suspect_makes_the_mistake_of_the_bank(topic, key):
    suspect = exposures.suspect(topic, key)
    (entry,) = [each for each in misconceptions.read_bank() if each.id == BANK_ENTRY[topic, key]]
    usual = [probe.arguments for probe in probes(suspect.function) if probe.group == "usual"]
    assert len(usual) >= 4
    for arguments in usual:
        with np.errstate(all="ignore"):
            wrong = exposures._flat(entry.formula(*arguments))
        np.testing.assert_allclose(exposures._flat(suspect.wrong(*arguments)), wrong, atol=1e-9)  # of order 1


@pytest.mark.parametrize("topic", lessons.lessons())
def test_a_bug_is_mended_by_the_model_and_not_as_printed(topic):
    cells = [each for each in lessons.read(topic).cells if each.kind == "broken" and "lab.mended(" in each.text]
    for printed in cells:
        (model, *_) = lessons.read(topic).models(printed.key)
        assert mending.still_wrong(topic, printed.key, program_of(printed))
        assert mending.still_wrong(topic, printed.key, program_of(model)) == ""


def program_of(cell):
    """What the cell hands to lab.mended."""
    handed = []
    lab = SimpleNamespace(mended=lambda key, program: handed.append(program))
    with contextlib.redirect_stdout(io.StringIO()):
        exec(cell.text, {"lab": lab, "np": np})  # our own lesson
    return handed[0]


def test_an_input_is_tried_as_the_checks_give_it():
    suspect, given = exposures.suspect("polyhedra", "garden"), []

    def of_arrays(point, vertices, faces):
        given.extend((vertices[faces], point[..., None]))
        return right(suspect.function)(point, vertices, faces)

    found = exposures.tried(suspect, EXPOSING["polyhedra", "garden"], of_arrays)
    assert [each.shape for each in given] == [(4, 3, 3), (3, 1)]
    assert found.said == "inside_by_parity gives True, and your colleague's False"


def test_functions_are_less_than_half_of_a_mark():
    assert sum(SHARES.values()) == 100
    assert (SHARES[CODE], SHARES[INPUTS]) == (45, 15)
    found = marks((20, 40), {"a": True, "b": False, "c": False}, (9, 10), (None, 30))
    assert found.total == pytest.approx(22.5 + 5 + 4.5)
    assert (found.points(QUESTIONS), found.open) == (None, 35)
    assert marks((20, 40), {}, (0, 0), (30, 30)).total == pytest.approx(22.5 + 15 + 5 + 35)
    with pytest.raises(InvalidInput, match="30 points"):
        marks((20, 40), {}, (0, 0), (31, 30))


def test_an_oral_kit_asks_about_the_students_own_lines(tmp_path):
    path = tmp_path / "lab.py"
    path.write_text(
        "import numpy as np\n"
        "def missing_probability(v, w, r, dt):\n    way = v * dt\n"
        "    return np.where(way > 0, 1 - (w + 2 * r) / way, 0)\n"
        "def signed_distance(p, n, d):\n    return (np.dot(p, n) + d) / np.linalg.norm(n)\n"
        "def side_of_plane(s, tolerance=0.0):\n    raise NotImplementedError('yours')\n",
        encoding="utf-8",
    )
    prompts = oral.kit(path, "detection")
    said = oral.text(prompts, path.name)
    assert "side_of_plane" not in said
    assert "np.where(way > 0" in prompts[2].code
    changed = prompts[1].question.partition("````python\n")[2].partition("\n````")[0]
    assert changed != prompts[1].code
    assert len(changed) == len(prompts[1].code)
    assert said.count("1 point") == 9
    (tmp_path / "one.py").write_text("def signed_distance(p, n, d):\n    return p @ n + d\n", encoding="utf-8")
    with pytest.raises(InvalidInput, match="two at least"):
        oral.kit(tmp_path / "one.py", "detection")
