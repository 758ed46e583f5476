"""What hand-written code, PyBullet and MuJoCo make of a bounce, and the closed forms behind it."""

from __future__ import annotations

import functools
import math
from dataclasses import replace

import numpy as np
import pytest
from catalogue_rows import (
    BOUNCES,
    FALL,
    MEAN_SPEED,
    SPEED,
    G,
    all_three,
    counted,
    fast_and_slow,
    job,
    near,
    rebound_of_a_tenth,
    rebound_of_many,
    restitution,
    row,
    slow,
    tenth_of_drops,
    weekly,
)

from reference.catalogue import measure
from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.bouncing_ball import falling_ball
from reference.comparison.convergence import order_of
from reference.comparison.errors_by_settings import Question
from reference.comparison.verdicts import Verdict
from reference.engines import load_engine

# Hand-written, exact root


@functools.cache
def bounces(profile: str):
    engine, scenario = load_engine("handwritten"), falling_ball("bounces", 0.9, 1.0, 5.0)
    return engine.run(scenario, engine.settings(scenario, profile))


def test_the_exact_root_rebounds_to_the_powers_of_e_squared():
    apexes = measure.apex_heights(bounces("exact"), "ball", "floor")[:5]
    # 1e-9 m: the parabolas are solved; only rounding, 1e-16 of some metres in each of 5000 steps, is left.
    np.testing.assert_allclose(apexes, [0.81, 0.6561, 0.531441, 0.43046721, 0.3486784401], atol=1e-9)


def test_the_exact_root_lands_at_the_times_of_the_geometric_series():
    times = np.array([event.time for event in bounces("exact").events if event.kind == "impact"][:6])
    assert [f"{time:.5f}" for time in times] == ["0.45152", "1.26427", "1.99573", "2.65406", "3.24655", "3.77979"]
    series = FALL * np.array([1 + 2 * sum(0.9**k for k in range(1, impact + 1)) for impact in range(6)])
    np.testing.assert_allclose(times, series, atol=1e-9)  # rounding of 1e-15 m at some m/s, a thousand steps long
    np.testing.assert_allclose(measure.impact_times(bounces("exact"), "ball", "floor")[:6], series, atol=1e-9)


@pytest.mark.slow
def test_the_exact_root_comes_to_rest_when_the_series_ends():
    end = row("ball-to-rest", "handwritten", "exact", "e=0.9", "rest_time").measured
    assert f"{end:.5f}" == "8.57895"
    # What is cut off below 1e-12 s of flight is 2 e v/(g (1 − e)) = 1e-11 s; the rest is rounding.
    assert end == pytest.approx(FALL * 1.9 / 0.1, abs=1e-9)


def test_the_exact_root_keeps_energy_over_a_hundred_elastic_bounces():
    engine, scenario = load_engine("handwritten"), falling_ball("elastic", 1.0, 1.0, 199.5 * FALL)
    trajectory = engine.run(scenario, engine.settings(scenario, "exact").change(timestep=0.05))
    assert sum(event.kind == "impact" for event in trajectory.events) == 100
    energy = measure.energy(trajectory, "ball")
    # 1800 steps and 100 bounces that each round a speed of some m/s and a height of 1 m, by 1e-16, mostly at random.
    np.testing.assert_allclose(energy, energy[0], rtol=2e-12)


# Hand-written, the other policies


TIMESTEPS = (4e-3, 2e-3, 1e-3, 5e-4)


def errors_of(profile: str) -> list[float]:
    """Root mean square error of the rebound of a tenth of the drops, by timestep."""
    engine, few = load_engine("handwritten"), tenth_of_drops("e=0.5")
    question = Question.of(replace(catalogue()["dropped-ball"], cases=(few,)), engine)
    settings = engine.settings(few.scenarios[0], profile)
    return [question.rms_error(settings.change(timestep=dt)) for dt in TIMESTEPS]


