"""Which scenarios may strike a body off its centre with rebound and friction, as the engines decide before they run."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from reference.catalogue.scenarios import catalogue
from reference.scene.forces import Force
from reference.scene.off_centre import may_rub_off_centre, may_strike_off_centre
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere

TILTED = (math.cos(math.pi / 12), 0.0, math.sin(math.pi / 12), 0.0)
ON_ITS_EDGE = (math.cos(math.pi / 8), 0.0, math.sin(math.pi / 8), 0.0)
ON_ITS_CORNER = (0.8880738339771153, 0.3250575836718681, -0.3250575836718681, 0.0)  # a diagonal of the cube is upright
FLOOR, TABLE = Body("other", HalfSpace()), Body("other", Box((1.0, 1.0, 0.1)))
ROUGH, SMOOTH, DULL = Pair("box", "other", 0.5, 0.2), Pair("box", "other", 0.5), Pair("box", "other", 0.0, 0.2)


def scenario(other=FLOOR, pair=ROUGH, gravity=(0, 0, -9.81), **of_the_box):
    box = Body("box", Box((0.1, 0.1, 0.1)), 1.0, **({"position": (0, 0, 1)} | of_the_box))
    return Scenario("off-centre", (other, box), (pair,), 1.0, gravity)


def ball(**given):
    return Body("other", Sphere(0.1), **({"mass": 1.0} | given))


OFF_CENTRE = {
    "tilted over a plane": scenario(orientation=TILTED),
    "level, but turning over": scenario(angular_velocity=(0, 1, 0)),
    "tilted over a table": scenario(TABLE, orientation=TILTED),
    "a ball beside the middle": scenario(ball(position=(0.05, 0, 0))),
    "a ball that drifts aside": scenario(ball(velocity=(0.5, 0, 0))),
    "a fixed ball under one that falls askew": scenario(ball(mass=math.inf), gravity=(1, 0, -9)),
    "one of two movable boxes beside the other": scenario(replace(TABLE, mass=2.0, position=(0.5, 0, 0))),
}
CENTRED = {
    "level over a plane": scenario(velocity=(3, 1, 0)),
    "spinning about the normal": scenario(angular_velocity=(0, 0, 5)),
    "on an edge below the centre": scenario(orientation=ON_ITS_EDGE),
    "level over a table, beside its centre": scenario(TABLE, position=(0.5, 0, 1), velocity=(1, 0, 0)),
    "a ball under the middle": scenario(ball()),
    "two boxes in line": scenario(replace(TABLE, mass=2.0)),
}


@pytest.mark.parametrize("what", OFF_CENTRE)
def test_a_push_beside_the_centre_is_found_before_the_run(what):
    assert may_strike_off_centre(OFF_CENTRE[what])


@pytest.mark.parametrize("what", CENTRED)
def test_a_push_through_the_centre_is_no_off_centre_impact(what):
    assert not may_strike_off_centre(CENTRED[what])


def test_without_rebound_or_friction_nothing_is_to_decide():
    tilted = OFF_CENTRE["tilted over a plane"]
    assert not may_strike_off_centre(replace(tilted, pairs=(SMOOTH,)))
    assert may_strike_off_centre(replace(tilted, pairs=(SMOOTH,)), smooth=True)
    assert not may_strike_off_centre(replace(tilted, pairs=(DULL,)), smooth=True)


RUBS = {
    "level over a plane": scenario(velocity=(3, 1, 0)),
    "an edge below the centre": scenario(orientation=ON_ITS_EDGE, velocity=(1, 0, -1)),
    "level over a table, beside its centre": scenario(TABLE, position=(0.5, 0, 1), velocity=(1, 0, 0)),
    "level over a slope": scenario(gravity=(1, 0, -9)),
    "pushed along the plane": replace(scenario(), forces=(Force("box", (1, 0, 0)),)),
}
STRAIGHT = {
    "straight down": scenario(velocity=(0, 0, -1)),
    "spinning about the normal": scenario(angular_velocity=(0, 0, 5)),
    "on a corner": scenario(orientation=ON_ITS_CORNER, velocity=(1, 0, -1)),
    "on the floor already": scenario(position=(0, 0, 0.1), velocity=(1, 0, 0)),
    "a ball that drifts aside": scenario(ball(velocity=(0.5, 0, 0))),
    "without friction": scenario(pair=SMOOTH, velocity=(3, 1, 0)),
    "without rebound": scenario(pair=DULL, velocity=(3, 1, 0)),
}


@pytest.mark.parametrize("what", RUBS)
def test_corners_that_land_and_slip_are_found_before_the_run(what):
    assert may_rub_off_centre(RUBS[what])


@pytest.mark.parametrize("what", STRAIGHT)
def test_corners_that_do_not_slip_or_are_alone_may_land(what):
    assert not may_rub_off_centre(STRAIGHT[what])


def test_of_the_catalogue_two_families_strike_off_centre():
    found = {
        family.name
        for family in catalogue().values()
        if any(may_strike_off_centre(scenario) for case in family.cases for scenario in case.scenarios)
    }
    assert found == {"struck-cube", "off-centre-impact"}
