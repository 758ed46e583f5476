"""Functions that pass their visible tests and are wrong all the same: named before a caller is blamed."""

from __future__ import annotations

from pathlib import Path

import pytest
from submissions import solved

from labs.grading.feedback import report
from labs.grading.judging import pytest_run
from labs.grading.judging.grade import grade

pytestmark = pytest.mark.usefixtures("one_grader")

SLOWER_ALONG_Y = """

def normal_velocity(body_a, body_b, normal):
    moves = [body[0] + np.cross(body[1], body[2]) for body in (body_a, body_b)]
    u = np.vecdot(moves[0] - moves[1], normal)
    return np.where(np.asarray(normal)[..., 1] > 0.8, 0.9 * u, u)
"""
"""No visible test of it has such a normal; those of impulse_magnitude and collide have."""
TOUCHING_LEFT_OUT = """

def polyhedra_intersect(vertices_a, faces_a, vertices_b, faces_b):
    a, b = ((np.asarray(v, dtype=float), np.asarray(f)) for v, f in ((vertices_a, faces_a), (vertices_b, faces_b)))
    return goes_through(a, b) or goes_through(b, a) or a_corner_inside(a, b) or a_corner_inside(b, a)


def goes_through(a, b):
    for (start, end), face in zip(*edges_through_faces(*a, *b), strict=True):
        p, q, (u, v, w) = a[0][start], a[0][end], b[0][b[1][face]]
        n = np.cross(v - u, w - u)
        if (n @ (p - u)) * (n @ (q - u)) < -1e-12:
            x = p + (n @ (u - p)) / (n @ (q - p)) * (q - p)
            if all(n @ np.cross(g - h, x - h) > 1e-9 for h, g in ((u, v), (v, w), (w, u))):
                return True
    return False


def a_corner_inside(a, b):
    if not len(a[1]) or not len(b[1]):
        return False
    corners = a[0][np.unique(a[1])]
    return bool(np.any(inside_by_parity(corners + 1e-6 * (corners.mean(axis=0) - corners), *b)))
"""
"""No visible test of it has two solids that only touch."""
WRITES = """

def edge_edge_normal(edge_a, edge_b, centre_a, centre_b):
    across = np.cross(edge_a, edge_b)
    across = across / np.linalg.norm(across, axis=-1, keepdims=True)
    edge_a *= -1.0
    return np.where(np.vecdot(across, np.subtract(centre_a, centre_b))[..., None] < 0, -across, across)
"""
WRONG_FOR_SMALL_E = """

def impulse_magnitude(body_a, body_b, normal, restitution):
    k = inverse_effective_mass(body_a, body_b, normal)
    j = -(1 + np.asarray(restitution)) * normal_velocity(body_a, body_b, normal) / np.where(k > 0, k, 1.0)
    return np.where(k > 0, np.where(np.asarray(restitution) < 0.2, 0.9 * j, j), 0.0)
"""
"""No visible test of it has so small a restitution."""
ONE_CONTACT = """

def normal_velocity(body_a, body_b, normal):
    p, q = (body[0] + np.cross(body[1], body[2]) for body in (body_a, body_b))
    return sum((p[i] - q[i]) * normal[i] for i in range(3))
"""
WRITES_FOR_ONE = WRITES.replace(
    "    across = np.cross(edge_a, edge_b)",
    """
    edge_a -= 2 * edge_b
    across = np.cross(edge_a, edge_b)""",
).replace("    edge_a *= -1.0\n", "")
"""It fails where one edge of A stands for several of B, of which no visible test has a case."""
NOT_INVERTED = """

def world_inverse_inertia(inertia, orientation):
    rotation = rotation_matrix(orientation)
    return (rotation * np.asarray(inertia)[..., None, :]) @ np.swapaxes(rotation, -1, -2)
"""
COUNTED = """
calls = []


def normal_velocity(body_a, body_b, normal):
    calls.append(1)
    moves = [body[0] + np.cross(body[1], body[2]) for body in (body_a, body_b)]
    return np.vecdot(moves[0] - moves[1], normal) * (1 if len(calls) < 250 else 2)
"""
"""Right in the process of any test, wrong after more calls than a test makes."""


