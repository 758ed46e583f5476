"""The known mistakes and their fingerprints: complete, fresh, and free of formulas."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

from labs.grading.diagnosis import fingerprints
from labs.grading.diagnosis.fingerprints import __main__ as command
from labs.grading.diagnosis.fingerprints import building
from labs.grading.diagnosis.fingerprints.__main__ import main
from labs.grading.diagnosis.misconceptions import Misconception, read_bank
from labs.grading.diagnosis.probes import probed, probes
from reference import lecture
from reference.errors import InvalidInput
from solutions.impulse import normal_velocity
from solutions.response import kinematic_response

BANK = read_bank()

TOPICS = (
    "detection", "response", "friction", "impulse", "polyhedra", "sweeping", "forces", "meshes", "avoidance", "world",
)  # fmt: skip
ONE_CASE_ALONE = {
    "count_impacts", "face_planes", "polyhedra_intersect", "advance", "total_force", "mesh_forces", "mesh_step",
    "diagonals", "timestep_bound", "mesh_sphere_contact", "limit_strain", "separation", "towards_mean",
    "candidate_pairs", "collect_contacts", "respond", "step_world",
}  # fmt: skip
"""Functions that take one case in a call."""

pytestmark = pytest.mark.filterwarnings("ignore::RuntimeWarning")  # wrong formulas divide by zero


def bounce(v, n, e, w=(0.0, 0.0, 0.0)):
    """Right for one contact or many, without checks of its input."""
    return v - (1 + np.asarray(e))[..., None] * np.minimum(np.sum((v - np.asarray(w)) * n, axis=-1), 0)[..., None] * n


# The bank and its fingerprints


def test_every_written_function_has_probes_and_four_known_mistakes():
    written = [entry.name for topic in TOPICS for entry in lecture.functions_of(topic) if entry.role == "written"]
    assert [entry.name for entry in probed()] == written
    for name in written:
        groups = [probe.group for probe in probes(name)]
        assert len(groups) >= 30
        assert {"usual", "edge"} <= set(groups)
        assert ("many" in groups) == (name not in ONE_CASE_ALONE)
        assert len([entry for entry in BANK if entry.function == name]) >= 4


def test_probes_are_the_same_every_time():
    first, again = (probes.__wrapped__("impulse_magnitude") for _ in range(2))
    assert [repr(probe) for probe in first] == [repr(probe) for probe in again]


def test_the_fingerprints_of_some_functions_are_fresh(monkeypatch):
    sample = {entry.name for entry in probed()[::24]}
    monkeypatch.setattr(building, "probed", lambda: [entry for entry in probed() if entry.name in sample])
    stale = {re.search(r"/functions/(\w+)", line)[1] for line in fingerprints.stale(inheriting=False)}
    assert stale
    assert stale.isdisjoint(sample), "all others are left out here"


@pytest.mark.slow
def test_the_fingerprints_of_all_functions_are_fresh():
    assert fingerprints.stale() == []


def test_a_stale_fingerprint_is_found(tmp_path, monkeypatch):
    numbers = {"side_of_plane": {"right": [1.0, 2.0]}}
    content = {"schema": "collisions-lab/fingerprints", "version": 2, "functions": numbers}
    monkeypatch.setattr(building, "build", lambda *_, **__: {"detection": content})
    assert fingerprints.stale(tmp_path) == ["detection.json: there is none"]
    assert building.write(tmp_path) == [tmp_path / "detection.json"]
    assert fingerprints.stale(tmp_path) == []
    numbers["side_of_plane"]["right"] = [1.0, 2.5]
    assert fingerprints.stale(tmp_path) == ["detection.json: /functions/side_of_plane/right[1] is 2.0, now 2.5"]


def test_a_file_of_fingerprints_has_a_line_for_each_entry():
    content = {"é": {"deep": {"deeper": [1, {"x": 2}]}}, "none": {}, "ü": "ß"}
    assert building.lines(content, 2) == '{\n"é": {\n"deep": {"deeper":[1,{"x":2}]}\n},\n"none": {},\n"ü": "ß"\n}'
    assert building.lines({}) == "{}"


def test_the_command_writes_or_checks_fingerprints(capsys, monkeypatch, tmp_path):
    assert main(["--what"]) == 2
    assert "usage" in capsys.readouterr().out
    monkeypatch.setattr(command, "write", lambda: [tmp_path / "detection.json"])
    for found, code, line in (([], 0, "the fingerprints are fresh"), (["detection.json: /x"], 1, "detection.json: /x")):
        monkeypatch.setattr(command, "stale", lambda found=found: found)
        assert (main(["--check"]), capsys.readouterr().out) == (code, f"{line}\n")
    assert (main([]), capsys.readouterr().out) == (0, "wrote detection.json\n")


def test_a_faulty_list_of_mistakes_is_reported_in_one_line(capsys, monkeypatch):
    def refuse():
        raise InvalidInput("two entries give the same numbers; merge them")

    monkeypatch.setattr("labs.grading.diagnosis.fingerprints.__main__.write", refuse)
    assert main([]) == 2
    assert capsys.readouterr().out == "two entries give the same numbers; merge them\n"


def test_two_entries_of_the_same_mistake_are_refused():
    entry = next(entry for entry in BANK if entry.function == "normal_velocity")
    with pytest.raises(InvalidInput, match=r"give the same numbers; merge them"):
        building.learned("normal_velocity", normal_velocity, [entry, replace(entry, name="again")])


def test_an_entry_that_is_right_is_refused():
    right = Misconception("kinematic_response", "none", bounce, "", "")
    with pytest.raises(InvalidInput, match="is right on every probe"):
        building.learned("kinematic_response", kinematic_response, [right])


def test_fingerprints_hold_no_formula_and_no_code():
    for path in fingerprints.reading.FOLDER.glob("*.json"):
        text = path.read_text(encoding="utf-8")
        assert "lambda" not in text
        assert "np.where" not in text


def test_rationales_end_like_sentences_and_hints_ask_a_question():
    assert [entry.id for entry in BANK if not entry.rationale.endswith((".", ".)"))] == []
    assert [entry.id for entry in BANK if not entry.help.endswith(("?", ".")) or entry.help == entry.rationale] == []
