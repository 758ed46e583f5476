from __future__ import annotations

import math
import pickle

import pytest

from reference.errors import InvalidInput, UnknownName
from reference.scene.settings import Settings, steps_per_sample

OPTIONS = {"stiffness": 1e6, "iterations": 50, "split_impulse": True, "integrator": "Euler"}
SETTINGS = Settings(1e-3, options=OPTIONS)


@pytest.mark.parametrize(
    ("timestep", "text"),
    [
        (0.0, "timestep is 0.0; it must be above zero"),
        (-1e-3, "timestep is -0.001; it must be above zero"),
        (math.nan, "timestep is nan; it must be a finite number"),
        (math.inf, "timestep is inf; it must be a finite number"),
        ("fast", "timestep is 'fast'; it must be a number"),
    ],
)
def test_time_steps_forward_by_a_finite_amount(timestep, text):
    with pytest.raises(InvalidInput) as made:
        Settings(timestep)
    with pytest.raises(InvalidInput) as changed:
        SETTINGS.change(timestep=timestep)
    assert text in str(made.value)
    assert text in str(changed.value)


@pytest.mark.parametrize("sample_every", [0, -1, 2.5, "2", None])
def test_samples_are_a_whole_number_of_steps_apart(sample_every):
    with pytest.raises(InvalidInput) as caught:
        Settings(1e-3, sample_every)
    assert f"sample_every is {sample_every!r}; it must be a whole number of steps" in str(caught.value)


def test_an_option_is_read_by_its_name():
    assert SETTINGS["integrator"] == "Euler"
    assert SETTINGS["split_impulse"] is True
    assert SETTINGS.number("stiffness") == 1e6
    assert type(SETTINGS.number("iterations")) is float


def test_a_missing_option_is_refused_with_the_choices():
    with pytest.raises(UnknownName, match=r"unknown setting 'stifness'\. Did you mean 'stiffness'\?") as caught:
        SETTINGS["stifness"]
    assert set(caught.value.choices) == set(OPTIONS)


def test_a_word_is_not_accepted_as_a_number():
    with pytest.raises(InvalidInput, match="integrator is 'Euler'; it must be a number"):
        SETTINGS.number("integrator")


# Changes


def test_a_change_returns_a_copy_with_one_other_value():
    changed = SETTINGS.change(stiffness=2e6)
    assert dict(changed.options) == OPTIONS | {"stiffness": 2e6}
    assert (changed.timestep, changed.sample_every) == (SETTINGS.timestep, SETTINGS.sample_every)
    assert dict(SETTINGS.options) == OPTIONS


def test_only_options_that_the_engine_derived_can_be_changed():
    with pytest.raises(UnknownName) as caught:
        SETTINGS.change(iteration=10)
    assert "unknown setting 'iteration'. Did you mean 'iterations'?" in str(caught.value)
    assert set(caught.value.choices) == {"timestep", "sample_every", *OPTIONS}


def test_a_number_stays_a_number_however_it_is_typed():
    assert SETTINGS.change(stiffness="5e5")["stiffness"] == 5e5
    stiffness = SETTINGS.change(stiffness=3)["stiffness"]
    assert stiffness == 3.0
    assert type(stiffness) is float
    count = SETTINGS.change(iterations="20")["iterations"]
    assert count == 20
    assert type(count) is int
    with pytest.raises(InvalidInput, match="stiffness is 'high'; it must be a number"):
        SETTINGS.change(stiffness="high")
    with pytest.raises(InvalidInput, match="stiffness is nan; it must be a finite number"):
        SETTINGS.change(stiffness=math.nan)


def test_a_count_stays_whole():
    with pytest.raises(InvalidInput, match=r"iterations is 2\.5; it must be a whole number"):
        SETTINGS.change(iterations=2.5)


@pytest.mark.parametrize(
    ("value", "meant"), [(True, True), (False, False), ("false", False), ("0", False), ("1", True), ("true", True)]
)
def test_a_switch_is_true_or_false(value, meant):
    assert SETTINGS.change(split_impulse=value)["split_impulse"] is meant


@pytest.mark.parametrize("value", ["maybe", 2, 0.5])
def test_a_switch_accepts_nothing_but_true_or_false(value):
    with pytest.raises(InvalidInput) as caught:
        SETTINGS.change(split_impulse=value)
    assert str(caught.value) == f"split_impulse is {value!r}; it must be true or false"


def test_a_word_stays_a_word():
    assert SETTINGS.change(integrator="RK4")["integrator"] == "RK4"


def test_a_shorter_timestep_keeps_the_samples_a_millisecond_apart():
    finer = SETTINGS.change(timestep=1e-4)
    assert (finer.timestep, finer.sample_every) == (1e-4, 10)
    coarser = finer.change(timestep=2e-3)
    assert (coarser.timestep, coarser.sample_every) == (2e-3, 1)


@pytest.mark.parametrize("order", [("timestep", "sample_every"), ("sample_every", "timestep")])
def test_an_explicit_sampling_wins_over_the_default_in_either_order(order):
    wanted = {"timestep": 1e-4, "sample_every": 3}
    changed = SETTINGS.change(**{name: wanted[name] for name in order})
    assert (changed.timestep, changed.sample_every) == (1e-4, 3)


@pytest.mark.parametrize(("timestep", "steps"), [(1e-3, 1), (1e-4, 10), (2e-4, 5), (1 / 240, 1), (7e-4, 1), (3e-4, 3)])
def test_a_sample_is_about_a_millisecond_and_at_least_a_step(timestep, steps):
    assert steps_per_sample(timestep) == steps


# Plain data


def test_settings_survive_pickling_and_serve_as_a_key():
    copy = pickle.loads(pickle.dumps(SETTINGS))
    assert copy == SETTINGS
    assert hash(copy) == hash(SETTINGS)
    assert {SETTINGS: "found"}[copy] == "found"


def test_the_order_in_which_options_are_given_does_not_matter():
    turned = Settings(1e-3, options=dict(reversed(OPTIONS.items())))
    assert turned == SETTINGS
    assert hash(turned) == hash(SETTINGS)


@pytest.mark.parametrize("change", [{"timestep": 2e-3}, {"sample_every": 2}, {"stiffness": 1.0}, {"integrator": "RK4"}])
def test_settings_that_differ_are_not_equal(change):
    assert SETTINGS.change(**change) != SETTINGS


def test_settings_cannot_be_changed_in_place():
    options = dict(OPTIONS)
    made = Settings(1e-3, options=options)
    options["stiffness"] = 0.0
    assert made["stiffness"] == 1e6
    with pytest.raises(TypeError):
        made.options["stiffness"] = 0.0
    with pytest.raises(AttributeError):
        made.timestep = 1.0


def test_settings_describe_themselves_in_one_line():
    shown = SETTINGS.describe()
    assert shown == "timestep 0.001 s, stiffness 1e+06, iterations 50, split impulse True, integrator Euler"
    assert "\n" not in shown


def test_the_steps_between_two_samples_may_be_given_as_text_too():
    assert Settings(1e-3).change(sample_every="3").sample_every == 3
    with pytest.raises(InvalidInput, match=r"sample_every is '1\.5'; it must be a whole number"):
        Settings(1e-3).change(sample_every="1.5")