@pytest.mark.parametrize(("profile", "order"), [("slide", 2), ("step", 1)])
def test_the_slides_t_is_of_second_order_and_the_step_of_first(profile, order):
    # Two decades of timesteps on a log–log line whose points scatter by 1/11 of the error.
    assert order_of(TIMESTEPS, errors_of(profile), 0.25) == pytest.approx(order, abs=0.1)


def test_the_exact_root_has_no_measurable_order_of_error():
    errors = errors_of("exact")
    assert max(errors) < 1e-12
    assert order_of(TIMESTEPS, errors, 0.25) is None


@fast_and_slow("case", ("e=0", "e=0.8"), BOUNCES)
def test_the_slides_t_rebounds_too_high_by_at_most_the_chords_sagitta(case):
    found = rebound_of_many("handwritten", "slide", case, timestep=4e-3)
    if restitution(case) == 0:
        assert found.measured == 0
    else:
        assert 0 < found.error < G * 4e-3**2 / 8  # at most the sagitta of the parabola over one step


@fast_and_slow("case", ("e=0.2",), BOUNCES[1:])
def test_the_step_method_rebounds_low_by_one_minus_e_times_half_a_step(case):
    e = restitution(case)
    found = rebound_of_many("handwritten", "step", case)
    assert found.error == pytest.approx(-(1 - e) * MEAN_SPEED * 1e-3 / 2, abs=near(1e-3))


# The first rebound in the two engines


@fast_and_slow("case", ("e=0.2",), BOUNCES[1:], rest=weekly)
@pytest.mark.slow
def test_pybullet_rebounds_within_a_percent_of_e_squared(case, installed):
    installed("pybullet")
    found = rebound_of_many("pybullet", "tuned", case)
    e = restitution(case)
    assert found.error == pytest.approx(0, abs=(0.06 if e == 0.2 else 0.01) * e**2)  # what is promised
    assert found.error == pytest.approx(0, abs=near(1e-3))  # what theory says: the share 1 − e recovered leaves no bias
    assert found.verdict is Verdict.PASS


@slow
def test_pybullet_at_half_a_millisecond_is_within_three_percent(installed):
    installed("pybullet")
    found = rebound_of_many("pybullet", "tuned", "e=0.2", timestep=5e-4)
    assert found.error == pytest.approx(0, abs=0.03 * 0.2**2)  # what is promised
    assert found.error == pytest.approx(0, abs=near(5e-4))


@fast_and_slow("case", ("e=0.2",), BOUNCES[1:])
def test_mujoco_rebounds_within_a_percent_of_e_squared(case, installed):
    installed("mujoco")
    found = rebound_of_a_tenth("mujoco", "tuned", case)  # v dt/11 is 0.04 mm of a mean, a thirtieth of the promise
    e = restitution(case)
    assert found.error == pytest.approx(0, abs=(0.03 if e == 0.2 else 0.01) * e**2)  # what is promised
    assert found.verdict is Verdict.PASS


@pytest.mark.parametrize(
    ("case", "timestep"),
    # The scatter is a product: e is varied at one timestep and the timestep at one e, of which `make verify` has a run.
    [
        ("e=0.2", 1e-3),
        ("e=0.2", 5e-4),
        *(pytest.param(case, 1e-3, marks=weekly) for case in ("e=0.5", "e=0.8", "e=0.95")),
    ],
)
@pytest.mark.slow
def test_single_pybullet_drops_scatter_by_e_times_one_minus_e_of_v_dt(case, timestep, installed):
    installed("pybullet")
    e = restitution(case)
    changes = {} if timestep == 1e-3 else {"timestep": timestep}  # 1 ms is what the profile has
    found = rebound_of_many("pybullet", "tuned", case, **changes)
    # The depth is even between 0 and v dt, which has the deviation v dt/√12. 1 %: N even phases are not a continuum.
    assert found.spread == pytest.approx(e * (1 - e) * SPEED * timestep / math.sqrt(12), rel=0.01)


