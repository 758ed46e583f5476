"""A third engine is one file. The conformance suite runs over it; here it goes the way that any engine goes."""

from __future__ import annotations

import math
import shutil
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.bouncing_ball import DROPS
from reference.comparison.verdicts import Row, Verdict
from reference.engines import engine_names, load_engine
from reference.errors import InvalidInput
from reference.running.jobs import run_all
from reference.running.study import SCENARIOS, plan

TIMESTEP = 4e-3  # s: coarse, for the toy steps one drop after another
TOY = Path(__file__).parents[1] / "toy_engine.py"


@pytest.fixture(scope="module")
def rows(tmp_path_factory) -> list[Row]:
    """What the toy makes of three families beside the hand-written code, from a file anywhere."""
    path = shutil.copy(TOY, tmp_path_factory.mktemp("elsewhere") / "my_engine.py")
    families = [catalogue()[name] for name in ("dropped-ball", "ball-to-rest", "incline")]
    cases = {"dropped-ball": ("e=0.2",), "ball-to-rest": ("e=0.5",), "incline": ("μ=0.3,θ=20°",)}
    jobs = plan(families, ["handwritten", str(path)], ["exact"], cases, changes={"timestep": TIMESTEP})
    with ThreadPoolExecutor(2) as executor:
        return [row for result in run_all(jobs, SCENARIOS, executor) for row in result.rows]


def of(rows: list[Row], family: str, **wanted: str) -> list[Row]:
    kept = [row for row in rows if row.family == family and row.engine == "toy"]
    return [row for row in kept if all(getattr(row, name) == value for name, value in wanted.items())]


def test_the_toy_is_one_file_that_nothing_else_mentions():
    assert "toy" not in engine_names()
    assert load_engine(str(TOY)).title == "a toy"
    for folder in ("reference", "labs", "solutions"):
        for file in (TOY.parents[2] / folder).rglob("*.py"):
            assert "toy_engine" not in file.read_text(encoding="utf-8")


@pytest.mark.slow
def test_the_toy_has_rows_beside_those_of_hand_written_code(rows):
    assert {row.engine for row in rows} == {"handwritten", "toy"}
    assert {(row.engine, row.profile) for row in rows} == {("handwritten", "exact"), ("toy", "tuned")}
    assert not [row for row in rows if row.engine == "handwritten" and row.verdict is Verdict.FAIL]


def test_the_toy_bounces_as_low_as_a_step_method_must(rows):
    (found,) = of(rows, "dropped-ball", quantity="rebound")
    overlap = math.sqrt(2 * 9.81) * TIMESTEP  # v dt
    # The mean over N even phases knows a sawtooth of height v dt to an Nth of it; then come terms of second order.
    assert found.error == pytest.approx(-(1 - 0.2) * overlap / 2, abs=overlap / DROPS + 2 * 9.81 * TIMESTEP**2)
    assert found.verdict is Verdict.KNOWN_DEVIATION  # 18 % of e²
    assert found.shift < 0  # no recurrence is written for the toy: the mean shift of a step method stands for it
    assert found.predicted is None


def test_the_toy_fails_to_come_to_rest_and_its_row_says_so(rows):
    (found,) = of(rows, "ball-to-rest", quantity="rest_time")
    assert (found.verdict, found.measured) == (Verdict.FAIL, None)
    assert "did not happen" in found.note


def test_a_scenario_that_the_toy_cannot_express_is_a_row_with_the_reason(rows):
    (found,) = of(rows, "incline")
    assert found.verdict is Verdict.CANNOT_EXPRESS
    assert found.note == "a toy cannot express incline/μ=0.3,θ=20°: it knows one ball over one plane, " + (
        "without friction and without spin"
    )


HALF = "from reference.engines import Engine\nclass Half(Engine):\n    name = 'half'\n"
REST = "    def settings(self, *_): pass\n    method = run = settings\n"


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "does not define ENGINE"),
        ("ENGINE = int\n", "does not define ENGINE"),
        ("ENGINE = 'toy'\n", "does not define ENGINE"),
        (None, "no engine file"),
        (f"{HALF}ENGINE = Half\n", "lacks method, run, settings"),
        (f"{HALF}{REST}ENGINE = Half\n", "has no title"),
        (f"{HALF}{REST}    title = 'MuJoCo'\n    name = 'mujoco'\nENGINE = Half\n", "'mujoco', which is taken"),
        (f"{HALF}{REST}    title = 'h'\n    def __init__(self): pass\nENGINE = Half\n", "cannot be made: TypeError"),
        ("raise SystemExit(7)\n", "cannot be loaded: SystemExit: 7"),
        ("raise ValueError('a')\n", "cannot be loaded: ValueError: a"),
    ],
)
def test_a_file_without_an_engine_that_can_run_is_refused_by_name(text, complaint, tmp_path):
    path = tmp_path / "no_engine.py"
    if text is not None:
        path.write_text(text)
    with pytest.raises(InvalidInput, match=complaint) as refused:
        load_engine(str(path))
    assert "no_engine.py" in str(refused.value)
