"""What every family of the catalogue owes to whoever runs it or reads its report."""

from __future__ import annotations

import functools
import importlib
import itertools
import math
import pickle
import pkgutil
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest

from reference import lecture
from reference.catalogue import scenarios
from reference.catalogue.case import Case
from reference.catalogue.family import Expectation, Family, Quantity
from reference.catalogue.scenarios import catalogue, find
from reference.catalogue.scenarios.bouncing_ball import DROP_HEIGHT, DROPS, SPREAD, drop_height
from reference.engines import engine_names, load_engine
from reference.engines.base import AT_STEP, COMPLIANT, EXACT, INTERPOLATED, Method
from reference.errors import InvalidInput, UnknownName
from reference.scene import geometry
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings

FAMILIES = list(catalogue().values())
CASES = [(family, case) for family in FAMILIES for case in family.cases]
COUNTED = {("incline", "moves"), ("critical-incline", "moves"), ("box-on-edge", "face"), ("tipping-box", "outcome")}
"""Quantities that are whole numbers: an outcome is right or wrong."""
FROM_THEORY_ON = ("two-balls", "rod-on-peg", "two-walls", "spinning-ball")
"""Families in which a step that comes by chance at the touch shifts nothing, and one that comes late shifts a number to
one side: without a prediction it lies between theory and the largest shift, which is twice the mean one."""
NOT_IN_PROPORTION = ("passing-balls", "pellets", "spinning-rod")
"""Families in which a method loses bodies in steps: their share is not in proportion to the timestep."""
each_family = pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
METHODS = [
    Method(EXACT),
    Method(INTERPOLATED, rest_speed=5e-3),
    Method(AT_STEP, rest_speed=0.2),
    Method(AT_STEP, recovery=0.5, rest_speed=0.03),
    Method(AT_STEP, speed_recovery=1e-4, inset=0.5),
    Method(AT_STEP, rest_speed=0.5, inset=1.0, softness=1e-5, weighed=1.0),
    Method(COMPLIANT, stiffness=1e6, inset=0.5),
]


class Expected(NamedTuple):
    """What theory and a method say of one quantity of one case."""

    case: Case
    quantity: str
    method: Method
    expectation: Expectation


@functools.cache
def expectations(name: str) -> list[Expected]:
    """Every expectation of a family under every way to answer and two timesteps, where theory has a figure."""
    return [
        Expected(case, quantity.name, method, expectation)
        for case in catalogue()[name].cases
        for quantity in catalogue()[name].quantities
        if quantity.expect
        for method in METHODS
        for timestep in (1e-4, 1e-3)
        if (expectation := quantity.expect(case, Settings(timestep), method)) is not None
    ]


def judged(family: Family) -> Iterator[tuple[Case, Quantity]]:
    """Every case with every quantity that is expected to have a value."""
    return itertools.product(family.cases, [quantity for quantity in family.quantities if quantity.expect])


# The catalogue


def test_families_come_in_the_order_of_teaching_under_their_own_names():
    order = [topic.name for topic in lecture.TOPICS]
    places = [order.index(family.topic) for family in FAMILIES]
    assert places == sorted(places)
    assert [family.name for family in FAMILIES] == list(catalogue())
    assert {"dropped-ball", "ball-to-rest", "sliding-slab", "incline"} <= set(catalogue())


def test_no_two_families_share_a_name_or_a_title():
    entries = [family for module in vars(scenarios).values() for family in getattr(module, "FAMILIES", ())]
    assert len(entries) == len(FAMILIES), "a family with a name that is taken would hide the other"
    assert len({family.title for family in FAMILIES}) == len(FAMILIES)


def test_every_module_with_families_is_in_the_catalogue():
    modules = [info.name for info in pkgutil.iter_modules(scenarios.__path__)]
    having = [name for name in modules if hasattr(importlib.import_module(f"{scenarios.__name__}.{name}"), "FAMILIES")]
    assert sorted(scenarios.MODULES) == having


def test_a_family_and_its_cases_are_found_by_name():
    for family in FAMILIES:
        assert find(family.name) == (family, None)
        for case in family.cases:
            assert find(f"{family.name}/{case.name}") == (family, case)


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("droped-ball", "dropped-ball"),
        ("dropped-ball/e=0.7", "e=0.5"),
        ("/e=0.5", "incline"),
        ("two-bals", "two-balls"),
    ],
)
def test_an_unknown_name_is_refused_with_similar_ones(name, hint):
    with pytest.raises(UnknownName, match=hint):
        find(name)


# A family


@each_family
def test_a_family_belongs_to_a_topic_and_to_statements_of_the_lecture(family):
    assert family.topic in [topic.name for topic in lecture.TOPICS]
    assert family.statements
    assert len(set(family.statements)) == len(family.statements)
    for number in family.statements:
        assert lecture.statement(number).number == number


@each_family
def test_a_family_describes_itself_in_whole_sentences(family):
    texts = (family.title, family.about, family.expected, *family.why)
    assert family.why
    for text in texts:
        assert text
        assert text == " ".join(text.split()), "a line of the text was joined to the next with a wrong blank"
    for text in texts[1:]:
        assert text.endswith(".")


