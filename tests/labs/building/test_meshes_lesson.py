"""What the lesson on spring meshes says in numbers: its experiments, the engines' recordings, and its model answers."""

from __future__ import annotations

import re

import numpy as np
import pytest
from made_lessons import experiments_of, printed, recorded, text_of

from labs.building import lessons
from labs.desk.case_runs import CaseRuns
from labs.desk.tables import tables
from reference.catalogue.scenarios import find
from reference.running.study import plan, run_job
from solutions.meshes import (
    cloth,
    edge_stiffness,
    lattice,
    mesh_matrix,
    spring_mesh,
    stable_timestep,
    static_shape,
    zero_energy_modes,
)

pytestmark = pytest.mark.slow  # `make test` has test_detection_lesson of this kind

ENGINES = ("pybullet", "mujoco", "dart")


@pytest.fixture(scope="module")
def text():
    return text_of("meshes")


@pytest.fixture(scope="module")
def experiments():
    return experiments_of("meshes")


def test_the_block_of_edges_ends_below_the_table(text):
    heights = [recorded(engine, "jelly/edges,push=0.15", "tuned", "height") for engine in ENGINES]
    assert np.round(1e3 * np.array(heights)).tolist() == [-62] * 3
    assert "The upper masses end 62 mm *below* the table" in text


def test_most_contributions_are_lost_without_an_error(experiments, capsys):
    assert "198 of 1004" in printed(capsys, experiments.count_arrivals)


def test_first_versions_bring_a_chain_to_rest(tmp_path):
    cells = lessons.read("meshes").cells
    drafts = [cell.text for cell in cells if cell.kind == "model" and cell.key.startswith("draft-")]
    assert len(drafts) == 2
    first = tmp_path / "first.py"
    first.write_text("import numpy as np\nfrom solutions.meshes import *\n" + "\n".join(drafts), encoding="utf-8")
    family, case = find("hanging-chain/span=0.3,k=60")
    (job,) = plan([family], ["handwritten"], ["step"], {family.name: (case.name,)}, f"{first} | solutions")
    result = run_job(job)
    sag = next(row for row in result.rows if row.quantity == "sag")
    assert sag.measured == pytest.approx(sag.expected, rel=1e-3)  # the tolerance of theory, dampers or not
    shown = str(tables(CaseRuns(family, case, (result,)), ["sag", "pull"]))
    assert shown.count("✓~") == 3  # both numbers and the legend: without dampers the last digits differ
    assert "✗" not in shown


def test_damping_of_every_node_stops_a_thrown_cube_and_dampers_do_not(experiments, capsys):
    assert "0.25 m after a second" in printed(capsys, experiments.thrown_cube)
    assert printed(capsys, experiments.thrown_again).startswith("5.00 m")


def test_a_damper_feels_only_what_changes_its_length(experiments, capsys):
    assert printed(capsys, experiments.one_of_each).split("\n")[:3] == [
        "it spins: [0. 0. 0.] N on the first node",
        "it flies: [0. 0. 0.] N on the first node",
        "it grows: [4. 0. 0.] N on the first node",
    ]


def test_the_fourth_diagonal_of_space_is_in_vain(experiments, capsys):
    assert re.findall(r"(\d+) motions", printed(capsys, experiments.with_space_diagonals)) == ["12", "9"]
    assert re.findall(r"(\d+) of 16 needed, (\d+)", printed(capsys, experiments.count_the_needed)) == [("6", "6")] * 2


def test_blocks_need_as_many_diagonals_as_the_lesson_derives(experiments, capsys):
    for a, b, c, needed in re.findall(r"\((\d), (\d), (\d)\): (\d+) of", printed(capsys, experiments.blocks)):
        assert int(needed) == int(a) * int(b) + int(b) * int(c) + int(c) * int(a) - 6


def test_with_the_fewest_diagonals_a_bar_sags_by_two_thirds_more(experiments, capsys):
    few, every = (int(each) for each in re.findall(r"(\d+) mm", printed(capsys, experiments.sagging_bars)))
    assert few / every == pytest.approx(5 / 3, rel=0.05)
    position, springs, _ = experiments.brace((5, 2, 2))
    bar = spring_mesh(position, springs, 500.0, 0.0, 0.01, range(4))
    end = static_shape(bar, position, (0, 0, -9.81), 1e-6)[-4:, 2].mean()
    assert few == pytest.approx(50 - 1e3 * end, abs=1)  # it has come to rest


def test_a_bar_of_edges_alone_hangs_down():
    position, edges = lattice(5, 2, 2, 0.1, ("structural",))
    bar = spring_mesh(position, edges, 500.0, 0.0, 0.01, range(4))
    end = static_shape(bar, position, (0, 0, -9.81), 1e-6)[-4:, 2].mean()
    assert 0.05 - end == pytest.approx(0.4, abs=0.005)


