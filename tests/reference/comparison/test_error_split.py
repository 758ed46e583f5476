"""Where an error comes from: an engine whose error is a known sum, and the split that must find each part of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
import pytest
from catalogue_rows import counted

from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.scenarios import catalogue
from reference.comparison import error_split
from reference.comparison.error_split import CONTACT_MODEL, DEFAULTS, DISCRETISATION, REMAINDER, SOLVER, Share, Split
from reference.comparison.errors_by_settings import Question
from reference.comparison.results import Job
from reference.engines import load_engine
from reference.engines.base import AT_STEP, Engine, Method
from reference.engines.implementation import Implementation
from reference.errors import CannotExpress, NeedsFunction, RunFailed
from reference.running.study import run_job
from reference.scene.scenario import Body, HalfSpace, Pair, Scenario, Sphere
from reference.scene.settings import Move, Option, Settings
from reference.scene.trajectory import Trajectory

slow = pytest.mark.slow
TRUE = 10.0
TUNED = Settings(0.01, 2, {"stiffness": 4.0, "iterations": 8, "drag": 0.0, "idle": 1.0})
STOCK = Settings(0.04, 1, {"stiffness": 1.0, "drag": 0.5})
MOVES = (Move(CONTACT_MODEL, "stiffness", 16.0), Move(SOLVER, "iterations", 16), Move(SOLVER, "idle", 5.0))
Error = Callable[[Settings], float]


def split(family: Family, engine: Engine, order: float | None = None) -> Split | None:
    return error_split.split(Question.of(family, engine), order)


def off(settings: Settings, order: int = 1) -> float:
    """An error made of 3 dt (or 300 dt²), 1/stiffness, 0.8/iterations, the drag, and 0.2 that nothing takes away."""
    step = 3.0 * settings.timestep if order == 1 else 300.0 * settings.timestep**2
    iterations = settings.options.get("iterations", 2)
    return step + 1 / settings.number("stiffness") + 0.8 / iterations + settings.number("drag") + 0.2


class MadeUp(Engine):
    """Its one body ends where the truth is plus an error that its settings make; it simulates nothing."""

    name = "made-up"
    title = "a made-up one"

    def __init__(self, error: Error = off, tuned: Settings = TUNED, stock: Settings = STOCK, moves=MOVES) -> None:
        super().__init__()
        self.error, self.profile, self.offered, self.seen = error, {"tuned": tuned, "stock": stock}, moves, []

    def settings(self, scenario: Scenario, profile: str) -> Settings:
        self.check_profile(scenario, profile)
        return self.profile[profile]

    def method(self, scenario: Scenario, settings: Settings) -> Method:
        return Method(AT_STEP)

    def moves(self, scenario: Scenario, settings: Settings) -> tuple[Move, ...]:
        return self.offered

    def run(self, scenario: Scenario, settings: Settings) -> Trajectory:
        self.seen.append(settings)
        ends = TRUE + self.error(settings) + scenario.body("ball").position[1]
        states = [np.zeros((2, 2, width)) for width in (3, 4, 3, 3)]
        states[0][1, 1, 0] = ends
        states[1][..., 0] = 1.0
        return Trajectory(scenario, settings, self.name, np.array([0.0, scenario.duration]), *states)


class Silent(MadeUp):
    """One that offers no moves."""

    moves = Engine.moves


def family(offsets: tuple[float, ...] = (0.0,), every_step: bool = False) -> Family:
    """A question whose answer is 10 m; each scenario of the ensemble is off by its own offset as well."""
    scenarios = tuple(
        Scenario(
            "made/one",
            (Body("floor", HalfSpace()), Body("ball", Sphere(0.1), 1.0, (0.0, offset, 0.1))),
            (Pair("ball", "floor"),),
            1.0,
        )
        for offset in offsets
    )
    case = Case("one", scenarios, {})
    ends = Quantity("ends", "where it ends", "m", lambda t: float(t.position("ball")[-1, 0]), expected)
    curve = Curve("one", "x", "x, m", lambda t: t.position("ball")[:, 0])
    study = Convergence("one", "ends", every_step=every_step)
    return Family("made", "Made", "world", (1,), "a.", "b.", ("c.",), (case,), (ends,), curve, study)


def expected(case: Case, settings: Settings, method: Method) -> Expectation:
    return Expectation(TRUE, 1e-3, "made up")


def sizes(found: Split | None) -> dict[str, float]:
    """The size of each share but the defaults, by its kind and setting; what adds up by kind is one figure."""
    assert found is not None
    kinds = [share for share in found.shares if share.kind != DEFAULTS]
    return {f"{share.kind}: {share.moved.split(' ')[0]}": share.size for share in kinds}


# The error of the tuned settings


@pytest.mark.parametrize(("order", "measured"), [(1, None), (1, 1.0), (1, 0.93), (2, 2.0), (2, 1.85), (2, 2.15)])
def test_each_share_of_a_known_sum_is_found(order, measured):
    found = split(family(), MadeUp(lambda settings: off(settings, order)), measured)
    assert sizes(found) == pytest.approx(
        {
            # Both orders make 0.03 at the tuned timestep: half the step shows half or three quarters of that.
            "discretisation: timestep": 0.03,
            # Moved from 4 to 16: of 1/4, 1/16 is left. And 0.8/8 − 0.8/16.
            "contact model: stiffness": 0.25 - 0.0625,
            "solver: iterations": 0.05,
            "solver: idle": 0.0,
            # What the moves leave, and what nothing takes away.
            "remainder: what": 0.0625 + 0.05 + 0.2,
        },
        abs=1e-14,  # rounding of numbers near 10
    )


@pytest.mark.parametrize("measured", [1.7, 2.3, 0.0, -1.0, 3.0])
def test_an_order_that_is_not_clearly_two_counts_as_one(measured):
    found = split(family(), MadeUp(), measured)
    assert sizes(found)["discretisation: timestep"] == pytest.approx(0.03, abs=1e-14)


def test_a_second_order_error_taken_for_first_order_is_overstated():
    found = split(family(), MadeUp(lambda settings: off(settings, 2)), None)
    assert sizes(found)["discretisation: timestep"] == pytest.approx(0.03 * 0.75 * 2, abs=1e-14)


def test_a_move_names_both_values_and_the_errors_before_and_after():
    share = next(share for share in split(family(), MadeUp()).shares if share.kind == CONTACT_MODEL)
    assert share.moved == "stiffness 4 → 16"
    assert (share.before, share.after) == pytest.approx((0.58 + 0.0, 0.58 - 0.1875), abs=1e-14)
    step = next(share for share in split(family(), MadeUp()).shares if share.kind == DISCRETISATION)
    assert step.moved == "timestep 0.01 → 0.005"
    assert (step.before, step.after) == pytest.approx((0.58, 0.565), abs=1e-14)


@pytest.mark.parametrize("measured", [None, 2.0])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_shares_and_the_remainder_add_up_to_the_whole(sign, measured):
    found = split(family(), MadeUp(lambda settings: sign * off(settings)), measured)
    assert sum(sizes(found).values()) == pytest.approx(sign * 0.58, abs=1e-14)
    remainder = found.shares[-1]
    assert remainder.kind == REMAINDER
    assert remainder.before == pytest.approx(sign * 0.58, abs=1e-14)
    assert remainder.after == remainder.size


def test_a_setting_that_does_nothing_has_no_share():
    found = split(family(), MadeUp(moves=(Move(SOLVER, "idle", 5.0),)))
    assert sizes(found)["solver: idle"] == 0.0


def test_a_move_that_makes_it_worse_has_a_share_against_the_error():
    found = split(family(), MadeUp(moves=(Move(SOLVER, "iterations", 4),)))
    assert sizes(found)["solver: iterations"] == pytest.approx(-0.1, abs=1e-14)
    assert sum(sizes(found).values()) == pytest.approx(0.58, abs=1e-14)


def test_an_engine_without_moves_is_split_into_the_timestep_and_the_rest():
    found = split(family(), Silent())
    assert sizes(found) == pytest.approx({"discretisation: timestep": 0.03, "remainder: what": 0.55}, abs=1e-14)


def test_an_error_of_zero_has_shares_of_zero():
    found = split(family(), MadeUp(lambda settings: 0.0))
    assert set(sizes(found).values()) == {0.0}


def test_the_error_of_an_ensemble_is_that_of_its_mean():
    found = split(family((-0.7, 0.1, 0.9)), MadeUp())
    assert sum(sizes(found).values()) == pytest.approx(0.58 + 0.1, abs=1e-14)
    assert sizes(found)["discretisation: timestep"] == pytest.approx(0.03, abs=1e-14)


@pytest.mark.parametrize(("every_step", "seen"), [(True, {1}), (False, {1, 2, 100, 200})])
def test_a_quantity_read_from_samples_is_sampled_at_every_step(every_step, seen):
    engine = MadeUp()
    split(family(every_step=every_step), engine)
    # Else as the profile has it, 2 at the tuned timestep, and about a millisecond where the timestep is halved.
    assert {settings.sample_every for settings in engine.seen} <= seen
    assert {settings.timestep for settings in engine.seen} == {0.04, 0.01, 0.005}


# From stock to tuned


def defaults(found: Split | None) -> list[Share]:
    assert found is not None
    return [share for share in found.shares if share.kind == DEFAULTS]


def test_the_defaults_are_moved_one_after_another_and_the_timestep_last():
    found = defaults(split(family(), MadeUp()))
    assert [share.moved for share in found] == [
        "stiffness 1 → 4",
        "iterations unset → 8",
        "drag 0.5 → 0",
        "idle unset → 1",
        "timestep 0.04 → 0.01",
    ]
    # 1/1 − 1/4; 0.8/2 − 0.8/8; the drag; nothing; 3 · (0.04 − 0.01).
    assert [share.size for share in found] == pytest.approx([0.75, 0.3, 0.5, 0.0, 0.09], abs=1e-14)


def test_the_defaults_lead_from_the_error_of_stock_to_that_of_tuned():
    engine = MadeUp()
    found = defaults(split(family(), engine))
    assert found[0].before == pytest.approx(off(STOCK), abs=1e-14)
    assert found[-1].after == pytest.approx(off(TUNED), abs=1e-14)
    assert [share.before for share in found[1:]] == [share.after for share in found[:-1]]
    assert sum(share.size for share in found) == pytest.approx(off(STOCK) - off(TUNED), abs=1e-14)
    assert engine.seen.count(TUNED) == 1, "after five moves stock has become tuned, sampling included: no new run"


def test_an_option_that_only_stock_has_is_unset_on_the_way():
    def haste(settings: Settings) -> float:
        return off(settings) + 0.4 * float("haste" in settings.options)

    stock = Settings(0.04, 1, {"haste": True, "stiffness": 1.0, "drag": 0.5})
    found = defaults(split(family(), MadeUp(haste, stock=stock)))
    assert found[-2].moved == "haste True → unset"
    assert found[-2].size == pytest.approx(0.4, abs=1e-14)
    assert sum(share.size for share in found) == pytest.approx(haste(stock) - haste(TUNED), abs=1e-14)


def test_stock_settings_equal_to_the_tuned_ones_leave_nothing_to_move():
    assert defaults(split(family(), MadeUp(stock=TUNED))) == []


# Runs that fail


def fails_when(condition: Callable[[Settings], bool], error: Exception | None = None) -> Error:
    def run(settings: Settings) -> float:
        if condition(settings):
            raise error or RunFailed("made to fail")
        return off(settings)

    return run


@pytest.mark.parametrize("error", [RunFailed("no"), NeedsFunction("no"), CannotExpress("no"), ZeroDivisionError("no")])
def test_without_a_number_from_the_tuned_run_there_is_no_split(error):
    assert split(family(), MadeUp(fails_when(lambda settings: settings == TUNED, error))) is None


@pytest.mark.parametrize("number", [float("inf"), float("nan")])
def test_a_run_that_ends_at_infinity_has_no_error_to_split(number):
    assert split(family(), MadeUp(lambda settings: number)) is None


@pytest.mark.parametrize("number", [float("inf"), float("nan")])
def test_a_quantity_that_is_not_finite_gives_no_split(number):
    made = family()
    ends = replace(made.quantities[0], measure=lambda trajectory: number)
    assert split(replace(made, quantities=(ends,)), MadeUp()) is None


def test_a_move_whose_run_fails_leaves_its_share_in_the_remainder():
    found = split(family(), MadeUp(fails_when(lambda settings: settings["stiffness"] == 16.0)))
    assert [share.kind for share in found.shares if share.kind != DEFAULTS] == [
        DISCRETISATION,
        SOLVER,
        SOLVER,
        REMAINDER,
    ]
    assert sizes(found)["remainder: what"] == pytest.approx(0.3125 + 0.1875, abs=1e-14)
    halved = split(family(), MadeUp(fails_when(lambda settings: settings.timestep == 0.005)))
    assert "discretisation: timestep" not in sizes(halved)
    assert sum(sizes(halved).values()) == pytest.approx(0.58, abs=1e-14)


def test_options_that_only_work_together_are_moved_together():
    # Stiff without the iterations for it: that run fails, so the two count as one move.
    apart = fails_when(lambda settings: settings["stiffness"] == 4.0 and "iterations" not in settings.options)
    found = defaults(split(family(), MadeUp(apart)))
    assert found[0].moved == "stiffness 1 → 4, iterations unset → 8"
    assert found[0].size == pytest.approx(0.75 + 0.3, abs=1e-14)
    assert sum(share.size for share in found) == pytest.approx(off(STOCK) - off(TUNED), abs=1e-14)


def test_without_a_stock_number_only_the_first_step_has_no_size():
    found = defaults(split(family(), MadeUp(fails_when(lambda settings: settings["drag"] == 0.5))))
    assert found[0].moved == "stiffness 1 → 4, iterations unset → 8, drag 0.5 → 0"
    assert (found[0].before, found[0].size) == (None, None)
    assert found[0].after == pytest.approx(0.09 + off(TUNED), abs=1e-14)
    assert [share.size for share in found[1:]] == pytest.approx([0.0, 0.09], abs=1e-14)


# In a study, and in the engines


def split_of(name: str, engine: str, profile: str = "", changes: Mapping[str, Option] | None = None) -> Split | None:
    case = catalogue()[name].convergence.case
    changed = tuple((changes or {}).items())
    return run_job(Job(name, engine, profile or counted(engine), (case,), changes=changed, with_studies=True)).split


def test_only_the_unchanged_profile_that_counts_is_split():
    assert split_of("parting-ball", "handwritten", "step") is None
    assert split_of("parting-ball", "handwritten", changes={"timestep": 2e-3}) is None
    assert split_of("parting-ball", "handwritten") is not None
    case = catalogue()["parting-ball"].convergence.case
    assert run_job(Job("parting-ball", "handwritten", "exact", (case,))).split is None, "no studies were asked for"


def test_a_run_that_needs_a_missing_function_is_not_split(tmp_path):
    path = tmp_path / "nothing.py"
    path.write_text("")
    asked = Question.of(catalogue()["stack"], load_engine("handwritten", Implementation(str(path))))
    assert error_split.split(asked) is None


@pytest.mark.slow
def test_the_slabs_error_at_the_step_is_that_of_its_policy():
    found = split_of("sliding-slab", "handwritten")
    (policy,) = defaults(found)
    parameters = catalogue()["sliding-slab"].case(found.case).parameters
    assert policy.moved == "policy at_step → exact_root"
    # −v₀ dt/2, and for the last, shorter step no more than μ g dt²/8.
    near = parameters["friction"] * 9.81 * 1e-6 / 8
    assert policy.size == pytest.approx(-parameters["speed"] * 1e-3 / 2, abs=near)
    assert all(abs(size) < 1e-9 for size in sizes(found).values())  # of a stop that is solved for


@pytest.mark.parametrize("name", ["pybullet", *(pytest.param(name, marks=slow) for name in ("mujoco", "dart"))])
def test_the_error_of_a_rolling_balls_way_is_discretisation(name, installed):
    engine = installed(name)
    found = sizes(split(catalogue()["rolling-ball"], engine))
    case = catalogue()["rolling-ball"].case(catalogue()["rolling-ball"].convergence.case)
    timestep = engine.settings(case.scenarios[0], "tuned").timestep
    acceleration = 5 / 7 * 9.81 * np.sin(case.parameters["slope"])
    # + a t dt/2 for 2 s: nothing else is wrong with it.
    assert found["discretisation: timestep"] == pytest.approx(acceleration * 2 * timestep / 2, rel=0.01)
    rest = [size for name, size in found.items() if not name.startswith("discretisation")]
    assert all(abs(size) < 0.01 * found["discretisation: timestep"] for size in rest)


@pytest.mark.parametrize("profile", ["tuned", "stock", "spring"])
@pytest.mark.parametrize("name", ["handwritten", "pybullet", "mujoco", "dart"])
def test_every_move_of_an_engine_changes_an_existing_setting(name, profile):
    engine = load_engine(name)
    seen = 0
    for entry in catalogue().values():
        scenario = entry.case(entry.convergence.case).scenarios[0]
        if profile not in engine.profiles(scenario):
            continue
        settings = engine.settings(scenario, profile)
        moves = engine.moves(scenario, settings)
        for move in moves:
            assert move.kind in (CONTACT_MODEL, SOLVER)
            assert settings.change(**{move.option: move.value}) != settings
        assert len({move.option for move in moves}) == len(moves)
        seen += len(moves)
    moving = {(each, "tuned") for each in ("pybullet", "mujoco", "dart")}
    moving |= {(each, "spring") for each in ("pybullet", "mujoco")}
    assert (seen > 0) is ((name, profile) in moving)


@pytest.mark.parametrize("move", [Move(SOLVER, "no such option", 1.0), Move(SOLVER, "iterations", "many")])
def test_a_move_that_the_settings_refuse_is_a_failed_run(move):
    with pytest.raises(RunFailed, match=f"made-up one names a move that its settings do not allow: .*{move.option}"):
        split(family(), MadeUp(moves=(move,)))