@each_family
def test_a_case_has_its_own_name_and_so_do_its_scenarios(family):
    names = [case.name for case in family.cases]
    assert names
    assert len(set(names)) == len(names)
    for case in family.cases:
        assert "/" not in case.name
        assert {scenario.name for scenario in case.scenarios} == {f"{family.name}/{case.name}"}


@each_family
def test_no_two_cases_of_a_family_have_the_same_scenarios(family):
    assert len({case.scenarios for case in family.cases}) == len(family.cases)


@each_family
def test_the_plotted_and_the_studied_case_and_quantity_exist(family):
    assert family.case(family.curve.case)
    assert family.case(family.convergence.case)
    quantity = family.quantity(family.convergence.quantity)
    assert quantity.expect is not None, "an error needs a value to be measured from"
    factors = family.convergence.factors
    assert list(factors) == sorted(factors, reverse=True)
    assert 1.0 in factors, "the timestep of the profile itself is on the curve"


@each_family
def test_quantities_have_names_titles_and_their_own_scale(family):
    names = [quantity.name for quantity in family.quantities]
    assert len(set(names)) == len(names)
    for quantity in family.quantities:
        assert quantity.name.isidentifier()
        assert quantity.title.strip()
        if quantity.scale:
            assert all(quantity.scale(case) >= 0 for case in family.cases)
    assert any(quantity.expect for quantity in family.quantities)


@each_family
def test_a_case_can_be_pickled_for_a_worker(family):
    for case in family.cases:
        assert pickle.loads(pickle.dumps(case)) == case
        assert case.parameters
        assert all(math.isfinite(value) for value in case.parameters.values())


@each_family
def test_no_starting_gap_is_near_the_threshold_of_touching(family):
    for case in (*family.cases, *(family.grid.cases if family.grid else ())):
        scenario = case.scenarios[0]
        pairs = [(scenario.body(pair.body_a), scenario.body(pair.body_b)) for pair in scenario.pairs]
        gaps = [abs(geometry.gap(a, b)) for a, b in pairs]
        assert not [gap for gap in gaps if geometry.TOUCHING / 1.9 < gap < geometry.TOUCHING * 4]


@each_family
def test_all_scenarios_of_a_case_have_the_same_settings(family):
    for case, name in itertools.product(family.cases, engine_names()):
        engine, first, last = load_engine(name), case.scenarios[0], case.scenarios[-1]
        assert list(engine.profiles(first)) == list(engine.profiles(last))
        assert set(engine.profiles(first)) <= set(family.profiles(engine))
        for profile in engine.profiles(first):
            assert engine.settings(first, profile) == engine.settings(last, profile)


# Expectations


@each_family
def test_every_tolerance_has_its_reason_and_is_above_zero(family):
    for case, quantity, _, expectation in expectations(family.name):
        assert expectation.reason.strip(), (case.name, quantity)
        if (family.name, quantity) in COUNTED:
            assert expectation.tolerance == 0, "it holds or it slides: there is nothing in between"
            assert expectation.value == int(expectation.value)
        else:
            assert 0 < expectation.tolerance < math.inf, (case.name, quantity)
        assert math.isfinite(expectation.value)


@each_family
def test_a_known_deviation_has_a_reason_and_a_narrower_band(family):
    for case, quantity, method, expectation in expectations(family.name):
        assert math.isfinite(expectation.shift)
        if expectation.shift:
            assert expectation.shift_reason.strip(), (case.name, quantity)
            assert 0 < expectation.shift_tolerance < math.inf, (case.name, quantity)
            assert method.kind != EXACT, "an exact method has nothing to explain"
        if abs(expectation.shift) > expectation.tolerance:  # only then can it be what a row is judged by
            band, farthest = expectation.shift_tolerance, abs(expectation.shift)
            if family.name in FROM_THEORY_ON:
                assert band <= (farthest + expectation.tolerance) * (1 + 1e-12), f"{quantity}: it reaches beyond theory"
            else:
                assert band < farthest, f"{quantity}: the band reaches back to theory, it explains anything"


@each_family
def test_expectations_of_an_exact_method_do_not_depend_on_the_timestep(family):
    for case, quantity in judged(family):
        coarse, fine = (quantity.expect(case, Settings(dt), Method(EXACT)) for dt in (8e-3, 1e-4))
        if coarse is not None and fine is not None:  # a tolerance may be a share of the overlap that a step finds
            coarse = replace(coarse, tolerance=fine.tolerance)
        assert coarse == fine, (case.name, quantity.name)


@each_family
def test_theory_gives_one_number_for_every_method_and_timestep(family):
    values = defaultdict(list)
    for case, quantity, _, expectation in expectations(family.name):
        values[case.name, quantity].append(expectation.value)
    for case, quantity in judged(family):
        found = values.pop((case.name, quantity.name), [])
        assert len(set(found)) <= 1
        # Theory has a figure for a case or has none, whoever is asked; of a contact that lasts it may have none.
        lasting = sum(method.kind == COMPLIANT for method in METHODS)
        assert len(found) in (0, 2 * (len(METHODS) - lasting), 2 * len(METHODS))
    assert not values


