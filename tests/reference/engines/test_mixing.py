"""One coefficient a body, such that an engine that mixes two gives each pair its own."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.engines import mixing
from reference.scene.scenario import Body, HalfSpace, Pair, Scenario, Sphere

FLOOR = Body("floor", HalfSpace())
BALLS = tuple(Body(f"ball {number}", Sphere(0.1), 1.0, (number, 0.0, 1.0)) for number in range(3))
NAMES = {body.name: place for place, body in enumerate((FLOOR, *BALLS))}


def scenario(*pairs: Pair) -> Scenario:
    return Scenario("mixed", (FLOOR, *BALLS), pairs, 1.0)


def restitution(pair: Pair) -> float:
    return pair.restitution


shares = st.floats(0.01, 1.0)


@given(st.lists(shares, min_size=3, max_size=3))
def test_balls_that_meet_only_the_floor_may_have_their_own_coefficients(values):
    pairs = [Pair(ball.name, "floor", value) for ball, value in zip(BALLS, values, strict=True)]
    for choose, mix in ((mixing.factors, lambda a, b: a * b), (mixing.least, min), (mixing.greatest, max)):
        chosen = choose(scenario(*pairs), restitution)
        for pair in pairs:
            got = mix(chosen[NAMES[pair.body_a]], chosen[NAMES["floor"]])
            assert got == pytest.approx(pair.restitution, rel=1e-15)  # a root and its square round once each


@given(shares)
def test_equal_pairs_give_equal_bodies(value):
    pairs = [Pair("ball 0", "ball 1", value), Pair("ball 1", "ball 2", value), Pair("ball 0", "floor", value)]
    assert mixing.factors(scenario(*pairs), restitution) == [pytest.approx(value**0.5, rel=1e-15)] * 4
    assert mixing.least(scenario(*pairs), restitution) == [value] * 4
    assert mixing.greatest(scenario(*pairs), restitution) == [value] * 4


def test_pairs_that_no_choice_gives_are_reported():
    ring = [Pair("ball 0", "ball 1", 0.5), Pair("ball 1", "ball 2", 0.5), Pair("ball 2", "ball 0", 0.2)]
    assert mixing.least(scenario(*ring), restitution) is None  # whoever makes 0.2 spoils a 0.5
    assert mixing.factors(scenario(*ring), restitution) is None  # of the two ways that we try
    other = [Pair("ball 0", "ball 1", 0.2), Pair("ball 1", "ball 2", 0.2), Pair("ball 2", "ball 0", 0.5)]
    assert mixing.greatest(scenario(*other), restitution) is None  # a body that makes 0.5 spoils a 0.2


@given(shares, shares, shares)
def test_a_product_of_numbers_up_to_one_is_found_for_a_chain(first, second, third):
    """DART takes 0 for a number above 1: a ball between a plane of e = 0.8 and one of 0.9 bounced off neither."""
    chain = [Pair("floor", "ball 0", first), Pair("ball 0", "ball 1", second), Pair("ball 1", "ball 2", third)]
    star = [Pair("ball 0", "floor", first), Pair("ball 0", "ball 1", second), Pair("ball 0", "ball 2", third)]
    for pairs in (chain, star):
        chosen = mixing.factors(scenario(*pairs), restitution, most=1.0)
        # With f₀f₁ = a, f₁f₂ = b and f₂f₃ = c, f₁ is at least a, and at most b/c or f₂ is less than c.
        assert (chosen is None) == (pairs is chain and first * third > second)
        for pair in pairs if chosen else ():
            assert chosen[NAMES[pair.body_a]] * chosen[NAMES[pair.body_b]] == pytest.approx(pair.restitution, rel=1e-14)
            assert max(chosen) <= 1


def test_the_minimum_rule_can_express_a_ring():
    ring = [Pair("ball 0", "ball 1", 0.5), Pair("ball 1", "ball 2", 0.2), Pair("ball 2", "ball 0", 0.2)]
    assert mixing.least(scenario(*ring), restitution) == [0.0, 0.5, 0.5, 0.2]


@given(st.lists(shares, min_size=3, max_size=3))
def test_a_product_expresses_each_pair_of_a_row_on_the_floor(values):
    row = [
        Pair(upper.name, lower.name, value)
        for upper, lower, value in zip(BALLS, (FLOOR, *BALLS[:-1]), values, strict=True)
    ]
    chosen = mixing.factors(scenario(*row), restitution)
    for pair in row:
        got = chosen[NAMES[pair.body_a]] * chosen[NAMES[pair.body_b]]
        assert got == pytest.approx(pair.restitution, rel=1e-15)  # a quotient and its product round once each


def test_a_pair_of_zero_limits_all_pairs_of_its_bodies():
    row = [Pair("ball 0", "floor", 0.3), Pair("ball 1", "ball 0", 0.0), Pair("ball 2", "ball 1", 0.2)]
    assert mixing.factors(scenario(*row), restitution) is None


def test_a_body_without_pairs_gets_no_coefficient():
    assert mixing.factors(scenario(), restitution) == [0.0] * 4
    two = scenario(Pair("ball 0", "floor", 0.3), Pair("ball 1", "floor", 0.5))
    assert mixing.factors(two, restitution) == [1.0, 0.3, 0.5, 0.0]
    assert mixing.least(scenario(Pair("ball 0", "floor", 0.3)), restitution) == [0.3, 0.3, 0.0, 0.0]