def test_internal_springs_shorten_the_step_as_the_lesson_says(experiments, capsys, text):
    assert re.findall(r": ([\d.]+)", printed(capsys, experiments.longest_steps)) == ["1.012", "0.720", "0.646"]
    steps = []
    for kinds in (("structural",), ("structural", "face"), ("structural", "face", "space")):
        position, edges = lattice(2, 2, 2, 1.0, kinds)
        steps.append(f"{stable_timestep(spring_mesh(position, edges, 1.0), position):.2f}")
    assert steps == ["1.41", "0.82", "0.71"]
    assert f"{steps[0]} √(m/k) with edges alone, {steps[1]} with the diagonals of its faces, and {steps[2]}" in text
    assert f"{2 / 0.646:.1f} times too long" in text
    assert re.findall(r"([\d.]+) % short", printed(capsys, experiments.bound_and_truth)) == ["30", "37"]


def test_a_hundredth_above_the_limit_everything_explodes_alike(text):
    growth = [recorded(engine, "step-limit/structural,ratio=1.01", "tuned", "growth") for engine in ENGINES]
    assert np.round(growth, 2).tolist() == [2.95] * 3
    assert round(10 ** np.mean(growth), -1) == 880
    assert "2.95, a factor of 880" in text


def test_your_limit_is_that_of_tendons_with_euler(experiments, capsys):
    rows = {row[0]: row[1:] for row in map(str.split, printed(capsys, experiments.tendons).splitlines()[1:])}
    assert rows.pop("RK4") == ["holds", "holds", "holds", "-"]
    assert rows == {who: ["holds", "-", "-", "-"] for who in ("yours", "Euler", "implicit", "implicitfast")}


def test_long_implicit_steps_keep_a_tenth_of_a_swing(experiments, capsys):
    assert re.findall(r"([\d.]+) of the swing", printed(capsys, experiments.one_swing)) == ["0.97", "0.73", "0.11"]


def test_a_ball_wider_than_the_net_passes_between_its_nodes(experiments, capsys):
    assert re.findall(r"(\d+) nodes", printed(capsys, experiments.through_the_net)) == ["0", "0", "0", "4", "4"]


def test_a_correction_crawls_along_a_rope(experiments, capsys):
    assert printed(capsys, experiments.ten_rounds).strip() == "0.50"
    assert re.findall(r"([\d.]+)$", printed(capsys, experiments.more_rounds), re.MULTILINE) == [
        "0.500", "0.500", "0.390", "0.101",
    ]  # fmt: skip


def test_the_welded_arm_of_a_crane_needs_a_diagonal_for_each_row_that_slides():
    for along, across in ((5, 3), (3, 2)):
        position, edges = lattice(along, across, across, 1.0, ("structural",))
        arm = spring_mesh(position, edges, 1.0, pinned=range(across * across))
        assert zero_energy_modes(arm, position) == 2 * (along - 1) * across
        assert zero_energy_modes(spring_mesh(position, edges, 1.0), position) == 2 * along * across + across**2


@pytest.mark.parametrize(
    ("integrator", "holding", "exploding"),
    [("Euler", 0.64, 0.652), ("implicit", 0.64, 0.652), ("implicitfast", 0.64, 0.652), ("RK4", 0.70, 1.0)],
)
def test_a_cloth_of_tendons_holds_and_explodes_where_the_table_says(integrator, holding, exploding, installed):
    mujoco = installed("mujoco") and pytest.importorskip("mujoco")
    position, edges = cloth(10, 10, 1.0)
    mesh = spring_mesh(position, edges, 1.0)
    fastest = np.linalg.eigh(mesh_matrix(mesh, edge_stiffness(mesh, position)))[1][:, -1]
    for step, bounded in ((holding, True), (exploding, False)):
        model = tendons(mujoco, mesh, position, step, integrator)
        data = mujoco.MjData(model)
        data.qpos[:] = 1e-6 * fastest
        for _ in range(600):
            mujoco.mj_step(model, data)
            if np.abs(data.qpos).max() > 1e-3:  # a thousand times the start; near the limit energy beats tenfold
                break
        assert (np.abs(data.qpos).max() < 1e-4) == bounded


def tendons(mujoco, mesh, position, step, integrator):
    """The mesh in MuJoCo: point masses on three sliders each, and a tendon for every spring. No weight."""
    slides = "".join(f'<joint type="slide" axis="{axis}"/>' for axis in ("1 0 0", "0 1 0", "0 0 1"))
    bodies = "".join(
        f'<body pos="{" ".join(f"{float(x)!r}" for x in place)}">{slides}<site name="s{node}"/>'
        '<inertial pos="0 0 0" mass="1" diaginertia="1e-3 1e-3 1e-3"/></body>'
        for node, place in enumerate(position)
    )
    springs = "".join(
        f'<spatial springlength="{float(rest)!r}" stiffness="1"><site site="s{i}"/><site site="s{j}"/></spatial>'
        for (i, j), rest in zip(mesh.edges, mesh.rest_length, strict=True)
    )
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{step}" integrator="{integrator}" gravity="0 0 0"/>'
        f"<worldbody>{bodies}</worldbody><tendon>{springs}</tendon></mujoco>"
    )
