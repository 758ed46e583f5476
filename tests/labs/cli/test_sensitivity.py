"""`collisions sensitivity`: what it prints, writes and refuses."""

from __future__ import annotations

import json

import pytest
from program import collisions

from reference.recording import sensitivity as kept

pytestmark = pytest.mark.usefixtures("one_worker")


@pytest.mark.slow
def test_the_smallest_fault_is_printed_written_and_kept(tmp_path, monkeypatch):
    file = tmp_path / "kept.json"
    monkeypatch.setattr(kept, "FILE", file)
    wish = "sensitivity", "parting-ball", "--engine", "handwritten"
    said = collisions(*wish, "--out", tmp_path / "found.json", "--keep")
    assert said.code == 0
    assert "hand-written, exact 0.11" in said.text
    assert (
        "The smallest fault that a verdict here would notice: restitution 8.6·10⁻⁸ % (hand-written, world)" in said.text
    )
    assert "to 0.11 % (hand-written), mass" in said.text
    assert "Without effect on any number: inertia" in said.text
    content = json.loads((tmp_path / "found.json").read_text(encoding="utf-8"))
    assert (content["schema"], content["version"]) == ("collisions-lab/sensitivity", 1)
    noticed = content["families"]["parting-ball"]["handwritten"]["exact"]["faults"]["restitution"]
    assert noticed == {"outcome": "noticed", "size": 0.0011, "case": "v=0.1", "quantity": "off"}
    assert file.read_bytes() == (tmp_path / "found.json").read_bytes()


@pytest.mark.parametrize(
    ("wish", "why"),
    [
        (("parting-bal",), "Did you mean 'parting-ball'?"),
        (("parting-ball/v=0.1",), "is one case"),
        (("parting-ball", "--engine", "bullet"), "unknown engine 'bullet'"),
        (("parting-ball", "--out", "found.txt"), "is no JSON file"),
        (("parting-ball", "--out", "nowhere/found.json"), "choose another --out"),
        (("parting-ball", "--engine", "ODD", "--keep"), "no engine of the lab's own"),
    ],
)
def test_what_cannot_be_done_is_refused_before_anything_runs(wish, why, odd):
    refused = collisions("sensitivity", *(odd() if word == "ODD" else word for word in wish))
    assert (refused.code, why in refused.error) == (2, True), refused.error


def test_an_engine_of_ones_own_is_tried_under_its_title(odd):
    nothing_moves = "[recorder.sample(state) for _ in range(10)]"
    said = collisions("sensitivity", "parting-ball", "--engine", odd(nothing_moves))
    assert said.code == 0
    assert "an odd one, tuned not noticed" in said.text


def test_an_engine_that_crashes_is_told_and_no_finding(odd):
    said = collisions("sensitivity", "parting-ball", "--engine", odd("raise ZeroDivisionError"))
    assert said.code == 3
    assert "crashed: parting-ball, an odd one, tuned: ZeroDivisionError" in said.text