def test_theory_is_silent_on_tipping_boxes_and_simultaneous_impacts():
    without = [
        (family.name, quantity.name, case.name)
        for family, case in CASES
        for quantity in family.quantities
        if quantity.expect and quantity.expect(case, Settings(1e-3), Method(AT_STEP)) is None
    ]
    tipping = ("h=0.1,μ=1.5,θ=50°", "h=0.2,μ=0.7,θ=32°", "h=0.3,μ=0.5,θ=24°")
    touching = [
        *(("cradle", case) for case in ("3 touching", "5 touching")),
        *(("parting-ball", case) for case in ("v=0.1", "v=0.3", "v=0.5")),
    ]
    open_ = {(family, ball, case) for family, case in touching for ball in ("first", "last")}
    assert set(without) == open_ | {("tipping-box", "way", case) for case in tipping}


def test_a_quantity_without_theory_has_no_expected_value():
    family = catalogue()["tipping-box"]
    case, way = family.case("h=0.2,μ=0.7,θ=32°"), family.quantity("way")
    with pytest.raises(InvalidInput, match=r"way has no expected value in h=0\.2,μ=0\.7,θ=32°"):
        way.expected_value(case)
    slides = family.case("h=0.2,μ=0.3,θ=20°")
    assert way.expected_value(slides) == way.expect(slides, Settings(1e-3), Method(AT_STEP)).value
    energy = catalogue()["parting-ball"].quantity("energy")
    with pytest.raises(InvalidInput, match="energy has no expected value"):
        energy.expected_value(catalogue()["parting-ball"].cases[0])


@each_family
def test_deviations_caused_by_the_timestep_are_proportional_to_it(family):
    for case, quantity in judged(family):
        if family.name in NOT_IN_PROPORTION:
            lost = [quantity.expect(case, Settings(dt), Method(AT_STEP)).shift for dt in (1e-3, 1e-4, 1e-7)]
            assert lost == sorted(lost, reverse=True), "shorter steps lose fewer"
            assert 0 <= lost[-1] < 1e-6, "and very short ones lose none"  # (v dt/R)²/3 of 120 m/s and 20 mm: 10⁻⁷
            continue
        found = [quantity.expect(case, Settings(dt), Method(AT_STEP)) for dt in (1e-3, 1e-4)]
        if None not in found:
            coarse, fine = (expectation.shift for expectation in found)
            near = 0.1 if family.name == "two-balls" else 1e-9  # first order: exact in a product, not in an angle
            assert coarse == pytest.approx(10 * fine, rel=near), (case.name, quantity.name)


# What a method does to an impact


def test_a_fifth_impact_taken_for_rest_has_a_reason_of_its_own():
    family = catalogue()["two-walls"]
    case, speed = family.case("e=0.5"), family.quantity("speed_left")  # the fifth impact comes at 0.125 m/s
    rebounds, rests = (speed.expect(case, Settings(1e-3), Method(AT_STEP, rest_speed=at)) for at in (0.124, 0.126))
    assert rebounds.shift == rests.shift == 0
    assert (rebounds.shift_reason, "taken for rest" in rests.shift_reason) == ("", True)


# The jittered drops


TIMESTEPS = (1 / 60, 1 / 120, 1 / 240, 4e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5)


def fall_times(scenarios: tuple[Scenario, ...]) -> np.ndarray:
    heights = np.array([drop_height(scenario) for scenario in scenarios])
    return np.sqrt(2 * heights / 9.81)


@pytest.mark.parametrize("timestep", TIMESTEPS)
@pytest.mark.parametrize("case", catalogue()["dropped-ball"].cases, ids=lambda case: case.name)
def test_jittered_drops_land_at_evenly_spread_phases_of_a_step(case, timestep):
    phases = np.sort(fall_times(case.scenarios) / timestep % 1)
    gaps = np.diff([*phases, phases[0] + 1])
    assert len(phases) == DROPS
    # Rounding: fall times of 0.45 s, known to 1e-16 of that, over a step of 0.1 ms.
    np.testing.assert_allclose(gaps, 1 / DROPS, atol=1e-11)


def test_the_first_drop_of_an_ensemble_is_the_one_from_the_nominal_height():
    for case in catalogue()["dropped-ball"].cases:
        assert drop_height(case.scenarios[0]) == pytest.approx(DROP_HEIGHT, abs=1e-15)
        assert np.ptp(fall_times(case.scenarios)) == pytest.approx(SPREAD * (DROPS - 1) / DROPS)
        assert fall_times(case.scenarios).mean() == pytest.approx(math.sqrt(2 * DROP_HEIGHT / 9.81))


def test_every_drop_lasts_until_the_apex_of_its_rebound():
    for case in catalogue()["dropped-ball"].cases:
        for scenario, fall in zip(case.scenarios, fall_times(case.scenarios), strict=True):
            assert scenario.duration > fall * (1 + case.parameters["restitution"]) + 0.02  # and some samples more
