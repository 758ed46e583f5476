"""A student's `step_world` runs as the world of an implementation: one scenario at a time, in plain arrays."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.catalogue.scenarios import find
from reference.comparison.results import Job
from reference.comparison.verdicts import Verdict
from reference.engines import load_engine
from reference.engines.handwritten import world
from reference.engines.implementation import Implementation
from reference.errors import NeedsFunction, RunFailed
from reference.running.study import run_job
from reference.scene.forces import GrowingForce
from reference.scene.scenario import Body, Scenario, Sphere

HEAD = "import numpy as np\nfrom solutions.forces import *\nfrom solutions.impulse import *\n"
STUDENT = HEAD + "from solutions.world import collect_contacts, step_world\n"
FREE_FALL = (
    HEAD
    + """
def step_world(bodies, state, acceleration, dt, rules, memory=None, force=0.0, torque=0.0):
    position, orientation, velocity, spin = state
    velocity = velocity + dt * (acceleration + bodies[0][:, None] * force)
    return position + dt * velocity, orientation, velocity, spin, np.zeros(0), np.zeros((0, 3))
"""
)
WRONG = HEAD + "\ndef step_world(bodies, state, *others):\n    return state\n"
UNWRITTEN = HEAD + "\ndef step_world(bodies, state, *others):\n    raise NotImplementedError('yours')\n"


def handed_in(folder, text):
    path = folder / "mine.py"
    path.write_text(text)
    return str(path)


def rows(folder, text, family, *cases, **changes):
    return run_job(Job(family, "handwritten", "world", cases, handed_in(folder, text), tuple(changes.items()))).rows


def trajectory(folder, text, name, **changes):
    engine = load_engine("handwritten", Implementation(handed_in(folder, text)))
    scenario = find(name)[1].scenarios[0]
    return engine.run(scenario, engine.settings(scenario, "world").change(**changes))


@pytest.mark.slow
def test_the_rebound_is_what_the_method_predicts(tmp_path):
    found = {row.quantity: row.verdict for row in rows(tmp_path, STUDENT, "one-drop", "e=0.5", timestep=0.004)}
    assert found.pop("steps") == Verdict.SHOWN
    assert set(found.values()) <= {Verdict.PASS, Verdict.KNOWN_DEVIATION}


@pytest.mark.slow
def test_a_growing_push_breaks_a_slab_away_when_theory_says(tmp_path):
    found = {row.quantity: row for row in rows(tmp_path, STUDENT, "break-away", "μ=0.3,rate=20")}
    assert {row.verdict for row in found.values()} <= {Verdict.PASS, Verdict.KNOWN_DEVIATION, Verdict.SHOWN}
    assert found["break_away"].measured == pytest.approx(found["break_away"].predicted, abs=1e-6)  # s


@pytest.mark.slow
def test_a_stack_stands_in_long_steps(tmp_path):
    engine = load_engine("handwritten", Implementation(handed_in(tmp_path, STUDENT)))
    scenario, step, sweeps = replace(find("stack/boxes=5")[1].scenarios[0], duration=2.0), 0.02, 60
    found = engine.run(scenario, engine.settings(scenario, "world").change(timestep=step))
    places = np.array([found.position(f"cube {k}") for k in range(1, 6)])
    # A sweep through a chain of n equal bodies on a floor leaves cos² π/(2n + 1) of what is missing at its contacts. A
    # cube that lacks this share on one side falls by it times g dt² there, and leans over its width of 0.2 m. If all
    # lean the same way, the top, 1 m high, moves by five times as much
    missing = np.cos(np.pi / 11) ** (2 * sweeps)
    fallen = missing * 9.81 * step**2
    drift = np.linalg.norm((places - places[:, :1])[..., :2], axis=-1)
    assert np.max(np.abs((places - places[:, :1])[..., 2])) < fallen
    assert np.max(drift) < 5 * fallen < 1e-3  # the scenario allows 1 mm


@pytest.mark.slow
def test_touching_balls_pass_the_blow_on_and_no_other_reading_is_predicted(tmp_path):
    found = {row.quantity: row for row in rows(tmp_path, STUDENT, "cradle", "5 touching")}
    assert (found["first"].measured, found["last"].measured) == pytest.approx((0, 1), abs=1e-9)
    assert found["first"].verdict is Verdict.SHOWN
    assert found["off"].verdict is Verdict.PASS


def test_the_full_world_is_told_from_the_one_of_the_lab():
    names = "advance_world", "step_world"
    assert Implementation("solutions").first_defined(names) == "advance_world"
    assert Implementation("labs.desk").first_defined(names) == "step_world"


def test_the_earlier_source_decides_which_world_runs(tmp_path):
    both = Implementation(f"{handed_in(tmp_path, FREE_FALL)} | solutions")
    assert both.first_defined(("advance_world", "step_world")) == "step_world"


def test_a_first_version_without_contacts_falls(tmp_path):
    fallen = trajectory(tmp_path, FREE_FALL, "projectile/v=12,θ=30°")
    start, end = fallen.velocities[0, 0], fallen.velocities[-1, 0]
    assert end[2] - start[2] == pytest.approx(-9.81 * fallen.times[-1], rel=1e-9)
    assert len(fallen.contacts.sample) == 0


def test_a_force_is_that_of_the_start_of_its_step(tmp_path):
    growing, dt, mass = (1.0, 2.0, -3.0), 0.01, 2.0
    ball = Body("ball", Sphere(0.1), mass)
    pushed = Scenario("pushed", (ball,), (), 0.1, (0.0, 0.0, 0.0), forces=(GrowingForce("ball", growing),))
    engine = load_engine("handwritten", Implementation(handed_in(tmp_path, FREE_FALL)))
    run = engine.run(pushed, engine.settings(pushed, "world").change(timestep=dt))
    steps = np.rint(run.times / dt)
    gained = dt**2 / mass * np.outer(steps * (steps - 1) / 2, growing)  # Σ R k dt · dt/m from k = 0 on
    np.testing.assert_allclose(run.velocities[:, 0], gained, rtol=1e-12, atol=1e-15)


def test_a_memory_in_lists_is_taken_as_well(tmp_path):
    lists = "\n\narrays = step_world\n\n\ndef step_world(*given):\n    return [list(each) for each in arrays(*given)]\n"
    found, wanted = (
        trajectory(tmp_path, text, "one-drop/e=0.5", timestep=0.005) for text in (STUDENT + lists, STUDENT)
    )
    assert np.array_equal(found.positions, wanted.positions)


def test_its_contacts_are_in_the_trajectory(tmp_path):
    found = trajectory(tmp_path, STUDENT, "one-drop/e=0.5", timestep=0.005)
    assert len(found.contacts.sample) > 0
    assert np.allclose(np.linalg.norm(found.contacts.normal, axis=1), 1)


def test_a_wrong_result_is_told_in_words(tmp_path):
    with pytest.raises(RunFailed, match="must return position, orientation, velocity and angular_velocity of 2 bodies"):
        trajectory(tmp_path, WRONG, "dropped-ball/e=0.5")


@pytest.mark.parametrize(
    ("text", "name", "needs"),
    [
        (UNWRITTEN, "dropped-ball/e=0.5", r"^needs step_world \(world, step 1\)$"),
        (STUDENT, "ball-in-a-bowl/depth=0.3125", "balls, boxes and planes"),
        (STUDENT, "two-frictions/θ=18°", "one coefficient"),
    ],
)
def test_what_the_world_of_the_lab_lacks_is_named(tmp_path, text, name, needs):
    with pytest.raises(NeedsFunction, match=needs):
        trajectory(tmp_path, text, name)


@pytest.mark.parametrize("runs", [1, 50])
def test_a_job_that_would_take_too_long_says_so_before_its_end(tmp_path, monkeypatch, runs):
    monkeypatch.setattr(world, "LOOKS_AFTER", 0.0)
    monkeypatch.setattr(world, "LONGEST", 1e-3)  # s; one run of the ball takes longer
    engine = load_engine("handwritten", Implementation(handed_in(tmp_path, FREE_FALL)))
    scenario = find("projectile/v=12,θ=30°")[1].scenarios[0]
    with pytest.raises(RunFailed, match=r"too slow: .* of [\d,]+ steps, so that all would take"):
        engine.run_many([scenario] * runs, engine.settings(scenario, "world"))