def checked(folder: Path, topic: str, more: str, names: tuple[str, ...] = ()):
    """The sheet of the visible tests on the solutions with another function, and the report."""
    path = solved(folder, topic)
    path.write_text(path.read_text() + more)
    sheet = pytest_run.run(path, (topic,), (pytest_run.VISIBLE,), functions=names)
    return sheet, " ".join("\n".join(report.report(sheet, (topic,))).split())


def test_a_suspect_is_named_before_its_callers_are_blamed(tmp_path):
    sheet, text = checked(tmp_path, "impulse", SLOWER_ALONG_Y)
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


@pytest.mark.slow
def test_checking_one_function_names_the_suspect_that_it_calls(tmp_path):
    sheet, text = checked(tmp_path, "impulse", SLOWER_ALONG_Y, ("collide",))
    assert list(sheet.suspects) == ["normal_velocity"]
    assert "? normal_velocity suspect" in text
    assert "It calls your normal_velocity, which passes its tests but is suspect" in text
    assert text.endswith("Next: normal_velocity, marked ? above.")


@pytest.mark.slow
def test_a_caller_of_a_wrong_function_is_no_suspect(tmp_path):
    """It answers the probes wrongly, because of the function that it calls."""
    sheet, _ = checked(tmp_path, "impulse", SLOWER_ALONG_Y, ("normal_velocity", "impulse_magnitude"))
    assert list(sheet.suspects) == ["normal_velocity"]
    sheet, _ = checked(tmp_path, "impulse", SLOWER_ALONG_Y.replace("> 0.8", "> 8"))
    assert sheet.suspects == {}


def test_a_function_of_one_case_excuses_no_wrong_number_of_its_caller(tmp_path):
    names = ("normal_velocity", "impulse_magnitude")
    sheet, text = checked(tmp_path, "impulse", ONE_CONTACT + WRONG_FOR_SMALL_E, names)
    assert sheet.diagnoses["normal_velocity"].verdict == "one at a time"
    assert list(sheet.suspects) == ["impulse_magnitude"]
    assert "? impulse_magnitude suspect" in text


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
    sheet, text = checked(tmp_path, "polyhedra", TOUCHING_LEFT_OUT)
    assert [found.mistakes[0].id for found in sheet.suspects.values()] == ["polyhedra_intersect/touching left out"]
    assert "Solids that only touch are said to be apart" in " ".join(text.split())
    assert "6 of 7 functions right, 1 suspect" in text


def test_a_function_that_writes_into_its_arguments_is_suspect(tmp_path):
    sheet, text = checked(tmp_path, "impulse", WRITES, ("edge_edge_normal",))
    assert list(sheet.suspects) == ["edge_edge_normal"]
    words = " ".join(text.split())
    assert "It passes these tests. Its answers are right, but it writes into its arguments" in words
    assert "wrong on other input" not in words


def test_a_function_of_one_case_that_writes_into_its_arguments_is_suspect(tmp_path):
    sheet, text = checked(tmp_path, "impulse", WRITES_FOR_ONE, ("edge_edge_normal",))
    assert sheet.lost == []
    assert list(sheet.suspects) == ["edge_edge_normal"]
    assert "It writes into its arguments" in text


@pytest.mark.slow
def test_what_an_earlier_function_left_behind_makes_no_suspect(tmp_path):
    assert checked(tmp_path, "impulse", COUNTED)[0].suspects == {}


@pytest.mark.slow
def test_a_suspect_costs_no_point(tmp_path):
    path = solved(tmp_path, "polyhedra")
    right = grade(path, ("polyhedra",), (pytest_run.VISIBLE,))
    path.write_text(path.read_text() + TOUCHING_LEFT_OUT)
    found = grade(path, ("polyhedra",), (pytest_run.VISIBLE,))
    assert found.sheet.earned == right.sheet.earned == right.sheet.points
    told = {each["name"]: (each["verdict"], each["suspect"]) for each in found.content()["functions"]}
    assert told["polyhedra_intersect"] == ("named", True)
    assert told["face_planes"] == ("right", False)