@pytest.mark.parametrize(
    ("case", "timestep"),
    # The bias is a product as well, and what it may be off is a share of it at any timestep.
    [
        ("e=0.2", 2e-3),
        ("e=0.2", 1e-3),
        ("e=0.2", 5e-4),
        *(pytest.param(case, 2e-3, marks=weekly) for case in BOUNCES[2:]),
    ],
)
@pytest.mark.slow
def test_pybullet_without_overlap_recovery_rebounds_low_by_half_a_step(case, timestep, installed):
    installed("pybullet")
    e = restitution(case)
    found = rebound_of_many("pybullet", "tuned", case, contact_erp=0.0, timestep=timestep)
    assert found.error == pytest.approx(-(1 - e) * MEAN_SPEED * timestep / 2, abs=near(timestep))
    assert found.verdict is (Verdict.KNOWN_DEVIATION if e == 0.2 else Verdict.PASS)


@pytest.mark.parametrize(
    ("case", "timestep"),
    # Of two terms the first goes with the timestep, so a step of 0.1 ms shows the second: `share` has two branches.
    [
        ("e=0.8", 1e-3),
        ("e=0.8", 1e-4),
        pytest.param("e=0.95", 1e-4, marks=weekly),
        *(pytest.param(case, 1e-3, marks=weekly) for case in BOUNCES[1:] if case != "e=0.8"),
    ],
)
@pytest.mark.slow
def test_mujoco_rebounds_low_by_half_a_step_plus_what_its_spring_adds(case, timestep, installed):
    installed("mujoco")
    e = restitution(case)
    found = rebound_of_many("mujoco", "tuned", case, timestep=timestep)
    # The spring turns the share r of the overlap d into the speed r d/dt, on the average r v/2. So e v + r v/2 leaves,
    # which reaches e r v²/(2g) = e r h higher: a share of the drop height that no timestep removes.
    share = min(1e-4, 0.01 * (1 - e) ** 2)
    bias = -(1 - e) * MEAN_SPEED * timestep / 2 + e * share
    assert found.error == pytest.approx(bias, abs=near(timestep))


@pytest.mark.parametrize("timestep", [4e-3, pytest.param(2.5e-4, marks=slow)])  # at 0.2 ms it is near
def test_mujocos_bias_is_a_known_deviation_at_every_timestep(timestep, installed):
    installed("mujoco")
    found = rebound_of_many("mujoco", "tuned", "e=0.2", timestep=timestep)
    assert abs(found.error) > found.tolerance  # more than 1 %
    assert found.verdict is Verdict.KNOWN_DEVIATION


@slow
def test_pybullets_scatter_and_bias_shrink_with_the_timestep(installed):
    installed("pybullet")
    coarse = rebound_of_many("pybullet", "tuned", "e=0.2", contact_erp=0.0, timestep=1e-3)
    fine = rebound_of_many("pybullet", "tuned", "e=0.2", contact_erp=0.0, timestep=5e-4)
    assert fine.spread == pytest.approx(coarse.spread / 2, rel=0.01)  # both go with v dt, up to the spread of phases
    assert fine.error == pytest.approx(coarse.error / 2, rel=0.01)


# Rest


@fast_and_slow("case", ("e=0.5",), tuple(case.name for case in catalogue()["ball-to-rest"].cases))
@all_three
def test_a_ball_at_rest_lies_on_the_floor_and_stays_there(name, case, installed):
    installed(name)
    found = {entry.quantity: entry for entry in job("ball-to-rest", name, counted(name), case).rows}
    assert abs(found["rest_height"].measured) < 1e-3  # m
    assert found["residual_speed"].measured < 1e-3  # m/s, over 5 s
    assert found["drift"].measured < 1e-3  # m, over 5 s
    assert all(entry.verdict is Verdict.PASS for entry in found.values())  # the time of rest among them
