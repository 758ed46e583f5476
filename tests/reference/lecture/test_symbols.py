"""The table of symbols speaks of functions that are there, with parameters of these names."""

from __future__ import annotations

import inspect

import pytest

from reference import lecture
from reference.engines.implementation import Implementation
from reference.lecture.symbols import SYMBOLS


@pytest.mark.parametrize("symbol", SYMBOLS, ids=lambda symbol: symbol.slide)
def test_a_symbol_is_a_parameter_of_the_function_that_it_names(symbol):
    taken = inspect.signature(inspect.unwrap(Implementation().function(symbol.of))).parameters
    assert set(symbol.name.split(", ")) <= set(taken)


@pytest.mark.parametrize("symbol", SYMBOLS, ids=lambda symbol: symbol.slide)
def test_a_symbols_statements_are_statements_of_the_lecture(symbol):
    assert [lecture.statement(number).number for number in symbol.statements] == list(symbol.statements)


def test_no_symbol_of_the_slides_is_listed_twice():
    assert len({symbol.slide for symbol in SYMBOLS}) == len(SYMBOLS)
