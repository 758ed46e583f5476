"""Options out of range are refused before an engine runs; the engines themselves would run with most of them."""

from __future__ import annotations

import pytest
from catalogue_rows import counted

from reference.catalogue.scenarios.bouncing_ball import falling_ball
from reference.catalogue.scenarios.tipping_box import FAMILIES as TIPPING
from reference.engines import engine_names, load_engine
from reference.errors import InvalidInput

BALL = falling_ball("ball", 0.5, 1.0, 1.0)
BOX = TIPPING[0].cases[0].scenarios[0]


@pytest.mark.parametrize(
    ("engine", "option", "value", "wanted"),
    [
        ("mujoco", "impratio", -5.0, "it must be above 0"),
        ("mujoco", "noslip_iterations", -5, "it must be from 0 to 2147483647"),
        ("mujoco", "noslip_iterations", 3_000_000_000, "it must be from 0 to 2147483647"),
        ("mujoco", "impedance", 1.0, "it must be from 0.0001 to 0.9999"),
        ("mujoco", "integrator", "Verlet", "one of Euler, RK4, implicit, implicitfast"),
        ("mujoco", "cone", "square", "one of elliptic, pyramidal"),
        ("pybullet", "solver_iterations", -1, "it must be from 1 to 2147483647"),
        ("pybullet", "contact_erp", 1.5, "it must be from 0 to 1"),
        ("pybullet", "coordinates", "reduced", "one of maximal, multibody"),
        ("dart", "solver_iterations", 0, "it must be from 1 to 2147483647"),
        ("dart", "solver_iterations", 10**20, "it must be from 1 to 2147483647"),
        ("dart", "solver_tolerance", 0.0, "it must be above 0"),
        ("handwritten", "shortest_flight", -1.0, "it must be at least 0"),
    ],
)
def test_an_option_out_of_range_is_refused_with_the_range(engine, option, value, wanted):
    found = load_engine(engine)
    settings = found.settings(BALL, counted(engine)).change(**{option: value})
    with pytest.raises(InvalidInput, match=f"^{option} is {value!r}; .*{wanted}"):
        found.check_settings(BALL, settings)


@pytest.mark.parametrize("name", engine_names())
def test_every_option_of_an_engines_profiles_has_a_range(name):
    engine = load_engine(name)
    for scenario in (BALL, BOX):
        for profile in engine.profiles(scenario):
            settings = engine.settings(scenario, profile)
            engine.check_settings(scenario, settings)
            numbers = {option for option, value in settings.options.items() if not isinstance(value, bool)}
            assert numbers <= engine.allowed.keys()
