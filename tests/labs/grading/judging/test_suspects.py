"""Functions that pass their visible tests and are wrong all the same: named before a caller is blamed."""

from __future__ import annotations

from pathlib import Path

import pytest
from submissions import solved

from labs.grading.feedback import report
from labs.grading.judging import pytest_run
from labs.grading.judging.grade import grade

pytestmark = pytest.mark.usefixtures("one_grader")

FAST_IS_SLOWER = """

def normal_velocity(point_velocity_a, point_velocity_b, normal):
    u = np.vecdot(relative_velocity(point_velocity_a, point_velocity_b), normal)
    return np.where(np.abs(u) > 5, 0.9 * u, u)
"""
"""No visible test of it has so fast an approach; those of impulse_magnitude and collide have."""
REST_GOES_THROUGH = """

def clamp_to_square(tangent_force, limit, axis_x, axis_y):
    force, most = np.asarray(tangent_force), np.asarray(limit)
    x, y = np.vecdot(force, axis_x), np.vecdot(force, axis_y)
    rest = force - x[..., None] * axis_x - y[..., None] * axis_y
    return np.clip(x, -most, most)[..., None] * axis_x + np.clip(y, -most, most)[..., None] * axis_y + rest
"""
WRITES = """

def contact_impulses(magnitude, normal):
    impulse = np.asarray(magnitude)[..., None] * normal
    normal *= -1.0
    return impulse, -impulse
"""
DIFFERENCE_OF_ONE = """

def relative_velocity(point_velocity_a, point_velocity_b):
    a, b = point_velocity_a, point_velocity_b
    return np.array([a[0] - b[0], a[1] - b[1], a[2] - b[2]])
"""
WRITES_FOR_ONE = """

def relative_velocity(point_velocity_a, point_velocity_b):
    point_velocity_a -= point_velocity_b
    return point_velocity_a
"""
"""It fails where one velocity of A stands for several of B, of which no visible test has a case."""
NOT_INVERTED = """

def world_inverse_inertia(inertia, orientation):
    rotation = rotation_matrix(orientation)
    return (rotation * np.asarray(inertia)[..., None, :]) @ np.swapaxes(rotation, -1, -2)
"""
COUNTED = """
calls = []


def relative_velocity(point_velocity_a, point_velocity_b):
    calls.append(1)
    return (point_velocity_a - point_velocity_b) * (1 if len(calls) < 250 else 2)
"""
"""Right in the process of any test, wrong after more calls than a test makes."""


def checked(folder: Path, topic: str, more: str, names: tuple[str, ...] = ()):
    """The sheet of the visible tests on the solutions with another function, and the report."""
    path = solved(folder, topic)
    path.write_text(path.read_text() + more)
    sheet = pytest_run.run(path, (topic,), (pytest_run.VISIBLE,), functions=names)
    return sheet, " ".join("\n".join(report.report(sheet, (topic,))).split())


def test_a_suspect_is_named_before_its_callers_are_blamed(tmp_path):
    sheet, text = checked(tmp_path, "impulse", FAST_IS_SLOWER)
    assert list(sheet.suspects) == ["normal_velocity"]
    assert "? normal_velocity suspect It passes these tests, and is wrong on other input all the same." in text
    assert "For example normal_velocity(" in text
    calls = "It calls your normal_velocity, which passes its tests but is suspect: look there first."
    for caller in ("impulse_magnitude", "collide"):
        assert caller in sheet.lost
        blamed = text.split(f"✗ {caller} ")[1].split(" ✓ ")[0].split(" ✗ ")[0]
        assert calls in blamed
        assert "physics" not in blamed
        assert "Hint" not in blamed
    assert "1 suspect. Next: normal_velocity, marked ? above." in text
    assert not report.all_right(sheet)


def test_checking_one_function_names_the_suspect_that_it_calls(tmp_path):
    sheet, text = checked(tmp_path, "impulse", FAST_IS_SLOWER, ("collide",))
    assert list(sheet.suspects) == ["normal_velocity"]
    assert "? normal_velocity suspect" in text
    assert "It calls your normal_velocity, which passes its tests but is suspect" in text
    assert text.endswith("Next: normal_velocity, marked ? above.")


def test_a_caller_of_a_wrong_function_is_no_suspect(tmp_path):
    """It answers the probes wrongly, because of the function that it calls."""
    sheet, _ = checked(tmp_path, "impulse", FAST_IS_SLOWER, ("normal_velocity", "impulse_magnitude"))
    assert list(sheet.suspects) == ["normal_velocity"]
    sheet, _ = checked(tmp_path, "impulse", FAST_IS_SLOWER.replace("> 5", "> 500"))
    assert sheet.suspects == {}


def test_a_function_of_one_case_excuses_no_wrong_number_of_its_caller(tmp_path):
    sheet, text = checked(
        tmp_path, "impulse", FAST_IS_SLOWER + DIFFERENCE_OF_ONE, ("relative_velocity", "normal_velocity")
    )
    assert sheet.diagnoses["relative_velocity"].verdict == "one at a time"
    assert list(sheet.suspects) == ["normal_velocity"]
    assert "? normal_velocity suspect" in text


@pytest.mark.slow
def test_a_function_is_not_blamed_for_a_wrong_one_that_only_its_scenario_calls(tmp_path):
    for names in ((), ("collide",)):
        _, text = checked(tmp_path, "impulse", NOT_INVERTED, names)
        blamed = text.split("✗ collide ")[1]
        assert "This run also calls your world_inverse_inertia, which is not right yet: look there first." in blamed
        assert "physics" not in blamed
        assert text.endswith("Next: world_inverse_inertia, marked ✗ above.")


@pytest.mark.slow
def test_a_suspect_with_a_known_mistake_is_told_which(tmp_path):
    sheet, text = checked(tmp_path, "friction", REST_GOES_THROUGH)
    assert [found.mistakes[0].id for found in sheet.suspects.values()] == ["clamp_to_square/rest goes through"]
    assert "What lies across both axes is kept" in text
    assert "16 of 17 functions right, 1 suspect" in text


def test_a_function_that_writes_into_its_arguments_is_suspect(tmp_path):
    sheet, text = checked(tmp_path, "impulse", WRITES, ("contact_impulses",))
    assert list(sheet.suspects) == ["contact_impulses"]
    assert "It writes into its arguments" in text


def test_a_function_of_one_case_that_writes_into_its_arguments_is_suspect(tmp_path):
    sheet, text = checked(tmp_path, "impulse", WRITES_FOR_ONE, ("relative_velocity",))
    assert sheet.lost == []
    assert list(sheet.suspects) == ["relative_velocity"]
    assert "It writes into its arguments" in text


def test_what_an_earlier_function_left_behind_makes_no_suspect(tmp_path):
    assert checked(tmp_path, "impulse", COUNTED)[0].suspects == {}


@pytest.mark.slow
def test_a_suspect_costs_no_point(tmp_path):
    path = solved(tmp_path, "friction")
    right = grade(path, ("friction",), (pytest_run.VISIBLE,))
    path.write_text(path.read_text() + REST_GOES_THROUGH)
    found = grade(path, ("friction",), (pytest_run.VISIBLE,))
    assert found.sheet.earned == right.sheet.earned == right.sheet.points
    told = {each["name"]: (each["verdict"], each["suspect"]) for each in found.content()["functions"]}
    assert told["clamp_to_square"] == ("named", True)
    assert told["clamp_to_circle"] == ("right", False)
